//! `rasterproof playground`: writes the page around the compiled engines.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, Streams, exit, usage, write_file};
use crate::page::page;

pub(super) const HELP: &str =
    "The page is one file that loads nothing: open it in a browser. The engines inside
are compiled by a script of the repository, playground/build, which needs a network
or Debian's packages; nothing else needs it.";

/// Options of `playground`.
#[derive(Args, Debug)]
pub(super) struct PlaygroundArguments {
    /// The compiled engines, as playground/build leaves them
    #[arg(long, value_name = "FILE", default_value = "target/rasterproof/playground.wasm")]
    module: PathBuf,
    /// Where the page goes
    #[arg(short, long, value_name = "FILE", default_value = "target/rasterproof/playground.html")]
    output: PathBuf,
}

pub(super) fn run(
    arguments: &PlaygroundArguments,
    streams: &mut Streams<'_>,
) -> Result<u8, Failure> {
    let module = &arguments.module;
    let bytes = std::fs::read(module).map_err(|error| {
        usage(format!(
            "cannot read {}: {error}\nThe engines are compiled for the page first: playground/build",
            module.display()
        ))
    })?;
    let page = page(&bytes).map_err(|problem| {
        usage(format!(
            "{} {problem}\nCompile the engines for the page: playground/build",
            module.display()
        ))
    })?;
    write_file(&arguments.output, page.as_bytes())?;
    writeln!(streams.output, "playground: {}", arguments.output.display())?;
    Ok(exit::AGREES)
}
