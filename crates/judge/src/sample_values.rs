//! Values of the samples of a pixel: at its centre, also where that is not covered, at each sample, or at the centroid.
//!
//! Beyond the border of a triangle values are extrapolated, and there an error grows. Depth is a sum of the depths at the corners times
//! weights whose sum is 1. Inside, no weight is below 0. Outside, the sum of their magnitudes s is more than 1, and errors of the terms
//! add up to s times as much. An attribute is a quotient of two such sums, of which the lower one has the terms weight / w. So its
//! errors are greater by the sum of the magnitudes of these terms over the magnitude of their sum. Inside, both factors are 1.

use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_core::triangle::{Fragment, ValuePlace};
use rasterproof_render::pipeline::multisample::{SAMPLES, moved};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::pixels::few;
use rasterproof_verify::oracle::values::{Exact, ExactTriangle};

use super::ask::SampledValues;
use super::declared::Declared;
use super::expected::{exact_values, value_bounds};
use super::judged::CaseJudgement;

/// A point of a pixel, in 1/16 px from its upper left corner.
pub type Place = (i32, i32);

/// Halfway between 0 and 16 on both axes.
pub const CENTRE: Place = (8, 8);

/// Where the value of a sample is computed, in a pixel of which these samples are covered.
#[must_use]
pub fn place(at: ValuePlace, covered: u8, sample: usize) -> Place {
    match at {
        ValuePlace::Sample => SAMPLES[sample],
        ValuePlace::Centroid if covered != 0b1111 => SAMPLES[covered.trailing_zeros() as usize % 4],
        ValuePlace::Centre | ValuePlace::Centroid => CENTRE,
    }
}

/// By how much more than inside the triangle depth and attributes may be off at a point of a pixel. Nothing where the plane of 1 / w
/// is not above 0, so that no perspective has a value there.
fn factors(triangle: &Triangle, [x_px, y_px]: [i32; 2], (x, y): Place) -> Option<[f64; 2]> {
    let corners = triangle.corners();
    let at = [(x_px, x), (y_px, y)].map(|(px, part)| {
        i64::from(px) * i64::from(SUBPIXELS) + i64::from(part * (SUBPIXELS / 16))
    });
    // Twice the area of each of the three triangles with the place, as a share of the whole.
    let area = twice_area(&corners) as f64;
    let (mut of_depth, mut sum, mut magnitudes) = (0.0, 0.0, 0.0);
    for (i, v) in triangle.vertices.iter().enumerate() {
        let [p, q] = [1, 2]
            .map(|k| corners[(i + k) % 3])
            .map(|p| [i128::from(p.x) - i128::from(at[0]), i128::from(p.y) - i128::from(at[1])]);
        let weight = (p[0] * q[1] - p[1] * q[0]) as f64 / area;
        of_depth += weight.abs();
        sum += weight * v.inv_w;
        magnitudes += weight.abs() * v.inv_w;
    }
    (sum > 0.0).then(|| [of_depth, magnitudes / sum])
}

/// Errors that are larger than this share of a value by the tolerance alone say nothing of it.
const MOST_OF_A_VALUE: f64 = 0.25;

/// How far depth and both attributes may be off at a point of a pixel where they are `values`. Nothing where they are not compared,
/// since perspective has no value there or the tolerance alone allows too much of it.
#[must_use]
pub fn bounds(
    triangle: &Triangle,
    at_px: [i32; 2],
    place: Place,
    values: [f64; 3],
    tolerance: f64,
) -> Option<[f64; 3]> {
    let [of_depth, of_attributes] = factors(triangle, at_px, place)?;
    if tolerance * of_depth.max(of_attributes) > MOST_OF_A_VALUE {
        return None;
    }
    let inside = value_bounds(triangle, tolerance);
    let factors = [of_depth, of_attributes, of_attributes];
    // Of the largest magnitude of all, the extrapolated one among them.
    Some([0, 1, 2].map(|i| inside[i].max(tolerance * values[i].abs()) * factors[i]))
}

/// Compares the values of some samples with exact ones, where these samples are covered.
pub(super) fn compare(
    judged: &mut CaseJudgement,
    triangle: &Triangle,
    drawn: &[SampledValues],
    covered: &Frame<u8>,
    declared: &Declared,
) {
    let mut exact: Vec<(Place, Option<ExactTriangle<2>>)> = Vec::new();
    // Exact values take long, so that some pixels are compared, and each place of a sample is computed once.
    let compared: Vec<&SampledValues> = few(drawn).collect();
    for SampledValues { mask, values } in compared {
        let Some(covered) = covered.get(values.x_px, values.y_px) else { continue };
        let both = mask & covered;
        for sample in (0..SAMPLES.len()).filter(|sample| both >> sample & 1 == 1) {
            let place = place(declared.values_at, covered, sample);
            if !exact.iter().any(|(known, _)| *known == place) {
                // A triangle that is moved so that the place comes to lie at the centre.
                let at = moved(triangle, place).and_then(|moved| exact_values(&moved, declared));
                exact.push((place, at));
            }
            let known = exact.iter().find(|(known, _)| *known == place);
            if let Some((_, Some(exact))) = known {
                compare_one(judged, triangle, values, (exact, place), declared.tolerance);
            }
        }
    }
}

/// Compares the values of one sample with the exact ones of the place where they are computed.
fn compare_one(
    judged: &mut CaseJudgement,
    triangle: &Triangle,
    found: &Fragment<glam::DVec2>,
    (exact, place): (&ExactTriangle<2>, Place),
    tolerance: f64,
) {
    let at_px = [found.x_px, found.y_px];
    let (depth, [a, b]) = exact.at(at_px[0], at_px[1]);
    // What the exact values are decides how far the answer may be off.
    let right = [&depth, &a, &b];
    let Some(bounds) = bounds(triangle, at_px, place, right.map(Exact::to_f64), tolerance) else {
        return;
    };
    let drawn = [found.depth, found.varying.x, found.varying.y];
    judged.off(found, [0, 1, 2].map(|i| right[i].distance(drawn[i]) / bounds[i]));
}
