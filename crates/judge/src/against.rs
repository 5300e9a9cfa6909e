//! Two programs that get the same requests: where their answers differ, and which of the two the oracle agrees with.
//!
//! Both are sent the same requests, within what both declare that they can answer. Each is judged by the rule that it declares
//! itself, so that a difference of conventions is not called a fault of either.

use std::time::Instant;

use super::after::{self, Explained, Patience};
use super::ask::{Answer, Complaints, Misbehaviour, Question, Subject};
use super::check::Truth;
use super::declared::Declared;
use super::recognise::{self, Why};
use super::run::{self, Sides};
use super::timed::Timed;
use super::verdict::{self, Particulars, Verdict};
use super::{Options, Step, finish, for_families, reach};

/// Two programs behind one [`Subject`]: each answer is [`Answer::Two`].
struct Pair<'a> {
    /// The two programs, the first of which has the conventions of the pair.
    sides: [&'a mut dyn Subject; 2],
    /// What both can answer, with the conventions of the first.
    declared: Declared,
}

impl Subject for Pair<'_> {
    fn declared(&self) -> &Declared {
        &self.declared
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let names = self.names();
        let [first, second] = &mut self.sides;
        // The second program is asked only what the first one answered, and both share the deaths that are allowed.
        let answers = first.ask(questions, most_deaths);
        let deaths = answers.iter().filter(|answer| answer.is_death()).count() as u64;
        let others =
            second.ask(&questions[..answers.len()], most_deaths.saturating_sub(deaths).max(1));
        let mut both = Vec::new();
        for pair in answers.into_iter().zip(others) {
            // A death of either is one of both, and says whose it is.
            both.push(match pair {
                (Answer::Died(what), _) => Answer::Died(said_by(&names[0], what)),
                (_, Answer::Died(what)) => Answer::Died(said_by(&names[1], what)),
                (first, second) => Answer::Two(Box::new([first, second])),
            });
        }
        both
    }

    fn end_at(&mut self, end: Option<Instant>) {
        for side in &mut self.sides {
            side.end_at(end);
        }
    }

    fn cases_at_once(&self) -> u64 {
        let [first, second] = &self.sides;
        first.cases_at_once().min(second.cases_at_once())
    }

    fn strays(&mut self) -> Vec<Misbehaviour> {
        self.of_both(|side| side.strays())
    }

    fn finish(&mut self) -> Vec<Misbehaviour> {
        self.of_both(|side| side.finish())
    }

    fn complaints(&self) -> Complaints {
        let mut both = Complaints::default();
        for (side, name) in self.sides.iter().zip(self.names()) {
            let Complaints { lines, shown } = side.complaints();
            both.lines += lines;
            for line in shown {
                both.shown.push(format!("{name}: {line}"));
            }
        }
        both
    }
}

impl Pair<'_> {
    /// What each of them did, with its name.
    fn of_both(
        &mut self,
        what: impl Fn(&mut dyn Subject) -> Vec<Misbehaviour>,
    ) -> Vec<Misbehaviour> {
        let mut all = Vec::new();
        for (name, side) in self.names().iter().zip(&mut self.sides) {
            for what in what(&mut **side) {
                all.push(said_by(name, what));
            }
        }
        all
    }

    /// The names of both sides, by which deaths and complaints are told apart.
    fn names(&self) -> [String; 2] {
        names([self.sides[0].declared(), self.sides[1].declared()])
    }
}

/// The names of both as messages have them; of equal ones the second is called the other.
#[must_use]
pub fn names([first, second]: [&Declared; 2]) -> [String; 2] {
    let other = if first.name == second.name {
        format!("the other {}", second.name)
    } else {
        second.name.clone()
    };
    [first.name.clone(), other]
}

/// What a program did, with its name before it.
fn said_by(name: &str, what: Misbehaviour) -> Misbehaviour {
    Misbehaviour { how: format!("{name}: {}", what.how), ..what }
}

/// Compares two programs on the cases of all families that both can be asked. Copies are pairs of the same two.
///
/// # Panics
/// If `pairs` is empty.
pub fn compare(
    pairs: &mut [[Box<dyn Subject>; 2]],
    options: &Options,
    progress: &(dyn Fn(Step) + Sync),
) -> Verdict {
    let start = Instant::now();
    let end = options.time_limit.map(|limit| start + limit);
    progress(Step::Rule);
    let [first, second] = pairs.first_mut().expect("somebody to be asked");
    let mut both = [first.declared().clone(), second.declared().clone()];
    // How far each one draws is measured before anything is compared.
    for (side, declared) in [first, second].into_iter().zip(&mut both) {
        let asked = &mut Timed::new(&mut **side, end);
        (declared.reach, declared.side) = (reach::reach(asked), reach::side(asked));
    }
    // Each keeps its own conventions, and is asked what both can answer.
    let [one, other] = &both;
    let asked = [one.clone().within(one).within(other), other.clone().within(one).within(other)];
    // What both are asked is the same; by what each is judged is its own.
    let mut truth = Truth::of(&asked[0]);
    truth.of_two = Some(Box::new(asked.each_ref().map(Truth::of)));
    let mut pairs: Vec<Pair<'_>> = pairs
        .iter_mut()
        .map(|[first, second]| Pair {
            sides: [&mut **first, &mut **second],
            declared: asked[0].clone(),
        })
        .collect();
    pairs.iter_mut().for_each(|pair| pair.end_at(end));
    let mut askers: Vec<&mut dyn Subject> =
        pairs.iter_mut().map(|pair| pair as &mut dyn Subject).collect();
    let judged = |cases| progress(Step::Judged(cases));
    // The cases, in which a difference of both counts as wrong.
    let mut found = run::run(&mut askers, &for_families(options, start), &truth, &judged);
    progress(Step::Smaller);
    // Then the smallest cases that show a difference, and why one of both is wrong there.
    let pair = &mut pairs[0];
    let Explained { failures, causes, left_out } = match found.changing.is_empty() {
        true => explain(pair, &found, options, &truth, end, progress),
        false => Explained::changing(&found, options, &truth),
    };
    found.strays.extend(pair.strays());
    let complaints = finish(pairs.iter_mut().map(|pair| pair as &mut dyn Subject), &mut found);
    let [declared, second] = both;
    let more = Particulars {
        declared,
        against: Some(second),
        found,
        reach: truth.declared.reach,
        side: truth.declared.side,
        complaints,
        left_out,
        ..Particulars::default()
    };
    verdict::verdict(options, more, failures, causes)
}

/// The smallest cases in which the answers differ, and why each of both is wrong there.
fn explain(
    pair: &mut Pair<'_>,
    found: &run::RunFindings,
    options: &Options,
    truth: &Truth,
    end: Option<Instant>,
    progress: &(dyn Fn(Step) + Sync),
) -> Explained {
    // First the cases are made smaller, with both programs asked at once.
    let patience = Patience::of(options, end, None);
    let (failures, mut spent) = after::smaller(pair, found, options, truth, patience);
    progress(Step::Cause);
    let mut left_out = after::left_out(found, options);
    left_out.shrinking = failures.iter().any(|failure| failure.evidence.shrunk.is_cut());
    let names = pair.names();
    // Then each side alone is asked for the cause of the rows in which it is wrong.
    let is_wrong: [fn(&Sides) -> bool; 2] =
        [|s| s.second + s.neither > 0, |s| s.first + s.neither > 0];
    let mut causes = Vec::new();
    let of_two = truth.of_two.iter().flat_map(|of_two| of_two.iter());
    for (((side, truth), name), is_wrong) in
        pair.sides.iter_mut().zip(of_two).zip(names).zip(is_wrong)
    {
        let rows = found.rows.iter().filter(|row| row.sides.as_ref().is_some_and(is_wrong));
        let mut asked = patience.limit(&mut **side, spent);
        let (why, was_cut) =
            recognise::mistakes(&mut asked, &run::checks_of(rows), truth, None, &[]);
        spent = patience.spent(&asked);
        left_out.cause |= was_cut;
        causes.extend(why.into_iter().map(|why| Why { by: name.clone(), ..why }));
    }
    Explained { failures, causes, left_out }
}
