//! `rasterproof course --grade`: points by step, of one program or of a folder of submissions.
//!
//! Each submission has a judge of its own, a process of this program, so that nothing it does to the judge
//! concerns the others.

use std::ffi::{OsStr, OsString};
use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::Command;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use rasterproof_host::limits;

use super::progress::Progress;
use super::{Status, Streams, exit, usage};
use rasterproof_judge::text::printable;
use rasterproof_program::{group, output};
use rasterproof_teaching::course::grade::{self, FoundSubmission, Grade, Submission, Terms};
use rasterproof_teaching::course::sandbox::Bounds;
use rasterproof_teaching::course::{self, STEPS};

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
    /// Cases of each family, and ten times as many of a design
    #[arg(long, value_name = "N", default_value_t = 100,
        value_parser = super::whole::<u64>(1..=100_000))]
    cases: u64,
    /// Decides every case
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = super::whole::<u64>(0..=u64::MAX), allow_negative_numbers = true)]
    seed: u64,
    /// Seconds for a submission in all; what is not asked by then is not passed
    #[arg(long, value_name = "S", default_value_t = 120,
        value_parser = super::whole::<u64>(1..=100_000))]
    seconds: u64,
    /// Seconds for each answer
    #[arg(long, value_name = "S", default_value_t = 2,
        value_parser = super::whole::<u64>(1..=1000))]
    timeout: u64,
    /// MiB of addresses that a process may map; 0 sets no bound
    #[arg(long, value_name = "MIB", default_value_t = 2048,
        value_parser = super::whole::<u64>(0..=1 << 30))]
    memory: u64,
    #[command(flatten)]
    build: BuildLimits,
    /// Be the judge of one submission: this folder, or with a dot the program
    #[arg(long, hide = true, value_name = "NAME")]
    row: Option<OsString>,
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
        value_parser = super::whole::<u64>(1..=100_000))]
    build_seconds: u64,
    /// MiB that a build may write to standard error
    #[arg(long, value_name = "MIB", default_value_t = limits::BUILD_OUTPUT_MIB,
        value_parser = super::whole::<u64>(1..=1 << 20))]
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

impl GradeArguments {
    /// What a submission is asked, and how much time and memory it may take.
    fn terms(&self) -> Terms {
        let memory_mib = Some(self.memory).filter(|mib| *mib > 0);
        let Self { cases, seed, seconds, .. } = *self;
        let bounds = Bounds { memory_mib, ..self.build.bounds() };
        Terms { cases, seed, seconds, answer: Duration::from_secs(self.timeout), bounds }
    }
}

/// Grades one program, or each submission of a folder, and prints the points as they come.
pub fn run(arguments: &GradeArguments, streams: &mut Streams<'_>) -> Status {
    if arguments.folder.is_some() && arguments.format == Format::Gradescope {
        return Err(usage(
            "results.json is of one submission\n  name a program: course --grade --format gradescope CMD",
        ));
    }
    let submissions = match &arguments.folder {
        Some(folder) => grade::submissions(folder, arguments.run.as_deref())?,
        None => {
            let run = arguments.command.clone();
            let words: Vec<_> = run.iter().map(|word| word.to_string_lossy()).collect();
            // A name decides where a row stands, so a program without a folder is called by its words.
            let name = printable(words.join(" ").as_bytes(), 200);
            vec![Ok(Submission::of_program(".".into(), name, run))]
        }
    };
    // The judge of one submission prints its grade and nothing else.
    if let Some(row) = &arguments.row {
        return judge_row(row, submissions, arguments, streams);
    }
    group::end_groups_on_ctrl_c();
    // The head of the table comes before the first judgement, which may take minutes.
    let is_table = arguments.format == Format::Text && arguments.folder.is_some();
    if is_table {
        streams.output.write_all(
            grade::row("submission", |at| course::number(&STEPS[at]), &"points").as_bytes(),
        )?;
    }
    let mut grades = Vec::new();
    let shown = Progress::new(streams.progress, "submissions", Some(submissions.len() as u64));
    for submission in submissions {
        let grade = match submission {
            Ok(submission) => graded_apart(&submission, arguments),
            Err((name, error)) => Grade::failed(name, error),
        };
        if is_table {
            // Rows that were judged stay, whatever happens to the rest.
            let mark = |at| if grade.has_passed(at) { "+" } else { "-" };
            let text = grade::row(&grade.name, mark, &grade.points);
            shown.without_bar(|| {
                streams.output.write_all(text.as_bytes())?;
                streams.output.flush()
            })?;
        }
        grades.push(grade);
        shown.done(1);
    }
    drop(shown);
    let &GradeArguments { seed, cases, .. } = arguments;
    let unjudged = grades.iter().all(|grade| grade.error.is_some());
    let all = grades.iter().all(|grade| grade.points == STEPS.len());
    let text = match arguments.format {
        Format::Text => grade::text(&grades, is_table),
        Format::Gradescope => grade::gradescope(&grades[0]),
        Format::Json => grade::json(grades, seed, cases),
    };
    streams.output.write_all(text.as_bytes())?;
    // Nobody was judged, everybody has all points, or somebody lacks some.
    Ok(match (unjudged, all) {
        (true, _) => exit::USAGE,
        (_, true) => exit::AGREES,
        (_, false) => exit::DISAGREES,
    })
}

/// Judges a submission in a process of its own. A program that signals its parent then loses its own row, and
/// those of others are judged all the same.
fn graded_apart(submission: &Submission, arguments: &GradeArguments) -> Grade {
    static STARTED: AtomicU64 = AtomicU64::new(0);
    let mark = format!("{}-{}", std::process::id(), STARTED.fetch_add(1, Ordering::Relaxed));
    let start = Instant::now();
    let found = apart(submission, arguments, &mark);
    if found.is_err() {
        // Where the judge was killed, its program lives on.
        group::end_marked(&format!("{MARK}={mark}"));
    }
    let seconds = start.elapsed().as_secs_f64();
    found.unwrap_or_else(|error| Grade { seconds, ..Grade::failed(submission.name.clone(), error) })
}

/// The variable by which the processes of a submission are found.
const MARK: &str = "RASTERPROOF_SUBMISSION";
/// Seconds that a judge may take longer than its submission.
const LONGER_S: u64 = 60;

/// Starts the judge of a submission with the same terms, waits for it, and reads its grade.
fn apart(submission: &Submission, arguments: &GradeArguments, mark: &str) -> Result<Grade, String> {
    let refused = |error: std::io::Error| {
        format!("its judge cannot be started: {error}\n  allow more processes (ulimit -u)")
    };
    // Its own limits end it before this one; only a judge that was stopped by its program is still there then.
    let end = Instant::now() + Duration::from_secs(arguments.seconds.saturating_add(LONGER_S));
    let mut command = Command::new(std::env::current_exe().map_err(refused)?);
    command.args(["course", "grade", "--format", "json"]).env(MARK, mark);
    for (option, number) in [
        ("--cases", arguments.cases),
        ("--seed", arguments.seed),
        ("--seconds", arguments.seconds),
        ("--timeout", arguments.timeout),
        ("--memory", arguments.memory),
        ("--build-seconds", arguments.build.build_seconds),
        ("--build-output", arguments.build.build_output),
    ] {
        command.arg(option).arg(number.to_string());
    }
    // A name may begin as an option does.
    let with = |option: &str, value: &OsStr| [OsStr::new(option), value].join(OsStr::new("="));
    command.arg(with("--row", &submission.id));
    if let Some(folder) = &arguments.folder {
        command.arg(with("--folder", folder.as_os_str()));
        command.args(arguments.run.iter().map(|run| with("--run", OsStr::new(run))));
    } else {
        command.arg("--").args(&arguments.command);
    }
    // The three ways in which a judge ends by itself; a signal is another one.
    let ends = [exit::AGREES, exit::DISAGREES, exit::USAGE];
    let text = output::of_judge(command, end, &ends).map_err(|error| match error.kind() {
        ErrorKind::TimedOut => "its judge does not end: does it stop its parent?".to_owned(),
        ErrorKind::Other => error.to_string(),
        _ => refused(error),
    })?;
    grade::read(&text)
        .map(|grade| Grade { name: submission.name.clone(), ..grade })
        .ok_or_else(|| "its judge says nothing".to_owned())
}

/// The judge of one submission: its grade as JSON, for the process that started it.
fn judge_row(
    row: &OsStr,
    submissions: Vec<FoundSubmission>,
    arguments: &GradeArguments,
    streams: &mut Streams<'_>,
) -> Status {
    group::end_all_on_ctrl_c();
    group::end_with_parent();
    let submission = submissions.into_iter().flatten().find(|one| one.id == row);
    let submission = submission.ok_or_else(|| usage("the submission is gone"))?;
    let grade = grade::grade(&submission, &arguments.terms());
    let agrees = grade.points == STEPS.len();
    let &GradeArguments { seed, cases, .. } = arguments;
    streams.output.write_all(grade::json(vec![grade], seed, cases).as_bytes())?;
    Ok(exit::of(agrees))
}
