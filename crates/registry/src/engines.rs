//! The engines by name: the one file that names every engine and line drawer, and turns a word of the
//! command line into one.

pub use crate::variants::{AreaLevels, SampleValues, TouchedPixels, WideLines};
use rasterproof_core::contract::{
    Decisions, DrawLine, Interpolate, Rasterize, RasterizeExact, Run,
};
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
    Corners, Fragment, FreeCorners, ScreenLine, ScreenTriangle, Span, ValuePlace, Varying, WideForm,
};
use rasterproof_faults::planted::exact::ExactMutant;
use rasterproof_faults::planted::{LineMutant, TileMutant, TriangleMutant};
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
use rasterproof_render::effects::render::{
    self, BadScene, PaidMap, PlanError, Rendered, StagedPieces,
};
use rasterproof_render::effects::{Effect, Effects, Mode};
use rasterproof_render::pipeline::Counters;
use rasterproof_render::pipeline::present::DoubleBuffer;
use rasterproof_render::pipeline::target::{Colour, Target};
use rasterproof_render::scene::Scene;
use rasterproof_tiles::coverage::{CoverList as _, Tiles};
use rasterproof_verify::oracle::Oracle;

#[derive(Clone, Copy, Debug)]
pub enum Engine {
    /// The book's split-triangle fill, repaired.
    Scanline,
    /// The bounding box and three integer edge functions.
    EdgeFunction,
    /// Lists of triangles in tiles. It decides coverage only: values at its pixels are those of the
    /// edge function.
    Tile,
    /// Slow, and right: what the others are judged by.
    Oracle,
    Mutant(TriangleMutant),
    /// The tiles with a planted fault, of lists of one triangle.
    TileMutant(TileMutant),
}

impl Engine {
    pub const JUDGED: [Self; 2] = [Self::Scanline, Self::EdgeFunction];
    /// The rasterizers that are judged when they are asked for.
    pub const CHOICES: [Self; 3] = [Self::Scanline, Self::EdgeFunction, Self::Tile];

    pub fn name(&self) -> &'static str {
        match self {
            Self::Scanline => "scanline",
            Self::EdgeFunction => "edge-function",
            Self::Tile => "tile",
            Self::Oracle => "oracle",
            Self::Mutant(mutant) => mutant.name(),
            Self::TileMutant(mutant) => mutant.name(),
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
            Self::Oracle => Oracle.spans(corners, bounds, emit),
            Self::Mutant(mutant) => mutant.spans(corners, bounds, emit),
            Self::TileMutant(mutant) => mutant.cover_list(&[corners], bounds, &mut |pieces| {
                pieces.iter().for_each(|piece| piece.spans(&mut *emit));
            }),
        }
    }

    /// What [`Interpolate::fragments`] does.
    fn values<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<V>),
    ) {
        match self {
            Self::Scanline => Scanline.fragments(triangle, bounds, emit),
            Self::EdgeFunction => EdgeFunction.fragments(triangle, bounds, emit),
            Self::Tile | Self::TileMutant(_) => {
                self.spans(triangle.corners(), bounds, &mut |span| {
                    let Span { y_px, x0_px, x1_px } = span;
                    let run = PixelRect { x0: x0_px, y0: y_px, x1: x1_px, y1: y_px + 1 };
                    EdgeFunction.fragments(triangle, run, &mut *emit);
                })
            }
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
    Mutant(LineMutant),
}

impl LineEngine {
    pub const JUDGED: [Self; 2] = [Self::Dda, Self::Bresenham];

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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawer {
    /// The scanline engine, with the DDA for the edges of wireframes.
    Scanline,
    /// The edge-function engine, with Bresenham's lines for the edges of wireframes.
    EdgeFunction,
}

/// The rasterizer of a drawer, for edge functions in the words that a plan asks for. It chooses once for each triangle, so
/// that the kernels of frames are compiled once for both engines.
enum FrameEngine {
    Scanline,
    EdgeFunction(EdgeFunctionIn),
}

// Frames are drawn by runs of fragments, which are the hot loop; what is called once for each triangle may choose here.
impl Rasterize for FrameEngine {
    #[inline]
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
        match self {
            Self::Scanline => Scanline.cover(corners, bounds, emit),
            Self::EdgeFunction(engine) => engine.cover(corners, bounds, emit),
        }
    }

    fn word_bits(&self, corners: &Corners) -> Option<u32> {
        match self {
            Self::Scanline => Scanline.word_bits(corners),
            Self::EdgeFunction(engine) => engine.word_bits(corners),
        }
    }
}

impl Interpolate for FrameEngine {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        self.runs(triangle, bounds, false, &mut |run| run.each(&mut emit));
    }

    fn runs<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        affine: bool,
        take: &mut dyn FnMut(Run<'_, V>),
    ) {
        match self {
            Self::Scanline => Scanline.runs(triangle, bounds, affine, take),
            Self::EdgeFunction(engine) => engine.runs(triangle, bounds, affine, take),
        }
    }
}

impl Drawer {
    pub const ALL: [Self; 2] = [Self::Scanline, Self::EdgeFunction];

    pub fn name(self) -> &'static str {
        match self {
            Self::Scanline => Engine::Scanline.name(),
            Self::EdgeFunction => Engine::EdgeFunction.name(),
        }
    }

    /// The name of its line drawer, for edges.
    pub fn line_name(self) -> &'static str {
        match self {
            Self::Scanline => LineEngine::Dda.name(),
            Self::EdgeFunction => LineEngine::Bresenham.name(),
        }
    }

    /// The rasterizer, with the numbers that an effect allows to edge functions.
    fn engine(self, wide_words: Mode) -> FrameEngine {
        match self {
            Self::Scanline => FrameEngine::Scanline,
            Self::EdgeFunction => FrameEngine::EdgeFunction(EdgeFunctionIn(match wide_words {
                Mode::Planned | Mode::Material => Words::Narrowest,
                Mode::Always => Words::Widest,
                Mode::Never => Words::Narrow,
            })),
        }
    }

    /// As [`rasterproof_render::effects::render::plan`].
    pub fn plan(self, scene: &Scene, effects: &Effects, canvas: &Canvas) -> Result<Plan, BadScene> {
        render::plan(scene, &self.engine(effects.mode(Effect::WideWords)), effects, canvas)
    }

    /// As [`rasterproof_render::effects::render::stages`].
    pub fn stages(
        self,
        scene: &Scene,
        effects: &Effects,
        canvas: &Canvas,
    ) -> Result<Vec<StagedPieces>, PlanError> {
        render::stages(scene, &self.engine(effects.mode(Effect::WideWords)), effects, canvas)
    }

    /// As [`rasterproof_render::effects::render::execute`].
    pub fn execute(
        self,
        plan: &Plan,
        scene: &Scene,
        target: &mut Target,
    ) -> Result<Rendered, PlanError> {
        render::execute(plan, scene, &self.engine(plan.frame.wide_words), target)
    }

    /// As [`rasterproof_render::effects::render::render`].
    pub fn render(
        self,
        scene: &Scene,
        effects: &Effects,
        target: &mut Target,
    ) -> Result<Rendered, BadScene> {
        render::render(scene, &self.engine(effects.mode(Effect::WideWords)), effects, target)
    }

    /// The planned frame with one effect left out everywhere. It is drawn over a colour that is in no scene and over the
    /// nearest depths, so that what is not cleared is seen.
    pub fn render_without(
        self,
        scene: &Scene,
        effect: Effect,
        target: &mut Target,
    ) -> Result<Rendered, BadScene> {
        // Before the frame is drawn without this effect.
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
        let engine = self.engine(effects.mode(Effect::WideWords));
        render::render_mapped(scene, &engine, effects, target)
    }

    /// As [`rasterproof_render::effects::render::render_watched`].
    pub fn render_watched(
        self,
        scene: &Scene,
        effects: &Effects,
        screen: &mut DoubleBuffer,
        look: &mut dyn FnMut(&Frame<Colour>),
    ) -> Result<Rendered, BadScene> {
        let engine = self.engine(effects.mode(Effect::WideWords));
        render::render_watched(scene, &engine, effects, screen, look)
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

/// A rasterizer of the registry for corners that are not snapped.
#[derive(Clone, Copy, Debug)]
pub enum ExactEngine {
    /// The book's fill with filtered crossings.
    Scanline,
    /// The bounding-box fill with filtered edge functions.
    EdgeFunction,
    Oracle,
    Mutant(ExactMutant),
}

impl ExactEngine {
    /// The rasterizers of a verdict about corners that are not snapped.
    pub const JUDGED: [Self; 2] = [Self::Scanline, Self::EdgeFunction];

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
    Triangle(&'static dyn Published),
    Line(&'static dyn PublishedLine),
}

/// What a name stands for: some engines rasterize, some draw lines, the oracle does both.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub name: &'static str,
    pub about: &'static str,
    /// What it rasterizes triangles with, if it does.
    pub engine: Option<Engine>,
    /// What it draws lines with, if it does.
    pub line_engine: Option<LineEngine>,
    /// The rasterizer of this name for corners that are not snapped.
    pub exact_engine: Option<ExactEngine>,
    /// The published algorithm of this name.
    pub specimen: Option<Specimen>,
    /// The engine of a rule that a program may declare instead of the book's.
    pub variant: Option<Variant>,
}

/// Engines of other rules, by what they draw.
#[derive(Clone, Copy, Debug)]
pub enum Variant {
    /// Every pixel that a triangle touches.
    Touched(TouchedPixels),
    /// Lines with a width.
    WideLines(WideLines),
    /// The shares of pixels.
    Area(AreaLevels),
    /// Samples with values, computed at one of three places.
    SampleValues(SampleValues),
}

/// An entry that can do nothing, which the tables fill in.
const NOBODY: Entry = Entry {
    name: "",
    about: "",
    engine: None,
    line_engine: None,
    exact_engine: None,
    specimen: None,
    variant: None,
};

/// Entries from a table: name, what it is, and what it can do.
// A member that a line of the table does not name is `None`.
macro_rules! entries {
    ($($name:literal, $about:literal, $($can:ident: $by:expr),+;)*) => {
        [$(Entry { name: $name, about: $about, $($can: Some($by),)+ ..NOBODY }),*]
    };
}

/// Every engine that has a name of its own.
pub const ENTRIES: [Entry; 9] = entries![
    "scanline", "the book's split-triangle fill, repaired: exact integer DDA down the edges",
        engine: Engine::Scanline;
    "edge-function", "bounding box and three integer edge functions with a top-left bias",
        engine: Engine::EdgeFunction;
    "tile", "tiles of 16 x 16 px, sixteen pixels or triangles at a time",
        engine: Engine::Tile;
    "dda", "the book's line drawer, repaired: exact slope, rounded height",
        line_engine: LineEngine::Dda;
    "bresenham", "Bresenham's line drawer in all octants",
        line_engine: LineEngine::Bresenham;
    "oracle", "the truth: parity of crossings, nearest pixels, planes in big integers",
        engine: Engine::Oracle, line_engine: LineEngine::Oracle;
    "scanline-exact", "corners not snapped: filtered crossings, big integers in doubt",
        exact_engine: ExactEngine::Scanline;
    "edge-function-exact", "corners not snapped: filtered edge functions, orient2d in doubt",
        exact_engine: ExactEngine::EdgeFunction;
    "oracle-exact", "corners not snapped: the truth, parity of crossings in whole numbers",
        exact_engine: ExactEngine::Oracle;
];

/// Every specimen that speaks the line protocol; they take positions as they are given.
pub const SPECIMENS: [Entry; 15] = entries![
    "book-ch2", "specimen: the book's DrawTriangle2D, section 2.2",
        specimen: Specimen::Triangle(&BookChapter2);
    "book-ch3", "specimen: the book's DrawTriangle2D without its clamp, with values, section 3.2",
        specimen: Specimen::Triangle(&BookChapter3);
    "book-affine", "specimen: the book's DrawTriangle2D on projected corners, section 5.3",
        specimen: Specimen::Triangle(&BookAffine);
    "book-ch6", "specimen: the book's triangle with w as its depth, chapter 6",
        specimen: Specimen::Triangle(&BookDepth::Chapter6);
    "book-ch7", "specimen: the book's triangle with -1/w as its depth, chapter 7",
        specimen: Specimen::Triangle(&BookDepth::Chapter7);
    "book-ch11", "specimen: the book's final DrawTriangle, chapter 11",
        specimen: Specimen::Triangle(&BookFinal { exercise: false });
    "book-ch11-fixed", "specimen: the book's final DrawTriangle after the exercise of section 11.4",
        specimen: Specimen::Triangle(&BookFinal { exercise: true });
    "games101-strict", "specimen: GAMES101 homework 2, strict inside test",
        specimen: Specimen::Triangle(&Games101Strict { whole_samples: false, true_w: false });
    "games101-int", "specimen: GAMES101 homework 2, strict, with sample positions through an int",
        specimen: Specimen::Triangle(&Games101Strict { whole_samples: true, true_w: false });
    "games101-depth", "specimen: GAMES101 homework 2, strict, with the true w put back, depth included",
        specimen: Specimen::Triangle(&Games101Strict { whole_samples: false, true_w: true });
    "sysu-inclusive", "specimen: SYSU assignment 2, inclusive integer edge functions",
        specimen: Specimen::Triangle(&SysuInclusive);
    "sysu-weights", "specimen: SYSU assignment 2 with weights in the wrong order",
        specimen: Specimen::Triangle(&SysuWeights);
    "sysu-truncated", "specimen: SYSU assignment 2 with positions truncated",
        specimen: Specimen::Triangle(&SysuTruncated);
    "book-dda", "specimen: the book's DrawLine, section 2.1",
        specimen: Specimen::Line(&BookDda);
    "sysu-bresenham", "specimen: SYSU assignment 2, Bresenham",
        specimen: Specimen::Line(&SysuBresenham);
];

/// Engines of other rules, for what programs may declare.
pub const VARIANTS: [Entry; 8] = entries![
    "touched-closed", "every pixel that a triangle touches, its border too: no line separates them",
        variant: Variant::Touched(TouchedPixels { is_closed: true });
    "touched-open", "every pixel that the inside of a triangle touches",
        variant: Variant::Touched(TouchedPixels { is_closed: false });
    "wide-rectangles", "lines with a width as rectangles, cut off at right angles",
        variant: Variant::WideLines(WideLines { form: WideForm::Rectangle });
    "wide-parallelograms", "lines with a width as parallelograms, as wide along the shorter axis",
        variant: Variant::WideLines(WideLines { form: WideForm::Parallelogram });
    "values-at-centres", "four samples with values, computed at the centre of their pixel",
        variant: Variant::SampleValues(SampleValues { at: ValuePlace::Centre });
    "values-at-samples", "four samples with values, each computed at its own place",
        variant: Variant::SampleValues(SampleValues { at: ValuePlace::Sample });
    "values-at-centroids", "four samples with values, computed at the centroid of their pixel",
        variant: Variant::SampleValues(SampleValues { at: ValuePlace::Centroid });
    "area", "the share of each pixel that a triangle covers, in 255 steps",
        variant: Variant::Area(AreaLevels { levels: 255 });
];

/// Everything that speaks the line protocol.
pub fn speaking() -> impl Iterator<Item = &'static Entry> {
    ENTRIES.iter().chain(&VARIANTS).chain(&SPECIMENS)
}

/// The entry of this name, of those that speak the line protocol.
pub fn find(name: &str) -> Option<&'static Entry> {
    speaking().find(|entry| entry.name == name)
}

/// An entry for the planted fault of this name, by all kinds of engines that have it.
pub fn find_planted(name: &str) -> Option<Entry> {
    // One name may be that of several faults, in engines of different kinds.
    let engine = TriangleMutant::ALL.into_iter().find(|mutant| mutant.name() == name);
    let line = LineMutant::ALL.into_iter().find(|mutant| mutant.name() == name);
    let exact = ExactMutant::ALL.into_iter().find(|mutant| mutant.name() == name);
    let tile = TileMutant::ALL.into_iter().find(|mutant| mutant.name() == name);
    let named = engine.map(TriangleMutant::name).or(line.map(LineMutant::name));
    let named = named.or(tile.map(TileMutant::name));
    Some(Entry {
        name: named.or(exact.map(|mutant| mutant.name()))?,
        about: "a planted fault",
        engine: engine.map(Engine::Mutant).or(tile.map(Engine::TileMutant)),
        line_engine: line.map(LineEngine::Mutant),
        exact_engine: exact.map(ExactEngine::Mutant),
        ..NOBODY
    })
}
