//! The gate of the plan: planned is never slower than everything-on by more than 3%, in any scene of
//! the book, any mesh and any antialiasing, by either rasterizer. Beside both stands what any
//! sensible renderer does without a planner (`usual`).
//!
//! Ends with an error where a row loses. A frame is timed by the processor time of its own thread, so
//! that a busy machine does not count as work; frames of the three kinds alternate, each round begins
//! with another one, and a row compares medians of the rounds' ratios. Three rounds are enough where
//! planned is far ahead; a row that seems to lose is measured again, with more rounds, before it counts.
//!
//! `cargo bench --bench effects` measures all rows, `-- facets` those whose name contains a word,
//! `-- --quick` with fewer rounds. Each pair of pictures is compared to the bit before it is timed.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

use std::process::ExitCode;

use rasterproof::effects::Effects;
use rasterproof::lineup::Drawer;
use rasterproof::pipeline::depth::DepthFormat;
use rasterproof::pipeline::target::{Antialias, Target};
use rasterproof::scene::chapters::{SCENES, scene};
use rasterproof::scene::{Scene, meshes, random};
use rustix::time::{ClockId, clock_gettime};

/// Planned may take so many times as long as everything-on.
const MOST: f64 = 1.03;

/// A row so far ahead after few rounds is not measured with all of them.
const AHEAD: f64 = 0.9;
const FEW: usize = 3;

const SMOOTHINGS: [(Antialias, &str); 4] = [
    (Antialias::None, "none"),
    (Antialias::Multisample4, "msaa4"),
    (Antialias::Supersample(2), "ssaa2"),
    (Antialias::Supersample(4), "ssaa4"),
];

const KINDS: [Effects; 3] = [Effects::ALWAYS, Effects::USUAL, Effects::PLANNED];

/// Processor time of this thread in milliseconds.
fn thread_ms() -> f64 {
    let now = clock_gettime(ClockId::ThreadCPUTime);
    now.tv_sec as f64 * 1e3 + now.tv_nsec as f64 / 1e6
}

/// One scene by one rasterizer.
struct Row {
    name: String,
    drawer: Drawer,
    scene: Scene,
    target: Target,
}

/// Medians over the rounds.
struct Times {
    /// Of everything-on, usual and planned.
    ms: [f64; 3],
    /// Planned over everything-on, and over usual.
    shares: [f64; 2],
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

impl Row {
    fn time(&mut self, rounds: usize) -> Times {
        let mut ms = [(); 3].map(|()| Vec::new());
        for round in 0..rounds {
            for k in 0..3 {
                let kind = (k + round) % 3;
                let start = thread_ms();
                let frame = self.drawer.render(&self.scene, &KINDS[kind], &mut self.target);
                std::hint::black_box(frame.is_ok());
                ms[kind].push(thread_ms() - start);
            }
        }
        let share = |kind: usize| {
            let rounds = ms[2].iter().zip(&ms[kind]);
            median(rounds.map(|(planned, other)| planned / other).collect())
        };
        Times { shares: [share(0), share(1)], ms: ms.map(median) }
    }

    /// Measures, prints, and says whether planned is as fast as promised.
    fn measure(&mut self, rounds: usize) -> bool {
        let mut draw = |effects: &Effects| {
            let frame = self.drawer.render(&self.scene, effects, &mut self.target);
            frame.expect("it draws").picture
        };
        let [all, usual, planned] = [&KINDS[0], &KINDS[1], &KINDS[2]].map(&mut draw);
        assert!(all == usual && all == planned, "{}: another picture", self.name);
        let mut times = self.time(FEW);
        if times.shares[0] > AHEAD {
            times = self.time(rounds);
        }
        for more in [3, 9] {
            if times.shares[0] <= MOST {
                break;
            }
            times = self.time(rounds * more);
        }
        let Times { ms: [all, usual, planned], shares } = times;
        println!(
            "{:<34} {all:>8.2} {usual:>8.2} {planned:>8.2} {:>7.2} {:>7.2}",
            self.name,
            1.0 / shares[0],
            1.0 / shares[1]
        );
        shares[0] <= MOST
    }
}

/// Every scene, antialiasing and rasterizer.
fn rows(wanted: &str) -> impl Iterator<Item = Row> {
    let chapters = SCENES.iter().map(|entry| {
        let scene = scene(entry.name, 4.0 / 3.0, 0.0).expect("a scene of the catalogue");
        (scene, (640, 480))
    });
    let meshes = meshes::NAMES
        .iter()
        .map(|name| (meshes::scene(name).expect("a mesh of the catalogue"), (512, 512)));
    let scenes: Vec<_> = chapters.chain(meshes).collect();
    let wanted = wanted.to_owned();
    scenes.into_iter().flat_map(move |(scene, (width, height))| {
        let wanted = wanted.clone();
        SMOOTHINGS.into_iter().flat_map(|kind| Drawer::ALL.map(|drawer| (kind, drawer))).filter_map(
            move |((antialias, word), drawer)| {
                let name = format!("{} {word} {}", scene.name, drawer.name());
                let target = Target::new(width, height, antialias, DepthFormat::Unorm32);
                name.contains(&wanted).then(|| Row {
                    name,
                    drawer,
                    scene: scene.clone(),
                    target: target.expect("a usual size"),
                })
            },
        )
    })
}

/// Random scenes one after the other as one row.
fn random_scenes(antialias: Antialias, word: &str, drawer: Drawer, rounds: usize) -> bool {
    const SEEDS: [u64; 2] = [7, 1234];
    const EACH: u64 = 60;
    let mut target = Target::new(320, 240, antialias, DepthFormat::Unorm32).expect("a usual size");
    let (mut sums, mut worst) = ([0.0; 3], (0.0, 0, 0));
    let scenes = SEEDS.into_iter().flat_map(|seed| (0..EACH).map(move |index| (seed, index)));
    for (seed, index) in scenes {
        let scene = random::scene(seed, index);
        let mut row = Row { name: String::new(), drawer, scene, target };
        let mut times = row.time(FEW);
        if times.shares[0] > AHEAD {
            times = row.time(rounds);
        }
        if times.shares[0] > MOST {
            times = row.time(rounds * 9);
        }
        target = row.target;
        worst = if times.shares[0] > worst.0 { (times.shares[0], index, seed) } else { worst };
        for (sum, ms) in sums.iter_mut().zip(times.ms) {
            *sum += ms;
        }
    }
    let [all, usual, planned] = sums;
    println!(
        "{:<34} {all:>8.2} {usual:>8.2} {planned:>8.2} {:>7.2} {:>7.2}   least {:.2}, scene {} of seed {}",
        format!("{} random {word} {}", SEEDS.len() as u64 * EACH, drawer.name()),
        all / planned,
        usual / planned,
        1.0 / worst.0,
        worst.1,
        worst.2
    );
    worst.0 <= MOST
}

fn main() -> ExitCode {
    // Cargo adds --bench.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let rounds = if words.iter().any(|word| word == "--quick") { 3 } else { 11 };
    let wanted = words.iter().find(|word| !word.starts_with("--")).map_or("", String::as_str);
    println!(
        "milliseconds of processor time, medians; planned is so many times as fast as all | usual"
    );
    println!(
        "{:<34} {:>8} {:>8} {:>8} {:>7} {:>7}",
        "scene", "all", "usual", "planned", "all", "usual"
    );
    let mut slower = Vec::new();
    for mut row in rows(wanted) {
        if !row.measure(rounds) {
            slower.push(row.name);
        }
    }
    if "random".contains(wanted) {
        for ((antialias, word), drawer) in
            SMOOTHINGS.into_iter().flat_map(|kind| Drawer::ALL.map(|drawer| (kind, drawer)))
        {
            if !random_scenes(antialias, word, drawer, rounds) {
                slower.push(format!("random {word} {}", drawer.name()));
            }
        }
    }
    if slower.is_empty() {
        println!("planned is never slower than everything-on by more than 3%");
        return ExitCode::SUCCESS;
    }
    println!("SLOWER than everything-on by more than 3%, planned: {}", slower.join("; "));
    ExitCode::FAILURE
}
