//! What the learner asks of a stage: how an answer is taken apart, and what may be done wrongly.
//!
//! A stage implements [`Learnable`] with types of its own. The learner sees it as [`AnyLearnable`] and the parts of its answers as
//! [`AnyParts`], which hide these types: so the learner is compiled once, and not once for each stage.

use std::any::Any;
use std::marker::PhantomData;
use std::rc::Rc;

use rasterproof_verify::cases::Case;
use rasterproof_verify::cases::facts::Topic;
use rasterproof_verify::learn::rows::{Quantities, of_topic};
use rasterproof_verify::learn::trial::Work;

use crate::adapt_case;
use crate::ask::{Answer, Question};
use crate::declared::Declared;
use crate::stages::search::{at_places, hidden};

/// A question that the program was given, with its answer and what is computed of both.
pub struct LearnedCase {
    /// Its place among the cases of the learner, by which examples are told apart.
    pub(super) number: usize,
    pub(super) case: Case,
    pub(super) question: Question,
    pub(super) answer: Answer,
    /// The numbers of the question that conditions are about.
    pub(super) facts: Vec<i64>,
    /// Whether it refuted a chain: more of its parts are then looked at.
    pub(super) is_refuting: bool,
}

/// A stage of the pipeline whose mistakes are learned: how an answer is taken apart, and what may be done wrongly.
pub trait Learnable: 'static {
    /// What is answered at once, with the answer.
    type Part<'a>: 'a;
    /// What a program may do in place of what is right.
    type Change: 'static;
    /// The kind of question, with its facts.
    const TOPIC: &'static Topic;
    /// The word for a part, in the singular, as messages have it.
    const PART: &'static str;

    /// The quantities of a question beyond those of its kind.
    fn of_question(case: &Case, out: &mut Quantities);

    /// The parts of an answer, in an order that is the same for every run.
    fn parts<'a>(asked: &'a LearnedCase, declared: &Declared) -> Vec<Self::Part<'a>>;

    /// Whether a program without a mistake may give this part.
    fn is_right(part: &Self::Part<'_>) -> bool;

    /// Whether the answer is the one that a program with this change gives.
    fn explains(change: &Self::Change, part: &Self::Part<'_>) -> bool;

    /// The quantities of a part, and of what a change makes of it.
    fn of_part(part: &Self::Part<'_>, change: Option<&Self::Change>, out: &mut Quantities);

    /// The changes that may explain wrong parts, the simplest first; what is read off is read off these, and off right ones.
    fn changes<'a>(
        wrong: &[&Self::Part<'a>],
        right: &[&Self::Part<'a>],
        work: &Work,
    ) -> Vec<Self::Change>;

    /// The program that makes two mistakes at once, if there is one.
    fn both(_: &Self::Change, _: &Self::Change) -> Option<Self::Change> {
        None
    }

    /// What is said of a change, after 'it'.
    fn says(change: &Self::Change) -> String;
}

/// A change of any stage. Only the stage that made it looks into it.
pub(super) type AnyChange = Rc<dyn Any>;

/// A stage whose types are hidden: see [`Learnable`].
pub(super) trait AnyLearnable {
    fn topic(&self) -> &'static Topic;
    fn part_name(&self) -> &'static str;
    fn of_question(&self, case: &Case, out: &mut Quantities);
    fn both(&self, first: &AnyChange, second: &AnyChange) -> Option<AnyChange>;
    fn says(&self, change: &AnyChange) -> String;
    /// An empty list of parts.
    fn no_parts<'a>(&self) -> Box<dyn AnyParts<'a> + 'a>;
}

/// Parts of answers of one stage. Each is meant by its place in the list.
pub(super) trait AnyParts<'a> {
    fn count(&self) -> usize;

    /// Adds all parts of an answer.
    fn add(&mut self, asked: &'a LearnedCase, declared: &Declared);

    /// Adds some of the parts of an answer: of the wrong ones at most the first number, of the right ones the second, evenly
    /// spread.
    fn add_some(&mut self, asked: &'a LearnedCase, declared: &Declared, most: [usize; 2]);

    /// See [`Learnable::is_right`].
    fn is_right(&self, place: usize) -> bool;

    fn explains(&self, change: &AnyChange, place: usize) -> bool;

    fn of_part(&self, place: usize, change: Option<&AnyChange>, out: &mut Quantities);

    /// The changes that may explain the parts at the first places, where those at the second are right.
    fn changes(&self, wrong: &[usize], right: &[usize], work: &Work) -> Vec<AnyChange>;
}

/// Hides the types of a stage.
pub(super) struct LearnableOf<L>(pub(super) PhantomData<L>);

/// Hides the type of the parts of a stage.
struct PartsOf<'a, L: Learnable>(Vec<L::Part<'a>>);

/// The change as the stage knows it.
fn typed<L: Learnable>(change: &AnyChange) -> &L::Change {
    change.downcast_ref().expect("a change of this stage")
}

impl<L: Learnable> AnyLearnable for LearnableOf<L> {
    fn topic(&self) -> &'static Topic {
        L::TOPIC
    }

    fn part_name(&self) -> &'static str {
        L::PART
    }

    fn of_question(&self, case: &Case, out: &mut Quantities) {
        L::of_question(case, out);
    }

    fn both(&self, first: &AnyChange, second: &AnyChange) -> Option<AnyChange> {
        let both = L::both(typed::<L>(first), typed::<L>(second))?;
        Some(Rc::new(both))
    }

    fn says(&self, change: &AnyChange) -> String {
        L::says(typed::<L>(change))
    }

    fn no_parts<'a>(&self) -> Box<dyn AnyParts<'a> + 'a> {
        Box::new(PartsOf::<'a, L>(Vec::new()))
    }
}

impl<'a, L: Learnable> AnyParts<'a> for PartsOf<'a, L> {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn add(&mut self, asked: &'a LearnedCase, declared: &Declared) {
        self.0.append(&mut L::parts(asked, declared));
    }

    fn add_some(&mut self, asked: &'a LearnedCase, declared: &Declared, most: [usize; 2]) {
        // Wrong parts are few and say most, so that both are chosen from apart.
        let (right, wrong): (Vec<_>, Vec<_>) =
            L::parts(asked, declared).into_iter().partition(L::is_right);
        for (parts, most) in [wrong, right].into_iter().zip(most) {
            let step = parts.len().div_ceil(most).max(1);
            self.0.extend(parts.into_iter().step_by(step));
        }
    }

    fn is_right(&self, place: usize) -> bool {
        L::is_right(&self.0[place])
    }

    fn explains(&self, change: &AnyChange, place: usize) -> bool {
        L::explains(typed::<L>(change), &self.0[place])
    }

    fn of_part(&self, place: usize, change: Option<&AnyChange>, out: &mut Quantities) {
        L::of_part(&self.0[place], change.map(typed::<L>), out);
    }

    fn changes(&self, wrong: &[usize], right: &[usize], work: &Work) -> Vec<AnyChange> {
        let [wrong, right] = [wrong, right].map(|places| at_places(&self.0, places));
        hidden(L::changes(&wrong, &right, work))
    }
}

/// The quantities of a case, with their names or without.
pub(super) fn of_case(
    stage: &dyn AnyLearnable,
    case: &Case,
    declared: &Declared,
    is_named: bool,
) -> Quantities {
    let mut out = if is_named { Quantities::with_names() } else { Quantities::default() };
    // First the facts that every question of this kind has, then those that the stage adds.
    let numbers = stage.topic().numbers(case, &adapt_case::limits(declared)).unwrap_or_default();
    of_topic(stage.topic(), &numbers, &mut out);
    stage.of_question(case, &mut out);
    out
}

/// At most so many of some values, evenly spread over all of them.
pub(super) fn spread<T: Copy>(all: &[T], most: usize) -> Vec<T> {
    let count = all.len().min(most);
    (0..count).map(|i| all[i * all.len() / count]).collect()
}
