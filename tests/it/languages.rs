//! The two languages of the pages: `docs/zh/` keeps in step with `docs/`.
//!
//! Words are not compared. What surrounds them is: which pages there are, the levels of the headings,
//! the code, the pictures and where the links lead.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The names of the pages that lie in a folder, not below it.
fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.ends_with(".md")).collect()
}

/// The lines of a page outside its fenced code, and its code, each block with its language.
fn split(text: &str) -> (Vec<&str>, Vec<String>) {
    let (mut prose, mut code) = (Vec::new(), Vec::new());
    let mut block: Option<String> = None;
    for line in text.lines() {
        match (&mut block, line.starts_with("```")) {
            (None, false) => prose.push(line),
            (None, true) => block = Some(line.to_owned()),
            (Some(_), true) => code.extend(block.take()),
            (Some(open), false) => {
                let said = if is_comment(line, open) { "comment" } else { line };
                open.push('\n');
                open.push_str(said);
            }
        }
    }
    code.extend(block.map(|open| open + "\nis not closed"));
    (prose, code)
}

/// Whether a line of code is a comment, which may be translated. `block` opens with its language.
fn is_comment(line: &str, block: &str) -> bool {
    let rust = block.starts_with("```rust");
    line.trim_start().starts_with(if rust { "//" } else { "# " })
}

/// The anchors that GitHub gives the headings of a page.
fn anchors(text: &str) -> Vec<String> {
    let headings = split(text).0.into_iter().filter(|line| line.starts_with('#'));
    let words = headings.map(|line| line.trim_start_matches('#').trim().to_lowercase());
    let anchor = |words: String| -> String {
        let kept = words.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    words.map(anchor).collect()
}

/// The file that a link of a page leads to, from the root of the project.
fn resolve(page: &str, file: &str) -> String {
    if file.is_empty() {
        return page.to_owned();
    }
    let mut parts: Vec<_> = page.split('/').collect();
    parts.pop();
    for part in file.split('/') {
        match part {
            ".." => {
                parts.pop();
            }
            "." | "" => {}
            name => parts.push(name),
        }
    }
    parts.join("/")
}

/// Where a link leads, said alike for both languages: pages by their English path, headings by number.
fn target(page: &str, link: &str) -> String {
    if link.contains("://") {
        return link.to_owned();
    }
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let path = resolve(page, file);
    let heading = || {
        let text = fs::read_to_string(root().join(&path)).unwrap_or_default();
        let number = anchors(&text).iter().position(|a| a == anchor);
        number.map_or(format!("#{anchor} (no such heading)"), |n| format!("#{n}"))
    };
    let heading = if anchor.is_empty() { String::new() } else { heading() };
    let in_chinese = page.starts_with("docs/zh/");
    let is_english_page =
        path.strip_prefix("docs/").is_some_and(|name| name.ends_with(".md") && !name.contains('/'));
    match path.strip_prefix("docs/zh/") {
        Some(name) if in_chinese => format!("docs/{name}{heading}"),
        None if in_chinese && is_english_page => format!("{path}{heading} (English)"),
        _ => format!("{path}{heading}"),
    }
}

/// The targets of the links of a page, and of its pictures.
fn targets(page: &str, prose: &[&str]) -> (BTreeSet<String>, Vec<String>) {
    let text = prose.join("\n");
    let (mut links, mut pictures) = (BTreeSet::new(), Vec::new());
    for (at, _) in text.match_indices("](") {
        let link = text[at + 2..].split([')', ' ', '\n']).next().unwrap_or("");
        let target = target(page, link);
        // The words of a link or a picture hold no brackets.
        let opening = text[..at].rfind('[');
        if opening.is_some_and(|open| text[..open].ends_with('!')) {
            pictures.push(target);
        } else {
            links.insert(target);
        }
    }
    (links, pictures)
}

/// How the Chinese page `name` differs from the English one.
fn differences(name: &str, english: &str, chinese: &str) -> Vec<String> {
    let pages = [format!("docs/{name}"), format!("docs/zh/{name}")];
    let [(prose, code), (prose_zh, code_zh)] = [split(english), split(chinese)];
    let levels = |prose: &[&str]| -> Vec<usize> {
        let headings = prose.iter().filter(|line| line.starts_with('#'));
        headings.map(|line| line.len() - line.trim_start_matches('#').len()).collect()
    };
    let mut wrong = Vec::new();
    let mut differs = |what: &str, english: String, chinese: String| {
        wrong.push(format!("{}: {what}: {chinese}, in English {english}", pages[1]));
    };

    let opening = format!("[English](../{name})");
    let first = prose_zh.iter().find(|line| !line.is_empty() && !line.starts_with('#'));
    if !first.is_some_and(|line| line.starts_with(&opening)) {
        differs("first line", opening, format!("{first:?}"));
    }
    if levels(&prose) != levels(&prose_zh) {
        let [english, chinese] = [levels(&prose), levels(&prose_zh)];
        differs("levels of headings", format!("{english:?}"), format!("{chinese:?}"));
    }
    if code.len() != code_zh.len() {
        differs("blocks of code", code.len().to_string(), code_zh.len().to_string());
    }
    for (english, chinese) in code.iter().zip(&code_zh).filter(|(a, b)| a != b) {
        differs("code", english.clone(), chinese.clone());
    }
    let (links, pictures) = targets(&pages[0], &prose);
    let (mut links_zh, pictures_zh) = targets(&pages[1], &prose_zh);
    links_zh.remove(&format!("docs/{name} (English)"));
    if pictures != pictures_zh {
        differs("pictures", format!("{pictures:?}"), format!("{pictures_zh:?}"));
    }
    for link in links.symmetric_difference(&links_zh) {
        let [english, chinese] = [&links, &links_zh].map(|side| side.contains(link).to_string());
        differs(&format!("link to {link}"), english, chinese);
    }
    wrong
}

/// Every page exists in both languages, with the same frame around its words.
#[test]
fn languages_keep_in_step() {
    let [english, chinese] = ["docs", "docs/zh"].map(|folder| root().join(folder));
    let both = [names(&english), names(&chinese)];
    let alone: Vec<_> = both[0].symmetric_difference(&both[1]).collect();
    assert!(alone.is_empty(), "in one language only: {alone:?}");
    let read = |folder: &Path, name: &str| fs::read_to_string(folder.join(name)).unwrap();
    let wrong: Vec<_> = both[0]
        .iter()
        .flat_map(|name| differences(name, &read(&english, name), &read(&chinese, name)))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(read(&root(), "README.md").contains("](docs/zh/index.md)"), "README.md lacks the link");
}

/// The test can fail: each kind of difference is found where it is planted, and nothing else is.
#[test]
fn languages_differences_are_found() {
    let english = "# A\n\nSee [b](ch01.md), [c](../src/grid.rs).\n\n## B\n\n![p](../snapshots/T4.snap.png)\n\n\
        ```rust\n// Why.\nlet a = 1;\n```\n";
    let chinese = "[English](../x.md)\n\n# 甲\n\n见[乙](ch01.md)、[丙](../../src/grid.rs)。\n\n## 乙\n\n\
        ![图](../../snapshots/T4.snap.png)\n\n```rust\n// 为何。\nlet a = 1;\n```\n";
    assert_eq!(differences("x.md", english, chinese), [""; 0]);
    for (from, to) in [
        ("[English](../x.md)\n\n", ""),
        ("## 乙", "### 乙"),
        ("## 乙", ""),
        ("let a = 1;", "let a = 2;"),
        ("```rust", "```text"),
        ("// 为何。\n", ""),
        ("[丙](../../src/grid.rs)", "丙"),
        ("](../../src/grid.rs)", "](../src/grid.rs)"),
        ("[乙](ch01.md)", "[乙](../ch01.md)"),
        ("[乙](ch01.md)", "[乙](ch01.md#nowhere)"),
        ("![图](../../snapshots/T4.snap.png)", ""),
        ("T4.snap", "T6.snap"),
    ] {
        assert!(chinese.contains(from), "{from:?} is not in the sample");
        let planted = chinese.replacen(from, to, 1);
        assert!(
            !differences("x.md", english, &planted).is_empty(),
            "{from:?} to {to:?} is not found"
        );
    }
    let zh = "docs/zh/x.md";
    assert_eq!(target(zh, "../cost-price.svg"), "docs/cost-price.svg");
    assert_eq!(target("docs/x.md", "ch01.md#the-formula"), "docs/ch01.md#2");
    assert_eq!(target(zh, "#nowhere"), "docs/x.md#nowhere (no such heading)");
}
