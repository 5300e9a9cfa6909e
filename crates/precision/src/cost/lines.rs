//! The group of lines: pixels beside the nearest one, and what drawing takes.

use super::scene::{Size, scenes};
use super::{Board, Choice, Column, CostOptions, Draft, Ladder, Places, PreparedCell};
use crate::ladder::lines::{Contracted, Draw, Drifting, FixedPoint};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::line::dda::Dda;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_verify::oracle::Oracle;

type Ends = [PixelPoint; 2];

trait AnyDraw {
    fn accepts(&self, ends: Ends) -> Result<(), String>;
    fn pixels(&self, ends: Ends, window: PixelRect) -> Vec<PixelPoint>;
    fn paint(&self, lines: &[Ends], target: &mut Frame<u32>);
}

impl<D: Draw> AnyDraw for D {
    fn accepts(&self, ends: Ends) -> Result<(), String> {
        Draw::accepts(self, ends)
    }

    fn pixels(&self, ends: Ends, window: PixelRect) -> Vec<PixelPoint> {
        let mut pixels = Vec::new();
        self.draw(ends, window, |pixel| pixels.push(pixel));
        pixels
    }

    fn paint(&self, lines: &[Ends], target: &mut Frame<u32>) {
        let window = target.bounds();
        for (ends, colour) in lines.iter().zip(1..) {
            self.draw(*ends, window, |p| {
                // Off by a row at the border, a drifting choice must not leave the frame.
                let y_px = p.y.clamp(window.y0, window.y1 - 1);
                let x = (p.x.clamp(window.x0, window.x1 - 1) - window.x0) as usize;
                target.row_mut(y_px)[x] = colour;
            });
        }
    }
}

struct Variant {
    choice: Choice,
    body: Box<dyn AnyDraw>,
}

fn variants() -> Vec<Variant> {
    let new = |name, about, exact: bool, body| Variant {
        choice: Choice::new(name, about, if exact { &[0] } else { &[] }),
        body,
    };
    vec![
        new("16.16 DDA", "y += dy / dx in fixed point", false, Box::new(FixedPoint)),
        new("f32 DDA", "y += dy / dx", false, Box::<Drifting<f32>>::default()),
        new("f64 DDA", "y += dy / dx", false, Box::<Drifting<f64>>::default()),
        new("Bresenham", "the line drawer bresenham", true, Box::new(Contracted(Bresenham))),
        new("exact DDA", "the line drawer dda: whole + part / n", true, Box::new(Contracted(Dda))),
    ]
}

/// Lines for the classes of scenes that mean something for them, and why not for the others.
fn lines(
    name: &str,
    seed: u64,
    size: &Size,
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
    let count = (size.pixels / (u64::from(most as u16) / 2 + 1)).max(16);
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

pub(super) fn measure(options: &CostOptions, progress: &dyn Fn(f64, &str)) -> Board {
    let size = Size { side_px: 1024, pixels: if options.quick { 20_000 } else { 300_000 } };
    let variants = variants();
    // The classes of the other groups, for their names and windows.
    let classes = scenes(options.seed, Size { side_px: size.side_px, pixels: 0 });
    let made: Vec<_> =
        classes.iter().map(|class| lines(class.name, options.seed, &size, class.bounds)).collect();
    let targets: Vec<_> =
        classes.iter().map(|class| Places::new(|| Frame::new(class.bounds, 0))).collect();
    let choices = variants.iter().map(|variant| variant.choice.clone());
    let mut draft = Draft::new(Ladder::Lines, choices, options);
    for ((class, made), target) in classes.iter().zip(&made).zip(&targets) {
        draft.tell(progress, classes.len());
        let (lines, about) = match made {
            Ok(made) => made,
            Err(why) => {
                draft.leave_out(Column::new(class.name, class.about, 0, 0), why);
                continue;
            }
        };
        let truth: Vec<_> = lines.iter().map(|&ends| truth(ends, class.bounds)).collect();
        let pixels: u64 = truth.iter().map(|list| list.len() as u64).sum();
        let cells = variants.iter().map(|Variant { body, .. }| {
            if let Some(why) = lines.iter().find_map(|&ends| body.accepts(ends).err()) {
                return PreparedCell::NotRun(why);
            }
            let drawn = lines.iter().map(|&ends| body.pixels(ends, class.bounds));
            let wrong: u64 = drawn.zip(&truth).map(|(ours, t)| differences(ours, t)).sum();
            let per_million = wrong as f64 * 1e6 / pixels.max(1) as f64;
            PreparedCell::ready(vec![Some(per_million)], || {
                body.paint(std::hint::black_box(lines), &mut target.borrow_mut());
            })
        });
        draft.add(Column::new(class.name, *about, lines.len() as u64, pixels), cells);
    }
    draft.finish(options, progress)
}
