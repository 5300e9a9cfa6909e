//! Depth ties: two surfaces in one plane are undecided by either rasterizer, in every depth format and
//! with every kind of samples; a fault in the same scene is still found.

use glam::{DMat4, DVec2, DVec3};
use rasterproof_core::frame::Frame;
use rasterproof_faults::planted::TriangleMutant;
use rasterproof_registry::engines::{Drawer, Engine};
use rasterproof_registry::undecided::{self, EngineFrame};
use rasterproof_render::effects::depth_ties::TiedPieces;
use rasterproof_render::effects::{Effects, render};
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};
use rasterproof_render::pipeline::transform::perspective;
use rasterproof_render::scene::{Corner, Item, Material, Mesh, Scene, chapters};
use rasterproof_report::frame_comparison::{self, Comparison};
use rasterproof_study::corner_grid::CornerGrid;
use rasterproof_study::snapping::look;
use rayon::prelude::*;

use crate::pages::{page, root};
use crate::program::{Folder, Run};

/// A square, split along one diagonal or the other.
fn square(diagonal: usize, colour: DVec3, model: DMat4) -> Item {
    let positions = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corner = |position: u32| Corner {
        position,
        colour: DVec3::ONE,
        normal: DVec3::ZERO,
        uv: DVec2::ZERO,
    };
    let triangles = [[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]][diagonal];
    let mesh = Mesh {
        positions: positions.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec().into(),
        triangles: triangles.map(|indices| indices.map(corner)).into_iter().collect(),
    };
    Item { model, ..Item::new(mesh, Material { colour, ..Material::default() }) }
}

/// A red square and a blue one, turned alike, `behind` apart.
fn squares(pitch_degrees: f64, behind: f64) -> Scene {
    let turn = rasterproof_core::angle::turn_x(pitch_degrees.to_radians());
    let model = |z: f64| DMat4::from_translation(DVec3::Z * (4.0 + z)) * turn;
    let projection = perspective(0.7, 4.0 / 3.0, 1.0, 10.0).unwrap();
    let mut scene = Scene::new("squares", "a square twice", projection);
    scene.items = vec![
        square(0, DVec3::new(0.9, 0.2, 0.1), model(0.0)),
        square(1, DVec3::new(0.1, 0.3, 0.9), model(behind)),
    ];
    scene
}

fn draw(scene: &Scene, engine: Engine, mut target: Target) -> (Frame<Colour>, Target) {
    let rendered = render::render(scene, &engine, &Effects::ALWAYS, &mut target).unwrap();
    (rendered.picture, target)
}

type Frames = [(Frame<Colour>, Target); 2];

fn by_both(
    scene: &Scene,
    engines: [Engine; 2],
    antialias: Antialias,
    format: DepthFormat,
) -> Frames {
    let target = Target::new(80, 60, antialias, format).unwrap();
    engines.map(|engine| draw(scene, engine, target.clone()))
}

/// Compares the frames of two engines, ties excused.
fn compare(
    scene: &Scene,
    engines: [Engine; 2],
    antialias: Antialias,
    format: DepthFormat,
) -> Comparison {
    judge(scene, engines, &by_both(scene, engines, antialias, format))
}

fn judge(scene: &Scene, engines: [Engine; 2], drawn: &Frames) -> Comparison {
    let frames = [0, 1].map(|i| EngineFrame { engine: engines[i], target: &drawn[i].1 });
    let ties = undecided::find(scene, frames).unwrap();
    let [(a, a_target), (b, b_target)] = drawn;
    frame_comparison::compare((a, a_target), (b, b_target), Some(&ties))
}

const SMOOTHINGS: [Antialias; 3] =
    [Antialias::None, Antialias::Multisample4, Antialias::Supersample(2)];

#[test]
fn one_plane_is_undecided_by_either() {
    let pitches: Vec<f64> = (0..12).map(|i| f64::from(3 + 7 * i)).collect();
    for format in DepthFormat::ALL {
        for antialias in SMOOTHINGS {
            let comparisons: Vec<Comparison> = pitches
                .par_iter()
                .map(|&pitch| compare(&squares(pitch, 0.0), Engine::JUDGED, antialias, format))
                .collect();
            let name = format!("{} {antialias:?}", format.name());
            for (c, pitch) in comparisons.iter().zip(&pitches) {
                assert!(c.agrees(), "{name}, {pitch} degrees: {c:?}");
                assert!(c.undecided >= c.undecided_differ);
            }
            let sum = |of: fn(&Comparison) -> u64| comparisons.iter().map(of).sum::<u64>();
            let (undecided, differ) = (sum(|c| c.undecided), sum(|c| c.undecided_differ));
            if format == DepthFormat::F64 {
                assert!(undecided > 1000 && differ > 100, "{name}: {undecided}, {differ}");
            } else {
                // One step holds both depths nearly everywhere, and what was first stays.
                assert!(undecided < 100, "{name}: {undecided}");
            }
        }
    }
}

/// Behind by more than the bounds, nothing is undecided, though by less than a step of 24 bits.
#[test]
fn apart_is_decided() {
    for behind in [1e-9, -1e-9, 0.5, -0.5] {
        for antialias in SMOOTHINGS {
            let scene = squares(40.0, behind);
            let c = compare(&scene, Engine::JUDGED, antialias, DepthFormat::F64);
            assert!(c.agrees() && c.undecided == 0, "{behind} {antialias:?}: {c:?}");
        }
    }
    for name in ["square", "cycle", "cube", "sphere", "panels"] {
        let scene = chapters::scene(name, 4.0 / 3.0, 0.37).unwrap();
        let c = compare(&scene, Engine::JUDGED, Antialias::None, DepthFormat::F64);
        assert!(c.agrees() && c.undecided == 0, "{name}: {c:?}");
    }
}

/// More tied pieces than are judged at once: 400 squares in one plane, over 1,650 pixels. No pixel of
/// theirs is lost where a rectangle is halved.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn many_surfaces_in_one_plane() {
    let mut scene = squares(12.0, 0.0);
    scene.items = scene.items.iter().cycle().take(400).cloned().collect();
    let drawn = by_both(&scene, Engine::JUDGED, Antialias::None, DepthFormat::F64);
    let covered = covered(&drawn[0].0);
    let c = judge(&scene, Engine::JUDGED, &drawn);
    assert!(covered * 400 > 1 << 19, "{covered} pixels make too few tied");
    assert!(c.agrees() && c.undecided == covered, "{c:?} of {covered} pixels");
}

/// A rasterizer with wrong depths shows a surface that cannot be the nearest, or a depth out of bounds.
#[test]
fn a_planted_fault_is_still_found() {
    let planted = Engine::Mutant(TriangleMutant::PerspectiveDepth);
    for format in DepthFormat::ALL {
        for antialias in SMOOTHINGS {
            let scene = squares(40.0, 0.0);
            let c = compare(&scene, [Engine::Scanline, planted], antialias, format);
            assert!(!c.agrees(), "{} {antialias:?}: {c:?}", format.name());
        }
    }
}

/// Of an undecided pixel, both the colour and the depth must be those of a tied piece.
#[test]
fn an_undecided_pixel_is_no_excuse_for_anything_else() {
    let (scene, engines) = (squares(40.0, 0.0), Engine::JUDGED);
    let drawn = by_both(&scene, engines, Antialias::None, DepthFormat::F64);
    let whole = judge(&scene, engines, &drawn);
    assert!(whole.agrees() && whole.undecided > 0);
    let (x, y) = (40, 30);
    let shown = drawn[1].0.get(x, y).unwrap();
    // 0.9, 0.2, 0.1 and 0.1, 0.3, 0.9 times 255, to the nearest.
    let colours = [[230, 51, 26, 255], [26, 77, 230, 255]];
    let [other] = colours.into_iter().filter(|c| *c != shown).collect::<Vec<_>>()[..] else {
        panic!("neither square is shown: {shown:?}");
    };
    let edited = |colour: Option<Colour>, depth: u64| {
        let mut drawn = drawn.clone();
        let (picture, target) = &mut drawn[1];
        let plane = &mut target.planes[0];
        if let Some(colour) = colour {
            picture.span_mut(y, x, x + 1)[0] = colour;
            plane.colour.span_mut(y, x, x + 1)[0] = colour;
        }
        plane.depth.span_mut(y, x, x + 1)[0] += depth;
        judge(&scene, engines, &drawn)
    };
    assert!(edited(None, 0).agrees());
    // The other square is as right; green is neither.
    assert!(edited(Some(other), 0).agrees());
    let green = edited(Some([0, 200, 0, 255]), 0);
    assert_eq!((green.wrong_pixels, green.wrong_depths), (1, 0));
    // 2^12 steps beyond 1/2 are 2^-41, a thousand times the bound.
    let deep = edited(None, 1 << 12);
    assert_eq!((deep.wrong_pixels, deep.wrong_depths), (0, 1));
}

#[test]
fn the_planned_frames_of_the_drawers_tie_alike() {
    let scene = squares(40.0, 0.0);
    let drawn = by_both(&scene, Engine::JUDGED, Antialias::None, DepthFormat::F64);
    for (drawer, (picture, other)) in Drawer::ALL.into_iter().zip(drawn) {
        let mut own = Target::new(80, 60, Antialias::None, DepthFormat::F64).unwrap();
        let planned = drawer.render(&scene, &Effects::ALWAYS, &mut own).unwrap();
        assert!(planned.picture == picture && own.planes == other.planes, "{}", drawer.name());
    }
}

/// Renders the model of `tests/data`; the picture beside the one of differences is in a folder for each test.
fn render_model(folder: &Folder, words: &str) -> Run {
    let command = "render tests/data/ties.obj --yaw 0 -o";
    let mut command = folder.command(command);
    command.arg(folder.join("ties.png")).args(words.split_whitespace());
    Run::of(command.current_dir(root()))
}

/// The page's table, its first row: the model from twelve pitches, one sample a pixel, in f64.
#[test]
#[ignore = "takes seconds; .ci/run --all runs it"]
fn the_page_counts_ties() {
    let count = |aa: &str, pitch: u32| -> [u64; 2] {
        let folder = Folder::new(&format!("ties-page-{aa}-{pitch}"));
        let words = format!("--pitch {pitch} --depth f64 --aa {aa} --json");
        let json = render_model(&folder, &words).json();
        ["undecided", "undecided_differ"].map(|key| json["comparison"][key].as_u64().unwrap())
    };
    for (number, aa) in ["none", "msaa4", "ssaa2"].into_iter().enumerate() {
        let counts: Vec<_> = (0..12).into_par_iter().map(|i| count(aa, 3 + 7 * i)).collect();
        for folder in ["docs", "docs/zh"] {
            let page = page(folder, "ties");
            let row = page.lines().filter(|line| line.starts_with("| `f64` |")).nth(number);
            let row = row.unwrap();
            let cells: Vec<_> = row.split('|').map(|cell| cell.trim().replace(',', "")).collect();
            for i in 0..2 {
                let sum: u64 = counts.iter().map(|count| count[i]).sum();
                assert_eq!(cells[3 + i], sum.to_string(), "{folder}: {row}");
            }
        }
    }
}

/// A leaning triangle with a texture of many colours, whose coordinates reach from 0 to `far`.
fn far_texture(far: f64, filter: Filter) -> Scene {
    let texels: Vec<[u8; 3]> = (0..64 * 64_u32)
        .map(|i| i.wrapping_mul(0x9e37_79b9).to_le_bytes())
        .map(|[r, g, b, _]| [r, g, b])
        .collect();
    let texture = Texture::new(64, 64, &texels).unwrap().with(filter, Wrap::Repeat);
    let corner = |position: u32, u: f64, v: f64| Corner {
        position,
        colour: DVec3::ONE,
        normal: DVec3::ZERO,
        uv: DVec2::new(u, v),
    };
    let positions = [(-1.0, -1.0, 0.0), (1.0, -1.0, 0.6), (0.0, 1.0, -0.4)];
    let mesh = Mesh {
        positions: positions.map(|(x, y, z)| DVec3::new(x, y, z)).to_vec().into(),
        triangles: [[corner(0, 0.0, 0.0), corner(1, far, 0.0), corner(2, 0.3 * far, far)]]
            .into_iter()
            .collect(),
    };
    let projection = perspective(0.7, 4.0 / 3.0, 1.0, 10.0).unwrap();
    let mut scene = Scene::new("far", "large texture coordinates", projection);
    let model = DMat4::from_translation(DVec3::Z * 3.0);
    let texture = Some(std::sync::Arc::new(texture));
    let material = Material { texture, ..Material::default() };
    scene.items = vec![Item { model, ..Item::new(mesh, material) }];
    scene
}

/// Both rasterizers keep their bounds, which hold several texels: counted, and no difference.
#[test]
fn large_texture_coordinates_are_undecided_by_either() {
    for filter in [Filter::Nearest, Filter::Bilinear] {
        for antialias in SMOOTHINGS {
            let at = |far: f64| {
                let scene = far_texture(far, filter);
                compare(&scene, Engine::JUDGED, antialias, DepthFormat::Unorm32)
            };
            for far in [1.0, 7.0, 1e3] {
                let c = at(far);
                assert!(c.agrees() && c.far_texture == 0 && c.undecided == 0, "{far}: {c:?}");
            }
            let mut all = 0;
            for far in [1e9, 1e10, 1e11, 1e13, 1e18, 1e60] {
                let c = at(far);
                assert!(c.agrees() && c.undecided == 0, "{far} {filter:?} {antialias:?}: {c:?}");
                all += c.far_texture;
            }
            assert!(all > 20, "{filter:?} {antialias:?}: {all}");
        }
    }
}

/// What a fault does to texture coordinates lies outside of the bounds, near and far.
#[test]
fn faults_at_large_texture_coordinates_are_found() {
    use TriangleMutant::{AffineAttributes, SwappedWeights, ValuesAtCorner, ValuesThroughF32};
    for far in [1.0, 1e4, 1e9, 1e11] {
        let scene = far_texture(far, Filter::Nearest);
        for fault in [AffineAttributes, SwappedWeights, ValuesAtCorner, ValuesThroughF32] {
            let engines = [Engine::Scanline, Engine::Mutant(fault)];
            let c = compare(&scene, engines, Antialias::None, DepthFormat::Unorm32);
            let least = match fault {
                // A coordinate near 1 that is rounded to f32 stays within its texel.
                ValuesThroughF32 if far == 1.0 => continue,
                ValuesThroughF32 => 10,
                _ => 100,
            };
            assert!(c.wrong_pixels >= least, "{far} {fault:?}: {c:?}");
        }
    }
}

/// Between texels, too: a bound of an eighth of a texel leaves a few neighbours open, not the whole texture.
#[test]
#[ignore = "takes seconds; .ci/run runs it"]
fn faults_between_far_texels_are_found() {
    use TriangleMutant::{AffineAttributes, SwappedWeights};
    for antialias in SMOOTHINGS {
        for far in [1e9, 3e11, 1e12] {
            let scene = far_texture(far, Filter::Bilinear);
            for fault in [AffineAttributes, SwappedWeights] {
                let engines = [Engine::Scanline, Engine::Mutant(fault)];
                let c = compare(&scene, engines, antialias, DepthFormat::Unorm32);
                // Nearly all of the triangle is wrong; a fault may hit a possible colour by chance.
                let name = format!("{far} {fault:?} {antialias:?}: {c:?}");
                assert!(c.wrong_pixels >= 1_000 && c.far_texture <= 100, "{name}");
            }
        }
    }
}

/// Pixels of a picture that are not as the one in its corner.
fn covered(picture: &Frame<Colour>) -> u64 {
    let background = picture.get(0, 0).unwrap();
    picture.rows().flat_map(|(_, row)| row).filter(|colour| **colour != background).count() as u64
}

/// Pixels that rounding decides: by snapping alone, which every rasterizer does, and in tiles.
fn by_rounding(scene: &Scene, antialias: Antialias) -> [u64; 2] {
    let target = Target::new(160, 120, antialias, DepthFormat::Unorm32).unwrap();
    let (classes, _) = look(scene, &[], &target, CornerGrid::USUAL).unwrap();
    assert_eq!(classes.first.is_some(), classes.by_rounding > 0);
    let tiles = TiedPieces::new(scene, &target).unwrap().by_planes_in_f32();
    assert_eq!(tiles.first.is_some(), tiles.pixels > 0);
    [classes.by_rounding, tiles.pixels]
}

/// Two surfaces in one plane are found in every view and with every kind of samples; two that lie apart,
/// or are the same triangles twice, are not.
#[test]
fn surfaces_in_one_plane_are_found_before_snapping() {
    for antialias in SMOOTHINGS {
        for pitch in [3.0, 20.0, 55.0, 80.0] {
            let scene = squares(pitch, 0.0);
            let mut first = scene.clone();
            first.items.truncate(1);
            let target = Target::new(160, 120, Antialias::None, DepthFormat::F64).unwrap();
            let covered = covered(&draw(&first, Engine::Scanline, target).0);
            let name = format!("{antialias:?} {pitch}");
            // All of the square; the bound of a plane in f32 holds any difference of zero.
            let found = by_rounding(&scene, antialias);
            assert!(found.iter().all(|found| *found >= covered), "{name}: {found:?} of {covered}");
            assert_eq!(by_rounding(&squares(pitch, 0.05), antialias), [0, 0], "{name}");
            let mut twice = scene.clone();
            twice.items[1].mesh = twice.items[0].mesh.clone();
            assert_eq!(by_rounding(&twice, antialias), [0, 0], "{name}");
        }
    }
}

/// The rasterizer in tiles snaps corners as well: it leaves no less open than the others, also where depths
/// change so fast from pixel to pixel that snapping moves them by more than f32 does.
#[test]
fn tiles_leave_open_what_snapping_does() {
    for pitch in [3.0, 20.0, 55.0, 80.0] {
        let mut scene = squares(pitch, 0.0);
        scene.projection = perspective(0.7, 4.0 / 3.0, 2.9, 5.1).unwrap();
        // A square whose sides are not parallel to those of the picture: its corners snap into no plane.
        let turn = DMat4::from_rotation_z(0.3) * DMat4::from_rotation_y(0.7);
        for item in &mut scene.items {
            item.model *= turn;
        }
        for antialias in SMOOTHINGS {
            let [snapped, tiles] = by_rounding(&scene, antialias);
            assert!(
                snapped > 1_000 && tiles >= snapped,
                "{pitch} {antialias:?}: {tiles} of {snapped}"
            );
        }
    }
}

/// Two squares that cross are open beside the line in which they do, and nowhere else.
#[test]
fn surfaces_that_cross_are_open_beside_their_line() {
    let mut scene = squares(10.0, 0.0);
    let tilt = rasterproof_core::angle::turn_x(70.0_f64.to_radians());
    scene.items[1].model = DMat4::from_translation(DVec3::Z * 4.0) * tilt;
    let [found, _] = by_rounding(&scene, Antialias::None);
    // The line is horizontal and at most 160 px long.
    assert!(found <= 160, "{found}");
    for name in ["cube", "sphere", "facets"] {
        let scene = chapters::scene(name, 4.0 / 3.0, 0.0).unwrap();
        assert_eq!(by_rounding(&scene, Antialias::None)[0], 0, "{name}");
    }
}

/// What `render` says of them is in `tests/transcripts/ties.md`; in the picture of differences they are yellow.
#[test]
fn undecided_pixels_are_yellow() {
    let folder = Folder::new("ties");
    render_model(&folder, "--size 160x120 --depth f64").has(0);
    let picture = image::open(folder.join("ties.difference.png")).unwrap().to_rgb8();
    assert!(picture.pixels().any(|pixel| *pixel == image::Rgb([255, 200, 0])), "yellow");
}
