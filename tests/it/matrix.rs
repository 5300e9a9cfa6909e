//! Which invariant kills which mutant, kept as a snapshot.

use rasterproof_invariants::matrix::{CASES, Matrix, SEED};

use crate::snapshots::check_words;

#[test]
fn every_mutant_dies() {
    let matrix = Matrix::compute(SEED, CASES, &|| ());
    assert_eq!(matrix.problems(), Vec::<String>::new());
    let text = matrix.text();
    assert!(text.lines().all(|line| line.len() <= 100), "wider than 100 columns");
    check_words("mutants", &text);
}
