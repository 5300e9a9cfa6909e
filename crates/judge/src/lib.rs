//! The judge of other people's programs: anybody who answers questions is asked the cases of the
//! families and judged as our own engines are.
//!
//! [`ask`] is what is asked and answered, [`process`] asks a program through pipes and [`in_process`] an
//! engine of the registry without one. [`declared`] is what a program says of itself, [`adapt_case`] puts
//! the cases where it says it draws, [`expected`] knows the exact picture, [`check`] finds what is
//! wrong with a case ([`finding`]), `depth` and `near` of what is beside the rasterizer, [`run`] asks them all, [`recognise`] finds the
//! convention that is followed, and [`verdict`] says what came of it, property by property;
//! [`baseline`] knows failures that are known. [`server`] is the other side: it answers as an engine.

pub mod adapt_case;
pub mod ask;
pub mod baseline;
pub mod check;
pub mod declared;
mod depth;
pub mod expected;
pub mod failures;
pub mod finding;
pub mod in_process;
pub mod league;
mod leaving;
pub mod mesh;
mod near_plane;
pub mod pictured;
pub mod process;
pub mod process_group;
pub mod recognise;
pub mod run;
pub mod server;
pub mod shrink;
mod stages;
pub mod text;
pub mod verdict;
pub mod windings;

use std::time::{Duration, Instant};

use ask::{Answer, Ask, Question};
use check::Truth;
use declared::Declared;
use recognise::{Recognised, Said};
use run::Incident;
use verdict::Verdict;

#[derive(Clone, Debug)]
pub struct Options {
    pub seed: u64,
    pub cases: u64,
    /// No new case is begun after this long; a failing case is then made smaller for a tenth of it.
    pub time_limit: Option<Duration>,
    /// Names of families; empty means all.
    pub families: Vec<String>,
    pub only: Option<u64>,
    /// How long the smallest failing case of a property is looked for.
    pub patience: Duration,
    /// Every case and every failure is remembered, for a baseline.
    pub remember: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            cases: 1000,
            time_limit: None,
            families: Vec::new(),
            only: None,
            patience: Duration::from_secs(5),
            remember: false,
        }
    }
}

/// Recognises the convention of a program by asking it; nothing where it draws as it declares.
pub type Recognise<'a> = &'a dyn Fn(&mut dyn Ask) -> Option<Recognised>;

/// Judges whoever answers; several are the same program and share the work.
///
/// # Panics
/// If nobody is there to be asked.
#[must_use]
pub fn judge(
    askers: &mut [Box<dyn Ask>],
    options: &Options,
    recognise: Recognise<'_>,
    progress: &(dyn Fn(u64) + Sync),
) -> Verdict {
    let first = askers.first_mut().expect("somebody to be asked");
    let declared = first.declared().clone();
    let mut truth = Truth::of(&declared);
    let start = Instant::now();
    // A third of a limited time is for what is asked before the families.
    let end = options.time_limit.map(|limit| start + limit / 3);
    let mut first = Watched { asked: &mut **first, incidents: Vec::new(), end, is_late: false };
    let windings = windings::windings(&mut first, options.seed);
    truth.drawn = windings.seen().unwrap_or(truth.drawn);
    let mut found_before = recognise(&mut first);
    let mut recognised = found_before.as_mut().map(|found| {
        truth.recognised = found.expect.take();
        found.said.clone()
    });
    if first.is_late {
        let late = "The time was up before its convention was found.".to_owned();
        (recognised, truth.recognised) =
            (Some(Said { sentences: vec![late], ..Said::default() }), None);
    }
    let before = first.incidents;
    let mut options = options.clone();
    if let Some(limit) = options.time_limit {
        options.time_limit = Some(limit.saturating_sub(start.elapsed()));
        options.patience = options.patience.min(limit / 10);
    }
    let options = &options;
    let mut found = run::run(askers, options, &truth, progress);
    found.incidents.splice(0..0, before);
    found.incidents.truncate(run::MOST_INCIDENTS);
    let first = &mut *askers[0];
    let failures = failures::failures(first, &found, options, &truth);
    let start = Instant::now();
    let goes_on = || start.elapsed() < options.patience;
    let causes = recognise::mistakes(first, &found, &truth, found_before.as_ref(), &goes_on);
    found.strays.extend(first.strays());
    let mut verdict =
        Verdict::new(declared, options, windings, recognised, found, failures, first.complaints());
    verdict.causes = causes;
    verdict
}

/// Somebody who is asked before the families, and what came instead of answers.
struct Watched<'a> {
    asked: &'a mut dyn Ask,
    incidents: Vec<Incident>,
    /// Nothing is asked after this, and whether something would have been.
    end: Option<Instant>,
    is_late: bool,
}

impl Ask for Watched<'_> {
    fn declared(&self) -> &Declared {
        self.asked.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        // Where the time is limited it is looked at now and then.
        let at_once = match self.end {
            Some(_) => self.asked.declared().batch.max(16),
            None => questions.len().max(1),
        };
        let (mut answers, mut deaths) = (Vec::new(), 0);
        for some in questions.chunks(at_once) {
            self.is_late |= self.end.is_some_and(|end| Instant::now() >= end);
            if self.is_late || deaths >= most_deaths {
                break;
            }
            let answered = self.asked.ask(some, most_deaths - deaths);
            for (question, answer) in some.iter().zip(&answered) {
                if let Answer::Died(what) = answer {
                    let (what, request) = (what.clone(), question.text(1));
                    self.incidents.push(Incident { family: "", index: 0, what, request });
                    deaths += 1;
                }
            }
            answers.extend(answered);
        }
        answers
    }
}
