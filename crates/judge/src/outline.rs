//! The fill of a triangle against its own outline, where a program draws both.
//!
//! With corners at centres of pixels, the outline has in each column or row of an edge the pixel that is nearest to it. So a pixel
//! inside of the outline has its centre in the triangle, and one outside of it has not: whatever belongs to the fill on the
//! outline itself, nothing else is open.

use super::ask::Answer;
use super::judged::CaseJudgement;
use super::pixels::picture_of;
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{Corners, PixelPoint};
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::comparison::pixels::mix;

/// The pixels whose centres are the corners; nothing where one lies elsewhere or outside the window.
pub(super) fn ends(corners: &Corners, window: PixelRect) -> Option<[PixelPoint; 3]> {
    // Only where all corners lie at centres the outline says exactly what is inside.
    let is_centre = |v: i32| v.rem_euclid(SUBPIXELS) == HALF_PIXEL;
    let pixels =
        corners.map(|p| PixelPoint::new(p.x.div_euclid(SUBPIXELS), p.y.div_euclid(SUBPIXELS)));
    let is_right = corners.iter().all(|p| is_centre(p.x) && is_centre(p.y))
        && pixels.iter().all(|p| window.contains(p.x, p.y));
    is_right.then_some(pixels)
}

/// What was filled, and what of it the outline leaves: without what lies outside, with all that it encloses.
pub(super) fn pictures(answers: &[Answer], window: PixelRect) -> Option<[Coverage; 2]> {
    let (fill, sides) = answers.split_first()?;
    let filled = picture_of(fill, window)?;
    let mut outline = Frame::new(window, false);
    for side in sides {
        let drawn = picture_of(side, window)?;
        for (y, row) in drawn.rows() {
            for (here, hits) in outline.row_mut(y).iter_mut().zip(row) {
                *here |= *hits > 0;
            }
        }
    }
    let outside = outside(&outline);
    let mut mended = Coverage::new(window, 0);
    for (y, row) in filled.rows() {
        let open = outline.row(y).iter().zip(outside.row(y));
        for ((mended, filled), (on, out)) in mended.row_mut(y).iter_mut().zip(row).zip(open) {
            // On the outline the fill may be anything; beside it, what is enclosed is filled.
            *mended = match (on, out) {
                (true, _) => *filled,
                (false, true) => 0,
                (false, false) => 1,
            };
        }
    }
    Some([filled, mended])
}

/// The pixels from which the border of the window is reached without crossing the outline.
fn outside(outline: &Frame<bool>) -> Frame<bool> {
    let window = outline.bounds();
    let mut outside = Frame::new(window, false);
    // The search begins at all pixels of the border.
    let mut reached = Vec::new();
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            let is_side = x == window.x0 || x == window.x1 - 1;
            if is_side || y == window.y0 || y == window.y1 - 1 {
                reached.push((x, y));
            }
        }
    }
    while let Some((x, y)) = reached.pop() {
        if !window.contains(x, y) {
            continue;
        }
        let column = (x - window.x0) as usize;
        let here = &mut outside.row_mut(y)[column];
        if *here || outline.row(y)[column] {
            continue;
        }
        *here = true;
        reached.extend([(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)]);
    }
    outside
}

/// Counts filled pixels outside of the outline, and pixels that it encloses and that are not filled.
pub(super) fn compare(judged: &mut CaseJudgement, answers: &[Answer], window: PixelRect) {
    judged.shapes += 1;
    let Some([filled, mended]) = pictures(answers, window) else { return };
    judged.pixels += mended.covered();
    judged.finding.tally += Tally::between(&filled, &mended);
    for ((y, a), (_, b)) in filled.rows().zip(mended.rows()) {
        for (x, (a, b)) in a.iter().zip(b).enumerate() {
            if a != b {
                mix(&mut judged.mark, y as u64);
                mix(&mut judged.mark, x as u64);
            }
        }
    }
}
