//! `rasterproof digest`: everything the engines compute for a seed, hashed, to compare machines.

use super::progress::Progress;
use super::{Status, Streams, exit};
use rasterproof_registry::digest::{self, DigestOptions};

#[derive(clap::Args, Debug)]
pub struct DigestArguments {
    /// Decides every generated case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::parse_number, allow_negative_numbers = true)]
    seed: u64,
    /// Cases of each family, and random scenes
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    cases: u64,
    /// One engine only
    #[arg(long, value_name = "NAME", value_parser = clap::builder::PossibleValuesParser::new(digest::engines()))]
    engine: Option<String>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &DigestArguments, streams: &mut Streams<'_>) -> Status {
    let DigestArguments { seed, cases, engine, json } = arguments;
    let (options, engine) = (DigestOptions { seed: *seed, cases: *cases }, engine.as_deref());
    let cases_in_all = digest::case_count(options, engine);
    let progress = Progress::new(streams.progress, "cases", Some(cases_in_all));
    let parts = digest::digest(options, engine, &|more| progress.done(more));
    drop(progress);
    let total = digest::total(&parts);
    if *json {
        let json = serde_json::json!({
            "seed": seed, "cases": cases, "parts": parts, "sha256": total,
        });
        writeln!(streams.output, "{json}")?;
        return Ok(exit::AGREES);
    }
    for part in &parts {
        writeln!(streams.output, "{:<19} {:<8} {}", part.engine, part.what, part.sha256)?;
    }
    let what = format!("seed {seed}, {cases} cases");
    writeln!(streams.output, "{what:<28} {total}")?;
    Ok(exit::AGREES)
}
