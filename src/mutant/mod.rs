//! Mutants: engines with a planted fault each, to prove that the harness can fail.
//!
//! A mutant is a small type behind the same contract, never a flag inside an engine. Those of
//! coverage test samples one by one with a rule that is wrong in one way; those of values take an
//! engine's fragments and spoil them the way real code goes wrong. Reached by the hidden option
//! `--plant NAME` and by the tests.

pub mod exact;

use crate::contract::{DrawLine, Interpolate, Rasterize};
use crate::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use crate::line::bresenham::Bresenham;
use crate::raster::{edge_function::EdgeFunction, scanline::Scanline};
use crate::triangle::{Corners, Fragment, ScreenLine, ScreenTriangle, Span, Varying};

/// A rasterizer with a planted fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TriangleMutant {
    /// Samples on any edge belong (SYSU assignment 2: `<= 0`).
    InclusiveEdges,
    /// Samples on no edge belong (GAMES101 homework 2: `> 0`).
    ExclusiveEdges,
    /// Bottom and right edges belong instead of top and left ones.
    BottomRightRule,
    /// Left edges belong, top edges do not.
    LeftOnlyRule,
    /// Samples lie half a subpixel-step off: at the pixel's corner plus 127/256.
    SampleOffByOneSubpixel,
    /// The first row of every triangle is lost.
    DropsFirstRow,
    /// The last pixel of long spans is drawn twice.
    DoublesSpanEnd,
    /// Counter-clockwise triangles are lost, as if culled.
    CullsOneWinding,
    /// Edge functions wrap around in 32 bits.
    WrapsInI32,
    /// The last two weights are swapped.
    SwappedWeights,
    /// Attributes are interpolated affinely, w ignored.
    AffineAttributes,
    /// The depth is interpolated perspective-correctly, as if it were an attribute.
    PerspectiveDepth,
    /// Values are taken at the pixel's corner instead of its centre.
    ValuesAtCorner,
    /// Values are rounded to f32 on the way.
    ValuesThroughF32,
    /// Panics on a flat bottom.
    PanicsOnFlatBottom,
    /// Draws one pixel outside the window.
    LeavesWindow,
}

impl TriangleMutant {
    /// Every mutant.
    pub const ALL: [Self; 16] = [
        Self::InclusiveEdges,
        Self::ExclusiveEdges,
        Self::BottomRightRule,
        Self::LeftOnlyRule,
        Self::SampleOffByOneSubpixel,
        Self::DropsFirstRow,
        Self::DoublesSpanEnd,
        Self::CullsOneWinding,
        Self::WrapsInI32,
        Self::SwappedWeights,
        Self::AffineAttributes,
        Self::PerspectiveDepth,
        Self::ValuesAtCorner,
        Self::ValuesThroughF32,
        Self::PanicsOnFlatBottom,
        Self::LeavesWindow,
    ];

    /// Its name for `--plant`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::InclusiveEdges => "inclusive-edges",
            Self::ExclusiveEdges => "exclusive-edges",
            Self::BottomRightRule => "bottom-right-rule",
            Self::LeftOnlyRule => "left-only-rule",
            Self::SampleOffByOneSubpixel => "sample-off-by-one-subpixel",
            Self::DropsFirstRow => "drops-first-row",
            Self::DoublesSpanEnd => "doubles-span-end",
            Self::CullsOneWinding => "culls-one-winding",
            Self::WrapsInI32 => "wraps-in-i32",
            Self::SwappedWeights => "swapped-weights",
            Self::AffineAttributes => "affine-attributes",
            Self::PerspectiveDepth => "perspective-depth",
            Self::ValuesAtCorner => "values-at-corner",
            Self::ValuesThroughF32 => "values-through-f32",
            Self::PanicsOnFlatBottom => "panics-on-flat-bottom",
            Self::LeavesWindow => "leaves-window",
        }
    }
}

impl Rasterize for TriangleMutant {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
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
                Scanline.cover(corners, bounds, |span| {
                    if span.y_px != *first.get_or_insert(span.y_px) {
                        emit(span);
                    }
                });
            }
            Self::DoublesSpanEnd => Scanline.cover(corners, bounds, |span| {
                emit(span);
                if span.x1_px - span.x0_px > 8 {
                    emit(Span { x0_px: span.x1_px - 1, ..span });
                }
            }),
            Self::CullsOneWinding => {
                if cross(corners) > 0 {
                    Scanline.cover(corners, bounds, emit);
                }
            }
            Self::WrapsInI32 => wrapping(corners, bounds, emit),
            Self::PanicsOnFlatBottom => {
                let lowest = corners.map(|corner| corner.y).into_iter().max();
                let on_it = corners.iter().filter(|corner| Some(corner.y) == lowest).count();
                assert!(on_it != 2, "planted: slope of a flat edge");
                Scanline.cover(corners, bounds, emit);
            }
            Self::LeavesWindow => Scanline.cover(corners, bounds, |span| {
                emit(Span { x1_px: span.x1_px + i32::from(span.x1_px == bounds.x1), ..span });
            }),
            _ => EdgeFunction.cover(corners, bounds, emit),
        }
    }
}

impl Interpolate for TriangleMutant {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let mut spoilt = *triangle;
        match self {
            Self::SwappedWeights => {
                let [_, b, c] = &triangle.vertices;
                (spoilt.vertices[1].varying, spoilt.vertices[2].varying) = (c.varying, b.varying);
            }
            Self::AffineAttributes => {
                spoilt.vertices.iter_mut().for_each(|vertex| vertex.inv_w = 1.0);
            }
            Self::ValuesAtCorner => {
                // A triangle moved by half a pixel shows at each centre what was at the corner;
                // its outermost pixels are not covered and keep their values.
                spoilt.vertices.iter_mut().for_each(|vertex| {
                    vertex.position.x = vertex.position.x.saturating_add(HALF_PIXEL);
                });
                let mut moved = std::collections::HashMap::new();
                Scanline.fragments(&spoilt, bounds, |f| {
                    moved.insert((f.x_px, f.y_px), f);
                });
                EdgeFunction.fragments(triangle, bounds, |f| {
                    emit(moved.get(&(f.x_px, f.y_px)).copied().unwrap_or(f));
                });
                return;
            }
            Self::PerspectiveDepth => {
                // The depth is carried along as a varying of its own.
                let depths = ScreenTriangle {
                    vertices: triangle.vertices.map(|v| crate::triangle::ScreenVertex {
                        position: v.position,
                        depth: v.depth,
                        inv_w: v.inv_w,
                        varying: v.depth,
                    }),
                };
                let mut wrong = Vec::new();
                EdgeFunction.fragments(&depths, bounds, |f| wrong.push(f.varying));
                let mut wrong = wrong.into_iter();
                EdgeFunction.fragments(triangle, bounds, |f| {
                    emit(Fragment { depth: wrong.next().unwrap_or(f.depth), ..f });
                });
                return;
            }
            Self::ValuesThroughF32 => {
                EdgeFunction.fragments(triangle, bounds, |f| {
                    let scale = 1.0 + f64::from(f32::EPSILON) / 4.0;
                    let depth = f64::from(f.depth as f32);
                    emit(Fragment { depth, varying: f.varying * scale, ..f });
                });
                return;
            }
            _ => {}
        }
        if matches!(self, Self::SwappedWeights | Self::AffineAttributes) {
            return EdgeFunction.fragments(&spoilt, bounds, emit);
        }
        // Faults of coverage: right values at the wrong pixels.
        self.cover(triangle.corners(), bounds, |span| {
            let row =
                PixelRect { x0: span.x0_px, y0: span.y_px, x1: span.x1_px, y1: span.y_px + 1 };
            EdgeFunction.fragments(triangle, row, &mut emit);
        });
    }
}

/// Twice the signed area.
fn cross([a, b, c]: Corners) -> i128 {
    let [ax, ay, bx, by, cx, cy] = [a.x, a.y, b.x, b.y, c.x, c.y].map(i128::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

/// Tests each sample against three edges; `owns` says for an edge (dx, dy), inside to its right,
/// whether samples on it belong.
fn by_rule(
    mut corners: Corners,
    bounds: PixelRect,
    sample_shift: i32,
    owns: impl Fn(i128, i128) -> bool,
    mut emit: impl FnMut(Span),
) {
    match cross(corners).signum() {
        0 => return,
        -1 => corners.swap(1, 2),
        _ => {}
    }
    let centre = |px: i32| px.saturating_mul(SUBPIXELS).saturating_add(HALF_PIXEL + sample_shift);
    for y_px in bounds.y0..bounds.y1 {
        for x_px in bounds.x0..bounds.x1 {
            let sample = SubpixelPoint::new(centre(x_px), centre(y_px));
            let inside = [(0, 1), (1, 2), (2, 0)].into_iter().all(|(i, j)| {
                let (a, b) = (corners[i], corners[j]);
                let (dx, dy) =
                    (i128::from(b.x) - i128::from(a.x), i128::from(b.y) - i128::from(a.y));
                let edge = cross([a, b, sample]);
                edge > 0 || (edge == 0 && owns(dx, dy))
            });
            if inside {
                emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
            }
        }
    }
}

/// Edge functions in wrapping 32-bit arithmetic.
fn wrapping(mut corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
    match cross(corners).signum() {
        0 => return,
        -1 => corners.swap(1, 2),
        _ => {}
    }
    let centre = |px: i32| px.wrapping_mul(SUBPIXELS).wrapping_add(HALF_PIXEL);
    for y_px in bounds.y0..bounds.y1 {
        for x_px in bounds.x0..bounds.x1 {
            let inside = [(0, 1), (1, 2), (2, 0)].into_iter().all(|(i, j)| {
                let (a, b) = (corners[i], corners[j]);
                let (dx, dy) = (b.x.wrapping_sub(a.x), b.y.wrapping_sub(a.y));
                let edge = dx
                    .wrapping_mul(centre(y_px).wrapping_sub(a.y))
                    .wrapping_sub(dy.wrapping_mul(centre(x_px).wrapping_sub(a.x)));
                edge > 0 || (edge == 0 && (dy < 0 || (dy == 0 && dx > 0)))
            });
            if inside {
                emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
            }
        }
    }
}

/// A line drawer with a planted fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineMutant {
    /// The last pixel is missing (the book's DrawLine).
    MissesEnd,
    /// A tie is decided by the drawing direction.
    DirectedTies,
    /// The height accumulates in f32 and is rounded.
    DriftsInF32,
    /// The height is truncated instead of rounded.
    Truncates,
    /// Attributes count from the clipped start of the line.
    WeightsFromClip,
    /// Pixels come out from the second end to the first.
    DrawsBackwards,
}

impl LineMutant {
    /// Every mutant.
    pub const ALL: [Self; 6] = [
        Self::MissesEnd,
        Self::DirectedTies,
        Self::DriftsInF32,
        Self::Truncates,
        Self::WeightsFromClip,
        Self::DrawsBackwards,
    ];

    /// Its name for `--plant`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::MissesEnd => "line-misses-end",
            Self::DirectedTies => "line-directed-ties",
            Self::DriftsInF32 => "line-drifts-in-f32",
            Self::Truncates => "line-truncates",
            Self::WeightsFromClip => "line-weights-from-clip",
            Self::DrawsBackwards => "line-draws-backwards",
        }
    }
}

impl DrawLine for LineMutant {
    fn draw<V: Varying>(
        &self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let [a, b] = &line.ends;
        match self {
            Self::MissesEnd => Bresenham.draw(line, bounds, |f| {
                if (f.x_px, f.y_px) != (b.pixel.x, b.pixel.y) {
                    emit(f);
                }
            }),
            Self::DrawsBackwards => {
                let mut fragments = Vec::new();
                Bresenham.draw(line, bounds, |f| fragments.push(f));
                fragments.into_iter().rev().for_each(emit);
            }
            Self::WeightsFromClip => {
                let mut fragments = Vec::new();
                Bresenham.draw(line, bounds, |f| fragments.push(f));
                let last = fragments.len().saturating_sub(1).max(1) as f64;
                for (i, f) in fragments.into_iter().enumerate() {
                    let t = i as f64 / last;
                    let varying = a.varying + (b.varying - a.varying) * t;
                    emit(Fragment { depth: a.depth + (b.depth - a.depth) * t, varying, ..f });
                }
            }
            Self::DirectedTies | Self::DriftsInF32 | Self::Truncates => {
                self.walk_all(line, bounds, emit);
            }
        }
    }
}

impl LineMutant {
    /// Walks every step of a line of at most 2^16 pixels; longer ones are left to Bresenham, so
    /// that a mutant takes no longer than an engine.
    fn walk_all<V: Varying>(
        self,
        line: &ScreenLine<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        let [a, b] = &line.ends;
        let (dx, dy) = (
            i64::from(b.pixel.x) - i64::from(a.pixel.x),
            i64::from(b.pixel.y) - i64::from(a.pixel.y),
        );
        let steps = dx.abs().max(dy.abs());
        if steps == 0 || steps > 1 << 16 {
            return Bresenham.draw(line, bounds, emit);
        }
        let (slope_x, slope_y) = (dx as f32 / steps as f32, dy as f32 / steps as f32);
        let (mut x, mut y) = (a.pixel.x as f32, a.pixel.y as f32);
        for i in 0..=steps {
            let (x_px, y_px) = match self {
                Self::DriftsInF32 => ((x + 0.5).floor() as i32, (y + 0.5).floor() as i32),
                Self::Truncates => {
                    (a.pixel.x + (dx * i / steps) as i32, a.pixel.y + (dy * i / steps) as i32)
                }
                _ => {
                    // Rounds half away from the first end, whichever end that is.
                    let round =
                        |d: i64| (d.signum() * ((2 * d.abs() * i + steps) / (2 * steps))) as i32;
                    (a.pixel.x + round(dx), a.pixel.y + round(dy))
                }
            };
            (x, y) = (x + slope_x, y + slope_y);
            if bounds.contains(x_px, y_px) {
                let t = i as f64 / steps as f64;
                let varying = a.varying + (b.varying - a.varying) * t;
                emit(Fragment { x_px, y_px, depth: a.depth + (b.depth - a.depth) * t, varying });
            }
        }
    }
}
