//! Lists of triangles in one colour, each by the engine that is faster for its size.
//!
//! The tile engine sets up sixteen triangles at a time, and mixes where a span is only written: that
//! pays for small triangles. The scanline asks nothing of the pixels it does not cover: that pays for
//! all others. `docs/speed.md` has the measurements behind [`widest_px`]. Both are exact, so the rule
//! is about time alone; the order of the list is kept.
//!
//! In narrow vectors tiles are faster for cells alone, and a list that goes to and fro between the two
//! is slower than the scanline: there groups of cells alone go to the tiles. In wide ones a group goes
//! there if anything in it is small.

use crate::coverage::{CELL_PX, ListItem, SIDE_PX, Tiles};
use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::Corners;

/// Columns and rows of the largest box that tiles fill faster than the scanline: one tile in vectors
/// that hold half a row of it or more, else one cell.
#[must_use]
pub fn widest_px(tiles: &Tiles) -> i32 {
    match tiles.instructions() {
        "AVX2" | "AVX-512" => SIDE_PX,
        _ => CELL_PX,
    }
}

/// Triangles that go to the same engine.
const GROUP: usize = 64;

/// Fills triangles with one colour, in the order they are given.
pub fn fill(tiles: &Tiles, triangles: &[Corners], colour: u32, target: &mut Frame<u32>) {
    let widest = widest_px(tiles);
    let pay = |group: &[Corners]| {
        if widest > CELL_PX {
            group.iter().any(|corners| fits(corners, widest))
        } else {
            group.iter().all(|corners| fits(corners, CELL_PX))
        }
    };
    for group in triangles.chunks(GROUP) {
        if pay(group) {
            fill_list(tiles, group, colour, target);
        } else {
            group.iter().for_each(|&corners| fill_one(corners, colour, target));
        }
    }
}

/// Whether a triangle has room in a square of this side, wherever that begins.
#[inline]
fn fits([a, b, c]: &Corners, side_px: i32) -> bool {
    let along = |a: i32, b: i32, c: i32| {
        i64::from(a.max(b).max(c)) - i64::from(a.min(b).min(c)) < i64::from(side_px * SUBPIXELS)
    };
    along(a.x, b.x, c.x) && along(a.y, b.y, c.y)
}

/// By tiles, what is too large for them by the scanline.
fn fill_list(tiles: &Tiles, triangles: &[Corners], colour: u32, target: &mut Frame<u32>) {
    let bounds = target.bounds();
    tiles.cover_small(triangles, bounds, widest_px(tiles), &mut |part| match part {
        ListItem::Pieces(pieces) => tiles.fill(pieces, colour, target),
        ListItem::Left(number) => fill_one(triangles[number as usize], colour, target),
    });
}

#[inline]
fn fill_one(corners: Corners, colour: u32, target: &mut Frame<u32>) {
    Scanline.cover(corners, target.bounds(), |span| {
        fill_run(target.span_mut(span.y_px, span.x0_px, span.x1_px), colour);
    });
}

/// As `run.fill(value)`, with fewer branches that nothing predicts.
///
/// `fill` becomes a loop over blocks and one over what is left, and for runs whose lengths follow
/// no pattern each loop ends in a misprediction. Here the last block overlaps the one before it.
/// Filling large, medium and small triangles took 0.87, 0.72 and 0.84 of the time with `fill`. The
/// shortest are asked for first: with one branch fewer slivers took 0.92 of the time.
#[inline]
pub fn fill_run(run: &mut [u32], value: u32) {
    let pixels = run.len();
    if pixels < 4 {
        // One, two or three pixels.
        if pixels > 0 {
            (run[0], run[pixels / 2], run[pixels - 1]) = (value, value, value);
        }
    } else if let Some(last) = run.last_chunk_mut::<8>() {
        *last = [value; 8];
        for block in run.as_chunks_mut::<8>().0 {
            *block = [value; 8];
        }
    } else if let Some(last) = run.last_chunk_mut::<4>() {
        *last = [value; 4];
        run[..4].fill(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_filled_and_nothing_else() {
        for pixels in 0..40 {
            let mut row = [0; 42];
            fill_run(&mut row[1..1 + pixels], 7);
            let expected =
                std::array::from_fn(|x| if (1..1 + pixels).contains(&x) { 7 } else { 0 });
            assert_eq!(row, expected, "{pixels} px");
        }
    }
}
