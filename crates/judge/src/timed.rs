//! Somebody who is asked within a limited time.

use std::time::{Duration, Instant};

use super::ask::{Answer, Complaints, Misbehaviour, Question, Subject};
use super::declared::Declared;

/// A batch is to take this part of the time that is left.
const PART: f64 = 0.25;
/// More requests than this are never one batch.
const MOST_AT_ONCE: usize = 1 << 16;

/// Asks in batches that begin with one request and grow as far as the measured time per answer allows. Without a
/// limit all requests are one batch.
pub struct Timed<'a> {
    asked: &'a mut dyn Subject,
    /// No batch is begun after this.
    pub end: Option<Instant>,
    /// How long its answers may still take in all. What the judge itself computes does not count, so that of a program that answers
    /// at once nothing is left out on a busy machine.
    pub left: Option<Duration>,
    /// Requests of the next batch.
    batch: usize,
    /// Answers so far, and how long they took.
    answered: u32,
    /// How long the last answers took.
    took: Duration,
    /// Whether something was not asked, or not answered, because the time was up.
    pub is_late: bool,
}

impl<'a> Timed<'a> {
    /// Somebody who is asked until a time; `None` is no end.
    pub fn new(asked: &'a mut dyn Subject, end: Option<Instant>) -> Self {
        let took = Duration::ZERO;
        Self { asked, end, left: None, batch: 1, answered: 0, took, is_late: false }
    }

    /// The same, whose answers may take so long in all.
    #[must_use]
    pub fn within(self, left: Option<Duration>) -> Self {
        Self { left, ..self }
    }

    /// What is left of the limited time.
    #[must_use]
    pub fn rest(&self) -> Option<Duration> {
        let until_end = self.end.map(|end| end.saturating_duration_since(Instant::now()));
        until_end.into_iter().chain(self.left).min()
    }

    /// How many questions are answered in the time that is left. Only of a slow program does the number depend on the machine.
    #[must_use]
    pub fn questions_left(&self) -> usize {
        let Some(rest) = self.rest() else { return usize::MAX };
        let each = self.took / self.answered.max(1);
        (rest.as_nanos() / each.as_nanos().max(1)) as usize
    }
}

impl Subject for Timed<'_> {
    fn declared(&self) -> &Declared {
        self.asked.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        if self.rest().is_none() {
            return self.asked.ask(questions, most_deaths);
        }
        let (mut answers, mut deaths) = (Vec::with_capacity(questions.len()), 0);
        while answers.len() < questions.len() && deaths < most_deaths {
            let start = Instant::now();
            if self.rest().is_some_and(|rest| rest.is_zero()) {
                self.is_late = true;
                break;
            }
            let rest = &questions[answers.len()..];
            let some = &rest[..rest.len().min(self.batch)];
            let answered = self.asked.ask(some, most_deaths - deaths);
            deaths += answered.iter().filter(|answer| answer.is_death()).count() as u64;
            let (count, is_whole) = (answered.len(), answered.len() == some.len());
            answers.extend(answered);
            let took = self.asked.took().unwrap_or_else(|| start.elapsed());
            self.answered += count as u32;
            self.took += took;
            self.left = self.left.map(|left| left.saturating_sub(took));
            let rest = self.rest().unwrap_or_default();
            if !is_whole {
                self.is_late |= rest.is_zero();
                break;
            }
            let each_s = took.as_secs_f64() / count.max(1) as f64;
            let fit = PART * rest.as_secs_f64() / each_s.max(1e-9);
            self.batch = (fit as usize).clamp(1, MOST_AT_ONCE.min(2 * self.batch));
        }
        answers
    }

    fn took(&self) -> Option<Duration> {
        self.asked.took()
    }

    fn cases_at_once(&self) -> u64 {
        self.asked.cases_at_once()
    }

    fn strays(&mut self) -> Vec<Misbehaviour> {
        self.asked.strays()
    }

    fn finish(&mut self) -> Vec<Misbehaviour> {
        self.asked.finish()
    }

    fn complaints(&self) -> Complaints {
        self.asked.complaints()
    }
}
