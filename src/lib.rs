//! **rasterproof**: two independent triangle rasterizers, two line drawers and an exact oracle,
//! compared pixel for pixel.
//!
//! # What you may rely on
//!
//! These modules, in the order in which a triangle travels; everything in them that these pages show
//! keeps its meaning within a minor version:
//!
//! - [`grid`]: the 1/256-px lattice and windows of pixels; every coordinate is on it
//! - [`triangle`]: triangles, lines, spans and fragments
//! - [`frame`]: pixels in rows; coverage as hit counts
//! - [`contract`]: the traits that a rasterizer or a line drawer implements
//! - [`raster`]: [`raster::scanline`] and [`raster::edge_function`], and their exact forms
//! - [`line`](mod@line): [`line::dda`] and [`line::bresenham`]
//! - [`oracle`]: the truth, by mathematics that no engine uses
//! - [`cases`]: families of hard cases, and cases with names
//! - [`verify`]: judges an engine and finds the smallest case that fails
//! - [`partition`]: judges the triangles that a tessellator makes of polygons
//! - [`judge`]: what every judge has in common: options, parts of the cases, failing cases, verdicts
//! - [`assert_rasterizer`]: judges in one line of a test
//! - [`assert_lines`]: the same for a line drawer, which is a closure
//! - [`assert_line_values`]: a line drawer with depths and attributes
//! - [`assert_values`]: the same with depths and attributes
//! - [`assert_same_coverage`]: two rasterizers draw the same pixels, whether or not they are right
//! - [`assert_partition`]: the same for a tessellator
//!
//! The rest is public for the program, its tests and the samples under `docs/`, is not shown here,
//! and may change at any time: the pipeline, scenes, effects, the published algorithms, mutants,
//! invariants, costs, reports and the command line. The pages under `docs/` follow the chapters
//! of a textbook; `docs/index.md` is where to begin, `docs/ARCHITECTURE.md` shows the whole workspace.
//!
//! # To judge a rasterizer of your own
//!
//! Implement one method:
//!
//! ```
//! use rasterproof::contract::Rasterize;
//! use rasterproof::grid::PixelRect;
//! use rasterproof::triangle::{Corners, Span};
//! use rasterproof::verify;
//!
//! /// Fills the bounding box: wrong for nearly every triangle.
//! struct FillsItsBox;
//! impl Rasterize for FillsItsBox {
//!     fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
//!         let px = |sub: i32| sub.div_euclid(256);
//!         let (xs, ys) = (corners.map(|c| px(c.x)), corners.map(|c| px(c.y)));
//!         let (x0, x1) = (xs.into_iter().min().unwrap().max(bounds.x0), xs.into_iter().max().unwrap().min(bounds.x1));
//!         for y_px in ys.into_iter().min().unwrap().max(bounds.y0)..ys.into_iter().max().unwrap().min(bounds.y1) {
//!             if x0 < x1 { emit(Span { y_px, x0_px: x0, x1_px: x1 }) }
//!         }
//!     }
//! }
//! let verdict = verify::judge_coverage(&FillsItsBox, &verify::Options::default().cases(20))?;
//! let disagreement = verdict.check().unwrap_err();
//! println!("{disagreement}"); // the smallest triangle, what was drawn and expected, and how to repeat it
//! # Ok::<(), verify::NothingJudged>(())
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[doc(inline)]
pub use rasterproof_core::{contract, frame, grid, line, raster, triangle};
#[doc(inline)]
pub use rasterproof_verify::{
    assert_line_values, assert_lines, assert_partition, assert_rasterizer, assert_same_coverage,
    assert_values,
};
#[doc(inline)]
pub use rasterproof_verify::{cases, comparison as verify, judge, oracle, partition};

// The command line, for `main` and the tests.
#[doc(hidden)]
pub mod cli;

/// The samples in the pages under `docs/` are tests.
#[cfg(doctest)]
mod docs {
    macro_rules! pages {
        ($($name:ident $file:literal)*) => {
            $(#[doc = include_str!(concat!("../docs/", $file, ".md"))] struct $name;)*
        };
    }
    macro_rules! samples {
        ($($name:ident $file:literal)*) => {
            $(#[doc = concat!("```\n", include_str!(concat!("../docs/code/", $file, ".rs")), "```")]
            struct $name;)*
        };
    }
    samples! {
        SampleCh01 "ch01"
        SampleCh02 "ch02"
        SampleCh02EdgeFunctions "ch02-edge-functions"
        SampleCh03 "ch03"
        SampleCh04 "ch04"
        SampleCh05 "ch05"
        SampleCh06 "ch06"
        SampleCh07 "ch07"
        SampleCh08 "ch08"
        SampleCh09 "ch09"
        SampleCh10 "ch10"
        SampleCh11 "ch11"
        SampleConventions "conventions"
        SampleCost "cost"
        SampleEffects "effects"
        SampleGames101 "games101"
        SampleGpus "gpus"
        SampleOffgrid "offgrid"
        SampleProtocol "protocol"
        SampleSysu "sysu"
    }
    pages! {
        Chapter1 "ch01"
        Chapter2 "ch02"
        Chapter2EdgeFunctions "ch02-edge-functions"
        Chapter2Scanline "ch02-scanline"
        Chapter3 "ch03"
        Chapter4 "ch04"
        Chapter5 "ch05"
        Chapter6 "ch06"
        Chapter7 "ch07"
        Chapter8 "ch08"
        Chapter9 "ch09"
        Chapter10 "ch10"
        Chapter11 "ch11"
        Samples "samples"
        Textures "textures"
        Effects "effects"
        Judge "judge"
        Tessellators "tessellators"
    }
}
