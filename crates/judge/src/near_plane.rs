//! What the near plane leaves of a triangle of clip space, exactly, and whether an answer is that.
//!
//! Kept is what has z >= -w, or z >= 0 where that is declared. The side of a corner is the sign of z + w, which rounding keeps; a new
//! corner divides an edge as the exact distances of its ends do, in big integers, where programs
//! interpolate. A polygon may begin at any corner and may name a corner several times: where an edge
//! begins in the plane, the textbook names it twice.

use glam::DVec2;

use super::ask::Asked;
use super::declared::Declared;
use super::judged::CaseJudgement;
use rasterproof_core::triangle::ScreenVertex;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::oracle::values::{Exact, at_crossing};

type Corner = [Exact; 5];

/// The corners that are left, in the order of the triangle's; the plane is z = -w, or z = 0.
pub(super) fn polygon(triangle: &Triangle, is_zero: bool) -> Vec<Corner> {
    let corners = clip_corners(triangle);
    let asked = |w: f64| if is_zero { 0.0 } else { w };
    let is_kept = |[_, _, z, w, _]: ClipCorner| z + asked(w) >= 0.0;
    let mut left = Vec::new();
    for (i, &from) in corners.iter().enumerate() {
        let to = corners[(i + 1) % 3];
        let distances = [from, to].map(|[_, _, z, w, _]| [z, asked(w)]);
        let at = |k: usize| at_crossing([from[k], to[k]], distances);
        if is_kept(from) {
            left.push(from.map(Exact::from));
        }
        if is_kept(from) != is_kept(to) {
            left.push([at(0), at(1), at(2), at(3), at(4)]);
        }
    }
    left
}

/// How far the numbers of a corner may be off: the tolerance times the largest number asked, or the largest attribute.
pub(super) fn bounds(corners: &[ClipCorner; 3], tolerance: f64) -> ClipCorner {
    let largest = |numbers: &dyn Fn(&ClipCorner) -> f64| {
        let largest = corners.iter().map(numbers).fold(0.0, f64::max);
        (tolerance * largest).max(f64::MIN_POSITIVE)
    };
    let place = largest(&|c| c[..4].iter().fold(0.0, |m: f64, v| m.max(v.abs())));
    [place, place, place, place, largest(&|c| c[4].abs())]
}

/// The triangle of a question about the near plane, whose attributes are 0 where they are not asked for.
pub fn asked(of: &Asked) -> Option<Triangle> {
    match of {
        Asked::Near(triangle) => Some(Triangle {
            vertices: triangle.vertices.map(|v| {
                let varying = DVec2::new(v.varying.x, 0.0);
                ScreenVertex { varying, ..v }
            }),
        }),
        Asked::Carried(triangle) => Some(*triangle),
        _ => None,
    }
}

/// Compares a polygon with the exact one.
pub(super) fn compare(
    judged: &mut CaseJudgement,
    triangle: &Triangle,
    answer: &[ClipCorner],
    declared: &Declared,
) {
    let mut exact = polygon(triangle, declared.near_is_zero);
    exact.dedup();
    if exact.len() > 1 && exact.first() == exact.last() {
        exact.pop();
    }
    let bounds = bounds(&clip_corners(triangle), declared.tolerance);
    let near = |at: &Corner, corner: &ClipCorner| {
        at.iter().zip(corner).zip(bounds).all(|((e, v), bound)| e.distance(*v) <= bound)
    };
    judged.shapes += 1;
    judged.pixels += exact.len() as u64;
    // What has no area may be left out.
    if answer.is_empty() && exact.len() < 3 {
        return;
    }
    judged.finding.tally += between(exact.len(), answer.len(), |i, j| near(&exact[i], &answer[j]));
}

/// Corners that an answer lacks, corners that it has alone, and whether the same corners run another way; `near` says of a corner
/// that is wanted and one of the answer whether they are the same.
pub(super) fn between(wanted: usize, answer: usize, near: impl Fn(usize, usize) -> bool) -> Tally {
    let lacks = |i: &usize| !(0..answer).any(|j| near(*i, j));
    let strays = |j: &usize| !(0..wanted).any(|i| near(i, *j));
    let missing = (0..wanted).filter(lacks).count() as u64;
    let extra = (0..answer).filter(strays).count() as u64;
    let is_other_way = missing + extra == 0 && !is_round(wanted, answer, near);
    Tally { missing, extra, order: u64::from(is_other_way), ..Tally::default() }
}

/// Whether both are the same corners on one way round: from a pair that is near, each step goes to
/// the next corner of one or of both, every pair is near, and the way ends where it began.
pub(super) fn is_round(exact: usize, answer: usize, near: impl Fn(usize, usize) -> bool) -> bool {
    if exact == 0 || answer == 0 {
        return exact == answer;
    }
    (0..answer).any(|first| {
        let near = |i: usize, j: usize| near(i, (first + j) % answer);
        let mut reached = vec![vec![false; answer]; exact];
        for i in 0..exact {
            for j in 0..answer {
                let before =
                    |up: usize, left: usize| i >= up && j >= left && reached[i - up][j - left];
                let comes = (i, j) == (0, 0) || before(1, 0) || before(0, 1) || before(1, 1);
                reached[i][j] = comes && near(i, j);
            }
        }
        reached[exact - 1][answer - 1]
    })
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
