//! `rasterproof tolerances`: the page holds what the command prints, and its plot.

use std::fs;

use rasterproof_invariants::acceptance::rules::RULES;

use crate::pages::{Renewal, read, text_block};
use crate::program::Folder;

const PAGES: [&str; 2] = ["docs/tolerances.md", "docs/zh/tolerances.md"];

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

/// `RASTERPROOF_RENEW=1 cargo test --test it tolerances_pages -- --ignored` writes the plot and the answer.
#[test]
#[ignore = "draws every fault and judges it by every rule"]
fn tolerances_pages_hold_what_the_command_prints() {
    let folder = Folder::new("tolerances-page");
    let printed = folder.run("tolerances --plot shares.svg").has(0).out;
    // The pages have the answer; the plot has the shares of the tables that follow it.
    let (shown, _) = printed.split_once("\nscenes such as").unwrap();
    let mut renewal = Renewal::default();
    let plot = fs::read_to_string(folder.join("shares.svg")).unwrap();
    renewal.is("docs/tolerances.svg", &plot);
    for page in PAGES {
        let mut text = read(page);
        text.replace_range(text_block(&text), shown);
        renewal.is(page, &text);
    }
    renewal.check("tolerances_pages -- --ignored");
}
