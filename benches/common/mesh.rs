//! Whole frames of a mesh: who draws them, in which time, and with how many wrong pixels.
//!
//! Ours is everything from the mesh to the picture, which is drawn over the one before. A device has its
//! vertices, indices, texture and commands before; submitting and waiting are timed, its picture stays
//! where it is.

use std::process::{Command, ExitCode};
use std::time::Instant;

use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::Scene;
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::frames::{self, Samples};

/// Where devices draw too, llvmpipe has one thread, the caller's, unless `LP_NUM_THREADS` says otherwise.
/// It reads that when it is loaded, so the bench is started again with it.
pub fn one_thread_each(bench: impl FnOnce()) -> ExitCode {
    const THREADS: &str = "LP_NUM_THREADS";
    if cfg!(not(feature = "vulkan")) || std::env::var_os(THREADS).is_some() {
        bench();
        return ExitCode::SUCCESS;
    }
    let again = std::env::current_exe().and_then(|program| {
        Command::new(program).args(std::env::args_os().skip(1)).env(THREADS, "0").status()
    });
    match again {
        Ok(status) if status.success() => ExitCode::SUCCESS,
        Ok(status) => {
            eprintln!("the bench with {THREADS}=0: {status}");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("cannot start the bench with {THREADS}=0: {error}; set it before");
            ExitCode::FAILURE
        }
    }
}

type Draw<'a> = dyn FnMut(&mut Frame<Colour>) + 'a;

/// Somebody who draws a frame.
pub struct Draws<'a> {
    pub name: String,
    /// This is timed.
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

/// Without the feature there are none.
#[cfg(not(feature = "vulkan"))]
pub fn devices(_: &Scene, _: u32, _: Samples) -> Vec<Draws<'static>> {
    Vec::new()
}

#[cfg(feature = "vulkan")]
pub fn devices(scene: &Scene, side_px: u32, samples: Samples) -> Vec<Draws<'static>> {
    use rasterproof_vulkan::device::find;
    use rasterproof_vulkan::gpu::mesh::Filmed;

    let all = find::list().unwrap_or_else(|error| {
        eprintln!("{error}");
        Vec::new()
    });
    let device = |listed: &find::Listed| {
        let mut filmed = Filmed::new(listed, scene, side_px, samples).expect("a device that draws");
        let picture = filmed.picture().expect("a device that draws");
        let draw = move |_: &mut Frame<Colour>| filmed.draw().expect("a device that draws");
        Draws { name: listed.about.short(), draw: Box::new(draw), picture }
    };
    all.iter().map(device).collect()
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
