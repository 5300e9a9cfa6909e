//! Corners off the grid: the two exact engines against the rational oracle, planted faults, named
//! cases that snapping would hide, and the protocol.

use std::collections::BTreeSet;

use proptest::prelude::*;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, Refusal, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::FreeCorners;
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_registry::engines::ExactEngine;
use rasterproof_verify::cases::unsnapped::FAMILIES;
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::{FamilyReport, Finding, Options, exact_coverage};

use crate::recorded::hits as hits_of;

pub const ALL: [ExactEngine; 3] =
    [ExactEngine::Scanline, ExactEngine::EdgeFunction, ExactEngine::Oracle];

fn drawn(engine: ExactEngine, case: &Case) -> Coverage {
    exact_coverage(&engine, case.free_corners(), case.window).expect("no panic").0
}

fn judge_case(engine: ExactEngine, case: &Case) -> Finding {
    EnginesToJudge::from(engine).judge_case(case).swap_remove(0).1
}

fn options(seed: u64, cases: u64) -> Options {
    Options::default().seed(seed).cases(cases)
}

fn free(corners: [[f64; 2]; 3]) -> FreeCorners {
    FreeCorners::new(corners).unwrap_or_else(|refusal| panic!("{corners:?} {refusal}"))
}

fn case(window: PixelRect, triangles: &[[[f64; 2]; 3]]) -> Case {
    Case::unsnapped(window, triangles.iter().map(|corners| free(*corners)).collect())
}

fn is_tiling(case: &Case) -> bool {
    matches!(case.shape, Shape::Unsnapped { is_tiling: true, .. })
}

/// Hits of one engine, which must be those of the oracle.
fn hits(engine: ExactEngine, case: &Case) -> Coverage {
    let finding = judge_case(engine, case);
    assert!(!finding.is_wrong(), "{}: {} on {case:?}", engine.name(), finding.describe());
    drawn(engine, case)
}

#[test]
fn families_agree_and_reach_both_paths() {
    for seed in [1, 2] {
        let judged =
            EnginesToJudge { unsnapped: ExactEngine::JUDGED.to_vec(), ..EnginesToJudge::default() };
        let verdict = judged.judge(&options(seed, 400), &|_| ());
        assert_eq!(verdict.families.len(), FAMILIES.len());
        for f in &verdict.families {
            assert_eq!((f.cases, f.oracle_faults), (400, 0), "{}", f.family);
            for e in &f.pairs {
                assert_eq!((e.tally.total(), e.panics), (0, 0), "{} {}", f.family, e.actual);
                assert!(e.decisions.by_filter > 0, "{} {}: nothing filtered", f.family, e.actual);
                let in_doubt =
                    ["f32-near-tie", "f32-tie", "f32-fan", "f32-denormal", "f64-near-tie"];
                let must_fall_back = in_doubt.contains(&f.family.as_str());
                assert!(
                    !must_fall_back || e.decisions.by_fallback > 0,
                    "{} {}: the exact path was never taken",
                    f.family,
                    e.actual
                );
            }
        }
        assert!(verdict.agrees() && verdict.failures.is_empty());
        let sum = |count: fn(&FamilyReport) -> u64| verdict.families.iter().map(count).sum::<u64>();
        assert!(4 * sum(|f| f.tie_cases) >= sum(|f| f.cases), "a quarter of the cases has a tie");
        assert!(20 * sum(|f| f.empty_cases) >= sum(|f| f.cases), "one in twenty is empty");
    }
}

#[test]
fn families_f32_hold_f32_only_and_f64_more() {
    for family in FAMILIES {
        let px: Vec<f64> = (0..200)
            .flat_map(|index| family.case(3, index).free_corners().to_vec())
            .flat_map(|t| t.px())
            .flatten()
            .collect();
        let all_f32 = px.iter().all(|&v| f64::from(v as f32) == v);
        assert_eq!(all_f32, family.name.starts_with("f32-"), "{}", family.name);
        assert_eq!(family.case(3, 7), family.case(3, 7));
        assert_ne!(family.case(3, 7), family.case(4, 7), "{}", family.name);
    }
    let tiling = |name: &str| {
        let family = FAMILIES.iter().find(|f| f.name == name).expect("a family");
        (0..100).filter(|&index| is_tiling(&family.case(3, index))).count()
    };
    assert_eq!(tiling("f32-fan"), 100);
    assert!(tiling("f32-cut") > 90);
}

#[test]
fn vertex_order_leaves_no_trace() {
    for family in FAMILIES {
        for index in 0..60 {
            let original = family.case(11, index);
            let target = hits(ExactEngine::Oracle, &original);
            for order in [[1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]] {
                let turn = |t: &FreeCorners| free(order.map(|i| t.px()[i]));
                let turned = original.free_corners().iter().map(turn).collect();
                let turned = Case::unsnapped(original.window, turned);
                for engine in ALL {
                    let actual = drawn(engine, &turned);
                    assert!(
                        actual == target,
                        "{} {}#{index} {order:?}",
                        engine.name(),
                        family.name
                    );
                }
            }
        }
    }
}

/// Every planted fault is caught, by the families it is about, and the failure repeats.
#[test]
fn mutants_die() {
    let about = |mutant| match mutant {
        // Plain f64 is right for f32 corners of similar size: the differences are exact, the
        // products have 48 bits. Only f64 corners and mixed exponents show the fault.
        ExactMutant::PlainF64 | ExactMutant::PlainCrossing => "f64-near-tie",
        ExactMutant::FilterTooSmall => "f64-near-tie",
        ExactMutant::PlainF32 | ExactMutant::SnapsInside => "f32-near-tie",
        ExactMutant::FlushesToZero => "f32-denormal",
        ExactMutant::InclusiveTies | ExactMutant::BottomRightTies => "f32-tie",
    };
    for mutant in ExactMutant::ALL {
        let engine = ExactEngine::Mutant(mutant);
        let verdict = EnginesToJudge::from(engine).judge(&options(1, 400), &|_| ());
        let killers: BTreeSet<_> = verdict
            .families
            .iter()
            .filter(|f| f.pairs[0].wrong_cases > 0)
            .map(|f| f.family.as_str())
            .collect();
        println!("{:<26} caught by {killers:?}", engine.name());
        assert!(!verdict.agrees() && verdict.mismatches() > 0, "{} lives", engine.name());
        assert!(killers.contains(about(mutant)), "{} by {killers:?}", engine.name());
        let failure = verdict.failures.first().expect("a failure is kept");
        let family = FAMILIES.iter().find(|f| f.name == failure.family).expect("its family");
        let found = family.case(failure.seed, failure.index);
        assert!(judge_case(engine, &found).is_wrong(), "{failure}");
        assert!(judge_case(engine, &failure.case).is_wrong(), "{failure}");
        assert_eq!(failure.case.free_corners().len(), 1, "shrunk: {failure}");
    }
}

/// Corners at the borders of the domain, and windows there.
#[test]
fn the_edge_of_the_domain() {
    let (low, high) = (-8_388_608.0, 8_388_608.0_f64.next_down());
    let far = [[low, low], [high, low], [low, high]];
    let corner = |x0: i32, y0: i32| PixelRect { x0, y0, x1: x0 + 16, y1: y0 + 16 };
    let edge = 1 << 23;
    let mut covered = 0;
    for window in [
        corner(-edge - 8, -edge - 8),
        corner(edge - 8, -edge - 8),
        corner(-edge - 8, edge - 8),
        corner(edge - 8, edge - 8),
        corner(-8, -8),
    ] {
        for triangle in
            [far, [[low, low], [high, high], [low, high]], [[high, low], [high, high], [low, 0.5]]]
        {
            for engine in ALL {
                covered += hits(engine, &case(window, &[triangle])).covered();
            }
        }
    }
    assert!(covered > 0);
}

#[test]
fn refusals() {
    let with = |v: f64| FreeCorners::new([[0.0, 0.0], [1.0, v], [2.0, 5.0]]).err();
    assert_eq!(with(f64::NAN), Some(Refusal::NotANumber));
    assert_eq!(with(f64::INFINITY), Some(Refusal::Infinite));
    for v in [8_388_608.0, (-8_388_608.0_f64).next_down(), 1e22, -f64::MAX] {
        assert_eq!(with(v), Some(Refusal::OutOfDomain(v)));
    }
    for v in [-8_388_608.0, 8_388_608.0_f64.next_down(), -0.0, f64::from_bits(1), -1e-310] {
        assert_eq!(with(v), None, "{v:e}");
    }
}

fn lattice() -> impl Strategy<Value = [SubpixelPoint; 3]> {
    // Small ones with many ties, and any at all.
    let halves = (-4..20i32, -4..20i32).prop_map(|(x, y)| SubpixelPoint::new(x * 128, y * 128));
    let near = (-1000..5000i32, -1000..5000i32).prop_map(|(x, y)| SubpixelPoint::new(x, y));
    let any = (any::<i32>(), any::<i32>()).prop_map(|(x, y)| SubpixelPoint::new(x, y));
    let point = prop_oneof![4 => halves, 4 => near, 1 => any];
    prop::array::uniform3(point)
}

proptest! {
    /// On the lattice nothing is snapped, so all five engines draw the same.
    #[test]
    fn on_the_lattice_they_are_the_lattice_engines(corners in lattice()) {
        let window = PixelRect { x0: -2, y0: -2, x1: 16, y1: 16 };
        let list = [corners];
        let targets = [hits_of(&Scanline, &list, window), hits_of(&EdgeFunction, &list, window)];
        let case = Case::unsnapped(window, vec![corners.into()]);
        for engine in ALL {
            let actual = drawn(engine, &case);
            for target in &targets {
                prop_assert!(&actual == target, "{} on {corners:?}", engine.name());
            }
        }
    }

    /// Any finite bit pattern in the domain: no panic, and the oracle's pixels.
    #[test]
    fn any_bits_in_the_domain(bits in prop::array::uniform6(any::<u64>()), near in 0..4usize) {
        let value = |i: usize| {
            let v = f64::from_bits(bits[i]);
            // Fold what is too large or not a number into the neighbourhood of the window.
            if v.abs() < 8_388_608.0 { v } else { (bits[i] % 4096) as f64 / 128.0 - 8.0 }
        };
        let mut px = [[value(0), value(1)], [value(2), value(3)], [value(4), value(5)]];
        if near < 3 {
            px[near] = [7.5, 3.5];
        }
        let whole = case(PixelRect { x0: -8, y0: -8, x1: 24, y1: 24 }, &[px]);
        for engine in ExactEngine::JUDGED {
            let finding = judge_case(engine, &whole);
            prop_assert!(!finding.is_wrong(), "{}: {} on {px:?}", engine.name(), finding.describe());
        }
    }
}
