//! `rasterproof playground` and `rasterproof your-gpu`: write a page around the compiled engines.

use std::path::{Path, PathBuf};

use clap::Args;

use rasterproof_host::output::{self, Output, Over, Use};
use rasterproof_host::text::printable_path;
use rasterproof_host::{input, limits};

use super::{Status, Streams, exit, usage, write_file};
use rasterproof_playground::{Parts, page};

pub(super) const HELP: &str =
    "The page is one file that loads nothing: open it in a browser. The engines inside
are compiled by a script of the repository, crates/playground/build, which needs a network
or Debian's packages; nothing else needs it.";

#[derive(Args, Debug)]
pub(super) struct PlaygroundArguments {
    /// The compiled engines, as crates/playground/build leaves them
    #[arg(long, value_name = "FILE", default_value = "target/rasterproof/playground.wasm")]
    module: PathBuf,
    /// Where the page goes [default: a file with the name of the command in target/rasterproof]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file that --output does not name also where this program did not make it
    #[arg(long)]
    force: bool,
}

/// Writes a page around the compiled engines.
pub(super) fn run(
    (name, parts): (&str, &Parts),
    PlaygroundArguments { module, output, force }: &PlaygroundArguments,
    streams: &mut Streams<'_>,
) -> Status {
    // A page of another program at the usual place is kept; one that this program made is replaced.
    let usual = || Output {
        path: Path::new("target/rasterproof").join(name).with_extension("html"),
        over: if *force { Over::Any } else { Over::Marked },
    };
    let output = output.as_deref().map_or_else(usual, Output::typed);
    output::check_all([("--module", &**module, Use::Reads), output.named("--output")])?;
    let refused = |why: String| {
        usage(format!("{why}\nCompile the engines for the page: crates/playground/build"))
    };
    let bytes = input::read(module, limits::SOURCE_BYTES).map_err(|e| refused(e.to_string()))?;
    // A module that a broken build left behind would fail in the browser of whoever opens the page.
    if !is_whole(&bytes) {
        let module = printable_path(module);
        return Err(refused(format!("{module} ends in the middle of a section, or is damaged")));
    }
    let page = page(parts, &bytes)
        .map_err(|problem| refused(format!("{} {problem}", printable_path(module))))?;
    write_file(&output, page.as_bytes())?;
    writeln!(streams.output, "{name}: {}", printable_path(&output.path))?;
    Ok(exit::AGREES)
}

/// Whether the sections of a module end where its bytes end. Bytes that are not a module at all are
/// for [`page`] to refuse.
fn is_whole(module: &[u8]) -> bool {
    // The eight bytes before the first section are "\0asm" and the version.
    let Some(mut rest) = module.strip_prefix(b"\0asm") else { return true };
    let Some(sections) = rest.get(4..) else { return false };
    rest = sections;
    while let [_kind, after_kind @ ..] = rest {
        // The length of a section: seven bits in each byte, the lowest first.
        let Some(digits) = after_kind.iter().take(5).position(|byte| byte & 0x80 == 0) else {
            return false;
        };
        let (length, content) = after_kind.split_at(digits + 1);
        let length = length.iter().rev().fold(0, |sum, byte| sum << 7 | u64::from(byte & 0x7f));
        let end = usize::try_from(length).unwrap_or(usize::MAX);
        let Some(next) = content.get(end..) else { return false };
        rest = next;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_truncated_module_is_recognised() {
        // A custom section of 130 bytes, whose length takes two bytes, and one of none.
        let mut module = b"\0asm\x01\0\0\0\0\x82\x01".to_vec();
        module.resize(module.len() + 130, 7);
        module.extend([0, 0]);
        assert!(is_whole(&module) && is_whole(&module[..8]) && is_whole(&module[..141]));
        for length in (4..8).chain(9..141).chain([142]) {
            assert!(!is_whole(&module[..length]), "{length}");
        }
    }
}
