//! A step asked of a program: cases, the first that fails made small, and what was said about it.

use std::time::{Duration, Instant};

use super::misconceptions::{self, Misconception};
use super::{Exercise, Step};
use rasterproof_judge::ask::{Answer, Subject};
use rasterproof_judge::check::Truth;
use rasterproof_judge::declared::Declared;
use rasterproof_judge::failures::{AskedCase, Failure, Search, judge};
use rasterproof_judge::run::Failing;
use rasterproof_judge::stages::Answered;
use rasterproof_judge::timed::Timed;
use rasterproof_judge::{adapt_case, recognise, run};
use rasterproof_verify::cases::{Case, Family};
use rasterproof_verify::mistakes::{Explanation, Mistakes, NOTHING};

/// How many requests a step takes, and how much time.
#[derive(Clone, Copy, Debug)]
pub struct Amount {
    pub cases: u64,
    pub seed: u64,
    /// Nothing is asked after this, but to make a failing case smaller.
    pub end: Instant,
    /// How long the smallest failing case is looked for.
    pub patience: Duration,
}

/// What came of a step: counts, why it ended early, and its smallest failing case.
#[derive(Debug, Default)]
pub struct Outcome {
    pub cases: u64,
    pub wrong: u64,
    /// Whether the time was up before everything was asked.
    pub out_of_time: bool,
    /// Whether it had to be started again so often, for no request that could be found, that the rest was not asked.
    pub given_up: bool,
    pub failure: Option<Failure>,
    /// What explains the answers of the first exercise that failed, if anything that is known does.
    pub misconception: Option<&'static Misconception>,
    /// What the program does instead, where no misconception explains it.
    pub cause: Option<Mistakes>,
}

impl Outcome {
    /// Whether the step is passed: everything was asked, and all of it was right.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.cases > 0 && self.wrong == 0 && !self.out_of_time && !self.given_up
    }
}

/// A case that fails, and the exercise it belongs to.
struct Wrong<'a> {
    exercise: &'a Exercise,
    is: Failing,
    case: Case,
    truth: Truth,
    asked: AskedCase,
}

/// Asks all exercises of a step. What the program says of its rule, its grid and its range does not
/// count here: the course has one convention.
pub fn examine(program: &mut dyn Subject, step: &Step, amount: &Amount) -> Outcome {
    // The first case that fails is kept with its exercise, to be made small at the end.
    let mut outcome = Outcome::default();
    let mut failing = None;
    let mut restarts = run::MOST_DEATHS;
    program.end_at(Some(amount.end));
    // All exercises are asked, also after one has failed, so that the number of wrong cases is that of the step.
    for exercise in &step.exercises {
        let mut asked = Vec::new();
        let had_failed = failing.is_some();
        for family in &exercise.families {
            if Instant::now() >= amount.end {
                outcome.out_of_time = true;
            }
            if outcome.out_of_time || restarts == 0 {
                break;
            }
            // Of several families of one exercise, the first one that fails gives the case.
            let first = ask_family(
                program,
                exercise,
                family,
                amount,
                &mut restarts,
                &mut outcome,
                &mut asked,
            );
            failing = failing.or(first);
        }
        // The first exercise that fails is the one that is explained.
        if !had_failed && failing.is_some() {
            outcome.misconception = misconceptions::find(exercise.check, &asked, &truth(exercise));
        }
    }
    program.end_at(None);
    // A function that sets no pixel in this step may do so in others, which tell why.
    // The judge looks for a cause where no misconception is known, or only that nothing is drawn.
    let is_named = outcome.misconception.is_some_and(|is| is.name != NOTHING);
    let unexplained = failing.as_ref().filter(|_| !is_named);
    outcome.cause = unexplained.and_then(|failing| cause(program, failing, amount.patience));
    let is_nothing = |cause: &Explanation| cause.name == NOTHING;
    // Of both explanations one is said: the judge's where it knows the mistake, else the misconception.
    match &outcome.cause {
        Some(cause) if cause.causes.iter().any(is_nothing) => outcome.cause = None,
        Some(cause) if cause.is_known() => outcome.misconception = None,
        _ => {}
    }
    // Last of all, for this may take long, and everything else is known by now.
    outcome.failure = failing.map(|Wrong { exercise, is, case, truth, asked }| {
        // What preparation would change is no case of the step.
        let may_be = |case: &Case| (exercise.prepare)(case.clone()).as_ref() == Some(case);
        let &Amount { seed, patience, .. } = amount;
        let search =
            Search { check: exercise.check, truth: &truth, seed, patience, may_be: &may_be };
        search.smallest(program, &is, case, asked)
    });
    outcome
}

/// Answers of each family that a misconception has to explain.
const ASKED_OF_A_FAMILY: usize = 200;

/// A design gets ten times as many cases as another family: 1,000 by default, which have all pairs of its facts.
pub(super) fn cases_of(family: &Family, cases: u64) -> u64 {
    if family.design().is_some() { 10 * cases } else { cases }
}

/// Asks the cases of a family; the first that fails. No step is passed with a request that the program does not answer, so
/// the rest is not asked after the first of these: each would cost the whole time limit again.
fn ask_family<'a>(
    program: &mut dyn Subject,
    exercise: &'a Exercise,
    name: &str,
    amount: &Amount,
    restarts: &mut u64,
    outcome: &mut Outcome,
    asked: &mut Vec<Answered>,
) -> Option<Wrong<'a>> {
    let check = exercise.check;
    let truth = truth(exercise);
    let family = adapt_case::families(&[name.to_owned()])[0];
    // All requests of the family in one list, and which of them belong to each case.
    let mut cases = Vec::new();
    // A case may need several requests, which follow each other in the list.
    let mut questions = Vec::new();
    for index in 0..cases_of(family, amount.cases) {
        let case = adapt_case::case(family, amount.seed, index, &truth.declared);
        let Some(case) = (exercise.prepare)(case).filter(|case| check.fits(case)) else {
            continue;
        };
        let start = questions.len();
        check.questions(&case, &truth, &mut questions);
        cases.push((index, case, start..questions.len()));
    }
    // They are sent together, until the program has died or was started again too often.
    let mut answers = Vec::new();
    while answers.len() < questions.len() && *restarts > 0 {
        // The first one alone: if it hangs, it need not be looked for among those in flight.
        let end = if answers.is_empty() { 1 } else { questions.len() };
        let asked = &questions[answers.len()..end];
        let here = program.ask(asked, 1);
        let died = here.last().is_some_and(Answer::is_death);
        // A program that died of no single request goes on, a few times.
        // Fewer answers than requests, without a death, mean that it ended or was too slow.
        let is_short = !died && here.len() < asked.len();
        outcome.out_of_time |= is_short && Instant::now() >= amount.end;
        if outcome.out_of_time {
            answers.extend(here);
            break;
        }
        let strayed = is_short;
        *restarts = if died { 0 } else { *restarts - u64::from(strayed) };
        outcome.given_up |= strayed && *restarts == 0;
        answers.extend(here);
    }
    // Every case is judged by its own answers, and the first one that fails is kept.
    let mut first = None;
    for (index, case, range) in cases {
        // Where the program was given up, the rest of the answers is not there.
        if answers.len() < questions.len() && range.start >= answers.len() {
            break;
        }
        let here = &answers[range.start..range.end.min(answers.len())];
        // Each answer is compared with the exact one by the rules of the step.
        let judged = judge(check, &case, here, range.len(), &truth);
        outcome.cases += 1;
        let is_wrong = judged.is_wrong();
        outcome.wrong += u64::from(is_wrong);
        let exchanged = || (questions[range.clone()].to_vec(), here.to_vec());
        if here.len() == range.len() && range.end <= ASKED_OF_A_FAMILY {
            let (questions, answers) = exchanged();
            asked.push(Answered { questions, answers, is_wrong });
        }
        if is_wrong && first.is_none() {
            let (questions, answers) = exchanged();
            first = Some((index, case, AskedCase { questions, answers, judged }));
        }
    }
    first.map(|(index, case, asked)| {
        // A case can be generated again from its family and its number.
        let is = Failing::new(family, index, check, &asked.judged);
        Wrong { exercise, is, case, truth, asked }
    })
}

/// What a program is judged by: the course's convention, and no limit that it declares.
fn truth(exercise: &Exercise) -> Truth {
    let mut declared = Declared::default();
    exercise.convention.split_whitespace().for_each(|word| declared.hear(word));
    Truth::of(&declared)
}

/// What is known of the mistake of a program that answers.
fn cause(program: &mut dyn Subject, failing: &Wrong<'_>, patience: Duration) -> Option<Mistakes> {
    if !failing.asked.judged.died.is_empty() {
        return None;
    }
    // The judge asks more than the step did: cases that tell mistakes apart.
    let checks = [failing.exercise.check.of_its_cause()];
    // Questions for a cause take time, which the step limits.
    let mut asked = Timed::new(program, None).within(Some(patience));
    let (found, _) = recognise::mistakes(&mut asked, &checks, &failing.truth, None, &[]);
    Some(found.into_iter().next()?.why)
}

/// A note of the last line of a program's standard error, if it wrote any.
pub fn complaint(program: &dyn Subject) -> Option<String> {
    program.complaints().shown.pop().map(|last| format!("its standard error ends: {last}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::STEPS;
    use rasterproof_judge::ask::{Asked, Breach, Misbehaviour, Question};
    use rasterproof_judge::in_process::Inside;
    use rasterproof_registry::engines;

    /// A program whose requests all come to nothing, and how many it was asked.
    struct Silent {
        declared: Declared,
        /// What each request comes to; without it no request is found that the program ends at.
        death: Option<Misbehaviour>,
        asked: usize,
    }

    impl Subject for Silent {
        fn declared(&self) -> &Declared {
            &self.declared
        }

        fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
            self.asked += questions.len();
            let death = self.death.clone().map(Answer::Died);
            death.into_iter().cycle().take(questions.len().min(most_deaths as usize)).collect()
        }
    }

    fn examined(death: Option<Misbehaviour>) -> (Outcome, usize) {
        let step = &STEPS[0];
        let declared = truth(&step.exercises[0]).declared;
        let mut program = Silent { declared, death, asked: 0 };
        let end = Instant::now() + Duration::from_secs(3600);
        let amount = Amount { cases: 50, seed: 1, end, patience: Duration::ZERO };
        (examine(&mut program, step, &amount), program.asked)
    }

    /// An engine that draws only so many triangles of one question about depth.
    struct FirstOnly(Inside, usize);

    impl Subject for FirstOnly {
        fn declared(&self) -> &Declared {
            self.0.declared()
        }

        fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
            let mut seen = questions.to_vec();
            for question in &mut seen {
                if let Asked::Depth(list) = &mut question.of {
                    list.truncate(self.1);
                }
            }
            self.0.ask(&seen, most_deaths)
        }
    }

    /// The families of piles have five triangles at most: only a design asks more of them together.
    #[test]
    fn a_step_asks_the_design_of_its_question() {
        let step = crate::course::find("depth").unwrap();
        let end = Instant::now() + Duration::from_secs(3600);
        let amount = Amount { cases: 100, seed: 1, end, patience: Duration::ZERO };
        let engine = || Inside::new(engines::find("scanline").unwrap());
        assert!(examine(&mut FirstOnly(engine(), 64), step, &amount).passes());
        let outcome = examine(&mut FirstOnly(engine(), 16), step, &amount);
        let failure = outcome.failure.unwrap();
        assert_eq!((failure.family, outcome.wrong > 0), ("depth-design", true));
    }

    #[test]
    fn what_is_not_answered_is_not_asked_again() {
        let (outcome, asked) = examined(Some(Breach::Hangs.by("")));
        assert!(!outcome.passes() && !outcome.given_up && outcome.failure.is_some());
        assert_eq!((outcome.cases, outcome.wrong, asked), (1, 1, 1));
        // Where no request is at fault, it is started again a few times.
        let (outcome, asked) = examined(None);
        assert!(!outcome.passes() && outcome.given_up && outcome.failure.is_none());
        assert_eq!((outcome.cases, outcome.wrong, asked as u64), (0, 0, run::MOST_DEATHS));
    }
}
