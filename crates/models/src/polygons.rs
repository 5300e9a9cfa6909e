//! Polygons in space as triangles.
//!
//! A polygon is projected along the axis that is nearest to its normal. Coordinates stay the doubles of the file, so
//! that whether a corner is convex, and whether two edges cross, is decided exactly.

use std::collections::{HashMap, HashSet};

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, MIN_ALLOWED_VALUE, Point2, Triangulation as _};

use crate::contents::key;

/// Corners of a polygon whose edges may be anywhere: real ones have hundreds.
const MOST_CORNERS: usize = 1 << 16;

/// The shape of a polygon that does not cross itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Convex, or without an area.
    Convex,
    /// Some corner turns the other way, so the polygon was triangulated.
    Concave,
}

/// Why a polygon is drawn as triangles around its first corner, though it is not convex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Odd {
    /// Two of its edges cross, or a part of it is covered twice or from behind.
    Crosses,
    /// It is folded, so that seen along its normal a part of it cannot be told from its outline.
    Folded,
    /// It has more than [`MOST_CORNERS`] corners.
    TooManyCorners,
}

/// The normal of a polygon of any shape, of length twice its area (Newell). Differences are taken first, so that
/// it is as exact far from the origin.
pub(crate) fn normal(points: &[DVec3]) -> DVec3 {
    let Some((&first, others)) = points.split_first() else { return DVec3::ZERO };
    others.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum()
}

/// Calls `emit` with the corners of each triangle, in the winding of the polygon: a fan of a convex polygon, and
/// the triangles of a constrained Delaunay triangulation of any other one that does not cross itself.
pub(crate) fn triangles(
    points: &[DVec3],
    normal: DVec3,
    emit: &mut impl FnMut([usize; 3]),
) -> Result<Shape, Odd> {
    let count = points.len();
    let mut fan = || {
        for i in 1..count.saturating_sub(1) {
            emit([0, i, i + 1]);
        }
    };
    // Without a normal it has no area, whatever the triangles.
    if count == 3 || normal == DVec3::ZERO || !normal.is_finite() {
        fan();
        return Ok(Shape::Convex);
    }
    let flat: Vec<DVec2> = points.iter().map(|&point| projected(point, normal)).collect();
    if is_convex(&flat) {
        fan();
        return Ok(Shape::Convex);
    }
    if count > MOST_CORNERS {
        fan();
        return Err(Odd::TooManyCorners);
    }
    // A polygon that is not convex is drawn as its triangulation, if that is the polygon.
    let made = delaunay(&flat);
    if let Some(triangles) = &made
        && (is_flat(points, normal) || have_outline(triangles, points))
    {
        for &triangle in triangles {
            emit(triangle);
        }
        return Ok(Shape::Concave);
    }
    fan();
    Err(if is_flat(points, normal) { Odd::Crosses } else { Odd::Folded })
}

/// Whether the corners lie in a plane. A part that is nearer to it than this share of the size of the polygon would not be seen.
fn is_flat(points: &[DVec3], normal: DVec3) -> bool {
    const SHARE: f64 = 1e-4;
    let (normal, first) = (normal.normalize_or_zero(), points[0]);
    let (mut size, mut least, mut most) = (0.0_f64, 0.0_f64, 0.0_f64);
    for &point in points {
        size = size.max((point - first).length());
        let height = (point - first).dot(normal);
        (least, most) = (least.min(height), most.max(height));
    }
    most - least <= SHARE * size
}

/// Whether the outline of these triangles is the outline of the polygon in space: each of its edges is an edge of a triangle, and
/// every other edge is between two triangles.
fn have_outline(triangles: &[[usize; 3]], points: &[DVec3]) -> bool {
    let mut edges: HashSet<(usize, usize)> = HashSet::new();
    for &[a, b, c] in triangles {
        edges.extend([(a, b), (b, c), (c, a)]);
    }
    // Triangles name the first of several corners at one position.
    let mut first: HashMap<[u64; 3], usize> = HashMap::new();
    let mut corners: Vec<usize> = Vec::with_capacity(points.len());
    for (corner, &point) in points.iter().enumerate() {
        corners.push(*first.entry(key(point)).or_insert(corner));
    }
    let mut outline: HashSet<(usize, usize)> = HashSet::new();
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        if a != b {
            outline.insert((a, b));
        }
    }
    outline.is_subset(&edges)
        && edges.iter().all(|&(a, b)| outline.contains(&(a, b)) || edges.contains(&(b, a)))
}

/// The two coordinates other than the one in which the normal is largest, in the order that makes the polygon
/// counter-clockwise.
fn projected(point: DVec3, normal: DVec3) -> DVec2 {
    let DVec3 { x, y, z } = point;
    let size = normal.abs();
    let (a, b, along) = if size.z >= size.x && size.z >= size.y {
        (x, y, normal.z)
    } else if size.x >= size.y {
        (y, z, normal.x)
    } else {
        (z, x, normal.y)
    };
    if along > 0.0 { DVec2::new(a, b) } else { DVec2::new(b, a) }
}

/// Whether no corner turns right and the outline goes round once.
fn is_convex(points: &[DVec2]) -> bool {
    let count = points.len();
    for i in 0..count {
        let [a, b, c] = [i, i + 1, i + 2].map(|i| {
            let DVec2 { x, y } = points[i % count];
            Coord { x, y }
        });
        if orient2d(a, b, c) < 0.0 {
            return false;
        }
    }
    // Round once, it changes between left and right twice, and between up and down.
    changes(points, 0) <= 2 && changes(points, 1) <= 2
}

/// How often an outline changes between growing and falling along an axis. Steps that do neither do not count.
fn changes(points: &[DVec2], axis: usize) -> usize {
    let mut signs: Vec<bool> = Vec::with_capacity(points.len());
    for i in 0..points.len() {
        let step = points[(i + 1) % points.len()][axis] - points[i][axis];
        if step != 0.0 {
            signs.push(step > 0.0);
        }
    }
    (0..signs.len()).filter(|&i| signs[i] != signs[(i + 1) % signs.len()]).count()
}

/// The triangles inside a counter-clockwise polygon, which may touch itself, as one with a hole does at the bridge
/// to it. Nothing where edges cross or a part is not covered exactly once.
fn delaunay(points: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let mut mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    // The first corner at each vertex: corners at one position share it.
    let mut corner_of = Vec::with_capacity(points.len());
    let mut vertices: Vec<FixedVertexHandle> = Vec::with_capacity(points.len());
    let allowed = |x: f64| if x.abs() < MIN_ALLOWED_VALUE { 0.0 } else { x };
    for (corner, point) in points.iter().enumerate() {
        let point = Point2::new(allowed(point.x), allowed(point.y));
        let vertex = match vertices.last() {
            Some(&near) => mesh.insert_with_hint(point, near),
            None => mesh.insert(point),
        };
        let vertex = vertex.ok()?;
        if vertex.index() == corner_of.len() {
            corner_of.push(corner);
        }
        vertices.push(vertex);
    }
    // How often the outline runs along each edge, minus how often it runs against it.
    let mut runs: Vec<i64> = Vec::new();
    for (i, &from) in vertices.iter().enumerate() {
        let to = vertices[(i + 1) % vertices.len()];
        if from == to {
            continue;
        }
        let edges = mesh.try_add_constraint(from, to);
        if edges.is_empty() {
            return None;
        }
        for edge in edges {
            let edge = mesh.directed_edge(edge);
            let (along, against) = (edge.fix().index(), edge.rev().fix().index());
            runs.resize(runs.len().max(along.max(against) + 1), 0);
            runs[along] += 1;
            runs[against] -= 1;
        }
    }
    // How often the outline goes round each face, from the outside inwards.
    let mut rounds: Vec<Option<i64>> = vec![None; mesh.num_all_faces()];
    let outer = mesh.outer_face();
    rounds[outer.fix().index()] = Some(0);
    let mut open = Vec::new();
    for edge in mesh.directed_edges() {
        if edge.face() == outer {
            open.push(edge);
        }
    }
    while let Some(edge) = open.pop() {
        let (here, beyond) = (edge.face().fix().index(), edge.rev().face());
        if rounds[beyond.fix().index()].is_some() {
            continue;
        }
        let run = runs.get(edge.fix().index()).copied().unwrap_or(0);
        rounds[beyond.fix().index()] = Some(rounds[here]? - run);
        if let Some(face) = beyond.as_inner() {
            open.extend(face.adjacent_edges());
        }
    }
    // Faces of the triangulation that lie inside: around which the outline goes once.
    let mut triangles = Vec::new();
    for face in mesh.inner_faces() {
        match rounds[face.fix().index()] {
            Some(0) => {}
            Some(1) => {
                triangles.push(face.vertices().map(|vertex| corner_of[vertex.fix().index()]));
            }
            _ => return None,
        }
    }
    Some(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::angle::{cos, sin};

    /// The triangles of a polygon in a plane that is tilted, so that all axes are projected.
    fn cut(
        outline: &[(f64, f64)],
        axis: usize,
        flip: bool,
    ) -> (Result<Shape, Odd>, Vec<[usize; 3]>, f64, f64) {
        let points: Vec<DVec3> = outline
            .iter()
            .map(|&(x, y)| {
                let (x, y) = if flip { (y, x) } else { (x, y) };
                [DVec3::new(x, y, x / 4.0), DVec3::new(y / 4.0, x, y), DVec3::new(y, x / 4.0, x)]
                    [axis]
            })
            .collect();
        let normal = normal(&points);
        let mut made = Vec::new();
        let result = triangles(&points, normal, &mut |triangle| made.push(triangle));
        let area: f64 = made
            .iter()
            .map(|&[a, b, c]| {
                let doubled = (points[b] - points[a]).cross(points[c] - points[a]);
                assert!(doubled.dot(normal) >= 0.0, "a triangle is turned: {made:?}");
                doubled.length()
            })
            .sum();
        (result, made, area, normal.length())
    }

    #[test]
    fn simple_polygons_are_covered_once() {
        let star: Vec<(f64, f64)> = (0..10)
            .map(|i| {
                let (angle, radius) = (f64::from(i) * 0.628, if i % 2 == 0 { 4.0 } else { 1.5 });
                (radius * cos(angle), radius * sin(angle))
            })
            .collect();
        let shapes: [&[(f64, f64)]; 5] = [
            &[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)],
            // The first corner is the concave one.
            &[(2.0, 1.0), (0.0, 4.0), (0.0, 0.0), (4.0, 0.0), (4.0, 4.0)],
            // A ring: the hole is reached by a bridge, along which the outline runs twice.
            &[
                (0.0, 0.0),
                (6.0, 0.0),
                (6.0, 6.0),
                (0.0, 6.0),
                (0.0, 0.0),
                (2.0, 2.0),
                (2.0, 4.0),
                (4.0, 4.0),
                (4.0, 2.0),
                (2.0, 2.0),
            ],
            // A corner on an edge, and one corner twice in a row.
            &[(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 4.0), (4.0, 4.0), (3.0, 1.0), (0.0, 4.0)],
            &star,
        ];
        for (number, outline) in shapes.into_iter().enumerate() {
            for axis in 0..3 {
                for flip in [false, true] {
                    let (result, made, area, expected) = cut(outline, axis, flip);
                    assert_eq!(result, Ok(Shape::Concave), "{number}");
                    assert!(
                        (area - expected).abs() < 1e-12 * expected,
                        "{number}: {area} of {expected}: {made:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn convex_polygons_stay_fans() {
        let outline = [(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        let (result, made, ..) = cut(&outline, 0, false);
        assert_eq!((result, made), (Ok(Shape::Convex), vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]]));
    }

    /// The bow tie has no normal of its own where both halves are as large, so one is larger here. The
    /// pentagram turns left at each corner and goes round twice.
    #[test]
    fn polygons_that_cross_themselves_are_fans_and_said() {
        let bow_tie = [(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 3.0)];
        let pentagram = [(0.0, 4.0), (2.4, -3.2), (-3.8, 1.2), (3.8, 1.2), (-2.4, -3.2)];
        // An outline that runs twice crosses nothing and covers all twice.
        let twice = [
            (0.0, 0.0),
            (4.0, 0.0),
            (1.0, 1.0),
            (0.0, 4.0),
            (0.0, 0.0),
            (4.0, 0.0),
            (1.0, 1.0),
            (0.0, 4.0),
        ];
        for outline in [&bow_tie[..], &pentagram, &twice] {
            let points: Vec<DVec3> = outline.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect();
            let mut count = 0;
            let result = triangles(&points, normal(&points), &mut |_| count += 1);
            assert_eq!((result, count), (Err(Odd::Crosses), outline.len() - 2));
        }
    }

    #[test]
    fn nothing_panics_at_extreme_coordinates() {
        for size in [1e-300, 1e-40, 1e38] {
            let outline = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)];
            let points: Vec<DVec3> =
                outline.iter().map(|&(x, y)| DVec3::new(x, y, 0.5) * size).collect();
            let mut count = 0;
            let _ = triangles(&points, normal(&points), &mut |_| count += 1);
            assert_eq!(count, 3, "{size}");
        }
    }
}
