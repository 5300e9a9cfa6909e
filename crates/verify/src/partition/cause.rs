//! Why a tessellator is wrong: what else it fills, or what it does with the vertices, and a picture of it.
//!
//! A cause is a function that says for a polygon how often each point is covered, or what becomes of its vertices. It is
//! named if it predicts at least 99 % of the wrong polygons and of the right ones, as a mistake of a rasterizer is.

use std::cmp::Ordering;
use std::fmt::Write as _;

use super::exact::orientation;
use super::region::region;
use super::{FaultKind, Faults, FillRule, Options, Point, Polygon, Triangle, key};
use crate::mistakes::{Explanation, Hypothesis, Mistakes, of_answers};

/// What a tessellator made of a polygon.
pub(super) struct Made {
    pub polygon: Polygon,
    pub triangles: Vec<Triangle>,
    pub finding: Faults,
}

/// Samples along each side of the box of a polygon.
const SAMPLES: usize = 12;
/// Columns and rows of a picture.
const PICTURE: [usize; 2] = [32, 12];

fn on_edge([a, b]: [Point; 2], p: Point) -> bool {
    let between = |axis: usize| {
        let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
        (low..=high).contains(&p[axis])
    };
    between(0) && between(1) && orientation(a, b, p) == Ordering::Equal
}

fn edges(contour: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    contour.iter().enumerate().map(|(i, a)| [*a, contour[(i + 1) % contour.len()]])
}

/// How often contours run around a point; nothing on an edge.
fn rounds(contours: &[Vec<Point>], p: Point) -> Option<i64> {
    let mut rounds = 0;
    for [a, b] in contours.iter().flat_map(|contour| edges(contour)) {
        if on_edge([a, b], p) {
            return None;
        }
        match (a[1] <= p[1], b[1] <= p[1]) {
            (true, false) if orientation(a, b, p).is_gt() => rounds += 1,
            (false, true) if orientation(a, b, p).is_lt() => rounds -= 1,
            _ => {}
        }
    }
    Some(rounds)
}

/// How many triangles cover a point; nothing on an edge of one.
fn covering(triangles: &[Triangle], p: Point) -> Option<i64> {
    let mut covering = 0;
    for triangle in triangles {
        let sides = [0, 1, 2].map(|i| orientation(triangle[i], triangle[(i + 1) % 3], p));
        if sides == [Ordering::Greater; 3] || sides == [Ordering::Less; 3] {
            covering += 1;
        } else if edges(triangle).any(|edge| on_edge(edge, p)) {
            return None;
        }
    }
    Some(covering)
}

/// Points between the vertices: on a grid that no coordinate of a polygon lies on by intent.
fn samples(polygon: &Polygon, columns: usize, rows: usize) -> Vec<Point> {
    let points = || polygon.contours.iter().flatten();
    let range = |axis: usize| {
        let values = || points().map(|point| point[axis]);
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    };
    let (xs, ys) = (range(0), range(1));
    let at = |[low, high]: [f64; 2], i: usize, of: usize| {
        low + (high - low) * ((i as f64 + 0.496_094) / of as f64)
    };
    let row =
        |j: usize| (0..columns).map(move |i| [at(xs, i, columns), at(ys, rows - 1 - j, rows)]);
    let all = (0..rows).flat_map(row);
    all.filter(|point| point.iter().all(|v| v.is_finite())).collect()
}

/// How often a point is covered; nothing on an edge.
type Covers<'a> = Box<dyn Fn(Point) -> Option<i64> + 'a>;

/// What else might be filled of a polygon.
type Fills = for<'a> fn(&'a Polygon, FillRule) -> Covers<'a>;

const FILLS: [(&str, &str, &str, Fills); 6] = [
    (
        "contours alone",
        "fills every contour by itself, so that holes are filled, and what lies in them twice",
        "cut the holes out: connect each with its outline, or use their edges as constraints",
        |polygon, rule| {
            Box::new(move |p| polygon.contours.chunks(1).map(|alone| filled(alone, rule, p)).sum())
        },
    ),
    (
        "the first contour",
        "fills the first contour and ignores the others",
        "fill all contours, by the fill rule",
        |polygon, rule| Box::new(move |p| filled(polygon.contours.get(..1)?, rule, p)),
    ),
    (
        "the other fill rule",
        "follows the other fill rule: even-odd in place of non-zero, or the other way",
        "ask for the rule that is meant, or declare the other one by Options::fill_rule",
        |polygon, rule| {
            let other = match rule {
                FillRule::EvenOdd => FillRule::NonZero,
                FillRule::NonZero => FillRule::EvenOdd,
            };
            Box::new(move |p| filled(&polygon.contours, other, p))
        },
    ),
    (
        "a fan",
        "draws a fan around the first vertex of each contour, which is right where the contour is convex",
        "cut ears, or split into monotone pieces",
        |polygon, _| {
            let fan = |c: &Vec<Point>| c.windows(2).skip(1).map(|v| [c[0], v[0], v[1]]).collect();
            made_of(polygon, fan)
        },
    ),
    (
        "a strip",
        "joins each vertex with the next two, as a strip of triangles",
        "cut ears, or split into monotone pieces",
        |polygon, _| made_of(polygon, |c| c.windows(3).map(|v| [v[0], v[1], v[2]]).collect()),
    ),
    (
        "the convex hull",
        "fills the convex hull of the vertices",
        "use the edges of the contours as constraints, and leave out triangles that lie outside",
        |polygon, _| {
            let hull = [hull(polygon.contours.iter().flatten().copied().collect())];
            Box::new(move |p| filled(&hull, FillRule::NonZero, p))
        },
    ),
];

/// Whether a point lies within contours by a rule, as a number.
fn filled(contours: &[Vec<Point>], rule: FillRule, p: Point) -> Option<i64> {
    Some(i64::from(rule.fills(rounds(contours, p)?)))
}

/// The triangles that are made of each contour.
fn made_of<'a>(polygon: &Polygon, make: fn(&Vec<Point>) -> Vec<Triangle>) -> Covers<'a> {
    let triangles: Vec<Triangle> = polygon.contours.iter().flat_map(make).collect();
    Box::new(move |p| covering(&triangles, p))
}

/// The convex hull, counterclockwise.
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_unstable_by(super::order);
    points.dedup();
    let mut hull: Vec<Point> = Vec::new();
    for is_back in [false, true] {
        let start = hull.len();
        let mut add = |point: &Point| {
            while hull.len() >= start + 2
                && !orientation(hull[hull.len() - 2], hull[hull.len() - 1], *point).is_gt()
            {
                hull.pop();
            }
            hull.push(*point);
        };
        if is_back {
            points.iter().rev().for_each(&mut add)
        } else {
            points.iter().for_each(&mut add)
        }
        hull.pop();
    }
    hull
}

/// Polygons for which a tessellator might make nothing.
type IsKind = fn(&Polygon) -> bool;
const NOTHING: [(&str, IsKind); 2] = [
    ("of more than one contour", |polygon| polygon.contours.len() > 1),
    ("in which a vertex occurs twice", |polygon| {
        let mut points: Vec<Point> = polygon.contours.iter().flatten().copied().map(key).collect();
        points.sort_unstable_by(super::order);
        points.windows(2).any(|two| two[0] == two[1])
    }),
];

/// Ways to round a coordinate.
type Round = fn(f64) -> f64;
const ROUNDINGS: [(&str, Round); 5] = [
    ("f32", |v| f64::from(v as f32)),
    ("whole numbers, to the nearest", f64::round),
    ("whole numbers, cut down", f64::floor),
    ("whole numbers, cut toward zero", f64::trunc),
    ("whole numbers, halves to even", f64::round_ties_even),
];

fn rounded(polygon: &Polygon, round: Round) -> Vec<Point> {
    let mut points: Vec<_> =
        polygon.contours.iter().flatten().map(|point| key(point.map(round))).collect();
    points.sort_unstable_by(super::order);
    points
}

/// Whether some vertex lies on the straight edge between its neighbours.
fn has_straight_vertex(polygon: &Polygon) -> bool {
    polygon.contours.iter().any(|contour| {
        let n = contour.len();
        (0..n).any(|i| on_edge([contour[(i + n - 1) % n], contour[(i + 1) % n]], contour[i]))
    })
}

fn says(name: &'static str, does: String, repair: &'static str) -> Explanation {
    let refuted = "a polygon that comes out otherwise";
    Explanation::new(name, does, repair, "judge", refuted)
}

/// What explains the polygons that came out wrong; nothing where none did.
pub(super) fn cause(made: &[Made], options: &Options) -> Option<Mistakes> {
    let is_wrong: Vec<bool> = made.iter().map(|made| !made.finding.faults.is_empty()).collect();
    // Of each polygon, how often samples are covered, and how often they should be.
    let rule = options.terms.fill_rule;
    let seen: Vec<Vec<(Point, i64, bool)>> = made
        .iter()
        .map(|Made { polygon, triangles, .. }| {
            let samples = samples(polygon, SAMPLES, SAMPLES).into_iter();
            let seen = samples.filter_map(|p| {
                let right = rule.fills(rounds(&polygon.contours, p)?);
                Some((p, covering(triangles, p)?, right))
            });
            seen.collect()
        })
        .collect();
    let is_grossly = |i: usize| seen[i].iter().any(|(_, drawn, right)| *drawn != i64::from(*right));
    // What is wrong in the large and what is right says what is filled; thin gaps and overlaps say nothing of it.
    let gross: Vec<usize> = (0..made.len()).filter(|&i| !is_wrong[i] || is_grossly(i)).collect();
    let mut hypotheses = Vec::new();
    for (name, does, repair, fills) in FILLS {
        let (seen, gross) = (&seen, &gross);
        let predicts = move |i: usize| {
            let covers = fills(&made[gross[i]].polygon, rule);
            let is_as_drawn = |&(p, drawn, _): &(Point, i64, bool)| {
                covers(p).is_none_or(|expected| expected == drawn)
            };
            seen[gross[i]].iter().all(is_as_drawn)
        };
        let says = says(name, does.to_owned(), repair);
        hypotheses.push(Hypothesis { predicts: Box::new(predicts), says });
    }
    for (which, is_lost) in NOTHING {
        let (gross, is_wrong) = (&gross, &is_wrong);
        let predicts = move |i: usize| {
            let Made { polygon, triangles, .. } = &made[gross[i]];
            if is_lost(polygon) { triangles.is_empty() } else { !is_wrong[gross[i]] }
        };
        let does = format!("makes no triangles of polygons {which}");
        let says = says("nothing", does, "treat these as any other polygon");
        hypotheses.push(Hypothesis { predicts: Box::new(predicts), says });
    }
    let wrong_of_gross: Vec<bool> = gross.iter().map(|&i| is_wrong[i]).collect();
    let of_fills = of_answers(hypotheses, &wrong_of_gross).filter(Mistakes::is_known);
    of_fills.or_else(|| of_answers(of_vertices(made, &is_wrong), &is_wrong))
}

/// What may become of vertices and of the winding, where the right points are covered.
fn of_vertices<'a>(made: &'a [Made], is_wrong: &'a [bool]) -> Vec<Hypothesis<'a>> {
    let mut hypotheses = Vec::new();
    for (grid, round) in ROUNDINGS {
        let predicts = move |i: usize| {
            let Made { polygon, triangles, .. } = &made[i];
            let points = rounded(polygon, round);
            let moves = polygon.contours.iter().flatten().any(|p| key(p.map(round)) != key(*p));
            let is_one = |p: &Point| points.binary_search_by(|q| super::order(q, &key(*p))).is_ok();
            triangles.iter().flatten().all(is_one) && (moves || !is_wrong[i])
        };
        let does =
            format!("rounds coordinates to {grid}, so that edges move and vertices coincide");
        let says = says(
            "rounded coordinates",
            does,
            "keep the coordinates as they are given, or declare what is taken by Options::coordinates",
        );
        hypotheses.push(Hypothesis { predicts: Box::new(predicts), says });
    }
    let alone =
        move |kind: FaultKind, i: usize| made[i].finding.faults.iter().all(|f| f.kind == kind);
    let straight = move |i: usize| {
        alone(FaultKind::TJunction, i) && (!is_wrong[i] || has_straight_vertex(&made[i].polygon))
    };
    hypotheses.push(Hypothesis {
        predicts: Box::new(straight),
        says: says(
            "straight vertices",
            "leaves out vertices on straight edges, where the triangles of a neighbour then have a T-junction".to_owned(),
            "keep every vertex of the boundary, or allow it by Options::allow_t_junctions",
        ),
    });
    let turned = move |i: usize| {
        alone(FaultKind::Flipped, i) && (made[i].triangles.is_empty() || is_wrong[i])
    };
    hypotheses.push(Hypothesis {
        predicts: Box::new(turned),
        says: says(
            "the other winding",
            "winds all triangles the other way".to_owned(),
            "exchange two corners of each, or declare the other Winding",
        ),
    });
    for (way, rounds) in [("clockwise", [-1, 0]), ("counterclockwise", [0, 1])] {
        let predicts = move |i: usize| {
            let region = region(&made[i].polygon, FillRule::EvenOdd);
            region.is_ok_and(|region| region.rounds == rounds) == is_wrong[i]
        };
        let does = format!(
            "depends on the direction of the contours: where the first one runs {way} (y up), polygons come out wrong"
        );
        let repair = "turn the contours by the sign of the first one's area before anything else";
        let says = says("the direction of contours", does, repair);
        hypotheses.push(Hypothesis { predicts: Box::new(predicts), says });
    }
    hypotheses
}

/// What is covered beside what should be, a character for each sample; nothing where they do not differ at a sample.
pub(super) fn picture(polygon: &Polygon, triangles: &[Triangle], rule: FillRule) -> Option<String> {
    let [columns, rows] = PICTURE;
    let points = samples(polygon, columns, rows);
    if points.len() < columns * rows {
        return None;
    }
    let mut text = format!("  {:<columns$}   expected\n", "covered");
    let mut differs = false;
    for row in points.chunks(columns) {
        let mut sides = [String::from("  "), String::new()];
        for &p in row {
            let right = rounds(&polygon.contours, p).map(|n| i64::from(rule.fills(n)));
            let drawn = covering(triangles, p);
            let (mark, wanted) = match (drawn, right) {
                (Some(drawn), Some(right)) => {
                    differs |= drawn != right;
                    let mark = match (drawn, right) {
                        (0, 0) => '.',
                        (1, 1) => '#',
                        (0, _) => '-',
                        (1, _) => '+',
                        (n, _) => char::from_digit(n.min(9) as u32, 10).unwrap_or('9'),
                    };
                    (mark, if right == 0 { '.' } else { '#' })
                }
                // The sample lies on an edge.
                _ => ('|', '|'),
            };
            sides[0].push(mark);
            sides[1].push(wanted);
        }
        // Writing to a string does not fail.
        let _ = writeln!(text, "{}   {}", sides[0], sides[1]);
    }
    text += "  # once, - missing, + extra, 2 to 9 so often, . neither, | on an edge\n";
    differs.then_some(text)
}
