//! imageproc: `draw_polygon_mut` and `draw_line_segment_mut` on a `GrayImage`. Corners of polygons are whole pixels.

use image::{GrayImage, Luma};
use imageproc::drawing::{draw_line_segment_mut, draw_polygon_mut};
use imageproc::point::Point;

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "imageproc-0.27.0",
    declares: "grid=1 mask line-set batch=64",
    grid: 1.0,
    range: f64::INFINITY,
    inside: false,
    triangle,
    line: Some(line),
    longest_line: 1 << 20,
};

const WHITE: Luma<u8> = Luma([255]);

fn drawn(width: i32, height: i32, set_pixel: SetPixel<'_>, draw: impl FnOnce(&mut GrayImage)) {
    let mut image = GrayImage::new(width as u32, height as u32);
    draw(&mut image);
    for (x, y, pixel) in image.enumerate_pixels() {
        if *pixel == WHITE {
            set_pixel(x as i32, y as i32);
        }
    }
}

fn triangle(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let corners = corners.map(|(x, y)| Point::new(x as i32, y as i32));
    drawn(width, height, set_pixel, |image| draw_polygon_mut(image, &corners, WHITE));
}

fn line(ends: [(i32, i32); 2], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let [from, to] = ends.map(|(x, y)| (x as f32, y as f32));
    drawn(width, height, set_pixel, |image| draw_line_segment_mut(image, from, to, WHITE));
}
