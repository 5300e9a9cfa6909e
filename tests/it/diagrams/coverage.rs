//! Diagrams of chapters 2, 3 and 9 and of the page on exhaustion: which pixels, which side, which area.

use super::{Drawing, Point, between};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::Corners;
use rasterproof_exhaustive::Enumeration as _;
use rasterproof_exhaustive::triangles::Triangles;

fn snapped(corners: [Point; 3]) -> Corners {
    corners.map(|[x, y]| SubpixelPoint::from_px(x, y).expect("diagrams stay in the domain"))
}

/// The covered spans as (row, first column, one past the last).
fn spans(corners: [Point; 3], window: PixelRect) -> Vec<[i32; 3]> {
    let mut list = Vec::new();
    Scanline.cover(snapped(corners), window, |s| list.push([s.y_px, s.x0_px, s.x1_px]));
    list
}

/// The scanline's split at the middle corner, its spans, and ties on a left and on a right edge.
pub fn split() -> String {
    let (corners, side) = ([[1.5, 0.5], [9.5, 3.5], [1.5, 7.5]], 40.0);
    let at = |[x, y]: Point| [30.0 + x * side, 20.0 + y * side];
    let mut drawing = Drawing::new(500.0, 380.0);
    drawing.grid(at([0.0, 0.0]), side, 11, 8);
    drawing.polygon("ink", &corners.map(at));
    drawing.line("two", at([1.5, 3.5]), at([9.5, 3.5]));
    drawing.label("start", at([9.6, 3.5]), [0.0, 5.0], "split 分割");
    let covered = spans(corners, PixelRect::window(11, 8));
    for &[y, x0, x1] in &covered {
        let middle = f64::from(y) + 0.5;
        drawing.line(
            "one",
            at([f64::from(x0) + 0.5, middle]),
            at([f64::from(x1 - 1) + 0.5, middle]),
        );
    }
    for (y, x) in (0..8).flat_map(|y| (0..11).map(move |x| (y, x))) {
        let is_in = covered.iter().any(|&[row, x0, x1]| row == y && (x0..x1).contains(&x));
        let centre = at([f64::from(x) + 0.5, f64::from(y) + 0.5]);
        drawing.dot(if is_in { "dot1" } else { "ring" }, centre, if is_in { 5.0 } else { 3.0 });
    }
    for (name, corner, shift) in
        [("a", 0, [-16.0, -4.0]), ("b", 1, [12.0, -8.0]), ("c", 2, [-16.0, 14.0])]
    {
        let [x, y] = at(corners[corner]);
        drawing.text("middle", [x + shift[0], y + shift[1]], name);
    }
    drawing.text("start", [30.0, 366.0], "● covered 被覆盖: xₗ ≤ x < xᵣ");
    drawing.text("start", [250.0, 366.0], "○ not covered 未被覆盖");
    drawing.svg()
}

/// The sign of an edge function at the centres around an edge.
pub fn edge_sign() -> String {
    let (a, b, side) = ([1.5, 6.5], [7.5, 0.5], 44.0);
    let at = |[x, y]: Point| [20.0 + x * side, 20.0 + y * side];
    let mut drawing = Drawing::new(440.0, 388.0);
    for (y, x) in (0..7).flat_map(|y| (0..9).map(move |x| (y, x))) {
        let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let value = twice_area(&snapped([a, b, p])) / i128::from(SUBPIXELS).pow(2);
        let class = ["dot2", "ring", "dot1"][(value.signum() + 1) as usize];
        let [px, py] = at(p);
        drawing.dot(class, [px, py], 4.0);
        drawing.text("start", [px + 5.0, py + 16.0], &value.to_string().replace('-', "−"));
    }
    drawing.arrow("ink", at(a), at(b));
    let ([ax, ay], [bx, by]) = (at(a), at(b));
    drawing.text("end", [ax - 10.0, ay - 8.0], "a");
    drawing.text("end", [bx - 10.0, by - 4.0], "b");
    drawing.text("start", [20.0, 350.0], "E > 0: inner side 内侧 · E < 0: outer side 外侧");
    drawing.text("start", [20.0, 374.0], "E = 0: on the edge 在边上");
    drawing.svg()
}

/// The rows of an edge by the integer DDA: (row, M, first column, remainder).
fn dda(a: SubpixelPoint, b: SubpixelPoint, rows: std::ops::Range<i32>) -> Vec<[i64; 4]> {
    let [dx, dy] = [b.x - a.x, b.y - a.y].map(i64::from);
    let ceil = |over: i64, under: i64| -(-over).div_euclid(under);
    let line = |y: i32| {
        let centre = i64::from(y * SUBPIXELS + HALF_PIXEL);
        let n = (i64::from(a.x) - i64::from(HALF_PIXEL)) * dy + (centre - i64::from(a.y)) * dx;
        let m = ceil(n, i64::from(SUBPIXELS));
        let column = ceil(m, dy);
        [i64::from(y), m, column, column * dy - m]
    };
    rows.map(line).collect()
}

const DDA_CORNERS: [Point; 3] = [[1.25, 0.25], [6.5, 4.75], [9.0, 0.25]];

/// One edge, row by row, in whole numbers.
pub fn dda_row() -> String {
    let side = 40.0;
    let at = |[x, y]: Point| [20.0 + x * side, 30.0 + y * side];
    let mut drawing = Drawing::new(620.0, 260.0);
    drawing.grid(at([0.0, 0.0]), side, 8, 5);
    let [a, b, _] = snapped(DDA_CORNERS);
    drawing.line("ink", at(DDA_CORNERS[0]), at(DDA_CORNERS[1]));
    let columns = [380.0, 460.0, 520.0, 590.0];
    for (x, head) in columns.into_iter().zip(["y", "M", "i", "r"]) {
        drawing.text("end", [x, 20.0], head);
    }
    for row in dda(a, b, 0..5) {
        let y = row[0] as f64 + 0.5;
        for x in 0..8 {
            let centre = at([f64::from(x) + 0.5, y]);
            let is_first = i64::from(x) == row[2];
            drawing.dot(
                if is_first { "dot1" } else { "ring" },
                centre,
                if is_first { 6.0 } else { 3.0 },
            );
        }
        for (x, number) in columns.into_iter().zip(row) {
            drawing.text("end", [x, at([0.0, y])[1] + 5.0], &number.to_string());
        }
    }
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    drawing.text("start", [20.0, 20.0], &format!("dx = {dx} · dy = {dy}"));
    drawing.svg()
}

/// Barycentric coordinates as areas.
pub fn areas() -> String {
    let (corners, p) = ([[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]], [3.0, 3.0]);
    let at = |[x, y]: Point| [60.0 + x * 36.0, 40.0 + y * 36.0];
    let area = |corners| twice_area(&snapped(corners)) / i128::from(SUBPIXELS).pow(2);
    let whole = area(corners);
    let mut drawing = Drawing::new(400.0, 370.0);
    for (i, class) in ["fill1", "fill2", "fill3"].into_iter().enumerate() {
        let (b, c) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
        drawing.polygon(class, &[at(p), at(b), at(c)]);
        let [x, y] = at([(p[0] + b[0] + c[0]) / 3.0, (p[1] + b[1] + c[1]) / 3.0]);
        let name = ["A", "B", "C"][i];
        let part = area([p, b, c]);
        drawing.text("middle", [x, y + 5.0], &format!("{name}: {part}/{whole}"));
        drawing.line("soft", at(p), at(corners[i]));
    }
    drawing.polygon("ink", &corners.map(at));
    drawing.dot("dot", at(p), 4.0);
    drawing.label("end", at(p), [-8.0, -4.0], "P (3, 3)");
    for (name, corner, anchor, shift) in [
        ("A (0, 0)", corners[0], "middle", -10.0),
        ("B (8, 0)", corners[1], "middle", -10.0),
        ("C (0, 8)", corners[2], "middle", 22.0),
    ] {
        let [x, y] = at(corner);
        drawing.text(anchor, [x, y + shift], name);
    }
    drawing.svg()
}

/// A position between the points of the grid, and the one to which it is snapped.
pub fn snapping() -> String {
    let at = |[x, y]: Point| [70.0 + (x - 434.0) * 90.0, 40.0 + (y - 434.0) * 90.0];
    let given = [1.7, 1.7015];
    let sub = given.map(|px| px * f64::from(SUBPIXELS));
    let near = SubpixelPoint::from_px(given[0], given[1]).expect("it lies in the domain");
    let near = [f64::from(near.x), f64::from(near.y)];
    let mut drawing = Drawing::new(420.0, 290.0);
    for y in 434..=436 {
        for x in 434..=437 {
            let [x, y] = at([f64::from(x), f64::from(y)]);
            drawing.dot("ring", [x, y], 5.0);
        }
    }
    for x in 434..=437 {
        let [at_x, _] = at([f64::from(x), 434.0]);
        drawing.text("middle", [at_x, 270.0], &x.to_string());
    }
    for y in 434..=436 {
        let [_, at_y] = at([434.0, f64::from(y)]);
        drawing.text("end", [50.0, at_y + 5.0], &y.to_string());
    }
    drawing.dot("dot2", at(sub), 5.0);
    drawing.dot("dot1", at(near), 6.0);
    drawing.arrow("ink", at(sub), between(at(sub), at(near), 0.85));
    drawing.label("start", at(sub), [12.0, 0.0], &format!("({:.1}, {:.1})", sub[0], sub[1]));
    drawing.label("start", at(near), [12.0, 18.0], &format!("({}, {})", near[0], near[1]));
    drawing.svg()
}

/// The two windings and their signs, y down.
pub fn winding() -> String {
    let mut drawing = Drawing::new(460.0, 220.0);
    // The example of chapter 9.
    let clockwise = [[1.0, 1.0], [4.0, 1.0], [1.0, 4.0]];
    let other = [clockwise[0], clockwise[2], clockwise[1]];
    for (left, corners) in [(20.0, clockwise), (240.0, other)] {
        let at = |[x, y]: Point| [left + x * 44.0, y * 44.0];
        let area = twice_area(&snapped(corners)) as f64 / f64::from(SUBPIXELS).powi(2);
        drawing.polygon(if area > 0.0 { "fill1" } else { "fill2" }, &corners.map(at));
        for i in 0..3 {
            let (from, to) = (at(corners[i]), at(corners[(i + 1) % 3]));
            drawing.arrow(if area > 0.0 { "one" } else { "two" }, from, between(from, to, 0.9));
            drawing.label("end", from, [-6.0, -4.0], ["a", "b", "c"][i]);
        }
        drawing.text(
            "start",
            at([0.7, 4.7]),
            &format!("2A = {area} {}", if area > 0.0 { "↻" } else { "↺" }),
        );
    }
    drawing.svg()
}

/// The lattices whose triangles are enumerated, with one of them each.
pub fn lattices() -> String {
    let (side, bits) = (50.0, [1, 2]);
    let set = |subpixel_bits| Triangles {
        window_px: 4,
        subpixel_bits,
        offset_px: [0; 2],
        all_orders: false,
        plant: None,
    };
    let examples = [[[0.5, 0.0], [4.0, 1.5], [1.0, 4.0]], [[3.75, 0.25], [3.5, 3.75], [0.0, 2.25]]];
    let mut drawing = Drawing::new(620.0, 300.0);
    for ((left, bits), corners) in [20.0, 310.0].into_iter().zip(bits).zip(examples) {
        let at = |[x, y]: Point| [left + x * side, 20.0 + y * side];
        drawing.grid(at([0.0; 2]), side, 4, 4);
        drawing.polygon("fill1", &corners.map(at));
        let steps = 4 << bits;
        for (i, j) in (0..=steps).flat_map(|j| (0..=steps).map(move |i| (i, j))) {
            let of_window = |step: i32| f64::from(step) * 4.0 / f64::from(steps);
            drawing.dot("dot", at([of_window(i), of_window(j)]), 1.5);
        }
        for [y, x0, x1] in spans(corners, PixelRect::window(4, 4)) {
            for x in x0..x1 {
                drawing.dot("dot1", at([f64::from(x) + 0.5, f64::from(y) + 0.5]), 5.0);
            }
        }
        let set = set(bits);
        let label = format!("s = {bits}: {}", counts(&set));
        drawing.text("start", [left, 246.0], &label);
    }
    for (left, bits) in [(20.0, 3), (310.0, 4)] {
        let set = set(bits);
        let label = format!("s = {bits}: {}", counts(&set));
        drawing.text("start", [left, 276.0], &label);
    }
    drawing.svg()
}

/// How many points a grid has, and how many triangles have their corners on it.
fn counts(set: &Triangles) -> String {
    let (points, triangles) = (grouped(set.chunks()), grouped(set.expected_cases()));
    format!("{points} points 点, {triangles} △")
}

/// A square of two triangles by three rules for its diagonal; each pixel in the colour of the triangle that
/// covers it.
pub fn owners() -> String {
    let halves = [[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]], [[0.0, 0.0], [4.0, 4.0], [0.0, 4.0]]];
    let mut drawing = Drawing::new(620.0, 250.0);
    for (i, rule) in ["E > 0", "E ≥ 0", "top-left 左上规则"].into_iter().enumerate() {
        let at = |[x, y]: Point| [30.0 + 200.0 * i as f64 + x * 40.0, 20.0 + y * 40.0];
        for (y, x) in (0..4).flat_map(|y| (0..4).map(move |x| (y, x))) {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            for (corners, class) in halves.into_iter().zip(["fill1", "fill2"]) {
                let [a, b, c] = corners;
                let least = [[a, b, p], [b, c, p], [c, a, p]].map(|t| twice_area(&snapped(t)));
                let least = least.into_iter().min().unwrap_or(0);
                let covers = match i {
                    0 => least > 0,
                    1 => least >= 0,
                    _ => spans(corners, PixelRect::window(4, 4))
                        .iter()
                        .any(|&[row, x0, x1]| row == y && (x0..x1).contains(&x)),
                };
                if covers {
                    let [x, y] = [f64::from(x), f64::from(y)];
                    let square = [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]];
                    drawing.polygon(class, &square.map(at));
                }
            }
            drawing.dot("dot", at(p), 2.5);
        }
        drawing.grid(at([0.0; 2]), 40.0, 4, 4);
        drawing.line("ink", at([0.0; 2]), at([4.0; 2]));
        drawing.label("middle", at([2.0, 4.0]), [0.0, 28.0], rule);
    }
    drawing.svg()
}

/// 12345 as 12,345.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let parts: Vec<_> = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    parts.join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The worked rows are those of the engine.
    #[test]
    fn dda_rows_are_the_engines() {
        let [a, b, _] = snapped(DDA_CORNERS);
        let drawn = spans(DDA_CORNERS, PixelRect::window(10, 5));
        let firsts: Vec<_> = dda(a, b, 0..5).iter().map(|row| [row[0], row[2]]).collect();
        let engine: Vec<_> =
            drawn.iter().map(|&[y, x0, _]| [i64::from(y), i64::from(x0)]).collect();
        assert_eq!(firsts, engine);
    }
}
