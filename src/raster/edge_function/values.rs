//! Values of the edge-function engine: barycentric weights in the offset form (the book's chapters 3
//! and 5 say what they are, GAMES101 homework 2 and SYSU assignment 2 use them).

use super::{
    EdgeFunction, Exact, Word, WordWidth, centre, edges, extents, pixel_box, twice_area, walk,
};
use crate::contract::Interpolate;
use crate::grid::{PixelRect, SUBPIXELS};
use crate::triangle::{Fragment, ScreenTriangle, Varying};

impl Interpolate for EdgeFunction {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        let (extent_x, extent_y) = extents(&triangle.corners());
        match WordWidth::of(extent_x, extent_y) {
            WordWidth::I32 => fragments_in::<V, i64, i32, false>(triangle, bounds, emit),
            WordWidth::I64 => fragments_in::<V, i64, i64, false>(triangle, bounds, emit),
            WordWidth::I128 => fragments_in::<V, i128, i128, false>(triangle, bounds, emit),
        }
    }

    fn affine_fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        let (extent_x, extent_y) = extents(&triangle.corners());
        match WordWidth::of(extent_x, extent_y) {
            WordWidth::I32 => fragments_in::<V, i64, i32, true>(triangle, bounds, emit),
            WordWidth::I64 if is_exact(extent_x, extent_y) => {
                fragments_in::<V, i64, i64, true>(triangle, bounds, emit);
            }
            // The sum of the weights is rounded anew at each pixel.
            _ => self.fragments(&triangle.with_equal_w(), bounds, emit),
        }
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
pub(super) fn fragments_in<V: Varying, T: Exact, W: Word, const AFFINE: bool>(
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    mut emit: impl FnMut(Fragment<V>),
) {
    let rect = pixel_box(&triangle.corners(), bounds);
    if rect.is_empty() {
        return;
    }
    // Bring the vertices into the canonical order.
    let mut vertices = triangle.vertices;
    let height = |i: usize| (vertices[i].position.y, vertices[i].position.x);
    let top = if height(1) < height(0) { 1 } else { 0 };
    let top = if height(2) < height(top) { 2 } else { top };
    vertices.rotate_left(top);
    let area = match twice_area::<T>(&vertices.map(|vertex| vertex.position)) {
        area if area.sign() == 0 => return,
        area if area.sign() > 0 => area.to_f64(),
        area => {
            vertices.swap(1, 2);
            -area.to_f64()
        }
    };
    let [v0, v1, v2] = &vertices;
    let corners = vertices.map(|vertex| vertex.position);
    let edges = edges(&corners);

    // Prepare what is constant over the triangle.
    let largest = v0.inv_w.max(v1.inv_w).max(v2.inv_w);
    let q = [v0.inv_w / largest, v1.inv_w / largest, v2.inv_w / largest];
    let (d1, d2) = (v1.varying - v0.varying, v2.varying - v0.varying);
    let (z1, z2) = (v1.depth - v0.depth, v2.depth - v0.depth);
    let inv_area = 1.0 / area;
    let steps = [0, 1, 2].map(|i| (-edges[i].dy * i64::from(SUBPIXELS)) as f64);
    // Where f64 does not step E exactly, each pixel starts anew.
    let (extent_x, extent_y) = extents(&corners);
    let exact = is_exact(extent_x, extent_y);
    debug_assert!(exact || !AFFINE);

    walk::<T, W>(&edges, rect, |span| {
        let at = |i: usize, x_px: i32| edges[i].at::<T>(centre(x_px), centre(span.y_px)).to_f64();
        let mut e = [0, 1, 2].map(|i| at(i, span.x0_px));
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
                depth: v0.depth + (z1 * e[1] + z2 * e[2]) * inv_area,
                varying: v0.varying + (d1 * a[1] + d2 * a[2]) * inv_sum,
            });
            e = if exact || x_px + 1 == span.x1_px {
                [e[0] + steps[0], e[1] + steps[1], e[2] + steps[2]]
            } else {
                [0, 1, 2].map(|i| at(i, x_px + 1))
            };
        }
    });
}
