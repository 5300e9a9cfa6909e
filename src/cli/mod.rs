//! The command line: words to functions. Text goes to the writers it is given; only `main` exits.

mod cost;
mod course;
mod course_grade;
mod decisions;
mod digest;
mod engine;
mod exhaust;
mod explain;
pub mod fold;
mod guard;
mod inspect;
mod inspect_case;
mod invariant;
mod judge;
mod league;
mod misbehave;
mod page;
mod plan;
mod playground;
mod progress;
mod quiz;
mod render;
mod review;
mod shown;
mod specimens;
mod typed;
mod verify;
#[cfg(feature = "vulkan")]
mod vulkan;

use std::fmt;
use std::io::{self, BufRead, Write};
use std::path::Path;

use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
use guard::{Escape, Guarded};
use rasterproof_host::shell;
use rasterproof_host::text::{is_hidden, printable, printable_lines, printable_path};
use typed::Typed;

use crate::{hazard, lineup};

/// Exit codes.
pub mod exit {
    /// Everything agrees.
    pub const AGREES: u8 = 0;
    /// Something disagrees.
    pub const DISAGREES: u8 = 1;
    /// The command or its input cannot be used.
    pub const USAGE: u8 = 2;
}

const EXAMPLES: &str = "Examples:
  rasterproof                                     judge both rasterizers and both line drawers
  rasterproof --family sliver --cases 1000000     many cases of one family
  rasterproof --seconds 60 --seed 7               a minute of other cases
  rasterproof --plant inclusive-edges             judge a planted fault, to see a disagreement
  rasterproof inspect T2                          explain a named case
  rasterproof inspect T2 --pixel 3,3              explain a pixel of it
  rasterproof inspect 0.5,0.5 5.5,0.5 5.5,5.5     explain a triangle
  rasterproof inspect --line 0,0 8,3              explain a line
  rasterproof engine scanline < requests.txt      speak the line protocol
  rasterproof judge -- ./mine                     judge a program of yours, in any language
  rasterproof course                              write a rasterizer of your own, in twelve steps
  rasterproof render --scene cube                 a scene through the whole pipeline, by both
  rasterproof plan --scene panels                 the effects it calls for, and what the rest costs
  rasterproof specimens                           the published algorithms and their faults
  rasterproof verify --invariant vertex-order     check one invariant; all checks every one
  rasterproof mutants                             which invariant kills which planted fault
  rasterproof exhaust triangles                   every triangle of a small window, certified
  rasterproof review                              changed snapshots, old beside new
  rasterproof cost --quick                        what each step of accuracy costs in time
  rasterproof playground                          drag a corner in the browser, watch every engine
  rasterproof quiz 2                              exercises of a chapter, answered and explained
  rasterproof list                                families, cases, engines, faults, invariants

Exit status: 0 all agree, 1 something disagrees, 2 usage or bad input.";

/// Two rasterizers, two line drawers and an exact oracle, compared pixel for pixel.
#[derive(Parser, Debug)]
#[command(name = "rasterproof", version, after_help = EXAMPLES, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    verify: verify::VerifyArguments,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Judge every engine on every family of cases (the default)
    Verify(verify::VerifyArguments),
    /// Explain one case: coordinates, a named case, or FAMILY#NUMBER
    Inspect(inspect::InspectArguments),
    /// Answer requests of the line protocol on standard input
    #[command(after_help = engine::HELP)]
    Engine {
        /// The engine that answers
        #[arg(value_parser = engine::names())]
        name: String,
        /// Break the protocol, to see the judge notice
        #[arg(long, value_name = "FAULT", hide = true)]
        plant: Option<misbehave::Fault>,
    },
    /// Judge any program that speaks the line protocol: rasterproof judge -- CMD
    #[command(after_help = judge::HELP)]
    Judge(Box<judge::JudgeArguments>),
    /// Twelve steps from a pixel to four samples, for students; points, for teachers
    #[command(after_help = course::HELP)]
    Course(course::CourseArguments),
    /// Show the published algorithms, how often they fail, and a picture of each fault
    Specimens(specimens::SpecimensArguments),
    /// Draw a scene of the book, or a model, by either rasterizer or by both
    Render(Box<render::RenderArguments>),
    /// Show which effects a scene calls for, why, and what leaving out the rest saves
    Plan(Box<plan::PlanArguments>),
    /// Show which invariant kills which planted fault
    Mutants(invariant::MutantsArguments),
    /// Judge every case of a finite set, and certify it
    #[command(after_help = exhaust::HELP)]
    Exhaust(exhaust::ExhaustArguments),
    /// Join the certificates of the shards of `exhaust`
    Merge(exhaust::MergeArguments),
    /// Show snapshots that changed, and how to accept them
    Review(review::ReviewArguments),
    /// Show what accuracy costs in time: every rung of every ladder, verified, then timed
    Cost(cost::CostArguments),
    /// Hash everything the engines compute for a seed, to compare machines
    #[command(after_help = digest::HELP)]
    Digest(digest::DigestArguments),
    /// Write the playground: a page to drag corners on, with these engines inside
    #[command(after_help = playground::HELP)]
    Playground(playground::PlaygroundArguments),
    /// Ask the exercises of the pages, and explain each answer with its pixel grid
    Quiz(quiz::QuizArguments),
    /// List families, named cases, engines, planted faults and invariants
    List,
}

/// Something wrong with the input: what, and what to do about it.
#[derive(Debug)]
pub enum Failure {
    /// A message for standard error; exit status 2.
    Usage(String),
    /// Reading or writing failed.
    Io(io::Error),
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(message) => f.write_str(message),
            Self::Io(error) => write!(f, "{error}"),
        }
    }
}

fn usage(message: impl Into<String>) -> Failure {
    Failure::Usage(message.into())
}

/// Where a command reads and writes.
pub struct Streams<'a> {
    /// Standard input.
    pub input: &'a mut dyn BufRead,
    /// Standard output.
    pub output: &'a mut dyn Write,
    /// Standard error.
    pub errors: &'a mut dyn Write,
    /// Whether a progress bar may be drawn on the terminal.
    pub progress: bool,
    /// Whether text may be coloured: standard output is a terminal and nobody objects.
    pub colour: bool,
    /// Columns of the terminal; text is broken to fit.
    pub columns: usize,
}

/// Whether a word is a coordinate such as -1.5,3, which is no option.
fn is_coordinate(word: &str) -> bool {
    let number = |c: char| c.is_ascii_digit() || c == '.';
    word.contains(',') && word.strip_prefix('-').is_some_and(|rest| rest.starts_with(number))
}

/// The arguments, and the same as a command that can be printed.
fn parse(words: Vec<String>) -> Result<(Arguments, Typed), clap::Error> {
    // A space in front of a coordinate tells the parser that it is no option. After -- come the words
    // of somebody else, which stay as they are.
    let mut ours = true;
    let words = words.into_iter().map(|word| {
        ours &= word != "--";
        if ours && is_coordinate(&word) { format!(" {word}") } else { word }
    });
    let mut command = Arguments::command();
    let matches = command.try_get_matches_from_mut(words)?;
    let arguments =
        Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut command))?;
    Ok((arguments, Typed::of(&command, &matches)))
}

/// What the parser says of words that it refuses. It repeats them as they are, so they are made
/// printable before.
fn refusal(error: clap::Error, words: &[String]) -> clap::Error {
    if !words.iter().any(|word| word.chars().any(is_hidden)) {
        return error;
    }
    parse(words.iter().map(|word| printable(word).into_owned()).collect()).err().unwrap_or(error)
}

/// Runs a command line, the program's name first, and returns the exit status.
pub fn run(words: impl IntoIterator<Item = String>, streams: &mut Streams<'_>) -> u8 {
    let words: Vec<String> = words.into_iter().collect();
    // What machines read keeps its lines.
    let ours = words.iter().take_while(|word| *word != "--");
    let for_machines = { ours }.any(|word| word == "--json" || word.starts_with("--format"));
    let (arguments, typed) = match parse(words.clone()) {
        Ok(parsed) => parsed,
        Err(error) => {
            let error = refusal(error, &words);
            let text = printable_lines(&error.render().to_string()).into_owned();
            let asked = !error.use_stderr();
            let stream: &mut dyn Write = if asked { streams.output } else { streams.errors };
            // Nobody is left to tell if this fails.
            let _ = stream.write_all(text.as_bytes());
            return if asked { exit::AGREES } else { exit::USAGE };
        }
    };
    quiet_engines();
    let Streams { progress, colour, columns, .. } = *streams;
    let mut folded;
    let for_machines = for_machines
        || matches!(
            arguments.command,
            Some(
                Command::Engine { .. }
                    | Command::Exhaust(_)
                    | Command::Merge(_)
                    | Command::Digest(_)
            )
        );
    let escape = match (for_machines, colour) {
        _ if matches!(arguments.command, Some(Command::Engine { plant: Some(_), .. })) => {
            Escape::Kept
        }
        (true, _) => Escape::Json,
        (false, true) => Escape::WordsAndColours,
        (false, false) => Escape::Words,
    };
    let mut guarded = Guarded::new(streams.output, escape);
    let output: &mut dyn Write = match for_machines {
        true => &mut guarded,
        false => {
            folded = fold::Folded::new(&mut guarded, columns, program());
            &mut folded
        }
    };
    let kept = escape == Escape::Kept;
    let mut errors = Guarded::new(streams.errors, if kept { escape } else { Escape::Words });
    let (input, errors) = (&mut *streams.input, &mut errors);
    let streams = &mut Streams { input, output, errors, progress, colour, columns };
    let result = match &arguments.command {
        None => verify::run(&arguments.verify, &typed, streams),
        Some(Command::Verify(arguments)) => verify::run(arguments, &typed, streams),
        Some(Command::Inspect(arguments)) => inspect::run(arguments, &typed, streams),
        Some(Command::Engine { name, plant: None }) => engine::run(name, streams),
        Some(Command::Engine { name, plant: Some(fault) }) => misbehave::run(name, *fault, streams),
        Some(Command::Judge(arguments)) => judge::run(arguments, &typed, streams),
        Some(Command::Course(arguments)) => course::run(arguments, streams),
        Some(Command::Specimens(arguments)) => specimens::run(arguments, &typed, streams),
        Some(Command::Render(arguments)) => render::run(arguments, &typed, streams),
        Some(Command::Plan(arguments)) => plan::run(arguments, &typed, streams),
        Some(Command::Mutants(arguments)) => invariant::mutants(arguments, streams),
        Some(Command::Exhaust(arguments)) => exhaust::run(arguments, streams),
        Some(Command::Merge(arguments)) => exhaust::merge(arguments, streams),
        Some(Command::Review(arguments)) => review::run(arguments, streams),
        Some(Command::Cost(arguments)) => cost::run(arguments, &typed, streams),
        Some(Command::Digest(arguments)) => digest::run(arguments, streams),
        Some(Command::Playground(arguments)) => playground::run(arguments, streams),
        Some(Command::Quiz(arguments)) => quiz::run(arguments, streams),
        Some(Command::List) => list(streams),
    };
    let result = result.and_then(|status| Ok(streams.output.flush().map(|()| status)?));
    match result {
        Ok(status) => status,
        // The reader has seen enough, as in `rasterproof list | head`.
        Err(Failure::Io(error)) if error.kind() == io::ErrorKind::BrokenPipe => exit::AGREES,
        Err(failure) => {
            let _ = writeln!(streams.errors, "error: {failure}");
            exit::USAGE
        }
    }
}

/// Keeps the panics of engines off the terminal: they are part of the verdict. Others still show.
pub fn quiet_engines() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        let hook = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if !crate::verify::is_judging() {
                hook(info);
            }
        }));
    });
}

fn list(streams: &mut Streams<'_>) -> Result<u8, Failure> {
    let out = &mut streams.output;
    writeln!(out, "Families (rasterproof --family NAME, rasterproof inspect NAME#NUMBER):")?;
    for family in hazard::families() {
        write_entry(out, &format!("{:<16}", family.name), family.about)?;
    }
    writeln!(out, "\nFamilies off the grid, for the engines that do not snap:")?;
    for family in hazard::offgrid::FAMILIES {
        write_entry(out, &format!("{:<16}", family.name), family.about)?;
    }
    writeln!(out, "\nNamed cases (rasterproof inspect NAME):")?;
    for case in crate::scene::named::named() {
        write_entry(out, &format!("{:<5}", case.name), case.about)?;
    }
    writeln!(out, "\nEngines (rasterproof engine NAME):")?;
    for entry in lineup::ENTRIES.iter().chain(&lineup::SPECIMENS) {
        write_entry(out, &format!("{:<19}", entry.name), entry.about)?;
    }
    #[cfg(feature = "vulkan")]
    vulkan::list(out)?;
    writeln!(out, "\nPlanted faults (rasterproof --plant NAME; rasterproof mutants):")?;
    for (name, about) in crate::mutant::about::all() {
        write_entry(out, &format!("{name:<26}"), about)?;
    }
    invariant::list(streams)?;
    let out = &mut streams.output;
    writeln!(out, "\nScenes (rasterproof render --scene NAME):")?;
    for entry in crate::scene::chapters::SCENES {
        write_entry(out, &format!("{:<19}", entry.name), entry.about)?;
    }
    Ok(exit::AGREES)
}

/// Writes an entry of a list, what it is about beside its name.
fn write_entry(out: &mut dyn Write, name: &str, about: &str) -> io::Result<()> {
    writeln!(out, "  {name}  {about}")
}

/// Writes a file whole or not at all: first beside its place, then renamed.
fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let failed =
        |what: &str, error: io::Error| usage(format!("{what} {}: {error}", printable_path(path)));
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(|e| failed("cannot create the folder of", e))?;
    }
    let mut beside = path.as_os_str().to_owned();
    beside.push(".part");
    std::fs::write(&beside, bytes).map_err(|e| failed("cannot write", e))?;
    std::fs::rename(&beside, path).map_err(|e| {
        let _ = std::fs::remove_file(&beside);
        failed("cannot write", e)
    })
}

/// A whole number from zero.
fn parse_number(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| "expected a whole number from 0, for example 7".to_owned())
}

/// A number of seconds; whether there can be so many is for the command to say.
fn parse_seconds(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| "expected a number of seconds, for example 60".to_owned())
}

/// A count of at least one.
fn parse_count(text: &str) -> Result<u64, String> {
    let count = text.parse().ok().filter(|count| *count > 0);
    count.ok_or_else(|| "expected a whole number from 1, for example 1000000".to_owned())
}

/// Refuses a name that promises another format than the bytes have.
fn png_name(path: &Path) -> Result<(), Failure> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some(ending) if ending.eq_ignore_ascii_case("png") => Ok(()),
        _ => Err(usage(format!(
            "{}: the picture is a PNG: end its name with .png",
            printable_path(path)
        ))),
    }
}

/// Writes a picture that nobody asked for, and says where: a folder that cannot be written costs a
/// warning, and not the verdict.
fn write_unasked(path: &Path, bytes: &[u8], streams: &mut Streams<'_>) -> Result<(), Failure> {
    match write_file(path, bytes) {
        Ok(()) => writeln!(streams.output, "drawn in {}", printable_path(path))?,
        Err(failure) => writeln!(streams.errors, "warning: no picture: {failure}")?,
    }
    Ok(())
}

/// How this program was called, for commands that can be copied: through cargo where cargo started
/// it, else by the path that was typed, else by its name.
fn program() -> String {
    let word = std::env::args().next().unwrap_or_default();
    let path = Path::new(&word);
    // cargo calls it as target/PROFILE/rasterproof.
    let profile = path.parent().and_then(Path::file_name).and_then(|name| name.to_str());
    match profile.filter(|_| path.is_relative() && path.components().count() > 1) {
        None => "rasterproof".to_owned(),
        Some(_) if std::env::var_os("CARGO").is_none() => shell::quote(&word).into_owned(),
        Some("debug") => "cargo run --".to_owned(),
        Some("release") => "cargo run --release --".to_owned(),
        Some(profile) => format!("cargo run --profile {} --", shell::quote(profile)),
    }
}
