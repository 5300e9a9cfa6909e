//! The colours and depths of one tile of a frame.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f32x8, f32x16, u32x4, u32x8, u32x16};

use crate::coverage::CELL_PX;
use rasterproof_core::grid::PixelRect;

/// Columns and rows of a tile of a frame.
pub const SIDE_PX: i32 = 64;

/// Columns and rows of a block of a tile, whose farthest depth is known.
const BLOCK_PX: i32 = 16;
const BLOCKS: i32 = SIDE_PX / BLOCK_PX;

/// A block's farthest depth is looked for again after it was drawn into so many times: looking costs
/// about a row of pixels.
const STALE: u8 = 8;

/// Columns of a pair: two runs of eight pixels, one below the other, which small triangles fill
/// better than one run of sixteen.
pub(super) const PAIR_PX: i32 = 8;
/// From row to row of a [`TilePlane`].
const PITCH: usize = (SIDE_PX + PAIR_PX) as usize;

/// One number for every pixel of a tile. Beyond its right and lower side there is room for the pairs
/// and cells that begin in it. Columns and rows count from its first pixel.
pub(super) struct TilePlane<T>(Vec<T>);

impl<T: Copy> TilePlane<T> {
    fn new(value: T) -> Self {
        Self(vec![value; PITCH * (SIDE_PX + CELL_PX - 1) as usize])
    }

    /// The room beyond may hold anything: nothing of it is ever seen.
    fn fill(&mut self, value: T) {
        self.0[..PITCH * SIDE_PX as usize].fill(value);
    }

    /// Row `y`.
    #[inline(always)]
    pub fn row(&self, y: i32) -> &[T; SIDE_PX as usize] {
        self.run(0, y)
    }

    /// As [`TilePlane::row`].
    #[inline(always)]
    fn row_mut(&mut self, y: i32) -> &mut [T; SIDE_PX as usize] {
        self.run_mut(0, y)
    }

    /// So many from a pixel on: a part of its row, and of those below.
    #[inline(always)]
    pub fn run<const N: usize>(&self, left: i32, top: i32) -> &[T; N] {
        let run = self.0[top as usize * PITCH + left as usize..].first_chunk();
        run.expect("there is room for what begins in a tile")
    }

    /// As [`TilePlane::run`].
    #[inline(always)]
    pub fn run_mut<const N: usize>(&mut self, left: i32, top: i32) -> &mut [T; N] {
        let run = self.0[top as usize * PITCH + left as usize..].first_chunk_mut();
        run.expect("there is room for what begins in a tile")
    }
}

/// From the first pixel of a pair past its last, row by row of a plane.
const PAIR_RUN: usize = PITCH + PAIR_PX as usize;
const CELL_RUN: usize = 3 * PITCH + CELL_PX as usize;

/// Loading and storing sixteen pixels of a plane, a pair or a cell by its columns, `SIDE`.
macro_rules! rectangles {
    ($load:ident, $store:ident, $pixel:ty, $four:ident, $eight:ident, $all:ident) => {
        #[inline(always)]
        pub(super) fn $load<S: Simd, const SIDE: i32>(
            simd: S,
            from: &TilePlane<$pixel>,
            left: i32,
            top: i32,
        ) -> $all<S> {
            if SIDE == PAIR_PX {
                let run = from.run::<PAIR_RUN>(left, top);
                let (above, below) = (&run[..8], &run[PITCH..][..8]);
                return $eight::from_slice(simd, above).combine($eight::from_slice(simd, below));
            }
            let run = from.run::<CELL_RUN>(left, top);
            let [a, b] = [&run[..4], &run[PITCH..][..4]];
            let [c, d] = [&run[2 * PITCH..][..4], &run[3 * PITCH..][..4]];
            let above = $four::from_slice(simd, a).combine($four::from_slice(simd, b));
            above.combine($four::from_slice(simd, c).combine($four::from_slice(simd, d)))
        }

        #[inline(always)]
        pub(super) fn $store<S: Simd, const SIDE: i32>(
            values: $all<S>,
            to: &mut TilePlane<$pixel>,
            left: i32,
            top: i32,
        ) {
            let (above, below) = values.split();
            if SIDE == PAIR_PX {
                let run = to.run_mut::<PAIR_RUN>(left, top);
                above.store_slice(&mut run[..8]);
                below.store_slice(&mut run[PITCH..][..8]);
                return;
            }
            let run = to.run_mut::<CELL_RUN>(left, top);
            let ((a, b), (c, d)) = (above.split(), below.split());
            a.store_slice(&mut run[..4]);
            b.store_slice(&mut run[PITCH..][..4]);
            c.store_slice(&mut run[2 * PITCH..][..4]);
            d.store_slice(&mut run[3 * PITCH..][..4]);
        }
    };
}

rectangles!(load_depths, store_depths, f32, f32x4, f32x8, f32x16);
rectangles!(load_colours, store_colours, u32, u32x4, u32x8, u32x16);

/// One sample of every pixel of a tile.
pub(super) struct TileSample {
    /// Opaque; with one sample a pixel, until it is coloured, the number of what is seen there, below
    /// every colour, and 0 for nothing.
    pub colours: TilePlane<u32>,
    /// Smaller is nearer; infinite where nothing has been drawn.
    pub depths: TilePlane<f32>,
}

/// The first and the last column and row of some pixels of a window.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touched {
    pub x0: u16,
    pub y0: u16,
    pub x1: u16,
    pub y1: u16,
}

/// Columns and rows of blocks of a tile.
pub(super) struct Blocks {
    columns: Range<i32>,
    rows: Range<i32>,
}

/// Colours and depths of one tile, owned by who draws it: nothing is shared, so nothing is locked.
pub(super) struct Buffer {
    pub rect: PixelRect,
    /// The colour of pixels that no triangle covers.
    background: u32,
    pub planes: Vec<TileSample>,
    /// Of each block, no depth is farther.
    farthest: [f32; (BLOCKS * BLOCKS) as usize],
    /// Of each block, how often it was drawn into since that was looked for.
    drawn: [u8; (BLOCKS * BLOCKS) as usize],
}

impl Buffer {
    pub fn new(samples: usize) -> Self {
        let plane = || TileSample { colours: TilePlane::new(0), depths: TilePlane::new(0.0) };
        Self {
            rect: PixelRect::window(0, 0),
            background: 0,
            planes: (0..samples).map(|_| plane()).collect(),
            farthest: [f32::INFINITY; 16],
            drawn: [0; 16],
        }
    }

    pub fn clear(&mut self, rect: PixelRect, background: u32) {
        (self.rect, self.background) = (rect, background);
        let empty = if self.planes.len() == 1 { 0 } else { background };
        for plane in &mut self.planes {
            plane.colours.fill(empty);
            plane.depths.fill(f32::INFINITY);
        }
        let (width, height) = (rect.width() as usize, rect.height() as i32);
        if width < SIDE_PX as usize || height < SIDE_PX {
            // Nothing is drawn beyond the window, and nothing there is farther than anything.
            for depths in self.planes.iter_mut().map(|plane| &mut plane.depths) {
                (0..height).for_each(|y| depths.row_mut(y)[width..].fill(f32::NEG_INFINITY));
                (height..SIDE_PX).for_each(|y| depths.row_mut(y).fill(f32::NEG_INFINITY));
            }
        }
        (self.farthest, self.drawn) = ([f32::INFINITY; 16], [0; 16]);
    }

    /// Whether nothing that is drawn into these blocks, no depth nearer than `nearest`, can be seen.
    #[inline(always)]
    pub fn hides<S: Simd>(&mut self, simd: S, blocks: &Blocks, nearest: f32) -> bool {
        let Blocks { columns, rows } = blocks;
        for row in rows.clone() {
            for column in columns.clone() {
                let at = (row * BLOCKS + column) as usize & 15;
                if self.farthest[at] > nearest && self.drawn[at] >= STALE {
                    self.farthest[at] = self.farthest_of(simd, column, row);
                    self.drawn[at] = 0;
                }
                if self.farthest[at] > nearest {
                    return false;
                }
            }
        }
        true
    }

    /// Takes note that these blocks are drawn into.
    #[inline(always)]
    pub fn draws(&mut self, Blocks { columns, rows }: &Blocks) {
        for row in rows.clone() {
            for column in columns.clone() {
                let drawn = &mut self.drawn[(row * BLOCKS + column) as usize & 15];
                *drawn = drawn.saturating_add(1);
            }
        }
    }

    /// The blocks that pixels of the window reach into, which reach into the tile.
    #[inline(always)]
    pub fn blocks(&self, touched: Touched) -> Blocks {
        let Touched { x0, y0, x1, y1 } = touched;
        let blocks = |from: u16, to: u16, first: i32| {
            let (from, to) = (i32::from(from) - first, i32::from(to) - first);
            from.max(0) / BLOCK_PX..to.min(SIDE_PX - 1) / BLOCK_PX + 1
        };
        Blocks { columns: blocks(x0, x1, self.rect.x0), rows: blocks(y0, y1, self.rect.y0) }
    }

    #[inline(always)]
    fn farthest_of<S: Simd>(&self, simd: S, column: i32, row: i32) -> f32 {
        let (left, top) = (column * BLOCK_PX, row * BLOCK_PX);
        let mut farthest = f32x16::splat(simd, f32::NEG_INFINITY);
        for plane in &self.planes {
            for y in top..top + BLOCK_PX {
                let depths = f32x16::load_array_ref(simd, plane.depths.run(left, y));
                farthest = farthest.max(depths);
            }
        }
        farthest.to_array().into_iter().fold(f32::NEG_INFINITY, f32::max)
    }

    /// What is seen of a colour of a plane.
    #[inline(always)]
    pub fn seen(&self, colour: u32) -> u32 {
        if colour == 0 { self.background } else { colour }
    }

    /// The picture's row `y`, counted from the first of the tile: the mean of the samples of each
    /// pixel, a half rounded up.
    #[inline(always)]
    pub fn resolve(&self, y: i32, out: &mut [[u8; 4]]) {
        let width = out.len();
        let row = |sample: usize| &self.planes[sample].colours.row(y)[..width];
        if self.planes.len() == 1 {
            for (pixel, &colour) in out.iter_mut().zip(row(0)) {
                *pixel = self.seen(colour).to_le_bytes();
            }
            return;
        }
        let [a, b, c, d] = [row(0), row(1), row(2), row(3)];
        // Two channels at a time, with room for sums of four above each.
        let channels = |colour: u32| colour & 0x00ff_00ff;
        let mean = |sum: u32| (sum + 0x0002_0002) >> 2 & 0x00ff_00ff;
        for (i, pixel) in out.iter_mut().enumerate() {
            let (a, b, c, d) = (a[i], b[i], c[i], d[i]);
            let low = channels(a) + channels(b) + channels(c) + channels(d);
            let high = channels(a >> 8) + channels(b >> 8) + channels(c >> 8) + channels(d >> 8);
            *pixel = (mean(low) | mean(high) << 8).to_le_bytes();
        }
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use super::*;

    /// Each pixel of a block is asked, and none of any other.
    #[test]
    fn the_farthest_of_a_block_is_any_of_its_pixels() {
        let mut buffer = Buffer::new(4);
        buffer.clear(PixelRect::window(64, 64), 0);
        for (x, y, sample) in (0..SIDE_PX)
            .flat_map(|y| (0..SIDE_PX).flat_map(move |x| [0, 1, 2, 3].map(|s| (x, y, s))))
        {
            for plane in &mut buffer.planes {
                plane.depths.fill(0.25);
            }
            buffer.planes[sample].depths.row_mut(y)[x as usize] = 0.5;
            let farthest = |column, row| dispatch!(Level::new(), simd => buffer.farthest_of(simd, column, row));
            for at in 0..BLOCKS * BLOCKS {
                let (column, row) = (at % BLOCKS, at / BLOCKS);
                let inside = (column, row) == (x / BLOCK_PX, y / BLOCK_PX);
                let expected = if inside { 0.5 } else { 0.25 };
                assert_eq!(farthest(column, row), expected, "block {at}, pixel ({x}, {y})");
            }
        }
    }

    /// What is called hidden is hidden: no depth in the rectangle is farther. After every change of
    /// depths that a drawing makes, in a tile that the window cuts off, with four samples.
    #[test]
    fn hidden_is_behind_every_depth() {
        let mut buffer = Buffer::new(4);
        let rect = PixelRect { x0: 128, y0: 64, x1: 128 + 50, y1: 64 + 41 };
        buffer.clear(rect, 0);
        let mut state = 1u32;
        let mut random = |below: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % below
        };
        let (mut hidden, mut seen) = (0, 0);
        for _ in 0..4000 {
            let (x0, y0) = (128 + random(50) as i32, 64 + random(41) as i32);
            let (x1, y1) = (x0 + 1 + random(40) as i32, y0 + 1 + random(40) as i32);
            let drawn = PixelRect { x0, y0, x1, y1 };
            let [left, right] = [x0, x1 - 1].map(|x| x as u16);
            let [above, below] = [y0, y1 - 1].map(|y| y as u16);
            let blocks = buffer.blocks(Touched { x0: left, y0: above, x1: right, y1: below });
            let depth = random(1000) as f32 / 1000.0;
            let mut farthest = f32::NEG_INFINITY;
            let inside = drawn.intersect(&rect);
            let columns = (inside.x0 - rect.x0) as usize..(inside.x1 - rect.x0) as usize;
            for plane in &buffer.planes {
                for y in inside.y0 - rect.y0..inside.y1 - rect.y0 {
                    let row = &plane.depths.row(y)[columns.clone()];
                    farthest = row.iter().fold(farthest, |farthest, &d| farthest.max(d));
                }
            }
            let hides = dispatch!(Level::new(), simd => buffer.hides(simd, &blocks, depth));
            if hides {
                assert!(farthest <= depth, "{drawn:?} at {depth}: there is {farthest}");
                hidden += 1;
                continue;
            }
            seen += 1;
            buffer.draws(&blocks);
            for plane in &mut buffer.planes {
                for y in inside.y0 - rect.y0..inside.y1 - rect.y0 {
                    for x in columns.clone() {
                        let [stored] = plane.depths.run_mut(x as i32, y);
                        *stored = stored.min(depth);
                    }
                }
            }
        }
        assert!(hidden > 500 && seen > 100, "{hidden} hidden, {seen} seen");
    }
}
