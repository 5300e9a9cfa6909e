//! Two programs compared: where they differ, and which of them the oracle agrees with.

use rasterproof_judge::against::compare;
use rasterproof_judge::verdict::{Scores as _, Verdict};
use serde_json::Value;

use crate::judge::{inside, options};
use crate::program::{PROGRAM, Run, shared};

fn compared(first: &str, second: &str, families: &[&str]) -> Verdict {
    compare(&mut [[inside(first), inside(second)]], &options(60, families), &|_| ())
}

#[test]
fn programs_that_draw_the_same_do_not_differ() {
    for (first, second) in [
        ("scanline", "edge-function"),
        ("dda", "bresenham"),
        ("games101-strict", "games101-strict"),
    ] {
        let verdict = compared(first, second, &[]);
        assert!(verdict.agrees(), "{first} {second}: {:?}", verdict.failures);
        assert!(verdict.shapes(false) + verdict.shapes(true) > 200, "{first} {second}");
        let is_wrong = first == "games101-strict";
        assert_eq!(verdict.sides().same_but_wrong > 0, is_wrong, "{first}: {:?}", verdict.sides());
    }
}

/// Each kind of question finds its difference, and who is right, whichever program stands first.
#[test]
fn who_is_right_is_told() {
    for (wrong, right, property, families) in [
        ("exclusive-edges", "scanline", "half-integer", ["half-integer", "fan"]),
        ("exclusive-edges", "scanline", "samples4", ["half-integer", "fan"]),
        ("bottom-right-rule", "scanline", "half-integer", ["half-integer", "fan"]),
        ("affine-attributes", "scanline", "values", ["uniform", "fan"]),
        ("line-draws-backwards", "dda", "line-octants", ["line-octants", "line-clipped"]),
    ] {
        for swap in [false, true] {
            let [first, second] = if swap { [right, wrong] } else { [wrong, right] };
            let verdict = compared(first, second, &families);
            assert!(!verdict.agrees(), "{first} {second}");
            let sides = verdict.sides();
            let [of_right, of_wrong] =
                if swap { [sides.first, sides.second] } else { [sides.second, sides.first] };
            assert!(
                of_right > 0 && of_wrong + sides.neither + sides.both == 0,
                "{wrong}: {sides:?}"
            );
            let row = verdict.families.iter().find(|row| row.name == property).unwrap();
            assert!(row.wrong_cases > 0, "{wrong}: {property}");
            // Where it has a cause, it is that of the wrong one.
            assert!(verdict.cause.iter().all(|why| why.by == wrong), "{:?}", verdict.cause);
        }
    }
    // Both wrong, each in its own way.
    let verdict = compared("sample-off-by-one-subpixel", "drops-first-row", &[]);
    assert!(verdict.sides().neither > 0, "{:?}", verdict.sides());
}

fn against(second: &str, first: &str, options: &str) -> Run {
    let mut command = shared().command(format!("judge --cases 10 {options}"));
    command.args(["--against", &format!("'{PROGRAM}' engine {second}")]);
    command.args(["--", PROGRAM, "engine", first]);
    Run::of(&mut command)
}

#[test]
fn the_answer_comes_first_and_is_a_status() {
    let same = against("edge-function", "scanline", "");
    assert_eq!(same.status, Some(0), "{}", same.out);
    assert!(same.out.contains("scanline and edge-function answer the same in"), "{}", same.out);

    let differ = against("scanline", "exclusive-edges", "--family half-integer");
    assert_eq!(differ.status, Some(1), "{}", differ.out);
    let first = differ.out.lines().next().unwrap();
    assert!(first.contains("exclusive-edges and scanline differ in 6 of 13 cases"), "{first}");
    for part in [
        "6 cases: scanline is right and exclusive-edges is not",
        "of the wrong triangles of exclusive-edges:",
        "exclusive-edges   scanline   expected",
        "  other:    C 1 ",
        "--against",
    ] {
        assert!(differ.out.contains(part), "{part}: {}", differ.out);
    }

    let json = against("scanline", "exclusive-edges", "--family half-integer --json");
    let json: Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(json["against"]["program"], "scanline");
    assert_eq!(json["against"]["sides"]["second"], 6);
    assert!(json["failures"][0]["exchanges"][0]["other"].is_string());

    // A triangle and a line have nothing in common.
    let nothing = against("dda", "games101-strict", "");
    assert_eq!(nothing.status, Some(2));
    assert!(nothing.errors.contains("no capability in common"), "{}", nothing.errors);
}
