//! What comes after the cases where something is wrong: the smallest failing cases, and why they fail, within the time for both.

use std::time::{Duration, Instant};

use super::ask::{Question, Subject};
use super::check::Truth;
use super::failures::{self, Failure};
use super::recognise::{self, Recognised, Why};
use super::run::RunFindings;
use super::timed::Timed;
use super::{Options, Step};
use rasterproof_verify::judge::LeftOut;

/// How long what comes after the cases may take.
#[derive(Clone, Copy, Debug)]
pub struct Patience {
    /// When a limited time is over.
    end: Option<Instant>,
    /// How long answers may take.
    answers: Duration,
}

impl Patience {
    /// What a time limit leaves until `end`; without one, what the convention that was looked for before has left.
    #[must_use]
    pub fn of(options: &Options, end: Option<Instant>, convention: Option<&Recognised>) -> Self {
        // Looking for the convention came first and took its part.
        let spent = convention.map_or(Duration::ZERO, |found| found.spent);
        let answers = match end {
            Some(end) => end.saturating_duration_since(Instant::now()),
            None => options.terms.patience.saturating_sub(spent),
        };
        Self { end, answers }
    }

    /// Half of it is for smaller cases.
    pub(super) fn of_shrinking(self) -> Duration {
        self.answers / 2
    }

    /// How long the answers of somebody took who is asked for causes, and those before.
    pub(super) fn spent(self, asked: &Timed<'_>) -> Duration {
        self.answers.saturating_sub(asked.left.unwrap_or_default())
    }

    /// Somebody who is asked for causes as long as it lasts, after smaller cases took so long.
    pub(super) fn limit(self, asked: &mut dyn Subject, spent: Duration) -> Timed<'_> {
        let left = Some(self.answers.saturating_sub(spent));
        Timed::new(asked, self.end).within(left)
    }
}

/// The failing cases of a run, why they fail, and what the time was too short for.
#[derive(Default)]
pub struct Explained {
    /// The failing cases that are shown.
    pub failures: Vec<Failure>,
    /// Why they fail, for each check in which something is wrong.
    pub causes: Vec<Why>,
    /// What the time was too short for.
    pub left_out: LeftOut,
}

impl Explained {
    /// What is known of a program whose answers change: what is said of one answer is not true of the next, so nothing is made
    /// smaller or explained.
    pub(super) fn changing(found: &RunFindings, options: &Options, truth: &Truth) -> Self {
        let failures = failures::changing(found, options, truth);
        Self { failures, left_out: left_out(found, options), ..Self::default() }
    }
}

/// Makes failing cases smaller and asks why they fail. `recognised` is the convention that the program seems to follow.
pub fn explain(
    program: &mut dyn Subject,
    found: &RunFindings,
    options: &Options,
    truth: &Truth,
    recognised: Option<&Recognised>,
    patience: Patience,
    progress: &(dyn Fn(Step) + Sync),
) -> Explained {
    progress(Step::Smaller);
    if !found.changing.is_empty() {
        return Explained::changing(found, options, truth);
    }
    let (failures, spent) = smaller(program, found, options, truth, patience);
    // What is wrong may all be known.
    let checks = if found.failing.is_empty() { Vec::new() } else { found.unexplained() };
    if !checks.is_empty() {
        progress(Step::Cause);
    }
    // Causes get what the smaller cases have left of the time.
    let mut asked = patience.limit(program, spent);
    let (causes, was_cut) =
        recognise::mistakes(&mut asked, &checks, truth, recognised, &failing(&failures));
    let mut left_out = left_out(found, options);
    // Whatever was cut is said, so that nobody takes silence for a result.
    left_out.convention = recognised.is_some_and(|found| found.is_late);
    left_out.shrinking = failures.iter().any(|failure| failure.evidence.shrunk.is_cut());
    left_out.cause = was_cut;
    Explained { failures, causes, left_out }
}

/// The questions of the cases that are shown, whose answers are wrong.
fn failing(failures: &[Failure]) -> Vec<Question> {
    let mut all = Vec::new();
    for failure in failures {
        all.extend(failure.evidence.exchanges.iter().map(|exchange| exchange.question.clone()));
    }
    all
}

/// The failing cases, made smaller, and how long the answers took meanwhile.
pub(super) fn smaller(
    program: &mut dyn Subject,
    found: &RunFindings,
    options: &Options,
    truth: &Truth,
    patience: Patience,
) -> (Vec<Failure>, Duration) {
    let mut asked = Timed::new(program, patience.end);
    failures::failures(&mut asked, found, options, truth, patience.of_shrinking())
}

/// The cases that a limited time was too short for.
pub(super) fn left_out(found: &RunFindings, options: &Options) -> LeftOut {
    let mut left_out = LeftOut::default();
    left_out.cases = if found.out_of_time { found.of_cases - found.cases } else { 0 };
    left_out.limit = options.time_limit;
    left_out.option = options.terms.time_limit_option();
    left_out
}
