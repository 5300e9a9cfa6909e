//! `rasterproof exhaust` and `rasterproof merge`: proofs by exhaustion and their certificates.

use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Subcommand;
use rasterproof_host::output::{self, Lock, Output, Over, Use};
use rasterproof_host::text::{printable, printable_path};
use rasterproof_host::{input, limits};

use super::progress::Progress;
use super::{InputError, Status, Streams, exit, pair, usage, write_file};
use rasterproof_exhaustive::Plan;
use rasterproof_exhaustive::certificate::{self, Certificate};
use rasterproof_exhaustive::counts::Counts;
use rasterproof_exhaustive::edges::Edges;
use rasterproof_exhaustive::identity::Shard;
use rasterproof_exhaustive::lines::Lines;
use rasterproof_exhaustive::run;
use rasterproof_exhaustive::triangles::Triangles;
use rasterproof_report::html::{Outcome, Report};
use rasterproof_report::{json, text};

const SAVE_EVERY: Duration = Duration::from_secs(3);

#[derive(clap::Args, Debug)]
pub struct ExhaustArguments {
    #[command(subcommand)]
    what: What,
    /// Move everything by this many pixels, for example --offset-px=-2048,2048
    #[arg(long, global = true, value_name = "X,Y", value_parser = parse_offset, default_value = "0,0",
          allow_hyphen_values = true)]
    offset_px: [i32; 2],
    /// Only part I of N, I from 0
    #[arg(long, global = true, value_name = "I/N", value_parser = super::verify::parse_shard, default_value = "0/1")]
    shard: (u64, u64),
    /// Write the certificate here instead of to standard output
    #[arg(short, long, global = true, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Where the state is kept while it runs [default: a file in target/rasterproof]
    #[arg(long, global = true, value_name = "FILE")]
    checkpoint: Option<PathBuf>,
    /// Begin anew, whatever the checkpoint says
    #[arg(long, global = true)]
    restart: bool,
    /// Plant a fault in an engine, to see the proof fail
    #[arg(long, global = true, value_name = "FAULT", hide = true)]
    plant: Option<String>,
}

#[derive(Subcommand, Debug)]
enum What {
    /// All triangles on the lattice of a window: both rasterizers and the oracle
    Triangles {
        /// Side of the window in pixels
        #[arg(long, value_name = "PX", default_value_t = 4)]
        window: u32,
        /// Bits of a coordinate below the pixel, at most 4
        #[arg(long, value_name = "BITS", default_value_t = 2)]
        subpixel_bits: u32,
        /// Present each triangle in all six orders of its corners instead of one
        #[arg(long)]
        all_orders: bool,
    },
    /// All lines up to a reach: both line drawers and the oracle
    Lines {
        /// Largest |dx| and |dy| in pixels
        #[arg(long, value_name = "PX", default_value_t = 256)]
        reach: u32,
        /// Only 0 <= dy <= dx
        #[arg(long)]
        first_octant: bool,
    },
    /// All edges on the lattice of a window: both rasterizers, row by row
    Edges {
        /// Side of the window in pixels
        #[arg(long, value_name = "PX", default_value_t = 4)]
        window: u32,
        /// Bits of a coordinate below the pixel, at most 8
        #[arg(long, value_name = "BITS", default_value_t = 5)]
        subpixel_bits: u32,
        /// Every position in the window, not only one of those that whole pixels apart
        #[arg(long)]
        every_position: bool,
    },
}

#[derive(clap::Args, Debug)]
pub struct MergeArguments {
    /// The certificates of all shards of one run
    #[arg(value_name = "FILES", required = true)]
    files: Vec<PathBuf>,
    /// Write the certificate here instead of to standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Judge N chunks again, and compare what is found with what the certificates say
    #[arg(long, value_name = "N", value_parser = super::whole::<u64>(1..=u64::MAX))]
    check: Option<u64>,
    /// Decides which chunks --check judges [default: another number in each run]
    #[arg(long, value_name = "S", value_parser = super::whole::<u64>(0..=u64::MAX), requires = "check")]
    seed: Option<u64>,
}

/// How far everything is moved, to the right and down.
fn parse_offset(text: &str) -> Result<[i32; 2], &'static str> {
    match pair(text, &[',']) {
        Some((x, y)) => Ok([x, y]),
        None => Err("expected X,Y in whole pixels, for example 2048,0"),
    }
}

impl ExhaustArguments {
    /// The finite set of cases that is judged.
    fn plan(&self) -> Plan {
        let (offset_px, plant) = (self.offset_px, self.plant.clone());
        match self.what {
            What::Triangles { window: window_px, subpixel_bits, all_orders } => {
                Plan::Triangles(Triangles {
                    window_px,
                    subpixel_bits,
                    offset_px,
                    all_orders,
                    plant,
                })
            }
            What::Lines { reach, first_octant } => {
                Plan::Lines(Lines { reach, offset_px, first_octant, plant })
            }
            What::Edges { window: window_px, subpixel_bits, every_position } => {
                Plan::Edges(Edges { window_px, subpixel_bits, offset_px, every_position, plant })
            }
        }
    }

    /// The file of the state: the one that was named, or one whose name says of which cases it is.
    fn checkpoint(&self, plan: &Plan) -> PathBuf {
        if let Some(path) = &self.checkpoint {
            return path.clone();
        }
        let words = plan.enumeration().words().replace([' ', '-', '=', ','], "_");
        let (part, parts) = self.shard;
        Path::new("target/rasterproof").join(format!("exhaust_{words}_{part}_of_{parts}.json"))
    }
}

/// Judges all cases of a set, or goes on with it, and writes the certificate.
pub fn run(arguments: &ExhaustArguments, streams: &mut Streams<'_>) -> Status {
    let plan = arguments.plan();
    plan.check()?;
    let (part, parts) = arguments.shard;
    let shard = Shard { part, parts };
    let certificate_file = arguments.output.as_deref().map(Output::typed);
    let certificate_file = certificate_file.as_ref();
    // Whether it is a checkpoint is seen when it is read.
    let state = Output { path: arguments.checkpoint(&plan), over: Over::Updated };
    let path = &state.path;
    let lock = Lock::file_of(path);
    let kept = [state.named("--checkpoint"), ("its lock", &lock, Use::Writes(Over::Updated))];
    let output = certificate_file.map(|output| output.named("--output"));
    output::check_all(kept.into_iter().chain(output))?;
    let cases = Counts::of(&plan, shard.chunks(&plan)).cases;
    if cases == 0 {
        let all = plan.enumeration().expected_cases();
        return Err(usage(format!(
            "shard {part} of {parts} holds none of the {all} cases, so nothing would be judged; merge \
             does not need it"
        )));
    }
    // Another process that resumed and saved the same state would count chunks twice or lose them.
    let _lock = Lock::acquire(path).map_err(|error| usage(format!("the checkpoint {error}")))?;
    let start = match kept_state(path)? {
        Some(state) if !arguments.restart => resume(state, path, &plan, shard)?,
        _ => run::Progress::new(&plan, shard),
    };
    // The bar begins where the earlier run came to.
    let progress = Progress::new(streams.progress, "cases", Some(cases));
    progress.resume_at(start.tally.cases);
    let save = |progressed: &run::Progress| {
        // A full disk must not end a proof; the next save may succeed.
        if let Err(failure) = write_file(&state, json::line(progressed).as_bytes()) {
            progress.warn(&format!("warning: {failure}"));
        }
    };
    // Find out at once, not after hours, whether it can be written.
    write_file(&state, json::line(&start).as_bytes())?;
    let finished = run::run(start, SAVE_EVERY, &save, &|cases| progress.done(cases));
    // Until the certificate is written, the checkpoint is all there is.
    save(&finished);
    drop(progress);
    let certificate = Certificate::new(finished, rayon::current_num_threads());
    let status = issue(&certificate, certificate_file, streams)?;
    // Standard output, too, holds the certificate only if it was taken.
    streams.output.flush()?;
    // What is not written in full is no proof, so the checkpoint stays until the certificate has arrived.
    if streams.delivery.is_whole() {
        if let Err(error) = output::remove(path) {
            writeln!(streams.errors, "warning: {error}")?;
        }
    } else {
        let kept = printable_path(path);
        writeln!(streams.errors, "the result is kept in {kept}; the same command writes it again")?;
    }
    Ok(status)
}

/// The state in a checkpoint; nothing where there is no file. What is no checkpoint is not replaced, whatever the options
/// say: it is the file of somebody else.
fn kept_state(path: &Path) -> Result<Option<run::Progress>, InputError> {
    let name = printable_path(path);
    let text = match input::read_text(path, limits::DOCUMENT_BYTES) {
        Err(error) if error.missing => return Ok(None),
        read => read.map_err(|error| usage(format!("the checkpoint {error}")))?,
    };
    serde_json::from_str(&text).map(Some).map_err(|error| {
        usage(format!(
            "{name} is not a checkpoint ({}); name another file by --checkpoint, or remove this one",
            printable(&error.to_string())
        ))
    })
}

/// The state of a checkpoint as one from which this run can go on.
fn resume(
    progress: run::Progress,
    path: &Path,
    plan: &Plan,
    shard: Shard,
) -> Result<run::Progress, InputError> {
    let is_not = |why: String| {
        usage(format!("the checkpoint {} was {why}; --restart ignores it", printable_path(path)))
    };
    if !progress.belongs_to(plan, shard) {
        return Err(is_not("made by other options or other code".to_owned()));
    }
    progress.check().map_err(|error| is_not(format!("changed or is damaged: {error}")))?;
    Ok(progress)
}

/// Writes the certificate, says what it says, and returns the exit status.
fn issue(certificate: &Certificate, file: Option<&Output>, streams: &mut Streams<'_>) -> Status {
    if file.is_none() {
        streams.output.write_all(certificate.to_json().as_bytes())?;
    }
    let done = &certificate.done;
    let mut notes = Vec::new();
    for example in &done.examples {
        notes.push(format!("wrong: {}", printable(&example.what)));
    }
    // A shard cannot have all cases, so only a whole run is asked for them.
    let (Shard { part, parts }, timing) = (certificate.shard, &certificate.timing);
    let whole = parts == 1;
    let agrees = certificate.agrees() && (!whole || certificate.is_complete());
    let shard = if whole { String::new() } else { format!(" (shard {part} of {parts})") };
    let (cases, expected) = (done.cases, certificate.expected.cases);
    let counts = format!("{} comparisons, {} wrong", done.comparisons, done.mismatches);
    let time = format!("{:.1} s on {} threads", timing.seconds, timing.threads);
    let sentence = format!("{cases} of {expected} cases{shard}, {counts}, {time}");
    let report = Report {
        about: certificate.identity.plan.enumeration().words(),
        notes,
        outcome: Some(Outcome::of(agrees, sentence)),
        ..Report::default()
    };
    // Standard output may have the certificate.
    streams.errors.write_all(text::text(&report, true, false, text::WIDTH).as_bytes())?;
    if let Some(file) = file {
        streams.save(file, certificate.to_json().as_bytes());
    }
    Ok(exit::of(agrees))
}

/// Joins the certificates of all shards into one, and judges some of their cases again where that is asked for.
pub fn merge(arguments: &MergeArguments, streams: &mut Streams<'_>) -> Status {
    let read = arguments.files.iter().map(|path| ("a shard", path.as_path(), Use::Reads));
    let output = arguments.output.as_deref().map(Output::typed);
    let written = output.as_ref().map(|output| output.named("--output"));
    output::check_all(read.chain(written))?;
    // Files of shards come from several machines, so each is checked by itself before they are joined.
    let mut shards = Vec::new();
    for path in &arguments.files {
        let name = printable_path(path);
        let text = input::read_text(path, limits::CERTIFICATE_BYTES)?;
        let certificate = Certificate::from_json(&text).map_err(|what| {
            let what = printable(&what.to_string()).into_owned();
            usage(format!("{name} {what}; name files that exhaust --output has written"))
        })?;
        shards.push((name, certificate));
    }
    let merged = certificate::merge(&shards)?;
    if let Some(count) = arguments.check {
        judge_again(&merged, count, arguments.seed, streams)?;
    }
    issue(&merged, output.as_ref(), streams)
}

/// Judges some chunks again; what the certificate says otherwise is an error.
fn judge_again(
    merged: &Certificate,
    count: u64,
    seed: Option<u64>,
    streams: &mut Streams<'_>,
) -> Result<(), InputError> {
    // Whoever makes a file cannot know a number that is drawn afterwards.
    let seed = seed.unwrap_or_else(|| RandomState::new().build_hasher().finish());
    let progress = Progress::new(streams.progress, "cases", None);
    let step = |cases| progress.done(cases);
    let checked = certificate::judge_again(merged, count, seed, &step);
    drop(progress);
    let (chunks, cases) = checked.map_err(|error| {
        let (again, error) = (&merged.repeat, printable(&error));
        usage(format!("the files are refused: {error} (--seed {seed}); judge all anew: {again}"))
    })?;
    let all = merged.identity.plan.enumeration().chunks();
    writeln!(
        streams.errors,
        "judged again: {chunks} of {all} chunks, {cases} cases (--seed {seed}): as the files say"
    )?;
    Ok(())
}
