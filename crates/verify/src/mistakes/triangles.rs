//! The table of mistakes in filling triangles. To add one, add an entry: everything else follows from it.

use super::cells;
use super::fills::{self, Words};
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
    Mistake {
        name: BY_WINDING,
        sentence: |p| {
            let (clockwise, other) = pair(p);
            format!(
                "follows the {} rule for clockwise triangles and the {} rule for the others",
                RULES[clockwise], RULES[other]
            )
        },
        repair: "bring the corners into one winding before the fill rule is applied",
        page: "ch02-edge-functions",
        refuted: "a triangle and its reverse that draw the same samples on their edges",
        parameters: Parameters::Fixed(&PAIRS),
        draws: Fill::Sampled(Reach::Pixel, |corners, window, base, p| {
            let (clockwise, other) = pair(p);
            let rule = if twice_area(corners) > 0 { clockwise } else { other };
            base.with_rule(RULES[rule]).mask(corners, window).unwrap_or_default()
        }),
    },
    Mistake {
        name: "rule by order",
        sentence: |p| {
            let (owned, order, winding) = (p % 27, p / 27 % ORDERS.len() as i64, p / OF_BOTH);
            let edges = [
                "from the first corner to the second",
                "from the second to the third",
                "from the third to the first",
            ];
            let of = |rule| -> Vec<_> {
                (0..3)
                    .filter(|&i| owned / 3_i64.pow(i) % 3 == rule)
                    .map(|i| edges[i as usize])
                    .collect()
            };
            let mut words = match (of(1).join(" and "), of(2).join(" and ")) {
                (drawn, ruled) if ruled.is_empty() => {
                    format!("draws samples on the edge {drawn} and on no other")
                }
                (drawn, ruled) if drawn.is_empty() => {
                    format!(
                        "draws samples on the edge {ruled} if the top-left rule does, and on no other"
                    )
                }
                (drawn, ruled) => format!(
                    "draws all samples on the edge {drawn}, and on the edge {ruled} if the top-left rule does"
                ),
            };
            words += &exchanged(order);
            words +=
                ["", " (of clockwise triangles alone)", " (of counterclockwise triangles alone)"]
                    [winding as usize];
            words
        },
        repair: "let the direction of an edge decide, and not its place in the list",
        page: "ch02-edge-functions",
        refuted: "a triangle whose corners are rotated and that draws the same samples",
        parameters: Parameters::Below(3 * OF_BOTH),
        draws: Fill::Sampled(Reach::Pixel, |corners, window, base, p| {
            let (base, clockwise) = (base.with_rule(RULES[0]), twice_area(corners) > 0);
            // The same for all edges is no rule by order.
            if matches!(p % 27, 0 | 13 | 26) && p < OF_BOTH {
                return Mask::default();
            }
            let order = p / 27 % ORDERS.len() as i64;
            let is_ruled = p / OF_BOTH == if clockwise { 2 } else { 1 };
            fills::by_edges(corners, window, &base, &|edge, value, owns| {
                let edge = place_of_edge(edge, order, clockwise) as u32;
                let owns = match p / 3_i64.pow(edge) % 3 {
                    _ if is_ruled => owns,
                    0 => false,
                    1 => true,
                    _ => owns,
                };
                value > 0 || (value == 0 && owns)
            })
        }),
    },
    Mistake {
        name: "rule after the shift",
        sentence: |p| {
            let (how, bits) = (p / 100, p % 100);
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
        },
        repair: "apply the fill rule to the edge function before its bits are shifted out",
        page: "ch02-edge-functions",
        refuted: "a sample closer to an edge than the bits that are shifted out, and drawn rightly",
        parameters: Parameters::Fixed(&[
            4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 104, 106, 108, 110, 112, 116, 204, 206, 208, 210,
            212, 216, 304, 306, 308, 310, 312, 316,
        ]),
        draws: Fill::Ruled(Reach::Pixel, |corners, window, base, p| {
            let (how, bits) = (p / 100, p % 100);
            fills::by_edges(corners, window, base, &|_, value, owns| {
                let cut = if how % 2 == 0 { value >> bits } else { value / (1 << bits) };
                match how {
                    0 | 1 => cut - i128::from(!owns) >= 0,
                    2 => cut > 0,
                    _ => cut >= 0,
                }
            })
        }),
    },
    Mistake {
        name: "an epsilon in the test",
        sentence: |p| {
            let what = ["weights of the corners are", "edge function in square pixels is"]
                [(p / 10 % 2) as usize];
            let size = EPSILONS[(p % 10) as usize];
            match p / 20 {
                0 => format!(
                    "draws where the {what} above -{size:e}, so that a strip outside every edge is drawn"
                ),
                _ => format!(
                    "draws where the {what} above {size:e}, so that a strip inside every edge is lost"
                ),
            }
        },
        repair: "snap the corners to a grid, where an edge function is exactly 0 or not, and follow a fill rule",
        page: "ch02-edge-functions",
        refuted: "a sample in that strip that is drawn rightly",
        parameters: Parameters::Fixed(&[
            0, 1, 2, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15, 16, 20, 21, 22, 23, 24, 25, 26, 30, 31,
            32, 33, 34, 35, 36,
        ]),
        draws: Fill::Sampled(Reach::Pixel, |corners, window, base, p| {
            let whole = if p / 10 % 2 == 0 { twice_area(corners).abs() as f64 } else { 65536.0 };
            let size = EPSILONS[(p % 10) as usize];
            fills::by_edges(corners, window, base, &|_, value, _| match p / 20 {
                0 => value as f64 / whole >= -size,
                _ => value as f64 / whole > size,
            })
        }),
    },
    Mistake {
        name: "areas are compared",
        sentence: |p| {
            let (bits, most) = (["32", "64"][(p % 2) as usize], AREAS[(p / 4) as usize]);
            let areas = ["twice the areas", "the areas"][(p / 2 % 2) as usize];
            format!(
                "draws where {areas} that a sample makes with the sides add up to the whole, in floats of {bits} bits, with at most {most:e} between"
            )
        },
        repair: "test the sign of the three edge functions, in whole numbers",
        page: "ch02-edge-functions",
        refuted: "a large triangle that is drawn wholly",
        parameters: Parameters::Below(4 * AREAS.len() as i64),
        draws: Fill::Sampled(Reach::Pixel, |corners, window, base, p| {
            fills::areas(corners, window, base, AREAS[(p / 4) as usize], p)
        }),
    },
    Mistake {
        name: "an edge is not tested",
        sentence: |p| {
            format!(
                "does not test the edge {}{}",
                [
                    "from the first corner to the second",
                    "from the second corner to the third",
                    "from the third corner to the first"
                ][(p % 3) as usize],
                exchanged(p / 3)
            )
        },
        repair: "test all three edges",
        page: "ch02-edge-functions",
        refuted: "a sample beyond that edge alone that is not drawn",
        parameters: Parameters::Below(3 * ORDERS.len() as i64),
        draws: Fill::Ruled(Reach::Pixel, |corners, window, base, p| {
            let clockwise = twice_area(corners) > 0;
            fills::by_edges(corners, window, base, &|edge, value, owns| {
                let edge = place_of_edge(edge, p / 3, clockwise);
                edge as i64 == p % 3 || value > 0 || (value == 0 && owns)
            })
        }),
    },
    Mistake {
        name: "product overflows",
        sentence: |p| {
            let Words { fraction, bits, products_alone, .. } = Words::of(p);
            let from = products_wrap_from(p);
            let what = match products_alone {
                true => "the products of the edge function",
                false => "the edge function",
            };
            format!(
                "computes {what} of coordinates with {fraction} bits of fraction in {bits} bits: the products wrap around from about {from} px on"
            )
        },
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
    Mistake {
        name: "coordinates overflow",
        sentence: |p| {
            let (how, fraction, bits) = (p / 10_000, p / 100 % 100, p % 100);
            let most = coordinates_end_at(p);
            let what = if how == 0 { "wrap around" } else { "are clamped" };
            format!(
                "keeps coordinates with {fraction} bits of fraction in {bits} bits: corners beyond {most} px {what}"
            )
        },
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
    Mistake {
        name: "coordinates in short floats",
        sentence: |p| {
            let how = ["rounded", "cut"][(p / 100) as usize];
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
        },
        repair: "keep corners as integers in subpixels, or in floats of 32 bits",
        page: "stability",
        refuted: "a corner with more significant bits whose edges pass where they should",
        parameters: Parameters::Fixed(&[10, 7, 15, 110, 107, 115]),
        draws: Fill::Instead(|corners, _, p| {
            let short = |v: i32| fills::shortened(v, p % 100, p >= 100);
            vec![corners.map_array(|c| SubpixelPoint::new(short(c.x), short(c.y)))]
        }),
    },
    Mistake {
        name: "each axis on a grid of its own",
        sentence: |p| {
            let [x, y] = axes(p).map_array(|(step, rounding)| match step {
                1 => "keeps its fraction".to_owned(),
                _ => format!("is moved to {} ({})", grid(step), ROUNDINGS[rounding].0),
            });
            format!(
                "puts the coordinates of corners on two grids: x {x}, y {y}, so that slopes change"
            )
        },
        repair: "snap both coordinates to the same grid in the same way, once, for every triangle",
        page: "ch01",
        refuted: "a corner that these grids move apart and whose edges pass where they should",
        parameters: Parameters::Below(AXIS * AXIS),
        draws: Fill::Instead(|corners, _, p| {
            let [x, y] = axes(p).map_array(|(step, rounding)| {
                move |v: i32| if step == 1 { v } else { ROUNDINGS[rounding].1(v, step) }
            });
            // The same for both is a convention, and to the nearest is nearly the same whatever becomes of halves.
            let is_nearest = |rounding: usize| [2, 4].contains(&rounding);
            let [(step_x, by_x), (step_y, by_y)] = axes(p);
            if step_x == step_y && (by_x == by_y || (is_nearest(by_x) && is_nearest(by_y))) {
                return Vec::new();
            }
            vec![corners.map_array(|c| SubpixelPoint::new(x(c.x), y(c.y)))]
        }),
    },
    Mistake {
        name: "edges are moved",
        sentence: |p| {
            let (norm, outward, size) = (p % 2, p / 2 % 2, OFFSETS[(p / 4) as usize]);
            let along = ["in x and y together", "at right angles"][norm as usize];
            let (way, what) = [("in", "lost"), ("out", "drawn")][outward as usize];
            format!(
                "moves every edge {way} by {} px {along}, so that a strip along it is {what}",
                fills::decimal(size, 256)
            )
        },
        repair: "leave the edges where the corners put them: what neighbours share is drawn by one of them then",
        page: "ch02-edge-functions",
        refuted: "a sample in that strip that is drawn rightly",
        parameters: Parameters::Below(32),
        draws: Fill::Ruled(Reach::Pixel, |corners, window, base, p| {
            let (norm, outward, size) = (p % 2, p / 2 % 2 == 1, OFFSETS[(p / 4) as usize]);
            let lengths = [0, 1, 2].map_array(|i| {
                let [a, b] = [corners[i], corners[(i + 1) % 3]];
                let dx = (f64::from(b.x) - f64::from(a.x)).abs();
                let dy = (f64::from(b.y) - f64::from(a.y)).abs();
                if norm == 0 { dx + dy } else { (dx * dx + dy * dy).sqrt() }
            });
            fills::by_edges(corners, window, base, &|edge, value, owns| {
                let by = lengths[edge] * size as f64;
                let value = value as f64 + if outward { by } else { -by };
                value > 0.0 || (value == 0.0 && owns)
            })
        }),
    },
    Mistake {
        name: "weights are cut",
        sentence: |p| {
            let bits = WEIGHT_BITS[(p / 10 % 8) as usize];
            let cut = ["toward zero", "down"][(p % 2) as usize];
            let how = match p / 80 {
                0 => "divides the edge functions by the area into".to_owned(),
                of => format!(
                    "multiplies the edge functions by a reciprocal of the area of {} bits into",
                    RECIPROCAL_BITS[of as usize - 1]
                ),
            };
            format!(
                "{how} weights of {bits} bits, cut {cut}{}: a strip along edges is drawn or lost",
                if p / 2 % 5 == 0 { "" } else { ", one of them being what is left of 1" }
            )
        },
        repair: "test the edge functions before they are divided",
        page: "ch02-edge-functions",
        refuted: "a sample whose weight is below a step and that is drawn rightly",
        parameters: Parameters::Below(80 * (1 + RECIPROCAL_BITS.len() as i64)),
        draws: Fill::Sampled(Reach::Pixel, |corners, window, base, p| {
            let bits = WEIGHT_BITS[(p / 10 % 8) as usize];
            let area = twice_area(corners);
            let whole = area.abs().max(1);
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
                let mut weights = values.map_array(cut);
                if let Some(rest) = rest {
                    weights[rest] = 0;
                    weights[rest] = (1 << bits) - weights.iter().sum::<i128>();
                }
                weights.iter().all(|weight| *weight >= 0)
            })
        }),
    },
    Mistake {
        name: "corners are clamped",
        sentence: |p| {
            let [limit, axes, _] = clamp_of(p);
            let where_ = [
                "the window",
                "the last pixels of the window",
                "the upper and left border",
                "the lower and right border",
                "a guard band as wide as the window around it",
                "a guard band half as wide as the window around it",
            ];
            let where_ = where_.get(limit as usize).map_or_else(
                || {
                    let [low, high] = clamped_to(p, 0);
                    format!("the range from {} to {} px", low / 256, high / 256)
                },
                |place| (*place).to_owned(),
            );
            format!(
                "moves {} that lie outside to {where_}, so that the slopes of edges change",
                ["corners", "x of corners", "y of corners"][axes as usize]
            )
        },
        repair: "clip the edges, or draw the box of the triangle within the window by unchanged edges",
        page: "ch07",
        refuted: "a triangle with a corner outside whose edges keep their slope",
        parameters: Parameters::Clamps,
        draws: Fill::Instead(|corners, window, p| {
            let [_, axes, _] = clamp_of(p);
            let clamp = |v: i32, side_px: i32, other: i64| {
                let [low, high] = clamped_to(p, side_px);
                if axes == other { v } else { v.clamp(low, high) }
            };
            vec![corners.map_array(|c| {
                SubpixelPoint::new(clamp(c.x, window.x1, 2), clamp(c.y, window.y1, 1))
            })]
        }),
    },
    Mistake {
        name: "corners made by clipping are rounded",
        sentence: |p| {
            let (step, how) = (
                CLIP_STEPS[(p % 4) as usize],
                [
                    "cut toward the corner where the walk began",
                    "rounded to the nearest",
                    "cut down",
                ][(p / 4) as usize],
            );
            let grid = grid(step);
            format!(
                "clips triangles at the window and the corners that this makes are {how}, to {grid}: shared edges that cross the border leave holes and doubles"
            )
        },
        repair: "keep the unclipped edges for the fill, or compute new corners in the same order for both neighbours and with more bits",
        page: "ch07",
        refuted: "a triangle that crosses the border at a point between those of the grid and is drawn rightly",
        parameters: Parameters::Below(12),
        draws: Fill::Instead(|corners, window, p| {
            fills::clipped(corners, window, CLIP_STEPS[(p % 4) as usize].into(), p / 4)
        }),
    },
    Mistake {
        name: "split at a rounded corner",
        sentence: |p| {
            let step = STEPS_WITH_ONE[(p % 5) as usize];
            let how = if p / 5 == 0 { "rounded to the nearest" } else { "cut down" };
            format!(
                "splits at the height of the middle corner, at a point that is {how} to 1/{} px, so that the long edge has a kink",
                256 / step
            )
        },
        repair: "walk both halves along the unsplit long edge",
        page: "ch02-scanline",
        refuted: "a triangle whose long edge passes between two points of that grid and is drawn rightly",
        parameters: Parameters::Below(10),
        draws: Fill::Instead(|corners, _, p| {
            fills::split(corners, STEPS_WITH_ONE[(p % 5) as usize], p / 5 == 1)
        }),
    },
    Mistake {
        name: "triangles are left out by size",
        sentence: |p| {
            let (what, limit) = size_said(p);
            format!(
                "does not draw triangles whose {what} is {} about {limit}",
                if size(p).1 { "below" } else { "at least" }
            )
        },
        repair: "remove the test, or leave out only what covers no sample",
        page: "effects",
        refuted: "a triangle beyond that size that is drawn",
        parameters: Parameters::Sizes,
        draws: Fill::Changed(|mask, corners, _, p| {
            let (metric, below, limit) = size(p);
            if (fills::metric(corners, metric) < limit) == below {
                *mask = Mask::default();
            }
        }),
    },
    Mistake {
        name: "small ones are drawn from behind",
        sentence: |p| {
            let (what, limit) = size_said(p);
            format!(
                "draws triangles of the winding that it does not draw where their {what} is below about {limit}"
            )
        },
        repair: "the sign of the area alone decides about the winding, without a threshold",
        page: "ch02-edge-functions",
        refuted: "such a triangle that is not drawn",
        parameters: Parameters::Sizes,
        draws: Fill::Ruled(Reach::Pixel, |corners, window, base, p| {
            let (metric, below, limit) = size(p);
            let is_small = below && fills::metric(corners, metric) < limit;
            let draws = if is_small { Windings::Both } else { base.draws };
            TriangleConvention { draws, ..*base }.mask(corners, window).unwrap_or_default()
        }),
    },
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
    Mistake {
        name: "a half is missing",
        sentence: |p| {
            format!(
                "draws {}, of the two halves that the middle corner makes",
                [
                    "the upper half alone",
                    "the lower half alone",
                    "all but the first row of the lower half",
                    "all but the last row of the upper half"
                ][p as usize]
            )
        },
        repair: "fill both halves: the lower one begins in the row where the upper one ends",
        page: "ch02-scanline",
        refuted: "a pixel of the other half that is drawn",
        parameters: Parameters::Below(4),
        draws: Fill::Changed(|mask, corners, window, p| {
            let middle = fills::middle_row(corners);
            mask.retain(window, &|_, y| match p {
                0 => i64::from(y) < middle,
                1 => i64::from(y) >= middle,
                _ => i64::from(y) != middle + 2 - p,
            });
        }),
    },
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
    Mistake {
        name: "the box is too small",
        sentence: |p| {
            let axes = ["both axes", "x", "y"][(p % 3) as usize];
            format!(
                "looks for pixels in a box that is too small in {axes}: {}",
                BOXES[(p / 3) as usize].0
            )
        },
        repair: "the box runs from the floor of the smallest coordinate to the ceiling of the largest one",
        page: "games101",
        refuted: "a covered pixel outside that box that is drawn",
        parameters: Parameters::Below(24),
        draws: Fill::Changed(|mask, corners, window, p| {
            let of = BOXES[(p / 3) as usize].1;
            let bounds = |axis: usize| {
                let v = corners.map_array(|c| i64::from([c.x, c.y][axis]));
                of(v.into_iter().min().unwrap_or(0), v.into_iter().max().unwrap_or(0))
            };
            let ([x0, x1], [y0, y1]) = (bounds(0), bounds(1));
            let axis = p % 3;
            mask.retain(window, &|x, y| {
                let (x, y) = (i64::from(x), i64::from(y));
                (axis == 2 || (x0..x1).contains(&x)) && (axis == 1 || (y0..y1).contains(&y))
            });
        }),
    },
    Mistake {
        name: "the box misses a corner",
        sentence: |p| {
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
                exchanged(p / 18 % ORDERS.len() as i64),
                ["", ", and ends before the ceiling of the largest coordinate"]
                    [(p / BOXES_OF_TWO) as usize]
            )
        },
        repair: "the box holds all three corners",
        page: "games101",
        refuted: "a covered pixel near that corner that is drawn",
        parameters: Parameters::Below(2 * BOXES_OF_TWO),
        draws: Fill::Changed(|mask, corners, window, p| {
            let order = p / 18 % ORDERS.len() as i64;
            let ordered = in_order(corners, order, twice_area(corners) > 0);
            let (side, without) = (p % 6, (p / 6 % 3) as usize);
            if side < 2 && p >= BOXES_OF_TWO {
                return;
            }
            let ends = [0, 1].map_array(|i: usize| {
                let c = ordered[(without + 1 + i) % 3];
                if side % 2 == 0 { c.x } else { c.y }
            });
            let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            mask.retain(window, &|x, y| {
                let at = if side % 2 == 0 { x } else { y };
                let is_after = at >= low.div_euclid(256) || matches!(side, 2 | 3);
                let last = high.div_euclid(256) - i32::from(p >= BOXES_OF_TWO && high % 256 == 0);
                is_after && (at <= last || side < 2)
            });
        }),
    },
    Mistake {
        name: "width and height are exchanged",
        sentence: |p| {
            [
                "ends its loop over columns at the height of the window",
                "ends its loop over rows at the width of the window",
                "exchanges the width and the height of the window",
            ][p as usize]
                .to_owned()
        },
        repair: "columns end at the width, and rows at the height",
        page: "ch11",
        refuted: "a pixel beyond that in a window that is no square",
        parameters: Parameters::Below(3),
        draws: Fill::Changed(|mask, _, window, p| {
            mask.retain(window, &|x, y| (p == 1 || x < window.y1) && (p == 0 || y < window.x1));
        }),
    },
    Mistake {
        name: "tiles are skipped",
        sentence: |p| {
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
        },
        repair: "reject a tile only where one edge has the whole tile outside, and test each pixel of the others",
        page: "speed",
        refuted: "a covered pixel in such a tile that is drawn",
        parameters: Parameters::Fixed(&TILES),
        draws: Fill::Changed(fills::tiles),
    },
    Mistake {
        name: "blocks are drawn whole",
        sentence: |p| {
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
        },
        repair: "test the sample of each pixel",
        page: "speed",
        refuted: "two pixels of such a block of which one is drawn",
        parameters: Parameters::Below(125),
        draws: Fill::Ruled(Reach::Pixel, fills::blocks),
    },
    Mistake {
        name: "the rest of a group",
        sentence: |p| {
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
        },
        repair: "draw what is left after the last whole group pixel by pixel, or by a mask",
        page: "speed",
        refuted: "a row whose length is no multiple of the group and that is right",
        parameters: Parameters::Below(48),
        draws: Fill::Changed(fills::groups),
    },
    Mistake {
        name: "pixels are drawn twice",
        sentence: |p| {
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
        },
        repair: "compare the bounds of the loops: one ends where the next one begins",
        page: "ch02-scanline",
        refuted: "such a pixel that is drawn once",
        parameters: Parameters::Below(10),
        draws: Fill::Twice(fills::twice),
    },
    Mistake {
        name: "edges in whole numbers",
        sentence: |p| {
            format!(
                "cuts the steps of the edge functions to {}, so that edges turn{}{}",
                grid(STEPS_WITH_ONE[(p % 4) as usize]),
                ["", ", and begins with a whole number too"][(p / 4 % 2) as usize],
                ["", "; triangles without area are drawn as others"][(p / 8) as usize]
            )
        },
        repair: "keep the fraction of the steps, or snap the corners before the steps are computed",
        page: "ch02-edge-functions",
        refuted: "a long edge between corners with a fraction that passes where it should",
        parameters: Parameters::Below(16),
        draws: Fill::Ruled(Reach::Pixel, fills::cut_edges),
    },
    Mistake {
        name: "parts of the window are never drawn",
        sentence: |p| {
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
        },
        repair: "look at the last iteration of the loop over groups of rows or columns",
        page: "speed",
        refuted: "a pixel there that is drawn",
        parameters: Parameters::Fixed(&GROUPS),
        draws: Fill::Changed(|mask, _, window, p| {
            let (axis, every, rest) = (p / 10_000, p / 100 % 100, p % 100);
            mask.retain(window, &|x, y| i64::from([y, x, x + y][axis as usize]) % every != rest);
        }),
    },
    Mistake {
        name: "neighbours of covered pixels",
        sentence: |p| {
            let of = fills::NEIGHBOURS[(p / 2) as usize].1;
            match p % 2 {
                0 => format!("draws a pixel also where any of {of} is covered"),
                _ => format!("draws a pixel only where {of} are covered, too"),
            }
        },
        repair: "test the sample of the pixel alone",
        page: "ch02",
        refuted: "a pixel at an edge that is drawn rightly",
        parameters: Parameters::Below(2 * fills::NEIGHBOURS.len() as i64),
        draws: Fill::Sampled(Reach::Pixel, fills::grown),
    },
    Mistake {
        name: "every second row or column is moved",
        sentence: |p| {
            format!(
                "tests samples {} px further {} in {} of {} numbers",
                ["1/2", "1"][(p / 16) as usize],
                ["left", "right", "up", "down"][(p / 4 % 4) as usize],
                ["rows", "columns"][(p / 2 % 2) as usize],
                ["even", "odd"][(p % 2) as usize]
            )
        },
        repair: "test the same place in every pixel",
        page: "ch02",
        refuted: "a pixel at an edge in such a row or column that is drawn rightly",
        parameters: Parameters::Below(32),
        draws: Fill::Sampled(Reach::Pixel, fills::alternating),
    },
    Mistake {
        name: "the search for pixels ends too early",
        sentence: |p| {
            [
                "stops at the first row without a covered sample after one with some",
                "looks for the first pixel of a row from that of the row before on, so that edges to the left are lost",
                "looks for the last pixel of a row up to that of the row before, so that edges to the right are lost",
            ][p as usize]
                .to_owned()
        },
        repair: "look through the whole box, or walk back to where the edge lies",
        page: "speed",
        refuted: "a covered pixel that lies there and is drawn",
        parameters: Parameters::Below(3),
        draws: Fill::Changed(|mask, _, window, p| fills::searched(mask, window, p)),
    },
    Mistake {
        name: "rows keep their length at the window",
        sentence: |_| {
            "begins rows at the left side of the window that begin left of it, and keeps their length, so that they end too far right".to_owned()
        },
        repair: "clip both ends of a row, and take its length after that",
        page: "ch07",
        refuted: "a row that begins left of the window and ends where it should",
        parameters: Parameters::Fixed(&[0]),
        draws: Fill::Sampled(Reach::Window, |corners, window, base, _| {
            let mut mask = base.mask(corners, window).unwrap_or_default();
            fills::slid(&mut mask, corners, window, base);
            mask
        }),
    },
    Mistake {
        name: "rounding of floats",
        sentence: |p| {
            let (formula, precision) = (p / 6, ["32", "64", "16"][(p % 3) as usize]);
            format!(
                "computes in floats of {precision} bits {}: rounding decides about samples on and near edges",
                fills::FORMULAS[formula as usize]
            )
        },
        repair: "snap the corners to a grid and compute the edge functions in integers",
        page: "stability",
        refuted: "a sample on an edge that this formula rounds away and that is drawn rightly",
        // A formula, whether corners are exchanged where they turn the other way, and the precision.
        parameters: Parameters::Below(6 * fills::FORMULAS.len() as i64),
        draws: Fill::Ruled(Reach::Pixel, |corners, window, base, p| {
            fills::float(corners, window, base, (p / 6) as usize, p / 3 % 2 == 0, p % 3)
        }),
    },
    Mistake {
        name: "crossings are stepped",
        sentence: Scan::sentence,
        repair: "compute each crossing from the corner, or keep the remainder of the division as Bresenham's algorithm does",
        page: "ch02-scanline",
        refuted: "a long edge whose last rows are where they should be",
        parameters: Parameters::Scans(Scan::is_rounded),
        draws: Fill::Own(scans::scanned),
    },
    Mistake {
        name: "corners are sorted by whole rows",
        sentence: Scan::sentence,
        repair: "sort by the heights that slopes are computed from",
        page: "ch02-scanline",
        refuted: "two corners in one row, the lower one first, and a triangle that is drawn rightly",
        parameters: Parameters::Scans(Scan::is_sorted_by_rows),
        draws: Fill::Own(scans::scanned),
    },
    Mistake {
        name: "rows end elsewhere",
        sentence: Scan::sentence,
        repair: "keep the fraction of the corners, take the crossings at the height of the samples, and draw the samples between them",
        page: "ch02-scanline",
        refuted: "a row whose ends are where they should be",
        parameters: Parameters::Scans(Scan::is_exact),
        draws: Fill::Own(scans::scanned),
    },
    Mistake {
        name: "all that edges touch",
        sentence: |p| {
            format!(
                "draws the pixels that the sides touch, too, walked in floats of 64 bits from pixel to pixel{}",
                [
                    "",
                    ", but not those that a side touches along their own sides or in one point",
                    ", but not those that a side touches by less than 1/100 px"
                ][p as usize]
            )
        },
        repair: "draw the samples within the triangle alone, or declare that all that is touched is drawn, and compute it exactly",
        page: "ch02",
        refuted: "a pixel that is touched and is not drawn",
        parameters: Parameters::Below(3),
        draws: Fill::Ruled(Reach::Window, |corners, window, base, p| {
            let mut mask = base.mask(corners, window).unwrap_or_default();
            let points = cells::places(corners);
            for i in 0..3 {
                let side = [points[i], points[(i + 1) % 3]];
                mask.add(&cells::touched(side, window, [0.0, 1e-3, 1e-2][p as usize]));
            }
            mask
        }),
    },
    Mistake {
        name: "coverage by area",
        sentence: |p| {
            let least = cells::least_said(cells::LEAST[p as usize]);
            format!(
                "adds up areas in whole numbers of 1/256 px, as for antialiasing, and draws a pixel from {least} on"
            )
        },
        repair: "test one sample of each pixel: what neighbours share is drawn by one of them then",
        page: "ch02",
        refuted: "a pixel of which less is covered and that is drawn",
        parameters: Parameters::Below(4),
        draws: Fill::Own(|corners, window, p| {
            cells::by_area(&cells::places(corners), window, cells::LEAST[p as usize])
        }),
    },
    Mistake {
        name: "two halves from their tips",
        sentence: |p| {
            let [precision, whole, ends, rows, upper, lower] = fills::HALVES.digits(p);
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
        },
        repair: "walk both halves along the unsplit long edge, and take each crossing at the height of the samples",
        page: "ch02-scanline",
        refuted: "a triangle with its top cut off that draws the same rows below",
        parameters: Parameters::Below(fills::HALVES.count()),
        draws: Fill::Own(fills::halves),
    },
    Mistake {
        name: "whole pixels by integer divisions",
        sentence: |p| {
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
        },
        repair: "neighbours draw the pixels of a shared edge twice: keep the fraction of the corners and follow a fill rule",
        page: "ch02-scanline",
        refuted: "a corner whose fraction moves an edge",
        parameters: Parameters::Below(128),
        draws: Fill::Own(fills::whole_pixels),
    },
    Mistake {
        name: "whole pixels between crossings",
        sentence: |p| {
            format!(
                "cuts corners to whole pixels{} and fills each row from the pixel of a crossing to that of the next, {}, {}: the polygon of many libraries",
                ["", " toward zero", " (to the nearest)"][(p / 32) as usize],
                fills::CROSSINGS[(p % 8) as usize],
                fills::LAST_ROWS[(p / 8 % 4) as usize]
            )
        },
        repair: "keep the fraction of the corners, and draw the samples between the crossings: what lies on the right edge belongs to the neighbour",
        page: "ch02-scanline",
        refuted: "a corner whose fraction moves an edge",
        parameters: Parameters::Below(96),
        draws: Fill::Own(fills::crossings),
    },
    Mistake {
        name: "the whole box is filled",
        sentence: |p| {
            [
                "fills the box of the corners".to_owned(),
                "draws the border alone and fills nothing".to_owned(),
                "fills the box of the corners, also where these have no area".to_owned(),
            ][p as usize]
                .clone()
        },
        repair: "test every sample against the three edges",
        page: "ch02-edge-functions",
        refuted: "a corner of the box that is not drawn",
        parameters: Parameters::Fixed(&[0, 1, 2]),
        draws: Fill::Changed(|mask, corners, window, p| {
            if p == 1 {
                let full = *mask;
                let inner = |x: i32, y: i32| {
                    [(1, 0), (-1, 0), (0, 1), (0, -1)].iter().all(|(dx, dy)| {
                        !window.contains(x + dx, y + dy) || full.has(x + dx, y + dy)
                    })
                };
                mask.retain(window, &|x, y| !inner(x, y));
                return;
            }
            if p == 0 && twice_area(corners) == 0 {
                return;
            }
            let ends =
                |v: [i32; 3]| (v.into_iter().min().unwrap_or(0), v.into_iter().max().unwrap_or(0));
            let ((x0, x1), (y0, y1)) =
                (ends(corners.map_array(|c| c.x)), ends(corners.map_array(|c| c.y)));
            for y in window.y0..window.y1 {
                for x in window.x0..window.x1 {
                    let (sx, sy) = (x * 256 + 128, y * 256 + 128);
                    if (x0..x1).contains(&sx) && (y0..y1).contains(&sy) {
                        mask.set(x, y);
                    }
                }
            }
        }),
    },
];

/// Parameters of a rule by order of both windings; those of one follow.
const OF_BOTH: i64 = 27 * ORDERS.len() as i64;
const AREAS: [f64; 8] = [0.0, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
const EPSILONS: [f64; 7] = [1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1];
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

fn pair(p: i64) -> (usize, usize) {
    ((p / 6) as usize, (p % 6) as usize)
}

fn grid(step: i32) -> String {
    match step {
        256 => "whole pixels".to_owned(),
        _ => format!("1/{} px", 256 / step),
    }
}

/// Ways to bring a coordinate to a step.
type Round = fn(i32, i32) -> i32;
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
const AXIS_STEPS: [i32; 5] = [256, 128, 64, 32, 16];

/// The step and the way to round of x and of y.
fn axes(p: i64) -> [(i32, usize); 2] {
    [p % AXIS, p / AXIS].map_array(|axis| match axis - 1 {
        at @ 0.. => (AXIS_STEPS[(at / 5) as usize], (at % 5) as usize),
        _ => (1, 0),
    })
}
/// How far an edge may be moved, in subpixels.
const OFFSETS: [i64; 8] = [1, 2, 8, 16, 32, 64, 128, 256];
/// Bits of weights in whole numbers.
const WEIGHT_BITS: [u32; 8] = [4, 7, 8, 10, 12, 14, 15, 16];
/// Bits of reciprocals of the area, which has 16 bits of fraction.
const RECIPROCAL_BITS: [u32; 3] = [40, 32, 24];

const STEPS_WITH_ONE: [i32; 5] = [256, 128, 64, 16, 1];
const CLIP_STEPS: [i32; 4] = [256, 64, 16, 4];

const METRICS: i64 = fills::METRICS.len() as i64;

/// A metric of the size, whether what lies below it is left out, and the limit: packed in a number.
pub(super) fn packed_size(metric: usize, below: bool, limit: i64) -> i64 {
    (limit * METRICS + metric as i64) * 2 + i64::from(below)
}

pub(super) fn size(p: i64) -> (usize, bool, i64) {
    ((p / 2 % METRICS) as usize, p % 2 == 1, p / (2 * METRICS))
}

/// What is measured of a size, and its limit with the unit.
fn size_said(p: i64) -> (&'static str, String) {
    let (metric, _, limit) = size(p);
    let (what, unit, _) = fills::METRICS[metric];
    let per_unit = match metric {
        0 => 131_072,
        fills::RATIO => fills::RATIOS,
        _ => 256,
    };
    (what, format!("{} {unit}", fills::decimal(limit, per_unit)).trim_end().to_owned())
}

type IsKind = fn(&Corners, PixelRect) -> bool;
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
type Bounds = fn(i64, i64) -> [i64; 2];
const BOXES: [(&str, Bounds); 8] = [
    ("the pixel that holds the largest coordinate is left out", |low, high| {
        [low.div_euclid(256), high.div_euclid(256)]
    }),
    ("the pixel that holds the smallest coordinate is left out", |low, high| {
        [low.div_euclid(256) + 1, high.div_euclid(256) + 1]
    }),
    ("its ends are rounded, and the last pixel is left out", |low, high| {
        [(low + 128).div_euclid(256), (high + 128).div_euclid(256) - 1]
    }),
    ("both ends are cut down, and the last pixel and the first are left out", |low, high| {
        [low.div_euclid(256) + 1, high.div_euclid(256)]
    }),
    (
        "the ceiling of the largest coordinate counts as the last pixel and is left out once more",
        |low, high| [low.div_euclid(256), (high + 255).div_euclid(256) - 1],
    ),
    ("the smallest coordinate is rounded up", |low, high| {
        [(low + 255).div_euclid(256), high.div_euclid(256) + 1]
    }),
    ("the smallest coordinate is rounded up past the next pixel", |low, high| {
        [(low + 255).div_euclid(256) + 1, high.div_euclid(256) + 1]
    }),
    ("the pixel before that of the largest coordinate is left out, too", |low, high| {
        [low.div_euclid(256), high.div_euclid(256) - 1]
    }),
];

/// Every 2nd, 4th, 8th and 16th row or column, the first or the last of them; and checkerboards.
const GROUPS: [i64; 18] = [
    20_200, 20_201, 200, 201, 10_200, 10_201, 400, 403, 10_400, 10_403, 800, 807, 10_800, 10_807,
    1600, 1615, 11_600, 11_615,
];

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

fn exchanged(order: i64) -> String {
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
    let all = (0..6).chain((7..16).map(|power| 1 << power)).chain(others.iter().copied());
    let mut of = |limit: i64| {
        // Places that depend on the window have one range.
        (0..3 * RANGES)
            .filter(move |p| limit >= 6 || p % RANGES == 0)
            .map(move |p| limit * 3 * RANGES + p)
    };
    all.flat_map(&mut of).collect()
}

/// The range that coordinates are clamped to, in subpixels, of a window with such a side.
fn clamped_to(p: i64, side_px: i32) -> [i32; 2] {
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
