//! A rectangle of values, one for each pixel, and coverage as hit counts.
//!
//! Coverage counts hits instead of storing a yes or no, since a boolean would hide a pixel that
//! was drawn twice. It refuses to be larger than [`MAX_SIDE_PX`] a side.

use std::fmt;

use crate::grid::{MAX_SIDE_PX, PixelRect};

/// One value for each pixel of `bounds`, stored row by row.
///
/// Rows lie `pitch` elements apart. A pitch that is a multiple of 4096 bytes would put a whole
/// column of pixels into one set of a typical first-level cache (measured 9.5 against 0.55 ns for
/// a store), so such a pitch is padded by 64 bytes: 1024 pixels of 4 bytes lie 1040 apart.
///
/// The first pixel lies at the beginning of a line of the cache, so that what is written sixteen
/// pixels at a time, from a column that is a multiple of 16, does not lie across two.
pub struct Frame<T> {
    bounds: PixelRect,
    pitch: usize,
    /// Where the first pixel is.
    first: usize,
    /// Where pixel (0, 0) would be, modulo 2^32.
    origin: i32,
    data: Vec<T>,
}

/// Bytes of a line of the cache.
const LINE: usize = 64;

// Places of pixels are counted in 32 bits: rows are longer than a side by a line at most.
const _: () = std::assert!((MAX_SIDE_PX as u64 + 64) * MAX_SIDE_PX as u64 + 64 <= u32::MAX as u64);

impl<T: Copy> Clone for Frame<T> {
    fn clone(&self) -> Self {
        let pixels = self.data.len() - room::<T>();
        let mut data = Vec::with_capacity(self.data.len());
        let first = aligned(data.as_ptr());
        // What is before and after the pixels may be anything: there is room for a line, so something.
        data.resize(first, self.data[0]);
        data.extend_from_slice(&self.data[self.first..self.first + pixels]);
        data.resize(self.data.len(), self.data[0]);
        Self::placed(self.bounds, self.pitch, first, data)
    }
}

impl<T: Copy + PartialEq> PartialEq for Frame<T> {
    fn eq(&self, other: &Self) -> bool {
        self.bounds == other.bounds && self.rows().eq(other.rows())
    }
}

impl<T: Copy + Eq> Eq for Frame<T> {}

/// Elements from here to the beginning of a line; none where their size divides no line.
fn aligned<T>(from: *const T) -> usize {
    let first = from.align_offset(LINE);
    if first <= room::<T>() { first } else { 0 }
}

/// Elements that a first pixel is moved by at most.
const fn room<T>() -> usize {
    if size_of::<T>() == 0 { 1 } else { LINE.div_ceil(size_of::<T>()) }
}

impl<T> fmt::Debug for Frame<T> {
    /// The window only: a message with every pixel would not be read.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Frame").field("bounds", &self.bounds).finish_non_exhaustive()
    }
}

/// Hits for each pixel; 255 stands for 255 and more.
pub type Coverage = Frame<u8>;

impl<T: Copy> Frame<T> {
    /// A frame over `bounds` with every pixel set to `value`.
    ///
    /// # Panics
    /// If a side exceeds [`MAX_SIDE_PX`]; the edges of the program check sizes before this.
    #[must_use]
    pub fn new(bounds: PixelRect, value: T) -> Self {
        let (width, height) = (bounds.width(), bounds.height());
        assert!(
            width <= MAX_SIDE_PX && height <= MAX_SIDE_PX,
            "a frame of {width} x {height} px is too large"
        );
        let mut pitch = width as usize;
        let size = size_of::<T>().max(1);
        if pitch > 0 && (pitch * size) % 4096 == 0 {
            pitch += (64 / size).max(1);
        }
        let data = vec![value; pitch * height as usize + room::<T>()];
        let first = aligned(data.as_ptr());
        Self::placed(bounds, pitch, first, data)
    }

    /// Over data whose element `first` is the first pixel.
    fn placed(bounds: PixelRect, pitch: usize, first: usize, data: Vec<T>) -> Self {
        let row = bounds.y0.wrapping_mul(pitch as i32);
        let origin = (first as i32).wrapping_sub(row).wrapping_sub(bounds.x0);
        Self { bounds, pitch, first, origin, data }
    }

    /// The pixels this frame holds.
    #[must_use]
    #[inline]
    pub fn bounds(&self) -> PixelRect {
        self.bounds
    }

    /// Elements from one row to the next.
    #[must_use]
    pub fn pitch(&self) -> usize {
        self.pitch
    }

    /// Sets every pixel to `value`.
    pub fn fill(&mut self, value: T) {
        self.data.fill(value);
    }

    /// The values of row `y_px`, from the left border on.
    ///
    /// # Panics
    /// If the row lies outside the frame.
    #[must_use]
    #[inline]
    pub fn row(&self, y_px: i32) -> &[T] {
        let start = self.at(self.bounds.x0, y_px);
        &self.data[start..start + self.width()]
    }

    /// As [`Frame::row`], to write to.
    ///
    /// # Panics
    /// If the row lies outside the frame.
    #[inline]
    pub fn row_mut(&mut self, y_px: i32) -> &mut [T] {
        let start = self.at(self.bounds.x0, y_px);
        let width = self.width();
        &mut self.data[start..start + width]
    }

    /// Columns `x0_px..x1_px` of row `y_px`, to write to.
    ///
    /// # Panics
    /// If they lie outside the frame.
    #[inline]
    pub fn span_mut(&mut self, y_px: i32, x0_px: i32, x1_px: i32) -> &mut [T] {
        let start = self.at(x0_px, y_px);
        let end = start.wrapping_add((x1_px - x0_px) as usize);
        &mut self.data[start..end]
    }

    /// Everything from pixel (x, y) on: rows lie [`Frame::pitch`] apart.
    ///
    /// # Panics
    /// If the pixel lies outside the frame.
    #[inline]
    #[doc(hidden)]
    pub fn tail_mut(&mut self, x_px: i32, y_px: i32) -> &mut [T] {
        let start = self.at(x_px, y_px);
        &mut self.data[start..]
    }

    /// The value of pixel (x, y), or nothing outside the frame.
    #[must_use]
    #[inline]
    pub fn get(&self, x_px: i32, y_px: i32) -> Option<T> {
        self.bounds.contains(x_px, y_px).then(|| self.data[self.at(x_px, y_px)])
    }

    /// Every row with its number, from the top.
    pub fn rows(&self) -> impl Iterator<Item = (i32, &[T])> {
        (self.bounds.y0..self.bounds.y1).map(|y_px| (y_px, self.row(y_px)))
    }

    /// Columns, of the same value as [`PixelRect::width`], which is a call from other crates.
    #[inline]
    fn width(&self) -> usize {
        (i64::from(self.bounds.x1) - i64::from(self.bounds.x0)).max(0) as usize
    }

    /// Where a pixel is: one product and two sums of 32 bits, whatever the first row and column are.
    #[inline]
    fn at(&self, x_px: i32, y_px: i32) -> usize {
        debug_assert!((self.bounds.y0..self.bounds.y1).contains(&y_px));
        let row = y_px.wrapping_mul(self.pitch as i32);
        self.origin.wrapping_add(row).wrapping_add(x_px) as u32 as usize
    }
}

/// Holds columns `x0_px..x1_px` of row `y_px` to a window.
///
/// # Panics
/// If they lie outside, or the end lies before the beginning.
#[doc(hidden)]
#[inline]
pub fn assert_inside(window: PixelRect, y_px: i32, x0_px: i32, x1_px: i32) {
    assert!(
        x0_px <= x1_px,
        "the span of row {y_px} begins at column {x0_px} and ends before it, at column {x1_px}"
    );
    assert!(
        (window.y0..window.y1).contains(&y_px) && x0_px >= window.x0 && x1_px <= window.x1,
        "pixels {x0_px}..{x1_px} of row {y_px} lie outside the window"
    );
}

impl Coverage {
    /// Counts one hit more for each of the columns `x0_px..x1_px` of row `y_px`.
    ///
    /// # Panics
    /// If they lie outside the frame, or the end lies before the beginning: an engine that leaves its bounds is caught here.
    #[inline]
    pub fn hit(&mut self, y_px: i32, x0_px: i32, x1_px: i32) {
        assert_inside(self.bounds, y_px, x0_px, x1_px);
        for hits in self.span_mut(y_px, x0_px, x1_px) {
            *hits = hits.saturating_add(1);
        }
    }

    /// Pixels with at least one hit.
    #[must_use]
    pub fn covered(&self) -> u64 {
        self.rows().map(|(_, row)| row.iter().filter(|&&hits| hits > 0).count() as u64).sum()
    }

    /// Runs of covered pixels as (row, first column, one past the last column).
    pub fn runs(&self) -> impl Iterator<Item = (i32, i32, i32)> {
        self.rows()
            .flat_map(|(y_px, row)| {
                let x0 = self.bounds.x0;
                row.chunk_by(|a, b| (*a > 0) == (*b > 0)).scan(x0, move |x_px, run| {
                    let start = *x_px;
                    *x_px += run.len() as i32;
                    Some((run[0] > 0).then_some((y_px, start, *x_px)))
                })
            })
            .flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pitch_avoids_the_page_stride() {
        assert_eq!(Frame::new(PixelRect::window(1024, 4), 0u32).pitch(), 1040);
        assert_eq!(Frame::new(PixelRect::window(1000, 4), 0u32).pitch(), 1000);
        assert_eq!(Frame::new(PixelRect::window(4096, 1), 0u8).pitch(), 4160);
        assert_eq!(Frame::new(PixelRect::window(0, 0), 0u8).pitch(), 0);
    }

    #[test]
    fn coverage_counts_hits_and_lists_runs() {
        let mut coverage = Coverage::new(PixelRect { x0: -1, y0: 2, x1: 5, y1: 4 }, 0);
        coverage.hit(2, -1, 2);
        coverage.hit(2, 1, 2);
        coverage.hit(3, 3, 5);
        assert_eq!(coverage.row(2), [1, 1, 2, 0, 0, 0]);
        assert_eq!(coverage.covered(), 5);
        assert_eq!(coverage.runs().collect::<Vec<_>>(), [(2, -1, 2), (3, 3, 5)]);
        assert_eq!(coverage.get(1, 2), Some(2));
        assert_eq!(coverage.get(5, 2), None);
    }

    #[test]
    fn places_are_right_wherever_the_frame_is() {
        let side = MAX_SIDE_PX as i32;
        for (x0, y0) in [(0, 0), (i32::MIN, i32::MIN), (i32::MAX - side, i32::MAX - side), (7, -9)]
        {
            let bounds = PixelRect { x0, y0, x1: x0 + side, y1: y0 + side };
            // Nothing that takes room.
            let largest = Frame::new(bounds, ());
            for (x, y) in [(0, 0), (side - 1, 0), (0, side - 1), (side - 1, side - 1), (77, 12_345)]
            {
                let place = largest.first + y as usize * largest.pitch + x as usize;
                assert_eq!(largest.at(x0 + x, y0 + y), place, "({x}, {y}) from ({x0}, {y0})");
            }
            let mut small = Frame::new(PixelRect { x1: x0 + 3, y1: y0 + 2, ..bounds }, 0u8);
            small.span_mut(y0 + 1, x0 + 1, x0 + 3).fill(1);
            let copy = small.clone();
            for frame in [small, copy] {
                assert_eq!((frame.row(y0), frame.row(y0 + 1)), (&[0, 0, 0][..], &[0, 1, 1][..]));
                assert_eq!(frame.get(x0 + 1, y0 + 1), Some(1));
            }
        }
    }

    #[test]
    #[should_panic(expected = "outside the window")]
    fn a_hit_outside_is_caught() {
        Coverage::new(PixelRect::window(4, 4), 0).hit(1, 2, 5);
    }

    /// Both ends lie in the window.
    #[test]
    #[should_panic(
        expected = "the span of row 1 begins at column 3 and ends before it, at column 2"
    )]
    fn a_span_that_ends_before_it_begins_is_caught() {
        Coverage::new(PixelRect::window(4, 4), 0).hit(1, 3, 2);
    }
}
