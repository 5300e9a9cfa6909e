//! The promises of a rasterizer and of a line drawer, as traits that anybody can implement.
//!
//! An implementation does not clip, cull, depth-test, shade or antialias, and must not be made to:
//! clip and cull are stages before it, depth is a sink around `emit`, shading a function of the
//! fragment, multisampling the same triangle shifted, supersampling a larger window.
//!
//! The unit of coverage is the span, a run of pixels in one row, so that a plain fill is one
//! `slice::fill` for each row and fragments are the same walk with values attached.

use std::ops::AddAssign;

use crate::grid::PixelRect;
use crate::triangle::{Corners, Fragment, FreeCorners, ScreenLine, ScreenTriangle, Span, Varying};

/// Decides which pixels of a window a triangle covers.
pub trait Rasterize {
    /// Emits every pixel of `bounds` whose centre the triangle covers exactly once, in spans that
    /// are not empty, in any order.
    ///
    /// Covered means: strictly inside, or on a top or left edge. Winding does not matter, and a
    /// triangle of zero area covers nothing. Total for all inputs.
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span));

    /// Bits of the integers that decide this triangle, where the engine has several to choose from.
    fn word_bits(&self, _corners: &Corners) -> Option<u32> {
        None
    }
}

/// Decides which pixels of a window a triangle covers whose corners are not snapped to the lattice.
pub trait RasterizeExact {
    /// Emits every pixel of `bounds` whose centre the triangle covers exactly once, in spans that
    /// are not empty, in any order.
    ///
    /// Covered means what it means for [`Rasterize`], of the triangle as it was given: nothing is
    /// snapped or rounded. Exact for all corners that [`FreeCorners`] holds, so for every finite
    /// f32 and f64 in the domain. Returns how the decisions were made; no globals count them.
    fn cover_exact(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        emit: impl FnMut(Span),
    ) -> Decisions;
}

/// How an adaptive engine decided. What one decision is depends on the engine: for the edge
/// function the side of one edge that one sample lies on, for the scanline the column where one
/// edge crosses one row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Decisions {
    /// Decided in plain floats, with an error bound that left no doubt.
    pub by_filter: u64,
    /// In doubt, so decided by exact arithmetic.
    pub by_fallback: u64,
}

impl AddAssign for Decisions {
    fn add_assign(&mut self, other: Self) {
        self.by_filter += other.by_filter;
        self.by_fallback += other.by_fallback;
    }
}

/// Computes the values of a triangle at the pixels it covers.
pub trait Interpolate: Rasterize {
    /// Emits a fragment for exactly the pixels of [`Rasterize::cover`], with depth interpolated
    /// linearly in the window and the varying perspective-correctly (v/w and 1/w are linear).
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    );

    /// As [`Interpolate::fragments`] of the same triangle with three equal w, bit for bit: values
    /// linear in the window. The w of the vertices are not looked at.
    ///
    /// An engine may leave out the division by 1/w here, where that changes no bit.
    fn affine_fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        self.fragments(&triangle.with_equal_w(), bounds, emit);
    }

    /// The fragments of [`Interpolate::fragments`], or of [`Interpolate::affine_fragments`] where
    /// `affine`, bit for bit, in runs: for those who need the varying of some of them only.
    fn runs<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        affine: bool,
        take: &mut dyn FnMut(Run<'_, V>),
    ) {
        let emit = |Fragment { x_px, y_px, depth, varying }| {
            take(Run { y_px, x0_px: x_px, depths: &[depth], values: &mut Known(varying) });
        };
        if affine {
            self.affine_fragments(triangle, bounds, emit);
        } else {
            self.fragments(triangle, bounds, emit);
        }
    }
}

/// Adjacent fragments of one row, at most [`RUN`], whose varyings are computed when they are asked
/// for.
pub struct Run<'a, V> {
    /// The row.
    pub y_px: i32,
    /// The first column.
    pub x0_px: i32,
    /// The depth of each pixel.
    pub depths: &'a [f64],
    /// The varying of each pixel.
    pub values: &'a mut dyn Varyings<V>,
}

/// The most fragments of a [`Run`].
pub const RUN: usize = 16;

/// What computes the varyings of a [`Run`].
pub trait Varyings<V> {
    /// Those of the pixels `from..to`, counted from the first of the run; not beyond its last.
    fn varyings(&mut self, from: usize, to: usize) -> &[V];
}

impl<V: Copy> Run<'_, V> {
    /// One past the last column.
    #[must_use]
    #[inline]
    pub fn x1_px(&self) -> i32 {
        self.x0_px + self.depths.len() as i32
    }

    /// All fragments, from the first on.
    #[inline]
    pub fn each(self, mut emit: impl FnMut(Fragment<V>)) {
        let varyings = self.values.varyings(0, self.depths.len());
        for ((x_px, depth), varying) in (self.x0_px..).zip(self.depths).zip(varyings) {
            emit(Fragment { x_px, y_px: self.y_px, depth: *depth, varying: *varying });
        }
    }
}

/// A run of one fragment.
struct Known<V>(V);

impl<V> Varyings<V> for Known<V> {
    fn varyings(&mut self, from: usize, to: usize) -> &[V] {
        &std::slice::from_ref(&self.0)[from..to]
    }
}

/// Decides which pixels of a window a line segment lights, and its values there.
pub trait DrawLine {
    /// Emits the pixels of `line` that lie in `bounds`, once each, in order from the first end to
    /// the second, with depth and varying interpolated linearly along the major axis.
    ///
    /// One pixel for each step along the major axis (the longer one), both ends included; beside
    /// it the pixel nearest to the ideal line. Halfway between two pixels, the one farther along
    /// in the minor direction, seen from the end with the smaller major coordinate, is lit; so
    /// both drawing directions light the same pixels. A segment of length zero is its one pixel,
    /// with the values of the first end. Work is bounded by the window, not by the line.
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    );
}

impl<R: Rasterize> Rasterize for &R {
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
        (**self).cover(corners, bounds, emit);
    }
}

impl<R: RasterizeExact> RasterizeExact for &R {
    fn cover_exact(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        emit: impl FnMut(Span),
    ) -> Decisions {
        (**self).cover_exact(corners, bounds, emit)
    }
}

impl<R: Interpolate> Interpolate for &R {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        (**self).fragments(triangle, bounds, emit);
    }

    fn affine_fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        (**self).affine_fragments(triangle, bounds, emit);
    }

    fn runs<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        affine: bool,
        take: &mut dyn FnMut(Run<'_, V>),
    ) {
        (**self).runs(triangle, bounds, affine, take);
    }
}

impl<D: DrawLine> DrawLine for &D {
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        (**self).draw(line, bounds, emit);
    }
}
