//! The page of the rules by which everything is judged is computed from their table.

use std::fmt::Write as _;

use rasterproof_verify::comparison::Rule;
use rasterproof_verify::specification::{GDAL, OPENGL_ES, Source, VULKAN, WEBGPU, declared};

use crate::pages::{Renewal, read};

fn sources() -> [Source; 5] {
    [VULKAN, OPENGL_ES, WEBGPU, GDAL, declared(Rule::TopLeft)]
}

/// A section for each source.
fn sections(chinese: bool) -> String {
    let (version, head) = match chinese {
        true => ("版本", "什么 | 出处 | 要求 | 不作规定"),
        false => ("Version", "what | where | asks for | leaves open"),
    };
    let mut out = String::new();
    for source in sources() {
        let of = if chinese { source.chinese } else { source.version };
        let _ = write!(
            out,
            "\n## {}\n\n{version}: {of}.\n\n| {head} |\n|---|---|---|---|\n",
            source.title
        );
        for clause in source.clauses() {
            let english = [clause.name, clause.says, clause.open];
            let [name, says, open] = if chinese { clause.chinese } else { english };
            let _ = writeln!(out, "| {name} | {} | {says} | {open} |", clause.section);
        }
    }
    out
}

/// `RASTERPROOF_RENEW=1 cargo test --test it rules_` writes the tables.
#[test]
fn rules_are_those_of_the_table() {
    let mut renewal = Renewal::default();
    for (page, chinese) in [("docs/rules.md", false), ("docs/zh/rules.md", true)] {
        let text = read(page);
        let (first, last) = (text.find("\n## ").unwrap(), text.rfind("\n## ").unwrap());
        renewal.is(page, &[&text[..first], &sections(chinese), &text[last..]].concat());
    }
    renewal.check("rules_");
}

/// Every row belongs to a source and can be found; what a judge goes by is in it.
#[test]
fn rules_have_a_source_each() {
    let rows = read("crates/verify/src/specification/clauses.md");
    let rows = rows.lines().filter(|line| line.starts_with("| ")).count() - 2;
    assert_eq!(sources().iter().map(|source| source.clauses().count()).sum::<usize>(), rows);
    for (word, rule) in Rule::ALL {
        let (source, clause) = (declared(rule), declared(rule).clause(word));
        assert!(source.edges == rule && !clause.says.is_empty(), "{word}");
    }
}
