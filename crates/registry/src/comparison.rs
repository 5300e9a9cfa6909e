//! The comparison of the engines that have a name here.

use rasterproof_verify::cases::Case;
use rasterproof_verify::comparison::tolerance::{self, Tolerance};
use rasterproof_verify::comparison::{self, Finding, Options, Verdict};

use crate::engines::{Engine, LineEngine};

impl Engine {
    /// The derived bounds of its values. A planted fault gets the wider ones.
    pub fn tolerance(self) -> Tolerance {
        match self {
            Self::Scanline | Self::Mutant(_) => tolerance::SCANLINE,
            Self::EdgeFunction | Self::Tile => tolerance::EDGE_FUNCTION,
            Self::Oracle => tolerance::ORACLE,
        }
    }
}

fn named(engines: &[(Engine, Tolerance)]) -> Vec<(&'static str, Engine, Tolerance)> {
    engines.iter().map(|(engine, tolerance)| (engine.name(), *engine, *tolerance)).collect()
}

fn named_lines(lines: &[LineEngine]) -> Vec<(&'static str, LineEngine)> {
    lines.iter().map(|engine| (engine.name(), *engine)).collect()
}

pub fn judge(
    engines: &[(Engine, Tolerance)],
    lines: &[LineEngine],
    options: &Options,
    progress: &(dyn Fn(u64) + Sync),
) -> Verdict {
    comparison::judge_engines(&named(engines), &named_lines(lines), options, progress)
}

#[must_use]
pub fn judge_case(
    engines: &[(Engine, Tolerance)],
    lines: &[LineEngine],
    case: &Case,
) -> Vec<([String; 2], Finding)> {
    comparison::judge_case(&named(engines), &named_lines(lines), case)
}
