//! Which surface is seen at each pixel, judged before corners are snapped: decided, decided by rounding alone, or equal.
//!
//! The depth of a piece at a pixel centre is that of its plane through the corners as they are. Two depths are equal
//! where they lie within what the doubles of the vertex stage and of the plane may be off, and decided by rounding
//! where they lie within what snapping may move them besides. Which pieces cover a pixel is what is drawn.

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::raster::scanline::Scanline;

use crate::view::{NOTHING, Piece, Sampled};

/// How it is decided which surface is seen at a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// No piece covers it.
    #[default]
    Empty,
    Decided,
    ByRounding,
    Equal,
}

/// How many pixels are of each class, which is the least decided one of their samples, and the first of the last two with the pieces that compete.
#[derive(Clone, Debug)]
pub struct Classes {
    pub map: Frame<Class>,
    pub decided: u64,
    pub by_rounding: u64,
    pub equal: u64,
    pub first_by_rounding: Option<TiedPair>,
    pub first_equal: Option<TiedPair>,
}

/// A pixel and two triangles of the scene, the nearer one first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TiedPair {
    pub pixel: [i32; 2],
    pub triangles: [u32; 2],
}

/// A depth over the window, before corners are snapped.
struct DepthPlane {
    from: [f64; 3],
    slope: [f64; 2],
    /// The same with every term positive, times what the terms may be off.
    terms: [f64; 2],
    /// What a depth may be off at any pixel, but for the terms.
    off: f64,
    /// What snapping may do besides.
    snapping: f64,
}

const U: f64 = f64::EPSILON / 2.0;

impl DepthPlane {
    /// None for a piece that has no area before it is snapped.
    ///
    /// In units of u, as for the rungs of interpolation: with k the cancellation of the area, a slope is off by
    /// (7 + 3 k) times its terms, and the sum by twice the depth of the corner. What the vertex stage is off moves the
    /// depth by that of a corner, and by the slope times that of a position.
    fn of(piece: &Piece) -> Option<Self> {
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
    fn at(&self, x_px: i32, y_px: i32) -> [f64; 3] {
        let [x, y, z] = self.from;
        let (dx, dy) = (f64::from(x_px) + 0.5 - x, f64::from(y_px) + 0.5 - y);
        let off = self.off + self.terms[0] * dx.abs() + self.terms[1] * dy.abs();
        let z = z + self.slope[0] * dx + self.slope[1] * dy;
        [z, off, off + self.snapping]
    }
}

/// The nearest piece at the samples of each pixel before corners are snapped, and how well it is known to be the
/// nearest.
pub fn classify(sampled: &Sampled) -> Classes {
    let mut map = Frame::new(sampled.size, Class::Empty);
    let mut pairs = Frame::new(sampled.size, [NOTHING; 2]);
    for pieces in &sampled.planes {
        let (classes, of_samples) = of_plane(pieces, sampled.window);
        for (y, row) in classes.rows() {
            for ((x, class), pair) in (sampled.window.x0..).zip(row).zip(of_samples.row(y)) {
                let [x_px, y_px] = sampled.pixel([x, y]);
                let held = &mut map.span_mut(y_px, x_px, x_px + 1)[0];
                if class > held {
                    *held = *class;
                    pairs.span_mut(y_px, x_px, x_px + 1)[0] = *pair;
                }
            }
        }
    }
    let count = |class: Class| {
        let all = map.rows().flat_map(|(_, row)| row);
        all.filter(|held| **held == class).count() as u64
    };
    let first = |class: Class| {
        map.rows().find_map(|(y, row)| {
            let x = row.iter().position(|held| *held == class)? as i32 + sampled.size.x0;
            Some(TiedPair { pixel: [x, y], triangles: pairs.get(x, y)? })
        })
    };
    Classes {
        decided: count(Class::Decided),
        by_rounding: count(Class::ByRounding),
        equal: count(Class::Equal),
        first_by_rounding: first(Class::ByRounding),
        first_equal: first(Class::Equal),
        map,
    }
}

/// The class of each sample of a plane, and the triangles that compete for it.
fn of_plane(pieces: &[Piece], window: PixelRect) -> (Frame<Class>, Frame<[u32; 2]>) {
    let nothing = (f64::INFINITY, NOTHING);
    let mut nearest = Frame::new(window, nothing);
    let planes: Vec<Option<DepthPlane>> = pieces.iter().map(DepthPlane::of).collect();
    let each = |see: &mut dyn FnMut(u32, &DepthPlane, i32, i32)| {
        for (number, (piece, plane)) in pieces.iter().zip(&planes).enumerate() {
            let Some(plane) = plane else { continue };
            Scanline.cover(piece.corners(), window, |span| {
                for x in span.x0_px..span.x1_px {
                    see(number as u32, plane, x, span.y_px);
                }
            });
        }
    };
    each(&mut |number, plane, x, y| {
        let [z, ..] = plane.at(x, y);
        let held = &mut nearest.span_mut(y, x, x + 1)[0];
        if z < held.0 {
            *held = (z, number);
        }
    });
    let mut map = Frame::new(window, Class::Empty);
    let mut pairs = Frame::new(window, [NOTHING; 2]);
    each(&mut |number, plane, x, y| {
        let class = &mut map.span_mut(y, x, x + 1)[0];
        *class = (*class).max(Class::Decided);
        let (near, other) = nearest.get(x, y).unwrap_or(nothing);
        if number == other {
            return;
        }
        let Some(Some(front)) = planes.get(other as usize) else { return };
        let ([_, off, wide], [z, own_off, own_wide]) = (front.at(x, y), plane.at(x, y));
        let found = match z - near {
            gap if gap <= off + own_off => Class::Equal,
            gap if gap <= wide + own_wide => Class::ByRounding,
            _ => return,
        };
        if found > *class {
            *class = found;
            let pair = [other, number].map_array(|piece| pieces[piece as usize].face);
            pairs.span_mut(y, x, x + 1)[0] = pair;
        }
    });
    (map, pairs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat4, DVec2, DVec3};
    use rasterproof_render::pipeline::depth::DepthFormat;
    use rasterproof_render::pipeline::target::{Antialias, Target};
    use rasterproof_render::pipeline::transform::perspective;
    use rasterproof_render::scene::{Corner, Item, Material, Mesh, Scene};

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

    fn classes(second: Item) -> [u64; 3] {
        let mut scene = Scene::new("two", "", perspective(0.7, 1.0, 1.0, 10.0).unwrap());
        scene.view = DMat4::IDENTITY;
        scene.items = vec![square(false, 0.0), second];
        let target = Target::new(200, 200, Antialias::None, DepthFormat::Unorm32).unwrap();
        let found = classify(&Sampled::of(&scene, &target).unwrap());
        [found.decided, found.by_rounding, found.equal]
    }

    /// In one plane depths are equal, whatever the diagonals; apart by less than snapping moves them, rounding decides;
    /// apart by more, all is decided.
    #[test]
    fn surfaces_are_judged_before_they_are_snapped() {
        for other_diagonal in [false, true] {
            let [decided, by_rounding, equal] = classes(square(other_diagonal, 0.0));
            assert!(
                equal > 5000 && by_rounding == 0 && decided < 200,
                "{decided} {by_rounding} {equal}"
            );
            let [decided, by_rounding, equal] = classes(square(other_diagonal, 1e-6));
            assert!(
                equal == 0 && by_rounding > 5000 && decided < 200,
                "{decided} {by_rounding} {equal}"
            );
            let [decided, by_rounding, equal] = classes(square(other_diagonal, 0.1));
            assert!(
                equal == 0 && by_rounding < 200 && decided > 5000,
                "{decided} {by_rounding} {equal}"
            );
        }
    }
}
