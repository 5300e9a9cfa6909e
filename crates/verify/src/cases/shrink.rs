//! Makes a failing case small enough to read, while it goes on failing.
//!
//! Greedy: of the steps below, take the first that makes the case smaller and still fails, and start
//! again; stop when none does. Values that tell the corners apart come first, then corners on multiples
//! of half a pixel, then short ones. The number of trials is bounded, so a slow engine costs little.

use std::vec;

use num_traits::Float as _;

use super::named::{plain_line, plain_triangle};
use super::{Case, Shape};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{FreeCorners, PixelPoint};

/// Candidates that a stage looks at.
const MOST_TRIALS: u32 = 3000;

/// By which steps the failing cases of a kind get smaller.
pub trait Steps {
    type Case: Clone;
    /// Stages that come one after the other.
    const STAGES: usize = 1;

    /// The cases that a stage makes of one, those to look at first in front.
    fn candidates(&self, stage: usize, case: &Self::Case) -> Vec<Self::Case>;

    /// Whether a candidate is smaller than the case that it was made of, and one to ask.
    fn is_step(&self, stage: usize, from: &Self::Case, to: &Self::Case) -> bool;
}

/// A search for a smaller case, as a value: it returns which cases to try next, and is given which of them fail. It calls nobody.
#[derive(Clone, Debug)]
pub struct SmallerSearch<C> {
    /// The smallest case so far that fails.
    pub smallest: C,
    stage: usize,
    candidates: vec::IntoIter<C>,
    /// Candidates that this stage has looked at.
    trials: u32,
    /// Cases that wait for an answer, with the number of trials when they were looked at.
    asked: Vec<(u32, C)>,
}

impl<C: Clone> SmallerSearch<C> {
    /// The case fails.
    pub fn new(case: C, steps: &impl Steps<Case = C>) -> Self {
        let candidates = steps.candidates(0, &case).into_iter();
        Self { smallest: case, stage: 0, candidates, trials: 0, asked: Vec::new() }
    }

    /// The cases to ask next, at most so many; none at the end. The result does not depend on how many are asked at once.
    pub fn next<S: Steps<Case = C>>(&mut self, steps: &S, most: usize) -> Vec<C> {
        self.asked.clear();
        while self.asked.len() < most && self.stage < S::STAGES {
            let candidate = self.candidates.next().filter(|_| self.trials < MOST_TRIALS);
            let Some(candidate) = candidate else {
                if !self.asked.is_empty() {
                    break;
                }
                // No step of this stage fails.
                (self.stage, self.trials) = (self.stage + 1, 0);
                self.begin_step(steps);
                continue;
            };
            self.trials += 1;
            if steps.is_step(self.stage, &self.smallest, &candidate) {
                self.asked.push((self.trials, candidate));
            }
        }
        self.asked.iter().map(|(_, case)| case.clone()).collect()
    }

    /// Goes on from the first of the cases that fails.
    pub fn answer<S: Steps<Case = C>>(&mut self, steps: &S, fails: &[bool]) {
        let Some(at) = fails.iter().position(|fails| *fails) else { return };
        (self.trials, self.smallest) = self.asked.swap_remove(at);
        self.begin_step(steps);
    }

    fn begin_step<S: Steps<Case = C>>(&mut self, steps: &S) {
        let is_over = self.stage >= S::STAGES;
        let candidates =
            if is_over { Vec::new() } else { steps.candidates(self.stage, &self.smallest) };
        self.candidates = candidates.into_iter();
    }
}

/// The smallest case reached from `case`, which fails, while `fails` holds.
pub fn smallest<S: Steps>(case: S::Case, steps: &S, fails: impl Fn(&S::Case) -> bool) -> S::Case {
    let mut search = SmallerSearch::new(case, steps);
    while let Some(case) = search.next(steps, 1).pop() {
        search.answer(steps, &[fails(&case)]);
    }
    search.smallest
}

/// Steps by which a size gets smaller.
struct BySize<'a, C, S> {
    size: &'a dyn Fn(&C) -> S,
    candidates: &'a dyn Fn(&C) -> Vec<C>,
}

impl<C: Clone, S: PartialOrd> Steps for BySize<'_, C, S> {
    type Case = C;

    fn candidates(&self, _: usize, case: &C) -> Vec<C> {
        (self.candidates)(case)
    }

    fn is_step(&self, _: usize, from: &C, to: &C) -> bool {
        (self.size)(to) < (self.size)(from)
    }
}

/// The smallest case reached from `case`, which fails, through `candidates` that are smaller and fail too.
pub fn greedy<C: Clone, S: PartialOrd>(
    case: C,
    size: impl Fn(&C) -> S,
    candidates: impl Fn(&C) -> Vec<C>,
    fails: impl Fn(&C) -> bool,
) -> C {
    smallest(case, &BySize { size: &size, candidates: &candidates }, fails)
}

/// The steps of the cases of the comparison.
pub struct CaseSteps;

impl Steps for CaseSteps {
    type Case = Case;
    const STAGES: usize = 2;

    /// In the end, all of it is shown where it fails in the larger window too.
    fn candidates(&self, stage: usize, case: &Case) -> Vec<Case> {
        if stage == 0 { candidates(case) } else { around(case).into_iter().collect() }
    }

    fn is_step(&self, stage: usize, from: &Case, to: &Case) -> bool {
        if stage == 0 { size(to) < size(from) } else { to != from }
    }
}

/// The smallest case reached from `case` for which `fails` holds; `case` itself fails.
pub fn shrink(case: Case, fails: impl Fn(&Case) -> bool) -> Case {
    smallest(case, &CaseSteps, fails)
}

type Point = [i32; 2];

/// The corners of all triangles in subpixels, or the ends of all lines in pixels; corners that are not snapped are neither.
fn points(case: &Case) -> Vec<Point> {
    match &case.shape {
        Shape::Triangles { list, .. } => {
            list.iter().flat_map(|t| t.corners()).map(|p| [p.x, p.y]).collect()
        }
        Shape::Lines(lines) => {
            lines.iter().flat_map(|l| l.ends).map(|end| [end.pixel.x, end.pixel.y]).collect()
        }
        Shape::Unsnapped { .. } | Shape::Numbers { .. } => Vec::new(),
    }
}

/// The case in a window that holds the whole shape with a pixel to spare, if that is small.
fn around(case: &Case) -> Option<Case> {
    let points = points(case);
    let px = |v: i32| match case.shape {
        Shape::Triangles { .. } => i64::from(v.div_euclid(SUBPIXELS)),
        _ => i64::from(v),
    };
    let range = |axis: usize| {
        let along = || points.iter().map(|p| px(p[axis]));
        let (first, end) = (along().min()? - 1, along().max()? + 2);
        (end - first <= 48).then(|| Some((i32::try_from(first).ok()?, i32::try_from(end).ok()?)))?
    };
    let ((x0, x1), (y0, y1)) = (range(0)?, range(1)?);
    Some(Case { window: PixelRect { x0, y0, x1, y1 }, shape: case.shape.clone() })
}

/// The case with the values that `inspect` gives to corners which are typed in.
fn plain(case: &Case) -> Case {
    let shape = match &case.shape {
        Shape::Triangles { list, disjoint } => {
            let list = list.iter().map(|t| plain_triangle(t.corners())).collect();
            Shape::Triangles { list, disjoint: *disjoint }
        }
        Shape::Lines(lines) => {
            let ends = lines.iter().map(|line| line.ends.map_array(|end| end.pixel));
            Shape::Lines(ends.map(|[a, b]| plain_line(a, b)).collect())
        }
        free @ (Shape::Unsnapped { .. } | Shape::Numbers { .. }) => free.clone(),
    };
    Case { window: case.window, shape }
}

/// Whether its positions say all: [`describe`] and `inspect` then lead to the same case.
#[must_use]
pub fn has_plain_values(case: &Case) -> bool {
    plain(case).shape == case.shape
}

/// Shapes, then whether they have values of their own, then coordinates that are no multiple of half a
/// pixel, then how far the shapes reach in pixels, then how many subpixel bits they need, then how far
/// from the origin they lie, then the window. Corners that are not snapped count by the bits of their mantissas.
#[must_use]
pub fn size(case: &Case) -> (usize, bool, usize, u64, u32, u64, u64) {
    let own = !has_plain_values(case);
    let window = u64::from(case.window.width()) + u64::from(case.window.height());
    let points = points(case);
    let all = points.as_flattened();
    let reach = |axis: usize| {
        let along = || points.iter().map(|p| p[axis]);
        along().max().zip(along().min()).map_or(0, |(max, min)| u64::from(max.abs_diff(min)))
    };
    let reach = reach(0) + reach(1);
    let far = all.iter().map(|v| u64::from(v.unsigned_abs())).sum();
    match &case.shape {
        Shape::Triangles { list, .. } => {
            let odd = all.iter().filter(|v| **v & (HALF_PIXEL - 1) != 0).count();
            let bits = all.iter().map(|v| (v & (SUBPIXELS - 1)).count_ones()).sum();
            (list.len(), own, odd, reach.div_ceil(SUBPIXELS as u64), bits, far, window)
        }
        Shape::Lines(lines) => (lines.len(), own, 0, reach, 0, far, window),
        Shape::Unsnapped { list, .. } => {
            let values = || list.iter().flat_map(|t| t.px()).flatten();
            let bits = values().map(mantissa_bits).sum();
            (list.len(), own, 0, 0, bits, values().map(|v| v.abs() as u64).sum(), window)
        }
        Shape::Numbers { .. } => (1, own, 0, 0, 0, 0, window),
    }
}

/// Bits from the first to the last that is set in a mantissa.
fn mantissa_bits(value: f64) -> u32 {
    let (mantissa, ..) = value.integer_decode();
    if mantissa == 0 { 0 } else { 64 - mantissa.leading_zeros() - mantissa.trailing_zeros() }
}

/// The cases that a step makes of `case` and that are smaller: those to look at for one that still fails.
#[must_use]
pub fn smaller_cases(case: &Case) -> Vec<Case> {
    let current = size(case);
    candidates(case).into_iter().filter(|candidate| size(candidate) < current).collect()
}

fn candidates(case: &Case) -> Vec<Case> {
    let with = |shape: Shape| Case { window: case.window, shape };
    let shapes = match &case.shape {
        Shape::Triangles { list, .. } if list.len() > 1 => {
            // One triangle alone, else one fewer.
            let alone = list.iter().map(|t| vec![*t]);
            let fewer = (0..list.len()).map(|i| [&list[..i], &list[i + 1..]].concat());
            let lists = alone.chain(fewer);
            lists.map(|list| with(Shape::Triangles { list, disjoint: false })).collect()
        }
        Shape::Lines(lines) if lines.len() > 1 => {
            lines.iter().map(|line| with(Shape::Lines(vec![*line]))).collect()
        }
        Shape::Unsnapped { list, .. } if list.len() > 1 => {
            list.iter().map(|t| Case::unsnapped(case.window, vec![*t])).collect()
        }
        Shape::Triangles { .. } => triangle_candidates(case),
        Shape::Lines(_) => line_candidates(case),
        Shape::Unsnapped { list, .. } => {
            let simpler = list.first().map(free_candidates).unwrap_or_default();
            simpler.into_iter().map(|t| Case::unsnapped(case.window, vec![t])).collect()
        }
        // What only programs are asked, the judge makes smaller.
        Shape::Numbers { .. } => Vec::new(),
    };
    std::iter::once(plain(case)).chain(shapes).collect()
}

/// The one shape of a case in this window, each corner or end moved.
fn moved(case: &Case, window: PixelRect, by: &dyn Fn(usize, Point) -> Point) -> Case {
    let mut shape = case.shape.clone();
    match &mut shape {
        Shape::Triangles { list, disjoint } => {
            *disjoint = false;
            for (i, vertex) in list.iter_mut().flat_map(|t| &mut t.vertices).enumerate() {
                let [x, y] = by(i, [vertex.position.x, vertex.position.y]);
                vertex.position = SubpixelPoint::new(x, y);
            }
        }
        Shape::Lines(lines) => {
            for (i, end) in lines.iter_mut().flat_map(|l| &mut l.ends).enumerate() {
                let [x, y] = by(i, [end.pixel.x, end.pixel.y]);
                end.pixel = PixelPoint::new(x, y);
            }
        }
        Shape::Unsnapped { .. } | Shape::Numbers { .. } => {}
    }
    Case { window, shape }
}

/// Points between two, nearest to the second first, a whole number of `unit` from the first: what lies on
/// the edge between them goes on lying there.
fn between(unit: i32, [x0, y0]: Point, [x1, y1]: Point) -> impl Iterator<Item = Point> {
    let [dx, dy] = [i64::from(x1) - i64::from(x0), i64::from(y1) - i64::from(y0)];
    let (mut divisor, mut rest) = (dx.abs(), dy.abs());
    while rest > 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    let steps = divisor / i64::from(unit);
    let at = move |k: i64| {
        [(x0, dx), (y0, dy)].map_array(|(v, d)| (i64::from(v) + d / steps * k) as i32)
    };
    [steps - 1, steps / 2, 1].into_iter().filter(move |&k| 0 < k && k < steps).map(at)
}

fn triangle_candidates(case: &Case) -> Vec<Case> {
    let Ok(corners) = <[Point; 3]>::try_from(points(case)) else { return Vec::new() };
    let w = case.window;
    let here = |by: &dyn Fn(usize, Point) -> Point| moved(case, w, by);
    let mut found = Vec::new();
    // To the origin, window and all.
    if (w.x0, w.y0) != (0, 0) {
        let shift = |v: i32, px: i32| v.saturating_sub(px.saturating_mul(SUBPIXELS));
        let window = PixelRect::window(w.width(), w.height());
        found.push(moved(case, window, &|_, [x, y]| [shift(x, w.x0), shift(y, w.y0)]));
    }
    // A smaller window, around the origin.
    found.extend(smaller_windows(w).map(|window| moved(case, window, &|_, p| p)));
    // By whole pixels towards the origin.
    for px in [[16, 0], [0, 16], [4, 0], [0, 4], [1, 0], [0, 1]] {
        let along = |p: Point, axis: usize| p[axis].saturating_sub(px[axis] * SUBPIXELS);
        found.push(here(&|_, p| [along(p, 0), along(p, 1)]));
    }
    // Everything to a multiple of half a pixel, then one corner: a tie that needs both of its
    // coordinates survives no step along one axis.
    for offset in [HALF_PIXEL / 2, 0, HALF_PIXEL - 1] {
        found.push(here(&|_, p| halves(p, [offset; 2])));
    }
    for corner in 0..3 {
        for nearby in NEARBY {
            found.push(here(&|i, p| if i == corner { halves(p, nearby) } else { p }));
        }
    }
    // A corner along its edges towards the other two.
    for (corner, other) in [(0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2)] {
        let [from, to] = [corners[corner], corners[other]];
        let on_halves = [from, to].as_flattened().iter().all(|v| v % HALF_PIXEL == 0);
        for point in between(if on_halves { HALF_PIXEL } else { 1 }, from, to) {
            found.push(here(&|i, p| if i == corner { point } else { p }));
        }
    }
    // Everything closer to the first corner, then each coordinate alone.
    let first = corners[0];
    let halfway = |a: i32, b: i32| ((i64::from(a) + i64::from(b)) / 2) as i32;
    found.push(here(&|_, [x, y]| [halfway(x, first[0]), halfway(y, first[1])]));
    for (corner, point) in corners.into_iter().enumerate() {
        for (axis, own) in point.into_iter().enumerate() {
            let simpler = simpler_coordinates(own);
            found.extend(simpler.into_iter().map(|value| here(&one_at(corner, axis, value))));
        }
    }
    found
}

/// Replaces one coordinate of one point.
fn one_at(point: usize, axis: usize, value: i32) -> impl Fn(usize, Point) -> Point {
    move |i, mut p| {
        if i == point {
            p[axis] = value;
        }
        p
    }
}

/// Half the window, then a row or column less, around its upper left corner; none that is empty.
fn smaller_windows(w: PixelRect) -> impl Iterator<Item = PixelRect> {
    let (width, height) = (w.width(), w.height());
    [(width / 2, height), (width, height / 2), (width - 1, height), (width, height - 1)]
        .into_iter()
        .filter(|&(width, height)| width > 0 && height > 0)
        .map(move |(width, height)| PixelRect {
            x1: w.x0 + width as i32,
            y1: w.y0 + height as i32,
            ..w
        })
}

/// What is added before rounding down to multiples of half a pixel: nearest first, then the other
/// three around a point.
const NEARBY: [Point; 5] =
    [[HALF_PIXEL / 2; 2], [0; 2], [HALF_PIXEL - 1, 0], [0, HALF_PIXEL - 1], [HALF_PIXEL - 1; 2]];

/// The point on the grid of half pixels that rounding down finds so much further on.
fn halves([x, y]: Point, [dx, dy]: Point) -> Point {
    let down = |v: i32, d: i32| v.saturating_add(d) & !(HALF_PIXEL - 1);
    [down(x, dx), down(y, dy)]
}

/// Nearer to zero, on pixel borders, on centres.
fn simpler_coordinates(value: i32) -> Vec<i32> {
    let border = value.div_euclid(SUBPIXELS).saturating_mul(SUBPIXELS);
    let step = |v: i32| value - value.signum() * v.min(value.saturating_abs());
    let mut simpler = vec![
        0,
        value / 2,
        border,
        border.saturating_add(SUBPIXELS),
        border.saturating_add(HALF_PIXEL),
        step(4 * SUBPIXELS),
        step(SUBPIXELS),
        step(HALF_PIXEL),
        step(1),
        value & !63,
        value & !15,
        value & !3,
        value & !1,
    ];
    simpler.retain(|&v| v != value);
    simpler
}

fn line_candidates(case: &Case) -> Vec<Case> {
    let Ok(ends) = <[Point; 2]>::try_from(points(case)) else { return Vec::new() };
    let w = case.window;
    let here = |by: &dyn Fn(usize, Point) -> Point| moved(case, w, by);
    let mut found: Vec<Case> =
        smaller_windows(w).map(|window| moved(case, window, &|_, p| p)).collect();
    for (dx, dy) in [(8, 0), (0, 8), (1, 0), (0, 1), (-8, 0), (0, -8), (-1, 0), (0, -1)] {
        found.push(here(&|_, [x, y]| [x.saturating_sub(dx), y.saturating_sub(dy)]));
    }
    for end in 0..2 {
        for point in between(1, ends[end], ends[1 - end]) {
            found.push(here(&|i, p| if i == end { point } else { p }));
        }
        for (axis, value) in ends[end].into_iter().enumerate() {
            let step = |v: i32| value - value.signum() * v.min(value.saturating_abs());
            let simpler = [0, value / 2, step(8), step(2), step(1)];
            found.extend(simpler.map(|value| here(&one_at(end, axis, value))));
        }
    }
    found
}

/// Fewer bits in one coordinate of a triangle that is not snapped.
fn free_candidates(triangle: &FreeCorners) -> Vec<FreeCorners> {
    let cut = |value: f64, bits: u64| f64::from_bits(value.to_bits() & !((1 << bits) - 1));
    let mut found = Vec::new();
    for (corner, axis) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)] {
        let value = triangle.px()[corner][axis];
        let nearby = [0.0, value.round(), value.floor() + 0.5];
        let bits = [52, 48, 44, 40, 36, 32, 29, 24, 20, 16, 12, 8, 4, 2, 1];
        for simpler in nearby.into_iter().chain(bits.map(|bits| cut(value, bits))) {
            let mut px = triangle.px();
            px[corner][axis] = simpler;
            if simpler != value {
                found.extend(FreeCorners::new(px));
            }
        }
    }
    found
}

/// The positions of a case in pixels, as the command line takes them; those that are not snapped with all digits.
#[must_use]
pub fn describe(case: &Case) -> String {
    let px = |p: SubpixelPoint| {
        let (x, y) = p.to_px();
        format!("{x},{y}")
    };
    let shapes: Vec<String> = match &case.shape {
        Shape::Triangles { list, .. } => {
            list.iter().map(|t| t.corners().map_array(px).join(" ")).collect()
        }
        Shape::Lines(lines) => lines
            .iter()
            .map(|l| l.ends.map_array(|e| format!("{},{}", e.pixel.x, e.pixel.y)).join(" "))
            .collect(),
        Shape::Unsnapped { list, .. } => {
            let px = |[x, y]: [f64; 2]| format!("{x:?},{y:?}");
            list.iter().map(|t| t.px().map_array(px).join(" ")).collect()
        }
        Shape::Numbers { formula, numbers } => {
            vec![numbers.iter().fold(formula.name().to_owned(), |text, n| format!("{text} {n}"))]
        }
    };
    shapes.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::{lines, triangles, unsnapped};

    /// The smallest case, with so many asked at once, and the way to it.
    fn found(case: &Case, most: usize, fails: &dyn Fn(&Case) -> bool) -> Vec<Case> {
        let mut search = SmallerSearch::new(case.clone(), &CaseSteps);
        let mut way = vec![case.clone()];
        loop {
            let asked = search.next(&CaseSteps, most);
            if asked.is_empty() {
                return way;
            }
            assert!(asked.len() <= most);
            search.answer(&CaseSteps, &asked.iter().map(fails).collect::<Vec<_>>());
            if way.last() != Some(&search.smallest) {
                way.push(search.smallest.clone());
            }
        }
    }

    /// Whoever answers one case at a time is led the same way as whoever answers 512, and so is who answers not all of them.
    #[test]
    fn the_smallest_case_does_not_depend_on_how_many_are_asked_at_once() {
        let mut steps = 0;
        for family in [triangles::FAMILIES, lines::FAMILIES, unsnapped::FAMILIES].concat() {
            for index in 0..6 {
                let case = family.case(2, index);
                // Fails where it needs many bits, so that the way is long.
                let fails = |case: &Case| size(case).4 % 3 != 1 && size(case).5 > 4;
                let way = found(&case, 1, &fails);
                for most in [2, 7, 512] {
                    assert_eq!(found(&case, most, &fails), way, "{} {index} {most}", family.name);
                }
                assert_eq!(shrink(case, fails), *way.last().unwrap());
                steps += way.len();
            }
        }
        assert!(steps > 2000, "{steps}");
    }
}
