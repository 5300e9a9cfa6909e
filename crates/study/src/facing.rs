//! Which side of a model the eye sees: faces that run inwards are lit as if from behind.

use glam::DVec3;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::scene::{Item, Material, Scene, Shading};
use rasterproof_tiles::frames::{self, Samples};

/// Pixels along a side of the picture in which sides are counted.
const SIDE_PX: u32 = 128;

/// More triangles than this are not drawn a second time for a note.
const MOST_TRIANGLES: usize = 1 << 24;

/// Of the pixels in which a lit surface is seen, the share that shows its back, lit by the normals of the front; nothing
/// where no such surface is seen.
#[must_use]
pub fn share_of_backs(scene: &Scene) -> Option<f64> {
    let is_asked = |item: &Item| {
        let is_lit = item.material.shading != Shading::Unlit;
        is_lit && !item.two_sided && item.cull == Cull::None
    };
    if !scene.items.iter().any(is_asked) || scene.triangles() > MOST_TRIANGLES {
        return None;
    }
    let painted = |item: &Item, colour: DVec3, cull: Cull| Item {
        material: Material { colour, ..Material::default() },
        cull,
        ..item.clone()
    };
    // Fronts are red and backs are green. What is lit from both sides hides them and counts as neither.
    let sides = |item: &Item| match is_asked(item) {
        true => vec![
            painted(item, DVec3::X, Cull::Clockwise),
            painted(item, DVec3::Y, Cull::CounterClockwise),
        ],
        false => vec![painted(item, DVec3::Z, item.cull)],
    };
    let mut painted = scene.clone();
    painted.items = scene.items.iter().flat_map(sides).collect();
    (painted.fog, painted.shadows, painted.layers) = (None, None, None);
    painted.background = [0, 0, 0, u8::MAX];
    let frame = frames::render(&painted, SIDE_PX, SIDE_PX, Samples::One).ok()?;
    let count = |channel: usize| {
        let rows = frame.rows().map(|(_, row)| row.iter().filter(|colour| colour[channel] > 0));
        rows.map(Iterator::count).sum::<usize>() as f64
    };
    let (fronts, backs) = (count(0), count(1));
    (fronts + backs > 0.0).then(|| backs / (fronts + backs))
}
