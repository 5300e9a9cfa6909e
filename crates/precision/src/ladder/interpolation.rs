//! Choices of interpolation: one attribute at the centres of covered pixels, by the ways that
//! renderers have used, each generic over the float it computes in.
//!
//! Coverage is given, as spans of the exact engine, so that only values differ. Inputs are positions
//! on the lattice, 1/w and the attribute of each vertex. Every type states the bound of its error
//! where one has been derived; `cost` compares with the oracle, and the tests hold each choice to its
//! bound. u is the unit roundoff of the float, M the largest |v| at a vertex, R the ratio of w,
//! A = w(p) / w_min, X the largest |x|, n_x and n_y the steps accumulated, V_x the slope of the value
//! along the row.

use std::marker::PhantomData;

use super::{Real, centre};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry;
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::{Corners, Span};

#[derive(Clone, Copy, Debug)]
pub struct Valued {
    pub corners: Corners,
    /// 1/w of each corner, positive.
    pub inv_w: [f64; 3],
    pub value: [f64; 3],
}

/// A triangle and the rows it covers.
pub struct CoveredTriangle<T> {
    /// Its place in the list of the scene's triangles.
    pub number: usize,
    pub triangle: T,
    pub spans: Vec<Span>,
}

pub trait Values<T = Valued> {
    /// Emits (column, row, value) for each pixel of `spans`, which are the rows of `triangle`.
    fn values(&self, triangle: &T, spans: &[Span], emit: impl FnMut(i32, i32, f64));

    fn paint(&self, drawn: &[CoveredTriangle<T>], target: &mut Frame<f32>) {
        let x0 = target.bounds().x0;
        for CoveredTriangle { triangle, spans, .. } in drawn {
            self.values(triangle, spans, |x_px, y_px, value| {
                target.row_mut(y_px)[(x_px - x0) as usize] = value as f32;
            });
        }
    }
}

macro_rules! choices {
    ($($(#[$about:meta])* $name:ident),* $(,)?) => {$(
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name<T>(PhantomData<T>);
    )*};
}

choices! {
    /// The value as a plane over the screen, w ignored; added up along the row. Off by up to
    /// dv (sqrt R - 1) / (sqrt R + 1), dv being the difference of the values.
    Affine,
    /// Divides at every 16th pixel of a row and goes straight in between, as Quake did (Abrash 1997,
    /// "Graphics Programming Black Book", chapter 70). The bound of [`Affine`] holds for each piece.
    EverySixteen,
    /// Formulas (8) and (9) of the book (section 5.5), t and t' accumulated, both started at the
    /// centre: u ((8 + 3 (n_x + n_y)) M A + (4 + 2 n_y) X |V_x|).
    BookFormula,
    /// 1/w and v/w down the edges, then added up along the row:
    /// u ((8 + 2 n_x) M A + 4 X |V_x|).
    Accumulated,
    /// 1/w and v/w down the edges, then directly at each pixel: u (8 M A + 4 X |V_x|).
    Direct,
    /// 1/w and v/w as planes over the screen from the first vertex; see `cost` for the bound.
    Plane,
    /// v0 + (a1 (v1 - v0) + a2 (v2 - v0)) / (a0 + a1 + a2) with a = E w_min / w and E in exact
    /// integers: u (13 D + M), D the largest difference from v0. No ratio of w, no position.
    Offset,
}

/// A position in pixels; exact in f32 for |x| < 2^15 px.
#[inline]
pub(super) fn position<T: Real>(point: SubpixelPoint) -> [T; 2] {
    let (x, y) = point.to_px();
    [T::of(x), T::of(y)]
}

struct Floats<T> {
    at: [[T; 2]; 3],
    inv_w: [T; 3],
    value: [T; 3],
}

impl<T: Real> Floats<T> {
    #[inline]
    fn new(triangle: &Valued) -> Self {
        Self {
            at: triangle.corners.map_array(position),
            inv_w: triangle.inv_w.map_array(T::of),
            value: triangle.value.map_array(T::of),
        }
    }
}

/// A function that is linear over the screen: f0 at the first vertex, and its slopes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slopes<T> {
    f0: T,
    pub per_x: T,
    pub per_y: T,
}

impl<T: Real> Slopes<T> {
    /// `inv_area` is 1 / 2A of the same corners.
    #[inline]
    pub fn new(at: &[[T; 2]; 3], [f0, f1, f2]: [T; 3], inv_area: T) -> Self {
        let (x1, y1) = (at[1][0] - at[0][0], at[1][1] - at[0][1]);
        let (x2, y2) = (at[2][0] - at[0][0], at[2][1] - at[0][1]);
        let (d1, d2) = (f1 - f0, f2 - f0);
        Self { f0, per_x: (d1 * y2 - d2 * y1) * inv_area, per_y: (d2 * x1 - d1 * x2) * inv_area }
    }

    #[inline]
    pub fn at(&self, dx: T, dy: T) -> T {
        self.f0 + self.per_x * dx + self.per_y * dy
    }
}

#[inline]
pub(super) fn inv_area<T: Real>(at: &[[T; 2]; 3]) -> T {
    let [a, b, c] = at;
    T::one() / ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]))
}

/// The quotient of v/w and 1/w, both as planes over the screen, at the centre of a pixel (x, y).
#[inline]
fn quotient<T: Real>(triangle: &Valued) -> impl Fn(i32, i32) -> T {
    let t = Floats::<T>::new(triangle);
    let inv_area = inv_area(&t.at);
    let over_w = Slopes::new(&t.at, [0, 1, 2].map_array(|i| t.value[i] * t.inv_w[i]), inv_area);
    let inv_w = Slopes::new(&t.at, t.inv_w, inv_area);
    move |x_px, y_px| {
        let (dx, dy) = (centre::<T>(x_px) - t.at[0][0], centre::<T>(y_px) - t.at[0][1]);
        over_w.at(dx, dy) / inv_w.at(dx, dy)
    }
}

impl<T: Real> Values for Affine<T> {
    #[inline]
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let t = Floats::<T>::new(triangle);
        let plane = Slopes::new(&t.at, t.value, inv_area(&t.at));
        for span in spans {
            let (dx, dy) =
                (centre::<T>(span.x0_px) - t.at[0][0], centre::<T>(span.y_px) - t.at[0][1]);
            let mut value = plane.at(dx, dy);
            for x_px in span.x0_px..span.x1_px {
                emit(x_px, span.y_px, value.as_());
                value = value + plane.per_x;
            }
        }
    }
}

impl<T: Real> Values for EverySixteen<T> {
    #[inline]
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let at = quotient::<T>(triangle);
        for span in spans {
            let last = span.x1_px - 1;
            let (mut start, mut value) = (span.x0_px, at(span.x0_px, span.y_px));
            while start < last {
                let end = (start + 16).min(last);
                let next = at(end, span.y_px);
                let step = (next - value) / T::of(f64::from(end - start));
                for x_px in start..end {
                    emit(x_px, span.y_px, value.as_());
                    value = value + step;
                }
                (start, value) = (end, next);
            }
            emit(last, span.y_px, value.as_());
        }
    }
}

impl<T: Real> Values for Plane<T> {
    #[inline]
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let at = quotient::<T>(triangle);
        for span in spans {
            for x_px in span.x0_px..span.x1_px {
                emit(x_px, span.y_px, at(x_px, span.y_px).as_());
            }
        }
    }
}

impl<T: Real> Values for Offset<T> {
    #[inline]
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let [a, b, c] = triangle.corners.map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        let side = |a: [i64; 2], b: [i64; 2], p: [i64; 2]| {
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        };
        // Clockwise, so that every E is positive inside.
        let order = if side(a, b, c) > 0 { [0, 1, 2] } else { [0, 2, 1] };
        let p = order.map_array(|i| [a, b, c][i]);
        let most = triangle.inv_w.map_array(T::of).into_iter().fold(T::zero(), T::max);
        let q = order.map_array(|i| T::of(triangle.inv_w[i]) / most);
        let [v0, v1, v2] = order.map_array(|i| T::of(triangle.value[i]));
        let (d1, d2) = (v1 - v0, v2 - v0);
        let edges = [(1, 2), (2, 0), (0, 1)].map_array(|(i, j)| (p[i], p[j]));
        let right = edges.map_array(|(a, b)| (a[1] - b[1]) * i64::from(SUBPIXELS));
        for span in spans {
            let start = [span.x0_px, span.y_px].map_array(geometry::centre);
            let mut e = edges.map_array(|(a, b)| side(a, b, start));
            for x_px in span.x0_px..span.x1_px {
                let [a0, a1, a2] = [0, 1, 2].map_array(|i| whole::<T>(e[i]) * q[i]);
                let r = T::one() / ((a0 + a1) + a2);
                emit(x_px, span.y_px, (v0 + (a1 * d1 + a2 * d2) * r).as_());
                e = [e[0] + right[0], e[1] + right[1], e[2] + right[2]];
            }
        }
    }
}

/// A whole number as the nearest float, rounded once.
#[inline]
fn whole<T: Real>(value: i64) -> T {
    T::from(value).unwrap_or_else(T::zero)
}

/// An end of a row: where, and what arrives there.
#[derive(Clone, Copy)]
struct End<T> {
    x: T,
    carried: [T; 2],
}

/// The triangle sorted from the top down, with what travels along its edges.
struct Sorted<T> {
    at: [[T; 2]; 3],
    /// First and second thing that is carried: 1/w and v/w, or w and v.
    carried: [[T; 2]; 3],
}

impl<T: Real> Sorted<T> {
    #[inline]
    fn new(triangle: &Valued, carried: impl Fn(T, T) -> [T; 2]) -> Self {
        let height = |i: usize| (triangle.corners[i].y, triangle.corners[i].x);
        let order = geometry::sorted([0, 1, 2], |&i, &j| height(i) > height(j));
        let t = Floats::<T>::new(triangle);
        Self {
            at: order.map_array(|i| t.at[i]),
            carried: order.map_array(|i| carried(t.inv_w[i], t.value[i])),
        }
    }

    /// The two edges that cross the height of row `y_px`, as pairs of corners.
    #[inline]
    fn edges(&self, yc: T) -> [[usize; 2]; 2] {
        [[0, 2], if yc < self.at[1][1] { [0, 1] } else { [1, 2] }]
    }

    /// Both ends of the row at height `yc`, from the left, each computed directly.
    #[inline]
    fn ends(&self, yc: T) -> [End<T>; 2] {
        let [a, b] = self.edges(yc).map_array(|[i, j]| {
            let (p, q) = (self.at[i], self.at[j]);
            let t = (yc - p[1]) / (q[1] - p[1]);
            let along = |from: T, to: T| from + (to - from) * t;
            End {
                x: along(p[0], q[0]),
                carried: [0, 1].map_array(|k| along(self.carried[i][k], self.carried[j][k])),
            }
        });
        if a.x <= b.x { [a, b] } else { [b, a] }
    }
}

impl<T: Real> Values for Direct<T> {
    #[inline]
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let sorted = Sorted::<T>::new(triangle, |inv_w, value| [inv_w, value * inv_w]);
        for span in spans {
            let [left, right] = sorted.ends(centre(span.y_px));
            let width = right.x - left.x;
            for x_px in span.x0_px..span.x1_px {
                let s = (centre::<T>(x_px) - left.x) / width;
                let [inv_w, over_w] = [0, 1]
                    .map_array(|k| left.carried[k] + (right.carried[k] - left.carried[k]) * s);
                emit(x_px, span.y_px, (over_w / inv_w).as_());
            }
        }
    }
}

impl<T: Real> Values for Accumulated<T> {
    #[inline]
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let sorted = Sorted::<T>::new(triangle, |inv_w, value| [inv_w, value * inv_w]);
        for span in spans {
            let [left, right] = sorted.ends(centre(span.y_px));
            let width = right.x - left.x;
            let step = [0, 1].map_array(|k| (right.carried[k] - left.carried[k]) / width);
            let start = centre::<T>(span.x0_px) - left.x;
            let mut now = [0, 1].map_array(|k| left.carried[k] + step[k] * start);
            for x_px in span.x0_px..span.x1_px {
                emit(x_px, span.y_px, (now[1] / now[0]).as_());
                now = [now[0] + step[0], now[1] + step[1]];
            }
        }
    }
}

/// Formulas (8) and (9): the value and w at t between two ends of w and v.
#[inline]
fn formulas<T: Real>([wa, va]: [T; 2], [wb, vb]: [T; 2], t: T) -> [T; 2] {
    let denominator = wb + (wa - wb) * t;
    [wa * wb / denominator, (wb * va + (wa * vb - wb * va) * t) / denominator]
}

/// An edge of the book on its way down: t and x grow by equal steps.
struct BookEdge<T> {
    ends: [usize; 2],
    t: T,
    per_row: T,
    x: T,
    slope: T,
}

impl<T: Real> BookEdge<T> {
    #[inline]
    fn start(sorted: &Sorted<T>, ends: [usize; 2], yc: T) -> Self {
        let (p, q) = (sorted.at[ends[0]], sorted.at[ends[1]]);
        let per_row = T::one() / (q[1] - p[1]);
        let slope = (q[0] - p[0]) * per_row;
        let down = yc - p[1];
        Self { ends, t: down * per_row, per_row, x: p[0] + down * slope, slope }
    }

    #[inline]
    fn step(&mut self) {
        self.t = self.t + self.per_row;
        self.x = self.x + self.slope;
    }

    #[inline]
    fn end(&self, sorted: &Sorted<T>) -> End<T> {
        let [i, j] = self.ends;
        End { x: self.x, carried: formulas(sorted.carried[i], sorted.carried[j], self.t) }
    }
}

impl<T: Real> Values for BookFormula<T> {
    #[inline]
    fn values(&self, triangle: &Valued, spans: &[Span], mut emit: impl FnMut(i32, i32, f64)) {
        let Some(first) = spans.first() else { return };
        let sorted = Sorted::<T>::new(triangle, |inv_w, value| [T::one() / inv_w, value]);
        let mut y_px = first.y_px;
        let mut edges = sorted
            .edges(centre(y_px))
            .map_array(|ends| BookEdge::start(&sorted, ends, centre(y_px)));
        for span in spans {
            while y_px < span.y_px {
                y_px += 1;
                edges.iter_mut().for_each(BookEdge::step);
                let ends = sorted.edges(centre(y_px))[1];
                if ends != edges[1].ends {
                    edges[1] = BookEdge::start(&sorted, ends, centre(y_px));
                }
            }
            let [a, b] = [edges[0].end(&sorted), edges[1].end(&sorted)];
            let [left, right] = if a.x <= b.x { [a, b] } else { [b, a] };
            let step = T::one() / (right.x - left.x);
            let mut t = (centre::<T>(span.x0_px) - left.x) * step;
            for x_px in span.x0_px..span.x1_px {
                emit(x_px, span.y_px, formulas(left.carried, right.carried, t)[1].as_());
                t = t + step;
            }
        }
    }
}
