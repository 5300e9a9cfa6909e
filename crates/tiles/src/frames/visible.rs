//! Which piece is seen at each pixel of a tile: depth tests, sixteen pixels at a time. They are coloured
//! when all pieces have been drawn, so that what is covered later costs no colours.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x16, mask32x16, u32x16};

use super::buffer::{Buffer, PAIR_PX, load_colours, load_depths, store_colours, store_depths};
use super::planes::Depth;
use crate::coverage::CELL_PX;

/// Columns and rows of the pixels of a pair.
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
pub(super) struct VisibleBlock {
    /// What stands in their place in the buffer of colours until they are coloured, from 1 on.
    pub number: u32,
    /// Column and row of the first one in the tile.
    pub left: u8,
    pub top: u8,
    pub is_cell: bool,
}

/// How a piece is drawn before it is coloured.
pub(super) struct VisibilityPass {
    /// As [`VisibleBlock`] has it.
    pub number: u32,
    /// Nothing where depths are not tested.
    pub depth: Option<Depth>,
}

impl VisibilityPass {
    /// Draws what is covered at the centres of pixels: of a row its bits, from column `left` of the tile on, four rows at a
    /// time: as one cell where four columns hold what is covered, else as pairs, each from the first column that is covered on.
    #[inline(always)]
    pub fn rows<S: Simd, T: Copy + Into<u64>>(
        &self,
        simd: S,
        [left, top]: [i32; 2],
        rows: &[T],
        buffer: &mut Buffer,
        seen: &mut Vec<VisibleBlock>,
    ) {
        for (top, rows) in (top..).step_by(4).zip(rows.chunks(4)) {
            let row = |i: usize| rows.get(i).map_or(0, |&row| row.into());
            let (a, b, c, d) = (row(0), row(1), row(2), row(3));
            let any = a | b | c | d;
            if any == 0 {
                continue;
            }
            let first = any.trailing_zeros();
            if any >> first < 1 << CELL_PX {
                let mask = a >> first | b >> first << 4 | c >> first << 8 | d >> first << 12;
                let at = [left + first as i32, top];
                self.pixels::<S, CELL_PX>(simd, at, mask as u32, buffer, seen);
                continue;
            }
            for (top, mut above, mut below) in [(top, a, b), (top + 2, c, d)] {
                let mut left = left;
                while above | below != 0 {
                    let first = (above | below).trailing_zeros();
                    (above, below, left) = (above >> first, below >> first, left + first as i32);
                    let mask = (above & 0xff) as u32 | ((below & 0xff) as u32) << PAIR_PX;
                    self.pixels::<S, PAIR_PX>(simd, [left, top], mask, buffer, seen);
                    (above, below, left) = (above >> PAIR_PX, below >> PAIR_PX, left + PAIR_PX);
                }
            }
        }
    }

    /// Pixels of a rectangle of sixteen, `SIDE` columns wide, from the column and row of the tile that are given on; bit i is
    /// pixel i, row by row.
    #[inline(always)]
    pub fn pixels<S: Simd, const SIDE: i32>(
        &self,
        simd: S,
        [left, top]: [i32; 2],
        mask: u32,
        buffer: &mut Buffer,
        seen: &mut Vec<VisibleBlock>,
    ) {
        let at_px = [left + buffer.rect.x0, top + buffer.rect.y0];
        let plane = &mut buffer.planes[0];
        let mut visible = mask32x16::from_bitmask(simd, u64::from(mask));
        if let Some(depth) = &self.depth {
            let place = if SIDE == PAIR_PX { &PAIR } else { &CELL };
            let (x, y) = beside(simd, place, depth.first_px, at_px);
            let before = load_depths::<S, SIDE>(simd, &plane.depths, left, top);
            let depth = depth.at(x, y);
            visible &= depth.simd_lt(before);
            if visible.to_bitmask() == 0 {
                return;
            }
            store_depths::<S, SIDE>(visible.select(depth, before), &mut plane.depths, left, top);
        }
        let before = load_colours::<S, SIDE>(simd, &plane.colours, left, top);
        let number = u32x16::splat(simd, self.number);
        let colours = visible.select(number, before);
        store_colours::<S, SIDE>(colours, &mut plane.colours, left, top);
        let (left, top) = (left as u8, top as u8);
        seen.push(VisibleBlock { number: self.number, left, top, is_cell: SIDE == CELL_PX });
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
