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
    // Both directions of an edge are written as one, so that the same edges stand side by side when they are sorted.
    let mut all = Vec::with_capacity(3 * list.len());
    for triangle in list {
        for [a, b] in edges(triangle) {
            all.push(if a < b { [a, b] } else { [b, a] });
        }
    }
    all.sort_unstable();
    let mut outline = Vec::new();
    for same in all.chunk_by(|a, b| a == b) {
        if same.len() % 2 == 1 {
            outline.push(same[0]);
        }
    }
    outline
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
    // Beyond the first and the last column of a corner there is no mesh.
    let mut columns: Option<[i32; 2]> = None;
    for corner in list.iter().flatten() {
        let x = corner.x.div_euclid(SUBPIXELS);
        let [left, right] = columns.unwrap_or([x, x]);
        columns = Some([left.min(x), right.max(x)]);
    }
    let Some([left, right]) = columns else { return mended };
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
    // The square of nine pixels around this one, in subpixels.
    let border = |px: i32| px.saturating_mul(SUBPIXELS);
    let (x0, x1) = (border(x_px - 1), border(x_px + 2));
    let (y0, y1) = (border(y_px - 1), border(y_px + 2));
    let square = [(x0, y0), (x1, y0), (x0, y1), (x1, y1)].map(|(x, y)| SubpixelPoint::new(x, y));
    for &[a, b] in outline {
        // An edge does not touch the square where its box lies apart, or where all corners of the square lie on one side of it.
        let is_apart =
            a.x.max(b.x) < x0 || a.x.min(b.x) > x1 || a.y.max(b.y) < y0 || a.y.min(b.y) > y1;
        let signs = square.map(|corner| side([a, b], corner).signum());
        if !is_apart && signs != [1; 4] && signs != [-1; 4] {
            return false;
        }
    }
    // No edge touches the square, so it lies inside or outside as a whole.
    is_inside(outline, square[0])
}

/// Whether an odd number of edges crosses the ray from a point to the right; it lies on none.
fn is_inside(outline: &[Edge], p: SubpixelPoint) -> bool {
    let mut crossed = 0;
    for &[a, b] in outline {
        let (upper, lower) = if a.y <= b.y { (a, b) } else { (b, a) };
        crossed += u32::from(upper.y <= p.y && p.y < lower.y && side([upper, lower], p) > 0);
    }
    crossed % 2 == 1
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
