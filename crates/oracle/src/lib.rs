//! The truth: exact coverage, exact line pixels, exact values, each by mathematics that no engine
//! uses.
//!
//! - [`coverage`] asks for each sample alone how many edges lie to its left (parity of crossings).
//! - [`rational`] asks the same of corners that are not on the lattice.
//! - [`pixels`] asks for each pixel of the window alone whether it is nearest to the line.
//! - [`values`] puts planes through the vertices by Cramer's rule, in big integers.
//! - [`clipped`] says which pixels the near and the far plane leave, by signs of integers.
//! - [`area`] is the share of a pixel that a triangle covers.
//! - [`wide`] says of a sample whether a line with a width covers it, by squares of integers.
//! - [`formula`] is what the formulas of the pipeline give where no pixel has a part.
//! - [`segments`] is what interfaces promise of lines, by integers too.
//! - [`double_double`] says without big integers what a difference from such a value does not exceed.
//!
//! It is slow on purpose where that keeps it obvious, and imports nothing from the engines.

#[doc(hidden)]
pub mod area;
#[doc(hidden)]
pub mod clipped;
pub mod coverage;
#[doc(hidden)]
pub mod double_double;
#[doc(hidden)]
pub mod formula;
pub mod pixels;
pub mod rational;
#[doc(hidden)]
pub mod segments;
#[doc(hidden)]
pub mod source_text;
pub mod values;
#[doc(hidden)]
pub mod wide;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{
    Corners, Fragment, LineEnd, PixelPoint, ScreenLine, ScreenTriangle, Span, Varying,
};

/// The oracle as a rasterizer and a line drawer, so that it can answer wherever an engine can.
#[derive(Clone, Copy, Debug, Default)]
pub struct Oracle;

impl Interpolate for Oracle {
    /// Every number of depth and attributes is exact, and rounded once, to the nearest.
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let depths = triangle.vertices.map_array(|vertex| vertex.depth);
        let inv_w = triangle.vertices.map_array(|vertex| vertex.inv_w);
        let values = triangle.vertices.map_array(|vertex| vertex.varying);
        let corners = triangle.corners();
        let Some(exact) = values::ExactTriangle::new(&corners, depths, inv_w, [[]; 3]) else {
            return;
        };
        let mut planes = Vec::new();
        V::by_number(values, |values| {
            planes.push(exact.plane(&corners, inv_w, values));
            0.0
        });
        self.cover(corners, bounds, |span| {
            for x_px in span.x0_px..span.x1_px {
                let (depth, []) = exact.at(x_px, span.y_px);
                let numbers = exact.of_planes(&planes, x_px, span.y_px);
                let mut numbers = numbers.iter().map(values::Exact::to_f64);
                emit(Fragment {
                    x_px,
                    y_px: span.y_px,
                    depth: depth.to_f64(),
                    varying: V::by_number(values, |_| numbers.next().unwrap_or(f64::NAN)),
                });
            }
        });
    }
}

impl Oracle {
    /// The spans of [`Rasterize::cover`], by code that is compiled once and not for each caller.
    pub fn spans(&self, corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
        self.cover(corners, bounds, emit);
    }

    /// The pixels and steps of [`Oracle::line_pixels`] in the same way.
    pub fn steps<V>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(PixelPoint, u64),
    ) {
        let ends = [&line.ends[0], &line.ends[1]];
        self.steps_between(ends.map_array(|end| end.pixel), bounds, emit);
    }

    fn steps_between(
        &self,
        ends: [PixelPoint; 2],
        bounds: PixelRect,
        emit: &mut dyn FnMut(PixelPoint, u64),
    ) {
        let ends = ends.map_array(|pixel| LineEnd { pixel, depth: 0.0, varying: 0.0 });
        self.line_pixels(&ScreenLine { ends }, bounds, emit);
    }
}

impl DrawLine for Oracle {
    /// Every number is exact, and rounded once.
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let [a, b] = &line.ends;
        let length = a.pixel.x.abs_diff(b.pixel.x).max(a.pixel.y.abs_diff(b.pixel.y));
        self.line_pixels(line, bounds, |pixel, step| {
            let at = |ends| values::along_line(ends, step, u64::from(length)).to_f64();
            emit(Fragment {
                x_px: pixel.x,
                y_px: pixel.y,
                depth: at([a.depth, b.depth]),
                varying: V::by_number([a.varying, b.varying, b.varying], |[a, b, _]| at([a, b])),
            });
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;
    use rasterproof_core::triangle::{LineEnd, MAX_VALUE, PixelPoint, ScreenVertex};

    /// A constant stays the same number, whatever the triangle and w are: 432 times.
    #[test]
    fn constants_are_kept() {
        let third = 1.0 / 3.0;
        let constants = [0.1, 0.3, third, 0.7, std::f64::consts::PI, 1e-300, 5e-324, 2.5e-320]
            .into_iter()
            .chain([f64::MIN_POSITIVE, MAX_VALUE, 1.0 + f64::EPSILON, 16_777_217.0])
            .flat_map(|c| [c, -c]);
        let triangles =
            [[[0, 0], [4, 0], [0, 4]], [[-3, 1], [7, 2], [2, 9]], [[-40, -40], [41, -39], [3, 40]]];
        let [a, b] = [third, 1e-3];
        let inv_ws = [
            [1.0; 3],
            [1.0, 0.5, 0.25],
            [a, 3.0, b],
            [b, b, a],
            [1e30, 1.0, 1e-30],
            [0.7, 0.1, 0.9],
        ];
        let window = PixelRect { x0: -8, y0: -8, x1: 9, y1: 9 };
        let mut count = 0;
        for constant in constants {
            for corners in triangles {
                for inv_w in inv_ws {
                    let vertices = std::array::from_fn(|i| ScreenVertex {
                        position: SubpixelPoint::new(corners[i][0] * 256, corners[i][1] * 256),
                        depth: constant,
                        inv_w: inv_w[i],
                        varying: constant,
                    });
                    let mut pixels = 0;
                    Oracle.fragments(&ScreenTriangle { vertices }, window, |f| {
                        pixels += 1;
                        assert_eq!((f.varying, f.depth), (constant, constant), "{inv_w:?}");
                    });
                    assert!(pixels > 0);
                    count += 1;
                }
            }
            let end =
                |x, y| LineEnd { pixel: PixelPoint::new(x, y), depth: 0.0, varying: constant };
            let line = ScreenLine { ends: [end(-7, -3), end(6, 8)] };
            Oracle.draw(&line, window, |f| assert_eq!(f.varying, constant));
        }
        assert_eq!(count, 432);
    }
}
