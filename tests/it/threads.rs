//! Where the system refuses threads, fewer are used: no panic, the same result, and a warning.
//!
//! A limit of processes does not bind every user. A stack larger than the address space has the same
//! effect on everybody: no thread can be started.

use std::path::{Path, PathBuf};
use std::process::Command;

const PROGRAM: &str = env!("CARGO_BIN_EXE_rasterproof");
/// Bytes of the stack of each thread: more than a process can have.
const ENDLESS_STACK: &str = "70368744177664";

fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("threads");
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn run(words: &[&str], variable: (&str, &str)) -> (i32, String, String) {
    let mut command = Command::new(PROGRAM);
    command.args(words).current_dir(folder()).env_remove("COLUMNS");
    command.env_remove("RAYON_NUM_THREADS").env(variable.0, variable.1);
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[cfg(target_os = "linux")]
#[test]
fn without_a_second_thread_the_result_is_the_same() {
    for words in [
        &["verify", "--cases", "5"][..],
        &["verify", "--cases", "2", "--json"],
        &["verify", "--cases", "5", "--plant", "inclusive-edges", "--family", "fan"],
        &["verify", "--invariant", "vertex-order", "--cases", "5"],
        &["render", "cube", "--size", "64x64"],
        &["specimens", "--cases", "1"],
        &["digest", "--cases", "1"],
    ] {
        let (status, out, _) = run(words, ("RAYON_NUM_THREADS", "2"));
        let (status_alone, alone, errors) = run(words, ("RUST_MIN_STACK", ENDLESS_STACK));
        assert_eq!((status_alone, alone), (status, out), "{words:?}: {errors}");
        let [line] = errors.lines().collect::<Vec<_>>()[..] else { panic!("{words:?}: {errors}") };
        assert!(line.starts_with("warning: the system refuses to start "), "{line}");
        assert!(line.contains("1 thread is used; allow this user more processes"), "{line}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_proof_is_finished_on_one_thread() {
    let file = folder().join("lines.json");
    let words = ["exhaust", "lines", "--reach", "2", "--restart", "-o", file.to_str().unwrap()];
    let (status, out, errors) = run(&words, ("RUST_MIN_STACK", ENDLESS_STACK));
    assert_eq!(status, 0, "{out}{errors}");
    assert!(errors.contains("AGREES: 25 of 25 cases"), "{errors}");
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("\"threads\": 1"), "{text}");
    std::fs::remove_file(file).unwrap();
}

/// The pipes of a judged program need threads of their own.
#[cfg(target_os = "linux")]
#[test]
fn a_program_that_cannot_be_served_is_not_judged() {
    let words = ["judge", "--cases", "2", "--", PROGRAM, "engine", "scanline"];
    let (status, out, errors) = run(&words, ("RUST_MIN_STACK", ENDLESS_STACK));
    assert_eq!((status, &*out), (2, ""), "{errors}");
    assert!(errors.starts_with("error: the program cannot be started: no thread"), "{errors}");
    assert!(errors.contains("ulimit -u") && !errors.contains("panicked"), "{errors}");
}

/// The replay invariant compares one thread with three, and says so where there are none.
#[cfg(target_os = "linux")]
#[test]
fn verdicts_of_threads_that_are_refused_are_not_compared() {
    let words = ["verify", "--invariant", "replay"];
    let (status, out, errors) = run(&words, ("RUST_MIN_STACK", ENDLESS_STACK));
    assert_eq!(status, 2, "{out}{errors}");
    assert!(out.contains("NOT JUDGED: the system refuses the threads"), "{out}");
}

#[test]
fn the_number_of_threads_is_bounded() {
    let words = ["verify", "--cases", "2", "--family", "fan"];
    let with = |count: &str| run(&words, ("RAYON_NUM_THREADS", count));
    let (status, out, errors) = with("1");
    assert_eq!((status, &*errors), (0, ""), "{out}");
    assert_eq!(with("0"), (0, out.clone(), String::new()));
    for (count, why) in [
        ("65535", "asks for more than 4 threads for each of "),
        ("99999999999999999999", "asks for more than 4 threads for each of "),
        ("two", "is no number of threads; "),
        ("-1", "is no number of threads; "),
    ] {
        let (status, same, errors) = with(count);
        assert_eq!((status, same), (0, out.clone()), "{count}");
        let expected = format!("warning: RAYON_NUM_THREADS={count} {why}");
        assert!(errors.starts_with(&expected) && errors.lines().count() == 1, "{errors}");
    }
}
