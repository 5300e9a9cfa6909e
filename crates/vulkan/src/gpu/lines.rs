//! Lines of a device: each alone, by the rules of its mode, and joined.

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
use rasterproof_verify::oracle::segments::{self as segment, Fit, Pixels};
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

    fn along(&mut self, of: u64) -> i32 {
        let (low, high) = (MARGIN_PX, CELL_PX as i32 - MARGIN_PX);
        let per_px = SUBPIXELS / self.step;
        let mut int = |low: i32, high: i32| self.rng.int(i64::from(low), i64::from(high)) as i32;
        match of % 3 {
            0 => int(low * per_px, high * per_px) * self.step,
            1 => int(low, high - 1) * SUBPIXELS + SUBPIXELS / 2,
            _ => int(low, high) * SUBPIXELS,
        }
    }

    fn point(&mut self, of: u64) -> SubpixelPoint {
        SubpixelPoint::new(self.along(of), self.along(of))
    }
}

/// A step of the lattice of lines, in subpixels.
fn step(gpu: &Gpu) -> i32 {
    SUBPIXELS >> gpu.about().line_subpixel_bits.clamp(0, 8)
}

fn draw(gpu: &mut Gpu, kind: Kind, lines: &[(usize, segment::Ends)]) -> Result<Pictures, Error> {
    let side = gpu.viewport_px();
    let cells = lines.last().map_or(0, |(cell, _)| cell + 1);
    let draws =
        lines.iter().map(|(cell, [a, b])| draw_of(*cell, plain(&[*a, *b, *b], side / 2.0), side));
    gpu.draw(kind, cells, draws.collect())
}

fn lit(pictures: &Pictures, cell: usize) -> Pixels {
    let rows = (0..CELL_PX).flat_map(|y| runs_of(y as i32, pictures.row(cell, y, CELL_PX)));
    rows.flat_map(|(run, _)| (run.x0_px..run.x1_px).map(move |x| (x, run.y_px))).collect()
}

fn class([_, allowed, outside]: [u64; 3]) -> Standing {
    Standing::of(allowed + outside == 0, outside == 0)
}

pub(super) fn apart(gpu: &mut Gpu, seed: u64, cases: u64, kind: Kind) -> Result<Outcome, Error> {
    let step = step(gpu);
    let mut places = Places::new("vulkan-lines", gpu, seed);
    let segments = (0..cases).map(|n| [places.point(n), places.point(n)]);
    let segments: Vec<_> = (0..).zip(segments.filter(|[a, b]| a != b)).collect();
    let pictures = draw(gpu, kind, &segments)?;
    let by = |rule: &dyn Fn(&segment::Ends, &Pixels) -> Fit| {
        let mut fits = [0u64; 3];
        for (cell, ends) in &segments {
            fits[rule(ends, &lit(&pictures, *cell)) as usize] += 1;
        }
        fits
    };
    let side = CELL_PX as i32;
    let rectangle = by(&|ends, lit| segment::rectangle(ends, lit, side, step));
    let parallelogram = by(&|ends, lit| segment::parallelogram(ends, lit, side, step));
    let diamond = by(&|ends, lit| segment::diamond_exit(ends, lit, side));
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
        if n % 2 == 1 {
            points.reverse();
        }
        let [a, b, c] = points;
        let is_wide = |a: SubpixelPoint, b: SubpixelPoint| (b.x - a.x).abs() > (b.y - a.y).abs();
        if is_wide(a, b) && is_wide(b, c) {
            let cell = lines.len() / 2;
            // Half of them the other way round: rows for columns.
            let turned = |p: SubpixelPoint| match n / 2 % 2 {
                0 => p,
                _ => SubpixelPoint::new(p.y, p.x),
            };
            let [a, b, c] = [a, b, c].map(turned);
            lines.extend([(cell, [a, b]), (cell, [b, c])]);
        }
    }
    let pictures = draw(gpu, Kind::BresenhamLines, &lines)?;
    let (mut twice, mut gaps, mut example) = (0u64, 0u64, String::new());
    for (cell, pair) in (0..).zip(lines.chunks_exact(2)) {
        let mut hits = (0..CELL_PX).flat_map(|y| pictures.row(cell, y, CELL_PX));
        twice += u64::from(hits.any(|hits| *hits > 1));
        let [a, c] = [pair[0].1[0], pair[1].1[1]];
        let is_wide = (c.x - a.x).abs() >= (c.y - a.y).abs();
        let mut lit: Vec<_> = lit(&pictures, cell).into_iter().collect();
        lit.sort_by_key(|&(x, y)| if is_wide { (x, y) } else { (y, x) });
        let touch = |p: &[(i32, i32)]| (p[0].0 - p[1].0).abs() <= 1 && (p[0].1 - p[1].1).abs() <= 1;
        if let Some(gap) = lit.windows(2).find(|pixels| !touch(pixels)) {
            gaps += 1;
            if example.is_empty() {
                let [a, b, c] = [a, pair[0].1[1], c].map(|p| p.to_px());
                let [before, after] = [gap[0], gap[1]];
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
