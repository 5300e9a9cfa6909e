//! Pixels whose samples are apart: written into the target as drawing them would have, and drawn one
//! by one from then on.

use super::depths::Plane;
use super::parts::Part;
use super::pattern::{Pattern, scaled};
use super::pixel::{Pixel, State};
use super::{DepthPiece, OnDemand, Run};
use crate::contract::Interpolate;
use crate::effects::piece::{Piece, touched};
use crate::grid::PixelRect;
use crate::pipeline::Counters;
use crate::pipeline::depth::CLEAR;
use crate::pipeline::target::{Colour, Target};

impl OnDemand {
    /// Tells all pixels of a piece's bounding box apart, before it is drawn sample by sample; false
    /// where all of it is hidden.
    pub(super) fn tell_box_apart(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        depth: bool,
        target: &mut Target,
        counters: &mut Counters,
    ) -> bool {
        let rect = touched(&piece.corners(), target.antialias()).intersect(&target.size());
        let nearest = piece.vertices.iter().fold(1.0, |min: f64, vertex| min.min(vertex.depth));
        let nearest = if depth { target.format.key(nearest - Plane::ERROR) } else { 0 };
        let is_visible = |pixel: &Pixel| !depth || nearest < pixel.farthest;
        let mut rows = rect.y0..rect.y1;
        if rect.is_empty()
            || !rows.any(|y| self.pixels.span_mut(y, rect.x0, rect.x1).iter().any(is_visible))
        {
            return false;
        }
        for y_px in rect.y0..rect.y1 {
            self.tell_apart(engine, Run { y_px, x0_px: rect.x0, x1_px: rect.x1 }, target, counters);
            for pixel in self.pixels.span_mut(y_px, rect.x0, rect.x1) {
                pixel.nearest = pixel.nearest.min(nearest);
            }
        }
        true
    }

    /// Writes the samples of pixels that are not apart into the target, as drawing them would have.
    pub(super) fn tell_apart(
        &mut self,
        engine: &impl Interpolate,
        run: Run,
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let Self { pattern, pixels, pieces, pool, .. } = self;
        let format = target.format;
        let mut x0_px = run.x0_px;
        while x0_px < run.x1_px {
            let rest = pixels.span_mut(run.y_px, x0_px, run.x1_px);
            let Pixel { state, colour, .. } = rest[0];
            let alike = rest.iter().take_while(|pixel| pixel.state == state).count();
            let run = Run { y_px: run.y_px, x0_px, x1_px: x0_px + alike as i32 };
            x0_px = run.x1_px;
            let block = scaled(run.rect(), pattern.scale);
            match state {
                State::Apart => continue,
                State::Background => {
                    for plane in &mut target.planes {
                        for y in block.y0..block.y1 {
                            plane.depth.span_mut(y, block.x0, block.x1).fill(CLEAR);
                            plane.colour.span_mut(y, block.x0, block.x1).fill(colour);
                        }
                    }
                }
                State::Whole(serial) => {
                    let row = pixels.row(run.y_px);
                    for (i, plane) in target.planes.iter_mut().enumerate() {
                        let moved = pattern.moved(&pieces[serial as usize], i);
                        let Some(moved) = moved else { continue };
                        engine.runs(&moved, block, true, &mut |run| {
                            for (x, depth) in (run.x0_px..).zip(run.depths) {
                                let colour = row[(x / pattern.scale) as usize].colour;
                                plane.put(x, run.y_px, format.key(*depth), colour);
                            }
                        });
                    }
                }
                State::Parts(index) => {
                    for part in pool.parts[index as usize].iter() {
                        let piece = part.serial.map(|serial| &pieces[serial as usize]);
                        write_part(*pattern, engine, part, piece, block, target);
                    }
                    pool.spare.push(index);
                }
            }
            for pixel in pixels.span_mut(run.y_px, run.x0_px, run.x1_px) {
                pixel.divide(State::Apart, counters);
            }
        }
    }

    /// Tests and writes the samples of a run of pixels that are apart.
    pub(super) fn test_samples(
        &self,
        engine: &impl Interpolate,
        piece: &DepthPiece,
        run: Run,
        colour: Colour,
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let (block, format) = (scaled(run.rect(), self.pattern.scale), target.format);
        let (mut emitted, mut visible) = (0, 0);
        for (i, plane) in target.planes.iter_mut().enumerate() {
            let Some(moved) = self.pattern.moved(piece, i) else { continue };
            engine.runs(&moved, block, true, &mut |run| {
                let (x0, x1) = (run.x0_px, run.x1_px());
                let stored = plane.depth.span_mut(run.y_px, x0, x1);
                let nearer = format.test_and_write(run.depths, stored);
                emitted += run.depths.len() as u64;
                visible += u64::from(nearer.count_ones());
                for (i, drawn) in plane.colour.span_mut(run.y_px, x0, x1).iter_mut().enumerate() {
                    *drawn = if nearer >> i & 1 != 0 { colour } else { *drawn };
                }
            });
        }
        counters.fragments += emitted;
        counters.depth_tests += emitted;
        counters.depth_failed += emitted - visible;
    }

    /// Writes the covered samples of a run of pixels that are apart.
    pub(super) fn fill_samples(
        &self,
        run: Run,
        colour: Colour,
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let (block, planes) = (scaled(run.rect(), self.pattern.scale), self.pattern.planes);
        for y in block.y0..block.y1 {
            let rows = &self.rows[y as usize * planes..];
            for (plane, &(x0, x1)) in target.planes.iter_mut().zip(rows) {
                let (x0, x1) = (x0.max(block.x0), x1.min(block.x1));
                if x0 < x1 {
                    plane.colour.span_mut(y, x0, x1).fill(colour);
                    counters.fragments += u64::from(x0.abs_diff(x1));
                }
            }
        }
    }
}

/// Writes the samples of one part of a pixel, which are those in `block`, into the target.
fn write_part(
    pattern: Pattern,
    engine: &impl Interpolate,
    part: &Part,
    piece: Option<&DepthPiece>,
    block: PixelRect,
    target: &mut Target,
) {
    let format = target.format;
    for (i, plane) in target.planes.iter_mut().enumerate() {
        let mut put = |x: i32, y: i32, key: u64| {
            if part.samples & pattern.bit(x - block.x0, y - block.y0, i) != 0 {
                plane.put(x, y, key, part.colour);
            }
        };
        if let Some(piece) = piece {
            let Some(moved) = pattern.moved(piece, i) else { continue };
            engine.runs(&moved, block, true, &mut |run| {
                for (x, depth) in (run.x0_px..).zip(run.depths) {
                    put(x, run.y_px, format.key(*depth));
                }
            });
        } else {
            for y in block.y0..block.y1 {
                (block.x0..block.x1).for_each(|x| put(x, y, CLEAR));
            }
        }
    }
}
