//! How the answers of two programs to the same question differ.

use glam::DVec2;

use super::ask::Answer;
use super::declared::Declared;
use super::expected::value_bounds;
use super::judged::CaseJudgement;
use super::near_plane;
use super::pixels::{hits_of, painted};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Fragment;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::comparison::pixels::{few, mix, sequence};

/// The answers of the first program and those of the second; what came instead of answers stands in both.
pub(super) fn sides(answers: &[Answer]) -> [Vec<Answer>; 2] {
    let (mut first, mut second) = (Vec::new(), Vec::new());
    for answer in answers {
        let [of_first, of_second] = match answer {
            Answer::Two(both) => (**both).clone(),
            other => [other.clone(), other.clone()],
        };
        first.push(of_first);
        second.push(of_second);
    }
    [first, second]
}

/// Adds how two answers to the same question differ.
pub(super) fn difference(
    judged: &mut CaseJudgement,
    [first, second]: [&Answer; 2],
    triangle: Option<&Triangle>,
    window: PixelRect,
    declared: &Declared,
) {
    match (first, second) {
        // What both refuse is no difference, and what one refuses is.
        (Answer::Refused(_), Answer::Refused(_)) => return,
        (Answer::Refused(why), _) | (_, Answer::Refused(why)) => {
            judged.refuse(&format!("by one of both: {why}"));
            return;
        }
        (Answer::Line(first), Answer::Line(second)) => {
            let in_order = !declared.line_set;
            sequence(&mut judged.finding.tally, &mut judged.mark, first, second, window, in_order);
            return;
        }
        (Answer::Polygon(first), Answer::Polygon(second))
        | (Answer::Carried(first), Answer::Carried(second)) => {
            corners(judged, first, second, triangle, declared);
            return;
        }
        _ => {}
    }
    // What is left are answers with pixels: first which ones are drawn, then what is in those that both draw.
    let both = [first, second].map(|answer| hits_of(answer, window));
    let [Some((first_hits, first_outside)), Some((second_hits, second_outside))] = both else {
        return;
    };
    // Pixels outside of the window are counted, not compared one by one.
    judged.finding.tally.extra += first_outside.saturating_sub(second_outside);
    judged.finding.tally.missing += second_outside.saturating_sub(first_outside);
    pixels(judged, &first_hits, &second_hits, declared.mask);
    match (first, second) {
        (Answer::Samples(first), Answer::Samples(second))
        | (Answer::Seen(first), Answer::Seen(second))
        | (Answer::Area(first), Answer::Area(second)) => {
            let [first, second] = [first, second]
                .map(|runs| painted(runs, window, None, |here, mark| *here = Some(mark)));
            for ((y, a), (_, b)) in first.rows().zip(second.rows()) {
                for (x, (a, b)) in a.iter().zip(b).enumerate() {
                    let are_covered = a.is_some() && b.is_some();
                    if are_covered && a != b {
                        judged.finding.tally.order += 1;
                        mix(&mut judged.mark, y as u64);
                        mix(&mut judged.mark, x as u64);
                    }
                }
            }
        }
        (Answer::SampleValues(first), Answer::SampleValues(second)) if first != second => {
            judged.finding.tally.order += 1;
        }
        (Answer::Values(first), Answer::Values(second)) => {
            if let Some(triangle) = triangle {
                values(judged, first, second, triangle, declared);
            }
        }
        _ => {}
    }
}

/// Counts the pixels that one of both draws alone, or draws another number of times, and mixes them into the mark.
fn pixels(judged: &mut CaseJudgement, first: &Coverage, second: &Coverage, is_mask: bool) {
    for ((y, a), (_, b)) in first.rows().zip(second.rows()) {
        for (x, (&a, &b)) in a.iter().zip(b).enumerate() {
            // Of a pixel that both draw, the number of times counts, unless nobody can tell.
            let tally = &mut judged.finding.tally;
            match (a, b) {
                (0, 0) => continue,
                (0, _) => tally.missing += 1,
                (_, 0) => tally.extra += 1,
                _ if a == b || is_mask => continue,
                _ => tally.twice += 1,
            }
            for word in [y as u64, x as u64, u64::from(a)] {
                mix(&mut judged.mark, word);
            }
        }
    }
}

/// Two right values lie within twice the tolerance of each other.
fn values(
    judged: &mut CaseJudgement,
    first: &[Fragment<DVec2>],
    second: &[Fragment<DVec2>],
    triangle: &Triangle,
    declared: &Declared,
) {
    let bounds = value_bounds(triangle, 2.0 * declared.tolerance);
    for f in few(first) {
        let Some(g) = second.iter().find(|g| (g.x_px, g.y_px) == (f.x_px, f.y_px)) else {
            continue;
        };
        // Of a pixel that both draw, the values.
        let errors =
            [f.depth - g.depth, f.varying.x - g.varying.x, f.varying.y - g.varying.y].map(f64::abs);
        judged.off(f, [0, 1, 2].map(|i| errors[i] / bounds[i]));
    }
}

/// Two right corners lie within twice the tolerance of each other, too.
fn corners(
    judged: &mut CaseJudgement,
    first: &[ClipCorner],
    second: &[ClipCorner],
    triangle: Option<&Triangle>,
    declared: &Declared,
) {
    let Some(triangle) = triangle else { return };
    let bounds = near_plane::bounds(&clip_corners(triangle), 2.0 * declared.tolerance);
    let is_same = |i: usize, j: usize| {
        let (wanted, given) = (&second[i], &first[j]);
        (0..5).all(|k| (wanted[k] - given[k]).abs() <= bounds[k])
    };
    judged.finding.tally += near_plane::difference_of(second.len(), first.len(), &is_same);
}
