//! One colour in the pixels of pieces, a row of a tile at a time.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, mask32x16, u16x16, u32x16};

use super::{Piece, SIDE_PX, Tile};
use crate::frame::Frame;
use crate::grid::PixelRect;

#[inline(always)]
pub(super) fn fill<S: Simd>(simd: S, pieces: &[Piece], colour: u32, target: &mut Frame<u32>) {
    let ink = u32x16::splat(simd, colour);
    for piece in pieces {
        match piece {
            Piece::Tile(tile) => fill_tile(simd, tile, ink, colour, target),
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

#[inline(always)]
fn fill_tile<S: Simd>(simd: S, tile: &Tile, ink: u32x16<S>, colour: u32, target: &mut Frame<u32>) {
    let bounds = target.bounds();
    if tile.x_px < bounds.x0 || tile.x_px + SIDE_PX > bounds.x1 {
        // At the border there are no sixteen pixels to read and write.
        tile.spans(|span| target.span_mut(span.y_px, span.x0_px, span.x1_px).fill(colour));
        return;
    }
    let rows = u16x16::load_array_ref(simd, &tile.rows);
    let mut left = rows.simd_ne(0).to_bitmask() as u32;
    while left != 0 {
        let row = left.trailing_zeros();
        left &= left - 1;
        let mask = mask32x16::from_bitmask(simd, u64::from(tile.rows[row as usize & 15]));
        let run = target.span_mut(tile.y_px + row as i32, tile.x_px, tile.x_px + SIDE_PX);
        if let Some(run) = run.first_chunk_mut::<16>() {
            *run = mask.select(ink, u32x16::load_array_ref(simd, run)).to_array();
        }
    }
}
