//! Samples of pixels, each on its own, as a mask has them.

use std::rc::Rc;

use super::learnable::{Learnable, LearnedCase};
use crate::ask::Asked;
use crate::declared::Declared;
use crate::stages::samples::{Masked, POINTS, SampleMask};
use crate::stages::search::{Composed as _, Stage as _, both, singles};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;
use rasterproof_render::pipeline::multisample::SAMPLES;
use rasterproof_verify::cases::Case;
use rasterproof_verify::cases::facts::{Topic, samples};
use rasterproof_verify::learn::rows::{Quantities, TriangleInWindow, Unit};
use rasterproof_verify::learn::trial::Work;

/// The four samples of each pixel.
pub struct Samples;

/// A sample of a pixel.
pub struct Sample<'a> {
    pixel: Rc<Masked<'a>>,
    /// The number of the sample, and of its bit in masks.
    bit: u8,
    triangle: Rc<TriangleInWindow>,
}

impl Learnable for Samples {
    type Part<'a> = Sample<'a>;
    type Change = SampleMask;
    const TOPIC: &'static Topic = &samples::TOPIC;
    const PART: &'static str = "sample";

    fn of_question(case: &Case, out: &mut Quantities) {
        let Some(triangle) = case.triangles().first() else { return };
        let corners: Corners = triangle.corners();
        TriangleInWindow::new(&corners, case.window, &mut std::iter::empty()).of_question(out);
    }

    fn parts<'a>(asked: &'a LearnedCase, declared: &Declared) -> Vec<Sample<'a>> {
        let Asked::Samples(corners) = &asked.question.of else { return Vec::new() };
        // The pixels of the answer, shared by the four samples of each.
        let pixels: Vec<Rc<Masked<'a>>> =
            SampleMask::parts(&asked.question, &asked.answer, declared, 0.0)
                .into_iter()
                .map(Rc::new)
                .collect();
        let window = PixelRect::window(asked.question.width, asked.question.height);
        let covered = pixels.iter().filter(|pixel| pixel.right > 0).map(|pixel| pixel.spot.at);
        // The triangle is the same for all of them.
        let triangle = Rc::new(TriangleInWindow::new(corners, window, &mut { covered }));
        let of = |pixel: &Rc<Masked<'a>>| {
            [0, 1, 2, 3].map(|bit| Sample {
                pixel: Rc::clone(pixel),
                bit,
                triangle: Rc::clone(&triangle),
            })
        };
        pixels.iter().flat_map(of).collect()
    }

    fn is_right(part: &Sample<'_>) -> bool {
        (part.pixel.right ^ part.pixel.drawn) >> part.bit & 1 == 0
    }

    fn explains(change: &SampleMask, part: &Sample<'_>) -> bool {
        (change.mask(&part.pixel) ^ part.pixel.drawn) >> part.bit & 1 == 0
    }

    fn of_part(part: &Sample<'_>, _: Option<&SampleMask>, out: &mut Quantities) {
        // The pixel, then its samples, then points beside the sample that a program may test in its place.
        part.triangle.of_pixel(part.pixel.spot.at, out);
        let Masked { right, is_centre_covered, .. } = *part.pixel;
        let has = |bit: u8| right >> bit & 1 == 1;
        out.number(Unit::Count, part.bit.into(), &["the number of the sample"]);
        out.flag(has(part.bit), &["the sample is covered"], "the sample is not covered");
        let covered = i64::from(right.count_ones());
        out.number(Unit::Count, covered, &["the number of covered samples of the pixel"]);
        out.flag(is_centre_covered, &["the centre is covered"], "the centre is not covered");
        for (bit, name) in ["sample 0", "sample 1", "sample 2", "sample 3"].iter().enumerate() {
            out.holds(
                has(bit as u8),
                name,
                [" of the pixel is covered", " of the pixel is not covered"],
            );
        }
        for (at, name) in POINTS {
            let no = " of the pixel is not covered";
            out.holds(part.pixel.has_point(at), name, [" of the pixel is covered", no]);
        }
        // The same points beside the sample, in its own column or row.
        let (x, y) = SAMPLES[usize::from(part.bit)];
        for (at, name) in [
            ((x, 8), "the point above or below the sample at half the height of the pixel"),
            ((x, 0), "the point above the sample on the upper side of the pixel"),
            ((x, 16), "the point below the sample on the lower side of the pixel"),
            ((8, y), "the point left or right of the sample at half the width of the pixel"),
            ((0, y), "the point left of the sample on the left side of the pixel"),
            ((16, y), "the point right of the sample on the right side of the pixel"),
        ] {
            out.holds(part.pixel.has_point(at), name, [" is covered", " is not covered"]);
        }
        // How near the sample lies to an edge: rounding matters there.
        let (inside, is_on) = part.pixel.inside(part.bit);
        out.flag(
            is_on,
            &["the sample is exactly on an edge"],
            "the sample is not exactly on an edge",
        );
        let distance = "the distance of the sample from the nearest edge (below 0 outside)";
        out.number(Unit::Subpixels, inside, &[distance]);
    }

    fn changes(wrong: &[&Sample<'_>], right: &[&Sample<'_>], _: &Work) -> Vec<SampleMask> {
        let pixels: Vec<&Masked<'_>> = wrong.iter().chain(right).map(|part| &*part.pixel).collect();
        singles(&pixels)
    }

    fn both(a: &SampleMask, b: &SampleMask) -> Option<SampleMask> {
        both(a, b)
    }

    fn says(change: &SampleMask) -> String {
        let said = change.said().into_iter().map(|said| said.does.replace("{}", "a sample"));
        said.collect::<Vec<_>>().join(", and ")
    }
}
