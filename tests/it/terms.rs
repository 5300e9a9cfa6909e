//! The order of concepts: a chapter uses a word of the glossary only if it, or a chapter before it,
//! explains the word. What is in a link is free, since the link leads to the explanation; so is what is in the box
//! about the book, in code and in the generated exercises. What a lesson need not say is on its page of evidence.

use rasterproof_teaching::course::STEPS;
use rasterproof_teaching::quiz;
use rasterproof_teaching::spine::CHAPTERS;

use crate::pages::page;

/// A folder of pages, the column of its words in the glossary, and where the main text of a chapter ends.
const LANGUAGES: [(&str, usize, &str); 2] =
    [("docs", 2, "\n## Predict"), ("docs/zh", 3, "\n## 先预测")];

/// The most words of a lesson in English: code, formulas, tables, pictures and the generated exercises left out.
const MOST_WORDS: usize = 2200;

/// The words of a glossary that a chapter explains, each with the place of the chapter.
fn words(glossary: &str, column: usize) -> Vec<(String, usize)> {
    let mut words = Vec::new();
    for row in glossary.lines().filter(|row| row.starts_with("| ")) {
        let cell = row.split(" | ").nth(column - 1);
        let Some((named, page)) = cell.and_then(|cell| cell.split_once("**](")) else { continue };
        let page = page.split(".md").next();
        let Some(place) = CHAPTERS.iter().position(|(chapter, _)| Some(*chapter) == page) else {
            continue;
        };
        let named = named.trim_start_matches(['|', ' ', '[', '*']);
        let named = named.split([',', '，']).map(|word| word.trim().to_lowercase());
        words.extend(named.map(|word| (word, place)));
    }
    words
}

/// Takes out what stands between two marks.
fn without(text: &str, begin: &str, end: &str) -> String {
    let mut parts = text.split(begin);
    let first = parts.next().unwrap_or("").to_owned();
    parts.fold(first, |kept, part| kept + part.split_once(end).map_or("", |(_, rest)| rest))
}

/// The text in which words count, in small letters.
fn main_text(page: &str, end: &str) -> String {
    let page = page.split(end).next().unwrap_or("");
    let kept: String = page.split("```").step_by(2).collect();
    let kept = without(&kept, "<!--", "-->");
    let lines = kept.lines().filter(|line| !line.starts_with("> "));
    let kept = lines.collect::<Vec<_>>().join("\n");
    let kept: String = kept.split('`').step_by(2).collect();
    without_links(&kept).to_lowercase()
}

/// Takes out `[words](target)`, pictures among them.
fn without_links(text: &str) -> String {
    let mut parts = text.split('[');
    let first = parts.next().unwrap_or("").to_owned();
    parts.fold(first, |kept, part| {
        let target = part.split_once("](").and_then(|(_, target)| target.split_once(')'));
        kept + target.map_or(part, |(_, rest)| rest)
    })
}

fn contains(text: &str, word: &str) -> bool {
    // Chinese words stand without spaces around them.
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '\'';
    text.match_indices(word).any(|(at, _)| {
        let after = text[at + word.len()..].trim_start_matches('s');
        !text[..at].ends_with(is_part) && !after.starts_with(is_part)
    })
}

/// The words that a chapter uses too early.
fn early(text: &str, place: usize, words: &[(String, usize)]) -> Vec<String> {
    let later = words.iter().filter(|(_, explained)| *explained > place);
    let used = later.filter(|(word, _)| contains(text, word));
    used.map(|(word, explained)| format!("'{word}', which {} explains", CHAPTERS[*explained].0))
        .collect()
}

#[test]
fn terms_are_used_after_they_are_explained() {
    let mut found = Vec::new();
    for (folder, column, end) in LANGUAGES {
        let words = words(&page(folder, "glossary"), column);
        assert!(words.len() > 40, "{folder}: only {} words", words.len());
        for (place, (chapter, _)) in CHAPTERS.iter().enumerate() {
            let text = main_text(&page(folder, chapter), end);
            assert!(text.len() > 1000, "{folder}/{chapter}.md has no main text");
            let early = early(&text, place, &words).into_iter();
            found.extend(early.map(|word| format!("{folder}/{chapter}.md uses {word}")));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_term_that_comes_too_early_is_found() {
    let glossary = "| a | [**span, edge function**](ch02-scanline.md) | c | d |";
    let words = words(glossary, 2);
    let check = |page: &str, place| early(&main_text(page, "\n## Pre"), place, &words);
    assert_eq!(check("Spans are runs.", 1).len(), 1);
    assert!(check("Spans are runs.", 3).is_empty());
    for free in ["[spans](a.md)", "`span`", "spanner", "> span", "a\n## Predict\nspan"] {
        assert!(check(free, 0).is_empty(), "{free}");
    }
}

/// The words of a lesson that somebody reads as sentences.
fn lesson_words(page: &str) -> usize {
    let lesson = page.split("\n## Predict").next().unwrap_or("");
    let kept: String = lesson.split("```").step_by(2).collect();
    let kept = without(&without(&kept, "<!--", "-->"), "![", ")");
    let kept = without(&kept, "](", ")");
    let lines = kept.lines().filter(|line| !line.starts_with('|'));
    let words = lines.flat_map(str::split_whitespace);
    words.filter(|word| word.contains(char::is_alphanumeric)).count()
}

#[test]
fn terms_of_a_lesson_are_few() {
    for (chapter, _) in CHAPTERS {
        let words = lesson_words(&page("docs", chapter));
        assert!((1000..=MOST_WORDS).contains(&words), "docs/{chapter}.md has {words} words");
    }
    let page = "one ![two](a.png) [three](b.md) <!-- 4 -->\n| 5 |\n```text\n6\n```\n+ four\n## Predict\nsix";
    assert_eq!(lesson_words(page), 3);
}

/// What the page for teachers says of the lessons beside other texts: how many begin with a picture, how many have live figures,
/// the fewest and the most words, stages in three languages, steps of the course, and quizzes.
pub fn lessons() -> Vec<f64> {
    let pages: Vec<_> = CHAPTERS.iter().map(|(chapter, _)| page("docs", chapter)).collect();
    let begins = |page: &&String| page.split("\n## ").next().unwrap_or("").contains("![");
    let words: Vec<_> = pages.iter().map(|page| lesson_words(page)).collect();
    let quizzes = CHAPTERS.iter().filter(|(_, number)| quiz::chapter(number).is_some());
    let counts = [
        pages.iter().filter(begins).count(),
        pages.iter().filter(|page| page.contains("<rp-figure")).count(),
        words.iter().copied().min().unwrap(),
        words.iter().copied().max().unwrap(),
        page("docs", "own").matches("\nPython: [").count(),
        STEPS.len(),
        quizzes.count(),
    ];
    counts.map(|count| count as f64).to_vec()
}

/// A lesson ends with four exercises, two of them hard, each with its answer and the hard ones with hints.
#[test]
fn terms_are_exercised() {
    for (chapter, _) in CHAPTERS {
        let text = page("docs", chapter);
        let lesson = text.split("\n## Predict").next().unwrap_or("");
        let (_, exercises) = lesson.split_once("\n## Try it yourself").unwrap_or_default();
        let count = |word: &str| exercises.matches(word).count();
        let numbers = [1, 2, 3, 4].map(|n| count(&format!("\n**{n}.** ")));
        let found = (numbers, count(".** (hard) "), count("<summary>Answer "));
        assert_eq!(found, ([1; 4], 2, 4), "docs/{chapter}.md");
        assert!(count("<summary>Hint") > 0, "docs/{chapter}.md");
    }
}

/// One thing has one word: what was a step of a ladder in one page and a choice in another is a choice of a group.
#[test]
fn a_choice_has_one_word() {
    let dropped = |text: &str| {
        let code = text.split('`').step_by(2).collect::<String>().to_lowercase();
        ["rung", "ladder", "阶梯"].into_iter().find(|word| {
            without_links(&code).replace("](", " ").split(|c: char| !c.is_alphanumeric()).any(
                |one| one.trim_end_matches('s') == *word || !word.is_ascii() && one.contains(word),
            )
        })
    };
    let mut found = Vec::new();
    for folder in ["docs", "docs/zh", "src/cli/help"] {
        for path in crate::pages::files(&crate::pages::root().join(folder), "") {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            let is_text = [".md", ".txt"].iter().any(|end| path.to_str().unwrap().ends_with(end));
            if let Some(word) = dropped(&text).filter(|_| is_text) {
                found.push(format!("{}: {word}", path.display()));
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert_eq!(dropped("The rungs of it."), Some("rung"));
    assert_eq!(dropped("各组阶梯"), Some("阶梯"));
    assert_eq!(dropped("`ladder` and [ladder](a.md)"), None);
}
