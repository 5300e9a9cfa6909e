//! What a scene costs in a view: every choice of each group and every planner on its own triangles, against the exact
//! answer.

use std::cell::RefCell;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate as _, Rasterize as _, RasterizeExact as _};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Span, check_value};
use rasterproof_precision::cost::scene::Scene as Class;
use rasterproof_precision::cost::{
    Choice, Clock, Ladder, Measure, Pass, Places, RatioKind, Times, Timing, Variant,
    compare as compare_times, compared_values, measure_on, over_fastest, variants, wrong_pixels,
    wrong_values,
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

/// A choice with what it gets wrong of the triangles of a scene, and what it takes.
#[derive(Clone, Debug, Default)]
pub struct JudgedChoice {
    pub choice: Choice,
    /// By each measure of the group; none where it does not apply.
    pub errors: Vec<Option<f64>>,
    /// Where it is wrong first: the triangle of the scene, where it is of one, and the pixel.
    pub first_wrong: Option<(Option<u32>, [i32; 2])>,
    /// Wrong samples by the triangles that they are of: the one that should be there, and the one that is.
    pub wrong: Vec<([u32; 2], u64)>,
    /// The smallest distance of a decision from 0, in error bounds; where such a bound is derived.
    pub margin: Option<f64>,
    pub time: Option<Times>,
    /// Memory at the peak, see [`crate::memory`].
    pub bytes: Option<u64>,
    pub refused: Option<String>,
}

impl JudgedChoice {
    fn new(choice: &Choice) -> Self {
        Self { choice: choice.clone(), ..Self::default() }
    }

    #[must_use]
    pub fn name(&self) -> &str {
        &self.choice.name
    }
}

/// How much of something there is, and of how much it is a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Part {
    pub part: u64,
    pub of: u64,
}

impl Part {
    fn all(of: u64) -> Self {
        Self { part: of, of }
    }

    #[must_use]
    pub fn is_all(self) -> bool {
        self.part == self.of
    }
}

/// Choices between which one may choose.
#[derive(Clone, Debug)]
pub struct Group {
    pub title: &'static str,
    pub measures: Vec<Measure>,
    pub choices: Vec<JudgedChoice>,
    /// Triangles that are timed.
    pub timed: Part,
    /// Pixels that these cover.
    pub timed_pixels: Part,
    /// Pixels in which it was looked for errors.
    pub judged: Part,
    /// Pixels of hard cases in which it was looked for what is wrong, where that is another part.
    pub looked_at: Option<Part>,
    /// Pieces that were left out, since single precision does not hold a value or 1/w of a corner.
    pub not_judged: u64,
}

/// The cheapest exact choice, and those of which the same rounds do not show that they are slower.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cheapest {
    pub choice: usize,
    /// Those between which and it there is no difference.
    pub equal: Vec<usize>,
    /// Those that may be faster or slower than it, for all that was measured.
    pub undecided: Vec<usize>,
    pub rounds: usize,
}

impl Group {
    fn new(title: &'static str, measures: Vec<Measure>, sample: &Sample) -> Self {
        Self {
            title,
            measures,
            choices: Vec::new(),
            timed: sample.pieces,
            timed_pixels: sample.pixels,
            judged: Part::all(sample.pixels.of),
            looked_at: None,
            not_judged: 0,
        }
    }

    /// Whether an error of a choice is one that a measure calls exact. Where no pixel was compared, nothing is.
    #[must_use]
    pub fn is_exact(&self, choice: &JudgedChoice, measure: usize) -> bool {
        let error = choice.errors.get(measure).copied().flatten();
        let goal = self.measures.get(measure).and_then(|measure| measure.goal);
        let meets = error.zip(goal).is_some_and(|(error, goal)| error <= goal);
        choice.refused.is_none() && self.judged.part > 0 && meets
    }

    /// The fastest of some choices.
    #[must_use]
    pub fn cheapest(&self, filter: &dyn Fn(&JudgedChoice) -> bool) -> Option<usize> {
        let timed = self.choices.iter().enumerate();
        let timed = timed.filter(|(_, choice)| choice.refused.is_none() && filter(choice));
        let timed =
            timed.filter_map(|(number, choice)| Some((number, choice.time.as_ref()?.median())));
        timed.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(number, _)| number)
    }

    /// The fastest of all choices that do the same job: both groups of coverage do.
    #[must_use]
    pub fn cheapest_of_job<'a>(&self, groups: &'a [Self]) -> Option<&'a Times> {
        let job = |group: &Self| group.title.split(" by ").next();
        let same = groups.iter().filter(|group| job(group) == job(self));
        let cheapest =
            same.filter_map(|group| group.choices[group.cheapest(&|_| true)?].time.as_ref());
        cheapest.min_by(|a, b| a.median().total_cmp(&b.median()))
    }

    pub fn cheapest_exact(&self, measure: usize) -> Option<usize> {
        self.cheapest(&|choice| self.is_exact(choice, measure))
    }

    /// The same with those that are as fast, as far as it can be told.
    pub fn compared(&self, measure: usize) -> Option<Cheapest> {
        let choice = self.cheapest_exact(measure)?;
        let best = self.choices[choice].time.as_ref()?;
        let (mut equal, mut undecided) = (Vec::new(), Vec::new());
        for (number, other) in self.choices.iter().enumerate() {
            if number == choice || !self.is_exact(other, measure) {
                continue;
            }
            let Some(ratio) = other.time.as_ref().and_then(|time| time.over(best)) else {
                continue;
            };
            match ratio.said() {
                RatioKind::NoDifference => equal.push(number),
                RatioKind::CannotBeTold if ratio.low <= 1.0 => undecided.push(number),
                RatioKind::CannotBeTold | RatioKind::Holds => {}
            }
        }
        Some(Cheapest { choice, equal, undecided, rounds: best.rounds() })
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
    /// How a group is timed.
    #[must_use]
    pub fn timing(self) -> Timing {
        match self {
            Self::Usual => Timing::USUAL,
            Self::Quick => Timing::QUICK,
            Self::Once => Timing::ONCE,
        }
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
    let timing = effort.timing();
    progress(0.0, Ladder::Scanline.title());
    let mut groups = coverage(sampled, &sample, timing.within(2.0));
    progress(0.4, Ladder::Interpolation.title());
    groups.push(ladder(Ladder::Interpolation, sampled.shaded(), Some(hard), timing));
    progress(0.5, Ladder::Depth.title());
    groups.push(depth(sampled, &sample, timing.within(2.0)));
    progress(0.6, Ladder::Antialiasing.title());
    let centres = (sampled.at_centres(), sampled.size);
    groups.push(ladder(Ladder::Antialiasing, centres, None, timing));
    progress(0.7, "planners");
    groups.push(planners(scene, target, timing.within(2.0))?);
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
    for (judged, by_piece) in group.choices.iter_mut().zip(&found.choices) {
        let of_pieces = of.iter().zip(&by_piece.wrong).filter(|(_, count)| **count > 0);
        judged.wrong = of_pieces.map(|(piece, count)| ([piece.face; 2], *count)).collect();
        merge(&mut judged.wrong);
        // What is wrong on hard cases is wrong of the model, whatever its other pixels show.
        if let Some(Some(error)) = judged.errors.first_mut() {
            *error = error.max(by_piece.worst);
        }
    }
    group.looked_at = Some(Part { part: found.pixels, of: found.of });
}

fn merge(wrong: &mut Vec<([u32; 2], u64)>) {
    wrong.sort_unstable();
    wrong.dedup_by(|later, kept| {
        let is_same = later.0 == kept.0;
        kept.1 += if is_same { later.1 } else { 0 };
        is_same
    });
}

/// Pieces that are timed.
struct Sample {
    numbers: Vec<usize>,
    pieces: Part,
    pixels: Part,
}

impl Sample {
    /// Every so many-th piece, and the largest of the others where these cover much less than was meant: of a floor of two
    /// triangles, one may lie outside the window but for a corner.
    fn new(pieces: &[Piece], window: PixelRect, most_px: u64) -> Self {
        let covered = |piece: &Piece| {
            let mut pixels = 0;
            Scanline.cover(piece.corners(), window, |span| pixels += span.pixels() as u64);
            pixels
        };
        let pixels: Vec<u64> = pieces.iter().map(covered).collect();
        Self::of_sizes(&pixels, most_px)
    }

    /// The same of pieces that cover so many pixels each.
    fn of_sizes(pixels: &[u64], most_px: u64) -> Self {
        let all: u64 = pixels.iter().sum();
        // A triangle without a pixel takes about as long as one with four.
        let work = all.max(4 * pixels.len() as u64);
        let stride = work.div_ceil(most_px.max(1)).max(1) as usize;
        let mut numbers: Vec<usize> = (0..pixels.len()).step_by(stride).collect();
        let mut timed: u64 = numbers.iter().map(|&number| pixels[number]).sum();
        let mut others: Vec<usize> =
            (0..pixels.len()).filter(|number| !number.is_multiple_of(stride)).collect();
        others.sort_by_key(|&number| std::cmp::Reverse(pixels[number]));
        for number in others {
            if 2 * timed >= most_px.min(all) {
                break;
            }
            timed += pixels[number];
            numbers.push(number);
        }
        numbers.sort_unstable();
        let pieces = Part { part: numbers.len() as u64, of: pixels.len() as u64 };
        Self { numbers, pieces, pixels: Part { part: timed, of: all } }
    }

    fn of<'a>(&self, pieces: &'a [Piece]) -> impl Iterator<Item = &'a Piece> {
        self.numbers.iter().map(|&number| &pieces[number])
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

/// Both groups of coverage: all pieces against the oracle, as they are and snapped; times of a sample, in the same rounds.
fn coverage(sampled: &Sampled, sample: &Sample, timing: Timing) -> Vec<Group> {
    let ladders = [Ladder::Scanline, Ladder::EdgeFunction];
    let all = ladders.map(variants);
    let mut groups: Vec<Group> = ladders
        .into_iter()
        .zip(&all)
        .map(|(ladder, variants)| judged_coverage(ladder, variants, sampled, sample))
        .collect();
    let class = class(sample.of(&sampled.planes[0]), sampled.window);
    let frame = Places::new(|| Frame::new(sampled.window, 0));
    let triangles = Places::new(|| class.triangles.clone());
    let mut passes = Vec::new();
    for (group, variants) in all.iter().enumerate() {
        for (choice, variant) in variants.iter().enumerate() {
            if groups[group].choices[choice].refused.is_none() {
                let (frame, triangles) = (&frame, &triangles);
                let pass = Pass::new(move || {
                    variant
                        .paint(std::hint::black_box(&triangles.borrow()), &mut frame.borrow_mut());
                });
                passes.push((group, choice, pass));
            }
        }
    }
    set_times(&mut groups, passes, timing);
    groups
}

fn judged_coverage(
    ladder: Ladder,
    variants: &[Variant],
    sampled: &Sampled,
    sample: &Sample,
) -> Group {
    let window = sampled.window;
    let chunks = chunks(sampled);
    let of_chunks = parallel::map(chunks.len(), |number| {
        let mut wrong = vec![Wrong::default(); variants.len()];
        for piece in chunks[number] {
            compare(variants, piece, window, &mut wrong);
        }
        wrong
    });
    let (titles, shorts) = match sampled.is_antialiased() {
        false => (
            ["wrong pixels, corners as they are", "wrong pixels, corners snapped"],
            ["px as given", "px snapped"],
        ),
        true => (
            ["wrong samples, corners as they are", "wrong samples, corners snapped"],
            ["samples as given", "samples snapped"],
        ),
    };
    let measure = |i: usize| Measure::new(titles[i], shorts[i], Some(0.0)).counts(sampled.unit());
    let mut group = Group::new(ladder.title(), [0, 1].map(measure).to_vec(), sample);
    for (number, variant) in variants.iter().enumerate() {
        let mut judged = JudgedChoice::new(&variant.choice);
        let of_choice = || of_chunks.iter().map(|chunk| &chunk[number]);
        let sum = |i: usize| of_choice().map(|wrong| wrong.pixels[i]).sum::<u64>() as f64;
        judged.errors = vec![Some(sum(0)), Some(sum(1))];
        let first = of_choice().find_map(|wrong| wrong.first);
        judged.first_wrong = first.map(|(face, sample)| (Some(face), sampled.pixel(sample)));
        judged.wrong = of_choice().flat_map(|wrong| &wrong.triangles).copied().collect();
        merge(&mut judged.wrong);
        judged.refused = of_choice().find_map(|wrong| wrong.refused.clone());
        judged.bytes = Some(memory::coverage(judged.name(), window, sample.pieces.part));
        let unit = match (ladder, judged.name()) {
            (Ladder::EdgeFunction, "f32 direct") => Some(f64::from(f32::EPSILON) / 2.0),
            (Ladder::EdgeFunction, "f64 direct") => Some(f64::EPSILON / 2.0),
            _ => None,
        };
        judged.margin = unit.map(|unit| margin(sampled, unit));
        group.choices.push(judged);
    }
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

/// Times choices in the same rounds: each against the fastest of all, and the exact ones of each measure against each other.
/// A pass comes with the numbers of its group and its choice.
fn set_times(groups: &mut [Group], passes: Vec<(usize, usize, Pass<'_>)>, timing: Timing) {
    let (places, mut passes): (Vec<[usize; 2]>, Vec<Pass<'_>>) =
        passes.into_iter().map(|(group, choice, pass)| ([group, choice], pass)).unzip();
    let mut sets = vec![(0..passes.len()).collect::<Vec<_>>()];
    for (number, group) in groups.iter().enumerate() {
        for measure in 0..group.measures.len() {
            let is_exact = |&place: &usize| {
                let [of, choice] = places[place];
                of == number && group.is_exact(&group.choices[choice], measure)
            };
            sets.push((0..places.len()).filter(is_exact).collect());
        }
    }
    let wanted = |medians: &[f64]| over_fastest(&sets, medians);
    let times = compare_times(&mut passes, timing, &wanted, &|_| ());
    for ([group, choice], of) in places.into_iter().zip(times) {
        groups[group].choices[choice].time = Some(of);
    }
}

/// A group of choices that are ready-made: errors of all pieces, times of a sample.
fn ladder(
    ladder: Ladder,
    (pieces, window): (&[Piece], PixelRect),
    hard: Option<&HardCases>,
    timing: Timing,
) -> Group {
    let is_judged = |piece: &&Piece| ladder != Ladder::Interpolation || has_values(piece);
    let taken: Vec<Piece> = pieces.iter().filter(is_judged).cloned().collect();
    let sample = Sample::new(&taken, window, TIMED_PX / 4);
    let classes = [class(taken.iter(), window), class(sample.of(&taken), window)];
    let measure = match ladder {
        Ladder::Interpolation => {
            let title = "worst error over the largest value; up to half a step of 8 bits is good";
            Measure::new(title, "error / M", Some(1.0 / 512.0))
        }
        _ => {
            let title = "root mean square distance from the exact share of a pixel on an edge";
            Measure::new(title, "rms of a px", Some(0.0))
        }
    };
    let mut groups = [Group::new(ladder.title(), vec![measure], &sample)];
    measure_on(ladder, &classes, &mut |board, placed| {
        let group = &mut groups[0];
        group.judged = match ladder {
            Ladder::Interpolation => {
                let of = board.columns[0].pixels;
                Part { part: compared_values(of), of }
            }
            _ => Part::all(sample.pixels.of),
        };
        group.not_judged = (pieces.len() - taken.len()) as u64;
        for (number, info) in board.choices.iter().enumerate() {
            let mut judged = JudgedChoice::new(info);
            let run = board.run(number, 0);
            judged.errors = vec![run.and_then(|run| run.errors.first().copied().flatten())];
            judged.bytes = match ladder {
                Ladder::Antialiasing => memory::antialiasing(&info.name, window),
                _ => Some(memory::interpolation(window)),
            };
            if run.is_none() {
                judged.refused = Some("it does not take these triangles".to_owned());
            }
            group.choices.push(judged);
        }
        if let Some(hard) = hard {
            wrong_values_of((pieces, window), hard, group);
        }
        let timed = placed.into_iter().filter(|placed| placed.column == 1);
        let timed = timed.map(|placed| (0, placed.choice, placed.pass)).collect();
        set_times(&mut groups, timed, timing);
    });
    let [group] = groups;
    group
}

/// Formats of the depth buffer: pixels that show another piece than the exact depths say.
fn depth(sampled: &Sampled, sample: &Sample, timing: Timing) -> Group {
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
        let mut choice = JudgedChoice::new(&Choice::new(format.name(), about, &[]));
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
    let (title, short) = match sampled.is_antialiased() {
        false => ("pixels that show another piece than exact depths do", "wrong px"),
        true => ("samples that show another piece than exact depths do", "wrong samples"),
    };
    let measure = Measure::new(title, short, Some(0.0)).counts(sampled.unit());
    let mut groups = [Group::new(Ladder::Depth.title(), vec![measure], sample)];
    groups[0].choices = choices;
    let mut passes = Vec::new();
    for (choice, format) in DepthFormat::ALL.into_iter().enumerate() {
        let pass = Pass::new(move || {
            let mut timed = sample.numbers.iter().copied();
            std::hint::black_box(seen(pieces, window, format, &mut timed));
        });
        passes.push((0, choice, pass));
    }
    set_times(&mut groups, passes, timing);
    let [group] = groups;
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
fn planners(scene: &Scene, target: &mut Target, timing: Timing) -> Result<Group, BadScene> {
    const PLANNERS: [(&str, Effects, &str); 3] = [
        ("all", Effects::ALWAYS, "every effect is computed everywhere"),
        ("usual", Effects::USUAL, "what a usual renderer leaves out is left out"),
        ("planned", Effects::PLANNED, "what changes no pixel, by a proof, is left out"),
    ];
    let window = target.size();
    let mut choices = Vec::new();
    let mut pictures: Vec<Frame<Colour>> = Vec::new();
    let mut draws: Vec<(Drawer, Effects)> = Vec::new();
    for drawer in Drawer::ALL {
        for (name, effects, about) in PLANNERS {
            let name = format!("{} {name}", drawer.name());
            let mut choice = JudgedChoice::new(&Choice::new(name, about, &[]));
            let rendered = drawer.render(scene, &effects, target)?;
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
        match frames::render(scene, window.width(), window.height(), per_pixel) {
            Ok(picture) => {
                pictures.push(picture);
                let about = "coverage exact, values in f32; the time of all its threads together";
                choices.push(JudgedChoice::new(&Choice::new("tiles", about, &[])));
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
    for (choice, (drawer, effects)) in draws.into_iter().enumerate() {
        let target = &target;
        let pass = Pass::new(move || {
            let rendered = drawer.render(scene, &effects, &mut target.borrow_mut());
            std::hint::black_box(rendered.is_ok());
        });
        passes.push((0, choice, pass));
    }
    if let Some(samples) = samples {
        let pass = Pass::new(move || {
            let rendered = frames::render(scene, window.width(), window.height(), samples);
            std::hint::black_box(rendered.is_ok());
        });
        passes.push((0, passes.len(), pass.by(Clock::Threads)));
    }
    let title = "pixels that differ from the frame of scanline with everything switched on";
    let measure = Measure::new(title, "wrong px", Some(0.0));
    let pixels = u64::from(window.width()) * u64::from(window.height());
    let of = Sample {
        numbers: Vec::new(),
        pieces: Part::all(scene.triangles() as u64),
        pixels: Part::all(pixels),
    };
    let mut groups = [Group::new(FRAMES, vec![measure], &of)];
    groups[0].choices = choices;
    set_times(&mut groups, passes, timing);
    let [group] = groups;
    Ok(group)
}

/// The title of the group of planners.
pub const FRAMES: &str = "Whole frames";

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex};

    fn piece(face: u32, px: [[f64; 2]; 3], depths: [f64; 3]) -> Piece {
        let vertices = [0, 1, 2]
            .map(|i| ScreenVertex::new(px[i][0], px[i][1], depths[i], 1.0, DVec2::ZERO).unwrap());
        let triangle = ScreenTriangle { vertices };
        let shares = [DVec2::ZERO, DVec2::X, DVec2::Y];
        Piece { face, item: 0, px, w: [1.0; 3], px_error: 0.0, depth_error: 0.0, triangle, shares }
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

    /// Of a floor of two triangles the first covers no pixel: the other is timed, though a sample of every second piece
    /// leaves it out.
    #[test]
    fn a_sample_covers_pixels_where_there_are_any() {
        let sample = Sample::of_sizes(&[0, 345_600], 50_000);
        assert_eq!((sample.numbers, sample.pixels), (vec![0, 1], Part::all(345_600)));
        let sample = Sample::of_sizes(&[10; 10_000], 50_000);
        assert_eq!(sample.numbers.len(), 5_000, "every second one is enough");
        assert_eq!(sample.pixels, Part { part: 50_000, of: 100_000 });
        assert_eq!(Sample::of_sizes(&[], 50_000).numbers, [0usize; 0]);
    }

    /// Where no pixel was compared, no choice is exact.
    #[test]
    fn nothing_is_exact_on_pixels_that_were_not_drawn() {
        let judged = JudgedChoice { errors: vec![Some(0.0)], ..JudgedChoice::default() };
        let mut group =
            Group::new("", vec![Measure::new("", "", Some(0.0))], &Sample::of_sizes(&[7], 9));
        assert!(group.is_exact(&judged, 0));
        group.judged.part = 0;
        assert!(!group.is_exact(&judged, 0));
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
