//! Rendered frames: as PNG, and two of them compared pixel for pixel and depth for depth.

use std::io::{self, Cursor};

use image::{ImageFormat, RgbImage};

use crate::effects::Effect;
use crate::effects::render::Rendered;
use crate::frame::Frame;
use crate::grid::PixelRect;
use crate::pipeline::depth::CLEAR;
use crate::pipeline::target::{Colour, Target};
use crate::verify::ties::Ties;
use crate::verify::tolerance;

/// A frame as an image, without its opacity.
#[must_use]
pub fn rgb(picture: &Frame<Colour>) -> RgbImage {
    let bounds = picture.bounds();
    RgbImage::from_fn(bounds.width(), bounds.height(), |x, y| {
        let [r, g, b, _] = picture.row(bounds.y0 + y as i32)[x as usize];
        image::Rgb([r, g, b])
    })
}

/// A frame as a PNG.
///
/// # Errors
/// Where the encoder fails.
pub fn png(picture: &Frame<Colour>) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    rgb(picture)
        .write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png)
        .map_err(io::Error::other)?;
    Ok(bytes)
}

/// Two frames, compared.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Comparison {
    /// Pixels compared.
    pub pixels: u64,
    /// Pixels whose colours differ by a bit.
    pub wrong_pixels: u64,
    /// Depths compared, of every sample.
    pub depths: u64,
    /// Depths that differ by more than two rasterizers may.
    pub wrong_depths: u64,
    /// Pixels that are undecided by either: where two surfaces tie, see [`crate::verify::ties`].
    pub undecided: u64,
    /// Those of them that the two frames show in different colours, which is no fault.
    pub undecided_differ: u64,
    /// The first frame, dimmed, with what differs in red, what is undecided in brown, and in yellow
    /// where the frames show it differently.
    #[serde(skip)]
    pub picture: Frame<Colour>,
}

impl Comparison {
    /// Whether nothing differs.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.wrong_pixels == 0 && self.wrong_depths == 0
    }
}

const RED: Colour = [255, 40, 40, 255];
const BROWN: Colour = [120, 84, 0, 255];
const YELLOW: Colour = [255, 200, 0, 255];

/// Compares two frames of the same size: colours to the bit; depths within the sum of the bounds
/// that [`tolerance`] derives for the two rasterizers, with depths from 0 to 1, and one step of the
/// format. Where ties are known, what they excuse is no difference; the targets then hold every
/// sample of the frames.
#[must_use]
pub fn compare(
    a: (&Frame<Colour>, &Target),
    b: (&Frame<Colour>, &Target),
    ties: Option<&Ties>,
) -> Comparison {
    let bounds = a.0.bounds();
    let pixels = u64::from(bounds.width()) * u64::from(bounds.height());
    let mut picture = Frame::new(bounds, [0; 4]);
    let (mut wrong_pixels, mut undecided_differ) = (0, 0);
    for y_px in bounds.y0..bounds.y1 {
        let rows = a.0.row(y_px).iter().zip(b.0.row(y_px));
        for (x_px, (pixel, (first, second))) in
            (bounds.x0..).zip(picture.row_mut(y_px).iter_mut().zip(rows))
        {
            let ties = ties.filter(|ties| ties.is_undecided(x_px, y_px));
            let differs = first != second;
            let is_excused = differs && ties.is_some_and(|t| only_ties(t, [a.1, b.1], x_px, y_px));
            wrong_pixels += u64::from(differs && !is_excused);
            undecided_differ += u64::from(is_excused);
            *pixel = match (differs, is_excused, ties) {
                (true, true, _) => YELLOW,
                (true, false, _) => RED,
                (false, _, Some(_)) => BROWN,
                (false, _, None) => first.map(|channel| channel / 3),
            };
        }
    }
    let (depths, wrong) = compare_depths(a.1, b.1, ties);
    let scale = a.1.antialias().scale() as i32;
    for (x_px, y_px) in &wrong {
        picture.span_mut(y_px / scale, x_px / scale, x_px / scale + 1)[0] = RED;
    }
    let (wrong_depths, undecided) = (wrong.len() as u64, ties.map_or(0, Ties::count));
    Comparison { pixels, wrong_pixels, depths, wrong_depths, undecided, undecided_differ, picture }
}

/// Whether the samples of a pixel differ in colour only where ties excuse it, and somewhere do.
fn only_ties(ties: &Ties, [a, b]: [&Target; 2], x_px: i32, y_px: i32) -> bool {
    let scale = a.antialias().scale() as i32;
    let mut excused = 0;
    for (plane, (first, second)) in a.planes.iter().zip(&b.planes).enumerate() {
        for y in y_px * scale..(y_px + 1) * scale {
            for x in x_px * scale..(x_px + 1) * scale {
                if first.colour.get(x, y) != second.colour.get(x, y) {
                    if !ties.is_excused(plane, x, y) {
                        return false;
                    }
                    excused += 1;
                }
            }
        }
    }
    excused > 0
}

/// How many pixels of two frames of the same size differ.
#[must_use]
pub fn differing(a: &Frame<Colour>, b: &Frame<Colour>) -> u64 {
    a.rows()
        .zip(b.rows())
        .flat_map(|((_, a), (_, b))| a.iter().zip(b))
        .filter(|(a, b)| a != b)
        .count() as u64
}

/// How many depths were compared, and the samples where they differ.
fn compare_depths(a: &Target, b: &Target, ties: Option<&Ties>) -> (u64, Vec<(i32, i32)>) {
    let error =
        tolerance::SCANLINE.depth.at([0.0, 1.0]) + tolerance::EDGE_FUNCTION.depth.at([0.0, 1.0]);
    let tolerance = a.format.tolerance(error);
    let mut wrong = Vec::new();
    let mut count = 0;
    for (plane, (plane_a, plane_b)) in a.planes.iter().zip(&b.planes).enumerate() {
        let PixelRect { x0, y0, y1, .. } = plane_a.depth.bounds();
        for y_px in y0..y1 {
            let rows = plane_a.depth.row(y_px).iter().zip(plane_b.depth.row(y_px));
            for (x_px, (&key_a, &key_b)) in (x0..).zip(rows) {
                count += 1;
                let near = key_a != CLEAR
                    && key_b != CLEAR
                    && (a.format.depth(key_a) - b.format.depth(key_b)).abs() <= tolerance;
                let is_excused = || ties.is_some_and(|ties| ties.is_excused(plane, x_px, y_px));
                if key_a != key_b && !near && !is_excused() {
                    wrong.push((x_px, y_px));
                }
            }
        }
    }
    (count, wrong)
}

/// What the colours of a map of effects mean; a pixel that pays for several shows their sum.
pub const MAP_COLOURS: [(Effect, [u8; 3]); 6] = [
    (Effect::Samples, [120, 60, 0]),
    (Effect::Perspective, [70, 0, 0]),
    (Effect::Depth, [0, 0, 110]),
    (Effect::Colour, [90, 90, 0]),
    (Effect::Light, [0, 140, 0]),
    (Effect::Texture, [95, 0, 100]),
];

/// A map of effects as a picture.
#[must_use]
pub fn map_picture(map: &Frame<u16>) -> Frame<Colour> {
    let bounds = map.bounds();
    let mut picture = Frame::new(bounds, [0; 4]);
    for y_px in bounds.y0..bounds.y1 {
        for (pixel, &paid) in picture.row_mut(y_px).iter_mut().zip(map.row(y_px)) {
            let mut sum = [25u8, 25, 25];
            for (effect, colour) in MAP_COLOURS {
                if paid & (1 << effect as u16) != 0 {
                    sum = [0, 1, 2].map(|i| sum[i].saturating_add(colour[i]));
                }
            }
            *pixel = [sum[0], sum[1], sum[2], 255];
        }
    }
    picture
}

/// A frame for machines.
#[must_use]
pub fn json(
    scene: &str,
    engines: &[&str],
    rendered: &Rendered,
    comparison: &Option<Comparison>,
) -> String {
    serde_json::json!({
        "scene": scene,
        "engines": engines,
        "counters": rendered.counters,
        "plan": rendered.plan,
        "comparison": comparison,
    })
    .to_string()
}
