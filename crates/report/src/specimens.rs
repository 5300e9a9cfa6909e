//! The survey of the specimens as text: a summary of all, or all families of one.

use std::fmt::Write as _;

use rasterproof_registry::published_check::{Counts, SpecimenReport};

const UNITS: &str = "\
differ: percent of the triangles or lines with a wrong pixel or value; extra, missing, twice: wrong
pixels per million covered, each triangle for itself; value, depth: worst error as a fraction of the
corner values' spread; shared: as twice, but pixels that two triangles of a mesh draw
";

/// The survey: a block for each specimen with its sums and its worst family, then coverage by family
/// in percent; at most 100 columns.
pub fn table(reports: &[SpecimenReport]) -> String {
    let mut out = String::from(UNITS);
    let _ = writeln!(out, "{:<17}{} worst family", "specimen", heads());
    for r in reports {
        let worst = r.families.iter().max_by(|(_, a), (_, b)| {
            let rank = |c: &Counts| (c.percent(), c.per_million(c.tally.total()));
            rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal)
        });
        let worst = worst.map_or(String::new(), |(name, c)| format!("{name} {:.0}%", c.percent()));
        let _ = writeln!(out, "{}", format!("{:<17}{} {worst}", r.name, cells(&r.all)).trim_end());
        let _ = writeln!(out, "  {}: {}", r.source, r.fault);
        let _ = writeln!(out, "  cure: {}", r.cure);
        let _ = writeln!(out, "  shown by: {}: {} pixels", r.case, r.case_wrong);
    }
    for lines in [false, true] {
        let columns: Vec<_> = reports
            .iter()
            .filter(|r| {
                r.families.first().is_some_and(|(name, _)| name.starts_with("line") == lines)
            })
            .collect();
        by_family(&mut out, &columns, if lines { "lines" } else { "triangles" });
    }
    out
}

/// One specimen: its card, every family, every recorded input.
pub fn detail(report: &SpecimenReport) -> String {
    let r = report;
    let mut out = format!("{}: {}\n{}\ncure: {}\n", r.name, r.source, r.fault, r.cure);
    let _ = writeln!(
        out,
        "shown by: {}: {} pixels; harmless case: {} pixels\n",
        r.case, r.case_wrong, r.harmless_wrong
    );
    out.push_str(UNITS);
    if r.families.is_empty() {
        out.push_str("no rasterizer and no line drawer: its fault shows in its case alone\n");
        return out;
    }
    let head = |what: &str| format!("{what:<24}{} {:>6} {:>6}", heads(), "pixels", "values");
    let row = |name: &str, c: &Counts| {
        let [pixels, values] = [c.wrong_pixels, c.wrong_values].map(|n| c.percent_of(n));
        format!("{name:<24}{} {pixels:>5.1}% {values:>5.1}%", cells(c))
    };
    let _ = writeln!(out, "pixels, values: percent with a wrong pixel, with a wrong value");
    let _ = writeln!(out, "{}", head("family"));
    for (name, counts) in &r.families {
        let _ = writeln!(out, "{}", row(name, counts));
    }
    let _ = writeln!(out, "{}", row("all", &r.all));
    if !r.recorded.is_empty() {
        let _ = writeln!(out, "\nrecorded inputs of the book's code, wrong pixels:");
    }
    for (name, c) in &r.recorded {
        let tally = &c.tally;
        let what = match c.refused {
            0 => format!(
                "{} covered, {} extra, {} missing, {} twice",
                c.pixels, tally.extra, tally.missing, tally.twice
            ),
            _ => "refused: undefined in the published code, or without end".to_owned(),
        };
        let _ = writeln!(out, "{name:<24} {what}");
    }
    out
}

/// Heads of [`cells`].
fn heads() -> String {
    format!(
        "{:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7}",
        "differ", "extra", "missing", "twice", "value", "depth", "shared"
    )
}

/// Percent, pixels per million, worst errors; dashes where nothing was drawn.
fn cells(counts: &Counts) -> String {
    let drawn = counts.shapes > 0;
    let rate = |n: u64| match (drawn, counts.per_million(n)) {
        (false, _) | (_, None) => "-".to_owned(),
        (true, Some(rate)) if rate < 1e7 => format!("{rate:.0}"),
        (true, Some(rate)) => format!("{rate:.0e}"),
    };
    let error = |e: f64| match e {
        _ if !drawn => "-".to_owned(),
        0.0 => "0".to_owned(),
        e if e.is_infinite() => "inf".to_owned(),
        e if (0.01..100.0).contains(&e) => format!("{e:.2}"),
        e => format!("{e:.0e}"),
    };
    let percent = if drawn { format!("{:.1}%", counts.percent()) } else { "-".to_owned() };
    let tally = &counts.tally;
    format!(
        "{percent:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7}",
        rate(tally.extra),
        rate(tally.missing),
        rate(tally.twice),
        error(counts.worst_attribute),
        error(counts.worst_depth),
        rate(counts.shared)
    )
}

/// Percent of shapes with a wrong pixel, a row for each family, a letter for each specimen.
fn by_family(out: &mut String, columns: &[&SpecimenReport], shapes: &str) {
    let Some(first) = columns.first() else { return };
    let letter = |i: usize| char::from(b'A' + i as u8);
    let legend: Vec<_> =
        columns.iter().enumerate().map(|(i, r)| format!("{} {}", letter(i), r.name)).collect();
    let _ = writeln!(out, "\n{shapes} with a wrong pixel in percent, by family:");
    for names in legend.chunks(5) {
        let _ = writeln!(out, "  {}", names.join(", "));
    }
    let _ = write!(out, "{:<16}", "family");
    (0..columns.len()).for_each(|i| {
        let _ = write!(out, " {:>5}", letter(i));
    });
    out.push('\n');
    for (row, (family, _)) in first.families.iter().enumerate() {
        let _ = write!(out, "{family:<16}");
        for report in columns {
            let counts = &report.families[row].1;
            let _ = write!(out, " {:>5.1}", counts.percent_of(counts.wrong_pixels));
        }
        out.push('\n');
    }
}
