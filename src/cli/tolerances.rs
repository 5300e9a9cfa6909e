//! `rasterproof tolerances`: what the acceptance rules of test suites let through.
//!
//! A rule compares a picture with the right one and accepts or refuses it. A good rule refuses the pictures of faults and
//! accepts those of right rasterizers, also of those with another permitted convention. Each is shown on two sets of scenes.

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
    // Random scenes and hard cases are drawn by all faults and all right rasterizers, then judged by all rules.
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

/// One of the sets of scenes on which the rules are judged.
struct SceneSet<'a> {
    title: &'static str,
    /// What came of each rule, in the order of [`RULES`].
    rows: &'a [Row],
    scenes: usize,
    /// Faults that change at least one of its pictures.
    visible: usize,
}

fn sets(report: &Acceptance) -> [SceneSet<'_>; 2] {
    let ([scenes, hard_scenes], [visible, hard_visible]) = (report.scenes, report.visible);
    let title = "scenes such as test suites draw";
    let suites = SceneSet { title, rows: &report.suites, scenes, visible };
    let (title, scenes, visible) = ("hard cases of this project", hard_scenes, hard_visible);
    [suites, SceneSet { title, rows: &report.hard, scenes, visible }]
}

/// How many faults and how many right rasterizers each rule refuses.
fn table_of_caught(set: &SceneSet<'_>, faults: usize, right: usize) -> Table {
    let mut rows = Vec::new();
    for (rule, row) in RULES.iter().zip(set.rows) {
        let caught = format!("{}/{faults}", row.caught.len());
        let wrong = format!("{}/{}", row.refused_pictures, row.wrong_pictures);
        let refused = format!("{}/{right}", row.refused_right.len());
        let pictures = format!("{}/{}", row.refused_right_pictures, row.right_pictures);
        let unused = &row.unusable_pictures;
        rows.push(Cells::of(&[&rule.name, &caught, &wrong, &refused, &pictures, unused]));
    }
    let columns = "rule 15 | >caught 8 faults that it refuses in at least one picture | >wrong refused 8 of the pictures \
                   that a fault changes | >right refused 8 right rasterizers that it refuses in at least one picture | \
                   >pictures 8 of right rasterizers, that it refuses | >unused 8 pictures on which it is not used, \
                   since it refuses the right one";
    let SceneSet { title, scenes, visible, .. } = set;
    let caption = format!("{title}: {scenes} pictures, {visible} faults change at least one");
    Table::new(&caption, columns, rows)
}

/// Which faults each rule lets through: the one that changes the fewest pixels, the one that changes the most, and a picture of it.
fn table_of_passes(set: &SceneSet<'_>) -> Table {
    let mut rows = Vec::new();
    for (rule, row) in RULES.iter().zip(set.rows) {
        let Some((smallest, worst)) = row.smallest().zip(row.most_harmful()) else {
            rows.push(Cells::of(&[&rule.name, &"no fault that changes a pixel"]));
            continue;
        };
        let smallest = wrong_of(smallest.name, smallest.wrong_pixels, smallest.pixels);
        let share = 100.0 * worst.wrong_pixels as f64 / worst.pixels as f64;
        let worst = wrong_of(worst.name, worst.wrong_pixels, worst.pixels);
        let mut picture = String::new();
        if let Some(one) = &row.worst_picture {
            picture = wrong_of(one.name, one.wrong_pixels, one.pixels) + ": " + &one.scene;
        }
        rows.push(Cells::of(&[&rule.name, &smallest, &format!("{worst} ({share:.2}%)"), &picture]));
    }
    let columns = "~rule 15 | :smallest | :most harmful | :one picture";
    Table::new(&format!("What passes, on {}", set.title), columns, rows)
}

/// A fault with the pixels that it changes.
fn wrong_of(name: &str, wrong: u64, all: u64) -> String {
    format!("{name}, {wrong} of {all} px")
}

/// The page: what each rule catches, what it lets through, and what it says.
fn page(seed: u64, report: &Acceptance) -> Page {
    let (faults, right) = (report.faults.len(), report.right.len());
    let sets = sets(report);
    let mut tables: Vec<_> = sets.iter().map(|set| table_of_caught(set, faults, right)).collect();
    tables.extend(sets.iter().map(table_of_passes));
    let rules = RULES.iter().map(|rule| Cells::of(&[&rule.name, &rule.about])).collect();
    tables.push(Table::new("The rules", "rule 15 | accepts 1", rules));
    Page {
        about: format!(
            "{faults} faults and {right} right rasterizers with another permitted convention, seed {seed}"
        ),
        answers: vec![Statement {
            about: "rules",
            sentence: sentence(report),
            command: String::new(),
        }],
        tables,
        data: json::value(&Data { seed, rules: &RULES, found: report }),
        ..Page::default()
    }
}

/// What the rules come to: what the best of them lets through that refuses no right rasterizer.
fn sentence(report: &Acceptance) -> String {
    let (faults, all) = (report.faults.len(), RULES.len());
    let mut fair = 0;
    // The rule, and the faults that it catches in either set.
    let mut best: Option<(&Rule, [usize; 2])> = None;
    for ((suites, hard), rule) in report.suites.iter().zip(&report.hard).zip(&RULES) {
        if !suites.refused_right.is_empty() || !hard.refused_right.is_empty() {
            continue;
        }
        fair += 1;
        let caught = [suites.caught.len(), hard.caught.len()];
        // Of several that catch as many, the last is named.
        if best.is_none_or(|(_, before)| before.iter().sum::<usize>() <= caught.iter().sum()) {
            best = Some((rule, caught));
        }
    }
    let Some((rule, [in_suites, in_hard])) = best else {
        return format!("Each of the {all} rules refuses a right rasterizer.");
    };
    format!(
        "{fair} of {all} rules refuse no right rasterizer. Of these, {} catches the most: {in_suites} of {faults} faults in \
         scenes such as test suites draw, and {in_hard} in hard cases of this project.",
        rule.name
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
    let mut rows = Vec::new();
    for ((suites, hard), rule) in report.suites.iter().zip(&report.hard).zip(&RULES) {
        // A share of rasterizers that is refused in either set, so the longer of the two bars.
        let refused = suites.refused_right.len().max(hard.refused_right.len());
        let bars = vec![
            bar(BLUE, suites.caught.len(), faults),
            bar(GREEN, hard.caught.len(), faults),
            bar(RED, refused, right),
        ];
        rows.push((rule.name, bars));
    }
    let title = "What acceptance rules catch, and which right rasterizers they refuse";
    cost_plots::bars(title, &legend.each_ref().map(|(ink, words)| (*ink, &**words)), &rows, 800.0)
}

/// A bar as long as its part of a whole, with the part as a number beside it.
fn bar(ink: Ink, part: usize, whole: usize) -> (f64, Ink, String) {
    (part as f64 / whole as f64, ink, part.to_string())
}
