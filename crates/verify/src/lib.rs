//! Judges rasterizers and line drawers in the tests of your crate: every pixel of thousands of hard cases is compared
//! with an exact oracle, and a failing case is shrunk until it can be read.
//!
//! # A test to paste
//!
//! ```no_run
//! use rasterproof_verify::{contract::Rasterize, grid::PixelRect, triangle::{Corners, Span}};
//! # mod my_crate { pub fn fill(_: [[i32; 2]; 3], _: [i32; 4], _: impl FnMut(i32, i32)) {} }
//!
//! struct Mine;
//! impl Rasterize for Mine {
//!     fn cover(&self, c: Corners, w: PixelRect, mut emit: impl FnMut(Span)) {
//!         // Corners are in 1/256 px, y points down; draw the columns x0 to x1 and rows y0 to y1 of the window.
//!         let set = |x, y| emit(Span { y_px: y, x0_px: x, x1_px: x + 1 });
//!         my_crate::fill(c.map(|p| [p.x, p.y]), [w.x0, w.y0, w.x1, w.y1], set);
//!     }
//! }
//! rasterproof_verify::assert_rasterizer!(Mine); // inside a `#[test]`
//! ```
//!
//! It judges 44,000 cases. In a profile without optimisation that takes one core some seven seconds beside the time of your own
//! code, and three with these lines in your `Cargo.toml`; the feature `parallel` uses all cores.
//!
//! ```toml
//! [profile.dev.package.rasterproof-verify]
//! opt-level = 2
//! ```
//!
//! # What is in this crate
//!
//! | to judge | implement | call |
//! |---|---|---|
//! | which pixels a triangle covers | [`contract::Rasterize`] | [`assert_rasterizer!`] |
//! | depths and attributes too | [`contract::Interpolate`] | [`assert_values!`] |
//! | which pixels a line lights, in which order | a closure | [`assert_lines!`] |
//! | their depths and attributes too | [`contract::DrawLine`] | [`assert_line_values!`] |
//! | corners that are not snapped to a grid | [`contract::RasterizeExact`] | [`comparison::judge_exact`] |
//! | the triangles that are made of a polygon | [`partition::Tessellate`], or a function | [`assert_partition!`] |
//! | what your own snapping does to a mesh | both meshes | [`snapping::broken`] |
//!
//! Each macro judges 2,000 cases of every family in [`cases`]: corners on pixel centres, slivers, meshes, corners far outside the
//! window. It panics where a pixel is wrong, and where nothing was judged at all. A second argument says what else is
//! wanted, as [`Options`](comparison::Options):
//!
//! ```
//! # use rasterproof_verify::oracle::Oracle as Mine;
//! use rasterproof_verify::{assert_rasterizer, cases::FamilyName, comparison::Options};
//! assert_rasterizer!(Mine, Options::default().cases(100).seed(7).family(FamilyName::Sliver));
//! ```
//!
//! The macros call functions that return a [`Verdict`](comparison::Verdict) with all counts:
//! [`judge_coverage`](comparison::judge_coverage), [`judge_values`](comparison::judge_values),
//! [`judge_lines`](comparison::judge_lines) and [`judge_line_values`](comparison::judge_line_values). Options that leave no case are the error
//! [`NothingJudged`](comparison::NothingJudged). A family is a [`FamilyName`](cases::FamilyName), so that a misspelt one does not compile.
//!
//! # Lines
//!
//! A line drawer is a closure. It is given both ends, the window, and a function that lights one pixel: column and row. Pixels
//! outside the window are not to be lit, and the order is that from the first end to the second:
//!
//! ```no_run
//! # mod my_crate { pub fn line(_: [i32; 4], _: impl FnMut(i32, i32)) {} }
//! rasterproof_verify::assert_lines!(|[a, b], window, light| {
//!     my_crate::line([a.x, a.y, b.x, b.y], |x, y| {
//!         if window.contains(x, y) {
//!             light(x, y);
//!         }
//!     });
//! });
//! ```
//!
//! # A worked example
//!
//! Many tutorials call a pixel covered if its centre has a positive edge function for all three edges. On a
//! centre that lies exactly on an edge the function is 0, and no triangle draws it: two triangles that share an edge leave holes
//! between them. Triangles with random corners hardly ever show this, since on a grid of 1/256 px two or three in ten
//! thousand have a centre exactly on an edge. `examples/strict.rs` in the package is such a rasterizer, and its test fails:
//!
//! ```text
//! 69425 wrong pixels, in 10468 of 48000 cases
//!
//! half-integer: 1 missing (from half-integer #3, shrunk)
//!   triangle 1,1 0.5,0.5 1,0.5 in a window of 4 x 4 px
//!   judged   expected
//!   ....     ....
//!   .-..     .#..
//!   ....     ....
//!   ....     ....
//!   (# agrees, - missing, + extra, 2 twice, * rightly more than once, . neither)
//!   repeat with: Options::default().seed(1).family(FamilyName::HalfInteger).only(3)
//!
//! probable cause: It samples at the pixel's centre and draws nothing on an edge:
//! neighbours leave holes.
//! if that is meant, declare it: Options::default().convention(Convention::default().rule(Rule::Strict))
//!
//! wrong cases by family:
//!   half-integer (1348) rectangle (1757) fan (1545) strip (982)
//!   near-horizontal (21) near-vertical (28) flat (660) near-tie (111) far (677)
//!   w-equal (454) w-4 (467) w-100 (465) w-1e4 (466) w-1e6 (445) w-extreme (467)
//!   design (268) w-design (307)
//! ```
//!
//! The repair is a rule for edges. With y down and the corners in clockwise order, keep a centre on an edge
//! that goes up, which is a left edge, or that goes exactly to the right, which is a top edge.
//!
//! # How to read a failure
//!
//! The message is that of a [`Disagreement`](comparison::Disagreement), in this order:
//!
//! 1. How much is wrong.
//! 2. What is wrong with the smallest case that was found: pixels *missing*, *extra*, or drawn *twice*. Below it the case, in pixels.
//! 3. What was drawn beside what is expected: `-` is a missing pixel, `+` one too many. Below it the options that repeat the case.
//! 4. The probable cause, where a convention explains some hundred further triangles or lines, and how to declare that
//!    convention if it is meant; or that none was recognised, with the nearest one and how much it explains.
//! 5. The families with wrong cases. A single family says much: only `huge` points to integers that overflow, only
//!    `half-integer` and `rectangle` to the rule for edges.
//!
//! # Conventions
//!
//! Samples are at the centres of pixels, y points down, and a sample on an edge belongs to the triangle if the edge is a top
//! or a left one. Direct3D prescribes this rule. Either winding is drawn. What your rasterizer promises instead is declared
//! by a [`Convention`](comparison::Convention): a fill rule, the place of the sample, a winding, the direction of y, and
//! the bits of coordinates below the pixel. Cases are then put on its grid, and compared with the exact picture of what it
//! declares. Where two triangles may both draw a shared edge, or neither may, the rule is not one of shared edges: that is
//! [`Rule::Inclusive`](comparison::Rule::Inclusive) or [`Rule::Strict`](comparison::Rule::Strict).
//!
//! ```
//! use rasterproof_verify::comparison::{Convention, Options, Rule, Winding, judge_coverage};
//! # use rasterproof_verify::{contract::Rasterize, grid::PixelRect, oracle::Oracle, triangle::{Corners, Span}};
//!
//! /// Draws only triangles that run clockwise on the screen.
//! struct Culls;
//! # impl Rasterize for Culls {
//! #     fn cover(&self, c: Corners, bounds: PixelRect, emit: impl FnMut(Span)) {
//! #         let [ax, ay, bx, by, cx, cy] = [c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y].map(i128::from);
//! #         if (bx - ax) * (cy - ay) > (by - ay) * (cx - ax) { Oracle.cover(c, bounds, emit) }
//! #     }
//! # }
//! let options = Options::default().cases(50);
//! let error = judge_coverage(&Culls, &options)?.check().unwrap_err().to_string();
//! assert!(error.contains("It draws clockwise triangles alone, "));
//!
//! let declared = Convention::default().winding(Winding::Clockwise);
//! assert!(judge_coverage(&Culls, &options.convention(declared))?.agrees());
//! # Ok::<(), rasterproof_verify::comparison::NothingJudged>(())
//! ```
//!
//! # Values
//!
//! Depths are linear in the window, attributes perspective-correct. No two right programs have the same last bits, so a
//! [`Tolerance`](comparison::tolerance::Tolerance) says how far a value may lie from the exact one: u (d D + m M), where u is 2^-53, D the largest
//! difference between the values at the vertices, M the largest magnitude, and d and m count roundings of your
//! operations. [`tolerance::SCANLINE`](comparison::tolerance::SCANLINE) shows such a count line by line. The verdict reports the worst difference as a
//! fraction of the bound. `examples/values.rs` shows what becomes of a bound that was guessed.
//!
//! # Partitions
//!
//! A tessellator turns a polygon into triangles. They are right if they cover every point of the polygon exactly once, and
//! nothing beside it: no overlap, no gap, no triangle in a hole. [`partition`] decides this without a tolerance, and generates
//! polygons on which tessellators fail: vertices on straight edges, spikes, contours that touch, points one ulp beside an edge.
//!
//! ```
//! use rasterproof_verify::partition::{Coordinates, Options, Polygon, Triangle, judge_partitions};
//!
//! /// A fan around the first vertex, which is right if the polygon is convex.
//! fn fan(polygon: &Polygon) -> Vec<Triangle> {
//!     let vertices = &polygon.contours[0];
//!     (2..vertices.len()).map(|i| [vertices[0], vertices[i - 1], vertices[i]]).collect()
//! }
//! let options = Options::default().cases(50).coordinates(Coordinates::F32);
//! let error = judge_partitions(&fan, &options)?.check().unwrap_err().to_string();
//! assert!(error.contains("outside: the smallest polygon that was found"));
//! # Ok::<(), rasterproof_verify::comparison::NothingJudged>(())
//! ```
//!
//! The message has the smallest polygon for each kind of fault, its triangles, and the options that repeat it. What a tessellator
//! promises is declared, as a convention is: its fill rule, the winding of its triangles, the numbers that it takes without
//! rounding, and the polygons that it [accepts](partition::Tessellate::accepts). In a test, `assert_partition!(fan)` does all of
//! this in one line.
//!
//! # Fixtures
//!
//! A test suite that cannot call Rust reads `fixtures/fixtures.json` of this package: 1,000 small cases as triangles, fans, strips, lines
//! and triangles with four samples, each with its pixels for rasterizers with 4 to 8 bits below the pixel. `schema.json` beside
//! it describes the format, and `examples/fixtures.rs` is a test suite that uses it. For each case and number of bits,
//!
//! - pixels in `hit` are hit exactly once, and what is in no list is not hit;
//! - pixels in `either` may be hit or not, because a corner that is not on the grid may be moved to it up or down;
//! - samples in `outline` lie exactly on an edge that belongs to one triangle alone. The top-left rule hits those of them that
//!   are in `hit`. Specifications without a rule for edges, such as those of OpenGL and Vulkan, leave them open.
//!
//! Its 200 polygons for tessellators have whole coordinates and twice the area that their triangles must make up.
//!
//! Pictures cannot show every fault. A rasterizer that passes may still have wrong depths and attributes, draw in a wrong order,
//! or fail in windows that do not begin at the origin and in lists of more than 16 triangles.
//!
//! # Features
//!
//! - `parallel`: cases are judged on all cores, by rayon.
//! - `serde`: verdicts can be serialized.

#![warn(missing_docs)]

#[doc(hidden)]
pub mod ask;
pub mod cases;
pub mod comparison;
#[doc(hidden)]
pub mod convention;
pub mod judge;
#[doc(hidden)]
pub mod learn;
#[doc(hidden)]
pub mod mistakes;
pub mod partition;
mod promise;
pub mod snapping;
// So that whoever judges needs this crate alone.
#[doc(inline)]
pub use rasterproof_core::{contract, frame, grid, triangle};
#[doc(inline)]
pub use rasterproof_oracle as oracle;
/// The text of the oracle's files under the names that the code of a certificate has for them.
#[doc(hidden)]
pub mod source_text {
    pub use crate::oracle::source_text::{COVERAGE as ORACLE_COVERAGE, PIXELS as ORACLE_PIXELS};
}
#[doc(hidden)]
pub mod specification;

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

/// Panics unless a line drawer lights the pixels of the oracle in the same order. It is a closure of the ends, the window and a
/// function that lights a pixel, as [`judge_lines`](comparison::judge_lines) takes. A second argument has other
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

/// Panics unless a line drawer lights the pixels of the oracle, with its depths and attributes. A second argument has other
/// [`Options`](comparison::Options) than 2,000 cases of each family.
#[macro_export]
macro_rules! assert_line_values {
    ($engine:expr $(,)?) => {
        $crate::assert_line_values!($engine, $crate::comparison::Options::default().cases(2_000))
    };
    ($engine:expr, $options:expr $(,)?) => {
        $crate::comparison::must_agree($crate::comparison::judge_line_values(&$engine, &$options))
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

/// Panics unless two rasterizers draw the same pixels, such as a port and its original; whether they are right is not asked. A
/// third argument has other [`Options`](comparison::Options) than 2,000 cases of each family.
#[macro_export]
macro_rules! assert_same_coverage {
    ($first:expr, $second:expr $(,)?) => {
        $crate::assert_same_coverage!(
            $first,
            $second,
            $crate::comparison::Options::default().cases(2_000)
        )
    };
    ($first:expr, $second:expr, $options:expr $(,)?) => {
        $crate::comparison::must_agree($crate::comparison::compare_coverage(
            &$first, &$second, &$options,
        ))
    };
}

/// Panics unless the triangles that a tessellator makes of every generated polygon cover it exactly once. A second
/// argument has other [`Options`](partition::Options) than 2,000 polygons of each family.
#[macro_export]
macro_rules! assert_partition {
    ($tessellator:expr $(,)?) => {
        $crate::assert_partition!($tessellator, $crate::partition::Options::default())
    };
    ($tessellator:expr, $options:expr $(,)?) => {
        $crate::partition::must_partition(&$tessellator, &$options)
    };
}

// The examples name this crate as its users do.
#[cfg(test)]
extern crate self as rasterproof_verify;
#[cfg(test)]
#[path = "../examples/convention.rs"]
mod convention_example;
#[cfg(test)]
#[path = "../examples/fixtures.rs"]
mod fixtures_example;
#[cfg(test)]
#[path = "../examples/strict.rs"]
mod strict_example;
#[cfg(test)]
#[path = "../examples/values.rs"]
mod values_example;

#[cfg(test)]
mod tests {
    use crate::cases::named::plain_line;
    use crate::comparison::{Options, judge_lines, tolerance};
    use rasterproof_core::contract::DrawLine as _;
    use rasterproof_core::grid::PixelRect;
    use rasterproof_core::line::dda::Dda;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::triangle::PixelPoint;

    #[test]
    fn right_engines_pass() {
        assert_rasterizer!(Scanline, Options::default().cases(20));
        assert_line_values!(Dda, Options::default().cases(20));
        assert_lines!(|ends, window, light| lit(ends, window, light), Options::default().cases(20));
        assert_values!(Scanline, tolerance::SCANLINE, Options::default().cases(20));
    }

    /// The pixels of a right line drawer, which has no values.
    fn lit([a, b]: [PixelPoint; 2], window: PixelRect, light: &mut dyn FnMut(i32, i32)) {
        Dda.draw(&plain_line(a, b), window, |f| light(f.x_px, f.y_px));
    }

    /// Pixels and their order are judged; there is nothing else.
    #[test]
    fn a_line_drawer_is_a_closure() {
        let options = Options::default().cases(20);
        assert!(judge_lines(&lit, &options).unwrap().agrees());
        let short = |ends: [PixelPoint; 2], window: PixelRect, light: &mut dyn FnMut(i32, i32)| {
            lit(ends, window, &mut |x, y| {
                if (x, y) != (ends[1].x, ends[1].y) {
                    light(x, y);
                }
            });
        };
        let message = judge_lines(&short, &options).unwrap().check().unwrap_err().to_string();
        assert!(message.contains("1 missing") && message.contains("probable cause"), "{message}");
        let backwards =
            |[a, b]: [PixelPoint; 2], window: PixelRect, light: &mut dyn FnMut(i32, i32)| {
                lit([b, a], window, light);
            };
        let message = judge_lines(&backwards, &options).unwrap().check().unwrap_err().to_string();
        assert!(message.contains(" out of order"), "{message}");
    }

    #[test]
    #[should_panic(expected = "cases")]
    fn no_case_is_no_success() {
        assert_rasterizer!(Scanline, Options::default().cases(0));
    }

    /// The message in the documentation is the one that is printed.
    #[test]
    fn the_documented_message_is_printed() {
        let options = Options::default().cases(2_000);
        let verdict = crate::comparison::judge_coverage(&crate::strict_example::Strict, &options);
        let message = verdict.unwrap().check().unwrap_err().to_string();
        let text = include_str!("lib.rs").replace("//! ", "").replace("//!\n", "\n");
        assert!(text.contains(&message), "{message}");
    }

    #[test]
    fn examples_run() {
        crate::strict_example::main().unwrap();
        crate::convention_example::main().unwrap();
        crate::values_example::main().unwrap();
        crate::fixtures_example::main().unwrap();
    }
}
