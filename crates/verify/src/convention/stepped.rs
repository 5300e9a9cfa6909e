//! Rows by fixed-point steps: what an edge list in 26.6 and 16.16 numbers draws.
//!
//! An edge is entered at the first row below its upper end. The crossing with that row is cut to the
//! grid of the corners, the slope to 1/65536 px a row; then the slope is added row by row. Both
//! roundings move an edge by up to a step of the grid, so two triangles at one edge still agree.

use super::place::{Emit, Place, Points, around, edges};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

/// Corners on 1/64 px: the grid of the first crossing.
const STEP: i64 = 4;
/// 16.16 units in one unit of the grid.
const FINE: i64 = 65536 / 64;

/// An edge from its upper to its lower end, in units of 1/64 px, rows and columns seen from the
/// sample.
struct Edge {
    top: [i64; 2],
    bottom: [i64; 2],
}

impl Edge {
    /// Rows strictly below the upper end, down to the lower end, which belongs.
    fn rows(&self) -> std::ops::Range<i64> {
        self.top[1].div_euclid(64) + 1..self.bottom[1].div_euclid(64) + 1
    }

    /// The crossing with `row` in 16.16.
    fn crossing(&self, row: i64) -> i64 {
        let slope = (self.bottom[0] - self.top[0]) * 65536 / (self.bottom[1] - self.top[1]);
        let first = self.rows().start;
        let enter = self.top[0] + ((slope * (first * 64 - self.top[1])) >> 16);
        enter * FINE + (row - first) * slope
    }
}

/// As [`super::shape::Shape::trace`]. Nothing where a corner is not a multiple of 1/64 px.
pub(super) fn trace(points: &Points, [x, y]: [i32; 2], window: PixelRect, emit: Emit<'_>) -> bool {
    let at = points.map_array(|p| [p[0] - i64::from(x), p[1] - i64::from(y)]);
    if at.as_flattened().iter().any(|v| v % STEP != 0 || v.abs() > 1 << 22) {
        return false;
    }
    let at = at.map_array(|p| p.map_array(|v| v / STEP));
    let edges = edges(&at).map_array(|[p, q]| {
        if p[1] <= q[1] { Edge { top: p, bottom: q } } else { Edge { top: q, bottom: p } }
    });
    let rect = around(points, 2).intersect(&window);
    for y_px in rect.y0..rect.y1 {
        let row = i64::from(y_px);
        // A row is filled between its least crossing and its largest one.
        let (mut low, mut high) = (i64::MAX, i64::MIN);
        for edge in &edges {
            if edge.rows().contains(&row) {
                let crossing = edge.crossing(row);
                (low, high) = (low.min(crossing), high.max(crossing));
            }
        }
        for x_px in rect.x0..rect.x1 {
            let sample = i64::from(x_px) << 16;
            if low < sample && sample <= high {
                emit(x_px, y_px, Place::In);
            }
        }
    }
    true
}
