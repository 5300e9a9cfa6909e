//! What two judgements of a program differ in: what was mended, what is still wrong, and what is new.
//!
//! The sentences of a cause or a convention change when one of two faults is mended, although the other one stays. So what is wrong is
//! said here in fixed words that do not depend on each other: the places at which nearly every pixel is wrong, as few of them as
//! explain the wrong pixels, and the names of whatever else is wrong. And what was mended is decided by cases, which are the same.

use std::collections::{BTreeMap, HashSet};

use super::adapt_case;
use super::ask::{Answer, Asked, Question, Subject};
use super::baseline;
use super::check::{Check, Truth};
use super::declared::Declared;
use super::failures;
use super::pixels::picture_of;
use super::run::{Failing, Row};
use super::verdict::Verdict;
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS};
use rasterproof_core::triangle::{Corners, PixelPoint};
use rasterproof_verify::comparison::pixels::hits;

/// Cases that are asked again, wrong ones and right ones, of triangles and of lines.
const ASKED_AGAIN: usize = 240;
/// In so many of a hundred pixels of a place something is wrong, if the place is named.
const NEARLY_ALL: u64 = 90;
/// Wrong pixels of a place, at least.
const LEAST: u64 = 2;

/// What a judgement leaves for the next one. The verdict has to remember all its cases.
#[derive(Clone, Debug, Default)]
pub struct JudgementRecord {
    /// What is wrong in a few words each, what is wrong most first.
    pub faults: Vec<String>,
    /// The cases that fail, to be asked again.
    failing: Vec<Failing>,
    /// The names of the cases that fail, and of all that were judged, as in a baseline.
    wrong: BTreeMap<String, u64>,
    /// The names of all cases that were judged, whatever came of them.
    judged: HashSet<String>,
}

/// How a judgement differs from the one before.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Changes {
    /// What was wrong before and is right now.
    pub mended: Vec<String>,
    /// What was wrong before and still is.
    pub still: Vec<String>,
    /// What was right before, as far as cases show.
    pub new: Vec<String>,
    /// Cases that failed before and are right now, and those that still fail.
    pub right_now: u64,
    /// Cases that fail in both.
    pub still_wrong: u64,
    /// Cases that were right before.
    pub wrong_now: u64,
}

impl JudgementRecord {
    /// What was found, in words for which the program is asked a few hundred cases again.
    pub fn of(program: &mut dyn Subject, verdict: &Verdict) -> Self {
        let found = &verdict.more.found;
        Self {
            faults: faults(program, verdict),
            failing: found.failing.clone(),
            wrong: baseline::failing_cases(found),
            judged: baseline::judged_cases(found),
        }
    }

    /// Asks again some of the cases that failed: how many there are, and how many of them are right now.
    pub fn ask_again(&self, program: &mut dyn Subject, seed: u64) -> [u64; 2] {
        let truth = Truth::of(program.declared());
        let mut counts = [0, 0];
        for failing in some_of_each(&self.failing, ASKED_AGAIN) {
            let Some(asked) = AskedAgain::of(program, failing, seed, &truth) else { continue };
            counts[0] += 1;
            counts[1] += u64::from(!asked.is_wrong);
        }
        counts
    }

    /// How this judgement differs from one before. A fault is mended only if a case that failed is right, and new only if a case that
    /// was right fails; otherwise it is the old one, seen in another way.
    #[must_use]
    pub fn since(&self, before: &Self) -> Changes {
        let mut out = Changes::default();
        // First the cases: those that were wrong before, then those that are wrong now.
        for case in before.wrong.keys() {
            if self.wrong.contains_key(case) {
                out.still_wrong += 1;
            } else if self.judged.contains(case) {
                out.right_now += 1;
            }
        }
        for case in self.wrong.keys() {
            let was_right = before.judged.contains(case) && !before.wrong.contains_key(case);
            out.wrong_now += u64::from(was_right);
        }
        // Then the words. A fault is new only where a case shows it, since its words may have changed with another fault.
        for fault in &self.faults {
            let is_new = out.wrong_now > 0 && !before.faults.contains(fault);
            let list = if is_new { &mut out.new } else { &mut out.still };
            list.push(fault.clone());
        }
        // In the same way, a fault is gone only where a case is right that was not.
        if out.right_now > 0 {
            let is_gone = |fault: &&String| !self.faults.contains(*fault);
            out.mended = before.faults.iter().filter(is_gone).cloned().collect();
        }
        out
    }
}

/// The failing cases of a property.
struct OfProperty<'a> {
    name: &'static str,
    failing: Vec<&'a Failing>,
}

/// Some of these, as many of each property as of the others.
fn some_of_each(all: &[Failing], most: usize) -> Vec<&Failing> {
    // The cases of each property, in their order.
    let mut properties: Vec<OfProperty<'_>> = Vec::new();
    for failing in all {
        match properties.iter_mut().find(|of| of.name == failing.property) {
            Some(of) => of.failing.push(failing),
            None => {
                properties.push(OfProperty { name: failing.property, failing: vec![failing] });
            }
        }
    }
    // The properties take turns, each with its next case, until there are enough or no more.
    let longest = properties.iter().map(|of| of.failing.len()).max().unwrap_or(0);
    let mut chosen = Vec::new();
    for number in 0..longest {
        for of in &properties {
            if let Some(&next) = of.failing.get(number)
                && chosen.len() < most
            {
                chosen.push(next);
            }
        }
    }
    chosen
}

/// A case that was judged before and is asked again.
struct AskedAgain {
    check: Check,
    questions: Vec<Question>,
    answers: Vec<Answer>,
    is_wrong: bool,
}

impl AskedAgain {
    /// Asks the case of a failure again; nothing where the time was up before it was answered, or where it has no such check any
    /// more.
    fn of(program: &mut dyn Subject, of: &Failing, seed: u64, truth: &Truth) -> Option<Self> {
        // The case is made again from the seed, so that only its name has to be kept.
        let family = adapt_case::family(of.family)?;
        let case = adapt_case::case(family, seed, of.index, &truth.declared);
        let checks = Check::of_truth(family.name, &case, of.index, truth);
        let check = checks.into_iter().find(|check| check.name(family.name) == of.property)?;
        let mut questions = Vec::new();
        check.questions(&case, truth, &mut questions);
        let answers = program.ask(&questions, 1);
        let judged = failures::judge(check, &case, &answers, questions.len(), truth);
        // Where the time is up, nothing is known of it.
        let is_answered = answers.len() == questions.len() || !judged.died.is_empty();
        is_answered.then(|| Self { check, is_wrong: judged.is_wrong(), questions, answers })
    }
}

/// What is wrong with a program, in fixed words, each once.
fn faults(program: &mut dyn Subject, verdict: &Verdict) -> Vec<String> {
    let found = &verdict.more.found;
    let mut faults = Vec::new();
    // What is no answer at all.
    for incident in &found.incidents {
        add_once(&mut faults, format!("it {}", incident.what.breach.name()));
    }
    for stray in &found.strays {
        add_once(&mut faults, format!("it {}", stray.breach.name()));
    }
    let wrong: Vec<&Row> = verdict.families.iter().filter(|row| row.wrong_cases > 0).collect();
    if wrong.iter().any(|row| row.refused > 0) {
        faults.push("requests that it refuses".to_owned());
    }
    // Wrong pixels, by the places where they lie.
    let mut is_explained = false;
    for check in [Check::Coverage, Check::Line] {
        if wrong.iter().any(|row| row.check == Some(check)) {
            is_explained = true;
            faults.extend(wrong_places(program, check, verdict, &wrong));
        }
    }
    // Whatever else is wrong has a name.
    for row in wrong {
        if let Some(name) = name_of(row, is_explained) {
            add_once(&mut faults, name.to_owned());
        }
    }
    faults
}

/// A fault is said once, however many rows show it.
fn add_once(faults: &mut Vec<String>, fault: String) {
    if !faults.contains(&fault) {
        faults.push(fault);
    }
}

/// The places of wrong pixels in the answers to some cases of a check, wrong ones and right ones, which are asked again.
fn wrong_places(
    program: &mut dyn Subject,
    check: Check,
    verdict: &Verdict,
    rows: &[&Row],
) -> Vec<String> {
    let found = &verdict.more.found;
    let truth = Truth::of(program.declared());
    // The rows whose cases are judged by this check.
    let is_of_check =
        |name: &str| rows.iter().any(|row| row.check == Some(check) && row.name == name);
    let mut wrong = found.failing.clone();
    wrong.retain(|failing| is_of_check(failing.property));
    // Right is a case that was judged and is none of those that fail.
    let failing = baseline::failing_cases(found);
    let mut right = Vec::new();
    for &(property, family, index) in &found.judged {
        let case = Failing { property, family, index, fingerprint: 0 };
        if is_of_check(property) && !failing.contains_key(&case.name()) {
            right.push(case);
        }
    }
    // Wrong and right cases count alike: a place is named where nearly all of its pixels are wrong.
    let mut table = PlaceTable::new(check);
    for case in
        some_of_each(&wrong, ASKED_AGAIN).into_iter().chain(some_of_each(&right, ASKED_AGAIN))
    {
        let asked = AskedAgain::of(program, case, verdict.options.seed, &truth);
        let Some(asked) = asked.filter(|asked| asked.check == check) else { continue };
        for (question, answer) in asked.questions.iter().zip(&asked.answers) {
            table.add(question, answer, &truth);
        }
    }
    table.named()
}

/// The name of what is wrong in a row; nothing where wrong pixels explain it, or where their places are named.
fn name_of(row: &Row, is_explained: bool) -> Option<&'static str> {
    Some(match row.check? {
        Check::Values if row.wrong_values > 0 => "values",
        Check::Samples => "samples",
        Check::Depth => "which triangle is seen",
        Check::Near => "corners at the near plane",
        Check::Wide => "lines with a width",
        Check::Area => "shares of pixels",
        Check::SampleValues => "values of samples",
        Check::Formula => "results of formulas",
        Check::Carried => "attributes at the near plane",
        // What is wrong between answers, and with the pixels of values, comes of wrong pixels, where there are any.
        Check::Values if !is_explained => "pixels of values",
        check if check.compares_answers() && !is_explained => row.name,
        _ => return None,
    })
}

/// A pixel of a triangle that is drawn, or might be, with what a place asks of it.
struct Spot<'a> {
    question: &'a Question,
    pixel: [i32; 2],
    /// On which edges its sample lies: left, right, top, bottom.
    on_edge: [bool; 4],
    /// The first and last column and row of the window whose samples lie between the corners; they may have no pixel.
    columns: [i32; 2],
    /// The same of rows.
    rows: [i32; 2],
    /// The first and last column and row with a pixel that is expected.
    drawn_columns: [i32; 2],
    /// The same of rows.
    drawn_rows: [i32; 2],
    /// The first and last pixel that is expected in its row.
    run: Option<[i32; 2]>,
}

/// The same of a line.
struct LineSpot<'a> {
    question: &'a Question,
    ends: [PixelPoint; 2],
    pixel: [i32; 2],
    /// Whether the pixels come in the order in which they are expected.
    is_in_order: bool,
}

/// The name of a place, and whether a pixel lies there.
type Place = (&'static str, bool);

impl Spot<'_> {
    /// All places, those that say most first. A row or column of a shape is meant in either of two ways.
    fn places(&self) -> Vec<Place> {
        let [left, right, top, bottom] = self.on_edge;
        let [x, y] = self.pixel;
        // Of questions that are not about coverage, no place of a triangle holds.
        let area = corners(self.question).map_or(0, twice_area);
        let is_triangle = corners(self.question).is_some();
        let run = self.run;
        vec![
            ("ties on left edges", left),
            ("ties on right edges", right),
            ("ties on top edges", top),
            ("ties on bottom edges", bottom),
            ("the first row of shapes", y == self.rows[0]),
            ("the last row of shapes", y == self.rows[1]),
            ("the first column of shapes", x == self.columns[0]),
            ("the last column of shapes", x == self.columns[1]),
            ("the first row of shapes", y == self.drawn_rows[0]),
            ("the last row of shapes", y == self.drawn_rows[1]),
            ("the first column of shapes", x == self.drawn_columns[0]),
            ("the last column of shapes", x == self.drawn_columns[1]),
            ("the left ends of rows", run.is_some_and(|run| run[0] == x)),
            ("the right ends of rows", run.is_some_and(|run| run[1] == x)),
            ("pixels left of the rows", run.is_some_and(|run| x == run[0] - 1)),
            ("pixels right of the rows", run.is_some_and(|run| x == run[1] + 1)),
            ("windows of width 1", self.question.width == 1),
            ("windows of height 1", self.question.height == 1),
            ("the last row of windows", y as u32 + 1 == self.question.height),
            ("the last column of windows", x as u32 + 1 == self.question.width),
            ("clockwise triangles", area > 0),
            ("counterclockwise triangles", area < 0),
            ("triangles without area", is_triangle && area == 0),
            ("all pixels of triangles", true),
        ]
    }
}

impl LineSpot<'_> {
    /// All places, those that say most first.
    fn places(&self) -> Vec<Place> {
        let [x, y] = self.pixel;
        let [first, last] = self.ends;
        let [dx, dy] = self.side();
        // A tie is computed once, since three places ask for it.
        let is_tie = self.is_tie();
        vec![
            ("the first pixel of lines", [x, y] == [first.x, first.y]),
            ("the last pixel of lines", [x, y] == [last.x, last.y]),
            ("ties of lines", is_tie),
            ("ties of lines drawn backwards", is_tie && self.is_backwards()),
            (
                "ties of lines whose x and y go opposite ways",
                is_tie && dx.signum() * dy.signum() < 0,
            ),
            ("level lines", dy == 0),
            ("upright lines", dx == 0),
            ("diagonal lines", dx.abs() == dy.abs()),
            ("windows of width 1", self.question.width == 1),
            ("windows of height 1", self.question.height == 1),
            ("steep lines", dy.abs() > dx.abs()),
            ("flat lines", dx.abs() > dy.abs()),
            ("lines to the left", dx < 0),
            ("lines to the right", dx > 0),
            ("lines that run up", dy < 0),
            ("lines that run down", dy > 0),
            ("the order of the pixels of lines", !self.is_in_order),
            ("all pixels of lines", true),
        ]
    }

    /// How far it goes along x and y.
    fn side(&self) -> [i64; 2] {
        let [from, to] = self.ends;
        [i64::from(to.x) - i64::from(from.x), i64::from(to.y) - i64::from(from.y)]
    }

    /// Whether it runs to the smaller coordinate along its longer side.
    fn is_backwards(&self) -> bool {
        let [dx, dy] = self.side();
        (if dy.abs() > dx.abs() { dy } else { dx }) < 0
    }

    /// Whether the line passes halfway between two pixels where it passes this one.
    fn is_tie(&self) -> bool {
        let [dx, dy] = self.side();
        let start = [self.ends[0].x, self.ends[0].y];
        // Along the longer side the line goes a pixel at each step; a tie is where the other coordinate is halfway.
        let along = usize::from(dy.abs() > dx.abs());
        let (longer, shorter) = (dx.abs().max(dy.abs()), dx.abs().min(dy.abs()));
        let steps = (i64::from(self.pixel[along]) - i64::from(start[along])).abs();
        longer > 0 && (2 * shorter * steps) % (2 * longer) == longer
    }
}

/// The corners of a question about coverage; places of triangles are those of such questions alone.
fn corners(question: &Question) -> Option<&Corners> {
    match &question.of {
        Asked::Coverage(corners) => Some(corners),
        _ => None,
    }
}

/// Left, right, top, bottom: on which edges a point lies.
fn edges_at(corners: &Corners, at: [i32; 2]) -> [bool; 4] {
    let mut on = [false; 4];
    // What has no area has no sides.
    let edges = if twice_area(corners) == 0 { 0..0 } else { 0..3 };
    for i in edges {
        let (mut from, mut to, third) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
        if !failures::lies_between(from, to, at) {
            continue;
        }
        if from.y == to.y {
            on[if third.y > from.y { 2 } else { 3 }] = true;
            continue;
        }
        if from.y > to.y {
            (from, to) = (to, from);
        }
        // Of an edge that runs down, the third corner lies on the left where the triangle is clockwise.
        on[usize::from(twice_area(&[from, to, third]) > 0)] = true;
    }
    on
}

/// The first and last pixel within the window whose sample lies between the least and the greatest of three coordinates, the
/// greatest excluded.
fn samples_between(coordinates: &[i32; 3], sample: i32, side: u32) -> [i32; 2] {
    let [a, b, c] = *coordinates;
    let (least, most) = (a.min(b).min(c), a.max(b).max(c));
    let (side, last) = (i64::from(side), first_at_or_after(most, sample) - 1);
    // Both lie in the window or just before it, or the first lies behind the last.
    let first = first_at_or_after(least, sample).max(0).clamp(-1, side);
    [first as i32, last.min(side - 1).clamp(-1, side) as i32]
}

/// The first pixel whose sample has at least this coordinate. Corners may lie at the ends of their range, so that the difference
/// does not fit into 32 bits.
fn first_at_or_after(coordinate: i32, sample: i32) -> i64 {
    let (way, step) = (i64::from(coordinate) - i64::from(sample), i64::from(SUBPIXELS));
    way.div_euclid(step) + i64::from(way.rem_euclid(step) > 0)
}

/// Which pixels of a triangle must and may be drawn, and which were.
struct TrianglePictures {
    /// The pixels that have to be drawn.
    must: Coverage,
    /// Those, and the pixels of which nothing is promised.
    may: Coverage,
    drawn: Coverage,
}

/// For each place how many pixels there are and how many are wrong; and each wrong pixel with its places, as bits. Pixels that should
/// be drawn and those that should not are told apart: each place is there for both, one half of all behind the other.
struct PlaceTable {
    check: Check,
    /// The name of each place, twice: first for pixels that should be drawn, then for the others.
    names: Vec<&'static str>,
    /// How many pixels lie at each place.
    all: Vec<u64>,
    /// How many of them are wrong.
    wrong: Vec<u64>,
    /// The places of each wrong pixel, a bit for each.
    wrong_pixels: Vec<u64>,
}

impl PlaceTable {
    /// A table without a pixel yet.
    fn new(check: Check) -> Self {
        let (names, all, wrong, wrong_pixels) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { check, names, all, wrong, wrong_pixels }
    }

    /// Counts a pixel in all of the places where it lies.
    fn count(&mut self, places: &[Place], is_expected: bool, is_wrong: bool) {
        // Every pixel has the same places, so the first one brings their names.
        if self.names.is_empty() {
            self.names = places.iter().map(|(name, _)| *name).collect();
            self.names = self.names.repeat(2);
            self.all = vec![0; self.names.len()];
            self.wrong = vec![0; self.names.len()];
        }
        let first = if is_expected { 0 } else { places.len() };
        let mut bits = 0;
        for (number, (_, lies_there)) in places.iter().enumerate() {
            if *lies_there {
                let place = first + number;
                self.all[place] += 1;
                self.wrong[place] += u64::from(is_wrong);
                bits |= 1 << place;
            }
        }
        if is_wrong {
            self.wrong_pixels.push(bits);
        }
    }

    /// Adds the pixels of an answer that are drawn, or might be.
    fn add(&mut self, question: &Question, answer: &Answer, truth: &Truth) {
        let window = PixelRect::window(question.width, question.height);
        match &question.of {
            Asked::Coverage(corners) => {
                // Where nothing is promised of a triangle, its pixels say nothing.
                let Some(picture) = truth.expect.picture(corners, window) else { return };
                let must = hits(&picture.must, window).0;
                let may = match &picture.may {
                    Some(may) => hits(may, window).0,
                    None => must.clone(),
                };
                let drawn = picture_of(answer, window).unwrap_or_else(|| Coverage::new(window, 0));
                let pictures = TrianglePictures { must, may, drawn };
                self.add_triangle(question, corners, &pictures, &truth.declared);
            }
            Asked::Line { ends, .. } => {
                // The same of lines.
                let Some(expected) = truth.expect.line(ends, window) else { return };
                let drawn = if let Answer::Line(pixels) = answer { &pixels[..] } else { &[] };
                self.add_line(question, *ends, &expected, drawn, truth.declared.line_set);
            }
            _ => {}
        }
    }

    /// Counts the pixels of a triangle that are drawn, that should be, or that lie where another one like them is drawn.
    fn add_triangle(
        &mut self,
        question: &Question,
        corners: &Corners,
        TrianglePictures { must, may, drawn }: &TrianglePictures,
        declared: &Declared,
    ) {
        // The rows and columns in which the shape begins and ends: by its corners, and by its pixels.
        let sample = declared.convention.sample;
        let columns = samples_between(&corners.map(|corner| corner.x), sample[0], question.width);
        let rows = samples_between(&corners.map(|corner| corner.y), sample[1], question.height);
        let (mut drawn_columns, mut drawn_rows) = ([i32::MAX, -1], [i32::MAX, -1]);
        for (y, x0, x1) in must.runs() {
            drawn_columns = [drawn_columns[0].min(x0), drawn_columns[1].max(x1 - 1)];
            drawn_rows = [drawn_rows[0].min(y), y];
        }
        for (y, row) in drawn.rows() {
            let expected = must.row(y);
            let first = expected.iter().position(|hits| *hits > 0);
            let last = expected.iter().rposition(|hits| *hits > 0);
            let run = first.zip(last).map(|(first, last)| [first as i32, last as i32]);
            for (x, &hits) in row.iter().enumerate() {
                let (must, may) = (expected[x], may.row(y)[x]);
                let pixel = [x as i32, y];
                let mut at = sample;
                for axis in 0..2 {
                    at[axis] = pixel[axis].saturating_mul(SUBPIXELS).saturating_add(sample[axis]);
                }
                let on_edge = edges_at(corners, at);
                // A pixel that is rightly left out says something where another one like it is drawn.
                let is_beside =
                    run.is_some_and(|[first, last]| [first - 1, last + 1].contains(&pixel[0]));
                if must == 0 && hits == 0 && !is_beside && on_edge == [false; 4] {
                    continue;
                }
                let is_wrong = hits != must && !(hits == 1 && may == 1);
                let spot = Spot {
                    question,
                    pixel,
                    on_edge,
                    columns,
                    rows,
                    drawn_columns,
                    drawn_rows,
                    run,
                };
                self.count(&spot.places(), must > 0, is_wrong);
            }
        }
    }

    /// Counts the pixels of a line that are drawn or should be.
    fn add_line(
        &mut self,
        question: &Question,
        ends: [PixelPoint; 2],
        expected: &[(i32, i32)],
        drawn: &[(i32, i32)],
        is_set: bool,
    ) {
        let (mut is, mut should) = (drawn.to_vec(), expected.to_vec());
        is.sort_unstable();
        should.sort_unstable();
        // Both lists are sorted, so that a pixel is found by halves.
        let is_drawn = |pixel: &(i32, i32)| is.binary_search(pixel).is_ok();
        let is_in_order = is_set || is != should || drawn == expected;
        // A pixel beside the right one says the same as the one that is missing.
        let is_moved = !should.iter().all(is_drawn);
        for &(x, y) in should.iter().chain(&is) {
            let is_expected = should.binary_search(&(x, y)).is_ok();
            let is_wrong = !is_in_order || is_drawn(&(x, y)) != is_expected;
            if !is_expected && is_moved {
                continue;
            }
            let spot = LineSpot { question, ends, pixel: [x, y], is_in_order };
            self.count(&spot.places(), is_expected, is_wrong);
        }
    }

    /// As few places as explain the wrong pixels: each time the one that explains most of what is left. What no place explains has a
    /// name of its own.
    fn named(mut self) -> Vec<String> {
        let mut named = Vec::new();
        while !self.wrong_pixels.is_empty() {
            // The place that explains most of the wrong pixels that are left, if nearly all of its own pixels are wrong.
            let mut best = None;
            for place in 0..self.names.len() {
                let count =
                    self.wrong_pixels.iter().filter(|pixel| *pixel >> place & 1 == 1).count();
                let is_wrong = 100 * self.wrong[place] >= NEARLY_ALL * self.all[place];
                // Of places that explain the same, the first says most.
                if is_wrong && count as u64 >= LEAST && best.is_none_or(|(most, _)| count > most) {
                    best = Some((count, place));
                }
            }
            // What it explains needs no other place.
            let Some((_, place)) = best else { break };
            // Its name is that of pixels that are missing and of those that are too many: of a line whose right pixel lies outside of the
            // window the wrong one alone is seen.
            let half = self.names.len() / 2;
            let of_name = 1 << place | 1 << ((place + half) % self.names.len());
            self.wrong_pixels.retain(|pixel| pixel & of_name == 0);
            if !named.iter().any(|name| name == self.names[place]) {
                named.push(self.names[place].to_owned());
            }
        }
        if !self.wrong_pixels.is_empty() {
            let whose = if self.check == Check::Line { "lines" } else { "triangles" };
            let what = if named.is_empty() { "some pixels" } else { "some other pixels" };
            named.push(format!("{what} of {whose}"));
        }
        named
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Options;
    use crate::in_process::Inside;
    use rasterproof_registry::engines;

    fn judged(engine: &str) -> JudgementRecord {
        let entry = engines::find(engine).copied().or_else(|| engines::find_planted(engine));
        let mut options = Options::default().cases(60);
        options.terms.remember = true;
        // Causes are not looked at.
        options.terms.patience = std::time::Duration::ZERO;
        let asked = Box::new(Inside::new(&entry.unwrap())) as Box<dyn Subject>;
        let mut askers = [asked];
        let verdict = crate::judge(&mut askers, &options, &|_| None, &|_| ());
        JudgementRecord::of(&mut *askers[0], &verdict)
    }

    /// Each fault has the words that a person would use, and nothing else is said.
    #[test]
    fn faults_are_named_by_their_places() {
        let all: [(&str, &[&str]); 9] = [
            ("scanline", &[]),
            ("dda", &[]),
            (
                "exclusive-edges",
                &["ties on top edges", "ties on left edges", "which triangle is seen", "samples"],
            ),
            ("drops-first-row", &["the first row of shapes", "which triangle is seen", "samples"]),
            ("swapped-weights", &["values"]),
            ("line-misses-end", &["the last pixel of lines"]),
            ("line-draws-backwards", &["the order of the pixels of lines"]),
            ("line-directed-ties", &["ties of lines drawn backwards"]),
            (
                "inclusive-edges",
                &[
                    "ties on right edges",
                    "ties on bottom edges",
                    "which triangle is seen",
                    "samples",
                ],
            ),
        ];
        for (engine, faults) in all {
            assert_eq!(judged(engine).faults, faults, "{engine}");
        }
    }

    /// What is mended, what stays and what is new, by cases and not by words alone.
    #[test]
    fn changes_are_told_by_cases() {
        let one =
            |case: u64| Failing { property: "fan", family: "fan", index: case, fingerprint: 0 };
        let all = (0..9).map(|case| one(case).name()).collect::<HashSet<String>>();
        let judged = |faults: &[&str], cases: &[u64]| JudgementRecord {
            faults: faults.iter().map(|fault| (*fault).to_owned()).collect(),
            failing: Vec::new(),
            wrong: cases.iter().map(|case| (one(*case).name(), 0)).collect(),
            judged: all.clone(),
        };
        let said = |before: &JudgementRecord, now: &JudgementRecord| {
            let Changes { mended, still, new, .. } = now.since(before);
            [mended, still, new].map(|list| list.join(", "))
        };
        let before = judged(&["a", "b"], &[0, 1, 2]);
        assert_eq!(said(&before, &judged(&["b", "c"], &[1, 2, 3])), ["a", "b", "c"]);
        // Seen in another way, since no case is another.
        assert_eq!(said(&before, &judged(&["b", "c"], &[0, 1, 2])), ["", "b, c", ""]);
        assert_eq!(said(&before, &judged(&["c"], &[1])), ["a, b", "c", ""]);
        assert_eq!(said(&before, &judged(&["a", "b", "c"], &[0, 1, 2, 3])), ["", "a, b", "c"]);
        assert_eq!(said(&before, &judged(&[], &[])), ["a, b", "", ""]);
        // A case that was not judged before is not new.
        let few = JudgementRecord { judged: HashSet::new(), ..judged(&["a"], &[0]) };
        assert_eq!(said(&few, &judged(&["a", "c"], &[0, 3])), ["", "a, c", ""]);
    }
}
