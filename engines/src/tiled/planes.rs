//! Depth, 1/w and attributes as planes over the screen, in f32: the rung 'plane' of the ladder, with
//! its bound.
//!
//! Each of depth, 1/w and v/w is f(x, y) = f0 + gx x + gy y, with (x, y) the whole pixels from the
//! first pixel of the triangle's box in the window, or sixteenths of them for samples. The three
//! numbers are computed in f64 from exact positions and rounded to f32; x and y are below 2^14, so
//! exact. An attribute is the quotient of its plane and that of 1/w.
//!
//! The bound, with u = 2^-24 and S = |f0| + |gx x| + |gy y|. In f32, f0 is rounded once and takes
//! part in two sums, gy y in a rounding, a product and two sums, gx x in a rounding, a product and a
//! sum: 4 u S to first order. Before, in f64 with u' = 2^-53: what comes in is rounded twice, v / w and
//! w over its largest; a difference of two, at most 2 M with M the largest |v|, is then off by 3 u' 2 M,
//! and a slope, after a product, a difference, a product and the quotient of 1 by an exact area, by
//! 7 u' G with
//! G = 2 M (|y1| + |y2|) / |2 A|. f0 is a sum of such slopes times distances from the first corner, three
//! roundings more. With X and Y the largest distances in the box and T = M + Gx X + Gy Y that is
//! 11 u' T, so |error| <= 4 u S + 11 u' T.
//! A quotient n / q of numbers off by en and eq is off by (en + |n / q| eq) / (q - eq), and by two
//! roundings of its own, 2 u |n / q|. `SECOND_ORDER` is for products of errors.

use crate::grid::{HALF_PIXEL, PixelRect, SUBPIXELS};
use crate::triangle::ScreenTriangle;

/// Unit roundoffs of f32 and f64.
const U32: f64 = f32::EPSILON as f64 / 2.0;
const U64: f64 = f64::EPSILON / 2.0;
/// For products of two and more rounding errors.
const SECOND_ORDER: f64 = 1.0 + 1.0 / (1u64 << 18) as f64;
/// What rounding adds where a number is below the normal ones of f32, a few operations.
const UNDERFLOW: f64 = f32::MIN_POSITIVE as f64;

/// f0, and the slopes to the right and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// At the first pixel.
    pub start: f32,
    /// From column to column.
    pub right: f32,
    /// From row to row.
    pub down: f32,
    /// T of the bound: the magnitude that f64 rounded relative to.
    rounded: f64,
}

impl Plane {
    /// At (x, y) pixels from the first one: one product, one sum, for the row, then for the column.
    #[must_use]
    #[inline]
    pub fn at(&self, x: f32, y: f32) -> f32 {
        (self.start + self.down * y) + self.right * x
    }

    /// The bound of the error there.
    #[must_use]
    pub fn error(&self, x: f32, y: f32) -> f64 {
        let sum = f64::from(self.start.abs())
            + f64::from((self.right * x).abs())
            + f64::from((self.down * y).abs());
        (4.0 * U32 * sum + 11.0 * U64 * self.rounded) * SECOND_ORDER + UNDERFLOW
    }
}

/// The planes of a triangle with `N` attributes.
#[derive(Clone, Copy, Debug)]
pub struct Planes<const N: usize> {
    /// The pixel that they begin at.
    pub first_px: [i32; 2],
    /// Depth, as it is.
    pub depth: Plane,
    /// 1/w over the largest of the three.
    pub inv_w: Plane,
    /// Attributes times that.
    pub over_w: [Plane; N],
}

/// Positions relative to the first corner, in pixels, and what planes have in common.
struct Frame {
    edges: [[f64; 2]; 2],
    /// 1 over twice the area.
    per_area: f64,
    /// From the first corner to the centre of the first pixel.
    to_first: [f64; 2],
    /// T of the bound over M.
    growth: f64,
}

impl Frame {
    /// As a sum of differences from the first corner.
    fn plane(&self, [v0, v1, v2]: [f64; 3]) -> Plane {
        let [[x1, y1], [x2, y2]] = self.edges;
        let (d1, d2) = (v1 - v0, v2 - v0);
        let right = (d1 * y2 - d2 * y1) * self.per_area;
        let down = (d2 * x1 - d1 * x2) * self.per_area;
        let rounded = v0.abs().max(v1.abs()).max(v2.abs()) * self.growth;
        let start = v0 + (right * self.to_first[0] + down * self.to_first[1]);
        Plane { start: start as f32, right: right as f32, down: down as f32, rounded }
    }
}

impl<const N: usize> Planes<N> {
    /// Of a triangle with area whose box reaches into the window; `box_px` is what it shows of it.
    /// `values` are the attributes of each corner.
    #[must_use]
    pub fn new<V>(
        triangle: &ScreenTriangle<V>,
        values: [&[f64; N]; 3],
        box_px: PixelRect,
        affine: bool,
    ) -> Self {
        Self::of(triangle, values, box_px, affine, u32::MAX, &mut |_| false)
            .unwrap_or_else(|| unreachable!("nothing is hidden"))
    }

    /// As [`Planes::new`], of the attributes whose bits are in `used` alone; the others are nothing.
    /// Nothing at all where `hidden` says so of the nearest depth there can be.
    #[inline(always)]
    pub(super) fn of<V>(
        triangle: &ScreenTriangle<V>,
        values: [&[f64; N]; 3],
        box_px: PixelRect,
        affine: bool,
        used: u32,
        hidden: &mut dyn FnMut(f64) -> bool,
    ) -> Option<Self> {
        let frame = frame(triangle, box_px);
        let [a, b, c] = &triangle.vertices;
        let depth = frame.plane([a.depth, b.depth, c.depth]);
        // The exact depth lies between those of the corners, the computed one within its bound.
        let error = depth.error(box_px.width() as f32, box_px.height() as f32);
        if hidden(a.depth.min(b.depth).min(c.depth) - error) {
            return None;
        }
        let most = a.inv_w.max(b.inv_w).max(c.inv_w);
        let part = |inv_w: f64| if affine { 1.0 } else { inv_w / most };
        let inv_w = [part(a.inv_w), part(b.inv_w), part(c.inv_w)];
        let mut over_w = [depth; N];
        for (i, plane) in over_w.iter_mut().enumerate() {
            if used >> i & 1 == 0 {
                continue;
            }
            let [a, b, c] = values;
            *plane = frame.plane([a[i] * inv_w[0], b[i] * inv_w[1], c[i] * inv_w[2]]);
        }
        let first_px = [box_px.x0, box_px.y0];
        Some(Self { first_px, depth, inv_w: frame.plane(inv_w), over_w })
    }

    /// Attribute `i` at the centre of a pixel, or sixteenths beside it, as a tile computes it, and the
    /// bound of its error.
    #[must_use]
    pub fn value(&self, i: usize, x_px: f64, y_px: f64) -> (f32, f64) {
        let (x, y) = self.beside_first(x_px, y_px);
        let (over, under) = (self.over_w[i], self.inv_w);
        let (n, q) = (over.at(x, y), under.at(x, y));
        let value = n * (1.0 / q);
        let (en, eq) = (over.error(x, y), under.error(x, y));
        let (n, q) = (f64::from(n), f64::from(q));
        let off = (en + (n / q).abs() * eq) / (q - eq);
        // 1/q is rounded, and the product.
        let bound = (off + 2.0 * U32 * (n / q).abs()) * SECOND_ORDER + UNDERFLOW;
        (value, if q > eq { bound } else { f64::INFINITY })
    }

    /// The depth there, and the bound of its error.
    #[must_use]
    pub fn depth_at(&self, x_px: f64, y_px: f64) -> (f32, f64) {
        let (x, y) = self.beside_first(x_px, y_px);
        (self.depth.at(x, y), self.depth.error(x, y))
    }

    fn beside_first(&self, x_px: f64, y_px: f64) -> (f32, f32) {
        let [x0, y0] = [f64::from(self.first_px[0]), f64::from(self.first_px[1])];
        ((x_px - x0) as f32, (y_px - y0) as f32)
    }
}

fn frame<V>(triangle: &ScreenTriangle<V>, box_px: PixelRect) -> Frame {
    let [a, b, c] = &triangle.vertices;
    let (a, b, c) = (a.position, b.position, c.position);
    let px = |sub: i64| sub as f64 / f64::from(SUBPIXELS);
    let edge = |to: i32, from: i32| px(i64::from(to) - i64::from(from));
    let edges = [[edge(b.x, a.x), edge(b.y, a.y)], [edge(c.x, a.x), edge(c.y, a.y)]];
    let [[x1, y1], [x2, y2]] = edges;
    let from = |first_px: i32, a: i32| {
        px(i64::from(first_px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL) - i64::from(a))
    };
    let to_first = [from(box_px.x0, a.x), from(box_px.y0, a.y)];
    // Largest distances from the first corner within the box, with half a pixel for samples.
    let reach = [
        to_first[0].abs() + f64::from(box_px.width()),
        to_first[1].abs() + f64::from(box_px.height()),
    ];
    // Exact for extents below 2^18 px: products of 26 bits each.
    let per_area = 1.0 / (x1 * y2 - x2 * y1);
    let reach = (y1.abs() + y2.abs()) * reach[0] + (x1.abs() + x2.abs()) * reach[1];
    Frame { edges, per_area, to_first, growth: 1.0 + 2.0 * reach * per_area.abs() }
}
