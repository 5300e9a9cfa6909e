//! tiny-skia: `Pixmap::fill_path` and, of width 0, `Pixmap::stroke_path`, without antialiasing.

use tiny_skia::{FillRule, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "tiny-skia-0.12.0",
    declares: "mask line-set batch=64",
    grid: 256.0,
    range: f64::INFINITY,
    inside: false,
    triangle,
    line: Some(line),
    longest_line: i64::MAX,
};

fn path(points: &[(f64, f64)]) -> Option<Path> {
    let mut path = PathBuilder::new();
    path.move_to(points[0].0 as f32, points[0].1 as f32);
    for &(x, y) in &points[1..] {
        path.line_to(x as f32, y as f32);
    }
    if points.len() > 2 {
        path.close();
    }
    path.finish()
}

fn drawn(points: &[(f64, f64)], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    // A window is at least 1x1.
    let mut pixmap = Pixmap::new(width as u32, height as u32).unwrap();
    let mut paint = Paint::default();
    paint.set_color_rgba8(255, 255, 255, 255);
    paint.anti_alias = false;
    // Points that make no path draw nothing.
    let Some(path) = path(points) else { return };
    if points.len() > 2 {
        pixmap.fill_path(&path, &paint, FillRule::Winding, Transform::identity(), None);
    } else {
        let hairline = Stroke { width: 0.0, ..Stroke::default() };
        pixmap.stroke_path(&path, &paint, &hairline, Transform::identity(), None);
    }
    for (i, pixel) in (0..).zip(pixmap.pixels()) {
        if pixel.alpha() > 0 {
            set_pixel(i % width, i / width);
        }
    }
}

fn triangle(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    drawn(&corners, width, height, set_pixel);
}

fn line(ends: [(i32, i32); 2], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let centres = ends.map(|(x, y)| (f64::from(x) + 0.5, f64::from(y) + 0.5));
    drawn(&centres, width, height, set_pixel);
}
