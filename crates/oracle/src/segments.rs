//! Lines as the specification describes them: rectangles, parallelograms, and the diamond-exit rule;
//! exactly.
//!
//! Positions are subpixels. A rectangular line of width 1 covers the samples whose distance from the
//! line is at most half a pixel, between its ends. A parallelogram has sides of 1 px along the minor axis
//! through both ends. By the diamond-exit rule a segment from a to b lights
//! the pixels whose diamond |x - cx| + |y - cy| < 1/2 px it enters, but not the one that holds b. Both
//! ends are moved by -(e, e^2) first, where e is so small that a smaller one changes nothing: a line
//! through the point where two diamonds meet enters one of them.

use std::collections::BTreeSet;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXELS, SubpixelPoint};

/// The ends of a segment.
pub type Ends = [SubpixelPoint; 2];
/// Pixels that are lit.
pub type Pixels = BTreeSet<(i32, i32)>;

/// How an answer stands to a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// What the rule says exactly.
    Equal,
    /// Within what the specification allows.
    Allowed,
    Outside,
}

/// The centre of a column or row, in subpixels.
fn centre(px: i32) -> i64 {
    i64::from(px) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL)
}

/// Whether a pixel's centre lies in the rectangle made wider and longer on all sides by so many
/// subpixels, with its border or without.
fn in_rectangle([a, b]: &Ends, (x, y): (i32, i32), more: i64, closed: bool) -> bool {
    let d = [i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y)];
    let s = [centre(x) - i64::from(a.x), centre(y) - i64::from(a.y)];
    let cross = i128::from(d[0] * s[1] - d[1] * s[0]);
    let dot = i128::from(d[0] * s[0] + d[1] * s[1]);
    let length2 = i128::from(d[0] * d[0] + d[1] * d[1]);
    // |cross| / length <= half + more, and -more <= dot / length <= length + more.
    let (half, more) = (i128::from(HALF_PIXEL) + i128::from(more), i128::from(more));
    // How far inside the nearer end, times the length.
    let inward = dot.min(length2 - dot);
    let along = match inward.signum() {
        -1 => more > 0 && is_within(-inward, more * more * length2, closed),
        0 => more > 0 || (more == 0 && closed),
        _ => more >= 0 || inward * inward > more * more * length2,
    };
    along && is_within(cross, half * half * length2, closed)
}

/// Whether a square is below a limit, or at it where that belongs.
fn is_within(value: i128, limit: i128, closed: bool) -> bool {
    value * value < limit || (closed && value * value == limit)
}

/// The same of a parallelogram.
fn in_parallelogram([a, b]: &Ends, (x, y): (i32, i32), more: i64, closed: bool) -> bool {
    let d = [i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y)];
    let s = [centre(x) - i64::from(a.x), centre(y) - i64::from(a.y)];
    // Where both are equal, x is the major axis. Turned so that the line goes forwards.
    let (major, minor) = if d[0].abs() >= d[1].abs() { (0, 1) } else { (1, 0) };
    let forwards = if d[major] < 0 { -1 } else { 1 };
    let (length, rise) = (d[major] * forwards, d[minor] * forwards);
    let (along, aside) = (s[major] * forwards, s[minor] * forwards);
    // A corner that is moved in x and in y moves its side by twice that at most along the minor axis.
    let off = (aside * length - along * rise).abs();
    let half = (i64::from(HALF_PIXEL) + 2 * more) * length;
    match closed {
        true => off <= half && (-more..=length + more).contains(&along),
        false => off < half && -more < along && along < length + more,
    }
}

/// How lit pixels of a window stand to a rectangle of width 1 px, on a lattice of this step.
#[must_use]
pub fn rectangle(ends: &Ends, lit: &Pixels, side_px: i32, step: i32) -> Fit {
    shape(in_rectangle, ends, lit, side_px, step)
}

/// How they stand to a parallelogram.
#[must_use]
pub fn parallelogram(ends: &Ends, lit: &Pixels, side_px: i32, step: i32) -> Fit {
    shape(in_parallelogram, ends, lit, side_px, step)
}

/// How they stand to a shape that is made wider by so many subpixels, with its border or without.
fn shape(
    holds: fn(&Ends, (i32, i32), i64, bool) -> bool,
    ends: &Ends,
    lit: &Pixels,
    side_px: i32,
    step: i32,
) -> Fit {
    let mut fit = Fit::Equal;
    for pixel in window(side_px) {
        let is_lit = lit.contains(&pixel);
        // The corners of the shape are rounded to the lattice: its sides move by a step at most.
        let [is_right, is_allowed] = match is_lit {
            true => [0, i64::from(step)].map_array(|more| holds(ends, pixel, more, true)),
            false => [0, -i64::from(step)].map_array(|more| !holds(ends, pixel, more, false)),
        };
        match (is_right, is_allowed) {
            (true, _) => {}
            (false, true) => fit = Fit::Allowed,
            (false, false) => return Fit::Outside,
        }
    }
    fit
}

/// The pixels of a window, row by row.
fn window(side_px: i32) -> impl Iterator<Item = (i32, i32)> {
    (0..side_px).flat_map(move |y| (0..side_px).map(move |x| (x, y)))
}

/// Steps of a subpixel in which ends are moved: e = 2^-20 and e^2 = 2^-40 subpixels. That is small
/// enough: what decides are signs of integers below 2^31 (a side of a diamond at an end, the area
/// between the segment and a diamond's corner), which e moves by less than 2^-20 * 2^16 < 1, and of
/// the e in them, which e^2 moves by less than e.
const FINE: i64 = 1 << 40;
const MOVED: [i64; 2] = [1 << 20, 1];

/// A point from a pixel's centre, moved, in those steps.
fn from_centre(point: SubpixelPoint, (x, y): (i32, i32)) -> [i64; 2] {
    let along = |sub: i32, px: i32, moved| (i64::from(sub) - centre(px)) * FINE - moved;
    [along(point.x, x, MOVED[0]), along(point.y, y, MOVED[1])]
}

/// Whether the moved segment enters the open diamond of a pixel.
fn enters([a, b]: &Ends, pixel: (i32, i32)) -> bool {
    let p = from_centre(*a, pixel);
    let d =
        [i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y)].map_array(|v| v * FINE);
    let half = i128::from(HALF_PIXEL) * i128::from(FINE);
    // On the segment p + t d each side sx x + sy y < half is a bound on t, a fraction.
    let (mut low, mut high) = ((0i128, 1i128), (1i128, 1i128));
    for (sx, sy) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
        let at = i128::from(sx * p[0] + sy * p[1]) - half;
        let slope = i128::from(sx * d[0] + sy * d[1]);
        match slope.signum() {
            0 if at >= 0 => return false,
            1 if -at * high.1 < high.0 * slope => high = (-at, slope),
            -1 if at * low.1 > low.0 * -slope => low = (at, -slope),
            _ => {}
        }
    }
    low.0 * high.1 < high.0 * low.1
}

/// The pixels of a window that the diamond-exit rule lights.
#[must_use]
pub fn diamonds(ends: &Ends, side_px: i32) -> Pixels {
    let [a, b] = ends;
    let mut lit = Pixels::new();
    for (x, y) in window(side_px) {
        // A pixel that holds the last end is not left.
        let [from_x, from_y] = from_centre(*b, (x, y));
        let holds_end = from_x.abs() + from_y.abs() < i64::from(HALF_PIXEL) * FINE;
        let is_near = is_in_reach([a.x, b.x], x) && is_in_reach([a.y, b.y], y);
        if is_near && !holds_end && enters(ends, (x, y)) {
            lit.insert((x, y));
        }
    }
    lit
}

/// Whether a column or row lies between two coordinates in subpixels, with one to spare.
fn is_in_reach([a, b]: [i32; 2], px: i32) -> bool {
    (a.min(b) / SUBPIXELS - 1..=a.max(b) / SUBPIXELS + 1).contains(&px)
}

/// How lit pixels stand to the diamond-exit rule. Allowed are a pixel more or fewer, each at most one
/// column and one row away from one of the rule's, and one only in each column (row) of a line that
/// is wider than high (higher than wide).
#[must_use]
pub fn diamond_exit(ends: &Ends, lit: &Pixels, side_px: i32) -> Fit {
    let ideal = diamonds(ends, side_px);
    if *lit == ideal {
        return Fit::Equal;
    }
    let [a, b] = ends;
    let is_wide = (b.x - a.x).abs() >= (b.y - a.y).abs();
    let major: BTreeSet<i32> = lit.iter().map(|p| if is_wide { p.0 } else { p.1 }).collect();
    // One that is missing needs no neighbour.
    let is_allowed = major.len() == lit.len()
        && lit.len().abs_diff(ideal.len()) <= 1
        && lit.iter().all(|p| has_neighbour(*p, &ideal))
        && (lit.len() < ideal.len() || ideal.iter().all(|p| has_neighbour(*p, lit)));
    if is_allowed { Fit::Allowed } else { Fit::Outside }
}

/// Whether a pixel, or one of the eight around it, is among these.
fn has_neighbour((x, y): (i32, i32), of: &Pixels) -> bool {
    for near_y in y - 1..=y + 1 {
        for near_x in x - 1..=x + 1 {
            if of.contains(&(near_x, near_y)) {
                return true;
            }
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ends(v: [f64; 4]) -> Ends {
        [SubpixelPoint::from_px(v[0], v[1]).unwrap(), SubpixelPoint::from_px(v[2], v[3]).unwrap()]
    }

    /// From centre to centre along a row: the last diamond is not left.
    #[test]
    fn a_row_by_hand() {
        let row = ends([1.5, 2.5, 4.5, 2.5]);
        assert_eq!(diamonds(&row, 8), [(1, 2), (2, 2), (3, 2)].into());
        let lit: Pixels = [(1, 2), (2, 2), (3, 2)].into();
        assert_eq!(diamond_exit(&row, &lit, 8), Fit::Equal);
        // The rectangle ends at both centres: its short sides hold one of them each.
        assert_eq!(rectangle(&row, &lit, 8, 1), Fit::Equal);
        let more: Pixels = [(1, 2), (2, 2), (3, 2), (4, 2)].into();
        assert_eq!(diamond_exit(&row, &more, 8), Fit::Allowed);
        let twice: Pixels = [(1, 2), (2, 2), (3, 2), (3, 3)].into();
        assert_eq!(diamond_exit(&row, &twice, 8), Fit::Outside);
        let hole: Pixels = [(1, 2), (3, 2)].into();
        assert_eq!(rectangle(&row, &hole, 8, 1), Fit::Outside);
        let moved: Pixels = [(1, 4), (2, 4), (3, 4)].into();
        assert_eq!(diamond_exit(&row, &moved, 8), Fit::Outside);
    }

    /// Along the minor axis 1 px high, so thinner than a rectangle where it slants.
    #[test]
    fn a_parallelogram_by_hand() {
        // y = x / 2 + 0.25 from x = 0 to 4.
        let slanted = ends([0.0, 0.25, 4.0, 2.25]);
        let lit: Pixels = [(0, 0), (1, 0), (1, 1), (2, 1), (3, 1), (3, 2)].into();
        assert_eq!(parallelogram(&slanted, &lit, 8, 1), Fit::Equal);
        for end in [[0.0, 0.25, 4.0, 2.25], [4.0, 2.25, 0.0, 0.25]] {
            let fewer: Pixels = [(0, 0), (1, 0), (2, 1), (3, 1)].into();
            // What lies on both borders may go either way.
            assert_eq!(parallelogram(&ends(end), &fewer, 8, 1), Fit::Equal);
            let hole: Pixels = [(0, 0), (1, 0), (3, 1)].into();
            assert_eq!(parallelogram(&ends(end), &hole, 8, 1), Fit::Outside);
            let more: Pixels = [(0, 0), (1, 0), (2, 1), (3, 1), (4, 2)].into();
            assert_eq!(parallelogram(&ends(end), &more, 8, 1), Fit::Outside);
        }
        // Upright and level lines are rectangles.
        let row = ends([1.5, 2.5, 4.5, 2.5]);
        let lit: Pixels = [(2, 2), (3, 2)].into();
        assert_eq!(parallelogram(&row, &lit, 8, 1), Fit::Equal);
        assert_eq!(rectangle(&row, &lit, 8, 1), Fit::Equal);
    }

    /// A diagonal through corners of pixels touches no diamond but those it runs through.
    #[test]
    fn a_diagonal_by_hand() {
        let diagonal = ends([0.5, 0.5, 3.5, 3.5]);
        assert_eq!(diamonds(&diagonal, 8), [(0, 0), (1, 1), (2, 2)].into());
        let lit: Pixels = [(0, 0), (1, 1), (2, 2)].into();
        assert_eq!(rectangle(&diagonal, &lit, 8, 1), Fit::Equal);
    }

    /// Through the points where diamonds meet: moved left and, far less, up, a line that falls to the
    /// right is in the lower of two diamonds, one that rises in the upper.
    #[test]
    fn points_between_diamonds_by_hand() {
        let falls = ends([0.5, 0.5, 2.5, 1.5]);
        assert_eq!(diamonds(&falls, 8), [(0, 0), (1, 1)].into());
        let rises = ends([0.5, 1.5, 2.5, 0.5]);
        assert_eq!(diamonds(&rises, 8), [(0, 1), (1, 0)].into());
        // Along a border between rows e^2 decides for the row above, and e that the end, left of
        // the last diamond's point, does not reach it.
        let border = ends([0.5, 2.0, 3.5, 2.0]);
        assert_eq!(diamonds(&border, 8), [(0, 1), (1, 1), (2, 1)].into());
    }
}
