//! Two rendered frames compared pixel for pixel and depth for depth, and what the pixels of one pay for.

use image::{Rgb, RgbImage, imageops};

use super::lettering::Size;
use super::{panels, picture};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_registry::undecided::Ties;
use rasterproof_render::effects::Effect;
use rasterproof_render::effects::render::PaidMap;
use rasterproof_render::pipeline::depth::CLEAR;
use rasterproof_render::pipeline::target::{Colour, Target};
use rasterproof_verify::comparison::tolerance;

#[derive(Clone, Debug, serde::Serialize)]
pub struct Comparison {
    pub pixels: u64,
    /// Pixels whose colours differ by a bit.
    pub wrong_pixels: u64,
    /// Depths compared, of every sample.
    pub depths: u64,
    /// Depths that differ by more than two rasterizers may.
    pub wrong_depths: u64,
    /// Pixels that are undecided by either: where two surfaces tie, see [`rasterproof_registry::undecided`].
    pub undecided: u64,
    /// Those of them that the two frames show in different colours, which is no fault.
    pub undecided_differ: u64,
    /// Pixels that the two frames show by different texels, both within the bounds of texture coordinates
    /// that are very large, which is no fault.
    pub far_texture: u64,
    /// The first frame, dimmed, with what differs in red, what is undecided in brown, and in yellow
    /// where the frames show it differently.
    #[serde(skip)]
    pub picture: Frame<Colour>,
}

impl Comparison {
    /// Whether nothing differs that may not.
    pub fn agrees(&self) -> bool {
        self.wrong_pixels == 0 && self.wrong_depths == 0
    }
}

const RED: Colour = [255, 40, 40, 255];
const BROWN: Colour = [120, 84, 0, 255];
/// Marks what is undecided and differs.
const YELLOW: Colour = [255, 200, 0, 255];

/// What the colours of [`Comparison::picture`] mark.
#[must_use]
pub fn marks() -> [(Rgb<u8>, &'static str); 3] {
    let of = |[r, g, b, _]: Colour| Rgb([r, g, b]);
    [
        (of(RED), "the frames differ"),
        (of(BROWN), "two surfaces tie"),
        (of(YELLOW), "a tie that the frames show differently"),
    ]
}

/// Compares two frames of the same size: colours to the bit; depths within the sum of the bounds
/// that [`tolerance`] derives for the two rasterizers, with depths from 0 to 1, and one step of the
/// format. Where ties are known, what they excuse is no difference; the targets then hold every
/// sample of the frames.
pub fn compare(
    a: (&Frame<Colour>, &Target),
    b: (&Frame<Colour>, &Target),
    ties: Option<&Ties>,
) -> Comparison {
    let bounds = a.0.bounds();
    // Depths are compared sample by sample, colours pixel by pixel.
    let (depths, wrong) = compare_depths(a.1, b.1, ties);
    let mut found = Comparison {
        pixels: u64::from(bounds.width()) * u64::from(bounds.height()),
        wrong_pixels: 0,
        depths,
        wrong_depths: wrong.len() as u64,
        undecided: ties.map_or(0, Ties::count),
        undecided_differ: 0,
        far_texture: 0,
        picture: Frame::new(bounds, [0; 4]),
    };
    for y_px in bounds.y0..bounds.y1 {
        // Both pictures row by row, with what is known of ties at each pixel.
        let rows = a.0.row(y_px).iter().zip(b.0.row(y_px));
        for (x_px, (pixel, (first, second))) in
            (bounds.x0..).zip(found.picture.row_mut(y_px).iter_mut().zip(rows))
        {
            let ties = ties.filter(|ties| ties.is_undecided(x_px, y_px));
            let differs = first != second;
            // A difference is excused by ties alone, sample by sample.
            let is_excused = differs && ties.is_some_and(|t| only_ties(t, [a.1, b.1], x_px, y_px));
            found.wrong_pixels += u64::from(differs && !is_excused);
            // Of what is excused, ties of depth and far textures are counted apart.
            let is_far = is_excused && ties.is_some_and(|t| t.is_far_texture(x_px, y_px));
            found.undecided_differ += u64::from(is_excused && !is_far);
            found.far_texture += u64::from(is_far);
            *pixel = match (differs, is_excused, ties) {
                (true, true, _) => YELLOW,
                (true, false, _) => RED,
                (false, _, Some(_)) => BROWN,
                (false, _, None) => first.map_array(|channel| channel / 3),
            };
        }
    }
    // Several samples may belong to a pixel.
    let scale = a.1.antialias().scale() as i32;
    for (x_px, y_px) in wrong {
        found.picture.span_mut(y_px / scale, x_px / scale, x_px / scale + 1)[0] = RED;
    }
    found
}

/// Whether the samples of a pixel differ in colour only where ties excuse it, and somewhere do.
fn only_ties(ties: &Ties, [a, b]: [&Target; 2], x_px: i32, y_px: i32) -> bool {
    let scale = a.antialias().scale() as i32;
    // Every sample of the pixel has to be excused, if it differs.
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

/// How many pixels of two pictures differ.
pub fn differing(a: &Frame<Colour>, b: &Frame<Colour>) -> u64 {
    let mut count = 0;
    for ((_, a), (_, b)) in a.rows().zip(b.rows()) {
        for (a, b) in a.iter().zip(b) {
            count += u64::from(a != b);
        }
    }
    count
}

/// How many depths were compared, and the samples where they differ.
fn compare_depths(a: &Target, b: &Target, ties: Option<&Ties>) -> (u64, Vec<(i32, i32)>) {
    // Each engine may be off by its own bound.
    let error =
        tolerance::SCANLINE.depth.at([0.0, 1.0]) + tolerance::EDGE_FUNCTION.depth.at([0.0, 1.0]);
    // In steps of the format in which depths are stored.
    let tolerance = a.format.tolerance(error);
    let mut wrong = Vec::new();
    let mut count = 0;
    for (plane, (plane_a, plane_b)) in a.planes.iter().zip(&b.planes).enumerate() {
        let PixelRect { x0, y0, y1, .. } = plane_a.depth.bounds();
        for y_px in y0..y1 {
            let [row_a, row_b] = [plane_a, plane_b].map_array(|plane| plane.depth.row(y_px));
            count += row_a.len() as u64;
            if row_a == row_b {
                continue;
            }
            for (x_px, (&key_a, &key_b)) in (x0..).zip(row_a.iter().zip(row_b)) {
                // Where one of them drew nothing, depths are not near.
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

/// The effects that a map of a frame has a colour for.
pub fn mapped() -> impl Iterator<Item = Effect> {
    Effect::ALL.into_iter().filter(|effect| effect.map_colour().is_some())
}

/// How many pixels pay for an effect.
pub fn paid(map: &Frame<u32>, effect: Effect) -> u64 {
    let mut count = 0;
    for (_, row) in map.rows() {
        for paid in row {
            count += u64::from(paid & (1 << effect as u32) != 0);
        }
    }
    count
}

/// Panels in a row of a map, and the widest such row.
const MAP_COLUMNS: u32 = 3;
const MAP_WIDTH_PX: u32 = 1440;

/// How often something occurs in the pixels of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amount {
    pub mean: f64,
    pub most: u32,
    /// The first pixel that has the most, and how many have it.
    pub at: [i32; 2],
    pub pixels: u64,
}

impl Amount {
    /// Goes through a frame of counts once; of equal pixels the first one is named.
    pub fn of(counts: &Frame<u32>) -> Self {
        let x0 = counts.bounds().x0;
        let mut amount = Self { mean: 0.0, most: 0, at: [0; 2], pixels: 0 };
        let (mut sum, mut all) = (0u64, 0u64);
        for (y, row) in counts.rows() {
            for (x, &count) in (x0..).zip(row) {
                sum += u64::from(count);
                all += 1;
                if count > amount.most || all == 1 {
                    amount = Self { most: count, at: [x, y], pixels: 0, ..amount };
                }
                amount.pixels += u64::from(count == amount.most);
            }
        }
        Self { mean: sum as f64 / all.max(1) as f64, ..amount }
    }
}

/// The colour of a count on a scale from 1 to the most; 0 is dark grey.
fn heat(count: f64, most: u32) -> [u8; 3] {
    const STOPS: [[f64; 3]; 5] = [
        [68.0, 30.0, 110.0],
        [59.0, 82.0, 159.0],
        [33.0, 145.0, 140.0],
        [94.0, 201.0, 98.0],
        [253.0, 231.0, 37.0],
    ];
    if count < 0.5 {
        return [40; 3];
    }
    let share = (count - 1.0).max(0.0) / f64::from(most.saturating_sub(1).max(1));
    // Between two of the stops.
    let at = share.min(1.0) * (STOPS.len() - 1) as f64;
    let low = (at as usize).min(STOPS.len() - 2);
    let part = at - low as f64;
    [0, 1, 2].map_array(|i| (STOPS[low][i] * (1.0 - part) + STOPS[low + 1][i] * part) as u8)
}

/// What pixels pay as small pictures: how many fragments, what all of these pay for, and for each effect that is paid for
/// the frame, dimmed, and in colour the pixels that pay for it.
pub fn map_picture(title: &str, picture: &Frame<Colour>, paid_map: &PaidMap) -> RgbImage {
    let map = &paid_map.effects;
    let bounds = map.bounds();
    let (width, height) = (bounds.width(), bounds.height());
    // Large frames are made smaller, so that a row of panels fits.
    let shrunk = (width * MAP_COLUMNS).div_ceil(MAP_WIDTH_PX).max(1);
    let cell = |name: &str, ink: [u8; 3], words: String, colour: &dyn Fn(i32, i32) -> [u8; 3]| {
        let colour = |x, y| Rgb(colour(bounds.x0 + x as i32, bounds.y0 + y as i32));
        // Painted in full size, then made smaller as a whole.
        let whole = picture::painted(width, height, colour);
        let [width, height] = [width, height].map(|side| side.div_ceil(shrunk));
        let name = (name.to_owned(), Size::Heading, Rgb(ink));
        let words = [name, (words, Size::Small, panels::FAINT)];
        panels::titled(&words, &imageops::thumbnail(&whole, width, height), [0, 0])
    };
    let mut cells = Vec::new();
    for (name, counts) in
        [("fragments", &paid_map.fragments), ("effects of fragments", &paid_map.payments)]
    {
        let Amount { mean, most, .. } = Amount::of(counts);
        let words = format!("mean {mean:.2}, at most {most}");
        cells.push(cell(name, panels::INK.0, words, &|x, y| {
            heat(counts.get(x, y).unwrap_or(0).into(), most)
        }));
    }
    let pixels = u64::from(width) * u64::from(height);
    for effect in Effect::ALL {
        let (count, Some(paint)) = (paid(map, effect), effect.map_colour()) else { continue };
        if count == 0 {
            continue;
        }
        let words = format!("{count} px, {:.1}%", 100.0 * count as f64 / pixels.max(1) as f64);
        cells.push(cell(effect.name(), paint.map_array(|c| c / 2), words, &|x, y| {
            let [r, g, b, _] = picture.get(x, y).unwrap_or_default();
            // The lightness of the frame, in which green counts most.
            let grey = (u32::from(r) * 2 + u32::from(g) * 5 + u32::from(b)) / 8;
            // The frame shows through.
            let lit = |c: u8| (u32::from(c) * (160 + grey * 3 / 8) / 256).min(255) as u8;
            match map.get(x, y).unwrap_or(0) & (1 << effect as u32) {
                0 => [(40 + grey / 5) as u8; 3],
                _ => paint.map_array(lit),
            }
        }));
    }
    // What the colours of counts mean.
    let scale = (1..=9).map(|count| Rgb(heat(count.into(), 9))).collect();
    let entries = [
        (vec![Rgb(heat(0.0, 1))], "none".to_owned()),
        (scale, "from one a pixel to the most".to_owned()),
    ];
    let note = "effects: in colour the pixels that pay; behind it the frame, dimmed";
    let title = (title.to_owned(), Size::Heading, panels::INK);
    panels::arranged(&[title], cells, MAP_COLUMNS, &entries, note)
}

/// How long a picture took, in seconds.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Times {
    /// To read the model with its textures; nothing for a scene of the book.
    pub loading_s: Option<f64>,
    /// To plan and draw one frame, by each rasterizer.
    pub drawing_s: Vec<f64>,
}
