//! Engines of other rules than those of the book, for what the line protocol asks of programs that declare them.

use glam::DVec2;
use rasterproof_core::contract::Rasterize;
use rasterproof_core::geometry::{edges, twice_area};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::triangle::{
    Corners, Fragment, ScreenTriangle, Span, ValuePlace, WideForm, WideLine,
};
use rasterproof_render::pipeline::multisample::{self, SAMPLES};

/// Draws every pixel that a triangle touches.
#[derive(Clone, Copy, Debug)]
pub struct TouchedPixels {
    /// Whether a pixel that meets the border of the triangle and nothing else is drawn.
    pub is_closed: bool,
}

impl TouchedPixels {
    /// Whether some line separates a pixel from a triangle. Of two convex shapes it runs along a side of one of them.
    fn is_apart(self, corners: &Corners, [x_px, y_px]: [i32; 2]) -> bool {
        // The four corners of the pixel, in subpixels.
        let square = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[right, down]| {
            let [x, y] = [x_px + right, y_px + down].map(|px| i64::from(px) * i64::from(SUBPIXELS));
            [x, y]
        });
        // How far a shape lies beyond a line may be 0 where they touch.
        let least = i128::from(self.is_closed);
        let inside = twice_area(corners).signum();
        for edge in edges(corners) {
            if square.iter().all(|p| side(edge, *p) * inside <= -least) {
                return true;
            }
        }
        // Along the sides of the pixel.
        for axis in 0..2 {
            let [a, b, c] = corners.map(|p| i128::from([p.x, p.y][axis]));
            let [first, end] = [square[0][axis], square[2][axis]].map(i128::from);
            if end - a.min(b).min(c) <= -least || a.max(b).max(c) - first <= -least {
                return true;
            }
        }
        false
    }
}

/// On which side of an edge a point lies, that may be no point of the lattice.
fn side([a, b]: [SubpixelPoint; 2], [x, y]: [i64; 2]) -> i128 {
    let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(i128::from);
    (bx - ax) * (i128::from(y) - ay) - (by - ay) * (i128::from(x) - ax)
}

impl Rasterize for TouchedPixels {
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        if twice_area(&corners) == 0 {
            return;
        }
        for y_px in bounds.y0..bounds.y1 {
            // The pixels of a row that meet a convex shape are one run.
            let mut run = bounds.x1..bounds.x1;
            for x_px in bounds.x0..bounds.x1 {
                match (self.is_apart(&corners, [x_px, y_px]), run.start < bounds.x1) {
                    (false, false) => run.start = x_px,
                    (true, true) => {
                        run.end = x_px;
                        break;
                    }
                    _ => {}
                }
            }
            if !run.is_empty() {
                emit(Span { y_px, x0_px: run.start, x1_px: run.end });
            }
        }
    }
}

/// Draws lines with a width by the top-left rule, a row at a time.
#[derive(Clone, Copy, Debug)]
pub struct WideLines {
    /// The shape of a line.
    pub form: WideForm,
}

/// That a x + c is at most 0, of x in subpixels.
struct HalfPlane {
    /// Above 0 where the half plane ends at the right, below 0 where it ends at the left.
    a: i128,
    c: i128,
}

impl HalfPlane {
    /// The first and the last column whose centres lie in it, of those between two.
    fn columns(&self, [first, last]: [i128; 2]) -> [i128; 2] {
        let px = i128::from(SUBPIXELS);
        let [step, start] = [self.a * px, self.a * px / 2 + self.c];
        match step.signum() {
            0 if start > 0 => [0, -1],
            0 => [first, last],
            1 => [first, last.min((-start).div_euclid(step))],
            // Rounded up.
            _ => [first.max(-(-start).div_euclid(-step)), last],
        }
    }
}

impl WideLines {
    /// The runs of a line in a window.
    pub fn cover(self, line: &WideLine, bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
        // Whole numbers from here on; a row is cut by four half planes.
        let [start, end] = line.ends.map(|p| [i128::from(p.x), i128::from(p.y)]);
        let [dx, dy] = [end[0] - start[0], end[1] - start[1]];
        if [dx, dy] == [0, 0] {
            return;
        }
        // The segment or its longer axis, at the ends of which the shape is cut off.
        let cut = match self.form {
            WideForm::Rectangle => [dx, dy],
            WideForm::Parallelogram if dy.abs() > dx.abs() => [0, dy],
            WideForm::Parallelogram => [dx, 0],
        };
        // Distances from the line are compared by their squares times that of the segment, so that no root is rounded.
        let squared = (cut[0] * cut[0] + cut[1] * cut[1]).unsigned_abs();
        let area = squared * u128::from(line.width.unsigned_abs()).pow(2);
        // Whole numbers are at most a root where they are at most the whole number below it.
        let root = area.isqrt();
        let is_exact = root * root == area;
        for y_px in bounds.y0..bounds.y1 {
            let y = i128::from(y_px) * i128::from(SUBPIXELS) + i128::from(HALF_PIXEL) - start[1];
            // Each half plane with the direction that leads out of it, and whether samples lie on its border at all.
            let beside = 2 * (dx * y + dy * start[0]);
            let along = cut[1] * y - cut[0] * start[0];
            let planes = [
                (HalfPlane { a: -2 * dy, c: beside - root as i128 }, [-dy, dx], is_exact),
                (HalfPlane { a: 2 * dy, c: -beside - root as i128 }, [dy, -dx], is_exact),
                (HalfPlane { a: -cut[0], c: -along }, [-cut[0], -cut[1]], true),
                (HalfPlane { a: cut[0], c: along - squared as i128 }, cut, true),
            ];
            let mut columns = [i128::from(bounds.x0), i128::from(bounds.x1) - 1];
            for (mut plane, [right, down], has_border) in planes {
                let is_owned = right < 0 || (right == 0 && down < 0);
                plane.c += i128::from(has_border && !is_owned);
                columns = plane.columns(columns);
            }
            let [first, last] = columns;
            if first <= last {
                // Both lie in the window.
                emit(Span { y_px, x0_px: first as i32, x1_px: last as i32 + 1 });
            }
        }
    }
}

/// The values of the samples of a triangle, by weights that may be below 0.
#[derive(Clone, Copy, Debug)]
pub struct SampleValues {
    /// Where they are computed.
    pub at: ValuePlace,
}

impl SampleValues {
    /// The covered samples of each pixel, as a mask, with the values that they have. Nothing where a corner lies within half a pixel of
    /// the domain's end.
    #[must_use]
    pub fn cover(
        self,
        triangle: &ScreenTriangle<DVec2>,
        bounds: PixelRect,
        emit: &mut dyn FnMut(u8, Fragment<DVec2>),
    ) -> Option<()> {
        // Which samples are covered is decided by the edge function, as everywhere; the values are computed here.
        let masks = multisample::masks(&EdgeFunction, triangle.corners(), bounds)?;
        for (y_px, row) in masks.rows() {
            for (x_px, &mask) in (bounds.x0..).zip(row).filter(|(_, mask)| **mask != 0) {
                let at = |place| values_at(triangle, [x_px, y_px], place);
                // A pixel that is covered as a whole has one value, at its centre, unless each sample has its own.
                let first = SAMPLES[mask.trailing_zeros() as usize];
                match self.at {
                    ValuePlace::Centre => emit(mask, at((8, 8))),
                    ValuePlace::Centroid if mask == 0b1111 => emit(mask, at((8, 8))),
                    ValuePlace::Centroid => emit(mask, at(first)),
                    ValuePlace::Sample => {
                        for (bit, &place) in SAMPLES.iter().enumerate() {
                            if mask >> bit & 1 == 1 {
                                emit(1 << bit, at(place));
                            }
                        }
                    }
                }
            }
        }
        Some(())
    }
}

/// Depth and attributes at a place of a pixel in 1/16 px, inside the triangle or not.
fn values_at(
    triangle: &ScreenTriangle<DVec2>,
    pixel: [i32; 2],
    (x, y): (i32, i32),
) -> Fragment<DVec2> {
    let corners = triangle.corners();
    let at = [(pixel[0], x), (pixel[1], y)].map(|(px, part)| {
        i64::from(px) * i64::from(SUBPIXELS) + i64::from(part * (SUBPIXELS / 16))
    });
    // Weights by areas, which are below 0 outside.
    let area = twice_area(&corners) as f64;
    let (mut depth, mut over_w, mut varying) = (0.0, 0.0, DVec2::ZERO);
    for (i, v) in triangle.vertices.iter().enumerate() {
        // The edge that lies opposite to the corner.
        let weight = side([corners[(i + 1) % 3], corners[(i + 2) % 3]], at) as f64 / area;
        depth += weight * v.depth;
        over_w += weight * v.inv_w;
        varying += v.varying * (weight * v.inv_w);
    }
    Fragment { x_px: pixel[0], y_px: pixel[1], depth, varying: varying / over_w }
}

/// The shares of the pixels that a triangle covers, in steps: what the four sides of a pixel leave of the triangle is a polygon,
/// whose area is the sum of the areas beside its edges.
#[derive(Clone, Copy, Debug)]
pub struct AreaLevels {
    /// The steps of a whole pixel.
    pub levels: u8,
}

impl AreaLevels {
    /// A run for each pixel whose level is above 0.
    pub fn cover(self, corners: &Corners, bounds: PixelRect, emit: &mut dyn FnMut(Span, u8)) {
        let corners = corners.map(|p| {
            let (x, y) = p.to_px();
            [x, y]
        });
        for y_px in bounds.y0..bounds.y1 {
            for x_px in bounds.x0..bounds.x1 {
                let share = share_by_clipping(&corners, [f64::from(x_px), f64::from(y_px)]);
                // Half of a step is rounded up.
                // A share is at most 1.
                let level = (share * f64::from(self.levels)).round() as u8;
                if level > 0 {
                    emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 }, level);
                }
            }
        }
    }
}

/// The area of a triangle within the pixel with this upper left corner.
fn share_by_clipping(corners: &[[f64; 2]; 3], pixel: [f64; 2]) -> f64 {
    // In pixels from its upper left corner, so that the borders are 0 and 1.
    let mut polygon = corners.map(|p| [p[0] - pixel[0], p[1] - pixel[1]]).to_vec();
    for (axis, limit, sign) in [(0, 0.0, 1.0), (0, 1.0, -1.0), (1, 0.0, 1.0), (1, 1.0, -1.0)] {
        let inside = |p: &[f64; 2]| sign * (p[axis] - limit);
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, from) in polygon.iter().enumerate() {
            let to = &polygon[(i + 1) % polygon.len()];
            let [here, there] = [inside(from), inside(to)];
            if here >= 0.0 {
                kept.push(*from);
            }
            // The edge crosses the border: the polygon gets a corner there.
            if (here < 0.0) != (there < 0.0) {
                let part = here / (here - there);
                kept.push([0, 1].map(|k| from[k] + (to[k] - from[k]) * part));
            }
        }
        polygon = kept;
    }
    // Twice the area of what is left.
    let mut twice = 0.0;
    for (i, p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        twice += p[0] * q[1] - p[1] * q[0];
    }
    (twice / 2.0).abs().min(1.0)
}
