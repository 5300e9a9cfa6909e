//! `rasterproof playground`: writes the page around the compiled engines.

use std::path::PathBuf;

use clap::Args;

use rasterproof_host::text::printable_path;
use rasterproof_host::{input, limits};

use super::files::{Use, distinct};
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
    distinct(&[("--module", module, Use::Reads), ("--output", &arguments.output, Use::Writes)])?;
    let refused =
        |why: String| usage(format!("{why}\nCompile the engines for the page: playground/build"));
    let bytes = input::read(module, limits::SOURCE_BYTES).map_err(|e| refused(e.to_string()))?;
    let page =
        page(&bytes).map_err(|problem| refused(format!("{} {problem}", printable_path(module))))?;
    write_file(&arguments.output, page.as_bytes())?;
    writeln!(streams.output, "playground: {}", printable_path(&arguments.output))?;
    Ok(exit::AGREES)
}
