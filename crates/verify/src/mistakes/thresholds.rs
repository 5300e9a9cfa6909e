//! From which size, slope or position on a program is wrong, found by asking: shapes of a certain measure are asked for, and
//! the interval between the largest right measure and the smallest wrong one is halved until it is closed.

use std::fmt;

use super::fills::{FARTHEST, RATIO, decimal, extent, farthest, xs, ys};
use super::questions::{LONGEST_PX, Room};
use super::triangles::{self, SizeLimit};
use super::{Explanation, lines, sample_of, wide};
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
        // A sharp limit is said by what lies just beyond it, and another one by what is largest.
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
        match hint {
            Some(hint) => write!(f, " {hint}"),
            None => Ok(()),
        }
    }
}

impl Threshold {
    /// A row or a column at the end of a word, from which on it is wrong where it is right before.
    pub(super) fn as_cause(&self) -> Option<Explanation> {
        // Only a place in the window says what was counted: sizes and coordinates have more causes.
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
        // What is wrong is beyond the limit, and all that is right is before it.
        let wrong = self.wrong[0].drawn;
        Some(Explanation {
            wrong: Count { drawn: wrong, of: wrong },
            right: Count { drawn: self.right, of: self.right },
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
    /// As it is said, and as reports have it.
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
/// Where the measure is that of the shape on the grid, and not the one that was wished for.
struct ShapeAnswer {
    measure: i64,
    is_wrong: bool,
}

/// What a search came to.
struct LimitSearch {
    /// The largest measure up to which all are right.
    right_to: i64,
    /// The smallest measure of a wrong shape.
    wrong_from: i64,
    /// Shapes below the limit that were asked for and are right.
    right: u64,
    /// Wrong ones among those of up to twice the limit, and of the largest.
    wrong: [Count; 2],
    /// The same of those just above the limit.
    first: Count,
    /// See [`Threshold::is_sharp`].
    is_sharp: bool,
}

/// The last measure of which all are right and the first that is wrong; nothing where there is no such limit. `probe` asks for some
/// shapes whose measures lie between two numbers, and has none where it may not go on.
async fn search(
    low: i64,
    high: i64,
    mut probe: impl AsyncFnMut(i64, i64) -> Option<Vec<ShapeAnswer>>,
) -> Option<LimitSearch> {
    let mut right_to = 2 * low;
    if high < 2 * right_to {
        return None;
    }
    // The smallest shapes have to be right, and some of the largest wrong.
    let small = probe(low, right_to).await?;
    if first_wrong(&small).is_some() {
        return None;
    }
    let largest = probe(high / 2, high).await?;
    let mut wrong_from = first_wrong(&largest)?;
    // What lies between is halved, on a scale on which all powers of two are equally far apart.
    for _ in 0..MOST_ROUNDS {
        if wrong_from - right_to <= 1 {
            break;
        }
        let middle = geometric_mean(right_to, wrong_from).clamp(right_to + 1, wrong_from - 1);
        match first_wrong(&probe(right_to + 1, middle).await?) {
            Some(measure) => wrong_from = measure,
            None => right_to = middle,
        }
    }
    // Whether it is a limit: others below are right, and a good part of those above is wrong.
    // More shapes on both sides of what was found.
    let mut below = probe(low, right_to).await?;
    below.extend(probe((right_to / 2).max(low), right_to).await?);
    let up_to = |part: f64| ((wrong_from as f64 * part) as i64).clamp(wrong_from, high);
    let first = count(&probe(wrong_from, up_to(1.2)).await?);
    let wrong = [count(&probe(wrong_from, up_to(2.0)).await?), count(&largest)];
    let lower = first_wrong(&below);
    let is_sharp = lower.is_none() && is_many(wrong[0]);
    let right = (small.len() + below.len()) as u64;
    wrong_from = lower.unwrap_or(wrong_from);
    // What is rare at first has to be frequent in the end.
    let is_limit = is_sharp || (is_many(wrong[1]) && wrong_from >= 4 * low);
    is_limit.then_some(LimitSearch { right_to, wrong_from, right, wrong, first, is_sharp })
}

/// The least measure of a wrong shape.
fn first_wrong(seen: &[ShapeAnswer]) -> Option<i64> {
    let mut least = None;
    for shape in seen.iter().filter(|shape| shape.is_wrong) {
        least = Some(least.map_or(shape.measure, |least: i64| least.min(shape.measure)));
    }
    least
}

/// One of ten or more.
fn is_many(count: Count) -> bool {
    10 * count.drawn >= count.of
}

/// How many are wrong.
fn count(seen: &[ShapeAnswer]) -> Count {
    let mut wrong = Count::default();
    for shape in seen {
        wrong.add(shape.is_wrong);
    }
    wrong
}

/// The middle on a scale on which all powers of two are equally far apart.
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
    make: &dyn Fn(&mut Room, i64) -> (i64, S),
) -> (Vec<i64>, Vec<S>) {
    let (mut measures, mut shapes) = (Vec::new(), Vec::new());
    for number in 0..AT_ONCE {
        // What a shape comes to on the grid may lie outside, and is left out then.
        let about = between(room, from, to, number);
        let (measure, shape) = make(room, about);
        if (from..=to).contains(&measure) {
            measures.push(measure);
            shapes.push(shape);
        }
    }
    (measures, shapes)
}

/// Shapes of these measures, of which it is known whether they are drawn wrongly, or that this is open; nothing where too few were
/// answered.
fn answered(measures: Vec<i64>, are_wrong: Vec<Option<bool>>) -> Option<Vec<ShapeAnswer>> {
    if are_wrong.len() < measures.len() {
        return None;
    }
    let mut seen = Vec::new();
    for (measure, is_wrong) in measures.into_iter().zip(are_wrong) {
        if let Some(is_wrong) = is_wrong {
            seen.push(ShapeAnswer { measure, is_wrong });
        }
    }
    Some(seen)
}

/// The limits of a rasterizer that is expected to follow a convention.
pub(super) async fn of_triangles(
    asker: &TriangleAsker,
    known: &Declarations,
    expected: &TriangleConvention,
) -> Vec<Threshold> {
    // Questions of their own, so that other searches do not depend on how many were asked here.
    let mut room = Room::new(known, 2);
    let (grain, sample) = (room.grain, sample_of(expected));
    let per_px = 256 / grain;
    let mut found: Vec<FoundLimit> = Vec::new();
    for AxisRange { axis, low, mut high } in axes(&room, known, expected) {
        if matches!(axis, Axis::Column | Axis::Row) {
            // What is far to the right has large coordinates, whose limit is known.
            for FoundLimit { axis, limit } in &found {
                if axis.is_in_steps() {
                    high = high.min(limit.wrong_from / per_px - i64::from(SIDE_PX));
                }
            }
        }
        let limit = search(low, high, async |from, to| {
            let make = |room: &mut Room, measure| triangle(room, axis, measure, sample);
            let (measures, shapes) = shapes(&mut room, [from, to], &make);
            let questions: Vec<_> = shapes.iter().map(|shape| shape.question).collect();
            let answers = asker.ask(&questions).await;
            let mut are_wrong = Vec::new();
            for (shape, answer) in shapes.iter().zip(answers) {
                let is_drawn = answer.and_then(|picture| shape.is_drawn(&picture, expected));
                are_wrong.push(is_drawn.map(|is_drawn| !is_drawn));
            }
            answered(measures, are_wrong)
        });
        if let Some(limit) = limit.await {
            found.push(FoundLimit { axis, limit });
        }
    }
    // Large triangles have large coordinates: the measure that tells more is kept.
    let size = found.iter().position(|found| found.axis == Axis::Size);
    let reach = found.iter().position(|found| found.axis == Axis::Reach);
    if let (Some(size), Some(reach)) = (size, reach) {
        let is_size = found[size].tells(per_px) >= found[reach].tells(per_px);
        found.remove(if is_size { reach } else { size });
    }
    let mut limits = Vec::new();
    for FoundLimit { axis, limit } in found {
        limits.push(threshold(axis, "triangles", per_px, limit));
    }
    limits
}

/// A limit, and what is measured.
struct FoundLimit {
    axis: Axis,
    limit: LimitSearch,
}

impl FoundLimit {
    /// How much a limit says: the larger, the more.
    fn tells(&self, per_px: i64) -> (bool, bool, u64) {
        let has_hint = hint(self.axis, per_px, &self.limit).is_some();
        (self.limit.is_sharp, has_hint, self.limit.first.drawn)
    }
}

/// Between which measures a limit is looked for.
struct AxisRange {
    axis: Axis,
    low: i64,
    high: i64,
}

/// All that is measured of triangles that a program can be asked for.
fn axes(room: &Room, known: &Declarations, expected: &TriangleConvention) -> Vec<AxisRange> {
    let grain = room.grain;
    let [side, px] = [SIDE_PX, SUBPIXELS].map_array(i64::from);
    let farthest = room.range_px.min(1 << 22) * px / grain;
    let mut axes = vec![
        AxisRange { axis: Axis::Size, low: px / grain, high: farthest },
        AxisRange { axis: Axis::Reach, low: side * px / grain, high: farthest },
        AxisRange { axis: Axis::Slope, low: 8, high: (side - 1) * 256 / grain },
    ];
    // Rows of a picture that is turned over lie elsewhere.
    if expected.mirror == Mirror::None {
        let (wide, high) = known.window_px;
        for (axis, window) in [(Axis::Column, wide), (Axis::Row, high)] {
            let widest = i64::from(window.min(WIDEST_PX)) - side;
            axes.push(AxisRange { axis, low: side, high: widest.min(room.range_px - side) });
        }
    }
    axes
}

/// Triangles about as large as some limits of a metric, which are the parameters of mistakes.
pub(super) fn near(
    limits: &[i64],
    known: &Declarations,
    expected: &TriangleConvention,
) -> Vec<TriangleQuestion> {
    let mut room = Room::new(known, 4);
    let mut questions = Vec::new();
    for &p in limits {
        let SizeLimit { metric, limit, .. } = triangles::size(p);
        if metric == RATIO {
            continue;
        }
        // Twice the area is the product of two sides.
        let side = if metric == 0 { (limit as f64).sqrt() as i64 } else { limit };
        let steps = (side / room.grain).max(1);
        let axis = if metric >= FARTHEST { Axis::Reach } else { Axis::Size };
        for _ in 0..NEAR_A_LIMIT {
            let measure = room.rng.int(steps / 2 + 1, 2 * steps);
            questions.push(triangle(&mut room, axis, measure, sample_of(expected)).1.question);
        }
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
            let (measures, questions) = shapes(&mut room, [from, to], &make);
            let answers = asker.ask(&questions).await;
            let mut are_wrong = Vec::new();
            for (question, answer) in questions.iter().zip(answers) {
                let right = lines::of_convention(expected, wide(question.ends), question.window);
                let drawn = answer.map(|a| lines::mask(&lines::widened(&a), question.window));
                are_wrong.push(right.zip(drawn).map(|(right, drawn)| right != drawn));
            }
            answered(measures, are_wrong)
        });
        if let Some(limit) = limit.await {
            // Slopes are those of lines that are not too long.
            longest = limit.wrong_from - 1;
            found.push(threshold(axis, "lines", 1, limit));
        }
    }
    found
}

/// A triangle that is asked for.
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
        // The same triangle in the window at the origin.
        let mut back = self.question.corners;
        for c in &mut back {
            *c = SubpixelPoint::new(c.x - x * SUBPIXELS, c.y - y * SUBPIXELS);
        }
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

/// A triangle of about a measure near the window, or in a window whose last column or row is that; and its measure.
fn triangle(room: &mut Room, axis: Axis, measure: i64, sample: [i32; 2]) -> (i64, Shape) {
    let [wide, high] = room.side.map_array(|side| (side as i32).min(SIDE_PX));
    let near = PixelRect::window(wide as u32, high as u32);
    let at = room.inside(near);
    let mut moved_px = [0, 0];
    let points = match axis {
        Axis::Size => of_size(room, near, measure, sample),
        Axis::Reach => of_reach(room, near, measure, at),
        Axis::Slope => of_slope(room, near, measure, at),
        Axis::Column | Axis::Row => {
            // The window that is asked for ends with that column or row.
            let k = usize::from(axis == Axis::Row);
            let last = [wide, high][k] - 1;
            moved_px[k] = (measure as i32 - last).max(0);
            let far = moved_px.map_array(|px| i64::from(px) * 256);
            let mut points = [0; 3].map_array(|_| {
                let [x, y] = room.inside(near);
                [x + far[0], y + far[1]]
            });
            // A corner lies in it.
            points[0][k] = far[k] + i64::from(last) * 256 + room.rng.int(1, 255);
            points
        }
    };
    let mut corners: Corners = points.map_array(|point| room.point(point));
    if room.rng.chance(2) {
        corners.swap(1, 2);
    }
    // What it came to on the grid of coordinates.
    let (columns, rows) = (xs(&corners), ys(&corners));
    let [x, y] = moved_px;
    let measure = match axis {
        Axis::Size => extent(columns).max(extent(rows)) / room.grain,
        Axis::Reach => farthest(columns).max(farthest(rows)) / room.grain,
        Axis::Slope => steepest(&corners),
        Axis::Column => i64::from(x + wide - 1),
        Axis::Row => i64::from(y + high - 1),
    };
    let window = PixelRect::window((wide + x) as u32, (high + y) as u32);
    (measure, Shape { question: TriangleQuestion { corners, window }, near, moved_px })
}

/// Corners of a triangle with sides of that size, of which an edge passes a sample of the window closely.
fn of_size(room: &mut Room, near: PixelRect, measure: i64, sample: [i32; 2]) -> [[i64; 2]; 3] {
    // Products are largest on a diagonal.
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
        _ => [0, 1].map_array(|i| room.rng.int(first[i].min(second[i]), first[i].max(second[i]))),
    };
    [first, second, third]
}

/// Corners of which one has that coordinate, and with an edge through the window.
fn of_reach(room: &mut Room, near: PixelRect, measure: i64, at: [i64; 2]) -> [[i64; 2]; 3] {
    let most = measure * room.grain;
    let first = [0; 2].map_array(|_| room.rng.int(-most, most));
    // Often both coordinates are as far away.
    let mut first = first.map_array(|v| if room.rng.chance(3) { v.signum() * most } else { v });
    first[usize::from(room.rng.chance(2))] = if room.rng.chance(2) { most } else { -most };
    // Through the window, and not so far beyond.
    let beyond = room.rng.unit() * 0.5;
    let second = [0, 1].map_array(|i| at[i] + ((at[i] - first[i]) as f64 * beyond) as i64);
    [first, second, room.inside(near)]
}

/// Corners with an edge of that slope in the window.
fn of_slope(room: &mut Room, near: PixelRect, measure: i64, at: [i64; 2]) -> [[i64; 2]; 3] {
    let grain = room.grain;
    let length = i64::from(near.x1.min(near.y1)) * 256 * 3 / 4 / grain;
    let rise = (length / measure).max(1);
    let from = [at[0] / 4, at[1]].map_array(|v| v.div_euclid(grain) * grain);
    let sign = if room.rng.chance(2) { 1 } else { -1 };
    let to = [from[0] + rise * measure * grain, from[1] + sign * rise * grain];
    let off = room.rng.int(2, 10) * if room.rng.chance(2) { 256 } else { -256 };
    let third = [room.rng.int(from[0], to[0]), from[1] + off];
    // Steep edges are flat ones with x and y exchanged.
    let steep = room.rng.chance(2);
    [from, to, third].map_array(|[x, y]| if steep { [y, x] } else { [x, y] })
}

/// The largest ratio of an edge's sides, without level and upright ones.
fn steepest([a, b, c]: &Corners) -> i64 {
    slope(a, b).max(slope(b, c)).max(slope(c, a))
}

/// The longer side of an edge's box over the shorter one; 0 where it has none.
fn slope(p: &SubpixelPoint, q: &SubpixelPoint) -> i64 {
    let dx = (i64::from(q.x) - i64::from(p.x)).abs();
    let dy = (i64::from(q.y) - i64::from(p.y)).abs();
    dx.max(dy).checked_div(dx.min(dy)).unwrap_or(0)
}

/// A line of about a measure through a pixel of the window, and its measure.
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
    // Steep lines are as many as flat ones, and all directions are as many.
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

/// A limit with what is said of it.
fn threshold(axis: Axis, shapes: &str, per_px: i64, found: LimitSearch) -> Threshold {
    let scale = if axis.is_in_steps() { per_px } else { 1 };
    // What a number in some unit of the program would come to there.
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
