//! Frames in tiles: a scene drawn 64 x 64 pixels at a time, each tile by one thread, without locks.
//!
//! Pieces are put into the bins of the tiles they touch, in parts of the scene (`bins`), and each tile
//! reads the parts in order. Each tile owns its colours and depths, asks the tile engine for exact
//! coverage of what is not hidden, and computes values sixteen pixels at a time from planes in
//! f32 whose errors are bounded (`planes`). What a pixel gets depends on the pieces before it in the
//! scene alone, so neither threads nor instruction sets leave a trace: operations are those that
//! IEEE 754 rounds in one way, and none is fused.
//!
//! It is the fast way, not the exact one: coverage is that of the other engines, values lie within
//! their bound of the exact ones, and so two surfaces nearer to each other than that may come out in
//! either order. What is not opaque or physical, and a scene with shadows as a whole, it hands to an exact engine
//! ([`Division`]). It does not plan, and of antialiasing it has four samples a pixel, shaded once.

mod bins;
mod buffer;
pub mod planes;
mod samples;
mod shade;
mod shared;
mod visible;

use std::fmt;

use fearless_simd::Simd;
use fearless_simd::prelude::*;
use rayon::prelude::*;

use crate::coverage::{CELL_PX, CoverList, Piece, Tiles};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Corners;
use rasterproof_render::effects::geometry::{Outline, Whole};
use rasterproof_render::effects::primitive::BadScene;
use rasterproof_render::effects::{self, Effect};
use rasterproof_render::pipeline::multisample;
use rasterproof_render::pipeline::target::Colour;
use rasterproof_render::pipeline::texture::Texture;
use rasterproof_render::scene::{Item, Scene};

use bins::{Bins, Placed, Tiling, reached};
pub use buffer::SIDE_PX;
use buffer::{Buffer, PAIR_PX, load_colours, store_colours};
use glam::DVec2;
use planes::{Depth, Planes, shares};
use rasterproof_render::pipeline::footprint::{Footprint, Reading};
use samples::{Masks, PLACES};
use shade::{Brush, Foggy};
pub use shared::{Division, DrawExactly, HandedOver};
use visible::{CELL, PAIR, VisibilityPass, VisibleBlock};

/// How many samples a pixel has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Samples {
    One,
    /// Four at [`multisample::SAMPLES`], shaded once for each triangle.
    Four,
}

/// Why tiles alone draw no picture of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TilesError {
    Scene(BadScene),
    /// So many triangles are [`not_drawn`].
    NotDrawn(usize),
}

impl From<BadScene> for TilesError {
    fn from(bad: BadScene) -> Self {
        Self::Scene(bad)
    }
}

impl fmt::Display for TilesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(bad) => write!(f, "{bad}"),
            Self::NotDrawn(triangles) => write!(
                f,
                "{triangles} triangles are not opaque, physical or in a scene with shadows, which tiles do not draw; \
                 a `Division` hands them to an exact engine"
            ),
        }
    }
}

impl std::error::Error for TilesError {}

/// Triangles of materials that are not opaque or physical, and in a scene with shadows all: they would be drawn opaque, matt and in
/// the light.
#[must_use]
pub fn not_drawn(scene: &Scene) -> usize {
    let is_not_drawn = |item: &&Item| {
        is_seen_through(item) || asks_for_others(scene, item) || scene.shadows.is_some()
    };
    let items = scene.items.iter().filter(is_not_drawn);
    items.map(|item| item.mesh.triangles.len()).sum()
}

fn is_seen_through(item: &Item) -> bool {
    item.material.opacity.is_some()
}

/// The effects of fragments that tiles have, beside light and texture.
const EFFECTS: [Effect; 4] = [Effect::Specular, Effect::MipMaps, Effect::Anisotropy, Effect::Fog];

/// Whether an item has a physical surface, or asks for an effect that tiles do not have, as a new one is.
fn asks_for_others(scene: &Scene, item: &Item) -> bool {
    item.material.physical.is_some() || asks_beyond(&EFFECTS, scene, item)
}

fn asks_beyond(known: &[Effect], scene: &Scene, item: &Item) -> bool {
    effects::asked_for(scene, item).iter().any(|effect| !known.contains(effect))
}

/// Triangles, or parts of them that the window shows, with an attribute beyond [`planes::MOST_ATTRIBUTE`]. Their planes
/// may overflow in f32, so they are for another engine.
pub fn beyond_f32(scene: &Scene, width: u32, height: u32) -> Result<usize, BadScene> {
    Ok(beyond_f32_by_item(scene, width, height)?.into_iter().sum())
}

/// As [`beyond_f32`], counted for each item.
fn beyond_f32_by_item(scene: &Scene, width: u32, height: u32) -> Result<Vec<usize>, BadScene> {
    let whole = Whole::new(scene, PixelRect::window(width, height))?;
    let fits = |value: f64| value.abs() <= planes::MOST_ATTRIBUTE;
    let mut counts = vec![0; scene.items.len()];
    for run in whole.runs(1 << 16) {
        whole.outlines(&run, &mut |outline| {
            let all_fit = whole.surface(&outline).values.iter().flatten().all(|&value| fits(value));
            counts[run.0] += usize::from(!all_fit);
        });
    }
    Ok(counts)
}

/// Draws a scene into a picture of its own, on the threads of the pool that it is called in.
///
/// # Errors
/// [`TilesError`] before anything is drawn.
///
/// # Panics
/// If a side exceeds what a frame can have.
pub fn render(
    scene: &Scene,
    width: u32,
    height: u32,
    samples: Samples,
) -> Result<Frame<Colour>, TilesError> {
    render_in(Tiles::default(), scene, width, height, samples)
}

/// As [`render`], in an instruction set.
pub fn render_in(
    engine: Tiles,
    scene: &Scene,
    width: u32,
    height: u32,
    samples: Samples,
) -> Result<Frame<Colour>, TilesError> {
    // Zeros come from the machine when they are first touched, by the thread that draws there.
    let mut picture = Frame::new(PixelRect::window(width, height), [0; 4]);
    render_into(engine, scene, &mut picture, samples)?;
    Ok(picture)
}

/// As [`render_in`], over a picture that is kept: every pixel is written, none is read.
///
/// # Panics
/// If the picture does not begin at column 0 and row 0.
pub fn render_into(
    engine: Tiles,
    scene: &Scene,
    picture: &mut Frame<Colour>,
    samples: Samples,
) -> Result<(), TilesError> {
    let window = picture.bounds();
    assert!(window.x0 == 0 && window.y0 == 0, "a picture that begins at {window:?}");
    match not_drawn(scene) {
        0 => {}
        triangles => return Err(TilesError::NotDrawn(triangles)),
    }
    let planes = match samples {
        Samples::One => 1,
        Samples::Four => multisample::SAMPLES.len(),
    };
    Ok(draw_into(engine, scene, picture, planes)?)
}

/// Draws a scene of which tiles draw everything, with one sample a pixel or four.
fn draw_into(
    engine: Tiles,
    scene: &Scene,
    picture: &mut Frame<Colour>,
    planes: usize,
) -> Result<(), BadScene> {
    let window = picture.bounds();
    let (whole, bins) = frame(scene, window, planes)?;
    if window.is_empty() {
        return Ok(());
    }
    let (pitch, height) = (picture.pitch(), window.height() as usize);
    let lines = &mut picture.tail_mut(0, 0)[..pitch * height];
    lines.par_chunks_mut(pitch * SIDE_PX as usize).enumerate().for_each(|(band, lines)| {
        let canvases = canvases(&bins.tiles, band, lines, pitch);
        canvases.into_par_iter().for_each_init(
            || Drawing::new(&whole, &bins, engine, planes),
            |drawing, canvas| drawing.draw_into(canvas),
        );
    });
    Ok(())
}

/// A scene in the window, and its pieces by tiles, for so many samples a pixel.
fn frame(scene: &Scene, window: PixelRect, planes: usize) -> Result<(Whole<'_>, Bins), BadScene> {
    let whole = Whole::new(scene, window)?;
    // From the centre to the farthest sample, 6/16 px.
    let reach = if planes > 1 { 6 * SUBPIXELS / 16 } else { 0 };
    let bins = Bins::new(&whole, Tiling::new(window, reach));
    Ok((whole, bins))
}

/// A tile's part of the picture, which nobody else has.
struct Canvas<'a> {
    tile: usize,
    lines: Vec<&'a mut [Colour]>,
}

/// The tiles of a band, a row of tiles, whose lines are given.
fn canvases<'a>(
    tiles: &Tiling,
    band: usize,
    lines: &'a mut [Colour],
    pitch: usize,
) -> Vec<Canvas<'a>> {
    let numbers = band * tiles.across..(band + 1) * tiles.across;
    let canvas = |tile| Canvas { tile, lines: Vec::with_capacity(SIDE_PX as usize) };
    let width = |tile| tiles.rect(tile).width() as usize;
    let mut canvases: Vec<_> = numbers.map(|tile| (width(tile), canvas(tile))).collect();
    for mut line in lines.chunks_mut(pitch) {
        for (width, canvas) in &mut canvases {
            let (part, rest) = line.split_at_mut(*width);
            canvas.lines.push(part);
            line = rest;
        }
    }
    canvases.into_iter().map(|(_, canvas)| canvas).collect()
}

/// Pieces that are looked at together: the tile engine sets them up in one go.
const BATCH: usize = 64;

/// The pieces of a tile on their way into it.
struct Drawing<'a> {
    whole: &'a Whole<'a>,
    bins: &'a Bins,
    engine: Tiles,
    buffer: Buffer,
    /// Those that were not hidden when they were looked at.
    batch: Vec<&'a Outline>,
    /// Where these are asked for.
    corners: Vec<Corners>,
    /// The piece that is drawn, as a place in the batch.
    last: u32,
    of_centres: Centres<'a>,
    of_samples: OfSamples<'a>,
}

/// Of one sample a pixel: first numbers are drawn, then colours.
struct Centres<'a> {
    pass: VisibilityPass,
    /// What the piece covers, where it is not tiny.
    masks: Masks<1>,
    /// What was drawn, by their numbers less 1.
    drawn: Vec<&'a Outline>,
    visible: Vec<VisibleBlock>,
}

/// Of four samples a pixel: what the piece covers, and how it looks.
struct OfSamples<'a> {
    masks: Masks<PLACES>,
    /// Nothing before the first piece.
    brush: Option<(Brush<'a>, Option<Depth>)>,
}

impl<'a> Drawing<'a> {
    fn new(whole: &'a Whole<'a>, bins: &'a Bins, engine: Tiles, planes: usize) -> Self {
        let pass = VisibilityPass { number: 0, depth: None };
        Self {
            whole,
            bins,
            engine,
            buffer: Buffer::new(planes),
            batch: Vec::with_capacity(BATCH),
            corners: Vec::with_capacity(BATCH * PLACES),
            last: u32::MAX,
            of_centres: Centres {
                pass,
                masks: Masks::new(),
                drawn: Vec::new(),
                visible: Vec::new(),
            },
            of_samples: OfSamples { masks: Masks::new(), brush: None },
        }
    }

    fn draw_into(&mut self, canvas: Canvas<'_>) {
        dispatch!(self.engine.level(), simd => {
            self.tile(simd, canvas.tile);
            for (y, line) in (0..).zip(canvas.lines) {
                self.buffer.resolve(y, line);
            }
        });
    }

    /// Draws a tile, and leaves its colours and depths in the buffer.
    fn draw(&mut self, tile: usize) {
        dispatch!(self.engine.level(), simd => self.tile(simd, tile));
    }

    #[inline(always)]
    fn tile<S: Simd>(&mut self, simd: S, tile: usize) {
        let bins = self.bins;
        self.buffer.clear(bins.tiles.rect(tile), self.whole.background());
        for Placed { outline, touched } in bins.of(tile) {
            let blocks = self.buffer.blocks(*touched);
            if self.whole.depth_test && self.buffer.hides(simd, &blocks, outline.nearest) {
                continue;
            }
            self.buffer.draws(&blocks);
            self.batch.push(outline);
            if self.batch.len() == BATCH {
                self.draw_batch();
            }
        }
        self.draw_batch();
        self.colour(simd);
    }

    fn draw_batch(&mut self) {
        let (engine, tile) = (self.engine, self.buffer.rect);
        let mut corners = std::mem::take(&mut self.corners);
        let of_batch = self.batch.iter().map(|outline| outline.corners);
        if self.buffer.planes.len() == 1 {
            corners.extend(of_batch);
            engine.cover_list(&corners, tile, &mut |run| {
                dispatch!(engine.level(), simd => self.centres(simd, run));
            });
        } else {
            corners.extend(of_batch.flat_map(samples::places));
            engine.cover_list(&corners, tile, &mut |run| {
                dispatch!(engine.level(), simd => self.samples(simd, run));
            });
            dispatch!(engine.level(), simd => self.finish(simd));
        }
        corners.clear();
        self.corners = corners;
        self.batch.clear();
        self.last = u32::MAX;
    }

    /// Draws the numbers of pieces at the centres of pixels.
    #[inline(always)]
    fn centres<S: Simd>(&mut self, simd: S, run: &[Piece]) {
        for (i, covered) in run.iter().enumerate() {
            if covered.triangle() != self.last {
                self.finish_centres(simd);
                self.last = covered.triangle();
                let outline = self.batch[self.last as usize];
                self.of_centres.drawn.push(outline);
                let number = self.of_centres.drawn.len() as u32;
                self.of_centres.pass = VisibilityPass { number, depth: self.depth(outline) };
            }
            let Centres { pass, masks, visible, .. } = &mut self.of_centres;
            let PixelRect { x0, y0, .. } = self.buffer.rect;
            match covered {
                Piece::Cell(cell) => {
                    let (at, mask) = ([cell.x_px - x0, cell.y_px - y0], u32::from(cell.pixels));
                    pass.pixels::<S, CELL_PX>(simd, at, mask, &mut self.buffer, visible);
                }
                Piece::Quarter(quarter) => {
                    let (at, rows) =
                        ([quarter.x_px - x0, quarter.y_px - y0], quarter.pixels.to_le_bytes());
                    pass.rows(simd, at, &rows, &mut self.buffer, visible);
                }
                // The only piece of its triangle here.
                Piece::Tile(tile)
                    if run.get(i + 1).is_none_or(|next| next.triangle() != self.last)
                        && masks.is_empty() =>
                {
                    let at = [tile.x_px - x0, tile.y_px - y0];
                    pass.rows(simd, at, &tile.rows, &mut self.buffer, visible);
                }
                Piece::Tile(_) | Piece::Block(_) => masks.add(covered, 0, self.buffer.rect),
            }
        }
        self.finish_centres(simd);
    }

    /// Draws the number of a piece where it was collected.
    #[inline(always)]
    fn finish_centres<S: Simd>(&mut self, simd: S) {
        let Centres { pass, masks, visible, .. } = &mut self.of_centres;
        let (first, rows) = masks.used();
        if !rows.is_empty() {
            let at = [0, first as i32];
            pass.rows(simd, at, rows.as_flattened(), &mut self.buffer, visible);
            masks.clear();
        }
    }

    /// Colours what shows a number still.
    #[inline(always)]
    fn colour<S: Simd>(&mut self, simd: S) {
        let visible = std::mem::take(&mut self.of_centres.visible);
        let (mut last, mut brush) = (0, None);
        let [x0, y0] = [self.buffer.rect.x0, self.buffer.rect.y0];
        for &VisibleBlock { number, left, top, is_cell } in &visible {
            let (left, top) = (i32::from(left), i32::from(top));
            let plane = &mut self.buffer.planes[0].colours;
            let before = if is_cell {
                load_colours::<S, CELL_PX>(simd, plane, left, top)
            } else {
                load_colours::<S, PAIR_PX>(simd, plane, left, top)
            };
            let seen = before.simd_eq(number);
            let mask = seen.to_bitmask() as u32;
            if mask == 0 {
                continue;
            }
            if number != last {
                last = number;
                let outline = self.of_centres.drawn[number as usize - 1];
                brush = Some(self.brush(simd, outline));
            }
            let Some(brush) = &brush else { continue };
            let place = if is_cell { &CELL } else { &PAIR };
            let colours = brush.block_colours(simd, place, [x0 + left, y0 + top], mask);
            let (plane, after) = (&mut self.buffer.planes[0].colours, seen.select(colours, before));
            if is_cell {
                store_colours::<S, CELL_PX>(after, plane, left, top);
            } else {
                store_colours::<S, PAIR_PX>(after, plane, left, top);
            }
        }
        self.of_centres.visible = visible;
        self.of_centres.visible.clear();
        self.of_centres.drawn.clear();
    }

    /// Collects pieces at the samples, and draws each triangle when the next one comes.
    #[inline(always)]
    fn samples<S: Simd>(&mut self, simd: S, run: &[Piece]) {
        for covered in run {
            let (number, place) =
                (covered.triangle() / PLACES as u32, covered.triangle() as usize % PLACES);
            if number != self.last {
                self.finish(simd);
                self.last = number;
                let outline = self.batch[number as usize];
                self.of_samples.brush = Some((self.brush(simd, outline), self.depth(outline)));
            }
            self.of_samples.masks.add(covered, place, self.buffer.rect);
        }
    }

    /// Draws what has been collected.
    #[inline(always)]
    fn finish<S: Simd>(&mut self, simd: S) {
        let OfSamples { masks, brush } = &mut self.of_samples;
        if let Some((brush, depth)) = brush.take() {
            brush.samples(simd, depth.as_ref(), masks, &mut self.buffer);
            masks.clear();
        }
    }

    /// The depth of a piece, where it is tested.
    #[inline(always)]
    fn depth(&self, outline: &Outline) -> Option<Depth> {
        let shown = reached(&outline.corners, self.whole.window);
        self.whole.depth_test.then(|| Depth::of(&outline.corners, outline.depths, shown))
    }

    /// How a piece looks. Its planes begin at the first pixel of its box in the window, not of a tile,
    /// so that tiles leave no trace.
    #[inline(always)]
    fn brush<S: Simd>(&self, simd: S, outline: &Outline) -> Brush<'a> {
        let surface = self.whole.surface(outline);
        let shown = reached(&outline.corners, self.whole.window);
        let affine = self.whole.affine();
        let planes = Planes::of(simd, &surface.corners, &surface.values, shown, affine);
        let fog = surface.material.veil.as_ref().map(|veil| Foggy {
            veil,
            share: veil.between(outline.depths),
            depth: Depth::of(&outline.corners, outline.depths, shown),
        });
        let read_around = surface
            .material
            .texture
            .filter(|texture| texture.has_mip_map() || texture.anisotropy > 1);
        let reading = read_around.and_then(|texture| {
            let inv_w = shares(&surface.corners, affine);
            let uv = surface.values.map(|values| DVec2::new(values[6], values[7]));
            let footprint = Footprint::new(outline.corners, inv_w, uv, texture.size());
            // What is magnified is read once, at level 0.
            let reading = Reading { footprint, at_levels: true, is_anisotropic: true };
            (!footprint.is_magnified(inv_w, uv)).then_some(reading)
        });
        let texels = surface.material.texture.and_then(Texture::nearest_bytes);
        Brush { material: surface.material, planes, fog, texels, reading }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_render::scene::chapters;

    /// Each effect that tiles have occurs in a scene, which they would hand over if they had one effect less.
    #[test]
    fn an_effect_that_tiles_do_not_have_is_handed_over() {
        let names = ["highlights", "mip-maps", "anisotropy", "fog"];
        for (effect, name) in EFFECTS.into_iter().zip(names) {
            let scene = chapters::scene(name, 1.5, 0.1).unwrap();
            let others: Vec<_> = EFFECTS.into_iter().filter(|other| *other != effect).collect();
            let is_handed_over =
                |known: &[Effect]| scene.items.iter().any(|item| asks_beyond(known, &scene, item));
            assert!(!is_handed_over(&EFFECTS) && is_handed_over(&others), "{name}");
        }
    }
}
