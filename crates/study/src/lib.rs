//! A study of a model in a view: which hard cases it contains, what its accuracy costs, and which effects it calls
//! for. It prints nothing.

pub mod bounds;
pub mod corner_grid;
pub mod cost;
pub mod effects;
pub mod facing;
pub mod grid;
pub mod hard;
pub mod report;
pub mod savings;
mod shape;
mod shift;
pub mod snapping;
pub mod ties;
pub mod view;
mod winding;
pub mod work;

use rasterproof_models::Origin;
use rasterproof_render::scene::Scene;

/// The item of a triangle and its number there, by its number in the scene, from 0 in drawing order; none beyond the
/// last.
pub fn triangle_of(scene: &Scene, triangle: u32) -> Option<(usize, usize)> {
    let mut number = triangle as usize;
    for (item, of) in scene.items.iter().enumerate() {
        let count = of.mesh.triangles.len();
        if number < count {
            return Some((item, number));
        }
        number -= count;
    }
    None
}

/// The number of a triangle's face, from 1: in the file where the scene is of one, else in the scene.
pub fn face_of(scene: &Scene, origins: &[Origin], triangle: u32) -> u32 {
    let of_file =
        triangle_of(scene, triangle).and_then(|(item, number)| origins.get(item)?.face(number));
    of_file.unwrap_or(triangle + 1)
}

/// The numbers that [`face_of`] gives to all triangles, in drawing order.
pub fn faces<'a>(scene: &'a Scene, origins: &'a [Origin]) -> impl Iterator<Item = u32> + 'a {
    // Triangles of the items before the one that is walked.
    let mut before = 0;
    scene.items.iter().enumerate().flat_map(move |(item, of)| {
        let first = before;
        before += of.mesh.triangles.len();
        let of_file = move |number| origins.get(item).and_then(|origin| origin.face(number));
        let face = move |number| of_file(number).unwrap_or((first + number) as u32 + 1);
        (0..of.mesh.triangles.len()).map(face)
    })
}
