//! Rows between whole pixels as Pillow fills them: corners cut to pixels, both ends of every side
//! included, crossings in f32, rounded to the nearest pixel, halves inwards.
//!
//! Where two sides meet in a corner and leave it the same way by more than a pixel a row, the corner's
//! row is drawn on to where the next one begins, so that thin triangles stay in one piece.

use std::ops::RangeInclusive;

use super::place::{Points, edges};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

/// A side that is not level, between whole pixels.
struct Side {
    start: [i64; 2],
    rows: RangeInclusive<i64>,
    slope: f32,
}

impl Side {
    /// A side between whole pixels, in the direction in which it is given.
    fn new([p, q]: [[i64; 2]; 2]) -> Self {
        let slope = (q[0] - p[0]) as f32 / (q[1] - p[1]) as f32;
        Self { start: p, rows: p[1].min(q[1])..=p[1].max(q[1]), slope }
    }

    /// Its x in a row.
    fn at(&self, row: i64) -> f32 {
        (row - self.start[1]) as f32 * self.slope + self.start[0] as f32
    }

    /// Whether it is slanted and has an end in the row.
    fn leans_and_ends(&self, row: i64) -> bool {
        self.slope != 0.0 && (row == *self.rows.start() || row == *self.rows.end())
    }

    /// Its crossing with the row, drawn on where it ends beside an earlier side.
    fn drawn_on(&self, earlier: &[Self], row: i64) -> f32 {
        let x = self.at(row);
        if !self.leans_and_ends(row) {
            return x;
        }
        let next = if row == *self.rows.end() { row - 1 } else { row + 1 };
        let meets = |other: &&Self| {
            let is_corner = other.leans_and_ends(row) && x.round() == other.at(row).round();
            is_corner && other.rows.contains(&next)
        };
        let Some(other) = earlier.iter().find(meets) else { return x };
        let (a, b) = (self.at(next), other.at(next));
        if x > a + 1.0 && x > b + 1.0 {
            a.max(b).round() + 1.0
        } else if x < a - 1.0 && x < b - 1.0 {
            a.min(b).round() - 1.0
        } else {
            x
        }
    }
}

/// The nearest pixel, halves to the right; beside zero in f64.
fn first(x: f32) -> i64 {
    if x >= 0.0 { (x + 0.5).floor() as i64 } else { -((f64::from(-x) + 0.5).floor() as i64) }
}

/// The nearest pixel, halves to the left.
fn last(x: f32) -> i64 {
    if x >= 0.0 { (x - 0.5).ceil() as i64 } else { -((f64::from(-x) - 0.5).ceil() as i64) }
}

/// Calls `put` with every pixel, some of them twice.
pub(super) fn trace(points: &Points, window: PixelRect, put: &mut dyn FnMut(i64, i64)) {
    let corners = points.map_array(|p| p.map_array(|v| v / 256));
    let mut sides = Vec::new();
    for [p, q] in edges(&corners) {
        if p[1] == q[1] {
            (p[0].min(q[0])..=p[0].max(q[0])).for_each(|x| put(x, p[1]));
        } else {
            sides.push(Side::new([p, q]));
        }
    }
    let bottom = corners.iter().map(|p| p[1]).max().unwrap_or(0);
    for row in i64::from(window.y0)..i64::from(window.y1) {
        let mut ends = Vec::new();
        for (i, side) in sides.iter().enumerate().filter(|(_, side)| side.rows.contains(&row)) {
            if row == *side.rows.end() && row < bottom {
                // It ends here and another goes on: an end by itself, so that pairs stay pairs.
                ends.extend([side.at(row); 2]);
            } else {
                ends.push(side.drawn_on(&sides[..i], row));
            }
        }
        ends.sort_by(f32::total_cmp);
        for pair in ends.chunks_exact(2) {
            (first(pair[0])..=last(pair[1])).for_each(|x| put(x, row));
        }
    }
}
