//! The shapes a program may draw for a triangle, each as a pure function: for every pixel in or on
//! it, the place where the pixel lies. Exact in whole numbers; independent of the engines.

use super::area_coverage;
use super::half_planes::{self, HalfPlanes};
use super::outline::{self, LineTie};
use super::place::{Emit, Points, turn};
use super::samples::{self, Pattern};
use super::scan::Scan;
use super::stepped;
use rasterproof_core::grid::PixelRect;

/// Which pixels belong to a triangle, ties apart. Lengths are in subpixels (1/256 px), positions
/// from the upper left corner of a pixel, y down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Shape {
    /// The sample point lies in the triangle.
    Point {
        /// Right of the pixel's left border.
        x: i32,
        /// Below the pixel's upper border.
        y: i32,
    },
    /// Row by row: the left crossing is compared at `left`, the right one at `right`, as rounding
    /// both to whole pixels does.
    Rows { left: i32, right: i32, y: i32 },
    /// Row by row: the crossing with an edge's first row is cut to the grid of the corners, and the
    /// slope to 1/65536, then added row by row.
    Stepped { x: i32, y: i32 },
    /// The sample point lies at most `reach` outside the triangle: along one axis, or (`square`)
    /// along both. A square of half a pixel about the centre is the pixel: any touch.
    Reach { x: i32, y: i32, reach: i32, square: bool },
    /// At least that share of a pixel's area lies in the triangle.
    Share {
        x: i32,
        y: i32,
        /// 1 to 100.
        percent: i32,
    },
    /// At least so many of four samples lie in the triangle.
    Samples {
        x: i32,
        y: i32,
        pattern: Pattern,
        /// 1 to 4.
        least: u8,
    },
    /// Corners are whole pixels: every pixel whose corner lies in the triangle, and the three sides
    /// as lines.
    Outline(LineTie),
    /// Row by row in numbers of a library's own.
    Scan(Scan),
}

impl Shape {
    /// Whether it says what a triangle without area leaves.
    pub(super) fn draws_flat(self) -> bool {
        matches!(self, Self::Outline(_) | Self::Scan(Scan::Joined))
    }

    /// Calls `emit` with every pixel of `window` that is not outside. A triangle without area has
    /// none, but for what [`Shape::draws_flat`]. Nothing where this shape is not computed for triangles so large: then false.
    pub(super) fn trace(self, points: &Points, window: PixelRect, emit: Emit<'_>) -> bool {
        if turn(points) == 0 && !self.draws_flat() {
            return true;
        }
        match self {
            Self::Share { x, y, percent } => {
                area_coverage::trace(points, [x, y], percent, window, emit)
            }
            Self::Outline(tie) => outline::trace(points, tie, window, emit),
            Self::Scan(scan) => scan.trace(points, window, emit),
            Self::Samples { x, y, pattern, least } => {
                samples::trace(points, [x, y], (pattern, least), window, emit)
            }
            Self::Stepped { x, y } => stepped::trace(points, [x, y], window, emit),
            Self::Point { x, y } => half_planes::at(x, y).trace(points, window, emit),
            Self::Rows { left, right, y } => {
                HalfPlanes { rows: true, left, right, ..half_planes::at(0, y) }
                    .trace(points, window, emit)
            }
            Self::Reach { x, y, reach, square } => {
                HalfPlanes { boxed: true, reach, square, ..half_planes::at(x, y) }
                    .trace(points, window, emit)
            }
        }
    }
}
