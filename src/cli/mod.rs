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
use std::str::FromStr;
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

use rasterproof_registry::{engines, named};
use rasterproof_render::scene;
use rasterproof_report::html::Report;
use rasterproof_report::table::{Row, Table};
use rasterproof_teaching::course::misconceptions;
use rasterproof_verify::cases;
use rasterproof_verify::cases::facts::{self, design};
use rasterproof_verify::mistakes::{self, Explanation};
use rasterproof_verify::partition;

/// What the exit status of the program means.
pub mod exit {
    pub const AGREES: u8 = 0;
    /// Something is wrong with what was judged.
    pub const DISAGREES: u8 = 1;
    /// The command or its input cannot be used, or something could not be judged.
    pub const USAGE: u8 = 2;

    /// The status of a command that has judged.
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

/// An error of these words.
fn usage(message: impl ToString) -> InputError {
    message.to_string().into()
}

/// A parser that takes one of these words for the value beside it.
fn one_of<T: Clone + Send + Sync + 'static>(
    choices: impl IntoIterator<Item = (&'static str, T)>,
) -> impl TypedValueParser<Value = T> {
    one_of_explained(choices.into_iter().map(|(word, value)| (word, value, "")))
}

/// The same for words that the help explains, each by the text that is its third part.
fn one_of_explained<T: Clone + Send + Sync + 'static>(
    choices: impl IntoIterator<Item = (&'static str, T, &'static str)>,
) -> impl TypedValueParser<Value = T> {
    let mut words = Vec::new();
    let mut values = Vec::new();
    for (word, value, help) in choices {
        let possible = PossibleValue::new(word);
        words.push(if help.is_empty() { possible } else { possible.help(help) });
        values.push((word, value));
    }
    // The parser has refused all other words before a value is looked for.
    PossibleValuesParser::new(words).try_map(move |word| {
        let found = values.iter().find(|(choice, _)| **choice == word);
        found.map(|(_, value)| value.clone()).ok_or("no such word")
    })
}

/// Where a command reads and writes, and how it may write there. `main` connects it to the process, a test to buffers.
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
    let Some(rest) = word.strip_prefix('-') else { return false };
    rest.starts_with(|c: char| c.is_ascii_digit() || c == '.')
}

/// Whether a word is a coordinate such as -1.5,3, which is no option either.
fn is_coordinate(word: &str) -> bool {
    word.contains(',') && is_negative(word)
}

/// Whether a word is an option whose value may be the next word.
fn is_option_alone(word: &OsStr) -> bool {
    let text = word.to_str().unwrap_or_default();
    text.starts_with("--") && !text.contains('=')
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
        if ours && is_coordinate(text) {
            given.push(format!(" {text}").into());
            continue;
        }
        match given.last_mut() {
            Some(option) if ours && is_negative(text) && is_option_alone(option) => {
                option.push(format!("={text}"));
            }
            _ => given.push(word),
        }
    }
    // The command is kept for its list of options, from which the typed command is made.
    let mut command = Arguments::command();
    let matches = command.try_get_matches_from_mut(given)?;
    let arguments =
        Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut command))?;
    Ok((arguments, Typed::of(&command, &matches)))
}

/// What the parser says of words that it refuses, or that ask for help or the version. It repeats the words as they are, so
/// they are made printable before they are parsed.
fn refusal(mut error: clap::Error, words: &[OsString]) -> String {
    // The words as they can be shown, and those of them that the parser cannot quote.
    let (mut shown, mut not_text) = (Vec::new(), Vec::new());
    let mut has_hidden = false;
    for word in words {
        let text = word.to_string_lossy();
        has_hidden |= text.chars().any(is_hidden);
        if word.to_str().is_none() {
            not_text.push(printable(&text).into_owned());
        }
        shown.push(OsString::from(&*printable(&text)));
    }
    // Its message has no place for words that are not UTF-8, so they follow it.
    let is_not_text = error.kind() == ErrorKind::InvalidUtf8;
    if has_hidden && !is_not_text {
        error = parse(shown).err().unwrap_or(error);
    }
    let mut text = printable_lines(&error.render().to_string()).into_owned();
    if is_not_text {
        text += &format!("not UTF-8: {}\n", not_text.join(", "));
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
    let Some(command) = all.find_subcommand(name) else { return String::new() };
    let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
    // Its lines begin with a command; what the help says besides is left out.
    let begins = format!("  rasterproof {name} ");
    let lines: Vec<_> = help.lines().filter(|l| l.starts_with(&begins)).take(MOST).collect();
    if lines.is_empty() { String::new() } else { format!("For example:\n{}\n", lines.join("\n")) }
}

/// Runs a command line, the program's name first, and returns the exit status.
///
/// The words may be any that the system allows: a path need not be UTF-8.
pub fn run(words: impl IntoIterator<Item: Into<OsString>>, streams: &mut Streams<'_>) -> u8 {
    run_words(words.into_iter().map(Into::into).collect(), streams)
}

/// The same, compiled here once and not again for each caller's kind of words.
fn run_words(words: Vec<OsString>, streams: &mut Streams<'_>) -> u8 {
    // Files that an earlier command of this process read are no files of this one.
    identity::forget_read_files();
    let delivery = streams.delivery.clone();
    let (arguments, typed) = match parse(words.clone()) {
        Ok(parsed) => parsed,
        Err(error) => return answer_parser(error, &words, streams),
    };
    quiet_engines();
    let command = arguments.command.unwrap_or(Command::Unnamed(arguments.verify));
    // Both streams write what cannot hide anything; lines for machines are not broken.
    let for_machines = is_for_machines(&command, &words);
    let escape = match (for_machines, streams.colour) {
        (true, _) => Escape::Json,
        (false, true) => Escape::WordsAndColours,
        (false, false) => Escape::Words,
    };
    let errors = Outlet::new(streams.errors, Escape::Words).noted(&delivery);
    let mut errors = errors.folded(streams.error_columns, Some(program()));
    // A conversation ends where nobody listens any more. Every other command goes on, and its loss is noted.
    let is_conversation = matches!(command, Command::Engine { .. });
    let mut output = Outlet::new(streams.output, escape);
    if !is_conversation {
        let columns = if for_machines { usize::MAX } else { streams.columns };
        output = output.noted(&delivery).checked().folded(columns, Some(program()));
    }
    if uses_pool(&command) {
        threads::prepare(&mut errors);
    }
    let checked = &mut Streams {
        input: &mut *streams.input,
        output: &mut output,
        errors: &mut errors,
        delivery: delivery.clone(),
        progress: streams.progress,
        colour: streams.colour,
        columns: streams.columns,
        error_columns: streams.error_columns,
    };
    let mut result = dispatch(&command, &typed, checked);
    // Text that is still in a buffer is not delivered, which may fail, too.
    if result.is_ok() {
        result = checked.output.flush().map_err(InputError::from).and(result);
    }
    match result {
        Err(error) if is_conversation && is_broken_pipe(&error) => exit::AGREES,
        result if is_conversation => status_of(result, &mut errors),
        result => {
            let status = status_of(result, &mut errors);
            report_loss(&output, &mut errors);
            let _ = errors.flush();
            delivery.status(status)
        }
    }
}

/// Prints what the parser answers instead of arguments: what is wrong with them, or the help or the version that they ask for.
fn answer_parser(error: clap::Error, words: &[OsString], streams: &mut Streams<'_>) -> u8 {
    let is_error = error.use_stderr();
    let text = refusal(error, words);
    // Help is laid out for the usual width, so that it is broken on narrower terminals alone.
    let columns = if streams.columns < outlet::USUAL { streams.columns } else { usize::MAX };
    let output = Outlet::new(streams.output, Escape::Words).noted(&streams.delivery);
    let mut output = output.folded(columns, None);
    let errors = Outlet::new(streams.errors, Escape::Words).noted(&streams.delivery);
    let mut errors = errors.folded(streams.error_columns, None);
    let stream = if is_error { &mut errors } else { &mut output };
    let _ = stream.write_all(text.as_bytes()).and_then(|()| stream.flush());
    report_loss(&output, &mut errors);
    let _ = errors.flush();
    streams.delivery.status(if is_error { exit::USAGE } else { exit::AGREES })
}

/// Whether a command failed because nobody reads what it writes.
fn is_broken_pipe(error: &InputError) -> bool {
    let error: Option<&io::Error> = error.downcast_ref();
    error.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

/// Whether a command computes on several threads. Others leave what the system allows to the programs
/// that they start.
fn uses_pool(command: &Command) -> bool {
    use Command::{Course, Engine, Judge, List, Quiz};
    !matches!(command, Engine { .. } | Judge(_) | Course(_) | Quiz(_) | List { .. })
}

/// Whether programs read what a command prints, so that its lines are not broken.
fn is_for_machines(command: &Command, words: &[OsString]) -> bool {
    use Command::{Digest, Engine, Exhaust, Fixtures, Merge};
    // After -- come the words of somebody else.
    for word in words.iter().map(|word| word.to_string_lossy()).take_while(|word| word != "--") {
        if word == "--json" || word.starts_with("--format") {
            return true;
        }
    }
    // Commands that print what programs read, whatever their options say.
    matches!(command, Engine { .. } | Exhaust(_) | Merge(_) | Digest(_) | Fixtures(_))
}

/// The exit status of what a command returned; a failure is printed.
fn status_of(result: Result<u8, InputError>, errors: &mut dyn Write) -> u8 {
    match result {
        Ok(status) => status,
        Err(failure) => {
            // A message may quote a file that somebody else wrote.
            let _ = writeln!(errors, "error: {}", printable_lines(&failure.to_string()));
            exit::USAGE
        }
    }
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

/// Runs a command by the function of its file.
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

/// Everything that has a name, with what it is about.
fn list(streams: &mut Streams<'_>) -> Status {
    let speaking = engines::speaking().map(|entry| (entry.name, entry.about));
    let families = cases::families().map(|f| (f.name, f.about));
    let off_grid = cases::unsnapped::FAMILIES.iter().map(|f| (f.name, f.about));
    let named = named::named().into_iter().map(|case| (case.name, case.about));
    let faults = rasterproof_faults::planted::all();
    let scenes = scene::chapters::entries().map(|entry| (entry.name, entry.about));
    // Each title says in which command the names are words.
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
    let mut known = Vec::new();
    for Explanation { name, does, repair, refuted, .. } in mistakes::table() {
        let about = format!("for example, it {does}. Repair: {repair}. Refuted by: {refuted}");
        known.push((name, about));
    }
    let students = misconceptions::all().map(|is| (is.name, is.says));
    let tables = vec![
        listed("Mistakes that the judge knows", known.into_iter()),
        listed("Mistakes that the course knows", students),
    ];
    page::print(Report { tables, ..Report::default() }, exit::AGREES, streams)
}

/// The facts of one kind of question, and how many pairs of their classes its families have.
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
    let mut rows = Vec::new();
    for (name, about) in entries {
        rows.push(Row::of(&[&name, &about]));
    }
    Table::new(title, "~name 1 | ~about 1", rows)
}

/// Writes a file without which the command has no result.
fn write_file(output: &Output, bytes: &[u8]) -> Result<(), InputError> {
    output::write(&output.path, bytes, output.over).map_err(usage)
}

/// A parser of whole numbers in a range.
fn whole<T: TryFrom<u64> + Clone + Send + Sync + 'static>(
    range: RangeInclusive<u64>,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static {
    move |text: &str| {
        let number = whole_in(text, &range)?;
        T::try_from(number).map_err(|_| out_of_range(&range))
    }
}

/// A whole number in a range, compiled once for all types of numbers.
fn whole_in(text: &str, range: &RangeInclusive<u64>) -> Result<u64, String> {
    match text.parse() {
        Ok(number) if range.contains(&number) => Ok(number),
        _ => Err(out_of_range(range)),
    }
}

/// Which numbers are expected; a range without an end is shown by an example.
fn out_of_range(range: &RangeInclusive<u64>) -> String {
    match *range.end() {
        u64::MAX => format!("expected a whole number from {}, for example 7", range.start()),
        most => format!("expected a whole number from {} to {most}", range.start()),
    }
}

/// Two numbers with one of some signs between them; each may have blanks around it.
fn pair<A: FromStr, B: FromStr>(text: &str, signs: &[char]) -> Option<(A, B)> {
    let (first, second) = text.split_once(signs)?;
    Some((first.trim().parse().ok()?, second.trim().parse().ok()?))
}

/// The numbers of cases: all but the largest, behind which a range could not end.
const NUMBERS: RangeInclusive<u64> = 0..=u64::MAX - 1;

/// A time that a command may take.
fn seconds(text: &str) -> Result<Duration, String> {
    match text.parse::<f64>() {
        Ok(s) if s > 0.0 && s <= 1e6 => Ok(Duration::from_secs_f64(s)),
        _ => Err("expected a number of seconds above 0, at most 1e6".to_owned()),
    }
}

/// The nearest of some names as a question, where one is near, then a full stop.
fn did_you_mean(word: &str, names: &[&'static str]) -> String {
    let lower = word.to_ascii_lowercase();
    // Of several that are equally near, the first in the alphabet.
    let mut nearest = (usize::MAX, "");
    for name in names {
        let steps = strsim::levenshtein(&lower, &name.to_ascii_lowercase());
        nearest = nearest.min((steps, name));
    }
    // A name of which more than half would have to be changed is another word.
    let (steps, name) = nearest;
    if steps <= name.len().max(word.len()) / 2 {
        format!("; did you mean '{name}'?")
    } else {
        ".".to_owned()
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
    if let Some(output) = asked {
        let is_saved = streams.save(output, bytes);
        return Ok(is_saved.then(|| drawn_in(output)));
    }
    match write_file(unasked, bytes) {
        Ok(()) => Ok(Some(drawn_in(unasked))),
        Err(failure) => {
            writeln!(streams.errors, "warning: no picture: {failure}")?;
            Ok(None)
        }
    }
}

/// Where a picture is, in words.
fn drawn_in(output: &Output) -> String {
    format!("drawn in {}", printable_path(&output.path))
}

/// How this program was called, for commands that can be copied: through cargo where cargo started
/// it, else by the path that was typed, else by its name.
fn program() -> String {
    let word = std::env::args_os().next().unwrap_or_default().to_string_lossy().into_owned();
    let path = Path::new(&word);
    // Whoever has installed it types its name alone, and a script names it by its whole path.
    let is_within = path.is_relative() && path.components().count() > 1;
    // cargo calls it as target/PROFILE/rasterproof.
    let profile = path.parent().and_then(Path::file_name).and_then(OsStr::to_str);
    match profile.filter(|_| is_within) {
        None => "rasterproof".to_owned(),
        Some(_) if std::env::var_os("CARGO").is_none() => shell::quote(&word).into_owned(),
        Some("debug") => "cargo run --".to_owned(),
        Some("release") => "cargo run --release --".to_owned(),
        Some(profile) => format!("cargo run --profile {} --", shell::quote(profile)),
    }
}
