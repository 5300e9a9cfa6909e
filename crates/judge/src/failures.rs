//! Failing cases made small while the program is asked, and what was said about them.

use std::cell::RefCell;
use std::time::Instant;

use super::Options;
use super::adapt_case;
use super::ask::{Answer, Ask, Breach, Misbehaviour, show};
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
    /// What was expected instead, or nothing.
    pub expected: String,
}

/// Properties whose first failing case is shown.
const MOST_SHOWN: usize = 6;

/// The first failing case of each property, shrunk: holes and doubles, then those of the most often wrong.
pub fn failures(
    program: &mut dyn Ask,
    found: &Found,
    options: &Options,
    truth: &Truth,
) -> Vec<Failure> {
    let mut rows: Vec<_> = found.rows.iter().filter(|row| row.wrong_cases > 0).collect();
    let share = |row: &Row| if row.name == "watertight" { f64::INFINITY } else { row.share() };
    rows.sort_by(|a, b| share(b).total_cmp(&share(a)));
    let of = |name: &str| found.failing.iter().find(|f| f.property == name);
    let firsts = rows.into_iter().filter_map(|row| of(row.name)).take(MOST_SHOWN);
    firsts.filter_map(|failing| failure(program, failing, options, truth)).collect()
}

fn failure(
    program: &mut dyn Ask,
    failing: &Failing,
    options: &Options,
    truth: &Truth,
) -> Option<Failure> {
    let family = adapt_case::family(failing.family)?;
    let case = adapt_case::put(family.case(options.seed, failing.index), &truth.declared);
    let check = Check::of(family.name, &case, failing.index, &truth.declared)
        .into_iter()
        .find(|check| check.name(family.name) == failing.property)?;
    let program = RefCell::new(program);
    let answers_to = |case: &Case| {
        let mut questions = Vec::new();
        check.questions(case, truth, &mut questions);
        let answers = program.borrow_mut().ask(&questions, MOST_DEATHS);
        (questions, answers)
    };
    let judged = |case: &Case| judge(check, case, &answers_to(case).1, truth);
    let first = judged(&case);
    let start = Instant::now();
    let leaves = adapt_case::leaves_window(&case);
    // What takes long to go wrong is shown as it is.
    let is_slow = |m: &Misbehaviour| matches!(m.breach, Breach::Hangs | Breach::Late);
    let case = if !first.is_wrong() || first.died.iter().any(|(_, m)| is_slow(m)) {
        case
    } else {
        smaller(check, case, |smaller| {
            let is_asked = adapt_case::holds(smaller, &truth.declared)
                && (leaves || !adapt_case::leaves_window(smaller))
                && start.elapsed() < options.patience;
            // A mesh that falls apart is no mesh.
            let smaller = adapt_case::put(smaller.clone(), &truth.declared);
            is_asked && still_a_mesh(check, &smaller) && judged(&smaller).is_wrong()
        })
    };
    let (questions, answers) = answers_to(&case);
    let finding = judge(check, &case, &answers, truth);
    let what = match (first.is_wrong(), finding.is_wrong()) {
        // Asked again, it was right: the program does not repeat itself.
        (false, _) | (_, false) => "wrong at first, right when asked again".to_owned(),
        _ => finding.describe(check),
    };
    let exchanges = questions.iter().zip(&answers).map(|(question, answer)| Exchange {
        request: question.text(1),
        answer: show(answer, 1),
        expected: match check {
            Check::Coverage | Check::Line | Check::Values | Check::Depth | Check::Near => {
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
        exchanges: exchanges.collect(),
        picture: pictured(check, &case, &answers, truth),
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
