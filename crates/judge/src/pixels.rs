//! Answers as pixels, and how these are compared.

use glam::DVec2;

use super::ask::Answer;
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, Span};
use rasterproof_verify::comparison::pixels::{as_runs, hits};

/// The pixel of a fragment as a run of one. Its column may be the largest number there is.
pub(super) fn pixel_of(f: &Fragment<DVec2>) -> Span {
    Span { y_px: f.y_px, x0_px: f.x_px, x1_px: f.x_px.saturating_add(1) }
}

/// How many pixels runs have; a run that ends before it begins counts as if it were turned round.
pub(super) fn length(runs: &[Span]) -> u64 {
    runs.iter().map(|r| u64::from(r.x0_px.abs_diff(r.x1_px))).sum()
}

/// The pixels of an answer by hits, those outside the window left out.
pub fn picture_of(answer: &Answer, window: PixelRect) -> Option<Coverage> {
    hits_of(answer, window).map(|(hits, _)| hits)
}

/// The pixels of an answer by hits, and how many lie outside the window.
pub fn hits_of(answer: &Answer, window: PixelRect) -> Option<(Coverage, u64)> {
    // Every answer with pixels is one of runs, whatever else its items hold.
    let runs: Vec<Span> = match answer {
        Answer::Coverage(runs) => return Some(hits(runs, window)),
        Answer::Samples(runs) | Answer::Seen(runs) | Answer::Area(runs) => {
            runs.iter().map(|(run, _)| *run).collect()
        }
        Answer::Values(fragments) => fragments.iter().map(pixel_of).collect(),
        Answer::SampleValues(samples) => samples.iter().map(|s| pixel_of(&s.values)).collect(),
        Answer::Line(pixels) => as_runs(pixels),
        Answer::Polygon(_)
        | Answer::Carried(_)
        | Answer::Triangles(_)
        | Answer::Numbers(_)
        | Answer::Refused(_)
        | Answer::Two(_)
        | Answer::Died(_) => return None,
    };
    Some(hits(&runs, window))
}

/// How many triangles of a mesh cover each pixel. A mesh with a triangle that was refused has a hole for another
/// reason, and no picture.
pub fn mesh_of(answers: &[Answer], window: PixelRect) -> Option<Coverage> {
    let mut sum = Coverage::new(window, 0);
    for answer in answers {
        let drawn = picture_of(answer, window)?;
        for (y, row) in drawn.rows() {
            for (sum, hits) in sum.row_mut(y).iter_mut().zip(row) {
                *sum = sum.saturating_add((*hits).min(1));
            }
        }
    }
    Some(sum)
}

/// The bits of all runs at each pixel of the window.
pub(super) fn masks_of(runs: &[(Span, u8)], window: PixelRect) -> Frame<u8> {
    painted(runs, window, 0, |here, mask| *here |= mask)
}

/// Each pixel of the window after all runs that cover it, of which `paint` takes the mark into account.
pub(super) fn painted<T: Copy>(
    runs: &[(Span, u8)],
    window: PixelRect,
    empty: T,
    paint: impl Fn(&mut T, u8),
) -> Frame<T> {
    let mut painted = Frame::new(window, empty);
    for (run, mark) in runs {
        // What lies outside of the window is cut off, so that a run of any length costs no more than a row.
        let (x0, x1) = (run.x0_px.max(window.x0), run.x1_px.min(window.x1));
        if (window.y0..window.y1).contains(&run.y_px) && x0 < x1 {
            painted.span_mut(run.y_px, x0, x1).iter_mut().for_each(|here| paint(here, *mark));
        }
    }
    painted
}
