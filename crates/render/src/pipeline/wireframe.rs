//! Triangles as their three edges, by either line drawer (SYSU assignment 2, task 1).
//!
//! A line drawer interpolates linearly in the window. To be right in perspective, an edge carries
//! v/w and 1/w, and the fragment stage divides.

use std::ops::{Add, Mul, Sub};

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::DrawLine;
use rasterproof_core::grid::{PixelRect, SUBPIXEL_BITS};
use rasterproof_core::triangle::{
    Fragment, LineEnd, PixelPoint, ScreenLine, ScreenTriangle, ScreenVertex, Varying,
};

/// A value over w, with 1/w: what is linear in the window.
#[derive(Clone, Copy, Debug)]
struct OverW<V> {
    value: V,
    inv_w: f64,
}

impl<V: Varying> Add for OverW<V> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, inv_w: self.inv_w + other.inv_w }
    }
}

impl<V: Varying> Sub for OverW<V> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, inv_w: self.inv_w - other.inv_w }
    }
}

impl<V: Varying> Mul<f64> for OverW<V> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, inv_w: self.inv_w * factor }
    }
}

impl<V: Varying> Varying for OverW<V> {
    fn by_number(values: [Self; 3], mut number: impl FnMut([f64; 3]) -> f64) -> Self {
        let value = V::by_number(values.map_array(|v| v.value), &mut number);
        Self { value, inv_w: number(values.map_array(|v| v.inv_w)) }
    }
}

/// Emits the fragments of the three edges; the corners, and pixels where edges meet, come twice.
pub fn draw_edges<V: Varying>(
    drawer: &impl DrawLine,
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    mut emit: impl FnMut(Fragment<V>),
) {
    // 1/w over the largest, so that equal w change nothing and no product underflows.
    let largest = triangle.vertices.iter().fold(0.0, |max: f64, vertex| max.max(vertex.inv_w));
    let end = |vertex: &ScreenVertex<V>| {
        let inv_w = vertex.inv_w / largest;
        LineEnd {
            pixel: PixelPoint::new(
                vertex.position.x >> SUBPIXEL_BITS,
                vertex.position.y >> SUBPIXEL_BITS,
            ),
            depth: vertex.depth,
            varying: OverW { value: vertex.varying * inv_w, inv_w },
        }
    };
    let [a, b, c] = [0, 1, 2].map_array(|i| end(&triangle.vertices[i]));
    for ends in [[a, b], [b, c], [c, a]] {
        drawer.draw(&ScreenLine { ends }, bounds, |f| {
            let varying = f.varying.value * (1.0 / f.varying.inv_w);
            emit(Fragment { x_px: f.x_px, y_px: f.y_px, depth: f.depth, varying });
        });
    }
}
