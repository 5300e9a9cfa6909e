//! The table of mistakes in drawing lines. To add one, add an entry: everything else follows from it.

use super::cells;
use super::fills::without_border;
use super::values::rounded;
use super::{Mistake, Parameters, border};
use crate::convention::{LineConvention, LineQuestion, Mask};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

pub(super) type Ends = [[i64; 2]; 2];

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
            let (place, axes) = (p / 3, ["ends", "x of ends", "y of ends"][(p % 3) as usize]);
            let to = [
                "the window",
                "one pixel beyond the window",
                "the upper and left border",
                "the lower and right border",
            ];
            let range = || {
                let [low, high] = range(place, 0);
                format!("the range from {low} to {high}")
            };
            let to = to.get(place as usize).map_or_else(range, |to| (*to).to_owned());
            format!("moves {axes} that lie outside to {to}, so that the slope changes")
        },
        repair: "clip the line, and keep the error term of the unclipped one",
        page: "ch07",
        refuted: "a line with an end outside that keeps its slope",
        parameters: Parameters::Below(3 * 24),
        draws: Stroke::Instead(|ends, window, p| {
            let clamp = |v: i64, side: i32, other: i64| {
                let [low, high] = range(p / 3, side.into());
                if p % 3 == other { v } else { v.clamp(low, high) }
            };
            vec![ends.map_array(|[x, y]| [clamp(x, window.x1, 2), clamp(y, window.y1, 1)])]
        }),
    },
    Mistake {
        name: "lines are cut in whole numbers",
        sentence: |p| {
            let how = ["cut toward zero", "cut down", "rounded to the nearest"][(p % 3) as usize];
            let from = ["", ", counted from the end that is cut", ", counted from the other end"];
            if p >= SUMS {
                let which = ["the far ends of lines across the window are", "all new ends are"];
                return format!(
                    "cuts lines at the window, first in x, and draws the rest as a line of its own, whose new ends are counted from the end that is cut, by a part that is cut toward zero; {} cut as a sum: the rest takes other pixels",
                    which[(p - SUMS) as usize]
                );
            }
            if p >= 84 {
                let (axis, rest) = (["y", "x"][((p - 84) / 36) as usize], (p - 84) % 36);
                return format!(
                    "cuts lines at the window where {axis} leaves it and draws the rest as a line of its own, whose new ends are {how}{}: the rest takes other pixels",
                    from[(rest / 12) as usize]
                );
            }
            if p >= 72 {
                let how =
                    ["", "their distance from it being "][(p / 3 % 2) as usize].to_owned() + how;
                let to = ["", " and the first pixels after it"][((p - 72) / 6) as usize];
                return format!(
                    "cuts lines at the window{to} and draws the rest as a line of its own, whose new ends are both counted from the first one, {how}: the rest takes other pixels"
                );
            }
            let (from, turned) = (
                from[(p / 12 % 3) as usize],
                ["", " (turned round if its second end was cut)"][(p / 36) as usize],
            );
            format!(
                "cuts lines at the window and draws the rest as a line of its own{turned}, whose new ends are {how}{from}: the rest takes other pixels"
            )
        },
        repair: "clip the line, and keep the error term of the unclipped one",
        page: "ch07",
        refuted: "a line across the border with the pixels of the whole line",
        parameters: Parameters::Below(SUMS + 2),
        draws: Stroke::Instead(|ends, window, p| cut(ends, window, p).into_iter().collect()),
    },
    Mistake {
        name: "x and y are exchanged",
        sentence: |p| {
            format!(
                "exchanges x and y of {} lines{}, as where steep lines are turned and not turned back",
                ["steep", "flat"][(p % 2) as usize],
                [
                    "",
                    " that run to the left",
                    " that run to the right",
                    " that run up",
                    " that run down",
                    " that do not run to the right",
                    " that do not run down"
                ][(p / 2) as usize]
            )
        },
        repair: "turn the pixels back where the line was turned",
        page: "ch03",
        refuted: "such a line with its own pixels",
        parameters: Parameters::Below(14),
        draws: Stroke::Instead(|ends, _, p| {
            let [[x0, y0], [x1, y1]] = ends;
            let runs = [true, x1 < x0, x1 > x0, y1 < y0, y1 > y0, x1 <= x0, y1 <= y0];
            let is_turned = is_steep(ends) == (p % 2 == 0) && runs[(p / 2) as usize];
            vec![if is_turned { ends.map_array(|[x, y]| [y, x]) } else { ends }]
        }),
    },
    Mistake {
        name: "pixels of the line are left out",
        sentence: |p| {
            let every = 2 << (p / 2);
            let first = ["the last", "the first"][(p % 2) as usize];
            format!("loses {first} of every {every} pixels along the line")
        },
        repair: "look at the last iteration of the loop over groups of pixels",
        page: "ch03",
        refuted: "a long line without gaps",
        parameters: Parameters::Below(10),
        draws: Stroke::Changed(|mask, ends, window, p| {
            let every = 2 << (p / 2);
            let lost = if p % 2 == 0 { every - 1 } else { 0 };
            let [[x0, y0], _] = ends;
            let axis = is_steep(ends);
            mask.retain(window, &|x, y| {
                let step = if axis { i64::from(y) - y0 } else { i64::from(x) - x0 };
                step.abs() % every != lost
            });
        }),
    },
    Mistake {
        name: "drawn from both ends",
        sentence: |p| {
            format!(
                "draws the line from both ends to the middle, and a tie goes {} seen from the own end",
                ["on", "not yet"][(p % 2) as usize]
            )
        },
        repair: "draw from one end, or let both halves round the same way",
        page: "ch03",
        refuted: "a line whose halves round the same way",
        parameters: Parameters::Below(2),
        draws: Stroke::Own(|ends, _, p| {
            let [[x0, y0], [x1, y1]] = ends;
            let [dx, dy] = [x1 - x0, y1 - y0];
            let (a, b) = (dx.abs().max(dy.abs()), dx.abs().min(dy.abs()));
            if a > MOST_STEPS {
                return Vec::new();
            }
            let at = |i: i64| (2 * b * i + a - p % 2) / (2 * a).max(1);
            let steep = is_steep(ends);
            (0..=a / 2)
                .flat_map(|i| {
                    let [u, v] = if steep { [at(i), i] } else { [i, at(i)] };
                    let [u, v] = [dx.signum() * u, dy.signum() * v];
                    [[x0 + u, y0 + v], [x1 - u, y1 - v]]
                })
                .collect()
        }),
    },
    Mistake {
        name: "ties by direction",
        sentence: |p| {
            let on: Vec<&str> = (0..8)
                .filter(|octant| p >> octant & 1 == 1)
                .map(|octant| OCTANTS[octant as usize])
                .collect();
            format!(
                "lets a tie go on where lines run {}, and not yet where they run elsewhere",
                on.join(", or ")
            )
        },
        repair: "let one comparison decide in all directions",
        page: "ch03",
        refuted: "a tie in one of these directions that does not go on",
        parameters: Parameters::Octants,
        draws: Stroke::Own(by_octant),
    },
    Mistake {
        name: "halved again and again",
        sentence: |p| {
            format!(
                "draws both halves of a line from pixel to pixel, whose middle is {}: errors of the halves add up",
                ["cut toward zero", "cut down", "rounded up"][p as usize]
            )
        },
        repair: "step along the longer axis with one error term",
        page: "ch03",
        refuted: "a long line with one pixel for each step",
        parameters: Parameters::Below(3),
        draws: Stroke::Own(|ends, _, p| {
            let mut pixels = Vec::new();
            halved(ends, p, &mut pixels);
            pixels
        }),
    },
    Mistake {
        name: "lines are left out by kind",
        sentence: |p| format!("does not draw lines {}", KINDS[p as usize].0),
        repair: "treat this kind as any other",
        page: "ch03",
        refuted: "a line of that kind that is drawn",
        parameters: Parameters::Below(KINDS.len() as i64),
        draws: Stroke::Instead(|ends, window, p| {
            (!KINDS[p as usize].1(ends, window)).then_some(ends).into_iter().collect()
        }),
    },
    Mistake {
        name: "every pixel that is touched",
        sentence: |p| {
            let tie =
                ["along y", "along x", "diagonally", "through both neighbours"][(p % 4) as usize];
            let seen = match p / 4 {
                0 => "the first end",
                1 => "the left end",
                2 => "the first end, as times of crossings in floats of 64 bits have it",
                _ if p == 15 => {
                    "the left end, walked in floats of 64 bits in steps of at least 1e-9 px"
                }
                _ => "the first end, as times of crossings in floats of 32 bits have it",
            };
            format!(
                "lights every pixel that the line from centre to centre touches (a supercover), and goes {tie} where it meets a corner of pixels, seen from {seen}"
            )
        },
        repair: "light one pixel for each step along the longer axis",
        page: "ch03",
        refuted: "a diagonal step without a pixel between",
        parameters: Parameters::Below(16),
        draws: Stroke::Own(supercover),
    },
    Mistake {
        name: "a stroke of area",
        sentence: |p| {
            let least = cells::least_said(cells::LEAST[(p % 4) as usize]);
            format!(
                "draws a line as an area of 1 px across and {}, and a pixel of it from {least} on",
                ["from centre to centre", "half a pixel longer at both ends"][(p / 4) as usize]
            )
        },
        repair: "light one pixel for each step along the longer axis",
        page: "ch03",
        refuted: "a step with one pixel",
        parameters: Parameters::Below(8),
        draws: Stroke::Own(stroke),
    },
    Mistake {
        name: "the slope is cut",
        sentence: |p| {
            let [bits, cut, start, ends] = slope_of(p);
            let cut = ["cut toward zero", "cut down", "rounded"][cut as usize];
            let start = [
                "half a pixel ahead",
                "at the end's own coordinate",
                "a step before half a pixel",
                "half a pixel ahead in x and a step before it in y",
                "half a pixel ahead in y and a step before it in x",
            ][start as usize];
            format!(
                "adds a slope that is {cut} to 1/{} px, beginning {start}{}: on long lines the far end drifts away",
                1_i64 << bits,
                ["", ", and does not draw the last pixel"][ends as usize]
            )
        },
        repair: "keep the remainder of the division, as Bresenham's algorithm does",
        page: "ch03",
        refuted: "a long line that reaches its second end",
        parameters: Parameters::Below(9 * 3 * 5 * 2),
        draws: Stroke::Own(fixed_slope),
    },
    Mistake {
        name: "steps are added up in floats",
        sentence: |p| {
            let (how, bits) = (p / 3, ["32", "64", "16"][(p % 3) as usize]);
            if how >= NORMALISED {
                let [up, centre, whole] =
                    [1, 2, 4].map(|bit| usize::from((how - NORMALISED) & bit > 0));
                return format!(
                    "brings ends to numbers from -1 to 1, clips in them, comes back {} and cuts them to whole pixels, which rounding may move, and adds up steps{}, beginning {}, in floats of {bits} bits",
                    ["with half a pixel added", "to the centres"][centre],
                    ["", " upwards"][up],
                    [
                        "half a step after the first end, without the last pixel",
                        "half a pixel ahead"
                    ][whole]
                );
            }
            [
                "adds up steps in floats of {} bits, rounded to the nearest: the height drifts along the line",
                "adds up steps in floats of {} bits, cut toward zero: the height drifts along the line",
                "adds up steps in floats of {} bits, cut down after 1/2 was added: the height drifts along the line",
                "adds up steps in floats of {} bits, beginning half a pixel ahead, and cut down: the height drifts along the line",
                "computes each step from the slope and the height at 0 (y = m x + b) in floats of {} bits: both are rounded",
                "computes each step from the slope and the first end in floats of {} bits: the slope is rounded",
                "computes each step from the slope and the left end in floats of {} bits: the slope is rounded",
                "interpolates between the ends, a + (b - a) t, in floats of {} bits, rounded",
                "interpolates between the ends, a + (b - a) t, in floats of {} bits, cut toward zero",
                "interpolates between the ends, a (1 - t) + b t, in floats of {} bits, rounded",
                "interpolates between the ends, a (1 - t) + b t, in floats of {} bits, cut toward zero",
                "rounds the slope to a float of {} bits and computes each step from the first end",
                "divides by a step too many, in floats of {} bits, rounded: the line does not reach its second end",
                "divides by a step too few, in floats of {} bits, rounded: the line runs beyond its second end",
            ][how as usize]
                .replace("{}", bits)
        },
        repair: "count in integers, as Bresenham's algorithm does",
        page: "ch03",
        refuted: "a long line whose height is right at the far end",
        parameters: Parameters::Below(3 * (NORMALISED + 8)),
        draws: Stroke::Own(floats),
    },
    Mistake {
        name: "the error term is off",
        sentence: |p| {
            let (_, start) = STARTS[(p % 9) as usize];
            let (up, down) = [("2b", "2a"), ("b", "2a"), ("2b", "a")][(p / 9 % 3) as usize];
            let from = ["the first end", "the left end"][(p / 54) as usize];
            format!(
                "begins the error term at {start}, adds {up} for a step and takes away {down} where it is {} 0 (a is the longer side of the line and b the shorter one, seen from {from}); 2b - a, 2b and 2a are right",
                ["above", "at least"][(p / 27 % 2) as usize]
            )
        },
        repair: "derive the error term from the distances of both pixels to the line",
        page: "ch03",
        refuted: "a line whose middle step is where it should be",
        parameters: Parameters::Below(108),
        draws: Stroke::Own(error_term),
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
        name: "one step at a time",
        sentence: |p| {
            let axes = ["x", "y"];
            format!(
                "steps along {} or else along {}, never along both at once, so that a slanted line is a staircase",
                axes[(p % 2) as usize],
                axes[(1 - p % 2) as usize]
            )
        },
        repair: "test the error for each axis by itself, without an else",
        page: "ch03",
        refuted: "two pixels in turn that share a corner alone",
        parameters: Parameters::Below(4),
        draws: Stroke::Own(staircase),
    },
    Mistake {
        name: "the error term overflows",
        sentence: |p| {
            format!(
                "keeps the error term{} in {} bits: it wraps around on lines of more than about {} steps",
                ["", ", which begins at half the steps,", ", which begins at 2b - a,"]
                    [(p / 100) as usize],
                p % 100,
                1_i64 << (p % 100 - if p / 100 == 1 { 1 } else { 2 })
            )
        },
        repair: "use a word of twice the length",
        page: "stability",
        refuted: "such a long line that is drawn rightly",
        parameters: Parameters::Fixed(&[8, 16, 12, 108, 116, 112, 208, 216, 212]),
        draws: Stroke::Own(short_error),
    },
    Mistake {
        name: "ends overflow",
        sentence: |p| {
            let (what, far) = match p / 100 {
                2 => {
                    let bits = p % 100;
                    return format!(
                        "keeps coordinates in {bits} bits without a sign: ends beyond 0 to {} px wrap around",
                        (1_i64 << bits) - 1
                    );
                }
                0 => ("coordinates", "ends beyond"),
                _ => ("the differences of both ends", "lines of more than"),
            };
            let bits = p % 100;
            format!("keeps {what} in {bits} bits: {far} {} px wrap around", 1_i64 << (bits - 1))
        },
        repair: "clip first, or use a longer word",
        page: "stability",
        refuted: "a line with an end out there that is drawn rightly",
        parameters: Parameters::Fixed(&[8, 12, 16, 108, 112, 116, 208, 216]),
        draws: Stroke::Instead(|ends, _, p| {
            if p >= 200 {
                return vec![ends.map_array(|end| end.map_array(|v| v & ((1 << (p - 200)) - 1)))];
            }
            let shift = 64 - (p % 100) as u32;
            let from = if p < 100 { [0; 2] } else { ends[0] };
            let word = |end: [i64; 2]| {
                [0, 1].map_array(|k: usize| from[k] + ((end[k] - from[k]) << shift >> shift))
            };
            vec![ends.map_array(word)]
        }),
    },
    Mistake {
        name: "pixels at the ends",
        sentence: |p| ENDS[p as usize].0.to_owned(),
        repair: "compare the bounds of the loop with the rule for ends: one of them is one off in this direction",
        page: "ch03",
        refuted: "a line of that direction with both ends right",
        parameters: Parameters::Below(ENDS.len() as i64),
        draws: Stroke::Changed(|mask, ends, window, p| {
            let (_, is_last, is_one) = ENDS[p as usize];
            let [x, y] = ends[usize::from(is_last(ends))];
            if is_one(ends) {
                mask.retain(window, &|px, py| [i64::from(px), i64::from(py)] != [x, y]);
            }
        }),
    },
    Mistake {
        name: "each axis is rounded in its own way",
        sentence: |p| {
            let ways = ["down", "up", "to the nearest, halves up", "to the nearest, halves down"];
            format!(
                "rounds y of flat lines {} and x of steep ones {}",
                ways[(p % 4) as usize],
                ways[(p / 4) as usize]
            )
        },
        repair: "round both coordinates to the nearest pixel in the same way",
        page: "ch03",
        refuted: "a steep line with the pixels of a flat one, turned",
        parameters: Parameters::Below(16),
        draws: Stroke::Own(|ends @ [[x0, y0], [x1, y1]], _, p| {
            let way = if is_steep(ends) { p / 4 } else { p % 4 };
            // The same for both is a convention.
            let steps = (x1 - x0).abs().max((y1 - y0).abs());
            if p % 4 == p / 4 || steps > MOST_STEPS {
                return Vec::new();
            }
            let at = |from: i64, to: i64, i: i64| {
                let (part, whole) = ((to - from) * i, steps.max(1));
                from + match way {
                    0 => part.div_euclid(whole),
                    1 => -(-part).div_euclid(whole),
                    2 => (2 * part + whole).div_euclid(2 * whole),
                    _ => -(whole - 2 * part).div_euclid(2 * whole),
                }
            };
            (0..=steps).map(|i| [at(x0, x1, i), at(y0, y1, i)]).collect()
        }),
    },
    Mistake {
        name: "steps without the sign",
        sentence: |p| {
            format!(
                "steps as often as the larger of dx and dy says, whose signs are kept, so that lines {}",
                [
                    "to the left and up are lost and others to the left or up have gaps",
                    "to the left and up are a point and others to the left or up have gaps"
                ][p as usize]
            )
        },
        repair: "take the larger of the absolute values of dx and dy",
        page: "ch03",
        refuted: "a line to the left without gaps",
        parameters: Parameters::Below(2),
        draws: Stroke::Own(|[[x0, y0], [x1, y1]], _, p| {
            let steps = (x1 - x0).max(y1 - y0);
            if steps <= 0 || steps > MOST_STEPS {
                let is_drawn = steps == 0 || (p == 1 && steps < 0);
                return if is_drawn { vec![[x0, y0]] } else { Vec::new() };
            }
            let at = |from: i64, to: i64, i: i64| {
                from + (2 * (to - from) * i + steps).div_euclid(2 * steps)
            };
            (0..=steps).map(|i| [at(x0, x1, i), at(y0, y1, i)]).collect()
        }),
    },
    Mistake {
        name: "long lines end early",
        sentence: |p| format!("ends every line after {p} pixels"),
        repair: "step as often as the line is long",
        page: "ch03",
        refuted: "a longer line that reaches its second end",
        parameters: Parameters::Fixed(&[
            64, 100, 127, 128, 200, 255, 256, 500, 511, 512, 1000, 1023, 1024, 2000, 2047, 2048,
            4095, 4096, 8191, 8192, 10_000,
        ]),
        draws: Stroke::Changed(|mask, ends, window, p| {
            let ([x0, y0], steep) = (ends[0], is_steep(ends));
            mask.retain(window, &|x, y| {
                let step = if steep { i64::from(y) - y0 } else { i64::from(x) - x0 };
                step.abs() < p
            });
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

/// How lines run in each octant: bit 0 is whether they are steep, bit 1 whether they run to the left, and bit 2 whether they run up.
const OCTANTS: [&str; 8] = [
    "right and down, flat",
    "right and down, steep",
    "left and down, flat",
    "left and down, steep",
    "right and up, flat",
    "right and up, steep",
    "left and up, flat",
    "left and up, steep",
];

fn octant([[x0, y0], [x1, y1]]: Ends) -> i64 {
    i64::from(is_steep([[x0, y0], [x1, y1]])) + 2 * i64::from(x1 < x0) + 4 * i64::from(y1 < y0)
}

fn by_octant(ends: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let [[x0, y0], [x1, y1]] = ends;
    let [dx, dy] = [x1 - x0, y1 - y0];
    let (a, b) = (dx.abs().max(dy.abs()), dx.abs().min(dy.abs()));
    // The same in all directions is a convention.
    if a > MOST_STEPS || p == 0 || p == 255 {
        return Vec::new();
    }
    let less = 1 - (p >> octant(ends) & 1);
    (0..=a)
        .map(|i| {
            let rise = (2 * b * i + a - less).div_euclid(2 * a.max(1));
            let [u, v] = if is_steep(ends) { [rise, i] } else { [i, rise] };
            [x0 + dx.signum() * u, y0 + dy.signum() * v]
        })
        .collect()
}

/// The octants in which ties go on, as most answers have it; `of` are lines with their pictures.
pub(super) fn octants(of: &mut dyn Iterator<Item = (Ends, PixelRect, &Mask)>) -> i64 {
    let mut more = [0; 8];
    for (ends, window, drawn) in of {
        let on = 1 << octant(ends);
        let is_so = |p: i64| i32::from(mask(&by_octant(ends, window, p), window) == *drawn);
        more[octant(ends) as usize] += is_so(on) - is_so(255 - on);
    }
    (0..8).map(|octant| i64::from(more[octant as usize] > 0) << octant).sum()
}

/// The pixels of both halves of a line.
fn halved([a, b]: Ends, p: i64, pixels: &mut Vec<[i64; 2]>) {
    let middle = [0, 1].map_array(|k: usize| match p {
        0 => (a[k] + b[k]) / 2,
        1 => (a[k] + b[k]).div_euclid(2),
        _ => (a[k] + b[k] + 1).div_euclid(2),
    });
    if middle == a || middle == b || pixels.len() as i64 > 2 * MOST_STEPS {
        return pixels.extend([a, b]);
    }
    halved([a, middle], p, pixels);
    halved([middle, b], p, pixels);
}

fn is_steep([[x0, y0], [x1, y1]]: Ends) -> bool {
    (y1 - y0).abs() > (x1 - x0).abs()
}

fn is_outside(window: PixelRect, [x, y]: [i64; 2]) -> bool {
    !(0..i64::from(window.x1)).contains(&x) || !(0..i64::from(window.y1)).contains(&y)
}

/// The range of a place: at a window with such a side, or powers of two.
fn range(place: i64, side: i64) -> [i64; 2] {
    let far = i64::from(i32::MAX);
    let limit = 64 << ((place - 4).max(0) / 2);
    match place {
        0 => [0, side - 1],
        1 => [-1, side],
        2 => [0, far],
        3 => [-far, side - 1],
        _ => [-limit, limit - place % 2],
    }
}

type IsKind = fn(Ends, PixelRect) -> bool;
const KINDS: [(&str, IsKind); 15] = [
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
    ("that are upright and run up", |[a, b], _| a[0] == b[0] && b[1] < a[1]),
    ("that are upright and run down", |[a, b], _| a[0] == b[0] && b[1] > a[1]),
    ("that are level and run to the left", |[a, b], _| a[1] == b[1] && b[0] < a[0]),
    ("that are level and run to the right", |[a, b], _| a[1] == b[1] && b[0] > a[0]),
    ("that run to the left and up", |[a, b], _| b[0] < a[0] && b[1] < a[1]),
];

type OfEnds = fn(Ends) -> bool;
/// What is lost, whether that is the second end, and of which lines.
const ENDS: [(&str, OfEnds, OfEnds); 15] = [
    ("loses the last pixel of steep lines", |_| true, is_steep),
    ("loses the last pixel of flat lines", |_| true, |e| !is_steep(e)),
    ("loses the last pixel of lines to the left", |_| true, |[a, b]| b[0] < a[0]),
    ("loses the last pixel of lines that run up", |_| true, |[a, b]| b[1] < a[1]),
    ("loses the first pixel of steep lines", |_| false, is_steep),
    ("loses the first pixel of lines to the left", |_| false, |[a, b]| b[0] < a[0]),
    ("loses the last pixel of upright lines", |_| true, is_upright),
    ("loses the last pixel of level lines", |_| true, is_level),
    ("loses the last pixel of level and of upright lines", |_| true, is_straight),
    (
        "loses the right end of level lines and the lower end of upright ones",
        is_forward,
        is_straight,
    ),
    (
        "loses the left end of level lines and the upper end of upright ones",
        |e| !is_forward(e),
        is_straight,
    ),
    ("loses the right end of level lines", is_forward, is_level),
    ("loses the lower end of upright lines", is_forward, is_upright),
    (
        "loses the last pixel of slanted lines, which are neither level nor upright",
        |_| true,
        |e| !is_straight(e),
    ),
    (
        "loses the last pixel of diagonal lines",
        |_| true,
        |[a, b]| (b[0] - a[0]).abs() == (b[1] - a[1]).abs(),
    ),
];

fn is_upright([a, b]: Ends) -> bool {
    a[0] == b[0]
}

fn is_level([a, b]: Ends) -> bool {
    a[1] == b[1]
}

fn is_straight(ends: Ends) -> bool {
    is_upright(ends) || is_level(ends)
}

/// Whether it runs to the right, or down where it is upright.
fn is_forward([a, b]: Ends) -> bool {
    b > a
}

/// Longer lines are not expected: their steps are walked one by one.
const MOST_STEPS: i64 = 1 << 16;

/// Whether a line is short enough that each mistake says what it draws.
pub(super) fn is_walked([from, to]: Ends) -> bool {
    (0..2).all(|axis| (to[axis] - from[axis]).abs() <= MOST_STEPS)
}

/// The ends, seen from the left one if that is asked; for upright ones from the upper.
fn from_left(ends: Ends, left: bool) -> Ends {
    if left && ends[0] > ends[1] { [ends[1], ends[0]] } else { ends }
}

/// From here on parts are products with a slope in floats, and a sum is cut in place of a part: of second ends beyond the far
/// side, where the first one lay before the near side, or of all ends.
const SUMS: i64 = 84 + 2 * 36;

/// The part within the window by Cohen and Sutherland, in whole numbers: p mod 3 is the rounding, p / 3 mod 2 is whether x
/// is cut before y, p / 6 mod 2 is whether the first end is cut before the second, p / 12 mod 3 is from where a new end is
/// counted, and from 36 on a line is turned round whose second end was cut.
fn cut([mut a, mut b]: Ends, window: PixelRect, p: i64) -> Option<Ends> {
    if (72..84).contains(&p) {
        return cut_both([a, b], window, p - 72);
    }
    // From 84 on one axis is cut alone.
    let sums = p - SUMS;
    let (p, axes) = match p {
        SUMS.. => (15, [false; 2]),
        84.. => ((p - 84) % 36, [p < 120, p >= 120]),
        _ => (p, [false; 2]),
    };
    let last = [i64::from(window.x1) - 1, i64::from(window.y1) - 1];
    let order = if p / 3 % 2 == 0 { [1, 0] } else { [0, 1] };
    let p_order = p % 12;
    let mut turns = false;
    // The way of the line, and the axis along which it was cut last.
    let (mut way, mut cut_along) = ([0; 2], 2);
    let mut began_before = false;
    // Each end is cut at most twice.
    for _ in 0..5 {
        let outside = |p: [i64; 2], k: usize| !axes[k] && (p[k] < 0 || p[k] > last[k]);
        let beyond = |k: usize| !axes[k] && (a[k].max(b[k]) < 0 || a[k].min(b[k]) > last[k]);
        if beyond(0) || beyond(1) {
            return None;
        }
        let is_out = |k: usize, first: bool| outside(if first { a } else { b }, k);
        let all = match p_order < 6 {
            true => order.map(|k| [(k, true), (k, false)]),
            false => [true, false].map(|first| order.map(|k| (k, first))),
        };
        let next = all.into_iter().flatten().find(|&(k, first)| is_out(k, first));
        let Some((k, first)) = next else { return Some(if turns { [b, a] } else { [a, b] }) };
        turns |= p >= 36 && !first;
        let moved = if first { a } else { b };
        let to = if moved[k] < 0 { 0 } else { last[k] };
        let from = match p / 12 % 3 {
            0 => a,
            1 => moved,
            _ if first => b,
            _ => a,
        };
        // Where each end is moved from itself, the way is that before both.
        if p / 12 % 3 != 1 || cut_along != k {
            (way, cut_along) = ([b[0] - a[0], b[1] - a[1]], k);
            began_before = first && moved[k] < 0;
        }
        let is_sum = sums == 1 || (sums == 0 && began_before && !first);
        let (part, whole) = (way[1 - k] * (to - from[k]), way[k]);
        let (part, whole) = if whole < 0 { (-part, -whole) } else { (part, whole) };
        let along = match p % 3 {
            // As a product with a slope in floats, which need not be exact.
            0 if p / 12 % 3 == 1 => {
                let kept = if is_sum { from[1 - k] } else { 0 };
                let part = way[1 - k] as f64 / way[k] as f64 * (to - from[k]) as f64;
                (kept as f64 + part) as i64 - kept
            }
            0 => part / whole,
            1 => part.div_euclid(whole),
            _ => (2 * part + whole).div_euclid(2 * whole),
        };
        let other = from[1 - k] + along;
        let end = if first { &mut a } else { &mut b };
        (end[k], end[1 - k]) = (to, other);
    }
    None
}

/// The part within the window by Liang and Barsky: both new ends are counted from the first one. `how` mod 3 is the rounding,
/// `how` / 3 mod 2 is whether distances from the first end are rounded, and from 6 on the window is one pixel wider and higher.
fn cut_both([a, b]: Ends, window: PixelRect, how: i64) -> Option<Ends> {
    let way = [b[0] - a[0], b[1] - a[1]].map(|v| v as f64);
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (k, side) in [(0, window.x1), (1, window.y1)] {
        let end = i64::from(side) - i64::from(how < 6);
        let [low, high] = [-a[k], end - a[k]].map(|v| v as f64);
        if way[k] == 0.0 && (low > 0.0 || high < 0.0) {
            return None;
        }
        if way[k] != 0.0 {
            let [t, u] = [low / way[k], high / way[k]];
            (first, last) = (first.max(t.min(u)), last.min(t.max(u)));
        }
    }
    let at = |t: f64, k: usize| {
        let from = if how / 3 % 2 == 0 { 0 } else { a[k] };
        let v = (a[k] - from) as f64 + t * way[k];
        from + [v as i64, v.floor() as i64, v.round() as i64][(how % 3) as usize]
    };
    (first <= last).then(|| [first, last].map(|t| [at(t, 0), at(t, 1)]))
}

fn supercover(ends: Ends, window: PixelRect, p: i64) -> Vec<[i64; 2]> {
    if p == 15 {
        let centres = ends.map_array(|end| end.map_array(|v| v as f64 + 0.5));
        return pixels_of(&cells::touched(centres, window, 0.0), window);
    }
    let [[mut x, mut y], [x1, y1]] = from_left(ends, p / 4 == 1);
    let (sx, sy) = ((x1 - x).signum(), (y1 - y).signum());
    let (dx, dy) = ((x1 - x).abs(), (y1 - y).abs());
    if dx + dy > MOST_STEPS {
        return Vec::new();
    }
    let mut error = dx - dy;
    let mut pixels = vec![[x, y]];
    if p >= 8 {
        let r = |v: f64| if p >= 12 { f64::from(v as f32) } else { v };
        let step = [dx, dy].map(|d| r(1.0 / d as f64));
        let mut next = [dx, dy].map(|d| r(0.5 / d as f64));
        // What has lost its way never arrives.
        while [x, y] != [x1, y1] && pixels.len() as i64 <= dx + dy {
            let is_tie = next[0] == next[1];
            let along_x = next[0] < next[1] || (is_tie && p % 4 > 0);
            let along_y = next[1] < next[0] || (is_tie && p % 2 == 0);
            if along_x {
                x += sx;
                next[0] = r(next[0] + step[0]);
            }
            if along_y {
                y += sy;
                next[1] = r(next[1] + step[1]);
            }
            pixels.push([x, y]);
        }
        return pixels;
    }
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

/// Bits of fraction, how the slope is cut, where the line begins, and whether the last pixel is left out.
fn slope_of(p: i64) -> [i64; 4] {
    [[16, 8, 10, 12, 4, 6, 7, 14, 20][(p % 9) as usize], p / 9 % 3, p / 27 % 5, p / 135]
}

fn fixed_slope([[x0, y0], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let [bits, how, start, without_last] = slope_of(p);
    let steps = (x1 - x0).abs().max((y1 - y0).abs());
    if steps > MOST_STEPS {
        return Vec::new();
    }
    let cut = |d: i64| match (steps, how) {
        (0, _) => 0,
        (_, 0) => (d << bits) / steps,
        (_, 1) => (d << bits).div_euclid(steps),
        _ => ((d << bits) * 2 + steps).div_euclid(2 * steps),
    };
    let (sx, sy) = (cut(x1 - x0), cut(y1 - y0));
    let half = 1 << (bits - 1);
    let [a, b] =
        [[half; 2], [0; 2], [half - 1; 2], [half, half - 1], [half - 1, half]][start as usize];
    (0..=steps - without_last)
        .map(|i| [((x0 << bits) + a + i * sx) >> bits, ((y0 << bits) + b + i * sy) >> bits])
        .collect()
}

fn floats(ends: Ends, window: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let (how, precision) = (p / 3, p % 3);
    if how >= NORMALISED {
        return normalised(ends, window, how - NORMALISED, precision).unwrap_or_default();
    }
    let [[x0, y0], [x1, y1]] = ends;
    let r = |v: f64| rounded(v, precision);
    let steps = (x1 - x0).abs().max((y1 - y0).abs());
    if steps > MOST_STEPS {
        return Vec::new();
    }
    let slope = |d: i64| if steps == 0 { 0.0 } else { r(d as f64 / steps as f64) };
    let (sx, sy) = (slope(x1 - x0), slope(y1 - y0));
    if how >= 7 {
        let at = |i: i64, a: i64, b: i64| {
            let of = steps + [0, 1, -1][(how - 11).max(0) as usize];
            let t = r(i as f64 / of.max(1) as f64);
            let v = match how {
                11 => a as f64 + r((b - a) as f64 / steps.max(1) as f64) * i as f64,
                7 | 8 | 12.. => r(a as f64 + r(r((b - a) as f64) * t)),
                _ => r(r(a as f64 * r(1.0 - t)) + r(b as f64 * t)),
            };
            match how {
                11.. => (v + 0.5).floor() as i64,
                7 | 9 => v.round() as i64,
                _ => v as i64,
            }
        };
        return (0..=steps).map(|i| [at(i, x0, x1), at(i, y0, y1)]).collect();
    }
    if how >= 4 {
        return sloped([[x0, y0], [x1, y1]], how, precision);
    }
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

/// From here on, ways of adding up steps go through numbers from -1 to 1.
const NORMALISED: i64 = 14;

/// Ends go through numbers from -1 to 1, in which the line is clipped by Liang and Barsky, and are cut to whole pixels. Bit 0 of
/// `how` is whether y runs upwards, bit 1 whether no half is added before the cut, and bit 2 whether steps begin at the first end.
fn normalised(ends: Ends, window: PixelRect, how: i64, precision: i64) -> Option<Vec<[i64; 2]>> {
    let r = |v: f64| rounded(v, precision);
    let sides = [window.x1, window.y1].map_array(f64::from);
    let signs = [1.0, if how & 1 == 1 { -1.0 } else { 1.0 }];
    let [from, to] = ends.map_array(|end| {
        [0, 1]
            .map_array(|k: usize| signs[k] * r(r(r(2.0 / sides[k]) * r(end[k] as f64 + 0.5)) - 1.0))
    });
    let way = [0, 1].map_array(|k: usize| r(to[k] - from[k]));
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for k in [0, 1] {
        for (left, ahead) in [(r(1.0 - from[k]), way[k]), (r(1.0 + from[k]), -way[k])] {
            let part = r(left / ahead);
            if ahead > 0.0 {
                last = last.min(part);
            } else if ahead < 0.0 {
                first = first.max(part);
            } else if left < 0.0 {
                return None;
            }
        }
    }
    if first > last {
        return None;
    }
    let pixel = |part: f64, end: [f64; 2]| {
        [0, 1].map_array(|k: usize| {
            // An end inside stays as it is.
            let v = if part == 0.0 || part == 1.0 { end[k] } else { r(from[k] + r(part * way[k])) };
            let at = r(sides[k] / 2.0 + r(v * sides[k] / 2.0));
            if how & 2 == 0 { r(at + 0.5).floor() - 1.0 } else { at.floor() }
        })
    };
    let [from, to] = [pixel(first, from), pixel(last, to)];
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let steps = dx.abs().max(dy.abs());
    let (begin, more) = if how & 4 == 0 { (0.5, 0) } else { (0.0, 1) };
    let step = [dx, dy].map_array(|d| if steps == 0.0 { 0.0 } else { r(d / steps) });
    let mut at = [0, 1].map_array(|k: usize| r(from[k] + 0.5 + r(step[k] * begin)));
    let all = (0..steps as i64 + more).map(|_| {
        let [x, y] = at.map_array(|v| v as i64);
        at = [0, 1].map_array(|k: usize| r(at[k] + step[k]));
        [x, if how & 1 == 1 { i64::from(window.y1) - 1 - y } else { y }]
    });
    Some(all.collect())
}

/// Each step from a slope in floats: 4, as y = m x + b; 5, from the first end; 6, from the left end.
fn sloped(ends: Ends, how: i64, precision: i64) -> Vec<[i64; 2]> {
    let r = |v: f64| rounded(v, precision);
    let steep = is_steep(ends);
    let turned = |[x, y]: [i64; 2]| if steep { [y, x] } else { [x, y] };
    let [first, last] = ends.map_array(turned);
    let [[u0, v0], [u1, v1]] = if how == 6 && first > last { [last, first] } else { [first, last] };
    let slope = if u0 == u1 { 0.0 } else { r((v1 - v0) as f64 / (u1 - u0) as f64) };
    let height = r(v0 as f64 - r(slope * u0 as f64));
    (u0.min(u1)..=u0.max(u1))
        .map(|u| {
            let v = match how {
                4 => r(r(slope * u as f64) + height),
                _ => r(v0 as f64 + r(slope * (u - u0) as f64)),
            };
            turned([u, v.round() as i64])
        })
        .collect()
}

/// What an error term may begin at, from the longer and the shorter side.
type Start = fn(i64, i64) -> i64;
const STARTS: [(Start, &str); 9] = [
    (|a, b| 2 * b - a, "2b - a"),
    (|a, b| 2 * (b - a), "2b - 2a"),
    (|_, b| 2 * b, "2b"),
    (|a, b| b - a, "b - a"),
    (|_, b| b, "b"),
    (|_, _| 0, "0"),
    (|a, _| a, "a"),
    (|a, _| -a, "-a"),
    (|a, b| 2 * b - a / 2, "2b - a/2"),
];

/// Steps by an error of both axes, of which one moves at a time: x is tested first, or y with p mod 2; p / 2 is whether a tie
/// does not count.
fn staircase([[x0, y0], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let [dx, dy] = [(x1 - x0).abs(), (y1 - y0).abs()];
    if dx + dy > 2 * MOST_STEPS {
        return Vec::new();
    }
    let (mut x, mut y, mut error) = (x0, y0, dx - dy);
    let mut pixels = vec![[x, y]];
    // Where it misses its end, it goes on somewhere else.
    while [x, y] != [x1, y1] && (x - x0).abs() <= dx && (y - y0).abs() <= dy {
        let tie = p / 2;
        let moves = [2 * error >= tie - dy, 2 * error <= dx - tie];
        let along_x = moves[0] && (p % 2 == 0 || !moves[1]);
        if along_x {
            (x, error) = (x + (x1 - x0).signum(), error - dy);
        } else {
            (y, error) = (y + (y1 - y0).signum(), error + dx);
        }
        pixels.push([x, y]);
    }
    pixels
}

/// p mod 9 is where the error term begins, p / 9 mod 3 what is added and taken away, p / 27 mod 2 what happens at 0, and from 54
/// on lines are seen from the left. What is right draws nothing, as it is a convention.
fn error_term(ends: Ends, _: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let [[mut x, mut y], [x1, y1]] = from_left(ends, p >= 54);
    let [dx, dy] = [(x1 - x).abs(), (y1 - y).abs()];
    let (sx, sy) = ((x1 - x).signum(), (y1 - y).signum());
    let (a, b) = (dx.max(dy), dx.min(dy));
    if a > MOST_STEPS || (p % 9 == 0 && p / 9 % 3 == 0) {
        return Vec::new();
    }
    let [up, down] = [[2 * b, 2 * a], [b, 2 * a], [2 * b, a]][(p / 9 % 3) as usize];
    let mut error = STARTS[(p % 9) as usize].0(a, b);
    let mut pixels = vec![[x, y]];
    for _ in 0..a {
        let across = error > 0 || (error == 0 && p / 27 % 2 == 1);
        if across {
            error -= down;
        }
        error += up;
        if dx >= dy || across {
            x += sx;
        }
        if dx < dy || across {
            y += sy;
        }
        pixels.push([x, y]);
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
    let [wide, high] = [(x1 - x).abs(), (y1 - y).abs()];
    let steps = wide.max(high);
    if steps > MOST_STEPS {
        return Vec::new();
    }
    if p >= 100 {
        // Of a loop over the longer axis: half the steps less b each, or 2b - a.
        let (a, b) = (steps, wide.min(high));
        let mut error = word(if p < 200 { a / 2 } else { 2 * b - a });
        return (0..=steps)
            .map(|_| {
                let pixel = [x, y];
                let across = match p < 200 {
                    true => {
                        error = word(error - b);
                        error < 0
                    }
                    false => error > 0,
                };
                error = match (p < 200, across) {
                    (true, true) => word(error + a),
                    (true, false) => error,
                    (false, true) => word(error + 2 * b - 2 * a),
                    (false, false) => word(error + 2 * b),
                };
                x += if wide >= high || across { sx } else { 0 };
                y += if wide < high || across { sy } else { 0 };
                pixel
            })
            .collect();
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

fn pixels_of(mask: &Mask, window: PixelRect) -> Vec<[i64; 2]> {
    let all = (0..window.y1).flat_map(|y| (0..window.x1).map(move |x| [x, y]));
    all.filter(|&[x, y]| mask.has(x, y)).map(|pixel| pixel.map_array(i64::from)).collect()
}

/// A line as an area of one pixel's width, with both ends a half longer or not.
fn stroke(ends: Ends, window: PixelRect, p: i64) -> Vec<[i64; 2]> {
    let [[x0, y0], [x1, y1]] = ends.map_array(|end| end.map_array(|v| v as f64 + 0.5));
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = (dx * dx + dy * dy).sqrt();
    if length == 0.0 {
        return Vec::new();
    }
    let [dx, dy] = [dx, dy].map_array(|v| v / length / 2.0);
    let longer = if p > 3 { 1.0 } else { 0.0 };
    let (x0, y0) = (x0 - dx * longer, y0 - dy * longer);
    let (x1, y1) = (x1 + dx * longer, y1 + dy * longer);
    let area = [[x0 + dy, y0 - dx], [x1 + dy, y1 - dx], [x1 - dy, y1 + dx], [x0 - dy, y0 + dx]];
    pixels_of(&cells::by_area(&area, window, cells::LEAST[(p % 4) as usize]), window)
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
