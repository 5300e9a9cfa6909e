//! Random values explain themselves, or something that draws the same.

use std::collections::BTreeMap;

use super::search::{Stage, said_of};
use super::*;
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::Span;

/// A stage whose answers can be drawn.
trait DrawnAtRandom: Stage {
    const CHECK: Check;

    /// The answer of a program of this value.
    fn answer(&self, question: &Question, declared: &Declared) -> Answer;
}

fn run([x, y]: [i32; 2]) -> Span {
    Span { y_px: y, x0_px: x, x1_px: x + 1 }
}

impl DrawnAtRandom for DepthTest {
    const CHECK: Check = Check::Depth;

    fn answer(&self, question: &Question, declared: &Declared) -> Answer {
        let blank = Answer::Seen(Vec::new());
        let piles = Self::parts(question, &blank, declared, Self::NOISE[0]);
        let seen = piles.iter().filter_map(|pile| {
            let number = self.shown(pile).trailing_zeros().checked_sub(1)?;
            Some((run(pile.spot.at), number as u8))
        });
        Answer::Seen(seen.collect())
    }
}

impl DrawnAtRandom for SampleMask {
    const CHECK: Check = Check::Samples;

    fn answer(&self, question: &Question, declared: &Declared) -> Answer {
        let blank = Answer::Samples(Vec::new());
        let parts = Self::parts(question, &blank, declared, 0.0);
        let masks = parts.iter().map(|pixel| (run(pixel.spot.at), self.mask(pixel)));
        Answer::Samples(masks.filter(|(_, mask)| *mask > 0).collect())
    }
}

impl DrawnAtRandom for NearCut {
    const CHECK: Check = Check::Carried;

    fn answer(&self, question: &Question, declared: &Declared) -> Answer {
        let blank = Answer::Carried(Vec::new());
        let parts = Self::parts(question, &blank, declared, 0.0);
        Answer::Carried(parts.iter().flat_map(|cut| self.polygon(cut, true)).collect())
    }
}

/// What becomes of values with so many random changed fields, of which it is counted by field how many are not explained.
#[derive(Debug, Default)]
struct Shares {
    explained: usize,
    missed: usize,
    /// Values that draw what is right.
    unseen: usize,
    of_fields: BTreeMap<String, usize>,
}

fn shares<S: DrawnAtRandom>(changes: usize, count: u64) -> Shares {
    let declared = Declared { tolerance: 1e-9, ..Declared::default() };
    let truth = Truth::of(&declared);
    let mut cases: Vec<(Case, Vec<Question>)> = Vec::new();
    for name in families(S::CHECK) {
        for index in 0..60 {
            let case = adapt_case::family(name).unwrap().case(SEED, index);
            let case = adapt_case::put(case, &truth.declared);
            let mut questions = Vec::new();
            S::CHECK.questions(&case, &truth, &mut questions);
            cases.push((case, questions));
        }
    }
    let mut shares = Shares::default();
    let options = S::options();
    for index in 0..count {
        let mut rng = Rng::new("stages", 1, index);
        let mut any = || &options[rng.int(0, options.len() as i64 - 1) as usize];
        let mut value = any().clone();
        if changes == 2 {
            // In another field.
            let other = loop {
                let other = any();
                if value.with(other) != *other {
                    break other;
                }
            };
            value = value.with(other);
        }
        let all: Vec<_> = cases
            .iter()
            .map(|(case, questions)| {
                let answers: Vec<_> =
                    questions.iter().map(|q| value.answer(q, &declared)).collect();
                let judged = S::CHECK.judge(case, &answers, &truth);
                let is_wrong = judged.finding.tally.total() > 0;
                Answered { questions: questions.clone(), answers, is_wrong }
            })
            .collect();
        let is_wrong: Vec<bool> = all.iter().map(|a| a.is_wrong).collect();
        if is_wrong.iter().filter(|wrong| **wrong).count() < 6 || is_blank(&all) {
            shares.unseen += 1;
            continue;
        }
        let found = of_stage(S::CHECK, &all, &declared, &[]);
        match found.is_some_and(|found| found.is_known()) {
            true => shares.explained += 1,
            false => {
                shares.missed += 1;
                let fields: Vec<_> = value.said().iter().map(|said| said.name).collect();
                *shares.of_fields.entry(fields.join(" + ")).or_default() += 1;
                println!("missed: {}", said_of(&value, "").does);
            }
        }
    }
    println!("{changes}: {shares:?}");
    shares
}

/// Of values with one changed field at least 90 % are explained, and of those with two at least 75 %.
fn explain_themselves(singles: u64, pairs: u64) {
    for (changes, count, percent) in [(1, singles, 90), (2, pairs, 75)] {
        let all = [
            shares::<DepthTest>(changes, count),
            shares::<SampleMask>(changes, count),
            shares::<NearCut>(changes, count),
        ];
        for shares in all {
            let seen = shares.explained + shares.missed;
            assert!(100 * shares.explained >= percent * seen, "{changes}: {shares:?}");
        }
    }
}

/// The search for the cause of a check chooses its questions by the facts of that check, not by those of another one.
#[test]
fn questions_have_the_facts_of_their_check() {
    let all = "HELLO 2 x coverage attributes samples4 sample-values depth clip clip-attributes wide-line area";
    let declared = Declared::parse(all).unwrap();
    for check in [
        Check::Values,
        Check::Samples,
        Check::SampleValues,
        Check::Depth,
        Check::Near,
        Check::Carried,
        Check::Wide,
        Check::Area,
    ] {
        let of_families = families(check).iter().filter_map(|name| topic(name));
        for topic in of_families.chain(learn::topic(check)) {
            let case = topic.any(&mut Rng::new(topic.name, SEED, 0));
            let checks = Check::of(topic.name, &case, 0, &declared);
            assert!(checks.contains(&check), "{check:?} has questions of {}", topic.name);
        }
    }
}

#[test]
fn values_explain_themselves() {
    explain_themselves(5, 2);
}

/// A sample of the survey, which takes minutes: RASTERPROOF_ALL=1 asks for all of it.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn many_values_explain_themselves() {
    match std::env::var_os("RASTERPROOF_ALL") {
        Some(_) => explain_themselves(200, 100),
        None => explain_themselves(16, 6),
    }
}
