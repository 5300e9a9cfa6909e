//! The examples that the chapters work by hand, computed by the engines: pages name their results as they name other figures
//! (`tests/it/pages.rs`).

use glam::{DMat4, DVec2, DVec3, DVec4};
use rasterproof_core::angle::turn_z;
use rasterproof_core::contract::{DrawLine as _, Interpolate as _};
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::line::dda::Dda;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::edge_function::probe::edges_at;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{
    Corners, LineEnd, PixelPoint, ScreenLine, ScreenTriangle, ScreenVertex,
};
use rasterproof_precision::ladder::antialiasing::{
    Antialias, ExactArea, FOUR, Multisample, ONE, Supersample,
};
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::clip::{Outcode, clip};
use rasterproof_render::pipeline::footprint::Footprint;
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};
use rasterproof_render::pipeline::transform::{about, frustum};
use rasterproof_verify::cases::named::plain_line;
use rasterproof_verify::comparison::oracle_coverage;
use rasterproof_verify::convention::{Shape, TriangleConvention};

/// What computes the numbers of an example.
pub type Values = fn() -> Vec<f64>;

/// Every example by the name that pages give it.
pub const ALL: &[(&str, Values)] = &[
    ("hand-square", square),
    ("corner-square", corner_square),
    ("hand-lines", lines),
    ("hand-step", step),
    ("hand-edges", edges),
    ("hand-rows", rows),
    ("hand-plane", plane),
    ("hand-steps", steps),
    ("hand-window", window),
    ("hand-winding", winding),
    ("hand-turns", turns),
    ("hand-light", light),
    ("hand-exercises", exercises),
    ("hand-snapped", snapped),
    ("hand-words", words),
    ("hand-crossing", crossing),
    ("hand-in-space", in_space),
    ("hand-depths", depths),
    ("hand-cut", cut),
    ("hand-shares", shares),
    ("hand-share-errors", share_errors),
    ("hand-shadings", shadings),
    ("hand-mixed", mixed),
    ("hand-floor", floor),
    ("hand-levels", levels),
    ("hand-seam", seam),
];

/// A window that holds the examples.
const WINDOW: PixelRect = PixelRect { x0: 0, y0: 0, x1: 12, y1: 12 };

/// The corners on the lattice, on which all examples lie.
fn corners(corners_px: [[f64; 2]; 3]) -> Corners {
    corners_px.map(|[x, y]| SubpixelPoint::from_px(x, y).unwrap())
}

/// The value at each pixel of a triangle whose corners have these positions and values, by the edge-function engine.
fn values(corners_px: [[f64; 2]; 3], values: [f64; 3]) -> Vec<([i32; 2], f64)> {
    values_in_space(corners_px, [1.0; 3], values)
}

/// The same for corners with these w.
fn values_in_space(
    corners_px: [[f64; 2]; 3],
    w: [f64; 3],
    values: [f64; 3],
) -> Vec<([i32; 2], f64)> {
    let vertices = [0, 1, 2].map(|i: usize| {
        let [x, y] = corners_px[i];
        ScreenVertex::new(x, y, 0.0, w[i], values[i]).unwrap()
    });
    let mut found = Vec::new();
    EdgeFunction.fragments(&ScreenTriangle { vertices }, WINDOW, |f| {
        found.push(([f.x_px, f.y_px], f.varying));
    });
    found
}

/// The value at one pixel; see [`values`].
fn value_at(corners_px: [[f64; 2]; 3], of_corners: [f64; 3], pixel: [i32; 2]) -> f64 {
    values(corners_px, of_corners).into_iter().find(|(at, _)| *at == pixel).unwrap().1
}

/// The three edge functions at the centre of a pixel, each opposite its corner, in parts of a pixel squared.
fn edge_functions(corners_px: [[f64; 2]; 3], [x, y]: [i32; 2], parts: f64) -> [f64; 3] {
    // The engine computes in square subpixels.
    let unit = f64::from(SUBPIXELS) / parts;
    edges_at(&corners(corners_px), x, y).unwrap().map(|edge| edge.value as f64 / (unit * unit))
}

/// Chapter 1: a square of 2.8 px, with samples in the centres, and in the corners of the pixels.
fn square() -> Vec<f64> {
    // To move the square by half a pixel is to move the samples the other way.
    vec![covered_by_square(0.6, 3.4), covered_by_square(0.6 + 0.5, 3.4 + 0.5)]
}

/// How many samples are covered by the square of two halves whose coordinates run from `low` to `high`.
fn covered_by_square(low: f64, high: f64) -> f64 {
    let halves = [[[low, low], [high, low], [high, high]], [[low, low], [high, high], [low, high]]];
    let triangles = halves.map(|half| rasterproof_verify::cases::Triangle {
        vertices: corners(half).map(|position| ScreenVertex {
            position,
            depth: 0.0,
            inv_w: 1.0,
            varying: DVec2::ZERO,
        }),
    });
    oracle_coverage(&triangles, WINDOW).covered() as f64
}

/// Chapter 2: the rows of a line by column, and the pixels of a steep one.
fn lines() -> Vec<f64> {
    let mut all = rows_of_line([5, 2]);
    all.push(rows_of_line([3, 9]).len() as f64);
    all
}

/// The row of each pixel of a line from (0, 0).
fn rows_of_line(to: [i32; 2]) -> Vec<f64> {
    let line = plain_line(PixelPoint::new(0, 0), PixelPoint::new(to[0], to[1]));
    let mut found = Vec::new();
    Dda.draw(&line, WINDOW, |f| found.push(f64::from(f.y_px)));
    found
}

/// Chapter 3: the value after one of four steps.
fn step() -> Vec<f64> {
    // Four columns from 2 to 10: the value grows by 2 in each.
    let end = |x, varying| LineEnd { pixel: PixelPoint::new(x, 0), depth: 0.0, varying };
    let mut found = Vec::new();
    Dda.draw(&ScreenLine { ends: [end(0, 2.0), end(4, 10.0)] }, WINDOW, |f| found.push(f.varying));
    vec![found[1]]
}

const UPPER: [[f64; 2]; 3] = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]];
const LOWER: [[f64; 2]; 3] = [[0.0, 0.0], [4.0, 4.0], [0.0, 4.0]];

/// The edge functions of the upper triangle in half pixels, their sum, and the one on the diagonal in both triangles.
fn edges() -> Vec<f64> {
    // The engine names an edge by the corner opposite, the chapter by the corner where it begins.
    let [second, third, first] = edge_functions(UPPER, [2, 1], 2.0);
    let ties = [edge_functions(UPPER, [1, 1], 2.0)[1], edge_functions(LOWER, [1, 1], 2.0)[2]];
    vec![first, second, third, first + second + third, ties[0], ties[1]]
}

/// The pixels of each row of both halves of a square, and of both together.
fn rows() -> Vec<f64> {
    let mut counts = Vec::new();
    for half in [LOWER, UPPER] {
        let mut rows = [0.0; 4];
        for ([_, y], _) in values(half, [0.0; 3]) {
            rows[y as usize] += 1.0;
        }
        counts.extend(rows);
    }
    counts.push(counts.iter().sum());
    counts
}

/// Chapter 3: the value of a plane at a point, and the third exercise: edge functions, and the value.
fn plane() -> Vec<f64> {
    // Moved by half a pixel, so that the point is a centre.
    let value = value_at([[0.5, 0.5], [8.5, 0.5], [0.5, 8.5]], [100.0, 20.0, 60.0], [3, 3]);
    let triangle = [[1.0, 0.0], [5.0, 2.0], [0.0, 5.0]];
    let [a, b, c] = edge_functions(triangle, [1, 3], 1.0);
    let [first, second] = [[0, 3], [1, 3]].map(|at| value_at(triangle, [0.0, 10.0, 20.0], at));
    vec![value, a, b, c, a + b + c, second, first]
}

/// Chapter 5: the shares of the picture that four equal steps in space take.
fn steps() -> Vec<f64> {
    let projection = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0).unwrap();
    // The place in the picture of the beginning and of the end of each step.
    let places = [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| {
        let p = projection * DVec3::new(12.0 * t, 0.0, 1.0 + 2.0 * t).extend(1.0);
        p.x / p.w / 4.0
    });
    places.windows(2).map(|step| step[1] - step[0]).collect()
}

/// Chapter 8: where a point is in a window of 5 x 5 px.
fn window() -> Vec<f64> {
    let p =
        frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0).unwrap() * DVec3::new(2.0, 1.0, 4.0).extend(1.0);
    vec![(p.x / p.w + 1.0) / 2.0 * 5.0, (1.0 - p.y / p.w) / 2.0 * 5.0]
}

/// Chapter 9: twice the area of a triangle, which is the sum of its edge functions.
fn winding() -> Vec<f64> {
    vec![edge_functions([[1.0, 1.0], [4.0, 1.0], [1.0, 4.0]], [1, 1], 1.0).iter().sum()]
}

/// Chapter 1: the square of the specimen `games101-int`, with its samples in the corners and a right rule for edges. As in the
/// published program, y points up, so that the lower left corner of a pixel is its sample.
fn corner_square() -> Vec<f64> {
    let halves = [[[2.5, 2.5], [10.5, 2.5], [10.5, 10.5]], [[2.5, 10.5], [2.5, 2.5], [10.5, 10.5]]];
    let corner = TriangleConvention {
        shape: Shape::Point { x: 0, y: SUBPIXELS },
        ..TriangleConvention::default()
    };
    let window = PixelRect::window(14, 14);
    let mut hits = Coverage::new(window, 0);
    for half in halves {
        for (y_px, x0_px, x1_px) in corner.cover(&corners(half), window).unwrap().runs() {
            hits.hit(y_px, x0_px, x1_px);
        }
    }
    // No hole and no double hit: each of the rows 2 to 9 has the columns 3 to 10, once.
    for (y_px, row) in hits.rows() {
        for (x, &hits) in row.iter().enumerate() {
            let is_in = (2..10).contains(&y_px) && (3..11).contains(&x);
            assert_eq!(hits, u8::from(is_in), "row {y_px}");
        }
    }
    vec![hits.covered() as f64]
}

/// Where the straight line from a to b is at this x.
fn height(a: [f64; 2], b: [f64; 2], x: f64) -> f64 {
    a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])
}

/// Chapter 1: a snapped coordinate and how far it moved, the crack beside a snapped corner, and small coordinates in subpixels.
fn snapped() -> Vec<f64> {
    let subpixels = f64::from(SUBPIXELS);
    let snapped = f64::from(SubpixelPoint::from_px(1.7, 0.0).unwrap().x) / subpixels;
    // The diagonal at the column of the corner, and farther right, where the crack is.
    let [at_corner, beside] = [5.0, 6.5].map(|x| height([0.0, 0.0], [9.0, 5.0], x));
    let upper = height([5.0, 2.5], [9.0, 5.0], 6.5);
    let small = [0.001, 0.0019].map(|px| px * subpixels);
    vec![snapped, 1.7 - snapped, at_corner, upper, beside, small[0], small[1]]
}

/// Chapter 2b: the first side of a square box that does not fit 32 bits, and the widest box 16 px high that does, both in subpixels.
fn words() -> Vec<f64> {
    let square = (1i32..).find(|side| side.checked_mul(*side).is_none()).unwrap();
    vec![square.into(), widest_box(1)]
}

/// The widest box of 16 px height of which the products fit 32 bits, in units of so many subpixels. The edge functions reach one
/// pixel farther than the box on each axis.
fn widest_box(unit: i64) -> f64 {
    let mut width = 1;
    while ((width + 1) * unit + 256) * (16 * 256 + 256) < 1 << 31 {
        width += 1;
    }
    width as f64
}

/// Chapter 2c: where the long edge of the last exercise crosses row 5.
fn crossing() -> Vec<f64> {
    // Columns and rows exchanged.
    vec![height([0.0, 0.0], [10.0, 3.0], 5.5)]
}

/// Chapter 5: the value at three quarters of an edge from w = 4 to w = 1, and the affine one.
fn in_space() -> Vec<f64> {
    // The centre of pixel (3, 0) lies on the upper edge, which belongs to the triangle.
    let corners_px = [[0.5, 0.5], [4.5, 0.5], [0.5, 8.5]];
    let mut found = Vec::new();
    for w in [[4.0, 1.0, 1.0], [1.0; 3]] {
        let all = values_in_space(corners_px, w, [0.0, 10.0, 0.0]);
        found.push(all.into_iter().find(|(at, _)| *at == [3, 0]).unwrap().1);
    }
    found
}

/// The depth from 0 to 1 at a distance, with the far plane at 100.
fn depth_at(near: f64, z: f64) -> f64 {
    let projected =
        frustum(-1.0, 1.0, -1.0, 1.0, near, 100.0).unwrap() * DVec3::new(0.0, 0.0, z).extend(1.0);
    (projected.z / projected.w + 1.0) / 2.0
}

/// By how much this depth grows for each unit of distance.
fn depth_slope(near: f64, z: f64) -> f64 {
    // The difference of two depths around the distance.
    let half = 1e-3;
    (depth_at(near, z + half) - depth_at(near, z - half)) / (2.0 * half)
}

/// Chapter 6: depths, the slope at distance 50, a step of 16 bits and its length there, the same for a near plane at half of the
/// distance, the slope at the far plane, and how many steps of 0.01 it asks for.
fn depths() -> Vec<f64> {
    // One step of a buffer of 16 bits; its length in space is the step over the slope.
    let step = 0.5f64.powi(16);
    let [slope, nearer, far] =
        [(1.0, 50.0), (0.5, 50.0), (1.0, 100.0)].map(|(near, z)| depth_slope(near, z));
    let [two, ten, fifty] = [2.0, 10.0, 50.0].map(|z| depth_at(1.0, z));
    vec![two, ten, fifty, slope, step, step / slope, step / nearer, nearer, far, 1.0 / (0.01 * far)]
}

/// Chapter 7: a value at a third of an edge, computed from the end that is farther away.
fn cut() -> Vec<f64> {
    vec![0.5 - 0.3 * (2.0 / 3.0)]
}

/// Chapter 10: scaled and moved, moved and scaled, and turned about another point.
fn turns() -> Vec<f64> {
    let (larger, moved) =
        (DMat4::from_scale(DVec3::splat(2.0)), DMat4::from_translation(DVec3::X * 3.0));
    let corner = DVec3::new(1.0, 1.0, 0.0);
    let [a, b] = [moved * larger, larger * moved].map(|matrix| matrix.transform_point3(corner));
    let c =
        about(DVec3::X * 4.0, turn_z(std::f64::consts::FRAC_PI_2)).transform_point3(DVec3::X * 5.0);
    vec![a.x, a.y, b.x, b.y, c.x, c.y]
}

/// Chapter 11: the brightness of a road, and of a place between two texels, by both filters.
fn light() -> Vec<f64> {
    let light = Light { towards: DVec3::new(0.6, 0.8, 0.0), ambient: 0.0, diffuse: 1.0 };
    let brightness = light.intensity(DVec3::Y);
    let mut all = vec![brightness, brightness * 100.0];
    for filter in [Filter::Nearest, Filter::Bilinear] {
        let row = Texture::grey(4, 1, vec![10, 20, 30, 40]).unwrap().with(filter, Wrap::Repeat);
        all.push(row.at(DVec2::new(0.6, 0.5)).x * 255.0);
    }
    all
}

/// The chapter on samples: a flat edge through eight pixels of a row, and the triangle on its other side.
const FLAT: [[f64; 2]; 3] = [[0.0, 0.0], [8.0, 1.0], [0.0, 1.0]];
const OTHER_SIDE: [[f64; 2]; 3] = [[0.0, 0.0], [8.0, 0.0], [8.0, 1.0]];

/// The share that a triangle covers of each of the eight pixels.
fn row_of_shares(mut choice: impl Antialias, triangle: [[f64; 2]; 3]) -> Vec<f64> {
    let mut target = Frame::new(PixelRect::window(8, 1), 0.0);
    choice.draw(&[corners(triangle)], &mut target);
    target.row(0).to_vec()
}

/// By one sample, a grid of 2 x 2, the pattern of four and a grid of 4 x 4.
fn sampled_shares() -> [Vec<f64>; 4] {
    [
        row_of_shares(Multisample::new(Scanline, ONE), FLAT),
        row_of_shares(Supersample::new(Scanline, 2), FLAT),
        row_of_shares(Multisample::new(Scanline, FOUR), FLAT),
        row_of_shares(Supersample::new(Scanline, 4), FLAT),
    ]
}

/// The exact shares, then the sampled ones.
fn shares() -> Vec<f64> {
    [vec![row_of_shares(ExactArea, FLAT)], sampled_shares().to_vec()].concat().concat()
}

/// The root of the mean square of the errors of each choice.
fn share_errors() -> Vec<f64> {
    let exact = row_of_shares(ExactArea, FLAT);
    let mut errors = Vec::new();
    for shares in sampled_shares() {
        let squares: f64 = shares.iter().zip(&exact).map(|(a, b)| (a - b).powi(2)).sum();
        errors.push((squares / 8.0).sqrt());
    }
    errors
}

/// How often a colour is computed: once for each pixel with a covered sample, or for each covered sample of a grid.
fn shadings() -> Vec<f64> {
    let [one, two, pattern, four] = sampled_shares();
    let [one, pattern] =
        [one, pattern].map(|shares| shares.iter().filter(|share| **share > 0.0).count() as f64);
    // A share is the number of covered samples over the number of all.
    let samples_of_two = two.iter().sum::<f64>() * 4.0;
    let samples_of_four = four.iter().sum::<f64>() * 16.0;
    vec![one, pattern, samples_of_two, samples_of_four]
}

/// The shares of pixel 2 of the triangles on both sides, and the white of 255 that is left when two black ones are mixed by them.
fn mixed() -> Vec<f64> {
    let [first, second] = [FLAT, OTHER_SIDE].map(|side| row_of_shares(ExactArea, side)[2]);
    vec![first, second, 255.0 * (1.0 - first) * (1.0 - second)]
}

/// The chapter on textures: a floor whose row of pixels s lies at the distance 100/s, with 16 texels for each unit of length. Row 0
/// is the horizon.
struct Floor {
    triangle: ScreenTriangle<DVec2>,
    footprint: Footprint,
}

impl Floor {
    /// Texels along a side of the texture.
    const SIDE: f64 = 256.0;

    fn new() -> Self {
        // Half a pixel further, so that the centres of pixels lie on whole coordinates.
        let vertices = [[0.0, 5.0], [64.0, 5.0], [0.0, 80.0]].map(|[x, s]: [f64; 2]| {
            let uv = DVec2::new(16.0 * x / s, 1600.0 / s) / Self::SIDE;
            ScreenVertex::new(x + 0.5, s + 0.5, 0.0, 100.0 / s, uv).unwrap()
        });
        let triangle = ScreenTriangle { vertices };
        let footprint = Footprint::new(
            triangle.corners(),
            vertices.map(|vertex| vertex.inv_w),
            vertices.map(|vertex| vertex.varying),
            (Self::SIDE as u32, Self::SIDE as u32),
        );
        Self { triangle, footprint }
    }

    /// The texture coordinates in column 0 of a row.
    fn uv(&self, row: i32) -> DVec2 {
        // The engine computes them, and not the formula by which the corners were made.
        let mut found = None;
        EdgeFunction.fragments(&self.triangle, PixelRect::window(64, 64), |f| {
            if (f.x_px, f.y_px) == (0, row) {
                found = Some(f.varying);
            }
        });
        found.unwrap()
    }
}

/// The lengths of the derivatives and the levels in some rows, the difference of two pixels, and how row 10 is read along its axis.
fn floor() -> Vec<f64> {
    let floor = Floor::new();
    // Row 10 lies at the distance 10.
    let [across, along] = floor.footprint.lengths(floor.uv(10), 10.0);
    let taps = floor.footprint.taps(floor.uv(10), 10.0, 16);
    let [above, here, below] = [9, 10, 11].map(|row| floor.uv(row).y * Floor::SIDE);
    let differences = [here - below, above - here];
    let mut all = vec![across, along];
    for row in [10, 20, 40, 50] {
        all.push(floor.footprint.level(floor.uv(row), 100.0 / f64::from(row)));
    }
    all.extend(differences);
    all.extend(differences.map(libm::log2));
    all.extend([f64::from(taps.count), taps.level]);
    all
}

/// A row of eight texels at the levels 1 to 3 and at 1.5, and one of two islands at the levels 2 and 3.
fn levels() -> Vec<f64> {
    let mut all = at_levels([10, 30, 50, 70, 90, 110, 130, 150], &[1.0, 2.0, 3.0, 1.5]);
    all.extend(at_levels([200, 200, 200, 200, 0, 0, 0, 0], &[2.0, 3.0]));
    all
}

/// What is read at a place of the first texel of a row at some levels, from 0 to 255.
fn at_levels(grey: [u8; 8], levels: &[f64]) -> Vec<f64> {
    let row = Texture::grey(8, 1, grey.to_vec()).unwrap().with_mip_map();
    levels.iter().map(|level| row.at_level(DVec2::new(0.1, 0.5), *level).x * 255.0).collect()
}

/// The levels of a difference of two coordinates across the seam of a texture of 256 texels, wrapped and not.
fn seam() -> Vec<f64> {
    [0.002 - 0.998, 1.002 - 0.998]
        .map(|difference: f64| libm::log2((difference * 256.0).abs()))
        .to_vec()
}

/// What the harder exercises of the chapters come to, in the order of the pages.
fn exercises() -> Vec<f64> {
    // Chapter 1: the mean of squares, each at a place of its own, and a triangle that vanishes.
    let side = 2.8_f64;
    let part = side.fract();
    let mean = (part * side.ceil() + (1.0 - part) * side.floor()).powi(2);
    let vanishing = [[0.0, 0.0], [1024.0, 0.0], [512.0, 0.0019]];
    assert_eq!(twice_area(&corners(vanishing)), 0);
    let area = 1024.0 * vanishing[2][1] / 2.0;
    // Chapter 2: ties of a line, and the first product that overflows.
    let ties = (0..=12).filter(|x| (2 * x * 10) % 24 == 12).count() as f64;
    let overflowing =
        (1i32..).find(|u| 2i32.checked_mul(*u).and_then(|v| v.checked_mul(*u)).is_none());
    let row = values([[0.0, 0.0], [7.0, 4.0], [3.0, 10.0]], [0.0; 3]);
    let row: Vec<_> = row.iter().filter(|([_, y], _)| *y == 5).map(|([x, _], _)| *x).collect();
    assert_eq!((row.iter().min(), row.iter().max()), (Some(&2), Some(&5)));
    // Chapters 4 and 5: the middle of a picture, and the largest error of affine values.
    let middle = 0.25;
    assert_eq!(6.0 * middle / (2.0 + 4.0 * middle), 0.5);
    let mut worst = 0.0_f64;
    for k in 0..=3000 {
        let t = f64::from(k) / 3000.0;
        worst = worst.max(t - t / (4.0 - f64::from(k) / 1000.0));
    }
    // Chapter 6: bits of depth.
    let slope = 100.0 / (99.0 * 100.0 * 100.0);
    let bits = (1..).find(|bits| 0.5f64.powi(*bits) / slope < 0.01).unwrap();
    // Chapter 8: depth from 0 to 1.
    let depth = (10.0 / 9.0 * 2.0 - 10.0 / 9.0) / 2.0;
    // Chapter 10: a reflection, and what a turn makes of a move.
    let [there, back] = [2.0, -2.0].map(|x| DMat4::from_translation(DVec3::X * x));
    let reflected = there * DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)) * back;
    assert_eq!(reflected.determinant(), -1.0);
    // A turn takes the direction of a move along.
    let turned = turn_z(std::f64::consts::FRAC_PI_2).transform_vector3(DVec3::X * 3.0);
    // Chapter 11: a stretched roof, and short normals.
    let [flat, steep] = [[1.0, 4.0], [4.0, 1.0]].map(|n| DVec2::from(n).normalize().y);
    let mean_of_60 = (DVec2::X + DVec2::from_angle(60f64.to_radians())) / 2.0;
    vec![
        mean,
        area,
        ties,
        f64::from(overflowing.unwrap()),
        widest_box(256),
        row.len() as f64,
        middle,
        worst,
        f64::from(bits),
        clipped_corners() as f64,
        depth,
        12.0 * 3.0,
        reflected.transform_point3(DVec3::X * 5.0).x,
        turned.y,
        flat,
        steep,
        mean_of_60.length(),
        2.0 * libm::acos(0.95).to_degrees(),
    ]
}

/// Corners of an equilateral triangle around the window from -1 to 1, turned by 15 degrees, after it was cut by the four sides.
fn clipped_corners() -> usize {
    let triangle = [105.0_f64, 225.0, 345.0].map(|degrees| {
        let [x, y] = (DVec2::from_angle(degrees.to_radians()) * 2.0).to_array();
        ClipVertex { position: DVec4::new(x, y, 0.0, 1.0), varying: 0.0 }
    });
    let (polygon, _) = clip(&triangle, Outcode::MAX);
    polygon.vertices().count()
}
