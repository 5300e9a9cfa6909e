//! The table of mistakes in drawing lines. To add one, add an entry: everything else follows from it.

use super::fills::without_border;
use super::{Mistake, Parameters, border};
use crate::convention::{LineConvention, LineQuestion, Mask};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

type Ends = [[i64; 2]; 2];

/// What a mistake does, given its parameter. Pixels come from the first end to the second.
#[derive(Clone, Copy)]
pub(super) enum Stroke {
    /// These lines are drawn in place of the given one.
    Instead(fn(Ends, PixelRect, i64) -> Vec<Ends>),
    /// Its own pixels, in the window and around it.
    Own(fn(Ends, PixelRect, i64) -> Vec<[i64; 2]>),
    /// The right picture is changed.
    Changed(fn(&mut Mask, Ends, PixelRect, i64)),
}

/// Everything known, the simplest first.
pub(super) const TABLE: &[Mistake<Stroke>] = &[
    Mistake {
        name: "ends are clamped to the window",
        sentence: |p| {
            let to = [
                "the window",
                "one pixel beyond the window",
                "the upper and left border",
                "the lower and right border",
            ];
            format!("moves ends that lie outside to {}, so that the slope changes", to[p as usize])
        },
        repair: "clip the line, and keep the error term of the unclipped one",
        page: "ch07",
        refuted: "a line with an end outside that keeps its slope",
        parameters: Parameters::Fixed(&[0, 1, 2, 3]),
        draws: Stroke::Instead(|ends, window, p| {
            let clamp = |v: i64, side: i64| match p {
                0 => v.clamp(0, side - 1),
                1 => v.clamp(-1, side),
                2 => v.max(0),
                _ => v.min(side - 1),
            };
            vec![ends.map_array(|[x, y]| [clamp(x, window.x1.into()), clamp(y, window.y1.into())])]
        }),
    },
    Mistake {
        name: "lines are cut in whole numbers",
        sentence: |p| {
            let how = ["cut toward zero", "cut down", "rounded to the nearest"][(p % 3) as usize];
            format!(
                "cuts lines at the window and draws the rest as a line of its own, whose new ends are {how}: the rest takes other pixels"
            )
        },
        repair: "clip the line, and keep the error term of the unclipped one",
        page: "ch07",
        refuted: "a line across the border with the pixels of the whole line",
        parameters: Parameters::Fixed(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]),
        draws: Stroke::Instead(|ends, window, p| cut(ends, window, p).into_iter().collect()),
    },
    Mistake {
        name: "x and y are exchanged",
        sentence: |p| {
            format!(
                "exchanges x and y of {} lines, as where steep lines are turned and not turned back",
                ["steep", "flat"][p as usize]
            )
        },
        repair: "turn the pixels back where the line was turned",
        page: "ch03",
        refuted: "such a line with its own pixels",
        parameters: Parameters::Fixed(&[0, 1]),
        draws: Stroke::Instead(|ends, _, p| {
            let is_turned = is_steep(ends) == (p == 0);
            vec![if is_turned { ends.map_array(|[x, y]| [y, x]) } else { ends }]
        }),
    },
    Mistake {
        name: "lines are left out by kind",
        sentence: |p| format!("does not draw lines {}", KINDS[p as usize].0),
        repair: "treat this kind as any other",
        page: "ch03",
        refuted: "a line of that kind that is drawn",
        parameters: Parameters::Fixed(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]),
        draws: Stroke::Instead(|ends, window, p| {
            (!KINDS[p as usize].1(ends, window)).then_some(ends).into_iter().collect()
        }),
    },
    Mistake {
        name: "every pixel that is touched",
        sentence: |p| {
            let tie =
                ["along y", "along x", "diagonally", "through both neighbours"][(p % 4) as usize];
            let seen = if p < 4 { "the first end" } else { "the left end" };
            format!(
                "lights every pixel that the line from centre to centre touches (a supercover), and goes {tie} where it meets a corner of pixels, seen from {seen}"
            )
        },
        repair: "light one pixel for each step along the longer axis",
        page: "ch03",
        refuted: "a diagonal step without a pixel between",
        parameters: Parameters::Fixed(&[0, 1, 2, 3, 4, 5, 6, 7]),
        draws: Stroke::Own(supercover),
    },
    Mistake {
        name: "the slope is cut",
        sentence: |p| {
            let (bits, how) = (p / 10, p % 10);
            let cut = if how % 2 == 0 { "cut toward zero" } else { "cut down" };
            let start =
                if how / 2 == 0 { "half a pixel ahead" } else { "at the end's own coordinate" };
            format!(
                "adds a slope that is {cut} to 1/{} px, beginning {start}: on long lines the far end drifts away",
                1_i64 << bits
            )
        },
        repair: "keep the remainder of the division, as Bresenham's algorithm does",
        page: "ch03",
        refuted: "a long line that reaches its second end",
        parameters: Parameters::Fixed(&[
            160, 161, 162, 163, 80, 81, 82, 83, 100, 101, 120, 121, 40, 41,
        ]),
        draws: Stroke::Own(fixed_slope),
    },
    Mistake {
        name: "steps are added up in floats",
        sentence: |p| {
            let (how, bits) = (p / 2, ["32", "64"][(p % 2) as usize]);
            let rounded = [
                "rounded to the nearest",
                "cut toward zero",
                "cut down after 1/2 was added",
                "beginning half a pixel ahead, and cut down",
            ][how as usize];
            format!(
                "adds up steps in floats of {bits} bits, {rounded}: the height drifts along the line"
            )
        },
        repair: "compute each step from the end, or count in integers",
        page: "ch03",
        refuted: "a long line whose height is right at the far end",
        parameters: Parameters::Fixed(&[0, 1, 2, 3, 4, 5, 6, 7]),
        draws: Stroke::Own(floats),
    },
    Mistake {
        name: "steps along x alone",
        sentence: |p| {
            format!(
                "steps along {} on steep lines too, so that these have gaps",
                ["x", "y"][p as usize]
            )
        },
        repair: "step along the longer axis",
        page: "ch03",
        refuted: "a steep line without gaps",
        parameters: Parameters::Fixed(&[0, 1]),
        draws: Stroke::Own(one_axis),
    },
    Mistake {
        name: "the error term overflows",
        sentence: |p| {
            format!(
                "keeps the error term in {} bits: it wraps around on lines of more than {} steps",
                p % 100,
                1_i64 << (p % 100 - 2)
            )
        },
        repair: "use a word of twice the length",
        page: "stability",
        refuted: "such a long line that is drawn rightly",
        parameters: Parameters::Fixed(&[8, 16, 12]),
        draws: Stroke::Own(short_error),
    },
    Mistake {
        name: "ends overflow",
        sentence: |p| {
            format!(
                "keeps coordinates in {p} bits: ends beyond {} px wrap around",
                1_i64 << (p - 1)
            )
        },
        repair: "clip first, or use a longer word",
        page: "stability",
        refuted: "a line with an end out there that is drawn rightly",
        parameters: Parameters::Fixed(&[8, 12, 16]),
        draws: Stroke::Instead(|ends, _, p| {
            let shift = 64 - p as u32;
            vec![ends.map_array(|end| end.map_array(|v| v << shift >> shift))]
        }),
    },
    Mistake {
        name: "pixels at the ends",
        sentence: |p| ENDS[p as usize].0.to_owned(),
        repair: "compare the bounds of the loop with the rule for ends: one of them is one off in this direction",
        page: "ch03",
        refuted: "a line of that direction with both ends right",
        parameters: Parameters::Fixed(&[0, 1, 2, 3, 4, 5, 6, 7]),
        draws: Stroke::Changed(|mask, ends, window, p| {
            let (_, last, is_one) = ENDS[p as usize];
            let [x, y] = ends[usize::from(last)];
            if is_one(ends) {
                mask.retain(window, &|px, py| [i64::from(px), i64::from(py)] != [x, y]);
            }
        }),
    },
    Mistake {
        name: "two pixels wide",
        sentence: |p| {
            format!(
                "lights the pixel {} too",
                [
                    "to the right",
                    "below",
                    "across the line, on the side of larger coordinates",
                    "across the line, on the side of smaller coordinates"
                ][p as usize]
            )
        },
        repair: "light one pixel for each step",
        page: "ch03",
        refuted: "a step with one pixel",
        parameters: Parameters::Fixed(&[0, 1, 2, 3]),
        draws: Stroke::Instead(|ends, _, p| {
            let steep = i64::from(is_steep(ends));
            let [dx, dy] = match p {
                0 => [1, 0],
                1 => [0, 1],
                2 => [steep, 1 - steep],
                _ => [-steep, steep - 1],
            };
            vec![ends, ends.map_array(|[x, y]| [x + dx, y + dy])]
        }),
    },
    border(Stroke::Changed(|mask, _, window, p| without_border(mask, window, p))),
    Mistake {
        name: "the sign of a step",
        sentence: |p| {
            format!(
                "steps {} on lines that run {}",
                ["down the screen", "up the screen", "to the right", "to the left"][p as usize],
                ["up", "down", "to the left", "to the right"][p as usize]
            )
        },
        repair: "take the sign of the difference for the step of each axis",
        page: "ch03",
        refuted: "a line of that direction that reaches its second end",
        parameters: Parameters::Fixed(&[0, 1, 2, 3]),
        draws: Stroke::Instead(|[[x0, y0], [x1, y1]], _, p| {
            vec![match p {
                0 => [[x0, y0], [x1, y0 + (y1 - y0).abs()]],
                1 => [[x0, y0], [x1, y0 - (y1 - y0).abs()]],
                2 => [[x0, y0], [x0 + (x1 - x0).abs(), y1]],
                _ => [[x0, y0], [x0 - (x1 - x0).abs(), y1]],
            }]
        }),
    },
];

fn is_steep([[x0, y0], [x1, y1]]: Ends) -> bool {
    (y1 - y0).abs() > (x1 - x0).abs()
}

fn is_outside(window: PixelRect, [x, y]: [i64; 2]) -> bool {
    !(0..i64::from(window.x1)).contains(&x) || !(0..i64::from(window.y1)).contains(&y)
}

type IsKind = fn(Ends, PixelRect) -> bool;
const KINDS: [(&str, IsKind); 10] = [
    ("with any end outside the window", |e, w| e.iter().any(|&p| is_outside(w, p))),
    ("with both ends outside the window", |e, w| e.iter().all(|&p| is_outside(w, p))),
    ("with their first end outside the window", |e, w| is_outside(w, e[0])),
    ("with their second end outside the window", |e, w| is_outside(w, e[1])),
    ("that are steep", |e, _| is_steep(e)),
    ("that run to the left", |[a, b], _| b[0] < a[0]),
    ("that run up", |[a, b], _| b[1] < a[1]),
    ("that are upright", |[a, b], _| a[0] == b[0]),
    ("that are level", |[a, b], _| a[1] == b[1]),
    ("between a pixel and itself", |[a, b], _| a == b),
];

type OfEnds = fn(Ends) -> bool;
/// What is lost, whether that is the second end, and of which lines.
const ENDS: [(&str, bool, OfEnds); 8] = [
    ("loses the last pixel of steep lines", true, is_steep),
    ("loses the last pixel of flat lines", true, |e| !is_steep(e)),
    ("loses the last pixel of lines to the left", true, |[a, b]| b[0] < a[0]),
    ("loses the last pixel of lines that run up", true, |[a, b]| b[1] < a[1]),
    ("loses the first pixel of steep lines", false, is_steep),
    ("loses the first pixel of lines to the left", false, |[a, b]| b[0] < a[0]),
    ("loses the last pixel of upright lines", true, |[a, b]| a[0] == b[0]),
    ("loses the last pixel of level lines", true, |[a, b]| a[1] == b[1]),
];

/// Longer lines are not expected: their steps are walked one by one.
const MOST_STEPS: i64 = 1 << 16;

/// The ends, seen from the left one if that is asked; for upright ones from the upper.
fn from_left(ends: Ends, left: bool) -> Ends {
    if left && ends[0] > ends[1] { [ends[1], ends[0]] } else { ends }
}

/// The part within the window by Cohen and Sutherland, in whole numbers: p mod 3 is the rounding, p / 3 mod 2 is whether x
/// is cut before y, and from 6 on the first end is cut before the second.
fn cut([mut a, mut b]: Ends, window: PixelRect, p: i64) -> Option<Ends> {
    let last = [i64::from(window.x1) - 1, i64::from(window.y1) - 1];
    let order = if p / 3 % 2 == 0 { [1, 0] } else { [0, 1] };
    // Each end is cut at most twice.
    for _ in 0..5 {
        let outside = |p: [i64; 2], k: usize| p[k] < 0 || p[k] > last[k];
        let beyond = |k: usize| a[k].max(b[k]) < 0 || a[k].min(b[k]) > last[k];
        if beyond(0) || beyond(1) {
            return None;
        }
        let is_out = |k: usize, first: bool| outside(if first { a } else { b }, k);
        let all = match p < 6 {
            true => order.map(|k| [(k, true), (k, false)]),
            false => [true, false].map(|first| order.map(|k| (k, first))),
        };
        let next = all.into_iter().flatten().find(|&(k, first)| is_out(k, first));
        let Some((k, first)) = next else { return Some([a, b]) };
        let moved = if first { a } else { b };
        let to = if moved[k] < 0 { 0 } else { last[k] };
        let part = (b[1 - k] - a[1 - k]) * (to - a[k]);
        let whole = b[k] - a[k];
        let (part, whole) = if whole < 0 { (-part, -whole) } else { (part, whole) };
        let along = match p % 3 {
            0 => part / whole,
            1 => part.div_euclid(whole),
            _ => (2 * part + whole).div_euclid(2 * whole),
        };
        let other = a[1 - k] + along;
        let end = if first { &mut a } else { &mut b };
        (end[k], end[1 - k]) = (to, other);
    }
    None
}

fn supercover(ends: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let [[mut x, mut y], [x1, y1]] = from_left(ends, p >= 4);
    let (sx, sy) = ((x1 - x).signum(), (y1 - y).signum());
    let (dx, dy) = ((x1 - x).abs(), (y1 - y).abs());
    if dx + dy > MOST_STEPS {
        return Vec::new();
    }
    let mut error = dx - dy;
    let mut pixels = vec![[x, y]];
    while [x, y] != [x1, y1] {
        let is_tie = error == 0;
        let (along_x, along_y) = match (is_tie, p % 4) {
            (true, 0) => (false, true),
            (true, 1) => (true, false),
            (true, _) => (true, true),
            (false, _) => (error > 0, error < 0),
        };
        if is_tie && p % 4 == 3 {
            pixels.extend([[x + sx, y], [x, y + sy]]);
        }
        if along_x {
            x += sx;
            error -= 2 * dy;
        }
        if along_y {
            y += sy;
            error += 2 * dx;
        }
        pixels.push([x, y]);
        if pixels.len() as i64 > 4 * MOST_STEPS {
            break;
        }
    }
    pixels
}

fn fixed_slope([[x0, y0], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let (bits, how) = (p / 10, p % 10);
    let steps = (x1 - x0).abs().max((y1 - y0).abs());
    if steps > MOST_STEPS {
        return Vec::new();
    }
    let cut = |d: i64| match (steps, how % 2) {
        (0, _) => 0,
        (_, 0) => (d << bits) / steps,
        _ => (d << bits).div_euclid(steps),
    };
    let (sx, sy) = (cut(x1 - x0), cut(y1 - y0));
    let half = if how / 2 == 0 { 1 << (bits - 1) } else { 0 };
    (0..=steps)
        .map(|i| [((x0 << bits) + half + i * sx) >> bits, ((y0 << bits) + half + i * sy) >> bits])
        .collect()
}

fn floats([[x0, y0], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let (how, single) = (p / 2, p % 2 == 0);
    let r = |v: f64| if single { f64::from(v as f32) } else { v };
    let steps = (x1 - x0).abs().max((y1 - y0).abs());
    if steps > MOST_STEPS {
        return Vec::new();
    }
    let slope = |d: i64| if steps == 0 { 0.0 } else { r(d as f64 / steps as f64) };
    let (sx, sy) = (slope(x1 - x0), slope(y1 - y0));
    let ahead = if how == 3 { 0.5 } else { 0.0 };
    let (mut x, mut y) = (r(x0 as f64 + ahead), r(y0 as f64 + ahead));
    let pixel = |v: f64| match how {
        0 => v.round() as i64,
        1 => v as i64,
        3 => v.floor() as i64,
        _ => (v + 0.5).floor() as i64,
    };
    let mut pixels = Vec::with_capacity(steps as usize + 1);
    for _ in 0..=steps {
        pixels.push([pixel(x), pixel(y)]);
        (x, y) = (r(x + sx), r(y + sy));
    }
    pixels
}

fn one_axis([[x0, y0], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let turned = |[x, y]: [i64; 2]| if p == 0 { [x, y] } else { [y, x] };
    let ([u0, v0], [u1, v1]) = (turned([x0, y0]), turned([x1, y1]));
    let (steps, sign) = ((u1 - u0).abs(), (u1 - u0).signum());
    if steps > MOST_STEPS {
        return Vec::new();
    }
    (0..=steps)
        .map(|i| {
            let rise =
                if steps == 0 { 0 } else { (2 * (v1 - v0) * i + steps).div_euclid(2 * steps) };
            turned([u0 + sign * i, v0 + rise])
        })
        .collect()
}

fn short_error([[mut x, mut y], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let shift = 64 - (p % 100) as u32;
    let word = |v: i64| v << shift >> shift;
    let (dx, dy) = (word((x1 - x).abs()), word(-(y1 - y).abs()));
    let (sx, sy) = (if x < x1 { 1 } else { -1 }, if y < y1 { 1 } else { -1 });
    let steps = (x1 - x).abs().max((y1 - y).abs());
    if steps > MOST_STEPS {
        return Vec::new();
    }
    let mut error = word(dx + dy);
    let mut pixels = Vec::new();
    // Such a line need not arrive.
    for _ in 0..=2 * steps {
        pixels.push([x, y]);
        if [x, y] == [x1, y1] {
            break;
        }
        let twice = word(2 * error);
        if twice >= dy {
            error = word(error + dy);
            x += sx;
        }
        if twice <= dx {
            error = word(error + dx);
            y += sy;
        }
    }
    pixels
}

/// The picture of pixels in a window.
pub(super) fn mask(pixels: &[[i64; 2]], window: PixelRect) -> Mask {
    let mut mask = Mask::default();
    for &[x, y] in pixels.iter().filter(|&&p| !is_outside(window, p)) {
        // Inside the window, so both fit.
        mask.set(x as i32, y as i32);
    }
    mask
}

/// The picture of a convention; none where it says nothing.
pub(super) fn of_convention(
    convention: &LineConvention,
    ends: Ends,
    window: PixelRect,
) -> Option<Mask> {
    let ends = ends.map_array(|end| end.map_array(|v| v.clamp(-(1 << 30), 1 << 30) as i32));
    let pixels = convention.pixels(&LineQuestion { ends, window })?;
    Some(mask(&pixels.into_iter().map(|p| p.map_array(i64::from)).collect::<Vec<_>>(), window))
}
