//! The judge of other people's programs: anybody who answers questions is asked the cases of the
//! families and judged as our own engines are.
//!
//! [`ask`] is what is asked and answered; the crate `program` asks a program through pipes, and [`in_process`] an
//! engine of the registry without one. [`declared`] is what a program says of itself, [`adapt_case`] puts
//! the cases where it says it draws, [`expected`] knows the exact picture, [`check`] finds what is
//! wrong with a case ([`judged`]), `depth` and `near` of what is beside the rasterizer, [`run`] asks them all, [`recognise`] finds the
//! convention that is followed, [`against`] compares two programs, and [`verdict`] says what came of it, property by property; [`timed`] keeps a
//! limited time;
//! [`polygons`] judges tessellators. [`baseline`] knows failures that are known. [`server`] is the other side: it answers as an engine.

pub mod adapt_case;
pub mod against;
pub mod ask;
pub mod asked;
pub mod baseline;
pub mod check;
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
mod outline;
pub mod pictured;
pub mod pixels;
pub mod polygons;
mod reach;
pub mod recognise;
pub mod run;
pub mod server;
pub mod shrink;
pub mod stages;
pub mod text;
pub mod timed;
pub mod verdict;
pub mod windings;

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use ask::{Answer, Complaints, Question, Subject};
use check::Truth;
use declared::Declared;
use rasterproof_verify::judge::Terms;
use rasterproof_verify::partition;
use recognise::{Recognised, Said};
use run::Incident;
use timed::Timed;
use verdict::{Particulars, Verdict};

/// The time limit is that of all questions. An answer that is still missing at its end is awaited a short while longer.
pub type Options = rasterproof_verify::judge::Options<String, Asking>;

/// What is done about failing cases of a program.
#[derive(Clone, Debug)]
pub struct Asking {
    /// How long the program may take to answer while the smallest case of a property is looked for, twice as long for all
    /// properties together; and how long the cause of each kind of mistake is looked for. Where the time is limited, all
    /// smallest cases together may take half of it.
    pub patience: Duration,
    /// Every case and every failure is remembered, for a baseline.
    pub remember: bool,
    /// The fingerprints of failures that are known, by [`run::Failing::name`]. These are not shown.
    pub known: BTreeMap<String, u64>,
}

impl Default for Asking {
    fn default() -> Self {
        Self { patience: Duration::from_secs(5), remember: false, known: BTreeMap::new() }
    }
}

impl Terms for Asking {
    const CASES: u64 = 1000;
}

/// Of a limited time that began then, what is left for the families: a tenth of all is for the questions after them.
fn for_families(options: &Options, start: Instant) -> Options {
    let mut options = options.clone();
    if let Some(limit) = options.time_limit {
        options.time_limit = Some((limit - limit / 10).saturating_sub(start.elapsed()));
        options.terms.patience = options.terms.patience.min(limit / 10);
    }
    options
}

/// The names of all families, those of polygons last.
#[must_use]
pub fn family_names() -> Vec<&'static str> {
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
    let declared = first.declared().clone();
    let mut truth = Truth::of(&declared);
    // Of a limited time, a third is for the questions before the families and a tenth for those after them.
    let asked = Timed::new(&mut **first, options.time_limit.map(|limit| start + limit / 3));
    let mut first = WatchedSubject { asked, incidents: Vec::new() };
    let windings = windings::windings(&mut first, options.seed);
    truth.drawn = windings.seen().unwrap_or(truth.drawn);
    truth.declared.reach = reach::reach(&mut first);
    truth.declared.side = reach::side(&mut first);
    let mut found_before = recognise(&mut first);
    let mut recognised = found_before.as_mut().map(|found| {
        truth.recognised = found.expect.take();
        found.said.clone()
    });
    if first.asked.is_late {
        let late = "The time was up before its convention was found.".to_owned();
        (recognised, truth.recognised) =
            (Some(Said { sentences: vec![late], ..Said::default() }), None);
    }
    let before = first.incidents;
    let asked = &for_families(options, start);
    let mut all: Vec<&mut dyn Subject> = askers.iter_mut().map(|asker| &mut **asker as _).collect();
    let mut found = run::run(&mut all, asked, &truth, &|cases| progress(Step::Judged(cases)));
    found.incidents.splice(0..0, before);
    found.incidents.truncate(run::MOST_INCIDENTS);
    let first = &mut *askers[0];
    progress(Step::Smaller);
    // What is said of one answer is not true of the next: then nothing is shrunk or explained.
    let changes = !found.changing.is_empty();
    let failures = match changes {
        true => failures::changing(&found, asked, &truth),
        false => failures::failures(&mut Timed::new(first, end), &found, asked, &truth),
    };
    let recognised = recognised.filter(|_| !changes);
    let checks = if changes { Vec::new() } else { found.unexplained() };
    if !checks.is_empty() {
        progress(Step::Cause);
    }
    let (timed, patience) = (&mut Timed::new(first, end), asked.terms.patience);
    let causes = recognise::mistakes(timed, &checks, &truth, found_before.as_ref(), patience);
    found.strays.extend(first.strays());
    let Declared { reach, side, .. } = truth.declared;
    let complaints = finish(askers.iter_mut().map(|asker| &mut **asker as _), &mut found);
    let more = Particulars {
        declared,
        windings,
        recognised,
        found,
        reach,
        side,
        complaints,
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
}
