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
        signs.push((number, corners, sign));
    }
    let turned_left = signs.iter().filter(|(_, _, sign)| sign.is_gt()).count();
    let expected = match options.terms.winding {
        Winding::Counterclockwise => Some(Ordering::Greater),
        Winding::Clockwise => Some(Ordering::Less),
        Winding::Alike if 2 * turned_left >= signs.len() => Some(Ordering::Greater),
        Winding::Alike => Some(Ordering::Less),
        Winding::Any => None,
    };
    for (number, corners, _) in signs.iter().filter(|s| expected.is_some_and(|sign| s.2 != sign)) {
        add(Fault::of_triangle(FaultKind::Flipped, *number, corners));
    }
    // A flat triangle has no sign of its own, and is turned as the others are expected to be.
    if expected == Some(Ordering::Less) {
        flat.iter_mut().for_each(|[_, b, c]| std::mem::swap(b, c));
    }

    let mut edges: Vec<Edge> = boundary.iter().map(|&[from, to]| Edge::new(to, from)).collect();
    let all = whole.iter().map(|(_, corners)| corners).chain(&flat);
    for &[a, b, c] in all {
        let three = [[a, b], [b, c], [c, a]].into_iter().filter(|[from, to]| from != to);
        edges.extend(three.map(|[from, to]| Edge::new(from, to)));
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

/// What remains where edges with the same two ends are added up.
fn cancelled(mut edges: Vec<Edge>) -> Vec<Edge> {
    let by_ends = |a: &Edge, b: &Edge| {
        order(&a.ends[0], &b.ends[0]).then_with(|| order(&a.ends[1], &b.ends[1]))
    };
    edges.sort_unstable_by(by_ends);
    let same = edges.chunk_by(|a, b| a.ends == b.ends);
    let sums = same
        .map(|same| Edge { ends: same[0].ends, along: same.iter().map(|edge| edge.along).sum() });
    sums.filter(|edge| edge.along != 0).collect()
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
    let mut stops: Vec<Point> = line.iter().flat_map(|edge| edge.ends).collect();
    stops.sort_unstable_by(order);
    stops.dedup();
    stops
}

/// Ends of edges inside other edges of the same line.
fn junctions(line: &[Edge], add: &mut dyn FnMut(Fault)) {
    let stops = stops(line);
    for &Edge { ends: [low, high], .. } in line {
        let inner = |stop: &&Point| order(&low, stop).is_lt() && order(stop, &high).is_lt();
        for &stop in stops.iter().filter(inner) {
            let points = vec![stop, low, high];
            add(Fault { kind: FaultKind::TJunction, triangles: Vec::new(), points, said: None });
        }
    }
}

/// The pieces of a line on which edges do not cancel.
fn survivors(line: &[Edge]) -> Vec<[Point; 2]> {
    let stops = stops(line);
    let pieces = stops.windows(2).map(|pair| [pair[0], pair[1]]);
    let survives = |[low, high]: &[Point; 2]| {
        let over = line
            .iter()
            .filter(|edge| order(&edge.ends[0], low).is_le() && order(high, &edge.ends[1]).is_le());
        over.map(|edge| edge.along).sum::<i64>() != 0
    };
    pieces.filter(survives).collect()
}
