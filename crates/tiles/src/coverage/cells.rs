//! Triangles of at most 4 x 4 and 8 x 8 px, sixteen at a time, one a lane: each pixel of their squares is
//! decided for all of them at once, in i16.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i16x16, i32x16};

use super::setup::{Batch, LANES, Line};
use super::{CELL_PX, Cell, Piece, QUARTER_PX, Quarter};

/// Sixteen words of sixteen pixels, one a lane.
#[derive(Clone, Copy)]
#[repr(align(32))]
struct Words([u16; LANES]);

/// Of each lane, where a square of `SIDE` columns and rows is and which of its pixels are covered.
pub(super) struct Squares<const SIDE: i32, const WORDS: usize> {
    x_px: Line,
    y_px: Line,
    /// Bit SIDE j + i, counted through all words: pixel (i, j).
    pixels: [Words; WORDS],
}

pub(super) type Cells = Squares<CELL_PX, 1>;
/// Squares of a byte for each row.
pub(super) type Quarters = Squares<QUARTER_PX, 4>;

impl<const SIDE: i32, const WORDS: usize> Default for Squares<SIDE, WORDS> {
    fn default() -> Self {
        let none = Line([0; LANES]);
        Self { x_px: none, y_px: none, pixels: [Words([0; LANES]); WORDS] }
    }
}

impl<const SIDE: i32, const WORDS: usize> Squares<SIDE, WORDS> {
    const ROWS: i32 = 16 / SIDE;
    /// The first row of a word, and the first column.
    const ROW: u16 = (1 << SIDE) - 1;
    const COLUMN: u16 = u16::MAX / Self::ROW;

    /// Right in the lanes that are near and of which the window shows no more than a square.
    #[inline(always)]
    pub fn new<S: Simd>(simd: S, batch: &Batch<S>) -> Self {
        let [x0, y0, x1, y1] = batch.rect;
        let ([a, b, c], [ra, rb, rc], [da, db, dc]) = (batch.start, batch.right, batch.down);
        let (width, height) = narrowed(x1 - x0, y1 - y0);
        let (mut row_a, mut row_b) = narrowed(a, b);
        let (mut row_c, right_c) = narrowed(c, rc);
        let (right_a, right_b) = narrowed(ra, rb);
        let (down_a, down_b) = narrowed(da, db);
        let (down_c, _) = narrowed(dc, dc);
        let mut columns = splat(simd, 0);
        for i in 0..SIDE {
            columns |= shown(simd, width, i, Self::COLUMN << i);
        }
        let mut squares =
            Self { x_px: Line(x0.to_array()), y_px: Line(y0.to_array()), ..Self::default() };
        for (word, pixels) in squares.pixels.iter_mut().enumerate() {
            let (mut outside, mut rows) = (splat(simd, 0), splat(simd, 0));
            for j in 0..Self::ROWS {
                let (mut a, mut b, mut c) = (row_a, row_b, row_c);
                for i in 0..SIDE {
                    let bit = splat(simd, 1 << (SIDE * j + i));
                    outside |= ((a | b | c) >> 15) & bit;
                    (a, b, c) = (a + right_a, b + right_b, c + right_c);
                }
                let row = Self::ROWS * word as i32 + j;
                rows |= shown(simd, height, row, Self::ROW << (SIDE * j));
                (row_a, row_b, row_c) = (row_a + down_a, row_b + down_b, row_c + down_c);
            }
            // What is beyond the box may have wrapped around.
            let all = (!outside & columns & rows).to_array();
            for (to, from) in pixels.0.iter_mut().zip(all) {
                *to = from.cast_unsigned();
            }
        }
        squares
    }
}

impl Cells {
    /// Appends a lane, where it covers a pixel.
    #[inline(always)]
    pub fn append(&self, lane: usize, triangle: u32, out: &mut Vec<Piece>) {
        let (x_px, y_px, pixels) = (self.x_px.0[lane], self.y_px.0[lane], self.pixels[0].0[lane]);
        if pixels != 0 {
            out.push(Piece::Cell(Cell { triangle, x_px, y_px, pixels }));
        }
    }
}

impl Quarters {
    /// Appends a lane, where it covers a pixel.
    #[inline(always)]
    pub fn append(&self, lane: usize, triangle: u32, out: &mut Vec<Piece>) {
        let (x_px, y_px) = (self.x_px.0[lane], self.y_px.0[lane]);
        let mut pixels = 0;
        for (i, word) in self.pixels.iter().enumerate() {
            pixels |= u64::from(word.0[lane]) << (16 * i);
        }
        if pixels != 0 {
            out.push(Piece::Quarter(Quarter { triangle, x_px, y_px, pixels }));
        }
    }
}

#[inline(always)]
fn splat<S: Simd>(simd: S, bits: u16) -> i16x16<S> {
    i16x16::splat(simd, bits.cast_signed())
}

/// `bits` in the lanes that have more columns, or rows, than `index`.
#[inline(always)]
fn shown<S: Simd>(simd: S, count: i16x16<S>, index: i32, bits: u16) -> i16x16<S> {
    count.simd_gt(index as i16).select(splat(simd, bits), splat(simd, 0))
}

/// Two vectors in words of half the width; what does not fit is something else.
#[inline(always)]
fn narrowed<S: Simd>(a: i32x16<S>, b: i32x16<S>) -> (i16x16<S>, i16x16<S>) {
    a.saturating_narrow(b).split()
}
