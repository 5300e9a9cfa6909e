//! What the near and the far plane leave of a triangle, exactly: the signs of five linear functions at a
//! pixel's centre say whether it is inside. Corners are whole numbers in clip space, where the planes are
//! z = 0 and z = w, and the view is a cell of [`CELL_PX`].

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::random::Rng;

/// The side of the cell that the view volume is drawn in, in px.
pub const CELL_PX: u32 = 64;

/// Clip coordinates of a corner in 1/64, z in 1/512: whole numbers.
pub type Whole = [i64; 4];
/// Units of x, y and w.
pub const UNIT: f32 = 64.0;
/// Coordinates of x and y reach so far, in units of w = 1.
const REACH: i64 = 8;

/// A corner before or behind the planes: half of them as they are, at w = 1, half in a perspective whose
/// near plane lies at w = 1 and whose far plane lies at w = 9, behind the eye too.
#[must_use]
pub fn corner(rng: &mut Rng, in_perspective: bool) -> Whole {
    let unit = UNIT as i64;
    let (x, y) = (along(rng), along(rng));
    if in_perspective {
        let w = rng.int(-3 * unit, 12 * unit);
        // z = 9/8 (w - 1).
        [x, y, 9 * (w - unit), w]
    } else {
        [x, y, rng.int(-8 * unit, 16 * unit), unit]
    }
}

/// A coordinate in the view, or one that may lie far from it.
fn along(rng: &mut Rng) -> i64 {
    let unit = UNIT as i64;
    match rng.chance(2) {
        true => rng.int(-unit, unit),
        false => rng.int(-REACH * unit, REACH * unit),
    }
}

/// A sum of products that is linear in a pixel's place: its value there, times 64, and its steepness.
#[derive(Clone, Copy)]
pub struct Linear([i128; 3]);

impl Linear {
    /// From pixels' places in the cell, in halves of a pixel.
    #[must_use]
    pub fn at(self, (x, y): (u32, u32)) -> i128 {
        let half = i128::from(CELL_PX);
        let place = |px: u32| i128::from(2 * px + 1) - half;
        self.0[0] * place(x) + self.0[1] * place(y) + self.0[2] * half
    }

    /// The distance in px of a pixel's centre from where it is 0.
    #[must_use]
    pub fn distance_px(self, pixel: (u32, u32)) -> f64 {
        let (x, y) = (self.0[0] as f64, self.0[1] as f64);
        let steep = (x * x + y * y).sqrt();
        if steep > 0.0 {
            (self.at(pixel).unsigned_abs() as f64) / steep / 2.0
        } else {
            f64::INFINITY
        }
    }
}

/// What is not negative inside of what the planes leave: the three edges, near and far.
#[must_use]
pub fn borders(corners: &[Whole; 3]) -> Option<[Linear; 5]> {
    let wide = corners.map_array(|c| c.map_array(i128::from));
    let edges = [edge(wide[1], wide[2]), edge(wide[2], wide[0]), edge(wide[0], wide[1])];
    let [x, y, _, w] = wide[0];
    let volume = edges[0][0] * x + edges[0][1] * y + edges[0][2] * w;
    if volume == 0 {
        return None;
    }
    let edges = edges.map_array(|e| e.map_array(|v| v * volume.signum()));
    // Depth and w of the plane through the corners, both times the volume; z counts in 1/8 more.
    let (mut near, mut far) = ([0; 3], [0; 3]);
    for (edge, corner) in edges.iter().zip(wide) {
        for axis in 0..3 {
            near[axis] += edge[axis] * corner[2];
            far[axis] += edge[axis] * (8 * corner[3] - corner[2]);
        }
    }
    Some([edges[0], edges[1], edges[2], near, far].map(Linear))
}

/// The side of the plane through the eye and an edge, as a function of (x, y, 1) in clip space.
fn edge([ax, ay, _, aw]: [i128; 4], [bx, by, _, bw]: [i128; 4]) -> [i128; 3] {
    [ay * bw - aw * by, aw * bx - ax * bw, ax * by - ay * bx]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle at w = 1 over the lower right half of the view, its depth rising from -1 at the left to 1
    /// at the right: the middle column is where the near plane cuts.
    #[test]
    fn a_cut_by_hand() {
        let unit = UNIT as i64;
        let corners =
            [[-unit, unit], [unit, -unit], [unit, unit]].map(|[x, y]| [x, y, 8 * x, unit]);
        let borders = borders(&corners).unwrap();
        let is_in = |pixel| borders.iter().all(|b| b.at(pixel) >= 0);
        let half = CELL_PX / 2;
        assert!(is_in((half, half)) && is_in((CELL_PX - 1, 0)) && is_in((half, CELL_PX - 1)));
        assert!(!is_in((half - 1, half)) && !is_in((half - 1, CELL_PX - 1)));
        assert!(!is_in((half, half - 2)));
        assert_eq!(borders[3].distance_px((half + 3, 5)), 3.5);
        assert!(borders[4].at((CELL_PX - 1, 0)) > 0);
    }

    /// Behind the eye a corner turns over: an edge that ends there goes the other way.
    #[test]
    fn behind_the_eye_by_hand() {
        let unit = UNIT as i64;
        // From w = 3 at (0, 0) to both sides at w = -1: what is seen is the region between the rays.
        let at = |x: i64, y: i64, w: i64| [x * unit, y * unit, 9 * (w - 1) * unit, w * unit];
        let corners = [at(0, 0, 3), at(-4, 4, -1), at(4, 4, -1)];
        let borders = borders(&corners).unwrap();
        let is_in = |pixel| borders.iter().all(|b| b.at(pixel) >= 0);
        let half = CELL_PX / 2;
        // The near plane, w = 1, is reached halfway, at y = 2: beyond the lower border of the view.
        assert!(is_in((half, half + 4)) && is_in((half, CELL_PX - 1)));
        assert!(!is_in((half, half - 4)) && !is_in((0, half + 1)));
    }
}
