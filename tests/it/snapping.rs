//! What moving corners to a grid breaks: pixels of models that are counted here in whole numbers, by code that shares nothing with the
//! engines, are those that the program names, on each grid and on none.

use rasterproof_core::arrays::MapArray as _;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Antialias, Target};
use rasterproof_render::scene::chapters;
use rasterproof_report::frame_comparison;
use rasterproof_study::corner_grid::CornerGrid;
use rasterproof_study::grid::{Cells, cells};
use serde_json::Value;

use crate::model_cases::{FOLDER, case};
use crate::program::Folder;

/// Models in the plane z = 0 below `snapping`, each with a camera that has a pixel for each unit, and the size of its window.
const PLANES: [(&str, [usize; 2]); 7] = [
    ("tj", [9, 5]),
    ("fold", [9, 5]),
    ("two-on-an-edge", [12, 7]),
    ("fold-11x7", [11, 7]),
    ("crack-and-fold", [18, 5]),
    ("turned-unseen", [9, 7]),
    ("sound", [12, 8]),
];

/// Bits below the pixel of the whole numbers in which is counted: f32 has no finer ones between 1 and 16, and what is finer near 0 is 0 in
/// these models.
const BITS: u32 = 40;

type Corners = [[i128; 2]; 3];

/// The triangles of a model, y down.
fn triangles(name: &str) -> Vec<[[f64; 2]; 3]> {
    let model = case(&format!("snapping/{name}.gltf"));
    let of_item = |item: &rasterproof_render::scene::Item| {
        let at = |number: u32| {
            let position = item.mesh.positions[number as usize];
            [position.x, -position.y]
        };
        item.mesh.triangles.positions().iter().map(|of| of.map(at)).collect::<Vec<_>>()
    };
    model.items.iter().flat_map(of_item).collect()
}

/// The corners on a grid, or as they are.
fn placed(triangle: [[f64; 2]; 3], bits: Option<u32>) -> Corners {
    let whole = |px: f64| {
        let scaled = px * (1u64 << BITS) as f64;
        assert_eq!(scaled.fract(), 0.0, "{px} has finer bits");
        let Some(step) = bits.map(|bits| 1i128 << (BITS - bits)) else { return scaled as i128 };
        let (below, rest) = ((scaled as i128).div_euclid(step), (scaled as i128).rem_euclid(step));
        let is_up = 2 * rest > step || 2 * rest == step && below % 2 != 0;
        (below + i128::from(is_up)) * step
    };
    triangle.map_array(|point| point.map_array(whole))
}

fn edge(a: [i128; 2], b: [i128; 2], [x, y]: [i128; 2]) -> i128 {
    (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
}

/// Whether a triangle covers the centre of a pixel, with its top and its left edges.
fn covers([a, mut b, mut c]: Corners, [x, y]: [usize; 2]) -> bool {
    let area = edge(a, b, c);
    if area < 0 {
        (b, c) = (c, b);
    }
    let half = 1i128 << (BITS - 1);
    let centre = [2 * x as i128 + 1, 2 * y as i128 + 1].map_array(|odd| odd * half);
    area != 0
        && [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| {
            let is_top_left = to[1] < from[1] || to[1] == from[1] && to[0] > from[0];
            let side = edge(from, to, centre);
            side > 0 || side == 0 && is_top_left
        })
}

/// The numbers of the triangles that cover each pixel of a window, row by row.
fn covering(name: &str, [width, height]: [usize; 2], bits: Option<u32>) -> Vec<Vec<usize>> {
    let triangles: Vec<_> = triangles(name).into_iter().map(|of| placed(of, bits)).collect();
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let at = |px| (0..triangles.len()).filter(|of| covers(triangles[*of], px)).collect();
    pixels.map(at).collect()
}

/// How many cover each.
fn counted(name: &str, size: [usize; 2], bits: Option<u32>) -> Vec<usize> {
    covering(name, size, bits).iter().map(Vec::len).collect()
}

/// Pixels that are covered less often on a grid than as given, and those that are covered more often.
fn cracks_and_folds(name: &str, size: [usize; 2], bits: u32) -> [Vec<[usize; 2]>; 2] {
    let (given, snapped) = (counted(name, size, None), counted(name, size, Some(bits)));
    let pixels = |broken: fn(usize, usize) -> bool| {
        let all = given.iter().zip(&snapped).enumerate();
        let broken = all.filter(|(_, (given, snapped))| broken(**given, **snapped));
        broken.map(|(at, _)| [at % size[0], at / size[0]]).collect::<Vec<_>>()
    };
    [pixels(|given, snapped| snapped < given), pixels(|given, snapped| snapped > given)]
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    for (name, _) in PLANES {
        let file = format!("{name}.gltf");
        folder.put(&file, std::fs::read(format!("{FOLDER}/snapping/{file}")).unwrap());
    }
    folder
}

fn found<'a>(cases: &'a Value, kind: &str) -> Option<&'a Value> {
    cases.as_array().unwrap().iter().find(|case| case["kind"] == kind)
}

/// `verify` and `render` name the broken pixels of each model and no others, and how many triangles are turned over or flattened.
#[test]
fn each_pixel_that_snapping_breaks_is_named() {
    let folder = folder("snapping-named");
    let mut seen = [0; 3];
    for (name, size @ [width, height]) in PLANES {
        let view = format!("{name}.gltf --camera 1 --size {width}x{height}");
        let json = folder.check(&*format!("verify {view} --json"), 0).json();
        let cases = &json["hard_cases"]["cases"];
        let drawn = folder.check(&*format!("render {view} --json"), 0).json();
        let pixels = cracks_and_folds(name, size, 8);
        let kinds = [("cracks by snapping", "crack"), ("folds by snapping", "fold")];
        for (number, ((kind, short), pixels)) in kinds.into_iter().zip(&pixels).enumerate() {
            seen[number] += pixels.len();
            let case = found(cases, kind);
            let count = case.map_or(0, |case| case["pixels"].as_u64().unwrap());
            assert_eq!(count, pixels.len() as u64, "{name}: {kind}");
            let by_snapping = &drawn["by_snapping"];
            assert_eq!(by_snapping[format!("{short}s")], pixels.len(), "{name}: {kind}");
            let first = pixels.first();
            assert_eq!(by_snapping[format!("first_{short}")], serde_json::json!(first), "{name}");
            if let (Some(case), Some([x, y])) = (case, first) {
                let note = case["note"].as_str().unwrap();
                assert!(note.starts_with(&format!("the first at {x},{y}, of faces ")), "{note}");
            }
        }
        let area = |of: [[f64; 2]; 3], bits| {
            let [a, b, c] = placed(of, bits);
            edge(a, b, c).signum()
        };
        let turned = triangles(name).into_iter().filter(|&of| area(of, None) != area(of, Some(8)));
        let (turned, told) = (turned.count(), found(cases, "triangles turned by snapping"));
        seen[2] += turned;
        let by_snapping = |key: &str| drawn["by_snapping"][key].as_u64().unwrap();
        assert_eq!(by_snapping("turned_over") + by_snapping("flattened"), turned as u64, "{name}");
        assert_eq!(told.map_or(0, |case| case["count"].as_u64().unwrap()), turned as u64, "{name}");
    }
    assert!(seen.iter().all(|count| *count > 2), "{seen:?}");
}

/// A triangle that culling removes since snapping has turned it over is counted, by `verify` and by `render`.
#[test]
fn turned_triangles_that_are_culled_are_counted() {
    let folder = folder("snapping-culled");
    let mut turned = 0;
    for (name, [width, height]) in PLANES {
        // As given all of them are clockwise.
        let view = format!("{name}.gltf --camera 1 --size {width}x{height} --cull ccw --json");
        let [verified, drawn] = ["verify", "render"]
            .map(|command| folder.check(&*format!("{command} {view}"), 0).json());
        let told = found(&verified["hard_cases"]["cases"], "triangles turned by snapping");
        let told = told.map_or(0, |case| case["count"].as_u64().unwrap());
        let by_snapping = |key: &str| drawn["by_snapping"][key].as_u64().unwrap();
        assert_eq!(by_snapping("turned_over") + by_snapping("flattened"), told, "{name}");
        turned += by_snapping("turned_over");
    }
    assert!(turned > 2, "{turned}");
}

/// On every grid, and on none, the picture has the pixels that are covered on it, and cracks and folds are those of this grid.
#[test]
fn each_grid_has_its_own_pixels() {
    let folder = folder("snapping-grids");
    let mut changes = 0;
    for (name, size @ [width, height]) in PLANES {
        // The first of several triangles in one plane is seen. Those of one model have a colour each, those of the others have one colour.
        let seen = |bits| {
            let all = covering(name, size, bits);
            let first = |of: &Vec<usize>| of.first().map(|of| if name == "fold" { *of } else { 0 });
            all.iter().map(first).collect::<Vec<_>>()
        };
        let usual = seen(Some(8));
        for bits in [Some(4), Some(12), Some(16), None] {
            let grid = bits.map_or("--unsnapped".to_owned(), |b| format!("--subpixel-bits {b}"));
            let words =
                format!("render {name}.gltf --camera 1 --size {width}x{height} {grid} --json");
            let json = folder.check(&*words, 0).json();
            let own = seen(bits);
            let differing = usual.iter().zip(&own).filter(|(usual, own)| usual != own).count();
            assert_eq!(json["grid"]["pixels"], differing, "{words}");
            changes += differing;
            let [cracks, folds] = bits.map_or_else(Default::default, |bits| {
                cracks_and_folds(name, size, bits).map_array(|pixels| pixels.len())
            });
            let told = &json["by_snapping"];
            assert_eq!([&told["cracks"], &told["folds"]], [cracks, folds], "{words}");
        }
    }
    assert!(changes > 5, "{changes}");
}

/// A scene whose every pixel became a triangle of its own on the engines' grid is drawn as the scene itself is.
#[test]
fn cells_on_the_usual_grid_are_the_picture() {
    for name in ["cube", "panels", "sphere", "inside"] {
        let Some(scene) = chapters::scene(name, 1.0, 0.3) else { panic!("no scene {name}") };
        let drawn = |scene| {
            let mut target = Target::new(96, 96, Antialias::None, DepthFormat::Unorm32).unwrap();
            let rendered = Drawer::Scanline.render(scene, &Effects::PLANNED, &mut target).unwrap();
            (rendered.picture, target.bounds())
        };
        let (picture, window) = drawn(&scene);
        let Cells { scene: cells, disagreeing } = cells(&scene, window, CornerGrid::USUAL).unwrap();
        assert!(
            disagreeing == 0 && cells.triangles() > 500,
            "{name}: {disagreeing}, {}",
            cells.triangles()
        );
        let differing = frame_comparison::differing(&picture, &drawn(&cells).0);
        assert_eq!(differing, 0, "{name}");
        let Cells { scene: cells, .. } = self::cells(&scene, window, CornerGrid::Bits(4)).unwrap();
        assert!(frame_comparison::differing(&picture, &drawn(&cells).0) > 0, "{name}");
    }
}
