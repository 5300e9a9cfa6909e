//! Specimen: the weights in the wrong order, a mistake that the report on SYSU assignment 2 (task 6)
//! describes.
//! Source: Sun Yat-sen University, Computer Graphics, assignment 2, and a published report (2022); see `docs/sources.md`.
//!
//! Symptom: the function of edge ab, which belongs to the corner opposite, weighs corner a, and so on round:
//! every value wanders to another corner and colours break at shared edges. Coverage is that of
//! [`super::sysu_inclusive`].

use super::scene::{Colour, Image, SIDE, Setting, Version, either, empty};
use super::sysu_inclusive::{SysuInclusive, front, lerp, samples};
use super::{DrawResult, Fragments, Published, RealTriangle, Spans, bare};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Fragment;

#[derive(Clone, Copy, Debug)]
pub struct SysuWeights;

impl Published for SysuWeights {
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult {
        SysuInclusive.cover(triangle, bounds, emit)
    }

    fn fragments(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: Fragments<'_>,
    ) -> DrawResult {
        let triangle = front(triangle)?;
        samples(&triangle, bounds, &mut |s| {
            let (depth, varying) = lerp(&triangle, s.edges.map_array(|f| f as f32 * s.inverse));
            emit(Fragment { x_px: s.x_px, y_px: s.y_px, depth, varying });
        })
    }
}

/// A triangle with a red, a green and a blue corner, or one of a single colour.
pub fn draw(version: Version, setting: Setting) -> Image {
    let mut image = empty(SIDE);
    let (corners, colours) = match setting {
        Setting::Exposing => {
            let colours = [[1.0, 0.1, 0.1], [0.1, 1.0, 0.1], [0.2, 0.3, 1.0]];
            ([[2.5, 28.5], [29.5, 24.5], [13.5, 2.5]], colours)
        }
        Setting::Harmless => ([[3.5, 5.5], [10.5, 12.75], [12.75, 5.25]], [[0.5; 3]; 3]),
    };
    let mut triangle = bare(corners);
    // Two channels at a time.
    for channels in [[0, 1], [2, 2]] {
        for (v, colour) in triangle.iter_mut().zip(colours) {
            v.varying = channels.map_array(|k| colour[k]).into();
        }
        either(&SysuWeights, version, &triangle, image.bounds(), &mut |f| {
            let pixel: &mut Colour = &mut image.span_mut(f.y_px, f.x_px, f.x_px + 1)[0];
            for (k, value) in channels.into_iter().zip(f.varying.to_array()) {
                // 16 shades: what f32 rounds is no difference to see.
                pixel[k] = ((value * 15.0).round() * 17.0).clamp(0.0, 255.0) as u8;
            }
        });
    }
    image
}
