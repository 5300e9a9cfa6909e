//! The edge lemma: for every edge and every row of centres it crosses, the scanline engine's column
//! is where the edge function's decision changes.
//!
//! Claim. Let a be the upper and b the lower end of an edge on the lattice of the window. For each
//! row of centres in [a.y, b.y):
//! 1. the column C of the scanline engine's integer walk is the first centre at or right of the
//!    crossing: with exact D(c) = (xc - a.x) dy - (yc - a.y) dx, D(C) >= 0 and D(C - 1) < 0;
//! 2. the edge function, run as a left edge (from b up to a, bias 0), is non-negative exactly in
//!    the columns c >= C;
//! 3. run as a right edge (from a down to b, bias 1), exactly in the columns c < C.
//!
//! And for an edge with dy = 0: the edge function, run as a top edge, is non-negative exactly in
//! the rows from the scanline engine's first row on; run as a bottom edge, exactly in those before.
//!
//! All columns follow from four. E' grows by a constant from column to column, in the engine by
//! construction, here checked to be dy > 0 for the left edge. So {c : E' < 0} is a prefix of all
//! columns. In a window of at most four pixels the crossing is not right of the last centre by more
//! than half a pixel, so C is 0 to 4, and stepping through columns 0..4 and counting the negative
//! ones gives the length of that prefix. The right edge starts at the bitwise complement
//! -1 - E' and its steps are the negated ones (all checked), so by induction it is the complement
//! in every column and row.
//!
//! All edges follow from those with the upper end in the first row of pixels and the left end in
//! the first column of pixels. An edge of the window with dy > 0 has one upper end; shift it by
//! whole pixels, up by floor(a.y) and left by floor(min(a.x, b.x)): what was inside [0, W] stays
//! inside, and the two minima are now in [0, 1) px. The shift changes nothing but the offset that is
//! added to C: the scanline engine splits a.x into whole pixels, which it only adds, and a part of
//! a pixel, and uses y in differences; the edge function uses differences alone. That the engines
//! commute with such shifts is not taken on trust either: `every_position` enumerates without the
//! shift, and `offset_px` moves the window far away.
//!
//! A walk starts in the edge's first row here, as it does for every triangle inside its bounds. A
//! start further down, where the bounds cut a triangle, is not part of the claim.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::{Enumeration, Source, Tally, common_words};
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use rasterproof_core::raster::edge_function::probe::edge_steps;
use rasterproof_core::raster::scanline::probe::{edge_columns, first_centre};
use rasterproof_core::source_text;

/// The fault that can be planted: the edge function samples one subpixel further left, which is what it
/// does when the edge lies one further right.
pub const PLANT: &str = "sample-off-by-one-subpixel";
/// Blocks that the lower ends are dealt in, for each height of the upper end.
const BLOCKS: u64 = 16;
const COLUMNS: i32 = 4;

/// All edges of a window, up to shifts by whole pixels unless `every_position`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edges {
    /// Side of the window in pixels, 1 to 4.
    pub window_px: u32,
    /// Bits below the pixel, at most 8.
    pub subpixel_bits: u32,
    pub offset_px: [i32; 2],
    /// Every edge at every place in the window.
    pub every_position: bool,
    pub plant: Option<String>,
}

impl Enumeration for Edges {
    fn claim(&self) -> String {
        let shift = if self.every_position {
            "at every position in it"
        } else {
            "modulo shifts by whole pixels"
        };
        format!(
            "For every undirected edge between two different points of the lattice with {} subpixel bits in a \
             {}x{} px window, {shift}, and every row of centres it crosses: the scanline engine's integer DDA \
             column is the first centre at or right of the exact crossing, and the edge-function engine's \
             biased 32-bit integer decision is non-negative exactly from that column on as a left edge and \
             exactly before it as a right edge; for every horizontal edge, exactly from the scanline engine's \
             first row on as a top edge and exactly before it as a bottom edge. Each comparison is one edge in \
             one row; walks start in the edge's first row.",
            self.subpixel_bits, self.window_px, self.window_px
        )
    }

    fn chunks(&self) -> u64 {
        // Block by block: neighbouring chunks differ in the upper end alone and cost the same, so
        // dealing them to shards in turn is fair.
        BLOCKS * self.upper_heights()
    }

    fn expected_cases(&self) -> u64 {
        let (n, tops) = (self.points() - 1, self.upper_heights());
        // Pairs low < high with low in 0..tops and high <= n.
        let pairs = tops * n - tops * (tops - 1) / 2;
        // Upper end left or right or above the lower one; then the horizontal edges.
        let vertical = tops.min(n + 1);
        pairs * (2 * pairs + vertical) + tops * pairs
    }

    fn expected_oracle_checks(&self) -> u64 {
        0
    }

    fn judge(&self) -> Box<dyn Fn(u64) -> Tally + Sync + Send + '_> {
        if self.plant.is_some() {
            Box::new(|chunk| self.chunk::<true>(chunk))
        } else {
            Box::new(|chunk| self.chunk::<false>(chunk))
        }
    }

    fn words(&self) -> String {
        let every = if self.every_position { " --every-position" } else { "" };
        let common = common_words(self.offset_px, self.plant.as_deref());
        format!(
            "edges --window {} --subpixel-bits {}{every}{common}",
            self.window_px, self.subpixel_bits
        )
    }

    fn sources(&self) -> Vec<Source> {
        vec![
            Source::file("src/grid.rs", source_text::GRID),
            Source {
                path: "src/raster/scanline.rs",
                text: source_text::SCANLINE,
                items: &[
                    "fn first_centre",
                    "fn centre",
                    "fn floor_div",
                    "struct EdgeWalk",
                    "impl EdgeWalk",
                    "fn edge_columns",
                ],
            },
            Source {
                path: "src/raster/edge_function.rs",
                text: source_text::EDGE_FUNCTION,
                items: &[
                    "trait Exact",
                    "impl Exact for i64",
                    "trait Word",
                    "macro_rules! word",
                    "word!(",
                    "fn centre",
                    "struct Edge",
                    "impl Edge",
                    "fn edge_steps",
                ],
            },
            Source {
                path: "src/exhaust/edges.rs",
                text: include_str!("edges.rs"),
                items: &["const BLOCKS", "const COLUMNS", "struct Slab", "impl Edges", "impl Slab"],
            },
        ]
    }
}

/// The edges between two heights, in what they have in common.
struct Slab {
    /// Subpixels, in the window.
    upper: i32,
    dy: i32,
    rows: Range<i32>,
    offset_px: [i32; 2],
}

impl Edges {
    /// Points along a side of the lattice.
    fn points(&self) -> u64 {
        (u64::from(self.window_px) << self.subpixel_bits) + 1
    }

    /// How many heights the upper end takes, and columns the left end.
    fn upper_heights(&self) -> u64 {
        if self.every_position { self.points() } else { 1 << self.subpixel_bits }
    }

    /// Subpixels of the engines' lattice from one point to the next.
    fn spacing(&self) -> i32 {
        1 << (SUBPIXEL_BITS - self.subpixel_bits)
    }

    /// The edges from one height down to a block of others, and with the first block the level ones.
    fn chunk<const PLANTED: bool>(&self, chunk: u64) -> Tally {
        let mut tally = Tally::default();
        let (block, upper) = (chunk / self.upper_heights(), chunk % self.upper_heights());
        let n = self.points() - 1;
        if block == 0 {
            self.horizontal(chunk, upper as i32, &mut tally);
        }
        for lower in (block * n / BLOCKS).max(upper) + 1..(block + 1) * n / BLOCKS + 1 {
            self.between::<PLANTED>(chunk, upper as i32, lower as i32, &mut tally);
        }
        tally
    }

    /// All edges whose ends have these heights, in points. Walks along equal slopes, since then the
    /// engine's second division is the same for all of them.
    fn between<const PLANTED: bool>(&self, chunk: u64, upper: i32, lower: i32, tally: &mut Tally) {
        let (n, lefts) = ((self.points() - 1) as i32, self.upper_heights() as i32);
        let spacing = self.spacing();
        let [_, y] = self.offset_px.map(|px| px * SUBPIXELS);
        let slab = Slab {
            upper: upper * spacing,
            dy: (lower - upper) * spacing,
            rows: first_centre(upper * spacing + y)..first_centre(lower * spacing + y),
            offset_px: self.offset_px,
        };
        for run in -n..=n {
            // The left end is the upper one where the edge runs right, else the lower one.
            let lefts = 0..lefts.min(n - run.abs() + 1);
            tally.cases += lefts.len() as u64;
            if slab.rows.is_empty() {
                continue;
            }
            tally.comparisons += lefts.len() as u64 * slab.rows.len() as u64;
            let dx = run * spacing;
            for left in lefts {
                let ax = left * spacing + (-dx).max(0);
                let wrong = slab.wrong_rows::<PLANTED>(ax, dx);
                if wrong != 0 {
                    tally.wrong(chunk, || slab.describe(ax, dx, wrong));
                }
            }
        }
    }

    /// The horizontal edges of this height, in points.
    fn horizontal(&self, chunk: u64, height: i32, tally: &mut Tally) {
        let (n, lefts) = ((self.points() - 1) as i32, self.upper_heights() as i32);
        let spacing = self.spacing();
        let [x, y] = self.offset_px.map(|px| px * SUBPIXELS);
        let first = first_centre(height * spacing + y) - self.offset_px[1];
        for left in 0..lefts {
            for right in left + 1..=n {
                tally.cases += 1;
                tally.comparisons += 1;
                let y_sub = height * spacing + y;
                let [a, b] =
                    [left, right].map(|point| SubpixelPoint::new(point * spacing + x, y_sub));
                let top = edge_steps(a, b, self.offset_px[0], self.offset_px[1]);
                let bottom = edge_steps(b, a, self.offset_px[0], self.offset_px[1]);
                let grows = top[1] == 0 && top[2] == (right - left) * spacing;
                let complement = bottom[0] == !top[0] && bottom[1] == 0 && bottom[2] == -top[2];
                let above = (0..COLUMNS).filter(|row| top[0] + row * top[2] < 0).count();
                if !grows || !complement || i64::from(first) != above as i64 {
                    tally.wrong(chunk, || {
                        format!("horizontal edge {a:?} {b:?}: first row {first}, edge function {top:?} {bottom:?}")
                    });
                }
            }
        }
    }
}

impl Slab {
    /// The ends of the edge in subpixels, where the engines see it.
    #[inline]
    fn ends(&self, ax: i32, dx: i32) -> [SubpixelPoint; 2] {
        let [x, y] = self.offset_px.map(|px| px * SUBPIXELS);
        [
            SubpixelPoint::new(ax + x, self.upper + y),
            SubpixelPoint::new(ax + dx + x, self.upper + self.dy + y),
        ]
    }

    /// Not 0 if the claim fails for the edge that starts at `ax` and runs `dx` subpixels. All
    /// comparisons are collected as differing bits: there is no branch to mispredict.
    #[inline]
    fn wrong_rows<const PLANTED: bool>(&self, ax: i32, dx: i32) -> i32 {
        let [a, b] = self.ends(ax, dx);
        let [x0, _] = self.offset_px;
        let off = i32::from(PLANTED);
        let [ea, eb] = [a, b].map(|end| SubpixelPoint::new(end.x + off, end.y));
        let [mut left, right, down] = edge_steps(eb, ea, x0, self.rows.start);
        let [other, other_right, other_down] = edge_steps(ea, eb, x0, self.rows.start);
        // The steps are as the claim needs them, and the right edge is the complement.
        let mut wrong = right ^ self.dy;
        wrong |= (other ^ !left) | (other_right + right) | (other_down + down);
        // D at column 0 of the window, from the position in the window alone: |D| < 2^22.
        let row = (self.rows.start - self.offset_px[1]) * SUBPIXELS + HALF_PIXEL;
        let mut exact = (HALF_PIXEL - ax) * self.dy - (row - self.upper) * dx;
        let width = SUBPIXELS * self.dy;
        for column in edge_columns(a, b, self.rows.clone()) {
            let column = column as i32 - x0;
            let before = exact + column * width;
            wrong |= i32::from(before < 0) | i32::from(before >= width);
            // Count the negative columns by their sign bits.
            let mut e = left;
            let mut outside = 0;
            for _ in 0..COLUMNS {
                outside -= e >> 31;
                e += right;
            }
            wrong |= outside ^ column;
            left += down;
            exact -= dx * SUBPIXELS;
        }
        wrong
    }

    #[cold]
    fn describe(&self, ax: i32, dx: i32, wrong: i32) -> String {
        let ends = self.ends(ax, dx);
        let columns: Vec<_> = edge_columns(ends[0], ends[1], self.rows.clone()).collect();
        let steps = edge_steps(ends[1], ends[0], self.offset_px[0], self.rows.start);
        format!(
            "edge {:?} {:?}, rows {:?}: scanline columns {columns:?}, edge function {steps:?} (bits {wrong:#x})",
            ends[0], ends[1], self.rows
        )
    }
}

#[cfg(test)]
mod tests {
    use rasterproof_core::grid::SUBPIXELS;
    use rasterproof_core::raster::edge_function::WordWidth;

    /// `edge_steps` is what the engine does with every triangle of the window.
    #[test]
    fn the_window_is_stepped_in_32_bits() {
        let side = super::super::MAX_WINDOW_PX * SUBPIXELS as u32;
        assert_eq!(WordWidth::of(side, side), WordWidth::I32);
    }
}
