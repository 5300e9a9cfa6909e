//! The program: connects the command line to the terminal, and exits.

use std::io::{self, BufWriter, IsTerminal};
use std::process::ExitCode;

use rasterproof::cli::{self, Delivery, Streams};
use rasterproof_judge::process_group::end_strays;
use terminal_size::{Height, Width, terminal_size_of};

/// Columns of a terminal, or as the environment says where there is none.
fn columns(size: Option<(Width, Height)>) -> Option<usize> {
    let said = || std::env::var("COLUMNS").ok()?.parse().ok();
    size.map(|(width, _)| width.0.into()).or_else(said).filter(|&columns| columns > 0)
}

fn main() -> ExitCode {
    // No command for people: the package for Python begins the program like this.
    if std::env::args_os().nth(1).is_some_and(|word| word == "hosted-judge") {
        return rasterproof_report::hosted::main();
    }
    let mut streams = Streams {
        input: &mut io::stdin().lock(),
        output: &mut BufWriter::new(io::stdout().lock()),
        errors: &mut io::stderr(),
        progress: io::stderr().is_terminal(),
        // See no-color.org.
        colour: io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
        columns: columns(terminal_size_of(io::stdout())).unwrap_or(cli::wrap::USUAL),
        error_columns: columns(terminal_size_of(io::stderr())),
        delivery: Delivery::default(),
    };
    let status = cli::run(std::env::args_os(), &mut streams);
    end_strays();
    ExitCode::from(status)
}
