//! Every engine against the oracle and against each other, on every family: plain `cargo test`
//! prints the table. One trial for each family, so filters and `--list` work as usual.
//!
//! Where it disagrees, `cargo test` ends here; so the named cases are then drawn too, every changed
//! snapshot is stored with its picture, and the last lines say where to look.

#[path = "it/snapshots.rs"]
#[allow(dead_code, unused_imports, reason = "its tests run in the binary `it`")]
mod snapshots;

use std::process::ExitCode;
use std::sync::{Arc, Mutex};

use libtest_mimic::{Arguments, Failed, Trial};
use rasterproof::hazard;
use rasterproof::lineup::{Engine, LineEngine};
use rasterproof::report::table;
use rasterproof::verify::{FamilyReport, Options, Verdict, judge_lineup, tolerance};

/// Cases of each family: enough that every planted fault of `tests/it/mutants.rs` shows.
const CASES: u64 = 1500;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let reports: Arc<Mutex<Vec<FamilyReport>>> = Arc::default();
    let trials = hazard::families()
        .map(|family| {
            let reports = Arc::clone(&reports);
            Trial::test(format!("differential::{}", family.name), move || {
                judge(family.name, &reports)
            })
        })
        .collect();
    let conclusion = libtest_mimic::run(&arguments, trials);
    let mut families = std::mem::take(&mut *reports.lock().expect("no trial holds the lock now"));
    let place = |report: &FamilyReport| hazard::families().position(|f| f.name == report.family);
    families.sort_by_key(place);
    let all = families.len() == hazard::families().count();
    let verdict = Verdict { options: options(""), families, failures: Vec::new() };
    if conclusion.has_failed() {
        show_snapshots();
    }
    println!("{}{}", table::table(&verdict), table::quota_line(&verdict));
    let quotas_met = !all || verdict.quotas().iter().all(|(_, is, wanted)| is >= wanted);
    if !quotas_met {
        println!("FAILED: a quota is not met, so the families prove less than they claim");
    }
    if conclusion.has_failed() {
        print!("{}", table::disagreements(&verdict));
        println!("\nWhat to do now:\n{}", snapshots::NEXT);
        println!("the other tests and their pictures: cargo test --no-fail-fast");
    }
    if conclusion.has_failed() || !quotas_met { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Draws the named cases, so that those that look different are stored beside the old ones.
fn show_snapshots() {
    println!("the named cases, as drawn now:");
    // What each of them says is gathered, and said once.
    std::panic::set_hook(Box::new(|_| ()));
    match std::panic::catch_unwind(snapshots::check_named_cases) {
        Ok(()) => println!("  all look as before"),
        Err(payload) => {
            let message = payload.downcast_ref::<String>().map_or("", String::as_str);
            println!("{}", message.trim_end_matches(snapshots::NEXT).trim_end());
        }
    }
    println!();
}

fn options(family: &str) -> Options {
    Options { cases: CASES, families: vec![family.to_owned()], ..Options::default() }
}

fn judge(family: &str, reports: &Mutex<Vec<FamilyReport>>) -> Result<(), Failed> {
    let engines =
        [(Engine::Scanline, tolerance::SCANLINE), (Engine::EdgeFunction, tolerance::EDGE_FUNCTION)];
    let verdict = judge_lineup(&engines, &LineEngine::JUDGED, &options(family), &|_| ());
    let report = verdict.families.first().ok_or("the family was not judged")?.clone();
    reports.lock().map_err(|_| "another trial failed")?.push(report.clone());
    if report.cases != CASES {
        return Err(format!("{} of {CASES} cases judged", report.cases).into());
    }
    if !verdict.agrees() {
        let failures: Vec<_> = verdict.failures.iter().map(ToString::to_string).collect();
        return Err(format!("{}\n{}", table::disagreements(&verdict), failures.join("\n")).into());
    }
    Ok(())
}
