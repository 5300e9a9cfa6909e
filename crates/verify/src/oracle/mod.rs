//! The truth: exact coverage, exact line pixels, exact values, each by mathematics that no engine
//! uses.
//!
//! - [`coverage`] asks for each sample alone how many edges lie to its left (parity of crossings).
//! - [`rational`] asks the same of corners that are not on the lattice.
//! - [`pixels`] asks for each pixel of the window alone whether it is nearest to the line.
//! - [`values`] puts planes through the vertices by Cramer's rule, in big integers.
//! - [`double_double`] says without big integers what a difference from such a value does not exceed.
//!
//! It is slow on purpose where that keeps it obvious, and imports nothing from the engines.

pub mod coverage;
#[doc(hidden)]
pub mod double_double;
pub mod pixels;
pub mod rational;
pub mod values;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, ScreenLine, ScreenTriangle, Varying};

/// The oracle as a rasterizer and a line drawer, so that it can answer wherever an engine can.
#[derive(Clone, Copy, Debug, Default)]
pub struct Oracle;

impl Interpolate for Oracle {
    /// The exact weights of the three vertices, rounded once; the depth is exact, rounded once.
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let [v0, v1, v2] = &triangle.vertices;
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let depths = triangle.vertices.map_array(|vertex| vertex.depth);
        let inv_w = triangle.vertices.map_array(|vertex| vertex.inv_w);
        let corners = triangle.corners();
        let Some(exact) = values::ExactTriangle::new(&corners, depths, inv_w, unit) else {
            return;
        };
        self.cover(corners, bounds, |span| {
            for x_px in span.x0_px..span.x1_px {
                let (depth, weights) = exact.at(x_px, span.y_px);
                let [b0, b1, b2] = weights.map_array(|weight| weight.to_f64());
                emit(Fragment {
                    x_px,
                    y_px: span.y_px,
                    depth: depth.to_f64(),
                    varying: v0.varying * b0 + v1.varying * b1 + v2.varying * b2,
                });
            }
        });
    }
}

impl DrawLine for Oracle {
    /// The weights of the two ends are exact quotients, rounded once.
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let [a, b] = &line.ends;
        let length = a.pixel.x.abs_diff(b.pixel.x).max(a.pixel.y.abs_diff(b.pixel.y));
        self.line_pixels(line, bounds, |pixel, step| {
            let weight = |ends| values::along_line(ends, step, u64::from(length)).to_f64();
            emit(Fragment {
                x_px: pixel.x,
                y_px: pixel.y,
                depth: weight([a.depth, b.depth]),
                varying: a.varying * weight([1.0, 0.0]) + b.varying * weight([0.0, 1.0]),
            });
        });
    }
}
