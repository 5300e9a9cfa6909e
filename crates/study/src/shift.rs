//! What corners on a grid change in the values that are seen: half a step moves them by much where a triangle is steep.

use glam::DVec2;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::triangle::ScreenTriangle;
use rasterproof_render::scene::{Corner, Item, Scene, Shading};

use crate::grid::Value;
use crate::ties::Surfaces;
use crate::view::{Piece, Sampled};

/// What corners on a grid change at most in the values of a picture; nothing where no value changes.
#[derive(Clone, Copy, Debug, Default, serde::Serialize)]
pub struct Shift {
    pub depth: Option<Shifted>,
    /// In texels of the texture of the face.
    pub texels: Option<Shifted>,
    /// A channel of the colours at corners, in steps of 8 bits.
    pub colour: Option<Shifted>,
    /// The direction of the interpolated normal, in degrees.
    pub normal: Option<Shifted>,
}

/// A value that corners on a grid change, by how much and where.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct Shifted {
    pub by: f64,
    pub pixel: [i32; 2],
    /// The triangle that is seen there, from 0 in drawing order.
    pub triangle: u32,
}

/// A pixel, and the triangle that is seen there.
#[derive(Clone, Copy)]
struct Place {
    pixel: [i32; 2],
    triangle: u32,
}

impl Place {
    /// Keeps a change of a value here, if it is the largest so far; of equal ones the first.
    fn keep(self, largest: &mut Option<Shifted>, by: f64) {
        if by > largest.map_or(0.0, |largest| largest.by) {
            *largest = Some(Shifted { by, pixel: self.pixel, triangle: self.triangle });
        }
    }
}

/// By how much values at samples differ from those of the same faces with corners as they are given.
pub(crate) fn shift(scene: &Scene, surfaces: &[Surfaces<'_>], sampled: &Sampled) -> Shift {
    let mut shift = Shift::default();
    // The number of the first triangle of each item.
    let mut firsts = Vec::with_capacity(scene.items.len());
    let mut triangles = 0;
    for item in &scene.items {
        firsts.push(triangles);
        triangles += item.mesh.triangles.len();
    }
    let window = sampled.window;
    for (surfaces, pieces) in surfaces.iter().zip(&sampled.planes) {
        for y in window.y0..window.y1 {
            for x in window.x0..window.x1 {
                let Some(front) = surfaces.front([x, y]) else { continue };
                let piece = &pieces[front as usize];
                let centre = [x, y].map_array(|at| f64::from(at) + 0.5);
                let triangle = with_shares(piece);
                // The same face at the same sample, with its corners in both places.
                let (Some(given), Some(snapped)) = (
                    Value::at(centre, &triangle, piece.px),
                    Value::at(centre, &triangle, sampled.grid.place(piece.px)),
                ) else {
                    continue;
                };
                let place = Place { pixel: sampled.pixel([x, y]), triangle: piece.face };
                place.keep(&mut shift.depth, (snapped.depth - given.depth).abs());
                let item = &scene.items[piece.item as usize];
                let number = piece.face as usize - firsts[piece.item as usize];
                let shares = [given.varying, snapped.varying];
                attributes(&mut shift, place, item, &item.mesh.triangles.at(number), shares);
            }
        }
    }
    shift
}

/// The triangle of a piece with the shares of the second and the third corner of its face as what it carries.
fn with_shares(piece: &Piece) -> ScreenTriangle<DVec2> {
    let mut triangle = piece.triangle;
    for (vertex, shares) in triangle.vertices.iter_mut().zip(piece.shares) {
        vertex.varying = shares;
    }
    triangle
}

/// Keeps what the attributes of a face change by at a pixel, where its corners have these shares with corners as given, and snapped.
fn attributes(
    shift: &mut Shift,
    place: Place,
    item: &Item,
    corners: &[Corner; 3],
    [given, snapped]: [DVec2; 2],
) {
    let [a, b, c] = corners;
    let moved = snapped - given;
    // Everything that is linear in the shares moves by the difference of corners times that of the shares.
    if let Some(texture) = &item.material.texture {
        let (width, height) = texture.size();
        let uv = ((b.uv - a.uv) * moved.x + (c.uv - a.uv) * moved.y).abs();
        place.keep(&mut shift.texels, (uv.x * f64::from(width)).max(uv.y * f64::from(height)));
    }
    let colour = (b.colour - a.colour) * moved.x + (c.colour - a.colour) * moved.y;
    place.keep(&mut shift.colour, colour.abs().max_element() * 255.0);
    if matches!(item.material.shading, Shading::Gouraud | Shading::Phong) {
        let normal = |shares: DVec2| {
            a.normal + (b.normal - a.normal) * shares.x + (c.normal - a.normal) * shares.y
        };
        let [one, other] = [normal(given), normal(snapped)];
        // The angle by its tangent: its cosine would lose half the digits of a small one.
        let angle = libm::atan2(one.cross(other).length(), one.dot(other));
        place.keep(&mut shift.normal, angle.to_degrees());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat4, DVec3};
    use rasterproof_render::pipeline::depth::DepthFormat;
    use rasterproof_render::pipeline::target::{Antialias, Target};
    use rasterproof_render::pipeline::texture::Texture;
    use rasterproof_render::scene::{Item, Material, Mesh};

    const SIDE: u32 = 64;
    /// The left corner of a narrow triangle, which lies 0.4 steps beside the grid; the others lie on it.
    const LEFT: f64 = 10.4;
    const RIGHT: f64 = 10.6015625;
    const POINT: f64 = 10.5;

    /// A triangle of column 10, as wide as a fifth of a pixel in the first row, with a value of its own at each corner.
    fn narrow(shading: Shading) -> Scene {
        let half = f64::from(SIDE) / 2.0;
        let at = |x: f64, y: f64, depth: f64| DVec3::new(x / half - 1.0, 1.0 - y / half, depth);
        let positions =
            vec![at(LEFT, 0.0, -1.0), at(RIGHT, 0.0, 1.0), at(POINT, f64::from(SIDE), -1.0)];
        let corner = |position: u32| Corner {
            position,
            colour: [DVec3::ZERO, DVec3::Y, DVec3::ZERO][position as usize],
            normal: [DVec3::X, DVec3::Z, DVec3::Z][position as usize],
            uv: [DVec2::ZERO, DVec2::new(0.0, 4.0), DVec2::ZERO][position as usize],
        };
        let triangles = [[corner(0), corner(1), corner(2)]].into_iter().collect();
        let texture = Texture::new(2, 2, &[[255, 0, 0], [0, 255, 0], [0, 0, 255], [0; 3]]);
        let material =
            Material { texture: texture.map(Into::into), shading, ..Material::default() };
        let mut scene = Scene::new("test", "", DMat4::IDENTITY);
        scene.items.push(Item::new(Mesh { positions: positions.into(), triangles }, material));
        scene
    }

    /// The share of the right corner in the middle of column 10, by similar triangles.
    fn share(left: f64, below: f64) -> f64 {
        let ends = [left, RIGHT].map_array(|x| x + below * (POINT - x));
        (1.0 - below) * (POINT - ends[0]) / (ends[1] - ends[0])
    }

    #[test]
    fn each_attribute_moves_as_similar_triangles_say() {
        let snapped_left = (LEFT * 256.0).round() / 256.0;
        // The same for each row: how far down it lies, and both shares.
        let rows: Vec<[f64; 3]> = (0..SIDE)
            .map(|row| {
                let below = (f64::from(row) + 0.5) / f64::from(SIDE);
                [below, share(LEFT, below), share(snapped_left, below)]
            })
            .collect();
        let largest = |value: &dyn Fn([f64; 2]) -> f64| {
            let moved = rows.iter().map(|[below, given, snapped]| {
                (value([*below, *snapped]) - value([*below, *given])).abs()
            });
            moved.fold(0.0, f64::max)
        };
        let wanted = [
            largest(&|[_, share]| share),
            largest(&|[_, share]| share * 4.0 * 2.0),
            largest(&|[_, share]| share * 255.0),
            largest(&|[below, share]| {
                let second = share + below;
                libm::atan2(second, 1.0 - second).to_degrees()
            }),
        ];
        let target = Target::new(SIDE, SIDE, Antialias::None, DepthFormat::F64).unwrap();
        let shift_of = |shading: Shading| {
            let scene = narrow(shading);
            let sampled = Sampled::of(&scene, &target).unwrap();
            let surfaces = Surfaces::of(&scene, sampled.at_centres(), sampled.window);
            shift(&scene, &[surfaces], &sampled)
        };
        let found = shift_of(Shading::Phong);
        let found = [found.depth, found.texels, found.colour, found.normal];
        // A corner is within 2^-47 px of where it should be, so that a share is within 2^-43, and a value within 2^-34.
        for (wanted, found) in wanted.into_iter().zip(found) {
            let found = found.unwrap();
            assert!((found.by - wanted).abs() < 2f64.powi(-34), "{wanted} {found:?}");
            assert!(wanted > 1e-3 && found.pixel[0] == 10);
        }
        // What lies flat has no normal that is interpolated.
        assert!(shift_of(Shading::Flat).normal.is_none());
    }
}
