//! Planted faults: the harness must report every one of them, or it proves nothing.

use rasterproof::lineup::{Engine, LineEngine};
use rasterproof::mutant::{LineMutant, TriangleMutant};
use rasterproof::verify::{Options, judge_lineup, tolerance};

/// As many cases as `tests/differential.rs` judges, or fewer.
fn options() -> Options {
    Options { cases: 150, ..Options::default() }
}

#[test]
fn every_planted_rasterizer_fault_is_reported() {
    for mutant in TriangleMutant::ALL {
        let engines = [(Engine::Mutant(mutant), tolerance::SCANLINE)];
        let verdict = judge_lineup(&engines, &[], &options(), &|_| ());
        assert!(!verdict.agrees(), "{} survives", mutant.name());
        let failure = verdict.failures.first().expect("a disagreement comes with a case");
        assert!(!failure.what.is_empty() && failure.what != "agrees", "{failure}");
    }
}

#[test]
fn every_planted_line_fault_is_reported() {
    for mutant in LineMutant::ALL {
        let verdict = judge_lineup(&[], &[LineEngine::Mutant(mutant)], &options(), &|_| ());
        assert!(!verdict.agrees(), "{} survives", mutant.name());
        assert!(!verdict.failures.is_empty());
    }
}

/// A wrong tie rule shrinks to a triangle of at most a pixel.
#[test]
fn a_failure_is_shrunk() {
    let engines = [(Engine::Mutant(TriangleMutant::InclusiveEdges), tolerance::SCANLINE)];
    let verdict = judge_lineup(&engines, &[], &options(), &|_| ());
    let text = verdict.failures[0].to_string();
    assert!(text.contains("1 extra on "), "{text}");
    let rasterproof::hazard::Shape::Triangles { list, .. } = &verdict.failures[0].case.shape else {
        panic!("a triangle fails as a triangle")
    };
    let xs = list[0].corners().map(|corner| corner.x);
    assert!(xs.iter().max().unwrap() - xs.iter().min().unwrap() <= 256, "{text}");
}
