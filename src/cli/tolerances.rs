//! `rasterproof tolerances`: what the acceptance rules of test suites let through.

use std::path::PathBuf;

use rasterproof_host::output::Output;
use rasterproof_host::text::printable_path;
use rasterproof_invariants::acceptance::rules::{RULES, Rule};
use rasterproof_invariants::acceptance::{Acceptance, Row, report};
use rasterproof_report::canvas::{self, BLUE, Drawing, GREEN, Ink, RED};
use rasterproof_report::html::{Report as Page, Statement};
use rasterproof_report::json;
use rasterproof_report::table::{Row as Cells, Table};
use rasterproof_study::report::cost_plots;

use super::page::{Shown, show};
use super::progress::Progress;
use super::{Status, Streams, ends_in, exit};

#[derive(clap::Args, Debug)]
pub struct TolerancesArguments {
    /// Decides the random scenes and the hard cases
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
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
    if let Some(path) = &arguments.plot {
        ends_in(path, "svg", "the plot")?;
    }
    let progress = Progress::new(streams.progress, "scenes", None);
    let report = report(arguments.seed, &|| progress.done(1));
    drop(progress);
    if let Some(path) = &arguments.plot {
        super::write_file(&Output::typed(path), canvas::svg(&plot(&report)).as_bytes())?;
    }
    let mut page = page(arguments.seed, &report);
    let plot = arguments.plot.as_deref().map(|path| format!("drawn in {}", printable_path(path)));
    page.notes.extend(plot);
    show(page, Shown::All.or_json(arguments.json), None, exit::AGREES, streams)
}

/// Both sets of scenes, with what they are called.
fn sets(report: &Acceptance) -> [(&'static str, &[Row], usize, usize); 2] {
    [
        ("scenes such as test suites draw", &report.suites, report.scenes[0], report.visible[0]),
        ("hard cases of this project", &report.hard, report.scenes[1], report.visible[1]),
    ]
}

fn page(seed: u64, report: &Acceptance) -> Page {
    let (faults, right) = (report.faults.len(), report.right.len());
    let caught = sets(report).map(|(title, rows, scenes, visible)| {
        let row = |(rule, row): (&Rule, &Row)| {
            let caught = format!("{}/{faults}", row.caught.len());
            let wrong = format!("{}/{}", row.refused_pictures, row.wrong_pictures);
            let refused = format!("{}/{right}", row.refused_right.len());
            let pictures = format!("{}/{}", row.refused_right_pictures, row.right_pictures);
            let unused = &row.unusable_pictures;
            Cells::of(&[&rule.name, &caught, &wrong, &refused, &pictures, unused])
        };
        let columns = "rule 15 | >caught 8 faults that it refuses in at least one picture | >wrong refused 8 of the pictures \
                       that a fault changes | >right refused 8 right rasterizers that it refuses in at least one picture | \
                       >pictures 8 of right rasterizers, that it refuses | >unused 8 pictures on which it is not used, \
                       since it refuses the right one";
        let caption = format!("{title}: {scenes} pictures, {visible} faults change at least one");
        Table::new(&caption, columns, RULES.iter().zip(rows).map(row).collect())
    });
    let passes = sets(report).map(|(title, rows, ..)| {
        let row = |(rule, row): (&Rule, &Row)| {
            let Some((smallest, worst)) = row.smallest().zip(row.most_harmful()) else {
                return Cells::of(&[&rule.name, &"no fault that changes a pixel"]);
            };
            let of = |name: &str, wrong: u64, all: u64| format!("{name}, {wrong} of {all} px");
            let share = 100.0 * worst.wrong_pixels as f64 / worst.pixels as f64;
            let picture = row.worst_picture.as_ref().map_or(String::new(), |one| {
                let what = of(one.name, one.wrong_pixels, one.pixels);
                format!("{what}: {}", one.scene)
            });
            let [smallest, worst] =
                [smallest, worst].map(|one| of(one.name, one.wrong_pixels, one.pixels));
            Cells::of(&[&rule.name, &smallest, &format!("{worst} ({share:.2}%)"), &picture])
        };
        let columns = "~rule 15 | :smallest | :most harmful | :one picture";
        let rows = RULES.iter().zip(rows).map(row).collect();
        Table::new(&format!("What passes, on {title}"), columns, rows)
    });
    let rule = |rule: &Rule| Cells::of(&[&rule.name, &rule.about]);
    let rules = Table::new("The rules", "rule 15 | accepts 1", RULES.iter().map(rule).collect());
    Page {
        about: format!(
            "{faults} faults and {right} right rasterizers with another permitted convention, seed {seed}"
        ),
        answers: vec![Statement {
            about: "rules",
            sentence: sentence(report),
            command: String::new(),
        }],
        tables: caught.into_iter().chain(passes).chain([rules]).collect(),
        data: json::value(&Data { seed, rules: &RULES, found: report }),
        ..Page::default()
    }
}

/// What the rules come to: what the best of them lets through that refuses no right rasterizer.
fn sentence(report: &Acceptance) -> String {
    let faults = report.faults.len();
    let rows = report.suites.iter().zip(&report.hard).zip(&RULES);
    let rows: Vec<_> = rows.map(|((suites, hard), rule)| (suites, hard, rule)).collect();
    let is_fair =
        |suites: &Row, hard: &Row| suites.refused_right.is_empty() && hard.refused_right.is_empty();
    let fair = rows.iter().filter(|(suites, hard, _)| is_fair(suites, hard));
    let best = fair.clone().max_by_key(|(suites, hard, _)| suites.caught.len() + hard.caught.len());
    let count = fair.count();
    let Some((suites, hard, rule)) = best else {
        return format!("Each of the {} rules refuses a right rasterizer.", rows.len());
    };
    format!(
        "{count} of {} rules refuse no right rasterizer. Of these, {} catches the most: {} of {faults} faults in scenes such as \
         test suites draw, and {} in hard cases of this project.",
        rows.len(),
        rule.name,
        suites.caught.len(),
        hard.caught.len()
    )
}

#[derive(serde::Serialize)]
struct Data<'a> {
    seed: u64,
    rules: &'a [Rule],
    #[serde(flatten)]
    found: &'a Acceptance,
}

/// For each rule the share of faults that it catches, on either set, and the share of right rasterizers that it refuses.
fn plot(report: &Acceptance) -> Drawing {
    let (faults, right) = (report.faults.len(), report.right.len());
    let legend = [
        (BLUE, format!("caught of {faults} faults, scenes such as test suites draw")),
        (GREEN, format!("caught of {faults} faults, hard cases of this project")),
        (RED, format!("refused of {right} right rasterizers, in either set")),
    ];
    let bar = |(ink, part, whole): (Ink, usize, usize)| {
        (part as f64 / whole as f64, ink, part.to_string())
    };
    let row = |(rule, rows): (&Rule, [&Row; 2])| {
        let [suites, hard] = rows.map(|row| row.caught.len());
        let [in_suites, in_hard] = rows.map(|row| row.refused_right.len());
        let bars =
            [(BLUE, suites, faults), (GREEN, hard, faults), (RED, in_suites.max(in_hard), right)];
        (rule.name, bars.map(bar).to_vec())
    };
    let rows = report.suites.iter().zip(&report.hard).map(<[&Row; 2]>::from);
    let rows: Vec<_> = RULES.iter().zip(rows).map(row).collect();
    let title = "What acceptance rules catch, and which right rasterizers they refuse";
    cost_plots::bars(title, &legend.each_ref().map(|(ink, words)| (*ink, &**words)), &rows, 800.0)
}
