//! Rules about rows of numbers, for whoever learns of other things than pictures: of values, depths, samples and polygons.
//!
//! A row holds the quantities of a question and of a part of its answer. The grammar is that of pictures: every quantity gets
//! every test, and a triangle and its pixels have the same quantities here as there.

use std::sync::Arc;

use super::picture::Picture;
use super::quantity::{self, Name, Scene, Shape};
use super::question::AnyQuestion;
use super::rule::{self, Conjunction, Table, Terms, all_hold};
use super::say;
use super::trial::Work;
use crate::cases::facts::{self, Topic};
use crate::convention::TriangleQuestion;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;

pub use super::quantity::{NONE, Quantities};
pub use super::question::Unit;

/// A number in steps of [`Unit::Value`].
#[must_use]
pub fn value(v: f64) -> i64 {
    if v.is_nan() {
        return NONE;
    }
    let steps = (v * f64::from(1 << 20)).clamp(-9e18, 9e18).floor() as i64;
    // Only 0 is 0.
    if steps == 0 && v > 0.0 { 1 } else { steps }
}

impl Quantities {
    /// More quantities after these.
    #[must_use]
    pub fn after(values: Vec<i64>) -> Self {
        Self { values, ..Self::default() }
    }

    /// Whether something holds of somebody: what is said after the name where it does, and where it does not.
    pub fn holds(&mut self, value: bool, who: &str, [yes, no]: [&str; 2]) {
        // Only those who want names pay for them.
        let no = if self.names.is_some() { [who, no].concat() } else { String::new() };
        self.flag(value, &[who, yes], &no);
    }

    /// Quantities whose names are wanted, too.
    #[must_use]
    pub fn with_names() -> Self {
        Self { names: Some(Vec::new()), ..Self::default() }
    }
}

/// What some quantities are called.
#[derive(Clone, Default)]
pub struct Vocabulary(Vec<Name>);

impl Vocabulary {
    /// The names that were wanted with some quantities.
    #[must_use]
    pub fn of(quantities: Quantities) -> Self {
        Self(quantities.names.unwrap_or_default())
    }

    /// How many quantities there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The first so many.
    #[must_use]
    pub fn first(&self, count: usize) -> Self {
        Self(self.0[..count].to_vec())
    }
}

/// Facts that all hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition(Conjunction);

impl Condition {
    /// Whether all of them hold of a row.
    #[must_use]
    pub fn holds(&self, row: &[i64]) -> bool {
        all_hold(&self.0, row)
    }

    /// What is said of them, after 'where'.
    #[must_use]
    pub fn words(&self, names: &Vocabulary) -> String {
        say::facts(&self.0, &names.0)
    }

    /// How many facts there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The same without one of them.
    #[must_use]
    pub fn without(&self, number: usize) -> Self {
        let mut less = self.0.clone();
        less.remove(number);
        Self(less)
    }

    /// The quantities that have a limit, with it.
    pub fn limits(&self) -> impl Iterator<Item = (usize, i64)> + '_ {
        self.0.iter().filter_map(|fact| fact.limit())
    }
}

/// The part of all rows that each of several conditions must hold of.
const FEWEST: usize = 12;

/// Rows that a condition should hold of, and others.
#[derive(Default)]
pub struct Examples(Table);

/// What a condition must be.
#[derive(Clone, Copy)]
pub struct ConditionTerms {
    /// The most facts.
    pub facts: usize,
    /// Questions that it must hold in.
    pub questions: usize,
    /// Other rows that it may hold of, of a thousand.
    pub slack: usize,
}

impl Examples {
    /// A row of a question that a condition should hold of.
    pub fn should(&mut self, row: Vec<i64>, question: usize) {
        self.0.yes.push(row);
        self.0.groups.push(question);
    }

    /// A row that it should not hold of.
    pub fn should_not(&mut self, row: Vec<i64>) {
        self.0.no.push(row);
    }

    /// How many rows there are of both.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        [self.0.yes.len(), self.0.no.len()]
    }

    /// Of how many rows of both a condition holds.
    #[must_use]
    pub fn held(&self, condition: &Condition) -> [usize; 2] {
        [&self.0.yes, &self.0.no].map(|rows| rows.iter().filter(|row| condition.holds(row)).count())
    }

    /// The best condition for the rows that it should hold of.
    #[must_use]
    pub fn best(
        &self,
        names: &Vocabulary,
        wanted: ConditionTerms,
        work: &Work,
    ) -> Option<Condition> {
        let ConditionTerms { facts, questions, slack } = wanted;
        let terms = Terms { most: facts, need: questions, slack, wanted: 1 };
        rule::best(&names.0, &self.0, terms, work)
            .into_iter()
            .next()
            .map(|found| Condition(found.facts))
    }

    /// Conditions of which one should hold: each is the best for the rows of which none before it does.
    #[must_use]
    pub fn any_of(
        &self,
        names: &Vocabulary,
        wanted: ConditionTerms,
        most: usize,
        work: &Work,
    ) -> Vec<Condition> {
        let mut all = Vec::new();
        let Table { yes, no, groups } = &self.0;
        let mut left = Self(Table { yes: yes.clone(), no: no.clone(), groups: groups.clone() });
        while !left.0.yes.is_empty() && all.len() < most && !work.is_done() {
            let Some(best) = left.best(names, wanted, work) else { break };
            // What needs many conditions is none.
            let is_much = |rows: usize| FEWEST * rows >= yes.len();
            if !is_much(left.held(&best)[0]) {
                break;
            }
            let is_left: Vec<bool> = left.0.yes.iter().map(|row| !best.holds(row)).collect();
            let mut marks = is_left.iter();
            left.0.yes.retain(|_| marks.next() == Some(&true));
            let mut marks = is_left.iter();
            left.0.groups.retain(|_| marks.next() == Some(&true));
            all.push(best);
        }
        all
    }
}

/// The facts of a question of some kind: numbers where they are numbers, and otherwise whether each class is the one.
pub fn of_topic(topic: &Topic, numbers: &[i64], out: &mut Quantities) {
    for (fact, &number) in topic.facts.iter().zip(numbers) {
        let is_subject = ["the ", "its ", "a "].iter().any(|start| fact.name.starts_with(start));
        let of = if is_subject { "" } else { "the number of " };
        match (fact.test, fact.unit) {
            (facts::Test::Sign | facts::Test::Choice(_), _) => {
                let class = fact.test.class(number);
                for (i, word) in fact.classes().iter().enumerate() {
                    let not = format!("{}: not {word}", fact.name);
                    out.flag(i == class, &[fact.name, ": ", word], &not);
                }
            }
            (_, facts::Unit::Doublings) => {
                let power = value(f64::from(2).powi(number.clamp(-20, 40) as i32));
                out.number(Unit::Value, power, &[of, fact.name, " (a power of two)"]);
            }
            (_, facts::Unit::Subpixels) => out.number(Unit::Subpixels, number, &[of, fact.name]),
            (_, facts::Unit::HalfSquareSubpixels) => {
                out.number(Unit::Area, number, &[of, fact.name]);
            }
            (_, facts::Unit::Pixels | facts::Unit::Count) => {
                out.number(Unit::Count, number, &[of, fact.name]);
            }
        }
    }
}

/// A triangle in its window with the pixels that it covers: the quantities of both, as in pictures.
pub struct TriangleInWindow {
    question: AnyQuestion,
    covered: Picture,
    shape: Arc<Shape>,
}

impl TriangleInWindow {
    /// The window begins at the origin.
    pub fn new(
        corners: &Corners,
        window: PixelRect,
        covered: &mut dyn Iterator<Item = [i32; 2]>,
    ) -> Self {
        let question = AnyQuestion::from(&TriangleQuestion { corners: *corners, window });
        let mut picture = Picture::new(question.side);
        covered.for_each(|at| picture.set(at, 1));
        let shape = Arc::new(Shape::of(&picture));
        Self { question, covered: picture, shape }
    }

    /// The quantities of the question.
    pub fn of_question(&self, out: &mut Quantities) {
        quantity::of_question(&self.question, out);
    }

    /// The quantities of a pixel.
    pub fn of_pixel(&self, at: [i32; 2], out: &mut Quantities) {
        let shape = Arc::clone(&self.shape);
        Scene::with_shape(&self.question, &self.covered, shape, [128; 2]).of_pixel(at, out);
    }
}
