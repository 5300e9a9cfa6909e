//! `rasterproof specimens`: how often each published fault shows, and a contact sheet of them.

use std::path::PathBuf;

use indicatif::ProgressBar;

use super::{Failure, Streams, exit, write_file};
use crate::report::{json, picture, sheet, specimens};
use crate::specimen::catalogue::{CARDS, Card};
use crate::verify::specimens::survey;

/// Options of `specimens`.
#[derive(clap::Args, Debug)]
pub struct SpecimensArguments {
    /// Cases of each family
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u64).range(1..))]
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
    /// Where the contact sheet goes: published, repaired, difference for each specimen
    #[arg(short, long, value_name = "FILE", default_value = "target/rasterproof/specimens.png")]
    output: PathBuf,
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
    write_file(&arguments.output, &picture::png(&drawn))?;
    if arguments.json {
        write!(out, "{}", json::specimens(arguments.seed, arguments.cases, &reports))?;
    } else {
        writeln!(out, "{text}\ndrawn in {}", arguments.output.display())?;
    }
    let all_caught = reports.iter().all(|r| r.case_wrong > 0 && r.harmless_wrong == 0);
    Ok(if all_caught { exit::AGREES } else { exit::DISAGREES })
}
