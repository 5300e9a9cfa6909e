//! The scanline engine: the book's split-triangle fill (chapters 2, 3 and 5), repaired.
//!
//! A triangle is sorted by y and walked row by row between its long edge and, first, the upper,
//! then, the lower short edge. What differs from the book, and why:
//! - The split vertex is never computed. A rounded split vertex bends the long edge.
//! - Edges are walked by an exact integer DDA. `sx += dx` in floats drifts.
//! - Row and column ranges are half-open and start at the first *centre* inside,
//!   ceil(x - 1/2): shared edges are drawn once, and the result is the top-left rule.
//! - Attributes (`values`) are taken at the pixel centre, from the exact distance of the centre to the edges,
//!   so no parameter ever leaves [0, 1] and the book's clamps have nothing to do.
//!
//! It does not clip, cull, depth-test or shade.

#[doc(hidden)]
pub mod probe;
#[doc(hidden)]
pub mod steps;
mod values;

use std::ops::Range;

use crate::contract::Rasterize;
use crate::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use crate::select::select_unpredictable;
use crate::triangle::{Corners, Span};

/// The scanline engine; see the module's description.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scanline;

impl Rasterize for Scanline {
    #[inline]
    fn cover(&self, mut corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        sort_by_height(&mut corners, |corner| *corner);
        walk(&corners, bounds, |span, _| emit(span));
    }
}

/// Sorts from the top down; equal heights from left to right, so that any order of the vertices
/// leads to the same walk. Selects instead of branching: nothing predicts the order of vertices,
/// and mispredicted branches took a quarter of the time of a triangle of three pixels.
#[inline]
fn sort_by_height<T: Copy>(items: &mut [T; 3], position: impl Fn(&T) -> SubpixelPoint) {
    // y, then x, in one number that compares as the pair does.
    let key = |item: &T| {
        let SubpixelPoint { x, y } = position(item);
        (i64::from(y) << 32) | i64::from(x.abs_diff(i32::MIN))
    };
    let sort = |a: T, b: T| {
        let swap = key(&b) < key(&a);
        (select_unpredictable(swap, b, a), select_unpredictable(swap, a, b))
    };
    let [a, b, c] = *items;
    let (a, b) = sort(a, b);
    let (b, c) = sort(b, c);
    let (a, b) = sort(a, b);
    *items = [a, b, c];
}

/// The edges by number, as the numbers of sorted vertices from top to bottom.
const EDGES: [[usize; 2]; 3] = [[0, 2], [0, 1], [1, 2]];
const LONG: u8 = 0;
const UPPER: u8 = 1;
const LOWER: u8 = 2;

/// Which of [`EDGES`] bounds a span on either side.
#[derive(Clone, Copy)]
struct Sides {
    left: u8,
    right: u8,
    /// The first column of the whole row, whatever the window shows of it.
    first_px: i32,
}

/// Walks the rows of a triangle whose corners are sorted by [`sort_by_height`].
#[inline]
fn walk(corners: &Corners, bounds: PixelRect, mut emit: impl FnMut(Span, Sides)) {
    let [top, middle, bottom] = *corners;
    // The first row whose centre is not above a corner: rows are half-open [top, bottom).
    let [first, split, end] = [first_centre(top.y), first_centre(middle.y), first_centre(bottom.y)];
    let (y0, y1) = (first.max(bounds.y0), end.min(bounds.y1));
    if y0 >= y1 || bounds.x0 >= bounds.x1 {
        return;
    }
    let (x_low, x_high) = (i64::from(bounds.x0), i64::from(bounds.x1));
    let mut long = EdgeWalk::new(top, bottom, y0);
    // Begin with the short edge that crosses the first row; an upper one gives way at `turn`.
    let starts_low = split <= y0;
    let turn = if starts_low { y1 } else { split };
    let mut short = EdgeWalk::new(
        select_unpredictable(starts_low, middle, top),
        select_unpredictable(starts_low, bottom, middle),
        y0,
    );
    for y_px in y0..y1 {
        if y_px == turn {
            short = EdgeWalk::new(middle, bottom, y_px);
        }
        // Both columns are the first centre right of an edge, so the smaller one begins the span
        // and the larger one ends it: no test of orientation is needed.
        let first = long.column.min(short.column);
        let x0 = first.max(x_low);
        let x1 = long.column.max(short.column).min(x_high);
        if x0 < x1 {
            let short_edge = if y_px < split { UPPER } else { LOWER };
            let (left, right) =
                if long.column <= short.column { (LONG, short_edge) } else { (short_edge, LONG) };
            // Columns of the triangle lie in the domain, so all three fit i32.
            let span = Span { y_px, x0_px: x0 as i32, x1_px: x1 as i32 };
            emit(span, Sides { left, right, first_px: first as i32 });
        }
        long.step();
        short.step();
    }
}

/// A span and its sides.
type Row = (Span, Sides);

/// [`walk`] with its spans handed on in batches: compiled once, whatever the values are.
fn walk_in_batches(corners: &Corners, bounds: PixelRect, take: &mut dyn FnMut(&[Row])) {
    let none = Sides { left: LONG, right: LONG, first_px: 0 };
    let mut batch = [(Span { y_px: 0, x0_px: 0, x1_px: 0 }, none); 16];
    let mut len = 0;
    walk(corners, bounds, |span, sides| {
        batch[len] = (span, sides);
        len += 1;
        if len == batch.len() {
            take(&batch);
            len = 0;
        }
    });
    take(&batch[..len]);
}

/// The first pixel whose centre is at or after `sub`: ceil((sub - S/2) / S).
#[inline]
pub(crate) fn first_centre(sub: i32) -> i32 {
    // The result is within 2^23, and the sum needs 33 bits.
    ((i64::from(sub) + i64::from(HALF_PIXEL - 1)) >> SUBPIXEL_BITS) as i32
}

/// Centre of pixel `px` in subpixels.
#[inline]
fn centre(px: i32) -> i64 {
    (i64::from(px) << SUBPIXEL_BITS) + i64::from(HALF_PIXEL)
}

/// Quotient and remainder of n / d for d > 0, rounded down, so that the remainder is in [0, d).
#[inline]
fn floor_div(n: i64, d: i64) -> (i64, i64) {
    // A 64-bit division costs up to four times a 32-bit one, and most edges are short. The guard
    // says what the caller promises, and saves the checks of a division.
    let (quotient, remainder) = match (i32::try_from(n), i32::try_from(d)) {
        (Ok(n), Ok(d)) if d > 0 => (i64::from(n / d), i64::from(n % d)),
        _ => (n / d, n % d),
    };
    let borrow = remainder >> 63;
    (quotient + borrow, remainder + (d & borrow))
}

/// An edge on its way down: for each row, the first column whose centre is not left of it.
///
/// The edge from (ax, ay) down to (bx, by) crosses the height yc of a row of centres at
/// x = ax + (yc - ay) dx / dy. The first centre i S + S/2 not left of x is
/// i = ceil(N / (S dy)) with N = (ax - S/2) dy + (yc - ay) dx; because ceilings nest, it is
/// ceil(M / dy) with M = ceil(N / S), and one row further down M grows by dx. So one division finds
/// the first column, a second one the step, and after that there are only additions:
/// column = ceil(M / dy), remainder = column dy - M, which stays in [0, dy).
#[derive(Clone, Copy)]
struct EdgeWalk {
    column: i64,
    remainder: i64,
    step_whole: i64,
    step_part: i64,
    dy: i64,
}

impl EdgeWalk {
    /// Starts at row `y_px`, whose centre lies in [a.y, b.y).
    ///
    /// Always inlined: returned through memory it costs a tenth of a triangle of three pixels.
    #[inline(always)]
    fn new(a: SubpixelPoint, b: SubpixelPoint, y_px: i32) -> Self {
        let dx = i64::from(b.x) - i64::from(a.x);
        let dy = i64::from(b.y) - i64::from(a.y);
        let down = centre(y_px) - i64::from(a.y);
        // Count columns from the pixel that holds a, so that the numbers stay small.
        let base = i64::from(a.x >> SUBPIXEL_BITS);
        let ax = i64::from(a.x & (SUBPIXELS - 1)) - i64::from(HALF_PIXEL);
        let numerator = if dx.abs().max(dy) < 1 << 30 {
            // |ax dy| <= 2^37 and |down dx| < 2^60.
            let n = ax * dy + down * dx;
            (n + i64::from(SUBPIXELS - 1)) >> SUBPIXEL_BITS
        } else {
            // |N| < 2^65, and a 256th of it fits i64.
            let n = i128::from(ax) * i128::from(dy) + i128::from(down) * i128::from(dx);
            ((n + i128::from(SUBPIXELS - 1)) >> SUBPIXEL_BITS) as i64
        };
        // ceil(M / dy) = -floor(-M / dy), and the remainder of the latter is column dy - M.
        let (minus_column, remainder) = floor_div(-numerator, dy);
        let (step_whole, step_part) = floor_div(dx, dy);
        Self { column: base - minus_column, remainder, step_whole, step_part, dy }
    }

    /// Goes down one row.
    #[inline]
    fn step(&mut self) {
        let remainder = self.remainder - self.step_part;
        // All ones where a column is carried, else 0. The carries of an edge follow no pattern that
        // a branch predictor learns, so adding a mask beats a branch.
        let carry = remainder >> 63;
        self.column += self.step_whole - carry;
        self.remainder = remainder + (self.dy & carry);
    }
}

/// The columns of the edge from `a` down to `b` in `rows`, as [`Scanline`] walks them: a window on
/// its arithmetic for `exhaust::edges`. Centres of `rows` lie in [a.y, b.y).
#[inline]
pub(crate) fn edge_columns(
    a: SubpixelPoint,
    b: SubpixelPoint,
    rows: Range<i32>,
) -> impl Iterator<Item = i64> {
    let mut walk = EdgeWalk::new(a, b, rows.start);
    rows.map(move |_| {
        let column = walk.column;
        walk.step();
        column
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows and columns by hand: the square 0..4 split on its diagonal, centres on the diagonal.
    #[test]
    fn a_half_square_by_hand() {
        let corner = |x, y| SubpixelPoint::new(x * 256, y * 256);
        let mut spans = Vec::new();
        Scanline.cover(
            [corner(0, 0), corner(4, 0), corner(4, 4)],
            PixelRect::window(8, 8),
            |span| {
                spans.push((span.y_px, span.x0_px, span.x1_px));
            },
        );
        // Centre (i + 1/2, i + 1/2) lies on the diagonal, which is a left edge here.
        assert_eq!(spans, [(0, 0, 4), (1, 1, 4), (2, 2, 4), (3, 3, 4)]);
        spans.clear();
        Scanline.cover(
            [corner(0, 0), corner(4, 4), corner(0, 4)],
            PixelRect::window(8, 8),
            |span| {
                spans.push((span.y_px, span.x0_px, span.x1_px));
            },
        );
        assert_eq!(spans, [(1, 0, 1), (2, 0, 2), (3, 0, 3)]);
    }

    /// The middle corner is the right one: the short edge changes at row 2, or the window cuts off
    /// one of the two. Column ends are at x = 2 y, then 8 - 2 y, with y at the centres.
    #[test]
    fn a_turn_by_hand() {
        let corner = |x, y| SubpixelPoint::new(x * 256, y * 256);
        let rows = [(0, 0, 1), (1, 0, 3), (2, 0, 3), (3, 0, 1)];
        for (y0, y1) in [(0, 4), (0, 2), (1, 3), (2, 4), (3, 9)] {
            let mut spans = Vec::new();
            let bounds = PixelRect { x0: 0, y0, x1: 8, y1 };
            Scanline.cover([corner(0, 0), corner(4, 2), corner(0, 4)], bounds, |span| {
                spans.push((span.y_px, span.x0_px, span.x1_px));
            });
            assert_eq!(spans, rows[y0 as usize..4.min(y1 as usize)], "rows {y0}..{y1}");
        }
    }
}
