//! The engines by name: the one file that names every engine and line drawer, and turns a word of the
//! command line into one.

use rasterproof_core::contract::{Decisions, DrawLine, Interpolate, Rasterize, RasterizeExact};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::line::bresenham::Bresenham;
use rasterproof_core::line::dda::Dda;
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::raster::edge_function::words::{EdgeFunctionIn, Words};
use rasterproof_core::raster::edge_function_exact::EdgeFunctionExact;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::raster::scanline_exact::ScanlineExact;
use rasterproof_core::triangle::{
    Corners, Fragment, FreeCorners, ScreenLine, ScreenTriangle, Span, Varying,
};
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::planted::{LineMutant, TriangleMutant};
use rasterproof_faults::published::book_affine::BookAffine;
use rasterproof_faults::published::book_dda::BookDda;
use rasterproof_faults::published::book_depth::BookDepth;
use rasterproof_faults::published::book_final::BookFinal;
use rasterproof_faults::published::book_triangle::{BookChapter2, BookChapter3};
use rasterproof_faults::published::games101_strict::Games101Strict;
use rasterproof_faults::published::sysu_bresenham::SysuBresenham;
use rasterproof_faults::published::sysu_inclusive::SysuInclusive;
use rasterproof_faults::published::sysu_truncated::SysuTruncated;
use rasterproof_faults::published::sysu_weights::SysuWeights;
use rasterproof_faults::published::{Published, PublishedLine};
use rasterproof_render::effects::plan::{Canvas, Plan};
use rasterproof_render::effects::render::{self, BadScene, PaidMap, PlanError, Rendered};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::present::DoubleBuffer;
use rasterproof_render::pipeline::target::{Colour, Target};
use rasterproof_render::scene::Scene;
use rasterproof_tiles::coverage::Tiles;
use rasterproof_verify::oracle::Oracle;

/// A rasterizer of the registry.
#[derive(Clone, Copy, Debug)]
pub enum Engine {
    /// The book's split-triangle fill, repaired.
    Scanline,
    EdgeFunction,
    /// Lists of triangles in tiles. It decides coverage only: values at its pixels are those of the
    /// edge function.
    Tile,
    Oracle,
    /// A planted fault.
    Mutant(TriangleMutant),
}

impl Engine {
    pub const JUDGED: [Self; 2] = [Self::Scanline, Self::EdgeFunction];
    /// The rasterizers that are judged when they are asked for.
    pub const CHOICES: [Self; 3] = [Self::Scanline, Self::EdgeFunction, Self::Tile];

    /// Its name on the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Scanline => "scanline",
            Self::EdgeFunction => "edge-function",
            Self::Tile => "tile",
            Self::Oracle => "oracle",
            Self::Mutant(mutant) => mutant.name(),
        }
    }
}

impl Rasterize for Engine {
    #[inline]
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        self.spans(corners, bounds, &mut emit);
    }
}

impl Interpolate for Engine {
    #[inline]
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        self.values(triangle, bounds, &mut emit);
    }
}

// A word of the command line is no hot loop: engines are called through `dyn` here, so that they are
// compiled once and not for every caller.
impl Engine {
    fn spans(&self, corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
        match self {
            Self::Scanline => Scanline.cover(corners, bounds, emit),
            Self::EdgeFunction => EdgeFunction.cover(corners, bounds, emit),
            Self::Tile => Tiles::default().cover(corners, bounds, emit),
            Self::Oracle => Oracle.cover(corners, bounds, emit),
            Self::Mutant(mutant) => mutant.spans(corners, bounds, emit),
        }
    }

    fn values<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<V>),
    ) {
        match self {
            Self::Scanline => Scanline.fragments(triangle, bounds, emit),
            Self::EdgeFunction => EdgeFunction.fragments(triangle, bounds, emit),
            Self::Tile => Tiles::default().cover(triangle.corners(), bounds, |span| {
                let Span { y_px, x0_px, x1_px } = span;
                let run = PixelRect { x0: x0_px, y0: y_px, x1: x1_px, y1: y_px + 1 };
                EdgeFunction.fragments(triangle, run, &mut *emit);
            }),
            Self::Oracle => Oracle.fragments(triangle, bounds, emit),
            Self::Mutant(mutant) => mutant.values(triangle, bounds, emit),
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub enum LineEngine {
    /// The book's DDA, repaired.
    Dda,
    /// Bresenham's algorithm.
    Bresenham,
    Oracle,
    /// A planted fault.
    Mutant(LineMutant),
}

impl LineEngine {
    pub const JUDGED: [Self; 2] = [Self::Dda, Self::Bresenham];

    /// Its name on the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Dda => "dda",
            Self::Bresenham => "bresenham",
            Self::Oracle => "oracle",
            Self::Mutant(mutant) => mutant.name(),
        }
    }
}

impl DrawLine for LineEngine {
    #[inline]
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        self.stroke(line, bounds, &mut emit);
    }
}

impl LineEngine {
    fn stroke<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<V>),
    ) {
        match self {
            Self::Dda => Dda.draw(line, bounds, emit),
            Self::Bresenham => Bresenham.draw(line, bounds, emit),
            Self::Oracle => Oracle.draw(line, bounds, emit),
            Self::Mutant(mutant) => mutant.stroke(line, bounds, emit),
        }
    }
}

/// What draws scenes: one of the judged rasterizers, with a line drawer for edges.
///
/// Each of the two is a call of its own, so that kernels are compiled for these two and not for
/// every planted fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawer {
    Scanline,
    EdgeFunction,
}

impl Drawer {
    pub const ALL: [Self; 2] = [Self::Scanline, Self::EdgeFunction];

    /// The rasterizer's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scanline => Engine::Scanline.name(),
            Self::EdgeFunction => Engine::EdgeFunction.name(),
        }
    }

    pub fn line_name(self) -> &'static str {
        match self {
            Self::Scanline => LineEngine::Dda.name(),
            Self::EdgeFunction => LineEngine::Bresenham.name(),
        }
    }

    /// As [`rasterproof_render::effects::render::plan`].
    pub fn plan(self, scene: &Scene, effects: &Effects, canvas: &Canvas) -> Result<Plan, BadScene> {
        match self {
            Self::Scanline => render::plan(scene, &Scanline, effects, canvas),
            Self::EdgeFunction => {
                let words = effects.mode(Effect::WideWords);
                render::plan(scene, &in_words(words), effects, canvas)
            }
        }
    }

    /// As [`rasterproof_render::effects::render::execute`].
    pub fn execute(
        self,
        plan: &Plan,
        scene: &Scene,
        target: &mut Target,
    ) -> Result<Rendered, PlanError> {
        match self {
            Self::Scanline => render::execute(plan, scene, &Scanline, target),
            Self::EdgeFunction => {
                render::execute(plan, scene, &in_words(plan.frame.wide_words), target)
            }
        }
    }

    /// As [`rasterproof_render::effects::render::render`].
    pub fn render(
        self,
        scene: &Scene,
        effects: &Effects,
        target: &mut Target,
    ) -> Result<Rendered, BadScene> {
        match self {
            Self::Scanline => render::render(scene, &Scanline, effects, target),
            Self::EdgeFunction => {
                render::render(scene, &in_words(effects.mode(Effect::WideWords)), effects, target)
            }
        }
    }

    /// The planned frame with one effect left out everywhere. It is drawn over a colour that is in no scene and over the
    /// nearest depths, so that what is not cleared is seen.
    ///
    /// # Errors
    /// [`BadScene`].
    pub fn render_without(
        self,
        scene: &Scene,
        effect: Effect,
        target: &mut Target,
    ) -> Result<Rendered, BadScene> {
        target.clear_colour([255, 0, 255, 255], &mut Counters::default());
        for plane in &mut target.planes {
            plane.depth.fill(0);
        }
        self.render(scene, &Effects::PLANNED.with(effect, Mode::Never), target)
    }

    /// As [`rasterproof_render::effects::render::render_mapped`].
    pub fn render_mapped(
        self,
        scene: &Scene,
        effects: &Effects,
        target: &mut Target,
    ) -> Result<(Rendered, PaidMap), BadScene> {
        match self {
            Self::Scanline => render::render_mapped(scene, &Scanline, effects, target),
            Self::EdgeFunction => render::render_mapped(
                scene,
                &in_words(effects.mode(Effect::WideWords)),
                effects,
                target,
            ),
        }
    }

    /// As [`rasterproof_render::effects::render::render_watched`].
    pub fn render_watched(
        self,
        scene: &Scene,
        effects: &Effects,
        screen: &mut DoubleBuffer,
        look: &mut dyn FnMut(&Frame<Colour>),
    ) -> Result<Rendered, BadScene> {
        match self {
            Self::Scanline => render::render_watched(scene, &Scanline, effects, screen, look),
            Self::EdgeFunction => render::render_watched(
                scene,
                &in_words(effects.mode(Effect::WideWords)),
                effects,
                screen,
                look,
            ),
        }
    }

    /// As [`rasterproof_render::effects::render::render_wireframe`].
    pub fn render_wireframe(
        self,
        scene: &Scene,
        target: &mut Target,
    ) -> Result<Rendered, BadScene> {
        match self {
            Self::Scanline => render::render_wireframe(scene, &Dda, target),
            Self::EdgeFunction => render::render_wireframe(scene, &Bresenham, target),
        }
    }
}

/// The edge-function engine in the words that a plan asks for.
fn in_words(mode: Mode) -> EdgeFunctionIn {
    EdgeFunctionIn(match mode {
        Mode::Planned | Mode::Material => Words::Narrowest,
        Mode::Always => Words::Widest,
        Mode::Never => Words::Narrow,
    })
}

/// A rasterizer of the registry for corners that are not snapped.
#[derive(Clone, Copy, Debug)]
pub enum ExactEngine {
    /// The book's fill with filtered crossings.
    Scanline,
    /// The bounding-box fill with filtered edge functions.
    EdgeFunction,
    Oracle,
    /// A planted fault.
    Mutant(ExactMutant),
}

impl ExactEngine {
    pub const JUDGED: [Self; 2] = [Self::Scanline, Self::EdgeFunction];

    /// Its name on the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Scanline => "scanline-exact",
            Self::EdgeFunction => "edge-function-exact",
            Self::Oracle => "oracle-exact",
            Self::Mutant(mutant) => mutant.name(),
        }
    }
}

impl RasterizeExact for ExactEngine {
    fn cover_exact(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        mut emit: impl FnMut(Span),
    ) -> Decisions {
        self.spans(corners, bounds, &mut emit)
    }
}

impl ExactEngine {
    fn spans(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Span),
    ) -> Decisions {
        match self {
            Self::Scanline => ScanlineExact.cover_exact(corners, bounds, emit),
            Self::EdgeFunction => EdgeFunctionExact.cover_exact(corners, bounds, emit),
            Self::Oracle => Oracle.cover_exact(corners, bounds, emit),
            Self::Mutant(mutant) => mutant.spans(corners, bounds, emit),
        }
    }
}

/// A published algorithm with its faults.
#[derive(Clone, Copy, Debug)]
pub enum Specimen {
    /// A rasterizer.
    Triangle(&'static dyn Published),
    Line(&'static dyn PublishedLine),
}

/// What a name stands for: some engines rasterize, some draw lines, the oracle does both.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub name: &'static str,
    /// What it is, in a few words.
    pub about: &'static str,
    /// The rasterizer of this name.
    pub engine: Option<Engine>,
    pub line_engine: Option<LineEngine>,
    /// The rasterizer of this name for corners that are not snapped.
    pub exact_engine: Option<ExactEngine>,
    /// The published algorithm of this name.
    pub specimen: Option<Specimen>,
}

const NOBODY: Entry = Entry {
    name: "",
    about: "",
    engine: None,
    line_engine: None,
    exact_engine: None,
    specimen: None,
};

/// Every engine that has a name of its own.
pub const ENTRIES: [Entry; 9] = [
    Entry {
        name: "scanline",
        about: "the book's split-triangle fill, repaired: exact integer DDA down the edges",
        engine: Some(Engine::Scanline),
        ..NOBODY
    },
    Entry {
        name: "edge-function",
        about: "bounding box and three integer edge functions with a top-left bias",
        engine: Some(Engine::EdgeFunction),
        ..NOBODY
    },
    Entry {
        name: "tile",
        about: "tiles of 16 x 16 px, sixteen pixels or triangles at a time",
        engine: Some(Engine::Tile),
        ..NOBODY
    },
    Entry {
        name: "dda",
        about: "the book's line drawer, repaired: exact slope, rounded height",
        line_engine: Some(LineEngine::Dda),
        ..NOBODY
    },
    Entry {
        name: "bresenham",
        about: "Bresenham's line drawer in all octants",
        line_engine: Some(LineEngine::Bresenham),
        ..NOBODY
    },
    Entry {
        name: "oracle",
        about: "the truth: parity of crossings, nearest pixels, planes in big integers",
        engine: Some(Engine::Oracle),
        line_engine: Some(LineEngine::Oracle),
        ..NOBODY
    },
    Entry {
        name: "scanline-exact",
        about: "corners not snapped: filtered crossings, big integers in doubt",
        exact_engine: Some(ExactEngine::Scanline),
        ..NOBODY
    },
    Entry {
        name: "edge-function-exact",
        about: "corners not snapped: filtered edge functions, orient2d in doubt",
        exact_engine: Some(ExactEngine::EdgeFunction),
        ..NOBODY
    },
    Entry {
        name: "oracle-exact",
        about: "corners not snapped: the truth, parity of crossings in whole numbers",
        exact_engine: Some(ExactEngine::Oracle),
        ..NOBODY
    },
];

const fn specimen(name: &'static str, about: &'static str, specimen: Specimen) -> Entry {
    Entry { name, about, specimen: Some(specimen), ..NOBODY }
}

/// Every specimen that speaks the line protocol; they take positions as they are given.
pub const SPECIMENS: [Entry; 15] = [
    specimen(
        "book-ch2",
        "specimen: the book's DrawTriangle2D, section 2.2",
        Specimen::Triangle(&BookChapter2),
    ),
    specimen(
        "book-ch3",
        "specimen: the same without its clamp, with values, section 3.2",
        Specimen::Triangle(&BookChapter3),
    ),
    specimen(
        "book-affine",
        "specimen: the same on projected corners, section 5.3",
        Specimen::Triangle(&BookAffine),
    ),
    specimen(
        "book-ch6",
        "specimen: the book's triangle with w as its depth, chapter 6",
        Specimen::Triangle(&BookDepth::Chapter6),
    ),
    specimen(
        "book-ch7",
        "specimen: the same with -1/w as its depth, chapter 7",
        Specimen::Triangle(&BookDepth::Chapter7),
    ),
    specimen(
        "book-ch11",
        "specimen: the book's final DrawTriangle, chapter 11",
        Specimen::Triangle(&BookFinal { exercise: false }),
    ),
    specimen(
        "book-ch11-fixed",
        "specimen: the same after the exercise of section 11.4",
        Specimen::Triangle(&BookFinal { exercise: true }),
    ),
    specimen(
        "games101-strict",
        "specimen: GAMES101 homework 2, strict inside test",
        Specimen::Triangle(&Games101Strict { whole_samples: false, true_w: false }),
    ),
    specimen(
        "games101-int",
        "specimen: the same with sample positions through an int",
        Specimen::Triangle(&Games101Strict { whole_samples: true, true_w: false }),
    ),
    specimen(
        "games101-depth",
        "specimen: the same with the true w put back, depth included",
        Specimen::Triangle(&Games101Strict { whole_samples: false, true_w: true }),
    ),
    specimen(
        "sysu-inclusive",
        "specimen: SYSU assignment 2, inclusive integer edge functions",
        Specimen::Triangle(&SysuInclusive),
    ),
    specimen(
        "sysu-weights",
        "specimen: the same with weights in the wrong order",
        Specimen::Triangle(&SysuWeights),
    ),
    specimen(
        "sysu-truncated",
        "specimen: the same with positions truncated",
        Specimen::Triangle(&SysuTruncated),
    ),
    specimen("book-dda", "specimen: the book's DrawLine, section 2.1", Specimen::Line(&BookDda)),
    specimen(
        "sysu-bresenham",
        "specimen: SYSU assignment 2, Bresenham",
        Specimen::Line(&SysuBresenham),
    ),
];

pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().chain(&SPECIMENS).find(|entry| entry.name == name)
}

pub fn find_planted(name: &str) -> Option<Entry> {
    let engine = TriangleMutant::ALL.into_iter().find(|mutant| mutant.name() == name);
    let line = LineMutant::ALL.into_iter().find(|mutant| mutant.name() == name);
    let exact = ExactMutant::ALL.into_iter().find(|mutant| mutant.name() == name);
    let named = engine.map(TriangleMutant::name).or(line.map(LineMutant::name));
    Some(Entry {
        name: named.or(exact.map(|mutant| mutant.name()))?,
        about: "a planted fault",
        engine: engine.map(Engine::Mutant),
        line_engine: line.map(LineEngine::Mutant),
        exact_engine: exact.map(ExactEngine::Mutant),
        ..NOBODY
    })
}
