//! Four samples a pixel: which of them the pieces of one triangle cover, as masks of the rows of a
//! tile.

use super::buffer::SIDE_PX;
use crate::coverage::Piece;
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

/// Of each row of a tile, of each place, bit i for column i.
pub(super) struct Masks {
    pub rows: [[u64; PLACES]; SIDE_PX as usize],
    /// The rows that are not empty lie between.
    pub first: usize,
    pub end: usize,
}

impl Masks {
    pub fn new() -> Self {
        Self { rows: [[0; PLACES]; SIDE_PX as usize], first: SIDE_PX as usize, end: 0 }
    }

    pub fn clear(&mut self) {
        self.rows[self.first.min(self.end)..self.end].fill([0; PLACES]);
        (self.first, self.end) = (SIDE_PX as usize, 0);
    }

    /// Adds what a triangle covers of `tile` at a place.
    pub fn add(&mut self, piece: &Piece, place: usize, tile: PixelRect) {
        let mut or = |y: usize, bits: u64| {
            if let Some(row) = self.rows.get_mut(y) {
                row[place] |= bits;
            }
        };
        let (y, count) = match piece {
            Piece::Cell(cell) => {
                let (x, y) = ((cell.x_px - tile.x0) as u32, (cell.y_px - tile.y0) as usize);
                for j in 0..4 {
                    or(y + j, u64::from(cell.pixels >> (4 * j) & 0xf) << x);
                }
                (y, 4)
            }
            Piece::Quarter(quarter) => {
                let (x, y) = ((quarter.x_px - tile.x0) as u32, (quarter.y_px - tile.y0) as usize);
                for (j, byte) in quarter.pixels.to_le_bytes().into_iter().enumerate() {
                    or(y + j, u64::from(byte) << x);
                }
                (y, 8)
            }
            Piece::Tile(covered) => {
                let (x, y) = ((covered.x_px - tile.x0) as u32, (covered.y_px - tile.y0) as usize);
                for (j, &row) in covered.rows.iter().enumerate() {
                    or(y + j, u64::from(row) << x);
                }
                (y, 16)
            }
            Piece::Block(block) => {
                let (x, y) = ((block.rect.x0 - tile.x0) as u32, (block.rect.y0 - tile.y0) as usize);
                let (width, height) = (block.rect.width(), block.rect.height() as usize);
                for j in 0..height {
                    or(y + j, u64::MAX >> (64 - width) << x);
                }
                (y, height)
            }
        };
        self.first = self.first.min(y);
        self.end = self.end.max(y + count).min(SIDE_PX as usize);
    }
}
