//! Facts of a question about one line between whole pixels.

use glam::DVec2;

use rasterproof_core::geometry::greatest_divisor;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};

use super::{
    Read, Test, Topic, Unit, WINDOW_WAYS, draw_window, fact, facts_of, numbers, saturated,
    vary_window,
};
use crate::cases::{Case, Limits, Shape};

/// Lines.
pub const TOPIC: Topic = Topic {
    name: "line-design",
    facts: &facts_of(&FACTS),
    measure: |case, _| Some(numbers(&FACTS, &LineFacts::of_case(case)?)),
    impossible: include_str!("impossible/line-design.txt"),
    draw,
    vary,
    put: Limits::put,
};

const SIDES: Test = Test::Steps(&[2, 3, 9, 33, 257]);
const LENGTH: Test = Test::Steps(&[1, 2, 9, 41, 257, 1 << 12, 1 << 15, 1 << 20]);
/// Before the window by so much, in it, behind it.
const PLACE: Test = Test::Steps(&[-(1 << 15), -256, 0, 1, 257, 1 << 15]);

/// The facts that the design covers.
const FACTS: [Read<LineFacts>; 20] = [
    fact("columns from its first to its second end", Unit::Count, |m| m.by[0], Test::Sign),
    fact("rows from its first to its second end", Unit::Count, |m| m.by[1], Test::Sign),
    fact(
        "columns that it spans beyond its rows",
        Unit::Count,
        |m| m.size[0] - m.size[1],
        Test::Sign,
    ),
    fact(
        "the longer of the columns and the rows that it spans",
        Unit::Count,
        |m| m.size[0].max(m.size[1]),
        LENGTH,
    ),
    fact("the shorter of them", Unit::Count, |m| m.size[0].min(m.size[1]), LENGTH),
    fact("the longer of them", Unit::Count, |m| m.size[0].max(m.size[1]), Test::Divisor),
    fact(
        "points halfway between two pixels",
        Unit::Count,
        |m| m.ties,
        Test::Choice(&["none", "some"]),
    ),
    fact("the first end beside the columns of the window", Unit::Count, |m| m.places[0][0], PLACE),
    fact("the first end beside the rows of the window", Unit::Count, |m| m.places[0][1], PLACE),
    fact("the second end beside the columns of the window", Unit::Count, |m| m.places[1][0], PLACE),
    fact("the second end beside the rows of the window", Unit::Count, |m| m.places[1][1], PLACE),
    fact("the width of the window", Unit::Pixels, |m| m.window[0], SIDES),
    fact("the height of the window", Unit::Pixels, |m| m.window[1], SIDES),
    fact("the width of the window in pixels", Unit::Count, |m| m.window[0], Test::Divisor),
    fact("the height of the window in pixels", Unit::Count, |m| m.window[1], Test::Divisor),
    fact("its pixels in the window", Unit::Count, |m| m.pixels, Test::Steps(&[1, 2, 9, 33])),
    fact("the first column", Unit::Count, |m| m.first[0], Test::Divisor),
    fact("the first row", Unit::Count, |m| m.first[1], Test::Divisor),
    fact(
        "columns to a row, or rows to a column",
        Unit::Doublings,
        |m| m.slope,
        Test::Steps(&[0, 1, 4, 7, 12]),
    ),
    fact("ends on the border of the window", Unit::Count, |m| m.on_border, Test::Steps(&[1, 2])),
];

/// What was measured of a line in its window, in pixels.
pub struct LineFacts {
    /// Columns and rows from the first end to the second.
    pub by: [i64; 2],
    /// The same without sign.
    pub size: [i64; 2],
    /// Whether it passes halfway between two pixels somewhere.
    pub ties: i64,
    /// How far each end lies before the first column and row (below 0), behind the last ones (above 0), or neither (0).
    pub places: [[i64; 2]; 2],
    /// Sides of the window.
    pub window: [i64; 2],
    /// Pixels of it in the window.
    pub pixels: i64,
    /// Column and row of its first end.
    pub first: [i64; 2],
    /// The logarithm of the ratio of its sides, -1 of a point, and of what is level or upright as long as it is.
    pub slope: i64,
    /// Ends in the first or the last row or column.
    pub on_border: i64,
}

impl LineFacts {
    /// Of the first line of a case.
    #[must_use]
    pub fn of_case(case: &Case) -> Option<Self> {
        let Shape::Lines(lines) = &case.shape else { return None };
        Some(Self::of(lines.first()?.ends.map(|end| end.pixel), case.window))
    }

    /// Of a line.
    #[must_use]
    pub fn of(ends: [PixelPoint; 2], window: PixelRect) -> Self {
        let ends = ends.map(|p| [i64::from(p.x), i64::from(p.y)]);
        let by = [0, 1].map(|axis| ends[1][axis] - ends[0][axis]);
        let size = by.map(i64::abs);
        let sides = [window.width(), window.height()].map(i64::from);
        let place = |v: i64, side: i64| if v < 0 { v } else { (v - side + 1).max(0) };
        let is_in = |end: &[i64; 2]| (0..2).all(|axis| (0..sides[axis]).contains(&end[axis]));
        let on_border = |end: &&[i64; 2]| {
            is_in(end) && (0..2).any(|axis| end[axis] == 0 || end[axis] == sides[axis] - 1)
        };
        let [long, short] = [size[0].max(size[1]), size[0].min(size[1])];
        // Step k of `long` rises by k short / long. That is halfway somewhere if in lowest terms the denominator is even.
        let divisor = greatest_divisor(long, short).max(1);
        let ties = i64::from(short > 0 && (long / divisor) % 2 == 0);
        Self {
            by,
            size,
            ties,
            places: ends.map(|end| [0, 1].map(|axis| place(end[axis], sides[axis]))),
            window: sides,
            pixels: pixels(ends, size, sides),
            first: ends[0],
            slope: match (long, short.max(1)) {
                (0, _) => -1,
                (long, short) => i64::from((long / short).ilog2()),
            },
            on_border: ends.iter().filter(on_border).count() as i64,
        }
    }
}

/// Pixels of a line in the window. Where it passes halfway between two pixels either may be counted.
fn pixels(ends: [[i64; 2]; 2], size: [i64; 2], sides: [i64; 2]) -> i64 {
    let long = usize::from(size[1] > size[0]);
    let short = 1 - long;
    let [start, end] = match ends[0][long] <= ends[1][long] {
        true => ends,
        false => [ends[1], ends[0]],
    };
    // Only the steps inside the window are walked.
    let mut count = 0;
    for at in start[long].max(0)..=end[long].min(sides[long] - 1) {
        let steps = i128::from(at - start[long]);
        let rise = i128::from(end[short] - start[short]);
        let length = i128::from(size[long].max(1));
        let across = i128::from(start[short]) + (2 * steps * rise + length).div_euclid(2 * length);
        count += i64::from((0..i128::from(sides[short])).contains(&across));
    }
    count
}

fn draw_coordinate(rng: &mut Rng, side: i64, reach: i64) -> i64 {
    match rng.int(0, 6) {
        0..=2 => rng.int(0, side - 1),
        3 => [0, side - 1][rng.int(0, 1) as usize],
        4 => rng.int(-side, 2 * side),
        5 => rng.int(-2, side + 1),
        _ => {
            let far = rng.int(reach / 2, reach);
            if rng.chance(2) { -far } else { side + far }
        }
    }
}

fn draw(rng: &mut Rng) -> Case {
    let window = draw_window(rng);
    let (sides, reach) = ([window.width(), window.height()].map(i64::from), 1 << rng.int(1, 30));
    let mut ends =
        [(); 2].map(|()| [0, 1].map(|axis: usize| draw_coordinate(rng, sides[axis], reach)));
    adjust(rng, &mut ends, sides);
    case_of(window, ends)
}

/// Gives some lines what hardly any has by chance: a direction along an axis, a diagonal, a tie, a pixel inside.
fn adjust(rng: &mut Rng, ends: &mut [[i64; 2]; 2], sides: [i64; 2]) {
    let axis = rng.int(0, 1) as usize;
    let inside = sides.map(|side| rng.int(0, side - 1));
    match rng.int(0, 10) {
        0 => ends[1][axis] = ends[0][axis] + rng.int(-1, 1),
        // As many rows as columns, or one more.
        1 => {
            let by = (ends[1][1 - axis] - ends[0][1 - axis]).abs() + i64::from(rng.chance(4));
            ends[1][axis] = ends[0][axis] + if rng.chance(2) { by } else { -by };
        }
        // Through a pixel inside: the other end is the image of the first.
        2..=4 => ends[1] = [0, 1].map(|axis: usize| 2 * inside[axis] - ends[0][axis]),
        // Half as many steps across as along, which is a tie where the number is odd, or a smaller part.
        5 | 8 => {
            let by = ends[1][1 - axis] - ends[0][1 - axis];
            let halvings = if rng.chance(2) { 1 } else { rng.int(2, 14) };
            ends[1][axis] = ends[0][axis] + (by >> halvings);
        }
        // From corner to corner.
        7 => {
            for (at, end) in ends.iter_mut().enumerate() {
                *end = sides.map(|side| at as i64 * (side - 1));
            }
            if rng.chance(2) {
                (ends[0][0], ends[1][0]) = (ends[1][0], ends[0][0]);
            }
        }
        // From border to border.
        6 => {
            for end in ends.iter_mut() {
                *end = inside;
                end[axis] = [0, sides[axis] - 1][rng.int(0, 1) as usize];
                end[1 - axis] = [end[1 - axis], 0, sides[1 - axis] - 1][rng.int(0, 2) as usize];
            }
        }
        _ => {}
    }
}

fn vary(rng: &mut Rng, one: &Case, other: &Case) -> Case {
    let of = |case: &Case| match &case.shape {
        Shape::Lines(lines) => {
            lines[0].ends.map(|end| [i64::from(end.pixel.x), i64::from(end.pixel.y)])
        }
        _ => [[0; 2]; 2],
    };
    let mut window = one.window;
    let (mut ends, others) = (of(one), of(other));
    for _ in 0..rng.int(1, 3) {
        let (at, axis) = (rng.int(0, 1) as usize, rng.int(0, 1) as usize);
        let sides = [window.width(), window.height()].map(i64::from);
        match rng.int(0, 11) {
            way @ 0..WINDOW_WAYS => vary_window(rng, &mut window, other.window, way, axis),
            4 => ends[at] = others[at],
            5 => ends[at][axis] = others[at][axis],
            6 => ends.swap(0, 1),
            7 => {
                let reach = 1 << rng.int(1, 30);
                ends[at][axis] = draw_coordinate(rng, sides[axis], reach);
            }
            8 => ends[at][axis] += rng.int(-2, 2),
            // Moved as a whole.
            9 => {
                let by = rng.int(-20, 20) << rng.int(0, 14);
                ends.iter_mut().for_each(|end| end[axis] += by);
            }
            _ => adjust(rng, &mut ends, sides),
        }
    }
    case_of(window, ends)
}

fn case_of(window: PixelRect, ends: [[i64; 2]; 2]) -> Case {
    let end = |[x, y]: [i64; 2], values: [f64; 3]| LineEnd {
        pixel: PixelPoint::new(saturated(x), saturated(y)),
        depth: values[0],
        varying: DVec2::new(values[1], values[2]),
    };
    let [first, second] = ends;
    let ends = [end(first, [0.25, 1.0, -1.0]), end(second, [0.75, 3.0, 1.0])];
    Case { window, shape: Shape::Lines(vec![ScreenLine { ends }]) }
}
