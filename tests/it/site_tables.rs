//! The site that `docs/build` leaves in `target/site` has the tables that the program prints. What else it has to be is checked in
//! `tests/pages/site`.

use std::fs;

use crate::pages::{Renewal, read, root, text_block};
use crate::program::shared;

/// What two pages show is what the program printed when the site was built, and the repository has it so too, the tables in a file
/// beside the pages.
/// `RASTERPROOF_RENEW=1 cargo test --test it site_tables -- --ignored` writes them there.
#[test]
#[ignore = "needs docs/build"]
fn site_tables_are_printed() {
    let site = root().join("target/site");
    assert!(site.is_dir(), "no {}: run docs/build", site.display());
    let mut renewal = Renewal::default();
    for name in ["differential", "planted"] {
        let mut shown = Vec::new();
        for book in ["en", "zh"] {
            let page = fs::read_to_string(site.join(format!("{book}/{name}.html"))).unwrap();
            let (_, block) = page.split_once("<code class=\"language-text").unwrap();
            let block = block.split_once('>').unwrap().1.split_once("</code>").unwrap().0;
            let block = block
                .replace("&gt;", ">")
                .replace("&lt;", "<")
                .replace("&quot;", "\"")
                .replace("&#x27;", "'");
            let path = if book == "en" { "docs" } else { "docs/zh" };
            let path = format!("{path}/{name}.md");
            let block = block.replace("&amp;", "&");
            let (before, tables) = block.split_once("\nWrong pixels").unwrap_or((&block, ""));
            let mut own = read(&path);
            own.replace_range(text_block(&own), before);
            renewal.is(&path, &own);
            if !tables.is_empty() {
                renewal.is(format!("docs/{name}.txt"), &block);
            }
            shown.push(block);
        }
        assert_eq!(shown[0], shown[1], "{name}");
        assert_eq!(shown[0].contains("\nWrong pixels"), name == "differential");
        if name == "planted" {
            continue; // It has no rows.
        }
        // A family that is run again has the row of the page; with another seed it has not.
        let cells = |row: &str| row.split_whitespace().collect::<Vec<_>>().join(" ");
        let row = |seed: &str| {
            let words = format!("verify --table --family half-integer --cases 20000 --seed {seed}");
            let printed = shared().run(words).out;
            cells(
                printed
                    .lines()
                    .find(|line| line.trim_start().starts_with("half-integer "))
                    .unwrap(),
            )
        };
        let rows: Vec<_> = shown[0].lines().map(cells).collect();
        assert!(rows.contains(&row("1")) && !rows.contains(&row("2")), "{name}: {}", row("1"));
    }
    renewal.check("site_tables -- --ignored");
}
