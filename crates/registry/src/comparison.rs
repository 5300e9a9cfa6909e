//! The comparison of the engines that have a name here.

use rasterproof_core::frame::Coverage;
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::planted::{LineMutant, TriangleMutant};
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::tolerance::{self, Tolerance};
use rasterproof_verify::comparison::{
    Cause, EnginePanic, Engines, Finding, Options, Verdict, engine_coverage, exact_coverage,
    line_coverage,
};

use crate::engines::{Engine, ExactEngine, LineEngine};

impl Engine {
    /// The derived bounds of its values. A planted fault gets the wider ones.
    pub fn tolerance(self) -> Tolerance {
        match self {
            Self::Scanline | Self::Mutant(_) => tolerance::SCANLINE,
            Self::EdgeFunction | Self::Tile | Self::TileMutant(_) => tolerance::EDGE_FUNCTION,
            Self::Oracle => tolerance::ORACLE,
        }
    }
}

/// The engines of each kind that are judged together.
#[derive(Clone, Debug, Default)]
pub struct EnginesToJudge {
    pub triangles: Vec<Engine>,
    pub lines: Vec<LineEngine>,
    pub unsnapped: Vec<ExactEngine>,
}

/// The hits of all shapes of a case, or why they were not drawn.
pub type Hits = Result<Coverage, String>;

impl EnginesToJudge {
    /// Every engine that a verdict is about.
    pub fn all() -> Self {
        Self {
            triangles: Engine::JUDGED.to_vec(),
            lines: LineEngine::JUDGED.to_vec(),
            unsnapped: ExactEngine::JUDGED.to_vec(),
        }
    }

    /// The planted fault of this name, in each kind of engine that has one.
    pub fn planted(name: &str) -> Self {
        let triangle = TriangleMutant::ALL.into_iter().find(|m| m.name() == name);
        let line = LineMutant::ALL.into_iter().find(|m| m.name() == name);
        let unsnapped = ExactMutant::ALL.into_iter().find(|m| m.name() == name);
        Self {
            triangles: triangle.map(Engine::Mutant).into_iter().collect(),
            lines: line.map(LineEngine::Mutant).into_iter().collect(),
            unsnapped: unsnapped.map(ExactEngine::Mutant).into_iter().collect(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.lines.is_empty() && self.unsnapped.is_empty()
    }

    fn has(&self, name: &str) -> bool {
        self.triangles.iter().any(|e| e.name() == name)
            || self.lines.iter().any(|e| e.name() == name)
            || self.unsnapped.iter().any(|e| e.name() == name)
    }

    /// These engines, then those of [`Self::all`] that are not among them.
    #[must_use]
    pub fn with_others(&self) -> Self {
        let (all, mut these) = (Self::all(), self.clone());
        these.triangles.extend(all.triangles.into_iter().filter(|e| !self.has(e.name())));
        these.lines.extend(all.lines.into_iter().filter(|e| !self.has(e.name())));
        these.unsnapped.extend(all.unsnapped.into_iter().filter(|e| !self.has(e.name())));
        these
    }

    fn engines(&self) -> Engines<Engine, LineEngine, ExactEngine> {
        let triangles = self.triangles.iter().map(|e| (e.name(), *e, Some(e.tolerance())));
        Engines {
            triangles: triangles.collect(),
            lines: self.lines.iter().map(|e| (e.name(), *e)).collect(),
            unsnapped: self.unsnapped.iter().map(|e| (e.name(), *e)).collect(),
        }
    }

    pub fn judge(&self, options: &Options, progress: &(dyn Fn(u64) + Sync)) -> Verdict {
        self.engines().judge(options, progress)
    }

    /// Why an engine is wrong, found by asking it more.
    #[must_use]
    pub fn cause(&self, engine: &str) -> Option<Cause> {
        self.engines().cause(engine)
    }

    #[must_use]
    pub fn judge_case(&self, case: &Case) -> Vec<([String; 2], Finding)> {
        self.engines().judge_case(case)
    }

    /// The hits of each engine that draws such shapes, after its name.
    pub fn hits(&self, case: &Case) -> Vec<(String, Hits)> {
        let drawn = |name: &str, hits: Result<Coverage, EnginePanic>| {
            (name.to_owned(), hits.map_err(String::from))
        };
        let window = case.window;
        match &case.shape {
            Shape::Triangles { list, .. } => {
                let hits = |e: &Engine| drawn(e.name(), engine_coverage(e, list, window));
                self.triangles.iter().map(hits).collect()
            }
            Shape::Lines(list) => {
                let hits = |e: &LineEngine| drawn(e.name(), line_coverage(e, list, window));
                self.lines.iter().map(hits).collect()
            }
            Shape::Unsnapped { list, .. } => {
                let hits = |e: &ExactEngine| {
                    drawn(e.name(), exact_coverage(e, list, window).map(|(hits, _)| hits))
                };
                self.unsnapped.iter().map(hits).collect()
            }
            Shape::Numbers { .. } => Vec::new(),
        }
    }
}

impl From<Engine> for EnginesToJudge {
    fn from(engine: Engine) -> Self {
        Self { triangles: vec![engine], ..Self::default() }
    }
}

impl From<LineEngine> for EnginesToJudge {
    fn from(engine: LineEngine) -> Self {
        Self { lines: vec![engine], ..Self::default() }
    }
}

impl From<ExactEngine> for EnginesToJudge {
    fn from(engine: ExactEngine) -> Self {
        Self { unsnapped: vec![engine], ..Self::default() }
    }
}
