//! The verdict on a program that was judged through the line protocol: as text, and as a page.

use std::fmt::Write as _;

use super::html::{Chapter, Column, Mark, Outcome, Report, Row, Table};
use super::{ascii, cases};
use crate::judge::check::Check;
use crate::judge::pictured::Pictured;
use crate::judge::run::{self, MOST_DEATHS};
use crate::judge::shrunk::Failure;
use crate::judge::verdict::{self, Score, Verdict, per_million};

/// Requests of a failing case that are shown.
const MOST_EXCHANGES: usize = 3;
/// Incidents that are shown of each kind.
const MOST_INCIDENTS: usize = 2;

/// The verdict as text of at most 100 columns, commands left out; they stay whole to be copied.
#[must_use]
pub fn text(verdict: &Verdict, repeat_all: &str, repeat: &dyn Fn(&str, u64) -> String) -> String {
    let mut out = String::new();
    let d = &verdict.declared;
    let _ = writeln!(out, "rasterproof {}, seed {}\n", env!("CARGO_PKG_VERSION"), verdict.seed);
    let said = format!("{} speaks version {}: {d}", d.name, d.version);
    out += &wrapped(&said, "  ");
    if !d.unknown.is_empty() {
        out += &wrapped(&format!("not understood, left aside: {}", d.unknown.join(" ")), "  ");
    }
    out.push('\n');
    stages(&mut out, verdict);
    table(&mut out, verdict);
    incidents(&mut out, verdict, repeat);
    for failure in &verdict.failures {
        one_failure(&mut out, failure, &repeat(failure.family, failure.index));
    }
    if !verdict.complaints.is_empty() {
        let _ = writeln!(out, "\nthe end of its standard error:");
        for line in &verdict.complaints {
            let _ = writeln!(out, "  | {line}");
        }
    }
    let _ = writeln!(out, "\nrepeat with: {repeat_all}");
    let word = if verdict.agrees() { "AGREES" } else { "DISAGREES" };
    out += &wrapped(&format!("{word}: {}", closing(verdict)), "  ");
    out
}

/// Breaks a line at spaces; the lines after the first begin with `indent`.
#[must_use]
pub fn wrapped(text: &str, indent: &str) -> String {
    let start = text.len() - text.trim_start().len();
    let mut lines = vec![text[..start].to_owned()];
    let mut is_first = true;
    for word in text[start..].split(' ') {
        let line = lines.last_mut().expect("there is a first line");
        if !is_first && line.chars().count() + 1 + word.chars().count() > 100 {
            lines.push(format!("{indent}{word}"));
        } else {
            *line += if is_first { "" } else { " " };
            *line += word;
        }
        is_first = false;
    }
    let lines: Vec<_> = lines.iter().map(|line| line.trim_end()).collect();
    lines.join("\n") + "\n"
}

fn score(of: Score) -> String {
    let share = per_million(of.wrong, of.pixels);
    let unscored = match of.unscored {
        0 => String::new(),
        n => format!("; {n} triangles or lines of which it says nothing are left out"),
    };
    format!("{} wrong pixels, {share:.0} in a million{unscored}", of.wrong)
}

/// Draws, winding, convention, both scores.
fn stages(out: &mut String, verdict: &Verdict) {
    for property in verdict
        .properties
        .iter()
        .take_while(|p| p.about.starts_with("it draws") || p.name == "protocol")
    {
        let mark = if property.outcome.is_good() { "yes" } else { "NO" };
        *out += &wrapped(&format!("{:<4} {}: {}", mark, property.about, property.detail), "     ");
    }
    let said = score(verdict.as_declared());
    let _ = writeln!(out, "as declared:         {said}");
    let indent = " ".repeat(21);
    let line = |out: &mut String, first: &str, text: &str| {
        *out += &wrapped(&format!("{first:<21}{text}"), &indent);
    };
    let Some(recognised) = &verdict.recognised else {
        let _ = writeln!(out, "by its convention:   the same: no other one was recognised\n");
        return;
    };
    match verdict.by_convention() {
        Some(found) => line(out, "by its convention:", &score(found)),
        None => line(out, "by its convention:", "unexplained, so there is no score"),
    }
    recognised.sentences.iter().chain(&recognised.compass).for_each(|text| line(out, "", text));
    if !recognised.declare.is_empty() {
        let turned = if verdict.declared.yup { " (in its words, y up)" } else { "" };
        line(out, "", &format!("to be judged by it: --declare '{}'{turned}", recognised.declare));
    }
    out.push('\n');
}

fn table(out: &mut String, verdict: &Verdict) {
    let header = ["cases", "shapes", "pixels", "missing", "extra", "twice", "order", "refused"];
    let _ = write!(out, "{:<16}", "property");
    header.iter().for_each(|name| {
        let _ = write!(out, " {name:>8}");
    });
    let _ = writeln!(out, " {:>7}", "wrong");
    let mut rows: Vec<_> = verdict.found.rows.iter().collect();
    rows.sort_by(|a, b| b.share().total_cmp(&a.share()));
    for row in rows {
        let t = &row.tally;
        let numbers =
            [row.cases, row.shapes, row.pixels, t.missing, t.extra, t.twice, t.order, row.refused];
        let _ = write!(out, "{:<16}", row.name);
        numbers.iter().for_each(|n| {
            let _ = write!(out, " {n:>8}");
        });
        let _ = writeln!(out, " {:>6.2}%", 100.0 * row.share());
    }
    *out += "(wrong: share of the cases with anything wrong; of meshes, missing are holes)\n";
    for row in verdict.found.rows.iter().filter(|row| row.values > 0) {
        let _ = writeln!(
            out,
            "{}: {} compared, the worst at {:.3e} of the tolerance {:e}",
            row.name, row.values, row.worst, verdict.declared.tolerance
        );
    }
    for row in verdict.found.rows.iter().filter(|row| row.stopped) {
        let _ = writeln!(out, "{}: given up after {MOST_DEATHS} times without an answer", row.name);
    }
    if verdict.found.gave_up {
        let _ = writeln!(
            out,
            "given up for good: {} times without an answer, or no answer at all",
            run::MOST_DEATHS_IN_ALL
        );
    }
}

/// What happened instead of answers.
pub fn incidents(out: &mut String, verdict: &Verdict, repeat: &dyn Fn(&str, u64) -> String) {
    let mut shown: Vec<&str> = Vec::new();
    for incident in &verdict.found.incidents {
        let word = incident.what.word();
        if shown.iter().filter(|w| **w == word).count() == MOST_INCIDENTS {
            continue;
        }
        shown.push(word);
        let (family, index) = (incident.family, incident.index);
        let place = match family {
            "" => "before the families".to_owned(),
            _ => format!("{family} #{index}"),
        };
        *out += "\n";
        *out += &wrapped(&format!("{place}: it {}", incident.what), "  ");
        let _ = writeln!(out, "  request:  {}", incident.request);
        if !family.is_empty() {
            let _ = writeln!(out, "  repeat with: {}", repeat(family, index));
        }
    }
    for stray in &verdict.found.strays {
        *out += &wrapped(
            &format!("\nwith several requests in flight it {stray}; each alone was answered"),
            "  ",
        );
    }
}

/// A failing case: what was asked and answered, with its pixel grid.
pub fn one_failure(out: &mut String, failure: &Failure, command: &str) {
    *out += "\n";
    let (family, index) = (failure.family, failure.index);
    let found = format!("{}: {} (from {family} #{index}, shrunk)", failure.property, failure.what);
    *out += &wrapped(&found, "  ");
    for exchange in failure.exchanges.iter().take(MOST_EXCHANGES) {
        for (what, line) in [
            ("request", &exchange.request),
            ("answer", &exchange.answer),
            ("expected", &exchange.expected),
        ] {
            if !line.is_empty() {
                *out += &wrapped(&format!("  {:<10}{line}", format!("{what}:")), "            ");
            }
        }
    }
    let more = failure.exchanges.len().saturating_sub(MOST_EXCHANGES);
    if more > 0 {
        let _ = writeln!(out, "  and {more} requests more");
    }
    if let Some(pictured) = &failure.picture {
        picture(out, "judged", pictured);
    }
    let _ = writeln!(out, "  repeat with: {command}");
}

/// What was drawn beside what was expected, as characters.
pub fn picture(out: &mut String, drawn_by: &str, picture: &Pictured) {
    let Pictured { drawn, expected, of, .. } = picture;
    let blocks = [
        (drawn_by.to_owned(), ascii::grid(drawn, expected)),
        ("expected".to_owned(), ascii::grid(expected, expected)),
    ];
    for line in ascii::side_by_side(&blocks, 98).lines() {
        let _ = writeln!(out, "{}", format!("  {line}").trim_end());
    }
    *out += "  (# agrees, - missing, + extra, 2 twice, . neither)\n";
    if !of.is_empty() {
        *out += &wrapped(&format!("  ({of})"), "   ");
    }
}

/// The verdict in a sentence.
fn closing(verdict: &Verdict) -> String {
    let wrong = verdict.as_declared().wrong;
    let failing: Vec<_> =
        verdict.properties.iter().filter(|p| !p.outcome.is_good()).map(|p| p.name).collect();
    let what = format!(
        "{} triangles and {} lines, {wrong} wrong pixels",
        verdict.shapes(false),
        verdict.shapes(true)
    );
    let known =
        verdict.properties.iter().filter(|p| p.outcome == verdict::Outcome::ExpectedFailure);
    let known = match known.count() {
        0 => String::new(),
        n => format!(", {n} properties fail as the baseline says"),
    };
    match failing.as_slice() {
        [] => format!("{what}{known}"),
        names => format!(
            "{what}{known}; {} of {} properties fail: {}",
            names.len(),
            verdict.properties.len(),
            names.join(", ")
        ),
    }
}

/// The run as a page: properties and counts, then each failing case with what everybody draws there.
#[must_use]
pub fn page(verdict: &Verdict, repeat_all: &str, repeat: &dyn Fn(&str, u64) -> String) -> Report {
    let good = verdict.agrees();
    let word = if good { "AGREES" } else { "DISAGREES" };
    let views = verdict.failures.iter().map(|f| {
        let name = format!("{}#{}", f.family, f.index);
        let about = format!("{}: found in {} #{}, shrunk", f.property, f.family, f.index);
        let mut view =
            cases::of_program(name, about, &f.case, &verdict.declared.name, f.picture.as_ref());
        view.found.clone_from(&f.what);
        view.command = repeat(f.family, f.index);
        let chapter = match f.check {
            Check::Depth => Some(("chapter 6, depth", "ch06.md")),
            Check::Near => Some(("chapter 7, clipping", "ch07.md")),
            Check::Samples => Some(("GAMES101, four samples", "games101.md")),
            _ => None,
        };
        if let Some((title, path)) = chapter {
            view.chapter = Chapter { title, path };
        }
        view
    });
    let d = &verdict.declared;
    let mut notes = vec![format!("{} speaks version {}: {d}", d.name, d.version)];
    if let Some(said) = &verdict.recognised {
        notes.extend(said.sentences.iter().chain(&said.compass).cloned());
    }
    Report {
        title: format!("Verdict on {}", d.name),
        outcome: Some(Outcome { good, word: word.to_owned(), sentence: closing(verdict) }),
        command: format!("{repeat_all} --report").replace(" --report", "").replacen(
            "rasterproof judge",
            "rasterproof judge --report",
            1,
        ),
        seed: Some(verdict.seed),
        notes,
        tables: vec![properties(verdict)],
        cases: views.collect(),
        ..Report::default()
    }
}

fn properties(verdict: &Verdict) -> Table {
    let row = |p: &verdict::Property| Row {
        cells: vec![
            p.name.to_owned(),
            if p.outcome.is_good() { "holds" } else { "fails" }.to_owned(),
            p.about.clone(),
            p.detail.clone(),
        ],
        mark: if p.outcome.is_good() { Mark::Plain } else { Mark::Wrong },
        search: verdict.failures.iter().any(|f| f.property == p.name).then(|| p.name.to_owned()),
    };
    let (bad, good): (Vec<_>, Vec<_>) =
        verdict.properties.iter().partition(|p| !p.outcome.is_good());
    Table {
        caption: "Properties, those that fail first".to_owned(),
        columns: ["property", "", "what it says", "found"].map(Column::words).to_vec(),
        rows: bad.into_iter().chain(good).map(row).collect(),
    }
}
