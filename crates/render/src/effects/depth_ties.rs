//! Who competes for a sample: the pieces of a scene that may be nearest there, by any rasterizer whose
//! depths are within the bounds of both.
//!
//! Coverage is the oracle's, and depths are intervals, so no rasterizer has a say in who competes. What
//! a competitor would show is asked of a rasterizer, with the stages that its frames have.

use super::assembled::Assembled;
use super::conditions::{self, EVERY_FRAGMENT};
use super::plan::Canvas;
use super::planner;
use super::primitive::{BadScene, Piece, Prepared, bare, pack, surfaces, touched};
use super::samples::depths::DepthPlane;
use super::samples::pattern::{Pattern, scaled};
use super::stages::{Program, Registers};
use glam::DVec2;

use crate::pipeline::Counters;
use crate::pipeline::shade::{Attributes, PLACED};
use crate::pipeline::target::{Colour, Target};
use crate::scene::{Hidden, Scene};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Interpolate;
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::{sorted, twice_area};
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::parallel;
use rasterproof_core::triangle::{Corners, Fragment};
use rasterproof_oracle::Oracle;
use rasterproof_oracle::values::ExactTriangle;

/// A sample of a target: a pixel of one of its planes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Sample {
    pub plane: usize,
    /// Row of the plane.
    pub y_px: i32,
    /// Column of the plane.
    pub x_px: i32,
}

/// A piece that may be the nearest at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TiedPiece {
    pub sample: Sample,
    /// Which piece, in the order of drawing.
    pub piece: u32,
}

/// The pieces of a scene, to be asked about samples.
pub struct TiedPieces<'a> {
    scene: &'a Scene,
    items: Vec<Prepared<'a>>,
    pieces: Vec<(usize, Piece)>,
    canvas: Canvas,
    pattern: Pattern,
}

impl<'a> TiedPieces<'a> {
    /// The pieces of a scene as a target shows them; none where the order of drawing decides, since
    /// no pieces tie then.
    ///
    /// # Errors
    /// [`BadScene`].
    pub fn new(scene: &'a Scene, target: &Target) -> Result<Self, BadScene> {
        let canvas = Canvas::of(target);
        let (plan, _) = planner::plan(scene, &canvas, &EVERY_FRAGMENT, &|_| None)?;
        let mut assembled = Assembled::new(scene, &plan)?;
        if scene.hidden == Hidden::DepthBuffer {
            assembled.assemble(scene);
        }
        let mut pieces = assembled.pieces.unwrap_or_default();
        // What may be seen through does not hide for sure; its ties with others are not found.
        pieces.retain(|(item, _)| assembled.items[*item].item.material.opacity.is_none());
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
        let moved = self.pattern.moved(&bare(piece), plane)?;
        Some((moved.corners(), moved.vertices.map_array(|vertex| vertex.depth)))
    }

    /// All tied pieces in a rectangle of pixels, where a sample has at least two, sorted; none where they
    /// are more than `most`, which is asked of smaller rectangles then.
    ///
    /// Nearer is what has the smaller key, and of equal keys what was drawn first. So a piece may be
    /// the nearest if its nearest (key, place in the order) is not beyond the farthest of another.
    #[must_use]
    pub fn within(&self, rect: PixelRect, most: usize) -> Option<Vec<TiedPiece>> {
        let samples = scaled(rect, self.pattern.scale);
        let beyond_all = (u64::MAX, u32::MAX);
        let mut farthest = vec![Frame::new(samples, beyond_all); self.pattern.planes];
        self.each_sample(rect, &mut |tied_piece, (_, far)| {
            let Sample { plane, y_px, x_px } = tied_piece.sample;
            let least = &mut farthest[plane].span_mut(y_px, x_px, x_px + 1)[0];
            *least = (*least).min((far, tied_piece.piece));
        });
        // The first that is met at a sample waits for a second.
        let mut first = vec![Frame::new(samples, u32::MAX); self.pattern.planes];
        let mut tied = Vec::new();
        self.each_sample(rect, &mut |tied_piece, (near, _)| {
            let Sample { plane, y_px, x_px } = tied_piece.sample;
            let Some(least) = farthest[plane].get(x_px, y_px) else { return };
            if (near, tied_piece.piece) > least {
                return;
            }
            let waiting = &mut first[plane].span_mut(y_px, x_px, x_px + 1)[0];
            if *waiting == u32::MAX {
                *waiting = tied_piece.piece;
            } else if tied.len() <= most {
                let before = TiedPiece { piece: *waiting, ..tied_piece };
                // Repeated from the third on.
                tied.extend([before, tied_piece]);
            }
        });
        if tied.len() > most {
            return None;
        }
        tied.sort_unstable();
        tied.dedup();
        Some(tied)
    }

    /// Every sample that a piece covers, with the keys between which its depth lies.
    fn each_sample(&self, rect: PixelRect, see: &mut dyn FnMut(TiedPiece, (u64, u64))) {
        self.each_interval(rect, &|_| None, see);
    }

    /// The same where depths may be off by more than a rasterizer's rounding.
    fn each_interval(
        &self,
        rect: PixelRect,
        error: &dyn Fn((&Piece, &DepthPlane)) -> Option<DepthError>,
        see: &mut dyn FnMut(TiedPiece, (u64, u64)),
    ) {
        let (samples, one) = (scaled(rect, self.pattern.scale), Pattern { scale: 1, planes: 1 });
        for (index, (_, piece)) in self.pieces.iter().enumerate() {
            if touched(&piece.corners(), self.canvas.antialias).intersect(&rect).is_empty() {
                continue;
            }
            for plane in 0..self.pattern.planes {
                let Some(moved) = self.pattern.moved(piece, plane) else { continue };
                let depths = DepthPlane::new(&moved, one);
                let error = error((&moved, &depths));
                Oracle.spans(moved.corners(), samples, &mut |span| {
                    for x_px in span.x0_px..span.x1_px {
                        let ([near, far], off) = (
                            depths.depths(x_px, span.y_px),
                            error.as_ref().map_or(0.0, |error| error(x_px, span.y_px)),
                        );
                        let keys = [near - off, far + off].map_array(|z| self.canvas.depth.key(z));
                        let sample = Sample { plane, y_px: span.y_px, x_px };
                        see(TiedPiece { sample, piece: index as u32 }, keys.into());
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
        let perspective = !self.scene.affine;
        let plan = conditions::of_every_fragment(self.scene, item.item);
        let map = item.light_view.as_ref().map(|view| view.map(self.scene, engine));
        let counters = &mut Counters::default();
        let registers = &mut Registers::new();
        let program = Program::new(item, piece, plan, map, None, registers, counters);
        let packed = pack::<PLACED>(&moved, plan.interpolates);
        let mut shader = program.on(registers);
        let emit = |f: Fragment<Attributes<PLACED>>| {
            see(f.x_px, f.y_px, shader.one(&f.varying, f.depth));
        };
        if perspective {
            engine.fragments(&packed, bounds, emit);
        } else {
            engine.affine_fragments(&packed, bounds, emit);
        }
    }

    /// Counts the pixels in which several pieces may be the nearest when corners are snapped and depths are planes in
    /// f32, as the rasterizer in tiles has them. Pieces with the same corners and depths count as one.
    #[must_use]
    pub fn by_planes_in_f32(&self) -> ByRounding {
        let size = self.size();
        let height = (size.y1 - size.y0).max(1);
        let rows = ((height + 7) / 8).min(64);
        let bands = parallel::map((height as usize).div_ceil(rows as usize), |number| {
            let y0 = size.y0 + number as i32 * rows;
            self.in_f32_within(PixelRect { y0, y1: (y0 + rows).min(size.y1), ..size })
        });
        bands.into_iter().fold(ByRounding::default(), |sum, band| ByRounding {
            pixels: sum.pixels + band.pixels,
            first: sum.first.or(band.first),
        })
    }

    fn in_f32_within(&self, rect: PixelRect) -> ByRounding {
        let scale = self.pattern.scale;
        let samples = scaled(rect, scale);
        let mut farthest = vec![Frame::new(samples, (u64::MAX, u32::MAX)); self.pattern.planes];
        self.each_interval(
            rect,
            &|plane| Some(error_in_f32(plane, self.size(), scale)),
            &mut |at, keys| {
                let Sample { plane, y_px, x_px } = at.sample;
                let least = &mut farthest[plane].span_mut(y_px, x_px, x_px + 1)[0];
                *least = (*least).min((keys.1, at.piece));
            },
        );
        let mut first = vec![Frame::new(samples, u32::MAX); self.pattern.planes];
        let mut open = Frame::new(rect, false);
        self.each_interval(
            rect,
            &|plane| Some(error_in_f32(plane, self.size(), scale)),
            &mut |at, keys| {
                let Sample { plane, y_px, x_px } = at.sample;
                let Some(least) = farthest[plane].get(x_px, y_px) else { return };
                if (keys.0, at.piece) > least {
                    return;
                }
                let before = &mut first[plane].span_mut(y_px, x_px, x_px + 1)[0];
                if *before == u32::MAX {
                    *before = at.piece;
                } else if !self.are_equal(*before, at.piece) {
                    let (x, y) = (x_px.div_euclid(scale), y_px.div_euclid(scale));
                    open.span_mut(y, x, x + 1)[0] = true;
                }
            },
        );
        let mut found = ByRounding::default();
        for (y, row) in open.rows() {
            for (x, _) in (rect.x0..).zip(row).filter(|(_, is_open)| **is_open) {
                found.pixels += 1;
                found.first = found.first.or(Some((x, y)));
            }
        }
        found
    }

    /// Whether two pieces have the same corners and depths, in any order.
    fn are_equal(&self, a: u32, b: u32) -> bool {
        let corners = |piece: u32| {
            let vertices = &self.pieces[piece as usize].1.vertices;
            let corners = vertices.map_array(|v| (v.position.x, v.position.y, v.depth.to_bits()));
            sorted(corners, |a, b| a > b)
        };
        corners(a) == corners(b)
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
        let plan = conditions::of_every_fragment(self.scene, item.item);
        if plan.mip_maps || plan.anisotropy {
            // Between levels any colour may be read.
            return;
        }
        let map = item.light_view.as_ref().map(|view| view.map(self.scene, engine));
        let counters = &mut Counters::default();
        let registers = &mut Registers::new();
        let program = Program::new(item, piece, plan, map, None, registers, counters);
        let Some(texture) = program.texture() else { return };
        let uv = surfaces(&moved).map_array(|of| of.uv);
        let bounds_of_uv =
            DVec2::new(bound(uv.map_array(|uv| uv.x)), bound(uv.map_array(|uv| uv.y)));
        let inv_w = moved.vertices.map_array(|v| if perspective { v.inv_w } else { 1.0 });
        let exact =
            ExactTriangle::new(&moved.corners(), [0.0; 3], inv_w, uv.map_array(|uv| uv.to_array()));
        let Some(exact) = exact else { return };
        let mut range = None;
        let packed = pack::<PLACED>(&moved, plan.interpolates);
        let emit = |f: Fragment<Attributes<PLACED>>| {
            if !wanted(f.x_px, f.y_px) {
                return;
            }
            let (_, uv) = exact.at(f.x_px, f.y_px);
            let uv = DVec2::from(uv.map_array(|number| number.to_f64()));
            let mut shade =
                |texel| program.with_texel(texel).on(registers).one(&f.varying, f.depth);
            let texels = texture
                .within(uv, bounds_of_uv)
                .unwrap_or_else(|| vec![*range.get_or_insert_with(|| texture.range())]);
            let colours = texels.into_iter().map(|texels| texels.map_array(&mut shade)).collect();
            see(f.x_px, f.y_px, Reachable(colours));
        };
        if perspective {
            engine.fragments(&packed, bounds, emit);
        } else {
            engine.affine_fragments(&packed, bounds, emit);
        }
    }
}

/// By how much a depth may be off at a sample.
type DepthError = Box<dyn Fn(i32, i32) -> f64>;

/// The bound for a piece, in a window of `size` pixels with `scale` samples along the side of each.
///
/// Snapping: a corner moves by at most 1/512 along either axis. Inside of both triangles the depth is
/// an average of the corners', so it moves by at most (|gx| + |gy|) / 512, with g what the depth changes
/// by from sample to sample.
///
/// Planes in f32, z = f0 + gx x + gy y from the first pixel of the box: at most 4 u S + 11 u' T, with
/// S = |f0| + |gx x| + |gy y| <= |z| + 2 (|gx x| + |gy y|) and T = M + Gx X + Gy Y, as the module
/// `planes` of the crate of tiles derives it. M <= 1.
fn error_in_f32((piece, depths): (&Piece, &DepthPlane), size: PixelRect, scale: i32) -> DepthError {
    let [gx, gy] = depths.per_px();
    let off = (gx + gy) / f64::from(2 * SUBPIXELS);
    let corners = piece.corners();
    let px = |sub: i32| f64::from(sub) / f64::from(SUBPIXELS);
    let start = |all: [i32; 3], least: i32| {
        let first = all.into_iter().min().unwrap_or(0).div_euclid(SUBPIXELS);
        f64::from(first.max(least * scale))
    };
    let x0 = start(corners.map_array(|c| c.x), size.x0);
    let y0 = start(corners.map_array(|c| c.y), size.y0);
    let [a, b, c] = corners.map_array(|c| (px(c.x), px(c.y)));
    let area = twice_area(&corners) as f64 / f64::from(SUBPIXELS * SUBPIXELS);
    let slope = |one: f64, other: f64| 2.0 * (one.abs() + other.abs()) / area.abs();
    let (steep_x, steep_y) = (slope(b.1 - a.1, c.1 - a.1), slope(b.0 - a.0, c.0 - a.0));
    let reach_x = (x0 - a.0).abs() + f64::from(size.width()) * f64::from(scale);
    let reach_y = (y0 - a.1).abs() + f64::from(size.height()) * f64::from(scale);
    let in_f64 = 11.0 * (f64::EPSILON / 2.0) * (1.0 + steep_x * reach_x + steep_y * reach_y);
    let unit = f64::from(f32::EPSILON) / 2.0;
    Box::new(move |x, y| {
        let away = gx * (f64::from(x) + 1.0 - x0) + gy * (f64::from(y) + 1.0 - y0);
        // The last factor is for products of errors.
        off + (4.0 * unit * (1.0 + 2.0 * away) + in_f64) * (1.0 + 1.0 / f64::from(1 << 18))
    })
}

/// Pixels in which only rounding decides which surface is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct ByRounding {
    pub pixels: u64,
    /// Column and row of the first.
    pub first: Option<(i32, i32)>,
}

/// The colours that a textured sample may have: all between two, channel by channel, for each pair.
#[derive(Clone, Debug)]
pub struct Reachable(Vec<[Colour; 2]>);

impl Reachable {
    #[must_use]
    pub fn holds(&self, colour: Colour) -> bool {
        self.0.iter().any(|[a, b]| {
            (0..colour.len()).all(|i| (a[i].min(b[i])..=a[i].max(b[i])).contains(&colour[i]))
        })
    }
}
