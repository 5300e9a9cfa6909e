//! `rasterproof specimens`: how often each published fault shows, and a contact sheet of them.

use std::path::{Path, PathBuf};

use indicatif::ProgressBar;

use super::{Failure, PAGE, Streams, exit, png_name, write_file, write_page, write_unasked};
use crate::report::html::{Outcome, Report};
use crate::report::{cases, counts, json, picture, sheet, specimens};
use crate::specimen::catalogue::{CARDS, Card};
use crate::verify::specimens::{SpecimenReport, survey};

/// Options of `specimens`.
#[derive(clap::Args, Debug)]
pub struct SpecimensArguments {
    /// Cases of each family
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = super::parse_count, allow_hyphen_values = true)]
    cases: u64,
    /// Decides every generated case
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Only this one, with every family; its strip instead of the contact sheet
    #[arg(long, value_name = "NAME", value_parser = clap::builder::PossibleValuesParser::new(CARDS.iter().map(|card| card.name)))]
    specimen: Option<String>,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Write a page to look into the faults: target/rasterproof/index.html
    #[arg(long)]
    report: bool,
    /// Where the contact sheet goes: published, repaired, difference for each specimen
    /// [default: target/rasterproof/specimens.png]
    #[arg(short, long, value_name = "FILE.png")]
    output: Option<PathBuf>,
}

/// Surveys, prints and draws. A specimen that its case does not expose is a disagreement.
pub fn run(arguments: &SpecimensArguments, streams: &mut Streams<'_>) -> Result<u8, Failure> {
    let out = &mut *streams.output;
    let cards: Vec<&Card> = CARDS
        .iter()
        .filter(|card| arguments.specimen.as_deref().is_none_or(|name| name == card.name))
        .collect();
    let bar = match streams.progress {
        true => ProgressBar::new(cards.len() as u64),
        false => ProgressBar::hidden(),
    };
    let reports: Vec<_> = cards
        .iter()
        .map(|card| survey(card, arguments.seed, arguments.cases))
        .inspect(|_| bar.inc(1))
        .collect();
    bar.finish_and_clear();
    let (drawn, text) = match (cards.as_slice(), reports.as_slice()) {
        ([card], [report]) => (sheet::strip(card), specimens::detail(report)),
        _ => (sheet::contact_sheet(), specimens::table(&reports)),
    };
    if let Some(path) = &arguments.output {
        png_name(path)?;
        write_file(path, &picture::png(&drawn))?;
    }
    match (arguments.json, &arguments.output) {
        (true, _) => write!(out, "{}", json::specimens(arguments.seed, arguments.cases, &reports))?,
        (false, Some(path)) => writeln!(out, "{text}\ndrawn in {}", path.display())?,
        (false, None) => {
            writeln!(out, "{text}")?;
            let path = Path::new("target/rasterproof/specimens.png");
            write_unasked(path, &picture::png(&drawn), streams)?;
        }
    }
    if arguments.report {
        write_page(Path::new(PAGE), &report_page(arguments, &reports), streams.errors)?;
    }
    Ok(if are_caught(&reports) { exit::AGREES } else { exit::DISAGREES })
}

/// Each is wrong on the case that exposes it, and right on its harmless one.
fn are_caught(reports: &[SpecimenReport]) -> bool {
    reports.iter().all(|r| r.case_wrong > 0 && r.harmless_wrong == 0)
}

/// The survey as a page: how often each is wrong, the exposing cases, the pictures.
fn report_page(arguments: &SpecimensArguments, reports: &[SpecimenReport]) -> Report {
    let good = are_caught(reports);
    let sentence = if good {
        format!("Each of {} published faults is exposed by its case.", reports.len())
    } else {
        "A published fault is not exposed by its case, or shows in its harmless one.".to_owned()
    };
    let word = if good { "CAUGHT" } else { "NOT CAUGHT" };
    Report {
        title: "Published algorithms and their faults".to_owned(),
        outcome: Some(Outcome { good, word: word.to_owned(), sentence }),
        command: format!(
            "rasterproof specimens --seed {} --cases {} --report",
            arguments.seed, arguments.cases
        ),
        seed: Some(arguments.seed),
        tables: vec![counts::of_specimens(reports)],
        cases: cases::of_specimens(),
        frames: sheet::views(),
        ..Report::default()
    }
}
