//! Corners of clip space, in a triangle of a case.

use super::Triangle;

/// x, y, z, w in clip space, and an attribute.
pub type ClipCorner = [f64; 5];

/// The corners of a case of `near-plane`, whose vertices keep w as their first attribute: a window position has no place
/// for a w that is zero or less. The second one is the attribute.
#[must_use]
pub fn clip_corners(triangle: &Triangle) -> [ClipCorner; 3] {
    triangle.vertices.each_ref().map(|v| {
        let (x, y) = v.position.to_px();
        [x, y, v.depth, v.varying.x, v.varying.y]
    })
}
