//! A rasterizer with a convention of its own: it fails by the rule of this crate, the failure names what it does, and by
//! the convention that it then declares it is right.

use rasterproof_verify::comparison::{Convention, NothingJudged, Options, Rule, judge_coverage};
use rasterproof_verify::contract::Rasterize;
use rasterproof_verify::grid::PixelRect;
use rasterproof_verify::triangle::{Corners, Span};

/// Samples at the upper left corners of pixels, and counts crossings to the right of a sample, so that samples on bottom
/// and right edges belong to a triangle.
struct Crossings;

impl Rasterize for Crossings {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        let c = corners.map(|p| [i128::from(p.x), i128::from(p.y)]);
        for y_px in bounds.y0..bounds.y1 {
            for x_px in bounds.x0..bounds.x1 {
                let (x, y) = (i128::from(x_px) * 256, i128::from(y_px) * 256);
                let crossings = [(0, 1), (1, 2), (2, 0)].iter().filter(|&&(i, j)| {
                    let (upper, lower) =
                        if c[i][1] < c[j][1] { (c[i], c[j]) } else { (c[j], c[i]) };
                    // A corner at the height of the sample lies below it, and a crossing at the sample to its right.
                    upper[1] < y
                        && y <= lower[1]
                        && (lower[0] - upper[0]) * (y - upper[1])
                            >= (x - upper[0]) * (lower[1] - upper[1])
                });
                if crossings.count() % 2 == 1 {
                    emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
                }
            }
        }
    }
}

pub fn main() -> Result<(), NothingJudged> {
    let options = Options::default().cases(100);
    let disagreement = judge_coverage(&Crossings, &options)?.check().expect_err("another rule");
    let cause = disagreement.cause.expect("it was asked more");
    println!("{cause}");
    let declared = Convention::default().rule(Rule::BottomRight).sample(0, 0);
    assert_eq!(cause.declare, Some(declared.to_string()));
    judge_coverage(&Crossings, &options.convention(declared))?.check().expect("as it declares");
    println!("by its own convention every pixel is right");
    Ok(())
}
