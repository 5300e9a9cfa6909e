//! Both engines and both line drawers by themselves: pixels per second, with and without values.
//!
//! Every bench first asserts that it draws as many pixels as the exact oracle, so that no time is
//! ever reported for a wrong picture. `cargo bench -p benches --bench fill -- medium/scanline` picks by name.
//! For times beside those of other crates see `peers`.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

mod common;

use std::hint::black_box;
use std::time::Duration;

use common::{COLOUR, SIDE_PX, Scene, covered, fill, window};
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use glam::DVec2;
use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::line::dda::Dda;
use rasterproof_core::random::Rng;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{
    Fragment, LineEnd, PixelPoint, ScreenLine, ScreenTriangle, ScreenVertex, Span,
};
use rasterproof_tiles::coverage::{CoverList, Tiles};
use rasterproof_tiles::paint;
use rasterproof_verify::oracle::Oracle;

fn cover(criterion: &mut Criterion) {
    for scene in common::scenes() {
        // One for all: where its pages lie in memory moves times by a tenth.
        let mut target = Frame::new(window(), 0);
        bench_cover(criterion, &scene, "scanline", &Scanline, &mut target);
        bench_cover(criterion, &scene, "edge-function", &EdgeFunction, &mut target);
        for tiles in Tiles::levels() {
            bench_lists(criterion, &scene, &tiles, &mut target);
        }
    }
}

/// Fills all triangles as one list, each by the engine that is faster, in an instruction set.
fn bench_lists(criterion: &mut Criterion, scene: &Scene, tiles: &Tiles, target: &mut Frame<u32>) {
    let name = format!("list {}", tiles.instructions());
    let mut pixels = 0;
    tiles.cover_list(&scene.triangles, window(), &mut |pieces| {
        let mut count = |span: Span| pixels += u64::from(span.x0_px.abs_diff(span.x1_px));
        pieces.iter().for_each(|piece| piece.spans(&mut count));
    });
    assert_eq!(pixels, scene.pixels(), "{name} on {}", scene.name);
    let mut group = criterion.benchmark_group(format!("cover/{}", scene.name));
    group.throughput(Throughput::Elements(scene.pixels()));
    group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
        bencher.iter(|| {
            paint::fill(tiles, black_box(&scene.triangles), COLOUR, target);
        });
    });
}

/// Coverage only: fills every triangle with one colour.
fn bench_cover(
    criterion: &mut Criterion,
    scene: &Scene,
    name: &str,
    engine: &impl Rasterize,
    target: &mut Frame<u32>,
) {
    assert_eq!(covered(engine, &scene.triangles), scene.pixels(), "{name} on {}", scene.name);
    let mut group = criterion.benchmark_group(format!("cover/{}", scene.name));
    group.throughput(Throughput::Elements(scene.pixels()));
    group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
        bencher.iter(|| {
            for corners in black_box(&scene.triangles) {
                fill(engine, *corners, target);
            }
        });
    });
}

fn fragments(criterion: &mut Criterion) {
    for scene in common::scenes() {
        bench_fragments(criterion, &scene, "scanline", &Scanline);
        bench_fragments(criterion, &scene, "edge-function", &EdgeFunction);
    }
}

/// With values: each pixel is written with something that depends on all of its fragment.
fn bench_fragments(
    criterion: &mut Criterion,
    scene: &Scene,
    name: &str,
    engine: &impl Interpolate,
) {
    let triangles = with_values(scene);
    let mut drawn = 0;
    for triangle in &triangles {
        engine.fragments(triangle, window(), |_| drawn += 1);
    }
    assert_eq!(drawn, scene.pixels(), "{name} on {}", scene.name);

    let mut target = Frame::new(window(), 0);
    let mut group = criterion.benchmark_group(format!("fragments/{}", scene.name));
    // A pass takes milliseconds: samples of one length instead of growing ones.
    group.sampling_mode(SamplingMode::Flat);
    group.throughput(Throughput::Elements(scene.pixels()));
    group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
        bencher.iter(|| {
            for triangle in black_box(&triangles) {
                engine.fragments(triangle, window(), |fragment| write(&mut target, &fragment));
            }
        });
    });
}

/// The triangles of a scene with depths, different w and a pair of attributes at the corners.
fn with_values(scene: &Scene) -> Vec<ScreenTriangle<DVec2>> {
    let mut random = Rng::of_seed(0x7661_6c75_6573);
    let mut vertex = |position| {
        let (depth, inv_w) = (random.unit(), 0.5 + random.unit());
        let varying = DVec2::new(random.unit(), random.unit());
        ScreenVertex { position, depth, inv_w, varying }
    };
    let triangles = scene.triangles.iter();
    triangles.map(|corners| ScreenTriangle { vertices: corners.map(&mut vertex) }).collect()
}

fn write(target: &mut Frame<u32>, fragment: &Fragment<DVec2>) {
    let value = fragment.depth + fragment.varying.x + fragment.varying.y;
    // The window begins in column 0.
    target.row_mut(fragment.y_px)[fragment.x_px as usize] = (value as f32).to_bits();
}

fn lines(criterion: &mut Criterion) {
    let lines = random_lines();
    let mut pixels = 0;
    for line in &lines {
        Oracle.line_pixels(line, window(), |_, _| pixels += 1);
    }
    bench_lines(criterion, &lines, pixels, "dda", &Dda);
    bench_lines(criterion, &lines, pixels, "bresenham", &Bresenham);
}

/// A line of two billion pixels of which a 64 x 64 window sees 64: what is outside costs nothing.
fn far_line(criterion: &mut Criterion) {
    let end = |pixel| LineEnd { pixel, depth: 0.5, varying: DVec2::ZERO };
    let (a, b) = (PixelPoint::new(-1_000_000_000, 5), PixelPoint::new(1_000_000_000, 60));
    let line = ScreenLine { ends: [end(a), end(b)] };
    bench_far(criterion, &line, "dda", &Dda);
    bench_far(criterion, &line, "bresenham", &Bresenham);
}

fn bench_far(
    criterion: &mut Criterion,
    line: &ScreenLine<DVec2>,
    name: &str,
    drawer: &impl DrawLine,
) {
    let window = PixelRect::window(64, 64);
    let mut target = Vec::new();
    Oracle.line_pixels(line, window, |pixel, _| target.push((pixel.x, pixel.y)));
    assert_eq!(target.len(), 64);
    let mut actual = Vec::new();
    drawer.draw(line, window, |f| actual.push((f.x_px, f.y_px)));
    assert_eq!(actual, target, "{name}");
    let mut group = criterion.benchmark_group("line of two billion pixels");
    group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
        bencher.iter(|| {
            let mut sum = 0;
            drawer.draw(black_box(line), window, |f| sum += f.x_px);
            sum
        });
    });
}

/// Lines in all directions; half of them begin or end outside the window.
fn random_lines() -> Vec<ScreenLine<DVec2>> {
    let mut random = Rng::of_seed(0x006c_696e_6573);
    let mut coordinate = || ((random.unit() * 1.2 - 0.1) * f64::from(SIDE_PX)) as i32;
    let mut end = |varying| LineEnd {
        pixel: PixelPoint::new(coordinate(), coordinate()),
        depth: 0.5,
        varying,
    };
    (0..300).map(|_| ScreenLine { ends: [end(DVec2::ZERO), end(DVec2::ONE)] }).collect()
}

fn bench_lines(
    criterion: &mut Criterion,
    lines: &[ScreenLine<DVec2>],
    pixels: u64,
    name: &str,
    drawer: &impl DrawLine,
) {
    let mut drawn = 0;
    for line in lines {
        drawer.draw(line, window(), |_| drawn += 1);
    }
    assert_eq!(drawn, pixels, "{name}");

    let mut target = Frame::new(window(), 0);
    let mut group = criterion.benchmark_group("lines");
    group.throughput(Throughput::Elements(pixels));
    group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
        bencher.iter(|| {
            for line in black_box(lines) {
                drawer.draw(line, window(), |fragment| write(&mut target, &fragment));
            }
        });
    });
}

/// Short enough that all benches together take about a minute.
fn short() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500))
}

criterion_group! {
    name = benches;
    config = short();
    targets = cover, fragments, lines, far_line
}
criterion_main!(benches);
