//! `rasterproof digest`: everything the engines compute for a seed, hashed, to compare machines.

use super::page::{Shown, show};
use super::progress::Progress;
use super::{Status, Streams, exit};
use rasterproof_registry::digest::{self, DigestOptions, DigestRow};
use rasterproof_report::html::Report;
use rasterproof_report::json;
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::noun;

#[derive(clap::Args, Debug)]
pub struct DigestArguments {
    /// Decides every generated case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    seed: u64,
    /// Cases of each family, and random scenes
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = super::whole::<u64>(1..=1_000_000))]
    cases: u64,
    /// One engine only
    #[arg(long, value_name = "NAME", value_parser = clap::builder::PossibleValuesParser::new(digest::engines()))]
    engine: Option<String>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
}

/// Prints a hash for each engine and each thing that it computes, and one of all.
pub fn run(arguments: &DigestArguments, streams: &mut Streams<'_>) -> Status {
    let DigestArguments { seed, cases, engine, json: is_json } = arguments;
    let (options, engine) = (DigestOptions { seed: *seed, cases: *cases }, engine.as_deref());
    // How many cases there are is counted first, for the bar.
    let cases_in_all = digest::case_count(options, engine);
    let progress = Progress::new(streams.progress, "cases", Some(cases_in_all));
    let parts = digest::digest(options, engine, &|more| progress.done(more));
    drop(progress);
    // The order of the parts is fixed, so the hash of all does not depend on the threads.
    let total = digest::total(&parts);
    let row = |of: &DigestRow| Row::of(&[&of.engine, &of.what, &of.sha256]);
    let all = format!("seed {seed}, {cases} {}", noun(*cases, "case", "cases"));
    let all = Row::of(&[&all, &"", &total]);
    let rows = parts.iter().map(row).chain([all]).collect();
    let report = Report {
        tables: vec![Table::new("", "engine 19 | what 8 | SHA-256 64", rows)],
        data: json::digest(*seed, *cases, &parts, &total),
        ..Report::default()
    };
    show(report, Shown::All.or_json(*is_json), None, exit::AGREES, streams)
}
