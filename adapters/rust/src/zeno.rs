//! zeno: `Mask` of a path in 8-bit alpha; a pixel counts as drawn from alpha 128 on. It has no line of pixels.

use zeno::{Command, Mask, Vector};

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "zeno-0.3.3",
    declares: "mask batch=64",
    grid: 256.0,
    range: f64::INFINITY,
    inside: false,
    triangle,
    line: None,
    longest_line: i64::MAX,
};

fn triangle(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let [a, b, c] = corners.map(|(x, y)| Vector::new(x as f32, y as f32));
    let path = [Command::MoveTo(a), Command::LineTo(b), Command::LineTo(c), Command::Close];
    let mut alpha = vec![0; width as usize * height as usize];
    Mask::new(&path[..]).size(width as u32, height as u32).render_into(&mut alpha, None);
    for (i, _) in (0..).zip(&alpha).filter(|(_, alpha)| **alpha >= 128) {
        set_pixel(i % width, i / width);
    }
}
