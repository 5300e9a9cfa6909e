//! The wrong fills that the table names, as functions of the corners in subpixels (1/256 px).
//!
//! # Edge functions
//!
//! The edge from (x0, y0) to (x1, y1) has the function (x1 - x0) (y - y0) - (y1 - y0) (x - x0), which is twice the signed area of the
//! triangle of both ends and the point (x, y). It is positive on one side of the edge and negative on the other. Times the sign of the
//! triangle's own area, it is positive inside for both windings. From (0, 0) to (256, 0), one pixel to the right, the point (128, 128) has
//! 256 x 128 = 32,768: half a square pixel, as there are 65,536 square subpixels in one.

use super::format::rounded;
use crate::convention::{Mask, TriangleConvention, facing};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::{self, centre, twice_area};
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;

pub(super) type Point = [i64; 2];

/// The corners as numbers of 64 bits, in which differences do not overflow.
pub(super) fn points(corners: &Corners) -> [Point; 3] {
    corners.map_array(|c| [i64::from(c.x), i64::from(c.y)])
}

/// A point that came from corners, or from between them: its coordinates fit in 32 bits.
fn narrow([x, y]: Point) -> SubpixelPoint {
    SubpixelPoint::new(x as i32, y as i32)
}

/// Every pixel of the window of whose sample it is true.
pub(super) fn each_sample(
    window: PixelRect,
    [sx, sy]: [i32; 2],
    is_in: &dyn Fn(Point) -> bool,
) -> Mask {
    let mut mask = Mask::default();
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            let at = [i64::from(x) * 256 + i64::from(sx), i64::from(y) * 256 + i64::from(sy)];
            if is_in(at) {
                mask.set(x, y);
            }
        }
    }
    mask
}

/// Whether a pixel lies in the window and is drawn.
pub(super) fn has_within(mask: &Mask, window: PixelRect, [x, y]: [i32; 2]) -> bool {
    window.contains(x, y) && mask.has(x, y)
}

/// The box around the pixels of a window that are drawn; nothing where none is.
pub(super) fn drawn_box(mask: &Mask, window: PixelRect) -> Option<PixelRect> {
    let mut around: Option<PixelRect> = None;
    for y in window.y0..window.y1 {
        let Some([first, end]) = span(mask, window, y) else { continue };
        // Rows come in order, so this one is the lowest so far.
        around = Some(match around {
            None => PixelRect { x0: first, y0: y, x1: end, y1: y + 1 },
            Some(b) => PixelRect { x0: b.x0.min(first), y0: b.y0, x1: b.x1.max(end), y1: y + 1 },
        });
    }
    around
}

/// The first pixel of a row and one past the last; nothing where the row is empty.
fn span(mask: &Mask, window: PixelRect, y: i32) -> Option<[i32; 2]> {
    let mut columns = (window.x0..window.x1).filter(|&x| mask.has(x, y));
    let first = columns.next()?;
    Some([first, columns.next_back().unwrap_or(first) + 1])
}

/// Draws the pixels of a row from one column on and before another, as far as they lie in the window.
fn fill_row(mask: &mut Mask, window: PixelRect, y: i64, from: i64, end: i64) {
    if !(0..i64::from(window.y1)).contains(&y) {
        return;
    }
    let wide = i64::from(window.x1);
    for x in from.clamp(0, wide)..end.clamp(0, wide) {
        mask.set(x as i32, y as i32);
    }
}

/// An edge of a triangle: its function a (x - x0) + b (y - y0) is positive inside, in 1/65536 square pixels.
#[derive(Clone, Copy)]
struct Edge {
    /// The end where it begins.
    from: Point,
    a: i64,
    b: i64,
    /// Whether the rule gives it the samples that lie on it.
    owns: bool,
    /// Whether all products fit in 64 bits, as those of most triangles do.
    is_near: bool,
}

impl Edge {
    /// The edge function at a point.
    fn value(&self, at: Point) -> i128 {
        let [x, y] = [at[0] - self.from[0], at[1] - self.from[1]];
        if self.is_near {
            return i128::from(self.a * x + self.b * y);
        }
        i128::from(self.a) * i128::from(x) + i128::from(self.b) * i128::from(y)
    }

    /// Whether the point lies inside, or on the edge where the rule gives it that.
    fn covers(&self, at: Point) -> bool {
        let value = self.value(at);
        value > 0 || (value == 0 && self.owns)
    }
}

/// The edges of a triangle; one without area is taken for counterclockwise.
fn edges(corners: &Corners, base: &TriangleConvention) -> [Edge; 3] {
    let points = points(corners);
    let sign = if twice_area(corners) > 0 { 1 } else { -1 };
    let is_near = points.as_flattened().iter().all(|v| v.abs() < 1 << 29);
    [0, 1, 2].map_array(|i: usize| {
        let [from, to] = [points[i], points[(i + 1) % 3]];
        let [a, b] = [sign * (from[1] - to[1]), sign * (to[0] - from[0])];
        let owns = match [a, b] {
            // An edge without length faces nowhere.
            [0, 0] => base.ties.edges == [true; 8],
            _ => base.ties.edges[facing(a, b)],
        };
        Edge { from, a, b, owns, is_near }
    })
}

/// Whether a triangle covers a point.
fn covers(edges: &[Edge; 3], at: Point) -> bool {
    edges.iter().all(|edge| edge.covers(at))
}

/// Fills by a test of each edge: its number in the given order, the edge function in 1/65536 square pixels, positive
/// inside, and whether the rule gives it its ties.
pub(super) fn by_edges(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    test: &dyn Fn(usize, i128, bool) -> bool,
) -> Mask {
    let owns = edges(corners, base).map_array(|edge| edge.owns);
    by_all_edges(corners, window, base, &|values| (0..3).all(|i| test(i, values[i], owns[i])))
}

/// The samples whose three edge functions, positive inside, pass a test; none of a triangle without area.
pub(super) fn by_all_edges(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    test: &dyn Fn([i128; 3]) -> bool,
) -> Mask {
    if twice_area(corners) == 0 {
        return Mask::default();
    }
    // All three values, since some tests need them together.
    let [a, b, c] = edges(corners, base);
    let sample = super::sample_of(base);
    each_sample(window, sample, &|at| test([a.value(at), b.value(at), c.value(at)]))
}

/// A number in a word of so many bits, as it wraps around.
pub(super) fn wrap(v: i128, bits: i64) -> i128 {
    let shift = 128 - bits as u32;
    v << shift >> shift
}

/// Words that are too short for edge functions.
pub(super) struct Words {
    /// Bits of fraction that coordinates have.
    pub(super) fraction: i64,
    pub(super) bits: i64,
    /// Whether the winding is not read off such words.
    knows_winding: bool,
    /// Whether the words of the difference of two products are long enough.
    pub(super) products_alone: bool,
}

impl Words {
    /// The digits of a parameter of 'product overflows'.
    pub(super) fn of(p: i64) -> Self {
        Self {
            fraction: p / 100 % 10,
            bits: p % 100,
            knows_winding: p / 1000 % 2 == 1,
            products_alone: p >= 2000,
        }
    }

    /// A point with this many bits of fraction, rounded to the nearest.
    fn point(&self, [x, y]: Point) -> [i128; 2] {
        let unit = 256 >> self.fraction;
        [x, y].map_array(|v| i128::from((v + unit / 2).div_euclid(unit)))
    }

    /// The sum of two products, in a word where sums have one.
    fn sum(&self, v: i128) -> i128 {
        if self.products_alone { v } else { wrap(v, self.bits) }
    }

    /// The edge function from a to b at c: each product wraps around.
    fn cross(&self, [a, b, c]: [[i128; 2]; 3]) -> i128 {
        let first = wrap((b[0] - a[0]) * (c[1] - a[1]), self.bits);
        let second = wrap((b[1] - a[1]) * (c[0] - a[0]), self.bits);
        self.sum(first - second)
    }
}

/// Edge functions in such words.
pub(super) fn wrapping(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let words = Words::of(p);
    let [a, b, c] = points(corners).map_array(|point| words.point(point));
    let area = if words.knows_winding { twice_area(corners) } else { words.cross([a, b, c]) };
    if area == 0 {
        return Mask::default();
    }
    let sign = area.signum();
    // The rule follows from the direction of an edge, which its short coordinates have, too.
    let sides = [[a, b], [b, c], [c, a]].map_array(|[p, q]| {
        let x = (sign * (p[1] - q[1])).signum() as i64;
        let y = (sign * (q[0] - p[0])).signum() as i64;
        ([p, q], (x, y) != (0, 0) && base.ties.edges[facing(x, y)])
    });
    each_sample(window, super::sample_of(base), &|at| {
        let at = words.point(at);
        for ([p, q], owns) in sides {
            let value = words.sum(sign * words.cross([p, q, at]));
            let is_inside = value > 0 || (value == 0 && owns);
            if !is_inside {
                return false;
            }
        }
        true
    })
}

/// Corners in words of so many bits with so many of fraction: wrapped around or clamped.
pub(super) fn in_words(corners: &Corners, clamps: bool, fraction: i64, bits: i64) -> Corners {
    let word = |v: i32| in_word(v.into(), clamps, fraction, bits);
    corners.map_array(|c| SubpixelPoint::new(word(c.x), word(c.y)))
}

/// A coordinate that went through such a word.
fn in_word(v: i64, clamps: bool, fraction: i64, bits: i64) -> i32 {
    // Bits that are lost below the word, and bits that it has below a subpixel.
    // What the word does not hold of the fraction is left as it was: grids have an entry of their own.
    let lost = (8 - fraction).max(0);
    let rest = v & ((1 << lost) - 1);
    let more = (fraction - 8).max(0);
    let scaled = (v >> lost) << more;
    let most = 1_i64 << (bits - 1);
    let kept = match clamps {
        true => scaled.clamp(-most, most - 1),
        false => wrap(scaled.into(), bits) as i64,
    };
    (((kept >> more) << lost) + rest) as i32
}

/// The fan of what lies within the window; corners on its border are put on a grid of `step` subpixels.
pub(super) fn clipped(corners: &Corners, window: PixelRect, step: i64, how: i64) -> Vec<Corners> {
    let mut polygon = points(corners).to_vec();
    // One side of the window after the other cuts off what lies beyond it, as Sutherland and Hodgman do.
    for side in 0..4 {
        let mut kept = Vec::new();
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let [u, v] = [inside_by(from, side, window), inside_by(to, side, window)];
            if u >= 0 {
                kept.push(from);
            }
            if (u < 0) != (v < 0) {
                // In doubles, as programs compute it.
                let part = u as f64 / (u - v) as f64;
                kept.push([0, 1].map_array(|axis| cut_at(from[axis], to[axis], part, step, how)));
            }
        }
        polygon = kept;
    }
    (2..polygon.len()).map(|i| [polygon[0], polygon[i - 1], polygon[i]].map_array(narrow)).collect()
}

/// How far inside a point is from a side of the window: left, right, upper, lower. Negative outside.
fn inside_by(p: Point, side: usize, window: PixelRect) -> i64 {
    match side {
        0 => p[0],
        1 => i64::from(window.x1) * 256 - p[0],
        2 => p[1],
        _ => i64::from(window.y1) * 256 - p[1],
    }
}

/// A coordinate between two ends, brought to a step: by `how` its distance is cut, or it is rounded, or cut down.
fn cut_at(from: i64, to: i64, part: f64, step: i64, how: i64) -> i64 {
    let (start, along, step) = (from as f64, part * (to - from) as f64, step as f64);
    let cut = match how {
        0 => start + (along / step).trunc() * step,
        1 => ((start + along) / step).round() * step,
        _ => ((start + along) / step).floor() * step,
    };
    cut as i64
}

/// The corners from top to bottom.
pub(super) fn sorted(corners: &Corners) -> [Point; 3] {
    geometry::sorted(points(corners), |a, b| a[1] > b[1])
}

/// The row of the first sample below the middle corner.
pub(super) fn middle_row(corners: &Corners) -> i64 {
    (sorted(corners)[1][1] + 127).div_euclid(256)
}

/// The pixels that programs look at around a triangle: from the first column to the last and from the first row to the last.
/// The last ones hold the largest coordinates, or these are rounded up; or the ends are rounded to samples.
pub(super) fn boxes(corners: &Corners) -> [[[i64; 2]; 2]; 3] {
    [(0, 0), (0, 255), (127, -129)].map_array(|(first, last)| {
        [xs(corners), ys(corners)].map_array(|values| {
            let [least, most] = ends_of(values).map_array(i64::from);
            [(least + first).div_euclid(256), (most + last).div_euclid(256)]
        })
    })
}

/// The two halves, where the point on the long edge is put on a grid.
pub(super) fn split(corners: &Corners, step: i32, down: bool) -> Vec<Corners> {
    let [top, middle, bottom] = sorted(corners);
    let high = bottom[1] - top[1];
    if high == 0 || middle[1] == top[1] || middle[1] == bottom[1] {
        return vec![*corners];
    }
    // The x of the long edge there is the fraction `part / (high * step)`, in steps.
    let step = i128::from(step);
    let whole = i128::from(high) * step;
    let part = i128::from(bottom[0] - top[0]) * i128::from(middle[1] - top[1])
        + i128::from(top[0]) * i128::from(high);
    let x = match down {
        true => part.div_euclid(whole),
        false => (2 * part + whole).div_euclid(2 * whole),
    };
    let cut = [(x * step) as i64, middle[1]];
    vec![[top, middle, cut].map_array(narrow), [middle, cut, bottom].map_array(narrow)]
}

/// Something that is measured of triangles.
pub(super) struct Metric {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    /// Twice an area in 1/65536 square pixels, or a length in subpixels.
    pub(super) of: fn(&Corners) -> i64,
}

impl Metric {
    const fn new(name: &'static str, unit: &'static str, of: fn(&Corners) -> i64) -> Self {
        Self { name, unit, of }
    }
}

/// All that is measured: sizes first, and coordinates after them.
pub(super) const METRICS: [Metric; 9] = [
    Metric::new("area", "square px", largest_area),
    Metric::new("width", "px", width),
    Metric::new("height", "px", height),
    Metric::new("longer side", "px", |corners| width(corners).max(height(corners))),
    Metric::new("shorter side", "px", |corners| width(corners).min(height(corners))),
    Metric::new("ratio of twice the area to the square of the longest side", "", thinness),
    Metric::new("farthest coordinate", "px", |c| farthest(xs(c)).max(farthest(ys(c)))),
    Metric::new("farthest x", "px", |corners| farthest(xs(corners))),
    Metric::new("farthest y", "px", |corners| farthest(ys(corners))),
];
/// Places in [`METRICS`]: the longer side; the first that is a coordinate, where those before it are sizes; and the ratio, which
/// is no size and is counted in so many parts.
pub(super) const LONGER_SIDE: usize = 3;
pub(super) const FARTHEST: usize = 6;
pub(super) const RATIO: usize = 5;
pub(super) const RATIOS: i64 = 1 << 20;

/// One of [`METRICS`] of a triangle.
pub(super) fn metric(corners: &Corners, which: usize) -> i64 {
    (METRICS[which].of)(corners)
}

/// Twice the area, or what limits can still be computed from where that is larger.
fn largest_area(corners: &Corners) -> i64 {
    i64::try_from(twice_area(corners).abs()).unwrap_or(i64::MAX / 32)
}

/// Twice the area over the square of the longest side, in parts of [`RATIOS`].
fn thinness(corners: &Corners) -> i64 {
    let points = points(corners);
    let mut longest = 1.0_f64;
    for (i, from) in points.iter().enumerate() {
        let to = points[(i + 1) % 3];
        let [dx, dy] = [0, 1].map_array(|axis| to[axis] as f64 - from[axis] as f64);
        longest = longest.max(dx.powi(2) + dy.powi(2));
    }
    (twice_area(corners).abs() as f64 / longest * RATIOS as f64) as i64
}

/// In subpixels, as all lengths here.
fn width(corners: &Corners) -> i64 {
    extent(xs(corners))
}

fn height(corners: &Corners) -> i64 {
    extent(ys(corners))
}

/// The first coordinates of the corners.
pub(super) fn xs(corners: &Corners) -> [i32; 3] {
    corners.map_array(|c| c.x)
}

/// The second coordinates of the corners.
pub(super) fn ys(corners: &Corners) -> [i32; 3] {
    corners.map_array(|c| c.y)
}

/// The least of three numbers and the largest.
pub(super) fn ends_of([a, b, c]: [i32; 3]) -> [i32; 2] {
    [a.min(b).min(c), a.max(b).max(c)]
}

/// The length that three coordinates span.
pub(super) fn extent(of: [i32; 3]) -> i64 {
    let [least, most] = ends_of(of).map_array(i64::from);
    most - least
}

/// The largest distance of three coordinates from 0.
pub(super) fn farthest(of: [i32; 3]) -> i64 {
    let [least, most] = ends_of(of).map_array(i64::from);
    least.abs().max(most.abs())
}

/// `value / of` with three digits that count.
pub(super) fn decimal(value: i64, of: i64) -> String {
    let number = value as f64 / of as f64;
    let digits =
        if number == 0.0 { 0 } else { (2 - number.abs().log10().floor() as i32).clamp(0, 6) };
    let text = format!("{number:.*}", digits as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Whether it has a level edge, and whether that is the upper one.
pub(super) fn flat(corners: &Corners) -> Option<bool> {
    let [top, middle, bottom] = sorted(corners);
    match (top[1] == middle[1], middle[1] == bottom[1]) {
        (true, false) => Some(true),
        (false, true) => Some(false),
        _ => None,
    }
}

/// Positive where the middle corner lies right of the long edge; 0 where an edge is level.
pub(super) fn middle_side(corners: &Corners) -> i64 {
    let [top, middle, bottom] = sorted(corners);
    if top[1] == middle[1] || middle[1] == bottom[1] { 0 } else { side_of_long(corners) }
}

/// The same where an edge is level: of two corners at one height, the one that is named first comes first.
pub(super) fn side_of_long(corners: &Corners) -> i64 {
    // The corners in this order turn clockwise where the middle one lies right.
    twice_area(&sorted(corners).map_array(narrow)).signum() as i64
}

/// Whether a corner lies in the window or on its border.
pub(super) fn holds(window: PixelRect, corner: SubpixelPoint) -> bool {
    (0..=window.x1 * 256).contains(&corner.x) && (0..=window.y1 * 256).contains(&corner.y)
}

/// See `ENDS` of the table.
pub(super) fn ends(mask: &mut Mask, _: &Corners, window: PixelRect, which: i64) {
    let full = *mask;
    let has = |x: i32, y: i32| has_within(&full, window, [x, y]);
    let Some(PixelRect { x0: left, y0: top, x1, y1 }) = drawn_box(mask, window) else { return };
    let [right, bottom] = [x1 - 1, y1 - 1];
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            let is_drawn = full.has(x, y);
            let stays = match which {
                0 => is_drawn && y != top,
                1 => is_drawn && y != bottom,
                2 => is_drawn && has(x - 1, y),
                3 => is_drawn && has(x + 1, y),
                4 => is_drawn && x != left,
                5 => is_drawn && x != right,
                // The others draw more than is right.
                6 => is_drawn || has(x - 1, y),
                7 => is_drawn || has(x + 1, y),
                8 => is_drawn || (y == bottom + 1 && has(x, y - 1)),
                _ => is_drawn || (y == top - 1 && has(x, y + 1)),
            };
            mask.put(x, y, stays);
        }
    }
}

/// Removes the first or last row, or the first or last column, of the window.
pub(super) fn without_border(mask: &mut Mask, window: PixelRect, which: i64) {
    mask.retain(window, &|x, y| match which {
        0 => y > 0,
        1 => y < window.y1 - 1,
        2 => x > 0,
        _ => x < window.x1 - 1,
    });
}

/// What tests of tiles look at: the right picture, and the edges of the triangle.
struct TileTest {
    /// The picture without the mistake.
    full: Mask,
    window: PixelRect,
    points: [Point; 3],
    /// The sign of the area.
    sign: i64,
    /// The side of a tile, in pixels.
    side: i32,
}

impl TileTest {
    /// Whether a pixel is drawn, or beyond the window the last one before it.
    fn has(&self, [x, y]: [i32; 2]) -> bool {
        self.full.has(x.min(self.window.x1 - 1), y.min(self.window.y1 - 1))
    }

    /// The corners of a tile, or of its pixels where one is left out of the side.
    fn corners([x, y]: [i32; 2], side: i32) -> [[i32; 2]; 4] {
        [[x, y], [x + side, y], [x, y + side], [x + side, y + side]]
    }

    /// The pixels at the corners of a tile.
    fn corner_pixels(&self, at: [i32; 2]) -> [[i32; 2]; 4] {
        Self::corners(at, self.side - 1)
    }

    /// Whether no edge has the upper left corner of a pixel farther outside than this.
    fn reaches(&self, [x, y]: [i32; 2], most_px: f64) -> bool {
        let sign = self.sign as f64;
        (0..3).all(|i| {
            let ([ax, ay], [bx, by]) = (self.points[i], self.points[(i + 1) % 3]);
            let [dx, dy] = [(bx - ax) as f64, (by - ay) as f64];
            let [px, py] = [i64::from(x) * 256 - ax, i64::from(y) * 256 - ay];
            let value = sign * (dx * py as f64 - dy * px as f64);
            value >= -most_px * 256.0 * (dx * dx + dy * dy).sqrt()
        })
    }

    /// Whether no edge has outside the corner pixel that lies farthest in, or in x or y farthest out.
    fn is_inside(&self, [x, y]: [i32; 2], is_out: [bool; 2]) -> bool {
        (0..3).all(|i| {
            let ([ax, ay], [bx, by]) = (self.points[i], self.points[(i + 1) % 3]);
            let [dx, dy] = [self.sign * (bx - ax), self.sign * (by - ay)].map_array(i128::from);
            let far_x = if (dy < 0) != is_out[0] { self.side - 1 } else { 0 };
            let far_y = if (dx > 0) != is_out[1] { self.side - 1 } else { 0 };
            let [px, py] = [centre(x + far_x) - ax, centre(y + far_y) - ay].map_array(i128::from);
            dx * py - dy * px >= 0
        })
    }

    /// Whether a sample is covered, of which nothing is known of edges beyond the window.
    fn covers(&self, [x, y]: [i32; 2]) -> bool {
        if self.window.contains(x, y) {
            return self.full.has(x, y);
        }
        let [px, py] = [centre(x), centre(y)];
        (0..3).all(|i| {
            let ([ax, ay], [bx, by]) = (self.points[i], self.points[(i + 1) % 3]);
            let first = (bx - ax) as f64 * (py - ay) as f64;
            let second = (by - ay) as f64 * (px - ax) as f64;
            self.sign as f64 * (first - second) > 0.0
        })
    }

    /// Whether one of the tests that the table names lets a tile be drawn.
    fn is_kept(&self, test: i64, at: [i32; 2]) -> bool {
        let [x, y] = at;
        let middle = [x + self.side / 2, y + self.side / 2];
        let pixels = self.corner_pixels(at);
        match test {
            0 => pixels.iter().any(|at| self.has(*at)),
            1 => self.has(middle),
            3 => Self::corners(at, self.side).iter().any(|at| self.reaches(*at, 0.0)),
            4 => self.reaches(middle, f64::from(self.side) / 2.0),
            5 => self.reaches(at, 0.0),
            // Only its last column is lost, if any.
            6 => false,
            7 => pixels.iter().any(|at| has_within(&self.full, self.window, *at)),
            8 => self.is_inside(at, [true, true]),
            9 => self.is_inside(at, [true, false]),
            10 => self.is_inside(at, [false, true]),
            11 => self.covers(middle) || pixels.iter().any(|at| self.covers(*at)),
            12 | 13 => pixels.iter().all(|at| self.covers(*at)),
            14 => x + self.side <= self.window.x1 && y + self.side <= self.window.y1,
            _ => self.has(at),
        }
    }

    /// The last column of the triangle in a tile; none where the tile is full or empty.
    fn last_column(&self, tile: PixelRect) -> Option<i32> {
        // The last column that has a pixel is the one seen last.
        let mut last = None;
        let mut is_full = true;
        for x in tile.x0..tile.x1 {
            for y in tile.y0..tile.y1 {
                match self.full.has(x, y) {
                    true => last = Some(x),
                    false => is_full = false,
                }
            }
        }
        last.filter(|_| !is_full)
    }
}

/// Tiles of p mod 100 pixels, by one of the tests that the table names.
pub(super) fn tiles(mask: &mut Mask, corners: &Corners, window: PixelRect, p: i64) {
    let (test, side) = (p / 100, (p % 100) as i32);
    let sign = twice_area(corners).signum() as i64;
    let tiles = TileTest { full: *mask, window, points: points(corners), sign, side };
    for y in (window.y0..window.y1).step_by(side as usize) {
        for x in (window.x0..window.x1).step_by(side as usize) {
            if tiles.is_kept(test, [x, y]) {
                continue;
            }
            let mut lost = PixelRect {
                x0: x,
                y0: y,
                x1: (x + side).min(window.x1),
                y1: (y + side).min(window.y1),
            };
            // Some programs lose a column or a row of the tile alone.
            match test {
                6 => match tiles.last_column(lost) {
                    Some(last) => (lost.x0, lost.x1) = (last, last + 1),
                    None => continue,
                },
                12 => lost.x0 = x + side - 1,
                13 => lost.y0 = y + side - 1,
                _ => {}
            }
            for y in lost.y0..lost.y1 {
                for x in lost.x0..lost.x1 {
                    mask.put(x, y, false);
                }
            }
        }
    }
}

/// A number with so many bits after its first one; the rest is cut off, or rounded to the nearest, halves to even.
pub(super) fn shortened(v: i32, bits: i64, is_cut: bool) -> i32 {
    let size = v.unsigned_abs();
    let rest = (32 - size.leading_zeros()).saturating_sub(bits as u32 + 1);
    let (kept, left) = (i64::from(size >> rest), i64::from(size) % (1 << rest) * 2);
    let up = !is_cut && (left > 1 << rest || (left == 1 << rest && kept % 2 == 1));
    ((kept + i64::from(up)) << rest) as i32 * v.signum()
}

/// Blocks that are drawn wholly or not at all: p mod 5 and p / 5 mod 5 are the powers of two of their sides, and p / 25 is the
/// place that decides: the sample of the first pixel, the middle, the sample of the last pixel, or any sample. With 4 they are
/// drawn wholly where three of their corner pixels are covered, and else pixel by pixel.
pub(super) fn blocks(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let (wide, high, place) = (1 << (p % 5), 1 << (p / 5 % 5), p / 25);
    let mut mask = Mask::default();
    // A block of one pixel is right, and one of a row or a column has no four corners.
    if twice_area(corners) == 0 || wide.max(high) == 1 || (place == 4 && wide.min(high) == 1) {
        return mask;
    }
    let edges = edges(corners, base);
    // The sample of a pixel, inside the triangle or not.
    let [sx, sy] = super::sample_of(base).map_array(i64::from);
    let of = |x: i64, y: i64| covers(&edges, [x * 256 + sx, y * 256 + sy]);
    // Blocks begin at multiples of their sides, so the first ones may begin before the window.
    let begin_y = i64::from(window.y0).div_euclid(high) * high;
    let begin_x = i64::from(window.x0).div_euclid(wide) * wide;
    for y in (begin_y..i64::from(window.y1)).step_by(high as usize) {
        for x in (begin_x..i64::from(window.x1)).step_by(wide as usize) {
            let [right, bottom] = [x + wide - 1, y + high - 1];
            let is_drawn = match place {
                0 => of(x, y),
                1 => covers(&edges, [x * 256 + wide * 128, y * 256 + high * 128]),
                2 => of(right, bottom),
                3 => (y..=bottom).any(|y| (x..=right).any(|x| of(x, y))),
                _ => {
                    let corners = [[x, y], [right, y], [x, bottom], [right, bottom]];
                    corners.iter().filter(|[x, y]| of(*x, *y)).count() >= 3
                }
            };
            if !is_drawn && place != 4 {
                continue;
            }
            for y in y..(y + high).min(window.y1.into()) {
                for x in x..(x + wide).min(window.x1.into()) {
                    if is_drawn || of(x, y) {
                        mask.set(x as i32, y as i32);
                    }
                }
            }
        }
    }
    mask
}

/// Groups of 2, 4, 8 or 16 pixels, by p mod 4; see the table.
pub(super) fn groups(mask: &mut Mask, corners: &Corners, window: PixelRect, p: i64) {
    let (n, kind) = (2 << (p % 4), p / 4);
    // The box around the triangle, as far as the window shows it, and where its last whole groups end.
    let [columns, rows] = boxes(corners)[0];
    let [x0, x1] = shown(columns, window.x1);
    let [y0, y1] = shown(rows, window.y1);
    let whole_rows = y0 + (y1 - y0).max(0) / n * n;
    for y in window.y0..window.y1 {
        let Some([first, end]) = span(mask, window, y) else { continue };
        let [start, stop] = match kind {
            0 => [first, first + (end - first) / n * n],
            1 => [(first + n - 1) / n * n, end],
            2 => [first, end / n * n],
            3 => [first, x0 + (x1 - x0).max(0) / n * n],
            4 => [(x0 + n - 1) / n * n, end],
            5 => [first, window.x1 / n * n],
            6 => [first, first + (end - first + n - 1) / n * n],
            7 => [first / n * n, (end + n - 1) / n * n],
            8 if y >= whole_rows => [end, end],
            9 if y >= window.y1 / n * n => [end, end],
            10 => [first, x0 / n * n + (x1 - x0 / n * n).max(0) / n * n],
            11 => [first / n * n, end / n * n],
            _ => [first, end],
        };
        let is_added = matches!(kind, 6 | 7 | 11);
        for x in window.x0..window.x1 {
            mask.put(x, y, start <= x && x < stop && (is_added || mask.has(x, y)));
        }
    }
}

/// From the first column or row to one past the last, as far as they lie before the end of the window.
fn shown([first, last]: [i64; 2], end: i32) -> [i32; 2] {
    let end = i64::from(end);
    [first.clamp(0, end) as i32, (last + 1).clamp(0, end) as i32]
}

/// Sets of neighbours of a pixel, and how they are said.
pub(super) const NEIGHBOURS: [(&[[i32; 2]], &str); 4] = [
    (&BESIDE, "its four neighbours"),
    (
        &[[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]],
        "its eight neighbours",
    ),
    (&[[1, 0], [-1, 0]], "the pixels left and right of it"),
    (&[[0, 1], [0, -1]], "the pixels above and below it"),
];
/// The steps to the pixels that share a side with one.
pub(super) const BESIDE: [[i32; 2]; 4] = [[1, 0], [-1, 0], [0, 1], [0, -1]];

/// Pixels of which any neighbour is covered, or without those of which any is not; see the table.
pub(super) fn grown(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let mut grown = base.mask(corners, window).unwrap_or_default();
    for [x, y] in NEIGHBOURS[(p / 2) as usize].0 {
        // The neighbour of a pixel is covered where the triangle, moved the other way, covers the pixel.
        let beside = base.mask(&moved(corners, [-256 * x, -256 * y]), window).unwrap_or_default();
        if p % 2 == 0 {
            grown.add(&beside);
        } else {
            grown = grown.shared(&beside);
        }
    }
    grown
}

/// A triangle moved by so many subpixels.
fn moved(corners: &Corners, [x, y]: [i32; 2]) -> Corners {
    corners.map_array(|c| SubpixelPoint::new(c.x.saturating_add(x), c.y.saturating_add(y)))
}

/// Every second row or column by a sample of its own; see the table.
pub(super) fn alternating(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    let [which, way, far] = [p % 4, p / 4 % 4, p / 16];
    // The other picture is right for a triangle that is moved the other way than the samples.
    let by = BESIDE[way as usize].map_array(|v| v * (128 << far));
    let mut mask = base.mask(corners, window).unwrap_or_default();
    let other = base.mask(&moved(corners, by), window).unwrap_or_default();
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            let number = if which < 2 { y } else { x };
            if i64::from(number % 2) == which % 2 {
                mask.put(x, y, other.has(x, y));
            }
        }
    }
    mask
}

/// What a search for covered pixels leaves out that ends too early; see the table.
pub(super) fn searched(mask: &mut Mask, window: PixelRect, p: i64) {
    let full = *mask;
    // Whether a row had a pixel, and whether an empty row came after one.
    let [mut has_begun, mut has_ended] = [false; 2];
    let [mut first, mut end] = [window.x0, window.x1];
    for y in window.y0..window.y1 {
        let Some([from, to]) = span(&full, window, y) else {
            has_ended |= has_begun;
            continue;
        };
        has_begun = true;
        // The search along a row begins, or ends, where that of the row before did.
        match p {
            1 => first = first.max(from),
            2 => end = end.min(to),
            _ => {}
        }
        for x in from..to {
            if (p == 0 && has_ended) || x < first || x >= end {
                mask.put(x, y, false);
            }
        }
    }
}

/// Rows that begin left of the window begin at its side and keep their length.
pub(super) fn slid(
    mask: &mut Mask,
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
) {
    let left = i64::from(ends_of(xs(corners))[0]).div_euclid(256);
    if left >= i64::from(window.x0) || twice_area(corners) == 0 {
        return;
    }
    let edges = edges(corners, base);
    let [sx, sy] = super::sample_of(base).map_array(i64::from);
    let [side, wide] = [window.x0, window.x1].map_array(i128::from);
    for y in window.y0..window.y1 {
        // The first sample on the inner side of every edge, and the one after the last.
        let [mut first, mut end] = [left, i64::MAX].map_array(i128::from);
        for edge in &edges {
            // In column x the edge function is 256 a x more than in column 0, and drawn where it is at least this.
            let least = i128::from(!edge.owns) - edge.value([sx, 256 * i64::from(y) + sy]);
            let step = 256 * i128::from(edge.a);
            match step.signum() {
                1 => first = first.max(-(-least).div_euclid(step)),
                -1 => end = end.min((-least).div_euclid(-step) + 1),
                _ if least > 0 => end = first,
                _ => {}
            }
        }
        if first >= side || first >= end {
            continue;
        }
        // A row that enters the window is longer by what lies before it; another one moves into it as it is.
        let (from, last) = match end > side {
            true => (end.min(wide), end.min(wide) + side - first),
            false => (side, end - first),
        };
        for x in from..last.min(wide) {
            mask.set(x as i32, y);
        }
    }
}

/// Which pixels are drawn twice; see the table.
pub(super) fn twice(mask: &Mask, corners: &Corners, window: PixelRect, p: i64) -> Mask {
    let Some(drawn) = drawn_box(mask, window) else { return *mask };
    let [[_, right], [_, low]] = boxes(corners)[0];
    let mut twice = *mask;
    for y in window.y0..window.y1 {
        let Some([first, end]) = span(mask, window, y) else { continue };
        for x in first..end {
            let is_twice = match p {
                0 => y == drawn.y1 - 1,
                1 => y == drawn.y0,
                2 => i64::from(y) == middle_row(corners),
                3 => i64::from(y) == low.min(i64::from(window.y1) - 1),
                4 => x == first,
                5 => x == end - 1,
                6 => x == drawn.x1 - 1,
                7 => true,
                9 => i64::from(x) == right.min(i64::from(window.x1) - 1),
                // Pixels at the border: one neighbour at least is not drawn.
                _ => !BESIDE.iter().all(|[dx, dy]| has_within(mask, window, [x + dx, y + dy])),
            };
            if !is_twice {
                twice.put(x, y, false);
            }
        }
    }
    twice
}

/// Edge functions whose steps are cut toward zero to a multiple of a step, from the first sample of the box on; p mod 4 is
/// the step, from 4 on the value there is a whole number, too, and from 8 on triangles without area are drawn as others.
pub(super) fn cut_edges(
    corners: &Corners,
    window: PixelRect,
    base: &TriangleConvention,
    p: i64,
) -> Mask {
    if twice_area(corners) == 0 && p < 8 {
        return Mask::default();
    }
    let step = [256, 128, 64, 16][(p % 4) as usize];
    let whole = i128::from(256 * step);
    let sample = super::sample_of(base);
    let [[x0, _], [y0, _]] = boxes(corners)[0];
    let start = [x0.max(0) * 256 + i64::from(sample[0]), y0.max(0) * 256 + i64::from(sample[1])];
    // Each edge with its short steps, from the start on, and its value there.
    let cut = edges(corners, base).map_array(|mut edge| {
        edge.a = edge.a / step * step;
        edge.b = edge.b / step * step;
        let value = edge.value(start);
        edge.from = start;
        (edge, if p % 8 < 4 { value } else { value / whole * whole })
    });
    each_sample(window, sample, &|at| {
        cut.iter().all(|(edge, value)| {
            let value = value + edge.value(at);
            value > 0 || (value == 0 && edge.owns)
        })
    })
}

/// Two halves with a level side each, row by row from the corner opposite to it, the lower one upwards.
struct Halves {
    /// See [`rounded`].
    precision: i64,
    /// How crossings and heights become pixels.
    ends: i64,
    rows: i64,
    /// What is filled, and how far it can be seen.
    window: PixelRect,
    mask: Mask,
}

impl Halves {
    fn round(&self, v: f64) -> f64 {
        rounded(v, self.precision)
    }

    /// The pixel or the row of a place.
    fn pixel(v: f64, how: i64) -> f64 {
        match how {
            0 => v.trunc(),
            1 => v.floor(),
            2 => (v + 0.5).floor(),
            _ => (v - 0.5).ceil(),
        }
    }

    /// What is added to x from row to row, walked down or up.
    fn step(&self, tip: [f64; 2], p: [f64; 2], sign: f64) -> f64 {
        self.round(self.round(p[0] - tip[0]) / self.round(p[1] - tip[1])) * sign
    }

    /// From the row of the corner `tip` on to that of the level side from a to b, which is drawn or not.
    fn fill(&mut self, tip: [f64; 2], a: [f64; 2], b: [f64; 2], with_last: bool) {
        // Rows are counted from the tip, up or down.
        let from = Self::pixel(tip[1], self.rows) as i64;
        let to = Self::pixel(a[1], self.rows) as i64;
        let sign = if a[1] >= tip[1] { 1 } else { -1 };
        let count = (to - from).abs() + i64::from(with_last);
        let seen = match sign {
            1 => from + count > 0,
            _ => from - count < self.window.y1.into(),
        };
        if count > MOST_ROWS || !seen {
            return;
        }
        // Both crossings begin at the tip, so that their errors add up from there.
        let steps = [self.step(tip, a, sign as f64), self.step(tip, b, sign as f64)];
        let mut at = [tip[0]; 2];
        for i in 0..count {
            let left = Self::pixel(at[0].min(at[1]), self.ends) as i64;
            let right = Self::pixel(at[0].max(at[1]), self.ends) as i64;
            // The pixel of the right end is drawn, unless it is the first sample beyond.
            let end = right.saturating_add(i64::from(self.ends < 3));
            fill_row(&mut self.mask, self.window, from + sign * i, left, end);
            at = [self.round(at[0] + steps[0]), self.round(at[1] + steps[1])];
        }
    }
}

/// The digits of p are the precision, how corners are cut, how crossings and heights become pixels, and whether the row of the
/// level side belongs to the upper half and to the lower one.
pub(super) fn halves(corners: &Corners, window: PixelRect, p: i64) -> Mask {
    let [precision, whole, ends, rows, upper, lower] = HALVES.digits(p);
    let cut = |v: i32| match whole {
        0 => v,
        1 => v / 256 * 256,
        _ => v.saturating_add(128).div_euclid(256) * 256,
    };
    let sorted = sorted(&corners.map_array(|c| SubpixelPoint::new(cut(c.x), cut(c.y))));
    let mut halves = Halves { precision, ends, rows, window, mask: Mask::default() };
    let [top, middle, bottom] =
        sorted.map_array(|p| p.map_array(|v| halves.round(v as f64 / 256.0)));
    if middle[1] == bottom[1] {
        halves.fill(top, middle, bottom, upper == 1);
    } else if top[1] == middle[1] {
        halves.fill(bottom, top, middle, lower == 1);
    } else {
        // The point of the long edge at the height of the middle corner.
        let r = |v: f64| rounded(v, precision);
        let part = r(r(middle[1] - top[1]) / r(bottom[1] - top[1]));
        let cut = [r(top[0] + r(part * r(bottom[0] - top[0]))), middle[1]];
        halves.fill(top, middle, cut, upper == 1);
        halves.fill(bottom, middle, cut, lower == 1);
    }
    halves.mask
}

/// Rows that are walked one by one, at most: what begins farther above the window is not expected.
pub(super) const MOST_ROWS: i64 = 1 << 16;

/// A number whose digits are choices, of so many each.
pub(super) struct Digits<const N: usize>(pub(super) [i64; N]);

impl<const N: usize> Digits<N> {
    /// How many such numbers there are.
    pub(super) const fn count(&self) -> i64 {
        let (mut all, mut i) = (1, 0);
        while i < N {
            all *= self.0[i];
            i += 1;
        }
        all
    }

    /// The digits of a number, the lowest first.
    pub(super) fn digits(&self, mut p: i64) -> [i64; N] {
        let mut digits = self.0;
        for digit in &mut digits {
            let many = *digit;
            *digit = p % many;
            p /= many;
        }
        digits
    }
}

/// The digits of `halves`.
pub(super) const HALVES: Digits<6> = Digits([2, 3, 4, 4, 2, 2]);

/// The loop over whole pixels of many libraries for small displays, by the bits of a parameter.
struct WholePixels {
    /// Corners are rounded, or else cut toward zero or down.
    rounds: bool,
    cuts_toward_zero: bool,
    /// Corners wrap around in 16 bits.
    wraps_corners: bool,
    /// Divisions are cut down, and not toward zero.
    divides_down: bool,
    /// Products wrap around in 16 bits.
    wraps_products: bool,
    /// What goes wrong at the ends: 1, a flat top is filled from row 0 on; 2, the last row is missing; 3, the right end is.
    ends: i64,
}

impl WholePixels {
    /// The bits of a parameter of 'whole pixels by integer divisions'.
    fn of(p: i64) -> Self {
        Self {
            rounds: p & 1 != 0,
            divides_down: p & 2 != 0,
            wraps_products: p & 4 != 0,
            ends: p >> 3 & 3,
            wraps_corners: p & 32 != 0,
            cuts_toward_zero: p >> 6 != 0,
        }
    }

    /// The pixel of a coordinate of a corner.
    fn whole(&self, v: i64) -> i64 {
        let whole = match self.rounds {
            true => (v + 128).div_euclid(256),
            false if self.cuts_toward_zero => v / 256,
            false => v.div_euclid(256),
        };
        if self.wraps_corners { wrap(whole.into(), 16) as i64 } else { whole }
    }

    /// The x of an edge in a row; of an edge without height, that of a row below its upper end.
    fn at(&self, [from, to]: [Point; 2], y: i64) -> i64 {
        let product = (to[0] - from[0]) * (y - from[1]);
        let product = if self.wraps_products { wrap(product.into(), 16) as i64 } else { product };
        let dy = (to[1] - from[1]).max(1);
        from[0] + if self.divides_down { product.div_euclid(dy) } else { product / dy }
    }

    /// Fills a row from one end to the other, in either order.
    fn fill(&self, mask: &mut Mask, window: PixelRect, y: i64, a: i64, b: i64) {
        fill_row(mask, window, y, a.min(b), a.max(b) + i64::from(self.ends != 3));
    }
}

/// The loop over whole pixels: bit 0 rounds corners, bit 1 divides down, bit 2 wraps products in 16 bits, bits 3 and 4 are
/// what goes wrong at the ends, bit 5 wraps corners in 16 bits, and bit 6 cuts corners toward zero.
pub(super) fn whole_pixels(corners: &Corners, window: PixelRect, p: i64) -> Mask {
    let how = WholePixels::of(p);
    let whole = points(corners).map_array(|c| c.map_array(|v| how.whole(v)));
    let [top, middle, bottom] = geometry::sorted(whole, |a, b| a[1] > b[1]);
    let mut mask = Mask::default();
    // All in one row.
    if top[1] == bottom[1] {
        let (least, most) = (top[0].min(middle[0]), top[0].max(middle[0]));
        how.fill(&mut mask, window, top[1], least.min(bottom[0]), most.max(bottom[0]));
        return mask;
    }
    // The row of the middle corner belongs to the lower part, if there is one.
    let is_pointed = middle[1] < bottom[1];
    let upper_end = if is_pointed { middle[1] - 1 } else { middle[1] };
    let mut parts = vec![([top, middle], top[1], upper_end)];
    if is_pointed {
        let from_the_top = how.ends == 1 && middle[1] == top[1];
        let first = if from_the_top { 0 } else { middle[1] };
        let last = if how.ends == 2 { bottom[1] - 1 } else { bottom[1] };
        parts.push(([middle, bottom], first, last));
    }
    for (short, first, last) in parts {
        // Only rows of the window can be seen.
        for y in first.max(0)..=last.min(i64::from(window.y1) - 1) {
            let ends = [how.at(short, y), how.at([top, bottom], y)];
            how.fill(&mut mask, window, y, ends[0], ends[1]);
        }
    }
    mask
}

/// How a polygon's crossing with a row becomes a pixel, of whole corners.
pub(super) const CROSSINGS: [&str; 8] = [
    "cut down",
    "divided toward zero from the upper end",
    "rounded to the nearest",
    "cut toward zero, so that column 0 gets too much left of the window",
    "rounded by adding a half and cutting toward zero",
    "computed as a product that is divided by the height first, in 1/65536 px",
    "computed in 1/32 px, cut toward zero from the end of a side that is named last",
    "rounded to the nearest from float numbers of 32 bits",
];

/// What is drawn of the last row.
pub(super) const LAST_ROWS: [&str; 4] = [
    "the last row left out",
    "the last row drawn",
    "the last row and level sides drawn",
    "level sides and the lower ends of the others drawn",
];

/// The fill of a polygon of many libraries: corners cut to whole pixels, each row from the pixel of a crossing to that of the
/// next, both included; p is one of `CROSSINGS`, eight times one of `LAST_ROWS`, and 32 times how corners are cut: down, toward zero,
/// or to the nearest pixel.
pub(super) fn crossings(corners: &Corners, window: PixelRect, p: i64) -> Mask {
    // Corners are whole pixels from here on.
    let [kind, last] = [p % 8, p / 8 % 4];
    let whole = |v: i64| match p / 32 {
        0 => v.div_euclid(256),
        1 => v / 256,
        _ => (v + 128).div_euclid(256),
    };
    let whole = points(corners).map_array(|c| c.map_array(whole));
    let (first, second, third) = (whole[0][1], whole[1][1], whole[2][1]);
    let (low, high) = (first.min(second).min(third), first.max(second).max(third));
    let mut mask = Mask::default();
    for y in low.max(0)..=high.min(i64::from(window.y1) - 1) {
        let mut found = Vec::with_capacity(4);
        for i in 0..3 {
            let (named, next) = (whole[i], whole[(i + 1) % 3]);
            let (from, to) = if named[1] <= next[1] { (named, next) } else { (next, named) };
            // A level side has no crossing.
            if from[1] == to[1] {
                if last >= 2 && y == from[1] {
                    fill_row(&mut mask, window, y, from[0].min(to[0]), from[0].max(to[0]) + 1);
                }
                continue;
            }
            // A side has its upper end, and its lower one in the last row, where that is drawn.
            let is_last = matches!(last, 1 | 2) && y == high && from[1] < y && y <= to[1];
            if (from[1] <= y && y < to[1]) || is_last {
                found.push(crossing(kind, from, to, next, y));
            } else if last == 3 && y == to[1] {
                fill_row(&mut mask, window, y, to[0], to[0] + 1);
            }
        }
        // Crossings come in pairs, from left to right.
        found.sort_unstable();
        for pair in found.chunks_exact(2) {
            let [mut left, mut right] = [pair[0], pair[1]];
            if kind == 5 {
                let (a, b) = (nearest_px(left + 1), nearest_px(right - 1));
                (left, right) = (a.min(b), a.max(b));
            }
            fill_row(&mut mask, window, y, left, right + 1);
        }
    }
    mask
}

/// The nearest pixel to a place in 1/65536 px.
fn nearest_px(v: i64) -> i64 {
    (v >> 16) + ((v & 32768) >> 15)
}

/// The pixel of a crossing; of kind 5 it is in 1/65536 px.
fn crossing(kind: i64, from: Point, to: Point, named: Point, y: i64) -> i64 {
    let [dx, dy, ahead] = [to[0] - from[0], to[1] - from[1], y - from[1]];
    let over = ahead * dx;
    match kind {
        0 => from[0] + over.div_euclid(dy),
        1 => from[0] + over / dy,
        2 => from[0] + (2 * over + dy).div_euclid(2 * dy),
        3 => (from[0] * dy + over) / dy,
        4 => (2 * (from[0] * dy + over) + dy) / (2 * dy),
        5 => (65536 * ahead / dy) * dx + 65536 * from[0],
        // Counted from the end that is named last, whichever is higher.
        6 => {
            let other = if named == from { to } else { from };
            let [dx, dy] = [other[0] - named[0], other[1] - named[1]];
            (32 * named[0] + 32 * dx * (y - named[1]) / dy + 16) / 32
        }
        _ => {
            // Rounded twice: the slope, and its product with the height.
            let slope = dx as f32 / dy as f32;
            (from[0] as f32 + slope * ahead as f32).round() as i64
        }
    }
}
