//! Mistakes in values: what a wrong program makes of depth and attributes, from the weights of the corners at a place.

use glam::DVec2;

use super::{Explanation, Hypothesis, Mistakes, of_answers};
use crate::cases::{self, Shape, Triangle};
use crate::comparison::area2;
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

/// Twice the signed area in pixels squared.
fn twice_px(t: &Triangle) -> f64 {
    area2(&t.corners()) as f64 / f64::from(SUBPIXELS * SUBPIXELS)
}

const VALUES: &[ValueMistake] = &[
    ValueMistake {
        name: "attributes ignore w",
        does: "interpolates attributes linearly on the screen and ignores w (affine)",
        repair: "interpolate a/w and 1/w, and divide at every pixel",
        page: "ch05",
        refuted: "a triangle with unequal w whose attributes bend",
        values: |t, l| with(sum(l, depths(t)), attributes(t, l)),
    },
    ValueMistake {
        name: "depth as an attribute",
        does: "interpolates depth as an attribute, with the correction for perspective",
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
        does: "interpolates a/w and forgets to divide by the interpolated 1/w",
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
        does: "weights the corners by w where 1/w is right",
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
        does: "exchanges the weights of the second and the third corner of counterclockwise triangles",
        repair: "exchange the values with the corners",
        page: "ch05",
        refuted: "a counterclockwise triangle with right values",
        values: |t, [a, b, c]| {
            right_values(t, if area2(&t.corners()) < 0 { [a, c, b] } else { [a, b, c] })
        },
    },
    ValueMistake {
        name: "weights of a transposed matrix",
        does: "takes the weights from the transposed matrix",
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
        does: "does not divide depth by the area",
        repair: "divide the weighted sum by the area",
        page: "ch06",
        refuted: "a triangle of another area than 1 with right depths",
        values: |t, l| with(sum(l, depths(t)) * twice_px(t).abs(), attributes(t, corrected(t, l))),
    },
    ValueMistake {
        name: "depth not divided by the area",
        does: "does not divide depth by the signed area",
        repair: "divide the weighted sum by the area",
        page: "ch06",
        refuted: "a triangle of another area than 1 with right depths",
        values: |t, l| with(sum(l, depths(t)) * twice_px(t), attributes(t, corrected(t, l))),
    },
    ValueMistake {
        name: "depth divided by w again",
        does: "divides depth by w once more",
        repair: "depth is z/w already: interpolate it as it is",
        page: "ch06",
        refuted: "a corner with w other than 1 and right depths",
        values: |t, l| {
            let over_w = t.vertices.map(|v| v.depth * v.inv_w);
            with(sum(l, over_w), attributes(t, corrected(t, l)))
        },
    },
    ValueMistake {
        name: "values at another place",
        does: "computes right values",
        repair: "compute values where coverage is sampled",
        page: "ch05",
        refuted: "a pixel with the values of its sample",
        values: right_values,
    },
];

/// Where values may be taken in a pixel, and how that is said.
const PLACES: [([f64; 2], &str); 5] = [
    ([0.5, 0.5], ""),
    ([0.0, 0.0], ", at the upper left corner of the pixel"),
    ([1.0, 1.0], ", at the lower right corner of the pixel"),
    ([0.0, 0.5], ", at the left side of the pixel"),
    ([0.5, 0.0], ", at the upper side of the pixel"),
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
const CORNERS: [(Moved, &str); 3] = [
    (|v| v, ""),
    (|v| v.div_euclid(SUBPIXELS) * SUBPIXELS, ", from corners that are cut to whole pixels"),
    (
        |v| v.saturating_add(HALF_PIXEL).div_euclid(SUBPIXELS) * SUBPIXELS,
        ", from corners that are rounded to whole pixels",
    ),
];

/// A mistake at a place, from corners as they are or moved.
pub struct ValueHypothesis {
    /// What is said of it.
    pub says: Explanation,
    place: [f64; 2],
    moved: Moved,
    values: fn(&Triangle, [f64; 3]) -> [f64; 3],
}

impl ValueHypothesis {
    /// Depth and both attributes that it predicts at a pixel.
    #[must_use]
    pub fn predict(&self, triangle: &Triangle, (x_px, y_px): (i32, i32)) -> [f64; 3] {
        let corners =
            triangle.corners().map(|p| SubpixelPoint::new((self.moved)(p.x), (self.moved)(p.y)));
        let at = [f64::from(x_px) + self.place[0], f64::from(y_px) + self.place[1]];
        (self.values)(triangle, weights(&corners, at))
    }
}

/// Every mistake, from all corners, at all places.
#[must_use]
pub fn of_values() -> Vec<ValueHypothesis> {
    let mut all = Vec::new();
    for (moved, from) in CORNERS {
        for (place, at) in PLACES {
            for mistake in VALUES {
                let ValueMistake { name, does, repair, page, refuted, values } = *mistake;
                let says =
                    Explanation::new(name, format!("{does}{at}{from}"), repair, page, refuted);
                all.push(ValueHypothesis { says, place, moved, values });
            }
        }
    }
    all
}

/// The families in which the mistakes differ.
pub const FAMILIES: &[&str] = &["w-100", "uniform", "w-extreme", "fan"];
/// Triangles that are asked for, of each family.
const TRIANGLES: u64 = 100;
/// The questions are the same in every run.
const SEED: u64 = 7;

/// The fragments of a triangle that an engine gives, each within the bounds of depth and both attributes or not.
pub type Valued = (Vec<Fragment<DVec2>>, [f64; 3], bool);

/// Why values are wrong; `ask` gives what is compared of a triangle, how far its values may be off, and whether they are wrong.
pub fn of_engine(mut ask: impl FnMut(&Triangle) -> Option<Valued>) -> Option<Mistakes> {
    let mut all: Vec<(Triangle, Valued)> = Vec::new();
    for family in cases::families().filter(|family| FAMILIES.contains(&family.name)) {
        for index in 0..TRIANGLES {
            let Shape::Triangles { list, .. } = family.case(SEED, index).shape else { continue };
            all.extend(list.iter().take(1).filter_map(|t| Some((*t, ask(t)?))));
        }
    }
    let is_wrong: Vec<bool> = all.iter().map(|(_, (.., is_wrong))| *is_wrong).collect();
    let all = &all;
    let hypothesis = |known: ValueHypothesis| Hypothesis {
        says: known.says.clone(),
        predicts: Box::new(move |i| {
            let (triangle, (fragments, bounds, _)) = &all[i];
            fragments.iter().all(|f| {
                let predicted = known.predict(triangle, (f.x_px, f.y_px));
                let values = [f.depth, f.varying.x, f.varying.y];
                let near = |((value, predicted), bound): ((f64, f64), f64)| {
                    // Predictions are rounded too.
                    let rounding = 64.0 * f64::EPSILON * predicted.abs();
                    (value - predicted).abs() <= 10.0 * bound + rounding
                };
                values.into_iter().zip(predicted).zip(*bounds).all(near)
            })
        }),
    };
    of_answers(of_values().into_iter().map(hypothesis).collect(), &is_wrong)
}
