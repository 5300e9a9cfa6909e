//! Choices of coverage by edge function: every sample of the bounding box against three half-planes,
//! in floats, in integers of a fixed width, and with an exact predicate for each sample.
//!
//! All visit the same samples in the same order: row by row to the first one inside, on to the first
//! one outside, then the next row. The tie rule is right everywhere, E > 0 or E = 0 on a top or left
//! edge; what differs is how well E is known. Two triangles that share an edge see it from opposite
//! ends. In floats that gives two different errors and so holes and double hits, unless both start
//! from the same end ([`Ordered`]).

use std::marker::PhantomData;
use std::ops::Add;

use num_traits::{AsPrimitive, PrimInt, Signed};
use robust::{Coord, orient2d};

use super::{Cover, Real, Work, centre, snap, snappable};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXEL_BITS, SUBPIXELS};
use rasterproof_core::triangle::{Corners, FreeCorners, Span};

/// E once at the first sample, then by additions, to the right and down.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stepped<T>(PhantomData<T>);

/// E = dx (py - ay) - dy (px - ax) at every sample.
#[derive(Clone, Copy, Debug, Default)]
pub struct Direct<T>(PhantomData<T>);

/// As [`Direct`], but E is computed from the edge's smaller end (by y, then x), whichever triangle
/// asks, and its sign turned round where that is the other direction.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ordered<T>(PhantomData<T>);

/// E' = floor((E - bias) / S), set up in integers `T` and stepped in the word `W`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Integer<T, W>(PhantomData<(T, W)>);

/// Shewchuk's `orient2d` at every sample, no filter in front of it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Robust;

/// A point in the arithmetic of a choice.
type PointIn<T> = [T; 2];

/// Whether an edge that runs from `a` to `b` with the inside on its right hand (y down) keeps the
/// samples on it: it goes up, or it is flat and goes right.
#[inline]
fn is_top_left<T: PartialOrd>(a: &PointIn<T>, b: &PointIn<T>) -> bool {
    b[1] < a[1] || (b[1] == a[1] && b[0] > a[0])
}

/// Visits the samples of `rect`: `inside(x, y)` is asked from left to right until it was true and no
/// longer is.
#[inline]
fn visit(
    rect: PixelRect,
    mut inside: impl FnMut(i32, i32) -> bool,
    mut emit: impl FnMut(Span),
) -> Work {
    if rect.is_empty() {
        return Work::default();
    }
    let mut asked = 0;
    for y_px in rect.y0..rect.y1 {
        let mut x_px = rect.x0;
        while x_px < rect.x1 && !inside(x_px, y_px) {
            x_px += 1;
        }
        // Here the first sample inside is found, or the row has none.
        let x0_px = x_px;
        if x0_px == rect.x1 {
            asked += u64::from(rect.width());
            continue;
        }
        x_px += 1;
        while x_px < rect.x1 && inside(x_px, y_px) {
            x_px += 1;
        }
        asked += u64::from((x_px + 1).min(rect.x1).abs_diff(rect.x0));
        emit(Span { y_px, x0_px, x1_px: x_px });
    }
    Work { divisions: 0, evaluations: 3 * asked, fallbacks: 0 }
}

/// As [`visit`] with three functions that are stepped; `outside` decides from their values.
#[inline]
fn visit_stepped<W: Copy + Add<Output = W>>(
    rect: PixelRect,
    mut row: [W; 3],
    right: [W; 3],
    down: [W; 3],
    outside: impl Fn([W; 3]) -> bool,
    mut emit: impl FnMut(Span),
) -> Work {
    if rect.is_empty() {
        return Work::default();
    }
    let add = |a: [W; 3], b: [W; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let mut asked = 0;
    for y_px in rect.y0..rect.y1 {
        let (mut e, mut x_px) = (row, rect.x0);
        while x_px < rect.x1 && outside(e) {
            e = add(e, right);
            x_px += 1;
        }
        let x0_px = x_px;
        while x_px < rect.x1 && !outside(e) {
            e = add(e, right);
            x_px += 1;
        }
        asked += u64::from((x_px + 1).min(rect.x1).abs_diff(rect.x0));
        if x0_px < x_px {
            emit(Span { y_px, x0_px, x1_px: x_px });
        }
        if y_px + 1 < rect.y1 {
            row = add(row, down);
        }
    }
    Work { divisions: 0, evaluations: 3 * asked, fallbacks: 0 }
}

/// The pixels of `bounds` that may have their centre in the bounding box: at most one too many on a
/// side, where a difference rounds.
#[inline]
fn pixel_box<T: Real>(corners: &[PointIn<T>; 3], bounds: PixelRect) -> PixelRect {
    let range = |axis: usize| {
        let [a, b, c] = [corners[0][axis], corners[1][axis], corners[2][axis]];
        let first: i32 = (a.min(b).min(c) - T::HALF).ceil().as_();
        let last: i32 = (a.max(b).max(c) - T::HALF).floor().as_();
        (first, last.saturating_add(1))
    };
    let ((x0, x1), (y0, y1)) = (range(0), range(1));
    PixelRect { x0, y0, x1, y1 }.intersect(&bounds)
}

/// dx (py - ay) - dy (px - ax), of the edge from a to b.
#[inline]
fn side<T: Real>(a: &PointIn<T>, b: &PointIn<T>, p: &PointIn<T>) -> T {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

/// As [`side`], always computed from the smaller end.
#[inline]
fn ordered_side<T: Real>(a: &PointIn<T>, b: &PointIn<T>, p: &PointIn<T>) -> T {
    if a[1] < b[1] || (a[1] == b[1] && a[0] <= b[0]) { side(a, b, p) } else { -side(b, a, p) }
}

/// The corners clockwise on the screen, so that the inside is where E > 0; `None` without an area.
#[inline]
fn clockwise<T: Real>(
    corners: &FreeCorners,
    side: impl Fn(&PointIn<T>, &PointIn<T>, &PointIn<T>) -> T,
) -> Option<[PointIn<T>; 3]> {
    let [a, b, c] = corners.px().map_array(|p| p.map_array(T::of));
    let area = side(&a, &b, &c);
    if area > T::zero() {
        Some([a, b, c])
    } else if area < T::zero() {
        Some([a, c, b])
    } else {
        None
    }
}

/// The three edges, each opposite to the corner of its number.
#[inline]
fn edges<T: Copy>([a, b, c]: [PointIn<T>; 3]) -> [[PointIn<T>; 2]; 3] {
    [[b, c], [c, a], [a, b]]
}

/// Visits the bounding box with three functions that `side` computes at each sample.
#[inline]
fn cover_by<T: Real>(
    corners: &FreeCorners,
    bounds: PixelRect,
    side: impl Fn(&PointIn<T>, &PointIn<T>, &PointIn<T>) -> T,
    emit: impl FnMut(Span),
) -> Option<Work> {
    let Some(corners) = clockwise(corners, &side) else { return Some(Work::default()) };
    let rect = pixel_box(&corners, bounds);
    let edges = edges(corners).map_array(|[a, b]| (a, b, is_top_left(&a, &b)));
    let inside = |x_px: i32, y_px: i32| {
        let p = [centre(x_px), centre(y_px)];
        // Without a branch for each edge, as the stepped choices.
        edges.iter().fold(true, |inside, (a, b, keeps)| {
            let e = side(a, b, &p);
            inside & ((e > T::zero()) | ((e == T::zero()) & *keeps))
        })
    };
    Some(visit(rect, inside, emit))
}

impl<T: Real> Cover for Direct<T> {
    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        cover_by(free, bounds, side::<T>, emit)
    }
}

impl<T: Real> Cover for Ordered<T> {
    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        cover_by(free, bounds, ordered_side::<T>, emit)
    }
}

impl Cover for Robust {
    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        let coord = |p: &PointIn<f64>| Coord { x: p[0], y: p[1] };
        // Expanded, orient2d(a, b, p) is E(p).
        cover_by(free, bounds, |a, b, p| orient2d(coord(a), coord(b), coord(p)), emit)
    }
}

impl<T: Real> Cover for Stepped<T> {
    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        let Some(corners) = clockwise(free, side::<T>) else { return Some(Work::default()) };
        let rect = pixel_box(&corners, bounds);
        let edges = edges(corners);
        let start = [centre(rect.x0), centre(rect.y0)];
        let row = edges.map_array(|[a, b]| side(&a, &b, &start));
        let right = edges.map_array(|[a, b]| a[1] - b[1]);
        let down = edges.map_array(|[a, b]| b[0] - a[0]);
        let keeps = edges.map_array(|[a, b]| is_top_left(&a, &b));
        let outside = |e: [T; 3]| {
            let out = |i: usize| (e[i] < T::zero()) | ((e[i] == T::zero()) & !keeps[i]);
            out(0) | out(1) | out(2)
        };
        Some(visit_stepped(rect, row, right, down, outside, emit))
    }
}

impl<T, W> Integer<T, W>
where
    T: PrimInt + Signed + AsPrimitive<W>,
    W: PrimInt + Signed + 'static,
    i64: AsPrimitive<T> + AsPrimitive<W>,
{
    /// Whether all numbers fit: |E| and one step past the box in `T`, the same divided by S in `W`.
    fn fits(corners: &Corners) -> bool {
        let padded = |v: [i32; 3]| {
            let [a, b, c] = v;
            u128::from(a.max(b).max(c).abs_diff(a.min(b).min(c))) + SUBPIXELS as u128
        };
        let bound = padded(corners.map_array(|p| p.x)) * padded(corners.map_array(|p| p.y));
        let holds = |max: Option<u128>, bound: u128| max.is_none_or(|max| bound <= max);
        holds(T::max_value().to_u128(), bound)
            && holds(W::max_value().to_u128(), bound >> SUBPIXEL_BITS)
    }

    /// Covers a triangle whose numbers [`Self::fits`] has found to fit.
    #[inline]
    fn cover_lattice(corners: &Corners, bounds: PixelRect, emit: impl FnMut(Span)) -> Work {
        let [a, b, c] = corners.map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        let side = |a: &PointIn<i64>, b: &PointIn<i64>, p: &PointIn<i64>| -> T {
            let wide = |v: i64| -> T { v.as_() };
            wide(b[0] - a[0]) * wide(p[1] - a[1]) - wide(b[1] - a[1]) * wide(p[0] - a[0])
        };
        let area = side(&a, &b, &c);
        if area == T::zero() {
            return Work::default();
        }
        let edges = edges(if area > T::zero() { [a, b, c] } else { [a, c, b] });
        let range = |axis: usize| {
            let half = i64::from(HALF_PIXEL);
            let [a, b, c] = [a[axis], b[axis], c[axis]];
            let first = (a.min(b).min(c) + half - 1) >> SUBPIXEL_BITS;
            let end = (a.max(b).max(c) + half) >> SUBPIXEL_BITS;
            (first as i32, end as i32)
        };
        let ((x0, x1), (y0, y1)) = (range(0), range(1));
        let rect = PixelRect { x0, y0, x1, y1 }.intersect(&bounds);
        if rect.is_empty() {
            // The window may lie so far off that E there would not fit.
            return Work::default();
        }
        let start = [rect.x0, rect.y0].map_array(geometry::centre);
        let row = edges.map_array(|[a, b]| -> W {
            let bias = if is_top_left(&a, &b) { T::zero() } else { T::one() };
            // The bias of 1 makes a sample on an edge that does not keep it negative. An arithmetic shift is a floor.
            ((side(&a, &b, &start) - bias) >> SUBPIXEL_BITS as usize).as_()
        });
        let right = edges.map_array(|[a, b]| -> W { (a[1] - b[1]).as_() });
        let down = edges.map_array(|[a, b]| -> W { (b[0] - a[0]).as_() });
        visit_stepped(rect, row, right, down, |[a, b, c]| (a | b | c) < W::zero(), emit)
    }
}

impl<T, W> Cover for Integer<T, W>
where
    T: PrimInt + Signed + AsPrimitive<W>,
    W: PrimInt + Signed + 'static,
    i64: AsPrimitive<T> + AsPrimitive<W>,
{
    fn accepts(&self, free: &FreeCorners, _bounds: PixelRect) -> Result<(), String> {
        if Self::fits(&snappable(free)?) {
            return Ok(());
        }
        let bits = 8 * size_of::<W>();
        Err(format!("a triangle is too large for edge functions of {bits} bits"))
    }

    #[inline]
    fn cover(&self, free: &FreeCorners, bounds: PixelRect, emit: impl FnMut(Span)) -> Option<Work> {
        Some(snap(free).map_or(Work::default(), |c| Self::cover_lattice(&c, bounds, emit)))
    }
}
