//! How many texels a pixel meets: the level of a mip map, by exact derivatives.
//!
//! u/w, v/w and 1/w are linear in the window, with slopes that a triangle has once and for all. So by the rule for
//! quotients du/dx = ((u/w)_x - u (1/w)_x) w, and the same of v and of y: derivatives at the very point, where
//! usual hardware takes the difference of two pixels. The level is log2 of the longer of the two derivatives, in
//! texels (the scale factor of the OpenGL specification, section 8.14.1); up to 0 a texture is magnified.

use glam::DVec2;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_core::triangle::Corners;

use super::assemble::twice_area;

/// The slopes of a triangle's texture coordinates, in texels.
#[derive(Clone, Copy, Debug)]
pub struct Footprint {
    /// Texels along the sides of the texture.
    size: DVec2,
    /// (u/w, v/w) by columns and by rows of pixels.
    over_w: [DVec2; 2],
    /// 1/w likewise.
    inv_w: [f64; 2],
}

impl Footprint {
    /// Of a triangle with these 1/w and texture coordinates at its corners, in a texture of `size` texels.
    #[must_use]
    pub fn new(corners: Corners, inv_w: [f64; 3], uv: [DVec2; 3], size: (u32, u32)) -> Self {
        let [a, b, c] = corners.map_array(|corner| DVec2::new(corner.x.into(), corner.y.into()));
        // Per pixel: area and edges are in subpixels.
        let area = twice_area(corners) as f64 / f64::from(SUBPIXELS);
        let per_area = if area == 0.0 { 0.0 } else { 1.0 / area };
        let (to_b, to_c) = ((b - a) * per_area, (c - a) * per_area);
        let slope = |[p, q, r]: [f64; 3]| {
            [(q - p) * to_c.y - (r - p) * to_b.y, (r - p) * to_b.x - (q - p) * to_c.x]
        };
        let over =
            |of: fn(DVec2) -> f64| slope([0, 1, 2].map_array(|i: usize| of(uv[i]) * inv_w[i]));
        let ([ux, uy], [vx, vy]) = (over(|uv| uv.x), over(|uv| uv.y));
        let size = DVec2::new(size.0.into(), size.1.into());
        Self { size, over_w: [DVec2::new(ux, vx), DVec2::new(uy, vy)], inv_w: slope(inv_w) }
    }

    /// The longer derivative in texels, squared, where w and (u, v) are these.
    fn square(&self, uv: DVec2, w: f64) -> f64 {
        let along =
            |i: usize| ((self.over_w[i] - uv * self.inv_w[i]) * w * self.size).length_squared();
        along(0).max(along(1))
    }

    /// The level of detail; at most 0 where the texture is magnified.
    #[must_use]
    pub fn level(&self, uv: DVec2, w: f64) -> f64 {
        0.5 * libm::log2(self.square(uv, w))
    }

    /// Whether the texture is magnified everywhere in the triangle.
    ///
    /// With q = 1/w, du/dx = (U_x q - U q_x) / q^2 where U = u q. The numerator is linear in the window, so no
    /// larger than at a corner, and q is no smaller than at a corner. Their bounds give one of the length:
    /// 1 texel, less a margin of 2^-20. That covers the roundings here, a few units each, as long as the slopes
    /// are no more than 2^20 times their difference, which the bound makes sure of, and the errors of u, v and w in
    /// a fragment, which the caller keeps below 2^-24.
    #[must_use]
    pub fn is_magnified(&self, inv_w: [f64; 3], uv: [DVec2; 3]) -> bool {
        let least = inv_w[0].min(inv_w[1]).min(inv_w[2]);
        let mut longest: f64 = 0.0;
        for (over_w, slope) in self.over_w.iter().zip(self.inv_w) {
            let mut most = DVec2::ZERO;
            for (uv, inv_w) in uv.iter().zip(inv_w) {
                let terms = [over_w * inv_w, uv * inv_w * slope];
                let rounding = (terms[0].abs() + terms[1].abs()) * 0.5f64.powi(40);
                most = most.max((terms[0] - terms[1]).abs() + rounding);
            }
            longest = longest.max((most * self.size / (least * least)).length_squared());
        }
        // NaN is not known to be magnified.
        longest <= 1.0 - 0.5f64.powi(20)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;
    use rasterproof_verify::cases::Rng;

    /// A triangle with area about a picture of 100 pixels.
    fn triangle(rng: &mut Rng) -> (Corners, [f64; 3], [DVec2; 3]) {
        loop {
            let mut corner =
                |_: i32| SubpixelPoint::new(rng.int(0, 25_600) as i32, rng.int(0, 25_600) as i32);
            let corners = [0; 3].map_array(&mut corner);
            if twice_area(corners).abs() > 1 << 20 {
                let inv_w = [0; 3].map_array(|_| 0.05 + rng.unit());
                let scale = rng.unit().powi(4);
                let uv = [0; 3].map_array(|_| DVec2::new(rng.signed(), rng.signed()) * scale);
                return (corners, inv_w, uv);
            }
        }
    }

    /// w and (u, v) at weights, by the definition.
    fn at(weights: [f64; 3], inv_w: [f64; 3], uv: [DVec2; 3]) -> (f64, DVec2) {
        let sum: f64 = (0..3).map(|i| weights[i] * inv_w[i]).sum();
        let over: DVec2 = (0..3).map(|i| uv[i] * inv_w[i] * weights[i]).sum();
        (1.0 / sum, over / sum)
    }

    /// Half as large in the window, a texture is one level higher; exactly, since only exponents change.
    #[test]
    fn the_level_grows_with_distance() {
        let mut rng = Rng::new("footprint", 3, 0);
        for _ in 0..100 {
            let (_, _, uv) = triangle(&mut rng);
            let corner = |x: i32, y: i32| SubpixelPoint::new(x, y);
            let mut before = f64::NEG_INFINITY;
            for halvings in 0..6 {
                let side = 1 << (14 - halvings);
                let corners = [corner(0, 0), corner(side, 0), corner(side / 4, side)];
                let w = f64::from(1 << halvings);
                let footprint = Footprint::new(corners, [1.0 / w; 3], uv, (64, 64));
                let level = footprint.level(uv[0], w);
                assert!(halvings == 0 || (level - before - 1.0).abs() < 1e-12, "{level} {before}");
                before = level;
            }
        }
    }

    /// Against differences of points that are close together.
    #[test]
    fn the_level_is_that_of_the_derivatives() {
        let mut rng = Rng::new("footprint", 1, 0);
        for _ in 0..500 {
            let (corners, inv_w, uv) = triangle(&mut rng);
            let footprint = Footprint::new(corners, inv_w, uv, (64, 32));
            let [a, b, c] = corners.map_array(|p| DVec2::new(p.x.into(), p.y.into()) / 256.0);
            let value = |p: DVec2| {
                let area = (b - a).perp_dot(c - a);
                let weights =
                    [(c - b).perp_dot(p - b), (a - c).perp_dot(p - c), (b - a).perp_dot(p - a)];
                at(weights.map_array(|weight| weight / area), inv_w, uv)
            };
            let middle = (a + b + c) / 3.0;
            let (w, here) = value(middle);
            let step = 1e-6;
            let difference = |d: DVec2| {
                let [left, right] = [middle - d, middle + d].map_array(|p| value(p).1);
                ((right - left) / (2.0 * step) * DVec2::new(64.0, 32.0)).length()
            };
            let expected = libm::log2(difference(DVec2::X * step).max(difference(DVec2::Y * step)));
            let level = footprint.level(here, w);
            assert!((level - expected).abs() < 1e-4, "{level} for {expected}");
        }
    }

    type Condition = fn(&Footprint, [f64; 3], [DVec2; 3]) -> bool;

    /// How many of random triangles are magnified, by how many a condition knows it, and how often it is wrong.
    fn tried(condition: Condition) -> [u32; 3] {
        let mut rng = Rng::new("footprint", 2, 0);
        let mut counts = [0; 3];
        for _ in 0..4000 {
            let (corners, inv_w, uv) = triangle(&mut rng);
            let footprint = Footprint::new(corners, inv_w, uv, (64, 64));
            let mut highest = f64::MIN;
            for i in 0..=12 {
                for j in 0..=12 - i {
                    let (i, j) = (f64::from(i) / 12.0, f64::from(j) / 12.0);
                    let (w, uv) = at([1.0 - i - j, i, j], inv_w, uv);
                    highest = highest.max(footprint.level(uv, w));
                }
            }
            let holds = condition(&footprint, inv_w, uv);
            for (count, is) in
                counts.iter_mut().zip([highest <= 0.0, holds, holds && highest > 0.0])
            {
                *count += u32::from(is);
            }
        }
        counts
    }

    #[test]
    fn a_magnified_triangle_is_magnified_everywhere() {
        let [magnified, known, wrong] = tried(Footprint::is_magnified);
        assert!(wrong == 0 && known * 2 > magnified && magnified < 3800, "{known} of {magnified}");
        // Wrong ones: in the middle alone, at the nearest corner alone.
        let middle: Condition = |footprint, inv_w, uv| {
            let (w, uv) = at([1.0 / 3.0; 3], inv_w, uv);
            footprint.level(uv, w) <= 0.0
        };
        let nearest: Condition = |footprint, inv_w, uv| {
            let most = inv_w[0].max(inv_w[1]).max(inv_w[2]);
            (0..3).all(|i| inv_w[i] < most || footprint.level(uv[i], 1.0 / inv_w[i]) <= 0.0)
        };
        for (number, condition) in [middle, nearest].into_iter().enumerate() {
            assert!(tried(condition)[2] > 0, "wrong condition {number} survives");
        }
    }
}
