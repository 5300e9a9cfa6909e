//! The promises of a rasterizer and of a line drawer, as traits that anybody can implement.
//!
//! An implementation does not clip, cull, depth-test, shade or antialias, and must not be made to:
//! clip and cull are stages before it, depth is a sink around `emit`, shading a function of the
//! fragment, multisampling the same triangle shifted, supersampling a larger window.
//!
//! The unit of coverage is the span, a run of pixels in one row, so that a plain fill is one
//! `slice::fill` for each row and fragments are the same walk with values attached.

use crate::grid::PixelRect;
use crate::triangle::{Corners, Fragment, ScreenLine, ScreenTriangle, Span, Varying};

/// Decides which pixels of a window a triangle covers.
pub trait Rasterize {
    /// Emits every pixel of `bounds` whose centre the triangle covers exactly once, in spans that
    /// are not empty, in any order.
    ///
    /// Covered means: strictly inside, or on a top or left edge. Winding does not matter, and a
    /// triangle of zero area covers nothing. Total for all inputs.
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span));
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
