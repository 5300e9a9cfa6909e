//! `rasterproof course`: twelve steps for a student, points for a teacher.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::course_grade::{self, BuildLimits, GradeArguments};
use super::progress::Progress as Shown;
use super::{Status, Streams, exit, usage, write_file};
use rasterproof_host::shell::quote;
use rasterproof_host::text::printable_path;

use crate::cli::starters::{self, Language};
use rasterproof_judge::process::Limits;
use rasterproof_judge::process_group;
use rasterproof_teaching::course::examine::{self, Amount};
use rasterproof_teaching::course::progress::{self, Progress};
use rasterproof_teaching::course::verdict::{self, indented};
use rasterproof_teaching::course::{self, STEPS, sandbox};

pub const HELP: &str = include_str!("help/course.txt").trim_ascii_end();

#[derive(clap::Args, Debug)]
pub struct CourseArguments {
    #[command(subcommand)]
    command: Option<CourseCommand>,
}

#[derive(clap::Subcommand, Debug)]
enum CourseCommand {
    /// Write a starter and the progress file; what exists is left alone
    Start {
        /// The language of the starter
        #[arg(long, value_enum, default_value_t = Language::Python)]
        language: Language,
        /// Where to; created where it is not there
        #[arg(value_name = "DIR", default_value = ".")]
        folder: PathBuf,
    },
    /// Judge a step, and note how it came out
    Check(CheckArguments),
    /// Points by step: of a program, or of a folder of submissions
    #[command(long_flag = "grade", after_help = course_grade::HELP)]
    Grade(Box<GradeArguments>),
}

#[derive(clap::Args, Debug)]
struct CheckArguments {
    /// The step, by name or number; the current one if none is named
    #[arg(value_name = "STEP")]
    step: Option<String>,
    /// Where course.toml is
    #[arg(long, value_name = "DIR", default_value = ".")]
    dir: PathBuf,
    /// Show one hint more
    #[arg(long)]
    hint: bool,
    /// Cases of each family
    #[arg(long, value_name = "N", default_value_t = 100,
        value_parser = clap::value_parser!(u64).range(1..=100_000))]
    cases: u64,
    /// Decides every case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::parse_number, allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    build: BuildLimits,
    /// The program and its arguments, after --; remembered in course.toml
    #[arg(last = true, value_name = "CMD")]
    command: Vec<String>,
}

pub fn run(arguments: &CourseArguments, streams: &mut Streams<'_>) -> Status {
    match &arguments.command {
        None => list(streams),
        Some(CourseCommand::Start { language, folder }) => start(*language, folder, streams),
        Some(CourseCommand::Check(check)) => run_check(check, streams),
        Some(CourseCommand::Grade(grade)) => course_grade::run(grade, streams),
    }
}

/// The steps; those passed are marked where there is a progress file.
fn list(streams: &mut Streams<'_>) -> Status {
    let progress = Progress::read(Path::new(".")).map_err(usage)?;
    let out = &mut *streams.output;
    for step in STEPS.iter() {
        let mark = match &progress {
            Some(progress) if progress.has_passed(step) => '+',
            Some(progress) if progress.current() == step => '>',
            _ => ' ',
        };
        let (number, name, title) = (course::number(step), &step.name, &step.title);
        writeln!(out, "{mark} {number:>2} {name:<14} {title} ({})", step.page)?;
        out.write_all(indented(&step.judged, 5).as_bytes())?;
        let mut families: Vec<_> =
            step.exercises.iter().flat_map(|e| &e.families).map(String::as_str).collect();
        families.sort_unstable();
        families.dedup();
        let families = format!("families: {}", families.join(", "));
        out.write_all(indented(&families, 5).as_bytes())?;
    }
    match progress {
        Some(_) => writeln!(out, "(+ passed, > current; next: rasterproof course check)")?,
        None => writeln!(out, "begin with: rasterproof course start --language python mine")?,
    }
    Ok(exit::AGREES)
}

fn start(language: Language, folder: &Path, streams: &mut Streams<'_>) -> Status {
    let (build, run) = starters::commands(language);
    let progress = Progress::new(build, run);
    let files = starters::files(language);
    let files = files.iter().map(|file| (file.name, file.text.clone()));
    for (name, text) in files.chain([(progress::FILE, progress.text())]) {
        let path = folder.join(name);
        if path.symlink_metadata().is_ok() {
            writeln!(streams.output, "kept:    {}", printable_path(&path))?;
        } else {
            write_file(&path, text.as_bytes())?;
            writeln!(streams.output, "written: {}", printable_path(&path))?;
        }
    }
    let step = &STEPS[0];
    writeln!(streams.output, "step 1, {}: {}", step.title, step.judged)?;
    let dir =
        if folder == Path::new(".") { String::new() } else { format!(" --dir {}", quote(folder)) };
    writeln!(streams.output, "write it, then: rasterproof course check{dir}")?;
    Ok(exit::AGREES)
}

fn run_check(arguments: &CheckArguments, streams: &mut Streams<'_>) -> Status {
    let found = Progress::read(&arguments.dir).map_err(usage)?;
    let mut progress = match (found, arguments.command.is_empty()) {
        (Some(found), _) => found,
        (None, false) => Progress::new(Vec::new(), Vec::new()),
        (None, true) => {
            let path = progress::path(&arguments.dir);
            return Err(usage(format!(
                "{} is not there\n  write one with: rasterproof course start {}\n  \
                 or name a program: rasterproof course check -- CMD",
                printable_path(&path),
                quote(&arguments.dir)
            )));
        }
    };
    if !arguments.command.is_empty() {
        progress.run.clone_from(&arguments.command);
        progress.build.clear();
    }
    let step = match &arguments.step {
        None => progress.current(),
        Some(word) => course::find(word).ok_or_else(|| {
            let names: Vec<_> = STEPS.iter().map(|step| &*step.name).collect();
            usage(format!("no step is called '{word}'; there are {}", names.join(", ")))
        })?,
    };
    process_group::end_all_on_ctrl_c();
    let limits = arguments.build.bounds();
    let shown = Shown::new(streams.progress, "steps", Some(1));
    sandbox::build(&arguments.dir, &progress.build, &limits).map_err(usage)?;
    let program = sandbox::start(&arguments.dir, &progress.run, &limits, Limits::default());
    let mut program = program.map_err(usage)?;
    let amount = Amount {
        cases: arguments.cases,
        seed: arguments.seed,
        end: Instant::now() + Duration::from_secs(60),
        patience: Duration::from_secs(3),
    };
    let outcome = examine::examine(&mut program, step, &amount);
    drop(shown);
    let before = progress.failures.min(3) * usize::from(progress.step == step.name);
    progress.note(step, outcome.passes());
    let text = verdict::text(step, &outcome);
    streams.output.write_all(text.as_bytes())?;
    streams.save(&progress::path(&arguments.dir), progress.text().as_bytes());
    if outcome.passes() {
        let next = match STEPS.iter().all(|step| progress.has_passed(step)) {
            true => "all twelve steps are passed; next: rasterproof judge -- CMD\n".to_owned(),
            false => {
                let next = progress.current();
                let (number, title) = (course::number(next), &next.title);
                format!("next: step {number}, {title} ({}): {}", next.page, next.judged)
            }
        };
        streams.output.write_all(indented(&next, 0).as_bytes())?;
        return Ok(exit::AGREES);
    }
    if let Some(last) = examine::complaint(&program) {
        writeln!(streams.output, "its standard error ends: {last}")?;
    }
    let hints = (before + 1 + usize::from(arguments.hint)).min(3);
    for (hint, number) in step.hints.iter().take(hints).zip(1..) {
        streams.output.write_all(indented(&format!("hint {number}: {hint}"), 0).as_bytes())?;
    }
    writeln!(streams.output, "page: {}", step.page)?;
    Ok(exit::DISAGREES)
}
