//! Specimen: the triangle of SYSU assignment 2 (rasterize_fill_edge_function): edge functions in
//! `int` on corners rounded to whole pixels.
//! Source: Sun Yat-sen University, Computer Graphics, assignment 2, and a published report (2022); see `docs/sources.md`.
//!
//! Symptoms: a sample belongs where the three functions are <= 0, so samples on shared edges are drawn twice;
//! corners are rounded to whole pixels (and towards zero left of the window), so shapes jump; products overflow
//! from 46341 x 46341 pixels on; a triangle without area is a line, drawn with weights 0/0. Two mistakes that
//! the report describes live in [`super::sysu_weights`] and [`super::sysu_truncated`].
//!
//! The renderer hands over front faces only; here a triangle of the other winding is turned round.

use glam::DVec2;

use super::{DrawResult, Fragments, NoResult, Published, RealTriangle, Spans, to_int};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, Span};

#[derive(Clone, Copy, Debug)]
pub struct SysuInclusive;

/// A pixel with the values of the edge functions ab, bc, ca, and one over their sum.
pub(super) struct Sample {
    pub x_px: i32,
    pub y_px: i32,
    /// At most 0 inside, and wrapped around where they overflow.
    pub edges: [i32; 3],
    pub inverse: f32,
}

/// The corners in whole pixels: `ivec2(position + 0.5)`, with the pixel's centre as its position.
fn whole(triangle: &RealTriangle) -> Result<[[i32; 2]; 3], NoResult> {
    let mut corners = [[0; 2]; 3];
    for (corner, v) in corners.iter_mut().zip(triangle) {
        let centre = v.position_px - 0.5;
        // Truncated towards zero, and within i32 by `to_int`.
        *corner = [to_int(centre.x + 0.5)? as i32, to_int(centre.y + 0.5)? as i32];
    }
    Ok(corners)
}

/// The triangle with its corners in the order of a front face.
pub(super) fn front(triangle: &RealTriangle) -> Result<RealTriangle, NoResult> {
    let [a, b, c] = whole(triangle)?.map_array(|corner| corner.map_array(i128::from));
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let [a, b, c] = *triangle;
    Ok(if area > 0 { [a, c, b] } else { [a, b, c] })
}

/// Walks the bounding box with incremental edge functions; `triangle` is a front face.
pub(super) fn samples(
    triangle: &RealTriangle,
    bounds: PixelRect,
    emit: &mut dyn FnMut(Sample),
) -> Result<(), NoResult> {
    let [a, b, c] = whole(triangle)?;
    let columns =
        a[0].min(b[0]).min(c[0]).max(bounds.x0)..=a[0].max(b[0]).max(c[0]).min(bounds.x1 - 1);
    let rows =
        a[1].min(b[1]).min(c[1]).max(bounds.y0)..=a[1].max(b[1]).max(c[1]).min(bounds.y1 - 1);
    // f(x, y) = k + i x + j y for each edge; what overflows wraps round.
    let edge = |p: [i32; 2], q: [i32; 2]| {
        let constant = p[0].wrapping_mul(q[1]).wrapping_sub(p[1].wrapping_mul(q[0]));
        (p[1].wrapping_sub(q[1]), q[0].wrapping_sub(p[0]), constant)
    };
    let edges = [edge(a, b), edge(b, c), edge(c, a)];
    let start = edges.map_array(|(i, j, k)| {
        k.wrapping_add(i.wrapping_mul(*columns.start())).wrapping_add(j.wrapping_mul(*rows.start()))
    });
    // The sum of the three is the same everywhere: twice the area.
    let delta = start.into_iter().fold(0i32, i32::wrapping_add);
    let inverse = (1.0 / f64::from(delta)) as f32;
    // From pixel to pixel and from row to row each function changes by a constant.
    let mut at_row = start;
    for y_px in rows {
        let mut at = at_row;
        for x_px in columns.clone() {
            if at.iter().all(|&f| f <= 0) {
                emit(Sample { x_px, y_px, edges: at, inverse });
            }
            for (f, (i, ..)) in at.iter_mut().zip(edges) {
                *f = f.wrapping_add(i);
            }
        }
        for (f, (_, j, _)) in at_row.iter_mut().zip(edges) {
            *f = f.wrapping_add(j);
        }
    }
    Ok(())
}

/// barycentricLerp: depth linearly, attributes through v/w and 1/w (the framework divides by w
/// before and multiplies after).
pub(super) fn lerp(triangle: &RealTriangle, weights: [f32; 3]) -> (f64, DVec2) {
    let [a, b, c] = triangle;
    let w = weights.map_array(f64::from);
    let depth = w[0] * a.depth + w[1] * b.depth + w[2] * c.depth;
    let over_w = a.varying * (w[0] / a.w) + b.varying * (w[1] / b.w) + c.varying * (w[2] / c.w);
    (depth, over_w / (w[0] / a.w + w[1] / b.w + w[2] / c.w))
}

impl Published for SysuInclusive {
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult {
        samples(&front(triangle)?, bounds, &mut |s| {
            emit(Span { y_px: s.y_px, x0_px: s.x_px, x1_px: s.x_px + 1 });
        })
    }

    fn fragments(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: Fragments<'_>,
    ) -> DrawResult {
        let triangle = front(triangle)?;
        samples(&triangle, bounds, &mut |s| {
            // Each weight is an edge function over the sum, and belongs to the corner opposite.
            let [ab, bc, ca] = s.edges.map_array(|f| f as f32 * s.inverse);
            let (depth, varying) = lerp(&triangle, [bc, ca, ab]);
            emit(Fragment { x_px: s.x_px, y_px: s.y_px, depth, varying });
        })
    }
}
