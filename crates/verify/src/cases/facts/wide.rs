//! Facts of a question about a line with a width.

use std::cell::Cell;

use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{WideForm, WideLine};

use super::{
    Read, Test, Topic, Unit, WINDOW_WAYS, draw_window, fact, facts_of, numbers, saturated,
    vary_window,
};
use crate::cases::wide::{case_of, either, tied, wide_line};
use crate::cases::{Case, Limits};
use crate::oracle::wide::covers;

/// Lines with a width.
pub const TOPIC: Topic = Topic {
    name: "wide-line-design",
    facts: &facts_of(&FACTS),
    measure: |case, limits| Some(numbers(&FACTS, &WideFacts::of(case, limits)?)),
    impossible: include_str!("impossible/wide-line-design.txt"),
    draw,
    vary,
    put: Limits::put,
};

const PX: i64 = SUBPIXELS as i64;
const EXTENT: Test = Test::Steps(&[1, PX, 8 * PX, 64 * PX, 4096 * PX]);
const BITS: Test = Test::Steps(&[1, 2, 5]);
const SIDES: Test = Test::Steps(&[2, 3, 9]);
const SAMPLES: Test = Test::Steps(&[1, 2, 9]);
const WHETHER: Test = Test::Choice(&["none", "some"]);

/// The facts that the design covers.
const FACTS: [Read<WideFacts>; 22] = [
    fact("columns from its first to its second end", Unit::Subpixels, |m| m.by[0], Test::Sign),
    fact("rows from its first to its second end", Unit::Subpixels, |m| m.by[1], Test::Sign),
    fact(
        "columns that it spans beyond its rows",
        Unit::Subpixels,
        |m| m.by[0].abs() - m.by[1].abs(),
        Test::Sign,
    ),
    fact("the longer of its columns and rows", Unit::Subpixels, |m| m.long, EXTENT),
    fact("the shorter of them", Unit::Subpixels, |m| m.short, EXTENT),
    fact(
        "the width of the line",
        Unit::Subpixels,
        |m| m.width,
        Test::Steps(&[PX / 2, PX, PX + 1, 2 * PX, 2 * PX + 1, 8 * PX]),
    ),
    fact("the bits of its width below the pixel", Unit::Count, |m| bits(&[m.width]), BITS),
    fact("its width beyond its longer extent", Unit::Subpixels, |m| m.width - m.long, Test::Sign),
    fact("the bits of its columns below the pixel", Unit::Count, |m| m.bits[0], BITS),
    fact("the bits of its rows below the pixel", Unit::Count, |m| m.bits[1], BITS),
    fact(
        "the first end beside the columns of the window",
        Unit::Count,
        |m| m.places[0][0],
        Test::Sign,
    ),
    fact(
        "the first end beside the rows of the window",
        Unit::Count,
        |m| m.places[0][1],
        Test::Sign,
    ),
    fact(
        "the second end beside the columns of the window",
        Unit::Count,
        |m| m.places[1][0],
        Test::Sign,
    ),
    fact(
        "the second end beside the rows of the window",
        Unit::Count,
        |m| m.places[1][1],
        Test::Sign,
    ),
    fact("the width of the window", Unit::Pixels, |m| m.window[0], SIDES),
    fact("the height of the window", Unit::Pixels, |m| m.window[1], SIDES),
    fact("the width of the window in pixels", Unit::Count, |m| m.window[0], Test::Divisor),
    fact("the height of the window in pixels", Unit::Count, |m| m.window[1], Test::Divisor),
    fact("samples in it", Unit::Count, |m| m.inside, SAMPLES),
    fact("samples on the border of its rectangle", Unit::Count, |m| m.on_border[0], WHETHER),
    fact("samples on the border of its parallelogram", Unit::Count, |m| m.on_border[1], WHETHER),
    fact(
        "columns to a row, or rows to a column",
        Unit::Doublings,
        |m| m.slope,
        Test::Steps(&[0, 1, 4, 8]),
    ),
];

/// What was measured of a line with a width.
struct WideFacts {
    /// From the first end to the second.
    by: [i64; 2],
    long: i64,
    short: i64,
    width: i64,
    /// The most bits of a coordinate below the pixel, of columns and of rows.
    bits: [i64; 2],
    /// Whether each end lies before the first column and row (-1), behind the last ones (1), or neither.
    places: [[i64; 2]; 2],
    /// Sides of the window in pixels.
    window: [i64; 2],
    /// Samples in the rectangle.
    inside: i64,
    /// Samples on the border of the rectangle and of the parallelogram.
    on_border: [i64; 2],
    /// The logarithm of the ratio of its sides, -1 of a point.
    slope: i64,
}

/// The most bits of some numbers below the pixel.
fn bits(numbers: &[i64]) -> i64 {
    let of = |v: &i64| 8 - i64::from(v.trailing_zeros().min(8));
    numbers.iter().map(of).max().unwrap_or(0)
}

impl WideFacts {
    fn of(case: &Case, limits: &Limits) -> Option<Self> {
        let line = wide_line(case.triangles().first()?);
        let ends = line.ends.map(|p| [i64::from(p.x), i64::from(p.y)]);
        let by = [0, 1].map(|k| ends[1][k] - ends[0][k]);
        let [long, short] = [by[0].abs().max(by[1].abs()), by[0].abs().min(by[1].abs())];
        let window = [case.window.width(), case.window.height()].map(i64::from);
        let place = |v: i64, side: i64| i64::from(v > side * PX) - i64::from(v < 0);
        let mut measured = Self {
            by,
            long,
            short,
            width: line.width.into(),
            bits: [0, 1].map(|k| bits(&[ends[0][k], ends[1][k]])),
            places: ends.map(|end| [0, 1].map(|k| place(end[k], window[k]))),
            window,
            inside: 0,
            on_border: [0; 2],
            slope: match (long, short.max(1)) {
                (0, _) => -1,
                (long, short) => i64::from((long / short).ilog2()),
            },
        };
        // No sample lies further beside the ends than half the width.
        let [columns, rows] = [0, 1].map(|k| {
            let near = ends[0][k].min(ends[1][k]) - measured.width / 2 - 1;
            let far = ends[0][k].max(ends[1][k]) + measured.width / 2 + 1;
            near.div_euclid(PX).max(0)..(far.div_euclid(PX) + 1).min(window[k])
        });
        for y in rows {
            for x in columns.clone() {
                let pixel = [x * PX, y * PX];
                measured.count(&line, [0, 1].map(|k| pixel[k] + i64::from(limits.sample[k])));
            }
        }
        Some(measured)
    }

    fn count(&mut self, line: &WideLine, sample: [i64; 2]) {
        for (at, form) in WideForm::ALL.into_iter().enumerate() {
            // The owner is asked on the border alone.
            let is_on_border = Cell::new(false);
            let ask = |_| {
                is_on_border.set(true);
                true
            };
            if covers(line, form, sample, &ask) {
                self.on_border[at] += i64::from(is_on_border.get());
                self.inside += i64::from(!is_on_border.get() && form == WideForm::Rectangle);
            }
        }
    }
}

/// The largest side of a window: every sample of it is compared.
const MOST_PX: i32 = 24;

fn fitted(window: PixelRect) -> PixelRect {
    PixelRect { x1: window.x1.min(MOST_PX), y1: window.y1.min(MOST_PX), ..window }
}

fn draw_coordinate(rng: &mut Rng, side: i64) -> i32 {
    let px = match rng.int(0, 5) {
        0..=2 => rng.int(0, side),
        3 => rng.int(-side, 2 * side),
        4 => [0, side][rng.int(0, 1) as usize],
        _ => {
            let far = 1 << rng.int(2, 20);
            rng.int(-far, far)
        }
    };
    let step = 1 << rng.int(0, 8);
    saturated(px * PX + rng.int(0, PX - 1) / step * step)
}

fn draw_width(rng: &mut Rng) -> i32 {
    let px = SUBPIXELS;
    let step = 1 << rng.int(0, 7);
    match rng.int(0, 5) {
        0 => px,
        1 => 2 * px,
        2 => (rng.coordinate(1, PX) / step * step).max(step),
        3 => rng.coordinate(1, 4) * px / 2,
        _ => (rng.coordinate(1, 24 * PX) / step * step).max(step),
    }
}

fn draw(rng: &mut Rng) -> Case {
    let window = fitted(draw_window(rng));
    let mut end = || {
        let [x, y] = [window.x1, window.y1].map(|side| draw_coordinate(rng, side.into()));
        SubpixelPoint::new(x, y)
    };
    let ends = [end(), end()];
    let mut line = WideLine { ends, width: draw_width(rng) };
    adjust(rng, &mut line, window);
    case_of(window, &line)
}

/// Gives some lines what hardly any has by chance: a direction along an axis, a diagonal, a length of 0, a sample on the border, a width
/// that is the longer extent.
fn adjust(rng: &mut Rng, line: &mut WideLine, window: PixelRect) {
    let [a, b] = line.ends;
    let half = line.width / 2;
    match rng.int(0, 11) {
        0 => line.ends[1].x = a.x,
        1 => line.ends[1].y = a.y,
        2 => {
            line.ends[1].y =
                saturated(i64::from(a.y) + (i64::from(b.x) - i64::from(a.x)) * either(rng, 1))
        }
        3 => line.ends[1] = if rng.chance(3) { a } else { b },
        4..=6 => *line = tied(rng, window),
        // A sample half a width above or below an end, or left or right of it.
        7 => {
            let at = rng.int(0, 1) as usize;
            let centre = |px: i32| px * SUBPIXELS + HALF_PIXEL;
            let [x, y] =
                [window.x1, window.y1].map(|side| centre(rng.coordinate(0, i64::from(side) - 1)));
            let by = if rng.chance(2) { half } else { -half };
            line.ends[at] = if rng.chance(2) {
                SubpixelPoint::new(x, y + by)
            } else {
                SubpixelPoint::new(x + by, y)
            };
        }
        // Nearly level, or nearly upright.
        8 => line.ends[1].y = saturated(i64::from(a.y) + rng.int(-PX, PX)),
        9 => line.ends[1].x = saturated(i64::from(a.x) + rng.int(-PX, PX)),
        10 => {
            let most = i64::from(MOST_PX) * PX;
            let [dx, dy] = [(); 2].map(|()| rng.coordinate(-most, most));
            line.ends[1] = SubpixelPoint::new(a.x.saturating_add(dx), a.y.saturating_add(dy));
            line.width = dx.abs().max(dy.abs()).max(1);
        }
        // Both extents are long, and one is many times the other.
        _ if rng.chance(4) => {
            let short = rng.int(1 << 12, 1 << 13) * PX;
            let long = short * rng.int(1 << 8, 1 << 9);
            let [dx, dy] = if rng.chance(2) { [short, long] } else { [long, short] };
            let [x, y] = [either(rng, dx), either(rng, dy)];
            line.ends[1].x = saturated(i64::from(a.x) + x);
            line.ends[1].y = saturated(i64::from(a.y) + y);
        }
        _ => {}
    }
}

fn vary(rng: &mut Rng, one: &Case, other: &Case) -> Case {
    let of = |case: &Case| case.triangles().first().map(wide_line);
    let mut window = one.window;
    let (Some(mut line), Some(others)) = (of(one), of(other)) else { return one.clone() };
    for _ in 0..rng.int(1, 3) {
        let (at, axis) = (rng.int(0, 1) as usize, rng.int(0, 1) as usize);
        match rng.int(0, 13) {
            way @ 0..WINDOW_WAYS => vary_window(rng, &mut window, other.window, way, axis),
            4 => line.ends[at] = others.ends[at],
            5 if axis == 0 => line.ends[at].x = others.ends[at].x,
            5 => line.ends[at].y = others.ends[at].y,
            6 => line.ends.swap(0, 1),
            7 => line.width = others.width,
            8 => line.width = draw_width(rng),
            9 if axis == 0 => line.ends[at].x = draw_coordinate(rng, window.x1.into()),
            9 => line.ends[at].y = draw_coordinate(rng, window.y1.into()),
            // Moved as a whole.
            10 => {
                let by = [(); 2].map(|()| rng.int(-20, 20) << rng.int(0, 12));
                for end in &mut line.ends {
                    end.x = saturated(i64::from(end.x) + by[0]);
                    end.y = saturated(i64::from(end.y) + by[1]);
                }
            }
            _ => adjust(rng, &mut line, window),
        }
    }
    case_of(fitted(window), &line)
}
