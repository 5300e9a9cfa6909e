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

use std::ops::Range;

use super::parts::{Part, Parts};
use super::plan::pixel_box;
use super::render::{Piece, pack};
use crate::contract::Interpolate;
use crate::frame::Frame;
use crate::grid::{PixelRect, SUBPIXELS};
use crate::pipeline::Counters;
use crate::pipeline::assemble::twice_area;
use crate::pipeline::depth::{CLEAR, DepthFormat};
use crate::pipeline::fill::{Way, fill, fragments};
use crate::pipeline::multisample::{SAMPLES, moved};
use crate::pipeline::shade::Attributes;
use crate::pipeline::target::{Antialias, Colour, Target};
use crate::triangle::{ScreenTriangle, Varying};

/// A piece as far as depth goes.
type DepthPiece = ScreenTriangle<Attributes<0>>;

/// What a pixel holds.
#[derive(Clone, Copy)]
struct Pixel {
    colour: Colour,
    state: State,
    /// Whether its samples were apart at any time.
    was_apart: bool,
    /// Keys that no sample's depth is nearer or farther than.
    nearest: u64,
    farthest: u64,
}

/// Where a pixel's samples come from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// Nothing was drawn.
    Background,
    /// All samples are of this piece.
    Whole(u32),
    /// The samples are of several pieces, here in the pool of parts.
    Parts(u32),
    /// The samples are in the target.
    Apart,
}

/// What becomes of a pixel that a piece touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meeting {
    /// Nothing: everything there is nearer.
    Hidden,
    /// It is of the piece as a whole.
    Whole,
    /// Its samples decide one by one.
    Apart,
}

/// Adjacent pixels of one row.
#[derive(Clone, Copy)]
struct Run {
    y_px: i32,
    x0_px: i32,
    x1_px: i32,
}

/// The pixels of a frame, each whole or told apart.
pub(super) struct OnDemand {
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
    /// Pieces of one colour whose bounding box has no more pixels, and pieces that vary whose box
    /// has fewer columns, are drawn in one go: to find out which of their pixels are whole takes
    /// longer than it saves, as measured.
    const SMALL_PX: u64 = 32;
    const WIDE_PX: u32 = 64;

    pub(super) fn new(target: &Target, background: Colour) -> Self {
        let pattern = Pattern::of(target.antialias());
        let pixel = Pixel {
            colour: background,
            state: State::Background,
            was_apart: false,
            nearest: CLEAR,
            farthest: CLEAR,
        };
        Self {
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
        depth: bool,
        colour: Colour,
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let rect = self.pattern.pixel_box(piece);
        if depth && u64::from(rect.width()) * u64::from(rect.height()) <= Self::SMALL_PX {
            if self.tell_box_apart(engine, piece, depth, target, counters) {
                let (bounds, way) = (target.bounds(), Way { affine: true, depth_test: true });
                fill(engine, &pack::<0, 0>(piece), target, bounds, way, |_| colour, counters);
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
    pub(super) fn draw_varying<V: Varying, F: Fn(&V) -> Colour + Copy>(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        packed: &ScreenTriangle<V>,
        target: &mut Target,
        way: Way,
        fragment_stage: F,
        counters: &mut Counters,
    ) {
        if self.pattern.planes == 1 || self.pattern.pixel_box(piece).width() < Self::WIDE_PX {
            if self.tell_box_apart(engine, piece, way.depth_test, target, counters) {
                fill(engine, packed, target, target.bounds(), way, fragment_stage, counters);
            }
            return;
        }
        let plane = way.depth_test.then(|| Plane::new(piece, self.pattern));
        let met = self.meet(engine, piece, plane.as_ref(), None, target, counters);
        let runs = std::mem::take(&mut self.runs);
        for &run in &runs {
            self.tell_apart(engine, run, target, counters);
            fill(engine, packed, target, run.rect(), way, fragment_stage, counters);
        }
        self.runs = runs;
        let Some(state) = met else { return };
        let (pixels, mut shaded) = (&mut self.pixels, 0);
        fragments(engine, packed, target.bounds(), way.affine, |f| {
            let pixel = &mut pixels.span_mut(f.y_px, f.x_px, f.x_px + 1)[0];
            if pixel.state == state {
                shaded += 1;
                pixel.colour = fragment_stage(&f.varying);
            }
        });
        counters.fragments += shaded;
        counters.shaded += shaded;
    }

    /// Tells all pixels of a piece's bounding box apart, before it is drawn sample by sample; false
    /// where all of it is hidden.
    fn tell_box_apart(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        depth: bool,
        target: &mut Target,
        counters: &mut Counters,
    ) -> bool {
        let rect = self.pattern.pixel_box(piece).intersect(&target.size());
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
        let rows = self.covered_rows(engine, piece, target.bounds())?;
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

    /// Tests and writes the samples of a run of pixels that are apart.
    fn test_samples(
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
            engine.affine_fragments(&moved, block, |f| {
                emitted += 1;
                let key = format.key(f.depth);
                visible += u64::from(plane.test_and_write(f.x_px, f.y_px, key, || colour));
            });
        }
        counters.fragments += emitted;
        counters.depth_tests += emitted;
        counters.depth_failed += emitted - visible;
    }

    /// Writes the covered samples of a run of pixels that are apart.
    fn fill_samples(&self, run: Run, colour: Colour, target: &mut Target, counters: &mut Counters) {
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

    /// Notes the columns that the piece covers in each row of samples; the rows of pixels touched.
    fn covered_rows(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        bounds: PixelRect,
    ) -> Option<Range<i32>> {
        let Pattern { scale, planes } = self.pattern;
        // Whole rows of pixels, so that no row of an earlier piece is left in one.
        let rect = self.pattern.pixel_box(piece).intersect(&self.pixels.bounds());
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

    /// Writes the samples of pixels that are not apart into the target, as drawing them would have.
    fn tell_apart(
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
                        engine.affine_fragments(&moved, block, |f| {
                            let colour = row[(f.x_px / pattern.scale) as usize].colour;
                            plane.put(f.x_px, f.y_px, format.key(f.depth), colour);
                        });
                    }
                }
                State::Parts(index) => {
                    for part in pool.parts[index as usize].iter() {
                        let piece = part.serial.map(|serial| &pieces[serial as usize]);
                        pattern.write_part(engine, part, piece, block, target);
                    }
                    pool.spare.push(index);
                }
            }
            for pixel in pixels.span_mut(run.y_px, run.x0_px, run.x1_px) {
                pixel.divide(State::Apart, counters);
            }
        }
    }

    /// Whether a pixel's samples were told apart at any time.
    pub(super) fn was_apart(&self, x_px: i32, y_px: i32) -> bool {
        self.pixels.get(x_px, y_px).is_some_and(|pixel| pixel.was_apart)
    }

    /// The picture: whole pixels as they are, the others as the mean of their samples.
    pub(super) fn resolve(&self, target: &Target) -> Frame<Colour> {
        let mut picture = Frame::new(target.size(), [0; 4]);
        for (y_px, row) in self.pixels.rows() {
            for (x_px, (pixel, held)) in (0..).zip(picture.row_mut(y_px).iter_mut().zip(row)) {
                *pixel = match held.state {
                    State::Apart => target.pixel(x_px, y_px),
                    State::Parts(index) => self.pool.parts[index as usize].mean(),
                    State::Background | State::Whole(_) => held.colour,
                };
            }
        }
        picture
    }
}

/// The parts of all pixels that have several.
#[derive(Default)]
struct Pool {
    parts: Vec<Parts>,
    /// Places that are of no pixel any more.
    spare: Vec<u32>,
}

impl Pool {
    /// The place of new parts.
    fn add(&mut self, parts: Parts) -> u32 {
        if let Some(index) = self.spare.pop() {
            self.parts[index as usize] = parts;
            return index;
        }
        self.parts.push(parts);
        self.parts.len() as u32 - 1
    }
}

/// Columns of pixels: some samples covered, and all samples covered.
#[derive(Clone, Copy)]
struct PixelRow {
    touched: (i32, i32),
    inner: (i32, i32),
}

impl Run {
    fn rect(self) -> PixelRect {
        let Self { y_px, x0_px, x1_px } = self;
        PixelRect { x0: x0_px, y0: y_px, x1: x1_px, y1: y_px + 1 }
    }
}

/// The samples of a rectangle of pixels, `scale` along a side of each.
fn scaled(rect: PixelRect, scale: i32) -> PixelRect {
    let PixelRect { x0, y0, x1, y1 } = rect;
    PixelRect { x0: x0 * scale, y0: y0 * scale, x1: x1 * scale, y1: y1 * scale }
}

impl Pixel {
    /// Draws a piece on some of its samples; its place in the pool afterwards. None, with nothing
    /// drawn, where they are apart or must be.
    fn draw(&self, part: Part, depth: bool, pool: &mut Pool, pattern: &Pattern) -> Option<u32> {
        let Self { colour, nearest, farthest, .. } = *self;
        let serial = match self.state {
            State::Apart => return None,
            State::Parts(index) => {
                return pool.parts[index as usize].draw(part, depth).then_some(index);
            }
            State::Whole(serial) => Some(serial),
            State::Background => None,
        };
        let whole = Part { serial, samples: pattern.all(), colour, nearest, farthest };
        let mut parts = Parts::of(whole);
        parts.draw(part, depth).then(|| pool.add(parts))
    }

    /// Gives it a state in which its samples differ, and counts it the first time.
    fn divide(&mut self, state: State, counters: &mut Counters) {
        self.state = state;
        counters.expanded += u64::from(!self.was_apart);
        self.was_apart = true;
    }

    /// What becomes of it under a piece that covers all its samples or some of them, at depths
    /// between two keys, or drawn over whatever is there.
    #[inline]
    fn meet(&mut self, covered: bool, keys: Option<(u64, u64)>) -> Meeting {
        let Some((nearest, farthest)) = keys else {
            if covered {
                (self.nearest, self.farthest) = (0, 0);
                return Meeting::Whole;
            }
            return Meeting::Apart;
        };
        if nearest >= self.farthest {
            return Meeting::Hidden;
        }
        if covered && farthest < self.nearest {
            (self.nearest, self.farthest) = (nearest, farthest);
            return Meeting::Whole;
        }
        // Nothing that is drawn moves a sample away from the eye, and where all samples are covered
        // none is left behind the piece.
        self.nearest = self.nearest.min(nearest);
        if covered {
            self.farthest = self.farthest.min(farthest);
        }
        Meeting::Apart
    }
}

/// Where the samples of a pixel lie: on a grid in one larger window, or in planes of one each, for
/// which the piece is moved.
#[derive(Clone, Copy)]
struct Pattern {
    /// Samples along a side of the grid.
    scale: i32,
    planes: usize,
}

impl Pattern {
    fn of(antialias: Antialias) -> Self {
        Self { scale: antialias.scale() as i32, planes: antialias.planes() }
    }

    /// The piece as one of the planes sees it.
    #[inline]
    fn moved<V: Varying>(
        self,
        piece: &ScreenTriangle<V>,
        plane: usize,
    ) -> Option<ScreenTriangle<V>> {
        if self.planes == 1 { Some(*piece) } else { moved(piece, SAMPLES[plane]) }
    }

    /// Whether a bit for each sample fits a mask.
    fn has_masks(self) -> bool {
        self.scale * self.scale * self.planes as i32 <= u64::BITS as i32
    }

    /// The bit of a sample, `x` columns and `y` rows into the pixel, in a plane.
    #[inline]
    fn bit(self, x: i32, y: i32, plane: usize) -> u64 {
        1 << ((y * self.planes as i32 + plane as i32) * self.scale + x)
    }

    /// All bits.
    fn all(self) -> u64 {
        u64::MAX >> (u64::BITS as i32 - self.scale * self.scale * self.planes as i32)
    }

    /// The bits of the samples of a pixel that are covered; `samples` are those of its row.
    #[inline]
    fn mask(self, samples: &[(i32, i32)], x_px: i32) -> u64 {
        let left = x_px * self.scale;
        let mut mask = 0;
        for (j, &(x0, x1)) in samples.iter().enumerate() {
            let (x0, x1) = ((x0 - left).max(0), (x1 - left).min(self.scale));
            if x0 < x1 {
                let bits = (u64::MAX >> (u64::BITS as i32 - (x1 - x0))) << x0;
                mask |= bits << (j as i32 * self.scale);
            }
        }
        mask
    }

    /// The columns that are covered in a row of pixels, for each row of samples in each plane.
    fn rows_of(self, rows: &[(i32, i32)], y_px: i32) -> &[(i32, i32)] {
        let per_row = self.scale as usize * self.planes;
        &rows[y_px as usize * per_row..][..per_row]
    }

    /// The columns of one row of pixels. A row of samples is one run, since triangles are convex.
    fn pixel_row(self, samples: &[(i32, i32)]) -> Option<PixelRow> {
        let scale = self.scale;
        let mut touched = (i32::MAX, i32::MIN);
        let mut inner = (i32::MIN, i32::MAX);
        for &(x0, x1) in samples {
            if x0 < x1 {
                touched = (touched.0.min(x0), touched.1.max(x1));
            }
            inner = (inner.0.max(x0), inner.1.min(x1));
        }
        if touched.0 >= touched.1 {
            return None;
        }
        let up = |x: i32| (x + scale - 1).div_euclid(scale);
        let touched = (touched.0.div_euclid(scale), up(touched.1));
        let inner = (up(inner.0), inner.1.div_euclid(scale));
        Some(PixelRow { touched, inner })
    }

    /// Writes the samples of one part of a pixel, which are those in `block`, into the target.
    fn write_part(
        self,
        engine: &impl Interpolate,
        part: &Part,
        piece: Option<&DepthPiece>,
        block: PixelRect,
        target: &mut Target,
    ) {
        let format = target.format;
        for (i, plane) in target.planes.iter_mut().enumerate() {
            let mut put = |x: i32, y: i32, key: u64| {
                if part.samples & self.bit(x - block.x0, y - block.y0, i) != 0 {
                    plane.put(x, y, key, part.colour);
                }
            };
            if let Some(piece) = piece {
                let Some(moved) = self.moved(piece, i) else { continue };
                engine
                    .affine_fragments(&moved, block, |f| put(f.x_px, f.y_px, format.key(f.depth)));
            } else {
                for y in block.y0..block.y1 {
                    (block.x0..block.x1).for_each(|x| put(x, y, CLEAR));
                }
            }
        }
    }

    /// Pixels whose samples a piece may touch.
    fn pixel_box<V: Copy>(self, piece: &ScreenTriangle<V>) -> PixelRect {
        // A moved piece lies up to half a pixel off.
        let samples = pixel_box(&piece.corners(), i32::from(self.planes > 1));
        let down = |x: i32| x.div_euclid(self.scale);
        let up = |x: i32| (x + self.scale - 1).div_euclid(self.scale);
        PixelRect {
            x0: down(samples.x0),
            y0: down(samples.y0),
            x1: up(samples.x1),
            y1: up(samples.y1),
        }
    }

    /// How far a sample lies from the middle of its pixel along either axis, in pixels.
    fn reach_px(self) -> f64 {
        if self.planes == 1 {
            f64::from(self.scale - 1) / f64::from(2 * self.scale)
        } else {
            // 2/16 and 14/16 are the outermost of SAMPLES.
            6.0 / 16.0
        }
    }
}

/// The plane of a piece's depth over pixels.
struct Plane {
    /// Depth at the first vertex.
    depth: f64,
    /// Edge functions over twice the area, in the middle of pixel (0, 0), and what a pixel adds.
    weights: [Weight; 2],
    /// Half the range of depths within a pixel.
    half_range: f64,
}

struct Weight {
    /// Difference of the depth of this vertex to the first one's, over twice the area.
    slope: f64,
    origin: f64,
    per_x: f64,
    per_y: f64,
}

impl Plane {
    /// z = z0 + (z1 - z0) E1 / 2A + (z2 - z0) E2 / 2A = z0 + t1 + t2.
    ///
    /// Error: in a window of at most 2^14 samples a side, 2^22 subpixels, the E are whole or half
    /// numbers below 2^46, so exact. Each t has a difference, a quotient and a product; the sums
    /// round twice. With u = 2^-53 that is below 3 u (|t1| + |t2|) + 2 u (|z0| + |t1| + |t2|), and a
    /// rasterizer's depth at a covered sample is within u (12 D + 2 M) of the exact plane
    /// ([`crate::verify::tolerance`] derives 12 D + 2 M and 7 D + M), where D, M <= 1. Together less
    /// than 64 u (1 + |t1| + |t2|); outside of the triangle the t may be large.
    const ERROR: f64 = 64.0 * (f64::EPSILON / 2.0);

    fn new(piece: &Piece, pattern: Pattern) -> Self {
        let [a, b, c] = piece
            .vertices
            .map(|vertex| (i128::from(vertex.position.x), i128::from(vertex.position.y)));
        let area = twice_area(piece.corners());
        let pixel = i128::from(pattern.scale * SUBPIXELS);
        let [first, second, third] = piece.vertices.map(|vertex| vertex.depth);
        let weight = |from: (i128, i128), to: (i128, i128), depth: f64| {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            // In half subpixels, so that the middle is whole.
            let origin2 = dx * (pixel - 2 * from.1) - dy * (pixel - 2 * from.0);
            Weight {
                slope: if area == 0 { 0.0 } else { (depth - first) / area as f64 },
                origin: origin2 as f64 / 2.0,
                per_x: (-dy * pixel) as f64,
                per_y: (dx * pixel) as f64,
            }
        };
        // E1 belongs to the edge opposite the second vertex, E2 to the one opposite the third.
        let weights = [weight(c, a, second), weight(a, b, third)];
        // What a pixel adds to the depth along an axis, and that without regard to signs.
        let sum = |per: fn(&Weight) -> f64| -> [f64; 2] {
            let [one, two] = [0, 1].map(|i| weights[i].slope * per(&weights[i]));
            [(one + two).abs(), one.abs() + two.abs()]
        };
        let ([x, all_x], [y, all_y]) = (sum(|weight| weight.per_x), sum(|weight| weight.per_y));
        // Each product is rounded three times, the sums and the range four times.
        let rounding = 8.0 * f64::EPSILON * (all_x + all_y);
        let half_range = (x + y + rounding) * pattern.reach_px();
        Self { depth: first, weights, half_range }
    }

    /// Keys of the nearest and farthest depth that a rasterizer may compute at the samples of a
    /// pixel that it covers.
    #[inline]
    fn keys(&self, x_px: i32, y_px: i32, format: DepthFormat) -> (u64, u64) {
        let (x, y) = (f64::from(x_px), f64::from(y_px));
        let [t1, t2] = [0, 1]
            .map(|i| &self.weights[i])
            .map(|w| w.slope * (w.origin + w.per_x * x + w.per_y * y));
        let middle = self.depth + (t1 + t2);
        let half = self.half_range + Self::ERROR * (1.0 + t1.abs() + t2.abs());
        (format.key(middle - half), format.key(middle + half))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::SubpixelPoint;
    use crate::hazard::Rng;
    use crate::pipeline::shade::ALL;
    use crate::raster::edge_function::EdgeFunction;
    use crate::raster::scanline::Scanline;
    use crate::triangle::ScreenVertex;

    const SIZE_PX: u32 = 12;

    /// A triangle about the picture, some with two corners close together, some whose depth grows
    /// along a row.
    fn piece(rng: &mut Rng, pattern: Pattern) -> Piece {
        let side = f64::from(pattern.scale * SUBPIXELS) * f64::from(SIZE_PX);
        let (thin, along_x) = (rng.chance(4), rng.chance(3));
        let mut corner = |near: Option<SubpixelPoint>| {
            let mut along = |from: Option<i32>| match from {
                Some(from) => from + rng.int(-300, 300) as i32,
                None => (rng.unit() * side) as i32,
            };
            let position = SubpixelPoint::new(along(near.map(|p| p.x)), along(near.map(|p| p.y)));
            let depth = if along_x { f64::from(position.x) / side } else { rng.unit() };
            ScreenVertex { position, depth, inv_w: 1.0, varying: Attributes([0.0; ALL]) }
        };
        let first = corner(None);
        let second = corner(thin.then_some(first.position));
        ScreenTriangle { vertices: [first, second, corner(None)] }
    }

    /// Depths of both engines at samples, and those among them that `within` does not hold.
    fn outside(pattern: Pattern, within: impl Fn(&Plane, i32, i32, f64) -> bool) -> (u64, u64) {
        let (mut count, mut wrong) = (0, 0);
        let window = PixelRect::window(SIZE_PX, SIZE_PX);
        let bounds = scaled(window, pattern.scale);
        for index in 0..400 {
            let piece = piece(&mut Rng::new("plane", 1, index), pattern);
            let plane = Plane::new(&piece, pattern);
            for i in 0..pattern.planes {
                let moved = pattern.moved(&pack::<0, 0>(&piece), i).unwrap();
                let mut see = |x: i32, y: i32, depth: f64| {
                    count += 1;
                    let scale = pattern.scale;
                    wrong += u64::from(!within(&plane, x / scale, y / scale, depth));
                };
                Scanline.affine_fragments(&moved, bounds, |f| see(f.x_px, f.y_px, f.depth));
                EdgeFunction.affine_fragments(&moved, bounds, |f| see(f.x_px, f.y_px, f.depth));
            }
        }
        (count, wrong)
    }

    #[test]
    fn keys_contain_every_depth_that_an_engine_computes() {
        for antialias in
            [Antialias::Multisample4, Antialias::Supersample(2), Antialias::Supersample(5)]
        {
            let pattern = Pattern::of(antialias);
            for format in DepthFormat::ALL {
                let (count, wrong) = outside(pattern, |plane, x, y, depth| {
                    let (nearest, farthest) = plane.keys(x, y, format);
                    (nearest..=farthest).contains(&format.key(depth))
                });
                assert!(count > 20_000 && wrong == 0, "{antialias:?} {format:?}: {wrong}");
            }
            // A range that is too small by an eighth is noticed, and so is none for the rounding.
            let narrow = |share: f64, error: f64| {
                outside(pattern, |plane, x, y, depth| {
                    let (x, y) = (f64::from(x), f64::from(y));
                    let term = |w: &Weight| w.slope * (w.origin + w.per_x * x + w.per_y * y);
                    let middle = plane.depth + (term(&plane.weights[0]) + term(&plane.weights[1]));
                    (depth - middle).abs() <= plane.half_range * share + error
                })
            };
            assert!(narrow(0.875, Plane::ERROR).1 > 0, "{antialias:?}");
            assert!(narrow(1.0, 0.0).1 > 0, "{antialias:?}");
        }
    }

    #[test]
    fn a_pixel_is_hidden_whole_or_apart() {
        let clear = Pixel {
            colour: [0; 4],
            state: State::Background,
            was_apart: false,
            nearest: CLEAR,
            farthest: CLEAR,
        };
        let met = |covered: bool, keys: &[Option<(u64, u64)>]| {
            let mut pixel = clear;
            let mut last = Meeting::Hidden;
            for &keys in keys {
                last = pixel.meet(covered, keys);
            }
            (last, pixel.nearest, pixel.farthest)
        };
        assert_eq!(met(true, &[Some((5, 9))]), (Meeting::Whole, 5, 9));
        assert_eq!(met(false, &[Some((5, 9))]), (Meeting::Apart, 5, CLEAR));
        assert_eq!(met(true, &[Some((5, 9)), Some((9, 12))]), (Meeting::Hidden, 5, 9));
        assert_eq!(met(true, &[Some((5, 9)), Some((8, 12))]), (Meeting::Apart, 5, 9));
        assert_eq!(met(true, &[Some((5, 9)), Some((2, 5))]), (Meeting::Apart, 2, 5));
        assert_eq!(met(true, &[Some((5, 9)), Some((2, 4))]), (Meeting::Whole, 2, 4));
        assert_eq!(met(true, &[Some((5, 9)), None]).0, Meeting::Whole);
        assert_eq!(met(false, &[None]).0, Meeting::Apart);
    }
}
