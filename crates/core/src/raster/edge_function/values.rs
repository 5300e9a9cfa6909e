//! Values of the edge-function engine: barycentric weights in the offset form (the book's chapters 3
//! and 5 say what they are, GAMES101 homework 2 and SYSU assignment 2 use them).

use super::{
    BatchedWalk, Edge, EdgeFunction, Exact, WordWidth, centre, edges, extents, pixel_box,
    twice_area, walk_in_batches,
};
use crate::contract::{Interpolate, RUN, Run, Varyings};
use crate::grid::{PixelRect, SUBPIXELS};
use crate::triangle::{Corners, Fragment, ScreenTriangle, Span, Varying};

impl Interpolate for EdgeFunction {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        let (extent_x, extent_y) = extents(&triangle.corners());
        let (walk, wide) = walk_of(WordWidth::of(extent_x, extent_y));
        fragments_in::<V, false>(triangle, bounds, walk, wide, emit);
    }

    fn affine_fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        let (extent_x, extent_y) = extents(&triangle.corners());
        let (walk, wide) = walk_of(WordWidth::of(extent_x, extent_y));
        if is_exact(extent_x, extent_y) {
            fragments_in::<V, true>(triangle, bounds, walk, wide, emit);
        } else {
            // The sum of the weights is rounded anew at each pixel.
            fragments_in::<V, false>(&triangle.with_equal_w(), bounds, walk, wide, emit);
        }
    }

    fn runs<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        affine: bool,
        take: &mut dyn FnMut(Run<'_, V>),
    ) {
        let (extent_x, extent_y) = extents(&triangle.corners());
        let (walk, wide) = walk_of(WordWidth::of(extent_x, extent_y));
        if !affine {
            runs_in::<V, false>(triangle, bounds, walk, wide, take);
        } else if is_exact(extent_x, extent_y) {
            runs_in::<V, true>(triangle, bounds, walk, wide, take);
        } else {
            runs_in::<V, false>(&triangle.with_equal_w(), bounds, walk, wide, take);
        }
    }
}

/// The walk in words of a width, and whether E itself needs more than 64 bits.
fn walk_of(width: WordWidth) -> (BatchedWalk, bool) {
    match width {
        WordWidth::I32 => (walk_in_batches::<i64, i32>, false),
        WordWidth::I64 => (walk_in_batches::<i64, i64>, false),
        WordWidth::I128 => (walk_in_batches::<i128, i128>, true),
    }
}

/// Whether f64 steps E exactly: it is a whole number of at most 2^53.
fn is_exact(extent_x: u32, extent_y: u32) -> bool {
    let padded = |extent: u32| u128::from(extent) + SUBPIXELS as u128;
    padded(extent_x) * padded(extent_y) <= 1 << f64::MANTISSA_DIGITS
}

/// Barycentric interpolation in the offset form: with q = (1/w) / max(1/w), a = E q and
/// d = (a0 + a1) + a2, the value is v0 + (a1 (v1 - v0) + a2 (v2 - v0)) / d. Equal w make every q
/// exactly 1 and d exactly twice the area, so the result is that of affine interpolation bit for
/// bit; a constant is returned exactly. Vertex 0 is the topmost (then leftmost) one and the winding
/// is made clockwise, so the order the vertices came in leaves no trace in the last bit.
///
/// `AFFINE` takes every q for 1 and d for twice the area, which they are where E is exact and the
/// three w are equal: then the reciprocal is the same at every pixel.
///
/// `walk` finds the spans, and `wide` says that E needs 128 bits; neither changes a value.
fn fragments_in<V: Varying, const AFFINE: bool>(
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    walk: BatchedWalk,
    wide: bool,
    mut emit: impl FnMut(Fragment<V>),
) {
    let Some((setup, values)) = Values::of(triangle, bounds, wide) else { return };
    debug_assert!(setup.exact || !AFFINE);
    // Where f64 does not step E exactly, each pixel starts anew.
    let chunk = if setup.exact { i32::MAX } else { 1 };
    walk(&setup.edges, setup.rect, &mut |spans| {
        for &Span { y_px, x0_px, x1_px } in spans {
            let mut x_px = x0_px;
            while x_px < x1_px {
                let end_px = x1_px.min(x_px.saturating_add(chunk));
                let e = setup.at(x_px, y_px);
                values.fill::<AFFINE>(e, Span { y_px, x0_px: x_px, x1_px: end_px }, &mut emit);
                x_px = end_px;
            }
        }
    });
}

/// The same in runs, with the same bits.
pub(super) fn runs_in<V: Varying, const AFFINE: bool>(
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    walk: BatchedWalk,
    wide: bool,
    take: &mut dyn FnMut(Run<'_, V>),
) {
    let Some((setup, values)) = Values::of(triangle, bounds, wide) else { return };
    debug_assert!(setup.exact || !AFFINE);
    let chunk = if setup.exact { RUN as i32 } else { 1 };
    let mut room = [values.first.1; RUN];
    walk(&setup.edges, setup.rect, &mut |spans| {
        for &Span { y_px, x0_px, x1_px } in spans {
            let mut x_px = x0_px;
            while x_px < x1_px {
                let end_px = x1_px.min(x_px.saturating_add(chunk));
                let e = setup.at(x_px, y_px);
                let mut depths = [0.0; RUN];
                let depths = &mut depths[..(end_px - x_px) as usize];
                values.fill_depths(e, depths);
                let values = &mut EdgeRun::<V, AFFINE> { values: &values, e, room: &mut room };
                take(Run { y_px, x0_px: x_px, depths, values });
                x_px = end_px;
            }
        }
    });
}

/// What is constant over the triangle; differences are to the first vertex in canonical order.
#[derive(Clone, Copy)]
struct Values<V> {
    first: (f64, V),
    depth: [f64; 2],
    varying: [V; 2],
    q: [f64; 3],
    inv_area: f64,
    steps: [f64; 3],
}

impl<V: Varying> Values<V> {
    /// Nothing where no sample is covered.
    #[inline]
    fn of(triangle: &ScreenTriangle<V>, bounds: PixelRect, wide: bool) -> Option<(Setup, Self)> {
        let setup = Setup::new(triangle.corners(), bounds, wide)?;
        let [i0, i1, i2] = setup.order;
        let [v0, v1, v2] = [&triangle.vertices[i0], &triangle.vertices[i1], &triangle.vertices[i2]];
        let largest = v0.inv_w.max(v1.inv_w).max(v2.inv_w);
        let values = Self {
            first: (v0.depth, v0.varying),
            depth: [v1.depth - v0.depth, v2.depth - v0.depth],
            varying: [v1.varying - v0.varying, v2.varying - v0.varying],
            q: [v0.inv_w / largest, v1.inv_w / largest, v2.inv_w / largest],
            inv_area: 1.0 / setup.area,
            steps: setup.steps,
        };
        Some((setup, values))
    }

    /// Emits the fragments of a span, at whose first pixel the three E are `e`. By value, so that the
    /// loop need not look again at numbers that `emit` might have written to.
    #[inline]
    fn fill<const AFFINE: bool>(
        self,
        mut e: [f64; 3],
        span: Span,
        emit: &mut impl FnMut(Fragment<V>),
    ) {
        let Self { first: (z0, v0), depth: [z1, z2], varying: [d1, d2], q, inv_area, steps } = self;
        for x_px in span.x0_px..span.x1_px {
            let (a, inv_sum) = if AFFINE {
                (e, inv_area)
            } else {
                let a = [e[0] * q[0], e[1] * q[1], e[2] * q[2]];
                (a, 1.0 / ((a[0] + a[1]) + a[2]))
            };
            emit(Fragment {
                x_px,
                y_px: span.y_px,
                depth: z0 + (z1 * e[1] + z2 * e[2]) * inv_area,
                varying: v0 + (d1 * a[1] + d2 * a[2]) * inv_sum,
            });
            e = [e[0] + steps[0], e[1] + steps[1], e[2] + steps[2]];
        }
    }

    /// The depths of a run, at whose first pixel the three E are `e`.
    #[inline]
    fn fill_depths(&self, e: [f64; 3], depths: &mut [f64]) {
        let Self { first: (z0, _), depth: [z1, z2], inv_area, steps, .. } = *self;
        for (number, depth) in (0_i32..).zip(depths) {
            let number = f64::from(number);
            let (e1, e2) = (e[1] + number * steps[1], e[2] + number * steps[2]);
            *depth = z0 + (z1 * e1 + z2 * e2) * inv_area;
        }
    }
}

/// The run at whose first pixel the three E are `e`: f64 steps them exactly, or it has one pixel.
struct EdgeRun<'a, V, const AFFINE: bool> {
    values: &'a Values<V>,
    e: [f64; 3],
    room: &'a mut [V; RUN],
}

impl<V: Varying, const AFFINE: bool> Varyings<V> for EdgeRun<'_, V, AFFINE> {
    fn varyings(&mut self, from: usize, to: usize) -> &[V] {
        let Values { first: (_, v0), varying: [d1, d2], q, inv_area, steps, .. } = *self.values;
        let e = self.e;
        for (number, value) in (from as i32..).zip(&mut self.room[from..to]) {
            let number = f64::from(number);
            let e = [e[0] + number * steps[0], e[1] + number * steps[1], e[2] + number * steps[2]];
            let (a, inv_sum) = if AFFINE {
                (e, inv_area)
            } else {
                let a = [e[0] * q[0], e[1] * q[1], e[2] * q[2]];
                (a, 1.0 / ((a[0] + a[1]) + a[2]))
            };
            *value = v0 + (d1 * a[1] + d2 * a[2]) * inv_sum;
        }
        &self.room[from..to]
    }
}

/// What the values of a triangle need of its corners.
struct Setup {
    /// The vertices in canonical order: the topmost, then leftmost first, then clockwise.
    order: [usize; 3],
    edges: [Edge; 3],
    rect: PixelRect,
    /// Twice the area.
    area: f64,
    /// What E grows by from column to column.
    steps: [f64; 3],
    /// Whether f64 steps E exactly.
    exact: bool,
    wide: bool,
}

impl Setup {
    /// Nothing where no sample is covered.
    fn new(corners: Corners, bounds: PixelRect, wide: bool) -> Option<Self> {
        let rect = pixel_box(&corners, bounds);
        if rect.is_empty() {
            return None;
        }
        let height = |i: usize| (corners[i].y, corners[i].x);
        let top = if height(1) < height(0) { 1 } else { 0 };
        let top = if height(2) < height(top) { 2 } else { top };
        let mut order = [[0, 1, 2], [1, 2, 0], [2, 0, 1]][top];
        let mut area = twice_area_f64(&corners, wide);
        if area == 0.0 {
            return None;
        }
        if area < 0.0 {
            order.swap(1, 2);
            area = -area;
        }
        let edges = edges(&[corners[order[0]], corners[order[1]], corners[order[2]]]);
        let step = |edge: &Edge| (-edge.dy * i64::from(SUBPIXELS)) as f64;
        let (extent_x, extent_y) = extents(&corners);
        Some(Self {
            order,
            edges,
            rect,
            area,
            steps: [step(&edges[0]), step(&edges[1]), step(&edges[2])],
            exact: is_exact(extent_x, extent_y),
            wide,
        })
    }

    /// The three E at the centre of a pixel, rounded once.
    #[inline]
    fn at(&self, x_px: i32, y_px: i32) -> [f64; 3] {
        let (x, y) = (centre(x_px), centre(y_px));
        let [a, b, c] = &self.edges;
        if self.wide {
            [a.at::<i128>(x, y).to_f64(), b.at::<i128>(x, y).to_f64(), c.at::<i128>(x, y).to_f64()]
        } else {
            [a.at::<i64>(x, y).to_f64(), b.at::<i64>(x, y).to_f64(), c.at::<i64>(x, y).to_f64()]
        }
    }
}

/// Twice the signed area, rounded once: the sign is exact, and 0 stays 0.
fn twice_area_f64(corners: &Corners, wide: bool) -> f64 {
    if wide { twice_area::<i128>(corners).to_f64() } else { twice_area::<i64>(corners).to_f64() }
}
