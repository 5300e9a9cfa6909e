//! Invariant 47: lists of triangles. A rasterizer of lists works on many at a time, so what a
//! triangle covers must not depend on its place, its neighbours, or how full the last batch is.

use super::Outcome;
use super::implementations::{Implementations, hits};
use super::source::TriangleInput;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_tiles::coverage::{CoverList, Piece};

/// The longest list: more than two batches of sixteen.
const MOST: u32 = 40;

/// 47: every triangle of a list against the oracle, and the order of the pieces.
pub(super) fn one_by_one(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let list = list_around(input.triangle.corners(), 1 + input.salt % MOST);
    let window = input.window;
    // What the oracle covers of each, alone.
    let mut truth = Vec::new();
    for corners in &list {
        truth.push(hits(&*subject.oracle, [*corners], window));
    }
    let mut compared = 0;
    for (name, lists) in &subject.lists {
        compared += compare(name, &**lists, &list, window, &truth)?;
    }
    Ok(compared)
}

/// Compares what a list of triangles covers with what the oracle says.
fn compare(
    name: &str,
    lists: &dyn CoverList,
    list: &[Corners],
    window: PixelRect,
    truth: &[Coverage],
) -> Outcome {
    let mut pieces: Vec<Piece> = Vec::new();
    // The order of the triangles is that of the list, so that whoever draws may rely on it.
    lists.cover_list(list, window, &mut |run| pieces.extend_from_slice(run));
    if let Some(pair) = pieces.windows(2).find(|pair| pair[0].triangle() > pair[1].triangle()) {
        let [before, after] = [pair[0].triangle(), pair[1].triangle()];
        return Err(format!("{name} emits triangle {before} before triangle {after}"));
    }
    let mut compared = 0;
    for (number, truth) in truth.iter().enumerate() {
        let mut actual = Coverage::new(window, 0);
        for piece in pieces.iter().filter(|piece| piece.triangle() as usize == number) {
            piece.spans(&mut |span| actual.hit(span.y_px, span.x0_px, span.x1_px));
        }
        if actual != *truth {
            let corners = list[number];
            let len = list.len();
            return Err(format!(
                "{name} and the oracle differ in triangle {number} of {len}, {corners:?}"
            ));
        }
        compared += u64::from(window.width()) * u64::from(window.height());
    }
    Ok(compared)
}

/// Triangles around one: itself first, then moved by odd subpixels, of either winding and any order,
/// every eighth 64 times as large, and every eighth as wide and high as the domain, so that extents
/// wrap around in 32 bits.
fn list_around([a, b, c]: Corners, len: u32) -> Vec<Corners> {
    let mut list = Vec::with_capacity(len as usize);
    for i in 0..len as i32 {
        let corners = match i % 8 {
            4 => [a, larger_by_64(b, a), larger_by_64(c, a)],
            6 => [
                a,
                SubpixelPoint::new(i32::MAX, i32::MAX - i),
                SubpixelPoint::new(i32::MIN, i32::MIN),
            ],
            _ => [a, b, c],
        };
        let [a, b, c] = corners
            .map(|p| SubpixelPoint::new(p.x.saturating_add(i * 37), p.y.saturating_sub(i * i * 3)));
        list.push([[a, b, c], [c, b, a], [b, c, a]][i as usize % 3]);
    }
    list
}

/// A point 64 times as far from another one, at most at the end of the domain.
fn larger_by_64(p: SubpixelPoint, from: SubpixelPoint) -> SubpixelPoint {
    let x = from.x.saturating_add(p.x.saturating_sub(from.x).saturating_mul(64));
    let y = from.y.saturating_add(p.y.saturating_sub(from.y).saturating_mul(64));
    SubpixelPoint::new(x, y)
}
