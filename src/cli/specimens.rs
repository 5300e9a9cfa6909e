//! `rasterproof specimens`: how often each published fault shows, and a contact sheet of them.

use std::path::PathBuf;

use super::files::{self, Output, written};
use super::page::{PageArguments, Shown, as_file, show};
use super::progress::Progress;
use super::typed::Typed;
use super::{Status, Streams, ends_in, exit, write_picture};
use rasterproof_faults::published::catalogue::{CARDS, Card};
use rasterproof_registry::published_check::{SpecimenReport, survey};
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::{json, page_cases, picture, specimen_sheet, specimens};

#[derive(clap::Args, Debug)]
pub struct SpecimensArguments {
    /// Cases of each family
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = super::whole::<u64>(1..=u64::MAX), allow_hyphen_values = true)]
    cases: u64,
    /// Decides every generated case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    seed: u64,
    /// Only this one, with every family; its strip instead of the contact sheet
    #[arg(long, value_name = "NAME", value_parser = clap::builder::PossibleValuesParser::new(CARDS.iter().map(|card| card.name)))]
    specimen: Option<String>,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    page: PageArguments,
    /// Where the contact sheet goes: published, repaired, difference for each specimen [default:
    /// specimens.png in the folder of --out]
    #[arg(short, long, value_name = "FILE.png")]
    output: Option<PathBuf>,
}

/// Surveys, prints and draws. A specimen that its case does not expose is a disagreement.
pub fn run(arguments: &SpecimensArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let page = arguments.page.page("specimens.html");
    let sheet = arguments.output.as_deref().map(Output::typed);
    let sheet_file = sheet.as_ref().map(|sheet| written("--output", sheet));
    files::check(sheet_file.into_iter().chain(as_file(&page)))?;
    if let Some(path) = &arguments.output {
        ends_in(path, "png", "the picture")?;
    }
    let cards: Vec<&Card> = CARDS
        .iter()
        .filter(|card| arguments.specimen.as_deref().is_none_or(|name| name == card.name))
        .collect();
    let progress = Progress::new(streams.progress, "specimens", Some(cards.len() as u64));
    let reports: Vec<_> = cards
        .iter()
        .map(|card| survey(card, arguments.seed, arguments.cases))
        .inspect(|_| progress.done(1))
        .collect();
    drop(progress);
    let drawn = match cards.as_slice() {
        [card] => specimen_sheet::alone(card),
        _ => specimen_sheet::contact_sheet(),
    };
    let (png, unasked) = (picture::png(&drawn), arguments.page.place.output("specimens.png"));
    let place = match &sheet {
        Some(sheet) if arguments.json => {
            streams.save(sheet, &png);
            None
        }
        None if arguments.json => None,
        asked => write_picture(asked.as_ref(), &unasked, &png, streams)?,
    };
    let mut report = report(arguments, typed, &reports, page.is_some());
    report.notes.extend(place);
    let status = exit::of(are_caught(&reports));
    show(report, Shown::All.or_json(arguments.json), page, status, streams)
}

/// Each is wrong on the case that exposes it, and right on its harmless one.
fn are_caught(reports: &[SpecimenReport]) -> bool {
    reports.iter().all(|r| r.case_wrong > 0 && r.harmless_wrong == 0)
}

/// How often each is wrong; on a page also the exposing cases and the pictures.
fn report(
    arguments: &SpecimensArguments,
    typed: &Typed,
    reports: &[SpecimenReport],
    is_page: bool,
) -> Report {
    let good = are_caught(reports);
    let sentence = if good {
        format!("Each of {} published faults is exposed by its case.", reports.len())
    } else {
        "A published fault is not exposed by its case, or shows in its harmless one.".to_owned()
    };
    let word = if good { "CAUGHT" } else { "NOT CAUGHT" };
    let is_asked = |name: &str| reports.iter().any(|r| r.name == name.trim_end_matches(" picture"));
    let mut cases = if is_page { page_cases::of_specimens() } else { Vec::new() };
    cases.retain(|case| is_asked(&case.name));
    let taken: Vec<_> = cases.iter().map(|case| case.name.clone()).collect();
    let mut frames = if is_page { specimen_sheet::views(&taken) } else { Vec::new() };
    frames.retain(|view| is_asked(&view.name));
    Report {
        title: "Published algorithms and their faults".to_owned(),
        outcome: Some(Outcome::new(good, word, sentence)),
        command: {
            let typed = typed.clone().first("cases", arguments.cases);
            typed.first("seed", arguments.seed).line()
        },
        tables: specimens::tables(reports),
        data: json::specimens(arguments.seed, arguments.cases, reports),
        cases,
        frames,
        ..Report::default()
    }
}
