//! Scan conversions of their own kind, each that of one library in wide use: numbers of their own
//! width, stepped from row to row, whose roundings show where samples lie on edges.
//!
//! They are tried where nothing simpler explains an answer, and are told apart by being right
//! everywhere. Widths and roundings were found by comparison with what the libraries draw
//! (`docs/league.md`).

use super::joined;
use super::place::{Emit, Place, Points, around, edges};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

rasterproof_core::named! {
    /// How rows and crossings are rounded.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
    pub enum Scan {
        /// The algorithm by which cairo fills paths without antialiasing.
        Above = "fills the rows whose centres it holds, between crossings taken 1/256 px above the centre \
                 and cut down to 1/256 px",
        /// The algorithm by which Java 2D fills paths.
        Coarse = "samples at the pixel's centre, row by row, between crossings that are stepped from the \
                  first one, all cut to 1/1024 px",
        /// The algorithm by which OpenCV fills convex polygons.
        Sides = "fills row by row between crossings stepped in 1/65536 px from the row nearest to a corner, \
                 without the last row, and draws the three sides as lines in such steps",
        /// The algorithm by which Pillow fills polygons.
        Joined = "moves corners to whole pixels (toward zero), fills every row from the first to the last \
                  between crossings rounded to the nearest pixel, halves inwards, and draws on the row of a \
                  corner to where the next one begins",
        /// The algorithm by which Java 2D fills polygons whose corners are whole pixels.
        Carried = "moves corners a quarter of a pixel right and down, and samples at the pixel's centre, row by row, \
                   between crossings in single precision that are stepped with a remainder of 31 bits",
    }
}

/// Corners farther out are not computed.
const MOST: i64 = 1 << 22;

impl Scan {
    /// As [`super::shape::Shape::trace`]. Nothing where a corner lies 2^14 px out.
    pub(super) fn trace(self, points: &Points, window: PixelRect, emit: Emit<'_>) -> bool {
        if points.as_flattened().iter().any(|v| v.abs() > MOST) {
            return false;
        }
        let (w, h) =
            (i64::from(window.x0)..window.x1.into(), i64::from(window.y0)..window.y1.into());
        let mut put = |x: i64, y: i64| {
            if w.contains(&x) && h.contains(&y) {
                // Inside the window, so both fit i32.
                emit(x as i32, y as i32, Place::In);
            }
        };
        match self {
            Self::Sides => sides(points, &mut put),
            Self::Joined => joined::trace(points, window, &mut put),
            Self::Above | Self::Coarse | Self::Carried => self.rows(points, window, &mut put),
        }
        true
    }

    /// Rows between two crossings.
    fn rows(self, points: &Points, window: PixelRect, put: &mut dyn FnMut(i64, i64)) {
        let edges = edges(points).map_array(|[p, q]| if p[1] <= q[1] { [p, q] } else { [q, p] });
        let rect = around(points, 2).intersect(&window);
        for y in i64::from(rect.y0)..rect.y1.into() {
            // From the leftmost crossing to the rightmost.
            let (mut low, mut high) = (i64::MAX, i64::MIN);
            for edge in &edges {
                let crossing = match self {
                    Self::Coarse => coarse(edge, y),
                    Self::Carried => carried(edge, y),
                    _ => above(edge, y),
                };
                if let Some(x) = crossing {
                    (low, high) = (low.min(x), high.max(x));
                }
            }
            for x in low..high {
                put(x, y);
            }
        }
    }
}

/// The first column right of the crossing of an edge with a row; nothing where it does not cross.
fn above([p, q]: &[[i64; 2]; 2], row: i64) -> Option<i64> {
    let rows = (p[1] + 127).div_euclid(256)..(q[1] + 127).div_euclid(256);
    if !rows.contains(&row) {
        return None;
    }
    let fall = row * 256 + 127 - p[1];
    let x = p[0] + (fall * (q[0] - p[0])).div_euclid(q[1] - p[1]);
    Some((x + 127).div_euclid(256))
}

/// The rows whose centres lie from `top` to before `bottom`, in 1/1024 px.
fn rows(top: i64, bottom: i64) -> std::ops::Range<i64> {
    (top + 511).div_euclid(1024)..(bottom + 511).div_euclid(1024)
}

/// As [`above`].
fn coarse([p, q]: &[[i64; 2]; 2], row: i64) -> Option<i64> {
    let ([x, top], [end, bottom]) = (p.map_array(|v| 4 * v), q.map_array(|v| 4 * v));
    let rows = rows(top, bottom);
    if !rows.contains(&row) {
        return None;
    }
    // The first crossing, and then the slope for each row.
    let (dx, dy) = (end - x, bottom - top);
    let enter = x + dx * (rows.start * 1024 + 512 - top) / dy;
    Some((enter + (row - rows.start) * (dx * 1024 / dy) + 511).div_euclid(1024))
}

/// As [`above`].
fn carried([p, q]: &[[i64; 2]; 2], row: i64) -> Option<i64> {
    let rows = (p[1] + 64 + 127).div_euclid(256)..(q[1] + 64 + 127).div_euclid(256);
    if !rows.contains(&row) {
        return None;
    }
    // The crossing with the first row, in single precision, and its column.
    let px = |v: i64| (v + 64) as f32 / 256.0;
    let (dx, dy) = (px(q[0]) - px(p[0]), px(q[1]) - px(p[1]));
    let fall = rows.start as f32 + 0.5 - px(p[1]);
    let x = px(p[0]) + fall * dx / dy;
    let column = (x - 0.5).ceil();
    // Whole columns are stepped, and what is left of them is carried in 31 bits.
    let remainder = |share: f64| (share * f64::from(i32::MAX)) as i64;
    let (slope, steps) = (f64::from(dx / dy), row - rows.start);
    let carry = remainder((x - (column - 0.5)).into()) + steps * remainder(slope - slope.floor());
    Some(column as i64 + steps * slope.floor() as i64 + (carry >> 31))
}

/// 1/65536 px in a pixel, and in a subpixel.
const ONE: i64 = 65536;
const SUB: i64 = ONE / 256;

/// One side of the fill under way: the corner it comes from, the row where it ends, its crossing and slope.
#[derive(Clone, Copy)]
struct Side {
    corner: usize,
    turn: usize,
    end: i64,
    x: i64,
    slope: i64,
}

fn sides(points: &Points, put: &mut dyn FnMut(i64, i64)) {
    for i in 0..3 {
        line(points[(i + 2) % 3], points[i], put);
    }
    let row = |p: [i64; 2]| (p[1] + 128).div_euclid(256);
    let first = (0..3).min_by_key(|&i| points[i][1]).unwrap_or(0);
    let top = row(points[first]);
    let bottom = points.iter().map(|p| row(*p)).max().unwrap_or(top);
    let side = |turn| Side { corner: first, turn, end: top, x: -ONE, slope: 0 };
    let mut both = [side(1), side(2)];
    let mut edges = 3;
    for y in top..=bottom {
        for side in &mut both {
            if y >= side.end && !next(side, points, y, &mut edges) {
                return;
            }
        }
        let [a, b] = both.map_array(|side| (side.x + ONE / 2).div_euclid(ONE));
        for x in a.min(b)..=a.max(b) {
            put(x, y);
        }
        for side in &mut both {
            side.x += side.slope;
        }
    }
}

/// Goes on to the next edge that ends in a later row; false where no edge is left.
fn next(side: &mut Side, points: &Points, y: i64, edges: &mut i32) -> bool {
    let mut from = side.corner;
    while *edges > 0 {
        *edges -= 1;
        let to = (from + side.turn) % 3;
        let end = (points[to][1] + 128).div_euclid(256);
        if end > y {
            let (start, width) = (points[from][0] * SUB, (points[to][0] - points[from][0]) * SUB);
            let slope = (2 * width + (end - y)) / (2 * (end - y));
            *side = Side { corner: to, end, x: start, slope, ..*side };
            return true;
        }
        from = to;
    }
    false
}

/// A line from end to end along its longer axis, the other coordinate stepped; and its farther end.
fn line(from: [i64; 2], to: [i64; 2], put: &mut dyn FnMut(i64, i64)) {
    let delta = [(to[0] - from[0]) * SUB, (to[1] - from[1]) * SUB];
    let major = usize::from(delta[0].abs() <= delta[1].abs());
    let minor = 1 - major;
    let (start, end, sign) = if delta[major] < 0 { (to, from, -1) } else { (from, to, 1) };
    let slope = sign * delta[minor] * ONE / (delta[major].abs() | 1);
    let nearest = |v: i64| (v * SUB + ONE / 2).div_euclid(ONE);
    put(nearest(end[0]), nearest(end[1]));
    let mut at = start[minor] * SUB + ONE / 2;
    let first = nearest(start[major]);
    for step in 0..=(delta[major].abs() / ONE) {
        let across = at.div_euclid(ONE);
        if major == 0 {
            put(first + step, across)
        } else {
            put(across, first + step)
        }
        at += slope;
    }
}
