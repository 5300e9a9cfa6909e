//! Scenes that call for effects beyond the book: what real models ask for.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;

use super::chapters::{AHEAD, Entry, daylight, turned, with};
use super::{Item, Material, Scene, Shading, shapes, textures};
use crate::pipeline::assemble::Cull;
use crate::pipeline::highlight::Specular;
use crate::pipeline::texture::{Filter, Wrap};
use rasterproof_core::angle::turn_y;

/// Every such scene. The digests of frames are of the book's scenes alone.
pub const SCENES: &[Entry] = &[Entry {
    name: "highlights",
    about: "spheres with specular light of the exponents 5, 30 and 200 on a matt floor",
    build: highlights,
}];

fn highlights(scene: Scene, turn: f64) -> Scene {
    let floor = shapes::quad([
        DVec3::new(-9.0, -1.3, 1.0),
        DVec3::new(9.0, -1.3, 1.0),
        DVec3::new(9.0, -1.3, 18.0),
        DVec3::new(-9.0, -1.3, 18.0),
    ]);
    let texture = Arc::new(textures::checkerboard().with(Filter::Bilinear, Wrap::Repeat));
    let matt = Material { texture: Some(texture), shading: Shading::Phong, ..Material::default() };
    let mut items = vec![Item::new(floor, matt)];
    for (i, (colour, shininess)) in [
        (DVec3::new(0.75, 0.20, 0.16), 5.0),
        (DVec3::new(0.20, 0.50, 0.28), 30.0),
        (DVec3::new(0.22, 0.30, 0.62), 200.0),
    ]
    .into_iter()
    .enumerate()
    {
        let centre = AHEAD + DVec3::new(2.1 * (i as f64 - 1.0), -0.3, 0.8);
        let specular = Specular { colour: DVec3::splat(0.9), shininess };
        let material =
            Material { colour, specular, shading: Shading::Phong, ..Material::default() };
        let sphere = Item::new(shapes::sphere(centre, 1.0, 48, 24), material);
        items.push(Item { cull: Cull::Clockwise, ..turned(sphere, AHEAD, turn_y(turn * TAU)) });
    }
    Scene { light: daylight(), ..with(scene, items) }
}
