//! Why a tessellator is wrong: what else it fills, or what it does with the vertices, and a picture of it.
//!
//! A cause is a function that says for a polygon how often each point is covered, or what becomes of its vertices. It is
//! named if it predicts at least 99 % of the wrong polygons and of the right ones, as a mistake of a rasterizer is.

use std::cmp::Ordering;
use std::fmt::Write as _;

use super::exact::orientation;
use super::region::region;
use super::{
    FaultKind, Faults, FillRule, Options, Point, Polygon, Triangle, all_points, distinct, edges_of,
    ends_of, key,
};
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
    for axis in 0..2 {
        let (low, high) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
        if !(low..=high).contains(&p[axis]) {
            return false;
        }
    }
    orientation(a, b, p) == Ordering::Equal
}

/// How often contours run around a point; nothing on an edge.
fn rounds(contours: &[Vec<Point>], p: Point) -> Option<i64> {
    let mut rounds = 0;
    for [a, b] in contours.iter().flat_map(|contour| edges_of(contour)) {
        if on_edge([a, b], p) {
            return None;
        }
        // An edge that passes the height of the point on its right side goes around it, upwards or
        // downwards.
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
        let [a, b, c] = *triangle;
        // Inside, all three turn the same way.
        let sides = [orientation(a, b, p), orientation(b, c, p), orientation(c, a, p)];
        if sides == [Ordering::Greater; 3] || sides == [Ordering::Less; 3] {
            covering += 1;
        } else if edges_of(triangle).any(|edge| on_edge(edge, p)) {
            return None;
        }
    }
    Some(covering)
}

/// Points between the vertices: on a grid that no coordinate of a polygon lies on by intent.
fn samples(polygon: &Polygon, columns: usize, rows: usize) -> Vec<Point> {
    let points: Vec<Point> = polygon.contours.iter().flatten().copied().collect();
    let (xs, ys) = (ends_of(&points, 0), ends_of(&points, 1));
    let mut samples = Vec::with_capacity(columns * rows);
    // The upper row comes first, as in a picture.
    for row in (0..rows).rev() {
        for column in 0..columns {
            let point = [part_of(xs, column, columns), part_of(ys, row, rows)];
            if point[0].is_finite() && point[1].is_finite() {
                samples.push(point);
            }
        }
    }
    samples
}

/// A place nearly in the middle of one of the equal parts of a range.
fn part_of([low, high]: [f64; 2], part: usize, of: usize) -> f64 {
    low + (high - low) * ((part as f64 + 0.496_094) / of as f64)
}

/// How often a point is covered; nothing on an edge.
type Covers<'a> = Box<dyn Fn(Point) -> Option<i64> + 'a>;

/// What else might be filled of a polygon.
struct OtherFill {
    name: &'static str,
    does: &'static str,
    repair: &'static str,
    covers: for<'a> fn(&'a Polygon, FillRule) -> Covers<'a>,
}

const FILLS: [OtherFill; 6] = [
    OtherFill {
        name: "contours alone",
        does: "fills every contour by itself, so that holes are filled, and what lies in them twice",
        repair: "cut the holes out: connect each with its outline, or use their edges as constraints",
        covers: contours_alone,
    },
    OtherFill {
        name: "the first contour",
        does: "fills the first contour and ignores the others",
        repair: "fill all contours, by the fill rule",
        covers: |polygon, rule| Box::new(move |p| filled(polygon.contours.get(..1)?, rule, p)),
    },
    OtherFill {
        name: "the other fill rule",
        does: "follows the other fill rule: even-odd in place of non-zero, or the other way",
        repair: "ask for the rule that is meant, or declare the other one by Options::fill_rule",
        covers: other_rule,
    },
    OtherFill {
        name: "a fan",
        does: "draws a fan around the first vertex of each contour, which is right where the contour is convex",
        repair: "cut ears, or split into monotone pieces",
        covers: |polygon, _| made_of(polygon, true),
    },
    OtherFill {
        name: "a strip",
        does: "joins each vertex with the next two, as a strip of triangles",
        repair: "cut ears, or split into monotone pieces",
        covers: |polygon, _| made_of(polygon, false),
    },
    OtherFill {
        name: "the convex hull",
        does: "fills the convex hull of the vertices",
        repair: "use the edges of the contours as constraints, and leave out triangles that lie outside",
        covers: whole_hull,
    },
];

/// The sum over all contours: a hole counts once more, and not once less.
fn contours_alone(polygon: &Polygon, rule: FillRule) -> Covers<'_> {
    Box::new(move |p| polygon.contours.chunks(1).map(|alone| filled(alone, rule, p)).sum())
}

fn other_rule(polygon: &Polygon, rule: FillRule) -> Covers<'_> {
    let other = match rule {
        FillRule::EvenOdd => FillRule::NonZero,
        FillRule::NonZero => FillRule::EvenOdd,
    };
    Box::new(move |p| filled(&polygon.contours, other, p))
}

fn whole_hull(polygon: &Polygon, _: FillRule) -> Covers<'_> {
    let hull = [hull(polygon)];
    Box::new(move |p| filled(&hull, FillRule::NonZero, p))
}

/// Whether a point lies within contours by a rule, as a number.
fn filled(contours: &[Vec<Point>], rule: FillRule, p: Point) -> Option<i64> {
    Some(i64::from(rule.fills(rounds(contours, p)?)))
}

/// The triangles of a fan around the first vertex of each contour, or of a strip along it.
fn made_of(polygon: &Polygon, is_fan: bool) -> Covers<'_> {
    let mut triangles = Vec::new();
    for contour in &polygon.contours {
        for i in 2..contour.len() {
            let first = if is_fan { 0 } else { i - 2 };
            triangles.push([contour[first], contour[i - 1], contour[i]]);
        }
    }
    Box::new(move |p| covering(&triangles, p))
}

/// The convex hull, counterclockwise: its lower part from left to right, and the upper part back.
fn hull(polygon: &Polygon) -> Vec<Point> {
    let mut points = distinct(&polygon.contours);
    let mut hull: Vec<Point> = Vec::new();
    for _ in 0..2 {
        let start = hull.len();
        for point in &points {
            // The last vertex lies within where the way over it does not turn left.
            while hull.len() >= start + 2
                && !orientation(hull[hull.len() - 2], hull[hull.len() - 1], *point).is_gt()
            {
                hull.pop();
            }
            hull.push(*point);
        }
        // The next part begins there.
        hull.pop();
        points.reverse();
    }
    hull
}

/// Polygons for which a tessellator might make nothing.
type IsKind = fn(&Polygon) -> bool;
const NOTHING: [(&str, IsKind); 2] = [
    ("of more than one contour", |polygon| polygon.contours.len() > 1),
    ("in which a vertex occurs twice", |polygon| {
        all_points(&polygon.contours).windows(2).any(|two| two[0] == two[1])
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

/// The vertices with rounded coordinates, in order.
fn rounded(polygon: &Polygon, round: Round) -> Vec<Point> {
    let mut contours = polygon.contours.clone();
    for v in contours.as_mut_slice().iter_mut().flatten().flatten() {
        *v = round(*v);
    }
    all_points(&contours)
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
    let rule = options.terms.fill_rule;
    let mut seen = Vec::with_capacity(made.len());
    for one in made {
        seen.push(samples_of(one, rule));
    }
    // What is wrong in the large and what is right says what is filled; thin gaps and overlaps say nothing of it.
    let mut gross = Vec::new();
    for (i, samples) in seen.iter().enumerate() {
        if !is_wrong[i] || samples.iter().any(|sample| sample.drawn != sample.right) {
            gross.push(i);
        }
    }
    let (seen, gross) = (&seen, &gross);
    let mut hypotheses = Vec::new();
    // What else may be filled, by the samples of each polygon.
    for OtherFill { name, does, repair, covers } in FILLS {
        let predicts = move |i: usize| {
            let covers = covers(&made[gross[i]].polygon, rule);
            seen[gross[i]]
                .iter()
                .all(|sample| covers(sample.at).is_none_or(|expected| expected == sample.drawn))
        };
        let says = says(name, does.to_owned(), repair);
        hypotheses.push(Hypothesis { predicts: Box::new(predicts), says });
    }
    for (which, is_lost) in NOTHING {
        let is_wrong = &is_wrong;
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

/// A point of a polygon, how often triangles cover it, and how often they should.
struct Sample {
    /// Between the vertices, on no edge.
    at: Point,
    drawn: i64,
    right: i64,
}

/// Samples that lie on no edge.
fn samples_of(made: &Made, rule: FillRule) -> Vec<Sample> {
    let mut all = Vec::new();
    for at in samples(&made.polygon, SAMPLES, SAMPLES) {
        let rounds = rounds(&made.polygon.contours, at);
        if let (Some(rounds), Some(drawn)) = (rounds, covering(&made.triangles, at)) {
            all.push(Sample { at, drawn, right: i64::from(rule.fills(rounds)) });
        }
    }
    all
}

/// What may become of vertices and of the winding, where the right points are covered.
fn of_vertices<'a>(made: &'a [Made], is_wrong: &'a [bool]) -> Vec<Hypothesis<'a>> {
    let mut hypotheses = Vec::new();
    for (grid, round) in ROUNDINGS {
        // Every corner of a triangle is a rounded vertex, and right where rounding moves nothing.
        let predicts = move |i: usize| {
            let Made { polygon, triangles, .. } = &made[i];
            let points = rounded(polygon, round);
            let moves = points != all_points(&polygon.contours);
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
    // What is covered on the left, and what should be on the right.
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
