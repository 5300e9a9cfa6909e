//! What is asked of every rasterizer whose fills are measured, whether it runs in this process or outside.

use std::ops::Range;

use rasterproof_core::grid::PixelRect;

/// Someone who can fill the triangles of a scene.
pub trait Filler {
    /// Fills a part of the triangles twice, and times the second time.
    fn time_ns(&mut self, part: Range<usize>) -> f64;
    /// Draws one triangle, and takes the alphas of a rectangle off the target, row by row.
    fn take(&mut self, triangle: usize, rect: PixelRect) -> Vec<u8>;
    /// Pixels of the target that are not empty.
    fn left(&mut self) -> u64;
}
