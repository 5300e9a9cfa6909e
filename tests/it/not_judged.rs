//! What was not judged is neither right nor wrong, and the program says which of the three it is.

use std::path::Path;
use std::process::Command;

use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_verify::comparison::{NothingJudged, Options, judge_coverage, judge_lines};

fn run(words: &[&str]) -> (i32, String, String) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("not-judged");
    std::fs::create_dir_all(&folder).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_rasterproof"));
    let output = command.args(words).current_dir(folder).env_remove("COLUMNS").output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// The first case of this invariant that fits is its seventh, so fewer judge nothing.
#[test]
fn an_invariant_without_a_fitting_case_is_not_judged() {
    for cases in 1..=5 {
        let cases = cases.to_string();
        let (status, out, errors) =
            run(&["verify", "--invariant", "clip-inside", "--cases", &cases]);
        assert_eq!((status, &*errors), (2, ""), "{out}");
        assert!(out.contains("NOT JUDGED") && !out.contains("FAILS"), "{out}");
        assert!(!out.contains("AGREES") && !out.contains("holds"), "{out}");
    }
}

#[test]
fn the_named_number_of_cases_judges_it() {
    let (_, out, _) = run(&["verify", "--invariant", "clip-inside", "--cases", "1", "--seed", "1"]);
    let line = out.lines().find_map(|line| line.split_once("judge it with: ")).expect(&out).1;
    let words: Vec<&str> = line.split_whitespace().skip(1).collect();
    let (status, out, _) = run(&words);
    assert_eq!(status, 0, "{out}");
    assert!(out.contains("  holds\n"), "{out}");
    // No smaller number does.
    let needed: u64 = words.last().unwrap().parse().unwrap();
    let fewer = (needed - 1).to_string();
    let (status, out, _) = run(&["verify", "--invariant", "clip-inside", "--cases", &fewer]);
    assert!(status == 2 && out.contains("NOT JUDGED"), "{out}");
}

#[test]
fn several_invariants_have_three_outcomes() {
    let two = ["--invariant", "clip-inside", "--invariant", "vertex-order", "--cases", "1"];
    let (status, out, _) = run(&[&["verify"], &two[..]].concat());
    assert_eq!(status, 2, "{out}");
    let summary =
        "NOT JUDGED: 1 of 2 invariants hold, 0 do not, 1 not judged (--cases 7 judges them)";
    assert!(out.contains(summary), "{out}");
    // What fails is wrong, whatever else was not judged.
    let planted = ["--invariant", "engines-agree", "--plant", "inclusive-edges", "--invariant"];
    let (status, out, _) =
        run(&[&["verify"], &planted[..], &["clip-inside", "--cases", "6"]].concat());
    assert_eq!(status, 1, "{out}");
    assert!(out.contains("DISAGREES: 0 of 2 invariants hold, 1 do not, 1 not judged"), "{out}");
}

#[test]
fn an_empty_shard_or_no_cases_is_no_verdict_of_the_program() {
    for words in [&["--cases", "2", "--shard", "3/4"][..], &["--cases", "0"]] {
        let (status, out, _) = run(&[&["verify"], words].concat());
        assert!(status == 2 && !out.contains("AGREES"), "{words:?}: {out}");
    }
}

#[test]
fn the_library_returns_an_error() {
    let misspelt = Options { families: vec!["unifrom".to_owned()], ..Options::default() };
    let error = judge_coverage(&Engine::Scanline, &misspelt).unwrap_err();
    assert_eq!(error, NothingJudged::UnknownFamily("unifrom".to_owned()));
    let error: Box<dyn std::error::Error> = Box::new(error);
    assert!(error.to_string().contains("\"unifrom\"; expected some of "), "{error}");
    let none = Options { shard: (0, 0), ..Options::default() };
    let error = judge_lines(&LineEngine::JUDGED[0], &none).unwrap_err();
    assert_eq!(error, NothingJudged::BadShard(0, 0));
}
