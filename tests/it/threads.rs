//! Where the system refuses threads, fewer are used: no panic, the same result, and a warning.
//!
//! A limit of processes does not bind every user. A stack larger than the address space has the same
//! effect on everybody: no thread can be started.

use crate::program::{PROGRAM, Run, shared};

/// Bytes of the stack of each thread: more than a process can have.
const ENDLESS_STACK: &str = "70368744177664";

fn run(words: &str, variable: (&str, &str)) -> Run {
    let mut command = shared().command(words);
    Run::of(command.env_remove("RAYON_NUM_THREADS").env(variable.0, variable.1))
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn without_a_second_thread_the_result_is_the_same() {
    for words in [
        "verify --cases 5",
        "verify --cases 2 --json",
        "verify --cases 5 --plant inclusive-edges --family fan",
        "verify --invariant vertex-order --cases 5",
        "render cube --size 64x64",
        "specimens --cases 1",
        "digest --cases 1",
    ] {
        let several = run(words, ("RAYON_NUM_THREADS", "2"));
        let Run { status, out, errors, .. } = run(words, ("RUST_MIN_STACK", ENDLESS_STACK));
        // All but what was measured.
        let counted = |out: &str| {
            let lines = out.lines().filter(|line| !line.contains(" ms by "));
            lines.map(str::to_owned).collect::<Vec<_>>()
        };
        let (one, two) = ((status, counted(&out)), (several.status, counted(&several.out)));
        assert_eq!(one, two, "{words:?}: {errors}");
        let [line] = errors.lines().collect::<Vec<_>>()[..] else { panic!("{words:?}: {errors}") };
        assert!(line.starts_with("warning: the system refuses to start "), "{line}");
        assert!(line.contains("1 thread is used; allow this user more processes"), "{line}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_proof_is_finished_on_one_thread() {
    let words = "exhaust lines --reach 2 --restart -o lines.json";
    let run = run(words, ("RUST_MIN_STACK", ENDLESS_STACK)).has(0);
    run.says("AGREES: 25 of 25 cases");
    let text = std::fs::read_to_string(shared().join("lines.json")).unwrap();
    assert!(text.contains("\"threads\": 1"), "{text}");
}

/// The pipes of a judged program need threads of their own.
#[cfg(target_os = "linux")]
#[test]
fn a_program_that_cannot_be_served_is_not_judged() {
    let words = format!("judge --cases 2 -- {PROGRAM} engine scanline");
    let run = run(&words, ("RUST_MIN_STACK", ENDLESS_STACK)).has(2).without_output();
    assert!(run.errors.starts_with("error: the program cannot be started: no thread"), "{run}");
    run.says("ulimit -u");
}

/// The replay invariant compares one thread with three, and says so where there are none.
#[cfg(target_os = "linux")]
#[test]
fn verdicts_of_threads_that_are_refused_are_not_compared() {
    let run = run("verify --invariant replay", ("RUST_MIN_STACK", ENDLESS_STACK)).has(2);
    run.prints("NOT JUDGED: the system refuses the threads");
}

#[test]
fn the_number_of_threads_is_bounded() {
    let words = "verify --cases 2 --family fan";
    let with = |count: &str| run(words, ("RAYON_NUM_THREADS", count)).has(0);
    let out = with("1").without_errors().out;
    assert_eq!(with("0").without_errors().out, out);
    for (count, why) in [
        ("65535", "asks for more than 4 threads for each of "),
        ("99999999999999999999", "asks for more than 4 threads for each of "),
        ("two", "is no number of threads; "),
        ("-1", "is no number of threads; "),
    ] {
        let Run { out: same, errors, .. } = with(count);
        assert_eq!(same, out, "{count}");
        let expected = format!("warning: RAYON_NUM_THREADS={count} {why}");
        assert!(errors.starts_with(&expected) && errors.lines().count() == 1, "{errors}");
    }
}
