//! The verdict on a device: for each property what was found and by which rule of the specification it was judged, then the rules,
//! each with what it leaves open, and the cases that fail, as in the verdict on a program.

use super::campaign::DeviceReport;
use super::outcome::Requirement;
use crate::device::find::About;
use rasterproof_judge::verdict::{Scores as _, Shapes};
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::table::{Mark, Row, Table};
use rasterproof_report::{json, judge_text};
use rasterproof_verify::specification::Standing;

/// What a device says of itself, in a line.
pub fn device(about: &About) -> String {
    let mut lines = Vec::new();
    for (has, word) in [
        (about.strict_lines, "strict"),
        (about.rectangular_lines, "rectangular by choice"),
        (about.bresenham_lines, "Bresenham by choice"),
    ] {
        if has {
            lines.push(word);
        }
    }
    let lines = if lines.is_empty() { "loose".to_owned() } else { lines.join(", ") };
    // A device without four samples is asked about the centres of pixels alone.
    let samples = match (about.four_samples, about.standard_samples) {
        (true, true) => "four samples at standard places",
        (true, false) => "four samples at places of its own",
        _ => "one sample",
    };
    let depths = if about.float_depth { "depths of 16 bits and f32" } else { "depths of 16 bits" };
    // Lines may lie on a finer or coarser lattice than corners of triangles.
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

/// Sections in order, with what each says, and the names of what was judged by it.
fn sections(findings: &[Requirement]) -> Vec<(String, Vec<&str>)> {
    let mut sections: Vec<(String, Vec<&str>)> = Vec::new();
    for finding in findings {
        let rule = finding.rule;
        let text = format!("{}: {}. Open: {}", rule.section, rule.says, rule.open);
        // Properties that are judged by one rule share its section.
        match sections.iter_mut().find(|(said, _)| *said == text) {
            Some((_, names)) => names.push(&finding.name),
            None => sections.push((text, vec![&finding.name])),
        }
    }
    sections
}

/// The answer in a sentence: how many properties are equal, allowed or known, and which of them fail.
fn closing(stand: &DeviceReport) -> String {
    let count = |class: Standing| stand.findings.iter().filter(|f| f.class == class).count();
    let mut bad = Vec::new();
    for finding in stand.findings.iter().filter(|f| !f.class.is_good()) {
        bad.push(finding.name.as_str());
    }
    let shapes = stand.verdict.shapes(Shapes::Triangles);
    let first = match stand.verdict.more.found.changing.is_empty() {
        true => "",
        false => "its answers change from one time to the next; ",
    };
    let mut said = format!(
        "{first}{shapes} triangles, {} equal, {} allowed but different from the oracle, {} known",
        count(Standing::Equal),
        count(Standing::Allowed),
        count(Standing::Known)
    );
    let wrong = stand.verdict.as_declared().wrong;
    said += &format!(", {wrong} pixels other than the oracle's");
    if !bad.is_empty() {
        said += &format!("; {} of {} fail: {}", bad.len(), stand.findings.len(), bad.join(", "));
    }
    said
}

/// What the JSON of a device has besides that of a program.
#[derive(serde::Serialize)]
struct Device<'a> {
    about: &'a About,
    planted: Option<&'static str>,
    findings: &'a [Requirement],
}

/// The verdict: each finding with the rule by which it was judged, and the cases that fail.
pub fn report(
    stand: &DeviceReport,
    repeat_all: &str,
    repeat: &dyn Fn(&str, u64) -> String,
) -> Report {
    let verdict = &stand.verdict;
    let findings = table(stand);
    let mut rules = Vec::new();
    for (section, names) in sections(&stand.findings) {
        rules.push(format!("{section} ({})", names.join(", ")));
    }
    let rules = Table::of_notes("Rules of the specification", rules);
    // A terminal has the rules below.
    let mut short = findings.clone();
    short.columns.pop();
    for row in &mut short.rows {
        row.cells.pop();
    }
    let mut about = format!("{}: {}", verdict.more.declared.name, device(&stand.about));
    if let Some(plant) = &stand.plant {
        about += &format!("\na fault is planted: {plant}");
    }
    // All else is as in the verdict on a program.
    let whole = judge_text::whole(verdict, repeat_all, repeat, false);
    let mut data = whole.data;
    data["agrees"] = stand.agrees().into();
    data["device"] = json::value(&Device {
        about: &stand.about,
        planted: stand.plant,
        findings: &stand.findings,
    });
    Report {
        title: format!("Verdict on {}", stand.about.device),
        about,
        outcome: Some(Outcome::of(stand.agrees(), closing(stand))),
        command: format!("{repeat_all} --report"),
        first_screen: vec![short, rules.clone()],
        tables: vec![findings, rules],
        data,
        ..whole
    }
}

/// What was found of each property, with notes of what is true of all.
fn table(stand: &DeviceReport) -> Table {
    let verdict = &stand.verdict;
    let mut rows = Vec::new();
    for f in &stand.findings {
        let rule = format!("{}: {}", f.rule.section, f.rule.says);
        // A property with a failing case leads to it.
        let has_case = verdict.failures.iter().any(|failure| failure.evidence.shows(&f.name));
        rows.push(Row {
            cells: vec![f.name.clone(), f.class.words().to_owned(), f.detail.clone(), rule],
            mark: if f.class.is_good() { Mark::Plain } else { Mark::Wrong },
            search: has_case.then(|| f.name.clone()),
            ..Row::default()
        });
    }
    // What is true of all properties together stands below the table.
    let mut notes = Vec::new();
    if let Some(row) = verdict.families.iter().find(|row| row.values > 0) {
        let (values, worst) = (row.values, row.worst);
        notes.push(format!(
            "values: {values} compared, the worst at {worst:.3} of the derived bound"
        ));
    }
    if let Some(said) = &verdict.more.recognised {
        let said = said.sentences.iter().chain(&said.compass);
        notes.extend(said.map(|text| format!("it draws as one who says: {text}")));
    }
    let left_out = verdict.more.left_out.to_string();
    notes.extend(Some(left_out).filter(|said| !said.is_empty()));
    notes.extend(stand.known.iter().map(|about| format!("known of this driver: {about}")));
    let columns = "property 22 | ~class 22 | found 1 | rule";
    let findings =
        Table::new("What was judged, and by which rule of the specification", columns, rows);
    findings.noted(notes).judged()
}
