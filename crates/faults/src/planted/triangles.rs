//! Rasterizers with a planted fault each: in their coverage, or in their values.
//!
//! Those of coverage test samples one by one with a rule that is wrong in one way, or spoil the
//! spans of an engine the way real code goes wrong; those of values do so with its fragments.

use super::each_sample;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate, Rasterize};
use rasterproof_core::geometry::{centre_of, pixel_box, sorted, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::raster::edge_function::{self, EdgeFunction};
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{Corners, Fragment, ScreenTriangle, ScreenVertex, Span, Varying};

planted! {
    TriangleMutant {
        InclusiveEdges "inclusive-edges": "samples on any edge belong (SYSU assignment 2: <= 0)",
        ExclusiveEdges "exclusive-edges": "samples on no edge belong (GAMES101 homework 2: > 0)",
        BottomRightRule "bottom-right-rule":
            "bottom and right edges belong instead of top and left ones",
        LeftOnlyRule "left-only-rule": "left edges belong, top edges do not",
        SampleOffByOneSubpixel "sample-off-by-one-subpixel": "samples lie 1/256 px off the centre",
        DropsFirstRow "drops-first-row": "the first row of every triangle is lost",
        DoublesSpanEnd "doubles-span-end": "the last pixel of long spans is drawn twice",
        CullsOneWinding "culls-one-winding": "counter-clockwise triangles are lost, as if culled",
        WrapsInI32 "wraps-in-i32": "edge functions wrap around in 32 bits",
        SwappedWeights "swapped-weights": "the weights of two corners are swapped",
        AffineAttributes "affine-attributes": "attributes ignore w",
        PerspectiveDepth "perspective-depth": "depth is interpolated as if it were an attribute",
        ValuesAtCorner "values-at-corner":
            "values are taken at the pixel's corner, not at its centre",
        ValuesThroughF32 "values-through-f32": "values are rounded to f32 on the way",
        PanicsOnFlatBottom "panics-on-flat-bottom": "panics where the lowest edge is horizontal",
        LeavesWindow "leaves-window": "draws one pixel outside the window",
        LastEdgeInclusive "last-edge-inclusive": "the tie rule follows the order of the corners",
        TruncatesTowardsZero "truncates-towards-zero":
            "columns are truncated towards zero: (int) of a negative",
        HoleInLongRows "hole-in-long-rows":
            "a pixel in the middle of long spans is lost, as by a vector loop",
        SeamBetweenTiles "seam-between-tiles":
            "the first column of every tile but the leftmost is lost",
        FillsZeroArea "fills-zero-area":
            "a triangle of zero area covers the samples it passes through",
        RejectsThin "rejects-thin": "areas below half a pixel count as degenerate (the book's eps)",
        SplitsAtRoundedPoint "splits-at-rounded-point":
            "the book's split vertex, rounded to the lattice",
        StepsInF32 "steps-in-f32": "edges are stepped down row by row in f32 (the book's sx += dx)",
        NaiveBarycentric "naive-barycentric":
            "values are weighted sums in the order the corners came in",
        EpsilonInDenominator "epsilon-in-denominator":
            "a small number keeps the division by w from failing",
        ClampsInvW "clamps-inv-w": "1/w is clamped to 1",
    }
}

impl Rasterize for TriangleMutant {
    #[inline]
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        self.spans(corners, bounds, &mut emit);
    }
}

impl Interpolate for TriangleMutant {
    #[inline]
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        self.values(triangle, bounds, &mut emit);
    }
}

// No mutant is called from a hot loop: through `dyn`, its engines are compiled once.
impl TriangleMutant {
    /// The spans with their fault: of an engine, spoilt, or of a rule that is tested sample by sample.
    pub fn spans(&self, corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
        match self {
            Self::InclusiveEdges => by_rule(corners, bounds, 0, |_, _| true, emit),
            Self::ExclusiveEdges => by_rule(corners, bounds, 0, |_, _| false, emit),
            Self::BottomRightRule => {
                by_rule(corners, bounds, 0, |dx, dy| dy > 0 || (dy == 0 && dx < 0), emit);
            }
            Self::LeftOnlyRule => by_rule(corners, bounds, 0, |_, dy| dy < 0, emit),
            Self::SampleOffByOneSubpixel => {
                by_rule(corners, bounds, -1, |dx, dy| dy < 0 || (dy == 0 && dx > 0), emit);
            }
            Self::DropsFirstRow => {
                let mut first = None;
                scanline_spans(corners, bounds, &mut |span| {
                    if span.y_px != *first.get_or_insert(span.y_px) {
                        emit(span);
                    }
                });
            }
            Self::DoublesSpanEnd => scanline_spans(corners, bounds, &mut |span| {
                emit(span);
                if span.x1_px - span.x0_px > 8 {
                    emit(Span { x0_px: span.x1_px - 1, ..span });
                }
            }),
            Self::CullsOneWinding => {
                if twice_area(&corners) > 0 {
                    Scanline.cover(corners, bounds, emit);
                }
            }
            Self::WrapsInI32 => wrapping(corners, bounds, emit),
            Self::PanicsOnFlatBottom => {
                let [a, b, c] = corners.map_array(|corner| corner.y);
                let lowest = a.max(b).max(c);
                let on_it = corners.iter().filter(|corner| corner.y == lowest).count();
                assert!(on_it != 2, "planted: slope of a flat edge");
                Scanline.cover(corners, bounds, emit);
            }
            Self::LeavesWindow => scanline_spans(corners, bounds, &mut |span| {
                emit(Span { x1_px: span.x1_px + i32::from(span.x1_px == bounds.x1), ..span });
            }),
            _ => self.cover_more(corners, bounds, emit),
        }
    }

    /// The second half of the faults of coverage; what is left errs in its values only.
    fn cover_more(self, corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
        match self {
            Self::LastEdgeInclusive => last_edge_inclusive(corners, bounds, emit),
            Self::TruncatesTowardsZero => scanline_spans(corners, bounds, &mut |span| {
                // ceil(x - 1/2) by way of an (int) that rounds up below zero.
                let up = |px: i32| (px + i32::from(px < 0)).min(bounds.x1);
                let (x0_px, x1_px) = (up(span.x0_px), up(span.x1_px));
                if x0_px < x1_px {
                    emit(Span { x0_px, x1_px, ..span });
                }
            }),
            Self::HoleInLongRows => scanline_spans(corners, bounds, &mut |span| {
                let end = span.x1_px - span.x1_px.rem_euclid(8);
                if end - 8 > span.x0_px && end < span.x1_px {
                    emit(Span { x1_px: end, ..span });
                    if end + 1 < span.x1_px {
                        emit(Span { x0_px: end + 1, ..span });
                    }
                } else {
                    emit(span);
                }
            }),
            Self::SeamBetweenTiles => scanline_spans(corners, bounds, &mut |span| {
                let lost = span.x0_px == bounds.x0 && bounds.x0 > 0;
                let x0_px = span.x0_px + i32::from(lost);
                if x0_px < span.x1_px {
                    emit(Span { x0_px, ..span });
                }
            }),
            Self::FillsZeroArea if twice_area(&corners) == 0 => {
                fills_zero_area(corners, bounds, emit)
            }
            Self::RejectsThin if twice_area(&corners).abs() < i128::from(SUBPIXELS * SUBPIXELS) => {
            }
            Self::SplitsAtRoundedPoint => splits_at_rounded_point(corners, bounds, emit),
            Self::StepsInF32 => steps_in_f32(corners, bounds, emit),
            _ => EdgeFunction.cover(corners, bounds, emit),
        }
    }

    /// What [`Interpolate::fragments`] does: faults of values spoil the corners or the fragments, and the others have right values.
    pub fn values<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Fragment<V>),
    ) {
        // Some faults are right values of wrong corners.
        let mut spoilt = *triangle;
        match self {
            Self::SwappedWeights => {
                let [_, b, c] = &triangle.vertices;
                (spoilt.vertices[1].varying, spoilt.vertices[2].varying) = (c.varying, b.varying);
            }
            Self::AffineAttributes => {
                for vertex in &mut spoilt.vertices {
                    vertex.inv_w = 1.0;
                }
            }
            Self::ValuesAtCorner => {
                // A triangle moved by half a pixel shows at each centre what was at the corner;
                // its outermost pixels are not covered and keep their values.
                for vertex in &mut spoilt.vertices {
                    vertex.position.x = vertex.position.x.saturating_add(HALF_PIXEL);
                }
                let mut moved = std::collections::HashMap::new();
                let mut keep = |f: Fragment<V>| {
                    moved.insert((f.x_px, f.y_px), f);
                };
                Scanline.fragments(&spoilt, bounds, &mut keep as &mut dyn FnMut(_));
                edge_values(triangle, bounds, &mut |f| {
                    emit(moved.get(&(f.x_px, f.y_px)).copied().unwrap_or(f));
                });
                return;
            }
            Self::PerspectiveDepth => return perspective_depth(triangle, bounds, emit),
            Self::ValuesThroughF32 => {
                edge_values(triangle, bounds, &mut |f| {
                    let scale = 1.0 + f64::from(f32::EPSILON) / 4.0;
                    let depth = f64::from(f.depth as f32);
                    emit(Fragment { depth, varying: f.varying * scale, ..f });
                });
                return;
            }
            Self::ClampsInvW => {
                for vertex in &mut spoilt.vertices {
                    vertex.inv_w = vertex.inv_w.min(1.0);
                }
            }
            Self::NaiveBarycentric => return barycentric(triangle, bounds, 0.0, emit),
            Self::EpsilonInDenominator => return barycentric(triangle, bounds, 1e-9, emit),
            _ => {}
        }
        if matches!(self, Self::SwappedWeights | Self::AffineAttributes | Self::ClampsInvW) {
            return edge_values(&spoilt, bounds, emit);
        }
        // Faults of coverage: right values at the wrong pixels.
        self.spans(triangle.corners(), bounds, &mut |span| {
            let row =
                PixelRect { x0: span.x0_px, y0: span.y_px, x1: span.x1_px, y1: span.y_px + 1 };
            let mut next = row.x0;
            edge_values(triangle, row, &mut |f| {
                on_outline(triangle, PixelRect { x0: next, x1: f.x_px, ..row }, emit);
                next = f.x_px + 1;
                emit(f);
            });
            on_outline(triangle, PixelRect { x0: next, ..row }, emit);
        });
    }
}

/// Fragments of the pixels of a row whose centres lie on the outline: an engine whose rule gives it
/// such a pixel has a value there like anywhere else. Weights count from the first vertex, so that
/// the value is as exact as an engine's.
fn on_outline<V: Varying>(
    triangle: &ScreenTriangle<V>,
    row: PixelRect,
    emit: &mut dyn FnMut(Fragment<V>),
) {
    // The topmost, then leftmost vertex first, and clockwise: the order they came in leaves no trace.
    let mut vertices = triangle.vertices;
    // Equal heights from left to right.
    let top = (0..3).min_by_key(|&i| (vertices[i].position.y, vertices[i].position.x));
    vertices.rotate_left(top.unwrap_or(0));
    if twice_area(&triangle.corners()) < 0 {
        vertices.swap(1, 2);
    }
    let [v0, v1, v2] = &vertices;
    let corners = [v0.position, v1.position, v2.position];
    let area = twice_area(&corners);
    let largest = v0.inv_w.max(v1.inv_w).max(v2.inv_w);
    let q = [v0.inv_w, v1.inv_w, v2.inv_w].map_array(|inv_w| inv_w / largest);
    for x_px in row.x0..row.x1 {
        let sample = centre_of(x_px, row.y0);
        // Twice the areas beside the sample: where one is below 0, the sample is outside.
        let [a, b, c] = corners;
        let e =
            [twice_area(&[b, c, sample]), twice_area(&[c, a, sample]), twice_area(&[a, b, sample])];
        if area == 0 || e.iter().any(|&e| e < 0) {
            continue;
        }
        let l = e.map_array(|e| e as f64 / area as f64);
        // 1/w at the sample, as a part of the largest one.
        let scale = 1.0 / ((l[0] * q[0] + l[1] * q[1]) + l[2] * q[2]);
        let (d1, d2) = (v1.varying - v0.varying, v2.varying - v0.varying);
        emit(Fragment {
            x_px,
            y_px: row.y0,
            depth: v0.depth + ((v1.depth - v0.depth) * l[1] + (v2.depth - v0.depth) * l[2]),
            varying: v0.varying + (d1 * (l[1] * q[1]) + d2 * (l[2] * q[2])) * scale,
        });
    }
}

fn edge_values<V: Varying>(
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    emit: &mut dyn FnMut(Fragment<V>),
) {
    EdgeFunction.fragments(triangle, bounds, emit);
}

fn scanline_spans(corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
    Scanline.cover(corners, bounds, emit);
}

/// The pixels of `bounds` that can hold anything of the triangle, with one to spare.
fn near(corners: &Corners, bounds: PixelRect) -> PixelRect {
    pixel_box(corners, 1).intersect(&bounds)
}

/// Tests each sample of `rect` against three edges: `keeps` says for an edge from a to b, inside to
/// its right, and a pixel whether it keeps the sample.
fn by_edges(
    mut corners: Corners,
    rect: PixelRect,
    keeps: &dyn Fn([SubpixelPoint; 2], i32, i32) -> bool,
    emit: &mut dyn FnMut(Span),
) {
    match twice_area(&corners).signum() {
        0 => return,
        -1 => corners.swap(1, 2),
        _ => {}
    }
    let [a, b, c] = corners;
    let edges = [[a, b], [b, c], [c, a]];
    let inside = |x_px, y_px| edges.iter().all(|&edge| keeps(edge, x_px, y_px));
    each_sample(rect, &inside, emit);
}

/// By edges in exact integers; `owns` says for an edge (dx, dy) whether samples on it belong.
fn by_rule(
    corners: Corners,
    bounds: PixelRect,
    sample_shift: i32,
    owns: fn(i128, i128) -> bool,
    emit: &mut dyn FnMut(Span),
) {
    let keeps = |[a, b]: [SubpixelPoint; 2], x_px, y_px| {
        let (dx, dy) = (i128::from(b.x) - i128::from(a.x), i128::from(b.y) - i128::from(a.y));
        let SubpixelPoint { x, y } = centre_of(x_px, y_px);
        let sample =
            SubpixelPoint::new(x.saturating_add(sample_shift), y.saturating_add(sample_shift));
        let edge = twice_area(&[a, b, sample]);
        edge > 0 || (edge == 0 && owns(dx, dy))
    };
    by_edges(corners, near(&corners, bounds), &keeps, emit);
}

/// Edge functions as they come out in 32 bits, in the whole window, for a wrapped one may be positive anywhere.
fn wrapping(corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
    let keeps = |[a, b]: [SubpixelPoint; 2], x_px, y_px| {
        let sample = centre_of(x_px, y_px);
        let (dx, dy) = (b.x.wrapping_sub(a.x), b.y.wrapping_sub(a.y));
        let edge = dx
            .wrapping_mul(sample.y.wrapping_sub(a.y))
            .wrapping_sub(dy.wrapping_mul(sample.x.wrapping_sub(a.x)));
        edge > 0 || (edge == 0 && (dy < 0 || (dy == 0 && dx > 0)))
    };
    by_edges(corners, bounds, &keeps, emit);
}

/// The top-left rule is forgotten; of the three edges as they come the last one is inclusive.
fn last_edge_inclusive(corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
    let sign = twice_area(&corners).signum();
    let [a, b, c] = corners;
    let inside = |x_px, y_px| {
        let sample = centre_of(x_px, y_px);
        let edges =
            [twice_area(&[a, b, sample]), twice_area(&[b, c, sample]), twice_area(&[c, a, sample])];
        let [first, second, last] = edges.map_array(|edge| edge * sign);
        sign != 0 && first > 0 && second > 0 && last >= 0
    };
    each_sample(near(&corners, bounds), &inside, emit);
}

/// Draws what lies on a triangle without area: the samples on its line, between its ends.
fn fills_zero_area(corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
    let [a, b, c] = corners;
    let within =
        |p: i32, v: [i32; 3]| v.into_iter().min() <= Some(p) && v.into_iter().max() >= Some(p);
    let inside = |x_px, y_px| {
        let p = centre_of(x_px, y_px);
        let on_line = twice_area(&[a, b, p]) == 0
            && twice_area(&[b, c, p]) == 0
            && twice_area(&[c, a, p]) == 0;
        on_line && within(p.x, [a.x, b.x, c.x]) && within(p.y, [a.y, b.y, c.y])
    };
    each_sample(near(&corners, bounds), &inside, emit);
}

/// The book's section 2.2: the long edge is cut at the height of the middle vertex, and two flat
/// triangles are drawn. The cut has to be somewhere on the lattice, so it bends the edge.
fn splits_at_rounded_point(mut corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
    corners = sorted(corners, |a, b| (a.y, a.x) > (b.y, b.x));
    let [top, middle, bottom] = corners;
    let height = i128::from(bottom.y) - i128::from(top.y);
    if height == 0 || twice_area(&corners) == 0 {
        return;
    }
    let down = i128::from(middle.y) - i128::from(top.y);
    let across = (i128::from(bottom.x) - i128::from(top.x)) * down / height;
    // Between the two ends, so it fits.
    let split = SubpixelPoint::new((i128::from(top.x) + across) as i32, middle.y);
    scanline_spans([top, middle, split], bounds, emit);
    scanline_spans([middle, split, bottom], bounds, emit);
}

/// The book's scanline fill with half-open ranges, stepped down the edges in f32 pixels.
fn steps_in_f32(corners: Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
    let corners = sorted(corners, |a, b| (a.y, a.x) > (b.y, b.x));
    let px = |p: SubpixelPoint| [p.x as f32 / SUBPIXELS as f32, p.y as f32 / SUBPIXELS as f32];
    let [top, middle, bottom] = corners.map_array(px);
    let split = first_centre_in_f32(middle[1]);
    let first = first_centre_in_f32(top[1]).max(bounds.y0);
    let end = first_centre_in_f32(bottom[1]).min(bounds.y1);
    // Down the long edge and one of the short ones.
    step_down(first..split.min(bounds.y1), [top, bottom], [top, middle], bounds, emit);
    step_down(split.max(bounds.y0)..end, [top, bottom], [middle, bottom], bounds, emit);
}

/// The first row or column whose centre is at or after a coordinate in pixels.
fn first_centre_in_f32(px: f32) -> i32 {
    (px - 0.5).ceil() as i32
}

/// The spans of rows between two edges, whose places accumulate from row to row.
fn step_down(
    rows: std::ops::Range<i32>,
    long: [[f32; 2]; 2],
    short: [[f32; 2]; 2],
    bounds: PixelRect,
    emit: &mut dyn FnMut(Span),
) {
    let steps = [long, short].map_array(|[a, b]| (b[0] - a[0]) / (b[1] - a[1]));
    let [mut x, mut other] = [(long[0], steps[0]), (short[0], steps[1])]
        .map_array(|(from, step)| from[0] + (rows.start as f32 + 0.5 - from[1]) * step);
    for y_px in rows {
        let x0_px = first_centre_in_f32(x.min(other)).clamp(bounds.x0, bounds.x1);
        let x1_px = first_centre_in_f32(x.max(other)).clamp(bounds.x0, bounds.x1);
        if x0_px < x1_px {
            emit(Span { y_px, x0_px, x1_px });
        }
        (x, other) = (x + steps[0], other + steps[1]);
    }
}

/// The depth is carried along as a varying of its own.
fn perspective_depth<V: Varying>(
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    emit: &mut dyn FnMut(Fragment<V>),
) {
    let depths = ScreenTriangle {
        vertices: triangle.vertices.map_array(|v| ScreenVertex {
            position: v.position,
            depth: v.depth,
            inv_w: v.inv_w,
            varying: v.depth,
        }),
    };
    // Both walks come to the same pixels in the same order.
    let mut wrong = Vec::new();
    edge_values(&depths, bounds, &mut |f| wrong.push(f.varying));
    let mut wrong = wrong.into_iter();
    edge_values(triangle, bounds, &mut |f| {
        emit(Fragment { depth: wrong.next().unwrap_or(f.depth), ..f });
    });
}

/// v0 l0 + v1 l1 + v2 l2 with l = E / w over their sum and a small number; no canonical order, no
/// differences, so neither a constant nor the order of the vertices comes through exactly.
fn barycentric<V: Varying>(
    triangle: &ScreenTriangle<V>,
    bounds: PixelRect,
    epsilon: f64,
    emit: &mut dyn FnMut(Fragment<V>),
) {
    let [v0, v1, v2] = &triangle.vertices;
    let corners = triangle.corners();
    let area = twice_area(&corners) as f64;
    let mut row = |span: Span| {
        for x_px in span.x0_px..span.x1_px {
            let e = edge_function::edge_values(&corners, x_px, span.y_px)
                .map_array(|e| e as f64 / area);
            let l = [e[0] * v0.inv_w, e[1] * v1.inv_w, e[2] * v2.inv_w];
            let scale = 1.0 / (l[0] + l[1] + l[2] + epsilon);
            emit(Fragment {
                x_px,
                y_px: span.y_px,
                depth: v0.depth * e[0] + v1.depth * e[1] + v2.depth * e[2],
                varying: (v0.varying * l[0] + v1.varying * l[1] + v2.varying * l[2]) * scale,
            });
        }
    };
    EdgeFunction.cover(corners, bounds, &mut row as &mut dyn FnMut(Span));
}
