//! An engine of the registry as a judged program without a process: the server answers in memory.

use super::ask::{Answer, Breach, Question, Subject};
use super::declared::{Declared, MOST_IN_FLIGHT, Shape};
use super::server;
use super::text::Words;
use rasterproof_registry::engines::{
    Engine, Entry, SampleValues, Specimen, TouchedPixels, Variant, WideLines,
};
use rasterproof_verify::comparison::{Watch, caught};

/// The values of both engines lie within u (15 D + 2 M) of the exact ones (`verify::tolerance`),
/// where D is at most 2 M: 32 u M.
const OWN_TOLERANCE: f64 = 32.0 * (f64::EPSILON / 2.0);

impl From<&Entry> for Declared {
    /// What an engine of the registry says of itself. A specimen promises nothing.
    fn from(entry: &Entry) -> Self {
        // A specimen, an engine and a variant of an engine each answer other questions.
        let triangle = match entry.specimen {
            Some(Specimen::Triangle(specimen)) => Some(specimen),
            _ => None,
        };
        // An engine answers whatever the pipeline around it can; the others what they were made for.
        let is_engine = entry.engine.is_some();
        let shape = match entry.variant {
            Some(Variant::Touched(TouchedPixels { is_closed: true })) => Shape::TouchedClosed,
            Some(Variant::Touched(_)) => Shape::TouchedOpen,
            _ => Shape::Sample,
        };
        let wide = match entry.variant {
            Some(Variant::WideLines(WideLines { form })) => Some(form),
            _ => None,
        };
        let values_at = match entry.variant {
            Some(Variant::SampleValues(SampleValues { at })) => Some(at),
            _ => None,
        };
        Self {
            name: entry.name.to_owned(),
            version: 2,
            coverage: is_engine
                || entry.exact_engine.is_some()
                || triangle.is_some()
                || matches!(entry.variant, Some(Variant::Touched(_))),
            shape,
            line: entry.line_engine.is_some() || matches!(entry.specimen, Some(Specimen::Line(_))),
            attributes: is_engine || triangle.is_some_and(|specimen| specimen.has_values()),
            samples4: is_engine,
            wide_line: wide.is_some(),
            wide: wide.unwrap_or_default(),
            area: matches!(entry.variant, Some(Variant::Area(_))),
            sample_values: values_at.is_some(),
            values_at: values_at.unwrap_or_default(),
            depth: is_engine,
            clip: is_engine,
            clip_attributes: is_engine,
            formulas: matches!(entry.engine, Some(Engine::Oracle)),
            batch: MOST_IN_FLIGHT / 4,
            tolerance: if is_engine { OWN_TOLERANCE } else { Self::default().tolerance },
            ..Self::default()
        }
    }
}

/// An engine of the registry that is judged in memory: its answers go through the text of the protocol, as those of a program do.
pub struct Inside {
    /// What the registry says of it, with the functions that draw.
    entry: Entry,
    /// What it would say at HELLO.
    declared: Declared,
    /// Of its panics the first one is shown.
    watch: Watch,
}

impl Inside {
    /// The engine, line drawer or specimen of this entry.
    #[must_use]
    pub fn new(entry: &Entry) -> Self {
        Self { entry: *entry, declared: entry.into(), watch: Watch::begin() }
    }

    /// The name by which the registry knows the engine, line drawer or specimen.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.entry.name
    }

    /// What the server writes for a question, read back.
    fn answer(&self, question: &Question) -> Answer {
        let mut line = Vec::new();
        // Writing to a vector does not fail.
        let _ = server::respond(&self.entry, &question.text(1), &mut line);
        let mut words = Words(&line);
        // The letter and the id come first; what follows is read as a program's answer would be.
        let letter = words.word().and_then(<[u8]>::first).copied().unwrap_or_default();
        words.word();
        let nonsense = |why: &str| Answer::Died(Breach::Nonsense.by(why));
        question.read(letter, &mut words).unwrap_or_else(nonsense)
    }
}

impl Subject for Inside {
    fn declared(&self) -> &Declared {
        &self.declared
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let (mut answers, mut deaths) = (Vec::with_capacity(questions.len()), 0);
        for question in questions {
            let answer = self.watch.during(|| caught(|| self.answer(question)));
            answers.push(answer.unwrap_or_else(|panic| {
                deaths += 1;
                Answer::Died(Breach::Crashes.by(panic.0))
            }));
            if deaths >= most_deaths {
                break;
            }
        }
        answers
    }
}
