//! The edge-function engine off the lattice: exact for corners that were never snapped.
//!
//! Source: Pineda 1988 for the traversal, Shewchuk 1997, "Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates", for the decision. Each sample of the bounding
//! box is asked on which side of three edges it lies. The side is the sign of
//!
//! E(p) = dx (p.y - a.y) - dy (p.x - a.x), with (dx, dy) from the edge's first end a to its second.
//!
//! In floats that sign may be wrong close to the edge, so each edge has an error bound, the filter,
//! and where |E| does not exceed it the sign is taken from `robust::orient2d`, which is exact. Only
//! corners with coordinates nearer to zero than 2^-400, which no f32 is, are beyond `orient2d`: its
//! products would lose their last bits below the smallest f64. They get whole-number arithmetic.
//!
//! It shares nothing with the scanline. It does not clip, cull, depth-test or shade, and it computes
//! no values.

#[doc(hidden)]
pub mod probe;

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::{Float, Signed, Zero};
use robust::{Coord, orient2d};

use crate::contract::{Decisions, RasterizeExact};
use crate::grid::PixelRect;
use crate::triangle::{FreeCorners, Span};

/// The adaptive exact edge-function engine; see the module's description.
#[derive(Clone, Copy, Debug, Default)]
pub struct EdgeFunctionExact;

/// `[x, y]` in pixels.
type Point = [f64; 2];

/// Relative error of one rounding to nearest, u = 2^-53.
const U: f64 = f64::EPSILON / 2.0;

/// Coordinates other than zero must be at least this far from it for `orient2d` to be exact, 2^-400.
///
/// Then each coordinate is a multiple of 2^-452, and so are the differences that `orient2d` forms
/// and the parts it splits them into; each product is a multiple of 2^-904, so it needs no bit below
/// the smallest f64, 2^-1074. The smallest of its own error bounds, 9 u^2 times a sum of products, is
/// at least 2^-904 * 2^-103 = 2^-1007 and therefore a normal number, with the relative accuracy that
/// its derivation assumes. Nothing overflows: coordinates are below 2^23, the splitter is 2^27 + 1.
const ORIENT2D_MIN: f64 = f64::from_bits((1023 - 400) << 52);

impl RasterizeExact for EdgeFunctionExact {
    fn cover_exact(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        mut emit: impl FnMut(Span),
    ) -> Decisions {
        let mut decisions = Decisions::default();
        let [a, mut b, mut c] = corners.px();
        let rect = pixel_box(&[a, b, c]).intersect(&bounds);
        if rect.is_empty() {
            return decisions;
        }
        let is_deep = is_deep(corners);
        // Make it clockwise on the screen, so that the inside is where E > 0.
        match Edge::new(a, b, [c, c], is_deep).side(c, &mut decisions) {
            Ordering::Equal => return decisions,
            Ordering::Less => (b, c) = (c, b),
            Ordering::Greater => {}
        }
        let extremes = [centre(rect.x0, rect.y0), centre(rect.x1 - 1, rect.y1 - 1)];
        let edges = [(b, c), (c, a), (a, b)].map(|(p, q)| Edge::new(p, q, extremes, is_deep));
        let mut is_inside = |x_px: i32, y_px: i32| {
            edges.iter().all(|edge| edge.owns(centre(x_px, y_px), &mut decisions))
        };
        for y_px in rect.y0..rect.y1 {
            let Some(x0_px) = (rect.x0..rect.x1).find(|&x_px| is_inside(x_px, y_px)) else {
                continue;
            };
            // A triangle is convex: after the first sample outside there is none inside.
            let x1_px =
                (x0_px + 1..rect.x1).find(|&x_px| !is_inside(x_px, y_px)).unwrap_or(rect.x1);
            emit(Span { y_px, x0_px, x1_px });
        }
        decisions
    }
}

/// Whether some coordinate is too close to zero for `orient2d`.
fn is_deep(corners: &FreeCorners) -> bool {
    corners.px().as_flattened().iter().any(|&v| v != 0.0 && v.abs() < ORIENT2D_MIN)
}

/// Centre of a pixel; exact, since pixels are whole numbers of at most 32 bits.
#[inline]
fn centre(x_px: i32, y_px: i32) -> Point {
    [f64::from(x_px) + 0.5, f64::from(y_px) + 0.5]
}

/// The pixels whose centres may lie in the bounding box of the corners.
///
/// The subtraction may round, which moves a bound by at most one pixel and only outwards: the
/// rounded difference reaches a whole number from above (first) or below (last), never passes it.
fn pixel_box(corners: &[Point; 3]) -> PixelRect {
    let range = |axis: usize| {
        let [a, b, c] = corners.map(|corner| corner[axis]);
        let first = (a.min(b).min(c) - 0.5).ceil();
        let last = (a.max(b).max(c) - 0.5).floor();
        // Within the domain, so both fit i32.
        (first as i32, last as i32 + 1)
    };
    let ((x0, x1), (y0, y1)) = (range(0), range(1));
    PixelRect { x0, y0, x1, y1 }
}

/// An edge of a triangle whose inside is where E > 0.
struct Edge {
    from: Point,
    to: Point,
    dx: f64,
    dy: f64,
    /// The sign of E is certain where its magnitude is above this.
    bound: f64,
    /// Whether samples on the edge belong to the triangle.
    is_top_left: bool,
    is_deep: bool,
}

impl Edge {
    /// `extremes` are two opposite corners of the rectangle that the samples to be asked lie in.
    ///
    /// # The filter
    /// Write ~v for the computed v. Each operation rounds: |~v - v| <= u |~v|, and a product that
    /// falls below the normal range is off by at most 2^-1075 besides; sums are exact down there.
    /// With P = p.y - a.y:
    /// - ~dx = dx (1 + d), ~P likewise, so |~dx ~P - dx P| <= (2u + u^2) |~dx ~P|;
    /// - rounding their product adds u |~dx ~P| + 2^-1075; the other product behaves likewise;
    /// - rounding the difference of the products adds at most u times the sum of their magnitudes,
    ///   (1 + u) (|~dx ~P| + |~dy ~Q|) + 2^-1074, with Q = p.x - a.x.
    ///
    /// Together |~E - E| <= (4u + 3u^2) (|~dx ~P| + |~dy ~Q|) + 2^-1073. Rounding is monotone, so
    /// over a rectangle of samples |~P| and |~Q| are largest at its borders. The four roundings of
    /// the bound itself cost at most a factor (1 - u)^4, or 2^-1073 where they underflow: 5u leaves
    /// a fifth to spare for the former, and the smallest normal number covers all that is absolute.
    fn new(from: Point, to: Point, extremes: [Point; 2], is_deep: bool) -> Self {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let reach = |axis: usize| {
            (extremes[0][axis] - from[axis]).abs().max((extremes[1][axis] - from[axis]).abs())
        };
        let bound = 5.0 * U * (dx.abs() * reach(1) + dy.abs() * reach(0)) + f64::MIN_POSITIVE;
        // The corners themselves are compared, so no rounding blurs which kind of edge it is. With
        // the inside where E > 0 and y down, a left edge goes up and a top edge goes right.
        let is_top_left = to[1] < from[1] || (to[1] == from[1] && to[0] > from[0]);
        Self { from, to, dx, dy, bound, is_top_left, is_deep }
    }

    /// Whether the sample lies inside of the edge, or on it and the edge is one that keeps those.
    #[inline]
    fn owns(&self, p: Point, decisions: &mut Decisions) -> bool {
        match self.side(p, decisions) {
            Ordering::Greater => true,
            Ordering::Equal => self.is_top_left,
            Ordering::Less => false,
        }
    }

    /// E(p) as floats compute it; off by at most `bound`.
    #[inline]
    fn estimate(&self, p: Point) -> f64 {
        self.dx * (p[1] - self.from[1]) - self.dy * (p[0] - self.from[0])
    }

    /// The sign of E(p).
    #[inline]
    fn side(&self, p: Point, decisions: &mut Decisions) -> Ordering {
        let e = self.estimate(p);
        if e.abs() > self.bound {
            decisions.by_filter += 1;
            return if e > 0.0 { Ordering::Greater } else { Ordering::Less };
        }
        decisions.by_fallback += 1;
        if self.is_deep {
            return side_in_integers(self.from, self.to, p);
        }
        let coord = |[x, y]: Point| Coord { x, y };
        // Expanded, orient2d(from, to, p) is E(p). Its zero has either sign.
        match orient2d(coord(self.from), coord(self.to), coord(p)) {
            e if e > 0.0 => Ordering::Greater,
            e if e < 0.0 => Ordering::Less,
            _ => Ordering::Equal,
        }
    }
}

/// The sign of E(p) in whole numbers of 2^-1075: every finite f64 is one.
#[cold]
fn side_in_integers(from: Point, to: Point, p: Point) -> Ordering {
    let whole = |v: f64| {
        // `integer_decode` gives mantissa, exponent and sign; the smallest exponent is -1075.
        let (mantissa, exponent, sign) = Float::integer_decode(v);
        (BigInt::from(mantissa) << (i32::from(exponent) + 1075)) * sign
    };
    let difference = |a: f64, b: f64| whole(a) - whole(b);
    let left = difference(to[0], from[0]) * difference(p[1], from[1]);
    let right = difference(to[1], from[1]) * difference(p[0], from[0]);
    let e = left - right;
    match (e.is_zero(), e.is_positive()) {
        (true, _) => Ordering::Equal,
        (_, true) => Ordering::Greater,
        _ => Ordering::Less,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: p = (1/2, 1/2) on the edge (0, 0) to (1, 1), and off it by the smallest f64, which
    /// no product of f64 can show.
    #[test]
    fn the_smallest_offset_decides() {
        let (p, end) = ([0.5, 0.5], [1.0, 1.0]);
        let tiny = f64::from_bits(1);
        for (from, side) in [
            ([0.0, 0.0], Ordering::Equal),
            ([tiny, 0.0], Ordering::Greater),
            ([0.0, tiny], Ordering::Less),
            ([-tiny, -tiny], Ordering::Equal),
        ] {
            let mut decisions = Decisions::default();
            let edge = Edge::new(from, end, [p, p], true);
            assert_eq!(edge.side(p, &mut decisions), side, "{from:?}");
            assert_eq!(decisions, Decisions { by_filter: 0, by_fallback: 1 });
        }
    }

    /// -0.0 from `orient2d` must not count as negative.
    #[test]
    fn a_zero_is_a_tie() {
        for (from, to) in
            [([0.5, 0.5], [0.5, 0.5]), ([0.0, 0.5], [3.0, 0.5]), ([0.5, 4.0], [0.5, 1.0])]
        {
            let p = [0.5, 0.5];
            let side = Edge::new(from, to, [p, p], false).side(p, &mut Decisions::default());
            assert_eq!(side, Ordering::Equal, "{from:?} {to:?}");
        }
    }
}
