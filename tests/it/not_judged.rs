//! What was not judged is neither right nor wrong, and the program says which of the three it is.

use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_verify::cases::FamilyName;
use rasterproof_verify::comparison::{
    NothingJudged, Options, Shard, judge_coverage, judge_line_values,
};

use crate::program::{check, shared};

/// The first case of this invariant that fits is its seventh, so fewer judge nothing.
#[test]
fn an_invariant_without_a_fitting_case_is_not_judged() {
    for cases in 1..=5 {
        let run = check(format!("verify --invariant clip-inside --cases {cases}"), 2);
        let run = run.without_errors().prints("NOT JUDGED");
        run.omits("FAILS").omits("AGREES").omits("holds");
    }
}

#[test]
fn the_named_number_of_cases_judges_it() {
    let out = shared().run("verify --invariant clip-inside --cases 1 --seed 1").out;
    let line = out.lines().find_map(|line| line.split_once("judge it with: ")).expect(&out).1;
    let words: Vec<&str> = line.split_whitespace().skip(1).collect();
    check(&words, 0).prints(" holds\n");
    // No smaller number does.
    let needed: u64 = words.last().unwrap().parse().unwrap();
    let fewer = needed - 1;
    check(format!("verify --invariant clip-inside --cases {fewer}"), 2).prints("NOT JUDGED");
}

#[test]
fn several_invariants_have_three_outcomes() {
    let words = "verify --invariant clip-inside --invariant vertex-order --cases 1";
    let summary =
        "NOT JUDGED: 1 of 2 invariants hold, 0 do not, 1 not judged (--cases 7 judges them)";
    check(words, 2).prints(summary);
    // What fails is wrong, whatever else was not judged.
    let words = "verify --invariant engines-agree --plant inclusive-edges --invariant clip-inside";
    let summary = "DISAGREES: 0 of 2 invariants hold, 1 do not, 1 not judged";
    check(format!("{words} --cases 6"), 1).prints(summary);
}

#[test]
fn an_empty_shard_or_no_cases_is_no_verdict_of_the_program() {
    check("verify --cases 2 --shard 3/4", 2).omits("AGREES");
    check("verify --cases 0", 2).omits("AGREES");
}

#[test]
fn the_library_returns_an_error() {
    let lines = Options::default().family(FamilyName::LineTies);
    let error = judge_coverage(&Engine::Scanline, &lines).unwrap_err();
    let error: Box<dyn std::error::Error> = Box::new(error);
    assert!(error.to_string().contains("line-ties hold other shapes"), "{error}");
    let none = Options::default().cases(0);
    let error = judge_line_values(&LineEngine::JUDGED[0], &none).unwrap_err();
    assert_eq!(error, NothingJudged::NoCases);
    assert!("unifrom".parse::<FamilyName>().is_err() && Shard::new(0, 0).is_err());
}
