//! Depth, 1/w and attributes as planes over the screen, in f32: the choice 'plane' of the group, with
//! its bound.
//!
//! Each of depth, 1/w and v/w is f(x, y) = f0 + gx x + gy y, with (x, y) the whole pixels from the
//! first pixel of the triangle's box in the window, or sixteenths of them for samples. The three
//! numbers are computed in f64 from exact positions and rounded to f32; x and y are below 2^14, so
//! exact. An attribute is the quotient of its plane and that of 1/w.
//!
//! A depth is never nearer than the nearest corner's, rounded down: there it is taken instead. The exact
//! one lies behind it too, so that makes no error larger, and what tiles know of depths is plain.
//!
//! All attributes are set up at once, one a lane.
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
//! Both hold for edges below `MOST_EDGE_PX`, which the edges of pieces of a scene are, since they lie in
//! the window; `proof/TilePlanes.v` proves them. For longer ones the bound is infinite. It is infinite, too, where
//! a sum of f32 may leave its range, which is where S, or a quotient, is not below `MOST_SUM`.
//! A quotient n / q of numbers off by en and eq is off by (en + |n / q| eq) / (q - eq), and by two
//! roundings of its own, 2 u |n / q|. `SECOND_ORDER` is for products of errors.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, f64x8};

use crate::coverage::Tiles;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{self, ScreenVertex, Span};
use rasterproof_render::effects::geometry::below;

pub use rasterproof_render::pipeline::shade::ALL as ATTRIBUTES;

/// Unit roundoffs of f32 and f64.
const U32: f64 = f32::EPSILON as f64 / 2.0;
const U64: f64 = f64::EPSILON / 2.0;
/// For products of two and more rounding errors.
const SECOND_ORDER: f64 = 1.0 + 1.0 / (1u64 << 18) as f64;
/// What rounding adds where a number is below the normal ones of f32, a few operations.
const UNDERFLOW: f64 = f32::MIN_POSITIVE as f64;
/// Edges below this have a bound: their products are whole numbers of 52 bits in subpixels, so the area is exact.
const MOST_EDGE_PX: f64 = (1u32 << 18) as f64;
/// Where S is below this, the largest f32 is not reached by any sum: `tile_sums_fit` in `proof/TilePlanes.v`.
const MOST_SUM: f64 = f64::from_bits((1023 + 127) << 52);
/// Attributes up to this have planes whose S is below `MOST_SUM`: `small_attributes_fit` in `proof/TilePlanes.v`.
pub const MOST_ATTRIBUTE: f64 = f64::from_bits((1023 + 62) << 52);

/// Depths and w of the corners of a triangle, and where they are.
pub type Corners = [ScreenVertex<()>; 3];

/// f0, and the slopes to the right and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValuePlane {
    /// At the first pixel.
    pub start: f32,
    /// From column to column.
    pub right: f32,
    /// From row to row.
    pub down: f32,
}

impl ValuePlane {
    /// At (x, y) pixels from the first one: one product, one sum, for the row, then for the column.
    #[must_use]
    #[inline]
    pub fn at(&self, x: f32, y: f32) -> f32 {
        (self.start + self.down * y) + self.right * x
    }

    /// The bound of the error there; `rounded` is T of the bound.
    fn error(&self, x: f32, y: f32, rounded: f64) -> f64 {
        let sum = f64::from(self.start.abs())
            + f64::from((self.right * x).abs())
            + f64::from((self.down * y).abs());
        // Where the area is unknown, T is infinite or, for values of 0, no number. A sum of numbers that left f32 is
        // infinite or no number, which is not below anything.
        let is_bounded = rounded.is_finite() && sum < MOST_SUM;
        if !is_bounded {
            return f64::INFINITY;
        }
        (4.0 * U32 * sum + 11.0 * U64 * rounded) * SECOND_ORDER + UNDERFLOW
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// The pixel that the plane begins at.
    pub first_px: [i32; 2],
    plane: ValuePlane,
    /// No depth is nearer.
    nearest: f32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planes {
    /// The pixel that they begin at.
    pub first_px: [i32; 2],
    /// 1/w over the largest of the three.
    pub inv_w: ValuePlane,
    /// Attributes times that: starts, slopes to the right and slopes down.
    over_w: [[f32; ATTRIBUTES]; 3],
}

/// Positions relative to the first corner, in pixels, and what planes have in common.
struct Frame {
    edges: [[f64; 2]; 2],
    /// 1 over twice the area.
    per_area: f64,
    /// From the first corner to the centre of the first pixel.
    to_first: [f64; 2],
}

impl Frame {
    #[inline(always)]
    fn new(&[a, b, c]: &triangle::Corners, box_px: PixelRect) -> Self {
        let px = |sub: i64| sub as f64 / f64::from(SUBPIXELS);
        let edge = |to: i32, from: i32| px(i64::from(to) - i64::from(from));
        let edges = [[edge(b.x, a.x), edge(b.y, a.y)], [edge(c.x, a.x), edge(c.y, a.y)]];
        let [[x1, y1], [x2, y2]] = edges;
        let from = |first_px: i32, a: i32| {
            px(i64::from(first_px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL) - i64::from(a))
        };
        let to_first = [from(box_px.x0, a.x), from(box_px.y0, a.y)];
        // The area is exact for edges below `MOST_EDGE_PX`.
        Self { edges, per_area: 1.0 / (x1 * y2 - x2 * y1), to_first }
    }

    /// As a sum of differences from the first corner.
    #[inline(always)]
    fn plane(&self, [v0, v1, v2]: [f64; 3]) -> ValuePlane {
        let [[x1, y1], [x2, y2]] = self.edges;
        let (d1, d2) = (v1 - v0, v2 - v0);
        let right = (d1 * y2 - d2 * y1) * self.per_area;
        let down = (d2 * x1 - d1 * x2) * self.per_area;
        let start = v0 + (right * self.to_first[0] + down * self.to_first[1]);
        ValuePlane { start: start as f32, right: right as f32, down: down as f32 }
    }

    #[inline(always)]
    fn planes<S: Simd>(&self, [v0, v1, v2]: [f64x8<S>; 3]) -> [[f32; ATTRIBUTES]; 3] {
        let [[x1, y1], [x2, y2]] = self.edges;
        let (d1, d2) = (v1 - v0, v2 - v0);
        let right = (d1 * y2 - d2 * y1) * self.per_area;
        let down = (d2 * x1 - d1 * x2) * self.per_area;
        let start = v0 + (right * self.to_first[0] + down * self.to_first[1]);
        [rounded(start), rounded(right), rounded(down)]
    }

    /// T of the bound over M. Infinite for longer edges: there the area may be off by any factor.
    fn growth(&self, box_px: PixelRect) -> f64 {
        let [[x1, y1], [x2, y2]] = self.edges;
        if [x1, y1, x2, y2].into_iter().any(|edge| edge.abs() >= MOST_EDGE_PX) {
            return f64::INFINITY;
        }
        // Largest distances from the first corner within the box, with half a pixel for samples.
        let reach = [
            self.to_first[0].abs() + f64::from(box_px.width()),
            self.to_first[1].abs() + f64::from(box_px.height()),
        ];
        let reach = (y1.abs() + y2.abs()) * reach[0] + (x1.abs() + x2.abs()) * reach[1];
        1.0 + 2.0 * reach * self.per_area.abs()
    }
}

#[inline(always)]
fn rounded<S: Simd>(values: f64x8<S>) -> [f32; ATTRIBUTES] {
    let (low, high) = values.split();
    low.narrow(high).to_array()
}

/// 1/w of the corners over the largest; 1 where attributes are affine.
#[inline(always)]
pub(super) fn shares([a, b, c]: &Corners, affine: bool) -> [f64; 3] {
    let most = a.inv_w.max(b.inv_w).max(c.inv_w);
    let share = |inv_w: f64| if affine { 1.0 } else { inv_w / most };
    [share(a.inv_w), share(b.inv_w), share(c.inv_w)]
}

fn positions([a, b, c]: &Corners) -> triangle::Corners {
    [a.position, b.position, c.position]
}

impl Depth {
    /// As [`Planes::of`].
    #[inline(always)]
    pub(super) fn of(corners: &triangle::Corners, depths: [f64; 3], box_px: PixelRect) -> Self {
        let [a, b, c] = depths;
        Self {
            first_px: [box_px.x0, box_px.y0],
            plane: Frame::new(corners, box_px).plane(depths),
            nearest: below(a.min(b).min(c)),
        }
    }

    /// At (x, y) pixels from the first one.
    #[inline(always)]
    pub(super) fn at<S: Simd>(&self, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
        along(&self.plane, x, y).max(self.nearest)
    }
}

impl Planes {
    /// Of a triangle with area whose box reaches into the window; `box_px` is what it shows of it.
    /// `values` are the attributes of each corner.
    #[must_use]
    #[inline(always)]
    pub(super) fn of<S: Simd>(
        simd: S,
        corners: &Corners,
        values: &[[f64; ATTRIBUTES]; 3],
        box_px: PixelRect,
        affine: bool,
    ) -> Self {
        let frame = Frame::new(&positions(corners), box_px);
        let inv_w = shares(corners, affine);
        let over_w = frame.planes([
            f64x8::load_array_ref(simd, &values[0]) * inv_w[0],
            f64x8::load_array_ref(simd, &values[1]) * inv_w[1],
            f64x8::load_array_ref(simd, &values[2]) * inv_w[2],
        ]);
        Self { first_px: [box_px.x0, box_px.y0], inv_w: frame.plane(inv_w), over_w }
    }

    /// The plane of attribute `i` times 1/w.
    #[must_use]
    #[inline(always)]
    pub fn over_w(&self, i: usize) -> ValuePlane {
        let [start, right, down] = &self.over_w;
        ValuePlane { start: start[i], right: right[i], down: down[i] }
    }
}

/// Attribute `i` at the pixels of spans that lie in `box_px`, up to sixteen adjacent ones at a time, as a
/// tile computes it: `take` gets the first pixel's column, its row, and the values.
pub fn along_spans(
    engine: Tiles,
    corners: &Corners,
    values: &[[f64; ATTRIBUTES]; 3],
    (box_px, i): (PixelRect, usize),
    spans: &[Span],
    take: &mut dyn FnMut(i32, i32, &[f32]),
) {
    dispatch!(engine.level(), simd => {
        let planes = Planes::of(simd, corners, values, box_px, false);
        planes.along_spans(simd, i, spans, take);
    });
}

impl Planes {
    #[inline(always)]
    fn along_spans<S: Simd>(
        &self,
        simd: S,
        i: usize,
        spans: &[Span],
        take: &mut dyn FnMut(i32, i32, &[f32]),
    ) {
        const COLUMNS: [f32; 16] =
            [0., 1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11., 12., 13., 14., 15.];
        let [x0, y0] = self.first_px;
        let (over, under) = (self.over_w(i), self.inv_w);
        for span in spans {
            let y = f32x16::splat(simd, (span.y_px - y0) as f32);
            for x_px in (span.x0_px..span.x1_px).step_by(16) {
                let x = f32x16::load_array_ref(simd, &COLUMNS) + (x_px - x0) as f32;
                let w = f32x16::splat(simd, 1.0) / along(&under, x, y);
                let values = (along(&over, x, y) * w).to_array();
                let count = (span.x1_px - x_px).min(16) as usize;
                take(x_px, span.y_px, &values[..count]);
            }
        }
    }
}

/// A plane at (x, y), as [`ValuePlane::at`] has it.
#[inline(always)]
pub(super) fn along<S: Simd>(plane: &ValuePlane, x: f32x16<S>, y: f32x16<S>) -> f32x16<S> {
    x * plane.right + (y * plane.down + plane.start)
}

/// Planes with the bounds of their errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    depth: Depth,
    planes: Planes,
    /// T of the bound, of the depth, 1/w and each attribute times that.
    of_depth: f64,
    inv_w: f64,
    over_w: [f64; ATTRIBUTES],
}

impl Bounded {
    /// Of a triangle with area whose box reaches into the window; `box_px` is what it shows of it.
    /// As a tile has them in an instruction set.
    #[must_use]
    pub fn new(
        engine: Tiles,
        corners: &Corners,
        values: &[[f64; ATTRIBUTES]; 3],
        box_px: PixelRect,
        affine: bool,
    ) -> Self {
        let planes =
            dispatch!(engine.level(), simd => Planes::of(simd, corners, values, box_px, affine));
        let (positions, depths) = (positions(corners), corners.each_ref().map(|c| c.depth));
        let growth = Frame::new(&positions, box_px).growth(box_px);
        let most = |[a, b, c]: [f64; 3]| a.abs().max(b.abs()).max(c.abs()) * growth;
        let inv_w = shares(corners, affine);
        let over_w = std::array::from_fn(|i| {
            most([values[0][i] * inv_w[0], values[1][i] * inv_w[1], values[2][i] * inv_w[2]])
        });
        let depth = Depth::of(&positions, depths, box_px);
        Self { depth, planes, of_depth: most(depths), inv_w: most(inv_w), over_w }
    }

    /// Attribute `i` at the centre of a pixel, or sixteenths beside it, as a tile computes it, and the
    /// bound of its error.
    #[must_use]
    pub fn value(&self, i: usize, x_px: f64, y_px: f64) -> (f32, f64) {
        let (x, y) = self.beside_first(x_px, y_px);
        let (over, under) = (self.planes.over_w(i), self.planes.inv_w);
        let (n, q) = (over.at(x, y), under.at(x, y));
        let value = n * (1.0 / q);
        let (en, eq) = (over.error(x, y, self.over_w[i]), under.error(x, y, self.inv_w));
        let (n, q) = (f64::from(n), f64::from(q));
        let quotient = (n / q).abs();
        let off = (en + quotient * eq) / (q - eq);
        // 1/q is rounded, and the product.
        let bound = (off + 2.0 * U32 * quotient) * SECOND_ORDER + UNDERFLOW;
        let fits = en.is_finite() && quotient < MOST_SUM;
        (value, if q > eq && fits { bound } else { f64::INFINITY })
    }

    #[must_use]
    pub fn depth_at(&self, x_px: f64, y_px: f64) -> (f32, f64) {
        let (x, y) = self.beside_first(x_px, y_px);
        let Depth { plane, nearest, .. } = self.depth;
        (plane.at(x, y).max(nearest), plane.error(x, y, self.of_depth))
    }

    fn beside_first(&self, x_px: f64, y_px: f64) -> (f32, f32) {
        let [x0, y0] = self.planes.first_px;
        ((x_px - f64::from(x0)) as f32, (y_px - f64::from(y0)) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;

    /// The area is -1, and both of its products are above 2^53: in f64 it is 0.
    #[test]
    fn long_edges_have_no_bound() {
        let bounds = |n: i32| {
            let corner = |x: i32, y: i32| {
                let position = SubpixelPoint::new(x, y);
                ScreenVertex { position, depth: 0.5, inv_w: 1.0, varying: () }
            };
            let corners = [corner(0, 0), corner(n + 1, n), corner(n, n - 1)];
            let first = PixelRect::window(1, 1);
            let values = [[1.0; ATTRIBUTES]; 3];
            let planes = Bounded::new(Tiles::default(), &corners, &values, first, false);
            (planes.depth_at(0.0, 0.0).1, planes.value(0, 0.0, 0.0).1)
        };
        assert_eq!(bounds(1 << 29), (f64::INFINITY, f64::INFINITY));
        assert!(bounds((1 << 26) - 2).0.is_finite(), "edges just below 2^18 px");
        assert_eq!(bounds(1 << 26).0, f64::INFINITY);
    }

    /// Depth and attribute with their bounds at a pixel of a triangle of 16 px, whose corners have these depths and attributes.
    fn at_pixel(depths: [f64; 3], attributes: [f64; 3], inv_w: [f64; 3]) -> [(f32, f64); 2] {
        let corner = |i: usize, x: i32, y: i32| {
            let position = SubpixelPoint::new(x << 8, y << 8);
            ScreenVertex { position, depth: depths[i], inv_w: inv_w[i], varying: () }
        };
        let corners = [corner(0, 0, 0), corner(1, 16, 0), corner(2, 0, 16)];
        let values = attributes.map(|value| [value; ATTRIBUTES]);
        let window = PixelRect::window(16, 16);
        let planes = Bounded::new(Tiles::default(), &corners, &values, window, false);
        [planes.depth_at(6.0, 6.0), planes.value(0, 6.0, 6.0)]
    }

    /// In each case a number leaves f32 that the value is computed from, or the value itself.
    #[test]
    fn what_overflows_has_no_bound() {
        let large = f64::from(f32::MAX);
        let ones = [1.0; 3];
        let overflowing = [
            ("a start", [2.0 * large; 3], ones),
            ("a start and a slope of other signs", [2.0 * large, -2.0 * large, 2.0 * large], ones),
            // Every corner fits, and the difference of two does not.
            ("a slope times a distance", [-large, large, large], ones),
            ("the sum", [0.75 * large, 0.75 * large, -0.75 * large], ones),
            ("a quotient", [0.0, 16.0 * large, 16.0 * large], [1.0, 1.0 / 64.0, 1.0 / 64.0]),
        ];
        for (what, values, inv_w) in overflowing {
            let [(_, depth), (attribute, bound)] = at_pixel(values, values, inv_w);
            let is_bounded = bound != f64::INFINITY;
            assert!(!is_bounded, "{what}: the attribute {attribute} has the bound {bound:e}");
            if what != "a quotient" {
                assert_eq!(depth, f64::INFINITY, "{what}: depth");
            }
        }
        let most = [MOST_ATTRIBUTE, -MOST_ATTRIBUTE, MOST_ATTRIBUTE];
        let [(_, depth), (value, bound)] = at_pixel(most, most, ones);
        assert!(depth.is_finite() && bound.is_finite() && value.is_finite());
    }
}
