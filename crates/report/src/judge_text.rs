//! The verdict on a program that was judged through the line protocol: as text, and as a page.

use std::fmt::Write as _;

use super::html::{Chapter, Outcome, Report};
use super::table::{Column, Mark, Row, Table};
use super::{ascii, page_cases, summary};
use rasterproof_judge::against;
use rasterproof_judge::check::Check;
use rasterproof_judge::failures::Failure;
use rasterproof_judge::pictured::Pictured;
use rasterproof_judge::recognise::Why;
use rasterproof_judge::run::{self, Found, MOST_DEATHS, Row as FamilyRow};
use rasterproof_judge::verdict::{self, Score, Verdict, per_million};

const MOST_EXCHANGES: usize = 3;
const MOST_INCIDENTS: usize = 2;

/// The verdict as text: the answer, a line for each danger, the table where something is wrong or it is
/// asked for, what is wrong, and the verdict in a word.
#[must_use]
pub fn text(
    verdict: &Verdict,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
    (with_table, colour): (bool, bool),
) -> String {
    let (d, agrees) = (&verdict.declared, verdict.agrees());
    let answer = if agrees { "is right" } else { "is not right" };
    let mut out = format!(
        "{} rasterproof {}, seed {}: {} {answer}\n\n",
        summary::mark(agrees, colour),
        env!("CARGO_PKG_VERSION"),
        verdict.seed,
        d.name
    );
    let _ = writeln!(out, "{} speaks version {}: {d}", d.name, d.version);
    if let Some(reach) = verdict.reach {
        let _ = writeln!(
            out,
            "it walks along its lines, so lines of at most {} steps are asked for",
            summary::thousands(reach.unsigned_abs().into())
        );
    }
    if !d.unknown.is_empty() {
        let _ = writeln!(out, "not understood, left aside: {}", d.unknown.join(" "));
    }
    out.push('\n');
    causes(&mut out, verdict);
    dangers(&mut out, verdict, colour);
    out.push('\n');
    scores(&mut out, verdict);
    if with_table || !agrees {
        out.push('\n');
        table(&mut out, verdict);
    }
    incidents(&mut out, verdict, repeat);
    failures(&mut out, verdict, &["judged"], repeat);
    if verdict.known > 0 {
        let known = summary::thousands(verdict.known);
        let _ = writeln!(out, "\nnot shown: {known} failing cases that the baseline knows");
    }
    complaints(&mut out, verdict);
    let _ = writeln!(out, "\nrepeat with: {repeat_all}");
    if !with_table && agrees {
        out += "every family as a table: add --table\n";
    }
    let _ = writeln!(out, "{}: {}", summary::word(agrees), closing(verdict));
    out
}

pub(super) fn complaints(out: &mut String, verdict: &Verdict) {
    if !verdict.complaints.is_empty() {
        let _ = writeln!(out, "\nthe end of its standard error:");
        for line in &verdict.complaints {
            let _ = writeln!(out, "  | {line}");
        }
    }
}

/// The failing cases; `drawn_by` names the one or the two programs.
pub(super) fn failures(
    out: &mut String,
    verdict: &Verdict,
    drawn_by: &[&str],
    repeat: &dyn Fn(&str, u64) -> String,
) {
    for failure in &verdict.failures {
        one_failure(out, failure, drawn_by, &repeat(failure.family, failure.index));
    }
}

/// A line for how it keeps the protocol, for its winding, for each danger and for each other check.
fn dangers(out: &mut String, verdict: &Verdict, colour: bool) {
    let mut entry = |is_good, name, what: &str| {
        *out += &summary::entry(summary::mark(is_good, colour), name, what);
    };
    let is_good =
        |name: &str| verdict.properties.iter().all(|p| p.name != name || p.outcome.is_good());
    for p in verdict.properties.iter().filter(|p| ["protocol", "winding"].contains(&p.name)) {
        let what = match (p.name, p.outcome.is_good()) {
            ("winding", true) => format!("{}, as it declares", verdict.declared.winding.word()),
            _ => p.detail.clone(),
        };
        entry(p.outcome.is_good(), p.name, &what);
    }
    let rows = &verdict.found.rows;
    for danger in summary::DANGERS {
        let of = || rows.iter().filter(|row| danger.families.contains(&row.name));
        let mut sum = summary::Sum::default();
        for row in of() {
            sum.cases += row.cases;
            sum.wrong_cases += row.wrong_cases;
            sum.tally += row.tally;
        }
        if of().next().is_some() {
            entry(of().all(|row| is_good(row.name)), danger.name, &sum.describe());
        }
    }
    let in_a_danger = |name: &str| summary::DANGERS.iter().any(|d| d.families.contains(&name));
    for row in rows.iter().filter(|row| !in_a_danger(row.name)) {
        let what = match row.wrong_cases {
            0 => format!("{} cases, all right", summary::thousands(row.cases)),
            _ => verdict::sentence(row),
        };
        entry(is_good(row.name), row.name, &what);
    }
}

/// Breaks a line at spaces; the lines after the first begin with `indent`.
pub fn wrapped(text: &str, indent: &str) -> String {
    let (first, words) = text.split_at(text.len() - text.trim_start().len());
    hanging(words, first, indent) + "\n"
}

/// The words in lines of at most 80 columns: the first begins with `first`, the others with `rest`.
pub fn hanging(words: &str, first: &str, rest: &str) -> String {
    let mut lines = vec![first.to_owned()];
    for (i, word) in words.split(' ').enumerate() {
        let line = lines.last_mut().expect("there is a first line");
        if i > 0 && line.chars().count() + 1 + word.chars().count() > 80 {
            lines.push(format!("{rest}{word}"));
        } else {
            *line += if i == 0 { "" } else { " " };
            *line += word;
        }
    }
    lines.iter().map(|line| line.trim_end()).collect::<Vec<_>>().join("\n")
}

/// The score, with the wrong pixels of the shapes that it leaves out.
fn score(of: Score, left_out_wrong: u64) -> String {
    let share = per_million(of.wrong, of.pixels);
    let unscored = match of.unscored {
        0 => String::new(),
        n => format!(
            "; {n} triangles or lines of which it says nothing are left out, with {left_out_wrong} wrong pixels as declared"
        ),
    };
    format!("{} wrong pixels, {share:.0} in a million{unscored}", of.wrong)
}

fn scores(out: &mut String, verdict: &Verdict) {
    let said = score(verdict.as_declared(), 0);
    let _ = writeln!(out, "as declared:         {said}");
    let line = |out: &mut String, first: &str, text: &str| {
        let _ = writeln!(out, "{first:<21}{text}");
    };
    let Some(recognised) = &verdict.recognised else {
        return line(out, "by its convention:", "the same: no other one was recognised");
    };
    match verdict.by_convention() {
        Some(found) => line(out, "by its convention:", &score(found, verdict.left_out_wrong())),
        None => line(out, "by its convention:", "unexplained, so there is no score"),
    }
    recognised.sentences.iter().chain(&recognised.compass).for_each(|text| line(out, "", text));
    if !recognised.declare.is_empty() {
        let turned = if verdict.declared.yup { " (in its words, y up)" } else { "" };
        line(out, "", &format!("to be judged by it: --declare '{}'{turned}", recognised.declare));
    }
}

/// Why it is wrong, where that was looked for.
pub fn causes(out: &mut String, verdict: &Verdict) {
    for why in &verdict.causes {
        let known = if why.why.is_known() { "probable cause" } else { "no cause recognised" };
        let _ = writeln!(out, "{known}, of the wrong {}:", why.whose());
        let why = &why.why;
        why.sentences().iter().for_each(|said| *out += &wrapped(&format!("  {said}"), "    "));
        out.push('\n');
    }
}

fn table(out: &mut String, verdict: &Verdict) {
    let numbers = ["cases", "shapes", "pixels", "missing", "extra", "twice", "order", "refused"];
    let numbers = numbers.map(|label| Column::numbers(label, "").least(8));
    let columns = [Column::words("property").least(16)].into_iter().chain(numbers);
    let columns = columns.chain([Column::numbers("wrong", "").least(7)]).collect();
    let mut rows: Vec<_> = verdict.found.rows.iter().collect();
    rows.sort_by(|a, b| b.share().total_cmp(&a.share()));
    let row = |row: &FamilyRow| {
        let t = &row.tally;
        let numbers =
            [row.cases, row.shapes, row.pixels, t.missing, t.extra, t.twice, t.order, row.refused];
        let mut cells = vec![row.name.to_owned()];
        cells.extend(numbers.map(|n| n.to_string()));
        cells.push(format!("{:.2}%", 100.0 * row.share()));
        cells.into()
    };
    let rows = rows.into_iter().map(row).collect();
    *out += &Table { columns, rows, ..Table::default() }.text([0; 2]);
    *out += "(wrong: share of the cases with anything wrong; of meshes, missing are holes)\n";
    for row in verdict.found.rows.iter().filter(|row| row.values > 0) {
        let _ = writeln!(
            out,
            "{}: {} compared, {}, which is {:e}",
            row.name,
            row.values,
            summary::of_bound(row.worst).replace("bound", "tolerance"),
            verdict.declared.tolerance
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

pub fn incidents(out: &mut String, verdict: &Verdict, repeat: &dyn Fn(&str, u64) -> String) {
    let mut shown: Vec<&str> = Vec::new();
    for incident in &verdict.found.incidents {
        let word = incident.what.breach.name();
        if shown.iter().filter(|w| **w == word).count() == MOST_INCIDENTS {
            continue;
        }
        shown.push(word);
        let (family, index) = (incident.family, incident.index);
        let place = match family {
            "" => "before the families".to_owned(),
            _ => format!("{family} #{index}"),
        };
        let _ = writeln!(out, "\n{place}: it {}", incident.what);
        let _ = writeln!(out, "  request:  {}", incident.request);
        if !family.is_empty() {
            let _ = writeln!(out, "  repeat with: {}", repeat(family, index));
        }
    }
    for stray in &verdict.found.strays {
        let flight = "with several requests in flight it";
        let _ = writeln!(out, "\n{flight} {stray}; each alone was answered");
    }
}

/// A failing case: what was asked and answered, with its pixel grid.
pub fn one_failure(out: &mut String, failure: &Failure, drawn_by: &[&str], command: &str) {
    let (family, index) = (failure.family, failure.index);
    let (property, what) = (failure.property, &failure.what);
    let _ = writeln!(out, "\n{property}: {what} (from {family} #{index}, {})", failure.shrunk);
    for exchange in failure.exchanges.iter().take(MOST_EXCHANGES) {
        for (what, line) in [
            ("request", &exchange.request),
            ("answer", &exchange.answer),
            ("other", &exchange.other),
            ("expected", &exchange.expected),
        ] {
            if !line.is_empty() {
                let _ = writeln!(out, "  {:<10}{line}", format!("{what}:"));
            }
        }
    }
    let more = failure.exchanges.len().saturating_sub(MOST_EXCHANGES);
    if more > 0 {
        let _ = writeln!(out, "  and {more} requests more");
    }
    if let Some(pictured) = &failure.picture {
        picture(out, drawn_by, pictured);
    }
    let _ = writeln!(out, "  repeat with: {command}");
}

/// What was drawn beside what was expected, as characters.
pub fn picture(out: &mut String, drawn_by: &[&str], picture: &Pictured) {
    let Pictured { drawn, other, expected, of, .. } = picture;
    let drawn = drawn_by.iter().zip([drawn].into_iter().chain(other));
    let judged = drawn.map(|(by, drawn)| ((*by).to_owned(), ascii::grid(drawn, expected)));
    let exact = ("expected".to_owned(), ascii::grid(expected, expected));
    let blocks: Vec<_> = judged.chain([exact]).collect();
    for line in ascii::side_by_side(&blocks, 98).lines() {
        let _ = writeln!(out, "{}", format!("  {line}").trim_end());
    }
    let _ = writeln!(out, "  ({})", ascii::LEGEND);
    if !of.is_empty() {
        *out += &wrapped(&format!("  ({of})"), "   ");
    }
}

/// Whether both of two compared programs answer the same.
pub(super) fn difference(verdict: &Verdict, [first, second]: &[String; 2]) -> String {
    let rows = &verdict.found.rows;
    let sum = |of: fn(&FamilyRow) -> u64| rows.iter().map(of).sum::<u64>();
    let cases = summary::thousands(sum(|row| row.cases));
    let until = if verdict.found.out_of_time { " until the time was up" } else { "" };
    match sum(|row| row.wrong_cases) {
        0 => format!("{first} and {second} answer the same in {cases} cases{until}"),
        n => format!(
            "{first} and {second} differ in {} of {cases} cases{until}",
            summary::thousands(n)
        ),
    }
}

fn closing(verdict: &Verdict) -> String {
    let wrong = verdict.as_declared().wrong;
    let failing: Vec<_> =
        verdict.properties.iter().filter(|p| !p.outcome.is_good()).map(|p| p.name).collect();
    let Found { cases, of_cases, out_of_time, .. } = verdict.found;
    let until = match out_of_time {
        true => format!(", {cases} of {of_cases} cases in full when the time was up"),
        false => String::new(),
    };
    let what = format!(
        "{} triangles and {} lines, {wrong} wrong pixels{until}",
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
pub fn page(verdict: &Verdict, command: &str, repeat: &dyn Fn(&str, u64) -> String) -> Report {
    let d = &verdict.declared;
    let both = verdict.against.as_ref().map(|second| against::names([d, second]));
    let programs = match &both {
        Some([first, second]) => vec![first.as_str(), second],
        None => vec![d.name.as_str()],
    };
    let views = verdict.failures.iter().map(|f| {
        let name = format!("{}#{}", f.family, f.index);
        let about = format!("{}: found in {} #{}, {}", f.property, f.family, f.index, f.shrunk);
        let mut view = page_cases::of_program(name, about, &f.case, &programs, f.picture.as_ref());
        view.found.clone_from(&f.what);
        view.command = repeat(f.family, f.index);
        let chapter = match f.check {
            Check::Depth => Some(("chapter 6, depth", "ch06.md")),
            Check::Near | Check::Carried => Some(("chapter 7, clipping", "ch07.md")),
            Check::Samples => Some(("GAMES101, four samples", "games101.md")),
            _ => None,
        };
        if let Some((title, path)) = chapter {
            view.chapter = Chapter { title, path };
        }
        view
    });
    let mut notes = vec![format!("{} speaks version {}: {d}", d.name, d.version)];
    for why in &verdict.causes {
        let known = if why.why.is_known() { "Probable cause" } else { "No cause recognised" };
        notes.push(format!("{known}, of the wrong {}: {}", why.whose(), why.why));
    }
    if let Some(said) = &verdict.recognised {
        notes.extend(said.sentences.iter().chain(&said.compass).cloned());
    }
    // The mistake says more than the properties that fail.
    let cause = verdict.causes.iter().find_map(|Why { why, .. }| why.causes.first());
    let cause = cause.map_or_else(String::new, |cause| format!("it {}; ", cause.does));
    let (title, headline) = match &both {
        Some(names) => {
            let title = format!("{} against {}", names[0], names[1]);
            (title, difference(verdict, names))
        }
        None => (format!("Verdict on {}", d.name), cause + &closing(verdict)),
    };
    Report {
        title,
        outcome: Some(Outcome::of(verdict.agrees(), headline)),
        command: command.to_owned(),
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
