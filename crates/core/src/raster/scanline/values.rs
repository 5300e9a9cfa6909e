//! Values of the scanline engine: between the two edges of a row, from the exact distances of each
//! centre to both (the book's chapters 3 and 5, pre-stepped).

use super::{EDGES, Scanline, centre, sort_by_height, walk_in_batches};
use crate::contract::{Interpolate, RUN, Run, Varyings};
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

    fn runs<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        affine: bool,
        take: &mut dyn FnMut(Run<'_, V>),
    ) {
        if !affine {
            return runs_in::<V, false>(triangle, bounds, take);
        }
        let triangle = triangle.with_equal_w();
        if widths_are_exact(&triangle.corners()) {
            runs_in::<V, true>(&triangle, bounds, take);
        } else {
            runs_in::<V, false>(&triangle, bounds, take);
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
    let (edges, corners) = edges_of(triangle);
    // Where distances are not exact, each pixel starts anew.
    let exact = distances_are_exact(&corners);
    let chunk = if exact { i32::MAX } else { 1 };
    walk_in_batches(&corners, bounds, &mut |rows| {
        for &(Span { y_px, x0_px, x1_px }, sides) in rows {
            let side = |number: u8| edges[usize::from(number)].at(y_px);
            let (left, right) = (side(sides.left), side(sides.right));
            let mix = Mix::new(&left, &right);
            let mut x_px = x0_px;
            while x_px < x1_px {
                let end_px = x1_px.min(x_px.saturating_add(chunk));
                let origin_px = if exact { sides.first_px } else { x_px };
                let across = Across::new(&left, &right, x_px, origin_px);
                let part = Span { y_px, x0_px: x_px, x1_px: end_px };
                fill_span::<V, AFFINE>(across, mix, part, &mut emit);
                x_px = end_px;
            }
        }
    });
}

/// The same in runs, with the same bits.
fn runs_in<V: Varying, const AFFINE: bool>(
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    take: &mut dyn FnMut(Run<'_, V>),
) {
    let (edges, corners) = edges_of(triangle);
    let exact = distances_are_exact(&corners);
    let chunk = if exact { RUN as i32 } else { 1 };
    let mut room = [triangle.vertices[0].varying; RUN];
    walk_in_batches(&corners, bounds, &mut |rows| {
        for &(Span { y_px, x0_px, x1_px }, sides) in rows {
            let side = |number: u8| edges[usize::from(number)].at(y_px);
            let mut row = Row { left: side(sides.left), right: side(sides.right), mix: None };
            let mut x_px = x0_px;
            while x_px < x1_px {
                let end_px = x1_px.min(x_px.saturating_add(chunk));
                let origin_px = if exact { sides.first_px } else { x_px };
                let across = Across::new(&row.left, &row.right, x_px, origin_px);
                let mut depths = [0.0; RUN];
                let depths = &mut depths[..(end_px - x_px) as usize];
                for (number, depth) in (0_i32..).zip(depths.iter_mut()) {
                    *depth = across.depth(across.distances(number));
                }
                let mut values = RowRun::<V, AFFINE> { row: &mut row, across, room: &mut room };
                take(Run { y_px, x0_px: x_px, depths, values: &mut values });
                x_px = end_px;
            }
        }
    });
}

/// The edges from the top down, and the corners.
#[inline]
fn edges_of<V: Varying>(triangle: &ScreenTriangle<V>) -> ([Edge<V>; 3], Corners) {
    let order = by_height(&triangle.corners());
    let [v0, v1, v2] =
        [&triangle.vertices[order[0]], &triangle.vertices[order[1]], &triangle.vertices[order[2]]];
    let [q0, q1, q2] = relative_inv_w([v0.inv_w, v1.inv_w, v2.inv_w]);
    let ends = [(v0, q0), (v1, q1), (v2, q2)];
    let edge = |[from, to]: [usize; 2]| Edge::new(ends[from], ends[to]);
    let edges = [edge(EDGES[0]), edge(EDGES[1]), edge(EDGES[2])];
    (edges, [v0.position, v1.position, v2.position])
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
    fn new((from, from_q): (&ScreenVertex<V>, f64), (to, to_q): (&ScreenVertex<V>, f64)) -> Self {
        let (a, b) = (from.position, to.position);
        Self {
            a,
            dx: i64::from(b.x) - i64::from(a.x),
            dy: i64::from(b.y) - i64::from(a.y),
            depth: [from.depth, to.depth - from.depth],
            q: [from_q, to_q],
            varying: [from.varying, to.varying - from.varying],
        }
    }

    #[inline]
    fn at(&self, y_px: i32) -> RowEnd<'_, V> {
        let (down, dy) = (centre(y_px) - i64::from(self.a.y), self.dy);
        debug_assert!((0..dy).contains(&down), "t = {down}/{dy} leaves [0, 1): a clamp would act");
        RowEnd { edge: self, down }
    }
}

/// Where an edge crosses a row of centres.
struct RowEnd<'a, V> {
    edge: &'a Edge<V>,
    down: i64,
}

impl<V: Varying> RowEnd<'_, V> {
    /// How far the centre of column `x_px` lies right of the edge, in subpixels, times dy; exact
    /// but for the rounding to f64.
    #[inline]
    fn distance(&self, x_px: i32) -> f64 {
        let Edge { a, dx, dy, .. } = *self.edge;
        let right = centre(x_px) - i64::from(a.x);
        if right.abs().max(dx.abs()).max(dy) < 1 << 30 {
            (right * dy - self.down * dx) as f64
        } else {
            let product = |a: i64, b: i64| i128::from(a) * i128::from(b);
            (product(right, dy) - product(self.down, dx)) as f64
        }
    }

    /// The height of the edge, a whole number below 2^33: exact in f64.
    #[inline]
    fn height(&self) -> f64 {
        self.edge.dy as f64
    }

    /// The depth, linear down the edge.
    #[inline]
    fn depth(&self) -> f64 {
        let [from, difference] = self.edge.depth;
        from + difference * (self.down as f64 / self.height())
    }

    /// The relative 1/w and the varying, by the book's formula (8) of section 5.4: v/w and 1/w are
    /// linear down the edge, their quotient is the value. Written with the difference of the ends, so
    /// that equal ends give their value exactly.
    #[inline]
    fn values(&self) -> (f64, V) {
        let ([from_q, to_q], [from, difference]) = (self.edge.q, self.edge.varying);
        let (below, above) = (self.down as f64, (self.edge.dy - self.down) as f64);
        let q_sum = above * from_q + below * to_q;
        (q_sum / self.height(), from + difference * (below * to_q / q_sum))
    }
}

/// A row between two edges.
struct Row<'a, V> {
    left: RowEnd<'a, V>,
    right: RowEnd<'a, V>,
    /// What the varyings need of both ends, once one of them was asked for.
    mix: Option<Mix<V>>,
}

/// A varying between its values at the two ends of a row.
#[derive(Clone, Copy)]
struct Mix<V> {
    /// 1/w at both ends, times the height of the edge, so that both distances have one denominator.
    left_q: f64,
    right_q: f64,
    left: V,
    difference: V,
}

impl<V: Varying> Mix<V> {
    #[inline]
    fn new(left: &RowEnd<'_, V>, right: &RowEnd<'_, V>) -> Self {
        let ((left_q, left_varying), (right_q, right_varying)) = (left.values(), right.values());
        Self {
            left_q: left.height() * left_q,
            right_q: right.height() * right_q,
            left: left_varying,
            difference: right_varying - left_varying,
        }
    }
}

/// The run of a part of a row, whose distances f64 steps exactly, or of one pixel.
struct RowRun<'a, 'b, V, const AFFINE: bool> {
    row: &'a mut Row<'b, V>,
    across: Across,
    room: &'a mut [V; RUN],
}

/// What changes evenly along a part of a row.
///
/// With l and r the distances of a centre to the left and right edge, v/w at the centre is
/// (r vL qL + l vR qR) / (l + r) and 1/w the same without v; so v = vL + (vR - vL) s with
/// s = l qR (1 / (r qL + l qR)), and the depth takes s = l / (l + r). All summands are positive: no
/// cancellation, and the error stays a few units in the last place of the largest value.
#[derive(Clone, Copy)]
struct Across {
    /// Distances of the first centre to both edges, and what they change by at the next.
    left: [f64; 2],
    right: [f64; 2],
    /// 1 / (l + r), both over one denominator.
    inv_width: f64,
    /// The depth at the left edge, and what the right one's differs by.
    depth: [f64; 2],
    /// s over l, for the depth.
    slope: f64,
}

impl Across {
    /// From column `x0_px` on. The width of the row is the same number at every column but for its
    /// rounding, so it is taken at `origin_px`, which does not depend on the window: a tile shows the
    /// very bits of the whole.
    #[inline]
    fn new<V: Varying>(
        left: &RowEnd<'_, V>,
        right: &RowEnd<'_, V>,
        x0_px: i32,
        origin_px: i32,
    ) -> Self {
        let distances = |x_px| (left.distance(x_px), -right.distance(x_px));
        let (from_left, from_right) = distances(x0_px);
        let (l, r) =
            if origin_px == x0_px { (from_left, from_right) } else { distances(origin_px) };
        let step = |end: &RowEnd<'_, V>| (end.edge.dy << SUBPIXEL_BITS) as f64;
        let inv_width = 1.0 / (l * right.height() + r * left.height());
        let first = left.depth();
        Self {
            left: [from_left, step(left)],
            right: [from_right, step(right)],
            inv_width,
            depth: [first, right.depth() - first],
            slope: right.height() * inv_width,
        }
    }

    /// l and r of the centre of a pixel, by its number.
    #[inline]
    fn distances(&self, number: i32) -> [f64; 2] {
        let number = f64::from(number);
        [self.left[0] + number * self.left[1], self.right[0] - number * self.right[1]]
    }

    /// The depth there.
    #[inline]
    fn depth(&self, [l, r]: [f64; 2]) -> f64 {
        debug_assert!(l >= 0.0 && r > 0.0, "s leaves [0, 1): a clamp would act");
        let [first, difference] = self.depth;
        first + difference * (l * self.slope)
    }

    /// The varying there.
    #[inline]
    fn varying<V: Varying, const AFFINE: bool>(&self, mix: &Mix<V>, [l, r]: [f64; 2]) -> V {
        let (l, r) = (l * mix.right_q, r * mix.left_q);
        let inv_sum = if AFFINE { self.inv_width } else { 1.0 / (r + l) };
        mix.left + mix.difference * (l * inv_sum)
    }
}

/// Emits the fragments of a span, pixel by pixel.
#[inline]
fn fill_span<V: Varying, const AFFINE: bool>(
    across: Across,
    mix: Mix<V>,
    Span { y_px, x0_px, x1_px }: Span,
    emit: &mut impl FnMut(Fragment<V>),
) {
    let [mut l, mut r] = [across.left[0], across.right[0]];
    for x_px in x0_px..x1_px {
        let varying = across.varying::<V, AFFINE>(&mix, [l, r]);
        emit(Fragment { x_px, y_px, depth: across.depth([l, r]), varying });
        l += across.left[1];
        r -= across.right[1];
    }
}

impl<V: Varying, const AFFINE: bool> Varyings<V> for RowRun<'_, '_, V, AFFINE> {
    fn varyings(&mut self, from: usize, to: usize) -> &[V] {
        let (across, Row { left, right, mix }) = (self.across, &mut *self.row);
        let mix = *mix.get_or_insert_with(|| Mix::new(left, right));
        for (number, value) in (from as i32..).zip(&mut self.room[from..to]) {
            *value = across.varying::<V, AFFINE>(&mix, across.distances(number));
        }
        &self.room[from..to]
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
    /// and a w ratio of 1000: the assertions in `Edge::at` and `Across::depth`, which say that a clamp
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
        let [from, to] = [512, 1024].map(|y| vertex(0, y, 1.0));
        Edge::new((&from, 1.0), (&to, 1.0)).at(1);
    }
}
