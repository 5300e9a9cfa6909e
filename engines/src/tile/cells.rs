//! Triangles of at most 4 x 4 px, sixteen at a time, one a lane: each of the sixteen pixels of their
//! cells is decided for all of them at once.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x16};

use super::setup::{Batch, LANES, Line};
use super::{CELL_PX, Cell, Piece};

/// Of each lane, where the cell is and which of its pixels are covered.
pub(super) struct Cells {
    x_px: Line,
    y_px: Line,
    /// Bit 4 j + i: pixel (i, j).
    pixels: Line,
}

impl Default for Cells {
    fn default() -> Self {
        let none = Line([0; LANES]);
        Self { x_px: none, y_px: none, pixels: none }
    }
}

impl Cells {
    /// Right in the lanes whose triangles are narrow and tiny.
    #[inline(always)]
    pub fn new<S: Simd>(simd: S, batch: &Batch<S>) -> Self {
        let zero = i32x16::splat(simd, 0);
        let [mut row_a, mut row_b, mut row_c] = batch.start;
        let mut pixels = zero;
        for j in 0..CELL_PX {
            let (mut a, mut b, mut c) = (row_a, row_b, row_c);
            for i in 0..CELL_PX {
                let outside = (a | b | c).simd_lt(zero);
                pixels |= outside.select(zero, i32x16::splat(simd, 1 << (CELL_PX * j + i)));
                a += batch.right[0];
                b += batch.right[1];
                c += batch.right[2];
            }
            row_a += batch.down[0];
            row_b += batch.down[1];
            row_c += batch.down[2];
        }
        let [x0, y0, x1, y1] = batch.rect;
        let shown = shown(simd, x1 - x0, 0x1111, 1) & shown(simd, y1 - y0, 0x000f, CELL_PX as u32);
        Self {
            x_px: Line(x0.to_array()),
            y_px: Line(y0.to_array()),
            pixels: Line((pixels & shown).to_array()),
        }
    }

    /// Appends those lanes of `lanes` that cover a pixel; the number of the first triangle is given.
    #[inline(always)]
    pub fn append(&self, lanes: u32, number: u32, out: &mut Vec<Piece>) {
        let mut left = lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize & (LANES - 1);
            left &= left - 1;
            let pixels = self.pixels.0[lane] as u16;
            let triangle = number + lane as u32;
            if pixels != 0 {
                let (x_px, y_px) = (self.x_px.0[lane], self.y_px.0[lane]);
                out.push(Piece::Cell(Cell { triangle, x_px, y_px, pixels }));
            }
        }
    }
}

/// The pixels of the first `count` columns, or rows, of a cell: `first` is the first of them, and the
/// next is `step` bits further.
#[inline(always)]
fn shown<S: Simd>(simd: S, count: i32x16<S>, first: i32, step: u32) -> i32x16<S> {
    let zero = i32x16::splat(simd, 0);
    let mut shown = i32x16::splat(simd, first);
    for i in 1..CELL_PX {
        let next = i32x16::splat(simd, first << (step * i as u32));
        shown |= count.simd_gt(i32x16::splat(simd, i)).select(next, zero);
    }
    shown
}
