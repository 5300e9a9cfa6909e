//! How far a value that is interpolated in f32 may be from the exact one.
//!
//! The specifications of graphics interfaces give formulas for values and no bound on their error. The
//! bound here is derived: what roundings in f32 can do to a value that is set up as a plane over a page.
//!
//! # The bound
//! A plane a(x, y) = a0 + gx (x - x0) + gy (y - y0) over corners with values a0, a1, a2 has
//! gx = ((a1 - a0) e2y - (a2 - a0) e1y) / A, where e1 and e2 are the edges from the first corner and A
//! is twice the area. Let Gx = (|a1 - a0| |e2y| + |a2 - a0| |e1y|) / |A|, Gy alike, X and Y the largest
//! distance over which the plane is carried (across a page, or to a corner), M the largest |a|. With
//! u = 2^-24 each rounding moves the result by at most u (M + Gx X + Gy Y). On the way from corners to
//! a pixel a value meets 16 of them: the value given in f32 (1), a clip coordinate and its division by
//! w (3), the viewport (2), a difference of values (1), two products and their difference (2), the
//! area's reciprocal and the product with it (3), the distance, its product and two sums (4).
//! With perspective a = N / D is the quotient of two such planes, of a/w and 1/w, each with a division
//! or product more (2), and a quotient in the end (3 for a reciprocal and a product):
//! |error| <= (B(N) + |a| B(D)) / (D - B(D)) + 3 u |a|, nothing where D may vanish.
//!
//! The specification's own formula is a sum of three weighed values, without differences. Computed so,
//! |a1 - a0| and |a2 - a0| in Gx and Gy become |a1| + |a0| and |a2| + |a0|: the products are rounded
//! before they cancel.

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::SUBPIXELS;

use crate::cases::Triangle;

/// Half the distance between 1 and the next f32.
const U: f64 = (f32::EPSILON / 2.0) as f64;
/// Roundings on the way of a value, as counted above.
const ROUNDINGS: f64 = 16.0;
/// The same for a value over w.
const ROUNDINGS_OVER_W: f64 = ROUNDINGS + 2.0;

/// The corners of a triangle in px, and what its planes have in common.
struct Setup {
    px: [[f64; 2]; 3],
    area2: f64,
    reach: [f64; 2],
}

impl Setup {
    fn new(triangle: &Triangle, page_px: f64) -> Self {
        let subpixels = f64::from(SUBPIXELS);
        let px = triangle
            .corners()
            .map_array(|p| [f64::from(p.x) / subpixels, f64::from(p.y) / subpixels]);
        let [a, b, c] = px;
        let area2 = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        // Across a page, or from its far side to a corner.
        let mut reach = [page_px; 2];
        for [x, y] in px {
            reach[0] = reach[0].max(x.abs() + page_px);
            reach[1] = reach[1].max(y.abs() + page_px);
        }
        Self { px, area2, reach }
    }

    /// u (M + Gx X + Gy Y) times the roundings.
    fn bound(&self, values: [f64; 3], roundings: f64) -> f64 {
        let differences = [(values[1] - values[0]).abs(), (values[2] - values[0]).abs()];
        self.carried(values, differences, roundings)
    }

    /// The same where values are weighed without being subtracted from each other first: what is
    /// rounded are products of the values themselves.
    fn bound_of_weights(&self, values: [f64; 3], roundings: f64) -> f64 {
        let [a, b, c] = values.map_array(f64::abs);
        self.carried(values, [a + b, a + c], roundings)
    }

    fn carried(&self, values: [f64; 3], [d1, d2]: [f64; 2], roundings: f64) -> f64 {
        let [p, q, r] = self.px;
        // Gy and Gx: how steep the plane may be along y and along x.
        let [steep_y, steep_x] = [0, 1].map_array(|i: usize| {
            (d1 * (r[i] - p[i]).abs() + d2 * (q[i] - p[i]).abs()) / self.area2.abs()
        });
        let [a, b, c] = values.map_array(f64::abs);
        let largest = 0.0_f64.max(a).max(b).max(c);
        U * roundings * (largest + steep_x * self.reach[0] + steep_y * self.reach[1])
    }

    /// The value of a plane at a place in px; rounded, which a bound can bear.
    fn at(&self, values: [f64; 3], s: [f64; 2]) -> f64 {
        let mut value = 0.0;
        for (i, of_corner) in values.into_iter().enumerate() {
            let [b, c] = [self.px[(i + 1) % 3], self.px[(i + 2) % 3]];
            let cross = (c[0] - b[0]) * (s[1] - b[1]) - (c[1] - b[1]) * (s[0] - b[0]);
            value += cross / self.area2 * of_corner;
        }
        value
    }
}

/// Bounds of depth and of both attributes in perspective.
#[must_use]
pub fn perspective_bounds(triangle: &Triangle, (x_px, y_px): (i32, i32), page_px: f64) -> [f64; 3] {
    let setup = Setup::new(triangle, page_px);
    let pixel = [f64::from(x_px) + 0.5, f64::from(y_px) + 0.5];
    let v = &triangle.vertices;
    let inv_w = v.map_array(|v| v.inv_w);
    let d = setup.at(inv_w, pixel);
    let d_bound = setup.bound(inv_w, ROUNDINGS_OVER_W);
    let [first, second] = attributes(triangle).map_array(|values| {
        let over_w = [0, 1, 2].map_array(|i: usize| values[i] * inv_w[i]);
        let value = (setup.at(over_w, pixel) / d).abs();
        if d <= d_bound {
            return f64::INFINITY;
        }
        (setup.bound(over_w, ROUNDINGS_OVER_W) + value * d_bound) / (d - d_bound) + 3.0 * U * value
    });
    [setup.bound(v.map_array(|v| v.depth), ROUNDINGS), first, second]
}

/// Both attributes of the corners.
fn attributes(triangle: &Triangle) -> [[f64; 3]; 2] {
    let [a, b, c] = triangle.vertices.map_array(|v| v.varying);
    [[a.x, b.x, c.x], [a.y, b.y, c.y]]
}

/// Bounds of depth: of a plane set up from differences, and of the specification's own sum of weights.
#[must_use]
pub fn depth_bounds(triangle: &Triangle, page_px: f64) -> [f64; 2] {
    let (setup, depths) = (Setup::new(triangle, page_px), triangle.vertices.map_array(|v| v.depth));
    [setup.bound(depths, ROUNDINGS), setup.bound_of_weights(depths, ROUNDINGS)]
}

/// Bounds of 1/w and of both attributes linear in the window: of a plane set up from differences, and
/// of the specification's own sum of weights, whatever of the two a device computes.
#[must_use]
pub fn linear_bounds(triangle: &Triangle, page_px: f64) -> [[f64; 2]; 3] {
    let setup = Setup::new(triangle, page_px);
    let [first, second] = attributes(triangle);
    [triangle.vertices.map_array(|v| v.inv_w), first, second].map_array(|values| {
        let of_weights = setup.bound_of_weights(values, ROUNDINGS_OVER_W);
        [setup.bound(values, ROUNDINGS_OVER_W), of_weights]
    })
}
