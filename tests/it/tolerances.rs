//! `rasterproof tolerances`: the page holds what the command prints, and its plot.

use std::fs;
use std::path::Path;

use rasterproof_invariants::acceptance::rules::RULES;

use crate::pages::read;
use crate::program::Folder;
use crate::quiz::RENEW;

const PAGES: [&str; 2] = ["docs/tolerances.md", "docs/zh/tolerances.md"];
const PLOT: &str = "docs/tolerances.svg";

#[test]
fn tolerances_page_names_every_rule() {
    for page in PAGES {
        let text = read(page);
        for rule in &RULES {
            assert!(text.contains(&format!("| `{}` |", rule.name)), "{page}: {}", rule.name);
        }
    }
    let folder = Folder::new("tolerances");
    folder.run("tolerances --plot shares.png").has(2).says(".svg");
}

#[test]
#[ignore = "draws every fault and judges it by every rule"]
fn tolerances_pages_hold_what_the_command_prints() {
    let folder = Folder::new("tolerances-page");
    let printed = folder.run("tolerances --plot shares.svg").has(0).out;
    let printed = printed.replace("drawn in shares.svg\n", "");
    let write = |page: &str, text: &str| {
        fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join(page), text).unwrap();
    };
    let plot = fs::read_to_string(folder.join("shares.svg")).unwrap();
    let renew = std::env::var_os(RENEW).is_some();
    if renew {
        write(PLOT, &plot);
    }
    assert!(read(PLOT) == plot, "{PLOT} is another; RASTERPROOF_RENEW=1 writes it");
    for page in PAGES {
        let text = read(page);
        let start = text.find("```text\n").unwrap() + "```text\n".len();
        let end = start + text[start..].find("```\n").unwrap();
        if renew {
            let text = format!("{}{printed}{}", &text[..start], &text[end..]);
            write(page, &text);
        } else {
            assert!(text[start..end] == printed, "{page}: RASTERPROOF_RENEW=1 writes the tables");
        }
    }
}
