//! Specimen: the near-plane clip of the book (part 2, chapter 7, section 7.4), ClipLine and
//! ClipAndDraw.
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptom: an edge counts as kept only if both ends lie strictly inside and as dropped only if both lie
//! strictly outside. An edge that lies in the plane is neither, so it is cut, at 0/0: the triangle gets a
//! corner that is not a number and disappears, although it lies wholly inside. A corner in the plane is cut
//! where it is, which is harmless but for its copies.

use super::ClipVertex;
use super::scene::{
    COLOURS, Image, SIDE, Setting, Version, clip_by_sign, clip_vertex, empty, fill_clipped,
};
use rasterproof_core::arrays::MapArray as _;

/// Clips by w = `boundary`, as published; the polygon has at most four corners, NaN among them.
pub fn clip_near(triangle: [ClipVertex; 3], boundary: f64) -> Vec<ClipVertex> {
    let mut kept = Vec::new();
    for (i, a) in triangle.iter().enumerate() {
        let b = &triangle[(i + 1) % 3];
        let (from, to) = (a.position.w, b.position.w);
        if from < boundary && to < boundary {
            continue;
        }
        if from > boundary {
            kept.push(*a);
        }
        if !(from > boundary && to > boundary) {
            let t = (boundary - from) / (to - from);
            kept.push(a.towards(b, t));
        }
    }
    kept
}

pub fn draw(version: Version, setting: Setting) -> Image {
    let near = if setting == Setting::Exposing { [20.0, 15.0, 15.0] } else { [20.0, 16.0, 12.0] };
    let places = [(-0.8, -0.7), (0.8, -0.6), (-0.2, 0.8)];
    let triangle = [0, 1, 2].map_array(|i| clip_vertex(places[i].0, places[i].1, 0.0, near[i]));
    let polygon = match version {
        Version::Published => clip_near(triangle, 15.0),
        Version::Repaired => clip_by_sign(&triangle, |p| p.w - 15.0),
    };
    let mut image = empty(SIDE);
    fill_clipped(&mut image, &polygon, COLOURS[1]);
    image
}
