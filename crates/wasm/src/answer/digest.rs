//! One number for everything that the engines draw: the page's must be the program's.

use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

use rasterproof_core::contract::{DrawLine as _, Interpolate as _, Rasterize as _};
use rasterproof_core::triangle::Fragment;
use rasterproof_registry::engines::{Engine, LineEngine};
use rasterproof_verify::cases::{self, Case, Shape};

/// SHA-256 over spans, pixels and the bits of values of the first `cases` cases, all families in turn.
pub(super) fn digest(seed: u64, cases: u64) -> Value {
    let families: Vec<_> = cases::families().collect();
    let mut all = Sha256::new();
    let (mut spans, mut fragments) = (0u64, 0u64);
    for number in 0..cases {
        let family = families[(number % families.len() as u64) as usize];
        let case = family.case(seed, number / families.len() as u64);
        let (s, f) = add(&mut all, &case);
        spans += s;
        fragments += f;
    }
    let hex: String = all.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    json!({ "digest": hex, "cases": cases, "spans": spans, "fragments": fragments })
}

/// Adds what both engines and the oracle draw of a case; returns the numbers of spans and fragments.
fn add(all: &mut Sha256, case: &Case) -> (u64, u64) {
    let (mut spans, mut fragments) = (0, 0);
    match &case.shape {
        Shape::Triangles { list, .. } => {
            for triangle in list {
                for engine in [Engine::Scanline, Engine::EdgeFunction, Engine::Oracle] {
                    engine.cover(triangle.corners(), case.window, |s| {
                        [s.y_px, s.x0_px, s.x1_px].iter().for_each(|v| all.update(v.to_le_bytes()));
                        spans += 1;
                    });
                }
                for engine in [Engine::Scanline, Engine::EdgeFunction] {
                    engine.fragments(triangle, case.window, |f| {
                        value(all, &f);
                        fragments += 1;
                    });
                }
            }
        }
        Shape::Lines(lines) => {
            for line in lines {
                for engine in [LineEngine::Dda, LineEngine::Bresenham, LineEngine::Oracle] {
                    engine.draw(line, case.window, |f| {
                        value(all, &f);
                        fragments += 1;
                    });
                }
            }
        }
        // The digest is of the families on the lattice.
        Shape::Unsnapped { .. } | Shape::Numbers { .. } => {}
    }
    (spans, fragments)
}

fn value(all: &mut Sha256, f: &Fragment<glam::DVec2>) {
    [f.x_px, f.y_px].iter().for_each(|v| all.update(v.to_le_bytes()));
    let values = [f.depth, f.varying.x, f.varying.y];
    values.iter().for_each(|v| all.update(v.to_bits().to_le_bytes()));
}
