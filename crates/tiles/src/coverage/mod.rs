//! The tile engine: coverage of lists of triangles, as tiles of 16 x 16 px with a mask for each row.
//!
//! Source: Pineda 1988 for the half-planes, Greene 1996, "Hierarchical Polygon Tiling with Coverage
//! Masks", for tiles that are rejected or filled whole. Sixteen triangles are set up at a time, and
//! sixteen pixels of a row decided at a time, in vectors of the best instruction set the machine has
//! ([`Tiles::levels`]); `fearless_simd` chooses among them at run time and needs no `unsafe` here.
//!
//! - Triangles up to 180 px a side are set up in wrapping i32 (`setup`), larger ones in i128
//!   (`setup::Single`). Both are stepped in i32 as long as that is wide enough, else in i64 (`wide`).
//! - Triangles of at most 4 x 4 and 8 x 8 px are decided whole while they are set up, one a lane, in i16
//!   (`cells`).
//! - Tiles begin at the first pixel of the triangle's box, so that there are few of them.
//!
//! It shares nothing with the other engines or the oracle. It does not clip, cull, depth-test or
//! shade, and it computes no values.

mod cells;
mod paint;
mod setup;
mod walk;
mod wide;

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd};

use rasterproof_core::contract::Rasterize;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, Span};

pub use setup::{NARROW_EXTENT, NEAR_EXTENT, STEPPED_LIMIT};

/// Columns and rows of a tile.
pub const SIDE_PX: i32 = 16;

/// Columns and rows of a cell.
pub const CELL_PX: i32 = 4;

/// Columns and rows of a quarter of a tile.
pub const QUARTER_PX: i32 = SIDE_PX / 2;

/// A part of what a triangle of a list covers: plain data, with nothing of the vectors in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece {
    /// Some pixels of a square of 4 x 4, at least one: all of a tiny triangle.
    Cell(Cell),
    /// Some pixels of a square of 8 x 8, at least one: all of a small triangle.
    Quarter(Quarter),
    /// Some pixels of a square of 16 x 16, at least one.
    Tile(Tile),
    /// Every pixel of a rectangle, which is not empty.
    Block(Block),
}

/// Some pixels of a square of 4 x 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Which triangle of the list.
    pub triangle: u32,
    /// First column of the square.
    pub x_px: i32,
    /// First row of the square.
    pub y_px: i32,
    /// Bit 4 j + i: whether pixel (x + i, y + j) is covered.
    pub pixels: u16,
}

/// Some pixels of a square of 8 x 8, a quarter of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quarter {
    /// Which triangle of the list.
    pub triangle: u32,
    /// First column of the square.
    pub x_px: i32,
    /// First row of the square.
    pub y_px: i32,
    /// Bit 8 j + i: whether pixel (x + i, y + j) is covered.
    pub pixels: u64,
}

/// Some pixels of a square of 16 x 16.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Which triangle of the list.
    pub triangle: u32,
    /// First column of the square.
    pub x_px: i32,
    /// First row of the square.
    pub y_px: i32,
    /// Bit i of mask j: whether pixel (x + i, y + j) is covered.
    pub rows: [u16; 16],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// Which triangle of the list.
    pub triangle: u32,
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

/// What comes of a list where large triangles are left to somebody else.
#[derive(Clone, Copy, Debug)]
pub enum ListItem<'a> {
    /// A run of pieces, as in [`CoverList::cover_list`].
    Pieces(&'a [Piece]),
    /// The number of a triangle that is too large.
    Left(u32),
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

    #[must_use]
    pub fn instructions(&self) -> &'static str {
        match self.level {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse2(_) | Level::Sse4_2(_) => "SSE2",
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

    /// As [`CoverList::cover_list`] for the triangles of which the window shows a box of at most
    /// `side_px` columns and rows; the others are handed over as numbers, in their places.
    pub fn cover_small(
        &self,
        triangles: &[Corners],
        bounds: PixelRect,
        side_px: i32,
        take: &mut dyn FnMut(ListItem<'_>),
    ) {
        dispatch!(self.level, simd => cover_in(simd, triangles, bounds, side_px, take));
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
        self.cover_small(triangles, bounds, i32::MAX, &mut |part| {
            if let ListItem::Pieces(run) = part {
                take(run);
            }
        });
    }
}

/// Pieces are handed over when at least this many have come together.
const RUN: usize = 64;

#[inline(always)]
fn cover_in<S: Simd>(
    simd: S,
    triangles: &[Corners],
    bounds: PixelRect,
    side_px: i32,
    take: &mut dyn FnMut(ListItem<'_>),
) {
    let mut out = Out { pieces: Vec::with_capacity(2 * RUN), take };
    let mut columns = setup::Columns::default();
    let mut number = 0;
    for group in triangles.chunks(setup::GROUP) {
        columns.turn(group);
        for (at, chunk) in group.chunks(setup::LANES).enumerate() {
            batch(simd, columns.batch(simd, at, bounds), chunk, number, side_px, &mut out);
            number += setup::LANES as u32;
            if out.pieces.len() >= RUN {
                out.hand_over();
            }
        }
    }
    out.hand_over();
}

/// Pieces on their way.
struct Out<'a> {
    pieces: Vec<Piece>,
    take: &'a mut dyn FnMut(ListItem<'_>),
}

impl Out<'_> {
    fn hand_over(&mut self) {
        if !self.pieces.is_empty() {
            (self.take)(ListItem::Pieces(&self.pieces));
            self.pieces.clear();
        }
    }

    fn leave(&mut self, number: u32) {
        self.hand_over();
        (self.take)(ListItem::Left(number));
    }
}

/// Sixteen triangles or less, of which the first has a number.
#[inline(always)]
fn batch<S: Simd>(
    simd: S,
    batch: setup::Batch<S>,
    triangles: &[Corners],
    number: u32,
    side_px: i32,
    out: &mut Out<'_>,
) {
    let (narrow, wide) = (batch.narrow.to_bitmask() as u32, batch.wide.to_bitmask() as u32);
    let near = batch.near.to_bitmask() as u32;
    let tiny = batch.at_most(CELL_PX) & near;
    let small = batch.at_most(QUARTER_PX) & near & !tiny;
    let cells = if tiny == 0 { cells::Cells::default() } else { cells::Cells::new(simd, &batch) };
    let mut left = narrow | wide;
    if left == tiny {
        // Nothing else, as in every list of tiny triangles.
        while left != 0 {
            let lane = left.trailing_zeros() as usize & (setup::LANES - 1);
            left &= left - 1;
            cells.append(lane, number + lane as u32, &mut out.pieces);
        }
        return;
    }
    let quarters =
        if small == 0 { cells::Quarters::default() } else { cells::Quarters::new(simd, &batch) };
    let ours = batch.at_most(side_px);
    let records =
        if left & ours == tiny | small { setup::Records::default() } else { batch.records() };
    while left != 0 {
        let lane = left.trailing_zeros() as usize & (setup::LANES - 1);
        let bit = left & left.wrapping_neg();
        left &= left - 1;
        let triangle = number + lane as u32;
        if tiny & bit != 0 {
            cells.append(lane, triangle, &mut out.pieces);
        } else if small & bit != 0 {
            quarters.append(lane, triangle, &mut out.pieces);
        } else if ours & bit == 0 {
            out.leave(triangle);
        } else if narrow & bit != 0 {
            walk::walk(simd, &records.stepped(lane), triangle, &mut out.pieces);
        } else {
            single(simd, &triangles[lane], records.rect(lane), triangle, &mut out.pieces);
        }
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
            Self::Cell(cell) => cell.triangle,
            Self::Quarter(quarter) => quarter.triangle,
            Self::Tile(tile) => tile.triangle,
            Self::Block(block) => block.triangle,
        }
    }

    /// Its pixels as spans, row by row.
    pub fn spans(&self, emit: &mut dyn FnMut(Span)) {
        match self {
            Self::Cell(cell) => cell.tile().spans(emit),
            Self::Quarter(quarter) => quarter.tile().spans(emit),
            Self::Tile(tile) => tile.spans(emit),
            Self::Block(Block { rect, .. }) => {
                for y_px in rect.y0..rect.y1 {
                    emit(Span { y_px, x0_px: rect.x0, x1_px: rect.x1 });
                }
            }
        }
    }
}

impl Cell {
    #[must_use]
    pub fn tile(&self) -> Tile {
        let Self { triangle, x_px, y_px, pixels } = *self;
        let mut rows = [0; SIDE_PX as usize];
        for (j, row) in rows.iter_mut().take(CELL_PX as usize).enumerate() {
            *row = pixels >> (CELL_PX as usize * j) & 0xf;
        }
        Tile { triangle, x_px, y_px, rows }
    }
}

impl Quarter {
    #[must_use]
    pub fn tile(&self) -> Tile {
        let Self { triangle, x_px, y_px, pixels } = *self;
        let mut rows = [0; SIDE_PX as usize];
        for (row, byte) in rows.iter_mut().zip(pixels.to_le_bytes()) {
            *row = byte.into();
        }
        Tile { triangle, x_px, y_px, rows }
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
