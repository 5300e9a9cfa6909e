//! Answers as pixels, and how these are compared.

use glam::DVec2;

use super::ask::Answer;
use super::judged::{hits, mix};
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, Span};
use rasterproof_verify::comparison::{Picture, Tally};

pub(super) fn pixel_of(f: &Fragment<DVec2>) -> Span {
    Span { y_px: f.y_px, x0_px: f.x_px, x1_px: f.x_px.saturating_add(1) }
}

pub(super) fn length(runs: &[Span]) -> u64 {
    runs.iter().map(|r| u64::from(r.x0_px.abs_diff(r.x1_px))).sum()
}

/// Compares runs with a picture, pixel by pixel unless they are the same runs.
pub(super) fn compare(
    tally: &mut Tally,
    mark: &mut u64,
    runs: &[Span],
    picture: &Picture,
    window: PixelRect,
) {
    if picture.may.is_none() && runs == picture.must {
        return;
    }
    let (actual, outside) = hits(runs, window);
    let must = hits(&picture.must, window).0;
    let may = picture.may.as_ref().map(|may| hits(may, window).0);
    tally.extra += outside;
    mix(mark, outside);
    for (y, row) in actual.rows() {
        let (must, may) = (must.row(y), may.as_ref().unwrap_or(&must).row(y));
        for (x, &n) in row.iter().enumerate() {
            let is_right = n == must[x] || (n == 1 && may[x] == 1);
            if is_right {
                continue;
            }
            tally.missing += u64::from(n < must[x]);
            tally.extra += u64::from(n > 0 && may[x] == 0);
            tally.twice += u64::from(n.saturating_sub(1));
            [y as u64, x as u64, u64::from(n)].iter().for_each(|word| mix(mark, *word));
        }
    }
}

/// The pixels of an answer by hits, those outside the window left out.
pub fn picture_of(answer: &Answer, window: PixelRect) -> Option<Coverage> {
    hits_of(answer, window).map(|(hits, _)| hits)
}

/// The pixels of an answer by hits, and how many lie outside the window.
pub fn hits_of(answer: &Answer, window: PixelRect) -> Option<(Coverage, u64)> {
    let runs: Vec<Span> = match answer {
        Answer::Coverage(runs) => return Some(hits(runs, window)),
        Answer::Samples(runs) | Answer::Seen(runs) => runs.iter().map(|(run, _)| *run).collect(),
        Answer::Values(fragments) => fragments.iter().map(pixel_of).collect(),
        Answer::Line(pixels) => as_runs(pixels),
        Answer::Polygon(_)
        | Answer::Carried(_)
        | Answer::Triangles(_)
        | Answer::Refused(_)
        | Answer::Two(_)
        | Answer::Died(_) => return None,
    };
    Some(hits(&runs, window))
}

pub(super) fn as_runs(pixels: &[(i32, i32)]) -> Vec<Span> {
    let run = |&(x, y): &(i32, i32)| Span { y_px: y, x0_px: x, x1_px: x.saturating_add(1) };
    pixels.iter().map(run).collect()
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

/// The fragments whose values are compared: the first, the last and two between.
pub(super) fn picks(fragments: &[Fragment<DVec2>]) -> impl Iterator<Item = &Fragment<DVec2>> {
    let n = fragments.len();
    let mut picks = vec![0, n / 3, 2 * n / 3, n.saturating_sub(1)];
    picks.dedup();
    picks.into_iter().filter_map(|i| fragments.get(i))
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
        let (x0, x1) = (run.x0_px.max(window.x0), run.x1_px.min(window.x1));
        if (window.y0..window.y1).contains(&run.y_px) && x0 < x1 {
            painted.span_mut(run.y_px, x0, x1).iter_mut().for_each(|here| paint(here, *mark));
        }
    }
    painted
}

/// Compares the pixels of a line, and where they are the same ones their order.
pub(super) fn sequence(
    tally: &mut Tally,
    mark: &mut u64,
    pixels: &[(i32, i32)],
    expected: &[(i32, i32)],
    window: PixelRect,
    in_order: bool,
) {
    if pixels == expected {
        return;
    }
    let picture = Picture { must: as_runs(expected), may: None };
    let before = tally.total();
    compare(tally, mark, &as_runs(pixels), &picture, window);
    if tally.total() == before && in_order {
        tally.order += pixels.iter().zip(expected).filter(|(a, b)| a != b).count() as u64;
    }
}
