//! A triangle in tiles, stepped in i32, sixteen pixels or sixteen tiles at a time.
//!
//! Vectors stay out of closures, and arrays of them are written out: a closure that is not inlined
//! is compiled without the instruction set of its caller.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, i32x16};

use super::setup::SteppedTriangle;
use super::{Block, Piece, QUARTER_PX, SIDE_PX, Tile};
use rasterproof_core::grid::PixelRect;

type Lanes<S> = i32x16<S>;

/// 0 to 15.
const COUNT: [i32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// Three vectors of E', one for each edge.
type Edges<S> = [Lanes<S>; 3];

/// Appends the pieces of a triangle, rows of tiles from the first pixel of its box on, each from left to right.
#[inline(always)]
pub(super) fn walk<S: Simd>(
    simd: S,
    triangle: &SteppedTriangle<i32>,
    number: u32,
    out: &mut Vec<Piece>,
) {
    let PixelRect { x0, y0, x1, y1 } = triangle.rect;
    if x1 - x0 > SIDE_PX || y1 - y0 > SIDE_PX {
        tiles(simd, triangle, number, out);
        return;
    }
    if x1 - x0 > QUARTER_PX {
        tile(simd, triangle, columns(simd, &triangle.right), number, out);
    } else {
        half(simd, triangle, number, out);
    }
}

/// [`COUNT`] of half a tile, twice.
const HALF_COUNT: [i32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7];
/// 0 in the first half, 1 in the second.
const SECOND: [i32; 16] = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1];

/// What of a triangle is in one tile, of which it takes half the columns or less: two rows at a time.
#[inline(always)]
fn half<S: Simd>(simd: S, triangle: &SteppedTriangle<i32>, number: u32, out: &mut Vec<Piece>) {
    let PixelRect { x0, y0, x1, y1 } = triangle.rect;
    let (start, right, down) = (triangle.start, triangle.right, triangle.down);
    let count = Lanes::load_array_ref(simd, &HALF_COUNT);
    let second = Lanes::load_array_ref(simd, &SECOND);
    let mut a = count * right[0] + (second * down[0] + start[0]);
    let mut b = count * right[1] + (second * down[1] + start[1]);
    let mut c = count * right[2] + (second * down[2] + start[2]);
    let (down_a, down_b, down_c) = (
        Lanes::splat(simd, 2 * down[0]),
        Lanes::splat(simd, 2 * down[1]),
        Lanes::splat(simd, 2 * down[2]),
    );
    let columns = (1u32 << (x1 - x0)) - 1;
    out.push(Piece::Tile(Tile { triangle: number, x_px: x0, y_px: y0, rows: [0; 16] }));
    let Some(Piece::Tile(Tile { rows, .. })) = out.last_mut() else { return };
    let height = (y1 - y0) as usize & 31;
    let looked_at = columns * 0x0101;
    let mut any = 0;
    for rows in rows.as_chunks_mut::<2>().0.iter_mut().take(height / 2) {
        let mask = none_negative([a, b, c]) & looked_at;
        *rows = [(mask & 0xff) as u16, (mask >> 8) as u16];
        any |= mask;
        (a, b, c) = (a + down_a, b + down_b, c + down_c);
    }
    if height % 2 == 1 {
        // The second half is beyond the box.
        let mask = none_negative([a, b, c]) & looked_at & 0xff;
        rows[(height - 1) & 15] = mask as u16;
        any |= mask;
    }
    if any == 0 {
        out.pop();
    }
}

/// What E' grows by from the first column to each.
#[inline(always)]
fn columns<S: Simd>(simd: S, right: &[i32; 3]) -> Edges<S> {
    let count = Lanes::load_array_ref(simd, &COUNT);
    [count * right[0], count * right[1], count * right[2]]
}

/// The lanes in which none of the three is negative.
#[inline(always)]
fn none_negative<S: Simd>([a, b, c]: Edges<S>) -> u32 {
    !((a | b | c).simd_lt(0).to_bitmask() as u32)
}

/// What of a triangle is in one tile, row by row.
#[inline(always)]
fn tile<S: Simd>(
    simd: S,
    triangle: &SteppedTriangle<i32>,
    [a, b, c]: Edges<S>,
    number: u32,
    out: &mut Vec<Piece>,
) {
    let PixelRect { x0, y0, x1, y1 } = triangle.rect;
    let (start, [down_a, down_b, down_c]) = (triangle.start, triangle.down);
    let (down_a, down_b, down_c) =
        (Lanes::splat(simd, down_a), Lanes::splat(simd, down_b), Lanes::splat(simd, down_c));
    let (mut a, mut b, mut c) = (a + start[0], b + start[1], c + start[2]);
    let looked_at = (1u32 << (x1 - x0)) - 1;
    out.push(Piece::Tile(Tile { triangle: number, x_px: x0, y_px: y0, rows: [0; 16] }));
    // In place: masks stored one by one and then moved together would wait for each other.
    let Some(Piece::Tile(Tile { rows, .. })) = out.last_mut() else { return };
    let mut any = 0;
    for row in rows.iter_mut().take((y1 - y0) as usize) {
        let mask = (none_negative([a, b, c]) & looked_at) as u16;
        *row = mask;
        any |= mask;
        (a, b, c) = (a + down_a, b + down_b, c + down_c);
    }
    if any == 0 {
        out.pop();
    }
}

/// Rows of tiles, sixteen tiles at a time: of each tile the corners where E' of an edge is largest
/// and smallest say that all of it is outside, or inside.
#[inline(always)]
fn tiles<S: Simd>(simd: S, triangle: &SteppedTriangle<i32>, number: u32, out: &mut Vec<Piece>) {
    let rect = triangle.rect;
    let columns = columns(simd, &triangle.right);
    let across = [columns[0] << 4, columns[1] << 4, columns[2] << 4];
    let (high, low) = (ends(triangle, i32::max), ends(triangle, i32::min));
    let right = triangle.right;
    let mut row = triangle.start;
    for y_px in (rect.y0..rect.y1).step_by(SIDE_PX as usize) {
        let mut start = row;
        for x_px in (rect.x0..rect.x1).step_by(16 * SIDE_PX as usize) {
            let tiles = [across[0] + start[0], across[1] + start[1], across[2] + start[2]];
            let count = (rect.x1 - x_px + SIDE_PX - 1) / SIDE_PX;
            let valid = if count < 16 { (1u32 << count) - 1 } else { 0xffff };
            let touched =
                valid & none_negative([tiles[0] + high[0], tiles[1] + high[1], tiles[2] + high[2]]);
            let whole =
                valid & none_negative([tiles[0] + low[0], tiles[1] + low[1], tiles[2] + low[2]]);
            let mut left = touched;
            while left != 0 {
                let at = left.trailing_zeros();
                let x_tile = x_px + at as i32 * SIDE_PX;
                let run = (whole >> at).trailing_ones();
                if run > 0 {
                    left &= !(((1u32 << run) - 1) << at);
                    let x_end = x_tile + run as i32 * SIDE_PX;
                    let block = PixelRect {
                        x0: x_tile,
                        y0: y_px,
                        x1: x_end.min(rect.x1),
                        y1: (y_px + SIDE_PX).min(rect.y1),
                    };
                    out.push(Piece::Block(Block { triangle: number, rect: block }));
                    continue;
                }
                left &= left - 1;
                let step = at as i32 * SIDE_PX;
                let first = [
                    start[0] + right[0] * step,
                    start[1] + right[1] * step,
                    start[2] + right[2] * step,
                ];
                let square = PixelRect {
                    x0: x_tile,
                    y0: y_px,
                    x1: (x_tile + SIDE_PX).min(rect.x1),
                    y1: (y_px + SIDE_PX).min(rect.y1),
                };
                let part =
                    SteppedTriangle { rect: square, start: first, right, down: triangle.down };
                if x_tile + QUARTER_PX < rect.x1 {
                    tile(simd, &part, columns, number, out);
                } else {
                    half(simd, &part, number, out);
                }
            }
            // The last of each leads beyond the padding and is not used.
            for (start, right) in start.iter_mut().zip(right) {
                *start = start.wrapping_add(right.wrapping_mul(16 * SIDE_PX));
            }
        }
        for (start, down) in row.iter_mut().zip(triangle.down) {
            *start = start.wrapping_add(down.wrapping_mul(SIDE_PX));
        }
    }
}

/// What E' of each edge differs by, from the first pixel of a tile to where it is largest, or
/// smallest.
#[inline(always)]
fn ends(triangle: &SteppedTriangle<i32>, choose: fn(i32, i32) -> i32) -> [i32; 3] {
    let end = |edge: usize| {
        let (right, down) = (triangle.right[edge], triangle.down[edge]);
        (SIDE_PX - 1) * (choose(right, 0) + choose(down, 0))
    };
    [end(0), end(1), end(2)]
}
