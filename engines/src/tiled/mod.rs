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
//! either order. It does not plan, and of antialiasing it has four samples a pixel, shaded once.

mod buffer;
pub mod planes;
mod samples;
mod shade;

use fearless_simd::{Simd, dispatch};
use rayon::prelude::*;

use crate::effects::piece::{BadScene, Piece};
use crate::effects::whole::{self, Skin, Whole};
use crate::frame::Frame;
use crate::grid::{PixelRect, SUBPIXEL_BITS};
use crate::pipeline::multisample;
use crate::pipeline::target::Colour;
use crate::scene::Scene;
use crate::tile::{self, CoverList, Tiles};
use crate::triangle::Corners;

use buffer::Buffer;
pub use buffer::SIDE_PX;
use planes::Planes;
use samples::{Masks, PLACES};
use shade::Brush;

/// How many samples a pixel has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Samples {
    /// One, at the centre.
    One,
    /// Four at [`multisample::SAMPLES`], shaded once for each triangle.
    Four,
}

/// Draws a scene into a picture of its own, on the threads of the pool that it is called in.
///
/// # Errors
/// [`BadScene`] before anything is drawn.
///
/// # Panics
/// If a side exceeds what a frame can have.
pub fn render(
    scene: &Scene,
    width: u32,
    height: u32,
    samples: Samples,
) -> Result<Frame<Colour>, BadScene> {
    render_in(Tiles::default(), scene, width, height, samples)
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
    samples: Samples,
) -> Result<Frame<Colour>, BadScene> {
    let window = PixelRect::window(width, height);
    let whole = whole::assemble(scene, window)?;
    let bins = Bins::new(&whole, window);
    let background = u32::from_le_bytes(scene.background);
    let affine = scene.affine;
    let planes = if samples == Samples::One { 1 } else { multisample::SAMPLES.len() };
    let mut picture = Frame::new(window, scene.background);
    let pitch = picture.pitch();
    // Each row of tiles is a part of the picture that nobody else has.
    picture.tail_mut(0, 0).par_chunks_mut(pitch * SIDE_PX as usize).enumerate().for_each_init(
        || Buffer::new(planes),
        |buffer, (row, pixels)| {
            for number in bins.row(row) {
                let rect = bins.rect(number);
                buffer.clear(rect, background);
                let mut drawing = Drawing::new(&whole, &bins.lists[number], affine, buffer);
                drawing.draw(engine, samples);
                for (y, line) in pixels.chunks_mut(pitch).take(rect.height() as usize).enumerate() {
                    buffer.resolve(y as i32, &mut line[rect.x0 as usize..rect.x1 as usize]);
                }
            }
        },
    );
    Ok(picture)
}

/// Which pieces touch which tile, in their order.
struct Bins {
    window: PixelRect,
    /// Tiles in a row.
    across: usize,
    lists: Vec<Vec<Place>>,
}

/// The part that a piece is in, and where there.
type Place = [u32; 2];

impl Bins {
    fn new(whole: &Whole<'_>, window: PixelRect) -> Self {
        let tiles = |side: u32| (side as i32 + SIDE_PX - 1) / SIDE_PX;
        let (across, down) = (tiles(window.width()), tiles(window.height()));
        let mut lists = vec![Vec::new(); (across * down) as usize];
        for (part, pieces) in whole.parts.iter().enumerate() {
            for (number, (_, piece)) in pieces.iter().enumerate() {
                let touched = pixel_box(&piece.corners(), window);
                if touched.is_empty() {
                    continue;
                }
                for y in touched.y0 / SIDE_PX..=(touched.y1 - 1) / SIDE_PX {
                    for x in touched.x0 / SIDE_PX..=(touched.x1 - 1) / SIDE_PX {
                        lists[(y * across + x) as usize].push([part as u32, number as u32]);
                    }
                }
            }
        }
        Self { window, across: across as usize, lists }
    }

    /// The tiles of a row of them.
    fn row(&self, row: usize) -> std::ops::Range<usize> {
        row * self.across..((row + 1) * self.across).min(self.lists.len())
    }

    fn rect(&self, number: usize) -> PixelRect {
        let (x, y) = ((number % self.across) as i32, (number / self.across) as i32);
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

/// The pieces of a tile on their way into it.
struct Drawing<'a> {
    whole: &'a Whole<'a>,
    list: &'a [Place],
    affine: bool,
    buffer: &'a mut Buffer,
    /// The piece that is drawn, as a place in the list.
    last: u32,
    /// Nothing while it is hidden.
    brush: Option<Brush<'a>>,
    masks: Masks,
}

impl<'a> Drawing<'a> {
    fn new(whole: &'a Whole<'a>, list: &'a [Place], affine: bool, buffer: &'a mut Buffer) -> Self {
        Self { whole, list, affine, buffer, last: u32::MAX, brush: None, masks: Masks::new() }
    }

    fn draw(&mut self, engine: Tiles, samples: Samples) {
        let (whole, tile) = (self.whole, self.buffer.rect);
        let corners = self.list.iter().map(|&place| whole.at(place).1.corners());
        if samples == Samples::One {
            let corners: Vec<Corners> = corners.collect();
            engine.cover_list(&corners, tile, &mut |run| {
                dispatch!(engine.level(), simd => self.centres(simd, run));
            });
        } else {
            let corners: Vec<Corners> = corners.flat_map(samples::places).collect();
            engine.cover_list(&corners, tile, &mut |run| {
                dispatch!(engine.level(), simd => self.samples(simd, run));
            });
            dispatch!(engine.level(), simd => self.finish(simd));
        }
    }

    /// Draws pieces at the centres of pixels.
    #[inline(always)]
    fn centres<S: Simd>(&mut self, simd: S, run: &[tile::Piece]) {
        for covered in run {
            if covered.triangle() != self.last {
                self.begin(covered.triangle());
            }
            if let Some(brush) = &self.brush {
                brush.piece(simd, covered, self.buffer);
            }
        }
    }

    /// Collects pieces at the samples, and draws each triangle when the next one comes.
    #[inline(always)]
    fn samples<S: Simd>(&mut self, simd: S, run: &[tile::Piece]) {
        for covered in run {
            let (number, place) =
                (covered.triangle() / PLACES as u32, covered.triangle() as usize % PLACES);
            if number != self.last {
                self.finish(simd);
                self.begin(number);
            }
            if self.brush.is_some() {
                self.masks.add(covered, place, self.buffer.rect);
            }
        }
    }

    /// Draws what has been collected.
    #[inline(always)]
    fn finish<S: Simd>(&mut self, simd: S) {
        if let Some(brush) = &self.brush {
            brush.samples(simd, &self.masks, self.buffer);
            self.masks.clear();
        }
    }

    /// Prepares the next piece of the list.
    #[inline(always)]
    fn begin(&mut self, at: u32) {
        self.last = at;
        let (item, piece) = self.whole.at(self.list[at as usize]);
        let skin = &self.whole.skins[*item];
        let (window, depth_test) = (self.whole.window, self.whole.depth_test);
        let planes = planes_of(piece, skin, window, self.affine, depth_test, self.buffer);
        self.brush = planes.map(|planes| Brush { skin, planes, depth_test });
    }
}

/// The planes of a piece, from the first pixel of its box in the window: not of a tile, so that
/// tiles leave no trace. Nothing where all of it lies behind what a tile shows already.
#[inline(always)]
fn planes_of(
    piece: &Piece,
    skin: &Skin<'_>,
    window: PixelRect,
    affine: bool,
    depth_test: bool,
    buffer: &mut Buffer,
) -> Option<Planes<8>> {
    let [a, b, c] = &piece.vertices;
    let values = [&a.varying.0, &b.varying.0, &c.varying.0];
    // Colour, normal, texture coordinates.
    let used = if skin.colours { 0b0000_0111 } else { 0 }
        | if skin.light.is_some() { 0b0011_1000 } else { 0 }
        | if skin.texture.is_some() { 0b1100_0000 } else { 0 };
    let shown = pixel_box(&piece.corners(), window);
    let mut hidden = |nearest| depth_test && buffer.hides(shown, nearest);
    Planes::of(piece, values, shown, affine, used, &mut hidden)
}
