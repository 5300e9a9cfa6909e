//! Exercises as text: the last section of a page, and what the terminal shows.

use super::answer::letter;
use super::{Chapter, Exercise, Language, Solution};
use crate::spine;
use rasterproof_verify::judge::ascii;

/// Columns of a page's English text; Chinese is not broken, for a line's end would show as a blank.
const PAGE_COLUMNS: usize = 130;
const TERMINAL_COLUMNS: usize = 96;

/// The heading of the section in both languages.
pub const HEADINGS: [&str; 2] = ["## Predict, then check", "## 先预测，再检验"];

/// The section of a chapter's page, from its heading to the page's end. A lesson gives the reasons of its answers, another page
/// the answers alone.
pub fn section(chapter: &Chapter, language: Language) -> String {
    let word = chapter.word();
    let (ask, extra) = match language {
        Language::English => ("asks these in the terminal.", ""),
        Language::Chinese => ("在终端里提出这些问题。", " --language zh"),
    };
    let intro = format!("`cargo run -- quiz {word}{extra}` {ask}");
    // The engines compute the answers each time that the page is written.
    let solutions: Vec<_> = chapter.exercises.iter().map(Exercise::solution).collect();
    let axes = match language {
        Language::English => {
            " In the grids columns go right and rows down, both from 0; `#` is drawn, `.` is not, `-` is missing, `+` is \
             too many, `2` is drawn twice."
        }
        Language::Chinese => {
            "网格里列向右、行向下，都从 0 数起；`#` 画了，`.` 没画，`-` 缺失，`+` 多余，`2` 画了两次。"
        }
    };
    // The marks are explained where a page shows grids that have other marks than drawn and not drawn.
    let shows_grids = spine::number(&chapter.page).is_some();
    let axes = if shows_grids && solutions.iter().any(|s| legend(s, language).is_some()) {
        axes
    } else {
        ""
    };
    let mut out = HEADINGS[language as usize].to_owned() + "\n\n";
    out += &format!("{}\n", wrapped(&format!("{intro}{axes}"), language));
    // In a text editor an answer is not hidden, so all questions come before the first of them.
    for ((number, exercise), solution) in (1..).zip(&chapter.exercises).zip(&solutions) {
        let question = exercise.question_with_form(language, solution);
        out += &format!("\n{}", wrapped(&format!("**{number}.** {question}"), language));
        if !exercise.choices.is_empty() {
            out += &format!("\n\n{}", wrapped(&choices(exercise, language).join(" · "), language));
        }
        out += "\n";
    }
    if spine::number(&chapter.page).is_none() {
        return out + &answers_alone(word, &solutions, language);
    }
    // Each answer has to be opened, and has its reason and its grids.
    for ((number, exercise), solution) in (1..).zip(&chapter.exercises).zip(&solutions) {
        let word = ["Answer", "答案"][language as usize];
        let answer = solution.answer.text();
        let why = exercise.explanation(language, solution);
        out += &format!("\n<details><summary>{word} {number}</summary>\n\n");
        out += &wrapped(&format!("**{answer}** {why}"), language);
        let grids = grids(solution);
        if !grids.is_empty() {
            out += &format!("\n\n```text\n{grids}```");
        }
        out += "\n\n</details>\n";
    }
    out
}

/// All answers in one line that has to be opened, and where their reasons are.
fn answers_alone(word: &str, solutions: &[Solution], language: Language) -> String {
    let answers =
        (1..).zip(solutions).map(|(number, s)| format!("{number}: **{}**", s.answer.text()));
    let answers = answers.collect::<Vec<_>>().join(" · ");
    let (summary, reasons) = match language {
        Language::English => ("Answers", format!("`cargo run -- quiz {word}` gives the reasons.")),
        Language::Chinese => {
            ("答案", format!("`cargo run -- quiz {word} --language zh` 给出理由。"))
        }
    };
    format!("\n<details><summary>{summary}</summary>\n\n{answers}\n\n{reasons}\n\n</details>\n")
}

/// Text broken into the lines of a page.
fn wrapped(text: &str, language: Language) -> String {
    match language {
        Language::English => ascii::lines(text, PAGE_COLUMNS, ascii::columns).join("\n"),
        Language::Chinese => text.to_owned(),
    }
}

pub fn choices(exercise: &Exercise, language: Language) -> Vec<String> {
    let choices = exercise.choices.iter().enumerate();
    choices.map(|(i, text)| format!("{}) {}", letter(i), language.of(text))).collect()
}

/// The pixel grids of a solution beside each other, or nothing.
pub fn grids(solution: &Solution) -> String {
    ascii::side_by_side(&solution.grids, TERMINAL_COLUMNS)
}

/// What the marks of its grids mean, where there are other marks than drawn and not drawn.
pub fn legend(solution: &Solution, language: Language) -> Option<&'static str> {
    let mut rows = solution.grids.iter().flat_map(|(_, lines)| lines);
    let is_needed = rows.any(|row| row.contains(['-', '+', '2']));
    is_needed.then_some(match language {
        Language::English => {
            "# agrees, - missing, + too many, 2 twice, * rightly more than once, . neither"
        }
        Language::Chinese => "# 一致，- 缺失，+ 多余，2 画了两次，* 本应多次，. 两者都没有",
    })
}
