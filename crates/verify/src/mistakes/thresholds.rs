//! From which size, slope or position on a program is wrong, found by asking: shapes of a certain measure are asked for, and
//! the interval between the largest right measure and the smallest wrong one is halved until it is closed.

use std::fmt;

use super::fills::{FARTHEST, RATIO, decimal};
use super::questions::{LONGEST_PX, Room};
use super::{Explanation, lines, sample_of};
use crate::convention::{
    Count, Declarations, LineAsker, LineConvention, LineQuestion, Mask, Mirror, TriangleAsker,
    TriangleConvention, TriangleQuestion,
};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;

/// Shapes that are asked for at once.
const AT_ONCE: usize = 40;
/// Halvings of the interval: 2^-20 of the logarithm of all sizes is less than a step of the grid.
const MOST_ROUNDS: usize = 24;
/// The side of the window around a shape, in pixels.
const SIDE_PX: i32 = 24;
/// The largest window that is asked for, in pixels: its picture has 100,000 of them.
const WIDEST_PX: u32 = 4096;

/// A limit beyond which a program is wrong.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Threshold {
    /// What is measured, such as "size".
    pub of: &'static str,
    /// Whether all below it are right and many above it are wrong. Otherwise wrong ones are rare at first.
    pub is_sharp: bool,
    /// The measure of the smallest shape that is wrong.
    pub wrong_from: f64,
    /// Shapes below the limit that were asked for; of a sharp limit none is wrong.
    pub right: u64,
    /// Wrong ones of those up to twice the limit, and of the largest that were asked for.
    pub wrong: [Count; 2],
    /// What reaches the end of a word there, where anything does.
    pub hint: Option<String>,
    /// What is said of it.
    #[cfg_attr(feature = "serde", serde(skip))]
    words: String,
}

impl fmt::Display for Threshold {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { right, wrong: [near, largest], words, hint, .. } = self;
        if self.is_sharp {
            let Count { drawn, of } = near;
            write!(
                f,
                "Found by asking: {words}: {drawn} of {of} up to twice that, and none of {right} below."
            )?;
        } else {
            let Count { drawn, of } = largest;
            write!(
                f,
                "Found by asking: {words}, rarely at first and often in the end ({drawn} of the {of} largest), as where numbers are rounded."
            )?;
        }
        hint.iter().try_for_each(|hint| write!(f, " {hint}"))
    }
}

impl Threshold {
    /// A row or a column at the end of a word, from which on it is wrong where it is right before.
    pub(super) fn as_cause(&self) -> Option<Explanation> {
        let is_place = [Axis::Column, Axis::Row].iter().any(|axis| axis.name() == self.of);
        let bits = (self.wrong_from as u64).checked_ilog2()?;
        if !is_place || !self.is_sharp || self.wrong_from != f64::from(2).powi(bits as i32) {
            return None;
        }
        let does = format!(
            "counts {}s of the window in a word of {bits} bits: it is right up to {} {}, and wrong from {} on",
            self.of,
            self.of,
            self.wrong_from - 1.0,
            self.wrong_from
        );
        let all = |many| Count { drawn: many, of: many };
        Some(Explanation {
            wrong: all(self.wrong[0].drawn),
            right: all(self.right),
            ..Explanation::new(
                "a word for rows or columns",
                does,
                "use a word that holds the largest window",
                "stability",
                "a triangle beyond it that is drawn rightly",
            )
        })
    }
}

/// What is measured.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Axis {
    /// The longer side of the box, in steps of the grid.
    Size,
    /// The coordinate that is farthest from 0, in steps of the grid.
    Reach,
    /// The ratio of the sides of the box of an edge.
    Slope,
    /// The column, or the row, in pixels.
    Column,
    Row,
}

impl Axis {
    fn name(self) -> &'static str {
        match self {
            Self::Size => "size",
            Self::Reach => "coordinate",
            Self::Slope => "slope",
            Self::Column => "column",
            Self::Row => "row",
        }
    }

    /// Whether triangles are measured in steps of the grid, and not in whole numbers.
    fn is_in_steps(self) -> bool {
        matches!(self, Self::Size | Self::Reach)
    }
}

/// A shape that was asked for.
struct ShapeAnswer {
    measure: i64,
    is_wrong: bool,
}

/// What a search came to.
struct LimitSearch {
    right_to: i64,
    wrong_from: i64,
    /// Shapes below the limit that were asked for and are right.
    right: u64,
    /// Wrong ones among those of up to twice the limit, and of the largest.
    wrong: [Count; 2],
    /// The same of those just above the limit.
    first: Count,
    is_sharp: bool,
}

/// The last measure of which all are right and the first that is wrong; nothing where there is no such limit. `probe` asks for some
/// shapes whose measures lie between two numbers, and has none where it may not go on.
async fn search(
    low: i64,
    high: i64,
    mut probe: impl AsyncFnMut(i64, i64) -> Option<Vec<ShapeAnswer>>,
) -> Option<LimitSearch> {
    let least = |seen: &[ShapeAnswer]| seen.iter().filter(|s| s.is_wrong).map(|s| s.measure).min();
    let mut right_to = 2 * low;
    if high < 2 * right_to {
        return None;
    }
    let small = probe(low, right_to).await?;
    if least(&small).is_some() {
        return None;
    }
    let largest = probe(high / 2, high).await?;
    let mut wrong_from = least(&largest)?;
    for _ in 0..MOST_ROUNDS {
        if wrong_from - right_to <= 1 {
            break;
        }
        let middle = geometric_mean(right_to, wrong_from).clamp(right_to + 1, wrong_from - 1);
        match least(&probe(right_to + 1, middle).await?) {
            Some(measure) => wrong_from = measure,
            None => right_to = middle,
        }
    }
    // Whether it is a limit: others below are right, and a good part of those above is wrong.
    let mut below = probe(low, right_to).await?;
    below.extend(probe((right_to / 2).max(low), right_to).await?);
    let up_to = |part: f64| ((wrong_from as f64 * part) as i64).clamp(wrong_from, high);
    let first = count(&probe(wrong_from, up_to(1.2)).await?);
    let wrong = [count(&probe(wrong_from, up_to(2.0)).await?), count(&largest)];
    let is_many = |count: &Count| 10 * count.drawn >= count.of;
    let lower = least(&below);
    let is_sharp = lower.is_none() && is_many(&wrong[0]);
    let right = (small.len() + below.len()) as u64;
    wrong_from = lower.unwrap_or(wrong_from);
    // What is rare at first has to be frequent in the end.
    let is_limit = is_sharp || (is_many(&wrong[1]) && wrong_from >= 4 * low);
    is_limit.then_some(LimitSearch { right_to, wrong_from, right, wrong, first, is_sharp })
}

fn count(seen: &[ShapeAnswer]) -> Count {
    let wrong = seen.iter().filter(|seen| seen.is_wrong).count();
    Count { drawn: wrong as u64, of: seen.len() as u64 }
}

fn geometric_mean(low: i64, high: i64) -> i64 {
    ((low as f64 * high as f64).sqrt() as i64).clamp(low, high)
}

/// A measure between two, near the upper one every second time; all powers of two are as likely.
fn between(room: &mut Room, from: i64, to: i64, number: usize) -> i64 {
    if number % 2 == 0 {
        return room.rng.int(from.max(to - to / 50), to);
    }
    let [mut low, mut high] = [from, to];
    for _ in 0..8 {
        let middle = geometric_mean(low, high);
        *if room.rng.chance(2) { &mut low } else { &mut high } = middle;
    }
    room.rng.int(low, high)
}

/// Shapes with measures between two numbers. `make` makes one of about a measure and says which it has.
fn shapes<S>(
    room: &mut Room,
    [from, to]: [i64; 2],
    make: impl Fn(&mut Room, i64) -> (i64, S),
) -> (Vec<i64>, Vec<S>) {
    let shapes = (0..AT_ONCE).map(|number| {
        let measure = between(room, from, to, number);
        make(room, measure)
    });
    shapes.filter(|(measure, _)| (from..=to).contains(measure)).unzip()
}

/// Shapes of these measures, of which it is known whether they are drawn wrongly, or that this is open; nothing where too few were
/// answered.
fn answered(measures: Vec<i64>, are_wrong: Vec<Option<bool>>) -> Option<Vec<ShapeAnswer>> {
    if are_wrong.len() < measures.len() {
        return None;
    }
    let seen = measures.into_iter().zip(are_wrong);
    Some(
        seen.filter_map(|(measure, is_wrong)| Some(ShapeAnswer { measure, is_wrong: is_wrong? }))
            .collect(),
    )
}

/// The limits of a rasterizer that is expected to follow a convention.
pub(super) async fn of_triangles(
    asker: &TriangleAsker,
    known: &Declarations,
    expected: &TriangleConvention,
) -> Vec<Threshold> {
    let mut room = Room::new(known, 2);
    let (grain, sample) = (room.grain, sample_of(expected));
    let (wide, high) = known.window_px;
    let widest = |side: u32| i64::from(side.min(WIDEST_PX) as i32 - SIDE_PX);
    let farthest = room.range_px.min(1 << 22) * i64::from(SUBPIXELS) / grain;
    let mut axes = vec![
        (Axis::Size, i64::from(SUBPIXELS) / grain, farthest),
        (Axis::Reach, i64::from(SIDE_PX * SUBPIXELS) / grain, farthest),
        (Axis::Slope, 8, i64::from(SIDE_PX - 1) * 256 / grain),
    ];
    // Rows of a picture that is turned over lie elsewhere.
    if expected.mirror == Mirror::None {
        let most = room.range_px - i64::from(SIDE_PX);
        axes.extend(
            [(Axis::Column, wide), (Axis::Row, high)]
                .map_array(|(axis, side)| (axis, i64::from(SIDE_PX), widest(side).min(most))),
        );
    }
    let per_px = 256 / grain;
    let mut found: Vec<(Axis, LimitSearch)> = Vec::new();
    for (axis, low, mut high) in axes {
        if matches!(axis, Axis::Column | Axis::Row) {
            // What is far to the right has large coordinates, whose limit is known.
            let far = found.iter().filter(|(axis, _)| axis.is_in_steps());
            let nearest = far.map(|(_, limit)| limit.wrong_from / per_px).min();
            high = high.min(nearest.unwrap_or(i64::MAX) - i64::from(SIDE_PX));
        }
        let limit = search(low, high, async |from, to| {
            let make = |room: &mut Room, measure| triangle(room, axis, measure, sample);
            let (measures, shapes) = shapes(&mut room, [from, to], make);
            let questions: Vec<_> = shapes.iter().map(|shape| shape.question).collect();
            let answers = asker.ask(&questions).await;
            let is_wrong = |(shape, answer): (&Shape, Option<Coverage>)| {
                Some(!shape.is_drawn(answer.as_ref()?, expected)?)
            };
            answered(measures, shapes.iter().zip(answers).map(is_wrong).collect())
        });
        let limit = limit.await;
        found.extend(limit.map(|limit| (axis, limit)));
    }
    // Large triangles have large coordinates: the measure that tells more is kept.
    let both =
        [Axis::Size, Axis::Reach].map_array(|axis| found.iter().position(|(of, _)| *of == axis));
    if let [Some(size), Some(reach)] = both {
        let tells = |(axis, limit): &(Axis, LimitSearch)| {
            (limit.is_sharp, hint(*axis, per_px, limit).is_some(), limit.first.drawn)
        };
        found.remove(if tells(&found[size]) >= tells(&found[reach]) { reach } else { size });
    }
    found.into_iter().map(|(axis, limit)| threshold(axis, "triangles", per_px, limit)).collect()
}

/// Triangles about as large as some limits of a metric.
pub(super) fn near(
    limits: impl Iterator<Item = (usize, bool, i64)>,
    known: &Declarations,
    expected: &TriangleConvention,
) -> Vec<TriangleQuestion> {
    let mut room = Room::new(known, 4);
    let mut questions = Vec::new();
    for (metric, _, limit) in limits.filter(|(metric, ..)| *metric != RATIO) {
        // Twice the area is the product of two sides.
        let side = if metric == 0 { (limit as f64).sqrt() as i64 } else { limit };
        let steps = (side / room.grain).max(1);
        let axis = if metric >= FARTHEST { Axis::Reach } else { Axis::Size };
        questions.extend((0..NEAR_A_LIMIT).map(|_| {
            let measure = room.rng.int(steps / 2 + 1, 2 * steps);
            triangle(&mut room, axis, measure, sample_of(expected)).1.question
        }));
    }
    questions
}

/// Triangles of about the size of a limit.
const NEAR_A_LIMIT: usize = 24;

/// The limits of a line drawer.
pub(super) async fn of_lines(
    asker: &LineAsker,
    known: &Declarations,
    expected: &LineConvention,
) -> Vec<Threshold> {
    let mut room = Room::new(known, 3);
    let mut longest = LONGEST_PX.min(room.range_px);
    let mut found = Vec::new();
    for axis in [Axis::Size, Axis::Slope] {
        // A short line has few slopes.
        let high = if axis == Axis::Size { longest } else { longest / 4 };
        let limit = search(4, high, async |from, to| {
            let make = |room: &mut Room, measure| line(room, axis, measure, longest);
            let (measures, questions) = shapes(&mut room, [from, to], make);
            let answers = asker.ask(&questions).await;
            let is_wrong = |(question, answer): (&LineQuestion, Option<Vec<[i32; 2]>>)| {
                let ends = question.ends.map_array(|end| end.map_array(i64::from));
                let right = lines::of_convention(expected, ends, question.window)?;
                let answer = answer?;
                let pixels: Vec<_> = answer.iter().map(|p| p.map_array(i64::from)).collect();
                Some(lines::mask(&pixels, question.window) != right)
            };
            answered(measures, questions.iter().zip(answers).map(is_wrong).collect())
        });
        let limit = limit.await;
        // Slopes are those of lines that are not too long.
        longest = limit.as_ref().map_or(longest, |limit| limit.wrong_from - 1);
        found.extend(limit.map(|limit| threshold(axis, "lines", 1, limit)));
    }
    found
}

struct Shape {
    question: TriangleQuestion,
    /// The window in which it lies, and how far that is from the origin in pixels.
    near: PixelRect,
    moved_px: [i32; 2],
}

impl Shape {
    /// Whether it was drawn as expected; nothing where that is open.
    fn is_drawn(&self, picture: &Coverage, expected: &TriangleConvention) -> Option<bool> {
        let [x, y] = self.moved_px;
        let back = self
            .question
            .corners
            .map_array(|c| SubpixelPoint::new(c.x - x * SUBPIXELS, c.y - y * SUBPIXELS));
        let right = expected.mask(&back, self.near)?;
        let mut drawn = Mask::default();
        let mut beyond = false;
        for (row, from, to) in picture.runs() {
            for column in from..to {
                let (px, py) = (column - x, row - y);
                match self.near.contains(px, py) {
                    true => drawn.set(px, py),
                    false => beyond = true,
                }
            }
        }
        Some(drawn == right && !beyond)
    }
}

fn triangle(room: &mut Room, axis: Axis, measure: i64, sample: [i32; 2]) -> (i64, Shape) {
    let grain = room.grain;
    let [wide, high] = room.side.map_array(|side| (side as i32).min(SIDE_PX));
    let near = PixelRect::window(wide as u32, high as u32);
    let at = room.inside(near);
    let mut moved_px = [0, 0];
    let points = match axis {
        Axis::Size => {
            // An edge through the window with sides of that size; products are largest on a diagonal.
            let mut sides = [measure; 2];
            if room.rng.chance(2) {
                sides[usize::from(room.rng.chance(2))] = room.rng.int(0, measure);
            }
            let sides = sides.map_array(|side| if room.rng.chance(2) { side } else { -side });
            // In half of them it begins or ends in the window.
            let part = [0.0, 1.0, room.rng.unit(), room.rng.unit()][room.rng.int(0, 3) as usize];
            let [first, second] = room.beside(near, sample, sides, part);
            let third = match room.rng.int(0, 2) {
                0 => [first[0], second[1]],
                1 => [second[0], first[1]],
                _ => [0, 1]
                    .map_array(|i| room.rng.int(first[i].min(second[i]), first[i].max(second[i]))),
            };
            [first, second, third]
        }
        Axis::Reach => {
            let most = measure * grain;
            let first = [0; 2].map_array(|_| room.rng.int(-most, most));
            let mut first =
                first.map_array(|v| if room.rng.chance(3) { v.signum() * most } else { v });
            first[usize::from(room.rng.chance(2))] = if room.rng.chance(2) { most } else { -most };
            // Through the window, and not so far beyond.
            let beyond = room.rng.unit() * 0.5;
            let second = [0, 1].map_array(|i| at[i] + ((at[i] - first[i]) as f64 * beyond) as i64);
            [first, second, room.inside(near)]
        }
        Axis::Slope => {
            let length = i64::from(wide.min(high)) * 256 * 3 / 4 / grain;
            let rise = (length / measure).max(1);
            let from = [at[0] / 4, at[1]].map_array(|v| v.div_euclid(grain) * grain);
            let sign = if room.rng.chance(2) { 1 } else { -1 };
            let to = [from[0] + rise * measure * grain, from[1] + sign * rise * grain];
            let off = room.rng.int(2, 10) * if room.rng.chance(2) { 256 } else { -256 };
            let third = [room.rng.int(from[0], to[0]), from[1] + off];
            let steep = room.rng.chance(2);
            [from, to, third].map_array(|[x, y]| if steep { [y, x] } else { [x, y] })
        }
        Axis::Column | Axis::Row => {
            // A corner lies in that column or row, the last one of its window.
            let k = usize::from(axis == Axis::Row);
            let last = [wide, high][k] - 1;
            moved_px[k] = (measure as i32 - last).max(0);
            let far = moved_px.map_array(|px| i64::from(px) * 256);
            let mut points = [0; 3].map_array(|_| {
                let [x, y] = room.inside(near);
                [x + far[0], y + far[1]]
            });
            points[0][k] = far[k] + i64::from(last) * 256 + room.rng.int(1, 255);
            points
        }
    };
    let mut corners: Corners = points.map_array(|point| room.point(point));
    if room.rng.chance(2) {
        corners.swap(1, 2);
    }
    let measure = match axis {
        Axis::Size => {
            let side = |of: &dyn Fn(&SubpixelPoint) -> i32| {
                let all = corners.map_array(|c| i64::from(of(&c)));
                all.into_iter().max().unwrap_or(0) - all.into_iter().min().unwrap_or(0)
            };
            side(&|c| c.x).max(side(&|c| c.y)) / grain
        }
        Axis::Reach => {
            let all = corners.iter().flat_map(|c| [c.x, c.y]);
            all.map(|v| i64::from(v).abs()).max().unwrap_or(0) / grain
        }
        Axis::Slope => steepest(&corners),
        Axis::Column | Axis::Row => {
            let [x, y] = [moved_px[0] + wide - 1, moved_px[1] + high - 1].map_array(i64::from);
            if axis == Axis::Column { x } else { y }
        }
    };
    let [x, y] = moved_px;
    let window = PixelRect::window((wide + x) as u32, (high + y) as u32);
    (measure, Shape { question: TriangleQuestion { corners, window }, near, moved_px })
}

/// The largest ratio of an edge's sides, without level and upright ones.
fn steepest([a, b, c]: &Corners) -> i64 {
    let ratio = |p: &SubpixelPoint, q: &SubpixelPoint| {
        let sides = [i64::from(q.x) - i64::from(p.x), i64::from(q.y) - i64::from(p.y)];
        let [dx, dy] = sides.map_array(i64::abs);
        dx.max(dy).checked_div(dx.min(dy)).unwrap_or(0)
    };
    ratio(a, b).max(ratio(b, c)).max(ratio(c, a))
}

fn line(room: &mut Room, axis: Axis, measure: i64, longest: i64) -> (i64, LineQuestion) {
    let [wide, high] = room.side.map_array(i64::from);
    let window = PixelRect::window(wide as u32, high as u32);
    let at = [room.rng.int(0, wide - 1), room.rng.int(0, high - 1)];
    let (major, minor) = match axis {
        Axis::Slope => {
            let rise = room.rng.int(1, (longest / measure).min(8));
            (rise * measure, rise)
        }
        _ => (measure, room.rng.int(0, measure)),
    };
    let mut along = [major, minor];
    if room.rng.chance(2) {
        along = [minor, major];
    }
    let along = along.map_array(|v| if room.rng.chance(2) { v } else { -v });
    // A third of the lines begins in the window, and a third ends there.
    let ahead = [0.0, 1.0, room.rng.unit()][room.rng.int(0, 2) as usize];
    let from = [0, 1].map_array(|i| at[i] - (along[i] as f64 * ahead).round() as i64);
    let ends = [from, [0, 1].map_array(|i| from[i] + along[i])];
    let most = room.range_px.min(1 << 22);
    let ends = ends.map_array(|end| end.map_array(|v| v.clamp(-most, most - 1) as i32));
    let [dx, dy] = [0, 1].map_array(|i| (i64::from(ends[1][i]) - i64::from(ends[0][i])).abs());
    let measure = match axis {
        Axis::Slope => dx.max(dy).checked_div(dx.min(dy)).unwrap_or(0),
        _ => dx.max(dy),
    };
    (measure, LineQuestion { ends, window })
}

fn threshold(axis: Axis, shapes: &str, per_px: i64, found: LimitSearch) -> Threshold {
    let scale = if axis.is_in_steps() { per_px } else { 1 };
    let hint = hint(axis, per_px, &found);
    let LimitSearch { wrong_from, right, wrong, is_sharp, .. } = found;
    let said = decimal(wrong_from, scale);
    let words = match axis {
        Axis::Size if shapes == "lines" => {
            format!("lines are wrong from {said} steps on")
        }
        Axis::Size => {
            format!("{shapes} are wrong from {said} px on, the longer side of their box")
        }
        Axis::Reach => format!("{shapes} are wrong from a coordinate of {said} px on"),
        Axis::Slope => format!("{shapes} are wrong from a slope of 1 : {said} on"),
        Axis::Column => format!("{shapes} are wrong from column {said} on"),
        Axis::Row => format!("{shapes} are wrong from row {said} on"),
    };
    Threshold {
        of: axis.name(),
        is_sharp,
        wrong_from: wrong_from as f64 / scale as f64,
        right,
        wrong,
        hint,
        words,
    }
}

/// What comes to the end of a word between two measures, in steps of the grid or in whole pixels.
fn hint(axis: Axis, per_px: i64, found: &LimitSearch) -> Option<String> {
    if axis == Axis::Slope || !found.is_sharp {
        return None;
    }
    // The first shape that is wrong is not exactly at the limit.
    let [least, most] = [found.right_to as f64 * 0.99, found.wrong_from as f64 * 1.01];
    // Programs may keep fewer bits below the pixel than they are asked with.
    let grids: &[i64] = if axis.is_in_steps() { &[256, 64, 16, 1] } else { &[1] };
    let grids = grids.iter().filter(|grid| **grid <= per_px);
    for (bits, word) in WORDS {
        let limit = 2f64.powi(bits);
        for &grid in grids.clone() {
            let scale = if axis.is_in_steps() { per_px / grid } else { 1 };
            let holds = |measure: f64| (least..=most).contains(&(measure * scale as f64));
            let what = if bits < 24 && holds(limit) {
                axis.name()
            } else if axis == Axis::Size && bits >= 15 && holds(limit.sqrt()) {
                "product of two sides"
            } else if axis == Axis::Size && bits >= 15 && holds((limit / 2.0).sqrt()) {
                "sum of two products of sides"
            } else {
                continue;
            };
            let unit = match grid {
                1 => "pixels".to_owned(),
                _ => format!("steps of 1/{grid} px"),
            };
            return Some(format!("There the {what} in {unit} passes 2^{bits}, the end of {word}."));
        }
    }
    None
}

/// Where words end, as powers of two, the likeliest first.
const WORDS: [(i32, &str); 7] = [
    (31, "a signed word of 32 bits"),
    (32, "a word of 32 bits"),
    (15, "a signed word of 16 bits"),
    (16, "a word of 16 bits"),
    (7, "a signed word of 8 bits"),
    (8, "a word of 8 bits"),
    (24, "what an f32 holds exactly"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ask::Search;
    use crate::mistakes;
    use rasterproof_core::contract::Rasterize as _;
    use rasterproof_core::raster::scanline::Scanline;

    type IsWrong<'a> = &'a dyn Fn(&TriangleQuestion) -> bool;

    /// The limits of a right rasterizer that leaves a pixel out of triangles of a kind.
    fn limits(is_wrong: IsWrong<'_>) -> Vec<Threshold> {
        let draw = |question: &TriangleQuestion| {
            let mut picture = Coverage::new(question.window, 0);
            let mut first = is_wrong(question);
            Scanline.cover(question.corners, question.window, |s| {
                picture.hit(s.y_px, s.x0_px + i32::from(first), s.x1_px);
                first = false;
            });
            Some(picture)
        };
        let (known, expected) = (Declarations::default(), TriangleConvention::default());
        Search::new(async |asker| of_triangles(&asker, &known, &expected).await)
            .answered_by(|questions| questions.iter().map(draw).collect())
    }

    fn sides(corners: &Corners) -> [i64; 2] {
        let side = |all: [i32; 3]| {
            i64::from(all.into_iter().max().unwrap()) - i64::from(all.into_iter().min().unwrap())
        };
        [side(corners.map_array(|c| c.x)), side(corners.map_array(|c| c.y))]
    }

    #[test]
    fn limits_are_found() {
        let largest = |q: &TriangleQuestion| sides(&q.corners).into_iter().max().unwrap();
        let found = limits(&|q| largest(q) > 300 * 256 + 77);
        let [limit] = &found[..] else { panic!("{found:?}") };
        assert_eq!((limit.of, limit.hint.as_deref()), ("size", None));
        let beyond = limit.wrong_from * 256.0 - 77.0 - 76_800.0;
        assert!(limit.is_sharp && (1.0..300.0).contains(&beyond), "{limit}");

        // A product of two sides in 32 bits.
        let found = limits(&|q| sides(&q.corners).iter().product::<i64>() >= 1 << 31);
        let said = found[0].to_string();
        assert!(said.starts_with("Found by asking: triangles are wrong from 181 px on"), "{said}");
        let hint = "the product of two sides in steps of 1/256 px passes 2^31, the end of a signed word of 32 bits";
        assert!(said.contains(hint), "{said}");

        // A coordinate in 16 bits.
        let far =
            |q: &TriangleQuestion| q.corners.iter().any(|c| c.x.abs().max(c.y.abs()) >= 1 << 15);
        let found = limits(&far);
        assert_eq!(found.len(), 1, "{found:?}");
        let said = found[0].to_string();
        assert!(said.contains("wrong from a coordinate of 128 px on: "), "{said}");
        assert!(said.contains("There the coordinate in steps of 1/256 px passes 2^15"), "{said}");

        // A column in 8 bits, which small windows do not show.
        let found = limits(&|q| q.window.x1 > 256 && q.window.y1 <= 24);
        let said = found[0].to_string();
        assert!(said.contains("wrong from column 256 on: "), "{said}");
        assert!(said.contains("There the column in pixels passes 2^8"), "{said}");

        // Flat edges.
        let found = limits(&|q| steepest(&q.corners) >= 300);
        assert!(found[0].to_string().contains("from a slope of 1 : 300 on"), "{found:?}");
    }

    /// Neither a right program nor one that is wrong everywhere has a limit.
    #[test]
    fn no_limit_is_found_where_none_is() {
        assert_eq!(limits(&|_| false), []);
        assert_eq!(limits(&|_| true), []);
        assert_eq!(limits(&|q| q.corners[0].x % 3 == 0), []);
    }

    /// The limit of lines, and that of a mistake that is named.
    #[test]
    fn limits_of_lines_are_found() {
        let convention = LineConvention::default();
        let draw = |question: &LineQuestion| {
            let [[x0, y0], [x1, y1]] = question.ends;
            let steps =
                (i64::from(x1) - i64::from(x0)).abs().max((i64::from(y1) - i64::from(y0)).abs());
            let mut pixels = convention.pixels(question)?;
            if steps > 16_384 {
                pixels.pop();
            }
            Some(pixels)
        };
        let answer = |questions: &[LineQuestion]| questions.iter().map(draw).collect();
        let known = Declarations::default();
        let found = Search::new(async |asker| of_lines(&asker, &known, &convention).await);
        let found = found.answered_by(answer);
        assert!(found[0].to_string().contains("lines are wrong from 16385 steps on"), "{found:?}");
        let found = Search::new(async |asker| mistakes::of_lines(&asker, &known, None, &[]).await);
        let found = found.answered_by(answer).unwrap();
        assert_eq!(found.limits.len(), 1, "{found}");
    }
}
