//! Pixels of shapes, each on its own: what a stage of such pixels states is enough to learn of it.

use std::marker::PhantomData;

use super::learnable::{Learnable, LearnedCase};
use crate::declared::Declared;
use crate::stages::area::{AreaDrawn, AreaPixel};
use crate::stages::sample_values::{SampleShading, ShadedPixel};
use crate::stages::search::{Spot, Stage, both, singles};
use crate::stages::wide::{WideDrawn, WidePixel};
use rasterproof_verify::cases::Case;
use rasterproof_verify::cases::facts::{Topic, area, sample_values, wide};
use rasterproof_verify::learn::rows::{Quantities, Unit, value};
use rasterproof_verify::learn::trial::Work;

/// A stage whose parts are pixels of a window, each answered on its own.
pub trait PixelStage: Stage {
    /// The kind of question, with its facts.
    const TOPIC: &'static Topic;

    /// What rules may be about, beside the facts of the question.
    fn of_pixel(pixel: &Self::Part<'_>, out: &mut Quantities);
}

/// Makes a stage of pixels learnable.
pub struct Pixels<S>(PhantomData<S>);

impl<S: PixelStage> Learnable for Pixels<S> {
    type Part<'a> = S::Part<'a>;
    type Change = S;
    const TOPIC: &'static Topic = S::TOPIC;
    const PART: &'static str = "pixel";

    fn of_question(_: &Case, _: &mut Quantities) {}

    fn parts<'a>(asked: &'a LearnedCase, declared: &Declared) -> Vec<S::Part<'a>> {
        S::parts(&asked.question, &asked.answer, declared, S::NOISE[0])
    }

    fn is_right(part: &S::Part<'_>) -> bool {
        S::default().explains(part)
    }

    fn explains(change: &S, part: &S::Part<'_>) -> bool {
        change.explains(part)
    }

    fn of_part(part: &S::Part<'_>, _: Option<&S>, out: &mut Quantities) {
        S::of_pixel(part, out);
    }

    fn changes<'a>(wrong: &[&S::Part<'a>], right: &[&S::Part<'a>], _: &Work) -> Vec<S> {
        let pixels: Vec<_> = wrong.iter().chain(right).copied().collect();
        singles(&pixels)
    }

    fn both(a: &S, b: &S) -> Option<S> {
        both(a, b)
    }

    fn says(change: &S) -> String {
        let said = change.said().into_iter().map(|said| change.filled(&said.does));
        said.collect::<Vec<_>>().join(", and ")
    }
}

impl PixelStage for WideDrawn {
    const TOPIC: &'static Topic = &wide::TOPIC;

    fn of_pixel(pixel: &WidePixel<'_>, out: &mut Quantities) {
        of_spot(&pixel.spot, out);
        // Rounded up to whole subpixels, so that what is on the border is 0.
        let [beside, beyond] = pixel.outside().map(|v| v.ceil() as i64);
        out.number(
            Unit::Subpixels,
            beside,
            &["the distance of the sample from the long sides (below 0 between them)"],
        );
        out.number(
            Unit::Subpixels,
            beyond,
            &["the distance of the sample from the ends (below 0 between them)"],
        );
        out.flag(pixel.right[0], &["the pixel is covered"], "the pixel is not covered");
    }
}

impl PixelStage for AreaDrawn {
    const TOPIC: &'static Topic = &area::TOPIC;

    fn of_pixel(pixel: &AreaPixel<'_>, out: &mut Quantities) {
        of_spot(&pixel.spot, out);
        out.number(Unit::Value, value(pixel.share), &["the share of the pixel"]);
        out.flag(
            pixel.share >= 1.0,
            &["the pixel is covered whole"],
            "the pixel is not covered whole",
        );
    }
}

impl PixelStage for SampleShading {
    const TOPIC: &'static Topic = &sample_values::TOPIC;

    fn of_pixel(pixel: &ShadedPixel<'_>, out: &mut Quantities) {
        of_spot(&pixel.spot, out);
        let covered = i64::from(pixel.right.count_ones());
        out.number(Unit::Count, covered, &["the number of covered samples of the pixel"]);
        let is_covered = pixel.is_centre_covered;
        out.flag(is_covered, &["the centre is covered"], "the centre is not covered");
    }
}

/// Where a pixel lies in its window.
fn of_spot(spot: &Spot, out: &mut Quantities) {
    let [column, row] = spot.at.map(i64::from);
    let [right, below] = [spot.window.x1, spot.window.y1].map(|end| i64::from(end) - 1);
    out.number(Unit::Count, column, &["the column"]);
    out.number(Unit::Count, row, &["the row"]);
    out.number(Unit::Count, right - column, &["the number of columns to the right of it"]);
    out.number(Unit::Count, below - row, &["the number of rows below it"]);
}
