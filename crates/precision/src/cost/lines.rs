//! The group of lines: pixels beside the nearest one, and what drawing takes.

use super::entry::{Canvas, Entry, PreparedColumns, classes};
use super::{Choice, CostOptions, Run};
use crate::ladder::lines::{Contracted, Draw, Drifting, FixedPoint};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::line::dda::Dda;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_verify::oracle::Oracle;

type Ends = [PixelPoint; 2];

/// The lines of a column, the pixels that are right for each, and where choices draw them.
pub(super) struct Input {
    window: PixelRect,
    lines: Vec<Ends>,
    truth: Vec<Vec<PixelPoint>>,
    canvas: Canvas<u32>,
}

impl Input {
    fn pixels(&self) -> usize {
        self.truth.iter().map(Vec::len).sum()
    }
}

fn entry(
    name: &'static str,
    about: &'static str,
    promises: &[usize],
    body: impl Draw + Copy + 'static,
) -> Entry<Input> {
    Entry::new(
        Choice::new(name, about, promises),
        move |input: &Input| {
            let mut wrong = 0;
            for (&ends, truth) in input.lines.iter().zip(&input.truth) {
                body.accepts(ends)?;
                let mut pixels = Vec::new();
                body.draw(ends, input.window, |pixel| pixels.push(pixel));
                wrong += differences(pixels, truth);
            }
            Ok(Run::of(vec![Some(wrong as f64 * 1e6 / input.pixels().max(1) as f64)]))
        },
        move |Input { window, lines, canvas, .. }: &Input| {
            Ok(canvas.pass(move |target| {
                for (ends, colour) in std::hint::black_box(lines).iter().zip(1..) {
                    body.draw(*ends, *window, |p| {
                        // Off by a row at the border, a drifting choice must not leave the frame.
                        let y_px = p.y.clamp(window.y0, window.y1 - 1);
                        let x = (p.x.clamp(window.x0, window.x1 - 1) - window.x0) as usize;
                        target.row_mut(y_px)[x] = colour;
                    });
                }
            }))
        },
    )
}

pub(super) fn choices() -> Vec<Entry<Input>> {
    vec![
        entry("16.16 DDA", "y += dy / dx in fixed point", &[], FixedPoint),
        entry("f32 DDA", "y += dy / dx", &[], Drifting::<f32>::default()),
        entry("f64 DDA", "y += dy / dx", &[], Drifting::<f64>::default()),
        entry("Bresenham", "the line drawer bresenham", &[0], Contracted(Bresenham)),
        entry("exact DDA", "the line drawer dda: whole + part / n", &[0], Contracted(Dda)),
    ]
}

/// Lines for the classes of scenes that mean something for them, and why not for the others.
fn lines(
    name: &str,
    (seed, pixels): (u64, u64),
    bounds: PixelRect,
) -> Result<(Vec<Ends>, &'static str), String> {
    let (most, about) = match name {
        "large" => (900, "up to 900 px long"),
        "25 px" => (25, "up to 25 px long"),
        "<8 px" => (7, "up to 7 px long"),
        "half" => (240, "halfway between two pixels at every odd multiple of a step"),
        "tie" => (900, "dv / du next to 1/2, 1/3, 2/3, 1/4 or 3/4"),
        "far" => (240, "up to 240 px long, 2^14 px from the origin"),
        _ => return Err("a class of triangles, not of lines".to_owned()),
    };
    let mut rng = Rng::new(name, seed, 1);
    let count = (pixels / (u64::from(most as u16) / 2 + 1)).max(16);
    let side = i64::from(bounds.width());
    let lines = (0..count).map(|_| {
        let [du, dv] = match name {
            "half" => {
                // An odd rise over a power of two times two: heights of k + 1/2 occur.
                let du = 2i64 << rng.int(0, 6);
                [du, (2 * rng.int(0, du / 2) + 1).min(du - 1)]
            }
            "tie" => {
                let (p, q) = [(1, 2), (1, 3), (2, 3), (1, 4), (3, 4)][rng.int(0, 4) as usize];
                let k = rng.int(2, most / q - 1);
                [q * k + rng.int(-1, 1), p * k]
            }
            _ => {
                let du = rng.int(0, most);
                [du, rng.int(0, du)]
            }
        };
        let (dx, dy) = if rng.chance(2) { (du, dv) } else { (dv, du) };
        let start = |rng: &mut Rng, d: i64, low: i32| i64::from(low) + rng.int(1, side - 2 - d);
        let (x, y) = (start(&mut rng, dx, bounds.x0), start(&mut rng, dy, bounds.y0));
        // Any direction: swap the ends of one axis or the other.
        let (mut a, mut b) = ([x, y], [x + dx, y + dy]);
        for axis in [0, 1] {
            if rng.chance(2) {
                std::mem::swap(&mut a[axis], &mut b[axis]);
            }
        }
        [a, b].map_array(|[x, y]| PixelPoint::new(x as i32, y as i32))
    });
    Ok((lines.collect(), about))
}

/// The pixels that are right for a line.
fn truth(ends: Ends, window: PixelRect) -> Vec<PixelPoint> {
    let line =
        ScreenLine { ends: ends.map_array(|pixel| LineEnd { pixel, depth: 0.0, varying: 0.0 }) };
    let mut pixels = Vec::new();
    Oracle.steps(&line, window, &mut |pixel, _| pixels.push(pixel));
    pixels
}

/// Pixels of either list that are missing in the other.
fn differences(mut ours: Vec<PixelPoint>, truth: &[PixelPoint]) -> u64 {
    let key = |p: &PixelPoint| (p.x, p.y);
    let mut truth = truth.to_vec();
    ours.sort_unstable_by_key(key);
    truth.sort_unstable_by_key(key);
    let missing = |a: &[PixelPoint], b: &[PixelPoint]| {
        a.iter().filter(|p| b.binary_search_by_key(&key(p), key).is_err()).count() as u64
    };
    // A pixel beside the line is one that is missing and one too many: count it once. Pixels drawn
    // twice have no counterpart and add to the excess.
    missing(&truth, &ours).max(missing(&ours, &truth)) + ours.len().abs_diff(truth.len()) as u64
}

/// On the other groups' classes, for their names and windows.
pub(super) fn columns(options: &CostOptions) -> impl PreparedColumns<Input> {
    let how = (options.seed, if options.quick { 20_000 } else { 300_000 });
    classes(options, (1024, [0, 0]), move |class| {
        class.triangles.clear();
        let (lines, about) = lines(class.name, how, class.bounds)?;
        class.about = about;
        let truth = lines.iter().map(|&ends| truth(ends, class.bounds)).collect();
        let input = Input { window: class.bounds, lines, truth, canvas: Canvas::new(class.bounds) };
        let counts = [input.lines.len(), input.pixels()];
        Ok((input, counts))
    })
}
