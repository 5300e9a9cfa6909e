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

    /// The candidates of the smallest case so far; none once all stages are over.
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
    let mut points = Vec::new();
    match &case.shape {
        Shape::Triangles { list, .. } => {
            for p in list.iter().flat_map(|t| t.corners()) {
                points.push([p.x, p.y]);
            }
        }
        Shape::Lines(lines) => {
            for end in lines.iter().flat_map(|l| l.ends) {
                points.push([end.pixel.x, end.pixel.y]);
            }
        }
        Shape::Unsnapped { .. } | Shape::Numbers { .. } => {}
    }
    points
}

/// The least and the largest coordinate of points on an axis; nothing of none.
fn extent(points: &[Point], axis: usize) -> Option<[i32; 2]> {
    let mut ends = None;
    for point in points {
        let [least, most] = ends.unwrap_or([point[axis]; 2]);
        ends = Some([least.min(point[axis]), most.max(point[axis])]);
    }
    ends
}

/// The case in a window that holds the whole shape with a pixel to spare, if that is small.
fn around(case: &Case) -> Option<Case> {
    let points = points(case);
    let unit = if matches!(case.shape, Shape::Triangles { .. }) { SUBPIXELS } else { 1 };
    let [x0, x1] = range_around(extent(&points, 0)?, unit)?;
    let [y0, y1] = range_around(extent(&points, 1)?, unit)?;
    Some(Case { window: PixelRect { x0, y0, x1, y1 }, shape: case.shape.clone() })
}

/// From the pixel before the first to one past the pixel behind the last, if these are at most 48; a pixel has so many units.
fn range_around([least, most]: [i32; 2], unit: i32) -> Option<[i32; 2]> {
    let first = i64::from(least.div_euclid(unit)) - 1;
    let end = i64::from(most.div_euclid(unit)) + 2;
    if end - first > 48 {
        return None;
    }
    Some([i32::try_from(first).ok()?, i32::try_from(end).ok()?])
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
    // How far they reach in x and in y together.
    let mut reach = 0;
    for [least, most] in [extent(&points, 0), extent(&points, 1)].into_iter().flatten() {
        reach += u64::from(most.abs_diff(least));
    }
    let far = all.iter().map(|v| u64::from(v.unsigned_abs())).sum();
    match &case.shape {
        Shape::Triangles { list, .. } => {
            let odd = all.iter().filter(|v| **v & (HALF_PIXEL - 1) != 0).count();
            let bits = all.iter().map(|v| (v & (SUBPIXELS - 1)).count_ones()).sum();
            (list.len(), own, odd, reach.div_ceil(SUBPIXELS as u64), bits, far, window)
        }
        Shape::Lines(lines) => (lines.len(), own, 0, reach, 0, far, window),
        Shape::Unsnapped { list, .. } => {
            let (mut bits, mut far) = (0, 0);
            for value in list.iter().flat_map(|t| t.px()).flatten() {
                bits += mantissa_bits(value);
                far += value.abs() as u64;
            }
            (list.len(), own, 0, 0, bits, far, window)
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

/// What a step makes of a case, in the order in which it is looked at.
fn candidates(case: &Case) -> Vec<Case> {
    let mut found = vec![plain(case)];
    match &case.shape {
        Shape::Triangles { list, .. } if list.len() > 1 => {
            // One triangle alone, else one fewer.
            let mut lists = Vec::new();
            for triangle in list {
                lists.push(vec![*triangle]);
            }
            for i in 0..list.len() {
                lists.push([&list[..i], &list[i + 1..]].concat());
            }
            for list in lists {
                let shape = Shape::Triangles { list, disjoint: false };
                found.push(Case { window: case.window, shape });
            }
        }
        Shape::Lines(lines) if lines.len() > 1 => {
            for line in lines {
                found.push(Case { window: case.window, shape: Shape::Lines(vec![*line]) });
            }
        }
        Shape::Unsnapped { list, .. } if list.len() > 1 => {
            for triangle in list {
                found.push(Case::unsnapped(case.window, vec![*triangle]));
            }
        }
        Shape::Triangles { .. } => found.extend(triangle_candidates(case)),
        Shape::Lines(_) => found.extend(line_candidates(case)),
        Shape::Unsnapped { list, .. } => {
            for triangle in list.iter().flat_map(free_candidates) {
                found.push(Case::unsnapped(case.window, vec![triangle]));
            }
        }
        // What only programs are asked, the judge makes smaller.
        Shape::Numbers { .. } => {}
    }
    found
}

/// The one shape of a case in this window, with its corners or ends at other places.
fn placed(case: &Case, window: PixelRect, points: &[Point]) -> Case {
    let mut shape = case.shape.clone();
    match &mut shape {
        Shape::Triangles { list, disjoint } => {
            *disjoint = false;
            for (vertex, [x, y]) in list.iter_mut().flat_map(|t| &mut t.vertices).zip(points) {
                vertex.position = SubpixelPoint::new(*x, *y);
            }
        }
        Shape::Lines(lines) => {
            for (end, [x, y]) in lines.iter_mut().flat_map(|l| &mut l.ends).zip(points) {
                end.pixel = PixelPoint::new(*x, *y);
            }
        }
        Shape::Unsnapped { .. } | Shape::Numbers { .. } => {}
    }
    Case { window, shape }
}

/// The case with one of its points at another place.
fn with_point(case: &Case, points: &[Point], number: usize, place: Point) -> Case {
    let mut points = points.to_vec();
    points[number] = place;
    placed(case, case.window, &points)
}

/// The case with one coordinate of one point replaced.
fn with_coordinate(case: &Case, points: &[Point], number: usize, axis: usize, value: i32) -> Case {
    let mut place = points[number];
    place[axis] = value;
    with_point(case, points, number, place)
}

/// Points between two, nearest to the second first, a whole number of `unit` from the first: what lies on
/// the edge between them goes on lying there.
fn between(unit: i32, [x0, y0]: Point, [x1, y1]: Point) -> Vec<Point> {
    let [dx, dy] = [i64::from(x1) - i64::from(x0), i64::from(y1) - i64::from(y0)];
    let (mut divisor, mut rest) = (dx.abs(), dy.abs());
    while rest > 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    // The edge is cut into so many equal steps between points of the grid.
    let steps = divisor / i64::from(unit);
    let mut points = Vec::new();
    for k in [steps - 1, steps / 2, 1] {
        if 0 < k && k < steps {
            let (x, y) = (i64::from(x0) + dx / steps * k, i64::from(y0) + dy / steps * k);
            points.push([x as i32, y as i32]);
        }
    }
    points
}

/// A triangle nearer to the origin, on multiples of half a pixel, shorter, or with simpler coordinates.
fn triangle_candidates(case: &Case) -> Vec<Case> {
    let Ok(corners) = <[Point; 3]>::try_from(points(case)) else { return Vec::new() };
    let w = case.window;
    let mut found = Vec::new();
    // To the origin, window and all.
    if (w.x0, w.y0) != (0, 0) {
        let window = PixelRect::window(w.width(), w.height());
        found.push(placed(case, window, &corners.map_array(|p| back(p, [w.x0, w.y0]))));
    }
    // A smaller window, around the origin.
    for window in smaller_windows(w) {
        found.push(placed(case, window, &corners));
    }
    // By whole pixels towards the origin.
    for px in [[16, 0], [0, 16], [4, 0], [0, 4], [1, 0], [0, 1]] {
        found.push(placed(case, w, &corners.map_array(|p| back(p, px))));
    }
    // Everything to a multiple of half a pixel, then one corner: a tie that needs both of its
    // coordinates survives no step along one axis.
    for offset in [HALF_PIXEL / 2, 0, HALF_PIXEL - 1] {
        found.push(placed(case, w, &corners.map_array(|p| halves(p, [offset; 2]))));
    }
    for (corner, point) in corners.into_iter().enumerate() {
        for nearby in NEARBY {
            found.push(with_point(case, &corners, corner, halves(point, nearby)));
        }
    }
    // A corner along its edges towards the other two.
    for (corner, other) in [(0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2)] {
        let [from, to] = [corners[corner], corners[other]];
        let on_halves = [from, to].as_flattened().iter().all(|v| v % HALF_PIXEL == 0);
        for point in between(if on_halves { HALF_PIXEL } else { 1 }, from, to) {
            found.push(with_point(case, &corners, corner, point));
        }
    }
    // Everything closer to the first corner, then each coordinate alone.
    found.push(placed(case, w, &corners.map_array(|p| halfway(p, corners[0]))));
    for (corner, point) in corners.into_iter().enumerate() {
        for (axis, own) in point.into_iter().enumerate() {
            for value in simpler_coordinates(own) {
                found.push(with_coordinate(case, &corners, corner, axis, value));
            }
        }
    }
    found
}

/// A point so many pixels to the left and up, or at the border of the domain.
fn back([x, y]: Point, [dx, dy]: Point) -> Point {
    [x.saturating_sub(dx.saturating_mul(SUBPIXELS)), y.saturating_sub(dy.saturating_mul(SUBPIXELS))]
}

/// The point in the middle of two, rounded towards zero.
fn halfway([x0, y0]: Point, [x1, y1]: Point) -> Point {
    let (x, y) = (i64::from(x0) + i64::from(x1), i64::from(y0) + i64::from(y1));
    [(x / 2) as i32, (y / 2) as i32]
}

/// Half the window, then a row or column less, around its upper left corner; none that is empty.
fn smaller_windows(w: PixelRect) -> Vec<PixelRect> {
    let (width, height) = (w.width(), w.height());
    let mut windows = Vec::new();
    for (width, height) in
        [(width / 2, height), (width, height / 2), (width - 1, height), (width, height - 1)]
    {
        if width > 0 && height > 0 {
            windows.push(PixelRect { x1: w.x0 + width as i32, y1: w.y0 + height as i32, ..w });
        }
    }
    windows
}

/// What is added before rounding down to multiples of half a pixel: nearest first, then the other
/// three around a point.
const NEARBY: [Point; 5] =
    [[HALF_PIXEL / 2; 2], [0; 2], [HALF_PIXEL - 1, 0], [0, HALF_PIXEL - 1], [HALF_PIXEL - 1; 2]];

/// The point on the grid of half pixels that rounding down finds so much further on.
fn halves([x, y]: Point, [dx, dy]: Point) -> Point {
    let (x, y) = (x.saturating_add(dx), y.saturating_add(dy));
    [x & !(HALF_PIXEL - 1), y & !(HALF_PIXEL - 1)]
}

/// Nearer to zero, on pixel borders, on centres.
fn simpler_coordinates(value: i32) -> Vec<i32> {
    let border = value.div_euclid(SUBPIXELS).saturating_mul(SUBPIXELS);
    let mut simpler = vec![
        0,
        value / 2,
        border,
        border.saturating_add(SUBPIXELS),
        border.saturating_add(HALF_PIXEL),
        towards_zero(value, 4 * SUBPIXELS),
        towards_zero(value, SUBPIXELS),
        towards_zero(value, HALF_PIXEL),
        towards_zero(value, 1),
        value & !63,
        value & !15,
        value & !3,
        value & !1,
    ];
    simpler.retain(|&v| v != value);
    simpler
}

/// A number so much nearer to zero, or zero.
fn towards_zero(value: i32, by: i32) -> i32 {
    value - value.signum() * by.min(value.saturating_abs())
}

/// A line in a smaller window, moved, shorter, or with simpler coordinates.
fn line_candidates(case: &Case) -> Vec<Case> {
    let Ok(ends) = <[Point; 2]>::try_from(points(case)) else { return Vec::new() };
    let mut found = Vec::new();
    for window in smaller_windows(case.window) {
        found.push(placed(case, window, &ends));
    }
    for [dx, dy] in [[8, 0], [0, 8], [1, 0], [0, 1], [-8, 0], [0, -8], [-1, 0], [0, -1]] {
        let moved = ends.map_array(|[x, y]| [x.saturating_sub(dx), y.saturating_sub(dy)]);
        found.push(placed(case, case.window, &moved));
    }
    for (end, point) in ends.into_iter().enumerate() {
        for place in between(1, point, ends[1 - end]) {
            found.push(with_point(case, &ends, end, place));
        }
        for (axis, value) in point.into_iter().enumerate() {
            let [far, near, next] = [8, 2, 1].map_array(|by| towards_zero(value, by));
            for simpler in [0, value / 2, far, near, next] {
                found.push(with_coordinate(case, &ends, end, axis, simpler));
            }
        }
    }
    found
}

/// Fewer bits in one coordinate of a triangle that is not snapped.
fn free_candidates(triangle: &FreeCorners) -> Vec<FreeCorners> {
    let mut found = Vec::new();
    for (corner, axis) in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 0), (2, 1)] {
        let value = triangle.px()[corner][axis];
        let mut simpler = vec![0.0, value.round(), value.floor() + 0.5];
        // The last bits of the mantissa are cut off, many of them first.
        for bits in [52, 48, 44, 40, 36, 32, 29, 24, 20, 16, 12, 8, 4, 2, 1] {
            simpler.push(f64::from_bits(value.to_bits() & !((1 << bits) - 1)));
        }
        for simpler in simpler {
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
    let mut shapes = Vec::new();
    match &case.shape {
        Shape::Triangles { list, .. } => {
            for triangle in list {
                let px = triangle.corners().map_array(|p| p.to_px());
                shapes.push(px.map_array(|(x, y)| format!("{x},{y}")).join(" "));
            }
        }
        Shape::Lines(lines) => {
            for line in lines {
                let ends = line.ends.map_array(|end| format!("{},{}", end.pixel.x, end.pixel.y));
                shapes.push(ends.join(" "));
            }
        }
        Shape::Unsnapped { list, .. } => {
            for triangle in list {
                let px = triangle.px().map_array(|[x, y]| format!("{x:?},{y:?}"));
                shapes.push(px.join(" "));
            }
        }
        Shape::Numbers { formula, numbers } => {
            let mut text = formula.name().to_owned();
            for number in numbers {
                text += &format!(" {number}");
            }
            shapes.push(text);
        }
    }
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
