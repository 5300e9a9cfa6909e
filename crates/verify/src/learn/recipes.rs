//! Random explanations drawn as programs: what the learner says of each, by the field that is changed.
//!
//! What cannot be found is learned here from the grammar itself, and not from programs that somebody thought of.

use super::border::Crossing;
use super::change::{self, Base, Rule};
use super::drawer::{Drawer, LearnedAnswer, Lines, Triangles};
use super::edges::EdgeTest;
use super::fill::RowRule;
use super::model::{GuardedBorder, GuardedStep, Model, Step, Vocabulary, Wrong};
use super::programs::{learn_lines, learn_triangles};
use super::quantity::{NONE, Quantities, Scene};
use super::question::{AnyQuestion, Unit};
use super::rule::{Conjunction, Fact, Of, Test, all_hold};
use super::trial::Work;
use super::walk::Walk;
use super::{Learned, SEED, say};
use crate::ask::Asker;
use crate::convention::{Declarations, LineConvention, TriangleConvention};
use rasterproof_core::random::Rng;

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Field {
    /// A changed question, always or where a fact of the question holds.
    Question,
    Guarded,
    /// Pixels with a fact, or with two.
    Pixels,
    PixelsOfTwo,
    /// A formula of borders, with one field and with two.
    Border,
    BorderOfTwo,
    Rows,
    Edges,
    Walk,
}

impl Field {
    fn all(is_line: bool) -> Vec<Self> {
        let of_one: &[Self] = if is_line { &[Self::Walk] } else { &[Self::Rows, Self::Edges] };
        let of_both = [
            Self::Question,
            Self::Guarded,
            Self::Pixels,
            Self::PixelsOfTwo,
            Self::Border,
            Self::BorderOfTwo,
        ];
        [&of_both, of_one].concat()
    }
}

/// Questions by which a recipe is held to be wrong often enough and not always the same.
const LOOKED_AT: usize = 150;

/// What recipes are made of.
struct Kitchen<'a> {
    rng: Rng,
    drawer: &'a dyn Drawer,
    vocabulary: Vocabulary,
    bases: Vec<Base>,
    answers: Vec<LearnedAnswer>,
    /// Rows of pixels of these, in the shape or beside it.
    pixels: Vec<Vec<i64>>,
}

impl<'a> Kitchen<'a> {
    fn new(drawer: &'a mut dyn Drawer, seed: u64) -> Self {
        let questions: Vec<AnyQuestion> =
            (0..LOOKED_AT).map(|_| drawer.room().question()).collect();
        let drawer = &*drawer;
        let vocabulary = Vocabulary::of(&questions[0]);
        let is_line = questions[0].is_line();
        let bases = change::all(is_line, drawer.conventions());
        let mut answers = Vec::new();
        let mut pixels = Vec::new();
        for q in questions {
            let right = drawer.right(&q, 0).unwrap();
            let a = LearnedAnswer::new(q, right.clone(), right);
            let scene = Scene::new(&a.question, &a.right, drawer.sample());
            let near = a.right.pixels().filter(|at| {
                let beside = [[0, 0], [1, 0], [0, 1], [-1, 0], [0, -1]];
                beside.iter().any(|[x, y]| a.right.has([at[0] + x, at[1] + y]))
            });
            for at in near.step_by(7) {
                let mut row = Quantities { values: a.facts.clone(), ..Quantities::default() };
                scene.of_pixel(at, &mut row);
                pixels.push(row.values);
            }
            answers.push(a);
        }
        Self { rng: Rng::new("recipes", seed, 0), drawer, vocabulary, bases, answers, pixels }
    }

    fn one_of<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.rng.int(0, all.len() as i64 - 1) as usize].clone()
    }

    /// A fact that holds of some rows and not of all, of quantities from one number to another.
    fn fact(&mut self, is_pixel: bool) -> Fact {
        let count = self.vocabulary.names.len();
        let first = if is_pixel { self.vocabulary.of_question } else { 0 };
        let end = if is_pixel { count } else { self.vocabulary.of_question };
        let rows: Vec<Vec<i64>> = match is_pixel {
            true => self.pixels.clone(),
            false => self.answers.iter().map(|a| a.facts.clone()).collect(),
        };
        loop {
            let i = self.rng.int(first as i64, end as i64 - 1) as usize;
            let value = self.one_of(&rows)[i];
            if value == NONE {
                continue;
            }
            let test = match self.vocabulary.names[i].unit {
                Unit::Flag => Test::Is(value),
                Unit::Count | Unit::Pixels | Unit::Paired => match self.rng.int(0, 3) {
                    0 => Test::Is(value),
                    1 => Test::AtMost(value),
                    2 => Test::AtLeast(value),
                    _ => {
                        let by = 1 << self.rng.int(1, 4);
                        Test::Remainder(by, value.rem_euclid(by))
                    }
                },
                _ => self.one_of(&[Test::AtMost(value), Test::AtLeast(value)]),
            };
            let fact = Fact { of: Of::One(i), test };
            let held = rows.iter().filter(|row| all_hold(&[fact], row)).count();
            if 20 * held > rows.len() && 10 * held < 9 * rows.len() {
                return fact;
            }
        }
    }

    fn recipe(&mut self, field: Field, model: &Model) -> Model {
        let mut model = model.clone();
        let rules = self.drawer.conventions();
        match field {
            Field::Question | Field::Guarded => {
                let base = self.one_of(&self.bases.clone());
                let when = (field == Field::Guarded).then(|| vec![vec![self.fact(false)]]);
                model.chain.insert(0, GuardedStep { when, base });
            }
            Field::Pixels | Field::PixelsOfTwo => {
                let mut facts: Conjunction = vec![self.fact(true)];
                if field == Field::PixelsOfTwo {
                    let is_pixel = self.rng.chance(2);
                    facts.push(self.fact(is_pixel));
                }
                let wrong = self.one_of(&[Wrong::Missing, Wrong::Missing, Wrong::Extra]);
                model.steps.push(Step { wrong, facts });
            }
            Field::Border | Field::BorderOfTwo => {
                let mut crossing = self.one_of(&Crossing::RIGHT.neighbours());
                if field == Field::BorderOfTwo {
                    crossing = self.one_of(&crossing.neighbours());
                }
                let ends = self.one_of(&[[true, true], [true, true], [true, false], [false, true]]);
                model.borders.push(GuardedBorder { when: None, ends, crossing });
            }
            Field::Rows => model.rows = self.one_of(&RowRule::default().variants()),
            Field::Edges => {
                let test = self.one_of(&EdgeTest::RIGHT.variants(rules));
                model.chain.push(always(Rule::Edges(test)));
            }
            Field::Walk => {
                let start = self.one_of(&[Walk::RIGHT, Walk::BOTH_AXES, Walk::SAMPLED]);
                let walk = self.one_of(&start.variants());
                model.chain.push(always(Rule::Walk(walk)));
            }
        }
        model
    }

    /// The part of all answers that a recipe has otherwise than they are right.
    fn wrong_part(&self, model: &Model) -> f64 {
        let is_wrong = |a: &&LearnedAnswer| {
            let picture = model.predict(a, self.drawer, &self.vocabulary);
            picture.is_some_and(|picture| !picture.is_as(&a.right))
        };
        self.answers.iter().filter(is_wrong).count() as f64 / self.answers.len() as f64
    }

    /// A recipe that is wrong neither hardly ever nor, with another one, just as that one.
    fn served(&mut self, fields: &[Field]) -> Model {
        loop {
            let mut model = Model::default();
            for field in fields {
                model = self.recipe(*field, &model);
            }
            if self.wrong_part(&model) > 0.04 {
                return model;
            }
        }
    }
}

fn always(rule: Rule) -> GuardedStep {
    GuardedStep { when: None, base: Base { changes: Vec::new(), rule } }
}

/// What was learned of a recipe, in words, with the words of the recipe.
fn explained(
    model: &Model,
    drawer: &dyn Drawer,
    vocabulary: &Vocabulary,
) -> (Option<Learned>, String) {
    let words = say::sentences(model, drawer, vocabulary).join(" ");
    let picture = |q: &AnyQuestion| {
        let right = drawer.right(q, 0).unwrap();
        let a = LearnedAnswer::new(q.clone(), right.clone(), right.clone());
        model.predict(&a, drawer, vocabulary).unwrap_or(right)
    };
    let learned = match vocabulary.names.iter().any(|name| name.noun == "dx") {
        true => learn_lines(&|q, _| picture(q)),
        false => learn_triangles(&|q, _| picture(q)),
    };
    (learned, words)
}

/// Of four recipes of each field eight of ten explain themselves. What does not is printed: RECIPES=20 takes more of each, PAIRS=1
/// two changes at once, of which the shares are printed and not held to anything yet, SEED=2 takes others, and ONLY=5 asks for the one
/// that is printed with this number.
#[test]
#[ignore = "takes minutes; .ci/run --all runs it"]
fn recipes_explain_themselves() {
    let number = |name: &str, default: usize| {
        std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
    };
    let (count, seed) = (number("RECIPES", 4), number("SEED", 1) as u64);
    let is_pair = number("PAIRS", 0) > 0;
    let only = number("ONLY", usize::MAX);
    let mut served = 0;
    let known = Declarations::default();
    let mut all = [0, 0];
    for is_line in [false, true] {
        let work = Work::default();
        let (of_triangle, of_line) = (TriangleConvention::default(), LineConvention::default());
        let (nobody, no_line) = (Asker::new(), Asker::new());
        let mut triangles =
            Triangles::new(&nobody, &known, [&of_triangle; 2], &[], SEED, &work).unwrap();
        let mut lines = Lines::new(&no_line, &known, [&of_line; 2], &[], SEED, &work);
        let drawer: &mut dyn Drawer = if is_line { &mut lines } else { &mut triangles };
        let mut kitchen = Kitchen::new(drawer, seed);
        let fields = Field::all(is_line);
        for &field in &fields {
            let mut certain = 0;
            for _ in 0..count {
                let mut changed = vec![field];
                if is_pair {
                    changed.push(kitchen.one_of(&fields));
                }
                let model = kitchen.served(&changed);
                served += 1;
                if only != usize::MAX && served != only {
                    continue;
                }
                let (learned, words) = explained(&model, kitchen.drawer, &kitchen.vocabulary);
                if learned.as_ref().is_some_and(|learned| learned.is_certain) {
                    certain += 1;
                    continue;
                }
                println!("{served} {changed:?} {:.2}: {words}", kitchen.wrong_part(&model));
                let said = learned.map_or(String::from("nothing"), |l| l.sentences().join(" "));
                println!("    {said}\n");
            }
            println!(
                "=== {} {field:?}: {certain} of {count}",
                ["triangles", "lines"][usize::from(is_line)]
            );
            all = [all[0] + certain, all[1] + count];
        }
    }
    println!("=== all: {} of {}", all[0], all[1]);
    // Measured with four of each field: 53 of 60 with one change.
    if !is_pair {
        assert!(10 * all[0] >= 8 * all[1], "{} of {}", all[0], all[1]);
    }
}
