//! What pictures of cases are made of: colours, outlines, PNG files.
//!
//! Grey agrees, or a light colour for each of a few triangles side by side; red is missing, orange is extra, violet is hit
//! twice, green is hit more than once and rightly so. A dark dot is a sample; a blue line is an edge.

use std::collections::HashMap;

use image::{Rgb, RgbImage};

use rasterproof_core::contract::DrawLine;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::triangle::{LineEnd, PixelPoint, ScreenLine};
use rasterproof_verify::cases::{Case, Shape};

/// The colours of pictures of cases; the module says what they mean.
pub const BACKGROUND: Rgb<u8> = Rgb([250, 250, 247]);
pub(super) const GRID: Rgb<u8> = Rgb([222, 222, 216]);
pub(super) const BORDER: Rgb<u8> = Rgb([90, 90, 90]);
pub const EDGE: Rgb<u8> = Rgb([36, 90, 190]);
pub const SAMPLE: Rgb<u8> = Rgb([60, 60, 60]);
pub const AGREES: Rgb<u8> = Rgb([170, 178, 184]);
/// Pixels that agree, by the number of their triangle.
pub(super) const OWNERS: [Rgb<u8>; 6] = [
    Rgb([150, 186, 214]),
    Rgb([228, 208, 140]),
    Rgb([168, 204, 160]),
    Rgb([212, 178, 206]),
    Rgb([186, 190, 150]),
    Rgb([160, 206, 206]),
];
pub(super) const OVERLAP: Rgb<u8> = Rgb([110, 170, 110]);
pub const MISSING: Rgb<u8> = Rgb([214, 60, 60]);
pub const EXTRA: Rgb<u8> = Rgb([240, 160, 40]);
pub const TWICE: Rgb<u8> = Rgb([150, 70, 190]);

/// The picture pixels of a segment that lie in a panel.
pub(super) fn line(ends: [PixelPoint; 2], panel: PixelRect, mut put: impl FnMut(u32, u32)) {
    // Drawn by this project's own line drawer, cut off at the panel.
    let ends = ends.map(|pixel| LineEnd { pixel, depth: 0.0, varying: 0.0 });
    Bresenham.draw(&ScreenLine { ends }, panel, |f| put(f.x_px as u32, f.y_px as u32));
}

/// A picture of one colour. Pixels are filled and copied here because `image` is not optimised in the profile of `cargo run` and `cargo test`.
pub fn plain(width: u32, height: u32, colour: Rgb<u8>) -> RgbImage {
    from_bytes(width, height, colour.0.repeat(width as usize * height as usize))
}

/// A picture from the colour of each pixel.
pub fn painted(width: u32, height: u32, colour: impl Fn(u32, u32) -> Rgb<u8>) -> RgbImage {
    let mut bytes = Vec::with_capacity(3 * width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            bytes.extend_from_slice(&colour(x, y).0);
        }
    }
    from_bytes(width, height, bytes)
}

/// A picture of bytes that are its pixels.
fn from_bytes(width: u32, height: u32, bytes: Vec<u8>) -> RgbImage {
    RgbImage::from_raw(width, height, bytes).expect("three bytes for each pixel")
}

/// Draws a picture that lies within another one over it.
pub(super) fn place(onto: &mut RgbImage, picture: &RgbImage, left: u32, top: u32) {
    // Rows are copied as a whole.
    let (stride, row) = (3 * onto.width() as usize, 3 * picture.width() as usize);
    let first = stride * top as usize + 3 * left as usize;
    if row > 0 {
        for (y, from) in picture.chunks_exact(row).enumerate() {
            onto.as_flat_samples_mut().samples[first + y * stride..][..row].copy_from_slice(from);
        }
    }
}

/// The pixels of a frame as a picture of the same size, of their first three channels.
pub fn of_frame<const N: usize>(frame: &Frame<[u8; N]>) -> RgbImage {
    let bounds = frame.bounds();
    let mut bytes = Vec::with_capacity(3 * bounds.width() as usize * bounds.height() as usize);
    for (_, row) in frame.rows() {
        for pixel in row {
            bytes.extend_from_slice(&pixel[..3]);
        }
    }
    from_bytes(bounds.width(), bounds.height(), bytes)
}

/// Whether all pixels have the colour of the first.
pub fn is_plain<P: PartialEq>(mut pixels: impl Iterator<Item = P>) -> bool {
    let first = pixels.next();
    pixels.all(|pixel| Some(&pixel) == first.as_ref())
}

/// A line from one position to another, in pixels.
pub type Segment = [[f64; 2]; 2];

pub fn edges([a, b, c]: [[f64; 2]; 3]) -> [Segment; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Edges of triangles through their corners, lines through the centres of their end pixels.
pub fn outline(case: &Case) -> Vec<Segment> {
    match &case.shape {
        Shape::Triangles { list, .. } => {
            list.iter().flat_map(|t| edges(t.corners().map(|p| p.to_px().into()))).collect()
        }
        Shape::Lines(lines) => {
            let mut segments = Vec::new();
            for line in lines {
                let ends = line.ends.each_ref().map(|end| [end.pixel.x, end.pixel.y]);
                segments.push(ends.map(|end| end.map(|v| f64::from(v) + 0.5)));
            }
            segments
        }
        Shape::Unsnapped { list, .. } => list.iter().flat_map(|t| edges(t.px())).collect(),
        Shape::Numbers { .. } => Vec::new(),
    }
}

/// Segments in picture pixels from the corner of the part that is shown.
pub fn scaled(segments: &[Segment], shown: PixelRect, zoom: u32) -> Vec<[PixelPoint; 2]> {
    // Saturating: a corner far outside stays far outside.
    let at = |v: f64, origin: i32| ((v - f64::from(origin)) * f64::from(zoom)).floor() as i32;
    let mut scaled = Vec::with_capacity(segments.len());
    for ends in segments {
        scaled.push(ends.map(|[x, y]| PixelPoint::new(at(x, shown.x0), at(y, shown.y0))));
    }
    scaled
}

/// Room between two pictures of a stack.
const STACK_GAP: u32 = 12;

/// Stacks pictures under each other on white, with a gap between.
pub fn stack(pictures: &[RgbImage]) -> RgbImage {
    let width = pictures.iter().map(RgbImage::width).max().unwrap_or(1);
    let height: u32 = pictures.iter().map(|picture| picture.height() + STACK_GAP).sum();
    // No gap below the last one.
    let height = height.saturating_sub(STACK_GAP).max(1);
    let mut sheet = plain(width, height, Rgb([255, 255, 255]));
    let mut top = 0;
    for picture in pictures {
        place(&mut sheet, picture, 0, top);
        top += picture.height() + STACK_GAP;
    }
    sheet
}

/// The picture as a PNG file's bytes, with a palette where it has at most 256 colours.
pub fn png(image: &RgbImage) -> Vec<u8> {
    let mut bytes = Vec::new();
    // Written here and not by `image`, whose encoder has no palettes.
    let mut encoder = png::Encoder::new(&mut bytes, image.width(), image.height());
    // Few colours take one byte a pixel, which also compresses better.
    let data = match indexed(image) {
        Some((palette, indices)) => {
            encoder.set_color(png::ColorType::Indexed);
            encoder.set_compression(png::Compression::High);
            encoder.set_palette(palette);
            encoder.set_filter(png::Filter::NoFilter);
            indices
        }
        None => {
            encoder.set_color(png::ColorType::Rgb);
            image.as_raw().clone()
        }
    };
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&data))
        .expect("writing to memory does not fail");
    bytes
}

/// The colours in the order of their first pixels, and the number of each pixel's; none beyond 256.
fn indexed(image: &RgbImage) -> Option<(Vec<u8>, Vec<u8>)> {
    let mut numbers = HashMap::new();
    let (mut palette, mut indices) = (Vec::new(), Vec::new());
    let mut last = None;
    for pixel in image.pixels() {
        // Most pixels have the colour of the one before.
        if last.is_none_or(|(colour, _)| colour != pixel.0) {
            // A colour gets the next number where it first occurs; a 257th ends the search.
            let next = numbers.len();
            let number = *numbers.entry(pixel.0).or_insert_with(|| {
                palette.extend(pixel.0);
                next
            });
            last = Some((pixel.0, u8::try_from(number).ok()?));
        }
        indices.extend(last.map(|(_, number)| number));
    }
    Some((palette, indices))
}
