//! A step asked of a program: cases, the first that fails made small, and what was said about it.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use super::misconceptions::{self, Misconception};
use super::{Exercise, Step};
use rasterproof_judge::ask::{Answer, Ask, Breach, Question, show};
use rasterproof_judge::check::{Check, Truth, expected_answer};
use rasterproof_judge::declared::Declared;
use rasterproof_judge::finding::Finding;
use rasterproof_judge::pictured::{Pictured, pictured};
use rasterproof_judge::shrink::smaller;
use rasterproof_judge::{adapt_case, recognise, run};
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::mistakes::Mistakes;

#[derive(Clone, Copy, Debug)]
pub struct Amount {
    pub cases: u64,
    pub seed: u64,
    /// Nothing is asked after this, but to make a failing case smaller.
    pub end: Instant,
    /// How long the smallest failing case is looked for.
    pub patience: Duration,
}

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

#[derive(Debug)]
pub struct Failure {
    pub found: String,
    pub what: String,
    /// Requests, answers and expected answers, as lines of the protocol.
    pub lines: Vec<[String; 3]>,
    /// What was drawn, and what was expected, where there are both.
    pub picture: Option<Pictured>,
}

/// A case that fails, and the exercise it belongs to.
struct Failing<'a> {
    exercise: &'a Exercise,
    found: String,
    case: Case,
    truth: Truth,
    asked: Vec<(Question, Answer)>,
    /// Questions of the case; not all of them are answered where the program died.
    questions: usize,
}

/// Asks all exercises of a step. What the program says of its rule, its grid and its range does not
/// count here: the course has one convention.
pub fn examine(program: &mut dyn Ask, step: &Step, amount: &Amount) -> Outcome {
    let mut outcome = Outcome::default();
    let mut failing = None;
    let mut restarts = run::MOST_DEATHS;
    program.end_at(Some(amount.end));
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
        if !had_failed && failing.is_some() {
            outcome.misconception = misconceptions::find(&asked, &truth(exercise));
        }
    }
    program.end_at(None);
    let unexplained = failing.as_ref().filter(|_| outcome.misconception.is_none());
    outcome.cause = unexplained.and_then(|failing| cause(program, failing, amount.patience));
    outcome.failure = failing.map(|failing| shrunk(program, failing, amount.patience));
    outcome
}

/// Answers of each family that a misconception has to explain.
const ASKED_OF_A_FAMILY: usize = 200;

/// Asks the cases of a family; the first that fails. No step is passed with a request that the program does not answer, so
/// the rest is not asked after the first of these: each would cost the whole time limit again.
fn ask_family<'a>(
    program: &mut dyn Ask,
    exercise: &'a Exercise,
    name: &str,
    amount: &Amount,
    restarts: &mut u64,
    outcome: &mut Outcome,
    asked: &mut Vec<(Question, Answer)>,
) -> Option<Failing<'a>> {
    let check = exercise.check;
    let truth = truth(exercise);
    let family = adapt_case::families(&[name.to_owned()])[0];
    let mut cases = Vec::new();
    let mut questions = Vec::new();
    for index in 0..amount.cases {
        let case = adapt_case::put(family.case(amount.seed, index), &truth.declared);
        let Some(case) = (exercise.prepare)(case).filter(|case| fits(check, case)) else {
            continue;
        };
        let start = questions.len();
        check.questions(&case, &truth, &mut questions);
        cases.push((index, case, start..questions.len()));
    }
    let mut answers = Vec::new();
    while answers.len() < questions.len() && *restarts > 0 {
        // The first one alone: if it hangs, it need not be looked for among those in flight.
        let end = if answers.is_empty() { 1 } else { questions.len() };
        let asked = &questions[answers.len()..end];
        let here = program.ask(asked, 1);
        let died = here.last().is_some_and(Answer::is_death);
        // A program that died of no single request goes on, a few times.
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
    let mut first = None;
    for (question, answer) in questions.iter().zip(&answers).take(ASKED_OF_A_FAMILY) {
        asked.push((question.clone(), answer.clone()));
    }
    for (index, case, range) in cases {
        // Where the program was given up, the rest of the answers is not there.
        if answers.len() < questions.len() && range.start >= answers.len() {
            break;
        }
        let here = &answers[range.start..range.end.min(answers.len())];
        let finding = judge(check, &case, here, range.len(), &truth);
        outcome.cases += 1;
        outcome.wrong += u64::from(finding.is_wrong());
        if finding.is_wrong() && first.is_none() {
            let pairs = questions[range.clone()].iter().zip(here);
            let asked =
                pairs.map(|(question, answer)| (question.clone(), answer.clone())).collect();
            first = Some((format!("{name} #{index}"), case, asked, range.len()));
        }
    }
    first.map(|(found, case, asked, questions)| Failing {
        exercise,
        found,
        case,
        truth,
        asked,
        questions,
    })
}

/// What a program is judged by: the course's convention, and no limit that it declares.
fn truth(exercise: &Exercise) -> Truth {
    let mut declared = Declared::default();
    exercise.convention.split_whitespace().for_each(|word| declared.hear(word));
    Truth::of(&declared)
}

/// A mesh has to be one to be asked for its holes.
fn fits(check: Check, case: &Case) -> bool {
    match &case.shape {
        Shape::Triangles { disjoint, .. } => check != Check::Watertight || *disjoint,
        _ => true,
    }
}

fn judge(check: Check, case: &Case, answers: &[Answer], asked: usize, truth: &Truth) -> Finding {
    if answers.len() < asked {
        Check::judge_deaths(answers)
    } else {
        check.judge(case, answers, truth)
    }
}

/// The mistake of a program that answers, where a known one explains it.
fn cause(program: &mut dyn Ask, failing: &Failing<'_>, patience: Duration) -> Option<Mistakes> {
    if failing.asked.iter().any(|(_, answer)| answer.is_death()) {
        return None;
    }
    let start = Instant::now();
    let goes_on = || start.elapsed() < patience;
    let checks = [match failing.exercise.check {
        Check::Watertight | Check::Order => Check::Coverage,
        Check::Direction => Check::Line,
        check => check,
    }];
    let found = recognise::mistakes(program, &checks, &failing.truth, None, &goes_on);
    found.into_iter().map(|found| found.why).find(Mistakes::is_known)
}

fn shrunk(program: &mut dyn Ask, failing: Failing<'_>, patience: Duration) -> Failure {
    let Failing { exercise, found, case, truth, asked, questions } = failing;
    let check = exercise.check;
    let program = RefCell::new(program);
    let ask = |case: &Case| {
        let mut questions = Vec::new();
        check.questions(case, &truth, &mut questions);
        let answers = program.borrow_mut().ask(&questions, run::MOST_DEATHS);
        let finding = judge(check, case, &answers, questions.len(), &truth);
        (questions, answers, finding)
    };
    let is_slow = |answer: &Answer| matches!(answer, Answer::Died(what) if matches!(what.breach, Breach::Hangs | Breach::Late));
    let start = Instant::now();
    // What takes long to go wrong is shown as it is, and not asked again.
    let (case, (questions, answers, finding)) = if asked.iter().any(|(_, a)| is_slow(a)) {
        let (all, answers): (Vec<_>, Vec<_>) = asked.into_iter().unzip();
        let finding = judge(check, &case, &answers, questions, &truth);
        (case, (all, answers, finding))
    } else {
        let case = smaller(check, case, |smaller| {
            let smaller = adapt_case::put(smaller.clone(), &truth.declared);
            start.elapsed() < patience
                && adapt_case::holds(&smaller, &truth.declared)
                && fits(check, &smaller)
                && (exercise.prepare)(smaller.clone()).as_ref() == Some(&smaller)
                && ask(&smaller).2.is_wrong()
        });
        let shown = ask(&case);
        (case, shown)
    };
    let what = if finding.is_wrong() {
        finding.describe(check)
    } else {
        "wrong at first, right when asked again".to_owned()
    };
    let picture = pictured(check, &case, &answers, &truth);
    let line = |(question, answer): (&Question, &Answer)| {
        let expected = expected_answer(question, &truth).filter(|_| is_one_by_one(check));
        let expected = expected.map_or_else(String::new, |e| show(&e, 1));
        [question.text(1), show(answer, 1), expected]
    };
    let lines = questions.iter().zip(&answers).map(line).collect();
    Failure { found, what, lines, picture }
}

/// Whether each answer is compared with an expected one, not with others.
fn is_one_by_one(check: Check) -> bool {
    matches!(check, Check::Coverage | Check::Line | Check::Values | Check::Depth | Check::Near)
}

/// The last line of a program's standard error, if it wrote any.
pub fn complaint(program: &dyn Ask) -> Option<String> {
    program.complaints().pop()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::STEPS;
    use rasterproof_judge::ask::Misbehaviour;

    /// A program whose requests all come to nothing, and how many it was asked.
    struct Silent {
        declared: Declared,
        /// What each request comes to; without it no request is found that the program ends at.
        death: Option<Misbehaviour>,
        asked: usize,
    }

    impl Ask for Silent {
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
