//! The verdict for machines: JSON, JUnit XML, TAP, Gradescope's results, GitHub Classroom's.
//!
//! Each property is one test that passes or fails; no test has a fraction. A failure that the
//! baseline knows counts as passed where points are given, and is marked where there is a mark for
//! it.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::judge_text::{excerpts, why};
use super::{html, json as json_text, text};
use json_text::pretty;
use rasterproof_judge::verdict::{Outcome, Property, Scores as _, Verdict};

/// The formats in which a verdict can be printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Text,
    /// Everything that was found, by names that are documented in `docs/`.
    Json,
    /// JUnit XML, for build servers.
    Junit,
    /// Test Anything Protocol, version 14.
    Tap,
    /// The results.json of Gradescope, with a score for each property.
    Gradescope,
    /// The result of an autograding step of GitHub Classroom.
    GithubClassroom,
}

impl Format {
    /// All, with the words of the command line and what they are for.
    pub const ALL: [(&'static str, Self, &'static str); 6] = [
        ("text", Self::Text, "For people"),
        ("json", Self::Json, "Everything that was found"),
        ("junit", Self::Junit, "JUnit XML, for build servers"),
        ("tap", Self::Tap, "Test Anything Protocol, version 14"),
        ("gradescope", Self::Gradescope, "Gradescope's results.json"),
        (
            "github-classroom",
            Self::GithubClassroom,
            "The result of an autograding step of GitHub Classroom",
        ),
    ];
}

/// The verdict in a format other than text; `repeat` gives the command that repeats a case.
pub fn write(
    verdict: &Verdict,
    format: Format,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> String {
    match format {
        Format::Text => String::new(),
        Format::Json => json_text::text(&json_text::judgement(verdict, repeat_all, repeat)),
        Format::Junit => junit(verdict, repeat),
        Format::Tap => tap(verdict, repeat),
        Format::Gradescope => {
            let tests = verdict.more.properties.iter();
            let tests = tests.map(|p| (p.name, p.outcome.is_good(), message(verdict, p, repeat)));
            let tests: Vec<_> = tests.collect();
            pretty(&gradescope(&tests, "properties hold", verdict.more.found.seconds))
        }
        Format::GithubClassroom => pretty(&classroom(verdict, repeat_all, repeat)),
    }
}

/// Why it fails, where that is known, what was found, and the cases that a terminal shows of it.
fn message(verdict: &Verdict, property: &Property, repeat: &dyn Fn(&str, u64) -> String) -> String {
    let cause = cause(verdict, property, "\n");
    // The property, what was found of it, and its cases.
    let shown = excerpts(verdict, repeat, Some(property.name));
    let shown: String = shown.iter().map(|one| text::excerpt(one, text::WIDTH)).collect();
    format!("{cause}{}: {}\n{shown}", property.about, property.detail).trim_end().to_owned()
}

/// Why a property fails, where that is known, and then `end`.
fn cause(verdict: &Verdict, property: &Property, end: &str) -> String {
    // An expected failure has its reason, too.
    let is_wrong = property.outcome != Outcome::Pass;
    let why = is_wrong.then(|| why(verdict, property.name)).flatten();
    why.map_or_else(String::new, |why| why + end)
}

/// Text between tags and in quoted attributes, where the ends of lines are kept.
fn xml(text: &str) -> String {
    html::escape(text).replace('\n', "&#10;")
}

/// The verdict as JUnit's XML: a property is a test.
fn junit(verdict: &Verdict, repeat: &dyn Fn(&str, u64) -> String) -> String {
    let (mut failures, mut skipped) = (0, 0);
    for p in &verdict.more.properties {
        failures += u64::from(!p.outcome.is_good());
        skipped += u64::from(p.outcome == Outcome::ExpectedFailure);
    }
    // Every property is a test, also one that was expected to fail.
    let tests = verdict.more.properties.len();
    let name = xml(&verdict.more.declared.name);
    let seconds = verdict.more.found.seconds;
    // The counts stand twice: of the suite, and of all suites, of which there is one.
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let counts = format!(
        "tests=\"{tests}\" failures=\"{failures}\" errors=\"0\" skipped=\"{skipped}\" time=\"{seconds:.3}\""
    );
    let _ = writeln!(out, "<testsuites name=\"rasterproof judge\" {counts}>");
    let _ = writeln!(out, "  <testsuite name=\"{name}\" {counts}>");
    for p in &verdict.more.properties {
        let case = format!("<testcase classname=\"{name}\" name=\"{}\" time=\"0\"", xml(p.name));
        // The text has everything, the attribute the reason in short.
        let text = xml(&message(verdict, p, repeat));
        let about = xml(&(cause(verdict, p, "; ") + &p.detail));
        // What holds needs no words.
        let kind = match p.outcome {
            Outcome::Pass => {
                let _ = writeln!(out, "    {case}/>");
                continue;
            }
            Outcome::ExpectedFailure => {
                let _ =
                    writeln!(out, "    {case}><skipped message=\"known: {about}\"/></testcase>");
                continue;
            }
            Outcome::UnexpectedPass => "unexpected pass",
            Outcome::Fail => "disagrees",
        };
        let _ = writeln!(
            out,
            "    {case}><failure type=\"{kind}\" message=\"{about}\">{text}</failure></testcase>"
        );
    }
    if !verdict.more.complaints.shown.is_empty() {
        let text = xml(&verdict.more.complaints.shown.join("\n"));
        let _ = writeln!(out, "    <system-err>{text}</system-err>");
    }
    out + "  </testsuite>\n</testsuites>\n"
}

/// The verdict by the Test Anything Protocol: a line for each property.
fn tap(verdict: &Verdict, repeat: &dyn Fn(&str, u64) -> String) -> String {
    let mut out = format!("TAP version 14\n1..{}\n", verdict.more.properties.len());
    for (p, number) in verdict.more.properties.iter().zip(1..) {
        // An expected failure is one that is to be mended, by the protocol's own word.
        let (word, mark) = match p.outcome {
            Outcome::Pass => ("ok", ""),
            Outcome::ExpectedFailure => ("not ok", " # TODO known failure"),
            Outcome::Fail | Outcome::UnexpectedPass => ("not ok", ""),
        };
        let _ = writeln!(out, "{word} {number} - {}{mark}", p.name);
        if p.outcome != Outcome::Pass {
            out += "  ---\n  message: |\n";
            for line in message(verdict, p, repeat).lines() {
                let _ = writeln!(out, "    {line}");
            }
            out += "  ...\n";
        }
    }
    out
}

/// Gradescope's results.json: each test with its name, whether it passed, and its output; and what they come to.
pub fn gradescope(tests: &[(&str, bool, String)], about: &str, seconds: f64) -> Value {
    let (mut passed_tests, mut shown) = (0, Vec::new());
    for ((name, passed, output), number) in tests.iter().zip(1..) {
        let number: usize = number;
        passed_tests += usize::from(*passed);
        shown.push(json!({
            "name": name, "number": number.to_string(), "score": i32::from(*passed), "max_score": 1,
            "status": if *passed { "passed" } else { "failed" }, "output": output,
            "output_format": "text", "visibility": "visible",
        }));
    }
    json!({
        "score": passed_tests, "visibility": "visible", "stdout_visibility": "visible",
        "execution_time": seconds.ceil() as u64,
        "output": format!("{passed_tests} of {} {about}", tests.len()),
        "tests": shown,
    })
}

/// The verdict for GitHub Classroom: a property is a test with a point.
fn classroom(verdict: &Verdict, repeat_all: &str, repeat: &dyn Fn(&str, u64) -> String) -> Value {
    let tests = verdict.more.properties.iter().map(|p| {
        let good = p.outcome.is_good();
        json!({
            "name": p.name, "status": if good { "pass" } else { "fail" }, "score": i32::from(good),
            "message": message(verdict, p, repeat), "test_code": repeat_all, "filename": "",
            "line_no": 0, "execution_time": "0s",
        })
    });
    json!({
        "version": 1, "status": if verdict.agrees() { "pass" } else { "fail" },
        "max_score": verdict.more.properties.len(), "tests": tests.collect::<Vec<_>>(),
    })
}
