//! What was found about a case, and what finding it needs: hits by pixel, and a mark that changes with
//! what is wrong.

use glam::DVec2;

use super::ask::Misbehaviour;
use rasterproof_core::triangle::{Fragment, Span};
use rasterproof_verify::comparison::pixels::mix;
use rasterproof_verify::comparison::{Finding, Tally};

/// What was found about a case, and how far it was answered.
#[derive(Clone, Debug, Default)]
pub struct CaseJudgement {
    /// Wrong pixels, of a mesh its holes and doubles; and errors of values as fractions of the tolerance.
    pub finding: Finding,
    /// Triangles or lines that were compared.
    pub shapes: u64,
    /// Pixels expected, of four samples the samples, of the near plane the corners.
    pub pixels: u64,
    /// Pixels with a value beyond the tolerance.
    pub wrong_values: u64,
    /// Wrong pixels by what was recognised.
    pub other: Tally,
    /// Pixels expected by what was recognised.
    pub other_pixels: u64,
    /// Triangles or lines of which the recognised convention says nothing.
    pub unscored: u64,
    /// Their pixels that are wrong as declared.
    pub unscored_wrong: u64,
    /// Requests that were refused though they were declared possible.
    pub refused: u64,
    /// Why the first refused request was refused.
    pub reason: String,
    /// The first run of the answers that ends before it begins; its pixels count as pixels outside the window.
    pub backward: Option<Span>,
    /// The largest difference of a wrong level from the exact share, in steps.
    pub steps_off: f64,
    /// Where the value is whose error is the largest.
    pub worst_at: Option<(i32, i32)>,
    /// Requests that were answered, refused ones among them.
    pub answered: u64,
    /// What happened instead of answers, with the number of the question.
    pub died: Vec<(usize, Misbehaviour)>,
    /// Whether each of two programs is right, where two are compared and the rest is how their answers differ.
    pub right: Option<[bool; 2]>,
    /// A hash of the wrong pixels.
    pub(super) mark: u64,
}

impl CaseJudgement {
    /// Whether anything about the case is to be reported: a count, a value beyond its tolerance, or a death.
    #[must_use]
    pub fn is_wrong(&self) -> bool {
        let has_no_answer = self.refused > 0 || !self.died.is_empty();
        self.finding.is_wrong() || self.backward.is_some() || has_no_answer
    }

    /// A number that changes when what is wrong changes; not with the last bits of values.
    pub fn fingerprint(&self) -> u64 {
        let Tally { missing, extra, twice, order } = self.finding.tally;
        // Whether values are off counts, and not by how much: the last bits differ between machines.
        let off = u64::from(self.finding.worst() > 1.0);
        let mut mark = self.mark;
        [missing, extra, twice, order, off, self.refused].iter().for_each(|n| mix(&mut mark, *n));
        for (_, misbehaviour) in &self.died {
            misbehaviour.breach.name().bytes().for_each(|b| mix(&mut mark, u64::from(b)));
        }
        mark
    }

    /// Counts a refusal; of several, the reason of the first one is kept.
    pub(super) fn refuse(&mut self, reason: &str) {
        if self.refused == 0 {
            self.reason = reason.to_owned();
        }
        self.refused += 1;
    }

    /// Adds the errors of depth and both attributes at a pixel, each as a fraction of its tolerance.
    pub(super) fn off(&mut self, fragment: &Fragment<DVec2>, errors: [f64; 3]) {
        let before = self.finding.worst();
        let [depth, a, b] = errors;
        for (attribute, depth) in [(a, depth), (b, 0.0)] {
            self.finding.compare(attribute, depth);
        }
        self.finding.values += 1;
        self.wrong_values += u64::from(!errors.iter().all(|error| *error <= 1.0));
        if self.finding.worst() > before {
            self.worst_at = Some((fragment.x_px, fragment.y_px));
        }
    }
}

/// Appends a pixel to the last run, or begins another; pixels come row by row, from the left.
pub(super) fn push(runs: &mut Vec<(Span, u8)>, x_px: i32, y_px: i32, of: u8) {
    match runs.last_mut() {
        Some((run, last)) if run.y_px == y_px && run.x1_px == x_px && *last == of => run.x1_px += 1,
        _ => runs.push((Span { y_px, x0_px: x_px, x1_px: x_px + 1 }, of)),
    }
}
