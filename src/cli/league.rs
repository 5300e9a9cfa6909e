//! `rasterproof judge --league`: the installed adapters of libraries, one after the other.
//!
//! A library is known by its adapter, a small program that speaks the line protocol for it. What is compared are wrong pixels twice:
//! as the library declares its rules, and by the rules that its pixels follow, so that another convention is not taken for a fault.

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::page::{Place, print};
use super::progress::Progress;
use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits};

use super::{Status, Streams, exit, usage};
use rasterproof_judge::ask::Subject;
use rasterproof_judge::league::{Adapter, Kind, League, Ranked, date};
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::{Options, Step};
use rasterproof_program::{Limits, Program, group};
use rasterproof_report::html::Report;
use rasterproof_report::json::pretty;
use rasterproof_report::league;
use rasterproof_report::table::{Row, Table};

/// The adapters and their commands, in a checkout of the project.
const ADAPTERS: &str = "adapters/league.json";

/// Judges the adapters of these names, or all, and writes what came of them as JSON and as tables of the pages.
pub fn run(
    names: &[String],
    options: &Options,
    limits: Limits,
    place: &Place,
    streams: &mut Streams<'_>,
) -> Status {
    // A list of adapters is part of the project, and so is the folder in which their commands run.
    let text = input::read_text(Path::new(ADAPTERS), limits::NOTE_BYTES)
        .map_err(|e| usage(format!("{e}\n  run it in the folder of the project")))?;
    let adapters: Vec<Adapter> = serde_json::from_str(&text)
        .map_err(|e| usage(format!("{ADAPTERS}: {}", printable(&e.to_string()))))?;
    for name in names {
        if adapters.iter().all(|adapter| adapter.name != *name) {
            return Err(usage(format!(
                "{name:?} is no adapter\n  adapters/install --list shows the names"
            )));
        }
    }
    group::end_all_on_ctrl_c();
    let (mut rows, mut shown) = (Vec::new(), Vec::new());
    for adapter in adapters.iter().filter(|a| names.is_empty() || names.contains(&a.name)) {
        // One that is not installed, or cannot start, does not keep the others from being judged.
        let program = match Program::start(&adapter.command, &[], limits) {
            Ok(program) => program,
            Err(why) => {
                shown.push(Row::of(&[&adapter.name, &format!("skipped: {why}")]));
                continue;
            }
        };
        let standing = judge(adapter, program, options, streams.progress);
        let [triangles, by_rule] = wrong_pixels(standing.triangles.as_ref());
        let [lines, lines_by_rule] = wrong_pixels(standing.lines.as_ref());
        shown.push(Row::of(&[&adapter.name, &triangles, &by_rule, &lines, &lines_by_rule]));
        rows.push(standing);
    }
    // A table without rows would look like a league in which nothing is wrong.
    if rows.is_empty() {
        return Err(usage("no adapter is installed\n  adapters/install prepares them"));
    }
    let columns = "library 22 | >triangles 10 wrong pixels as declared | >by its rule 11 by its own convention | >lines 10 wrong \
                   pixels as declared | >by its rule 11 by its own convention";
    let tables = vec![Table::new("Wrong pixels of each library", columns, shown)];
    print(Report { tables, ..Report::default() }, exit::AGREES, streams)?;
    let Options { seed, cases, .. } = *options;
    let all = League { rasterproof: env!("CARGO_PKG_VERSION").to_owned(), seed, cases, rows };
    // The same table for machines and for the pages of both languages.
    for (name, text) in [
        ("league.json", pretty(&all)),
        ("league.md", league::tables(&all, false)),
        ("league.zh.md", league::tables(&all, true)),
    ] {
        let output = place.output(name);
        if streams.save(&output, text.as_bytes()) {
            writeln!(streams.errors, "league: {}", printable_path(&output.path))?;
        }
    }
    Ok(exit::AGREES)
}

/// Judges one adapter as it declares itself, and by the convention that its pixels follow.
fn judge(adapter: &Adapter, program: Program, options: &Options, on_terminal: bool) -> Ranked {
    // The convention is looked for also where nothing is wrong, so that the table has one for every library.
    let everything = Scope { triangles: true, lines: true, always: true, patience: None };
    let convention = |program: &mut dyn Subject| recognise(program, everything);
    let progress = Progress::new(on_terminal, "cases", None);
    progress.at(0, &format!("of {}", adapter.name));
    let step = |step| {
        if let Step::Judged(cases) = step {
            progress.done(cases);
        }
    };
    let mut askers: Vec<Box<dyn Subject>> = vec![Box::new(program)];
    let verdict = rasterproof_judge::judge(&mut askers, options, &convention, &step);
    Ranked::new(adapter, today(), &verdict)
}

/// The wrong pixels of triangles or of lines: as declared, and by the library's own convention.
fn wrong_pixels(kind: Option<&Kind>) -> [String; 2] {
    let Some(kind) = kind else { return ["-".to_owned(), "-".to_owned()] };
    let own = match &kind.by_convention {
        Some(score) => score.wrong.to_string(),
        None => "unexplained".to_owned(),
    };
    [kind.as_declared.wrong.to_string(), own]
}

/// The day in Greenwich, year-month-day.
fn today() -> String {
    date(SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |t| t.as_secs() / 86_400))
}
