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

#[derive(Clone, Copy, Debug)]
pub struct Card {
    pub name: &'static str,
    /// Document, chapter or task, section.
    pub source: &'static str,
    /// What is wrong, in a few words.
    pub fault: &'static str,
    /// The repair in one sentence.
    pub cure: &'static str,
    pub exhibit: Exhibit,
}

/// The cases of a specimen.
#[derive(Clone, Copy, Debug)]
pub enum Exhibit {
    /// A rasterizer: the exposing and the harmless case.
    Triangles([TriangleCase; 2]),
    /// A line drawer: the exposing and the harmless line, as end pixels.
    Lines([LineCase; 2]),
    /// Neither: pictures of both versions; the name of the exposing scene.
    Scene(&'static str, fn(Version, Setting) -> Image),
}

#[derive(Clone, Copy, Debug)]
pub struct TriangleCase {
    pub name: &'static str,
    pub side_px: u32,
    pub corners_px: &'static [[(f64, f64); 3]],
    /// Distances of the corners.
    pub w: [f64; 3],
    /// The attribute at the corners; the depth too.
    pub values: [f64; 3],
}

#[derive(Clone, Copy, Debug)]
pub struct LineCase {
    pub name: &'static str,
    pub pixels: [(i32, i32); 2],
}

/// A recorded input of the book's code, by triangles.
#[derive(Clone, Copy, Debug)]
pub struct RecordedCase {
    pub name: &'static str,
    pub specimen: &'static str,
    /// Corners in the book's coordinates: y up, samples at whole numbers.
    pub corners: &'static [[(f64, f64); 3]],
}

/// Side of the recorded screens in pixels.
pub const RECORDED_SIDE_PX: u32 = 64;

impl RecordedCase {
    #[must_use]
    pub fn corners_px(&self) -> Vec<[[f64; 2]; 3]> {
        let to_window = |(x, y): (f64, f64)| [x + 0.5, f64::from(RECORDED_SIDE_PX) - y - 0.5];
        self.corners.iter().map(|corners| corners.map_array(to_window)).collect()
    }
}

const fn recorded(
    name: &'static str,
    specimen: &'static str,
    corners: &'static [[(f64, f64); 3]],
) -> RecordedCase {
    RecordedCase { name, specimen, corners }
}

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

/// Every card, the book first.
pub const CARDS: &[Card] = &[
    Card {
        name: "book-dda",
        source: "book 2.1",
        fault: "no last pixel, rounds down, slope drifts",
        cure: "exact slope, rounded height, both ends",
        exhibit: Exhibit::Lines([
            LineCase { name: "line_drift", pixels: [(0, 9), (20, 7)] },
            LineCase { name: "ends outside", pixels: [(2, 9), (40, 9)] },
        ]),
    },
    Card {
        name: "book-ch2",
        source: "book 2.2",
        fault: "rows drawn twice, edges too wide by a pixel",
        cure: "half-open spans of the centres between exact crossings",
        exhibit: Exhibit::Triangles([
            case("double_row", &[[(2.5, 11.5), (10.5, 8.0), (2.5, 4.5)]], ONES, FLAT),
            PLAIN,
        ]),
    },
    Card {
        name: "book-ch3",
        source: "book 3.2.4",
        fault: "a flat edge runs out of the triangle",
        cure: "take crossings and values at the centre, step nothing",
        exhibit: Exhibit::Triangles([case("ch3_unclamped", FIGURE_2_4, ONES, FLAT), PLAIN]),
    },
    Card {
        name: "book-affine",
        source: "book 5.3",
        fault: "values interpolated without perspective",
        cure: "interpolate v/w and 1/w, divide at the pixel",
        exhibit: Exhibit::Scene("floor, w = 1 to 4", book_affine::draw),
    },
    Card {
        name: "book-formulas",
        source: "book 5.4, (8) and (9)",
        fault: "differences cancel: wrong at the far corner",
        cure: "sums of positive terms: w_b (1 - t') v_a + w_a t' v_b",
        exhibit: Exhibit::Scene("w_b / w_a from 9e13 to 2e17", book_formulas::draw),
    },
    Card {
        name: "book-ch6",
        source: "book 6.2",
        fault: "depth (w) far out of range on thin triangles",
        cure: "evaluate the depth at the centre",
        exhibit: Exhibit::Triangles([case("depth_poison", POISON, [1.0, 1.0, 2.0], RAMP), PLAIN]),
    },
    Card {
        name: "book-ch7",
        source: "book 7.2",
        fault: "depth (-1/w) far out of range on thin triangles",
        cure: "evaluate the depth at the centre",
        exhibit: Exhibit::Triangles([case("depth_poison", POISON, [1.0, 1.0, 2.0], RAMP), PLAIN]),
    },
    Card {
        name: "book-ch11",
        source: "book 5.4, 11",
        fault: "values run out of range, or divide by zero",
        cure: "t' from the distance of the centre",
        exhibit: Exhibit::Triangles([case("t_divzero", DIVZERO, [1.0, 2.0, 1.0], RAMP), PLAIN]),
    },
    Card {
        name: "book-ch11-fixed",
        source: "book 11.4",
        fault: "the exercise mends values, not the depth",
        cure: "t' from the centre never leaves [0, 1]",
        exhibit: Exhibit::Triangles([
            case(
                "z_not_clamped",
                &[[(1.5, 13.0), (1.5, 9.25), (9.5, 9.25)]],
                ONES,
                [0.0, 0.0, 0.5],
            ),
            PLAIN,
        ]),
    },
    Card {
        name: "book-painter",
        source: "book 6.1",
        fault: "a ring of overlaps has no order to paint in",
        cure: "compare the depth of each pixel",
        exhibit: Exhibit::Scene("cyclic overlap", book_painter::draw),
    },
    Card {
        name: "book-near-clip",
        source: "book 7.4",
        fault: "an edge in the near plane: 0/0, all is lost",
        cure: "corners in the plane are inside, cut where ends differ",
        exhibit: Exhibit::Scene("clip7_on_plane", book_near_clip::draw),
    },
    Card {
        name: "book-clip",
        source: "book 8.3",
        fault: "rounding overflows the array: memory overwritten",
        cure: "a polygon that grows, borders decided by signs",
        exhibit: Exhibit::Scene("clip_stack_overflow", book_final::draw_clip),
    },
    Card {
        name: "book-viewport",
        source: "book 8.2",
        fault: "times (size - 1): last row and column empty",
        cure: "times size, with samples at centres",
        exhibit: Exhibit::Scene("full screen", book_viewport::draw),
    },
    Card {
        name: "book-rotate",
        source: "book 10.4",
        fault: "two of three turns go the other way round",
        cure: "one cycle: x towards y, y towards z, z towards x",
        exhibit: Exhibit::Scene("30 degrees about x, y, z", book_rotate::draw),
    },
    Card {
        name: "games101-strict",
        source: "GAMES101 hw 2",
        fault: "samples on edges belong to no triangle: holes",
        cure: "top-left rule on exact edge functions",
        exhibit: Exhibit::Triangles([case("square", SQUARE, ONES, FLAT), OFF_CENTRE]),
    },
    Card {
        name: "games101-int",
        source: "GAMES101 hw 2",
        fault: "sample position cast to int: shifted",
        cure: "a sample position is no whole number",
        exhibit: Exhibit::Triangles([
            case("square", SQUARE, ONES, FLAT),
            case("lucky", &[[(3.0, 1.0), (12.75, 1.25), (2.5, 12.75)]], ONES, FLAT),
        ]),
    },
    Card {
        name: "games101-w",
        source: "GAMES101 hw 2",
        fault: "w set to 1: attributes without perspective",
        cure: "keep the w of the corner; divide attributes, not z/w",
        exhibit: Exhibit::Scene("floor, w = 1 to 4", games101_strict::draw),
    },
    Card {
        name: "games101-depth",
        source: "GAMES101 hw 2",
        fault: "the repair bends z/w by up to 0.8 of its range",
        cure: "z/w is linear on the screen: leave it",
        exhibit: Exhibit::Scene("floor, w = 1 to 100", games101_depth::draw),
    },
    Card {
        name: "games101-box",
        source: "GAMES101 hw 2",
        fault: "box not cut to the window: wraps, and leaves the buffer",
        cure: "cut the box to the window before walking it",
        exhibit: Exhibit::Scene("out at the right and below", games101_box::draw),
    },
    Card {
        name: "games101-average",
        source: "GAMES101 hw 2",
        fault: "averaged inside the triangle loop: dark seam",
        cure: "a colour for each sample, one average at the end",
        exhibit: Exhibit::Scene("split square", games101_supersample::draw),
    },
    Card {
        name: "sysu-bresenham",
        source: "SYSU 2, task 1",
        fault: "backwards takes other pixels (ties)",
        cure: "fix the side of ties on the sorted ends",
        exhibit: Exhibit::Lines([
            LineCase { name: "(2,1) to (0,0)", pixels: [(2, 1), (0, 0)] },
            LineCase { name: "(0,0) to (9,3)", pixels: [(0, 0), (9, 3)] },
        ]),
    },
    Card {
        name: "sysu-simple-clip",
        source: "SYSU 2, task 2",
        fault: "dropped, for no corner lies inside",
        cure: "clip",
        exhibit: Exhibit::Scene("around the screen", sysu_simple_clip::draw),
    },
    Card {
        name: "sysu-inclusive",
        source: "SYSU 2, task 4",
        fault: "samples on shared edges are drawn twice",
        cure: "a subpixel lattice, top-left bias, wide words",
        exhibit: Exhibit::Triangles([case("square", SQUARE, ONES, FLAT), LUCKY]),
    },
    Card {
        name: "sysu-weights",
        source: "SYSU 2, task 6",
        fault: "weights in the wrong order: colours swapped",
        cure: "an edge's function weighs the corner opposite",
        exhibit: Exhibit::Scene("red, green, blue", sysu_weights::draw),
    },
    Card {
        name: "sysu-truncated",
        source: "SYSU 2, task 6",
        fault: "positions cut to int: holes and doubles",
        cure: "a fragment's position is the pixel that was tested",
        exhibit: Exhibit::Triangles([
            case("sieve", &[[(1.5, 12.5), (12.5, 9.5), (5.5, 1.5)]], ONES, FLAT),
            case("lucky too", &[[(9.75, 10.75), (4.5, 5.5), (12.75, 1.25)]], ONES, FLAT),
        ]),
    },
    Card {
        name: "sysu-strict-t",
        source: "SYSU 2, task 7",
        fault: "decides by a rounded t: half is missing",
        cure: "decide by the signs, assign the plane's value",
        exhibit: Exhibit::Scene("w = 336, 336, 0", sysu_strict_t::draw),
    },
];

/// The recorded input, its upper corners moved by 1/512 px onto the lattice.
const POISON: &[[(f64, f64); 3]] = &[[(6.5, 13.5), (6.4921875, 1.5), (6.5078125, 1.5)]];
/// The recorded input, moved down and to the left.
const DIVZERO: &[[(f64, f64); 3]] = &[[(6.25, 9.5), (6.75, 9.5), (6.5, 5.5)]];

/// What the book's own code was recorded to do wrong, one for each entry of
/// `tests/data/book-bugs.json`, under its name; the scenes and lines are on the cards.
pub const RECORDED: &[RecordedCase] = &[
    recorded("double_row", "book-ch2", &[[(2.0, 2.0), (10.0, 5.5), (2.0, 9.0)]]),
    recorded("no_sample", "book-ch2", &[[(1.2, 1.2), (1.8, 1.2), (1.5, 1.8)]]),
    recorded("floor_left", "book-ch2", &[[(1.9, 0.0), (3.9, 0.0), (1.9, 2.0)]]),
    recorded("y_phase", "book-ch2", &[[(5.5, 0.9), (1.0, 4.9), (10.0, 4.9)]]),
    recorded("fp_drift", "book-ch2", &[[(38.0, 26.0), (60.0, 30.0), (6.0, 20.0)]]),
    recorded(
        "shared_edge_double",
        "book-ch2",
        &[[(10.0, 10.0), (20.0, 10.0), (20.0, 20.0)], [(10.0, 10.0), (20.0, 20.0), (10.0, 20.0)]],
    ),
    recorded(
        "shared_edge_crack",
        "book-ch2",
        &[
            [(1.75, 10.0), (48.75, 10.75), (60.25, 19.75)],
            [(1.75, 10.0), (60.25, 19.75), (24.0, 35.0)],
        ],
    ),
    // A pixel to the right of the recorded one: there, turning y over rounds its area to 0.
    recorded("degenerate_drawn", "book-ch2", &[[(1.4, 5.7), (1.4, 8.7), (1.4, 10.7)]]),
    recorded(
        "tiny_dropped",
        "book-ch2",
        &[[(0.999_999_99, 0.999_999_99), (1.000_000_01, 0.999_999_99), (1.0, 1.000_000_01)]],
    ),
    recorded("negative_trunc", "book-ch2", &[[(-0.75, -0.75), (3.0, -0.75), (-0.75, 3.0)]]),
    recorded("oob", "book-ch2", &[[(-5.0, -5.0), (5.0, -5.0), (-5.0, 5.0)]]),
    recorded("int_overflow_runaway", "book-ch2", &[[(3e9, 0.0), (3e9 + 8.0, 0.0), (3e9, 8.0)]]),
    recorded("ch3_unclamped", "book-ch3", &[[(4.25, 2.99999), (3.5, 3.00001), (5.05, 3.00001)]]),
    recorded("depth_poison", "book-ch11", &[[(10.0, 0.0), (9.99, 20.0), (10.01, 20.0)]]),
    recorded(
        "z_not_clamped_after_fix",
        "book-ch11-fixed",
        &[[(1.0, 0.5), (1.0, 4.25), (9.0, 4.25)]],
    ),
    recorded("t_divzero", "book-ch11", &[[(9.75, 4.0), (10.25, 4.0), (10.0, 8.0)]]),
];

pub fn find(name: &str) -> Option<&'static Card> {
    CARDS.iter().find(|card| card.name == name)
}
