//! Judges rasterizers and line drawers in the tests of your crate: the exact [`oracle`], families of hard [`cases`], and
//! the [`comparison`], which counts wrong pixels, checks values against derived tolerances, and shrinks a failing case.
//!
//! # A test to paste
//!
//! ```no_run
//! use rasterproof_verify::contract::Rasterize;
//! use rasterproof_verify::grid::PixelRect;
//! use rasterproof_verify::triangle::{Corners, Span};
//!
//! struct Mine;
//! impl Rasterize for Mine {
//!     fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
//!         // Call your code here; corners are in 1/256 px, y points down.
//!         # let _ = (corners, bounds, &mut emit);
//!     }
//! }
//! rasterproof_verify::assert_rasterizer!(Mine);
//! ```
//!
//! [`assert_rasterizer!`] draws 2,000 cases of each family and compares every pixel with the oracle. It panics where one
//! differs, or where nothing was judged. [`assert_lines!`] does the same for a line drawer, and [`assert_values!`] for
//! depths and attributes, too.
//!
//! # How to read a failure
//!
//! The message gives the smallest triangle that was found, what was drawn and what is expected, the rule by which
//! everything can be explained if there is one, and the options that repeat the case:
//!
//! ```
//! # use rasterproof_verify::contract::Rasterize;
//! # use rasterproof_verify::grid::PixelRect;
//! # use rasterproof_verify::triangle::{Corners, Span};
//! # use rasterproof_core::raster::edge_function::EdgeFunction;
//! use rasterproof_verify::cases::FamilyName;
//! use rasterproof_verify::comparison::{Options, judge_coverage};
//!
//! /// Takes its samples at the upper left corners of the pixels.
//! struct Shifted;
//! # impl Rasterize for Shifted {
//! #     fn cover(&self, corners: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
//! #         let moved = corners.map(|p| rasterproof_verify::grid::SubpixelPoint::new(p.x.saturating_add(128), p.y.saturating_add(128)));
//! #         EdgeFunction.cover(moved, bounds, emit);
//! #     }
//! # }
//! let options = Options::default().cases(50).family(FamilyName::Rectangle).family(FamilyName::Uniform);
//! let error = judge_coverage(&Shifted, &options)?.check().unwrap_err();
//! assert!(error.to_string().contains("its samples are at the upper left corners of the pixels"));
//! # Ok::<(), rasterproof_verify::comparison::NothingJudged>(())
//! ```
//!
//! # Conventions
//!
//! Samples are at the centres of pixels, y points down, and a sample on an edge belongs to the triangle if the edge is a top
//! or a left one. Direct3D prescribes this rule. Either winding is drawn. What your rasterizer promises instead is declared
//! by a [`Convention`](comparison::Convention): a fill rule, the place of the sample, a winding, the direction of y, and
//! the bits of coordinates below the pixel. Where it declares nothing and one of these explains all that it draws, the
//! failure names it.
//!
//! With the feature `parallel`, cases are judged on all cores, by rayon.

#![warn(missing_docs)]

pub mod cases;
pub mod comparison;
pub mod oracle;
// So that whoever judges needs this crate alone.
#[doc(inline)]
pub use rasterproof_core::{contract, frame, grid, triangle};
#[doc(hidden)]
pub mod source_text;

/// Panics unless a rasterizer draws every pixel of all cases as the oracle does. A second argument has other
/// [`Options`](comparison::Options) than 2,000 cases of each family.
#[macro_export]
macro_rules! assert_rasterizer {
    ($engine:expr $(,)?) => {
        $crate::assert_rasterizer!($engine, $crate::comparison::Options::default().cases(2_000))
    };
    ($engine:expr, $options:expr $(,)?) => {
        $crate::comparison::must_agree($crate::comparison::judge_coverage(&$engine, &$options))
    };
}

/// Panics unless a line drawer lights the pixels of the oracle, with its values. A second argument has other
/// [`Options`](comparison::Options) than 2,000 cases of each family.
#[macro_export]
macro_rules! assert_lines {
    ($engine:expr $(,)?) => {
        $crate::assert_lines!($engine, $crate::comparison::Options::default().cases(2_000))
    };
    ($engine:expr, $options:expr $(,)?) => {
        $crate::comparison::must_agree($crate::comparison::judge_lines(&$engine, &$options))
    };
}

/// Panics unless a rasterizer draws every pixel as the oracle does, with depths and attributes within a
/// [`Tolerance`](comparison::tolerance::Tolerance). A third argument has other [`Options`](comparison::Options) than 2,000
/// cases of each family.
#[macro_export]
macro_rules! assert_values {
    ($engine:expr, $tolerance:expr $(,)?) => {
        $crate::assert_values!(
            $engine,
            $tolerance,
            $crate::comparison::Options::default().cases(2_000)
        )
    };
    ($engine:expr, $tolerance:expr, $options:expr $(,)?) => {
        $crate::comparison::must_agree($crate::comparison::judge_values(
            &$engine, $tolerance, &$options,
        ))
    };
}

#[cfg(test)]
mod tests {
    use crate::comparison::{Options, tolerance};
    use rasterproof_core::line::dda::Dda;
    use rasterproof_core::raster::scanline::Scanline;

    #[test]
    fn right_engines_pass() {
        assert_rasterizer!(Scanline, Options::default().cases(20));
        assert_lines!(Dda, Options::default().cases(20));
        assert_values!(Scanline, tolerance::SCANLINE, Options::default().cases(20));
    }

    #[test]
    #[should_panic(expected = "cases")]
    fn no_case_is_no_success() {
        assert_rasterizer!(Scanline, Options::default().cases(0));
    }
}
