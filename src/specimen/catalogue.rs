//! The catalogue: for each specimen its source, its fault, its cure in one sentence, the case that
//! exposes it and a harmless one on which it agrees with the truth.
//!
//! Cases lie on the lattice, so that the oracle knows their truth; where the recorded input does not,
//! it is moved by less than 1/256 px. Positions are window pixels, y down.

use super::scene::{Image, Setting, Version};
use super::{
    book_near_clip, book_painter, book_viewport, games101_depth, games101_supersample,
    sysu_simple_clip, sysu_strict_t,
};

/// A specimen's card.
#[derive(Clone, Copy, Debug)]
pub struct Card {
    /// Its name.
    pub name: &'static str,
    /// Document, chapter or task, section.
    pub source: &'static str,
    /// What is wrong, in a few words.
    pub fault: &'static str,
    /// The repair in one sentence.
    pub cure: &'static str,
    /// What shows it.
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

/// Triangles to draw together.
#[derive(Clone, Copy, Debug)]
pub struct TriangleCase {
    /// Its name.
    pub name: &'static str,
    /// Side of the window in pixels.
    pub side_px: u32,
    /// Corners in pixels.
    pub corners_px: &'static [[(f64, f64); 3]],
    /// Distances of the corners.
    pub w: [f64; 3],
    /// The attribute at the corners; the depth too.
    pub values: [f64; 3],
}

/// A line to draw.
#[derive(Clone, Copy, Debug)]
pub struct LineCase {
    /// Its name.
    pub name: &'static str,
    /// First and last pixel.
    pub pixels: [(i32, i32); 2],
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

const FIGURE_2_4: &[[(f64, f64); 3]] =
    &[[(7.25, 7.50390625), (6.5, 7.49609375), (8.0625, 7.49609375)]];
const NEAR_FLOOR: &[[(f64, f64); 3]] = &[[(1.25, 12.75), (13.25, 9.75), (4.25, 1.25)]];

/// Every card, the book first.
pub const CARDS: &[Card] = &[
    Card {
        name: "book-dda",
        source: "book 2.1",
        fault: "no last pixel, truncates, drifts",
        cure: "keep the height as an exact fraction, round it, draw both ends",
        exhibit: Exhibit::Lines([
            LineCase { name: "line_drift", pixels: [(0, 9), (20, 7)] },
            LineCase { name: "ends outside", pixels: [(2, 9), (40, 9)] },
        ]),
    },
    Card {
        name: "book-ch2",
        source: "book 2.2",
        fault: "inclusive truncated spans, no pre-step",
        cure: "half-open spans of the centres between exact crossings",
        exhibit: Exhibit::Triangles([
            case("double_row", &[[(2.5, 11.5), (10.5, 8.0), (2.5, 4.5)]], ONES, FLAT),
            PLAIN,
        ]),
    },
    Card {
        name: "book-ch3",
        source: "book 3.2.4",
        fault: "no clamp, values by equal steps",
        cure: "take crossings and values at the centre, step nothing",
        exhibit: Exhibit::Triangles([case("ch3_unclamped", FIGURE_2_4, ONES, RAMP), PLAIN]),
    },
    Card {
        name: "book-affine",
        source: "book 5.3",
        fault: "w ignored",
        cure: "interpolate v/w and 1/w, divide at the pixel",
        exhibit: Exhibit::Triangles([
            case("receding", NEAR_FLOOR, [1.0, 1.0, 4.0], [0.0, 0.0, 1.0]),
            PLAIN,
        ]),
    },
    Card {
        name: "book-ch6",
        source: "book 6.2",
        fault: "depth w from the crossing, not the centre",
        cure: "evaluate the depth at the centre",
        exhibit: Exhibit::Triangles([case("depth_poison", POISON, [1.0, 1.0, 2.0], RAMP), PLAIN]),
    },
    Card {
        name: "book-ch7",
        source: "book 7.2",
        fault: "depth -1/w from the crossing",
        cure: "evaluate the depth at the centre",
        exhibit: Exhibit::Triangles([case("depth_poison", POISON, [1.0, 1.0, 2.0], RAMP), PLAIN]),
    },
    Card {
        name: "book-ch11",
        source: "book 5.4, 11",
        fault: "t' from the crossing, divides by 0",
        cure: "t' from the distance of the centre",
        exhibit: Exhibit::Triangles([case("t_divzero", DIVZERO, [1.0, 2.0, 1.0], RAMP), PLAIN]),
    },
    Card {
        name: "book-ch11-fixed",
        source: "book 11.4",
        fault: "t' held at 1 down edges only",
        cure: "t' from the distance of the centre never leaves [0, 1]",
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
        fault: "sorts triangles, not pixels",
        cure: "compare the depth of each pixel",
        exhibit: Exhibit::Scene("cyclic overlap", book_painter::draw),
    },
    Card {
        name: "book-near-clip",
        source: "book 7.4",
        fault: "edge in the plane: 0/0",
        cure: "a corner in the plane is inside, cut only edges whose ends differ",
        exhibit: Exhibit::Scene("clip7_on_plane", book_near_clip::draw),
    },
    Card {
        name: "book-viewport",
        source: "book 8.2",
        fault: "times (size - 1)",
        cure: "times size, with samples at centres",
        exhibit: Exhibit::Scene("full screen", book_viewport::draw),
    },
    Card {
        name: "games101-strict",
        source: "GAMES101 hw 2",
        fault: "samples on edges belong to none",
        cure: "top-left rule on exact edge functions",
        exhibit: Exhibit::Triangles([case("square", SQUARE, ONES, FLAT), OFF_CENTRE]),
    },
    Card {
        name: "games101-int",
        source: "GAMES101 hw 2",
        fault: "sample position through an int",
        cure: "a sample position is no whole number",
        exhibit: Exhibit::Triangles([
            case("square", SQUARE, ONES, FLAT),
            case("lucky", &[[(3.0, 1.0), (12.75, 1.25), (2.5, 12.75)]], ONES, FLAT),
        ]),
    },
    Card {
        name: "games101-depth",
        source: "GAMES101 hw 2",
        fault: "repairs z/w, which was right",
        cure: "z/w is linear on the screen: leave it",
        exhibit: Exhibit::Scene("R = 100", games101_depth::draw),
    },
    Card {
        name: "games101-average",
        source: "GAMES101 hw 2",
        fault: "averages inside the triangle loop",
        cure: "a colour for each sample, one average at the end",
        exhibit: Exhibit::Scene("split square", games101_supersample::draw),
    },
    Card {
        name: "sysu-bresenham",
        source: "SYSU 2, task 1",
        fault: "ties go with the direction",
        cure: "fix the side of ties on the sorted ends",
        exhibit: Exhibit::Lines([
            LineCase { name: "(2,1) to (0,0)", pixels: [(2, 1), (0, 0)] },
            LineCase { name: "(0,0) to (9,3)", pixels: [(0, 0), (9, 3)] },
        ]),
    },
    Card {
        name: "sysu-simple-clip",
        source: "SYSU 2, task 2",
        fault: "needs a corner inside",
        cure: "clip",
        exhibit: Exhibit::Scene("around the screen", sysu_simple_clip::draw),
    },
    Card {
        name: "sysu-inclusive",
        source: "SYSU 2, task 4",
        fault: "whole corners, edges drawn twice, i32",
        cure: "a subpixel lattice, top-left bias, wide words",
        exhibit: Exhibit::Triangles([case("square", SQUARE, ONES, FLAT), LUCKY]),
    },
    Card {
        name: "sysu-weights",
        source: "SYSU 2, task 6",
        fault: "weights in the wrong order",
        cure: "an edge's function weighs the corner opposite",
        exhibit: Exhibit::Triangles([
            case("ramp", &[[(2.5, 11.5), (11.5, 9.5), (5.5, 2.5)]], ONES, RAMP),
            LUCKY,
        ]),
    },
    Card {
        name: "sysu-truncated",
        source: "SYSU 2, task 6",
        fault: "truncates interpolated positions",
        cure: "a fragment's position is the pixel that was tested",
        exhibit: Exhibit::Triangles([
            case("ramp", &[[(2.5, 11.5), (11.5, 9.5), (5.5, 2.5)]], ONES, RAMP),
            case("lucky too", &[[(9.75, 10.75), (4.5, 5.5), (12.75, 1.25)]], ONES, FLAT),
        ]),
    },
    Card {
        name: "sysu-strict-t",
        source: "SYSU 2, task 7",
        fault: "decides by a rounded t",
        cure: "decide by the signs, assign the plane's value",
        exhibit: Exhibit::Scene("w = 336, 336, 0", sysu_strict_t::draw),
    },
];

/// The recorded input, its upper corners moved by 1/512 px onto the lattice.
const POISON: &[[(f64, f64); 3]] = &[[(6.5, 13.5), (6.4921875, 1.5), (6.5078125, 1.5)]];
/// The recorded input, moved down and to the left.
const DIVZERO: &[[(f64, f64); 3]] = &[[(6.25, 9.5), (6.75, 9.5), (6.5, 5.5)]];

/// The card called `name`.
#[must_use]
pub fn find(name: &str) -> Option<&'static Card> {
    CARDS.iter().find(|card| card.name == name)
}
