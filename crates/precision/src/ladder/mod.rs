//! Ladders of precision: the same job in several arithmetics, so that `cost` can measure what each
//! step of accuracy costs and what it removes.
//!
//! A choice is a small type. Where only the number type differs, it is one algorithm generic over
//! [`Real`]. Choices take corners as they were given; one that works on the lattice snaps them itself,
//! in the time that is measured. Choices are here to be measured, faults included: to draw a triangle,
//! take the engines of [`raster`](rasterproof_core::raster). Where a choice is such an engine, `cost` wraps it
//! ([`Snapped`], [`Unsnapped`]) and says so; nothing here is a copy of one.

pub mod antialiasing;
pub mod area;
pub mod depth;
pub mod edges;
pub mod interpolation;
pub mod levels;
pub mod lines;
pub mod scanline;
pub mod shadow;

use std::ops::Add;

use num_traits::{AsPrimitive, Float};

use rasterproof_core::contract::{Rasterize, RasterizeExact};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{Corners, FreeCorners, Span};

pub trait Real:
    Float + Default + AsPrimitive<i32> + AsPrimitive<f64> + Send + Sync + 'static
{
    const NAME: &'static str;
    /// Unit roundoff: the largest relative error of one operation.
    const UNIT: f64;
    fn of(value: f64) -> Self;
    const HALF: Self;
}

impl Real for f32 {
    const NAME: &'static str = "f32";
    const UNIT: f64 = 1.0 / (1u64 << 24) as f64;
    const HALF: Self = 0.5;
    #[inline]
    fn of(value: f64) -> Self {
        value as Self
    }
}

impl Real for f64 {
    const NAME: &'static str = "f64";
    const UNIT: f64 = 1.0 / (1u64 << 53) as f64;
    const HALF: Self = 0.5;
    #[inline]
    fn of(value: f64) -> Self {
        value
    }
}

/// What a choice did, where that explains its time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Work {
    pub divisions: u64,
    /// Edges asked at a sample, or crossings of an edge and a row.
    pub evaluations: u64,
    /// Evaluations that needed exact arithmetic after a filter in floats.
    pub fallbacks: u64,
}

impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            divisions: self.divisions + other.divisions,
            evaluations: self.evaluations + other.evaluations,
            fallbacks: self.fallbacks + other.fallbacks,
        }
    }
}

/// Decides which pixels a triangle covers, with whatever error the choice has.
pub trait Cover {
    /// Whether the choice may be given this triangle; otherwise why not.
    fn accepts(&self, _free: &FreeCorners, _bounds: PixelRect) -> Result<(), String> {
        Ok(())
    }

    /// Emits the pixels of `bounds` that the choice takes for covered by the corners as given, in spans
    /// that are not empty. The rule is that of [`Rasterize::cover`]; how well it is kept is what is
    /// measured. Returns the work as far as the choice can count it, in all fields or in none.
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work>;

    fn paint(&self, triangles: &[FreeCorners], bounds: PixelRect, target: &mut Frame<u32>) {
        for (corners, colour) in triangles.iter().zip(1..) {
            self.cover(corners, bounds, |span| {
                target.span_mut(span.y_px, span.x0_px, span.x1_px).fill(colour);
            });
        }
    }
}

/// The centre of a pixel along an axis; exact below 2^23 in f32.
#[inline]
fn centre<T: Real>(px: i32) -> T {
    T::of(f64::from(px)) + T::HALF
}

/// Rounds the corners to the lattice; `None` where one lies at the very end of the domain.
#[inline]
pub fn snap(corners: &FreeCorners) -> Option<Corners> {
    let [a, b, c] = corners.px();
    let point = |[x, y]: [f64; 2]| SubpixelPoint::from_px(x, y).ok();
    Some([point(a)?, point(b)?, point(c)?])
}

/// The reason of a choice whose corners cannot be snapped.
fn snappable(corners: &FreeCorners) -> Result<Corners, String> {
    snap(corners).ok_or_else(|| "a corner rounds to a point outside the lattice".to_owned())
}

/// A rasterizer of the lattice as a choice: snaps, then draws.
#[derive(Clone, Copy, Debug)]
pub struct Snapped<E>(pub E);

impl<E: Rasterize> Cover for Snapped<E> {
    fn accepts(&self, free: &FreeCorners, _bounds: PixelRect) -> Result<(), String> {
        snappable(free).map(drop)
    }

    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        if let Some(corners) = snap(free) {
            self.0.cover(corners, bounds, emit);
        }
        None
    }
}

/// An exact rasterizer of corners as given, as a choice.
#[derive(Clone, Copy, Debug)]
pub struct Unsnapped<E>(pub E);

impl<E: RasterizeExact> Cover for Unsnapped<E> {
    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        let decisions = self.0.cover_exact(free, bounds, emit);
        Some(Work {
            divisions: 0,
            evaluations: decisions.by_filter + decisions.by_fallback,
            fallbacks: decisions.by_fallback,
        })
    }
}
