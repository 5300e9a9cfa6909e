//! The program: connects the command line to the terminal, and exits.

use std::io::{self, BufWriter, IsTerminal};
use std::process::ExitCode;

use rasterproof::cli::{self, Streams};
use rasterproof::judge::group::end_strays;

fn main() -> ExitCode {
    let mut streams = Streams {
        input: &mut io::stdin().lock(),
        output: &mut BufWriter::new(io::stdout().lock()),
        errors: &mut io::stderr(),
        progress: io::stderr().is_terminal(),
        // See no-color.org.
        colour: io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
    };
    let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
    let status = cli::run(words, &mut streams);
    end_strays();
    ExitCode::from(status)
}
