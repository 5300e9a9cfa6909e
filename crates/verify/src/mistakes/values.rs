//! Mistakes in values: what a wrong program makes of depth and attributes, from the weights of the corners at a place.

use glam::DVec2;

use super::{Explanation, Hypothesis, MistakeId, Mistakes, chosen_by, of_answers};
use crate::cases::facts::exponent;
use crate::cases::{self, Shape, Triangle};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Fragment};

/// What is wrong with values, from the weights of the corners at a place.
struct ValueMistake {
    name: &'static str,
    does: &'static str,
    repair: &'static str,
    page: &'static str,
    refuted: &'static str,
    /// Depth and both attributes.
    values: fn(&Triangle, [f64; 3]) -> [f64; 3],
}

fn each(v: &Triangle, of: impl Fn(DVec2) -> f64) -> [f64; 3] {
    v.vertices.map(|v| of(v.varying))
}

/// The depths of the corners.
#[must_use]
pub fn depths(t: &Triangle) -> [f64; 3] {
    t.vertices.map(|v| v.depth)
}

/// The weighted sum of three values.
#[must_use]
pub fn sum(weights: [f64; 3], values: [f64; 3]) -> f64 {
    weights.into_iter().zip(values).map(|(weight, value)| weight * value).sum()
}

/// The weights of a corner's value after the perspective is corrected.
fn corrected(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    let parts = [0, 1, 2].map(|i| weights[i] * t.vertices[i].inv_w);
    let whole: f64 = parts.iter().sum();
    parts.map(|part| part / whole)
}

fn attributes(t: &Triangle, weights: [f64; 3]) -> [f64; 2] {
    [sum(weights, each(t, |v| v.x)), sum(weights, each(t, |v| v.y))]
}

fn with(depth: f64, [a, b]: [f64; 2]) -> [f64; 3] {
    [depth, a, b]
}

fn right_values(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    with(sum(weights, depths(t)), attributes(t, corrected(t, weights)))
}

/// Right values, where two corners have exchanged their attributes.
fn exchanged(t: &Triangle, weights: [f64; 3], i: usize, j: usize) -> [f64; 3] {
    let mut parts = corrected(t, weights);
    parts.swap(i, j);
    with(sum(weights, depths(t)), attributes(t, parts))
}

/// Twice the signed area in pixels squared.
fn twice_px(t: &Triangle) -> f64 {
    twice_area(&t.corners()) as f64 / f64::from(SUBPIXELS * SUBPIXELS)
}

const VALUES: &[ValueMistake] = &[
    ValueMistake {
        name: "attributes ignore w",
        does: MistakeId::Affine.name(),
        repair: "interpolate a/w and 1/w, and divide at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w whose attributes bend",
        values: |t, l| with(sum(l, depths(t)), attributes(t, l)),
    },
    ValueMistake {
        name: "depth as an attribute",
        does: MistakeId::DepthInPerspective.name(),
        repair: "depth after the division by w is linear on the screen: interpolate it without correction",
        page: "ch06",
        refuted: "a triangle with unequal w whose depth is linear on the screen",
        values: |t, l| with(sum(corrected(t, l), depths(t)), attributes(t, corrected(t, l))),
    },
    ValueMistake {
        name: "depth and attributes exchanged",
        does: "corrects depth for perspective, and not the attributes",
        repair: "correct the attributes, and leave depth linear",
        page: "ch06",
        refuted: "a triangle with unequal w whose attributes bend",
        values: |t, l| with(sum(corrected(t, l), depths(t)), attributes(t, l)),
    },
    ValueMistake {
        name: "not divided back",
        does: MistakeId::NotDividedBack.name(),
        repair: "divide by the interpolated 1/w at every pixel",
        page: "ch05",
        refuted: "a triangle with w other than 1 and right attributes",
        values: |t, l| {
            let over_w = [0, 1, 2].map(|i| l[i] * t.vertices[i].inv_w);
            with(sum(l, depths(t)), attributes(t, over_w))
        },
    },
    ValueMistake {
        name: "w in place of 1/w",
        does: MistakeId::WeightsByW.name(),
        repair: "weight the corners by 1/w",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| {
            let parts = [0, 1, 2].map(|i| l[i] / t.vertices[i].inv_w);
            let whole: f64 = parts.iter().sum();
            with(sum(l, depths(t)), attributes(t, parts.map(|part| part / whole)))
        },
    },
    ValueMistake {
        name: "w interpolated on the screen",
        does: "interpolates a/w and w linearly on the screen and multiplies them",
        repair: "interpolate 1/w, and divide by it at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| {
            let w = sum(l, t.vertices.map(|v| 1.0 / v.inv_w));
            let over_w = [0, 1, 2].map(|i| l[i] * t.vertices[i].inv_w * w);
            with(sum(l, depths(t)), attributes(t, over_w))
        },
    },
    ValueMistake {
        name: "attributes exchanged",
        does: "exchanges the two attributes",
        repair: "keep their order from the corners to the pixels",
        page: "ch05",
        refuted: "a pixel whose first attribute is right",
        values: |t, l| {
            let [a, b] = attributes(t, corrected(t, l));
            with(sum(l, depths(t)), [b, a])
        },
    },
    ValueMistake {
        name: "values of one corner",
        does: "gives every pixel the values of the first corner",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, _| right_values(t, [1.0, 0.0, 0.0]),
    },
    ValueMistake {
        name: "values of one corner",
        does: "gives every pixel the values of the second corner",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, _| right_values(t, [0.0, 1.0, 0.0]),
    },
    ValueMistake {
        name: "values of one corner",
        does: "gives every pixel the values of the last corner",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, _| right_values(t, [0.0, 0.0, 1.0]),
    },
    ValueMistake {
        name: "the mean of the corners",
        does: "gives every pixel the mean of the corners",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, _| with(sum([1.0 / 3.0; 3], depths(t)), attributes(t, [1.0 / 3.0; 3])),
    },
    ValueMistake {
        name: "values are clamped",
        does: "clamps values to 0 to 1",
        repair: "clamp colours where they are stored, and nothing before",
        page: "ch05",
        refuted: "a value above 1",
        values: |t, l| right_values(t, l).map(|v| v.clamp(0.0, 1.0)),
    },
    ValueMistake {
        name: "w as depth",
        does: "gives w as depth",
        repair: "give z/w",
        page: "ch06",
        refuted: "a depth other than w",
        values: |t, l| {
            let w: f64 = 1.0 / sum(l, t.vertices.map(|v| v.inv_w));
            with(w, attributes(t, corrected(t, l)))
        },
    },
    ValueMistake {
        name: "1/w as depth",
        does: "gives 1/w as depth",
        repair: "give z/w",
        page: "ch06",
        refuted: "a depth other than 1/w",
        values: |t, l| with(sum(l, t.vertices.map(|v| v.inv_w)), attributes(t, corrected(t, l))),
    },
    ValueMistake {
        name: "weights of other corners",
        does: "gives the second corner the weight of the third and the third that of the second",
        repair: "keep a value with its corner where corners are sorted or exchanged",
        page: "ch05",
        refuted: "a pixel near the second corner with its values",
        values: |t, [a, b, c]| right_values(t, [a, c, b]),
    },
    ValueMistake {
        name: "weights of other corners",
        does: "gives the first corner the weight of the second and the second that of the first",
        repair: "keep a value with its corner where corners are sorted or exchanged",
        page: "ch05",
        refuted: "a pixel near the first corner with its values",
        values: |t, [a, b, c]| right_values(t, [b, a, c]),
    },
    ValueMistake {
        name: "weights of other corners",
        does: "gives each corner the weight of the next one",
        repair: "the weight of a corner is the area opposite to it",
        page: "ch05",
        refuted: "a pixel near a corner with its values",
        values: |t, [a, b, c]| right_values(t, [b, c, a]),
    },
    ValueMistake {
        name: "weights of other corners",
        does: "gives each corner the weight of the one before",
        repair: "the weight of a corner is the area opposite to it",
        page: "ch05",
        refuted: "a pixel near a corner with its values",
        values: |t, [a, b, c]| right_values(t, [c, a, b]),
    },
    ValueMistake {
        name: "corners keep their places when they are exchanged",
        does: MistakeId::ExchangedWeights.name(),
        repair: "exchange the values with the corners",
        page: "ch05",
        refuted: "a counterclockwise triangle with right values",
        values: |t, [a, b, c]| {
            right_values(t, if twice_area(&t.corners()) < 0 { [a, c, b] } else { [a, b, c] })
        },
    },
    ValueMistake {
        name: "weights of a transposed matrix",
        does: MistakeId::TransposedMatrix.name(),
        repair: "multiply the matrix with the corners as columns by the point",
        page: "ch02",
        refuted: "a pixel near a corner with its values",
        values: |t, l| {
            // The rows of the inverse are what each weight is of x, y and 1; a weight changes evenly along an axis.
            let at = |x, y| weights(&t.corners(), [x, y]);
            let (constant, x, y) = (at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0));
            let point = [0, 1].map(|axis| {
                let corners = t.corners().map(px);
                sum(l, corners.map(|corner| corner[axis]))
            });
            let row = |i: usize| [x[i] - constant[i], y[i] - constant[i], constant[i]];
            let parts = [0, 1, 2].map(|k| row(0)[k] * point[0] + row(1)[k] * point[1] + row(2)[k]);
            right_values(t, parts)
        },
    },
    ValueMistake {
        name: "depth not divided by the area",
        does: MistakeId::DepthNotDivided.name(),
        repair: "divide the weighted sum by the area",
        page: "ch06",
        refuted: "a triangle of another area than 1 with right depths",
        values: |t, l| with(sum(l, depths(t)) * twice_px(t).abs(), attributes(t, corrected(t, l))),
    },
    ValueMistake {
        name: "depth not divided by the area",
        does: MistakeId::DepthNotDividedBySign.name(),
        repair: "divide the weighted sum by the area",
        page: "ch06",
        refuted: "a triangle of another area than 1 with right depths",
        values: |t, l| with(sum(l, depths(t)) * twice_px(t), attributes(t, corrected(t, l))),
    },
    ValueMistake {
        name: "depth divided by w again",
        does: MistakeId::DepthDividedTwice.name(),
        repair: "depth is z/w already: interpolate it as it is",
        page: "ch06",
        refuted: "a corner with w other than 1 and right depths",
        values: |t, l| {
            let over_w = t.vertices.map(|v| v.depth * v.inv_w);
            with(sum(l, over_w), attributes(t, corrected(t, l)))
        },
    },
    ValueMistake {
        name: "one w for a triangle",
        does: "divides attributes by the mean of 1/w for the whole triangle",
        repair: "divide by the interpolated 1/w at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| {
            let mean = t.vertices.iter().map(|v| v.inv_w).sum::<f64>() / 3.0;
            let over_w = [0, 1, 2].map(|i| l[i] * t.vertices[i].inv_w / mean);
            with(sum(l, depths(t)), attributes(t, over_w))
        },
    },
    ValueMistake {
        name: "attributes of other corners",
        does: "exchanges the attributes of the first and the second corner, and not their w",
        repair: "exchange all numbers of a corner",
        page: "ch05",
        refuted: "an attribute that is right at a corner",
        values: |t, l| exchanged(t, l, 0, 1),
    },
    ValueMistake {
        name: "attributes of other corners",
        does: "exchanges the attributes of the second and the third corner, and not their w",
        repair: "exchange all numbers of a corner",
        page: "ch05",
        refuted: "an attribute that is right at a corner",
        values: |t, l| exchanged(t, l, 1, 2),
    },
    ValueMistake {
        name: "attributes of other corners",
        does: "exchanges the attributes of the first and the third corner, and not their w",
        repair: "exchange all numbers of a corner",
        page: "ch05",
        refuted: "an attribute that is right at a corner",
        values: |t, l| exchanged(t, l, 0, 2),
    },
    ValueMistake {
        name: "another value",
        does: "gives depth in place of the first attribute",
        repair: "keep depth and attributes apart",
        page: "ch05",
        refuted: "a pixel with its own attribute",
        values: |t, l| {
            let [depth, _, second] = right_values(t, l);
            [depth, depth, second]
        },
    },
    ValueMistake {
        name: "weights of w squared",
        does: "divides attributes by w twice, as where 1/w is divided by w once more",
        repair: "weight the corners by 1/w",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| {
            let parts = [0, 1, 2].map(|i| l[i] * t.vertices[i].inv_w * t.vertices[i].inv_w);
            let whole: f64 = parts.iter().sum();
            with(sum(l, depths(t)), attributes(t, parts.map(|part| part / whole)))
        },
    },
    ValueMistake {
        name: "values of one corner",
        does: "gives every pixel the attributes of the corner with the largest weight",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, l| {
            let most = (0..3).rev().max_by(|a, b| l[*a].total_cmp(&l[*b])).unwrap_or(0);
            let mut one = [0.0; 3];
            one[most] = 1.0;
            with(sum(l, depths(t)), attributes(t, one))
        },
    },
    ValueMistake {
        name: "values without a sign",
        does: "loses the sign of attributes",
        repair: "leave attributes as they are: textures may begin below 0",
        page: "ch05",
        refuted: "a negative attribute",
        values: |t, l| {
            let [depth, a, b] = right_values(t, l);
            [depth, a.abs(), b.abs()]
        },
    },
    ValueMistake {
        name: "depth in place of w",
        does: "weights the corners by 1/z where 1/w is right",
        repair: "weight the corners by 1/w: z after the division by w is no distance",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| {
            let parts = [0, 1, 2].map(|i| l[i] / t.vertices[i].depth);
            let whole: f64 = parts.iter().sum();
            with(sum(l, depths(t)), attributes(t, parts.map(|part| part / whole)))
        },
    },
    ValueMistake {
        name: "one w for a triangle",
        does: "interpolates a/w and multiplies by the mean of w for the whole triangle",
        repair: "divide by the interpolated 1/w at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| {
            let mean = t.vertices.iter().map(|v| 1.0 / v.inv_w).sum::<f64>() / 3.0;
            let over_w = [0, 1, 2].map(|i| l[i] * t.vertices[i].inv_w * mean);
            with(sum(l, depths(t)), attributes(t, over_w))
        },
    },
    ValueMistake {
        name: "weights are squared",
        does: "squares the weights of the corners and divides them by their sum",
        repair: "use the weights as they are: they add up to 1",
        page: "ch02",
        refuted: "a pixel away from corners and middles with right values",
        values: |t, l| {
            let whole: f64 = l.iter().map(|part| part * part).sum();
            right_values(t, l.map(|part| part * part / whole))
        },
    },
    ValueMistake {
        name: ELSEWHERE,
        does: "computes right values",
        repair: "compute values where coverage is sampled",
        page: "ch05",
        refuted: "a pixel with the values of its sample",
        values: right_values,
    },
];

/// Where values may be taken in a pixel, and how that is said.
pub const PLACES: [([f64; 2], &str); 7] = [
    ([0.5, 0.5], ""),
    ([0.0, 0.0], ", at the upper left corner of the pixel"),
    ([1.0, 1.0], ", at the lower right corner of the pixel"),
    ([0.0, 0.5], ", at the left side of the pixel"),
    ([0.5, 0.0], ", at the upper side of the pixel"),
    ([1.0, 0.5], ", at the right side of the pixel"),
    ([0.5, 1.0], ", at the lower side of the pixel"),
];

fn px(p: SubpixelPoint) -> [f64; 2] {
    [p.x, p.y].map(|v| f64::from(v) / f64::from(SUBPIXELS))
}

fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The weights of the corners at a place, in pixels.
#[must_use]
pub fn weights(corners: &Corners, at: [f64; 2]) -> [f64; 3] {
    let [a, b, c] = corners.map(px);
    let area = cross(a, b, c);
    [cross(b, c, at), cross(c, a, at), cross(a, b, at)].map(|part| part / area)
}

type Moved = fn(i32) -> i32;
/// What becomes of corners before the weights are computed, and how that is said.
const CORNERS: [(Moved, &str); 5] = [
    (|v| v, ""),
    (|v| v.div_euclid(16) * 16, ", from corners that are cut to 1/16 px"),
    (|v| v.saturating_add(8).div_euclid(16) * 16, ", from corners that are rounded to 1/16 px"),
    (|v| v.div_euclid(SUBPIXELS) * SUBPIXELS, ", from corners that are cut to whole pixels"),
    (
        |v| v.saturating_add(HALF_PIXEL).div_euclid(SUBPIXELS) * SUBPIXELS,
        ", from corners that are rounded to whole pixels",
    ),
];

/// Numbers in which something is kept, with so many bits, and how that is said.
type Keep = fn(f64, i32) -> f64;
type Kept = (Keep, &'static [i32], &'static str);
const KEPT: [Kept; 9] = [
    (
        |v, bits| mantissa(v, bits, f64::round),
        FLOATS,
        "floats with {} bits after the first one, rounded",
    ),
    (
        |v, bits| mantissa(v, bits, f64::trunc),
        FLOATS,
        "floats with {} bits after the first one, cut",
    ),
    (|v, bits| in_unit(v, bits, f64::round), UNITS, "{} bits between 0 and 1, rounded"),
    (|v, bits| in_unit(v, bits, f64::floor), UNITS, "{} bits between 0 and 1, cut down"),
    (
        |v, bits| in_steps(v, bits, f64::floor),
        STEPS_OF,
        "whole numbers and {} bits of fraction, cut down",
    ),
    (
        |v, bits| in_steps(v, bits, f64::trunc),
        STEPS_OF,
        "whole numbers and {} bits of fraction, cut toward zero",
    ),
    (
        |v, bits| in_steps(v, bits, f64::round),
        STEPS_OF,
        "whole numbers and {} bits of fraction, rounded",
    ),
    (|v, _| v - v.floor(), &[0], "fractions alone, as they wrap around at 1"),
    (|v, _| rounded(v, 2), &[0], "floats of 16 bits"),
];
/// Bits of floats of 16 bits, of those with the exponent of one of 32 bits, and of others.
const FLOATS: &[i32] = &[10, 7, 5, 8, 12, 16];
const UNITS: &[i32] = &[8, 4, 5, 6, 7, 10, 12, 16];
const STEPS_OF: &[i32] = &[8, 0, 2, 4, 6, 10, 12, 16];

fn in_unit(v: f64, bits: i32, cut: fn(f64) -> f64) -> f64 {
    let most = f64::from(2).powi(bits) - 1.0;
    cut(v.clamp(0.0, 1.0) * most) / most
}

fn in_steps(v: f64, bits: i32, cut: fn(f64) -> f64) -> f64 {
    let unit = f64::from(2).powi(-bits);
    cut(v / unit) * unit
}

/// A number in the precision of this number: 0 is 32 bits, 1 is 64, and 2 is 16.
#[must_use]
pub fn rounded(v: f64, precision: i64) -> f64 {
    match precision {
        0 => f64::from(v as f32),
        1 => v,
        _ if v.abs() >= 65520.0 => v.signum() * f64::INFINITY,
        _ => {
            // 10 bits after the first one, down to 2^-24: a sum with 1.5 x 2^52 such units has no others, halves to even.
            let large = f64::from_bits(((exponent(v).max(-14) + 42 + 1023) as u64) << 52) * 1.5;
            v + large - large
        }
    }
}

fn mantissa(v: f64, bits: i32, cut: fn(f64) -> f64) -> f64 {
    if v == 0.0 || !v.is_finite() {
        return v;
    }
    let unit = f64::from(2).powi(exponent(v) - bits);
    cut(v / unit) * unit
}

/// Which values a mistake is in, and how that is said; the others are right.
const PARTS: [([bool; 3], &str); 5] = [
    ([true; 3], ""),
    ([false, true, false], " (the first attribute alone: the second and depth are right)"),
    ([false, false, true], " (the second attribute alone: the first and depth are right)"),
    ([false, true, true], " (attributes alone: depth is right)"),
    ([true, false, false], " (depth alone: attributes are right)"),
];

/// A mistake in some values at a place, from corners as they are or moved.
pub struct ValueHypothesis {
    /// What is said of it.
    pub says: Explanation,
    place: [f64; 2],
    moved: Moved,
    values: fn(&Triangle, [f64; 3]) -> [f64; 3],
    parts: [bool; 3],
    /// Numbers in which values are kept, or the weights of the corners, with their bits.
    kept: Option<(Kept, i32)>,
    weights: Option<(Kept, i32)>,
    /// The same of 1/w at a pixel, or of w, by which attributes are multiplied.
    divisor: Option<(Kept, i32, bool)>,
    /// The same of 1/w at the corners, or of w.
    of_corners: Option<(Kept, i32, bool)>,
    /// What becomes of each right value: it is multiplied, and something is added.
    scaled: [[f64; 2]; 3],
    /// Pixels of a block that have one value, and the place in the block.
    block: Option<(i32, f64)>,
    /// What is computed at each pixel of a row, and what is interpolated between.
    along: Along,
    /// What becomes of the attributes of the corners.
    corner: Option<(Keep, i32)>,
    /// Whether the first sample of a row has the values of the left edge, and the first row those of the top corner; and
    /// whether the first ones are those in the window.
    unstepped: [bool; 3],
    /// The triangles that it is in, by a number of [`SIZES`] and the ends of a range; the others are right.
    only: Option<(usize, [f64; 2])>,
}

/// How values go on along a row of pixels.
#[derive(Clone, Copy)]
enum Along {
    /// The values of each pixel are computed at its own place.
    Pixels,
    /// All pixels have the values of the first one.
    First,
    /// Attributes are linear between every so many pixels, which are counted from the first pixel of the row, or else from the
    /// left side of the window.
    Steps(i32, bool),
    /// Attributes are linear between the left and the right edge.
    Edges,
}

/// How near an edge comes to a sample that is not on it, in pixels: at the height of a sample its place is a multiple of
/// 1/256 px divided by its height in subpixels, which is less than 2^20.
const NEAREST_MISS: f64 = 1.0 / (256 << 20) as f64;

/// Where the part of a row begins and ends of which no weight is negative, with the number of the weight that is 0 there. The
/// weights are given at the places 0 and 1 of the row.
fn ends_of_row(at_0: [f64; 3], at_1: [f64; 3]) -> [(f64, usize); 2] {
    let (mut left, mut right) = ((f64::MIN, 0), (f64::MAX, 0));
    for i in 0..3 {
        let change = at_1[i] - at_0[i];
        let zero = -at_0[i] / change;
        if change > 0.0 && zero > left.0 {
            left = (zero, i);
        } else if change < 0.0 && zero < right.0 {
            right = (zero, i);
        }
    }
    [left, right]
}

type Size = fn(&Triangle) -> f64;
/// By what triangles may be told of which attributes are not corrected.
const SIZES: [(Size, &str); 4] = [
    (
        |t| {
            let all = t.vertices.map(|v| v.inv_w);
            all.into_iter().fold(f64::MIN, f64::max) / all.into_iter().fold(f64::MAX, f64::min)
        },
        "whose largest w is {} times the smallest one",
    ),
    (|t| twice_px(t).abs() / 2.0, "whose area is {} square pixels"),
    (|t| extent(t, 0), "whose width is {} px"),
    (|t| extent(t, 1), "whose height is {} px"),
];

fn extent(t: &Triangle, axis: usize) -> f64 {
    let all = t.corners().map(|corner| px(corner)[axis]);
    all.into_iter().fold(f64::MIN, f64::max) - all.into_iter().fold(f64::MAX, f64::min)
}

/// The number with the fewest digits between two.
#[must_use]
pub fn simplest(a: f64, b: f64) -> f64 {
    let rounded = (0..9).map(|digits| {
        let unit = f64::from(10).powi(digits);
        ((a + b) / 2.0 * unit).round() / unit
    });
    let mut between = rounded.filter(|v| (a - v) * (b - v) <= 0.0);
    between.next().unwrap_or((a + b) / 2.0)
}

/// The ranges of sizes that hold the wrong ones of some triangles, and how they are said: all up to a limit, or all from one on.
fn ranges(triangles: &[(&Triangle, bool)]) -> Vec<(usize, [f64; 2], String)> {
    let mut all = Vec::new();
    for (number, (size, said)) in SIZES.into_iter().enumerate() {
        let of = |wrong: bool| {
            let some = triangles.iter().filter(move |(_, is_wrong)| *is_wrong == wrong);
            some.map(move |(t, _)| size(t))
        };
        let (Some(least), Some(most)) = (of(true).reduce(f64::min), of(true).reduce(f64::max))
        else {
            continue;
        };
        let said = |words: &str, limit: f64| said.replace("{}", &format!("{words} {limit}"));
        let above = of(false).filter(|size| *size > most).reduce(f64::min);
        if let Some(above) = above {
            let limit = simplest(most, above);
            all.push((number, [f64::MIN, limit], said("at most about", limit)));
        }
        let below = of(false).filter(|size| *size < least).reduce(f64::max);
        if let Some(below) = below {
            let limit = simplest(least, below);
            all.push((number, [limit, f64::MAX], said("at least about", limit)));
        }
    }
    all
}

impl ValueHypothesis {
    /// Depth and both attributes that it predicts at a pixel; nothing of moved corners without area.
    #[must_use]
    pub fn predict(&self, triangle: &Triangle, (x_px, y_px): (i32, i32)) -> Option<[f64; 3]> {
        let right = right_at(triangle, (x_px, y_px));
        let is_in = |(number, [from, to]): (usize, [f64; 2])| {
            (from..to).contains(&(SIZES[number].0)(triangle))
        };
        if !self.only.is_none_or(is_in) {
            return Some(right);
        }
        let mut changed = *triangle;
        if let Some((keep, bits)) = self.corner {
            for v in &mut changed.vertices {
                v.varying = DVec2::new(keep(v.varying.x, bits), keep(v.varying.y, bits));
            }
        }
        let triangle = &changed;
        let corners =
            triangle.corners().map(|p| SubpixelPoint::new((self.moved)(p.x), (self.moved)(p.y)));
        if twice_area(&corners) == 0 {
            return None;
        }
        let in_bits = |kept: Option<(Kept, i32)>| {
            move |v: f64| kept.map_or(v, |((keep, ..), bits)| keep(v, bits))
        };
        let values_of = |l: [f64; 3]| {
            let mut values = (self.values)(triangle, l).map(in_bits(self.kept));
            if let Some(((keep, ..), bits, is_w)) = self.divisor {
                let whole = sum(l, triangle.vertices.map(|v| v.inv_w));
                let w = if is_w { keep(1.0 / whole, bits) } else { 1.0 / keep(whole, bits) };
                let over_w = [0, 1, 2].map(|i| l[i] * triangle.vertices[i].inv_w * w);
                values = with(values[0], attributes(triangle, over_w));
            }
            if let Some(((keep, ..), bits, is_w)) = self.of_corners {
                let inverse = triangle.vertices.map(|v| match is_w {
                    true => 1.0 / keep(1.0 / v.inv_w, bits),
                    false => keep(v.inv_w, bits),
                });
                let whole = sum(l, inverse);
                let parts = [0, 1, 2].map(|i| l[i] * inverse[i] / whole);
                values = with(values[0], attributes(triangle, parts));
            }
            [0, 1, 2].map(|i| values[i] * self.scaled[i][0] + self.scaled[i][1])
        };
        let weights_at = |x: i32| {
            let at = [x, y_px];
            let at = match self.block {
                None => [0, 1].map(|i| f64::from(at[i]) + self.place[i]),
                Some((side, place)) => at.map(|v| f64::from(v / side * side) + place),
            };
            weights(&corners, at).map(in_bits(self.weights))
        };
        let at = |x: i32| values_of(weights_at(x));
        let first = |is_counted: bool| {
            let is_in = |x: i32| weights_at(x).iter().all(|weight| *weight >= 0.0);
            let outside = (0..x_px).rev().find(|&x| !is_in(x)).filter(|_| is_counted);
            outside.map_or(0, |x| x + 1)
        };
        let middle = f64::from(y_px) + 0.5;
        let row =
            || ends_of_row(weights(&corners, [0.0, middle]), weights(&corners, [1.0, middle]));
        let values = match self.along {
            Along::Pixels if self.unstepped == [false; 3] => at(x_px),
            Along::Pixels => {
                let [of_row, of_top, is_clipped] = self.unstepped;
                // From where the first sample should have been to where it is.
                let back = |start: f64| {
                    // A sample on the edge is the first one, whatever rounding makes of the edge.
                    let first = (start - 0.5 - NEAREST_MISS / 2.0).ceil();
                    (if is_clipped { first.max(0.0) } else { first }) + 0.5 - start
                };
                let top = corners.map(|corner| px(corner)[1]).into_iter().fold(f64::MAX, f64::min);
                let x = f64::from(x_px) + 0.5 - if of_row { back(row()[0].0) } else { 0.0 };
                values_of(weights(&corners, [x, middle - if of_top { back(top) } else { 0.0 }]))
            }
            Along::First => at(first(true)),
            Along::Steps(steps, from_first) => {
                let first = first(from_first);
                let start = first + (x_px - first) / steps * steps;
                let part = f64::from(x_px - start) / f64::from(steps);
                linear(at(x_px), at(start), at(start + steps), part)
            }
            Along::Edges => {
                let [left, right] = row();
                let end = |(x, opposite): (f64, usize)| {
                    let mut weights = weights(&corners, [x, middle]);
                    weights[opposite] = 0.0;
                    values_of(weights)
                };
                let part = (f64::from(x_px) + 0.5 - left.0) / (right.0 - left.0);
                linear(at(x_px), end(left), end(right), part)
            }
        };
        Some([0, 1, 2].map(|i| if self.parts[i] { values[i] } else { right[i] }))
    }
}

/// Values whose attributes are linear between two places.
fn linear(values: [f64; 3], from: [f64; 3], to: [f64; 3], part: f64) -> [f64; 3] {
    let between = |i: usize| from[i] + (to[i] - from[i]) * part;
    with(values[0], [between(1), between(2)])
}

/// Right values at a pixel and given ones.
#[must_use]
pub fn pixel_of(triangle: &Triangle, f: &Fragment<DVec2>) -> [[f64; 3]; 2] {
    [right_at(triangle, (f.x_px, f.y_px)), [f.depth, f.varying.x, f.varying.y]]
}

/// Right values at a pixel.
#[must_use]
pub fn right_at(triangle: &Triangle, (x_px, y_px): (i32, i32)) -> [f64; 3] {
    let at = [x_px, y_px].map(|v| f64::from(v) + 0.5);
    right_values(triangle, weights(&triangle.corners(), at))
}

/// Whether a prediction explains values, of a pixel each: it lies within ten times what is allowed, as predictions are rounded too,
/// and where the values are wrong it is much nearer to them than right ones are.
#[must_use]
pub fn are_explained(
    triangle: &Triangle,
    fragments: &mut dyn Iterator<Item = &Fragment<DVec2>>,
    predict: &dyn Fn((i32, i32)) -> Option<[f64; 3]>,
    allowed: &dyn Fn([f64; 3]) -> [f64; 3],
) -> bool {
    let (mut off, mut off_right) = (0.0_f64, 0.0_f64);
    for fragment in fragments {
        let pixel = (fragment.x_px, fragment.y_px);
        let Some(predicted) = predict(pixel) else { continue };
        let (right, allowed) = (right_at(triangle, pixel), allowed(predicted));
        let values = [fragment.depth, fragment.varying.x, fragment.varying.y];
        for i in 0..3 {
            let miss = |to: [f64; 3]| match values[i].is_finite() || to[i].is_finite() {
                true => (values[i] - to[i]).abs() / allowed[i],
                // A division by 0 may give anything but a number.
                false => 0.0,
            };
            let missed = miss(predicted);
            if missed > 10.0 || missed.is_nan() {
                return false;
            }
            off = off.max(missed);
            off_right = off_right.max(miss(right));
        }
    }
    off_right <= 1.0 || 2.0 * off <= off_right
}

/// Every mistake, from all corners, at all places, in all values or in some; and that values are scaled in such a way. The
/// limits of those that are in some triangles alone are read off `triangles`, of which it is known whether they are wrong.
#[must_use]
pub fn of_values(scaled: [[f64; 2]; 3], triangles: &[(&Triangle, bool)]) -> Vec<ValueHypothesis> {
    let mut all = Vec::new();
    let mut add = |mistake: &ValueMistake, does: String, of: ValueHypothesis| {
        let ValueMistake { name, repair, page, refuted, .. } = *mistake;
        let says = Explanation::new(name, does, repair, page, refuted);
        all.push(ValueHypothesis { says, ..of });
    };
    let nothing = || Explanation::new("", String::new(), "", "", "");
    let right = |parts| ValueHypothesis {
        says: nothing(),
        place: PLACES[0].0,
        moved: CORNERS[0].0,
        values: right_values,
        parts,
        kept: None,
        weights: None,
        divisor: None,
        of_corners: None,
        scaled: [[1.0, 0.0]; 3],
        block: None,
        along: Along::Pixels,
        corner: None,
        unstepped: [false; 3],
        only: None,
    };
    for (i, (moved, from)) in CORNERS.into_iter().enumerate() {
        for (k, (place, at)) in PLACES.into_iter().enumerate() {
            for mistake in VALUES {
                // Right values at the right place are no mistake.
                let is_mistake = i + k > 0 || mistake.name != ELSEWHERE;
                // In depth and attributes, in one attribute, or in depth alone.
                let parts = if SPLIT.contains(&mistake.name) { &PARTS[..] } else { &PARTS[..3] };
                for &(parts, said) in parts.iter().filter(|_| is_mistake) {
                    let does = format!("{}{at}{from}{said}", mistake.does);
                    let values = mistake.values;
                    add(mistake, does, ValueHypothesis { place, moved, values, ..right(parts) });
                }
            }
        }
    }
    for (kept, bits) in KEPT.iter().flat_map(|kept| kept.1.iter().map(move |bits| (*kept, *bits))) {
        let numbers = kept.2.replace("{}", &bits.to_string());
        for (parts, said) in PARTS {
            let does = format!("keeps values in {numbers}{said}");
            add(&FEW_BITS, does, ValueHypothesis { kept: Some((kept, bits)), ..right(parts) });
        }
        for (parts, said) in [PARTS[0], PARTS[3]] {
            let does = format!("keeps the weights of the corners in {numbers}{said}");
            add(&FEW_BITS, does, ValueHypothesis { weights: Some((kept, bits)), ..right(parts) });
        }
        for (is_w, what) in [(false, "1/w"), (true, "w")] {
            let does =
                format!("keeps {what} at a pixel in {numbers}, and divides attributes by that");
            let divisor = Some((kept, bits, is_w));
            add(&FEW_BITS, does, ValueHypothesis { divisor, ..right([true; 3]) });
            let does = format!("keeps {what} of corners in {numbers}");
            let of_corners = Some((kept, bits, is_w));
            add(&FEW_BITS, does, ValueHypothesis { of_corners, ..right([true; 3]) });
        }
    }
    for side in [2, 4, 8] {
        for (place, at) in [(0.5, "of its first pixel"), (f64::from(side) / 2.0, "at its middle")] {
            for (parts, said) in [PARTS[0], PARTS[3], PARTS[4]] {
                let does = format!(
                    "gives the pixels of a block of {side} x {side} px one value, that {at}{said}"
                );
                add(&BLOCKS, does, ValueHypothesis { block: Some((side, place)), ..right(parts) });
            }
        }
    }
    for (steps, from_first) in
        [(8, true), (8, false), (16, true), (16, false), (4, true), (4, false)]
    {
        let does = format!(
            "corrects attributes for perspective at every {steps}th pixel, counted from {}, and interpolates linearly between",
            if from_first { "the first one of the row" } else { "the left side of the window" }
        );
        let along = Along::Steps(steps, from_first);
        add(&STEPS, does, ValueHypothesis { along, ..right([true; 3]) });
    }
    let does = "corrects attributes for perspective along the edges, and interpolates linearly along the row between".to_owned();
    add(&STEPS, does, ValueHypothesis { along: Along::Edges, ..right([true; 3]) });
    for (of_row, of_top) in [(true, false), (false, true), (true, true)] {
        let first = match [of_row, of_top] {
            [true, false] => "gives the first sample of a row the values of the left edge",
            [false, true] => "gives the first row the values of the top corner's height",
            _ => {
                "gives the first row the values of the top corner's height, and the first sample of a row those of the left edge"
            }
        };
        for (is_clipped, clipped) in [(false, ""), (true, ", also where the window begins there")] {
            for (parts, said) in [PARTS[0], PARTS[3], PARTS[4]] {
                let unstepped = [of_row, of_top, is_clipped];
                let does = format!("{first}{clipped}{said}");
                add(&UNSTEPPED, does, ValueHypothesis { unstepped, ..right(parts) });
            }
        }
    }
    for (power, said) in [(22, "2.2"), (20, "2"), (-22, "1/2.2"), (-20, "1/2")] {
        for (parts, of) in PARTS.into_iter().skip(1).take(3) {
            let does = format!(
                "raises attributes of corners to the power of {said}, interpolates, and undoes that{of}"
            );
            let kept = Some(((powered as Keep, &[][..], ""), -power));
            let corner = Some((powered as Keep, power));
            add(&POWERS, does, ValueHypothesis { kept, corner, ..right(parts) });
        }
    }
    for (kept, bits) in KEPT.iter().flat_map(|kept| kept.1.iter().map(move |bits| (*kept, *bits))) {
        let numbers = kept.2.replace("{}", &bits.to_string());
        let does = format!("keeps the attributes of corners in {numbers}");
        add(&FEW_BITS, does, ValueHypothesis { corner: Some((kept.0, bits)), ..right([true; 3]) });
    }
    for (number, ends, said) in ranges(triangles) {
        let affine = &VALUES[0];
        let does = format!("{}, of triangles {said} alone", affine.does);
        let (values, only) = (affine.values, Some((number, ends)));
        add(affine, does, ValueHypothesis { values, only, ..right([true; 3]) });
    }
    let off: Vec<String> = ["depth", "the first attribute", "the second attribute"]
        .into_iter()
        .zip(scaled)
        .filter(|(_, by)| *by != [1.0, 0.0])
        .map(|(name, [by, plus])| match plus == 0.0 {
            true => format!("{by} x {name}"),
            false => format!("{by} x {name} {} {}", if plus < 0.0 { "-" } else { "+" }, plus.abs()),
        })
        .collect();
    if !off.is_empty() {
        let does = format!("gives {}", off.join(", "));
        add(&SCALED, does, ValueHypothesis { scaled, ..right([true; 3]) });
    }
    for (parts, said) in [PARTS[0], PARTS[3], PARTS[4]] {
        let does = format!("gives the pixels of a row the values of the first one{said}");
        add(&BLOCKS, does, ValueHypothesis { along: Along::First, ..right(parts) });
    }
    all
}

/// Mistakes in depth and attributes alike, which may be in either alone.
const SPLIT: [&str; 6] = [
    "values of one corner",
    "the mean of the corners",
    "values are clamped",
    "weights of other corners",
    "corners keep their places when they are exchanged",
    ELSEWHERE,
];
const ELSEWHERE: &str = "values at another place";
const FEW_BITS: ValueMistake = ValueMistake {
    name: "values in few bits",
    does: "",
    repair: "compute in floats of 32 bits, and shorten what is stored",
    page: "ch05",
    refuted: "a value between two such numbers",
    values: right_values,
};
const BLOCKS: ValueMistake = ValueMistake {
    name: "one value for several pixels",
    does: "",
    repair: "compute the values of each pixel",
    page: "ch05",
    refuted: "two pixels of a block with values of their own",
    values: right_values,
};
const SCALED: ValueMistake = ValueMistake {
    name: "values are scaled",
    does: "",
    repair: "leave values as the corners have them",
    page: "ch05",
    refuted: "a value that is given as it is",
    values: right_values,
};
const STEPS: ValueMistake = ValueMistake {
    name: "attributes linear in parts",
    does: "",
    repair: "divide at every pixel",
    page: "ch05",
    refuted: "a pixel between two of these with the attributes of its place",
    values: right_values,
};

const UNSTEPPED: ValueMistake = ValueMistake {
    name: "values without the first part of a step",
    does: "",
    repair: "move values from the edge to the first sample by the part of a pixel that lies between",
    page: "ch05",
    refuted: "a pixel away from such a corner or edge with the values of its sample",
    values: right_values,
};
const POWERS: ValueMistake = ValueMistake {
    name: "values in another space",
    does: "",
    repair: "interpolate attributes as they are given, and encode colours where they are stored",
    page: "ch05",
    refuted: "a pixel between corners of different attributes with right ones",
    values: right_values,
};

/// A power of a number that keeps its sign, in tenths; or such a root.
fn powered(v: f64, tenths: i32) -> f64 {
    let power = f64::from(tenths.abs()) / 10.0;
    let size = libm::pow(v.abs(), if tenths < 0 { 1.0 / power } else { power });
    if v < 0.0 { -size } else { size }
}

/// What right values are multiplied by, and what is added, as most of some pixels have it: a right value and the given one each.
#[must_use]
pub fn scaled(pixels: &[[[f64; 3]; 2]]) -> [[f64; 2]; 3] {
    [0, 1, 2].map(|k| {
        let near = |v: f64| (v * 1e4).round() / 1e4;
        let mut found: Vec<([f64; 2], usize)> = Vec::new();
        for pair in pixels.windows(2) {
            let [[x, y], [u, v]] = [&pair[0], &pair[1]].map(|[right, given]| [right[k], given[k]]);
            // Where all are small or far apart, digits are lost.
            if (x - u).abs() < 0.01 || [x, y, u, v].iter().any(|v| v.abs() > 100.0) {
                continue;
            }
            let by = (y - v) / (x - u);
            let fit = [near(by), near(y - by * x)];
            match found.iter_mut().find(|(known, _)| *known == fit) {
                Some((_, times)) => *times += 1,
                None => found.push((fit, 1)),
            }
        }
        let most = found.iter().max_by_key(|(_, times)| *times);
        let is_most = |(_, times): &&([f64; 2], usize)| 2 * times > found.iter().map(|f| f.1).sum();
        most.filter(is_most).map_or([1.0, 0.0], |(fit, _)| *fit)
    })
}

/// The families in which the mistakes differ.
pub const FAMILIES: &[&str] = &["w-100", "uniform", "w-extreme", "fan"];
/// Triangles that are asked for, of each family.
const TRIANGLES: u64 = 100;
/// The questions are the same in every run.
const SEED: u64 = 7;

/// The fragments of a triangle that an engine gives, each within the bounds of depth and both attributes or not.
pub type BoundedFragments = (Vec<Fragment<DVec2>>, [f64; 3], bool);

/// Why values are wrong; `ask` gives what is compared of a triangle, how far its values may be off, and whether they are wrong.
pub fn of_engine(mut ask: impl FnMut(&Triangle) -> Option<BoundedFragments>) -> Option<Mistakes> {
    let mut all: Vec<(Triangle, BoundedFragments)> = Vec::new();
    for family in cases::families().filter(|family| FAMILIES.contains(&family.name)) {
        for index in 0..TRIANGLES {
            let Shape::Triangles { list, .. } = family.case(SEED, index).shape else { continue };
            all.extend(list.iter().take(1).filter_map(|t| Some((*t, ask(t)?))));
        }
    }
    let is_wrong: Vec<bool> = all.iter().map(|(_, (.., is_wrong))| *is_wrong).collect();
    let all = &all;
    let pixels: Vec<_> = chosen_by(&is_wrong)
        .into_iter()
        .flat_map(|i| {
            let (triangle, (fragments, ..)) = &all[i];
            fragments.iter().take(2).map(move |f| pixel_of(triangle, f))
        })
        .collect();
    let hypothesis = |known: ValueHypothesis| Hypothesis {
        says: known.says.clone(),
        predicts: Box::new(move |i| {
            let (triangle, (fragments, bounds, _)) = &all[i];
            let allowed = |predicted: [f64; 3]| {
                [0, 1, 2].map(|i| bounds[i] + 6.4 * f64::EPSILON * predicted[i].abs())
            };
            let predict = |pixel| known.predict(triangle, pixel);
            are_explained(triangle, &mut fragments.iter(), &predict, &allowed)
        }),
    };
    let triangles: Vec<_> =
        chosen_by(&is_wrong).iter().map(|&i| (&all[i].0, is_wrong[i])).collect();
    of_answers(
        of_values(scaled(&pixels), &triangles).into_iter().map(hypothesis).collect(),
        &is_wrong,
    )
}
