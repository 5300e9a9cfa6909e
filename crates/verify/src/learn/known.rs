//! What is known where no model predicts every answer: when the program is wrong, where the wrong pixels lie, and what is right
//! beside a wrong answer.

use super::drawer::LearnedAnswer;
use super::model::{Model, Wrong};
use super::quantity::{AXES, Name, ORDINALS, SIDES};
use super::question::AnyQuestion;
use super::rule::{self, Table, Terms, all_hold};
use super::say;
use super::search::Search;
use super::trial::Work;

/// When the program is wrong, and where the wrong pixels lie.
pub(super) fn sentences(search: &Search<'_>) -> Vec<String> {
    let names = &search.vocabulary.names;
    let of_question = &names[..search.vocabulary.of_question];
    let mut said = told_apart("wrong answers", "right ones", of_question, &answers(search));
    for (wrong, table) in Wrong::ALL.into_iter().zip(&*search.tables(&Model::default())) {
        let (kind, others) = match wrong {
            Wrong::Missing => ("missing pixels", "pixels that are rightly drawn"),
            Wrong::Extra => ("extra pixels", "pixels that are rightly not drawn"),
            Wrong::Twice => ("pixels drawn more than once", "pixels drawn once"),
        };
        if table.yes.len() >= LEAST_PIXELS {
            said.extend(told_apart(kind, others, names, table));
        }
    }
    said
}

/// Wrong pixels below which nothing is said of where they lie.
const LEAST_PIXELS: usize = 6;

/// Wrong answers and right ones.
fn answers(search: &Search<'_>) -> Table {
    let mut table = Table::default();
    for (number, a) in search.answered.iter().enumerate() {
        if a.is_wrong() {
            table.yes.push(a.facts.clone());
            table.groups.push(number);
        } else {
            table.no.push(a.facts.clone());
        }
    }
    table
}

/// What is true of all that is wrong; and what is true of most of it and of little else.
fn told_apart(kind: &str, others: &str, names: &[Name], table: &Table) -> Vec<String> {
    let terms = Terms { most: 3, need: 3, slack: 30, wanted: 1 };
    let most = rule::best(names, table, terms, &Work::default()).into_iter().next();
    let most = most.map(|found| found.facts);
    let all = rule::common(names, table, 3).0;
    let mut said = Vec::new();
    for facts in [all, most.unwrap_or_default()] {
        let held = |rows: &[Vec<i64>]| rows.iter().filter(|row| all_hold(&facts, row)).count();
        let (wrong, right) = (held(&table.yes), held(&table.no));
        // What holds of few says nothing, and what is nearly said need not be said again.
        if facts.is_empty() || 2 * wrong < table.yes.len() {
            continue;
        }
        let sentence = format!(
            "True of {wrong} of {} {kind}, and of {right} of {} {others}: {}.",
            table.yes.len(),
            table.no.len(),
            say::facts(&facts, names)
        );
        if !said.contains(&sentence) {
            said.push(sentence);
        }
        if wrong == table.yes.len() && 50 * right <= table.no.len() {
            break;
        }
    }
    said
}

/// A question that differs from another one in one thing, with the words of it.
pub(super) struct OneChange {
    pub(super) question: AnyQuestion,
    pub(super) says: String,
}

/// All questions that differ from one in a single coordinate, in a side of the window, or in the order of its corners: those
/// that differ by least come first.
pub(super) fn one_changes(q: &AnyQuestion, grain: i64) -> Vec<OneChange> {
    let one = q.one();
    let corner = if q.is_line() { "end" } else { "corner" };
    let mut all = Vec::new();
    for by in [one / 256, one / 16, one / 2, one, 2 * one, 4 * one, 16 * one] {
        for by in [by, -by].into_iter().filter(|by| *by != 0 && by % grain == 0) {
            for axis in [0, 1] {
                for (i, ordinal) in (0..q.points.len()).zip(ORDINALS) {
                    let mut other = q.clone();
                    other.points[i][axis] += by;
                    let [before, after] =
                        [q, &other].map(|q| say::number(q.unit(), q.points[i][axis]));
                    let says =
                        format!("{} of the {ordinal} {corner} {after}, not {before}", AXES[axis]);
                    all.push(OneChange { question: other, says });
                }
            }
        }
        if by < one || by > 4 * one {
            continue;
        }
        for axis in [0, 1] {
            for by in [by / one, -by / one] {
                let mut other = q.clone();
                other.side[axis] += by as i32;
                let says = format!(
                    "the {} of the window {} px, not {} px",
                    SIDES[axis], other.side[axis], q.side[axis]
                );
                all.push(OneChange { question: other, says });
            }
        }
    }
    let mut other = q.clone();
    other.points.swap(0, 1);
    all.push(OneChange { question: other, says: format!("the first two {corner}s exchanged") });
    all.retain(|change| change.question.side.iter().all(|side| *side > 0));
    all
}

/// That a question comes out wrong, and right with one change; nothing where too little was answered.
pub(super) fn beside(
    wrong: &LearnedAnswer,
    changes: &[OneChange],
    answered: &[LearnedAnswer],
) -> Option<String> {
    if 2 * answered.len() < changes.len() {
        return None;
    }
    // A picture of nothing tells least.
    let is_right = |a: &&LearnedAnswer| !a.is_wrong();
    let drawn = answered.iter().filter(is_right).filter(|a| !a.right.is_empty());
    let nearest = drawn.chain(answered.iter().filter(is_right)).next();
    let change = nearest.and_then(|a| changes.iter().find(|c| c.question == a.question));
    let asked = wrong.question.request();
    Some(match change {
        Some(change) => {
            format!("'{asked}' comes out wrong; with {}, it comes out right.", change.says)
        }
        None => format!(
            "'{asked}' comes out wrong, and so does each of {} questions that differ from it in one number.",
            answered.len()
        ),
    })
}
