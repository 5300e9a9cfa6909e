//! The rungs of the two ladders of coverage under criterion: the same scenes and the same bodies as
//! `rasterproof cost`, one benchmark for each rung and class.
//!
//! Each benchmark first asserts what the rung covers: a rung that promises exactness covers as many
//! pixels as the exact oracle, every other one a number that the seed decides, the same when asked
//! again. `cargo bench --bench ladder -- sliver/f64` picks by name. `rasterproof cost` measures all
//! ladders, in interleaved rounds, and is the one to compare rungs with.
#![allow(
    clippy::disallowed_methods,
    reason = "tests and benches read and write files of their own"
)]

use std::hint::black_box;
use std::time::Duration;

use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use rasterproof_core::contract::RasterizeExact;
use rasterproof_core::frame::Frame;
use rasterproof_precision::cost::scene::{Scene, Size, W_PREFIX, scenes};
use rasterproof_precision::cost::{Ladder, Variant, variants};
use rasterproof_precision::ladder::snap;
use rasterproof_verify::oracle::Oracle;

fn covered(variant: &Variant, scene: &Scene) -> u64 {
    let mut spans = Vec::new();
    for corners in &scene.triangles {
        variant.spans(corners, scene.bounds, &mut spans).expect("the scenes suit every rung");
    }
    spans.iter().map(|span| u64::from(span.x0_px.abs_diff(span.x1_px))).sum()
}

/// Pixels by the oracle, of the corners as given or as snapped.
fn truth(scene: &Scene, snapped: bool) -> u64 {
    let mut pixels = 0;
    for corners in &scene.triangles {
        let corners = if snapped { snap(corners).map(Into::into) } else { Some(*corners) };
        let corners = corners.expect("the scenes lie on the lattice");
        Oracle.cover_exact(&corners, scene.bounds, |span| {
            pixels += u64::from(span.x0_px.abs_diff(span.x1_px));
        });
    }
    pixels
}

fn ladders(criterion: &mut Criterion) {
    let scenes = scenes(1, Size { side_px: 1024, pixels: 60_000 });
    for scene in scenes.iter().filter(|scene| !scene.name.starts_with(W_PREFIX)) {
        let truths = [truth(scene, false), truth(scene, true)];
        for (ladder, kind) in [(Ladder::Scanline, "scanline"), (Ladder::EdgeFunction, "edge")] {
            for variant in variants(ladder) {
                bench(criterion, scene, &truths, kind, &variant);
            }
        }
    }
}

fn bench(
    criterion: &mut Criterion,
    scene: &Scene,
    truths: &[u64; 2],
    kind: &str,
    variant: &Variant,
) {
    let pixels = covered(variant, scene);
    assert_eq!(pixels, covered(variant, scene), "the same pixels each time");
    for &promise in &variant.rung.promises {
        assert_eq!(pixels, truths[promise], "{} on {}", variant.rung.name, scene.name);
    }
    let mut target = Frame::new(scene.bounds, 0);
    let mut group = criterion.benchmark_group(format!("ladder/{}", scene.name));
    group.sampling_mode(SamplingMode::Flat);
    group.throughput(Throughput::Elements(pixels));
    let name = format!("{kind} {}", variant.rung.name);
    group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
        bencher.iter(|| variant.paint(black_box(&scene.triangles), &mut target));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    targets = ladders
}
criterion_main!(benches);
