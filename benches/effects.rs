//! The gate of the plan: planned is never slower than everything-on by more than 3%, in any scene of
//! the book, any mesh and any antialiasing, by either rasterizer. Beside both stands what any
//! sensible renderer does without a planner (`usual`).
//!
//! Slivers (combs, blinds, hair, grass) are where a plan can lose most: their boxes are large and nearly
//! all of their pixels lie at a border. There planned must also not be slower than `usual` by more than
//! 5%.
//!
//! Ends with an error where a row loses. A frame is timed by the processor time of its own thread, so
//! that a busy machine does not count as work; frames of the three kinds alternate, each round begins
//! with another one, and a row compares medians of the rounds' ratios. Three rounds are enough where
//! planned is far ahead; a row that seems to lose is measured again, with more rounds, before it counts.
//!
//! `cargo bench -p benches --bench effects` measures all rows, `-- facets` those whose name contains a word,
//! `-- --quick` with fewer rounds. Each pair of pictures is compared to the bit before it is timed.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

use std::process::ExitCode;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rasterproof_core::random::Rng;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::pipeline::transform::{look_at, perspective};
use rasterproof_render::scene::chapters::{SCENES, scene};
use rasterproof_render::scene::{
    Corner, Item, Material, Mesh, Scene, Shading, meshes, random, shapes,
};
use rustix::time::{ClockId, clock_gettime};

/// Planned may take so many times as long as everything-on.
const MOST: f64 = 1.03;

/// Planned may take so many times as long as usual in scenes of slivers.
const MOST_OF_USUAL: f64 = 1.05;

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

struct Row {
    name: String,
    drawer: Drawer,
    scene: Scene,
    target: Target,
    /// Planned may take so many times as long as everything-on, and as usual.
    most: [f64; 2],
}

/// Whether planned takes longer than it may.
fn is_slow(shares: [f64; 2], most: [f64; 2]) -> bool {
    shares[0] > most[0] || shares[1] > most[1]
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
        if times.shares[0] > AHEAD || is_slow(times.shares, self.most) {
            times = self.time(rounds);
        }
        for more in [3, 9] {
            if !is_slow(times.shares, self.most) {
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
        !is_slow(shares, self.most)
    }
}

#[derive(Clone, Copy)]
enum Slivers {
    Comb,
    Blinds,
    Hair,
    Grass,
}

const SLIVERS: [(Slivers, &str); 4] = [
    (Slivers::Comb, "comb"),
    (Slivers::Blinds, "blinds"),
    (Slivers::Hair, "hair"),
    (Slivers::Grass, "grass"),
];

/// Many triangles that are long and thin, lit, in a cube around the origin: some flat, some with colours
/// that differ between the corners.
fn slivers(kind: Slivers, count: u32, width: f64, varies: bool, rng: &mut Rng) -> Scene {
    let mut mesh = Mesh::default();
    for i in 0..count {
        let at = -1.0 + 2.0 * f64::from(i) / f64::from(count);
        let corners = match kind {
            Slivers::Comb => [
                DVec3::new(at, 1.0, 0.0),
                DVec3::new(at + width, 1.0, 0.0),
                DVec3::new(at + 1.7 * width, -1.0, 0.2),
            ],
            Slivers::Blinds => [
                DVec3::new(-1.0, at, 0.0),
                DVec3::new(-1.0, at + width, 0.0),
                DVec3::new(1.0, at + width, 0.2),
            ],
            Slivers::Hair => {
                let mut point = || DVec3::new(rng.signed(), rng.signed(), rng.signed());
                let root = point().normalize_or(DVec3::X) * 0.5;
                let side = point() * width;
                [root, root + side, root * 2.0 + point() * 0.2]
            }
            Slivers::Grass => {
                let (x, z) = (rng.signed(), rng.signed());
                let root = DVec3::new(x, -1.0, z);
                let lean = DVec3::new(rng.signed() * 0.3, 0.4 + rng.unit(), rng.signed() * 0.3);
                [root, root + DVec3::X * width, root + lean]
            }
        };
        let first = mesh.positions.len() as u32;
        Arc::make_mut(&mut mesh.positions).extend(corners);
        mesh.triangles.push([0, 1, 2].map(|k| Corner {
            position: first + k,
            colour: DVec3::new(if varies { f64::from(k) / 2.0 } else { 0.5 }, 0.8, 0.3),
            normal: DVec3::Y,
            uv: DVec2::ZERO,
        }));
    }
    slivers_scene(mesh)
}

fn slivers_scene(mesh: Mesh) -> Scene {
    let (eye, half) = (DVec3::new(0.0, 0.0, -4.2), 40f64.to_radians());
    let projection = perspective(half, 4.0 / 3.0, 2.0, 8.0).expect("a usual angle");
    let mut scene = Scene::new("slivers", "", projection);
    scene.view = look_at(eye, DVec3::ZERO, DVec3::Y).expect("an eye in front of it");
    let towards = DVec3::new(-0.4, 0.7, -0.6).normalize();
    scene.light = Light { towards, ambient: 0.25, diffuse: 0.75 };
    let material = Material { shading: Shading::Flat, vertex_colours: true, ..Material::default() };
    scene.items = vec![Item::new(mesh, material)];
    scene
}

/// The scenes of slivers: flat ones and such with colours that vary, few, many, and too many for their
/// boxes to be compared.
fn sliver_scenes() -> Vec<Scene> {
    let mut scenes = Vec::new();
    for (kind, name) in SLIVERS {
        for (count, width) in [(100, 0.012), (2000, 0.006), (2049, 0.006), (10_000, 0.006)] {
            for (varies, word) in [(false, "flat"), (true, "varying")] {
                let mut rng = Rng::new(name, 1, count.into());
                let mut scene = slivers(kind, count, width, varies, &mut rng);
                scene.name = format!("{name}-{count} {word}");
                scenes.push(scene);
            }
        }
    }
    scenes
}

/// Slivers at random: a kind, a number, a width, and what lies behind them.
fn random_slivers(seed: u64, index: u64) -> Scene {
    let mut rng = Rng::new("slivers", seed, index);
    let (kind, _) = SLIVERS[rng.int(0, 3) as usize];
    let count = [20, 100, 400, 1500, 2500, 6000][rng.int(0, 5) as usize];
    let width = 0.002 + 0.05 * rng.unit().powi(2);
    let varies = rng.chance(3);
    let mut scene = slivers(kind, count, width, varies, &mut rng);
    if rng.chance(3) {
        let wall = [(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)];
        let wall = shapes::quad(wall.map(|(x, y)| DVec3::new(x, y, 1.5)));
        scene.items.insert(0, Item::new(wall, Material::default()));
    }
    scene
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
    let slivers = sliver_scenes().into_iter().map(|scene| (scene, (640, 480)));
    let most = [[MOST, f64::MAX], [MOST, MOST_OF_USUAL]];
    let scenes = chapters.chain(meshes).map(move |scene| (scene, most[0]));
    let scenes: Vec<_> = scenes.chain(slivers.map(|scene| (scene, most[1]))).collect();
    let wanted = wanted.to_owned();
    scenes.into_iter().flat_map(move |((scene, (width, height)), most)| {
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
                    most,
                })
            },
        )
    })
}

struct Family {
    name: &'static str,
    scene: fn(u64, u64) -> Scene,
    most: [f64; 2],
}

const FAMILIES: [Family; 2] = [
    Family { name: "random", scene: random::scene, most: [MOST, f64::MAX] },
    Family { name: "random slivers", scene: random_slivers, most: [MOST, MOST_OF_USUAL] },
];

fn random_scenes(
    family: &Family,
    antialias: Antialias,
    word: &str,
    drawer: Drawer,
    rounds: usize,
) -> bool {
    const SEEDS: [u64; 2] = [7, 1234];
    const EACH: u64 = 60;
    let mut target = Target::new(320, 240, antialias, DepthFormat::Unorm32).expect("a usual size");
    let (mut sums, mut worst) = ([0.0; 3], [(0.0, 0, 0); 2]);
    let scenes = SEEDS.into_iter().flat_map(|seed| (0..EACH).map(move |index| (seed, index)));
    for (seed, index) in scenes {
        let (scene, most) = ((family.scene)(seed, index), family.most);
        let mut row = Row { name: String::new(), drawer, scene, target, most };
        let mut times = row.time(FEW);
        if times.shares[0] > AHEAD || is_slow(times.shares, most) {
            times = row.time(rounds);
        }
        if is_slow(times.shares, most) {
            times = row.time(rounds * 9);
        }
        target = row.target;
        for (worst, share) in worst.iter_mut().zip(times.shares) {
            *worst = if share > worst.0 { (share, index, seed) } else { *worst };
        }
        for (sum, ms) in sums.iter_mut().zip(times.ms) {
            *sum += ms;
        }
    }
    let [all, usual, planned] = sums;
    let least = worst
        .map(|(share, index, seed)| format!("{:.2} (scene {index} of seed {seed})", 1.0 / share));
    println!(
        "{:<34} {all:>8.2} {usual:>8.2} {planned:>8.2} {:>7.2} {:>7.2}   least {}",
        format!("{} {} {word} {}", SEEDS.len() as u64 * EACH, family.name, drawer.name()),
        all / planned,
        usual / planned,
        least.join(" | "),
    );
    !is_slow(worst.map(|(share, ..)| share), family.most)
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
    for family in FAMILIES.iter().filter(|family| family.name.contains(wanted)) {
        for ((antialias, word), drawer) in
            SMOOTHINGS.into_iter().flat_map(|kind| Drawer::ALL.map(|drawer| (kind, drawer)))
        {
            if !random_scenes(family, antialias, word, drawer, rounds) {
                slower.push(format!("{} {word} {}", family.name, drawer.name()));
            }
        }
    }
    if slower.is_empty() {
        println!(
            "planned is never slower than everything-on by more than 3%, nor, in scenes of slivers, \
             than usual by more than 5%"
        );
        return ExitCode::SUCCESS;
    }
    println!(
        "SLOWER than everything-on by more than 3%, or than usual by more than 5% in a scene of \
         slivers, planned: {}",
        slower.join("; ")
    );
    ExitCode::FAILURE
}
