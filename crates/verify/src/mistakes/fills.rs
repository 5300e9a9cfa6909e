//! The wrong fills that the table names, as functions of the corners in subpixels (1/256 px).

use super::values::rounded;
use crate::convention::{Mask, Ties, TriangleConvention, facing};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::{self, centre, twice_area};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;

pub(super) type Point = [i64; 2];

pub(super) fn points(corners: &Corners) -> [Point; 3] {
    corners.map_array(|c| [i64::from(c.x), i64::from(c.y)])
}

/// Every pixel of the window of whose sample it is true.
fn each_sample(window: PixelRect, sample: [i32; 2], is_in: &dyn Fn(Point) -> bool) -> Mask {
    let [sx, sy] = sample.map_array(i64::from);
    let mut mask = Mask::default();
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            if is_in([i64::from(x) * 256 + sx, i64::from(y) * 256 + sy]) {
                mask.set(x, y);
            }
        }
    }
    mask
}

/// Fills by a test of each edge: its number in the given order, the edge function in 1/65536 square pixels, positive
/// inside, and whether the rule gives it its ties.
pub(super) fn by_edges(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    test: &dyn Fn(usize, i128, bool) -> bool,
) -> Mask {
    if twice_area(corners) == 0 {
        return Mask::default();
    }
    let owns = owned(corners, base);
    by_all_edges(corners, window, base, &|values| {
        values.iter().zip(owns).enumerate().all(|(i, (value, owns))| test(i, *value, owns))
    })
}

/// Which edges of a triangle own the samples that lie on them; one without area is counterclockwise.
fn owned(corners: &Corners, base: &TriangleConvention) -> [bool; 3] {
    let (points, sign) = (points(corners), if twice_area(corners) > 0 { 1 } else { -1 });
    [0, 1, 2].map_array(|i: usize| {
        let [p, q] = [points[i], points[(i + 1) % 3]];
        match [sign * (p[1] - q[1]), sign * (q[0] - p[0])] {
            // An edge without length faces nowhere.
            [0, 0] => base.ties.edges.iter().all(|owns| *owns),
            [a, b] => base.ties.edges[facing(a, b)],
        }
    })
}

/// The samples whose three edge functions, positive inside, pass a test.
pub(super) fn by_all_edges(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    test: &dyn Fn([i128; 3]) -> bool,
) -> Mask {
    let points = points(corners);
    let sign = twice_area(corners).signum() as i64;
    if sign == 0 {
        return Mask::default();
    }
    let edges = [0, 1, 2].map_array(|i: usize| {
        let [p, q] = [points[i], points[(i + 1) % 3]];
        (p, sign * (p[1] - q[1]), sign * (q[0] - p[0]))
    });
    // The products of most fit in 64 bits.
    let is_near = points.as_flattened().iter().all(|v| v.abs() < 1 << 29);
    each_sample(window, super::sample_of(base), &|at| {
        test(edges.map_array(|(p, a, b)| {
            let [x, y] = [at[0] - p[0], at[1] - p[1]];
            match is_near {
                true => i128::from(a * x + b * y),
                false => i128::from(a) * i128::from(x) + i128::from(b) * i128::from(y),
            }
        }))
    })
}

/// A number in a word of so many bits, as it wraps around.
pub(super) fn wrap(v: i128, bits: i64) -> i128 {
    let shift = 128 - bits as u32;
    v << shift >> shift
}

/// Words that are too short for edge functions.
pub(super) struct Words {
    /// Bits of fraction that coordinates have.
    pub(super) fraction: i64,
    pub(super) bits: i64,
    /// Whether the winding is not read off such words.
    knows_winding: bool,
    /// Whether the words of the difference of two products are long enough.
    pub(super) products_alone: bool,
}

impl Words {
    pub(super) fn of(p: i64) -> Self {
        Self {
            fraction: p / 100 % 10,
            bits: p % 100,
            knows_winding: p / 1000 % 2 == 1,
            products_alone: p >= 2000,
        }
    }
}

/// Edge functions in such words.
pub(super) fn wrapping(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let Words { fraction, bits, knows_winding, products_alone } = Words::of(p);
    let cut = |v: i64| i128::from((v + (256 >> fraction) / 2).div_euclid(256 >> fraction));
    let points = points(corners).map_array(|p| p.map_array(cut));
    let word = |v: i128| wrap(v, bits);
    let sum = |v: i128| if products_alone { v } else { word(v) };
    let cross = |a: [i128; 2], b: [i128; 2], c: [i128; 2]| {
        sum(word((b[0] - a[0]) * (c[1] - a[1])) - word((b[1] - a[1]) * (c[0] - a[0])))
    };
    let [a, b, c] = points;
    let area = if knows_winding { twice_area(corners) } else { cross(a, b, c) };
    if area == 0 {
        return Mask::default();
    }
    let sign = area.signum();
    let small = |v: i128| v.signum() as i64;
    each_sample(window, super::sample_of(base), &|at| {
        let at = at.map_array(cut);
        [[a, b], [b, c], [c, a]].iter().all(|&[p, q]| {
            let value = sum(sign * cross(p, q, at));
            let [x, y] = [sign * (p[1] - q[1]), sign * (q[0] - p[0])].map_array(small);
            let owns = (x, y) != (0, 0) && base.ties.edges[facing(x, y)];
            value > 0 || (value == 0 && owns)
        })
    })
}

/// Corners in words of so many bits with so many of fraction: wrapped around or clamped.
pub(super) fn in_words(corners: &Corners, clamps: bool, fraction: i64, bits: i64) -> Corners {
    let most = 1_i64 << (bits - 1);
    let word = |v: i32| {
        let scaled = if fraction > 8 {
            i64::from(v) << (fraction - 8)
        } else {
            i64::from(v) >> (8 - fraction)
        };
        let rest = if fraction < 8 { i64::from(v) & ((256 >> fraction) - 1) } else { 0 };
        let kept = match clamps {
            true => scaled.clamp(-most, most - 1),
            false => wrap(scaled.into(), bits) as i64,
        };
        // What the word does not hold of the fraction is left as it was: grids have an entry of their own.
        let back =
            if fraction > 8 { kept >> (fraction - 8) } else { (kept << (8 - fraction)) + rest };
        back as i32
    };
    corners.map_array(|c| SubpixelPoint::new(word(c.x), word(c.y)))
}

/// The fan of what lies within the window; corners on its border are put on a grid of `step` subpixels.
pub(super) fn clipped(corners: &Corners, window: PixelRect, step: i64, how: i64) -> Vec<Corners> {
    let mut polygon = points(corners).to_vec();
    let [wide, high] = [i64::from(window.x1) * 256, i64::from(window.y1) * 256];
    let inside = |p: Point, side: usize| match side {
        0 => p[0],
        1 => wide - p[0],
        2 => p[1],
        _ => high - p[1],
    };
    for side in 0..4 {
        let mut kept = Vec::new();
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let [u, v] = [inside(from, side), inside(to, side)];
            if u >= 0 {
                kept.push(from);
            }
            if (u < 0) != (v < 0) {
                // In doubles, as programs compute it.
                let part = u as f64 / (u - v) as f64;
                kept.push([0, 1].map_array(|axis| {
                    let (from, way) = (from[axis] as f64, (to[axis] - from[axis]) as f64);
                    let on_grid = |v: f64, cut: fn(f64) -> f64| cut(v / step as f64) * step as f64;
                    let new = match how {
                        0 => from + on_grid(part * way, f64::trunc),
                        1 => on_grid(from + part * way, f64::round),
                        _ => on_grid(from + part * way, f64::floor),
                    };
                    new as i64
                }));
            }
        }
        polygon = kept;
    }
    let narrow = |p: Point| SubpixelPoint::new(p[0] as i32, p[1] as i32);
    (2..polygon.len()).map(|i| [polygon[0], polygon[i - 1], polygon[i]].map_array(narrow)).collect()
}

/// The corners from top to bottom.
pub(super) fn sorted(corners: &Corners) -> [Point; 3] {
    geometry::sorted(points(corners), |a, b| a[1] > b[1])
}

/// The row of the first sample below the middle corner.
pub(super) fn middle_row(corners: &Corners) -> i64 {
    (sorted(corners)[1][1] + 127).div_euclid(256)
}

/// The pixels that programs look at around a triangle: from the first column to the last and from the first row to the last.
/// The last ones hold the largest coordinates, or these are rounded up; or the ends are rounded to samples.
pub(super) fn boxes(corners: &Corners) -> [[[i64; 2]; 2]; 3] {
    let of = |least: i64, most: i64| {
        let points = points(corners);
        let mut axes = [[0; 2]; 2];
        for (axis, ends) in axes.iter_mut().enumerate() {
            let v = points.map_array(|p| p[axis]);
            let (low, high) = (v[0].min(v[1]).min(v[2]), v[0].max(v[1]).max(v[2]));
            *ends = [(low + least).div_euclid(256), (high + most).div_euclid(256)];
        }
        axes
    };
    [of(0, 0), of(0, 255), of(127, -129)]
}

/// The two halves, where the point on the long edge is put on a grid.
pub(super) fn split(corners: &Corners, step: i32, down: bool) -> Vec<Corners> {
    let [top, middle, bottom] = sorted(corners);
    let narrow = |p: Point| SubpixelPoint::new(p[0] as i32, p[1] as i32);
    let high = bottom[1] - top[1];
    if high == 0 || middle[1] == top[1] || middle[1] == bottom[1] {
        return vec![*corners];
    }
    let (part, step) =
        (i128::from(bottom[0] - top[0]) * i128::from(middle[1] - top[1]), i128::from(step));
    let (part, whole) = (part + i128::from(top[0]) * i128::from(high), i128::from(high) * step);
    let x =
        if down { part.div_euclid(whole) } else { (2 * part + whole).div_euclid(2 * whole) } * step;
    let cut = [x as i64, middle[1]];
    vec![[top, middle, cut].map_array(narrow), [middle, cut, bottom].map_array(narrow)]
}

/// A size of a triangle: twice its area in 1/65536 square pixels, or a length in subpixels.
type Metric = fn(&Corners) -> i64;

/// What may be measured, in which unit that is said, and how much it is.
pub(super) const METRICS: [(&str, &str, Metric); 9] = [
    ("area", "square px", |corners| {
        i64::try_from(twice_area(corners).abs()).unwrap_or(i64::MAX / 32)
    }),
    ("width", "px", |corners| extent(xs(corners))),
    ("height", "px", |corners| extent(ys(corners))),
    ("longer side", "px", |corners| extent(xs(corners)).max(extent(ys(corners)))),
    ("shorter side", "px", |corners| extent(xs(corners)).min(extent(ys(corners)))),
    ("ratio of twice the area to the square of the longest side", "", |corners| {
        let points = points(corners).map_array(|p| p.map_array(|v| v as f64));
        let longest = (0..3)
            .map(|i| {
                let ([ax, ay], [bx, by]) = (points[i], points[(i + 1) % 3]);
                (bx - ax).powi(2) + (by - ay).powi(2)
            })
            .fold(1.0, f64::max);
        (twice_area(corners).abs() as f64 / longest * RATIOS as f64) as i64
    }),
    ("farthest coordinate", "px", |corners| farthest(xs(corners)).max(farthest(ys(corners)))),
    ("farthest x", "px", |corners| farthest(xs(corners))),
    ("farthest y", "px", |corners| farthest(ys(corners))),
];
/// The first of the metrics that are coordinates; those before it are sizes.
pub(super) const FARTHEST: usize = 6;
/// The one that is a ratio, in so many parts, and no size.
pub(super) const RATIO: usize = 5;
pub(super) const RATIOS: i64 = 1 << 20;

pub(super) fn metric(corners: &Corners, which: usize) -> i64 {
    METRICS[which].2(corners)
}

fn xs(corners: &Corners) -> [i32; 3] {
    corners.map_array(|c| c.x)
}

fn ys(corners: &Corners) -> [i32; 3] {
    corners.map_array(|c| c.y)
}

fn extent(of: [i32; 3]) -> i64 {
    let [least, most] = [of.into_iter().min(), of.into_iter().max()];
    i64::from(most.unwrap_or(0)) - i64::from(least.unwrap_or(0))
}

fn farthest(of: [i32; 3]) -> i64 {
    of.map_array(|v| i64::from(v).abs()).into_iter().max().unwrap_or(0)
}

/// `value / of` with three digits that count.
pub(super) fn decimal(value: i64, of: i64) -> String {
    let number = value as f64 / of as f64;
    let digits =
        if number == 0.0 { 0 } else { (2 - number.abs().log10().floor() as i32).clamp(0, 6) };
    let text = format!("{number:.*}", digits as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Whether it has a level edge, and whether that is the upper one.
pub(super) fn flat(corners: &Corners) -> Option<bool> {
    let [top, middle, bottom] = sorted(corners);
    match (top[1] == middle[1], middle[1] == bottom[1]) {
        (true, false) => Some(true),
        (false, true) => Some(false),
        _ => None,
    }
}

/// Positive where the middle corner lies right of the long edge.
pub(super) fn middle_side(corners: &Corners) -> i64 {
    let [top, middle, bottom] = sorted(corners).map_array(|p| p.map_array(i128::from));
    if top[1] == middle[1] || middle[1] == bottom[1] { 0 } else { side(top, middle, bottom) }
}

/// The same where an edge is level: of two corners at one height, the one that is named first comes first.
pub(super) fn side_of_long(corners: &Corners) -> i64 {
    let [top, middle, bottom] = sorted(corners).map_array(|p| p.map_array(i128::from));
    side(top, middle, bottom)
}

fn side(top: [i128; 2], middle: [i128; 2], bottom: [i128; 2]) -> i64 {
    let cross =
        (bottom[0] - top[0]) * (middle[1] - top[1]) - (bottom[1] - top[1]) * (middle[0] - top[0]);
    -cross.signum() as i64
}

pub(super) fn holds(window: PixelRect, corner: SubpixelPoint) -> bool {
    (0..=window.x1 * 256).contains(&corner.x) && (0..=window.y1 * 256).contains(&corner.y)
}

/// See `ENDS` of the table.
pub(super) fn ends(mask: &mut Mask, _: &Corners, window: PixelRect, which: i64) {
    let full = *mask;
    let has = |x: i32, y: i32| window.contains(x, y) && full.has(x, y);
    let rows: Vec<i32> =
        (window.y0..window.y1).filter(|&y| (window.x0..window.x1).any(|x| has(x, y))).collect();
    let columns: Vec<i32> =
        (window.x0..window.x1).filter(|&x| (window.y0..window.y1).any(|y| has(x, y))).collect();
    let (Some((&top, &bottom)), Some((&left, &right))) =
        (rows.first().zip(rows.last()), columns.first().zip(columns.last()))
    else {
        return;
    };
    match which {
        0 => mask.retain(window, &|_, y| y != top),
        1 => mask.retain(window, &|_, y| y != bottom),
        2 => mask.retain(window, &|x, y| has(x - 1, y)),
        3 => mask.retain(window, &|x, y| has(x + 1, y)),
        4 => mask.retain(window, &|x, _| x != left),
        5 => mask.retain(window, &|x, _| x != right),
        _ => {
            for y in window.y0..window.y1 {
                for x in window.x0..window.x1 {
                    let added = match which {
                        6 => has(x - 1, y),
                        7 => has(x + 1, y),
                        8 => y == bottom + 1 && has(x, y - 1),
                        _ => y == top - 1 && has(x, y + 1),
                    };
                    if added {
                        mask.set(x, y);
                    }
                }
            }
        }
    }
}

/// Removes the first or last row, or the first or last column, of the window.
pub(super) fn without_border(mask: &mut Mask, window: PixelRect, which: i64) {
    mask.retain(window, &|x, y| match which {
        0 => y > 0,
        1 => y < window.y1 - 1,
        2 => x > 0,
        _ => x < window.x1 - 1,
    });
}

/// Tiles of p mod 100 pixels, by one of the tests that the table names.
pub(super) fn tiles(mask: &mut Mask, corners: &Corners, window: PixelRect, p: i64) {
    let (test, side, full) = (p / 100, (p % 100) as i32, *mask);
    let has = |x: i32, y: i32| full.has(x.min(window.x1 - 1), y.min(window.y1 - 1));
    let is_drawn = |x: i32, y: i32| window.contains(x, y) && full.has(x, y);
    let (points, sign) = (points(corners), twice_area(corners).signum() as f64);
    // Whether no edge has the point farther outside than this.
    let holds = |x: i32, y: i32, most_px: f64| {
        (0..3).all(|i| {
            let ([ax, ay], [bx, by]) = (points[i], points[(i + 1) % 3]);
            let [dx, dy] = [bx - ax, by - ay].map_array(|v| v as f64);
            let [px, py] =
                [i64::from(x) * 256 - ax, i64::from(y) * 256 - ay].map_array(|v| v as f64);
            sign * (dx * py - dy * px) >= -most_px * 256.0 * (dx * dx + dy * dy).sqrt()
        })
    };
    // Whether no edge has outside the corner pixel that lies farthest in, or in x or y farthest out.
    let is_inside = |x: i32, y: i32, is_out: [bool; 2]| {
        (0..3).all(|i| {
            let ([ax, ay], [bx, by]) = (points[i], points[(i + 1) % 3]);
            let [dx, dy] = [bx - ax, by - ay].map_array(|v| i128::from(v) * sign as i128);
            let far = |is_last: bool| i32::from(is_last) * (side - 1);
            let at = [x + far((dy < 0) != is_out[0]), y + far((dx > 0) != is_out[1])];
            let at = at.map_array(centre);
            dx * i128::from(at[1] - ay) - dy * i128::from(at[0] - ax) >= 0
        })
    };
    // Whether a sample is covered, of which nothing is known of edges beyond the window.
    let covers = |x: i32, y: i32| match window.contains(x, y) {
        true => full.has(x, y),
        false => points.into_iter().zip([1, 2, 0]).all(|([ax, ay], next)| {
            let [bx, by] = points[next];
            let [px, py] = [x, y].map_array(centre);
            sign * ((bx - ax) as f64 * (py - ay) as f64 - (by - ay) as f64 * (px - ax) as f64) > 0.0
        }),
    };
    let last = side - 1;
    let corners_of = |x: i32, y: i32, side: i32| {
        [(x, y), (x + side, y), (x, y + side), (x + side, y + side)].into_iter()
    };
    let is_kept = |x: i32, y: i32| match test {
        0 => corners_of(x, y, last).any(|(x, y)| has(x, y)),
        1 => has(x + side / 2, y + side / 2),
        3 => corners_of(x, y, side).any(|(x, y)| holds(x, y, 0.0)),
        4 => holds(x + side / 2, y + side / 2, f64::from(side) / 2.0),
        5 => holds(x, y, 0.0),
        8 => is_inside(x, y, [true, true]),
        9 => is_inside(x, y, [true, false]),
        10 => is_inside(x, y, [false, true]),
        7 => corners_of(x, y, last).any(|(x, y)| is_drawn(x, y)),
        11 => {
            covers(x + side / 2, y + side / 2) || corners_of(x, y, last).any(|(x, y)| covers(x, y))
        }
        12 | 13 => corners_of(x, y, last).all(|(x, y)| covers(x, y)),
        14 => x + side <= window.x1 && y + side <= window.y1,
        _ => has(x, y),
    };
    for y in (window.y0..window.y1).step_by(side as usize) {
        for x in (window.x0..window.x1).step_by(side as usize) {
            let (mut rows, mut columns) =
                (y..(y + side).min(window.y1), x..(x + side).min(window.x1));
            let mut kept = is_kept(x, y);
            match test {
                12 => columns = x + last..columns.end,
                13 => rows = y + last..rows.end,
                _ => (),
            }
            if test == 6 {
                // The last column of the triangle in a tile that is not full.
                let count = |x: i32| rows.clone().filter(|&y| full.has(x, y)).count();
                let is_full = columns.clone().all(|x| count(x) == rows.len());
                let lost = columns.clone().rev().find(|&x| count(x) > 0).filter(|_| !is_full);
                columns = lost.map_or(0..0, |x| x..x + 1);
                kept = false;
            }
            if !kept {
                for y in rows {
                    columns.clone().for_each(|x| mask.put(x, y, false));
                }
            }
        }
    }
}

/// A number with so many bits after its first one; the rest is cut off, or rounded to the nearest, halves to even.
pub(super) fn shortened(v: i32, bits: i64, is_cut: bool) -> i32 {
    let size = v.unsigned_abs();
    let rest = (32 - size.leading_zeros()).saturating_sub(bits as u32 + 1);
    let (kept, left) = (i64::from(size >> rest), i64::from(size) % (1 << rest) * 2);
    let up = !is_cut && (left > 1 << rest || (left == 1 << rest && kept % 2 == 1));
    ((kept + i64::from(up)) << rest) as i32 * v.signum()
}

/// Blocks that are drawn wholly or not at all: p mod 5 and p / 5 mod 5 are the powers of two of their sides, and p / 25 is the
/// place that decides: the sample of the first pixel, the middle, the sample of the last pixel, or any sample. With 4 they are
/// drawn wholly where three of their corner pixels are covered, and else pixel by pixel.
pub(super) fn blocks(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let [wide, high] = [p % 5, p / 5 % 5].map(|power| 1 << power);
    let sample = super::sample_of(base).map_array(i64::from);
    let mut mask = Mask::default();
    let sign = twice_area(corners).signum() as i64;
    if sign == 0 || [wide, high] == [1, 1] || (p / 25 == 4 && wide.min(high) == 1) {
        return mask;
    }
    let (points, owns) = (points(corners), owned(corners, base));
    let covers = |at: Point| {
        (0..3).all(|i| {
            let ([ax, ay], [bx, by]) = (points[i], points[(i + 1) % 3]);
            let [dx, dy, x, y] = [bx - ax, by - ay, at[0] - ax, at[1] - ay].map(i128::from);
            let value = i128::from(sign) * (dx * y - dy * x);
            value > 0 || (value == 0 && owns[i])
        })
    };
    let of = |x: i64, y: i64| covers([x * 256 + sample[0], y * 256 + sample[1]]);
    let begin = |first: i32, side: i64| i64::from(first).div_euclid(side) * side;
    for y in (begin(window.y0, high)..i64::from(window.y1)).step_by(high as usize) {
        for x in (begin(window.x0, wide)..i64::from(window.x1)).step_by(wide as usize) {
            let is_drawn = match p / 25 {
                0 => of(x, y),
                1 => covers([x * 256 + wide * 128, y * 256 + high * 128]),
                2 => of(x + wide - 1, y + high - 1),
                3 => (y..y + high).any(|y| (x..x + wide).any(|x| of(x, y))),
                _ => {
                    let [right, bottom] = [x + wide - 1, y + high - 1];
                    let corners = [[x, y], [right, y], [x, bottom], [right, bottom]];
                    corners.iter().filter(|[x, y]| of(*x, *y)).count() >= 3
                }
            };
            let (rows, columns) =
                (y..(y + high).min(window.y1.into()), x..(x + wide).min(window.x1.into()));
            for y in rows.filter(|_| is_drawn || p / 25 == 4) {
                for x in columns.clone().filter(|&x| is_drawn || of(x, y)) {
                    mask.set(x as i32, y as i32);
                }
            }
        }
    }
    mask
}

/// Whether areas that the sample makes with the sides add up to the whole, in floats: p mod 2 is the precision, p / 2 mod 2 is
/// whether areas are halved, and the rest is how far they may be off.
pub(super) fn areas(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    most: f64,
    p: i64,
) -> Mask {
    let r = |v: f64| rounded(v, p % 2);
    let [a, b, c] = points(corners).map_array(|p| p.map_array(|v| r(v as f64 / 256.0)));
    let half = if p / 2 % 2 == 0 { 1.0 } else { 0.5 };
    let area = |p: [f64; 2], q: [f64; 2], at: [f64; 2]| {
        let [px, py, qx, qy] = [p[0] - at[0], p[1] - at[1], q[0] - at[0], q[1] - at[1]].map(r);
        r(r(px * qy) - r(py * qx)).abs() * half
    };
    let whole = area(b, c, a);
    each_sample(window, super::sample_of(base), &|at| {
        let at = at.map_array(|v| v as f64 / 256.0);
        let sum = r(r(area(a, b, at) + area(b, c, at)) + area(c, a, at));
        whole > 0.0 && r(sum - whole).abs() <= most
    })
}

/// The first pixel of a row and one past the last; nothing where the row is empty.
fn span(mask: &Mask, window: PixelRect, y: i32) -> Option<[i32; 2]> {
    let mut columns = (window.x0..window.x1).filter(|&x| mask.has(x, y));
    let first = columns.next()?;
    Some([first, columns.next_back().unwrap_or(first) + 1])
}

/// Groups of 2, 4, 8 or 16 pixels, by p mod 4; see the table.
pub(super) fn groups(mask: &mut Mask, corners: &Corners, window: PixelRect, p: i64) {
    let n = 2 << (p % 4);
    let [[x0, x1], [y0, y1]] = boxes(corners)[0];
    let seen = |low: i64, high: i64, end: i32| {
        let end = i64::from(end);
        [low.clamp(0, end) as i32, (high + 1).clamp(0, end) as i32]
    };
    let ([x0, x1], [y0, y1]) = (seen(x0, x1, window.x1), seen(y0, y1, window.y1));
    for y in window.y0..window.y1 {
        let Some([first, end]) = span(mask, window, y) else { continue };
        let [start, stop] = match p / 4 {
            0 => [first, first + (end - first) / n * n],
            1 => [(first + n - 1) / n * n, end],
            2 => [first, end / n * n],
            3 => [first, x0 + (x1 - x0).max(0) / n * n],
            4 => [(x0 + n - 1) / n * n, end],
            5 => [first, window.x1 / n * n],
            6 => [first, first + (end - first + n - 1) / n * n],
            7 => [first / n * n, (end + n - 1) / n * n],
            8 if y >= y0 + (y1 - y0).max(0) / n * n => [end, end],
            9 if y >= window.y1 / n * n => [end, end],
            10 => [first, x0 / n * n + (x1 - x0 / n * n).max(0) / n * n],
            11 => [first / n * n, end / n * n],
            _ => [first, end],
        };
        for x in window.x0..window.x1 {
            let is_added = matches!(p / 4, 6 | 7 | 11);
            mask.put(x, y, start <= x && x < stop && (is_added || mask.has(x, y)));
        }
    }
}

/// Sets of neighbours of a pixel, and how they are said.
pub(super) const NEIGHBOURS: [(&[[i32; 2]], &str); 4] = [
    (&[[1, 0], [-1, 0], [0, 1], [0, -1]], "its four neighbours"),
    (
        &[[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]],
        "its eight neighbours",
    ),
    (&[[1, 0], [-1, 0]], "the pixels left and right of it"),
    (&[[0, 1], [0, -1]], "the pixels above and below it"),
];

/// Pixels of which any neighbour is covered, or without those of which any is not; see the table.
pub(super) fn grown(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let mut grown = base.mask(corners, window).unwrap_or_default();
    for [x, y] in NEIGHBOURS[(p / 2) as usize].0 {
        let beside = base.mask(&moved(corners, [-256 * x, -256 * y]), window).unwrap_or_default();
        if p % 2 == 0 {
            grown.add(&beside);
        } else {
            grown = grown.shared(&beside);
        }
    }
    grown
}

fn moved(corners: &Corners, [x, y]: [i32; 2]) -> Corners {
    corners.map_array(|c| SubpixelPoint::new(c.x.saturating_add(x), c.y.saturating_add(y)))
}

/// Every second row or column by a sample of its own; see the table.
pub(super) fn alternating(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let [which, way, far] = [p % 4, p / 4 % 4, p / 16];
    let by = [[1, 0], [-1, 0], [0, 1], [0, -1]][way as usize].map_array(|v| v * (128 << far));
    let mut mask = base.mask(corners, window).unwrap_or_default();
    let other = base.mask(&moved(corners, by), window).unwrap_or_default();
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            if i64::from(if which < 2 { y } else { x } % 2) == which % 2 {
                mask.put(x, y, other.has(x, y));
            }
        }
    }
    mask
}

/// What a search for covered pixels leaves out that ends too early; see the table.
pub(super) fn searched(mask: &mut Mask, window: PixelRect, p: i64) {
    let full = *mask;
    let mut is_ended = [false; 2];
    let [mut first, mut end] = [window.x0, window.x1];
    for y in window.y0..window.y1 {
        let [from, to] = match span(&full, window, y) {
            Some([from, to]) => {
                is_ended[0] = true;
                [from, to]
            }
            None => {
                is_ended[1] |= is_ended[0];
                continue;
            }
        };
        first = if p == 1 { first.max(from) } else { window.x0 };
        end = if p == 2 { end.min(to) } else { window.x1 };
        if (p == 0 && is_ended[1]) || first > from || end < to {
            let is_lost = |x: i32| (p == 0 && is_ended[1]) || x < first || x >= end;
            (from..to).filter(|x| is_lost(*x)).for_each(|x| mask.put(x, y, false));
        }
    }
}

/// Rows that begin left of the window begin at its side and keep their length.
pub(super) fn slid(
    mask: &mut Mask,
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
) {
    let points = points(corners);
    let left = points.iter().map(|p| p[0].div_euclid(256)).min().unwrap_or(0);
    if left >= i64::from(window.x0) || twice_area(corners) == 0 {
        return;
    }
    let sign = twice_area(corners).signum();
    let (owns, sample) = (owned(corners, base), super::sample_of(base));
    for y in window.y0..window.y1 {
        // The first sample on the inner side of every edge, and the one after the last.
        let [mut first, mut end] = [left, i64::MAX].map_array(i128::from);
        for i in 0..3 {
            let [p, q] = [points[i], points[(i + 1) % 3]].map_array(|p| p.map_array(i128::from));
            let [a, b] = [sign * (p[1] - q[1]), sign * (q[0] - p[0])];
            let at = i128::from(sample[0]) - p[0];
            let rest = a * at + b * (256 * i128::from(y) + i128::from(sample[1]) - p[1]);
            // It is drawn where 256 a x + rest is at least this.
            let least = i128::from(!owns[i]) - rest;
            match a.signum() {
                1 => first = first.max(-(-least).div_euclid(256 * a)),
                -1 => end = end.min((-least).div_euclid(-256 * a) + 1),
                _ if least > 0 => end = first,
                _ => (),
            }
        }
        let side = i128::from(window.x0);
        if first < side && end > side {
            let more = (side - first).min(i128::from(window.x1)) as i32;
            let end = end.min(i128::from(window.x1)) as i32;
            (end..end.saturating_add(more).min(window.x1)).for_each(|x| mask.set(x, y));
        } else if first < side && first < end {
            let more = (end - first).min(i128::from(window.x1)) as i32;
            (window.x0..more.min(window.x1)).for_each(|x| mask.set(x, y));
        }
    }
}

/// Which pixels are drawn twice; see the table.
pub(super) fn twice(mask: &Mask, corners: &Corners, window: PixelRect, p: i64) -> Mask {
    let rows: Vec<i32> =
        (window.y0..window.y1).filter(|&y| span(mask, window, y).is_some()).collect();
    let column = rows.iter().filter_map(|&y| span(mask, window, y)).map(|span| span[1] - 1).max();
    let [[_, right], [_, low]] = boxes(corners)[0];
    let has = |x: i32, y: i32| window.contains(x, y) && mask.has(x, y);
    let mut twice = *mask;
    twice.retain(window, &|x, y| {
        let span = || span(mask, window, y).unwrap_or_default();
        match p {
            0 => Some(&y) == rows.last(),
            1 => Some(&y) == rows.first(),
            2 => i64::from(y) == middle_row(corners),
            3 => i64::from(y) == low.min(i64::from(window.y1) - 1),
            4 => x == span()[0],
            5 => x == span()[1] - 1,
            6 => Some(x) == column,
            7 => true,
            9 => i64::from(x) == right.min(i64::from(window.x1) - 1),
            _ => !(has(x - 1, y) && has(x + 1, y) && has(x, y - 1) && has(x, y + 1)),
        }
    });
    twice
}

/// Edge functions whose steps are cut toward zero to a multiple of a step, from the first sample of the box on; p mod 4 is
/// the step, from 4 on the value there is a whole number, too, and from 8 on triangles without area are drawn as others.
pub(super) fn cut_edges(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let step = [256, 128, 64, 16][(p % 4) as usize];
    let sign = match twice_area(corners).signum() as i64 {
        0 if p < 8 => return Mask::default(),
        0 => -1,
        sign => sign,
    };
    let (points, owns) = (points(corners), owned(corners, base));
    let [[x0, _], [y0, _]] = boxes(corners)[0];
    let sample = super::sample_of(base);
    let start = [x0.max(0) * 256 + i64::from(sample[0]), y0.max(0) * 256 + i64::from(sample[1])];
    let way = |[a, b]: [i64; 2], from: Point, to: Point| {
        i128::from(a) * i128::from(to[0] - from[0]) + i128::from(b) * i128::from(to[1] - from[1])
    };
    let edges = [0, 1, 2].map_array(|i: usize| {
        let ([ax, ay], [bx, by]) = (points[i], points[(i + 1) % 3]);
        let steps = [sign * (ay - by), sign * (bx - ax)].map_array(|v| v / step * step);
        let value = way(steps, [ax, ay], start);
        let whole = i128::from(256 * step);
        (steps, if p % 8 < 4 { value } else { value / whole * whole })
    });
    each_sample(window, sample, &|at| {
        (0..3).all(|i| {
            let (steps, value) = edges[i];
            let value = value + way(steps, start, at);
            value > 0 || (value == 0 && owns[i])
        })
    })
}

/// What `float` computes.
pub(super) const FORMULAS: [&str; 35] = [
    "the edge function as a difference of two products",
    "the edge function as a x + b y + c with c computed once",
    "the edge function in steps that are added up pixel by pixel",
    "barycentric weights that are divided by the area first",
    "barycentric weights of which the third is 1 minus the others",
    "barycentric weights times the reciprocal of the area, the third being 1 minus the others",
    "the edge function with corners relative to the sample",
    "the products of the edge function, of differences that are exact",
    "the edge function with a fused multiplication and addition",
    "barycentric weights from corners relative to the sample, divided by the area first",
    "barycentric weights from corners relative to the sample, of which the third is 1 minus the others",
    "barycentric weights from differences to the first corner, whose weight is 1 minus the others",
    "barycentric weights from differences to the second corner, whose weight is 1 minus the others",
    "barycentric weights from differences to the last corner, whose weight is 1 minus the others",
    "barycentric weights from differences to the first corner, times the reciprocal of the area, its weight being 1 minus the others",
    "barycentric weights from differences to the last corner, times the reciprocal of the area, its weight being 1 minus the others",
    "barycentric weights from dot products of the edges, the first being 1 minus the others",
    "barycentric weights from dot products of the edges and a reciprocal, the first being 1 minus the others",
    "the edge function in steps that are added up from the first pixel of the box around the triangle on",
    "the edge function as a x + b y + c with c computed once, of each edge from its upper end",
    "the edge function with differences to the second end of each edge",
    "two barycentric weights from differences to the first corner, whose sum may be 1 at most",
    "two barycentric weights from differences to the last corner, whose sum may be 1 at most",
    "two barycentric weights from dot products of the edges, whose sum may be 1 at most",
    "the edge function as a x + b y + c with an exact c that is rounded once",
    "barycentric weights that are divided by the area, the first being 1 minus the others",
    "barycentric weights that are divided by the area, the second being 1 minus the others",
    "barycentric weights times the reciprocal of the area, the first being 1 minus the others",
    "barycentric weights times the reciprocal of the area, the second being 1 minus the others",
    "the edge function as a x + b y + c, where a and b are divided by the length of the edge",
    "two barycentric weights from dot products of the edges and a reciprocal, whose sum may be 1 at most",
    "two barycentric weights from differences to the first corner, of 0 at least, whose sum must be less than 1",
    "two barycentric weights from differences to the last corner, of 0 at least, whose sum must be less than 1",
    "two barycentric weights from dot products of the edges, of 0 at least, whose sum must be less than 1",
    "two barycentric weights from dot products of the edges and a reciprocal, of 0 at least, whose sum must be less than 1",
];

/// One of `FORMULAS`, rounded after every operation. Of corners that turn the other way, two are
/// exchanged, or the sign of every value is.
pub(super) fn float(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    formula: usize,
    exchanges: bool,
    precision: i64,
) -> Mask {
    let r = |v: f64| rounded(v, precision);
    // The last ones have a rule of their own.
    let has_rule = formula > 30;
    if has_rule && Some(base.ties) != Ties::named("top-left") {
        // Once is enough: no other base predicts anything else.
        return Mask::default();
    }
    let formula = if has_rule { [21, 22, 23, 30][formula - 31] } else { formula };
    let turns = twice_area(corners).signum() as i64;
    if turns == 0 {
        return Mask::default();
    }
    let points = points(corners);
    let is_exact = matches!(formula, 7 | 24);
    let px =
        |p: Point| p.map_array(|v| if is_exact { v as f64 / 256.0 } else { r(v as f64 / 256.0) });
    let mut ordered = points;
    let sign = if turns < 0 && !exchanges { -1.0 } else { 1.0 };
    if turns < 0 && exchanges {
        ordered.swap(1, 2);
    }
    let edge = |p: [f64; 2], q: [f64; 2], at: [f64; 2]| {
        let [dx, dy] = [q[0] - p[0], q[1] - p[1]].map_array(r);
        let [x, y] = [at[0] - p[0], at[1] - p[1]].map_array(r);
        let second = r(dy * x);
        // Products of two floats of 32 bits are exact in 64.
        match (formula, precision) {
            (8, 1) => dx.mul_add(y, -second),
            (8, _) => r(dx * y - second),
            _ => r(r(dx * y) - second),
        }
    };
    let relative = |p: [f64; 2], q: [f64; 2], at: [f64; 2]| {
        let [p, q] = [p, q].map_array(|p| [r(p[0] - at[0]), r(p[1] - at[1])]);
        r(r(p[0] * q[1]) - r(p[1] * q[0]))
    };
    let original = corners;
    let corners = ordered.map_array(px);
    let sides = [[0, 1], [1, 2], [2, 0]];
    let owns = sides.map_array(|[i, j]| {
        let [p, q] = [ordered[i], ordered[j]];
        let turned = sign as i64;
        match has_rule {
            // The side opposite to the corner whose weight is left over.
            true => i != if formula == 22 { 0 } else { 1 },
            false => base.ties.edges[facing(turned * (p[1] - q[1]), turned * (q[0] - p[0]))],
        }
    });
    // Weights that are divided by the area have its sign already.
    let sign = if matches!(formula, 3..=5 | 9..=17 | 21..=23 | 25..=28 | 30) { 1.0 } else { sign };
    let passes = |value: f64, owns: bool| sign * value > 0.0 || (value == 0.0 && owns);
    let [a, b, c] = corners;
    let area = edge(a, b, c);
    let at_sample = super::sample_of(base);
    if matches!(formula, 2 | 18) {
        let [[x0, _], [y0, _]] = boxes(original)[0];
        let first = |v: i64, end: i32| {
            if formula == 2 { 0 } else { v.clamp(0, i64::from(end)) as i32 }
        };
        let (x0, y0) = (first(x0, window.x1), first(y0, window.y1));
        let start = px([x0 * 256 + at_sample[0], y0 * 256 + at_sample[1]].map_array(i64::from));
        let mut mask = Mask::default();
        let mut rows = sides.map_array(|[i, j]| edge(corners[i], corners[j], start));
        let steps = sides.map_array(|[i, j]| {
            [r(corners[i][1] - corners[j][1]), r(corners[j][0] - corners[i][0])]
        });
        for y in y0..window.y1 {
            let mut values = rows;
            for x in x0..window.x1 {
                if (0..3).all(|i| passes(values[i], owns[i])) {
                    mask.set(x, y);
                }
                for i in 0..3 {
                    values[i] = r(values[i] + steps[i][0]);
                }
            }
            for i in 0..3 {
                rows[i] = r(rows[i] + steps[i][1]);
            }
        }
        return mask;
    }
    let reciprocal = r(1.0 / area);
    // The weights of two corners and what is left for a third one, each at the side opposite to its corner.
    let is_sum = matches!(formula, 21..=23 | 30);
    let opposite = |rest: usize, v: f64, w: f64| {
        let mut values = [w; 3];
        values[(rest + 1) % 3] = if is_sum { 1.0 - r(v + w) } else { r(r(1.0 - v) - w) };
        values[(rest + 2) % 3] = v;
        values
    };
    each_sample(window, at_sample, &|at| {
        let at = px(at);
        let values = match formula {
            0 | 7 | 8 => sides.map_array(|[i, j]| edge(corners[i], corners[j], at)),
            1 | 19 | 24 | 29 => sides.map_array(|[i, j]| {
                let [mut p, mut q] = [corners[i], corners[j]];
                let turns = formula == 19 && p[1] > q[1];
                if turns {
                    (p, q) = (q, p);
                }
                let [mut a, mut b] = [r(p[1] - q[1]), r(q[0] - p[0])];
                if formula == 29 {
                    let length = r(r(r(a * a) + r(b * b)).sqrt());
                    [a, b] = [a, b].map_array(|v| r(v * r(1.0 / length)));
                }
                let c = match formula {
                    // Of coordinates that floats of 64 bits hold with their products.
                    24 => r(p[0] * q[1] - p[1] * q[0]),
                    _ => r(-r(r(a * p[0]) + r(b * p[1]))),
                };
                let value = r(r(r(a * at[0]) + r(b * at[1])) + c);
                if turns { -value } else { value }
            }),
            3 => sides.map_array(|[i, j]| r(edge(corners[i], corners[j], at) / area)),
            4 | 5 | 10 => {
                let weight = |i: usize, j: usize| match formula {
                    4 => r(edge(corners[i], corners[j], at) / area),
                    5 => r(edge(corners[i], corners[j], at) * reciprocal),
                    _ => r(relative(corners[i], corners[j], at) / area),
                };
                let [u, v] = [weight(1, 2), weight(2, 0)];
                [r(r(1.0 - u) - v), u, v]
            }
            25..=28 => {
                let rest = (formula - 25) % 2;
                let weight = |i: usize| {
                    let value = edge(corners[(i + 1) % 3], corners[(i + 2) % 3], at);
                    if formula < 27 { r(value / area) } else { r(value * reciprocal) }
                };
                opposite(rest, weight((rest + 1) % 3), weight((rest + 2) % 3))
            }
            11..=15 | 21 | 22 => {
                // Of which corner the weight is left over.
                let rest =
                    if formula > 20 { 2 * (formula - 21) } else { [0, 1, 2, 0, 2][formula - 11] };
                let [a, b, c] = [0, 1, 2].map_array(|i| corners[(rest + i) % 3]);
                let minus = |p: [f64; 2]| [r(p[0] - a[0]), r(p[1] - a[1])];
                let [b, c, at] = [minus(b), minus(c), minus(at)];
                let cross = |p: [f64; 2], q: [f64; 2]| r(r(p[0] * q[1]) - r(p[1] * q[0]));
                let area = cross(b, c);
                let part = |v: f64| match formula {
                    14 | 15 => r(v * r(1.0 / area)),
                    _ => r(v / area),
                };
                opposite(rest, part(cross(at, c)), part(cross(b, at)))
            }
            16 | 17 | 23 | 30 => {
                let [a, b, c] = corners;
                let minus = |p: [f64; 2]| [r(p[0] - a[0]), r(p[1] - a[1])];
                let [b, c, at] = [minus(b), minus(c), minus(at)];
                let dot = |p: [f64; 2], q: [f64; 2]| r(r(p[0] * q[0]) + r(p[1] * q[1]));
                let [bb, bc, cc] = [dot(b, b), dot(b, c), dot(c, c)];
                let [ab, ac] = [dot(at, b), dot(at, c)];
                let whole = r(r(bb * cc) - r(bc * bc));
                let part = |v: f64| {
                    if matches!(formula, 17 | 30) { r(v * r(1.0 / whole)) } else { r(v / whole) }
                };
                let v = part(r(r(cc * ab) - r(bc * ac)));
                opposite(0, v, part(r(r(bb * ac) - r(bc * ab))))
            }
            20 => sides.map_array(|[i, j]| edge(corners[j], corners[i], at)).map_array(|v| -v),
            9 => sides.map_array(|[i, j]| r(relative(corners[i], corners[j], at) / area)),
            _ => sides.map_array(|[i, j]| relative(corners[i], corners[j], at)),
        };
        (0..3).all(|i| passes(values[i], owns[i]))
    })
}

/// Two halves with a level side each, row by row from the corner opposite to it, the lower one upwards. The digits of p are the
/// precision, how corners are cut, how crossings and heights become pixels, and whether the row of the level side belongs to the
/// upper half and to the lower one.
pub(super) fn halves(corners: &Corners, window: PixelRect, p: i64) -> Mask {
    let [precision, whole, ends, rows, upper, lower] = HALVES.digits(p);
    let r = |v: f64| rounded(v, precision);
    let sorted = sorted(&corners.map_array(|c| {
        let cut = |v: i32| match whole {
            0 => v,
            1 => v / 256 * 256,
            _ => v.saturating_add(128).div_euclid(256) * 256,
        };
        SubpixelPoint::new(cut(c.x), cut(c.y))
    }));
    let [top, middle, bottom] = sorted.map_array(|p| p.map_array(|v| r(v as f64 / 256.0)));
    let pixel = |v: f64, how: i64| match how {
        0 => v.trunc(),
        1 => v.floor(),
        2 => (v + 0.5).floor(),
        _ => (v - 0.5).ceil(),
    };
    let mut mask = Mask::default();
    let mut fill = |y: i64, a: f64, b: f64| {
        let clamp = |v: f64| v.clamp(0.0, f64::from(window.x1)) as i32;
        let end = pixel(a.max(b), ends) + f64::from(u8::from(ends < 3));
        for x in clamp(pixel(a.min(b), ends))..clamp(end) {
            mask.set(x, y as i32);
        }
    };
    // From the row of a corner on to that of a level side.
    let mut half = |tip: [f64; 2], a: [f64; 2], b: [f64; 2], with_last: bool| {
        let [from, to] = [tip, a].map_array(|p| pixel(p[1], rows) as i64);
        let down = a[1] >= tip[1];
        let count = (to - from).abs() + i64::from(with_last);
        let seen = if down { from + count > 0 } else { from - count < window.y1.into() };
        if count > MOST_ROWS || !seen {
            return;
        }
        let slope =
            |p: [f64; 2]| r(r(p[0] - tip[0]) / r(p[1] - tip[1])) * if down { 1.0 } else { -1.0 };
        let steps = [slope(a), slope(b)];
        let mut at = [tip[0]; 2];
        for i in 0..count {
            let y = if down { from + i } else { from - i };
            if (0..i64::from(window.y1)).contains(&y) {
                fill(y, at[0], at[1]);
            }
            at = [0, 1].map_array(|k: usize| r(at[k] + steps[k]));
        }
    };
    if middle[1] == bottom[1] {
        half(top, middle, bottom, upper == 1);
    } else if top[1] == middle[1] {
        half(bottom, top, middle, lower == 1);
    } else {
        let part = r(r(middle[1] - top[1]) / r(bottom[1] - top[1]));
        let cut = [r(top[0] + r(part * r(bottom[0] - top[0]))), middle[1]];
        half(top, middle, cut, upper == 1);
        half(bottom, middle, cut, lower == 1);
    }
    mask
}

/// Rows that are walked one by one, at most: what begins farther above the window is not expected.
pub(super) const MOST_ROWS: i64 = 1 << 16;

/// A number whose digits are choices, of so many each.
pub(super) struct Digits<const N: usize>(pub(super) [i64; N]);

impl<const N: usize> Digits<N> {
    pub(super) const fn count(&self) -> i64 {
        let (mut all, mut i) = (1, 0);
        while i < N {
            all *= self.0[i];
            i += 1;
        }
        all
    }

    pub(super) fn digits(&self, mut p: i64) -> [i64; N] {
        let mut digits = self.0;
        for digit in &mut digits {
            let many = *digit;
            *digit = p % many;
            p /= many;
        }
        digits
    }
}

pub(super) const HALVES: Digits<6> = Digits([2, 3, 4, 4, 2, 2]);

/// The loop over whole pixels: bit 0 rounds corners, bit 1 divides down, bit 2 wraps products in 16 bits, bits 3 and 4 are
/// what goes wrong at the ends, bit 5 wraps corners in 16 bits, and bit 6 cuts corners toward zero.
pub(super) fn whole_pixels(corners: &Corners, window: PixelRect, p: i64) -> Mask {
    let [rounds, down, short] = [0, 1, 2].map(|bit| p >> bit & 1 == 1);
    let (ends, is_wrapped) = (p >> 3 & 3, p >> 5 & 1 == 1);
    let whole = |v: i64| match (rounds, p >> 6) {
        (true, _) => (v + 128).div_euclid(256),
        (_, 0) => v.div_euclid(256),
        _ => v / 256,
    };
    let whole = |v: i64| if is_wrapped { wrap(whole(v).into(), 16) as i64 } else { whole(v) };
    let mut points = points(corners).map_array(|c| c.map_array(whole));
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        if points[i][1] > points[j][1] {
            points.swap(i, j);
        }
    }
    let [[x0, y0], [x1, y1], [x2, y2]] = points;
    let mut mask = Mask::default();
    let mut fill = |y: i64, a: i64, b: i64| {
        let (left, right) = (a.min(b), a.max(b) + i64::from(ends != 3));
        if (0..i64::from(window.y1)).contains(&y) {
            let clamp = |v: i64| v.clamp(0, window.x1.into()) as i32;
            for x in clamp(left)..clamp(right) {
                mask.set(x, y as i32);
            }
        }
    };
    if y0 == y2 {
        fill(y0, x0.min(x1).min(x2), x0.max(x1).max(x2));
        return mask;
    }
    let at = |x: i64, dx: i64, ahead: i64, dy: i64| {
        let product = if short { wrap(i128::from(dx * ahead), 16) as i64 } else { dx * ahead };
        x + if down { product.div_euclid(dy.max(1)) } else { product / dy.max(1) }
    };
    let last = if y1 == y2 { y1 } else { y1 - 1 };
    // Only rows of the window can be seen.
    let seen = |from: i64, to: i64| from.max(0)..=to.min(i64::from(window.y1) - 1);
    for y in seen(y0, last) {
        fill(y, at(x0, x1 - x0, y - y0, y1 - y0), at(x0, x2 - x0, y - y0, y2 - y0));
    }
    if y1 < y2 {
        let from_the_top = ends == 1 && y1 == y0;
        let first = if from_the_top { 0 } else { y1 };
        let end = if ends == 2 { y2 - 1 } else { y2 };
        for y in seen(first, end) {
            fill(y, at(x1, x2 - x1, y - y1, y2 - y1), at(x0, x2 - x0, y - y0, y2 - y0));
        }
    }
    mask
}

/// How a polygon's crossing with a row becomes a pixel, of whole corners.
pub(super) const CROSSINGS: [&str; 8] = [
    "cut down",
    "divided toward zero from the upper end",
    "rounded to the nearest",
    "cut toward zero, so that column 0 gets too much left of the window",
    "rounded by adding a half and cutting toward zero",
    "computed as a product that is divided by the height first, in 1/65536 px",
    "computed in 1/32 px, cut toward zero from the end of a side that is named last",
    "rounded to the nearest from float numbers of 32 bits",
];

/// What is drawn of the last row.
pub(super) const LAST_ROWS: [&str; 4] = [
    "the last row left out",
    "the last row drawn",
    "the last row and level sides drawn",
    "level sides and the lower ends of the others drawn",
];

/// The fill of a polygon of many libraries: corners cut to whole pixels, each row from the pixel of a crossing to that of the
/// next, both included; p is one of `CROSSINGS`, eight times one of `LAST_ROWS`, and 32 times how corners are cut: down, toward zero,
/// or to the nearest pixel.
pub(super) fn crossings(corners: &Corners, window: PixelRect, p: i64) -> Mask {
    let [kind, last] = [p % 8, p / 8 % 4];
    let whole = |v: i64| match p / 32 {
        0 => v.div_euclid(256),
        1 => v / 256,
        _ => (v + 128).div_euclid(256),
    };
    let whole = points(corners).map_array(|c| c.map_array(whole));
    let heights = whole.map_array(|c| c[1]);
    let (low, high) =
        (heights[0].min(heights[1]).min(heights[2]), heights[0].max(heights[1]).max(heights[2]));
    let mut mask = Mask::default();
    let mut fill = |y: i64, left: i64, right: i64| {
        let clamp = |v: i64| v.clamp(0, window.x1.into()) as i32;
        for x in clamp(left)..clamp(right + 1) {
            mask.set(x, y as i32);
        }
    };
    for y in low.max(0)..=high.min(i64::from(window.y1) - 1) {
        let mut found = Vec::with_capacity(4);
        for i in 0..3 {
            let (named, next) = (whole[i], whole[(i + 1) % 3]);
            let (from, to) = if named[1] <= next[1] { (named, next) } else { (next, named) };
            if from[1] == to[1] {
                if last >= 2 && y == from[1] {
                    fill(y, from[0].min(to[0]), from[0].max(to[0]));
                }
                continue;
            }
            let is_last = matches!(last, 1 | 2) && y == high && from[1] < y && y <= to[1];
            if (from[1] <= y && y < to[1]) || is_last {
                found.push(crossing(kind, from, to, next, y));
            } else if last == 3 && y == to[1] {
                fill(y, to[0], to[0]);
            }
        }
        found.sort_unstable();
        for pair in found.chunks_exact(2) {
            let (left, right) = (pair[0], pair[1]);
            match kind {
                5 => {
                    let nearest = |v: i64| (v >> 16) + ((v & 32768) >> 15);
                    let (left, right) = (nearest(left + 1), nearest(right - 1));
                    fill(y, left.min(right), left.max(right));
                }
                _ => fill(y, left, right),
            }
        }
    }
    mask
}

/// The pixel of a crossing; of kind 5 it is in 1/65536 px.
fn crossing(kind: i64, from: Point, to: Point, named: Point, y: i64) -> i64 {
    let [dx, dy, ahead] = [to[0] - from[0], to[1] - from[1], y - from[1]];
    let over = ahead * dx;
    match kind {
        0 => from[0] + over.div_euclid(dy),
        1 => from[0] + over / dy,
        2 => from[0] + (2 * over + dy).div_euclid(2 * dy),
        3 => (from[0] * dy + over) / dy,
        4 => (2 * (from[0] * dy + over) + dy) / (2 * dy),
        5 => (65536 * ahead / dy) * dx + 65536 * from[0],
        6 => {
            let other = if named == from { to } else { from };
            let [dx, dy] = [other[0] - named[0], other[1] - named[1]];
            (32 * named[0] + 32 * dx * (y - named[1]) / dy + 16) / 32
        }
        _ => {
            let slope = dx as f32 / dy as f32;
            (from[0] as f32 + slope * ahead as f32).round() as i64
        }
    }
}
