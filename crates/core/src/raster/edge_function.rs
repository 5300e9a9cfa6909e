//! The edge-function engine: every pixel of the bounding box is tested against three half-planes.
//!
//! Sources: Pineda 1988, "A Parallel Algorithm for Polygon Rasterization"; GAMES101 homework 2;
//! SYSU assignment 2, task 4. What differs from the two assignments: positions are 24.8 fixed point
//! instead of floats or whole pixels, the three functions are exact integers in the narrowest word
//! that can hold them, and a top-left bias decides the samples on an edge, where the homework's
//! strict test leaves holes and the assignment's inclusive one draws twice.
//!
//! It visits the whole box by design: that is the price of its simplicity on slivers. It does not
//! clip, cull, depth-test or shade.

#[doc(hidden)]
pub mod probe;
mod values;
#[doc(hidden)]
pub mod words;

use std::ops::{Add, BitOr};

use crate::contract::Rasterize;
use crate::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use crate::select::select_unpredictable;
use crate::triangle::{Corners, Span};

/// The edge-function engine; see the module's description.
#[derive(Clone, Copy, Debug, Default)]
pub struct EdgeFunction;

impl Rasterize for EdgeFunction {
    #[inline]
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
        let (extent_x, extent_y) = extents(&corners);
        match WordWidth::of(extent_x, extent_y) {
            WordWidth::I32 => cover_in::<i64, i32>(corners, bounds, emit),
            WordWidth::I64 => cover_in::<i64, i64>(corners, bounds, emit),
            WordWidth::I128 => cover_in::<i128, i128>(corners, bounds, emit),
        }
    }
}

/// The integer word that holds the edge functions of a triangle while they are stepped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordWidth {
    /// Stepped in 32 bits, after one exact division by the subpixels of a pixel.
    I32,
    /// Stepped in 64 bits.
    I64,
    /// Stepped in 128 bits.
    I128,
}

impl WordWidth {
    /// The narrowest word for a triangle whose bounding box is `extent_x` by `extent_y` subpixels.
    ///
    /// Samples lie in the box, so |E| <= Wx Wy, and (Wx + S)(Wy + S) covers the one step past its
    /// border. E' = floor((E - bias) / S) needs 8 bits less, so 32 bits hold it up to about 2896 px
    /// square. E itself is computed before the division and needs 64 bits there.
    #[must_use]
    #[inline]
    pub fn of(extent_x: u32, extent_y: u32) -> Self {
        let padded = |extent: u32| u128::from(extent) + SUBPIXELS as u128;
        let bound = padded(extent_x) * padded(extent_y);
        if bound >> SUBPIXEL_BITS < 1 << 31 {
            Self::I32
        } else if bound < 1 << 63 {
            Self::I64
        } else {
            Self::I128
        }
    }
}

/// Width and height of the bounding box in subpixels; the widest one is 2^32 - 1.
#[inline]
fn extents(corners: &Corners) -> (u32, u32) {
    let extent = |a: i32, b: i32, c: i32| a.max(b).max(c).abs_diff(a.min(b).min(c));
    let [a, b, c] = corners;
    (extent(a.x, b.x, c.x), extent(a.y, b.y, c.y))
}

/// The exact integers an edge function is set up in: i64 while Wx Wy < 2^63, else i128.
trait Exact: Copy {
    /// a b - c d.
    fn cross(a: i64, b: i64, c: i64, d: i64) -> Self;
    fn sign(self) -> i32;
    /// floor((self - bias) / S).
    fn biased_floor(self, bias: i64) -> i128;
    fn to_f64(self) -> f64;
}

impl Exact for i64 {
    #[inline]
    fn cross(a: i64, b: i64, c: i64, d: i64) -> Self {
        a * b - c * d
    }
    #[inline]
    fn sign(self) -> i32 {
        self.signum() as i32
    }
    #[inline]
    fn biased_floor(self, bias: i64) -> i128 {
        i128::from((self - bias) >> SUBPIXEL_BITS)
    }
    #[inline]
    fn to_f64(self) -> f64 {
        self as f64
    }
}

impl Exact for i128 {
    #[inline]
    fn cross(a: i64, b: i64, c: i64, d: i64) -> Self {
        Self::from(a) * Self::from(b) - Self::from(c) * Self::from(d)
    }
    #[inline]
    fn sign(self) -> i32 {
        self.signum() as i32
    }
    #[inline]
    fn biased_floor(self, bias: i64) -> i128 {
        (self - Self::from(bias)) >> SUBPIXEL_BITS
    }
    #[inline]
    fn to_f64(self) -> f64 {
        self as f64
    }
}

/// The word edge functions are stepped in.
trait Word: Copy + Add<Output = Self> + BitOr<Output = Self> {
    /// The caller has checked, through [`WordWidth::of`], that `value` fits.
    fn narrow(value: i128) -> Self;
    fn is_negative(self) -> bool;
}

macro_rules! word {
    ($($word:ty),*) => {$(
        impl Word for $word {
            #[inline]
            fn narrow(value: i128) -> Self {
                debug_assert!(Self::try_from(value).is_ok(), "{value} does not fit the chosen word");
                value as Self
            }
            #[inline]
            fn is_negative(self) -> bool {
                self < 0
            }
        }
    )*};
}
word!(i32, i64, i128);

/// Centre of pixel `px` in subpixels.
#[inline]
fn centre(px: i32) -> i64 {
    i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL)
}

/// The edge from `from` to `to` of a triangle whose inside is where E > 0.
#[derive(Clone, Copy)]
struct Edge {
    from: SubpixelPoint,
    dx: i64,
    dy: i64,
}

impl Edge {
    #[inline]
    fn new(from: SubpixelPoint, to: SubpixelPoint) -> Self {
        Self {
            from,
            dx: i64::from(to.x) - i64::from(from.x),
            dy: i64::from(to.y) - i64::from(from.y),
        }
    }

    /// E(p) = dx (p.y - from.y) - dy (p.x - from.x), in subpixels squared.
    #[inline]
    fn at<T: Exact>(&self, x_sub: i64, y_sub: i64) -> T {
        T::cross(self.dx, y_sub - i64::from(self.from.y), self.dy, x_sub - i64::from(self.from.x))
    }

    /// 0 where samples with E = 0 belong to the triangle, else 1. With the inside on the side of
    /// E > 0 and y down, a left edge goes up (dy < 0) and a top edge goes right (dy = 0, dx > 0).
    #[inline]
    fn bias(&self) -> i64 {
        let top_left = self.dy < 0 || (self.dy == 0 && self.dx > 0);
        i64::from(!top_left)
    }

    /// E' = floor((E - bias) / S) at the centre of a pixel: its sign is the decision.
    #[inline]
    fn enter<T: Exact, W: Word>(&self, x_px: i32, y_px: i32) -> W {
        W::narrow(self.at::<T>(centre(x_px), centre(y_px)).biased_floor(self.bias()))
    }

    /// What E' grows by from column to column.
    #[inline]
    fn right<W: Word>(&self) -> W {
        W::narrow(i128::from(-self.dy))
    }

    /// What E' grows by from row to row.
    #[inline]
    fn down<W: Word>(&self) -> W {
        W::narrow(i128::from(self.dx))
    }
}

/// E' of the edge from `from` to `to` at pixel (x, y), and its steps to the right and down, as
/// [`EdgeFunction`] has them for triangles of [`WordWidth::I32`]: a window on its arithmetic for
/// `exhaust::edges`.
#[inline]
pub(crate) fn edge_steps(from: SubpixelPoint, to: SubpixelPoint, x_px: i32, y_px: i32) -> [i32; 3] {
    let edge = Edge::new(from, to);
    [edge.enter::<i64, i32>(x_px, y_px), edge.right(), edge.down()]
}

/// The pixels of `bounds` whose centres lie in the bounding box of the corners.
#[inline]
fn pixel_box(corners: &Corners, bounds: PixelRect) -> PixelRect {
    let range = |a: i32, b: i32, c: i32| {
        // First centre at or after the minimum; one past the last centre at or before the maximum.
        let first = (i64::from(a.min(b).min(c)) + i64::from(HALF_PIXEL - 1)) >> SUBPIXEL_BITS;
        let end = (i64::from(a.max(b).max(c)) + i64::from(HALF_PIXEL)) >> SUBPIXEL_BITS;
        (first as i32, end as i32)
    };
    let [a, b, c] = corners;
    let ((x0, x1), (y0, y1)) = (range(a.x, b.x, c.x), range(a.y, b.y, c.y));
    // Written out: a call of `intersect` that is not inlined costs more than the four choices.
    PixelRect {
        x0: x0.max(bounds.x0),
        y0: y0.max(bounds.y0),
        x1: x1.min(bounds.x1),
        y1: y1.min(bounds.y1),
    }
}

/// The three edge functions at the centre of a pixel, exactly, in subpixels squared: each belongs to
/// the edge opposite the corner of the same index, and they add up to twice the signed area.
#[must_use]
pub fn edge_values(corners: &Corners, x_px: i32, y_px: i32) -> [i128; 3] {
    edges(corners).map(|edge| edge.at(centre(x_px), centre(y_px)))
}

/// Twice the signed area; positive for corners that go round clockwise on the screen (y down).
#[inline]
fn twice_area<T: Exact>([a, b, c]: &Corners) -> T {
    Edge::new(*a, *b).at(i64::from(c.x), i64::from(c.y))
}

/// The three edges, each opposite the corner of the same index.
#[inline]
fn edges([a, b, c]: &Corners) -> [Edge; 3] {
    [Edge::new(*b, *c), Edge::new(*c, *a), Edge::new(*a, *b)]
}

#[inline]
fn cover_in<T: Exact, W: Word>(corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
    let rect = pixel_box(&corners, bounds);
    if rect.is_empty() {
        return;
    }
    let sign = twice_area::<T>(&corners).sign();
    if sign == 0 {
        return;
    }
    // Make it clockwise. Nothing predicts the winding, so select instead of branching.
    let [a, b, c] = corners;
    let is_clockwise = sign > 0;
    let (b, c) =
        (select_unpredictable(is_clockwise, b, c), select_unpredictable(is_clockwise, c, b));
    walk::<T, W>(&edges(&[a, b, c]), rect, emit);
}

/// Steps the three functions over every pixel of `rect`, row by row, and emits the runs where none
/// is negative. E' = floor((E - bias) / S) has the sign of the decision, and grows by exactly -dy
/// from column to column and by dx from row to row.
#[inline]
fn walk<T: Exact, W: Word>(edges: &[Edge; 3], rect: PixelRect, mut emit: impl FnMut(Span)) {
    let start = |edge: &Edge| edge.enter::<T, W>(rect.x0, rect.y0);
    let mut row = [start(&edges[0]), start(&edges[1]), start(&edges[2])];
    let right: [W; 3] = [edges[0].right(), edges[1].right(), edges[2].right()];
    let down: [W; 3] = [edges[0].down(), edges[1].down(), edges[2].down()];
    for y_px in rect.y0..rect.y1 {
        let [mut e0, mut e1, mut e2] = row;
        let mut x_px = rect.x0;
        while x_px < rect.x1 && (e0 | e1 | e2).is_negative() {
            (e0, e1, e2) = (e0 + right[0], e1 + right[1], e2 + right[2]);
            x_px += 1;
        }
        let x0_px = x_px;
        while x_px < rect.x1 && !(e0 | e1 | e2).is_negative() {
            (e0, e1, e2) = (e0 + right[0], e1 + right[1], e2 + right[2]);
            x_px += 1;
        }
        // A triangle is convex: the rest of the row is outside.
        if x0_px < x_px {
            emit(Span { y_px, x0_px, x1_px: x_px });
        }
        if y_px + 1 < rect.y1 {
            row = [row[0] + down[0], row[1] + down[1], row[2] + down[2]];
        }
    }
}

/// [`walk`] in words of some width, with its spans handed on in batches: what needs more than spans
/// calls it through a pointer, so that each walk is compiled once and not for every kind of value.
type BatchedWalk = fn(&[Edge; 3], PixelRect, &mut dyn FnMut(&[Span]));

fn walk_in_batches<T: Exact, W: Word>(
    edges: &[Edge; 3],
    rect: PixelRect,
    take: &mut dyn FnMut(&[Span]),
) {
    let mut batch = [Span { y_px: 0, x0_px: 0, x1_px: 0 }; 16];
    let mut len = 0;
    walk::<T, W>(edges, rect, |span| {
        batch[len] = span;
        len += 1;
        if len == batch.len() {
            take(&batch);
            len = 0;
        }
    });
    take(&batch[..len]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The thresholds of the word, from both sides: 2896 px square less a pixel is the last for
    /// 32 bits, and the widest triangles of the domain need 128.
    #[test]
    fn word_width_thresholds() {
        let side = |px: u32| px * 256;
        assert_eq!(WordWidth::of(side(182), side(182)), WordWidth::I32);
        assert_eq!(WordWidth::of(side(2895), side(2895)), WordWidth::I32);
        assert_eq!(WordWidth::of(side(2896), side(2896)), WordWidth::I64);
        assert_eq!(WordWidth::of(side(1 << 16), side(1 << 16)), WordWidth::I64);
        assert_eq!(WordWidth::of(u32::MAX, u32::MAX), WordWidth::I128);
        let just = (1u64 << 31) - 256;
        assert_eq!(WordWidth::of(just as u32, just as u32), WordWidth::I64);
        assert_eq!(WordWidth::of(u32::MAX, 1 << 31), WordWidth::I128);
    }

    /// E by hand at one sample, and the sides of a triangle that are top or left.
    #[test]
    fn an_edge_by_hand() {
        let [a, b] = [SubpixelPoint::new(0, 0), SubpixelPoint::new(512, 256)];
        assert_eq!(Edge::new(a, b).at::<i64>(128, 128), 512 * 128 - 256 * 128);
        assert_eq!(Edge::new(a, b).bias(), 1, "goes down: a right edge");
        assert_eq!(Edge::new(b, a).bias(), 0, "goes up: a left edge");
        let flat = SubpixelPoint::new(512, 0);
        assert_eq!((Edge::new(a, flat).bias(), Edge::new(flat, a).bias()), (0, 1), "top, bottom");
    }
}
