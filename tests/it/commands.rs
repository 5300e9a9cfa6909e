//! What the command line says of everything that there is. What single commands print is in `tests/transcripts`.

use rasterproof_registry::engines::ExactEngine;
use rasterproof_verify::cases::unsnapped::FAMILIES;

use crate::exact;
use crate::program::check;

/// What stands below the options was laid out by hand, for a usual terminal.
#[test]
fn examples_fit_eighty_columns() {
    for path in crate::pages::files(&crate::pages::root().join("src/cli/help"), ".txt") {
        let text = std::fs::read_to_string(&path).unwrap();
        let wide: Vec<_> = text.lines().filter(|line| line.chars().count() > 80).collect();
        assert!(wide.is_empty(), "{}: {wide:#?}", path.display());
    }
}

#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn inspect_explains_named_cases() {
    for named in rasterproof_registry::named::named() {
        let out = check(["inspect", named.name], 0).out;
        assert!(out.starts_with(&format!("✓ {}: ", named.name)), "{out}");
    }
}

/// Planted faults, and what there is off the grid, are named and explained where one would look for them.
#[test]
fn everything_is_listed() {
    let out = check("list", 0).out;
    for name in exact::ALL.iter().map(ExactEngine::name).chain(FAMILIES.iter().map(|f| f.name)) {
        assert!(out.lines().any(|line| line.split_whitespace().next() == Some(name)), "{name}");
    }
    for (name, about) in rasterproof_faults::planted::all() {
        assert!(out.lines().any(|line| line.contains(name) && line.contains(about)), "{name}");
    }
}
