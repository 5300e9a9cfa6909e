//! Samples on demand: a pixel has one colour until something needs its samples apart.
//!
//! A triangle that gives one colour to a pixel whose samples it covers all changes the pixel as a
//! whole if it is nearer than everything in it, or not at all if it is behind everything in it.
//! Which of the two, or neither, is asked of intervals that contain every depth the rasterizer may
//! compute there. The pixels at its border, and those where intervals overlap, are told apart:
//! their samples are drawn as they would have been all along, first what was there, then the
//! triangle. Rasterizers only crop to their bounds, so redrawing a block gives the bits of the
//! whole.
//!
//! Supersampled pixels have one colour where the triangle has. Multisampled ones are shaded once for
//! each triangle anyway, so there every triangle gives one colour to the pixels in its inside.

pub(super) mod depths;
pub(super) mod pattern;
mod per_sample;
mod pixel;
mod sample_masks;

use std::ops::Range;

use self::depths::DepthPlane;
use self::pattern::{Pattern, PixelRow, scaled};
use self::pixel::{EMPTY, Interval, Meeting, Pixel, Pool, State, meet};
use self::sample_masks::SampleMask;
use super::plan::{PiecePlan, Samples};
use super::primitive::{Piece, bare, touched};
use crate::pipeline::Counters;
use crate::pipeline::fill::{FragmentStage, Way, fill, shade};
use crate::pipeline::shade::Attributes;
use crate::pipeline::target::{Colour, Target};
use rasterproof_core::contract::{Interpolate, RUN};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{ScreenTriangle, Varying};

/// A piece as far as depth goes.
type DepthPiece = ScreenTriangle<Attributes<0>>;

/// Adjacent pixels of one row.
#[derive(Clone, Copy)]
struct Run {
    y_px: i32,
    x0_px: i32,
    x1_px: i32,
}

/// The pixels of a frame, each whole or told apart.
pub(super) struct OnDemand {
    policy: Samples,
    pattern: Pattern,
    background: Colour,
    /// Of pixels that are whole, or background.
    colours: Frame<Colour>,
    states: Frame<State>,
    /// Of pixels in which something was drawn; the others are [`EMPTY`], whatever stands here.
    intervals: Frame<Interval>,
    /// Pixels that were in parts or apart at any time.
    was_apart: Frame<bool>,
    /// Pieces that pixels are of, whole or in part.
    pieces: Vec<DepthPiece>,
    pool: Pool,
    /// Covered columns of the piece at hand, for each row of samples in each plane.
    rows: Vec<(i32, i32)>,
    /// Pixels whose samples the piece at hand needs apart.
    runs: Vec<Run>,
}

impl OnDemand {
    /// The pixels of an empty frame, by a policy.
    pub(super) fn new(target: &mut Target, background: Colour, policy: Samples) -> Self {
        let (pattern, size) = (Pattern::of(target.antialias()), target.size());
        Self {
            policy,
            pattern,
            background,
            colours: Frame::new(size, background),
            states: Frame::new(size, State::Background),
            intervals: target.take_intervals(),
            was_apart: Frame::new(size, false),
            pieces: Vec::new(),
            pool: Pool::default(),
            rows: vec![(0, 0); target.bounds().height() as usize * pattern.planes],
            runs: Vec::new(),
        }
    }

    /// Draws a piece, which is there with the attributes that it reads, too; how many fragments are visible. A piece of one colour
    /// gives it to pixels that are whole; else each of them is shaded.
    pub(super) fn draw<V: Varying>(
        &mut self,
        engine: &impl Interpolate,
        (piece, packed, plan): (&Piece, &ScreenTriangle<V>, PiecePlan),
        (colour, stage): (Option<Colour>, &mut dyn FragmentStage<V>),
        way: Way,
        target: &mut Target,
        counters: &mut Counters,
    ) -> u64 {
        let rect = touched(&piece.corners(), target.antialias());
        // Supersampled attributes that vary leave no pixel whole, whatever an edited plan says.
        let is_apart = colour.is_none() && self.pattern.planes == 1;
        if is_apart || self.policy.tells_apart(rect, plan, self.pattern.planes) {
            if !self.tell_box_apart(engine, piece, way.depth_test, target, counters) {
                return 0;
            }
            return fill(engine, packed, target, target.bounds(), way, stage, counters);
        }
        let plane = way.depth_test.then(|| DepthPlane::new(piece, self.pattern));
        let met = self.meet(engine, piece, plane.as_ref(), colour, target, counters);
        let runs = std::mem::take(&mut self.runs);
        self.tell_apart(engine, &runs, target, counters);
        let mut visible = 0;
        for run in &runs {
            let block = scaled(run.rect(), self.pattern.scale);
            visible += fill(engine, packed, target, block, way, stage, counters);
        }
        self.runs = runs;
        let Some(state) = met.filter(|_| colour.is_none()) else { return visible };
        let (Self { states, colours, .. }, mut shaded) = (self, 0);
        engine.runs(packed, target.bounds(), way.affine, &mut |run| {
            let (y_px, x0_px, x1_px) = (run.y_px, run.x0_px, run.x1_px());
            let mut wanted = 0;
            for (i, other) in states.span_mut(y_px, x0_px, x1_px).iter().enumerate() {
                wanted |= u32::from(*other == state) << i;
            }
            if wanted != 0 {
                shaded += u64::from(wanted.count_ones());
                shade(
                    (run.values, run.depths),
                    wanted,
                    stage,
                    colours.span_mut(y_px, x0_px, x1_px),
                );
            }
        });
        counters.fragments += shaded;
        counters.shaded += shaded;
        visible + shaded
    }

    /// Decides what becomes of each pixel that the piece touches, drawn at the depths of a plane or
    /// over what is there. Those that are of the piece as a whole, or in parts where it has one
    /// colour, are drawn; those that it needs apart are in `runs`. Returns the state of the pixels
    /// that are whole; nothing where there are none.
    fn meet(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        plane: Option<&DepthPlane>,
        colour: Option<Colour>,
        target: &Target,
        counters: &mut Counters,
    ) -> Option<State> {
        self.runs.clear();
        let rows = self.covered_rows(engine, piece, target)?;
        let format = target.format;
        let serial = self.pieces.len() as u32;
        let whole = State::Whole(serial);
        let (mut is_whole, mut is_part) = (false, false);
        let Self { pattern, colours, states, intervals, was_apart, pool, runs, .. } = self;
        for y_px in rows {
            let samples = pattern.rows_of(&self.rows, y_px);
            let Some(PixelRow { touched, inner }) = pattern.pixel_row(samples) else { continue };
            let mut first_apart = None;
            let states = states.span_mut(y_px, touched.0, touched.1).iter_mut();
            let colours = colours.span_mut(y_px, touched.0, touched.1);
            let intervals = intervals.span_mut(y_px, touched.0, touched.1);
            let pixels = states.zip(colours).zip(intervals);
            for (x_px, ((state, own_colour), interval)) in (touched.0..).zip(pixels) {
                let keys = plane.map(|plane| plane.keys(x_px, y_px, format));
                let covered = (inner.0..inner.1).contains(&x_px);
                if *state == State::Background {
                    *interval = EMPTY;
                }
                let before = Pixel { colour: *own_colour, state: *state, interval: *interval };
                match meet(interval, covered, keys) {
                    Meeting::Hidden => {}
                    Meeting::Whole => {
                        is_whole = true;
                        if let State::Parts(index) = *state {
                            pool.spare.push(index);
                        }
                        *state = whole;
                        *own_colour = colour.unwrap_or(*own_colour);
                    }
                    Meeting::Apart => {
                        let part = colour.filter(|_| pattern.has_masks()).map(|colour| {
                            let [nearest, farthest] = keys.unwrap_or_default();
                            let samples = pattern.mask(samples, x_px);
                            SampleMask { serial: Some(serial), samples, colour, nearest, farthest }
                        });
                        let index =
                            part.and_then(|part| before.draw(part, plane.is_some(), pool, pattern));
                        let Some(index) = index else {
                            first_apart.get_or_insert(x_px);
                            continue;
                        };
                        is_part = true;
                        *interval = pool.parts[index as usize].range();
                        *state = State::Parts(index);
                        let was_apart = &mut was_apart.span_mut(y_px, x_px, x_px + 1)[0];
                        counters.expanded += u64::from(!*was_apart);
                        *was_apart = true;
                    }
                }
                if let Some(x0_px) = first_apart.take() {
                    runs.push(Run { y_px, x0_px, x1_px: x_px });
                }
            }
            if let Some(x0_px) = first_apart {
                runs.push(Run { y_px, x0_px, x1_px: touched.1 });
            }
        }
        if is_whole || is_part {
            self.pieces.push(bare(piece));
        }
        is_whole.then_some(whole)
    }

    /// Notes the columns that the piece covers in each row of samples; the rows of pixels touched.
    fn covered_rows(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &Target,
    ) -> Option<Range<i32>> {
        let bounds = target.bounds();
        let Pattern { scale, planes } = self.pattern;
        // Whole rows of pixels, so that no row of an earlier piece is left in one.
        let rect = touched(&piece.corners(), target.antialias()).intersect(&target.size());
        let (first, end) = (rect.y0, rect.y1);
        if rect.is_empty() {
            return None;
        }
        let per_row = scale as usize * planes;
        self.rows[first as usize * per_row..end as usize * per_row].fill((0, 0));
        for i in 0..planes {
            let Some(moved) = self.pattern.moved(piece, i) else { continue };
            let rows = &mut self.rows;
            engine.cover(moved.corners(), bounds, |span| {
                rows[span.y_px as usize * planes + i] = (span.x0_px, span.x1_px);
            });
        }
        Some(first..end)
    }

    /// Whether a pixel's samples were told apart at any time.
    pub(super) fn was_apart(&self, x_px: i32, y_px: i32) -> bool {
        self.was_apart.get(x_px, y_px) == Some(true)
    }

    /// The picture: whole pixels as they are, the others as the mean of their samples.
    pub(super) fn resolve(&self, target: &Target) -> Frame<Colour> {
        let mut picture = self.colours.clone();
        let mut sums = Vec::new();
        for (y_px, states) in self.states.rows() {
            let (was_apart, pixels) = (self.was_apart.row(y_px), picture.row_mut(y_px));
            let mut x = 0;
            while x < states.len() {
                // Most of a picture is whole.
                if was_apart[x..].first_chunk() == Some(&[false; RUN]) {
                    x += RUN;
                    continue;
                }
                match states[x] {
                    State::Background | State::Whole(_) => x += 1,
                    State::Parts(index) => {
                        pixels[x] = self.pool.parts[index as usize].mean();
                        x += 1;
                    }
                    State::Apart => {
                        let alike = states[x..].iter().take_while(|s| **s == State::Apart).count();
                        target.resolve_run(y_px, x as i32, &mut pixels[x..][..alike], &mut sums);
                        x += alike;
                    }
                }
            }
        }
        picture
    }

    /// Gives back what the next frame can use.
    pub(super) fn finish(self, target: &mut Target) {
        target.keep_intervals(self.intervals);
    }
}

impl Run {
    fn rect(self) -> PixelRect {
        let Self { y_px, x0_px, x1_px } = self;
        PixelRect { x0: x0_px, y0: y_px, x1: x1_px, y1: y_px + 1 }
    }
}
