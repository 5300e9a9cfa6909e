//! The tile engine: coverage of lists of triangles, as tiles of 16 x 16 px with a mask for each row.
//!
//! Source: Pineda 1988 for the half-planes, Greene 1996, "Hierarchical Polygon Tiling with Coverage
//! Masks", for tiles that are rejected or filled whole. Sixteen triangles are set up at a time, and
//! sixteen pixels of a row decided at a time, in vectors of the best instruction set the machine has
//! ([`Tiles::levels`]); `fearless_simd` chooses among them at run time and needs no `unsafe` here.
//!
//! - Triangles up to 180 px a side are set up in wrapping i32 (`setup`), larger ones in i128
//!   (`setup::Single`). Both are stepped in i32 as long as that is wide enough, else in i64 (`wide`).
//! - Tiles begin at columns that are multiples of 16, since rows of pixels are written 64 bytes, a
//!   line of the cache, at a time; and at the first row of the triangle, so that tiny ones are one.
//!
//! It shares nothing with the other engines or the oracle. It does not clip, cull, depth-test or
//! shade, and it computes no values.

mod paint;
mod setup;
mod walk;
mod wide;

use fearless_simd::{Level, Simd, dispatch};

use crate::contract::Rasterize;
use crate::frame::Frame;
use crate::grid::PixelRect;
use crate::triangle::{Corners, Span};

pub use setup::{NARROW_EXTENT, STEPPED_LIMIT};

/// Columns and rows of a tile.
pub const SIDE_PX: i32 = 16;

/// A part of what a triangle of a list covers: plain data, with nothing of the vectors in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece {
    /// Some pixels of a square of 16 x 16, at least one.
    Tile(Tile),
    /// Every pixel of a rectangle, which is not empty.
    Block(Block),
}

/// Some pixels of a square of 16 x 16.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Which triangle of the list.
    pub triangle: u32,
    /// First column of the square, a multiple of 16.
    pub x_px: i32,
    /// First row of the square.
    pub y_px: i32,
    /// Bit i of mask j: whether pixel (x + i, y + j) is covered.
    pub rows: [u16; 16],
}

/// Every pixel of a rectangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// Which triangle of the list.
    pub triangle: u32,
    /// The pixels.
    pub rect: PixelRect,
}

/// Decides which pixels of a window the triangles of a list cover.
pub trait CoverList {
    /// Hands over what each triangle covers of `bounds`, in pieces that do not overlap: the pixels
    /// of [`Rasterize::cover`], each once.
    ///
    /// The pieces of a triangle come together, and after those of the triangles before it in the
    /// list, so that what is drawn over what does not depend on batches, tiles or instruction sets.
    /// They come in runs of any length that is not 0. Total for all inputs; a list has at most
    /// 2^32 triangles.
    fn cover_list(&self, triangles: &[Corners], bounds: PixelRect, take: &mut dyn FnMut(&[Piece]));
}

/// The tile engine in an instruction set; see the module's description.
#[derive(Clone, Copy, Debug)]
pub struct Tiles {
    level: Level,
}

impl Default for Tiles {
    /// In the best instruction set of this machine.
    fn default() -> Self {
        Self { level: Level::new() }
    }
}

impl Tiles {
    /// The engine in every instruction set of this machine, the best one last.
    #[must_use]
    pub fn levels() -> Vec<Self> {
        let best = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let known = [
            best.as_sse2().map(Level::Sse2),
            best.as_sse4_2().map(Level::Sse4_2),
            best.as_avx2().map(Level::Avx2),
            best.as_avx512().map(Level::Avx512),
        ];
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let known = [Some(best)];
        known.into_iter().flatten().map(|level| Self { level }).collect()
    }

    /// Its instruction set, for code that goes on where it ends.
    pub(crate) fn level(&self) -> Level {
        self.level
    }

    /// The name of its instruction set.
    #[must_use]
    pub fn instructions(&self) -> &'static str {
        match self.level {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse2(_) => "SSE2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse4_2(_) => "SSE4.2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx2(_) => "AVX2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx512(_) => "AVX-512",
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => "NEON",
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Level::WasmSimd128(_) => "simd128",
            _ => "no vectors",
        }
    }

    /// Fills pieces with one colour, in the order they are given.
    ///
    /// # Panics
    /// If a piece leaves the target.
    pub fn fill(&self, pieces: &[Piece], colour: u32, target: &mut Frame<u32>) {
        dispatch!(self.level, simd => paint::fill(simd, pieces, colour, target));
    }
}

impl CoverList for Tiles {
    fn cover_list(&self, triangles: &[Corners], bounds: PixelRect, take: &mut dyn FnMut(&[Piece])) {
        dispatch!(self.level, simd => cover_in(simd, triangles, bounds, take));
    }
}

/// Pieces are handed over when at least this many have come together.
const RUN: usize = 64;

#[inline(always)]
fn cover_in<S: Simd>(
    simd: S,
    triangles: &[Corners],
    bounds: PixelRect,
    take: &mut dyn FnMut(&[Piece]),
) {
    let mut pieces = Vec::with_capacity(2 * RUN);
    for (number, chunk) in triangles.chunks(setup::LANES).enumerate() {
        let batch = setup::Batch::new(simd, chunk, bounds);
        let mut left = batch.narrow | batch.wide;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let triangle = (number * setup::LANES + lane) as u32;
            if batch.narrow >> lane & 1 != 0 {
                walk::walk(simd, &batch.stepped(lane), triangle, &mut pieces);
            } else {
                single(simd, &chunk[lane], batch.rect(lane), triangle, &mut pieces);
            }
        }
        if pieces.len() >= RUN {
            take(&pieces);
            pieces.clear();
        }
    }
    if !pieces.is_empty() {
        take(&pieces);
    }
}

/// A triangle that is too large to be set up in i32.
#[inline(always)]
fn single<S: Simd>(
    simd: S,
    corners: &Corners,
    rect: PixelRect,
    triangle: u32,
    pieces: &mut Vec<Piece>,
) {
    let Some(single) = setup::Single::new(corners, rect) else { return };
    match single.stepped() {
        Some(stepped) => walk::walk(simd, &stepped, triangle, pieces),
        None => wide::walk(&single, triangle, pieces),
    }
}

/// The adapter: a list of one.
impl Rasterize for Tiles {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        self.cover_list(&[corners], bounds, &mut |pieces| {
            pieces.iter().for_each(|piece| piece.spans(&mut emit));
        });
    }
}

impl Piece {
    /// Which triangle of the list.
    #[must_use]
    pub fn triangle(&self) -> u32 {
        match self {
            Self::Tile(tile) => tile.triangle,
            Self::Block(block) => block.triangle,
        }
    }

    /// Its pixels as spans, row by row.
    pub fn spans(&self, emit: &mut dyn FnMut(Span)) {
        match self {
            Self::Tile(tile) => tile.spans(emit),
            Self::Block(Block { rect, .. }) => {
                for y_px in rect.y0..rect.y1 {
                    emit(Span { y_px, x0_px: rect.x0, x1_px: rect.x1 });
                }
            }
        }
    }
}

impl Tile {
    /// Its pixels as spans, row by row.
    #[inline]
    fn spans(&self, mut emit: impl FnMut(Span)) {
        for (y_px, &row) in (self.y_px..).zip(&self.rows) {
            // A wider word, so that a run that ends with the tile is no special case.
            let mut row = u32::from(row);
            let mut x_px = self.x_px;
            while row != 0 {
                let gap = row.trailing_zeros();
                let run = (row >> gap).trailing_ones();
                let x0_px = x_px + gap as i32;
                x_px = x0_px + run as i32;
                row >>= gap + run;
                emit(Span { y_px, x0_px, x1_px: x_px });
            }
        }
    }
}
