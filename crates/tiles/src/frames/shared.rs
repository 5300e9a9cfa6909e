//! Frames of two engines: what tiles do not draw is handed to an exact engine, which draws it over what they have drawn, with
//! their colours and depths before it.
//!
//! Opaque surfaces may be drawn in any order where depths are tested, and what is seen through comes after them in every
//! engine. So tiles draw first. Their depths are in f32, so that a surface that is handed over and one that is not may come
//! out in either order where they are nearer to each other than the bound of [`super::planes`], as two of tiles may.

use rayon::prelude::*;

use super::buffer::Buffer;
use super::{Drawing, asks_for_others, beyond_f32_by_item, draw_into, frame, is_seen_through};
use crate::coverage::Tiles;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_render::effects::primitive::BadScene;
use rasterproof_render::effects::render::Rendered;
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::depth::CLEAR;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::{Hidden, Scene};

/// A scene in two parts: what tiles draw, and what an exact engine draws over it.
#[derive(Clone, Debug)]
pub struct Division {
    pub tiles: Scene,
    pub exact: Scene,
    pub handed_over: HandedOver,
}

/// Triangles of the items that tiles do not draw, by the reason: the first that holds for an item. Where triangles are drawn
/// from back to front, a reason that holds for one item holds for all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HandedOver {
    /// All triangles of a scene with shadows.
    pub in_shadows: usize,
    /// Of materials that are not opaque.
    pub not_opaque: usize,
    /// Of physical materials, and of items that ask for another effect that tiles do not have.
    pub other_effects: usize,
    /// Of items with a value beyond [`super::planes::MOST_ATTRIBUTE`].
    pub beyond_f32: usize,
}

impl HandedOver {
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.in_shadows + self.not_opaque + self.other_effects + self.beyond_f32
    }
}

/// How an exact engine draws a scene with these effects into a target.
pub type DrawExactly<'a> =
    &'a mut dyn FnMut(&Scene, &Effects, &mut Target) -> Result<Rendered, BadScene>;

impl Division {
    /// Puts each item into one of the parts, by its material and by the values that it has in a window of this size.
    ///
    /// # Errors
    /// [`BadScene`].
    pub fn new(scene: &Scene, width: u32, height: u32) -> Result<Self, BadScene> {
        let beyond = beyond_f32_by_item(scene, width, height)?;
        // From back to front, what lies over what is the order of drawing, so one engine draws all.
        let is_sorted = scene.hidden == Hidden::Painter;
        let is_any_seen_through = is_sorted && scene.items.iter().any(is_seen_through);
        let is_any_other = is_sorted && scene.items.iter().any(|item| asks_for_others(scene, item));
        let is_any_beyond = is_sorted && beyond.iter().any(|count| *count > 0);
        let mut handed_over = HandedOver::default();
        let (mut tiles, mut exact) = (Vec::new(), Vec::new());
        for (item, beyond) in scene.items.iter().zip(beyond) {
            let reason = if scene.shadows.is_some() {
                &mut handed_over.in_shadows
            } else if is_any_seen_through || is_seen_through(item) {
                &mut handed_over.not_opaque
            } else if is_any_other || asks_for_others(scene, item) {
                &mut handed_over.other_effects
            } else if is_any_beyond || beyond > 0 {
                &mut handed_over.beyond_f32
            } else {
                tiles.push(item.clone());
                continue;
            };
            *reason += item.mesh.triangles.len();
            exact.push(item.clone());
        }
        let with = |items| Scene { items, ..scene.clone() };
        Ok(Self { tiles: with(tiles), exact: with(exact), handed_over })
    }

    /// Draws both parts into a target, and what both look like into a picture. Where an exact engine draws nothing, the
    /// target stays as it was.
    ///
    /// # Errors
    /// [`BadScene`] before anything is drawn.
    ///
    /// # Panics
    /// If the target is supersampled.
    pub fn render(
        &self,
        tiles: Tiles,
        target: &mut Target,
        exact: DrawExactly<'_>,
    ) -> Result<Frame<Colour>, BadScene> {
        let (size, samples) = (target.size(), target.planes.len());
        let is_supersampled = matches!(target.antialias(), Antialias::Supersample(_));
        assert!(!is_supersampled, "tiles draw no supersampled picture");
        if self.exact.items.is_empty() {
            let mut picture = Frame::new(size, [0; 4]);
            draw_into(tiles, &self.tiles, &mut picture, samples)?;
            return Ok(picture);
        }
        if self.tiles.items.is_empty() {
            return Ok(exact(&self.exact, &Effects::PLANNED, target)?.picture);
        }
        draw_planes(tiles, &self.tiles, target)?;
        let over = Effects::PLANNED
            .with(Effect::Clear, Mode::Never)
            .with(Effect::DepthBuffer, Mode::Never)
            .with(Effect::Depth, Mode::Always);
        Ok(exact(&self.exact, &over, target)?.picture)
    }
}

/// The colours and depths of a tile, for each sample of its pixels, row by row.
struct TilePixels {
    rect: PixelRect,
    samples: Vec<(Vec<Colour>, Vec<f32>)>,
}

impl TilePixels {
    fn of(buffer: &Buffer) -> Self {
        let rect = buffer.rect;
        let (width, height) = (rect.width() as usize, rect.height() as i32);
        let samples = buffer.planes.iter().map(|plane| {
            let colour = |colour: &u32| buffer.seen(*colour).to_le_bytes();
            let colours = |y| plane.colours.row(y)[..width].iter().map(colour);
            let depths = |y| plane.depths.row(y)[..width].iter().copied();
            ((0..height).flat_map(colours).collect(), (0..height).flat_map(depths).collect())
        });
        Self { rect, samples: samples.collect() }
    }
}

/// Draws a scene of which tiles draw everything into every pixel of a target.
fn draw_planes(tiles: Tiles, scene: &Scene, target: &mut Target) -> Result<(), BadScene> {
    let samples = target.planes.len();
    let (whole, bins) = frame(scene, target.size(), samples)?;
    let pixels: Vec<TilePixels> = (0..bins.tiles.count())
        .into_par_iter()
        .map_init(
            || Drawing::new(&whole, &bins, tiles, samples),
            |drawing, tile| {
                drawing.draw(tile);
                TilePixels::of(&drawing.buffer)
            },
        )
        .collect();
    let format = target.format;
    let key = |depth: &f32| if depth.is_finite() { format.key((*depth).into()) } else { CLEAR };
    for TilePixels { rect, samples } in &pixels {
        for ((colours, depths), plane) in samples.iter().zip(&mut target.planes) {
            let rows =
                colours.chunks(rect.width() as usize).zip(depths.chunks(rect.width() as usize));
            for (y, (colours, depths)) in (rect.y0..).zip(rows) {
                plane.colour.span_mut(y, rect.x0, rect.x1).copy_from_slice(colours);
                let keys = plane.depth.span_mut(y, rect.x0, rect.x1);
                keys.iter_mut().zip(depths).for_each(|(to, depth)| *to = key(depth));
            }
        }
    }
    Ok(())
}
