//! ab_glyph_rasterizer: `Rasterizer::draw_line` around the triangle; a pixel counts as drawn if at least half of it is
//! covered. It has no line of pixels.

use ab_glyph_rasterizer::{Rasterizer, point};

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "ab-glyph-rasterizer-0.1.10",
    declares: "mask batch=64",
    grid: 256.0,
    range: f64::INFINITY,
    inside: false,
    triangle,
    line: None,
    longest_line: i64::MAX,
};

fn triangle(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let [a, b, c] = corners.map(|(x, y)| point(x as f32, y as f32));
    let mut rasterizer = Rasterizer::new(width as usize, height as usize);
    rasterizer.draw_line(a, b);
    rasterizer.draw_line(b, c);
    rasterizer.draw_line(c, a);
    rasterizer.for_each_pixel_2d(|x, y, coverage| {
        if coverage >= 0.5 {
            set_pixel(x as i32, y as i32);
        }
    });
}
