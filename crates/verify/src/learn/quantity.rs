//! The quantities of a question and of a pixel, from which all facts are derived: every quantity gets every test.

use std::sync::{Arc, OnceLock};

use super::picture::{MARGIN, Picture, Runs};
use super::question::{AnyQuestion, Unit, first_sample};
use rasterproof_core::geometry::greatest_divisor;

/// The words of a quantity.
#[derive(Clone, Debug)]
pub struct Name {
    pub(super) unit: Unit,
    /// Such as 'its column'; of a flag, what is said where it holds.
    pub(super) noun: String,
    /// What is said where it is 0, and where it is not; empty where the noun says it.
    pub(super) zero: [String; 2],
}

/// A quantity that a pixel does not have, such as its place in a row without pixels: no test of it holds.
pub const NONE: i64 = i64::MIN;

/// Takes the quantities in their order: their values, and their names where these are wanted. Names come in pieces, which
/// are joined only for those who want them.
#[derive(Default)]
pub struct Quantities {
    /// The values.
    pub values: Vec<i64>,
    /// The names of the same, where they are wanted.
    pub names: Option<Vec<Name>>,
    /// Groups of quantities of a pixel that are left out: their values are not looked at.
    pub(super) left_out: [bool; GROUPS],
    /// How many quantities each group has.
    pub(super) sizes: [usize; GROUPS],
}

/// Quantities of a pixel that are computed together.
pub(super) const GROUPS: usize = 6;

impl Quantities {
    /// Computes a group, unless it is left out.
    fn group(&mut self, number: usize, compute: impl FnOnce(&mut Self)) {
        let start = self.values.len();
        if self.left_out[number] {
            self.values.resize(start + self.sizes[number], NONE);
            return;
        }
        compute(self);
        self.sizes[number] = self.values.len() - start;
    }

    fn put(&mut self, unit: Unit, value: i64, noun: &[&str], zero: [&str; 2]) {
        self.values.push(value);
        if let Some(names) = &mut self.names {
            names.push(Name { unit, noun: noun.concat(), zero: zero.map(str::to_owned) });
        }
    }

    /// The words are the noun, and what is said where it is 0.
    fn named(&mut self, unit: Unit, value: i64, words: impl FnOnce() -> (String, String)) {
        self.values.push(value);
        if let Some(names) = &mut self.names {
            let (noun, zero) = words();
            names.push(Name { unit, noun, zero: [zero, String::new()] });
        }
    }

    /// Whether something holds: what is said where it does, in pieces, and where it does not.
    pub fn flag(&mut self, value: bool, yes: &[&str], no: &str) {
        self.put(Unit::Flag, value.into(), yes, [no, ""]);
    }

    /// A number with its noun, in pieces.
    pub fn number(&mut self, unit: Unit, value: i64, noun: &[&str]) {
        self.put(unit, value, noun, ["", ""]);
    }
}

pub(super) const AXES: [&str; 2] = ["x", "y"];
pub(super) const ORDINALS: [&str; 3] = ["first", "second", "third"];
pub(super) const SIDES: [&str; 2] = ["width", "height"];

/// Ratios are whole numbers of this part: fine enough to tell 4 from a little more.
pub(super) const RATIO: i64 = 1 << 16;

/// The values of the quantities of a question.
pub(super) fn facts_of(question: &AnyQuestion) -> Vec<i64> {
    let mut out = Quantities::default();
    of_question(question, &mut out);
    out.values
}

/// The quantities of a question.
pub(super) fn of_question(q: &AnyQuestion, out: &mut Quantities) {
    let (unit, one) = (q.unit(), q.one());
    let corner = if q.is_line() { " end" } else { " corner" };
    for axis in [0, 1] {
        let (name, side) = (AXES[axis], i64::from(q.side[axis]));
        out.number(Unit::Pixels, side, &["the ", SIDES[axis], " of the window"]);
        for (point, ordinal) in q.points.iter().zip(ORDINALS) {
            out.number(unit, point[axis], &[name, " of the ", ordinal, corner]);
            let beyond = point[axis] - side * one;
            let words = ["the ", SIDES[axis], " of the window"];
            let noun = [&[name, " of the ", ordinal, corner, " less "], &words[..]].concat();
            out.number(unit, beyond, &noun);
        }
        let [least, most] = q.range(axis);
        out.number(unit, least, &["the smallest ", name]);
        out.number(unit, most, &["the largest ", name]);
        out.number(
            unit,
            most - side * one,
            &["the largest ", name, " less the ", SIDES[axis], " of the window"],
        );
        out.number(unit, most - least, &["the ", SIDES[axis], " of the shape"]);
        out.number(
            Unit::Count,
            q.fineness(axis),
            &["the finest fraction of ", name, ", 1/n px, with n"],
        );
    }
    let extent = q.extent();
    out.number(unit, extent[0].max(extent[1]), &["the longer of width and height"]);
    out.number(unit, extent[0].min(extent[1]), &["the shorter of width and height"]);
    out.number(unit, extent[0] - extent[1], &["the width less the height"]);
    let farthest = q.points.iter().flatten().map(|v| v.abs()).max().unwrap_or(0);
    out.number(unit, farthest, &["the farthest coordinate"]);
    let is_inside = (0..2).all(|axis| {
        let [least, most] = q.range(axis);
        least >= 0 && most <= i64::from(q.side[axis]) * one - i64::from(q.is_line())
    });
    out.flag(is_inside, &["it lies within the window"], "it leaves the window");
    if q.is_line() { of_line(q, out) } else { of_triangle(q, out) }
}

fn of_line(q: &AnyQuestion, out: &mut Quantities) {
    let [dx, dy] = q.side_of(0, 1);
    let (du, dv) = (dx.abs().max(dy.abs()), dx.abs().min(dy.abs()));
    let is_steep = dy.abs() > dx.abs();
    let major = if is_steep { dy } else { dx };
    out.number(Unit::Pixels, dx, &["dx"]);
    out.number(Unit::Pixels, dy, &["dy"]);
    out.number(Unit::Pixels, du - 2 * dv, &["the longer less twice the shorter of |dx| and |dy|"]);
    out.number(Unit::Area, dx.saturating_mul(dy).saturating_mul(131_072), &["dx dy"]);
    out.flag(is_steep, &["it is steep"], "it is not steep");
    out.flag(
        major < 0,
        &["it runs backwards along its longer axis"],
        "it runs forwards along its longer axis",
    );
    out.flag(dx * dy < 0, &["x and y go opposite ways"], "x and y do not go opposite ways");
    let reduced = du / greatest_divisor(du, dv).max(1);
    out.flag(
        dv > 0 && reduced % 2 == 0,
        &["it passes halfway between pixels"],
        "it passes nowhere halfway between pixels",
    );
    for (point, ordinal) in q.points.iter().zip(ORDINALS) {
        let is_in = (0..2).all(|axis| (0..i64::from(q.side[axis])).contains(&point[axis]));
        out.flag(
            is_in,
            &["its ", ordinal, " end is in the window"],
            if ordinal == "first" {
                "its first end is outside the window"
            } else {
                "its second end is outside the window"
            },
        );
    }
}

/// The edges of a triangle by the numbers of their corners.
pub(super) const EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

fn of_triangle(q: &AnyQuestion, out: &mut Quantities) {
    let area = q.twice_area();
    out.flag(area > 0, &["it is clockwise"], "it is not clockwise");
    out.number(Unit::Area, area.abs(), &["its area"]);
    let longest = EDGES.map(|[a, b]| length(q.side_of(a, b))).into_iter().max().unwrap_or(1);
    out.number(Unit::Subpixels, area.abs() / longest.max(1), &["its smallest altitude"]);
    for (edge, ordinal) in EDGES.iter().zip(ORDINALS) {
        let [dx, dy] = q.side_of(edge[0], edge[1]);
        out.number(Unit::Subpixels, dx, &["dx of the ", ordinal, " edge"]);
        out.number(Unit::Subpixels, dy, &["dy of the ", ordinal, " edge"]);
    }
    let slopes = EDGES.map(|[a, b]| {
        let [dx, dy] = q.side_of(a, b).map(i64::abs);
        if dy == 0 { NONE } else { dx * RATIO / dy }
    });
    let known = || slopes.iter().copied().filter(|slope| *slope != NONE);
    out.number(Unit::Ratio, known().max().unwrap_or(NONE), &["the largest |dx|/|dy| of its edges"]);
    out.number(
        Unit::Ratio,
        known().min().unwrap_or(NONE),
        &["the smallest |dx|/|dy| of its edges"],
    );
    for axis in [0, 1] {
        let [least, most] = q.range(axis);
        let spanned = most.div_euclid(256) + (-least).div_euclid(256) + 1;
        let noun =
            ["the number of borders of pixels from its smallest to its largest ", AXES[axis]];
        out.number(Unit::Involved, spanned, &noun);
    }
    for axis in [0, 1] {
        let of = |a: usize, b: usize| q.points[a][axis] == q.points[b][axis];
        let straight = EDGES.iter().any(|[a, b]| of(*a, *b));
        let word = ["an upright", "a level"][axis];
        out.flag(
            straight,
            &["it has ", word, " edge"],
            ["it has no upright edge", "it has no level edge"][axis],
        );
    }
    let [width, height] = q.extent();
    let ratio = |a: i64, b: i64| if b == 0 { NONE } else { a.saturating_mul(RATIO) / b };
    out.number(Unit::Ratio, ratio(width, height), &["its width over its height"]);
    let [top, middle, bottom] = q.by_height();
    out.number(Unit::Count, top as i64 + 1, &["the number of its top corner"]);
    out.number(Unit::Count, bottom as i64 + 1, &["the number of its bottom corner"]);
    for axis in [0, 1] {
        let [least, most] = q.range(axis);
        for (limit, word) in [(least, "smallest"), (most, "largest")] {
            let all = q.points.iter().filter(|point| point[axis] == limit).count();
            let noun = ["the number of corners at its ", word, " ", AXES[axis]];
            out.number(Unit::Count, all as i64, &noun);
        }
        for (i, ordinal) in ORDINALS.iter().enumerate() {
            let here = q.points[i][axis];
            let is_alone = q.points.iter().filter(|p| p[axis] == here).count() == 1;
            for (limit, word) in [(least, "smallest"), (most, "largest")] {
                let is_at = is_alone && here == limit;
                let noun = ["the ", ordinal, " corner alone has its ", word, " ", AXES[axis]];
                let no = [&["it is not so that "][..], &noun[..]].concat().concat();
                out.flag(is_at, &noun, &no);
            }
        }
    }
    for (a, b, edge) in [
        (top, middle, "the edge from the top to the middle corner"),
        (top, bottom, "the edge from the top to the bottom corner"),
        (middle, bottom, "the edge from the middle to the bottom corner"),
    ] {
        let [dx, dy] = q.side_of(a, b);
        out.number(Unit::Subpixels, dx, &["dx of ", edge]);
        out.number(Unit::Ratio, ratio(dx, dy), &["dx/dy of ", edge]);
    }
    let height = |a: usize, b: usize| q.points[b][1] - q.points[a][1];
    out.number(Unit::Subpixels, height(top, middle), &["the height of its upper half"]);
    out.number(Unit::Subpixels, height(middle, bottom), &["the height of its lower half"]);
    out.flag(
        q.middle_is_left([top, middle, bottom]),
        &["its middle corner is on the left"],
        "its middle corner is not on the left",
    );
}

/// What a model predicts of a question so far: its facts are those of its pixels.
pub(super) struct Scene<'a> {
    pub(super) question: &'a AnyQuestion,
    /// What is drawn within the window; beyond it, what would be.
    pub(super) drawn: &'a Picture,
    shape: Arc<Shape>,
    /// Where samples lie in their pixel, in subpixels.
    sample: [i64; 2],
    /// Twice the edge functions begin at these corners, turned so that inside is positive.
    edges: Vec<Edge>,
}

/// What is computed once of a question and its picture, for all of its pixels.
pub(super) struct Shape {
    runs: Runs,
    /// Of each column and each row of the window and its margin, from the first on.
    crossings: [OnceLock<Vec<Option<Crossings>>>; 2],
}

impl Shape {
    pub(super) fn of(drawn: &Picture) -> Self {
        Self { runs: Runs::of(drawn), crossings: [OnceLock::new(), OnceLock::new()] }
    }
}

/// Whether an edge with this direction faces somewhere.
type Facing = fn([i64; 2]) -> bool;

/// An edge with the inside on its positive side.
struct Edge {
    from: [i64; 2],
    by: [i64; 2],
    length: i64,
}

impl<'a> Scene<'a> {
    pub(super) fn new(question: &'a AnyQuestion, drawn: &'a Picture, sample: [i64; 2]) -> Self {
        Self::with_shape(question, drawn, Arc::new(Shape::of(drawn)), sample)
    }

    /// For whoever looks at the question and the picture again and again, with the same sample.
    pub(super) fn with_shape(
        question: &'a AnyQuestion,
        drawn: &'a Picture,
        shape: Arc<Shape>,
        sample: [i64; 2],
    ) -> Self {
        let turn = if question.is_line() { 0 } else { question.twice_area() };
        let edges = EDGES.iter().filter(|_| turn != 0).map(|[a, b]| {
            let (a, b) = if turn > 0 { (*a, *b) } else { (*b, *a) };
            let by = question.side_of(a, b);
            Edge { from: question.points[a], by, length: length(by).max(1) }
        });
        let edges = edges.collect();
        Self { question, drawn, shape, sample, edges }
    }

    fn is_shown(&self, at: [i32; 2]) -> bool {
        self.drawn.shows(at) && self.drawn.has(at)
    }

    /// The quantities of a pixel.
    pub(super) fn of_pixel(&self, [x, y]: [i32; 2], out: &mut Quantities) {
        let (column, row) = (i64::from(x), i64::from(y));
        let [width, height] = self.drawn.side.map(i64::from);
        out.number(Unit::Paired, column, &["its column"]);
        out.number(Unit::Paired, row, &["its row"]);
        out.put(
            Unit::Paired,
            width - 1 - column,
            &["the number of columns to its right in the window"],
            ["it is in the last column of the window", ""],
        );
        out.put(
            Unit::Paired,
            height - 1 - row,
            &["the number of rows below it in the window"],
            ["it is in the last row of the window", ""],
        );
        // Width and height are easily taken for each other.
        out.number(
            Unit::Paired,
            height - 1 - column,
            &["the height of the window less 1 less its column"],
        );
        out.number(Unit::Paired, width - 1 - row, &["the width of the window less 1 less its row"]);
        out.group(0, |out| self.places([x, y], out));
        out.group(1, |out| self.neighbours([x, y], out));
        out.group(2, |out| self.tiles([x, y], out));
        out.group(3, |out| match self.question.is_line() {
            true => self.along_the_line([column, row], out),
            false => self.by_edges([column, row], out),
        });
        out.group(4, |out| match self.question.is_line() {
            true => self.along_its_run([x, y], out),
            false => self.by_crossings(1, [column, row], out),
        });
        out.group(5, |out| {
            if !self.question.is_line() {
                self.by_crossings(0, [column, row], out);
            }
        });
    }

    /// Its place in its row, its column and the shape.
    fn places(&self, [x, y]: [i32; 2], out: &mut Quantities) {
        let row = self.shape.runs.row(y);
        let column = self.shape.runs.column(x);
        let count = |value: Option<i32>| value.map_or(NONE, i64::from);
        out.put(
            Unit::Paired,
            count(row.map(|r| x - r.first)),
            &["the number of columns from the first pixel of its row"],
            ["it is the first pixel of its row", "it is not the first pixel of its row"],
        );
        out.put(
            Unit::Paired,
            count(row.map(|r| r.last - x)),
            &["the number of columns to the last pixel of its row"],
            ["it is the last pixel of its row", "it is not the last pixel of its row"],
        );
        out.number(Unit::Paired, count(row.map(|r| r.count)), &["the number of pixels in its row"]);
        out.put(
            Unit::Paired,
            count(column.map(|c| y - c.first)),
            &["the number of rows from the first pixel of its column"],
            ["it is the first pixel of its column", "it is not the first pixel of its column"],
        );
        out.put(
            Unit::Paired,
            count(column.map(|c| c.last - y)),
            &["the number of rows to the last pixel of its column"],
            ["it is the last pixel of its column", "it is not the last pixel of its column"],
        );
        out.number(
            Unit::Paired,
            count(column.map(|c| c.count)),
            &["the number of pixels in its column"],
        );
        let (rows, columns) = (self.shape.runs.of_rows, self.shape.runs.of_columns);
        let of = |value: i32| if rows.count == 0 { NONE } else { i64::from(value) };
        out.put(
            Unit::Paired,
            of(y.wrapping_sub(rows.first)),
            &["the number of rows from the first row of the shape"],
            ["it is in the first row of the shape", "it is not in the first row of the shape"],
        );
        out.put(
            Unit::Paired,
            of(rows.last.wrapping_sub(y)),
            &["the number of rows to the last row of the shape"],
            ["it is in the last row of the shape", "it is not in the last row of the shape"],
        );
        out.put(
            Unit::Paired,
            of(x.wrapping_sub(columns.first)),
            &["the number of columns from the first column of the shape"],
            [
                "it is in the first column of the shape",
                "it is not in the first column of the shape",
            ],
        );
        out.put(
            Unit::Paired,
            of(columns.last.wrapping_sub(x)),
            &["the number of columns to the last column of the shape"],
            ["it is in the last column of the shape", "it is not in the last column of the shape"],
        );
        let first = rows.first.min(y);
        let empty = (first..y).filter(|y| self.shape.runs.row(*y).is_none()).count() as i64;
        out.number(
            Unit::Count,
            empty,
            &["the number of empty rows between the first row of the shape and its row"],
        );
        out.number(Unit::Paired, i64::from(rows.count), &["the number of rows of the shape"]);
        out.number(Unit::Paired, i64::from(columns.count), &["the number of columns of the shape"]);
        // A loop by groups of pixels ends early where the row is no whole number of groups.
        for (of, word) in [(2, "2"), (4, "4"), (8, "8"), (16, "16")] {
            let length = count(row.map(|r| r.count / of * of));
            out.number(
                Unit::Paired,
                length,
                &["the number of pixels in its row, rounded down to a multiple of ", word],
            );
        }
    }

    fn neighbours(&self, [x, y]: [i32; 2], out: &mut Quantities) {
        let beside = [
            (
                [-1, 0],
                "left",
                "its left neighbour is not drawn",
                "its left neighbour is not in the shape, in the window or not",
            ),
            (
                [1, 0],
                "right",
                "its right neighbour is not drawn",
                "its right neighbour is not in the shape, in the window or not",
            ),
            (
                [0, -1],
                "upper",
                "its upper neighbour is not drawn",
                "its upper neighbour is not in the shape, in the window or not",
            ),
            (
                [0, 1],
                "lower",
                "its lower neighbour is not drawn",
                "its lower neighbour is not in the shape, in the window or not",
            ),
        ];
        let mut shown = 0;
        for ([dx, dy], word, no, not_whole) in beside {
            let at = [x + dx, y + dy];
            shown += i64::from(self.is_shown(at));
            out.flag(self.is_shown(at), &["its ", word, " neighbour is drawn"], no);
            out.flag(
                self.drawn.has(at),
                &["its ", word, " neighbour is in the shape, in the window or not"],
                not_whole,
            );
        }
        out.number(Unit::Count, shown, &["the number of its four neighbours that are drawn"]);
    }

    /// Its place among squares of pixels.
    fn tiles(&self, [x, y]: [i32; 2], out: &mut Quantities) {
        for (side, word) in [(2, "2"), (4, "4"), (8, "8"), (16, "16")] {
            let [left, top] = [x, y].map(|v| v.div_euclid(side) * side);
            let [right, below] =
                [(0, left), (1, top)].map(|(axis, start)| start + side - self.drawn.side[axis]);
            out.number(
                Unit::Involved,
                i64::from(right),
                &[
                    "the number of columns of its ",
                    word,
                    " px tile beyond the right side of the window",
                ],
            );
            out.number(
                Unit::Involved,
                i64::from(below),
                &["the number of rows of its ", word, " px tile beyond the bottom of the window"],
            );
            // A program that has room for so many tiles loses the later ones.
            if side > 4 {
                let tiles = [0, 1].map(|axis| self.tiles_of_box(axis, side));
                let [column, row] =
                    [0, 1].map(|i| i64::from([x, y][i].div_euclid(side)) - tiles[i][0]);
                let number = row * tiles[0][1] + column;
                let noun = ["the number of ", word, " px tiles of its box before its own"];
                out.number(Unit::Involved, number, &noun);
            }
            if side <= 4 {
                let places = (0..side * side).map(|i| [left + i % side, top + i / side]);
                let filled = places.filter(|at| self.is_shown(*at)).count();
                out.number(
                    Unit::Involved,
                    filled as i64,
                    &["the number of pixels drawn in its ", word, " px tile"],
                );
            }
            // Who decides tiles at once often looks at their corners.
            if side > 2 && !self.question.is_line() {
                let [right, below] = [left, top].map(|start| start + side - 1);
                let corners = [[left, top], [right, top], [left, below], [right, below]];
                let covered = corners.iter().filter(|at| self.is_covered(**at)).count();
                let noun =
                    ["the number of corner pixels of its ", word, " px tile that are covered"];
                out.number(Unit::Involved, covered as i64, &noun);
            }
        }
    }

    /// The first tile of the box of the points in the window, and how many tiles it has along an axis.
    fn tiles_of_box(&self, axis: usize, side: i32) -> [i64; 2] {
        let q = self.question;
        let last = i64::from(q.side[axis]) - 1;
        let tiles = q.range(axis).map(|v| v.div_euclid(q.one()).clamp(0, last) / i64::from(side));
        [tiles[0], tiles[1] + 1 - tiles[0]]
    }

    /// Its place along a line and its distance from it.
    fn along_the_line(&self, at: [i64; 2], out: &mut Quantities) {
        let q = self.question;
        let [dx, dy] = q.side_of(0, 1);
        let axis = usize::from(dy.abs() > dx.abs());
        let [from, to] = [q.points[0], q.points[1]];
        out.put(
            Unit::Paired,
            (at[axis] - from[axis]).abs(),
            &["the number of steps from the first end"],
            ["it is the first end", "it is not the first end"],
        );
        out.put(
            Unit::Paired,
            (to[axis] - at[axis]).abs(),
            &["the number of steps to the last end"],
            ["it is the last end", "it is not the last end"],
        );
        out.number(
            Unit::Paired,
            (at[1 - axis] - from[1 - axis]).abs(),
            &["the number of side steps from the first end"],
        );
        out.number(
            Unit::Paired,
            (to[1 - axis] - at[1 - axis]).abs(),
            &["the number of side steps to the last end"],
        );
        let ways = [from, to].map(|end| (at[axis] - end[axis]).abs());
        out.number(
            Unit::Count,
            (ways[0] - ways[1]).abs(),
            &["twice the number of steps from the middle of the line"],
        );
        let off = (at[1] - from[1]) * dx - (at[0] - from[0]) * dy;
        let du = dx.abs().max(dy.abs());
        let is_tie = du > 0 && 2 * off.abs() == du;
        out.flag(
            is_tie,
            &["it is exactly half a pixel off the line"],
            "it is not exactly half a pixel off the line",
        );
        out.number(
            Unit::Ratio,
            if du == 0 { 0 } else { off.abs().saturating_mul(RATIO) / du },
            &["its distance from the line in px"],
        );
        out.number(
            Unit::Count,
            off.signum(),
            &["the side of the line that it lies on, -1, 0 or 1,"],
        );
    }

    /// Its place among the edges and corners of a triangle.
    fn by_edges(&self, [x, y]: [i64; 2], out: &mut Quantities) {
        let q = self.question;
        let at = [x * 256 + self.sample[0], y * 256 + self.sample[1]];
        let edge = |e: &Edge| e.by[0] * (at[1] - e.from[1]) - e.by[1] * (at[0] - e.from[0]);
        let all: Vec<i64> = self.edges.iter().map(edge).collect();
        let is_inside = !all.is_empty() && all.iter().all(|e| *e >= 0);
        let on = |i: usize| is_inside && all[i] == 0;
        let is_on = (0..all.len()).any(on);
        out.flag(
            is_on,
            &["its sample is exactly on an edge"],
            "its sample is not exactly on an edge",
        );
        let faces: [(&str, &str, Facing); 4] = [
            ("a left", "its sample is not exactly on a left edge", |by| by[1] < 0),
            ("a right", "its sample is not exactly on a right edge", |by| by[1] > 0),
            ("a level top", "its sample is not exactly on a level top edge", |by| {
                by[1] == 0 && by[0] > 0
            }),
            ("a level bottom", "its sample is not exactly on a level bottom edge", |by| {
                by[1] == 0 && by[0] < 0
            }),
        ];
        for (word, no, is_one) in faces {
            let on_one = (0..all.len()).any(|i| on(i) && is_one(self.edges[i].by));
            out.flag(on_one, &["its sample is exactly on ", word, " edge"], no);
        }
        for (i, ordinal) in ORDINALS.iter().enumerate() {
            let no = [
                "its sample is not exactly on the first edge",
                "its sample is not exactly on the second edge",
                "its sample is not exactly on the third edge",
            ][i];
            out.flag(
                i < all.len() && on(i),
                &["its sample is exactly on the ", ordinal, " edge"],
                no,
            );
        }
        let distances = self.edges.iter().zip(&all).map(|(edge, e)| e.div_euclid(edge.length));
        let nearest = distances.enumerate().min_by_key(|(_, d)| *d);
        out.number(
            Unit::Subpixels,
            nearest.map_or(NONE, |(_, d)| d),
            &["its distance from the nearest edge (below 0 outside)"],
        );
        out.number(
            Unit::Count,
            nearest.map_or(NONE, |(i, _)| i as i64 + 1),
            &["the number of its nearest edge"],
        );
        let order = q.by_height();
        for (corner, word) in order.into_iter().zip(["top", "middle", "bottom"]) {
            let [cx, cy] = q.points[corner];
            let zero = match word {
                "top" => "it is in the row that holds the top corner",
                "middle" => "it is in the row that holds the middle corner",
                _ => "it is in the row that holds the bottom corner",
            };
            out.put(
                Unit::Count,
                y - cy.div_euclid(256),
                &["the number of rows from the row that holds the ", word, " corner"],
                [zero, ""],
            );
            out.number(
                Unit::Count,
                x - cx.div_euclid(256),
                &["the number of columns from the column that holds the ", word, " corner"],
            );
        }
        // A loop by groups of pixels over the box of the corners may end with the last whole one.
        let [least, most] = q.range(0);
        let after = |v: i64| first_sample(v, self.sample[0]);
        let boxes = [
            ([least.div_euclid(256), most.div_euclid(256) + 1], "its box"),
            ([after(least), after(most)], "the samples in its box"),
        ];
        for ([first, end], of_box) in boxes {
            let first = first.max(0);
            let columns = end.min(q.side[0].into()) - first;
            for (of, word) in [(2, "2"), (4, "4"), (8, "8"), (16, "16")] {
                let noun = [
                    "the number of columns after the last whole group of ",
                    word,
                    " columns of ",
                    of_box,
                ];
                out.number(Unit::Involved, x - first - columns.div_euclid(of) * of, &noun);
            }
        }
        let start = first_sample(q.points[order[1]][1], self.sample[1]);
        out.put(
            Unit::Count,
            y - start,
            &["the number of rows from the first row below the middle corner"],
            ["it is in the first row below the middle corner", ""],
        );
    }
}

/// Where two edges cross the line of samples of a row, or of a column with the axes exchanged: the whole shape, in the
/// window or not.
struct Crossings {
    /// The first pixel and the last one between them.
    ends: [i64; 2],
    /// The edge at each end.
    edges: [usize; 2],
    /// From the crossing to the sample that follows it, in subpixels, rounded up.
    ahead: [i64; 2],
}

impl Crossings {
    /// From one crossing to the other, in subpixels: less than two too small.
    fn length(&self) -> i64 {
        256 * (self.ends[1] + 1 - self.ends[0]) - self.ahead[1] + self.ahead[0]
    }
}

impl Scene<'_> {
    /// The same, each computed once.
    fn crossed(&self, axis: usize, place: i64) -> Option<&Crossings> {
        let margin = i64::from(MARGIN);
        let all = self.shape.crossings[axis].get_or_init(|| {
            let places = -margin..i64::from(self.drawn.side[axis]) + margin;
            places.map(|place| self.crossings(axis, place)).collect()
        });
        all.get(usize::try_from(place + margin).ok()?)?.as_ref()
    }

    /// Whether a triangle covers a pixel, in the window or not.
    fn is_covered(&self, [x, y]: [i32; 2]) -> bool {
        let (row, known) = (i64::from(y), -MARGIN..self.drawn.side[1] + MARGIN);
        let is_between = |c: &Crossings| (c.ends[0]..=c.ends[1]).contains(&i64::from(x));
        match known.contains(&y) {
            true => self.crossed(1, row).is_some_and(is_between),
            false => self.crossings(1, row).as_ref().is_some_and(is_between),
        }
    }

    /// The crossings of a row, axis 1, or of a column, axis 0.
    fn crossings(&self, axis: usize, place: i64) -> Option<Crossings> {
        let (along, sample) = (1 - axis, self.sample[1 - axis]);
        let at = place * 256 + self.sample[axis];
        let mut found: Vec<(i64, i64, usize)> = Vec::new();
        for (number, [a, b]) in EDGES.iter().enumerate() {
            let (from, to) = (self.question.points[*a], self.question.points[*b]);
            if (from[axis] <= at) == (to[axis] <= at) {
                continue;
            }
            let by = i128::from(to[axis] - from[axis]);
            let run = i128::from(to[along] - from[along]) * i128::from(at - from[axis]);
            // The crossing times `by`, and the first sample at or after it.
            let crossing = i128::from(from[along] - sample) * by + run;
            let (crossing, by) = if by < 0 { (-crossing, -by) } else { (crossing, by) };
            let first = -(-crossing).div_euclid(256 * by) as i64;
            let ahead = (i128::from(first) * 256 * by - crossing).div_euclid(by);
            found.push((first, ahead as i64, number));
        }
        // Of two that are followed by the same sample, the one farther from it comes first.
        found.sort_by_key(|(first, ahead, _)| (*first, -ahead));
        let [left, right] = found[..] else { return None };
        Some(Crossings {
            ends: [left.0, right.0 - 1],
            edges: [left.2, right.2],
            ahead: [left.1, right.1],
        })
    }

    /// Its place between the edges that cross its row, axis 1, or its column, axis 0, in the window or not, and what these
    /// edges are.
    fn by_crossings(&self, axis: usize, at: [i64; 2], out: &mut Quantities) {
        const WHOLE: &str = "(also beyond the window)";
        let q = self.question;
        let order = q.by_height();
        let [line, unit, before, after] = match axis {
            1 => ["row", "column", "left", "right"],
            _ => ["column", "row", "upper", "lower"],
        };
        let along = at[1 - axis];
        let crossed = self.crossed(axis, at[axis]);
        let of = |value: &dyn Fn(&Crossings) -> i64| crossed.map_or(NONE, value);
        for (end, word) in [before, after].into_iter().enumerate() {
            let nth = ["first", "last"][end];
            let way = ["from", "to"][end];
            out.named(Unit::Count, of(&|c| (along - c.ends[end]) * [1, -1][end]), || {
                let zero = format!("it is the {nth} pixel of its whole {line} {WHOLE}");
                let noun = format!("{unit}s {way} the {nth} pixel of its whole {line} {WHOLE}");
                (format!("the number of {noun}"), zero)
            });
            out.named(Unit::Count, of(&|c| c.ends[end]), || {
                let noun = format!("{unit} of the {nth} pixel of its whole {line} {WHOLE}");
                (format!("the {noun}"), String::new())
            });
            // The edge there.
            let edge = || format!("the edge at the {word} end of its {line}");
            let is_long = |c: &Crossings| {
                let [a, b] = EDGES[c.edges[end]];
                i64::from(a != order[1] && b != order[1])
            };
            out.named(Unit::Flag, of(&is_long), || {
                let [is, is_not] = ["", " not"]
                    .map(|not| format!("{} does{not} join the top and the bottom corner", edge()));
                (is.replace("does join", "joins"), is_not)
            });
            out.named(Unit::Count, of(&|c| c.edges[end] as i64 + 1), || {
                (format!("the number of {}", edge()), String::new())
            });
            let vector = |c: &Crossings| q.side_of(EDGES[c.edges[end]][0], EDGES[c.edges[end]][1]);
            for way in [0, 1] {
                out.named(Unit::Subpixels, of(&|c| vector(c)[way]), || {
                    let noun = format!("d{} of {} in the order given", AXES[way], edge());
                    (noun, String::new())
                });
            }
            let slope = |c: &Crossings| {
                let v = vector(c);
                v[1 - axis].saturating_mul(RATIO) / v[axis]
            };
            out.named(Unit::Ratio, of(&slope), || {
                let [over, under] = [AXES[1 - axis], AXES[axis]];
                (format!("d{over}/d{under} of {}", edge()), String::new())
            });
            out.named(Unit::Subpixels, of(&|c| c.ahead[end]), || {
                (format!("the distance from {} to the next sample", edge()), String::new())
            });
        }
        out.named(Unit::Count, of(&|c| c.ends[1] - c.ends[0] + 1), || {
            (format!("the number of pixels of its whole {line} {WHOLE}"), String::new())
        });
        out.named(Unit::Length, of(&Crossings::length), || {
            (format!("the length of its {line} from edge to edge"), String::new())
        });
        let [first, after] = q.range(axis).map(|v| first_sample(v, self.sample[axis]));
        for (value, way, nth) in
            [(at[axis] - first, "from", "first"), (after - 1 - at[axis], "to", "last")]
        {
            out.named(Unit::Count, value, || {
                let zero = format!("it is in the {nth} {line} of the whole shape {WHOLE}");
                let noun = format!("{line}s {way} the {nth} {line} of the whole shape {WHOLE}");
                (format!("the number of {noun}"), zero)
            });
        }
    }

    /// Its place in the pixels of a line that lie straight one behind another, as drawn from the first end to the second.
    fn along_its_run(&self, [x, y]: [i32; 2], out: &mut Quantities) {
        let [dx, dy] = self.question.side_of(0, 1);
        let step = |v: i64| v.signum() as i32;
        let axis = usize::from(dy.abs() > dx.abs());
        let mut ahead = [0, 0];
        ahead[axis] = [step(dx), step(dy)][axis];
        let aside = [step(dx) - ahead[0], step(dy) - ahead[1]];
        let places: [([i32; 2], &str, &str); 6] = [
            (
                ahead,
                "the pixel straight after it is drawn",
                "the pixel straight after it is not drawn",
            ),
            (
                ahead.map(|v| -v),
                "the pixel straight before it is drawn",
                "the pixel straight before it is not drawn",
            ),
            (
                [step(dx), step(dy)],
                "the pixel diagonally after it is drawn",
                "the pixel diagonally after it is not drawn",
            ),
            (
                [-step(dx), -step(dy)],
                "the pixel diagonally before it is drawn",
                "the pixel diagonally before it is not drawn",
            ),
            (
                aside,
                "the pixel beside it, on the side that the line goes to, is drawn",
                "the pixel beside it, on the side that the line goes to, is not drawn",
            ),
            (
                aside.map(|v| -v),
                "the pixel beside it, on the side that the line comes from, is drawn",
                "the pixel beside it, on the side that the line comes from, is not drawn",
            ),
        ];
        for ([right, down], yes, no) in places {
            let is_drawn = [right, down] != [0, 0] && self.drawn.has([x + right, y + down]);
            out.flag(is_drawn, &[yes], no);
        }
    }
}

/// The length of a vector, rounded down.
fn length([dx, dy]: [i64; 2]) -> i64 {
    // Below 2^32 a side, so that the root of an f64 is off by less than one.
    ((dx as f64).powi(2) + (dy as f64).powi(2)).sqrt() as i64
}
