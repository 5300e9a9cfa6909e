//! The values of the samples of a pixel, computed by somebody who may be mistaken.

use std::collections::BTreeMap;

use super::search::{Quantity, Spot, Stage, choices, composed};
use crate::ask::{Answer, Asked, Question, SampledValues};
use crate::declared::Declared;
use crate::sample_values::{CENTRE, Place, bounds, place};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::ValuePlace;
use rasterproof_render::pipeline::multisample::{SAMPLES, masks, masks_at};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::oracle::Oracle;

composed! {
    /// The samples that are drawn in a pixel, and the way from the corners' values to theirs.
    pub struct SampleShading {
        masks: SampleGate,
        at: At,
        correction: Correction,
        range: Limit,
    }
}

choices! {
    /// Whether a sample is drawn, by itself, by the others of its pixel or by the centre.
    pub enum SampleGate: "samples with values", "draw the samples that are covered, each once" {
        Covered,
        Never = "does not draw {}",
        Whole = "draws all four samples of a touched pixel",
        CentreAlone = "draws samples only where the centre of their pixel is covered",
        ByCentre = "draws all four samples where the centre of their pixel is covered, and none elsewhere",
    }
}

choices! {
    /// Where values are computed, if not where that is declared.
    pub enum At: "the place of values of samples",
        "compute values where it is declared: at the centre, at each sample, or at the centroid" {
        Declared,
        Centre = "computes {} at the centre of the pixel",
        Sample = "computes {} at the place of each",
        Centroid = "computes {} at the centroid of the pixel (the centre, or the first covered sample)",
        Corner = "computes {} at the upper left corner of the pixel",
        First = "computes {} at the place of sample 0",
        Last = "computes {} at the covered sample with the greatest number",
        Mean = "computes {} at the mean of the covered samples",
    }
}

choices! {
    /// Whether attributes are those of perspective.
    pub enum Correction: "perspective of samples", "divide the sum of weight x value / w by that of weight / w" {
        Perspective,
        Linear = "interpolates {} without a correction for perspective",
    }
}

choices! {
    /// Whether extrapolated values stay as they are.
    pub enum Limit: "the range of values of samples", "extrapolate: the plane of a value goes on beyond the triangle" {
        Open,
        Clamped = "clamps {} to the range of the corners",
        Weights = "clamps the weights of {} to 0 to 1, and divides them by their sum",
    }
}

/// A pixel with the samples that were drawn in it.
pub struct ShadedPixel<'a> {
    pub(super) spot: Spot,
    triangle: &'a Triangle,
    /// What the answer says of it: some samples with the same values each.
    drawn: Vec<&'a SampledValues>,
    /// The samples that are covered, as a mask.
    pub(super) right: u8,
    pub(super) is_centre_covered: bool,
    /// Where values belong by what the program declares.
    declared: ValuePlace,
    /// How far a value may be off, as a share of the largest one at the corners.
    tolerance: f64,
}

/// All four samples where something holds, and else none.
fn all_where(holds: bool) -> u8 {
    if holds { 0b1111 } else { 0 }
}

/// A place of a pixel as floats.
fn float((x, y): Place) -> [f64; 2] {
    [f64::from(x), f64::from(y)]
}

impl SampleShading {
    /// The samples that are drawn.
    fn mask(&self, pixel: &ShadedPixel<'_>) -> u8 {
        match self.masks {
            SampleGate::Covered => pixel.right,
            SampleGate::Never => 0,
            SampleGate::Whole => all_where(pixel.right != 0),
            SampleGate::CentreAlone => pixel.right & all_where(pixel.is_centre_covered),
            SampleGate::ByCentre => all_where(pixel.is_centre_covered),
        }
    }

    /// Where a sample gets its value, in 1/16 px.
    fn place(&self, pixel: &ShadedPixel<'_>, sample: usize) -> [f64; 2] {
        let covered = pixel.right;
        match self.at {
            At::Declared => float(place(pixel.declared, covered, sample)),
            At::Centre => float(CENTRE),
            At::Sample => float(SAMPLES[sample]),
            At::Centroid => float(place(ValuePlace::Centroid, covered, sample)),
            At::Corner => [0.0; 2],
            At::First => float(SAMPLES[0]),
            At::Last => float(SAMPLES[covered.checked_ilog2().unwrap_or(0) as usize % 4]),
            At::Mean => {
                let (mut sum, mut count) = ([0.0; 2], 0.0_f64);
                for (bit, place) in SAMPLES.into_iter().enumerate() {
                    if covered >> bit & 1 == 1 {
                        let [x, y] = float(place);
                        sum = [sum[0] + x, sum[1] + y];
                        count += 1.0;
                    }
                }
                // Without a sample it is the corner, as 0 divided by anything.
                sum.map(|v| v / count.max(1.0))
            }
        }
    }

    /// Depth and both attributes at a place of a pixel.
    fn values(&self, pixel: &ShadedPixel<'_>, place: [f64; 2]) -> [f64; 3] {
        let t = pixel.triangle;
        // The weights of the corners there: each is twice the area of the triangle with the other two, as a share of the whole.
        let corners = t.corners();
        let px = [0, 1].map(|k| f64::from(pixel.spot.at[k]) + place[k] / 16.0);
        let at = px.map(|v| v * f64::from(SUBPIXELS));
        let ways = corners.map(|c| [f64::from(c.x) - at[0], f64::from(c.y) - at[1]]);
        let area = twice_area(&corners) as f64;
        let mut weights = [0.0; 3];
        for (i, weight) in weights.iter_mut().enumerate() {
            let (p, q) = (ways[(i + 1) % 3], ways[(i + 2) % 3]);
            *weight = (p[0] * q[1] - p[1] * q[0]) / area;
        }
        if self.range == Limit::Weights {
            weights = weights.map(|weight| weight.clamp(0.0, 1.0));
            let sum: f64 = weights.iter().sum();
            weights = weights.map(|weight| weight / sum);
        }
        // An attribute is a sum of value / w over a sum of 1 / w.
        let over_w =
            t.vertices.map(|v| if self.correction == Correction::Linear { 1.0 } else { v.inv_w });
        let divisor: f64 = (0..3).map(|i| weights[i] * over_w[i]).sum();
        let values = [
            t.vertices.map(|v| v.depth),
            t.vertices.map(|v| v.varying.x),
            t.vertices.map(|v| v.varying.y),
        ];
        [0, 1, 2].map(|k| {
            // Depth is linear in the window.
            let (scale, divisor) = if k == 0 { ([1.0; 3], 1.0) } else { (over_w, divisor) };
            let sum: f64 = (0..3).map(|i| weights[i] * scale[i] * values[k][i]).sum();
            let value = sum / divisor;
            match self.range {
                Limit::Clamped => {
                    let [a, b, c] = values[k];
                    value.clamp(a.min(b).min(c), a.max(b).max(c))
                }
                _ => value,
            }
        })
    }

    /// Whether a sample has these values.
    fn has_values(&self, pixel: &ShadedPixel<'_>, sample: usize, found: [f64; 3]) -> bool {
        // Where a value is extrapolated, more of an error is allowed.
        let at = self.place(pixel, sample);
        let [x, y] = at.map(|v| v.round() as i32);
        let right = self.values(pixel, at);
        let bounds = bounds(pixel.triangle, pixel.spot.at, (x, y), right, pixel.tolerance);
        // What the judge does not compare may be anything.
        bounds.is_none_or(|bounds| (0..3).all(|k| (found[k] - right[k]).abs() <= bounds[k]))
    }
}

impl Stage for SampleShading {
    type Part<'a> = ShadedPixel<'a>;
    const PAGE: &'static str = "judge";
    const REFUTED: &'static str = "a sample with another value";
    const NOISE: &'static [f64] = &[0.0];
    const WHOM: &'static str = "pixels";

    fn parts<'a>(
        question: &'a Question,
        answer: &'a Answer,
        declared: &Declared,
        _: f64,
    ) -> Vec<ShadedPixel<'a>> {
        let (Asked::SampleValues(triangle), Answer::SampleValues(list)) = (&question.of, answer)
        else {
            return Vec::new();
        };
        let window = PixelRect::window(question.width, question.height);
        let corners = triangle.corners();
        // What is covered exactly, by samples and by centres.
        let Some(right) = masks(&Oracle, corners, window) else { return Vec::new() };
        let Some(centres) = masks_at(&Oracle, corners, window, &[CENTRE]) else {
            return Vec::new();
        };
        // What was answered of each pixel: samples with the same values come together.
        let mut drawn: BTreeMap<[i32; 2], Vec<&SampledValues>> = BTreeMap::new();
        for one in list.iter().filter(|one| window.contains(one.values.x_px, one.values.y_px)) {
            drawn.entry([one.values.x_px, one.values.y_px]).or_default().push(one);
        }
        let is_clockwise = twice_area(&corners) > 0;
        let mut parts = Vec::new();
        for (y, row) in right.rows() {
            for (x, &right) in (window.x0..).zip(row) {
                let drawn = drawn.remove(&[x, y]).unwrap_or_default();
                if right == 0 && drawn.is_empty() {
                    continue;
                }
                parts.push(ShadedPixel {
                    spot: Spot { at: [x, y], is_clockwise, window },
                    triangle,
                    drawn,
                    right,
                    is_centre_covered: centres.get(x, y) == Some(1),
                    declared: declared.values_at,
                    tolerance: declared.tolerance,
                });
            }
        }
        parts
    }

    fn explains(&self, part: &ShadedPixel<'_>) -> bool {
        // No sample may come twice, and those that come have to be those of the mask.
        let mut seen = 0;
        for SampledValues { mask, values } in &part.drawn {
            let found = [values.depth, values.varying.x, values.varying.y];
            if seen & mask != 0 {
                return false;
            }
            for sample in 0..4 {
                if mask >> sample & 1 == 1 && !self.has_values(part, sample, found) {
                    return false;
                }
            }
            seen |= mask;
        }
        seen == self.mask(part)
    }

    fn quantities(pixel: &ShadedPixel<'_>) -> Vec<Quantity> {
        let mut all = pixel.spot.quantities();
        all.push(Quantity::number("the number of covered samples", pixel.right.count_ones()));
        all
    }

    fn filled(&self, does: &str) -> String {
        does.replace("{}", "the values of samples")
    }
}
