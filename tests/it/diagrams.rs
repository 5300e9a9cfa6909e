//! The diagrams of the pages are what the program draws, byte for byte.

use std::fs;
use std::path::PathBuf;

use rasterproof_report::diagram::ALL;

const RENEW: &str = "RASTERPROOF_RENEW";

/// `RASTERPROOF_RENEW=1 cargo test --test it diagrams_are` writes them anew.
#[test]
fn diagrams_are_what_is_drawn() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/figures");
    let mut stale = Vec::new();
    for diagram in ALL {
        let path = folder.join(format!("{}.svg", diagram.name));
        let drawn = (diagram.draw)();
        // A file that is not there is as stale as one that differs.
        if fs::read_to_string(&path).ok().as_ref() == Some(&drawn) {
            continue;
        }
        if std::env::var_os(RENEW).is_some() {
            fs::create_dir_all(&folder).unwrap();
            fs::write(&path, drawn).unwrap();
        }
        stale.push(diagram.name);
    }
    assert!(
        stale.is_empty(),
        "stale, renew with `{RENEW}=1 cargo test --test it diagrams_are`: {}",
        stale.join(", ")
    );
}

/// Every diagram stands on a page, reads in the dark, and has its labels as text.
#[test]
fn diagrams_stand_on_pages() {
    let docs = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs");
    let pages: String = fs::read_dir(&docs)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .map(|path| fs::read_to_string(path).unwrap())
        .collect();
    for diagram in ALL {
        let svg = (diagram.draw)();
        assert!(pages.contains(&format!("](figures/{}.svg)", diagram.name)), "{}", diagram.name);
        assert!(
            svg.contains("prefers-color-scheme:dark") && svg.contains("<text"),
            "{}",
            diagram.name
        );
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", diagram.name);
    }
}
