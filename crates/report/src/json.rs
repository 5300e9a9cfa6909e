//! A verdict for machines.

use serde::Serialize;
use serde_json::{Value, json};

use rasterproof_precision::cost::{Recorded, prices};
use rasterproof_registry::digest::DigestRow;
use rasterproof_registry::published_check::SpecimenReport;
use rasterproof_verify::cases::Kind;
use rasterproof_verify::comparison::{Comparisons, FamilyReport, Verdict, shrink};

/// What `--json` prints: lines that can be read, or one line for what is as long as the plan of a large model.
#[must_use]
pub fn text(data: &Value) -> String {
    const MOST_READ_BYTES: usize = 1 << 16;
    let line = data.to_string();
    if line.len() > MOST_READ_BYTES { line + "\n" } else { pretty(data) }
}

pub fn pretty(value: &impl Serialize) -> String {
    // Numbers and strings only: this cannot fail.
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}

#[derive(Serialize)]
struct Json<'a> {
    version: &'static str,
    seed: u64,
    cases: u64,
    shard: String,
    agrees: bool,
    /// Wrong pixels against the oracle, on and off the lattice.
    mismatches: u64,
    comparisons: Comparisons,
    triangles: u64,
    lines: u64,
    families: &'a [FamilyReport],
    failures: Vec<FailureJson<'a>>,
    off_grid_triangles: u64,
}

#[derive(Serialize)]
struct FailureJson<'a> {
    family: &'a str,
    index: u64,
    pair: [&'a str; 2],
    what: &'a str,
    shrunk: String,
    window: rasterproof_core::grid::PixelRect,
    repeat: String,
}

/// The verdict as JSON; `repeat` gives the command that repeats a failing case.
pub fn verdict(verdict: &Verdict, repeat: &dyn Fn(&str, u64) -> String) -> Value {
    let failures = verdict.failures.iter().map(|f| FailureJson {
        family: &f.family,
        index: f.index,
        pair: f.evidence.pair.each_ref().map(String::as_str),
        what: &f.what,
        shrunk: shrink::describe(&f.case),
        window: f.case.window,
        repeat: repeat(&f.family, f.index),
    });
    let (part, parts) = (verdict.options.shard.part(), verdict.options.shard.parts());
    let json = Json {
        version: env!("CARGO_PKG_VERSION"),
        seed: verdict.options.seed,
        cases: verdict.options.cases,
        shard: format!("{part}/{parts}"),
        agrees: verdict.agrees(),
        mismatches: verdict.mismatches(),
        comparisons: verdict.comparisons(),
        triangles: verdict.sum(Kind::Triangles, |f| f.shapes),
        lines: verdict.sum(Kind::Lines, |f| f.shapes),
        families: &verdict.families,
        failures: failures.collect(),
        off_grid_triangles: verdict.sum(Kind::Unsnapped, |f| f.shapes),
    };
    // Numbers and strings only: this cannot fail.
    serde_json::to_value(json).unwrap_or_default()
}

/// The survey of the specimens as JSON; an infinite error is `null`.
pub fn specimens(seed: u64, cases: u64, reports: &[SpecimenReport]) -> Value {
    json!({ "version": env!("CARGO_PKG_VERSION"), "seed": seed, "cases": cases, "specimens": reports })
}

/// What every engine computes, hashed, and all of it together.
pub fn digest(seed: u64, cases: u64, parts: &[DigestRow], all: &str) -> Value {
    json!({ "seed": seed, "cases": cases, "parts": parts, "sha256": all })
}

/// The boards of `cost` as JSON, with what exact coverage costs and the rungs that nobody needs.
/// [`Recorded::read`] takes it back.
#[must_use]
pub fn cost(recorded: &Recorded) -> Value {
    let boards = &recorded.boards;
    let verdicts: Vec<_> = boards
        .iter()
        .flat_map(|board| board.ranking().map(move |measure| (board, measure)))
        .map(|(board, measure)| {
            let named = |rung: usize| &*board.rungs[rung].name;
            let best = |column: usize| {
                let best = board.best(column, measure)?;
                let name = |rung: Option<usize>| rung.map(named);
                Some(json!({
                    "column": board.columns[column].name, "fastest": named(best.fastest),
                    "cheapest_good": name(best.good), "cheapest_certain": name(best.certain),
                }))
            };
            let dominated = board.dominated(measure).into_iter().map(|d| {
                let by: Vec<_> = d.by.into_iter().map(named).collect();
                json!({ "rung": named(d.rung), "by": by })
            });
            json!({
                "ladder": board.ladder, "measure": board.measures[measure].title,
                "best": board.columns_run().filter_map(best).collect::<Vec<_>>(),
                "dominated": dominated.collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({
        "version": recorded.version, "repeat": recorded.repeat, "seed": recorded.seed,
        "quick": recorded.quick, "boards": boards,
        "verdicts": verdicts, "price_of_exact_coverage": prices(boards),
    })
}
