//! Diagrams of chapter 11 and of antialiasing: the cosine, and the samples of a pixel.

use glam::DVec3;
use rasterproof_core::angle::sin_cos;

use super::{Drawing, Point};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_render::pipeline::multisample::SAMPLES;
use rasterproof_render::pipeline::shade::Light;

/// One normal, light from four directions, and how bright the surface is.
pub fn cosine() -> String {
    let mut drawing = Drawing::new(590.0, 200.0);
    for (i, degrees) in [0.0f64, 45.0, 75.0, 120.0].into_iter().enumerate() {
        let foot = [75.0 + 135.0 * i as f64, 150.0];
        let (sin, cos) = sin_cos(degrees.to_radians());
        let towards = DVec3::new(sin, cos, 0.0);
        let light = Light { towards, ambient: 0.0, diffuse: 1.0 };
        let end = |d: DVec3| [foot[0] + d.x * 80.0, foot[1] - d.y * 80.0];
        drawing.line("ink", [foot[0] - 50.0, foot[1]], [foot[0] + 50.0, foot[1]]);
        drawing.arrow("one", foot, end(DVec3::Y));
        drawing.arrow("two", foot, end(towards * 0.9));
        drawing.text("end", [foot[0] - 6.0, foot[1] - 66.0], "n");
        drawing.label("middle", end(towards), [8.0, 2.0], "l");
        let bright = light.intensity(DVec3::Y);
        let (x, y, grey) = (foot[0] - 50.0, foot[1] + 2.0, (bright * 255.0).round());
        drawing.add(format_args!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"100\" height=\"18\" fill=\"rgb({grey},{grey},{grey})\" \
             stroke=\"#8c959f\"/>"
        ));
        drawing.text("middle", [foot[0], 190.0], &format!("{degrees}°: {bright:.2}"));
    }
    drawing.svg()
}

/// The four samples of a pixel and an edge through it.
pub fn samples() -> String {
    let (a, b): (Point, Point) = ([0.0, 0.85], [1.0, 0.1]);
    let at = |[x, y]: Point| [60.0 + x * 240.0, 30.0 + y * 240.0];
    let snapped = |[x, y]: Point| {
        let sub = |v: f64| (v * f64::from(SUBPIXELS)).round() as i32;
        SubpixelPoint::new(sub(x), sub(y))
    };
    let is_in = |p: Point| twice_area(&[snapped(a), snapped(b), snapped(p)]) > 0;
    let mut drawing = Drawing::new(360.0, 320.0);
    drawing.polygon("fill1", &[at(a), at(b), at([1.0, 1.0]), at([0.0, 1.0])]);
    drawing.grid(at([0.0, 0.0]), 15.0, 16, 16);
    drawing.polygon("ink", &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(at));
    drawing.line("one", at(a), at(b));
    let mut inside = 0;
    for (x, y) in SAMPLES {
        let p = [f64::from(x) / 16.0, f64::from(y) / 16.0];
        inside += u32::from(is_in(p));
        drawing.dot(if is_in(p) { "dot1" } else { "ring" }, at(p), 7.0);
    }
    let [x, y] = at([0.5, 0.5]);
    drawing.line("ink", [x - 5.0, y - 5.0], [x + 5.0, y + 5.0]);
    drawing.line("ink", [x - 5.0, y + 5.0], [x + 5.0, y - 5.0]);
    drawing.text(
        "middle",
        [180.0, 300.0],
        &format!("● covered 被覆盖: {inside} / {} · × centre 中心", SAMPLES.len()),
    );
    drawing.svg()
}
