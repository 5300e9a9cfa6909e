//! Mistakes in values: what a wrong program makes of depth and attributes, from the weights of the corners at a place.
//!
//! # What is right
//!
//! Let l0, l1 and l2 be the weights of the corners at a place on the screen, which add up to 1. Depth is linear there:
//! l0 z0 + l1 z1 + l2 z2. An attribute a is linear on the surface, so that a/w and 1/w are linear on the screen:
//!
//! a = (l0 a0/w0 + l1 a1/w1 + l2 a2/w2) / (l0/w0 + l1/w1 + l2/w2).
//!
//! Halfway between a corner with w = 1 and a = 0 and one with w = 3 and a = 1 that is (1/2 x 1/3) / (1/2 x 1 + 1/2 x 1/3) = 1/4, where
//! a program that ignores w gives 1/2.

use glam::DVec2;

use super::{Explanation, Format, Hypothesis, MistakeId, Mistakes, chosen_by, of_answers};
use crate::cases::{self, Shape, Triangle};
use crate::convention::Rounding;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Fragment};

/// What is wrong with values, from the weights of the corners at a place.
/// Several entries may have one name: they are kinds of one mistake.
struct ValueMistake {
    name: &'static str,
    does: &'static str,
    /// What has to be changed in the program.
    repair: &'static str,
    /// The page that explains it, without `.md`.
    page: &'static str,
    /// An observation that would refute it.
    refuted: &'static str,
    /// Depth and both attributes.
    values: fn(&Triangle, [f64; 3]) -> [f64; 3],
}

/// The depths of the corners.
#[must_use]
pub fn depths(t: &Triangle) -> [f64; 3] {
    t.vertices.map_array(|v| v.depth)
}

/// 1/w of the corners.
fn inverse_w(t: &Triangle) -> [f64; 3] {
    t.vertices.map_array(|v| v.inv_w)
}

/// The weighted sum of three values.
#[must_use]
pub fn sum(weights: [f64; 3], values: [f64; 3]) -> f64 {
    weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2]
}

/// The products of each pair.
fn times(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// Weights in the same proportion that add up to 1.
fn in_proportion(parts: [f64; 3]) -> [f64; 3] {
    let whole: f64 = parts.iter().sum();
    parts.map_array(|part| part / whole)
}

/// The weights of a corner's value after the perspective is corrected.
fn corrected(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    in_proportion(times(weights, inverse_w(t)))
}

/// Both attributes by such weights of the corners.
fn attributes(t: &Triangle, weights: [f64; 3]) -> [f64; 2] {
    let [a, b, c] = t.vertices.map_array(|v| v.varying);
    [sum(weights, [a.x, b.x, c.x]), sum(weights, [a.y, b.y, c.y])]
}

/// Depth and both attributes, in the order in which values are compared.
fn with(depth: f64, [a, b]: [f64; 2]) -> [f64; 3] {
    [depth, a, b]
}

/// Depth is linear on the screen, and attributes are corrected for perspective.
fn right_values(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    with_depth(t, weights, sum(weights, depths(t)))
}

/// Another depth, with right attributes.
fn with_depth(t: &Triangle, weights: [f64; 3], depth: f64) -> [f64; 3] {
    with(depth, attributes(t, corrected(t, weights)))
}

/// The right depth, with attributes by other weights of the corners.
fn with_parts(t: &Triangle, weights: [f64; 3], parts: [f64; 3]) -> [f64; 3] {
    with(sum(weights, depths(t)), attributes(t, parts))
}

/// Right values, where two corners have exchanged their attributes.
fn with_exchanged_corners(t: &Triangle, weights: [f64; 3], i: usize, j: usize) -> [f64; 3] {
    let mut parts = corrected(t, weights);
    parts.swap(i, j);
    with_parts(t, weights, parts)
}

/// Attributes over w are multiplied by one number, which takes the place of w at the pixel.
fn by_one_w(t: &Triangle, weights: [f64; 3], w: f64) -> [f64; 3] {
    with_parts(t, weights, times(weights, inverse_w(t)).map_array(|part| part * w))
}

/// Twice the signed area in pixels squared.
fn twice_px(t: &Triangle) -> f64 {
    twice_area(&t.corners()) as f64 / f64::from(SUBPIXELS * SUBPIXELS)
}

/// Mistakes at the right place and from right corners; [`of_values`] combines them with others.
const VALUES: &[ValueMistake] = &[
    // A step of the same length on the screen is a longer step on a surface that is farther away.
    ValueMistake {
        name: "attributes ignore w",
        does: MistakeId::Affine.name(),
        repair: "interpolate a/w and 1/w, and divide at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w whose attributes bend",
        values: |t, l| with_parts(t, l, l),
    },
    // Depth z/w is divided by w already, so that it is linear on the screen.
    ValueMistake {
        name: "depth as an attribute",
        does: MistakeId::DepthInPerspective.name(),
        repair: "depth after the division by w is linear on the screen: interpolate it without correction",
        page: "ch06",
        refuted: "a triangle with unequal w whose depth is linear on the screen",
        values: |t, l| with_depth(t, l, sum(corrected(t, l), depths(t))),
    },
    // The two rules are known, and applied the wrong way round.
    ValueMistake {
        name: "depth and attributes exchanged",
        does: "corrects depth for perspective, and not the attributes",
        repair: "correct the attributes, and leave depth linear",
        page: "ch06",
        refuted: "a triangle with unequal w whose attributes bend",
        values: |t, l| with(sum(corrected(t, l), depths(t)), attributes(t, l)),
    },
    // a/w is interpolated rightly, and taken for a.
    ValueMistake {
        name: "not divided back",
        does: MistakeId::NotDividedBack.name(),
        repair: "divide by the interpolated 1/w at every pixel",
        page: "ch05",
        refuted: "a triangle with w other than 1 and right attributes",
        values: |t, l| with_parts(t, l, times(l, inverse_w(t))),
    },
    // Names such as `invW` and `w` are easily taken for each other.
    ValueMistake {
        name: "w in place of 1/w",
        does: MistakeId::WeightsByW.name(),
        repair: "weight the corners by 1/w",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| with_parts(t, l, in_proportion(over(l, inverse_w(t)))),
    },
    // Of w and 1/w only the latter is linear on the screen.
    ValueMistake {
        name: "w interpolated on the screen",
        does: "interpolates a/w and w linearly on the screen and multiplies them",
        repair: "interpolate 1/w, and divide by it at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| by_one_w(t, l, sum(l, over([1.0; 3], inverse_w(t)))),
    },
    // As where u and v are stored in the order v and u.
    ValueMistake {
        name: "attributes exchanged",
        does: "exchanges the two attributes",
        repair: "keep their order from the corners to the pixels",
        page: "ch05",
        refuted: "a pixel whose first attribute is right",
        values: exchanged_attributes,
    },
    // Flat shading, which some interfaces have as a mode.
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
    // One value for the whole triangle.
    ValueMistake {
        name: "the mean of the corners",
        does: "gives every pixel the mean of the corners",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: |t, _| with_parts(t, [1.0 / 3.0; 3], [1.0 / 3.0; 3]),
    },
    // Colours lie between 0 and 1, and texture coordinates need not.
    ValueMistake {
        name: "values are clamped",
        does: "clamps values to 0 to 1",
        repair: "clamp colours where they are stored, and nothing before",
        page: "ch05",
        refuted: "a value above 1",
        values: |t, l| right_values(t, l).map_array(|v| v.clamp(0.0, 1.0)),
    },
    // The w buffer of older hardware.
    ValueMistake {
        name: "w as depth",
        does: "gives w as depth",
        repair: "give z/w",
        page: "ch06",
        refuted: "a depth other than w",
        values: |t, l| with_depth(t, l, 1.0 / sum(l, inverse_w(t))),
    },
    // It is linear on the screen, as depth is, and grows where depth falls.
    ValueMistake {
        name: "1/w as depth",
        does: "gives 1/w as depth",
        repair: "give z/w",
        page: "ch06",
        refuted: "a depth other than 1/w",
        values: |t, l| with_depth(t, l, sum(l, inverse_w(t))),
    },
    // The weight of a corner is the area of the part opposite to it, which is easily given to a
    // neighbour.
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
    // To turn a triangle, programs exchange two corners and forget the values that belong to them.
    ValueMistake {
        name: "corners keep their places when they are exchanged",
        does: MistakeId::ExchangedWeights.name(),
        repair: "exchange the values with the corners",
        page: "ch05",
        refuted: "a counterclockwise triangle with right values",
        values: exchanged_weights,
    },
    // The matrix of the corners as rows in place of columns.
    ValueMistake {
        name: "weights of a transposed matrix",
        does: MistakeId::TransposedMatrix.name(),
        repair: "multiply the matrix with the corners as columns by the point",
        page: "ch02",
        refuted: "a pixel near a corner with its values",
        values: transposed_matrix,
    },
    // Edge functions are weights only after they are divided by their sum.
    ValueMistake {
        name: "depth not divided by the area",
        does: MistakeId::DepthNotDivided.name(),
        repair: "divide the weighted sum by the area",
        page: "ch06",
        refuted: "a triangle of another area than 1 with right depths",
        values: |t, l| with_depth(t, l, sum(l, depths(t)) * twice_px(t).abs()),
    },
    ValueMistake {
        name: "depth not divided by the area",
        does: MistakeId::DepthNotDividedBySign.name(),
        repair: "divide the weighted sum by the area",
        page: "ch06",
        refuted: "a triangle of another area than 1 with right depths",
        values: |t, l| with_depth(t, l, sum(l, depths(t)) * twice_px(t)),
    },
    // The vertex shader has divided already, or the rasterizer does it once more.
    ValueMistake {
        name: "depth divided by w again",
        does: MistakeId::DepthDividedTwice.name(),
        repair: "depth is z/w already: interpolate it as it is",
        page: "ch06",
        refuted: "a corner with w other than 1 and right depths",
        values: |t, l| with_depth(t, l, sum(l, times(depths(t), inverse_w(t)))),
    },
    // Right for a triangle that faces the camera.
    ValueMistake {
        name: "one w for a triangle",
        does: "divides attributes by the mean of 1/w for the whole triangle",
        repair: "divide by the interpolated 1/w at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: mean_of_inverse_w,
    },
    // Attributes are sorted with the corners, and w is not.
    ValueMistake {
        name: "attributes of other corners",
        does: "exchanges the attributes of the first and the second corner, and not their w",
        repair: "exchange all numbers of a corner",
        page: "ch05",
        refuted: "an attribute that is right at a corner",
        values: |t, l| with_exchanged_corners(t, l, 0, 1),
    },
    ValueMistake {
        name: "attributes of other corners",
        does: "exchanges the attributes of the second and the third corner, and not their w",
        repair: "exchange all numbers of a corner",
        page: "ch05",
        refuted: "an attribute that is right at a corner",
        values: |t, l| with_exchanged_corners(t, l, 1, 2),
    },
    ValueMistake {
        name: "attributes of other corners",
        does: "exchanges the attributes of the first and the third corner, and not their w",
        repair: "exchange all numbers of a corner",
        page: "ch05",
        refuted: "an attribute that is right at a corner",
        values: |t, l| with_exchanged_corners(t, l, 0, 2),
    },
    // A wrong index into the list of values.
    ValueMistake {
        name: "another value",
        does: "gives depth in place of the first attribute",
        repair: "keep depth and attributes apart",
        page: "ch05",
        refuted: "a pixel with its own attribute",
        values: depth_as_attribute,
    },
    // Perspective is corrected where it was corrected before.
    ValueMistake {
        name: "weights of w squared",
        does: "divides attributes by w twice, as where 1/w is divided by w once more",
        repair: "weight the corners by 1/w",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| with_parts(t, l, corrected_twice(t, l)),
    },
    ValueMistake {
        name: "values of one corner",
        does: "gives every pixel the attributes of the corner with the largest weight",
        repair: "interpolate between the corners",
        page: "ch05",
        refuted: "two pixels of a triangle with different values",
        values: nearest_corner,
    },
    // As `abs`, or an unsigned number, makes them.
    ValueMistake {
        name: "values without a sign",
        does: "loses the sign of attributes",
        repair: "leave attributes as they are: textures may begin below 0",
        page: "ch05",
        refuted: "a negative attribute",
        values: without_sign,
    },
    // z and w are alike in many projections, and are not the same.
    ValueMistake {
        name: "depth in place of w",
        does: "weights the corners by 1/z where 1/w is right",
        repair: "weight the corners by 1/w: z after the division by w is no distance",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| with_parts(t, l, in_proportion(over(l, depths(t)))),
    },
    ValueMistake {
        name: "one w for a triangle",
        does: "interpolates a/w and multiplies by the mean of w for the whole triangle",
        repair: "divide by the interpolated 1/w at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w and right attributes",
        values: |t, l| by_one_w(t, l, over([1.0; 3], inverse_w(t)).iter().sum::<f64>() / 3.0),
    },
    // A smooth fade, which is no interpolation.
    ValueMistake {
        name: "weights are squared",
        does: "squares the weights of the corners and divides them by their sum",
        repair: "use the weights as they are: they add up to 1",
        page: "ch02",
        refuted: "a pixel away from corners and middles with right values",
        values: |t, l| right_values(t, in_proportion(times(l, l))),
    },
    // It becomes a mistake only at another place, or from moved corners.
    ValueMistake {
        name: ELSEWHERE,
        does: "computes right values",
        repair: "compute values where coverage is sampled",
        page: "ch05",
        refuted: "a pixel with the values of its sample",
        values: right_values,
    },
];

/// The quotients of each pair.
fn over(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] / b[0], a[1] / b[1], a[2] / b[2]]
}

/// The second attribute in place of the first one, and the other way.
fn exchanged_attributes(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    let [depth, a, b] = right_values(t, weights);
    [depth, b, a]
}

/// The second and the third weight, where the corners turn the other way.
fn exchanged_weights(t: &Triangle, [a, b, c]: [f64; 3]) -> [f64; 3] {
    right_values(t, if twice_area(&t.corners()) < 0 { [a, c, b] } else { [a, b, c] })
}

/// The rows of the inverse matrix are what each weight is of x, y and 1. Such a program multiplies by its columns.
fn transposed_matrix(t: &Triangle, l: [f64; 3]) -> [f64; 3] {
    // A weight changes evenly along an axis, so that two places give its row.
    let corners = t.corners();
    let constant = weights(&corners, [0.0, 0.0]);
    let [x, y] = [weights(&corners, [1.0, 0.0]), weights(&corners, [0.0, 1.0])];
    let rows = [0, 1].map_array(|i: usize| [x[i] - constant[i], y[i] - constant[i], constant[i]]);
    let last = [x[2] - constant[2], y[2] - constant[2], constant[2]];
    // The sample in pixels.
    let [a, b, c] = corners.map_array(px);
    let point = [sum(l, [a[0], b[0], c[0]]), sum(l, [a[1], b[1], c[1]])];
    let mut parts = [0.0; 3];
    for (k, part) in parts.iter_mut().enumerate() {
        *part = rows[0][k] * point[0] + rows[1][k] * point[1] + last[k];
    }
    right_values(t, parts)
}

/// All pixels of a triangle are divided by the mean of 1/w.
fn mean_of_inverse_w(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    let mean = inverse_w(t).iter().sum::<f64>() / 3.0;
    with_parts(t, weights, times(weights, inverse_w(t)).map_array(|part| part / mean))
}

/// Depth in place of the first attribute.
fn depth_as_attribute(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    let [depth, _, second] = right_values(t, weights);
    [depth, depth, second]
}

/// Weights in proportion to 1/w squared.
fn corrected_twice(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    in_proportion(times(times(weights, inverse_w(t)), inverse_w(t)))
}

/// The attributes of the corner with the largest weight, and of several the first one.
fn nearest_corner(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    let mut most = 0;
    for i in 1..3 {
        if weights[i].total_cmp(&weights[most]).is_gt() {
            most = i;
        }
    }
    let mut one = [0.0; 3];
    one[most] = 1.0;
    with_parts(t, weights, one)
}

/// Attributes without their signs.
fn without_sign(t: &Triangle, weights: [f64; 3]) -> [f64; 3] {
    let [depth, a, b] = right_values(t, weights);
    [depth, a.abs(), b.abs()]
}

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

/// A point in pixels.
fn px(p: SubpixelPoint) -> [f64; 2] {
    [p.x, p.y].map_array(|v| f64::from(v) / f64::from(SUBPIXELS))
}

/// Twice the signed area of three points.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// The weights of the corners at a place, in pixels.
#[must_use]
pub fn weights(corners: &Corners, at: [f64; 2]) -> [f64; 3] {
    let [a, b, c] = corners.map_array(px);
    let area = cross(a, b, c);
    [cross(b, c, at), cross(c, a, at), cross(a, b, at)].map_array(|part| part / area)
}

/// What becomes of corners before the weights are computed: something is added, and they are cut down to a step.
#[derive(Clone, Copy)]
struct Moved {
    add: i32,
    step: i32,
}

impl Moved {
    /// Corners as they are.
    const NOT: Self = Self { add: 0, step: 1 };

    /// A coordinate of a moved corner.
    fn of(self, v: i32) -> i32 {
        v.saturating_add(self.add).div_euclid(self.step) * self.step
    }
}

/// All of these, and how they are said.
const CORNERS: [(Moved, &str); 5] = [
    (Moved::NOT, ""),
    (Moved { add: 0, step: 16 }, ", from corners that are cut to 1/16 px"),
    (Moved { add: 8, step: 16 }, ", from corners that are rounded to 1/16 px"),
    (Moved { add: 0, step: SUBPIXELS }, ", from corners that are cut to whole pixels"),
    (Moved { add: HALF_PIXEL, step: SUBPIXELS }, ", from corners that are rounded to whole pixels"),
];

/// Numbers with some bits in which something is kept, and how that is said.
struct Kind {
    of: fn(i32, Rounding) -> Format,
    rounding: Rounding,
    /// The likeliest first.
    bits: &'static [i32],
    said: &'static str,
}

/// Floats first, then numbers between 0 and 1, and fixed point.
const KINDS: [Kind; 7] = [
    Kind {
        of: Format::Float,
        rounding: Rounding::HalfAway,
        bits: FLOATS,
        said: "floats with {} bits after the first one, rounded",
    },
    Kind {
        of: Format::Float,
        rounding: Rounding::TowardZero,
        bits: FLOATS,
        said: "floats with {} bits after the first one, cut",
    },
    Kind {
        of: Format::Unit,
        rounding: Rounding::HalfAway,
        bits: UNITS,
        said: "{} bits between 0 and 1, rounded",
    },
    Kind {
        of: Format::Unit,
        rounding: Rounding::Down,
        bits: UNITS,
        said: "{} bits between 0 and 1, cut down",
    },
    Kind {
        of: Format::Fixed,
        rounding: Rounding::Down,
        bits: STEPS_OF,
        said: "whole numbers and {} bits of fraction, cut down",
    },
    Kind {
        of: Format::Fixed,
        rounding: Rounding::TowardZero,
        bits: STEPS_OF,
        said: "whole numbers and {} bits of fraction, cut toward zero",
    },
    Kind {
        of: Format::Fixed,
        rounding: Rounding::HalfAway,
        bits: STEPS_OF,
        said: "whole numbers and {} bits of fraction, rounded",
    },
];
/// Bits of floats of 16 bits, of those with the exponent of one of 32 bits, and of others.
const FLOATS: &[i32] = &[10, 7, 5, 8, 12, 16];
/// Bits between 0 and 1, of which 8 are the most usual.
const UNITS: &[i32] = &[8, 4, 5, 6, 7, 10, 12, 16];
/// Bits of fraction in fixed point.
const STEPS_OF: &[i32] = &[8, 0, 2, 4, 6, 10, 12, 16];

/// All numbers in which something may be kept, with what is said of them.
fn formats() -> Vec<(Format, String)> {
    let mut all = Vec::new();
    for Kind { of, rounding, bits, said } in KINDS {
        for &bits in bits {
            all.push((of(bits, rounding), said.replace("{}", &bits.to_string())));
        }
    }
    for format in [Format::Wrapped(1), Format::Half] {
        all.push((format, format.to_string()));
    }
    all
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
    /// Where in a pixel values are taken, in pixels.
    place: [f64; 2],
    moved: Moved,
    values: fn(&Triangle, [f64; 3]) -> [f64; 3],
    /// Which values it is in: depth, and both attributes.
    parts: [bool; 3],
    /// Numbers in which values are kept, the weights of the corners, and the attributes of the corners.
    kept: Format,
    weights: Format,
    corner: Format,
    /// The power, in tenths, to which attributes of corners are raised, and values are brought back from.
    power: Option<i32>,
    /// Numbers in which 1/w is kept at a pixel, or w, by which attributes are multiplied.
    divisor: Option<KeptW>,
    /// The same at the corners.
    of_corners: Option<KeptW>,
    /// What becomes of each right value: it is multiplied, and something is added.
    scaled: [[f64; 2]; 3],
    block: Option<Block>,
    /// What is computed at each pixel of a row, and what is interpolated between.
    along: Along,
    unstepped: Unstepped,
    /// The triangles that it is in; the others are right.
    only: Option<SizeRange>,
}

/// Numbers in which w is kept, or else 1/w.
#[derive(Clone, Copy)]
struct KeptW {
    format: Format,
    is_w: bool,
}

/// Pixels of a block that have one value, and the place in the block where it is right.
#[derive(Clone, Copy)]
struct Block {
    /// In pixels.
    side: i32,
    place: f64,
}

/// Which first steps are left out.
#[derive(Clone, Copy, Default, PartialEq)]
struct Unstepped {
    /// The first sample of a row has the values of the left edge.
    of_row: bool,
    /// The first row has the values of the top corner.
    of_top: bool,
    /// The first ones are those in the window.
    is_clipped: bool,
}

/// Triangles whose size lies in a range, by a number of [`SIZES`].
#[derive(Clone, Copy)]
struct SizeRange {
    number: usize,
    from: f64,
    to: f64,
}

impl SizeRange {
    /// Whether the size of a triangle lies in it.
    fn holds(self, t: &Triangle) -> bool {
        (self.from..self.to).contains(&(SIZES[self.number].0)(t))
    }
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

type Size = fn(&Triangle) -> f64;
/// By what triangles may be told of which attributes are not corrected.
const SIZES: [(Size, &str); 4] = [
    (ratio_of_w, "whose largest w is {} times the smallest one"),
    (|t| twice_px(t).abs() / 2.0, "whose area is {} square pixels"),
    (|t| extent(t, 0), "whose width is {} px"),
    (|t| extent(t, 1), "whose height is {} px"),
];

/// How many times as far away the farthest corner is as the nearest one.
fn ratio_of_w(t: &Triangle) -> f64 {
    let [least, most] = ends_of(inverse_w(t));
    most / least
}

/// The width or the height of a triangle, in pixels.
fn extent(t: &Triangle, axis: usize) -> f64 {
    let [least, most] = ends_of(t.corners().map_array(|corner| px(corner)[axis]));
    most - least
}

/// The least of three numbers and the largest.
fn ends_of([a, b, c]: [f64; 3]) -> [f64; 2] {
    [f64::MAX.min(a).min(b).min(c), f64::MIN.max(a).max(b).max(c)]
}

/// The number with the fewest digits between two.
#[must_use]
pub fn simplest(a: f64, b: f64) -> f64 {
    for digits in 0..9 {
        let unit = f64::from(10).powi(digits);
        let rounded = ((a + b) / 2.0 * unit).round() / unit;
        if (a - rounded) * (b - rounded) <= 0.0 {
            return rounded;
        }
    }
    (a + b) / 2.0
}

/// The ranges of sizes that hold the wrong ones of some triangles, and how they are said: all up to a limit, or all from one on.
fn ranges(triangles: &[(&Triangle, bool)]) -> Vec<(SizeRange, String)> {
    let mut all = Vec::new();
    for (number, (size, said)) in SIZES.into_iter().enumerate() {
        // The sizes of the wrong triangles, from the least to the largest.
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for (t, _) in triangles.iter().filter(|(_, is_wrong)| *is_wrong) {
            (least, most) = (least.min(size(t)), most.max(size(t)));
        }
        if least > most {
            continue;
        }
        // The right ones next to them.
        let (mut below, mut above) = (None, None);
        for (t, _) in triangles.iter().filter(|(_, is_wrong)| !is_wrong) {
            let size = size(t);
            if size > most {
                above = Some(above.map_or(size, |next: f64| next.min(size)));
            } else if size < least {
                below = Some(below.map_or(size, |next: f64| next.max(size)));
            }
        }
        if let Some(above) = above {
            let to = simplest(most, above);
            let said = said.replace("{}", &format!("at most about {to}"));
            all.push((SizeRange { number, from: f64::MIN, to }, said));
        }
        if let Some(below) = below {
            let from = simplest(least, below);
            let said = said.replace("{}", &format!("at least about {from}"));
            all.push((SizeRange { number, from, to: f64::MAX }, said));
        }
    }
    all
}

impl ValueHypothesis {
    /// A mistake in some values that has nothing else wrong.
    fn plain(says: Explanation, parts: [bool; 3]) -> Self {
        Self {
            says,
            // Everything as a right program has it.
            place: PLACES[0].0,
            moved: Moved::NOT,
            values: right_values,
            parts,
            kept: Format::Exact,
            weights: Format::Exact,
            corner: Format::Exact,
            power: None,
            divisor: None,
            of_corners: None,
            scaled: [[1.0, 0.0]; 3],
            block: None,
            along: Along::Pixels,
            unstepped: Unstepped::default(),
            only: None,
        }
    }

    /// Depth and both attributes that it predicts at a pixel; nothing of moved corners without area.
    #[must_use]
    pub fn predict(&self, triangle: &Triangle, (x_px, y_px): (i32, i32)) -> Option<[f64; 3]> {
        let right = right_at(triangle, (x_px, y_px));
        if self.only.is_some_and(|range| !range.holds(triangle)) {
            return Some(right);
        }
        // The triangle as the program has it: with changed attributes, and from moved corners.
        let mut triangle = *triangle;
        for v in &mut triangle.vertices {
            v.varying = DVec2::new(self.at_corner(v.varying.x), self.at_corner(v.varying.y));
        }
        let moved = |p: SubpixelPoint| SubpixelPoint::new(self.moved.of(p.x), self.moved.of(p.y));
        let corners = triangle.corners().map_array(moved);
        if twice_area(&corners) == 0 {
            return None;
        }
        // What is computed at a pixel, or interpolated along the row.
        let row = RowOfPixels { how: self, triangle, corners, y_px };
        let values = match self.along {
            Along::Pixels if self.unstepped == Unstepped::default() => row.at(x_px),
            Along::Pixels => row.unstepped(x_px),
            Along::First => row.at(row.first(x_px)),
            Along::Steps(steps, from_first) => {
                let first = if from_first { row.first(x_px) } else { 0 };
                let start = first + (x_px - first) / steps * steps;
                let part = f64::from(x_px - start) / f64::from(steps);
                linear(row.at(x_px), row.at(start), row.at(start + steps), part)
            }
            Along::Edges => {
                let [left, right] = row.edges();
                let part = (f64::from(x_px) + 0.5 - left.x) / (right.x - left.x);
                linear(row.at(x_px), row.on_edge(left), row.on_edge(right), part)
            }
        };
        // The other values are right.
        Some([0, 1, 2].map_array(|i: usize| if self.parts[i] { values[i] } else { right[i] }))
    }

    /// What becomes of an attribute of a corner.
    fn at_corner(&self, v: f64) -> f64 {
        let kept = self.corner.of(v);
        self.power.map_or(kept, |power| powered(kept, power))
    }

    /// What becomes of a value at a pixel.
    fn at_pixel(&self, v: f64) -> f64 {
        let kept = self.kept.of(v);
        self.power.map_or(kept, |power| powered(kept, -power))
    }
}

/// Pixels of a row, whose values a hypothesis predicts.
struct RowOfPixels<'a> {
    how: &'a ValueHypothesis,
    /// With what becomes of the attributes of its corners.
    triangle: Triangle,
    /// Where the corners are taken to be.
    corners: Corners,
    y_px: i32,
}

/// Where a row begins or ends.
#[derive(Clone, Copy)]
struct EndOfRow {
    x: f64,
    /// The corner whose weight is 0 there.
    opposite: usize,
}

impl RowOfPixels<'_> {
    /// The height of the samples of the row.
    fn middle(&self) -> f64 {
        f64::from(self.y_px) + 0.5
    }

    /// The weights of the corners at a pixel.
    fn weights(&self, x_px: i32) -> [f64; 3] {
        let at = [x_px, self.y_px];
        let at = match self.how.block {
            None => {
                let [x, y] = self.how.place;
                [f64::from(at[0]) + x, f64::from(at[1]) + y]
            }
            Some(Block { side, place }) => at.map_array(|v| f64::from(v / side * side) + place),
        };
        weights(&self.corners, at).map_array(|weight| self.how.weights.of(weight))
    }

    /// The values of a pixel by its own weights.
    fn at(&self, x_px: i32) -> [f64; 3] {
        self.of_weights(self.weights(x_px))
    }

    /// Values by weights of the corners, with all that becomes of them.
    fn of_weights(&self, l: [f64; 3]) -> [f64; 3] {
        let Self { how, triangle, .. } = self;
        let inverse = inverse_w(triangle);
        let mut values = (how.values)(triangle, l).map_array(|v| how.at_pixel(v));
        // Attributes once more, with a rounded 1/w or w at the pixel.
        if let Some(KeptW { format, is_w }) = how.divisor {
            let whole = sum(l, inverse);
            let w = if is_w { format.of(1.0 / whole) } else { 1.0 / format.of(whole) };
            let parts = times(l, inverse).map_array(|part| part * w);
            values = with(values[0], attributes(triangle, parts));
        }
        // The same with a rounded 1/w or w of each corner.
        if let Some(KeptW { format, is_w }) = how.of_corners {
            let inverse = inverse.map_array(|v| match is_w {
                true => 1.0 / format.of(1.0 / v),
                false => format.of(v),
            });
            let whole = sum(l, inverse);
            let parts = times(l, inverse).map_array(|part| part / whole);
            values = with(values[0], attributes(triangle, parts));
        }
        // Last of all, values are scaled.
        for (value, [by, plus]) in values.iter_mut().zip(how.scaled) {
            *value = *value * by + plus;
        }
        values
    }

    /// The first pixel, on the way back from this one, before one whose place lies outside.
    fn first(&self, x_px: i32) -> i32 {
        let is_in = |x: i32| self.weights(x).iter().all(|weight| *weight >= 0.0);
        let mut first = x_px;
        while first > 0 && is_in(first - 1) {
            first -= 1;
        }
        first
    }

    /// Where the part of the row begins and ends of which no weight is negative.
    fn edges(&self) -> [EndOfRow; 2] {
        let at_0 = weights(&self.corners, [0.0, self.middle()]);
        let at_1 = weights(&self.corners, [1.0, self.middle()]);
        let mut left = EndOfRow { x: f64::MIN, opposite: 0 };
        let mut right = EndOfRow { x: f64::MAX, opposite: 0 };
        for opposite in 0..3 {
            // A weight changes evenly along the row.
            let change = at_1[opposite] - at_0[opposite];
            let x = -at_0[opposite] / change;
            if change > 0.0 && x > left.x {
                left = EndOfRow { x, opposite };
            } else if change < 0.0 && x < right.x {
                right = EndOfRow { x, opposite };
            }
        }
        [left, right]
    }

    /// The values at an end of the row: a rounded weight there is 0 all the same.
    fn on_edge(&self, end: EndOfRow) -> [f64; 3] {
        let mut weights = weights(&self.corners, [end.x, self.middle()]);
        weights[end.opposite] = 0.0;
        self.of_weights(weights)
    }

    /// Values whose first steps, from an edge or from the top corner to a sample, are left out.
    fn unstepped(&self, x_px: i32) -> [f64; 3] {
        let Unstepped { of_row, of_top, is_clipped } = self.how.unstepped;
        // From where the first sample should have been to where it is.
        let back = |start: f64| {
            // A sample on the edge is the first one, whatever rounding makes of the edge.
            let first = (start - 0.5 - NEAREST_MISS / 2.0).ceil();
            (if is_clipped { first.max(0.0) } else { first }) + 0.5 - start
        };
        let [top, _] = ends_of(self.corners.map_array(|corner| px(corner)[1]));
        let x = f64::from(x_px) + 0.5 - if of_row { back(self.edges()[0].x) } else { 0.0 };
        let y = self.middle() - if of_top { back(top) } else { 0.0 };
        self.of_weights(weights(&self.corners, [x, y]))
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
    let at = [f64::from(x_px) + 0.5, f64::from(y_px) + 0.5];
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
        // Each value is compared as a multiple of what it may be off by.
        let values = [fragment.depth, fragment.varying.x, fragment.varying.y];
        for i in 0..3 {
            let missed = miss(values[i], predicted[i], allowed[i]);
            if missed > 10.0 || missed.is_nan() {
                return false;
            }
            off = off.max(missed);
            off_right = off_right.max(miss(values[i], right[i], allowed[i]));
        }
    }
    off_right <= 1.0 || 2.0 * off <= off_right
}

/// How far a value is from another one, as a multiple of what is allowed.
fn miss(value: f64, to: f64, allowed: f64) -> f64 {
    match value.is_finite() || to.is_finite() {
        true => (value - to).abs() / allowed,
        // A division by 0 may give anything but a number.
        false => 0.0,
    }
}

/// Every mistake, from all corners, at all places, in all values or in some; and that values are scaled in such a way. The
/// limits of those that are in some triangles alone are read off `triangles`, of which it is known whether they are wrong.
#[must_use]
pub fn of_values(scaled: [[f64; 2]; 3], triangles: &[(&Triangle, bool)]) -> Vec<ValueHypothesis> {
    let mut all = Hypotheses(Vec::new());
    // What comes first is named where several explain the same.
    all.in_all_values();
    all.in_few_bits();
    all.in_blocks();
    all.along_rows();
    all.unstepped();
    all.in_another_space();
    for (corner, said) in formats() {
        let does = format!("keeps the attributes of corners in {said}");
        all.add(&FEW_BITS, does, [true; 3]).corner = corner;
    }
    for (only, said) in ranges(triangles) {
        let affine = &VALUES[0];
        let one = all.add(affine, format!("{}, of triangles {said} alone", affine.does), [true; 3]);
        (one.values, one.only) = (affine.values, Some(only));
    }
    all.scaled(scaled);
    for (parts, said) in [PARTS[0], PARTS[3], PARTS[4]] {
        let does = format!("gives the pixels of a row the values of the first one{said}");
        all.add(&BLOCKS, does, parts).along = Along::First;
    }
    all.0
}

/// Mistakes in values, in the order in which they are tried.
struct Hypotheses(Vec<ValueHypothesis>);

impl Hypotheses {
    /// Adds a mistake in some values; what is wrong with them is set afterwards.
    fn add(&mut self, of: &ValueMistake, does: String, parts: [bool; 3]) -> &mut ValueHypothesis {
        let says = Explanation::new(of.name, does, of.repair, of.page, of.refuted);
        self.0.push(ValueHypothesis::plain(says, parts));
        let last = self.0.len() - 1;
        &mut self.0[last]
    }

    /// Those of the table, from all corners and at all places.
    fn in_all_values(&mut self) {
        for (i, (moved, from)) in CORNERS.into_iter().enumerate() {
            for (k, (place, at)) in PLACES.into_iter().enumerate() {
                for mistake in VALUES {
                    // Right values at the right place are no mistake.
                    if i + k == 0 && mistake.name == ELSEWHERE {
                        continue;
                    }
                    // In depth and attributes, in one attribute, or in depth alone.
                    let count = if SPLIT.contains(&mistake.name) { PARTS.len() } else { 3 };
                    for (parts, said) in PARTS.into_iter().take(count) {
                        let does = format!("{}{at}{from}{said}", mistake.does);
                        let one = self.add(mistake, does, parts);
                        (one.place, one.moved, one.values) = (place, moved, mistake.values);
                    }
                }
            }
        }
    }

    /// Values, weights of the corners, 1/w or w in short numbers.
    fn in_few_bits(&mut self) {
        for (format, numbers) in formats() {
            // Values may be short in one of three, and weights change all or the attributes.
            for (parts, said) in PARTS {
                self.add(&FEW_BITS, format!("keeps values in {numbers}{said}"), parts).kept =
                    format;
            }
            for (parts, said) in [PARTS[0], PARTS[3]] {
                let does = format!("keeps the weights of the corners in {numbers}{said}");
                self.add(&FEW_BITS, does, parts).weights = format;
            }
            for (is_w, what) in [(false, "1/w"), (true, "w")] {
                let kept = Some(KeptW { format, is_w });
                let does =
                    format!("keeps {what} at a pixel in {numbers}, and divides attributes by that");
                self.add(&FEW_BITS, does, [true; 3]).divisor = kept;
                let does = format!("keeps {what} of corners in {numbers}");
                self.add(&FEW_BITS, does, [true; 3]).of_corners = kept;
            }
        }
    }

    /// One value for all pixels of a block.
    fn in_blocks(&mut self) {
        for side in [2, 4, 8] {
            // One sample for a block: coarse shading.
            let middle = f64::from(side) / 2.0;
            for (place, at) in [(0.5, "of its first pixel"), (middle, "at its middle")] {
                for (parts, said) in [PARTS[0], PARTS[3], PARTS[4]] {
                    let does = format!(
                        "gives the pixels of a block of {side} x {side} px one value, that {at}{said}"
                    );
                    self.add(&BLOCKS, does, parts).block = Some(Block { side, place });
                }
            }
        }
    }

    /// Attributes that are linear between pixels or edges.
    fn along_rows(&mut self) {
        // The division is slow, so that programs do it for every 8th or 16th pixel.
        for steps in [8, 16, 4] {
            for (from_first, from) in
                [(true, "the first one of the row"), (false, "the left side of the window")]
            {
                let does = format!(
                    "corrects attributes for perspective at every {steps}th pixel, counted from {from}, and interpolates linearly between"
                );
                self.add(&STEPS, does, [true; 3]).along = Along::Steps(steps, from_first);
            }
        }
        let does = "corrects attributes for perspective along the edges, and interpolates linearly along the row between".to_owned();
        self.add(&STEPS, does, [true; 3]).along = Along::Edges;
    }

    /// First samples without the part of a step before them.
    fn unstepped(&mut self) {
        // Whether the row, the column or both begin without their first part of a step.
        let ways = [
            (true, false, "gives the first sample of a row the values of the left edge"),
            (false, true, "gives the first row the values of the top corner's height"),
            (
                true,
                true,
                "gives the first row the values of the top corner's height, and the first sample of a row those of the left edge",
            ),
        ];
        for (of_row, of_top, first) in ways {
            for (is_clipped, clipped) in
                [(false, ""), (true, ", also where the window begins there")]
            {
                for (parts, said) in [PARTS[0], PARTS[3], PARTS[4]] {
                    let does = format!("{first}{clipped}{said}");
                    self.add(&UNSTEPPED, does, parts).unstepped =
                        Unstepped { of_row, of_top, is_clipped };
                }
            }
        }
    }

    /// Attributes that are raised to a power before they are interpolated.
    fn in_another_space(&mut self) {
        for (power, said) in [(22, "2.2"), (20, "2"), (-22, "1/2.2"), (-20, "1/2")] {
            for (parts, of) in [PARTS[1], PARTS[2], PARTS[3]] {
                let does = format!(
                    "raises attributes of corners to the power of {said}, interpolates, and undoes that{of}"
                );
                self.add(&POWERS, does, parts).power = Some(power);
            }
        }
    }

    /// Values that are multiplied by a number, and to which another one is added.
    fn scaled(&mut self, scaled: [[f64; 2]; 3]) {
        let mut off = Vec::new();
        for (name, by) in
            ["depth", "the first attribute", "the second attribute"].into_iter().zip(scaled)
        {
            // Values that are as they should be are not said.
            match by {
                [1.0, 0.0] => {}
                [by, 0.0] => off.push(format!("{by} x {name}")),
                [by, plus] => {
                    let sign = if plus < 0.0 { "-" } else { "+" };
                    off.push(format!("{by} x {name} {sign} {}", plus.abs()));
                }
            }
        }
        if !off.is_empty() {
            self.add(&SCALED, format!("gives {}", off.join(", ")), [true; 3]).scaled = scaled;
        }
    }
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
/// The name of the mistake that is right but for its place.
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
    [0, 1, 2].map_array(|k| scale_of(pixels, k))
}

/// The same of one value.
fn scale_of(pixels: &[[[f64; 3]; 2]], k: usize) -> [f64; 2] {
    // Four digits tell scales apart that a program would use.
    let near = |v: f64| (v * 1e4).round() / 1e4;
    // Each scale, with the pairs of pixels that have it.
    let mut found: Vec<([f64; 2], usize)> = Vec::new();
    let mut all = 0;
    for pair in pixels.windows(2) {
        let ([x, u], [y, v]) = ([pair[0][0][k], pair[1][0][k]], [pair[0][1][k], pair[1][1][k]]);
        // Where all are small or far apart, digits are lost.
        if (x - u).abs() < 0.01 || [x, y, u, v].iter().any(|v| v.abs() > 100.0) {
            continue;
        }
        all += 1;
        // Two pixels give both unknowns of y = by x + plus.
        let by = (y - v) / (x - u);
        let fit = [near(by), near(y - by * x)];
        match found.iter_mut().find(|(known, _)| *known == fit) {
            Some((_, times)) => *times += 1,
            None => found.push((fit, 1)),
        }
    }
    // More than half of all pairs, so that there is one at most.
    let most = found.into_iter().find(|(_, times)| 2 * times > all);
    most.map_or([1.0, 0.0], |(fit, _)| fit)
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
    // The questions, with what the engine gave.
    let mut all: Vec<(Triangle, BoundedFragments)> = Vec::new();
    for family in cases::families().filter(|family| FAMILIES.contains(&family.name)) {
        for index in 0..TRIANGLES {
            let Shape::Triangles { list, .. } = family.case(SEED, index).shape else { continue };
            all.extend(list.iter().take(1).filter_map(|t| Some((*t, ask(t)?))));
        }
    }
    let is_wrong: Vec<bool> = all.iter().map(|(_, (.., is_wrong))| *is_wrong).collect();
    let all = &all;
    // What is read off the answers is read off those by which hypotheses are chosen.
    let (mut pixels, mut triangles) = (Vec::new(), Vec::new());
    // Of each triangle, a few pixels are enough to see a scale.
    for i in chosen_by(&is_wrong) {
        let (triangle, (fragments, ..)) = &all[i];
        for fragment in fragments.iter().take(2) {
            pixels.push(pixel_of(triangle, fragment));
        }
        // All of these triangles, from which limits of size are read off.
        triangles.push((triangle, is_wrong[i]));
    }
    let mut hypotheses = Vec::new();
    for known in of_values(scaled(&pixels), &triangles) {
        let says = known.says.clone();
        let predicts = move |i: usize| {
            let (triangle, (fragments, bounds, _)) = &all[i];
            let allowed = |predicted: [f64; 3]| {
                [0, 1, 2].map_array(|k: usize| bounds[k] + 6.4 * f64::EPSILON * predicted[k].abs())
            };
            let predict = |pixel| known.predict(triangle, pixel);
            are_explained(triangle, &mut fragments.iter(), &predict, &allowed)
        };
        hypotheses.push(Hypothesis { says, predicts: Box::new(predicts) });
    }
    of_answers(hypotheses, &is_wrong)
}
