//! What holds for meshes under any convention: no pixel within is left out, none is drawn by two.
//!
//! Wherever in a pixel a program samples, and even if it moves corners by up to a pixel, a pixel
//! whose neighbourhood of 3 x 3 lies within the mesh and does not touch its border belongs to some
//! triangle of it; and triangles whose interiors are disjoint share no pixel. All in exact integers.

use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::{Edge, edges, twice_area};
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::comparison::Tally;

/// Twice the area of a, b, p.
fn side([a, b]: Edge, p: SubpixelPoint) -> i128 {
    twice_area(&[a, b, p])
}

/// The edges that belong to one triangle only, in one direction or the other.
fn outline(list: &[Corners]) -> Vec<Edge> {
    let sorted = |[a, b]: Edge| if a < b { [a, b] } else { [b, a] };
    let mut all = Vec::with_capacity(3 * list.len());
    for triangle in list {
        for edge in edges(triangle) {
            all.push(sorted(edge));
        }
    }
    all.sort_unstable();
    all.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1).map(|same| same[0]).collect()
}

/// Pixels of the window without a hit whose neighbourhood lies within the mesh, and hits beyond the
/// first on any pixel; `hits` are those of all triangles together, each counted at most once.
pub fn holes_and_doubles(list: &[Corners], hits: &Coverage) -> (u64, u64) {
    let Tally { missing, twice, .. } = Tally::between(hits, &mended(list, hits));
    (missing, twice)
}

/// The same picture without its holes and doubles: a hit where there is a hole, and one where there are more.
pub fn mended(list: &[Corners], hits: &Coverage) -> Coverage {
    let outline = outline(list);
    let mut mended = hits.clone();
    let corners = || list.iter().flatten();
    let px = |sub: i32| sub.div_euclid(SUBPIXELS);
    let (left, right) = (corners().map(|p| px(p.x)).min(), corners().map(|p| px(p.x)).max());
    let (Some(left), Some(right)) = (left, right) else { return mended };
    let bounds = hits.bounds();
    for y_px in bounds.y0..bounds.y1 {
        for (x_px, n) in (bounds.x0..).zip(mended.row_mut(y_px)) {
            let near = left < x_px && x_px < right;
            let is_hole = *n == 0 && near && is_within(&outline, x_px, y_px);
            *n = if is_hole { 1 } else { (*n).min(1) };
        }
    }
    mended
}

/// Whether the pixel and its eight neighbours lie within the outline, which is not touched.
fn is_within(outline: &[Edge], x_px: i32, y_px: i32) -> bool {
    let border = |px: i32| px.saturating_mul(SUBPIXELS);
    let (x0, x1) = (border(x_px - 1), border(x_px + 2));
    let (y0, y1) = (border(y_px - 1), border(y_px + 2));
    let untouched = outline.iter().all(|&[a, b]| {
        let apart =
            a.x.max(b.x) < x0 || a.x.min(b.x) > x1 || a.y.max(b.y) < y0 || a.y.min(b.y) > y1;
        let signs = [(x0, y0), (x1, y0), (x0, y1), (x1, y1)]
            .map(|(x, y)| side([a, b], SubpixelPoint::new(x, y)).signum());
        apart || signs == [1; 4] || signs == [-1; 4]
    });
    untouched && is_inside(outline, SubpixelPoint::new(x0, y0))
}

/// Whether an odd number of edges crosses the ray from a point to the right; it lies on none.
fn is_inside(outline: &[Edge], p: SubpixelPoint) -> bool {
    let crossed = outline.iter().filter(|[a, b]| {
        let (upper, lower) = if a.y <= b.y { (*a, *b) } else { (*b, *a) };
        upper.y <= p.y && p.y < lower.y && side([upper, lower], p) > 0
    });
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::PixelRect;

    fn square() -> Vec<Corners> {
        let p = |x: i32, y: i32| SubpixelPoint::new(x * 256, y * 256);
        let (a, b, c, d) = (p(1, 1), p(7, 1), p(7, 7), p(1, 7));
        vec![[a, b, c], [a, c, d]]
    }

    /// A square from 1 to 7 px: pixels 3 and 4 are more than a pixel away from its border; 2 and 5
    /// are so by nothing, and a border moved by a pixel may pass through their samples.
    #[test]
    fn holes_and_doubles_by_hand() {
        let square = square();
        let mut hits = Coverage::new(PixelRect::window(8, 8), 0);
        assert_eq!(holes_and_doubles(&square, &hits), (4, 0));
        (1..7).for_each(|y| hits.hit(y, 1, 7));
        assert_eq!(holes_and_doubles(&square, &hits), (0, 0));
        hits.hit(1, 1, 3);
        assert_eq!(holes_and_doubles(&square, &hits), (0, 2));
    }
}
