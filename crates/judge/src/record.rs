//! A program whose answers are recorded, so that a judgement that was broken off goes on: what it has answered before is not asked
//! again.
//!
//! A judge asks the same questions again where it gets the same answers in the same time, from the first look at the windings to
//! the search for the cause. So the record of these is all that has to be saved.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use super::ask::{Answer, Breach, Complaints, Misbehaviour, Question, Subject, line};
use super::declared::Declared;
use super::text::Words;
use rasterproof_verify::comparison::pixels::mix;

/// The first word of a record.
const MAGIC: &str = "rasterproof-record-1";

/// What was asked at once.
struct Exchange {
    /// A hash of the questions.
    questions: u64,
    took: Duration,
    /// The answers, then what went wrong without a single question at fault, as lines.
    lines: Vec<String>,
    /// Where it begins in the record.
    start: usize,
}

/// Somebody who is asked only what the record does not hold.
pub struct RecordedSubject {
    asked: Box<dyn Subject>,
    /// What the record still holds, in the order in which it will be asked.
    known: VecDeque<Exchange>,
    /// The record as it will be saved.
    text: String,
    /// How long the last answers took when they were recorded.
    took: Option<Duration>,
    /// What went wrong without a single question at fault, until somebody asks for it.
    strays: Vec<Misbehaviour>,
    save: Save,
    /// When the record was last saved.
    saved: Instant,
    save_every: Duration,
}

/// What is given the record every now and then.
pub type Save = Box<dyn FnMut(&str) + Send>;

impl RecordedSubject {
    /// Goes on with a record, which is empty at first. `of` says in a line what the answers depend on.
    ///
    /// # Errors
    /// The record is none, or one of something else.
    pub fn new(
        asked: Box<dyn Subject>,
        of: &str,
        text: String,
        save_every: Duration,
        save: Save,
    ) -> Result<Self, &'static str> {
        // A record of other options, or of another program, would answer questions that are not asked.
        let begin = format!("{MAGIC} {of}\n");
        let mut text = if text.is_empty() { begin.clone() } else { text };
        if !text.starts_with(MAGIC) {
            return Err("is no checkpoint");
        }
        if !text.starts_with(&begin) {
            return Err("was made by other options, or of another program");
        }
        let known = exchanges(&mut text, begin.len());
        let (took, strays, saved) = (None, Vec::new(), Instant::now());
        Ok(Self { asked, known, text, took, strays, save, saved, save_every })
    }

    /// The record so far.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The answers of the record, if these questions are the next ones there.
    fn recorded(&mut self, questions: &[Question], hash: u64) -> Option<Vec<Answer>> {
        let next = self.known.pop_front()?;
        let mut lines = next.lines.iter();
        let read = |question: &Question| Some(read(question, lines.next()?));
        let answers: Option<Vec<Answer>> = questions.iter().map_while(read).collect();
        match answers.filter(|_| next.questions == hash) {
            Some(answers) => {
                self.strays.extend(lines.filter_map(|line| misbehaviour(line)));
                self.took = Some(next.took);
                Some(answers)
            }
            None => {
                // From here on the record is of other questions, or damaged.
                self.text.truncate(next.start);
                self.known.clear();
                None
            }
        }
    }
}

/// The exchanges of a record, from a place on. Where one was cut off, the record ends before it.
fn exchanges(text: &mut String, from: usize) -> VecDeque<Exchange> {
    let mut all = VecDeque::new();
    let mut start = from;
    while let Some((exchange, length)) = exchange(&text[start..], start) {
        all.push_back(exchange);
        start += length;
    }
    text.truncate(start);
    all
}

/// The exchange that a text begins with, which is found at `start`, and its length.
fn exchange(text: &str, start: usize) -> Option<(Exchange, usize)> {
    let (head, mut rest) = text.split_once('\n')?;
    let numbers: Vec<u64> = head.split(' ').map_while(|word| word.parse().ok()).collect();
    let [questions, micros, count] = numbers[..] else { return None };
    let mut lines = Vec::new();
    for _ in 0..count {
        let (line, after) = rest.split_once('\n')?;
        lines.push(line.to_owned());
        rest = after;
    }
    let took = Duration::from_micros(micros);
    Some((Exchange { questions, took, lines, start }, text.len() - rest.len()))
}

/// The answer of a line; nothing where it is none to this question.
fn read(question: &Question, line: &str) -> Option<Answer> {
    if let Some(what) = misbehaviour(line) {
        return Some(Answer::Died(what));
    }
    let mut words = Words(line.as_bytes());
    let letter = *words.word()?.first()?;
    words.word()?;
    question.read(letter, &mut words).ok()
}

/// What a program did instead of answering, as [`line`] writes it.
fn misbehaviour(line: &str) -> Option<Misbehaviour> {
    let line = line.strip_prefix('(')?.strip_suffix(')')?;
    let (name, how) = line.split_once(": ")?;
    Breach::ALL.into_iter().find(|breach| breach.name() == name).map(|breach| breach.by(how))
}

impl Subject for RecordedSubject {
    fn declared(&self) -> &Declared {
        self.asked.declared()
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        // The questions are told apart by a hash, together with the deaths that are allowed.
        let mut hash = 0xcbf2_9ce4_8422_2325;
        mix(&mut hash, most_deaths);
        for question in questions {
            for byte in question.text(1).bytes() {
                mix(&mut hash, u64::from(byte));
            }
        }
        if let Some(answers) = self.recorded(questions, hash) {
            return answers;
        }
        let start = Instant::now();
        let answers = self.asked.ask(questions, most_deaths);
        let took = start.elapsed();
        let strays = self.asked.strays();
        let mut lines = Vec::new();
        for answer in &answers {
            lines.push(line(answer, 1));
        }
        for what in &strays {
            lines.push(line(&Answer::Died(what.clone()), 1));
        }
        // An exchange is a line with its numbers, then a line for each answer.
        self.text += &format!("{hash} {} {}\n", took.as_micros(), lines.len());
        for line in &lines {
            self.text.push_str(&line.replace('\n', " "));
            self.text.push('\n');
        }
        self.strays.extend(strays);
        self.took = Some(took);
        // The record is saved now and then, not after each answer: it is written as a whole.
        if self.saved.elapsed() >= self.save_every {
            (self.save)(&self.text);
            self.saved = Instant::now();
        }
        answers
    }

    fn took(&self) -> Option<Duration> {
        self.took
    }

    fn cases_at_once(&self) -> u64 {
        self.asked.cases_at_once()
    }

    fn strays(&mut self) -> Vec<Misbehaviour> {
        std::mem::take(&mut self.strays)
    }

    fn finish(&mut self) -> Vec<Misbehaviour> {
        self.asked.finish()
    }

    fn complaints(&self) -> Complaints {
        self.asked.complaints()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ask::Asked;
    use crate::in_process::Inside;
    use crate::recognise::{Scope, recognise};
    use crate::{Options, judge};
    use rasterproof_core::grid::SubpixelPoint;
    use rasterproof_core::triangle::{PixelPoint, Span};
    use rasterproof_registry::engines;
    use std::sync::Arc;
    use std::sync::Mutex;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// An engine that counts what it is asked, takes its time to answer for long lines, and has no answer where a row is full.
    struct Counting {
        engine: Inside,
        asked: Arc<AtomicUsize>,
    }

    impl Subject for Counting {
        fn declared(&self) -> &Declared {
            self.engine.declared()
        }

        fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
            self.asked.fetch_add(questions.len(), Ordering::Relaxed);
            let mut answers = self.engine.ask(questions, most_deaths);
            for (question, answer) in questions.iter().zip(&mut answers) {
                match (&question.of, &*answer) {
                    (Asked::Line { ends: [a, b], .. }, _) if a.x.abs_diff(b.x) > 1 << 18 => {
                        std::thread::sleep(Duration::from_millis(120));
                    }
                    (Asked::Coverage(_), Answer::Coverage(runs)) if runs.len() == 11 => {
                        *answer = Answer::Refused("eleven rows".to_owned());
                    }
                    _ => {}
                }
            }
            answers
        }
    }

    /// What is said of an engine by a record, how many questions it was asked itself, and the record after each of its answers.
    fn judged(name: &str, text: &str) -> (String, usize, Vec<String>) {
        let asked = Arc::default();
        let engine = Inside::new(engines::find(name).unwrap());
        let counting = Counting { engine, asked: Arc::clone(&asked) };
        let texts: Arc<Mutex<Vec<String>>> = Arc::default();
        let saved = Arc::clone(&texts);
        let save = Box::new(move |text: &str| saved.lock().unwrap().push(text.to_owned()));
        let recorded = RecordedSubject::new(
            Box::new(counting),
            "a test",
            text.to_owned(),
            Duration::ZERO,
            save,
        );
        let mut options = Options::default().cases(12);
        options.families = ["half-integer", "tiny", "line-ties"].map(str::to_owned).into();
        let scope = Scope::of(&options);
        let mut askers: [Box<dyn Subject>; 1] = [Box::new(recorded.ok().unwrap())];
        let recognise = |program: &mut dyn Subject| recognise(program, scope);
        let verdict = judge(&mut askers, &options, &recognise, &|_| ());
        let said = format!(
            "{:?} {:?} {:?} {:?}",
            verdict.families, verdict.failures, verdict.cause, verdict.more.reach
        );
        let texts = std::mem::take(&mut *texts.lock().unwrap());
        (said, asked.load(Ordering::Relaxed), texts)
    }

    /// Wherever a judgement was broken off, it ends with the same verdict, and asks only what was not asked before.
    #[test]
    fn a_judgement_goes_on() {
        for name in ["games101-strict", "sysu-bresenham"] {
            let (said, all, texts) = judged(name, "");
            // How long answers took is a part of the record: the engine is slow for long lines.
            assert_eq!(said.ends_with("None"), name == "games101-strict", "{name}: {said}");
            let mut before = all + 1;
            for part in [1, texts.len() / 2, texts.len()] {
                let (again, asked, _) = judged(name, &texts[part - 1]);
                assert_eq!(again, said, "{name} {part}");
                assert!(asked < before, "{name} {part}: {asked} of {before}");
                before = asked;
            }
            assert_eq!(before, 0);
            // What was cut off or is damaged is asked once more.
            let text = &texts[texts.len() / 2];
            assert_eq!(judged(name, &text[..text.len() - 3]).0, said, "{name}, cut off");
            let damaged = text.replace(" 9\n", " nine\n").replace(" 4\n", " four\n");
            assert_ne!(damaged, *text);
            assert_eq!(judged(name, &damaged).0, said, "{name}, damaged");
        }
    }

    #[test]
    fn what_is_another_record_is_refused() {
        let new = |of: &str, text: &str| {
            let engine = Box::new(Inside::new(engines::find("scanline").unwrap()));
            let save = Box::new(|_: &str| ());
            RecordedSubject::new(engine, of, text.to_owned(), Duration::ZERO, save).err()
        };
        assert_eq!(new("this", "rasterproof-record-1 this\n"), None);
        let other = "was made by other options, or of another program";
        assert_eq!(new("that", "rasterproof-record-1 this\n"), Some(other));
        assert_eq!(new("this", "notes\n"), Some("is no checkpoint"));
    }

    /// Answers of every kind are read as they were written.
    #[test]
    fn answers_are_read_as_they_were_written() {
        let corners = [SubpixelPoint::new(0, 0); 3];
        let question = Question { width: 8, height: 8, of: Asked::Coverage(corners) };
        let run = Span { y_px: 1, x0_px: 2, x1_px: 5 };
        for answer in [
            Answer::Coverage(vec![run, run]),
            Answer::Coverage(vec![run; 4]),
            Answer::Refused("too wide: 7".to_owned()),
            Answer::Died(Breach::Hangs.by("no answer: 5 s")),
        ] {
            assert_eq!(read(&question, &line(&answer, 1)), Some(answer));
        }
        let of = Asked::Line { ends: [PixelPoint::new(0, 0); 2], whole: false };
        let question = Question { of, ..question };
        let pixels = Answer::Line(vec![(1, 2), (3, -4)]);
        assert_eq!(read(&question, &line(&pixels, 1)), Some(pixels));
    }
}
