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
    /// Engines for corners that are not snapped, which have families of their own.
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
        // One name may belong to faults of several kinds.
        let triangle = TriangleMutant::ALL.into_iter().find(|m| m.name() == name);
        let line = LineMutant::ALL.into_iter().find(|m| m.name() == name);
        let unsnapped = ExactMutant::ALL.into_iter().find(|m| m.name() == name);
        Self {
            triangles: triangle.map(Engine::Mutant).into_iter().collect(),
            lines: line.map(LineEngine::Mutant).into_iter().collect(),
            unsnapped: unsnapped.map(ExactEngine::Mutant).into_iter().collect(),
        }
    }

    /// Whether there is no engine, as for a name that no fault has.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty() && self.lines.is_empty() && self.unsnapped.is_empty()
    }

    /// Whether an engine of this name is among them.
    fn has(&self, name: &str) -> bool {
        self.triangles.iter().any(|e| e.name() == name)
            || self.lines.iter().any(|e| e.name() == name)
            || self.unsnapped.iter().any(|e| e.name() == name)
    }

    /// These engines, then those of [`Self::all`] that are not among them.
    #[must_use]
    pub fn with_others(&self) -> Self {
        // By their names, so that no engine is judged twice.
        let (all, mut these) = (Self::all(), self.clone());
        these.triangles.extend(all.triangles.into_iter().filter(|e| !self.has(e.name())));
        these.lines.extend(all.lines.into_iter().filter(|e| !self.has(e.name())));
        these.unsnapped.extend(all.unsnapped.into_iter().filter(|e| !self.has(e.name())));
        these
    }

    /// The engines with their names, and with the bounds of their values.
    fn engines(&self) -> Engines<Engine, LineEngine, ExactEngine> {
        let triangles = self.triangles.iter().map(|e| (e.name(), *e, Some(e.tolerance())));
        Engines {
            triangles: triangles.collect(),
            lines: self.lines.iter().map(|e| (e.name(), *e)).collect(),
            unsnapped: self.unsnapped.iter().map(|e| (e.name(), *e)).collect(),
        }
    }

    /// Judges them by the oracle and by each other; `progress` gets the number of cases that are done.
    pub fn judge(&self, options: &Options, progress: &(dyn Fn(u64) + Sync)) -> Verdict {
        self.engines().judge(options, progress)
    }

    /// Why an engine is wrong, found by asking it more.
    #[must_use]
    pub fn cause(&self, engine: &str) -> Option<Cause> {
        // The engine is asked more until a convention or a mistake explains its answers.
        self.engines().cause(engine)
    }

    /// What is found of each engine in one case.
    #[must_use]
    pub fn judge_case(&self, case: &Case) -> Vec<([String; 2], Finding)> {
        self.engines().judge_case(case)
    }

    /// The hits of each engine that draws such shapes, after its name.
    pub fn hits(&self, case: &Case) -> Vec<(String, Hits)> {
        // Each kind of shape has engines of its own.
        let window = case.window;
        let mut all = Vec::new();
        let mut add = |name: &str, hits: Result<Coverage, EnginePanic>| {
            all.push((name.to_owned(), hits.map_err(String::from)));
        };
        match &case.shape {
            Shape::Triangles { list, .. } => {
                for engine in &self.triangles {
                    add(engine.name(), engine_coverage(engine, list, window));
                }
            }
            Shape::Lines(list) => {
                for engine in &self.lines {
                    add(engine.name(), line_coverage(engine, list, window));
                }
            }
            Shape::Unsnapped { list, .. } => {
                for engine in &self.unsnapped {
                    add(engine.name(), exact_coverage(engine, list, window).map(|(hits, _)| hits));
                }
            }
            // These are polygons for tessellators, which no engine draws.
            Shape::Numbers { .. } => {}
        }
        all
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
