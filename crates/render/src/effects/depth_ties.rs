//! Who competes for a sample: the pieces of a scene that may be nearest there, by any rasterizer whose
//! depths are within the bounds of both.
//!
//! Coverage is the oracle's, and depths are intervals, so no rasterizer has a say in who competes. What
//! a competitor would show is asked of a rasterizer, with the stages that its frames have.

use super::assembled::Assembled;
use super::kernel::Kernel;
use super::plan::{Canvas, PiecePlan};
use super::primitive::{BadScene, Piece, Prepared, pack, touched};
use super::samples::depths::DepthPlane;
use super::samples::pattern::{Pattern, scaled};
use super::{Effect, Effects, Mode, planner};
use glam::DVec2;

use crate::pipeline::Counters;
use crate::pipeline::shade::Surface;
use crate::pipeline::target::{Colour, Target, to_colour};
use crate::scene::{Hidden, Scene};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate, Rasterize};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::ExactTriangle;

/// A sample of a target: a pixel of one of its planes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Sample {
    /// Which plane.
    pub plane: usize,
    /// Row of the plane.
    pub y_px: i32,
    /// Column of the plane.
    pub x_px: i32,
}

/// A piece that may be the nearest at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rival {
    /// Where.
    pub sample: Sample,
    /// Which piece, in the order of drawing.
    pub piece: u32,
}

/// The pieces of a scene, to be asked about samples.
pub struct Rivals<'a> {
    scene: &'a Scene,
    items: Vec<Prepared<'a>>,
    pieces: Vec<(usize, Piece)>,
    canvas: Canvas,
    pattern: Pattern,
}

impl<'a> Rivals<'a> {
    /// The pieces of a scene as a target shows them; none where the order of drawing decides, since
    /// there are no rivals then.
    ///
    /// # Errors
    /// [`BadScene`].
    pub fn new(scene: &'a Scene, target: &Target) -> Result<Self, BadScene> {
        let canvas = Canvas::of(target);
        let effects = Effects::USUAL.with(Effect::Interpolation, Mode::Always);
        let (plan, _) = planner::plan(scene, &canvas, &effects, &|_| None)?;
        let mut assembled = Assembled::new(scene, &plan)?;
        if scene.hidden == Hidden::DepthBuffer {
            assembled.assemble(scene);
        }
        let pieces = assembled.pieces.unwrap_or_default();
        let pattern = Pattern::of(canvas.antialias);
        Ok(Self { scene, items: assembled.items, pieces, canvas, pattern })
    }

    /// The picture's pixels.
    #[must_use]
    pub fn size(&self) -> PixelRect {
        self.canvas.size()
    }

    /// A piece as a plane of samples sees it: its corners, and the depths there. None for a piece that
    /// cannot be moved.
    #[must_use]
    pub fn piece(&self, piece: u32, plane: usize) -> Option<(Corners, [f64; 3])> {
        let (_, piece) = &self.pieces[piece as usize];
        let moved = self.pattern.moved(&pack::<0, 0>(piece), plane)?;
        Some((moved.corners(), moved.vertices.map_array(|vertex| vertex.depth)))
    }

    /// All rivals in a rectangle of pixels, where a sample has at least two, sorted; none where they
    /// are more than `most`, which is asked of smaller rectangles then.
    ///
    /// Nearer is what has the smaller key, and of equal keys what was drawn first. So a piece may be
    /// the nearest if its nearest (key, place in the order) is not beyond the farthest of another.
    #[must_use]
    pub fn within(&self, rect: PixelRect, most: usize) -> Option<Vec<Rival>> {
        let samples = scaled(rect, self.pattern.scale);
        let beyond_all = (u64::MAX, u32::MAX);
        let mut farthest = vec![Frame::new(samples, beyond_all); self.pattern.planes];
        self.each_sample(rect, &mut |rival, (_, far)| {
            let Sample { plane, y_px, x_px } = rival.sample;
            let least = &mut farthest[plane].span_mut(y_px, x_px, x_px + 1)[0];
            *least = (*least).min((far, rival.piece));
        });
        // The first that is met at a sample waits for a second.
        let mut first = vec![Frame::new(samples, u32::MAX); self.pattern.planes];
        let mut rivals = Vec::new();
        self.each_sample(rect, &mut |rival, (near, _)| {
            let Sample { plane, y_px, x_px } = rival.sample;
            let Some(least) = farthest[plane].get(x_px, y_px) else { return };
            if (near, rival.piece) > least {
                return;
            }
            let waiting = &mut first[plane].span_mut(y_px, x_px, x_px + 1)[0];
            if *waiting == u32::MAX {
                *waiting = rival.piece;
            } else if rivals.len() <= most {
                let before = Rival { piece: *waiting, ..rival };
                // Repeated from the third on.
                rivals.extend([before, rival]);
            }
        });
        if rivals.len() > most {
            return None;
        }
        rivals.sort_unstable();
        rivals.dedup();
        Some(rivals)
    }

    /// Every sample that a piece covers, with the keys between which its depth lies.
    fn each_sample(&self, rect: PixelRect, see: &mut dyn FnMut(Rival, (u64, u64))) {
        let (samples, one) = (scaled(rect, self.pattern.scale), Pattern { scale: 1, planes: 1 });
        for (index, (_, piece)) in self.pieces.iter().enumerate() {
            if touched(&piece.corners(), self.canvas.antialias).intersect(&rect).is_empty() {
                continue;
            }
            for plane in 0..self.pattern.planes {
                let Some(moved) = self.pattern.moved(piece, plane) else { continue };
                let depths = DepthPlane::new(&moved, one);
                Oracle.cover(moved.corners(), samples, |span| {
                    for x_px in span.x0_px..span.x1_px {
                        let keys = depths.keys(x_px, span.y_px, self.canvas.depth);
                        let sample = Sample { plane, y_px: span.y_px, x_px };
                        see(Rival { sample, piece: index as u32 }, keys.into());
                    }
                });
            }
        }
    }

    /// What a piece shows by a rasterizer at the samples of a plane, or in the middle of the pixels of
    /// a multisampled picture where there is no plane, as far as they lie in `bounds`.
    pub fn show(
        &self,
        engine: &impl Interpolate,
        piece: u32,
        plane: Option<usize>,
        bounds: PixelRect,
        see: &mut dyn FnMut(i32, i32, Colour),
    ) {
        let (item, piece) = &self.pieces[piece as usize];
        let item = &self.items[*item];
        let moved = match plane {
            Some(plane) => self.pattern.moved(piece, plane),
            None => Some(*piece),
        };
        let Some(moved) = moved else { return };
        let (interpolates, perspective) = (item.carries, !self.scene.affine);
        let plan = PiecePlan { interpolates, perspective, depth: true };
        let kernel = Kernel::new(item, piece, plan, &mut Counters::default());
        let emit = |f: rasterproof_core::triangle::Fragment<_>| {
            see(f.x_px, f.y_px, to_colour(kernel.shade_all(&f.varying)));
        };
        if perspective {
            engine.fragments(&moved, bounds, emit);
        } else {
            engine.affine_fragments(&moved, bounds, emit);
        }
    }

    /// The pieces in the order of drawing that have texture coordinates of their own in each fragment.
    pub fn textured(&self) -> impl Iterator<Item = u32> + '_ {
        let is_textured = |(item, _): &(usize, Piece)| self.items[*item].texture.is_some();
        let pieces = self.pieces.iter().enumerate().filter(move |(_, piece)| is_textured(piece));
        pieces.map(|(index, _)| index as u32)
    }

    /// The colours that a piece may have by a rasterizer whose texture coordinates lie within
    /// `bound(u or v of the corners)` of the exact ones, at the samples of a plane, or in the middle of the
    /// pixels of a multisampled picture where there is no plane; as far as they lie in `bounds` and are
    /// `wanted`.
    pub fn texels(
        &self,
        (engine, bound): (&impl Interpolate, &dyn Fn([f64; 3]) -> f64),
        piece: u32,
        plane: Option<usize>,
        (bounds, wanted): (PixelRect, &dyn Fn(i32, i32) -> bool),
        see: &mut dyn FnMut(i32, i32, Reachable),
    ) {
        let (item, piece) = &self.pieces[piece as usize];
        let item = &self.items[*item];
        let moved = match plane {
            Some(plane) => self.pattern.moved(piece, plane),
            None => Some(*piece),
        };
        let Some(moved) = moved else { return };
        let perspective = !self.scene.affine;
        let plan = PiecePlan { interpolates: item.carries, perspective, depth: true };
        let kernel = Kernel::new(item, piece, plan, &mut Counters::default());
        let Some(texture) = kernel.varying_texture() else { return };
        let uv = moved.vertices.map_array(|v| Surface::from(v.varying).uv);
        let bounds_of_uv =
            DVec2::new(bound(uv.map_array(|uv| uv.x)), bound(uv.map_array(|uv| uv.y)));
        let inv_w = moved.vertices.map_array(|v| if perspective { v.inv_w } else { 1.0 });
        let exact =
            ExactTriangle::new(&moved.corners(), [0.0; 3], inv_w, uv.map_array(|uv| uv.to_array()));
        let Some(exact) = exact else { return };
        let mut range = None;
        let emit = |f: rasterproof_core::triangle::Fragment<_>| {
            if !wanted(f.x_px, f.y_px) {
                return;
            }
            let (_, uv) = exact.at(f.x_px, f.y_px);
            let uv = DVec2::from(uv.map_array(|number| number.to_f64()));
            let shade = |texel| to_colour(kernel.shade_texel(&f.varying, texel));
            let colours = match texture.within(uv, bounds_of_uv) {
                Some(texels) => Reachable::Colours(texels.into_iter().map(shade).collect()),
                None => Reachable::Between(
                    range.get_or_insert_with(|| texture.range()).map_array(shade),
                ),
            };
            see(f.x_px, f.y_px, colours);
        };
        if perspective {
            engine.fragments(&moved, bounds, emit);
        } else {
            engine.affine_fragments(&moved, bounds, emit);
        }
    }
}

/// The colours that a textured sample may have.
#[derive(Clone, Debug)]
pub enum Reachable {
    /// These.
    Colours(Vec<Colour>),
    /// All between two, channel by channel: the bound is wider than the list of texels may be.
    Between([Colour; 2]),
}

impl Reachable {
    /// Whether a colour is one of them.
    #[must_use]
    pub fn holds(&self, colour: Colour) -> bool {
        match self {
            Self::Colours(colours) => colours.contains(&colour),
            Self::Between([a, b]) => {
                (0..colour.len()).all(|i| (a[i].min(b[i])..=a[i].max(b[i])).contains(&colour[i]))
            }
        }
    }
}
