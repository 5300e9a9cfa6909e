//! Derived bounds of the choices of interpolation: how far a value may be off at a pixel.

use super::tiles::{box_of, packed};
use crate::ladder::interpolation::Valued;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::triangle::Span;
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::frames::planes::Bounded;

/// Which derived bound a choice keeps; see [`crate::ladder::interpolation`] and [`Bound::at`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The model's error, and rounding.
    Affine,
    /// The same for pieces of 16 pixels.
    EverySixteen,
    BookFormula,
    /// 1/w and v/w accumulated along the row.
    Accumulated,
    Direct,
    Plane,
    /// Planes that are set up in f64 and rounded, as frames in tiles have them.
    Tile,
    Offset,
    /// One rounding of the exact value.
    Rounded,
}

/// What is known of a triangle and one of its pixels when a bound is computed, in f64.
pub struct Place<'a> {
    pub triangle: &'a Valued,
    /// The rows of the triangle, and the pixel's.
    pub spans: &'a [Span],
    pub span: Span,
    pub x_px: i32,
}

/// A linear function over the screen in f64, and how much its slopes cancel.
struct Linear {
    f0: f64,
    /// Slopes, and the same with every term positive.
    slope: [f64; 2],
    terms: [f64; 2],
}

impl Place<'_> {
    fn at(&self, i: usize) -> [f64; 2] {
        let (x, y) = self.triangle.corners[i].to_px();
        [x, y]
    }

    /// Twice the area, and how much it cancels: the sum of its terms' magnitudes over it.
    fn area(&self) -> (f64, f64) {
        let [a, b, c] = [0, 1, 2].map_array(|i| self.at(i));
        let (p, q) = ((b[0] - a[0]) * (c[1] - a[1]), (c[0] - a[0]) * (b[1] - a[1]));
        (p - q, (p.abs() + q.abs()) / (p - q).abs())
    }

    fn linear(&self, f: [f64; 3]) -> Linear {
        let [a, b, c] = [0, 1, 2].map_array(|i| self.at(i));
        let area = self.area().0;
        let (d1, d2) = (f[1] - f[0], f[2] - f[0]);
        let [bx, by, cx, cy] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
        let pairs = [[d1 * cy, d2 * by], [d2 * bx, d1 * cx]];
        Linear {
            f0: f[0],
            slope: pairs.map_array(|[p, q]| (p - q) / area),
            terms: pairs.map_array(|[p, q]| (p.abs() + q.abs()) / area.abs()),
        }
    }

    /// Distance of the centre of column `x_px` from the first vertex.
    fn offset(&self, x_px: i32) -> [f64; 2] {
        let [x, y] = self.at(0);
        [f64::from(x_px) + 0.5 - x, f64::from(self.span.y_px) + 0.5 - y]
    }

    fn value(&self, f: &Linear, x_px: i32) -> f64 {
        let [dx, dy] = self.offset(x_px);
        f.f0 + f.slope[0] * dx + f.slope[1] * dy
    }

    fn perspective(&self, x_px: i32) -> [f64; 3] {
        let inv_w = self.value(&self.linear(self.triangle.inv_w), x_px);
        let over_w = self.value(&self.linear(self.over_w()), x_px);
        [inv_w, over_w, over_w / inv_w]
    }

    fn over_w(&self) -> [f64; 3] {
        [0, 1, 2].map_array(|i| self.triangle.inv_w[i] * self.triangle.value[i])
    }

    fn slope_x(&self) -> f64 {
        let [inv_w, _, v] = self.perspective(self.x_px);
        let (n, d) = (self.linear(self.over_w()), self.linear(self.triangle.inv_w));
        ((n.slope[0] - v * d.slope[0]) / inv_w).abs()
    }

    /// Rounding of a linear function evaluated as f0 + per_x dx + per_y dy, in units of u.
    ///
    /// With k >= 1 the cancellation of the area, G = the terms of a slope: the area is off by 2k
    /// (two products, one difference), 1/2A by 3k. A slope has 1 for the difference of values, 1 for
    /// the product, 1 for their difference: 3 G; times 1/2A: (3k + 1) more. The product with a
    /// distance, which is exact, 1; the two sums at most 2 |f0| + 2 of the parts. Together
    /// 2 |f0| + (7 + 3k) (Gx |dx| + Gy |dy|).
    fn rounding(&self, f: &Linear, x_px: i32) -> f64 {
        let [dx, dy] = self.offset(x_px);
        let k = self.area().1;
        2.0 * f.f0.abs() + (7.0 + 3.0 * k) * (f.terms[0] * dx.abs() + f.terms[1] * dy.abs())
    }

    /// The bound of [`Plane`] in units of u at a column: the quotient of two such functions. v/w has
    /// one rounding at each vertex besides. `None` where 1/w has hardly a digit left.
    fn planes(&self, x_px: i32, u: f64) -> Option<f64> {
        let [inv_w, _, v] = self.perspective(x_px);
        let of_inv_w = self.rounding(&self.linear(self.triangle.inv_w), x_px);
        let of_over_w = self.rounding(&self.linear(self.over_w()), x_px) + largest(self.over_w());
        if u * of_inv_w > inv_w / 16.0 {
            return None;
        }
        // 1 / (1 - 1/16) for the second order.
        Some(((of_over_w + v.abs() * of_inv_w) / inv_w + v.abs()) * 16.0 / 15.0)
    }
}

pub(super) fn largest(values: [f64; 3]) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}

fn spread(values: [f64; 3]) -> f64 {
    let [a, b, c] = values;
    a.max(b).max(c) - a.min(b).min(c)
}

/// The largest error of the straight line instead of the hyperbola: dv (sqrt R - 1) / (sqrt R + 1).
fn model(dv: f64, ratio: f64) -> f64 {
    let root = ratio.sqrt();
    dv * (root - 1.0) / (root + 1.0)
}

impl Bound {
    /// The bound in absolute terms for unit roundoff `u`; `None` where it says nothing: where it
    /// exceeds a tenth of M, or the accumulated book form has lost the ends of the row.
    pub fn at(self, place: &Place<'_>, u: f64) -> Option<f64> {
        let Valued { corners, inv_w, value } = place.triangle;
        let m = largest(*value);
        let (wide, narrow) = (largest(*inv_w), inv_w.iter().copied().fold(f64::MAX, f64::min));
        let a = wide / place.perspective(place.x_px)[0];
        let x = corners.iter().map(|p| p.to_px().0.abs()).fold(0.0, f64::max);
        let n_x = f64::from(place.x_px - place.span.x0_px);
        let n_y = f64::from(place.span.y_px - place.spans[0].y_px);
        let along = || x * place.slope_x();
        let limit = match self {
            // The model's error is no rounding, and may be large.
            Self::Affine => {
                let linear = place.linear(*value);
                let rounding = place.rounding(&linear, place.x_px) + n_x * 2.0 * m;
                return Some(model(spread(*value), wide / narrow) + u * rounding);
            }
            Self::EverySixteen => return sixteen(place, u, m),
            Self::Tile => {
                let (corners, values) = packed(place.triangle);
                let box_px = box_of(place.spans)?;
                let planes = Bounded::new(Tiles::default(), &corners, &values, box_px, false);
                let bound = planes.value(0, place.x_px.into(), place.span.y_px.into()).1;
                return (bound <= 0.1 * m).then_some(bound);
            }
            Self::BookFormula => {
                let [left, right] = row(place);
                if u * x * (4.0 + 2.0 * n_y) > (right - left) / 8.0 {
                    return None;
                }
                (8.0 + 3.0 * (n_x + n_y)) * m * a + (4.0 + 2.0 * n_y) * along()
            }
            Self::Accumulated => (8.0 + 2.0 * n_x) * m * a + 4.0 * along(),
            Self::Direct => 8.0 * m * a + 4.0 * along(),
            Self::Plane => place.planes(place.x_px, u)?,
            Self::Offset => 13.0 * spread(*value) + m,
            Self::Rounded => m,
        };
        (u * limit <= 0.1 * m).then_some(u * limit)
    }
}

/// The bound of a piece of [`EverySixteen`]: the model between its ends, the rounding of the ends and
/// of 16 steps.
fn sixteen(place: &Place<'_>, u: f64, m: f64) -> Option<f64> {
    let start = place.span.x0_px + (place.x_px - place.span.x0_px) / 16 * 16;
    let end = (start + 16).min(place.span.x1_px - 1);
    let ([inv_a, _, va], [inv_b, _, vb]) = (place.perspective(start), place.perspective(end));
    let rounding = place.planes(start, u)?.max(place.planes(end, u)?) + 20.0 * m;
    Some(model((va - vb).abs(), inv_a.max(inv_b) / inv_a.min(inv_b)) + u * rounding)
}

/// Where the row's height crosses the triangle, in f64.
fn row(place: &Place<'_>) -> [f64; 2] {
    let yc = f64::from(place.span.y_px) + 0.5;
    let crossings = [(0, 1), (1, 2), (2, 0)].into_iter().filter_map(|(i, j)| {
        let (a, b) = (place.at(i), place.at(j));
        let crosses = (a[1] <= yc) != (b[1] <= yc);
        crosses.then(|| a[0] + (b[0] - a[0]) * (yc - a[1]) / (b[1] - a[1]))
    });
    crossings.fold([f64::MAX, f64::MIN], |[low, high], x| [low.min(x), high.max(x)])
}
