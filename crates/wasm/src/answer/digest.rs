//! One number for everything that the engines draw: the page's must be the program's.

use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

use rasterproof_core::contract::{DrawLine as _, Interpolate as _, Rasterize as _};
use rasterproof_core::triangle::{Fragment, Span};
use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_verify::cases::{self, Case, Shape};

/// The digest so far, and what went into it.
#[derive(Default)]
struct Total {
    all: Sha256,
    spans: u64,
    fragments: u64,
}

/// SHA-256 over spans, pixels and the bits of values of the first `cases` cases, all families in turn.
pub(super) fn digest(seed: u64, cases: u64) -> Value {
    let families: Vec<_> = cases::families().collect();
    let count = families.len() as u64;
    let mut total = Total::default();
    for number in 0..cases {
        let family = families[(number % count) as usize];
        total.add(&family.case(seed, number / count));
    }
    // Two digits for each byte.
    let mut hex = String::new();
    for byte in total.all.finalize() {
        hex += &format!("{byte:02x}");
    }
    json!({ "digest": hex, "cases": cases, "spans": total.spans, "fragments": total.fragments })
}

impl Total {
    /// Adds what both engines and the oracle draw of a case.
    fn add(&mut self, case: &Case) {
        match &case.shape {
            Shape::Triangles { list, .. } => {
                for triangle in list {
                    for engine in [Engine::Scanline, Engine::EdgeFunction, Engine::Oracle] {
                        engine.cover(triangle.corners(), case.window, |s| self.span(s));
                    }
                    // The oracle's values are quotients of big integers, which are rounded otherwise.
                    for engine in [Engine::Scanline, Engine::EdgeFunction] {
                        engine.fragments(triangle, case.window, |f| self.fragment(&f));
                    }
                }
            }
            Shape::Lines(lines) => {
                for line in lines {
                    for engine in [LineEngine::Dda, LineEngine::Bresenham, LineEngine::Oracle] {
                        engine.draw(line, case.window, |f| self.fragment(&f));
                    }
                }
            }
            // The digest is of the families on the lattice.
            Shape::Unsnapped { .. } | Shape::Numbers { .. } => {}
        }
    }

    /// Row, first column and one past the last, as little-endian bytes.
    fn span(&mut self, s: Span) {
        for number in [s.y_px, s.x0_px, s.x1_px] {
            self.all.update(number.to_le_bytes());
        }
        self.spans += 1;
    }

    /// The pixel, then the bits of its values, so that a difference in the last bit changes the digest.
    fn fragment(&mut self, f: &Fragment<glam::DVec2>) {
        for number in [f.x_px, f.y_px] {
            self.all.update(number.to_le_bytes());
        }
        for value in [f.depth, f.varying.x, f.varying.y] {
            self.all.update(value.to_bits().to_le_bytes());
        }
        self.fragments += 1;
    }
}
