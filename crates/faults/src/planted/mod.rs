//! Mutants: implementations with a planted fault each, to prove that the harness can fail.
//!
//! A mutant is a small type behind the same contract as the real thing, never a flag inside an
//! engine. Reached by the hidden option `--plant NAME`, by `rasterproof mutants`, which asks every
//! invariant about every mutant, and by the tests.

/// Declares a kind of planted fault from its table: each fault with its name for `--plant` and, in a sentence, what is wrong.
macro_rules! planted {
    ($kind:ident { $($fault:ident $name:literal: $sentence:literal,)+ }) => {
        rasterproof_core::named! {
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub enum $kind {
                $(#[doc = $sentence] $fault = $name,)+
            }
        }

        impl $kind {
            pub fn about(self) -> &'static str {
                match self {
                    $(Self::$fault => $sentence,)+
                }
            }
        }
    };
}

mod effects;
pub mod exact;
mod helpers;
mod lines;
mod oracles;
mod pipeline;
mod tiles;
mod triangles;

pub use effects::{EffectMutant, Formulas};
use exact::ExactMutant;
pub use helpers::{EdgeValuesMutant, JudgeMutant, SnapMutant, SourceMutant, WordWidthMutant};
pub use lines::LineMutant;
pub use oracles::OracleMutant;
pub use pipeline::StageMutant;
pub use tiles::TileMutant;
pub use triangles::TriangleMutant;

use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Span;

/// Declares [`Mutant`] from the kinds of faults.
macro_rules! kinds {
    ($($kind:ident($mutant:ty),)+) => {
        /// A planted fault of any kind: of an engine, of snapping, of a stage.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Mutant {
            $($kind($mutant),)+
        }

        impl Mutant {
            /// Every planted fault, those of rasterizers first.
            pub fn all() -> Vec<Self> {
                let mut all = Vec::new();
                $(all.extend(<$mutant>::ALL.map(Self::$kind));)+
                all
            }

            /// The name that `--plant` takes and that reports print.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$kind(mutant) => mutant.name(),)+
                }
            }

            fn about(&self) -> &'static str {
                match self {
                    $(Self::$kind(mutant) => mutant.about(),)+
                }
            }
        }
    };
}

kinds! {
    Triangle(TriangleMutant),
    Oracle(OracleMutant),
    Snap(SnapMutant),
    EdgeValues(EdgeValuesMutant),
    WordWidth(WordWidthMutant),
    Line(LineMutant),
    Source(SourceMutant),
    Stage(StageMutant),
    Judge(JudgeMutant),
    Tile(TileMutant),
    Effect(EffectMutant),
}

impl Mutant {
    /// The fault of this name, but for those of corners that are not snapped.
    pub fn find(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|mutant| mutant.name() == name)
    }
}

/// The name and the sentence of every planted fault, engines first and those for corners that are not snapped last.
pub fn all() -> impl Iterator<Item = (&'static str, &'static str)> {
    let judged = Mutant::all().into_iter().map(|mutant| (mutant.name(), mutant.about()));
    judged.chain(ExactMutant::ALL.into_iter().map(|mutant| (mutant.name(), mutant.about())))
}

/// What is wrong with the mutant of this name; nothing where there is none.
pub fn about(name: &str) -> Option<&'static str> {
    all().find(|(listed, _)| *listed == name).map(|(_, about)| about)
}

/// What `--plant` takes: the names of the faults of all kinds, in the order of the catalogue.
pub fn names() -> Vec<&'static str> {
    all().map(|(name, _)| name).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_of_one_mutant() {
        let mut names = names();
        names.sort_unstable();
        let listed = names.len();
        names.dedup();
        assert_eq!(names.len(), listed);
    }
}
