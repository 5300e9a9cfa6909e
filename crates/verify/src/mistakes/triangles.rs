//! The table of mistakes in filling triangles. To add one, add an entry: everything else follows from it.
//!
//! # Parameters
//!
//! A parameter `p` packs several choices into one number, as digits. In 'edges are moved', `p % 2` is how a distance is measured, `p / 2 % 2`
//! whether edges move in or out, and `p / 4` one of eight distances: 2 x 2 x 8 = 32 variants, which are the numbers below 32. So a
//! table needs no type for each mistake, and a search tries all variants of all mistakes by counting. The function that makes the sentence
//! (`..._said`) states the digits.

use std::ops::Range;

use super::cells;
use super::fills::{self, Metric, Words, ends_of, xs, ys};
use super::formulas::{self, FORMULAS};
use super::scans::{self, Scan};
use super::{Mistake, Parameters, border};
use crate::convention::{Mask, Quantum, RULES, Rounding, Ties, TriangleConvention, Windings};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;

/// What a mistake does, given its parameter.
#[derive(Clone, Copy)]
pub(super) enum Fill {
    /// These triangles are filled in place of the given one.
    Instead(fn(&Corners, PixelRect, i64) -> Vec<Corners>),
    /// The right picture is changed.
    Changed(fn(&mut Mask, &Corners, PixelRect, i64)),
    /// The picture is right; these pixels of it are drawn twice.
    Twice(fn(&Mask, &Corners, PixelRect, i64) -> Mask),
    /// The whole picture, from the place of the sample; the rule for ties is its own.
    Sampled(Reach, fn(&Corners, PixelRect, &TriangleConvention, i64) -> Mask),
    /// The whole picture, from the place of the sample and the rule for ties.
    Ruled(Reach, fn(&Corners, PixelRect, &TriangleConvention, i64) -> Mask),
    /// The whole picture, by a rule of its own.
    Own(fn(&Corners, PixelRect, i64) -> Mask),
}

/// What a pixel of a picture depends on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// On the triangle alone: a part of the window shows the same part of the picture.
    Pixel,
    /// On the window, or on other pixels.
    Window,
}

/// The mistake that cannot be told of a program that draws one winding.
pub(super) const BY_WINDING: &str = "rule by winding";

/// From how many pixels on the products of an edge function do not fit, about.
fn products_wrap_from(p: i64) -> i64 {
    let Words { fraction, bits, .. } = Words::of(p);
    1 << ((bits - 1) / 2 - fraction).max(0)
}

/// The farthest coordinate that its word holds, in pixels.
fn coordinates_end_at(p: i64) -> i64 {
    let (fraction, bits) = (p / 100 % 100, p % 100);
    1 << (bits - 1 - fraction)
}

/// Everything known, the simplest first.
pub(super) const TABLE: &[Mistake<Fill>] = &[
    // A program that negates the edge functions of counterclockwise triangles, but keeps the
    // comparison for ties, turns its rule round with them.
    Mistake {
        name: BY_WINDING,
        sentence: rule_by_winding_said,
        repair: "bring the corners into one winding before the fill rule is applied",
        page: "ch02-edge-functions",
        refuted: "a triangle and its reverse that draw the same samples on their edges",
        parameters: Parameters::Fixed(&PAIRS),
        draws: Fill::Sampled(Reach::Pixel, rule_by_winding),
    },
    // As `w0 >= 0 && w1 >= 0 && w2 > 0`: the comparison belongs to the place of an edge and not to its
    // direction.
    Mistake {
        name: "rule by order",
        sentence: rule_by_order_said,
        repair: "let the direction of an edge decide, and not its place in the list",
        page: "ch02-edge-functions",
        refuted: "a triangle whose corners are rotated and that draws the same samples",
        parameters: Parameters::Below(3 * OF_BOTH),
        draws: Fill::Sampled(Reach::Pixel, rule_by_order),
    },
    // The bias of the fill rule is 1 in the unit of the edge function. After a shift by n bits, 1 is
    // 2^n of these units.
    Mistake {
        name: "rule after the shift",
        sentence: rule_after_shift_said,
        repair: "apply the fill rule to the edge function before its bits are shifted out",
        page: "ch02-edge-functions",
        refuted: "a sample closer to an edge than the bits that are shifted out, and drawn rightly",
        parameters: Parameters::Fixed(&[
            4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 104, 106, 108, 110, 112, 116, 204, 206, 208, 210,
            212, 216, 304, 306, 308, 310, 312, 316,
        ]),
        draws: Fill::Ruled(Reach::Pixel, rule_after_shift),
    },
    // Where `w >= 0` failed for samples on an edge in floats, programs have been mended by `w >=
    // -1e-5`.
    Mistake {
        name: "an epsilon in the test",
        sentence: epsilon_said,
        repair: "snap the corners to a grid, where an edge function is exactly 0 or not, and follow a fill rule",
        page: "ch02-edge-functions",
        refuted: "a sample in that strip that is drawn rightly",
        parameters: Parameters::Fixed(&[
            0, 1, 2, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15, 16, 20, 21, 22, 23, 24, 25, 26, 30, 31,
            32, 33, 34, 35, 36,
        ]),
        draws: Fill::Sampled(Reach::Pixel, epsilon),
    },
    // The three areas that a point makes with the sides add up to the whole area for points inside
    // only, and in floats hardly ever exactly.
    Mistake {
        name: "areas are compared",
        sentence: areas_said,
        repair: "test the sign of the three edge functions, in whole numbers",
        page: "ch02-edge-functions",
        refuted: "a large triangle that is drawn wholly",
        parameters: Parameters::Below(4 * AREAS.len() as i64),
        draws: Fill::Sampled(Reach::Pixel, |corners, window, base, p| {
            formulas::by_areas(corners, window, base, AREAS[(p / 4) as usize], p)
        }),
    },
    // As in a loop that ends at `i < 2`, or where the third weight is taken from the others and never
    // looked at.
    Mistake {
        name: "an edge is not tested",
        sentence: untested_edge_said,
        repair: "test all three edges",
        page: "ch02-edge-functions",
        refuted: "a sample beyond that edge alone that is not drawn",
        parameters: Parameters::Below(3 * ORDERS.len() as i64),
        draws: Fill::Ruled(Reach::Pixel, untested_edge),
    },
    // The difference of two coordinates has a bit more than they have, and a product twice as many.
    Mistake {
        name: "product overflows",
        sentence: short_words_said,
        repair: "multiply in words of twice the length, or limit the coordinates",
        page: "stability",
        refuted: "a triangle whose products do not fit and that is drawn rightly",
        parameters: Parameters::Words(
            &[
                832, 432, 32, 16, 416, 632, 1832, 1432, 1032, 1016, 1416, 1632, 2832, 2432, 3832,
                3432, 824, 424, 24, 1824, 1424, 1024, 2824, 3824, 816, 1816, 848, 1848,
            ],
            |p| products_wrap_from(p) / 4,
        ),
        draws: Fill::Ruled(Reach::Pixel, fills::wrapping),
    },
    // A narrow vertex format, such as 12.4 in 16 bits, holds coordinates up to 2,048 px.
    Mistake {
        name: "coordinates overflow",
        sentence: short_coordinates_said,
        repair: "clip to a guard band that the word holds, or use a longer word",
        page: "stability",
        refuted: "a triangle with such a corner that is drawn rightly",
        parameters: Parameters::Words(
            &[16, 416, 616, 816, 10_016, 10_416, 10_616, 10_816, 1632, 11_632],
            coordinates_end_at,
        ),
        draws: Fill::Instead(|corners, _, p| {
            vec![fills::in_words(corners, p / 10_000 == 1, p / 100 % 100, p % 100)]
        }),
    },
    // A float of 32 bits holds 1/256 px up to 65,536 px; one of 16 bits up to 8 px.
    Mistake {
        name: "coordinates in short floats",
        sentence: short_floats_said,
        repair: "keep corners as integers in subpixels, or in floats of 32 bits",
        page: "stability",
        refuted: "a corner with more significant bits whose edges pass where they should",
        parameters: Parameters::Fixed(&[10, 7, 15, 110, 107, 115]),
        draws: Fill::Instead(short_floats),
    },
    // As where x is snapped on the way to the edge functions, and y on the way to the loop over rows.
    Mistake {
        name: "each axis on a grid of its own",
        sentence: two_grids_said,
        repair: "snap both coordinates to the same grid in the same way, once, for every triangle",
        page: "ch01",
        refuted: "a corner that these grids move apart and whose edges pass where they should",
        parameters: Parameters::Below(AXIS * AXIS),
        draws: Fill::Instead(two_grids),
    },
    // Conservative rasterization moves edges out by half a pixel; a mistaken bias moves them by less.
    Mistake {
        name: "edges are moved",
        sentence: moved_edges_said,
        repair: "leave the edges where the corners put them: what neighbours share is drawn by one of them then",
        page: "ch02-edge-functions",
        refuted: "a sample in that strip that is drawn rightly",
        parameters: Parameters::Below(32),
        draws: Fill::Ruled(Reach::Pixel, moved_edges),
    },
    // Weights in fixed point are enough for values, and not for the question whether a sample is
    // inside.
    Mistake {
        name: "weights are cut",
        sentence: cut_weights_said,
        repair: "test the edge functions before they are divided",
        page: "ch02-edge-functions",
        refuted: "a sample whose weight is below a step and that is drawn rightly",
        parameters: Parameters::Below(80 * (1 + RECIPROCAL_BITS.len() as i64)),
        draws: Fill::Sampled(Reach::Pixel, cut_weights),
    },
    // A quick way to keep coordinates in a word or in the window, and one that moves edges.
    Mistake {
        name: "corners are clamped",
        sentence: clamped_corners_said,
        repair: "clip the edges, or draw the box of the triangle within the window by unchanged edges",
        page: "ch07",
        refuted: "a triangle with a corner outside whose edges keep their slope",
        parameters: Parameters::Clamps,
        draws: Fill::Instead(clamped_corners),
    },
    // Two neighbours cut a shared edge from opposite ends. Rounded, the two new corners need not be
    // the same.
    Mistake {
        name: "corners made by clipping are rounded",
        sentence: clipped_corners_said,
        repair: "keep the unclipped edges for the fill, or compute new corners in the same order for both neighbours and with more bits",
        page: "ch07",
        refuted: "a triangle that crosses the border at a point between those of the grid and is drawn rightly",
        parameters: Parameters::Below(12),
        draws: Fill::Instead(|corners, window, p| {
            fills::clipped(corners, window, CLIP_STEPS[(p % 4) as usize].into(), p / 4)
        }),
    },
    // The long edge is drawn in two pieces, and their common end is not on it.
    Mistake {
        name: "split at a rounded corner",
        sentence: split_corner_said,
        repair: "walk both halves along the unsplit long edge",
        page: "ch02-scanline",
        refuted: "a triangle whose long edge passes between two points of that grid and is drawn rightly",
        parameters: Parameters::Below(10),
        draws: Fill::Instead(|corners, _, p| {
            fills::split(corners, STEPS_WITH_ONE[(p % 5) as usize], p / 5 == 1)
        }),
    },
    // As a test against degenerate triangles does whose threshold is too large.
    Mistake {
        name: "triangles are left out by size",
        sentence: left_out_by_size_said,
        repair: "remove the test, or leave out only what covers no sample",
        page: "effects",
        refuted: "a triangle beyond that size that is drawn",
        parameters: Parameters::Sizes,
        draws: Fill::Changed(left_out_by_size),
    },
    // Where `area < epsilon` stands for `area < 0`, both windings of a small triangle pass.
    Mistake {
        name: "small ones are drawn from behind",
        sentence: small_from_behind_said,
        repair: "the sign of the area alone decides about the winding, without a threshold",
        page: "ch02-edge-functions",
        refuted: "such a triangle that is not drawn",
        parameters: Parameters::Sizes,
        draws: Fill::Ruled(Reach::Pixel, small_from_behind),
    },
    // Each kind is a branch that a program may have forgotten, such as the one of a level upper edge.
    Mistake {
        name: "triangles are left out by kind",
        sentence: |p| format!("does not draw triangles {}", KINDS[p as usize].0),
        repair: "treat this kind as any other: it covers samples",
        page: "ch02",
        refuted: "a triangle of that kind that is drawn",
        parameters: Parameters::Below(KINDS.len() as i64),
        draws: Fill::Changed(|mask, corners, window, p| {
            if KINDS[p as usize].1(corners, window) {
                *mask = Mask::default();
            }
        }),
    },
    // A fill by two loops, of which one does not run, or begins a row late.
    Mistake {
        name: "a half is missing",
        sentence: missing_half_said,
        repair: "fill both halves: the lower one begins in the row where the upper one ends",
        page: "ch02-scanline",
        refuted: "a pixel of the other half that is drawn",
        parameters: Parameters::Below(4),
        draws: Fill::Changed(missing_half),
    },
    // `<` in place of `<=` at one end of a loop, or the other way.
    Mistake {
        name: "ends of rows or columns",
        sentence: |p| ENDS[p as usize].to_owned(),
        repair: "compare the bounds of the loop with the fill rule: one of them is one off",
        page: "ch02-scanline",
        refuted: "a row or column with both of its ends right",
        parameters: Parameters::Below(10),
        draws: Fill::Changed(fills::ends),
    },
    border(Fill::Changed(|mask, _, window, p| fills::without_border(mask, window, p))),
    // The box is in pixels and the corners are not: the end of a loop is easily cut down where it has
    // to be rounded up.
    Mistake {
        name: "the box is too small",
        sentence: small_box_said,
        repair: "the box runs from the floor of the smallest coordinate to the ceiling of the largest one",
        page: "games101",
        refuted: "a covered pixel outside that box that is drawn",
        parameters: Parameters::Below(24),
        draws: Fill::Changed(small_box),
    },
    // As `min(a.x, b.x)` does where `min(a.x, min(b.x, c.x))` was meant.
    Mistake {
        name: "the box misses a corner",
        sentence: box_of_two_said,
        repair: "the box holds all three corners",
        page: "games101",
        refuted: "a covered pixel near that corner that is drawn",
        parameters: Parameters::Below(2 * BOXES_OF_TWO),
        draws: Fill::Changed(box_of_two),
    },
    // A square test picture does not show it.
    Mistake {
        name: "width and height are exchanged",
        sentence: exchanged_sides_said,
        repair: "columns end at the width, and rows at the height",
        page: "ch11",
        refuted: "a pixel beyond that in a window that is no square",
        parameters: Parameters::Below(3),
        draws: Fill::Changed(|mask, _, window, p| {
            mask.retain(window, &|x, y| (p == 1 || x < window.y1) && (p == 0 || y < window.x1));
        }),
    },
    // A tile may hold a part of the triangle although no corner of the tile lies in it.
    Mistake {
        name: "tiles are skipped",
        sentence: skipped_tiles_said,
        repair: "reject a tile only where one edge has the whole tile outside, and test each pixel of the others",
        page: "speed",
        refuted: "a covered pixel in such a tile that is drawn",
        parameters: Parameters::Fixed(&TILES),
        draws: Fill::Changed(fills::tiles),
    },
    // One decision for several pixels, as coarse shading or a quad of 2 x 2 px has it.
    Mistake {
        name: "blocks are drawn whole",
        sentence: whole_blocks_said,
        repair: "test the sample of each pixel",
        page: "speed",
        refuted: "two pixels of such a block of which one is drawn",
        parameters: Parameters::Below(125),
        draws: Fill::Ruled(Reach::Pixel, fills::blocks),
    },
    // Vector code draws 4 or 8 pixels at once. What does not fill a group needs code of its own.
    Mistake {
        name: "the rest of a group",
        sentence: rest_of_group_said,
        repair: "draw what is left after the last whole group pixel by pixel, or by a mask",
        page: "speed",
        refuted: "a row whose length is no multiple of the group and that is right",
        parameters: Parameters::Below(48),
        draws: Fill::Changed(fills::groups),
    },
    // Coverage is right, and only blending or a counter shows it.
    Mistake {
        name: "pixels are drawn twice",
        sentence: drawn_twice_said,
        repair: "compare the bounds of the loops: one ends where the next one begins",
        page: "ch02-scanline",
        refuted: "such a pixel that is drawn once",
        parameters: Parameters::Below(10),
        draws: Fill::Twice(fills::twice),
    },
    // As in a loop that adds integers for a step along x and along y, where corners had a fraction.
    Mistake {
        name: "edges in whole numbers",
        sentence: whole_edges_said,
        repair: "keep the fraction of the steps, or snap the corners before the steps are computed",
        page: "ch02-edge-functions",
        refuted: "a long edge between corners with a fraction that passes where it should",
        parameters: Parameters::Below(16),
        draws: Fill::Ruled(Reach::Pixel, fills::cut_edges),
    },
    // It depends on the window alone: an unrolled loop, or a thread that got no rows.
    Mistake {
        name: "parts of the window are never drawn",
        sentence: missing_parts_said,
        repair: "look at the last iteration of the loop over groups of rows or columns",
        page: "speed",
        refuted: "a pixel there that is drawn",
        parameters: Parameters::Fixed(&GROUPS),
        draws: Fill::Changed(missing_parts),
    },
    // A morphological filter, or a test of four corners of a pixel in place of its sample.
    Mistake {
        name: "neighbours of covered pixels",
        sentence: neighbours_said,
        repair: "test the sample of the pixel alone",
        page: "ch02",
        refuted: "a pixel at an edge that is drawn rightly",
        parameters: Parameters::Below(2 * fills::NEIGHBOURS.len() as i64),
        draws: Fill::Sampled(Reach::Pixel, fills::grown),
    },
    // As interlaced displays and mosaic patterns do, or an index that is off by one in a pair of rows.
    Mistake {
        name: "every second row or column is moved",
        sentence: alternating_said,
        repair: "test the same place in every pixel",
        page: "ch02",
        refuted: "a pixel at an edge in such a row or column that is drawn rightly",
        parameters: Parameters::Below(32),
        draws: Fill::Sampled(Reach::Pixel, fills::alternating),
    },
    // Programs that look for the span of a row go on from that of the row before, which is right for
    // edges to one side.
    Mistake {
        name: "the search for pixels ends too early",
        sentence: early_end_said,
        repair: "look through the whole box, or walk back to where the edge lies",
        page: "speed",
        refuted: "a covered pixel that lies there and is drawn",
        parameters: Parameters::Below(3),
        draws: Fill::Changed(|mask, _, window, p| fills::searched(mask, window, p)),
    },
    // The first column is clamped to the window and the count of pixels is not made smaller.
    Mistake {
        name: "rows keep their length at the window",
        sentence: slid_rows_said,
        repair: "clip both ends of a row, and take its length after that",
        page: "ch07",
        refuted: "a row that begins left of the window and ends where it should",
        parameters: Parameters::Fixed(&[0]),
        draws: Fill::Sampled(Reach::Window, slid_rows),
    },
    // The corners are on the grid and the formula is right. What it computes in floats is not exact.
    Mistake {
        name: "rounding of floats",
        sentence: floats_said,
        repair: "snap the corners to a grid and compute the edge functions in integers",
        page: "stability",
        refuted: "a sample on an edge that this formula rounds away and that is drawn rightly",
        // A formula, whether corners are exchanged where they turn the other way, and the precision.
        parameters: Parameters::Below(6 * FORMULAS.len() as i64),
        draws: Fill::Ruled(Reach::Pixel, |corners, window, base, p| {
            formulas::by_formula(corners, window, base, (p / 6) as usize, p / 3 % 2 == 0, p % 3)
        }),
    },
    // The slope of an edge has no exact number, and its error is added in each row.
    Mistake {
        name: "crossings are stepped",
        sentence: Scan::sentence,
        repair: "compute each crossing from the corner, or keep the remainder of the division as Bresenham's algorithm does",
        page: "ch02-scanline",
        refuted: "a long edge whose last rows are where they should be",
        parameters: Parameters::Scans(Scan::is_rounded),
        draws: Fill::Own(scans::scanned),
    },
    // Two corners in one row of pixels stay in the order in which they are given.
    Mistake {
        name: "corners are sorted by whole rows",
        sentence: Scan::sentence,
        repair: "sort by the heights that slopes are computed from",
        page: "ch02-scanline",
        refuted: "two corners in one row, the lower one first, and a triangle that is drawn rightly",
        parameters: Parameters::Scans(Scan::is_sorted_by_rows),
        draws: Fill::Own(scans::scanned),
    },
    // Crossings are exact, and become pixels in another way than by samples at centres.
    Mistake {
        name: "rows end elsewhere",
        sentence: Scan::sentence,
        repair: "keep the fraction of the corners, take the crossings at the height of the samples, and draw the samples between them",
        page: "ch02-scanline",
        refuted: "a row whose ends are where they should be",
        parameters: Parameters::Scans(Scan::is_exact),
        draws: Fill::Own(scans::scanned),
    },
    // As a program does that draws the outline after the fill.
    Mistake {
        name: "all that edges touch",
        sentence: touched_said,
        repair: "draw the samples within the triangle alone, or declare that all that is touched is drawn, and compute it exactly",
        page: "ch02",
        refuted: "a pixel that is touched and is not drawn",
        parameters: Parameters::Below(3),
        draws: Fill::Ruled(Reach::Window, touched),
    },
    // Antialiasing counts how much of a pixel is covered; with a threshold its picture has no grey.
    Mistake {
        name: "coverage by area",
        sentence: area_said,
        repair: "test one sample of each pixel: what neighbours share is drawn by one of them then",
        page: "ch02",
        refuted: "a pixel of which less is covered and that is drawn",
        parameters: Parameters::Below(4),
        draws: Fill::Own(|corners, window, p| {
            cells::by_area(&cells::places(corners), window, cells::LEAST[p as usize])
        }),
    },
    // The loop of many tutorials: one function for a level lower side, and one for a level upper side.
    Mistake {
        name: "two halves from their tips",
        sentence: two_halves_said,
        repair: "walk both halves along the unsplit long edge, and take each crossing at the height of the samples",
        page: "ch02-scanline",
        refuted: "a triangle with its top cut off that draws the same rows below",
        parameters: Parameters::Below(fills::HALVES.count()),
        draws: Fill::Own(fills::halves),
    },
    // The loop of small display libraries, in which neighbours overlap along shared edges.
    Mistake {
        name: "whole pixels by integer divisions",
        sentence: whole_pixels_said,
        repair: "neighbours draw the pixels of a shared edge twice: keep the fraction of the corners and follow a fill rule",
        page: "ch02-scanline",
        refuted: "a corner whose fraction moves an edge",
        parameters: Parameters::Below(128),
        draws: Fill::Own(fills::whole_pixels),
    },
    // The polygon fill of many image libraries, which draws both ends of a row.
    Mistake {
        name: "whole pixels between crossings",
        sentence: crossings_said,
        repair: "keep the fraction of the corners, and draw the samples between the crossings: what lies on the right edge belongs to the neighbour",
        page: "ch02-scanline",
        refuted: "a corner whose fraction moves an edge",
        parameters: Parameters::Below(96),
        draws: Fill::Own(fills::crossings),
    },
    // A test that is always true, or one that finds the border of what another program fills.
    Mistake {
        name: "the whole box is filled",
        sentence: whole_box_said,
        repair: "test every sample against the three edges",
        page: "ch02-edge-functions",
        refuted: "a corner of the box that is not drawn",
        parameters: Parameters::Fixed(&[0, 1, 2]),
        draws: Fill::Changed(whole_box),
    },
];

/// p is one of `PAIRS`.
fn rule_by_winding_said(p: i64) -> String {
    let (clockwise, other) = pair(p);
    format!(
        "follows the {} rule for clockwise triangles and the {} rule for the others",
        RULES[clockwise], RULES[other]
    )
}

/// Since the corners are not brought into one winding, neighbours that turn differently follow different rules.
fn rule_by_winding(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let (clockwise, other) = pair(p);
    let rule = if twice_area(corners) > 0 { clockwise } else { other };
    base.with_rule(RULES[rule]).mask(corners, window).unwrap_or_default()
}

/// The digits of p to base 3 say of each edge whether it has no ties, all ties, or those that the top-left rule
/// gives it; then comes one of `ORDERS`, and of which winding all this is true.
/// For example, 1 draws all ties on the first edge and none on the others.
fn rule_by_order_said(p: i64) -> String {
    let (owned, order, winding) = (p % 27, p / 27 % ORDERS.len() as i64, p / OF_BOTH);
    let edges = [
        "from the first corner to the second",
        "from the second to the third",
        "from the third to the first",
    ];
    // The edges with all ties, and those with the ties of the top-left rule.
    let (mut drawn, mut ruled) = (Vec::new(), Vec::new());
    for (i, edge) in edges.into_iter().enumerate() {
        match owned / 3_i64.pow(i as u32) % 3 {
            1 => drawn.push(edge),
            2 => ruled.push(edge),
            _ => {}
        }
    }
    let (drawn, ruled) = (drawn.join(" and "), ruled.join(" and "));
    let mut words = if ruled.is_empty() {
        format!("draws samples on the edge {drawn} and on no other")
    } else if drawn.is_empty() {
        format!("draws samples on the edge {ruled} if the top-left rule does, and on no other")
    } else {
        format!(
            "draws all samples on the edge {drawn}, and on the edge {ruled} if the top-left rule does"
        )
    };
    words += &order_said(order);
    words += ["", " (of clockwise triangles alone)", " (of counterclockwise triangles alone)"]
        [winding as usize];
    words
}

/// Ties by the place of an edge in the list of corners. Triangles of the other winding follow the top-left rule
/// where p is of one winding alone.
fn rule_by_order(corners: &Corners, window: PixelRect, base: &TriangleConvention, p: i64) -> Mask {
    let (base, clockwise) = (base.with_rule(RULES[0]), twice_area(corners) > 0);
    // The same for all edges is no rule by order.
    if matches!(p % 27, 0 | 13 | 26) && p < OF_BOTH {
        return Mask::default();
    }
    let order = p / 27 % ORDERS.len() as i64;
    // Of the winding that is right, the direction of an edge decides.
    let is_ruled = p / OF_BOTH == if clockwise { 2 } else { 1 };
    fills::by_edges(corners, window, &base, &|edge, value, owns| {
        // The digit of the edge, by its place after corners are exchanged.
        let edge = place_of_edge(edge, order, clockwise) as u32;
        let owns = match p / 3_i64.pow(edge) % 3 {
            _ if is_ruled => owns,
            0 => false,
            1 => true,
            _ => owns,
        };
        value > 0 || (value == 0 && owns)
    })
}

/// p / 100 is what is done after the shift, where odd numbers divide in its place, and p mod 100 is how many bits
/// are shifted out.
/// For example, 104 divides by 16 and then subtracts 1.
fn rule_after_shift_said(p: i64) -> String {
    let (how, bits) = (p / 100, p % 100);
    // The three comparisons differ in which side of the edge loses or gains a strip.
    let cut = if how % 2 == 0 { "shifted down" } else { "divided" };
    match how {
        0 | 1 => format!(
            "subtracts 1 for the fill rule after the edge function was {cut} by {bits} bits, so that edges without the rule lose more than their ties"
        ),
        2 => format!(
            "asks for more than 0 after the edge function was {cut} by {bits} bits, so that a strip along every edge is lost"
        ),
        _ => format!(
            "compares the edge function after it was {cut} by {bits} bits, so that a strip outside every edge is drawn"
        ),
    }
}

/// A shift makes small values inside 0, and a division those outside, too.
fn rule_after_shift(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let (how, bits) = (p / 100, p % 100);
    fills::by_edges(corners, window, base, &|_, value, owns| {
        // Both lose the same bits, and differ below 0.
        let cut = if how % 2 == 0 { value >> bits } else { value / (1 << bits) };
        match how {
            0 | 1 => cut - i128::from(!owns) >= 0,
            2 => cut > 0,
            _ => cut >= 0,
        }
    })
}

/// p mod 10 is one of `EPSILONS`, p / 10 mod 2 what is compared with it, and from 20 on the strip is lost and not
/// drawn.
/// For example, 13 draws where the edge function is above -1e-4 square pixels.
fn epsilon_said(p: i64) -> String {
    // A weight has no unit, and the edge function that of an area.
    let what =
        ["weights of the corners are", "edge function in square pixels is"][(p / 10 % 2) as usize];
    let size = EPSILONS[(p % 10) as usize];
    match p / 20 {
        0 => format!(
            "draws where the {what} above -{size:e}, so that a strip outside every edge is drawn"
        ),
        _ => format!(
            "draws where the {what} above {size:e}, so that a strip inside every edge is lost"
        ),
    }
}

/// A weight is the edge function as a part of the area: there the strip is wider in a large triangle. In square pixels it is
/// narrower along a long edge.
fn epsilon(corners: &Corners, window: PixelRect, base: &TriangleConvention, p: i64) -> Mask {
    let whole = if p / 10 % 2 == 0 { twice_area(corners).abs() as f64 } else { 65536.0 };
    let size = EPSILONS[(p % 10) as usize];
    fills::by_edges(corners, window, base, &|_, value, _| match p / 20 {
        0 => value as f64 / whole >= -size,
        _ => value as f64 / whole > size,
    })
}

/// p mod 2 is the precision, p / 2 mod 2 whether areas are halved, and p / 4 one of `AREAS`.
/// For example, 9 compares twice the areas in floats of 64 bits, which may be off by 1e-6.
fn areas_said(p: i64) -> String {
    let (bits, most) = (["32", "64"][(p % 2) as usize], AREAS[(p / 4) as usize]);
    let areas = ["twice the areas", "the areas"][(p / 2 % 2) as usize];
    format!(
        "draws where {areas} that a sample makes with the sides add up to the whole, in floats of {bits} bits, with at most {most:e} between"
    )
}

/// p mod 3 is the edge and p / 3 one of `ORDERS`.
/// For example, 4 leaves out the edge from the second corner to the third, after an exchange.
fn untested_edge_said(p: i64) -> String {
    format!(
        "does not test the edge {}{}",
        [
            "from the first corner to the second",
            "from the second corner to the third",
            "from the third corner to the first"
        ][(p % 3) as usize],
        order_said(p / 3)
    )
}

/// The edge has its number after corners are exchanged, as it has in a program that does this first.
fn untested_edge(corners: &Corners, window: PixelRect, base: &TriangleConvention, p: i64) -> Mask {
    let clockwise = twice_area(corners) > 0;
    fills::by_edges(corners, window, base, &|edge, value, owns| {
        let edge = place_of_edge(edge, p / 3, clockwise);
        edge as i64 == p % 3 || value > 0 || (value == 0 && owns)
    })
}

/// p is read by `Words::of`.
/// For example, 832 is 8 bits of fraction in 32 bits.
fn short_words_said(p: i64) -> String {
    let Words { fraction, bits, products_alone, .. } = Words::of(p);
    // Half of the word's bits are left for each factor.
    let from = products_wrap_from(p);
    let what = match products_alone {
        true => "the products of the edge function",
        false => "the edge function",
    };
    format!(
        "computes {what} of coordinates with {fraction} bits of fraction in {bits} bits: the products wrap around from about {from} px on"
    )
}

/// p mod 100 is the number of bits, p / 100 mod 100 those of the fraction, and from 10,000 on coordinates are
/// clamped.
/// For example, 10,416 clamps coordinates with 4 bits of fraction in 16 bits: to 2,048 px.
fn short_coordinates_said(p: i64) -> String {
    let (how, fraction, bits) = (p / 10_000, p / 100 % 100, p % 100);
    // From there on corners move.
    let most = coordinates_end_at(p);
    let what = if how == 0 { "wrap around" } else { "are clamped" };
    format!(
        "keeps coordinates with {fraction} bits of fraction in {bits} bits: corners beyond {most} px {what}"
    )
}

/// p mod 100 is how many bits follow the first one, and from 100 on the rest is cut.
/// For example, 110 cuts to half floats, which have 10 bits after the first one.
fn short_floats_said(p: i64) -> String {
    let how = ["rounded", "cut"][(p / 100) as usize];
    // Formats with a name.
    let kind = match p % 100 {
        10 => " (as a half float)",
        7 => " (as a bfloat16)",
        _ => "",
    };
    format!(
        "keeps coordinates in floats with {} significant bits{kind}, {how}: from {} px on they lose subpixels",
        p % 100 + 1,
        1_i64 << (p % 100 - 7)
    )
}

/// Corners lose the bits that do not fit, and edges move with them.
fn short_floats(corners: &Corners, _: PixelRect, p: i64) -> Vec<Corners> {
    let short = |v: i32| fills::shortened(v, p % 100, p >= 100);
    vec![corners.map_array(|c| SubpixelPoint::new(short(c.x), short(c.y)))]
}

/// p is read by `axes`.
/// For example, 1 cuts x down to whole pixels and leaves y as it is.
fn two_grids_said(p: i64) -> String {
    let [x, y] = axes(p).map_array(|axis| match axis.step {
        1 => "keeps its fraction".to_owned(),
        step => format!("is moved to {} ({})", grid(step), ROUNDINGS[axis.rounding].0),
    });
    format!("puts the coordinates of corners on two grids: x {x}, y {y}, so that slopes change")
}

/// Draws nothing where both axes have the same grid, since that is a convention of its own.
fn two_grids(corners: &Corners, _: PixelRect, p: i64) -> Vec<Corners> {
    let [x, y] = axes(p);
    // To the nearest is nearly the same on both axes whatever becomes of halves.
    let is_alike = x.rounding == y.rounding || (x.is_nearest() && y.is_nearest());
    if x.step == y.step && is_alike {
        return Vec::new();
    }
    vec![corners.map_array(|c| SubpixelPoint::new(x.moved(c.x), y.moved(c.y)))]
}

/// p mod 2 is how the distance is measured, p / 2 mod 2 whether edges move out, and p / 4 one of `OFFSETS`.
/// For example, 22 moves edges out by 1/4 px, measured in x and y together.
fn moved_edges_said(p: i64) -> String {
    let (norm, outward, size) = (p % 2, p / 2 % 2, OFFSETS[(p / 4) as usize]);
    let along = ["in x and y together", "at right angles"][norm as usize];
    let (way, what) = [("in", "lost"), ("out", "drawn")][outward as usize];
    format!(
        "moves every edge {way} by {} px {along}, so that a strip along it is {what}",
        fills::decimal(size, 256)
    )
}

/// An edge function grows by the length of its edge for each subpixel across it. Programs that avoid the square
/// root take the sum of both sides for the length, and so move slanted edges too far.
fn moved_edges(corners: &Corners, window: PixelRect, base: &TriangleConvention, p: i64) -> Mask {
    let (norm, outward, size) = (p % 2, p / 2 % 2 == 1, OFFSETS[(p / 4) as usize]);
    let mut strips = [0.0; 3];
    for (i, strip) in strips.iter_mut().enumerate() {
        let [a, b] = [corners[i], corners[(i + 1) % 3]];
        let dx = (f64::from(b.x) - f64::from(a.x)).abs();
        let dy = (f64::from(b.y) - f64::from(a.y)).abs();
        // The length of the edge, by which its function grows for each subpixel across it.
        let length = if norm == 0 { dx + dy } else { (dx * dx + dy * dy).sqrt() };
        *strip = length * size as f64;
    }
    fills::by_edges(corners, window, base, &|edge, value, owns| {
        let value = value as f64 + if outward { strips[edge] } else { -strips[edge] };
        value > 0.0 || (value == 0.0 && owns)
    })
}

/// p mod 2 is how weights are cut, p / 2 mod 5 which one is left over, p / 10 mod 8 one of `WEIGHT_BITS`, and p /
/// 80 one of `RECIPROCAL_BITS`, or 0 for a division.
/// For example, 21 divides, and cuts all three weights down to 8 bits.
fn cut_weights_said(p: i64) -> String {
    let bits = WEIGHT_BITS[(p / 10 % 8) as usize];
    let cut = ["toward zero", "down"][(p % 2) as usize];
    let how = match p / 80 {
        0 => "divides the edge functions by the area into".to_owned(),
        // Faster than a division, and wrong by another error.
        of => format!(
            "multiplies the edge functions by a reciprocal of the area of {} bits into",
            RECIPROCAL_BITS[of as usize - 1]
        ),
    };
    format!(
        "{how} weights of {bits} bits, cut {cut}{}: a strip along edges is drawn or lost",
        if p / 2 % 5 == 0 { "" } else { ", one of them being what is left of 1" }
    )
}

/// Weights in whole numbers: where they are cut toward zero, small negative ones become 0 and are drawn.
fn cut_weights(corners: &Corners, window: PixelRect, base: &TriangleConvention, p: i64) -> Mask {
    let bits = WEIGHT_BITS[(p / 10 % 8) as usize];
    let area = twice_area(corners);
    let whole = area.abs().max(1);
    // A reciprocal of the area is cut, and then each weight.
    let reciprocal = (p >= 80).then(|| RECIPROCAL_BITS[(p / 80 - 1) as usize]);
    let cut = |value: i128| match (reciprocal, p % 2) {
        (Some(more), 0) => (value * ((1 << more) / whole)) / (1 << (more - bits)),
        (Some(more), _) => (value * ((1 << more) / whole)) >> (more - bits),
        (_, 0) => (value << bits) / whole,
        _ => (value << bits).div_euclid(whole),
    };
    // Which one is left over, or another one where two corners are exchanged first.
    let [this, other] = if area > 0 { [2, 0] } else { [0, 2] };
    let rest = [None, Some(2), Some(0), Some(this), Some(other)];
    let rest = rest[(p / 2 % 5) as usize];
    fills::by_all_edges(corners, window, base, &|values| {
        // The weight that is left over is what the others do not have of 1.
        let mut weights = values.map_array(cut);
        if let Some(rest) = rest {
            weights[rest] = 0;
            weights[rest] = (1 << bits) - weights.iter().sum::<i128>();
        }
        weights.iter().all(|weight| *weight >= 0)
    })
}

/// p is read by `clamp_of`.
/// For example, 1,541 moves x to the range from -128 to 127 px.
fn clamped_corners_said(p: i64) -> String {
    let [limit, axes, _] = clamp_of(p);
    // Places that depend on the window have names, and others are ranges.
    let where_ = match limit {
        0 => "the window".to_owned(),
        1 => "the last pixels of the window".to_owned(),
        2 => "the upper and left border".to_owned(),
        3 => "the lower and right border".to_owned(),
        4 => "a guard band as wide as the window around it".to_owned(),
        5 => "a guard band half as wide as the window around it".to_owned(),
        _ => {
            let [low, high] = clamped_to(p, 0);
            format!("the range from {} to {} px", low / 256, high / 256)
        }
    };
    format!(
        "moves {} that lie outside to {where_}, so that the slopes of edges change",
        ["corners", "x of corners", "y of corners"][axes as usize]
    )
}

/// The corners move and not the edges: every edge to a corner that lies outside gets another slope.
fn clamped_corners(corners: &Corners, window: PixelRect, p: i64) -> Vec<Corners> {
    let [_, axes, _] = clamp_of(p);
    // Each coordinate has its range, and only those that the parameter names are moved.
    let ([left, right], [top, bottom]) = (clamped_to(p, window.x1), clamped_to(p, window.y1));
    let mut moved = *corners;
    for c in &mut moved {
        if axes != 2 {
            c.x = c.x.clamp(left, right);
        }
        if axes != 1 {
            c.y = c.y.clamp(top, bottom);
        }
    }
    vec![moved]
}

/// p mod 4 is one of `CLIP_STEPS` and p / 4 how the new corners are brought to it.
/// For example, 6 rounds new corners to the nearest 1/16 px.
fn clipped_corners_said(p: i64) -> String {
    let (step, how) = (
        CLIP_STEPS[(p % 4) as usize],
        ["cut toward the corner where the walk began", "rounded to the nearest", "cut down"]
            [(p / 4) as usize],
    );
    let grid = grid(step);
    format!(
        "clips triangles at the window and the corners that this makes are {how}, to {grid}: shared edges that cross the border leave holes and doubles"
    )
}

/// p mod 5 is one of `STEPS_WITH_ONE`, and from 5 on the point is cut down.
/// For example, 6 cuts the new corner down to 1/2 px.
fn split_corner_said(p: i64) -> String {
    let step = STEPS_WITH_ONE[(p % 5) as usize];
    let how = if p / 5 == 0 { "rounded to the nearest" } else { "cut down" };
    format!(
        "splits at the height of the middle corner, at a point that is {how} to 1/{} px, so that the long edge has a kink",
        256 / step
    )
}

/// p is read by `size`.
fn left_out_by_size_said(p: i64) -> String {
    let (what, limit) = size_said(p);
    format!(
        "does not draw triangles whose {what} is {} about {limit}",
        if size(p).is_below { "below" } else { "at least" }
    )
}

/// Leaves out what lies below the limit, or at it and above.
fn left_out_by_size(mask: &mut Mask, corners: &Corners, _: PixelRect, p: i64) {
    let SizeLimit { metric, is_below, limit } = size(p);
    if (fills::metric(corners, metric) < limit) == is_below {
        *mask = Mask::default();
    }
}

/// p is read by `size`.
fn small_from_behind_said(p: i64) -> String {
    let (what, limit) = size_said(p);
    format!(
        "draws triangles of the winding that it does not draw where their {what} is below about {limit}"
    )
}

/// As where a program takes a small area for 0, and draws what has no area.
fn small_from_behind(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let SizeLimit { metric, is_below, limit } = size(p);
    let is_small = is_below && fills::metric(corners, metric) < limit;
    let draws = if is_small { Windings::Both } else { base.draws };
    TriangleConvention { draws, ..*base }.mask(corners, window).unwrap_or_default()
}

/// p is what is drawn, or which row is not.
fn missing_half_said(p: i64) -> String {
    format!(
        "draws {}, of the two halves that the middle corner makes",
        [
            "the upper half alone",
            "the lower half alone",
            "all but the first row of the lower half",
            "all but the last row of the upper half"
        ][p as usize]
    )
}

/// The row of the first sample below the middle corner is the first one of the lower half.
fn missing_half(mask: &mut Mask, corners: &Corners, window: PixelRect, p: i64) {
    // The first row of the lower half.
    let middle = fills::middle_row(corners);
    mask.retain(window, &|_, y| match p {
        0 => i64::from(y) < middle,
        1 => i64::from(y) >= middle,
        _ => i64::from(y) != middle + 2 - p,
    });
}

/// p mod 3 is the axis, or both, and p / 3 one of `BOXES`.
/// For example, 4 leaves out the first column of the box.
fn small_box_said(p: i64) -> String {
    let axes = ["both axes", "x", "y"][(p % 3) as usize];
    format!("looks for pixels in a box that is too small in {axes}: {}", BOXES[(p / 3) as usize].0)
}

/// The picture within such a box: nothing is drawn that is not right.
fn small_box(mask: &mut Mask, corners: &Corners, window: PixelRect, p: i64) {
    let (_, added) = BOXES[(p / 3) as usize];
    let [columns, rows] = [xs(corners), ys(corners)].map_array(|of| small_range(of, added));
    let axis = p % 3;
    mask.retain(window, &|x, y| {
        (axis == 2 || columns.contains(&x.into())) && (axis == 1 || rows.contains(&y.into()))
    });
}

/// p mod 6 is the side of the box, p / 6 mod 3 the corner that it misses, p / 18 one of `ORDERS`, and from
/// `BOXES_OF_TWO` on the box is too small at its end, too.
/// For example, 0 takes the left side from the second corner and the third.
fn box_of_two_said(p: i64) -> String {
    format!(
        "looks for pixels in a box whose {} from two of the corners, without the {}{}{}",
        [
            "left side comes",
            "upper side comes",
            "right side comes",
            "lower side comes",
            "left and right side come",
            "upper and lower side come",
        ][(p % 6) as usize],
        ["first", "second", "third"][(p / 6 % 3) as usize],
        order_said(p / 18 % ORDERS.len() as i64),
        ["", ", and ends before the ceiling of the largest coordinate"]
            [(p / BOXES_OF_TWO) as usize]
    )
}

/// The box from two corners alone, as a minimum of three numbers makes it that forgets one.
fn box_of_two(mask: &mut Mask, corners: &Corners, window: PixelRect, p: i64) {
    let order = p / 18 % ORDERS.len() as i64;
    // The corner that is forgotten is found after corners are exchanged.
    let ordered = in_order(corners, order, twice_area(corners) > 0);
    let (side, without) = (p % 6, (p / 6 % 3) as usize);
    if side < 2 && p >= BOXES_OF_TWO {
        return;
    }
    // The ends of the side in question, of the two corners that are not forgotten.
    let of = if side % 2 == 0 { xs(&ordered) } else { ys(&ordered) };
    let [a, b] = [of[(without + 1) % 3], of[(without + 2) % 3]];
    let (low, high) = (a.min(b), a.max(b));
    mask.retain(window, &|x, y| {
        let at = if side % 2 == 0 { x } else { y };
        // A box that ends too early is no longer than one that holds both corners.
        let is_after = at >= low.div_euclid(256) || matches!(side, 2 | 3);
        let last = high.div_euclid(256) - i32::from(p >= BOXES_OF_TWO && high % 256 == 0);
        is_after && (at <= last || side < 2)
    });
}

/// p is where the wrong side is used.
fn exchanged_sides_said(p: i64) -> String {
    [
        "ends its loop over columns at the height of the window",
        "ends its loop over rows at the width of the window",
        "exchanges the width and the height of the window",
    ][p as usize]
        .to_owned()
}

/// p / 100 is the test and p mod 100 the side of a tile: one of `TILES`.
/// For example, 108 skips tiles of 8 x 8 px whose middle is not covered.
fn skipped_tiles_said(p: i64) -> String {
    // In the order of the numbers in `TileTest::is_kept`.
    let side = p % 100;
    let tested = [
        "skips tiles of {} px of whose corner pixels none is covered",
        "skips tiles of {} px whose middle is not covered",
        "skips tiles of {} px whose first pixel is not covered",
        "skips tiles of {} px of whose corners none lies in the triangle",
        "skips tiles of {} px whose middle lies farther from an edge than half their side",
        "skips tiles of {} px whose first corner lies outside",
        "loses the last column that a triangle has in each tile of {} px",
        "skips tiles of {} px of whose corner pixels in the window none is covered",
        "skips tiles of {} px that do not lie in the triangle with all four corner pixels",
        "tests each edge with the wrong corner of tiles of {} px, whose x is that of another one",
        "tests each edge with the wrong corner of tiles of {} px, whose y is that of another one",
        "skips tiles of {} px of whose corner pixels and middle none is covered",
        "loses the last column of tiles of {} px that are not covered at all four corner pixels",
        "loses the last row of tiles of {} px that are not covered at all four corner pixels",
        "skips tiles of {} px that do not lie wholly in the window",
    ][(p / 100) as usize];
    tested.replace("{}", &format!("{side} x {side}"))
}

/// The powers of two of the sides are p mod 5 and p / 5 mod 5, and p / 25 is what decides about a block.
/// For example, 26 draws blocks of 2 x 1 px by their middle.
fn whole_blocks_said(p: i64) -> String {
    format!(
        "draws blocks of {} x {} px wholly {}",
        1 << (p % 5),
        1 << (p / 5 % 5),
        [
            "or not at all, as their first sample is covered",
            "or not at all, as their middle is covered",
            "or not at all, as their last sample is covered",
            "or not at all: wholly if any of their samples is covered",
            "where the samples of three of their corner pixels are covered",
        ][(p / 25) as usize]
    )
}

/// p mod 4 is the power of two of a group, and p / 4 what is lost or drawn.
/// For example, 5 begins each row at a multiple of 4.
fn rest_of_group_said(p: i64) -> String {
    // In the order of the numbers in `fills::groups`.
    let [n, kind] = [1 << (p % 4 + 1), p / 4];
    let what = [
        "loses the pixels at the end of a row that do not fill a group of {}",
        "begins every row at a multiple of {} and loses the pixels before",
        "ends every row at a multiple of {} and loses the pixels after",
        "loses the last columns of the box around a triangle that do not fill a group of {}",
        "begins the box around a triangle at a multiple of {} and loses the columns before",
        "loses the last columns of the window that do not fill a group of {}",
        "draws every row up to the end of a group of {}, beyond the edge",
        "draws every row in groups that begin at multiples of {}, beyond both edges",
        "loses the last rows of the box around a triangle that do not fill a group of {}",
        "loses the last rows of the window that do not fill a group of {}",
        "begins the box around a triangle at the multiple of {} before it and loses the last columns that do not fill a group",
        "begins and ends every row at the multiple of {} before",
    ][kind as usize];
    what.replace("{}", &n.to_string())
}

/// p is a place in the list.
fn drawn_twice_said(p: i64) -> String {
    // In the order of the numbers in `fills::twice`.
    let what = [
        "the last row of a triangle",
        "the first row of a triangle",
        "the row of the middle corner",
        "the row that holds the lowest corner",
        "the first pixel of every row",
        "the last pixel of every row",
        "the last column of a triangle",
        "all pixels of a triangle",
        "the pixels at the border of a triangle",
        "the column that holds the rightmost corner",
    ];
    format!("draws {} twice, so that what is blended there is too strong", what[p as usize])
}

/// p mod 4 is the step, from 4 on the value at the first sample is whole, too, and from 8 on triangles without area
/// are drawn.
/// For example, 5 cuts steps to 1/2 px and begins with a whole number.
fn whole_edges_said(p: i64) -> String {
    format!(
        "cuts the steps of the edge functions to {}, so that edges turn{}{}",
        grid(STEPS_WITH_ONE[(p % 4) as usize]),
        ["", ", and begins with a whole number too"][(p / 4 % 2) as usize],
        ["", "; triangles without area are drawn as others"][(p / 8) as usize]
    )
}

/// p mod 100 is the number of the part, p / 100 mod 100 how many there are, and p / 10,000 whether they are rows,
/// columns or a checkerboard: one of `GROUPS`.
/// For example, 10,403 never draws every 4th column, beginning with column 3.
fn missing_parts_said(p: i64) -> String {
    // A checkerboard has no number of a row or a column.
    let (axis, every, rest) = (p / 10_000, p / 100 % 100, p % 100);
    if axis == 2 {
        return format!(
            "draws a checkerboard: no pixel whose row and column add up to an {} number",
            ["even", "odd"][rest as usize]
        );
    }
    format!(
        "never draws every {every}{} {} of the window (number {rest} from 0)",
        suffix(every),
        ["row", "column"][axis as usize]
    )
}

/// Row, column or their sum decide, counted from the origin and not from the triangle.
fn missing_parts(mask: &mut Mask, _: &Corners, window: PixelRect, p: i64) {
    let (axis, every, rest) = (p / 10_000, p / 100 % 100, p % 100);
    mask.retain(window, &|x, y| i64::from([y, x, x + y][axis as usize]) % every != rest);
}

/// p / 2 is one of `NEIGHBOURS`, and of an odd p all of them have to be covered.
/// For example, 3 draws a pixel only where its eight neighbours are covered, too.
fn neighbours_said(p: i64) -> String {
    let of = fills::NEIGHBOURS[(p / 2) as usize].1;
    match p % 2 {
        0 => format!("draws a pixel also where any of {of} is covered"),
        _ => format!("draws a pixel only where {of} are covered, too"),
    }
}

/// p mod 4 is which rows or columns are moved, p / 4 mod 4 where to, and from 16 on they are moved by a whole
/// pixel.
/// For example, 18 looks 1 px further left in columns of even numbers.
fn alternating_said(p: i64) -> String {
    format!(
        "tests samples {} px further {} in {} of {} numbers",
        ["1/2", "1"][(p / 16) as usize],
        ["left", "right", "up", "down"][(p / 4 % 4) as usize],
        ["rows", "columns"][(p / 2 % 2) as usize],
        ["even", "odd"][(p % 2) as usize]
    )
}

/// p is how the search goes on from row to row.
fn early_end_said(p: i64) -> String {
    [
        "stops at the first row without a covered sample after one with some",
        "looks for the first pixel of a row from that of the row before on, so that edges to the left are lost",
        "looks for the last pixel of a row up to that of the row before, so that edges to the right are lost",
    ][p as usize]
        .to_owned()
}

/// There is one way to do this.
fn slid_rows_said(_: i64) -> String {
    "begins rows at the left side of the window that begin left of it, and keeps their length, so that they end too far right".to_owned()
}

/// Adds to the right picture what rows have too much at their right ends.
fn slid_rows(corners: &Corners, window: PixelRect, base: &TriangleConvention, _: i64) -> Mask {
    let mut mask = base.mask(corners, window).unwrap_or_default();
    fills::slid(&mut mask, corners, window, base);
    mask
}

/// p mod 3 is the precision, p / 3 mod 2 whether the sign takes the place of an exchange of corners, and p / 6 one
/// of `FORMULAS`.
/// For example, 7 computes a x + b y + c in floats of 64 bits.
fn floats_said(p: i64) -> String {
    let (formula, precision) = (p / 6, ["32", "64", "16"][(p % 3) as usize]);
    format!(
        "computes in floats of {precision} bits {}: rounding decides about samples on and near edges",
        FORMULAS[formula as usize].0
    )
}

/// p is how much of a pixel has to be touched.
fn touched_said(p: i64) -> String {
    format!(
        "draws the pixels that the sides touch, too, walked in floats of 64 bits from pixel to pixel{}",
        [
            "",
            ", but not those that a side touches along their own sides or in one point",
            ", but not those that a side touches by less than 1/100 px"
        ][p as usize]
    )
}

/// The samples within the triangle stay, and the pixels along its sides are added.
fn touched(corners: &Corners, window: PixelRect, base: &TriangleConvention, p: i64) -> Mask {
    let mut mask = base.mask(corners, window).unwrap_or_default();
    let points = cells::places(corners);
    for i in 0..3 {
        let side = [points[i], points[(i + 1) % 3]];
        mask.add(&cells::touched(side, window, [0.0, 1e-3, 1e-2][p as usize]));
    }
    mask
}

/// p is one of `LEAST`.
fn area_said(p: i64) -> String {
    let least = cells::least_said(cells::LEAST[p as usize]);
    format!(
        "adds up areas in whole numbers of 1/256 px, as for antialiasing, and draws a pixel from {least} on"
    )
}

/// p is read by `HALVES`.
fn two_halves_said(p: i64) -> String {
    let [precision, whole, ends, rows, upper, lower] = fills::HALVES.digits(p);
    // Crossings and heights are brought to pixels by the same four ways.
    let cut = ["cut toward zero", "cut down", "rounded", "rounded up from the sample"];
    format!(
        "splits triangles at the middle corner{} and adds up the slopes of each half from its tip, the lower half upwards, in floats of {} bits; crossings are {}, heights {}; {}: two loops of many tutorials",
        [
            "",
            ", after corners are cut to whole pixels,",
            ", after corners are rounded to whole pixels,"
        ][whole as usize],
        ["32", "64"][precision as usize],
        cut[ends as usize],
        cut[rows as usize],
        [
            "neither half draws the row between",
            "the upper half draws the row between",
            "the lower half draws the row between",
            "both halves draw the row between"
        ][(upper + 2 * lower) as usize]
    )
}

/// p is read bit by bit; see `fills::whole_pixels`.
fn whole_pixels_said(p: i64) -> String {
    let mut words = format!(
        "cuts corners to whole pixels ({}), divides {} for each row, and draws both ends of it: the loop of many libraries for small displays",
        if p & 1 == 1 {
            "to the nearest"
        } else if p & 64 == 0 {
            "down"
        } else {
            "toward zero"
        },
        if p & 2 == 0 { "toward zero" } else { "down" }
    );
    // What wraps around is said only where it does.
    if p & 4 != 0 {
        words += "; the products wrap around in 16 bits";
    }
    if p & 32 != 0 {
        words += "; the corners wrap around in 16 bits";
    }
    words += [
        "",
        "; a flat top is filled from row 0 of the window on",
        "; the last row is missing",
        "; the right end is not drawn",
    ][(p >> 3 & 3) as usize];
    words
}

/// p is read by `fills::crossings`.
fn crossings_said(p: i64) -> String {
    format!(
        "cuts corners to whole pixels{} and fills each row from the pixel of a crossing to that of the next, {}, {}: the polygon of many libraries",
        ["", " toward zero", " (to the nearest)"][(p / 32) as usize],
        fills::CROSSINGS[(p % 8) as usize],
        fills::LAST_ROWS[(p / 8 % 4) as usize]
    )
}

/// p is what is filled in place of the triangle.
fn whole_box_said(p: i64) -> String {
    [
        "fills the box of the corners",
        "draws the border alone and fills nothing",
        "fills the box of the corners, also where these have no area",
    ][p as usize]
        .to_owned()
}

/// The box holds the samples between the least and the largest coordinates; the border is what has a neighbour that
/// is not drawn.
fn whole_box(mask: &mut Mask, corners: &Corners, window: PixelRect, p: i64) {
    if p == 1 {
        let full = *mask;
        // A pixel beyond the window counts as drawn, so that the window has no border of its own.
        let is_in = |x: i32, y: i32| !window.contains(x, y) || full.has(x, y);
        mask.retain(window, &|x, y| !fills::BESIDE.iter().all(|[dx, dy]| is_in(x + dx, y + dy)));
        return;
    }
    if p == 0 && twice_area(corners) == 0 {
        return;
    }
    // The box without its last column and row, as a right rectangle has it.
    let ([x0, x1], [y0, y1]) = (ends_of(xs(corners)), ends_of(ys(corners)));
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            let (sx, sy) = (x * 256 + 128, y * 256 + 128);
            if (x0..x1).contains(&sx) && (y0..y1).contains(&sy) {
                mask.set(x, y);
            }
        }
    }
}

/// Parameters of a rule by order of both windings; those of one follow.
const OF_BOTH: i64 = 27 * ORDERS.len() as i64;
/// How far the sum of the areas may be off, in square pixels.
const AREAS: [f64; 8] = [0.0, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
/// Epsilons that programs have.
const EPSILONS: [f64; 7] = [1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
/// Two different rules each: six times the number of the first one in [`RULES`], and that of the
/// second one.
const PAIRS: [i64; 30] = {
    let mut pairs = [0; 30];
    let (mut i, mut n) = (0, 0);
    while i < 36 {
        if i / 6 != i % 6 {
            pairs[n] = i;
            n += 1;
        }
        i += 1;
    }
    pairs
};

/// The rule of clockwise triangles and that of the others.
fn pair(p: i64) -> (usize, usize) {
    ((p / 6) as usize, (p % 6) as usize)
}

/// A grid of such a step, in words.
fn grid(step: i32) -> String {
    match step {
        256 => "whole pixels".to_owned(),
        _ => format!("1/{} px", 256 / step),
    }
}

/// Ways to bring a coordinate to a step.
type Round = fn(i32, i32) -> i32;
/// As they are said, and as they are computed.
const ROUNDINGS: [(&str, Round); 5] = [
    ("down", |v, step| v.div_euclid(step) * step),
    ("up", |v, step| -((-i64::from(v)).div_euclid(step.into()) * i64::from(step)) as i32),
    ("to the nearest", |v, step| v.saturating_add(step / 2).div_euclid(step) * step),
    ("toward zero", |v, step| v / step * step),
    // As `round` of Python and C# does.
    ("to the nearest, halves to even", |v, step| {
        Quantum { step, rounding: Rounding::HalfEven }.apply(v) as i32
    }),
];

/// Grids of one axis: none, or a step and a way to round.
const AXIS: i64 = 1 + 5 * 5;
/// From whole pixels to 1/16 px; finer grids hardly show.
const AXIS_STEPS: [i32; 5] = [256, 128, 64, 32, 16];

/// The grid of an axis: a step in subpixels, and a place in [`ROUNDINGS`].
#[derive(Clone, Copy)]
struct AxisGrid {
    step: i32,
    rounding: usize,
}

impl AxisGrid {
    fn is_nearest(self) -> bool {
        [2, 4].contains(&self.rounding)
    }

    fn moved(self, v: i32) -> i32 {
        if self.step == 1 { v } else { ROUNDINGS[self.rounding].1(v, self.step) }
    }
}

/// The grids of x and of y.
fn axes(p: i64) -> [AxisGrid; 2] {
    [p % AXIS, p / AXIS].map_array(|axis| match axis - 1 {
        at @ 0.. => AxisGrid { step: AXIS_STEPS[(at / 5) as usize], rounding: (at % 5) as usize },
        _ => AxisGrid { step: 1, rounding: 0 },
    })
}

/// How far an edge may be moved, in subpixels.
const OFFSETS: [i64; 8] = [1, 2, 8, 16, 32, 64, 128, 256];
/// Bits of weights in whole numbers.
const WEIGHT_BITS: [u32; 8] = [4, 7, 8, 10, 12, 14, 15, 16];
/// Bits of reciprocals of the area, which has 16 bits of fraction.
const RECIPROCAL_BITS: [u32; 3] = [40, 32, 24];

/// Steps in subpixels; the last one is the grid of the corners.
const STEPS_WITH_ONE: [i32; 5] = [256, 128, 64, 16, 1];
/// Steps of corners that are made by clipping.
const CLIP_STEPS: [i32; 4] = [256, 64, 16, 4];

/// How many there are, as a digit of a parameter.
const METRICS: i64 = fills::METRICS.len() as i64;

/// A limit of the size.
#[derive(Clone, Copy)]
pub(super) struct SizeLimit {
    /// A place in [`fills::METRICS`].
    pub(super) metric: usize,
    /// Whether what lies below it is left out, and not what lies at it or above.
    is_below: bool,
    pub(super) limit: i64,
}

/// Such a limit as the parameter of a mistake.
pub(super) fn packed_size(metric: usize, is_below: bool, limit: i64) -> i64 {
    (limit * METRICS + metric as i64) * 2 + i64::from(is_below)
}

/// The limit in such a parameter.
pub(super) fn size(p: i64) -> SizeLimit {
    SizeLimit { metric: (p / 2 % METRICS) as usize, is_below: p % 2 == 1, limit: p / (2 * METRICS) }
}

/// What is measured of a size, and its limit with the unit.
fn size_said(p: i64) -> (&'static str, String) {
    let SizeLimit { metric, limit, .. } = size(p);
    let Metric { name: what, unit, .. } = fills::METRICS[metric];
    let per_unit = match metric {
        0 => 131_072,
        fills::RATIO => fills::RATIOS,
        _ => 256,
    };
    (what, format!("{} {unit}", fills::decimal(limit, per_unit)).trim_end().to_owned())
}

type IsKind = fn(&Corners, PixelRect) -> bool;
/// Kinds of triangles that a program may leave out, as they are said after 'triangles'.
const KINDS: [(&str, IsKind); 19] = [
    ("with a level upper edge", |c, _| fills::flat(c) == Some(true)),
    ("with a level lower edge", |c, _| fills::flat(c) == Some(false)),
    ("with an upright edge", |[a, b, c], _| a.x == b.x || b.x == c.x || c.x == a.x),
    ("whose middle corner lies right of the long edge", |c, _| fills::middle_side(c) > 0),
    ("whose middle corner lies left of the long edge", |c, _| fills::middle_side(c) < 0),
    ("with any corner outside the window", |c, w| c.iter().any(|p| !fills::holds(w, *p))),
    ("with all corners outside the window", |c, w| c.iter().all(|p| !fills::holds(w, *p))),
    ("whose first corner lies outside the window", |c, w| !fills::holds(w, c[0])),
    ("with a negative coordinate", |c, _| c.iter().any(|p| p.x < 0 || p.y < 0)),
    ("that have no area once their corners are rounded to whole pixels", |c, _| {
        twice_area(&whole(c, 128)) == 0
    }),
    ("that have no area once their corners are cut to whole pixels", |c, _| {
        twice_area(&whole(c, 0)) == 0
    }),
    ("that turn round or have no area once their corners are rounded to whole pixels", |c, _| {
        twice_area(&whole(c, 128)).signum() != twice_area(c).signum()
    }),
    ("that turn round or have no area once their corners are cut to whole pixels", |c, _| {
        twice_area(&whole(c, 0)).signum() != twice_area(c).signum()
    }),
    ("whose area of 8 bits of fraction has another sign in 32 bits", |c, _| {
        (twice_area(c) as i32).signum() != twice_area(c).signum() as i32
    }),
    ("whose area of 4 bits of fraction has another sign in 32 bits", |c, _| {
        ((twice_area(c) >> 8) as i32).signum() != twice_area(c).signum() as i32
    }),
    ("whose winding is not that of the first product of their area alone", |[a, b, c], _| {
        let first = (i64::from(b.x) - i64::from(a.x)) * (i64::from(c.y) - i64::from(a.y));
        (first >= 0) != (twice_area(&[*a, *b, *c]) > 0)
    }),
    ("whose winding is not that of the second product of their area alone", |[a, b, c], _| {
        let second = (i64::from(b.y) - i64::from(a.y)) * (i64::from(c.x) - i64::from(a.x));
        (second < 0) != (twice_area(&[*a, *b, *c]) > 0)
    }),
    (
        "whose middle corner lies left of the long edge, from the upper corner that is named first",
        |c, _| fills::side_of_long(c) < 0,
    ),
    (
        "whose middle corner lies right of the long edge, from the upper corner that is named first",
        |c, _| fills::side_of_long(c) > 0,
    ),
];

/// The corners in whole pixels, after so many subpixels were added.
fn whole(corners: &Corners, half: i32) -> Corners {
    let cut = |v: i32| v.saturating_add(half).div_euclid(SUBPIXELS) * SUBPIXELS;
    corners.map_array(|c| SubpixelPoint::new(cut(c.x), cut(c.y)))
}

/// What `fills::ends` draws or leaves out, by its number.
const ENDS: [&str; 10] = [
    "loses the first row of every triangle",
    "loses the last row of every triangle",
    "loses the first pixel of every row",
    "loses the last pixel of every row",
    "loses the first column of every triangle",
    "loses the last column of every triangle",
    "draws a pixel too many at the right end of every row",
    "draws a pixel too many at the left end of every row",
    "draws the last row once more, one row lower",
    "draws the first row once more, one row higher",
];

/// Sides of a box, the corner that it misses, and the order of the corners.
const BOXES_OF_TWO: i64 = 18 * ORDERS.len() as i64;
/// What is added to the least coordinate and to the largest one, in subpixels, before they are cut down to the first pixel and
/// the one after the last.
const BOXES: [(&str, [i64; 2]); 8] = [
    ("the pixel that holds the largest coordinate is left out", [0, 0]),
    ("the pixel that holds the smallest coordinate is left out", [256, 256]),
    ("its ends are rounded, and the last pixel is left out", [128, -128]),
    ("both ends are cut down, and the last pixel and the first are left out", [256, 0]),
    (
        "the ceiling of the largest coordinate counts as the last pixel and is left out once more",
        [0, -1],
    ),
    ("the smallest coordinate is rounded up", [255, 256]),
    ("the smallest coordinate is rounded up past the next pixel", [511, 256]),
    ("the pixel before that of the largest coordinate is left out, too", [0, -256]),
];

/// The columns or the rows of a box that is too small.
fn small_range(values: [i32; 3], [first, last]: [i64; 2]) -> Range<i64> {
    let [least, most] = ends_of(values).map_array(i64::from);
    (least + first).div_euclid(256)..(most + last).div_euclid(256)
}

/// Every 2nd, 4th, 8th and 16th row or column, the first or the last of them; and checkerboards.
const GROUPS: [i64; 18] = [
    20_200, 20_201, 200, 201, 10_200, 10_201, 400, 403, 10_400, 10_403, 800, 807, 10_800, 10_807,
    1600, 1615, 11_600, 11_615,
];

/// The ending of an ordinal number that is a power of two.
fn suffix(number: i64) -> &'static str {
    match number {
        2 => "nd",
        _ => "th",
    }
}

/// Sides and tests of tiles.
const TILES: [i64; 73] = {
    let mut all = [0; 73];
    let (mut i, mut n) = (0, 0);
    while i < 75 {
        let side = 2 << (i % 5);
        // A tile as large as the window has its middle or first pixel beyond, or is all.
        if side < 32 || i / 5 == 0 || i / 5 > 2 {
            all[n] = 100 * (i / 5) + side;
            n += 1;
        }
        i += 1;
    }
    all
};

/// Which corners are exchanged first, and of which triangles.
const ORDERS: [&str; 7] = [
    "",
    "the second and the third corner of counterclockwise",
    "the second and the third corner of clockwise",
    "the first and the second corner of counterclockwise",
    "the first and the second corner of clockwise",
    "the first and the third corner of counterclockwise",
    "the first and the third corner of clockwise",
];

/// What is said of an exchange of corners, after what else the program does.
fn order_said(order: i64) -> String {
    match order {
        0 => String::new(),
        _ => format!(", after {} triangles were exchanged", ORDERS[order as usize]),
    }
}

/// The corners once they are exchanged.
fn in_order(corners: &Corners, order: i64, clockwise: bool) -> Corners {
    let mut ordered = *corners;
    if order > 0 && clockwise == (order % 2 == 0) {
        let [i, j] = [[1, 2], [0, 1], [0, 2]][(order as usize - 1) / 2];
        ordered.swap(i, j);
    }
    ordered
}

/// Where an edge comes once the corners are exchanged.
fn place_of_edge(edge: usize, order: i64, clockwise: bool) -> usize {
    if order == 0 || clockwise == (order % 2 == 1) {
        return edge;
    }
    [[2, 1, 0], [0, 2, 1], [1, 0, 2]][(order as usize - 1) / 2][edge]
}

/// Ranges of a limit: from -L to L, from -L to L - 1, from 0 to L - 1, and from 0 to L.
const RANGES: i64 = 4;

/// The limit in pixels (below 6, a place that depends on the window), which axes, and the range.
fn clamp_of(p: i64) -> [i64; 3] {
    [p / (3 * RANGES), p / RANGES % 3, p % RANGES]
}

/// The parameters of clamps: at the window, at powers of two, and at other limits in pixels.
pub(super) fn clamps(others: &[i64]) -> Vec<i64> {
    let mut all = Vec::new();
    for limit in (0..6).chain((7..16).map(|power| 1 << power)).chain(others.iter().copied()) {
        for p in 0..3 * RANGES {
            // Places that depend on the window have one range.
            if limit >= 6 || p % RANGES == 0 {
                all.push(limit * 3 * RANGES + p);
            }
        }
    }
    all
}

/// The range that coordinates are clamped to, in subpixels, of a window with such a side.
fn clamped_to(p: i64, side_px: i32) -> [i32; 2] {
    // No side: farther than any corner.
    let far = i32::MAX / SUBPIXELS;
    let [limit, _, range] = clamp_of(p);
    let limit = limit as i32;
    let [low, high] = match limit {
        0 => [0, side_px],
        1 => [0, side_px - 1],
        2 => [0, far],
        3 => [-far, side_px],
        4 => [-side_px, 2 * side_px],
        5 => [-side_px / 2, side_px + side_px / 2],
        _ => [if range > 1 { 0 } else { -limit }, limit - i32::from(range == 1 || range == 2)],
    };
    [low * SUBPIXELS, high * SUBPIXELS]
}

impl TriangleConvention {
    /// The same with a rule for ties that has a name.
    fn with_rule(&self, rule: &str) -> Self {
        Self { ties: Ties::named(rule).unwrap_or(self.ties), ..*self }
    }
}
