//! `rasterproof tolerances`: what the acceptance rules of test suites let through.

use std::path::{Path, PathBuf};

use rasterproof_invariants::acceptance::rules::RULES;
use rasterproof_invariants::acceptance::{Report, Row, report};
use rasterproof_report::canvas::{self, Drawing, GRID, INK, Ink, SOFT};

use super::files::Output;
use super::progress::Progress;
use super::{Status, Streams, exit, usage};

#[derive(clap::Args, Debug)]
pub struct TolerancesArguments {
    /// Decides the random scenes and the hard cases
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::parse_number, allow_negative_numbers = true)]
    seed: u64,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Draw the shares of caught faults into this file, as SVG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

/// Judges pictures by every rule. That a rule errs is the result, so the exit status is 0.
pub fn run(arguments: &TolerancesArguments, streams: &mut Streams<'_>) -> Status {
    if let Some(path) = &arguments.plot
        && !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg"))
    {
        return Err(usage("the plot is an SVG: end the name of --plot with .svg"));
    }
    let progress = Progress::new(streams.progress, "scenes", None);
    let report = report(arguments.seed, &|| progress.done(1));
    drop(progress);
    if let Some(path) = &arguments.plot {
        super::write_file(&Output::typed(path), canvas::svg(&plot(&report)).as_bytes())?;
    }
    if arguments.json {
        writeln!(streams.output, "{}", json(arguments.seed, &report))?;
    } else {
        write!(streams.output, "{}", text(arguments.seed, &report))?;
        if let Some(path) = &arguments.plot {
            writeln!(streams.output, "drawn in {}", shown(path))?;
        }
    }
    Ok(exit::AGREES)
}

fn shown(path: &Path) -> String {
    rasterproof_host::text::printable_path(path)
}

/// Both sets of scenes, with what they are called.
fn sets(report: &Report) -> [(&'static str, &[Row], usize, usize); 2] {
    [
        ("scenes such as test suites draw", &report.suites, report.scenes[0], report.visible[0]),
        ("hard cases of this project", &report.hard, report.scenes[1], report.visible[1]),
    ]
}

fn text(seed: u64, report: &Report) -> String {
    let (faults, right) = (report.faults.len(), report.right.len());
    let mut out = format!(
        "{faults} faults and {right} right rasterizers with another permitted convention, seed {seed}\n"
    );
    for (title, rows, scenes, visible) in sets(report) {
        out += &format!(
            "\n{title}: {scenes} pictures, {visible} faults change at least one\n\
             rule             faults   wrong pictures   right ones   right pictures   not\n\
             \u{20}                caught   refused          refused      refused          used\n"
        );
        for (rule, row) in RULES.iter().zip(rows) {
            out += &format!(
                "{:<15}  {:>2}/{faults}    {:<15}  {:<11}  {:<15}  {}\n",
                rule.name,
                row.caught.len(),
                format!("{}/{}", row.refused_pictures, row.wrong_pictures),
                format!("{}/{right}", row.refused_right.len()),
                format!("{}/{}", row.refused_right_pictures, row.right_pictures),
                row.unusable_pictures,
            );
        }
    }
    for (title, rows, ..) in sets(report) {
        out += &format!("\nwhat passes, on {title}:\n");
        for (rule, row) in RULES.iter().zip(rows) {
            let Some((smallest, worst)) = row.smallest().zip(row.most_harmful()) else {
                out += &format!("{}: no fault that changes a pixel\n", rule.name);
                continue;
            };
            out += &format!(
                "{}:\n  smallest      {}, {} of {} px\n  most harmful  {}, {} of {} px ({})\n",
                rule.name,
                smallest.name,
                smallest.wrong_pixels,
                smallest.pixels,
                worst.name,
                worst.wrong_pixels,
                worst.pixels,
                percent(worst.wrong_pixels, worst.pixels),
            );
            if let Some(picture) = &row.worst_picture {
                out += &format!(
                    "  one picture   {}, {} of {} px: {}\n",
                    picture.name, picture.wrong_pixels, picture.pixels, picture.scene
                );
            }
        }
    }
    out += "\nthe rules:\n";
    for rule in &RULES {
        out += &format!("{:<15}  {}\n", rule.name, rule.about);
    }
    out
}

fn percent(part: u64, whole: u64) -> String {
    format!("{:.2}%", 100.0 * part as f64 / whole as f64)
}

fn json(seed: u64, report: &Report) -> serde_json::Value {
    let fault = |fault: &rasterproof_invariants::acceptance::Passed| {
        serde_json::json!({
            "fault": fault.name, "wrong_pixels": fault.wrong_pixels, "pixels": fault.pixels,
        })
    };
    let of_sets = sets(report).map(|(title, rows, scenes, visible)| {
        let rows: Vec<serde_json::Value> = RULES
            .iter()
            .zip(rows)
            .map(|(rule, row)| {
                let picture = row.worst_picture.as_ref().map(|picture| {
                    serde_json::json!({
                        "fault": picture.name, "scene": picture.scene,
                        "wrong_pixels": picture.wrong_pixels, "pixels": picture.pixels,
                    })
                });
                serde_json::json!({
                    "rule": rule.name,
                    "caught": row.caught,
                    "passed": row.passed.iter().map(fault).collect::<Vec<_>>(),
                    "wrong_pictures": row.wrong_pictures,
                    "refused_pictures": row.refused_pictures,
                    "smallest_that_passes": row.smallest().map(fault),
                    "most_harmful_that_passes": row.most_harmful().map(fault),
                    "worst_accepted_picture": picture,
                    "unusable_pictures": row.unusable_pictures,
                    "refused_right": row.refused_right,
                    "right_pictures": row.right_pictures,
                    "refused_right_pictures": row.refused_right_pictures,
                })
            })
            .collect();
        serde_json::json!({
            "scenes": title, "pictures": scenes, "visible_faults": visible, "rules": rows,
        })
    });
    let rules: Vec<serde_json::Value> = RULES
        .iter()
        .map(|rule| serde_json::json!({"rule": rule.name, "accepts": rule.about, "source": rule.source}))
        .collect();
    serde_json::json!({
        "seed": seed, "faults": report.faults, "right": report.right, "rules": rules, "sets": of_sets,
    })
}

const CAUGHT: Ink = [31, 84, 170];
const HARD: Ink = [20, 110, 50];
const REFUSED: Ink = [205, 30, 30];

/// For each rule the share of faults that it catches, on either set, and the share of right rasterizers that it refuses.
fn plot(report: &Report) -> Drawing {
    const LEFT: f64 = 150.0;
    const RIGHT: f64 = 770.0;
    const TOP: f64 = 92.0;
    const ROW: f64 = 34.0;
    let bottom = TOP + ROW * RULES.len() as f64;
    let title = "What acceptance rules catch, and which right rasterizers they refuse";
    let mut drawing = Drawing::new(title, [800.0, bottom + 40.0]);
    drawing.text([12.0, 18.0], title, INK);
    let (faults, right) = (report.faults.len(), report.right.len());
    let legend = [
        (CAUGHT, format!("caught of {faults} faults, scenes such as test suites draw")),
        (HARD, format!("caught of {faults} faults, hard cases of this project")),
        (REFUSED, format!("refused of {right} right rasterizers, in either set")),
    ];
    for (i, (ink, words)) in legend.iter().enumerate() {
        let y = 38.0 + 16.0 * i as f64;
        drawing.filled_box([14.0, y - 4.0], [18.0, 8.0], *ink);
        drawing.text([40.0, y], words, SOFT);
    }
    let x = |share: f64| LEFT + (RIGHT - LEFT) * share;
    for quarter in 0..=4 {
        let share = f64::from(quarter) / 4.0;
        drawing.line([x(share), TOP], [x(share), bottom], GRID);
        let label = format!("{}%", 25 * quarter);
        drawing.text_about([x(share), bottom + 16.0], &label, SOFT);
    }
    for (i, rule) in RULES.iter().enumerate() {
        let y = TOP + ROW * i as f64 + 6.0;
        drawing.text_before([LEFT - 8.0, y + 10.0], rule.name, INK);
        let refused = |row: &Row| row.refused_right.len();
        let bars = [
            (CAUGHT, report.suites[i].caught.len(), faults),
            (HARD, report.hard[i].caught.len(), faults),
            (REFUSED, refused(&report.suites[i]).max(refused(&report.hard[i])), right),
        ];
        for (bar, (ink, part, whole)) in bars.into_iter().enumerate() {
            let size = [(RIGHT - LEFT) * part as f64 / whole as f64, 6.0];
            if part > 0 {
                drawing.filled_box([LEFT, y + 8.0 * bar as f64], size, ink);
            }
        }
    }
    drawing
}
