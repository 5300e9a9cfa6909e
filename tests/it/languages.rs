//! The languages of the docs stay in step: what a page says in English, its Chinese one says too.
//!
//! Whether a translation is good is for a reader to judge. What is judged here is what a change of
//! one language alone would leave behind: a page, a heading, a code block, a figure, a link.

use std::collections::BTreeSet;
use std::fs;

use crate::pages::{read, root};

const ENGLISH: &str = "docs";
const CHINESE: &str = "docs/zh";

/// The names of the pages of one folder, those of the folders in it left out.
fn names(folder: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(root().join(folder)).unwrap_or_else(|e| panic!("{folder}: {e}"));
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".md"))
        .collect()
}

/// A link seen from the root of the repository. Anchors are dropped: they name translated headings.
fn target(folder: &str, link: &str) -> String {
    if link.contains("://") {
        return link.to_owned();
    }
    let mut parts: Vec<_> = folder.split('/').collect();
    for part in link.split('#').next().unwrap_or("").split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop();
            }
            name => parts.push(name),
        }
    }
    parts.join("/")
}

/// What must be the same in every language, as far as it can be read off the text.
struct Skeleton {
    /// In the order of the page: headings as their level, code blocks without the words in them, table
    /// rows by their number of cells and their figures.
    marks: Vec<String>,
    /// Links and pictures in the prose, as paths from the root of the repository.
    targets: BTreeSet<String>,
}

fn skeleton(folder: &str, page: &str) -> Skeleton {
    let (mut marks, mut prose, mut block) = (Vec::new(), String::new(), None::<String>);
    for line in page.lines() {
        let fence = line.trim_start().starts_with("```");
        match block.take() {
            Some(code) if fence => marks.push(code),
            Some(code) => {
                let kind = code.lines().next().unwrap_or("").trim_start().to_owned();
                block = Some(code + "\n" + &without_words(&kind, line));
            }
            None if fence => block = Some(line.to_owned()),
            None => {
                marks.extend(mark(line));
                prose += line;
                prose.push('\n');
            }
        }
    }
    assert!(block.is_none(), "a code block is not closed: {block:?}");
    let targets = prose
        .match_indices("](")
        .map(|(at, _)| prose[at + 2..].split([')', ' ']).next().unwrap_or(""))
        .filter(|link| !link.is_empty() && !link.starts_with('#'))
        .map(|link| target(folder, link))
        .collect();
    Skeleton { marks, targets }
}

/// Where a comment begins in a line of a code block.
fn comment(kind: &str, line: &str) -> Option<usize> {
    match kind {
        "```rust" => line.find("//"),
        "```sh" | "```console" if line.starts_with("# ") => Some(0),
        "```sh" | "```console" => line.find(" # ").map(|at| at + 1),
        _ => None,
    }
}

/// A line of a code block without what is written for people: comments, and words in formulas. That
/// there are some is left to be seen.
fn without_words(kind: &str, line: &str) -> String {
    if kind == "```math" {
        return without_text(line);
    }
    let comment = comment(kind, line);
    comment.map_or(line.to_owned(), |at| line[..at].trim_end().to_owned() + " #")
}

fn is_chinese(text: &str) -> bool {
    text.chars().any(|c| ('\u{4e00}'..='\u{9fff}').contains(&c))
}

/// Comments in the code blocks of a Chinese page that hold words, none of them Chinese.
fn untranslated(page: &str) -> Vec<&str> {
    let (mut kind, mut found) = (None, Vec::new());
    for line in page.lines() {
        if line.trim_start().starts_with("```") {
            kind = if kind.is_some() { None } else { Some(line.trim_start()) };
        } else if let Some(at) = kind.and_then(|kind| comment(kind, line)) {
            let mut words = line[at..].split(|c: char| !c.is_alphabetic());
            if !is_chinese(&line[at..]) && words.any(|word| word.len() > 2) {
                found.push(&line[at..]);
            }
        }
    }
    found
}

fn without_text(formula: &str) -> String {
    let mut kept = formula.to_owned();
    for command in ["\\text{", "\\mathit{"] {
        let mut parts = kept.split(command);
        let first = parts.next().unwrap_or("").to_owned();
        kept = parts.fold(first, |kept, part| {
            let (_, rest) = part.split_once('}').expect("words in a formula end on their line");
            kept + command + "}" + rest
        });
    }
    kept
}

/// A heading's level or a table row's cells and figures; nothing for any other line.
fn mark(line: &str) -> Option<String> {
    if line.starts_with('|') {
        let mut figures: Vec<_> =
            line.split(|c: char| !c.is_ascii_digit()).filter(|run| !run.is_empty()).collect();
        figures.sort_unstable();
        return Some(format!("|{}| {}", line.matches('|').count() - 1, figures.join(" ")));
    }
    let level = line.bytes().take_while(|&b| b == b'#').count();
    (level > 0 && line[level..].starts_with(' ')).then(|| line[..level].to_owned())
}

/// Where the Chinese page of one name is out of step with the English one.
fn out_of_step(name: &str, english: &str, chinese: &str) -> Vec<String> {
    let (original, own) = (format!("{ENGLISH}/{name}"), format!("{CHINESE}/{name}"));
    let (mut en, mut zh) = (skeleton(ENGLISH, english), skeleton(CHINESE, chinese));
    let mut wrong = Vec::new();
    if !is_chinese(chinese) {
        wrong.push(format!("{own} holds no Chinese"));
    }
    wrong
        .extend(untranslated(chinese).iter().map(|text| format!("{own}: '{text}' is not Chinese")));
    if !zh.targets.remove(&original) {
        wrong.push(format!("{own} does not link to {original}"));
    }
    en.targets.remove(&own);
    // Pages, and figures that were drawn in Chinese too.
    let has_chinese =
        |file: &str| file.ends_with(".md") || root().join(CHINESE).join(file).exists();
    let translated = |target: &String| match target.strip_prefix("docs/") {
        Some(file) if !file.contains('/') && has_chinese(file) => format!("{CHINESE}/{file}"),
        _ => target.clone(),
    };
    let wanted: BTreeSet<_> = en.targets.iter().map(translated).collect();
    wrong.extend(wanted.difference(&zh.targets).map(|t| format!("{own} lacks the link to {t}")));
    wrong.extend(zh.targets.difference(&wanted).map(|t| format!("{own} alone links to {t}")));
    let end = en.marks.len().max(zh.marks.len());
    if let Some(at) = (0..end).find(|&at| en.marks.get(at) != zh.marks.get(at)) {
        let (en, zh) = (en.marks.get(at), zh.marks.get(at));
        wrong.push(format!("{own}: {zh:?} where {original} has {en:?}"));
    }
    wrong
}

#[test]
fn languages_keep_step() {
    let (english, chinese) = (names(ENGLISH), names(CHINESE));
    let mut wrong: Vec<_> = english
        .symmetric_difference(&chinese)
        .map(|name| format!("{name} is not in both {ENGLISH} and {CHINESE}"))
        .collect();
    for name in english.intersection(&chinese) {
        let read = |folder| read(format!("{folder}/{name}"));
        wrong.extend(out_of_step(name, &read(ENGLISH), &read(CHINESE)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The rule can fail: each kind of drift is found on a page that commits it.
#[test]
fn languages_drift_is_found() {
    let english = "# A\n\n[中文](zh/a.md) [B](b.md#x) ![P](../snapshots/p.png)\n\n## C\n\n\
                   | n | 1,024 |\n\n```sh\nrun # [no](link)\n```\n\n```math\nx_\\text{affine} = 1\n```\n";
    let chinese = "# 甲\n\n[English](../a.md)。[乙](b.md) ![图](../../snapshots/p.png)\n\n## 丙\n\n\
                   | 数 | 1,024 |\n\n```sh\nrun   # 不同的话\n```\n\n```math\nx_\\text{仿射} = 1\n```\n";
    assert_eq!(out_of_step("a.md", english, chinese), [""; 0]);
    let drifts = [
        ("## 丙", "### 丙", "where"),
        ("## 丙\n", "", "where"),
        ("```sh", "```text", "where"),
        ("run  ", "walk  ", "where"),
        ("  # 不同的话", "", "where"),
        ("# 不同的话", "# other words", "is not Chinese"),
        ("} = 1", "} = 2", "where"),
        ("_\\text{仿射}", "", "where"),
        ("1,024", "1,025", "where"),
        ("| 数 |", "| 数 | 量 |", "where"),
        ("[English](../a.md)。", "", "does not link"),
        ("[乙](b.md)", "乙", "lacks"),
        ("[乙](b.md)", "[乙](../b.md)", "alone"),
        ("(../../snapshots", "(../snapshots", "alone"),
    ];
    for (old, new, found) in drifts {
        let wrong = out_of_step("a.md", english, &chinese.replace(old, new)).join("\n");
        assert!(wrong.contains(found), "{old} as {new}: {wrong:?}");
    }
    // The page and its comment.
    let untranslated = english.replace("](zh/a.md)", "](../a.md)").replace("(../s", "(../../s");
    assert_eq!(out_of_step("a.md", english, &untranslated.replace("中文", "English")).len(), 2);
}
