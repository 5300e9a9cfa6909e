//! Specimen: the bounding box of GAMES101 homework 2 as one solution walks it: never cut to the window.
//! Source: GAMES101 (Lingqi Yan, 2020), homework 2, and its published solutions; see `docs/sources.md`.
//!
//! Symptom: a pixel is found at y times width plus x in the depth and colour buffers. One beyond the right
//! border is the first of the next row, so what leaves on one side comes in on the other; one above or below
//! the window is not in the buffer at all, and other memory is overwritten. Here the buffer lies between guard
//! rows that belong to nobody and show what is written there; what goes beyond them is dropped.

use super::scene::{COLOURS, Colour, Image, SIDE, Setting, Version, empty};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;

/// Guard rows before and after the buffer.
const GUARD: i32 = 4;
/// Memory that belongs to nobody.
const FENCE: Colour = [60, 60, 76];

/// The pixel that y times width plus x names: another one, if x lies beyond the row.
pub fn lands(x_px: i32, y_px: i32, width: i32) -> (i32, i32) {
    let address = y_px * width + x_px;
    (address % width, address / width)
}

/// The memory, guard rows first: a triangle that leaves the window, or one within it.
pub fn draw(version: Version, setting: Setting) -> Image {
    let width = SIDE as i32;
    let window = PixelRect::window(SIDE, SIDE - 2 * GUARD as u32);
    let box_of_the_triangle = PixelRect { x0: 0, y0: 0, x1: 2 * width, y1: 2 * width };
    let bounds = if version == Version::Published { box_of_the_triangle } else { window };
    let corners = match setting {
        Setting::Exposing => [(12.3, 3.2), (44.6, 13.4), (18.1, 27.7)],
        Setting::Harmless => [(12.3, 3.2), (30.6, 13.4), (18.1, 22.7)],
    };
    let mut memory = empty(SIDE);
    for y in (0..GUARD).chain(width - GUARD..width) {
        memory.span_mut(y, 0, width).fill(FENCE);
    }
    let at = |(x, y)| SubpixelPoint::from_px(x, y).expect("the triangle lies in the domain");
    EdgeFunction.cover(corners.map_array(at), bounds, |span| {
        for x in span.x0_px..span.x1_px {
            let (column, row) = lands(x, span.y_px + GUARD, width);
            if row < width {
                memory.span_mut(row, column, column + 1)[0] = COLOURS[0];
            }
        }
    });
    memory
}
