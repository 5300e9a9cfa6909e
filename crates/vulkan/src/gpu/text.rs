//! The verdict on a device as text, as JSON and as a page.

use std::fmt::Write as _;

use super::campaign::DeviceReport;
use super::rules::{Class, Finding};
use crate::device::find::About;
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::judge_text::{self, wrapped};
use rasterproof_report::table::{Column, Mark, Row, Table};

pub fn device(about: &About) -> String {
    let lines = [
        (about.strict_lines, "strict"),
        (about.rectangular_lines, "rectangular by choice"),
        (about.bresenham_lines, "Bresenham by choice"),
    ];
    let lines: Vec<_> = lines.iter().filter(|(has, _)| *has).map(|(_, word)| *word).collect();
    let lines = if lines.is_empty() { "loose".to_owned() } else { lines.join(", ") };
    let samples = match (about.four_samples, about.standard_samples) {
        (true, true) => "four samples at standard places",
        (true, false) => "four samples at places of its own",
        _ => "one sample",
    };
    let depths = if about.float_depth { "depths of 16 bits and f32" } else { "depths of 16 bits" };
    let bits = match about.line_subpixel_bits {
        bits if bits == about.subpixel_bits => String::new(),
        bits => format!(" with {bits} subpixel bits"),
    };
    let [width, height] = about.largest_viewport;
    format!(
        "{}; driver {} {}, Vulkan {}; {} subpixel bits, viewport to {width} x {height} px, {samples}, \
         {depths}, lines {lines}{bits}",
        about.device, about.driver, about.version, about.vulkan, about.subpixel_bits
    )
}

/// The verdict as text of at most 100 columns, the command left out, with what follows it for all and for a
/// case.
pub fn text(
    stand: &DeviceReport,
    command: &str,
    all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> String {
    let repeat = |family: &str, index: u64| format!("...{}", repeat(family, index));
    let repeat: &dyn Fn(&str, u64) -> String = &repeat;
    let verdict = &stand.verdict;
    let mut out = format!("rasterproof {}, seed {}\n\n", env!("CARGO_PKG_VERSION"), verdict.seed);
    let name = &verdict.declared.name;
    out += &wrapped(&format!("{name}: {}", device(&stand.about)), "  ");
    if let Some(plant) = stand.plant {
        let _ = writeln!(out, "a fault is planted: {plant}");
    }
    out.push('\n');
    for finding in &stand.findings {
        let line = format!("{:<18} {:<22} {}", finding.name, finding.class.words(), finding.detail);
        out += &wrapped(&line, &" ".repeat(42));
    }
    if let Some(row) = verdict.found.rows.iter().find(|row| row.values > 0) {
        let _ = writeln!(
            out,
            "values: {} compared, the worst at {:.3} of the derived bound",
            row.values, row.worst
        );
    }
    out += "\nby these rules of the specification:\n";
    for (section, names) in sections(&stand.findings) {
        out += &wrapped(&format!("  {section} ({})", names.join(", ")), "      ");
    }
    if let Some(said) = &verdict.recognised {
        out.push('\n');
        for text in said.sentences.iter().chain(&said.compass) {
            out += &wrapped(&format!("it draws as one who says: {text}"), "  ");
        }
    }
    if !verdict.causes.is_empty() {
        out.push('\n');
        judge_text::causes(&mut out, verdict);
    }
    judge_text::incidents(&mut out, verdict, repeat);
    for failure in &verdict.failures {
        judge_text::one_failure(
            &mut out,
            failure,
            &["judged"],
            &repeat(failure.family, failure.index),
        );
    }
    if !verdict.complaints.is_empty() {
        out += "\nthe device said:\n";
        verdict.complaints.iter().for_each(|line| out += &wrapped(&format!("  | {line}"), "  | "));
    }
    for about in &stand.known {
        out += &wrapped(&format!("known of this driver: {about}"), "  ");
    }
    let _ = writeln!(out, "\nrepeat with: ...{all}\nwhere ... is: {command}");
    out += &wrapped(&format!("{}: {}", word(stand), closing(stand)), "  ");
    out
}

/// Sections in order, with what each says, and the names of what was judged by it.
fn sections(findings: &[Finding]) -> Vec<(String, Vec<&str>)> {
    let mut sections: Vec<(String, Vec<&str>)> = Vec::new();
    for finding in findings {
        let rule = finding.rule;
        let text = format!("{}: {}. Open: {}", rule.section, rule.says, rule.open);
        match sections.iter_mut().find(|(said, _)| *said == text) {
            Some((_, names)) => names.push(&finding.name),
            None => sections.push((text, vec![&finding.name])),
        }
    }
    sections
}

fn word(stand: &DeviceReport) -> &'static str {
    if stand.agrees() { "AGREES" } else { "DISAGREES" }
}

fn closing(stand: &DeviceReport) -> String {
    let count = |class: Class| stand.findings.iter().filter(|f| f.class == class).count();
    let bad: Vec<_> =
        stand.findings.iter().filter(|f| !f.class.is_good()).map(|f| f.name.as_str()).collect();
    let shapes = stand.verdict.shapes(false);
    let mut said = format!(
        "{shapes} triangles, {} equal, {} allowed but different from the oracle, {} known",
        count(Class::Equal),
        count(Class::Allowed),
        count(Class::Known)
    );
    let wrong = stand.verdict.as_declared().wrong;
    said += &format!(", {wrong} pixels other than the oracle's");
    if !bad.is_empty() {
        said += &format!("; {} of {} fail: {}", bad.len(), stand.findings.len(), bad.join(", "));
    }
    said
}

pub fn json(stand: &DeviceReport, repeat: &dyn Fn(&str, u64) -> String) -> String {
    let failures: Vec<_> = stand
        .verdict
        .failures
        .iter()
        .map(|f| {
            let exchanges = f.exchanges.iter().map(|e| {
            serde_json::json!({ "request": e.request, "answer": e.answer, "expected": e.expected })
        });
            serde_json::json!({
                "property": f.property, "family": f.family, "case": f.index, "what": f.what,
                "exchanges": exchanges.collect::<Vec<_>>(), "repeat": repeat(f.family, f.index),
            })
        })
        .collect();
    let all = serde_json::json!({
        "rasterproof": env!("CARGO_PKG_VERSION"),
        "engine": stand.verdict.declared.name,
        "device": stand.about,
        "planted": stand.plant,
        "seed": stand.verdict.seed,
        "cases": stand.verdict.cases,
        "triangles": stand.verdict.shapes(false),
        "agrees": stand.agrees(),
        "findings": stand.findings,
        "failures": failures,
        "complaints": stand.verdict.complaints,
    });
    format!("{all:#}\n")
}

#[must_use]
pub fn page(
    stand: &DeviceReport,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> Report {
    let row = |f: &Finding| Row {
        cells: vec![
            f.name.clone(),
            f.class.words().to_owned(),
            format!("{}: {}", f.rule.section, f.rule.says),
            f.detail.clone(),
        ],
        mark: if f.class.is_good() { Mark::Plain } else { Mark::Wrong },
        search: stand.verdict.failures.iter().any(|x| x.property == f.name).then(|| f.name.clone()),
    };
    let table = Table {
        caption: "What was judged, and by which rule of the specification".to_owned(),
        columns: ["property", "", "rule", "found"].map(Column::words).to_vec(),
        rows: stand.findings.iter().map(row).collect(),
    };
    let good = stand.agrees();
    let mut page = judge_text::page(&stand.verdict, repeat_all, repeat);
    page.title = format!("Verdict on {}", stand.about.device);
    page.outcome = Some(Outcome { good, word: word(stand).to_owned(), sentence: closing(stand) });
    page.command = format!("{repeat_all} --report");
    page.notes.insert(0, device(&stand.about));
    page.tables = vec![table];
    page
}
