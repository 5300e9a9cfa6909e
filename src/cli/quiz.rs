//! `rasterproof quiz`: the exercises of the pages, one at a time, each explained with its pixel grid.

use std::path::PathBuf;

use rasterproof_host::text::printable_path;
use rasterproof_host::{identity, input, limits};

use super::page::print;
use super::{Status, Streams, exit, usage};
use rasterproof_teaching::quiz::Language;
use rasterproof_teaching::quiz::ask::{self, Quiz};

#[derive(clap::Args, Debug)]
#[command(after_help = super::help!("quiz"))]
pub struct QuizArguments {
    /// The chapter: 5 or 2b, or the name of its page, effects [default: all of them]
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

/// Asks the exercises, lists them, or prints a paper of them.
pub fn run(arguments: &QuizArguments, streams: &mut Streams<'_>) -> Status {
    let &QuizArguments { language, seed, key, .. } = arguments;
    let chapters = ask::chapters(arguments.chapter.as_deref())?;
    if arguments.list {
        return print(ask::list(&chapters, language), exit::AGREES, streams);
    }
    let asked = ask::exercises(&chapters, seed);
    if let Some(count) = arguments.paper {
        let paper = ask::paper(&asked, count.into(), seed, key, language)?;
        return print(paper, exit::AGREES, streams);
    }
    // Answers come from a file that was named, or from whoever sits there.
    let is_file = arguments.answers.as_os_str() != "-";
    let (mut text, mut name) = (String::new(), "standard input".to_owned());
    if is_file {
        text = input::read_text(&arguments.answers, limits::NOTE_BYTES)
            .map_err(|error| usage(format!("{error}\nGive a file with one answer in each line")))?;
        name = printable_path(&arguments.answers);
    } else {
        identity::note_standard_input();
    }
    let mut quiz = Quiz {
        input: if is_file { &mut text.as_bytes() } else { &mut *streams.input },
        output: &mut *streams.output,
        name,
        line: 0,
        is_watched: streams.progress && !is_file,
        language,
    };
    Ok(exit::of(quiz.ask_all(&asked)?))
}
