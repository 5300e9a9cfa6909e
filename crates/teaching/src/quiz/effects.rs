//! Effects on demand: what a picture calls for, and what not.

use std::sync::Arc;

use glam::{DMat4, DVec3, DVec4};

use super::{Solution, Text};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::effects::render::Rendered;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::{Item, Material, Scene, chapters, shapes, textures};

solvers!(overlap, divide, samples, back);

/// Columns and rows of the window.
const SIDE: u32 = 16;

/// A panel parallel to the screen, of one colour, from (x0, y0) to (x1, y1) in pixels.
fn panel([x0, y0, x1, y1]: [f64; 4]) -> Item {
    // From pixels to clip space, where y points up.
    let to_cube = |px: f64| px * 2.0 / f64::from(SIDE) - 1.0;
    let at = |x, y| DVec3::new(to_cube(x), -to_cube(y), 0.0);
    Item::new(
        shapes::quad([at(x0, y1), at(x1, y1), at(x1, y0), at(x0, y0)]),
        Material { colour: DVec3::new(0.2, 0.4, 0.8), ..Material::default() },
    )
}

/// Draws into a window of [`SIDE`]; the positions are those of clip space where w is 1.
fn draw(items: Vec<Item>, effects: &Effects, antialias: Antialias) -> Rendered {
    let scene = Scene { items, ..Scene::new("exercise", "of a page", DMat4::IDENTITY) };
    draw_scene(&scene, effects, antialias)
}

fn draw_scene(scene: &Scene, effects: &Effects, antialias: Antialias) -> Rendered {
    let mut target =
        Target::new(SIDE, SIDE, antialias, Default::default()).expect("a small target");
    Drawer::Scanline.render(scene, effects, &mut target).expect("a sound scene")
}

/// Which picture needs depth tests, by the plan.
fn overlap(_: &[Text]) -> Solution {
    // One panel, two beside each other, and two that overlap.
    let [short, long] = [7.0, 9.0].map(|end| panel([1.0, 1.0, end, 15.0]));
    let right = panel([8.0, 1.0, 15.0, 15.0]);
    let frames = [vec![short.clone()], vec![short, right.clone()], vec![long, right]];
    let always = depth_tests(frames[1].clone(), &Effects::ALWAYS);
    let planned = frames.map(|items| depth_tests(items, &Effects::PLANNED));
    Solution::choice(&planned.map(|count| count > 0)).figure(always).figure(planned[1])
}

fn depth_tests(items: Vec<Item>, effects: &Effects) -> u64 {
    draw(items, effects, Antialias::None).counters.depth_tests
}

/// A triangle in the window, of two or of one colour at its corners, with w = 1 + `slope` x.
fn leaning(slope: f64, colours: [DVec3; 3]) -> Item {
    let corners = [DVec3::new(-0.5, -0.5, 0.0), DVec3::new(0.5, -0.5, 0.0), DVec3::Y * 0.5];
    let material = Material { vertex_colours: true, ..Material::default() };
    let mut item = Item::new(shapes::triangle(corners, colours), material);
    item.model.x_axis = DVec4::new(1.0, 0.0, 0.0, slope);
    item
}

/// Which triangle needs divisions: one whose w and whose colours both differ between its corners.
fn divide(_: &[Text]) -> Solution {
    let (same, different) = ([DVec3::ONE; 3], [DVec3::X, DVec3::Y, DVec3::Z]);
    let cases = [(0.0, different), (0.001, same), (0.001, different)];
    let divisions = cases.map(|(slope, colours)| {
        let items = vec![leaning(slope, colours)];
        draw(items, &Effects::PLANNED, Antialias::None).counters.divisions
    });
    Solution::choice(&divisions.map(|count| count > 0)).figure(divisions[2])
}

/// How many pixels of a panel get samples of their own: those on its border.
fn samples(_: &[Text]) -> Solution {
    let items = vec![panel([2.5, 2.5, 13.5, 13.5])];
    let counters = draw(items, &Effects::PLANNED, Antialias::Supersample(4)).counters;
    let border = 12 * 12 - 10 * 10;
    Solution::count(counters.expanded)
        .figure(border)
        .figure(counters.expanded - border)
        .figure(SIDE * SIDE * 16)
}

/// How many triangles of a closed and opaque body the plan culls, if the material does not ask for it, and if it does.
fn back(_: &[Text]) -> Solution {
    let centre = DVec3::new(0.0, 0.0, 4.0);
    let material =
        Material { texture: Some(Arc::new(textures::checkerboard())), ..Material::default() };
    let mesh = shapes::cuboid(centre - DVec3::ONE, centre + DVec3::ONE);
    let culled = |cull| {
        let mut scene = chapters::scene("cube", 1.0, 0.0).expect("a scene of the book");
        scene.items = vec![Item { cull, ..Item::new(mesh.clone(), material.clone()) }];
        draw_scene(&scene, &Effects::PLANNED, Antialias::None).counters.culled
    };
    Solution::count(culled(Cull::None)).figure(culled(Cull::Clockwise))
}
