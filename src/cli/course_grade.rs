//! `rasterproof course --grade`: points by step, of one program or of a folder of submissions.

use std::ffi::{OsStr, OsString};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use rasterproof_host::limits;
use serde_json::{Value, json};

use super::progress::Progress as Shown;
use super::{Failure, Status, Streams, exit, usage};
use rasterproof_host::text::printable_path;
use rasterproof_judge::process::{Limits, Program};
use rasterproof_judge::process_group;
use rasterproof_judge::text::printable;
use rasterproof_report::json::pretty;
use rasterproof_teaching::course::examine::{self, Amount};
use rasterproof_teaching::course::progress::{self, Progress};
use rasterproof_teaching::course::sandbox::{self, Bounds};
use rasterproof_teaching::course::{self, STEPS, verdict};

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// For people.
    Text,
    /// Everything that was found.
    Json,
    /// Gradescope's results.json, of one program.
    Gradescope,
}

#[derive(clap::Args, Debug)]
pub struct GradeArguments {
    /// Grade every folder in this one
    #[arg(long, value_name = "DIR", conflicts_with = "command")]
    folder: Option<PathBuf>,
    /// What runs a submission, {} being its folder; without it, its course.toml says so
    #[arg(long, value_name = "WORDS", requires = "folder")]
    run: Option<String>,
    /// What to print
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Cases of each family
    #[arg(long, value_name = "N", default_value_t = 100,
        value_parser = clap::value_parser!(u64).range(1..=100_000))]
    cases: u64,
    /// Decides every case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::parse_number, allow_negative_numbers = true)]
    seed: u64,
    /// Seconds for a submission in all; what is not asked by then is not passed
    #[arg(long, value_name = "S", default_value_t = 120,
        value_parser = clap::value_parser!(u64).range(1..=100_000))]
    seconds: u64,
    /// Seconds for each answer
    #[arg(long, value_name = "S", default_value_t = 2,
        value_parser = clap::value_parser!(u64).range(1..=1000))]
    timeout: u64,
    /// MiB of addresses that a process may map; 0 sets no bound
    #[arg(long, value_name = "MIB", default_value_t = 2048,
        value_parser = clap::value_parser!(u64).range(0..=1 << 30))]
    memory: u64,
    #[command(flatten)]
    build: BuildLimits,
    /// The program and its arguments, last
    #[arg(
        trailing_var_arg = true,
        allow_hyphen_values = true,
        value_name = "CMD",
        required_unless_present = "folder"
    )]
    command: Vec<OsString>,
}

/// What a build may take; what it started is ended with it.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct BuildLimits {
    /// Seconds for a build
    #[arg(long, value_name = "S", default_value_t = limits::BUILD_SECONDS,
        value_parser = clap::value_parser!(u64).range(1..=100_000))]
    build_seconds: u64,
    /// MiB that a build may write to standard error
    #[arg(long, value_name = "MIB", default_value_t = limits::BUILD_OUTPUT_MIB,
        value_parser = clap::value_parser!(u64).range(1..=1 << 20))]
    build_output: u64,
}

impl BuildLimits {
    /// These limits, in bounds that have none other.
    pub fn bounds(self) -> Bounds {
        Bounds {
            build: Duration::from_secs(self.build_seconds),
            build_bytes: self.build_output << 20,
            ..Bounds::default()
        }
    }
}

struct Submission {
    name: String,
    folder: PathBuf,
    build: Vec<String>,
    run: Vec<OsString>,
}

struct Grade {
    name: String,
    /// For each step whether it is passed, and what came of it as text.
    steps: Vec<(bool, String)>,
    error: Option<String>,
    seconds: f64,
}

impl Grade {
    fn points(&self) -> usize {
        self.steps.iter().filter(|(passed, _)| *passed).count()
    }

    fn has_passed(&self, at: usize) -> bool {
        self.steps.get(at).is_some_and(|(passed, _)| *passed)
    }
}

pub fn run(arguments: &GradeArguments, streams: &mut Streams<'_>) -> Status {
    if arguments.folder.is_some() && arguments.format == Format::Gradescope {
        return Err(usage(
            "results.json is of one submission\n  name a program: course --grade --format gradescope CMD",
        ));
    }
    let submissions = match &arguments.folder {
        Some(folder) => submissions(folder, arguments.run.as_deref())?,
        None => {
            let (folder, run) = (PathBuf::from("."), arguments.command.clone());
            let words: Vec<_> = run.iter().map(|word| word.to_string_lossy()).collect();
            let name = printable(words.join(" ").as_bytes(), 200);
            vec![Ok(Submission { name, folder, build: Vec::new(), run })]
        }
    };
    process_group::end_all_on_ctrl_c();
    let mut grades = Vec::new();
    let shown = Shown::new(streams.progress, "submissions", Some(submissions.len() as u64));
    for submission in submissions {
        let grade = match submission {
            Ok(submission) => grade(&submission, arguments),
            Err((name, error)) => {
                Grade { name, steps: Vec::new(), error: Some(error), seconds: 0.0 }
            }
        };
        grades.push(grade);
        shown.done(1);
    }
    drop(shown);
    let text = match arguments.format {
        Format::Text => text(&grades, arguments.folder.is_some()),
        Format::Json => pretty(&everything(&grades, arguments)),
        Format::Gradescope => pretty(&gradescope(&grades[0])),
    };
    streams.output.write_all(text.as_bytes())?;
    if grades.iter().all(|grade| grade.error.is_some()) {
        return Ok(exit::USAGE);
    }
    let all = grades.iter().all(|grade| grade.points() == STEPS.len());
    Ok(if all { exit::AGREES } else { exit::DISAGREES })
}

type Found = Result<Submission, (String, String)>;

/// The folders of a folder, by name; each with its commands, or why it has none.
fn submissions(folder: &Path, template: Option<&str>) -> Result<Vec<Found>, Failure> {
    let shown = printable_path(folder);
    let failed = |e: std::io::Error| usage(format!("cannot read {shown}: {e}"));
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        // Regular files beside the folders are the teacher's: a list of names, an archive.
        if !path.is_file() {
            paths.push(path);
        }
    }
    paths.sort();
    if paths.is_empty() {
        return Err(usage(format!("{shown} holds no folder\n  expected one for each submission")));
    }
    let one = |path: PathBuf| {
        let name = path.file_name().unwrap_or_default();
        let name = printable(name.as_encoded_bytes(), 40);
        if !path.is_dir() {
            return Err((name, "it is no folder".to_owned()));
        }
        if let Some(template) = template {
            let word = |word: &str| {
                let parts: Vec<_> = word.split("{}").map(OsStr::new).collect();
                parts.join(path.as_os_str())
            };
            let run = template.split_whitespace().map(word).collect();
            return Ok(Submission { name, folder: PathBuf::from("."), build: Vec::new(), run });
        }
        match Progress::read(&path) {
            Ok(Some(Progress { build, run, .. })) => {
                let run = run.into_iter().map(OsString::from).collect();
                Ok(Submission { name, folder: path, build, run })
            }
            Ok(None) => Err((name, format!("it has no {}, and there is no --run", progress::FILE))),
            Err(error) => Err((name, error)),
        }
    };
    Ok(paths.into_iter().map(one).collect())
}

fn grade(submission: &Submission, arguments: &GradeArguments) -> Grade {
    let start = Instant::now();
    let seconds = Duration::from_secs(arguments.seconds);
    let bounds = arguments.build.bounds();
    let bounds = Bounds {
        memory_mib: Some(arguments.memory).filter(|mib| *mib > 0),
        processor_s: Some(arguments.seconds),
        build: bounds.build.min(seconds),
        ..bounds
    };
    let mut grade =
        Grade { name: submission.name.clone(), steps: Vec::new(), error: None, seconds: 0.0 };
    match started(submission, &bounds, arguments) {
        Err(error) => grade.error = Some(error),
        Ok(mut program) => {
            for step in STEPS.iter() {
                let amount = Amount {
                    cases: arguments.cases,
                    seed: arguments.seed,
                    end: start + seconds,
                    patience: Duration::from_secs(1).min(seconds / 24),
                };
                let outcome = examine::examine(&mut program, step, &amount);
                grade.steps.push((outcome.passes(), verdict::text(step, &outcome)));
            }
        }
    }
    // What it has left behind would take time from the next one.
    process_group::end_strays_of_ended_groups();
    grade.seconds = start.elapsed().as_secs_f64();
    grade
}

fn started(
    submission: &Submission,
    bounds: &Bounds,
    arguments: &GradeArguments,
) -> Result<Program, String> {
    let Submission { folder, build, run, .. } = submission;
    sandbox::build(folder, build, bounds)?;
    let limits = Limits {
        answer: Duration::from_secs(arguments.timeout),
        // An interpreter that starts slowly on a busy machine is no fault of the submission.
        start: Duration::from_secs(arguments.seconds.min(80)) / 4,
    };
    sandbox::start(folder, run, bounds, limits)
}

/// A table of submissions by steps; of one program also what came of each step.
fn text(grades: &[Grade], is_folder: bool) -> String {
    let mut out = String::new();
    if is_folder {
        let wide = grades.iter().map(|g| g.name.chars().count()).max().unwrap_or(0).clamp(10, 40);
        let numbers: String = (1..=STEPS.len()).map(|n| format!("{n:>4}")).collect();
        let _ = writeln!(out, "{:<wide$}{numbers}  points", "submission");
        for grade in grades {
            let marks: String = (0..STEPS.len())
                .map(|at| if grade.has_passed(at) { "   +" } else { "   -" })
                .collect();
            let _ = writeln!(out, "{:<wide$}{marks}  {:>6}", grade.name, grade.points());
        }
        let passed = |at| grades.iter().filter(|grade: &&Grade| grade.has_passed(at)).count();
        let counts: String = (0..STEPS.len()).map(|at| format!("{:>4}", passed(at))).collect();
        let _ = writeln!(out, "{:<wide$}{counts}", "passed by");
    }
    for grade in grades {
        if let Some(error) = &grade.error {
            let _ = writeln!(out, "{}: cannot be judged: {error}", grade.name);
        }
        for (_, text) in grade.steps.iter().filter(|_| !is_folder) {
            out += text;
        }
        if !is_folder {
            let _ = writeln!(out, "{} of {} points", grade.points(), STEPS.len());
        }
    }
    out
}

fn everything(grades: &[Grade], arguments: &GradeArguments) -> Value {
    let one = |grade: &Grade| {
        let steps = STEPS.iter().zip(&grade.steps).map(
            |(step, (passed, text))| json!({"step": step.name, "passed": passed, "output": text}),
        );
        json!({
            "name": grade.name, "points": grade.points(), "of": STEPS.len(), "error": grade.error,
            "seconds": grade.seconds, "steps": steps.collect::<Vec<_>>(),
        })
    };
    json!({
        "version": env!("CARGO_PKG_VERSION"), "seed": arguments.seed, "cases": arguments.cases,
        "submissions": grades.iter().map(one).collect::<Vec<_>>(),
    })
}

fn gradescope(grade: &Grade) -> Value {
    let tests = STEPS.iter().enumerate().map(|(at, step)| {
        let passed = grade.has_passed(at);
        let output = match (grade.steps.get(at), &grade.error) {
            (Some((_, text)), _) => text.clone(),
            (None, Some(error)) => error.clone(),
            (None, None) => String::new(),
        };
        json!({
            "name": step.title, "number": course::number(step).to_string(),
            "score": i32::from(passed), "max_score": 1,
            "status": if passed { "passed" } else { "failed" }, "output": output,
            "output_format": "text", "visibility": "visible",
        })
    });
    json!({
        "score": grade.points(), "visibility": "visible", "stdout_visibility": "visible",
        "execution_time": grade.seconds.ceil() as u64,
        "output": format!("{} of {} steps are passed", grade.points(), STEPS.len()),
        "tests": tests.collect::<Vec<_>>(),
    })
}
