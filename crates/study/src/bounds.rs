//! How much of a scene is too much for a command, found before anything is drawn.

use rasterproof_core::grid::PixelRect;
use rasterproof_host::limits;
use rasterproof_render::pipeline::target::Antialias;
use rasterproof_render::scene::Scene;
use rasterproof_report::words::thousands;

use crate::work::Work;

/// What a command does with a scene, by which it is decided how much of one is too much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// It is drawn by one rasterizer.
    Drawn,
    /// It is drawn by two, and their frames are compared.
    Compared,
    /// It is drawn many times, by different plans.
    Planned,
    /// Each of its triangles is judged.
    Judged,
    /// Each of its triangles is drawn by every choice of arithmetic, and it is drawn by every planner.
    Measured,
}

/// What a scene takes, each number measured on models that are little else: rows of needles, layers of large squares, and
/// frames of 4 million samples with one triangle.
struct Costs {
    /// What is held of a sample of the frame at the same time.
    bytes_of_sample: u64,
    /// Time for each row of each triangle, and for each sample of each triangle, hidden or not.
    ns_of_row: u64,
    ns_of_sample: u64,
    /// Time that a model may take for each byte of its file: of one that is not made to be slow a byte takes less.
    ns_of_byte: u64,
}

/// What a texel of a shadow map takes.
const MAP_TEXEL_BYTES: u64 = 8;

/// A picture may be covered so often whatever its size, as a model covers it from most sides.
const MOST_LAYERS: u64 = 16;

/// Samples that wait to be mixed in the order of their depths, each of which takes 48 bytes while they are sorted.
const MOST_LAYER_SAMPLES: u64 = 1 << 24;

/// By how much less a row and a texel of a shadow map take than those of the frame.
const OF_MAP: u64 = 10;

/// The time that a small file may take.
const MOST_NS: u64 = 16_000_000_000;

impl Purpose {
    /// Drawing once and drawing twice take the same time for each sample that is hidden, since the second frame is drawn beside
    /// the first one; whoever judges or measures computes each row of each triangle in several arithmetics.
    fn costs(self) -> Costs {
        let (bytes_of_sample, ns_of_row, ns_of_sample, ns_of_byte) = match self {
            Self::Drawn => (20, 700, 90, 1_500),
            Self::Compared => (40, 700, 90, 1_500),
            Self::Planned => (40, 2_500, 350, 1_500),
            Self::Judged => (40, 7_000, 80, 1_500),
            Self::Measured => (120, 24_000, 700, 10_000),
        };
        Costs { bytes_of_sample, ns_of_row, ns_of_sample, ns_of_byte }
    }

    /// Triangles of a file of so many bytes: each of those that are judged takes a kilobyte, so what a few bytes of a file
    /// ask for is bounded, while of a large file all are judged that it holds without compression.
    fn most_triangles(self, file_bytes: u64) -> u64 {
        match self {
            Self::Drawn | Self::Compared | Self::Planned => u64::MAX,
            Self::Judged | Self::Measured => (file_bytes / 8).max(1 << 20),
        }
    }
}

/// What the memory of a frame depends on.
#[derive(Clone, Copy, Debug)]
pub struct FrameSize {
    /// Its width and its height, without the samples within a pixel.
    pub px: (u32, u32),
    pub antialias: Antialias,
    /// Texels on a side of the shadow map.
    pub shadows: Option<u32>,
}

impl FrameSize {
    /// Refuses sizes of which the frames, with what is computed beside them, take too much memory.
    pub fn refuse_large_frames(&self, purpose: Purpose) -> Result<(), String> {
        let (width, height) = self.px;
        // Sides are limited by the command line, so no product here exceeds 64 bits.
        let samples = u64::from(width) * u64::from(height) * self.antialias.samples();
        let map =
            self.shadows.map_or(0, |size| u64::from(size) * u64::from(size) * MAP_TEXEL_BYTES);
        let bytes = samples * purpose.costs().bytes_of_sample + map;
        if bytes <= limits::FRAME_BYTES {
            return Ok(());
        }
        let [bytes, most] = [bytes, limits::FRAME_BYTES].map(|bytes| bytes >> 20);
        let or = match purpose {
            Purpose::Compared => ", or draw by one rasterizer (--engine scanline)",
            _ => "",
        };
        Err(format!(
            "{width} x {height} px with {samples} samples take about {bytes} MiB here, and the most are {most}: give a \
             smaller --size{or}"
        ))
    }

    /// Refuses a scene that takes too long to draw, or whose pieces or layers take too much memory.
    pub fn refuse_too_much(
        &self,
        name: &str,
        scene: &Scene,
        file_bytes: u64,
        purpose: Purpose,
    ) -> Result<(), String> {
        self.refuse_large_frames(purpose)?;
        let (width, height) = self.px;
        let scale = self.antialias.scale();
        let planes = self.antialias.planes() as u64;
        // The work is found for a window whose pixels are the samples of one plane; multisampling has several such planes.
        let work = Work::of(scene, PixelRect::window(width * scale, height * scale));
        let all = u64::from(width) * u64::from(height) * self.antialias.samples();
        let of_planes = |count: u64| count.saturating_mul(planes);
        let (rows, samples) = (of_planes(work.rows), of_planes(work.samples));
        let blended = of_planes(work.blended);
        let Costs { ns_of_row, ns_of_sample, ns_of_byte, .. } = purpose.costs();
        // The map is drawn as often as the frame.
        let map = Work::of_map(scene);
        let mut ns: u64 = 0;
        for (count, ns_of_one) in [
            (rows, ns_of_row),
            (samples, ns_of_sample),
            (map.rows, ns_of_row / OF_MAP),
            (map.samples, ns_of_sample / OF_MAP),
        ] {
            ns = ns.saturating_add(count.saturating_mul(ns_of_one));
        }
        // A large file may take longer, and so may a large picture that is covered as usual.
        let of_picture = (all * MOST_LAYERS).saturating_mul(ns_of_sample);
        let most = MOST_NS.max(file_bytes.saturating_mul(ns_of_byte)).max(of_picture);
        if ns > most {
            let [seconds, most] = [ns, most].map(|ns| thousands(ns / 1_000_000_000));
            let (of_map, smaller) = match self.shadows {
                None => (String::new(), "a smaller --size"),
                Some(_) => {
                    let texels = thousands(map.samples);
                    (format!(" and {texels} texels in the shadow map"), "smaller --shadows")
                }
            };
            return Err(format!(
                "{name}: its {} triangles in the window have about {} samples in {} rows{of_map}, hidden ones counted, which would \
                 take about {seconds} s here, and the most are {most} s: give {smaller}, or a part of the model",
                thousands(work.triangles),
                thousands(samples),
                thousands(rows)
            ));
        }
        if scene.layers.is_some() && blended > MOST_LAYER_SAMPLES {
            return Err(format!(
                "{name}: --layers keeps all samples of what is not opaque until the frame is drawn, here about {}, and the most \
                 are {}: give a smaller --size, or leave out --layers",
                thousands(blended),
                thousands(MOST_LAYER_SAMPLES)
            ));
        }
        let most = purpose.most_triangles(file_bytes);
        let triangles = scene.triangles() as u64;
        if triangles > most {
            return Err(format!(
                "{name}: each triangle is judged, which takes memory: it has {}, and the most are {} of a file of {} bytes: \
                 export a part of the model",
                thousands(triangles),
                thousands(most),
                thousands(file_bytes)
            ));
        }
        Ok(())
    }
}
