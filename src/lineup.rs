//! The line-up: the one file that names every engine and line drawer, and turns a word of the
//! command line into one.

use crate::contract::{Decisions, DrawLine, Interpolate, Rasterize, RasterizeExact};
use crate::grid::PixelRect;
use crate::line::{bresenham::Bresenham, dda::Dda};
use crate::mutant::{LineMutant, TriangleMutant, exact::ExactMutant};
use crate::oracle::Oracle;
use crate::raster::{
    edge_function::EdgeFunction, edge_function_exact::EdgeFunctionExact, scanline::Scanline,
    scanline_exact::ScanlineExact,
};
use crate::triangle::{Corners, Fragment, FreeCorners, ScreenLine, ScreenTriangle, Span, Varying};

/// A rasterizer of the line-up.
#[derive(Clone, Copy, Debug)]
pub enum Engine {
    /// The book's split-triangle fill, repaired.
    Scanline,
    /// The bounding-box fill with edge functions.
    EdgeFunction,
    /// The exact oracle, as an engine.
    Oracle,
    /// A planted fault.
    Mutant(TriangleMutant),
}

impl Engine {
    /// The rasterizers that are judged.
    pub const JUDGED: [Self; 2] = [Self::Scanline, Self::EdgeFunction];

    /// Its name on the command line.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Scanline => "scanline",
            Self::EdgeFunction => "edge-function",
            Self::Oracle => "oracle",
            Self::Mutant(mutant) => mutant.name(),
        }
    }
}

impl Rasterize for Engine {
    fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
        match self {
            Self::Scanline => Scanline.cover(corners, bounds, emit),
            Self::EdgeFunction => EdgeFunction.cover(corners, bounds, emit),
            Self::Oracle => Oracle.cover(corners, bounds, emit),
            Self::Mutant(mutant) => mutant.cover(corners, bounds, emit),
        }
    }
}

impl Interpolate for Engine {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        match self {
            Self::Scanline => Scanline.fragments(triangle, bounds, emit),
            Self::EdgeFunction => EdgeFunction.fragments(triangle, bounds, emit),
            Self::Oracle => Oracle.fragments(triangle, bounds, emit),
            Self::Mutant(mutant) => mutant.fragments(triangle, bounds, emit),
        }
    }
}

/// A line drawer of the line-up.
#[derive(Clone, Copy, Debug)]
pub enum LineEngine {
    /// The book's DDA, repaired.
    Dda,
    /// Bresenham's algorithm.
    Bresenham,
    /// The exact oracle, as a line drawer.
    Oracle,
    /// A planted fault.
    Mutant(LineMutant),
}

impl LineEngine {
    /// The line drawers that are judged.
    pub const JUDGED: [Self; 2] = [Self::Dda, Self::Bresenham];

    /// Its name on the command line.
    #[must_use]
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
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<V>),
    ) {
        match self {
            Self::Dda => Dda.draw(line, bounds, emit),
            Self::Bresenham => Bresenham.draw(line, bounds, emit),
            Self::Oracle => Oracle.draw(line, bounds, emit),
            Self::Mutant(mutant) => mutant.draw(line, bounds, emit),
        }
    }
}

/// A rasterizer of the line-up for corners that are not snapped.
#[derive(Clone, Copy, Debug)]
pub enum ExactEngine {
    /// The book's fill with filtered crossings.
    Scanline,
    /// The bounding-box fill with filtered edge functions.
    EdgeFunction,
    /// The exact oracle, as an engine.
    Oracle,
    /// A planted fault.
    Mutant(ExactMutant),
}

impl ExactEngine {
    /// The rasterizers that are judged.
    pub const JUDGED: [Self; 2] = [Self::Scanline, Self::EdgeFunction];

    /// Its name on the command line.
    #[must_use]
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
        emit: impl FnMut(Span),
    ) -> Decisions {
        match self {
            Self::Scanline => ScanlineExact.cover_exact(corners, bounds, emit),
            Self::EdgeFunction => EdgeFunctionExact.cover_exact(corners, bounds, emit),
            Self::Oracle => Oracle.cover_exact(corners, bounds, emit),
            Self::Mutant(mutant) => mutant.cover_exact(corners, bounds, emit),
        }
    }
}

/// What a name stands for: some engines rasterize, some draw lines, the oracle does both.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The name.
    pub name: &'static str,
    /// What it is, in a few words.
    pub about: &'static str,
    /// The rasterizer of this name.
    pub engine: Option<Engine>,
    /// The line drawer of this name.
    pub line_engine: Option<LineEngine>,
    /// The rasterizer of this name for corners that are not snapped.
    pub exact_engine: Option<ExactEngine>,
}

/// Every engine that has a name of its own.
pub const ENTRIES: [Entry; 8] = [
    Entry {
        name: "scanline",
        about: "the book's split-triangle fill, repaired: exact integer DDA down the edges",
        engine: Some(Engine::Scanline),
        line_engine: None,
        exact_engine: None,
    },
    Entry {
        name: "edge-function",
        about: "bounding box and three integer edge functions with a top-left bias",
        engine: Some(Engine::EdgeFunction),
        line_engine: None,
        exact_engine: None,
    },
    Entry {
        name: "dda",
        about: "the book's line drawer, repaired: exact slope, rounded height",
        engine: None,
        line_engine: Some(LineEngine::Dda),
        exact_engine: None,
    },
    Entry {
        name: "bresenham",
        about: "Bresenham's line drawer in all octants",
        engine: None,
        line_engine: Some(LineEngine::Bresenham),
        exact_engine: None,
    },
    Entry {
        name: "oracle",
        about: "the truth: parity of crossings, nearest pixels, planes in big integers",
        engine: Some(Engine::Oracle),
        line_engine: Some(LineEngine::Oracle),
        exact_engine: None,
    },
    exact(
        "scanline-exact",
        ExactEngine::Scanline,
        "corners not snapped: filtered crossings, big integers in doubt",
    ),
    exact(
        "edge-function-exact",
        ExactEngine::EdgeFunction,
        "corners not snapped: filtered edge functions, orient2d in doubt",
    ),
    exact(
        "oracle-exact",
        ExactEngine::Oracle,
        "corners not snapped: the truth, parity of crossings in whole numbers",
    ),
];

/// The entry of a rasterizer for corners that are not snapped, which does nothing else.
const fn exact(name: &'static str, engine: ExactEngine, about: &'static str) -> Entry {
    Entry { name, about, engine: None, line_engine: None, exact_engine: Some(engine) }
}

/// The entry called `name`.
#[must_use]
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|entry| entry.name == name)
}
