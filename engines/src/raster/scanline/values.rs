//! Values of the scanline engine: between the two edges of a row, from the exact distances of each
//! centre to both (the book's chapters 3 and 5, pre-stepped).

use super::{EDGES, Scanline, Sides, centre, sort_by_height, walk_in_batches};
use crate::contract::Interpolate;
use crate::grid::{PixelRect, SUBPIXEL_BITS, SUBPIXELS, SubpixelPoint};
use crate::triangle::{Corners, Fragment, ScreenTriangle, ScreenVertex, Span, Varying};

impl Interpolate for Scanline {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        fragments_in::<V, false>(triangle, bounds, emit);
    }

    fn affine_fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        let triangle = triangle.with_equal_w();
        if widths_are_exact(&triangle.corners()) {
            fragments_in::<V, true>(&triangle, bounds, emit);
        } else {
            fragments_in::<V, false>(&triangle, bounds, emit);
        }
    }
}

/// `AFFINE` takes every row's width for a whole number, which it is where the three w are equal and
/// [`widths_are_exact`]: then its reciprocal is the same at every pixel.
fn fragments_in<V: Varying, const AFFINE: bool>(
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    mut emit: impl FnMut(Fragment<V>),
) {
    let order = by_height(&triangle.corners());
    let [v0, v1, v2] =
        [triangle.vertices[order[0]], triangle.vertices[order[1]], triangle.vertices[order[2]]];
    let [q0, q1, q2] = relative_inv_w([v0.inv_w, v1.inv_w, v2.inv_w]);
    let ends = [(v0, q0), (v1, q1), (v2, q2)];
    let edge = |[from, to]: [usize; 2]| Edge::new(&ends[from], &ends[to]);
    let edges = [edge(EDGES[0]), edge(EDGES[1]), edge(EDGES[2])];
    let corners = [v0.position, v1.position, v2.position];
    let chunk = if distances_are_exact(&corners) { i32::MAX } else { 1 };
    let mut row = |span: &Span, sides: &Sides| {
        let side = |number: u8| edges[usize::from(number)].at(span.y_px);
        let (left, right) = (side(sides.left), side(sides.right));
        let mut x0_px = span.x0_px;
        while x0_px < span.x1_px {
            let x1_px = span.x1_px.min(x0_px.saturating_add(chunk));
            let origin_px = if chunk == 1 { x0_px } else { sides.first_px };
            let part = Span { x0_px, x1_px, ..*span };
            fill_span::<V, AFFINE>(&left, &right, part, origin_px, &mut emit);
            x0_px = x1_px;
        }
    };
    walk_in_batches(&corners, bounds, &mut |rows| {
        for (span, sides) in rows {
            row(span, sides);
        }
    });
}

/// The numbers of the vertices from the top down; see [`sort_by_height`].
fn by_height(corners: &Corners) -> [usize; 3] {
    let mut items = [(corners[0], 0), (corners[1], 1), (corners[2], 2)];
    sort_by_height(&mut items, |(corner, _)| *corner);
    [items[0].1, items[1].1, items[2].1]
}

/// 1/w of each vertex over the largest: in (0, 1], and exactly 1 for all where they are equal.
fn relative_inv_w([a, b, c]: [f64; 3]) -> [f64; 3] {
    let largest = a.max(b).max(c);
    [a / largest, b / largest, c / largest]
}

/// Whether every distance of [`RowEnd::distance`] inside the triangle is a whole number that f64
/// holds exactly: it is at most extent times extent, and one step more.
fn distances_are_exact(corners: &Corners) -> bool {
    let [extent_x, extent_y] = extents(corners);
    extent_x * extent_y <= 1 << f64::MANTISSA_DIGITS
}

/// The same of a distance times the height of an edge, and of the width of a row, which is the sum
/// of two such products and at most extent times extent times height.
fn widths_are_exact(corners: &Corners) -> bool {
    let [extent_x, extent_y] = extents(corners);
    // 2^33 to the third power fits i128.
    extent_x * extent_y * extent_y <= 1 << f64::MANTISSA_DIGITS
}

/// Width and height of the bounding box in subpixels, and one pixel more.
fn extents([a, b, c]: &Corners) -> [i128; 2] {
    let extent = |a: i32, b: i32, c: i32| {
        i128::from(a.max(b).max(c)) - i128::from(a.min(b).min(c)) + i128::from(SUBPIXELS)
    };
    [extent(a.x, b.x, c.x), extent(a.y, b.y, c.y)]
}

/// An edge on its way down, with the values at its upper end and what they differ by at its lower.
#[derive(Clone, Copy)]
struct Edge<V> {
    a: SubpixelPoint,
    dx: i64,
    dy: i64,
    depth: [f64; 2],
    /// 1/w at both ends over the largest 1/w of the triangle.
    q: [f64; 2],
    varying: [V; 2],
}

impl<V: Varying> Edge<V> {
    /// From a vertex with its relative 1/w down to another.
    #[inline]
    fn new((from, from_q): &(ScreenVertex<V>, f64), (to, to_q): &(ScreenVertex<V>, f64)) -> Self {
        let (a, b) = (from.position, to.position);
        Self {
            a,
            dx: i64::from(b.x) - i64::from(a.x),
            dy: i64::from(b.y) - i64::from(a.y),
            depth: [from.depth, to.depth - from.depth],
            q: [*from_q, *to_q],
            varying: [from.varying, to.varying - from.varying],
        }
    }

    /// The book's formula (8) of section 5.4 at the height of the row's centres: v/w and 1/w are
    /// linear down the edge, their quotient is the value. Written with the difference of the ends,
    /// so that equal ends give their value exactly.
    #[inline]
    fn at(&self, y_px: i32) -> RowEnd<V> {
        let Self { a, dx, dy, .. } = *self;
        let down = centre(y_px) - i64::from(a.y);
        debug_assert!((0..dy).contains(&down), "t = {down}/{dy} leaves [0, 1): a clamp would act");
        // Whole numbers below 2^33: exact in f64.
        let (below, above, height) = (down as f64, (dy - down) as f64, dy as f64);
        let q_sum = above * self.q[0] + below * self.q[1];
        let t_depth = below / height;
        let t = below * self.q[1] / q_sum;
        RowEnd {
            a,
            dx,
            dy,
            down,
            depth: self.depth[0] + self.depth[1] * t_depth,
            q: q_sum / height,
            varying: self.varying[0] + self.varying[1] * t,
        }
    }
}

/// Where an edge crosses a row of centres, with the values there.
#[derive(Clone, Copy)]
struct RowEnd<V> {
    a: SubpixelPoint,
    dx: i64,
    dy: i64,
    down: i64,
    depth: f64,
    q: f64,
    varying: V,
}

impl<V: Varying> RowEnd<V> {
    /// How far the centre of column `x_px` lies right of the edge, in subpixels, times dy; exact
    /// but for the rounding to f64.
    #[inline]
    fn distance(&self, x_px: i32) -> f64 {
        let right = centre(x_px) - i64::from(self.a.x);
        if right.abs().max(self.dx.abs()).max(self.dy) < 1 << 30 {
            (right * self.dy - self.down * self.dx) as f64
        } else {
            let product = |a: i64, b: i64| i128::from(a) * i128::from(b);
            (product(right, self.dy) - product(self.down, self.dx)) as f64
        }
    }
}

/// Emits the fragments of a span between the values at its two edges.
///
/// With l and r the distances of a centre to the left and right edge, v/w at the centre is
/// (r vL qL + l vR qR) / (l + r) and 1/w the same without v; so v = vL + (vR - vL) s with
/// s = l qR (1 / (r qL + l qR)), and the depth takes s = l / (l + r). All summands are positive: no
/// cancellation, and the error stays a few units in the last place of the largest value.
///
/// The width of the row is the same number at every column but for its rounding, so it is taken at
/// `origin_px`, which does not depend on the window: a tile shows the very bits of the whole.
fn fill_span<V: Varying, const AFFINE: bool>(
    left: &RowEnd<V>,
    right: &RowEnd<V>,
    span: Span,
    origin_px: i32,
    emit: &mut impl FnMut(Fragment<V>),
) {
    // Whole numbers, see `distances_are_exact`; a span of one pixel takes no step.
    let mut from_left = left.distance(span.x0_px);
    let mut from_right = -right.distance(span.x0_px);
    let (left_step, right_step) =
        ((left.dy << SUBPIXEL_BITS) as f64, (right.dy << SUBPIXEL_BITS) as f64);
    // Both distances over the same denominator.
    let (left_height, right_height) = (left.dy as f64, right.dy as f64);
    let (left_q, right_q) = (left_height * left.q, right_height * right.q);
    let width = left.distance(origin_px) * right_height - right.distance(origin_px) * left_height;
    let inv_width = 1.0 / width;
    let depth_slope = (right.depth - left.depth, right_height * inv_width);
    let varying_slope = right.varying - left.varying;
    for x_px in span.x0_px..span.x1_px {
        debug_assert!(from_left >= 0.0 && from_right > 0.0, "s leaves [0, 1): a clamp would act");
        let l = from_left * right_q;
        let r = from_right * left_q;
        let inv_sum = if AFFINE { inv_width } else { 1.0 / (r + l) };
        emit(Fragment {
            x_px,
            y_px: span.y_px,
            depth: left.depth + depth_slope.0 * (from_left * depth_slope.1),
            varying: left.varying + varying_slope * (l * inv_sum),
        });
        from_left += left_step;
        from_right -= right_step;
    }
}

// Without the assertions these tests would show nothing, so they do not exist.
#[cfg(all(test, debug_assertions))]
mod tests {
    use super::*;

    fn vertex(x: i32, y: i32, inv_w: f64) -> ScreenVertex<f64> {
        let position = SubpixelPoint::new(x, y);
        ScreenVertex { position, depth: f64::from(x), inv_w, varying: f64::from(y) }
    }

    /// Every triangle with corners on a 7 x 7 lattice of 96 subpixels, ties and slivers among them,
    /// and a w ratio of 1000: the assertions in `Edge::at` and `fill_span`, which say that a clamp
    /// of the book would act, stay silent, and no value leaves the hull by more than rounding.
    #[test]
    fn the_books_clamps_never_act() {
        let points: Vec<_> = (0..49).map(|i| (i % 7 * 96 - 160, i / 7 * 96 - 160)).collect();
        // u (15 D + 2 M), derived in `verify::tolerance`, with D = 576 and M = 416.
        let rounding = f64::EPSILON / 2.0 * (15.0 * 576.0 + 2.0 * 416.0);
        let mut fragments = 0;
        for (i, a) in points.iter().enumerate() {
            for (j, b) in points.iter().enumerate().skip(i + 1) {
                for c in &points[j + 1..] {
                    let vertices =
                        [vertex(a.0, a.1, 1.0), vertex(b.0, b.1, 1e-3), vertex(c.0, c.1, 0.5)];
                    let window = PixelRect { x0: -2, y0: -2, x1: 3, y1: 3 };
                    Scanline.fragments(&ScreenTriangle { vertices }, window, |f| {
                        fragments += 1;
                        let hull = -160.0 - rounding..=416.0 + rounding;
                        assert!(
                            hull.contains(&f.varying) && hull.contains(&f.depth),
                            "{vertices:?}"
                        );
                    });
                }
            }
        }
        assert!(fragments > 10_000, "{fragments}");
    }

    /// The assertion can fail: a row above the edge would need t < 0, as the book's t does.
    #[test]
    #[should_panic(expected = "a clamp would act")]
    fn a_row_outside_the_edge_is_noticed() {
        let end = |y| (vertex(0, y, 1.0), 1.0);
        Edge::new(&end(512), &end(1024)).at(1);
    }
}
// x
