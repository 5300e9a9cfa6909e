//! Sentences about conventions in Chinese, phrase by phrase: the page of libraries has both languages,
//! its data one. The phrases are in `phrases.toml`.

use std::collections::HashMap;
use std::sync::LazyLock;

/// Phrases in English and in Chinese, in the order in which they are looked for.
static PHRASES: LazyLock<Vec<[String; 2]>> = LazyLock::new(|| {
    let mut table: HashMap<String, Vec<[String; 2]>> =
        toml::from_str(include_str!("phrases.toml")).expect("every phrase is a pair");
    table.remove("phrases").unwrap_or_default()
});

/// A hole is shorter than a sentence.
const MOST_HELD: usize = 120;

/// A sentence, or how a call is made, in Chinese.
pub fn chinese(text: &str) -> String {
    let mut text = text.to_owned();
    for [english, chinese] in PHRASES.iter() {
        // A phrase may occur several times; what was translated is not looked at again.
        let mut from = 0;
        while let Some((start, end, held)) = find(&text, from, english) {
            let mut said = chinese.clone();
            for (i, held) in held.iter().enumerate() {
                said = said.replace(&format!("{{{i}}}"), held);
            }
            text.replace_range(start..end, &said);
            from = start + said.len();
        }
    }
    match text.strip_suffix('.') {
        Some(whole) => format!("{whole}。"),
        None => text,
    }
}

/// Where a phrase stands at `from` or later, and what stands in its holes.
fn find(text: &str, from: usize, phrase: &str) -> Option<(usize, usize, Vec<String>)> {
    let mut parts = phrase.split("{}");
    let first = parts.next()?;
    let parts: Vec<&str> = parts.collect();
    // Wherever it begins, its other parts have to follow, each not far behind the one before.
    let starts = text[from..].match_indices(first).map(|(at, _)| from + at);
    starts.into_iter().find_map(|start| {
        let mut at = start + first.len();
        let mut held = Vec::new();
        for part in &parts {
            let length = text[at..].find(part).filter(|length| *length <= MOST_HELD)?;
            held.push(text[at..at + length].to_owned());
            at += length + part.len();
        }
        Some((start, at, held))
    })
}
