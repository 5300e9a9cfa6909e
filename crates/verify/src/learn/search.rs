//! The search for a model: pixel rules, guarded changes of the question, and one on another.

use super::border::{Crossing, Toward};
use super::change::{self, Base, Change, EDGES_OF_A_PIXEL, MOST_PIXELS, Nearness, Rule};
use super::climb::{GUARDED_FORMULAS, climbed};
use super::drawer::Drawer;
use super::drawer::LearnedAnswer;
use super::edges::EdgeTest;
use super::fill::RowRule;
use super::model::{ALL_OF_A_PIXEL, GuardedBorder, GuardedStep, Model, Step, Vocabulary, Wrong};
use super::picture::Picture;
use super::quantity::{Name, Quantities, Scene};
use super::rule::{self, Conjunction, Table, Terms, all_hold};
use super::seen::{
    BorderSeen, BordersAtEnds, PixelSeen, Price, borders_seen, pixels_seen, ties_of,
};
use super::shorter::shorter;
use super::walk::Walk;
use std::cell::{Cell, OnceCell, RefCell};
use std::rc::Rc;

/// Answers that rules are learned from, wrong and right.
const LEARNED_FROM: [usize; 2] = [90, 70];
/// Answers that changed questions are ranked by.
const RANKED_BY: usize = 36;
/// Changed questions that are ranked under a model, and the answers that choose them.
const RANKED_UNDER: usize = 150;
const FEW: usize = 8;
/// Pixels of one answer that are looked at, of those that are not wrong.
const MOST_OF_ONE: usize = 240;
/// The most steps of a model.
const MOST_STEPS: usize = 3;
/// The share of answers from which a model is nearly whole.
const NEARLY: f64 = 0.9;
/// Steps of [`super::trial::Work`] for a border, and borders of which a formula gives at least one.
const BORDER: usize = 2;
const FEW_BORDERS: usize = 20;
/// Changed questions that are changed again.
const COMPOSED: usize = 3;
/// The share of wrong answers from which a changed question is followed by pixel rules first of all.
const MUCH: f64 = 0.4;
/// The share of wrong answers from which the rest is looked for beside the pixel rules that predict them, and answers that show it.
const BESIDE: f64 = 0.2;
const LEAST_BESIDE: usize = 8;
/// Questions that a pixel rule must explain, and that a guard must.
const NEED: usize = 4;

/// Answers that show where a changed question holds, wrong and right ones.
const GUARDED_BY: [usize; 2] = [400, 400];

/// Everything that a search looks at.
pub(super) struct Search<'a> {
    pub(super) drawer: &'a dyn Drawer,
    pub(super) vocabulary: &'a Vocabulary,
    pub(super) answered: &'a [LearnedAnswer],
    /// The tables of the empty model, which are needed again and again.
    pub(super) first: OnceCell<Rc<[Table; 3]>>,
    /// The changed questions that came nearest in the first search: later ones look at these alone.
    pub(super) nearest: &'a OnceCell<Vec<Base>>,
    /// Models that were followed by pixel rules already.
    pub(super) followed: RefCell<Vec<Followed>>,
}

/// A model with the pixel rules that it was followed by: how many of them at most, and how many of the first.
pub(super) struct Followed {
    model: Model,
    most: usize,
    beam: usize,
}

impl Followed {
    fn contains(&self, other: &Self) -> bool {
        self.model == other.model && self.most >= other.most && self.beam >= other.beam
    }
}

/// A model with the share of wrong and of right answers that it predicts.
struct Tried {
    model: Model,
    wrong: f64,
    right: f64,
}

impl Tried {
    fn score(&self) -> f64 {
        0.75 * self.wrong + 0.25 * self.right - 0.012 * self.model.cost() as f64
    }

    fn is_whole(&self) -> bool {
        self.wrong > 0.999 && self.right > 0.999
    }
}

impl Search<'_> {
    fn some(&self, wrong: bool, most: usize) -> Vec<&LearnedAnswer> {
        let is_small = |a: &&LearnedAnswer| a.question.side[0] * a.question.side[1] < 900;
        let all = self.answered.iter().filter(|a| a.is_wrong() == wrong);
        let mut some: Vec<&LearnedAnswer> = all.clone().filter(is_small).take(most).collect();
        if some.len() < most / 4 {
            some.extend(all.filter(|a| !is_small(a)).take(most / 4));
        }
        some
    }

    pub(super) fn fits(&self, model: &Model, a: &LearnedAnswer) -> bool {
        model.fits(a, self.drawer, self.vocabulary)
    }

    fn tried(&self, model: Model) -> Tried {
        let share = |some: Vec<&LearnedAnswer>| {
            let fit = some.iter().filter(|a| self.fits(&model, a)).count();
            fit as f64 / some.len().max(1) as f64
        };
        let (wrong, right) = (share(self.some(true, 150)), share(self.some(false, 100)));
        Tried { model, wrong, right }
    }

    /// The best model that is found.
    pub(super) fn explain(&self) -> Model {
        // The simplest first: one short pixel rule, then one changed question.
        let mut tried = vec![self.tried(Model::default())];
        let first = self.candidates(&Model::default(), 2, 1).into_iter().next();
        tried.extend(first.map(|step| self.tried(Model::default().with(step))));
        if best(&tried).is_whole() {
            return self.pruned(best(&tried).model.clone());
        }
        let ranked = self.ranked(&Model::default());
        self.guard_bases(&ranked, &mut tried);
        if best(&tried).is_whole() && best(&tried).model.cost() <= 5 {
            return self.pruned(best(&tried).model.clone());
        }
        tried.push(self.tried(self.with_steps(&Model::default(), MOST_STEPS, 2)));
        let may_go_on = |tried: &[Tried]| !best(tried).is_whole() && !self.drawer.work().is_done();
        // Under a changed question there may be a pixel rule.
        let is_much = |tried: &&Tried| !tried.model.chain.is_empty() && tried.wrong > MUCH;
        let changed = tried.iter().filter(is_much).reduce(higher).map(|tried| tried.model.clone());
        if let Some(model) = changed.filter(|_| may_go_on(&tried)) {
            // A guard may stand for what a pixel rule says better.
            let bases = model.chain.iter().take(1).map(|guarded| always(&guarded.base));
            let bare = Model { chain: bases.collect(), ..Model::default() };
            tried.push(self.tried(self.with_steps(&bare, 2, 1)));
            if may_go_on(&tried) && bare != model {
                tried.push(self.tried(self.with_steps(&model, 2, 1)));
            }
        }
        // Long models may be a formula in other words.
        if may_go_on(&tried) || best(&tried).model.cost() > 5 {
            self.test_edges(&mut tried);
            self.walk_lines(&mut tried);
        }
        if may_go_on(&tried) || best(&tried).model.cost() > 5 {
            self.move_borders(&mut tried);
        }
        if may_go_on(&tried) {
            self.add_bases(&mut tried);
        }
        if may_go_on(&tried) {
            self.beside_rules(&mut tried);
        }
        if may_go_on(&tried) && !best(&tried).model.chain.is_empty() {
            let model = best(&tried).model.clone();
            tried.push(self.tried(self.with_steps(&model, 2, 1)));
        }
        // What is nearly whole is not begun anew: what refutes it goes into the next search.
        let is_near = |tried: &[Tried]| best(tried).wrong > NEARLY && best(tried).right > NEARLY;
        if !is_near(&tried) && may_go_on(&tried) {
            let composed = self.composed(&ranked);
            self.guard_bases(&composed, &mut tried);
        }
        if !is_near(&tried) && may_go_on(&tried) {
            self.under_a_rule(&mut tried);
        }
        if !is_near(&tried) {
            // Under pixel rules, what comes nearest by pixels counts, and not what predicts a few answers whole.
            let mut by_pixels = ranked.clone();
            by_pixels.sort_by_key(|(near, _)| std::cmp::Reverse(near.pixels));
            for (_, base) in ranked.iter().take(1).chain(by_pixels.iter().take(2)) {
                if !may_go_on(&tried) {
                    break;
                }
                let model = Model { chain: vec![always(base)], ..Model::default() };
                tried.push(self.tried(self.with_steps(&model, 2, 1)));
            }
        }
        self.pruned(best(&tried).model.clone())
    }

    /// Changed questions, the one that comes nearest to the wrong answers first; under the pixel rules of a model.
    fn ranked(&self, under: &Model) -> Vec<(Nearness, Base)> {
        let answers = self.some(true, RANKED_BY);
        let is_line = answers.first().is_some_and(|a| a.question.is_line());
        let before = self.nearest.get().cloned();
        let mut bases = before.unwrap_or_else(|| change::all(is_line, self.drawer.rules().len()));
        bases.extend(change::solved(is_line, &self.some(true, 120), self.drawer));
        let ranked = self.rank(bases, &answers, under);
        self.nearest.get_or_init(|| {
            ranked.iter().take(RANKED_UNDER).map(|(_, base)| base.clone()).collect()
        });
        ranked
    }

    fn rank(
        &self,
        bases: Vec<Base>,
        answers: &[&LearnedAnswer],
        under: &Model,
    ) -> Vec<(Nearness, Base)> {
        let near = |base: &Base| match under.steps.is_empty() && under.borders.is_empty() {
            true => change::nearness(base, answers, self.drawer),
            // Those that come nearest without the rules were looked at by then.
            false if self.drawer.work().is_done() => Nearness::default(),
            false => {
                let model = Model { chain: vec![always(base)], ..under.clone() };
                let fitting =
                    |some: &[&LearnedAnswer]| some.iter().filter(|a| self.fits(&model, a)).count();
                let (first, rest) = answers.split_at(answers.len().min(FEW));
                let exact = match fitting(first) {
                    0 => 0,
                    some => some + fitting(rest),
                };
                Nearness { exact, pixels: 0 }
            }
        };
        // Under a model only those are looked at that come nearest without it.
        let few = &answers[..answers.len().min(FEW)];
        let rough = |base: &Base| std::cmp::Reverse(change::nearness(base, few, self.drawer));
        let mut bases = bases;
        if *under != Model::default() {
            bases.sort_by_cached_key(rough);
            bases.truncate(RANKED_UNDER);
        }
        let mut ranked: Vec<(Nearness, Base)> = bases.into_iter().map(|b| (near(&b), b)).collect();
        ranked.sort_by(|(a, x), (b, y)| b.cmp(a).then(x.cost().cmp(&y.cost())));
        ranked
    }

    /// Two changes one after another: each of the nearest, followed by every other one.
    fn composed(&self, ranked: &[(Nearness, Base)]) -> Vec<(Nearness, Base)> {
        let answers = self.some(true, RANKED_BY);
        let Some(first) = answers.first() else { return Vec::new() };
        let mut all = change::all(first.question.is_line(), self.drawer.rules().len());
        // Another way over the shape changes little of most pictures, and would crowd out the rest.
        all.retain(|base| !base.changes.iter().any(|change| matches!(change, Change::Visit(_))));
        let mut bases = Vec::new();
        for (_, base) in ranked.iter().take(COMPOSED) {
            for other in &all {
                let changes = base.changes.iter().chain(&other.changes).copied().collect();
                let rule = if base.rule == Rule::RIGHT { other.rule } else { base.rule };
                bases.push(Base { changes, rule });
            }
        }
        // Few answers tell which are worth a look at the others.
        let few = &answers[..answers.len().min(FEW)];
        let rough = |base: &Base| std::cmp::Reverse(change::nearness(base, few, self.drawer));
        bases.sort_by_cached_key(rough);
        bases.truncate(RANKED_UNDER);
        self.rank(bases, &answers, &Model::default())
    }

    fn guard_bases(&self, ranked: &[(Nearness, Base)], tried: &mut Vec<Tried>) {
        let least = RANKED_BY.min(self.some(true, RANKED_BY).len()).div_ceil(5);
        let fitting: Vec<bool> = self.answered.iter().map(|a| !a.is_wrong()).collect();
        for (_, base) in ranked.iter().take(6).take_while(|(near, _)| near.exact >= least) {
            let Some(model) = self.guarded(&Model::default(), &fitting, base) else { continue };
            tried.push(self.tried(model));
            if tried.last().is_some_and(|t| t.is_whole() && t.model.cost() <= 4) {
                break;
            }
        }
    }

    /// Other changed questions for what the best model does not predict.
    fn add_bases(&self, tried: &mut Vec<Tried>) {
        for _ in 0..MOST_STEPS - 1 {
            let model = best(tried).model.clone();
            let left: Vec<&LearnedAnswer> = self
                .some(true, 300)
                .into_iter()
                .filter(|a| !self.fits(&model, a))
                .take(25)
                .collect();
            if self.drawer.work().is_done()
                || left.len() < NEED
                || (model.chain.is_empty() && model.steps.is_empty())
            {
                return;
            }
            let bases = self.nearest.get().cloned().unwrap_or_default();
            let under = Model { chain: Vec::new(), ..model.clone() };
            let mut ranked = self.rank(bases, &left, &under);
            ranked.truncate(4);
            ranked.retain(|(near, _)| near.exact * 5 >= left.len());
            if ranked.is_empty() {
                return;
            }
            let fitting: Vec<bool> = self.answered.iter().map(|a| self.fits(&model, a)).collect();
            for (_, base) in ranked {
                let guarded = self.guarded(&model, &fitting, &base);
                tried.extend(guarded.map(|model| self.tried(model)));
            }
        }
    }

    /// What else is wrong, by the answers that the pixel rules found so far leave as they are: these show the rest by itself.
    fn beside_rules(&self, tried: &mut Vec<Tried>) {
        let has_rules = |tried: &&Tried| !tried.model.steps.is_empty() && tried.wrong > BESIDE;
        let Some(found) = tried.iter().filter(has_rules).reduce(higher) else { return };
        let rules = found.model.steps.clone();
        // The later rules may be made of what is looked for.
        for count in 1..=rules.len().min(2) {
            if best(tried).is_whole() || self.drawer.work().is_done() {
                return;
            }
            let steps = rules[..count].to_vec();
            let under = Model { steps: steps.clone(), ..Model::default() };
            let is_left = |a: &&LearnedAnswer| {
                let picture = under.predict(a, self.drawer, self.vocabulary);
                picture.is_some_and(|picture| picture.is_as(&a.right))
            };
            let left: Vec<LearnedAnswer> = self.answered.iter().filter(is_left).cloned().collect();
            if left.iter().filter(|a| a.is_wrong()).count() < LEAST_BESIDE {
                continue;
            }
            let search = Search {
                drawer: self.drawer,
                vocabulary: self.vocabulary,
                answered: &left,
                first: OnceCell::new(),
                nearest: &OnceCell::new(),
                followed: RefCell::default(),
            };
            let mut more = vec![search.tried(Model::default())];
            search.guard_bases(&search.ranked(&Model::default()), &mut more);
            if !best(&more).is_whole() {
                search.test_edges(&mut more);
                search.walk_lines(&mut more);
            }
            if !best(&more).is_whole() {
                search.move_borders(&mut more);
            }
            let mut model = best(&more).model.clone();
            model.steps.extend(steps);
            tried.push(self.tried(model));
        }
    }

    /// Other computations of whether a sample is inside.
    fn test_edges(&self, tried: &mut Vec<Tried>) {
        let some = [self.some(true, LEARNED_FROM[0]), self.some(false, LEARNED_FROM[1])];
        let pixels = pixels_seen(some.into_iter().flatten());
        if pixels[0].len() < 2 * NEED {
            return;
        }
        let rules = self.drawer.conventions();
        let worth = |test: &EdgeTest, least: f64| self.worth_of_test(test, &pixels, least);
        let best = climbed(EdgeTest::RIGHT, &|test| test.variants(rules), &worth);
        let base =
            |(_, test): (f64, EdgeTest)| Base { changes: Vec::new(), rule: Rule::Edges(test) };
        let answers = self.some(true, RANKED_BY);
        let ranked = self.rank(best.into_iter().map(base).collect(), &answers, &Model::default());
        self.guard_bases(&ranked, tried);
    }

    /// Other ways to walk along a line, from each method on.
    fn walk_lines(&self, tried: &mut Vec<Tried>) {
        let answers = self.some(true, RANKED_BY);
        if answers.first().is_none_or(|a| !a.question.is_line()) {
            return;
        }
        // Short lines tell as much, and are walked in less time.
        let is_short = |a: &&LearnedAnswer| a.question.extent().iter().all(|v| *v < SHORT_LINE);
        let short = |wrong: bool, most: usize| -> Vec<&LearnedAnswer> {
            self.some(wrong, 2 * most).into_iter().filter(is_short).take(most).collect()
        };
        let (wrong, right) = (short(true, RANKED_BY), short(false, RANKED_BY / 2));
        let base = |walk: &Walk| Base { changes: Vec::new(), rule: Rule::Walk(*walk) };
        let worth = |walk: &Walk, _: f64| {
            let near = change::nearness(&base(walk), &wrong, self.drawer);
            let kept = change::nearness(&base(walk), &right, self.drawer);
            let exact = near.exact as f64 + 0.5 * kept.exact as f64;
            exact + 0.002 * (near.pixels + kept.pixels) as f64 - 0.3 * walk.changes() as f64
        };
        let mut bases = Vec::new();
        for start in [Walk::RIGHT, Walk::BOTH_AXES, Walk::SAMPLED] {
            bases.push(base(&start));
            bases
                .extend(climbed(start, &Walk::variants, &worth).iter().map(|(_, walk)| base(walk)));
        }
        let ranked = self.rank(bases, &answers, &Model::default());
        self.guard_bases(&ranked, tried);
    }

    /// How many of some wrong pixels a test draws as they are, less a part of the right ones that it breaks; what is below `least` is
    /// not counted to its end.
    fn worth_of_test(
        &self,
        test: &EdgeTest,
        [wrong, right]: &[Vec<PixelSeen<'_>>; 2],
        least: f64,
    ) -> f64 {
        let sample = self.drawer.sample();
        let owned = self.drawer.ties(test.ties);
        // The pixels of an answer come one after another, and what is the same for all of them is computed once.
        let last = Cell::new(None);
        let is_drawn = |seen: &PixelSeen<'_>| {
            let of_answer = match last.get() {
                Some((group, numbers)) if group == seen.group => numbers,
                _ => test.numbers(&seen.answer.question),
            };
            last.set(Some((seen.group, of_answer)));
            let is_inside = of_answer.is_some_and(|numbers| numbers.draws(seen.at, sample, owned));
            is_inside == seen.answer.drawn.has(seen.at)
        };
        let step = wrong.len().div_ceil(FEW_BORDERS).max(1);
        let few = wrong.iter().step_by(step);
        let price = Price { steps: EDGES_OF_A_PIXEL, broken: 0.2, changes: test.changes() };
        self.worth_above(least, price, few, [wrong, right], &is_drawn)
    }

    /// How many wrong borders or pixels a formula gives, less its price. Where that is sure to be below `least` it is some number below
    /// it, so that most formulas are left after a few borders; so are those that give none of a few of the wrong ones.
    fn worth_above<'s, S: 's>(
        &self,
        least: f64,
        price: Price,
        mut few: impl Iterator<Item = &'s S>,
        [wrong, right]: [&'s [S]; 2],
        is_drawn: &dyn Fn(&S) -> bool,
    ) -> f64 {
        self.drawer.work().spend(price.steps * FEW_BORDERS);
        if !few.any(is_drawn) {
            return f64::MIN;
        }
        // What is not looked at yet is taken for drawn.
        let [mut drawn, mut broken, mut looked_at] = [wrong.len(), 0, 0];
        let mut worth = price.worth(drawn, broken);
        for (seen, is_wrong) in
            wrong.iter().map(|seen| (seen, true)).chain(right.iter().map(|seen| (seen, false)))
        {
            if worth < least {
                break;
            }
            looked_at += 1;
            if !is_drawn(seen) {
                if is_wrong {
                    drawn -= 1
                } else {
                    broken += 1
                }
                worth = price.worth(drawn, broken);
            }
        }
        self.drawer.work().spend(price.steps * looked_at);
        worth
    }

    /// Formulas of borders, one after another, and then pixel rules.
    fn move_borders(&self, tried: &mut Vec<Tried>) {
        let mut model = Model::default();
        let mut score = self.tried(model.clone()).score();
        let with_rows = self.with_rows().map(|model| self.tried(model));
        if let Some(next) = with_rows.filter(|next| next.score() > score) {
            (model, score) = (next.model.clone(), next.score());
            let is_whole = next.is_whole();
            tried.push(next);
            if is_whole {
                return;
            }
        }
        for _ in (0..MOST_BORDERS).take_while(|_| !self.drawer.work().is_done()) {
            let mut candidates = Vec::new();
            for model in self.bordered(&model) {
                let exchanges_ends = !model.rows.exchanges_ends;
                let rows = RowRule { exchanges_ends, ..model.rows };
                candidates.push(self.tried(Model { rows, ..model.clone() }));
                candidates.push(self.tried(model));
            }
            let next =
                candidates.into_iter().reduce(|a, b| if b.score() > a.score() { b } else { a });
            let Some(next) = next.filter(|next| next.score() > score) else { break };
            (model, score) = (next.model.clone(), next.score());
            let is_whole = next.is_whole();
            tried.push(next);
            if is_whole {
                return;
            }
        }
        if model != Model::default() {
            tried.push(self.tried(self.with_steps(&model, 2, 1)));
        }
    }

    /// How many of some wrong answers a model predicts, and half as much of right ones, less a little for each pixel that it
    /// misses and for each change; what is below `least` is not counted to its end. In hundredths, so that sums are exact.
    fn worth_of_model(
        &self,
        model: &Model,
        changes: usize,
        [wrong, right]: [&[&LearnedAnswer]; 2],
        least: f64,
    ) -> f64 {
        // What is not looked at yet is taken for predicted.
        let mut worth = (100 * wrong.len() + 50 * right.len()) as f64 - 30.0 * changes as f64;
        let of_wrong = wrong.iter().map(|a| (a, 1.0));
        for (a, weight) in of_wrong.chain(right.iter().map(|a| (a, 0.5))) {
            if worth < least {
                break;
            }
            let picture = model.predict(a, self.drawer, self.vocabulary);
            worth -= match picture.map_or(MOST_PIXELS, |p| p.differs(&a.drawn).min(MOST_PIXELS)) {
                0 => 0.0,
                missed => weight * (100 + 2 * missed) as f64,
            };
        }
        worth
    }

    /// Other rows of the two halves of a triangle: the rule that predicts most.
    fn with_rows(&self) -> Option<Model> {
        let (wrong, right) = (self.some(true, RANKED_BY), self.some(false, RANKED_BY / 2));
        if wrong.first().is_none_or(|a| a.question.is_line()) {
            return None;
        }
        let of = |rows: &RowRule| Model { rows: *rows, ..Model::default() };
        let worth = |rows: &RowRule, least: f64| {
            self.worth_of_model(&of(rows), rows.changes(), [&wrong, &right], least)
        };
        let best = climbed(RowRule::default(), &RowRule::variants, &worth);
        best.first().map(|(_, rows)| of(rows))
    }

    /// A model with another formula of borders: for both ends of rows and for each those that explain most of what is wrong.
    fn bordered(&self, model: &Model) -> Vec<Model> {
        let mut all = Vec::new();
        let is_line = self.answered.first().is_some_and(|a| a.question.is_line());
        // With the first formula it is found out which rows an edge has.
        let mut heights = vec![model.rows.heights];
        if model.borders.is_empty() && !is_line {
            heights.extend(Toward::ALL.map(Some));
        }
        let of_heights: Vec<_> =
            heights.iter().map(|h| [0, 1].map(|end| self.borders_seen(model, end, *h))).collect();
        for ends in [[true, true], [true, false], [false, true]] {
            // A line has no second ends.
            if is_line && ends != [true, false] {
                continue;
            }
            let seen: Vec<BordersAtEnds<'_, '_>> =
                of_heights.iter().map(|of_ends| BordersAtEnds::of(of_ends, ends)).collect();
            // With each rounding of heights the best formula of one change, and from the best of these on.
            let mut first = Vec::new();
            for (number, seen) in seen.iter().enumerate() {
                if seen.wrong.len() < 2 * NEED {
                    continue;
                }
                let ties = ties_of(&seen.right, self.drawer.sample());
                let start = Crossing { ties, start: [None, heights[number]], ..Crossing::RIGHT };
                let mut best = self.worth(&start, seen, f64::MIN);
                for crossing in start.neighbours() {
                    best = best.max(self.worth(&crossing, seen, best));
                }
                first.push(Climb { worth: best, crossing: start, number });
            }
            first.sort_by(Climb::highest_first);
            let mut best = Vec::new();
            for Climb { crossing: start, number, .. } in first.into_iter().take(GUARDED_FORMULAS) {
                let worth = |c: &Crossing, least: f64| self.worth(c, &seen[number], least);
                for (worth, crossing) in climbed(start, &Crossing::neighbours, &worth) {
                    best.push(Climb { worth, crossing, number });
                }
            }
            best.sort_by(Climb::highest_first);
            for Climb { crossing, number, .. } in best.into_iter().take(GUARDED_FORMULAS) {
                if let Some(border) = self.guarded_border(crossing, ends, &seen[number]) {
                    let mut more = model.clone();
                    more.borders.push(border);
                    more.rows.heights = heights[number];
                    all.push(more);
                }
            }
        }
        all
    }

    /// How many of some wrong borders a formula gives, less a part of the right ones that it breaks; what is below `least` is not
    /// counted to its end.
    fn worth(&self, crossing: &Crossing, seen: &BordersAtEnds<'_, '_>, least: f64) -> f64 {
        let [wrong, right] = &seen.some;
        let is_drawn = |seen: &&BorderSeen<'_>| seen.is_drawn_by(crossing, self.drawer.sample());
        let few = wrong.iter().take(FEW_BORDERS);
        let price = Price { steps: BORDER, broken: 0.1, changes: crossing.changes() };
        self.worth_above(least, price, few, [wrong, right], &is_drawn)
    }

    /// A formula with where it holds, by the facts of borders that were wrong and right before; nothing where that cannot be
    /// said.
    fn guarded_border(
        &self,
        crossing: Crossing,
        ends: [bool; 2],
        seen: &BordersAtEnds<'_, '_>,
    ) -> Option<GuardedBorder> {
        let BordersAtEnds { wrong, right, .. } = seen;
        let is_drawn = |seen: &&&BorderSeen<'_>| seen.is_drawn_by(&crossing, self.drawer.sample());
        let mut table = Table::default();
        for seen in wrong.iter().filter(is_drawn) {
            table.yes.push(self.border_facts(seen));
            table.groups.push(seen.group);
        }
        for seen in right.iter().filter(|seen| !is_drawn(seen)) {
            table.no.push(self.border_facts(seen));
        }
        if table.yes.len() < 2 * NEED {
            return None;
        }
        // What breaks hardly any holds everywhere: where rows begin and end is found out afterwards.
        let when = match FEW_BROKEN * table.no.len() <= table.yes.len() {
            true => None,
            false => Some(self.guard(table, &self.vocabulary.of_borders())?),
        };
        Some(GuardedBorder { when, ends, crossing })
    }

    fn border_facts(&self, seen: &BorderSeen<'_>) -> Vec<i64> {
        let (a, scene) = &*seen.answer;
        self.drawer.work().spend(ALL_OF_A_PIXEL);
        let mut row = Quantities { values: a.facts.clone(), ..Quantities::default() };
        scene.of_pixel(seen.site.pixel(seen.right, &a.right), &mut row);
        seen.site.quantities(&a.question, &mut row);
        row.values
    }

    /// The borders of one end that can be read off some answers, with what a model predicts of them where heights are rounded in
    /// some way.
    fn borders_seen(
        &self,
        model: &Model,
        end: usize,
        heights: Option<Toward>,
    ) -> Vec<BorderSeen<'_>> {
        let some = [self.some(true, LEARNED_FROM[0]), self.some(false, LEARNED_FROM[1])];
        let mut all = Vec::new();
        for (group, a) in some.into_iter().flatten().enumerate() {
            if let Some(predicted) = model.predict(a, self.drawer, self.vocabulary) {
                let sample = self.drawer.sample();
                all.extend(borders_seen(group, a, &predicted, sample, (end, heights)));
            }
        }
        all
    }

    /// Takes the best rule that is nearly true, and looks for the changed question under it.
    fn under_a_rule(&self, tried: &mut Vec<Tried>) {
        for wrong in [Wrong::Missing, Wrong::Extra] {
            if best(tried).is_whole() || self.drawer.work().is_done() {
                return;
            }
            let table = &self.tables(&Model::default())[wrong as usize];
            let terms = Terms { most: 2, need: 5, slack: 120, wanted: 1 };
            let names = &self.vocabulary.names;
            for found in rule::best(names, table, terms, self.drawer.work()) {
                let under = Model::default().with(Step { wrong, facts: found.facts });
                let answers: Vec<&LearnedAnswer> = self
                    .some(true, 60)
                    .into_iter()
                    .filter(|a| !self.fits(&under, a))
                    .take(12)
                    .collect();
                if answers.len() < 3 {
                    continue;
                }
                let bases = change::all(answers[0].question.is_line(), self.drawer.rules().len());
                for (near, base) in self.rank(bases, &answers, &under).into_iter().take(3) {
                    if near.exact * 3 > answers.len() && !self.drawer.work().is_done() {
                        let start = Model { chain: vec![always(&base)], ..Model::default() };
                        tried.push(self.tried(self.with_steps(&start, 2, 1)));
                    }
                }
            }
        }
    }

    /// Adds the pixel rule that explains most, again and again, each by the facts of what is then predicted. The order of
    /// rules matters: the best first ones are each followed to the end.
    fn with_steps(&self, model: &Model, most: usize, beam: usize) -> Model {
        // Different ways through a search come to the same model.
        let followed = Followed { model: model.clone(), most, beam };
        let is_done = self.followed.borrow().iter().any(|other| other.contains(&followed));
        if is_done {
            return model.clone();
        }
        self.followed.borrow_mut().push(followed);
        let few = |wrong| self.some(wrong, 40);
        let all = || [true, false].into_iter().flat_map(few);
        let score = |model: &Model| {
            let fit = |some: Vec<&LearnedAnswer>| {
                let all = some.len().max(1) as f64;
                some.into_iter().filter(|a| self.fits(model, a)).count() as f64 / all
            };
            0.75 * fit(few(true)) + 0.25 * fit(few(false)) - 0.012 * model.cost() as f64
        };
        let mut done = vec![(score(model), model.clone())];
        let mut alive = vec![model.clone()];
        for _ in (0..most).take_while(|_| !self.drawer.work().is_done()) {
            let mut grown = Vec::new();
            for model in &alive {
                let is_first = model.steps.is_empty();
                let kept = if is_first { beam } else { 1 };
                let candidates =
                    self.candidates(model, 3, if is_first && beam > 1 { 2 } else { 1 });
                grown.extend(candidates.into_iter().take(kept).map(|step| model.with(step)));
            }
            done.extend(grown.iter().map(|model| (score(model), model.clone())));
            alive = grown;
            if alive.iter().any(|model| all().all(|a| self.fits(model, a))) {
                break;
            }
        }
        let best = done.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a });
        best.map_or_else(Model::default, |(_, model)| model)
    }

    /// The pixel rules that explain most of what a model leaves wrong.
    fn candidates(&self, model: &Model, most: usize, wanted: usize) -> Vec<Step> {
        let mut all = Vec::new();
        let tables = self.tables(model);
        for (wrong, table) in Wrong::ALL.into_iter().zip(&*tables) {
            let terms = Terms { most, need: NEED, slack: 0, wanted };
            if table.yes.len() >= NEED {
                let found = rule::best(&self.vocabulary.names, table, terms, self.drawer.work());
                all.extend(found.into_iter().map(|f| (f.rows, Step { wrong, facts: f.facts })));
            }
        }
        all.sort_by_key(|(rows, _)| std::cmp::Reverse(*rows));
        all.into_iter().map(|(_, step)| step).collect()
    }

    /// The pixels that a model predicts wrongly in each way, and those that it predicts well and that could be: empty where
    /// hardly any is wrong in this way.
    pub(super) fn tables(&self, model: &Model) -> Rc<[Table; 3]> {
        if *model == Model::default() {
            return Rc::clone(self.first.get_or_init(|| Rc::new(self.new_tables(model))));
        }
        Rc::new(self.new_tables(model))
    }

    fn new_tables(&self, model: &Model) -> [Table; 3] {
        let some =
            [true, false].map(|is_wrong| self.some(is_wrong, LEARNED_FROM[usize::from(!is_wrong)]));
        let predicted = |a| Some((a, model.predict(a, self.drawer, self.vocabulary)?));
        let some: Vec<_> = some.into_iter().flatten().map(predicted).collect();
        Wrong::ALL.map(|wrong| {
            let mut table = Table::default();
            let of_each = some.iter().flatten();
            let is_one =
                |(a, before): &(&LearnedAnswer, Picture)| wrong_pixels(a, before, wrong).count();
            if of_each.map(is_one).sum::<usize>() < NEED {
                return table;
            }
            for (group, (a, before)) in
                some.iter().enumerate().filter_map(|(i, a)| Some((i, a.as_ref()?)))
            {
                self.add_pixels(&mut table, group, a, before, wrong);
            }
            table
        })
    }

    fn add_pixels(
        &self,
        table: &mut Table,
        group: usize,
        a: &LearnedAnswer,
        before: &Picture,
        wrong: Wrong,
    ) {
        let scene = Scene::new(&a.question, before, self.drawer.sample());
        let yes: Vec<_> = wrong_pixels(a, before, wrong).collect();
        let is_no =
            |at: &[i32; 2]| wrong.may_befall(before.hits(*at)) && !wrong.is_seen(a.drawn.hits(*at));
        let row = |at: [i32; 2]| {
            self.drawer.work().spend(ALL_OF_A_PIXEL);
            let mut row = Quantities { values: a.facts.clone(), ..Quantities::default() };
            scene.of_pixel(at, &mut row);
            row.values
        };
        let step = |len: usize| len.div_ceil(MOST_OF_ONE).max(1);
        let number = yes.len().div_ceil(step(yes.len()));
        table.groups.extend(std::iter::repeat_n(group, number));
        table.yes.extend(yes.iter().step_by(step(yes.len())).map(|at| row(*at)));
        // Those beside the shape tell more than those far away.
        let is_near = |at: &[i32; 2]| {
            let beside = [[1, 0], [-1, 0], [0, 1], [0, -1]].map(|[x, y]| [at[0] + x, at[1] + y]);
            beside.iter().any(|b| before.has(*b) || a.drawn.has(*b))
        };
        let (near, far): (Vec<_>, Vec<_>) = before.pixels().filter(is_no).partition(is_near);
        for (pixels, most) in [(near, MOST_OF_ONE), (far, MOST_OF_ONE / 3)] {
            let step = pixels.len().div_ceil(most).max(1);
            table.no.extend(pixels.iter().step_by(step).map(|at| row(*at)));
        }
    }

    /// A model with a base before its others: where it holds is learned from the answers that one of both predicts alone. Of
    /// each answer it is known whether the model fits.
    fn guarded(&self, model: &Model, fitting: &[bool], base: &Base) -> Option<Model> {
        let alone = Model { chain: vec![always(base)], ..model.clone() };
        let mut table = Table::default();
        // What refuted a model comes first, so that it is among these.
        let mut left = GUARDED_BY;
        for ((number, a), &fits) in self.answered.iter().enumerate().zip(fitting) {
            let left = &mut left[usize::from(!a.is_wrong())];
            if *left == 0 {
                continue;
            }
            *left -= 1;
            match [self.fits(&alone, a), fits] {
                [true, false] => {
                    table.yes.push(a.facts.clone());
                    table.groups.push(number);
                }
                [false, true] => table.no.push(a.facts.clone()),
                _ => {}
            }
        }
        let with = |when| {
            let mut more = model.clone();
            more.chain.insert(0, GuardedStep { when, base: base.clone() });
            more
        };
        match (table.yes.is_empty(), table.no.is_empty()) {
            (true, _) => None,
            (_, true) => Some(with(None)),
            _ => self.guard(table, self.of_question()).map(|guard| with(Some(guard))),
        }
    }

    /// The names of the facts of a question.
    fn of_question(&self) -> &[Name] {
        &self.vocabulary.names[..self.vocabulary.of_question]
    }

    /// Up to three conjunctions of facts that cover what they should.
    fn guard(&self, mut table: Table, names: &[Name]) -> Option<Vec<Conjunction>> {
        let mut guard = Vec::new();
        while !table.yes.is_empty() && guard.len() < 3 {
            let terms = Terms { most: 3, need: 2, slack: 0, wanted: 1 };
            let found = rule::best(names, &table, terms, self.drawer.work()).into_iter().next();
            let Some(found) = found else { break };
            table.yes.retain(|row| !all_hold(&found.facts, row));
            table.groups.truncate(table.yes.len());
            guard.push(found.facts);
        }
        (!guard.is_empty()).then_some(guard)
    }

    /// Leaves out a base, a guard, a step or a fact wherever all that was predicted stays predicted.
    pub(super) fn pruned(&self, mut model: Model) -> Model {
        let some: Vec<&LearnedAnswer> = self.answered.iter().take(300).collect();
        let fitting = |model: &Model| some.iter().filter(|a| self.fits(model, a)).count();
        let mut most = fitting(&model);
        loop {
            let mut shorter = shorter(&model);
            shorter.sort_by_key(Model::cost);
            let next = shorter.into_iter().find(|m| fitting(m) >= most);
            match next {
                Some(next) => {
                    most = fitting(&next);
                    model = next;
                }
                None => return model,
            }
        }
    }
}

/// The pixels of an answer that are predicted, and wrong in a way.
fn wrong_pixels(
    a: &LearnedAnswer,
    before: &Picture,
    wrong: Wrong,
) -> impl Iterator<Item = [i32; 2]> {
    before
        .pixels()
        .filter(move |at| wrong.may_befall(before.hits(*at)) && wrong.is_seen(a.drawn.hits(*at)))
}

/// Lines by which walks are compared are shorter than this.
const SHORT_LINE: i64 = 512;

/// A formula with its worth, and the number of the rounding of heights that it is for.
struct Climb {
    worth: f64,
    crossing: Crossing,
    number: usize,
}

impl Climb {
    fn highest_first(a: &Self, b: &Self) -> std::cmp::Ordering {
        b.worth.total_cmp(&a.worth)
    }
}

/// A formula that breaks at most this part of the borders that it explains needs no guard.
const FEW_BROKEN: usize = 10;
/// The most formulas of borders in a model.
const MOST_BORDERS: usize = 4;

fn best(tried: &[Tried]) -> &Tried {
    tried.iter().skip(1).fold(&tried[0], higher)
}

fn higher<'a>(a: &'a Tried, b: &'a Tried) -> &'a Tried {
    if b.score() > a.score() { b } else { a }
}

fn always(base: &Base) -> GuardedStep {
    GuardedStep { when: None, base: base.clone() }
}
