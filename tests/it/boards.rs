//! The plots of `docs/cost.md` are those of the boards in `docs/cost.json`, which are not older than the code that they time.
//!
//! To measure again: `cargo run --release -- cost --json > target/cost.json`, then
//! `RASTERPROOF_BOARDS=target/cost.json cargo test --test it boards`, which records it with the digest of the code, and then
//! the same with `RASTERPROOF_RENEW=1`.

use std::fs;

use rasterproof_precision::cost::Recorded;
use rasterproof_study::report::board;
use sha2::{Digest as _, Sha256};

use crate::pages::{Renewal, files, read, root};
use crate::program::table;

/// The code of a file, without its tests and its comments, which take no time.
fn code(text: &str) -> String {
    let text = text.split("\n#[cfg(test)]").next().unwrap_or("");
    let lines = text.lines().map(str::trim);
    lines.filter(|line| !line.starts_with("//")).collect::<Vec<_>>().join(" ")
}

fn digest() -> String {
    let mut hash = Sha256::new();
    for place in table::<1>("timed").concat() {
        let path = root().join(&place);
        let sources = if path.is_dir() { files(&path, ".rs") } else { vec![path] };
        assert!(!sources.is_empty(), "{place}");
        for source in sources {
            hash.update(code(&fs::read_to_string(source).unwrap()));
        }
    }
    hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
}

const RECORD: &str = "docs/cost.json";

/// A board that is older than the code that it times is measured again.
#[test]
fn boards_are_not_older_than_the_code_that_they_time() {
    if let Some(measured) = std::env::var_os("RASTERPROOF_BOARDS") {
        let mut boards: serde_json::Value = serde_json::from_str(&read(measured)).unwrap();
        for derived in ["verdicts", "price_of_exact_coverage"] {
            boards.as_object_mut().unwrap().remove(derived);
        }
        boards["timed"] = digest().into();
        fs::write(root().join(RECORD), boards.to_string() + "\n").unwrap();
    }
    let boards: serde_json::Value = serde_json::from_str(&read(RECORD)).unwrap();
    assert_eq!(boards["timed"], digest(), "{}", include_str!("boards.rs").lines().nth(2).unwrap());
}

#[test]
fn code_is_without_tests_and_comments() {
    let text = "//! a\n\nfn f() {\n    // b\n    g(); // c\n}\n\n#[cfg(test)]\nmod tests {}\n";
    assert_eq!(code(text), " fn f() { g(); // c }");
}

#[test]
fn boards_are_those_that_were_recorded() {
    let recorded = Recorded::read(&read(RECORD)).unwrap();
    let mut renewal = Renewal::default();
    for (name, figure) in board::plots(&recorded.boards) {
        renewal.is(format!("docs/{name}.svg"), &figure.svg);
    }
    renewal.check("boards_are_those");
}
