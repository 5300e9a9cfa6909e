//! `rasterproof specimens`: how often each published fault shows, and a contact sheet of them.

use std::path::PathBuf;

use super::{Failure, Streams, exit, write_file};
use crate::report::{json, picture, specimens};
use crate::specimen::catalogue::CARDS;
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
    let reports = survey(arguments.seed, arguments.cases);
    let sheets: Vec<_> = CARDS.iter().map(specimens::sheet).collect();
    write_file(&arguments.output, &picture::png(&picture::stack(&sheets)))?;
    if arguments.json {
        write!(out, "{}", json::specimens(arguments.seed, arguments.cases, &reports))?;
    } else {
        write!(out, "{}", specimens::table(&reports))?;
        writeln!(
            out,
            "\ncontact sheet, from the top in this order: {}",
            arguments.output.display()
        )?;
    }
    let all_caught = reports.iter().all(|r| r.case_wrong > 0 && r.harmless_wrong == 0);
    Ok(if all_caught { exit::AGREES } else { exit::DISAGREES })
}
