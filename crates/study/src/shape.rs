//! Hard cases that a mesh has wherever it is seen from.
//!
//! Corners at one position are one vertex, whichever material or object they belong to. Whether a triangle has an
//! area is decided exactly. What lies on something else does so within a [`GRAIN`] of the size of the model, since
//! files round their positions.

use glam::DVec3;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_render::scene::Scene;
use robust::{Coord, orient2d};

/// Share of the diagonal of the model within which positions count as the same plane or line: files commonly have
/// six digits.
pub const GRAIN: f64 = 1.0 / (1 << 20) as f64;

/// A triangle whose longest side is more than so many times its height is a sliver.
pub const SLIVER: f64 = 100.0;

/// Comparisons of boxes after which the search for overlaps and T-junctions stops.
const MOST_COMPARISONS: u64 = 400_000_000;

/// A pair of boxes that meet takes about as long as so many that do not.
const COMPARISONS_OF_PAIR: u64 = 32;

/// Overlaps, and T-junctions, after which the search for them stops: half of all pairs of faces may be some.
const MOST_FOUND: usize = 1 << 20;

/// An edge, or a vertex on an edge, with the faces concerned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub ends: [DVec3; 2],
    pub face: u32,
}

/// What was found in a mesh. Faces are numbers of triangles in the scene, worst or first ones first.
#[derive(Debug, Default)]
pub(crate) struct Shape {
    /// With the longest side over the height.
    pub slivers: Vec<(f64, u32)>,
    pub no_area: Vec<u32>,
    /// Faces that have the corners of an earlier one, and that one.
    pub duplicates: Vec<[u32; 2]>,
    pub borders: Vec<Edge>,
    /// Edges of more than two faces, with the number of faces.
    pub crowded: Vec<(usize, Edge)>,
    /// Vertices in the middle of the edge of another face, with that face.
    pub t_junctions: Vec<Edge>,
    pub overlaps: Vec<[u32; 2]>,
    /// Whether the search for overlaps and T-junctions was given up.
    pub is_cut_short: bool,
}

/// A triangle of the scene, welded.
struct Face {
    vertices: [u32; 3],
    number: u32,
}

impl Shape {
    pub fn of(scene: &Scene) -> Self {
        let (points, faces) = weld(scene);
        let at = |face: &Face| face.vertices.map_array(|v| points[v as usize]);
        let mut shape = Self::default();
        let mut solid = Vec::with_capacity(faces.len());
        for face in faces {
            let corners = at(&face);
            if has_no_area(corners) {
                shape.no_area.push(face.number);
                continue;
            }
            let aspect = aspect(corners);
            if aspect > SLIVER {
                shape.slivers.push((aspect, face.number));
            }
            solid.push(face);
        }
        shape.slivers.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let faces = shape.without_duplicates(solid);
        let size = size(&points);
        let border = shape.edges(&points, &faces);
        shape.find_t_junctions(&points, &border, GRAIN * size);
        let corners: Vec<[DVec3; 3]> = faces.iter().map(at).collect();
        shape.find_overlaps(&faces, &corners, GRAIN * size);
        shape
    }

    fn without_duplicates(&mut self, faces: Vec<Face>) -> Vec<Face> {
        let sorted = |face: &Face| {
            let mut vertices = face.vertices;
            vertices.sort_unstable();
            vertices
        };
        let mut keys: Vec<([u32; 3], u32)> =
            faces.iter().map(|face| (sorted(face), face.number)).collect();
        keys.sort_unstable();
        for same in keys.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
            self.duplicates.extend(same[1..].iter().map(|(_, later)| [*later, same[0].1]));
        }
        self.duplicates.sort_unstable();
        let is_later =
            |face: &Face| self.duplicates.binary_search_by_key(&face.number, |[d, _]| *d).is_ok();
        faces.into_iter().filter(|face| !is_later(face)).collect()
    }

    /// Finds edges that have not two faces; returns the borders as vertices.
    fn edges(&mut self, points: &[DVec3], faces: &[Face]) -> Vec<([u32; 2], u32)> {
        let mut edges: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * faces.len());
        for face in faces {
            let [a, b, c] = face.vertices;
            let edge = |a: u32, b: u32| ([a.min(b), a.max(b)], face.number);
            edges.extend([edge(a, b), edge(b, c), edge(c, a)]);
        }
        edges.sort_unstable();
        let mut border = Vec::new();
        for same in edges.chunk_by(|a, b| a.0 == b.0) {
            let (ends, face) = same[0];
            let edge = Edge { ends: ends.map_array(|v| points[v as usize]), face };
            match same.len() {
                1 => {
                    border.push((ends, face));
                    self.borders.push(edge);
                }
                2 => {}
                count => self.crowded.push((count, edge)),
            }
        }
        self.crowded.sort_by_key(|(count, edge)| (std::cmp::Reverse(*count), edge.face));
        self.borders.sort_by_key(|edge| edge.face);
        border
    }

    /// Vertices at a border that lie within the edge of a border.
    fn find_t_junctions(&mut self, points: &[DVec3], border: &[([u32; 2], u32)], grain: f64) {
        let mut vertices: Vec<u32> = border.iter().flat_map(|(ends, _)| *ends).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let ends = |i: usize| border[i].0.map_array(|v| points[v as usize]);
        let edges = (0..border.len()).map(|i| Box::around(&ends(i), grain));
        let boxes: Vec<Box> = edges
            .chain(vertices.iter().map(|&v| Box::around(&[points[v as usize]], 0.0)))
            .collect();
        let is_whole = pairs(&boxes, &mut |i, j| {
            let (edge, vertex) = (i.min(j), i.max(j));
            if edge >= border.len() || vertex < border.len() {
                return true;
            }
            let (point, [a, b]) = (points[vertices[vertex - border.len()] as usize], ends(edge));
            let (along, length) = (b - a, a.distance(b));
            let place = (point - a).dot(along) / length;
            let away = (point - a - along * (place / length)).length();
            if away <= grain && place > grain && place < length - grain {
                self.t_junctions.push(Edge { ends: [point, point], face: border[edge].1 });
            }
            self.t_junctions.len() < MOST_FOUND
        });
        self.is_cut_short |= !is_whole;
        self.t_junctions.sort_by_key(|edge| edge.face);
    }

    /// Pairs of faces in one plane that cover a part of it together.
    fn find_overlaps(&mut self, faces: &[Face], corners: &[[DVec3; 3]], grain: f64) {
        let planes: Vec<Plane> = corners.iter().map(Plane::of).collect();
        let boxes: Vec<Box> = corners.iter().map(|corners| Box::around(corners, grain)).collect();
        let is_whole = pairs(&boxes, &mut |i, j| {
            let (a, b) = (&planes[i], &planes[j]);
            let is_flat = a.holds(&corners[j], grain) && b.holds(&corners[i], grain);
            if is_flat && !a.parts(&corners[j], grain) && !b.parts(&corners[i], grain) {
                let (first, second) = (faces[i].number, faces[j].number);
                self.overlaps.push([first.max(second), first.min(second)]);
            }
            self.overlaps.len() < MOST_FOUND
        });
        self.is_cut_short |= !is_whole;
        self.overlaps.sort_unstable();
    }
}

/// The positions that triangles use, each once, and the triangles.
fn weld(scene: &Scene) -> (Vec<DVec3>, Vec<Face>) {
    // Where items are moved differently, the same numbers are not the same position.
    let group = |item: usize| {
        let same =
            |other: &&rasterproof_render::scene::Item| other.model == scene.items[item].model;
        scene.items.iter().take_while(|other| !same(other)).count()
    };
    let mut used: Vec<([u64; 3], usize, u32, u32)> = Vec::new();
    for (index, item) in scene.items.iter().enumerate() {
        let group = group(index);
        let mut is_used = vec![false; item.mesh.positions.len()];
        for number in item.mesh.triangles.positions().as_flattened() {
            is_used[*number as usize] = true;
        }
        for (number, position) in item.mesh.positions.iter().enumerate() {
            if is_used[number] {
                // -0 is 0.
                let bits = (*position + DVec3::ZERO).to_array().map_array(f64::to_bits);
                used.push((bits, group, index as u32, number as u32));
            }
        }
    }
    used.sort_unstable();
    let is_moved = (0..scene.items.len()).any(|item| group(item) > 0);
    let mut points = Vec::new();
    let mut vertex_of: Vec<Vec<u32>> =
        scene.items.iter().map(|item| vec![0; item.mesh.positions.len()]).collect();
    for same in used.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (bits, _, item, _) = same[0];
        let position = DVec3::from_array(bits.map_array(f64::from_bits));
        for (.., item, number) in same {
            vertex_of[*item as usize][*number as usize] = points.len() as u32;
        }
        let model = &scene.items[item as usize].model;
        points.push(if is_moved { model.transform_point3(position) } else { position });
    }
    let triangles = scene.items.iter().zip(&vertex_of).flat_map(|(item, vertex_of)| {
        let triangles = item.mesh.triangles.positions().iter();
        triangles.map(move |triangle| triangle.map(|number| vertex_of[number as usize]))
    });
    let faces = triangles.zip(0..).map(|(vertices, number)| Face { vertices, number }).collect();
    (points, faces)
}

/// The diagonal of the box around all points.
fn size(points: &[DVec3]) -> f64 {
    let bounds = Box::around(points, 0.0);
    if points.is_empty() { 0.0 } else { (bounds.max - bounds.min).length() }
}

/// Whether three points lie on a line, decided exactly: then they do so in each of three projections.
fn has_no_area([a, b, c]: [DVec3; 3]) -> bool {
    let flat = |x: fn(DVec3) -> [f64; 2]| {
        let [a, b, c] = [a, b, c].map_array(|p| {
            let [x, y] = x(p);
            Coord { x, y }
        });
        orient2d(a, b, c) == 0.0
    };
    flat(|p| [p.x, p.y]) && flat(|p| [p.y, p.z]) && flat(|p| [p.z, p.x])
}

/// The longest side over the height on it.
fn aspect([a, b, c]: [DVec3; 3]) -> f64 {
    let longest =
        (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    let doubled_area = (b - a).cross(c - a).length();
    longest / doubled_area
}

/// The plane of a triangle, and its sides within it.
struct Plane {
    normal: DVec3,
    /// A corner, and the direction from the side that begins there to the inside, of length 1.
    sides: [(DVec3, DVec3); 3],
}

impl Plane {
    fn of(&[a, b, c]: &[DVec3; 3]) -> Self {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let side = |from: DVec3, to: DVec3| (from, normal.cross(to - from).normalize_or_zero());
        Self { normal, sides: [side(a, b), side(b, c), side(c, a)] }
    }

    fn holds(&self, corners: &[DVec3; 3], grain: f64) -> bool {
        let from = self.sides[0].0;
        corners.iter().all(|corner| (*corner - from).dot(self.normal).abs() <= grain)
    }

    /// Whether a triangle lies beyond one of the sides.
    fn parts(&self, corners: &[DVec3; 3], grain: f64) -> bool {
        let beyond = |(from, inwards): &(DVec3, DVec3)| {
            corners.iter().all(|corner| (*corner - *from).dot(*inwards) <= grain)
        };
        self.sides.iter().any(beyond)
    }
}

#[derive(Clone, Copy)]
struct Box {
    min: DVec3,
    max: DVec3,
}

impl Box {
    fn around(points: &[DVec3], margin: f64) -> Self {
        let start = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        let tight = points
            .iter()
            .fold(start, |bounds, p| Self { min: bounds.min.min(*p), max: bounds.max.max(*p) });
        Self { min: tight.min - margin, max: tight.max + margin }
    }

    fn meets(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }
}

/// Calls `visit` with all pairs of boxes that meet, the smaller number first, until it says that it has enough or the
/// search takes too long; a sweep along the axis on which the boxes are shortest. Whether it came to the end.
fn pairs(boxes: &[Box], visit: &mut dyn FnMut(usize, usize) -> bool) -> bool {
    let mut sums = DVec3::ZERO;
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for bounds in boxes {
        sums += bounds.max - bounds.min;
        (min, max) = (min.min(bounds.min), max.max(bounds.max));
    }
    let shares = (sums / (max - min))
        .to_array()
        .map_array(|share| if share >= 0.0 { share } else { f64::MAX });
    let axis = (0..3).min_by(|&a, &b| shares[a].total_cmp(&shares[b])).unwrap_or(0);
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&a, &b| boxes[a].min[axis].total_cmp(&boxes[b].min[axis]));
    let sorted: Vec<Box> = order.iter().map(|&i| boxes[i]).collect();
    let mut comparisons = 0;
    for (place, bounds) in sorted.iter().enumerate() {
        let end = bounds.max[axis];
        for (other, near) in (place + 1..).zip(&sorted[place + 1..]) {
            if near.min[axis] > end {
                break;
            }
            comparisons += 1;
            if near.meets(bounds) {
                comparisons += COMPARISONS_OF_PAIR;
                let (i, j) = (order[place], order[other]);
                if !visit(i.min(j), i.max(j)) {
                    return false;
                }
            }
            if comparisons > MOST_COMPARISONS {
                return false;
            }
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles around the corners of a polygon that crosses itself: nearly all of them overlap.
    #[test]
    fn overlaps_without_number_are_not_all_kept() {
        let count = 4 * (MOST_FOUND as f64).sqrt() as u32;
        let corners = |number: u32| {
            let at = f64::from(number) / f64::from(count);
            let (x, y) = (0.1 * at, 0.1 * at * at);
            [[0.0, 0.0], [4.0 + x, y], [x, 3.0 - y]].map(|[x, y]| DVec3::new(x, y, 0.0))
        };
        let corners: Vec<_> = (0..count).map(corners).collect();
        let faces: Vec<_> = (0..count).map(|number| Face { vertices: [0; 3], number }).collect();
        let mut shape = Shape::default();
        shape.find_overlaps(&faces, &corners, 1e-6);
        assert_eq!((shape.overlaps.len(), shape.is_cut_short), (MOST_FOUND, true));
    }

    /// All pairs of a hundred thousand boxes are far more than the search may take.
    #[test]
    fn a_search_among_boxes_that_all_meet_ends() {
        let boxes = vec![Box::around(&[DVec3::ZERO, DVec3::ONE], 0.0); 100_000];
        let mut visits = 0;
        let is_whole = pairs(&boxes, &mut |_, _| {
            visits += 1;
            true
        });
        assert!(!is_whole && visits <= MOST_COMPARISONS / COMPARISONS_OF_PAIR, "{visits}");
    }
}
