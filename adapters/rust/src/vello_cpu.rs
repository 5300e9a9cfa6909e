//! vello_cpu: `RenderContext::fill_path` with an aliasing threshold of 127, so that a pixel is drawn if its coverage is
//! 128/255 or more. It has no line of pixels.

use vello_cpu::color::palette::css::WHITE;
use vello_cpu::kurbo::BezPath;
use vello_cpu::{Pixmap, RenderContext, Resources};

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "vello-cpu-0.3.0",
    declares: "mask batch=64",
    grid: 256.0,
    range: f64::INFINITY,
    inside: false,
    triangle,
    line: None,
    longest_line: i64::MAX,
};

fn triangle(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let mut path = BezPath::new();
    path.move_to(corners[0]);
    path.line_to(corners[1]);
    path.line_to(corners[2]);
    path.close_path();
    // A window has at most 1024 columns and rows.
    let (columns, rows) = (width as u16, height as u16);
    let mut context = RenderContext::new(columns, rows);
    context.set_aliasing_threshold(Some(127));
    context.set_paint(WHITE);
    context.fill_path(&path);
    context.flush();
    let mut pixmap = Pixmap::new(columns, rows);
    context.render(&mut pixmap, &mut Resources::new());
    for (i, _) in (0..).zip(pixmap.data()).filter(|(_, pixel)| pixel.a > 0) {
        set_pixel(i % width, i / width);
    }
}
