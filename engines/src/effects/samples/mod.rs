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

mod apart;
pub(super) mod depths;
mod parts;
pub(super) mod pattern;
mod pixel;

use std::ops::Range;

use self::depths::Plane;
use self::parts::Part;
use self::pattern::{Pattern, PixelRow};
use self::pixel::{Meeting, Pixel, Pool, State};
use super::piece::{Piece, pack, touched};
use super::plan::{PiecePlan, Samples};
use crate::contract::{Interpolate, RUN};
use crate::frame::Frame;
use crate::grid::PixelRect;
use crate::pipeline::Counters;
use crate::pipeline::depth::CLEAR;
use crate::pipeline::fill::{Stage, Way, each, fill, shade};
use crate::pipeline::shade::Attributes;
use crate::pipeline::target::{Colour, Target};
use crate::triangle::{ScreenTriangle, Varying};

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
    pixels: Frame<Pixel>,
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
    pub(super) fn new(target: &Target, background: Colour, policy: Samples) -> Self {
        let pattern = Pattern::of(target.antialias());
        let pixel = Pixel {
            colour: background,
            state: State::Background,
            was_apart: false,
            nearest: CLEAR,
            farthest: CLEAR,
        };
        Self {
            policy,
            pattern,
            pixels: Frame::new(target.size(), pixel),
            pieces: Vec::new(),
            pool: Pool::default(),
            rows: vec![(0, 0); target.bounds().height() as usize * pattern.planes],
            runs: Vec::new(),
        }
    }

    /// Draws a piece of one colour.
    pub(super) fn draw_flat(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        plan: PiecePlan,
        colour: Colour,
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let depth = plan.depth;
        let rect = touched(&piece.corners(), target.antialias());
        if self.policy.tells_apart(rect, plan, self.pattern.planes) {
            if self.tell_box_apart(engine, piece, depth, target, counters) {
                let (bounds, way) = (target.bounds(), Way { affine: true, depth_test: true });
                let (piece, stage) = (pack::<0, 0>(piece), each(|_| colour));
                fill(engine, &piece, target, bounds, way, &stage, counters);
            }
            return;
        }
        let plane = depth.then(|| Plane::new(piece, self.pattern));
        self.meet(engine, piece, plane.as_ref(), Some(colour), target, counters);
        let runs = std::mem::take(&mut self.runs);
        for &run in &runs {
            self.tell_apart(engine, run, target, counters);
            if depth {
                self.test_samples(engine, &pack::<0, 0>(piece), run, colour, target, counters);
            } else {
                self.fill_samples(run, colour, target, counters);
            }
        }
        self.runs = runs;
    }

    /// Draws a piece whose attributes vary; `packed` is the same with those it reads.
    #[expect(clippy::too_many_arguments, reason = "those of `fill`, and the piece")]
    pub(super) fn draw_varying<V: Varying>(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        packed: &ScreenTriangle<V>,
        target: &mut Target,
        plan: PiecePlan,
        stage: &Stage<'_, V>,
        counters: &mut Counters,
    ) {
        let way = Way { affine: !plan.perspective, depth_test: plan.depth };
        let rect = touched(&piece.corners(), target.antialias());
        // Supersampled attributes that vary leave no pixel whole, whatever an edited plan says.
        if self.pattern.planes == 1 || self.policy.tells_apart(rect, plan, self.pattern.planes) {
            if self.tell_box_apart(engine, piece, way.depth_test, target, counters) {
                fill(engine, packed, target, target.bounds(), way, stage, counters);
            }
            return;
        }
        let plane = way.depth_test.then(|| Plane::new(piece, self.pattern));
        let met = self.meet(engine, piece, plane.as_ref(), None, target, counters);
        let runs = std::mem::take(&mut self.runs);
        for &run in &runs {
            self.tell_apart(engine, run, target, counters);
            fill(engine, packed, target, run.rect(), way, stage, counters);
        }
        self.runs = runs;
        let Some(state) = met else { return };
        let (pixels, mut shaded) = (&mut self.pixels, 0);
        engine.runs(packed, target.bounds(), way.affine, &mut |run| {
            let pixels = pixels.span_mut(run.y_px, run.x0_px, run.x1_px());
            let mut colours = [[0; 4]; RUN];
            let mut wanted = 0;
            for (i, pixel) in pixels.iter().enumerate() {
                wanted |= u32::from(pixel.state == state) << i;
            }
            if wanted == 0 {
                return;
            }
            shaded += u64::from(wanted.count_ones());
            shade(run.values, wanted, stage, &mut colours[..pixels.len()]);
            for (i, (pixel, colour)) in pixels.iter_mut().zip(colours).enumerate() {
                pixel.colour = if wanted >> i & 1 != 0 { colour } else { pixel.colour };
            }
        });
        counters.fragments += shaded;
        counters.shaded += shaded;
    }

    /// Decides what becomes of each pixel that the piece touches, drawn at the depths of a plane or
    /// over what is there. Those that are of the piece as a whole, or in parts where it has one
    /// colour, are drawn; those that it needs apart are in `runs`. Returns the state of the pixels
    /// that are whole; nothing where there are none.
    fn meet(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        plane: Option<&Plane>,
        colour: Option<Colour>,
        target: &Target,
        counters: &mut Counters,
    ) -> Option<State> {
        self.runs.clear();
        let rows = self.covered_rows(engine, piece, target)?;
        let format = target.format;
        let serial = self.pieces.len() as u32;
        let state = State::Whole(serial);
        let (mut is_whole, mut is_part) = (false, false);
        let Self { pattern, pixels, pool, runs, .. } = self;
        for y_px in rows {
            let samples = pattern.rows_of(&self.rows, y_px);
            let Some(PixelRow { touched, inner }) = pattern.pixel_row(samples) else { continue };
            let mut first_apart = None;
            let pixels = pixels.span_mut(y_px, touched.0, touched.1);
            for (x_px, pixel) in (touched.0..).zip(pixels) {
                let keys = plane.map(|plane| plane.keys(x_px, y_px, format));
                let covered = (inner.0..inner.1).contains(&x_px);
                let before = *pixel;
                match pixel.meet(covered, keys) {
                    Meeting::Hidden => {}
                    Meeting::Whole => {
                        is_whole = true;
                        if let State::Parts(index) = pixel.state {
                            pool.spare.push(index);
                        }
                        pixel.state = state;
                        pixel.colour = colour.unwrap_or(pixel.colour);
                    }
                    Meeting::Apart => {
                        let part = colour.filter(|_| pattern.has_masks()).map(|colour| {
                            let (nearest, farthest) = keys.unwrap_or_default();
                            let samples = pattern.mask(samples, x_px);
                            Part { serial: Some(serial), samples, colour, nearest, farthest }
                        });
                        let index =
                            part.and_then(|part| before.draw(part, plane.is_some(), pool, pattern));
                        let Some(index) = index else {
                            first_apart.get_or_insert(x_px);
                            continue;
                        };
                        is_part = true;
                        (pixel.nearest, pixel.farthest) = pool.parts[index as usize].range();
                        pixel.divide(State::Parts(index), counters);
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
            self.pieces.push(pack::<0, 0>(piece));
        }
        is_whole.then_some(state)
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
        self.pixels.get(x_px, y_px).is_some_and(|pixel| pixel.was_apart)
    }

    /// The picture: whole pixels as they are, the others as the mean of their samples.
    pub(super) fn resolve(&self, target: &Target) -> Frame<Colour> {
        let mut picture = Frame::new(target.size(), [0; 4]);
        let mut sums = Vec::new();
        for (y_px, row) in self.pixels.rows() {
            let mut x_px = 0;
            for run in row.chunk_by(|a, b| (a.state == State::Apart) == (b.state == State::Apart)) {
                let end_px = x_px + run.len() as i32;
                let pixels = picture.span_mut(y_px, x_px, end_px);
                if run[0].state == State::Apart {
                    target.resolve_run(y_px, x_px, pixels, &mut sums);
                } else {
                    for (pixel, held) in pixels.iter_mut().zip(run) {
                        *pixel = match held.state {
                            State::Parts(index) => self.pool.parts[index as usize].mean(),
                            _ => held.colour,
                        };
                    }
                }
                x_px = end_px;
            }
        }
        picture
    }
}

impl Run {
    fn rect(self) -> PixelRect {
        let Self { y_px, x0_px, x1_px } = self;
        PixelRect { x0: x0_px, y0: y_px, x1: x1_px, y1: y_px + 1 }
    }
}
