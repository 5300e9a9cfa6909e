//! Specimen: formulas (8) and (9) of the book (part 2, chapter 5, sections 5.4 and 5.5), as its code
//! evaluates them.
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptom: numerator and denominator are differences of products, so they cancel where w_a and w_b differ
//! much: at t' = 1 the result is not v_b. In f32 the error is 1e-2 at a ratio of 1e6 and 0.5 at 1e7; in f64,
//! which the book uses, the same ratios squared. A t' that is 0 at the truncated pixel instead of the crossing
//! can make the denominator zero ([`super::book_final`]).

use glam::DVec2;

use super::scene::{COLOURS, Image, SIDE, Setting, Version, WHITE, empty};

/// Formula (8): a value at t' between two corners with w of `wa` and `wb`.
pub fn value(wa: f64, wb: f64, va: DVec2, vb: DVec2, t: f64) -> DVec2 {
    (wb * va + (wa * vb - wb * va) * t) / (wb + (wa - wb) * t)
}

/// Formula (9): w itself.
pub fn w(wa: f64, wb: f64, t: f64) -> f64 {
    (wa * wb) / (wb + (wa - wb) * t)
}

/// Formula (8) in single precision.
pub fn value_f32(wa: f32, wb: f32, va: f32, vb: f32, t: f32) -> f32 {
    (wb * va + (wa * vb - wb * va) * t) / (wb + (wa - wb) * t)
}

/// The same value as a quotient of sums without cancellation.
pub fn value_f32_repaired(wa: f32, wb: f32, va: f32, vb: f32, t: f32) -> f32 {
    let (from, to) = (wb * (1.0 - t), wa * t);
    (from * va + to * vb) / (from + to)
}

/// Formula (8) without cancellation, in double precision.
pub fn value_repaired(wa: f64, wb: f64, va: f64, vb: f64, t: f64) -> f64 {
    let (from, to) = (wb * (1.0 - t), wa * t);
    (from * va + to * vb) / (from + to)
}

/// The formula in double precision at the far corner, t' = 1, where the value is v_b = 1: from left
/// to right the ratio of the w grows from 9e13 to 2e17, downwards w_a doubles. One colour is right;
/// the farther from 1, the more of the other; white is no number.
pub fn draw(version: Version, setting: Setting) -> Image {
    let mut image = empty(SIDE);
    let bounds = image.bounds();
    for (y, x) in (bounds.y0..bounds.y1).flat_map(|y| (bounds.x0..bounds.x1).map(move |x| (y, x))) {
        let ratio = match setting {
            Setting::Exposing => 1.3 * 2f64.powi(46 + x * 3 / 8),
            Setting::Harmless => 1.0,
        };
        let near = 0.1 * (1.0 + f64::from(y) / f64::from(SIDE));
        let value = match version {
            Version::Published => value(near, near * ratio, DVec2::ZERO, DVec2::ONE, 1.0).x,
            Version::Repaired => value_repaired(near, near * ratio, 0.0, 1.0, 1.0),
        };
        // In eighths, so that the last bits do not show.
        let off = ((value - 1.0).abs().min(1.0) * 8.0).round() / 8.0;
        let mut colour = WHITE;
        if value.is_finite() {
            for (k, channel) in colour.iter_mut().enumerate() {
                let (from, to) = (f64::from(COLOURS[0][k]), f64::from(COLOURS[1][k]));
                *channel = (from + (to - from) * off) as u8;
            }
        }
        image.span_mut(y, x, x + 1)[0] = colour;
    }
    image
}
