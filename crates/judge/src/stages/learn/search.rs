//! The search for the chain that predicts most of the answers.

use std::cell::{OnceCell, RefCell};
use std::cmp::Reverse;
use std::collections::HashSet;
use std::rc::Rc;

use rasterproof_verify::convention::Count;
use rasterproof_verify::learn::rows::{
    Condition, ConditionTerms, Examples, Quantities, Vocabulary,
};
use rasterproof_verify::learn::trial::Work;

use super::chain::{Chain, GuardedChange, cost, row, shorter};
use super::learnable::{AnyChange, AnyLearnable, AnyParts, LearnedCase, of_case, spread};
use crate::declared::Declared;

/// The most steps of a chain, the changes of which are tried for each, and those that are combined in pairs.
const MOST_STEPS: usize = 3;
const MOST_CHANGES: usize = 4;
const PAIRED: usize = 10;
/// Wrong parts by which changes are ranked; parts from which conditions are learned, wrong ones and right ones.
const RANKED_BY: usize = 160;
const LEARNED_FROM: [usize; 2] = [220, 440];
/// Right parts that are looked at for what a condition breaks.
const CHECKED: usize = 4000;
/// Conditions of a step at most.
const MOST_CONDITIONS: usize = 3;
const WHEN: ConditionTerms = ConditionTerms { facts: 3, questions: 3, slack: 0 };
/// What holds mostly, for sentences about a program that no chain explains.
const MOSTLY: ConditionTerms = ConditionTerms { facts: 2, questions: 3, slack: 30 };
/// How often a condition is learned anew with what refuted it.
const CORRECTIONS: usize = 2;

/// Parts of one answer that are looked at, wrong ones and right ones; of one that refuted a chain so many times as many.
const PARTS_OF_ONE: [usize; 2] = [60, 30];
const OF_REFUTING: usize = 8;

/// Steps of [`Work`] for a look at whether a change explains a part, and for all quantities of one.
const PART: usize = 60;
const ALL_OF_A_PART: usize = 600;

/// Wrong parts of which a change explains one, or is left aside.
const FEW: usize = 16;

/// What is computed once of a change: which parts it explains, and the quantities of those that are looked at.
struct Looked {
    change: AnyChange,
    explained: Vec<bool>,
    rows: Vec<OnceCell<Vec<i64>>>,
}

/// A change with the wrong parts that it explains: how many, and which.
struct RankedChange {
    change: AnyChange,
    count: usize,
    explained: Vec<bool>,
}

/// A chain with its score.
struct ScoredChain {
    score: f64,
    chain: Chain,
}

/// The parts of all answers; a part is meant by its place.
pub(super) struct Search<'a> {
    stage: &'a dyn AnyLearnable,
    answered: &'a [LearnedCase],
    parts: Box<dyn AnyParts<'a> + 'a>,
    /// The question of each part, by its number.
    questions: Vec<usize>,
    /// Whether each part is right.
    is_right: Vec<bool>,
    /// Whether an answer has right parts alone.
    is_whole_right: Vec<bool>,
    /// What is computed once of each change.
    looked: RefCell<Vec<Rc<Looked>>>,
    /// What the quantities of a row are called.
    names: Vocabulary,
    /// How many of these are the quantities of the question; those of the part come after them.
    of_question: usize,
    work: &'a Work,
}

impl<'a> Search<'a> {
    /// Takes all answers apart. The parts keep their places, by which everything else means them.
    pub(super) fn of(
        stage: &'a dyn AnyLearnable,
        answered: &'a [LearnedCase],
        declared: &Declared,
        work: &'a Work,
    ) -> Self {
        // Of each answer some parts, each with its question and whether it is right.
        let mut parts = stage.no_parts();
        let (mut questions, mut is_right) = (Vec::new(), Vec::new());
        let mut is_whole_right = vec![true; answered.len()];
        for (question, asked) in answered.iter().enumerate() {
            let times = if asked.is_refuting { OF_REFUTING } else { 1 };
            parts.add_some(asked, declared, PARTS_OF_ONE.map(|most| times * most));
            for place in questions.len()..parts.count() {
                questions.push(question);
                is_right.push(parts.is_right(place));
                is_whole_right[question] &= is_right[place];
            }
        }
        // All rows have the same quantities, so the names of the first one's will do.
        let mut named = Quantities::default();
        if let Some(first) = answered.first() {
            named = of_case(stage, &first.case, declared, true);
        }
        let of_question = named.values.len();
        if parts.count() > 0 {
            parts.of_part(0, None, &mut named);
        }
        let (looked, names) = (RefCell::default(), Vocabulary::of(named));
        Self {
            stage,
            answered,
            parts,
            questions,
            is_right,
            is_whole_right,
            looked,
            names,
            of_question,
            work,
        }
    }

    /// What is computed once of a change, which is found again by its address.
    fn looked(&self, change: &AnyChange) -> Rc<Looked> {
        for looked in self.looked.borrow().iter() {
            if Rc::ptr_eq(&looked.change, change) {
                return Rc::clone(looked);
            }
        }
        let count = self.parts.count();
        self.work.spend(count * PART);
        let explained = (0..count).map(|place| self.parts.explains(change, place)).collect();
        let rows = vec![OnceCell::new(); count];
        let looked = Rc::new(Looked { change: Rc::clone(change), explained, rows });
        self.looked.borrow_mut().push(Rc::clone(&looked));
        looked
    }

    /// The quantities of a part and of what a change makes of it.
    fn row<'l>(&self, looked: &'l Looked, place: usize) -> &'l [i64] {
        looked.rows[place].get_or_init(|| {
            self.work.spend(ALL_OF_A_PART);
            self.row_with(place, Some(&looked.change))
        })
    }

    /// The row of a part, with or without what a change makes of it.
    fn row_with(&self, place: usize, change: Option<&AnyChange>) -> Vec<i64> {
        row(&self.answered[self.questions[place]], &*self.parts, place, change)
    }

    /// Whether any of some conditions holds of what a change makes of a part.
    fn any_holds(&self, conditions: &[Condition], looked: &Looked, place: usize) -> bool {
        conditions.iter().any(|condition| condition.holds(self.row(looked, place)))
    }

    /// Whether a chain predicts each part.
    fn predicted(&self, chain: &Chain) -> Vec<bool> {
        // Without a step, what is right is predicted. Each step from the last to the first then decides before those after it.
        let mut predicted = self.is_right.clone();
        for GuardedChange { when, change } in chain.iter().rev() {
            let looked = self.looked(change);
            for (place, is_predicted) in predicted.iter_mut().enumerate() {
                // A condition is looked at where it matters.
                if looked.explained[place] != *is_predicted {
                    *is_predicted ^= when.is_empty() || self.any_holds(when, &looked, place);
                }
            }
        }
        predicted
    }

    /// The share of wrong and of right answers that a chain predicts, against what it says.
    fn score(&self, chain: &Chain) -> f64 {
        // An answer is predicted where all of its parts are.
        let mut fits = vec![true; self.answered.len()];
        for (question, is_predicted) in self.questions.iter().zip(self.predicted(chain)) {
            fits[*question] &= is_predicted;
        }
        let mut counts = [Count::default(); 2];
        for (&fits, &is_right) in fits.iter().zip(&self.is_whole_right) {
            counts[usize::from(is_right)].add(fits);
        }
        let [wrong, right] = counts.map(|c| c.drawn as f64 / c.of.max(1) as f64);
        0.75 * wrong + 0.25 * right - 0.004 * cost(chain) as f64
    }

    /// The chain that predicts most.
    pub(super) fn explain(&self) -> Chain {
        let mut best = ScoredChain { score: self.score(&Vec::new()), chain: Vec::new() };
        for _ in 0..MOST_STEPS {
            if self.work.is_done() {
                break;
            }
            // A step that makes it no better is the last one that is looked for.
            match self.with_step(&best.chain) {
                Some(longer) if longer.score > best.score => best = longer,
                _ => break,
            }
        }
        self.pruned(best)
    }

    /// With the step before the others that explains most of what they do not.
    fn with_step(&self, chain: &Chain) -> Option<ScoredChain> {
        // What the chain predicts already must stay as it is; the new step is for the rest.
        let predicted = self.predicted(chain);
        let (mut held, mut left) = (Vec::new(), Vec::new());
        for (place, is_predicted) in predicted.into_iter().enumerate() {
            if is_predicted { &mut held } else { &mut left }.push(place);
        }
        if left.is_empty() {
            return None;
        }
        // Each change gets the conditions that suit it, and the best chain of all is kept.
        let mut best: Option<ScoredChain> = None;
        for change in self.ranked(&spread(&left, RANKED_BY), &spread(&held, 4 * RANKED_BY)) {
            let Some(when) = self.when(&change, &left, &held) else { continue };
            let mut longer = chain.clone();
            longer.insert(0, GuardedChange { when, change });
            let score = self.score(&longer);
            if best.as_ref().is_none_or(|best| score > best.score) {
                best = Some(ScoredChain { score, chain: longer });
            }
        }
        best
    }

    /// The changes that explain most of some wrong parts, each another set of them.
    fn ranked(&self, wrong: &[usize], right: &[usize]) -> Vec<AnyChange> {
        let mut ranked = self.rank(self.parts.changes(wrong, right, self.work), wrong);
        // Where none explains all of them, two at once may: one of the best with any other.
        let most = ranked.first().map_or(0, |best| best.count);
        if most < wrong.len() {
            let mut pairs = Vec::new();
            for second in &ranked {
                for first in ranked.iter().take(PAIRED) {
                    pairs.extend(self.stage.both(&first.change, &second.change));
                }
            }
            let mut pairs = self.rank(pairs, wrong);
            pairs.retain(|pair| pair.count > most);
            ranked.append(&mut pairs);
            ranked.sort_by_key(|ranked| Reverse(ranked.count));
        }
        // Of changes that explain the same parts, the simplest stands first.
        let mut seen = HashSet::new();
        let mut changes = Vec::new();
        for RankedChange { change, explained, .. } in ranked {
            if changes.len() < MOST_CHANGES && seen.insert(explained) {
                changes.push(change);
            }
        }
        changes
    }

    /// Changes by how many wrong parts they explain; those that explain hardly any are left out.
    fn rank(&self, changes: Vec<AnyChange>, wrong: &[usize]) -> Vec<RankedChange> {
        let mut ranked = Vec::new();
        // A look at a few parts leaves most changes aside before they cost anything.
        let few = spread(wrong, FEW);
        self.work.spend(changes.len() * few.len() * PART);
        for change in changes {
            if !few.iter().any(|place| self.parts.explains(&change, *place)) {
                continue;
            }
            self.work.spend(wrong.len() * PART);
            let (mut explained, mut count) = (Vec::new(), 0);
            for &place in wrong {
                let is_explained = self.parts.explains(&change, place);
                explained.push(is_explained);
                count += usize::from(is_explained);
            }
            ranked.push(RankedChange { change, count, explained });
        }
        ranked.sort_by_key(|ranked| Reverse(ranked.count));
        ranked
    }

    /// The conditions under which a change explains what a chain does not, and breaks nothing; none where it never breaks
    /// anything.
    fn when(&self, change: &AnyChange, left: &[usize], held: &[usize]) -> Option<Vec<Condition>> {
        let looked = self.looked(change);
        // Where the change would help, and where it would break what is right now.
        let mut yes = left.to_vec();
        yes.retain(|place| looked.explained[*place]);
        let mut no = held.to_vec();
        no.retain(|place| !looked.explained[*place]);
        if no.is_empty() {
            return (!yes.is_empty()).then(Vec::new);
        }
        if self.work.is_done() {
            return None;
        }
        let mut examples = Examples::default();
        for place in spread(&yes, LEARNED_FROM[0]) {
            examples.should(self.row(&looked, place).to_vec(), self.questions[place]);
        }
        // Conditions are learned from some of both, and then tried on many more.
        let mut some = spread(&no, LEARNED_FROM[1]);
        for round in 0..CORRECTIONS {
            for place in some {
                examples.should_not(self.row(&looked, place).to_vec());
            }
            let conditions = examples.any_of(&self.names, WHEN, MOST_CONDITIONS, self.work);
            if conditions.is_empty() {
                return None;
            }
            // What a condition holds of that it should not is learned from, too.
            some = Vec::new();
            for place in spread(&no, CHECKED) {
                if some.len() == LEARNED_FROM[0] {
                    break;
                }
                if self.any_holds(&conditions, &looked, place) {
                    some.push(place);
                }
            }
            if some.is_empty() || round + 1 == CORRECTIONS {
                return Some(conditions);
            }
        }
        None
    }

    /// Leaves out a step, a condition or a fact wherever the score does not become worse.
    fn pruned(&self, mut best: ScoredChain) -> Chain {
        loop {
            // Of all chains that say one thing less, the one that predicts most.
            let mut found: Option<ScoredChain> = None;
            for chain in shorter(&best.chain) {
                let score = self.score(&chain);
                // Of equal scores the last one is kept.
                if found.as_ref().is_none_or(|found| score >= found.score) {
                    found = Some(ScoredChain { score, chain });
                }
            }
            match found {
                Some(less) if less.score > best.score => best = less,
                _ => return best.chain,
            }
        }
    }

    /// What a chain does, a sentence for each step.
    pub(super) fn sentences(&self, chain: &Chain) -> Vec<String> {
        let mut out: Vec<String> = Vec::new();
        for GuardedChange { when, change } in chain {
            // A step without conditions is done everywhere, or wherever the steps before it are not.
            let words: Vec<_> = when.iter().map(|all| all.words(&self.names)).collect();
            let place = match words[..] {
                [] => String::new(),
                _ => format!(" where {}", words.join("; or where ")),
            };
            let it = if out.is_empty() { "It" } else { "Elsewhere, it" };
            out.push(format!("{it} {}{place}.", self.stage.says(change)));
        }
        out
    }

    /// What is known where no chain predicts every answer: when answers are wrong, and where in them.
    pub(super) fn known(&self) -> Vec<String> {
        self.known_of_questions().into_iter().chain(self.known_of_parts()).collect()
    }

    /// When answers are wrong, by the quantities of their questions.
    fn known_of_questions(&self) -> Option<String> {
        let mut examples = Examples::default();
        // An answer is one example here, whatever the number of its parts.
        for (number, asked) in self.answered.iter().enumerate() {
            match self.is_whole_right[number] {
                true => examples.should_not(asked.facts.clone()),
                false => examples.should(asked.facts.clone(), number),
            }
        }
        let names = self.names.first(self.of_question);
        let when = examples.best(&names, MOSTLY, self.work)?;
        let ([wrong, right], [of_wrong, of_right]) = (examples.held(&when), examples.counts());
        // What holds of few says nothing.
        if 2 * wrong < of_wrong {
            return None;
        }
        let when = when.words(&names);
        Some(format!(
            "Mostly wrong where {when}: this holds for {wrong} of {of_wrong} wrong answers and {right} of {of_right} right ones."
        ))
    }

    /// Where in wrong answers the wrong parts are, by the quantities of parts.
    fn known_of_parts(&self) -> Option<String> {
        // The parts of wrong answers alone: those of right ones say nothing about the place.
        let (mut right, mut wrong) = (Vec::new(), Vec::new());
        for (place, question) in self.questions.iter().enumerate() {
            if !self.is_whole_right[*question] {
                if self.is_right[place] { &mut right } else { &mut wrong }.push(place);
            }
        }
        let mut examples = Examples::default();
        for place in spread(&wrong, LEARNED_FROM[0]) {
            examples.should(self.row_with(place, None), self.questions[place]);
        }
        for place in spread(&right, LEARNED_FROM[1]) {
            examples.should_not(self.row_with(place, None));
        }
        let place = examples.best(&self.names, MOSTLY, self.work)?;
        let ([wrong, right], [of_wrong, of_right]) = (examples.held(&place), examples.counts());
        if 2 * wrong < of_wrong || of_right == 0 {
            return None;
        }
        let (part, place) = (self.stage.part_name(), place.words(&self.names));
        Some(format!(
            "In wrong answers, the wrong {part}s are mostly those where {place}: {wrong} of {of_wrong} wrong ones and {right} of {of_right} right ones."
        ))
    }
}
