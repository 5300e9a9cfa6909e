//! Scenes that call for effects beyond the book: what real models ask for.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::chapters::{AHEAD, Entry, daylight, turned, with};
use super::{Item, Material, Scene, Shading, shapes, textures};
use crate::pipeline::assemble::Cull;
use crate::pipeline::fog::{Fog, Growth};
use crate::pipeline::highlight::Specular;
use crate::pipeline::texture::{Filter, Wrap};
use rasterproof_core::angle::turn_y;

/// Every such scene. The digests of frames are of the book's scenes alone.
pub const SCENES: &[Entry] = &[
    Entry {
        name: "highlights",
        about: "spheres with specular light of the exponents 5, 30 and 200 on a matt floor",
        build: highlights,
    },
    Entry {
        name: "mip-maps",
        about: "a floor of checks to the horizon and a board, each with a mip map; the board is magnified",
        build: mip_maps,
    },
    Entry {
        name: "fog",
        about: "two rows of pillars into the distance, in fog from 4 to 12 from the eye",
        build: fog,
    },
];

fn highlights(scene: Scene, turn: f64) -> Scene {
    let mut floor = shapes::quad([
        DVec3::new(-9.0, -1.3, 1.0),
        DVec3::new(9.0, -1.3, 1.0),
        DVec3::new(9.0, -1.3, 18.0),
        DVec3::new(-9.0, -1.3, 18.0),
    ]);
    for corner in floor.triangles.as_flattened_mut() {
        corner.uv *= 4.0;
    }
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

fn fog(scene: Scene, turn: f64) -> Scene {
    let background = [196, 204, 214, u8::MAX];
    let [r, g, b, _] = background;
    let growth = Growth::Linear { start: 4.0, end: 12.0 };
    let floor = shapes::quad([
        DVec3::new(-9.0, -1.0, 1.5),
        DVec3::new(9.0, -1.0, 1.5),
        DVec3::new(9.0, -1.0, 12.0),
        DVec3::new(-9.0, -1.0, 12.0),
    ]);
    let green = Material {
        colour: DVec3::new(0.42, 0.50, 0.34),
        shading: Shading::Phong,
        ..Material::default()
    };
    let mut items = vec![Item::new(floor, green)];
    let texture = Arc::new(textures::boards().with(Filter::Bilinear, Wrap::Clamp));
    let boards =
        Material { texture: Some(texture), shading: Shading::Phong, ..Material::default() };
    for row in 0..8 {
        for side in [-1.0, 1.0] {
            let centre = DVec3::new(1.3 * side, -0.1, 2.6 + 1.7 * f64::from(row));
            let reach = DVec3::new(0.35, 0.9, 0.35);
            let pillar = Item::new(shapes::cuboid(centre - reach, centre + reach), boards.clone());
            let turned = turned(pillar, centre, turn_y(0.3 * side + turn * TAU));
            items.push(Item { cull: Cull::Clockwise, ..turned });
        }
    }
    let fog = Some(Fog { colour: [r, g, b], growth });
    Scene { light: daylight(), fog, background, ..with(scene, items) }
}

fn mip_maps(scene: Scene, turn: f64) -> Scene {
    let checks = textures::checkerboard().with(Filter::Bilinear, Wrap::Repeat).with_mip_map();
    let boards = textures::boards().with(Filter::Bilinear, Wrap::Clamp).with_mip_map();
    let material = |texture| Material { texture: Some(Arc::new(texture)), ..Material::default() };
    let mut floor = shapes::quad([
        DVec3::new(-60.0, -1.0, 1.2),
        DVec3::new(60.0, -1.0, 1.2),
        DVec3::new(60.0, -1.0, 19.9),
        DVec3::new(-60.0, -1.0, 19.9),
    ]);
    for corner in floor.triangles.as_flattened_mut() {
        corner.uv *= DVec2::new(48.0, 8.0);
    }
    let at = |x: f64, y: f64| AHEAD + DVec3::new(x, y, -1.2);
    let board = shapes::quad([at(-0.7, -0.6), at(0.7, -0.6), at(0.7, 0.8), at(-0.7, 0.8)]);
    let board = turned(Item::new(board, material(boards)), AHEAD, turn_y(turn * TAU));
    with(scene, [Item::new(floor, material(checks)), board])
}
