//! Supersampling on demand: a pixel has one colour until something needs its samples apart.
//!
//! A triangle of one colour that covers all samples of a pixel changes the pixel as a whole if it is
//! nearer than everything in it, or not at all if it is behind everything in it. Which of the two,
//! or neither, is asked of intervals that contain every depth the rasterizer may compute there. The
//! pixels at its border, and those where intervals overlap, are told apart: their samples are
//! drawn as they would have been all along, first what was there, then the triangle. Rasterizers
//! only crop to their bounds, so redrawing a block gives the bits of the whole.

use super::render::Piece;
use crate::contract::Interpolate;
use crate::frame::Frame;
use crate::grid::{HALF_PIXEL, PixelRect, SUBPIXELS};
use crate::pipeline::Counters;
use crate::pipeline::depth::{CLEAR, DepthFormat};
use crate::pipeline::shade::Attributes;
use crate::pipeline::target::{Colour, Target};
use crate::triangle::{ScreenTriangle, ScreenVertex};

/// A piece as far as depth goes.
type DepthPiece = ScreenTriangle<Attributes<0>>;

/// What a pixel holds.
#[derive(Clone, Copy)]
struct Pixel {
    colour: Colour,
    state: State,
    /// Keys of the nearest and farthest depth that any sample may have.
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
    /// The samples are in the target.
    Apart,
}

/// The pixels of a frame, each whole or told apart.
pub(super) struct OnDemand {
    /// Samples along a pixel's side.
    n: i32,
    pixels: Frame<Pixel>,
    /// Pieces that a pixel may be whole of.
    pieces: Vec<DepthPiece>,
    /// Covered columns of each row of samples, of the piece at hand.
    rows: Vec<(i32, i32)>,
}

/// Columns of pixels: some samples covered, and all samples covered.
#[derive(Clone, Copy)]
struct PixelRow {
    touched: (i32, i32),
    inner: (i32, i32),
}

impl OnDemand {
    pub(super) fn new(target: &Target, n: u32, background: Colour) -> Self {
        let pixel =
            Pixel { colour: background, state: State::Background, nearest: CLEAR, farthest: CLEAR };
        Self {
            n: n as i32,
            pixels: Frame::new(target.size(), pixel),
            pieces: Vec::new(),
            rows: vec![(0, 0); target.bounds().height() as usize],
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
        let format = target.format;
        let plane = Plane::new(piece, self.n);
        self.pieces.push(depth_only(piece));
        let serial = self.pieces.len() as u32 - 1;
        let Some(rows) = self.covered_rows(engine, piece, target.bounds()) else { return };
        for y_px in rows {
            let Some(row) = self.pixel_row(y_px) else { continue };
            let (x0, x1) = row.touched;
            let (inner0, inner1) = row.inner;
            let mut apart = Run::default();
            for x_px in x0..x1 {
                let whole = (inner0..inner1).contains(&x_px);
                let pixel = &mut self.pixels.span_mut(y_px, x_px, x_px + 1)[0];
                let drawn = whole
                    && pixel.draw_whole(depth, || plane.keys(x_px, y_px, format), colour, serial);
                if drawn {
                    self.samples(engine, &mut apart, serial, y_px, depth, colour, target, counters);
                } else {
                    self.tell_apart(engine, x_px, y_px, target, counters);
                    apart.extend(x_px);
                }
            }
            self.samples(engine, &mut apart, serial, y_px, depth, colour, target, counters);
        }
    }

    /// Draws the run of pixels that are apart, and empties it.
    #[expect(clippy::too_many_arguments, reason = "the state of one row, split by borrowing")]
    fn samples(
        &mut self,
        engine: &impl Interpolate,
        run: &mut Run,
        serial: u32,
        y_px: i32,
        depth: bool,
        colour: Colour,
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let Some((x0, x1)) = run.0.take() else { return };
        let n = self.n;
        let block = PixelRect { x0: x0 * n, y0: y_px * n, x1: x1 * n, y1: (y_px + 1) * n };
        let format = target.format;
        let plane = &mut target.planes[0];
        let (mut emitted, mut visible) = (0, 0);
        engine.affine_fragments(&self.pieces[serial as usize], block, |f| {
            emitted += 1;
            if depth {
                let key = format.key(f.depth);
                visible += u64::from(plane.test_and_write(f.x_px, f.y_px, key, || colour));
            } else {
                visible += 1;
                plane.write(f.x_px, f.y_px, colour);
            }
        });
        counters.fragments += emitted;
        counters.depth_tests += if depth { emitted } else { 0 };
        counters.depth_failed += emitted - visible;
    }

    /// Tells all pixels apart that a piece touches, before it is drawn sample by sample.
    pub(super) fn expand_under(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let Some(rows) = self.covered_rows(engine, piece, target.bounds()) else { return };
        for y_px in rows {
            let Some(PixelRow { touched: (x0, x1), .. }) = self.pixel_row(y_px) else { continue };
            for x_px in x0..x1 {
                self.tell_apart(engine, x_px, y_px, target, counters);
            }
        }
    }

    /// Notes the columns that the piece covers in each row of samples; the rows of pixels touched.
    fn covered_rows(
        &mut self,
        engine: &impl Interpolate,
        piece: &Piece,
        bounds: PixelRect,
    ) -> Option<std::ops::Range<i32>> {
        let n = self.n;
        let ys = piece.vertices.map(|vertex| vertex.position.y.div_euclid(SUBPIXELS));
        let (min, max) = (ys.into_iter().min()?, ys.into_iter().max()?);
        // Whole rows of pixels, so that no row of an earlier piece is left in one.
        let (first, end) = (min.max(0) / n, (max.min(bounds.y1 - 1)) / n + 1);
        let end = end.min(bounds.y1 / n);
        if first >= end {
            return None;
        }
        self.rows[(first * n) as usize..(end * n) as usize].fill((0, 0));
        let rows = &mut self.rows;
        engine.cover(piece.corners(), bounds, |span| {
            rows[span.y_px as usize] = (span.x0_px, span.x1_px);
        });
        Some(first..end)
    }

    /// The columns of one row of pixels. A row of samples is one run, since triangles are convex.
    fn pixel_row(&self, y_px: i32) -> Option<PixelRow> {
        let n = self.n;
        let rows = &self.rows[(y_px * n) as usize..((y_px + 1) * n) as usize];
        let mut touched = (i32::MAX, i32::MIN);
        let mut inner = (i32::MIN, i32::MAX);
        for &(x0, x1) in rows {
            if x0 < x1 {
                touched = (touched.0.min(x0), touched.1.max(x1));
            }
            inner = (inner.0.max(x0), inner.1.min(x1));
        }
        if touched.0 >= touched.1 {
            return None;
        }
        let touched = (touched.0.div_euclid(n), (touched.1 + n - 1).div_euclid(n));
        let inner = ((inner.0 + n - 1).div_euclid(n), inner.1.div_euclid(n));
        Some(PixelRow { touched, inner: if inner.0 < inner.1 { inner } else { (0, 0) } })
    }

    /// Writes a whole pixel's samples into the target, as drawing them would have.
    fn tell_apart(
        &mut self,
        engine: &impl Interpolate,
        x_px: i32,
        y_px: i32,
        target: &mut Target,
        counters: &mut Counters,
    ) {
        let pixel = &mut self.pixels.span_mut(y_px, x_px, x_px + 1)[0];
        let (n, format) = (self.n, target.format);
        let block =
            PixelRect { x0: x_px * n, y0: y_px * n, x1: (x_px + 1) * n, y1: (y_px + 1) * n };
        let plane = &mut target.planes[0];
        match pixel.state {
            State::Apart => return,
            State::Background => {
                for y in block.y0..block.y1 {
                    plane.depth.span_mut(y, block.x0, block.x1).fill(CLEAR);
                    plane.colour.span_mut(y, block.x0, block.x1).fill(pixel.colour);
                }
            }
            State::Whole(serial) => {
                engine.affine_fragments(&self.pieces[serial as usize], block, |f| {
                    plane.depth.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = format.key(f.depth);
                    plane.write(f.x_px, f.y_px, pixel.colour);
                });
            }
        }
        pixel.state = State::Apart;
        counters.expanded += 1;
    }

    /// Whether a pixel's samples were told apart.
    pub(super) fn is_apart(&self, x_px: i32, y_px: i32) -> bool {
        self.pixels.get(x_px, y_px).is_some_and(|pixel| pixel.state == State::Apart)
    }

    /// The picture: whole pixels as they are, the others as the mean of their samples.
    pub(super) fn resolve(&self, target: &Target) -> Frame<Colour> {
        let mut picture = Frame::new(target.size(), [0; 4]);
        for (y_px, row) in self.pixels.rows() {
            for (x_px, pixel) in (target.size().x0..).zip(row) {
                picture.span_mut(y_px, x_px, x_px + 1)[0] = match pixel.state {
                    State::Apart => target.pixel(x_px, y_px),
                    _ => pixel.colour,
                };
            }
        }
        picture
    }
}

/// Adjacent pixels of one row.
#[derive(Default)]
struct Run(Option<(i32, i32)>);

impl Run {
    fn extend(&mut self, x_px: i32) {
        let first = self.0.map_or(x_px, |(first, _)| first);
        self.0 = Some((first, x_px + 1));
    }
}

impl Pixel {
    /// Draws a triangle that covers all samples; false where the samples must be told apart.
    #[inline]
    fn draw_whole(
        &mut self,
        depth: bool,
        keys: impl Fn() -> (u64, u64),
        colour: Colour,
        serial: u32,
    ) -> bool {
        if self.state == State::Apart {
            return false;
        }
        let (nearest, farthest) = if depth { keys() } else { (0, 0) };
        if !depth || farthest < self.nearest {
            *self = Self { colour, state: State::Whole(serial), nearest, farthest };
            true
        } else {
            // Behind everything: nothing changes. Else the samples decide one by one.
            nearest >= self.farthest
        }
    }
}

fn depth_only(piece: &Piece) -> DepthPiece {
    let vertices = piece.vertices.map(|vertex| ScreenVertex {
        position: vertex.position,
        depth: vertex.depth,
        inv_w: 1.0,
        varying: Attributes([]),
    });
    ScreenTriangle { vertices }
}

/// The plane of a piece's depth over blocks of samples.
struct Plane {
    /// Depth at the first vertex.
    depth: f64,
    /// Edge functions over twice the area, at block (0, 0)'s middle, and what a block adds to them.
    weights: [Weight; 2],
    /// Half the range within a block, with every rounding error.
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
    /// z = z0 + (z1 - z0) E1 / 2A + (z2 - z0) E2 / 2A, the E in whole numbers below 2^53 in the
    /// window of at most 2^14 samples: 2^22 subpixels a side, products of 2^44 and less.
    ///
    /// Error: the E are exact. Each term has the difference (1), the quotient (1), the product (1),
    /// of a magnitude of at most D, two of them and the sums 4 more of magnitude M or D: below
    /// 10 u (D + M) with all depths in [0, 1]. A rasterizer's depth is within u (12 D + 2 M) of the
    /// exact plane ([`crate::verify::tolerance`] derives 12 D + 2 M and 7 D + M). Together less
    /// than 64 u, and a window of depth in [0, 1] has D, M <= 1.
    fn new(piece: &Piece, n: i32) -> Self {
        const ERROR: f64 = 64.0 * (f64::EPSILON / 2.0);
        let [a, b, c] = piece
            .vertices
            .map(|vertex| (i64::from(vertex.position.x), i64::from(vertex.position.y)));
        let area = (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0);
        // The middle of block (0, 0) in half subpixels, so that it is whole.
        let block = i64::from(n) * i64::from(SUBPIXELS);
        let middle2 = block;
        let [first, second, third] = piece.vertices.map(|vertex| vertex.depth);
        let weight = |from: (i64, i64), to: (i64, i64), depth: f64| {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let origin2 = dx * (middle2 - 2 * from.1) - dy * (middle2 - 2 * from.0);
            Weight {
                slope: if area == 0 { 0.0 } else { (depth - first) / area as f64 },
                origin: origin2 as f64 / 2.0,
                per_x: (-dy * block) as f64,
                per_y: (dx * block) as f64,
            }
        };
        // E1 belongs to the edge opposite the second vertex, E2 to the one opposite the third.
        let weights = [weight(c, a, second), weight(a, b, third)];
        // From the middle of a block to the centre of its last sample, of block sides.
        let reach = f64::from((n - 1) * HALF_PIXEL) / block as f64;
        let range: f64 = weights
            .iter()
            .map(|weight| weight.slope.abs() * (weight.per_x.abs() + weight.per_y.abs()) * reach)
            .sum();
        // The range itself is rounded four times, upwards by more than that.
        Self { depth: first, weights, half_range: range * (1.0 + 16.0 * f64::EPSILON) + ERROR }
    }

    /// Keys of the nearest and farthest depth in a pixel that the piece covers whole.
    #[inline]
    fn keys(&self, x_px: i32, y_px: i32, format: DepthFormat) -> (u64, u64) {
        let (x, y) = (f64::from(x_px), f64::from(y_px));
        let term = |w: &Weight| w.slope * (w.origin + w.per_x * x + w.per_y * y);
        let middle = self.depth + (term(&self.weights[0]) + term(&self.weights[1]));
        (format.key(middle - self.half_range), format.key(middle + self.half_range))
    }
}
