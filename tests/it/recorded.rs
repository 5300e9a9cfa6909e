//! What two Vulkan drivers drew (`tests/data`), against both engines and the oracle.

use std::io::{BufRead, BufReader};

use flate2::read::GzDecoder;
use glam::DVec2;
use rasterproof_core::contract::{Interpolate, Rasterize};
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::{PixelRect, SubpixelPoint, snap};
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};
use rasterproof_registry::engines::Engine;
use rasterproof_render::pipeline::multisample::masks;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::tolerance;
use rasterproof_verify::oracle::values::ExactTriangle;
use serde_json::Value;

const ENGINES: [Engine; 3] = [Engine::Scanline, Engine::EdgeFunction, Engine::Oracle];

/// SwiftShader's subpixels are 16 of ours.
const SWIFTSHADER_STEP: i32 = 16;

pub fn records(name: &str) -> Vec<Value> {
    let path = format!("{}/tests/data/{name}.jsonl.gz", env!("CARGO_MANIFEST_DIR"));
    let file = std::fs::File::open(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let lines = BufReader::new(GzDecoder::new(file)).lines();
    lines.map(|line| serde_json::from_str(&line.unwrap()).unwrap()).collect()
}

fn int(value: &Value) -> i64 {
    value.as_i64().unwrap_or_else(|| panic!("{value} is no whole number"))
}

pub fn items(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("{value} is no list"))
}

/// The multiple of `step` nearest to `sub`, ties to the even one.
fn to_step(sub: i64, step: i32) -> i32 {
    let step = i64::from(step);
    let (below, rest) = (sub.div_euclid(step), sub.rem_euclid(step));
    let up = 2 * rest > step || (2 * rest == step && below % 2 != 0);
    ((below + i64::from(up)) * step) as i32
}

fn points(record: &Value, step: i32) -> Vec<SubpixelPoint> {
    let point =
        |v: &Value| SubpixelPoint::new(to_step(int(&v[0]), step), to_step(int(&v[1]), step));
    items(&record["v"]).iter().map(point).collect()
}

fn runs(record: &Value, window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for run in items(&record["runs"]) {
        let [y, x0, x1] = [0, 1, 2].map(|i| int(&run[i]) as i32);
        hits.hit(y, x0, x1);
    }
    hits
}

/// Draws all triangles of a record with one engine and compares hit counts, fans and quads too:
/// each listed pixel once, no other.
fn check_coverage(driver: &str, step: i32) -> usize {
    let mut checked = 0;
    for record in records(&format!("vulkan-coverage.{driver}")) {
        if int(&record["clipped"]) != 0 || record["kind"] == "far4000" {
            continue;
        }
        // Viewports may be larger; what was read back is this corner of them.
        let window = PixelRect::window(64, 64);
        let target = runs(&record, window);
        let corners = points(&record, step);
        for engine in ENGINES {
            let mut actual = Coverage::new(window, 0);
            for corners in corners.chunks_exact(3) {
                let corners = [corners[0], corners[1], corners[2]];
                engine.cover(corners, window, |s| actual.hit(s.y_px, s.x0_px, s.x1_px));
            }
            assert_eq!(actual, target, "{} differs from {driver} on {record}", engine.name());
        }
        checked += 1;
    }
    checked
}

#[test]
fn coverage_equals_lavapipe() {
    assert_eq!(check_coverage("lavapipe", 1), 1460);
}

#[test]
fn coverage_equals_swiftshader() {
    assert_eq!(check_coverage("swiftshader", SWIFTSHADER_STEP), 638);
}

/// The comparison above can fail: with the wrong step it does.
#[test]
#[should_panic(expected = "differs from swiftshader")]
fn coverage_differs_without_the_drivers_snapping() {
    let unsnapped = records("vulkan-coverage.swiftshader");
    assert!(unsnapped.iter().any(|r| points(r, 1) != points(r, SWIFTSHADER_STEP)));
    check_coverage("swiftshader", 64);
}

fn check_snapping(driver: &str, step: i32) {
    let all = records(&format!("vulkan-snap.{driver}"));
    assert_eq!(all.len(), 125);
    for record in &all {
        let window = PixelRect::window(64, 64);
        let mut corners = Vec::new();
        for (bits, snapped) in items(&record["win_f32_bits"]).iter().zip(items(&record["snapped"]))
        {
            let ours = [0, 1].map(|i| {
                let px = f64::from(f32::from_bits(int(&bits[i]) as u32));
                // A coarser lattice: snap px * 256 / step there, so that one rounding remains.
                snap(px / f64::from(step)).unwrap() * step
            });
            let target = [0, 1].map(|i| int(&snapped[i]) as i32);
            assert_eq!(ours, target, "{driver} snaps otherwise in {record}");
            corners.push(SubpixelPoint::new(ours[0], ours[1]));
        }
        for engine in ENGINES {
            let mut actual = Coverage::new(window, 0);
            engine.cover([corners[0], corners[1], corners[2]], window, |s| {
                actual.hit(s.y_px, s.x0_px, s.x1_px)
            });
            assert_eq!(actual, runs(record, window), "{} on {record}", engine.name());
        }
    }
}

#[test]
fn snapping_equals_lavapipe() {
    check_snapping("lavapipe", 1);
}

#[test]
fn snapping_equals_swiftshader() {
    check_snapping("swiftshader", SWIFTSHADER_STEP);
}

/// The triangle of an interpolation record: w and z/w from the clip position, two attributes.
fn interpolated(record: &Value, step: i32) -> Triangle {
    let corners = points(record, step);
    let float = |value: &Value| f64::from(f32::from_bits(int(value) as u32));
    let vertex = |i: usize| {
        let clip = &record["clip_bits"][i];
        let (z, w) = (float(&clip[2]), float(&clip[3]));
        let a = &record["a_bits"][i];
        ScreenVertex {
            position: corners[i],
            depth: z / w,
            inv_w: 1.0 / w,
            varying: DVec2::new(float(&a[0]), float(&a[1])),
        }
    };
    ScreenTriangle { vertices: [vertex(0), vertex(1), vertex(2)] }
}

/// Values against the exact ones within the derived bound (and within 1e-12 of the largest), and
/// against the driver's within its own error of 1e-4 of the largest value.
fn check_interpolation(driver: &str, step: i32) {
    let all = records(&format!("vulkan-interp.{driver}"));
    assert_eq!(all.len(), 125);
    let mut compared = 0;
    for record in &all {
        let triangle = interpolated(record, step);
        let v = &triangle.vertices;
        let attributes = v.map(|v| v.varying.to_array());
        let depths = v.map(|v| v.depth);
        let exact = ExactTriangle::new(&triangle.corners(), depths, v.map(|v| v.inv_w), attributes)
            .unwrap();
        let largest = |values: [f64; 3]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let recorded: std::collections::HashMap<(i32, i32), [f64; 3]> = items(&record["px"])
            .iter()
            .map(|px| {
                let float = |i: usize| f64::from(f32::from_bits(int(&px[i]) as u32));
                ((int(&px[0]) as i32, int(&px[1]) as i32), [float(2), float(3), float(7)])
            })
            .collect();
        for (engine, bound) in [
            (Engine::Scanline, tolerance::SCANLINE),
            (Engine::EdgeFunction, tolerance::EDGE_FUNCTION),
            (Engine::Oracle, tolerance::ORACLE),
        ] {
            let mut seen = 0;
            engine.fragments(&triangle, PixelRect::window(64, 64), |f| {
                let Some(target) = recorded.get(&(f.x_px, f.y_px)) else { return };
                seen += 1;
                let (depth, values) = exact.at(f.x_px, f.y_px);
                let actual = [f.varying.x, f.varying.y];
                for k in 0..2 {
                    let at_vertices = attributes.map(|a| a[k]);
                    let error = values[k].distance(actual[k]);
                    assert!(
                        error <= bound.attribute.at(at_vertices),
                        "{}: {error:e} on {record}",
                        engine.name()
                    );
                    assert!(error <= 1e-12 * largest(at_vertices));
                    assert!(
                        (actual[k] - target[k]).abs() <= 1e-4 * largest(at_vertices),
                        "{} is {} at {},{} of {record}",
                        engine.name(),
                        actual[k],
                        f.x_px,
                        f.y_px
                    );
                }
                let error = depth.distance(f.depth);
                assert!(error <= bound.depth.at(depths) && error <= 1e-12 * largest(depths));
                assert!((f.depth - target[2]).abs() <= 1e-4 * largest(depths));
            });
            assert_eq!(
                seen,
                recorded.len(),
                "{} misses a recorded pixel of {record}",
                engine.name()
            );
            compared += seen;
        }
    }
    assert_eq!(compared, 3 * all.iter().map(|r| items(&r["px"]).len()).sum::<usize>());
}

#[test]
fn interpolation_agrees_with_lavapipe() {
    check_interpolation("lavapipe", 1);
}

#[test]
fn interpolation_agrees_with_swiftshader() {
    check_interpolation("swiftshader", 1);
}

/// Four samples a pixel: the masks of each triangle, by every engine.
fn check_masks(driver: &str, step: i32) -> usize {
    let window = PixelRect::window(64, 64);
    let mut checked = 0;
    for record in records(&format!("vulkan-msaa.{driver}")) {
        let mut target = Frame::new(window, 0u8);
        for run in items(&record["mask_runs"]) {
            let [mask, y, x0, x1] = [0, 1, 2, 3].map(|i| int(&run[i]) as i32);
            target.span_mut(y, x0, x1).fill(mask as u8);
        }
        let corners = points(&record, step);
        for engine in ENGINES {
            let corners = [corners[0], corners[1], corners[2]];
            let actual = masks(&engine, corners, window).unwrap();
            assert!(actual == target, "{} differs from {driver} on {record}", engine.name());
        }
        checked += 1;
    }
    checked
}

#[test]
fn masks_of_lavapipe() {
    assert!(check_masks("lavapipe", 1) > 100);
}

#[test]
fn masks_of_swiftshader() {
    assert!(check_masks("swiftshader", SWIFTSHADER_STEP) > 100);
}
