//! raqote: `DrawTarget::fill` with `AntialiasMode::None`. It has no line of pixels.
//!
//! Crossings are 16.16 fixed-point numbers: with corners within 8191 px 2 pixels in 1000 of huge
//! triangles were not those of its rule, within 32767 px more than half. So a range is declared.

use raqote::{AntialiasMode, DrawOptions, DrawTarget, PathBuilder, SolidSource, Source};

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "raqote-0.8.5",
    declares: "range=8191 mask batch=64",
    grid: 256.0,
    range: 8191.0,
    inside: false,
    triangle,
    line: None,
    longest_line: i64::MAX,
};

fn triangle(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let mut target = DrawTarget::new(width, height);
    let [a, b, c] = corners.map(|(x, y)| (x as f32, y as f32));
    let mut path = PathBuilder::new();
    path.move_to(a.0, a.1);
    path.line_to(b.0, b.1);
    path.line_to(c.0, c.1);
    path.close();
    let white = Source::Solid(SolidSource { r: 255, g: 255, b: 255, a: 255 });
    let options = DrawOptions { antialias: AntialiasMode::None, ..DrawOptions::new() };
    target.fill(&path.finish(), &white, &options);
    for (i, pixel) in (0..).zip(target.get_data()) {
        if *pixel != 0 {
            set_pixel(i % width, i / width);
        }
    }
}
