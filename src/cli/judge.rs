//! `rasterproof judge -- CMD`: any program that speaks the line protocol, on the stand.
//!
//! What the program declares at the start decides what it is asked, and so which judge it gets: a tessellator is judged by its
//! polygons, a program beside another one by what both answer, any other by the oracle.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use rasterproof_host::output::{self, Output, Over, Use};
use rasterproof_host::text::{printable, printable_path};

use super::page::{PageArguments, Shown, as_file, show, write_page};
use super::progress::Progress;
use super::typed::Typed;
use super::watch::Files;
use super::{InputError, Status, Streams, exit, judge_checkpoint, league, usage, watch};
use rasterproof_judge::against;
use rasterproof_judge::ask::Subject;
use rasterproof_judge::baseline::Baseline;
use rasterproof_judge::changes::JudgementRecord;
use rasterproof_judge::declared::Declared;
use rasterproof_judge::recognise::{Scope, recognise};
use rasterproof_judge::run::cases_of;
use rasterproof_judge::verdict::{Scores as _, Verdict};
use rasterproof_judge::{Options, Step, family_names, polygons};
use rasterproof_program::{Limits, Program, group};
use rasterproof_report::formats::{self, Format};
use rasterproof_report::judge_text;
use rasterproof_report::words::noun;
use rasterproof_report::written_test::{self, Language};

#[derive(clap::Args, Debug)]
pub struct JudgeArguments {
    /// Cases of each family; of a design two or four times as many
    #[arg(long, visible_alias = "limit", value_name = "N", default_value_t = 500,
        value_parser = super::whole::<u64>(1..=u64::MAX), allow_negative_numbers = true)]
    cases: u64,
    /// Seconds for all that is asked after the start; a last answer is waited for one second more
    #[arg(long, value_name = "S", value_parser = super::seconds, allow_negative_numbers = true)]
    seconds: Option<Duration>,
    /// Only this family; may be repeated
    #[arg(long, value_name = "NAME", value_parser = family_names(), hide_possible_values = true)]
    family: Vec<String>,
    /// Decides every generated case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    seed: u64,
    /// Only the case of this number, to repeat a failure
    #[arg(long, value_name = "NUMBER", value_parser = super::whole::<u64>(super::NUMBERS), allow_negative_numbers = true)]
    case: Option<u64>,
    /// Seconds allowed for each answer
    #[arg(long, value_name = "S", default_value = "5", value_parser = super::seconds, allow_negative_numbers = true)]
    timeout: Duration,
    /// Seconds allowed from the start to the answer of HELLO
    #[arg(long, value_name = "S", default_value = "30", value_parser = super::seconds, allow_negative_numbers = true)]
    start_timeout: Duration,
    /// Copies of the program that are run at once
    #[arg(long, value_name = "N", default_value_t = 1,
        value_parser = super::whole::<u64>(1..=64))]
    jobs: u64,
    /// Words that the program does not say of itself, such as rule=strict; may be repeated
    #[arg(long, value_name = "WORDS")]
    declare: Vec<String>,
    /// What to print
    #[arg(long, value_parser = super::one_of_explained(Format::ALL), default_value = "text")]
    format: Format,
    /// The same as --format json
    #[arg(long, conflicts_with = "format")]
    json: bool,
    /// Write JUnit XML into this file, beside what is printed
    #[arg(long, value_name = "FILE", conflicts_with = "league")]
    junit: Option<PathBuf>,
    /// Write the smallest case of each fault as a test that needs nothing else: .py, .rs, .c, .js or .mjs
    #[arg(long, value_name = "FILE", conflicts_with_all = ["league", "against"])]
    write_test: Option<PathBuf>,
    /// Judge again when the program's file changes, or a file among its arguments, and say what got better and what worse
    #[arg(long, conflicts_with_all = ["league", "against", "baseline", "json", "format", "junit", "write_test", "table"])]
    watch: bool,
    /// The table of all families, too; it is always there where something is wrong
    #[arg(long)]
    table: bool,
    #[command(flatten)]
    page: PageArguments,
    /// Known failures: only what this file does not know counts
    #[arg(long, value_name = "FILE")]
    baseline: Option<PathBuf>,
    /// Write what fails now into the file of --baseline
    #[arg(long, requires = "baseline")]
    update_baseline: bool,
    /// Keep the answers in this file, and go on from there where an earlier judgement was broken off
    #[arg(long, value_name = "FILE", conflicts_with_all = ["league", "watch", "against", "seconds"])]
    checkpoint: Option<PathBuf>,
    /// Compare with another program, on all that both can answer: its command and arguments in one word
    #[arg(long, value_name = "CMD", value_parser = command_line, conflicts_with_all = ["league", "baseline"])]
    against: Option<CommandLine>,
    /// Judge libraries instead, by their installed adapters, all or these: target/rasterproof/league.json
    #[arg(long, value_name = "NAME", num_args = 0.., conflicts_with_all = ["command", "baseline"])]
    league: Option<Vec<String>>,
    /// The program and its arguments, after --
    #[arg(last = true, required_unless_present = "league", value_name = "CMD")]
    command: Vec<String>,
}

/// A program and its arguments, typed as one word.
#[derive(Clone, Debug)]
struct CommandLine(Vec<String>);

/// The words of a command line, divided as a shell divides them.
fn command_line(text: &str) -> Result<CommandLine, String> {
    match shlex::split(text) {
        Some(words) if !words.is_empty() => Ok(CommandLine(words)),
        Some(_) => Err("expected a program, and its arguments".to_owned()),
        None => Err("a quote is not closed".to_owned()),
    }
}

impl JudgeArguments {
    /// Which cases are judged, and which failures are known.
    fn options(&self, baseline: Option<&Baseline>) -> Options {
        let mut options = Options::default().seed(self.seed).cases(self.cases);
        (options.time_limit, options.only) = (self.seconds, self.case);
        options.families.clone_from(&self.family);
        options.terms.remember = self.baseline.is_some();
        options.terms.known = baseline.map(|known| known.known().clone()).unwrap_or_default();
        options
    }

    /// How long the program is waited for.
    fn limits(&self) -> Limits {
        Limits { answer: self.timeout, start: self.start_timeout }
    }

    /// The same, every case remembered.
    fn remembering(&self) -> Options {
        let mut options = self.options(None);
        options.terms.remember = true;
        options
    }

    /// The format that is asked for; --json is another word for one of them.
    fn format(&self) -> Format {
        if self.json { Format::Json } else { self.format }
    }

    /// The words of --declare, one by one.
    fn words(&self) -> Vec<String> {
        self.declare.iter().flat_map(|words| words.split_whitespace()).map(str::to_owned).collect()
    }
}

/// The commands that judge again.
struct Again {
    /// The command without what decides where results go.
    command: Typed,
    /// The one that judges everything.
    all: String,
}

impl Again {
    fn of(arguments: &JudgeArguments, typed: &Typed) -> Self {
        let command = typed.clone().without_output();
        let command = command.without(&["update-baseline", "checkpoint", "watch"]);
        let command = command.set("seed", arguments.seed);
        Self { all: command.clone().first("cases", arguments.cases).line(), command }
    }

    /// The one that judges a single case, also where a baseline knows that it fails.
    fn case(&self, family: &str, index: u64) -> String {
        let one = self.command.clone().without(&["cases", "seconds", "jobs", "baseline"]);
        one.first("case", index).first("family", family).line()
    }

    /// A verdict in a format that is no report.
    fn written(&self, verdict: &Verdict, format: Format) -> String {
        formats::write(verdict, format, &self.all, &|family, index| self.case(family, index))
    }
}

/// Writes the file of `--junit`, if there is one.
fn save_junit(
    arguments: &JudgeArguments,
    verdict: &Verdict,
    again: &Again,
    streams: &mut Streams<'_>,
) {
    if let Some(path) = &arguments.junit {
        let text = again.written(verdict, Format::Junit);
        streams.save(&Output::typed(path), text.as_bytes());
    }
}

/// Writes the file of `--write-test`, if there is one, and says what is in it.
fn save_test(
    path: &Path,
    verdict: &Verdict,
    repeat: &dyn Fn(&str, u64) -> String,
    streams: &mut Streams<'_>,
) -> Result<(), InputError> {
    let language = Language::of(path).map_err(usage)?;
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let written = written_test::write(verdict, language, &printable(&file), repeat);
    let shown = printable_path(path);
    // Whoever has such a file may have edited it.
    let output = Output { path: path.to_owned(), over: Over::None };
    match &written.text {
        Some(text) if streams.save(&output, text.as_bytes()) => {
            let (count, language) = (written.count, language.name());
            let tests = noun(count as u64, "test", "tests");
            writeln!(streams.errors, "{count} {tests} in {language}: {shown}")?;
        }
        Some(_) => return Ok(()),
        None if verdict.failures.is_empty() => {
            writeln!(streams.errors, "no test is written, since no case fails: {shown}")?;
            return Ok(());
        }
        None => streams
            .lose(&format!("{shown}: no test is written, since none can be made of these cases")),
    }
    // Of which cases there is no test.
    for why in &written.left_out {
        writeln!(streams.errors, "  no test of {why}")?;
    }
    Ok(())
}

/// Judges a program that declares `partition`: by its polygons alone.
fn tessellator(
    arguments: &JudgeArguments,
    program: &mut dyn Subject,
    options: &Options,
    typed: &Typed,
    streams: &mut Streams<'_>,
) -> Status {
    let declared = program.declared().clone();
    let name = &declared.name;
    // One that declares more would be judged by pixels, too, and its polygons would be lost among them.
    if declared.capabilities().len() > 1 {
        return Err(usage(format!(
            "{name} declares partition and more; a tessellator is a program of its own, with partition alone"
        )));
    }
    // Those options are about pixels, pairs or pages, which a judgement of polygons does not have.
    if let Some(option) =
        typed.given(&["baseline", "against", "checkpoint", "report", "write-test"])
    {
        return Err(usage(format!(
            "--{option} is not for tessellators, and {name} is one; leave it out"
        )));
    }
    let report = polygons::judge(program, options)?;
    let again = Again::of(arguments, typed);
    let (format, status) = (arguments.format(), exit::of(report.sum().wrong == 0));
    let verdict = polygons::verdict(&declared, options, &report);
    save_junit(arguments, &verdict, &again, streams);
    // For people there is a report of its own, about polygons.
    if format == Format::Text {
        let repeat_case = |family: &str, index| again.case(family, index);
        let said = judge_text::of_polygons(&declared, &report, &again.all, &repeat_case);
        return show(said, Shown::Screen, None, status, streams);
    }
    streams.output.write_all(again.written(&verdict, format).as_bytes())?;
    Ok(status)
}

/// The copies of the program that were started, those of the program of `--against`, and what both declare.
struct Begun {
    askers: Vec<Box<dyn Subject>>,
    others: Vec<Box<dyn Subject>>,
    declared: Declared,
}

/// Starts the programs of a command line.
fn begin(arguments: &JudgeArguments) -> Result<Begun, InputError> {
    let mut askers = Vec::new();
    let mut others = Vec::new();
    for _ in 0..arguments.jobs {
        askers.push(start("the program", &arguments.command, arguments)?);
        if let Some(CommandLine(command)) = &arguments.against {
            others.push(start("the program of --against", command, arguments)?);
        }
    }
    for asked in askers.first().into_iter().chain(others.first()) {
        let declared = asked.declared();
        if declared.capabilities().is_empty() {
            return Err(usage(format!(
                "{} names no capability after HELLO; expected coverage, line, attributes, \
                 samples4, depth, clip or partition",
                declared.name
            )));
        }
    }
    // Copies of one program declare the same. Two programs are asked what both can answer.
    let mut declared = askers[0].declared().clone();
    if let Some(other) = others.first() {
        let both = declared.clone().within(other.declared());
        if both.capabilities().is_empty() {
            let (one, other) = (&declared.name, &other.declared().name);
            return Err(usage(format!(
                "{one} and {other} have no capability in common, so there is nothing to compare"
            )));
        }
        declared = both;
    }
    Ok(Begun { askers, others, declared })
}

/// Starts a program; `who` is what an error calls it.
fn start(
    who: &str,
    command: &[String],
    arguments: &JudgeArguments,
) -> Result<Box<dyn Subject>, InputError> {
    match Program::start(command, &arguments.words(), arguments.limits()) {
        Ok(program) => Ok(Box::new(program)),
        Err(why) => Err(usage(format!("{who} {why}\n  {}", why.remedy()))),
    }
}

/// A bar for all the cases of these options that the program can answer.
fn progress_of(options: &Options, declared: &Declared, streams: &Streams<'_>) -> Progress {
    Progress::new(streams.progress, "cases judged", Some(cases_of(options, declared)))
}

/// Judges a program by its copies.
fn judge_one(
    askers: &mut [Box<dyn Subject>],
    options: &Options,
    step: &(dyn Fn(Step) + Sync),
) -> Verdict {
    let scope = Scope::of(options);
    let recognise = |program: &mut dyn Subject| recognise(program, scope);
    rasterproof_judge::judge(askers, options, &recognise, step)
}

/// Judges the program as it is now, first by the cases that failed before, and shows what has changed. Nothing comes of it where a file
/// changes meanwhile.
fn watched(
    arguments: &JudgeArguments,
    typed: &Typed,
    before: Option<&JudgementRecord>,
    files: &Arc<Files>,
    streams: &mut Streams<'_>,
) -> Result<Option<JudgementRecord>, InputError> {
    let Begun { askers, declared, .. } = begin(arguments)?;
    if declared.partition {
        return Err(usage("--watch is not for tessellators; leave it out"));
    }
    let mut askers: Vec<_> =
        askers.into_iter().map(|asked| watch::until_changed(asked, files)).collect();
    let options = arguments.remembering();
    // First what failed before, since that is what was changed; then all cases, since a change may break others.
    if let Some(before) = before {
        let [asked, right] = before.ask_again(&mut *askers[0], options.seed);
        if asked > 0 {
            writeln!(
                streams.output,
                "of {asked} cases that failed, {right} are right now; all cases follow"
            )?;
            streams.output.flush()?;
        }
    }
    let progress = progress_of(&options, &declared, streams);
    let verdict = judge_one(&mut askers, &options, &|step| progress.step(step));
    drop(progress);
    let record = JudgementRecord::of(&mut *askers[0], &verdict);
    askers[0].finish();
    // A program that was built again meanwhile would be judged half as the old one, half as the new one.
    if files.have_changed() {
        return Ok(None);
    }
    if let Some(why) = verdict.judged_nothing() {
        return Err(usage(why));
    }
    let changes = before.map(|before| record.since(before));
    let again = Again::of(arguments, typed);
    let repeat_case = |family: &str, index| again.case(family, index);
    let (faults, changes) = (&record.faults, changes.as_ref());
    let report = judge_text::watched(&verdict, faults, changes, &again.all, &repeat_case);
    show(report, Shown::Screen, None, exit::AGREES, streams)?;
    Ok(Some(record))
}

/// Refuses words and files of the command line before any program is started.
fn check(arguments: &JudgeArguments, page: &Option<Output>) -> Result<(), InputError> {
    for words in &arguments.declare {
        let understood = Declared::default().declare(words);
        understood.map_err(|why| usage(format!("--declare: {why}")))?;
    }
    if let Some(path) = &arguments.write_test {
        Language::of(path)
            .map_err(|why| usage(format!("--write-test: {}: {why}", printable_path(path))))?;
    }
    let known = arguments.baseline.as_deref().map(|path| ("--baseline", path, Use::Reads));
    let mut files: Vec<_> = known.into_iter().chain(as_file(page)).collect();
    for (option, path, of) in [
        ("--junit", &arguments.junit, Use::Writes(Over::Any)),
        ("--write-test", &arguments.write_test, Use::Writes(Over::None)),
        ("--checkpoint", &arguments.checkpoint, Use::Writes(Over::Updated)),
    ] {
        files.extend(path.as_deref().map(|path| (option, path, of)));
    }
    output::check_all(files)?;
    if arguments.checkpoint.is_some() && arguments.jobs > 1 {
        return Err(usage("--checkpoint keeps the answers of one copy; leave --jobs out"));
    }
    Ok(())
}

/// Judges a program, two programs, or libraries, whichever the options ask for.
pub fn run(arguments: &JudgeArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    if let Some(names) = &arguments.league {
        let options = arguments.options(None);
        let limits = arguments.limits();
        return league::run(names, &options, limits, &arguments.page.place, streams);
    }
    arguments.page.refuse_idle_folder(typed)?;
    let page = arguments.page.page("judge.html");
    check(arguments, &page)?;
    let baseline = match &arguments.baseline {
        Some(path) => Some(Baseline::read(path, arguments.seed)?),
        None => None,
    };
    // From here on programs run, which must not outlive this one.
    group::end_all_on_ctrl_c();
    if arguments.watch {
        let mut round =
            |before: Option<&JudgementRecord>, files: &Arc<Files>, streams: &mut Streams<'_>| {
                watched(arguments, typed, before, files, streams)
            };
        return watch::run(&arguments.command, &mut round, streams);
    }
    let Begun { mut askers, others, declared } = begin(arguments)?;
    let options = arguments.options(baseline.as_ref());
    if declared.partition {
        return tessellator(arguments, &mut *askers[0], &options, typed, streams);
    }
    if let Some(path) = &arguments.checkpoint {
        let program = askers.remove(0);
        askers.push(judge_checkpoint::resume(program, path, &arguments.command, &options)?);
    }
    let progress = progress_of(&options, &declared, streams);
    let step = |step| progress.step(step);
    // Copies of a program share the cases; of a pair each program is asked all of its cases.
    let mut verdict = if others.is_empty() {
        judge_one(&mut askers, &options, &step)
    } else {
        let mut pairs: Vec<_> = askers.into_iter().zip(others).map(<[_; 2]>::from).collect();
        against::compare(&mut pairs, &options, &step)
    };
    drop(progress);
    if let Some(why) = verdict.judged_nothing() {
        return Err(usage(why));
    }
    // What the baseline knows counts no more.
    if let Some(baseline) = &baseline {
        baseline.apply(&mut verdict);
    }
    let again = Again::of(arguments, typed);
    let repeat_case = |family: &str, index| again.case(family, index);
    // What JSON and a page have besides is made for them alone.
    let is_whole = page.is_some() || arguments.format() == Format::Json;
    let make = if is_whole { judge_text::whole } else { judge_text::report };
    let mut report = make(&verdict, &again.all, &repeat_case, arguments.table);
    report.command = typed.clone().set("seed", arguments.seed).line();
    let mut agrees = verdict.agrees();
    save_junit(arguments, &verdict, &again, streams);
    // Reports have a page; all other formats are written as they are, and the page beside them.
    match arguments.format() {
        format @ (Format::Text | Format::Json) => {
            let shown = Shown::Screen.or_json(format == Format::Json);
            show(report, shown, page, exit::of(agrees), streams)?;
        }
        other => {
            streams.output.write_all(again.written(&verdict, other).as_bytes())?;
            streams.output.flush()?;
            if let Some(page) = page {
                write_page(&page, report, streams);
            }
        }
    }
    if let Some(path) = &arguments.write_test {
        save_test(path, &verdict, &repeat_case, streams)?;
    }
    if let (Some(baseline), Some(path), true) =
        (&baseline, &arguments.baseline, arguments.update_baseline)
    {
        // A baseline that was just written knows everything.
        agrees |= update_baseline(baseline, &verdict, path, streams)?;
    }
    // What was judged to its end is not gone on with.
    if let Some(Err(error)) = arguments.checkpoint.as_deref().map(output::remove) {
        writeln!(streams.errors, "warning: {error}")?;
    }
    Ok(exit::of(agrees))
}

/// Writes what fails now into the baseline; whether it was written.
fn update_baseline(
    baseline: &Baseline,
    verdict: &Verdict,
    path: &Path,
    streams: &mut Streams<'_>,
) -> Result<bool, InputError> {
    let shown = printable_path(path);
    let text = match baseline.updated(verdict) {
        Ok(text) => text,
        Err(why) => {
            streams.lose(&format!("{shown}: not written: {why}"));
            return Ok(false);
        }
    };
    // It was read, and is written anew.
    let output = Output { path: path.to_owned(), over: Over::Updated };
    let is_saved = streams.save(&output, text.as_bytes());
    if is_saved {
        writeln!(streams.errors, "baseline: {shown}")?;
    }
    Ok(is_saved)
}
