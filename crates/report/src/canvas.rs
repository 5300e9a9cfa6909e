//! Simple drawings as values: lines, discs, rings, boxes and text, written as SVG and as PNG.
//!
//! Own code instead of a plotting library: those that write PNG want a font from a file or from the
//! machine, so pictures would differ from machine to machine, and none places labels so that they do
//! not overlap, which is most of the work here. A drawing is 800 units wide. Text is monospaced with
//! 8 units to the character, in both forms, so that one layout serves both.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use image::{Rgb, RgbImage};

use super::lettering::{self, Size};

pub const LETTER: f64 = 8.0;
/// Picture pixels of a unit.
const ZOOM: u32 = 2;

pub type Ink = [u8; 3];

/// The black of titles and labels.
pub const INK: Ink = [34, 34, 34];
/// The grey of units and notes.
pub const SOFT: Ink = [110, 110, 110];
/// The light grey of the grid, which must not hide what is plotted.
pub const GRID: Ink = [226, 226, 226];

/// Something drawn, y down.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    Line {
        from: [f64; 2],
        to: [f64; 2],
        width: f64,
    },
    /// A filled rectangle by its left upper corner and its width and height.
    Box([f64; 2], [f64; 2]),
    /// A ring is a circle 2 units wide, and the radius that of the middle of its line.
    Circle {
        at: [f64; 2],
        radius: f64,
        is_ring: bool,
    },
    /// A line of text: its left end, at its middle height.
    Text([f64; 2], String),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// What it shows, for those who cannot see it.
    pub title: String,
    pub size: [f64; 2],
    /// From back to front.
    pub shapes: Vec<(Shape, Ink)>,
}

impl Drawing {
    #[must_use]
    pub fn new(title: &str, size: [f64; 2]) -> Self {
        Self { title: title.to_owned(), size, shapes: Vec::new() }
    }

    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], ink: Ink) {
        self.shapes.push((Shape::Line { from, to, width: 1.0 }, ink));
    }

    pub fn wide_line(&mut self, from: [f64; 2], to: [f64; 2], ink: Ink) {
        self.shapes.push((Shape::Line { from, to, width: 2.0 }, ink));
    }

    pub fn filled_box(&mut self, at: [f64; 2], size: [f64; 2], ink: Ink) {
        self.shapes.push((Shape::Box(at, size), ink));
    }

    pub fn disc(&mut self, at: [f64; 2], radius: f64, ink: Ink) {
        self.shapes.push((Shape::Circle { at, radius, is_ring: false }, ink));
    }

    pub fn ring(&mut self, at: [f64; 2], radius: f64, ink: Ink) {
        self.shapes.push((Shape::Circle { at, radius, is_ring: true }, ink));
    }

    pub fn text(&mut self, at: [f64; 2], text: &str, ink: Ink) {
        self.shapes.push((Shape::Text(at, text.to_owned()), ink));
    }

    pub fn text_before(&mut self, at: [f64; 2], text: &str, ink: Ink) {
        self.text([at[0] - width(text), at[1]], text, ink);
    }

    pub fn text_about(&mut self, at: [f64; 2], text: &str, ink: Ink) {
        self.text([at[0] - width(text) / 2.0, at[1]], text, ink);
    }
}

pub fn width(text: &str) -> f64 {
    text.chars().count() as f64 * LETTER
}

pub fn svg(drawing: &Drawing) -> String {
    let [width, height] = drawing.size;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"monospace\" font-size=\"13\">\n<title>{}</title>\n\
         {}<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\" class=\"fffffff\"/>\n",
        escaped(&drawing.title),
        dark_style(drawing)
    );
    for (shape, ink) in &drawing.shapes {
        let (fill, stroke) = (fill(*ink), stroke(*ink));
        // Writing to a string does not fail.
        let _ = match shape {
            Shape::Line { from: [x1, y1], to: [x2, y2], width } => writeln!(
                out,
                "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" {stroke} stroke-width=\"{width}\"/>"
            ),
            Shape::Box([x, y], [w, h]) => writeln!(
                out,
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" {fill}/>"
            ),
            Shape::Circle { at: [x, y], radius, is_ring } => {
                let ring = format!("fill=\"none\" {stroke} stroke-width=\"2\"");
                let paint = if *is_ring { ring } else { fill };
                writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" {paint}/>")
            }
            // The length is stated, so that another font cannot make labels overlap.
            Shape::Text([x, y], text) => writeln!(
                out,
                "<text x=\"{x:.1}\" y=\"{:.1}\" textLength=\"{}\" {fill}>{}</text>",
                y + 4.5,
                self::width(text),
                escaped(text)
            ),
        };
    }
    out + "</svg>\n"
}

fn hex([r, g, b]: Ink) -> String {
    format!("{r:02x}{g:02x}{b:02x}")
}

/// A colour by day, and a class that names the one by night.
fn fill(ink: Ink) -> String {
    format!("fill=\"#{0}\" class=\"f{0}\"", hex(ink))
}

fn stroke(ink: Ink) -> String {
    format!("stroke=\"#{0}\" class=\"s{0}\"", hex(ink))
}

/// What a colour is on a dark page: light ones become dark, dark ones light, of the same hue.
fn dark([r, g, b]: Ink) -> Ink {
    let (low, high) = (r.min(g).min(b), r.max(g).max(b));
    let mirror = |v: u8| {
        // The lightness is mirrored, and black text does not become pure white.
        let mirrored = i32::from(v) + 255 - i32::from(low) - i32::from(high);
        (28 + mirrored * 7 / 8).clamp(0, 255) as u8
    };
    [r, g, b].map(mirror)
}

fn dark_style(drawing: &Drawing) -> String {
    let inks: BTreeSet<Ink> =
        drawing.shapes.iter().map(|(_, ink)| *ink).chain([[255; 3]]).collect();
    let rules = inks.iter().map(|ink| {
        let (name, dark) = (hex(*ink), hex(dark(*ink)));
        format!(".f{name}{{fill:#{dark}}}.s{name}{{stroke:#{dark}}}")
    });
    let rules: String = rules.collect();
    format!("<style>@media (prefers-color-scheme: dark){{{rules}}}</style>\n")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// The drawing as a picture, twice as many pixels wide as units.
pub fn picture(drawing: &Drawing) -> RgbImage {
    let zoom = f64::from(ZOOM);
    let [width, height] = drawing.size.map(|v| (v * zoom).clamp(1.0, 16384.0) as u32);
    let mut image = RgbImage::from_pixel(width, height, Rgb([255, 255, 255]));
    let scale = |p: [f64; 2]| p.map(|v| v * zoom);
    for (shape, ink) in &drawing.shapes {
        match shape {
            Shape::Line { from, to, width } => {
                let (a, b, reach) = (scale(*from), scale(*to), width * zoom / 2.0);
                blend(&mut image, [a, b], reach, *ink, |p| reach - distance(p, a, b));
            }
            Shape::Box(at, size) => {
                let ([x, y], [w, h]) = (scale(*at), scale(*size));
                let inside = |p: [f64; 2]| {
                    let sides = [p[0] - x, x + w - p[0], p[1] - y, y + h - p[1]];
                    sides.into_iter().fold(f64::MAX, f64::min)
                };
                blend(&mut image, [[x, y], [x + w, y + h]], 0.0, *ink, inside);
            }
            Shape::Circle { at, radius, is_ring } => {
                let (c, r) = (scale(*at), radius * zoom);
                let inside = |p: [f64; 2]| match (r - distance(p, c, c), is_ring) {
                    (inward, true) => zoom - inward.abs(),
                    (inward, false) => inward,
                };
                blend(&mut image, [c, c], r + zoom, *ink, inside);
            }
            Shape::Text(at, text) => {
                let [x, y] = scale(*at);
                let top = y - f64::from(Size::Plot.cell()[1]) / 2.0;
                lettering::write(&mut image, (x as i64, top as i64), text, Size::Plot, Rgb(*ink));
            }
        }
    }
    image
}

/// Distance from `p` to the segment from `a` to `b`.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (d, q) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = d[0] * d[0] + d[1] * d[1];
    let t = if length > 0.0 { ((q[0] * d[0] + q[1] * d[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (q[0] - d[0] * t, q[1] - d[1] * t);
    (x * x + y * y).sqrt()
}

/// Paints the pixels around `corners`, as opaque as `depth` (how far inside a point lies) says.
fn blend(
    image: &mut RgbImage,
    corners: [[f64; 2]; 2],
    reach: f64,
    ink: Ink,
    depth: impl Fn([f64; 2]) -> f64,
) {
    let range = |axis: usize, size: u32| {
        let (a, b) = (corners[0][axis], corners[1][axis]);
        let limit = |v: f64| v.clamp(0.0, f64::from(size)) as u32;
        limit(a.min(b) - reach - 1.0)..limit(a.max(b) + reach + 2.0)
    };
    for y in range(1, image.height()) {
        for x in range(0, image.width()) {
            let share = (depth([f64::from(x) + 0.5, f64::from(y) + 0.5]) + 0.5).clamp(0.0, 1.0);
            let pixel = image.get_pixel_mut(x, y);
            for (held, ink) in pixel.0.iter_mut().zip(ink) {
                *held = (f64::from(*held) + (f64::from(ink) - f64::from(*held)) * share) as u8;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Drawing {
        let mut drawing = Drawing::new("a < b", [40.0, 20.0]);
        drawing.line([0.0, 10.0], [40.0, 10.0], [255, 0, 0]);
        drawing.disc([10.0, 10.0], 4.0, [0, 0, 255]);
        drawing.ring([30.0, 10.0], 5.0, [0, 128, 0]);
        drawing.text([1.0, 15.0], "<&", [0, 0, 0]);
        drawing
    }

    #[test]
    fn dark_pages_turn_paper_and_ink_over() {
        let sum = |ink: Ink| ink.iter().map(|v| u32::from(*v)).sum::<u32>();
        assert_eq!(dark([255, 255, 255]), [28; 3]);
        assert!(sum(dark([0, 0, 0])) > 3 * 240 && sum(dark([34, 34, 34])) > 3 * 200);
        let [r, g, b] = dark([20, 110, 50]);
        assert!(g > b && b > r && r > 100, "green stays green: {r} {g} {b}");
        let svg = svg(&sample());
        assert!(
            svg.contains(".fffffff{fill:#1c1c1c}") && svg.contains("class=\"sff0000\""),
            "{svg}"
        );
    }

    #[test]
    fn svg_is_escaped() {
        let svg = svg(&sample());
        assert!(svg.contains("<title>a &lt; b</title>") && svg.contains(">&lt;&amp;</text>"));
        assert_eq!(svg.matches("<circle").count(), 2);
    }

    #[test]
    fn picture_has_what_was_drawn() {
        let image = picture(&sample());
        assert_eq!(image.dimensions(), (80, 40));
        assert_eq!(image.get_pixel(20, 20).0, [0, 0, 255], "the disc is over the line");
        assert_eq!(image.get_pixel(40, 20).0, [255, 0, 0]);
        assert_eq!(image.get_pixel(60, 10).0, [0, 128, 0]);
        assert_eq!(image.get_pixel(78, 2).0, [255, 255, 255]);
    }
}
