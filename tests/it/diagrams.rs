//! The diagrams of `docs/figures`: each stands on a page, is legible on light and on dark paper, and shows what the code computes. The
//! numbers in its words are marked as those of the pages are.

use std::ops::Range;

use glam::DVec3;
use rasterproof_core::angle::sin_cos;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::Corners;
use rasterproof_exhaustive::Enumeration as _;
use rasterproof_exhaustive::triangles::Triangles;
use rasterproof_render::pipeline::multisample::SAMPLES;
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::transform::frustum;

use crate::pages::{files, read, root};

fn snapped(corners: [[f64; 2]; 3]) -> Corners {
    corners.map(|[x, y]| SubpixelPoint::from_px(x, y).expect("diagrams stay in the domain"))
}

/// Twice the area of a triangle in pixels.
fn area(corners: [[f64; 2]; 3]) -> f64 {
    twice_area(&snapped(corners)) as f64 / f64::from(SUBPIXELS).powi(2)
}

/// Areas between a point and each edge, each beside the whole.
pub fn areas() -> Vec<f64> {
    let (corners, p) = ([[0.0, 0.0], [8.0, 0.0], [0.0, 8.0]], [3.0, 3.0]);
    let part = |i: usize| area([p, corners[(i + 1) % 3], corners[(i + 2) % 3]]);
    (0..3).flat_map(|i| [part(i), area(corners)]).collect()
}

/// The edge function at the centres around an edge, without signs.
pub fn signs() -> Vec<f64> {
    let centres =
        (0..7).flat_map(|y| (0..9).map(move |x| [f64::from(x) + 0.5, f64::from(y) + 0.5]));
    centres.map(|p| area([[1.5, 6.5], [7.5, 0.5], p]).abs()).collect()
}

/// The rows of an edge by the integer DDA: row, M, first column, remainder; then dx and dy.
pub fn rows() -> Vec<f64> {
    let corners = [[1.25, 0.25], [6.5, 4.75], [9.0, 0.25]];
    let [a, b, _] = snapped(corners);
    let [dx, dy] = [b.x - a.x, b.y - a.y].map(i64::from);
    let ceil = |over: i64, under: i64| -(-over).div_euclid(under);
    let row = |y: i32| {
        let centre = i64::from(y * SUBPIXELS + HALF_PIXEL);
        let n = i64::from(a.x - HALF_PIXEL) * dy + (centre - i64::from(a.y)) * dx;
        let m = ceil(n, i64::from(SUBPIXELS));
        [i64::from(y), m, ceil(m, dy), ceil(m, dy) * dy - m]
    };
    let rows: Vec<_> = (0..5).map(row).collect();
    // The first columns are those of the engine.
    let mut firsts = Vec::new();
    Scanline.cover(snapped(corners), PixelRect::window(10, 5), |s| firsts.push(i64::from(s.x0_px)));
    assert_eq!(rows.iter().map(|row| row[2]).collect::<Vec<_>>(), firsts);
    rows.into_iter().flatten().chain([dx, dy]).map(|n| n as f64).collect()
}

/// How many points a grid has, and how many triangles have their corners on it, for 1 to 4 bits.
pub fn lattices() -> Vec<f64> {
    let set = |subpixel_bits| Triangles {
        window_px: 4,
        subpixel_bits,
        offset_px: [0; 2],
        all_orders: false,
        plant: None,
    };
    let counts = |bits| [set(bits).chunks() as f64, set(bits).expected_cases() as f64];
    (1..=4).flat_map(counts).collect()
}

/// A position in parts of a pixel, and the one to which it is snapped.
pub fn corner() -> Vec<f64> {
    let given = [1.7, 1.7015];
    let near = SubpixelPoint::from_px(given[0], given[1]).unwrap();
    let [x, y] = given.map(|px| px * f64::from(SUBPIXELS));
    vec![x, y, near.x.into(), near.y.into()]
}

/// How bright a surface is whose normal is at these angles to the light.
pub fn cosines() -> Vec<f64> {
    let bright = |degrees: f64| {
        let (sin, cos) = sin_cos(degrees.to_radians());
        let light = Light { towards: DVec3::new(sin, cos, 0.0), ambient: 0.0, diffuse: 1.0 };
        light.intensity(DVec3::Y)
    };
    [0.0, 45.0, 75.0, 120.0].map(bright).to_vec()
}

/// Samples of a pixel on the inner side of an edge, and all of them.
pub fn samples() -> Vec<f64> {
    let inside = |(x, y): &&(i32, i32)| {
        area([[0.0, 0.85], [1.0, 0.1], [*x, *y].map(|at| f64::from(at) / 16.0)]) > 0.0
    };
    vec![SAMPLES.iter().filter(inside).count() as f64, SAMPLES.len() as f64]
}

/// Where a point lies on the film; its first coordinate.
fn on_film(far: f64, x: f64, z: f64) -> DVec3 {
    let clip = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, far).unwrap() * DVec3::new(x, 0.0, z).extend(1.0);
    clip.truncate() / clip.w
}

/// Halfway along a rod, on the film.
pub fn share() -> Vec<f64> {
    let [a, m, b] = [[-2.0, 2.0], [2.0, 4.0], [6.0, 6.0]].map(|[x, z]| on_film(6.0, x, z).x);
    vec![(m - a) / (b - a)]
}

/// Equal steps along an edge from (0, 1) to (12, 3), on the film.
pub fn shares() -> Vec<f64> {
    let film = |t: f64| 12.0 * t / (1.0 + 2.0 * t);
    [0.25, 0.5, 0.75, 1.0].map(|t| film(t) / film(1.0)).to_vec()
}

/// The stored depth at distances of 2, 10 and 50 between planes at 1 and 100.
pub fn depths() -> Vec<f64> {
    [2.0, 10.0, 50.0].map(|z| (on_film(100.0, 0.0, z).z + 1.0) / 2.0).to_vec()
}

/// Every diagram by the name of its file, with its text; live figures lie in a folder of their own.
pub fn all() -> Vec<(String, String)> {
    let here = root().join("docs/figures");
    let own = files(&here, ".svg").into_iter().filter(|path| path.parent() == Some(&here));
    own.map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), read(path))).collect()
}

#[test]
fn diagrams_stand_on_pages() {
    let pages: String = files(&root().join("docs"), ".md").into_iter().map(read).collect();
    let diagrams = all();
    let style = |svg: &str| svg.lines().nth(1).unwrap().to_owned();
    assert!(diagrams.len() >= 16 && style(&diagrams[0].1).contains("prefers-color-scheme:dark"));
    for (name, svg) in &diagrams {
        assert!(pages.contains(&format!("](figures/{name}.svg)")), "{name}");
        assert_eq!(style(svg), style(&diagrams[0].1), "{name}");
        assert!(svg.contains("<text") && !svg.contains("NaN") && !svg.contains("inf"), "{name}");
    }
}

/// The pixels that a diagram shows as covered are as many as the engine covers.
#[test]
fn diagrams_show_what_is_covered() {
    let covered = |corners: [[f64; 2]; 3], columns: u32, rows: u32| -> usize {
        let mut runs: Vec<Range<i32>> = Vec::new();
        let window = PixelRect::window(columns, rows);
        Scanline.cover(snapped(corners), window, |s| runs.push(s.x0_px..s.x1_px));
        runs.iter().map(Range::len).sum()
    };
    let diagrams = all();
    for (name, count) in [
        ("split", covered([[1.5, 0.5], [9.5, 3.5], [1.5, 7.5]], 11, 8)),
        (
            "lattices",
            covered([[0.5, 0.0], [4.0, 1.5], [1.0, 4.0]], 4, 4)
                + covered([[3.75, 0.25], [3.5, 3.75], [0.0, 2.25]], 4, 4),
        ),
    ] {
        let (_, svg) = diagrams.iter().find(|(diagram, _)| diagram == name).unwrap();
        assert_eq!(svg.matches("class=\"dot1\"").count(), count, "{name}");
    }
}
