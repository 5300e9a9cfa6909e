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
use rasterproof_core::grid::PixelRect;

const SAMPLES: u32 = 2;

fn triangles(setting: Setting) -> Vec<[DVec2; 3]> {
    let p = DVec2::new;
    let lower = [p(3.3, 4.2), p(28.6, 27.9), p(3.3, 27.9)];
    match setting {
        Setting::Exposing => vec![lower, [p(3.3, 4.2), p(28.6, 4.2), p(28.6, 27.9)]],
        Setting::Harmless => vec![lower],
    }
}

fn resolve(samples: &Image) -> Image {
    let mut image = empty(SIDE);
    let bounds = image.bounds();
    let n = SAMPLES as i32;
    for y in bounds.y0..bounds.y1 {
        for x in bounds.x0..bounds.x1 {
            let mut sum = [0u32; 3];
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let colour = samples.get(x * n + i, y * n + j).unwrap_or_default();
                (0..3).for_each(|k| sum[k] += u32::from(colour[k]));
            }
            // A mean of bytes is a byte.
            image.span_mut(y, x, x + 1)[0] = sum.map_array(|s| (s / (SAMPLES * SAMPLES)) as u8);
        }
    }
    image
}

fn drawn(samples: &mut Image, triangle: [DVec2; 3], colour: Colour) {
    fill(samples, &triangle.map_array(|p| p * f64::from(SAMPLES)), colour);
}

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
        let PixelRect { y0, y1, x0, x1 } = image.bounds();
        for (x, y) in (y0..y1).flat_map(|y| (x0..x1).map(move |x| (x, y))) {
            let colour = mean.get(x, y).unwrap_or_default();
            if colour != [0; 3] {
                image.span_mut(y, x, x + 1)[0] = colour;
            }
        }
    }
    if version == Version::Repaired { resolve(&all) } else { image }
}
