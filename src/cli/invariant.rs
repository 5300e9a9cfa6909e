//! `rasterproof verify --invariant NAME` and `rasterproof mutants`.

use std::io::Write;

use super::progress::Progress;
use super::{Failure, Status, Streams, exit, program, write_entry};
use rasterproof_faults::planted::{self, Mutant};
use rasterproof_invariants::matrix::{self, Matrix};
use rasterproof_invariants::subject::Subject;
use rasterproof_invariants::{CATALOGUE, Check, Invariant, MOST_LOOKED_THROUGH, Ruling};
use rasterproof_report::summary;

/// Inputs of each invariant where the command line does not say.
const CASES: u64 = 2_000;
const ALL: &str = "all";

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
        Some(mutant) => Subject::with(mutant),
        None => Subject::real(),
    };
    let all = names.iter().any(|name| name == ALL);
    let wanted: Vec<&Invariant> =
        CATALOGUE.iter().filter(|i| all || names.iter().any(|name| name == i.name)).collect();
    let mut outcomes = Outcomes::default();
    let progress = Progress::new(streams.progress, "invariants", Some(wanted.len() as u64));
    // Standard output may be the terminal of the bar: what is said comes after it.
    let mut text = Vec::new();
    for (done, invariant) in wanted.iter().enumerate() {
        progress.at(done as u64, invariant.name);
        let planted = plant.map(|name| format!(" --plant {name}")).unwrap_or_default();
        let repeat = |cases: u64| {
            let (program, name) = (program(), invariant.name);
            format!("{program} verify --invariant {name} --seed {seed} --cases {cases}{planted}")
        };
        judge(invariant, &subject, (seed, cases), &repeat, (&mut outcomes, &mut text))?;
    }
    drop(progress);
    streams.output.write_all(&text)?;
    if wanted.len() > 1 {
        writeln!(streams.output, "{}", outcomes.summary())?;
    }
    Ok(outcomes.status())
}

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

    fn summary(&self) -> String {
        let Self { holding, failing, not_judged, cases_needed } = *self;
        let word = match self.status() {
            exit::AGREES => "AGREES",
            exit::DISAGREES => "DISAGREES",
            _ => "NOT JUDGED",
        };
        let all = holding + failing + not_judged;
        let mut text = format!("{word}: {holding} of {all} invariants hold, {failing} do not");
        if not_judged > 0 {
            text += &format!(", {not_judged} not judged");
        }
        if cases_needed > 0 {
            text += &format!(" (--cases {cases_needed} judges them)");
        }
        text
    }
}

fn judge(
    invariant: &Invariant,
    subject: &Subject,
    (seed, cases): (u64, u64),
    repeat: &dyn Fn(u64) -> String,
    (outcomes, out): (&mut Outcomes, &mut dyn Write),
) -> Result<(), Failure> {
    writeln!(out, "{} {}: {}", invariant.number, invariant.name, invariant.statement)?;
    let report = invariant.run(subject, seed, cases);
    writeln!(out, "  tolerance: {}", invariant.tolerance)?;
    let skipped = match report.skipped {
        0 => String::new(),
        n => format!(", {n} left out that do not fit it"),
    };
    writeln!(
        out,
        "  seed {seed}, {} cases{skipped}, {} comparisons",
        report.cases, report.compared
    )?;
    match report.ruling() {
        Ruling::Holds => outcomes.holding += 1,
        Ruling::Fails => outcomes.failing += 1,
        Ruling::NotJudged => outcomes.not_judged += 1,
    }
    if let Some(failure) = &report.failure {
        writeln!(out, "  FAILS in case {}: {}", failure.index, failure.message)?;
        writeln!(out, "  smallest found: {}", failure.input)?;
        writeln!(out, "  repeat with: {}", repeat(cases))?;
    } else if report.ruling() == Ruling::Holds {
        writeln!(out, "  holds")?;
    } else if let Some(needed) = invariant.cases_needed(subject, seed) {
        outcomes.cases_needed = outcomes.cases_needed.max(needed);
        writeln!(
            out,
            "  NOT JUDGED: none of these cases fits it; the first that fits needs more:"
        )?;
        writeln!(out, "  judge it with: {}", repeat(needed))?;
    } else if matches!(invariant.check, Check::Run(..) | Check::Matrix) {
        writeln!(out, "  NOT JUDGED: the system refuses the threads whose verdicts it compares;")?;
        writeln!(out, "  allow this user more processes (ulimit -u)")?;
    } else {
        writeln!(out, "  NOT JUDGED: none of the first {MOST_LOOKED_THROUGH} cases fits it;")?;
        writeln!(out, "  try another --seed")?;
    }
    writeln!(out)?;
    Ok(())
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
    let (out, problems) = (&mut *streams.output, matrix.problems());
    let mark = |is_right: bool| summary::mark(is_right, streams.colour);
    let (rows, columns) = (matrix.rows.len(), matrix.columns.len());
    let answer = match problems.is_empty() {
        true => format!("each of {columns} invariants kills a fault, each of {rows} faults dies"),
        false => problems.join("; "),
    };
    writeln!(out, "{} {answer}\n", mark(problems.is_empty()))?;
    if arguments.table || !problems.is_empty() {
        writeln!(out, "{}", matrix.text())?;
    }
    writeln!(out, "each fault, the number of invariants that it breaks, and what it is:")?;
    for (name, marks) in &matrix.rows {
        let kills = marks.iter().filter(|&&mark| mark).count();
        let about = planted::about(name).unwrap_or("a check that cannot fail");
        writeln!(out, "  {} {name:<26} {kills:>2}  {about}", mark(kills > 0))?;
    }
    if !arguments.table {
        writeln!(out, "which invariant kills which: add --table")?;
    }
    writeln!(out, "see one judged: {} --plant NAME", program())?;
    Ok(if problems.is_empty() { exit::AGREES } else { exit::DISAGREES })
}

pub fn list(out: &mut dyn Write) -> Result<(), Failure> {
    writeln!(out, "\nInvariants (rasterproof verify --invariant NAME, or all):")?;
    for i in CATALOGUE {
        write_entry(out, &format!("{:>2} {:<20}", i.number, i.name), i.statement)?;
    }
    Ok(())
}
