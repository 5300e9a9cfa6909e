//! Wrong programs as closures of the right answer: what is learned of each.

use super::drawer::{Drawer, Lines, Triangles};
use super::known::one_changes;
use super::picture::{Picture, Runs};
use super::question::AnyQuestion;
use super::trial::Work;
use super::{Learned, SEED, Start, of_lines, of_triangles};
use crate::ask::{Asker, Search};
use crate::convention::{
    Declarations, LineConvention, LineQuestion, TriangleConvention, TriangleQuestion,
};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};

/// The right picture of a question by a rule: 0 is the right one.
type Right<'a> = &'a dyn Fn(&AnyQuestion, usize) -> Picture;
/// What a wrong program draws.
type Draw = fn(&AnyQuestion, Right<'_>) -> Picture;

/// Pixels of the right picture that are kept.
fn keep(q: &AnyQuestion, right: Right<'_>, is_kept: &dyn Fn(&Runs, [i32; 2]) -> bool) -> Picture {
    let before = right(q, 0);
    let runs = Runs::of(&before);
    let mut after = before.clone();
    let lost = before.pixels().filter(|at| before.has(*at) && !is_kept(&runs, *at));
    lost.for_each(|at| after.set(at, 0));
    after
}

/// The right picture of a question whose coordinates are changed.
fn moved(q: &AnyQuestion, right: Right<'_>, change: &dyn Fn(usize, i64) -> i64) -> Picture {
    let mut q = q.clone();
    for point in &mut q.points {
        *point = [0, 1].map(|axis| change(axis, point[axis]));
    }
    right(&q, 0)
}

fn empty(q: &AnyQuestion) -> Picture {
    Picture::new(q.side)
}

/// What is learned of a rasterizer of triangles that draws so.
pub(super) fn learn_triangles(
    draw: &dyn Fn(&AnyQuestion, Right<'_>) -> Picture,
) -> Option<Learned> {
    let (known, expected) = (Declarations::default(), TriangleConvention::default());
    let (nobody, work) = (Asker::new(), Work::default());
    let oracle = Triangles::new(&nobody, &known, [&expected; 2], &[], SEED, &work).unwrap();
    let right = |q: &AnyQuestion, rule: usize| oracle.right(q, rule).unwrap();
    let answer = |asked: &TriangleQuestion| {
        let q = AnyQuestion::from(asked);
        let picture = draw(&q, &right);
        let mut coverage = Coverage::new(asked.window, 0);
        for at in picture.pixels() {
            coverage.row_mut(at[1])[at[0] as usize] = picture.hits(at);
        }
        Some(coverage)
    };
    let starts = [Start { convention: &expected, is_right: true }];
    Search::new(async |asker| of_triangles(&asker, &known, &starts, &[]).await)
        .answered_by(|questions| questions.iter().map(answer).collect())
}

/// What goes wrong too rarely to be met by chance is learned beside a case that failed.
#[test]
fn rare_mistakes_are_learned_beside_failing_cases() {
    let convention = TriangleConvention::default();
    // It draws nothing where an edge is nearly level and long: a slope that is no number of 16 bits.
    let answer = |q: &TriangleQuestion| {
        let mut coverage = Coverage::new(q.window, 0);
        let is_steep = (0..3).any(|i| {
            let (a, b) = (q.corners[i], q.corners[(i + 1) % 3]);
            let [dx, dy] = [b.x - a.x, b.y - a.y].map(|v| i64::from(v).abs());
            dy > 0 && dx >= 32_768 * dy
        });
        let mask = convention.mask(&q.corners, q.window).filter(|_| !is_steep);
        for y in 0..q.window.y1 {
            for x in 0..q.window.x1 {
                let is_drawn = mask.is_some_and(|mask| mask.row(y) >> x & 1 == 1);
                coverage.row_mut(y)[x as usize] = u8::from(is_drawn);
            }
        }
        Some(coverage)
    };
    let window = PixelRect::window(4, 4);
    let corners =
        [[-60_000, 384], [150_000, 390], [512, 2000]].map(|[x, y]| SubpixelPoint::new(x, y));
    let known = Declarations { window_px: (24, 24), ..Declarations::default() };
    let starts = [Start { convention: &convention, is_right: true }];
    let learned = |failing| {
        Search::new(async |asker| of_triangles(&asker, &known, &starts, &[]).await)
            .beside(failing)
            .answered_by(|questions| questions.iter().map(answer).collect())
    };
    assert_eq!(learned(Vec::new()), None);
    let learned = learned(vec![TriangleQuestion { corners, window }]);
    let said = learned.unwrap().sentences().join(" ");
    assert!(said.contains("the largest |dx|/|dy| of its edges is"), "{said}");
}

/// What is learned of a line drawer that draws so.
pub(super) fn learn_lines(draw: &dyn Fn(&AnyQuestion, Right<'_>) -> Picture) -> Option<Learned> {
    let (known, expected) = (Declarations::default(), LineConvention::default());
    let (nobody, work) = (Asker::new(), Work::default());
    let oracle = Lines::new(&nobody, &known, [&expected; 2], &[], SEED, &work);
    let right = |q: &AnyQuestion, rule: usize| oracle.right(q, rule).unwrap();
    let answer = |asked: &LineQuestion| {
        let q = AnyQuestion::from(asked);
        let picture = draw(&q, &right);
        Some(picture.pixels().filter(|at| picture.has(*at)).collect())
    };
    let starts = [Start { convention: &expected, is_right: true }];
    Search::new(async |asker| of_lines(&asker, &known, &starts, &[]).await)
        .answered_by(|questions| questions.iter().map(answer).collect())
}

/// Programs after public bug reports, written before the quantities and the changes were.
const TRIANGLES: [(&str, Draw); 18] = [
    ("the row of the middle corner is missing", |q, right| {
        let middle = q.points[q.by_height()[1]][1].div_euclid(256);
        keep(q, right, &|_, [_, y]| i64::from(y) != middle)
    }),
    ("samples on a level bottom edge are drawn", |q, right| {
        let mut picture = right(q, 0);
        let [_, bottom] = q.range(1);
        let is_flat = q.points.iter().filter(|p| p[1] == bottom).count() == 2;
        if is_flat && bottom.rem_euclid(256) == 128 {
            let y = (bottom.div_euclid(256)) as i32;
            let mut up = q.clone();
            up.points.iter_mut().filter(|p| p[1] == bottom).for_each(|p| p[1] += 1);
            let row = right(&up, 0);
            picture.all().filter(|at| at[1] == y && row.has(*at)).for_each(|at| picture.set(at, 1));
        }
        picture
    }),
    ("y is rounded to 1/16 px", |q, right| {
        moved(q, right, &|axis, v| if axis == 1 { (v + 8).div_euclid(16) * 16 } else { v })
    }),
    ("the seam of 16 px tiles", |q, right| {
        let picture = right(q, 0);
        keep(q, right, &|_, [x, y]| x % 16 != 15 || !picture.has([x + 1, y]))
    }),
    ("the last column of windows of odd width", |q, right| {
        keep(q, right, &|_, [x, _]| q.side[0] % 2 == 0 || x != q.side[0] - 1)
    }),
    ("coordinates are limited to 1024 px", |q, right| {
        moved(q, right, &|_, v| v.clamp(-(1 << 18), 1 << 18))
    }),
    ("y is mirrored, one pixel off", |q, right| {
        let height = i64::from(q.side[1]);
        moved(q, right, &|axis, v| if axis == 1 { height * 256 - 256 - v } else { v })
    }),
    ("x is moved by 21/256 px", |q, right| {
        moved(q, right, &|axis, v| if axis == 0 { v + 21 } else { v })
    }),
    ("1024 px wide or 512 px high ones are dropped", |q, right| {
        let [width, height] = q.extent();
        if width >= 1024 * 256 || height >= 512 * 256 { empty(q) } else { right(q, 0) }
    }),
    ("an area below 1 px is dropped", |q, right| {
        if q.twice_area().abs() < 131_072 { empty(q) } else { right(q, 0) }
    }),
    ("what is left of groups of 8 in a row", |q, right| {
        keep(q, right, &|runs, [x, y]| {
            runs.row(y).is_some_and(|run| x - run.first < run.count / 8 * 8)
        })
    }),
    ("odd rows in windows of even width", |q, right| {
        keep(q, right, &|_, [_, y]| q.side[0] % 2 == 1 || y % 2 == 0)
    }),
    ("the bottom-right rule for counterclockwise ones", |q, right| {
        right(q, if q.twice_area() < 0 { 2 } else { 0 })
    }),
    ("rows of one pixel", |q, right| {
        keep(q, right, &|runs, [_, y]| runs.row(y).is_some_and(|run| run.count > 1))
    }),
    ("1/16 px, toward 0", |q, right| moved(q, right, &|_, v| v / 16 * 16)),
    ("the upper short edge is divided by one row too many", |q, right| {
        // The edge from the top corner goes to a point one pixel below the middle corner.
        let middle = q.by_height()[1];
        let mut longer = q.clone();
        longer.points[middle][1] += 256;
        let (upper, mut picture) = (right(&longer, 0), right(q, 0));
        let is_upper = |at: &[i32; 2]| i64::from(at[1]) * 256 + 128 < q.points[middle][1];
        picture.all().filter(is_upper).for_each(|at| picture.set(at, upper.hits(at)));
        picture
    }),
    ("the last pixel of the whole shape where it is counterclockwise", |q, right| {
        let picture = right(q, 0);
        let last = (q.range(1)[1] - 129).div_euclid(256);
        keep(q, right, &|_, [x, y]| {
            q.twice_area() > 0 || i64::from(y) != last || picture.has([x + 1, y])
        })
    }),
    ("columns are written modulo 8", |q, right| {
        let (before, mut after) = (right(q, 0), empty(q));
        for at in before.pixels().filter(|at| before.has(*at)) {
            let to = [at[0] % 8, at[1]];
            after.set(to, (after.hits(to) + 1).min(2));
        }
        after
    }),
];

const LINES: [(&str, Draw); 11] = [
    ("the last pixel", |q, right| keep(q, right, &|_, at| at.map(i64::from) != q.points[1])),
    ("the last pixel of diagonals", |q, right| {
        let [dx, dy] = q.side_of(0, 1);
        keep(q, right, &|_, at| dx.abs() != dy.abs() || at.map(i64::from) != q.points[1])
    }),
    ("ties of lines to the left", |q, right| right(q, if q.side_of(0, 1)[0] < 0 { 3 } else { 0 })),
    ("lines to the left are one pixel lower", |q, right| {
        let by = i64::from(q.side_of(0, 1)[0] < 0);
        moved(q, right, &|axis, v| if axis == 1 { v + by } else { v })
    }),
    ("ends are limited to 500 px", |q, right| moved(q, right, &|_, v| v.clamp(-500, 500))),
    ("the shorter side is a word of 5 bits", |q, right| {
        let side = q.side_of(0, 1);
        let axis = usize::from(side[0].abs() >= side[1].abs());
        let mut other = q.clone();
        other.points[1][axis] = q.points[0][axis] + side[axis].signum() * (side[axis].abs() & 31);
        right(&other, 0)
    }),
    ("the error begins with half of the shorter side", |q, _| {
        let (mut picture, side) = (Picture::new(q.side), q.side_of(0, 1));
        let longer = usize::from(side[1].abs() > side[0].abs());
        let (du, dv) = (side[longer].abs(), side[1 - longer].abs());
        let (mut at, mut error) = (q.points[0], dv / 2);
        for _ in 0..=du {
            picture.set(at.map(|v| v.clamp(-100, 10_000) as i32), 1);
            error -= dv;
            if error < 0 {
                at[1 - longer] += side[1 - longer].signum();
                error += du;
            }
            at[longer] += side[longer].signum();
        }
        picture
    }),
    ("Cohen and Sutherland in whole numbers", |q, right| {
        let mut other = q.clone();
        let most = q.side.map(|side| i64::from(side) - 1);
        let code = |p: [i64; 2]| [p[0] < 0, p[0] > most[0], p[1] < 0, p[1] > most[1]];
        loop {
            let [a, b] = [other.points[0], other.points[1]];
            let codes = [code(a), code(b)];
            if (0..4).any(|i| codes[0][i] && codes[1][i]) {
                return empty(q);
            }
            let Some(end) = (0..2).find(|end| codes[*end].contains(&true)) else { break };
            // The lower border first, then the upper, the right and the left one.
            let Some(border) = [3, 2, 1, 0].into_iter().find(|i| codes[end][*i]) else { break };
            let (axis, limit) = (border / 2, if border % 2 == 1 { most[border / 2] } else { 0 });
            let way = (b[1 - axis] - a[1 - axis]) * (limit - a[axis]) / (b[axis] - a[axis]);
            other.points[end][axis] = limit;
            other.points[end][1 - axis] = a[1 - axis] + way;
        }
        right(&other, 0)
    }),
    ("one pixel for each column, also of steep lines", |q, right| {
        let [dx, dy] = q.side_of(0, 1);
        if dx == 0 {
            return right(q, 0);
        }
        let mut picture = Picture::new(q.side);
        let [from, to] =
            if dx > 0 { [q.points[0], q.points[1]] } else { [q.points[1], q.points[0]] };
        let dy = dy * dx.signum();
        for x in from[0].max(0)..=to[0].min(i64::from(q.side[0]) - 1) {
            // To the nearest; of two as near, the line goes on.
            let twice = 2 * (x - from[0]) * dy.abs() + dx.abs();
            let y = from[1] + dy.signum() * twice.div_euclid(2 * dx.abs());
            if (0..i64::from(q.side[1])).contains(&y) {
                picture.set([x as i32, y as i32], 1);
            }
        }
        picture
    }),
    ("the two pixels in the middle", |q, right| {
        let side = q.side_of(0, 1).map(i64::abs);
        let axis = usize::from(side[1] > side[0]);
        keep(q, right, &|_, at| {
            let [from, to] = [0, 1].map(|end| (i64::from(at[axis]) - q.points[end][axis]).abs());
            (from - to).abs() != 1
        })
    }),
    ("lines that leave the window are not drawn", |q, right| {
        let is_in = |end: &[i64; 2]| (0..2).all(|i| (0..i64::from(q.side[i])).contains(&end[i]));
        if q.points.iter().all(is_in) { right(q, 0) } else { empty(q) }
    }),
];

/// Two mistakes at once.
const PAIRS: [(&str, Draw); 5] = [
    ("the first row, then the last pixel of each row", |q, right| {
        keep(q, right, &|runs, [x, y]| {
            y != runs.of_rows.first && runs.row(y).is_some_and(|run| x != run.last)
        })
    }),
    ("the last row and the last pixel of each row", |q, right| {
        keep(q, right, &|runs, [x, y]| {
            y != runs.of_rows.last && runs.row(y).is_some_and(|run| x != run.last)
        })
    }),
    ("clamped to the window, then the last row", |q, right| {
        let mut inside = q.clone();
        for point in &mut inside.points {
            *point = [0, 1].map(|axis| point[axis].clamp(0, i64::from(q.side[axis]) * 256));
        }
        keep(&inside, right, &|runs, [_, y]| y != runs.of_rows.last)
    }),
    ("y is mirrored, and x rounded down to 1/2 px", |q, right| {
        let height = i64::from(q.side[1]) * 256;
        moved(q, right, &|axis, v| if axis == 1 { height - v } else { v.div_euclid(128) * 128 })
    }),
    ("clockwise ones are moved, and column 0 is missing", |q, right| {
        let by = if q.twice_area() > 0 { 128 } else { 0 };
        let mut other = q.clone();
        other.points.iter_mut().for_each(|point| point[0] += by);
        keep(&other, right, &|_, [x, _]| x != 0)
    }),
];

/// An edge of a fill row by row, in px: the rows from one number to another, where it is at the first of them, and its slope.
struct Walked {
    rows: [i64; 2],
    start: f64,
    slope: f64,
}

/// Fills between two edges, row by row: a row has the pixels from the one crossing to the other, each rounded.
fn walk(
    q: &AnyQuestion,
    round: fn(f64) -> f64,
    edge: &dyn Fn([f64; 2], [f64; 2]) -> Walked,
) -> Picture {
    let corners: Vec<[f64; 2]> =
        q.points.iter().map(|point| point.map(|v| v as f64 / 256.0)).collect();
    let mut edges = Vec::new();
    for [a, b] in [[0, 1], [1, 2], [2, 0]] {
        let (a, b): ([f64; 2], [f64; 2]) = (corners[a], corners[b]);
        edges.push(if a[1] > b[1] { edge(b, a) } else { edge(a, b) });
    }
    let mut picture = Picture::new(q.side);
    for y in 0..i64::from(q.side[1]) {
        let crossed = edges.iter().filter(|e| (e.rows[0]..e.rows[1]).contains(&y));
        let mut ends: Vec<f64> =
            crossed.map(|e| e.start + (y - e.rows[0]) as f64 * e.slope).collect();
        ends.sort_by(f64::total_cmp);
        let [first, end] = ends[..] else { continue };
        let [first, end] = [first, end].map(|v| round(v).clamp(0.0, f64::from(q.side[0])) as i32);
        (first..end).for_each(|x| picture.set([x, y as i32], 1));
    }
    picture
}

/// Fills row by row whose arithmetic is that of some library.
const WALKS: [(&str, Draw); 5] = [
    ("the third edge, where it goes up, with its ends' x exchanged", |q, _| {
        let corner = |i: usize| q.points[i].map(|v| v as f64 / 256.0);
        let (third, first) = (corner(2), corner(0));
        walk(q, |v| (v - 0.5).ceil(), &|a, b| {
            let rows = [a[1], b[1]].map(|y| (y - 0.5).ceil() as i64);
            let is_exchanged = b == third && a == first;
            let [from, to] = if is_exchanged { [b[0], a[0]] } else { [a[0], b[0]] };
            let slope = (to - from) / (b[1] - a[1]);
            Walked { rows, start: from + (rows[0] as f64 + 0.5 - a[1]) * slope, slope }
        })
    }),
    ("slopes of 8 bits of fraction, from the first row on", |q, _| {
        walk(q, f64::round, &|a, b| {
            let rows = [a[1], b[1]].map(|y| (y - 0.5).ceil() as i64);
            let slope = ((b[0] - a[0]) / (b[1] - a[1]) * 256.0).floor() / 256.0;
            Walked { rows, start: a[0], slope }
        })
    }),
    ("ends rounded to whole px, the slope as it was", |q, _| {
        walk(q, f64::round, &|a, b| Walked {
            rows: [a[1], b[1]].map(|y| y.round() as i64),
            start: a[0].round(),
            slope: (b[0] - a[0]) / (b[1] - a[1]),
        })
    }),
    ("heights rounded to whole px, x and the slope as they were", |q, _| {
        walk(q, f64::round, &|a, b| Walked {
            rows: [a[1], b[1]].map(|y| y.round() as i64),
            start: a[0],
            slope: (b[0] - a[0]) / (b[1] - a[1]),
        })
    }),
    ("heights rounded to whole px, and the slope between these", |q, _| {
        walk(q, f64::round, &|a, b| {
            let rows = [a[1], b[1]].map(|y| y.round() as i64);
            Walked { rows, start: a[0], slope: (b[0] - a[0]) / (rows[1] - rows[0]) as f64 }
        })
    }),
];

/// A fill in the box of the corners: of each edge, `is_inside` gets its number, its edge function, positive inside, and whether
/// samples on it belong to the triangle.
fn by_edges(
    q: &AnyQuestion,
    product: &dyn Fn(i64, i64) -> i64,
    is_inside: &dyn Fn(usize, i64, bool) -> bool,
) -> Picture {
    let turn = q.twice_area().signum();
    let mut picture = Picture::new(q.side);
    let box_of = [0, 1].map(|axis| q.range(axis).map(|v| v.div_euclid(256)));
    for at in picture.pixels().filter(|_| turn != 0) {
        let is_in_box = (0..2).all(|i| (box_of[i][0]..=box_of[i][1]).contains(&i64::from(at[i])));
        let [px, py] = at.map(|v| i64::from(v) * 256 + 128);
        let holds = (0..3).all(|i| {
            let ([ax, ay], [dx, dy]) = (q.points[i], q.side_of(i, (i + 1) % 3));
            let value = turn * (product(dx, py - ay) - product(dy, px - ax));
            is_inside(i, value, turn * dy < 0 || dy == 0 && turn * dx > 0)
        });
        picture.set(at, u8::from(is_in_box && holds));
    }
    picture
}

/// Fills by edge functions, whose arithmetic is that of some library.
const BY_EDGES: [(&str, Draw); 4] = [
    ("products of 32 bits, where coordinates have 8 bits of fraction", |q, _| {
        by_edges(q, &|a, b| i64::from((a * b) as i32), &|_, e, owns| e > 0 || e == 0 && owns)
    }),
    ("samples must lie 1/64 px² inside", |q, _| by_edges(q, &|a, b| a * b, &|_, e, _| e >= 1024)),
    ("the third edge is not looked at", |q, _| {
        by_edges(q, &|a, b| a * b, &|i, e, owns| i == 2 || e > 0 || e == 0 && owns)
    }),
    ("weights in floats of 32 bits, the third of which is the rest", |q, _| {
        let px = |p: [i64; 2]| p.map(|v| v as f32 / 256.0);
        let corners: Vec<[f32; 2]> = q.points.iter().map(|p| px(*p)).collect();
        let cross = |a: [f32; 2], b: [f32; 2], p: [f32; 2]| {
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        };
        let area = cross(corners[0], corners[1], corners[2]);
        let mut picture = Picture::new(q.side);
        for at in picture.pixels().filter(|_| q.twice_area() != 0) {
            let p = at.map(|v| v as f32 + 0.5);
            let [u, v] = [1, 2].map(|i| cross(corners[i], corners[(i + 1) % 3], p) / area);
            picture.set(at, u8::from(u >= 0.0 && v >= 0.0 && 1.0 - u - v >= 0.0));
        }
        picture
    }),
];

/// A row of pixels between two of the edges of a triangle, both prolonged, in floats.
fn between(q: &AnyQuestion, edges: [[usize; 2]; 2], y: i32) -> [i32; 2] {
    let mut ends = edges.map(|edge| {
        let [a, b] = edge.map(|i| q.points[i].map(|v| v as f64 / 256.0));
        let x = a[0] + (f64::from(y) + 0.5 - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
        (x - 0.5).ceil().clamp(0.0, f64::from(q.side[0])) as i32
    });
    ends.sort_unstable();
    ends
}

/// A row of a triangle: the crossings of its edges, where `counts` says that an edge counts between its heights, in pixels.
fn crossings(q: &AnyQuestion, y: i32, counts: &dyn Fn([f64; 2], f64) -> bool) -> Vec<i32> {
    let center = f64::from(y) + 0.5;
    let mut all = Vec::new();
    for [a, b] in [[0, 1], [1, 2], [2, 0]] {
        let [a, b] = [a, b].map(|i| q.points[i].map(|v| v as f64 / 256.0));
        if a[1] != b[1] && counts([a[1].min(b[1]), a[1].max(b[1])], center) {
            let x = a[0] + (center - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
            all.push((x - 0.5).ceil().clamp(0.0, f64::from(q.side[0])) as i32);
        }
    }
    all.sort_unstable();
    all
}

/// Fills by all edges that cross a row.
const BY_CROSSINGS: [(&str, Draw); 2] = [
    ("an edge counts at both of its ends, and rows are filled in pairs", |q, _| {
        let mut picture = empty(q);
        for y in 0..q.side[1] {
            let all = crossings(q, y, &|[upper, lower], y| upper <= y && y <= lower);
            for pair in all.chunks_exact(2) {
                (pair[0]..pair[1]).for_each(|x| picture.set([x, y], 1));
            }
        }
        picture
    }),
    ("rows that an edge touches, from the least to the greatest crossing", |q, _| {
        let mut picture = empty(q);
        for y in 0..q.side[1] {
            let is_touched = |[upper, lower]: [f64; 2], y: f64| {
                upper.floor() <= y.floor() && y.floor() <= lower.floor()
            };
            let all = crossings(q, y, &is_touched);
            if let [first, .., end] = all[..] {
                (first..end).for_each(|x| picture.set([x, y], 1));
            }
        }
        picture
    }),
];

/// Fills whose rows come from all edges are explained to the pixel.
#[test]
fn crossings_are_explained() {
    let learned = BY_CROSSINGS.map(|(name, draw)| (name, learn_triangles(&draw)));
    assert_eq!(not_certain(learned), NO_NAMES);
}

/// A line from its left or upper end, by so many steps: `place` gets the number of a step and the longer and the shorter side,
/// and gives the ways along both.
fn by_places(
    q: &AnyQuestion,
    steps: &dyn Fn([i64; 2]) -> i64,
    place: &dyn Fn(i64, [i64; 2]) -> [i64; 2],
) -> Picture {
    let side = q.side_of(0, 1);
    let longer = usize::from(side[1].abs() > side[0].abs());
    let order = if side[longer] < 0 { [1, 0] } else { [0, 1] };
    let [from, to] = order.map(|i| q.points[i]);
    let aside = (to[1 - longer] - from[1 - longer]).signum();
    let size = [side[longer].abs(), side[1 - longer].abs()];
    let mut picture = empty(q);
    for step in 0..=steps(size) {
        let ways = place(step, size);
        let mut at = [0; 2];
        at[longer] = from[longer] + ways[0];
        at[1 - longer] = from[1 - longer] + aside * ways[1];
        picture.set(at.map(|v| v.clamp(-100, 10_000) as i32), 1);
    }
    picture
}

/// Lines of which each pixel has its own place.
const BY_PLACES: [(&str, Draw); 3] = [
    ("each 16 steps are a line between rounded points", |q, _| {
        by_places(q, &|[n, _]| n, &|step, [n, d]| {
            let joint = |k: i64| if n == 0 { 0 } else { (2 * k * d + n) / (2 * n) };
            let first = step / 16 * 16;
            let last = (first + 16).min(n);
            let rise = joint(last) - joint(first);
            let aside = (2 * (step - first) * rise + last - first) / (2 * (last - first).max(1));
            [step, joint(first) + aside]
        })
    }),
    ("as many steps as it is long", |q, _| {
        let steps = |[n, d]: [i64; 2]| ((n * n + d * d) as f64).sqrt().ceil() as i64;
        by_places(q, &steps, &|step, size| {
            let steps = steps(size);
            size.map(|v| (2 * step * v + steps) / (2 * steps).max(1))
        })
    }),
    ("the memory is checked, and not the column", |q, right| {
        let mut wide = q.clone();
        wide.side = [0, 1].map(|axis| q.range(axis)[1].max(q.side[axis].into()) as i32 + 1);
        let least = [0, 1].map(|axis| q.range(axis)[0].min(0));
        wide.points.iter_mut().for_each(|p| *p = [p[0] - least[0], p[1] - least[1]]);
        wide.side = [0, 1].map(|axis| wide.side[axis] - least[axis] as i32);
        let [width, height] = q.side;
        let mut picture = empty(q);
        if wide.side[0].max(wide.side[1]) > 2048 {
            // Far lines as they are.
            return right(q, 0);
        }
        let drawn = right(&wide, 0);
        for [x, y] in drawn.pixels().filter(|at| drawn.has(*at)) {
            let place = (y + least[1] as i32) * width + x + least[0] as i32;
            if (0..width * height).contains(&place) {
                picture.set([place % width, place / width], 1);
            }
        }
        picture
    }),
];

/// Lines by places are explained to the pixel.
#[test]
fn places_are_explained() {
    let learned = BY_PLACES.map(|(name, draw)| (name, learn_lines(&draw)));
    assert_eq!(not_certain(learned), NO_NAMES);
}

/// Right tests of pixels that are come to in another way.
const ON_THE_WAY: [(&str, Draw); 7] = [
    ("rows of odd windows are kept one pixel short", |q, right| {
        let before = right(q, 0);
        let [width, height] = q.side;
        let mut memory = vec![0; (width * height) as usize];
        let place = |[x, y]: [i32; 2]| (y * (width - width % 2) + x) as usize;
        before.pixels().filter(|at| before.has(*at)).for_each(|at| memory[place(at)] = 1);
        let mut after = empty(q);
        after.pixels().for_each(|at| after.set(at, memory[place(at)]));
        after
    }),
    ("there and back, each row from where the one before ended", |q, right| {
        let (before, mut after) = (right(q, 0), empty(q));
        let [columns, rows] = [0, 1].map(|axis| {
            let [least, most] = q.range(axis).map(|v| v.div_euclid(256));
            least.max(0)..=most.min(i64::from(q.side[axis]) - 1)
        });
        let (mut x, mut step) = (*columns.start(), 1);
        for y in rows {
            let mut is_seen = false;
            loop {
                let at = [x, y].map(|v| v as i32);
                if before.has(at) {
                    after.set(at, 1);
                    is_seen = true;
                } else if is_seen {
                    break;
                }
                if !columns.contains(&(x + step)) {
                    break;
                }
                x += step;
            }
            step = -step;
        }
        after
    }),
    ("all ends with the first row without pixels", |q, right| {
        let (before, mut after) = (right(q, 0), empty(q));
        let mut is_seen = false;
        for y in 0..q.side[1] {
            let row: Vec<i32> = (0..q.side[0]).filter(|x| before.has([*x, y])).collect();
            if is_seen && row.is_empty() {
                break;
            }
            is_seen |= !row.is_empty();
            row.iter().for_each(|x| after.set([*x, y], 1));
        }
        after
    }),
    ("squares of 4 px of which no corner pixel is inside", |q, right| {
        let before = right(q, 0);
        keep(q, right, &|_, at| {
            let [x, y] = at.map(|v| v / 4 * 4);
            [[x, y], [x + 3, y], [x, y + 3], [x + 3, y + 3]].iter().any(|at| before.has(*at))
        })
    }),
    ("rows above the window are drawn in its first row", |q, right| {
        let mut picture = right(q, 0);
        let above = q.range(1)[0].div_euclid(256).min(0);
        for y in above..0 {
            let mut moved = q.clone();
            moved.points.iter_mut().for_each(|point| point[1] -= 256 * y);
            let row = right(&moved, 0);
            (0..q.side[0]).filter(|x| row.has([*x, 0])).for_each(|x| picture.set([x, 0], 1));
        }
        picture
    }),
    ("the first row below the middle corner is drawn with the upper edges, too", |q, right| {
        let mut picture = right(q, 0);
        let [top, middle, bottom] = q.by_height();
        let y = -(128 - q.points[middle][1]).div_euclid(256);
        let is_row = (0..i64::from(q.side[1])).contains(&y);
        // Edges that cross before the row leave nothing to fill between them.
        let is_left = q.side_of(top, bottom)[0] * q.side_of(top, middle)[1]
            > q.side_of(top, bottom)[1] * q.side_of(top, middle)[0];
        if is_row && q.points[top][1] < q.points[middle][1] {
            let edges = [[top, middle], [top, bottom]];
            let edges = if is_left { edges } else { [edges[1], edges[0]] };
            let [first, end] = between(q, edges, y as i32);
            (first..end).for_each(|x| picture.set([x, y as i32], picture.hits([x, y as i32]) + 1));
        }
        picture
    }),
    ("slopes by a reciprocal of 10 bits of fraction", |q, _| {
        walk(q, |v| (v - 0.5).ceil(), &|a, b| {
            let rows = [a[1], b[1]].map(|y| (y - 0.5).ceil() as i64);
            let slope = (b[0] - a[0]) * ((1024.0 / (b[1] - a[1])).floor() / 1024.0);
            Walked { rows, start: a[0] + (rows[0] as f64 + 0.5 - a[1]) * slope, slope }
        })
    }),
];

/// Other ways over a triangle are explained to the pixel.
#[test]
fn ways_are_explained() {
    let learned = ON_THE_WAY.map(|(name, draw)| (name, learn_triangles(&draw)));
    assert_eq!(not_certain(learned), NO_NAMES);
}

/// Fills by edge functions are explained to the pixel.
#[test]
fn edge_tests_are_explained() {
    let learned = BY_EDGES.map(|(name, draw)| (name, learn_triangles(&draw)));
    assert_eq!(not_certain(learned), NO_NAMES);
}

const NO_NAMES: [&str; 0] = [];

/// Fills row by row are explained to the pixel.
#[test]
fn walks_are_explained() {
    let learned = WALKS.map(|(name, draw)| (name, learn_triangles(&draw)));
    assert_eq!(
        not_certain(learned),
        ["the third edge, where it goes up, with its ends' x exchanged"]
    );
}

/// The names of those programs whose explanation is not certain.
fn not_certain<'a>(learned: impl IntoIterator<Item = (&'a str, Option<Learned>)>) -> Vec<&'a str> {
    let mut names = Vec::new();
    for (name, learned) in learned {
        if !learned.is_some_and(|learned| learned.is_certain) {
            names.push(name);
        }
    }
    names
}

/// Not explained to the pixel.
const NOT_YET: [&str; 1] = ["1024 px wide or 512 px high ones are dropped"];

/// Programs of one mistake, and of two, are explained to the pixel.
#[test]
fn programs_are_explained() {
    let triangles = TRIANGLES.into_iter().chain(PAIRS);
    let learned = triangles.map(|(name, draw)| (name, learn_triangles(&draw)));
    let of_lines = LINES.into_iter().map(|(name, draw)| (name, learn_lines(&draw)));
    assert_eq!(not_certain(learned.chain(of_lines)), NOT_YET);
}

/// A right program is asked, and nothing is learned.
#[test]
fn a_right_program_has_nothing_to_learn() {
    assert_eq!(learn_triangles(&|q, right| right(q, 0)), None);
    assert_eq!(learn_lines(&|q, right| right(q, 0)), None);
}

/// What is said to differ in one number does so, and the order of two corners is one thing.
#[test]
fn one_change_is_one_change() {
    let q = AnyQuestion { points: vec![[8, 16], [1024, 0], [0, 2048]], side: [4, 1] };
    let changes = one_changes(&q, 1);
    assert!(changes.len() > 80);
    for change in changes {
        let other = &change.question;
        let is_moved = |(a, b): &(&i64, &i64)| a != b;
        let points = q.points.as_flattened().iter().zip(other.points.as_flattened());
        let moved = points.filter(is_moved).count();
        let sides = q.side.iter().zip(&other.side).filter(|(a, b)| a != b).count();
        let is_exchanged = other.points == [q.points[1], q.points[0], q.points[2]];
        assert!(moved + sides == 1 || is_exchanged, "{}: {}", change.says, other.request());
        assert!(other.side.iter().all(|side| *side > 0), "{}", change.says);
    }
}

/// Where no model predicts every answer, a right question is found beside a wrong one, and what is common to wrong answers
/// is said.
#[test]
fn what_is_known_of_noise_is_said() {
    let noisy: Draw = |q, right| {
        // Nothing that is asked of explains which pixels are missing.
        let mark = q.points.as_flattened().iter().fold(7, |n: i64, v| n.wrapping_mul(31) + v);
        keep(q, right, &|_, [x, y]| q.side[0] < 8 || (mark ^ i64::from(x * 5 + y * 3)) % 7 != 0)
    };
    let learned = learn_triangles(&noisy).unwrap();
    assert!(!learned.is_certain);
    let said = learned.known.join(" ");
    assert!(said.contains("right ones: the width of the window is 8 px or more"), "{said}");
    assert!(said.contains("it comes out right."), "{said}");
}
