//! Coverage as a picture: each pixel a square, the outline of the shape and the samples over it.
//!
//! Grey agrees, red is missing, orange is extra, violet is hit twice, green is hit more than once
//! and rightly so. A dark dot is a sample; a blue line is an edge. Panels stand side by side, one
//! for each engine judged by the target, the target itself last.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _, Rgb, RgbImage};

use crate::contract::DrawLine;
use crate::frame::{Coverage, Frame};
use crate::grid::{PixelRect, SUBPIXELS};
use crate::hazard::{Case, Shape};
use crate::line::bresenham::Bresenham;
use crate::triangle::{LineEnd, PixelPoint, ScreenLine};

const BACKGROUND: Rgb<u8> = Rgb([250, 250, 247]);
const GRID: Rgb<u8> = Rgb([222, 222, 216]);
const BORDER: Rgb<u8> = Rgb([90, 90, 90]);
const EDGE: Rgb<u8> = Rgb([36, 90, 190]);
const SAMPLE: Rgb<u8> = Rgb([60, 60, 60]);
const AGREES: Rgb<u8> = Rgb([170, 178, 184]);
const OVERLAP: Rgb<u8> = Rgb([110, 170, 110]);
const MISSING: Rgb<u8> = Rgb([214, 60, 60]);
const EXTRA: Rgb<u8> = Rgb([240, 160, 40]);
const TWICE: Rgb<u8> = Rgb([150, 70, 190]);

/// Sides of pictures stay below this.
const MOST_PX: u32 = 1600;

/// Draws a panel for each coverage judged by `target`, then the target judged by itself.
///
/// All coverages show the case's window.
#[must_use]
pub fn panels(case: &Case, actual: &[Coverage], target: &Coverage) -> RgbImage {
    let window = case.window;
    let count = actual.len() as u32 + 1;
    let zoom = zoom(window, count);
    let (panel_width, panel_height) = (window.width() * zoom + 1, window.height() * zoom + 1);
    let gap = zoom.max(4);
    let width = panel_width * count + gap * (count - 1);
    let mut image = RgbImage::from_pixel(width, panel_height, Rgb([255, 255, 255]));
    for (i, coverage) in actual.iter().chain([target]).enumerate() {
        let left = i as u32 * (panel_width + gap);
        squares(&mut image, left, zoom, coverage, target);
        outline(&mut image, left, zoom, case);
    }
    image
}

/// Three panels: `published` as it is (green where it draws twice), `repaired` as it is, and
/// `published` judged by `repaired`.
#[must_use]
pub fn exhibit(case: &Case, published: &Coverage, repaired: &Coverage) -> RgbImage {
    let zoom = zoom(case.window, 3);
    let (panel_width, panel_height) =
        (case.window.width() * zoom + 1, case.window.height() * zoom + 1);
    let gap = zoom.max(4);
    let width = panel_width * 3 + gap * 2;
    let mut image = RgbImage::from_pixel(width, panel_height, Rgb([255, 255, 255]));
    let panels = [(published, published), (repaired, repaired), (published, repaired)];
    for (i, (actual, target)) in panels.into_iter().enumerate() {
        let left = i as u32 * (panel_width + gap);
        squares(&mut image, left, zoom, actual, target);
        outline(&mut image, left, zoom, case);
    }
    image
}

/// Three panels: two pictures of one window, and red where they differ.
#[must_use]
pub fn images(published: &Frame<[u8; 3]>, repaired: &Frame<[u8; 3]>) -> RgbImage {
    let bounds = published.bounds();
    let zoom = zoom(bounds, 3).min(16);
    let (width, gap) = (bounds.width() * zoom, zoom.max(4));
    let size = (width * 3 + gap * 2, bounds.height() * zoom);
    RgbImage::from_fn(size.0, size.1, |x, y| {
        let (panel, x) = (x / (width + gap), x % (width + gap));
        let (x_px, y_px) = (bounds.x0 + (x / zoom) as i32, bounds.y0 + (y / zoom) as i32);
        if x >= width {
            return Rgb([255, 255, 255]);
        }
        let of = |image: &Frame<[u8; 3]>| image.get(x_px, y_px).unwrap_or_default();
        match panel {
            0 => Rgb(of(published)),
            1 => Rgb(of(repaired)),
            _ if of(published) == of(repaired) => AGREES,
            _ => MISSING,
        }
    })
}

/// The pixels of a frame as a picture of the same size.
#[must_use]
pub fn of_frame(frame: &Frame<[u8; 3]>) -> RgbImage {
    let bounds = frame.bounds();
    RgbImage::from_fn(bounds.width(), bounds.height(), |x, y| {
        Rgb(frame.get(bounds.x0 + x as i32, bounds.y0 + y as i32).unwrap_or_default())
    })
}

/// Picture pixels for each pixel of the window.
fn zoom(window: PixelRect, count: u32) -> u32 {
    let widest = window.width().saturating_mul(count).max(window.height()).max(1);
    // A case of a few pixels is shown larger.
    let largest = if window.width().max(window.height()) <= 8 { 40 } else { 16 };
    (MOST_PX / widest).clamp(1, largest)
}

fn squares(image: &mut RgbImage, left: u32, zoom: u32, actual: &Coverage, target: &Coverage) {
    let bounds = actual.bounds();
    let (width, height) = (bounds.width() * zoom + 1, bounds.height() * zoom + 1);
    for y in 0..height {
        for x in 0..width {
            let on_border = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
            let on_grid = zoom >= 4 && (x % zoom == 0 || y % zoom == 0);
            let (x_px, y_px) = (bounds.x0 + (x / zoom) as i32, bounds.y0 + (y / zoom) as i32);
            let hits = |c: &Coverage| c.get(x_px, y_px).unwrap_or(0);
            let colour = if on_border {
                BORDER
            } else if on_grid {
                GRID
            } else if zoom >= 8 && is_sample(x % zoom, zoom) && is_sample(y % zoom, zoom) {
                SAMPLE
            } else {
                colour(hits(actual), hits(target))
            };
            image.put_pixel(left + x, y, colour);
        }
    }
}

/// Whether a picture pixel lies on the dot in the middle of a square.
fn is_sample(offset: u32, zoom: u32) -> bool {
    offset.abs_diff(zoom / 2) <= zoom / 32
}

fn colour(actual: u8, target: u8) -> Rgb<u8> {
    match (actual, target) {
        (0, 0) => BACKGROUND,
        (a, t) if a > t && a > 1 => TWICE,
        (a, t) if a > t => EXTRA,
        (a, t) if a < t => MISSING,
        (1, _) => AGREES,
        _ => OVERLAP,
    }
}

/// Edges of triangles through their corners, lines through the centres of their end pixels.
fn outline(image: &mut RgbImage, left: u32, zoom: u32, case: &Case) {
    let window = case.window;
    let to_picture = |x_sub: i64, y_sub: i64| {
        let at = |sub: i64, origin: i32| {
            let from_origin = sub - i64::from(origin) * i64::from(SUBPIXELS);
            (from_origin * i64::from(zoom)).div_euclid(i64::from(SUBPIXELS))
        };
        let limit = |v: i64| v.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32;
        PixelPoint::new(limit(at(x_sub, window.x0)), limit(at(y_sub, window.y0)))
    };
    let segments: Vec<(PixelPoint, PixelPoint)> = match &case.shape {
        Shape::Triangles { list, .. } => list
            .iter()
            .flat_map(|triangle| {
                let points = triangle.corners().map(|p| to_picture(p.x.into(), p.y.into()));
                [(points[0], points[1]), (points[1], points[2]), (points[2], points[0])]
            })
            .collect(),
        Shape::Lines(lines) => {
            let centre = |px: i32| i64::from(px) * i64::from(SUBPIXELS) + i64::from(SUBPIXELS / 2);
            let end = |e: PixelPoint| to_picture(centre(e.x), centre(e.y));
            lines.iter().map(|l| (end(l.ends[0].pixel), end(l.ends[1].pixel))).collect()
        }
    };
    let panel = PixelRect::window(window.width() * zoom + 1, window.height() * zoom + 1);
    for (a, b) in segments {
        let ends = [a, b].map(|pixel| LineEnd { pixel, depth: 0.0, varying: 0.0 });
        Bresenham.draw(&ScreenLine { ends }, panel, |f| {
            image.put_pixel(left + f.x_px as u32, f.y_px as u32, EDGE);
        });
    }
}

/// Stacks pictures under each other on white, with a gap between.
#[must_use]
pub fn stack(pictures: &[RgbImage]) -> RgbImage {
    const GAP: u32 = 12;
    let width = pictures.iter().map(RgbImage::width).max().unwrap_or(1);
    let height = pictures.iter().map(|p| p.height() + GAP).sum::<u32>().saturating_sub(GAP).max(1);
    let mut sheet = RgbImage::from_pixel(width, height, Rgb([255, 255, 255]));
    let mut top = 0;
    for picture in pictures {
        image::imageops::replace(&mut sheet, picture, 0, i64::from(top));
        top += picture.height() + GAP;
    }
    sheet
}

/// The picture as a PNG file's bytes.
///
/// # Panics
/// Never: writing to memory does not fail.
#[must_use]
pub fn png(image: &RgbImage) -> Vec<u8> {
    let mut bytes = Vec::new();
    // Flat colours on a grid: rows repeat, which the filter `Up` turns into zeros.
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Up)
        .write_image(image.as_raw(), image.width(), image.height(), ExtendedColorType::Rgb8)
        .expect("writing to memory does not fail");
    bytes
}
