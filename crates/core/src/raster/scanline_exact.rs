//! The scanline engine off the lattice: exact for corners that were never snapped.
//!
//! Source: the walk of the book's split-triangle fill (section 2.2) as repaired in
//! [`scanline`](super::scanline), with another arithmetic. Each edge crosses a row of centres at
//!
//! x = ax + T, T = (yc - ay) dx / dy,
//!
//! and the row starts or ends at the first centre that is not left of x, column ceil(x - 1/2). The
//! crossing is computed in floats together with a bound of its error; where both ends of the
//! interval have the same ceiling that is the column. Otherwise a centre lies too close to tell, and
//! the ceiling is taken of an exact quotient of big integers.
//!
//! It shares nothing with the edge function: no orientation test, and so no `orient2d`. It does not
//! clip, cull, depth-test or shade, and it computes no values.

#[doc(hidden)]
pub mod probe;

use num_bigint::BigInt;
use num_traits::{Euclid, Float, ToPrimitive};

use crate::contract::{Decisions, RasterizeExact};
use crate::grid::PixelRect;
use crate::triangle::{FreeCorners, Span};

/// The adaptive exact scanline engine; see the module's description.
#[derive(Clone, Copy, Debug, Default)]
pub struct ScanlineExact;

impl RasterizeExact for ScanlineExact {
    fn cover_exact(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        mut emit: impl FnMut(Span),
    ) -> Decisions {
        let mut decisions = Decisions::default();
        if bounds.is_empty() {
            return decisions;
        }
        let [top, middle, bottom] = in_order(corners);
        let long = Edge { a: top, b: bottom };
        for short in [Edge { a: top, b: middle }, Edge { a: middle, b: bottom }] {
            let first = first_centre(short.a[1]).max(bounds.y0);
            let end = first_centre(short.b[1]).min(bounds.y1);
            for y_px in first..end {
                let sides = [&long, &short].map(|edge| edge.column(y_px, &mut decisions));
                // Exact ceilings keep the order of the crossings, so the left one is the smaller.
                let x0_px = sides[0].min(sides[1]).max(bounds.x0);
                let x1_px = sides[0].max(sides[1]).min(bounds.x1);
                if x0_px < x1_px {
                    emit(Span { y_px, x0_px, x1_px });
                }
            }
        }
        decisions
    }
}

/// The corners from the top. Among equal heights any order does: an edge between them crosses no row.
fn in_order(corners: &FreeCorners) -> [[f64; 2]; 3] {
    let mut corners = corners.px();
    corners.sort_by(|a, b| a[1].total_cmp(&b[1]));
    corners
}

/// The first pixel whose centre is at or after `v`: the smallest i with i + 1/2 >= v.
fn first_centre(v: f64) -> i32 {
    // The difference may round onto a whole number from above, and the guess is one too small then.
    // A half more than a whole number of 25 bits is exact, so the comparison is.
    let guess = (v - 0.5).ceil();
    let first = if guess + 0.5 < v { guess + 1.0 } else { guess };
    debug_assert!(first + 0.5 >= v && first - 0.5 < v);
    // The domain keeps it within 2^23.
    first as i32
}

/// An edge from its upper end a down to its lower end b.
struct Edge {
    a: [f64; 2],
    b: [f64; 2],
}

/// What |x| + |T| + 1 is multiplied by to bound the error of x - 1/2, 6u with u = 2^-53.
const BOUND: f64 = 3.0 * f64::EPSILON;

impl Edge {
    /// Where the edge crosses the centres of row `y_px`, ay <= yc < by, and a bound of what x - 1/2 is
    /// off by.
    ///
    /// # The filter
    /// Each operation rounds: the computed v is v (1 + d), |d| <= u = 2^-53. In T, the two
    /// differences in the numerator, the product, the difference dy and the quotient round once
    /// each, so
    /// - |~T - T| <= (5u + 16u^2) |~T|, but for underflow, see below;
    /// - x = ax + T rounds by u |~x|;
    /// - ~x - 1/2 rounds by u (|~x| + 1/2), and adding or subtracting the bound e rounds by
    ///   u (|~x| + 1/2 + e) at most (1 + u), so the two together by u (2 |~x| + 1 + e) (1 + u).
    ///
    /// In all 5u |T| + 3u |x| + u and terms of u^2. The bound 6u (|x| + |T| + 1) is computed with
    /// four roundings, a factor of at least (1 - u)^4, and leaves u |T| + 3u |x| + 5u to spare.
    ///
    /// Underflow: a product below the normal range is off by 2^-1075 at most. It is divided by
    /// dy >= by - yc, and yc is a half-integer, so dy is at least the distance from 1/2 to its
    /// neighbour, 2^-54: at most 2^-1021, and 5u covers that. Nothing overflows: |T| is at most
    /// |dx| <= 2^24, since 0 <= yc - ay < dy.
    fn crossing(&self, y_px: i32) -> (f64, f64) {
        let (a, b) = (self.a, self.b);
        let down = f64::from(y_px) + 0.5 - a[1];
        let t = down * (b[0] - a[0]) / (b[1] - a[1]);
        let x = a[0] + t;
        (x, BOUND * (x.abs() + t.abs() + 1.0))
    }

    /// The first column whose centre is not left of the edge in row `y_px`; ay <= yc < by.
    fn column(&self, y_px: i32, decisions: &mut Decisions) -> i32 {
        let (x, error) = self.crossing(y_px);
        let (low, high) = ((x - 0.5 - error).ceil(), (x - 0.5 + error).ceil());
        if low == high {
            decisions.by_filter += 1;
            // Between the ends of the edge, so within 2^23.
            return low as i32;
        }
        decisions.by_fallback += 1;
        self.column_in_integers(y_px)
    }

    /// The same in whole numbers of a unit that divides both ends and 1/2:
    /// ceil(((ax - 1/2) dy + (yc - ay) dx) / dy), counted in units, then in pixels.
    #[cold]
    fn column_in_integers(&self, y_px: i32) -> i32 {
        let ends = [self.a[0], self.a[1], self.b[0], self.b[1]];
        let exponent = ends.into_iter().map(last_bit).fold(-1, i32::min);
        let [ax, ay, bx, by] = ends.map(|v| in_units(v, exponent));
        // A pixel and half of one; the exponent is at most -1.
        let (one, half) = (BigInt::from(1) << -exponent, BigInt::from(1) << (-1 - exponent));
        let yc = &one * y_px + &half;
        let dy = by - &ay;
        let numerator = (&ax - half) * &dy + (yc - ay) * (bx - ax);
        // ceil(n / d) = -floor(-n / d), and for d > 0 the Euclidean quotient is the floor.
        let column = -(-numerator).div_euclid(&(dy * one));
        // Between the ends of the edge.
        column.to_i32().expect("a crossing lies in the domain")
    }
}

/// Exponent of the last bit that is set; of zero, which has none, -1.
fn last_bit(v: f64) -> i32 {
    let (mantissa, exponent, _) = Float::integer_decode(v);
    if mantissa == 0 { -1 } else { i32::from(exponent) + mantissa.trailing_zeros() as i32 }
}

/// v / 2^`unit`, where `unit` is not above the exponent of v's last bit.
fn in_units(v: f64, unit: i32) -> BigInt {
    let (mantissa, exponent, sign) = Float::integer_decode(v);
    let shift = i32::from(exponent) - unit;
    let magnitude = BigInt::from(mantissa);
    // To the right only zeros fall out.
    (if shift >= 0 { magnitude << shift } else { magnitude >> -shift }) * sign
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_centre_by_hand() {
        // Away from zero, and towards it.
        let next = |v: f64| f64::from_bits(v.to_bits() + 1);
        let before = |v: f64| f64::from_bits(v.to_bits() - 1);
        for (v, first) in [
            (0.5, 0),
            (next(0.5), 1),
            (before(0.5), 0),
            (-0.5, -1),
            (before(-0.5), 0),
            (next(-0.5), -1),
            (0.0, 0),
            (f64::from_bits(1), 0),
            (-f64::from_bits(1), 0),
            (8_388_607.5, 8_388_607),
            (next(8_388_607.5), 8_388_608),
            (-8_388_608.0, -8_388_608),
        ] {
            assert_eq!(first_centre(v), first, "{v:e}");
        }
    }

    /// The edge (0, 0) to (3, 3) crosses each centre; shifted by the smallest f64, it does not.
    #[test]
    fn column_by_hand() {
        let tiny = f64::from_bits(1);
        for (x, columns) in [(0.0, [0, 1, 2]), (tiny, [1, 2, 3]), (-tiny, [0, 1, 2])] {
            let edge = Edge { a: [x, 0.0], b: [3.0, 3.0] };
            let mut decisions = Decisions::default();
            assert_eq!([0, 1, 2].map(|y_px| edge.column(y_px, &mut decisions)), columns, "{x:e}");
            assert_eq!(decisions, Decisions { by_filter: 0, by_fallback: 3 });
        }
    }
}
