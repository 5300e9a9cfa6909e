//! `rasterproof quiz`: the exercises of the pages, one at a time, each explained with its pixel grid.

use std::io::{BufRead, Write};
use std::path::PathBuf;

use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits, read_files};

use super::page::print;
use super::{InputError, Status, Streams, exit, usage};
use rasterproof_report::html::{Excerpt, Report};
use rasterproof_report::table::Table;
use rasterproof_report::text;
use rasterproof_teaching::quiz::page::{choices, grids, legend};
use rasterproof_teaching::quiz::{CHAPTERS, Chapter, Exercise, Language, chapter, order};

#[derive(clap::Args, Debug)]
#[command(after_help = super::help!("quiz"))]
pub struct QuizArguments {
    /// The chapter: 2, or the name of its page, ch02 or effects [default: all of them]
    chapter: Option<String>,
    /// Ask in another order, which this number decides
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// List the chapters and their exercises instead of asking
    #[arg(long)]
    list: bool,
    /// Print this many questions as a paper instead of asking; --seed chooses them
    #[arg(long, value_name = "N", conflicts_with_all = ["list", "answers"],
        value_parser = super::whole::<u16>(1..=1000))]
    paper: Option<u16>,
    /// Print the key of the paper: the answers and why
    #[arg(long, requires = "paper")]
    key: bool,
    /// Read the answers, one a line, from this file; - is standard input
    #[arg(long, value_name = "FILE", default_value = "-")]
    answers: PathBuf,
    /// The language of the questions
    #[arg(long, value_name = "LANGUAGE", default_value = "en", value_parser = super::one_of_explained(LANGUAGES))]
    language: Language,
}

const LANGUAGES: [(&str, Language, &str); 2] =
    [("en", Language::English, "English"), ("zh", Language::Chinese, "Chinese")];

pub fn run(arguments: &QuizArguments, streams: &mut Streams<'_>) -> Status {
    let language = arguments.language;
    let wanted: Vec<&Chapter> = match &arguments.chapter {
        None => CHAPTERS.iter().collect(),
        Some(word) => vec![chapter(word).ok_or_else(|| {
            let words = CHAPTERS.iter().map(Chapter::word).collect::<Vec<_>>().join(", ");
            usage(format!("there is no chapter '{word}' with exercises; give one of {words}"))
        })?],
    };
    if arguments.list {
        return list(&wanted, language, streams);
    }
    let exercises: Vec<_> =
        wanted.iter().flat_map(|c| c.exercises.iter().map(|exercise| (*c, exercise))).collect();
    let order = match arguments.seed {
        None => (0..exercises.len()).collect(),
        Some(seed) => order(exercises.len(), seed),
    };
    let asked: Vec<_> = order.into_iter().map(|i| exercises[i]).collect();
    if let Some(count) = arguments.paper {
        return paper(&asked, count.into(), arguments, language, streams);
    }
    let is_file = arguments.answers.as_os_str() != "-";
    let (mut text, mut name) = (String::new(), "standard input".to_owned());
    if is_file {
        text = input::read_text(&arguments.answers, limits::NOTE_BYTES)
            .map_err(|error| usage(format!("{error}\nGive a file with one answer in each line")))?;
        name = printable_path(&arguments.answers);
    } else {
        read_files::note_standard_input();
    }
    let mut quiz = Quiz {
        input: if is_file { &mut text.as_bytes() } else { &mut *streams.input },
        output: &mut *streams.output,
        name,
        line: 0,
        is_watched: streams.progress && !is_file,
        language,
    };
    quiz.ask_all(&asked)
}

fn list(chapters: &[&Chapter], language: Language, streams: &mut Streams<'_>) -> Status {
    let table = |chapter: &&Chapter| {
        let (word, exercises) = (chapter.word(), &chapter.exercises);
        let title = format!("{word} {} ({})", language.of(&chapter.title), exercises.len());
        let questions = (1..).zip(exercises);
        let said =
            |(number, one): (usize, &Exercise)| format!("{number}. {}", language.of(&one.question));
        Table::of_notes(&title, questions.map(said).collect())
    };
    let tables = chapters.iter().map(table).collect();
    print(Report { tables, ..Report::default() }, exit::AGREES, streams)
}

/// The first questions as a paper, or their answers as its key.
fn paper(
    asked: &[(&Chapter, &Exercise)],
    count: usize,
    arguments: &QuizArguments,
    language: Language,
    streams: &mut Streams<'_>,
) -> Status {
    if asked.len() < count {
        return Err(usage(format!(
            "there are {} questions, {count} were asked for\n  name fewer, or all chapters",
            asked.len()
        )));
    }
    let seed = arguments.seed.map_or_else(String::new, |seed| format!(" {seed}"));
    let head = match (language, arguments.key) {
        (Language::English, false) => format!("Paper{seed}: {count} questions"),
        (Language::English, true) => format!("Key of paper{seed}"),
        (Language::Chinese, false) => format!("试卷{seed}：共 {count} 题"),
        (Language::Chinese, true) => format!("试卷{seed} 的答案"),
    };
    let question = |(number, (chapter, exercise)): (usize, &(&Chapter, &Exercise))| {
        let solution = exercise.solution();
        if arguments.key {
            let why = exercise.explanation(language, &solution);
            let title = format!("{number}. {} [{}] {why}", solution.answer.text(), chapter.page);
            return Excerpt { title, ..Excerpt::default() };
        }
        let title = format!("{number}. {}", exercise.question_with_form(language, &solution));
        let grid = choices(exercise, language).into_iter().map(|choice| format!("   {choice}\n"));
        Excerpt { title, grid: grid.collect(), ..Excerpt::default() }
    };
    let excerpts = (1..).zip(&asked[..count]).map(question).collect();
    print(Report { about: head, excerpts, ..Report::default() }, exit::AGREES, streams)
}

struct Quiz<'a> {
    input: &'a mut dyn BufRead,
    output: &'a mut dyn Write,
    name: String,
    line: usize,
    /// Somebody sits at a terminal: there is a prompt, and one may try again.
    is_watched: bool,
    language: Language,
}

/// What is said of a right answer, of a wrong one, and of none.
const PHRASES: [[&str; 3]; 2] = [["Right", "No", "Passed"], ["对", "不对", "跳过"]];

impl Quiz<'_> {
    fn ask_all(&mut self, asked: &[(&Chapter, &Exercise)]) -> Status {
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
        Ok(exit::of(right == all))
    }

    /// Asks one exercise; whether it was answered rightly, or nothing at the end of input.
    fn ask(&mut self, head: &str, exercise: &Exercise) -> Result<Option<bool>, InputError> {
        let solution = exercise.solution();
        let question = exercise.question_with_form(self.language, &solution);
        let grid = choices(exercise, self.language).join("\n");
        let asked = Excerpt { title: format!("{head}\n{question}"), grid, ..Excerpt::default() };
        self.output.write_all(text::excerpt(&asked, text::WIDTH).as_bytes())?;
        let given = loop {
            if self.is_watched {
                write!(self.output, "> ")?;
                self.output.flush()?;
            }
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
                    return Err(usage(format!("{}, line {}: {remedy}", self.name, self.line)));
                }
            }
        };
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
        let answered = Excerpt { title, grid, notes, ..Excerpt::default() };
        self.output.write_all(text::excerpt(&answered, text::WIDTH).as_bytes())?;
        Ok(Some(is_right))
    }
}
