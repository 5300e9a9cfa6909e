//! Fills and frames beside other rasterizers, in interleaved rounds, with the wrong pixels of each.
//!
//! `benches/peers/run` builds and runs it; see there for its words. Everything that the page on speed
//! says of others comes from it.
#![allow(clippy::disallowed_methods, reason = "it reads and writes files of its own")]

#[path = "../../common/mod.rs"]
mod common;
mod filler;
mod fills;
mod frames;
mod growth;
mod mesh;
mod outside;
mod pages;
mod rates;
mod retro;
mod spread;
mod text;

use std::fs;
use std::process::{Command, ExitCode};

use rasterproof_render::scene::meshes;
use rasterproof_tiles::coverage::Tiles;
use serde::Serialize;

use crate::fills::Errors;
use crate::outside::{Children, Missing};

/// Odd, so that the median is a round that happened.
const FILL_ROUNDS: usize = 21;
const FRAME_ROUNDS: usize = 11;

#[derive(Serialize)]
struct Machine {
    command: String,
    processor: String,
    cores: usize,
    system: String,
    instructions: &'static str,
    day: String,
    commit: String,
}

#[derive(Serialize)]
struct Growth {
    #[serde(flatten)]
    machine: Machine,
    rows: Vec<growth::Row>,
}

#[derive(Serialize)]
pub struct Results {
    #[serde(flatten)]
    machine: Machine,
    versions: Vec<String>,
    missing: Vec<Missing>,
    fill_rounds: usize,
    frame_rounds: usize,
    fills: Vec<fills::Row>,
    frames: Vec<frames::Row>,
}

impl Results {
    /// Ours that a fill is compared with: with one sample the list; antialiased, the fastest of ours
    /// whose errors are no larger.
    fn ours(&self, row: &fills::Row) -> &fills::Row {
        let all = self.fills.iter().filter(|other| other.class == row.class);
        let equal = all.filter(|other| match (&other.errors, &row.errors) {
            (Errors::Pixels { .. }, Errors::Pixels { .. }) => other.name == "list",
            (Errors::Areas { rms: ours, .. }, Errors::Areas { rms, .. }) => {
                other.name == "exact area" || other.name == "4 x 4 samples" && ours <= rms
            }
            _ => false,
        });
        equal.min_by(|a, b| a.ns.median.total_cmp(&b.ns.median)).expect("ours is among them")
    }

    /// The tiles' frame of the same mesh, with as many samples and cores.
    fn tiles(&self, row: &frames::Row) -> &frames::Row {
        let like = |tiles: &frames::Row| {
            (&tiles.mesh, tiles.samples, tiles.cores) == (&row.mesh, row.samples, row.cores)
        };
        let mut all = self.frames.iter().filter(|other| other.name == "tiles");
        all.find(|tiles| like(tiles)).expect("tiles draw everything")
    }
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("error: {why}");
            ExitCode::from(2)
        }
    }
}

/// Writes the tables and plots of the recorded runs into the page on speed, in both languages.
fn write_pages() -> Result<(), String> {
    let read = |path: &str| fs::read_to_string(path).map_err(|error| format!("{path}: {error}"));
    let mut runs = [(); 3].map(|()| serde_json::Value::Null);
    for (run, path) in runs.iter_mut().zip(pages::RUNS) {
        *run = serde_json::from_str(&read(path)?).map_err(|error| format!("{path}: {error}"))?;
    }
    for (path, text) in pages::renewed(runs.each_ref(), |path| read(path).unwrap_or_default()) {
        fs::write(&path, text).map_err(|error| format!("{path}: {error}"))?;
    }
    Ok(())
}

fn run() -> Result<(), String> {
    let mut words = std::env::args().skip(1);
    let (mut quick, mut grows, mut json, mut names) = (false, false, None, Vec::new());
    let mut memory = None;
    while let Some(word) = words.next() {
        match word.as_str() {
            "--quick" => quick = true,
            "--growth" => grows = true,
            "--pages" => return write_pages(),
            "--only" => return only(&words.collect::<Vec<_>>()),
            // `limits.py` reads these.
            "--rates" => return rates::print(&machine(), &words.collect::<Vec<_>>()),
            // Growth starts itself so.
            "--memory" => {
                let mut number = || words.next()?.parse().ok();
                memory = Some([number(), number()].map(|number| number.unwrap_or(usize::MAX)));
            }
            "--json" => json = Some(words.next().ok_or("--json needs the name of a file")?),
            _ if word.starts_with('-') => {
                return Err(format!(
                    "{word} is no option: there are --quick, --growth, --only, --pages and --json FILE"
                ));
            }
            _ => names.push(word),
        }
    }
    let machine = machine();
    let threads = machine.cores.min(2);
    let pools: Vec<_> = (1..=threads)
        .map(|threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build())
        .collect::<Result<_, _>>()
        .map_err(|error| error.to_string())?;
    if let Some([point, engine]) = memory {
        let megabytes = growth::megabytes(quick, point, engine, &pools);
        return megabytes.map(|megabytes| println!("{megabytes}")).ok_or("no such point".into());
    }
    if grows {
        if let Some(name) = names.first() {
            return Err(format!("{name}: --growth takes no names"));
        }
        print!("{}", text::machine(&machine));
        let told = |rows: &[growth::Row]| print!("{}", text::growth(rows));
        let rows = pools[threads - 1].install(|| growth::measure(quick, &pools, told));
        return save(json, &Growth { machine, rows });
    }
    let scenes = common::scenes();
    let known = scenes.iter().map(|scene| scene.name).chain(frames::MESHES);
    let known: Vec<&str> = known.collect();
    if let Some(unknown) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(format!(
            "{unknown} is neither a class nor a mesh: there are {}",
            known.join(", ")
        ));
    }
    // A quick run is there to see that everything still runs.
    let usual = ["tiny", "sliver", "torus-2000"];
    let wanted = |name: &str| match (quick, names.is_empty()) {
        (_, false) => names.iter().any(|word| word == name),
        (true, true) => usual.contains(&name),
        (false, true) => true,
    };
    let (fill_rounds, frame_rounds) = if quick { (1, 1) } else { (FILL_ROUNDS, FRAME_ROUNDS) };
    let mut results = Results {
        machine,
        versions: versions(),
        missing: Vec::new(),
        fill_rounds,
        frame_rounds,
        fills: Vec::new(),
        frames: Vec::new(),
    };
    let failed = |error: std::io::Error| format!("{}: {error}", outside::folder().display());
    let mut children =
        Children::start(&scenes, &mut results.versions, &mut results.missing).map_err(failed)?;
    for scene in scenes.iter().filter(|scene| wanted(scene.name)) {
        results.fills.extend(fills::measure(scene, fill_rounds, &mut children));
    }
    drop(children);
    for name in frames::MESHES.into_iter().filter(|name| wanted(name)) {
        let scene = meshes::scene(name).ok_or("a mesh of the catalogue is gone")?;
        let draw = || frames::measure(&scene, common::SIDE_PX, frame_rounds, !quick, &pools);
        let drawn = pools[threads - 1].install(draw).map_err(failed)?;
        results.frames.extend(drawn.rows);
        results.versions.extend(drawn.versions);
        results.missing.extend(drawn.missing);
    }
    let mut seen = std::collections::HashSet::new();
    results.versions.retain(|version| seen.insert(version.clone()));
    results.missing.retain(|missing| seen.insert(missing.name.clone()));
    print!("{}", text::text(&results));
    save(json, &results)
}

fn machine() -> Machine {
    let said = std::env::args().skip(1);
    Machine {
        command: ["benches/peers/run".to_owned()]
            .into_iter()
            .chain(said)
            .collect::<Vec<_>>()
            .join(" "),
        processor: processor(),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
        system: first_line("uname", &["-sr"]),
        instructions: Tiles::default().instructions(),
        day: first_line("date", &["-u", "+%F"]),
        commit: first_line("git", &["describe", "--always", "--dirty", "--abbrev=10"]),
    }
}

/// Draws or fills the same again and again and nothing else, for programs that count instructions.
fn only(words: &[String]) -> Result<(), String> {
    let number = |word: &String| word.parse().map_err(|error| format!("{word}: {error}"));
    match words {
        [mesh, samples, side, count, set] => {
            frames::only(mesh, samples, number(side)?, number(count)?, set)
        }
        [class, name, count] => fills::only(class, name, number(count)?),
        _ => Err("--only needs a mesh, samples, a side, frames and an instruction set, \
                  or a class, who fills it, and how often"
            .to_owned()),
    }
}

fn save(file: Option<String>, results: &impl Serialize) -> Result<(), String> {
    let Some(file) = file else { return Ok(()) };
    let text = serde_json::to_string_pretty(results).map_err(|error| error.to_string())?;
    fs::write(&file, text + "\n").map_err(|error| format!("{file}: {error}"))
}

/// The versions of peers that are Rust, as they were compiled.
fn versions() -> Vec<String> {
    let lock = include_str!("../Cargo.lock");
    let peers = [
        "ab_glyph_rasterizer",
        "euc",
        "raqote",
        "retrofire-core",
        "tiny-skia",
        "vello_cpu",
        "zeno",
    ];
    let of = |name: &str| {
        let (_, after) = lock.split_once(&format!("name = \"{name}\"\nversion = \""))?;
        Some(format!("{name} {}", after.split('"').next()?))
    };
    peers.into_iter().filter_map(of).collect()
}

fn processor() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    name.map_or_else(|| "an unnamed processor".to_owned(), |(_, name)| name.to_owned())
}

fn first_line(program: &str, words: &[&str]) -> String {
    let done = Command::new(program).args(words).output();
    let text = done.map(|done| String::from_utf8_lossy(&done.stdout).into_owned());
    text.unwrap_or_default().lines().next().unwrap_or_default().to_owned()
}
