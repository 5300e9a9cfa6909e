//! Specimen: supersampling averaged inside the loop over triangles ('pitfall 1' of GAMES101 homework
//! 2), and its right form.
//! Source: GAMES101 (Lingqi Yan, 2020), homework 2, and its published solutions; see `docs/sources.md`.
//!
//! Symptom: each triangle averages its own samples over the background and the last one to pass wins: a pixel
//! that is 1/4 of one triangle and 3/4 of the other becomes 3/4 or 1/4 of a colour, never the whole: dark edges
//! between neighbours.

use glam::DVec2;

use super::scene::{COLOURS, Colour, Image, SIDE, Setting, Version, empty, fill};
use rasterproof_core::arrays::MapArray as _;

const SAMPLES: u32 = 2;

/// Two halves of a square, or one of them alone.
fn triangles(setting: Setting) -> Vec<[DVec2; 3]> {
    let p = DVec2::new;
    let lower = [p(3.3, 4.2), p(28.6, 27.9), p(3.3, 27.9)];
    match setting {
        Setting::Exposing => vec![lower, [p(3.3, 4.2), p(28.6, 4.2), p(28.6, 27.9)]],
        Setting::Harmless => vec![lower],
    }
}

/// The mean of the samples of each pixel.
fn resolve(samples: &Image) -> Image {
    let mut image = empty(SIDE);
    let bounds = image.bounds();
    let n = SAMPLES as i32;
    for y in bounds.y0..bounds.y1 {
        for x in bounds.x0..bounds.x1 {
            let mut sum = [0u32; 3];
            for i in 0..n {
                for j in 0..n {
                    let colour = samples.get(x * n + i, y * n + j).unwrap_or_default();
                    for (sum, channel) in sum.iter_mut().zip(colour) {
                        *sum += u32::from(channel);
                    }
                }
            }
            // A mean of bytes is a byte.
            image.span_mut(y, x, x + 1)[0] = sum.map_array(|s| (s / (SAMPLES * SAMPLES)) as u8);
        }
    }
    image
}

/// Draws a triangle into samples, which are pixels of a larger picture.
fn drawn(samples: &mut Image, triangle: [DVec2; 3], colour: Colour) {
    fill(samples, &triangle.map_array(|p| p * f64::from(SAMPLES)), colour);
}

/// Draws the triangles of the setting by samples, and averages them early as published, or once at the end.
pub fn draw(version: Version, setting: Setting) -> Image {
    let (mut all, mut image) = (empty(SIDE * SAMPLES), empty(SIDE));
    for triangle in triangles(setting) {
        if version == Version::Repaired {
            drawn(&mut all, triangle, COLOURS[0]);
            continue;
        }
        let mut own = empty(SIDE * SAMPLES);
        drawn(&mut own, triangle, COLOURS[0]);
        let mean = resolve(&own);
        // The published mistake: an average replaces what earlier triangles have left in the pixel.
        for (y, row) in mean.rows() {
            for (pixel, colour) in image.row_mut(y).iter_mut().zip(row) {
                if *colour != [0; 3] {
                    *pixel = *colour;
                }
            }
        }
    }
    if version == Version::Repaired { resolve(&all) } else { image }
}
