//! Specimen: the repair that one solution of GAMES101 homework 2 publishes for its depth.
//!
//! The skeleton divides depths by a w that it has set to 1, so its depth is linear on the screen. The
//! solution takes that for the fault and puts the true w back.
//! Symptom: z/w is linear on the screen already; with the true w it is bent, by
//! 2 (sqrt R - 1)/(sqrt R + 1) of a range of 2: 0.34 at a ratio of R = 2, 1.64 at 100. Neighbours that
//! share an edge then hide each other wrongly. Cure: leave it linear; the degenerate formula was
//! right. Exposed by w = 1 and 100; harmless where the w are equal.

use glam::DVec2;

use super::scene::{Image, SIDE, Setting, Version, empty, fragments};

/// Depth at the share t of the way on the screen between two corners, with the weights of 1/w.
#[must_use]
pub fn published(depths: [f64; 2], w: [f64; 2], t: f64) -> f64 {
    let (from, to) = ((1.0 - t) / w[0], t / w[1]);
    (depths[0] * from + depths[1] * to) / (from + to)
}

/// The depth of a receding floor in bands: black and white change every sixteenth of the range.
#[must_use]
pub fn draw(version: Version, setting: Setting) -> Image {
    let mut image = empty(SIDE);
    let far = if setting == Setting::Exposing { 100.0 } else { 1.0 };
    let p = |x: f64, y: f64, w: f64, depth: f64| (DVec2::new(x, y), w, DVec2::splat(depth));
    let quad = [
        p(1.0, 31.0, 1.0, -1.0),
        p(31.0, 31.0, 1.0, -1.0),
        p(31.0, 1.0, far, 1.0),
        p(1.0, 1.0, far, 1.0),
    ];
    for corners in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]] {
        let bounds = image.bounds();
        fragments(corners, bounds, |f| {
            // The published weights are those of a perspective-correct attribute.
            let depth = if version == Version::Published { f.varying.x } else { f.depth };
            let grey = ((depth + 1.0) / 2.0 * 255.0).clamp(0.0, 255.0) as u8;
            image.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = [grey, grey / 2 + 64, 255 - grey];
        });
    }
    image
}
