//! What is expected of one answer, so plain that a test in any language can check it: pixels, each with a few numbers.

use super::ask::{Answer, Asked, Question};
use super::check::Truth;
use super::depth::{Pile, SurePixels};
use super::expected::{exact_values, value_bounds};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Span;
use rasterproof_render::pipeline::multisample;
use rasterproof_verify::comparison::pixels::hits;
use rasterproof_verify::oracle::Oracle;

/// A pixel that is drawn, with what is written into it: nothing, a mask of samples, the number of a triangle, or depth and two
/// attributes.
#[derive(Clone, Debug, PartialEq)]
pub struct PlainPixel {
    pub x: i32,
    pub y: i32,
    /// A mask, the number of a triangle, a level, or depth and two attributes; nothing of plain pixels.
    pub values: Vec<f64>,
}

/// The pixels that an answer has to have, and those that it may have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkable {
    /// In drawing order, where they are those of a line.
    pub expected: Vec<PlainPixel>,
    /// Pixels of which nothing is promised.
    pub either: Vec<[i32; 2]>,
    /// How far each value may be off; nothing may where this is empty.
    pub bounds: Vec<f64>,
    /// Whether the pixels have to come in this order.
    pub in_order: bool,
    /// Whether it counts how often a pixel is drawn.
    pub counts_hits: bool,
}

/// What is expected of the answer to a question. Nothing where a program promises nothing, and of polygons, which are no pixels.
#[must_use]
pub fn checkable(question: &Question, truth: &Truth) -> Option<Checkable> {
    let window = PixelRect::window(question.width, question.height);
    let declared = &truth.declared;
    // Each kind of question fills in what its answers have: pixels, values, or both.
    let mut out = Checkable { counts_hits: !declared.mask, ..Checkable::default() };
    match &question.of {
        Asked::Coverage(corners) => {
            let picture = truth.expect.picture(corners, window)?;
            out.expected = plain(&picture.must);
            out.either = may_be(&picture.must, picture.may.as_deref(), window);
        }
        Asked::Wide(line) => {
            let picture = truth.expect.wide(line, window)?;
            out.expected = plain(&picture.must);
            out.either = may_be(&picture.must, picture.may.as_deref(), window);
        }
        Asked::Line { ends, .. } => {
            let line = truth.expect.line(ends, window)?;
            for (x, y) in line {
                out.expected.push(pixel(x, y, Vec::new()));
            }
            out.in_order = !declared.line_set;
        }
        Asked::Values(triangle) => {
            let picture = truth.expect.picture(&triangle.corners(), window)?;
            // Values are expected in every pixel that has to be drawn.
            let exact = exact_values(triangle, declared)?;
            out.either = may_be(&picture.must, picture.may.as_deref(), window);
            out.expected = plain(&picture.must);
            // The largest of each value, for the rounding of what is written.
            let mut largest = [0.0; 3];
            for pixel in &mut out.expected {
                let (depth, [a, b]) = exact.at(pixel.x, pixel.y);
                pixel.values = [depth.to_f64(), a.to_f64(), b.to_f64()].into();
                for (largest, value) in largest.iter_mut().zip(&pixel.values) {
                    *largest = value.abs().max(*largest);
                }
            }
            // The exact value is written as the nearest float, which is off by half a unit of its last place.
            for (bound, largest) in
                value_bounds(triangle, declared.tolerance).into_iter().zip(largest)
            {
                out.bounds.push(bound + largest * f64::EPSILON);
            }
        }
        Asked::Samples(corners) => {
            // A winding that is not drawn has no samples.
            let drawn = declared.convention.draws(twice_area(corners));
            let masks = multisample::masks(&Oracle, *corners, window).filter(|_| drawn)?;
            for (y, row) in masks.rows() {
                for (x, mask) in (window.x0..).zip(row).filter(|(_, mask)| **mask != 0) {
                    out.expected.push(pixel(x, y, vec![f64::from(*mask)]));
                }
            }
        }
        Asked::Depth(list) => {
            // Where several triangles may be seen, either is right, so that such a pixel is open.
            let pile = Pile::new(list, window, &*truth.expect, declared)?;
            let SurePixels { seen, open } = pile.sure();
            out.either = open;
            for ([x, y], triangle) in seen {
                out.expected.push(pixel(x, y, vec![triangle as f64]));
            }
        }
        Asked::Area(corners) => {
            let (levels, bound) = (f64::from(declared.levels), declared.steps_off());
            for y in window.y0..window.y1 {
                for x in window.x0..window.x1 {
                    let level = declared.share(corners, [x, y]) * levels;
                    // A level of 0 is right, and so may be a small one.
                    if level > bound {
                        out.expected.push(pixel(x, y, vec![level]));
                    } else if level > 0.0 || bound >= 1.0 {
                        out.either.push([x, y]);
                    }
                }
            }
            out.bounds = vec![bound];
        }
        Asked::Near(_)
        | Asked::Carried(_)
        | Asked::SampleValues(_)
        | Asked::Polygon(_)
        | Asked::Formula(..) => return None,
    }
    Some(out)
}

/// A pixel with what is written into it.
fn pixel(x: i32, y: i32, values: Vec<f64>) -> PlainPixel {
    PlainPixel { x, y, values }
}

/// The pixels of runs, with nothing written into them.
fn plain(runs: &[Span]) -> Vec<PlainPixel> {
    let mut pixels = Vec::new();
    for run in runs {
        for x in run.x0_px..run.x1_px {
            pixels.push(pixel(x, run.y_px, Vec::new()));
        }
    }
    pixels
}

/// The pixels that may be drawn and need not be.
fn may_be(must: &[Span], may: Option<&[Span]>, window: PixelRect) -> Vec<[i32; 2]> {
    let must = hits(must, window).0;
    let mut either = plain(may.unwrap_or_default());
    either.retain(|pixel| must.get(pixel.x, pixel.y) == Some(0));
    either.iter().map(|pixel| [pixel.x, pixel.y]).collect()
}

impl Checkable {
    /// Whether a test finds this answer wrong. Pixels outside the window are left out, as the starters leave them out.
    #[must_use]
    pub fn refutes(&self, question: &Question, answer: &Answer) -> bool {
        let window = PixelRect::window(question.width, question.height);
        let Some(mut drawn) = pixels_of(answer, window) else { return true };
        // Where hits are not counted, the first one of a pixel is looked at.
        if !self.counts_hits {
            let mut first: Vec<PlainPixel> = Vec::new();
            for pixel in drawn {
                if !first.iter().any(|known| [known.x, known.y] == [pixel.x, pixel.y]) {
                    first.push(pixel);
                }
            }
            drawn = first;
        }
        if self.in_order {
            return drawn != self.expected;
        }
        // Every drawn pixel has to be one of those that are expected, each once, and none of these may be left over.
        drawn.retain(|p| !self.either.contains(&[p.x, p.y]));
        let mut left = self.expected.clone();
        for pixel in &drawn {
            let Some(at) = left.iter().position(|e| [e.x, e.y] == [pixel.x, pixel.y]) else {
                return true;
            };
            let expected = left.swap_remove(at);
            for (i, (expected, value)) in expected.values.iter().zip(&pixel.values).enumerate() {
                let bound = self.bounds.get(i).copied().unwrap_or(0.0);
                let off = (expected - value).abs();
                // What is not a number is wrong, too.
                if off > bound || off.is_nan() {
                    return true;
                }
            }
        }
        !left.is_empty()
    }
}

/// The pixels of an answer that lie in the window; nothing where it has none to compare.
fn pixels_of(answer: &Answer, window: PixelRect) -> Option<Vec<PlainPixel>> {
    let mut out = Vec::new();
    match answer {
        Answer::Coverage(runs) => {
            for run in runs {
                add_run(&mut out, window, run, &[]);
            }
        }
        Answer::Samples(runs) | Answer::Area(runs) => {
            for (run, number) in runs {
                // Without a sample, or with a level of 0, nothing is drawn.
                if *number != 0 {
                    add_run(&mut out, window, run, &[f64::from(*number)]);
                }
            }
        }
        Answer::Seen(runs) => {
            for (run, triangle) in runs {
                add_run(&mut out, window, run, &[f64::from(*triangle)]);
            }
        }
        Answer::Line(pixels) => {
            for &(x, y) in pixels {
                out.push(pixel(x, y, Vec::new()));
            }
        }
        Answer::Values(fragments) => {
            for f in fragments {
                out.push(pixel(f.x_px, f.y_px, vec![f.depth, f.varying.x, f.varying.y]));
            }
        }
        Answer::SampleValues(_)
        | Answer::Polygon(_)
        | Answer::Carried(_)
        | Answer::Triangles(_)
        | Answer::Numbers(_)
        | Answer::Refused(_)
        | Answer::Two(_)
        | Answer::Died(_) => return None,
    }
    out.retain(|p| window.contains(p.x, p.y));
    Some(out)
}

/// Adds the pixels of a run that lie in the window. A run may be longer than any window, so it is cut first.
fn add_run(out: &mut Vec<PlainPixel>, window: PixelRect, run: &Span, values: &[f64]) {
    if !(window.y0..window.y1).contains(&run.y_px) {
        return;
    }
    for x in run.x0_px.max(window.x0)..run.x1_px.min(window.x1) {
        out.push(pixel(x, run.y_px, values.to_vec()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adapt_case;
    use crate::ask::Subject as _;
    use crate::check::Check;
    use crate::in_process::Inside;
    use rasterproof_registry::engines;

    /// For every kind of question that has pixels, a test finds exactly those answers wrong that the judge finds wrong.
    #[test]
    fn a_test_finds_what_the_judge_finds() {
        let checks = [
            Check::Coverage,
            Check::Line,
            Check::Values,
            Check::Samples,
            Check::Depth,
            Check::Wide,
            Check::Area,
        ];
        let mut found = checks.map(|check| (check, [0, 0]));
        let names = ["scanline", "games101-strict", "book-affine", "book-ch7", "dda", "book-dda"];
        let all = names.into_iter().chain(["exclusive-edges", "swapped-weights"]);
        // Right, and wrong by what they are said to declare.
        let declared = [
            ("wide-rectangles", ""),
            ("wide-rectangles", "wide=parallelogram"),
            ("area", ""),
            ("area", "levels=100"),
        ];
        for (name, words) in all.map(|name| (name, "")).chain(declared) {
            let planted = || engines::find_planted(name);
            let mut asked = Inside::new(&engines::find(name).copied().or_else(planted).unwrap());
            let mut declared = asked.declared().clone();
            declared.declare(words).unwrap();
            let truth = Truth::of(&declared);
            for family in adapt_case::families(&[]) {
                for index in 0..12 {
                    let case = adapt_case::case(family, 1, index, &truth.declared);
                    for check in Check::of_truth(family.name, &case, index, &truth) {
                        let Some(at) = checks.iter().position(|one| *one == check) else {
                            continue;
                        };
                        let mut questions = Vec::new();
                        check.questions(&case, &truth, &mut questions);
                        let answers = asked.ask(&questions, 1);
                        let is_wrong = check.judge(&case, &answers, &truth).is_wrong();
                        let refuted = questions.iter().zip(&answers).any(|(question, answer)| {
                            let plain = checkable(question, &truth);
                            plain.is_some_and(|plain| plain.refutes(question, answer))
                        });
                        let place = format!("{name}: {} #{index}, {check:?}", family.name);
                        // The judge compares some values, and the test all of them. Of pixels where any of several triangles may be
                        // seen, the test says nothing.
                        let may_differ = match check {
                            Check::Values => refuted,
                            // A small share may be drawn as 0.
                            Check::Depth | Check::Area => is_wrong,
                            _ => false,
                        };
                        assert!(refuted == is_wrong || may_differ, "{place}");
                        found[at].1[usize::from(refuted)] += 1;
                    }
                }
            }
        }
        assert!(found.iter().flat_map(|(_, counts)| counts).all(|n| *n > 0), "{found:?}");
    }
}
