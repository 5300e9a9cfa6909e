//! One colour in the pixels of pieces, a cell or a row of a tile at a time.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask32x8, mask32x16, u16x16, u32x4, u32x8, u32x16};

use super::{CELL_PX, Cell, Piece, QUARTER_PX, Quarter, SIDE_PX, Tile};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;

#[inline(always)]
pub(super) fn fill<S: Simd>(simd: S, pieces: &[Piece], colour: u32, target: &mut Frame<u32>) {
    let ink = u32x16::splat(simd, colour);
    for piece in pieces {
        match piece {
            Piece::Cell(cell) => fill_cell(simd, cell, ink, target),
            Piece::Quarter(quarter) => fill_quarter(simd, quarter, ink, target),
            Piece::Tile(tile) => fill_tile(simd, tile, ink, target),
            Piece::Block(block) => fill_block(block.rect, ink, colour, target),
        }
    }
}

#[inline(always)]
fn fill_block<S: Simd>(rect: PixelRect, ink: u32x16<S>, colour: u32, target: &mut Frame<u32>) {
    // Blocks begin and end with tiles, but for those at the sides of the box.
    let before = ((SIDE_PX - (rect.x0 & (SIDE_PX - 1))) & (SIDE_PX - 1)) as usize;
    for y_px in rect.y0..rect.y1 {
        let run = target.span_mut(y_px, rect.x0, rect.x1);
        let (before, run) = run.split_at_mut(before.min(run.len()));
        before.fill(colour);
        let (tiles, after) = run.as_chunks_mut::<16>();
        for tile in tiles {
            *tile = ink.to_array();
        }
        after.fill(colour);
    }
}

/// At the border, where there are not so many pixels to read and write.
fn fill_spans(tile: &Tile, colour: u32, target: &mut Frame<u32>) {
    tile.spans(|span| target.span_mut(span.y_px, span.x0_px, span.x1_px).fill(colour));
}

/// All sixteen pixels are read, mixed and written, since nothing predicts which are covered. Rows after
/// the last that is covered are that one again, so that nothing else has to arrive from memory: it is
/// written first as it was, then as it is.
#[inline(always)]
fn fill_cell<S: Simd>(simd: S, cell: &Cell, ink: u32x16<S>, target: &mut Frame<u32>) {
    if cell.x_px + CELL_PX > target.bounds().x1 {
        fill_spans(&cell.tile(), ink[0], target);
        return;
    }
    let last = (31 - (u32::from(cell.pixels) | 1).leading_zeros()) as usize / 4;
    let (pitch, from) = (target.pitch(), target.tail_mut(cell.x_px, cell.y_px));
    let Some(from) = from.get_mut(..last * pitch + CELL_PX as usize) else { return };
    let at = [0, last.min(1) * pitch, last.min(2) * pitch, last * pitch];
    let a = u32x4::from_slice(simd, &from[..4]);
    let b = u32x4::from_slice(simd, &from[at[1]..][..4]);
    let c = u32x4::from_slice(simd, &from[at[2]..][..4]);
    let d = u32x4::from_slice(simd, &from[at[3]..][..4]);
    let before = a.combine(b).combine(c.combine(d));
    let mask = mask32x16::from_bitmask(simd, u64::from(cell.pixels));
    let (above, below) = mask.select(ink, before).split();
    let ((a, b), (c, d)) = (above.split(), below.split());
    d.store_slice(&mut from[at[3]..][..4]);
    c.store_slice(&mut from[at[2]..][..4]);
    b.store_slice(&mut from[at[1]..][..4]);
    a.store_slice(&mut from[..4]);
}

#[inline(always)]
fn fill_tile<S: Simd>(simd: S, tile: &Tile, ink: u32x16<S>, target: &mut Frame<u32>) {
    let bounds = target.bounds();
    let rows = u16x16::load_array_ref(simd, &tile.rows);
    let left = rows.simd_ne(0).to_bitmask() as u32;
    let narrow = rows.simd_gt(0xff).to_bitmask() == 0;
    let width = if narrow { SIDE_PX / 2 } else { SIDE_PX };
    if tile.x_px < bounds.x0 || tile.x_px + width > bounds.x1 {
        fill_spans(tile, ink[0], target);
        return;
    }
    // Rows between that cover nothing stay what they are.
    let first = left.trailing_zeros() as i32;
    let rows = &tile.rows[first as usize & 15..];
    let count = (32 - left.leading_zeros() as i32 - first) as usize;
    let pitch = target.pitch();
    let from = target.tail_mut(tile.x_px, tile.y_px + first);
    let lines = from.chunks_mut(pitch).zip(rows).take(count);
    if narrow {
        let (ink, _) = ink.split();
        for (line, &row) in lines {
            let Some(run) = line.first_chunk_mut::<8>() else { return };
            let mask = mask32x8::from_bitmask(simd, u64::from(row));
            *run = mask.select(ink, u32x8::load_array_ref(simd, run)).to_array();
        }
    } else {
        for (line, &row) in lines {
            let Some(run) = line.first_chunk_mut::<16>() else { return };
            let mask = mask32x16::from_bitmask(simd, u64::from(row));
            *run = mask.select(ink, u32x16::load_array_ref(simd, run)).to_array();
        }
    }
}

/// The bits of four rows of a quarter in a word.
const BITS: [[u32; 8]; 4] = {
    let mut bits = [[0; 8]; 4];
    let mut at = 0;
    while at < 32 {
        bits[at / 8][at % 8] = 1 << at;
        at += 1;
    }
    bits
};

/// Always eight rows, since nothing predicts how many there are: the last one again and again. All are
/// read before any is written, so that reads that miss the cache wait together; and the last is written
/// first, since what is after the last has nothing of it.
#[inline(always)]
fn fill_quarter<S: Simd>(simd: S, quarter: &Quarter, ink: u32x16<S>, target: &mut Frame<u32>) {
    let pixels = quarter.pixels;
    if quarter.x_px + QUARTER_PX > target.bounds().x1 {
        fill_spans(&quarter.tile(), ink[0], target);
        return;
    }
    let last = (63 - (pixels | 1).leading_zeros()) as usize / 8;
    let pitch = target.pitch();
    let from = target.tail_mut(quarter.x_px, quarter.y_px);
    let Some(from) = from.get_mut(..last * pitch + 8) else { return };
    let (ink, _) = ink.split();
    let halves = [u32x8::splat(simd, pixels as u32), u32x8::splat(simd, (pixels >> 32) as u32)];
    let mut rows = [ink; 8];
    for (j, row) in rows.iter_mut().enumerate() {
        let Some(run) = from[j.min(last) * pitch..].first_chunk::<8>() else { return };
        let bits = u32x8::load_array_ref(simd, &BITS[j % 4]);
        let mask = (halves[j / 4] & bits).simd_eq(bits);
        *row = mask.select(ink, u32x8::load_array_ref(simd, run));
    }
    for (j, row) in rows.iter().enumerate().rev() {
        let Some(run) = from[j.min(last) * pitch..].first_chunk_mut::<8>() else { return };
        *run = row.to_array();
    }
}
