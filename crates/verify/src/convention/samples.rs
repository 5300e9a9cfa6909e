//! Four samples a pixel, of which so many have to be covered: supersampling whose picture is cut to
//! yes and no.

use super::half_planes;
use super::place::{Emit, Place, Points, around};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;

rasterproof_core::named! {
    /// How four samples lie about their middle.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
    pub enum Pattern {
        /// Each is a quarter of a pixel from the middle along both axes.
        Square = "two by two",
        /// The four standard positions of Vulkan and Direct3D.
        Rotated = "each in a row and column of its own",
    }
}

impl Pattern {
    /// Where the samples lie, in subpixels from the middle.
    pub(super) fn offsets(self) -> [[i32; 2]; 4] {
        match self {
            Self::Square => [[-64, -64], [64, -64], [-64, 64], [64, 64]],
            Self::Rotated => [[-32, -96], [96, -32], [-96, 32], [32, 96]],
        }
    }
}

/// As [`super::shape::Shape::trace`]: at least `least` of the four samples about [x, y].
pub(super) fn trace(
    points: &Points,
    [x, y]: [i32; 2],
    (pattern, least): (Pattern, u8),
    window: PixelRect,
    emit: Emit<'_>,
) -> bool {
    // Samples lie up to a pixel and a half from the pixel's corner.
    let rect = around(points, 3).intersect(&window);
    if rect.x0 >= rect.x1 || rect.y0 >= rect.y1 {
        return true;
    }
    let mut places: Frame<[Option<Place>; 4]> = Frame::new(rect, [None; 4]);
    for (sample, [dx, dy]) in pattern.offsets().into_iter().enumerate() {
        half_planes::at(x + dx, y + dy).trace(points, rect, &mut |px, py, place| {
            places.span_mut(py, px, px + 1)[0][sample] = Some(place);
        });
    }
    for (y_px, row) in places.rows() {
        for (x_px, of_pixel) in (rect.x0..).zip(row) {
            if let Some(place) = judged(of_pixel, least) {
                emit(x_px, y_px, place);
            }
        }
    }
    true
}

/// Where a pixel lies by its samples; nothing where it is outside, however ties are decided.
fn judged(samples: &[Option<Place>; 4], least: u8) -> Option<Place> {
    let inside = samples.iter().flatten().filter(|place| **place == Place::In).count() as u8;
    if inside >= least {
        return Some(Place::In);
    }
    let tied = samples.iter().flatten().filter(|place| **place != Place::In);
    let tied: Vec<Place> = tied.copied().collect();
    let needed = least - inside;
    if (tied.len() as u8) < needed {
        return None;
    }
    // All on one edge: it owns all of them or none.
    if tied.iter().all(|place| *place == tied[0]) {
        return Some(tied[0]);
    }
    let mut ties = [0; 4];
    for (bits, place) in ties.iter_mut().zip(tied) {
        *bits = match place {
            Place::Edge(facing) => 1 << facing,
            Place::Corner(bits) => bits,
            _ => 0,
        };
    }
    Some(Place::Several { needed, ties })
}
