//! What a scene calls for: the conditions under which an effect may be left out, and the report of
//! what was decided and why.
//!
//! - **Clip plane**: no corner of the triangle lies outside of it (outcodes). The clipper would
//!   return the triangle as it is.
//! - **Perspective**: the three 1/w are bit-equal. Then the weights are exactly those of affine
//!   interpolation, see [`crate::contract::Interpolate::affine_fragments`].
//! - **Wide words**: 32 bits hold the edge functions of the triangle, which its bounding box says
//!   ([`crate::raster::edge_function::WordWidth`]).
//! - **Depth test**: no other piece has a bounding box that meets this one's (two pieces on either
//!   side of an edge they share meet nowhere, by the fill rule). Then nothing is in front of it,
//!   and it is in front of nothing. The clear value is farther than every depth.
//! - **Colour, light, texture**: the material does not use it; the factor left out is exactly 1.
//! - **Interpolation**: the attribute has the same bits at the three corners. The rasterizers
//!   return a constant exactly, so what is computed from it once is what every fragment would get.
//! - **Depth buffer**: no piece is tested.
//! - **Samples**: the pixel lies inside the triangle with all its samples, which gives it one colour,
//!   and its depths there and those of what is there do not overlap (`samples`).
//! - **Clear**: the first piece covers all four corner pixels of a tile: what a triangle covers is
//!   convex, so it covers the tile.
//! - **Second buffer**: the picture is looked at when it is finished.

use super::render::{Piece, PiecePlan, Prepared, bit, is_lit};
use super::{Effect, Effects, Mode};
use crate::contract::Rasterize;
use crate::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SubpixelPoint};
use crate::pipeline::Counters;
use crate::pipeline::assemble::{Cull, twice_area};
use crate::pipeline::target::{Antialias, Target};
use crate::scene::{Hidden, Scene, Shading};
use crate::triangle::Corners;

/// Which pieces may hide or be hidden.
pub(super) struct Depths {
    overlaps: Vec<bool>,
}

/// Pieces whose boxes are compared as one: a piece, or two on either side of a shared edge.
struct Unit {
    pieces: std::ops::Range<usize>,
    rect: PixelRect,
}

impl Depths {
    /// Scenes with more triangles are taken to overlap: to look would cost more than it saves.
    pub(super) const MOST_TRIANGLES: usize = 2048;

    /// Comparisons for each box, on average, after which all are taken to overlap.
    const MOST_COMPARISONS: usize = 64;

    /// Compares the bounding boxes of all pieces, by a sweep along the axis where they are shorter.
    pub(super) fn of(pieces: &[(usize, Piece)], antialias: Antialias) -> Self {
        // Samples lie up to 6/16 px off the centre.
        let margin_px = i32::from(antialias == Antialias::Multisample4);
        let mut units = units(pieces, margin_px);
        let sum = |side: fn(&PixelRect) -> u32| -> u64 {
            units.iter().map(|unit| u64::from(side(&unit.rect))).sum()
        };
        if sum(PixelRect::height) < sum(PixelRect::width) {
            for Unit { rect: PixelRect { x0, y0, x1, y1 }, .. } in &mut units {
                std::mem::swap(x0, y0);
                std::mem::swap(x1, y1);
            }
        }
        units.sort_unstable_by_key(|unit| unit.rect.x0);
        let mut overlaps = vec![false; pieces.len()];
        let mut comparisons = 0;
        for (i, unit) in units.iter().enumerate() {
            let meets = units[i + 1..].iter().take_while(|other| other.rect.x0 < unit.rect.x1);
            for other in meets {
                comparisons += 1;
                if other.rect.y0 < unit.rect.y1 && unit.rect.y0 < other.rect.y1 {
                    overlaps[unit.pieces.clone()].fill(true);
                    overlaps[other.pieces.clone()].fill(true);
                }
            }
            if comparisons > Self::MOST_COMPARISONS * units.len() {
                overlaps.fill(true);
                break;
            }
        }
        Self { overlaps }
    }

    pub(super) fn overlaps(&self, piece: usize) -> bool {
        self.overlaps[piece]
    }

    pub(super) fn any(&self) -> bool {
        self.overlaps.contains(&true)
    }
}

fn units(pieces: &[(usize, Piece)], margin_px: i32) -> Vec<Unit> {
    let mut units: Vec<Unit> = Vec::with_capacity(pieces.len());
    let mut i = 0;
    while i < pieces.len() {
        let corners = pieces[i].1.corners();
        let mut rect = pixel_box(&corners, margin_px);
        let mut end = i + 1;
        if let Some(next) = pieces.get(end).map(|(_, piece)| piece.corners())
            && share_an_edge(&corners, &next)
        {
            let other = pixel_box(&next, margin_px);
            rect = PixelRect {
                x0: rect.x0.min(other.x0),
                y0: rect.y0.min(other.y0),
                x1: rect.x1.max(other.x1),
                y1: rect.y1.max(other.y1),
            };
            end += 1;
        }
        units.push(Unit { pieces: i..end, rect });
        i = end;
    }
    units
}

/// Pixels that a triangle may touch: those whose centres lie in [min, max), by the fill rule.
pub(super) fn pixel_box(corners: &Corners, margin_px: i32) -> PixelRect {
    let range = |coordinate: fn(&SubpixelPoint) -> i32| {
        let (min, max) = corners
            .iter()
            .map(coordinate)
            .fold((i32::MAX, i32::MIN), |(min, max), c| (min.min(c), max.max(c)));
        let first = |sub: i32| (i64::from(sub) + i64::from(HALF_PIXEL - 1)) >> SUBPIXEL_BITS;
        (first(min) as i32 - margin_px, first(max) as i32 + margin_px)
    };
    let ((x0, x1), (y0, y1)) = (range(|corner| corner.x), range(|corner| corner.y));
    PixelRect { x0, y0, x1, y1 }
}

/// Whether two triangles have two corners in common and the third ones on either side.
fn share_an_edge(a: &Corners, b: &Corners) -> bool {
    let [third_a, third_b] = [(a, b), (b, a)].map(|(own, other)| {
        let mut alone = own.iter().filter(|corner| !other.contains(corner));
        alone.next().filter(|_| alone.next().is_none())
    });
    let (Some(third_a), Some(third_b)) = (third_a, third_b) else { return false };
    let mut shared = a.iter().filter(|corner| *corner != third_a);
    let (Some(p), Some(q)) = (shared.next(), shared.next()) else { return false };
    let side = |r: &SubpixelPoint| twice_area([*p, *q, *r]).signum();
    side(third_a) * side(third_b) < 0
}

/// Side of the tiles whose clearing is decided together.
const TILE_PX: i32 = 32;

/// The tiles that the first piece does not cover; nothing where that is not known.
pub(super) fn tiles_to_clear(
    engine: &impl Rasterize,
    pieces: &[(usize, Piece)],
    target: &Target,
) -> Option<Vec<PixelRect>> {
    let corners = pieces.first()?.1.corners();
    let second = pieces.get(1).map(|(_, piece)| piece.corners());
    let bounds = target.bounds();
    // A small first piece covers no tile; samples off the centre are not asked for.
    let touched = pixel_box(&corners, 0);
    let large = touched.width() as i32 >= TILE_PX && touched.height() as i32 >= TILE_PX;
    if !large || target.antialias() == Antialias::Multisample4 {
        return None;
    }
    let covers = |corners: Corners, x_px: i32, y_px: i32| {
        let pixel = PixelRect { x0: x_px, y0: y_px, x1: x_px + 1, y1: y_px + 1 };
        let mut covered = false;
        engine.cover(corners, pixel, |_| covered = true);
        covered
    };
    let is_covered = |tile: PixelRect| {
        let (x1, y1) = (tile.x1 - 1, tile.y1 - 1);
        let ends = [(tile.x0, tile.y0), (x1, tile.y0), (tile.x0, y1), (x1, y1)];
        // The second piece is drawn over what the first leaves only if it shares an edge with it.
        let second = second.filter(|second| share_an_edge(&corners, second));
        [Some(corners), second]
            .into_iter()
            .flatten()
            .any(|corners| ends.iter().all(|&(x, y)| covers(corners, x, y)))
    };
    let mut tiles = Vec::new();
    for y0 in (bounds.y0..bounds.y1).step_by(TILE_PX as usize) {
        for x0 in (bounds.x0..bounds.x1).step_by(TILE_PX as usize) {
            let (x1, y1) = ((x0 + TILE_PX).min(bounds.x1), (y0 + TILE_PX).min(bounds.y1));
            let tile = PixelRect { x0, y0, x1, y1 };
            if !is_covered(tile) {
                tiles.push(tile);
            }
        }
    }
    Some(tiles)
}

/// What was decided for the pieces of one item.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pieces: u64,
    one_w: u64,
    affine: u64,
    depth: u64,
    /// Whether the engine has words of several widths, and the pieces in more than 32 bits.
    has_widths: bool,
    wide: u64,
    /// Pieces in which the attribute is carried and varies: colour, normal, texture coordinates.
    varies: [u64; 3],
}

impl Tally {
    pub(super) fn count(
        &mut self,
        piece: &Piece,
        reads: u8,
        plan: PiecePlan,
        word_bits: Option<u32>,
    ) {
        let [a, b, c] = piece.vertices.map(|vertex| vertex.inv_w);
        self.pieces += 1;
        self.one_w += u64::from(a == b && b == c);
        self.affine += u64::from(plan.affine || reads == 0);
        self.depth += u64::from(plan.depth);
        self.has_widths = word_bits.is_some();
        self.wide += u64::from(word_bits > Some(i32::BITS));
        for (count, bit) in self.varies.iter_mut().zip([bit::COLOUR, bit::NORMAL, bit::UV]) {
            *count += u64::from(plan.varies & bit != 0);
        }
    }
}

/// One line of a plan.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Decision {
    /// The effect.
    pub effect: Effect,
    /// The item it is about; of the whole frame where there is none.
    pub item: Option<usize>,
    /// Pieces that pay for it; triangles for clip, pixels for samples and the second buffer, samples
    /// for clear and the depth buffer.
    pub on: u64,
    /// Those that do without.
    pub off: u64,
    /// Why, to read.
    pub reason: String,
}

/// What a frame paid for, and why.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Plan {
    /// Of each item and of the frame.
    pub decisions: Vec<Decision>,
}

impl Plan {
    pub(super) fn new(
        scene: &Scene,
        items: &[Prepared<'_>],
        tallies: &[Tally],
        effects: &Effects,
        target: &Target,
        counters: &Counters,
    ) -> Self {
        let mut decisions = Vec::new();
        for (index, (item, tally)) in items.iter().zip(tallies).enumerate() {
            decisions.extend(item_decisions(scene, item, tally).map(|mut decision| {
                decision.item = Some(index);
                decision
            }));
        }
        decisions.extend(frame_decisions(scene, effects, target, counters));
        for decision in &mut decisions {
            match effects.mode(decision.effect) {
                Mode::Planned => {}
                Mode::Always => decision.reason = "asked for everywhere".to_owned(),
                Mode::Never => decision.reason = "switched off everywhere".to_owned(),
            }
        }
        Self { decisions }
    }
}

fn decision(effect: Effect, on: u64, off: u64, reason: impl Into<String>) -> Decision {
    Decision { effect, item: None, on, off, reason: reason.into() }
}

fn item_decisions(
    scene: &Scene,
    prepared: &Prepared<'_>,
    tally: &Tally,
) -> impl Iterator<Item = Decision> {
    let Tally { pieces, one_w, affine, depth, has_widths, wide, varies } = *tally;
    let [colours, normals, uvs] = varies;
    let item = prepared.item;
    let material = &item.material;
    let attribute = |effect, bit: u8, varies: u64, used: bool, what: &str| {
        let read = prepared.reads & bit != 0;
        let reason = match (used, varies) {
            (false, _) => format!("the material has no {what}"),
            (true, 0) => format!("{what}: one for each triangle"),
            (true, _) => format!("{what}: varies in {varies} of {pieces} pieces"),
        };
        decision(effect, if read { pieces } else { 0 }, if read { 0 } else { pieces }, reason)
    };
    let varying = colours.max(normals).max(uvs);
    let perspective = match (varying, one_w == pieces, scene.affine) {
        (_, _, true) => "the scene asks for affine interpolation".to_owned(),
        (0, ..) => "only depth varies, which is linear in the window".to_owned(),
        (_, true, _) => "w is the same at the three corners of every piece".to_owned(),
        _ => format!("w differs between corners in {} of {pieces} pieces", pieces - one_w),
    };
    let depth_reason = match (scene.hidden, depth) {
        (Hidden::Painter, _) => "the scene is drawn from back to front".to_owned(),
        (_, 0) => "no bounding box of another piece meets this item's".to_owned(),
        _ => format!("{depth} of {pieces} pieces may overlap others"),
    };
    let cull = match item.cull {
        Cull::None => "not asked for",
        Cull::Clockwise => "asked for: clockwise pieces are left out",
        Cull::CounterClockwise => "asked for: counter-clockwise pieces are left out",
    };
    let culls = if item.cull == Cull::None { 0 } else { pieces };
    let words = match (has_widths, wide) {
        (false, _) => "the engine's integers have one width".to_owned(),
        (_, 0) => "32 bits hold the edge functions of every piece".to_owned(),
        _ => format!("{wide} of {pieces} pieces are too large for 32 bits"),
    };
    let has_colour = material.vertex_colours || material.shading == Shading::Gouraud;
    let constant = format!("{varying} of {pieces} pieces have an attribute that varies");
    [
        decision(Effect::Cull, culls, pieces - culls, cull),
        decision(Effect::WideWords, wide, pieces - wide, words),
        decision(Effect::Perspective, pieces - affine, affine, perspective),
        decision(Effect::Depth, depth, pieces - depth, depth_reason),
        attribute(Effect::Colour, bit::COLOUR, colours, has_colour, "colour of the corners"),
        attribute(Effect::Light, bit::NORMAL, normals, is_lit(scene, item), "light and normal"),
        attribute(Effect::Texture, bit::UV, uvs, material.texture.is_some(), "texture"),
        decision(Effect::Interpolation, varying, pieces - varying, constant),
    ]
    .into_iter()
}

fn frame_decisions(
    scene: &Scene,
    effects: &Effects,
    target: &Target,
    counters: &Counters,
) -> impl Iterator<Item = Decision> {
    let Counters { triangles, clipped, rejected, expanded, cleared, .. } = *counters;
    let clip = match (clipped, rejected) {
        (0, 0) => "no corner lies outside the view volume".to_owned(),
        (0, _) => format!("{rejected} triangles lie outside one plane altogether; none is cut"),
        _ => format!("{clipped} of {triangles} triangles cross a plane, {rejected} lie outside"),
    };
    let clips = match effects.mode(Effect::Clip) {
        Mode::Planned => clipped,
        Mode::Always => triangles - rejected,
        Mode::Never => 0,
    };
    let pixels = target.pixel_count();
    let samples = match target.antialias() {
        Antialias::None => "a pixel has one sample".to_owned(),
        _ if expanded == 0 => "no pixel holds more than one colour".to_owned(),
        _ => format!("{expanded} of {pixels} pixels may hold more than one colour"),
    };
    let clear = match cleared {
        0 => "every tile is covered by what is drawn first",
        _ if cleared < target.sample_count() => "the rest is covered, or cleared pixel by pixel",
        _ => "nothing that is drawn first covers a tile",
    };
    let depths = match (scene.hidden, counters.depth_tests) {
        (Hidden::Painter, _) => "the scene is drawn from back to front",
        (_, 0) => "no depth is tested",
        _ => "depths are tested",
    };
    let buffer = match counters.presented {
        0 => "the picture is looked at when it is finished",
        _ => "somebody looks while it is drawn",
    };
    let of_samples = |count: u64| (count, target.sample_count().saturating_sub(count));
    let frame = |effect, (on, off), reason: &str| decision(effect, on, off, reason);
    [
        frame(Effect::Clip, (clips, triangles - clips), &clip),
        frame(Effect::DepthBuffer, of_samples(counters.depths_cleared), depths),
        frame(Effect::Samples, (expanded, pixels - expanded), &samples),
        frame(Effect::Clear, of_samples(cleared), clear),
        frame(Effect::SecondBuffer, (counters.presented, pixels - counters.presented), buffer),
    ]
    .into_iter()
}
