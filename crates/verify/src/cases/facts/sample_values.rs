//! Facts of a question about the values of the samples of a triangle: which samples of a pixel it covers, and how its values
//! differ between its corners.

use super::samples::{self, PIXELS, SampleFacts, WHICH};
use super::triangles::{BITS, PX, WINDING};
use super::values::{self, KINDS, SIZE, ValueFacts};
use super::{Read, Test, Topic, Unit, fact, facts_of, numbers};
use crate::cases::{Case, Limits};

/// Triangles with values at four samples a pixel.
pub const TOPIC: Topic = Topic {
    name: "sample-value-design",
    facts: &facts_of(&FACTS),
    measure: |case, limits| Some(numbers(&FACTS, &SampleValueFacts::of_case(case, limits)?)),
    impossible: include_str!("impossible/sample-value-design.txt"),
    draw: |rng| {
        let case = values::draw(rng);
        samples::fitted(rng, case)
    },
    vary: |rng, one, other| {
        let case = values::vary(rng, one, other);
        samples::fitted(rng, case)
    },
    put: Limits::put,
};

const EXTENT: Test = Test::Steps(&[PX, 8 * PX, 64 * PX, 4096 * PX]);
const SIDES: Test = Test::Steps(&[2, 3, 9]);

/// The facts that the design covers.
const FACTS: [Read<SampleValueFacts>; 21] = [
    fact("its winding", Unit::Count, |m| m.values.form.turn + 1, WINDING),
    fact("its width", Unit::Subpixels, |m| m.values.form.size[0], EXTENT),
    fact("its height", Unit::Subpixels, |m| m.values.form.size[1], EXTENT),
    fact("the bits of its columns below the pixel", Unit::Count, |m| m.values.form.bits[0], BITS),
    fact("the bits of its rows below the pixel", Unit::Count, |m| m.values.form.bits[1], BITS),
    fact(
        "corners inside the window",
        Unit::Count,
        |m| m.values.form.inside,
        Test::Steps(&[1, 2, 3]),
    ),
    fact("the width of the window", Unit::Pixels, |m| m.values.form.window[0], SIDES),
    fact("the height of the window", Unit::Pixels, |m| m.values.form.window[1], SIDES),
    fact(
        "the width of the window in pixels",
        Unit::Count,
        |m| m.values.form.window[0],
        Test::Divisor,
    ),
    fact("pixels with all four samples in it", Unit::Count, |m| m.samples.whole, PIXELS),
    fact("pixels with some of their samples in it", Unit::Count, |m| m.samples.partly, PIXELS),
    fact(
        "pixels with a sample in it and not the centre",
        Unit::Count,
        |m| m.samples.without_centre,
        PIXELS,
    ),
    fact(
        "the first sample in it of a pixel whose centre is not",
        Unit::Count,
        |m| m.samples.first,
        WHICH,
    ),
    fact("the sample that lies on an edge", Unit::Count, |m| m.samples.on_edge, WHICH),
    fact(
        "the largest w, as a multiple of the smallest,",
        Unit::Doublings,
        |m| m.values.w_ratio,
        Test::Steps(&[0, 1, 4, 7, 14]),
    ),
    fact("the smallest w", Unit::Doublings, |m| m.values.w_least, SIZE),
    fact(
        "the corner of the largest w",
        Unit::Count,
        |m| m.values.w_largest,
        Test::Choice(&["the first", "the second", "the third", "none"]),
    ),
    fact(
        "its depth",
        Unit::Count,
        |m| m.values.depth,
        Test::Choice(&["0 everywhere", "the same everywhere", "not the same"]),
    ),
    fact("its first attribute", Unit::Count, |m| m.values.kinds[0], KINDS),
    fact("its second attribute", Unit::Count, |m| m.values.kinds[1], KINDS),
    fact(
        "the largest magnitude of the first attribute",
        Unit::Doublings,
        |m| m.values.sizes[0],
        SIZE,
    ),
];

/// What was measured of a triangle with its samples and its values.
struct SampleValueFacts {
    samples: SampleFacts,
    values: ValueFacts,
}

impl SampleValueFacts {
    /// Of a case with one triangle.
    fn of_case(case: &Case, limits: &Limits) -> Option<Self> {
        Some(Self {
            samples: SampleFacts::of_case(case, limits)?,
            values: ValueFacts::of_case(case, limits)?,
        })
    }
}
