//! Failing cases made small while the program is asked, and what was said about them.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use super::Options;
use super::adapt_case;
use super::ask::{Answer, Question, Subject, show};
use super::check::{Check, Truth, expected_answer};
use super::judged::Judged;
use super::pictured::{Pictured, pictured};
use super::run::{Failing, Found, Row};
use super::shrink::smaller;
use rasterproof_verify::cases::Case;

/// A failing case with the requests of the smallest one, and their answers.
pub type Failure = rasterproof_verify::judge::Failure<Case, Exchanged>;

/// What was asked and answered in a failing case.
#[derive(Clone, Debug)]
pub struct Exchanged {
    pub property: &'static str,
    pub check: Check,
    /// How far it was made smaller, in words.
    pub shrunk: &'static str,
    pub exchanges: Vec<Exchange>,
    /// All its answers as one picture, and the one expected, where there are both.
    pub picture: Option<Pictured>,
}

/// A request, its answer, and the answer that was expected; as lines of the protocol.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Exchange {
    pub request: String,
    pub answer: String,
    /// What the other of two compared programs answered, or nothing.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub other: String,
    /// What was expected instead, or nothing.
    pub expected: String,
}

/// Properties whose first failing case is shown.
const MOST_SHOWN: usize = 6;

/// The first failing case of each property that is not known, shrunk: holes and doubles, then those of the most
/// often wrong. Where the pictures show what is wrong, it comes first.
pub fn failures(
    program: &mut dyn Subject,
    found: &Found,
    options: &Options,
    truth: &Truth,
) -> Vec<Failure> {
    let mut rows: Vec<_> = found.rows.iter().filter(|row| row.wrong_cases > 0).collect();
    let share = |row: &Row| if row.name == "watertight" { f64::INFINITY } else { row.share() };
    rows.sort_by(|a, b| share(b).total_cmp(&share(a)));
    let is_known = |f: &Failing| {
        !options.terms.known.is_empty()
            && options.terms.known.get(&f.name()) == Some(&f.fingerprint)
    };
    let news: Vec<&Failing> = found.failing.iter().filter(|f| !is_known(f)).collect();
    let of = |name: &str| news.iter().find(|f| f.property == name);
    let firsts = rows.into_iter().filter_map(|row| of(row.name)).take(MOST_SHOWN);
    let (start, patience) = (Instant::now(), options.terms.patience);
    let shown = firsts.filter_map(|failing| {
        // A program that is slow, or has to be started again, gets this time for all of them together.
        let left = (2 * patience).saturating_sub(start.elapsed()).min(patience);
        failure(program, found, failing, left, options, truth)
    });
    let mut shown: Vec<_> = shown.collect();
    let is_same = |f: &Failure| f.evidence.picture.as_ref().is_none_or(|p| p.drawn == p.expected);
    shown.sort_by_key(is_same);
    shown
}

/// A case that was asked, with what came of it.
pub struct Asked {
    pub questions: Vec<Question>,
    pub answers: Vec<Answer>,
    pub judged: Judged,
}

impl Asked {
    fn of(program: &mut dyn Subject, check: Check, case: &Case, truth: &Truth) -> Self {
        let mut questions = Vec::new();
        check.questions(case, truth, &mut questions);
        // Of a case that the program dies of, one request is enough.
        let answers = program.ask(&questions, 1);
        let judged = judge(check, case, &answers, questions.len(), truth);
        Self { questions, answers, judged }
    }

    /// Whether answers are missing, and not because the program died: the time is up.
    fn is_late(&self) -> bool {
        self.answers.len() < self.questions.len() && self.judged.died.is_empty()
    }

    /// Whether it takes long to go wrong.
    fn is_slow(&self) -> bool {
        self.judged.died.iter().any(|(_, what)| what.is_slow())
    }
}

fn failure(
    program: &mut dyn Subject,
    found: &Found,
    failing: &Failing,
    patience: Duration,
    options: &Options,
    truth: &Truth,
) -> Option<Failure> {
    let family = adapt_case::family(failing.family)?;
    let case = adapt_case::put(family.case(options.seed, failing.index), &truth.declared);
    let check = Check::of_truth(family.name, &case, failing.index, truth)
        .into_iter()
        .find(|check| check.name(family.name) == failing.property)?;
    let leaves = adapt_case::leaves_window(&case);
    let may_be = |smaller: &Case| leaves || !adapt_case::leaves_window(smaller);
    let first = Asked::of(program, check, &case, truth);
    let was_asked = !first.is_late();
    let search = Search { check, truth, seed: options.seed, patience, may_be: &may_be };
    let mut failure = search.smallest(program, failing, case, first);
    if !was_asked {
        let described = found.described.get(&failing.name());
        failure.what = described.map_or("wrong", String::as_str).to_owned();
        failure.evidence.picture = None;
    }
    Some(failure)
}

/// How a failing case is made smaller.
pub struct Search<'a> {
    pub check: Check,
    pub truth: &'a Truth,
    /// The seed by which the failing case was generated.
    pub seed: u64,
    pub patience: Duration,
    /// Whether a smaller case is one to ask.
    pub may_be: &'a dyn Fn(&Case) -> bool,
}

impl Search<'_> {
    /// What takes long to go wrong is shown as it is, and not asked again.
    pub fn smallest(
        &self,
        program: &mut dyn Subject,
        failing: &Failing,
        original: Case,
        first: Asked,
    ) -> Failure {
        let &Self { check, truth, seed, patience, may_be } = self;
        let program = RefCell::new(program);
        let ask = |case: &Case| Asked::of(*program.borrow_mut(), check, case, truth);
        let start = Instant::now();
        let (was_wrong, was_late, is_slow) =
            (first.judged.is_wrong(), first.is_late(), first.is_slow());
        // The answers to the smallest case so far.
        let kept = RefCell::new(first);
        let case = if !was_wrong || is_slow {
            original.clone()
        } else {
            smaller(check, original.clone(), |smaller| {
                let is_asked = adapt_case::holds(smaller, &truth.declared)
                    && may_be(smaller)
                    && start.elapsed() < patience;
                let smaller = adapt_case::put(smaller.clone(), &truth.declared);
                if !is_asked || !check.fits(&smaller) {
                    return false;
                }
                let asked = ask(&smaller);
                let is_wrong = asked.judged.is_wrong();
                if is_wrong {
                    *kept.borrow_mut() = asked;
                }
                is_wrong
            })
        };
        let is_asked_again = !was_late && !is_slow;
        let again =
            if is_asked_again { Some(ask(&case)).filter(|again| !again.is_late()) } else { None };
        let shrunk = match (is_slow, again.is_none()) {
            (true, _) => "as it is, since it takes long",
            (_, true) if case == original => "not made smaller: the time was up",
            (_, true) => "shrunk until the time was up",
            (_, false) => "shrunk",
        };
        let Asked { questions, answers, judged } = again.unwrap_or_else(|| kept.into_inner());
        // Asked again, it was right: the program does not repeat itself.
        let what = match was_wrong && judged.is_wrong() {
            true => judged.describe(check),
            false => "wrong at first, right when asked again".to_owned(),
        };
        let expected = |question: &Question| {
            let expected = expected_answer(question, truth).filter(|_| check.is_one_by_one());
            expected.map_or_else(String::new, |expected| show(&expected, 1))
        };
        let exchanges = questions.iter().zip(&answers).map(|(question, answer)| Exchange {
            request: question.text(1),
            answer: show(answer, 1),
            other: match answer {
                Answer::Two(both) => show(&both[1], 1),
                _ => String::new(),
            },
            expected: expected(question),
        });
        let evidence = Exchanged {
            property: failing.property,
            check,
            shrunk,
            exchanges: exchanges.collect(),
            picture: pictured(check, &case, &answers, truth),
        };
        Failure::new(failing.family, failing.index, seed, what, case, evidence)
    }
}

/// What is found in the answers to a case; there are fewer where the program died or the time was up.
pub fn judge(check: Check, case: &Case, answers: &[Answer], of: usize, truth: &Truth) -> Judged {
    if answers.len() < of {
        Check::judge_deaths(answers)
    } else {
        check.judge(case, answers, truth)
    }
}
