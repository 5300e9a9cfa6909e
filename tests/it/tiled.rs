//! Frames in tiles: their values against the oracle within the derived bound, their coverage against
//! the other engines exactly, and no trace of tiles, threads or instruction sets.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use rasterproof_core::contract::Interpolate;
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::pixel_box;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Fragment;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::multisample::{SAMPLES, moved};
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::pipeline::texture::{Filter, Wrap};
use rasterproof_render::scene::chapters;
use rasterproof_render::scene::{Hidden, Material, Scene, meshes, random, textures};
use rasterproof_tiles::coverage::Tiles;
use rasterproof_tiles::frames::planes::{Bounded, MOST_ATTRIBUTE};
use rasterproof_tiles::frames::{self, Division, HandedOver, Samples, TilesError};
use rasterproof_verify::cases::triangles::FAMILIES;
use rasterproof_verify::cases::{Shape, Triangle};
use rasterproof_verify::comparison::tolerance;
use rasterproof_verify::oracle::Oracle;

use crate::scenes::target_of;

/// The centre of a pixel, and the four samples, in 1/16 px.
const PLACES: [(i32, i32); 5] = [(8, 8), SAMPLES[0], SAMPLES[1], SAMPLES[2], SAMPLES[3]];

/// The box of a triangle in a window, as far as it has pixels there.
fn box_of(triangle: &Triangle, window: PixelRect) -> PixelRect {
    pixel_box(&triangle.corners(), 0).intersect(&window)
}

/// Every value of every covered pixel and sample lies within the bound of the exact one, and somewhere the
/// bound is used: a bound that is thousands of times too wide would say nothing.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn values_lie_within_their_bound() {
    for family in FAMILIES {
        let mut largest: f64 = 0.0;
        for index in 0..40 {
            let case = family.case(0x0066_3332, index);
            let Shape::Triangles { list, .. } = &case.shape else { unreachable!() };
            for triangle in list {
                let corners = triangle.vertices.map(|v| v.bare());
                // The two attributes, first and last.
                let values = triangle.vertices.map(|v| {
                    let [first, last] = v.varying.to_array();
                    [first, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, last]
                });
                let bounds = box_of(triangle, case.window);
                let bounded = |engine| Bounded::new(engine, &corners, &values, bounds, false);
                let planes = bounded(Tiles::default());
                for engine in Tiles::levels() {
                    // As text, for those of a triangle without area are no numbers.
                    let [a, b] = [planes, bounded(engine)].map(|planes| format!("{planes:?}"));
                    assert_eq!(a, b, "{}", engine.instructions());
                }
                let rounded = |i: usize| {
                    tolerance::ORACLE.attribute.at(triangle.vertices.map(|v| v.varying[i]))
                };
                let exact = tolerance::ORACLE.depth.at(triangle.vertices.map(|v| v.depth));
                for place in PLACES {
                    let Some(moved) = moved(triangle, place) else { continue };
                    let [right, down] = [place.0, place.1].map(|at| f64::from(at - 8) / 16.0);
                    Oracle.fragments(&moved, case.window, |f: Fragment<DVec2>| {
                        let (x, y) = (f64::from(f.x_px) + right, f64::from(f.y_px) + down);
                        for i in 0..2 {
                            let (value, bound) = planes.value(7 * i, x, y);
                            let off = (f64::from(value) - f.varying[i]).abs();
                            assert!(
                                off <= bound + rounded(i) || bound == f64::INFINITY,
                                "{} {index}: {value} for {}, bound {bound:e}",
                                family.name,
                                f.varying[i]
                            );
                            largest = largest.max(off / bound);
                        }
                        let (depth, bound) = planes.depth_at(x, y);
                        let off = (f64::from(depth) - f.depth).abs();
                        assert!(off <= bound + exact, "{} {index}: depth {depth}", family.name);
                    });
                }
            }
        }
        println!("{}: up to {largest:.3} of the bound", family.name);
        // Of the design only the pixels count: its values are 0.
        let drawn = !["degenerate", "off-screen", "w-extreme", "design"].contains(&family.name);
        assert!(largest > 0.01 || !drawn, "{}: the bound is empty, {largest}", family.name);
    }
}

fn by_scanline(scene: &Scene, width: u32, height: u32, samples: Samples) -> Frame<Colour> {
    let antialias = match samples {
        Samples::One => Antialias::None,
        Samples::Four => Antialias::Multisample4,
    };
    let mut target = target_of(width, height, antialias);
    Drawer::Scanline.render(scene, &Effects::PLANNED, &mut target).unwrap().picture
}

fn scenes() -> Vec<Scene> {
    let named = chapters::entries().map(|entry| chapters::scene(entry.name, 1.5, 0.1).unwrap());
    let random = (0..12).map(|index| {
        let mut scene = random::scene(1, index);
        scene.items.iter_mut().step_by(2).for_each(|item| item.two_sided = true);
        scene
    });
    let all = named.chain(random).chain(meshes::scene("knot-4000"));
    all.filter(|scene| frames::not_drawn(scene) == 0).collect()
}

/// With one colour for everything, a pixel shows how many of its samples anything covers: bit for
/// bit, whatever lies in front.
#[test]
fn coverage_is_that_of_the_engines() {
    for mut scene in scenes() {
        for item in &mut scene.items {
            item.material = Material::default();
        }
        scene.fog = None;
        for samples in [Samples::One, Samples::Four] {
            let tiles = frames::render(&scene, 201, 134, samples).unwrap();
            let engine = by_scanline(&scene, 201, 134, samples);
            assert!(tiles == engine, "{} with {samples:?}", scene.name);
        }
    }
}

/// The same bits from one thread and from many, and in every instruction set.
#[test]
fn neither_threads_nor_instructions_leave_a_trace() {
    for scene in scenes() {
        let draw = |threads: usize, tiles: Tiles, samples: Samples| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| frames::render_in(tiles, &scene, 201, 134, samples).unwrap())
        };
        for samples in [Samples::One, Samples::Four] {
            let one = draw(1, Tiles::default(), samples);
            assert!([2, 5].iter().all(|&count| one == draw(count, Tiles::default(), samples)));
            for tiles in Tiles::levels() {
                assert!(one == draw(1, tiles, samples), "{} {}", scene.name, tiles.instructions());
            }
        }
    }
}

/// Meshes in colours of their own, more triangles than a part of the bins has.
fn painted(names: &[(&str, [u8; 3])], hidden: Hidden) -> Scene {
    let mut scene = meshes::scene(names[0].0).unwrap();
    scene.items = names
        .iter()
        .map(|(name, colour)| {
            let mut item = meshes::scene(name).unwrap().items.remove(0);
            let colour = DVec3::from(colour.map(f64::from)) / 255.0;
            item.material = Material { colour, ..Material::default() };
            item
        })
        .collect();
    scene.hidden = hidden;
    scene
}

/// Where the order of pieces decides what is seen, it is that of the engines, over several parts of the
/// bins: without depths everywhere, and with them where the same surface comes twice.
#[test]
fn the_order_of_pieces_is_kept() {
    let (a, b) = (("knot-4000", [250, 10, 20]), ("bumps-4000", [0, 200, 30]));
    for samples in [Samples::One, Samples::Four] {
        let draw = |scene: &Scene| frames::render(scene, 201, 134, samples).unwrap();
        let sorted = painted(&[a, b, ("torus-4000", [9, 90, 240])], Hidden::Painter);
        assert!(draw(&sorted) == by_scanline(&sorted, 201, 134, samples), "{samples:?}");
        let (once, twice) = ([a], [a, (a.0, [5, 6, 7])]);
        let [once, twice] = [&once[..], &twice].map(|names| painted(names, Hidden::DepthBuffer));
        assert!(draw(&once) == draw(&twice), "{samples:?}");
    }
}

/// Effects beyond the book's are those of the engines, where no other texel may be read and no depth decides. In f32 a
/// cosine is off by less than 2^-18, so its power of 200 by less than a tenth of a step of 255; a distance up to 12 by
/// less than 2^-15 of it, and so is a share of fog; texture coordinates up to 48 by less than 2^-13, and a texel of eight
/// by less than half a step; up to 10 by less than 2^-15, and a texel of 64 by less than half a step too. So a pixel is
/// off by one for that, and by one for the rest.
#[test]
fn effects_are_those_of_the_engines() {
    type Without = fn(&mut Scene);
    let highlights: Without = |scene| {
        scene.items.iter_mut().for_each(|item| item.material.specular = Default::default());
    };
    let mip_maps: Without = |scene| {
        for item in &mut scene.items {
            let texture = textures::checkerboard().with(Filter::Bilinear, Wrap::Repeat);
            item.material.texture = Some(Arc::new(texture));
        }
    };
    let anisotropy: Without = |scene| {
        for item in &mut scene.items {
            Arc::make_mut(item.material.texture.as_mut().unwrap()).anisotropy = 1;
        }
    };
    for (name, without) in [
        ("highlights", highlights),
        ("fog", |scene| scene.fog = None),
        ("mip-maps", mip_maps),
        ("anisotropy", anisotropy),
    ] {
        let mut scene = chapters::scene(name, 1.5, 0.1).unwrap();
        match name {
            "highlights" => drop(scene.items.remove(0)),
            "fog" => scene.items.iter_mut().for_each(|item| item.material.texture = None),
            // The wall that faces the eye, with a third of the texels along its columns: no ratio is near a threshold.
            "anisotropy" => {
                scene.items = vec![scene.items.remove(2)];
                let mesh = Arc::make_mut(&mut scene.items[0].mesh);
                mesh.triangles.change_corners(|corner| corner.uv.y /= 3.0);
            }
            // The floor alone.
            _ => scene.items.truncate(1),
        }
        let mut plain = scene.clone();
        without(&mut plain);
        for samples in [Samples::One, Samples::Four] {
            let tiles = frames::render(&scene, 201, 134, samples).unwrap();
            let off = |other: &Frame<Colour>| -> Vec<u8> {
                let rows = tiles.rows().zip(other.rows());
                let pixels = rows.flat_map(|((_, a), (_, b))| a.iter().zip(b));
                pixels.map(|(a, b)| (0..3).map(|i| a[i].abs_diff(b[i])).max().unwrap()).collect()
            };
            let most = off(&by_scanline(&scene, 201, 134, samples)).into_iter().max().unwrap();
            assert!(most <= 2, "{name} {samples:?}: off by {most}");
            let without = frames::render(&plain, 201, 134, samples).unwrap();
            let changed = off(&without).into_iter().filter(|off| *off > 20).count();
            assert!(changed > 100, "{name} {samples:?}: {changed} pixels have the effect");
        }
    }
}

/// Triangles are counted as soon as a plane of theirs may overflow, so that a scene with any can go to another engine.
#[test]
fn values_that_may_overflow_are_counted() {
    let mut scene = chapters::scene("mip-maps", 1.5, 0.1).unwrap();
    scene.items.truncate(1);
    let beyond = |u: f64| {
        let mut scene = scene.clone();
        let mesh = Arc::make_mut(&mut scene.items[0].mesh);
        mesh.triangles.change_corners(|corner| corner.uv.x = u);
        frames::beyond_f32(&scene, 201, 134).unwrap()
    };
    assert_eq!(beyond(MOST_ATTRIBUTE), 0);
    assert!(beyond(4.0 * MOST_ATTRIBUTE) > 0);
}

/// A wrong picture is worse than none, so tiles alone refuse what they would draw wrongly.
#[test]
fn scenes_that_tiles_do_not_draw_are_refused() {
    for name in ["cut-outs", "panes", "layers", "shadows"] {
        let scene = chapters::scene(name, 1.5, 0.1).unwrap();
        let triangles = frames::not_drawn(&scene);
        assert!(triangles > 0, "{name}");
        let refusal = frames::render(&scene, 40, 30, Samples::One).unwrap_err();
        assert_eq!(refusal, TilesError::NotDrawn(triangles), "{name}");
        assert!(refusal.to_string().contains("not opaque"), "{refusal}");
    }
}

fn divided(scene: &Scene, target: &mut Target) -> (Frame<Colour>, HandedOver) {
    let division = Division::new(scene, 201, 134).unwrap();
    let picture = division.render(Tiles::default(), target, &mut |scene, effects, target| {
        Drawer::Scanline.render(scene, effects, target)
    });
    (picture.unwrap(), division.handed_over)
}

/// What is handed over is drawn over what tiles have drawn, and before it where it is nearer. With one colour for each
/// opaque item, tiles draw the bits of the engine, so the whole frame has them. Each scene shows what is handed over
/// before and behind what is not.
#[test]
fn what_tiles_do_not_draw_is_drawn_by_another_engine() {
    let plain = |mut scene: Scene| {
        for (number, item) in (1..).zip(&mut scene.items) {
            if item.material.opacity.is_none() {
                let colour = DVec3::new(0.1, 0.9, 0.5) / f64::from(number);
                item.material = Material { colour, ..Material::default() };
            }
        }
        scene
    };
    let named =
        ["cut-outs", "panes", "layers"].map(|name| chapters::scene(name, 1.5, 0.1).unwrap());
    let mut sorted = named[1].clone();
    sorted.hidden = Hidden::Painter;
    // Pieces of one pane hide nothing of each other, and a sphere hides them all the same.
    let mut one = named[1].clone();
    let last = one.items.iter().rposition(|item| item.material.opacity.is_some());
    let mut numbers = 0..;
    one.items.retain(|item| numbers.next() == last || item.material.opacity.is_none());
    let all_of = |scene: &Scene| scene.items.iter().map(|item| item.mesh.triangles.len()).sum();
    let parts = named.into_iter().chain([one]).map(|scene| (scene, false));
    for (scene, are_all) in parts.chain([(sorted, true)]) {
        let scene = plain(scene);
        for antialias in [Antialias::None, Antialias::Multisample4] {
            let target = || target_of(201, 134, antialias);
            let (picture, handed_over) = divided(&scene, &mut target());
            let whole = Drawer::Scanline.render(&scene, &Effects::PLANNED, &mut target()).unwrap();
            assert!(picture == whole.picture, "{} {antialias:?}", scene.name);
            let triangles = if are_all { all_of(&scene) } else { frames::not_drawn(&scene) };
            assert_eq!((handed_over.not_opaque, handed_over.triangles()), (triangles, triangles));
            assert_eq!(triangles < all_of(&scene), !are_all, "{}", scene.name);
        }
    }
    let shadows = chapters::scene("shadows", 1.5, 0.1).unwrap();
    let mut target = target_of(201, 134, Antialias::None);
    let (picture, handed_over) = divided(&shadows, &mut target);
    assert_eq!(handed_over.in_shadows, all_of(&shadows));
    assert!(picture == by_scanline(&shadows, 201, 134, Samples::One));
}

/// An item with a value beyond what planes in f32 hold is handed over, and no other.
#[test]
fn items_beyond_f32_are_handed_over() {
    let mut scene = chapters::scene("mip-maps", 1.5, 0.1).unwrap();
    let mesh = Arc::make_mut(&mut scene.items[0].mesh);
    mesh.triangles.change_corners(|corner| corner.uv.x = 4.0 * MOST_ATTRIBUTE);
    let mut target = target_of(201, 134, Antialias::None);
    let (_, handed_over) = divided(&scene, &mut target);
    let triangles = scene.items[0].mesh.triangles.len();
    assert_eq!(handed_over, HandedOver { beyond_f32: triangles, ..Default::default() });
    assert!(triangles < scene.triangles());
    // From back to front all is drawn by one engine, or what is handed over would lie over everything.
    scene.hidden = Hidden::Painter;
    let (picture, handed_over) = divided(&scene, &mut target);
    assert_eq!(handed_over.beyond_f32, scene.triangles());
    assert!(picture == by_scanline(&scene, 201, 134, Samples::One));
}

/// A window is a part of a larger frame only if tiles do not matter: the same scene, seen through
/// sizes that cut the tiles differently, has every pixel that the engines cover and no other.
#[test]
fn sizes_that_cut_tiles() {
    let mut scene = random::scene(1, 3);
    for item in &mut scene.items {
        item.material = Material::default();
    }
    for (width, height) in [(1, 1), (15, 64), (64, 64), (65, 63), (128, 1), (130, 129)] {
        for samples in [Samples::One, Samples::Four] {
            let tiles = frames::render(&scene, width, height, samples).unwrap();
            let engine = by_scanline(&scene, width, height, samples);
            assert!(tiles == engine, "{width} x {height} with {samples:?}");
            // Over a picture that is kept nothing is left of it.
            let mut kept = Frame::new(PixelRect::window(width, height), [9; 4]);
            frames::render_into(Tiles::default(), &scene, &mut kept, samples).unwrap();
            assert!(kept == engine, "{width} x {height} with {samples:?}, kept");
        }
    }
}
