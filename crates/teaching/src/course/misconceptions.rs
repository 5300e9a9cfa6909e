//! What a wrong program believes: for each typical misconception, the answers that it leads to.
//!
//! A misconception is named where all answers of a step that it speaks about are the ones that it predicts, and some of
//! them are wrong. Predictions are computed from the request alone: by [`rasterproof_verify::convention`] where a convention is
//! mistaken, and here for the rest. A program with two mistakes at once follows none of them, and nothing is named.

use glam::{DVec2, DVec3, Vec3Swizzles as _};

use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{Corners, Fragment, Span};
use rasterproof_judge::ask::runs_of;
use rasterproof_judge::ask::{Answer, Asked, Question};
use rasterproof_judge::check::{Truth, expected_answer, picture_of};
use rasterproof_judge::near_plane;
use rasterproof_render::pipeline::multisample;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::convention::{
    Convention, End, Ends, LineConvention, LineQuestion, LineRounding, LineTie, Mirror, Quantum,
    Rounding, Shape, Ties, Windings,
};
use rasterproof_verify::oracle::Oracle;

/// What a program was found to believe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Misconception {
    pub name: &'static str,
    /// What the program does, as said to the student.
    pub says: &'static str,
    /// What to think about before the first hint.
    pub ask: &'static str,
}

/// The answer that it leads to; nothing for a request that it does not speak about.
type Predict = fn(&Question, &Truth) -> Option<Answer>;

/// A misconception, and its predictions: any one of them is to explain every answer.
struct Known {
    is: Misconception,
    predict: &'static [Predict],
}

macro_rules! known {
    ($($name:literal, $says:literal, $ask:literal, [$($predict:expr),+ $(,)?];)*) => {
        &[$(Known {
            is: Misconception { name: $name, says: $says, ask: $ask },
            predict: &[$($predict),+],
        }),*]
    };
}

/// Every misconception that is known, the more particular ones first.
const KNOWN: &[Known] = known![
    "lost-end-pixel", "your line ends one pixel early",
    "How many pixels has a line from column 0 to column 5, and how often does your loop run?",
    [|q, _| line(q, LineConvention { ends: Ends::WithoutLast, ..right_line() }),
     |q, _| line(q, LineConvention { ends: Ends::WithoutFirst, ..right_line() }),
     |q, _| line(q, LineConvention { ends: Ends::WithoutRight, ..right_line() })];

    "reversed-line", "your pixels come from the end with the smaller coordinate, whichever end was named first",
    "The request names two ends. Which of your pixels comes first for a line drawn from right to left?",
    [|q, t| sorted_line(q, t)];

    "truncated-line", "you cut the second coordinate instead of rounding it",
    "A line is at height 0.9 in some column. In which row is the nearest pixel, and which one does a cast to int give?",
    [|q, _| line(q, LineConvention { rounding: LineRounding::Down, ..right_line() }),
     |q, _| line(q, LineConvention { rounding: LineRounding::Toward(End::Small), ..right_line() }),
     |q, _| line(q, LineConvention { rounding: LineRounding::Toward(End::First), ..right_line() })];

    "line-ties", "a tie of your lines depends on the direction of drawing, or goes the other way",
    "The line passes exactly between two pixels. Which one do you take on the way there, and which one on the way back?",
    [|q, _| line_tie(q, LineTie::FirstGo), |q, _| line_tie(q, LineTie::FirstStay),
     |q, _| line_tie(q, LineTie::SmallStay), |q, _| line_tie(q, LineTie::Up),
     |q, _| line_tie(q, LineTie::Down), |q, _| line_tie(q, LineTie::Even)];

    "one-axis", "you always walk along x, so steep lines have gaps",
    "A line goes down 10 rows and across 2 columns. How many pixels does one step in x skip?",
    [|q, t| along_x(q, t, false),
     |q, t| along_x(q, t, true)];

    "transposed", "x and y are exchanged in your picture",
    "Which of the two numbers of a pixel comes first in the answer, and which one indexes a row of your array?",
    [|q, t| exchanged_line(q, t),
     |q, _| tied(q, |ties| Convention { mirror: Mirror::Exchanged, ties, ..Convention::default() }, 0)];

    "strict", "you draw no sample that lies exactly on an edge",
    "Two triangles share an edge that passes through a pixel's centre. Which of them draws that pixel, if both do as you do?",
    [|q, _| rule(q, "strict")];

    "inclusive", "you draw every sample that lies exactly on an edge",
    "Two triangles share an edge that passes through a pixel's centre. How often is that pixel drawn, if both do as you do?",
    [|q, _| rule(q, "inclusive")];

    "y-up", "you use the rule of a y axis that points up: bottom and left edges instead of top and left ones",
    "Row 0 is at the top of the window. Which sign has the y step of an edge that runs up on the screen?",
    [|q, _| rule(q, "bottom-left"),
     |q, _| tied(q, |ties| Convention { mirror: Mirror::UpsideDown, ties, ..Convention::default() }, 0),
     |q, _| tied(q, |ties| Convention { mirror: Mirror::UpsideDown, ties, ..Convention::default() }, 1)];

    "right-edges", "you keep samples on right edges and drop those on left ones",
    "Take the square from 0.5 to 3.5. Which three columns should it have, and which three has yours?",
    [|q, _| rule(q, "top-right"), |q, _| rule(q, "bottom-right")];

    "winding", "you draw triangles of one winding alone",
    "Exchange two corners of a triangle: which sign has the area now, and what does your test do with it?",
    [|q, _| tied(q, |ties| Convention { draws: Windings::Clockwise, ties, ..Convention::default() }, 0),
     |q, _| tied(q, |ties| Convention { draws: Windings::Clockwise, ties, ..Convention::default() }, 1),
     |q, _| tied(q, |ties| Convention { draws: Windings::Clockwise, ties, ..Convention::default() }, 2),
     |q, _| tied(q, |ties| Convention { draws: Windings::CounterClockwise, ties, ..Convention::default() }, 0),
     |q, _| tied(q, |ties| Convention { draws: Windings::CounterClockwise, ties, ..Convention::default() }, 1),
     |q, _| tied(q, |ties| Convention { draws: Windings::CounterClockwise, ties, ..Convention::default() }, 2)];

    "corner-samples", "your samples are at the corners of pixels, not at their centres",
    "Where is the centre of the pixel in column 3? A triangle covers 3.2 to 3.9: does it cover that centre, and your sample?",
    [|q, _| sampled(q, 0, 0), |q, _| sampled(q, 0, 1), |q, _| sampled(q, 0, 2)];

    "half-off", "your samples are half a pixel too far: at the lower right corners of pixels",
    "How much do you add to the number of a column to come to the centre of its pixels?",
    [|q, _| sampled(q, SUBPIXELS, 0), |q, _| sampled(q, SUBPIXELS, 1), |q, _| sampled(q, SUBPIXELS, 2)];

    "truncated-corners", "you cut the corners to whole pixels before you draw",
    "What becomes of a triangle whose corners are 0.25, 0.5 and 0.75 px from each other, once they are int?",
    [|q, _| cut(q, Rounding::TowardZero, 0), |q, _| cut(q, Rounding::TowardZero, 1),
     |q, _| cut(q, Rounding::TowardZero, 2), |q, _| cut(q, Rounding::Down, 0),
     |q, _| cut(q, Rounding::Down, 1), |q, _| cut(q, Rounding::Down, 2)];

    "rounded-corners", "you round the corners to whole pixels before you draw",
    "Two corners are 0.3 px apart. Are they still two, once they are whole numbers?",
    [|q, _| cut(q, Rounding::Near, 0), |q, _| cut(q, Rounding::Near, 1), |q, _| cut(q, Rounding::Near, 2)];

    "clamped-weights", "you draw the whole bounding box: weights that are clamped to 0 and 1 are never outside",
    "What does a negative weight say about a sample, and what is left of it after clamping?",
    [|q, _| boxed(q)];

    "no-perspective", "your attributes are linear in the window: they are not divided by w",
    "An edge runs from w = 1 to w = 3. Is its middle in the window nearer to the first or to the second corner in space?",
    [|q, t| attributes(q, t, |l, _| l)];

    "one-division", "you divide the attributes by w and never by the interpolated 1/w",
    "An attribute is 1 at all three corners, which have w = 2. What does your formula give inside?",
    [|q, t| attributes(q, t, |l, w| l / w)];

    "times-w", "you multiply by w where you should divide",
    "Which of two corners should count more in the middle of the window: the near one with w = 1 or the far one with w = 3?",
    [|q, t| attributes(q, t, |l, w| mean(l * w))];

    "transposed-matrix", "the matrix that gives your weights is transposed",
    "A matrix takes a point to its three weights. Are the corners its rows or its columns, and what does it make of corner a?",
    [|q, t| transposed_weights(q, t)];

    "swapped-weights", "for one winding you exchanged two corners and not their values",
    "You exchanged b and c to make the area positive. To which corner does the second weight belong now?",
    [|q, t| swapped_weights(q, t)];

    "corner-values", "your values are those at the upper left corner of each pixel, not at its centre",
    "A value grows by 1 per pixel from 0 at x = 0. What is it at the centre of column 0?",
    [|q, t| corner_values(q, t)];

    "depth-not-divided", "your depths are not divided by the area, so that large triangles seem far",
    "A triangle has z = 0.5 at all corners. What does your sum give before the division by its area?",
    [|q, t| deepest(q, t, |l, z, area| l.dot(z) * area.abs()),
     |q, t| depths(q, t, |l, z, _, area| l.dot(z) * area),
     |q, t| depths(q, t, |l, z, _, area| l.dot(z) * area.abs())];

    "depth-divided-twice", "you divide z by w again: the z of the request has been divided already",
    "z / w is linear in the window. What is linear about z / w / w?",
    [|q, t| depths(q, t, |l, z, w, _| (l * z / w).element_sum())];

    "depth-in-perspective", "you interpolate z in perspective, like an attribute",
    "a is linear in space, z / w is linear in the window. Which of the two kinds is the z of the request?",
    [|q, t| depths(q, t, |l, z, w, _| mean(l / w).dot(z))];

    "last-wins", "the triangle that is drawn last is seen, whatever its depth",
    "Draw the near triangle first and the far one after it. Which one should be seen?",
    [|q, t| pile(q, t, |found, _| found.last().copied())];

    "farthest-wins", "the greatest depth is seen instead of the least",
    "z is 0 at the near plane and 1 at the far one. Which of 0.2 and 0.8 hides the other?",
    [|q, t| pile(q, t, |found, _| found.iter().copied().reduce(|a, b| if b.1 > a.1 { b } else { a }))];

    "mean-depth", "you order whole triangles by their mean depth",
    "Two triangles go through one another. Which of them is in front?",
    [|q, t| pile(q, t, |found, list| {
        let far = |t: usize| list[t].vertices.iter().map(|v| v.depth).sum::<f64>();
        found.iter().copied().reduce(|a, b| if far(b.0) < far(a.0) { b } else { a })
    })];

    "unclipped", "you return the triangle as it came: nothing is cut at the near plane",
    "A corner lies behind the eye. What is x / w there, and on which side of the picture does it appear?",
    [|q, _| near(q, |corners| corners.to_vec())];

    "dropped", "you drop every triangle that has a corner behind the near plane",
    "You stand on a large floor. Where are its corners, and what would be left of it?",
    [|q, _| near(q, |corners| if corners.iter().all(|c| c[2] + c[3] >= 0.0) { corners.to_vec() } else { Vec::new() })];

    "plane-z-zero", "you cut at z = 0; the near plane is z = -w",
    "The near plane becomes z / w = -1. Which sum of z and w is zero there?",
    [|q, _| near(q, |corners| clip(corners, |c| c[2]))];

    "pixel-samples", "your four samples are all at the centre: a pixel has all of them or none",
    "Where is sample 1, if (14, 6) sixteenths are counted from the pixel's upper left corner?",
    [|q, _| masks(q, [(8, 8); 4], [0, 1, 2, 3])];

    "square-samples", "your samples lie in a square grid",
    "Draw the four places (6, 2), (14, 6), (2, 10), (10, 14) into a pixel. How many columns do they occupy?",
    [|q, _| masks(q, [(4, 4), (12, 4), (4, 12), (12, 12)], [0, 1, 2, 3])];

    "reversed-bits", "you count the bits of the mask from the other end",
    "Which number has bit 0 set and no other bit?",
    [|q, _| masks(q, multisample::SAMPLES, [3, 2, 1, 0])];
];

/// The names of all, for those who list them.
pub fn all() -> impl Iterator<Item = &'static Misconception> {
    KNOWN.iter().map(|known| &known.is)
}

/// What explains the answers of a program, if anything that is known does.
pub fn find(asked: &[(Question, Answer)], truth: &Truth) -> Option<&'static Misconception> {
    let explains = |predict: &Predict| {
        let mut wrong = 0;
        for (question, answer) in asked {
            let Some(predicted) = predict(question, truth) else { continue };
            if !is_same(question, answer, &predicted) {
                return false;
            }
            let right = right(question, truth);
            wrong += u64::from(right.is_some_and(|right| !is_same(question, &right, &predicted)));
        }
        wrong > 0
    };
    KNOWN.iter().find(|known| known.predict.iter().any(explains)).map(|known| &known.is)
}

/// The right answer; of samples too, for which no answer of a check is expected.
fn right(question: &Question, truth: &Truth) -> Option<Answer> {
    match question.of {
        Asked::Samples(_) => masks(question, multisample::SAMPLES, [0, 1, 2, 3]),
        _ => expected_answer(question, truth),
    }
}

/// How far two values may be apart, as a share of the largest one.
const NEAR: f64 = 1e-6;

fn is_same(question: &Question, a: &Answer, b: &Answer) -> bool {
    let window = PixelRect::window(question.width, question.height);
    match (a, b) {
        (Answer::Line(a), Answer::Line(b)) => a == b,
        (Answer::Coverage(_), Answer::Coverage(_)) => {
            picture_of(a, window) == picture_of(b, window)
        }
        (Answer::Samples(a), Answer::Samples(b)) | (Answer::Seen(a), Answer::Seen(b)) => {
            let pixels = |runs: &[(Span, u8)]| {
                let all = runs.iter().flat_map(|(run, mark)| {
                    (run.x0_px..run.x1_px.min(run.x0_px.saturating_add(1024)))
                        .map(|x| (run.y_px, x, *mark))
                });
                let mut all: Vec<_> = all.collect();
                all.sort_unstable();
                all
            };
            pixels(a) == pixels(b)
        }
        (Answer::Values(a), Answer::Values(b)) => {
            let sorted = |list: &[Fragment<DVec2>]| {
                let mut list = list.to_vec();
                list.sort_unstable_by_key(|f| (f.y_px, f.x_px));
                list
            };
            let (a, b) = (sorted(a), sorted(b));
            let values = |f: &Fragment<DVec2>| [f.depth, f.varying.x, f.varying.y];
            let largest = b.iter().flat_map(values).fold(0.0, |m: f64, v| m.max(v.abs()));
            a.len() == b.len()
                && a.iter().zip(&b).all(|(a, b)| {
                    (a.x_px, a.y_px) == (b.x_px, b.y_px)
                        && values(a)
                            .iter()
                            .zip(values(b))
                            .all(|(a, b)| (a - b).abs() <= NEAR * largest)
                })
        }
        (Answer::Polygon(a), Answer::Polygon(b)) | (Answer::Carried(a), Answer::Carried(b)) => {
            let largest = b.as_flattened().iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let near = |a: &ClipCorner, b: &ClipCorner| {
                a.iter().zip(b).all(|(a, b)| (a - b).abs() <= NEAR * largest)
            };
            let n = b.len();
            a.len() == n
                && (n == 0 || (0..n).any(|first| (0..n).all(|i| near(&a[(first + i) % n], &b[i]))))
        }
        _ => false,
    }
}

fn right_line() -> LineConvention {
    LineConvention::default()
}

fn line_question(question: &Question) -> Option<LineQuestion> {
    let Asked::Line { ends, .. } = &question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    Some(LineQuestion { ends: ends.map(|end| [end.x, end.y]), window })
}

fn as_line(pixels: Vec<[i32; 2]>) -> Answer {
    Answer::Line(pixels.into_iter().map(|[x, y]| (x, y)).collect())
}

fn line(question: &Question, convention: LineConvention) -> Option<Answer> {
    convention.pixels(&line_question(question)?).map(as_line)
}

fn line_tie(question: &Question, tie: LineTie) -> Option<Answer> {
    line(question, LineConvention { rounding: LineRounding::Nearest(tie), ..right_line() })
}

/// The right pixels, always from the end with the smaller coordinate along the longer axis.
fn sorted_line(question: &Question, truth: &Truth) -> Option<Answer> {
    let Some(Answer::Line(mut pixels)) = right(question, truth) else { return None };
    let [a, b] = line_question(question)?.ends;
    let major =
        usize::from(i64::from(a[1]).abs_diff(b[1].into()) > i64::from(a[0]).abs_diff(b[0].into()));
    if b[major] < a[major] {
        pixels.reverse();
    }
    Some(Answer::Line(pixels))
}

/// A pixel for each column, of a line inside the window; halves go down the window, or on from the left end.
fn along_x(question: &Question, truth: &Truth, goes_on: bool) -> Option<Answer> {
    let LineQuestion { ends: [a, b], window } = line_question(question)?;
    let [a, b] = [a, b].map(|end| end.map(i64::from));
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    if dy.abs() <= dx.abs() || dx == 0 {
        return (dx != 0).then(|| right(question, truth)).flatten();
    }
    let (left, steps) = if dx < 0 { (b, -dx) } else { (a, dx) };
    // Of a mirrored line, half a step more is half a step less.
    let slope = dy * dx.signum();
    let half = if goes_on && slope < 0 { steps - 1 } else { steps };
    let pixel = |x: i64| [x, left[1] + (2 * slope * (x - left[0]) + half).div_euclid(2 * steps)];
    let inside = |[x, y]: &[i64; 2]| {
        (0..i64::from(window.x1)).contains(x) && (0..i64::from(window.y1)).contains(y)
    };
    let columns = (left[0]..=left[0] + steps).take(1 << 16).map(pixel).filter(inside);
    let mut pixels: Vec<_> = columns.map(|[x, y]| (x as i32, y as i32)).collect();
    if dx < 0 {
        pixels.reverse();
    }
    Some(Answer::Line(pixels))
}

fn exchanged_line(question: &Question, truth: &Truth) -> Option<Answer> {
    let Some(Answer::Line(pixels)) = right(question, truth) else { return None };
    let (width, height) = (question.width as i32, question.height as i32);
    let exchanged = pixels.into_iter().map(|(x, y)| (y, x));
    Some(Answer::Line(exchanged.filter(|(x, y)| *x < width && *y < height).collect()))
}

/// Rules for samples on edges that a mistake elsewhere may go with.
const TIES: [&str; 3] = ["top-left", "inclusive", "strict"];

fn coverage(question: &Question, convention: &Convention) -> Option<Answer> {
    let Asked::Coverage(corners) = &question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    let drawn = convention.cover(corners, window)?;
    let runs = drawn.runs().map(|(y_px, x0_px, x1_px)| Span { y_px, x0_px, x1_px });
    Some(Answer::Coverage(runs.collect()))
}

fn rule(question: &Question, name: &str) -> Option<Answer> {
    coverage(question, &Convention { ties: Ties::named(name)?, ..Convention::default() })
}

fn tied(question: &Question, convention: fn(Ties) -> Convention, tie: usize) -> Option<Answer> {
    coverage(question, &convention(Ties::named(TIES[tie])?))
}

/// Samples at the same distance from the pixel's upper left corner in x and y.
fn sampled(question: &Question, at: i32, tie: usize) -> Option<Answer> {
    let ties = Ties::named(TIES[tie])?;
    coverage(
        question,
        &Convention { shape: Shape::Point { x: at, y: at }, ties, ..Convention::default() },
    )
}

fn cut(question: &Question, rounding: Rounding, tie: usize) -> Option<Answer> {
    let (quantum, ties) = (Quantum { step: SUBPIXELS, rounding }, Ties::named(TIES[tie])?);
    coverage(question, &Convention { quantum, ties, ..Convention::default() })
}

/// Every pixel of the bounding box, rounded outwards to whole pixels.
fn boxed(question: &Question) -> Option<Answer> {
    let Asked::Coverage(corners) = &question.of else { return None };
    let ends = |of: fn(&rasterproof_core::grid::SubpixelPoint) -> i32, side: u32| {
        let values = corners.each_ref().map(of);
        let (low, high) = (values.iter().min()?, values.iter().max()?);
        let ceiling = high.div_euclid(SUBPIXELS) + i32::from(high.rem_euclid(SUBPIXELS) > 0);
        Some((low.div_euclid(SUBPIXELS).max(0), ceiling.min(side as i32)))
    };
    let ((x0_px, x1_px), (y0, y1)) =
        (ends(|p| p.x, question.width)?, ends(|p| p.y, question.height)?);
    if weights(corners, DVec2::ZERO).0 == 0.0 || x0_px >= x1_px {
        return None;
    }
    Some(Answer::Coverage((y0..y1).map(|y_px| Span { y_px, x0_px, x1_px }).collect()))
}

/// The edge function of a corner's opposite edge at a point, in pixels squared.
fn edge_at(corners: &Corners, corner: usize, p: DVec2) -> f64 {
    let at = |i: usize| DVec2::from(corners[i % 3].to_px());
    let (a, b) = (at(corner + 1), at(corner + 2));
    (b - a).perp_dot(p - a)
}

/// Twice the signed area, and the weights at a point.
fn weights(corners: &Corners, p: DVec2) -> (f64, DVec3) {
    let edges = DVec3::from([0, 1, 2].map(|i| edge_at(corners, i, p)));
    let area = edges.element_sum();
    (area, edges / area)
}

fn centre(x: i32, y: i32) -> DVec2 {
    DVec2::new(f64::from(x), f64::from(y)) + 0.5
}

fn mean(l: DVec3) -> DVec3 {
    l / l.element_sum()
}

/// The right fragments with their values computed anew.
fn values(
    question: &Question,
    truth: &Truth,
    value: &dyn Fn(&Triangle, &mut Fragment<DVec2>),
) -> Option<Answer> {
    let Asked::Values(triangle) = &question.of else { return None };
    let Some(Answer::Values(mut fragments)) = expected_answer(question, truth) else { return None };
    fragments.iter_mut().for_each(|fragment| value(triangle, fragment));
    Some(Answer::Values(fragments))
}

fn ws(triangle: &Triangle) -> DVec3 {
    triangle.vertices.each_ref().map(|v| 1.0 / v.inv_w).into()
}

fn zs(triangle: &Triangle) -> DVec3 {
    triangle.vertices.each_ref().map(|v| v.depth).into()
}

fn varyings(triangle: &Triangle, weights: DVec3) -> DVec2 {
    let v = &triangle.vertices;
    v[0].varying * weights.x + v[1].varying * weights.y + v[2].varying * weights.z
}

/// Attributes by other weights; depths as they should be.
fn attributes(
    question: &Question,
    truth: &Truth,
    weigh: fn(DVec3, DVec3) -> DVec3,
) -> Option<Answer> {
    values(question, truth, &|triangle, f| {
        let (_, l) = weights(&triangle.corners(), centre(f.x_px, f.y_px));
        f.varying = varyings(triangle, weigh(l, ws(triangle)));
    })
}

/// Depths by another formula of the weights, the depths, the w and twice the area; attributes as they should be.
fn depths(
    question: &Question,
    truth: &Truth,
    depth: fn(DVec3, DVec3, DVec3, f64) -> f64,
) -> Option<Answer> {
    values(question, truth, &|triangle, f| {
        let (area, l) = weights(&triangle.corners(), centre(f.x_px, f.y_px));
        f.depth = depth(l, zs(triangle), ws(triangle), area);
    })
}

/// Depth and attributes by weights that take the place of those in the window.
fn by_weights(
    question: &Question,
    truth: &Truth,
    weigh: &dyn Fn(&Corners, DVec2) -> DVec3,
) -> Option<Answer> {
    values(question, truth, &|triangle, f| {
        let l = weigh(&triangle.corners(), centre(f.x_px, f.y_px));
        f.depth = l.dot(zs(triangle));
        f.varying = varyings(triangle, mean(l / ws(triangle)));
    })
}

fn corner_values(question: &Question, truth: &Truth) -> Option<Answer> {
    by_weights(question, truth, &|corners, centre| weights(corners, centre - 0.5).1)
}

/// The second and the third weight exchanged where the area is negative.
fn swapped_weights(question: &Question, truth: &Truth) -> Option<Answer> {
    by_weights(question, truth, &|corners, centre| {
        let (area, l) = weights(corners, centre);
        if area < 0.0 { l.xzy() } else { l }
    })
}

/// The inverse of the matrix with the corners as columns, multiplied from the wrong side.
fn transposed_weights(question: &Question, truth: &Truth) -> Option<Answer> {
    by_weights(question, truth, &|corners, centre| {
        // The rows of the inverse: what each weight is of x, y and 1.
        let [a, b, c] = [0, 1, 2].map(|i| {
            let at = |p| edge_at(corners, i, p);
            let constant = at(DVec2::ZERO);
            DVec3::new(at(DVec2::X) - constant, at(DVec2::Y) - constant, constant)
        });
        (a * centre.x + b * centre.y + c) / (a.z + b.z + c.z)
    })
}

/// Picks the triangle that is shown, of those that cover a pixel, by number, each with its depth there.
type Choose = fn(&[(usize, f64)], &[Triangle]) -> Option<(usize, f64)>;

/// Which triangle a program shows at each pixel, of those that cover it with their depths there.
fn pile(question: &Question, truth: &Truth, choose: Choose) -> Option<Answer> {
    pile_by(question, truth, choose, |l, z, _| l.dot(z))
}

/// The least of depths that are computed by another formula.
fn deepest(
    question: &Question,
    truth: &Truth,
    depth: fn(DVec3, DVec3, f64) -> f64,
) -> Option<Answer> {
    let least = |found: &[(usize, f64)], _: &[Triangle]| {
        found.iter().copied().reduce(|a, b| if b.1 < a.1 { b } else { a })
    };
    pile_by(question, truth, least, depth)
}

fn pile_by(
    question: &Question,
    truth: &Truth,
    choose: Choose,
    depth: fn(DVec3, DVec3, f64) -> f64,
) -> Option<Answer> {
    let Asked::Depth(list) = &question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    let pictures: Option<Vec<_>> = list
        .iter()
        .map(|t| {
            let runs = truth.expect.picture(&t.corners(), window)?.must;
            picture_of(&Answer::Coverage(runs), window)
        })
        .collect();
    let pictures = pictures?;
    let mut seen = Vec::new();
    for (x, y) in (window.y0..window.y1).flat_map(|y| (window.x0..window.x1).map(move |x| (x, y))) {
        let covering =
            pictures.iter().enumerate().filter(|(_, p)| p.get(x, y).is_some_and(|n| n > 0));
        let found: Vec<_> = covering
            .map(|(t, _)| {
                let (area, l) = weights(&list[t].corners(), centre(x, y));
                (t, depth(l, zs(&list[t]), area))
            })
            .collect();
        if let Some((t, _)) = choose(&found, list) {
            seen.push((Span { y_px: y, x0_px: x, x1_px: x + 1 }, t as u8));
        }
    }
    Some(Answer::Seen(seen))
}

fn near(question: &Question, polygon: fn([ClipCorner; 3]) -> Vec<ClipCorner>) -> Option<Answer> {
    let triangle = near_plane::asked(&question.of)?;
    let polygon = polygon(clip_corners(&triangle));
    Some(match &question.of {
        Asked::Carried(_) => Answer::Carried(polygon),
        _ => Answer::Polygon(polygon),
    })
}

/// What has no negative distance is left of a triangle.
fn clip(corners: [ClipCorner; 3], distance: fn(&ClipCorner) -> f64) -> Vec<ClipCorner> {
    let mut left = Vec::new();
    for i in 0..3 {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        let (da, db) = (distance(&a), distance(&b));
        if da >= 0.0 {
            left.push(a);
        }
        if (da >= 0.0) != (db >= 0.0) {
            left.push([0, 1, 2, 3, 4].map(|k| a[k] + (b[k] - a[k]) * da / (da - db)));
        }
    }
    left
}

/// Masks of samples at other places, in sixteenths of a pixel, or with other bits.
fn masks(question: &Question, places: [(i32, i32); 4], bits: [u8; 4]) -> Option<Answer> {
    use rasterproof_core::contract::Rasterize as _;
    let Asked::Samples(corners) = &question.of else { return None };
    let window = PixelRect::window(question.width, question.height);
    let mut masks = rasterproof_core::frame::Frame::new(window, 0u8);
    for (place, bit) in places.into_iter().zip(bits) {
        let [a, b, c] = corners.map(|corner| multisample::onto_centre(corner, place));
        Oracle.cover([a?, b?, c?], window, |span| {
            masks
                .span_mut(span.y_px, span.x0_px, span.x1_px)
                .iter_mut()
                .for_each(|m| *m |= 1 << bit);
        });
    }
    let runs = masks.rows().flat_map(|(y_px, row)| runs_of(y_px, row));
    Some(Answer::Samples(runs.collect()))
}
