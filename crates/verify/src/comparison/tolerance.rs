//! How far a value may lie from the exact one: bounds derived from the operations of each engine,
//! never chosen to pass.
//!
//! u = 2^-53 is the unit roundoff of f64: each operation returns its exact result times (1 + d)
//! with |d| <= u. D is the largest difference between two of the values at the vertices, M the
//! largest magnitude among them. All bounds have the form u (d D + m M).

/// The bound u (d D + m M) as its two factors.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Bound {
    /// Factor of the largest difference between vertex values.
    pub d: f64,
    /// Factor of the largest magnitude.
    pub m: f64,
}

/// Bounds of an engine's perspective-correct attributes and of its depth.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Tolerance {
    /// For attributes.
    pub attribute: Bound,
    /// For depth.
    pub depth: Bound,
}

/// The edge-function engine: v = v0 + (a1 (v1 - v0) + a2 (v2 - v0)) (1 / ((a0 + a1) + a2)).
///
/// Line by line, in units of u: a = E q has E (1 where it exceeds 53 bits), q (1), the product (1):
/// 3. The sum of three positive a's adds 2: 5; its reciprocal 6. A term a (v1 - v0) has 3 + 1 for
/// the difference + 1 for the product: 5; the sum of two 6; times the reciprocal 6 + 6 + 1 = 13. The
/// terms are at most D together, so 13 D; the last addition rounds a result of at most M: 1 M.
/// Depth has E (1), the difference (1), the product (1), the sum (1), the reciprocal of twice the
/// area (2), the last product (1): 7 D + M.
pub const EDGE_FUNCTION: Tolerance =
    Tolerance { attribute: Bound { d: 13.0, m: 1.0 }, depth: Bound { d: 7.0, m: 1.0 } };

/// The scanline engine: v = vL + (vR - vL) s between the two edges of a row, and on each edge
/// v = va + (vb - va) t.
///
/// In units of u. The vertices' q = (1/w) / max has 1, which moves the value by at most 1 D. On an
/// edge: t = B / (A + B) with positive A and B of 1 each: the sum 2, the quotient 1, the numerator
/// 1: 4; the difference 1, the product 1: 6 D; the addition: 1 M. qL = (A + B) / dy has 1 + 1 + 1 =
/// 3. In the row: l and r are distances (1) times q dy (3 + 1), product 1: 6 each.
/// s = l (1 / (r + l)) moves by s (1 - s) (6 + 6) <= 3 and by sum, reciprocal and product 3: 6; the
/// difference 1, the product 1: 8 D. The errors of vL and vR enter with weights 1 - s and s, so
/// 6 D + 1 M once; the last addition 1 M. Together 1 + 6 + 8 = 15 D and 2 M.
/// Depth: the edges t (1), the difference and the product (2): 3 D + M. In the row s = l k with l
/// (1) and k = dy (1 / (l dyR + r dyL)): conversions and products 2, sum 1, reciprocal 1, product 1:
/// 5; so s has 1 + 5 + 1 = 7; the difference and the product 2: 9 D; the addition 1 M. Together
/// 12 D + 2 M.
pub const SCANLINE: Tolerance =
    Tolerance { attribute: Bound { d: 15.0, m: 2.0 }, depth: Bound { d: 12.0, m: 2.0 } };

/// Lines: v = a + (b - a) (i / n): the quotient, the difference, the product: 3 D; the addition: M.
pub const LINE: Tolerance =
    Tolerance { attribute: Bound { d: 3.0, m: 1.0 }, depth: Bound { d: 3.0, m: 1.0 } };

/// The oracle as an engine: each number is exact, and rounded once.
pub const ORACLE: Tolerance =
    Tolerance { attribute: Bound { d: 0.0, m: 1.0 }, depth: Bound { d: 0.0, m: 1.0 } };

/// Unit roundoff of f64.
const U: f64 = f64::EPSILON / 2.0;
/// Products of less than 2^10 rounding errors, which the first-order counts above leave out, add
/// less than one part in 2^40.
const SECOND_ORDER: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;
/// Below 2^-1022 rounding is absolute, 2^-1075 an operation; divided by sums that are at least
/// 2^-400 (see `triangle::MIN_W` and `MAX_W`) a few of them stay below 2^-660.
const UNDERFLOW: f64 = f64::from_bits((1023 - 660) << 52);

impl Bound {
    /// The largest error allowed for values interpolated between these.
    #[must_use]
    pub fn at<const N: usize>(self, values: [f64; N]) -> f64 {
        let (min, max) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), &v| (min.min(v), max.max(v)));
        let magnitude = min.abs().max(max.abs());
        U * (self.d * (max - min) + self.m * magnitude) * SECOND_ORDER + UNDERFLOW
    }
}
