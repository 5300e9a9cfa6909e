//! What a scene costs in a view: every choice of each group and every planner on its own triangles, against the exact
//! answer. A scene is a column of the boards of `cost`, with pixels counted instead of shares.

use std::cell::RefCell;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate as _, Rasterize as _};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::parallel;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{ScreenTriangle, check_value};
use rasterproof_precision::cost::scene::Scene as Class;
use rasterproof_precision::cost::{
    Board, Choice, Clock, Column, Details, Entry, Ladder, Measure, Part, Pass, PreparedCell, Run,
    Sampling, Timing, add_column, antialiasing, coverage, interpolation,
};
use rasterproof_registry::engines::Drawer;
use rasterproof_render::effects::plan::{PiecePlan, Pieces, Samples};
use rasterproof_render::effects::render::{BadScene, Rendered};
use rasterproof_render::pipeline::assemble::ClipPoint;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::shade::{Attributes, PLACED};
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::Scene;
use rasterproof_tiles::frames::{self, TilesError};
use rasterproof_verify::comparison::tolerance::SCANLINE;
use rasterproof_verify::oracle::values::ExactTriangle;

use crate::effects::{PLANS, differing, frame_pass};
use crate::hard::HardCases;
use crate::view::{NOTHING, Piece, Sampled, seen};

/// Pixels that are timed on a group, quickly or not: which choice is the cheapest depends on the triangles.
const TIMED_PX: u64 = 200_000;

/// The costs of a scene in a view, a board with one column for each group. `progress` gets the share done and a word about it.
pub fn measure(
    scene: &Scene,
    (sampled, hard): (&Sampled, &HardCases),
    target: &mut Target,
    timing: Timing,
    progress: &dyn Fn(f64, &str),
) -> Result<Vec<Board>, BadScene> {
    // All pieces are judged, but only a sample of them is timed, the same one by coverage and by depth formats.
    let sample = Sample::new(&sampled.planes[0], sampled.window, TIMED_PX);
    progress(0.0, Ladder::Scanline.title());
    let mut boards = coverage_boards(sampled, &sample, timing.within(2.0));
    progress(0.4, Ladder::Interpolation.title());
    boards.extend(interpolation_board(sampled.shaded(), hard, timing));
    progress(0.5, Ladder::Depth.title());
    boards.extend(depth(sampled, &sample, timing.within(2.0)));
    progress(0.6, Ladder::Antialiasing.title());
    boards.extend(antialiasing_board((sampled.at_centres(), sampled.size), timing));
    progress(0.7, "planners");
    boards.extend(planners(scene, target, timing.within(2.0))?);
    Ok(boards)
}

/// A board without columns, and what happens to each of its choices on the model.
type Group<'a> = (Board, Vec<PreparedCell<'a>>);

/// A group whose choices have entries; `cell` gets the number of each as well.
fn group<'a, I>(
    ladder: Ladder,
    measures: &[Measure],
    entries: Vec<Entry<I>>,
    cell: impl Fn((usize, &Entry<I>)) -> PreparedCell<'a>,
) -> Group<'a> {
    let cells = entries.iter().enumerate().map(cell).collect();
    let choices = entries.into_iter().map(|entry| entry.choice).collect();
    (Board::new(ladder, 0, measures.to_vec(), choices), cells)
}

/// The boards of groups that do the same job, with the model as their one column.
fn boards<'a>(
    groups: impl IntoIterator<Item = Group<'a>>,
    sampling: Sampling,
    timing: Timing,
) -> Vec<Board> {
    let (mut boards, cells): (Vec<Board>, _) = groups.into_iter().unzip();
    add_column(&mut boards, &Column::of_model(sampling), cells, Some(timing), &|_| ());
    boards
}

/// What the buffers of a choice take at their peak, in a window and for so many triangles.
fn bytes(choice: &Choice, window: PixelRect, triangles: u64) -> u64 {
    // The scene itself is not counted: every choice has that.
    let [of_pixel, of_triangle] = choice.bytes;
    of_pixel * pixels(window) + of_triangle * triangles
}

/// How many pixels a window has.
fn pixels(window: PixelRect) -> u64 {
    u64::from(window.width()) * u64::from(window.height())
}

/// Pieces that are timed: every so many-th of a view, so that all parts of it are among them.
struct Sample {
    /// The numbers of the timed pieces, sorted.
    numbers: Vec<usize>,
    /// How many of all pieces these are, and how many of all covered pixels they cover.
    pieces: Part,
    pixels: Part,
}

impl Sample {
    /// Every so many-th piece, and the largest of the others where these cover much less than was meant: of a floor of two
    /// triangles, one may lie outside the window but for a corner.
    fn new(pieces: &[Piece], window: PixelRect, most_px: u64) -> Self {
        let mut covered = Vec::with_capacity(pieces.len());
        for piece in pieces {
            let mut pixels = 0;
            Scanline.cover(piece.corners(), window, |span| pixels += span.pixels() as u64);
            covered.push(pixels);
        }
        Self::of_sizes(&covered, most_px)
    }

    /// The same of pieces that cover so many pixels each.
    fn of_sizes(pixels: &[u64], most_px: u64) -> Self {
        let all: u64 = pixels.iter().sum();
        // A triangle without a pixel takes about as long as one with four.
        let work = all.max(4 * pixels.len() as u64);
        let stride = work.div_ceil(most_px.max(1)).max(1) as usize;
        let (mut numbers, mut others, mut timed) = (Vec::new(), Vec::new(), 0);
        for (number, covered) in pixels.iter().enumerate() {
            if number.is_multiple_of(stride) {
                numbers.push(number);
                timed += covered;
            } else {
                others.push(number);
            }
        }
        // The largest of the others are added until half of what was meant is covered.
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

    /// All pixels are judged.
    fn sampling(&self) -> Sampling {
        let (items, pixels) = (self.pieces, self.pixels);
        Sampling { items, pixels, judged: Part::all(pixels.of), looked_at: None, not_judged: 0 }
    }

    /// The timed ones of the pieces that the sample was taken of.
    fn of<'a>(&self, pieces: &'a [Piece]) -> impl Iterator<Item = &'a Piece> {
        self.numbers.iter().map(|&number| &pieces[number])
    }
}

/// Pairs of triangles that occur more than once become one, with the sum of their counts.
fn merge(wrong: &mut Vec<([u32; 2], u64)>) {
    wrong.sort_unstable();
    wrong.dedup_by(|later, kept| {
        let is_same = later.0 == kept.0;
        kept.1 += if is_same { later.1 } else { 0 };
        is_same
    });
}

/// Whether the choices of interpolation, some of which are in single precision, take the values of a piece.
fn has_values(piece: &Piece) -> bool {
    for vertex in &piece.triangle.vertices {
        if check_value(vertex.varying.x).is_err() {
            return false;
        }
    }
    // A w whose inverse is too small or too large for f32 leaves nothing to divide by.
    for w in piece.w {
        let inv_w = (1.0 / w) as f32;
        if !inv_w.is_finite() || inv_w <= 0.0 {
            return false;
        }
    }
    true
}

/// Pieces as a class of scenes, and the triangle of the model of each.
fn class<'a>(pieces: impl IntoIterator<Item = &'a Piece>, window: PixelRect) -> (Class, Vec<u32>) {
    let mut class = Class {
        name: "model",
        about: "the triangles of the model",
        bounds: window,
        triangles: Vec::new(),
        w: Vec::new(),
        values: Vec::new(),
        interior: None,
    };
    // The place of a face in this list is the number of its triangle in the class.
    let mut faces = Vec::new();
    for piece in pieces {
        // Beyond the domain of the engines a piece is left out.
        let Some(corners) = piece.free() else { continue };
        class.triangles.push(corners);
        class.w.push(piece.w);
        class.values.push(piece.triangle.vertices.map_array(|vertex| vertex.varying.x));
        faces.push(piece.face);
    }
    // Without texture coordinates values are made up.
    if class.values.iter().flatten().all(|value| *value == 0.0) {
        class.values.clear();
    }
    (class, faces)
}

/// Puts triangles of a model in place of those of a class.
fn rename(found: &mut Details, faces: &[u32]) {
    if let Some((Some(first), _)) = &mut found.first {
        *first = faces[*first as usize];
    }
    for number in found.wrong.iter_mut().flat_map(|(pair, _)| pair) {
        *number = faces[*number as usize];
    }
    // Pieces of one triangle that were wrong each for itself are now one pair.
    merge(&mut found.wrong);
}

/// Pieces whose coverage is judged at once.
const CHUNK: usize = 256;

/// Both groups of coverage: all pieces against the oracle, as they are and snapped; times of a sample, in the same rounds.
fn coverage_boards(sampled: &Sampled, sample: &Sample, timing: Timing) -> Vec<Board> {
    let window = sampled.window;
    // Pieces are judged in chunks on all threads, before anything is timed.
    let chunks: Vec<&[Piece]> =
        sampled.planes.iter().flat_map(|plane| plane.chunks(CHUNK)).collect();
    let (plural, unit) = (sampled.counted(), sampled.unit());
    let measures =
        [("as they are", "as given"), ("snapped", "snapped")].map_array(|(corners, short)| {
            let title = format!("wrong {plural}, corners {corners}");
            Measure::new(title, format!("{unit} {short}"), Some(0.0)).counts(unit)
        });
    let to_time = coverage::Input::new(class(sample.of(&sampled.planes[0]), window).0);
    // Both groups are one job, so their times are taken in the same rounds.
    let mut groups = Vec::new();
    for ladder in [Ladder::Scanline, Ladder::EdgeFunction] {
        // Of each chunk what each choice of the group gets wrong.
        let of_chunks =
            parallel::map(chunks.len(), |number| judged(ladder, chunks[number], window));
        let cell = |(number, entry): (usize, &Entry<coverage::Input>)| {
            let mut found = sum_of_chunks(&of_chunks, number, sampled)?;
            found.bytes = Some(bytes(&entry.choice, window, sample.pieces.part));
            // Only where a choice computes E in floats without more ado does the bound of its error say how close it was.
            let unit = match (ladder, &*entry.choice.name) {
                (Ladder::EdgeFunction, "f32 direct") => Some(f64::from(f32::EPSILON) / 2.0),
                (Ladder::EdgeFunction, "f64 direct") => Some(f64::EPSILON / 2.0),
                _ => None,
            };
            found.margin = unit.map(|unit| margin(&chunks, window, unit));
            let errors = found.pixels.map(|pixels| Some(pixels as f64)).to_vec();
            Ok((Run { errors, found, ..Run::default() }, Some(entry.pass(&to_time)?)))
        };
        groups.push(group(ladder, &measures, coverage::choices(ladder), cell));
    }
    boards(groups, sample.sampling(), timing)
}

/// What one choice gets wrong of all chunks, whose pieces are judged as samples and told as pixels of the picture.
fn sum_of_chunks(
    of_chunks: &[Vec<Result<Run, String>>],
    choice: usize,
    sampled: &Sampled,
) -> Result<Details, String> {
    // The first wrong sample of the first chunk that has one is the first of all.
    let mut sum = Details::default();
    for chunk in of_chunks {
        let Details { pixels, first, wrong, .. } = &chunk[choice].as_ref()?.found;
        sum.pixels = [sum.pixels[0] + pixels[0], sum.pixels[1] + pixels[1]];
        sum.first = sum.first.or(first.map(|(of, sample)| (of, sampled.pixel(sample))));
        sum.wrong.extend(wrong);
    }
    merge(&mut sum.wrong);
    Ok(sum)
}

/// What each choice of a group gets wrong of some pieces.
fn judged(ladder: Ladder, pieces: &[Piece], window: PixelRect) -> Vec<Result<Run, String>> {
    let (class, faces) = class(pieces, window);
    let input = coverage::Input::new(class);
    let judge = |entry: Entry<coverage::Input>| {
        let mut run = entry.judge(&input)?;
        rename(&mut run.found, &faces);
        Ok(run)
    };
    coverage::choices(ladder).into_iter().map(judge).collect()
}

/// The smallest |E| over the bound of its error in floats of unit roundoff `u`, at the samples that it decides.
///
/// E = dx (py - ay) - dy (px - ax), the corners rounded first. A difference of coordinates is off by at most
/// u (|a| + |b|) for the corners and u times itself, a product by its factors' errors and u times itself, and E by
/// the errors of both products and u times itself. A sample is decided by the edge that is farthest outside of it, or,
/// inside, by the nearest of all.
fn margin(chunks: &[&[Piece]], window: PixelRect, u: f64) -> f64 {
    let of_chunks = parallel::map(chunks.len(), |number| {
        let mut smallest = f64::INFINITY;
        for piece in chunks[number] {
            smallest = smallest.min(margin_of(piece.px, window, u));
        }
        smallest
    });
    of_chunks.into_iter().fold(f64::INFINITY, f64::min)
}

/// E at a point p for the edge from a to b, and the bound of its error that [`margin`] derives.
fn edge_function([a, b]: [[f64; 2]; 2], p: [f64; 2], u: f64) -> (f64, f64) {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let (qx, qy) = (p[0] - a[0], p[1] - a[1]);
    // What a difference of two corners is off by, and one of a point and a corner: a point is a centre, which floats hold exactly.
    let of_dx = u * (a[0].abs() + b[0].abs() + dx.abs());
    let of_dy = u * (a[1].abs() + b[1].abs() + dy.abs());
    let (of_qx, of_qy) = (u * (a[0].abs() + qx.abs()), u * (a[1].abs() + qy.abs()));
    let products = dx.abs() * of_qy + qy.abs() * of_dx + dy.abs() * of_qx + qx.abs() * of_dy;
    let (p, q) = (dx * qy, dy * qx);
    let bound = products + u * (p.abs() + q.abs() + (p - q).abs());
    // For products of errors.
    ((p - q), bound * 1.001)
}

/// The pixels from half a pixel before three corners to half a pixel behind them on one axis, within a window.
fn pixels_around(corners: [f64; 3], low: i32, high: i32) -> std::ops::Range<i32> {
    let [a, b, c] = corners;
    let (least, most) = (a.min(b).min(c), a.max(b).max(c));
    let first = (least - 0.5).floor().max(f64::from(low)) as i32;
    let end = (most + 0.5).ceil().min(f64::from(high)) as i32;
    first..end
}

/// The same of one triangle.
fn margin_of(px: [[f64; 2]; 3], window: PixelRect, u: f64) -> f64 {
    let [a, b, c] = px;
    let edges = [[b, c], [c, a], [a, b]];
    let (area, _) = edge_function([a, b], c, u);
    // E is positive inside where the corners run one way, and negative where they run the other.
    let sign = if area < 0.0 { -1.0 } else { 1.0 };
    let mut smallest = f64::INFINITY;
    for y in pixels_around(px.map_array(|corner| corner[1]), window.y0, window.y1) {
        for x in pixels_around(px.map_array(|corner| corner[0]), window.x0, window.x1) {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let mut inside = f64::INFINITY;
            let mut outside: Option<f64> = None;
            for edge in edges {
                let (value, bound) = edge_function(edge, p, u);
                let margin = value.abs() / bound;
                if value * sign > 0.0 {
                    inside = inside.min(margin);
                } else {
                    outside = Some(outside.unwrap_or(0.0).max(margin));
                }
            }
            // One edge that the point is outside of suffices, so the clearest of these decides.
            smallest = smallest.min(outside.unwrap_or(inside));
        }
    }
    smallest
}

/// Choices of interpolation: errors at samples of all pieces, and at more samples of those that are hard cases; times of a sample.
fn interpolation_board(
    (pieces, window): (&[Piece], PixelRect),
    hard: &HardCases,
    timing: Timing,
) -> Vec<Board> {
    use interpolation::{HALF_STEP, SAMPLES, choices, input};
    // Every choice is judged by the same pieces, which all of them can draw.
    let taken: Vec<Piece> = pieces.iter().filter(|piece| has_values(piece)).cloned().collect();
    // Three inputs of the same choices: one to judge, one to time, and one of hard cases to judge closely.
    let sample = Sample::new(&taken, window, TIMED_PX / 4);
    let judged = input(&class(&taken, window).0, SAMPLES);
    let to_time = input(&class(sample.of(&taken), window).0, 0);
    let are_hard = taken.iter().filter(|piece| hard.is_hard(piece.face));
    let (class_of_hard, faces) = class(are_hard, window);
    let on_hard = (!faces.is_empty()).then(|| input(&class_of_hard, 4 * SAMPLES));
    let cell = |(_, entry): (usize, &Entry<interpolation::Input>)| {
        let mut run = entry.judge(&judged)?;
        run.errors.truncate(1);
        run.found = Details::default();
        run.found.bytes = Some(bytes(&entry.choice, window, 0));
        if let Some(on_hard) = &on_hard {
            let mut of_hard = entry.judge(on_hard)?;
            rename(&mut of_hard.found, &faces);
            run.found.wrong = of_hard.found.wrong;
            // What is wrong on hard cases is wrong of the model, whatever its other pixels show.
            run.errors[0] = of_hard.errors[0].into_iter().chain(run.errors[0]).reduce(f64::max);
        }
        Ok((run, Some(entry.pass(&to_time)?)))
    };
    // Times are of a sample of the pieces, errors of all that have values.
    let sampling = Sampling {
        judged: judged.judged(),
        looked_at: on_hard.as_ref().map(interpolation::Input::judged),
        not_judged: (pieces.len() - taken.len()) as u64,
        ..sample.sampling()
    };
    let title = "worst error over the largest value; up to half a step of 8 bits is good";
    let measure = Measure::new(title, "error / M", Some(HALF_STEP));
    boards([group(Ladder::Interpolation, &[measure], choices(), cell)], sampling, timing)
}

/// Choices of antialiasing: errors of all pieces, times of a sample.
fn antialiasing_board((pieces, window): (&[Piece], PixelRect), timing: Timing) -> Vec<Board> {
    let sample = Sample::new(pieces, window, TIMED_PX / 4);
    let judged = antialiasing::Input::new(&class(pieces, window).0);
    let to_time = antialiasing::Input::new(&class(sample.of(pieces), window).0);
    let cell = |(_, entry): (usize, &Entry<antialiasing::Input>)| {
        let mut run = entry.judge(&judged)?;
        run.found.bytes = Some(bytes(&entry.choice, window, 0));
        Ok((run, Some(entry.pass(&to_time)?)))
    };
    let title = "root mean square distance from the exact share of a pixel on an edge";
    let measure = Measure::new(title, "rms of a px", Some(0.0));
    let group = group(Ladder::Antialiasing, &[measure], antialiasing::choices(), cell);
    boards([group], sample.sampling(), timing)
}

/// Formats of the depth buffer: pixels that show another piece than the exact depths say.
fn depth(sampled: &Sampled, sample: &Sample, timing: Timing) -> Vec<Board> {
    // What exact depths show is the same for all formats.
    let planes = &sampled.planes;
    let truths = parallel::map(planes.len(), |plane| exactly_seen(&planes[plane], sampled.window));
    let (mut choices, mut cells) = (Vec::new(), Vec::new());
    for format in DepthFormat::ALL {
        let choice = depth_choice(format, planes.len());
        let mut found = wrongly_seen(sampled, &truths, format);
        found.bytes = Some(bytes(&choice, sampled.window, 0));
        let errors = vec![Some(found.wrong.len() as f64)];
        // Until here each pair stands for one pixel.
        merge(&mut found.wrong);
        let pass = Pass::new(move || {
            let mut timed = sample.numbers.iter().copied();
            std::hint::black_box(seen(&planes[0], sampled.window, format, &mut timed));
        });
        choices.push(choice);
        cells.push(Ok((Run { errors, found, ..Run::default() }, Some(pass))));
    }
    let (plural, unit) = (sampled.counted(), sampled.unit());
    let title = format!("{plural} that show another piece than exact depths do");
    let measures = vec![Measure::new(title, format!("wrong {unit}"), Some(0.0)).counts(unit)];
    let board = Board::new(Ladder::Depth, 0, measures, choices);
    boards([(board, cells)], sample.sampling(), timing)
}

/// A format of the depth buffer as a choice, for so many samples in each pixel.
fn depth_choice(format: DepthFormat, samples: usize) -> Choice {
    let (about, of_depth) = match format {
        DepthFormat::Unorm32 => ("2^32 equal steps", size_of::<u32>()),
        DepthFormat::Unorm24 => ("2^24 equal steps, as most hardware", size_of::<u32>()),
        DepthFormat::F32 => ("a float, 0 at the near plane", size_of::<f32>()),
        DepthFormat::F32Reversed => ("a float, 1 at the near plane", size_of::<f32>()),
        DepthFormat::F64 => ("a double", size_of::<f64>()),
    };
    // A depth as the format has it, and the number of a piece.
    let of_pixel = (of_depth + size_of::<u32>()) * samples;
    Choice::new(format.name(), about, &[]).holding(of_pixel, 0)
}

/// The samples at which a format shows another piece than exact depths do, a pair for each.
fn wrongly_seen(sampled: &Sampled, truths: &[Frame<u32>], format: DepthFormat) -> Details {
    let window = sampled.window;
    // Samples of all planes are counted; a pixel may have several.
    let mut found = Details::default();
    for (pieces, truth) in sampled.planes.iter().zip(truths) {
        let face = |number: u32| pieces.get(number as usize).map(|piece| piece.face);
        let seen = seen(pieces, window, format, &mut (0..pieces.len()));
        for (y, row) in seen.rows() {
            for (x, (&seen, &exact)) in (window.x0..).zip(row.iter().zip(truth.row(y))) {
                if seen == exact {
                    continue;
                }
                // Where one of them is none, the pair is twice the other.
                let (seen, exact) = (face(seen), face(exact));
                let pixel = sampled.pixel([x, y]);
                found.first = found.first.or(Some((exact.or(seen), pixel)));
                if let (Some(exact), Some(seen)) = (exact.or(seen), seen.or(exact)) {
                    found.wrong.push(([exact, seen], 1));
                }
            }
        }
    }
    found
}

/// Which piece is nearest at each pixel by exact depths of the snapped pieces; of equal ones the first.
pub fn exactly_seen(pieces: &[Piece], window: PixelRect) -> Frame<u32> {
    // For each pixel the depth of the piece that is the nearest so far, by how much it may be off, and which piece it is.
    let mut nearest = Frame::new(window, f64::INFINITY);
    let mut error = Frame::new(window, 0.0);
    let mut seen = Frame::new(window, NOTHING);
    for (number, piece) in pieces.iter().enumerate() {
        // The depths of the engine, which are within this bound of the exact ones.
        let depths = piece.triangle.vertices.map_array(|vertex| vertex.depth);
        let bound = SCANLINE.depth.at(depths);
        Scanline.runs(&piece.depth_only(), window, true, &mut |run| {
            for (x, &depth) in (run.x0_px..).zip(run.depths) {
                let [old, error_of_old] =
                    [&nearest, &error].map(|frame| frame.get(x, run.y_px).unwrap_or(f64::INFINITY));
                let reach = bound + error_of_old;
                let before = seen.get(x, run.y_px).unwrap_or(NOTHING);
                // Two depths that are farther apart than both bounds are told apart by floats, any others exactly.
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

/// Whether a piece is nearer than another one at a pixel, exactly. One without area has no depth there, so it is nearer than nothing.
fn is_nearer(piece: &Piece, other: &Piece, x_px: i32, y_px: i32) -> bool {
    let [a, b] = [piece, other].map_array(|piece| {
        let depths = piece.triangle.vertices.map_array(|vertex| vertex.depth);
        let exact = ExactTriangle::new(&piece.corners(), depths, [1.0; 3], [[0.0; 0]; 3]);
        exact.map(|exact| exact.at(x_px, y_px).0)
    });
    a.zip(b).is_some_and(|(a, b)| a < b)
}

/// Whole frames: each rasterizer by each planner, and tiles, against the one with everything switched on.
fn planners(scene: &Scene, target: &mut Target, timing: Timing) -> Result<Vec<Board>, BadScene> {
    let (size, antialias) = (target.size(), target.antialias());
    let target = RefCell::new(target);
    // The first frame of the first rasterizer, by which all others are judged.
    let mut first: Option<Frame<Colour>> = None;
    let (mut choices, mut cells): (Vec<Choice>, Vec<PreparedCell<'_>>) = Default::default();
    for drawer in Drawer::ALL {
        for (name, effects, about) in PLANS {
            let rendered = drawer.render(scene, &effects, &mut target.borrow_mut())?;
            let bytes = memory_of_frame(&rendered, scene, &target.borrow());
            let choice = Choice::new(format!("{} {name}", drawer.name()), about, &[]);
            let first = first.get_or_insert_with(|| rendered.picture.clone());
            let run = judged_frame(&rendered.picture, first, Some(bytes));
            choices.push(choice);
            cells.push(Ok((run, Some(frame_pass((scene, drawer), effects, &target)))));
        }
    }
    // Tiles have their own samples: with none that are the target's they are left out.
    let samples = match antialias {
        Antialias::None => Some(frames::Samples::One),
        Antialias::Multisample4 => Some(frames::Samples::Four),
        Antialias::Supersample(_) => None,
    };
    let (width, height) = (size.width(), size.height());
    // What tiles would draw otherwise, or not alone, is no choice.
    let is_the_same = frames::beyond_f32(scene, width, height)? == 0;
    if let (Some(samples), Some(first), true) = (samples, &first, is_the_same) {
        match frames::render(scene, width, height, samples) {
            Ok(picture) => {
                let about = "coverage exact, values in f32; the time of all its threads together";
                let pass = Pass::new(move || {
                    std::hint::black_box(frames::render(scene, width, height, samples).is_ok());
                });
                choices.push(Choice::new("tiles", about, &[]));
                let run = judged_frame(&picture, first, None);
                cells.push(Ok((run, Some(pass.by(Clock::Threads)))));
            }
            Err(TilesError::NotDrawn(_)) => {}
            Err(TilesError::Scene(bad)) => return Err(bad),
        }
    }
    let title = "pixels that differ from the frame of scanline with everything switched on";
    let measures = vec![Measure::new(title, "wrong px", Some(0.0))];
    let (pixels, items) = (Part::all(pixels(size)), Part::all(scene.triangles() as u64));
    let sampling = Sampling { items, pixels, judged: pixels, looked_at: None, not_judged: 0 };
    let board = Board::new(Ladder::Frames, 0, measures, choices);
    Ok(boards([(board, cells)], sampling, timing))
}

/// In how many pixels a picture differs from the one by which all are judged, and the first of them.
fn judged_frame(picture: &Frame<Colour>, truth: &Frame<Colour>, bytes: Option<u64>) -> Run {
    let wrong: Vec<_> = differing(picture, truth, 0).collect();
    let first = wrong.first().map(|&(x, y)| (None, [x, y]));
    let found = Details { first, bytes, ..Details::default() };
    Run { errors: vec![Some(wrong.len() as f64)], found, ..Run::default() }
}

/// The most memory of a frame, from the sizes of what it holds: colour and key of each sample, the picture and a copy of it
/// where there is a second buffer, what is noted for each pixel while samples are told apart, positions in clip space, and
/// pieces where all of them are listed.
fn memory_of_frame(rendered: &Rendered, scene: &Scene, target: &Target) -> u64 {
    let plan = &rendered.plan;
    let of_colour = size_of::<Colour>();
    let (size, antialias) = (target.size(), target.antialias());
    let samples = match plan.frame.samples {
        Samples::Middle => 1,
        Samples::Each | Samples::OnDemand { .. } => antialias.samples(),
    };
    let pictures = if plan.frame.second_buffer { 2 } else { 1 };
    let shading = match antialias {
        Antialias::Multisample4 => size_of::<(u64, Colour)>() + size_of::<u8>(),
        Antialias::None | Antialias::Supersample(_) => 0,
    };
    let on_demand = match plan.frame.samples {
        Samples::OnDemand { .. } => of_colour + size_of::<[u64; 2]>(),
        Samples::Each | Samples::Middle => 0,
    };
    let of_pixel = samples as usize * (of_colour + size_of::<u64>())
        + pictures * of_colour
        + shading
        + on_demand;
    // What does not depend on the size of the picture.
    let positions: usize = scene.items.iter().map(|item| item.mesh.positions.len()).sum();
    let is_listed = plan.items.iter().any(|item| matches!(item.pieces, Pieces::Listed(_)));
    let listed = if is_listed { scene.triangles() } else { 0 };
    let of_piece =
        size_of::<(usize, ScreenTriangle<Attributes<PLACED>>)>() + size_of::<PiecePlan>();
    let scene = positions * size_of::<ClipPoint>() + listed * of_piece;
    of_pixel as u64 * pixels(size) + scene as u64
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
        let shares = [DVec2::ZERO, DVec2::X, DVec2::Y];
        Piece { face, item: 0, px, w: [1.0; 3], px_error: 0.0, depth_error: 0.0, triangle, shares }
    }

    const WINDOW: PixelRect = PixelRect { x0: 0, y0: 0, x1: 32, y1: 32 };

    /// What choices of a group get wrong of one triangle, by name.
    fn wrong(ladder: Ladder, px: [[f64; 2]; 3]) -> Vec<(String, [u64; 2])> {
        let runs = judged(ladder, &[piece(0, px, [0.5; 3])], WINDOW);
        let named = coverage::choices(ladder).into_iter().zip(runs);
        named
            .map(|(entry, run)| (entry.choice.name.to_string(), run.unwrap().found.pixels))
            .collect()
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
        let is_exact = |judged: u64| {
            let sampling = Sampling {
                judged: Part { part: judged, of: 7 },
                ..Sample::of_sizes(&[7], 9).sampling()
            };
            let run = Run { errors: vec![Some(0.0)], ..Run::default() };
            let measures = vec![Measure::new("", "", Some(0.0))];
            let board = Board::new(Ladder::Depth, 0, measures, vec![Choice::default()]);
            let group = (board, vec![Ok((run, None))]);
            boards([group], sampling, Timing::ONCE)[0].meets(0, 0, 0)
        };
        assert_eq!([is_exact(7), is_exact(0)], [true, false]);
    }

    #[test]
    fn sizes_by_hand() {
        let window = PixelRect::window(10, 10);
        let of = |choices: Vec<Choice>, name: &str| {
            let choice = choices.iter().find(|choice| choice.name == name).unwrap();
            bytes(choice, window, 7)
        };
        let edges = || choices_of(coverage::choices(Ladder::EdgeFunction));
        assert_eq!(of(edges(), "robust"), 400, "32 bits a pixel");
        assert_eq!(of(edges(), "tiles i32 x 16"), 400 + 7 * 24, "three corners of two numbers");
        assert_eq!(of(choices_of(interpolation::choices()), "plane"), 400);
        let of_samples = |name| of(choices_of(antialiasing::choices()), name);
        assert_eq!([of_samples("4x4 supersample"), of_samples("exact area")], [2400, 800]);
    }

    fn choices_of<I>(entries: Vec<Entry<I>>) -> Vec<Choice> {
        entries.into_iter().map(|entry| entry.choice).collect()
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
