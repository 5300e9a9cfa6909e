//! Mutants of the engines off the lattice: what somebody would write who thinks that floats suffice.
//!
//! As elsewhere a mutant is a small type behind the contract. The sample testers below share a walk
//! and differ in how they find the sign; the crossing mutant is a scanline without a fallback.

use std::cmp::Ordering;

use super::each_sample;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Decisions, Rasterize, RasterizeExact};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function_exact::EdgeFunctionExact;
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::triangle::{FreeCorners, Span};

planted! {
    ExactMutant {
        PlainF64 "exact-plain-f64":
            "not snapped: the sign of E as f64 computes it, without a filter",
        PlainF32 "exact-plain-f32": "not snapped: the same in f32",
        FilterTooSmall "exact-filter-too-small": "not snapped: a filter a thousand times too small",
        PlainCrossing "exact-plain-crossing":
            "not snapped: crossings as f64 computes them, no fallback",
        SnapsInside "exact-snaps-inside": "not snapped: corners are snapped to 1/256 px after all",
        FlushesToZero "exact-flushes-to-zero": "not snapped: tiny coordinates count as zero",
        InclusiveTies "exact-inclusive-ties": "not snapped: samples on any edge belong",
        BottomRightTies "exact-bottom-right-ties": "not snapped: bottom and right edges belong",
    }
}

impl RasterizeExact for ExactMutant {
    fn cover_exact(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        mut emit: impl FnMut(Span),
    ) -> Decisions {
        self.spans(corners, bounds, &mut emit)
    }
}

impl ExactMutant {
    /// What [`RasterizeExact::cover_exact`] does.
    pub fn spans(
        &self,
        corners: &FreeCorners,
        bounds: PixelRect,
        emit: &mut dyn FnMut(Span),
    ) -> Decisions {
        let px = corners.px();
        match self {
            Self::PlainF64 => by_sign(px, bounds, e_f64, top_left, emit),
            Self::PlainF32 => by_sign(px, bounds, e_f32, top_left, emit),
            Self::FilterTooSmall => by_sign(px, bounds, e_filtered, top_left, emit),
            Self::InclusiveTies => by_sign(px, bounds, e_exact, |_, _| true, emit),
            Self::BottomRightTies => {
                by_sign(px, bounds, e_exact, |a, b| !top_left(a, b), emit);
            }
            Self::PlainCrossing => by_crossing(px, bounds, emit),
            Self::SnapsInside => {
                // Corners that cannot be snapped draw nothing.
                let snapped = px.map_array(|[x, y]| SubpixelPoint::from_px(x, y));
                if let [Ok(a), Ok(b), Ok(c)] = snapped {
                    Scanline.cover([a, b, c], bounds, emit);
                }
            }
            Self::FlushesToZero => {
                // As a processor does in a mode in which the smallest numbers are 0.
                let flush = |v: f64| if v.abs() < f64::from(f32::MIN_POSITIVE) { 0.0 } else { v };
                if let Ok(flushed) =
                    FreeCorners::new(px.map_array(|corner| corner.map_array(flush)))
                {
                    return EdgeFunctionExact.cover_exact(&flushed, bounds, emit);
                }
            }
        }
        Decisions::default()
    }
}

type Point = [f64; 2];

/// The edge function as f64 computes it, with an error that may have the wrong sign.
fn e_f64(a: Point, b: Point, p: Point) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// The same in f32, in which already the coordinates are rounded.
fn e_f32(a: Point, b: Point, p: Point) -> f64 {
    let [a, b, p] = [a, b, p].map_array(|point| point.map_array(|v| v as f32));
    f64::from((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]))
}

/// The edge function by floats where they seem to be sure: the bound is a thousandth of the one that holds.
fn e_filtered(a: Point, b: Point, p: Point) -> f64 {
    let (left, right) = ((b[0] - a[0]) * (p[1] - a[1]), (b[1] - a[1]) * (p[0] - a[0]));
    // The sum of both products bounds the rounding of their difference.
    let bound = 5e-3 * (f64::EPSILON / 2.0) * (left.abs() + right.abs());
    if (left - right).abs() > bound { left - right } else { e_exact(a, b, p) }
}

/// A number whose sign is that of the exact edge function; its size is not exact.
fn e_exact(a: Point, b: Point, p: Point) -> f64 {
    let coord = |[x, y]: Point| robust::Coord { x, y };
    robust::orient2d(coord(a), coord(b), coord(p))
}

/// Whether an edge, with the inside to its right, is a left or a top one.
fn top_left(a: Point, b: Point) -> bool {
    b[1] < a[1] || (b[1] == a[1] && b[0] > a[0])
}

/// Tests each sample of the window by the sign of `e` and, where that is zero, by `owns`.
fn by_sign(
    [a, mut b, mut c]: [Point; 3],
    bounds: PixelRect,
    e: fn(Point, Point, Point) -> f64,
    owns: fn(Point, Point) -> bool,
    emit: &mut dyn FnMut(Span),
) {
    match e(a, b, c).partial_cmp(&0.0) {
        Some(Ordering::Greater) => {}
        Some(Ordering::Less) => (b, c) = (c, b),
        _ => return,
    }
    let inside = |x_px, y_px| {
        let p = [f64::from(x_px) + 0.5, f64::from(y_px) + 0.5];
        let mut is_inside = true;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let side = e(from, to, p);
            is_inside &= side > 0.0 || (side == 0.0 && owns(from, to));
        }
        is_inside
    };
    each_sample(bounds, &inside, emit);
}

/// Tests each sample by the parity of crossings that floats compute.
fn by_crossing(corners: [Point; 3], bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
    for y_px in bounds.y0..bounds.y1 {
        let y = f64::from(y_px) + 0.5;
        let mut crossings: Vec<f64> = Vec::new();
        for i in 0..3 {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            if (a[1] <= y) != (b[1] <= y) {
                crossings.push(a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]));
            }
        }
        for x_px in bounds.x0..bounds.x1 {
            let x = f64::from(x_px) + 0.5;
            if crossings.iter().filter(|crossing| **crossing <= x).count() % 2 == 1 {
                emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
            }
        }
    }
}
