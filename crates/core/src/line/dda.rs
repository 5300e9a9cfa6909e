//! The DDA line drawer: the book's section 2.1 (digital differential analyser), repaired.
//!
//! One step along the major axis, then add the slope to the height and round it. What differs from
//! the book, and why:
//! - The height is an exact fraction, whole + part/n, instead of a float: `y += k` drifts (in the
//!   book 14.3% of integer lines have a wrong pixel).
//! - Heights are rounded to the nearest pixel instead of truncated; the tie is decided as
//!   [`DrawLine`] says.
//! - Both ends are drawn, and a segment of length zero is one pixel: the book loses the last one.
//!
//! It enters the window by bisection, so pixels outside cost nothing.

use std::ops::Range;

use crate::contract::DrawLine;
use crate::grid::PixelRect;
use crate::triangle::{Fragment, PixelPoint, ScreenLine, Varying};

/// The DDA; see the module's description.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dda;

impl DrawLine for Dda {
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let [a, b] = &line.ends;
        let slope = Slope::new(a.pixel, b.pixel);
        let steps = slope.steps_within(bounds);
        if steps.is_empty() {
            return;
        }
        let mut height = slope.height_at(steps.start);
        let (depth_rise, varying_rise) = (b.depth - a.depth, b.varying - a.varying);
        for step in steps {
            let pixel = slope.pixel(step, slope.round(height));
            // A point has weight 0, not 0/0.
            let t = if slope.length == 0 { 0.0 } else { step as f64 / slope.length as f64 };
            emit(Fragment {
                x_px: pixel.x,
                y_px: pixel.y,
                depth: a.depth + depth_rise * t,
                varying: a.varying + varying_rise * t,
            });
            height = slope.next(height);
        }
    }
}

/// Height above the first end, in pixels towards the second: whole + part/length.
#[derive(Clone, Copy)]
struct Height {
    whole: i64,
    part: i64,
}

/// A segment seen along its major axis.
struct Slope {
    start: PixelPoint,
    x_is_major: bool,
    /// +1 or -1 along the major and the minor axis.
    forward: i64,
    upward: i64,
    /// Steps along the major axis, below 2^32.
    length: i64,
    /// Pixels along the minor axis, at most `length`.
    rise: i64,
}

impl Slope {
    fn new(a: PixelPoint, b: PixelPoint) -> Self {
        let dx = i64::from(b.x) - i64::from(a.x);
        let dy = i64::from(b.y) - i64::from(a.y);
        let x_is_major = dx.abs() >= dy.abs();
        let (major, minor) = if x_is_major { (dx, dy) } else { (dy, dx) };
        Self {
            start: a,
            x_is_major,
            forward: if major < 0 { -1 } else { 1 },
            upward: if minor < 0 { -1 } else { 1 },
            length: major.abs(),
            rise: minor.abs(),
        }
    }

    /// The exact height at a step, by one division.
    fn height_at(&self, step: i64) -> Height {
        if self.length == 0 {
            return Height { whole: 0, part: 0 };
        }
        // Both factors are below 2^32.
        let (numerator, length) = (step as u64 * self.rise as u64, self.length as u64);
        Height { whole: (numerator / length) as i64, part: (numerator % length) as i64 }
    }

    /// The height one step further: add the slope, carry whole pixels.
    #[inline]
    fn next(&self, height: Height) -> Height {
        let part = height.part + self.rise;
        if part >= self.length && self.length > 0 {
            Height { whole: height.whole + 1, part: part - self.length }
        } else {
            Height { whole: height.whole, part }
        }
    }

    /// The nearest whole height. A tie goes up seen from the end with the smaller major
    /// coordinate, so it goes down when the segment is drawn from the other end.
    #[inline]
    fn round(&self, height: Height) -> i64 {
        let up = if self.forward > 0 {
            2 * height.part >= self.length
        } else {
            2 * height.part > self.length
        };
        height.whole + i64::from(up && self.length > 0)
    }

    #[inline]
    fn pixel(&self, step: i64, height: i64) -> PixelPoint {
        let (major, minor) = (self.forward * step, self.upward * height);
        let (dx, dy) = if self.x_is_major { (major, minor) } else { (minor, major) };
        // Between the two ends, so both coordinates fit i32.
        PixelPoint {
            x: (i64::from(self.start.x) + dx) as i32,
            y: (i64::from(self.start.y) + dy) as i32,
        }
    }

    /// The steps whose pixels lie in the window. Along the major axis that is a subtraction; along
    /// the minor one the rounded height never falls, so its first and last step inside are found
    /// by bisection: at most 33 divisions each, however long the line.
    fn steps_within(&self, bounds: PixelRect) -> Range<i64> {
        let columns = [i64::from(bounds.x0), i64::from(bounds.x1)];
        let rows = [i64::from(bounds.y0), i64::from(bounds.y1)];
        let (start_x, start_y) = (i64::from(self.start.x), i64::from(self.start.y));
        let (major, minor) = if self.x_is_major {
            (offsets(columns, start_x, self.forward), offsets(rows, start_y, self.upward))
        } else {
            (offsets(rows, start_y, self.forward), offsets(columns, start_x, self.upward))
        };
        let steps = major.start.max(0)..major.end.min(self.length + 1);
        if steps.is_empty() || minor.is_empty() {
            return 0..0;
        }
        let first_at_height = |wanted: i64| {
            let (mut low, mut high) = (steps.start, steps.end);
            while low < high {
                let middle = low + (high - low) / 2;
                if self.round(self.height_at(middle)) < wanted {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            low
        };
        first_at_height(minor.start)..first_at_height(minor.end)
    }
}

/// The half-open range of coordinates, as distances from `start` in direction `sign`.
fn offsets([low, high]: [i64; 2], start: i64, sign: i64) -> Range<i64> {
    if sign > 0 { low - start..high - start } else { start - high + 1..start - low + 1 }
}
