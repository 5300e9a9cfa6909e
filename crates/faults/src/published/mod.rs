//! The published algorithms, faults included: specimens to look at, never to build on.
//!
//! Two sources publish code that is kept here: a Chinese text on writing a software renderer ("the
//! book", eleven chapters, yangzhenzhuozz/Renderer on GitHub) and two sets of course work, GAMES101 (Lingqi
//! Yan, 2020) homework 2 with its published solutions, and SYSU (Sun Yat-sen University, Computer Graphics)
//! assignment 2 with a published report (2022); `docs/sources.md` says where they are to be found. A file
//! holds one algorithm in our own words, with its symptom. The [`catalogue`] has its cure, a case that
//! exposes it and one that is harmless. A specimen takes positions as real numbers, since its faults begin with
//! what it does to them. It draws a pixel as often as the published loops do. None is ever repaired: the tests require each to be
//! caught.
//!
//! They refuse what would not end or is undefined in the published code, with a reason: [`NoResult`].

pub mod book_affine;
pub mod book_dda;
pub mod book_depth;
pub mod book_final;
pub mod book_formulas;
pub mod book_near_clip;
pub mod book_painter;
pub mod book_rotate;
pub mod book_triangle;
pub mod book_viewport;
pub mod catalogue;
pub mod games101_box;
pub mod games101_depth;
pub mod games101_strict;
pub mod games101_supersample;
pub mod scene;
pub mod sysu_bresenham;
pub mod sysu_inclusive;
pub mod sysu_simple_clip;
pub mod sysu_strict_t;
pub mod sysu_truncated;
pub mod sysu_weights;

use std::cmp::Ordering;
use std::fmt;

use glam::{DVec2, DVec4};

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, Fragment, ScreenTriangle, Span};

/// A corner as a specimen receives it: real numbers in window pixels, y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealVertex {
    /// Off the lattice, as published code takes it.
    pub position_px: DVec2,
    /// Depth, linear in the window (z/w).
    pub depth: f64,
    pub w: f64,
    pub varying: DVec2,
}

/// A triangle as published code takes it.
pub type RealTriangle = [RealVertex; 3];

/// Positions alone, with depth 0, w 1 and no values.
pub fn bare(corners_px: [[f64; 2]; 3]) -> RealTriangle {
    corners_px.map_array(|position| RealVertex {
        position_px: DVec2::from_array(position),
        depth: 0.0,
        w: 1.0,
        varying: DVec2::ZERO,
    })
}

pub fn from_lattice(corners: Corners) -> RealTriangle {
    bare(corners.map_array(|corner| corner.to_px().into()))
}

/// The same triangle in real numbers; w is 1 / (1/w).
pub fn from_screen(triangle: &ScreenTriangle<DVec2>) -> RealTriangle {
    triangle.vertices.map_array(|v| RealVertex {
        position_px: v.position.to_px().into(),
        depth: v.depth,
        w: 1.0 / v.inv_w,
        varying: v.varying,
    })
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipVertex {
    /// x, y, z, w, homogeneous.
    pub position: DVec4,
    pub varying: DVec2,
}

impl ClipVertex {
    /// The point that share `t` of the way to `other`.
    fn towards(&self, other: &Self, t: f64) -> Self {
        Self {
            position: self.position + (other.position - self.position) * t,
            varying: self.varying + (other.varying - self.varying) * t,
        }
    }
}

/// Why a specimen does not draw: the published code has no defined result, or takes forever.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoResult {
    /// A float that an `int` cannot hold is converted to one: undefined, on most machines the
    /// smallest int.
    IntOverflow(f64),
    /// A loop over an `int` runs until it exceeds this bound, which no int does.
    Endless(f64),
    /// That many rows or columns before the window would have to be walked to know the sums in it.
    TooFar(f64),
    /// A clipped polygon outgrows its array of that many vertices, and memory is overwritten.
    ArrayOverflow(usize),
    /// The specimen draws and interpolates nothing.
    NoValues,
}

impl fmt::Display for NoResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::IntOverflow(value) => {
                write!(f, "the published code converts {value:e} to an int, which is undefined")
            }
            Self::Endless(bound) => {
                write!(f, "the published loop counts an int up to {bound:e} and never ends")
            }
            Self::TooFar(steps) => {
                write!(
                    f,
                    "the published loop takes {steps:e} steps before the window; too many to take"
                )
            }
            Self::ArrayOverflow(size) => {
                write!(f, "the published clip writes past its array of {size} vertices")
            }
            Self::NoValues => f.write_str("the published code interpolates nothing"),
        }
    }
}

impl std::error::Error for NoResult {}

/// Steps before the window that are walked to know the sums in it: rows for a triangle, columns for
/// each of its rows, pixels for a line.
pub const MOST_STEPS: f64 = (1u32 << 20) as f64;
/// Columns before the window that are walked for all rows of a triangle together.
const MOST_COLUMNS: i64 = 1 << 23;

/// Counts the columns that a triangle walks before the window.
#[derive(Default)]
struct Columns(i64);

impl Columns {
    /// Adds the columns from `first` up to the window's left border.
    fn add(&mut self, first: i64) -> Result<(), NoResult> {
        self.0 += (-first).max(0);
        if self.0 > MOST_COLUMNS || (-first) as f64 > MOST_STEPS {
            return Err(NoResult::TooFar(self.0 as f64));
        }
        Ok(())
    }
}

/// The function that receives the spans of a triangle, in the published order.
pub type Spans<'a> = &'a mut dyn FnMut(Span);
pub type Fragments<'a> = &'a mut dyn FnMut(Fragment<DVec2>);
/// Whether it was drawn, or why the published code gives no result.
pub type DrawResult = Result<(), NoResult>;

pub trait Published: fmt::Debug + Sync {
    /// Emits the pixels of `bounds` as often as the published loops set them: a pixel that lies in
    /// two spans is set twice. Pixels outside are dropped, and cost no more than [`MOST_STEPS`].
    ///
    /// # Errors
    /// [`NoResult`] where the published code is undefined or does not end.
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult;

    /// Emits a fragment for each pixel that [`Published::cover`] emits, in the published order.
    ///
    /// # Errors
    /// As [`Published::cover`], and [`NoResult::NoValues`] where nothing is interpolated.
    fn fragments(
        &self,
        _triangle: &RealTriangle,
        _bounds: PixelRect,
        _emit: Fragments<'_>,
    ) -> DrawResult {
        Err(NoResult::NoValues)
    }

    /// Whether [`Published::fragments`] computes anything.
    fn has_values(&self) -> bool {
        true
    }

    /// The depth that it compares, for a corner with this z/w and w.
    fn depth_of(&self, depth: f64, _w: f64) -> f64 {
        depth
    }

    /// Whether the depth that it compares is w, which is linear in space and not on the screen.
    fn compares_w(&self) -> bool {
        false
    }
}

/// A published line drawer, whose ends are positions and not pixels.
pub trait PublishedLine: fmt::Debug + Sync {
    /// Emits the pixels of `bounds` in the published order, as often as they are set.
    fn draw(
        &self,
        ends_px: [[f64; 2]; 2],
        bounds: PixelRect,
        emit: &mut dyn FnMut(i32, i32),
    ) -> Result<(), NoResult>;
}

/// The book's screen, laid over a window: y points up, the pixel at the lower left is (0, 0), and
/// the whole numbers are the sample points.
#[derive(Clone, Copy, Debug)]
struct BookScreen {
    /// The window, whose rows the book counts from below.
    bounds: PixelRect,
}

impl BookScreen {
    fn position(self, position_px: DVec2) -> DVec2 {
        let x = position_px.x - f64::from(self.bounds.x0);
        let y = f64::from(self.bounds.y1) - position_px.y;
        DVec2::new(x - 0.5, y - 0.5)
    }

    /// Columns and rows of the window in the book's numbers.
    fn size(self) -> (i64, i64) {
        (i64::from(self.bounds.width()), i64::from(self.bounds.height()))
    }

    fn pixel(self, x: i64, y: i64) -> (i32, i32) {
        // Only pixels within the window are asked for.
        (self.bounds.x0 + x as i32, self.bounds.y1 - 1 - y as i32)
    }

    /// The columns first..=last of the book's row y that lie in the window.
    fn span(self, y: i64, first: i64, last: i64) -> Option<Span> {
        let (width, height) = self.size();
        let (first, end) = (first.max(0), (last + 1).min(width));
        if !(0..height).contains(&y) || first >= end {
            return None;
        }
        let (x0_px, y_px) = self.pixel(first, y);
        Some(Span { y_px, x0_px, x1_px: x0_px + (end - first) as i32 })
    }
}

/// `(int)value`: towards zero.
fn to_int(value: f64) -> Result<i64, NoResult> {
    if value > -2_147_483_649.0 && value < 2_147_483_648.0 {
        Ok(value as i64)
    } else {
        Err(NoResult::IntOverflow(value))
    }
}

/// The whole numbers of `for (int i = (int)start; i <= end; i++)`, both ends included.
fn int_loop(start: f64, end: f64) -> Result<Option<(i64, i64)>, NoResult> {
    let first = to_int(start)?;
    match (first as f64).partial_cmp(&end) {
        Some(Ordering::Less | Ordering::Equal) if end >= 2_147_483_647.0 => {
            Err(NoResult::Endless(end))
        }
        Some(Ordering::Less | Ordering::Equal) => Ok(Some((first, end.floor() as i64))),
        // Nothing is less than or equal to NaN.
        Some(Ordering::Greater) | None => Ok(None),
    }
}
