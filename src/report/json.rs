//! A verdict for machines.

use serde::Serialize;

use crate::verify::specimens::SpecimenReport;
use crate::verify::{FamilyReport, Verdict, shrink};

#[derive(Serialize)]
struct Json<'a> {
    version: &'static str,
    seed: u64,
    cases: u64,
    shard: String,
    agrees: bool,
    mismatches: u64,
    triangles: u64,
    lines: u64,
    families: &'a [FamilyReport],
    failures: Vec<FailureJson>,
}

#[derive(Serialize)]
struct FailureJson {
    family: String,
    index: u64,
    pair: [String; 2],
    what: String,
    shrunk: String,
    window: crate::grid::PixelRect,
    repeat: String,
}

/// The verdict as JSON; `repeat` gives the command that repeats a failing case.
#[must_use]
pub fn verdict(verdict: &Verdict, repeat: impl Fn(&str, u64) -> String) -> String {
    let failures = verdict.failures.iter().map(|f| FailureJson {
        family: f.family.clone(),
        index: f.index,
        pair: f.pair.clone(),
        what: f.what.clone(),
        shrunk: shrink::describe(&f.case),
        window: f.case.window,
        repeat: repeat(&f.family, f.index),
    });
    let (part, parts) = verdict.options.shard;
    let json = Json {
        version: env!("CARGO_PKG_VERSION"),
        seed: verdict.options.seed,
        cases: verdict.options.cases,
        shard: format!("{part}/{parts}"),
        agrees: verdict.agrees(),
        mismatches: verdict.mismatches(),
        triangles: verdict.sum(false, |f| f.shapes),
        lines: verdict.sum(true, |f| f.shapes),
        families: &verdict.families,
        failures: failures.collect(),
    };
    // Numbers and strings only: this cannot fail.
    serde_json::to_string_pretty(&json).unwrap_or_default() + "\n"
}

/// The survey of the specimens as JSON; an infinite error is `null`.
#[must_use]
pub fn specimens(seed: u64, cases: u64, reports: &[SpecimenReport]) -> String {
    let json = serde_json::json!({
        "version": env!("CARGO_PKG_VERSION"), "seed": seed, "cases": cases, "specimens": reports,
    });
    serde_json::to_string_pretty(&json).unwrap_or_default() + "\n"
}
