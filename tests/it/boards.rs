//! The boards of `docs/cost.md` are those that were recorded in `docs/cost.json`, and not older than the code that they time.
//!
//! To measure again: `cargo run --release -- cost --json > target/cost.json`, then
//! `RASTERPROOF_BOARDS=target/cost.json cargo test --test it boards`, which records it with the digest of the code, and then
//! the same with `RASTERPROOF_RENEW=1`.

use std::fs;

use rasterproof_precision::cost::{Board, Recorded};
use rasterproof_report::table::Table;
use rasterproof_report::text;
use rasterproof_study::report::board;
use sha2::{Digest as _, Sha256};

use crate::pages::{Renewal, files, page, read, root};

/// Where what the boards time is written: the choices, the engines among them, the scenes that they draw, and the clock.
const TIMED: [&str; 15] = [
    "crates/core/src/line",
    "crates/core/src/raster",
    "crates/tiles/src/coverage",
    "crates/tiles/src/frames/planes.rs",
    "crates/precision/src/ladder",
    "crates/precision/src/cost/antialiasing.rs",
    "crates/precision/src/cost/clock.rs",
    "crates/precision/src/cost/coverage.rs",
    "crates/precision/src/cost/depth.rs",
    "crates/precision/src/cost/interpolation.rs",
    "crates/precision/src/cost/levels.rs",
    "crates/precision/src/cost/lines.rs",
    "crates/precision/src/cost/scene.rs",
    "crates/precision/src/cost/shadow.rs",
    "crates/precision/src/cost/tiles.rs",
];

/// The code of a file, without its tests and its comments, which take no time.
fn code(text: &str) -> String {
    let text = text.split("\n#[cfg(test)]").next().unwrap_or("");
    let lines = text.lines().map(str::trim);
    lines.filter(|line| !line.starts_with("//")).collect::<Vec<_>>().join(" ")
}

fn digest() -> String {
    let mut hash = Sha256::new();
    for place in TIMED {
        let path = root().join(place);
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

/// A page with the tables that were recorded for a board, those that it shows above the plot of the board.
fn renewed(page: &str, board: &Board) -> String {
    let plot = format!("{}.svg)", board::plot_name(board.ladder));
    let end = page.find(&plot).unwrap_or_else(|| panic!("no plot {plot}"));
    let start = page[..end].rfind(".svg)").unwrap_or(0);
    let mut section = page[start..end].to_owned();
    let mut found = 0;
    for table in board::tables(board) {
        // On a page the heading has the name of the group.
        let caption = table.caption.trim_start_matches(&format!("{}: ", board.ladder.title()));
        // The number of rounds is another one each time, and a long caption goes on in the next line.
        let begin = caption.split(" median of").next().unwrap_or(caption);
        let begin: String = begin.chars().take(60).collect();
        let Some(at) = section.find(&begin) else { continue };
        let table = Table { caption: caption.to_owned(), notes: Vec::new(), ..table.clone() };
        let shown = text::tables(&[table], text::WIDTH, false);
        // The rows of a page are not further in than its captions.
        let flush = |line: &str| line.strip_prefix("  ").unwrap_or(line).trim_end().to_owned();
        let shown: Vec<String> = shown.trim_end().lines().map(flush).collect();
        let old = section[at..].find("\n\n").into_iter().chain(section[at..].find("\n```")).min();
        section.replace_range(at..at + old.expect("an end"), &shown.join("\n"));
        found += 1;
    }
    assert!(found > 0, "{plot}: no table");
    format!("{}{section}{}", &page[..start], &page[end..])
}

#[test]
fn boards_are_those_that_were_recorded() {
    let recorded = Recorded::read(&read(RECORD)).unwrap();
    let mut renewal = Renewal::default();
    for folder in ["docs", "docs/zh"] {
        let renewed =
            recorded.boards.iter().fold(page(folder, "cost"), |page, board| renewed(&page, board));
        renewal.is(format!("{folder}/cost.md"), &renewed);
    }
    for (name, figure) in board::plots(&recorded.boards) {
        renewal.is(format!("docs/{name}.svg"), &figure.svg);
    }
    renewal.check("boards_are_those");
}
