//! Specimen: the viewport of the book (part 2, chapter 8, section 8.2): (ndc + 1)/2 times (size - 1).
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptom: with samples at pixel centres the picture is squeezed by a pixel and a screen-filling square leaves
//! the last column and row empty; everything shifts, by up to a pixel at the far end.

use glam::DVec2;

use super::scene::{COLOURS, Image, SIDE, Setting, Version, empty, fill};

/// The screen position in the book's orientation, y up, `last` steps from border to border.
fn viewport(ndc: DVec2, last: f64) -> DVec2 {
    (ndc + 1.0) / 2.0 * last
}

/// A square that fills the screen, or a small one in the corner.
pub fn draw(version: Version, setting: Setting) -> Image {
    let mut image = empty(SIDE);
    let side = f64::from(SIDE);
    let reach = if setting == Setting::Exposing { 1.0 } else { -0.8 };
    let last = if version == Version::Published { side - 1.0 } else { side };
    let corners = [(-1.0, -1.0), (reach, -1.0), (reach, reach), (-1.0, reach)].map(|(x, y)| {
        let p = viewport(DVec2::new(x, y), last);
        DVec2::new(p.x, side - p.y)
    });
    fill(&mut image, &corners, COLOURS[0]);
    image
}
