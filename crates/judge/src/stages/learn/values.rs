//! Values of pixels: depth and both attributes, each on its own.
//!
//! A change is a recipe of [`values`], or a *relation*: the value is a number times a term, which may be added to the right
//! value. Terms are what a program has at hand in a pixel; the number is read off the answers.

use std::fmt;
use std::rc::Rc;

use super::learnable::{Learnable, LearnedCase};
use crate::ask::{Answer, Asked};
use crate::declared::Declared;
use crate::expected::value_bounds;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::facts::{self, Topic};
use rasterproof_verify::cases::{Case, Triangle};
use rasterproof_verify::learn::rows::{NONE, Quantities, TriangleInWindow, Unit, value};
use rasterproof_verify::learn::trial::Work;
use rasterproof_verify::mistakes::values::{self, ValueHypothesis, sum, weights};

/// Depth and both attributes of each pixel.
pub struct Values;

/// A triangle with what is the same in all of its pixels.
struct TriangleOfValues<'a> {
    triangle: &'a Triangle,
    /// The values of the corners: depths and both attributes.
    corners: [[f64; 3]; 3],
    /// Where samples lie in their pixel, in pixels.
    sample: [f64; 2],
    /// How many columns and rows the window has, at which rows of pixels are cut.
    window: [i32; 2],
    facts: TriangleInWindow,
}

/// A value of a pixel.
pub struct ValueOfPixel<'a> {
    of: Rc<TriangleOfValues<'a>>,
    /// The column and the row.
    at: [i32; 2],
    /// 0 is depth, 1 and 2 are the attributes.
    which: usize,
    /// The value that was answered.
    given: f64,
    /// All three right values, since one may be given in place of another.
    right: [f64; 3],
    /// How far the value may be off.
    allowed: f64,
}

/// What a program has at hand in a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Term {
    /// A number alone.
    One,
    /// The exact value of the pixel.
    Right,
    /// Another one of the three values.
    Other(usize),
    /// Depth corrected for perspective; an attribute that is not.
    Uncorrected,
    /// The value of a corner by its place in the request.
    Corner(usize),
    /// The least value of the corners.
    Least,
    /// The greatest value of the corners.
    Most,
    /// The mean of the values of the corners.
    Mean,
    /// How the value changes to the next pixel along x or y.
    Slope(usize),
    /// The same for each pixel from the left side of the window, or from the top.
    SlopeFromSide(usize),
    /// w at the pixel.
    W,
    /// 1 / w at the pixel.
    InverseW,
    /// The right value times w.
    TimesW,
    /// The right value divided by w.
    OverW,
    /// The right value times itself.
    Squared,
    /// The place of the sample, in pixels.
    Place(usize),
    /// The right value, whose weights were divided by twice the area in a word that is too short.
    OverArea(AreaWord),
    /// The right value at another place.
    At(Place),
    /// Straight between the right values at both ends of a stretch.
    Straight(Stretch),
}

/// Another place whose value a pixel may get.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// As far left of it, or above it, as its row or its column is cut at the window.
    Uncut(usize),
    /// The first or the last pixel of its row or column, in the window or not.
    End(usize, bool),
    /// The first pixel of its block, along x, y or both: so many pixels.
    Block([bool; 2], i32),
    /// Where steps from a corner lead that are counted otherwise: one of [`STEPS`].
    FromCorner(usize, usize),
}

/// Other steps along x and y than those from a corner to the sample, by those, and what is then added up.
const STEPS: [([[f64; 2]; 2], &str); 7] = [
    ([[1.0, 1.0], [0.0, 0.0]], "with the change along x in the place of that along y"),
    ([[0.0, 0.0], [1.0, 1.0]], "with the change along y in the place of that along x"),
    ([[0.0, 1.0], [1.0, 0.0]], "with both changes exchanged"),
    ([[1.0, 0.0], [0.0, -1.0]], "with the change along y reversed"),
    ([[-1.0, 0.0], [0.0, 1.0]], "with the change along x reversed"),
    ([[1.0, 0.0], [0.0, 0.0]], "without the change along y"),
    ([[0.0, 0.0], [0.0, 1.0]], "without the change along x"),
];

/// Pixels of a row between two exact values, between which values are straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// How many pixels it has.
    side: i32,
    /// Whether it is counted from the first pixel in the window, else from that of the whole row.
    is_in_window: bool,
    /// Whether the last one ends at the last pixel of the row, else it is as long as the others.
    is_cut: bool,
}

/// A word in which twice the area wraps around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaWord {
    /// How many bits the word has.
    bits: u32,
    /// Whether the greatest bit is a sign.
    is_signed: bool,
    /// Whether the fraction is cut first: square pixels instead of square subpixels.
    is_whole: bool,
}

impl AreaWord {
    /// By what the weights grow; nothing finite where the word is 0.
    fn growth(self, corners: &Corners) -> f64 {
        // The area in the unit of the word, cut to its bits and read as the word would be.
        let fraction = if self.is_whole { 2 * SUBPIXELS.trailing_zeros() } else { 0 };
        let area = twice_area(corners);
        let wrapped = (area >> fraction).rem_euclid(1 << self.bits);
        let is_negative = self.is_signed && wrapped >> (self.bits - 1) != 0;
        let word = if is_negative { wrapped - (1 << self.bits) } else { wrapped };
        area as f64 / (word << fraction) as f64
    }
}

impl fmt::Display for AreaWord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.is_signed { "" } else { " without sign" };
        let unit = if self.is_whole { "square pixels" } else { "square subpixels" };
        write!(f, "a word of {} bits{sign} that counts {unit}", self.bits)
    }
}

/// The terms that are tried with every base, those first that say least.
const TERMS: [Term; 22] = [
    Term::Right,
    Term::One,
    Term::Other(0),
    Term::Other(1),
    Term::Other(2),
    Term::Uncorrected,
    Term::Corner(0),
    Term::Corner(1),
    Term::Corner(2),
    Term::Least,
    Term::Most,
    Term::Mean,
    Term::Slope(0),
    Term::Slope(1),
    Term::SlopeFromSide(0),
    Term::SlopeFromSide(1),
    Term::W,
    Term::InverseW,
    Term::TimesW,
    Term::OverW,
    Term::Squared,
    Term::Place(0),
];

/// Terms that take the place of the right value and are added to nothing: other formats, other places and straight stretches.
fn replacements() -> Vec<Term> {
    let mut terms = Vec::new();
    // Words that are too short for twice the area.
    for bits in [16, 32] {
        for is_whole in [true, false] {
            for is_signed in [true, false] {
                terms.push(Term::OverArea(AreaWord { bits, is_signed, is_whole }));
            }
        }
    }
    terms.extend([0, 1].map(|axis| Term::At(Place::Uncut(axis))));
    // The first and the last pixel of a row or a column.
    for axis in [0, 1] {
        terms.extend([false, true].map(|is_last| Term::At(Place::End(axis, is_last))));
    }
    // Blocks whose first pixel gives the value.
    for axes in [[true, false], [false, true], [true, true]] {
        terms.extend([2, 4, 8, 16].map(|side| Term::At(Place::Block(axes, side))));
    }
    // Steps from a corner that are counted wrongly.
    for corner in [0, 1, 2] {
        terms.extend((0..STEPS.len()).map(|steps| Term::At(Place::FromCorner(corner, steps))));
    }
    // Straight stretches between exact values.
    for side in [4, 8, 16, 32] {
        for is_cut in [true, false] {
            for is_in_window in [true, false] {
                terms.push(Term::Straight(Stretch { side, is_in_window, is_cut }));
            }
        }
    }
    terms
}

/// Predictions are computed in doubles, each operation rounded by at most 2^-53 of what goes into it. Differences of corners are
/// exact within 2^16 px of each other, and so are their products. The longest way from there has 12 roundings: an edge function
/// (1), its quotient by the area (2), the product with 1/w (1), the sum of three (2), the quotient (1), the product with the
/// corner (1), the sum of three (2), and the number times that, added to the base (2). A slope has it twice. So a prediction is off by less than this
/// share of the sum of all that is added up in it.
const ROUNDING: f64 = 24.0 * f64::EPSILON / 2.0;

/// What a term is added to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Base {
    /// The term is the whole value.
    Nothing,
    /// The right value.
    Right,
    /// The right value with its other sign.
    Negated,
    /// The value interpolated the other way: see [`Term::Uncorrected`].
    Uncorrected,
}

/// What a program may do in place of interpolating a value.
#[derive(Clone)]
pub enum Change {
    /// The base, and a number times the term.
    Relation { base: Base, by: f64, term: Term },
    /// No number: not finite.
    NoNumber,
    /// One of the mistakes of the course.
    Recipe(Rc<ValueHypothesis>),
}

/// Which value a part is, as facts have it: what holds, and what does not.
const IS: [[&str; 2]; 3] = [
    [" is depth", " is not depth"],
    [" is the first attribute", " is not the first attribute"],
    [" is the second attribute", " is not the second attribute"],
];
/// The three values, in words.
const NAMES: [&str; 3] = ["depth", "the first attribute", "the second attribute"];

impl Place {
    /// What is said of a place, as the value that is taken there.
    fn words(self) -> String {
        let line = |axis: usize| ["row", "column"][axis];
        let of = match self {
            Self::Uncut(axis) => format!(
                "the pixel as far {} it as its {} is cut at the window",
                ["left of", "above"][axis],
                line(axis)
            ),
            Self::End(axis, is_last) => {
                let end = if is_last { "last" } else { "first" };
                format!("the {end} pixel of its whole {} (also beyond the window)", line(axis))
            }
            Self::Block([true, false], side) => format!("the first of its {side} columns"),
            Self::Block([false, true], side) => format!("the first of its {side} rows"),
            Self::Block(_, side) => format!("the first pixel of its block of {side} x {side} px"),
            Self::FromCorner(corner, steps) => {
                let corner = ["first", "second", "third"][corner];
                return format!("the value reached from the {corner} corner {}", STEPS[steps].1);
            }
        };
        format!("the right value of {of}")
    }
}

/// The same place in the next pixel along an axis.
fn next(mut at: [f64; 2], axis: usize) -> [f64; 2] {
    at[axis] += 1.0;
    at
}

/// A coordinate in subpixels as pixels, exactly.
fn in_px(subpixels: i32) -> f64 {
    f64::from(subpixels) / f64::from(SUBPIXELS)
}

impl TriangleOfValues<'_> {
    /// Values at a place, in pixels.
    fn values(&self, at: [f64; 2]) -> [f64; 3] {
        // Depth is linear in the window; attributes are linear in space, so that they are divided by w and back.
        let linear = weights(&self.triangle.corners(), at);
        let parts = [0, 1, 2].map(|i| linear[i] * self.triangle.vertices[i].inv_w);
        let whole: f64 = parts.iter().sum();
        let corrected = parts.map(|part| part / whole);
        [0, 1, 2].map(|k| sum(if k == 0 { linear } else { corrected }, self.corners[k]))
    }

    /// 1 / w at a place, which is linear in the window.
    fn inverse_w(&self, at: [f64; 2]) -> f64 {
        sum(weights(&self.triangle.corners(), at), self.triangle.vertices.map(|v| v.inv_w))
    }
}

impl ValueOfPixel<'_> {
    /// The sample of the pixel, in pixels.
    fn place(&self) -> [f64; 2] {
        [0, 1].map(|axis| f64::from(self.at[axis]) + self.of.sample[axis])
    }

    /// The right value of those that this part is one of.
    fn right(&self) -> f64 {
        self.right[self.which]
    }

    /// What a term comes to at the pixel.
    fn term(&self, term: Term) -> f64 {
        let corners = self.of.corners[self.which];
        let at = self.place();
        let slope = |axis: usize| self.of.values(next(at, axis))[self.which] - self.right();
        match term {
            Term::One => 1.0,
            Term::Right => self.right(),
            Term::Other(k) => self.right[k],
            Term::Uncorrected => {
                let linear = weights(&self.of.triangle.corners(), at);
                match self.which {
                    0 => {
                        let parts =
                            [0, 1, 2].map(|i| linear[i] * self.of.triangle.vertices[i].inv_w);
                        sum(parts, corners) / parts.iter().sum::<f64>()
                    }
                    _ => sum(linear, corners),
                }
            }
            Term::Corner(i) => corners[i],
            Term::Least => corners.into_iter().fold(f64::MAX, f64::min),
            Term::Most => corners.into_iter().fold(f64::MIN, f64::max),
            Term::Mean => corners.iter().sum::<f64>() / 3.0,
            Term::Slope(axis) => slope(axis),
            Term::SlopeFromSide(axis) => slope(axis) * f64::from(self.at[axis]),
            Term::W => 1.0 / self.of.inverse_w(at),
            Term::InverseW => self.of.inverse_w(at),
            Term::TimesW => self.right() / self.of.inverse_w(at),
            Term::OverW => self.right() * self.of.inverse_w(at),
            Term::Squared => self.right() * self.right(),
            Term::Place(axis) => at[axis],
            Term::OverArea(word) => self.right() * word.growth(&self.of.triangle.corners()),
            Term::At(place) => self.of.values(self.other_place(place))[self.which],
            Term::Straight(stretch) => self.straight(stretch),
        }
    }

    /// The sample of another pixel, in pixels.
    fn other_place(&self, place: Place) -> [f64; 2] {
        // Most of these places are the sample of another pixel.
        let mut at = self.at;
        match place {
            Place::Uncut(axis) => at[axis] += self.ends(axis)[0].min(0),
            Place::End(axis, is_last) => at[axis] = self.ends(axis)[usize::from(is_last)],
            Place::FromCorner(corner, steps) => {
                let corner = self.of.triangle.corners()[corner];
                let corner = [corner.x, corner.y].map(in_px);
                let here = self.place();
                let by = [here[0] - corner[0], here[1] - corner[1]];
                let [x, y] = STEPS[steps].0;
                return [
                    corner[0] + x[0] * by[0] + x[1] * by[1],
                    corner[1] + y[0] * by[0] + y[1] * by[1],
                ];
            }
            Place::Block(axes, side) => {
                for (at, _) in at.iter_mut().zip(axes).filter(|(_, is_along)| *is_along) {
                    *at -= at.rem_euclid(side);
                }
            }
        }
        [0, 1].map(|axis| f64::from(at[axis]) + self.of.sample[axis])
    }

    /// The value on the straight line between the exact ones at both ends of a stretch of the row.
    fn straight(&self, Stretch { side, is_in_window, is_cut }: Stretch) -> f64 {
        // The stretch that the pixel lies in, counted from the first pixel of the row.
        let [first, last] = self.ends(0);
        let first = if is_in_window { first.max(0) } else { first };
        let last = if is_in_window { last.min(self.of.window[0] - 1) } else { last };
        let start = self.at[0] - (self.at[0] - first).rem_euclid(side);
        let end = if is_cut { (start + side).min(last) } else { start + side };
        if end <= start {
            return self.right();
        }
        let value = |x: i32| {
            let place = [f64::from(x) + self.of.sample[0], self.place()[1]];
            self.of.values(place)[self.which]
        };
        // Between its two ends the value is straight.
        let share = f64::from(self.at[0] - start) / f64::from(end - start);
        value(start) * (1.0 - share) + value(end) * share
    }

    /// The first and the last pixel of the row (axis 0) or the column of the pixel whose samples lie in the triangle, in the window
    /// or not, as far as doubles tell.
    fn ends(&self, axis: usize) -> [i32; 2] {
        let corners = self.of.triangle.corners().map(|c| [c.x, c.y].map(in_px));
        // The line through the samples of the row crosses two edges, or passes a corner.
        let height = self.place()[1 - axis];
        let (mut least, mut most) = (f64::MAX, f64::MIN);
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (corners[a], corners[b]);
            let [from, to] = [a, b].map(|corner| corner[1 - axis] - height);
            // The edge crosses the line through the sample.
            if from * to <= 0.0 && from != to {
                let crossing = a[axis] + (b[axis] - a[axis]) * (from / (from - to));
                (least, most) = (least.min(crossing), most.max(crossing));
            }
        }
        if least > most {
            // The pixel lies in no row of the triangle.
            return [self.at[axis]; 2];
        }
        let sample = self.of.sample[axis];
        // What lies on the edge at the end belongs to the neighbour.
        [(least - sample).ceil() as i32, (most - sample).ceil() as i32 - 1]
    }

    /// What a base comes to at the pixel.
    fn base(&self, base: Base) -> f64 {
        match base {
            Base::Nothing => 0.0,
            Base::Right => self.right(),
            Base::Negated => -self.right(),
            Base::Uncorrected => self.term(Term::Uncorrected),
        }
    }

    /// What is added up in a value of the triangle at a place, without signs.
    fn size_at(&self, at: [f64; 2]) -> f64 {
        let linear = weights(&self.of.triangle.corners(), at);
        // The weights by which the corners count, as shares of their sum.
        let inverse = self.of.triangle.vertices.map(|v| v.inv_w);
        let parts = match self.which {
            0 => linear,
            _ => [0, 1, 2].map(|i| linear[i] * inverse[i]),
        };
        let whole: f64 = parts.iter().sum();
        let corners = self.of.corners[self.which];
        // Beyond the triangle what is divided by is a sum of both signs.
        let lever = parts.iter().map(|part| (part / whole).abs()).sum::<f64>();
        [0, 1, 2].map(|i| (parts[i] / whole * corners[i]).abs() * lever).into_iter().sum()
    }

    /// What is added up in a term, without signs.
    fn size(&self, term: Term) -> f64 {
        let at = self.place();
        let of_slope = |axis: usize| self.size_at(next(at, axis)) + self.size_at(at);
        match term {
            Term::Slope(axis) => of_slope(axis),
            Term::SlopeFromSide(axis) => of_slope(axis) * f64::from(self.at[axis]),
            Term::At(place) => self.size_at(self.other_place(place)),
            // Within the triangle no weight is below 0, so that it is no more than the largest corner.
            _ => self.term(term).abs().max(self.largest()),
        }
    }

    /// The largest magnitude of the value at the corners.
    fn largest(&self) -> f64 {
        self.of.corners[self.which].into_iter().fold(0.0, |most: f64, v| most.max(v.abs()))
    }

    /// Whether a predicted value is the given one, where so much is added up in it: predictions are rounded too, but what is as
    /// near to the right value explains nothing.
    fn is(&self, predicted: f64, size: f64) -> bool {
        // A prediction that is hardly nearer to the answer than the right value is no explanation.
        let off = (self.given - predicted).abs();
        let allowed = self.allowed.max(ROUNDING * size);
        off <= allowed || (off <= 10.0 * allowed && 2.0 * off <= (self.given - self.right()).abs())
    }
}

/// Fragments of one answer that are looked at.
const MOST_PIXELS: usize = 60;

impl Learnable for Values {
    type Part<'a> = ValueOfPixel<'a>;
    type Change = Change;
    const TOPIC: &'static Topic = &facts::values::TOPIC;
    const PART: &'static str = "value";

    fn of_question(case: &Case, out: &mut Quantities) {
        let Some(t) = case.triangles().first() else { return };
        TriangleInWindow::new(&t.corners(), case.window, &mut std::iter::empty()).of_question(out);
        // How far w differs decides how much perspective there is.
        let w = t.vertices.map(|v| 1.0 / v.inv_w);
        let (least, most) = w.iter().fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(*v), b.max(*v)));
        out.number(Unit::Value, value(most / least), &["the largest w over the smallest"]);
        out.number(Unit::Value, value(least), &["the smallest w"]);
        out.number(Unit::Value, value(most), &["the largest w"]);
        const ORDINALS: [&str; 3] = ["first", "second", "third"];
        // Each number of each corner, and how it differs from that of the next corner.
        let corners = t.vertices.map(|v| [1.0 / v.inv_w, v.depth, v.varying.x, v.varying.y]);
        let names = ["w", NAMES[0], NAMES[1], NAMES[2]];
        for (k, name) in names.into_iter().enumerate() {
            for (i, ordinal) in ORDINALS.iter().enumerate() {
                let next = (i + 1) % 3;
                let (v, other) = (corners[i][k], corners[next][k]);
                out.number(Unit::Value, value(v), &[name, " of the ", ordinal, " corner"]);
                let pair = [ordinal, " corner less that of the ", ORDINALS[next]];
                out.number(
                    Unit::Value,
                    value(v - other),
                    &[&[name, " of the "], &pair[..]].concat(),
                );
            }
        }
    }

    fn parts<'a>(asked: &'a LearnedCase, declared: &Declared) -> Vec<ValueOfPixel<'a>> {
        let (Asked::Values(triangle), Answer::Values(fragments)) =
            (&asked.question.of, &asked.answer)
        else {
            return Vec::new();
        };
        let window = PixelRect::window(asked.question.width, asked.question.height);
        let is_in = |x: i32, y: i32| window.contains(x, y);
        // The quantities of pixels are those of the pixels that were drawn, right or not.
        let mut covered = fragments.iter().map(|f| [f.x_px, f.y_px]).filter(|[x, y]| is_in(*x, *y));
        let facts = TriangleInWindow::new(&triangle.corners(), window, &mut covered);
        let v = &triangle.vertices;
        let corners = [v.map(|v| v.depth), v.map(|v| v.varying.x), v.map(|v| v.varying.y)];
        let sample = declared.convention.sample.map(|at| f64::from(at) / f64::from(SUBPIXELS));
        let bounds = value_bounds(triangle, declared.tolerance.max(ROUNDING));
        let of = Rc::new(TriangleOfValues {
            triangle,
            corners,
            sample,
            window: [window.x1, window.y1],
            facts,
        });
        // Of large triangles some pixels, evenly spread; each gives three parts.
        let step = fragments.len().div_ceil(MOST_PIXELS).max(1);
        let mut parts = Vec::new();
        for f in fragments.iter().step_by(step).filter(|f| is_in(f.x_px, f.y_px)) {
            let at = [f.x_px, f.y_px];
            let right = of.values([0, 1].map(|axis| f64::from(at[axis]) + sample[axis]));
            let given = [f.depth, f.varying.x, f.varying.y];
            parts.extend([0, 1, 2].map(|which| ValueOfPixel {
                of: Rc::clone(&of),
                at,
                which,
                given: given[which],
                right,
                allowed: bounds[which],
            }));
        }
        parts
    }

    fn is_right(part: &ValueOfPixel<'_>) -> bool {
        (part.given - part.right()).abs() <= part.allowed
    }

    fn explains(change: &Change, part: &ValueOfPixel<'_>) -> bool {
        match change {
            Change::Relation { base, by, term } => {
                // What overflows predicts a number that is none.
                let predicted = part.base(*base) + by * part.term(*term);
                if !predicted.is_finite() {
                    return !part.given.is_finite();
                }
                part.is(predicted, part.largest() + by.abs() * part.size(*term))
            }
            Change::NoNumber => !part.given.is_finite(),
            Change::Recipe(recipe) => {
                let predicted = recipe.predict(part.of.triangle, (part.at[0], part.at[1]));
                predicted.is_some_and(|values| part.is(values[part.which], part.largest()))
            }
        }
    }

    fn of_part(part: &ValueOfPixel<'_>, _: Option<&Change>, out: &mut Quantities) {
        part.of.facts.of_pixel(part.at, out);
        for (k, is) in IS.into_iter().enumerate() {
            out.holds(part.which == k, "the value", is);
        }
        // The right value and what it is computed from.
        let real = |term: Term| value(part.term(term));
        out.number(Unit::Value, real(Term::Right), &["the right value"]);
        out.number(Unit::Value, value(part.right().abs()), &["the right value without sign"]);
        let whole = part.right() == part.right().round() && part.right().abs() < 1e15;
        out.flag(
            whole,
            &["the right value is a whole number"],
            "the right value is no whole number",
        );
        out.number(Unit::Value, real(Term::Least), &["the least of its values at the corners"]);
        out.number(Unit::Value, real(Term::Most), &["the greatest of its values at the corners"]);
        let spread = part.term(Term::Most) - part.term(Term::Least);
        out.number(Unit::Value, value(spread), &["the difference of its values at the corners"]);
        out.number(Unit::Value, real(Term::W), &["w at the pixel"]);
        for (axis, name) in ["x", "y"].iter().enumerate() {
            out.number(
                Unit::Value,
                real(Term::Slope(axis)),
                &["its change to the next pixel along ", name],
            );
        }
        // Where in the triangle the pixel lies: its weights, the largest and the smallest of them.
        let weights = weights(&part.of.triangle.corners(), part.place());
        let (mut most, mut least) = (0, f64::MAX);
        for (i, weight) in weights.into_iter().enumerate() {
            let ordinal = ["first", "second", "third"][i];
            out.number(Unit::Value, value(weight), &["the weight of the ", ordinal, " corner"]);
            most = if weight > weights[most] { i } else { most };
            least = least.min(weight);
        }
        out.number(
            Unit::Count,
            most as i64 + 1,
            &["the number of the corner with the largest weight"],
        );
        out.number(
            Unit::Value,
            if least.is_finite() { value(least) } else { NONE },
            &["the smallest weight of a corner"],
        );
    }

    fn changes(wrong: &[&ValueOfPixel<'_>], _: &[&ValueOfPixel<'_>], _: &Work) -> Vec<Change> {
        // Every term with every base, each with the numbers that are read off the wrong values.
        let mut all = vec![Change::NoNumber];
        for base in [Base::Nothing, Base::Right, Base::Uncorrected, Base::Negated] {
            for term in TERMS {
                all.extend(related(base, term, wrong));
            }
        }
        for term in replacements() {
            all.extend(related(Base::Nothing, term, wrong));
        }
        // The recipes of the course sample at the centres of pixels.
        let is_centred = wrong.first().is_some_and(|part| {
            part.of.sample == [f64::from(HALF_PIXEL) / f64::from(SUBPIXELS); 2]
        });
        if is_centred {
            let recipes = values::of_values([[1.0, 0.0]; 3], &[]).into_iter();
            all.extend(recipes.map(|recipe| Change::Recipe(Rc::new(recipe))));
        }
        all
    }

    fn says(change: &Change) -> String {
        let (base, by, term) = match change {
            Change::NoNumber => return "gives a value that is no number".to_owned(),
            Change::Recipe(recipe) => return recipe.says.does.clone(),
            Change::Relation { base, by, term } => (*base, *by, *term),
        };
        // The term in words; a number alone has none.
        let word = match term {
            Term::One => String::new(),
            Term::Right => "the right value".to_owned(),
            Term::Other(k) => NAMES[k].to_owned(),
            Term::Uncorrected => UNCORRECTED.to_owned(),
            Term::Corner(i) => {
                format!("the value of the {} corner", ["first", "second", "third"][i])
            }
            Term::Least => "the least value of the corners".to_owned(),
            Term::Most => "the greatest value of the corners".to_owned(),
            Term::Mean => "the mean of the corners".to_owned(),
            Term::Slope(axis) => format!("the change to the next pixel along {}", ["x", "y"][axis]),
            Term::SlopeFromSide(0) => {
                "the column times the change to the next pixel along x".to_owned()
            }
            Term::SlopeFromSide(_) => {
                "the row times the change to the next pixel along y".to_owned()
            }
            Term::W => "w".to_owned(),
            Term::InverseW => "1/w".to_owned(),
            Term::TimesW => "the right value times w".to_owned(),
            Term::OverW => "the right value over w".to_owned(),
            Term::Squared => "the square of the right value".to_owned(),
            Term::Place(axis) => format!("the {} of the sample", ["x", "y"][axis]),
            Term::At(place) => place.words(),
            Term::Straight(Stretch { side, is_in_window, is_cut }) => format!(
                "what lies straight between the right values at every {side}th pixel of its row, counted from the first one{}{}",
                if is_in_window { " in the window" } else { ", in the window or not" },
                if is_cut { ", and at its last pixel" } else { "" }
            ),
            Term::OverArea(word) => {
                format!("the right value as if twice the area was kept in {word}")
            }
        };
        // The number before it, unless it is 1, and then what both are added to.
        let size = by.abs();
        let product = match (word.is_empty(), size == 1.0) {
            (true, _) => format!("{size}"),
            (_, true) => word,
            _ => format!("{size} times {word}"),
        };
        let sign = if by < 0.0 { "less" } else { "plus" };
        match base {
            Base::Nothing if by < 0.0 => format!("gives minus {product}"),
            Base::Nothing => format!("gives {product}"),
            Base::Right => format!("gives the right value {sign} {product}"),
            Base::Negated => format!("gives minus the right value {sign} {product}"),
            Base::Uncorrected => format!("gives {UNCORRECTED} {sign} {product}"),
        }
    }
}

/// How the other interpolation is said: depth is linear in the window, and attributes are not.
const UNCORRECTED: &str =
    "the value interpolated the other way (depth with perspective, attributes without)";

/// Numbers of a term that are read off at most, and values that one must explain.
const MOST_NUMBERS: usize = 2;
const LEAST_VALUES: usize = 6;
/// How well a value must tell a number.
const TELLING: f64 = 0.02;

/// The numbers with which most of some wrong values are such a term, added to something. Each value allows a range of numbers,
/// and a number is one that lies in most of the ranges.
fn related(base: Base, term: Term, wrong: &[&ValueOfPixel<'_>]) -> Vec<Change> {
    // The numbers that each value allows.
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for part in wrong {
        let (of, start) = (part.term(term), part.given - part.base(base));
        let both = [(start - part.allowed) / of, (start + part.allowed) / of];
        let range = [both[0].min(both[1]), both[0].max(both[1])];
        let is_telling = range[1] - range[0] <= TELLING * range[0].abs().max(range[1].abs());
        // A range that holds 0 tells nothing: without the term the value would be as it is.
        if range.iter().all(|v| v.is_finite()) && is_telling && range[0] * range[1] > 0.0 {
            ranges.push(range);
        }
    }
    let mut found = Vec::new();
    // The number that most values allow, then the one that most of the others do.
    while found.len() < MOST_NUMBERS && ranges.len() >= LEAST_VALUES {
        let (count, range) = densest(&ranges);
        if count < LEAST_VALUES || 10 * count < ranges.len() {
            break;
        }
        let by = values::simplest(range[0], range[1]);
        // What is added to nothing and is the right value is no change.
        if !(base == Base::Nothing && term == Term::Right && by == 1.0) {
            found.push(Change::Relation { base, by, term });
        }
        ranges.retain(|[low, high]| *high < range[0] || *low > range[1]);
    }
    found
}

/// The part of a line that most ranges share, and how many do.
fn densest(ranges: &[[f64; 2]]) -> (usize, [f64; 2]) {
    // Along the line, a range is open from its first end to its second.
    let mut ends: Vec<(f64, bool)> = Vec::new();
    for [low, high] in ranges {
        ends.extend([(*low, false), (*high, true)]);
    }
    // Where one begins as another ends, they share a point.
    ends.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let (mut open, mut best) = (0_usize, (0, [0.0; 2]));
    for (i, (at, is_end)) in ends.iter().enumerate() {
        if *is_end {
            open -= 1;
            continue;
        }
        open += 1;
        if open > best.0 {
            best = (open, [*at, ends[i + 1].0]);
        }
    }
    best
}
