//! Specimen: DrawLine of the book (part 1, chapter 2, section 2.1), a DDA in `double`.
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptom: the last pixel is never drawn; the height is truncated instead of rounded, and the sum of slopes
//! drifts, so that (0, 0) to (20, 2) is still in row 0 at column 10; a line of length zero draws nothing; both
//! ends are truncated without moving the height along.

use super::{BookScreen, MOST_STEPS, NoResult, PublishedLine, to_int};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;

#[derive(Clone, Copy, Debug)]
pub struct BookDda;

impl PublishedLine for BookDda {
    fn draw(
        &self,
        ends_px: [[f64; 2]; 2],
        bounds: PixelRect,
        emit: &mut dyn FnMut(i32, i32),
    ) -> Result<(), NoResult> {
        let screen = BookScreen { bounds };
        let [p, q] = ends_px.map_array(|end| screen.position(end.into()));
        // 0/0 and x/0 are meant to happen: both go to the steep branch.
        let slope = (p.y - q.y) / (p.x - q.x);
        let (width, height) = screen.size();
        if slope.abs() < 1.0 {
            // Of two ends in one column, which cannot be here, the second would start.
            let (from, to) = if p.x < q.x { (p, q) } else { (q, p) };
            steps(from.x, to.x, from.y, slope, width, &mut |x, y| put(screen, x, y, emit))
        } else {
            let (from, to) = if p.y < q.y { (p, q) } else { (q, p) };
            let per_row = 1.0 / slope;
            steps(from.y, to.y, from.x, per_row, height, &mut |y, x| put(screen, x, y, emit))
        }
    }
}

/// Walks the major coordinate from (int)start to before (int)end, adding to the minor one, which
/// starts where the end point is and not where its truncated pixel is.
fn steps(
    start: f64,
    end: f64,
    minor: f64,
    slope: f64,
    limit: i64,
    visit: &mut dyn FnMut(i64, i64),
) -> Result<(), NoResult> {
    let (first, end) = (to_int(start)?, to_int(end)?);
    if (-first) as f64 > MOST_STEPS {
        return Err(NoResult::TooFar(-first as f64));
    }
    let mut minor = minor;
    for major in first..end.min(limit) {
        if major >= 0 {
            visit(major, to_int(minor)?);
        }
        minor += slope;
    }
    Ok(())
}

/// Lights a pixel of the screen that lies in the window.
fn put(screen: BookScreen, x: i64, y: i64, emit: &mut dyn FnMut(i32, i32)) {
    let (width, height) = screen.size();
    if (0..width).contains(&x) && (0..height).contains(&y) {
        let (x_px, y_px) = screen.pixel(x, y);
        emit(x_px, y_px);
    }
}
