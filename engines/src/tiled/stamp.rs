//! Which piece is seen at each pixel of a tile: depth tests, sixteen pixels at a time. They are coloured
//! when all pieces have been drawn, so that what is covered later costs no colours.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x8, f32x16, mask32x16, u32x4, u32x8, u32x16};

use super::buffer::Buffer;
use super::planes::Depth;
use crate::grid::PixelRect;
use crate::tile::{Block, CELL_PX, Piece, SIDE_PX};

/// Columns of a pair: two runs of eight pixels, one below the other, which small triangles fill
/// better than one run of sixteen.
pub(super) const PAIR_PX: i32 = 8;
/// Columns and rows of its pixels.
pub(super) const PAIR: Place = Place {
    columns: [0., 1., 2., 3., 4., 5., 6., 7., 0., 1., 2., 3., 4., 5., 6., 7.],
    rows: [0., 0., 0., 0., 0., 0., 0., 0., 1., 1., 1., 1., 1., 1., 1., 1.],
};
/// Columns and rows of the pixels of a cell.
pub(super) const CELL: Place = Place {
    columns: [0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3., 0., 1., 2., 3.],
    rows: [0., 0., 0., 0., 1., 1., 1., 1., 2., 2., 2., 2., 3., 3., 3., 3.],
};

/// Where sixteen pixels lie, from the first.
pub(super) struct Place {
    columns: [f32; 16],
    rows: [f32; 16],
}

/// Sixteen pixels of a tile, some of which showed a piece when it was drawn: a pair or a cell.
#[derive(Clone, Copy)]
pub(super) struct Stamp {
    /// What stands in their place in the buffer of colours until they are coloured, from 1 on.
    pub number: u32,
    /// Column and row of the first one in the tile.
    pub left: u8,
    pub top: u8,
    /// Whether it is a cell.
    pub is_cell: bool,
}

/// How a piece is drawn before it is coloured.
pub(super) struct Pencil {
    /// As [`Stamp`] has it.
    pub number: u32,
    /// Nothing where depths are not tested.
    pub depth: Option<Depth>,
}

impl Pencil {
    /// Draws what is covered at the centres of pixels.
    #[inline(always)]
    pub fn piece<S: Simd>(
        &self,
        simd: S,
        covered: &Piece,
        buffer: &mut Buffer,
        stamps: &mut Vec<Stamp>,
    ) {
        let (rect, tile) = match covered {
            Piece::Cell(cell) => {
                let (at_px, mask) = ([cell.x_px, cell.y_px], u32::from(cell.pixels));
                self.pixels::<S, { CELL_PX }>(simd, at_px, mask, buffer, stamps);
                return;
            }
            Piece::Tile(tile) => {
                let (x0, y0) = (tile.x_px, tile.y_px);
                (PixelRect { x0, y0, x1: x0 + SIDE_PX, y1: y0 + SIDE_PX }, Some(tile))
            }
            Piece::Block(Block { rect, .. }) => (*rect, None),
        };
        for y_px in (rect.y0..rect.y1).step_by(2) {
            for x_px in (rect.x0..rect.x1).step_by(PAIR_PX as usize) {
                let [above, below] = match tile {
                    Some(tile) => {
                        let (row, column) = ((y_px - rect.y0) as usize & 14, x_px - rect.x0);
                        let run = |row: u16| u32::from(row) >> column & 0xff;
                        [run(tile.rows[row]), run(tile.rows[row + 1])]
                    }
                    None => {
                        let run = 0xff >> (PAIR_PX - (rect.x1 - x_px).min(PAIR_PX));
                        [run, if y_px + 1 < rect.y1 { run } else { 0 }]
                    }
                };
                let mask = above | below << PAIR_PX;
                if mask != 0 {
                    self.pixels::<S, { PAIR_PX }>(simd, [x_px, y_px], mask, buffer, stamps);
                }
            }
        }
    }

    /// Pixels of a rectangle of sixteen, `SIDE` columns wide, from the one that is given on; bit i is
    /// pixel i, row by row.
    #[inline(always)]
    fn pixels<S: Simd, const SIDE: i32>(
        &self,
        simd: S,
        [x_px, y_px]: [i32; 2],
        mask: u32,
        buffer: &mut Buffer,
        stamps: &mut Vec<Stamp>,
    ) {
        let (left, top) = (x_px - buffer.rect.x0, y_px - buffer.rect.y0);
        let plane = &mut buffer.planes[0];
        let mut visible = mask32x16::from_bitmask(simd, u64::from(mask));
        if let Some(depth) = &self.depth {
            let place = if SIDE == PAIR_PX { &PAIR } else { &CELL };
            let (x, y) = beside(simd, place, depth.first_px, [x_px, y_px]);
            let pitch = plane.depths.pitch();
            let depths = plane.depths.tail_mut(left, top);
            let before = load_depths::<S, SIDE>(simd, depths, pitch);
            let depth = depth.at(x, y);
            visible &= depth.simd_lt(before);
            if visible.to_bitmask() == 0 {
                return;
            }
            store_depths::<S, SIDE>(visible.select(depth, before), depths, pitch);
        }
        let pitch = plane.colours.pitch();
        let run = plane.colours.tail_mut(left, top);
        let before = load_colours::<S, SIDE>(simd, run, pitch);
        let number = u32x16::splat(simd, self.number);
        store_colours::<S, SIDE>(visible.select(number, before), run, pitch);
        let (left, top) = (left as u8, top as u8);
        stamps.push(Stamp { number: self.number, left, top, is_cell: SIDE == CELL_PX });
    }
}

/// Sixteen pixels of which the first is given, counted from another pixel.
#[inline(always)]
pub(super) fn beside<S: Simd>(
    simd: S,
    place: &Place,
    [x0, y0]: [i32; 2],
    [x_px, y_px]: [i32; 2],
) -> (f32x16<S>, f32x16<S>) {
    let x = f32x16::load_array_ref(simd, &place.columns) + (x_px - x0) as f32;
    (x, f32x16::load_array_ref(simd, &place.rows) + (y_px - y0) as f32)
}

/// Loading and storing a rectangle of sixteen pixels, `SIDE` columns wide, in rows that lie `pitch` apart.
macro_rules! rectangles {
    ($load:ident, $store:ident, $pixel:ty, $four:ident, $eight:ident, $all:ident) => {
        #[inline(always)]
        pub(super) fn $load<S: Simd, const SIDE: i32>(
            simd: S,
            from: &[$pixel],
            pitch: usize,
        ) -> $all<S> {
            if SIDE == PAIR_PX {
                let (above, below) = (&from[..8], &from[pitch..][..8]);
                return $eight::from_slice(simd, above).combine($eight::from_slice(simd, below));
            }
            let [a, b] = [&from[..4], &from[pitch..][..4]];
            let [c, d] = [&from[2 * pitch..][..4], &from[3 * pitch..][..4]];
            let above = $four::from_slice(simd, a).combine($four::from_slice(simd, b));
            above.combine($four::from_slice(simd, c).combine($four::from_slice(simd, d)))
        }

        #[inline(always)]
        pub(super) fn $store<S: Simd, const SIDE: i32>(
            values: $all<S>,
            to: &mut [$pixel],
            pitch: usize,
        ) {
            let (above, below) = values.split();
            if SIDE == PAIR_PX {
                above.store_slice(&mut to[..8]);
                below.store_slice(&mut to[pitch..][..8]);
                return;
            }
            let ((a, b), (c, d)) = (above.split(), below.split());
            a.store_slice(&mut to[..4]);
            b.store_slice(&mut to[pitch..][..4]);
            c.store_slice(&mut to[2 * pitch..][..4]);
            d.store_slice(&mut to[3 * pitch..][..4]);
        }
    };
}

rectangles!(load_depths, store_depths, f32, f32x4, f32x8, f32x16);
rectangles!(load_colours, store_colours, u32, u32x4, u32x8, u32x16);
