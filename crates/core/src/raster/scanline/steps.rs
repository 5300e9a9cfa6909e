//! The walks down the edges of a triangle, row by row, as [`Scanline`](super::Scanline) takes them: a
//! window on its arithmetic for those who want to watch.

use super::{EdgeWalk, first_centre, sort_by_height};
use crate::grid::PixelRect;
use crate::triangle::Corners;

/// Where the walk down one edge stands in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Step {
    /// The first column whose centre is not left of the edge.
    pub column: i64,
    /// How far that is to the right of the edge, in parts of a column: 0..dy.
    pub remainder: i64,
    /// Whole columns that each row adds.
    pub step_whole: i64,
    /// Parts of a column that each row takes off the remainder.
    pub step_part: i64,
    /// The parts of a column: the height of the edge in subpixels.
    pub dy: i64,
    /// Whether the next row carries: the remainder falls below 0, so dy is added and one column too.
    pub carries: bool,
}

impl Step {
    fn of(walk: &EdgeWalk) -> Self {
        let EdgeWalk { column, remainder, step_whole, step_part, dy } = *walk;
        Self { column, remainder, step_whole, step_part, dy, carries: remainder < step_part }
    }
}

/// A row of a triangle, with both walks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WalkedRow {
    /// The row.
    pub y_px: i32,
    /// The edge from the top to the bottom corner.
    pub long: Step,
    /// The edge to or from the middle corner.
    pub short: Step,
    /// Whether the short edge is the lower one, below the middle corner.
    pub is_lower: bool,
}

/// The rows of a triangle in a window, from the top, those without a pixel included.
#[must_use]
pub fn walked_rows(mut corners: Corners, bounds: PixelRect) -> Vec<WalkedRow> {
    sort_by_height(&mut corners, |corner| *corner);
    let [top, middle, bottom] = corners;
    let y0 = first_centre(top.y).max(bounds.y0);
    let y1 = first_centre(bottom.y).min(bounds.y1);
    if y0 >= y1 {
        return Vec::new();
    }
    let split = first_centre(middle.y);
    let mut long = EdgeWalk::new(top, bottom, y0);
    let mut short = if split <= y0 {
        EdgeWalk::new(middle, bottom, y0)
    } else {
        EdgeWalk::new(top, middle, y0)
    };
    let row = |y_px: i32| {
        if y_px == split {
            short = EdgeWalk::new(middle, bottom, y_px);
        }
        let is_lower = y_px >= split;
        let row = WalkedRow { y_px, long: Step::of(&long), short: Step::of(&short), is_lower };
        long.step();
        short.step();
        row
    };
    (y0..y1).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::SubpixelPoint;

    /// A carry is announced in the row before the one that shows it.
    #[test]
    fn a_carry_by_hand() {
        let corners = [(0, 0), (0, 1024), (512, 1024)].map(|(x, y)| SubpixelPoint::new(x, y));
        let rows = walked_rows(corners, PixelRect::window(8, 8));
        // The long edge goes half a column to the right in each row: x = 1/4, 3/4, 5/4, 7/4.
        let long: Vec<_> = rows.iter().map(|row| (row.long.column, row.long.carries)).collect();
        assert_eq!(long, [(0, true), (1, false), (1, true), (2, false)]);
    }
}
