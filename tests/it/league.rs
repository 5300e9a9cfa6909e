//! The league: its pages hold the tables of its data, and its command skips what is not installed.

use std::fs;

use rasterproof_judge::league::League;
use rasterproof_report::league::tables;

use crate::convention::assert_chinese;
use crate::pages::{Renewal, read};
use crate::program::{Folder, PROGRAM};

/// A page with the tables of these data, from the line that says who made them to the next heading.
fn with_tables(page: &str, tables: &str) -> String {
    let first = tables.split("rasterproof").next().unwrap();
    let start = page.find(&format!("\n{first}rasterproof")).expect("a page of the league") + 1;
    let end = start + page[start..].find("\n## ").unwrap();
    [&page[..start], tables, &page[end..]].concat()
}

/// `RASTERPROOF_RENEW=1 cargo test --test it league_pages` writes the tables.
#[test]
fn league_pages_hold_its_data() {
    let mut league: League = serde_json::from_str(&read("docs/league.json")).unwrap();
    assert!(league.rows.len() >= 5, "{}", league.rows.len());
    let mut renewal = Renewal::default();
    for (page, chinese) in [("docs/league.md", false), ("docs/zh/league.md", true)] {
        renewal.is(page, &with_tables(&read(page), &tables(&league, chinese)));
    }
    renewal.check("league_pages");
    for kind in league.rows.iter().flat_map(|row| [&row.triangles, &row.lines]).flatten() {
        if !kind.sentence.is_empty() {
            assert_chinese(&kind.sentence);
        }
        if let Some(does) = &kind.mistake {
            assert_chinese(&format!("{does}."));
        }
    }
    // Another number is noticed.
    league.rows[0].orders = [7, 3];
    let page = read("docs/league.md");
    assert_ne!(with_tables(&page, &tables(&league, false)), page);
}

#[test]
fn league_needs_adapters() {
    let folder = Folder::new("league");
    fs::create_dir(folder.join("adapters")).unwrap();
    let path = folder.join("adapters/league.json");
    let list = serde_json::json!([
        {"name": "gone", "library": "x", "call": "y", "command": ["./there-is-no-such-program"]},
        {"name": "own", "library": "rasterproof", "call": "Rasterize::cover",
         "command": [PROGRAM, "engine", "games101-strict"]},
        {"name": "wrong", "library": "rasterproof", "call": "DrawLine::draw",
         "command": [PROGRAM, "engine", "sysu-bresenham"]},
    ]);
    fs::write(&path, list.to_string()).unwrap();
    folder
        .run("judge --cases 8 --league")
        .has(0)
        .prints("gone")
        .prints("skipped: cannot be started");
    let json = fs::read_to_string(folder.join("target/rasterproof/league.json")).unwrap();
    let mut league: League = serde_json::from_str(&json).unwrap();
    let row = &league.rows[0];
    let triangles = row.triangles.as_ref().unwrap();
    assert!(
        row.name == "own" && triangles.sentence.contains("draws nothing on an edge"),
        "{row:?}"
    );
    assert!(row.meshes[1] > 0 && triangles.as_declared.wrong > 0, "{row:?}");
    let mistake = |row: usize| Some(league.rows[row].lines.as_ref()?.mistake.as_ref()?.as_str());
    assert_eq!(mistake(0), None);
    assert!(mistake(1).unwrap().contains("the published algorithm sysu-bresenham"));
    assert!(tables(&league, false).contains("By mistake it draws as the published algorithm"));
    // Where no convention explains it, the mistake that does stands alone.
    let lines = league.rows[1].lines.as_mut().unwrap();
    (lines.by_convention, lines.sentence) = (None, "unexplained.".to_owned());
    for (chinese, first, unexplained, by_mistake) in [
        (false, "Lines: By mistake it draws as", "unexplained.", "| a mistake |"),
        (true, "直线：它错在：", "未能解释。", "| 已知的错误 |"),
    ] {
        let page = tables(&league, chinese);
        assert!([first, by_mistake].iter().all(|said| page.contains(said)), "{page}");
        assert!(!page.contains(unexplained), "{page}");
    }
}
