//! What a design asks: how many of the pairs and of the triples of classes its cases have.

use std::ops::Range;

use super::table::Table;
use super::{Topic, design};
use crate::cases::{Family, Limits};

/// How much some cases of a design ask.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DesignShare {
    /// The name of the family whose cases the design chooses.
    pub family: &'static str,
    /// How many cases there are.
    pub cases: u64,
    /// Facts of a question.
    pub facts: usize,
    /// Classes of all facts, without those of `never`.
    pub classes: usize,
    /// Pairs of classes that occur.
    pub pairs: usize,
    /// Pairs of those classes that can occur for a rasterizer without limits.
    pub of_pairs: usize,
    /// Triples of classes that occur.
    pub triples: usize,
    /// Triples of those classes whose three pairs can occur. A few of them cannot occur themselves.
    pub of_triples: usize,
    /// The classes that no case has within the limits, however many there are, in words.
    pub never: Vec<String>,
}

/// What some questions ask.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AskedClasses {
    /// Pairs of classes that occur.
    pub pairs: usize,
    /// Triples of classes that occur.
    pub triples: usize,
    /// Pairs among them that are called impossible, in words: there should be none.
    pub impossible: Vec<String>,
}

impl AskedClasses {
    /// What these questions ask, whoever chose them.
    #[must_use]
    pub fn by<Q, L>(topic: &Topic<Q, L>, limits: &L, questions: impl Iterator<Item = Q>) -> Self {
        let table = table_of(topic, limits, questions);
        let [pairs, triples] = [2, 3].map(|together| table.count(together));
        let mut impossible = design::impossible(topic);
        impossible.retain(|pair| table.has(pair));
        let words = |[first, second]: [u16; 2]| {
            format!("{} & {}", topic.class_words(first), topic.class_words(second))
        };
        Self { pairs, triples, impossible: impossible.into_iter().map(words).collect() }
    }
}

/// The pairs and triples of the questions that have the facts of a topic.
fn table_of<Q, L>(topic: &Topic<Q, L>, limits: &L, questions: impl Iterator<Item = Q>) -> Table {
    let mut table = Table::new(topic.count(), 3);
    for question in questions {
        if let Some(classes) = topic.classes(&question, limits) {
            table.note(&classes);
        }
    }
    table
}

/// Cases of which triples are counted at most: after so many of them hardly one is missing.
const MOST_COUNTED: usize = 20_000;

impl DesignShare {
    /// What the questions of a design with these numbers ask within limits.
    #[must_use]
    pub fn of<Q, L>(
        topic: &Topic<Q, L>,
        numbers: Range<u64>,
        limits: &L,
        question: &dyn Fn(u64) -> Q,
    ) -> Self {
        let cases = numbers.end.saturating_sub(numbers.start);
        let AskedClasses { pairs, triples, .. } =
            AskedClasses::by(topic, limits, numbers.take(MOST_COUNTED).map(question));
        // What the first block does not have is not asked in any number of cases.
        let whole = table_of(topic, limits, (0..design::BLOCK).map(question));
        let ([seen, never], [of_pairs, of_triples]) = possible(topic, &whole);
        Self {
            family: topic.name,
            cases,
            facts: topic.facts.len(),
            classes: seen.len(),
            pairs,
            of_pairs,
            triples,
            of_triples,
            never: never.into_iter().map(|class| topic.class_words(class)).collect(),
        }
    }

    /// What the designs among some families ask of a rasterizer with limits.
    #[must_use]
    pub fn of_families<'a>(
        families: impl IntoIterator<Item = &'a Family>,
        seed: u64,
        numbers: impl Fn(&Topic) -> Range<u64>,
        limits: &Limits,
    ) -> Vec<Self> {
        let mut shares = Vec::new();
        for topic in families.into_iter().filter_map(Family::design) {
            let question = |index| design::case(topic, seed, index, limits);
            shares.push(Self::of(topic, numbers(topic), limits, &question));
        }
        shares
    }
}

/// The classes that occur, the pairs of these that can occur, and the triples whose three pairs can.
fn possible<Q, L>(topic: &Topic<Q, L>, table: &Table) -> ([Vec<u16>; 2], [usize; 2]) {
    let facts = topic.facts_of_classes();
    let all = facts.len() as u16;
    let occurs =
        |class: &u16| (0..all).any(|other| table.has(&[*class.min(&other), *class.max(&other)]));
    let (seen, never): (Vec<u16>, Vec<u16>) = (0..all).partition(occurs);
    let impossible = design::impossible(topic);
    // Of each class the smaller ones that it can occur with.
    let mut partners: Vec<Vec<u16>> = vec![Vec::new(); usize::from(all)];
    for &second in &seen {
        let can_occur = |first: &u16| {
            facts[usize::from(*first)] != facts[usize::from(second)]
                && impossible.binary_search(&[*first, second]).is_err()
        };
        partners[usize::from(second)] =
            seen.iter().copied().filter(|first| *first < second && can_occur(first)).collect();
    }
    let mut counts = [0; 2];
    for third in &partners {
        counts[0] += third.len();
        for second in third {
            let both = partners[usize::from(*second)]
                .iter()
                .filter(|first| third.binary_search(first).is_ok());
            counts[1] += both.count();
        }
    }
    ([seen, never], counts)
}
