//! The exercises: what the pages say is what the code computes, and the command asks the same.

use rasterproof_teaching::quiz::page::{HEADINGS, section};
use rasterproof_teaching::quiz::{CHAPTERS, Chapter, Language, Right};
use rasterproof_teaching::spine;

use crate::pages::{Renewal, read};
use crate::program::{Run, shared};
use crate::spine::ending;

/// What a page says about its exercises: everything from the heading on.
fn exercises(page: &str, language: Language) -> &str {
    page.find(HEADINGS[language as usize]).map_or("", |at| &page[at..])
}

#[test]
fn quiz_every_exercise_is_whole() {
    for chapter in CHAPTERS.iter() {
        assert!((3..=5).contains(&chapter.exercises.len()), "{}", chapter.page);
        for exercise in &chapter.exercises {
            let (question, solution) = (&exercise.question[0], exercise.solution());
            for why in &exercise.why {
                assert_eq!(why.matches("{}").count(), solution.figures.len(), "{question}");
            }
            let is_choice = matches!(solution.answer, Right::Choice(_));
            assert_eq!(is_choice, !exercise.choices.is_empty(), "{question}");
            let widest = solution.grids.iter().flat_map(|(_, lines)| lines);
            assert!(widest.map(|l| l.chars().count()).max().unwrap_or(0) <= 40, "{question}");
        }
    }
}

/// Pages end with their exercises as the code computes them. `RASTERPROOF_RENEW=1 cargo test --test it
/// quiz_pages` writes them anew.
#[test]
fn quiz_pages_say_what_is_computed() {
    let mut renewal = Renewal::default();
    for chapter in CHAPTERS.iter() {
        for (folder, language) in [("docs", Language::English), ("docs/zh", Language::Chinese)] {
            let path = format!("{folder}/{}.md", chapter.page);
            let page = read(&path);
            let kept = page[..page.len() - exercises(&page, language).len()].trim_end();
            let ending = ending(folder, &chapter.page);
            renewal.is(&path, &format!("{kept}\n\n{}{ending}", section(chapter, language)));
        }
    }
    renewal.check("quiz_pages");
}

/// The answers of a page are those of the code, and all of them follow the last question: who reads the page in an editor,
/// where nothing is hidden, does not see an answer beside its question.
#[test]
fn quiz_pages_have_a_key() {
    for chapter in CHAPTERS.iter() {
        let page = section(chapter, Language::English);
        let (questions, answers) = page.split_once("<details>").unwrap();
        for (number, exercise) in (1..).zip(&chapter.exercises) {
            assert!(questions.contains(&format!("\n**{number}.** ")), "{}", chapter.page);
            let answer = exercise.solution().answer.text();
            // A lesson gives the reason, too.
            let key = match spine::number(&chapter.page) {
                Some(_) => format!("Answer {number}</summary>\n\n**{answer}**"),
                None => format!("{number}: **{answer}**"),
            };
            assert!(answers.contains(&key), "{}", exercise.question[0]);
        }
    }
}

/// The pages of chapter 2 ask what they have taught: lines on the first one, and the rule for edges on the second.
#[test]
fn quiz_asks_no_page_early() {
    let pages: Vec<_> = CHAPTERS.iter().take(5).map(|chapter| chapter.page.as_str()).collect();
    assert_eq!(pages, ["ch01", "ch02", "ch02-edge-functions", "ch02-scanline", "ch03"]);
    for chapter in CHAPTERS.iter().take(2) {
        for exercise in &chapter.exercises {
            let text = exercise.question[0].to_lowercase() + &exercise.why[0].to_lowercase();
            let early = ["edge", "top-left", "twice"].into_iter().find(|word| text.contains(word));
            assert_eq!(early, None, "{}: {text}", chapter.page);
        }
    }
}

fn check(words: &str, answers: &str, status: u8) -> Run {
    shared().run_on(answers, format!("quiz {words}")).has(status)
}

/// The right answers of a chapter, one a line.
fn key(chapter: &Chapter) -> String {
    chapter.exercises.iter().map(|exercise| exercise.solution().answer.text() + "\n").collect()
}

#[test]
fn quiz_counts_right_answers() {
    for chapter in CHAPTERS.iter() {
        let count = chapter.exercises.len();
        let Run { out, errors, .. } = check(chapter.word(), &key(chapter), 0);
        assert!(out.ends_with(&format!("{count} of {count} right\n")), "{out}");
        assert_eq!(errors, "");
        assert!(!out.lines().any(|line| line.starts_with("> ")), "no prompt in a pipe: {out}");
        assert!(out.lines().all(|line| line.chars().count() <= 100), "{out}");
    }
    let all: String = CHAPTERS.iter().map(key).collect();
    let count = all.lines().count();
    assert!(check("", &all, 0).out.ends_with(&format!("{count} of {count} right\n")));
}
