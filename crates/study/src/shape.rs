//! Hard cases that a mesh has wherever it is seen from.
//!
//! Corners at one position are one vertex, whichever material or object they belong to. Edges, duplicates and overlaps
//! are those of the faces of the file, which readers cut into triangles. Whether a triangle has an area is decided
//! exactly. What lies on something else does so within a [`GRAIN`] of the size of the model, since
//! files round their positions.

use glam::DVec3;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_models::Origin;
use rasterproof_render::scene::Scene;
use robust::{Coord, orient2d};

use crate::faces;

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

/// A border and a chain of borders between the same two vertices lie beside each other where no vertex of the chain is
/// farther from the border than this share of its length.
const BESIDE: f64 = 0.25;

/// Edges of a chain that is looked for beside a border: a level of detail rarely has more of them on one of another.
const MOST_OF_CHAIN: usize = 64;

/// An edge, or a vertex on an edge, with the triangles concerned.
#[derive(Clone, Debug)]
pub(crate) struct Edge {
    pub ends: [DVec3; 2],
    pub triangles: Vec<u32>,
}

/// A border and the chain of borders beside it, as a polygon with the border as its last side.
#[derive(Clone, Debug)]
pub(crate) struct Gap {
    pub polygon: Vec<DVec3>,
    pub triangles: Vec<u32>,
}

/// What was found in a mesh. Triangles and faces are numbers of triangles in the scene, a face that of its first one; worst
/// or first ones first.
#[derive(Debug, Default)]
pub(crate) struct Shape {
    /// With the longest side over the height.
    pub slivers: Vec<(f64, u32)>,
    pub no_area: Vec<u32>,
    /// Faces that have the corners of an earlier one, and that one.
    pub duplicates: Vec<[u32; 2]>,
    pub borders: Vec<Edge>,
    /// Edges of more than two faces.
    pub crowded: Vec<Edge>,
    /// Vertices in the middle of the edge of another face, with that face.
    pub t_junctions: Vec<Edge>,
    /// What lies between such an edge and the vertices on it.
    pub at_t_junctions: Vec<Gap>,
    /// Places where vertices nearly meet, with the faces of borders there.
    pub near: Vec<Edge>,
    /// What lies between borders whose ends nearly meet.
    pub at_near: Vec<Gap>,
    /// How far apart vertices are at most that nearly meet.
    pub near_apart: f64,
    pub gaps: Vec<Gap>,
    /// Pairs of faces, the later one first, sorted.
    pub overlaps: Vec<[u32; 2]>,
    /// For each triangle that of its face.
    pub face_of: Vec<u32>,
    /// Whether the search for overlaps and T-junctions was given up.
    pub is_cut_short: bool,
}

/// A triangle of the scene, welded.
struct Triangle {
    vertices: [u32; 3],
    number: u32,
    face: u32,
}

/// A border as vertices, with its triangle.
type Border = ([u32; 2], u32);

/// A mesh without what is no face and without faces that repeat an earlier one.
struct Welded {
    points: Vec<DVec3>,
    triangles: Vec<Triangle>,
    /// For each triangle of the scene whether it has an area.
    is_solid: Vec<bool>,
    /// The edges of one face.
    border: Vec<Border>,
    /// How far apart two points may be that count as one.
    grain: f64,
}

impl Shape {
    pub fn of(scene: &Scene, origins: &[Origin]) -> Self {
        let mut shape = Self { face_of: first_triangles(scene, origins), ..Self::default() };
        let Welded { points, mut triangles, is_solid, mut border, grain } = shape.weld(scene);
        if let Some(met) = shape.find_near(&points, (&triangles, &border), grain) {
            // With these corners merged, borders are those that are open still.
            for triangle in &mut triangles {
                triangle.vertices = triangle.vertices.map_array(|v| met[v as usize]);
            }
            border = shape.edges(&points, &triangles);
        }
        shape.find_t_junctions(&points, &border, grain);
        let in_gaps = shape.find_gaps(&points, (&triangles, &border), grain);
        let rest = border.iter().filter(|(ends, _)| in_gaps.binary_search(ends).is_err());
        shape.borders =
            rest.map(|(ends, triangle)| edge(&points, *ends, vec![*triangle])).collect();
        shape.borders.sort_by_key(|edge| edge.triangles[0]);
        triangles.retain(|triangle| is_solid[triangle.number as usize]);
        let at = |triangle: &Triangle| triangle.vertices.map_array(|v| points[v as usize]);
        let corners: Vec<[DVec3; 3]> = triangles.iter().map(at).collect();
        shape.find_overlaps(&triangles, &corners, grain);
        shape
    }

    /// The places where corners nearly meet, and nothing that is looked for after them.
    pub fn nearly_meeting(scene: &Scene, origins: &[Origin]) -> Vec<Edge> {
        let mut shape = Self { face_of: first_triangles(scene, origins), ..Self::default() };
        let Welded { points, triangles, border, grain, .. } = shape.weld(scene);
        shape.find_near(&points, (&triangles, &border), grain);
        shape.near
    }

    /// Welds the mesh, and finds triangles without area, slivers, duplicates and crowded edges.
    fn weld(&mut self, scene: &Scene) -> Welded {
        let (points, mut triangles) = weld(scene, &self.face_of);
        let at = |triangle: &Triangle| triangle.vertices.map_array(|v| points[v as usize]);
        let mut is_solid = Vec::with_capacity(triangles.len());
        for triangle in &triangles {
            let corners = at(triangle);
            let has_area = !has_no_area(corners);
            is_solid.push(has_area);
            if !has_area {
                self.no_area.push(triangle.number);
            } else if aspect(corners) > SLIVER {
                self.slivers.push((aspect(corners), triangle.number));
            }
        }
        self.slivers.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        // What has no area is no face, but it may be a part of one.
        let mut is_face = vec![false; triangles.len()];
        for triangle in triangles.iter().filter(|triangle| is_solid[triangle.number as usize]) {
            is_face[triangle.face as usize] = true;
        }
        triangles.retain(|triangle| is_face[triangle.face as usize]);
        self.find_duplicates(&triangles);
        let is_later = |triangle: &Triangle| {
            self.duplicates.binary_search_by_key(&triangle.face, |[later, _]| *later).is_ok()
        };
        triangles.retain(|triangle| !is_later(triangle));
        let grain = GRAIN * size(&points);
        let border = self.edges(&points, &triangles);
        Welded { points, triangles, is_solid, border, grain }
    }

    /// Finds faces with the vertices of an earlier face.
    fn find_duplicates(&mut self, triangles: &[Triangle]) {
        let mut vertices: Vec<u32> = Vec::with_capacity(3 * triangles.len());
        let mut of_faces: Vec<(std::ops::Range<usize>, u32)> = Vec::new();
        for face in triangles.chunk_by(|a, b| a.face == b.face) {
            let first = vertices.len();
            vertices.extend(face.iter().flat_map(|triangle| triangle.vertices));
            vertices[first..].sort_unstable();
            let mut end = first;
            for i in first..vertices.len() {
                if i == first || vertices[i] != vertices[i - 1] {
                    vertices[end] = vertices[i];
                    end += 1;
                }
            }
            vertices.truncate(end);
            of_faces.push((first..end, face[0].face));
        }
        let of = |face: &(std::ops::Range<usize>, u32)| &vertices[face.0.clone()];
        of_faces.sort_unstable_by(|a, b| of(a).cmp(of(b)).then(a.1.cmp(&b.1)));
        for same in of_faces.chunk_by(|a, b| of(a) == of(b)).filter(|same| same.len() > 1) {
            self.duplicates.extend(same[1..].iter().map(|(_, later)| [*later, same[0].1]));
        }
        self.duplicates.sort_unstable();
    }

    /// Finds edges that have not two faces; returns the borders.
    fn edges(&mut self, points: &[DVec3], triangles: &[Triangle]) -> Vec<Border> {
        let mut edges: Vec<([u32; 2], u32, u32)> = Vec::with_capacity(3 * triangles.len());
        for Triangle { vertices: [a, b, c], number, face } in triangles {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                if a != b {
                    edges.push(([*a.min(b), *a.max(b)], *face, *number));
                }
            }
        }
        edges.sort_unstable();
        self.crowded.clear();
        let mut border = Vec::new();
        for same in edges.chunk_by(|a, b| a.0 == b.0) {
            // Where a face was cut, its triangles have the edge twice.
            let of_faces = same.chunk_by(|a, b| a.1 == b.1).filter(|face| face.len() % 2 == 1);
            let of: Vec<u32> = of_faces.map(|face| face[0].2).collect();
            match of[..] {
                [only] => border.push((same[0].0, only)),
                [] | [_, _] => {}
                _ => self.crowded.push(edge(points, same[0].0, of)),
            }
        }
        self.crowded.sort_by_key(|e| (std::cmp::Reverse(e.triangles.len()), e.triangles[0]));
        border
    }

    /// Finds borders with a chain of borders beside them that begins and ends where they do: the seam of two levels of
    /// detail. Returns all of their edges, sorted.
    fn find_gaps(
        &mut self,
        points: &[DVec3],
        (triangles, border): (&[Triangle], &[Border]),
        grain: f64,
    ) -> Vec<[u32; 2]> {
        let mut from: Vec<(u32, u32, u32)> = Vec::with_capacity(2 * border.len());
        from.extend(border.iter().flat_map(|&([a, b], of)| [(a, b, of), (b, a, of)]));
        from.sort_unstable();
        let mut in_gaps = Vec::new();
        for &([a, b], of) in border {
            let [start, end] = [a, b].map_array(|v| points[v as usize]);
            let (along, length) = (end - start, start.distance(end));
            let place = |v: u32| (points[v as usize] - start).dot(along) / length;
            let away = |v: u32| (points[v as usize] - start - along * (place(v) / length)).length();
            let (mut chain, mut of_chain) = (vec![a], vec![of]);
            while chain.len() <= MOST_OF_CHAIN {
                let at = chain[chain.len() - 1];
                let next = &from[from.partition_point(|edge| edge.0 < at)..];
                let next = next.iter().take_while(|edge| edge.0 == at);
                let is_beside = |v: u32| v == b || place(v) < length - grain;
                let next = next.filter(|&&(_, v, other)| {
                    other != of && place(v) > place(at) + grain && is_beside(v)
                });
                let Some(&(_, v, other)) = next.min_by(|a, b| away(a.1).total_cmp(&away(b.1)))
                else {
                    break;
                };
                chain.push(v);
                of_chain.push(other);
                if v == b || away(v) > BESIDE * length {
                    break;
                }
            }
            let inner = chain.iter().skip(1).filter(|v| **v != b);
            let is_open = inner.clone().any(|v| away(*v) > grain);
            // The chain of a thin part that hangs on nothing has the third corner of the triangle.
            let own = triangles.partition_point(|triangle| triangle.number < of);
            let own = triangles.get(own).map_or([b; 3], |triangle| triangle.vertices);
            let is_own = inner.clone().any(|v| own.contains(v));
            if chain.last() == Some(&b) && chain.len() > 2 && is_open && !is_own {
                in_gaps.extend(chain.windows(2).map(|e| [e[0].min(e[1]), e[0].max(e[1])]));
                in_gaps.push([a, b]);
                let polygon = chain.iter().map(|&v| points[v as usize]).collect();
                self.gaps.push(Gap { polygon, triangles: of_chain });
            }
        }
        self.gaps.sort_by_key(|gap| gap.triangles[0]);
        in_gaps.sort_unstable();
        in_gaps
    }

    /// Finds vertices at borders that are at most a grain apart and no corners of one triangle, nor of two faces on each other. For each vertex the first one of
    /// those that it nearly meets, or itself; nothing where there are none.
    fn find_near(
        &mut self,
        points: &[DVec3],
        (triangles, border): (&[Triangle], &[Border]),
        grain: f64,
    ) -> Option<Vec<u32>> {
        let mut vertices: Vec<u32> = border.iter().flat_map(|(ends, _)| *ends).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let boxes: Vec<Box> =
            vertices.iter().map(|&v| Box::around(&[points[v as usize]], grain / 2.0)).collect();
        let mut near: Vec<[u32; 2]> = Vec::new();
        let is_whole = pairs(&boxes, &mut |i, j| {
            let pair = [vertices[i], vertices[j]];
            let [a, b] = pair.map_array(|v| points[v as usize]);
            if a.distance(b) <= grain {
                near.push(pair);
            }
            near.len() < MOST_FOUND
        });
        self.is_cut_short |= !is_whole;
        if near.is_empty() {
            return None;
        }
        near.sort_unstable();
        // A side this short is a side all the same.
        let mut sides = Vec::new();
        for Triangle { vertices: [a, b, c], .. } in triangles {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                let side = [*a.min(b), *a.max(b)];
                sides.extend(near.binary_search(&side).is_ok().then_some(side));
            }
        }
        sides.sort_unstable();
        near.retain(|pair| sides.binary_search(pair).is_err());
        let mut met: Vec<u32> = (0..points.len() as u32).collect();
        // In this order, the vertex that the first of a pair meets is known.
        for [a, b] in near {
            met[b as usize] = met[b as usize].min(met[a as usize]);
        }
        // Two sheets on each other do not meet at a seam: what would make two faces one stays apart.
        let mut merged = Vec::new();
        for Triangle { vertices, .. } in triangles {
            let mut of = vertices.map_array(|v| met[v as usize]);
            of.sort_unstable();
            merged.push((of, *vertices));
        }
        merged.sort_unstable();
        let mut is_apart = vec![false; points.len()];
        for same in merged.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
            same.iter().flat_map(|(_, of)| of).for_each(|v| is_apart[*v as usize] = true);
        }
        for vertex in 0..met.len() {
            if is_apart[vertex] || is_apart[met[vertex] as usize] {
                met[vertex] = vertex as u32;
            }
            let apart = points[vertex].distance(points[met[vertex] as usize]);
            self.near_apart = self.near_apart.max(apart);
        }
        self.list_near(points, border, &met);
        (!self.near.is_empty()).then_some(met)
    }

    /// Lists the places where vertices of borders nearly meet, and what lies between borders there.
    fn list_near(&mut self, points: &[DVec3], border: &[Border], met: &[u32]) {
        let mut is_met = vec![false; points.len()];
        for (vertex, first) in met.iter().enumerate() {
            is_met[*first as usize] |= vertex != *first as usize;
        }
        let mut at: Vec<(u32, u32)> = Vec::new();
        let mut sides = Vec::new();
        for &([a, b], triangle) in border {
            let [of_a, of_b] = [a, b].map_array(|v| met[v as usize]);
            for place in [of_a, of_b].into_iter().filter(|place| is_met[*place as usize]) {
                at.push((place, triangle));
            }
            sides.push(if of_a < of_b {
                ([of_a, of_b], [a, b], triangle)
            } else {
                ([of_b, of_a], [b, a], triangle)
            });
        }
        at.sort_unstable();
        at.dedup();
        for of_place in at.chunk_by(|a, b| a.0 == b.0) {
            let triangles = of_place.iter().map(|(_, triangle)| *triangle).collect();
            self.near.push(edge(points, [of_place[0].0; 2], triangles));
        }
        self.near.sort_by_key(|edge| edge.triangles[0]);
        sides.sort_unstable();
        for same in sides.chunk_by(|a, b| a.0 == b.0) {
            for pair in same.windows(2) {
                let ((_, [a, b], one), (_, [c, d], other)) = (pair[0], pair[1]);
                let polygon = [a, b, d, c].map_array(|v| points[v as usize]).to_vec();
                self.at_near.push(Gap { polygon, triangles: vec![one, other] });
            }
        }
    }

    /// Vertices at a border that lie within the edge of a border.
    fn find_t_junctions(&mut self, points: &[DVec3], border: &[Border], grain: f64) {
        let mut vertices: Vec<u32> = border.iter().flat_map(|(ends, _)| *ends).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let ends = |i: usize| border[i].0.map_array(|v| points[v as usize]);
        let edges = (0..border.len()).map(|i| Box::around(&ends(i), grain));
        let boxes: Vec<Box> = edges
            .chain(vertices.iter().map(|&v| Box::around(&[points[v as usize]], 0.0)))
            .collect();
        let mut on_edges: Vec<(usize, f64, DVec3)> = Vec::new();
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
                let triangles = vec![border[edge].1];
                self.t_junctions.push(Edge { ends: [point, point], triangles });
                on_edges.push((edge, place, point));
            }
            self.t_junctions.len() < MOST_FOUND
        });
        self.is_cut_short |= !is_whole;
        self.t_junctions.sort_by_key(|edge| edge.triangles[0]);
        on_edges.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        for of_edge in on_edges.chunk_by(|a, b| a.0 == b.0) {
            let number = of_edge[0].0;
            let mut polygon = ends(number).to_vec();
            polygon.splice(1..1, of_edge.iter().map(|(.., point)| *point));
            self.at_t_junctions.push(Gap { polygon, triangles: vec![border[number].1] });
        }
    }

    /// Pairs of faces in one plane that cover a part of it together.
    fn find_overlaps(&mut self, triangles: &[Triangle], corners: &[[DVec3; 3]], grain: f64) {
        let planes: Vec<Plane> = corners.iter().map(Plane::of).collect();
        let boxes: Vec<Box> = corners.iter().map(|corners| Box::around(corners, grain)).collect();
        let is_whole = pairs(&boxes, &mut |i, j| {
            let (a, b) = (&planes[i], &planes[j]);
            let (first, second) = (triangles[i].face, triangles[j].face);
            if first == second {
                return true;
            }
            let is_flat = a.holds(&corners[j], grain) && b.holds(&corners[i], grain);
            if is_flat && !a.parts(&corners[j], grain) && !b.parts(&corners[i], grain) {
                self.overlaps.push([first.max(second), first.min(second)]);
            }
            self.overlaps.len() < MOST_FOUND
        });
        self.is_cut_short |= !is_whole;
        self.overlaps.sort_unstable();
        self.overlaps.dedup();
    }
}

fn edge(points: &[DVec3], ends: [u32; 2], triangles: Vec<u32>) -> Edge {
    Edge { ends: ends.map_array(|v| points[v as usize]), triangles }
}

/// For each triangle the first one of its face.
fn first_triangles(scene: &Scene, origins: &[Origin]) -> Vec<u32> {
    let mut first: Vec<u32> = Vec::with_capacity(scene.triangles());
    let mut before = None;
    for face in faces(scene, origins) {
        let number = first.len() as u32;
        let same = first.last().filter(|_| before == Some(face));
        first.push(same.copied().unwrap_or(number));
        before = Some(face);
    }
    first
}

/// The positions that triangles use, each once, and the triangles.
fn weld(scene: &Scene, face_of: &[u32]) -> (Vec<DVec3>, Vec<Triangle>) {
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
    let numbered = triangles.zip(0..).zip(face_of);
    let triangle = |((vertices, number), &face)| Triangle { vertices, number, face };
    (points, numbered.map(triangle).collect())
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
        let triangle = |number| Triangle { vertices: [0; 3], number, face: number };
        let triangles: Vec<_> = (0..count).map(triangle).collect();
        let mut shape = Shape::default();
        shape.find_overlaps(&triangles, &corners, 1e-6);
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
