//! The convention of a line drawer, from its answers alone: how the minor coordinate is rounded,
//! whose pixel a tie is, which ends are drawn, and whether steps touch by sides or by corners.

use super::diagnosis::Confidence;
use super::outline::{End, Line, LineTie};
use super::ties::Count;
use crate::ask::Asker;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::random::Rng;

/// A line that a program is asked to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LineQuestion {
    pub ends: [[i32; 2]; 2],
    /// The pixels that are looked at: a window at the origin.
    pub window: PixelRect,
}

/// By which lines are asked for. An answer has the pixels, x and y, as they were drawn; it is None where the program refused or
/// died.
pub type LineAsker = Asker<LineQuestion, Option<Vec<[i32; 2]>>>;

/// How the minor coordinate of a step becomes a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum LineRounding {
    Nearest(LineTie),
    /// Down: to smaller coordinates.
    Down,
    /// Up: to larger coordinates.
    Up,
    /// Toward the coordinate of that end.
    Toward(End),
    /// Away from the coordinate of that end.
    Away(End),
    /// One step behind, seen from the end with the smaller major coordinate, which is not drawn; the
    /// slope is cut to 1/65536: the hairlines of Skia and tiny-skia. Ends and steps have no say.
    Behind,
    /// Cut down, half a step ahead where it grows, seen from the end with the smaller major coordinate;
    /// both ends are drawn; the slope is cut to 1/65536: the lines of Qt. Ends and steps have no say.
    Ahead,
}

rasterproof_core::named! {
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
    pub enum Ends {
        Both = "both ends are drawn",
        WithoutLast = "the last pixel is not drawn",
        WithoutFirst = "the first pixel is not drawn",
        WithoutRight = "the right end (of upright lines the lower) is not drawn",
        Neither = "neither end is drawn",
    }
}

/// How a step along both axes at once is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Steps {
    /// By corners: 8-connected.
    Corners,
    /// With a pixel between, 4-connected: along the major axis first, seen from that end.
    MajorFirst(End),
    /// 4-connected: along the minor axis first, seen from that end.
    MinorFirst(End),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LineConvention {
    pub rounding: LineRounding,
    pub ends: Ends,
    pub steps: Steps,
}

impl Default for LineConvention {
    /// This project's: the nearest pixel, ties go on from the end with the smaller major coordinate,
    /// both ends, 8-connected.
    fn default() -> Self {
        Self {
            rounding: LineRounding::Nearest(LineTie::SmallGo),
            ends: Ends::Both,
            steps: Steps::Corners,
        }
    }
}

impl LineRounding {
    /// All but those with pixels of their own, the simplest first.
    pub fn all() -> impl Iterator<Item = Self> {
        let cut = End::ALL.into_iter().flat_map(|end| [Self::Toward(end), Self::Away(end)]);
        let nearest = LineTie::ALL.map(Self::Nearest);
        nearest.into_iter().chain(cut).chain([Self::Down, Self::Up])
    }

    /// The minor coordinate of the pixel of a step.
    fn minor(self, line: &Line, step: i64) -> i64 {
        let (below, rest) = line.below(step);
        let up = match self {
            Self::Nearest(tie) => return line.nearest(step, tie),
            // These two have pixels of their own.
            Self::Down | Self::Behind | Self::Ahead => false,
            Self::Up => true,
            Self::Toward(end) => (line.dv < 0) == end.is_first(line),
            Self::Away(end) => (line.dv > 0) == end.is_first(line),
        };
        below + i64::from(up && rest > 0)
    }
}

impl Steps {
    /// All of them, 8-connected lines first.
    pub fn all() -> impl Iterator<Item = Self> {
        let between = End::ALL.into_iter().flat_map(|e| [Self::MajorFirst(e), Self::MinorFirst(e)]);
        std::iter::once(Self::Corners).chain(between)
    }

    /// Whether the pixel between two lies along the major axis from the former; None for no pixel.
    fn major_first(self, line: &Line) -> Option<bool> {
        match self {
            Self::Corners => None,
            Self::MajorFirst(end) => Some(end.is_first(line)),
            Self::MinorFirst(end) => Some(!end.is_first(line)),
        }
    }
}

/// Lines of more steps are not expected of conventions that walk them one by one.
const MOST_STEPS: i64 = 1 << 16;

impl LineConvention {
    /// The pixels of a line in the window, from the first end on. None where the convention says
    /// nothing: of a line between a pixel and itself, unless both ends are drawn, and, where it adds up a slope step by
    /// step, of a line of more than 65,536 steps.
    #[must_use]
    pub fn pixels(&self, question: &LineQuestion) -> Option<Vec<[i32; 2]>> {
        let [from, to] = question.ends.map_array(|end| end.map_array(i64::from));
        let line = Line::new(from, to);
        if line.steps() == 0 && self.ends != Ends::Both {
            return None;
        }
        if matches!(self.rounding, LineRounding::Behind | LineRounding::Ahead) {
            if line.steps() > MOST_STEPS {
                return None;
            }
            let all = stepped(from, to, self.rounding == LineRounding::Behind);
            return Some(inside(&all, question.window));
        }
        // However long the line is, only steps in the window are looked at.
        let Some(steps) = line.steps_in(question.window) else { return Some(Vec::new()) };
        // Whether the first and the last step of the line are looked at.
        let has_end = [*steps.start() == 0, *steps.end() == line.steps()];
        let mut pixels = Vec::new();
        let mut last = None;
        for step in steps {
            let minor = self.rounding.minor(&line, step);
            match (last, self.steps.major_first(&line)) {
                (Some(last), Some(major)) if last != minor => {
                    let (step, minor) = if major { (step, last) } else { (step - 1, minor) };
                    pixels.push(line.pixel(step, minor));
                }
                _ => {}
            }
            pixels.push(line.pixel(step, minor));
            last = Some(minor);
        }
        // Which of its ends a line draws may depend on its direction.
        let right_is_last = (to[0], to[1]) > (from[0], from[1]);
        let draws_end = match self.ends {
            Ends::Both => [true, true],
            Ends::WithoutLast => [true, false],
            Ends::WithoutFirst => [false, true],
            Ends::WithoutRight => [right_is_last, !right_is_last],
            Ends::Neither => [false, false],
        };
        // An end is left out where it lies in the window at all.
        let first = usize::from(has_end[0] && !draws_end[0]);
        let last = usize::from(has_end[1] && !draws_end[1]);
        let kept = first..pixels.len() - last;
        Some(inside(pixels.get(kept)?, question.window))
    }

    /// All that answers are tried on, the simplest first.
    fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for steps in Steps::all() {
            for ends in Ends::ALL {
                for rounding in LineRounding::all() {
                    all.push(Self { rounding, ends, steps });
                }
            }
        }
        all.extend([Self::BEHIND, Self::AHEAD]);
        all
    }

    /// [`LineRounding::Behind`], which has ends and steps of its own.
    pub const BEHIND: Self =
        Self { rounding: LineRounding::Behind, ends: Ends::WithoutFirst, steps: Steps::Corners };
    /// [`LineRounding::Ahead`], likewise.
    pub const AHEAD: Self =
        Self { rounding: LineRounding::Ahead, ends: Ends::Both, steps: Steps::Corners };
}

/// The pixels that lie in a window.
fn inside(pixels: &[[i64; 2]], window: PixelRect) -> Vec<[i32; 2]> {
    let (x, y) = (i64::from(window.x0)..window.x1.into(), i64::from(window.y0)..window.y1.into());
    let mut inside = Vec::new();
    for p in pixels {
        if x.contains(&p[0]) && y.contains(&p[1]) {
            // Inside the window, so both fit i32.
            inside.push([p[0] as i32, p[1] as i32]);
        }
    }
    inside
}

/// See [`LineRounding::Behind`] and [`LineRounding::Ahead`]: from the end with the smaller major
/// coordinate in 16.16 numbers, the slope cut toward zero.
fn stepped(from: [i64; 2], to: [i64; 2], is_behind: bool) -> Vec<[i64; 2]> {
    let delta = [to[0] - from[0], to[1] - from[1]];
    let [wide, high] = [delta[0].abs(), delta[1].abs()];
    // Of two axes as long as each other.
    let major = usize::from(wide < high || (wide == high && is_behind));
    let (start, sign) = if delta[major] < 0 { (to, -1) } else { (from, 1) };
    let slope = (sign * delta[1 - major] * 65536) / delta[major].abs().max(1);
    // From where the first pixel is taken, in 1/65536 px.
    let moved = if is_behind { 32768 - slope } else { (slope.max(0) + 1) / 2 };
    let mut pixels = Vec::new();
    for step in i64::from(is_behind)..=delta[major].abs() {
        let along = start[major] + step;
        let across = (start[1 - major] * 65536 + moved + step * slope).div_euclid(65536);
        pixels.push(if major == 0 { [along, across] } else { [across, along] });
    }
    if sign < 0 {
        pixels.reverse();
    }
    pixels
}

/// The default is that of a program that answers nothing.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LineDiagnosis {
    /// What it does; the nearest hypothesis where that is not known.
    pub convention: LineConvention,
    pub confidence: Confidence,
    /// Others that explain the answers equally well.
    pub alternatives: Vec<LineConvention>,
    /// Lines whose pixels are those of this project's convention.
    pub as_default: Count,
    /// Lines whose pixels are those of the convention found, of lines that it was not found from.
    pub as_found: Count,
    /// Lines with the same pixels from either end.
    pub both_ways: Count,
    /// Lines between a pixel and itself that are that pixel.
    pub points: Count,
    /// Lines whose pixels come in order from the first end; of none, where they come in no order.
    pub in_order: Count,
    /// Lines with a pixel drawn more than once.
    pub twice: Count,
    pub asked: u64,
    /// Of these, those that were refused or not answered.
    pub refused: u64,
}

/// A question with its answer, and the answer as a set.
struct LineAnswer {
    question: LineQuestion,
    pixels: Vec<[i32; 2]>,
    set: Vec<[i32; 2]>,
}

/// Each pixel once, in a fixed order.
fn set(pixels: &[[i32; 2]]) -> Vec<[i32; 2]> {
    let mut set = pixels.to_vec();
    set.sort_unstable();
    set.dedup();
    set
}

/// How many lines have the pixels of a convention, of those of which it says anything.
fn explained(convention: &LineConvention, drawn: &[LineAnswer]) -> Count {
    let mut count = Count::default();
    for drawn in drawn {
        if let Some(expected) = convention.pixels(&drawn.question) {
            count.add(set(&expected) == drawn.set);
        }
    }
    count
}

/// Side of the window of lines, in pixels.
const SIDE_PX: i32 = 40;
/// Lines that hypotheses are fitted to, and fresh ones; each is drawn from both ends.
const FITTED: usize = 120;
const FRESH: usize = 80;
/// Answers that all hypotheses are tried on, and how many of these go on.
const FEW: usize = 40;
const KEPT: usize = 40;

/// Random lines: half of them anywhere, half with ties, which random ones seldom have.
fn lines(rng: &mut Rng, side: i32, count: usize) -> Vec<LineQuestion> {
    let window = PixelRect::window(side as u32, side as u32);
    let pixel = |rng: &mut Rng| [0; 2].map_array(|_| rng.int(1, i64::from(side) - 2) as i32);
    let mut lines = Vec::with_capacity(2 * count);
    for number in 0..count {
        let from = pixel(rng);
        let to = if number % 2 == 0 {
            pixel(rng)
        } else {
            // Over an odd count of rows in an even count of columns, or the other way.
            let du = 2 * rng.int(1, i64::from(side) / 7) as i32;
            let dv = 2 * rng.int(0, i64::from(du) / 2 - 1) as i32 + 1;
            let (dx, dy) = if rng.chance(2) { (du, dv) } else { (dv, du) };
            let toward = |from: i32, by: i32| if from < side / 2 { from + by } else { from - by };
            [toward(from[0], dx), toward(from[1], dy)]
        };
        for ends in [[from, to], [to, from]] {
            lines.push(LineQuestion { ends, window });
        }
    }
    lines
}

/// Questions a line drawer until its convention is known; the same for the same seed and answers.
/// `side_px` is the side of the largest window it draws, `ordered` whether its pixels come in order.
/// Asks about 400 lines.
pub async fn diagnose_lines(
    asker: &LineAsker,
    side_px: i32,
    ordered: bool,
    seed: u64,
) -> LineDiagnosis {
    let mut rng = Rng::new("line convention", seed, 0);
    let side = side_px.clamp(16, SIDE_PX);
    let mut asked = [0, 0];
    let mut draw = async |list: Vec<LineQuestion>| -> Vec<Option<LineAnswer>> {
        let mut answers = asker.ask(&list).await;
        answers.resize_with(list.len(), || None);
        asked[0] += list.len() as u64;
        asked[1] += answers.iter().filter(|answer| answer.is_none()).count() as u64;
        let mut drawn = Vec::with_capacity(list.len());
        for (question, pixels) in list.into_iter().zip(answers) {
            drawn.push(pixels.map(|pixels| LineAnswer { question, set: set(&pixels), pixels }));
        }
        drawn
    };
    let answers = draw(lines(&mut rng, side, FITTED)).await;
    let mut both_ways = Count::default();
    for pair in answers.chunks_exact(2) {
        if let [Some(there), Some(back)] = pair {
            both_ways.add(there.set == back.set);
        }
    }
    // Those that were answered. Fresh lines are not the ones that hypotheses are fitted to.
    let fitted: Vec<_> = answers.into_iter().flatten().collect();
    let fresh: Vec<_> = draw(lines(&mut rng, side, FRESH)).await.into_iter().flatten().collect();
    let mut points = Count::default();
    let window = PixelRect::window(side as u32, side as u32);
    let dots = (0..4).map(|i| [3 + i, 9 - i]).map(|p| LineQuestion { ends: [p; 2], window });
    for dot in draw(dots.collect()).await.into_iter().flatten() {
        points.add(dot.set == dot.question.ends[..1]);
    }
    conclude(
        &fitted,
        &fresh,
        ordered,
        LineDiagnosis {
            both_ways,
            points,
            asked: asked[0],
            refused: asked[1],
            ..LineDiagnosis::default()
        },
    )
}

/// Conventions with how many lines they draw rightly, the best first; equal ones stay in their order.
fn best_on(drawn: &[LineAnswer], among: Vec<LineConvention>) -> Vec<(u64, LineConvention)> {
    let mut scored = Vec::with_capacity(among.len());
    for convention in among {
        scored.push((explained(&convention, drawn).drawn, convention));
    }
    scored.sort_by_key(|(right, _)| std::cmp::Reverse(*right));
    scored
}

/// What the answers say: hypotheses are fitted to the first lines, and counted on fresh ones.
fn conclude(
    fitted: &[LineAnswer],
    fresh: &[LineAnswer],
    ordered: bool,
    mut found: LineDiagnosis,
) -> LineDiagnosis {
    // The first of equals is the simplest. Few lines tell most of them apart.
    let few = best_on(&fitted[..fitted.len().min(FEW)], LineConvention::all());
    let scored = best_on(fitted, few.into_iter().take(KEPT).map(|(_, c)| c).collect());
    let best = explained(&scored[0].1, fresh);
    let whole = best.of > 0 && best.drawn == best.of && scored[0].0 == fitted.len() as u64;
    found.convention = scored[0].1;
    found.as_found = best;
    found.as_default = explained(&LineConvention::default(), fresh);
    // Others that are as right on these lines, and on fresh ones.
    for (right, other) in &scored[1..] {
        if whole && *right == scored[0].0 && explained(other, fresh) == best {
            found.alternatives.push(*other);
        }
    }
    found.confidence = Confidence::of(best, whole && found.alternatives.is_empty());
    for drawn in fresh {
        found.twice.add(drawn.set.len() < drawn.pixels.len());
        if ordered {
            let [[x, y], _] = drawn.question.ends;
            let away = |p: &[i32; 2]| (p[0] - x).abs() + (p[1] - y).abs();
            found.in_order.add(drawn.pixels.is_sorted_by_key(away));
        }
    }
    found
}

impl LineDiagnosis {
    /// The pixels that the convention expects, from the first end on. None where it is not known, or
    /// says nothing.
    #[must_use]
    pub fn expected(&self, question: &LineQuestion) -> Option<Vec<[i32; 2]>> {
        (self.confidence != Confidence::Unexplained)
            .then(|| self.convention.pixels(question))
            .flatten()
    }
}
