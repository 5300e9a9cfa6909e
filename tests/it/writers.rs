//! A command makes a `Report`, and three writers turn it into text, JSON and a page. Nothing else lays out columns, makes JSON,
//! HTML or colours.

use crate::pages::{files, root};
use crate::program::table;

/// Whether a line of code lays out columns, makes JSON or HTML, or colours.
fn formats(line: &str) -> bool {
    let holes = line.split('{').skip(1).filter_map(|rest| rest.split('}').next());
    let pads =
        |hole: &str| hole.split_once(':').is_some_and(|(_, how)| how.starts_with(['<', '>', '^']));
    let words = [
        "json!(",
        "to_string_pretty(",
        "serde_json::to_string(",
        "\\x1b[",
        "<td",
        "<p>",
        "<h1",
        "</",
    ];
    line.contains('"') && { holes }.any(pads) || words.iter().any(|word| line.contains(word))
}

fn count(text: &str) -> usize {
    let code = text.split("#[cfg(test)]").next().unwrap_or("");
    code.lines().filter(|line| !line.trim_start().starts_with("//") && formats(line)).count()
}

#[test]
fn nothing_formats_outside_the_writers() {
    let writers = table::<1>("writers").concat();
    let mut found = Vec::new();
    for crate_name in ["..", "report", "study", "teaching", "program", "vulkan"] {
        for path in files(&root().join("crates").join(crate_name).join("src"), ".rs") {
            let name = path.strip_prefix(root()).unwrap().to_str().unwrap();
            let lines = count(&std::fs::read_to_string(&path).unwrap());
            if lines > 0 && !writers.iter().any(|writer| writer == name) {
                found.push(format!("{name}: {lines}"));
            }
        }
    }
    assert!(found.is_empty(), "lines that format; make a Report instead: {}", found.join(", "));
}

#[test]
fn a_line_that_formats_is_found() {
    for line in [
        "writeln!(out, \"{name:<19} {}\", x)?;",
        "write!(out, \"{:>1$} \", a, b)",
        "let json = serde_json::json!({ \"a\": 1 });",
        "format!(\"<td>{cell}</td>\")",
        "\"\\x1b[32m\"",
    ] {
        assert_eq!(count(line), 1, "{line}");
    }
    for line in ["// {x:<9} and json!(", "format!(\"{x:.1} {y:?}\")", "Some(a) if b < c => {}"] {
        assert_eq!(count(line), 0, "{line}");
    }
}
