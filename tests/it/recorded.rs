//! What two Vulkan drivers drew (`tests/data`), against both engines and the oracle.

use std::collections::HashMap;
use std::io::{BufRead, BufReader};

use flate2::read::GzDecoder;
use glam::DVec2;
use rasterproof_core::contract::{Interpolate, Rasterize};
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::{PixelRect, SubpixelPoint, snap};
use rasterproof_core::triangle::{Corners, ScreenTriangle, ScreenVertex};
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

/// The hits of triangles by an engine.
pub fn hits(engine: &impl Rasterize, triangles: &[Corners], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for &corners in triangles {
        engine.cover(corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
    }
    hits
}

/// Viewports may be larger; what was read back is this corner of them.
const WINDOW: PixelRect = PixelRect { x0: 0, y0: 0, x1: 64, y1: 64 };

/// Draws all triangles of a record with each engine and compares hit counts, fans and quads too:
/// each listed pixel once, no other.
fn check_hits(driver: &str, record: &Value, corners: &[SubpixelPoint]) {
    let mut target = Coverage::new(WINDOW, 0);
    for run in items(&record["runs"]) {
        let [y, x0, x1] = [0, 1, 2].map(|i| int(&run[i]) as i32);
        target.hit(y, x0, x1);
    }
    for engine in ENGINES {
        let actual = hits(&engine, corners.as_chunks().0, WINDOW);
        assert_eq!(actual, target, "{} differs from {driver} on {record}", engine.name());
    }
}

fn check_coverage(driver: &str, step: i32) -> usize {
    let mut all = records(&format!("vulkan-coverage.{driver}"));
    all.retain(|record| int(&record["clipped"]) == 0 && record["kind"] != "far4000");
    all.iter().for_each(|record| check_hits(driver, record, &points(record, step)));
    all.len()
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
        let corners = items(&record["win_f32_bits"]).iter().zip(items(&record["snapped"]));
        let snapped = |(bits, snapped): (&Value, &Value)| {
            let ours = [0, 1].map(|i| {
                let px = f64::from(f32::from_bits(int(&bits[i]) as u32));
                // A coarser lattice: snap px * 256 / step there, so that one rounding remains.
                snap(px / f64::from(step)).unwrap() * step
            });
            let target = [0, 1].map(|i| int(&snapped[i]) as i32);
            assert_eq!(ours, target, "{driver} snaps otherwise in {record}");
            SubpixelPoint::new(ours[0], ours[1])
        };
        check_hits(driver, record, &corners.map(snapped).collect::<Vec<_>>());
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

fn float(bits: &Value) -> f64 {
    f64::from(f32::from_bits(int(bits) as u32))
}

/// The triangle of an interpolation record: w and z/w from the clip position, two attributes.
fn interpolated(record: &Value, step: i32) -> Triangle {
    let corners = points(record, step);
    let vertices = [0, 1, 2].map(|i| {
        let (clip, a) = (&record["clip_bits"][i], &record["a_bits"][i]);
        let (z, w) = (float(&clip[2]), float(&clip[3]));
        ScreenVertex {
            position: corners[i],
            depth: z / w,
            inv_w: 1.0 / w,
            varying: DVec2::new(float(&a[0]), float(&a[1])),
        }
    });
    ScreenTriangle { vertices }
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
        let pixel = |px: &Value| {
            let at = (int(&px[0]) as i32, int(&px[1]) as i32);
            (at, [2, 3, 7].map(|i| float(&px[i])))
        };
        let recorded: HashMap<_, _> = items(&record["px"]).iter().map(pixel).collect();
        for (engine, bound) in [
            (Engine::Scanline, tolerance::SCANLINE),
            (Engine::EdgeFunction, tolerance::EDGE_FUNCTION),
            (Engine::Oracle, tolerance::ORACLE),
        ] {
            let (mut seen, name) = (0, engine.name());
            engine.fragments(&triangle, WINDOW, |f| {
                let at = (f.x_px, f.y_px);
                let Some(target) = recorded.get(&at) else { return };
                seen += 1;
                let (depth, values) = exact.at(f.x_px, f.y_px);
                for (k, actual) in f.varying.to_array().into_iter().enumerate() {
                    let at_vertices = attributes.map(|a| a[k]);
                    let error = values[k].distance(actual);
                    let bound = bound.attribute.at(at_vertices);
                    assert!(error <= bound, "{name}: {error:e} on {record}");
                    assert!(error <= 1e-12 * largest(at_vertices));
                    let is_near = (actual - target[k]).abs() <= 1e-4 * largest(at_vertices);
                    assert!(is_near, "{name} is {actual} at {at:?} of {record}");
                }
                let error = depth.distance(f.depth);
                assert!(error <= bound.depth.at(depths) && error <= 1e-12 * largest(depths));
                assert!((f.depth - target[2]).abs() <= 1e-4 * largest(depths));
            });
            assert_eq!(seen, recorded.len(), "{name} misses a recorded pixel of {record}");
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
    let all = records(&format!("vulkan-msaa.{driver}"));
    for record in &all {
        let mut target = Frame::new(WINDOW, 0u8);
        for run in items(&record["mask_runs"]) {
            let [mask, y, x0, x1] = [0, 1, 2, 3].map(|i| int(&run[i]) as i32);
            target.span_mut(y, x0, x1).fill(mask as u8);
        }
        let corners: Corners = points(record, step)[..3].try_into().unwrap();
        for engine in ENGINES {
            let actual = masks(&engine, corners, WINDOW).unwrap();
            assert!(actual == target, "{} differs from {driver} on {record}", engine.name());
        }
    }
    all.len()
}

#[test]
fn masks_of_lavapipe() {
    assert!(check_masks("lavapipe", 1) > 100);
}

#[test]
fn masks_of_swiftshader() {
    assert!(check_masks("swiftshader", SWIFTSHADER_STEP) > 100);
}
