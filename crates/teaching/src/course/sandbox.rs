//! How a student's program is run: in its folder, with bounds on memory, processor time and file
//! sizes. Bounds, no sandbox: what it may do to the machine is what its user may.
//!
//! The standard library sets no such bounds, so a program is started by `sh`, which changes the
//! folder, sets them with `ulimit` and becomes the program. Words of the command are arguments of
//! this fixed line, never parts of it.

use std::ffi::{OsStr, OsString};
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rasterproof_host::limits;
use rasterproof_host::text::printable_path;
use rasterproof_judge::text::printable;
use rasterproof_program::group::{Group, end_strays_of_ended_groups};
use rasterproof_program::{Limits, Program};

/// What a program may use.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Addresses it may map, in MiB; nothing for no bound.
    pub memory_mib: Option<u64>,
    /// Seconds of processor time, of each process; nothing for no bound.
    pub processor_s: Option<u64>,
    /// How long its build may take.
    pub build: Duration,
    /// Bytes that its build may write to standard error; its standard output is thrown away.
    pub build_bytes: u64,
}

impl Default for Bounds {
    /// A student's own program is not bounded.
    fn default() -> Self {
        Self {
            memory_mib: None,
            processor_s: None,
            build: Duration::from_secs(limits::BUILD_SECONDS),
            build_bytes: limits::BUILD_OUTPUT_MIB << 20,
        }
    }
}

/// `$1` KiB of addresses, `$2` seconds, `$3` the folder, then the program. Where a bound cannot be
/// set, the program does not start.
const LINE: &str =
    "cd -- \"$3\" && ulimit -v \"$1\" && ulimit -t \"$2\" && ulimit -c 0 && shift 3 && exec \"$@\"";

/// The command that runs a program in its folder and its bounds.
pub fn command<S: AsRef<OsStr>>(folder: &Path, run: &[S], bounds: &Bounds) -> Vec<OsString> {
    // `ulimit` takes numbers, and this word for none.
    let bound = |n: Option<u64>| n.map_or_else(|| "unlimited".to_owned(), |n| n.to_string());
    // Nothing to set is left as it is: another `sh` may know no such bound.
    let line = match (bounds.memory_mib, bounds.processor_s) {
        (None, None) => "cd -- \"$3\" && shift 3 && exec \"$@\"",
        _ => LINE,
    };
    // `ulimit -v` counts in KiB.
    let memory = bound(bounds.memory_mib.map(|mib| mib.saturating_mul(1024)));
    let head = ["sh", "-c", line, "sh", &memory, &bound(bounds.processor_s)].map(OsString::from);
    let run = run.iter().map(|word| word.as_ref().to_owned());
    head.into_iter().chain([folder.into()]).chain(run).collect()
}

/// Whether the program is there to be run.
pub fn check_command<S: AsRef<OsStr>>(folder: &Path, run: &[S]) -> Result<(), String> {
    let Some(name) = run.first().map(AsRef::as_ref).filter(|name| !name.is_empty()) else {
        return Err("no program is named\n  name one: rasterproof course check -- CMD, or run in \
                    course.toml"
            .to_owned());
    };
    let shown = printable(name.as_encoded_bytes(), 80);
    if !folder.is_dir() {
        return Err(format!("{} is no folder", printable_path(folder)));
    }
    // A name with a slash is a path from the folder; any other one is looked for in PATH, as a shell does.
    let is_in = |folder: &Path| folder.join(name).is_file();
    if name.as_encoded_bytes().contains(&b'/') {
        let remedy = "build it, or mend run in course.toml";
        let missing = || format!("{shown} is not in {}\n  {remedy}", printable_path(folder));
        return is_in(folder).then_some(()).ok_or_else(missing);
    }
    let remedy = "install it, or name another command: rasterproof course check -- CMD";
    let missing = || format!("{shown} is not installed: no folder of PATH has it\n  {remedy}");
    let paths = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&paths).any(|path| is_in(&path)).then_some(()).ok_or_else(missing)
}

/// A program that has said HELLO.
///
/// # Errors
/// It is not there, cannot be started or says no HELLO; with what to do about it.
pub fn start<S: AsRef<OsStr>>(
    folder: &Path,
    run: &[S],
    bounds: &Bounds,
    limits: Limits,
) -> Result<Program, String> {
    check_command(folder, run)?;
    Program::start(&command(folder, run, bounds), &[], limits).map_err(|misbehaviour| {
        let shown = shown(run, 80);
        format!("the program {shown} {misbehaviour}\n  {}", misbehaviour.remedy())
    })
}

/// The beginning of a command, for a message.
fn shown<S: AsRef<OsStr>>(words: &[S], most: usize) -> String {
    let words: Vec<_> = words.iter().map(|word| word.as_ref().to_string_lossy()).collect();
    printable(words.join(" ").as_bytes(), most)
}

/// The beginning of what a build has written to standard error, and how many bytes it was.
type BuildMessages = Arc<Mutex<(Vec<u8>, u64)>>;

/// Builds a program, if it is to be built, and ends whatever the build has started.
///
/// # Errors
/// The builder is missing, fails, writes too much or takes too long; with the beginning of what it said.
pub fn build(folder: &Path, build: &[String], bounds: &Bounds) -> Result<(), String> {
    if build.is_empty() {
        return Ok(());
    }
    check_command(folder, build)?;
    // A builder maps more memory than the program that it makes.
    let line = command(folder, build, &Bounds { memory_mib: None, ..*bounds });
    let mut command = Command::new(&line[0]);
    command.args(&line[1..]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    // A group of its own, so that all of its processes can be ended.
    let mut group = Group::start(&mut command).map_err(|e| format!("cannot build: {e}"))?;
    let said = BuildMessages::default();
    if let Some(stderr) = group.child().stderr.take() {
        keep(stderr, Arc::clone(&said)).map_err(|e| {
            format!("cannot build: no thread can be started; allow more processes (ulimit -u): {e}")
        })?;
    }
    // What was said stays readable if the thread that reads it panics.
    let lock = || said.lock().unwrap_or_else(PoisonError::into_inner);
    // The build runs until it ends, has written too much, or has taken too long.
    let end = Instant::now() + bounds.build;
    let floods = || lock().1 > bounds.build_bytes;
    while !group.has_ended() && !floods() && Instant::now() < end {
        std::thread::sleep(Duration::from_millis(1));
    }
    let ended = group.end(Duration::ZERO);
    // What has left the group may hold the pipe, which is therefore not waited for.
    end_strays_of_ended_groups();
    // Why it was ended, if it was; a build that has ended by itself has succeeded or failed.
    let limit = match ended {
        _ if floods() => Some(format!(
            "the build writes more than {} MiB to standard error",
            bounds.build_bytes >> 20
        )),
        None => Some(format!("the build takes more than {} s", bounds.build.as_secs())),
        Some(status) if status.success() => return Ok(()),
        Some(_) => None,
    };
    if limit.is_none() {
        // It has ended: what it wrote last is on its way through the pipe.
        let patience = Instant::now() + Duration::from_millis(200);
        while Arc::strong_count(&said) > 1 && Instant::now() < patience {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    let text = lock().0.clone();
    // The first lines that are not empty, as they may be shown.
    let text: Vec<String> = text
        .split(|b| *b == b'\n')
        .filter(|line| !line.is_empty())
        .take(12)
        .map(|line| format!("  | {}", printable(line.trim_ascii_end(), 94)))
        .collect();
    let why = limit.unwrap_or_else(|| "the build fails".to_owned());
    Err(format!("{why}: {}\n{}", shown(build, 200), text.join("\n")))
}

/// Reads a pipe to its end on a thread of its own, and keeps the beginning.
fn keep(mut stderr: impl Read + Send + 'static, said: BuildMessages) -> std::io::Result<()> {
    let read = move || {
        let mut piece = vec![0; 1 << 16];
        while let Ok(n @ 1..) = stderr.read(&mut piece) {
            let mut said = said.lock().unwrap_or_else(PoisonError::into_inner);
            let left = limits::BUILD_SAID_BYTES - said.0.len();
            said.0.extend_from_slice(&piece[..n.min(left)]);
            said.1 += n as u64;
        }
    };
    std::thread::Builder::new().spawn(read).map(drop)
}
