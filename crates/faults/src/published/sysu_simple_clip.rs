//! Specimen: the 'simple clip' of SYSU assignment 2 (task 2): a triangle is kept whole iff at least
//! one corner lies in [-w, w]^3 with w between near and far.
//! Source: Sun Yat-sen University, Computer Graphics, assignment 2, and a published report (2022); see `docs/sources.md`.
//!
//! Symptom: a triangle that covers the screen with every corner outside is dropped; one with a corner behind
//! the eye is kept whole and divided by a w of the wrong sign.

use super::ClipVertex;
use super::book_final::BORDERS;
use super::scene::{
    COLOURS, Image, SIDE, Setting, Version, clip_by_sign, clip_vertex, empty, fill_clipped,
};
use rasterproof_core::arrays::MapArray as _;

/// Whether a corner lies inside, for near and far of 0.1 and 100.
fn inside(v: &ClipVertex) -> bool {
    let p = v.position;
    (0.1..=100.0).contains(&p.w) && p.truncate().abs().max_element() <= p.w
}

/// The published choice: all of a triangle, or nothing of it.
pub fn kept(triangle: [ClipVertex; 3]) -> Vec<ClipVertex> {
    if triangle.iter().any(inside) { triangle.to_vec() } else { Vec::new() }
}

/// The cure: what lies on the inner side of all six planes.
fn clipped(triangle: [ClipVertex; 3]) -> Vec<ClipVertex> {
    let mut polygon = triangle.to_vec();
    for border in &BORDERS {
        polygon = clip_by_sign(&polygon, border);
    }
    polygon
}

/// A triangle around the whole screen, or one within it.
pub fn draw(version: Version, setting: Setting) -> Image {
    let reach = if setting == Setting::Exposing { 2.5 } else { 0.8 };
    let triangle = [(-reach, -reach), (reach, -reach), (0.0, reach)]
        .map_array(|(x, y)| clip_vertex(x, y, 0.0, 1.0));
    let mut image = empty(SIDE);
    let polygon = match version {
        Version::Published => kept(triangle),
        Version::Repaired => clipped(triangle),
    };
    fill_clipped(&mut image, &polygon, COLOURS[1]);
    image
}
