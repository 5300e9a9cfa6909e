//! A window of at most 32 x 32 pixels as 32 words: what a question is asked in, so that a
//! comparison of two pictures is 32 instructions.

use super::mirror::Mirror;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;

/// Largest side of the window of a question, in pixels.
pub(crate) const SIDE_PX: i32 = 32;

/// A yes or no for each pixel of a window at the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Mask([u32; SIDE_PX as usize]);

impl Mask {
    /// All pixels.
    pub(crate) const FULL: Self = Self([u32::MAX; SIDE_PX as usize]);

    /// The pixels with at least `least` hits.
    pub(crate) fn of(coverage: &Coverage, least: u8) -> Self {
        let mut mask = Self::default();
        for (y_px, row) in coverage.rows().filter(|(y_px, _)| (0..SIDE_PX).contains(y_px)) {
            for (x_px, &hits) in row.iter().enumerate().take(SIDE_PX as usize) {
                mask.0[y_px as usize] |= u32::from(hits >= least) << x_px;
            }
        }
        mask
    }

    /// Adds a pixel of the window.
    pub(crate) fn set(&mut self, x_px: i32, y_px: i32) {
        self.0[y_px as usize] |= 1 << x_px;
    }

    /// Adds a pixel, or takes it away.
    pub(crate) fn put(&mut self, x_px: i32, y_px: i32, is_in: bool) {
        let bit = 1 << x_px;
        let row = &mut self.0[y_px as usize];
        *row = if is_in { *row | bit } else { *row & !bit };
    }

    /// Whether a pixel of the window is in it.
    pub(crate) fn has(&self, x_px: i32, y_px: i32) -> bool {
        self.0[y_px as usize] >> x_px & 1 == 1
    }

    /// A row, with the first column as its last bit.
    pub(crate) fn row(&self, y_px: i32) -> u32 {
        self.0[y_px as usize]
    }

    /// Whether no pixel is in it.
    pub(crate) fn is_empty(&self) -> bool {
        self.count() == 0
    }

    /// How many pixels are in it.
    pub(crate) fn count(&self) -> u32 {
        self.0.iter().map(|row| row.count_ones()).sum()
    }

    /// The first column of the first row that has a pixel, and that row.
    pub(crate) fn first(&self) -> Option<[i32; 2]> {
        let mut rows = self.0.iter().zip(0..);
        rows.find_map(|(row, y)| (*row != 0).then(|| [row.trailing_zeros() as i32, y]))
    }

    /// Pixels of `self` that `other` lacks.
    pub(crate) fn beyond(&self, other: &Self) -> u32 {
        self.0.iter().zip(&other.0).map(|(a, b)| (a & !b).count_ones()).sum()
    }

    /// Removes the pixels of the window of which `kept` is false.
    pub(crate) fn retain(&mut self, window: PixelRect, kept: &dyn Fn(i32, i32) -> bool) {
        for y in window.y0..window.y1 {
            for x in window.x0..window.x1 {
                if self.has(x, y) && !kept(x, y) {
                    self.0[y as usize] &= !(1 << x);
                }
            }
        }
    }

    /// Removes the pixels outside a box: its first and last column, and its first and last row.
    pub(crate) fn clip(&mut self, [columns, rows]: [[i64; 2]; 2]) {
        let bits = |count: i64| (1_u64 << count.clamp(0, SIDE_PX.into())) - 1;
        let kept = (bits(columns[1] + 1) & !bits(columns[0])) as u32;
        for (y, row) in (0..).zip(&mut self.0) {
            *row = if rows[0] <= y && y <= rows[1] { *row & kept } else { 0 };
        }
    }

    /// Adds the pixels of `other`.
    pub(crate) fn add(&mut self, other: &Self) {
        self.0.iter_mut().zip(&other.0).for_each(|(a, b)| *a |= b);
    }

    /// The pixels that both have.
    pub(crate) fn shared(&self, other: &Self) -> Self {
        let mut mask = *self;
        mask.0.iter_mut().zip(&other.0).for_each(|(a, b)| *a &= b);
        mask
    }

    /// The pixels that one of both has.
    pub(crate) fn differs(&self, other: &Self) -> Self {
        let mut mask = *self;
        mask.0.iter_mut().zip(&other.0).for_each(|(a, b)| *a ^= b);
        mask
    }

    /// The picture with x and y exchanged.
    pub(crate) fn turned(&self) -> Self {
        let mut turned = Self::default();
        for (y, row) in self.0.iter().enumerate() {
            for (x, other) in turned.0.iter_mut().enumerate() {
                *other |= (row >> x & 1) << y;
            }
        }
        turned
    }

    /// The picture taken back from a mirror.
    pub(crate) fn mirrored(&self, mirror: Mirror, window: PixelRect) -> Self {
        if mirror == Mirror::None {
            return *self;
        }
        let mut back = Self::default();
        for y in window.y0..window.y1 {
            for x in window.x0..window.x1 {
                let [from_x, from_y] = mirror.at(x, y, window);
                if window.contains(from_x, from_y) && self.has(from_x, from_y) {
                    back.set(x, y);
                }
            }
        }
        back
    }
}
