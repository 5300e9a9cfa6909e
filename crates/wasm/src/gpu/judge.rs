//! Compares what was read back with what is expected.
//!
//! A pixel that differs is a mark: it is allowed where the interface leaves the pixel open, and outside of what it promises elsewhere. A
//! check is worth the worst of its marks. Of the lattice no subject alone says anything; all together show which one the device has.

use super::expected::{Forgiving, Planes, expected, is_tiling, line_fits, pixels, planes};
use super::place::{Place, RULES, cover, place};
use super::{Batch, Device, Drawing, Interface, Layout, Topic};
use crate::no_answer::NoAnswer;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::DVec2;
use rasterproof_core::geometry::centre_of;
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::single_precision::perspective_bounds;
use rasterproof_verify::oracle::segments::Fit;
use rasterproof_verify::oracle::values::ExactTriangle;
use rasterproof_verify::specification::Standing;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Asks what the pixels of a batch are worth.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Judge {
    pub(super) batch: Batch,
    /// Row by row a character for each pixel and plane: the digit 0 for no hit, and so on in the order of
    /// ASCII. Of values, four f32 for each pixel in base64.
    pub(super) pixels: String,
    /// What came of the batches before.
    tally: Tally,
}

/// What came of the batches of a check.
#[derive(Clone, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Tally {
    subjects: u64,
    shapes: u64,
    pixels: u64,
    /// Subjects that differ as they may, and that break a promise.
    free: u64,
    broken: u64,
    /// Of coverage: subjects that differ and that another rule explains, by rule. Of the lattice: subjects that
    /// a hypothesis explains, by hypothesis. Of lines: those that equal each of three rules.
    explained: Vec<u64>,
    /// Of values: the worst error as a part of its bound.
    worst: f64,
}

/// A pixel that differs: in which plane, where in the cell, what the specification says of it, and of a value by how much.
#[derive(Serialize)]
struct Mark {
    plane: usize,
    x: i32,
    y: i32,
    word: Standing,
    note: String,
}

/// A way to round a position, given in subpixels, to a step.
type Rounding = fn(i32, i32) -> i32;

/// Positions are rounded in one way to a lattice of so many bits below the pixel.
struct Hypothesis {
    bits: u32,
    name: &'static str,
    round: Rounding,
}

/// The ways that are told apart, by their names.
const ROUNDINGS: [(&str, Rounding); 4] = [
    ("half to even", |v, step| nearest(v, step, |below| below % 2 != 0)),
    ("half up", |v, step| nearest(v, step, |_| true)),
    ("half down", |v, step| nearest(v, step, |_| false)),
    ("down", |v, step| v.div_euclid(step) * step),
];
/// Hypotheses have 2 to 8 bits below the pixel.
const BITS: std::ops::RangeInclusive<u32> = 2..=8;
/// Fewer than these break a promise of WebGL, which calls what a device says of itself an estimate.
const LEAST_BITS: u32 = 4;

/// The nearest multiple of a step; halfway between two, whether it is the upper one depends on the number of the lower one.
fn nearest(v: i32, step: i32, up_of_half: fn(i32) -> bool) -> i32 {
    let (below, rest) = (v.div_euclid(step), 2 * v.rem_euclid(step));
    (below + i32::from(rest > step || (rest == step && up_of_half(below)))) * step
}

/// All hypotheses about positions, the coarsest lattice first.
fn hypotheses() -> Vec<Hypothesis> {
    let mut all = Vec::new();
    for bits in BITS {
        for (name, round) in ROUNDINGS {
            all.push(Hypothesis { bits, name, round });
        }
    }
    all
}

impl Judge {
    /// What the pixels of a batch are worth, with the first subject that breaks a promise and the first that differs as it may.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let Batch { check, device, .. } = self.batch;
        let (layout, list) = self.batch.subjects()?;
        // A subject that the page sends need not be a tiling.
        if let (Topic::Tiling, Some(subject)) = (check, &self.batch.only)
            && !is_tiling(subject, layout.cell)
        {
            return Err(
                "the triangles overlap, share no edge, turn differently, or are thin".into()
            );
        }
        let read = Pixels::read(check, device, layout, &self.pixels)?;
        let mut tally = self.tally.clone();
        let (mut broken, mut free) = (None, None);
        let (mut coarse, mut view) = (None, Value::Null);
        for (index, subject) in list.iter().enumerate() {
            let cell = read.cell(index);
            let judged = judged(check, device, subject, &cell);
            judged.add_to(&mut tally, subject);
            // The first of each kind is shown; later ones say nothing more.
            match judged.word() {
                Standing::Outside => broken = broken.or(Some(subject)),
                Standing::Allowed => free = free.or(Some(subject)),
                _ => {}
            }
            if check == Topic::Lattice && judged.fails(check, device) {
                coarse = coarse.or(Some(subject));
            }
            if self.batch.only.is_some() {
                view = judged.view(check, device, subject, &cell);
            }
        }
        let mut word = word(check, device, &tally);
        // One case alone breaks no promise about the lattice: all together do, and this one is why.
        if check == Topic::Lattice {
            broken = coarse.filter(|_| word == Standing::Outside);
            if self.batch.only.is_some() {
                word = if tally.free > 0 { Standing::Allowed } else { Standing::Equal };
            }
        }
        Ok(json!({
            "word": word, "facts": facts(check, &tally),
            "tally": tally, "broken": broken, "free": free, "view": view,
        }))
    }
}

/// The subjects of a picture that fail.
pub(super) fn failing(
    check: Topic,
    device: Device,
    layout: Layout,
    pixels: &str,
    subjects: &[Drawing],
) -> Result<Vec<bool>, NoAnswer> {
    let read = Pixels::read(check, device, layout, pixels)?;
    let mut fail = Vec::new();
    for (index, subject) in subjects.iter().enumerate() {
        fail.push(judged(check, device, subject, &read.cell(index)).fails(check, device));
    }
    Ok(fail)
}

/// What was read back of a picture, row by row from the top.
pub(super) struct Pixels {
    layout: Layout,
    bytes: Vec<u8>,
    /// Bytes of a pixel.
    size: usize,
}

impl Pixels {
    /// Decodes what the page sends; a picture of another size than the layout's is refused.
    pub(super) fn read(
        check: Topic,
        device: Device,
        layout: Layout,
        pixels: &str,
    ) -> Result<Self, NoAnswer> {
        let values = check == Topic::Values;
        // Digits are shorter than numbers and need no decoder; values are too many bits for a digit.
        let bytes = match values {
            true => STANDARD.decode(pixels).map_err(|error| error.to_string())?,
            false => pixels.bytes().map(|b| b.wrapping_sub(b'0')).collect(),
        };
        let size = if values { 16 } else { planes(check, device) };
        if bytes.len() != (layout.side * layout.side) as usize * size {
            let side = layout.side;
            return Err(format!("{} bytes of pixels for {side} x {side} px", bytes.len()).into());
        }
        Ok(Self { layout, bytes, size })
    }

    /// What was read of the subject with this number.
    pub(super) fn cell(&self, index: usize) -> Cell<'_> {
        let Self { layout, ref bytes, size } = *self;
        Cell { layout, origin: layout.origin(index), bytes, size }
    }
}

/// The part of a picture in which one subject was drawn.
pub(super) struct Cell<'a> {
    layout: Layout,
    origin: [i32; 2],
    bytes: &'a [u8],
    size: usize,
}

impl Cell<'_> {
    /// The bytes of a row of the cell, as many for each pixel as the picture has.
    pub(super) fn row(&self, y: i32) -> &[u8] {
        let [x0, y0] = self.origin;
        let start = ((y0 + y) * self.layout.side + x0) as usize * self.size;
        &self.bytes[start..start + self.layout.cell as usize * self.size]
    }

    /// The hits of the cell, plane by plane: in the picture the planes of a pixel lie side by side.
    fn planes(&self) -> Planes {
        let mut planes = vec![Vec::new(); self.size];
        for y in 0..self.layout.cell {
            for pixel in self.row(y).chunks_exact(self.size) {
                for (plane, hits) in planes.iter_mut().zip(pixel) {
                    plane.push(*hits);
                }
            }
        }
        planes
    }

    /// Depth, two attributes, and whether anything is drawn.
    fn values(&self, x: i32, y: i32) -> [f64; 4] {
        let pixel = &self.row(y)[x as usize * 16..][..16];
        let mut values = [0.0; 4];
        for (value, bytes) in values.iter_mut().zip(pixel.as_chunks().0) {
            *value = f64::from(f32::from_le_bytes(*bytes));
        }
        values
    }
}

/// What came of one subject: what was expected, what was drawn, and the pixels in which they differ.
#[derive(Default)]
struct PictureJudgement {
    ours: Planes,
    theirs: Planes,
    marks: Vec<Mark>,
    pixels: u64,
    explained: Vec<bool>,
    worst: f64,
}

/// Compares what was read of a subject with what is expected of it.
fn judged(check: Topic, device: Device, subject: &Drawing, cell: &Cell) -> PictureJudgement {
    let side = cell.layout.cell;
    if check == Topic::Values {
        return values(device, subject, cell);
    }
    let (mut ours, mut theirs) = (expected(check, device, subject, side), cell.planes());
    // The first drawing is what the second is judged by.
    if check == Topic::Twice {
        ours = vec![theirs.remove(0)];
    }
    // The marks say how each pixel that differs stands to the interface.
    let mut marks = Vec::new();
    if ours != theirs {
        let forgiving = Forgiving::new(check, device, subject);
        for (plane, (ours, theirs)) in ours.iter().zip(&theirs).enumerate() {
            for (at, (right, hits)) in (0..).zip(ours.iter().zip(theirs)) {
                if right != hits {
                    let (x, y) = (at % side, at / side);
                    let word = forgiving.word(plane, x, y, *hits);
                    marks.push(Mark { plane, x, y, word, note: String::new() });
                }
            }
        }
    }
    let pixels = (side * side) as u64 * ours.len() as u64;
    let mut judged =
        PictureJudgement { ours, theirs, marks, pixels, ..PictureJudgement::default() };
    match check {
        Topic::Lattice => judged.explained = explaining(subject, &judged.theirs[0], side),
        Topic::Coverage | Topic::Reach if judged.word() == Standing::Allowed => {
            // Another rule for samples on edges may be what the device has.
            for rule in &RULES[1..] {
                let mut hits = vec![0; (side * side) as usize];
                for corners in subject.corners() {
                    cover(&corners, *rule, [0, 0], side, &mut hits);
                }
                judged.explained.push(hits == judged.theirs[0]);
            }
        }
        Topic::Lines => lines(device, subject, side, &mut judged),
        _ => {}
    }
    judged
}

/// Which hypotheses about positions explain the pixels of a subject, whatever the rule for samples on edges.
fn explaining(subject: &Drawing, hits: &[u8], side: i32) -> Vec<bool> {
    let corners = subject.corners();
    let mut explained = Vec::new();
    for Hypothesis { bits, round, .. } in hypotheses() {
        let step = SUBPIXELS >> bits;
        let mut all = true;
        for corners in &corners {
            let snapped = corners.map(|p| SubpixelPoint::new(round(p.x, step), round(p.y, step)));
            all = all && has_pixels(&snapped, hits, side);
        }
        explained.push(all);
    }
    explained
}

/// Whether a triangle may have these hits and no others, whatever the rule for samples on edges.
fn has_pixels(corners: &Corners, hits: &[u8], side: i32) -> bool {
    // Hits are counted in the box around the corners.
    let columns = pixels_of(corners.map(|p| p.x), side);
    let mut inside = 0;
    for y in pixels_of(corners.map(|p| p.y), side) {
        for x in columns.clone() {
            let hits = hits[(y * side + x) as usize];
            inside += u32::from(hits);
            let is_possible = match place(corners, centre_of(x, y)) {
                Place::Inside => hits == 1,
                Place::Edge => hits <= 1,
                Place::Outside => hits == 0,
            };
            if !is_possible {
                return false;
            }
        }
    }
    // Outside of the box around the corners nothing may be hit, so all hits are inside.
    inside == hits.iter().map(|hits| u32::from(*hits)).sum::<u32>()
}

/// The columns or rows of a cell from the smallest to the largest of three coordinates.
fn pixels_of([a, b, c]: [i32; 3], side: i32) -> std::ops::Range<i32> {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c).max(0));
    (low / SUBPIXELS).max(0)..(high / SUBPIXELS + 1).min(side)
}

/// Whether only lattices that are too coarse for WebGL explain a case.
fn is_coarse(explained: &[bool]) -> bool {
    let mut finest = None;
    for (hypothesis, explains) in hypotheses().iter().zip(explained) {
        if *explains {
            finest = finest.max(Some(hypothesis.bits));
        }
    }
    finest.is_some_and(|bits| bits < LEAST_BITS)
}

/// What the specification asks of lines: WebGL the diamond-exit rule, give or take a pixel; WebGPU nothing.
fn lines(device: Device, subject: &Drawing, side: i32, judged: &mut PictureJudgement) {
    let Some(ends) = subject.ends().first().copied() else { return };
    let hits = &judged.theirs[0];
    let lit = pixels(side).zip(hits).filter(|(_, hits)| **hits > 0).map(|(px, _)| px).collect();
    let fits = line_fits(device, &ends, &lit, side);
    judged.explained = fits.iter().map(|fit| *fit == Fit::Equal).collect();
    // A pixel that is set twice is set by no rule.
    let broken = device.interface == Interface::Webgl2
        && (fits[0] == Fit::Outside || hits.iter().any(|hits| *hits > 1));
    // The rule is about all pixels of a line together, so all of its marks are alike.
    for mark in &mut judged.marks {
        mark.word = if broken { Standing::Outside } else { Standing::Allowed };
    }
}

/// Depth and attributes in perspective against exact ones.
fn values(device: Device, subject: &Drawing, cell: &Cell) -> PictureJudgement {
    let side = cell.layout.cell;
    // Without an exact triangle nothing is expected and nothing compared.
    let empty = vec![vec![0; (side * side) as usize]];
    let mut judged =
        PictureJudgement { ours: empty.clone(), theirs: empty, ..PictureJudgement::default() };
    let triangles = subject.triangles();
    let Some(triangle) = triangles.first() else { return judged };
    let v = &triangle.vertices;
    let attributes = v.map(|v| v.varying.to_array());
    let exact =
        ExactTriangle::new(&triangle.corners(), v.map(|v| v.depth), v.map(|v| v.inv_w), attributes);
    let Some(exact) = exact else { return judged };
    let step = f64::from(device.step()) / f64::from(SUBPIXELS);
    for (at, (x, y)) in pixels(side).enumerate() {
        let drawn = cell.values(x, y);
        judged.theirs[0][at] = u8::from(drawn[3] != 0.0);
        // On an edge the pixel itself is open, and so are its values.
        if place(&triangle.corners(), centre_of(x, y)) != Place::Inside {
            continue;
        }
        judged.ours[0][at] = 1;
        // Every fifth pixel is enough, since exact values take most of the time.
        if drawn[3] == 0.0 || (x + y) % 5 != 0 {
            continue;
        }
        let (depth, [a, b]) = exact.at(x, y);
        let bounds = perspective_bounds(triangle, (x, y), f64::from(cell.layout.side));
        let spread = spread(triangle, (x, y), step);
        let names = ["depth", "first attribute", "second attribute"];
        for (i, exact) in [depth, a, b].iter().enumerate() {
            let (error, bound) = (exact.distance(drawn[i]), bounds[i]);
            judged.pixels += 1;
            // The distance from what is no number is infinite.
            if error > bound {
                let word =
                    if error <= bound + spread[i] { Standing::Allowed } else { Standing::Outside };
                let note = format!("{}: exact {}, drawn {}", names[i], exact.to_f64(), drawn[i]);
                judged.marks.push(Mark { plane: 0, x, y, word, note });
            }
            // How near the worst value came to its bound is shown also where all of them keep it.
            if error.is_finite() && bound > 0.0 {
                judged.worst = judged.worst.max(error / bound);
            }
        }
    }
    judged
}

/// How much depth and attributes change within a step of the lattice around a pixel's centre: an interface
/// promises positions no more exactly. A quotient of linear functions is largest and smallest at corners.
fn spread(triangle: &Triangle, (x, y): (i32, i32), step: f64) -> [f64; 3] {
    let centre = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
    let middle = values_at(triangle, centre);
    let mut most = [0.0_f64; 3];
    for (dx, dy) in [(-step, -step), (step, -step), (-step, step), (step, step)] {
        let corner = values_at(triangle, DVec2::new(centre.x + dx, centre.y + dy));
        for i in 0..3 {
            most[i] = most[i].max((corner[i] - middle[i]).abs());
        }
    }
    most
}

/// Depth and two attributes of a triangle's plane at a place, in f64.
fn values_at(triangle: &Triangle, s: DVec2) -> [f64; 3] {
    let v = &triangle.vertices;
    // The weight of a corner is the area opposite to it as a share of the whole one.
    let px = triangle.corners().map(|p| DVec2::from(p.to_px()));
    let cross = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let area = cross(px[0], px[1], px[2]);
    let weights = [0, 1, 2].map(|i| cross(px[(i + 1) % 3], px[(i + 2) % 3], s) / area);
    let sum = |values: [f64; 3]| weights.iter().zip(values).map(|(w, v)| w * v).sum::<f64>();
    let over_w = |values: [f64; 3]| sum([0, 1, 2].map(|i| values[i] * v[i].inv_w));
    let w = over_w([1.0; 3]);
    // Where w vanishes within the step nothing bounds the value.
    let quotient = |values| if w > 0.0 { over_w(values) / w } else { f64::INFINITY };
    let (a, b) = (v.map(|v| v.varying.x), v.map(|v| v.varying.y));
    [sum(v.map(|v| v.depth)), quotient(a), quotient(b)]
}

impl PictureJudgement {
    /// The worst of its marks.
    fn word(&self) -> Standing {
        self.marks.iter().map(|mark| mark.word).max().unwrap_or(Standing::Equal)
    }

    /// Whether it breaks a promise, or, of the lattice, would break one if all others were like it.
    fn fails(&self, check: Topic, device: Device) -> bool {
        match check {
            Topic::Lattice => device.interface == Interface::Webgl2 && is_coarse(&self.explained),
            _ => self.word() == Standing::Outside,
        }
    }

    /// Counts it among the subjects of the check.
    fn add_to(&self, tally: &mut Tally, Drawing(shapes): &Drawing) {
        tally.subjects += 1;
        tally.shapes += shapes.len() as u64;
        tally.pixels += self.pixels;
        tally.free += u64::from(self.word() == Standing::Allowed);
        tally.broken += u64::from(self.word() == Standing::Outside);
        // Checks have as many hypotheses as they have, so the first subject says how many there are.
        tally.explained.resize(tally.explained.len().max(self.explained.len()), 0);
        for (sum, explains) in tally.explained.iter_mut().zip(&self.explained) {
            *sum += u64::from(*explains);
        }
        tally.worst = tally.worst.max(self.worst);
    }

    /// The subject for the page to draw large.
    fn view(&self, check: Topic, device: Device, subject: &Drawing, cell: &Cell) -> Value {
        let mut outlines: Vec<Vec<[f64; 2]>> = Vec::new();
        for shape in &subject.0 {
            // A triangle behind the eye has no outline.
            if shape.iter().all(|v| v[3] > 0.0) {
                outlines.push(shape.iter().map(|v| [v[0] / v[3], v[1] / v[3]]).collect());
            }
        }
        // Only where samples are read one by one does it matter where they lie.
        let samples = match check {
            Topic::Samples if device.samples_apart => super::expected::SAMPLES.to_vec(),
            _ => Vec::new(),
        };
        json!({
            "cell": cell.layout.cell, "origin": cell.origin, "ours": digits(&self.ours), "theirs": digits(&self.theirs),
            "marks": self.marks, "outlines": outlines, "samples": samples, "subject": subject,
        })
    }
}

/// Hits as a digit for each pixel, as the page sends them.
fn digits(planes: &Planes) -> Vec<String> {
    let mut lines = Vec::new();
    for plane in planes {
        // Of 64 triangles before each other, those from the tenth on have letters.
        lines
            .push(plane.iter().filter_map(|n| char::from_digit((*n).min(35).into(), 36)).collect());
    }
    lines
}

/// What positions are rounded to, and how many subjects that explains.
#[derive(Default)]
struct RoundedPositions {
    explained: u64,
    bits: u32,
    rounding: &'static str,
}

/// The hypothesis about positions that explains most; the first of those that explain as much.
fn best_hypothesis(tally: &Tally) -> RoundedPositions {
    let mut best: Option<RoundedPositions> = None;
    for (Hypothesis { bits, name, .. }, &explained) in hypotheses().iter().zip(&tally.explained) {
        if best.as_ref().is_none_or(|best| explained > best.explained) {
            best = Some(RoundedPositions { explained, bits: *bits, rounding: name });
        }
    }
    best.unwrap_or_default()
}

/// What a check is worth after all of its batches.
fn word(check: Topic, device: Device, tally: &Tally) -> Standing {
    if tally.broken > 0 {
        return Standing::Outside;
    }
    if check == Topic::Lattice {
        let RoundedPositions { explained, bits, rounding } = best_hypothesis(tally);
        // Who rounds down has moved the pixel's centre, which is no lattice.
        let is_known = explained == tally.subjects && rounding != "down";
        // WebGPU says nothing of positions: what is finer than every question is as they are given.
        let wanted = match device.interface {
            Interface::Webgl2 => device.bits.min(*BITS.end()),
            Interface::Webgpu => *BITS.end(),
        };
        return match (is_known, bits >= wanted, device.interface) {
            (true, true, _) => Standing::Equal,
            (true, false, Interface::Webgl2) if bits < LEAST_BITS => Standing::Outside,
            _ => Standing::Allowed,
        };
    }
    if tally.free > 0 { Standing::Allowed } else { Standing::Equal }
}

/// What the page says beside the counts.
fn facts(check: Topic, tally: &Tally) -> Value {
    match check {
        Topic::Lattice => {
            let RoundedPositions { explained, bits, rounding } = best_hypothesis(tally);
            // The finest lattice that explains all subjects, whatever the rounding.
            let mut finest = None;
            for (hypothesis, n) in hypotheses().iter().zip(&tally.explained) {
                if *n == tally.subjects {
                    finest = finest.max(Some(hypothesis.bits));
                }
            }
            json!({ "bits": bits, "rounding": rounding, "explained": explained, "finest": finest })
        }
        Topic::Coverage | Topic::Reach => {
            // The rule, in the order of `RULES`, that explains every subject which differs.
            let names = ["top-right", "bottom-left", "bottom-right"];
            let rule = names.iter().zip(&tally.explained).find(|(_, n)| **n == tally.free);
            json!({ "rule": rule.map(|(name, _)| name) })
        }
        _ => Value::Null,
    }
}

#[cfg(test)]
mod tests {
    use super::super::Vertex;
    use super::super::shrink::{asked, size};
    use super::super::subjects::{PLAN, limits};
    use super::*;
    use rasterproof_verify::cases::{Shape, triangles};
    use serde_json::from_value;

    /// The names of all checks but that of values.
    fn checks() -> Vec<String> {
        let names = PLAN.iter().map(|(check, _)| from_value::<String>(json!(check)).unwrap());
        names.filter(|name| name != "values").collect()
    }

    fn batch(check: &str, interface: &str, more: Value) -> Batch {
        let device = json!({ "interface": interface, "bits": 4, "samples_apart": true });
        let mut question = json!({ "check": check, "device": device, "seed": 1, "number": 0 });
        for (key, value) in more.as_object().unwrap() {
            question[key] = value.clone();
        }
        from_value(question).unwrap()
    }

    /// What a right device draws, with `spoil` changing the hits of each cell.
    fn answer(
        check: &str,
        interface: &str,
        more: Value,
        spoil: &dyn Fn(&Drawing, &mut Planes),
    ) -> Value {
        let batch = batch(check, interface, more);
        let (layout, list) = batch.subjects().unwrap();
        let pixels = drawn(batch.check, batch.device, layout, &list, spoil);
        Judge { batch, pixels, tally: Tally::default() }.answer().unwrap()
    }

    /// The picture of subjects on such a device.
    fn drawn(
        check: Topic,
        device: Device,
        layout: Layout,
        list: &[Drawing],
        spoil: &dyn Fn(&Drawing, &mut Planes),
    ) -> String {
        let size = planes(check, device);
        let mut pixels = vec![b'0'; (layout.side * layout.side) as usize * size];
        for (index, subject) in list.iter().enumerate() {
            let mut hits = expected(check, device, subject, layout.cell);
            spoil(subject, &mut hits);
            let [x0, y0] = layout.origin(index);
            for (plane, hits) in hits.iter().enumerate() {
                for (at, hits) in (0..).zip(hits) {
                    let (x, y) = (x0 + at % layout.cell, y0 + at / layout.cell);
                    pixels[(y * layout.side + x) as usize * size + plane] += hits;
                }
            }
        }
        String::from_utf8(pixels).unwrap()
    }

    /// The hits of each pixel of a picture that a device draws, as digits.
    type Draw<'a> = dyn Fn(Topic, Device, Layout, &[Drawing]) -> String + 'a;

    /// The smallest subject that fails, of a device that draws pictures so, and those that it was reached through.
    fn shrunk(check: &str, subject: Value, draw: &Draw<'_>) -> (Drawing, Vec<Drawing>) {
        let (pixels, tally) = (String::new(), Tally::default());
        let mut question =
            Judge { batch: batch(check, "webgl2", json!({ "only": subject })), pixels, tally };
        let Batch { check, device, .. } = question.batch;
        let mut through = Vec::new();
        loop {
            let reply = question.smaller().unwrap();
            let smallest: Drawing = from_value(reply["smallest"].clone()).unwrap();
            if through.last() != Some(&smallest) {
                through.push(smallest.clone());
            }
            let (layout, list) = asked(check);
            assert_eq!(reply["subjects"], list.len());
            if list.is_empty() {
                return (smallest, through);
            }
            question.batch.only = None;
            question.pixels = draw(check, device, layout, &list);
        }
    }

    #[test]
    #[ignore = "takes seconds; .ci/run runs it"]
    fn what_is_expected_is_as_promised() {
        let checks = checks();
        for (check, interface) in checks.iter().flat_map(|c| [(c, "webgl2"), (c, "webgpu")]) {
            // The last batch is one of a design, where there is one.
            let topic = batch(check, interface, json!({})).check;
            let (_, count) = PLAN.into_iter().find(|(other, _)| *other == topic).unwrap();
            let answer = answer(check, interface, json!({ "number": count - 1 }), &|_, _| {});
            // Positions are expected unrounded, and WebGL says that there are at least four bits.
            assert_eq!(answer["word"], "equal", "{check} {interface} {}", answer["facts"]);
            assert!(answer["tally"]["subjects"].as_u64() > Some(40), "{}", answer["tally"]);
        }
    }

    /// A design has each pair of its facts in its first thousand cases: no batch leaves one out or asks it twice.
    #[test]
    fn designs_are_asked_whole() {
        let subjects = |check: &str, number: u64| {
            batch(check, "webgl2", json!({ "number": number })).subjects().unwrap()
        };
        // The numbers of the batches that a design chooses.
        for (check, numbers, step) in [("coverage", 12..39, 13), ("reach", 10..31, 1)] {
            let family = triangles::FAMILIES.iter().find(|f| f.name == "design").unwrap();
            let limits = limits(batch(check, "webgl2", json!({})).check, 16, 48);
            let mut index = 0;
            for number in numbers.step_by(step) {
                let (layout, list) = subjects(check, number);
                assert_eq!(list.len(), layout.room(), "{check} {number}");
                for subject in list {
                    let Shape::Triangles { list, .. } = family.case_within(1, index, &limits).shape
                    else {
                        panic!("{check} {index}")
                    };
                    let corners: Vec<Corners> = list.iter().map(|t| t.corners()).collect();
                    assert_eq!(subject.corners(), corners, "{check} {index}");
                    index += 1;
                }
            }
            assert!(index >= 1000, "{check} {index}");
        }
        // Every line of the design has two ends in its cell, but for those that are one point.
        let (layout, list) = subjects("lines", 2);
        assert_eq!(list.len(), layout.room());
        let ends: Vec<_> = list.iter().flat_map(Drawing::ends).collect();
        let lengths = |axis: fn(SubpixelPoint) -> i32| {
            let all: std::collections::BTreeSet<i32> =
                ends.iter().map(|[from, to]| axis(*to) - axis(*from)).collect();
            all.len()
        };
        // From -27 to 27 px in each direction.
        assert!(lengths(|p| p.x) > 40 && lengths(|p| p.y) > 40, "{ends:?}");
        let px = |v: i32| v / SUBPIXELS;
        assert!(ends.as_flattened().iter().all(|p| (2..30).contains(&px(p.x.min(p.y)))));
        assert!(ends.as_flattened().iter().all(|p| (2..30).contains(&px(p.x.max(p.y)))));
    }

    /// A device that draws sixteen triangles of a pile at most is met by the design, and shown by seventeen triangles.
    #[test]
    fn a_pile_is_drawn_whole() {
        let sixteen = |subject: &Drawing, planes: &mut Planes| {
            let some = Drawing(subject.0.iter().take(16).cloned().collect());
            let device = batch("depth", "webgl2", json!({})).device;
            *planes = expected(Topic::Depth, device, &some, 32);
        };
        let found = |number: u64| answer("depth", "webgl2", json!({ "number": number }), &sixteen);
        assert_eq!([0, 1].map(|number| found(number)["word"].clone()), ["equal", "outside"]);
        let draw =
            |check, device, layout, list: &[Drawing]| drawn(check, device, layout, list, &sixteen);
        let (Drawing(smallest), _) = shrunk("depth", found(1)["broken"].clone(), &draw);
        assert_eq!(smallest.len(), 17, "{smallest:?}");
    }

    /// Every pixel that is hit is hit once more, or none is: no check calls that free.
    #[test]
    #[ignore = "takes seconds; .ci/run runs it"]
    fn gross_faults_break_promises() {
        for check in &checks() {
            // The first drawing is what the second is held to.
            let first = usize::from(check == "twice");
            let twice = |_: &Drawing, planes: &mut Planes| {
                let hits = planes[first..].iter_mut().flatten().filter(|hits| **hits > 0);
                hits.for_each(|hits| *hits += 7);
            };
            let none = |_: &Drawing, planes: &mut Planes| {
                planes[first..].iter_mut().for_each(|p| p.fill(0));
            };
            assert_eq!(answer(check, "webgl2", json!({}), &twice)["word"], "outside", "{check}");
            let word = answer(check, "webgl2", json!({}), &none)["word"].clone();
            assert_eq!(word, "outside", "{check}");
        }
    }

    /// T2's square in two triangles: a hole on the diagonal that both share breaks a promise of WebGL, and
    /// none of WebGPU; a sample on the border of one alone is free in both.
    #[test]
    fn samples_on_edges_by_hand() {
        let vertex = |x: f64, y: f64| json!([x, y, 0.5, 1.0, 1.0, 0.0]);
        let [a, b, c, d] = [vertex(0.5, 0.5), vertex(5.5, 0.5), vertex(5.5, 5.5), vertex(0.5, 5.5)];
        let only = json!({ "only": [[a, b, c], [a, c, d]] });
        let word = |interface: &str, x: usize, y: usize| {
            let spoil = |_: &Drawing, planes: &mut Planes| planes[0][y * 8 + x] ^= 1;
            answer("coverage", interface, only.clone(), &spoil)["word"].clone()
        };
        assert_eq!([word("webgl2", 2, 2), word("webgpu", 2, 2)], ["outside", "allowed"]);
        assert_eq!([word("webgl2", 2, 0), word("webgpu", 2, 0)], ["allowed", "allowed"]);
        assert_eq!([word("webgl2", 3, 2), word("webgpu", 6, 6)], ["outside", "outside"]);
    }

    /// Another of the four rules is found by its name.
    #[test]
    fn a_rule_is_recognised() {
        let bottom_left = |subject: &Drawing, planes: &mut Planes| {
            let side = (planes[0].len() as f64).sqrt() as i32;
            planes[0].fill(0);
            subject.corners().iter().for_each(|c| cover(c, RULES[2], [0, 0], side, &mut planes[0]));
        };
        let answer = answer("coverage", "webgl2", json!({ "number": 1 }), &bottom_left);
        assert_eq!(
            (&answer["word"], &answer["facts"]["rule"]),
            (&json!("allowed"), &json!("bottom-left"))
        );
    }

    /// What a device draws that rounds positions to a step, in one of the [`ROUNDINGS`].
    fn rounding(step: i32, round: usize) -> impl Fn(&Drawing, &mut Planes) {
        move |subject: &Drawing, planes: &mut Planes| {
            planes[0].fill(0);
            for c in subject.corners() {
                let round = |v| ROUNDINGS[round].1(v, step);
                let snapped = c.map(|p| SubpixelPoint::new(round(p.x), round(p.y)));
                cover(&snapped, RULES[0], [0, 0], 16, &mut planes[0]);
            }
        }
    }

    /// A device that rounds half up to 1/16 px, one that rounds to 1/8, and one that cuts off.
    #[test]
    fn a_lattice_is_recognised() {
        let found = |interface: &str, step, round| {
            let answer = answer("lattice", interface, json!({}), &rounding(step, round));
            [
                answer["word"].clone(),
                answer["facts"]["bits"].clone(),
                answer["facts"]["rounding"].clone(),
            ]
        };
        assert_eq!(found("webgl2", 16, 1), [json!("equal"), json!(4), json!("half up")]);
        assert_eq!(found("webgl2", 32, 0), [json!("outside"), json!(3), json!("half to even")]);
        assert_eq!(found("webgpu", 16, 3), [json!("allowed"), json!(4), json!("down")]);
    }

    /// A lattice that is too coarse is shown by a case that no finer one explains, which breaks no promise alone.
    #[test]
    fn a_coarse_lattice_is_shown() {
        let coarse = rounding(32, 1);
        let found = answer("lattice", "webgl2", json!({}), &coarse)["broken"].clone();
        let draw =
            |check, device, layout, list: &[Drawing]| drawn(check, device, layout, list, &coarse);
        let (smallest, through) = shrunk("lattice", found, &draw);
        assert!(through.len() > 1, "{through:?}");
        let only = json!({ "only": smallest });
        let alone = answer("lattice", "webgl2", only.clone(), &coarse);
        assert_eq!(alone["word"], "allowed");
        assert!(alone["facts"]["finest"].as_u64() < Some(4), "{}", alone["facts"]);
        let right = answer("lattice", "webgl2", only, &|_, _| {});
        assert_eq!(right["facts"]["finest"], 8);
        assert_eq!(answer("lattice", "webgl2", json!({}), &|_, _| {})["broken"], Value::Null);
    }

    /// Smaller cases lie on the device's lattice and in the cell, and lead to one that is smaller still.
    #[test]
    fn smaller_cases_are_asked() {
        let (_, list) = batch("coverage", "webgl2", json!({ "number": 4 })).subjects().unwrap();
        // Fails where it covers anything.
        let draw = |check, device, layout: Layout, list: &[Drawing]| {
            let on_lattice = |v: i32| v % 16 == 0 && (0..=layout.cell * SUBPIXELS).contains(&v);
            let mut corners = list.iter().flat_map(Drawing::corners).flatten();
            assert!(corners.all(|p| on_lattice(p.x) && on_lattice(p.y)));
            let twice = |_: &Drawing, planes: &mut Planes| {
                planes[0].iter_mut().for_each(|hits| *hits *= 2);
            };
            drawn(check, device, layout, list, &twice)
        };
        let (subject, through) = shrunk("coverage", json!(list[0]), &draw);
        assert!(through.len() > 3, "{}", through.len());
        let px: Vec<_> = subject.corners()[0].iter().map(|p| (p.x.max(p.y)) / SUBPIXELS).collect();
        assert!(px.iter().all(|px| *px <= 2), "{subject:?}");
    }

    /// The smallest case of the first that a device draws wrongly.
    fn smallest(check: &str, draws: &dyn Fn(&Drawing, &mut Planes)) -> Vec<Vec<Vertex>> {
        let found = |more: Value| answer(check, "webgl2", more, draws)["broken"].clone();
        let all = batch(check, "webgl2", json!({})).subjects().unwrap().1;
        let mut wrong =
            all.into_iter().map(|s| found(json!({ "only": s }))).filter(|s| !s.is_null());
        let draw =
            |check, device, layout, list: &[Drawing]| drawn(check, device, layout, list, draws);
        shrunk(check, wrong.next().unwrap(), &draw).0.0
    }

    /// The planted faults of each kind of subject lead to cases of so many shapes, in so many px.
    #[test]
    fn each_kind_becomes_small() {
        let hole = |subject: &Drawing, planes: &mut Planes| {
            // The first pixel that two triangles share by an edge is hit by neither.
            let near = |at: usize| {
                let s = [(at % 16) as f64 + 0.5, (at / 16) as f64 + 0.5];
                subject.0.iter().filter(move |t| {
                    let side = |i: usize, j: usize| {
                        let (a, b) = (t[i], t[j]);
                        (b[0] - a[0]) * (s[1] - a[1]) - (b[1] - a[1]) * (s[0] - a[0])
                    };
                    let sides = [side(0, 1), side(1, 2), side(2, 0)];
                    sides.iter().any(|v| v.abs() < 0.05) && sides.iter().all(|v| *v > -0.05)
                })
            };
            if let Some(at) = (0..256).find(|at| near(*at).count() == 2) {
                planes[0][at] = 0;
            }
        };
        let twice = |_: &Drawing, planes: &mut Planes| {
            planes.iter_mut().flatten().filter(|hits| **hits > 0).for_each(|hits| *hits *= 2);
        };
        let farther = |subject: &Drawing, planes: &mut Planes| {
            if subject.0.len() == 2 {
                let both = expected_of_each(subject);
                for (at, hits) in planes[0].iter_mut().enumerate() {
                    if both.iter().all(|hits| hits[at] > 0) {
                        *hits = 3 - *hits;
                    }
                }
            }
        };
        // What has more than two pixels fills the cell.
        let long = |_: &Drawing, planes: &mut Planes| {
            let lit = planes[0].iter().filter(|hits| **hits > 0).count();
            if lit > 2 {
                planes[0].fill(1);
            }
        };
        let last = |_: &Drawing, planes: &mut Planes| {
            if let [first, second] = &mut planes[..]
                && let Some(at) = first.iter().rposition(|hits| *hits > 0)
            {
                second[at] = 0;
            }
        };
        type Draws<'a> = &'a dyn Fn(&Drawing, &mut Planes);
        // So many shapes, in a box of so many px in x and y together.
        let plants: [(&str, Draws, (usize, u32)); 5] = [
            ("tiling", &hole, (2, 2)),
            ("tiling", &twice, (1, 2)),
            ("depth", &farther, (2, 2)),
            ("lines", &long, (1, 3)),
            ("twice", &last, (1, 2)),
        ];
        for (check, draws, wanted) in plants {
            let found = smallest(check, draws);
            let (shapes, px, ..) = size(&found);
            assert_eq!((shapes, px), wanted, "{check}: {found:?}");
        }
    }

    /// The pixels of each triangle of a subject of the depth test.
    fn expected_of_each(subject: &Drawing) -> Vec<Vec<u8>> {
        let device = batch("depth", "webgl2", json!({})).device;
        let alone = |t: &Vec<Vertex>| Drawing(vec![t.clone()]);
        subject.0.iter().map(|t| expected(Topic::Depth, device, &alone(t), 32).remove(0)).collect()
    }

    /// What comes of values that are exact but for their rounding to f32, in perspective or without.
    fn valued(affine: bool) -> Value {
        let batch = batch("values", "webgl2", json!({}));
        let (layout, list) = batch.subjects().unwrap();
        let pixels = drawn_values(layout, &list, affine);
        Judge { batch, pixels, tally: Tally::default() }.answer().unwrap()
    }

    fn drawn_values(layout: Layout, list: &[Drawing], affine: bool) -> String {
        let mut bytes = vec![0u8; (layout.side * layout.side) as usize * 16];
        for (index, subject) in list.iter().enumerate() {
            let mut t = subject.triangles()[0];
            if affine {
                t = t.with_equal_w();
            }
            let v = &t.vertices;
            let exact = ExactTriangle::new(
                &t.corners(),
                v.map(|v| v.depth),
                v.map(|v| v.inv_w),
                v.map(|v| v.varying.to_array()),
            );
            let (Some(exact), [x0, y0]) = (exact, layout.origin(index)) else { continue };
            for (y, x) in (0..layout.cell).flat_map(|y| (0..layout.cell).map(move |x| (y, x))) {
                if place(&t.corners(), centre_of(x, y)) == Place::Inside {
                    let (depth, [a, b]) = exact.at(x, y);
                    let at = ((y0 + y) * layout.side + x0 + x) as usize * 16;
                    for (i, v) in
                        [depth.to_f64(), a.to_f64(), b.to_f64(), 1.0].into_iter().enumerate()
                    {
                        bytes[at + 4 * i..][..4].copy_from_slice(&(v as f32).to_le_bytes());
                    }
                }
            }
        }
        STANDARD.encode(bytes)
    }

    /// Values a step of f32 away are as promised; those of a plane without perspective break the promise, and a
    /// small triangle shows it.
    #[test]
    fn values_by_their_bounds() {
        assert_eq!(valued(false)["word"], "equal");
        let wrong = valued(true);
        assert_eq!(wrong["word"], "outside");
        let draw = |_, _, layout, list: &[Drawing]| drawn_values(layout, list, true);
        let (Drawing(found), _) = shrunk("values", wrong["broken"].clone(), &draw);
        let (shapes, px, ..) = size(&found);
        assert!(shapes == 1 && px <= 4, "{found:?}");
    }

    #[test]
    fn bad_questions_get_a_sentence() {
        let error =
            |more: Value| batch("coverage", "webgl2", more).answer().unwrap_err().to_string();
        assert!(error(json!({ "only": [] })).contains("1 to 64 shapes"));
        assert!(error(json!({ "only": [[[1e9, 0, 0, 0, 0, 0]]] })).contains("3 vertices"));
        let batch = batch("coverage", "webgl2", json!({}));
        let judge = Judge { batch, pixels: "00".to_owned(), tally: Tally::default() };
        assert!(judge.answer().unwrap_err().to_string().contains("2 bytes"));
    }
}
