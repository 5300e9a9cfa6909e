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
    if !scene.items.iter().any(may_show_back) || scene.triangles() > MOST_TRIANGLES {
        return None;
    }
    // Fronts are red and backs are green. What is lit from both sides hides them and counts as neither.
    let mut sides = scene.clone();
    sides.items.clear();
    for item in &scene.items {
        if may_show_back(item) {
            sides.items.push(painted(item, DVec3::X, Cull::Clockwise));
            sides.items.push(painted(item, DVec3::Y, Cull::CounterClockwise));
        } else {
            sides.items.push(painted(item, DVec3::Z, item.cull));
        }
    }
    // Nothing may mix with the two colours, which are counted.
    (sides.fog, sides.shadows, sides.layers) = (None, None, None);
    sides.background = [0, 0, 0, u8::MAX];
    let frame = frames::render(&sides, SIDE_PX, SIDE_PX, Samples::One).ok()?;
    let (mut fronts, mut backs) = (0u32, 0u32);
    for (_, row) in frame.rows() {
        for [red, green, ..] in row {
            fronts += u32::from(*red > 0);
            backs += u32::from(*green > 0);
        }
    }
    let (fronts, backs) = (f64::from(fronts), f64::from(backs));
    (fronts + backs > 0.0).then(|| backs / (fronts + backs))
}

/// Whether an item shows its back lit by the normals of the front.
fn may_show_back(item: &Item) -> bool {
    item.material.shading != Shading::Unlit && !item.two_sided && item.cull == Cull::None
}

/// An item in one colour, without light.
fn painted(item: &Item, colour: DVec3, cull: Cull) -> Item {
    let material = Material { colour, ..Material::default() };
    Item { material, cull, ..item.clone() }
}
