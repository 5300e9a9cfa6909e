//! Two programs that are asked alike: where their answers differ, and which of the two the oracle agrees with.
//!
//! Both are sent the same requests, within what both declare that they can answer. Each is judged by the rule that it declares
//! itself, so that a difference of conventions is not called a fault of either.

use std::time::Instant;

use super::ask::{Answer, Ask, Misbehaviour, Question};
use super::check::{Check, Truth, hits_of, picks, sequence};
use super::declared::Declared;
use super::failures;
use super::finding::{Finding, mix};
use super::recognise::{self, Why};
use super::run::{self, Sides};
use super::timed::Timed;
use super::verdict::Verdict;
use super::windings::Windings;
use super::{Options, Step, near_plane, reach};
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, Span};
use rasterproof_verify::cases::near_plane::{ClipCorner, clip_corners};
use rasterproof_verify::cases::{Case, Shape, Triangle};

/// Two programs as one that is asked: each answer is [`Answer::Two`].
struct Pair<'a> {
    sides: [&'a mut dyn Ask; 2],
    /// What is asked of both, with the conventions of the first.
    declared: Declared,
}

impl Ask for Pair<'_> {
    fn declared(&self) -> &Declared {
        &self.declared
    }

    fn ask(&mut self, questions: &[Question], most_deaths: u64) -> Vec<Answer> {
        let names = self.names();
        let [first, second] = &mut self.sides;
        let answers = first.ask(questions, most_deaths);
        let deaths = answers.iter().filter(|answer| answer.is_death()).count() as u64;
        let others =
            second.ask(&questions[..answers.len()], most_deaths.saturating_sub(deaths).max(1));
        let both = |(first, second): (Answer, Answer)| match (first, second) {
            (Answer::Died(what), _) => Answer::Died(said_by(&names[0], what)),
            (_, Answer::Died(what)) => Answer::Died(said_by(&names[1], what)),
            (first, second) => Answer::Two(Box::new([first, second])),
        };
        answers.into_iter().zip(others).map(both).collect()
    }

    fn end_at(&mut self, end: Option<Instant>) {
        self.sides.iter_mut().for_each(|side| side.end_at(end));
    }

    fn cases_at_once(&self) -> u64 {
        let [first, second] = &self.sides;
        first.cases_at_once().min(second.cases_at_once())
    }

    fn strays(&mut self) -> Vec<Misbehaviour> {
        let names = self.names();
        let strays = self.sides.iter_mut().zip(&names);
        strays
            .flat_map(|(side, name)| side.strays().into_iter().map(|what| said_by(name, what)))
            .collect()
    }

    fn complaints(&self) -> Vec<String> {
        let said = self.sides.iter().zip(self.names());
        said.flat_map(|(side, name)| {
            side.complaints().into_iter().map(move |line| format!("{name}: {line}"))
        })
        .collect()
    }
}

impl Pair<'_> {
    fn names(&self) -> [String; 2] {
        names([self.sides[0].declared(), self.sides[1].declared()])
    }
}

/// The names of both as messages have them; of equal ones the second is called the other.
#[must_use]
pub fn names([first, second]: [&Declared; 2]) -> [String; 2] {
    let other = if first.name == second.name {
        format!("the other {}", second.name)
    } else {
        second.name.clone()
    };
    [first.name.clone(), other]
}

fn said_by(name: &str, what: Misbehaviour) -> Misbehaviour {
    Misbehaviour { how: format!("{name}: {}", what.how), ..what }
}

/// Compares two programs on the cases of all families that both can be asked. Copies are pairs of the same two.
///
/// # Panics
/// If nobody is there to be asked.
#[must_use]
pub fn compare(
    pairs: &mut [[Box<dyn Ask>; 2]],
    options: &Options,
    progress: &(dyn Fn(Step) + Sync),
) -> Verdict {
    let start = Instant::now();
    let end = options.time_limit.map(|limit| start + limit);
    progress(Step::Rule);
    let [first, second] = pairs.first_mut().expect("somebody to be asked");
    let mut both = [first.declared().clone(), second.declared().clone()];
    for (side, declared) in [first, second].into_iter().zip(&mut both) {
        declared.reach = reach::reach(&mut Timed::new(&mut **side, end));
    }
    let asked =
        both.each_ref().map(|one| both.iter().fold(one.clone(), |d, other| d.within(other)));
    let mut truth = Truth::of(&asked[0]);
    truth.of_two = Some(Box::new(asked.each_ref().map(Truth::of)));
    let mut pairs: Vec<Pair<'_>> = pairs
        .iter_mut()
        .map(|[first, second]| Pair {
            sides: [&mut **first, &mut **second],
            declared: asked[0].clone(),
        })
        .collect();
    pairs.iter_mut().for_each(|pair| pair.end_at(end));
    let mut askers: Vec<&mut dyn Ask> = pairs.iter_mut().map(|pair| pair as &mut dyn Ask).collect();
    let mut options = options.clone();
    if let Some(limit) = options.time_limit {
        options.time_limit = Some((limit - limit / 10).saturating_sub(start.elapsed()));
        options.patience = options.patience.min(limit / 10);
    }
    let options = &options;
    let mut found = run::run(&mut askers, options, &truth, &|cases| progress(Step::Judged(cases)));
    progress(Step::Smaller);
    let pair = &mut pairs[0];
    let failures = failures::failures(&mut Timed::new(pair, end), &found, options, &truth);
    progress(Step::Cause);
    let causes = causes(pair, &found, options, &truth, end);
    found.strays.extend(pair.strays());
    pair.end_at(None);
    let complaints = pair.complaints();
    let [first, second] = both;
    let windings = Windings::default();
    let mut verdict = Verdict::new(first, options, windings, None, found, failures, complaints);
    verdict.causes = causes;
    verdict.reach = truth.declared.reach;
    verdict.compared_with(second);
    verdict
}

/// Why each of them is wrong where the answers differ.
fn causes(
    pair: &mut Pair<'_>,
    found: &run::Found,
    options: &Options,
    truth: &Truth,
    end: Option<Instant>,
) -> Vec<Why> {
    let Some(of_two) = &truth.of_two else { return Vec::new() };
    let names = pair.names();
    let is_wrong: [fn(&Sides) -> bool; 2] =
        [|s| s.second + s.neither > 0, |s| s.first + s.neither > 0];
    let mut causes = Vec::new();
    for (((side, truth), name), is_wrong) in
        pair.sides.iter_mut().zip(of_two.iter()).zip(names).zip(is_wrong)
    {
        let rows = found.rows.iter().filter(|row| row.sides.as_ref().is_some_and(is_wrong));
        let checks = run::checks_of(rows);
        let start = Instant::now();
        let goes_on = || start.elapsed() < options.patience;
        let mut asked = Timed::new(&mut **side, end);
        let why = recognise::mistakes(&mut asked, &checks, truth, None, &goes_on);
        causes.extend(why.into_iter().map(|why| Why { by: name.clone(), ..why }));
    }
    causes
}

/// The answers of the first program and those of the second; what came instead of answers stands in both.
pub(super) fn sides(answers: &[Answer]) -> [Vec<Answer>; 2] {
    let side = |at: usize| -> Vec<Answer> {
        let one = |answer: &Answer| match answer {
            Answer::Two(both) => both[at].clone(),
            other => other.clone(),
        };
        answers.iter().map(one).collect()
    };
    [side(0), side(1)]
}

/// How the answers of two programs differ, and whether each is right.
pub(super) fn judge(check: Check, case: &Case, answers: &[Answer], of_two: &[Truth; 2]) -> Finding {
    let sides = sides(answers);
    let [first, second] = [0, 1].map(|at| check.judge(case, &sides[at], &of_two[at]));
    // What died is the same on both sides.
    let died = first.died.clone();
    let mut finding = Finding {
        shapes: first.shapes,
        pixels: first.pixels,
        answered: first.answered,
        right: died.is_empty().then(|| [!first.is_wrong(), !second.is_wrong()]),
        died,
        mark: first.mark ^ second.mark.rotate_left(1),
        ..Finding::default()
    };
    let declared = &of_two[0].declared;
    for (at, (first, second)) in sides[0].iter().zip(&sides[1]).enumerate() {
        if first == second {
            continue;
        }
        let triangle = match &case.shape {
            Shape::Triangles { list, .. } => list.get(at),
            _ => None,
        };
        difference(&mut finding, [first, second], triangle, case.window, declared);
    }
    finding
}

fn difference(
    finding: &mut Finding,
    [first, second]: [&Answer; 2],
    triangle: Option<&Triangle>,
    window: PixelRect,
    declared: &Declared,
) {
    match (first, second) {
        (Answer::Refused(_), Answer::Refused(_)) => return,
        (Answer::Refused(why), _) | (_, Answer::Refused(why)) => {
            finding.refuse(&format!("by one of both: {why}"));
            return;
        }
        (Answer::Line(first), Answer::Line(second)) => {
            let in_order = !declared.line_set;
            sequence(&mut finding.tally, &mut finding.mark, first, second, window, in_order);
            return;
        }
        (Answer::Polygon(first), Answer::Polygon(second))
        | (Answer::Carried(first), Answer::Carried(second)) => {
            corners(finding, first, second, triangle, declared);
            return;
        }
        _ => {}
    }
    let both = [first, second].map(|answer| hits_of(answer, window));
    let [Some((first_hits, first_outside)), Some((second_hits, second_outside))] = both else {
        return;
    };
    finding.tally.extra += first_outside.saturating_sub(second_outside);
    finding.tally.missing += second_outside.saturating_sub(first_outside);
    pixels(finding, &first_hits, &second_hits, declared.mask);
    match (first, second) {
        (Answer::Samples(first), Answer::Samples(second))
        | (Answer::Seen(first), Answer::Seen(second)) => {
            let [first, second] = [first, second].map(|runs| marks(runs, window));
            for ((y, a), (_, b)) in first.rows().zip(second.rows()) {
                for (x, (a, b)) in a.iter().zip(b).enumerate() {
                    let are_covered = a.is_some() && b.is_some();
                    if are_covered && a != b {
                        finding.tally.order += 1;
                        [y as u64, x as u64].iter().for_each(|word| mix(&mut finding.mark, *word));
                    }
                }
            }
        }
        (Answer::Values(first), Answer::Values(second)) => {
            if let Some(triangle) = triangle {
                values(finding, first, second, triangle, declared);
            }
        }
        _ => {}
    }
}

fn pixels(finding: &mut Finding, first: &Coverage, second: &Coverage, is_mask: bool) {
    for ((y, a), (_, b)) in first.rows().zip(second.rows()) {
        for (x, (&a, &b)) in a.iter().zip(b).enumerate() {
            let tally = &mut finding.tally;
            match (a, b) {
                (0, 0) => continue,
                (0, _) => tally.missing += 1,
                (_, 0) => tally.extra += 1,
                _ if a == b || is_mask => continue,
                _ => tally.twice += 1,
            }
            [y as u64, x as u64, u64::from(a)]
                .iter()
                .for_each(|word| mix(&mut finding.mark, *word));
        }
    }
}

/// What each pixel of the window is marked with last.
fn marks(runs: &[(Span, u8)], window: PixelRect) -> Frame<Option<u8>> {
    let mut marks = Frame::new(window, None);
    for (run, mark) in runs {
        let (x0, x1) = (run.x0_px.max(window.x0), run.x1_px.min(window.x1));
        if (window.y0..window.y1).contains(&run.y_px) && x0 < x1 {
            marks.span_mut(run.y_px, x0, x1).fill(Some(*mark));
        }
    }
    marks
}

/// Two right values lie within twice the tolerance of each other.
fn values(
    finding: &mut Finding,
    first: &[Fragment<glam::DVec2>],
    second: &[Fragment<glam::DVec2>],
    triangle: &Triangle,
    declared: &Declared,
) {
    let v = &triangle.vertices;
    let largest = |values: [f64; 3]| values.into_iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let bound = |values| (2.0 * declared.tolerance * largest(values)).max(f64::MIN_POSITIVE);
    let bounds = [v.map(|v| v.depth), v.map(|v| v.varying.x), v.map(|v| v.varying.y)].map(bound);
    for f in picks(first) {
        let Some(g) = second.iter().find(|g| (g.x_px, g.y_px) == (f.x_px, f.y_px)) else {
            continue;
        };
        let errors =
            [f.depth - g.depth, f.varying.x - g.varying.x, f.varying.y - g.varying.y].map(f64::abs);
        for (error, bound) in errors.into_iter().zip(bounds) {
            finding.values += 1;
            // The difference to what is no number is no number.
            let share = if error.is_nan() { f64::INFINITY } else { error / bound };
            if share > finding.worst {
                finding.worst = share;
                finding.worst_at = Some((f.x_px, f.y_px));
            }
        }
    }
}

fn corners(
    finding: &mut Finding,
    first: &[ClipCorner],
    second: &[ClipCorner],
    triangle: Option<&Triangle>,
    declared: &Declared,
) {
    let Some(triangle) = triangle else { return };
    let bounds = near_plane::bounds(&clip_corners(triangle), 2.0 * declared.tolerance);
    let near = |a: &ClipCorner, b: &ClipCorner| {
        a.iter().zip(b).zip(bounds).all(|((a, b), bound)| (a - b).abs() <= bound)
    };
    let lacking = |of: &[ClipCorner], here: &[ClipCorner]| {
        of.iter().filter(|corner| !here.iter().any(|other| near(corner, other))).count() as u64
    };
    let (missing, extra) = (lacking(second, first), lacking(first, second));
    finding.tally.missing += missing;
    finding.tally.extra += extra;
    let is_same_way =
        || near_plane::is_round(first.len(), second.len(), |i, j| near(&first[i], &second[j]));
    if missing + extra == 0 && !is_same_way() {
        finding.tally.order += 1;
    }
}
