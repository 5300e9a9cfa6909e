//! Which depths a triangle may have in a pixel: an interval that contains every one that a rasterizer
//! computes at the samples it covers there.

use super::pattern::Pattern;
use crate::effects::primitive::Piece;
use crate::pipeline::depth::DepthFormat;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::SUBPIXELS;

/// The plane of a piece's depth over pixels.
pub struct DepthPlane {
    /// Depth at the first vertex.
    depth: f64,
    /// Edge functions over twice the area, in the middle of pixel (0, 0), and what a pixel adds.
    weights: [Weight; 2],
    /// Half the range of depths within a pixel.
    half_range: f64,
    /// At least what the depth changes by from column to column and from row to row.
    per_px: [f64; 2],
}

struct Weight {
    /// Difference of the depth of this vertex to the first one's, over twice the area.
    slope: f64,
    origin: f64,
    per_x: f64,
    per_y: f64,
}

impl DepthPlane {
    /// z = z0 + (z1 - z0) E1 / 2A + (z2 - z0) E2 / 2A = z0 + t1 + t2.
    ///
    /// Error: in a window of at most 2^14 samples a side, 2^22 subpixels, the E are whole or half
    /// numbers below 2^46, so exact. Each t has a difference, a quotient and a product; the sums
    /// round twice. With u = 2^-53 that is below 3 u (|t1| + |t2|) + 2 u (|z0| + |t1| + |t2|), and a
    /// rasterizer's depth at a covered sample is within u (12 D + 2 M) of the exact plane
    /// (`comparison::tolerance` of the crate `verify` derives 12 D + 2 M and 7 D + M), where D, M <= 1. Together less
    /// than 64 u (1 + |t1| + |t2|); outside of the triangle the t may be large.
    pub const ERROR: f64 = 64.0 * (f64::EPSILON / 2.0);

    pub fn new(piece: &Piece, pattern: Pattern) -> Self {
        let [a, b, c] = piece
            .vertices
            .map_array(|vertex| (i128::from(vertex.position.x), i128::from(vertex.position.y)));
        let area = twice_area(&piece.corners());
        let pixel = i128::from(pattern.scale * SUBPIXELS);
        let [first, second, third] = piece.vertices.map_array(|vertex| vertex.depth);
        let weight = |from: (i128, i128), to: (i128, i128), depth: f64| {
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            // In half subpixels, so that the middle is whole.
            let origin2 = dx * (pixel - 2 * from.1) - dy * (pixel - 2 * from.0);
            Weight {
                slope: if area == 0 { 0.0 } else { (depth - first) / area as f64 },
                origin: origin2 as f64 / 2.0,
                per_x: (-dy * pixel) as f64,
                per_y: (dx * pixel) as f64,
            }
        };
        // E1 belongs to the edge opposite the second vertex, E2 to the one opposite the third.
        let weights = [weight(c, a, second), weight(a, b, third)];
        // What a pixel adds to the depth along an axis, and that without regard to signs.
        let sum = |per: fn(&Weight) -> f64| -> [f64; 2] {
            let [one, two] = [0, 1].map_array(|i| weights[i].slope * per(&weights[i]));
            [(one + two).abs(), one.abs() + two.abs()]
        };
        let ([x, all_x], [y, all_y]) = (sum(|weight| weight.per_x), sum(|weight| weight.per_y));
        // Each product is rounded three times, the sums and the range four times.
        let rounding = 8.0 * f64::EPSILON * (all_x + all_y);
        let half_range = (x + y + rounding) * pattern.reach_px();
        let per_px = [x + rounding, y + rounding];
        Self { depth: first, weights, half_range, per_px }
    }

    /// Keys of the nearest and farthest depth that a rasterizer may compute at the samples of a
    /// pixel that it covers.
    #[inline]
    pub fn keys(&self, x_px: i32, y_px: i32, format: DepthFormat) -> [u64; 2] {
        self.depths(x_px, y_px).map_array(|depth| format.key(depth))
    }

    /// The nearest and farthest such depth.
    #[inline]
    pub fn depths(&self, x_px: i32, y_px: i32) -> [f64; 2] {
        let (x, y) = (f64::from(x_px), f64::from(y_px));
        let [t1, t2] = [0, 1]
            .map_array(|i| &self.weights[i])
            .map_array(|w| w.slope * (w.origin + w.per_x * x + w.per_y * y));
        let middle = self.depth + (t1 + t2);
        let half = self.half_range + Self::ERROR * (1.0 + t1.abs() + t2.abs());
        [middle - half, middle + half]
    }

    /// At least what the depth changes by from column to column and from row to row.
    pub fn per_px(&self) -> [f64; 2] {
        self.per_px
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::primitive::bare;
    use crate::effects::samples::pattern::scaled;
    use crate::pipeline::shade::{Attributes, PLACED};
    use crate::pipeline::target::Antialias;
    use rasterproof_core::contract::Interpolate as _;
    use rasterproof_core::grid::PixelRect;
    use rasterproof_core::grid::SubpixelPoint;
    use rasterproof_core::random::Rng;
    use rasterproof_core::raster::edge_function::EdgeFunction;
    use rasterproof_core::raster::scanline::Scanline;
    use rasterproof_core::triangle::ScreenTriangle;
    use rasterproof_core::triangle::ScreenVertex;

    const SIZE_PX: u32 = 12;

    /// A triangle about the picture, some with two corners close together, some whose depth grows
    /// along a row.
    fn piece(rng: &mut Rng, pattern: Pattern) -> Piece {
        let side = f64::from(pattern.scale * SUBPIXELS) * f64::from(SIZE_PX);
        let (thin, along_x) = (rng.chance(4), rng.chance(3));
        let mut corner = |near: Option<SubpixelPoint>| {
            let mut along = |from: Option<i32>| match from {
                Some(from) => from + rng.int(-300, 300) as i32,
                None => (rng.unit() * side) as i32,
            };
            let position = SubpixelPoint::new(along(near.map(|p| p.x)), along(near.map(|p| p.y)));
            let depth = if along_x { f64::from(position.x) / side } else { rng.unit() };
            ScreenVertex { position, depth, inv_w: 1.0, varying: Attributes([0.0; PLACED]) }
        };
        let first = corner(None);
        let second = corner(thin.then_some(first.position));
        ScreenTriangle { vertices: [first, second, corner(None)] }
    }

    /// Depths of both engines at samples, and those among them that `within` does not hold.
    fn outside(
        pattern: Pattern,
        within: impl Fn(&DepthPlane, i32, i32, f64) -> bool,
    ) -> (u64, u64) {
        let (mut count, mut wrong) = (0, 0);
        let window = PixelRect::window(SIZE_PX, SIZE_PX);
        let bounds = scaled(window, pattern.scale);
        for index in 0..400 {
            let piece = piece(&mut Rng::new("plane", 1, index), pattern);
            let plane = DepthPlane::new(&piece, pattern);
            for i in 0..pattern.planes {
                let moved = pattern.moved(&bare(&piece), i).unwrap();
                let mut see = |x: i32, y: i32, depth: f64| {
                    count += 1;
                    let scale = pattern.scale;
                    wrong += u64::from(!within(&plane, x / scale, y / scale, depth));
                };
                Scanline.affine_fragments(&moved, bounds, |f| see(f.x_px, f.y_px, f.depth));
                EdgeFunction.affine_fragments(&moved, bounds, |f| see(f.x_px, f.y_px, f.depth));
            }
        }
        (count, wrong)
    }

    #[test]
    fn keys_contain_every_depth_that_an_engine_computes() {
        for antialias in
            [Antialias::Multisample4, Antialias::Supersample(2), Antialias::Supersample(5)]
        {
            let pattern = Pattern::of(antialias);
            for format in DepthFormat::ALL {
                let (count, wrong) = outside(pattern, |plane, x, y, depth| {
                    let [nearest, farthest] = plane.keys(x, y, format);
                    (nearest..=farthest).contains(&format.key(depth))
                });
                assert!(count > 20_000 && wrong == 0, "{antialias:?} {format:?}: {wrong}");
            }
            // A range that is too small by an eighth is noticed, and so is none for the rounding.
            let narrow = |share: f64, error: f64| {
                outside(pattern, |plane, x, y, depth| {
                    let (x, y) = (f64::from(x), f64::from(y));
                    let term = |w: &Weight| w.slope * (w.origin + w.per_x * x + w.per_y * y);
                    let middle = plane.depth + (term(&plane.weights[0]) + term(&plane.weights[1]));
                    (depth - middle).abs() <= plane.half_range * share + error
                })
            };
            assert!(narrow(0.875, DepthPlane::ERROR).1 > 0, "{antialias:?}");
            assert!(narrow(1.0, 0.0).1 > 0, "{antialias:?}");
        }
    }
}
