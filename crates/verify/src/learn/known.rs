//! What is known where no model predicts every answer: when the program is wrong, where, and what is right beside it.

use super::drawer::LearnedAnswer;
use super::rule::{self, Table, Terms, all_hold};
use super::say;
use super::search::Search;

/// The sentences.
pub(super) fn sentences(search: &Search<'_>) -> Vec<String> {
    let mut said = Vec::new();
    said.extend(when(search));
    said.extend(nearest_right(search));
    said
}

/// Facts of the question that separate wrong answers from right ones.
fn when(search: &Search<'_>) -> Option<String> {
    let vocabulary = search.vocabulary;
    let mut table = Table::default();
    for (number, a) in search.answered.iter().enumerate() {
        if a.is_wrong() {
            table.yes.push(a.facts.clone());
            table.groups.push(number);
        } else {
            table.no.push(a.facts.clone());
        }
    }
    let terms = Terms { most: 2, need: 3, slack: 30, wanted: 1 };
    let names = &vocabulary.names[..vocabulary.of_question];
    let found = rule::best(names, &table, terms).into_iter().next()?;
    let held = table.no.iter().filter(|row| all_hold(&found.facts, row)).count();
    // What holds of few says nothing.
    (2 * found.rows >= table.yes.len()).then(|| {
        format!(
            "Mostly wrong where {}: this holds for {} of {} wrong answers and {held} of {} right ones.",
            say::facts(&found.facts, names),
            found.rows,
            table.yes.len(),
            table.no.len()
        )
    })
}

/// The smallest wrong question, and the right one that is nearest to it.
fn nearest_right(search: &Search<'_>) -> Option<String> {
    let wrong =
        search.answered.iter().filter(|a| a.is_wrong()).min_by_key(|a| a.question.bulk())?;
    let distance = |a: &&LearnedAnswer| {
        let points = a.question.points.iter().flatten().zip(wrong.question.points.iter().flatten());
        let moved = points.filter(|(a, b)| a != b).count();
        let sides =
            a.question.side.iter().zip(&wrong.question.side).filter(|(a, b)| a != b).count();
        (moved + sides, a.question.bulk())
    };
    let right = search.answered.iter().filter(|a| !a.is_wrong()).min_by_key(distance)?;
    Some(format!(
        "'{}' comes out wrong; beside it, '{}' comes out right.",
        wrong.question.request(),
        right.question.request()
    ))
}
