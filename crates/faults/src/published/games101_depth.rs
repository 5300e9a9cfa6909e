//! Specimen: the repair that one solution of GAMES101 homework 2 publishes for its depth.
//! Source: GAMES101 (Lingqi Yan, 2020), homework 2, and its published solutions; see `docs/sources.md`.
//!
//! The skeleton divides depths by a w that it has set to 1, so its depth is linear on the screen. The solution
//! takes that for the fault and puts the true w back.
//! Symptom: z/w is linear on the screen already; with the true w it is bent, by 2 (sqrt R - 1)/(sqrt R + 1) of
//! a range of 2: 0.34 at a ratio of R = 2, 1.64 at 100. Neighbours that share an edge then hide each other
//! wrongly.

use super::games101_strict::Games101Strict;
use super::scene::{COLOURS, Image, SIDE, Setting, Version, WHITE, either, empty, floor_triangles};

/// Depth at the share t of the way on the screen between two corners, with the weights of 1/w.
pub fn published(depths: [f64; 2], w: [f64; 2], t: f64) -> f64 {
    let (from, to) = ((1.0 - t) / w[0], t / w[1]);
    (depths[0] * from + depths[1] * to) / (from + to)
}

/// The depth of a receding floor in eight bands, or that of an upright wall.
pub fn draw(version: Version, setting: Setting) -> Image {
    let mut image = empty(SIDE);
    let far = if setting == Setting::Exposing { 100.0 } else { 1.0 };
    let specimen = Games101Strict { whole_samples: false, true_w: true };
    for triangle in floor_triangles(far) {
        either(&specimen, version, &triangle, image.bounds(), &mut |f| {
            let is_even = (f.depth * 4.0).floor().rem_euclid(2.0) == 0.0;
            let colour = if is_even { COLOURS[0] } else { WHITE };
            image.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = colour;
        });
    }
    image
}
