//! `rasterproof quiz`: the exercises of the pages, one at a time, each explained with its pixel grid.

use std::io::{BufRead, Write};
use std::path::PathBuf;

use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits, read_files};

use super::{Failure, Status, Streams, exit, usage};
use rasterproof_teaching::quiz::page::{TERMINAL_COLUMNS, choices, grids, legend, wrap};
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
        value_parser = clap::value_parser!(u16).range(1..=1000))]
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

/// How many exercises were asked, answered, and answered rightly.
#[derive(Default)]
struct Score {
    answered: usize,
    right: usize,
}

pub fn run(arguments: &QuizArguments, streams: &mut Streams<'_>) -> Status {
    let language = arguments.language;
    let wanted: Vec<&Chapter> = match &arguments.chapter {
        None => CHAPTERS.iter().collect(),
        Some(word) => vec![chapter(word).ok_or_else(|| unknown(word))?],
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
    if !is_file {
        read_files::note_standard_input();
    }
    let text = if is_file {
        input::read_text(&arguments.answers, limits::NOTE_BYTES)
            .map_err(|error| usage(format!("{error}\nGive a file with one answer in each line")))?
    } else {
        String::new()
    };
    let mut file = text.as_bytes();
    let mut quiz = Quiz {
        input: if is_file { &mut file } else { &mut *streams.input },
        output: &mut *streams.output,
        name: if is_file {
            printable_path(&arguments.answers)
        } else {
            "standard input".to_owned()
        },
        line: 0,
        is_watched: streams.progress && !is_file,
        language,
    };
    quiz.ask_all(&asked)
}

fn unknown(word: &str) -> Failure {
    let words: Vec<_> = CHAPTERS.iter().map(Chapter::word).collect();
    usage(format!("there is no chapter '{word}' with exercises; give one of {}", words.join(", ")))
}

fn list(chapters: &[&Chapter], language: Language, streams: &mut Streams<'_>) -> Status {
    for chapter in chapters {
        let head = format!("{:>9}  {}", chapter.word(), language.of(&chapter.title));
        writeln!(streams.output, "{head} ({})", chapter.exercises.len())?;
        for (number, exercise) in (1..).zip(&chapter.exercises) {
            for (i, line) in wrap(language.of(&exercise.question), 84).into_iter().enumerate() {
                let number = if i == 0 { format!("{number}.") } else { String::new() };
                writeln!(streams.output, "           {number:<3}{line}")?;
            }
        }
    }
    Ok(exit::AGREES)
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
    writeln!(streams.output, "{head}\n")?;
    for (number, (chapter, exercise)) in (1..).zip(&asked[..count]) {
        let solution = exercise.solution();
        let text = if arguments.key {
            let why = exercise.explanation(language, &solution);
            format!("{number}. {} [{}] {why}", solution.answer.text(), chapter.page)
        } else {
            format!("{number}. {}", exercise.question_with_form(language, &solution))
        };
        for line in wrap(&text, TERMINAL_COLUMNS) {
            writeln!(streams.output, "{line}")?;
        }
        for choice in choices(exercise, language).iter().filter(|_| !arguments.key) {
            writeln!(streams.output, "   {choice}")?;
        }
        writeln!(streams.output)?;
    }
    Ok(exit::AGREES)
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

struct Phrases {
    right: &'static str,
    wrong: &'static str,
    passed: &'static str,
}

const PHRASES: [Phrases; 2] = [
    Phrases { right: "Right", wrong: "No", passed: "Passed" },
    Phrases { right: "对", wrong: "不对", passed: "跳过" },
];

impl Quiz<'_> {
    fn ask_all(&mut self, asked: &[(&Chapter, &Exercise)]) -> Status {
        let mut score = Score::default();
        for (i, &(chapter, exercise)) in asked.iter().enumerate() {
            let name = chapter.name(self.language);
            writeln!(self.output, "{} / {}  {name}", i + 1, asked.len())?;
            match self.ask(exercise)? {
                None => break,
                Some(is_right) => {
                    score.answered += 1;
                    score.right += usize::from(is_right);
                }
            }
        }
        let (right, all, left) = (score.right, asked.len(), asked.len() - score.answered);
        match self.language {
            Language::English => {
                let rest = if left > 0 { format!(", {left} not answered") } else { String::new() };
                writeln!(self.output, "{right} of {all} right{rest}")?;
            }
            Language::Chinese => {
                let rest = if left > 0 { format!("，{left} 题未答") } else { String::new() };
                writeln!(self.output, "{all} 题答对 {right} 题{rest}")?;
            }
        }
        Ok(if right == all { exit::AGREES } else { exit::DISAGREES })
    }

    /// Asks one exercise; whether it was answered rightly, or nothing at the end of input.
    fn ask(&mut self, exercise: &Exercise) -> Result<Option<bool>, Failure> {
        let solution = exercise.solution();
        let question = exercise.question_with_form(self.language, &solution);
        for line in wrap(&question, TERMINAL_COLUMNS) {
            writeln!(self.output, "{line}")?;
        }
        for choice in choices(exercise, self.language) {
            writeln!(self.output, "  {choice}")?;
        }
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
        let phrases = &PHRASES[self.language as usize];
        let is_right = given.is_some_and(|given| solution.answer.accepts(given));
        let verdict = match given {
            None => phrases.passed,
            Some(_) if is_right => phrases.right,
            Some(_) => phrases.wrong,
        };
        let why = exercise.explanation(self.language, &solution);
        let answer = solution.answer.text();
        let text = match self.language {
            Language::English => format!("{verdict}: {answer}. {why}"),
            Language::Chinese => format!("{verdict}：{answer}。{why}"),
        };
        for line in wrap(&text, TERMINAL_COLUMNS) {
            writeln!(self.output, "{line}")?;
        }
        write!(self.output, "{}", grids(&solution))?;
        if let Some(legend) = legend(&solution, self.language) {
            writeln!(self.output, "{legend}")?;
        }
        writeln!(self.output)?;
        Ok(Some(is_right))
    }
}
