//! The colours and depths of one tile of a frame.

use std::ops::Range;

use crate::grid::PixelRect;
use crate::tile;

/// Columns and rows of a tile of a frame.
pub const SIDE_PX: i32 = 64;

/// Columns and rows of a block of a tile, whose farthest depth is known.
const BLOCK_PX: i32 = 16;
/// Blocks in a row of a tile.
const BLOCKS: i32 = SIDE_PX / BLOCK_PX;

/// A block's farthest depth is looked for again after it was drawn into so many times: looking costs
/// about a row of pixels.
const STALE: u8 = 8;

/// From row to row of a [`Sheet`].
pub const PITCH: usize = (SIDE_PX + tile::SIDE_PX) as usize;

/// One number for every pixel of a tile. Beyond its right and lower side there is room for the pairs
/// and cells that begin in it. Columns and rows count from its first pixel.
pub(super) struct Sheet<T>(Vec<T>);

impl<T: Copy> Sheet<T> {
    fn new(value: T) -> Self {
        Self(vec![value; PITCH * (SIDE_PX + tile::CELL_PX - 1) as usize])
    }

    fn fill(&mut self, value: T) {
        self.0.fill(value);
    }

    /// Row `y`, and the room beyond it.
    pub fn row(&self, y: i32) -> &[T] {
        &self.0[y as usize * PITCH..][..PITCH]
    }

    /// So many from a pixel on: a part of its row, and of those below.
    #[inline(always)]
    pub fn run<const N: usize>(&self, left: i32, top: i32) -> &[T; N] {
        let run = self.0[top as usize * PITCH + left as usize..].first_chunk();
        run.expect("there is room for what begins in a tile")
    }

    /// As [`Sheet::run`].
    #[inline(always)]
    pub fn run_mut<const N: usize>(&mut self, left: i32, top: i32) -> &mut [T; N] {
        let run = self.0[top as usize * PITCH + left as usize..].first_chunk_mut();
        run.expect("there is room for what begins in a tile")
    }
}

/// One sample of every pixel of a tile.
pub(super) struct Plane {
    /// Opaque; with one sample a pixel, until it is coloured, the number of what is seen there, below
    /// every colour, and 0 for nothing.
    pub colours: Sheet<u32>,
    /// Smaller is nearer; infinite where nothing has been drawn.
    pub depths: Sheet<f32>,
}

/// Colours and depths of one tile, owned by who draws it: nothing is shared, so nothing is locked.
pub(super) struct Buffer {
    /// Its pixels in the window.
    pub rect: PixelRect,
    /// Where nothing is.
    background: u32,
    /// One for each sample.
    pub planes: Vec<Plane>,
    /// Of each block, no depth is farther.
    farthest: [f32; (BLOCKS * BLOCKS) as usize],
    /// Of each block, how often it was drawn into since that was looked for.
    drawn: [u8; (BLOCKS * BLOCKS) as usize],
}

impl Buffer {
    pub fn new(samples: usize) -> Self {
        let plane = || Plane { colours: Sheet::new(0), depths: Sheet::new(0.0) };
        Self {
            rect: PixelRect::window(0, 0),
            background: 0,
            planes: (0..samples).map(|_| plane()).collect(),
            farthest: [f32::INFINITY; 16],
            drawn: [0; 16],
        }
    }

    /// Begins a tile.
    pub fn clear(&mut self, rect: PixelRect, background: u32) {
        (self.rect, self.background) = (rect, background);
        let empty = if self.planes.len() == 1 { 0 } else { background };
        for plane in &mut self.planes {
            plane.colours.fill(empty);
            plane.depths.fill(f32::INFINITY);
        }
        (self.farthest, self.drawn) = ([f32::INFINITY; 16], [0; 16]);
    }

    /// Whether nothing that is drawn into a rectangle of the window, no depth nearer than `nearest`, can
    /// be seen in this tile.
    #[inline]
    pub fn hides(&mut self, rect: PixelRect, nearest: f32) -> bool {
        let [columns, rows] = self.blocks(rect);
        for row in rows {
            for column in columns.clone() {
                let at = (row * BLOCKS + column) as usize;
                if self.farthest[at] > nearest && self.drawn[at] >= STALE {
                    self.farthest[at] = self.farthest_of(column, row);
                    self.drawn[at] = 0;
                }
                if self.farthest[at] > nearest {
                    return false;
                }
            }
        }
        true
    }

    /// Takes note that a rectangle of the window is drawn into.
    #[inline]
    pub fn draws(&mut self, rect: PixelRect) {
        let [columns, rows] = self.blocks(rect);
        for row in rows {
            for column in columns.clone() {
                let drawn = &mut self.drawn[(row * BLOCKS + column) as usize];
                *drawn = drawn.saturating_add(1);
            }
        }
    }

    /// The columns and rows of blocks that a rectangle of the window reaches into.
    #[inline]
    fn blocks(&self, rect: PixelRect) -> [Range<i32>; 2] {
        let rect = rect.intersect(&self.rect);
        let blocks = |from: i32, to: i32, first: i32| {
            (from - first) / BLOCK_PX..(to - 1 - first) / BLOCK_PX + 1
        };
        [blocks(rect.x0, rect.x1, self.rect.x0), blocks(rect.y0, rect.y1, self.rect.y0)]
    }

    /// The farthest depth of a block.
    fn farthest_of(&self, column: i32, row: i32) -> f32 {
        let (x0, y0) = (column * BLOCK_PX, row * BLOCK_PX);
        let x1 = (x0 + BLOCK_PX).min(self.rect.width() as i32);
        let y1 = (y0 + BLOCK_PX).min(self.rect.height() as i32);
        let mut farthest = [f32::NEG_INFINITY; 16];
        for plane in &self.planes {
            for y in y0..y1 {
                let depths = &plane.depths.row(y)[x0 as usize..x1 as usize];
                for (far, &depth) in farthest.iter_mut().zip(depths) {
                    *far = if depth > *far { depth } else { *far };
                }
            }
        }
        farthest.into_iter().fold(f32::NEG_INFINITY, f32::max)
    }

    /// The picture's row `y`, counted from the first of the tile: the mean of the samples of each
    /// pixel, a half rounded up.
    pub fn resolve(&self, y: i32, out: &mut [[u8; 4]]) {
        let width = out.len();
        let row = |sample: usize| &self.planes[sample].colours.row(y)[..width];
        if self.planes.len() == 1 {
            for (pixel, &colour) in out.iter_mut().zip(row(0)) {
                *pixel = if colour == 0 { self.background } else { colour }.to_le_bytes();
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
    use super::*;

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
            if buffer.hides(drawn, depth) {
                assert!(farthest <= depth, "{drawn:?} at {depth}: there is {farthest}");
                hidden += 1;
                continue;
            }
            seen += 1;
            buffer.draws(drawn);
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
