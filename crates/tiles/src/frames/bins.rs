//! Which pieces touch which tile, in parts of a scene, one after the other.

use super::buffer::{SIDE_PX, Touched};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS};
use rasterproof_core::parallel;
use rasterproof_core::triangle::Corners;
use rasterproof_render::effects::geometry::{Outline, Whole};

/// Pieces of a part, at least: enough to be worth a task.
const PART: usize = 2048;

/// The pieces of a scene, for each tile.
pub(super) struct Bins {
    pub tiles: Tiling,
    parts: Vec<MeshPart>,
}

/// A piece, and the pixels of the window where it may cover a place that is asked for, at least one.
pub(super) struct Placed {
    pub outline: Outline,
    pub touched: Touched,
}

/// Some pieces in a row.
struct MeshPart {
    pieces: Vec<Placed>,
    /// Numbers of pieces, tile by tile, in their order.
    touching: Vec<u32>,
    /// Where those of each tile begin, and where the last ones end.
    starts: Vec<u32>,
}

impl Bins {
    /// Of every piece, on the threads of the pool that it is called in. With samples beside the
    /// centres pieces reach farther.
    pub fn new(whole: &Whole<'_>, tiles: Tiling) -> Self {
        // Each part has a list of tiles, so it has as many pieces at least.
        let most = PART.max(tiles.count());
        let parts = if whole.depth_test {
            let runs = whole.runs(most);
            parallel::map(runs.len(), |part| {
                let mut pieces = Vec::with_capacity(runs[part].1.len());
                whole.outlines(&runs[part], &mut |outline| pieces.extend(tiles.placed(outline)));
                MeshPart::new(pieces, &tiles)
            })
        } else {
            let outlines = whole.farthest_first();
            let parts: Vec<_> = outlines.chunks(most).collect();
            parallel::map(parts.len(), |part| {
                MeshPart::new(parts[part].iter().filter_map(|&o| tiles.placed(o)).collect(), &tiles)
            })
        };
        Self { tiles, parts }
    }

    /// The pieces that touch a tile, in drawing order.
    pub fn of(&self, tile: usize) -> impl Iterator<Item = &Placed> {
        self.parts.iter().flat_map(move |part| {
            let range = part.starts[tile] as usize..part.starts[tile + 1] as usize;
            part.touching[range].iter().map(|&number| &part.pieces[number as usize])
        })
    }
}

impl MeshPart {
    fn new(pieces: Vec<Placed>, tiles: &Tiling) -> Self {
        let mut starts = vec![0; tiles.count() + 1];
        for piece in &pieces {
            tiles.touched(piece.touched, &mut |tile| starts[tile + 1] += 1);
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let mut touching = vec![0; sum as usize];
        let mut next = starts.clone();
        for (number, piece) in (0..).zip(&pieces) {
            tiles.touched(piece.touched, &mut |tile| {
                touching[next[tile] as usize] = number;
                next[tile] += 1;
            });
        }
        Self { pieces, touching, starts }
    }
}

pub(super) struct Tiling {
    window: PixelRect,
    pub across: usize,
    down: usize,
    /// From the centre of a pixel to the farthest place that is asked for, in subpixels.
    reach: i32,
}

impl Tiling {
    pub fn new(window: PixelRect, reach: i32) -> Self {
        let tiles = |side: u32| side.div_ceil(SIDE_PX as u32) as usize;
        Self { window, across: tiles(window.width()), down: tiles(window.height()), reach }
    }

    pub fn count(&self) -> usize {
        self.across * self.down
    }

    /// The pixels of tile `number`, row by row.
    pub fn rect(&self, number: usize) -> PixelRect {
        let (x, y) = ((number % self.across) as i32, (number / self.across) as i32);
        let (x0, y0) = (x * SIDE_PX, y * SIDE_PX);
        PixelRect { x0, y0, x1: x0 + SIDE_PX, y1: y0 + SIDE_PX }.intersect(&self.window)
    }

    /// The numbers of the tiles that a piece may touch.
    #[inline]
    fn touched(&self, Touched { x0, y0, x1, y1 }: Touched, take: &mut impl FnMut(usize)) {
        let tile = |px: u16| usize::from(px) / SIDE_PX as usize;
        for y in tile(y0)..=tile(y1) {
            for x in tile(x0)..=tile(x1) {
                take(y * self.across + x);
            }
        }
    }

    /// A piece, if it may cover a place that is asked for.
    #[inline]
    fn placed(&self, outline: Outline) -> Option<Placed> {
        let [a, b, c] = &outline.corners;
        let (x0, x1) = (a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
        let (y0, y1) = (a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y));
        // The first whose last place lies at `low` or after it, and the last whose first place lies
        // before `high` or at it. Pieces lie in the window, so nothing leaves i32.
        let first = |low: i32| (low - self.reach + (HALF_PIXEL - 1)) >> SUBPIXEL_BITS;
        let last = |high: i32| ((high + self.reach + HALF_PIXEL) >> SUBPIXEL_BITS) - 1;
        let (x0, x1) = (first(x0).max(0), last(x1).min(self.window.x1 - 1));
        let (y0, y1) = (first(y0).max(0), last(y1).min(self.window.y1 - 1));
        // Columns and rows of a window lie below 2^16.
        let touched = Touched { x0: x0 as u16, y0: y0 as u16, x1: x1 as u16, y1: y1 as u16 };
        (x0 <= x1 && y0 <= y1).then_some(Placed { outline, touched })
    }
}

#[inline]
pub(super) fn reached([a, b, c]: &Corners, window: PixelRect) -> PixelRect {
    let low = |a: i32, b: i32, c: i32| a.min(b).min(c) >> SUBPIXEL_BITS;
    let high = |a: i32, b: i32, c: i32| (a.max(b).max(c) >> SUBPIXEL_BITS) + 1;
    PixelRect {
        x0: low(a.x, b.x, c.x),
        y0: low(a.y, b.y, c.y),
        x1: high(a.x, b.x, c.x),
        y1: high(a.y, b.y, c.y),
    }
    .intersect(&window)
}
