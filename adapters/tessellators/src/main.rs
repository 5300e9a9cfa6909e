//! Judges tessellators of other people over the families of polygons. See `USAGE`.
//!
//! A tessellator may overflow its stack or not return. So it runs in a process of its own, which prints a line before and after
//! each polygon; when it ends early, the next process goes on behind the polygon at which it ended.

mod libraries;
mod tally;

use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::{Command, ExitCode, Stdio, exit};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use rasterproof_verify::partition::{
    Coordinates, Family, FaultKind, Options, Point, Polygon, Refused, Tessellate, Triangle,
    judge_partition, judge_partitions,
};
use tally::{ENDED, KINDS, SILENT, Tally};

const USAGE: &str =
    "run NAME POLYGONS      goes on until so many polygons were judged; keeps results/NAME.csv
smallest NAME          prints the smallest polygon of each kind of fault
table                  prints the table of all results";

/// Polygons of each family between two writings of the results.
const ROUND: u64 = 1_000;
/// The longest time for a polygon of some hundred vertices at most.
const PATIENCE: Duration = Duration::from_secs(2);
/// The exit status of a process that waited so long.
const OUT_OF_PATIENCE: i32 = 9;

pub struct Library {
    pub name: &'static str,
    pub version: &'static str,
    pub coordinates: Coordinates,
    /// Families whose polygons its interface cannot express.
    pub left_out: &'static [Family],
    /// Whether its documentation covers a polygon.
    pub accepts: fn(&Polygon) -> bool,
    pub triangles: fn(&Polygon) -> Result<Vec<Triangle>, Refused>,
}

impl Library {
    fn options(&self) -> Options {
        Options::default().coordinates(self.coordinates)
    }

    fn families(&self) -> impl Iterator<Item = Family> {
        Family::ALL.into_iter().filter(|family| !self.left_out.contains(family))
    }

    fn process(&self, words: &[&str]) -> Command {
        let mut command = Command::new(std::env::current_exe().expect("this program has a path"));
        command.arg(words[0]).arg(self.name).args(&words[1..]);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        command
    }
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    // A panic is a finding, and is shown with the polygon.
    std::panic::set_hook(Box::new(|_| ()));
    let library = words.get(1).and_then(|name| libraries::ALL.iter().find(|l| l.name == *name));
    match (words.as_slice(), library) {
        (["table"], _) => table(),
        (["run", _, polygons], Some(library)) => match polygons.parse() {
            Ok(polygons) => run(library, polygons),
            Err(_) => return usage(),
        },
        (["smallest", _], Some(library)) => smallest(library),
        // What `run` and `smallest` start.
        (["some", _, family, first, end], Some(library)) => some(library, family, first, end),
        (["one", _], Some(library)) => one(library),
        _ => return usage(),
    }
    ExitCode::SUCCESS
}

fn usage() -> ExitCode {
    let names: Vec<_> = libraries::ALL.iter().map(|library| library.name).collect();
    eprintln!("{USAGE}\nnames: {}", names.join(" "));
    ExitCode::from(2)
}

fn run(library: &Library, polygons: u64) {
    let mut tallies = tally::read(library);
    while tallies.iter().map(|tally| tally.judged).sum::<u64>() < polygons {
        for tally in &mut tallies {
            let end = tally.drawn() + ROUND;
            while tally.drawn() < end {
                judge_range(library, tally, end);
            }
        }
        tally::write(library, &tallies);
    }
}

/// Counts what a process says about polygons, up to `end` or the first at which it ends.
fn judge_range(library: &Library, tally: &mut Tally, end: u64) {
    let (first, last) = (tally.drawn().to_string(), end.to_string());
    let mut child = library
        .process(&["some", tally.family.name(), &first, &last])
        .spawn()
        .expect("this program starts itself");
    let output = BufReader::new(child.stdout.take().expect("it is piped"));
    let mut begun = false;
    for line in output.lines() {
        let line = line.expect("the process writes text");
        begun = line == "begun";
        if !begun {
            tally.count(&line.split(' ').map(|n| n.parse().expect("a number")).collect::<Vec<_>>());
        }
    }
    let status = child.wait().expect("a child can be waited for");
    if begun {
        let kind = if status.code() == Some(OUT_OF_PATIENCE) { SILENT } else { ENDED };
        let polygon = tally.family.polygon(1, tally.drawn(), library.coordinates);
        // On a busy machine the process may only have waited for the processor, so a second one tries the polygon.
        let ask = || Apart { library, sought: SILENT }.triangles(&polygon);
        if kind == SILENT && !matches!(catch_unwind(AssertUnwindSafe(ask)), Ok(Err(_))) {
            return;
        }
        tally.count(&[1, vertices(&polygon), 0, 1 << kind]);
    } else {
        assert!(status.success(), "{}: {status} between polygons", library.name);
    }
}

fn vertices(polygon: &Polygon) -> u64 {
    polygon.contours.iter().map(|contour| contour.len() as u64).sum()
}

/// Polygons `first` to `end` of a family, with a line for each: whether it is judged, vertices, added points, a bit for
/// each kind of fault.
fn some(library: &Library, family: &str, first: &str, end: &str) {
    let family = Family::ALL.into_iter().find(|f| f.name() == family).expect("a family");
    let [first, end] = [first, end].map(|word| word.parse::<u64>().expect("a number"));
    watch();
    let mut out = std::io::stdout().lock();
    for index in first..end {
        STEPS.fetch_add(1, Ordering::Relaxed);
        let polygon = family.polygon(1, index, library.coordinates);
        if !(library.accepts)(&polygon) {
            writeln!(out, "0 0 0 0").expect("the parent reads");
            continue;
        }
        writeln!(out, "begun").expect("the parent reads");
        let made = catch_unwind(AssertUnwindSafe(|| (library.triangles)(&polygon)));
        let bit = |kind| 1_u64 << FaultKind::ALL.iter().position(|k| *k == kind).expect("a kind");
        let (mut bits, mut added) = (0, 0);
        match made {
            Err(_) => bits = bit(FaultKind::Panicked),
            Ok(Err(_)) => bits = bit(FaultKind::Refused),
            Ok(Ok(triangles)) => {
                let finding = judge_partition(&polygon, &triangles, &library.options());
                let finding = finding.expect("generated polygons are valid");
                bits = finding.faults.iter().fold(bits, |bits, fault| bits | bit(fault.kind));
                added = finding.added_points;
            }
        }
        writeln!(out, "1 {} {added} {bits}", vertices(&polygon)).expect("the parent reads");
    }
}

static STEPS: AtomicU64 = AtomicU64::new(0);

/// Ends this process if nothing is done for too long.
fn watch() {
    std::thread::spawn(|| {
        let mut seen = u64::MAX;
        loop {
            let steps = STEPS.load(Ordering::Relaxed);
            if steps == seen {
                exit(OUT_OF_PATIENCE);
            }
            seen = steps;
            std::thread::sleep(PATIENCE);
        }
    });
}

/// The triangles of the polygon on standard input, or what the library says instead.
fn one(library: &Library) {
    watch();
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).expect("the parent writes text");
    let contours = text.lines().map(|line| points(line).collect()).collect();
    let made = catch_unwind(AssertUnwindSafe(|| (library.triangles)(&Polygon::new(contours))));
    match made {
        Ok(Ok(triangles)) => println!("made\n{}", words(triangles.as_flattened())),
        Ok(Err(refused)) => println!("refused\n{refused}"),
        Err(payload) => {
            let text = payload.downcast_ref::<String>().map(String::as_str);
            let text = text.or(payload.downcast_ref::<&str>().copied()).unwrap_or("panic");
            println!("panicked\n{text}");
        }
    }
}

fn words(points: &[Point]) -> String {
    points.as_flattened().iter().fold(String::new(), |mut text, value| {
        let _ = write!(text, "{:x} ", value.to_bits());
        text
    })
}

fn points(line: &str) -> impl Iterator<Item = Point> {
    let bits = |word| u64::from_str_radix(word, 16).expect("a hexadecimal number");
    let values: Vec<f64> = line.split_whitespace().map(|word| f64::from_bits(bits(word))).collect();
    values.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect::<Vec<_>>().into_iter()
}

/// A library that gets each polygon in a new process.
struct Apart<'a> {
    library: &'a Library,
    /// Of what counts as a refusal: the process that ended, the one that was waited for too long, or what the library refuses.
    sought: usize,
}

impl Tessellate for Apart<'_> {
    fn triangles(&self, polygon: &Polygon) -> Result<Vec<Triangle>, Refused> {
        let mut child = self.library.process(&["one"]).spawn().expect("this program starts itself");
        let contours: Vec<_> = polygon.contours.iter().map(|contour| words(contour)).collect();
        let mut input = child.stdin.take().expect("it is piped");
        // A process that ended does not read.
        let _ = input.write_all(contours.join("\n").as_bytes());
        drop(input);
        let output = child.wait_with_output().expect("a child can be waited for");
        let text = String::from_utf8_lossy(&output.stdout);
        let refused = FaultKind::ALL.iter().position(|kind| *kind == FaultKind::Refused);
        let (kind, said) = match text.split_once('\n') {
            Some(("made", text)) => {
                let corners: Vec<Point> = points(text).collect();
                return Ok(corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect());
            }
            Some(("panicked", text)) => panic!("{}", text.trim_end()),
            Some((_, text)) => (refused.expect("a kind"), text.trim_end().to_owned()),
            None if output.status.code() == Some(OUT_OF_PATIENCE) => {
                (SILENT, format!("no triangles within {PATIENCE:?}"))
            }
            None => (ENDED, format!("the process ended: {}", output.status)),
        };
        if kind == self.sought { Err(Refused(said)) } else { Ok(Vec::new()) }
    }

    fn accepts(&self, polygon: &Polygon) -> bool {
        (self.library.accepts)(polygon)
    }
}

fn smallest(library: &Library) {
    let tallies = tally::read(library);
    for kind in 0..KINDS.len() {
        let found = tallies.iter().filter_map(|tally| Some((tally.smallest[kind]?, tally.family)));
        let Some(((_, index), family)) = found.min_by_key(|((size, _), _)| *size) else { continue };
        let fault = FaultKind::ALL.get(kind).copied().unwrap_or(FaultKind::Refused);
        let options = library.options().family(family).only(index);
        let report = judge_partitions(&Apart { library, sought: kind }, &options);
        let report = report.expect("it was judged before");
        let Some(failure) = report.failures.iter().find(|failure| failure.kind == fault) else {
            println!("{}: number {index} of {} does not fail again", KINDS[kind], family.name());
            continue;
        };
        println!(
            "{}, from number {index} of {}\n  {}",
            KINDS[kind],
            family.name(),
            failure.polygon
        );
        for (number, triangle) in failure.triangles.iter().enumerate() {
            println!("  triangle {number}: {triangle:?}");
        }
        println!("  {}\n", failure.finding.to_string().replace('\n', "\n  "));
    }
}

fn table() {
    println!("| crate | polygons | left out | not covered once | T-junctions | no area |");
    println!("|---|{}", "---:|".repeat(5));
    for library in libraries::ALL {
        let tallies = tally::read(library);
        let sum = |of: &dyn Fn(&Tally) -> u64| grouped(tallies.iter().map(of).sum());
        let cells = [
            sum(&|t| t.judged),
            sum(&|t| t.left_out),
            sum(&|t| t.wrong_cover),
            sum(&|t| t.faults[7]),
            sum(&|t| t.faults[8]),
        ];
        println!("| {} {} | {} |", library.name, library.version, cells.join(" | "));
    }
}

/// A number with a comma before each three digits.
fn grouped(number: u64) -> String {
    let mut text = String::new();
    let digits = number.to_string();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i) % 3 == 0 {
            text.push(',');
        }
        text.push(digit);
    }
    text
}
