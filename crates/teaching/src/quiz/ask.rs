//! Exercises asked one by one, listed, and printed as a paper.

use std::io::{BufRead, Write};

use rasterproof_host::text::printable;
use rasterproof_report::html::{Excerpt, Report};
use rasterproof_report::table::Table;
use rasterproof_report::text;

use super::page::{choices, grids, legend};
use super::{CHAPTERS, Chapter, Exercise, Language, chapter, order};

type Error = Box<dyn std::error::Error + Send + Sync>;

/// The chapter of a word, or all chapters without one.
///
/// # Errors
/// No chapter has that name.
pub fn chapters(word: Option<&str>) -> Result<Vec<&'static Chapter>, String> {
    let Some(word) = word else { return Ok(CHAPTERS.iter().collect()) };
    let found = chapter(word).ok_or_else(|| {
        let words = CHAPTERS.iter().map(Chapter::word).collect::<Vec<_>>().join(", ");
        format!("there is no chapter '{word}' with exercises; give one of {words}")
    })?;
    Ok(vec![found])
}

/// The exercises of chapters as they stand there, or in the order of a seed.
pub fn exercises<'a>(
    chapters: &[&'a Chapter],
    seed: Option<u64>,
) -> Vec<(&'a Chapter, &'a Exercise)> {
    let all: Vec<_> =
        chapters.iter().flat_map(|c| c.exercises.iter().map(|exercise| (*c, exercise))).collect();
    match seed {
        None => all,
        Some(seed) => order(all.len(), seed).into_iter().map(|i| all[i]).collect(),
    }
}

/// The questions of chapters, numbered.
pub fn list(chapters: &[&Chapter], language: Language) -> Report {
    let table = |chapter: &&Chapter| {
        let (word, exercises) = (chapter.word(), &chapter.exercises);
        let title = format!("{word} {} ({})", language.of(&chapter.title), exercises.len());
        let questions = (1..).zip(exercises);
        let said =
            |(number, one): (usize, &Exercise)| format!("{number}. {}", language.of(&one.question));
        Table::of_notes(&title, questions.map(said).collect())
    };
    let tables = chapters.iter().map(table).collect();
    Report { tables, ..Report::default() }
}

/// The first questions as a paper, or their answers as its key. The seed that chose them is part of the title.
///
/// # Errors
/// There are fewer questions.
pub fn paper(
    asked: &[(&Chapter, &Exercise)],
    count: usize,
    seed: Option<u64>,
    is_key: bool,
    language: Language,
) -> Result<Report, String> {
    if asked.len() < count {
        return Err(format!(
            "there are {} questions, {count} were asked for\n  name fewer, or all chapters",
            asked.len()
        ));
    }
    let seed = seed.map_or_else(String::new, |seed| format!(" {seed}"));
    // The seed stands in the title, so that the same paper can be printed again.
    let head = match (language, is_key) {
        (Language::English, false) => format!("Paper{seed}: {count} questions"),
        (Language::English, true) => format!("Key of paper{seed}"),
        (Language::Chinese, false) => format!("试卷{seed}：共 {count} 题"),
        (Language::Chinese, true) => format!("试卷{seed} 的答案"),
    };
    let question = |(number, (chapter, exercise)): (usize, &(&Chapter, &Exercise))| {
        let solution = exercise.solution();
        // The key has answers and reasons, and no questions.
        if is_key {
            let why = exercise.explanation(language, &solution);
            let title = format!("{number}. {} [{}] {why}", solution.answer.text(), chapter.page);
            return Excerpt { title, ..Excerpt::default() };
        }
        let title = format!("{number}. {}", exercise.question_with_form(language, &solution));
        let grid = choices(exercise, language).into_iter().map(|choice| format!("   {choice}\n"));
        Excerpt { title, grid: grid.collect(), ..Excerpt::default() }
    };
    let excerpts = (1..).zip(&asked[..count]).map(question).collect();
    Ok(Report { about: head, excerpts, ..Report::default() })
}

/// A conversation: where answers come from, and where questions go.
pub struct Quiz<'a> {
    pub input: &'a mut dyn BufRead,
    pub output: &'a mut dyn Write,
    /// What the input is called in errors.
    pub name: String,
    /// Lines of the input that were read.
    pub line: usize,
    /// Somebody sits at a terminal: there is a prompt, and one may try again.
    pub is_watched: bool,
    pub language: Language,
}

/// What is said of a right answer, of a wrong one, and of none.
const PHRASES: [[&str; 3]; 2] = [["Right", "No", "Passed"], ["对", "不对", "跳过"]];

impl Quiz<'_> {
    /// Asks one after the other, and says how many were right. Whether all were.
    ///
    /// # Errors
    /// The input cannot be read, the output cannot be written, or a line of a file is no answer.
    pub fn ask_all(&mut self, asked: &[(&Chapter, &Exercise)]) -> Result<bool, Error> {
        let (mut left, mut right, all) = (asked.len(), 0, asked.len());
        for (number, &(chapter, exercise)) in (1..).zip(asked) {
            let head = format!("{number} / {all}  {}", chapter.name(self.language));
            let Some(is_right) = self.ask(&head, exercise)? else { break };
            left -= 1;
            right += usize::from(is_right);
        }
        let said = match (self.language, left) {
            (Language::English, 0) => format!("{right} of {all} right"),
            (Language::English, left) => format!("{right} of {all} right, {left} not answered"),
            (Language::Chinese, 0) => format!("{all} 题答对 {right} 题"),
            (Language::Chinese, left) => format!("{all} 题答对 {right} 题，{left} 题未答"),
        };
        writeln!(self.output, "{said}")?;
        Ok(right == all)
    }

    /// Asks one exercise; whether it was answered rightly, or nothing at the end of input.
    fn ask(&mut self, head: &str, exercise: &Exercise) -> Result<Option<bool>, Error> {
        let solution = exercise.solution();
        let question = exercise.question_with_form(self.language, &solution);
        let grid = choices(exercise, self.language).join("\n");
        let asked = Excerpt { title: format!("{head}\n{question}"), grid, ..Excerpt::default() };
        self.output.write_all(text::excerpt(&asked, text::WIDTH).as_bytes())?;
        // Asks until there is an answer, an empty line, or the end of the input.
        let given = loop {
            if self.is_watched {
                write!(self.output, "> ")?;
                self.output.flush()?;
            }
            // At the end of the input, the rest of the questions is not answered.
            let mut line = String::new();
            if self.input.read_line(&mut line)? == 0 {
                writeln!(self.output)?;
                return Ok(None);
            }
            self.line += 1;
            if line.trim().is_empty() {
                break None;
            }
            // The program's errors are in English; who answers at a terminal is answered in turn.
            let language = if self.is_watched { self.language } else { Language::English };
            match solution.answer.read(&line, &exercise.choices, language) {
                Ok(given) => break Some(given),
                // Who is there may try again; a file is wrong in that line.
                Err(remedy) if self.is_watched => writeln!(self.output, "{remedy}")?,
                Err(remedy) => {
                    let remedy = printable(&remedy);
                    return Err(format!("{}, line {}: {remedy}", self.name, self.line).into());
                }
            }
        };
        // What was given is judged, and the right answer is said in any case.
        let [is_said_right, wrong, passed] = PHRASES[self.language as usize];
        let is_right = given.is_some_and(|given| solution.answer.accepts(given));
        let verdict = match given {
            None => passed,
            Some(_) if is_right => is_said_right,
            Some(_) => wrong,
        };
        let why = exercise.explanation(self.language, &solution);
        let answer = solution.answer.text();
        let title = match self.language {
            Language::English => format!("{verdict}: {answer}. {why}"),
            Language::Chinese => format!("{verdict}：{answer}。{why}"),
        };
        let (grid, notes) = (grids(&solution), legend(&solution, self.language));
        let notes = notes.map(str::to_owned).into_iter().collect();
        // The reason follows the verdict, with the pixels that show it.
        let answered = Excerpt { title, grid, notes, ..Excerpt::default() };
        self.output.write_all(text::excerpt(&answered, text::WIDTH).as_bytes())?;
        Ok(Some(is_right))
    }
}
