//! Whole frames of a mesh of 70,000 triangles, textured, lit and depth-tested, with one sample a pixel
//! and with four: by the tiles, by the scanline and by Vulkan devices.
//!
//! Ours is everything from the mesh to the picture. A device has its vertices, indices, texture and
//! commands before; submitting and waiting are timed, its picture stays where it is.

use std::time::Instant;

use rasterproof::effects::Effects;
use rasterproof::frame::Frame;
use rasterproof::lineup::Drawer;
use rasterproof::pipeline::target::{Antialias, Colour, Target};
use rasterproof::scene::{Scene, meshes};
use rasterproof::tiled::{self, Samples};
#[cfg(feature = "vulkan")]
use rasterproof_vulkan::{device::find, gpu::mesh::Filmed};

use crate::common::SIDE_PX;

const MESH: &str = "bumps-70000";

/// Somebody who draws a frame, and shows it.
pub trait Draw {
    /// Draws a frame: this is timed.
    fn draw(&mut self);
    /// Draws a frame and shows it.
    fn picture(&mut self) -> Frame<Colour>;
}

impl<F: FnMut() -> Frame<Colour>> Draw for F {
    fn draw(&mut self) {
        std::hint::black_box(self());
    }

    fn picture(&mut self) -> Frame<Colour> {
        self()
    }
}

/// Measures the mesh and prints its rows.
pub fn report(rounds: usize) {
    let scene = meshes::scene(MESH).expect("a mesh of the catalogue");
    println!();
    println!(
        "{MESH}, {} triangles, textured, lit and depth-tested; medians of {rounds} interleaved rounds",
        scene.triangles()
    );
    println!(
        "{:<9}{:<14}{:>9}{:>13}{:>11}{:>8}",
        "samples", "drawn by", "ms", "x scanline", "uncovered", "other"
    );
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    for samples in [Samples::One, Samples::Four] {
        let mut draws: Vec<(String, Box<dyn Draw + '_>)> = vec![
            ("scanline".to_owned(), Box::new(scanline(&scene, samples))),
            ("tiles".to_owned(), Box::new(|| one.install(|| tiles(&scene, samples)))),
        ];
        #[cfg(feature = "vulkan")]
        draws.extend(devices(&scene, samples));
        rows(&scene, samples, &mut draws, rounds);
    }
    println!();
    println!(
        "uncovered: background in one picture and not in the scanline's; other: off by more than two"
    );
    println!("of 255 steps in a channel, another texel or another surface");
}

fn rows(
    scene: &Scene,
    samples: Samples,
    draws: &mut [(String, Box<dyn Draw + '_>)],
    rounds: usize,
) {
    let pictures: Vec<_> = draws.iter_mut().map(|(_, draw)| draw.picture()).collect();
    let mut times = vec![Vec::new(); draws.len()];
    for _ in 0..rounds {
        for ((_, draw), times) in draws.iter_mut().zip(&mut times) {
            let start = Instant::now();
            draw.draw();
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let ms: Vec<f64> = times.iter_mut().map(median).collect();
    for (i, (name, _)) in draws.iter().enumerate() {
        let number = match (i, samples) {
            (0, Samples::One) => "1",
            (0, Samples::Four) => "4",
            _ => "",
        };
        let [uncovered, other] = wrong(&pictures[i], &pictures[0], scene.background);
        let (ms, factor) = (ms[i], ms[0] / ms[i]);
        println!("{number:<9}{name:<14}{ms:>9.2}{factor:>13.2}{uncovered:>11}{other:>8}");
    }
}

fn scanline(scene: &Scene, samples: Samples) -> impl FnMut() -> Frame<Colour> {
    let antialias = match samples {
        Samples::One => Antialias::None,
        Samples::Four => Antialias::Multisample4,
    };
    let mut target =
        Target::new(SIDE_PX, SIDE_PX, antialias, Default::default()).expect("a usual size");
    move || {
        let frame = Drawer::Scanline.render(scene, &Effects::PLANNED, &mut target);
        frame.expect("it draws").picture
    }
}

fn tiles(scene: &Scene, samples: Samples) -> Frame<Colour> {
    tiled::render(scene, SIDE_PX, SIDE_PX, samples).expect("it draws")
}

#[cfg(feature = "vulkan")]
impl Draw for Filmed {
    fn draw(&mut self) {
        Self::draw(self).expect("a device that draws");
    }

    fn picture(&mut self) -> Frame<Colour> {
        Self::picture(self).expect("a device that draws")
    }
}

/// Every device that is there; where there is none, it says so.
#[cfg(feature = "vulkan")]
fn devices(scene: &Scene, samples: Samples) -> Vec<(String, Box<dyn Draw>)> {
    let all = find::list().unwrap_or_else(|error| {
        eprintln!("{error}");
        Vec::new()
    });
    let device = |listed: &find::Listed| {
        let filmed = Filmed::new(listed, scene, SIDE_PX, samples).expect("a device that draws");
        (listed.about.short(), Box::new(filmed) as Box<dyn Draw>)
    };
    all.iter().map(device).collect()
}

/// Pixels that are background in one picture alone, and others of another colour.
fn wrong(picture: &Frame<Colour>, truth: &Frame<Colour>, background: Colour) -> [u64; 2] {
    let (mut uncovered, mut other) = (0, 0);
    for ((_, row), (_, truth)) in picture.rows().zip(truth.rows()) {
        for (a, b) in row.iter().zip(truth) {
            let far = (0..3).any(|i| a[i].abs_diff(b[i]) > 2);
            if (*a == background) != (*b == background) {
                uncovered += 1;
            } else if far {
                other += 1;
            }
        }
    }
    [uncovered, other]
}
