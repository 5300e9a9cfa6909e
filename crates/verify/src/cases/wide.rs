//! Lines with a width, in a triangle of a case: its first two corners are the ends, the third is the second end again, and the
//! depth of the first is the width in pixels.

use glam::DVec2;

use super::{Case, Shape, Triangle, sub};
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::random::Rng;
use rasterproof_core::triangle::{ScreenTriangle, ScreenVertex, WideLine};

/// The line of a case of `wide-line`. A width that is none is that of a subpixel.
#[must_use]
pub fn wide_line(triangle: &Triangle) -> WideLine {
    let [a, b, _] = triangle.vertices;
    let width = (a.depth * f64::from(SUBPIXELS)) as i32;
    WideLine { ends: [a.position, b.position], width: width.max(1) }
}

/// Whether a triangle is such a line: its third corner is the second, and its width is a whole number of subpixels above 0.
#[must_use]
pub fn has_width(triangle: &Triangle) -> bool {
    let [a, b, c] = triangle.vertices;
    b.position == c.position
        && a.depth * f64::from(SUBPIXELS) == f64::from(wide_line(triangle).width)
}

/// A line as a case.
#[must_use]
pub fn case_of(window: PixelRect, line: &WideLine) -> Case {
    let [a, b] = line.ends;
    let vertex =
        |position, depth| ScreenVertex { position, depth, inv_w: 1.0, varying: DVec2::ZERO };
    let width_px = f64::from(line.width) / f64::from(SUBPIXELS);
    let vertices = [vertex(a, width_px), vertex(b, 0.0), vertex(b, 0.0)];
    Case {
        window,
        shape: Shape::Triangles { list: vec![ScreenTriangle { vertices }], disjoint: false },
    }
}

/// Directions whose length is a whole number, with that number: samples lie exactly on the sides of rectangles.
const DIRECTIONS: [[i64; 3]; 6] =
    [[1, 0, 1], [0, 1, 1], [3, 4, 5], [4, 3, 5], [5, 12, 13], [15, 8, 17]];

/// A number with either sign.
pub(super) fn either(rng: &mut Rng, v: i64) -> i64 {
    if rng.chance(2) { v } else { -v }
}

/// A line with a sample of the window on its border: on a side, at an end, or where both meet.
pub(super) fn tied(rng: &mut Rng, window: PixelRect) -> WideLine {
    let sample = [window.x1, window.y1]
        .map(|side| rng.int(0, i64::from(side) - 1) * i64::from(SUBPIXELS) + i64::from(HALF_PIXEL));
    let [p, q, length] = DIRECTIONS[rng.int(0, 5) as usize];
    let [right, down] = [either(rng, p), either(rng, q)];
    let scale = |rng: &mut Rng| {
        let bits = rng.int(1, 9);
        rng.int(1, 1 << bits)
    };
    let half = scale(rng).min(2048 / length);
    // From the sample to the segment at right angles, and along the segment to its ends.
    let across = if rng.chance(3) { rng.int(-half, half) } else { either(rng, half) };
    let steps = [if rng.chance(3) { 0 } else { scale(rng) }, scale(rng)];
    let end = |along: i64| {
        sub(sample[0] - across * down + along * right, sample[1] + across * right + along * down)
    };
    WideLine { ends: [end(-steps[0]), end(steps[1])], width: (2 * half * length) as i32 }
}

/// Lines as they are hard to draw: ties, thin ones, and long ones across the border of the window.
pub(super) fn drawn(rng: &mut Rng) -> Case {
    let [width, height] = [(); 2].map(|()| rng.int(5, 16) as u32);
    let window = PixelRect::window(width, height);
    let side = 16 * i64::from(SUBPIXELS);
    if rng.chance(2) {
        return case_of(window, &tied(rng, window));
    }
    let reach = if rng.chance(3) { 16 * side } else { side };
    let mut end =
        || SubpixelPoint::new(rng.coordinate(-reach / 2, reach), rng.coordinate(-reach / 2, reach));
    let ends = [end(), end()];
    let most = [64, 256, 512, 4096][rng.int(0, 3) as usize];
    case_of(window, &WideLine { ends, width: rng.coordinate(1, most) })
}
