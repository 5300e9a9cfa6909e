//! How much there is to draw of a scene in a view, found before anything is drawn.

use glam::DVec4;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::clip::{clip, outcode};
use rasterproof_render::pipeline::opacity::AlphaMode;
use rasterproof_render::pipeline::shadow::LightView;
use rasterproof_render::scene::{Item, Scene};

/// What all commands that draw a scene have to do, hidden or not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Triangles that have a part in the window.
    pub triangles: u64,
    /// Rows of samples in which their parts in the window have samples, at most.
    pub rows: u64,
    /// Samples that their parts in the window cover, at most.
    pub samples: u64,
    /// Those of them that are of items which blend.
    pub blended: u64,
}

/// Triangles that are looked at together.
const SHARE: usize = 1 << 14;

impl Work {
    /// That of a scene in a window with one sample at the centre of each of its pixels.
    #[must_use]
    pub fn of(scene: &Scene, window: PixelRect) -> Self {
        let mut all = Self::default();
        for item in &scene.items {
            let of_item = of_item(scene, item, window);
            let opacity = item.material.opacity.as_ref();
            let blends = opacity.is_some_and(|opacity| opacity.mode == AlphaMode::Blend);
            all = all.with(Self { blended: if blends { of_item.samples } else { 0 }, ..of_item });
        }
        all
    }

    /// That of the shadow map of a scene, in its texels; nothing where there is none.
    #[must_use]
    pub fn of_map(scene: &Scene) -> Self {
        let Some(view) = LightView::new(scene) else { return Self::default() };
        let mut all = Self::default();
        for (number, item) in scene.items.iter().enumerate() {
            for triangle in item.mesh.triangles.positions() {
                let places = triangle.map_array(|position| view.place(number, position));
                all = all.with(of_corners(places.map_array(|place| [place.x, place.y])));
            }
        }
        all
    }

    /// The sum of both, at most the largest number: what is refused for its size is refused then, too.
    fn with(self, other: Self) -> Self {
        Self {
            triangles: self.triangles.saturating_add(other.triangles),
            rows: self.rows.saturating_add(other.rows),
            samples: self.samples.saturating_add(other.samples),
            blended: self.blended.saturating_add(other.blended),
        }
    }
}

/// The work of an item, whose triangles are shared between the threads.
fn of_item(scene: &Scene, item: &Item, window: PixelRect) -> Work {
    let matrix = scene.projection * scene.view * item.model;
    let size = [f64::from(window.width()), f64::from(window.height())];
    let shares: Vec<_> = item.mesh.triangles.positions().chunks(SHARE).collect();
    let of_shares = parallel::map(shares.len(), |number| {
        let mut work = Work::default();
        for triangle in shares[number] {
            let corners = triangle.map_array(|position| {
                let position = matrix * item.mesh.positions[position as usize].extend(1.0);
                ClipVertex { position, varying: 0.0 }
            });
            work = work.with(of_triangle(&corners, size));
        }
        work
    });
    of_shares.into_iter().fold(Work::default(), Work::with)
}

/// Where a vertex in clip space lies in a window of this size, in pixels and not snapped.
fn place(vertex: &ClipVertex<f64>, size: [f64; 2]) -> [f64; 2] {
    let DVec4 { x, y, w, .. } = vertex.position;
    [(x / w + 1.0) / 2.0 * size[0], (1.0 - y / w) / 2.0 * size[1]]
}

/// What a triangle has in the window; nothing where all of it is outside.
fn of_triangle(corners: &[ClipVertex<f64>; 3], size: [f64; 2]) -> Work {
    let [a, b, c] = corners;
    let [outside_a, outside_b, outside_c] = [outcode(a), outcode(b), outcode(c)];
    if outside_a & outside_b & outside_c != 0
        || !(a.position.is_finite() && b.position.is_finite() && c.position.is_finite())
    {
        return Work::default();
    }
    // Most triangles lie within the window as they are.
    let planes = outside_a | outside_b | outside_c;
    if planes == 0 {
        return of_corners([place(a, size), place(b, size), place(c, size)]);
    }
    // What clipping leaves is cut into triangles around its first corner, as the pipeline does.
    let (polygon, _) = clip(corners, planes);
    let mut placed = polygon.vertices().map(|vertex| place(vertex, size));
    let (Some(first), Some(mut before)) = (placed.next(), placed.next()) else {
        return Work::default();
    };
    let mut sum = Work::default();
    for next in placed {
        sum = sum.with(of_corners([first, before, next]));
        before = next;
    }
    Work { triangles: sum.triangles.min(1), ..sum }
}

/// In a convex shape lie at most as many points of a lattice as its area, half its circumference and 1 come to. Half the
/// circumference of a triangle is at most the width and the height of its box.
fn of_corners([a, b, c]: [[f64; 2]; 3]) -> Work {
    let area = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs() / 2.0;
    let width = a[0].max(b[0]).max(c[0]) - a[0].min(b[0]).min(c[0]);
    let height = a[1].max(b[1]).max(c[1]) - a[1].min(b[1]).min(c[1]);
    // The box of a sliver that lies along an axis has fewer of them.
    let of_box = (width + 1.0) * (height + 1.0);
    // NaN becomes 0.
    let samples = (area + width + height + 1.0).min(of_box).ceil() as u64;
    Work { triangles: 1, rows: height.ceil() as u64 + 1, samples, blended: 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use rasterproof_core::contract::Rasterize as _;
    use rasterproof_core::random::Rng;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_render::pipeline::transform::perspective;
    use rasterproof_render::scene::{Corner, Material, Mesh};

    use crate::view::pieces;

    /// Random triangles before, behind and across the eye cover no more samples than is said, and not far fewer.
    #[test]
    fn no_more_samples_are_covered_than_is_said() {
        let window = PixelRect::window(97, 61);
        let (mut covered_all, mut said_all) = (0, 0);
        for index in 0..500 {
            let mut rng = Rng::new("work", 1, index);
            let point = |rng: &mut Rng| {
                DVec3::new(rng.signed(), rng.signed(), rng.signed() + 0.7) * rng.unit() * 4.0
            };
            let positions: Vec<DVec3> = (0..3).map(|_| point(&mut rng)).collect();
            let corner = |position| Corner {
                position,
                colour: DVec3::ONE,
                normal: DVec3::Z,
                uv: glam::DVec2::ZERO,
            };
            let triangles = [[0, 1, 2].map(corner)].into_iter().collect();
            let mesh = Mesh { positions: positions.into(), triangles };
            let mut scene = Scene::new("one", "", perspective(1.0, 1.6, 0.1, 5.0).unwrap());
            scene.items = vec![Item::new(mesh, Material::default())];
            let (mut covered, mut spans) = (0, 0);
            for piece in pieces(&scene, window).unwrap() {
                Scanline.cover(piece.corners(), window, |span| {
                    covered += span.pixels() as u64;
                    spans += 1;
                });
            }
            let Work { triangles, rows, samples, blended } = Work::of(&scene, window);
            assert!(covered <= samples && spans <= rows, "{index}: {covered} of {samples}");
            assert!(triangles <= 1 && blended == 0, "{index}");
            (covered_all, said_all) = (covered_all + covered, said_all + samples);
        }
        assert!(covered_all > 20_000 && said_all < 2 * covered_all, "{covered_all} of {said_all}");
    }
}
