//! Whole frames of a mesh: who draws them, in which time, and with how many wrong pixels.
//!
//! A frame is everything from the mesh to the picture, which is drawn over the one before.

use std::time::Instant;

use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::Scene;
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::frames::{self, Samples};

type Draw<'a> = dyn FnMut(&mut Frame<Colour>) + 'a;

pub struct Draws<'a> {
    pub name: String,
    draw: Box<Draw<'a>>,
    /// Kept from frame to frame.
    picture: Frame<Colour>,
}

impl<'a> Draws<'a> {
    pub fn new(name: &str, side_px: u32, draw: impl FnMut(&mut Frame<Colour>) + 'a) -> Self {
        let picture = Frame::new(PixelRect::window(side_px, side_px), [0; 4]);
        Self { name: name.to_owned(), draw: Box::new(draw), picture }
    }

    pub fn picture(&mut self) -> Frame<Colour> {
        (self.draw)(&mut self.picture);
        self.picture.clone()
    }
}

/// The planned scanline.
pub fn engine(scene: &Scene, side_px: u32, antialias: Antialias) -> impl FnMut(&mut Frame<Colour>) {
    let mut target =
        Target::new(side_px, side_px, antialias, Default::default()).expect("a usual size");
    move |picture| {
        let frame = Drawer::Scanline.render(scene, &Effects::PLANNED, &mut target);
        *picture = frame.expect("it draws").picture;
    }
}

pub fn tiles(
    scene: &Scene,
    pool: &rayon::ThreadPool,
    samples: Samples,
) -> impl FnMut(&mut Frame<Colour>) {
    let engine = Tiles::default();
    move |picture| {
        let draw = || frames::render_into(engine, scene, picture, samples);
        pool.install(draw).expect("it draws");
    }
}

/// Pixels that are background in one picture alone, and others of another colour.
pub fn wrong(picture: &Frame<Colour>, truth: &Frame<Colour>, background: Colour) -> [u64; 2] {
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

/// Frames of a turn that are not timed: after them caches, threads and clocks are as they are in the
/// middle of an animation, for everyone alike.
const WARM: usize = 3;

/// Medians of milliseconds of a frame, each the last of a turn.
pub fn times(all: &mut [Draws<'_>], rounds: usize) -> Vec<f64> {
    let mut times = vec![Vec::new(); all.len()];
    for _ in 0..rounds {
        for (draws, times) in all.iter_mut().zip(&mut times) {
            (0..WARM).for_each(|_| (draws.draw)(&mut draws.picture));
            let start = Instant::now();
            (draws.draw)(std::hint::black_box(&mut draws.picture));
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    times.iter_mut().map(median).collect()
}
