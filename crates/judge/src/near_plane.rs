//! What the near plane leaves of a triangle of clip space, exactly, and whether an answer is that.
//!
//! Kept is what has z >= -w, or z >= 0 where that is declared. The side of a corner is the sign of z + w, which rounding keeps; a new
//! corner divides an edge as the exact distances of its ends do, in big integers, where programs
//! interpolate. A polygon may begin at any corner and may name a corner several times: where an edge
//! begins in the plane, the textbook names it twice.

use super::ask::Asked;
use super::declared::Declared;
use super::judged::CaseJudgement;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::oracle::values::{Exact, at_crossing};

/// x, y, z, w and the attribute of a corner, exactly.
type Corner = [Exact; 5];

/// The corners that are left, in the order of the triangle's; the plane is z = -w, or z = 0.
pub(super) fn polygon(triangle: &Triangle, is_zero: bool) -> Vec<Corner> {
    let corners = clip_corners(triangle);
    let mut left = Vec::new();
    for (i, &from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % 3];
        let distances = [distance(from, is_zero), distance(to, is_zero)];
        // Rounding keeps the sign of a sum, so the side is exact.
        let [from_is_kept, to_is_kept] = distances.map(|[z, w]| z + w >= 0.0);
        if from_is_kept {
            left.push(from.map(Exact::from));
        }
        // An edge with one end on each side gets a new corner, each of whose numbers divides the edge alike.
        if from_is_kept != to_is_kept {
            left.push([0, 1, 2, 3, 4].map(|k| at_crossing([from[k], to[k]], distances)));
        }
    }
    left
}

/// The two numbers whose sum is how far a corner lies before the plane.
fn distance([_, _, z, w, _]: ClipCorner, is_zero: bool) -> [f64; 2] {
    [z, if is_zero { 0.0 } else { w }]
}

/// How far the numbers of a corner may be off: the tolerance times the largest number asked, or the largest attribute.
pub(super) fn bounds(corners: &[ClipCorner; 3], tolerance: f64) -> ClipCorner {
    let (mut place, mut attribute) = (0.0_f64, 0.0_f64);
    for corner in corners {
        for number in &corner[..4] {
            place = place.max(number.abs());
        }
        attribute = attribute.max(corner[4].abs());
    }
    // Where nothing may be off, the smallest number keeps quotients defined.
    let place = (tolerance * place).max(f64::MIN_POSITIVE);
    let attribute = (tolerance * attribute).max(f64::MIN_POSITIVE);
    [place, place, place, place, attribute]
}

/// The triangle of a question about the near plane, whose attributes are 0 where they are not asked for.
pub fn asked(of: &Asked) -> Option<Triangle> {
    match of {
        Asked::Near(triangle) => {
            let mut without = *triangle;
            for vertex in &mut without.vertices {
                vertex.varying.y = 0.0;
            }
            Some(without)
        }
        Asked::Carried(triangle) => Some(*triangle),
        _ => None,
    }
}

/// Whether each number of a corner is the exact one, within its bound.
fn is_within(exact: &Corner, corner: &ClipCorner, bounds: &ClipCorner) -> bool {
    (0..5).all(|k| exact[k].distance(corner[k]) <= bounds[k])
}

/// Compares a polygon with the exact one.
pub(super) fn compare(
    judged: &mut CaseJudgement,
    triangle: &Triangle,
    answer: &[ClipCorner],
    declared: &Declared,
) {
    // A corner that is named several times is one.
    let mut exact = polygon(triangle, declared.near_is_zero);
    exact.dedup();
    if exact.len() > 1 && exact.first() == exact.last() {
        exact.pop();
    }
    let bounds = bounds(&clip_corners(triangle), declared.tolerance);
    judged.shapes += 1;
    judged.pixels += exact.len() as u64;
    // What has no area may be left out.
    if answer.is_empty() && exact.len() < 3 {
        return;
    }
    let is_same = |i: usize, j: usize| is_within(&exact[i], &answer[j], &bounds);
    judged.finding.tally += difference_of(exact.len(), answer.len(), &is_same);
}

/// Corners that an answer lacks, corners that it has alone, and whether the same corners run another way. `is_same` says of a
/// corner that is wanted and one of the answer whether they are the same.
pub(super) fn difference_of(
    wanted: usize,
    answer: usize,
    is_same: &dyn Fn(usize, usize) -> bool,
) -> Tally {
    // A corner is missing where no corner of the answer is the same, and the other way round.
    let (mut missing, mut extra) = (0, 0);
    for i in 0..wanted {
        missing += u64::from(!(0..answer).any(|j| is_same(i, j)));
    }
    for j in 0..answer {
        extra += u64::from(!(0..wanted).any(|i| is_same(i, j)));
    }
    // Only where both have the same corners does their order say something.
    let is_other_way = missing + extra == 0 && !is_round(wanted, answer, is_same);
    Tally { missing, extra, order: u64::from(is_other_way), ..Tally::default() }
}

/// Whether both are the same corners on one way round: from a pair that is the same, each step goes to the next corner of one or
/// of both, every pair is the same, and the way ends where it began.
pub(super) fn is_round(
    wanted: usize,
    answer: usize,
    is_same: &dyn Fn(usize, usize) -> bool,
) -> bool {
    if wanted == 0 || answer == 0 {
        return wanted == answer;
    }
    // The answer may begin at any of its corners.
    (0..answer).any(|first| is_round_from(first, wanted, answer, is_same))
}

/// The same where the answer begins at one of its corners.
fn is_round_from(
    first: usize,
    wanted: usize,
    answer: usize,
    is_same: &dyn Fn(usize, usize) -> bool,
) -> bool {
    // Whether there is a way from the first pair to each other one; a row and a column more stand before the first.
    let mut reached = vec![vec![false; answer + 1]; wanted + 1];
    reached[0][0] = true;
    for i in 0..wanted {
        for j in 0..answer {
            let comes = reached[i][j] || reached[i][j + 1] || reached[i + 1][j];
            reached[i + 1][j + 1] = comes && is_same(i, (first + j) % answer);
        }
    }
    reached[wanted][answer]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::server::pipeline;
    use rasterproof_verify::cases::Shape;
    use rasterproof_verify::cases::near_plane::FAMILIES;

    /// What of 400 cases is found wrong with a clipper.
    fn wrong(clip: impl Fn([ClipCorner; 3]) -> Vec<ClipCorner>) -> usize {
        let is_wrong = |index: &u64| {
            let Shape::Triangles { list, .. } = FAMILIES[1].case(1, *index).shape else {
                return true;
            };
            let mut judged = CaseJudgement::default();
            let declared = Declared { tolerance: 1e-9, ..Declared::default() };
            compare(&mut judged, &list[0], &clip(clip_corners(&list[0])), &declared);
            judged.is_wrong()
        };
        (0..400).filter(is_wrong).count()
    }

    /// Sutherland and Hodgman with a plane of its own, and sides of its own.
    fn textbook(
        corners: [ClipCorner; 3],
        distance: fn(ClipCorner) -> f64,
        is_kept: fn(f64) -> bool,
    ) -> Vec<ClipCorner> {
        let mut left = Vec::new();
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let (from, to) = (distance(a), distance(b));
            if is_kept(from) {
                left.push(a);
            }
            if is_kept(from) != is_kept(to) {
                left.push([0, 1, 2, 3, 4].map(|k| a[k] + (b[k] - a[k]) * from / (from - to)));
            }
        }
        left
    }

    /// Another first corner, a corner named twice, a corner in the plane left out where that leaves no
    /// area: all of it is the same polygon. Every fault is found.
    #[test]
    fn polygons_are_told_apart() {
        let near: fn(ClipCorner) -> f64 = |[_, _, z, w, _]| z + w;
        let right = |corners| textbook(corners, near, |d| d >= 0.0);
        assert_eq!((wrong(pipeline::clipped), wrong(right)), (0, 0));
        let turned = |corners| {
            let mut polygon = right(corners);
            let turn = 1.min(polygon.len());
            polygon.rotate_left(turn);
            polygon.extend(polygon.last().copied());
            polygon
        };
        assert_eq!(wrong(turned), 0);
        assert_eq!(wrong(|corners| textbook(corners, near, |d| d > 0.0)), 0);
        let backwards = |corners| right(corners).into_iter().rev().collect();
        let divided = |corners| {
            let by_w = |[x, y, z, w, a]: ClipCorner| [x / w, y / w, z / w, 1.0, a];
            right(corners).into_iter().map(by_w).collect()
        };
        let shortened = |corners| right(corners).into_iter().take(3).collect();
        let faults = [
            wrong(|corners| textbook(corners, |[_, _, z, _, _]| z, |d| d >= 0.0)),
            wrong(|corners| textbook(corners, |[_, _, _, w, _]| w - 0.1, |d| d >= 0.0)),
            wrong(|corners| textbook(corners, |[_, _, z, w, _]| w - z, |d| d >= 0.0)),
            wrong(|corners| corners.to_vec()),
            wrong(|_| Vec::new()),
            wrong(backwards),
            wrong(divided),
            wrong(shortened),
        ];
        assert!(faults.iter().all(|found| *found > 40), "{faults:?}");
        let nothing = CaseJudgement::default();
        assert!(!nothing.is_wrong());
    }
}
