//! `rasterproof course`: eighteen steps for a student, points for a teacher.
//!
//! A student writes one program that speaks the line protocol. `start` writes a starter, `check` judges the current step and notes it
//! in a file, `show` draws what the program draws, and `grade` gives points for each step that is passed.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::course_grade::{self, BuildLimits, GradeArguments};
use super::page::{self, Place, Shown, print};
use super::progress::Progress as Bar;
use super::view::ViewArguments;
use super::{InputError, Status, Streams, exit, usage, write_file};
use rasterproof_host::output::{self, Output, Over};
use rasterproof_host::shell::{self, quote};
use rasterproof_host::text::printable_path;
use rasterproof_render::pipeline::target::{Antialias, check_size};
use rasterproof_render::scene::chapters;
use rasterproof_report::html::Report;
use rasterproof_report::picture;
use rasterproof_study::bounds::Purpose;

use crate::cli::starters::{self, Language};
use rasterproof_program::group;
use rasterproof_program::{Limits, Program};
use rasterproof_teaching::course::examine::{self, Amount};
use rasterproof_teaching::course::progress::{self, Progress};
use rasterproof_teaching::course::verdict;
use rasterproof_teaching::course::{self, STEPS, Step, sandbox, show};

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
        /// With every step solved, for teachers
        #[arg(long)]
        solution: bool,
        /// Where to; created where it is not there
        #[arg(value_name = "DIR", default_value = ".")]
        folder: PathBuf,
    },
    /// Judge a step, and note how it came out
    Check(CheckArguments),
    /// Draw what the program draws at a step, beside the right picture and the difference
    Show(Box<ShowArguments>),
    /// Points by step: of a program, or of a folder of submissions
    #[command(long_flag = "grade", after_help = super::help!("course_grade"))]
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
    /// Cases of each family, and ten times as many of a design
    #[arg(long, value_name = "N", default_value_t = 100,
        value_parser = super::whole::<u64>(1..=100_000))]
    cases: u64,
    /// Decides every case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    build: BuildLimits,
    /// The program and its arguments, after --; remembered in course.toml
    #[arg(last = true, value_name = "CMD")]
    command: Vec<String>,
}

#[derive(clap::Args, Debug)]
struct ShowArguments {
    /// A step by name or number, cube, or all; the current step if nothing is named
    #[arg(value_name = "STEP")]
    step: Option<String>,
    /// Where course.toml is
    #[arg(long, value_name = "DIR", default_value = ".")]
    dir: PathBuf,
    /// Draw this model instead, by the values of the program (steps 3 to 7)
    #[arg(long, value_name = "FILE", conflicts_with = "step")]
    model: Option<PathBuf>,
    /// Size of the cube's and the model's picture in pixels
    #[arg(long, value_name = "WxH", default_value = "320x240", value_parser = super::view::parse_size)]
    size: (u32, u32),
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    build: BuildLimits,
    /// The program and its arguments, after --; not remembered
    #[arg(last = true, value_name = "CMD")]
    command: Vec<String>,
}

/// Runs a subcommand; without one, shows the steps.
pub fn run(arguments: &CourseArguments, streams: &mut Streams<'_>) -> Status {
    match &arguments.command {
        None => list(streams),
        Some(CourseCommand::Start { language, solution, folder }) => {
            start(*language, *solution, folder, streams)
        }
        Some(CourseCommand::Check(check)) => run_check(check, streams),
        Some(CourseCommand::Show(show)) => run_show(show, streams),
        Some(CourseCommand::Grade(grade)) => course_grade::run(grade, streams),
    }
}

/// The steps, and where the student is, if this is the folder of one.
fn list(streams: &mut Streams<'_>) -> Status {
    let progress = Progress::read(Path::new("."))?;
    print(course::listed(progress.as_ref()), exit::AGREES, streams)
}

/// Writes the files of a student's folder, and says what to do next.
fn start(language: Language, solution: bool, folder: &Path, streams: &mut Streams<'_>) -> Status {
    let (build, run) = starters::commands(language);
    let progress = Progress::new(build, run);
    let files = starters::files(language, solution);
    let files = files.iter().map(|file| (file.name, file.text.clone()));
    let others = [("steps.md", starters::steps_page()), (progress::FILE, progress.text())];
    let mut notes = Vec::new();
    for (name, text) in files.chain(others) {
        let path = folder.join(name);
        // What exists may be somebody's work, and is left alone.
        let is_there = path.symlink_metadata().is_ok();
        if !is_there {
            write_file(&Output::typed(&path), text.as_bytes())?;
        }
        let what = if is_there { "kept" } else { "written" };
        notes.push(format!("{what}: {}", printable_path(&path)));
    }
    let step = &STEPS[0];
    let dir =
        if folder == Path::new(".") { String::new() } else { format!(" --dir {}", quote(folder)) };
    notes.push(format!("step 1, {}: {}", step.title, step.judged));
    notes.push("read steps.md, write the step in the starter, then have it judged by".to_owned());
    notes.push(format!("rasterproof course check{dir}"));
    print(Report { notes, ..Report::default() }, exit::AGREES, streams)
}

/// The progress of a folder, or that of the command that is named instead.
fn read_progress(dir: &Path, command: &[String], verb: &str) -> Result<Progress, InputError> {
    let mut progress = match (Progress::read(dir)?, command.is_empty()) {
        (Some(found), _) => found,
        (None, false) => Progress::new(Vec::new(), Vec::new()),
        (None, true) => {
            return Err(usage(format!(
                "{} is not there\n  write one with: rasterproof course start {}\n  \
                 or name a program: rasterproof course {verb} -- CMD",
                printable_path(&progress::path(dir)),
                quote(dir)
            )));
        }
    };
    // A command that is named counts for this time, with nothing to build.
    if !command.is_empty() {
        progress.run = command.to_vec();
        progress.build.clear();
    }
    Ok(progress)
}

/// The step of a word; `others` are further words that were possible.
fn find_step(word: &str, others: &str) -> Result<&'static Step, InputError> {
    course::find(word).ok_or_else(|| {
        usage(format!("no step is called '{word}'; there are {}{others}", course::known()))
    })
}

/// Builds the program, if anything does, and starts it within the bounds of a build.
fn built_and_started(
    dir: &Path,
    progress: &Progress,
    build: BuildLimits,
) -> Result<Program, InputError> {
    group::end_all_on_ctrl_c();
    let limits = build.bounds();
    sandbox::build(dir, &progress.build, &limits)?;
    sandbox::start(dir, &progress.run, &limits, Limits::default()).map_err(usage)
}

/// The name of the picture that follows the last step.
const CUBE: &str = "cube";

/// Draws some steps or a scene by the values of the program.
fn run_show(arguments: &ShowArguments, streams: &mut Streams<'_>) -> Status {
    let progress = read_progress(&arguments.dir, &arguments.command, "show")?;
    let size @ (width, height) = arguments.size;
    check_size(width, height, Antialias::None)?;
    let word = arguments.step.as_deref();
    let steps: Vec<&Step> = match (word, &arguments.model) {
        (Some(CUBE), _) | (None, Some(_)) => Vec::new(),
        (Some("all"), _) => STEPS.iter().collect(),
        (Some(word), _) => vec![find_step(word, ", cube and all")?],
        (None, None) => vec![progress.current()],
    };
    // A model is read before the program is built, since its name may be wrong.
    let model = match &arguments.model {
        Some(path) => Some(ViewArguments::of(size).maker(path, Purpose::Drawn, streams)?.scene),
        None => None,
    };
    let name = match (word, &model) {
        (_, Some(_)) => "model".to_owned(),
        (Some(word @ ("all" | CUBE)), _) => word.to_owned(),
        _ => steps[0].name.clone(),
    };
    let sheet = arguments.place.output(format!("course-{name}.png"));
    let page = arguments.place.output(format!("course-{name}.html"));
    output::check_all([sheet.named("the picture"), page.named("the page")])?;
    let bar = Bar::new(streams.progress, "pictures", Some(steps.len() as u64 + 1));
    let mut program = built_and_started(&arguments.dir, &progress, arguments.build)?;
    let mut pictures = Vec::new();
    for step in &steps {
        // A step may be drawn from several cases; all pictures of it have its label.
        let label = format!("step {}, {}", course::number(step), step.title);
        let drawn = show::step(&mut program, step);
        pictures.extend(drawn.into_iter().map(|picture| (label.clone(), picture)));
        bar.done(1);
    }
    let aspect = f64::from(width) / f64::from(height);
    // The cube and the model are drawn on the judge's side; the program gives the values of their pixels.
    let cube = chapters::scene(CUBE, aspect, 0.1).filter(|_| matches!(word, Some("all" | CUBE)));
    for (label, scene) in [("the cube", cube), ("the model", model)] {
        let Some(scene) = scene else { continue };
        let drawn = show::scene(&mut program, "drawn by your values", &scene, size)?;
        pictures.push((label.to_owned(), drawn));
    }
    drop(bar);
    let own = match &arguments.command[..] {
        [] => String::new(),
        words => format!(" -- {}", shell::line(words)),
    };
    let shown = match (&arguments.model, word) {
        (Some(path), _) => format!(" --model {}", quote(path)),
        (None, Some(word)) => format!(" {word}"),
        (None, None) => String::new(),
    };
    let mut report = show::report(format!("course show {name}"), &pictures);
    report.command = format!("rasterproof course show{shown}{own}");
    report.notes.extend(examine::complaint(&program));
    let sheets: Vec<_> = pictures.iter().map(|(_, picture)| picture.sheet()).collect();
    if streams.save(&sheet, &picture::png(&picture::stack(&sheets))) {
        report.notes.push(format!("drawn in {}", printable_path(&sheet.path)));
    }
    page::show(report, Shown::All, Some(page), exit::of(show::agree(&pictures)), streams)
}

/// Judges one step, notes how it came out, and gives a hint where it did not pass.
fn run_check(arguments: &CheckArguments, streams: &mut Streams<'_>) -> Status {
    let mut progress = read_progress(&arguments.dir, &arguments.command, "check")?;
    let step = match &arguments.step {
        None => progress.current(),
        Some(word) => find_step(word, "")?,
    };
    let shown = Bar::new(streams.progress, "steps", Some(1));
    let mut program = built_and_started(&arguments.dir, &progress, arguments.build)?;
    // A step is judged within a minute, so that a slow program gets an answer, too.
    let amount = Amount {
        cases: arguments.cases,
        seed: arguments.seed,
        end: Instant::now() + Duration::from_secs(60),
        patience: Duration::from_secs(3),
    };
    let outcome = examine::examine(&mut program, step, &amount);
    drop(shown);
    // What was passed is noted before anything is printed, since a reader may be gone.
    progress.note(step, outcome.passes());
    let mut report = verdict::report(step, &outcome, &shell::line(&progress.run));
    // It was read, and is written anew.
    let noted = Output { path: progress::path(&arguments.dir), over: Over::Updated };
    streams.save(&noted, progress.text().as_bytes());
    let passes = outcome.passes();
    report.notes.extend(match passes {
        true => vec![verdict::next(&progress)],
        false => {
            let complaint = examine::complaint(&program);
            // Each failure in a row shows one hint more.
            let hints = progress.failures + usize::from(arguments.hint);
            complaint.into_iter().chain(verdict::hints(step, hints)).collect()
        }
    });
    print(report, exit::of(passes), streams)
}
