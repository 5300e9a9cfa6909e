//! Exact depth and attribute values, as quotients of big integers.
//!
//! Every finite f64 is a whole number times a power of two, so the vertices' values are exact
//! numbers. A function that is linear in the window (depth, 1/w, v/w) is a plane over the lattice;
//! Cramer's rule gives the plane through three vertices without any rounding. The engines use
//! weights (barycentric or along edges) and never planes.

use std::borrow::Borrow;
use std::cmp::Ordering;
use std::ops;

use num_bigint::{BigInt, BigUint, Sign};
use num_traits::{Signed, ToPrimitive, Zero};

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXELS};
use rasterproof_core::triangle::Corners;

/// `mantissa` times two to the power `exponent`.
#[derive(Clone, Debug)]
struct Dyadic {
    mantissa: BigInt,
    exponent: i32,
}

impl Dyadic {
    /// Takes a finite number apart.
    fn new(value: f64) -> Self {
        let (mantissa, exponent) = take_apart(value);
        Self { mantissa: mantissa.into(), exponent }
    }

    fn times(&self, other: &Self) -> Self {
        Self {
            mantissa: &self.mantissa * &other.mantissa,
            exponent: self.exponent + other.exponent,
        }
    }
}

/// A finite number as a mantissa, odd or zero, and an exponent of two.
#[doc(hidden)]
pub fn take_apart(value: f64) -> (i64, i32) {
    assert!(value.is_finite(), "{value} has no exact value");
    let bits = value.to_bits();
    let field = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (magnitude, exponent) =
        if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    let zeros = if magnitude == 0 { 0 } else { magnitude.trailing_zeros() };
    let mantissa = (magnitude >> zeros) * if value.is_sign_negative() { -1 } else { 1 };
    (mantissa, exponent + zeros as i32)
}

/// num(x, y) / den with x, y in subpixels: the plane through three values at three points.
#[derive(Clone, Debug)]
struct LinearFunction {
    origin: [i64; 2],
    at_origin: BigInt,
    per_x: BigInt,
    per_y: BigInt,
    /// The numbers above count in units of 2^exponent.
    exponent: i32,
}

impl LinearFunction {
    fn new(corners: &Corners, area: i128, values: &[Dyadic; 3]) -> Self {
        // Zero has no exponent of its own.
        let of_others = values.iter().filter(|v| !v.mantissa.is_zero());
        let exponent = of_others.map(|v| v.exponent).min().unwrap_or(0);
        let [f0, f1, f2] = [0, 1, 2].map_array(|i| {
            let value = &values[i];
            if value.mantissa.is_zero() {
                BigInt::zero()
            } else {
                &value.mantissa << (value.exponent - exponent)
            }
        });
        let [o, p1, p2] = corners.map(|p| [i64::from(p.x), i64::from(p.y)]);
        let ([x1, y1], [x2, y2]) = ([p1[0] - o[0], p1[1] - o[1]], [p2[0] - o[0], p2[1] - o[1]]);
        let (g1, g2) = (f1 - &f0, f2 - &f0);
        Self {
            origin: o,
            at_origin: f0 * area,
            per_x: &g1 * y2 - &g2 * y1,
            per_y: &g2 * x1 - &g1 * x2,
            exponent,
        }
    }

    fn numerator(&self, x_sub: i64, y_sub: i64) -> BigInt {
        &self.at_origin
            + &self.per_x * (x_sub - self.origin[0])
            + &self.per_y * (y_sub - self.origin[1])
    }
}

/// An exact quotient; the denominator is positive.
#[derive(Clone, Debug)]
pub struct Exact {
    numerator: BigInt,
    denominator: BigInt,
}

impl PartialEq for Exact {
    /// As numbers: quotients are not in lowest terms.
    fn eq(&self, other: &Self) -> bool {
        &self.numerator * &other.denominator == &other.numerator * &self.denominator
    }
}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let (left, right) =
            (&self.numerator * &other.denominator, &other.numerator * &self.denominator);
        Some(left.cmp(&right))
    }
}

/// Arithmetic without rounding, between numbers and references to them.
macro_rules! operator {
    ($operator:ident, $method:ident($a:ident, $b:ident) $result:block) => {
        impl<R: Borrow<Exact>> ops::$operator<R> for &Exact {
            type Output = Exact;

            fn $method(self, other: R) -> Exact {
                let ($a, $b) = (self, other.borrow());
                $result
            }
        }

        impl<R: Borrow<Exact>> ops::$operator<R> for Exact {
            type Output = Exact;

            fn $method(self, other: R) -> Exact {
                ops::$operator::$method(&self, other)
            }
        }
    };
}

operator!(Add, add(a, b) {
    let numerator = &a.numerator * &b.denominator + &b.numerator * &a.denominator;
    Exact { numerator, denominator: &a.denominator * &b.denominator }
});
operator!(Sub, sub(a, b) {
    let numerator = &a.numerator * &b.denominator - &b.numerator * &a.denominator;
    Exact { numerator, denominator: &a.denominator * &b.denominator }
});
operator!(Mul, mul(a, b) {
    let numerator = &a.numerator * &b.numerator;
    Exact { numerator, denominator: &a.denominator * &b.denominator }
});
// The divisor is not zero.
operator!(Div, div(a, b) {
    Exact::new(&a.numerator * &b.denominator, &a.denominator * &b.numerator, 0)
});

impl Exact {
    /// The square root of what is not negative, less than 2^-100 too small.
    #[must_use]
    pub(super) fn root(&self) -> Self {
        // The root of a / b is that of a b, divided by b.
        let numerator: BigInt = (&self.numerator * &self.denominator) << 200u32;
        Self { numerator: numerator.sqrt(), denominator: &self.denominator << 100u32 }
    }

    /// numerator / denominator times 2^exponent; the denominator is not zero.
    fn new(numerator: BigInt, denominator: BigInt, exponent: i32) -> Self {
        let (numerator, denominator) = if denominator.is_negative() {
            (-numerator, -denominator)
        } else {
            (numerator, denominator)
        };
        if exponent >= 0 {
            Self { numerator: numerator << exponent, denominator }
        } else {
            Self { numerator, denominator: denominator << -exponent }
        }
    }

    /// The nearest f64, of two that are equally near the one with an even mantissa; infinite where
    /// that is beyond the largest number.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let (top, bottom) = (self.numerator.magnitude(), self.denominator.magnitude());
        if top.is_zero() {
            return 0.0;
        }
        // The quotient lies between 2^(bits - 1) and 2^(bits + 1).
        let bits = top.bits() as i64 - bottom.bits() as i64;
        let (left, right) = over_power(top, bottom, bits);
        let first_bit = if left >= right { bits } else { bits - 1 };
        if first_bit > 1023 {
            return if self.numerator.is_negative() { f64::NEG_INFINITY } else { f64::INFINITY };
        }
        // Subnormal numbers end at 2^-1074, others 52 bits after the first.
        let last_bit = (first_bit - 52).max(-1074);
        let (left, right) = over_power(top, bottom, last_bit);
        let (down, rest) = (&left / &right, &left % &right);
        let down = down.to_u64().unwrap_or(u64::MAX);
        let up = match (rest << 1u32).cmp(&right) {
            Ordering::Less => 0,
            Ordering::Equal => down & 1,
            Ordering::Greater => 1,
        };
        let unit = match last_bit {
            -1074..=-1023 => f64::from_bits(1 << (last_bit + 1074)),
            _ => f64::from_bits(((last_bit + 1023) as u64) << 52),
        };
        // At most 2^53 units: the product is exact.
        let magnitude = (down + up) as f64 * unit;
        if self.numerator.is_negative() { -magnitude } else { magnitude }
    }

    /// |value - self|, to a relative accuracy of 2^-50; infinite where the value is not finite.
    #[must_use]
    pub fn distance(&self, value: f64) -> f64 {
        if !value.is_finite() {
            return f64::INFINITY;
        }
        let value = Dyadic::new(value);
        let (mut left, mut denominator) =
            (value.mantissa * &self.denominator, self.denominator.clone());
        let mut right = self.numerator.clone();
        if value.exponent >= 0 {
            left <<= value.exponent;
        } else {
            right <<= -value.exponent;
            denominator <<= -value.exponent;
        }
        quotient(&(left - right), &denominator)
    }
}

/// top / (bottom 2^exponent) as two whole numbers.
fn over_power(top: &BigUint, bottom: &BigUint, exponent: i64) -> (BigUint, BigUint) {
    let shift = exponent.unsigned_abs();
    if exponent < 0 { (top << shift, bottom.clone()) } else { (top.clone(), bottom << shift) }
}

/// The leading 64 bits of a magnitude, and how many follow.
fn leading(n: &BigInt) -> (f64, i32) {
    let shift = n.bits().saturating_sub(64);
    let top = (n.magnitude() >> shift).to_u64().unwrap_or(u64::MAX);
    (top as f64, shift as i32)
}

/// |a / b| as a float, from the leading 64 bits of each.
fn quotient(a: &BigInt, b: &BigInt) -> f64 {
    if a.sign() == Sign::NoSign {
        return 0.0;
    }
    let ((a, a_shift), (b, b_shift)) = (leading(a), leading(b));
    a / b * 2f64.powi((a_shift - b_shift).clamp(-1000, 1000))
}

/// The plane of an attribute over w.
pub(super) struct ValuePlane(LinearFunction);

/// The centre of a pixel, in subpixels.
fn centre(px: i32) -> i64 {
    i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL)
}

/// The exact values of a triangle of N attributes at pixel centres.
#[derive(Clone, Debug)]
pub struct ExactTriangle<const N: usize> {
    area: i128,
    depth: LinearFunction,
    inv_w: LinearFunction,
    over_w: [LinearFunction; N],
}

impl<const N: usize> ExactTriangle<N> {
    /// Prepares the planes; `attributes[i]` belongs to `corners[i]`. Nothing for a triangle of zero
    /// area, which has no values, and where a number is not finite, which has no exact value.
    #[must_use]
    pub fn new(
        corners: &Corners,
        depth: [f64; 3],
        inv_w: [f64; 3],
        attributes: [[f64; N]; 3],
    ) -> Option<Self> {
        let [o, p, q] = corners.map(|corner| [i128::from(corner.x), i128::from(corner.y)]);
        let area = (p[0] - o[0]) * (q[1] - o[1]) - (q[0] - o[0]) * (p[1] - o[1]);
        let mut numbers = depth.iter().chain(&inv_w).chain(attributes.as_flattened());
        if area == 0 || !numbers.all(|number| number.is_finite()) {
            return None;
        }
        let inv_w = inv_w.map_array(Dyadic::new);
        Some(Self {
            area,
            depth: LinearFunction::new(corners, area, &depth.map_array(Dyadic::new)),
            over_w: std::array::from_fn(|k| {
                let over_w =
                    [0, 1, 2].map_array(|i| inv_w[i].times(&Dyadic::new(attributes[i][k])));
                LinearFunction::new(corners, area, &over_w)
            }),
            inv_w: LinearFunction::new(corners, area, &inv_w),
        })
    }

    /// The plane of one more attribute over w, for [`Self::of_planes`].
    pub(super) fn plane(&self, corners: &Corners, inv_w: [f64; 3], values: [f64; 3]) -> ValuePlane {
        let over_w = std::array::from_fn(|i| Dyadic::new(inv_w[i]).times(&Dyadic::new(values[i])));
        ValuePlane(LinearFunction::new(corners, self.area, &over_w))
    }

    /// The attributes of some planes at the centre of a pixel.
    pub(super) fn of_planes(&self, planes: &[ValuePlane], x_px: i32, y_px: i32) -> Vec<Exact> {
        let [x, y] = [x_px, y_px].map_array(centre);
        let inv_w = self.inv_w.numerator(x, y);
        let mut values = Vec::with_capacity(planes.len());
        for ValuePlane(plane) in planes {
            let exponent = plane.exponent - self.inv_w.exponent;
            values.push(Exact::new(plane.numerator(x, y), inv_w.clone(), exponent));
        }
        values
    }

    /// Depth and attributes at the centre of a pixel.
    #[must_use]
    pub fn at(&self, x_px: i32, y_px: i32) -> (Exact, [Exact; N]) {
        let [x, y] = [x_px, y_px].map_array(centre);
        let inv_w = self.inv_w.numerator(x, y);
        let depth = Exact::new(self.depth.numerator(x, y), self.area.into(), self.depth.exponent);
        let attributes = std::array::from_fn(|k| {
            let plane = &self.over_w[k];
            Exact::new(plane.numerator(x, y), inv_w.clone(), plane.exponent - self.inv_w.exponent)
        });
        (depth, attributes)
    }
}

impl From<f64> for Exact {
    /// The number itself.
    fn from(value: f64) -> Self {
        let value = Dyadic::new(value);
        Self::new(value.mantissa, 1.into(), value.exponent)
    }
}

/// The exact value where an edge crosses a plane. `distances` of its ends from the plane are sums of
/// two numbers, and differ.
///
/// # Panics
/// If a number is not finite.
#[must_use]
pub fn at_crossing(ends: [f64; 2], distances: [[f64; 2]; 2]) -> Exact {
    let [a, b] = ends.map_array(Dyadic::new);
    let parts = distances.map_array(|sum| sum.map_array(Dyadic::new));
    let unit = parts.iter().flatten().map(|part| part.exponent).min().unwrap_or(0);
    let [from, to] = parts.map_array(|sum| {
        let [first, second] = sum.map_array(|part| part.mantissa << (part.exponent - unit));
        first + second
    });
    let exponent = a.exponent.min(b.exponent);
    // a + (b - a) from / (from - to)
    let numerator = (b.mantissa << (b.exponent - exponent)) * &from
        - (a.mantissa << (a.exponent - exponent)) * &to;
    Exact::new(numerator, from - to, exponent)
}

/// The exact value at a step along a line: (first (length - step) + second step) / length.
///
/// # Panics
/// If an end's value is not finite.
#[must_use]
pub fn along_line(ends: [f64; 2], step: u64, length: u64) -> Exact {
    let [a, b] = ends.map_array(Dyadic::new);
    if length == 0 {
        return Exact::new(a.mantissa, 1.into(), a.exponent);
    }
    let exponent = a.exponent.min(b.exponent);
    let numerator = (a.mantissa << (a.exponent - exponent)) * (length - step)
        + (b.mantissa << (b.exponent - exponent)) * step;
    Exact::new(numerator, length.into(), exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;

    /// w = 1, 2, 4 and values 0, 1, 2 over the triangle (0,0) (4,0) (0,4), worked out on paper at
    /// the centre (1.5, 0.5): weights 1/2, 3/8, 1/8; 1/w = 1/2 + 3/16 + 1/32 = 23/32;
    /// v/w = 3/16 + 2/32 = 8/32; so v = 8/23, and depth 10 * 3/8 + 20/8 = 25/4.
    #[test]
    fn a_value_by_hand() {
        let p = |x: i32, y: i32| SubpixelPoint::new(x * 256, y * 256);
        for corners in [[0, 1, 2], [0, 2, 1], [2, 0, 1]] {
            let pick = |values: [f64; 3]| corners.map(|i| values[i]);
            let triangle = ExactTriangle::new(
                &corners.map(|i| [p(0, 0), p(4, 0), p(0, 4)][i]),
                pick([0.0, 10.0, 20.0]),
                pick([1.0, 0.5, 0.25]),
                pick([0.0, 1.0, 2.0]).map(|v| [v, 0.0]),
            )
            .unwrap();
            let (depth, [a, zero]) = triangle.at(1, 0);
            assert_eq!(depth.to_f64(), 6.25);
            assert_eq!(a.to_f64(), 8.0 / 23.0);
            assert_eq!((zero.to_f64(), zero.distance(0.5)), (0.0, 0.5));
            assert_eq!(depth.distance(6.0), 0.25);
            assert!(a.distance(8.0 / 23.0) < 1e-16 && a.distance(8.0 / 23.0) > 0.0);
            assert_eq!(a.distance(f64::NAN), f64::INFINITY);
        }
    }

    /// Numbers that are the same everywhere (SplitMix64).
    fn numbers(mut state: u64) -> impl FnMut() -> u64 {
        move || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        }
    }

    /// The processor's division is rounded once, as IEEE 754 wants it, subnormal results included.
    #[test]
    fn quotients_are_rounded_as_the_processor_rounds_them() {
        let exact = |a: f64, b: f64| {
            let (a, b) = (Dyadic::new(a), Dyadic::new(b));
            Exact::new(a.mantissa, b.mantissa, a.exponent - b.exponent).to_f64()
        };
        let mut next = numbers(1);
        let (mut subnormal, mut beyond) = (0, 0);
        for i in 0..60_000 {
            // Every third is near the smallest number, every third of any size, and one of few bits, whose
            // quotients are often halfway between two numbers.
            let any =
                |bits: u64| f64::from_bits((bits & !(0x7ff << 52)) | (((bits >> 53) % 2047) << 52));
            let few = |bits: u64| ((bits % 4095) as f64 - 2047.0) * 2f64.powi((bits >> 58) as i32);
            let (a, b) = match i % 3 {
                0 => (any(next()), any(next())),
                1 => (f64::MIN_POSITIVE * any(next() | 1 << 62).abs().sqrt(), few(next())),
                _ => (few(next()) * f64::from_bits(1), 2f64.powi((next() % 20) as i32)),
            };
            if b == 0.0 || !a.is_finite() || !b.is_finite() {
                continue;
            }
            let expected = a / b;
            subnormal += u32::from(expected.is_subnormal());
            beyond += u32::from(expected.is_infinite());
            assert!(exact(a, b) == expected, "{a:e} / {b:e}: {:e}, {expected:e}", exact(a, b));
        }
        assert!(subnormal > 1_000 && beyond > 1_000, "{subnormal} {beyond}");
        let halfway = [(f64::from_bits(1), 2.0), (f64::from_bits(3), 2.0), (f64::MAX, 0.5)];
        for (a, b) in halfway {
            assert_eq!(exact(a, b), a / b);
            assert_eq!(exact(-a, b), -a / b);
        }
    }

    #[test]
    fn along_a_line_by_hand() {
        assert_eq!(along_line([1.0, 2.0], 1, 4).to_f64(), 1.25);
        assert_eq!(along_line([0.0, 3.0], 4, 4).to_f64(), 3.0);
        assert_eq!(along_line([7.5, 3.0], 0, 0).to_f64(), 7.5);
    }
}
