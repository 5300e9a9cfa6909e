//! Lines of a device: each alone, by the rules of its mode, and joined.
//!
//! The specification has three shapes for a line that is one pixel wide: a rectangle, a parallelogram, and the pixels whose diamonds
//! the line leaves, as Bresenham's algorithm has them. Which of them is right depends on what the device offers and was asked for.

use super::cells::{draw_of, plain};
use super::engine::Gpu;
use super::known::{self, KnownFault};
use super::outcome::Outcome;
use crate::device::Error;
use crate::device::draw::Pictures;
use crate::device::kind::{CELL_PX, Kind};
use rasterproof_core::geometry::sorted;
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_judge::ask::runs_of;
use rasterproof_verify::oracle::segments::{self as segment, Pixels};
use rasterproof_verify::specification::Standing;

/// Pixels between lines and the sides of their window, so that one that lies a pixel away is seen.
const MARGIN_PX: i32 = 2;

/// Positions on the lattice of lines, on pixel centres and on corners of pixels, in turn.
struct Places {
    rng: Rng,
    step: i32,
}

impl Places {
    fn new(name: &str, gpu: &Gpu, seed: u64) -> Self {
        Self { rng: Rng::new(name, seed, 0), step: step(gpu) }
    }

    /// A coordinate of the point of this number.
    fn along(&mut self, of: u64) -> i32 {
        let (low, high) = (MARGIN_PX, CELL_PX as i32 - MARGIN_PX);
        let per_px = SUBPIXELS / self.step;
        // The first and the last whole number of units, and what they are counted in and from.
        let (first, last, unit, offset) = match of % 3 {
            0 => (low * per_px, high * per_px, self.step, 0),
            1 => (low, high - 1, SUBPIXELS, SUBPIXELS / 2),
            _ => (low, high, SUBPIXELS, 0),
        };
        self.rng.int(i64::from(first), i64::from(last)) as i32 * unit + offset
    }

    fn point(&mut self, of: u64) -> SubpixelPoint {
        SubpixelPoint::new(self.along(of), self.along(of))
    }
}

/// A step of the lattice of lines, in subpixels.
fn step(gpu: &Gpu) -> i32 {
    SUBPIXELS >> gpu.about().line_subpixel_bits.clamp(0, 8)
}

/// Draws lines, each into the cell beside it; cells do not decrease.
fn draw(gpu: &mut Gpu, kind: Kind, lines: &[(usize, segment::Ends)]) -> Result<Pictures, Error> {
    let side = gpu.viewport_px();
    let (mut draws, mut cells) = (Vec::new(), 0);
    for (cell, [a, b]) in lines {
        draws.push(draw_of(*cell, plain(&[*a, *b, *b], side / 2.0), side));
        cells = cell + 1;
    }
    gpu.draw(kind, cells, draws)
}

/// The pixels of a cell that were drawn, however often.
fn lit(pictures: &Pictures, cell: usize) -> Pixels {
    let mut lit = Pixels::default();
    for y in 0..CELL_PX {
        for (run, _) in runs_of(y as i32, pictures.row(cell, y, CELL_PX)) {
            lit.extend((run.x0_px..run.x1_px).map(|x| (x, run.y_px)));
        }
    }
    lit
}

/// How lines fit a shape, counted by [`segment::Fit`]: equal, allowed, outside.
fn class([_, allowed, outside]: [u64; 3]) -> Standing {
    Standing::of(allowed + outside == 0, outside == 0)
}

/// Lines alone, each compared with all three shapes; the mode decides which of them counts.
pub(super) fn apart(gpu: &mut Gpu, seed: u64, cases: u64, kind: Kind) -> Result<Outcome, Error> {
    let step = step(gpu);
    let mut places = Places::new("vulkan-lines", gpu, seed);
    let mut segments: Vec<(usize, segment::Ends)> = Vec::new();
    for n in 0..cases {
        let ends = [places.point(n), places.point(n)];
        // A line without a length has no shape to be judged by.
        if ends[0] != ends[1] {
            segments.push((segments.len(), ends));
        }
    }
    let pictures = draw(gpu, kind, &segments)?;
    let (mut rectangle, mut parallelogram, mut diamond) = ([0u64; 3], [0u64; 3], [0u64; 3]);
    let side = CELL_PX as i32;
    for (cell, ends) in &segments {
        let lit = lit(&pictures, *cell);
        rectangle[segment::rectangle(ends, &lit, side, step) as usize] += 1;
        parallelogram[segment::parallelogram(ends, &lit, side, step) as usize] += 1;
        diamond[segment::diamond_exit(ends, &lit, side) as usize] += 1;
    }
    let fits =
        [("rectangles", rectangle), ("parallelograms", parallelogram), ("diamond-exit", diamond)];
    let said = fits.map(|(name, [equal, allowed, outside])| {
        format!("as {name} {equal} equal, {allowed} allowed, {outside} outside")
    });
    let said = format!("{} lines; {}", segments.len(), said.join("; "));
    Ok(match kind {
        Kind::BresenhamLines => (class(diamond), said),
        Kind::Lines if !gpu.about().strict_lines => {
            (class(parallelogram).min(class(diamond)), said)
        }
        _ => (class(rectangle), said),
    })
}

/// The first two pixels in a list that follow each other and do not touch, not even with their corners.
fn first_gap(pixels: &[(i32, i32)]) -> Option<[(i32, i32); 2]> {
    for pair in pixels.windows(2) {
        let [before, after] = [pair[0], pair[1]];
        if (before.0 - after.0).abs() > 1 || (before.1 - after.1).abs() > 1 {
            return Some([before, after]);
        }
    }
    None
}

pub(super) const JOINED: &str = "lines, joined";

/// Bresenham lines with an end in common that go on in the same direction: no pixel twice, and no gap.
pub(super) fn joined(
    gpu: &mut Gpu,
    seed: u64,
    cases: u64,
    known: &[KnownFault],
) -> Result<Outcome, Error> {
    let mut places = Places::new("vulkan-joined-lines", gpu, seed);
    let mut lines = Vec::new();
    for n in 0..cases {
        let points = [places.point(n), places.point(n), places.point(n)];
        let mut points = sorted(points, |a, b| a.x > b.x);
        // Both directions along the lines, in turn.
        if n % 2 == 1 {
            points.reverse();
        }
        let [a, b, c] = points;
        // Both have more columns than rows, so that neither may draw two pixels in a column.
        let is_wide = |a: SubpixelPoint, b: SubpixelPoint| (b.x - a.x).abs() > (b.y - a.y).abs();
        if is_wide(a, b) && is_wide(b, c) {
            let cell = lines.len() / 2;
            // Half of them the other way round: rows for columns.
            let [a, b, c] = match n / 2 % 2 {
                0 => points,
                _ => points.map(|p| SubpixelPoint::new(p.y, p.x)),
            };
            lines.extend([(cell, [a, b]), (cell, [b, c])]);
        }
    }
    let pictures = draw(gpu, Kind::BresenhamLines, &lines)?;
    let (mut twice, mut gaps, mut example) = (0u64, 0u64, String::new());
    for (cell, pair) in (0..).zip(lines.chunks_exact(2)) {
        let mut hits = (0..CELL_PX).flat_map(|y| pictures.row(cell, y, CELL_PX));
        twice += u64::from(hits.any(|hits| *hits > 1));
        // The pixels in the order in which the lines run.
        let [a, c] = [pair[0].1[0], pair[1].1[1]];
        let is_wide = (c.x - a.x).abs() >= (c.y - a.y).abs();
        let mut lit: Vec<_> = lit(&pictures, cell).into_iter().collect();
        lit.sort_by_key(|&(x, y)| if is_wide { (x, y) } else { (y, x) });
        if let Some([before, after]) = first_gap(&lit) {
            gaps += 1;
            if example.is_empty() {
                let [a, b, c] = [a, pair[0].1[1], c].map(|p| p.to_px());
                example = format!(
                    ", the first from {a:?} over {b:?} to {c:?} between {before:?} and {after:?}"
                );
            }
        }
    }
    let said = format!(
        "{} pairs of lines that go on: {twice} draw a pixel twice, {gaps} have a gap{example}",
        lines.len() / 2
    );
    Ok((known::class_of_share(known, JOINED, twice + gaps, lines.len() as u64 / 2), said))
}
