//! Frames in tiles: a scene drawn 64 x 64 pixels at a time, each tile by one thread, without locks.
//!
//! Pieces are put into the bins of the tiles they touch. Each tile owns its colours and depths, asks
//! the tile engine for exact coverage, and computes values sixteen pixels at a time from planes in
//! f32 whose errors are bounded (`planes`). What a pixel gets depends on the pieces before it in the
//! scene alone, so neither threads nor instruction sets leave a trace: operations are those that
//! IEEE 754 rounds in one way, and none is fused.
//!
//! It is the fast way, not the exact one: coverage is that of the other engines, values lie within
//! their bound of the exact ones, and so two surfaces nearer to each other than that may come out in
//! either order. It does not antialias and it does not plan.

mod buffer;
pub mod planes;
mod shade;

use fearless_simd::dispatch;
use rayon::prelude::*;

use crate::effects::piece::{BadScene, Piece};
use crate::effects::whole::{self, Skin, Whole};
use crate::frame::Frame;
use crate::grid::{PixelRect, SUBPIXEL_BITS};
use crate::pipeline::target::Colour;
use crate::scene::Scene;
use crate::tile::{CoverList, Tiles};
use crate::triangle::Corners;

use buffer::Buffer;
pub use buffer::SIDE_PX;
use planes::Planes;

/// Draws a scene into a picture of its own, on the threads of the pool that it is called in.
///
/// # Errors
/// [`BadScene`] before anything is drawn.
///
/// # Panics
/// If a side exceeds what a frame can have.
pub fn render(scene: &Scene, width: u32, height: u32) -> Result<Frame<Colour>, BadScene> {
    render_in(Tiles::default(), scene, width, height)
}

/// As [`render`], in an instruction set.
///
/// # Errors
/// As [`render`].
pub fn render_in(
    engine: Tiles,
    scene: &Scene,
    width: u32,
    height: u32,
) -> Result<Frame<Colour>, BadScene> {
    let window = PixelRect::window(width, height);
    let whole = whole::assemble(scene, window)?;
    let bins = Bins::new(&whole, window);
    let background = u32::from_le_bytes(scene.background);
    let tiles: Vec<Buffer> = bins
        .lists
        .par_iter()
        .enumerate()
        .map(|(number, list)| {
            let mut buffer = Buffer::new(bins.rect(number), background);
            draw(engine, &whole, list, scene, &mut buffer);
            buffer
        })
        .collect();
    let mut picture = Frame::new(window, scene.background);
    for tile in &tiles {
        for y_px in tile.rect.y0..tile.rect.y1 {
            let row = picture.span_mut(y_px, tile.rect.x0, tile.rect.x1);
            for (pixel, colour) in row.iter_mut().zip(tile.row(y_px)) {
                *pixel = colour.to_le_bytes();
            }
        }
    }
    Ok(picture)
}

/// Which pieces touch which tile, in their order.
struct Bins {
    window: PixelRect,
    /// Tiles in a row.
    across: i32,
    lists: Vec<Vec<u32>>,
}

impl Bins {
    fn new(whole: &Whole<'_>, window: PixelRect) -> Self {
        let tiles = |side: u32| (side as i32 + SIDE_PX - 1) / SIDE_PX;
        let (across, down) = (tiles(window.width()), tiles(window.height()));
        let mut lists = vec![Vec::new(); (across * down) as usize];
        for (number, (_, piece)) in whole.pieces.iter().enumerate() {
            let touched = pixel_box(&piece.corners(), window);
            if touched.is_empty() {
                continue;
            }
            for y in touched.y0 / SIDE_PX..=(touched.y1 - 1) / SIDE_PX {
                for x in touched.x0 / SIDE_PX..=(touched.x1 - 1) / SIDE_PX {
                    lists[(y * across + x) as usize].push(number as u32);
                }
            }
        }
        Self { window, across, lists }
    }

    fn rect(&self, number: usize) -> PixelRect {
        let (x, y) = (number as i32 % self.across, number as i32 / self.across);
        let (x0, y0) = (x * SIDE_PX, y * SIDE_PX);
        PixelRect { x0, y0, x1: x0 + SIDE_PX, y1: y0 + SIDE_PX }.intersect(&self.window)
    }
}

/// The pixels of a window that a triangle may touch: those that its box reaches into.
fn pixel_box([a, b, c]: &Corners, window: PixelRect) -> PixelRect {
    let low = |a: i32, b: i32, c: i32| a.min(b).min(c) >> SUBPIXEL_BITS;
    let high = |a: i32, b: i32, c: i32| (a.max(b).max(c) >> SUBPIXEL_BITS) + 1;
    PixelRect {
        x0: low(a.x, b.x, c.x),
        y0: low(a.y, b.y, c.y),
        x1: high(a.x, b.x, c.x),
        y1: high(a.y, b.y, c.y),
    }
    .intersect(&window)
}

/// The planes of a piece, from the first pixel of its box in the window: not of a tile, so that
/// tiles leave no trace.
#[must_use]
fn planes_of(piece: &Piece, skin: &Skin<'_>, window: PixelRect, affine: bool) -> Planes<8> {
    let [a, b, c] = &piece.vertices;
    let values = [&a.varying.0, &b.varying.0, &c.varying.0];
    // Colour, normal, texture coordinates.
    let used = if skin.colours { 0b0000_0111 } else { 0 }
        | if skin.light.is_some() { 0b0011_1000 } else { 0 }
        | if skin.texture.is_some() { 0b1100_0000 } else { 0 };
    Planes::of(piece, values, pixel_box(&piece.corners(), window), affine, used)
}

/// Draws the pieces of a tile.
fn draw(engine: Tiles, whole: &Whole<'_>, list: &[u32], scene: &Scene, buffer: &mut Buffer) {
    let corners: Vec<Corners> =
        list.iter().map(|&number| whole.pieces[number as usize].1.corners()).collect();
    let mut last = u32::MAX;
    let mut drawn = None;
    engine.cover_list(&corners, buffer.rect, &mut |pieces| {
        for covered in pieces {
            if covered.triangle() != last {
                last = covered.triangle();
                let (item, piece) = &whole.pieces[list[last as usize] as usize];
                let skin = &whole.skins[*item];
                drawn = Some((skin, planes_of(piece, skin, whole.window, scene.affine)));
            }
            let Some((skin, planes)) = &drawn else { continue };
            let depth_test = whole.depth_test;
            dispatch!(engine.level(), simd => {
                shade::piece(simd, covered, skin, planes, depth_test, buffer)
            });
        }
    });
}
