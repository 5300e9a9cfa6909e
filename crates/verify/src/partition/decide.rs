//! The decision about one polygon and its triangles.

use std::cmp::Ordering;

use super::exact::{orientation, sides};
use super::{Fault, FaultKind, Faults, Options, Point, Triangle, Winding, key, order};

/// A directed edge by its lower end and its upper end, and whether it runs from the lower to the upper one (1) or back (-1).
#[derive(Clone, Copy)]
struct Edge {
    ends: [Point; 2],
    along: i64,
}

impl Edge {
    fn new(from: Point, to: Point) -> Self {
        if order(&from, &to).is_lt() {
            Self { ends: [from, to], along: 1 }
        } else {
            Self { ends: [to, from], along: -1 }
        }
    }
}

/// Compares the triangles with the boundary of the region; the module documentation has the argument.
pub(super) fn decide(boundary: &[[Point; 2]], triangles: &[Triangle], options: &Options) -> Faults {
    let mut finding = Faults::default();
    let mut add = |fault: Fault| finding.add(fault, options);
    // Triangles with an area, turned counterclockwise; and those without, as they are.
    let (mut whole, mut flat) = (Vec::new(), Vec::new());
    let mut signs = Vec::new();
    for (number, corners) in triangles.iter().enumerate() {
        let corners = corners.map(key);
        if !corners.iter().flatten().all(|value| value.is_finite()) {
            add(Fault::of_triangle(FaultKind::NotFinite, number, &corners));
            continue;
        }
        let [a, b, c] = corners;
        let sign = orientation(a, b, c);
        match sign {
            Ordering::Equal => {
                flat.push(corners);
                add(Fault::of_triangle(FaultKind::Degenerate, number, &corners));
                continue;
            }
            Ordering::Greater => whole.push((number, corners)),
            Ordering::Less => whole.push((number, [a, c, b])),
        }
        signs.push(Signed { number, corners, sign });
    }
    let expected = expected_sign(&signs, options.terms.winding);
    for Signed { number, corners, sign } in &signs {
        if expected.is_some_and(|expected| *sign != expected) {
            add(Fault::of_triangle(FaultKind::Flipped, *number, corners));
        }
    }
    // A flat triangle has no sign of its own, and is turned as the others are expected to be.
    if expected == Some(Ordering::Less) {
        for [_, b, c] in &mut flat {
            std::mem::swap(b, c);
        }
    }
    // The boundary runs the other way, so that it cancels with the triangles along it.
    let mut edges = Vec::new();
    for &[from, to] in boundary {
        edges.push(Edge::new(to, from));
    }
    for [a, b, c] in whole.iter().map(|(_, corners)| *corners).chain(flat) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            if from != to {
                edges.push(Edge::new(from, to));
            }
        }
    }
    let left = cancelled(edges);
    let mut add = |fault: Fault| finding.add(fault, options);
    for line in by_line(left) {
        junctions(&line, &mut add);
        for ends in survivors(&line) {
            let seen = sides(ends, &whole, boundary);
            for (covering, is_inside) in seen.covering.into_iter().zip(seen.is_inside) {
                let kind = match (covering.len(), is_inside) {
                    (0, true) => FaultKind::Gap,
                    (2.., true) => FaultKind::Overlap,
                    (1.., false) => FaultKind::Outside,
                    _ => continue,
                };
                add(Fault { kind, triangles: covering, points: vec![seen.near], said: None });
            }
        }
    }
    finding
}

/// A triangle with an area, and how it turns.
struct Signed {
    number: usize,
    corners: Triangle,
    sign: Ordering,
}

/// How triangles have to turn; nothing where each may turn as it does.
fn expected_sign(signs: &[Signed], winding: Winding) -> Option<Ordering> {
    match winding {
        Winding::Counterclockwise => Some(Ordering::Greater),
        Winding::Clockwise => Some(Ordering::Less),
        Winding::Alike => {
            // As most of them do.
            let turned_left = signs.iter().filter(|signed| signed.sign.is_gt()).count();
            let is_left = 2 * turned_left >= signs.len();
            Some(if is_left { Ordering::Greater } else { Ordering::Less })
        }
        Winding::Any => None,
    }
}

/// What remains where edges with the same two ends are added up.
fn cancelled(mut edges: Vec<Edge>) -> Vec<Edge> {
    edges.sort_unstable_by(|a, b| {
        order(&a.ends[0], &b.ends[0]).then_with(|| order(&a.ends[1], &b.ends[1]))
    });
    let mut left: Vec<Edge> = Vec::new();
    // Edges with the same ends come together, and opposite ones cancel.
    for edge in edges {
        match left.last_mut() {
            Some(last) if last.ends == edge.ends => last.along += edge.along,
            _ => left.push(edge),
        }
    }
    left.retain(|edge| edge.along != 0);
    left
}

/// The edges in groups that lie on one line each.
fn by_line(edges: Vec<Edge>) -> Vec<Vec<Edge>> {
    let mut lines: Vec<Vec<Edge>> = Vec::new();
    for edge in edges {
        let is_on = |line: &&mut Vec<Edge>| {
            let [a, b] = line[0].ends;
            edge.ends.iter().all(|&end| orientation(a, b, end).is_eq())
        };
        match lines.iter_mut().find(is_on) {
            Some(line) => line.push(edge),
            None => lines.push(vec![edge]),
        }
    }
    lines
}

/// All ends of the edges of one line, in order.
fn stops(line: &[Edge]) -> Vec<Point> {
    let mut ends = Vec::with_capacity(line.len());
    for edge in line {
        ends.push(edge.ends);
    }
    super::distinct(&ends)
}

/// Ends of edges inside other edges of the same line.
fn junctions(line: &[Edge], add: &mut dyn FnMut(Fault)) {
    let stops = stops(line);
    for &Edge { ends: [low, high], .. } in line {
        for &stop in &stops {
            if order(&low, &stop).is_lt() && order(&stop, &high).is_lt() {
                let (kind, points) = (FaultKind::TJunction, vec![stop, low, high]);
                add(Fault { kind, triangles: Vec::new(), points, said: None });
            }
        }
    }
}

/// The pieces of a line on which edges do not cancel.
fn survivors(line: &[Edge]) -> Vec<[Point; 2]> {
    let stops = stops(line);
    let mut survivors = Vec::new();
    for pair in stops.windows(2) {
        // How often edges run along the piece, minus how often they run back.
        let mut along = 0;
        for edge in line {
            if order(&edge.ends[0], &pair[0]).is_le() && order(&pair[1], &edge.ends[1]).is_le() {
                along += edge.along;
            }
        }
        if along != 0 {
            survivors.push([pair[0], pair[1]]);
        }
    }
    survivors
}
