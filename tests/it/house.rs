//! The house rules: who may import whom, what every file begins with, what the docs name.
//!
//! The floors are read from the table in `docs/ARCHITECTURE.md`, so the page cannot drift from the
//! code: a room imports only from lower floors, or from its own room.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Rooms and their floors, from rows like "| 2 | `raster/scanline`, `raster/edge_function` | job |".
fn floors(page: &str) -> HashMap<String, u32> {
    let mut floors = HashMap::new();
    for line in page.lines() {
        let cells: Vec<_> = line.split('|').map(str::trim).collect();
        let Some(floor) = cells.get(1).and_then(|cell| cell.parse::<u32>().ok()) else { continue };
        for room in cells[2].split(',') {
            floors.insert(room.trim().trim_matches('`').to_owned(), floor);
        }
    }
    floors
}

/// The room of a module path such as `raster::scanline::Scanline`: the longest listed prefix.
fn room_of(path: &str, floors: &HashMap<String, u32>) -> Option<String> {
    let parts: Vec<_> = path.split("::").collect();
    (1..=parts.len()).rev().map(|n| parts[..n].join("/")).find(|room| floors.contains_key(room))
}

/// What a file imports from the crate, `use crate::{a, b::c}` taken apart.
fn imports(text: &str) -> Vec<String> {
    let flat =
        text.lines().map(|l| l.split("//").next().unwrap_or("")).collect::<Vec<_>>().join(" ");
    let mut found = Vec::new();
    for (at, _) in flat.match_indices("crate::") {
        let rest = &flat[at + "crate::".len()..];
        let end =
            rest.find(|c: char| !(c.is_alphanumeric() || "_:".contains(c))).unwrap_or(rest.len());
        let head = rest[..end].trim_end_matches(':');
        if rest[end..].starts_with('{') {
            let mut depth = 0;
            let close = rest[end..].find(|c| {
                depth += i32::from(c == '{') - i32::from(c == '}');
                depth == 0
            });
            let group = &rest[end + 1..end + close.expect("a group is closed")];
            // Only the outermost names matter.
            let mut depth = 0;
            for item in group.split(|c| {
                depth += i32::from(c == '{') - i32::from(c == '}');
                c == ',' && depth == 0
            }) {
                let name = item.trim().split(['{', ' ']).next().unwrap_or("").trim_end_matches(':');
                if !name.is_empty() {
                    found.push(
                        [head, name]
                            .iter()
                            .filter(|p| !p.is_empty())
                            .copied()
                            .collect::<Vec<_>>()
                            .join("::"),
                    );
                }
            }
        } else {
            found.push(head.to_owned());
        }
    }
    found
}

/// Breaches of the floors by one file.
fn breaches(name: &str, text: &str, floors: &HashMap<String, u32>) -> Vec<String> {
    let module = name.trim_end_matches(".rs").trim_end_matches("/mod").replace('/', "::");
    let Some(room) = room_of(&module, floors) else {
        return vec![format!("{name} is not listed in docs/ARCHITECTURE.md")];
    };
    let mut wrong = Vec::new();
    if !text.starts_with("//! ") {
        wrong.push(format!("{name} does not open with a `//!` line that says what it is"));
    }
    for import in imports(text) {
        let Some(from) = room_of(&import, floors) else { continue };
        let family = |room: &str| room.split('/').next().unwrap_or("").to_owned();
        // A child may use its own room's root; siblings under one room are strangers unless listed together.
        let own = from == room
            || (floors[&from] == floors[&room] && room.starts_with(&format!("{from}/")));
        if !own && floors[&from] >= floors[&room] {
            wrong.push(format!(
                "{name} ({room}, floor {}) imports {import} ({from}, floor {}, family {})",
                floors[&room],
                floors[&from],
                family(&from)
            ));
        }
    }
    wrong
}

#[test]
fn house_floors_are_kept() {
    let floors = floors(&fs::read_to_string(root().join("docs/ARCHITECTURE.md")).unwrap());
    let src = root().join("src");
    let mut wrong = Vec::new();
    for path in files(&src, "rs") {
        let name = path.strip_prefix(&src).unwrap().to_str().unwrap().replace('\\', "/");
        if name != "lib.rs" {
            wrong.extend(breaches(&name, &fs::read_to_string(&path).unwrap(), &floors));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    for room in floors.keys() {
        let exists = src.join(room).is_dir() || src.join(format!("{room}.rs")).is_file();
        assert!(exists, "docs/ARCHITECTURE.md lists {room}, which does not exist");
    }
}

/// The rule can fail: each kind of breach is found in a file that commits it.
#[test]
fn house_breaches_are_found() {
    let floors = floors(
        "| 0 | `grid` | x |\n| 2 | `raster/scanline`, `raster/edge_function`, `raster` | x |\n| 4 | `lineup` | x |",
    );
    let text = "//! ok\nuse crate::raster::edge_function::Edge;\nuse crate::{grid, lineup::{Engine, find}};\n";
    let wrong = breaches("raster/scanline.rs", text, &floors);
    assert_eq!(wrong.len(), 2, "{wrong:?}");
    assert!(wrong[0].contains("raster/edge_function") && wrong[1].contains("lineup"));
    assert_eq!(breaches("raster/scanline.rs", "use crate::grid;", &floors).len(), 1, "no opening");
    assert_eq!(breaches("util.rs", "//! drawer\n", &floors).len(), 1, "not listed");
    assert!(breaches("raster/scanline.rs", "//! ok\nuse crate::grid::snap;", &floors).is_empty());
}

/// Links in the docs and the README lead somewhere.
#[test]
fn house_links_lead_somewhere() {
    let mut pages = files(&root().join("docs"), "md");
    pages.push(root().join("README.md"));
    let mut broken = Vec::new();
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        for (at, _) in text.match_indices("](") {
            let link = text[at + 2..].split([')', ' ', '#']).next().unwrap_or("");
            if link.is_empty() || link.contains("://") {
                continue;
            }
            if !page.parent().unwrap().join(link).exists() {
                broken.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Tests, commands and cases that the docs name in backticks exist.
#[test]
fn house_docs_name_what_exists() {
    let mut pages = files(&root().join("docs"), "md");
    pages.push(root().join("README.md"));
    let families: Vec<_> = rasterproof::hazard::families().map(|f| f.name).collect();
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        for (at, _) in text.match_indices("--family ") {
            let name = text[at + 9..].split([' ', '`', '\n', ')']).next().unwrap_or("");
            assert!(
                name == "NAME" || families.contains(&name),
                "{}: family {name}",
                page.display()
            );
        }
        for (at, _) in text.match_indices("`tests/") {
            let file = text[at + 1..].split(['`', ' ']).next().unwrap_or("");
            assert!(root().join(file).exists(), "{}: {file}", page.display());
        }
    }
}
