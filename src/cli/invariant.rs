//! `rasterproof verify --invariant NAME` and `rasterproof mutants`.
//!
//! An invariant is a sentence that holds of every right implementation, such as that two triangles with a shared edge draw no pixel
//! twice. It is tried on generated inputs. An invariant that no planted fault breaks proves nothing, and a fault that breaks none is
//! not found; the matrix of `mutants` shows that there is neither.

use super::page::print;
use super::progress::Progress;
use super::{Status, Streams, exit, program};
use rasterproof_faults::planted::{self, Mutant};
use rasterproof_invariants::implementations::Implementations;
use rasterproof_invariants::matrix::{self, Matrix};
use rasterproof_invariants::{
    CATALOGUE, Failure, Invariant, MOST_LOOKED_THROUGH, Predicate, Ruling, Trial, drawn,
};
use rasterproof_report::html::{Excerpt, Outcome, Report};
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::thousands;
use rasterproof_verify::judge::caught;

/// Inputs of each invariant where the command line does not say.
const CASES: u64 = 2_000;
const ALL: &str = "all";

/// The names that --invariant takes.
pub fn names() -> Vec<&'static str> {
    CATALOGUE.iter().map(|i| i.name).chain([ALL]).collect()
}

/// Checks the invariants of these names; `plant` is the name of a mutant to ask instead.
pub fn run(
    names: &[String],
    plant: Option<&str>,
    seed: u64,
    cases: Option<u64>,
    streams: &mut Streams<'_>,
) -> Status {
    let cases = cases.unwrap_or(CASES);
    let subject = match plant.and_then(Mutant::find) {
        Some(mutant) => Implementations::with(mutant),
        None => Implementations::real(),
    };
    let wanted: Vec<&Invariant> = CATALOGUE
        .iter()
        .filter(|i| names.iter().any(|name| name == i.name || name == ALL))
        .collect();
    let mut outcomes = Outcomes::default();
    let progress = Progress::new(streams.progress, "invariants", Some(wanted.len() as u64));
    let (mut rows, mut excerpts) = (Vec::new(), Vec::new());
    let (program, planted) = (program(), plant.map(|name| format!(" --plant {name}")));
    let planted = planted.unwrap_or_default();
    for (done, invariant) in wanted.iter().enumerate() {
        progress.at(done as u64, invariant.name);
        let report = invariant.run(&subject, seed, cases);
        let command = format!("{program} verify --invariant {} --seed {seed}", invariant.name);
        let repeat = |cases: u64| format!("{command} --cases {cases}{planted}");
        rows.push(row(invariant, &subject, seed, &report, &repeat, &mut outcomes));
        // What is wrong in an engine is recognised where it is judged, not where invariants are.
        if let Some(failure) = &report.failure {
            let asks = format!("{program} verify{planted}");
            let places = [("repeat with", repeat(cases)), ("a cause is looked for by", asks)];
            excerpts.push(excerpt(&subject, failure, places));
        }
    }
    drop(progress);
    // Of one invariant the row itself is the answer.
    let columns = "invariant 28 | >cases 8 | >left out 8 since they do not fit it | >comparisons 8 | ~outcome 1 | \
                   what it says | :tolerance | what was found";
    let report = Report {
        about: format!("Invariants, seed {seed}"),
        tables: vec![Table::new("", columns, rows).judged()],
        excerpts,
        outcome: (wanted.len() > 1).then(|| outcomes.outcome()),
        ..Report::default()
    };
    print(report, outcomes.status(), streams)
}

/// How many invariants hold, and how many do not.
#[derive(Default)]
struct Outcomes {
    holding: usize,
    failing: usize,
    not_judged: usize,
    /// Cases with which all of those that were not judged compare something, where that is known.
    cases_needed: u64,
}

impl Outcomes {
    /// A failure is one whatever else was not judged; and what was not judged does not agree.
    fn status(&self) -> u8 {
        match (self.failing, self.not_judged) {
            (0, 0) => exit::AGREES,
            (0, _) => exit::USAGE,
            _ => exit::DISAGREES,
        }
    }

    /// The answer about all of them, with what would judge the rest.
    fn outcome(&self) -> Outcome {
        let Self { holding, failing, not_judged, cases_needed } = *self;
        let all = holding + failing + not_judged;
        let mut sentence = format!("{holding} of {all} invariants hold, {failing} do not");
        if not_judged > 0 {
            sentence += &format!(", {not_judged} not judged");
        }
        if cases_needed > 0 {
            sentence += &format!(" (--cases {cases_needed} judges them)");
        }
        match self.status() {
            exit::USAGE => Outcome::new(false, "NOT JUDGED", sentence),
            status => Outcome::of(status == exit::AGREES, sentence),
        }
    }
}

/// The smallest input, as it is drawn, and what repeats it.
fn excerpt(
    subject: &Implementations,
    Failure { family, index, what, case, .. }: &Failure,
    places: [(&'static str, String); 2],
) -> Excerpt {
    let picture = caught(|| drawn(subject, case)).ok().flatten();
    Excerpt {
        title: format!("{family}: {what} (from case {index}, shrunk)"),
        exchanges: vec![("input", case.to_string())],
        grid: picture.unwrap_or_default(),
        notes: vec!["no cause was recognised: an invariant compares and does not ask".to_owned()],
        places: places.into(),
    }
}

/// What came of an invariant, with what was found below it.
fn row(
    invariant: &Invariant,
    subject: &Implementations,
    seed: u64,
    report: &Trial,
    repeat: &dyn Fn(u64) -> String,
    outcomes: &mut Outcomes,
) -> Row {
    let ruling = report.ruling();
    let (word, found) = match (ruling, &report.failure) {
        (Ruling::Holds, _) => ("holds", String::new()),
        (Ruling::Fails, None) => ("", "FAILS".to_owned()),
        (_, Some(failure)) => ("", format!("FAILS in case {}", failure.index)),
        (Ruling::NotJudged, None) => {
            let needed = invariant.cases_needed(subject, seed);
            outcomes.cases_needed = outcomes.cases_needed.max(needed.unwrap_or(0));
            ("", format!("NOT JUDGED: {}", why_not_judged(invariant, needed.map(repeat))))
        }
    };
    match ruling {
        Ruling::Holds => outcomes.holding += 1,
        Ruling::Fails => outcomes.failing += 1,
        Ruling::NotJudged => outcomes.not_judged += 1,
    }
    let [cases, skipped, compared] = [report.cases, report.skipped, report.compared].map(thousands);
    let Invariant { number, name, statement, tolerance, .. } = invariant;
    let name = format!("{number} {name}");
    Row::of(&[&name, &cases, &skipped, &compared, &word, statement, tolerance, &found])
        .marked(ruling == Ruling::Holds)
}

/// Why an invariant compared nothing, and what to do about it; `repeat` is the command with enough cases, where that is known.
fn why_not_judged(invariant: &Invariant, repeat: Option<String>) -> String {
    match repeat {
        Some(repeat) => {
            format!("no case fits it; the first that fits needs more\njudge it with: {repeat}")
        }
        // Those that compare verdicts on several threads fit every case.
        None if matches!(invariant.check, Predicate::Run(..) | Predicate::Matrix) => {
            "the system refuses the threads whose verdicts it compares\nallow this user more \
             processes (ulimit -u)"
                .to_owned()
        }
        None => {
            format!("none of the first {MOST_LOOKED_THROUGH} cases fits it\ntry another --seed")
        }
    }
}

#[derive(clap::Args, Debug)]
pub struct MutantsArguments {
    /// The matrix, too: a row for each fault, a column for each invariant
    #[arg(long)]
    table: bool,
}

/// Prints whether each invariant kills a mutant and each mutant dies, then every mutant.
pub fn mutants(arguments: &MutantsArguments, streams: &mut Streams<'_>) -> Status {
    let rows = Mutant::all().len() as u64;
    let progress = Progress::new(streams.progress, "faults", Some(rows));
    let matrix = Matrix::compute(matrix::SEED, matrix::CASES, &|| progress.done(1));
    drop(progress);
    let problems = matrix.problems();
    let (rows, columns) = (matrix.rows.len(), matrix.columns.len());
    let answer = match problems.is_empty() {
        true => format!("each of {columns} invariants kills a fault, each of {rows} faults dies"),
        false => problems.join("; "),
    };
    let mut faults = Vec::new();
    for (name, marks) in &matrix.rows {
        let kills = marks.iter().filter(|&&mark| mark).count();
        let about = planted::about(name).unwrap_or("a check that cannot fail");
        faults.push(Row::of(&[name, &kills, &about]).marked(kills > 0));
    }
    let columns = "fault 30 | >broken 2 the invariants that it breaks | what it is 1";
    let mut report = Report {
        about: "planted faults, and the invariants that they break".to_owned(),
        outcome: Some(Outcome::of(problems.is_empty(), answer)),
        tables: vec![Table::new("", columns, faults).judged()],
        notes: vec![format!("see one judged: {} --plant NAME", program())],
        ..Report::default()
    };
    if !arguments.table {
        report.notes.push("which invariant kills which: add --table".to_owned());
    }
    // A problem is a row or a column without a mark, which the matrix shows.
    if arguments.table || !problems.is_empty() {
        report.excerpts.push(Excerpt { grid: matrix.text(), ..Excerpt::default() });
    }
    print(report, exit::of(problems.is_empty()), streams)
}

/// The invariants with what they say and their tolerances, by their numbers.
pub fn listed() -> impl Iterator<Item = (String, String)> {
    let about = |i: &Invariant| match i.tolerance {
        "0" => i.statement.to_owned(),
        tolerance => format!("{} Tolerance: {tolerance}.", i.statement),
    };
    CATALOGUE.iter().map(move |i| (format!("{} {}", i.number, i.name), about(i)))
}
