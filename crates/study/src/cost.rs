//! What a scene costs in a view: every choice of each group and every planner on its own triangles, against the exact
//! answer.

use std::cell::RefCell;
use std::time::{Duration, Instant};

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate as _, Rasterize as _, RasterizeExact as _};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Span, check_value};
use rasterproof_precision::cost::scene::Scene as Class;
use rasterproof_precision::cost::{
    Board, CostOptions, Finish, Ladder, Pass, Race, Spread, Timing, Variant, measure_on, race,
    time, variants, wrong_pixels, wrong_values,
};
use rasterproof_precision::ladder::snap;
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::Effects;
use rasterproof_render::effects::render::BadScene;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::Scene;
use rasterproof_tiles::frames::{self, TilesError};
use rasterproof_verify::comparison::tolerance::SCANLINE;
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::ExactTriangle;

use crate::effects::differing;
use crate::hard::HardCases;
use crate::memory;
use crate::view::{NOTHING, Piece, Sampled, seen};

/// A way to do a part of the work.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    pub name: String,
    pub about: String,
    /// By each measure of the group; none where it does not apply.
    pub errors: Vec<Option<f64>>,
    /// Where it is wrong first: the triangle of the scene, where it is of one, and the pixel.
    pub first_wrong: Option<(Option<u32>, [i32; 2])>,
    /// Wrong samples by the triangles that they are of: the one that should be there, and the one that is.
    pub wrong: Vec<([u32; 2], u64)>,
    /// The smallest distance of a decision from 0, in error bounds; where such a bound is derived.
    pub margin: Option<f64>,
    /// Nanoseconds of all that is timed.
    pub time: Option<Spread>,
    /// Memory at the peak, see [`crate::memory`].
    pub bytes: Option<u64>,
    pub refused: Option<String>,
    /// The measure by which it is exact for every model, not for this one alone.
    pub promises: Option<usize>,
}

impl Choice {
    fn new(name: &str, about: &str) -> Self {
        Self { name: name.to_owned(), about: about.to_owned(), ..Self::default() }
    }
}

/// What an error of a group means.
#[derive(Clone, Debug)]
pub struct Measure {
    pub title: &'static str,
    pub short: &'static str,
    /// What stands beside a count in a sentence; none for a measure that counts nothing.
    pub unit: Option<&'static str>,
    /// Up to this error a choice is exact, or as good; none for a measure that ranks nothing.
    pub goal: Option<f64>,
}

/// Choices between which one may choose.
#[derive(Clone, Debug)]
pub struct Group {
    pub title: &'static str,
    pub measures: Vec<Measure>,
    pub choices: Vec<Choice>,
    pub timed: [u64; 2],
    /// By measure the cheapest exact choice; none where none is exact.
    pub best: Vec<Option<Best>>,
    /// In how many of how many pixels of hard cases it was looked for what is wrong; none where in all.
    pub looked_at: Option<[u64; 2]>,
    /// Pieces that were left out, since single precision does not hold a value or 1/w of a corner.
    pub not_judged: u64,
}

/// The cheapest of the choices that a measure calls exact, as far as that could be told.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Best {
    pub choice: usize,
    /// Those that are shown to be equally fast, but for 3%.
    pub equal: Vec<usize>,
    /// Those that may be faster or slower than it by more than 3%, for all that was measured.
    pub undecided: Vec<usize>,
    /// Rounds in which they were compared; none for the only one that came into question.
    pub rounds: usize,
}

impl Best {
    fn alone(choice: usize) -> Self {
        Self { choice, ..Self::default() }
    }

    fn of(race: &Race, choices: &[usize]) -> Option<Self> {
        let with = |finish: Finish| {
            let all = race.finishes.iter().zip(choices);
            all.filter(|(own, _)| **own == finish).map(|(_, choice)| *choice).collect::<Vec<_>>()
        };
        let choice = *with(Finish::Fastest).first()?;
        let (equal, undecided) = (with(Finish::Equal), with(Finish::Undecided));
        Some(Self { choice, equal, undecided, rounds: race.rounds })
    }
}

impl Group {
    fn new(title: &'static str, measures: &[Measure], timed: [u64; 2]) -> Self {
        let (measures, choices) = (measures.to_vec(), Vec::new());
        let (best, looked_at, not_judged) = (Vec::new(), None, 0);
        Self { title, measures, choices, timed, best, looked_at, not_judged }
    }

    /// Whether an error of a choice is one that a measure calls exact.
    #[must_use]
    pub fn is_exact(&self, choice: &Choice, measure: usize) -> bool {
        let error = choice.errors.get(measure).copied().flatten();
        let goal = self.measures.get(measure).and_then(|measure| measure.goal);
        choice.refused.is_none() && error.zip(goal).is_some_and(|(error, goal)| error <= goal)
    }

    pub fn cheapest_exact(&self, measure: usize) -> Option<usize> {
        self.best.get(measure)?.as_ref().map(|best| best.choice)
    }

    #[must_use]
    pub fn cheapest(&self, filter: &dyn Fn(&Choice) -> bool) -> Option<usize> {
        let median = |choice: &Choice| choice.time.map(|time| time.median);
        let timed = self.choices.iter().enumerate();
        let timed = timed.filter(|(_, choice)| choice.refused.is_none() && filter(choice));
        let timed = timed.filter_map(|(number, choice)| Some((number, median(choice)?)));
        timed.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(number, _)| number)
    }
}

/// How thoroughly times are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// In seconds for what is timed, so that a difference of a few percent can be told.
    Usual,
    Quick,
    /// Everything a single time: for who looks at all but times.
    Once,
}

impl Effort {
    fn rounds(self) -> usize {
        match self {
            Self::Usual => 21,
            Self::Quick => 5,
            Self::Once => 1,
        }
    }

    fn of(self, [usual_ms, quick_ms]: [u64; 2]) -> Duration {
        Duration::from_millis(match self {
            Self::Usual => usual_ms,
            Self::Quick => quick_ms,
            Self::Once => 0,
        })
    }

    /// How long exact choices are compared with each other.
    fn race(self) -> Duration {
        self.of([4000, 500])
    }

    /// The same for formats of depth, which differ by a few percent, so that more rounds are needed.
    fn race_of_depths(self) -> Duration {
        2 * self.race()
    }

    /// How long whole frames are timed, and then compared with each other.
    fn frames(self) -> Duration {
        self.of([8000, 600])
    }

    /// How long frames without an effect are timed ([`crate::effects::survey`]).
    #[must_use]
    pub fn survey(self) -> Duration {
        self.of([5000, 700])
    }
}

/// Pixels that are timed on a group, quickly or not: which choice is the cheapest depends on the triangles.
const TIMED_PX: u64 = 200_000;

/// The costs of a scene in a view. `progress` gets the share done and a word about it.
pub fn measure(
    scene: &Scene,
    (sampled, hard): (&Sampled, &HardCases),
    target: &mut Target,
    effort: Effort,
    progress: &dyn Fn(f64, &str),
) -> Result<Vec<Group>, BadScene> {
    let sample = Sample::new(&sampled.planes[0], sampled.window, TIMED_PX);
    let mut groups = Vec::new();
    for (done, ladder) in [Ladder::Scanline, Ladder::EdgeFunction].into_iter().enumerate() {
        progress(0.2 * done as f64, ladder.title());
        groups.push(coverage(ladder, sampled, &sample, effort));
    }
    progress(0.4, Ladder::Interpolation.title());
    let shaded = sampled.shaded();
    let part = Sample::new(shaded.0, shaded.1, TIMED_PX / 4);
    groups.extend(ladder(Ladder::Interpolation, shaded, &part, effort));
    if let Some(group) = groups.last_mut() {
        wrong_values_of(shaded, hard, group);
    }
    progress(0.5, Ladder::Depth.title());
    groups.push(depth(sampled, &sample, effort));
    progress(0.6, Ladder::Antialiasing.title());
    let centres = (sampled.at_centres(), sampled.size);
    let part = Sample::new(centres.0, centres.1, TIMED_PX / 4);
    groups.extend(ladder(Ladder::Antialiasing, centres, &part, effort));
    progress(0.7, "planners");
    groups.push(planners(scene, target, effort)?);
    Ok(groups)
}

/// Adds to the choices of interpolation what each gets wrong of the triangles that are hard cases.
fn wrong_values_of((pieces, window): (&[Piece], PixelRect), hard: &HardCases, group: &mut Group) {
    let is_hard =
        |piece: &&Piece| hard.is_hard(piece.face) && piece.free().is_some() && has_values(piece);
    let of: Vec<&Piece> = pieces.iter().filter(is_hard).collect();
    if of.is_empty() {
        return;
    }
    let found = wrong_values(&class(of.iter().copied(), window));
    for (choice, wrong) in group.choices.iter_mut().zip(&found.wrong) {
        let of_pieces = of.iter().zip(wrong).filter(|(_, count)| **count > 0);
        choice.wrong = of_pieces.map(|(piece, count)| ([piece.face; 2], *count)).collect();
        merge(&mut choice.wrong);
    }
    group.looked_at = Some([found.pixels, found.of]);
}

fn merge(wrong: &mut Vec<([u32; 2], u64)>) {
    wrong.sort_unstable();
    wrong.dedup_by(|later, kept| {
        let is_same = later.0 == kept.0;
        kept.1 += if is_same { later.1 } else { 0 };
        is_same
    });
}

/// Pieces that are timed: every so many-th one.
struct Sample {
    stride: usize,
    pieces: u64,
    pixels: u64,
}

impl Sample {
    fn new(pieces: &[Piece], window: PixelRect, most_px: u64) -> Self {
        let covered = |piece: &Piece| {
            let mut pixels = 0;
            Scanline.cover(piece.corners(), window, |span| pixels += span.pixels() as u64);
            pixels
        };
        let pixels: Vec<u64> = pieces.iter().map(covered).collect();
        let all: u64 = pixels.iter().sum();
        // A triangle without a pixel takes about as long as one with four.
        let work = all.max(4 * pieces.len() as u64);
        let stride = work.div_ceil(most_px.max(1)).max(1) as usize;
        let timed = || pixels.iter().step_by(stride);
        Self { stride, pieces: timed().count() as u64, pixels: timed().sum() }
    }

    fn of<'a>(&self, pieces: &'a [Piece]) -> impl Iterator<Item = &'a Piece> {
        pieces.iter().step_by(self.stride)
    }
}

/// Whether the choices of interpolation, some of which are in single precision, take the values of a piece.
fn has_values(piece: &Piece) -> bool {
    let values = piece.triangle.vertices.iter().map(|vertex| vertex.varying.x);
    let is_held = |w: &f64| {
        let inv_w = (1.0 / w) as f32;
        inv_w.is_finite() && inv_w > 0.0
    };
    values.map(check_value).all(|checked| checked.is_ok()) && piece.w.iter().all(is_held)
}

fn class<'a>(pieces: impl Iterator<Item = &'a Piece>, window: PixelRect) -> Class {
    let free = pieces.filter_map(|piece| Some((piece.free()?, piece)));
    let (triangles, of): (Vec<_>, Vec<_>) = free.unzip();
    let mut values: Vec<[f64; 3]> = of
        .iter()
        .map(|piece: &&Piece| piece.triangle.vertices.map_array(|v| v.varying.x))
        .collect();
    // Without texture coordinates values are made up.
    if values.iter().flatten().all(|value| *value == 0.0) {
        values.clear();
    }
    Class {
        name: "model",
        about: "the triangles of the model",
        bounds: window,
        triangles,
        w: of.iter().map(|piece| piece.w).collect(),
        values,
        interior: None,
    }
}

/// What a choice of coverage gets wrong.
#[derive(Clone, Default)]
struct Wrong {
    /// Against the corners as they are, and snapped.
    pixels: [u64; 2],
    first: Option<(u32, [i32; 2])>,
    triangles: Vec<([u32; 2], u64)>,
    refused: Option<String>,
}

/// Pieces whose coverage is compared at once.
const CHUNK: usize = 256;

fn chunks(sampled: &Sampled) -> Vec<&[Piece]> {
    sampled.planes.iter().flat_map(|plane| plane.chunks(CHUNK)).collect()
}

/// Coverage of all pieces against the oracle, as they are and snapped; times of a sample.
fn coverage(ladder: Ladder, sampled: &Sampled, sample: &Sample, effort: Effort) -> Group {
    let (window, pieces) = (sampled.window, &sampled.planes[0]);
    let variants = variants(ladder);
    let chunks = chunks(sampled);
    let of_chunks = parallel::map(chunks.len(), |number| {
        let mut wrong = vec![Wrong::default(); variants.len()];
        for piece in chunks[number] {
            compare(&variants, piece, window, &mut wrong);
        }
        wrong
    });
    let mut choices: Vec<Choice> = variants
        .iter()
        .map(|variant| Choice::new(&variant.choice.name, &variant.choice.about))
        .collect();
    for (number, choice) in choices.iter_mut().enumerate() {
        let of_choice = || of_chunks.iter().map(|chunk| &chunk[number]);
        let sum = |i: usize| of_choice().map(|wrong| wrong.pixels[i]).sum::<u64>() as f64;
        choice.errors = vec![Some(sum(0)), Some(sum(1))];
        let first = of_choice().find_map(|wrong| wrong.first);
        choice.first_wrong = first.map(|(face, sample)| (Some(face), sampled.pixel(sample)));
        choice.wrong = of_choice().flat_map(|wrong| &wrong.triangles).copied().collect();
        merge(&mut choice.wrong);
        choice.refused = of_choice().find_map(|wrong| wrong.refused.clone());
        choice.promises = variants[number].choice.promises.first().copied();
        choice.bytes = Some(memory::coverage(&choice.name, window, sample.pieces));
        let unit = match (ladder, &*choice.name) {
            (Ladder::EdgeFunction, "f32 direct") => f64::from(f32::EPSILON) / 2.0,
            (Ladder::EdgeFunction, "f64 direct") => f64::EPSILON / 2.0,
            _ => continue,
        };
        choice.margin = Some(margin(sampled, unit));
    }
    let class = class(sample.of(pieces), window);
    let frame = RefCell::new(Frame::new(window, 0));
    let mut passes = Vec::new();
    let mut timed = Vec::new();
    for (number, variant) in variants.iter().enumerate() {
        if choices[number].refused.is_none() {
            let (frame, triangles) = (&frame, &class.triangles);
            let run = Box::new(move || {
                variant.paint(std::hint::black_box(triangles), &mut frame.borrow_mut());
            });
            passes.push(Pass { column: 0, run });
            timed.push(number);
        }
    }
    let titles = match sampled.is_antialiased() {
        false => ["wrong pixels, corners as they are", "wrong pixels, corners snapped"],
        true => ["wrong samples, corners as they are", "wrong samples, corners snapped"],
    };
    let unit = Some(sampled.unit());
    let shorts = match sampled.is_antialiased() {
        false => ["px as given", "px snapped"],
        true => ["samples as given", "samples snapped"],
    };
    let measures = [(titles[0], shorts[0]), (titles[1], shorts[1])];
    let measures = measures.map(|(title, short)| Measure { title, short, unit, goal: Some(0.0) });
    let mut group = Group::new(ladder.title(), &measures, [sample.pieces, sample.pixels]);
    group.choices = choices;
    set_times(&mut group, &timed, &mut passes, effort, (effort.rounds(), effort.race()));
    group
}

/// Adds what each choice gets wrong of a piece.
fn compare(variants: &[Variant], piece: &Piece, window: PixelRect, wrong: &mut [Wrong]) {
    let Some(free) = piece.free() else { return };
    let (mut given, mut snapped) = (Vec::new(), Vec::new());
    Oracle.cover_exact(&free, window, |span| given.push(span));
    if let Some(corners) = snap(&free) {
        Oracle.cover(corners, window, |span| snapped.push(span));
    }
    let mut spans = Vec::new();
    for (variant, wrong) in variants.iter().zip(wrong) {
        if wrong.refused.is_some() {
            continue;
        }
        spans.clear();
        match variant.spans(&free, window, &mut spans) {
            Err(why) => wrong.refused = Some(why),
            Ok(_) => {
                let [by_given, by_snapped] =
                    [&given, &snapped].map_array(|truth| wrong_pixels(&spans, truth));
                wrong.pixels[0] += by_given;
                wrong.pixels[1] += by_snapped;
                // A choice that snaps is judged by what it was given after that.
                let (count, truth) = match variant.choice.promises.contains(&1) {
                    true => (by_snapped, &snapped),
                    false => (by_given, &given),
                };
                if count > 0 {
                    wrong.triangles.push(([piece.face; 2], count));
                }
                if count > 0 && wrong.first.is_none() {
                    let first = first_difference(&spans, truth);
                    wrong.first = first.map(|sample| (piece.face, sample));
                }
            }
        }
    }
}

/// The first pixel that one list of spans hits more often than the other.
fn first_difference(a: &[Span], b: &[Span]) -> Option<[i32; 2]> {
    let pixels = |spans: &[Span]| {
        let each = spans.iter().flat_map(|s| (s.x0_px..s.x1_px).map(move |x| (s.y_px, x)));
        let mut all: Vec<(i32, i32)> = each.collect();
        all.sort_unstable();
        all
    };
    let (a, b) = (pixels(a), pixels(b));
    let same = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
    let first = a.get(same).into_iter().chain(b.get(same)).min()?;
    Some([first.1, first.0])
}

/// The smallest |E| over the bound of its error in floats of unit roundoff `u`, at the samples that it decides.
///
/// E = dx (py - ay) - dy (px - ax), the corners rounded first. A difference of coordinates is off by at most
/// u (|a| + |b|) for the corners and u times itself, a product by its factors' errors and u times itself, and E by
/// the errors of both products and u times itself. A sample is decided by the edge that is farthest outside of it, or,
/// inside, by the nearest of all.
fn margin(sampled: &Sampled, u: f64) -> f64 {
    let chunks = chunks(sampled);
    let of_chunks = parallel::map(chunks.len(), |number| {
        let each = chunks[number].iter().map(|piece| margin_of(piece.px, sampled.window, u));
        each.fold(f64::INFINITY, f64::min)
    });
    of_chunks.into_iter().fold(f64::INFINITY, f64::min)
}

fn margin_of(px: [[f64; 2]; 3], window: PixelRect, u: f64) -> f64 {
    let [a, b, c] = px;
    let edges = [[b, c], [c, a], [a, b]];
    let side = |[a, b]: [[f64; 2]; 2], p: [f64; 2]| {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let (qx, qy) = (p[0] - a[0], p[1] - a[1]);
        let error = |i: usize, d: f64| u * (a[i].abs() + b[i].abs() + d.abs());
        let from = |i: usize, q: f64| u * (a[i].abs() + q.abs());
        let products = dx.abs() * from(1, qy)
            + qy.abs() * error(0, dx)
            + dy.abs() * from(0, qx)
            + qx.abs() * error(1, dy);
        let (p, q) = (dx * qy, dy * qx);
        let bound = products + u * (p.abs() + q.abs() + (p - q).abs());
        // For products of errors.
        ((p - q), bound * 1.001)
    };
    let area = side([a, b], c).0;
    let sign = if area < 0.0 { -1.0 } else { 1.0 };
    let range = |i: usize, low: i32, high: i32| {
        let (least, most) = (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        let first = (least - 0.5).floor().max(f64::from(low)) as i32;
        let end = (most + 0.5).ceil().min(f64::from(high)) as i32;
        first..end
    };
    let mut smallest = f64::INFINITY;
    for y in range(1, window.y0, window.y1) {
        for x in range(0, window.x0, window.x1) {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let mut inside = f64::INFINITY;
            let mut outside: f64 = 0.0;
            for edge in edges {
                let (value, bound) = side(edge, p);
                let margin = value.abs() / bound;
                match value * sign > 0.0 {
                    true => inside = inside.min(margin),
                    false => outside = outside.max(margin),
                }
            }
            let is_inside = edges.iter().all(|edge| side(*edge, p).0 * sign > 0.0);
            smallest = smallest.min(if is_inside { inside } else { outside });
        }
    }
    smallest
}

/// Times the passes of some choices, and finds the fastest of those that are exact.
fn set_times(
    group: &mut Group,
    timed: &[usize],
    passes: &mut [Pass<'_>],
    effort: Effort,
    (rounds, race): (usize, Duration),
) {
    let slice = if effort == Effort::Once { Duration::ZERO } else { Timing::QUICK.slice };
    let spreads = time(passes, Timing { rounds, slice }, &|_| ());
    for (&number, spread) in timed.iter().zip(spreads) {
        group.choices[number].time = Some(spread);
    }
    set_best(group, timed, passes, effort, race);
}

/// An exact choice is raced unless a quarter of its first rounds is slower by more than this than the median of the best.
const CLOSE: f64 = 1.5;

/// Races the exact choices of each measure against each other; their times become those of the race.
fn set_best(
    group: &mut Group,
    timed: &[usize],
    passes: &mut [Pass<'_>],
    effort: Effort,
    budget: Duration,
) {
    let mut before: Vec<(Vec<usize>, Best)> = Vec::new();
    for measure in 0..group.measures.len() {
        let time = |place: usize| {
            let choice = &group.choices[timed[place]];
            choice.time.filter(|_| group.is_exact(choice, measure))
        };
        let medians = (0..timed.len()).filter_map(|place| Some(time(place)?.median));
        let least = medians.fold(f64::INFINITY, f64::min);
        let is_close = |place: &usize| time(*place).is_some_and(|t| t.low <= CLOSE * least);
        let racing: Vec<usize> = (0..timed.len()).filter(is_close).collect();
        let known = before.iter().find(|(same, _)| *same == racing).map(|(_, best)| best.clone());
        let best = match (known, &*racing) {
            (Some(best), _) => Some(best),
            (None, []) => None,
            (None, [only]) => Some(Best::alone(timed[*only])),
            (None, several) => {
                let of = passes.iter_mut().enumerate();
                let mut of: Vec<_> =
                    of.filter(|(place, _)| several.contains(place)).map(|(_, pass)| pass).collect();
                let race = race(&mut of, budget, effort == Effort::Usual);
                let numbers: Vec<usize> = several.iter().map(|&place| timed[place]).collect();
                for (&number, time) in numbers.iter().zip(&race.times) {
                    group.choices[number].time = Some(*time);
                }
                Best::of(&race, &numbers)
            }
        };
        before.extend(best.clone().map(|best| (racing, best)));
        group.best.push(best);
    }
}

/// A group whose errors are measured on a sample.
fn ladder(
    ladder: Ladder,
    (pieces, window): (&[Piece], PixelRect),
    sample: &Sample,
    effort: Effort,
) -> Option<Group> {
    let is_judged = |piece: &&Piece| ladder != Ladder::Interpolation || has_values(piece);
    let class = class(sample.of(pieces).filter(is_judged), window);
    let timing = match effort {
        Effort::Usual => Timing::USUAL,
        Effort::Quick => Timing::QUICK,
        Effort::Once => Timing::ONCE,
    };
    let options = CostOptions { seed: 0, quick: effort != Effort::Usual, timing: Some(timing) };
    let measures: &[Measure] = match ladder {
        Ladder::Interpolation => &[Measure {
            title: "worst error over the largest value; up to half a step of 8 bits is good",
            short: "error / M",
            unit: None,
            goal: Some(1.0 / 512.0),
        }],
        _ => &[Measure {
            title: "root mean square distance from the exact share of a pixel on an edge",
            short: "rms of a px",
            unit: None,
            goal: Some(0.0),
        }],
    };
    let mut group = Group::new(ladder.title(), measures, [0; 2]);
    group.not_judged = pieces.iter().filter(|piece| !is_judged(piece)).count() as u64;
    measure_on(ladder, &[class], &options, &mut |board: &Board, passes| {
        let Some(column) = board.columns.first() else { return };
        group.timed = [column.items, column.pixels];
        let numbers = 0..board.choices.len();
        group.choices = numbers.clone().map(|one| choice(board, one, window)).collect();
        let timed: Vec<usize> = numbers.filter(|&one| board.run(one, 0).is_some()).collect();
        set_best(&mut group, &timed, passes, effort, effort.race());
    })?;
    Some(group)
}

fn choice(board: &Board, number: usize, window: PixelRect) -> Choice {
    let (info, items) = (&board.choices[number], board.columns[0].items);
    let mut choice = Choice::new(&info.name, &info.about);
    let run = board.run(number, 0);
    choice.errors = vec![run.and_then(|run| run.errors.first().copied().flatten())];
    choice.time = run.and_then(|run| run.time).map(|time| time.item_ns.times(items as f64));
    choice.bytes = match board.ladder {
        Ladder::Antialiasing => memory::antialiasing(&info.name, window),
        _ => Some(memory::interpolation(window)),
    };
    if run.is_none() {
        choice.refused = Some("it does not take these triangles".to_owned());
    }
    choice
}

/// Formats of the depth buffer: pixels that show another piece than the exact depths say.
fn depth(sampled: &Sampled, sample: &Sample, effort: Effort) -> Group {
    let (window, pieces) = (sampled.window, &*sampled.planes[0]);
    let truths =
        parallel::map(sampled.planes.len(), |plane| exactly_seen(&sampled.planes[plane], window));
    let mut choices = Vec::new();
    for format in DepthFormat::ALL {
        let about = match format {
            DepthFormat::Unorm32 => "2^32 equal steps",
            DepthFormat::Unorm24 => "2^24 equal steps, as most hardware",
            DepthFormat::F32 => "a float, 0 at the near plane",
            DepthFormat::F32Reversed => "a float, 1 at the near plane",
            DepthFormat::F64 => "a double",
        };
        let mut choice = Choice::new(format.name(), about);
        choice.bytes = Some(memory::depth(format, window, sampled.planes.len()));
        for (pieces, truth) in sampled.planes.iter().zip(&truths) {
            let seen = seen(pieces, window, format, &mut (0..pieces.len()));
            for (y, row) in seen.rows() {
                for ((x, seen), exact) in (window.x0..).zip(row).zip(truth.row(y)) {
                    if seen != exact {
                        let face = |number: &u32| pieces.get(*number as usize).map(|p| p.face);
                        let (seen, exact) = (face(seen), face(exact));
                        let pixel = sampled.pixel([x, y]);
                        choice.first_wrong = choice.first_wrong.or(Some((exact.or(seen), pixel)));
                        let pair = exact.or(seen).zip(seen.or(exact));
                        choice.wrong.extend(pair.map(|(exact, seen)| ([exact, seen], 1)));
                    }
                }
            }
        }
        let wrong = choice.wrong.len();
        merge(&mut choice.wrong);
        choice.errors = vec![Some(wrong as f64)];
        choices.push(choice);
    }
    let mut passes = Vec::new();
    for format in DepthFormat::ALL {
        let run = Box::new(move || {
            let mut timed = (0..pieces.len()).step_by(sample.stride);
            std::hint::black_box(seen(pieces, window, format, &mut timed));
        });
        passes.push(Pass { column: 0, run });
    }
    let timed: Vec<usize> = (0..choices.len()).collect();
    let measure = Measure {
        title: match sampled.is_antialiased() {
            false => "pixels that show another piece than exact depths do",
            true => "samples that show another piece than exact depths do",
        },
        short: if sampled.is_antialiased() { "wrong samples" } else { "wrong px" },
        unit: Some(sampled.unit()),
        goal: Some(0.0),
    };
    let mut group = Group::new(Ladder::Depth.title(), &[measure], [sample.pieces, sample.pixels]);
    group.choices = choices;
    set_times(&mut group, &timed, &mut passes, effort, (effort.rounds(), effort.race_of_depths()));
    group
}

/// Which piece is nearest at each pixel by exact depths of the snapped pieces; of equal ones the first.
pub fn exactly_seen(pieces: &[Piece], window: PixelRect) -> Frame<u32> {
    let mut nearest = Frame::new(window, f64::INFINITY);
    let mut error = Frame::new(window, 0.0);
    let mut seen = Frame::new(window, NOTHING);
    for (number, piece) in pieces.iter().enumerate() {
        let depths = piece.triangle.vertices.map_array(|vertex| vertex.depth);
        let bound = SCANLINE.depth.at(depths);
        Scanline.runs(&piece.depth_only(), window, true, &mut |run| {
            for (x, &depth) in (run.x0_px..).zip(run.depths) {
                let at = |frame: &Frame<f64>| frame.get(x, run.y_px).unwrap_or(f64::INFINITY);
                let (old, reach) = (at(&nearest), bound + at(&error));
                let before = seen.get(x, run.y_px).unwrap_or(NOTHING);
                let is_nearer = match (depth - old).abs() <= reach && before != NOTHING {
                    false => depth < old,
                    true => is_nearer(piece, &pieces[before as usize], x, run.y_px),
                };
                if is_nearer {
                    nearest.span_mut(run.y_px, x, x + 1)[0] = depth;
                    error.span_mut(run.y_px, x, x + 1)[0] = bound;
                    seen.span_mut(run.y_px, x, x + 1)[0] = number as u32;
                }
            }
        });
    }
    seen
}

/// Whether a piece is nearer than another one at a pixel, exactly.
fn is_nearer(piece: &Piece, other: &Piece, x_px: i32, y_px: i32) -> bool {
    let [a, b] = [piece, other].map_array(|piece| {
        let depths = piece.triangle.vertices.map_array(|vertex| vertex.depth);
        let exact = ExactTriangle::new(&piece.corners(), depths, [1.0; 3], [[0.0; 0]; 3]);
        exact.map(|exact| exact.at(x_px, y_px).0)
    });
    a.zip(b).is_some_and(|(a, b)| a < b)
}

/// Whole frames: each rasterizer by each planner, and tiles, against the one with everything switched on.
fn planners(scene: &Scene, target: &mut Target, effort: Effort) -> Result<Group, BadScene> {
    const PLANNERS: [(&str, Effects, &str); 3] = [
        ("all", Effects::ALWAYS, "every effect is computed everywhere"),
        ("usual", Effects::USUAL, "what a usual renderer leaves out is left out"),
        ("planned", Effects::PLANNED, "what changes no pixel, by a proof, is left out"),
    ];
    let window = target.size();
    let mut choices = Vec::new();
    let mut pictures: Vec<Frame<Colour>> = Vec::new();
    let mut once = Duration::ZERO;
    let mut draws: Vec<(Drawer, Effects)> = Vec::new();
    for drawer in Drawer::ALL {
        for (name, effects, about) in PLANNERS {
            let mut choice = Choice::new(&format!("{} {name}", drawer.name()), about);
            let start = Instant::now();
            let rendered = drawer.render(scene, &effects, target)?;
            once += start.elapsed();
            choice.bytes = Some(memory::frame(&rendered, scene, target));
            pictures.push(rendered.picture);
            choices.push(choice);
            draws.push((drawer, effects));
        }
    }
    let samples = match target.antialias() {
        Antialias::None => Some(frames::Samples::One),
        Antialias::Multisample4 => Some(frames::Samples::Four),
        Antialias::Supersample(_) => None,
    };
    // What tiles would draw otherwise, or not alone, is no choice.
    let mut samples = match frames::beyond_f32(scene, window.width(), window.height())? {
        0 => samples,
        _ => None,
    };
    if let Some(per_pixel) = samples {
        let start = Instant::now();
        match frames::render(scene, window.width(), window.height(), per_pixel) {
            Ok(picture) => {
                pictures.push(picture);
                once += start.elapsed();
                choices.push(Choice::new("tiles", "coverage exact, values in f32; all threads"));
            }
            Err(TilesError::NotDrawn(_)) => samples = None,
            Err(TilesError::Scene(bad)) => return Err(bad),
        }
    }
    for (choice, picture) in choices.iter_mut().zip(&pictures) {
        let wrong: Vec<_> = differing(picture, &pictures[0], 0).collect();
        choice.first_wrong = wrong.first().map(|&(x, y)| (None, [x, y]));
        choice.errors = vec![Some(wrong.len() as f64)];
    }
    let target = RefCell::new(target);
    let mut passes = Vec::new();
    for (drawer, effects) in draws {
        let target = &target;
        let run = Box::new(move || {
            let rendered = drawer.render(scene, &effects, &mut target.borrow_mut());
            std::hint::black_box(rendered.is_ok());
        });
        passes.push(Pass { column: 0, run });
    }
    if let Some(samples) = samples {
        let run = Box::new(move || {
            let rendered = frames::render(scene, window.width(), window.height(), samples);
            std::hint::black_box(rendered.is_ok());
        });
        passes.push(Pass { column: 0, run });
    }
    let rounds = effort.frames().as_secs_f64() / once.as_secs_f64().max(1e-6);
    let rounds = if effort == Effort::Once { 1 } else { (rounds as usize).clamp(3, 101) };
    let timed: Vec<usize> = (0..choices.len()).collect();
    let measure = Measure {
        title: "pixels that differ from the frame of scanline with everything switched on",
        short: "wrong px",
        unit: None,
        goal: Some(0.0),
    };
    let pixels = u64::from(window.width()) * u64::from(window.height());
    let mut group = Group::new("Whole frames", &[measure], [scene.triangles() as u64, pixels]);
    group.choices = choices;
    set_times(&mut group, &timed, &mut passes, effort, (rounds, effort.frames()));
    Ok(group)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};

    fn piece(face: u32, px: [[f64; 2]; 3], depths: [f64; 3]) -> Piece {
        let vertices = [0, 1, 2]
            .map(|i| ScreenVertex::new(px[i][0], px[i][1], depths[i], 1.0, DVec2::ZERO).unwrap());
        let triangle = ScreenTriangle { vertices };
        Piece { face, item: 0, px, w: [1.0; 3], px_error: 0.0, depth_error: 0.0, triangle }
    }

    const WINDOW: PixelRect = PixelRect { x0: 0, y0: 0, x1: 32, y1: 32 };

    /// What choices of a group get wrong of one triangle, by name.
    fn wrong(ladder: Ladder, px: [[f64; 2]; 3]) -> Vec<(String, [u64; 2])> {
        let variants = variants(ladder);
        let mut wrong = vec![Wrong::default(); variants.len()];
        compare(&variants, &piece(0, px, [0.5; 3]), WINDOW, &mut wrong);
        let named = variants.iter().zip(wrong);
        named.map(|(variant, wrong)| (variant.choice.name.to_string(), wrong.pixels)).collect()
    }

    /// An edge that passes the samples on a diagonal by less than f32 can tell: f32 gets them wrong, and whoever promises
    /// to be right is.
    #[test]
    fn wrong_pixels_of_choices_are_counted() {
        let off = -1e-9;
        let px = [[0.25, 0.25 + off], [20.25, 20.25 + off], [3.625, 28.25]];
        let found = wrong(Ladder::EdgeFunction, px);
        let of = |name: &str| found.iter().find(|(other, _)| other == name).unwrap().1;
        assert!(of("f32 direct")[0] > 0, "{found:?}");
        assert_eq!(of("f64 direct")[0], 0, "{found:?}");
        assert_eq!((of("adaptive")[0], of("robust")[0]), (0, 0), "{found:?}");
        assert_eq!((of("engine")[1], of("i64")[1]), (0, 0), "{found:?}");
        assert!(of("engine")[0] > 0, "snapping moves the edge onto the samples: {found:?}");
        let unit = |bits: i32| 0.5f64.powi(bits);
        assert!(margin_of(px, WINDOW, unit(24)) < 1.0);
        assert!(margin_of(px, WINDOW, unit(53)) > 1.0);
    }

    #[test]
    fn the_nearest_piece_is_found_exactly() {
        let px = [[0.0, 0.0], [31.0, 0.0], [0.0, 31.0]];
        let at = |x: i32, y: i32, pieces: &[Piece]| exactly_seen(pieces, WINDOW).get(x, y).unwrap();
        let (near, far) = (piece(0, px, [0.5; 3]), piece(1, px, [0.5f64.next_up(); 3]));
        assert_eq!(at(3, 3, &[near, far]), 0);
        assert_eq!(at(3, 3, &[far, near]), 1, "by its place in the order");
        assert_eq!(at(3, 3, &[near, near]), 0, "of equal ones the first");
        assert_eq!(at(31, 31, &[near, far]), NOTHING);
        // A format with steps takes the first of the two.
        let stepped = seen(&[far, near], WINDOW, DepthFormat::Unorm24, &mut (0..2));
        assert_eq!(stepped.get(3, 3), Some(0));
    }
}
