//! The table of mistakes in drawing lines. To add one, add an entry: everything else follows from it.
//!
//! Parameters are packed as those of triangles are (see `triangles`). A line runs from its first end to its second one: a mistake may
//! depend on the direction, although the line is the same.

use super::cells;
use super::fills::without_border;
use super::format::rounded;
use super::{Mistake, Parameters, border};
use crate::convention::{LineConvention, LineQuestion, Mask};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

type Point = [i64; 2];
pub(super) type Ends = [Point; 2];

/// What a mistake does, given its parameter. Pixels come from the first end to the second.
#[derive(Clone, Copy)]
pub(super) enum Stroke {
    /// These lines are drawn in place of the given one.
    Instead(fn(Ends, PixelRect, i64) -> Vec<Ends>),
    /// Its own pixels, in the window and around it.
    Own(fn(Ends, PixelRect, i64) -> Vec<Point>),
    /// The right picture is changed.
    Changed(fn(&mut Mask, Ends, PixelRect, i64)),
}

/// Everything known, the simplest first.
pub(super) const TABLE: &[Mistake<Stroke>] = &[
    // A quick way to stay inside an array, which changes the slope.
    Mistake {
        name: "ends are clamped to the window",
        sentence: clamped_ends_said,
        repair: "clip the line, and keep the error term of the unclipped one",
        page: "ch07",
        refuted: "a line with an end outside that keeps its slope",
        parameters: Parameters::Below(3 * 24),
        draws: Stroke::Instead(clamped_ends),
    },
    // Clipping has to keep the error term: the point at the window is seldom the centre of a pixel.
    Mistake {
        name: "lines are cut in whole numbers",
        sentence: cut_lines_said,
        repair: "clip the line, and keep the error term of the unclipped one",
        page: "ch07",
        refuted: "a line across the border with the pixels of the whole line",
        parameters: Parameters::Below(SUMS + 2),
        draws: Stroke::Instead(|ends, window, p| cut(ends, window, p).into_iter().collect()),
    },
    // Many programs turn steep lines to flat ones first, and have to turn each pixel back.
    Mistake {
        name: "x and y are exchanged",
        sentence: exchanged_axes_said,
        repair: "turn the pixels back where the line was turned",
        page: "ch03",
        refuted: "such a line with its own pixels",
        parameters: Parameters::Below(14),
        draws: Stroke::Instead(exchanged_axes),
    },
    // An unrolled loop whose last or first iteration is missing.
    Mistake {
        name: "pixels of the line are left out",
        sentence: lost_pixels_said,
        repair: "look at the last iteration of the loop over groups of pixels",
        page: "ch03",
        refuted: "a long line without gaps",
        parameters: Parameters::Below(10),
        draws: Stroke::Changed(lost_pixels),
    },
    // It halves the steps, and each half rounds as seen from its own end.
    Mistake {
        name: "drawn from both ends",
        sentence: from_both_ends_said,
        repair: "draw from one end, or let both halves round the same way",
        page: "ch03",
        refuted: "a line whose halves round the same way",
        parameters: Parameters::Below(2),
        draws: Stroke::Own(from_both_ends),
    },
    // With one loop for each octant, each has its own comparison, which may be `<` or `<=`.
    Mistake {
        name: "ties by direction",
        sentence: ties_by_direction_said,
        repair: "let one comparison decide in all directions",
        page: "ch03",
        refuted: "a tie in one of these directions that does not go on",
        parameters: Parameters::Octants,
        draws: Stroke::Own(by_octant),
    },
    // Recursive drawing: a middle is rounded, and its halves are drawn to the rounded point.
    Mistake {
        name: "halved again and again",
        sentence: halved_lines_said,
        repair: "step along the longer axis with one error term",
        page: "ch03",
        refuted: "a long line with one pixel for each step",
        parameters: Parameters::Below(3),
        draws: Stroke::Own(halved_lines),
    },
    // A kind is a branch that is missing, such as the one of an upright line without a slope.
    Mistake {
        name: "lines are left out by kind",
        sentence: |p| format!("does not draw lines {}", KINDS[p as usize].0),
        repair: "treat this kind as any other",
        page: "ch03",
        refuted: "a line of that kind that is drawn",
        parameters: Parameters::Below(KINDS.len() as i64),
        draws: Stroke::Instead(|ends, window, p| match KINDS[p as usize].1(ends, window) {
            true => Vec::new(),
            false => vec![ends],
        }),
    },
    // As rays walk through a grid of cells: right for visibility, and too much for a thin line.
    Mistake {
        name: "every pixel that is touched",
        sentence: touched_pixels_said,
        repair: "light one pixel for each step along the longer axis",
        page: "ch03",
        refuted: "a diagonal step without a pixel between",
        parameters: Parameters::Below(16),
        draws: Stroke::Own(supercover),
    },
    // A line as a thin rectangle, which is filled as any other polygon is.
    Mistake {
        name: "a stroke of area",
        sentence: stroked_area_said,
        repair: "light one pixel for each step along the longer axis",
        page: "ch03",
        refuted: "a step with one pixel",
        parameters: Parameters::Below(8),
        draws: Stroke::Own(stroke),
    },
    // Fixed point: the error of the slope is multiplied by the length of the line.
    Mistake {
        name: "the slope is cut",
        sentence: cut_slope_said,
        repair: "keep the remainder of the division, as Bresenham's algorithm does",
        page: "ch03",
        refuted: "a long line that reaches its second end",
        parameters: Parameters::Below(9 * 3 * 5 * 2),
        draws: Stroke::Own(fixed_slope),
    },
    // A digital differential analyser (DDA), with the rounding of its numbers and of its pixels.
    Mistake {
        name: "steps are added up in floats",
        sentence: float_steps_said,
        repair: "count in integers, as Bresenham's algorithm does",
        page: "ch03",
        refuted: "a long line whose height is right at the far end",
        parameters: Parameters::Below(3 * (NORMALISED + 8)),
        draws: Stroke::Own(floats),
    },
    // Bresenham's algorithm with a number that was remembered wrongly.
    Mistake {
        name: "the error term is off",
        sentence: wrong_error_term_said,
        repair: "derive the error term from the distances of both pixels to the line",
        page: "ch03",
        refuted: "a line whose middle step is where it should be",
        parameters: Parameters::Below(108),
        draws: Stroke::Own(error_term),
    },
    // y = m x + b for each column leaves gaps where the slope is above 1.
    Mistake {
        name: "steps along x alone",
        sentence: along_one_axis_said,
        repair: "step along the longer axis",
        page: "ch03",
        refuted: "a steep line without gaps",
        parameters: Parameters::Fixed(&[0, 1]),
        draws: Stroke::Own(one_axis),
    },
    // The well-known loop tests both axes; with `else if` in place of `if` only one moves.
    Mistake {
        name: "one step at a time",
        sentence: one_step_said,
        repair: "test the error for each axis by itself, without an else",
        page: "ch03",
        refuted: "two pixels in turn that share a corner alone",
        parameters: Parameters::Below(4),
        draws: Stroke::Own(staircase),
    },
    // 2 dx - dy needs two bits more than a coordinate has.
    Mistake {
        name: "the error term overflows",
        sentence: short_error_term_said,
        repair: "use a word of twice the length",
        page: "stability",
        refuted: "such a long line that is drawn rightly",
        parameters: Parameters::Fixed(&[8, 16, 12, 108, 116, 112, 208, 216, 212]),
        draws: Stroke::Own(short_error),
    },
    // A coordinate or a difference in a short word.
    Mistake {
        name: "ends overflow",
        sentence: short_ends_said,
        repair: "clip first, or use a longer word",
        page: "stability",
        refuted: "a line with an end out there that is drawn rightly",
        parameters: Parameters::Fixed(&[8, 12, 16, 108, 112, 116, 208, 216]),
        draws: Stroke::Instead(short_ends),
    },
    // Whether the last pixel belongs to a line is a convention; that it depends on the direction is
    // none.
    Mistake {
        name: "pixels at the ends",
        sentence: |p| ENDS[p as usize].said.to_owned(),
        repair: "compare the bounds of the loop with the rule for ends: one of them is one off in this direction",
        page: "ch03",
        refuted: "a line of that direction with both ends right",
        parameters: Parameters::Below(ENDS.len() as i64),
        draws: Stroke::Changed(lost_ends),
    },
    // Flat lines round y and steep ones round x, and the two may be two pieces of code.
    Mistake {
        name: "each axis is rounded in its own way",
        sentence: two_roundings_said,
        repair: "round both coordinates to the nearest pixel in the same way",
        page: "ch03",
        refuted: "a steep line with the pixels of a flat one, turned",
        parameters: Parameters::Below(16),
        draws: Stroke::Own(two_roundings),
    },
    // `max(dx, dy)` where `max(|dx|, |dy|)` was meant.
    Mistake {
        name: "steps without the sign",
        sentence: signed_steps_said,
        repair: "take the larger of the absolute values of dx and dy",
        page: "ch03",
        refuted: "a line to the left without gaps",
        parameters: Parameters::Below(2),
        draws: Stroke::Own(signed_steps),
    },
    // A buffer or a counter with a fixed length.
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
        draws: Stroke::Changed(early_end),
    },
    // A thick line whose width is at least 2, or a neighbour that is lit to close gaps.
    Mistake {
        name: "two pixels wide",
        sentence: two_wide_said,
        repair: "light one pixel for each step",
        page: "ch03",
        refuted: "a step with one pixel",
        parameters: Parameters::Fixed(&[0, 1, 2, 3]),
        draws: Stroke::Instead(two_wide),
    },
    border(Stroke::Changed(|mask, _, window, p| without_border(mask, window, p))),
    // As `y += 1` does where `y += sign(dy)` was meant.
    Mistake {
        name: "the sign of a step",
        sentence: wrong_sign_said,
        repair: "take the sign of the difference for the step of each axis",
        page: "ch03",
        refuted: "a line of that direction that reaches its second end",
        parameters: Parameters::Fixed(&[0, 1, 2, 3]),
        draws: Stroke::Instead(wrong_sign),
    },
];

/// p mod 3 is which coordinates are moved, and p / 3 the place: one of four that depend on the window, or a range.
/// For example, 13 moves x to the range from -64 to 64.
fn clamped_ends_said(p: i64) -> String {
    let (place, axes) = (p / 3, ["ends", "x of ends", "y of ends"][(p % 3) as usize]);
    let to = match place {
        0 => "the window".to_owned(),
        1 => "one pixel beyond the window".to_owned(),
        2 => "the upper and left border".to_owned(),
        3 => "the lower and right border".to_owned(),
        _ => {
            let [low, high] = range(place, 0);
            format!("the range from {low} to {high}")
        }
    };
    format!("moves {axes} that lie outside to {to}, so that the slope changes")
}

/// Each coordinate moves by itself, so that a line to a corner outside gets another slope.
fn clamped_ends(mut ends: Ends, window: PixelRect, p: i64) -> Vec<Ends> {
    // A range depends on the window in four places, and is the same for both axes in the others.
    let [left, right] = range(p / 3, window.x1.into());
    let [top, bottom] = range(p / 3, window.y1.into());
    for [x, y] in &mut ends {
        if p % 3 != 2 {
            *x = (*x).clamp(left, right);
        }
        if p % 3 != 1 {
            *y = (*y).clamp(top, bottom);
        }
    }
    vec![ends]
}

/// p is read by `cut`.
fn cut_lines_said(p: i64) -> String {
    let how = ["cut toward zero", "cut down", "rounded to the nearest"][(p % 3) as usize];
    let from = ["", ", counted from the end that is cut", ", counted from the other end"];
    // Three algorithms follow: sums by Cohen and Sutherland, one axis alone, and Liang and Barsky.
    if p >= SUMS {
        let which = ["the far ends of lines across the window are", "all new ends are"];
        return format!(
            "cuts lines at the window, first in x, and draws the rest as a line of its own, whose new ends are counted from the end that is cut, by a part that is cut toward zero; {} cut as a sum: the rest takes other pixels",
            which[(p - SUMS) as usize]
        );
    }
    // One axis is cut, and the other is left to the test of each pixel.
    if p >= 84 {
        let (axis, rest) = (["y", "x"][((p - 84) / 36) as usize], (p - 84) % 36);
        return format!(
            "cuts lines at the window where {axis} leaves it and draws the rest as a line of its own, whose new ends are {how}{}: the rest takes other pixels",
            from[(rest / 12) as usize]
        );
    }
    // Both new ends from the first one, by Liang and Barsky.
    if p >= 72 {
        let how = ["", "their distance from it being "][(p / 3 % 2) as usize].to_owned() + how;
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
}

/// Of an even p steep lines are exchanged, of an odd one flat ones, and p / 2 is in which directions.
/// For example, 2 exchanges x and y of steep lines that run to the left.
fn exchanged_axes_said(p: i64) -> String {
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
}

/// As where a program turns steep lines to flat ones, and turns the pixels back for some of them alone.
fn exchanged_axes(ends: Ends, _: PixelRect, p: i64) -> Vec<Ends> {
    let [[x0, y0], [x1, y1]] = ends;
    let runs = [true, x1 < x0, x1 > x0, y1 < y0, y1 > y0, x1 <= x0, y1 <= y0];
    let is_exchanged = is_steep(ends) == (p % 2 == 0) && runs[(p / 2) as usize];
    vec![if is_exchanged { transposed(ends) } else { ends }]
}

/// p / 2 is the power of two of a group, less one, and p mod 2 which pixel of it is lost.
/// For example, 3 loses the first one of every 4 pixels.
fn lost_pixels_said(p: i64) -> String {
    let every = 2 << (p / 2);
    let first = ["the last", "the first"][(p % 2) as usize];
    format!("loses {first} of every {every} pixels along the line")
}

/// Pixels are counted from the first end along the longer axis.
fn lost_pixels(mask: &mut Mask, ends: Ends, window: PixelRect, p: i64) {
    let every = 2 << (p / 2);
    let lost = if p % 2 == 0 { every - 1 } else { 0 };
    mask.retain(window, &|x, y| steps_to(ends, x, y) % every != lost);
}

/// p is whether a tie goes on.
fn from_both_ends_said(p: i64) -> String {
    format!(
        "draws the line from both ends to the middle, and a tie goes {} seen from the own end",
        ["on", "not yet"][(p % 2) as usize]
    )
}

/// The pixel in the middle is drawn from both ends, where there is one.
fn from_both_ends(ends: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let sides = Sides::of(ends);
    let [[x0, y0], [x1, y1]] = ends;
    let mut pixels = Vec::new();
    if sides.longer > MOST_STEPS {
        return pixels;
    }
    for i in 0..=sides.longer / 2 {
        // Twice the rise is rounded; a tie goes on where nothing is taken away.
        let rise = (2 * sides.shorter * i + sides.longer - p % 2) / (2 * sides.longer).max(1);
        let [dx, dy] = sides.step(i, rise);
        pixels.extend([[x0 + dx, y0 + dy], [x1 - dx, y1 - dy]]);
    }
    pixels
}

/// The bits of p are the octants in which a tie goes on.
/// For example, with 1 a tie goes on only where lines run right and down, and are flat.
fn ties_by_direction_said(p: i64) -> String {
    let mut on = Vec::new();
    for (octant, runs) in OCTANTS.iter().enumerate() {
        if p >> octant & 1 == 1 {
            on.push(*runs);
        }
    }
    format!(
        "lets a tie go on where lines run {}, and not yet where they run elsewhere",
        on.join(", or ")
    )
}

/// p is how the middle is rounded.
fn halved_lines_said(p: i64) -> String {
    format!(
        "draws both halves of a line from pixel to pixel, whose middle is {}: errors of the halves add up",
        ["cut toward zero", "cut down", "rounded up"][p as usize]
    )
}

/// Two ends that have no pixel between them are both drawn.
fn halved_lines(ends: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let mut pixels = Vec::new();
    halved(ends, p, &mut pixels);
    pixels
}

/// p mod 4 is what happens at a corner of pixels, and p / 4 from which end and in which numbers the walk goes.
/// For example, 4 goes along y at a tie, seen from the left end.
fn touched_pixels_said(p: i64) -> String {
    let tie = ["along y", "along x", "diagonally", "through both neighbours"][(p % 4) as usize];
    let seen = match p / 4 {
        0 => "the first end",
        1 => "the left end",
        2 => "the first end, as times of crossings in floats of 64 bits have it",
        _ if p == 15 => "the left end, walked in floats of 64 bits in steps of at least 1e-9 px",
        _ => "the first end, as times of crossings in floats of 32 bits have it",
    };
    format!(
        "lights every pixel that the line from centre to centre touches (a supercover), and goes {tie} where it meets a corner of pixels, seen from {seen}"
    )
}

/// p mod 4 is one of `LEAST`, and from 4 on the stroke is longer.
/// For example, 6 draws pixels of which 128 of 255 are covered, of a longer stroke.
fn stroked_area_said(p: i64) -> String {
    let least = cells::least_said(cells::LEAST[(p % 4) as usize]);
    format!(
        "draws a line as an area of 1 px across and {}, and a pixel of it from {least} on",
        ["from centre to centre", "half a pixel longer at both ends"][(p / 4) as usize]
    )
}

/// p is read by `slope_of`.
/// For example, 9 cuts the slope down to 1/65,536 px and begins half a pixel ahead.
fn cut_slope_said(p: i64) -> String {
    let FixedSlope { bits, rounding, start, without_last } = slope_of(p);
    let cut = ["cut toward zero", "cut down", "rounded"][rounding as usize];
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
        ["", ", and does not draw the last pixel"][without_last as usize]
    )
}

/// p mod 3 is the precision, and p / 3 the way, where those from `NORMALISED` on go through numbers from -1 to 1.
fn float_steps_said(p: i64) -> String {
    let (how, bits) = (p / 3, ["32", "64", "16"][(p % 3) as usize]);
    if how >= NORMALISED {
        let [up, centre, whole] = [1, 2, 4].map(|bit| usize::from((how - NORMALISED) & bit > 0));
        return format!(
            "brings ends to numbers from -1 to 1, clips in them, comes back {} and cuts them to whole pixels, which rounding may move, and adds up steps{}, beginning {}, in floats of {bits} bits",
            ["with half a pixel added", "to the centres"][centre],
            ["", " upwards"][up],
            ["half a step after the first end, without the last pixel", "half a pixel ahead"]
                [whole]
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
}

/// p is read by `error_term`.
/// For example, 9 adds b in place of 2b.
fn wrong_error_term_said(p: i64) -> String {
    let (_, start) = STARTS[(p % 9) as usize];
    let (up, down) = [("2b", "2a"), ("b", "2a"), ("2b", "a")][(p / 9 % 3) as usize];
    let from = ["the first end", "the left end"][(p / 54) as usize];
    format!(
        "begins the error term at {start}, adds {up} for a step and takes away {down} where it is {} 0 (a is the longer side of the line and b the shorter one, seen from {from}); 2b - a, 2b and 2a are right",
        ["above", "at least"][(p / 27 % 2) as usize]
    )
}

/// p is the axis.
fn along_one_axis_said(p: i64) -> String {
    format!("steps along {} on steep lines too, so that these have gaps", ["x", "y"][p as usize])
}

/// Of an odd p the axes are tested in the other order.
fn one_step_said(p: i64) -> String {
    let axes = ["x", "y"];
    format!(
        "steps along {} or else along {}, never along both at once, so that a slanted line is a staircase",
        axes[(p % 2) as usize],
        axes[(1 - p % 2) as usize]
    )
}

/// p mod 100 is the number of bits, and p / 100 which form the error term has.
/// For example, 116 begins at half the steps, in 16 bits.
fn short_error_term_said(p: i64) -> String {
    format!(
        "keeps the error term{} in {} bits: it wraps around on lines of more than about {} steps",
        ["", ", which begins at half the steps,", ", which begins at 2b - a,"][(p / 100) as usize],
        p % 100,
        1_i64 << (p % 100 - if p / 100 == 1 { 1 } else { 2 })
    )
}

/// p mod 100 is the number of bits, and p / 100 is what is kept in them: coordinates, their differences, or
/// coordinates without a sign.
/// For example, 112 keeps the differences of both ends in 12 bits.
fn short_ends_said(p: i64) -> String {
    let (what, far) = match p / 100 {
        2 => {
            // Without a sign, everything below 0 wraps around.
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
}

/// A difference that wraps around moves the second end alone.
fn short_ends([from, mut to]: Ends, _: PixelRect, p: i64) -> Vec<Ends> {
    let (bits, what) = (p % 100, p / 100);
    // A shift up and down again keeps the lowest bits, with their sign.
    let word = |v: i64| match what {
        2 => v & ((1 << bits) - 1),
        _ => v << (64 - bits) >> (64 - bits),
    };
    if what == 1 {
        for (end, start) in to.iter_mut().zip(from) {
            *end = start + word(*end - start);
        }
        return vec![[from, to]];
    }
    vec![[from, to].map_array(|end| end.map_array(word))]
}

/// The end is looked up in the picture of the whole line, where it may lie outside.
fn lost_ends(mask: &mut Mask, ends: Ends, window: PixelRect, p: i64) {
    let LostEnd { end, of, .. } = ENDS[p as usize];
    if !of(ends) {
        return;
    }
    // The direction decides where the end is no first or last one.
    let is_last = match end {
        WhichEnd::First => false,
        WhichEnd::Last => true,
        WhichEnd::Forward => is_forward(ends),
        WhichEnd::Backward => !is_forward(ends),
    };
    let lost = ends[usize::from(is_last)];
    if !is_outside(window, lost) {
        mask.put(lost[0] as i32, lost[1] as i32, false);
    }
}

/// p mod 4 is the rounding of flat lines, and p / 4 that of steep ones.
/// For example, 1 rounds y of flat lines up and x of steep ones down.
fn two_roundings_said(p: i64) -> String {
    let ways = ["down", "up", "to the nearest, halves up", "to the nearest, halves down"];
    format!(
        "rounds y of flat lines {} and x of steep ones {}",
        ways[(p % 4) as usize],
        ways[(p / 4) as usize]
    )
}

/// Draws nothing where both are the same, since that is a convention.
fn two_roundings(ends @ [from, to]: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let sides = Sides::of(ends);
    let mut pixels = Vec::new();
    if p % 4 == p / 4 || sides.longer > MOST_STEPS {
        return pixels;
    }
    let way = if sides.is_steep { p / 4 } else { p % 4 };
    // A line of no steps has no direction, and is its first pixel.
    let whole = sides.longer.max(1);
    for i in 0..=sides.longer {
        pixels.push([0, 1].map_array(|axis| {
            let part = (to[axis] - from[axis]) * i;
            from[axis] + divided(part, whole, way)
        }));
    }
    pixels
}

/// A quotient that is cut down, rounded up, or rounded to the nearest with halves up or down.
fn divided(part: i64, whole: i64, way: i64) -> i64 {
    match way {
        0 => part.div_euclid(whole),
        1 => -(-part).div_euclid(whole),
        2 => (2 * part + whole).div_euclid(2 * whole),
        _ => -(whole - 2 * part).div_euclid(2 * whole),
    }
}

/// p is what becomes of lines to the left and up.
fn signed_steps_said(p: i64) -> String {
    format!(
        "steps as often as the larger of dx and dy says, whose signs are kept, so that lines {}",
        [
            "to the left and up are lost and others to the left or up have gaps",
            "to the left and up are a point and others to the left or up have gaps"
        ][p as usize]
    )
}

/// The step count is the larger difference, which is negative or too small to the left or up.
fn signed_steps([[x0, y0], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let steps = (x1 - x0).max(y1 - y0);
    let mut pixels = Vec::new();
    if steps <= 0 || steps > MOST_STEPS {
        // The loop ends before its first step, or after it.
        if steps == 0 || (p == 1 && steps < 0) {
            pixels.push([x0, y0]);
        }
        return pixels;
    }
    for i in 0..=steps {
        let (dx, dy) = (divided((x1 - x0) * i, steps, 2), divided((y1 - y0) * i, steps, 2));
        pixels.push([x0 + dx, y0 + dy]);
    }
    pixels
}

/// Pixels are counted along the longer axis.
fn early_end(mask: &mut Mask, ends: Ends, window: PixelRect, p: i64) {
    mask.retain(window, &|x, y| steps_to(ends, x, y) < p);
}

/// p is where the second pixel lies.
fn two_wide_said(p: i64) -> String {
    format!(
        "lights the pixel {} too",
        [
            "to the right",
            "below",
            "across the line, on the side of larger coordinates",
            "across the line, on the side of smaller coordinates"
        ][p as usize]
    )
}

/// The second pixels are those of the same line, moved by one.
fn two_wide(ends: Ends, _: PixelRect, p: i64) -> Vec<Ends> {
    let steep = i64::from(is_steep(ends));
    let [dx, dy] = match p {
        0 => [1, 0],
        1 => [0, 1],
        2 => [steep, 1 - steep],
        _ => [-steep, steep - 1],
    };
    vec![ends, ends.map_array(|[x, y]| [x + dx, y + dy])]
}

/// p is the direction of the step, and lines of the other direction are wrong.
fn wrong_sign_said(p: i64) -> String {
    format!(
        "steps {} on lines that run {}",
        ["down the screen", "up the screen", "to the right", "to the left"][p as usize],
        ["up", "down", "to the left", "to the right"][p as usize]
    )
}

/// Where the sign of a step is fixed, a line of the other sign is reflected at its first end.
fn wrong_sign([[x0, y0], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<Ends> {
    vec![match p {
        0 => [[x0, y0], [x1, y0 + (y1 - y0).abs()]],
        1 => [[x0, y0], [x1, y0 - (y1 - y0).abs()]],
        2 => [[x0, y0], [x0 + (x1 - x0).abs(), y1]],
        _ => [[x0, y0], [x0 - (x1 - x0).abs(), y1]],
    }]
}

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

/// The number of an octant in [`OCTANTS`].
fn octant([[x0, y0], [x1, y1]]: Ends) -> i64 {
    i64::from(is_steep([[x0, y0], [x1, y1]])) + 2 * i64::from(x1 < x0) + 4 * i64::from(y1 < y0)
}

/// Bresenham's line, whose ties go on or not by the bit of the octant.
fn by_octant(ends: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let sides = Sides::of(ends);
    let mut pixels = Vec::new();
    // The same in all directions is a convention.
    if sides.longer > MOST_STEPS || p == 0 || p == 255 {
        return pixels;
    }
    let [x0, y0] = ends[0];
    let less = 1 - (p >> octant(ends) & 1);
    for i in 0..=sides.longer {
        let twice = 2 * sides.shorter * i + sides.longer - less;
        let [dx, dy] = sides.step(i, twice.div_euclid(2 * sides.longer.max(1)));
        pixels.push([x0 + dx, y0 + dy]);
    }
    pixels
}

/// The sides of a line's box, with the signs of its direction.
struct Sides {
    /// Steps along the longer axis.
    longer: i64,
    /// Steps along the other one.
    shorter: i64,
    /// 1, 0 or -1 along each axis.
    signs: Point,
    is_steep: bool,
}

impl Sides {
    fn of([[x0, y0], [x1, y1]]: Ends) -> Self {
        let [dx, dy] = [x1 - x0, y1 - y0];
        Self {
            longer: dx.abs().max(dy.abs()),
            shorter: dx.abs().min(dy.abs()),
            signs: [dx.signum(), dy.signum()],
            is_steep: dy.abs() > dx.abs(),
        }
    }

    /// So many steps along the longer axis and across it.
    fn step(&self, along: i64, across: i64) -> Point {
        let [x, y] = if self.is_steep { [across, along] } else { [along, across] };
        [self.signs[0] * x, self.signs[1] * y]
    }
}

/// The octants in which ties go on, as most answers have it; `of` are lines with their pictures.
pub(super) fn octants(of: &mut dyn Iterator<Item = (Ends, PixelRect, &Mask)>) -> i64 {
    let mut more = [0; 8];
    for (ends, window, drawn) in of {
        // With ties that go on in its octant alone, and in all others.
        let on = 1 << octant(ends);
        for (p, vote) in [(on, 1), (255 - on, -1)] {
            if mask(&by_octant(ends, window, p), window) == *drawn {
                more[octant(ends) as usize] += vote;
            }
        }
    }
    let mut all = 0;
    for (octant, votes) in more.into_iter().enumerate() {
        all |= i64::from(votes > 0) << octant;
    }
    all
}

/// The pixels of both halves of a line.
fn halved([a, b]: Ends, p: i64, pixels: &mut Vec<Point>) {
    // The rounded middle need not lie on the line.
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

fn is_steep(ends: Ends) -> bool {
    Sides::of(ends).is_steep
}

/// The line with x and y exchanged.
fn transposed([[x0, y0], [x1, y1]]: Ends) -> Ends {
    [[y0, x0], [y1, x1]]
}

/// How many steps along the longer axis a pixel lies from the first end.
fn steps_to(ends: Ends, x: i32, y: i32) -> i64 {
    let [x0, y0] = ends[0];
    (if is_steep(ends) { i64::from(y) - y0 } else { i64::from(x) - x0 }).abs()
}

/// Whether a pixel lies outside a window that begins at the origin.
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
/// Kinds of lines that a program may leave out, as they are said after 'lines'.
const KINDS: [(&str, IsKind); 15] = [
    ("with any end outside the window", |e, w| e.iter().any(|&p| is_outside(w, p))),
    ("with both ends outside the window", |e, w| e.iter().all(|&p| is_outside(w, p))),
    ("with their first end outside the window", |e, w| is_outside(w, e[0])),
    ("with their second end outside the window", |e, w| is_outside(w, e[1])),
    ("that are steep", |e, _| is_steep(e)),
    ("that run to the left", |e, _| is_leftward(e)),
    ("that run up", |e, _| is_upward(e)),
    ("that are upright", |e, _| is_upright(e)),
    ("that are level", |e, _| is_level(e)),
    ("between a pixel and itself", |[a, b], _| a == b),
    ("that are upright and run up", |e, _| is_upright(e) && is_upward(e)),
    ("that are upright and run down", |[a, b], _| a[0] == b[0] && b[1] > a[1]),
    ("that are level and run to the left", |e, _| is_level(e) && is_leftward(e)),
    ("that are level and run to the right", |[a, b], _| a[1] == b[1] && b[0] > a[0]),
    ("that run to the left and up", |e, _| is_leftward(e) && is_upward(e)),
];

type IsOf = fn(Ends) -> bool;

/// An end of some lines.
struct LostEnd {
    /// After 'it'.
    said: &'static str,
    end: WhichEnd,
    /// Of which lines.
    of: IsOf,
}

/// Which end of a line.
#[derive(Clone, Copy)]
enum WhichEnd {
    First,
    Last,
    /// The right end, or the lower one of an upright line; and the other one.
    Forward,
    Backward,
}

const fn lost(said: &'static str, end: WhichEnd, of: IsOf) -> LostEnd {
    LostEnd { said, end, of }
}

/// Ends that are left out.
const ENDS: [LostEnd; 15] = [
    lost("loses the last pixel of steep lines", WhichEnd::Last, is_steep),
    lost("loses the last pixel of flat lines", WhichEnd::Last, |e| !is_steep(e)),
    lost("loses the last pixel of lines to the left", WhichEnd::Last, is_leftward),
    lost("loses the last pixel of lines that run up", WhichEnd::Last, is_upward),
    lost("loses the first pixel of steep lines", WhichEnd::First, is_steep),
    lost("loses the first pixel of lines to the left", WhichEnd::First, is_leftward),
    lost("loses the last pixel of upright lines", WhichEnd::Last, is_upright),
    lost("loses the last pixel of level lines", WhichEnd::Last, is_level),
    lost("loses the last pixel of level and of upright lines", WhichEnd::Last, is_straight),
    lost(
        "loses the right end of level lines and the lower end of upright ones",
        WhichEnd::Forward,
        is_straight,
    ),
    lost(
        "loses the left end of level lines and the upper end of upright ones",
        WhichEnd::Backward,
        is_straight,
    ),
    lost("loses the right end of level lines", WhichEnd::Forward, is_level),
    lost("loses the lower end of upright lines", WhichEnd::Forward, is_upright),
    lost(
        "loses the last pixel of slanted lines, which are neither level nor upright",
        WhichEnd::Last,
        |e| !is_straight(e),
    ),
    lost("loses the last pixel of diagonal lines", WhichEnd::Last, is_diagonal),
];

fn is_leftward([a, b]: Ends) -> bool {
    b[0] < a[0]
}

fn is_upward([a, b]: Ends) -> bool {
    b[1] < a[1]
}

/// Whether every step goes along both axes.
fn is_diagonal(ends: Ends) -> bool {
    let sides = Sides::of(ends);
    sides.longer == sides.shorter
}

fn is_upright([a, b]: Ends) -> bool {
    a[0] == b[0]
}

fn is_level([a, b]: Ends) -> bool {
    a[1] == b[1]
}

/// Whether no step goes along both axes.
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
fn cut(mut ends: Ends, window: PixelRect, p: i64) -> Option<Ends> {
    if (72..84).contains(&p) {
        return cut_both(ends, window, p - 72);
    }
    let how = Cut::of(p);
    let last = [i64::from(window.x1) - 1, i64::from(window.y1) - 1];
    let mut is_turned = false;
    // The way of the line, and the axis along which it was cut last.
    let (mut way, mut cut_along) = ([0; 2], 2);
    let mut began_before = false;
    // Each end is cut at most twice.
    for _ in 0..5 {
        if how.misses(ends, last) {
            return None;
        }
        let Some((k, end)) = how.next(ends, last) else {
            return Some(if is_turned { [ends[1], ends[0]] } else { ends });
        };
        is_turned |= how.turns && end == 1;
        // The end moves to the side beyond which it lies.
        let moved = ends[end];
        let to = if moved[k] < 0 { 0 } else { last[k] };
        // Its other coordinate is counted from one of both ends.
        let from = match how.counts_from {
            0 => ends[0],
            1 => moved,
            _ => ends[1 - end],
        };
        // Where each end is moved from itself, the way is that before both.
        if how.counts_from != 1 || cut_along != k {
            (way, cut_along) = ([ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]], k);
            began_before = end == 0 && moved[k] < 0;
        }
        // A sum is cut with the place that it is counted from, and a part without.
        let is_sum = match how.sums {
            Sums::None => false,
            Sums::FarEnds => began_before && end == 1,
            Sums::All => true,
        };
        let ahead = to - from[k];
        let across = how.across(way, k, ahead, if is_sum { from[1 - k] } else { 0 });
        ends[end][k] = to;
        ends[end][1 - k] = from[1 - k] + across;
    }
    None
}

/// Which new ends are cut as the sum of a place and a part, and not the part alone.
enum Sums {
    None,
    /// Second ends beyond the far side, where the first one lay before the near side.
    FarEnds,
    All,
}

/// How a line is cut, read from the parameter of [`cut`].
struct Cut {
    /// Toward zero, down, or to the nearest.
    rounding: i64,
    /// The axes in the order in which they are cut; one that is not cut is left out.
    axes: &'static [usize],
    /// Whether both ends are cut along an axis before the other axis, and not one end along both.
    is_by_axis: bool,
    /// From where a new end is counted: 0 is the first end, 1 the end that is cut, and 2 the other one.
    counts_from: i64,
    /// Whether a line is turned round whose second end was cut.
    turns: bool,
    /// See [`Sums`].
    sums: Sums,
}

impl Cut {
    fn of(p: i64) -> Self {
        // From 84 on one axis is cut alone.
        let (p, axes, sums): (i64, &[usize], Sums) = match p - SUMS {
            0 => (15, &[0, 1], Sums::FarEnds),
            1.. => (15, &[0, 1], Sums::All),
            _ if p >= 120 => (p - 120, &[0], Sums::None),
            _ if p >= 84 => (p - 84, &[1], Sums::None),
            _ if p / 3 % 2 == 0 => (p, &[1, 0], Sums::None),
            _ => (p, &[0, 1], Sums::None),
        };
        Self {
            rounding: p % 3,
            axes,
            is_by_axis: p % 12 < 6,
            counts_from: p / 12 % 3,
            turns: p >= 36,
            sums,
        }
    }

    /// Whether both ends lie beyond one side.
    fn misses(&self, [a, b]: Ends, last: Point) -> bool {
        self.axes.iter().any(|&k| a[k].max(b[k]) < 0 || a[k].min(b[k]) > last[k])
    }

    /// The axis and the end that are cut next; nothing where both ends lie inside.
    fn next(&self, ends: Ends, last: Point) -> Option<(usize, usize)> {
        let is_out = |k: usize, end: usize| ends[end][k] < 0 || ends[end][k] > last[k];
        // Axis by axis, or end by end.
        for i in 0..2 {
            for j in 0..2 {
                let (axis, end) = if self.is_by_axis { (i, j) } else { (j, i) };
                match self.axes.get(axis) {
                    Some(&k) if is_out(k, end) => return Some((k, end)),
                    _ => {}
                }
            }
        }
        None
    }

    /// How far a line goes along the other axis while it goes so far along this one. What is kept is a place that is added before
    /// the sum is cut, and taken away again.
    fn across(&self, way: Point, k: usize, ahead: i64, kept: i64) -> i64 {
        // As a product with a slope in floats, which need not be exact.
        if self.rounding == 0 && self.counts_from == 1 {
            let part = way[1 - k] as f64 / way[k] as f64 * ahead as f64;
            return (kept as f64 + part) as i64 - kept;
        }
        let (part, whole) = (way[1 - k] * ahead * way[k].signum(), way[k].abs());
        match self.rounding {
            0 => part / whole,
            1 => part.div_euclid(whole),
            _ => (2 * part + whole).div_euclid(2 * whole),
        }
    }
}

/// The part within the window by Liang and Barsky: both new ends are counted from the first one. `how` mod 3 is the rounding,
/// `how` / 3 mod 2 is whether distances from the first end are rounded, and from 6 on the window is one pixel wider and higher.
fn cut_both([a, b]: Ends, window: PixelRect, how: i64) -> Option<Ends> {
    let way = [(b[0] - a[0]) as f64, (b[1] - a[1]) as f64];
    // The part of the line, from 0 to 1, that lies between the sides seen so far.
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (k, side) in [(0, window.x1), (1, window.y1)] {
        let end = i64::from(side) - i64::from(how < 6);
        let [low, high] = [-a[k] as f64, (end - a[k]) as f64];
        if way[k] == 0.0 && (low > 0.0 || high < 0.0) {
            return None;
        }
        if way[k] != 0.0 {
            let [t, u] = [low / way[k], high / way[k]];
            (first, last) = (first.max(t.min(u)), last.min(t.max(u)));
        }
    }
    if first > last {
        return None;
    }
    Some([first, last].map_array(|t| {
        [0, 1].map_array(|k: usize| {
            let from = if how / 3 % 2 == 0 { 0 } else { a[k] };
            let v = (a[k] - from) as f64 + t * way[k];
            from + [v as i64, v.floor() as i64, v.round() as i64][(how % 3) as usize]
        })
    }))
}

/// Pixels of a walk from centre to centre that touches all of them; p mod 4 is what happens at
/// corners of pixels.
fn supercover(ends: Ends, window: PixelRect, p: i64) -> Vec<Point> {
    if p == 15 {
        let centres = ends.map_array(|end| end.map_array(|v| v as f64 + 0.5));
        return pixels_of(&cells::touched(centres, window, 0.0), window);
    }
    let ends = from_left(ends, p / 4 == 1);
    let [dx, dy] = [(ends[1][0] - ends[0][0]).abs(), (ends[1][1] - ends[0][1]).abs()];
    if dx + dy > MOST_STEPS {
        return Vec::new();
    }
    if p >= 8 { by_times(ends, p >= 12, p % 4) } else { by_error(ends, p % 4) }
}

/// The walk from pixel to pixel by the times at which the line crosses the next column and the next row, in floats. At a tie it goes
/// along y, along x, or along both.
fn by_times([[mut x, mut y], end]: Ends, is_single: bool, at_tie: i64) -> Vec<Point> {
    let (sx, sy) = ((end[0] - x).signum(), (end[1] - y).signum());
    let [dx, dy] = [(end[0] - x).abs(), (end[1] - y).abs()];
    let r = |v: f64| if is_single { f64::from(v as f32) } else { v };
    let step = [r(1.0 / dx as f64), r(1.0 / dy as f64)];
    let mut next = [r(0.5 / dx as f64), r(0.5 / dy as f64)];
    let mut pixels = vec![[x, y]];
    // What has lost its way never arrives.
    while [x, y] != end && pixels.len() as i64 <= dx + dy {
        let is_tie = next[0] == next[1];
        let along_x = next[0] < next[1] || (is_tie && at_tie > 0);
        let along_y = next[1] < next[0] || (is_tie && at_tie % 2 == 0);
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
    pixels
}

/// The same walk by an exact error term; at a tie it may also light both neighbours before it goes on diagonally.
fn by_error([[mut x, mut y], end]: Ends, at_tie: i64) -> Vec<Point> {
    let (sx, sy) = ((end[0] - x).signum(), (end[1] - y).signum());
    let [dx, dy] = [(end[0] - x).abs(), (end[1] - y).abs()];
    let mut error = dx - dy;
    let mut pixels = vec![[x, y]];
    while [x, y] != end && pixels.len() as i64 <= 4 * MOST_STEPS {
        // The error is positive where the line meets the next column before the next row.
        let is_tie = error == 0;
        let along_x = error > 0 || (is_tie && at_tie > 0);
        let along_y = error < 0 || (is_tie && at_tie != 1);
        if is_tie && at_tie == 3 {
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
    }
    pixels
}

/// A slope in so many bits of fraction that is added for each step.
struct FixedSlope {
    bits: i64,
    /// How the slope is cut: toward zero, down, or to the nearest.
    rounding: i64,
    /// Where the line begins; see `cut_slope_said`.
    start: i64,
    /// 1 where the last pixel is left out.
    without_last: i64,
}

/// p mod 9 is the number of bits, p / 9 mod 3 the rounding, p / 27 mod 5 the beginning, and from 135 on the last pixel is left out.
fn slope_of(p: i64) -> FixedSlope {
    FixedSlope {
        bits: [16, 8, 10, 12, 4, 6, 7, 14, 20][(p % 9) as usize],
        rounding: p / 9 % 3,
        start: p / 27 % 5,
        without_last: p / 135,
    }
}

/// Steps of a slope in fixed point, which is cut once and added for each step.
fn fixed_slope([from, to]: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let FixedSlope { bits, rounding, start, without_last } = slope_of(p);
    let way = [to[0] - from[0], to[1] - from[1]];
    let steps = way[0].abs().max(way[1].abs());
    let mut pixels = Vec::new();
    if steps > MOST_STEPS {
        return pixels;
    }
    // What a step adds to each coordinate.
    let slopes = way.map_array(|d| match (steps, rounding) {
        (0, _) => 0,
        (_, 0) => (d << bits) / steps,
        (_, 1) => (d << bits).div_euclid(steps),
        _ => ((d << bits) * 2 + steps).div_euclid(2 * steps),
    });
    let half = 1 << (bits - 1);
    let ahead =
        [[half; 2], [0; 2], [half - 1; 2], [half, half - 1], [half - 1, half]][start as usize];
    for i in 0..=steps - without_last {
        pixels.push(
            [0, 1].map_array(|k: usize| ((from[k] << bits) + ahead[k] + i * slopes[k]) >> bits),
        );
    }
    pixels
}

/// Steps in floats, by one of the ways that the table names.
fn floats(ends: Ends, window: PixelRect, p: i64) -> Vec<Point> {
    let (how, precision) = (p / 3, p % 3);
    let [from, to] = ends;
    let steps = (to[0] - from[0]).abs().max((to[1] - from[1]).abs());
    match how {
        NORMALISED.. => normalised(ends, window, how - NORMALISED, precision).unwrap_or_default(),
        _ if steps > MOST_STEPS => Vec::new(),
        0..=3 => added_up(ends, how, precision, steps),
        4..=6 => sloped(ends, how, precision),
        _ => interpolated(ends, how, precision, steps),
    }
}

/// Steps that are added up: rounded, cut toward zero, cut down after a half was added, or cut down half a pixel ahead.
fn added_up([from, to]: Ends, how: i64, precision: i64, steps: i64) -> Vec<Point> {
    let r = |v: f64| rounded(v, precision);
    let ahead = if how == 3 { 0.5 } else { 0.0 };
    let mut at = from.map_array(|v| r(v as f64 + ahead));
    // The longer axis has a step of 1, but rounded like the other one.
    let slope = |d: i64| if steps == 0 { 0.0 } else { r(d as f64 / steps as f64) };
    let step = [slope(to[0] - from[0]), slope(to[1] - from[1])];
    let mut pixels = Vec::with_capacity(steps as usize + 1);
    for _ in 0..=steps {
        pixels.push(at.map_array(|v| match how {
            0 => v.round() as i64,
            1 => v as i64,
            3 => v.floor() as i64,
            _ => (v + 0.5).floor() as i64,
        }));
        at = [r(at[0] + step[0]), r(at[1] + step[1])];
    }
    pixels
}

/// Each step from both ends: 7 and 8, as a + (b - a) t; 9 and 10, as a (1 - t) + b t; 11, from a rounded slope; 12 and 13, with a step
/// too many or too few.
fn interpolated([from, to]: Ends, how: i64, precision: i64, steps: i64) -> Vec<Point> {
    let r = |v: f64| rounded(v, precision);
    // The number that the way is divided by, in three of these wrongly.
    let of = (steps + [0, 1, -1][(how - 11).max(0) as usize]).max(1);
    let mut pixels = Vec::with_capacity(steps as usize + 1);
    for i in 0..=steps {
        let t = r(i as f64 / of as f64);
        pixels.push([0, 1].map_array(|k: usize| {
            let (a, b, way) = (from[k] as f64, to[k] as f64, (to[k] - from[k]) as f64);
            // Each formula is exact but for its roundings.
            let v = match how {
                11 => a + r(way / steps.max(1) as f64) * i as f64,
                9 | 10 => r(r(a * r(1.0 - t)) + r(b * t)),
                _ => r(a + r(r(way) * t)),
            };
            match how {
                11.. => (v + 0.5).floor() as i64,
                7 | 9 => v.round() as i64,
                _ => v as i64,
            }
        }));
    }
    pixels
}

/// From here on, ways of adding up steps go through numbers from -1 to 1.
const NORMALISED: i64 = 14;

/// Ends go through numbers from -1 to 1, in which the line is clipped by Liang and Barsky, and are cut to whole pixels. Bit 0 of
/// `how` is whether y runs upwards, bit 1 whether no half is added before the cut, and bit 2 whether steps begin at the first end.
fn normalised(ends: Ends, window: PixelRect, how: i64, precision: i64) -> Option<Vec<Point>> {
    let r = |v: f64| rounded(v, precision);
    let is_up = how & 1 == 1;
    let sides = [f64::from(window.x1), f64::from(window.y1)];
    let signs = [1.0, if is_up { -1.0 } else { 1.0 }];
    // Both ends in numbers from -1 to 1.
    let [from, to] = ends.map_array(|end| {
        [0, 1]
            .map_array(|k: usize| signs[k] * r(r(r(2.0 / sides[k]) * r(end[k] as f64 + 0.5)) - 1.0))
    });
    let way = [r(to[0] - from[0]), r(to[1] - from[1])];
    // The part of the line, from 0 to 1, that lies between the sides seen so far.
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
    // Back to whole pixels.
    let pixel = |part: f64, end: [f64; 2]| {
        [0, 1].map_array(|k: usize| {
            // An end inside stays as it is.
            let v = if part == 0.0 || part == 1.0 { end[k] } else { r(from[k] + r(part * way[k])) };
            let at = r(sides[k] / 2.0 + r(v * sides[k] / 2.0));
            if how & 2 == 0 { r(at + 0.5).floor() - 1.0 } else { at.floor() }
        })
    };
    let [from, to] = [pixel(first, from), pixel(last, to)];
    // The steps between them are added up.
    let way = [to[0] - from[0], to[1] - from[1]];
    let steps = way[0].abs().max(way[1].abs());
    let (begin, more) = if how & 4 == 0 { (0.5, 0) } else { (0.0, 1) };
    let step = way.map_array(|d| if steps == 0.0 { 0.0 } else { r(d / steps) });
    let mut at = [0, 1].map_array(|k: usize| r(from[k] + 0.5 + r(step[k] * begin)));
    let mut pixels = Vec::new();
    for _ in 0..steps as i64 + more {
        let [x, y] = [at[0] as i64, at[1] as i64];
        pixels.push([x, if is_up { i64::from(window.y1) - 1 - y } else { y }]);
        at = [r(at[0] + step[0]), r(at[1] + step[1])];
    }
    Some(pixels)
}

/// Each step from a slope in floats: 4, as y = m x + b; 5, from the first end; 6, from the left end.
fn sloped(ends: Ends, how: i64, precision: i64) -> Vec<Point> {
    let r = |v: f64| rounded(v, precision);
    let is_steep = is_steep(ends);
    let [first, last] = if is_steep { transposed(ends) } else { ends };
    let [[u0, v0], [u1, v1]] = from_left([first, last], how == 6);
    // The slope, and the height at 0, each rounded.
    let slope = if u0 == u1 { 0.0 } else { r((v1 - v0) as f64 / (u1 - u0) as f64) };
    let height = r(v0 as f64 - r(slope * u0 as f64));
    let mut pixels = Vec::new();
    for u in u0.min(u1)..=u0.max(u1) {
        let v = match how {
            4 => r(r(slope * u as f64) + height),
            _ => r(v0 as f64 + r(slope * (u - u0) as f64)),
        };
        let v = v.round() as i64;
        pixels.push(if is_steep { [v, u] } else { [u, v] });
    }
    pixels
}

/// What an error term may begin at, as multiples of the longer side a, in halves, and of the shorter side b.
const STARTS: [([i64; 2], &str); 9] = [
    ([-2, 2], "2b - a"),
    ([-4, 2], "2b - 2a"),
    ([0, 2], "2b"),
    ([-2, 1], "b - a"),
    ([0, 1], "b"),
    ([0, 0], "0"),
    ([2, 0], "a"),
    ([-2, 0], "-a"),
    ([-1, 2], "2b - a/2"),
];

/// Steps by an error of both axes, of which one moves at a time: x is tested first, or y with p mod 2; p / 2 is whether a tie
/// does not count.
fn staircase([[x0, y0], [x1, y1]]: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let [dx, dy] = [(x1 - x0).abs(), (y1 - y0).abs()];
    if dx + dy > 2 * MOST_STEPS {
        return Vec::new();
    }
    let (mut x, mut y, mut error) = (x0, y0, dx - dy);
    let mut pixels = vec![[x, y]];
    // Where it misses its end, it goes on somewhere else.
    while [x, y] != [x1, y1] && (x - x0).abs() <= dx && (y - y0).abs() <= dy {
        let tie = p / 2;
        // Each axis has its test, as in the loop that moves along both.
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
fn error_term(ends: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let [[mut x, mut y], [x1, y1]] = from_left(ends, p >= 54);
    let [dx, dy] = [(x1 - x).abs(), (y1 - y).abs()];
    let (sx, sy) = ((x1 - x).signum(), (y1 - y).signum());
    let (a, b) = (dx.max(dy), dx.min(dy));
    if a > MOST_STEPS || (p % 9 == 0 && p / 9 % 3 == 0) {
        return Vec::new();
    }
    // Right is what comes first: 2b for a step, and 2a for one across.
    let [up, down] = [[2 * b, 2 * a], [b, 2 * a], [2 * b, a]][(p / 9 % 3) as usize];
    // Half of an odd side is cut toward zero.
    let [halves, times] = STARTS[(p % 9) as usize].0;
    let mut error = times * b + halves * a / 2;
    let mut pixels = vec![[x, y]];
    for _ in 0..a {
        // The step goes along the other axis, too, where the error term says so.
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

/// A pixel for each step along one axis, whatever the slope is.
fn one_axis(ends: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let [[u0, v0], [u1, v1]] = if p == 0 { ends } else { transposed(ends) };
    let (steps, sign) = ((u1 - u0).abs(), (u1 - u0).signum());
    let mut pixels = Vec::new();
    if steps > MOST_STEPS {
        return pixels;
    }
    for i in 0..=steps {
        // The other coordinate is right, however far it moves in one step.
        let rise = if steps == 0 { 0 } else { divided((v1 - v0) * i, steps, 2) };
        let [u, v] = [u0 + sign * i, v0 + rise];
        pixels.push(if p == 0 { [u, v] } else { [v, u] });
    }
    pixels
}

/// An error term in a word that may wrap around; from 100 on it is that of a loop over the longer
/// axis.
fn short_error(ends: Ends, _: PixelRect, p: i64) -> Vec<Point> {
    let sides = Sides::of(ends);
    if sides.longer > MOST_STEPS {
        return Vec::new();
    }
    let shift = 64 - (p % 100) as u32;
    let word = |v: i64| v << shift >> shift;
    if p < 100 { error_of_both(ends, &word) } else { error_of_one(ends, p < 200, &word) }
}

/// A loop that moves along each axis where an error of both axes asks for it, in a word.
fn error_of_both([[mut x, mut y], end]: Ends, word: &dyn Fn(i64) -> i64) -> Vec<Point> {
    let [wide, high] = [(end[0] - x).abs(), (end[1] - y).abs()];
    let (dx, dy) = (word(wide), word(-high));
    let (sx, sy) = (if x < end[0] { 1 } else { -1 }, if y < end[1] { 1 } else { -1 });
    let mut error = word(dx + dy);
    let mut pixels = Vec::new();
    // Such a line need not arrive.
    for _ in 0..=2 * wide.max(high) {
        pixels.push([x, y]);
        if [x, y] == end {
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

/// A loop over the longer axis, in a word: the error begins at half the steps and loses the shorter side each, or it begins at 2b - a.
fn error_of_one(
    [[mut x, mut y], end]: Ends,
    is_half: bool,
    word: &dyn Fn(i64) -> i64,
) -> Vec<Point> {
    let [wide, high] = [(end[0] - x).abs(), (end[1] - y).abs()];
    let (sx, sy) = (if x < end[0] { 1 } else { -1 }, if y < end[1] { 1 } else { -1 });
    let (a, b) = (wide.max(high), wide.min(high));
    let mut error = word(if is_half { a / 2 } else { 2 * b - a });
    let mut pixels = Vec::new();
    for _ in 0..=a {
        pixels.push([x, y]);
        let is_across;
        // Below 0 the line has come nearer to the next row.
        if is_half {
            error = word(error - b);
            is_across = error < 0;
            error = if is_across { word(error + a) } else { error };
        } else {
            is_across = error > 0;
            error = word(error + 2 * b - if is_across { 2 * a } else { 0 });
        }
        if wide >= high || is_across {
            x += sx;
        }
        if wide < high || is_across {
            y += sy;
        }
    }
    pixels
}

/// The pixels of a picture, row by row.
fn pixels_of(mask: &Mask, window: PixelRect) -> Vec<Point> {
    let mut pixels = Vec::new();
    for y in 0..window.y1 {
        for x in 0..window.x1 {
            if mask.has(x, y) {
                pixels.push([x.into(), y.into()]);
            }
        }
    }
    pixels
}

/// A line as an area of one pixel's width, with both ends a half longer or not.
fn stroke(ends: Ends, window: PixelRect, p: i64) -> Vec<Point> {
    // Ends are centres of pixels.
    let [[x0, y0], [x1, y1]] = ends.map_array(|end| end.map_array(|v| v as f64 + 0.5));
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = (dx * dx + dy * dy).sqrt();
    if length == 0.0 {
        return Vec::new();
    }
    // Half a pixel along the line, and turned by a right angle to its side.
    let [dx, dy] = [dx / length / 2.0, dy / length / 2.0];
    let longer = if p > 3 { 1.0 } else { 0.0 };
    let (x0, y0) = (x0 - dx * longer, y0 - dy * longer);
    let (x1, y1) = (x1 + dx * longer, y1 + dy * longer);
    // The corners of the rectangle around the line.
    let area = [[x0 + dy, y0 - dx], [x1 + dy, y1 - dx], [x1 - dy, y1 + dx], [x0 - dy, y0 + dx]];
    pixels_of(&cells::by_area(&area, window, cells::LEAST[(p % 4) as usize]), window)
}

/// The picture of pixels in a window.
pub(super) fn mask(pixels: &[Point], window: PixelRect) -> Mask {
    let mut mask = Mask::default();
    for &[x, y] in pixels {
        if !is_outside(window, [x, y]) {
            // Inside the window, so both fit.
            mask.set(x as i32, y as i32);
        }
    }
    mask
}

/// The picture of a convention; none where it says nothing.
pub(super) fn of_convention(
    convention: &LineConvention,
    ends: Ends,
    window: PixelRect,
) -> Option<Mask> {
    // Conventions take ends in 32 bits, and no line of a question is as long as this.
    let ends = ends.map_array(|end| end.map_array(|v| v.clamp(-(1 << 30), 1 << 30) as i32));
    let pixels = convention.pixels(&LineQuestion { ends, window })?;
    Some(mask(&widened(&pixels), window))
}

/// Pixels as this module counts them.
pub(super) fn widened(pixels: &[[i32; 2]]) -> Vec<Point> {
    let mut all = Vec::with_capacity(pixels.len());
    for pixel in pixels {
        all.push(pixel.map_array(i64::from));
    }
    all
}
