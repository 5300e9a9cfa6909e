//! Facts of a question about the samples of a triangle, of four in each pixel.

use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;

use super::triangles::{self, Point, TriangleFacts, columns_at, form_facts};
use super::{Read, Test, Topic, Unit, fact, facts_of, joined, numbers};
use crate::cases::{Case, Limits, Shape};

/// Triangles with four samples a pixel.
pub const TOPIC: Topic = Topic {
    name: "sample-design",
    facts: &facts_of(&FACTS),
    measure: |case, limits| Some(numbers(&FACTS, &SampleFacts::of_case(case, limits)?)),
    impossible: include_str!("impossible/sample-design.txt"),
    draw,
    vary,
    put: Limits::put,
};

/// Where the samples of pixel (0, 0) lie, in steps of the lattice: those of the line protocol.
const SAMPLES: [Point; 4] = [[96, 32], [224, 96], [32, 160], [160, 224]];
const PX: i64 = SUBPIXELS as i64;
const EXTENT: Test = Test::Steps(&[1, PX, 8 * PX, 64 * PX, 4096 * PX]);
pub(super) const PIXELS: Test = Test::Steps(&[1, 2, 9]);
pub(super) const WHICH: Test =
    Test::Choice(&["of none", "sample 0", "sample 1", "sample 2", "sample 3", "different ones"]);

/// The facts that the design covers.
const FACTS: [Read<SampleFacts>; 24] = joined(
    form_facts!(SampleFacts, EXTENT),
    [
        fact(
            "the height of the window in pixels",
            Unit::Count,
            |m| m.form.window[1],
            Test::Divisor,
        ),
        fact("pixels with all four samples in it", Unit::Count, |m| m.whole, PIXELS),
        fact("pixels with some of their samples in it", Unit::Count, |m| m.partly, PIXELS),
        fact("the sample that is alone in its pixel", Unit::Count, |m| m.alone, WHICH),
        fact("the sample that is missing alone in its pixel", Unit::Count, |m| m.missing, WHICH),
        fact("the sample that lies on an edge", Unit::Count, |m| m.on_edge, WHICH),
        fact("the sample that is a corner", Unit::Count, |m| m.on_corner, WHICH),
        fact(
            "pixels with the centre in it and no sample",
            Unit::Count,
            |m| m.only_centre,
            Test::Steps(&[1]),
        ),
        fact(
            "pixels with a sample in it and not the centre",
            Unit::Count,
            |m| m.without_centre,
            PIXELS,
        ),
        fact(
            "columns to a row of the most level edge",
            Unit::Doublings,
            |m| m.form.levelest,
            Test::Steps(&[0, 4, 8]),
        ),
        fact(
            "rows to a column of the steepest edge",
            Unit::Doublings,
            |m| m.form.steepest,
            Test::Steps(&[0, 4, 8]),
        ),
    ],
);

/// What was measured of a triangle with its samples. What lies on its boundary counts as in it.
pub(super) struct SampleFacts {
    /// Its form and its place.
    form: TriangleFacts,
    /// Pixels of which all four samples lie in it, and pixels of which some do.
    pub whole: i64,
    pub partly: i64,
    /// The number of the sample that is the only one of its pixel in it, from 1; 0 where there is none, 5 where pixels differ.
    alone: i64,
    /// Likewise the only one that is not in it, one on an edge, one at a corner, and the first one in it where the centre is not.
    missing: i64,
    pub on_edge: i64,
    on_corner: i64,
    pub first: i64,
    /// Pixels whose centre lies in it and none of whose samples does.
    only_centre: i64,
    /// Pixels whose centre does not lie in it and one of whose samples does.
    pub without_centre: i64,
}

/// The bit of the centre in a mask of the samples.
const CENTRE: usize = 4;

impl SampleFacts {
    /// Of a case with one triangle.
    pub fn of_case(case: &Case, limits: &Limits) -> Option<Self> {
        let corners = case.triangles().first()?.corners();
        let mut measured = Self {
            form: TriangleFacts::of_case(case, limits)?,
            whole: 0,
            partly: 0,
            alone: 0,
            missing: 0,
            on_edge: 0,
            on_corner: 0,
            first: 0,
            only_centre: 0,
            without_centre: 0,
        };
        // Of each sample, and then of the centre, the triangle moved so that it comes to lie at the centre.
        let half = i64::from(HALF_PIXEL);
        let mut moved = [[[0; 2]; 3]; 5];
        for (number, points) in moved.iter_mut().enumerate() {
            let [x, y] = if number == CENTRE { [half; 2] } else { SAMPLES[number] };
            for (point, p) in points.iter_mut().zip(&corners) {
                *point = [i64::from(p.x) + half - x, i64::from(p.y) + half - y];
            }
        }
        let mut masks = vec![0_u8; case.window.width() as usize];
        for y_px in case.window.y0..case.window.y1 {
            measured.count_row(&moved, case.window, y_px, &mut masks);
        }
        for (number, sample) in (1..).zip(SAMPLES) {
            let is_on = |p: &SubpixelPoint| {
                let [x, y] = [p.x, p.y].map(i64::from);
                case.window.contains((x >> 8) as i32, (y >> 8) as i32)
                    && [x.rem_euclid(PX), y.rem_euclid(PX)] == sample
            };
            if corners.iter().any(is_on) {
                measured.on_corner = merged(measured.on_corner, number);
            }
        }
        Some(measured)
    }

    /// Counts the pixels of a row of the window. The masks of its pixels are 0 before and afterwards.
    fn count_row(
        &mut self,
        moved: &[[Point; 3]; 5],
        window: PixelRect,
        y_px: i32,
        masks: &mut [u8],
    ) {
        let [x0, x1] = [i64::from(window.x0), i64::from(window.x1)];
        let [mut start, mut end] = [x1, x0];
        for (number, points) in moved.iter().enumerate() {
            let Some((columns, is_exact)) = row_of(points, y_px, [x0, x1]) else { continue };
            let [first, last] = [columns[0].max(x0), columns[1].min(x1 - 1)];
            (start, end) = (start.min(first), end.max(last + 1));
            for x in first..=last {
                masks[(x - x0) as usize] |= 1 << number;
            }
            if is_exact && number != CENTRE {
                self.on_edge = merged(self.on_edge, number as i64 + 1);
            }
        }
        for x in start..end {
            let mask = std::mem::take(&mut masks[(x - x0) as usize]);
            let samples = mask & 0b1111;
            let has_centre = mask >> CENTRE == 1;
            match samples.count_ones() {
                0 => {
                    self.only_centre += i64::from(has_centre);
                    continue;
                }
                1 => self.alone = merged(self.alone, i64::from(samples.trailing_zeros()) + 1),
                3 => self.missing = merged(self.missing, i64::from(samples.trailing_ones()) + 1),
                _ => {}
            }
            self.whole += i64::from(samples == 0b1111);
            self.partly += i64::from(samples != 0b1111);
            if !has_centre {
                self.without_centre += 1;
                self.first = merged(self.first, i64::from(samples.trailing_zeros()) + 1);
            }
        }
    }
}

/// The first and the last column of a row whose centres lie in a triangle, and whether one of the window lies on an edge.
fn row_of(points: &[Point; 3], y_px: i32, window: [i64; 2]) -> Option<([i64; 2], bool)> {
    let y = i64::from(y_px) * PX + i64::from(HALF_PIXEL);
    let mut columns: Option<[i64; 2]> = None;
    let mut is_exact = false;
    for edge in 0..3 {
        let [p, q] = [points[edge], points[(edge + 1) % 3]];
        let Some((first, last, on_edge)) = columns_at(p, q, y) else { continue };
        let [low, high] = columns.unwrap_or([first, last]);
        columns = Some([low.min(first), high.max(last)]);
        is_exact |= on_edge && first < window[1] && last >= window[0];
    }
    columns.map(|columns| (columns, is_exact))
}

/// The number of the only sample so far with another one.
fn merged(old: i64, new: i64) -> i64 {
    if old == 0 || old == new { new } else { 5 }
}

/// The largest side of a window: every sample of it is compared.
const MOST_PX: i32 = 24;

/// A smaller window, and sometimes a corner on a sample of it.
pub(super) fn fitted(rng: &mut Rng, mut case: Case) -> Case {
    let PixelRect { x1, y1, .. } = case.window;
    case.window = PixelRect { x1: x1.min(MOST_PX), y1: y1.min(MOST_PX), ..case.window };
    let sides = [case.window.x1, case.window.y1];
    let way = rng.int(0, 9);
    let at = rng.int(0, 2) as usize;
    let number = rng.int(0, 3) as usize;
    let sample = [0, 1].map(|axis: usize| {
        rng.coordinate(0, i64::from(sides[axis]) - 1) * SUBPIXELS + SAMPLES[number][axis] as i32
    });
    let axis = rng.int(0, 1) as usize;
    let Shape::Triangles { list, .. } = &mut case.shape else { return case };
    let vertices = &mut list[0].vertices;
    match way {
        0 => vertices[at].position = SubpixelPoint::new(sample[0], sample[1]),
        // An edge through it: one end is the image of the other.
        1 => {
            let SubpixelPoint { x, y } = vertices[at].position;
            let image =
                |v: i32, sample: i32| super::saturated(2 * i64::from(sample) - i64::from(v));
            vertices[(at + 1) % 3].position =
                SubpixelPoint::new(image(x, sample[0]), image(y, sample[1]));
        }
        // Around it, a few steps wide.
        2 => {
            for v in vertices.iter_mut() {
                let by = [(); 2].map(|()| rng.coordinate(-48, 48));
                v.position = SubpixelPoint::new(sample[0] + by[0], sample[1] + by[1]);
            }
        }
        // Along a row or a column of samples, without area.
        3 => {
            let reach = [64, 512, 1 << 13][rng.int(0, 2) as usize];
            for v in vertices.iter_mut() {
                let mut to = sample;
                to[axis] += rng.coordinate(-reach, reach);
                v.position = SubpixelPoint::new(to[0], to[1]);
            }
        }
        // A window of one pixel with all its samples, one of them a corner.
        5 => {
            case.window = PixelRect::window(1, 1);
            let corner = SAMPLES[number].map(|v| v as i32);
            let [right, down] = corner.map(|v| HALF_PIXEL - v);
            let times = rng.coordinate(3, 64);
            let ends = [
                [0, 0],
                [right - 3 * down, down + 3 * right],
                [right + 3 * down, down - 3 * right],
            ];
            for (v, end) in vertices.iter_mut().zip(ends) {
                v.position =
                    SubpixelPoint::new(corner[0] + times * end[0], corner[1] + times * end[1]);
            }
        }
        // Thinner than a pixel, and long enough to have all samples of many.
        4 => {
            let start = sample[1 - axis].div_euclid(SUBPIXELS) * SUBPIXELS;
            for (v, far) in vertices.iter_mut().zip([-1, 2, 1]) {
                let mut to = [0; 2];
                to[axis] = far << rng.coordinate(12, 20);
                to[1 - axis] = start + rng.coordinate(0, 8) + if far == 1 { 240 } else { 0 };
                v.position = SubpixelPoint::new(to[0], to[1]);
            }
        }
        _ => {}
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
