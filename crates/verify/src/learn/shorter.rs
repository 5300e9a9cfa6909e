//! What a model says too much: the same models with one thing less.

use super::fill::{Halves, RowRule};
use super::model::Model;
use super::rule::Conjunction;

/// All models that say one thing less.
pub(super) fn shorter(model: &Model) -> Vec<Model> {
    let mut all = Vec::new();
    for i in 0..model.chain.len() {
        let mut less = model.clone();
        less.chain.remove(i);
        all.push(less);
        for when in shorter_guards(model.chain[i].when.as_ref()) {
            let mut less = model.clone();
            less.chain[i].when = when;
            all.push(less);
        }
    }
    for i in 0..model.borders.len() {
        all.push(Model { borders: without(&model.borders, i), ..model.clone() });
        for when in shorter_guards(model.borders[i].when.as_ref()) {
            let mut less = model.clone();
            less.borders[i].when = when;
            all.push(less);
        }
    }
    let halves = Halves { counts: false, ..model.rows.halves };
    let plain = [
        RowRule { exchanges_ends: false, ..model.rows },
        RowRule { heights: None, ..model.rows },
        RowRule { halves, ..model.rows },
        RowRule { halves: Halves::default(), ..model.rows },
    ];
    let less = plain.into_iter().filter(|rows| *rows != model.rows);
    all.extend(less.map(|rows| Model { rows, ..model.clone() }));
    for (i, step) in model.steps.iter().enumerate() {
        all.push(Model { steps: without(&model.steps, i), ..model.clone() });
        for k in (0..step.facts.len()).filter(|_| step.facts.len() > 1) {
            let mut less = model.clone();
            less.steps[i].facts.remove(k);
            all.push(less);
        }
    }
    all
}

/// No guard, and all guards without one conjunction or one fact.
fn shorter_guards(when: Option<&Vec<Conjunction>>) -> Vec<Option<Vec<Conjunction>>> {
    let Some(when) = when else { return Vec::new() };
    let mut all = vec![None];
    for (j, conjunction) in when.iter().enumerate() {
        if when.len() > 1 {
            all.push(Some(without(when, j)));
        }
        for k in (0..conjunction.len()).filter(|_| conjunction.len() > 1) {
            let mut less = when.clone();
            less[j].remove(k);
            all.push(Some(less));
        }
    }
    all
}

fn without<T: Clone>(all: &[T], i: usize) -> Vec<T> {
    let mut less = all.to_vec();
    less.remove(i);
    less
}
