//! embedded-graphics: `Triangle` with a fill, `Line` with a stroke of width 1, drawn on a `DrawTarget` that sees
//! every pixel, so that double hits and the order of pixels show. Corners are whole pixels.

use std::convert::Infallible;

use embedded_graphics::Drawable as _;
use embedded_graphics::Pixel;
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::{DrawTarget, Primitive as _};
use embedded_graphics::primitives::{Line, PrimitiveStyle, Triangle};

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "embedded-graphics-0.8.2",
    declares: "grid=1 range=1024 batch=64",
    grid: 1.0,
    // It visits pixels outside the window, too: larger triangles would take it long.
    range: 1024.0,
    inside: false,
    triangle,
    line: Some(line),
    longest_line: i64::MAX,
};

struct Window<'a> {
    size: Size,
    set_pixel: SetPixel<'a>,
}

impl OriginDimensions for Window<'_> {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Window<'_> {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<BinaryColor>>,
    {
        for Pixel(point, _) in pixels {
            (self.set_pixel)(point.x, point.y);
        }
        Ok(())
    }
}

fn triangle(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let mut window = Window { size: Size::new(width as u32, height as u32), set_pixel };
    let [a, b, c] = corners.map(|(x, y)| Point::new(x as i32, y as i32));
    let style = PrimitiveStyle::with_fill(BinaryColor::On);
    let Ok(()) = Triangle::new(a, b, c).into_styled(style).draw(&mut window);
}

fn line(ends: [(i32, i32); 2], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let mut window = Window { size: Size::new(width as u32, height as u32), set_pixel };
    let [a, b] = ends.map(|(x, y)| Point::new(x, y));
    let style = PrimitiveStyle::with_stroke(BinaryColor::On, 1);
    let Ok(()) = Line::new(a, b).into_styled(style).draw(&mut window);
}
