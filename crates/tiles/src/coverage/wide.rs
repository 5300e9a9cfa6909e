//! A triangle in tiles, stepped in i64: the largest of the domain, a few tiles at a time.
//!
//! The same walk as in `walk`, a tile and a row at a time. E' stays below 2^57, and 16 steps of less
//! than 2^33 beyond the box change that little.

use super::setup::{Single, SteppedTriangle};
use super::{Block, Piece, SIDE_PX, Tile};
use rasterproof_core::grid::PixelRect;

const LAST: i64 = SIDE_PX as i64 - 1;

/// Appends the pieces of a triangle, rows of tiles from the top down, each from left to right.
pub(super) fn walk(single: &Single, number: u32, out: &mut Vec<Piece>) {
    let SteppedTriangle { rect, start, right, down } = single.steps;
    for y_px in (rect.y0..rect.y1).step_by(SIDE_PX as usize) {
        let first_tile = rect.x0 & !(SIDE_PX - 1);
        for x_px in (first_tile..rect.x1).step_by(SIDE_PX as usize) {
            let (across, below) = (i64::from(x_px) - i64::from(rect.x0), i64::from(y_px - rect.y0));
            let (mut touched, mut whole) = (true, true);
            let mut first = [0; 3];
            for edge in 0..3 {
                let (right, down) = (right[edge], down[edge]);
                first[edge] = start[edge] + across * right + below * down;
                touched &= first[edge] + LAST * (right.max(0) + down.max(0)) >= 0;
                whole &= first[edge] + LAST * (right.min(0) + down.min(0)) >= 0;
            }
            let square = PixelRect {
                x0: x_px.max(rect.x0),
                y0: y_px,
                x1: rect.x1.min(x_px + SIDE_PX),
                y1: rect.y1.min(y_px + SIDE_PX),
            };
            if whole {
                out.push(Piece::Block(Block { triangle: number, rect: square }));
            } else if touched {
                tile(first, right, down, square, number, out);
            }
        }
    }
}

fn tile(
    mut row: [i64; 3],
    right: [i64; 3],
    down: [i64; 3],
    square: PixelRect,
    number: u32,
    out: &mut Vec<Piece>,
) {
    let x_tile = square.x0 & !(SIDE_PX - 1);
    let first = (square.x0 - x_tile) as u32;
    let before = i64::from(first);
    for edge in 0..3 {
        row[edge] += right[edge] * before;
    }
    let mut rows = [0; 16];
    for mask in rows.iter_mut().take(square.height() as usize) {
        let mut e = row;
        for column in first..first + square.width() {
            *mask |= u16::from((e[0] | e[1] | e[2]) >= 0) << column;
            e = [e[0] + right[0], e[1] + right[1], e[2] + right[2]];
        }
        row = [row[0] + down[0], row[1] + down[1], row[2] + down[2]];
    }
    if rows != [0; 16] {
        out.push(Piece::Tile(Tile { triangle: number, x_px: x_tile, y_px: square.y0, rows }));
    }
}
