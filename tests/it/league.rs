//! The league: its pages hold the tables of its data, and its command skips what is not installed.

use std::fs;

use rasterproof_judge::league::League;
use rasterproof_report::league::tables;

use crate::pages::read;
use crate::program::{Folder, PROGRAM};

/// Where a page does not hold the tables, the first line that differs is shown.
fn missing(page: &str, tables: &str) -> Option<String> {
    tables.lines().find(|line| !page.lines().any(|own| own == *line)).map(str::to_owned)
}

#[test]
fn league_pages_hold_its_data() {
    let mut league: League = serde_json::from_str(&read("docs/league.json")).unwrap();
    assert!(league.rows.len() >= 5, "{}", league.rows.len());
    for (page, chinese) in [("docs/wild.md", false), ("docs/zh/wild.md", true)] {
        let text = read(page);
        assert_eq!(missing(&text, &tables(&league, chinese)), None, "{page}");
        assert!(text.contains(&tables(&league, chinese)), "{page}: lines in another order");
    }
    // Another number is noticed.
    league.rows[0].orders = [7, 3];
    assert!(missing(&read("docs/wild.md"), &tables(&league, false)).is_some());
}

#[test]
fn league_needs_adapters() {
    let folder = Folder::new("league");
    fs::create_dir(folder.join("adapters")).unwrap();
    let path = folder.join("adapters/league.json");
    folder.run("judge --league").has(2).says("adapters/league.json");
    let list = serde_json::json!([
        {"name": "gone", "library": "x", "call": "y", "command": ["./there-is-no-such-program"]},
        {"name": "own", "library": "rasterproof", "call": "Rasterize::cover",
         "command": [PROGRAM, "engine", "games101-strict"]},
    ]);
    fs::write(&path, list.to_string()).unwrap();
    folder
        .run("judge --cases 8 --league")
        .has(0)
        .prints("gone")
        .prints("skipped: cannot be started");
    let json = fs::read_to_string(folder.join("target/rasterproof/league.json")).unwrap();
    let league: League = serde_json::from_str(&json).unwrap();
    let row = &league.rows[0];
    let triangles = row.triangles.as_ref().unwrap();
    assert!(
        row.name == "own" && triangles.sentence.contains("draws nothing on an edge"),
        "{row:?}"
    );
    assert!(row.meshes[1] > 0 && triangles.as_declared.wrong > 0, "{row:?}");
    folder.run("judge --league gone").has(2).says("no adapter is installed");
    folder.run("judge --league nobody").has(2).says("is no adapter");
}
