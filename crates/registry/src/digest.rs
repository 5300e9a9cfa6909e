//! Digests: everything that the engines compute for a seed, as SHA-256, to be compared between
//! machines.
//!
//! A digest is over bits: hit counts, pixels and numbers as f64, lowest byte first. Which NaN a machine
//! returns for 0/0 is its own affair (its sign differs between x86 and the others), so all are one.
//! Every case has a hash of its own, and these are joined in the order of the cases, so the number of
//! threads leaves no trace.

use serde::Serialize;
use sha2::{Digest as _, Sha256};

use crate::engines::{Drawer, Engine, ExactEngine, LineEngine};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize, RasterizeExact};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_core::triangle::{Fragment, Varying};
use rasterproof_render::effects::plan::Canvas;
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::{Scene, chapters, random};
use rasterproof_verify::cases::{self, Case, Family, Shape, unsnapped};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct DigestOptions {
    pub seed: u64,
    /// Cases of each family, and random scenes.
    pub cases: u64,
}

/// The digest of one kind of result of one engine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct DigestRow {
    pub engine: &'static str,
    /// What: coverage, values, lines, frames.
    pub what: &'static str,
    /// In hexadecimal.
    pub sha256: String,
}

/// A kind of result of an engine, which has a digest of its own.
#[derive(Clone, Copy)]
enum Job {
    /// Hit counts of triangles.
    Coverage(Engine),
    /// Depths and attributes of triangles.
    Values(Engine),
    /// Pixels of lines with their values.
    Lines(LineEngine),
    /// Hit counts of triangles off the lattice, and how they were decided.
    OffGrid(ExactEngine),
    /// Plans, pictures and samples of scenes.
    Frames(Drawer),
}

/// The engines of each kind that are digested: the judged ones, and the oracle.
const ENGINES: [Engine; 3] = [Engine::Scanline, Engine::EdgeFunction, Engine::Oracle];
const LINE_ENGINES: [LineEngine; 3] = [LineEngine::Dda, LineEngine::Bresenham, LineEngine::Oracle];
const EXACT_ENGINES: [ExactEngine; 3] =
    [ExactEngine::Scanline, ExactEngine::EdgeFunction, ExactEngine::Oracle];

/// The families whose cases are drawn each for itself: a change of a design does not change the digest.
fn drawn(families: &'static [Family]) -> impl Iterator<Item = &'static Family> {
    families.iter().filter(|family| family.design().is_none())
}

/// Everything that is digested, in the order of the table.
fn jobs() -> Vec<Job> {
    let mut jobs = Vec::new();
    jobs.extend(ENGINES.iter().flat_map(|&e| [Job::Coverage(e), Job::Values(e)]));
    jobs.extend(LINE_ENGINES.map_array(Job::Lines));
    jobs.extend(EXACT_ENGINES.map_array(Job::OffGrid));
    jobs.extend(Drawer::ALL.map_array(Job::Frames));
    jobs
}

impl Job {
    /// The name of the engine, and what is digested of it.
    fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Coverage(engine) => (engine.name(), "coverage"),
            Self::Values(engine) => (engine.name(), "values"),
            Self::Lines(engine) => (engine.name(), "lines"),
            Self::OffGrid(engine) => (engine.name(), "coverage"),
            Self::Frames(drawer) => (drawer.name(), "frames"),
        }
    }

    /// How many hashes there are: one for each case of each family, or for each scene.
    fn count(self, cases: u64) -> u64 {
        let families = match self {
            Self::Coverage(_) | Self::Values(_) => drawn(cases::triangles::FAMILIES).count(),
            Self::Lines(_) => drawn(cases::lines::FAMILIES).count(),
            Self::OffGrid(_) => unsnapped::FAMILIES.len(),
            Self::Frames(_) => return chapters::SCENES.len() as u64 + cases,
        };
        families as u64 * cases
    }

    /// The hash of one case; the index counts through the families, then through the cases of each.
    fn hash(self, DigestOptions { seed, cases }: DigestOptions, index: u64) -> [u8; 32] {
        // A hash of its own for each case, so that cases can be computed in any order.
        let mut hash = Hash(Sha256::new());
        let of = |families: &'static [Family]| {
            let family = drawn(families).nth((index / cases) as usize);
            family.expect("as many as are counted").case(seed, index % cases)
        };
        match self {
            Self::Coverage(engine) => coverage(engine, &of(cases::triangles::FAMILIES), &mut hash),
            Self::Values(engine) => values(engine, &of(cases::triangles::FAMILIES), &mut hash),
            Self::Lines(engine) => lines(engine, &of(cases::lines::FAMILIES), &mut hash),
            Self::OffGrid(engine) => off_grid(engine, &of(unsnapped::FAMILIES), &mut hash),
            Self::Frames(drawer) => {
                // The scenes of the book come first, then random ones.
                let scenes = chapters::SCENES.len() as u64;
                let scene = match chapters::SCENES.get(index as usize) {
                    // A turn that no angle makes simple.
                    Some(entry) => chapters::scene(entry.name, 4.0 / 3.0, 0.37),
                    None => Some(random::scene(seed, index - scenes)),
                };
                if let Some(scene) = scene {
                    frames(drawer, &scene, index, &mut hash);
                }
            }
        }
        hash.0.finalize().into()
    }
}

/// The names of all engines that have a digest, in alphabetical order.
pub fn engines() -> Vec<&'static str> {
    let mut names: Vec<_> = jobs().into_iter().map(|job| job.names().0).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// The digests of all engines, or of one. `progress` is told how many more cases are done.
#[must_use]
pub fn digest(
    options: DigestOptions,
    engine: Option<&str>,
    progress: &(dyn Fn(u64) + Sync),
) -> Vec<DigestRow> {
    let mut rows = Vec::new();
    for job in jobs_of(engine) {
        let hashes = parallel::map(job.count(options.cases) as usize, |index| {
            let hash = job.hash(options, index as u64);
            progress(1);
            hash
        });
        let (engine, what) = job.names();
        rows.push(DigestRow { engine, what, sha256: hex(&Sha256::digest(hashes.concat())) });
    }
    rows
}

/// The jobs of one engine, or of all.
fn jobs_of(engine: Option<&str>) -> Vec<Job> {
    let mut jobs = jobs();
    jobs.retain(|job| engine.is_none_or(|name| job.names().0 == name));
    jobs
}

/// How many cases [`digest`] goes through.
pub fn case_count(options: DigestOptions, engine: Option<&str>) -> u64 {
    jobs_of(engine).into_iter().map(|job| job.count(options.cases)).sum()
}

/// The digest of all rows with their names, in their order.
pub fn total(parts: &[DigestRow]) -> String {
    let mut all = Sha256::new();
    for DigestRow { engine, what, sha256 } in parts {
        all.update(format!("{engine} {what} {sha256}\n"));
    }
    hex(&all.finalize())
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Takes numbers, lowest byte first.
struct Hash(Sha256);

impl Hash {
    fn whole(&mut self, number: u64) {
        self.0.update(number.to_le_bytes());
    }

    fn pixel(&mut self, x_px: i32, y_px: i32) {
        self.0.update(x_px.to_le_bytes());
        self.0.update(y_px.to_le_bytes());
    }

    /// A float by its bits, all NaNs alike.
    fn number(&mut self, value: f64) {
        self.whole(canonical(value));
    }

    fn fragment<const N: usize>(&mut self, fragment: &Fragment<impl Varying>, values: [f64; N]) {
        self.pixel(fragment.x_px, fragment.y_px);
        self.number(fragment.depth);
        for value in values {
            self.number(value);
        }
    }

    /// The hits of all pixels, row by row.
    fn coverage(&mut self, hits: &Coverage) {
        for (y_px, row) in hits.rows() {
            self.pixel(hits.bounds().x0, y_px);
            for &count in row {
                self.whole(u64::from(count));
            }
        }
    }
}

/// The bits of a number, the same for every NaN.
fn canonical(value: f64) -> u64 {
    if value.is_nan() { 0x7ff8 << 48 } else { value.to_bits() }
}

/// Hashes how often each pixel is hit by all triangles of a case together.
fn coverage(engine: Engine, case: &Case, hash: &mut Hash) {
    let Shape::Triangles { list, .. } = &case.shape else { return };
    let mut hits = Coverage::new(case.window, 0);
    for triangle in list {
        let corners = triangle.corners();
        engine.cover(corners, case.window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
    }
    hash.coverage(&hits);
}

/// Hashes depths and attributes of a case.
fn values(engine: Engine, case: &Case, hash: &mut Hash) {
    let Shape::Triangles { list, .. } = &case.shape else { return };
    // The oracle divides big integers at each pixel: a few rows stand for all.
    let window = match engine {
        Engine::Oracle => PixelRect { y1: case.window.y1.min(case.window.y0 + 4), ..case.window },
        _ => case.window,
    };
    for triangle in list {
        engine.fragments(triangle, window, |f| hash.fragment(&f, f.varying.to_array()));
    }
}

/// Hashes the fragments of lines, with a mark after each line.
fn lines(engine: LineEngine, case: &Case, hash: &mut Hash) {
    let Shape::Lines(list) = &case.shape else { return };
    for line in list {
        engine.draw(line, case.window, |f| hash.fragment(&f, f.varying.to_array()));
        hash.whole(u64::MAX);
    }
}

/// Hashes how triangles off the lattice were decided, and their hits.
fn off_grid(engine: ExactEngine, case: &Case, hash: &mut Hash) {
    let mut hits = Coverage::new(case.window, 0);
    for corners in case.free_corners() {
        let decisions = engine.cover_exact(corners, case.window, |s| {
            hits.hit(s.y_px, s.x0_px, s.x1_px);
        });
        hash.whole(decisions.by_filter);
        hash.whole(decisions.by_fallback);
    }
    hash.coverage(&hits);
}

/// A scene planned, and with every depth of every sample.
fn frames(drawer: Drawer, scene: &Scene, index: u64, hash: &mut Hash) {
    // With every depth and every sample, so that nothing is left out that could differ.
    let complete =
        Effects::PLANNED.with(Effect::Depth, Mode::Always).with(Effect::Samples, Mode::Always);
    let antialias = [Antialias::None, Antialias::Multisample4, Antialias::Supersample(2)];
    // Each scene has another format of depth, in turn.
    let depth = DepthFormat::ALL[index as usize % DepthFormat::ALL.len()];
    for antialias in antialias {
        let Ok(mut target) = Target::new(64, 48, antialias, depth) else { continue };
        // The plan is part of the digest, so that another plan shows even where it leads to the same picture.
        let Ok(plan) = drawer.plan(scene, &Effects::PLANNED, &Canvas::of(&target)) else {
            hash.whole(u64::MAX);
            continue;
        };
        hash.0.update(serde_json::to_string(&plan).unwrap_or_default());
        for effects in [Effects::PLANNED, complete] {
            // The picture as planned, and as it is with all samples and depths.
            let Ok(rendered) = drawer.render(scene, &effects, &mut target) else { continue };
            for (_, row) in rendered.picture.rows() {
                hash.0.update(row.as_flattened());
            }
        }
        // Colours and depths of every sample, as the last frame has left them.
        for plane in &target.planes {
            for ((_, colours), (_, keys)) in plane.colour.rows().zip(plane.depth.rows()) {
                hash.0.update(colours.as_flattened());
                for &key in keys {
                    hash.whole(key);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FEW: DigestOptions = DigestOptions { seed: 1, cases: 2 };

    #[test]
    fn every_nan_is_one_and_zeros_are_two() {
        let nans = [f64::NAN, -f64::NAN, f64::from_bits(0x7ff0_0000_0000_0001)];
        assert!(nans.iter().all(|&nan| canonical(nan) == 0x7ff8_0000_0000_0000));
        assert_ne!(canonical(0.0), canonical(-0.0));
    }

    #[test]
    fn threads_leave_no_trace() {
        let all = digest(FEW, Some("scanline"), &|_| ());
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert_eq!(one.install(|| digest(FEW, Some("scanline"), &|_| ())), all);
        assert_eq!(all.len(), 3);
    }

    /// Another seed is another digest, and so is a last bit of a value.
    #[test]
    fn a_last_bit_shows() {
        let other = digest(DigestOptions { seed: 2, ..FEW }, Some("dda"), &|_| ());
        assert_ne!(other, digest(FEW, Some("dda"), &|_| ()));
        let case = cases::triangles::FAMILIES[0].case(1, 0);
        let hash = |case: &Case| {
            let mut hash = Hash(Sha256::new());
            values(Engine::Scanline, case, &mut hash);
            hash.0.finalize()
        };
        let mut moved = case.clone();
        let Shape::Triangles { list, .. } = &mut moved.shape else { panic!("triangles") };
        for vertex in &mut list[0].vertices {
            vertex.depth = vertex.depth.next_up();
        }
        assert_ne!(hash(&case), hash(&moved));
    }
}
