//! An explanation as a value: changed questions with the questions that they hold for, then pixel rules, one on another.

use super::border::{Crossing, Site};
use super::change::Base;
use super::drawer::{Drawer, LearnedAnswer};
use super::fill::{self, RowRule};
use super::picture::Picture;
use super::quantity::{self, Name, Quantities, Scene};
use super::question::{AnyQuestion, Unit};
use super::rule::{Conjunction, Fact, Of, all_hold};

/// The names of all quantities: those of the question first.
pub(super) struct Vocabulary {
    pub(super) names: Vec<Name>,
    /// How many are of the question.
    pub(super) of_question: usize,
    /// How many quantities of a pixel each group has.
    sizes: [usize; quantity::GROUPS],
    /// The names of what a border has beside the quantities of its pixel.
    of_border: Vec<Name>,
}

impl Vocabulary {
    pub(super) fn of(question: &AnyQuestion) -> Self {
        let mut out = Quantities { names: Some(Vec::new()), ..Quantities::default() };
        quantity::of_question(question, &mut out);
        let of_question = out.values.len();
        let picture = Picture::new(question.side);
        Scene::new(question, &picture, [128; 2]).of_pixel([0, 0], &mut out);
        let mut border = Quantities::with_names();
        Site::sample().quantities(question, &mut border);
        let [names, of_border] = [out.names, border.names].map(Option::unwrap_or_default);
        Self { names, of_question, sizes: out.sizes, of_border }
    }

    /// The names of the quantities of a border, without comparisons of two quantities, which are many.
    pub(super) fn of_borders(&self) -> Vec<Name> {
        let mut names = self.names.clone();
        names.extend(self.of_border.iter().cloned());
        for name in &mut names {
            if name.unit == Unit::Paired {
                name.unit = Unit::Count;
            }
        }
        names
    }

    /// The groups of quantities of a pixel that no fact is about.
    fn left_out(&self, facts: &[Fact]) -> [bool; quantity::GROUPS] {
        let grouped: usize = self.sizes.iter().sum();
        let mut start = self.names.len() - grouped;
        self.sizes.map(|size| {
            let group = start..start + size;
            start += size;
            facts.iter().all(|fact| match fact.of {
                Of::One(i) => !group.contains(&i),
                Of::Difference(i, j) => !group.contains(&i) && !group.contains(&j),
            })
        })
    }

    /// Facts that need the same groups of quantities, with the groups that they leave out: most pixels are told by the first.
    fn stages(&self, facts: &[Fact]) -> Vec<([bool; quantity::GROUPS], Conjunction)> {
        let mut stages: Vec<([bool; quantity::GROUPS], Conjunction)> = Vec::new();
        for fact in facts {
            let left_out = self.left_out(&[*fact]);
            match stages.iter_mut().find(|(groups, _)| *groups == left_out) {
                Some((_, facts)) => facts.push(*fact),
                None => stages.push((left_out, vec![*fact])),
            }
        }
        stages.sort_by_key(|(left_out, _)| left_out.iter().filter(|is_out| !**is_out).count());
        stages
    }

    fn is_of_question(&self, fact: &Fact) -> bool {
        matches!(fact.of, Of::One(i) if i < self.of_question)
    }
}

/// Steps of [`super::trial::Work`] for the facts of a pixel in a rule, and for all quantities of one.
const PIXEL: usize = 30;
pub(super) const ALL_OF_A_PIXEL: usize = 400;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wrong {
    Missing,
    Extra,
    Twice,
}

impl Wrong {
    pub(super) const ALL: [Self; 3] = [Self::Missing, Self::Extra, Self::Twice];

    /// Whether it can befall a pixel that is predicted to have so many hits.
    pub(super) fn may_befall(self, hits: u8) -> bool {
        match self {
            Self::Missing => hits > 0,
            Self::Extra => hits == 0,
            Self::Twice => hits == 1,
        }
    }

    /// Whether a pixel with so many hits shows it.
    pub(super) fn is_seen(self, hits: u8) -> bool {
        match self {
            Self::Missing => hits == 0,
            Self::Extra => hits > 0,
            Self::Twice => hits > 1,
        }
    }

    fn hits(self) -> u8 {
        match self {
            Self::Missing => 0,
            Self::Extra => 1,
            Self::Twice => 2,
        }
    }
}

/// Pixels of which all facts hold are wrong in one way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Step {
    pub(super) wrong: Wrong,
    pub(super) facts: Conjunction,
}

/// A changed question, and when it is the one that is drawn: where one of these conjunctions holds, or always.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GuardedStep {
    pub(super) when: Option<Vec<Conjunction>>,
    pub(super) base: Base,
}

/// A formula of the borders at one end of rows or at both, and where it holds, by the facts of the pixel at the border.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GuardedBorder {
    pub(super) when: Option<Vec<Conjunction>>,
    /// Whether it is that of the first pixels, and that of the last ones.
    pub(super) ends: [bool; 2],
    pub(super) crossing: Crossing,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Model {
    /// The first whose guard holds is drawn; the right picture where none does.
    pub(super) chain: Vec<GuardedStep>,
    /// Of those of an end of a row, the first whose guard holds is taken.
    pub(super) borders: Vec<GuardedBorder>,
    /// How rows are drawn between these.
    pub(super) rows: RowRule,
    pub(super) steps: Vec<Step>,
}

impl Model {
    /// What it predicts, in the window and in its margin.
    pub(super) fn predict(
        &self,
        a: &LearnedAnswer,
        drawer: &dyn Drawer,
        vocabulary: &Vocabulary,
    ) -> Option<Picture> {
        let mut drawn = self.start(a, drawer)?;
        if !self.borders.is_empty() || self.rows.changes() > 0 {
            drawn = self.with_borders(a, &drawn, drawer.sample(), vocabulary);
        }
        for step in &self.steps {
            drawn = step.apply(a, &drawn, drawer, vocabulary);
        }
        Some(if drawer.counts() { drawn } else { drawn.once() })
    }

    fn start(&self, a: &LearnedAnswer, drawer: &dyn Drawer) -> Option<Picture> {
        let base = self.chain.iter().find(|guarded| guarded.holds(&a.facts));
        match base {
            Some(guarded) => guarded.base.draw(a, drawer),
            None => Some(a.right.clone()),
        }
    }

    fn with_borders(
        &self,
        a: &LearnedAnswer,
        before: &Picture,
        sample: [i64; 2],
        vocabulary: &Vocabulary,
    ) -> Picture {
        let guards = self.borders.iter().filter_map(|border| border.when.as_ref());
        let all: Vec<Fact> = guards.flatten().flatten().copied().collect();
        let left_out = vocabulary.left_out(&all);
        let scene = Scene::new(&a.question, before, sample);
        fill::redrawn(&a.question, before, sample, self.rows, &|site, right| {
            let row = match all.is_empty() {
                true => Vec::new(),
                false => {
                    let (values, sizes) = (a.facts.clone(), vocabulary.sizes);
                    let mut row = Quantities { values, names: None, left_out, sizes };
                    scene.of_pixel(site.pixel(right, before), &mut row);
                    site.quantities(&a.question, &mut row);
                    row.values
                }
            };
            let is_one = |border: &&GuardedBorder| border.ends[site.end] && border.holds(&row);
            let guarded = self.borders.iter().find(is_one)?;
            site.evaluate(&guarded.crossing, &a.question, sample)
        })
    }

    pub(super) fn fits(
        &self,
        a: &LearnedAnswer,
        drawer: &dyn Drawer,
        vocabulary: &Vocabulary,
    ) -> bool {
        self.predict(a, drawer, vocabulary).is_some_and(|picture| picture.is_as(&a.drawn))
    }

    /// How much it says.
    pub(super) fn cost(&self) -> usize {
        let guards = self.chain.iter().map(|guarded| {
            guarded.base.cost() + guarded.when.iter().flatten().map(Vec::len).sum::<usize>()
        });
        let borders = self.borders.iter().map(|border| {
            border.crossing.changes() + border.when.iter().flatten().map(Vec::len).sum::<usize>()
        });
        let steps = self.steps.iter().map(|step| 1 + step.facts.len());
        self.rows.changes() + guards.chain(borders).chain(steps).sum::<usize>()
    }

    /// Every guard in it.
    pub(super) fn guards(&self) -> impl Iterator<Item = &Vec<Conjunction>> {
        let of_chain = self.chain.iter().filter_map(|guarded| guarded.when.as_ref());
        of_chain.chain(self.borders.iter().filter_map(|guarded| guarded.when.as_ref()))
    }

    /// Every conjunction in it.
    pub(super) fn conjunctions(&self) -> impl Iterator<Item = &Conjunction> {
        self.guards().flatten().chain(self.steps.iter().map(|step| &step.facts))
    }

    /// Every fact in it, in the same order.
    pub(super) fn facts_mut(&mut self) -> Vec<&mut Fact> {
        let of_chain = self.chain.iter_mut().filter_map(|guarded| guarded.when.as_mut());
        let of_borders = self.borders.iter_mut().filter_map(|guarded| guarded.when.as_mut());
        let mut all: Vec<&mut Fact> = of_chain.chain(of_borders).flatten().flatten().collect();
        all.extend(self.steps.iter_mut().flat_map(|step| &mut step.facts));
        all
    }

    /// With another pixel rule.
    pub(super) fn with(&self, step: Step) -> Self {
        let mut more = self.clone();
        more.steps.push(step);
        more
    }
}

fn guard_holds(when: Option<&Vec<Conjunction>>, facts: &[i64]) -> bool {
    when.is_none_or(|when| when.iter().any(|all| all_hold(all, facts)))
}

impl GuardedStep {
    fn holds(&self, facts: &[i64]) -> bool {
        guard_holds(self.when.as_ref(), facts)
    }
}

impl GuardedBorder {
    fn holds(&self, facts: &[i64]) -> bool {
        guard_holds(self.when.as_ref(), facts)
    }
}

impl Step {
    /// Facts of the question alone need no look at the pixels.
    pub(super) fn split(&self, vocabulary: &Vocabulary) -> [Conjunction; 2] {
        let (of_question, of_pixel) =
            self.facts.iter().copied().partition(|fact| vocabulary.is_of_question(fact));
        [of_question, of_pixel]
    }

    fn apply(
        &self,
        a: &LearnedAnswer,
        before: &Picture,
        drawer: &dyn Drawer,
        vocabulary: &Vocabulary,
    ) -> Picture {
        let [of_question, of_pixel] = self.split(vocabulary);
        let mut after = before.clone();
        if !all_hold(&of_question, &a.facts) {
            return after;
        }
        let scene = Scene::new(&a.question, before, drawer.sample());
        let stages = vocabulary.stages(&of_pixel);
        let (values, sizes) = (a.facts.clone(), vocabulary.sizes);
        let mut row = Quantities { values, sizes, ..Quantities::default() };
        let mut holds = |at: [i32; 2]| {
            stages.iter().all(|(left_out, facts)| {
                row.left_out = *left_out;
                row.values.truncate(vocabulary.of_question);
                scene.of_pixel(at, &mut row);
                all_hold(facts, &row.values)
            })
        };
        for at in before.all().filter(|at| self.wrong.may_befall(before.hits(*at))) {
            drawer.work().spend(PIXEL);
            if holds(at) {
                after.set(at, self.wrong.hits());
            }
        }
        after
    }
}
