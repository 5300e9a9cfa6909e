//! Nearly exact values: the planes of [`values`](super::values) in numbers of twice 53 bits, each
//! with a bound of its own error.
//!
//! A comparison wants the largest difference from the exact value, and all but a few differences are
//! smaller than one that was seen before. [`NearPixel`] gives a number that a difference certainly
//! does not exceed. Where that is not above what was seen, the exact difference cannot be either and
//! need not be known; everywhere else big integers are asked. So nothing is missed, and what is
//! reported is exact.
//!
//! Errors. A number is hi + lo, its operations as analysed by Joldes, Muller and Popescu ("Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic", 2017): a sum, a
//! product with a float and a product of two are right to 8 u^2 = 2^-103 of their result. From the
//! vertices' values to a numerator of a plane there are at most six in a row: differences between
//! vertices, times a side, difference, times an offset, two sums; to the residue that is compared,
//! eight. No intermediate exceeds the sum of the magnitudes that enter it, the `size` beside each
//! number, so the error stays below 8 2^-103 = 2^-100 of the size, and `ERROR` is twice that: a
//! size is summed in plain floats, which are off by far less than a factor of two. Values whose
//! products could overflow or underflow are refused.

use std::array::from_fn;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXELS};
use rasterproof_core::triangle::Corners;

/// The error of a numerator or a residue, in units of its size.
const ERROR: f64 = two_to(-99);
/// Roundings of floats in the last steps, and those of `Exact::distance` (2^-50), with room.
const ROUNDINGS: f64 = 1.0 + two_to(-40);
/// Values of other magnitudes are left to big integers. Two such values, an area (2^66) and an
/// offset (2^33) multiply to less than 2^600; two values have no bit below 2^-504, and what they are
/// multiplied with besides is whole. So nothing overflows, and no product underflows.
const SMALLEST: f64 = two_to(-200);
const LARGEST: f64 = two_to(200);

const fn two_to(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

fn is_usual(value: f64) -> bool {
    value == 0.0 || (SMALLEST..=LARGEST).contains(&value.abs())
}

/// hi + lo, where hi is the float nearest to the sum.
#[derive(Clone, Copy, Debug)]
struct Double {
    hi: f64,
    lo: f64,
}

impl Double {
    fn of(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }

    /// A whole number of at most 2^67: the remainder has at most 14 bits.
    fn whole(value: i128) -> Self {
        let hi = value as f64;
        Self { hi, lo: (value - hi as i128) as f64 }
    }

    /// a + b exactly (Knuth).
    fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let of_b = hi - a;
        Self { hi, lo: (a - (hi - of_b)) + (b - of_b) }
    }

    /// a + b exactly, for a that is not smaller (Dekker).
    fn ordered(a: f64, b: f64) -> Self {
        let hi = a + b;
        Self { hi, lo: b - (hi - a) }
    }

    /// a b exactly (Dekker, Veltkamp): halves of 26 bits, whose products fit. Not by `mul_add`, which
    /// is a call where the machine has no such instruction.
    fn product(a: f64, b: f64) -> Self {
        let ((a1, a0), (b1, b0)) = (halves(a), halves(b));
        let hi = a * b;
        Self { hi, lo: ((a1 * b1 - hi) + a1 * b0 + a0 * b1) + a0 * b0 }
    }

    /// The sum: the high and the low parts are added apart, each with its rounding error, and joined again.
    fn plus(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.hi, other.hi), Self::sum(self.lo, other.lo));
        let once = Self::ordered(high.hi, high.lo + low.hi);
        Self::ordered(once.hi, low.lo + once.lo)
    }

    fn minus(self, other: Self) -> Self {
        self.plus(Self { hi: -other.hi, lo: -other.lo })
    }

    fn times(self, factor: f64) -> Self {
        let high = Self::product(self.hi, factor);
        let once = Self::ordered(high.hi, self.lo * factor);
        Self::ordered(once.hi, once.lo + high.lo)
    }

    fn times_double(self, factor: Self) -> Self {
        let high = Self::product(self.hi, factor.hi);
        let cross = self.hi * factor.lo + self.lo * factor.hi;
        Self::ordered(high.hi, high.lo + cross)
    }
}

/// A number and what its error is measured by: the magnitudes that entered it.
#[derive(Clone, Copy, Debug)]
struct Sized {
    number: Double,
    size: f64,
}

impl Sized {
    fn plus(self, other: Self) -> Self {
        Self { number: self.number.plus(other.number), size: self.size + other.size }
    }

    fn minus(self, other: Self) -> Self {
        Self { number: self.number.minus(other.number), size: self.size + other.size }
    }

    fn times(self, factor: f64) -> Self {
        Self { number: self.number.times(factor), size: self.size * factor.abs() }
    }

    fn error(self) -> f64 {
        ERROR * self.size
    }
}

/// The plane through three values: at the first corner, and for each subpixel from there.
#[derive(Clone, Copy, Debug)]
struct LinearFunction {
    at_origin: Sized,
    per_x: Sized,
    per_y: Sized,
}

impl LinearFunction {
    /// `sides[i]` leads from corner 0 to corner i + 1.
    fn new([f0, f1, f2]: [Double; 3], sides: [[f64; 2]; 2], area: Double) -> Self {
        let [f0, f1, f2] = [f0, f1, f2].map_array(|number| Sized { number, size: number.hi.abs() });
        let [[x1, y1], [x2, y2]] = sides;
        let (g1, g2) = (f1.minus(f0), f2.minus(f0));
        Self {
            at_origin: Sized {
                number: f0.number.times_double(area),
                size: f0.size * area.hi.abs(),
            },
            per_x: g1.times(y2).minus(g2.times(y1)),
            per_y: g2.times(x1).minus(g1.times(x2)),
        }
    }

    fn at(&self, [x, y]: [f64; 2]) -> Sized {
        self.at_origin.plus(self.per_x.times(x)).plus(self.per_y.times(y))
    }
}

/// The nearly exact values of a triangle of N attributes.
#[derive(Clone, Debug)]
pub struct NearTriangle<const N: usize> {
    /// Corner 0, in subpixels.
    origin: [i32; 2],
    area: Double,
    depth: LinearFunction,
    inv_w: LinearFunction,
    over_w: [LinearFunction; N],
}

impl<const N: usize> NearTriangle<N> {
    /// Prepares the planes; `attributes[i]` belongs to `corners[i]`. Nothing for a triangle of zero
    /// area, and where a value is not finite or of an unusual magnitude.
    #[must_use]
    pub fn new(
        corners: &Corners,
        depth: [f64; 3],
        inv_w: [f64; 3],
        attributes: [[f64; N]; 3],
    ) -> Option<Self> {
        let mut values = depth.iter().chain(&inv_w).chain(attributes.as_flattened());
        if !values.all(|&value| is_usual(value)) {
            return None;
        }
        // Below 2^33, so exact in a float.
        let [o, p1, p2] = corners.map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        let ([x1, y1], [x2, y2]) = ([p1[0] - o[0], p1[1] - o[1]], [p2[0] - o[0], p2[1] - o[1]]);
        let area = i128::from(x1) * i128::from(y2) - i128::from(x2) * i128::from(y1);
        if area == 0 {
            return None;
        }
        let area = Double::whole(area);
        let sides = [[x1 as f64, y1 as f64], [x2 as f64, y2 as f64]];
        let plane = |values: [Double; 3]| LinearFunction::new(values, sides, area);
        Some(Self {
            origin: [corners[0].x, corners[0].y],
            area,
            depth: plane(depth.map_array(Double::of)),
            inv_w: plane(inv_w.map_array(Double::of)),
            over_w: from_fn(|k| plane(from_fn(|i| Double::product(inv_w[i], attributes[i][k])))),
        })
    }

    /// The numerators and denominators at the centre of a pixel.
    #[must_use]
    pub fn at(&self, x_px: i32, y_px: i32) -> NearPixel<N> {
        let offset = |px: i32, origin: i32| {
            let centre = i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL);
            (centre - i64::from(origin)) as f64
        };
        let at = [offset(x_px, self.origin[0]), offset(y_px, self.origin[1])];
        NearPixel {
            area: Sized { number: self.area, size: self.area.hi.abs() },
            depth: self.depth.at(at),
            inv_w: self.inv_w.at(at),
            over_w: from_fn(|k| self.over_w[k].at(at)),
        }
    }
}

/// The nearly exact values at the centre of a pixel, as quotients.
#[derive(Clone, Debug)]
pub struct NearPixel<const N: usize> {
    area: Sized,
    depth: Sized,
    inv_w: Sized,
    over_w: [Sized; N],
}

impl<const N: usize> NearPixel<N> {
    /// What the difference of `value` from the exact depth certainly does not exceed, nor what
    /// `Exact::distance` makes of it; infinite where that cannot be said.
    #[must_use]
    pub fn depth_at_most(&self, value: f64) -> f64 {
        at_most(value, self.depth, self.area)
    }

    /// As [`NearPixel::depth_at_most`], of attribute `k`.
    #[must_use]
    pub fn attribute_at_most(&self, k: usize, value: f64) -> f64 {
        at_most(value, self.over_w[k], self.inv_w)
    }
}

/// As [`NearPixel::depth_at_most`], of the value at a step along a line between two ends.
#[must_use]
pub fn along_line_at_most([a, b]: [f64; 2], step: u64, length: u64, value: f64) -> f64 {
    if !is_usual(a) || !is_usual(b) || length > u64::from(u32::MAX) {
        return f64::INFINITY;
    }
    // A point has the values of its first end.
    let length = length.max(1);
    let numerator = weighed(a, length - step).plus(weighed(b, step));
    let length = length as f64;
    at_most(value, numerator, Sized { number: Double::of(length), size: length })
}

/// Two numbers of 26 bits whose sum is this one (Veltkamp).
fn halves(v: f64) -> (f64, f64) {
    let scaled = v * ((1 << 27) + 1) as f64;
    let high = scaled - (scaled - v);
    (high, v - high)
}

/// An end of a line times the steps from the other one.
fn weighed(end: f64, weight: u64) -> Sized {
    let number = Double::product(end, weight as f64);
    Sized { number, size: number.hi.abs() }
}

/// |value - numerator / denominator| = |value denominator - numerator| / |denominator|, from above.
fn at_most(value: f64, numerator: Sized, denominator: Sized) -> f64 {
    let least = denominator.number.hi.abs() - denominator.error();
    // The first also fails for what is not a number.
    if !is_usual(value) || least <= denominator.error() {
        return f64::INFINITY;
    }
    let residue = denominator.times(value).minus(numerator);
    (residue.number.hi.abs() + residue.error()) / least * ROUNDINGS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_distance_along_a_line_exceeds_what_is_said() {
        use crate::values::along_line;
        let (mut count, mut close) = (0, 0);
        let mut rng = rasterproof_core::random::Rng::new("along", 1, 0);
        for _ in 0..500 {
            let ends = [rng.signed(), rng.signed() * 100.0];
            let length = rng.int(0, 40).unsigned_abs();
            for step in 0..=length {
                let exact = along_line(ends, step, length);
                for moved in [0.0, 1e-16, -3e-15, 0.5] {
                    let value = exact.to_f64() * (1.0 + moved);
                    let at_most = along_line_at_most(ends, step, length, value);
                    let distance = exact.distance(value);
                    assert!(distance <= at_most, "{ends:?} {step}/{length}: {distance} {at_most}");
                    count += 1;
                    close += u64::from(distance > 0.99 * at_most);
                }
            }
        }
        assert!(close * 2 > count, "{close} of {count} are close");
        assert_eq!(along_line_at_most([0.0, f64::NAN], 1, 2, 0.0), f64::INFINITY);
        assert_eq!(along_line_at_most([0.0, 1.0], 1, 2, f64::NAN), f64::INFINITY);
    }

    #[test]
    fn what_could_overflow_or_is_no_number_is_left_to_big_integers() {
        let corners = [(0, 0), (2560, 0), (0, 2560)];
        let corners = corners.map(|(x, y)| rasterproof_core::grid::SubpixelPoint::new(x, y));
        let new = |depth: f64, w: f64, v: f64| {
            NearTriangle::new(&corners, [depth, 0.5, 0.5], [w, 1.0, 1.0], [[v], [0.0], [1.0]])
        };
        let usual = new(0.0, 1.0, 7.0).unwrap();
        assert!(usual.at(2, 3).depth_at_most(0.5) < 0.5);
        for odd in [f64::NAN, f64::INFINITY, 1e-70, 1e70, 5e-324] {
            assert!(new(odd, 1.0, 7.0).is_none() && new(0.0, odd, 7.0).is_none());
            assert!(new(0.0, 1.0, odd).is_none() && new(0.0, 1.0, -odd).is_none());
            assert_eq!(usual.at(2, 3).depth_at_most(odd), f64::INFINITY);
            assert_eq!(usual.at(2, 3).attribute_at_most(0, odd), f64::INFINITY);
        }
    }

    /// Twice 53 bits: the square of 1 + 2^-52 needs 105, and one minus another 104.
    #[test]
    fn doubles_by_hand() {
        let a = 1.0 + f64::EPSILON;
        let square = Double::product(a, a);
        assert_eq!((square.hi, square.lo), (1.0 + 2.0 * f64::EPSILON, f64::EPSILON * f64::EPSILON));
        let left = square.minus(Double::of(1.0 + 2.0 * f64::EPSILON));
        assert_eq!((left.hi, left.lo), (f64::EPSILON * f64::EPSILON, 0.0));
        let large = Double::whole((1 << 66) + 3);
        assert_eq!((large.hi, large.lo), (two_to(66), 3.0));
        assert_eq!(large.times(3.0).lo, 9.0);
        assert_eq!(large.times_double(Double { hi: 2.0, lo: 0.0 }).lo, 6.0);
    }
}
