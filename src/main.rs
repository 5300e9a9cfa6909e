//! The program: connects the command line to the terminal, and exits.

use std::io::{self, BufWriter, IsTerminal, Write};
use std::process::ExitCode;
#[cfg(unix)]
use std::sync::atomic::{AtomicBool, Ordering};

use rasterproof::cli::outlet::USUAL;
use rasterproof::cli::{self, Delivery, Streams};
use rasterproof_program::group::end_strays;
use terminal_size::{Height, Width, terminal_size_of};

#[cfg(target_env = "musl")]
#[global_allocator]
static MEMORY: dlmalloc::GlobalDlmalloc = dlmalloc::GlobalDlmalloc;

/// Columns of a terminal, or as the environment says where there is none.
fn columns(size: Option<(Width, Height)>) -> Option<usize> {
    let said = || std::env::var("COLUMNS").ok()?.parse().ok();
    size.map(|(width, _)| width.0.into()).or_else(said).filter(|&columns| columns > 0)
}

#[cfg(unix)]
static OUTPUT_WAS_CLOSED: AtomicBool = AtomicBool::new(false);

// Looks whether standard output is open (`>&-` closes it) before Rust opens `/dev/null` in place of what is closed, which
// cannot be told later from the `/dev/null` of a caller that wants no output. Runs before `main`, so it does nothing else.
// The macro asks for the word `unsafe`; what is unsafe, the section that it is called from, is in the macro.
#[cfg(unix)]
ctor_lite::ctor! {
    unsafe fn look_at_output() {
        let is_closed = rustix::fs::fcntl_getfl(io::stdout()).is_err();
        OUTPUT_WAS_CLOSED.store(is_closed, Ordering::Relaxed);
    }
}

/// Standard output; where it was closed, every byte written to it is an error.
fn output() -> Box<dyn Write> {
    struct Closed;
    impl Write for Closed {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::Error::other("it is closed"))
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    #[cfg(unix)]
    if OUTPUT_WAS_CLOSED.load(Ordering::Relaxed) {
        return Box::new(Closed);
    }
    Box::new(io::stdout().lock())
}

fn main() -> ExitCode {
    // No command for people: the package for Python begins the program like this.
    if std::env::args_os().nth(1).is_some_and(|word| word == "hosted-judge") {
        return rasterproof_report::hosted::main();
    }
    let mut streams = Streams {
        input: &mut io::stdin().lock(),
        output: &mut BufWriter::new(output()),
        errors: &mut io::stderr(),
        progress: io::stderr().is_terminal(),
        // See no-color.org.
        colour: io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none(),
        columns: columns(terminal_size_of(io::stdout())).unwrap_or(USUAL).min(USUAL),
        error_columns: columns(terminal_size_of(io::stderr()))
            .map_or(usize::MAX, |all| all.min(USUAL)),
        delivery: Delivery::default(),
    };
    let status = cli::run(std::env::args_os(), &mut streams);
    end_strays();
    ExitCode::from(status)
}
