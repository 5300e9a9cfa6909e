//! `rasterproof specimens`: how often each published fault shows, and a contact sheet of them.
//!
//! Each published algorithm is drawn beside its repaired form. One that no case of its own exposes is no proof of a fault, and counts
//! as a disagreement.

use rasterproof_host::output::{self, Output};
use std::path::PathBuf;

use super::page::{PageArguments, Shown, as_file, show};
use super::progress::Progress;
use super::typed::Typed;
use super::{Status, Streams, ends_in, exit, write_picture};
use rasterproof_faults::published::catalogue::{CARDS, Card};
use rasterproof_registry::published_check::survey;
use rasterproof_report::picture;
use rasterproof_teaching::specimens::{self, sheet};

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
    let sheet_file = sheet.as_ref().map(|sheet| sheet.named("--output"));
    output::check_all(sheet_file.into_iter().chain(as_file(&page)))?;
    if let Some(path) = &arguments.output {
        ends_in(path, "png", "the picture")?;
    }
    let cards: Vec<&Card> = CARDS
        .iter()
        .filter(|card| arguments.specimen.as_deref().is_none_or(|name| name == card.name))
        .collect();
    // Every algorithm is judged on all families, which takes the most time.
    let progress = Progress::new(streams.progress, "specimens", Some(cards.len() as u64));
    let reports: Vec<_> = cards
        .iter()
        .map(|card| survey(card, arguments.seed, arguments.cases))
        .inspect(|_| progress.done(1))
        .collect();
    drop(progress);
    // One algorithm alone has a strip with each of its pixels; of all there is room for a small picture of each.
    let drawn = match cards.as_slice() {
        [card] => sheet::alone(card),
        _ => sheet::contact_sheet(),
    };
    let (png, unasked) = (picture::png(&drawn), arguments.page.place.output("specimens.png"));
    // Whoever asks for JSON gets a picture only where a name is typed for it.
    let place = match &sheet {
        Some(sheet) if arguments.json => {
            streams.save(sheet, &png);
            None
        }
        None if arguments.json => None,
        asked => write_picture(asked.as_ref(), &unasked, &png, streams)?,
    };
    let typed = typed.clone().first("cases", arguments.cases).first("seed", arguments.seed);
    let mut report = specimens::report(arguments.seed, arguments.cases, &reports, page.is_some());
    report.command = typed.line();
    report.notes.extend(place);
    let status = exit::of(specimens::are_caught(&reports));
    show(report, Shown::All.or_json(arguments.json), page, status, streams)
}
