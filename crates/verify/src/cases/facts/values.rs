//! Facts of a question about the values of a triangle: how w, the depth and both attributes differ between its corners.

use glam::DVec2;

use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::ScreenVertex;

use super::{Read, Test, Topic, Unit, exponent, fact, facts_of, numbers, triangles};
use crate::cases::{Case, Limits, Shape, Triangle};

/// Values of triangles.
pub const TOPIC: Topic = Topic {
    name: "w-design",
    facts: &facts_of(&FACTS),
    measure: |case, limits| Some(numbers(&FACTS, &ValueFacts::of_case(case, limits)?)),
    impossible: include_str!("impossible/w-design.txt"),
    draw,
    vary,
    put: Limits::put,
};

const PX: i64 = SUBPIXELS as i64;
const EXTENT: Test = Test::Steps(&[PX, 8 * PX, 64 * PX, 4096 * PX]);
pub(super) const KINDS: Test =
    Test::Choice(&["0 everywhere", "the same everywhere", "of one sign", "of both signs"]);
pub(super) const SIZE: Test = Test::Steps(&[-8, 0, 8]);

/// The facts that the design covers.
const FACTS: [Read<ValueFacts>; 16] = [
    fact("its winding", Unit::Count, |m| m.form.turn + 1, triangles::WINDING),
    fact("its width", Unit::Subpixels, |m| m.form.size[0], EXTENT),
    fact("its height", Unit::Subpixels, |m| m.form.size[1], EXTENT),
    fact("samples in it", Unit::Count, |m| m.form.samples, Test::Steps(&[1, 2, 17, 257])),
    fact(
        "samples on its boundary",
        Unit::Count,
        |m| m.form.ties,
        Test::Choice(&["none", "on an edge", "on a corner"]),
    ),
    fact("corners inside the window", Unit::Count, |m| m.form.inside, Test::Steps(&[1, 2, 3])),
    fact("the width of the window in pixels", Unit::Count, |m| m.form.window[0], Test::Divisor),
    fact(
        "the largest w, as a multiple of the smallest,",
        Unit::Doublings,
        |m| m.w_ratio,
        Test::Steps(&[0, 1, 4, 7, 14]),
    ),
    fact("the smallest w", Unit::Doublings, |m| m.w_least, SIZE),
    fact(
        "the corner of the largest w",
        Unit::Count,
        |m| m.w_largest,
        Test::Choice(&["the first", "the second", "the third", "none"]),
    ),
    fact(
        "its depth",
        Unit::Count,
        |m| m.depth,
        Test::Choice(&["0 everywhere", "the same everywhere", "not the same"]),
    ),
    fact(
        "corners at the depths 0 and 1",
        Unit::Count,
        |m| m.depth_ends,
        Test::Choice(&["none", "at 0", "at 1", "at both"]),
    ),
    fact("its first attribute", Unit::Count, |m| m.kinds[0], KINDS),
    fact("its second attribute", Unit::Count, |m| m.kinds[1], KINDS),
    fact("the largest magnitude of the first attribute", Unit::Doublings, |m| m.sizes[0], SIZE),
    fact("the largest magnitude of the second attribute", Unit::Doublings, |m| m.sizes[1], SIZE),
];

/// What was measured of a triangle with its values.
pub struct ValueFacts {
    /// Its form and its place.
    pub form: triangles::TriangleFacts,
    /// The logarithm of the largest w over the smallest; -1 where all are the same.
    pub w_ratio: i64,
    /// The logarithm of the smallest w.
    pub w_least: i64,
    /// The number of the corner with the largest w; 3 where several have it.
    pub w_largest: i64,
    /// Which depths it has.
    pub depth: i64,
    /// Whether corners lie at the ends of the range of depths.
    pub depth_ends: i64,
    /// What signs an attribute has, of both.
    pub kinds: [i64; 2],
    /// The logarithm of the largest magnitude of an attribute.
    pub sizes: [i64; 2],
}

impl ValueFacts {
    /// Of the first triangle of a case.
    #[must_use]
    pub fn of_case(case: &Case, limits: &Limits) -> Option<Self> {
        let triangle = case.triangles().first()?;
        let form = triangles::TriangleFacts::of_case(case, limits)?;
        let w = triangle.vertices.each_ref().map(|v| 1.0 / v.inv_w);
        let depths = triangle.vertices.each_ref().map(|v| v.depth);
        let [least, most] = [w[0].min(w[1]).min(w[2]), w[0].max(w[1]).max(w[2])];
        let mut largest = (0..).zip(&w).filter(|(_, w)| **w == most);
        let first = largest.next().map_or(3, |(number, _)| number);
        let w_largest = if largest.next().is_some() { 3 } else { first };
        let attributes = [
            triangle.vertices.each_ref().map(|v| v.varying.x),
            triangle.vertices.each_ref().map(|v| v.varying.y),
        ];
        Some(Self {
            form,
            w_ratio: if least == most { -1 } else { exponent(most / least).max(0).into() },
            w_least: exponent(least).into(),
            w_largest,
            depth: match depths {
                [a, b, c] if a != b || b != c => 2,
                [a, ..] => i64::from(a != 0.0),
            },
            depth_ends: i64::from(depths.contains(&0.0)) + 2 * i64::from(depths.contains(&1.0)),
            kinds: attributes.each_ref().map(kind),
            sizes: attributes
                .each_ref()
                .map(|[a, b, c]| i64::from(exponent(a.abs().max(b.abs()).max(c.abs())))),
        })
    }
}

/// Which signs an attribute has.
fn kind(&[a, b, c]: &[f64; 3]) -> i64 {
    let all = [a, b, c];
    if all == [0.0; 3] {
        0
    } else if a == b && b == c {
        1
    } else if all.iter().all(|v| *v >= 0.0) || all.iter().all(|v| *v <= 0.0) {
        2
    } else {
        3
    }
}

/// A power of two.
fn power(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// An attribute at three corners.
fn draw_attribute(rng: &mut Rng) -> [f64; 3] {
    let size = power(rng.int(-12, 12));
    let flat = rng.signed();
    match rng.int(0, 5) {
        0 => [0.0; 3],
        1 => [size * flat; 3],
        2 => [(); 3].map(|()| size * rng.unit()),
        3 => [(); 3].map(|()| -size * rng.unit()),
        _ => [(); 3].map(|()| size * rng.signed()),
    }
}

fn draw_depth(rng: &mut Rng) -> [f64; 3] {
    let flat = rng.unit();
    match rng.int(0, 6) {
        0 => [0.0; 3],
        1 => [1.0; 3],
        2 => [flat; 3],
        3 | 4 => [(); 3].map(|()| rng.int(0, 2) as f64 / 2.0),
        _ => [(); 3].map(|()| rng.unit()),
    }
}

fn draw_w(rng: &mut Rng) -> [f64; 3] {
    let (least, ratio) = (rng.int(-16, 16), rng.int(0, 20));
    match rng.int(0, 5) {
        0 => [power(least); 3],
        // Two corners alike, and the third nearer to the eye by less than half.
        5 => {
            let far = power(least) * (1.0 + rng.unit());
            let mut w = [far; 3];
            w[rng.int(0, 2) as usize] = far * (0.5 + rng.unit() / 2.0);
            w
        }
        // One or two corners far from the eye.
        1 | 2 => [(); 3].map(|()| power(least + ratio * rng.int(0, 1))),
        _ => [(); 3].map(|()| power(least + rng.int(0, ratio)) * (1.0 + rng.unit())),
    }
}

/// A triangle with other values: all of them, or those of which the number says so.
fn dressed(rng: &mut Rng, old: &Triangle, which: i64) -> Triangle {
    let mut new = *old;
    let (w, depth) = (draw_w(rng), draw_depth(rng));
    let [a, b] = [draw_attribute(rng), draw_attribute(rng)];
    for (at, v) in new.vertices.iter_mut().enumerate() {
        let ScreenVertex { depth: old_depth, inv_w, varying, .. } = *v;
        let is_new = |number: i64| which == number || which < 0;
        v.inv_w = if is_new(0) { 1.0 / w[at] } else { inv_w };
        v.depth = if is_new(1) { depth[at] } else { old_depth };
        v.varying = DVec2::new(
            if is_new(2) { a[at] } else { varying.x },
            if is_new(3) { b[at] } else { varying.y },
        );
    }
    new
}

/// The largest side of a window: the value of every pixel is compared.
const MOST_PX: i32 = 40;

fn narrower(window: PixelRect) -> PixelRect {
    PixelRect { x1: window.x1.min(MOST_PX), y1: window.y1.min(MOST_PX), ..window }
}

pub(super) fn draw(rng: &mut Rng) -> Case {
    let case = triangles::draw(rng);
    let list = vec![dressed(rng, &case.triangles()[0], -1)];
    Case { window: narrower(case.window), shape: Shape::Triangles { list, disjoint: true } }
}

pub(super) fn vary(rng: &mut Rng, one: &Case, other: &Case) -> Case {
    let (kept, others) = (one.triangles()[0], other.triangles()[0]);
    // The form of one with the values of the other, or one of them changed a little.
    let (window, mut triangle) = match rng.int(0, 3) {
        0 => (one.window, kept),
        _ => {
            let case = triangles::vary(rng, one, other);
            let mut moved = case.triangles()[0];
            for (v, old) in moved.vertices.iter_mut().zip(&kept.vertices) {
                *v = ScreenVertex { position: v.position, ..*old };
            }
            (case.window, moved)
        }
    };
    match rng.int(0, 5) {
        which @ 0..=3 => triangle = dressed(rng, &triangle, which),
        4 => {
            for (v, other) in triangle.vertices.iter_mut().zip(&others.vertices) {
                *v = ScreenVertex { position: v.position, ..*other };
            }
        }
        _ => {
            for (v, other) in triangle.vertices.iter_mut().zip(&others.vertices) {
                v.inv_w = other.inv_w;
            }
        }
    }
    Case {
        window: narrower(window),
        shape: Shape::Triangles { list: vec![triangle], disjoint: true },
    }
}
