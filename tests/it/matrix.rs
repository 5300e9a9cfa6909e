//! Which invariant kills which mutant, kept as a snapshot.

use insta::Settings;
use rasterproof::invariant::matrix::{CASES, Matrix, SEED};

/// Text snapshots lie in the top-level folder, under their own name and without the expression.
fn settings() -> Settings {
    let mut settings = Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

#[test]
fn every_mutant_dies() {
    let matrix = Matrix::compute(SEED, CASES, &|| ());
    assert_eq!(matrix.problems(), Vec::<String>::new());
    let text = matrix.text();
    assert!(text.lines().all(|line| line.len() <= 100), "wider than 100 columns");
    settings().bind(|| insta::assert_snapshot!("mutants", text));
}
