//! Exact coverage of corners that are not on the lattice, by the parity of crossings.
//!
//! The mathematics is that of [`coverage`](super::coverage): a sample nudged right by eps and down
//! by eps^2 lies on no edge, and it is inside iff an odd number of edges crosses its height at or
//! left of it. Only the numbers differ. A finite f64 is a whole number times a power of two, so all
//! corners and centres are whole numbers of one small unit; those are compared, in 64 or 128 bits
//! where they are certain to fit and in big integers otherwise. No float is ever added or multiplied.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_traits::ToPrimitive;

use super::Oracle;
use super::values::take_apart;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Decisions, RasterizeExact};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{FreeCorners, Span};

impl RasterizeExact for Oracle {
    /// Takes no short cut, so it has no decisions to count.
    fn cover_exact(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        mut emit: impl FnMut(Span),
    ) -> Decisions {
        cover_and_count_ties(corners, bounds, &mut emit);
        Decisions::default()
    }
}

/// Emits what the triangle covers and returns how many of the samples lie exactly on an edge, once
/// for each edge: the ties, where a wrong rule shows.
pub fn cover_and_count_ties(
    corners: &FreeCorners,
    bounds: PixelRect,
    emit: &mut dyn FnMut(Span),
) -> u64 {
    let corners = corners.px();
    let rect = around(&corners).intersect(&bounds);
    if rect.is_empty() {
        return 0;
    }
    let parts = corners.map_array(|corner| corner.map_array(take_apart));
    // Centres are odd multiples of 2^-1.
    let mut unit = -1;
    for &(mantissa, exponent) in parts.as_flattened() {
        if mantissa != 0 {
            unit = unit.min(exponent);
        }
    }
    // Where corners and the samples around them are below 2^n units, differences are below 2^(n+1),
    // products of those below 2^(2n+2), and a sum of one and a smaller one below 2^(2n+3): 63 bits
    // hold them for n = 30, and 125 for n = 61. In pixels they are below 2^24.
    if unit < -37 {
        let big = parts.map_array(|corner| corner.map_array(|part| big_in(part, unit)));
        let centre = |px: i32| BigInt::from(2 * i64::from(px) + 1) << (-1 - unit);
        return scan(&big, centre, rect, emit);
    }
    let mut wide = [[0i128; 2]; 3];
    for (value, &(mantissa, exponent)) in
        wide.as_flattened_mut().iter_mut().zip(parts.as_flattened())
    {
        *value = i128::from(mantissa) << shift(mantissa, exponent, unit);
    }
    // No sample, nor the column after the last, reaches farther than these.
    let ends = [rect.x0, rect.x1, rect.y0, rect.y1].map_array(|px| centre_in(px, unit));
    if wide.as_flattened().iter().chain(&ends).all(|value| value.abs() < 1 << 30) {
        let narrow = wide.map_array(|corner| corner.map_array(|value| value as i64));
        scan(&narrow, |px| centre_in(px, unit) as i64, rect, emit)
    } else {
        scan(&wide, |px| centre_in(px, unit), rect, emit)
    }
}

/// The edge function of the edge from `a` to `b` at `p`, all in pixels: (b.x - a.x) (p.y - a.y) -
/// (b.y - a.y) (p.x - a.x). Its sign is exact; its value in square pixels is cut to 53 bits, and 0
/// where it is nearer to zero than any f64.
///
/// # Panics
/// If a coordinate is not finite.
#[must_use]
pub fn edge_value(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> (Ordering, f64) {
    let parts = [a, b, p].map_array(|point| point.map_array(take_apart));
    let mut unit = 0;
    for &(_, exponent) in parts.as_flattened() {
        unit = unit.min(exponent);
    }
    let [a, b, p] = parts.map_array(|point| point.map_array(|part| big_in(part, unit)));
    let value = (&b[0] - &a[0]) * (&p[1] - &a[1]) - (&b[1] - &a[1]) * (&p[0] - &a[0]);
    // So many bits below the first 53 go; halves of a power that may itself be no f64.
    let cut = value.bits().saturating_sub(53);
    let scale = 2 * i64::from(unit) + cut as i64;
    let (half, rest) = (scale / 2, scale - scale / 2);
    let head = (&value >> cut).to_f64().unwrap_or(f64::NAN);
    let scaled = head * 2_f64.powi(half as i32) * 2_f64.powi(rest as i32);
    (value.sign().cmp(&Sign::NoSign), scaled)
}

/// A number that was taken apart, in units of 2^`unit`.
fn big_in((mantissa, exponent): (i64, i32), unit: i32) -> BigInt {
    BigInt::from(mantissa) << shift(mantissa, exponent, unit)
}

/// How far a mantissa moves to count in units of 2^`unit`; zero stays where it is.
fn shift(mantissa: i64, exponent: i32, unit: i32) -> i32 {
    if mantissa == 0 { 0 } else { exponent - unit }
}

/// The centre of column or row `px` in units of 2^`unit`.
fn centre_in(px: i32, unit: i32) -> i128 {
    i128::from(2 * i64::from(px) + 1) << (-1 - unit)
}

/// All pixels whose squares touch the bounding box of the corners. Floors of floats are exact.
fn around(corners: &[[f64; 2]; 3]) -> PixelRect {
    let [a, b, c] = corners.map_array(|corner| corner.map_array(f64::floor));
    // Within the domain, so all of them fit i32.
    PixelRect {
        x0: a[0].min(b[0]).min(c[0]) as i32,
        y0: a[1].min(b[1]).min(c[1]) as i32,
        x1: a[0].max(b[0]).max(c[0]) as i32 + 1,
        y1: a[1].max(b[1]).max(c[1]) as i32 + 1,
    }
}

/// A whole number of any size.
trait Whole: Clone + Ord {
    fn plus(&mut self, other: &Self);
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
}

macro_rules! whole {
    ($($number:ty)*) => {$(
        impl Whole for $number {
            fn plus(&mut self, other: &Self) {
                *self += other;
            }

            fn minus(&self, other: &Self) -> Self {
                self - other
            }

            fn times(&self, other: &Self) -> Self {
                self * other
            }
        }
    )*};
}

whole!(i64 i128 BigInt);

/// Tests the samples of `rect` one by one and counts those on an edge.
fn scan<T: Whole>(
    corners: &[[T; 2]; 3],
    centre: impl Fn(i32) -> T,
    rect: PixelRect,
    emit: &mut dyn FnMut(Span),
) -> u64 {
    // From column to column, x dy grows by a constant, so that nothing is multiplied for a sample.
    let first = centre(rect.x0);
    let pixel = centre(rect.x0 + 1).minus(&first);
    let mut ties = 0;
    for y_px in rect.y0..rect.y1 {
        let y = centre(y_px);
        let pairs = [(0, 1), (1, 2), (2, 0)].map_array(|(i, j)| (&corners[i], &corners[j]));
        // Keep the edges that cross the height of the nudged samples, upper end first.
        let mut crossing = pairs.map_array(|(a, b)| match (a[1] <= y, b[1] <= y) {
            (true, false) => Some(Crossing::new(a, b, &y, &first, &pixel)),
            (false, true) => Some(Crossing::new(b, a, &y, &first, &pixel)),
            _ => None,
        });
        for (a, b) in pairs {
            // A level edge at this height holds samples, and is crossed by none.
            if a[1] != y || b[1] != y {
                continue;
            }
            let (low, high) = if a[0] < b[0] { (&a[0], &b[0]) } else { (&b[0], &a[0]) };
            for x in (rect.x0..rect.x1).map(&centre) {
                ties += u64::from(*low <= x && x <= *high);
            }
        }
        // Runs of samples that are inside become spans.
        let mut start = None;
        for x_px in rect.x0..rect.x1 {
            let mut is_inside = false;
            for edge in crossing.iter_mut().flatten() {
                is_inside ^= edge.x_dy <= edge.reached;
                ties += u64::from(edge.x_dy == edge.reached);
                edge.reached.plus(&edge.step);
            }
            match (is_inside, start) {
                (true, None) => start = Some(x_px),
                (false, Some(x0_px)) => {
                    emit(Span { y_px, x0_px, x1_px: x_px });
                    start = None;
                }
                _ => {}
            }
        }
        if let Some(x0_px) = start {
            emit(Span { y_px, x0_px, x1_px: rect.x1 });
        }
    }
    ties
}

/// Where an edge crosses the current height: at or left of x iff `x_dy` <= x dy.
struct Crossing<T> {
    /// The crossing times dy: upper.x dy + down dx.
    x_dy: T,
    /// x dy at the current column, and what the next one adds.
    reached: T,
    step: T,
}

impl<T: Whole> Crossing<T> {
    fn new(upper: &[T; 2], lower: &[T; 2], y: &T, first: &T, pixel: &T) -> Self {
        let dy = lower[1].minus(&upper[1]);
        // down (upper.x - lower.x) is minus down dx, and subtracting it needs no sum.
        let minus = y.minus(&upper[1]).times(&upper[0].minus(&lower[0]));
        Self {
            x_dy: upper[0].times(&dy).minus(&minus),
            reached: first.times(&dy),
            step: pixel.times(&dy),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;

    fn spans(corners: [[f64; 2]; 3]) -> (Vec<(i32, i32, i32)>, u64) {
        let mut spans = Vec::new();
        let corners = FreeCorners::new(corners).unwrap();
        let ties = cover_and_count_ties(&corners, PixelRect::window(8, 8), &mut |s| {
            spans.push((s.y_px, s.x0_px, s.x1_px));
        });
        (spans, ties)
    }

    /// The square with corners on centres 0.5 and 4.5, split on its diagonal, as in
    /// [`coverage`](crate::coverage): the top row and the left column belong.
    #[test]
    fn top_left_by_hand() {
        let [a, b, c, d] = [[0.5, 0.5], [4.5, 0.5], [4.5, 4.5], [0.5, 4.5]];
        assert_eq!(spans([a, b, c]).0, [(0, 0, 4), (1, 1, 4), (2, 2, 4), (3, 3, 4)]);
        assert_eq!(spans([a, c, d]).0, [(1, 0, 1), (2, 0, 2), (3, 0, 3)]);
        // Five samples on the top edge, four on each of the two that cross rows 0 to 3.
        assert_eq!(spans([a, b, c]).1, 13);
    }

    /// The diagonal moved by the smallest f64, in big integers: the samples change sides.
    #[test]
    fn the_smallest_offset_by_hand() {
        let tiny = f64::from_bits(1);
        let (right, below) = ([4.0, 0.0], [4.0, 4.0]);
        assert_eq!(
            spans([[0.0, 0.0], right, below]).0,
            [(0, 0, 4), (1, 1, 4), (2, 2, 4), (3, 3, 4)]
        );
        assert_eq!(spans([[tiny, 0.0], right, below]).0, [(0, 1, 4), (1, 2, 4), (2, 3, 4)]);
        assert_eq!(spans([[tiny, 0.0], right, below]).1, 0);
        assert_eq!(spans([[-tiny, 0.0], right, below]), spans([[0.0, tiny], right, below]));
    }

    /// A square pixel has the edge value 1 across; the smallest f64 away from the edge it is no f64
    /// where the edge is short.
    #[test]
    fn edge_values_by_hand() {
        let tiny = f64::from_bits(1);
        assert_eq!(edge_value([0.0, 0.0], [1.0, 0.0], [0.5, 1.0]), (Ordering::Greater, 1.0));
        assert_eq!(edge_value([0.0, 1.0], [0.0, 0.0], [-0.25, 9.0]), (Ordering::Less, -0.25));
        assert_eq!(edge_value([0.0, 0.0], [3.0, 3.0], [0.5, 0.5]), (Ordering::Equal, 0.0));
        assert_eq!(
            edge_value([0.0, 0.0], [4.0, 0.0], [0.5, tiny]),
            (Ordering::Greater, 4.0 * tiny)
        );
        assert_eq!(edge_value([0.0, 0.0], [tiny, 0.0], [0.5, tiny]), (Ordering::Greater, 0.0));
    }

    /// On the lattice it is the other oracle.
    #[test]
    fn on_the_lattice_by_hand() {
        let corners = [(128, 128), (1000, 77), (300, 1900)].map(|(x, y)| SubpixelPoint::new(x, y));
        let (mut ours, mut theirs) = (Vec::new(), Vec::new());
        let window = PixelRect::window(8, 8);
        Oracle.cover_exact(&corners.into(), window, |span| ours.push(span));
        rasterproof_core::contract::Rasterize::cover(&Oracle, corners, window, |span| {
            theirs.push(span)
        });
        assert!(!ours.is_empty());
        assert_eq!(ours, theirs);
    }
}
