//! Fills and strokes that visit the cells that an edge passes: coverage by signed areas, and all that is touched. Points are in
//! pixels.
//!
//! # Areas
//!
//! A side of a polygon cuts off the part of each row that lies left of it. Walking along the sides, each cell gets two sums: the height
//! that the side covers in it, which is the same in all cells right of it, and the area that is left out in the cell itself. From left to
//! right, the coverage of a cell is the sum of heights so far, less its own area. Two sides of a polygon, one downwards and one upwards,
//! leave what lies between them.

use crate::convention::Mask;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;

pub(super) type Place = [f64; 2];

/// The corners in pixels, in their order.
pub(super) fn places(corners: &Corners) -> [Place; 3] {
    corners.map_array(|p| [f64::from(p.x) / 256.0, f64::from(p.y) / 256.0])
}

/// Least coverages that are drawn, of 255.
pub(super) const LEAST: [i64; 4] = [1, 127, 128, 255];

/// One of them in words.
pub(super) fn least_said(least: i64) -> String {
    match least {
        1 => "the least area of one winding, and 1/256 px of the other".to_owned(),
        least => format!("an area of {least} of 255"),
    }
}

/// A polygon by the areas that its sides cut off in each cell, in 1/256 px and whole numbers, as Agg computes it; and
/// where the coverage is at least this. The area is shifted before its sign is lost, so that the least area of one winding counts.
pub(super) fn by_area(polygon: &[Place], window: PixelRect, least: i64) -> Mask {
    let [wide, high] = [window.x1, window.y1];
    let mut cells = vec![Cell::default(); (wide as usize + 1) * (high as usize + 1)];
    for (i, from) in polygon.iter().enumerate() {
        let side = [*from, polygon[(i + 1) % polygon.len()]];
        let points = within(side, [f64::from(wide), f64::from(high)]);
        for ends in points.windows(2) {
            let [from, to] =
                [ends[0], ends[1]].map_array(|p| p.map_array(|v| (v * 256.0).round() as i64));
            // A side is cut at whole rows first, and each part of it at whole columns.
            for of_row in pieces([from[1], to[1]], [from[0], to[0]]) {
                for Piece { cell, along, across } in pieces(of_row.across, of_row.along) {
                    let at = (of_row.cell * (i64::from(wide) + 1) + cell) as usize;
                    let height = across[1] - across[0];
                    if let Some(cell) = cells.get_mut(at) {
                        cell.height += height;
                        cell.area += (along[0] + along[1]) * height;
                    }
                }
            }
        }
    }
    let mut mask = Mask::default();
    for (y, row) in (0..high).zip(cells.chunks(wide as usize + 1)) {
        // The height of the sides so far: what lies right of them is covered by as much.
        let mut height = 0;
        for (x, Cell { height: more, area }) in (0..wide).zip(row) {
            height += more;
            if ((512 * height - area) >> 9).abs().min(255) >= least {
                mask.set(x, y);
            }
        }
    }
    mask
}

/// What sides add in a cell.
#[derive(Clone, Copy, Default)]
struct Cell {
    /// To the height right of it.
    height: i64,
    /// Twice the area that is left out in it.
    area: i64,
}

/// What an edge becomes within the window: what is left or right of it runs along its sides.
fn within([a, b]: [Place; 2], [wide, high]: Place) -> Vec<Place> {
    if a[1].max(b[1]) < 0.0 || a[1].min(b[1]) > high {
        return Vec::new();
    }
    // Where the edge is at such a place of an axis.
    let at = |axis: usize, place: f64| {
        let other = 1 - axis;
        a[other] + (place - a[axis]) * (b[other] - a[other]) / (b[axis] - a[axis])
    };
    // What lies above or below the window adds nothing.
    let [from, to] = [a, b].map_array(|p| match p[1].clamp(0.0, high) {
        y if y == p[1] => p,
        y => [at(1, y), y],
    });
    // The sides that it crosses come in the order in which it passes them.
    let mut sides = [0.0, wide];
    if to[0] < from[0] {
        sides.reverse();
    }
    let (least, most) = (from[0].min(to[0]), from[0].max(to[0]));
    let mut all = vec![from];
    for side in sides {
        if least < side && side < most {
            all.push([side, at(0, side)]);
        }
    }
    all.push(to);
    for [x, _] in &mut all {
        *x = x.clamp(0.0, wide);
    }
    all
}

/// A part of an edge in a cell, in 1/256 px.
struct Piece {
    cell: i64,
    /// Its ends along the axis of the cells, from the beginning of the cell.
    along: [i64; 2],
    /// Its ends along the other axis.
    across: [i64; 2],
}

/// Cuts an edge at whole pixels of the first axis. The ends along the other axis are rounded down from the first end of the edge.
fn pieces([u0, u1]: [i64; 2], [v0, v1]: [i64; 2]) -> Vec<Piece> {
    let (first, last) = (u0 >> 8, u1 >> 8);
    let (long, rise) = ((u1 - u0).abs().max(1), v1 - v0);
    let step = if last < first { -1 } else { 1 };
    let mut pieces = Vec::new();
    let (mut cell, mut from, mut at) = (first, u0, v0);
    while cell != last {
        // The side where the edge leaves the cell, and its height there.
        let side = 256 * (cell + i64::from(step > 0));
        let next = v0 + ((side - u0).abs() * rise).div_euclid(long);
        let along = [from - 256 * cell, side - 256 * cell];
        pieces.push(Piece { cell, along, across: [at, next] });
        (cell, from, at) = (cell + step, side, next);
    }
    let along = [from - 256 * cell, u1 - 256 * cell];
    pieces.push(Piece { cell, along, across: [at, v1] });
    pieces
}

/// The least step of a walk along an edge, in pixels.
const LEAST_STEP: f64 = 1e-9;

/// The pixels that an edge touches, walked from its left end from side to side of pixels, in floats of 64 bits. What it touches by
/// less than `open` at its last end, or along a side of pixels, is left out where that is not 0.
pub(super) fn touched([mut a, mut b]: [Place; 2], window: PixelRect, open: f64) -> Mask {
    let mut mask = Mask::default();
    let [wide, high] = [window.x1, window.y1].map_array(f64::from);
    let is_beyond =
        |axis: usize, side: f64| a[axis].max(b[axis]) < 0.0 || a[axis].min(b[axis]) > side;
    if is_beyond(0, wide) || is_beyond(1, high) {
        return mask;
    }
    if a[0] > b[0] {
        (a, b) = (b, a);
    }
    let mut light = |x: f64, y: f64| {
        if (0.0..wide).contains(&x) && (0.0..high).contains(&y) {
            // Within the window.
            mask.set(x as i32, y as i32);
        }
    };
    // An edge that does not leave a column or a row is walked along it.
    // In one column or one row.
    for axis in [0, 1] {
        let along = 1 - axis;
        if a[axis].floor() != b[axis].floor() && (a[axis] - b[axis]).abs() >= open {
            continue;
        }
        let is_side = |v: f64| (v - v.round()).abs() < open;
        if !is_side(a[axis]) || !is_side(b[axis]) {
            let (from, to) = (a[along].min(b[along]), a[along].max(b[along]));
            let [end, across] = [if axis == 0 { high } else { wide }, b[axis]];
            let mut at = from.max(0.0).floor();
            while at <= (to - open).floor() && at < end {
                if axis == 0 {
                    light(across, at)
                } else {
                    light(at, across)
                }
                at += 1.0;
            }
        }
        return mask;
    }
    let slope = (b[1] - a[1]) / (b[0] - a[0]);
    let [mut x, mut y] = a;
    let mut end = b[0].min(wide);
    if x < 0.0 {
        y -= x * slope;
        x = 0.0;
    }
    // The walk begins and ends where the edge enters the window and leaves it.
    let (near, far) = if slope > 0.0 { (0.0, high) } else { (high, 0.0) };
    let y_end = y + (end - x) * slope;
    if (y - near) * slope < 0.0 {
        x += (near - y) / slope;
        y = near;
    }
    if (y_end - far) * slope > 0.0 {
        end = end.min(x + (far - y) / slope);
    }
    // From pixel to pixel: through its right side, or through its upper or lower one.
    while x < end {
        let row = y.floor();
        light(x, y);
        let to_side = (x + 1.0).floor() - x;
        if (y + to_side * slope).floor() == row {
            (x, y) = (x + to_side, y + to_side * slope);
        } else {
            let next = if slope < 0.0 { row } else { row + 1.0 };
            let step = (next - y).abs().max(LEAST_STEP) * slope.signum();
            (x, y) = (x + step / slope, y + step);
        }
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::random::Rng;

    /// Half of a pixel is drawn as its exact area says, but for what rounding to 1/256 px can decide; and a walk along an edge
    /// lights what it passes.
    #[test]
    fn areas_and_walks_are_those_of_exact_shapes() {
        let mut rng = Rng::new("cells", 1, 0);
        let window = PixelRect::window(16, 16);
        let (mut seen, mut passed) = (0, 0);
        for _ in 0..200 {
            let polygon =
                [0; 3].map_array(|_| [0; 2].map_array(|_| rng.int(-2048, 6144) as f64 / 256.0));
            let drawn = by_area(&polygon, window, 128);
            let walked = touched([polygon[0], polygon[1]], window, 0.0);
            for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
                let of = |polygon: &[Place]| clipped(polygon, [x, y].map_array(f64::from));
                let area = {
                    let left = of(&polygon);
                    let cross = |i: usize| {
                        let [a, b] = [left[i], left[(i + 1) % left.len()]];
                        a[0] * b[1] - a[1] * b[0]
                    };
                    (0..left.len()).map(cross).sum::<f64>().abs() / 2.0
                };
                if (area - 0.5).abs() > 3.0 / 256.0 {
                    assert_eq!(drawn.has(x, y), area > 0.5, "{polygon:?} {x} {y} {area}");
                    seen += u32::from(area > 0.0 && area < 1.0);
                }
                let part = of(&polygon[..2]);
                let length =
                    part.iter().map(|p| (p[0] - part[0][0]).abs() + (p[1] - part[0][1]).abs());
                if length.fold(0.0, f64::max) > 1e-6 {
                    assert!(walked.has(x, y), "{polygon:?} {x} {y}");
                    passed += 1;
                }
            }
        }
        assert!(seen > 1000 && passed > 1000, "{seen} {passed}");
    }

    /// The part of a polygon in a pixel.
    fn clipped(polygon: &[Place], at: Place) -> Vec<Place> {
        let mut left = polygon.to_vec();
        for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
            let side = if sign > 0.0 { at[axis] } else { at[axis] + 1.0 };
            let before = |p: &Place| sign * (p[axis] - side);
            let mut kept = Vec::new();
            for (i, from) in left.iter().enumerate() {
                let to = &left[(i + 1) % left.len()];
                let [a, b] = [before(from), before(to)];
                kept.extend((a >= 0.0).then_some(*from));
                if (a >= 0.0) != (b >= 0.0) {
                    kept.push(
                        [0, 1].map_array(|k: usize| from[k] + (to[k] - from[k]) * (a / (a - b))),
                    );
                }
            }
            left = kept;
        }
        left
    }
}
