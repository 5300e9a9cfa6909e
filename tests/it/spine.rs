//! One spine: the lesson, the stage, the steps and the quiz of a chapter have one number, and each lesson ends with a line that
//! leads to the others.

use rasterproof_teaching::course::{self, STEPS, Step};
use rasterproof_teaching::quiz::{self, page::HEADINGS};
use rasterproof_teaching::spine::{self, CHAPTERS};

use crate::pages::{page, root};
use crate::workspace::anchor;

/// The words of the last line of a lesson.
struct Words {
    folder: &'static str,
    go_on: &'static str,
    /// Before the number of a stage and after it, in a heading of the page of stages.
    stage: [&'static str; 2],
    step: [&'static str; 2],
    quiz: &'static str,
    evidence: [&'static str; 2],
}

const ENGLISH: Words = Words {
    folder: "docs",
    go_on: "**Go on:** ",
    stage: ["Stage ", ": "],
    step: ["Step ", ": "],
    quiz: "quiz",
    evidence: ["evidence", "no evidence of its own"],
};

const CHINESE: Words = Words {
    folder: "docs/zh",
    go_on: "**接着：** ",
    stage: ["阶段 ", "："],
    step: ["第 ", " 步："],
    quiz: "测验",
    evidence: ["依据", "没有单独的依据"],
};

/// A link to the heading of a page that begins with this number, shown as the number.
fn link(words: &Words, to: &str, [before, after]: [&str; 2], number: &str) -> String {
    let text = page(words.folder, to);
    let begin = format!("## {before}{number}{after}");
    let heading = text.lines().find(|line| line.starts_with(&begin));
    let heading = heading.unwrap_or_else(|| panic!("{to} has no {begin}"));
    format!("[{number}]({to}.md#{})", anchor(heading.trim_start_matches("## ")))
}

/// The last line of a lesson: its stage, how its steps are checked, its quiz and its evidence.
fn last_line(words: &Words, chapter: &str) -> String {
    let number = spine::number(chapter).expect("it is a chapter");
    let stage = link(words, "own", words.stage, number);
    let stage = format!("{}{stage}", words.stage[0].to_lowercase());
    let is_own = |step: &&Step| step.page == format!("docs/{chapter}.md");
    let steps: Vec<_> = STEPS.iter().filter(is_own).map(course::number).collect();
    assert!(!steps.is_empty(), "chapter {number} has no step");
    let links = steps.iter().map(|step| link(words, "steps", words.step, step));
    let check = format!("`course check` {}", links.collect::<Vec<_>>().join(", "));
    let exercises = HEADINGS[usize::from(words.folder == CHINESE.folder)].trim_start_matches("## ");
    assert!(quiz::chapter(number).is_some(), "chapter {number} has no quiz");
    let quiz = format!("[{} {number}](#{})", words.quiz, anchor(exercises));
    let [evidence, none] = words.evidence;
    let path = format!("{chapter}-evidence.md");
    let evidence = if root().join("docs").join(&path).exists() {
        format!("[{evidence}]({path})")
    } else {
        none.to_owned()
    };
    format!("{}{stage} · {check} · {quiz} · {evidence}", words.go_on)
}

/// The line that ends a page, where it is that of a chapter; nothing else ends with one.
pub fn ending(folder: &str, chapter: &str) -> String {
    let words = if folder == CHINESE.folder { &CHINESE } else { &ENGLISH };
    match spine::number(chapter) {
        Some(_) => format!("\n{}\n", last_line(words, chapter)),
        None => String::new(),
    }
}

/// What has a number has that of a chapter: stages and steps.
#[test]
fn spine_numbers_everything() {
    for words in [&ENGLISH, &CHINESE] {
        for (page_of, [before, after]) in [("own", words.stage), ("steps", words.step)] {
            let text = page(words.folder, page_of);
            let headings =
                text.lines().filter_map(|line| line.strip_prefix("## ")?.strip_prefix(before));
            let numbers: Vec<_> = headings.map(|rest| rest.split(after).next().unwrap()).collect();
            let place = |number: &&str| {
                let chapter = number.split('.').next();
                CHAPTERS.iter().position(|(_, of)| Some(*of) == chapter)
            };
            assert!(numbers.len() >= CHAPTERS.len(), "{page_of}: {numbers:?}");
            assert!(numbers.iter().all(|number| place(number).is_some()), "{page_of}: {numbers:?}");
            assert!(numbers.is_sorted_by_key(place), "{page_of}: {numbers:?}");
        }
        for (chapter, number) in CHAPTERS {
            let text = page(words.folder, chapter);
            let title = text.lines().next().unwrap();
            assert!(title.contains(&format!(" {number}")), "{title}");
        }
    }
}

/// The points of a row of the sheet: what its steps, its hard exercises and the rest are worth.
fn points(row: &[&str]) -> u32 {
    let steps = row[2].split(',').filter(|step| !step.trim().is_empty()).count() as u32;
    let others = row[4].split(": ").skip(1).map(|rest| {
        let digits = rest.split(|c: char| !c.is_ascii_digit()).next();
        digits.and_then(|digits| digits.parse::<u32>().ok()).unwrap_or(0)
    });
    2 * steps + 2 + others.sum::<u32>()
}

/// The sheet of ten weeks has each chapter and each step once, in order, and 100 points.
#[test]
fn spine_sheet_has_all_and_100_points() {
    for folder in [ENGLISH.folder, CHINESE.folder] {
        let text = page(folder, "teaching");
        let rows: Vec<Vec<&str>> = text
            .lines()
            .filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"))
            .map(|line| line.split('|').map(str::trim).collect::<Vec<_>>())
            .filter(|row| row.len() == 6 && row[0].parse::<u32>().is_ok())
            .collect();
        assert_eq!(rows.len(), 10, "{folder}");
        let column = |at: usize| {
            let cells = rows.iter().flat_map(|row| row[at].split(','));
            cells.map(str::trim).filter(|cell| !cell.is_empty()).collect::<Vec<_>>()
        };
        assert_eq!(column(1), CHAPTERS.map(|(_, number)| number), "{folder}");
        assert_eq!(column(2), STEPS.iter().map(course::number).collect::<Vec<_>>(), "{folder}");
        let sums: Vec<_> = rows.iter().map(|row| points(row)).collect();
        assert_eq!(sums.iter().map(u32::to_string).collect::<Vec<_>>(), column(5), "{folder}");
        assert_eq!(sums.iter().sum::<u32>(), 100, "{folder}");
    }
}
