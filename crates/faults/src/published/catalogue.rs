//! The catalogue: for each specimen its source, its fault, its cure in one sentence, the case that
//! exposes it and a harmless one on which it agrees with the truth.
//!
//! Positions are window pixels, y down, as they were recorded: they need not lie on the lattice, and
//! coverage is judged by the oracle for free corners. Values have an exact truth on the lattice only,
//! so a case that shows values is moved there by less than 1/256 px.

use super::scene::{Image, Setting, Version};
use super::{
    book_affine, book_final, book_formulas, book_near_clip, book_painter, book_rotate,
    book_viewport, games101_box, games101_depth, games101_strict, games101_supersample,
    sysu_simple_clip, sysu_strict_t, sysu_weights,
};
use rasterproof_core::arrays::MapArray as _;

/// A specimen: where it is from, what is wrong with it, and how it is shown.
#[derive(Clone, Copy, Debug)]
pub struct Card {
    pub name: &'static str,
    /// Where in the book, or in which course.
    pub source: &'static str,
    pub fault: &'static str,
    /// What the repaired version does instead.
    pub cure: &'static str,
    pub exhibit: Exhibit,
}

/// What shows the fault, and a case of the same kind in which it does not show.
#[derive(Clone, Copy, Debug)]
pub enum Exhibit {
    /// A rasterizer: the exposing and the harmless case.
    Triangles([TriangleCase; 2]),
    /// A line drawer: the exposing and the harmless line, as end pixels.
    Lines([LineCase; 2]),
    /// Neither: pictures of both versions; the name of the exposing scene.
    Scene(&'static str, fn(Version, Setting) -> Image),
}

/// Triangles in a square window, with w and values of their corners.
#[derive(Clone, Copy, Debug)]
pub struct TriangleCase {
    pub name: &'static str,
    /// Its window is a square that begins at the origin.
    pub side_px: u32,
    pub corners_px: &'static [[(f64, f64); 3]],
    /// Of the three corners of every triangle, as the values are.
    pub w: [f64; 3],
    pub values: [f64; 3],
}

#[derive(Clone, Copy, Debug)]
pub struct LineCase {
    pub name: &'static str,
    pub pixels: [(i32, i32); 2],
}

/// An input for which the book shows what its code draws.
#[derive(Clone, Copy, Debug)]
pub struct RecordedCase {
    pub name: &'static str,
    /// The card of the code that drew it.
    pub specimen: &'static str,
    /// Corners in the book's coordinates: y up, samples at whole numbers.
    pub corners: &'static [[(f64, f64); 3]],
}

/// The side of the square window for which the book shows its pictures.
pub const RECORDED_SIDE_PX: u32 = 64;

impl RecordedCase {
    /// The corners in this project's coordinates: y down, samples at halves.
    pub fn corners_px(&self) -> Vec<[[f64; 2]; 3]> {
        let to_window = |(x, y): (f64, f64)| [x + 0.5, f64::from(RECORDED_SIDE_PX) - y - 0.5];
        self.corners.iter().map(|corners| corners.map_array(to_window)).collect()
    }
}

macro_rules! recorded {
    ($($name:literal, $specimen:literal, $corners:expr;)*) => {
        &[$(RecordedCase { name: $name, specimen: $specimen, corners: $corners }),*]
    };
}

/// Values and w of corners: growing, all the same, and without perspective.
const RAMP: [f64; 3] = [0.0, 0.5, 1.0];
const FLAT: [f64; 3] = [0.5; 3];
const ONES: [f64; 3] = [1.0; 3];

const fn case(
    name: &'static str,
    corners_px: &'static [[(f64, f64); 3]],
    w: [f64; 3],
    values: [f64; 3],
) -> TriangleCase {
    TriangleCase { name, side_px: 14, corners_px, w, values }
}

const fn line(name: &'static str, pixels: [(i32, i32); 2]) -> LineCase {
    LineCase { name, pixels }
}

/// Harmless for the book: its left side is upright on samples, no other edge meets one, and it runs
/// out of the window below, since the lowest row of a triangle is always drawn wrongly.
const PLAIN: TriangleCase =
    case("runs out below", &[[(2.5, 16.5), (9.75, 16.5), (2.5, 4.0)]], ONES, FLAT);
/// Harmless for SYSU: its corners are rounded, and by luck no sample changes sides.
const LUCKY: TriangleCase =
    case("lucky", &[[(3.5, 5.5), (10.5, 12.75), (12.75, 5.25)]], ONES, FLAT);
/// No sample on an edge.
const OFF_CENTRE: TriangleCase =
    case("off centre", &[[(1.25, 2.75), (12.75, 4.25), (5.25, 11.75)]], ONES, FLAT);
/// A square on pixel centres, split on its diagonal.
const SQUARE: &[[(f64, f64); 3]] =
    &[[(2.5, 2.5), (10.5, 2.5), (10.5, 10.5)], [(2.5, 10.5), (2.5, 2.5), (10.5, 10.5)]];

/// The recorded input, moved to the middle of a row of the window.
const FIGURE_2_4: &[[(f64, f64); 3]] = &[[(7.25, 7.500_01), (6.5, 7.499_99), (8.05, 7.499_99)]];

/// Cards from a table: name, source, fault, cure and exhibit.
macro_rules! cards {
    ($($name:literal, $source:literal, $fault:literal, $cure:literal, $kind:ident($($exhibit:expr),+);)*) => {
        &[$(Card {
            name: $name,
            source: $source,
            fault: $fault,
            cure: $cure,
            exhibit: Exhibit::$kind($($exhibit),+),
        }),*]
    };
}

/// Every specimen, in the order of the contact sheet.
pub const CARDS: &[Card] = cards![
    "book-dda", "book 2.1", "no last pixel, rounds down, slope drifts",
        "exact slope, rounded height, both ends",
        Lines([line("line_drift", [(0, 9), (20, 7)]), line("ends outside", [(2, 9), (40, 9)])]);
    "book-ch2", "book 2.2", "rows drawn twice, edges too wide by a pixel",
        "half-open spans of the centres between exact crossings",
        Triangles([case("double_row", &[[(2.5, 11.5), (10.5, 8.0), (2.5, 4.5)]], ONES, FLAT), PLAIN]);
    "book-ch3", "book 3.2.4", "a flat edge runs out of the triangle",
        "take crossings and values at the centre, step nothing",
        Triangles([case("ch3_unclamped", FIGURE_2_4, ONES, FLAT), PLAIN]);
    "book-affine", "book 5.3", "values interpolated without perspective",
        "interpolate v/w and 1/w, divide at the pixel",
        Scene("floor, w = 1 to 4", book_affine::draw);
    "book-formulas", "book 5.4, (8) and (9)", "differences cancel: wrong at the far corner",
        "sums of positive terms: w_b (1 - t') v_a + w_a t' v_b",
        Scene("w_b / w_a from 9e13 to 2e17", book_formulas::draw);
    "book-ch6", "book 6.2", "depth (w) far out of range on thin triangles",
        "evaluate the depth at the centre",
        Triangles([case("depth_poison", POISON, [1.0, 1.0, 2.0], RAMP), PLAIN]);
    "book-ch7", "book 7.2", "depth (-1/w) far out of range on thin triangles",
        "evaluate the depth at the centre",
        Triangles([case("depth_poison", POISON, [1.0, 1.0, 2.0], RAMP), PLAIN]);
    "book-ch11", "book 5.4, 11", "values run out of range, or divide by zero",
        "t' from the distance of the centre",
        Triangles([case("t_divzero", DIVZERO, [1.0, 2.0, 1.0], RAMP), PLAIN]);
    "book-ch11-fixed", "book 11.4", "the exercise mends values, not the depth",
        "t' from the centre never leaves [0, 1]",
        Triangles([case("z_not_clamped", &[[(1.5, 13.0), (1.5, 9.25), (9.5, 9.25)]], ONES, [0.0, 0.0, 0.5]), PLAIN]);
    "book-painter", "book 6.1", "a ring of overlaps has no order to paint in",
        "compare the depth of each pixel",
        Scene("cyclic overlap", book_painter::draw);
    "book-near-clip", "book 7.4", "an edge in the near plane: 0/0, all is lost",
        "corners in the plane are inside, cut where ends differ",
        Scene("clip7_on_plane", book_near_clip::draw);
    "book-clip", "book 8.3", "rounding overflows the array: memory overwritten",
        "a polygon that grows, borders decided by signs",
        Scene("clip_stack_overflow", book_final::draw_clip);
    "book-viewport", "book 8.2", "times (size - 1): last row and column empty",
        "times size, with samples at centres",
        Scene("full screen", book_viewport::draw);
    "book-rotate", "book 10.4", "two of three turns go the other way round",
        "one cycle: x towards y, y towards z, z towards x",
        Scene("30 degrees about x, y, z", book_rotate::draw);
    "games101-strict", "GAMES101 hw 2", "samples on edges belong to no triangle: holes",
        "top-left rule on exact edge functions",
        Triangles([case("square", SQUARE, ONES, FLAT), OFF_CENTRE]);
    "games101-int", "GAMES101 hw 2", "sample position cast to int: shifted",
        "a sample position is no whole number",
        Triangles([case("square", SQUARE, ONES, FLAT),
            case("lucky", &[[(3.0, 1.0), (12.75, 1.25), (2.5, 12.75)]], ONES, FLAT)]);
    "games101-w", "GAMES101 hw 2", "w set to 1: attributes without perspective",
        "keep the w of the corner; divide attributes, not z/w",
        Scene("floor, w = 1 to 4", games101_strict::draw);
    "games101-depth", "GAMES101 hw 2", "the repair bends z/w by up to 0.8 of its range",
        "z/w is linear on the screen: leave it",
        Scene("floor, w = 1 to 100", games101_depth::draw);
    "games101-box", "GAMES101 hw 2", "box not cut to the window: wraps, and leaves the buffer",
        "cut the box to the window before walking it",
        Scene("out at the right and below", games101_box::draw);
    "games101-average", "GAMES101 hw 2", "averaged inside the triangle loop: dark seam",
        "a colour for each sample, one average at the end",
        Scene("split square", games101_supersample::draw);
    "sysu-bresenham", "SYSU 2, task 1", "backwards takes other pixels (ties)",
        "fix the side of ties on the sorted ends",
        Lines([line("(2,1) to (0,0)", [(2, 1), (0, 0)]), line("(0,0) to (9,3)", [(0, 0), (9, 3)])]);
    "sysu-simple-clip", "SYSU 2, task 2", "dropped, for no corner lies inside",
        "clip",
        Scene("around the screen", sysu_simple_clip::draw);
    "sysu-inclusive", "SYSU 2, task 4", "samples on shared edges are drawn twice",
        "a subpixel lattice, top-left bias, wide words",
        Triangles([case("square", SQUARE, ONES, FLAT), LUCKY]);
    "sysu-weights", "SYSU 2, task 6", "weights in the wrong order: colours swapped",
        "an edge's function weighs the corner opposite",
        Scene("red, green, blue", sysu_weights::draw);
    "sysu-truncated", "SYSU 2, task 6", "positions cut to int: holes and doubles",
        "a fragment's position is the pixel that was tested",
        Triangles([case("sieve", &[[(1.5, 12.5), (12.5, 9.5), (5.5, 1.5)]], ONES, FLAT),
            case("lucky too", &[[(9.75, 10.75), (4.5, 5.5), (12.75, 1.25)]], ONES, FLAT)]);
    "sysu-strict-t", "SYSU 2, task 7", "decides by a rounded t: half is missing",
        "decide by the signs, assign the plane's value",
        Scene("w = 336, 336, 0", sysu_strict_t::draw);
];

/// The recorded input, its upper corners moved by 1/512 px onto the lattice.
const POISON: &[[(f64, f64); 3]] = &[[(6.5, 13.5), (6.4921875, 1.5), (6.5078125, 1.5)]];
/// The recorded input, moved down and to the left.
const DIVZERO: &[[(f64, f64); 3]] = &[[(6.25, 9.5), (6.75, 9.5), (6.5, 5.5)]];

/// What the book's own code was recorded to do wrong, one for each entry of
/// `tests/data/book-bugs.json`, under its name; the scenes and lines are on the cards.
pub const RECORDED: &[RecordedCase] = recorded![
    "double_row", "book-ch2", &[[(2.0, 2.0), (10.0, 5.5), (2.0, 9.0)]];
    "no_sample", "book-ch2", &[[(1.2, 1.2), (1.8, 1.2), (1.5, 1.8)]];
    "floor_left", "book-ch2", &[[(1.9, 0.0), (3.9, 0.0), (1.9, 2.0)]];
    "y_phase", "book-ch2", &[[(5.5, 0.9), (1.0, 4.9), (10.0, 4.9)]];
    "fp_drift", "book-ch2", &[[(38.0, 26.0), (60.0, 30.0), (6.0, 20.0)]];
    "shared_edge_double", "book-ch2", &[[(10.0, 10.0), (20.0, 10.0), (20.0, 20.0)], [(10.0, 10.0), (20.0, 20.0), (10.0, 20.0)]];
    "shared_edge_crack", "book-ch2", &[[(1.75, 10.0), (48.75, 10.75), (60.25, 19.75)], [(1.75, 10.0), (60.25, 19.75), (24.0, 35.0)]];
    // A pixel to the right of the recorded one: there, turning y over rounds its area to 0.
    "degenerate_drawn", "book-ch2", &[[(1.4, 5.7), (1.4, 8.7), (1.4, 10.7)]];
    "tiny_dropped", "book-ch2", &[[(0.999_999_99, 0.999_999_99), (1.000_000_01, 0.999_999_99), (1.0, 1.000_000_01)]];
    "negative_trunc", "book-ch2", &[[(-0.75, -0.75), (3.0, -0.75), (-0.75, 3.0)]];
    "oob", "book-ch2", &[[(-5.0, -5.0), (5.0, -5.0), (-5.0, 5.0)]];
    "int_overflow_runaway", "book-ch2", &[[(3e9, 0.0), (3e9 + 8.0, 0.0), (3e9, 8.0)]];
    "ch3_unclamped", "book-ch3", &[[(4.25, 2.99999), (3.5, 3.00001), (5.05, 3.00001)]];
    "depth_poison", "book-ch11", &[[(10.0, 0.0), (9.99, 20.0), (10.01, 20.0)]];
    "z_not_clamped_after_fix", "book-ch11-fixed", &[[(1.0, 0.5), (1.0, 4.25), (9.0, 4.25)]];
    "t_divzero", "book-ch11", &[[(9.75, 4.0), (10.25, 4.0), (10.0, 8.0)]];
];

pub fn find(name: &str) -> Option<&'static Card> {
    CARDS.iter().find(|card| card.name == name)
}
