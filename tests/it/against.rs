//! Two programs compared: where they differ, and which of them the oracle agrees with.

use rasterproof_judge::against::compare;
use rasterproof_judge::verdict::{Scores as _, Shapes, Verdict};

use crate::judge::{inside, options};

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
        assert!(
            verdict.shapes(Shapes::Triangles) + verdict.shapes(Shapes::Lines) > 200,
            "{first} {second}"
        );
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
