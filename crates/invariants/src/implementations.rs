//! What the invariants are asked of: a set of implementations, the real ones or one with a fault.
//!
//! The contracts of this crate are generic in the type of the values and so cannot be stored side
//! by side. [`Fill`] and [`Stroke`] are the same contracts for the two types that the checks need,
//! and every implementation of the contracts is one of these too.

use glam::{DVec2, DVec3};

use super::Outcome;
use rasterproof_core::contract::{DrawLine, Interpolate, Rasterize};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{self, PixelRect, Refusal};
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::line::dda::Dda;
use rasterproof_core::raster::edge_function::{self, WordWidth};
use rasterproof_core::triangle::{Corners, Fragment, ScreenTriangle, Span};
use rasterproof_faults::planted::{Formulas, Mutant, StageMutant};
use rasterproof_registry::engines;
use rasterproof_render::effects::Effects;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::clip::{Outcode, clip};
use rasterproof_render::pipeline::target::Target;
use rasterproof_render::pipeline::{ClipVertex, Counters};
use rasterproof_render::scene::Scene;
use rasterproof_tiles::coverage::{CoverList, Tiles};
use rasterproof_verify::cases::{Case, Family, Line, Triangle};
use rasterproof_verify::comparison::Tally;
use rasterproof_verify::comparison::tolerance::{self, Tolerance};
use rasterproof_verify::oracle::Oracle;

/// A rasterizer of triangles, with values of two numbers, and of three for its weights.
pub trait Fill: Sync {
    /// The runs of pixels that a triangle covers.
    fn spans(&self, corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span));
    /// The pixels of a triangle with depth and both values.
    fn values(&self, triangle: &Triangle, bounds: PixelRect, emit: &mut dyn FnMut(Fragment<DVec2>));
    /// As [`Interpolate::fragments`], for three numbers a vertex.
    fn weights(
        &self,
        triangle: &ScreenTriangle<DVec3>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<DVec3>),
    );
}

impl<R: Interpolate + Sync> Fill for R {
    fn spans(&self, corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
        Rasterize::cover(self, corners, bounds, emit);
    }

    fn values(
        &self,
        triangle: &Triangle,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<DVec2>),
    ) {
        Interpolate::fragments(self, triangle, bounds, emit);
    }

    fn weights(
        &self,
        triangle: &ScreenTriangle<DVec3>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<DVec3>),
    ) {
        Interpolate::fragments(self, triangle, bounds, emit);
    }
}

/// A drawer of lines, with values of two numbers.
pub trait Stroke: Sync {
    /// The pixels of a line in order, with depth and both values.
    fn stroke(&self, line: &Line, bounds: PixelRect, emit: &mut dyn FnMut(Fragment<DVec2>));
}

impl<D: DrawLine + Sync> Stroke for D {
    fn stroke(&self, line: &Line, bounds: PixelRect, emit: &mut dyn FnMut(Fragment<DVec2>)) {
        DrawLine::draw(self, line, bounds, emit);
    }
}

/// A rasterizer of triangles, and by how much its values may be off.
pub struct Engine {
    pub name: &'static str,
    pub fill: Box<dyn Fill>,
    /// How far its values may lie from the exact ones.
    pub tolerance: Tolerance,
}

impl Engine {
    /// Hit counts of one triangle.
    ///
    /// # Panics
    /// Where the engine does, or leaves the window.
    pub fn hits(&self, corners: Corners, window: PixelRect) -> Coverage {
        hits(&*self.fill, [corners], window)
    }

    /// What it emits of a triangle in a window.
    pub fn fragments(&self, triangle: &Triangle, window: PixelRect) -> Vec<Fragment<DVec2>> {
        let mut fragments = Vec::new();
        self.fill.values(triangle, window, &mut |fragment| fragments.push(fragment));
        fragments
    }
}

/// How often each pixel of a window is hit by some triangles.
pub fn hits(
    fill: &dyn Fill,
    triangles: impl IntoIterator<Item = Corners>,
    window: PixelRect,
) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for corners in triangles {
        fill.spans(corners, window, &mut |span| hits.hit(span.y_px, span.x0_px, span.x1_px));
    }
    hits
}

/// Who draws lines, under the name by which a failure says whose it is.
pub struct Drawer {
    pub name: &'static str,
    pub stroke: Box<dyn Stroke>,
}

impl Drawer {
    /// What it emits of a line in a window.
    pub fn fragments(&self, line: &Line, window: PixelRect) -> Vec<Fragment<DVec2>> {
        let mut fragments = Vec::new();
        self.stroke.stroke(line, window, &mut |fragment| fragments.push(fragment));
        fragments
    }
}

/// Makes a case of a family, by the seed and by its number in the family.
pub type MakeCase = fn(&Family, u64, u64) -> Case;

/// What a set of planes leaves of a triangle.
pub type ClipStage = fn(&[ClipVertex<DVec2>; 3], Outcode) -> Vec<ClipVertex<DVec2>>;

/// Draws a scene with some effects into a target of a kind, and says what it cost.
pub type RenderStage = fn(&Scene, &Effects, &mut Target) -> Counters;

/// One implementation of each kind, or several that do the same job.
pub struct Implementations {
    /// Rasterizers: scanline, edge function and tiles, or a faulty one.
    pub engines: Vec<Engine>,
    /// Rasterizers of lists: the tile engine in every instruction set here, or a faulty one.
    pub lists: Vec<(&'static str, Box<dyn CoverList + Sync>)>,
    /// What decides where implementations disagree; checks hold it to other arithmetic.
    pub oracle: Box<dyn Fill>,
    /// Line drawers: DDA and Bresenham, or a faulty one.
    pub drawers: Vec<Drawer>,
    /// A coordinate in pixels to subpixels.
    pub snap: fn(f64) -> Result<i32, Refusal>,
    /// The three edge functions at the centre of a pixel.
    pub edge_values: fn(&Corners, i32, i32) -> [i128; 3],
    /// The word that edge functions are stepped in, from the extents of the triangle.
    pub word_width: fn(u32, u32) -> WordWidth,
    /// Where cases come from, which may be at fault as well.
    pub make_case: MakeCase,
    pub clip: ClipStage,
    /// Whether a mode of culling removes a triangle.
    pub culls: fn(Cull, Corners) -> bool,
    /// The effects a scene is drawn with, of those that are asked for.
    pub choose: fn(Effects) -> Effects,
    /// A whole frame, for what effects cost in it.
    pub render: RenderStage,
    pub formulas: Formulas,
    /// The judge: whether two coverages are the same.
    pub coverage_agrees: fn(&Coverage, &Coverage) -> bool,
}

/// A component of a [`Implementations`]: what a check looks at, and where a fault sits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    Engine,
    Oracle,
    Drawer,
    Snap,
    EdgeValues,
    WordWidth,
    Source,
    Clip,
    Cull,
    Render,
    Formulas,
    Judge,
    Lists,
    Matrix,
}

impl Implementations {
    /// Everything as this project has it.
    pub fn real() -> Self {
        Self {
            engines: Vec::from(engines::Engine::CHOICES.map(|engine| Engine {
                name: engine.name(),
                fill: Box::new(engine),
                tolerance: engine.tolerance(),
            })),
            // Tiles with each set of vector instructions that this machine has.
            lists: Tiles::levels()
                .into_iter()
                .map(|tiles| (tiles.instructions(), Box::new(tiles) as Box<dyn CoverList + Sync>))
                .collect(),
            oracle: Box::new(Oracle),
            drawers: vec![
                Drawer { name: "dda", stroke: Box::new(Dda) },
                Drawer { name: "bresenham", stroke: Box::new(Bresenham) },
            ],
            snap: grid::snap,
            edge_values: edge_function::edge_values,
            word_width: WordWidth::of,
            make_case: Family::case,
            clip: |triangle, planes| clip(triangle, planes).0.vertices().copied().collect(),
            culls: Cull::removes,
            choose: |asked| asked,
            render: |scene, effects, target| {
                engines::Drawer::EdgeFunction
                    .render(scene, effects, target)
                    .map_or(Counters::default(), |rendered| rendered.counters)
            },
            formulas: Formulas::REAL,
            coverage_agrees: |actual, target| Tally::between(actual, target).total() == 0,
        }
    }

    /// What a check counts for all rasterizers; a failure begins with the name of the one.
    pub fn each_engine(&self, check: impl Fn(&Engine) -> Outcome) -> Outcome {
        let named = |of: &Engine| check(of).map_err(|message| format!("{} {message}", of.name));
        self.engines.iter().map(named).sum()
    }

    /// What a check counts for all line drawers; a failure begins with the name of the one.
    pub fn each_drawer(&self, check: impl Fn(&Drawer) -> Outcome) -> Outcome {
        let named = |of: &Drawer| check(of).map_err(|message| format!("{} {message}", of.name));
        self.drawers.iter().map(named).sum()
    }

    /// The real implementations but for one, in whose place stands the mutant.
    pub fn with(mutant: Mutant) -> Self {
        let mut subject = Self::real();
        match mutant {
            Mutant::Triangle(fault) => {
                // The wider of the two tolerances, so that no mutant dies of a bound that was not
                // derived for it.
                let tolerance = tolerance::SCANLINE;
                subject.engines =
                    vec![Engine { name: fault.name(), fill: Box::new(fault), tolerance }];
            }
            Mutant::Line(fault) => {
                subject.drawers = vec![Drawer { name: fault.name(), stroke: Box::new(fault) }];
            }
            Mutant::Oracle(fault) => subject.oracle = Box::new(fault),
            Mutant::Snap(fault) => subject.snap = fault.function(),
            Mutant::EdgeValues(fault) => subject.edge_values = fault.function(),
            Mutant::WordWidth(fault) => subject.word_width = fault.function(),
            Mutant::Source(fault) => subject.make_case = fault.function(),
            Mutant::Stage(fault) => {
                fault.replace(&mut subject.clip, &mut subject.culls, &mut subject.choose)
            }
            Mutant::Judge(fault) => subject.coverage_agrees = fault.function(),
            Mutant::Tile(fault) => subject.lists = vec![(fault.name(), Box::new(fault))],
            Mutant::Effect(fault) => subject.formulas = fault.formulas(),
        }
        subject
    }
}

/// The component that a mutant takes the place of.
pub fn component_of(mutant: &Mutant) -> Component {
    match mutant {
        Mutant::Triangle(_) => Component::Engine,
        Mutant::Line(_) => Component::Drawer,
        Mutant::Oracle(_) => Component::Oracle,
        Mutant::Snap(_) => Component::Snap,
        Mutant::EdgeValues(_) => Component::EdgeValues,
        Mutant::WordWidth(_) => Component::WordWidth,
        Mutant::Source(_) => Component::Source,
        Mutant::Stage(fault) => match fault {
            StageMutant::CullSwapped | StageMutant::CullByFloatArea => Component::Cull,
            StageMutant::EffectsIgnored | StageMutant::ClearsAlways => Component::Render,
            _ => Component::Clip,
        },
        Mutant::Judge(_) => Component::Judge,
        Mutant::Tile(_) => Component::Lists,
        Mutant::Effect(_) => Component::Formulas,
    }
}
