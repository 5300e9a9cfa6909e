//! The line-up: the one file that names every engine and line drawer, and turns a word of the
//! command line into one.

use glam::DVec2;

use crate::contract::{DrawLine, Interpolate, Rasterize};
use crate::grid::PixelRect;
use crate::line::{bresenham::Bresenham, dda::Dda};
use crate::mutant::{LineMutant, TriangleMutant};
use crate::oracle::Oracle;
use crate::raster::{edge_function::EdgeFunction, scanline::Scanline};
use crate::specimen::book_dda::BookDda;
use crate::specimen::book_final::BookFinal;
use crate::specimen::book_triangle::{BookChapter2, BookChapter3};
use crate::specimen::{Published, PublishedLine, RealTriangle, Refused};
use crate::triangle::{Corners, Fragment, ScreenLine, ScreenTriangle, Span, Varying};

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

/// A published algorithm with its faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Specimen {
    /// A rasterizer.
    Triangle(TriangleSpecimen),
    /// A line drawer.
    Line(LineSpecimen),
}

/// A published rasterizer with its faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TriangleSpecimen {
    /// The book's triangle of chapter 2.
    BookChapter2,
    /// The same of chapter 3, without the clamp.
    BookChapter3,
    /// The book's final triangle.
    BookChapter11,
    /// The same after the last exercise.
    BookChapter11Fixed,
}

impl TriangleSpecimen {
    /// Whether it interpolates values.
    #[must_use]
    pub fn has_values(self) -> bool {
        !matches!(self, Self::BookChapter2)
    }
}

impl Published for TriangleSpecimen {
    fn cover(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: impl FnMut(Span),
    ) -> Result<(), Refused> {
        match self {
            Self::BookChapter2 => BookChapter2.cover(triangle, bounds, emit),
            Self::BookChapter3 => BookChapter3.cover(triangle, bounds, emit),
            Self::BookChapter11 => BookFinal { exercise: false }.cover(triangle, bounds, emit),
            Self::BookChapter11Fixed => BookFinal { exercise: true }.cover(triangle, bounds, emit),
        }
    }

    fn fragments(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: impl FnMut(Fragment<DVec2>),
    ) -> Result<(), Refused> {
        match self {
            Self::BookChapter2 => BookChapter2.fragments(triangle, bounds, emit),
            Self::BookChapter3 => BookChapter3.fragments(triangle, bounds, emit),
            Self::BookChapter11 => BookFinal { exercise: false }.fragments(triangle, bounds, emit),
            Self::BookChapter11Fixed => {
                BookFinal { exercise: true }.fragments(triangle, bounds, emit)
            }
        }
    }
}

/// A published line drawer with its faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineSpecimen {
    /// The book's DDA.
    BookDda,
}

impl PublishedLine for LineSpecimen {
    fn draw(
        &self,
        ends_px: [[f64; 2]; 2],
        bounds: PixelRect,
        emit: impl FnMut(i32, i32),
    ) -> Result<(), Refused> {
        match self {
            Self::BookDda => BookDda.draw(ends_px, bounds, emit),
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
    /// The published algorithm of this name.
    pub specimen: Option<Specimen>,
}

/// Every engine that has a name of its own.
pub const ENTRIES: [Entry; 5] = [
    Entry {
        name: "scanline",
        about: "the book's split-triangle fill, repaired: exact integer DDA down the edges",
        engine: Some(Engine::Scanline),
        line_engine: None,
        specimen: None,
    },
    Entry {
        name: "edge-function",
        about: "bounding box and three integer edge functions with a top-left bias",
        engine: Some(Engine::EdgeFunction),
        line_engine: None,
        specimen: None,
    },
    Entry {
        name: "dda",
        about: "the book's line drawer, repaired: exact slope, rounded height",
        engine: None,
        line_engine: Some(LineEngine::Dda),
        specimen: None,
    },
    Entry {
        name: "bresenham",
        about: "Bresenham's line drawer in all octants",
        engine: None,
        line_engine: Some(LineEngine::Bresenham),
        specimen: None,
    },
    Entry {
        name: "oracle",
        about: "the truth: parity of crossings, nearest pixels, planes in big integers",
        engine: Some(Engine::Oracle),
        line_engine: Some(LineEngine::Oracle),
        specimen: None,
    },
];

const fn specimen(name: &'static str, about: &'static str, specimen: Specimen) -> Entry {
    Entry { name, about, engine: None, line_engine: None, specimen: Some(specimen) }
}

/// Every specimen that speaks the line protocol; they take positions as they are given.
pub const SPECIMENS: [Entry; 5] = [
    specimen(
        "book-ch2",
        "specimen: the book's DrawTriangle2D, section 2.2",
        Specimen::Triangle(TriangleSpecimen::BookChapter2),
    ),
    specimen(
        "book-ch3",
        "specimen: the same without its clamp, with values, section 3.2",
        Specimen::Triangle(TriangleSpecimen::BookChapter3),
    ),
    specimen(
        "book-ch11",
        "specimen: the book's final DrawTriangle, chapter 11",
        Specimen::Triangle(TriangleSpecimen::BookChapter11),
    ),
    specimen(
        "book-ch11-fixed",
        "specimen: the same after the exercise of section 11.4",
        Specimen::Triangle(TriangleSpecimen::BookChapter11Fixed),
    ),
    specimen(
        "book-dda",
        "specimen: the book's DrawLine, section 2.1",
        Specimen::Line(LineSpecimen::BookDda),
    ),
];

/// The entry called `name`, engines first.
#[must_use]
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().chain(&SPECIMENS).find(|entry| entry.name == name)
}
