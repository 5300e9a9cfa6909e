//! Facts of a question about the shares of pixels that a triangle covers.

use rasterproof_core::geometry::{centre, edges, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::Corners;

use super::triangles::{self, TriangleFacts, form_facts};
use super::{Read, Test, Topic, Unit, fact, facts_of, joined, numbers};
use crate::cases::{Case, Limits, Shape};
use crate::oracle::area::share;

/// Triangles with the shares of their pixels.
pub const TOPIC: Topic = Topic {
    name: "area-design",
    facts: &facts_of(&FACTS),
    measure: |case, limits| Some(numbers(&FACTS, &AreaFacts::of(case, limits)?)),
    impossible: include_str!("impossible/area-design.txt"),
    draw,
    vary,
    put: Limits::put,
};

const PX: i64 = SUBPIXELS as i64;
const EXTENT: Test = Test::Steps(&[1, PX, 8 * PX, 64 * PX]);
const PIXELS: Test = Test::Steps(&[1, 2, 9]);
const WHETHER: Test = Test::Steps(&[1]);
const SLOPE: Test = Test::Steps(&[0, 4, 8]);

/// The facts that the design covers.
const FACTS: [Read<AreaFacts>; 21] = joined(
    form_facts!(AreaFacts, EXTENT),
    [
        fact("pixels that it covers whole", Unit::Count, |m| m.whole, PIXELS),
        fact("pixels that it covers in part", Unit::Count, |m| m.partly, PIXELS),
        fact("pixels of which it covers less than 1/510", Unit::Count, |m| m.hardly, WHETHER),
        fact("pixels of which it covers all but 1/510", Unit::Count, |m| m.almost, WHETHER),
        fact("pixels of which it covers exactly half", Unit::Count, |m| m.half, WHETHER),
        fact(
            "pixels of which it covers more than half and not all",
            Unit::Count,
            |m| m.mostly,
            WHETHER,
        ),
        fact(
            "columns to a row of the most level edge",
            Unit::Doublings,
            |m| m.form.levelest,
            SLOPE,
        ),
        fact("rows to a column of the steepest edge", Unit::Doublings, |m| m.form.steepest, SLOPE),
    ],
);

/// What was measured of a triangle with the shares of its pixels.
struct AreaFacts {
    form: TriangleFacts,
    whole: i64,
    partly: i64,
    /// More than nothing, and less than half a step of 1/255.
    hardly: i64,
    /// Less than all by less than that.
    almost: i64,
    half: i64,
    /// Covered in part, by more than half.
    mostly: i64,
}

impl AreaFacts {
    fn of(case: &Case, limits: &Limits) -> Option<Self> {
        let corners: Corners = case.triangles().first()?.corners();
        let form = TriangleFacts::of_case(case, limits)?;
        let mut measured =
            Self { form, whole: 0, partly: 0, hardly: 0, almost: 0, half: 0, mostly: 0 };
        let area = twice_area(&corners);
        // Without an area it covers nothing of any pixel.
        let rows = if area == 0 { 0..0 } else { case.window.y0..case.window.y1 };
        for y_px in rows {
            for x_px in case.window.x0..case.window.x1 {
                match cut(&corners, area.signum(), x_px, y_px) {
                    Cut::Outside => {}
                    Cut::Whole => measured.whole += 1,
                    Cut::Perhaps => measured.count(share(&corners, x_px, y_px)),
                }
            }
        }
        Some(measured)
    }

    fn count(&mut self, share: f64) {
        let step = 1.0 / 510.0;
        let is_partly = share > 0.0 && share < 1.0;
        self.whole += i64::from(share >= 1.0);
        self.partly += i64::from(is_partly);
        self.hardly += i64::from(is_partly && share < step);
        self.almost += i64::from(is_partly && share > 1.0 - step);
        self.half += i64::from(share == 0.5);
        self.mostly += i64::from(is_partly && share > 0.5);
    }
}

/// How much of a pixel a triangle covers, as far as it is seen by its edges.
enum Cut {
    Outside,
    Whole,
    Perhaps,
}

/// An exact share takes much longer than looking on which side of the edges a pixel lies.
fn cut(corners: &Corners, turn: i128, x_px: i32, y_px: i32) -> Cut {
    let [x, y] = [centre(x_px), centre(y_px)];
    let mut is_whole = true;
    for [a, b] in edges(corners) {
        let [dx, dy] = [i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y)];
        // Differences of 33 bits, whose products do not fit 64.
        let left = i128::from(dx) * i128::from(y - i64::from(a.y));
        let side = turn * (left - i128::from(dy) * i128::from(x - i64::from(a.x)));
        // The farthest corner of the pixel lies so far beside its centre.
        let reach = i128::from((dx.abs() + dy.abs()) * i64::from(HALF_PIXEL));
        if side <= -reach {
            return Cut::Outside;
        }
        is_whole &= side >= reach;
    }
    if is_whole { Cut::Whole } else { Cut::Perhaps }
}

/// The largest side of a window: every pixel of it is compared.
const MOST_PX: i32 = 24;

/// A smaller window, and sometimes a triangle that covers nearly nothing or nearly all of a pixel, or exactly half.
fn fitted(rng: &mut Rng, mut case: Case) -> Case {
    let PixelRect { x1, y1, .. } = case.window;
    case.window = PixelRect { x1: x1.min(MOST_PX), y1: y1.min(MOST_PX), ..case.window };
    let corner = [case.window.x1, case.window.y1]
        .map(|side| rng.coordinate(0, i64::from(side) - 1) * SUBPIXELS);
    let way = rng.int(0, 14);
    let small = rng.coordinate(1, 16);
    let side = 20 * SUBPIXELS;
    let coarse = 1 << rng.int(0, 8);
    let [far, axis] = [rng.coordinate(1, 8) * SUBPIXELS, rng.coordinate(0, 1)];
    let Shape::Triangles { list, .. } = &mut case.shape else { return case };
    let points = match way {
        // A corner of a pixel alone.
        0 => [[0, 0], [small, 0], [0, small]],
        // All of some pixels but a corner, or a strip.
        1 => [[small, small / 2], [3 * far, 0], [0, 3 * far]],
        // Half of a pixel, cut along its diagonal, and of others.
        2 => [[0, 0], [far, 0], [0, far]],
        // A sliver along the side of pixels.
        3 => [[0, 0], [far, 0], [far, small]],
        // Exactly half of a pixel, by a triangle that is narrower than one.
        4 => [[0, 0], [192, 0], [0, 384]],
        // All of one pixel, and hardly anything of many below it.
        5 => [[0, 256], [0, -26], [side, 257]],
        // Exactly half of many, and hardly anything of many others.
        6 => [[side, 0], [0, side], [side, side + 1]],
        // Without area, along a column or a row of the lattice.
        7 => [[small * coarse, 0], [small * coarse, far], [small * coarse, 2 * far + small]],
        _ => return case,
    };
    let is_large = way == 5 || way == 6;
    if is_large {
        case.window = PixelRect::window(rng.int(20, 24) as u32, rng.int(2, 24) as u32);
    }
    let corner = if is_large { [0, 0] } else { corner };
    for (vertex, [x, y]) in list[0].vertices.iter_mut().zip(points) {
        let [x, y] = if axis == 0 { [x, y] } else { [y, x] };
        vertex.position = SubpixelPoint::new(corner[0] + x, corner[1] + y);
    }
    case
}

fn draw(rng: &mut Rng) -> Case {
    let case = triangles::draw(rng);
    fitted(rng, case)
}

fn vary(rng: &mut Rng, one: &Case, other: &Case) -> Case {
    let case = triangles::vary(rng, one, other);
    fitted(rng, case)
}
