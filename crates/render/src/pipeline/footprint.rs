//! How many texels a pixel meets: the level of a mip map, by exact derivatives.
//!
//! u/w, v/w and 1/w are linear in the window, with slopes that a triangle has once and for all. So by the rule for
//! quotients du/dx = ((u/w)_x - u (1/w)_x) w, and the same of v and of y: derivatives at the very point, where
//! usual hardware takes the difference of two pixels. The level is log2 of the longer of the two derivatives, in
//! texels (the scale factor of the OpenGL specification, section 8.14.1); up to 0 a texture is magnified.
//!
//! A texture with anisotropy is read N times along the longer derivative, by the formula that the text of
//! `EXT_texture_filter_anisotropic` describes: with Pmax and Pmin the lengths of the two derivatives in texels, at the point
//! moved by (i / (N + 1) - 1/2) times the longer one, for i from 1 to N, each time at the level log2(Pmax / N), and the
//! mean is taken. It departs from that text in one thing. There N is Pmax / Pmin, rounded up, so that a
//! texture is read once only where both are equal to the last bit; here N is Pmax / max(Pmin, 1), rounded to the nearest
//! whole number. So a footprint that is nearly as wide as long is read once, the choice of the axis changes nothing where both
//! are as long, and a texture that is magnified is read as without anisotropy. The thresholds of the rounding lie off simple
//! fractions, as those of [`super::depth`] do.

use glam::{DVec2, DVec3};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::SUBPIXELS;
use rasterproof_core::triangle::Corners;

use super::depth::OFF_FRACTION;
use super::ends;
use super::texture::Texture;
use rasterproof_core::geometry::twice_area;

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
        let area = twice_area(&corners) as f64 / f64::from(SUBPIXELS);
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

    /// The derivatives by columns and by rows of pixels, where w and (u, v) are these.
    fn derivatives(&self, uv: DVec2, w: f64) -> [DVec2; 2] {
        [0, 1].map_array(|i: usize| (self.over_w[i] - uv * self.inv_w[i]) * w)
    }

    /// The lengths of the derivatives in texels, squared.
    fn squares(&self, derivatives: [DVec2; 2]) -> [f64; 2] {
        derivatives.map_array(|derivative| (derivative * self.size).length_squared())
    }

    /// The lengths of the derivatives by columns and by rows of pixels, in texels.
    #[must_use]
    pub fn lengths(&self, uv: DVec2, w: f64) -> [f64; 2] {
        self.squares(self.derivatives(uv, w)).map_array(f64::sqrt)
    }

    /// The level of detail; at most 0 where the texture is magnified.
    #[must_use]
    pub fn level(&self, uv: DVec2, w: f64) -> f64 {
        let [x, y] = self.squares(self.derivatives(uv, w));
        0.5 * libm::log2(x.max(y))
    }

    /// How a texture is read that is read at most so often.
    #[must_use]
    pub fn taps(&self, uv: DVec2, w: f64, most: u8) -> Taps {
        let derivatives = self.derivatives(uv, w);
        let [x, y] = self.squares(derivatives);
        let (longer, shorter) = (x.max(y), x.min(y));
        let ratio = longer.sqrt() / shorter.sqrt().max(1.0);
        // `as` takes NaN to 0.
        let count = ((ratio + (0.5 + OFF_FRACTION)) as u8).clamp(1, most.max(1));
        let along = derivatives[usize::from(x <= y)];
        let level = 0.5 * libm::log2(longer / f64::from(u32::from(count) * u32::from(count)));
        Taps { count, along, level }
    }

    /// Whether the texture is magnified everywhere in the triangle.
    ///
    /// With q = 1/w, du/dx = (U_x q - U q_x) / q^2 where U = u q. The numerator is linear in the window, so no
    /// larger than at a corner, and q is no smaller than at a corner. Their bounds give one of the length:
    /// 1 texel, less a margin of 2^-20. That covers the roundings here, a few units each, as long as the slopes
    /// are no more than 2^20 times their difference, which the bound makes sure of, and the errors of u, v and w in
    /// a fragment, which the caller keeps below 2^-24.
    ///
    /// The error of u is at most 2^-48 M, where M is the largest |u| of all corners, and the one margin is of single
    /// corners. It suffices all the same where the bound holds, in texels |U_x q_i - u_i q_i q_x| <= q_min^2 at each
    /// corner: then |u_i q_x| <= |U_x| + q_min at each, and |U_x| <= q_min + m |q_x| with the least |u| of all corners,
    /// m. So M |q_x| is at most m |q_x| + 2 q_min, and the error of a derivative at most
    /// 2^-48 M |q_x| / q_min <= 2^-48 (m |q_x| / q_min + 2): far below 2^-40 of the term of any corner, and 2^-20.
    #[must_use]
    pub fn is_magnified(&self, inv_w: [f64; 3], uv: [DVec2; 3]) -> bool {
        // NaN is not known to be magnified.
        self.longest_square(inv_w, uv) <= 1.0 - 0.5f64.powi(20)
    }

    /// No derivative in the triangle is longer, in texels. The bound is that of [`Self::is_magnified`], with its margin; where
    /// it is L texels in place of one, so are the terms of the errors that it is derived from.
    #[must_use]
    pub fn longest(&self, inv_w: [f64; 3], uv: [DVec2; 3]) -> f64 {
        self.longest_square(inv_w, uv).sqrt() * (1.0 + 0.5f64.powi(20))
    }

    fn longest_square(&self, inv_w: [f64; 3], uv: [DVec2; 3]) -> f64 {
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
        longest
    }

    /// No derivative in a part of the triangle is longer, in texels: as [`Self::longest`] between four points of its plane, of
    /// which 1/w and texture coordinates were computed.
    ///
    /// The numerators are linear between them too. `farthest` is the largest |u| and |v| at a corner of the triangle, by which u at
    /// a point, and in a fragment, is off by less than 2^-43. So each numerator is moved by 2^-40 of (|U_x| + M |q_x|) q_max, as in
    /// [`Self::is_round`].
    #[must_use]
    pub fn longest_in(&self, inv_w: [f64; 4], uv: [DVec2; 4], farthest: DVec2) -> f64 {
        let [least, greatest] = ends(&inv_w);
        let mut longest: f64 = 0.0;
        for (over_w, slope) in self.over_w.iter().zip(self.inv_w) {
            let rounding = (over_w.abs() + farthest * slope.abs()) * (greatest * 0.5f64.powi(40));
            let mut most = DVec2::ZERO;
            for (uv, inv_w) in uv.iter().zip(inv_w) {
                most = most.max((over_w * inv_w - uv * inv_w * slope).abs() + rounding);
            }
            longest = longest.max((most * self.size / (least * least)).length_squared());
        }
        longest.sqrt() * (1.0 + 0.5f64.powi(20))
    }

    /// Whether [`Self::taps`] reads once everywhere in the triangle.
    ///
    /// It does where Pmax / max(Pmin, 1) is less than 1.5 - 2^-20 / 3. With A and B the numerators of the derivatives by
    /// columns and by rows, as in [`Self::is_magnified`], P is |A| / q^2 and |B| / q^2, so that the ratio is that of |A| to
    /// max(|B|, q^2), or the other way round: q^2 cancels. A and B are linear in the window, whatever the slopes are. So |A|
    /// is no longer than at a corner, and |B| no shorter than B's part in any direction, which is least at a corner; the
    /// direction is that of the mean of the corners.
    ///
    /// The margin of 2/3 of 2^-20 covers w, which is off by less than 2^-24 of itself and in both lengths alike, and the
    /// roundings that are relative to a length. Those of u are not: u is off by at most 2^-48 M, where M is the largest
    /// |u| of all corners, so that A is off by 2^-48 M |q_x| q. The bounds are therefore moved by 2^-40 of
    /// (|U_x| + M |q_x|) q_max, with the same M and q_max for all corners, since no other bound holds of a single one.
    #[must_use]
    pub fn is_round(&self, inv_w: [f64; 3], uv: [DVec2; 3]) -> bool {
        let farthest = uv[0].abs().max(uv[1].abs()).max(uv[2].abs());
        let [least, most] = ends(&inv_w);
        let [[long_x, short_x], [long_y, short_y]] = [0, 1].map_array(|i: usize| {
            let (over_w, slope) = (self.over_w[i], self.inv_w[i]);
            let numerator = |i: usize| (over_w * inv_w[i] - uv[i] * inv_w[i] * slope) * self.size;
            let numerators = [0, 1, 2].map_array(numerator);
            let rounding = (over_w.abs() + farthest * slope.abs()) * self.size * most;
            let rounding = rounding.length() * 0.5f64.powi(40);
            let direction = numerators.iter().sum::<DVec2>().normalize_or_zero();
            let [_, longest] = ends(&numerators.map(DVec2::length));
            let [shortest, _] = ends(&numerators.map(|numerator| numerator.dot(direction)));
            [longest + rounding, shortest - rounding]
        });
        let texel = least * least;
        let is_short = |longest: f64, other: f64| {
            longest <= (1.5 - 0.5f64.powi(20)) * other.max(texel) && longest.is_finite()
        };
        is_short(long_x, short_y) && is_short(long_y, short_x)
    }
}

/// The places at which a texture is read for one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taps {
    pub count: u8,
    /// The longer derivative, along which they lie.
    pub along: DVec2,
    /// The level of detail that all of these reads have.
    pub level: f64,
}

#[derive(Clone, Copy, Debug)]
pub struct Reading {
    pub footprint: Footprint,
    /// Whether at levels of detail; else at level 0.
    pub at_levels: bool,
    /// Whether as often as the texture says; else once.
    pub is_anisotropic: bool,
}

impl Reading {
    /// What is read where w and (u, v) are these, and how often the texture is read for it.
    #[must_use]
    pub fn texel(&self, texture: &Texture, uv: DVec2, w: f64) -> (DVec3, u8) {
        let size = DVec2::new(texture.size().0.into(), texture.size().1.into());
        let footprint = Footprint { size, ..self.footprint };
        let read = |uv: DVec2, level: f64| {
            if self.at_levels { texture.at_level(uv, level) } else { texture.at(uv) }
        };
        if !self.is_anisotropic || texture.anisotropy <= 1 {
            return (read(uv, footprint.level(uv, w)), 1);
        }
        let Taps { count, along, level } = footprint.taps(uv, w, texture.anisotropy);
        if count == 1 {
            return (read(uv, level), 1);
        }
        let number = f64::from(count);
        let sum: DVec3 = (1..=count)
            .map(|i| read(uv + along * (f64::from(i) / (number + 1.0) - 0.5), level))
            .sum();
        (sum / number, count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::grid::SubpixelPoint;
    use rasterproof_core::random::Rng;

    /// Corners, 1/w and texture coordinates.
    type Triangle = (Corners, [f64; 3], [DVec2; 3]);

    /// A triangle with area about a picture of 100 pixels.
    fn triangle(rng: &mut Rng) -> Triangle {
        loop {
            let mut corner =
                |_: i32| SubpixelPoint::new(rng.int(0, 25_600) as i32, rng.int(0, 25_600) as i32);
            let corners = [0; 3].map_array(&mut corner);
            if twice_area(&corners).abs() > 1 << 20 {
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

    /// How many of random triangles have a property at all of many points, by how many a condition knows it, and how often it
    /// is wrong.
    fn tried(
        property: fn(&Footprint, DVec2, f64) -> bool,
        make: fn(&mut Rng) -> Triangle,
        condition: Condition,
    ) -> [u32; 3] {
        let mut rng = Rng::new("footprint", 2, 0);
        let mut counts = [0; 3];
        for _ in 0..4000 {
            let (corners, inv_w, uv) = make(&mut rng);
            let footprint = Footprint::new(corners, inv_w, uv, (64, 64));
            let mut everywhere = true;
            for i in 0..=12 {
                for j in 0..=12 - i {
                    let (i, j) = (f64::from(i) / 12.0, f64::from(j) / 12.0);
                    let (w, uv) = at([1.0 - i - j, i, j], inv_w, uv);
                    everywhere &= property(&footprint, uv, w);
                }
            }
            let holds = condition(&footprint, inv_w, uv);
            for (count, is) in counts.iter_mut().zip([everywhere, holds, holds && !everywhere]) {
                *count += u32::from(is);
            }
        }
        counts
    }

    #[test]
    fn a_magnified_triangle_is_magnified_everywhere() {
        let tried = |condition: Condition| {
            tried(|footprint, uv, w| footprint.level(uv, w) <= 0.0, triangle, condition)
        };
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

    /// As [`triangle`], with footprints of more than a texel that are often about as wide as long.
    fn minified(rng: &mut Rng) -> Triangle {
        let (corners, inv_w, _) = triangle(rng);
        let (slant, nearness) = (rng.unit() * 0.4, rng.unit().powi(2));
        let inv_w = inv_w.map_array(|inv_w| 1.0 + (inv_w - 0.5) * nearness);
        let uv = corners.map_array(|p| {
            // Three texels of 64 along either side of a pixel.
            let at = DVec2::new(p.x.into(), p.y.into()) / 256.0 * (3.0 / 64.0);
            let uv = DVec2::new(at.x + slant * at.y, slant * at.x + at.y);
            uv + DVec2::new(rng.signed(), rng.signed()) * 0.5
        });
        (corners, inv_w, uv)
    }

    #[test]
    fn a_round_triangle_is_read_once_everywhere() {
        let once = |footprint: &Footprint, uv: DVec2, w: f64| footprint.taps(uv, w, 16).count == 1;
        let tried = |condition: Condition| tried(once, minified, condition);
        let [round, known, wrong] = tried(Footprint::is_round);
        assert!(
            wrong == 0 && known * 2 > round && round < 3000,
            "{known} of {round}, {wrong} wrong"
        );
        // Wrong ones: in the middle alone; at the corners alone, although an axis may be shorter between them; and as long as
        // one axis is not the longer one.
        let middle: Condition = |footprint, inv_w, uv| {
            let (w, uv) = at([1.0 / 3.0; 3], inv_w, uv);
            footprint.taps(uv, w, 16).count == 1
        };
        let corners: Condition = |footprint, inv_w, uv| {
            (0..3).all(|i| footprint.taps(uv[i], 1.0 / inv_w[i], 16).count == 1)
        };
        let columns: Condition = |footprint, inv_w, uv| {
            let square = |i: usize| footprint.squares(footprint.derivatives(uv[i], 1.0 / inv_w[i]));
            (0..3).all(|i| square(i)[0] < 2.25 * square(i)[1])
        };
        let known: Vec<_> = [middle, corners, columns].into_iter().map(tried).collect();
        for (number, [_, _, wrong]) in known.into_iter().enumerate() {
            assert!(wrong > 0, "wrong condition {number} survives");
        }
    }

    /// A texel of rows of numbers, four of them to a pixel, and one column.
    #[test]
    fn taps_by_hand() {
        let corner = |x: i32, y: i32| SubpixelPoint::new(x * 256, y * 256);
        let corners = [corner(0, 0), corner(16, 0), corner(0, 16)];
        let numbers = Texture::grey(16, 64, (0..64 * 16).map(|at| (at / 16) as u8).collect());
        let texture = numbers.unwrap().with_mip_map();
        let uv = [DVec2::new(0.0, 1.0), DVec2::new(1.0, 1.0), DVec2::new(0.0, 0.0)];
        let footprint = Footprint::new(corners, [1.0; 3], uv, texture.size());
        let point = DVec2::new(0.03, 1.0 - 30.1 / 64.0);
        let taps = |most: u8| footprint.taps(point, 1.0, most);
        let along = DVec2::new(0.0, -1.0 / 16.0);
        assert_eq!(taps(16), Taps { count: 4, along, level: 0.0 });
        assert_eq!(taps(2), Taps { count: 2, along, level: 1.0 });
        assert_eq!(taps(1), Taps { count: 1, along, level: footprint.level(point, 1.0) });
        let read = |most: u8, at_levels: bool| {
            let texture = texture.clone().with_anisotropy(most);
            let reading = Reading { footprint, at_levels, is_anisotropic: true };
            let (texel, count) = reading.texel(&texture, point, 1.0);
            (texel.x * 255.0, count)
        };
        // At 30.1 - 1.2, - 0.4, + 0.4 and + 1.2 rows, the four rows 28, 29, 30 and 31.
        let near = |(value, count): (f64, u8), expected: f64, taps: u8| {
            assert!((value - expected).abs() < 1e-9 && count == taps, "{value} {count}");
        };
        near(read(16, true), 29.5, 4);
        // Three of them at - 1, 0 and + 1: rows 29, 30 and 31 of the texture itself.
        near(read(3, false), 30.0, 3);
        // Two at - 2/3 and + 2/3 in rows of two: 28 and 29, and 30 and 31, whose means are rounded up.
        near(read(2, true), 30.0, 2);
        // One, in rows of four: 28 to 31.
        assert_eq!(read(1, true), (texture.at_level(point, 2.0).x * 255.0, 1));
    }

    /// A footprint that is as wide as long is read as without anisotropy, and so is what is magnified, to the bit.
    #[test]
    fn round_footprints_keep_their_bits() {
        let mut rng = Rng::new("footprint", 4, 0);
        let numbers: Vec<[u8; 3]> = (0..=255).map(|i| [i, 255 - i, i / 2]).collect();
        let texture = Texture::new(16, 16, &numbers).unwrap().with_mip_map().with_anisotropy(16);
        let mut seen = [0; 2];
        for index in 0..2000 {
            let (corners, inv_w, uv) =
                if index % 2 == 0 { triangle(&mut rng) } else { minified(&mut rng) };
            let footprint = Footprint::new(corners, inv_w, uv, (16, 16));
            let (w, uv) = at([0.3, 0.3, 0.4], inv_w, uv);
            let [(plain, _), (texel, count)] = [false, true].map_array(|is_anisotropic: bool| {
                Reading { footprint, at_levels: true, is_anisotropic }.texel(&texture, uv, w)
            });
            seen[usize::from(count == 1)] += 1;
            assert!(count > 1 || texel == plain);
        }
        assert!(seen.iter().all(|count| *count > 100), "{seen:?}");
        for odd in [f64::NAN, f64::INFINITY] {
            let (corners, inv_w, uv) = triangle(&mut rng);
            let footprint = Footprint::new(corners, inv_w, uv, (16, 16));
            let reading = Reading { footprint, at_levels: true, is_anisotropic: true };
            assert!(reading.texel(&texture, DVec2::splat(odd), 1.0).0.is_finite());
            assert!(!footprint.is_round([1.0; 3], [DVec2::splat(odd); 3]));
        }
    }

    type OfPart = fn(&Footprint, [f64; 4], [DVec2; 4], DVec2) -> [bool; 2];

    /// Of how many parts of random triangles a condition says that they are magnified, and round, and how often it is wrong.
    fn of_parts(condition: OfPart) -> [u32; 4] {
        let mut rng = Rng::new("footprints of parts", 1, 0);
        let mut counts = [0; 4];
        for index in 0..4000 {
            let (corners, inv_w, uv) =
                if index % 2 == 0 { triangle(&mut rng) } else { minified(&mut rng) };
            let footprint = Footprint::new(corners, inv_w, uv, (64, 64));
            let size = rng.unit() * 0.6;
            let start = [rng.unit(), rng.unit()].map_array(|share| share * (1.0 - size));
            let point = |i: f64, j: f64| {
                let [s, t] = [start[0] + size * i, start[1] + size * j];
                at([1.0 - s - t, s, t], inv_w, uv)
            };
            let points = [point(0.0, 0.0), point(1.0, 0.0), point(0.0, 1.0), point(1.0, 1.0)];
            if points.iter().any(|(w, _)| *w <= 0.0) {
                continue;
            }
            let farthest = uv[0].abs().max(uv[1].abs()).max(uv[2].abs());
            let found = condition(
                &footprint,
                points.map(|(w, _)| 1.0 / w),
                points.map(|(_, uv)| uv),
                farthest,
            );
            let mut wrong = [false; 2];
            for (i, j) in (0..=12).flat_map(|i| (0..=12).map(move |j| (f64::from(i), f64::from(j))))
            {
                let (w, uv) = point(i / 12.0, j / 12.0);
                wrong[0] |= footprint.level(uv, w) > 0.0;
                wrong[1] |= footprint.taps(uv, w, 16).count > 1;
            }
            for i in 0..2 {
                counts[i] += u32::from(found[i]);
                counts[2 + i] += u32::from(found[i] && wrong[i]);
            }
        }
        counts
    }

    #[test]
    fn a_part_is_magnified_or_round_everywhere() {
        let right: OfPart = |footprint, inv_w, uv, farthest| {
            let ([p, q, r, s], [a, b, c, d]) = (inv_w, uv);
            let is_round = footprint.is_round([p, q, r], [a, b, c])
                && footprint.is_round([q, r, s], [b, c, d]);
            [footprint.longest_in(inv_w, uv, farthest) <= 1.0, is_round]
        };
        let [magnified, round, wrong, wrongly_round] = of_parts(right);
        assert_eq!([wrong, wrongly_round], [0; 2]);
        assert!(magnified > 500 && round > 500, "{magnified}, {round}");
        // Wrong ones: by two corners, and by one.
        let two: OfPart = |footprint, [p, q, ..], [a, b, ..], farthest| {
            [
                footprint.longest_in([p, q, p, q], [a, b, a, b], farthest) <= 1.0,
                footprint.is_round([p, q, p], [a, b, a]),
            ]
        };
        let one: OfPart = |footprint, [q, ..], [uv, ..], _| {
            [footprint.level(uv, 1.0 / q) <= 0.0, footprint.taps(uv, 1.0 / q, 16).count == 1]
        };
        for (number, condition) in [two, one].into_iter().enumerate() {
            let [_, _, wrong, wrongly_round] = of_parts(condition);
            assert!(wrong > 0 && wrongly_round > 0, "wrong condition {number} survives");
        }
    }
}
