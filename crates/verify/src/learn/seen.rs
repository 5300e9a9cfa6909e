//! What is read off answers, one border or one pixel after another: by these, formulas are compared.

use super::border::{self, Crossing, Site, Tie, Toward};
use super::drawer::LearnedAnswer;
use super::picture::Picture;
use super::quantity::Scene;
use std::rc::Rc;

/// A border that was read off an answer.
pub(super) struct BorderSeen<'a> {
    pub(super) group: usize,
    pub(super) answer: Rc<(&'a LearnedAnswer, Scene<'a>)>,
    pub(super) site: Site,
    /// In the window or not.
    pub(super) right: i64,
    /// In the window; nothing where the row is empty.
    pub(super) predicted: Option<i64>,
    pub(super) drawn: Option<i64>,
    /// The other end of the row.
    pub(super) other: i64,
}

impl BorderSeen<'_> {
    /// Whether a formula gives what is drawn, in the window.
    pub(super) fn is_drawn_by(&self, crossing: &Crossing, sample: [i64; 2]) -> bool {
        let q = &self.answer.0.question;
        let side = i64::from(q.side[1 - self.site.axis]);
        let Some(value) = self.site.evaluate(crossing, q, sample) else { return false };
        match self.drawn {
            Some(drawn) => value.clamp(0, side) == drawn,
            None if self.site.end == 0 => value >= self.other,
            None => value <= self.other,
        }
    }
}

fn row_is_empty(site: &Site, picture: &Picture) -> bool {
    !(0..picture.side[0]).any(|x| picture.has([x, site.place as i32]))
}

/// A pixel by which tests are compared, with the answer that shows it.
pub(super) struct PixelSeen<'a> {
    /// The number of the answer.
    pub(super) group: usize,
    pub(super) answer: &'a LearnedAnswer,
    pub(super) at: [i32; 2],
}

/// Pixels of an answer that tests are compared by, of wrong and of right ones.
const MOST_SEEN: usize = 4;

/// So many of some borders, evenly spread.
fn spread<'a, 'b>(all: &[&'b BorderSeen<'a>], most: usize) -> Vec<&'b BorderSeen<'a>> {
    all.iter().step_by(all.len().div_ceil(most).max(1)).copied().collect()
}

/// The ties of each end that most of some right borders have.
pub(super) fn ties_of(right: &[&BorderSeen<'_>], sample: [i64; 2]) -> [Tie; 2] {
    [0, 1].map(|end| {
        let agrees = |tie: &Tie| {
            let crossing = Crossing { ties: [*tie; 2], ..Crossing::RIGHT };
            let of_end = right.iter().filter(|seen| seen.site.end == end);
            of_end.filter(|seen| seen.is_drawn_by(&crossing, sample)).count()
        };
        Tie::ALL.into_iter().rev().max_by_key(agrees).unwrap_or(Tie::Down)
    })
}

/// The borders of some ends, with heights rounded in one way.
pub(super) struct BordersAtEnds<'a, 'b> {
    /// Those that a model predicts wrongly, and those that it predicts well.
    pub(super) wrong: Vec<&'b BorderSeen<'a>>,
    pub(super) right: Vec<&'b BorderSeen<'a>>,
    /// Some of both, which formulas are compared by.
    pub(super) some: [Vec<&'b BorderSeen<'a>>; 2],
}

impl<'a, 'b> BordersAtEnds<'a, 'b> {
    pub(super) fn of(of_ends: &'b [Vec<BorderSeen<'a>>; 2], ends: [bool; 2]) -> Self {
        let (mut wrong, mut right) = (Vec::new(), Vec::new());
        for end in (0..2).filter(|end| ends[*end]) {
            for seen in &of_ends[end] {
                if seen.drawn == seen.predicted { &mut right } else { &mut wrong }.push(seen);
            }
        }
        let some = [spread(&wrong, 120), spread(&right, 60)];
        Self { wrong, right, some }
    }
}

/// What a formula costs.
#[derive(Clone, Copy)]
pub(super) struct Price {
    /// Steps of [`super::trial::Work`] for a border or a pixel.
    pub(super) steps: usize,
    /// What is taken off for each right one that it breaks.
    pub(super) broken: f64,
    /// Its changed fields, for each of which a little is taken off.
    pub(super) changes: usize,
}

impl Price {
    /// The worth of a formula that gives so many of the wrong ones and breaks so many of the right ones.
    pub(super) fn worth(self, drawn: usize, broken: usize) -> f64 {
        drawn as f64 - self.broken * broken as f64 - 0.3 * self.changes as f64
    }
}

/// Pixels of some answers that are drawn wrongly, and pixels beside an edge that are drawn well; of triangles.
pub(super) fn pixels_seen<'a>(
    answers: impl Iterator<Item = &'a LearnedAnswer>,
) -> [Vec<PixelSeen<'a>>; 2] {
    let mut all = [Vec::new(), Vec::new()];
    let of_triangles = answers.filter(|a| !a.question.is_line());
    for (group, a) in of_triangles.enumerate() {
        let is_wrong = |at: &[i32; 2]| a.drawn.has(*at) != a.right.has(*at);
        let is_at_edge = |at: &[i32; 2]| {
            let beside = [[1, 0], [-1, 0], [0, 1], [0, -1]];
            beside.iter().any(|[x, y]| a.drawn.has([at[0] + x, at[1] + y]) != a.drawn.has(*at))
        };
        let (wrong, right): (Vec<_>, Vec<_>) =
            a.drawn.pixels().filter(|at| is_wrong(at) || is_at_edge(at)).partition(is_wrong);
        for (kind, pixels) in [wrong, right].into_iter().enumerate() {
            let step = pixels.len().div_ceil(MOST_SEEN).max(1);
            let seen = pixels.into_iter().step_by(step);
            all[kind].extend(seen.map(|at| PixelSeen { group, answer: a, at }));
        }
    }
    all
}

/// The borders of one end that can be read off an answer, with what is predicted of them where heights are rounded in some way.
pub(super) fn borders_seen<'a>(
    group: usize,
    a: &'a LearnedAnswer,
    predicted: &Picture,
    sample: [i64; 2],
    (end, heights): (usize, Option<Toward>),
) -> Vec<BorderSeen<'a>> {
    let mut all = Vec::new();
    let answer = Rc::new((a, Scene::new(&a.question, &a.right, sample)));
    let is_line = a.question.is_line();
    let right_of = |site: &Site| match is_line {
        true => site.seen(&a.right, true),
        false => site.evaluate(&Crossing::RIGHT, &a.question, sample),
    };
    let sites = border::sites(&a.question, sample, heights);
    for row in sites.chunks(if is_line { 1 } else { 2 }) {
        let Some(site) = row.iter().find(|site| site.end == end) else { continue };
        let [drawn, predicted] = [&a.drawn, predicted].map(|picture| site.seen(picture, is_line));
        // An empty row tells something where it is to be empty.
        let is_blank = !is_line && row_is_empty(site, &a.drawn);
        let is_known = drawn.is_some() || is_blank && row_is_empty(site, &a.right);
        if !is_known || predicted.is_none() && !is_blank {
            continue;
        }
        let (Some(right), Some(other)) =
            (right_of(site), right_of(&row[(row.len() - 1).saturating_sub(end)]))
        else {
            continue;
        };
        let site = *site;
        let answer = Rc::clone(&answer);
        all.push(BorderSeen { group, answer, site, right, predicted, drawn, other });
    }
    all
}
