//! Choices of coverage by scanline: one walk down a triangle, four ways to know where an edge crosses
//! a row of centres in floats, and one in big integers.
//!
//! The walk is the repaired one: rows and columns are half-open and start at the first centre,
//! ceil(x - 1/2), and the long edge is never split. What is left of the published faults is rounding
//! alone. A float can therefore put a sample on the wrong side of an edge, but two triangles that
//! share the edge compute the same wrong crossing: these choices are inaccurate and do not crack.

use std::marker::PhantomData;

use num_bigint::BigInt;
use num_traits::{Euclid, Float, ToPrimitive};

use super::{Cover, Real, Work, centre};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{FreeCorners, Span};

/// Crossings by adding the slope once a row (the book's way, from the right start).
#[derive(Clone, Copy, Debug, Default)]
pub struct Accumulated<T>(PhantomData<T>);

/// Crossings computed anew for each row, x = ax + (yc - ay) dx / dy.
#[derive(Clone, Copy, Debug, Default)]
pub struct Direct<T>(PhantomData<T>);

/// Crossings as exact quotients of big integers, every time.
#[derive(Clone, Copy, Debug, Default)]
pub struct BigIntegers;

trait Side: Sized {
    type Corner: Clone;
    const DIVISIONS: [u64; 2];
    /// The side from `a` down to `b`, at the centre of row `y_px`.
    fn start(a: &Self::Corner, b: &Self::Corner, y_px: i32) -> Self;
    /// The first column whose centre is not left of the side, in the present row.
    fn column(&self) -> i32;
    fn step(&mut self);
    /// The first row whose centre is not above a point.
    fn first_row(point: &Self::Corner) -> i32;
}

/// Walks the rows between `corners`, sorted from the top down.
#[inline]
fn walk<S: Side>(
    corners: &[S::Corner; 3],
    bounds: PixelRect,
    mut emit: impl FnMut(Span),
) -> Option<Work> {
    let [top, middle, bottom] = corners;
    let [first, split, end] = [top, middle, bottom].map_array(S::first_row);
    let (y0, y1) = (first.max(bounds.y0), end.min(bounds.y1));
    if y0 >= y1 || bounds.is_empty() {
        return Some(Work::default());
    }
    let mut long = S::start(top, bottom, y0);
    let mut short =
        if y0 < split { S::start(top, middle, y0) } else { S::start(middle, bottom, y0) };
    let mut sides = 2;
    for y_px in y0..y1 {
        if y_px == split && y_px > y0 {
            short = S::start(middle, bottom, y_px);
            sides += 1;
        }
        let (a, b) = (long.column(), short.column());
        let (x0_px, x1_px) = (a.min(b).max(bounds.x0), a.max(b).min(bounds.x1));
        if x0_px < x1_px {
            emit(Span { y_px, x0_px, x1_px });
        }
        long.step();
        short.step();
    }
    let crossings = 2 * u64::from(y1.abs_diff(y0));
    let [set_up, row] = S::DIVISIONS;
    Some(Work { divisions: sides * set_up + crossings * row, evaluations: crossings, fallbacks: 0 })
}

/// The first centre at or after `v`; the difference rounds, as it does for whoever writes this.
#[inline]
fn first_centre<T: Real>(v: T) -> i32 {
    // Saturates beyond i32, and NaN becomes 0.
    (v - T::HALF).ceil().as_()
}

#[inline]
fn sorted<T: Real>(corners: &FreeCorners) -> [[T; 2]; 3] {
    let corners = corners.px().map_array(|p| p.map_array(T::of));
    geometry::sorted(corners, |a, b| b[1] < a[1])
}

struct AccumulatedSide<T> {
    x: T,
    slope: T,
}

impl<T: Real> Side for AccumulatedSide<T> {
    type Corner = [T; 2];
    const DIVISIONS: [u64; 2] = [1, 0];
    #[inline]
    fn start(a: &[T; 2], b: &[T; 2], y_px: i32) -> Self {
        let slope = (b[0] - a[0]) / (b[1] - a[1]);
        Self { x: a[0] + (centre::<T>(y_px) - a[1]) * slope, slope }
    }
    #[inline]
    fn column(&self) -> i32 {
        first_centre(self.x)
    }
    #[inline]
    fn step(&mut self) {
        self.x = self.x + self.slope;
    }
    #[inline]
    fn first_row(point: &[T; 2]) -> i32 {
        first_centre(point[1])
    }
}

struct DirectSide<T> {
    a: [T; 2],
    dx: T,
    dy: T,
    y: T,
}

impl<T: Real> Side for DirectSide<T> {
    type Corner = [T; 2];
    const DIVISIONS: [u64; 2] = [0, 1];
    #[inline]
    fn start(a: &[T; 2], b: &[T; 2], y_px: i32) -> Self {
        Self { a: *a, dx: b[0] - a[0], dy: b[1] - a[1], y: centre(y_px) }
    }
    #[inline]
    fn column(&self) -> i32 {
        first_centre(self.a[0] + (self.y - self.a[1]) * self.dx / self.dy)
    }
    #[inline]
    fn step(&mut self) {
        // A whole number and a half below 2^23: exact in f32 as well.
        self.y = self.y + T::one();
    }
    #[inline]
    fn first_row(point: &[T; 2]) -> i32 {
        first_centre(point[1])
    }
}

impl<T: Real> Cover for Accumulated<T> {
    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        walk::<AccumulatedSide<T>>(&sorted(free), bounds, emit)
    }
}

impl<T: Real> Cover for Direct<T> {
    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        walk::<DirectSide<T>>(&sorted(free), bounds, emit)
    }
}

/// A point in whole numbers of 2^-bits px.
#[derive(Clone, Debug)]
struct BigPoint {
    x: BigInt,
    y: BigInt,
    bits: u32,
}

struct BigSide {
    a: BigPoint,
    dx: BigInt,
    dy: BigInt,
    y_px: i32,
}

/// ceil(n / d) for d > 0, within i32.
fn ceil_div(n: &BigInt, d: &BigInt) -> i32 {
    // Corners lie in the domain, so columns and rows fit.
    (-(-n).div_euclid(d)).to_i32().unwrap_or(i32::MAX)
}

impl Side for BigSide {
    type Corner = BigPoint;
    const DIVISIONS: [u64; 2] = [0, 1];
    fn start(a: &BigPoint, b: &BigPoint, y_px: i32) -> Self {
        Self { a: a.clone(), dx: &b.x - &a.x, dy: &b.y - &a.y, y_px }
    }
    fn column(&self) -> i32 {
        // ceil(x - 1/2) with x = ax + (yc - ay) dx / dy, all in units of 2^-bits px.
        let half = BigInt::from(1) << (self.a.bits - 1);
        let y = BigInt::from(2 * i64::from(self.y_px) + 1) << (self.a.bits - 1);
        let n = (&self.a.x - half) * &self.dy + (y - &self.a.y) * &self.dx;
        ceil_div(&n, &(&self.dy << self.a.bits))
    }
    fn step(&mut self) {
        self.y_px += 1;
    }
    fn first_row(point: &BigPoint) -> i32 {
        let half = BigInt::from(1) << (point.bits - 1);
        ceil_div(&(&point.y - half), &(BigInt::from(1) << point.bits))
    }
}

impl Cover for BigIntegers {
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        let corners = geometry::sorted(free.px(), |a, b| a[1].total_cmp(&b[1]).is_gt());
        // The smallest unit of which every coordinate and every centre is a whole number.
        let bits = corners.as_flattened().iter().map(|&v| bits_after_point(v)).fold(1, u32::max);
        let whole = |v: f64| {
            let (mantissa, exponent, sign) = Float::integer_decode(v);
            let shift = i32::from(exponent) + bits as i32;
            let whole = BigInt::from(mantissa) * sign;
            // Shifts right only where the bits that leave are zero.
            if shift >= 0 { whole << shift } else { whole >> -shift }
        };
        let points = corners.map_array(|[x, y]| BigPoint { x: whole(x), y: whole(y), bits });
        walk::<BigSide>(&points, bounds, emit)
    }
}

/// Binary digits of a finite number after the point.
fn bits_after_point(v: f64) -> u32 {
    let (mantissa, exponent, _) = Float::integer_decode(v);
    if mantissa == 0 {
        return 0;
    }
    let last = i32::from(exponent) + mantissa.trailing_zeros() as i32;
    (-last).max(0) as u32
}
