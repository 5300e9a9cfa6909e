//! Failing cases made small while the program is asked, and what was said about them.

use std::cell::RefCell;
use std::time::Instant;

use super::Options;
use super::adapt_case;
use super::ask::{Answer, Ask, Breach, Misbehaviour, Question, show};
use super::check::{Check, Truth, expected_answer};
use super::finding::Finding;
use super::pictured::{Pictured, pictured};
use super::run::{Failing, Found, MOST_DEATHS, Row};
use super::shrink::smaller;
use rasterproof_verify::cases::{self, Case};

#[derive(Clone, Debug)]
pub struct Failure {
    pub property: &'static str,
    pub check: Check,
    pub family: &'static str,
    pub index: u64,
    pub what: String,
    /// How far it was made smaller, in words.
    pub shrunk: &'static str,
    /// The smallest case found that still fails.
    pub case: Case,
    pub exchanges: Vec<Exchange>,
    /// All its answers as one picture, and the one expected, where there are both.
    pub picture: Option<Pictured>,
}

/// A request, its answer, and the answer that was expected; as lines of the protocol.
#[derive(Clone, Debug, PartialEq)]
pub struct Exchange {
    pub request: String,
    pub answer: String,
    /// What the other of two compared programs answered, or nothing.
    pub other: String,
    /// What was expected instead, or nothing.
    pub expected: String,
}

/// Properties whose first failing case is shown.
const MOST_SHOWN: usize = 6;

/// The first failing case of each property that is not known, shrunk: holes and doubles, then those of the most
/// often wrong. Where the pictures show what is wrong, it comes first.
pub fn failures(
    program: &mut dyn Ask,
    found: &Found,
    options: &Options,
    truth: &Truth,
) -> Vec<Failure> {
    let mut rows: Vec<_> = found.rows.iter().filter(|row| row.wrong_cases > 0).collect();
    let share = |row: &Row| if row.name == "watertight" { f64::INFINITY } else { row.share() };
    rows.sort_by(|a, b| share(b).total_cmp(&share(a)));
    let is_known = |f: &Failing| {
        !options.known.is_empty() && options.known.get(&f.name()) == Some(&f.fingerprint)
    };
    let news: Vec<&Failing> = found.failing.iter().filter(|f| !is_known(f)).collect();
    let of = |name: &str| news.iter().find(|f| f.property == name);
    let firsts = rows.into_iter().filter_map(|row| of(row.name)).take(MOST_SHOWN);
    let shown = firsts.filter_map(|failing| failure(program, found, failing, options, truth));
    let mut shown: Vec<_> = shown.collect();
    let is_same = |f: &Failure| f.picture.as_ref().is_none_or(|p| p.drawn == p.expected);
    shown.sort_by_key(is_same);
    shown
}

/// A case that was asked, with what came of it.
struct Asked {
    questions: Vec<Question>,
    answers: Vec<Answer>,
    finding: Finding,
}

impl Asked {
    /// Whether answers are missing, and not because the program died: the time is up.
    fn is_late(&self) -> bool {
        self.answers.len() < self.questions.len() && self.finding.died.is_empty()
    }
}

fn failure(
    program: &mut dyn Ask,
    found: &Found,
    failing: &Failing,
    options: &Options,
    truth: &Truth,
) -> Option<Failure> {
    let family = adapt_case::family(failing.family)?;
    let original = adapt_case::put(family.case(options.seed, failing.index), &truth.declared);
    let check = Check::of_truth(family.name, &original, failing.index, truth)
        .into_iter()
        .find(|check| check.name(family.name) == failing.property)?;
    let program = RefCell::new(program);
    let ask = |case: &Case| {
        let mut questions = Vec::new();
        check.questions(case, truth, &mut questions);
        let answers = program.borrow_mut().ask(&questions, MOST_DEATHS);
        let finding = judge(check, case, &answers, truth);
        Asked { questions, answers, finding }
    };
    let first = ask(&original);
    let start = Instant::now();
    let leaves = adapt_case::leaves_window(&original);
    let was_wrong = first.finding.is_wrong();
    let was_asked = !first.is_late();
    // What takes long to go wrong is shown as it is.
    let is_slow = |m: &Misbehaviour| matches!(m.breach, Breach::Hangs | Breach::Late);
    let is_slow = first.finding.died.iter().any(|(_, m)| is_slow(m));
    // The answers to the smallest case so far.
    let kept = RefCell::new(first);
    let case = if !was_wrong || is_slow {
        original.clone()
    } else {
        smaller(check, original.clone(), |smaller| {
            let is_asked = adapt_case::holds(smaller, &truth.declared)
                && (leaves || !adapt_case::leaves_window(smaller))
                && start.elapsed() < options.patience;
            // A mesh that falls apart is no mesh.
            let smaller = adapt_case::put(smaller.clone(), &truth.declared);
            if !is_asked || !still_a_mesh(check, &smaller) {
                return false;
            }
            let asked = ask(&smaller);
            let is_wrong = asked.finding.is_wrong();
            if is_wrong {
                *kept.borrow_mut() = asked;
            }
            is_wrong
        })
    };
    let again = if was_asked { Some(ask(&case)).filter(|again| !again.is_late()) } else { None };
    let is_late = again.is_none();
    let shrunk = match (is_late, is_slow) {
        (true, _) if case == original => "not made smaller: the time was up",
        (true, _) => "shrunk until the time was up",
        (false, true) => "as it is, since it takes long",
        (false, false) => "shrunk",
    };
    let Asked { questions, answers, finding } = again.unwrap_or_else(|| kept.into_inner());
    let what = match (was_asked, was_wrong, finding.is_wrong()) {
        (false, ..) => {
            found.described.get(&failing.name()).map_or("wrong", String::as_str).to_owned()
        }
        // Asked again, it was right: the program does not repeat itself.
        (_, false, _) | (_, _, false) => "wrong at first, right when asked again".to_owned(),
        _ => finding.describe(check),
    };
    let exchanges = questions.iter().zip(&answers).map(|(question, answer)| Exchange {
        request: question.text(1),
        answer: show(answer, 1),
        other: match answer {
            Answer::Two(both) => show(&both[1], 1),
            _ => String::new(),
        },
        expected: match check {
            Check::Coverage
            | Check::Line
            | Check::Values
            | Check::Depth
            | Check::Near
            | Check::Carried => {
                expected_answer(question, truth).map_or_else(String::new, |e| show(&e, 1))
            }
            _ => String::new(),
        },
    });
    Some(Failure {
        property: failing.property,
        check,
        family: family.name,
        index: failing.index,
        what,
        shrunk,
        exchanges: exchanges.collect(),
        picture: pictured(check, &case, &answers, truth).filter(|_| was_asked),
        case,
    })
}

fn judge(check: Check, case: &Case, answers: &[Answer], truth: &Truth) -> Finding {
    let mut questions = Vec::new();
    check.questions(case, truth, &mut questions);
    if answers.len() < questions.len() {
        Check::judge_deaths(answers)
    } else {
        check.judge(case, answers, truth)
    }
}

fn still_a_mesh(check: Check, case: &Case) -> bool {
    let is_mesh = match &case.shape {
        cases::Shape::Triangles { disjoint, .. } => *disjoint,
        _ => false,
    };
    check != Check::Watertight || is_mesh
}
