//! Every engine against the oracle and against each other, on every family: plain `cargo test`
//! prints the table. One trial for each family, so filters and `--list` work as usual.
//!
//! Where it disagrees, `cargo test` ends here; so all that is kept as a snapshot is then drawn too, each
//! changed one is stored with its picture, and the last lines say where to look.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, ExitCode};
use std::sync::{Arc, Mutex};

use libtest_mimic::{Arguments, Failed, Trial};
#[path = "common/next.rs"]
mod next;
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_report::summary::chapter;
use rasterproof_report::{differential, text};
use rasterproof_verify::cases;
use rasterproof_verify::comparison::{FamilyReport, LeftOut, Options, Verdict};

/// Cases of each family: enough that every planted fault of `tests/it/mutants.rs` shows.
const CASES: u64 = 1500;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    rasterproof::cli::quiet_engines();
    let reports: Arc<Mutex<Vec<FamilyReport>>> = Arc::default();
    let chapters: Arc<Mutex<BTreeSet<&'static str>>> = Arc::default();
    let trials = cases::families()
        .map(|family| {
            let (reports, chapters) = (Arc::clone(&reports), Arc::clone(&chapters));
            Trial::test(format!("differential::{}", family.name), move || {
                judge(family.name, &reports, &chapters)
            })
        })
        .collect();
    let conclusion = libtest_mimic::run(&arguments, trials);
    let mut families = std::mem::take(&mut *reports.lock().expect("no trial holds the lock now"));
    let place = |report: &FamilyReport| cases::families().position(|f| f.name == report.family);
    families.sort_by_key(place);
    let all = families.len() == cases::families().count();
    let options = Options::default().cases(CASES);
    let verdict =
        Verdict { options, families, failures: Vec::new(), cause: None, more: LeftOut::default() };
    println!("{}", text::tables(&differential::tables(&verdict), text::WIDTH, false));
    let quotas_met = !all || verdict.quotas().iter().all(|(_, is, wanted)| is >= wanted);
    if !quotas_met {
        println!("FAILED: a quota is not met, so the families prove less than they claim");
    }
    if conclusion.has_failed() {
        if all {
            show_snapshots();
        }
        println!("\nWhat to do now:\n{}", next::NEXT);
        let chapters: Vec<_> =
            chapters.lock().expect("no trial holds the lock now").iter().copied().collect();
        println!("what is wrong is explained in: {}", chapters.join(", "));
        println!("all other tests: cargo test --no-fail-fast");
    }
    if conclusion.has_failed() || !quotas_met { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Modules of the test binary `it` that keep snapshots.
const KEEPERS: [&str; 7] = [
    "snapshots::",
    "illustrations::",
    "scenes::",
    "specimens::",
    "matrix::",
    "cost::",
    "protocol::",
];

/// Has every snapshot drawn in one pass, so that those that changed are stored beside the old ones, and
/// names them.
fn show_snapshots() {
    println!("\ndrawing all that is kept as a snapshot ...");
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(["test", "--test", "it"]).current_dir(env!("CARGO_MANIFEST_DIR"));
    // The binary that was built with this one.
    if let Some(profile) = profile().filter(|profile| profile != "debug") {
        cargo.args(["--profile", &profile]);
    }
    cargo.arg("--").args(KEEPERS);
    // The first that changed is not the last; what insta says of each is said once, below.
    cargo.envs([("INSTA_FORCE_PASS", "1"), ("INSTA_OUTPUT", "none"), ("INSTA_UPDATE", "new")]);
    if let Err(error) = cargo.output() {
        return println!("{} cannot be run: {error}", cargo.get_program().display());
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots");
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names: Vec<_> = files.filter_map(|file| file.file_name().into_string().ok()).collect();
    let ending = |name: &String, end: &str| name.strip_suffix(end).map(str::to_owned);
    let mut changed: Vec<_> = names.iter().filter_map(|name| ending(name, ".snap.new")).collect();
    changed.sort();
    let pictures = names.iter().filter(|name| name.ends_with(".snap.new.png")).count();
    let count = changed.len();
    println!("{count} look different and wait in snapshots/, {pictures} of them pictures:");
    for some in changed.chunks(6) {
        println!("  {}", some.join(", "));
    }
}

/// The folder of `target` that this runs in, named after its profile.
fn profile() -> Option<String> {
    let program = std::env::current_exe().ok()?;
    Some(program.parent()?.parent()?.file_name()?.to_str()?.to_owned())
}

fn options(family: &str) -> Options {
    let name = family.parse().expect("it is the name of a family");
    Options::default().cases(CASES).family(name)
}

fn judge(
    family: &str,
    reports: &Mutex<Vec<FamilyReport>>,
    chapters: &Mutex<BTreeSet<&'static str>>,
) -> Result<(), Failed> {
    let verdict = EnginesToJudge::all().judge(&options(family), &|_| ());
    let report = verdict.families.first().ok_or("the family was not judged")?.clone();
    reports.lock().map_err(|_| "another trial failed")?.push(report.clone());
    if report.cases != CASES {
        return Err(format!("{} of {CASES} cases judged", report.cases).into());
    }
    if !verdict.agrees() {
        let seed = verdict.options.seed;
        let explained = verdict.failures.iter().map(chapter);
        chapters.lock().map_err(|_| "another trial failed")?.extend(explained);
        let told = verdict.failures.iter().map(|failure| {
            let (family, index, chapter) = (&failure.family, failure.index, chapter(failure));
            format!(
                "{failure}\nsee it: cargo run -- verify --family {family} --case {index} --seed {seed}\n\
                 read on in: {chapter}"
            )
        });
        let failures: Vec<_> = told.collect();
        return Err(format!(
            "{}\n{}",
            differential::disagreements(&verdict).join("\n"),
            failures.join("\n")
        )
        .into());
    }
    Ok(())
}
