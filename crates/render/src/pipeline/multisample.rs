//! Four samples a pixel at the standard positions: which of them a triangle covers.
//!
//! Rasterizers ask at pixel centres only. A triangle moved so that a sample falls on the centre has
//! at the centres the coverage of the samples, exactly: the positions are multiples of 1/16 px and
//! the lattice has 1/256 px. `tests/data/vulkan-msaa.*` records what two Vulkan drivers cover.

use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, ScreenTriangle, Varying};

/// Where the samples of pixel (0, 0) lie, in 1/16 px; bit s of a mask is sample s.
pub const SAMPLES: [(i32, i32); 4] = [(6, 2), (14, 6), (2, 10), (10, 14)];

/// The point moved so that a sample falls on the centre. Nothing where that leaves the lattice.
#[must_use]
#[inline]
pub fn onto_centre(point: SubpixelPoint, (x_16th, y_16th): (i32, i32)) -> Option<SubpixelPoint> {
    let move_by = |sample_16th: i32| HALF_PIXEL - sample_16th * (SUBPIXELS / 16);
    Some(SubpixelPoint::new(
        point.x.checked_add(move_by(x_16th))?,
        point.y.checked_add(move_by(y_16th))?,
    ))
}

/// The piece moved so that a sample falls on the centre. Nothing where that leaves the lattice.
#[must_use]
#[inline]
pub fn moved<V: Varying>(
    piece: &ScreenTriangle<V>,
    sample: (i32, i32),
) -> Option<ScreenTriangle<V>> {
    let mut moved = *piece;
    for vertex in &mut moved.vertices {
        vertex.position = onto_centre(vertex.position, sample)?;
    }
    Some(moved)
}

/// For each pixel of `bounds` the samples that a triangle covers, bit s for sample s. Nothing where
/// a corner lies within half a pixel of the domain's end.
#[must_use]
pub fn masks<E: Rasterize>(engine: &E, corners: Corners, bounds: PixelRect) -> Option<Frame<u8>> {
    masks_at(engine, corners, bounds, &SAMPLES)
}

/// The same for at most eight samples at other places, in 1/16 px.
#[must_use]
pub fn masks_at<E: Rasterize>(
    engine: &E,
    corners: Corners,
    bounds: PixelRect,
    samples: &[(i32, i32)],
) -> Option<Frame<u8>> {
    let mut masks = Frame::new(bounds, 0u8);
    for (bit, &sample) in samples.iter().enumerate() {
        let [a, b, c] = corners.map(|corner| onto_centre(corner, sample));
        engine.cover([a?, b?, c?], bounds, |span| {
            for mask in masks.span_mut(span.y_px, span.x0_px, span.x1_px) {
                *mask |= 1 << bit;
            }
        });
    }
    Some(masks)
}
