//! Points by step for a submission: its program is built and started, and asked the cases of each step;
//! and the points of submissions as a table, as JSON, and for Gradescope.

use std::ffi::{OsStr, OsString};
use std::fmt::{Display, Write as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use rasterproof_host::text::printable_path;
use rasterproof_judge::text::printable;
use rasterproof_program::{Limits, Program, group};
use rasterproof_report::json::pretty;
use rasterproof_report::table::{Row, Table};
use rasterproof_report::{formats, text as terminal};
use serde::{Deserialize, Serialize};

use super::examine::{self, Amount};
use super::progress::{self, Progress};
use super::sandbox::{self, Bounds};
use super::{STEPS, verdict};

/// What is graded: a program, and the folder in which it is built and started.
pub struct Submission {
    /// The name of its folder; a dot where a program is named.
    pub id: OsString,
    pub name: String,
    folder: PathBuf,
    build: Vec<String>,
    run: Vec<OsString>,
}

impl Submission {
    /// A program that is started where this one was, without a build.
    #[must_use]
    pub fn of_program(id: OsString, name: String, run: Vec<OsString>) -> Self {
        Self { id, name, folder: PathBuf::from("."), build: Vec::new(), run }
    }
}

/// A submission, or its name and why it has no commands.
pub type FoundSubmission = Result<Submission, (String, String)>;

/// The folders of a folder, by name; each with its commands, or why it has none. A template has the words that run a submission,
/// `{}` being its folder.
///
/// # Errors
/// Where the folder cannot be read or holds no folder.
pub fn submissions(folder: &Path, template: Option<&str>) -> Result<Vec<FoundSubmission>, String> {
    let shown = printable_path(folder);
    let failed = |e: std::io::Error| format!("cannot read {shown}: {e}");
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        // Regular files beside the folders are the teacher's: a list of names, an archive.
        if !path.is_file() {
            paths.push(path);
        }
    }
    // The order of a folder is that of its file system, which differs between machines.
    paths.sort();
    if paths.is_empty() {
        return Err(format!("{shown} holds no folder\n  expected one for each submission"));
    }
    let one = |path: PathBuf| {
        // The name of the folder is shown, as far as it can be.
        let id = path.file_name().unwrap_or_default().to_owned();
        let name = printable(id.as_encoded_bytes(), 40);
        if !path.is_dir() {
            return Err((name, "it is no folder".to_owned()));
        }
        // The same words for everybody, with the folder of each in the place of `{}`.
        if let Some(template) = template {
            let word = |word: &str| {
                word.split("{}").map(OsStr::new).collect::<Vec<_>>().join(path.as_os_str())
            };
            let run = template.split_whitespace().map(word).collect();
            return Ok(Submission::of_program(id, name, run));
        }
        // Without a template each folder says in its progress file how it is built and run.
        match Progress::read(&path) {
            Ok(Some(Progress { build, run, .. })) => {
                let run = run.into_iter().map(OsString::from).collect();
                Ok(Submission { id, name, folder: path, build, run })
            }
            Ok(None) => Err((name, format!("it has no {}, and there is no --run", progress::FILE))),
            Err(error) => Err((name, error)),
        }
    };
    Ok(paths.into_iter().map(one).collect())
}

/// The points of a submission and how it came to them.
#[derive(Default, Serialize, Deserialize)]
pub struct Grade {
    pub name: String,
    pub points: usize,
    /// The number of steps, each of which gives a point.
    pub of: usize,
    pub error: Option<String>,
    pub seconds: f64,
    pub steps: Vec<StepResult>,
}

#[derive(Serialize, Deserialize)]
pub struct StepResult {
    pub step: String,
    pub passed: bool,
    /// The verdict on the step as a terminal shows it.
    pub output: String,
}

impl Grade {
    /// The grade of a submission that cannot be judged: no points, and why.
    #[must_use]
    pub fn failed(name: String, error: String) -> Self {
        Self { name, of: STEPS.len(), error: Some(error), ..Self::default() }
    }

    /// Whether the step at this place was passed.
    #[must_use]
    pub fn has_passed(&self, at: usize) -> bool {
        self.steps.get(at).is_some_and(|step| step.passed)
    }
}

/// The cases by which all submissions are judged, and the time and memory that each may take.
pub struct Terms {
    pub cases: u64,
    pub seed: u64,
    /// Seconds for a submission in all; a step that is not judged by then is not passed.
    pub seconds: u64,
    /// The longest time that the program may take for an answer.
    pub answer: Duration,
    /// Its time for a build is at most that of the submission.
    pub bounds: Bounds,
}

/// Builds and starts a program, and asks it all steps; it is started once, so that a slow start counts once.
#[must_use]
pub fn grade(submission: &Submission, terms: &Terms) -> Grade {
    let start = Instant::now();
    let name = submission.name.clone();
    let mut grade = Grade { name, of: STEPS.len(), ..Grade::default() };
    match started(submission, terms) {
        Err(error) => grade.error = Some(error),
        Ok(mut program) => {
            let (&Terms { cases, seed, .. }, seconds) = (terms, Duration::from_secs(terms.seconds));
            // A small part of the time for each step may go into a smaller failing case.
            let patience = Duration::from_secs(1).min(seconds / 24);
            let amount = Amount { cases, seed, end: start + seconds, patience };
            for step in STEPS.iter() {
                // Every step is judged, also after one that fails, since points are given for each.
                let outcome = examine::examine(&mut program, step, &amount);
                let report = verdict::report(step, &outcome, "the program");
                let output = terminal::text(&report, true, false, terminal::WIDTH);
                let (step, passed) = (step.name.clone(), outcome.passes());
                grade.points += usize::from(passed);
                grade.steps.push(StepResult { step, passed, output });
            }
        }
    }
    // What it has left behind would take time from the next one.
    group::end_strays_of_ended_groups();
    grade.seconds = start.elapsed().as_secs_f64();
    grade
}

/// A program that is built, and has said HELLO.
fn started(submission: &Submission, terms: &Terms) -> Result<Program, String> {
    let Submission { folder, build, run, .. } = submission;
    // Time that waits is bounded by `Terms::seconds` itself; this bounds what a process computes.
    let processor_s = Some(terms.seconds);
    // A build takes part of the time that the submission has in all.
    let longest = terms.bounds.build.min(Duration::from_secs(terms.seconds));
    let bounds = Bounds { processor_s, build: longest, ..terms.bounds };
    sandbox::build(folder, build, &bounds)?;
    // An interpreter that starts slowly on a busy machine is no fault of the submission.
    let start = Duration::from_secs(terms.seconds.min(80)) / 4;
    sandbox::start(folder, run, &bounds, Limits { answer: terms.answer, start })
}

/// The JSON file of a teacher: by which cases all were judged, and what became of each.
#[derive(Serialize, Deserialize)]
struct Grades {
    version: String,
    seed: u64,
    cases: u64,
    submissions: Vec<Grade>,
}

/// The grades as JSON, which [`read`] reads.
pub fn json(submissions: Vec<Grade>, seed: u64, cases: u64) -> String {
    let version = env!("CARGO_PKG_VERSION").to_owned();
    pretty(&Grades { version, seed, cases, submissions })
}

/// The last grade of the JSON that a judge has written.
pub fn read(json: &[u8]) -> Option<Grade> {
    let Grades { mut submissions, .. } = serde_json::from_slice(json).ok()?;
    submissions.pop()
}

/// A row of the table of submissions by steps, as it is printed when it is known.
pub fn row<T: Display>(name: &str, of_step: impl Fn(usize) -> T, points: &dyn Display) -> String {
    // A column is as wide as the number of its step, and holds two digits.
    // The heads of the columns are printed above all rows, so the widths are the same in each.
    let width = |step| super::number(step).len().max(2);
    let of_steps: String = STEPS.iter().map(|step| format!(" | >~step {}", width(step))).collect();
    let columns = format!("~name 26{of_steps} | >~points 6");
    let steps: Vec<_> = (0..STEPS.len()).map(of_step).collect();
    // A name, a mark for each step, and what they come to.
    let mut cells: Vec<&dyn Display> = vec![&name];
    cells.extend(steps.iter().map(|step| step as &dyn Display));
    cells.push(points);
    Table::new("", &columns, vec![Row::of(&cells)]).text([0, 0], false)
}

/// What follows the rows of a table, or what came of each step of one program.
pub fn text(grades: &[Grade], is_table: bool) -> String {
    let mut out = String::new();
    if is_table {
        let passed = |at| grades.iter().filter(|grade| grade.has_passed(at)).count();
        out += &row("passed by", passed, &"");
    }
    for grade in grades {
        if let Some(error) = &grade.error {
            let _ = writeln!(out, "{}: cannot be judged: {error}", grade.name);
        }
        if !is_table {
            out.extend(grade.steps.iter().map(|step| &*step.output));
            let _ = writeln!(out, "{} of {} points", grade.points, grade.of);
        }
    }
    out
}

/// One submission as Gradescope's results.json.
pub fn gradescope(grade: &Grade) -> String {
    // A submission that cannot be judged has the reason in the place of each verdict.
    let output = |at: usize| match (grade.steps.get(at), &grade.error) {
        (Some(step), _) => step.output.clone(),
        (None, error) => error.clone().unwrap_or_default(),
    };
    let tests = STEPS.iter().enumerate();
    let tests = tests.map(|(at, step)| (&*step.title, grade.has_passed(at), output(at)));
    pretty(&formats::gradescope(&tests.collect::<Vec<_>>(), "steps are passed", grade.seconds))
}
