//! Which surface is seen at each pixel, judged before corners are snapped: decided, decided by the order of drawing
//! alone, or by rounding alone.
//!
//! The depth of a piece at a pixel centre is that of its plane through the corners as they are. Two depths are equal
//! where they lie within what the doubles of the vertex stage and of the plane may be off. Rounding decides where they
//! lie within what snapping may move them besides, unless the two pieces are the same one drawn twice. Which pieces
//! cover a pixel is what is drawn. What blends hides nothing, so that it competes with what is opaque and not with what
//! blends as well.

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::sorted;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_render::pipeline::opacity::AlphaMode;
use rasterproof_render::scene::{Item, Scene};

use crate::view::{NOTHING, Piece};

/// How it is decided which surface is seen at a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// No piece covers it.
    #[default]
    Empty,
    Decided,
    /// The same piece is drawn twice: the order of drawing decides.
    ByOrder,
    /// Rounding decides between two depths that differ.
    ByRounding,
    /// Rounding decides between two depths that are equal before corners are snapped.
    Equal,
}

/// How many pixels are of each class, which is the least decided one of their samples.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Classes {
    #[serde(skip)]
    pub map: Frame<Class>,
    pub decided: u64,
    pub by_order: u64,
    /// All pixels that rounding decides, also those of equal depths.
    pub by_rounding: u64,
    pub equal: u64,
    /// The first pixel that rounding decides.
    #[serde(skip)]
    pub first: Option<TiedPair>,
}

/// A pixel and two triangles of the scene, the nearer one first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TiedPair {
    pub pixel: [i32; 2],
    pub triangles: [u32; 2],
}

/// A depth over the window, before corners are snapped.
pub(crate) struct DepthPlane {
    from: [f64; 3],
    slope: [f64; 2],
    /// The same with every term positive, times what the terms may be off.
    terms: [f64; 2],
    /// What a depth may be off at any pixel, but for the terms.
    off: f64,
    /// What snapping may do besides.
    snapping: f64,
}

/// The unit roundoff of doubles: the largest relative error of a rounded sum, product or quotient.
const U: f64 = f64::EPSILON / 2.0;

impl DepthPlane {
    /// None for a piece that has no area before it is snapped.
    ///
    /// In units of u, as for the choices of interpolation: with k the cancellation of the area, a slope is off by
    /// (7 + 3 k) times its terms, and the sum by twice the depth of the corner. What the vertex stage is off moves the
    /// depth by that of a corner, and by the slope times that of a position.
    pub fn of(piece: &Piece) -> Option<Self> {
        let [a, b, c] = piece.px;
        let [z, z1, z2] = piece.triangle.vertices.map(|vertex| vertex.depth);
        let (p, q) = ((b[0] - a[0]) * (c[1] - a[1]), (c[0] - a[0]) * (b[1] - a[1]));
        let area = p - q;
        if area == 0.0 {
            return None;
        }
        let cancels = (p.abs() + q.abs()) / area.abs();
        let (d1, d2) = (z1 - z, z2 - z);
        let pairs =
            [[d1 * (c[1] - a[1]), d2 * (b[1] - a[1])], [d2 * (b[0] - a[0]), d1 * (c[0] - a[0])]];
        let slope = pairs.map(|[p, q]| (p - q) / area);
        let of_terms = U * (7.0 + 3.0 * cancels);
        let terms = pairs.map(|[p, q]| of_terms * (p.abs() + q.abs()) / area.abs());
        let steep = slope[0].abs() + slope[1].abs();
        let off = piece.depth_error + steep * piece.px_error + 2.0 * U * z.abs();
        let snapping = steep / f64::from(2 * SUBPIXELS);
        Some(Self { from: [a[0], a[1], z], slope, terms, off, snapping })
    }

    /// The depth at a pixel centre, what it may be off, and what it may be off once corners are snapped.
    pub fn at(&self, x_px: i32, y_px: i32) -> [f64; 3] {
        let [x, y, z] = self.from;
        let (dx, dy) = (f64::from(x_px) + 0.5 - x, f64::from(y_px) + 0.5 - y);
        let off = self.off + self.terms[0] * dx.abs() + self.terms[1] * dy.abs();
        let z = z + self.slope[0] * dx + self.slope[1] * dy;
        [z, off, off + self.snapping]
    }
}

/// The pieces of a plane of samples, and the nearest one of those that hide what is behind them.
pub(crate) struct Surfaces<'a> {
    pub pieces: &'a [Piece],
    pub window: PixelRect,
    planes: Vec<Option<DepthPlane>>,
    /// Whether a piece blends, so that it hides nothing.
    blends: Vec<bool>,
    nearest: Frame<(f64, u32)>,
}

/// Whether an item blends, so that it hides nothing that lies behind it.
pub(crate) fn blends(item: &Item) -> bool {
    item.material.opacity.as_ref().is_some_and(|opacity| opacity.mode == AlphaMode::Blend)
}

/// The depth and the piece of a sample at which nothing is seen.
const NONE: (f64, u32) = (f64::INFINITY, NOTHING);

impl<'a> Surfaces<'a> {
    /// Finds the nearest piece at each sample by the depths of planes before corners are snapped; of equal ones the first.
    pub fn of(scene: &Scene, pieces: &'a [Piece], window: PixelRect) -> Self {
        let blends = |piece: &Piece| blends(&scene.items[piece.item as usize]);
        let mut surfaces = Self {
            pieces,
            window,
            planes: pieces.iter().map(DepthPlane::of).collect(),
            blends: pieces.iter().map(blends).collect(),
            nearest: Frame::new(window, NONE),
        };
        let mut nearest = Frame::new(window, NONE);
        surfaces.each(&mut |number, plane, x, y| {
            let [z, ..] = plane.at(x, y);
            let held = &mut nearest.span_mut(y, x, x + 1)[0];
            if z < held.0 && !surfaces.blends[number as usize] {
                *held = (z, number);
            }
        });
        surfaces.nearest = nearest;
        surfaces
    }

    /// Calls `see` with each sample of each piece.
    fn each(&self, see: &mut dyn FnMut(u32, &DepthPlane, i32, i32)) {
        for (number, (piece, plane)) in self.pieces.iter().zip(&self.planes).enumerate() {
            let Some(plane) = plane else { continue };
            Scanline.cover(piece.corners(), self.window, |span| {
                for x in span.x0_px..span.x1_px {
                    see(number as u32, plane, x, span.y_px);
                }
            });
        }
    }

    /// The number of the piece that is seen at a sample and hides what is behind it.
    pub fn front(&self, [x, y]: [i32; 2]) -> Option<u32> {
        let (_, front) = self.nearest.get(x, y).unwrap_or(NONE);
        (front != NOTHING).then_some(front)
    }

    /// How far what is seen at a sample lies in front of a piece of this or another scene, and by how much either may be
    /// off once corners are snapped; nothing where nothing is seen, or the piece has no plane.
    pub fn before(&self, piece: &Piece, [x, y]: [i32; 2]) -> Option<[f64; 2]> {
        let (near, front) = self.nearest.get(x, y).unwrap_or(NONE);
        let front = self.planes.get(front as usize)?.as_ref()?;
        let ([_, _, wide], [z, _, own_wide]) = (front.at(x, y), DepthPlane::of(piece)?.at(x, y));
        Some([z - near, wide + own_wide])
    }

    /// Calls `see` with each sample of a piece that is seen there, or that competes with the one that is: its number, the
    /// number of the other one, and how it is decided between them.
    pub fn seen(&self, see: &mut dyn FnMut([i32; 2], [u32; 2], Class)) {
        self.each(&mut |number, plane, x, y| {
            let (near, front) = self.nearest.get(x, y).unwrap_or(NONE);
            let Some(Some(front_plane)) = self.planes.get(front as usize) else {
                return see([x, y], [number; 2], Class::Decided);
            };
            if number == front {
                return see([x, y], [number; 2], Class::Decided);
            }
            let ([_, off, wide], [z, own_off, own_wide]) = (front_plane.at(x, y), plane.at(x, y));
            // What blends hides nothing: behind the front it is not seen, well in front of it nothing competes, and else
            // the distance alone counts.
            let blends = self.blends[number as usize];
            let class = match if blends { (z - near).abs() } else { z - near } {
                _ if blends && z < near - wide - own_wide => Class::Decided,
                gap if gap > wide + own_wide => return,
                _ if self.are_same(number, front) => Class::ByOrder,
                gap if gap <= off + own_off => Class::Equal,
                _ => Class::ByRounding,
            };
            see([x, y], [number, front], class);
        });
    }

    /// Whether two pieces have the same corners and depths, in any order.
    fn are_same(&self, a: u32, b: u32) -> bool {
        self.sorted_corners(a) == self.sorted_corners(b)
    }

    /// The corners of a piece with their depths, as bits, in an order of their own.
    fn sorted_corners(&self, piece: u32) -> [(i32, i32, u64); 3] {
        let vertices = &self.pieces[piece as usize].triangle.vertices;
        let corners = vertices.map_array(|v| (v.position.x, v.position.y, v.depth.to_bits()));
        sorted(corners, |a, b| a > b)
    }
}

impl Classes {
    /// Without any sample yet: pixels are counted by [`Classes::counted`] once all are added.
    pub(crate) fn new(size: PixelRect) -> Self {
        let map = Frame::new(size, Class::Empty);
        Self { map, decided: 0, by_order: 0, by_rounding: 0, equal: 0, first: None }
    }

    /// Adds what is seen at the samples of a plane, `scale` of which are a pixel in x and in y.
    pub(crate) fn look(&mut self, surfaces: &Surfaces<'_>, scale: i32) {
        surfaces.seen(&mut |sample, [piece, front], class| {
            let pixel = sample.map_array(|at| at.div_euclid(scale));
            let triangles = [front, piece].map_array(|one| surfaces.pieces[one as usize].face);
            self.add(TiedPair { pixel, triangles }, class);
        });
    }

    /// Adds what is seen at a sample.
    pub(crate) fn add(&mut self, pair: TiedPair, class: Class) {
        let [x, y] = pair.pixel;
        let held = &mut self.map.span_mut(y, x, x + 1)[0];
        *held = class.max(*held);
        let is_before = |first: TiedPair| [y, x] < [first.pixel[1], first.pixel[0]];
        if class >= Class::ByRounding && self.first.is_none_or(is_before) {
            self.first = Some(pair);
        }
    }

    /// The same with the pixels of each class counted.
    pub(crate) fn counted(self) -> Self {
        let (mut decided, mut by_order, mut by_rounding, mut equal) = (0, 0, 0, 0);
        for (_, row) in self.map.rows() {
            for class in row {
                decided += u64::from(*class == Class::Decided);
                by_order += u64::from(*class == Class::ByOrder);
                by_rounding += u64::from(*class >= Class::ByRounding);
                equal += u64::from(*class == Class::Equal);
            }
        }
        Self { decided, by_order, by_rounding, equal, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::pieces;
    use glam::{DMat4, DVec2, DVec3};
    use rasterproof_render::pipeline::transform::perspective;
    use rasterproof_render::scene::{Corner, Material, Mesh};

    /// A tilted square that is cut along one of its diagonals, and moved towards the eye.
    fn square(other_diagonal: bool, nearer: f64) -> Item {
        let positions = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| DVec3::new(x, y, 4.0 + 0.7 * y + 0.3 * x - nearer))
            .to_vec();
        let corner = |position: u32| Corner {
            position,
            colour: DVec3::ONE,
            normal: DVec3::Z,
            uv: DVec2::ZERO,
        };
        let triangle = |a: u32, b: u32, c: u32| [corner(a), corner(b), corner(c)];
        let triangles = match other_diagonal {
            false => [triangle(0, 1, 2), triangle(0, 2, 3)],
            true => [triangle(1, 2, 3), triangle(1, 3, 0)],
        };
        let triangles = triangles.into_iter().collect();
        Item::new(Mesh { positions: positions.into(), triangles }, Material::default())
    }

    fn classes(second: Item) -> Classes {
        let mut scene = Scene::new("two", "", perspective(0.7, 1.0, 1.0, 10.0).unwrap());
        scene.view = DMat4::IDENTITY;
        scene.items = vec![square(false, 0.0), second];
        let size = PixelRect::window(200, 200);
        let pieces = pieces(&scene, size).unwrap();
        let mut classes = Classes::new(size);
        classes.look(&Surfaces::of(&scene, &pieces, size), 1);
        classes.counted()
    }

    /// In one plane depths are equal, whatever the diagonals, and rounding decides unless it is the same triangles twice;
    /// apart by less than snapping moves them, rounding decides; apart by more, all is decided.
    #[test]
    fn surfaces_are_judged_before_they_are_snapped() {
        for other_diagonal in [false, true] {
            let found = classes(square(other_diagonal, 0.0));
            let [twice, equal] = [found.by_order, found.equal];
            assert!(found.decided < 200 && found.by_rounding == equal, "{found:?}");
            let is_as_drawn =
                if other_diagonal { equal > 5000 } else { twice > 5000 && equal < 200 };
            assert!(is_as_drawn, "{twice} {equal}");
            let found = classes(square(other_diagonal, 1e-6));
            assert!(found.equal == 0 && found.by_rounding > 5000 && found.decided < 200);
            let found = classes(square(other_diagonal, 0.1));
            assert!(found.equal == 0 && found.by_rounding < 200 && found.decided > 5000);
        }
    }
}
