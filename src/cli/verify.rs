//! `rasterproof verify`: the differential table and the verdict.

use std::path::Path;
use std::time::Duration;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use image::RgbImage;

use super::case_view::{self, Contestants};
use super::page::{PageArguments, write_page};
use super::progress::Progress;
use super::typed::Typed;
use super::{Failure, Status, Streams, exit, invariant, program, usage, write_unasked};
use rasterproof_registry::engines::{Engine, ExactEngine, LineEngine};
use rasterproof_report::html::Report;
use rasterproof_report::{ascii, counts, json, page_cases, picture, summary, table};
use rasterproof_verify::cases::{self, Shape};
use rasterproof_verify::comparison::tolerance::Tolerance;
use rasterproof_verify::comparison::unsnapped::{self, ExactVerdict};
use rasterproof_verify::comparison::{self, Options, Verdict};

#[derive(clap::Args, Debug)]
pub struct VerifyArguments {
    /// Cases of each family [default: 20000]
    #[arg(long, value_name = "N", value_parser = super::parse_count, allow_hyphen_values = true)]
    cases: Option<u64>,
    /// Stop after about this many seconds, however many cases that is
    #[arg(long, value_name = "S", value_parser = super::parse_seconds, allow_negative_numbers = true)]
    seconds: Option<f64>,
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
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::parse_number, allow_negative_numbers = true)]
    seed: u64,
    /// Only part I of N, I from 0: case number modulo N
    #[arg(long, value_name = "I/N", value_parser = parse_shard, default_value = "0/1")]
    shard: (u64, u64),
    /// Only the case of this number, to repeat a failure
    #[arg(long, value_name = "NUMBER", value_parser = super::parse_number, allow_negative_numbers = true)]
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
    #[arg(long, value_name = "FAULT", value_parser = rasterproof_faults::planted::about::names(), hide_possible_values = true,
        conflicts_with = "engine")]
    plant: Option<String>,
}

fn family_names() -> Vec<&'static str> {
    let off_grid = cases::unsnapped::FAMILIES.iter().map(|family| family.name);
    cases::families().map(|family| family.name).chain(off_grid).collect()
}

fn judged_names() -> Vec<&'static str> {
    let lines = LineEngine::JUDGED.iter().map(LineEngine::name);
    let exact = ExactEngine::JUDGED.iter().map(ExactEngine::name);
    Engine::CHOICES.iter().map(Engine::name).chain(lines).chain(exact).collect()
}

/// The beginning of an engine's name that means a Vulkan device.
const VULKAN: &str = "vulkan:";

/// The name of an engine, or of a Vulkan device.
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
        if let Some(name) = value.to_str().filter(|name| name.starts_with(VULKAN)) {
            return match cfg!(feature = "vulkan") {
                true => Ok(name.to_owned()),
                false => Err(clap::Error::raw(
                    clap::error::ErrorKind::InvalidValue,
                    format!(
                        "this program was built without Vulkan devices; build it with them:\n  \
                         cargo run --release --features vulkan -- verify --engine {name}\n"
                    ),
                )
                .with_cmd(command)),
            };
        }
        PossibleValuesParser::new(judged_names()).parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(judged_names().into_iter().map(PossibleValue::new)))
    }
}

pub(super) fn parse_shard(text: &str) -> Result<(u64, u64), String> {
    let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    match numbers {
        Some((part, parts)) if part < parts => Ok((part, parts)),
        _ => Err("expected I/N with I from 0 to N - 1, for example 0/4".to_owned()),
    }
}

impl VerifyArguments {
    fn options(&self) -> Result<Options, Failure> {
        let limit = match self.seconds {
            None => None,
            Some(s) if s > 0.0 && s <= 1e6 => Some(Duration::from_secs_f64(s)),
            Some(s) => {
                return Err(usage(format!(
                    "--seconds {s}: expected a number above 0, at most 1e6"
                )));
            }
        };
        let default = Options::default();
        Ok(Options {
            seed: self.seed,
            // With a time limit alone, the time decides.
            cases: self.cases.unwrap_or(if limit.is_some() { u64::MAX / 4 } else { default.cases }),
            time_limit: limit,
            families: self.family.clone(),
            shard: self.shard,
            only: self.case,
        })
    }

    /// Who is judged: everybody, a selection, or a planted fault alone.
    fn contestants(&self) -> Contestants {
        let mut all = Contestants::new(self.plant.as_deref());
        if self.engine.is_empty() {
            return all;
        }
        // Some that are judged only when asked for.
        all.engines = Engine::CHOICES.iter().map(|&e| (e, e.tolerance())).collect();
        let wanted = |name: &str| self.engine.iter().any(|n| n == name);
        all.engines.retain(|(engine, _)| wanted(engine.name()));
        all.lines.retain(|engine| wanted(engine.name()));
        all.exact.retain(|engine| wanted(engine.name()));
        all
    }
}

fn repeat(typed: &Typed, seed: u64, (family, index): (&str, u64)) -> String {
    let one = typed.clone().without_output().without(&["cases", "seconds", "shard"]);
    one.set("seed", seed).first("case", index).first("family", family).line()
}

fn repeat_all(typed: &Typed, seed: u64, cases: u64) -> Typed {
    typed.clone().without(&["seconds"]).first("cases", cases).first("seed", seed)
}

/// Judges, prints, and writes what was asked for.
pub fn run(arguments: &VerifyArguments, typed: &Typed, streams: &mut Streams<'_>) -> Status {
    if !arguments.invariant.is_empty() {
        let VerifyArguments { invariant: names, plant, seed, cases, .. } = arguments;
        return invariant::run(names, plant.as_deref(), *seed, *cases, streams);
    }
    let options = arguments.options()?;
    #[cfg(feature = "vulkan")]
    if arguments.engine.iter().any(|name| name.starts_with(VULKAN)) {
        return on_a_device(arguments, options, streams);
    }
    let Contestants { engines, lines, exact } = arguments.contestants();
    let exact_engines: Vec<_> = exact.into_iter().map(|engine| (engine.name(), engine)).collect();
    if engines.is_empty() && lines.is_empty() && exact_engines.is_empty() {
        return Err(usage("this fault is in no engine and no line drawer: add --invariant NAME"));
    }
    let (verdict, off_grid) = judge(&engines, &lines, &exact_engines, &options, streams.progress);
    if verdict.families.iter().all(|family| family.cases == 0)
        && off_grid.families.iter().all(|family| family.cases == 0)
    {
        return Err(usage(
            "no case was judged: this engine does not draw what this family contains, or the shard is empty",
        ));
    }
    if arguments.json {
        let text = json::verdict(&verdict, &off_grid, |family, index| {
            repeat(typed, arguments.seed, (family, index))
        });
        streams.output.write_all(text.as_bytes())?;
    } else {
        print(
            (arguments, typed),
            (&verdict, &engines, &lines),
            (&off_grid, &exact_engines),
            streams,
        )?;
    }
    // What was asked for may fail, but not before the verdict is said.
    streams.output.flush()?;
    if arguments.page.report {
        let page =
            report_page((arguments, typed), &verdict, &off_grid, &engines, &lines, &exact_engines);
        write_page(&arguments.page.place.out.join("verify.html"), page, streams);
    }
    Ok(if verdict.agrees() && off_grid.agrees() { exit::AGREES } else { exit::DISAGREES })
}

#[cfg(feature = "vulkan")]
fn on_a_device(arguments: &VerifyArguments, options: Options, streams: &mut Streams<'_>) -> Status {
    let [engine] = &arguments.engine[..] else {
        return Err(usage("a Vulkan device is judged alone: name one --engine"));
    };
    if arguments.shard != (0, 1) {
        return Err(usage("a Vulkan device is judged whole: leave out --shard"));
    }
    let job = super::vulkan::Job {
        engine,
        cases: arguments.cases,
        options: rasterproof_judge::Options {
            seed: options.seed,
            time_limit: options.time_limit,
            families: options.families,
            only: options.only,
            ..rasterproof_judge::Options::default()
        },
        json: arguments.json,
        page: &arguments.page,
    };
    super::vulkan::verify(&job, streams)
}

/// The run as a page: counts, failing cases, those closest to a bound, the named cases.
fn report_page(
    (arguments, typed): (&VerifyArguments, &Typed),
    verdict: &Verdict,
    off_grid: &ExactVerdict,
    engines: &[(Engine, Tolerance)],
    lines: &[LineEngine],
    exact_engines: &[(&str, ExactEngine)],
) -> Report {
    let engines: Vec<_> = engines.iter().map(|(engine, _)| *engine).collect();
    let exact: Vec<_> = exact_engines.iter().map(|(_, engine)| *engine).collect();
    let judged = page_cases::Judged { engines: &engines, lines, exact: &exact };
    let mut tables = counts::of_verdict(verdict, off_grid);
    tables.push(counts::refused());
    let quotas = table::quota_line(verdict).trim_end().to_owned();
    Report {
        title: "Verdict of rasterproof".to_owned(),
        outcome: Some(counts::outcome(verdict, off_grid)),
        command: repeat_all(typed, arguments.seed, judged_cases(arguments, verdict)).line(),
        seed: Some(arguments.seed),
        notes: Some(quotas).filter(|line| !line.is_empty()).into_iter().collect(),
        tables,
        cases: page_cases::of_verdict(verdict, off_grid, judged, |f, i| {
            repeat(typed, arguments.seed, (f, i))
        }),
        ..Report::default()
    }
}

/// Cases of each family: as asked, or as many as the time allowed.
fn judged_cases(arguments: &VerifyArguments, verdict: &Verdict) -> u64 {
    let largest = verdict.families.iter().map(|f| f.cases).max().unwrap_or(0);
    if arguments.seconds.is_some() { largest } else { verdict.options.cases }
}

fn judge(
    engines: &[(Engine, Tolerance)],
    lines: &[LineEngine],
    exact_engines: &[(&str, ExactEngine)],
    options: &Options,
    on_terminal: bool,
) -> (Verdict, ExactVerdict) {
    let triangles = cases::triangles::FAMILIES.iter().filter(|_| !engines.is_empty());
    let segments = cases::lines::FAMILIES.iter().filter(|_| !lines.is_empty());
    let families = triangles
        .chain(segments)
        .filter(|f| options.families.is_empty() || options.families.iter().any(|n| n == f.name));
    let off_grid_families =
        if exact_engines.is_empty() { 0 } else { unsnapped::exact_families(options).count() };
    let total = options.time_limit.is_none().then(|| {
        ((families.count() + off_grid_families) as u64).saturating_mul(options.cases)
            / options.shard.1
    });
    let progress = Progress::new(on_terminal, "cases", total);
    // Where both share a limited time, the families off the lattice get a fifth of it.
    let is_shared = off_grid_families > 0 && engines.len() + lines.len() > 0;
    let share = |fifths: u32| Options {
        time_limit: options.time_limit.map(|t| if is_shared { t * fifths / 5 } else { t }),
        ..options.clone()
    };
    let verdict = rasterproof_registry::comparison::judge(engines, lines, &share(4), &|cases| {
        progress.done(cases)
    });
    let off_grid =
        unsnapped::judge_exact_engines(exact_engines, &share(1), &|cases| progress.done(cases));
    drop(progress);
    (verdict, off_grid)
}

/// The answer and what it rests on. Where something is wrong, the smallest case that shows it comes
/// first; the last line is the verdict in a word.
fn print(
    (arguments, typed): (&VerifyArguments, &Typed),
    on_grid: (&Verdict, &[(Engine, Tolerance)], &[LineEngine]),
    off_grid: (&ExactVerdict, &[(&str, ExactEngine)]),
    streams: &mut Streams<'_>,
) -> Result<(), Failure> {
    let ((verdict, ..), (exact, _)) = (on_grid, off_grid);
    let agrees = verdict.agrees() && exact.agrees();
    let mut pictures = Vec::new();
    if !agrees {
        pictures = failures((arguments, typed), on_grid, off_grid, streams)?;
    }
    let (part, parts) = verdict.options.shard;
    let shard = if parts > 1 { format!(", shard {part}/{parts}") } else { String::new() };
    let out = &mut *streams.output;
    let answer = match agrees {
        true => "every engine is right",
        false => "not every engine is right",
    };
    writeln!(
        out,
        "{} rasterproof {}, seed {}{shard}: {answer}\n",
        summary::mark(agrees, streams.colour),
        env!("CARGO_PKG_VERSION"),
        arguments.seed
    )?;
    writeln!(out, "{}", summary::lines(verdict, exact, streams.colour))?;
    if arguments.table || !agrees {
        writeln!(out, "{}{}", table::table(verdict), table::quota_line(verdict))?;
        write!(
            out,
            "{}{}",
            table::disagreements(verdict),
            rasterproof_report::exact::table(exact)
        )?;
        write!(out, "{}", rasterproof_report::exact::disagreements(exact))?;
    }
    if verdict.agrees() {
        pictures.push(("worst.png", worst_cases(arguments, on_grid, out)?));
    }
    for (name, drawn) in pictures {
        write_sheet(&arguments.page.place.out.join(name), &drawn, streams)?;
    }
    let out = &mut *streams.output;
    if !arguments.table && agrees {
        writeln!(out, "every family as a table: add --table")?;
    }
    writeln!(
        out,
        "repeat with: {}",
        repeat_all(typed, arguments.seed, judged_cases(arguments, verdict)).without_output().line()
    )?;
    let (triangles, segments) = (verdict.sum(false, |f| f.shapes), verdict.sum(true, |f| f.shapes));
    let beside = match exact.triangles() {
        0 => String::new(),
        n => format!(", {n} triangles off the grid"),
    };
    let fragments = match verdict.comparisons().fragments.total() {
        0 => String::new(),
        n => format!("{n} pixels where fragments and coverage of one engine differ, "),
    };
    writeln!(
        out,
        "{}: {triangles} triangles and {segments} lines{beside}, {fragments}{} wrong pixels",
        summary::word(agrees),
        verdict.mismatches() + exact.mismatches()
    )?;
    Ok(())
}

type Sheet = (&'static str, Vec<RgbImage>);

/// The smallest failure with its pixels, then a line for each other family; all of them as pictures.
fn failures(
    (arguments, typed): (&VerifyArguments, &Typed),
    (verdict, engines, lines): (&Verdict, &[(Engine, Tolerance)], &[LineEngine]),
    (off_grid, exact_engines): (&ExactVerdict, &[(&str, ExactEngine)]),
    streams: &mut Streams<'_>,
) -> Result<Vec<Sheet>, Failure> {
    let out = &mut *streams.output;
    let mut drawn = Vec::new();
    for (rank, failure) in verdict.failures.iter().enumerate() {
        let shown = case_view::draw(&failure.case, engines, lines);
        if drawn.len() < MOST_DRAWN {
            drawn.push(shown.picture(&heading(failure), &failure.case));
        }
        if rank > 0 {
            continue;
        }
        writeln!(out, "{failure}")?;
        if let Some(blocks) = shown.judged_blocks(&failure.pair[0]) {
            writeln!(out, "\n{}", ascii::side_by_side(&blocks, 60))?;
            writeln!(out, "{}\n", ascii::LEGEND)?;
        }
        writeln!(
            out,
            "  repeat with: {}",
            repeat(typed, arguments.seed, (&failure.family, failure.index))
        )?;
        writeln!(out, "  explain it:  {}", explain(arguments, failure))?;
        writeln!(out, "  read on in:  {}\n", summary::chapter(failure))?;
    }
    let mut exact = Vec::new();
    for (rank, failure) in off_grid.failures.iter().enumerate() {
        let picture = case_view::picture_off_grid(&heading(failure), &failure.case, exact_engines);
        exact.extend(picture.filter(|_| rank < MOST_DRAWN));
        if rank == 0 {
            writeln!(out, "{failure}")?;
            writeln!(
                out,
                "  repeat with: {}",
                repeat(typed, arguments.seed, (&failure.family, failure.index))
            )?;
            writeln!(out, "  read on in:  docs/offgrid.md\n")?;
        }
    }
    others(verdict, off_grid, out)?;
    Ok(vec![("failures.png", drawn), ("failures-off-grid.png", exact)])
}

/// A line for each failure but the first on the lattice and the first off it.
fn others(
    verdict: &Verdict,
    off_grid: &ExactVerdict,
    out: &mut dyn std::io::Write,
) -> Result<(), Failure> {
    let on_grid =
        verdict.failures.iter().skip(1).map(|f| {
            (&f.family, f.index, &f.pair[0], &f.what, comparison::shrink::describe(&f.case))
        });
    let free =
        off_grid.failures.iter().skip(1).map(|f| {
            (&f.family, f.index, &f.engine, &f.what, unsnapped::describe(&f.case.triangles))
        });
    let others: Vec<_> = on_grid.chain(free).collect();
    if others.is_empty() {
        return Ok(());
    }
    writeln!(out, "the smallest case of each other family:")?;
    for (family, index, engine, what, points) in others {
        writeln!(out, "  {:<21} {engine}: {what} on\n      {points}", format!("{family}#{index}"))?;
    }
    writeln!(out)?;
    Ok(())
}

const MOST_DRAWN: usize = 6;

/// The command that shows the shrunk case, or, where the command line cannot say it, the case that it is
/// from.
fn explain(arguments: &VerifyArguments, failure: &comparison::Failure) -> String {
    let (list, words) = match &failure.case.shape {
        Shape::Triangles { list, .. } => (list.len(), String::new()),
        Shape::Lines(list) => (list.len(), "--line ".to_owned()),
    };
    let points = comparison::shrink::describe(&failure.case);
    let plant = arguments.plant.as_ref().map(|name| format!(" --plant {name}")).unwrap_or_default();
    let comparison::Failure { family, index, seed, .. } = failure;
    match list == 1 && comparison::shrink::has_plain_values(&failure.case) {
        true => format!("{} inspect {words}{points}{plant}", program()),
        false => format!("{} inspect {family}#{index} --seed {seed}{plant}", program()),
    }
}

/// Names and draws the cases whose values came closest to their bounds.
fn worst_cases(
    arguments: &VerifyArguments,
    (verdict, engines, lines): (&Verdict, &[(Engine, Tolerance)], &[LineEngine]),
    out: &mut dyn std::io::Write,
) -> Result<Vec<RgbImage>, Failure> {
    let mut worst: Vec<_> = verdict
        .families
        .iter()
        .flat_map(|f| f.pairs.iter().map(move |pair| (f, pair)))
        .filter(|(_, pair)| pair.target == "oracle" && pair.values > 0 && pair.worst() > 0.0)
        .collect();
    worst.sort_by(|(_, a), (_, b)| b.worst().total_cmp(&a.worst()));
    worst.dedup_by_key(|(f, pair)| (f.family.clone(), pair.worst_case));
    let mut pictures = Vec::new();
    for (rank, (family, pair)) in worst.into_iter().take(3).enumerate() {
        let name = &family.family;
        if rank == 0 {
            writeln!(
                out,
                "the value closest to its bound is of {}; see it with\n  {} inspect {name}#{} --seed {}",
                pair.actual,
                program(),
                pair.worst_case,
                arguments.seed
            )?;
        }
        let found = cases::families().find(|f| f.name == name);
        if let Some(case) = found.map(|f| f.case(arguments.seed, pair.worst_case)) {
            let title = format!(
                "{name}#{}: {} at {:.2} of a bound",
                pair.worst_case,
                pair.actual,
                pair.worst()
            );
            pictures.push(case_view::draw(&case, engines, lines).picture(&title, &case));
        }
    }
    Ok(pictures)
}

/// The first line of what is said of a failure.
fn heading(failure: &impl std::fmt::Display) -> String {
    failure.to_string().lines().next().unwrap_or_default().to_owned()
}

/// Draws what nobody asked for: where that fails, the verdict stands.
fn write_sheet(path: &Path, drawn: &[RgbImage], streams: &mut Streams<'_>) -> Result<(), Failure> {
    if drawn.is_empty() {
        return Ok(());
    }
    write_unasked(path, &picture::png(&picture::stack(drawn)), streams)
}
