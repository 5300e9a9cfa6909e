//! Facts of a question, and a covering design over them: which questions are asked, so that none is left out because nobody
//! thought of it.
//!
//! A *quantity* is a whole number that a question has: the width of its window, the length of an edge, how far a corner lies to
//! the left of the window. A *test* sorts its values into a few *classes*. A quantity with a test is a *fact*. A mistake of a
//! rasterizer shows only under certain facts, often under two or three of them together: long edges in a narrow window, many
//! triangles in one block of pixels. A *covering design* of strength two therefore contains every pair of classes of two facts
//! that can occur ([`design`]). This is combinatorial testing, as with the covering arrays of the greedy generators AETG and IPOG;
//! here a question is drawn and measured, since its facts depend on each other and cannot be chosen freely.

pub mod area;
pub mod asked;
pub mod depth;
pub mod design;
pub mod lines;
pub mod meshes;
pub mod near;
pub mod sample_values;
pub mod samples;
mod table;
pub mod triangles;
pub mod values;
pub mod wide;

use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;

use crate::cases::{Case, Limits};

/// What a number of a quantity counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Steps of the lattice, 1/256 px.
    Subpixels,
    /// Half square steps of the lattice: of twice an area.
    HalfSquareSubpixels,
    /// Pixels.
    Pixels,
    /// Things, or a plain number.
    Count,
    /// Powers of two of a ratio.
    Doublings,
}

/// How the values of a quantity are sorted into classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// Below zero, zero, above zero.
    Sign,
    /// Between these limits, in ascending order; a limit belongs to the class above it.
    Steps(&'static [i64]),
    /// By the powers of two that divide it, up to 16.
    Divisor,
    /// The value is the number of a word.
    Choice(&'static [&'static str]),
}

impl Test {
    /// How many classes there are.
    #[must_use]
    pub fn count(self) -> usize {
        match self {
            Self::Sign => 3,
            Self::Steps(limits) => limits.len() + 1,
            Self::Divisor => 5,
            Self::Choice(words) => words.len(),
        }
    }

    /// The class of a value.
    #[must_use]
    pub fn class(self, value: i64) -> usize {
        match self {
            Self::Sign => (value.signum() + 1) as usize,
            Self::Steps(limits) => {
                let mut class = 0;
                while class < limits.len() && value >= limits[class] {
                    class += 1;
                }
                class
            }
            Self::Divisor => value.trailing_zeros().min(4) as usize,
            Self::Choice(words) => (value as usize).min(words.len() - 1),
        }
    }

    /// A class in words.
    #[must_use]
    pub fn words(self, unit: Unit, class: usize) -> String {
        match self {
            Self::Sign => ["below 0", "0", "above 0"][class].to_owned(),
            Self::Divisor => [
                "odd",
                "twice an odd number",
                "a multiple of 4",
                "a multiple of 8",
                "a multiple of 16",
            ][class]
                .to_owned(),
            Self::Choice(words) => words[class].to_owned(),
            Self::Steps(limits) => {
                match (class.checked_sub(1).map(|i| limits[i]), limits.get(class)) {
                    (None, limit) => format!("less than {}", shown(unit, *limit.unwrap_or(&0))),
                    (Some(limit), None) => format!("{} or more", shown(unit, limit)),
                    (Some(limit), Some(end)) if unit == Unit::Count && limit + 1 == *end => {
                        limit.to_string()
                    }
                    (Some(limit), Some(end)) if unit == Unit::Pixels && limit + 1 == *end => {
                        format!("{limit} px")
                    }
                    (Some(limit), Some(end)) => {
                        format!("{} to less than {}", shown(unit, limit), shown(unit, *end))
                    }
                }
            }
        }
    }
}

/// A value with its unit.
fn shown(unit: Unit, value: i64) -> String {
    match unit {
        Unit::Count => value.to_string(),
        Unit::Pixels => format!("{value} px"),
        Unit::Subpixels if value % 256 != 0 => format!("{value}/256 px"),
        Unit::Subpixels => format!("{} px", value / 256),
        Unit::HalfSquareSubpixels if value % (1 << 17) != 0 => format!("{}/2^17 square px", value),
        Unit::HalfSquareSubpixels => format!("{} square px", value >> 17),
        Unit::Doublings if value < 0 => format!("1/{}", 1_i64 << -value),
        Unit::Doublings => (1_i64 << value).to_string(),
    }
}

/// A fact of a question in words: a whole number that the question has, and how its values are sorted into classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fact {
    /// The name of the number, as the subject of a sentence.
    pub name: &'static str,
    /// What it counts.
    pub unit: Unit,
    /// How it is tested.
    pub test: Test,
}

impl Fact {
    /// Each class in words.
    #[must_use]
    pub fn classes(&self) -> Vec<String> {
        (0..self.test.count()).map(|class| self.test.words(self.unit, class)).collect()
    }
}

/// A fact with the number, read off what was measured of a question.
pub(crate) struct Read<M> {
    fact: Fact,
    of: fn(&M) -> i64,
}

impl<M> Clone for Read<M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for Read<M> {}

/// Shorthand of the tables of facts.
pub(crate) const fn fact<M>(
    name: &'static str,
    unit: Unit,
    of: fn(&M) -> i64,
    test: Test,
) -> Read<M> {
    Read { fact: Fact { name, unit, test }, of }
}

/// The facts of a table without what reads them.
pub(crate) const fn facts_of<M, const N: usize>(table: &[Read<M>; N]) -> [Fact; N] {
    let mut facts = [table[0].fact; N];
    let mut at = 1;
    while at < N {
        facts[at] = table[at].fact;
        at += 1;
    }
    facts
}

/// A table and another one behind it.
pub(crate) const fn joined<M, const A: usize, const B: usize, const N: usize>(
    first: [Read<M>; A],
    second: [Read<M>; B],
) -> [Read<M>; N] {
    let mut all = [first[0]; N];
    let mut at = 0;
    while at < N {
        all[at] = if at < A { first[at] } else { second[at - A] };
        at += 1;
    }
    all
}

/// The numbers of a table, read off what was measured.
pub(crate) fn numbers<M>(table: &[Read<M>], measured: &M) -> Vec<i64> {
    table.iter().map(|read| (read.of)(measured)).collect()
}

/// A kind of question: what can be measured of it, and how such questions are drawn. Most are cases, put within the limits
/// of a rasterizer.
pub struct Topic<Q: 'static = Case, L: 'static = Limits> {
    /// Its name: that of the family whose questions the design chooses.
    pub name: &'static str,
    /// Its facts.
    pub facts: &'static [Fact],
    pub(crate) measure: fn(&Q, &L) -> Option<Vec<i64>>,
    /// The pairs of classes that cannot occur: on each line the number of a class, and those of others.
    pub(crate) impossible: &'static str,
    /// Draws a question.
    pub(crate) draw: fn(&mut Rng) -> Q,
    /// A question beside the first one, that may take something of the second.
    pub(crate) vary: fn(&mut Rng, &Q, &Q) -> Q,
    /// Puts a question within the limits.
    pub(crate) put: fn(&L, Q) -> Q,
}

impl<Q, L> Clone for Topic<Q, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<Q, L> Copy for Topic<Q, L> {}

impl<Q, L> Topic<Q, L> {
    /// The number of the first class of each fact: all classes are numbered one after the other.
    #[must_use]
    pub fn starts(&self) -> Vec<usize> {
        let mut starts = Vec::new();
        let mut next = 0;
        for fact in self.facts {
            starts.push(next);
            next += fact.test.count();
        }
        starts
    }

    /// For each class the number of its fact.
    #[must_use]
    pub fn facts_of_classes(&self) -> Vec<usize> {
        let mut facts = Vec::new();
        for (number, fact) in self.facts.iter().enumerate() {
            facts.extend(std::iter::repeat_n(number, fact.test.count()));
        }
        facts
    }

    /// How many classes there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.facts.iter().map(|fact| fact.test.count()).sum()
    }

    /// How many cases a program is asked for each one of a family without a design: so many that nearly all triples of classes are
    /// among them, which takes more where there are many classes.
    #[must_use]
    pub fn times(&self) -> u64 {
        if self.count() > 100 { 4 } else { 2 }
    }

    /// The number of each fact of a question, within limits; nothing where the question is of another kind.
    #[must_use]
    pub fn numbers(&self, case: &Q, limits: &L) -> Option<Vec<i64>> {
        (self.measure)(case, limits)
    }

    /// The class of each of these numbers. Those of all facts are numbered one after the other.
    #[must_use]
    pub fn classes(&self, case: &Q, limits: &L) -> Option<Vec<u16>> {
        let mut start = 0;
        let mut classes = Vec::with_capacity(self.facts.len());
        for (fact, number) in self.facts.iter().zip(self.numbers(case, limits)?) {
            classes.push((start + fact.test.class(number)) as u16);
            start += fact.test.count();
        }
        Some(classes)
    }

    /// A case at random.
    #[must_use]
    pub fn any(&self, rng: &mut Rng) -> Q {
        (self.draw)(rng)
    }

    /// A case beside the first one, that may take something of the second.
    #[must_use]
    pub fn beside(&self, rng: &mut Rng, one: &Q, other: &Q) -> Q {
        (self.vary)(rng, one, other)
    }

    /// A class with the name of its fact.
    #[must_use]
    pub fn class_words(&self, class: u16) -> String {
        let mut rest = usize::from(class);
        for fact in self.facts {
            let count = fact.test.count();
            if rest < count {
                return format!("{}: {}", fact.name, fact.test.words(fact.unit, rest));
            }
            rest -= count;
        }
        String::new()
    }
}

/// Every kind of question about triangles and lines. Polygons have [`crate::partition::design::TOPIC`].
pub const TOPICS: [Topic; 10] = [
    triangles::TOPIC,
    values::TOPIC,
    lines::TOPIC,
    samples::TOPIC,
    sample_values::TOPIC,
    meshes::TOPIC,
    depth::TOPIC,
    near::TOPIC,
    wide::TOPIC,
    area::TOPIC,
];

/// Whether none (0), some (1) or all (2) of so many.
pub(crate) fn share(count: usize, of: usize) -> i64 {
    match count {
        0 => 0,
        count if count == of => 2,
        _ => 1,
    }
}

/// A side of a window in pixels: mostly small, since every pixel of it is compared; each class of size and divisor occurs.
fn draw_side(rng: &mut Rng) -> i32 {
    match rng.int(0, 9) {
        0 => 1,
        1 => 2,
        2 | 3 => rng.coordinate(3, 8),
        4 | 5 => rng.coordinate(9, 33),
        6 => 8 * rng.coordinate(1, 6),
        7 => 16 * rng.coordinate(1, 3),
        8 => rng.coordinate(34, 64),
        _ => rng.coordinate(65, 80),
    }
}

/// A window at the origin. One in a few is wider or higher than the words of eight bits hold, seldom both.
fn draw_window(rng: &mut Rng) -> PixelRect {
    let (mut width, mut height) = (draw_side(rng), draw_side(rng));
    let long = |rng: &mut Rng| rng.coordinate(257, 320);
    match rng.int(0, 47) {
        0 => (width, height) = (long(rng), long(rng)),
        1 | 2 => (width, height) = (long(rng), rng.coordinate(1, 8)),
        3 | 4 => (width, height) = (rng.coordinate(1, 8), long(rng)),
        _ => {}
    }
    PixelRect::window(width as u32, height as u32)
}

/// The ways to change a window, counted from 0.
const WINDOW_WAYS: i64 = 4;

/// Changes a window in one of these ways: drawn anew, a side of another one, a side a little longer or shorter.
fn vary_window(rng: &mut Rng, window: &mut PixelRect, other: PixelRect, way: i64, axis: usize) {
    match (way, axis) {
        (0, _) => *window = draw_window(rng),
        (1, _) => window.x1 = other.x1,
        (2, _) => window.y1 = other.y1,
        (_, 0) => window.x1 = (window.x1 + rng.coordinate(-2, 2)).max(1),
        _ => window.y1 = (window.y1 + rng.coordinate(-2, 2)).max(1),
    }
}

/// The coordinate nearest to a number.
fn saturated(v: i64) -> i32 {
    v.clamp(i32::MIN.into(), i32::MAX.into()) as i32
}

/// The power of two of the first digit of a number that is not tiny, from its bits: the same on every machine.
pub(crate) fn exponent(v: f64) -> i32 {
    (v.to_bits() >> 52 & 0x7ff) as i32 - 1023
}
