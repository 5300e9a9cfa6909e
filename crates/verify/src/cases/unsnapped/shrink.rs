//! Makes a failing case off the lattice small enough to read, while it goes on failing.

use num_traits::Float;

use crate::cases::shrink::greedy;
use crate::cases::unsnapped::OffGridCase;
use rasterproof_core::triangle::FreeCorners;

/// The smallest case reached from `case` that still fails: fewer triangles, then fewer bits in all
/// coordinates, then nearer to the origin.
pub fn shrink(case: OffGridCase, fails: impl Fn(&OffGridCase) -> bool) -> OffGridCase {
    greedy(case, size, candidates, fails)
}

/// Triangles, bits that are set in mantissas, then distance from the origin.
#[must_use]
pub fn size(case: &OffGridCase) -> (usize, u32, u64) {
    let values = || case.triangles.iter().flat_map(|t| t.px()).flatten();
    let bits = |v: f64| {
        let (mantissa, ..) = Float::integer_decode(v);
        if mantissa == 0 { 0 } else { 64 - mantissa.leading_zeros() - mantissa.trailing_zeros() }
    };
    (case.triangles.len(), values().map(bits).sum(), values().map(|v| v.abs() as u64).sum())
}

fn candidates(case: &OffGridCase) -> Vec<OffGridCase> {
    let with = |triangles: Vec<FreeCorners>| OffGridCase {
        window: case.window,
        triangles,
        is_tiling: false,
    };
    if case.triangles.len() > 1 {
        return case.triangles.iter().map(|t| with(vec![*t])).collect();
    }
    let Some(triangle) = case.triangles.first() else { return Vec::new() };
    let mut found = Vec::new();
    for corner in 0..3 {
        for axis in 0..2 {
            let value = triangle.px()[corner][axis];
            for simpler in simpler_coordinates(value) {
                let mut px = triangle.px();
                px[corner][axis] = simpler;
                found.extend(FreeCorners::new(px).ok().map(|t| with(vec![t])));
            }
        }
    }
    found
}

/// Zero, whole and half numbers nearby, and fewer bits.
fn simpler_coordinates(value: f64) -> Vec<f64> {
    let cut = |bits: u64| f64::from_bits(value.to_bits() & !((1 << bits) - 1));
    let mut simpler = vec![0.0, value.round(), value.floor() + 0.5];
    simpler.extend([52, 48, 44, 40, 36, 32, 29, 24, 20, 16, 12, 8, 4, 2, 1].map(cut));
    simpler.retain(|&v| v != value);
    simpler
}
