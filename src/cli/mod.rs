//! The command line: words to functions. Text goes to the writers it is given; only `main` exits.

mod cost;
mod course;
mod course_grade;
mod digest;
mod engine;
mod exhaust;
mod fixtures;
mod inspect;
mod inspect_case;
mod invariant;
mod judge;
mod judge_checkpoint;
mod league;
pub mod outlet;
mod page;
mod plan;
mod playground;
mod progress;
mod quiz;
mod render;
mod review;
mod specimens;
mod starters;
mod study;
mod threads;
mod tolerances;
mod typed;
mod verify;
mod view;
#[cfg(feature = "vulkan")]
mod vulkan;
mod watch;

use std::error::Error;
use std::ffi::{OsStr, OsString};
use std::fmt::Display;
use std::io::{self, BufRead, Write};
use std::ops::RangeInclusive;
use std::path::Path;
use std::time::Duration;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
pub use outlet::Delivery;
use outlet::{Escape, Outlet};
use rasterproof_host::output::{self, Output};
use rasterproof_host::text::{is_hidden, printable, printable_lines, printable_path};
use rasterproof_host::{identity, shell};
use typed::Typed;

use rasterproof_registry::engines;
use rasterproof_render::scene;
use rasterproof_report::html::Report;
use rasterproof_report::table::{Row, Table};
use rasterproof_teaching::course::misconceptions;
use rasterproof_verify::cases;
use rasterproof_verify::cases::facts::{self, design};
use rasterproof_verify::mistakes::{self, Explanation};
use rasterproof_verify::partition;

pub mod exit {
    pub const AGREES: u8 = 0;
    pub const DISAGREES: u8 = 1;
    /// The command or its input cannot be used, or something could not be judged.
    pub const USAGE: u8 = 2;

    pub const fn of(agrees: bool) -> u8 {
        if agrees { AGREES } else { DISAGREES }
    }
}

/// A text below the options of a command.
macro_rules! help {
    ($name:literal) => {
        include_str!(concat!("help/", $name, ".txt")).trim_ascii_end()
    };
}
use help;

/// Two rasterizers, two line drawers and an exact oracle, compared pixel for pixel.
#[derive(Parser, Debug)]
#[command(name = "rasterproof", version, after_help = help!("rasterproof"), args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    verify: verify::VerifyArguments,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// What is run where no command is named
    #[command(skip)]
    Unnamed(verify::VerifyArguments),
    /// Judge every engine on every family of cases (the default)
    Verify(Box<verify::VerifyCommand>),
    /// Explain one case: coordinates, a named case, or FAMILY#NUMBER
    Inspect(Box<inspect::InspectArguments>),
    /// Answer requests of the line protocol on standard input
    #[command(after_help = help!("engine"))]
    Engine {
        /// The engine that answers
        #[arg(value_parser = engine::names())]
        name: String,
    },
    /// Judge any program that speaks the line protocol: rasterproof judge -- CMD
    #[command(after_help = help!("judge"))]
    Judge(Box<judge::JudgeArguments>),
    /// Eighteen steps from a pixel to the levels of a texture, for students; points, for teachers
    #[command(after_help = help!("course"))]
    Course(course::CourseArguments),
    /// Show the published algorithms, how often they fail, and a picture of each fault
    Specimens(specimens::SpecimensArguments),
    /// Draw a scene of the book, or a model, by either rasterizer or by both
    Render(Box<render::RenderArguments>),
    /// Show which effects a scene calls for, why, and what leaving out the rest saves
    Plan(Box<plan::PlanArguments>),
    /// Show which hard cases a model contains, where, and what each choice costs on it
    #[command(after_help = help!("study"))]
    Study(Box<study::StudyArguments>),
    /// Show which invariant kills which planted fault
    Mutants(invariant::MutantsArguments),
    /// Show which faults the acceptance rules of test suites let through
    #[command(after_help = help!("tolerances"))]
    Tolerances(tolerances::TolerancesArguments),
    /// Judge every case of a finite set, and certify it
    #[command(after_help = help!("exhaust"))]
    Exhaust(exhaust::ExhaustArguments),
    /// Join the certificates of the shards of `exhaust`
    Merge(exhaust::MergeArguments),
    /// Show snapshots that changed, and how to accept them
    Review(review::ReviewArguments),
    /// Show what accuracy costs in time: every choice of arithmetic, verified, then timed
    Cost(Box<cost::CostArguments>),
    /// Hash everything the engines compute for a seed, to compare machines
    #[command(after_help = help!("digest"))]
    Digest(digest::DigestArguments),
    /// Print small hard cases with their pixels as JSON, for the test suites of other projects
    #[command(after_help = help!("fixtures"))]
    Fixtures(fixtures::FixturesArguments),
    /// Write the playground: a page to drag corners on, with these engines inside
    #[command(after_help = playground::HELP)]
    Playground(playground::PlaygroundArguments),
    /// Write the page that judges the graphics card of whoever opens it, in a browser
    #[command(after_help = playground::HELP)]
    YourGpu(playground::PlaygroundArguments),
    /// Ask the exercises of the pages, and explain each answer with its pixel grid
    Quiz(quiz::QuizArguments),
    /// List families, named cases, engines, planted faults and invariants
    List {
        /// List the facts of questions instead, of which the families of designs have every two together
        #[arg(long)]
        facts: bool,
        /// List the mistakes that the judge and the course know instead
        #[arg(long, conflicts_with = "facts")]
        mistakes: bool,
    },
}

/// Something wrong with the input: what, and what to do about it. Its exit status is 2.
type InputError = Box<dyn Error + Send + Sync>;

/// The exit status of a command, or why it has none.
type Status = Result<u8, InputError>;

fn usage(message: impl ToString) -> InputError {
    message.to_string().into()
}

/// A parser that takes one of these words for the value beside it.
fn one_of<T: Clone + Send + Sync + 'static>(
    choices: impl IntoIterator<Item = (&'static str, T)>,
) -> impl TypedValueParser<Value = T> {
    one_of_explained(choices.into_iter().map(|(word, value)| (word, value, "")))
}

/// The same for words that the help explains.
fn one_of_explained<T: Clone + Send + Sync + 'static>(
    choices: impl IntoIterator<Item = (&'static str, T, &'static str)>,
) -> impl TypedValueParser<Value = T> {
    let choices: Vec<_> = choices.into_iter().collect();
    let words = PossibleValuesParser::new(choices.iter().map(|(word, _, help)| {
        PossibleValue::new(*word).help(Some(*help).filter(|help| !help.is_empty()))
    }));
    words.try_map(move |word| {
        let found = choices.iter().find(|(choice, ..)| **choice == word);
        found.map(|(_, value, _)| value.clone()).ok_or("no such word")
    })
}

pub struct Streams<'a> {
    pub input: &'a mut dyn BufRead,
    pub output: &'a mut dyn Write,
    pub errors: &'a mut dyn Write,
    /// Whether a progress bar may be drawn on the terminal.
    pub progress: bool,
    /// Whether text may be coloured: standard output is a terminal and nobody objects.
    pub colour: bool,
    /// Columns of the terminal; text is broken to fit.
    pub columns: usize,
    /// Columns of the terminal of standard error; without one, messages are not broken.
    pub error_columns: usize,
    /// Whether the streams and files took what was written to them.
    pub delivery: Delivery,
}

/// Whether a word is a negative number such as -1 or -1/2, which is no option.
fn is_negative(word: &str) -> bool {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.';
    word.strip_prefix('-').is_some_and(|rest| rest.starts_with(is_of_number))
}

/// Whether a word is a coordinate such as -1.5,3, which is no option either.
fn is_coordinate(word: &str) -> bool {
    word.contains(',') && is_negative(word)
}

/// The arguments, and the same as a command that can be printed.
fn parse(words: Vec<OsString>) -> Result<(Arguments, Typed), clap::Error> {
    // A space in front of a coordinate tells the parser that it is no option, and so does a `=` between an option
    // and a negative number. After -- come the words of somebody else, which stay as they are.
    let mut ours = true;
    let mut given: Vec<OsString> = Vec::with_capacity(words.len());
    for word in words {
        let text = word.to_str().unwrap_or_default();
        ours &= text != "--";
        let option = given.last_mut().filter(|_| ours && is_negative(text));
        let is_option = |last: &OsStr| {
            last.to_str().is_some_and(|last| last.starts_with("--") && !last.contains('='))
        };
        if ours && is_coordinate(text) {
            given.push(format!(" {text}").into());
        } else if let Some(option) = option.filter(|last| is_option(last)) {
            option.push(format!("={text}"));
        } else {
            given.push(word);
        }
    }
    let mut command = Arguments::command();
    let matches = command.try_get_matches_from_mut(given)?;
    let arguments =
        Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut command))?;
    Ok((arguments, Typed::of(&command, &matches)))
}

/// What the parser says of words that it refuses, or that ask for help or the version. It repeats the words as they are, so
/// they are made printable before they are parsed.
fn refusal(mut error: clap::Error, words: &[OsString]) -> String {
    let shown = |word: &OsString| printable(&word.to_string_lossy()).into_owned();
    let is_not_text = error.kind() == ErrorKind::InvalidUtf8;
    let has_hidden = |word: &OsString| word.to_string_lossy().chars().any(is_hidden);
    if words.iter().any(has_hidden) && !is_not_text {
        error = parse(words.iter().map(|word| shown(word).into()).collect()).err().unwrap_or(error);
    }
    let mut text = printable_lines(&error.render().to_string()).into_owned();
    if is_not_text {
        let not_text = words.iter().filter(|word| word.to_str().is_none()).map(shown);
        text += &format!("not UTF-8: {}\n", not_text.collect::<Vec<_>>().join(", "));
    }
    if matches!(error.kind(), ErrorKind::MissingRequiredArgument | ErrorKind::UnknownArgument) {
        text += &examples(words);
    }
    text
}

/// The first examples of the help of the command that is called, for who has not said enough.
fn examples(words: &[OsString]) -> String {
    const MOST: usize = 3;
    let name = words.get(1).and_then(|word| word.to_str()).unwrap_or_default();
    let all = Arguments::command();
    let help = all.find_subcommand(name).and_then(clap::Command::get_after_help);
    let help = help.map(ToString::to_string).unwrap_or_default();
    let begins = format!("  rasterproof {name} ");
    let lines: Vec<_> = help.lines().filter(|l| l.starts_with(&begins)).take(MOST).collect();
    if lines.is_empty() { String::new() } else { format!("For example:\n{}\n", lines.join("\n")) }
}

/// Runs a command line, the program's name first, and returns the exit status.
///
/// The words may be any that the system allows: a path need not be UTF-8.
pub fn run(words: impl IntoIterator<Item: Into<OsString>>, streams: &mut Streams<'_>) -> u8 {
    identity::forget_read_files();
    let words: Vec<OsString> = words.into_iter().map(Into::into).collect();
    let delivery = streams.delivery.clone();
    let Streams { progress, colour, columns, error_columns, .. } = *streams;
    let (arguments, typed) = match parse(words.clone()) {
        Ok(parsed) => parsed,
        Err(error) => {
            let is_error = error.use_stderr();
            let text = refusal(error, &words);
            // Help is laid out for the usual width.
            let columns = if columns < outlet::USUAL { columns } else { usize::MAX };
            let outlet = |stream, columns| {
                Outlet::new(stream, Escape::Words).noted(&delivery).folded(columns, None)
            };
            let (mut output, mut errors) =
                (outlet(streams.output, columns), outlet(streams.errors, error_columns));
            let stream = if is_error { &mut errors } else { &mut output };
            let _ = stream.write_all(text.as_bytes()).and_then(|()| stream.flush());
            report_loss(&output, &mut errors);
            let _ = errors.flush();
            return delivery.status(if is_error { exit::USAGE } else { exit::AGREES });
        }
    };
    quiet_engines();
    let command = arguments.command.unwrap_or(Command::Unnamed(arguments.verify));
    let for_machines = is_for_machines(&command, &words);
    let escape = match (for_machines, colour) {
        (true, _) => Escape::Json,
        (false, true) => Escape::WordsAndColours,
        (false, false) => Escape::Words,
    };
    let errors = Outlet::new(streams.errors, Escape::Words).noted(&delivery);
    let errors = &mut errors.folded(error_columns, Some(program()));
    if uses_pool(&command) {
        threads::prepare(errors);
    }
    let input = &mut *streams.input;
    let mut run = |output: &mut dyn Write, errors: &mut dyn Write, delivery: Delivery| {
        let streams = &mut Streams {
            input,
            output,
            errors,
            progress,
            colour,
            columns,
            error_columns,
            delivery,
        };
        let result = dispatch(&command, &typed, streams);
        result.and_then(|status| Ok(streams.output.flush().map(|()| status)?))
    };
    // A conversation ends where nobody listens any more.
    if matches!(command, Command::Engine { .. }) {
        let output = &mut Outlet::new(streams.output, escape);
        let is_end = |error: &io::Error| error.kind() == io::ErrorKind::BrokenPipe;
        return match run(output, errors, delivery) {
            Err(error) if error.downcast_ref().is_some_and(is_end) => exit::AGREES,
            result => status_of(result, errors),
        };
    }
    let columns = if for_machines { usize::MAX } else { columns };
    let output = Outlet::new(streams.output, escape).noted(&delivery).checked();
    let output = &mut output.folded(columns, Some(program()));
    let result = run(output, errors, delivery.clone());
    let status = status_of(result, errors);
    report_loss(output, errors);
    let _ = errors.flush();
    delivery.status(status)
}

/// Whether a command computes on several threads. Others leave what the system allows to the programs
/// that they start.
fn uses_pool(command: &Command) -> bool {
    use Command::{Course, Engine, Judge, List, Quiz};
    !matches!(command, Engine { .. } | Judge(_) | Course(_) | Quiz(_) | List { .. })
}

/// Whether programs read what a command prints, so that its lines are not broken.
fn is_for_machines(command: &Command, words: &[OsString]) -> bool {
    let ours = words.iter().map(|word| word.to_string_lossy()).take_while(|word| word != "--");
    { ours }.any(|word| word == "--json" || word.starts_with("--format"))
        || matches!(
            command,
            Command::Engine { .. }
                | Command::Exhaust(_)
                | Command::Merge(_)
                | Command::Digest(_)
                | Command::Fixtures(_)
        )
}

/// The exit status of what a command returned; a failure is printed.
fn status_of(result: Result<u8, InputError>, errors: &mut dyn Write) -> u8 {
    result.unwrap_or_else(|failure| {
        // A message may quote a file that somebody else wrote.
        let _ = writeln!(errors, "error: {}", printable_lines(&failure.to_string()));
        exit::USAGE
    })
}

/// Says why standard output did not take everything.
fn report_loss(output: &Outlet<'_>, errors: &mut dyn Write) {
    if let Some(error) = output.lost() {
        let remedy = if error.kind() == io::ErrorKind::StorageFull { "make room, or " } else { "" };
        let _ = writeln!(
            errors,
            "error: standard output cannot be written: {error}; {remedy}name another place"
        );
    }
}

fn dispatch(command: &Command, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    match command {
        Command::Unnamed(arguments) => verify::run(arguments, typed, streams),
        Command::Verify(arguments) => verify::run_command(arguments, typed, streams),
        Command::Inspect(arguments) => inspect::run(arguments, typed, streams),
        Command::Engine { name } => engine::run(name, streams),
        Command::Judge(arguments) => judge::run(arguments, typed, streams),
        Command::Course(arguments) => course::run(arguments, streams),
        Command::Specimens(arguments) => specimens::run(arguments, typed, streams),
        Command::Render(arguments) => render::run(arguments, typed, streams),
        Command::Plan(arguments) => plan::run(arguments, typed, streams),
        Command::Study(arguments) => study::run(arguments, typed, streams),
        Command::Mutants(arguments) => invariant::mutants(arguments, streams),
        Command::Tolerances(arguments) => tolerances::run(arguments, streams),
        Command::Exhaust(arguments) => exhaust::run(arguments, streams),
        Command::Merge(arguments) => exhaust::merge(arguments, streams),
        Command::Review(arguments) => review::run(arguments, streams),
        Command::Cost(arguments) => cost::run(arguments, typed, streams),
        Command::Digest(arguments) => digest::run(arguments, streams),
        Command::Fixtures(arguments) => fixtures::run(arguments, streams),
        Command::Playground(arguments) => {
            playground::run(("playground", &rasterproof_playground::PLAYGROUND), arguments, streams)
        }
        Command::YourGpu(arguments) => {
            playground::run(("your-gpu", &rasterproof_playground::YOUR_GPU), arguments, streams)
        }
        Command::Quiz(arguments) => quiz::run(arguments, streams),
        Command::List { facts: true, .. } => list_facts(streams),
        Command::List { mistakes: true, .. } => list_mistakes(streams),
        Command::List { .. } => list(streams),
    }
}

/// Keeps the panics of engines off the terminal: they are part of the verdict. Others still show.
pub fn quiet_engines() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        let hook = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if !rasterproof_verify::comparison::is_judging() {
                hook(info);
            }
        }));
    });
}

fn list(streams: &mut Streams<'_>) -> Status {
    let speaking = engines::speaking().map(|entry| (entry.name, entry.about));
    let families = cases::families().map(|f| (f.name, f.about));
    let off_grid = cases::unsnapped::FAMILIES.iter().map(|f| (f.name, f.about));
    let named =
        rasterproof_registry::named::named().into_iter().map(|case| (case.name, case.about));
    let faults = rasterproof_faults::planted::all();
    let scenes = scene::chapters::entries().map(|entry| (entry.name, entry.about));
    #[allow(unused_mut, reason = "with devices there are more")]
    let mut tables = vec![
        listed("Families (rasterproof --family NAME, rasterproof inspect NAME#NUMBER)", families),
        listed("Families off the grid, for the engines that do not snap", off_grid),
        listed("Named cases (rasterproof inspect NAME)", named),
        listed("Engines (rasterproof engine NAME)", speaking),
        listed("Planted faults (rasterproof --plant NAME; rasterproof mutants)", faults),
        listed("Invariants (rasterproof verify --invariant NAME, or all)", invariant::listed()),
        listed("Scenes (rasterproof render NAME)", scenes),
    ];
    #[cfg(feature = "vulkan")]
    tables.extend(vulkan::listed());
    page::print(Report { tables, ..Report::default() }, exit::AGREES, streams)
}

/// The facts of each kind of question, each with its classes.
fn list_facts(streams: &mut Streams<'_>) -> Status {
    let mut tables: Vec<Table> = facts::TOPICS.iter().map(facts_of).collect();
    tables.push(facts_of(&partition::design::TOPIC));
    page::print(Report { tables, ..Report::default() }, exit::AGREES, streams)
}

/// The mistakes in fills and in lines, each with its first parameter, and those of students.
fn list_mistakes(streams: &mut Streams<'_>) -> Status {
    let about = |m: Explanation| {
        let Explanation { name, does, repair, refuted, .. } = m;
        (name, format!("for example, it {does}. Repair: {repair}. Refuted by: {refuted}"))
    };
    let known = mistakes::table().into_iter().map(about);
    let students = misconceptions::all().map(|is| (is.name, is.says));
    let tables = vec![
        listed("Mistakes that the judge knows", known),
        listed("Mistakes that the course knows", students),
    ];
    page::print(Report { tables, ..Report::default() }, exit::AGREES, streams)
}

fn facts_of<Q, L>(topic: &facts::Topic<Q, L>) -> Table {
    let mut rows = Vec::new();
    for fact in topic.facts {
        rows.push(Row::of(&[&fact.name, &fact.classes().join(" · ")]));
    }
    let impossible = design::impossible(topic).len();
    let title = format!(
        "Facts of the family {}: {} classes, {impossible} pairs of which cannot occur",
        topic.name,
        topic.count()
    );
    Table::new(&title, "~fact 40 | ~classes 1", rows)
}

/// A list under a title, what an entry is about beside its name.
fn listed(title: &str, entries: impl Iterator<Item = (impl Display, impl Display)>) -> Table {
    let rows = entries.map(|(name, about)| Row::of(&[&name, &about]));
    Table::new(title, "~name 1 | ~about 1", rows.collect())
}

fn write_file(output: &Output, bytes: &[u8]) -> Result<(), InputError> {
    output::write(&output.path, bytes, output.over).map_err(usage)
}

/// A parser of whole numbers in a range.
fn whole<T: TryFrom<u64> + Clone + Send + Sync + 'static>(
    range: RangeInclusive<u64>,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static {
    move |text: &str| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        number.and_then(|number| T::try_from(number).ok()).ok_or_else(|| match *range.end() {
            u64::MAX => format!("expected a whole number from {}, for example 7", range.start()),
            most => format!("expected a whole number from {} to {most}", range.start()),
        })
    }
}

/// The numbers of cases: all but the largest, behind which a range could not end.
const NUMBERS: RangeInclusive<u64> = 0..=u64::MAX - 1;

fn seconds(text: &str) -> Result<Duration, String> {
    match text.parse::<f64>() {
        Ok(s) if s > 0.0 && s <= 1e6 => Ok(Duration::from_secs_f64(s)),
        _ => Err("expected a number of seconds above 0, at most 1e6".to_owned()),
    }
}

/// The nearest of some names as a question, where one is near, then a full stop.
fn did_you_mean(word: &str, names: impl Iterator<Item = &'static str>) -> String {
    let distance =
        |name: &str| strsim::levenshtein(&word.to_ascii_lowercase(), &name.to_ascii_lowercase());
    match names.map(|name| (distance(name), name)).min() {
        Some((steps, name)) if steps * 2 <= name.len().max(word.len()) => {
            format!("; did you mean '{name}'?")
        }
        _ => ".".to_owned(),
    }
}

/// Refuses a name that promises another format than the bytes have.
fn ends_in(path: &Path, wanted: &str, what: &str) -> Result<(), InputError> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(wanted)) {
        return Ok(());
    }
    let (path, format) = (printable_path(path), wanted.to_ascii_uppercase());
    Err(usage(format!("{path}: {what} is written as {format}: end its name with .{wanted}")))
}

/// Writes a picture and returns where, in words: a file that was asked for, or else one that costs a warning, and not the
/// verdict, where it cannot be written.
fn write_picture(
    asked: Option<&Output>,
    unasked: &Output,
    bytes: &[u8],
    streams: &mut Streams<'_>,
) -> Result<Option<String>, InputError> {
    let written = match asked {
        Some(output) => streams.save(output, bytes).then_some(output),
        None => match write_file(unasked, bytes) {
            Ok(()) => Some(unasked),
            Err(failure) => {
                writeln!(streams.errors, "warning: no picture: {failure}")?;
                None
            }
        },
    };
    Ok(written.map(|Output { path, .. }| format!("drawn in {}", printable_path(path))))
}

/// How this program was called, for commands that can be copied: through cargo where cargo started
/// it, else by the path that was typed, else by its name.
fn program() -> String {
    let word = std::env::args_os().next().unwrap_or_default().to_string_lossy().into_owned();
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
