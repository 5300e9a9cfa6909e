//! Mutants: implementations with a planted fault each, to prove that the harness can fail.
//!
//! A mutant is a small type behind the same contract as the real thing, never a flag inside an
//! engine. Reached by the hidden option `--plant NAME`, by `rasterproof mutants`, which asks every
//! invariant about every mutant, and by the tests.

pub mod about;
pub mod exact;
mod helpers;
mod lines;
mod oracles;
mod pipeline;
mod tiles;
mod triangles;

pub use helpers::{EdgeValuesMutant, JudgeMutant, SnapMutant, SourceMutant, WordWidthMutant};
pub use lines::LineMutant;
pub use oracles::OracleMutant;
pub use pipeline::StageMutant;
pub use tiles::TileMutant;
pub use triangles::TriangleMutant;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Span;

/// A mutant of any kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mutant {
    /// A rasterizer.
    Triangle(TriangleMutant),
    /// A line drawer.
    Line(LineMutant),
    /// An oracle.
    Oracle(OracleMutant),
    /// A way to snap.
    Snap(SnapMutant),
    /// The three edge functions.
    EdgeValues(EdgeValuesMutant),
    /// The choice of a word.
    WordWidth(WordWidthMutant),
    /// A source of cases.
    Source(SourceMutant),
    /// A stage of the pipeline.
    Stage(StageMutant),
    /// A judge of coverage.
    Judge(JudgeMutant),
    /// A tile engine.
    Tile(TileMutant),
}

impl Mutant {
    /// Every mutant, engines first.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all: Vec<Self> = TriangleMutant::ALL.map(Self::Triangle).to_vec();
        all.extend(OracleMutant::ALL.map_array(Self::Oracle));
        all.extend(SnapMutant::ALL.map(Self::Snap));
        all.extend(EdgeValuesMutant::ALL.map_array(Self::EdgeValues));
        all.extend(WordWidthMutant::ALL.map_array(Self::WordWidth));
        all.extend(LineMutant::ALL.map(Self::Line));
        all.extend(SourceMutant::ALL.map_array(Self::Source));
        all.extend(StageMutant::ALL.map(Self::Stage));
        all.extend(JudgeMutant::ALL.map_array(Self::Judge));
        all.extend(TileMutant::ALL.map(Self::Tile));
        all
    }

    /// The mutant of this name.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|mutant| mutant.name() == name)
    }

    /// Its name for `--plant`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Triangle(mutant) => mutant.name(),
            Self::Line(mutant) => mutant.name(),
            Self::Oracle(mutant) => mutant.name(),
            Self::Snap(mutant) => mutant.name(),
            Self::EdgeValues(mutant) => mutant.name(),
            Self::WordWidth(mutant) => mutant.name(),
            Self::Source(mutant) => mutant.name(),
            Self::Stage(mutant) => mutant.name(),
            Self::Judge(mutant) => mutant.name(),
            Self::Tile(mutant) => mutant.name(),
        }
    }
}

/// Emits each pixel of `rect`, as a span of its own, of which `inside(x, y)` is true.
fn each_sample(rect: PixelRect, inside: &dyn Fn(i32, i32) -> bool, emit: &mut dyn FnMut(Span)) {
    for y_px in rect.y0..rect.y1 {
        for x_px in rect.x0..rect.x1 {
            if inside(x_px, y_px) {
                emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
            }
        }
    }
}
