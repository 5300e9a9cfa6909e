//! Pixels whose samples are told apart: these are written into the target as drawing them would have, and stay there.

use super::depths::DepthPlane;
use super::pattern::{Pattern, scaled};
use super::pixel::{EMPTY, Interval, State};
use super::sample_masks::SampleMask;
use super::{DepthPiece, OnDemand, Run};
use crate::effects::primitive::{Piece, touched};
use crate::pipeline::Counters;
use crate::pipeline::depth::CLEAR;
use crate::pipeline::target::{Colour, Target};
use rasterproof_core::contract::Interpolate;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;

impl OnDemand {
    /// Tells all pixels of a piece's bounding box apart, before it is drawn sample by sample; false
    /// where all of it is hidden.
    pub(in crate::effects) fn tell_box_apart(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        depth: bool,
        target: &mut Target,
        counters: &mut Counters,
    ) -> bool {
        let rect = touched(&piece.corners(), target.antialias()).intersect(&target.size());
        let nearest = piece.vertices.iter().fold(1.0, |min: f64, vertex| min.min(vertex.depth));
        let nearest = if depth { target.format.key(nearest - DepthPlane::ERROR) } else { 0 };
        let is_visible = |(state, interval): (&State, &Interval)| {
            !depth || *state == State::Background || nearest < interval[1]
        };
        let mut rows = rect.y0..rect.y1;
        if rect.is_empty()
            || !rows.any(|y| {
                let states = self.states.span_mut(y, rect.x0, rect.x1).iter();
                let intervals = self.intervals.span_mut(y, rect.x0, rect.x1).iter();
                states.zip(intervals).any(is_visible)
            })
        {
            return false;
        }
        self.runs.clear();
        for y_px in rect.y0..rect.y1 {
            self.runs.push(Run { y_px, x0_px: rect.x0, x1_px: rect.x1 });
            let states = self.states.span_mut(y_px, rect.x0, rect.x1).iter();
            for (state, interval) in states.zip(self.intervals.span_mut(y_px, rect.x0, rect.x1)) {
                if *state == State::Background {
                    *interval = EMPTY;
                }
                interval[0] = interval[0].min(nearest);
            }
        }
        let runs = std::mem::take(&mut self.runs);
        self.tell_apart(engine, &runs, target, counters);
        self.runs = runs;
        true
    }

    /// Writes the samples of pixels that are not apart into the target, as drawing them would have.
    pub(super) fn tell_apart(
        &mut self,
        engine: &impl Interpolate,
        runs: &[Run],
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let Self { pattern, colours, states, was_apart, pieces, pool, background, .. } = self;
        for &Run { y_px, mut x0_px, x1_px } in runs {
            while x0_px < x1_px {
                let rest = states.span_mut(y_px, x0_px, x1_px);
                let state = rest[0];
                let alike = rest.iter().take_while(|other| **other == state).count();
                let run = Run { y_px, x0_px, x1_px: x0_px + alike as i32 };
                x0_px = run.x1_px;
                let block = scaled(run.rect(), pattern.scale);
                match state {
                    State::Apart => continue,
                    State::Background => {
                        for plane in &mut target.planes {
                            for y in block.y0..block.y1 {
                                plane.depth.span_mut(y, block.x0, block.x1).fill(CLEAR);
                                plane.colour.span_mut(y, block.x0, block.x1).fill(*background);
                            }
                        }
                    }
                    State::Whole(serial) => {
                        let piece = &pieces[serial as usize];
                        write_whole(*pattern, engine, piece, block, colours, target);
                    }
                    State::Parts(index) => {
                        for part in pool.parts[index as usize].iter() {
                            let piece = part.serial.map(|serial| &pieces[serial as usize]);
                            write_part(*pattern, engine, part, piece, block, target);
                        }
                        pool.spare.push(index);
                    }
                }
                divide(states, was_apart, run, counters);
            }
        }
    }
}

/// Notes that pixels are apart, and counts those that have not been in parts or apart before.
fn divide(
    states: &mut Frame<State>,
    was_apart: &mut Frame<bool>,
    Run { y_px, x0_px, x1_px }: Run,
    counters: &mut Counters,
) {
    states.span_mut(y_px, x0_px, x1_px).fill(State::Apart);
    let was_apart = was_apart.span_mut(y_px, x0_px, x1_px);
    counters.expanded += was_apart.iter().map(|was| u64::from(!was)).sum::<u64>();
    was_apart.fill(true);
}

/// Writes the samples in `block` of pixels that are whole and of this piece into the target.
fn write_whole(
    pattern: Pattern,
    engine: &impl Interpolate,
    piece: &DepthPiece,
    block: PixelRect,
    colours: &Frame<Colour>,
    target: &mut Target,
) {
    let format = target.format;
    for (i, plane) in target.planes.iter_mut().enumerate() {
        let Some(moved) = pattern.moved(piece, i) else { continue };
        engine.runs(&moved, block, true, &mut |run| {
            let colours = colours.row(run.y_px / pattern.scale);
            for (x, depth) in (run.x0_px..).zip(run.depths) {
                let colour = colours[(x / pattern.scale) as usize];
                plane.put(x, run.y_px, format.key(*depth), colour);
            }
        });
    }
}

/// Writes the samples of one part of a pixel, which are those in `block`, into the target.
fn write_part(
    pattern: Pattern,
    engine: &impl Interpolate,
    part: &SampleMask,
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
