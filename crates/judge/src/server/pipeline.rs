//! What an engine of the registry answers about depth order and the near plane: the book's stages
//! around it, a depth buffer and the clipper of the pipeline.

use std::collections::BTreeMap;

use glam::{DVec2, DVec4};
use rasterproof_host::limits::{self, REQUEST_FRAGMENTS};

use crate::judged::push;
use rasterproof_core::contract::{Interpolate as _, Rasterize as _};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, Span};
use rasterproof_registry::engines::Engine;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::clip::{ClipPlane, clip};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::near_plane::ClipCorner;

/// The number of pixels that a triangle covers, or nothing where it is more than `most`.
///
/// The oracle looks at every pixel of the window, so a large window is counted in bands of rows, and no band is counted
/// once the answer is known.
pub(super) fn covered_at_most(
    engine: Engine,
    corners: Corners,
    window: PixelRect,
    most: u64,
) -> Option<u64> {
    /// Rows of a band: few enough that a window of any width is counted soon.
    const BAND_PX: i32 = 64;
    let mut pixels = 0;
    for y0 in (window.y0..window.y1).step_by(BAND_PX as usize) {
        let band = PixelRect { y0, y1: window.y1.min(y0 + BAND_PX), ..window };
        let mut count = |span: Span| pixels += u64::from(span.x0_px.abs_diff(span.x1_px));
        engine.cover(corners, band, &mut count);
        if pixels > most {
            return None;
        }
    }
    Some(pixels)
}

/// Runs of pixels with the number of the triangle that is nearest; of equal depths the first drawn.
///
/// # Errors
/// The triangles have more fragments than are kept.
pub(crate) fn seen(
    engine: Engine,
    list: &[Triangle],
    window: PixelRect,
) -> Result<Vec<(Span, u8)>, String> {
    let mut pixels = 0;
    for triangle in list {
        let left = limits::REQUEST_FRAGMENTS - pixels;
        let Some(covered) = covered_at_most(engine, triangle.corners(), window, left) else {
            return Err(format!(
                "more than {REQUEST_FRAGMENTS} fragments, which is the most of a request: ask for a smaller window"
            ));
        };
        pixels += covered;
    }
    // A depth buffer that holds only the pixels that are drawn, in the order of rows.
    let mut buffer: BTreeMap<(i32, i32), (f64, u8)> = BTreeMap::new();
    for (number, triangle) in (0..).zip(list) {
        engine.fragments(triangle, window, |f| {
            let nearest = buffer.entry((f.y_px, f.x_px)).or_insert((f.depth, number));
            if f.depth < nearest.0 {
                *nearest = (f.depth, number);
            }
        });
    }
    let mut runs = Vec::new();
    buffer.into_iter().for_each(|((y, x), (_, number))| push(&mut runs, x, y, number));
    Ok(runs)
}

/// The corners that the clipper of the pipeline leaves, with the attribute in the first of two places.
pub(crate) fn clipped(corners: [ClipCorner; 3]) -> Vec<ClipCorner> {
    let vertex = |[x, y, z, w, a]: ClipCorner| ClipVertex {
        position: DVec4::new(x, y, z, w),
        varying: DVec2::new(a, 0.0),
    };
    let (polygon, _) = clip(&corners.map(vertex), ClipPlane::Near.bit());
    let corner = |v: &ClipVertex<DVec2>| {
        let [x, y, z, w] = v.position.to_array();
        [x, y, z, w, v.varying.x]
    };
    polygon.vertices().map(corner).collect()
}
