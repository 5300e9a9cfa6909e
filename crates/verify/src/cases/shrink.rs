//! Makes a failing case small enough to read, while it goes on failing.
//!
//! Greedy: of the steps below, take the first that makes the case smaller and still fails, and start
//! again; stop when none does. Values that tell the corners apart come first, then corners on multiples
//! of half a pixel, then short ones. The number of trials is bounded, so a slow engine costs little.

use super::named::{plain_line, plain_triangle};
use super::{Case, Line, Shape, Triangle};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::PixelPoint;

const MOST_TRIALS: u32 = 3000;

/// The smallest case reached from `case`, which fails, through `candidates` that are smaller and
/// fail too; at most `MOST_TRIALS` are looked at.
pub fn greedy<C, S: PartialOrd>(
    case: C,
    size: impl Fn(&C) -> S,
    candidates: impl Fn(&C) -> Vec<C>,
    fails: impl Fn(&C) -> bool,
) -> C {
    let mut smallest = case;
    let mut trials = 0;
    loop {
        let current = size(&smallest);
        let better = candidates(&smallest).into_iter().find(|candidate| {
            trials += 1;
            trials <= MOST_TRIALS && size(candidate) < current && fails(candidate)
        });
        match better {
            Some(better) => smallest = better,
            None => return smallest,
        }
    }
}

/// The smallest case reached from `case` for which `fails` holds; `case` itself fails.
pub fn shrink(case: Case, fails: impl Fn(&Case) -> bool) -> Case {
    let smallest = greedy(case, size, candidates, &fails);
    // Show all of it, where it fails in the larger window too.
    match around(&smallest).filter(|whole| fails(whole)) {
        Some(whole) => whole,
        None => smallest,
    }
}

/// The case in a window that holds the whole shape with a pixel to spare, if that is small.
fn around(case: &Case) -> Option<Case> {
    let points: Vec<(i64, i64)> = match &case.shape {
        Shape::Triangles { list, .. } => {
            let px = |sub: i32| i64::from(sub.div_euclid(SUBPIXELS));
            list.iter().flat_map(|t| t.corners()).map(|p| (px(p.x), px(p.y))).collect()
        }
        Shape::Lines(lines) => {
            let pixels = lines.iter().flat_map(|l| l.ends).map(|end| end.pixel);
            pixels.map(|p| (i64::from(p.x), i64::from(p.y))).collect()
        }
    };
    let range = |values: &mut dyn Iterator<Item = i64>| {
        let (min, max) = values.fold((i64::MAX, i64::MIN), |(a, b), v| (a.min(v), b.max(v)));
        let (first, end) = (min.checked_sub(1)?, max.checked_add(2)?);
        (end - first <= 48).then(|| Some((i32::try_from(first).ok()?, i32::try_from(end).ok()?)))?
    };
    let (x0, x1) = range(&mut points.iter().map(|p| p.0))?;
    let (y0, y1) = range(&mut points.iter().map(|p| p.1))?;
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
/// from the origin they lie, then the window.
#[must_use]
pub fn size(case: &Case) -> (usize, bool, usize, u64, u32, u64, u64) {
    let own = !has_plain_values(case);
    let window = u64::from(case.window.width()) + u64::from(case.window.height());
    let reach = |values: &[i64]| {
        let (min, max) =
            values.iter().fold((i64::MAX, i64::MIN), |(a, b), &v| (a.min(v), b.max(v)));
        if values.is_empty() { 0 } else { max.abs_diff(min) }
    };
    let far = |values: &[i64]| values.iter().map(|v| v.unsigned_abs()).sum::<u64>();
    match &case.shape {
        Shape::Triangles { list, .. } => {
            let points: Vec<_> = list.iter().flat_map(|t| t.corners()).collect();
            let xs: Vec<_> = points.iter().map(|p| i64::from(p.x)).collect();
            let ys: Vec<_> = points.iter().map(|p| i64::from(p.y)).collect();
            let all = || points.iter().flat_map(|p| [p.x, p.y]);
            let odd = all().filter(|v| v & (HALF_PIXEL - 1) != 0).count();
            let bits = all().map(|v| (v & (SUBPIXELS - 1)).count_ones()).sum();
            let px = (reach(&xs) + reach(&ys)).div_ceil(SUBPIXELS as u64);
            (list.len(), own, odd, px, bits, far(&xs) + far(&ys), window)
        }
        Shape::Lines(lines) => {
            let points: Vec<_> =
                lines.iter().flat_map(|l| l.ends.map_array(|end| end.pixel)).collect();
            let xs: Vec<_> = points.iter().map(|p| i64::from(p.x)).collect();
            let ys: Vec<_> = points.iter().map(|p| i64::from(p.y)).collect();
            (lines.len(), own, 0, reach(&xs) + reach(&ys), 0, far(&xs) + far(&ys), window)
        }
    }
}

/// The cases that a step makes of `case` and that are smaller: those to look at for one that still fails.
#[must_use]
pub fn smaller_cases(case: &Case) -> Vec<Case> {
    let current = size(case);
    candidates(case).into_iter().filter(|candidate| size(candidate) < current).collect()
}

fn candidates(case: &Case) -> Vec<Case> {
    let shapes = match &case.shape {
        Shape::Triangles { list, .. } => triangle_candidates(case, list),
        Shape::Lines(lines) => line_candidates(case, lines),
    };
    std::iter::once(plain(case)).chain(shapes).collect()
}

/// Points between two, nearest to the second first, a whole number of `unit` from the first: what lies on
/// the edge between them goes on lying there.
fn between(unit: i32, [x0, y0]: [i32; 2], [x1, y1]: [i32; 2]) -> impl Iterator<Item = [i32; 2]> {
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

fn triangle_candidates(case: &Case, list: &[Triangle]) -> Vec<Case> {
    let with = |window: PixelRect, list: Vec<Triangle>| Case {
        window,
        shape: Shape::Triangles { list, disjoint: false },
    };
    if list.len() > 1 {
        // One triangle alone, else one fewer.
        let alone = list.iter().map(|t| with(case.window, vec![*t]));
        let fewer = (0..list.len()).map(|i| {
            let rest = list.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, t)| *t);
            with(case.window, rest.collect())
        });
        return alone.chain(fewer).collect();
    }
    let Some(triangle) = list.first() else { return Vec::new() };
    let moved = |by: &dyn Fn(usize, SubpixelPoint) -> SubpixelPoint| {
        let mut triangle = *triangle;
        for (i, vertex) in triangle.vertices.iter_mut().enumerate() {
            vertex.position = by(i, vertex.position);
        }
        triangle
    };
    let mut found = Vec::new();
    // To the origin, window and all.
    let w = case.window;
    if (w.x0, w.y0) != (0, 0) {
        let shift = |v: i32, px: i32| v.saturating_sub(px.saturating_mul(SUBPIXELS));
        let window = PixelRect::window(w.width(), w.height());
        found.push(with(
            window,
            vec![moved(&|_, p| SubpixelPoint::new(shift(p.x, w.x0), shift(p.y, w.y0)))],
        ));
    }
    // A smaller window, around the origin.
    found.extend(smaller_windows(w).map(|window| with(window, vec![*triangle])));
    // By whole pixels towards the origin.
    for (dx, dy) in [(16, 0), (0, 16), (4, 0), (0, 4), (1, 0), (0, 1)] {
        let by = |v: i32, px: i32| v.saturating_sub(px * SUBPIXELS);
        found.push(with(w, vec![moved(&|_, p| SubpixelPoint::new(by(p.x, dx), by(p.y, dy)))]));
    }
    // Everything to a multiple of half a pixel, then one corner: a tie that needs both of its
    // coordinates survives no step along one axis.
    for offset in [HALF_PIXEL / 2, 0, HALF_PIXEL - 1] {
        found.push(with(w, vec![moved(&|_, p| halves(p, offset, offset))]));
    }
    for corner in 0..3 {
        for (dx, dy) in NEARBY {
            let by = |i: usize, p| if i == corner { halves(p, dx, dy) } else { p };
            found.push(with(w, vec![moved(&by)]));
        }
    }
    // A corner along its edges towards the other two.
    for (corner, other) in [(0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2)] {
        let [from, to] = [corner, other].map_array(|i| triangle.vertices[i].position);
        let [from, to] = [from, to].map_array(|p| [p.x, p.y]);
        let on_halves = [from, to].as_flattened().iter().all(|v| v % HALF_PIXEL == 0);
        for [x, y] in between(if on_halves { HALF_PIXEL } else { 1 }, from, to) {
            let by = |i: usize, p| if i == corner { SubpixelPoint::new(x, y) } else { p };
            found.push(with(w, vec![moved(&by)]));
        }
    }
    // Everything closer to the first corner, then each coordinate alone.
    let first = triangle.vertices[0].position;
    let halfway = |a: i32, b: i32| ((i64::from(a) + i64::from(b)) / 2) as i32;
    found.push(with(
        w,
        vec![moved(&|_, p| SubpixelPoint::new(halfway(p.x, first.x), halfway(p.y, first.y)))],
    ));
    for corner in 0..3 {
        for axis in 0..2 {
            let position = triangle.vertices[corner].position;
            let value = [position.x, position.y][axis];
            for simpler in simpler_coordinates(value) {
                found.push(with(
                    w,
                    vec![moved(&|i, p| match (i == corner, axis) {
                        (true, 0) => SubpixelPoint::new(simpler, p.y),
                        (true, _) => SubpixelPoint::new(p.x, simpler),
                        _ => p,
                    })],
                ));
            }
        }
    }
    found
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
const NEARBY: [(i32, i32); 5] = [
    (HALF_PIXEL / 2, HALF_PIXEL / 2),
    (0, 0),
    (HALF_PIXEL - 1, 0),
    (0, HALF_PIXEL - 1),
    (HALF_PIXEL - 1, HALF_PIXEL - 1),
];

/// The point on the grid of half pixels that rounding down finds from `dx`, `dy` further on.
fn halves(p: SubpixelPoint, dx: i32, dy: i32) -> SubpixelPoint {
    let down = |v: i32, d: i32| v.saturating_add(d) & !(HALF_PIXEL - 1);
    SubpixelPoint::new(down(p.x, dx), down(p.y, dy))
}

/// Nearer to zero, on pixel borders, on centres.
fn simpler_coordinates(value: i32) -> Vec<i32> {
    let border = value.div_euclid(SUBPIXELS).saturating_mul(SUBPIXELS);
    let step = |v: i32| value - value.signum() * v.min(value.abs());
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

fn line_candidates(case: &Case, lines: &[Line]) -> Vec<Case> {
    let with = |window: PixelRect, lines: Vec<Line>| Case { window, shape: Shape::Lines(lines) };
    if lines.len() > 1 {
        return lines.iter().map(|line| with(case.window, vec![*line])).collect();
    }
    let Some(line) = lines.first() else { return Vec::new() };
    let moved = |by: &dyn Fn(usize, PixelPoint) -> PixelPoint| {
        let mut line = *line;
        for (i, end) in line.ends.iter_mut().enumerate() {
            end.pixel = by(i, end.pixel);
        }
        line
    };
    let w = case.window;
    let mut found = Vec::new();
    found.extend(smaller_windows(w).map(|window| with(window, vec![*line])));
    for (dx, dy) in [(8, 0), (0, 8), (1, 0), (0, 1), (-8, 0), (0, -8), (-1, 0), (0, -1)] {
        found.push(with(
            w,
            vec![moved(&|_, p| PixelPoint::new(p.x.saturating_sub(dx), p.y.saturating_sub(dy)))],
        ));
    }
    for end in 0..2 {
        let [from, to] = [end, 1 - end].map_array(|i| line.ends[i].pixel);
        for [x, y] in between(1, [from.x, from.y], [to.x, to.y]) {
            let by = |i: usize, p| if i == end { PixelPoint::new(x, y) } else { p };
            found.push(with(w, vec![moved(&by)]));
        }
        for axis in 0..2 {
            let pixel = line.ends[end].pixel;
            let value = [pixel.x, pixel.y][axis];
            let step = |v: i32| value - value.signum() * v.min(value.abs());
            for simpler in [0, value / 2, step(8), step(2), step(1)] {
                found.push(with(
                    w,
                    vec![moved(&|i, p| match (i == end, axis) {
                        (true, 0) => PixelPoint::new(simpler, p.y),
                        (true, _) => PixelPoint::new(p.x, simpler),
                        _ => p,
                    })],
                ));
            }
        }
    }
    found
}

/// The positions of a case in pixels, as the command line takes them.
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
    };
    shapes.join("; ")
}
