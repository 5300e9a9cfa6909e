//! What the pieces of one triangle cover of a tile, at the centre of each pixel or at four samples and the centre, as masks of
//! rows. Together, pieces beside each other need fewer pairs of sixteen pixels than one by one.

use super::buffer::SIDE_PX;
use crate::coverage::{Block, Piece};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;
use rasterproof_render::pipeline::multisample::{SAMPLES, onto_centre};

/// Coverages of a pixel: one for each sample, and that of its centre, where it is shaded if it can.
pub(super) const PLACES: usize = SAMPLES.len() + 1;

/// The number of the centre.
pub(super) const CENTRE: usize = SAMPLES.len();

/// A triangle as it is asked for at the samples, and at the centre. Without a pixel where it leaves
/// the lattice.
pub(super) fn places(corners: Corners) -> [Corners; PLACES] {
    let mut places = [corners; PLACES];
    for (place, sample) in places.iter_mut().zip(SAMPLES) {
        let [a, b, c] = corners;
        *place = match (onto_centre(a, sample), onto_centre(b, sample), onto_centre(c, sample)) {
            (Some(a), Some(b), Some(c)) => [a, b, c],
            _ => [a; 3],
        };
    }
    places
}

/// Rows of a tile, and below it as many as a piece that begins in the last one may have.
const ROWS: usize = SIDE_PX as usize + 16;

/// Of each row of a tile, of each of `N` places, bit i for column i.
pub(super) struct Masks<const N: usize> {
    rows: [[u64; N]; ROWS],
    /// The rows that are not empty lie between.
    first: usize,
    end: usize,
}

impl<const N: usize> Masks<N> {
    pub fn new() -> Self {
        Self { rows: [[0; N]; ROWS], first: ROWS, end: 0 }
    }

    /// The number of the first row that is not empty, and the rows from it on to the last one.
    pub fn used(&self) -> (usize, &[[u64; N]]) {
        let first = self.first.min(self.end);
        (first, &self.rows[first..self.end])
    }

    pub fn is_empty(&self) -> bool {
        self.end == 0
    }

    pub fn clear(&mut self) {
        self.rows[self.first.min(self.end)..self.end].fill([0; N]);
        (self.first, self.end) = (ROWS, 0);
    }

    /// Adds what a triangle covers of `tile` at a place.
    #[inline(always)]
    pub fn add(&mut self, piece: &Piece, place: usize, tile: PixelRect) {
        match piece {
            Piece::Cell(cell) => {
                let row = |j: u32| cell.pixels >> (4 * j) & 0xf;
                let at_px = [cell.x_px, cell.y_px];
                self.or(&[row(0), row(1), row(2), row(3)], place, at_px, tile);
            }
            Piece::Quarter(quarter) => {
                let at_px = [quarter.x_px, quarter.y_px];
                self.or(&quarter.pixels.to_le_bytes(), place, at_px, tile);
            }
            Piece::Tile(covered) => {
                self.or(&covered.rows, place, [covered.x_px, covered.y_px], tile);
            }
            Piece::Block(Block { rect, .. }) => {
                let all = [u64::MAX >> (64 - rect.width()); 16];
                let rows = &all[..rect.height() as usize];
                self.or(rows, place, [rect.x0, rect.y0], tile);
            }
        }
    }

    /// Rows from a pixel of the tile on.
    #[inline(always)]
    fn or<T: Copy + Into<u64>>(
        &mut self,
        bits: &[T],
        place: usize,
        [x_px, y_px]: [i32; 2],
        tile: PixelRect,
    ) {
        let (x, y) = (x_px - tile.x0, (y_px - tile.y0) as usize);
        for (row, &bits) in self.rows[y..][..bits.len()].iter_mut().zip(bits) {
            row[place] |= bits.into() << x;
        }
        self.first = self.first.min(y);
        self.end = self.end.max(y + bits.len());
    }
}
