//! The covering design: cases chosen one after the other so that every pair of classes occurs, and of the triples as many as
//! possible.
//!
//! Cases come in blocks of [`BLOCK`]. The first block has every pair of classes that can occur. In block k some triples are
//! looked for that hold a class of fact k - 1. A
//! block depends on its number, the seed and the limits alone: case n is found again without the blocks before it. Whoever asks for
//! a few cases of a block waits for 50 at most beyond these.
//!
//! The choice is greedy. Of a few candidates the one is taken that has most pairs that are missing, then most triples. After
//! `BY_TRIPLES` blocks hardly a triple is missing, and the one is taken that has most quadruples. Some are drawn
//! at random, and more are made of two cases that were chosen, each the example of a class, so that rare classes have their turn as
//! often as frequent ones. What is rare is looked for beside cases that have a part of it. Which pairs cannot occur was found by a search that was much longer, and is
//! data ([`impossible`]).

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use rasterproof_core::random::Rng;

use super::Topic;
use super::table::Table;
use crate::cases::{Case, Limits};

/// Cases of a block.
pub const BLOCK: u64 = 1000;
/// Cases that a block grows by, a part of [`BLOCK`].
const GROWS_BY: usize = 50;
/// Blocks whose cases are chosen by pairs and triples; those of later ones are chosen by quadruples.
const BY_TRIPLES: u64 = 20;
/// Cases of a block that are chosen before what is rare is looked for.
const EASY: u64 = 150;
/// Candidates at a time for something rare.
const AT_ONCE: usize = 8;
/// How many things that are missing are few, how many turns they get for one case, and how many in all beyond the effort: within
/// limits some of them cannot occur.
const FEW: usize = 16;
const MANY_TURNS: usize = 100;
const MOST_TURNS: usize = 6000;
/// Questions that are drawn until one has facts.
const MOST_DRAWN: usize = 10_000;
/// Cases that are remembered of each class, to look beside them.
const REMEMBERED: usize = 30;
/// Changes from a chosen case to a candidate made of it and another one.
const CHANGES: usize = 4;
/// Blocks that are kept for whoever asks for their cases next: those of 20,000 cases of three designs.
const KEPT: usize = 64;

/// The third power of the number of classes for which one more candidate is made of two cases: 60 where there are 134 classes, and 4
/// where there are 53.
const CLASSES_CUBED_TO_ONE: usize = 40_000;

/// How many candidates there are for each case.
struct Effort {
    /// Those that are drawn at random.
    drawn: usize,
    /// Those that are made of two cases that were chosen.
    made: usize,
    /// Things that are wanted, with [`AT_ONCE`] candidates each.
    wanted: usize,
    /// By combinations of how many classes a candidate is chosen; by larger ones where several are alike by smaller ones.
    together: &'static [usize],
}

const PAIRS_AND_TRIPLES: &[usize] = &[2, 3];
const QUADRUPLES: &[usize] = &[4];

impl Effort {
    /// Every pair has to be in the first block, and nearly every triple in the first two: so many classes have more or fewer of
    /// them. The other blocks add rare triples.
    fn of_block(number: u64, classes: usize) -> Self {
        let made = classes.pow(3) / CLASSES_CUBED_TO_ONE;
        match number {
            0 => Self { drawn: 6, made, wanted: 8, together: PAIRS_AND_TRIPLES },
            1 => Self { drawn: 2, made, wanted: 1, together: PAIRS_AND_TRIPLES },
            2..BY_TRIPLES => Self { drawn: 2, made: 0, wanted: 1, together: PAIRS_AND_TRIPLES },
            _ => Self { drawn: 2, made: 2, wanted: 1, together: QUADRUPLES },
        }
    }
}

/// A question with its classes.
struct Candidate<Q> {
    case: Q,
    classes: Vec<u16>,
}

/// A pair or a triple of classes that is missing, in ascending order.
type Wanted = Vec<u16>;

struct Chooser<Q: 'static, L: 'static> {
    topic: Topic<Q, L>,
    limits: L,
    rng: Rng,
    effort: Effort,
    /// The fact of whose classes triples are looked for; pairs are, where there is none.
    third: Option<usize>,
    /// Pairs that are not looked for, since a long search has not found them; in ascending order.
    impossible: Vec<[u16; 2]>,
    table: Table,
    /// The cases of the block so far.
    chosen: Vec<Q>,
    /// The numbers of some of them, for each class.
    examples: Vec<Vec<usize>>,
    /// What is missing, in the order in which it is looked for.
    wanted: VecDeque<Wanted>,
    /// Turns beyond the effort of a case that are left for the block.
    more_turns: usize,
}

impl<Q: Clone, L: Clone> Chooser<Q, L> {
    /// Of a block that is chosen with this effort, from the seed and the number of the block.
    fn new(
        effort: Effort,
        impossible: Vec<[u16; 2]>,
        topic: &Topic<Q, L>,
        [seed, number]: [u64; 2],
        limits: &L,
    ) -> Self {
        let facts = topic.starts().len() as u64;
        let all = topic.count();
        // No candidate is chosen by larger combinations.
        let largest = effort.together.iter().copied().fold(3, usize::max);
        Self {
            topic: *topic,
            limits: limits.clone(),
            rng: Rng::new(topic.name, seed, number),
            effort,
            third: number.checked_sub(1).map(|number| (number % facts) as usize),
            impossible,
            table: Table::new(all, largest),
            chosen: Vec::with_capacity(BLOCK as usize),
            examples: vec![Vec::new(); all],
            wanted: VecDeque::new(),
            more_turns: if number == 0 { MOST_TURNS } else { 0 },
        }
    }

    /// Chooses cases until there are so many.
    fn grow(&mut self, count: usize) {
        while self.chosen.len() < count {
            if self.chosen.len() as u64 == EASY {
                self.list_wanted();
            }
            let chosen = self.choose().expect("what is drawn has facts, put within any limits");
            self.note(chosen);
        }
    }

    /// A case put within the limits; none where nothing is left of it.
    fn candidate(&self, case: Q) -> Option<Candidate<Q>> {
        let case = (self.topic.put)(&self.limits, case);
        let classes = self.topic.classes(&case, &self.limits)?;
        Some(Candidate { case, classes })
    }

    /// Chooses the next case: of some candidates the one that has most of what is missing.
    fn choose(&mut self) -> Option<Candidate<Q>> {
        let mut candidates = Vec::new();
        for _ in 0..self.effort.drawn {
            candidates.extend(self.drawn());
        }
        for _ in 0..self.effort.made {
            candidates.extend(self.made_of_two());
        }
        // The last few are the rarest.
        let turns = match self.wanted.len() {
            0..FEW if self.more_turns > 0 => MANY_TURNS,
            _ => self.effort.wanted,
        };
        self.more_turns = self.more_turns.saturating_sub(turns - self.effort.wanted);
        for _ in 0..turns {
            let Some(wanted) = self.next_wanted() else { break };
            let is_found = self.look_for(&wanted, &mut candidates);
            // It is looked for again when all others had their turn, if another candidate is better.
            self.wanted.push_back(wanted);
            if is_found {
                break;
            }
        }
        // Hardly anything that is drawn may be left within narrow limits.
        for _ in 0..MOST_DRAWN {
            if !candidates.is_empty() {
                break;
            }
            candidates.extend(self.drawn());
        }
        self.best(candidates)
    }

    /// The first candidate with most combinations that are missing.
    fn best(&self, mut candidates: Vec<Candidate<Q>>) -> Option<Candidate<Q>> {
        for together in self.effort.together {
            // Counting larger ones takes longer, so that it is done for the best alone.
            if candidates.len() == 1 {
                break;
            }
            let missing = |of: &Candidate<Q>| self.table.missing(*together, &of.classes);
            let counts: Vec<usize> = candidates.iter().map(missing).collect();
            let most = counts.iter().max().copied();
            let mut counts = counts.into_iter();
            candidates.retain(|_| counts.next() == most);
        }
        candidates.into_iter().next()
    }

    /// A candidate drawn at random.
    fn drawn(&mut self) -> Option<Candidate<Q>> {
        let case = (self.topic.draw)(&mut self.rng);
        self.candidate(case)
    }

    /// The next thing that is still missing.
    fn next_wanted(&mut self) -> Option<Wanted> {
        loop {
            let wanted = self.wanted.pop_front()?;
            if !self.table.has(&wanted) {
                return Some(wanted);
            }
        }
    }

    /// Draws candidates beside cases that have a part of what is wanted, until one has all of it. Whether one had.
    fn look_for(&mut self, wanted: &Wanted, candidates: &mut Vec<Candidate<Q>>) -> bool {
        let mut nearest: Option<(usize, Q)> = None;
        for _ in 0..AT_ONCE {
            let Some([one, other]) = self.examples_of(wanted) else { return false };
            // What already has most of it is a good start, too.
            let one = match &nearest {
                Some((_, nearest)) if self.rng.chance(2) => nearest,
                _ => &self.chosen[one],
            };
            let case = (self.topic.vary)(&mut self.rng, one, &self.chosen[other]);
            let Some(candidate) = self.candidate(case) else { continue };
            let has = wanted.iter().filter(|class| candidate.classes.contains(class)).count();
            let is_found = has == wanted.len();
            if !is_found && nearest.as_ref().is_none_or(|(most, _)| has >= *most) {
                nearest = Some((has, candidate.case.clone()));
            }
            // It may have something else that is missing.
            if is_found || self.table.missing(2, &candidate.classes) > 0 {
                candidates.push(candidate);
            }
            if is_found {
                return true;
            }
        }
        false
    }

    /// A candidate made of two cases that are examples of any classes.
    fn made_of_two(&mut self) -> Option<Candidate<Q>> {
        let last = self.examples.len() as i64 - 1;
        let classes = [(); 2].map(|()| self.rng.int(0, last) as u16);
        let [one, other] = self.examples_of(&classes)?;
        let other = &self.chosen[other];
        let mut case = (self.topic.vary)(&mut self.rng, &self.chosen[one], other);
        for _ in 1..CHANGES {
            case = (self.topic.vary)(&mut self.rng, &case, other);
        }
        self.candidate(case)
    }

    /// The numbers of two cases that have one of some classes each; none where a class has no case.
    fn examples_of(&mut self, wanted: &[u16]) -> Option<[usize; 2]> {
        let mut example = || {
            let class = wanted[self.rng.int(0, wanted.len() as i64 - 1) as usize];
            let examples = &self.examples[usize::from(class)];
            let last = examples.len().checked_sub(1)?;
            Some(examples[self.rng.int(0, last as i64) as usize])
        };
        Some([example()?, example()?])
    }

    /// Notes what a chosen case has, and keeps it as an example of its classes.
    fn note(&mut self, chosen: Candidate<Q>) {
        self.table.note(&chosen.classes);
        for class in &chosen.classes {
            let examples = &mut self.examples[usize::from(*class)];
            if examples.len() < REMEMBERED {
                examples.push(self.chosen.len());
            } else if self.rng.chance(REMEMBERED as i64) {
                let at = self.rng.int(0, REMEMBERED as i64 - 1) as usize;
                examples[at] = self.chosen.len();
            }
        }
        self.chosen.push(chosen.case);
    }

    /// Lists what can occur and is missing, in random order: the pairs, or some triples that hold a class of a fact.
    fn list_wanted(&mut self) {
        let mut wanted = match self.third {
            None => self.all_pairs(),
            Some(fact) => self.some_triples(fact),
        };
        let is_possible = |classes: &Wanted| {
            let mut pairs =
                (1..classes.len()).flat_map(|at| (0..at).map(move |before| [before, at]));
            pairs.all(|pair| self.impossible.binary_search(&pair.map(|at| classes[at])).is_err())
        };
        wanted.retain(|classes| !self.table.has(classes) && is_possible(classes));
        for last in (1..wanted.len()).rev() {
            wanted.swap(last, self.rng.int(0, last as i64) as usize);
        }
        self.wanted = wanted.into();
    }

    /// The pairs of classes of two facts.
    fn all_pairs(&self) -> Vec<Wanted> {
        let facts = self.topic.facts_of_classes();
        let mut pairs = Vec::new();
        for second in 0..facts.len() {
            for first in (0..second).filter(|first| facts[*first] != facts[second]) {
                pairs.push(vec![first as u16, second as u16]);
            }
        }
        pairs
    }

    /// As many triples as a block has cases, each of a class of this fact and of classes of two others.
    fn some_triples(&mut self, fact: usize) -> Vec<Wanted> {
        let mut starts = self.topic.starts();
        let facts = starts.len();
        starts.push(self.examples.len());
        let mut triples = Vec::new();
        for _ in 0..BLOCK {
            let mut chosen = vec![fact];
            while chosen.len() < 3 {
                let other = self.rng.int(0, facts as i64 - 1) as usize;
                if !chosen.contains(&other) {
                    chosen.push(other);
                }
            }
            chosen.sort_unstable();
            let mut class = |fact: &usize| {
                self.rng.int(starts[*fact] as i64, starts[fact + 1] as i64 - 1) as u16
            };
            triples.push(chosen.iter().map(&mut class).collect());
        }
        triples
    }
}

/// The pairs of classes that cannot occur, in ascending order: a long search has not found them.
#[must_use]
pub fn impossible<Q, L>(topic: &Topic<Q, L>) -> Vec<[u16; 2]> {
    let mut pairs = Vec::new();
    for line in topic.impossible.lines() {
        let mut numbers = line.split_ascii_whitespace().filter_map(|word| word.parse().ok());
        let Some(first) = numbers.next() else { continue };
        pairs.extend(numbers.map(|second| [first, second]));
    }
    pairs
}

/// The questions of a block.
#[must_use]
pub fn block<Q: Clone, L: Clone>(
    topic: &Topic<Q, L>,
    seed: u64,
    number: u64,
    limits: &L,
) -> Vec<Q> {
    let effort = Effort::of_block(number, topic.count());
    block_by(effort, impossible(topic), topic, [seed, number], limits)
}

/// The questions of a block that are chosen with this effort, in which some pairs are not looked for.
fn block_by<Q: Clone, L: Clone>(
    effort: Effort,
    impossible: Vec<[u16; 2]>,
    topic: &Topic<Q, L>,
    of_block: [u64; 2],
    limits: &L,
) -> Vec<Q> {
    let mut chooser = Chooser::new(effort, impossible, topic, of_block, limits);
    chooser.grow(BLOCK as usize);
    chooser.chosen
}

/// A block as far as it was asked for.
enum Block<Q: 'static, L: 'static> {
    Growing(Box<Chooser<Q, L>>),
    Whole(Vec<Q>),
}

impl<Q: Clone, L: Clone> Block<Q, L> {
    /// The question at a place, for which the block is chosen that far.
    fn question(&mut self, at: usize) -> Q {
        let chooser = match self {
            Self::Growing(chooser) => chooser,
            Self::Whole(all) => return all[at].clone(),
        };
        // A few more than that, so that several threads do not wait for each other at each question.
        chooser.grow((at + 1).next_multiple_of(GROWS_BY));
        let question = chooser.chosen[at].clone();
        // Nothing more is chosen, so that what was missing is forgotten.
        if chooser.chosen.len() as u64 == BLOCK {
            *self = Self::Whole(std::mem::take(&mut chooser.chosen));
        }
        question
    }
}

/// What the questions of a block depend on.
#[derive(Clone, PartialEq)]
struct Key<L> {
    topic: &'static str,
    seed: u64,
    number: u64,
    limits: L,
}

/// A block that several threads may ask for; nothing before the first of them does.
type SharedBlock<Q, L> = Arc<Mutex<Option<Block<Q, L>>>>;

struct KeptBlock<Q: 'static, L: 'static> {
    key: Key<L>,
    block: SharedBlock<Q, L>,
}

/// Blocks that were begun, for whoever asks for their questions next.
pub struct Blocks<Q: 'static, L: 'static>(Mutex<Vec<KeptBlock<Q, L>>>);

impl<Q: Clone, L: Clone + PartialEq> Blocks<Q, L> {
    pub(crate) const fn none() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// A question of the design of a topic. Its block is chosen as far as that, and kept while others ask for questions of it.
    #[must_use]
    pub fn question(&self, topic: &Topic<Q, L>, seed: u64, index: u64, limits: &L) -> Q {
        let key = Key { topic: topic.name, seed, number: index / BLOCK, limits: limits.clone() };
        let number = key.number;
        let place = self.place(key);
        let mut place = place.lock().unwrap_or_else(PoisonError::into_inner);
        let block = place.get_or_insert_with(|| {
            let effort = Effort::of_block(number, topic.count());
            let chooser = Chooser::new(effort, impossible(topic), topic, [seed, number], limits);
            Block::Growing(Box::new(chooser))
        });
        block.question((index % BLOCK) as usize)
    }

    /// The block of a key; nothing in it before it is asked for.
    fn place(&self, key: Key<L>) -> SharedBlock<Q, L> {
        let mut blocks = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = blocks.iter().find(|known| known.key == key) {
            return Arc::clone(&known.block);
        }
        let new = SharedBlock::default();
        blocks.push(KeptBlock { key, block: Arc::clone(&new) });
        if blocks.len() > KEPT {
            blocks.remove(0);
        }
        new
    }
}

static CASES: Blocks<Case, Limits> = Blocks::none();

/// A case of the design of a topic.
#[must_use]
pub fn case(topic: &Topic, seed: u64, index: u64, limits: &Limits) -> Case {
    CASES.question(topic, seed, index, limits)
}

#[cfg(test)]
mod tests {
    use super::super::{TOPICS, lines, near, triangles};
    use super::*;
    use crate::partition::{Coordinates, design};

    /// The classes of some questions.
    fn note<Q, L>(table: &mut Table, topic: &Topic<Q, L>, limits: &L, questions: &[Q]) {
        for question in questions {
            table.note(&topic.classes(question, limits).unwrap());
        }
    }

    /// The pairs of classes of two facts that a table does not have.
    fn missing<Q, L>(topic: &Topic<Q, L>, table: &Table) -> Vec<[u16; 2]> {
        let facts = topic.facts_of_classes();
        let mut missing = Vec::new();
        for second in 0..facts.len() {
            for first in (0..second).filter(|first| facts[*first] != facts[second]) {
                let pair = [first as u16, second as u16];
                if !table.has(&pair) {
                    missing.push(pair);
                }
            }
        }
        missing.sort_unstable();
        missing
    }

    fn has_every_pair<Q: Clone, L: Clone>(topic: &Topic<Q, L>, limits: &L) {
        for seed in 1..=3 {
            let mut table = Table::new(topic.count(), 3);
            note(&mut table, topic, limits, &block(topic, seed, 0, limits));
            let forgotten = without(&missing(topic, &table), &impossible(topic));
            let words = |[first, second]: &[u16; 2]| {
                format!("{} & {}", topic.class_words(*first), topic.class_words(*second))
            };
            let forgotten: Vec<_> = forgotten.iter().map(words).collect();
            assert!(forgotten.is_empty(), "{} seed {seed}: {forgotten:#?}", topic.name);
        }
    }

    /// In the default number of cases every pair is asked that can occur.
    #[test]
    fn the_first_block_has_every_pair() {
        TOPICS.iter().for_each(|topic| has_every_pair(topic, &Limits::default()));
        has_every_pair(&design::TOPIC, &Coordinates::F64);
    }

    /// A block that grows question by question, asked for in any order, is the one that is chosen at once.
    #[test]
    fn a_block_grows_to_the_same() {
        let topic = near::TOPIC;
        let limits = Limits::default();
        for number in [0, 1] {
            let whole = block(&topic, 7, number, &limits);
            let blocks = Blocks::none();
            for at in [0, 3, 160, 149, 999, 150, 0, 998] {
                let index = number * BLOCK + at;
                assert_eq!(
                    blocks.question(&topic, 7, index, &limits),
                    whole[at as usize],
                    "{index}"
                );
            }
        }
    }

    /// How many quadruples the first block after those by triples has, chosen with some effort.
    fn quadruples<Q: Clone, L: Clone>(topic: &Topic<Q, L>, effort: Effort, limits: &L) -> usize {
        let mut table = Table::new(topic.count(), 4);
        let block = block_by(effort, impossible(topic), topic, [1, BY_TRIPLES], limits);
        note(&mut table, topic, limits, &block);
        table.count(4)
    }

    /// The first block that is chosen by quadruples has more of them than if it was chosen by pairs and triples among as many candidates.
    #[test]
    fn later_blocks_have_more_quadruples() {
        for topic in [triangles::TOPIC, lines::TOPIC, near::TOPIC] {
            let limits = Limits::default();
            let effort = || Effort::of_block(BY_TRIPLES, topic.count());
            let by_triples = Effort { together: PAIRS_AND_TRIPLES, ..effort() };
            let before = quadruples(&topic, by_triples, &limits);
            let after = quadruples(&topic, effort(), &limits);
            assert!(after > before, "{}: {before} quadruples, then {after}", topic.name);
        }
    }

    #[allow(clippy::disallowed_methods, reason = "it renews the data of this crate")]
    fn search_long<Q: Clone, L: Clone>(topic: &Topic<Q, L>, limits: &L) {
        let mut table = Table::new(topic.count(), 3);
        for seed in 100..140 {
            let effort = Effort::of_block(0, topic.count());
            note(
                &mut table,
                topic,
                limits,
                &block_by(effort, Vec::new(), topic, [seed, 0], limits),
            );
        }
        let missing = missing(topic, &table);
        if std::env::var_os("RASTERPROOF_RENEW").is_some() {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/cases/facts/impossible");
            std::fs::write(format!("{folder}/{}.txt", topic.name), listed(&missing)).unwrap();
        } else {
            let found = without(&impossible(topic), &missing);
            assert!(found.is_empty(), "{}: {found:?} can occur", topic.name);
        }
    }

    /// The search that `impossible` stems from: 40 blocks that look for every pair.
    /// `RASTERPROOF_RENEW=1` writes what it has not found.
    #[test]
    #[ignore = "minutes; .ci/run --all runs it"]
    fn impossible_pairs_are_not_found() {
        TOPICS.iter().for_each(|topic| search_long(topic, &Limits::default()));
    }

    /// The same of polygons.
    #[test]
    #[ignore = "minutes; .ci/run --all runs it"]
    fn impossible_pairs_of_polygons_are_not_found() {
        search_long(&design::TOPIC, &Coordinates::F64);
    }

    /// The pairs of a list that another one does not have.
    fn without(pairs: &[[u16; 2]], others: &[[u16; 2]]) -> Vec<[u16; 2]> {
        pairs.iter().copied().filter(|pair| others.binary_search(pair).is_err()).collect()
    }

    /// The text that `impossible` reads.
    fn listed(pairs: &[[u16; 2]]) -> String {
        let mut text = String::new();
        let mut line = None;
        for [first, second] in pairs {
            if line != Some(first) {
                let end = if line.is_some() { "\n" } else { "" };
                text += &format!("{end}{first}");
                line = Some(first);
            }
            text += &format!(" {second}");
        }
        text + "\n"
    }
}
