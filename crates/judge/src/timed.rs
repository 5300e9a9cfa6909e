//! Somebody who is asked within a limited time.

use std::time::Instant;

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
    /// Requests of the next batch.
    batch: usize,
    /// Whether something was not asked, or not answered, because the time was up.
    pub is_late: bool,
}

impl<'a> Timed<'a> {
    pub fn new(asked: &'a mut dyn Subject, end: Option<Instant>) -> Self {
        Self { asked, end, batch: 1, is_late: false }
    }
}

impl Subject for Timed<'_> {
    fn declared(&self) -> &Declared {
        self.asked.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let Some(end) = self.end else { return self.asked.ask(questions, most_deaths) };
        let (mut answers, mut deaths) = (Vec::with_capacity(questions.len()), 0);
        while answers.len() < questions.len() && deaths < most_deaths {
            let start = Instant::now();
            if start >= end {
                self.is_late = true;
                break;
            }
            let rest = &questions[answers.len()..];
            let some = &rest[..rest.len().min(self.batch)];
            let answered = self.asked.ask(some, most_deaths - deaths);
            deaths += answered.iter().filter(|answer| answer.is_death()).count() as u64;
            let (count, is_whole) = (answered.len(), answered.len() == some.len());
            answers.extend(answered);
            let now = Instant::now();
            if !is_whole {
                self.is_late |= now >= end;
                break;
            }
            let each_s = (now - start).as_secs_f64() / count.max(1) as f64;
            let fit = PART * end.saturating_duration_since(now).as_secs_f64() / each_s.max(1e-9);
            self.batch = (fit as usize).clamp(1, MOST_AT_ONCE.min(2 * self.batch));
        }
        answers
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
