//! Each file of `tests/pages` is a check of a page in a browser: what it opens, at which size, one sentence, and what makes the sentence true.
//!
//! Node.js runs them in Chromium (`tests/pages/driver`). Without either these tests say so and pass, unless
//! `RASTERPROOF_NEEDS_CHROMIUM` is set, as `.ci/run` does. `RASTERPROOF_CHECK=NAME` runs one check alone, with whatever test its folder has.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::PathBuf;
use std::process::{Command, Stdio};

use rasterproof_faults::published::catalogue::CARDS;
use rasterproof_wasm::figures;
use rasterproof_wasm::question::answer;
use serde_json::{Value, json};

use crate::made_pages::made;
use crate::pages::{files, read, root};
use crate::program::{Folder, PROGRAM};
use crate::workspace::anchors;

/// What a check asks of the tests, beside a question to the engines.
fn answered(question: &str) -> String {
    let asked: Value = serde_json::from_str(question).unwrap();
    let answer = if let Some(name) = asked["page"].as_str() {
        json!(made(name))
    } else if let Some(page) = asked["anchors"].as_str() {
        json!(anchors(&read(page)))
    } else {
        match asked["list"].as_str() {
            Some("cards") => json!(CARDS.iter().map(|card| card.name).collect::<Vec<_>>()),
            Some("figures") => figures::ALL.iter().map(figure).collect(),
            _ => return answer(question),
        }
    };
    answer.to_string()
}

/// A live figure: its name, the ends of its grips, and the names of its numbers.
fn figure(figure: &figures::Figure) -> Value {
    let ends: Vec<_> = figure.grips().iter().map(|grip| [grip.low, grip.high]).collect();
    let numbers: Vec<_> = figure.numbers().unwrap().into_iter().map(|(name, _)| name).collect();
    json!({ "name": figure.name, "ends": ends, "numbers": numbers })
}

/// Runs the checks of a folder in one browser, one after the other.
fn check(folder: &str) {
    let only = std::env::var("RASTERPROOF_CHECK").ok();
    let mut checks = files(&root().join("tests/pages").join(folder), ".mjs");
    checks.retain(|check| only.as_ref().is_none_or(|only| check.file_stem().unwrap() == &**only));
    if only.is_none() || !checks.is_empty() {
        assert!(!checks.is_empty(), "no check in {folder}");
        run(&checks, folder);
    }
}

fn run(checks: &[PathBuf], name: &str) {
    let written = Folder::new(&format!("page-checks-{name}"));
    let node = Command::new("node")
        .arg(root().join("tests/pages/driver/run.mjs"))
        .args(checks)
        .env("RASTERPROOF", PROGRAM)
        .env("FOLDER", &*written)
        .env_remove("COLUMNS")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn();
    let Ok(mut node) = node else {
        let demanded = std::env::var_os("RASTERPROOF_NEEDS_CHROMIUM").is_some();
        assert!(!demanded, "no Node.js: install Debian's package nodejs");
        eprintln!("SKIPPED: no Node.js");
        return;
    };
    for line in BufReader::new(node.stdout.take().unwrap()).lines() {
        let line = line.unwrap();
        match line.strip_prefix('?') {
            Some(question) => {
                writeln!(node.stdin.as_mut().unwrap(), "{}", answered(question)).unwrap();
            }
            None => println!("{line}"),
        }
    }
    assert!(node.wait().unwrap().success(), "checks of pages fail");
}

#[test]
fn page_checks() {
    check("quick");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_checks_of_reports() {
    check("report");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_checks_of_the_playground() {
    check("playground");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_checks_of_live_figures() {
    check("figures");
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn page_checks_of_the_page_for_gpus() {
    check("gpu");
}

#[test]
#[ignore = "needs docs/build"]
fn site_checks() {
    check("site");
}

#[test]
#[ignore = "takes a minute; needs docs/build"]
fn site_checks_of_accessibility() {
    check("accessibility");
}

#[test]
#[ignore = "takes a minute; needs docs/build"]
fn site_checks_of_other_pages() {
    check("accessibility-other");
}
