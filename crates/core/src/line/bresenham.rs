//! Bresenham's line drawer, in all octants, with integer decisions.
//!
//! Sources: Bresenham 1965, "Algorithm for computer control of a digital plotter"; SYSU assignment
//! 2, task 1. A decision variable says on which side of the midpoint between two candidate pixels
//! the line passes. What differs from the assignment: the side of a tie is fixed with respect to
//! the end with the smaller major coordinate, so that both directions light the same pixels (as
//! published, 1,428 of 4,225 lines change when they are drawn backwards; and the text says p <= 0
//! where the code says p < 0); a point is one pixel with weight 0 instead of 0/0; and pixels outside
//! the window are not walked over one by one, the first and the last inside are computed.

use crate::contract::DrawLine;
use crate::grid::PixelRect;
use crate::triangle::{Fragment, ScreenLine, Varying};

/// Bresenham's drawer; see the module's description.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bresenham;

impl DrawLine for Bresenham {
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let [from, to] = &line.ends;
        let [ax, ay, bx, by] = [from.pixel.x, from.pixel.y, to.pixel.x, to.pixel.y].map(i64::from);
        let steep = (by - ay).abs() > (bx - ax).abs();
        // Turn the steep octants over: u runs along the major axis, v along the minor one.
        let (u, v, window) = if steep {
            ([ay, by], [ax, bx], [[bounds.y0, bounds.y1], [bounds.x0, bounds.x1]])
        } else {
            ([ax, bx], [ay, by], [[bounds.x0, bounds.x1], [bounds.y0, bounds.y1]])
        };
        let (du, dv) = ((u[1] - u[0]).abs(), (v[1] - v[0]).abs());
        let backwards = u[1] < u[0];
        let (u_sign, v_sign) = (if backwards { -1 } else { 1 }, if v[1] < v[0] { -1 } else { 1 });
        let octant = Octant { du, dv, tie: i64::from(backwards) };

        // Find the steps inside the window; v_window counts pixels risen.
        let inside = |[low, high]: [i32; 2], start: i64, sign: i64| {
            let (low, high) = (i64::from(low), i64::from(high));
            if sign > 0 { (low - start, high - start) } else { (start - high + 1, start - low + 1) }
        };
        let u_window = inside(window[0], u[0], u_sign);
        let v_window = inside(window[1], v[0], v_sign);
        let first = octant.first_step_at(v_window.0).max(u_window.0).max(0);
        let end = octant.first_step_at(v_window.1).min(u_window.1).min(du + 1);
        if first >= end || v_window.0 >= v_window.1 {
            return;
        }

        let (mut risen, mut decision) = octant.enter(first);
        for step in first..end {
            let (major, minor) = (u[0] + u_sign * step, v[0] + v_sign * risen);
            let (x, y) = if steep { (minor, major) } else { (major, minor) };
            let weight = if du == 0 { 0.0 } else { step as f64 / du as f64 };
            emit(Fragment {
                // Inside the window, so both fit i32.
                x_px: x as i32,
                y_px: y as i32,
                depth: from.depth + (to.depth - from.depth) * weight,
                varying: from.varying + (to.varying - from.varying) * weight,
            });
            if decision >= 0 {
                risen += 1;
                decision -= 2 * du;
            }
            decision += 2 * dv;
        }
    }
}

/// A line in the first octant: `dv` <= `du` < 2^32.
struct Octant {
    du: i64,
    dv: i64,
    /// 1 where a tie keeps the row, 0 where it leaves it.
    tie: i64,
}

impl Octant {
    /// The first step at which the line has risen by at least `rise` pixels, unbounded.
    ///
    /// After i steps it has risen by floor((2 i dv + du - tie) / (2 du)) pixels. That reaches
    /// `rise` when i >= (2 du rise - du + tie) / (2 dv).
    fn first_step_at(&self, rise: i64) -> i64 {
        if rise <= 0 {
            return 0;
        }
        if self.dv == 0 || rise > self.dv {
            return i64::MAX;
        }
        let (du, dv, tie) = (i128::from(self.du), i128::from(self.dv), i128::from(self.tie));
        let numerator = 2 * du * i128::from(rise) - du + tie;
        // Positive over positive; at most du + 1 for a rise of at most dv.
        ((numerator + 2 * dv - 1) / (2 * dv)) as i64
    }

    /// Pixels risen at `step`, and the decision for the next one:
    /// p = 2 (step + 1) dv - du - tie - 2 du risen. A negative p keeps the row.
    fn enter(&self, step: i64) -> (i64, i64) {
        if self.du == 0 {
            return (0, -1);
        }
        let (du, dv, tie) = (i128::from(self.du), i128::from(self.dv), i128::from(self.tie));
        let twice = 2 * i128::from(step) * dv;
        let risen = (twice + du - tie) / (2 * du);
        // In [-2 du, 2 du).
        (risen as i64, (twice + 2 * dv - du - tie - 2 * du * risen) as i64)
    }
}
