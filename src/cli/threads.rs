//! The threads on which cases are judged: one for each core, or as many as the system allows.
//!
//! rayon would start its pool at the first use, and panic where the system refuses a thread, as it does
//! under a limit of processes (`ulimit -u`). Here the threads are started first, and the pool gets those
//! that exist. A result does not depend on their number.

use std::ffi::OsStr;
use std::io::{self, Write};
use std::num::IntErrorKind;
use std::sync::Once;
use std::sync::mpsc::{Sender, channel};
use std::thread::{Builder, JoinHandle, available_parallelism};

use rasterproof_host::text::printable;
use rayon::{ThreadBuilder, ThreadPoolBuilder};

const VARIABLE: &str = "RAYON_NUM_THREADS";
/// Threads for each core: more of them only wait for each other, and each has a stack.
const MOST_FOR_EACH_CORE: usize = 4;

/// Builds the pool of this process, once; what is not as the user may expect is said on `errors`.
pub(super) fn prepare(errors: &mut dyn Write) {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let cores = available_parallelism().map_or(1, usize::from);
        let (count, warning) = wanted(std::env::var_os(VARIABLE).as_deref(), cores);
        let warnings = [warning, build(count)];
        for warning in warnings.into_iter().flatten() {
            // Where nobody reads warnings, the work goes on.
            let _ = writeln!(errors, "warning: {warning}");
        }
    });
}

/// The number of threads that the variable asks for, and what is wrong with it. 0 means one for each
/// core, as in rayon.
fn wanted(variable: Option<&OsStr>, cores: usize) -> (usize, Option<String>) {
    let Some(variable) = variable else { return (cores, None) };
    let text = variable.to_string_lossy();
    let shown = printable(&text);
    let most = cores.saturating_mul(MOST_FOR_EACH_CORE);
    // For a number above the bound, and for one that no word can hold.
    let too_many = || {
        let why = format!(
            "{VARIABLE}={shown} asks for more than {MOST_FOR_EACH_CORE} threads for each of {cores} \
             cores; {most} are used; set a smaller number"
        );
        (most, Some(why))
    };
    match text.parse::<usize>() {
        Ok(0) => (cores, None),
        Ok(count) if count > most => too_many(),
        Ok(count) => (count, None),
        Err(error) if *error.kind() == IntErrorKind::PosOverflow => too_many(),
        Err(_) => {
            let why = format!(
                "{VARIABLE}={shown} is no number of threads; {cores} are used; set a whole number, \
                 for example {cores}"
            );
            (cores, Some(why))
        }
    }
}

/// A thread that waits for its place in the pool.
type Waiting = (Sender<ThreadBuilder>, JoinHandle<()>);

/// Starts a thread, which waits until the pool gives it its work or drops its place.
fn start() -> io::Result<Waiting> {
    let (place, given) = channel::<ThreadBuilder>();
    let wait = move || given.recv().into_iter().for_each(ThreadBuilder::run);
    Ok((place, Builder::new().spawn(wait)?))
}

/// Builds the pool with as many threads, or with those that the system allows, and then says so.
fn build(count: usize) -> Option<String> {
    let mut waiting = Vec::new();
    let mut refusal = None;
    while waiting.len() < count && refusal.is_none() {
        match start() {
            Ok(thread) => waiting.push(thread),
            Err(error) => refusal = Some(error),
        }
    }
    if refusal.is_some() {
        // Programs that are judged, and the pipes to them, need some of what the system allows.
        for (place, thread) in waiting.drain(waiting.len() / 2..) {
            drop(place);
            // It has nothing to do, so it does not panic.
            let _ = thread.join();
        }
    }
    let used = waiting.len().max(1);
    let pool = ThreadPoolBuilder::new().num_threads(used);
    let pool = if waiting.is_empty() { pool.use_current_thread() } else { pool };
    let missing = || io::Error::other("the thread has ended");
    let give = |place| {
        let (thread, _) = waiting.pop().ok_or_else(missing)?;
        thread.send(place).map_err(|_| missing())
    };
    // It fails where there is a pool already, which then serves.
    let _ = pool.spawn_handler(give).build_global();
    let threads = if used == 1 { "1 thread is" } else { &format!("{used} threads are") };
    refusal.map(|error| {
        format!(
            "the system refuses to start {count} threads ({error}); {threads} used; \
             allow this user more processes (ulimit -u) for more"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_variable_is_a_number_of_threads() {
        let of = |text: &str| wanted(Some(OsStr::new(text)), 2);
        assert_eq!(wanted(None, 2), (2, None));
        for (text, count) in [("1", 1), ("3", 3), ("8", 8), ("0", 2)] {
            assert_eq!(of(text), (count, None), "{text}");
        }
        for text in ["9", "65535", "99999999999999999999"] {
            let (count, warning) = of(text);
            assert!(count == 8 && warning.unwrap().contains("8 are used"), "{text}");
        }
        for text in ["", "two", "-1", "1.5", " 2", "\x1b[31m"] {
            let (count, warning) = of(text);
            let warning = warning.unwrap();
            assert!(count == 2 && warning.contains("is no number of threads"), "{text}");
            assert!(!warning.contains('\x1b'), "{warning}");
        }
    }
}
