//! Half-planes of triangles: E' at the first pixel of the box, and what it grows by.
//!
//! As everywhere, E(p) = dx (p.y - a.y) - dy (p.x - a.x) is positive inside, and
//! E' = floor((E - bias) / S) at the centres of pixels has the sign of the decision: bias is 0 where
//! samples with E = 0 belong to the triangle, on top and left edges, else 1. E' grows by -dy from
//! column to column and by dx from row to row, exactly, since centres lie S apart.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x16, mask32x16};

use super::SIDE_PX;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;

/// Triangles that are set up together.
pub(super) const LANES: usize = 16;

/// The largest side of a box, in subpixels, that is set up in i32: 180 px.
///
/// E at a point of the box is twice the area of a triangle in it, so |E| <= Wx Wy. Its two products
/// may be larger and wrap around; their difference is right all the same, modulo 2^32.
pub const NARROW_EXTENT: i32 = 180 * SUBPIXELS;
const _: () = assert!(
    (NARROW_EXTENT as i64 * NARROW_EXTENT as i64) < i32::MAX as i64,
    "E and E - bias fit i32"
);

/// More than a walk looks at beyond the box, which is less than a tile.
const PADDING: i64 = (2 * SIDE_PX * SUBPIXELS) as i64;

/// (Wx + padding) (Wy + padding) is below this where E' is stepped in i32, up to about 2,864 px
/// square: E' is E divided by S = 2^8.
pub const STEPPED_LIMIT: i128 = 1 << (31 + SUBPIXEL_BITS);
const _: () = {
    let padded = (NARROW_EXTENT as i64 + PADDING) as i128;
    assert!(padded * padded < STEPPED_LIMIT, "what is set up in i32 is stepped in i32");
};

/// The largest side of a box, in subpixels, of which E' fits i16: 11 px.
pub const NEAR_EXTENT: i32 = 11 * SUBPIXELS;
const _: () = assert!(
    NEAR_EXTENT * NEAR_EXTENT / SUBPIXELS < i16::MAX as i32,
    "E', and what it grows by, fit i16"
);

type Lanes<S> = i32x16<S>;

/// A triangle ready to be stepped in words of a kind.
#[derive(Clone, Copy, Debug)]
pub(super) struct SteppedTriangle<W> {
    /// The pixels to look at: those of the window in the box, at least one.
    pub rect: PixelRect,
    /// E' of each edge at the first pixel of `rect`.
    pub start: [W; 3],
    /// What E' grows by from column to column.
    pub right: [W; 3],
    /// What E' grows by from row to row.
    pub down: [W; 3],
}

/// Triangles whose corners are turned into columns at a time. More than are set up at a time: what is
/// stored number by number and loaded as a vector at once has to arrive in the cache before.
pub(super) const GROUP: usize = 4 * LANES;

/// Sixteen numbers, aligned for a whole vector: what is stored across two lines of the cache has to
/// arrive there before any of it is read.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Line(pub [i32; LANES]);

/// The corners of a group side by side: x and y of a, b and c, sixteen triangles each.
pub(super) struct Columns([[Line; 6]; GROUP / LANES]);

impl Default for Columns {
    fn default() -> Self {
        Self([[Line([0; LANES]); 6]; GROUP / LANES])
    }
}

impl Columns {
    #[inline(always)]
    pub fn turn(&mut self, triangles: &[Corners]) {
        for (lines, triangles) in self.0.iter_mut().zip(triangles.chunks(LANES)) {
            if triangles.len() < LANES {
                // Lanes without a triangle stay at zero, which has no area.
                *lines = [Line([0; LANES]); 6];
            }
            for (lane, [a, b, c]) in triangles.iter().enumerate().take(LANES) {
                (lines[0].0[lane], lines[1].0[lane]) = (a.x, a.y);
                (lines[2].0[lane], lines[3].0[lane]) = (b.x, b.y);
                (lines[4].0[lane], lines[5].0[lane]) = (c.x, c.y);
            }
        }
    }

    /// Sets up sixteen triangles.
    #[inline(always)]
    pub fn batch<S: Simd>(&self, simd: S, at: usize, bounds: PixelRect) -> Batch<S> {
        let lines = &self.0[at & (GROUP / LANES - 1)];
        let (ax, ay) = (load(simd, &lines[0]), load(simd, &lines[1]));
        let (bx, by) = (load(simd, &lines[2]), load(simd, &lines[3]));
        let (cx, cy) = (load(simd, &lines[4]), load(simd, &lines[5]));
        let (extent_x, x0, x1) = side([ax, bx, cx], bounds.x0, bounds.x1);
        let (extent_y, y0, y1) = side([ay, by, cy], bounds.y0, bounds.y1);
        let fits = within(extent_x, NARROW_EXTENT) & within(extent_y, NARROW_EXTENT);
        let visible = x0.simd_lt(x1) & y0.simd_lt(y1);
        let area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        let zero = Lanes::splat(simd, 0);
        // Clockwise, so that the inside is where E > 0.
        let turn = area.simd_lt(zero);
        let (bx, cx) = (turn.select(cx, bx), turn.select(bx, cx));
        let (by, cy) = (turn.select(cy, by), turn.select(by, cy));
        let px = (x0 << SUBPIXEL_BITS) + HALF_PIXEL;
        let py = (y0 << SUBPIXEL_BITS) + HALF_PIXEL;
        let a = edge(simd, [bx, by, cx, cy], px, py);
        let b = edge(simd, [cx, cy, ax, ay], px, py);
        let c = edge(simd, [ax, ay, bx, by], px, py);
        let narrow = visible & fits & !area.simd_eq(zero);
        Batch {
            narrow,
            near: narrow & extent_x.simd_le(NEAR_EXTENT) & extent_y.simd_le(NEAR_EXTENT),
            wide: visible & !fits,
            rect: [x0, y0, x1, y1],
            start: [a[0], b[0], c[0]],
            right: [a[1], b[1], c[1]],
            down: [a[2], b[2], c[2]],
        }
    }
}

/// Sixteen triangles or less, one a lane.
pub(super) struct Batch<S: Simd> {
    /// Whether it may cover a pixel, and is set up.
    pub narrow: mask32x16<S>,
    /// Whether it is narrow, and E' fits i16 in all of its box.
    pub near: mask32x16<S>,
    /// Whether it may cover a pixel, and is too large to be set up here.
    pub wide: mask32x16<S>,
    /// As in [`SteppedTriangle`], x0, y0, x1 and y1.
    pub rect: [Lanes<S>; 4],
    pub start: [Lanes<S>; 3],
    pub right: [Lanes<S>; 3],
    pub down: [Lanes<S>; 3],
}

impl<S: Simd> Batch<S> {
    /// Bit i: what the window shows of the box of triangle i has at most `side_px` columns and rows.
    #[inline(always)]
    pub fn at_most(&self, side_px: i32) -> u32 {
        let [x0, y0, x1, y1] = self.rect;
        ((x1 - x0).simd_le(side_px) & (y1 - y0).simd_le(side_px)).to_bitmask() as u32
    }

    /// Number by number, in memory.
    #[inline(always)]
    pub fn records(&self) -> Records {
        let ([x0, y0, x1, y1], [a, b, c]) = (self.rect, self.start);
        let ([ra, rb, rc], [da, db, dc]) = (self.right, self.down);
        let mut records = Records::default();
        let numbers = [x0, y0, x1, y1, a, b, c, ra, rb, rc, da, db, dc];
        for (line, number) in records.0.iter_mut().zip(numbers) {
            line.0 = number.to_array();
        }
        records
    }
}

/// x0, y0, x1, y1 of the rect, three starts, three steps to the right, three down; of each sixteen triangles.
pub(super) struct Records([Line; 13]);

impl Default for Records {
    fn default() -> Self {
        Self([Line([0; LANES]); 13])
    }
}

impl Records {
    /// The pixels of the window in the box of a triangle.
    #[inline(always)]
    pub fn rect(&self, lane: usize) -> PixelRect {
        let number = |at: usize| self.0[at].0[lane];
        PixelRect { x0: number(0), y0: number(1), x1: number(2), y1: number(3) }
    }

    #[inline(always)]
    pub fn stepped(&self, lane: usize) -> SteppedTriangle<i32> {
        let three =
            |at: usize| [self.0[at].0[lane], self.0[at + 1].0[lane], self.0[at + 2].0[lane]];
        SteppedTriangle { rect: self.rect(lane), start: three(4), right: three(7), down: three(10) }
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, values: &Line) -> Lanes<S> {
    Lanes::load_array_ref(simd, &values.0)
}

/// Whether a side of a box is that long at most. One of 2^31 and more has wrapped around to below zero.
#[inline(always)]
fn within<S: Simd>(extent: Lanes<S>, limit: i32) -> mask32x16<S> {
    extent.simd_ge(0) & extent.simd_le(limit)
}

/// Of the coordinates of the corners on one axis: the extent of their box, and its first pixel and the
/// one past its last within the window.
#[inline(always)]
fn side<S: Simd>(
    [a, b, c]: [Lanes<S>; 3],
    from_px: i32,
    to_px: i32,
) -> (Lanes<S>, Lanes<S>, Lanes<S>) {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    // ceil((low - S/2) / S) and floor((high + S/2) / S), with nothing that leaves i32 on the way:
    // of the first centre at or after `low`, and the last one at or before `high`.
    let first =
        (low >> SUBPIXEL_BITS) + (((low & (SUBPIXELS - 1)) + (HALF_PIXEL - 1)) >> SUBPIXEL_BITS);
    let end = (high >> SUBPIXEL_BITS) + (((high & (SUBPIXELS - 1)) + HALF_PIXEL) >> SUBPIXEL_BITS);
    (high - low, first.max(from_px), end.min(to_px))
}

/// E' at a point, and its steps to the right and down, of the edges from `[x, y, ..]` to `[.., x, y]`.
#[inline(always)]
fn edge<S: Simd>(
    simd: S,
    [from_x, from_y, to_x, to_y]: [Lanes<S>; 4],
    px: Lanes<S>,
    py: Lanes<S>,
) -> [Lanes<S>; 3] {
    let (zero, one) = (Lanes::splat(simd, 0), Lanes::splat(simd, 1));
    let (dx, dy) = (to_x - from_x, to_y - from_y);
    let value = dx * (py - from_y) - dy * (px - from_x);
    // With y down and the inside where E > 0, a left edge goes up and a top edge to the right.
    let top_left = dy.simd_lt(zero) | (dy.simd_eq(zero) & dx.simd_gt(zero));
    [(value - top_left.select(zero, one)) >> SUBPIXEL_BITS, zero - dy, dx]
}

/// A triangle of any size, set up by itself.
pub(super) struct Single {
    /// As it is stepped in i64, which always holds E': |E| < 2^65, and S is 2^8.
    pub steps: SteppedTriangle<i64>,
    fits_i32: bool,
}

impl Single {
    /// Nothing where the triangle has no area. `rect` is as [`Records::rect`] has it.
    pub fn new([a, b, c]: &Corners, rect: PixelRect) -> Option<Self> {
        let area = exact(a, b, i64::from(c.x), i64::from(c.y));
        let (b, c) = if area < 0 { (c, b) } else { (b, c) };
        let edges = [(b, c), (c, a), (a, b)];
        let centre = |px: i32| i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL);
        let (px, py) = (centre(rect.x0), centre(rect.y0));
        let mut steps = SteppedTriangle { rect, start: [0; 3], right: [0; 3], down: [0; 3] };
        for (i, (from, to)) in edges.into_iter().enumerate() {
            let (dx, dy) =
                (i64::from(to.x) - i64::from(from.x), i64::from(to.y) - i64::from(from.y));
            let top_left = dy < 0 || (dy == 0 && dx > 0);
            let value = exact(from, to, px, py) - i128::from(!top_left);
            steps.start[i] = (value >> SUBPIXEL_BITS) as i64;
            (steps.right[i], steps.down[i]) = (-dy, dx);
        }
        let padded = |a: i32, b: i32, c: i32| {
            i128::from(a.max(b).max(c)) - i128::from(a.min(b).min(c)) + i128::from(PADDING)
        };
        let fits_i32 = padded(a.x, b.x, c.x) * padded(a.y, b.y, c.y) < STEPPED_LIMIT;
        (area != 0).then_some(Self { steps, fits_i32 })
    }

    /// The same in i32, where that is wide enough.
    pub fn stepped(&self) -> Option<SteppedTriangle<i32>> {
        let SteppedTriangle { rect, start, right, down } = self.steps;
        let word = |values: [i64; 3]| values.map(|value| value as i32);
        let all =
            SteppedTriangle { rect, start: word(start), right: word(right), down: word(down) };
        self.fits_i32.then_some(all)
    }
}

/// E of the edge between two points, at a third.
fn exact(from: &SubpixelPoint, to: &SubpixelPoint, x_sub: i64, y_sub: i64) -> i128 {
    let across = |to: i64, from: i32| i128::from(to - i64::from(from));
    across(i64::from(to.x), from.x) * across(y_sub, from.y)
        - across(i64::from(to.y), from.y) * across(x_sub, from.x)
}
