//! The arithmetic of [`Scanline`](super::Scanline) by itself, for the enumeration of every edge.

use std::ops::Range;

use crate::grid::SubpixelPoint;

/// The first pixel whose centre is at or after `sub`, in subpixels.
#[inline]
#[must_use]
pub fn first_centre(sub: i32) -> i32 {
    super::first_centre(sub)
}

/// The columns of the edge from `a` down to `b` in `rows`, whose centres lie in [a.y, b.y).
#[inline]
pub fn edge_columns(
    a: SubpixelPoint,
    b: SubpixelPoint,
    rows: Range<i32>,
) -> impl Iterator<Item = i64> {
    super::edge_columns(a, b, rows)
}
