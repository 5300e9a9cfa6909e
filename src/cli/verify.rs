//! `rasterproof verify`: the differential table and the verdict.
//!
//! Every engine is judged on every family of cases that it draws. Where all agree, the answer is a sentence and what it rests on;
//! else the smallest case that shows the first fault follows, with the commands that repeat and explain it.

use std::path::PathBuf;
use std::time::Duration;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use image::RgbImage;

use super::page::{PageArguments, Shown, as_file, show};
use super::progress::Progress;
use super::typed::Typed;
use super::view::ViewArguments;
use super::{
    InputError, Status, Streams, exit, invariant, pair, program, study, usage, write_picture,
};
use rasterproof_host::output;
use rasterproof_registry::comparison::EnginesToJudge;
use rasterproof_registry::engines::{Engine, ExactEngine, LineEngine};
use rasterproof_report::html::{Excerpt, Outcome, Report};
use rasterproof_report::table::{Row, Table};
use rasterproof_report::{differential, json, page_cases, picture, summary};
use rasterproof_teaching::case_view;
use rasterproof_verify::cases::facts::asked::DesignShare;
use rasterproof_verify::cases::{self, Case, Family, Kind, Limits, Shape};
use rasterproof_verify::comparison::{
    self, Cause, FamilyReport, Options, PairReport, Shard, Verdict,
};
use rasterproof_verify::judge::ascii;

/// `verify` with its name, which can also judge the engines on a model.
#[derive(clap::Args, Debug)]
pub struct VerifyCommand {
    /// Judge the engines on the triangles of this model instead, and show its hard cases
    #[arg(value_name = "MODEL", conflicts_with_all = ["cases", "seconds", "family", "invariant", "seed", "shard", "case", "table", "report", "out", "force"])]
    model: Option<PathBuf>,
    #[command(flatten)]
    view: ViewArguments,
    #[command(flatten)]
    arguments: VerifyArguments,
}

/// Judges the engines on a model, or on generated cases.
pub fn run_command(command: &VerifyCommand, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    let Some(path) = &command.model else {
        study::refuse_view(typed)?;
        return run(&command.arguments, typed, streams);
    };
    let judged = command.arguments.judged();
    if judged.triangles.is_empty() && judged.unsnapped.is_empty() {
        return Err(usage("no rasterizer of triangles is chosen: name one, or leave out --engine"));
    }
    study::verify(path, (&command.view, &judged, command.arguments.json), typed, streams)
}

#[derive(clap::Args, Debug)]
pub struct VerifyArguments {
    /// Cases of each family [default: 20000]
    #[arg(long, value_name = "N", value_parser = super::whole::<u64>(1..=u64::MAX), allow_hyphen_values = true)]
    cases: Option<u64>,
    /// Stop after about this many seconds, however many cases that is
    #[arg(long, value_name = "S", value_parser = super::seconds, allow_negative_numbers = true)]
    seconds: Option<Duration>,
    /// Only this family; may be repeated
    #[arg(long, value_name = "NAME", value_parser = family_names())]
    family: Vec<String>,
    /// Only this engine against the oracle; may be repeated
    #[arg(long, value_name = "NAME", value_parser = EngineName)]
    engine: Vec<String>,
    /// Check this invariant instead, or all of them; may be repeated
    #[arg(long, value_name = "NAME", value_parser = invariant::names(), hide_possible_values = true,
        conflicts_with_all = ["family", "engine", "shard", "case", "json", "table", "seconds", "report"])]
    invariant: Vec<String>,
    /// Decides every generated case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    seed: u64,
    /// Only part I of N, I from 0: case number modulo N
    #[arg(long, value_name = "I/N", value_parser = parse_shard, default_value = "0/1")]
    shard: (u64, u64),
    /// Only the case of this number, to repeat a failure
    #[arg(long, value_name = "NUMBER", value_parser = super::whole::<u64>(super::NUMBERS), allow_negative_numbers = true)]
    case: Option<u64>,
    /// The table of all families, too; it is always there where something is wrong
    #[arg(long, conflicts_with = "json")]
    table: bool,
    /// The verdict as JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    page: PageArguments,
    /// Judge an engine with a planted fault instead, to see the harness fail; `list` names them
    #[arg(long, value_name = "FAULT", value_parser = rasterproof_faults::planted::names(), hide_possible_values = true,
        conflicts_with = "engine")]
    plant: Option<String>,
}

/// The families that --family takes.
fn family_names() -> Vec<&'static str> {
    cases::all_families().map(|family| family.name).collect()
}

/// The names that --engine takes, but for those of Vulkan devices.
fn judged_names() -> Vec<&'static str> {
    let lines = LineEngine::JUDGED.iter().map(LineEngine::name);
    let exact = ExactEngine::JUDGED.iter().map(ExactEngine::name);
    Engine::CHOICES.iter().map(Engine::name).chain(lines).chain(exact).collect()
}

/// The beginning of an engine's name that means a Vulkan device.
const VULKAN: &str = "vulkan:";

/// The parser of --engine. Which devices there are is seen when one is opened, so any name that means a device is taken.
#[derive(Clone)]
struct EngineName;

impl TypedValueParser for EngineName {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &std::ffi::OsStr,
    ) -> Result<String, clap::Error> {
        // The name of a device is a place in a list or a word, so it cannot be looked up before the driver is asked.
        if let Some(name) = value.to_str().filter(|name| name.starts_with(VULKAN)) {
            if cfg!(feature = "vulkan") {
                return Ok(name.to_owned());
            }
            let why = format!(
                "this program was built without Vulkan devices; build it with them:\n  \
                 cargo run --features vulkan -- verify --engine {name}\n"
            );
            let kind = clap::error::ErrorKind::InvalidValue;
            return Err(clap::Error::raw(kind, why).with_cmd(command));
        }
        PossibleValuesParser::new(judged_names()).parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(judged_names().into_iter().map(PossibleValue::new)))
    }
}

/// A part of the cases, and into how many parts they are divided.
pub(super) fn parse_shard(text: &str) -> Result<(u64, u64), String> {
    match pair(text, &['/']) {
        Some((part, parts)) if part < parts => Ok((part, parts)),
        _ => Err("expected I/N with I from 0 to N - 1, for example 0/4".to_owned()),
    }
}

impl VerifyArguments {
    /// Which cases are judged, and for how long.
    fn options(&self) -> Result<Options, InputError> {
        let mut options = Options::default().seed(self.seed);
        // With a time limit alone, the time decides.
        let default = if self.seconds.is_some() { u64::MAX / 4 } else { options.cases };
        options = options.cases(self.cases.unwrap_or(default));
        for name in &self.family {
            options = options.family(name.parse()?);
        }
        let (part, parts) = self.shard;
        options.shard = Shard::new(part, parts)?;
        options.time_limit = self.seconds;
        options.only = self.case;
        Ok(options)
    }

    /// Who is judged: everybody, a selection, or a planted fault alone.
    fn judged(&self) -> EnginesToJudge {
        let mut all = case_view::judged(self.plant.as_deref());
        if self.engine.is_empty() {
            return all;
        }
        // Some that are judged only when asked for.
        all.triangles = Engine::CHOICES.to_vec();
        all.triangles.retain(|engine| self.names(engine.name()));
        all.lines.retain(|engine| self.names(engine.name()));
        all.unsnapped.retain(|engine| self.names(engine.name()));
        all
    }

    /// Whether this engine was asked for by its name.
    fn names(&self, engine: &str) -> bool {
        self.engine.iter().any(|name| name == engine)
    }
}

/// Judges invariants, a device, or the engines on generated cases, whichever the options ask for.
pub fn run(arguments: &VerifyArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    // Invariants have inputs of their own, so no family, engine or time limit applies to them.
    if !arguments.invariant.is_empty() {
        let VerifyArguments { invariant: names, plant, seed, cases, .. } = arguments;
        return invariant::run(names, plant.as_deref(), *seed, *cases, streams);
    }
    let options = arguments.options()?;
    #[cfg(feature = "vulkan")]
    if arguments.engine.iter().any(|name| name.starts_with(VULKAN)) {
        return on_a_device(arguments, options, streams);
    }
    let page = arguments.page.page("verify.html");
    output::check_all(as_file(&page))?;
    let judged = arguments.judged();
    if judged.is_empty() {
        return Err(usage("this fault is in no engine and no line drawer: add --invariant NAME"));
    }
    let verdict = judge(&judged, &options, streams.progress);
    // A verdict about nothing would look like one that agrees.
    if verdict.families.iter().all(|family| family.cases == 0) {
        return Err(usage(
            "no case was judged: this engine does not draw what this family contains, or the shard is empty",
        ));
    }
    let run = Run { arguments, typed, judged, verdict };
    let mut report = run.report(page.is_some());
    // Whoever reads JSON did not ask for a picture.
    if !arguments.json {
        let place = run.write_sheet(streams)?;
        if let Some(last) = report.first_screen.last_mut() {
            last.notes.extend(place);
        }
    }
    let status = exit::of(run.verdict.agrees());
    show(report, Shown::Screen.or_json(arguments.json), page, status, streams)
}

/// Judges a Vulkan device, which draws triangles alone and is judged by commands of its own.
#[cfg(feature = "vulkan")]
fn on_a_device(arguments: &VerifyArguments, options: Options, streams: &mut Streams<'_>) -> Status {
    let [engine] = &arguments.engine[..] else {
        return Err(usage("a Vulkan device is judged alone: name one --engine"));
    };
    if arguments.shard != (0, 1) {
        return Err(usage("a Vulkan device is judged whole: leave out --shard"));
    }
    // It is judged by the judge of programs, which has options of its own.
    let mut asked = rasterproof_judge::Options::default().seed(options.seed);
    (asked.time_limit, asked.only) = (options.time_limit, options.only);
    asked.families.clone_from(&arguments.family);
    let shown = (Shown::Screen.or_json(arguments.json), arguments.page.page("vulkan.html"));
    super::vulkan::verify(engine, (asked, arguments.cases), shown, streams)
}

/// Judges the engines, with a bar that knows how many cases there are unless the time decides.
fn judge(judged: &EnginesToJudge, options: &Options, on_terminal: bool) -> Verdict {
    let engines = [judged.triangles.len(), judged.lines.len(), judged.unsnapped.len()];
    let mut count = 0_u64;
    for ((_, families), engines) in Kind::ALL.iter().zip(engines) {
        for family in families.iter().filter(|_| engines > 0) {
            let is_named = options.families.iter().any(|name| name.as_str() == family.name);
            count += u64::from(is_named || options.families.is_empty());
        }
    }
    let cases = count.saturating_mul(options.cases) / options.shard.parts();
    let total = options.time_limit.is_none().then_some(cases);
    let progress = Progress::new(on_terminal, "cases", total);
    judged.judge(options, &|cases| progress.done(cases))
}

/// A run that has come to its end.
struct Run<'a> {
    arguments: &'a VerifyArguments,
    typed: &'a Typed,
    judged: EnginesToJudge,
    verdict: Verdict,
}

/// Failures on the sheet of pictures.
const MOST_DRAWN: usize = 6;

impl Run<'_> {
    /// The command that judges one case again.
    fn repeat(&self, family: &str, index: u64) -> String {
        let one = self.typed.clone().without_output().without(&["cases", "seconds", "shard"]);
        one.set("seed", self.arguments.seed).first("case", index).first("family", family).line()
    }

    /// The command that repeats the run, with as many cases of each family as the time allowed.
    fn repeat_all(&self) -> Typed {
        // Whoever repeats a timed run needs the same cases on a machine that is faster or slower.
        let largest = self.verdict.families.iter().map(|f| f.cases).max().unwrap_or(0);
        let is_timed = self.arguments.seconds.is_some();
        let cases = if is_timed { largest } else { self.verdict.options.cases };
        let all = self.typed.clone().without(&["seconds"]).first("cases", cases);
        all.first("seed", self.arguments.seed)
    }

    /// The answer and what it rests on: where something is wrong, the smallest case that shows it, and the table of all
    /// families; on a page also the cases.
    fn report(&self, is_page: bool) -> Report {
        let Self { arguments, judged, verdict, .. } = self;
        let agrees = verdict.agrees();
        let (part, parts) = (verdict.options.shard.part(), verdict.options.shard.parts());
        let shard = if parts > 1 { format!(", shard {part}/{parts}") } else { String::new() };
        let (version, seed) = (env!("CARGO_PKG_VERSION"), arguments.seed);
        // The first screen has the tables of all families where one of them shows what is wrong.
        let mut tables = differential::tables(verdict);
        let mut first_screen = vec![summary::table(verdict)];
        if arguments.table || !agrees {
            first_screen.extend_from_slice(&tables);
            first_screen.extend(self.others());
        } else {
            let mut notes = self.closest();
            notes.push("every family as a table: add --table".to_owned());
            first_screen.push(Table::of_notes("", notes));
        }
        // A page has all of them, and what the designs asked as well.
        let asked = self.asked();
        first_screen.extend(summary::asked(&asked));
        tables.push(differential::refused());
        tables.extend(summary::asked(&asked));
        let repeat = |family: &str, index: u64| self.repeat(family, index);
        let mut report = Report {
            title: format!(
                "Verdict of rasterproof: {}",
                if agrees { "agrees" } else { "disagrees" }
            ),
            about: format!("rasterproof {version}, seed {seed}{shard}"),
            command: self.repeat_all().line(),
            repeat: self.repeat_all().without_output().line(),
            first_screen,
            tables,
            data: json::verdict(verdict, &asked, &repeat),
            ..Report::default()
        };
        // The cause is looked for in the engine that the first failure is of.
        let mut cause = None;
        if let Some(first) = verdict.failures.first() {
            cause = judged.cause(&first.evidence.pair[0]);
            report.excerpts.push(self.excerpt(first, cause.as_ref()));
        }
        report.outcome = Some(self.outcome(cause.as_ref()));
        if is_page {
            report.cases = page_cases::of_verdict(verdict, judged, repeat);
        }
        report
    }

    /// What the designs asked; nothing where some of their cases were not judged.
    fn asked(&self) -> Vec<DesignShare> {
        let options = &self.verdict.options;
        // A part of the cases was not designed to have every two facts together.
        if options.only.is_some() || options.shard.parts() > 1 || options.time_limit.is_some() {
            return Vec::new();
        }
        let is_judged = |family: &&Family| {
            self.verdict.families.iter().any(|of| of.family == family.name && of.cases > 0)
        };
        let families = cases::families().filter(is_judged);
        let limits = Limits::default();
        DesignShare::of_families(families, options.seed, |_| options.numbers(), &limits)
    }

    /// The verdict; where the cause is known, it says which engine is wrong and why.
    fn outcome(&self, cause: Option<&Cause>) -> Outcome {
        let mut outcome = differential::outcome(&self.verdict);
        if let (Some(first), Some(cause)) =
            (self.verdict.failures.first(), cause.filter(|cause| cause.is_known))
        {
            outcome.answer = format!("{} is not right. {}", first.evidence.pair[0], cause.sentence);
        }
        outcome
    }

    /// The smallest failure with its pixels, and that no cause was recognised, where that is so.
    fn excerpt(&self, failure: &comparison::Failure, cause: Option<&Cause>) -> Excerpt {
        // The smallest case of the first failure is the answer; one for each other family follows below.
        let shown = case_view::draw(&failure.case, &self.judged);
        let engine = &failure.evidence.pair[0];
        // The pixels of this engine beside those of the oracle, where it draws the case.
        let grid = shown.judged_blocks(engine).map_or(String::new(), |blocks| {
            format!("{}\n{}", ascii::side_by_side(&blocks, 60), ascii::LEGEND)
        });
        Excerpt {
            title: failure.to_string(),
            grid,
            notes: Vec::from_iter(cause.filter(|cause| !cause.is_known).map(Cause::headline)),
            places: vec![
                ("repeat with", self.repeat(failure.family, failure.index)),
                ("explain it", self.explain(failure)),
                ("read on in", summary::chapter(failure).to_owned()),
            ],
            ..Excerpt::default()
        }
    }

    /// A row for each failure but the first.
    fn others(&self) -> Option<Table> {
        let [_, others @ ..] = &self.verdict.failures[..] else { return None };
        let mut rows = Vec::new();
        for failure in others {
            let case = format!("{}#{}", failure.family, failure.index);
            let what = format!("{}: {} on", failure.evidence.pair[0], failure.what);
            rows.push(Row::of(&[&case, &what, &comparison::shrink::describe(&failure.case)]));
        }
        let caption = "The smallest case of each other family";
        let columns = "~case 23 | ~what is wrong 1 | corners";
        (!others.is_empty()).then(|| Table::new(caption, columns, rows))
    }

    /// The command that shows the shrunk case, or, where the command line cannot say it, the case that it is
    /// from.
    fn explain(&self, failure: &comparison::Failure) -> String {
        let (list, words) = match &failure.case.shape {
            Shape::Triangles { list, .. } => (list.len(), ""),
            Shape::Lines(list) => (list.len(), "--line "),
            Shape::Unsnapped { list, .. } => (list.len(), "--exact "),
            Shape::Numbers { .. } => (0, ""),
        };
        // Points that are typed are one shape with the values that such a shape always has.
        let points = comparison::shrink::describe(&failure.case);
        let comparison::Failure { family, index, seed, .. } = failure;
        let case = match list == 1 && comparison::shrink::has_plain_values(&failure.case) {
            true => format!("{words}{points}"),
            false => format!("{family}#{index} --seed {seed}"),
        };
        let mut command = format!("{} inspect {case}", program());
        if let Some(name) = &self.arguments.plant {
            command += &format!(" --plant {name}");
        }
        command
    }

    /// The cases whose values came closest to their bounds, each with its family and the engine.
    fn worst(&self) -> Vec<(&FamilyReport, &PairReport)> {
        let mut worst = Vec::new();
        for family in &self.verdict.families {
            for pair in &family.pairs {
                if pair.is_by_oracle() && pair.values > 0 && pair.worst() > 0.0 {
                    worst.push((family, pair));
                }
            }
        }
        worst.sort_by(|(_, a), (_, b)| b.worst().total_cmp(&a.worst()));
        // Two engines that are alike have the same worst case, which is drawn once.
        worst.dedup_by(|(a, one), (b, other)| {
            a.family == b.family && one.worst_case == other.worst_case
        });
        worst.truncate(3);
        worst
    }

    /// The command that shows the value closest to its bound, where values were compared.
    fn closest(&self) -> Vec<String> {
        let worst = self.worst();
        let [(family, pair), ..] = &worst[..] else { return Vec::new() };
        let (name, index, engine) = (&family.family, pair.worst_case, &pair.actual);
        let (program, seed) = (program(), self.arguments.seed);
        let said = format!("the value closest to its bound is of {engine}; see it with");
        vec![said, format!("{program} inspect {name}#{index} --seed {seed}")]
    }

    /// Draws the failures, or else the cases that came closest to a bound. Nobody asked for it: where that fails, the
    /// verdict stands.
    fn write_sheet(&self, streams: &mut Streams<'_>) -> Result<Option<String>, InputError> {
        let mut pictures = Vec::new();
        let agrees = self.verdict.agrees();
        if agrees {
            for (FamilyReport { family: name, .. }, pair) in self.worst() {
                // Families off the grid have no values.
                let Some(family) = cases::families().find(|family| family.name == name) else {
                    continue;
                };
                let (index, engine) = (pair.worst_case, &pair.actual);
                let title = format!("{name}#{index}: {engine} at {:.2} of a bound", pair.worst());
                pictures.push(self.picture(&title, &family.case(self.arguments.seed, index)));
            }
        } else {
            for failure in self.verdict.failures.iter().take(MOST_DRAWN) {
                let text = failure.to_string();
                pictures.push(self.picture(text.lines().next().unwrap_or_default(), &failure.case));
            }
        }
        if pictures.is_empty() {
            return Ok(None);
        }
        let name = if agrees { "worst.png" } else { "failures.png" };
        let png = picture::png(&picture::stack(&pictures));
        write_picture(None, &self.arguments.page.place.output(name), &png, streams)
    }

    /// What everybody draws of a case.
    fn picture(&self, title: &str, case: &Case) -> RgbImage {
        case_view::draw(case, &self.judged).picture(title, case)
    }
}
