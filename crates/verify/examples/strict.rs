//! A rasterizer that tests `> 0` on every edge, as many tutorials do, and what its failing test prints.

use rasterproof_verify::cases::FamilyName;
use rasterproof_verify::comparison::{NothingJudged, Options, judge_coverage};
use rasterproof_verify::contract::Rasterize;
use rasterproof_verify::grid::{PixelRect, SubpixelPoint};
use rasterproof_verify::triangle::{Corners, Span};

/// Right inside, wrong on every edge.
pub struct Strict;

impl Rasterize for Strict {
    fn cover(&self, c: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        let edge = |a: SubpixelPoint, b: SubpixelPoint, x: i64, y: i64| {
            let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(i64::from);
            i128::from(bx - ax) * i128::from(y - ay) - i128::from(by - ay) * i128::from(x - ax)
        };
        for y_px in bounds.y0..bounds.y1 {
            for x_px in bounds.x0..bounds.x1 {
                let (x, y) = (i64::from(x_px) * 256 + 128, i64::from(y_px) * 256 + 128);
                let e = [edge(c[0], c[1], x, y), edge(c[1], c[2], x, y), edge(c[2], c[0], x, y)];
                if e.iter().all(|&e| e > 0) || e.iter().all(|&e| e < 0) {
                    emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
                }
            }
        }
    }
}

pub fn main() -> Result<(), NothingJudged> {
    let options = Options::default().cases(200);
    let disagreement = judge_coverage(&Strict, &options)?.check().expect_err("it is wrong");
    println!("{disagreement}");
    // Triangles with random corners hardly ever show it.
    let random = options.family(FamilyName::Uniform);
    println!(
        "random corners alone: {} wrong pixels",
        judge_coverage(&Strict, &random)?.mismatches()
    );
    Ok(())
}
