//! Facts of a question about what the near plane leaves of a triangle.

use glam::DVec2;

use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};

use super::{Read, Test, Topic, Unit, fact, facts_of, numbers};
use crate::cases::clip::clip_corners;
use crate::cases::{Case, Limits, Shape};

/// Triangles of clip space.
pub const TOPIC: Topic = Topic {
    name: "near-design",
    facts: &facts_of(&FACTS),
    measure: |case, _: &Limits| Some(numbers(&FACTS, &ClipFacts::of_case(case)?)),
    impossible: include_str!("impossible/near-design.txt"),
    draw,
    vary,
    put: Limits::put,
};

const SIDE: Test = Test::Choice(&["behind", "in it", "before"]);
const SIZE: Test = Test::Steps(&[1, 64, 1024]);
const SOME: Test = Test::Choice(&["of no corner", "of some corners", "of all"]);

/// The facts that the design covers.
const FACTS: [Read<ClipFacts>; 17] = [
    fact("the first corner and the plane z = -w", Unit::Count, |m| m.sides[0] + 1, SIDE),
    fact("the second corner and the plane z = -w", Unit::Count, |m| m.sides[1] + 1, SIDE),
    fact("the third corner and the plane z = -w", Unit::Count, |m| m.sides[2] + 1, SIDE),
    fact("z of the first corner", Unit::Count, |m| m.z[0], Test::Sign),
    fact("z of the second corner", Unit::Count, |m| m.z[1], Test::Sign),
    fact("z of the third corner", Unit::Count, |m| m.z[2], Test::Sign),
    fact("w of the first corner", Unit::Count, |m| m.w[0], Test::Sign),
    fact("w of the second corner", Unit::Count, |m| m.w[1], Test::Sign),
    fact("w of the third corner", Unit::Count, |m| m.w[2], Test::Sign),
    fact("corners at one place", Unit::Count, |m| m.alike, Test::Choice(&["none", "two", "all"])),
    fact("the largest x or y", Unit::Pixels, |m| m.far, SIZE),
    fact("the largest w without sign", Unit::Count, |m| m.size[0], SIZE),
    fact("the largest z without sign", Unit::Count, |m| m.size[1], SIZE),
    fact(
        "equal w",
        Unit::Count,
        |m| m.equal_w,
        Test::Choice(&["of no two corners", "of two corners", "of all"]),
    ),
    fact("negative x", Unit::Count, |m| m.negative[0], SOME),
    fact("negative y", Unit::Count, |m| m.negative[1], SOME),
    fact(
        "the attribute",
        Unit::Count,
        |m| m.attribute,
        Test::Choice(&["of one sign", "of both signs"]),
    ),
];

/// What was measured of the corners of a triangle of clip space.
pub struct ClipFacts {
    /// The sign of z + w of each corner: 1 before the plane, where it is kept.
    pub sides: [i64; 3],
    /// The signs of z and of w.
    pub z: [i64; 3],
    /// See `z`.
    pub w: [i64; 3],
    /// How many corners have the place of another: none, two, three.
    pub alike: i64,
    /// The largest |x| or |y|, rounded down.
    pub far: i64,
    /// The largest |w| and |z|, rounded down.
    pub size: [i64; 2],
    /// How many corners have the w of another.
    pub equal_w: i64,
    /// Whether no corner, some or all have a negative x, and y.
    pub negative: [i64; 2],
    /// Whether the attribute has both signs.
    pub attribute: i64,
}

impl ClipFacts {
    /// Of the first triangle of a case.
    #[must_use]
    pub fn of_case(case: &Case) -> Option<Self> {
        let corners = clip_corners(case.triangles().first()?);
        let column = |at: usize| corners.map(|corner| corner[at]);
        let [x, y, z, w, attribute] = [0, 1, 2, 3, 4].map(column);
        let largest = |of: &[f64]| of.iter().fold(0.0, |most: f64, v| most.max(v.abs())) as i64;
        let pairs = |is_same: &dyn Fn(usize, usize) -> bool| {
            [(0, 1), (1, 2), (2, 0)].into_iter().filter(|(i, j)| is_same(*i, *j)).count() as i64
        };
        let negative = |of: &[f64; 3]| match of.iter().filter(|v| **v < 0.0).count() {
            0 => 0,
            3 => 2,
            _ => 1,
        };
        Some(Self {
            sides: [0, 1, 2].map(|i| sign(z[i] + w[i])),
            z: z.map(sign),
            w: w.map(sign),
            alike: pairs(&|i, j| corners[i][..4] == corners[j][..4]),
            far: largest(&x).max(largest(&y)),
            size: [largest(&w), largest(&z)],
            equal_w: pairs(&|i, j| w[i] == w[j]),
            negative: [negative(&x), negative(&y)],
            attribute: i64::from(negative(&attribute) == 1),
        })
    }
}

fn sign(value: f64) -> i64 {
    i64::from(value > 0.0) - i64::from(value < 0.0)
}

/// A number of quarters, as [`crate::cases::near_plane`] has them, sometimes of another size.
fn quarters(rng: &mut Rng) -> f64 {
    let most = [2, 12, 64, 4096, 1 << 14][rng.int(0, 4) as usize];
    rng.int(-most, most) as f64 / 4.0
}

fn draw_vertex(rng: &mut Rng) -> ScreenVertex<DVec2> {
    let reach = 1 << rng.int(6, 19);
    let [x, y] = [(); 2].map(|()| rng.coordinate(-reach, reach) / 64 * 64);
    let w = if rng.chance(6) { 0.0 } else { quarters(rng) };
    let depth = match rng.int(0, 5) {
        0 => -w,
        1 => 0.0,
        _ => quarters(rng),
    };
    let varying = DVec2::new(w, quarters(rng));
    ScreenVertex { position: SubpixelPoint::new(x, y), depth, inv_w: 1.0, varying }
}

fn draw(rng: &mut Rng) -> Case {
    case_of([(); 3].map(|()| draw_vertex(rng)))
}

fn vary(rng: &mut Rng, one: &Case, other: &Case) -> Case {
    let [mut vertices, others] = [one, other].map(|case| case.triangles()[0].vertices);
    for _ in 0..rng.int(1, 3) {
        let at = rng.int(0, 2) as usize;
        let next = (at + 1) % 3;
        match rng.int(0, 10) {
            0 => vertices[at] = draw_vertex(rng),
            1 => vertices[at] = others[at],
            2 => vertices[at].depth = others[at].depth,
            3 => vertices[at].varying.x = others[at].varying.x,
            4 => vertices[at].depth = -vertices[at].varying.x,
            5 => vertices[at].varying.x = vertices[next].varying.x,
            6 => vertices[at] = vertices[next],
            7 => vertices[at].varying.y = -vertices[at].varying.y,
            8 => vertices[at].position = others[at].position,
            9 => vertices[at].position.x = -vertices[at].position.x,
            _ => vertices.iter_mut().zip(&others).for_each(|(v, other)| v.varying = other.varying),
        }
    }
    case_of(vertices)
}

/// The window has no part in the question. No two corners have the same attribute, so that it tells where a new corner lies.
fn case_of(mut vertices: [ScreenVertex<DVec2>; 3]) -> Case {
    for (v, of_corner) in vertices.iter_mut().zip([-1.0, 0.0, 1.0]) {
        v.varying.y = (v.varying.y / 3.0).trunc() * 3.0 + of_corner;
    }
    let list = vec![ScreenTriangle { vertices }];
    Case { window: PixelRect::window(24, 24), shape: Shape::Triangles { list, disjoint: true } }
}
