//! The shapes a program may draw for a triangle, each as a pure function: for every pixel in or on
//! it, the place where the pixel lies. Exact in whole numbers; independent of the engines.
//!
//! Most shapes are half-planes, moved: a sample point moves the pixel, samples that differ for left
//! and right edges are crossings rounded row by row, a reach moves the edges outward.

use serde::Serialize;

use super::outline::{self, LineTie};
use super::share;
use super::stepped;
use crate::grid::PixelRect;

/// Which pixels belong to a triangle, ties apart. Lengths are in subpixels (1/256 px), positions
/// from the upper left corner of a pixel, y down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
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
    Rows {
        /// Where left edges are asked.
        left: i32,
        /// Where right edges are asked.
        right: i32,
        /// The height of the row.
        y: i32,
    },
    /// Row by row: the crossing with an edge's first row is cut to the grid of the corners, and the
    /// slope to 1/65536, then added row by row.
    Stepped {
        /// As for a point.
        x: i32,
        /// As for a point.
        y: i32,
    },
    /// The sample point lies at most `reach` outside the triangle: along one axis, or (`square`)
    /// along both. A square of half a pixel about the centre is the pixel: any touch.
    Reach {
        /// As for a point.
        x: i32,
        /// As for a point.
        y: i32,
        /// Subpixels.
        reach: i32,
        /// Whether the reach is that of a square.
        square: bool,
    },
    /// At least that share of a pixel's area lies in the triangle.
    Share {
        /// The centre of the area.
        x: i32,
        /// The centre of the area.
        y: i32,
        /// 1 to 100.
        percent: i32,
    },
    /// Corners are whole pixels: every pixel whose corner lies in the triangle, and the three sides
    /// as lines.
    Outline(LineTie),
}

/// The direction an edge faces: that of its outward normal. On the screen, y down: N is up.
pub const FACINGS: [&str; 8] = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];

/// Where a pixel lies that is not outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Inside.
    In,
    /// Exactly on the edge that faces that way: an index into [`FACINGS`].
    Edge(usize),
    /// On several edges: a corner. One bit for each facing.
    Corner(u8),
    /// Exactly as much as is asked for.
    Level,
}

/// a x + b y + c > 0 inside.
#[derive(Clone, Copy)]
struct Side<T> {
    a: T,
    b: T,
    c: T,
    facing: usize,
}

/// The facing of the outward normal (-a, -b).
fn facing(a: i64, b: i64) -> usize {
    match (a.signum(), b.signum()) {
        (0, 1) => 0,
        (-1, 1) => 1,
        (-1, 0) => 2,
        (-1, -1) => 3,
        (0, -1) => 4,
        (1, -1) => 5,
        (1, 0) => 6,
        (1, 1) => 7,
        _ => unreachable!("an edge has a length"),
    }
}

/// Corners on the grid, in subpixels.
pub(super) type Points = [[i64; 2]; 3];

/// Twice the area; positive where the corners turn clockwise on the screen.
pub(super) fn turn([a, b, c]: &Points) -> i128 {
    let wide = i128::from;
    wide(b[0] - a[0]) * wide(c[1] - a[1]) - wide(b[1] - a[1]) * wide(c[0] - a[0])
}

impl Shape {
    /// Calls `emit` with every pixel of `window` that is not outside. A triangle without area has
    /// none, but for its outline. Nothing where this shape is not computed for triangles so large: then false.
    pub(super) fn trace(
        self,
        points: &Points,
        window: PixelRect,
        emit: &mut dyn FnMut(i32, i32, Place),
    ) -> bool {
        let sign = turn(points).signum() as i64;
        if sign == 0 && !matches!(self, Self::Outline(_)) {
            return true;
        }
        match self {
            Self::Share { x, y, percent } => share::trace(points, [x, y], percent, window, emit),
            Self::Outline(tie) => outline::trace(points, tie, window, emit),
            Self::Stepped { x, y } => stepped::trace(points, [x, y], window, emit),
            Self::Point { .. } | Self::Rows { .. } | Self::Reach { .. } => {
                let sides = self.sides(points, sign);
                let near = points.as_flattened().iter().all(|v| v.abs() < 1 << 28);
                let rect = around(points, 2).intersect(&window);
                if near {
                    let narrow = |v: i128| v as i64;
                    let sides: Vec<_> = sides
                        .iter()
                        .map(|s| Side {
                            a: narrow(s.a),
                            b: narrow(s.b),
                            c: narrow(s.c),
                            facing: s.facing,
                        })
                        .collect();
                    walk(&sides, rect, emit);
                } else {
                    walk(&sides, rect, emit);
                }
                true
            }
        }
    }

    /// The half-planes of this shape, moved so that a pixel is asked at its upper left corner.
    fn sides(self, points: &Points, sign: i64) -> Vec<Side<i128>> {
        let (left, right, y, reach, square) = match self {
            Self::Rows { left, right, y } => (left, right, y, 0, false),
            Self::Reach { x, y, reach, square } => (x, x, y, reach, square),
            Self::Point { x, y } => (x, x, y, 0, false),
            _ => unreachable!("not a shape of half-planes"),
        };
        let rows = matches!(self, Self::Rows { .. });
        let boxed = matches!(self, Self::Reach { .. });
        let side = |a: i64, b: i64, [px, py]: [i64; 2], reach: i64| {
            let x = if a > 0 { left } else { right };
            let [wa, wb] = [a, b].map(i128::from);
            let c = wa * (i128::from(x) - i128::from(px)) + wb * (i128::from(y) - i128::from(py));
            Side { a: wa, b: wb, c: c + i128::from(reach), facing: facing(a, b) }
        };
        let mut sides = Vec::with_capacity(7);
        for (i, p) in points.iter().enumerate() {
            let q = points[(i + 1) % 3];
            let (a, b) = (sign * (p[1] - q[1]), sign * (q[0] - p[0]));
            // What is level or upright is among the borders of the box.
            if (rows && a == 0) || (boxed && (a == 0 || b == 0)) {
                continue;
            }
            let width = if square { a.abs() + b.abs() } else { a.abs().max(b.abs()) };
            sides.push(side(a, b, *p, width * i64::from(reach)));
        }
        let ends = |axis: usize| {
            let v = points.map(|p| p[axis]);
            (v.into_iter().min().unwrap_or(0), v.into_iter().max().unwrap_or(0))
        };
        let ((x0, x1), (y0, y1)) = (ends(0), ends(1));
        if rows || boxed {
            sides.push(side(0, 1, [x0, y0], reach.into()));
            sides.push(side(0, -1, [x0, y1], reach.into()));
        }
        if boxed {
            sides.push(side(1, 0, [x0, y0], reach.into()));
            sides.push(side(-1, 0, [x1, y0], reach.into()));
        }
        sides
    }
}

/// Pixels within `margin_px` of the corners, which must leave room for every sample position.
pub(super) fn around(points: &Points, margin_px: i64) -> PixelRect {
    let ends = |axis: usize| {
        let v = points.map(|p| p[axis].div_euclid(256));
        let low = v.into_iter().min().unwrap_or(0) - margin_px;
        let high = v.into_iter().max().unwrap_or(0) + margin_px + 1;
        // Corners are i32 subpixels, so pixels fit with room to spare.
        (low as i32, high as i32)
    };
    let ((x0, x1), (y0, y1)) = (ends(0), ends(1));
    PixelRect { x0, y0, x1, y1 }
}

/// The same loop in words that cannot overflow: i64 for corners within 2^28, else i128.
fn walk<T>(sides: &[Side<T>], rect: PixelRect, emit: &mut dyn FnMut(i32, i32, Place))
where
    T: Copy + Ord + From<i64> + std::ops::Add<Output = T> + std::ops::Mul<Output = T>,
{
    let (zero, pixel) = (T::from(0), T::from(256));
    for y_px in rect.y0..rect.y1 {
        let corner = [rect.x0, y_px].map(|px| T::from(i64::from(px)) * pixel);
        let mut values = [zero; 7];
        for (value, side) in values.iter_mut().zip(sides) {
            *value = side.a * corner[0] + side.b * corner[1] + side.c;
        }
        let values = &mut values[..sides.len()];
        for x_px in rect.x0..rect.x1 {
            if values.iter().all(|&v| v >= zero) {
                emit(x_px, y_px, place(values.iter().map(|&v| v == zero), sides));
            }
            for (value, side) in values.iter_mut().zip(sides) {
                *value = *value + side.a * pixel;
            }
        }
    }
}

fn place<T>(zeros: impl Iterator<Item = bool>, sides: &[Side<T>]) -> Place {
    let (mut bits, mut count, mut last) = (0, 0, 0);
    for (_, side) in zeros.zip(sides).filter(|(zero, _)| *zero) {
        bits |= 1 << side.facing;
        count += 1;
        last = side.facing;
    }
    match count {
        0 => Place::In,
        1 => Place::Edge(last),
        _ => Place::Corner(bits),
    }
}
