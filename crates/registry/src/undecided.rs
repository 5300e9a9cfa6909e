//! Depth ties: samples at which the bounds of two rasterizers leave open which surface is nearer.
//!
//! A depth is computed within a derived bound of the exact one ([`rasterproof_verify::comparison::tolerance`]). Where the
//! intervals of two surfaces meet, in the format that stores them, one right rasterizer may show the
//! one and another right one the other. Such a sample is undecided by either. A difference there is
//! excused only if each of the two shows a surface that may be the nearest, in its colour and at its
//! depth; anything else remains a difference.
//!
//! In the same way a texture coordinate that is very large has a bound that holds several texels, and right
//! rasterizers may read different ones.

use crate::engines::Engine;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_render::effects::depth_ties::{Sample, TiedPiece, TiedPieces};
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::multisample::SAMPLES;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::Scene;
use rasterproof_verify::comparison::tolerance::{self, Bound};
use rasterproof_verify::oracle::values::ExactTriangle;

/// The samples of two frames that are undecided.
#[derive(Clone, Debug)]
pub struct Ties {
    /// Pixels with a sample that may show one of several colours.
    undecided: Frame<bool>,
    /// For each plane, samples where both frames show what they may.
    excused: Vec<Frame<bool>>,
    /// Pixels with a sample that the frames show by different texels, both within the bounds of their
    /// texture coordinates.
    far_texture: Frame<bool>,
}

impl Ties {
    /// Pixels that are undecided by either rasterizer.
    pub fn count(&self) -> u64 {
        let mut count = 0;
        for (_, row) in self.undecided.rows() {
            count += row.iter().filter(|&&is| is).count() as u64;
        }
        count
    }

    /// Whether a pixel of the picture is undecided.
    #[must_use]
    pub fn is_undecided(&self, x_px: i32, y_px: i32) -> bool {
        self.undecided.get(x_px, y_px).unwrap_or(false) || self.is_far_texture(x_px, y_px)
    }

    /// Whether the frames show a pixel differently because its texture coordinates are so far out that
    /// their bounds hold several texels.
    #[must_use]
    pub fn is_far_texture(&self, x_px: i32, y_px: i32) -> bool {
        self.far_texture.get(x_px, y_px).unwrap_or(false)
    }

    /// Whether a sample of a plane is undecided, and both rasterizers show there what they may.
    #[must_use]
    pub fn is_excused(&self, plane: usize, x_px: i32, y_px: i32) -> bool {
        self.excused[plane].get(x_px, y_px).unwrap_or(false)
    }
}

/// A rasterizer, and its frame of the scene with every depth of every sample.
#[derive(Clone, Copy)]
pub struct EngineFrame<'a> {
    pub engine: Engine,
    /// With every depth of every sample.
    pub target: &'a Target,
}

/// Samples of a band of rows, which is judged at once.
const BAND_SAMPLES: u64 = 1 << 16;

/// Tied pieces that are judged at once, some 100 bytes each. A band with more, many surfaces in one plane,
/// is halved, down to a pixel.
const MOST_RIVALS: usize = 1 << 19;

/// Finds the ties in two frames of one scene, in targets of the same kind.
pub fn find(scene: &Scene, frames: [EngineFrame<'_>; 2]) -> Result<Ties, BadScene> {
    let target = frames[0].target;
    let tied = TiedPieces::new(scene, target)?;
    // The size counts pixels, the bounds samples where the target is larger.
    let (size, bounds) = (tied.size(), target.bounds());
    // As many rows as have about so many samples.
    let per_row = u64::from(size.width()) * target.antialias().samples();
    let rows = (BAND_SAMPLES / per_row).max(1) as usize;
    // Each band is judged by itself, so that the pieces of a few rows are held at once.
    let bands = parallel::map((size.height() as usize).div_ceil(rows), |number| {
        let y0 = size.y0 + (number * rows) as i32;
        let y1 = (y0 + rows as i32).min(size.y1);
        Judge { tied: &tied, frames }.judge(PixelRect { y0, y1, ..size })
    });
    let mut ties = Ties {
        undecided: Frame::new(size, false),
        excused: vec![Frame::new(bounds, false); target.planes.len()],
        far_texture: Frame::new(size, false),
    };
    let scale = target.antialias().scale() as i32;
    for Sample { plane, x_px, y_px } in bands.iter().flat_map(|band| &band.excused).copied() {
        ties.excused[plane].span_mut(y_px, x_px, x_px + 1)[0] = true;
    }
    for Sample { x_px, y_px, .. } in bands.iter().flat_map(|band| &band.undecided).copied() {
        ties.undecided.span_mut(y_px / scale, x_px / scale, x_px / scale + 1)[0] = true;
    }
    excuse_far_textures(&tied, frames, &mut ties);
    Ok(ties)
}

/// Excuses samples that differ though both rasterizers keep their bounds, because a texture coordinate is
/// so large that its bound holds several texels: each frame shows the same piece at its depth, by a texel
/// within the bound of its own texture coordinates. A wrong coordinate shows another texel.
fn excuse_far_textures(tied: &TiedPieces<'_>, frames: [EngineFrame<'_>; 2], ties: &mut Ties) {
    let scale = frames[0].target.antialias().scale() as i32;
    for plane in 0..frames[0].target.planes.len() {
        let colours =
            |x: i32, y: i32| frames.map_array(|frame| frame.target.planes[plane].colour.get(x, y));
        let differs = |ties: &Ties, x: i32, y: i32| {
            let [a, b] = colours(x, y);
            a != b && !ties.is_excused(plane, x, y)
        };
        // Only pieces that meet the differing pixels are looked at again.
        let Some(differing) = box_of(frames[0].target.bounds(), |x, y| differs(ties, x, y)) else {
            continue;
        };
        for piece in tied.textured() {
            for (x_px, y_px) in
                far_textures(tied, frames, (piece, plane), differing, &|x, y| differs(ties, x, y))
            {
                ties.excused[plane].span_mut(y_px, x_px, x_px + 1)[0] = true;
                ties.far_texture.span_mut(y_px / scale, x_px / scale, x_px / scale + 1)[0] = true;
            }
        }
    }
}

/// The smallest rectangle that holds all pixels of which something is true.
fn box_of(bounds: PixelRect, is: impl Fn(i32, i32) -> bool) -> Option<PixelRect> {
    let mut rect: Option<PixelRect> = None;
    for y in bounds.y0..bounds.y1 {
        for x in (bounds.x0..bounds.x1).filter(|&x| is(x, y)) {
            let old = rect.unwrap_or(PixelRect { x0: x, y0: y, x1: x + 1, y1: y + 1 });
            let [x0, y0] = [old.x0.min(x), old.y0.min(y)];
            rect = Some(PixelRect { x0, y0, x1: old.x1.max(x + 1), y1: old.y1.max(y + 1) });
        }
    }
    rect
}

/// The samples of a plane at which both frames show a piece as they may.
fn far_textures(
    tied: &TiedPieces<'_>,
    frames: [EngineFrame<'_>; 2],
    (piece, plane): (u32, usize),
    rect: PixelRect,
    wanted: &dyn Fn(i32, i32) -> bool,
) -> Vec<(i32, i32)> {
    let Some((corners, depths)) = tied.piece(piece, plane) else { return Vec::new() };
    let no_values = [[0.0; 0]; 3];
    let Some(exact) = ExactTriangle::new(&corners, depths, [1.0; 3], no_values) else {
        return Vec::new();
    };
    // The piece without its values: where it is, and how deep.
    let is_multisampled = frames[0].target.antialias() == Antialias::Multisample4;
    // For each frame the samples at which it shows the piece as it may, in order, to be compared.
    let mut shown = [0, 1].map_array(|who| {
        let EngineFrame { engine, target } = frames[who];
        // Each frame by the bounds of the engine that drew it.
        let (tolerance, here) = (engine.tolerance(), &target.planes[plane]);
        let at_depth = |x: i32, y: i32| {
            let depth = exact.at(x, y).0.to_f64();
            let (near, far) = keys(target.format, depth, tolerance.depth, depths);
            here.depth.get(x, y).is_some_and(|key| (near..=far).contains(&key))
        };
        let wanted = |x: i32, y: i32| wanted(x, y) && at_depth(x, y);
        let bound = |values: [f64; 3]| tolerance.attribute.at(values);
        let mut good = Vec::new();
        // A multisampled pixel is shaded in the middle, or at whichever sample comes first.
        let mut places = vec![Some(plane)];
        if is_multisampled {
            places = (0..SAMPLES.len()).map(Some).collect();
            places.push(None);
        }
        for place in places {
            let by = (&engine, &bound as &dyn Fn([f64; 3]) -> f64);
            tied.texels(by, piece, place, (rect, &wanted), &mut |x, y, colours| {
                if here.colour.get(x, y).is_some_and(|colour| colours.holds(colour)) {
                    good.push((y, x));
                }
            });
        }
        good.sort_unstable();
        good.dedup();
        good
    });
    // What both frames show as they may is excused.
    let [first, second] = &mut shown;
    first.retain(|sample| second.binary_search(sample).is_ok());
    first.iter().map(|&(y, x)| (x, y)).collect()
}

/// The samples of a band of rows that are undecided, and those of them that are excused.
#[derive(Default)]
struct Band {
    undecided: Vec<Sample>,
    excused: Vec<Sample>,
}

impl Band {
    fn join(mut self, other: Self) -> Self {
        self.undecided.extend(other.undecided);
        self.excused.extend(other.excused);
        self
    }
}

/// The two halves of a rectangle: rows, or columns of a single row. None of a single pixel.
fn halves(rect: PixelRect) -> Option<[PixelRect; 2]> {
    let (x, y) = (rect.x0 + (rect.x1 - rect.x0) / 2, rect.y0 + (rect.y1 - rect.y0) / 2);
    if y > rect.y0 {
        Some([PixelRect { y1: y, ..rect }, PixelRect { y0: y, ..rect }])
    } else if x > rect.x0 {
        Some([PixelRect { x1: x, ..rect }, PixelRect { x0: x, ..rect }])
    } else {
        None
    }
}

/// A tied piece, and what is known of it by each of the two rasterizers.
#[derive(Clone, Copy)]
struct Candidate {
    /// The piece, and the sample at which it ties.
    tied_piece: TiedPiece,
    /// The nearest and the farthest key that the rasterizer may store.
    keys: [(u64, u64); 2],
    /// The colours that it may give to the sample. A multisampled pixel is shaded in the middle, or
    /// where the piece does not cover that, at whichever sample comes first.
    colours: [[Option<Colour>; SAMPLES.len()]; 2],
}

/// Two frames of a scene, and the pieces that tie in it.
struct Judge<'a> {
    tied: &'a TiedPieces<'a>,
    frames: [EngineFrame<'a>; 2],
}

impl Judge<'_> {
    /// Judges a rectangle, by halves where it has too many tied pieces to be judged at once.
    fn judge(&self, rect: PixelRect) -> Band {
        // A single pixel is judged, however many pieces tie there.
        let halves = halves(rect);
        // A list that is too long is not made, and the halves are judged one after the other.
        let most = if halves.is_some() { MOST_RIVALS } else { usize::MAX };
        match (self.tied.within(rect, most), halves) {
            (Some(tied), _) => self.judge_tied(tied),
            (None, Some([a, b])) => self.judge(a).join(self.judge(b)),
            (None, None) => Band::default(),
        }
    }

    /// Judges samples by the pieces that tie there.
    fn judge_tied(&self, tied: Vec<TiedPiece>) -> Band {
        // What may be the nearest by either rasterizer, with the colours that each would show.
        let mut candidates = self.candidates(tied);
        keep_rivals(&mut candidates);
        // By piece, to be shaded, and by sample again.
        candidates.sort_unstable_by_key(|c| (c.tied_piece.piece, c.tied_piece.sample));
        for group in candidates.chunk_by_mut(|a, b| a.tied_piece.piece == b.tied_piece.piece) {
            self.shade(0, group);
            self.shade(1, group);
        }
        candidates.sort_unstable_by_key(|c| c.tied_piece);
        let mut band = Band::default();
        for group in candidates.chunk_by(|a, b| a.tied_piece.sample == b.tied_piece.sample) {
            let sample = group[0].tied_piece.sample;
            // Where all of them are of one colour, it does not matter which is nearest.
            let mut colours = group.iter().flat_map(|c| c.colours.as_flattened()).flatten();
            let first = colours.next();
            if colours.any(|colour| Some(colour) != first) {
                band.undecided.push(sample);
                if self.is_excused(group) {
                    band.excused.push(sample);
                }
            }
        }
        band
    }

    /// TiedPieces with the keys that each rasterizer may store.
    fn candidates(&self, mut tied: Vec<TiedPiece>) -> Vec<Candidate> {
        let format = self.frames[0].target.format;
        let bounds = self.frames.map_array(|frame| frame.engine.tolerance().depth);
        tied.sort_unstable_by_key(|tied_piece| (tied_piece.piece, tied_piece.sample));
        let same =
            |a: &TiedPiece, b: &TiedPiece| (a.piece, a.sample.plane) == (b.piece, b.sample.plane);
        let mut candidates = Vec::with_capacity(tied.len());
        for group in tied.chunk_by(same) {
            let Some((corners, depths)) = self.tied.piece(group[0].piece, group[0].sample.plane)
            else {
                continue;
            };
            let no_values = [[0.0; 0]; 3];
            let Some(exact) = ExactTriangle::new(&corners, depths, [1.0; 3], no_values) else {
                continue;
            };
            for &tied_piece in group {
                let depth = exact.at(tied_piece.sample.x_px, tied_piece.sample.y_px).0.to_f64();
                let keys = bounds.map_array(|bound| keys(format, depth, bound, depths));
                let colours = [[None; SAMPLES.len()]; 2];
                candidates.push(Candidate { tied_piece, keys, colours });
            }
        }
        candidates.sort_unstable_by_key(|c| c.tied_piece);
        candidates
    }

    /// Finds what one of the two rasterizers shows of a piece at its candidates.
    fn shade(&self, who: usize, group: &mut [Candidate]) {
        // The piece is drawn once more by this engine, and its colours are noted at the candidates.
        let EngineFrame { engine, target } = self.frames[who];
        let piece = group[0].tied_piece.piece;
        // The piece is shaded in the rectangle around its candidates.
        let mut bounds = PixelRect { x0: i32::MAX, y0: i32::MAX, x1: i32::MIN, y1: i32::MIN };
        for Candidate { tied_piece, .. } in group.iter() {
            let Sample { x_px, y_px, .. } = tied_piece.sample;
            bounds.x0 = bounds.x0.min(x_px);
            bounds.y0 = bounds.y0.min(y_px);
            bounds.x1 = bounds.x1.max(x_px + 1);
            bounds.y1 = bounds.y1.max(y_px + 1);
        }
        if target.antialias() != Antialias::Multisample4 {
            self.tied.show(&engine, piece, Some(0), bounds, &mut |x, y, colour| {
                if let Some(at) = find_sample(group, 0, x, y) {
                    group[at].colours[who][0] = Some(colour);
                }
            });
            return;
        }
        // Wherever a pixel may be shaded: at each of its samples, and below in the middle.
        for plane in 0..SAMPLES.len() {
            self.tied.show(&engine, piece, Some(plane), bounds, &mut |x, y, colour| {
                for of in 0..SAMPLES.len() {
                    if let Some(at) = find_sample(group, of, x, y) {
                        group[at].colours[who][plane] = Some(colour);
                    }
                }
            });
        }
        self.tied.show(&engine, piece, None, bounds, &mut |x, y, colour| {
            for of in 0..SAMPLES.len() {
                if let Some(at) = find_sample(group, of, x, y) {
                    group[at].colours[who] = [Some(colour); SAMPLES.len()];
                }
            }
        });
    }

    /// Whether both frames show at this sample a tied piece, in its colour and at its depth, and the two
    /// rasterizers agree about the colours of all.
    fn is_excused(&self, group: &[Candidate]) -> bool {
        let Sample { plane, x_px, y_px } = group[0].tied_piece.sample;
        let shows = |who: usize| {
            let plane = &self.frames[who].target.planes[plane];
            let (key, colour) = (plane.depth.get(x_px, y_px), plane.colour.get(x_px, y_px));
            group.iter().any(|c| {
                let (near, far) = c.keys[who];
                key.is_some_and(|key| (near..=far).contains(&key))
                    && c.colours[who].contains(&colour)
            })
        };
        group.iter().all(|c| c.colours[0] == c.colours[1]) && shows(0) && shows(1)
    }
}

/// The place of a sample in a list of candidates, which is sorted by samples.
fn find_sample(group: &[Candidate], plane: usize, x_px: i32, y_px: i32) -> Option<usize> {
    let wanted = Sample { plane, x_px, y_px };
    group.binary_search_by_key(&wanted, |c| c.tied_piece.sample).ok()
}

/// The keys of all depths within a bound of the exact one, which was rounded once. The ends are
/// rounded outwards.
fn keys(format: DepthFormat, exact: f64, bound: Bound, depths: [f64; 3]) -> (u64, u64) {
    let error = bound.at(depths) + tolerance::ORACLE.depth.at(depths);
    (format.key((exact - error).next_down()), format.key((exact + error).next_up()))
}

/// Keeps what may be the nearest by one of the two rasterizers, at samples where several may.
fn keep_rivals(candidates: &mut Vec<Candidate>) {
    let mut kept = Vec::new();
    for group in candidates.chunk_by(|a, b| a.tied_piece.sample == b.tied_piece.sample) {
        // By each rasterizer, the farthest depth that the nearest surface may have, and its piece.
        let mut farthest = [(u64::MAX, u32::MAX); 2];
        for c in group {
            for (farthest, (_, end)) in farthest.iter_mut().zip(c.keys) {
                *farthest = (*farthest).min((end, c.tied_piece.piece));
            }
        }
        let before = kept.len();
        for c in group {
            let piece = c.tied_piece.piece;
            // Whoever may be nearer than that may be the nearest.
            if (c.keys[0].0, piece) <= farthest[0] || (c.keys[1].0, piece) <= farthest[1] {
                kept.push(*c);
            }
        }
        // One alone is no rival.
        if kept.len() == before + 1 {
            kept.truncate(before);
        }
    }
    *candidates = kept;
}
