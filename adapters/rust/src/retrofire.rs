//! retrofire-core: `tri_fill` and `line` of its module `render::raster`, which the pipeline calls with vertices that it has
//! clipped: rows and columns are `usize`. So triangles and lines that leave the window are refused here, and not drawn.

use retrofire_core::geom::{Vertex, vertex};
use retrofire_core::math::point::pt3;
use retrofire_core::render::raster::{ScreenPt, line as draw_line, tri_fill};

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "retrofire-core-0.4.0",
    declares: "batch=64",
    grid: 256.0,
    range: f64::INFINITY,
    inside: true,
    triangle,
    line: Some(line),
    longest_line: i64::MAX,
};

fn at((x, y): (f64, f64)) -> Vertex<ScreenPt, f32> {
    vertex(pt3(x as f32, y as f32, 1.0), 0.0)
}

fn triangle(corners: [(f64, f64); 3], _: i32, _: i32, set_pixel: SetPixel<'_>) {
    tri_fill(corners.map(at), |span| {
        for x in span.xs {
            set_pixel(x as i32, span.y as i32);
        }
    });
}

fn line(ends: [(i32, i32); 2], _: i32, _: i32, set_pixel: SetPixel<'_>) {
    let centres = ends.map(|(x, y)| at((f64::from(x) + 0.5, f64::from(y) + 0.5)));
    draw_line(centres, |span| {
        for x in span.xs {
            set_pixel(x as i32, span.y as i32);
        }
    });
}
