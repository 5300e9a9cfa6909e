//! Specimen: formulas (8) and (9) of the book (part 2, chapter 5, sections 5.4 and 5.5), as its code
//! evaluates them.
//!
//! Symptom: numerator and denominator are differences of products, so they cancel where w_a and w_b
//! differ much: at t' = 1 the result is not v_b. In f32 the error is 1e-2 at a ratio of 1e6 and 0.5 at
//! 1e7; in f64, which the book uses, the same ratios squared. A t' that is 0 at the truncated pixel
//! instead of the crossing can make the denominator zero ([`super::book_final`]).
//! Cure: sums of positive terms, w_b (1 - t') v_a + w_a t' v_b. Exposed by w = 0.1 and 1e6 at t' = 1;
//! harmless where the w are equal, when (8) is the affine formula.

use glam::DVec2;

/// Formula (8): a value at t' between two corners with w of `wa` and `wb`.
#[must_use]
pub fn value(wa: f64, wb: f64, va: DVec2, vb: DVec2, t: f64) -> DVec2 {
    (wb * va + (wa * vb - wb * va) * t) / (wb + (wa - wb) * t)
}

/// Formula (9): w itself.
#[must_use]
pub fn w(wa: f64, wb: f64, t: f64) -> f64 {
    (wa * wb) / (wb + (wa - wb) * t)
}

/// Formula (8) in single precision.
#[must_use]
pub fn value_f32(wa: f32, wb: f32, va: f32, vb: f32, t: f32) -> f32 {
    (wb * va + (wa * vb - wb * va) * t) / (wb + (wa - wb) * t)
}

/// The same value as a quotient of sums without cancellation.
#[must_use]
pub fn value_f32_repaired(wa: f32, wb: f32, va: f32, vb: f32, t: f32) -> f32 {
    let (from, to) = (wb * (1.0 - t), wa * t);
    (from * va + to * vb) / (from + to)
}
