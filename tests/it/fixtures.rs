//! The file of fixtures for other test suites: it is what the command prints, its schema describes it, right engines pass
//! it, and it kills every planted fault that its pictures can show.

use std::collections::BTreeMap;

use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_registry::fixtures::{Drawer, FORMAT, Fault, Fixtures, POLYGONS, QUOTAS, generate};
use serde_json::Value;

use crate::json_schema::violation;
use crate::pages::read;
use crate::program::table;

pub(crate) fn fixtures() -> Fixtures {
    serde_json::from_str(&read("crates/verify/fixtures/fixtures.json")).unwrap()
}

#[test]
fn fixtures_are_a_thousand_small_cases() {
    let text = read("crates/verify/fixtures/fixtures.json");
    assert!(text.len() <= 1 << 20, "{} bytes", text.len());
    let fixtures = fixtures();
    assert_eq!((fixtures.cases.len(), fixtures.format.as_str()), (1_000, FORMAT));
    for (kind, quota) in QUOTAS {
        let count = fixtures.cases.iter().filter(|case| case.kind == kind).count();
        assert_eq!(count, quota, "{kind:?}");
    }
    assert_eq!(fixtures.polygons.len(), POLYGONS);
    assert_eq!(fixtures.to_json(), text);
    let with_choices = fixtures.cases.iter().filter(|case| case.expected.len() > 1).count();
    assert!(with_choices > 50, "{with_choices} cases differ by the bits");
}

/// What is expected is computed anew, and the oracle and the engines draw it.
#[test]
fn fixtures_hold_what_is_right() {
    let fixtures = fixtures();
    for (number, case) in fixtures.cases.iter().enumerate() {
        assert_eq!(case.anew(), *case, "case {number}");
        for engine in Engine::CHOICES {
            for line in LineEngine::JUDGED {
                let is_accepted = case.accepts(Drawer::Engines(engine, line));
                assert!(is_accepted, "case {number}: {}", engine.name());
            }
        }
    }
    // A pixel too many is noticed, and one too few.
    let mut case = fixtures.cases[0].clone();
    let last = case.expected.len() - 1;
    let pixels = &mut case.expected[last].samples[0];
    pixels.hit = if pixels.hit.is_empty() { vec![[0, 0, 1]] } else { Vec::new() };
    assert!(!case.accepts(Drawer::Engines(Engine::Scanline, LineEngine::Dda)));
}

#[test]
fn fixtures_kill_planted_faults() {
    let fixtures = fixtures();
    let mut kills: BTreeMap<&str, usize> = BTreeMap::new();
    for fault in Fault::all() {
        let fits = fixtures.cases.iter().filter(|case| case.applies(fault));
        let killed = fits.filter(|case| !case.accepts(Drawer::Fault(fault))).count();
        kills.insert(fault.name(), killed);
    }
    let alive: Vec<_> = kills.iter().filter(|(_, n)| **n == 0).map(|(name, _)| *name).collect();
    let mut expected: Vec<_> = table("not-in-fixtures").into_iter().map(|[name, _]| name).collect();
    expected.sort_unstable();
    assert_eq!(alive, expected, "{kills:?}");
}

#[test]
fn fixtures_follow_their_schema() {
    let schema: Value = serde_json::from_str(&read("crates/verify/fixtures/schema.json")).unwrap();
    let mut file: Value =
        serde_json::from_str(&read("crates/verify/fixtures/fixtures.json")).unwrap();
    assert_eq!(violation(&file, &schema, &schema, ""), None);
    file["cases"][3]["points"][0][0] = "1".into();
    assert!(violation(&file, &schema, &schema, "").is_some());
    file["cases"] = serde_json::json!([{ "kind": "triangle" }]);
    assert!(violation(&file, &schema, &schema, "").unwrap().contains("window"));
}

/// The file is what the command prints; in a release build, since shrinking a thousand cases takes a while.
#[test]
#[ignore = "takes a minute; .ci/run --all runs it"]
fn fixtures_are_what_the_command_prints() {
    let text = read("crates/verify/fixtures/fixtures.json");
    assert!(generate(1, &|_| ()).to_json() == text, "renew it: cargo run --release -- fixtures");
}
