//! How a student's program is run: in its folder, with bounds on memory, processor time and file
//! sizes. Bounds, no sandbox: what it may do to the machine is what its user may.
//!
//! The standard library sets no such bounds, so a program is started by `sh`, which changes the
//! folder, sets them with `ulimit` and becomes the program. Words of the command are arguments of
//! this fixed line, never parts of it.

use std::io::Read as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use rasterproof_judge::process::{Limits, Program};
use rasterproof_judge::process_group::Group;
use rasterproof_judge::text::printable;

/// What a program may use.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Addresses it may map, in MiB; nothing for no bound.
    pub memory_mib: Option<u64>,
    /// Seconds of processor time, of each process; nothing for no bound.
    pub processor_s: Option<u64>,
    /// How long its build may take.
    pub build: Duration,
}

impl Default for Bounds {
    /// A student's own program is not bounded.
    fn default() -> Self {
        Self { memory_mib: None, processor_s: None, build: Duration::from_secs(120) }
    }
}

/// `$1` KiB of addresses, `$2` seconds, `$3` the folder, then the program. Where a bound cannot be
/// set, the program does not start.
const LINE: &str =
    "cd -- \"$3\" && ulimit -v \"$1\" && ulimit -t \"$2\" && ulimit -c 0 && shift 3 && exec \"$@\"";

/// The command that runs a program in its folder and its bounds.
#[must_use]
pub fn command(folder: &Path, run: &[String], bounds: &Bounds) -> Vec<String> {
    let bound = |n: Option<u64>| n.map_or_else(|| "unlimited".to_owned(), |n| n.to_string());
    // Nothing to set is left as it is: another `sh` may know no such bound.
    let line = match (bounds.memory_mib, bounds.processor_s) {
        (None, None) => "cd -- \"$3\" && shift 3 && exec \"$@\"",
        _ => LINE,
    };
    let memory = bound(bounds.memory_mib.map(|mib| mib.saturating_mul(1024)));
    let head = ["sh", "-c", line, "sh", &memory, &bound(bounds.processor_s)].map(str::to_owned);
    let folder = folder.to_string_lossy().into_owned();
    head.into_iter().chain([folder]).chain(run.iter().cloned()).collect()
}

/// Whether the program is there to be run.
///
/// # Errors
/// What is missing, and what to do about it.
pub fn check_command(folder: &Path, run: &[String]) -> Result<(), String> {
    let Some(name) = run.first().filter(|name| !name.is_empty()) else {
        return Err("no program is named\n  name one: rasterproof course check -- CMD, or run in \
                    course.toml"
            .to_owned());
    };
    let shown = printable(name.as_bytes(), 80);
    if !folder.is_dir() {
        return Err(format!("{} is no folder", folder.display()));
    }
    if name.contains('/') {
        return if folder.join(name).is_file() {
            Ok(())
        } else {
            Err(format!(
                "{shown} is not in {}\n  build it, or mend run in course.toml",
                folder.display()
            ))
        };
    }
    let paths = std::env::var_os("PATH").unwrap_or_default();
    if std::env::split_paths(&paths).any(|path| path.join(name).is_file()) {
        Ok(())
    } else {
        Err(format!(
            "{shown} is not installed: no folder of PATH has it\n  install it, or name another \
             command: rasterproof course check -- CMD"
        ))
    }
}

/// A program that has said HELLO.
///
/// # Errors
/// It is not there, cannot be started or says no HELLO; with what to do about it.
pub fn start(
    folder: &Path,
    run: &[String],
    bounds: &Bounds,
    limits: Limits,
) -> Result<Program, String> {
    check_command(folder, run)?;
    Program::start(&command(folder, run, bounds), &[], limits).map_err(|misbehaviour| {
        let shown = printable(run.join(" ").as_bytes(), 80);
        format!("the program {shown} {misbehaviour}\n  {}", misbehaviour.remedy())
    })
}

/// What is kept of what a build says.
const MOST_SAID: u64 = 1 << 14;

/// Builds a program, if it is to be built.
///
/// # Errors
/// The builder is missing, fails, or takes too long; with the beginning of what it said.
pub fn build(folder: &Path, build: &[String], bounds: &Bounds) -> Result<(), String> {
    if build.is_empty() {
        return Ok(());
    }
    check_command(folder, build)?;
    let line = command(folder, build, &Bounds { memory_mib: None, ..*bounds });
    let mut command = Command::new(&line[0]);
    command.args(&line[1..]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut group = Group::start(&mut command).map_err(|e| format!("cannot build: {e}"))?;
    let stderr = group.child().stderr.take();
    let said = std::thread::spawn(move || {
        let mut said = Vec::new();
        if let Some(mut stderr) = stderr {
            let _ = (&mut stderr).take(MOST_SAID).read_to_end(&mut said);
            // The rest is read, so that the builder can end.
            let _ = std::io::copy(&mut stderr, &mut std::io::sink());
        }
        said
    });
    let ended = group.end(bounds.build);
    if ended.is_some_and(|status| status.success()) {
        return Ok(());
    }
    let said = said.join().unwrap_or_default();
    let said: Vec<String> = said
        .split(|b| *b == b'\n')
        .filter(|line| !line.is_empty())
        .take(12)
        .map(|line| format!("  | {}", printable(line.trim_ascii_end(), 94)))
        .collect();
    let why = match ended {
        Some(_) => "the build fails".to_owned(),
        None => format!("the build takes more than {} s", bounds.build.as_secs()),
    };
    Err(format!("{why}: {}\n{}", build.join(" "), said.join("\n")))
}
