//! The judge of other people's programs: anybody who answers questions is asked the cases of the
//! families and judged as our own engines are.
//!
//! [`ask`] is what is asked and answered; the crate `program` asks a program through pipes, and [`in_process`] an
//! engine of the registry without one. [`declared`] is what a program says of itself, [`adapt_case`] puts
//! the cases where it says it draws, [`expected`] knows the exact picture, [`check`] finds what is
//! wrong with a case ([`judged`]), [`checkable`] says it so that a test without this judge can, `depth` and `near` of what is beside the rasterizer, [`run`] asks them all, [`recognise`] finds the
//! convention that is followed, `after` makes failing cases smaller and asks why they fail, [`against`] compares two programs, and [`verdict`] says what came of it, property by property; [`timed`] keeps a
//! limited time;
//! [`polygons`] judges tessellators. [`record`] keeps answers, so that a judgement that was broken off goes on. [`baseline`] knows failures that are
//! known, and [`changes`] what one judgement finds and another does not. [`server`] is the other side: it answers as an engine.

pub mod adapt_case;
mod after;
pub mod against;
pub mod ask;
mod asked;
pub mod baseline;
pub mod changes;
pub mod check;
pub mod checkable;
pub mod declared;
mod depth;
mod difference;
pub mod expected;
pub mod failures;
pub mod in_process;
pub mod judged;
pub mod league;
mod leaving;
pub mod mesh;
pub mod near_plane;
mod numbers;
mod outline;
pub mod pictured;
pub mod pixels;
pub mod polygons;
mod reach;
pub mod recognise;
pub mod record;
pub mod run;
mod sample_values;
pub mod server;
pub mod shrink;
pub mod stages;
pub mod text;
pub mod timed;
#[cfg(test)]
mod verbs;
pub mod verdict;
pub mod windings;

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

pub use after::{Explained, Patience, explain};
use ask::{Answer, Complaints, Question, Subject};
use check::Truth;
use declared::Declared;
use rasterproof_verify::judge::{AFTER_FAILURE, Terms};
use rasterproof_verify::partition;
use recognise::Recognised;
use run::Incident;
use timed::Timed;
use verdict::{Particulars, Verdict};

/// The time limit is that of all questions. An answer that is still missing at its end is awaited a short while longer.
pub type Options = rasterproof_verify::judge::Options<String, Asking>;

/// What is done about failing cases of a program.
#[derive(Clone, Debug)]
pub struct Asking {
    /// How long the program may take to answer after the first failure in all, where the time is not limited: half of it while
    /// failing cases are made smaller, and the rest while their causes are looked for.
    pub patience: Duration,
    /// What the caller writes before the seconds of a time limit, for what is said of it.
    pub time_limit_is: &'static str,
    /// Every case and every failure is remembered, for a baseline.
    pub remember: bool,
    /// The fingerprints of failures that are known, by [`run::Failing::name`]. These are not shown.
    pub known: BTreeMap<String, u64>,
}

impl Default for Asking {
    fn default() -> Self {
        Self {
            patience: AFTER_FAILURE,
            time_limit_is: "--seconds ",
            remember: false,
            known: BTreeMap::new(),
        }
    }
}

impl Asking {
    /// What the caller calls the time limit.
    #[must_use]
    pub fn time_limit_option(&self) -> &'static str {
        self.time_limit_is.trim_end_matches(['=', ':', ' '])
    }
}

impl Terms for Asking {
    const CASES: u64 = 500;
}

/// Of a limited time that began then, what is left for the families: a tenth of all is for the questions after them.
#[must_use]
pub fn for_families(options: &Options, start: Instant) -> Options {
    let mut options = options.clone();
    if let Some(limit) = options.time_limit {
        options.time_limit = Some((limit - limit / 10).saturating_sub(start.elapsed()));
    }
    options
}

/// The names of all families, those of polygons last.
#[must_use]
pub fn family_names() -> Vec<&'static str> {
    // Those of polygons come last, since no other program is asked them.
    let polygons = partition::Family::ALL.into_iter().map(partition::Family::name);
    adapt_case::families(&[]).into_iter().map(|family| family.name).chain(polygons).collect()
}

/// What the judge does, for those who wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// It asks for the winding and the rule, before the cases.
    Rule,
    /// It asks cases; so many more are judged.
    Judged(u64),
    /// It makes failing cases smaller, after all others.
    Smaller,
    /// It asks for the cause of what is wrong.
    Cause,
}

/// Recognises the convention of a program by asking it; nothing where it draws as it declares.
pub type Recognise<'a> = &'a dyn Fn(&mut dyn Subject) -> Option<Recognised>;

/// Judges whoever answers; several are the same program and share the work.
///
/// # Panics
/// If nobody is there to be asked.
pub fn judge(
    askers: &mut [Box<dyn Subject>],
    options: &Options,
    recognise: Recognise<'_>,
    progress: &(dyn Fn(Step) + Sync),
) -> Verdict {
    let start = Instant::now();
    let end = options.time_limit.map(|limit| start + limit);
    askers.iter_mut().for_each(|asker| asker.end_at(end));
    progress(Step::Rule);
    let first = askers.first_mut().expect("somebody to be asked");
    // From here on the program is judged by what it declares.
    let declared = first.declared().clone();
    let mut truth = Truth::of(&declared);
    // Of a limited time, a third is for the questions before the families and a tenth for those after them.
    let asked = Timed::new(&mut **first, options.time_limit.map(|limit| start + limit / 3));
    let mut first = WatchedSubject { asked, incidents: Vec::new() };
    // Before the cases: which winding it draws, how far it draws, and by which convention, since all of them decide what is asked
    // and expected.
    let windings = windings::windings(&mut first, options.seed);
    truth.drawn = windings.seen().unwrap_or(truth.drawn);
    truth.declared.reach = reach::reach(&mut first);
    truth.declared.side = reach::side(&mut first);
    let mut convention = recognise(&mut first);
    if first.asked.is_late {
        convention = Some(Recognised::late());
    }
    truth.recognised = convention.as_mut().and_then(|found| found.expect.take());
    let before = first.incidents;
    // All copies judge the cases together.
    let mut all: Vec<&mut dyn Subject> = askers.iter_mut().map(|asker| &mut **asker as _).collect();
    let judged = |cases| progress(Step::Judged(cases));
    let mut found = run::run(&mut all, &for_families(options, start), &truth, &judged);
    found.incidents.splice(0..0, before);
    found.incidents.truncate(run::MOST_INCIDENTS);
    // One of them is enough to look for causes, since each question there depends on the answers before it.
    let first = &mut *askers[0];
    let patience = Patience::of(options, end, convention.as_ref());
    let Explained { failures, causes, left_out } =
        explain(first, &found, options, &truth, convention.as_ref(), patience, progress);
    // A program whose answers change follows no convention.
    let recognised = convention.map(|found| found.said).filter(|_| found.changing.is_empty());
    found.strays.extend(first.strays());
    let Declared { reach, side, .. } = truth.declared;
    // At the end of its input a program may still do something wrong, such as leak.
    let complaints = finish(askers.iter_mut().map(|asker| &mut **asker as _), &mut found);
    let more = Particulars {
        declared,
        windings,
        recognised,
        found,
        reach,
        side,
        complaints,
        left_out,
        ..Particulars::default()
    };
    verdict::verdict(options, more, failures, causes)
}

/// Ends all copies when nothing more is asked, and adds what they did wrong at their end. What the first of them wrote on
/// standard error that wrote any; the copies are the same program.
fn finish<'a>(
    askers: impl Iterator<Item = &'a mut (dyn Subject + 'a)>,
    found: &mut run::RunFindings,
) -> Complaints {
    let mut complaints = Complaints::default();
    for asker in askers {
        asker.end_at(None);
        found.strays.extend(asker.finish());
        let said = asker.complaints();
        complaints = if complaints.lines == 0 { said } else { complaints };
    }
    complaints
}

/// Somebody who is asked before the families, and what came instead of answers.
struct WatchedSubject<'a> {
    asked: Timed<'a>,
    incidents: Vec<Incident>,
}

impl Subject for WatchedSubject<'_> {
    fn declared(&self) -> &Declared {
        self.asked.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let answers = self.asked.ask(questions, most_deaths);
        for (question, answer) in questions.iter().zip(&answers) {
            if let Answer::Died(what) = answer {
                let (what, request) = (what.clone(), question.text(1));
                self.incidents.push(Incident { family: "", index: 0, what, request });
            }
        }
        answers
    }

    fn took(&self) -> Option<Duration> {
        self.asked.took()
    }
}
