//! The verdict on a device.

use super::campaign::DeviceReport;
use super::outcome::Requirement;
use crate::device::find::About;
use rasterproof_judge::verdict::{Scores as _, Shapes};
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::table::{Mark, Row, Table};
use rasterproof_report::{json, judge_text};
use rasterproof_verify::specification::Standing;

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

/// Sections in order, with what each says, and the names of what was judged by it.
fn sections(findings: &[Requirement]) -> Vec<(String, Vec<&str>)> {
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

fn closing(stand: &DeviceReport) -> String {
    let count = |class: Standing| stand.findings.iter().filter(|f| f.class == class).count();
    let bad: Vec<_> =
        stand.findings.iter().filter(|f| !f.class.is_good()).map(|f| f.name.as_str()).collect();
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
    let row = |f: &Requirement| Row {
        cells: vec![
            f.name.clone(),
            f.class.words().to_owned(),
            f.detail.clone(),
            format!("{}: {}", f.rule.section, f.rule.says),
        ],
        mark: if f.class.is_good() { Mark::Plain } else { Mark::Wrong },
        search: verdict.failures.iter().any(|x| x.evidence.shows(&f.name)).then(|| f.name.clone()),
        ..Row::default()
    };
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
    let rows = stand.findings.iter().map(row).collect();
    let findings =
        Table::new("What was judged, and by which rule of the specification", columns, rows);
    let sections = sections(&stand.findings).into_iter();
    let rules = sections.map(|(section, names)| format!("{section} ({})", names.join(", ")));
    let rules = Table::of_notes("Rules of the specification", rules.collect());
    let findings = findings.noted(notes).judged();
    // A terminal has the rules below.
    let mut short = findings.clone();
    short.columns.pop();
    short.rows.iter_mut().for_each(|row| drop(row.cells.pop()));
    let mut about = format!("{}: {}", verdict.more.declared.name, device(&stand.about));
    if let Some(plant) = &stand.plant {
        about += &format!("\na fault is planted: {plant}");
    }
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
