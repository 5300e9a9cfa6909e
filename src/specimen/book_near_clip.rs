//! Specimen: the near-plane clip of the book (part 2, chapter 7, section 7.4), ClipLine and
//! ClipAndDraw.
//!
//! Symptom: an edge counts as kept only if both ends lie strictly inside and as dropped only if both
//! lie strictly outside. An edge that lies in the plane is neither, so it is cut, at 0/0: the
//! triangle gets a corner that is not a number and disappears, although it lies wholly inside. A
//! corner in the plane is cut where it is, which is harmless but for its copies.
//! Cure: a corner in the plane is inside; only an edge whose ends differ is cut. Exposed by
//! `clip7_on_plane`; harmless while no corner lies in the plane.

use super::ClipVertex;

/// Clips by w = `boundary`, as published; the polygon has at most four corners, NaN among them.
#[must_use]
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
