//! **rasterproof**: two independent triangle rasterizers, two line drawers and an exact oracle,
//! compared pixel for pixel.
//!
//! The path of a triangle, and the room of each step:
//! [`hazard`] makes it, [`raster::scanline`] and [`raster::edge_function`] draw it (as
//! [`contract::Rasterize`] promises), [`oracle`] knows the truth, [`verify`] compares, and
//! [`report`] shows the verdict. Lines travel the same way through [`line::dda`] and
//! [`line::bresenham`]; corners that are not snapped through [`raster::scanline_exact`] and
//! [`raster::edge_function_exact`].
//!
//! Scenes travel through [`pipeline`] and [`effects`] by either rasterizer, and the pictures are
//! compared; [`cost`] measures what each step of accuracy takes. The pages under `docs/` follow the
//! chapters of a textbook; `docs/index.md` is where to begin.
//!
//! To judge a rasterizer of your own, implement one method:
//!
//! ```
//! use rasterproof::{contract::Rasterize, grid::PixelRect, triangle::{Corners, Span}, verify};
//!
//! /// Fills the bounding box: wrong for nearly every triangle.
//! struct Box;
//! impl Rasterize for Box {
//!     fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
//!         let px = |sub: i32| sub.div_euclid(256);
//!         let (xs, ys) = (corners.map(|c| px(c.x)), corners.map(|c| px(c.y)));
//!         let (x0, x1) = (xs.into_iter().min().unwrap().max(bounds.x0), xs.into_iter().max().unwrap().min(bounds.x1));
//!         for y_px in ys.into_iter().min().unwrap().max(bounds.y0)..ys.into_iter().max().unwrap().min(bounds.y1) {
//!             if x0 < x1 { emit(Span { y_px, x0_px: x0, x1_px: x1 }) }
//!         }
//!     }
//! }
//! let verdict = verify::judge_coverage(&Box, &verify::Options { cases: 20, ..verify::Options::default() });
//! assert!(!verdict.agrees());
//! let smallest = verdict.failures[0].clone();
//! println!("{} wrong pixels; the smallest triangle: {smallest}", verdict.mismatches());
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod cli;
pub mod contract;
pub mod convention;
pub mod cost;
pub mod course;
pub mod effects;
pub mod exhaust;
pub mod frame;
pub mod grid;
pub mod hazard;
pub mod invariant;
pub mod judge;
pub mod ladder;
pub mod line;
pub mod lineup;
pub mod mutant;
pub mod oracle;
pub mod pipeline;
pub mod raster;
pub mod report;
pub mod scene;
pub mod specimen;
pub mod triangle;
pub mod verify;

/// The samples in the pages under `docs/` are tests.
#[cfg(doctest)]
mod docs {
    #[doc = include_str!("../docs/ch01.md")]
    struct Chapter1;
    #[doc = include_str!("../docs/ch02.md")]
    struct Chapter2;
    #[doc = include_str!("../docs/ch03.md")]
    struct Chapter3;
    #[doc = include_str!("../docs/ch04.md")]
    struct Chapter4;
    #[doc = include_str!("../docs/ch05.md")]
    struct Chapter5;
    #[doc = include_str!("../docs/ch06.md")]
    struct Chapter6;
    #[doc = include_str!("../docs/ch07.md")]
    struct Chapter7;
    #[doc = include_str!("../docs/ch08.md")]
    struct Chapter8;
    #[doc = include_str!("../docs/ch09.md")]
    struct Chapter9;
    #[doc = include_str!("../docs/ch10.md")]
    struct Chapter10;
    #[doc = include_str!("../docs/ch11.md")]
    struct Chapter11;
    #[doc = include_str!("../docs/conventions.md")]
    struct Conventions;
    #[doc = include_str!("../docs/effects.md")]
    struct Effects;
    #[doc = include_str!("../docs/gpus.md")]
    struct Gpus;
    #[doc = include_str!("../docs/games101.md")]
    struct Games101;
    #[doc = include_str!("../docs/judge.md")]
    struct Judge;
    #[doc = include_str!("../docs/cost.md")]
    struct Cost;
    #[doc = include_str!("../docs/offgrid.md")]
    struct OffGrid;
    #[doc = include_str!("../docs/protocol.md")]
    struct Protocol;
    #[doc = include_str!("../docs/sysu.md")]
    struct Sysu;
}
