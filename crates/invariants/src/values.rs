//! Invariants 21 to 31: depth and attributes. What can be exact is compared bit by bit; the other
//! tolerances are those derived in [`rasterproof_verify::comparison::tolerance`] from the operations of an engine.

use std::collections::HashMap;
use std::fmt::Display;
use std::ops::RangeInclusive;

use glam::{DVec2, DVec3};

use super::Outcome;
use super::exact::{self, U};
use super::implementations::{Engine, Implementations};
use super::source::TriangleInput;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::{ORDERS, centre_of, twice_area};
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Fragment, MAX_VALUE, MAX_W, MIN_W, ScreenTriangle, ScreenVertex};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::pixels::few;
use rasterproof_verify::comparison::tolerance::{self, Bound, Tolerance};
use rasterproof_verify::oracle::values::ExactTriangle;

/// The number of fragments, or the first that is not `good`.
fn all_are(
    fragments: &[Fragment<DVec2>],
    what: impl Display,
    good: impl Fn(&Fragment<DVec2>) -> bool,
) -> Outcome {
    match fragments.iter().find(|f| !good(f)) {
        None => Ok(fragments.len() as u64),
        Some(f) => {
            let (x, y, depth, values) = (f.x_px, f.y_px, f.depth, f.varying);
            Err(format!("at ({x}, {y}): depth {depth:?} and values {values:?} {what}"))
        }
    }
}

/// A fragment as whole numbers that sort by row, then by column: where it is, its depth and its values, as bits.
type FragmentBits = (i32, i32, [u64; 3]);

/// The same fragments in any order of emission become the same list.
fn sorted_bits(fragments: &[Fragment<DVec2>]) -> Vec<FragmentBits> {
    let mut all = Vec::with_capacity(fragments.len());
    for f in fragments {
        all.push((f.y_px, f.x_px, [f.depth, f.varying.x, f.varying.y].map_array(f64::to_bits)));
    }
    all.sort_unstable();
    all
}

/// Bit by bit, and in the order of the pixels.
fn identical(a: &[Fragment<DVec2>], b: &[Fragment<DVec2>], what: &str) -> Outcome {
    // Bits, since 0 and -0 are equal as numbers, and what is no number is unlike itself.
    let (a, b) = (sorted_bits(a), sorted_bits(b));
    if a.len() != b.len() {
        return Err(format!("emits {} fragments and {} {what}", a.len(), b.len()));
    }
    for (one, other) in a.iter().zip(&b) {
        if one != other {
            let &(y, x, bits) = one;
            let [z, v, w] = bits.map_array(f64::from_bits);
            let [other_z, other_v, other_w] = other.2.map_array(f64::from_bits);
            return Err(format!(
                "at ({x}, {y}): depth {z:?}, values {:?}; {what}: {other_z:?}, {:?}",
                [v, w],
                [other_v, other_w]
            ));
        }
    }
    Ok(a.len() as u64)
}

/// 21: the three functions add up to twice the area at every centre, whichever way the corners go
/// round.
pub(super) fn edges_sum(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let corners = input.triangle.corners();
    let area = twice_area(&corners);
    let mut compared = 0;
    for (x, y) in exact::pixels(input.window).step_by(7) {
        let values = (subject.edge_values)(&corners, x, y);
        let sum: i128 = values.iter().sum();
        if sum != area {
            return Err(format!(
                "at ({x}, {y}) {values:?} add up to {sum}, twice the area is {area}"
            ));
        }
        compared += 1;
    }
    Ok(compared)
}

/// 22: interpolating (1,0,0), (0,1,0), (0,0,1) shows the weights. Their sum, in units of u = 2^-53:
///
/// Edge functions, v0 + (a1 d1 + a2 d2) r: with l = (a1 + a2) r <= 1 the first weight is 1 - l with
/// the roundings of the sum, of the product (both times l) and of the subtraction; the others have
/// one rounding each, l together. 3 l + (1 - l) <= 3.
/// Scanline, vL + (vR - vL) s: at each end 1 - t and t, a rounding of at most 1. In the row three
/// differences of 2 together, a rounding and that of the product each: 4; the last additions 1.
/// Together 6, which is 3 ulp of 1.
///
/// Each weight lies in [0, 1] but for the roundings of a difference, a product and an addition
/// around 1: 3 u below and 4 u above.
pub(super) fn weights_sum(subject: &Implementations, input: &TriangleInput) -> Outcome {
    // The three values of a vertex are its weights: 1 for itself, and 0 for the others.
    let unit = [DVec3::X, DVec3::Y, DVec3::Z];
    let vertices = [0, 1, 2].map_array(|i| {
        let ScreenVertex { position, depth, inv_w, .. } = input.triangle.vertices[i];
        ScreenVertex { position, depth, inv_w, varying: unit[i] }
    });
    subject.each_engine(|engine| {
        let mut wrong = None;
        let mut compared = 0;
        engine.fill.weights(&ScreenTriangle { vertices }, input.window, &mut |f| {
            let [a, b, c] = f.varying.to_array();
            let excess = sum_less_one([a, b, c]);
            let in_range = |w: f64| (-3.0 * U..=1.0 + 4.0 * U).contains(&w);
            if !(excess.abs() <= 6.0 * U && [a, b, c].into_iter().all(in_range)) {
                wrong.get_or_insert((f.x_px, f.y_px, [a, b, c], excess));
            }
            compared += 1;
        });
        match wrong {
            None => Ok(compared),
            Some((x, y, weights, excess)) => {
                Err(format!("at ({x}, {y}): weights {weights:?}, sum less one {excess:e}"))
            }
        }
    })
}

/// a + b + c - 1 rounded once or twice where it matters: TwoSum (Knuth) gives the error of each sum
/// exactly, and what is left is around 1e-16.
fn sum_less_one(weights: [f64; 3]) -> f64 {
    let [mut sum, mut errors] = [-1.0, 0.0];
    for weight in weights {
        let next: f64 = sum + weight;
        let virtual_part = next - sum;
        errors += (sum - (next - virtual_part)) + (weight - virtual_part);
        sum = next;
    }
    sum + errors
}

/// One of the two values of each vertex.
fn values_of(triangle: &Triangle, k: usize) -> [f64; 3] {
    triangle.vertices.map_array(|vertex| vertex.varying[k])
}

/// The bounds of both values of a triangle.
fn bounds_of(triangle: &Triangle, bound: Bound) -> [f64; 2] {
    [bound.at(values_of(triangle, 0)), bound.at(values_of(triangle, 1))]
}

/// Depths in the order of the vertices, for the bounds that depend on them.
fn depths_of(triangle: &Triangle) -> [f64; 3] {
    triangle.vertices.map_array(|vertex| vertex.depth)
}

/// 23: values against exact rationals within the derived bounds; the oracle's too, which are the
/// rationals rounded.
pub(super) fn perspective(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let t = &input.triangle;
    let attributes = t.vertices.map_array(|v| v.varying.to_array());
    let inv_w = t.vertices.map_array(|v| v.inv_w);
    let Some(exact) = ExactTriangle::new(&t.corners(), depths_of(t), inv_w, attributes) else {
        return Ok(0);
    };
    // The oracle is held to the same exact numbers, within half a step of rounding.
    let mut oracle = Vec::new();
    subject.oracle.values(t, input.window, &mut |f| oracle.push(f));
    let engines = subject.each_engine(|engine| {
        within_bounds(t, &exact, &engine.tolerance, &engine.fragments(t, input.window))
    })?;
    let oracle = within_bounds(t, &exact, &tolerance::ORACLE, &oracle);
    Ok(engines + oracle.map_err(|message| format!("the oracle {message}"))?)
}

/// Compares a few fragments with the exact triangle; more would take long.
fn within_bounds(
    triangle: &Triangle,
    exact: &ExactTriangle<2>,
    tolerance: &Tolerance,
    fragments: &[Fragment<DVec2>],
) -> Outcome {
    let [x_bound, y_bound] = bounds_of(triangle, tolerance.attribute);
    let depth_bound = tolerance.depth.at(depths_of(triangle));
    let mut compared = 0;
    for f in few(fragments) {
        let (depth, [x, y]) = exact.at(f.x_px, f.y_px);
        // How many times its bound each of the three is away from the exact number.
        let depth_ratio = depth.distance(f.depth) / depth_bound;
        let ratio = [x.distance(f.varying.x) / x_bound, y.distance(f.varying.y) / y_bound];
        if depth_ratio > 1.0 || ratio[0] > 1.0 || ratio[1] > 1.0 {
            return Err(format!(
                "at ({}, {}): depth {:?} and values {:?} are {depth_ratio:.3e} and {ratio:.3?} times their bounds away",
                f.x_px,
                f.y_px,
                f.depth,
                f.varying.to_array()
            ));
        }
        compared += 1;
    }
    Ok(compared)
}

/// 24: no value beyond those of the vertices by more than the engine's own bound of rounding. The
/// exact value is a mean of the three with weights in [0, 1]; so this bound is as derived, and a
/// clamp would only hide a larger error.
pub(super) fn hull(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let t = &input.triangle;
    subject.each_engine(|engine| {
        let Tolerance { depth, attribute, .. } = engine.tolerance;
        let depths = hull_of(depths_of(t), depth);
        let first = hull_of(values_of(t, 0), attribute);
        let second = hull_of(values_of(t, 1), attribute);
        all_are(&engine.fragments(t, input.window), "leave the hull", |f| {
            depths.contains(&f.depth)
                && first.contains(&f.varying.x)
                && second.contains(&f.varying.y)
        })
    })
}

/// From the least of three values to the largest, and a bound of rounding beyond both.
fn hull_of(values: [f64; 3], bound: Bound) -> RangeInclusive<f64> {
    let [a, b, c] = values;
    let slack = bound.at(values);
    a.min(b).min(c) - slack..=a.max(b).max(c) + slack
}

/// 25: a constant comes out as it went in.
pub(super) fn constant(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let value = input.triangle.vertices[0].varying;
    let mut flat = input.triangle;
    for vertex in &mut flat.vertices {
        vertex.varying = value;
    }
    subject.each_engine(|engine| {
        let fragments = engine.fragments(&flat, input.window);
        all_are(&fragments, format_args!("instead of values {value:?}"), |f| f.varying == value)
    })
}

/// 26: any three equal w are as good as 1.
pub(super) fn equal_w(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let inv_w = input.triangle.vertices[0].inv_w;
    let mut both = [input.triangle; 2];
    for (triangle, inv_w) in both.iter_mut().zip([inv_w, 1.0]) {
        for vertex in &mut triangle.vertices {
            vertex.inv_w = inv_w;
        }
    }
    subject.each_engine(|engine| {
        let [equal, affine] = both.map_array(|t| engine.fragments(&t, input.window));
        identical(&equal, &affine, "with w = 1")
    })
}

/// 27: a power of two moves the exponent of every w and of nothing else.
pub(super) fn scaled_w(subject: &Implementations, input: &TriangleInput) -> Outcome {
    subject.each_engine(|engine| {
        // The same values come out, whatever the unit of w is.
        let still = engine.fragments(&input.triangle, input.window);
        let mut compared = 0;
        for power in [-150, -3, 1, 40, 150] {
            let factor = 2f64.powi(power);
            // A factor that takes a vertex out of the domain of w says nothing.
            let allowed = 1.0 / MAX_W..=1.0 / MIN_W;
            if !input.triangle.vertices.iter().all(|v| allowed.contains(&(v.inv_w * factor))) {
                continue;
            }
            let mut scaled = input.triangle;
            for vertex in &mut scaled.vertices {
                vertex.inv_w *= factor;
            }
            let fragments = engine.fragments(&scaled, input.window);
            let what = format!("before w was divided by 2^{power}");
            compared += identical(&fragments, &still, &what)?;
        }
        Ok(compared)
    })
}

/// 28: not only the rotations but all six orders.
pub(super) fn rotated_vertices(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let v = &input.triangle.vertices;
    subject.each_engine(|engine| {
        // A weight and its vertex may change places, and every sum must come out the same.
        let first = engine.fragments(&input.triangle, input.window);
        let mut compared = 0;
        for order in &ORDERS[1..] {
            // Each vertex takes its values along.
            let turned = ScreenTriangle { vertices: order.map_array(|i| v[i]) };
            let fragments = engine.fragments(&turned, input.window);
            compared += identical(&fragments, &first, &format!("in order 0 1 2, not {order:?}"))?;
        }
        Ok(compared)
    })
}

/// 29: a sample exactly on an edge belongs to one side only, so each side is asked where it owns:
/// as it is, or turned by half a turn about the sample, which changes no exact value. Both answers
/// are the same number, the value on the edge, within the bounds of the two triangles together.
pub(super) fn shared_edge(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let [a, b, c] = input.triangle.corners();
    let window = PixelRect::window(48, 48);
    let (px, py) = ((input.salt % 48) as i32, (input.salt / 48 % 48) as i32);
    let sample = centre_of(px, py);
    // One step along the edge is (dx, dy), and one away from it (ex, ey).
    let ([dx, dy], [ex, ey]) = (short_way(a, b), short_way(a, c));
    let turn = i64::from(dx) * i64::from(ey) - i64::from(dy) * i64::from(ex);
    if turn == 0 {
        return Ok(0);
    }
    // The point that is k steps along the edge from the sample, and l steps away from it.
    let at =
        |k: i32, l: i32| SubpixelPoint::new(sample.x + k * dx + l * ex, sample.y + k * dy + l * ey);
    let (back, ahead) = (1 + (input.salt >> 12 & 3) as i32, 1 + (input.salt >> 14 & 3) as i32);
    let values = &input.triangle.vertices;
    // The edge runs through the sample, and is shared by two triangles: third corners on either side, with values of their own.
    let [mut one, mut other] = [input.triangle; 2];
    for (triangle, l) in [(&mut one, 1), (&mut other, -1)] {
        let corners = [at(-back, 0), at(ahead, 0), at(0, l)];
        for (vertex, corner) in triangle.vertices.iter_mut().zip(corners) {
            vertex.position = corner;
        }
    }
    other.vertices[2].depth = -values[2].depth;
    other.vertices[2].varying = values[0].varying - values[2].varying;
    let there = PixelRect { x0: px, y0: py, x1: px + 1, y1: py + 1 }.intersect(&window);
    subject.each_engine(|engine| {
        let (Some(f), Some(g)) =
            (owned_value(engine, &one, there), owned_value(engine, &other, there))
        else {
            return Err("never owns the sample on the edge".to_owned());
        };
        // Each side may be off by the bound of its own triangle.
        let Tolerance { depth, attribute, .. } = engine.tolerance;
        let depth_bound = depth.at(depths_of(&one)) + depth.at(depths_of(&other));
        let (bounds, more) = (bounds_of(&one, attribute), bounds_of(&other, attribute));
        let bounds = [bounds[0] + more[0], bounds[1] + more[1]];
        let difference = (f.varying - g.varying).abs();
        let is_near = difference.x <= bounds[0]
            && difference.y <= bounds[1]
            && (f.depth - g.depth).abs() <= depth_bound;
        if is_near {
            return Ok(1);
        }
        Err(format!(
            "on the edge {:?} to {:?} at ({px}, {py}): {:?}, {:?} from one side, {:?}, {:?} from the other",
            at(-back, 0),
            at(ahead, 0),
            f.depth,
            f.varying,
            g.depth,
            g.varying
        ))
    })
}

/// The fragment of the one pixel of a window. If the triangle has none, it is turned half round about the sample, so that the edge
/// through the sample becomes its own.
fn owned_value(engine: &Engine, triangle: &Triangle, there: PixelRect) -> Option<Fragment<DVec2>> {
    if let Some(fragment) = engine.fragments(triangle, there).first() {
        return Some(*fragment);
    }
    let sample = centre_of(there.x0, there.y0);
    let mut turned = *triangle;
    for vertex in &mut turned.vertices {
        let SubpixelPoint { x, y } = vertex.position;
        vertex.position = SubpixelPoint::new(2 * sample.x - x, 2 * sample.y - y);
    }
    engine.fragments(&turned, there).first().copied()
}

/// The way from one point to another, made so short that four of them stay near.
fn short_way(p: SubpixelPoint, q: SubpixelPoint) -> [i32; 2] {
    [(p.x, q.x), (p.y, q.y)].map_array(|(p, q)| ((i64::from(q) - i64::from(p)) % 2000) as i32)
}

/// For each pixel the least depth and whose it is, when copies are drawn in an order.
fn nearest(
    drawn: &[Vec<Fragment<DVec2>>],
    order: &[usize; 3],
) -> HashMap<(i32, i32), (f64, usize)> {
    let mut nearest = HashMap::new();
    for &i in order {
        for f in &drawn[i] {
            let entry = nearest.entry((f.x_px, f.y_px)).or_insert((f.depth, i));
            if f.depth < entry.0 {
                *entry = (f.depth, i);
            }
        }
    }
    nearest
}

/// 30: a flat depth is exact, so a depth test gives one picture for every order of submission.
pub(super) fn flat_depth(subject: &Implementations, input: &TriangleInput) -> Outcome {
    let depths = depths_of(&input.triangle);
    // The triangle and two copies a few pixels on, each at a depth of its own.
    let mut copies = [input.triangle; 3];
    for (i, copy) in copies.iter_mut().enumerate() {
        for vertex in &mut copy.vertices {
            vertex.depth = depths[i];
            let moved = vertex.position.x.checked_add(i as i32 * 3 * SUBPIXELS);
            let Some(x) = moved else { return Ok(0) };
            vertex.position.x = x;
        }
    }
    // Of equal depths the first one drawn stays, which is right.
    let distinct = depths[0] != depths[1] && depths[1] != depths[2] && depths[0] != depths[2];
    subject.each_engine(|engine| {
        let drawn: Vec<_> = copies.iter().map(|t| engine.fragments(t, input.window)).collect();
        for (i, fragments) in drawn.iter().enumerate() {
            let depth = depths[i];
            all_are(fragments, format_args!("instead of depth {depth:?}"), |f| f.depth == depth)?;
        }
        // Nearer wins; who does must not depend on who came first.
        let first = nearest(&drawn, &ORDERS[0]);
        if distinct && ORDERS[1..].iter().any(|order| nearest(&drawn, order) != first) {
            return Err("draws a picture that depends on the order of submission".to_owned());
        }
        Ok(drawn.iter().map(|fragments| fragments.len() as u64).sum())
    })
}

/// 31: the corners of the domain of w, of depth and of values.
pub(super) fn finite(subject: &Implementations, input: &TriangleInput) -> Outcome {
    // Everything that is stored is 1/w, so the largest w is the smallest number.
    let (smallest, largest) = (1.0 / MAX_W, 1.0 / MIN_W);
    let inv_ws = [
        [smallest, largest, 1.0],
        [largest, smallest, smallest],
        [smallest; 3],
        [largest; 3],
        [1.0, smallest, largest],
    ];
    let values = [
        [MAX_VALUE, -MAX_VALUE, MAX_VALUE],
        [MAX_VALUE; 3],
        [f64::MIN_POSITIVE, -f64::MIN_POSITIVE, 0.0],
        [-MAX_VALUE, f64::MIN_POSITIVE / 4.0, 1.0],
    ];
    // The salt picks one of all pairs of the two lists.
    let inv_w = inv_ws[input.salt as usize % inv_ws.len()];
    let value = values[input.salt as usize / inv_ws.len() % values.len()];
    let mut extreme = input.triangle;
    for (i, vertex) in extreme.vertices.iter_mut().enumerate() {
        vertex.inv_w = inv_w[i];
        vertex.depth = value[i];
        vertex.varying = DVec2::new(value[i], value[(i + 1) % 3]);
    }
    subject.each_engine(|engine| {
        let fragments = engine.fragments(&extreme, input.window);
        let what = format_args!("from 1/w {inv_w:?} and values {value:?}");
        all_are(&fragments, what, |f| f.depth.is_finite() && f.varying.is_finite())
    })
}
