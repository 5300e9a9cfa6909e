//! Where a sample lies with respect to a triangle, by the signs of three edge functions in whole numbers,
//! and what the fill rules make of it. The oracle decides by other means, so that the two check each other.

use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::oracle::Oracle;

/// Where a sample lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    Inside,
    /// On an edge or a corner: who covers it is a rule's choice.
    Edge,
    Outside,
}

/// The place of a sample. Of a triangle without area nothing is inside and everything on it is an edge.
pub(super) fn place(&[a, b, c]: &Corners, sample: SubpixelPoint) -> Place {
    let area = twice_area(&[a, b, c]);
    // The smallest of the three edge functions decides, with their signs turned where the corners run the other way round.
    let mut least = i128::MAX;
    for (p, q) in [(a, b), (b, c), (c, a)] {
        if area == 0 && on_segment(p, q, sample) {
            return Place::Edge;
        }
        least = least.min(twice_area(&[p, q, sample]) * area.signum());
    }
    match least {
        0 if area != 0 => Place::Edge,
        1.. => Place::Inside,
        _ => Place::Outside,
    }
}

/// Whether a sample lies on a segment, its ends included.
fn on_segment(p: SubpixelPoint, q: SubpixelPoint, sample: SubpixelPoint) -> bool {
    let between = |a: i32, b: i32, v: i32| (a.min(b)..=a.max(b)).contains(&v);
    twice_area(&[p, q, sample]) == 0 && between(p.x, q.x, sample.x) && between(p.y, q.y, sample.y)
}

/// Whether a sample lies on an edge that two triangles share, one on each side, and on no end of it.
pub(super) fn on_shared_edge(triangles: &[Corners], sample: SubpixelPoint) -> bool {
    // The edges through the sample, from left to right, and the corners opposite to them.
    let (mut edges, mut apexes) = (Vec::new(), Vec::new());
    for corners in triangles {
        for i in 0..3 {
            let (p, q) = (corners[i], corners[(i + 1) % 3]);
            if p != sample && q != sample && on_segment(p, q, sample) {
                edges.push(if (p.x, p.y) < (q.x, q.y) { [p, q] } else { [q, p] });
                apexes.push(corners[(i + 2) % 3]);
            }
        }
    }
    let [[p, q], other] = edges[..] else { return false };
    let [one_side, other_side] = [0, 1].map(|i| twice_area(&[p, q, apexes[i]]).signum());
    [p, q] == other && one_side * other_side < 0
}

/// The rules that are told apart: those of a window whose axes may be turned over.
pub(super) const RULES: [[bool; 2]; 4] =
    [[false, false], [true, false], [false, true], [true, true]];

/// Adds what a rule covers of a triangle to hits in a cell: the oracle's top-left rule, with x or y turned
/// over. `moved` is added to the corners first.
pub(super) fn cover(
    corners: &Corners,
    [turn_x, turn_y]: [bool; 2],
    moved: [i32; 2],
    cell: i32,
    hits: &mut [u8],
) {
    // The corners are turned over before the oracle sees them, and its pixels are turned back: so its left edges are right ones.
    let flip = |v: i32, turn: bool| if turn { cell * SUBPIXELS - v } else { v };
    let image = corners
        .map(|p| SubpixelPoint::new(flip(p.x + moved[0], turn_x), flip(p.y + moved[1], turn_y)));
    Oracle.spans(image, PixelRect::window(cell as u32, cell as u32), &mut |span| {
        let y = if turn_y { cell - 1 - span.y_px } else { span.y_px };
        for x in span.x0_px..span.x1_px {
            let x = if turn_x { cell - 1 - x } else { x };
            hits[(y * cell + x) as usize] += 1;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::geometry::centre_of;
    use rasterproof_verify::cases::{self, Shape};

    fn px(points: [(f64, f64); 3]) -> Corners {
        points.map(|(x, y)| SubpixelPoint::from_px(x, y).unwrap())
    }

    /// The triangle (0.5, 0.5) (2.5, 0.5) (0.5, 2.5): three samples are corners, three lie on edges.
    #[test]
    fn rules_by_hand() {
        let triangle = px([(0.5, 0.5), (2.5, 0.5), (0.5, 2.5)]);
        let covered: [&[usize]; 4] = [&[0, 1, 4], &[1, 2, 5], &[4], &[5]];
        for (rule, pixels) in RULES.into_iter().zip(covered) {
            let mut hits = vec![0; 16];
            cover(&triangle, rule, [0, 0], 4, &mut hits);
            let found: Vec<_> = (0..16).filter(|i| hits[*i] == 1).collect();
            assert_eq!(found, pixels, "{rule:?}");
        }
        let at = |x, y| place(&triangle, centre_of(x, y));
        assert_eq!([at(0, 0), at(1, 1), at(2, 1)], [Place::Edge, Place::Edge, Place::Outside]);
        assert_eq!(place(&triangle, SubpixelPoint::new(200, 200)), Place::Inside);
    }

    #[test]
    fn a_shared_edge_by_hand() {
        let square =
            [px([(0.5, 0.5), (3.5, 0.5), (3.5, 3.5)]), px([(0.5, 0.5), (3.5, 3.5), (0.5, 3.5)])];
        assert!(on_shared_edge(&square, centre_of(1, 1)));
        assert!(!on_shared_edge(&square, centre_of(0, 0)), "an end");
        assert!(!on_shared_edge(&square, centre_of(1, 0)), "a border");
        assert!(!on_shared_edge(&[square[0], square[0]], centre_of(1, 1)), "twice the same side");
    }

    /// What all rules cover is inside, what any of them covers is inside or on an edge.
    #[test]
    fn the_oracle_and_the_signs_agree() {
        let mut ties = 0;
        for family in cases::triangles::FAMILIES.iter().take(9) {
            for case in (0..60).map(|index| family.case(5, index)) {
                let Shape::Triangles { list, .. } = case.shape else { continue };
                let corners = list[0].corners();
                let all = RULES.map(|rule| {
                    let mut hits = vec![0; 48 * 48];
                    cover(&corners, rule, [0, 0], 48, &mut hits);
                    hits
                });
                for (x, y) in (0..48).flat_map(|y| (0..48).map(move |x| (x, y))) {
                    let by = all.each_ref().map(|hits| hits[(y * 48 + x) as usize]);
                    match place(&corners, centre_of(x, y)) {
                        Place::Inside => assert_eq!(by, [1; 4]),
                        Place::Outside => assert_eq!(by, [0; 4]),
                        Place::Edge => ties += 1,
                    }
                }
            }
        }
        assert!(ties > 1000, "{ties}");
    }
}
