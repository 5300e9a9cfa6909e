//! A model that was nearly right, mended: with another field of a formula, or another limit of a fact.

use super::border::{Crossing, Toward};
use super::change::Rule;
use super::drawer::LearnedAnswer;
use super::fill::RowRule;
use super::model::{ALL_OF_A_PIXEL, Model, Step};
use super::quantity::{NONE, Quantities, Scene};
use super::rule::Test;
use super::search::Search;

/// Fields of formulas that are mended in a row, and the answers that show what that brings.
const MOST_MENDED: usize = 4;
const MENDED_BY: usize = 400;
/// Only where at most this part of the answers is not predicted.
const MENDED_PART: usize = 8;
/// Limits that are tried in a fact, the nearest first.
const MOST_LIMITS: usize = 24;
/// Variants that are tried on all these answers.
const MENDED_KEPT: usize = 12;

impl Search<'_> {
    /// A model that was nearly right, with one other field of a formula or limit of a fact, and again, as long as more answers are predicted: nothing
    /// where that does not help, and where too much is not predicted.
    pub(super) fn mended(&self, model: &Model) -> Option<Model> {
        let count = |model: &Model, all: &[&LearnedAnswer]| {
            all.iter().filter(|a| self.fits(model, a)).count()
        };
        let mut best: Option<Model> = None;
        for _ in 0..MOST_MENDED {
            let model = best.as_ref().unwrap_or(model);
            let all: Vec<&LearnedAnswer> = self.answered.iter().take(MENDED_BY).collect();
            let (fitting, missed): (Vec<_>, Vec<_>) = all.iter().partition(|a| self.fits(model, a));
            if missed.is_empty() || MENDED_PART * missed.len() > all.len() {
                return best.filter(|_| missed.is_empty());
            }
            // The answers that are not predicted tell most apart; of the others none may be lost for them.
            let mut others = variants(model, self.drawer.conventions());
            others.extend(self.other_limits(model, &missed));
            let mut variants: Vec<(usize, Model)> = others
                .into_iter()
                .map(|other| (count(&other, &missed), other))
                .filter(|(more, _)| *more > 0)
                .collect();
            variants.sort_by_key(|(more, _)| std::cmp::Reverse(*more));
            variants.truncate(MENDED_KEPT);
            let gain = |(more, other): &(usize, Model)| {
                (more + count(other, &fitting)).saturating_sub(fitting.len())
            };
            let next = variants.into_iter().max_by_key(gain).filter(|next| gain(next) > 0);
            best = Some(next?.1);
        }
        best
    }

    /// All models with another limit in one fact: at each value that the answers have which are not predicted.
    fn other_limits(&self, model: &Model, missed: &[&LearnedAnswer]) -> Vec<Model> {
        let mut all = Vec::new();
        let of_question = self.vocabulary.of_question;
        let guards = model.guards().flatten().flatten().count();
        for (number, fact) in model.clone().facts_mut().into_iter().enumerate() {
            let Some((quantity, limit)) = fact.limit() else { continue };
            let mut values: Vec<i64> = match (quantity < of_question, number.checked_sub(guards)) {
                (true, _) => missed.iter().map(|a| a.facts[quantity]).collect(),
                // Of which rule the fact is decides of which picture its pixels are.
                (false, Some(rest)) => self.values_of_pixels(model, rest, quantity, missed),
                (false, None) => continue,
            };
            values.retain(|value| *value != NONE);
            values.sort_by_key(|value| value.abs_diff(limit));
            values.dedup();
            values.truncate(MOST_LIMITS);
            for value in values {
                let mut other = model.clone();
                other.facts_mut()[number].test = match fact.test {
                    // What it holds of is left out, and what it does not hold of comes in.
                    Test::AtMost(most) => {
                        Test::AtMost(if value <= most { value - 1 } else { value })
                    }
                    Test::AtLeast(least) => {
                        Test::AtLeast(if value >= least { value + 1 } else { value })
                    }
                    test => test,
                };
                all.push(other);
            }
        }
        all
    }

    /// The values of a quantity at pixels that a model predicts wrongly, in the picture before the rule that has a fact.
    fn values_of_pixels(
        &self,
        model: &Model,
        fact: usize,
        quantity: usize,
        missed: &[&LearnedAnswer],
    ) -> Vec<i64> {
        // The rule that has the fact is the first that ends behind it.
        let mut end = 0;
        let is_before = |step: &&Step| {
            end += step.facts.len();
            end <= fact
        };
        let before = model.steps.iter().take_while(is_before).cloned().collect();
        let before = Model { steps: before, ..model.clone() };
        let mut values = Vec::new();
        for a in missed {
            let [Some(before), Some(after)] =
                [&before, model].map(|model| model.predict(a, self.drawer, self.vocabulary))
            else {
                continue;
            };
            let scene = Scene::new(&a.question, &before, self.drawer.sample());
            for at in after.pixels().filter(|at| after.hits(*at) != a.drawn.hits(*at)) {
                self.drawer.work().spend(ALL_OF_A_PIXEL);
                let mut row = Quantities { values: a.facts.clone(), ..Quantities::default() };
                scene.of_pixel(at, &mut row);
                values.push(row.values[quantity]);
            }
        }
        values
    }
}

/// All models with another field in one formula of borders, or with another rule for rows.
fn variants(model: &Model, rules: usize) -> Vec<Model> {
    let mut all = Vec::new();
    for (i, guarded) in model.chain.iter().enumerate() {
        let others: Vec<Rule> = match &guarded.base.rule {
            Rule::Convention(_) => continue,
            Rule::Edges(test) => test.variants(rules).into_iter().map(Rule::Edges).collect(),
            Rule::Walk(walk) => walk.variants().into_iter().map(Rule::Walk).collect(),
        };
        for rule in others {
            let mut other = model.clone();
            other.chain[i].base.rule = rule;
            all.push(other);
        }
    }
    for (i, border) in model.borders.iter().enumerate() {
        for crossing in border.crossing.variants() {
            let mut other = model.clone();
            other.borders[i].crossing = crossing;
            all.push(other);
        }
    }
    if !model.borders.is_empty() {
        // A program has one way to round, and uses it everywhere.
        all.extend(Toward::ALL.map(|toward| rounding(model, toward)));
    }
    if !model.borders.is_empty() || model.rows != RowRule::default() {
        all.extend(model.rows.variants().into_iter().map(|rows| Model { rows, ..model.clone() }));
    }
    all
}

/// A model that rounds the other way wherever it rounds coordinates to whole pixels.
fn rounding(model: &Model, toward: Toward) -> Model {
    let mut other = model.clone();
    for border in &mut other.borders {
        let Crossing { start, sides, .. } = &mut border.crossing;
        start.iter_mut().chain(sides).flatten().for_each(|way| *way = toward);
    }
    other.rows.heights.iter_mut().for_each(|way| *way = toward);
    other
}
