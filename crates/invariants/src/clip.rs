//! Invariants 32 to 35: clipping in homogeneous space.

use glam::{DVec2, DVec4};

use super::Outcome;
use super::implementations::{Implementations, hits};
use super::source::ClipInput;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Viewport;
use rasterproof_render::pipeline::clip::{ClipPlane, MOST_VERTICES, Outcode, outcode};

/// A vertex that carries two numbers, which clipping interpolates.
type Vertex = ClipVertex<DVec2>;

/// The triangle of an input, whose values follow from the number of each vertex, so that no two are the same.
fn vertices(input: &ClipInput) -> [Vertex; 3] {
    let mut number = 0.0;
    input.vertices.map_array(|[x, y, z, w]| {
        number += 1.0;
        let position = DVec4::new(x.into(), y.into(), z.into(), w.into());
        ClipVertex { position, varying: DVec2::new(number, -3.0 * number * number) }
    })
}

/// All numbers of a vertex, so that two vertices with the same bits are the same.
fn bits(vertex: &Vertex) -> [u64; 6] {
    let [x, y, z, w] = vertex.position.to_array();
    let [a, b] = vertex.varying.to_array();
    // The two zeros are the same place.
    [x, y, z, w, a, b].map(|v| (v + 0.0).to_bits())
}

/// 32: no plane changes a triangle that lies inside all of them.
pub(super) fn inside(subject: &Implementations, input: &ClipInput) -> Outcome {
    let triangle = vertices(input);
    if triangle.iter().any(|vertex| outcode(vertex) != 0) {
        return Ok(0);
    }
    let clipped = (subject.clip)(&triangle, Outcode::MAX);
    let same = clipped.len() == 3
        && clipped.iter().zip(&triangle).all(|(actual, target)| bits(actual) == bits(target));
    if same { Ok(3) } else { Err(format!("{triangle:?} became {clipped:?}")) }
}

/// The vertices of what clipping leaves of a triangle, in an order that does not depend on its own.
fn clipped_set(subject: &Implementations, triangle: [Vertex; 3]) -> Vec<[u64; 6]> {
    let mut set: Vec<_> = (subject.clip)(&triangle, Outcode::MAX).iter().map(bits).collect();
    set.sort_unstable();
    set
}

/// 33: the reversed triangle has the same vertices; and what becomes of an edge alone is found, bit
/// for bit, in every triangle that has the edge: a neighbour makes the same vertices of it.
pub(super) fn reversed(subject: &Implementations, input: &ClipInput) -> Outcome {
    let [a, b, c] = vertices(input);
    let whole = clipped_set(subject, [a, b, c]);
    let turned = clipped_set(subject, [c, b, a]);
    if whole != turned {
        return Err(format!("{} vertices one way, other bits or numbers the other", whole.len()));
    }
    for (edge, from, to) in [("first", a, b), ("second", b, c), ("third", c, a)] {
        let alone = clipped_set(subject, [from, to, to]);
        if let Some(missing) = alone.iter().find(|vertex| !whole.contains(vertex)) {
            let missing = missing.map(f64::from_bits);
            return Err(format!("the {edge} edge alone has the vertex {missing:?}"));
        }
    }
    Ok(whole.len() as u64)
}

/// 35: new vertices lie on a plane exactly, no vertex lies outside any, and there are at most ten.
pub(super) fn planes(subject: &Implementations, input: &ClipInput) -> Outcome {
    let triangle = vertices(input);
    let clipped = (subject.clip)(&triangle, Outcode::MAX);
    if clipped.len() > MOST_VERTICES {
        return Err(format!("{} vertices", clipped.len()));
    }
    // A vertex of the triangle may lie anywhere inside; any other one is where an edge meets a plane.
    let old = triangle.map_array(|vertex| bits(&vertex));
    for vertex in &clipped {
        let mut is_on_a_plane = false;
        for plane in ClipPlane::ALL {
            let distance = plane.distance(vertex);
            if distance < 0.0 {
                return Err(format!("{vertex:?} lies outside {plane:?}"));
            }
            is_on_a_plane |= distance == 0.0;
        }
        if !old.contains(&bits(vertex)) && !is_on_a_plane {
            return Err(format!("{vertex:?} is new and on no plane"));
        }
    }
    Ok(clipped.len() as u64)
}

/// The side of the window in which coverage is compared.
const SIDE_PX: u32 = 16;

/// 34: a pixel is covered once if its centre sees the triangle between near and far plane, else
/// never.
///
/// The truth needs no clipping (Olano and Greer 1997): with l_i the cross product of the other two
/// vertices' (x, y, w), the centre (x, y, 1) lies on the visible side of edge i iff l_i (x, y, 1)
/// has the sign of the determinant; z + w and w - z are sums of the same numbers, so near and far
/// plane are lines too. Vertices are whole numbers below 2^6 and centres odd 32nds, so everything
/// is a whole number below 2^40, exactly. Snapping moves a vertex by at most 1/512 px in x and y, a
/// border thus by less than sqrt(2)/512 < 1/256 px; centres nearer than 1/256 px to a border are
/// not asked.
pub(super) fn coverage(subject: &Implementations, input: &ClipInput) -> Outcome {
    let window = PixelRect::window(SIDE_PX, SIDE_PX);
    let clipped = (subject.clip)(&vertices(input), Outcode::MAX);
    let viewport = Viewport::new(window);
    // What clipping leaves, as the pipeline draws it: a fan around its first vertex.
    let mut corners = Vec::with_capacity(clipped.len());
    for vertex in &clipped {
        match viewport.place(vertex) {
            Ok(placed) => corners.push(placed.position),
            Err(refusal) => return Err(format!("a clipped vertex {refusal}")),
        }
    }
    let fan = (2..corners.len()).map(|i| [corners[0], corners[i - 1], corners[i]]);
    let drawn = hits(&*subject.oracle, fan, window);
    // A triangle that is seen from its edge has no sides, and nothing of it is drawn.
    let Some(lines) = lines(input) else { return Ok(0) };
    let mut compared = 0;
    for (y_px, row) in drawn.rows() {
        for (x_px, &hit) in (0..).zip(row) {
            // The centre in 16ths of the half side, y up, and 16 for 1.
            let side = i64::from(SIDE_PX);
            let centre = [2 * i64::from(x_px) + 1 - side, side - 2 * i64::from(y_px) - 1, side];
            let (mut visible, mut near_border) = (true, false);
            for line in &lines {
                let value = dot(*line, centre);
                visible &= value > 0;
                // One pixel moves the first two by 2.
                let step = (2 * line[0].abs()).max(2 * line[1].abs());
                near_border |= 256 * i128::from(value.abs()) <= 2 * i128::from(step);
            }
            if near_border {
                continue;
            }
            compared += 1;
            if u8::from(visible) != hit {
                return Err(format!("pixel ({x_px}, {y_px}): {hit} hits, visible: {visible}"));
            }
        }
    }
    Ok(compared)
}

/// The value of a line at a point: 0 on the line, positive on its inside.
fn dot(p: [i64; 3], q: [i64; 3]) -> i64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

/// The line through two points in homogeneous coordinates.
fn cross(p: [i64; 3], q: [i64; 3]) -> [i64; 3] {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

/// The borders of what is visible as lines that are positive inside: three edges, near, far.
fn lines(input: &ClipInput) -> Option<[[i64; 3]; 5]> {
    let [a, b, c] = input.vertices.map_array(|[x, y, _, w]| [x, y, w].map_array(i64::from));
    let edges = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, edges[0]);
    if determinant == 0 {
        return None;
    }
    let edges = edges.map_array(|line| line.map_array(|v| v * determinant.signum()));
    // w + z and w - z of the three vertices, each the weight of the line of the edge that is opposite to it.
    let (mut near, mut far) = ([0; 3], [0; 3]);
    for (line, [_, _, z, w]) in edges.iter().zip(input.vertices) {
        for k in 0..3 {
            near[k] += line[k] * i64::from(w + z);
            far[k] += line[k] * i64::from(w - z);
        }
    }
    let [first, second, third] = edges;
    Some([first, second, third, near, far])
}
