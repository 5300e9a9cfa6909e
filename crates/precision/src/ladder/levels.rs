//! Choices of levels of detail: how many texels a pixel meets, as the logarithm to the base 2 of the longer of the derivatives
//! of the texture coordinates by columns and by rows of pixels.
//!
//! u/w, v/w and 1/w are linear in the window (`Planes`). A choice takes the quotient rule at the point itself, or the difference of
//! two neighbouring pixels, which usual hardware has for four pixels at once.

use std::marker::PhantomData;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_core::triangle::{Corners, Span};

use super::interpolation::{Slopes, Values, inv_area, position};
use super::{Real, centre};

pub const SIDE: f64 = 256.0;

#[derive(Clone, Copy, Debug)]
pub struct Textured {
    pub corners: Corners,
    /// 1/w of each corner, above 0 because the corners lie before the eye.
    pub inv_w: [f64; 3],
    pub uv: [[f64; 2]; 3],
}

/// u/w, v/w and 1/w over the window; u and v in texels.
#[derive(Clone, Copy, Debug)]
struct Planes<T> {
    at: [T; 2],
    of: [Slopes<T>; 3],
}

impl<T: Real> Planes<T> {
    #[inline]
    fn new(Textured { corners, inv_w, uv }: &Textured) -> Self {
        let px = corners.map_array(position);
        let inv_w = inv_w.map_array(T::of);
        let over_w = |k: usize| [0, 1, 2].map_array(|i| T::of(uv[i][k] * SIDE) * inv_w[i]);
        let inv_area = inv_area(&px);
        let of = [over_w(0), over_w(1), inv_w].map_array(|f| Slopes::new(&px, f, inv_area));
        Self { at: px[0], of }
    }

    #[inline]
    fn at(&self, x_px: i32, y_px: i32) -> [T; 3] {
        let (dx, dy) = (centre::<T>(x_px) - self.at[0], centre::<T>(y_px) - self.at[1]);
        self.of.map_array(|slopes| slopes.at(dx, dy))
    }

    #[inline]
    fn slopes(&self) -> [[T; 3]; 2] {
        [self.of.map_array(|f| f.per_x), self.of.map_array(|f| f.per_y)]
    }

    #[inline]
    fn uv(&self, x_px: i32, y_px: i32) -> [T; 2] {
        let [u, v, inv_w] = self.at(x_px, y_px);
        let w = T::of(1.0) / inv_w;
        [u * w, v * w]
    }
}

/// The level where the derivatives are these, in texels. The logarithm is that of a double for all choices.
#[inline]
fn level<T: Real>([x, y]: [[T; 2]; 2]) -> f64 {
    let square = |[u, v]: [T; 2]| u * u + v * v;
    let longest: f64 = square(x).max(square(y)).as_();
    0.5 * libm::log2(longest)
}

/// One level for a triangle: that of its area in texels over its area in pixels.
#[derive(Clone, Copy, Debug, Default)]
pub struct OfTriangle;

/// The difference of two pixels, the same for the four pixels of a square of 2 x 2.
#[derive(Clone, Copy, Debug, Default)]
pub struct Differences<T>(PhantomData<T>);

/// The quotient rule at the centre of each pixel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Derivatives<T>(PhantomData<T>);

impl Values<Textured> for OfTriangle {
    fn values(&self, triangle: &Textured, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let [a, b, c] = triangle.uv;
        let texels = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) * SIDE * SIDE;
        let pixels = twice_area(&triangle.corners) as f64 / f64::from(SUBPIXELS * SUBPIXELS);
        let level = 0.5 * libm::log2((texels / pixels).abs());
        for span in spans {
            (span.x0_px..span.x1_px).for_each(|x_px| emit(x_px, span.y_px, level));
        }
    }
}

impl<T: Real> Values<Textured> for Differences<T> {
    fn values(&self, triangle: &Textured, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let planes = Planes::<T>::new(triangle);
        for span in spans {
            let y0 = span.y_px & !1;
            let mut x_px = span.x0_px;
            while x_px < span.x1_px {
                let x0 = x_px & !1;
                let here = planes.uv(x0, y0);
                let to = |[u, v]: [T; 2]| [u - here[0], v - here[1]];
                let level = level([to(planes.uv(x0 + 1, y0)), to(planes.uv(x0, y0 + 1))]);
                while x_px < span.x1_px.min(x0 + 2) {
                    emit(x_px, span.y_px, level);
                    x_px += 1;
                }
            }
        }
    }
}

impl<T: Real> Values<Textured> for Derivatives<T> {
    fn values(&self, triangle: &Textured, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let planes = Planes::<T>::new(triangle);
        let slopes = planes.slopes();
        for span in spans {
            for x_px in span.x0_px..span.x1_px {
                let [u, v, inv_w] = planes.at(x_px, span.y_px);
                let w = T::of(1.0) / inv_w;
                let derivative = |[du, dv, d_inv_w]: [T; 3]| {
                    [(du - u * w * d_inv_w) * w, (dv - v * w * d_inv_w) * w]
                };
                emit(x_px, span.y_px, level(slopes.map_array(derivative)));
            }
        }
    }
}
