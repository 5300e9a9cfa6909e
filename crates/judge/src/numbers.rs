//! Numbers of a formula against exact ones.

use super::judged::CaseJudgement;
use rasterproof_verify::comparison::pixels::mix;
use rasterproof_verify::oracle::formula::ExactNumber;

/// How far a number may be off. Where its scale is zero it must be zero, and the smallest number keeps that so.
fn bound(given: &ExactNumber, tolerance: f64) -> f64 {
    (tolerance * given.scale).max(f64::MIN_POSITIVE)
}

/// Counts the numbers that an answer lacks, those beyond the last, and those that are off.
pub(super) fn compare(
    judged: &mut CaseJudgement,
    numbers: &[f64],
    exact: &[ExactNumber],
    tolerance: f64,
) {
    judged.shapes += 1;
    // Every number counts as a pixel, so that a share of wrong ones can be said.
    judged.pixels += exact.len() as u64;
    count(judged, numbers.len(), exact.len());
    for (at, (number, given)) in numbers.iter().zip(exact).enumerate() {
        let is_wrong = given.exact.distance(*number) > bound(given, tolerance);
        judged.finding.tally.order += u64::from(is_wrong);
        // The mark says which of them are wrong.
        mix(&mut judged.mark, u64::from(is_wrong) << at);
    }
}

/// The same between the answers of two programs: two right ones lie within twice the tolerance of each other.
pub(super) fn difference(
    judged: &mut CaseJudgement,
    [first, second]: [&[f64]; 2],
    exact: &[ExactNumber],
    tolerance: f64,
) {
    count(judged, first.len(), second.len());
    for ((first, second), given) in first.iter().zip(second).zip(exact) {
        let is_near = (first - second).abs() <= bound(given, 2.0 * tolerance);
        judged.finding.tally.order += u64::from(!is_near);
    }
}

/// Counts numbers that are missing or too many.
fn count(judged: &mut CaseJudgement, has: usize, of: usize) {
    judged.finding.tally.missing += of.saturating_sub(has) as u64;
    judged.finding.tally.extra += has.saturating_sub(of) as u64;
}
