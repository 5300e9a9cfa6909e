//! Runs of pixels compared with those that are expected, and which values are compared.

use super::finding::Tally;
use crate::promise::Expectation;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Span;

/// Compares runs with a picture, pixel by pixel unless they are the same runs.
pub fn compare(
    tally: &mut Tally,
    mark: &mut u64,
    runs: &[Span],
    picture: &Expectation,
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

/// Compares the pixels of a line, and where they are the same ones their order.
pub fn sequence(
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
    let picture = Expectation { must: as_runs(expected), may: None };
    let before = tally.total();
    compare(tally, mark, &as_runs(pixels), &picture, window);
    if tally.total() == before && in_order {
        tally.order += pixels.iter().zip(expected).filter(|(a, b)| a != b).count() as u64;
    }
}

/// The fragments whose values are compared: the first, the last and two between.
pub fn few<T>(fragments: &[T]) -> impl Iterator<Item = &T> {
    let n = fragments.len();
    let mut picks = vec![0, n / 3, 2 * n / 3, n.saturating_sub(1)];
    picks.dedup();
    picks.into_iter().filter_map(|i| fragments.get(i))
}

pub fn as_runs(pixels: &[(i32, i32)]) -> Vec<Span> {
    let run = |&(x, y): &(i32, i32)| Span { y_px: y, x0_px: x, x1_px: x.saturating_add(1) };
    pixels.iter().map(run).collect()
}

/// Hits of the runs within the window, and how many pixels lie outside.
pub fn hits(runs: &[Span], window: PixelRect) -> (Coverage, u64) {
    let (mut hits, mut outside) = (Coverage::new(window, 0), 0);
    for run in runs {
        let (x0, x1) = (run.x0_px.max(window.x0), run.x1_px.min(window.x1));
        let is_in = (window.y0..window.y1).contains(&run.y_px) && x0 < x1;
        if is_in {
            hits.hit(run.y_px, x0, x1);
        }
        outside += u64::from(run.x0_px.abs_diff(run.x1_px));
        outside -= if is_in { (x1 - x0) as u64 } else { 0 };
    }
    (hits, outside)
}

/// FNV-1a by words: the same on every machine.
pub fn mix(mark: &mut u64, word: u64) {
    for byte in word.to_le_bytes() {
        *mark = (*mark ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3);
    }
}
