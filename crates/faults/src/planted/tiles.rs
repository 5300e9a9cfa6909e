//! Tile engines with a planted fault each: they spoil the pieces of the real one the way real code
//! for vectors goes wrong.

use super::each_sample;
use rasterproof_core::geometry::centre_of;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_tiles::coverage::{CoverList, NARROW_EXTENT, Piece, SIDE_PX, Tile, Tiles};

planted! {
    TileMutant {
        WrappedWidth "tile-wrapped-width":
            "lists: extents wrap around, and the widest triangles are set up in i32",
        MaskOffByOne "tile-mask-off-by-one": "lists: the mask of columns ends one bit early",
        WrongReject "tile-wrong-reject":
            "lists: a tile is rejected when none of its corner pixels is covered",
        TailOfBatch "tile-tail-of-batch":
            "lists: what is left after the last full batch of sixteen is forgotten",
        WideOnesLast "tile-wide-ones-last":
            "lists: of a batch, triangles that need wide words come last",
    }
}

impl TileMutant {
    /// A piece with the fault of this mutant; nothing where no pixel is left of it.
    fn spoilt(self, piece: Piece) -> Option<Piece> {
        // Every kind of piece as a tile, the kind whose mask can hold any pixels.
        let mut tile = match piece {
            Piece::Cell(cell) => cell.tile(),
            Piece::Quarter(quarter) => quarter.tile(),
            Piece::Tile(tile) => tile,
            Piece::Block(_) => return Some(piece),
        };
        match self {
            Self::MaskOffByOne => {
                let mut columns = 0;
                for row in tile.rows {
                    columns |= row;
                }
                let last = columns.leading_zeros();
                for row in &mut tile.rows {
                    *row &= !(0x8000 >> last);
                }
            }
            Self::WrongReject => {
                let corners = (tile.rows[0] | tile.rows[15]) & 0x8001;
                tile.rows = if corners == 0 { [0; 16] } else { tile.rows };
            }
            _ => {}
        }
        (tile.rows != [0; 16]).then_some(Piece::Tile(tile))
    }
}

impl CoverList for TileMutant {
    fn cover_list(&self, triangles: &[Corners], bounds: PixelRect, take: &mut dyn FnMut(&[Piece])) {
        // The right pieces, spoilt one by one; the other faults are of the list.
        let mut pieces = Vec::new();
        Tiles::default().cover_list(triangles, bounds, &mut |run| pieces.extend_from_slice(run));
        pieces = pieces.into_iter().filter_map(|piece| self.spoilt(piece)).collect();
        match self {
            Self::WrappedWidth => {
                let wraps = |piece: &Piece| taken_for_narrow(&triangles[piece.triangle() as usize]);
                pieces.retain(|piece| !wraps(piece));
                for (number, corners) in triangles.iter().enumerate() {
                    if taken_for_narrow(corners) {
                        wrapping(corners, bounds, number as u32, &mut pieces);
                    }
                }
                pieces.sort_by_key(Piece::triangle);
            }
            Self::TailOfBatch if triangles.len() > 16 => {
                // What follows the last full batch is lost.
                let full = triangles.len() / 16 * 16;
                pieces.retain(|piece| (piece.triangle() as usize) < full);
            }
            Self::WideOnesLast => pieces.sort_by_key(|piece| {
                let number = piece.triangle();
                (number / 16, widest(&triangles[number as usize]) > i64::from(NARROW_EXTENT))
            }),
            _ => {}
        }
        if !pieces.is_empty() {
            take(&pieces);
        }
    }
}

/// The larger side of the box, in subpixels.
fn widest([a, b, c]: &Corners) -> i64 {
    let [width, height] = [[a.x, b.x, c.x], [a.y, b.y, c.y]]
        .map(|[a, b, c]| i64::from(a.max(b).max(c)) - i64::from(a.min(b).min(c)));
    width.max(height)
}

/// Whether the box is wide, but not after its sides have wrapped around.
fn taken_for_narrow(corners: &Corners) -> bool {
    let [a, b, c] = corners;
    let [width, height] = [[a.x, b.x, c.x], [a.y, b.y, c.y]]
        .map(|[a, b, c]| a.max(b).max(c).wrapping_sub(a.min(b).min(c)));
    width.max(height) <= NARROW_EXTENT && widest(corners) > i64::from(NARROW_EXTENT)
}

/// An edge function in 32 bits, less 1 where samples on the edge do not belong, so that 0 is inside.
fn wrapped_edge(from: SubpixelPoint, to: SubpixelPoint, sample: SubpixelPoint) -> i32 {
    let (dx, dy) = (to.x.wrapping_sub(from.x), to.y.wrapping_sub(from.y));
    let is_top_left = dy < 0 || (dy == 0 && dx > 0);
    dx.wrapping_mul(sample.y.wrapping_sub(from.y))
        .wrapping_sub(dy.wrapping_mul(sample.x.wrapping_sub(from.x)))
        .wrapping_sub(i32::from(!is_top_left))
}

/// The pixels of a triangle as the engine's words have it if they wrap around, one a piece.
fn wrapping(corners: &Corners, bounds: PixelRect, triangle: u32, pieces: &mut Vec<Piece>) {
    let [a, b, c] = *corners;
    let inside = |x_px, y_px| {
        let sample = centre_of(x_px, y_px);
        // Three numbers are at least 0 where none of them has the bit of the sign, in either order of the corners.
        wrapped_edge(a, b, sample) | wrapped_edge(b, c, sample) | wrapped_edge(c, a, sample) >= 0
            || wrapped_edge(a, c, sample) | wrapped_edge(c, b, sample) | wrapped_edge(b, a, sample)
                >= 0
    };
    each_sample(bounds, &inside, &mut |span| {
        let mut rows = [0; SIDE_PX as usize];
        rows[0] = 1;
        pieces.push(Piece::Tile(Tile { triangle, x_px: span.x0_px, y_px: span.y_px, rows }));
    });
}
