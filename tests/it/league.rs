//! The league: its pages hold the tables of its data, and its command skips what is not installed.

use std::fs;
use std::path::Path;
use std::process::Command;

use rasterproof_judge::league::League;
use rasterproof_report::league::tables;

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

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
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("league");
    fs::create_dir_all(folder.join("adapters")).unwrap();
    let run = |words: &[&str]| {
        let program = env!("CARGO_BIN_EXE_rasterproof");
        let output = Command::new(program).args(words).current_dir(&folder).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let path = folder.join("adapters/league.json");
    let _ = fs::remove_file(&path);
    let (status, _, errors) = run(&["judge", "--league"]);
    assert!(status == Some(2) && errors.contains("adapters/league.json"), "{errors}");
    let list = serde_json::json!([
        {"name": "gone", "library": "x", "call": "y", "command": ["./there-is-no-such-program"]},
        {"name": "own", "library": "rasterproof", "call": "Rasterize::cover",
         "command": [env!("CARGO_BIN_EXE_rasterproof"), "engine", "games101-strict"]},
    ]);
    fs::write(&path, list.to_string()).unwrap();
    let (status, out, errors) = run(&["judge", "--cases", "8", "--league"]);
    assert_eq!(status, Some(0), "{out}{errors}");
    assert!(out.contains("gone") && out.contains("skipped: cannot be started"), "{out}");
    let json = fs::read_to_string(folder.join("target/rasterproof/league.json")).unwrap();
    let league: League = serde_json::from_str(&json).unwrap();
    let row = &league.rows[0];
    let triangles = row.triangles.as_ref().unwrap();
    assert!(
        row.name == "own" && triangles.sentence.contains("draws nothing on an edge"),
        "{row:?}"
    );
    assert!(row.meshes[1] > 0 && triangles.as_declared.wrong > 0, "{row:?}");
    let (status, _, errors) = run(&["judge", "--league", "gone"]);
    assert!(status == Some(2) && errors.contains("no adapter is installed"), "{errors}");
    let (status, _, errors) = run(&["judge", "--league", "nobody"]);
    assert!(status == Some(2) && errors.contains("is no adapter"), "{errors}");
}
