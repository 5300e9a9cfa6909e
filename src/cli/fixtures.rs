//! `rasterproof fixtures`: small hard cases with their pixels, for the test suites of other projects.

use super::progress::Progress;
use super::{Status, Streams, exit};
use rasterproof_registry::fixtures::{QUOTAS, generate};

#[derive(clap::Args, Debug)]
pub struct FixturesArguments {
    /// Decides every case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    seed: u64,
}

/// Prints the cases. How many of each kind there are is fixed, so that two seeds give suites of one size.
pub fn run(arguments: &FixturesArguments, streams: &mut Streams<'_>) -> Status {
    let total = QUOTAS.iter().map(|(_, quota)| *quota as u64).sum();
    let progress = Progress::new(streams.progress, "cases", Some(total));
    let fixtures = generate(arguments.seed, &|more| progress.done(more));
    drop(progress);
    streams.output.write_all(fixtures.to_json().as_bytes())?;
    Ok(exit::AGREES)
}
