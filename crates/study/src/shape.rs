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

impl Triangle {
    /// Its sides, each with the smaller vertex first, so that two triangles name a shared side alike.
    fn sides(&self) -> [[u32; 2]; 3] {
        let [a, b, c] = self.vertices;
        [side_between(a, b), side_between(b, c), side_between(c, a)]
    }
}

/// The smaller vertex comes first.
fn side_between(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// An edge of one face alone, between two vertices, with the triangle that has it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Border {
    ends: [u32; 2],
    triangle: u32,
}

/// A mesh without what is no face and without faces that repeat an earlier one.
struct Welded {
    points: Vec<DVec3>,
    triangles: Vec<Triangle>,
    /// For each triangle of the scene whether it has an area.
    is_solid: Vec<bool>,
    borders: Vec<Border>,
    /// How far apart two points may be that count as one.
    grain: f64,
}

impl Welded {
    /// The vertices at borders, each once, sorted.
    fn vertices_of_borders(&self) -> Vec<u32> {
        let mut vertices: Vec<u32> = self.borders.iter().flat_map(|border| border.ends).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }

    /// Where a vertex is.
    fn point(&self, vertex: u32) -> DVec3 {
        self.points[vertex as usize]
    }

    /// Where a border begins and ends.
    fn ends(&self, border: &Border) -> [DVec3; 2] {
        positions(&self.points, border.ends)
    }

    /// Where the vertices of a polygon are.
    fn polygon(&self, vertices: &[u32]) -> Vec<DVec3> {
        vertices.iter().map(|vertex| self.point(*vertex)).collect()
    }
}

/// The positions of the ends of an edge.
fn positions(points: &[DVec3], ends: [u32; 2]) -> [DVec3; 2] {
    [points[ends[0] as usize], points[ends[1] as usize]]
}

/// The positions of the corners of a triangle.
fn corners_of(points: &[DVec3], triangle: &Triangle) -> [DVec3; 3] {
    triangle.vertices.map_array(|vertex| points[vertex as usize])
}

/// The vertices of a face as a part of one list for all faces, and the first triangle of the face.
struct FaceVertices {
    part: std::ops::Range<usize>,
    face: u32,
}

/// An edge of a triangle, in the order in which equal edges, and those of one face, stand together.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct EdgeOfTriangle {
    ends: [u32; 2],
    face: u32,
    triangle: u32,
}

/// A border between places that vertices nearly meet in: the first vertex of each place, and the own vertices there.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct SideOfSeam {
    places: [u32; 2],
    ends: [u32; 2],
    triangle: u32,
}

/// A vertex on a border that is none of its ends.
struct OnBorder {
    /// The number of the border.
    border: usize,
    /// How far it lies from the first end, along the border.
    place: f64,
    point: DVec3,
}

/// A line from one end of a border to the other, by which points are placed.
struct Ruler {
    start: DVec3,
    along: DVec3,
    length: f64,
}

impl Ruler {
    fn new([start, end]: [DVec3; 2]) -> Self {
        Self { start, along: end - start, length: start.distance(end) }
    }

    /// How far a point lies from the start, along the line.
    fn place(&self, point: DVec3) -> f64 {
        (point - self.start).dot(self.along) / self.length
    }

    /// How far a point is from the line.
    fn distance(&self, point: DVec3) -> f64 {
        (point - self.start - self.along * (self.place(point) / self.length)).length()
    }
}

impl Shape {
    /// Finds all of it. What is no face, or the same face again, is found first and left out of what follows.
    pub fn of(scene: &Scene, origins: &[Origin]) -> Self {
        let mut shape = Self { face_of: first_triangles(scene, origins), ..Self::default() };
        let mut mesh = shape.weld(scene);
        if let Some(met) = shape.find_near(&mesh) {
            // With these corners merged, borders are those that are open still.
            for triangle in &mut mesh.triangles {
                triangle.vertices = triangle.vertices.map_array(|v| met[v as usize]);
            }
            mesh.borders = shape.find_borders(&mesh.points, &mesh.triangles);
        }
        shape.find_t_junctions(&mesh);
        // A border beside a chain of others is listed as a gap, and every other one as open.
        let in_gaps = shape.find_gaps(&mesh);
        for border in &mesh.borders {
            if in_gaps.binary_search(&border.ends).is_err() {
                shape.borders.push(edge(&mesh.points, border.ends, vec![border.triangle]));
            }
        }
        shape.borders.sort_by_key(|edge| edge.triangles[0]);
        // What has no area covers no part of a plane, so it overlaps nothing.
        let Welded { points, mut triangles, is_solid, grain, .. } = mesh;
        triangles.retain(|triangle| is_solid[triangle.number as usize]);
        let corners: Vec<[DVec3; 3]> =
            triangles.iter().map(|triangle| corners_of(&points, triangle)).collect();
        shape.find_overlaps(&triangles, &corners, grain);
        shape
    }

    /// The places where corners nearly meet, and nothing that is looked for after them.
    pub fn nearly_meeting(scene: &Scene, origins: &[Origin]) -> Vec<Edge> {
        let mut shape = Self { face_of: first_triangles(scene, origins), ..Self::default() };
        let mesh = shape.weld(scene);
        shape.find_near(&mesh);
        shape.near
    }

    /// Welds the mesh, and finds triangles without area, slivers, duplicates and crowded edges.
    fn weld(&mut self, scene: &Scene) -> Welded {
        let (points, mut triangles) = merge_positions(scene, &self.face_of);
        let mut is_solid = Vec::with_capacity(triangles.len());
        for triangle in &triangles {
            let corners = corners_of(&points, triangle);
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
        for triangle in &triangles {
            is_face[triangle.face as usize] |= is_solid[triangle.number as usize];
        }
        triangles.retain(|triangle| is_face[triangle.face as usize]);
        // A face that repeats an earlier one would make each of its edges one of three faces or more.
        self.find_duplicates(&triangles);
        for [later, _] in &self.duplicates {
            is_face[*later as usize] = false;
        }
        triangles.retain(|triangle| is_face[triangle.face as usize]);
        let grain = GRAIN * size(&points);
        let borders = self.find_borders(&points, &triangles);
        Welded { points, triangles, is_solid, borders, grain }
    }

    /// Finds faces with the vertices of an earlier face.
    fn find_duplicates(&mut self, triangles: &[Triangle]) {
        // One list holds the vertices of all faces, sorted and each once within a face: a list for each would be slow.
        let mut vertices: Vec<u32> = Vec::with_capacity(3 * triangles.len());
        let mut faces: Vec<FaceVertices> = Vec::new();
        for face in triangles.chunk_by(|a, b| a.face == b.face) {
            let first = vertices.len();
            for triangle in face {
                vertices.extend(triangle.vertices);
            }
            vertices[first..].sort_unstable();
            let mut end = first;
            for i in first..vertices.len() {
                if i == first || vertices[i] != vertices[i - 1] {
                    vertices[end] = vertices[i];
                    end += 1;
                }
            }
            vertices.truncate(end);
            faces.push(FaceVertices { part: first..end, face: face[0].face });
        }
        // Faces with the same vertices now stand together, the earliest one first.
        let of = |face: &FaceVertices| &vertices[face.part.clone()];
        faces.sort_unstable_by(|a, b| of(a).cmp(of(b)).then(a.face.cmp(&b.face)));
        for same in faces.chunk_by(|a, b| of(a) == of(b)) {
            for later in &same[1..] {
                self.duplicates.push([later.face, same[0].face]);
            }
        }
        self.duplicates.sort_unstable();
    }

    /// Finds edges that have not two faces; returns the borders.
    fn find_borders(&mut self, points: &[DVec3], triangles: &[Triangle]) -> Vec<Border> {
        let mut edges: Vec<EdgeOfTriangle> = Vec::with_capacity(3 * triangles.len());
        for of @ Triangle { face, number: triangle, .. } in triangles {
            for ends in of.sides() {
                if ends[0] != ends[1] {
                    edges.push(EdgeOfTriangle { ends, face: *face, triangle: *triangle });
                }
            }
        }
        edges.sort_unstable();
        self.crowded.clear();
        let mut borders = Vec::new();
        for same in edges.chunk_by(|a, b| a.ends == b.ends) {
            let ends = same[0].ends;
            let mut of = Vec::new();
            for of_face in same.chunk_by(|a, b| a.face == b.face) {
                // Where a face was cut, its triangles have the edge twice.
                if of_face.len() % 2 == 1 {
                    of.push(of_face[0].triangle);
                }
            }
            match of[..] {
                [triangle] => borders.push(Border { ends, triangle }),
                [] | [_, _] => {}
                _ => self.crowded.push(edge(points, ends, of)),
            }
        }
        self.crowded.sort_by_key(|e| (std::cmp::Reverse(e.triangles.len()), e.triangles[0]));
        borders
    }

    /// Finds borders with a chain of borders beside them that begins and ends where they do: the seam of two levels of
    /// detail. Returns all of their edges, sorted.
    fn find_gaps(&mut self, mesh: &Welded) -> Vec<[u32; 2]> {
        // Each border in both directions, so that those from one vertex stand together.
        let mut steps: Vec<Border> = Vec::with_capacity(2 * mesh.borders.len());
        for &Border { ends: [a, b], triangle } in &mesh.borders {
            steps.push(Border { ends: [a, b], triangle });
            steps.push(Border { ends: [b, a], triangle });
        }
        steps.sort_unstable();
        let mut in_gaps = Vec::new();
        for border in &mesh.borders {
            let Some((chain, triangles)) = chain_beside(mesh, &steps, border) else { continue };
            for step in chain.windows(2) {
                in_gaps.push(side_between(step[0], step[1]));
            }
            in_gaps.push(border.ends);
            self.gaps.push(Gap { polygon: mesh.polygon(&chain), triangles });
        }
        self.gaps.sort_by_key(|gap| gap.triangles[0]);
        in_gaps.sort_unstable();
        in_gaps
    }

    /// Finds vertices at borders that are at most a grain apart and no corners of one triangle, nor of two faces on each
    /// other. For each vertex the first one of those that it nearly meets, or itself; nothing where there are none.
    fn find_near(&mut self, mesh: &Welded) -> Option<Vec<u32>> {
        let mut near = self.pairs_within_a_grain(mesh);
        if near.is_empty() {
            return None;
        }
        // A side this short is a side all the same.
        let mut sides = Vec::new();
        for triangle in &mesh.triangles {
            for side in triangle.sides() {
                if near.binary_search(&side).is_ok() {
                    sides.push(side);
                }
            }
        }
        sides.sort_unstable();
        near.retain(|pair| sides.binary_search(pair).is_err());
        // Each vertex meets itself, until a pair says otherwise.
        let mut met: Vec<u32> = (0..mesh.points.len() as u32).collect();
        for [a, b] in near {
            // In this order, the vertex that the first of a pair meets is known.
            met[b as usize] = met[b as usize].min(met[a as usize]);
        }
        let is_apart = vertices_of_sheets(mesh, &met);
        for vertex in 0..met.len() {
            if is_apart[vertex] || is_apart[met[vertex] as usize] {
                met[vertex] = vertex as u32;
            }
            let apart = mesh.points[vertex].distance(mesh.point(met[vertex]));
            self.near_apart = self.near_apart.max(apart);
        }
        self.list_near(mesh, &met);
        (!self.near.is_empty()).then_some(met)
    }

    /// Pairs of vertices at borders that are at most a grain apart, sorted, the smaller one first.
    fn pairs_within_a_grain(&mut self, mesh: &Welded) -> Vec<[u32; 2]> {
        let vertices = mesh.vertices_of_borders();
        // Boxes of half a grain around two points meet where the points are a grain apart, or less in each axis.
        let around = |&vertex: &u32| Box::around(&[mesh.point(vertex)], mesh.grain / 2.0);
        let boxes: Vec<Box> = vertices.iter().map(around).collect();
        let mut near: Vec<[u32; 2]> = Vec::new();
        let is_whole = pairs(&boxes, &mut |i, j| {
            let pair = [vertices[i], vertices[j]];
            if mesh.point(pair[0]).distance(mesh.point(pair[1])) <= mesh.grain {
                near.push(pair);
            }
            near.len() < MOST_FOUND
        });
        self.is_cut_short |= !is_whole;
        near.sort_unstable();
        near
    }

    /// Lists the places where vertices of borders nearly meet, and what lies between borders there.
    fn list_near(&mut self, mesh: &Welded, met: &[u32]) {
        let mut is_met = vec![false; mesh.points.len()];
        for (vertex, first) in met.iter().enumerate() {
            is_met[*first as usize] |= vertex != *first as usize;
        }
        // Each place with the triangles of borders that end there, and each border between places.
        let mut at: Vec<(u32, u32)> = Vec::new();
        let mut sides: Vec<SideOfSeam> = Vec::new();
        for &Border { ends: [a, b], triangle } in &mesh.borders {
            let [of_a, of_b] = [met[a as usize], met[b as usize]];
            for place in [of_a, of_b] {
                if is_met[place as usize] {
                    at.push((place, triangle));
                }
            }
            // Both sides of a seam have their ends in one order, which is that of the places.
            let (places, ends) =
                if of_a < of_b { ([of_a, of_b], [a, b]) } else { ([of_b, of_a], [b, a]) };
            sides.push(SideOfSeam { places, ends, triangle });
        }
        at.sort_unstable();
        at.dedup();
        for of_place in at.chunk_by(|a, b| a.0 == b.0) {
            let triangles = of_place.iter().map(|(_, triangle)| *triangle).collect();
            self.near.push(edge(&mesh.points, [of_place[0].0; 2], triangles));
        }
        self.near.sort_by_key(|edge| edge.triangles[0]);
        // Borders between the same two places are the sides of a seam: what lies between two of them is a quadrilateral.
        sides.sort_unstable();
        for same in sides.chunk_by(|a, b| a.places == b.places) {
            for pair in same.windows(2) {
                let ([a, b], [c, d]) = (pair[0].ends, pair[1].ends);
                let triangles = vec![pair[0].triangle, pair[1].triangle];
                self.at_near.push(Gap { polygon: mesh.polygon(&[a, b, d, c]), triangles });
            }
        }
    }

    /// Vertices at a border that lie within the edge of a border.
    fn find_t_junctions(&mut self, mesh: &Welded) {
        let (borders, grain) = (&mesh.borders, mesh.grain);
        let vertices = mesh.vertices_of_borders();
        // One list for one search: first the boxes of all borders, then those of the vertices.
        let mut boxes: Vec<Box> = Vec::with_capacity(borders.len() + vertices.len());
        for border in borders {
            boxes.push(Box::around(&mesh.ends(border), grain));
        }
        for &vertex in &vertices {
            boxes.push(Box::around(&[mesh.point(vertex)], 0.0));
        }
        let mut on_borders: Vec<OnBorder> = Vec::new();
        let is_whole = pairs(&boxes, &mut |i, j| {
            let (border, vertex) = (i.min(j), i.max(j));
            if border >= borders.len() || vertex < borders.len() {
                return true;
            }
            let point = mesh.point(vertices[vertex - borders.len()]);
            let ruler = Ruler::new(mesh.ends(&borders[border]));
            let place = ruler.place(point);
            if ruler.distance(point) <= grain && place > grain && place < ruler.length - grain {
                let triangles = vec![borders[border].triangle];
                self.t_junctions.push(Edge { ends: [point, point], triangles });
                on_borders.push(OnBorder { border, place, point });
            }
            self.t_junctions.len() < MOST_FOUND
        });
        self.is_cut_short |= !is_whole;
        self.t_junctions.sort_by_key(|edge| edge.triangles[0]);
        // The vertices on one border, in their order along it, make a thin polygon with its ends.
        on_borders.sort_by(|a, b| a.border.cmp(&b.border).then(a.place.total_cmp(&b.place)));
        for on_border in on_borders.chunk_by(|a, b| a.border == b.border) {
            let border = &borders[on_border[0].border];
            let [start, end] = mesh.ends(border);
            let mut polygon = vec![start];
            polygon.extend(on_border.iter().map(|on| on.point));
            polygon.push(end);
            self.at_t_junctions.push(Gap { polygon, triangles: vec![border.triangle] });
        }
    }

    /// Pairs of faces in one plane that cover a part of it together.
    fn find_overlaps(&mut self, triangles: &[Triangle], corners: &[[DVec3; 3]], grain: f64) {
        let planes: Vec<Plane> = corners.iter().map(Plane::of).collect();
        let boxes: Vec<Box> = corners.iter().map(|corners| Box::around(corners, grain)).collect();
        let is_whole = pairs(&boxes, &mut |i, j| {
            // The triangles of one face share its plane, and each of its pixels is drawn by one of them.
            let (a, b) = (&planes[i], &planes[j]);
            let (first, second) = (triangles[i].face, triangles[j].face);
            if first == second {
                return true;
            }
            // Each lies in the plane of the other, and no side of either one keeps them apart.
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

/// An edge between two vertices.
fn edge(points: &[DVec3], ends: [u32; 2], triangles: Vec<u32>) -> Edge {
    Edge { ends: positions(points, ends), triangles }
}

/// The chain of borders beside a border, from its first end to its second one, with the triangle of the border and those of the
/// chain; nothing where there is none, or where there is nothing between the two.
fn chain_beside(mesh: &Welded, steps: &[Border], border: &Border) -> Option<(Vec<u32>, Vec<u32>)> {
    let &Border { ends: [a, b], triangle: own } = border;
    let ruler = Ruler::new(mesh.ends(border));
    let mut chain = vec![a];
    let mut triangles = vec![own];
    while chain.len() <= MOST_OF_CHAIN {
        let at = chain[chain.len() - 1];
        let from = ruler.place(mesh.point(at));
        // Of the borders that lead on from here, towards the end and not beyond it, take the one closest to the border.
        let mut next: Option<(f64, u32, u32)> = None;
        for &Border { ends: [start, to], triangle } in
            &steps[steps.partition_point(|step| step.ends[0] < at)..]
        {
            if start != at {
                break;
            }
            let place = ruler.place(mesh.point(to));
            let is_beside = to == b || place < ruler.length - mesh.grain;
            if triangle == own || place <= from + mesh.grain || !is_beside {
                continue;
            }
            let distance = ruler.distance(mesh.point(to));
            if next.is_none_or(|(least, ..)| distance.total_cmp(&least).is_lt()) {
                next = Some((distance, to, triangle));
            }
        }
        let Some((distance, to, triangle)) = next else { break };
        chain.push(to);
        triangles.push(triangle);
        if to == b || distance > BESIDE * ruler.length {
            break;
        }
    }
    // It must lead to the other end by vertices between, one of which lies off the border.
    let [_, inner @ .., last] = &chain[..] else { return None };
    let is_open = inner.iter().any(|&v| ruler.distance(mesh.point(v)) > mesh.grain);
    if *last != b || inner.is_empty() || !is_open {
        return None;
    }
    // The chain of a thin part that hangs on nothing has the third corner of the triangle.
    let number = mesh.triangles.partition_point(|triangle| triangle.number < own);
    let corners = mesh.triangles.get(number).map_or([b; 3], |triangle| triangle.vertices);
    (!inner.iter().any(|v| corners.contains(v))).then_some((chain, triangles))
}

/// For each vertex whether it belongs to a triangle that would be the same as another one if vertices that nearly meet
/// were merged. Such triangles are two sheets on each other, which do not meet at a seam, so their vertices stay apart.
fn vertices_of_sheets(mesh: &Welded, met: &[u32]) -> Vec<bool> {
    let mut merged = Vec::new();
    for triangle in &mesh.triangles {
        let mut vertices = triangle.vertices.map_array(|v| met[v as usize]);
        vertices.sort_unstable();
        merged.push((vertices, triangle.vertices));
    }
    merged.sort_unstable();
    let mut is_apart = vec![false; mesh.points.len()];
    for same in merged.chunk_by(|a, b| a.0 == b.0) {
        if same.len() > 1 {
            for vertex in same.iter().flat_map(|(_, vertices)| vertices) {
                is_apart[*vertex as usize] = true;
            }
        }
    }
    is_apart
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

/// A position that triangles use, in the order in which equal ones stand together.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct UsedPosition {
    /// Of its coordinates.
    bits: [u64; 3],
    /// The same for items that are moved alike: where they are not, the same numbers are not the same position.
    group: usize,
    item: usize,
    number: usize,
}

/// The positions that triangles use, each once, and the triangles.
fn merge_positions(scene: &Scene, face_of: &[u32]) -> (Vec<DVec3>, Vec<Triangle>) {
    let mut used: Vec<UsedPosition> = Vec::new();
    let mut is_moved = false;
    for (item, of) in scene.items.iter().enumerate() {
        // The number of items before the first one that is moved as this one is.
        let group = scene.items.iter().take_while(|other| other.model != of.model).count();
        is_moved |= group > 0;
        let mut is_used = vec![false; of.mesh.positions.len()];
        for number in of.mesh.triangles.positions().as_flattened() {
            is_used[*number as usize] = true;
        }
        for (number, position) in of.mesh.positions.iter().enumerate() {
            if is_used[number] {
                // -0 is 0.
                let bits = (*position + DVec3::ZERO).to_array().map_array(f64::to_bits);
                used.push(UsedPosition { bits, group, item, number });
            }
        }
    }
    used.sort_unstable();
    // Equal positions become one vertex, which each of them is replaced by.
    let mut points = Vec::new();
    let mut vertex_of: Vec<Vec<u32>> = Vec::with_capacity(scene.items.len());
    for item in &scene.items {
        vertex_of.push(vec![0; item.mesh.positions.len()]);
    }
    for same in used.chunk_by(|a, b| (a.bits, a.group) == (b.bits, b.group)) {
        for one in same {
            vertex_of[one.item][one.number] = points.len() as u32;
        }
        let position = DVec3::from_array(same[0].bits.map_array(f64::from_bits));
        let model = &scene.items[same[0].item].model;
        points.push(if is_moved { model.transform_point3(position) } else { position });
    }
    let mut triangles = Vec::with_capacity(face_of.len());
    for (item, vertex_of) in scene.items.iter().zip(&vertex_of) {
        for numbers in item.mesh.triangles.positions() {
            let vertices = numbers.map_array(|number| vertex_of[number as usize]);
            let number = triangles.len() as u32;
            triangles.push(Triangle { vertices, number, face: face_of[number as usize] });
        }
    }
    (points, triangles)
}

/// The diagonal of the box around all points.
fn size(points: &[DVec3]) -> f64 {
    let bounds = Box::around(points, 0.0);
    if points.is_empty() { 0.0 } else { (bounds.max - bounds.min).length() }
}

/// Whether three points lie on a line, decided exactly: then they do so in each of three projections.
fn has_no_area(corners: [DVec3; 3]) -> bool {
    let mut is_flat = true;
    for [x, y] in [[0, 1], [1, 2], [2, 0]] {
        let [a, b, c] = corners.map_array(|p| Coord { x: p[x], y: p[y] });
        is_flat &= orient2d(a, b, c) == 0.0;
    }
    is_flat
}

/// The longest side over the height on it.
fn aspect([a, b, c]: [DVec3; 3]) -> f64 {
    let longest =
        (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    // The height is the doubled area over the longest side.
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

    /// Whether a triangle lies in the plane.
    fn holds(&self, corners: &[DVec3; 3], grain: f64) -> bool {
        let (from, _) = self.sides[0];
        corners.iter().all(|corner| (*corner - from).dot(self.normal).abs() <= grain)
    }

    /// Whether a triangle lies beyond one of the sides.
    fn parts(&self, corners: &[DVec3; 3], grain: f64) -> bool {
        self.sides.iter().any(|(from, inwards)| {
            corners.iter().all(|corner| (*corner - *from).dot(*inwards) <= grain)
        })
    }
}

/// A box along the axes.
#[derive(Clone, Copy)]
struct Box {
    min: DVec3,
    max: DVec3,
}

impl Box {
    /// The smallest box of some points, larger by a margin on each side; without points one that meets none.
    fn around(points: &[DVec3], margin: f64) -> Self {
        let mut tight = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        for point in points {
            tight.min = tight.min.min(*point);
            tight.max = tight.max.max(*point);
        }
        Self { min: tight.min - margin, max: tight.max + margin }
    }

    /// Whether both have a point in common; touching is enough.
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
    // The average length of a box as a share of all: the smaller, the fewer boxes begin before another one ends. Where
    // all is flat this is no number, and no such axis is taken unless all are.
    let shares = sums / (max - min);
    let mut axis = 0;
    let mut least = f64::MAX;
    for (number, share) in shares.to_array().into_iter().enumerate() {
        if share < least {
            (axis, least) = (number, share);
        }
    }
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&a, &b| boxes[a].min[axis].total_cmp(&boxes[b].min[axis]));
    let sorted: Vec<Box> = order.iter().map(|&i| boxes[i]).collect();
    // From its place on, a box can meet only those that begin before it ends, and these come next.
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
