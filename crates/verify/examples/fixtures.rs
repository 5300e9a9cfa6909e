//! The file of fixtures in a test suite that does not use this crate's macros: its cases drawn by a rasterizer in f32,
//! with 4 bits below the pixel.

use serde_json::Value;

/// The file is printed by `rasterproof fixtures`; `schema.json` beside it says what it holds.
const FIXTURES: &str = include_str!("../fixtures/fixtures.json");

/// Moves a coordinate to the nearest 1/16 px, and doubles it, so that samples are whole numbers too.
fn snap(px: f64) -> f32 {
    (px as f32 * 16.0).round()
}

/// Whether a pixel belongs to a triangle, samples on edges not counted.
fn covers(corners: [[f32; 2]; 3], x: i64, y: i64) -> bool {
    let p = [x as f32 * 16.0 + 8.0, y as f32 * 16.0 + 8.0];
    let edge =
        |a: [f32; 2], b: [f32; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let [a, b, c] = corners;
    let e = [edge(a, b), edge(b, c), edge(c, a)];
    e.iter().all(|&e| e > 0.0) || e.iter().all(|&e| e < 0.0)
}

fn holds(runs: &Value, x: i64, y: i64) -> bool {
    let runs = runs.as_array().into_iter().flatten();
    let numbers = |run: &Value| [0, 1, 2].map(|i| run[i].as_i64().unwrap_or_default());
    runs.map(numbers).any(|[row, x0, x1]| row == y && (x0..x1).contains(&x))
}

pub fn main() -> Result<(), serde_json::Error> {
    let fixtures: Value = serde_json::from_str(FIXTURES)?;
    let (mut right, mut wrong, mut large) = (0, 0, 0);
    let cases = fixtures["cases"].as_array().into_iter().flatten();
    for case in cases.filter(|case| case["kind"] == "triangle") {
        let px = |i: usize| [0, 1].map(|axis| case["points"][i][axis].as_f64().unwrap_or_default());
        if [px(0), px(1), px(2)].as_flattened().iter().any(|v| v.abs() > 100.0) {
            // Products of larger coordinates do not fit the 24 bits of f32.
            large += 1;
            continue;
        }
        let corners = [px(0), px(1), px(2)].map(|p| p.map(snap));
        // The entry for 4 bits is the first one.
        let pixels = &case["expected"][0]["samples"][0];
        let [width, height] = [0, 1].map(|i| case["window"][i].as_i64().unwrap_or_default());
        let agrees = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).all(|(x, y)| {
            // Without a rule for samples on edges, those on the outline may be hit or not.
            let is_open = holds(&pixels["either"], x, y) || holds(&pixels["outline"], x, y);
            is_open || covers(corners, x, y) == holds(&pixels["hit"], x, y)
        });
        if agrees { right += 1 } else { wrong += 1 }
    }
    println!("{right} triangles right, {wrong} wrong, {large} too large for f32");
    assert_eq!(wrong, 0);
    Ok(())
}
