//! Opacity: how much a fragment covers of what is behind it, in whole steps of 255.
//!
//! The opacity of a fragment is a factor of its material, times what a map has at the texture coordinates, rounded to a
//! step. The map is read at its full size, but at the level of detail of the colours where it has a mip map, as the fourth channel
//! of a texture of glTF does. The alpha test makes of it all or nothing: a fragment is drawn as any other if its opacity reaches the threshold, and else it
//! leaves neither colour nor depth. Of several samples a pixel each is tested by itself.
//!
//! Blending mixes the colour of a fragment with what was drawn before ([`over`]), light, highlight and fog included. A
//! fragment that is mixed writes no depth, so that it hides nothing. One of opacity 255 is drawn as any other, depth
//! and all, and one of opacity 0 is not drawn. Items that blend are drawn after all others, from the farthest to the
//! nearest by the middle of their bounding box, and the triangles of each in their own order.

use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

use glam::DVec2;

use super::depth::OFF_FRACTION;
use super::plain::{BLOCK, Ends, MOST_BLOCKS};
use super::sample::Colour;
use super::texture::{Filter, Texture, Wrap};
use super::wrap::within;
use rasterproof_core::arrays::MapArray as _;

/// How opaque a material is, and what that decides.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Opacity {
    /// Multiplies the opacity of every fragment; in [0, 1].
    pub factor: f64,
    pub map: Option<Arc<OpacityMap>>,
    pub mode: AlphaMode,
}

#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub enum AlphaMode {
    /// It is drawn from this opacity on, in [0, 1]; above 1 never.
    Test { threshold: f64 },
    /// It is mixed with what is behind it.
    Blend,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Drawn {
    #[default]
    All,
    /// Each fragment has an opacity of its own.
    Mixed,
    Nothing,
}

/// The opacity of a fragment that covers all of what is behind it.
pub const OPAQUE: u8 = u8::MAX;

/// A colour over another, each channel the nearest of the exact ones: (a c + (255 - a) b) / 255, of which none lies
/// halfway between two steps.
#[must_use]
pub fn over([r, g, b, _]: Colour, before: Colour, opacity: u8) -> Colour {
    let a = u32::from(opacity);
    let channel = |c: u8, b: u8| ((a * u32::from(c) + (255 - a) * u32::from(b) + 127) / 255) as u8;
    [channel(r, before[0]), channel(g, before[1]), channel(b, before[2]), u8::MAX]
}

/// What opacities are rounded by, in steps: far more than two engines differ, far less than a step.
const MARGIN: f64 = 1.0 / (1u64 << 32) as f64;

fn step(opacity: f64) -> f64 {
    opacity * 255.0 + (0.5 + OFF_FRACTION)
}

impl Opacity {
    /// The steps of opacity that are read at these texture coordinates.
    #[must_use]
    pub fn read(&self, uv: DVec2) -> u8 {
        step(self.factor * self.map.as_ref().map_or(1.0, |map| map.at(uv))) as u8
    }

    /// How opaque a fragment with these texture coordinates is.
    #[must_use]
    pub fn of(&self, uv: DVec2) -> u8 {
        self.mode.of(self.read(uv))
    }

    /// The same of what a mip map has there, in [0, 1].
    #[must_use]
    pub fn of_texel(&self, texel: f64) -> u8 {
        self.mode.of(step(self.factor * texel) as u8)
    }

    /// The texture whose levels are read; nothing of a map without levels.
    #[must_use]
    pub fn levels(&self) -> Option<&Texture> {
        self.map.as_ref().map(|map| &map.texture).filter(|texture| texture.has_mip_map())
    }

    /// How far beside a point and up to which level it may be read at most.
    #[must_use]
    pub fn farthest(&self) -> [f64; 2] {
        [if self.levels().is_some() { f64::INFINITY } else { 0.0 }; 2]
    }

    /// What is drawn of a triangle with these texture coordinates at its corners, where it is read up to so many texels beside
    /// a point, and up to such a level.
    ///
    /// Those of a fragment lie between, so what is read lies in the interval of the texels that
    /// [`OpacityMap::between`] finds. Product and rounding grow with the texel, and so does what becomes of an
    /// opacity: one at either end decides about all. The margin covers the roundings of a bilinear mean.
    #[must_use]
    pub fn between(&self, uv: [DVec2; 3], around: [f64; 2]) -> Drawn {
        let read = |texel: u8, margin: f64| {
            self.mode.of((step(self.factor * f64::from(texel) / 255.0) + margin) as u8)
        };
        let drawn = |[least, most]: [u8; 2]| match (read(least, -MARGIN), read(most, MARGIN)) {
            (OPAQUE, _) => Drawn::All,
            (_, 0) => Drawn::Nothing,
            _ => Drawn::Mixed,
        };
        // What other levels have makes an interval wider.
        let is_mixed = |found| drawn(found) == Drawn::Mixed;
        let of_map = |map: &Arc<OpacityMap>| map.between(uv, around, &is_mixed);
        drawn(self.map.as_ref().map_or([u8::MAX; 2], of_map))
    }
}

impl AlphaMode {
    fn of(self, opacity: u8) -> u8 {
        match self {
            Self::Blend => opacity,
            // A threshold that a file has in single precision may be a whole step and its last bit.
            Self::Test { threshold } => {
                let passes = f64::from(opacity) >= threshold * 255.0 - 1.0 / 4096.0;
                if passes { OPAQUE } else { 0 }
            }
        }
    }
}

/// A picture of opacities: the red channel of a texture, which is read as the texture is.
#[derive(Clone, Debug, PartialEq)]
pub struct OpacityMap {
    texture: Texture,
}

/// What a plan depends on: how each level is read, and its opacities as far as plans look at them.
impl serde::Serialize for OpacityMap {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Ends { blocks, whole } = self.texture.ends();
        let own = (&self.texture, blocks, whole);
        match self.texture.levels() {
            [] => own.serialize(to),
            levels => {
                (own, levels.iter().cloned().map(Self::new).collect::<Vec<_>>()).serialize(to)
            }
        }
    }
}

impl OpacityMap {
    /// All texels are looked at here, so that no frame has to.
    #[must_use]
    pub fn new(texture: Texture) -> Self {
        for level in std::iter::once(&texture).chain(texture.levels()) {
            level.ends();
        }
        Self { texture }
    }

    /// The same, read differently.
    #[must_use]
    pub fn with(self, filter: Filter, wrap: impl Into<[Wrap; 2]>) -> Self {
        Self { texture: self.texture.with(filter, wrap) }
    }

    /// The same, filtered between texels and read at levels as a texture is.
    #[must_use]
    pub fn as_read(self, like: &Texture) -> Self {
        Self::new(self.texture.as_read(like))
    }

    /// The least and the largest of each block, row by row.
    #[must_use]
    pub fn blocks(&self) -> &[[u8; 2]] {
        &self.texture.ends().blocks
    }

    /// The opacity at texture coordinates, in [0, 1].
    #[must_use]
    pub fn at(&self, uv: DVec2) -> f64 {
        self.texture.at(uv).x
    }

    /// The least and the largest texel of the blocks that a triangle with these texture coordinates at its corners
    /// reads in, up to so many texels beside a point and up to such a level, and of the whole picture where these are more than 256.
    /// No more levels are looked at when the interval of some is wide enough.
    #[must_use]
    pub fn between(
        &self,
        uv: [DVec2; 3],
        [reach, level]: [f64; 2],
        is_enough: &dyn Fn([u8; 2]) -> bool,
    ) -> [u8; 2] {
        let mut found = own_between(&self.texture, uv, reach);
        for (i, texture) in self.texture.levels().iter().take(level.ceil() as usize).enumerate() {
            if is_enough(found) {
                break;
            }
            let [least, most] = own_between(texture, uv, reach / f64::from(2u32 << i.min(30)));
            found = [found[0].min(least), found[1].max(most)];
        }
        found
    }
}

/// The least and the largest texel of one level, likewise.
fn own_between(texture: &Texture, uv: [DVec2; 3], reach: f64) -> [u8; 2] {
    let Ends { blocks: ends, whole } = texture.ends();
    if reach > f64::from(u16::MAX) {
        return *whole;
    }
    let (width, height) = texture.size();
    // The coordinate of a tap is rounded too, by far less than a texel.
    let reach = if reach > 0.0 { reach.ceil() as i64 + 1 } else { 0 };
    let [columns, rows] =
        texture.texels_between(uv).map_array(|[first, last]| [first - reach, last + reach]);
    let [across_u, along_v] = texture.wrap;
    let columns = blocks(across_u, columns, width.into());
    let rows = blocks(along_v, rows, height.into());
    let count = |ranges: &[Range<usize>; 2]| ranges[0].len() + ranges[1].len();
    if count(&columns) * count(&rows) > MOST_BLOCKS {
        return *whole;
    }
    let mut found = [u8::MAX, 0];
    for row in rows.into_iter().flatten() {
        for column in columns.iter().cloned().flatten() {
            let [least, most] = ends[row * (width as usize).div_ceil(BLOCK) + column];
            found = [found[0].min(least), found[1].max(most)];
            if found == *whole {
                // No other block changes that.
                return found;
            }
        }
    }
    found
}

/// The blocks of texels between two that are counted beyond the borders too: one range, or two where the picture
/// begins again between them.
fn blocks(wrap: Wrap, ends: [i64; 2], side: i64) -> [Range<usize>; 2] {
    let of_texels =
        |texels: RangeInclusive<usize>| texels.start() / BLOCK..texels.end() / BLOCK + 1;
    within(wrap, ends, side).map(|texels| texels.map_or(0..0, of_texels))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::random::Rng;

    /// A picture of mostly opaque and mostly clear parts with a speck here and there, a triangle in it, and how far around its
    /// fragments and up to which level it is read.
    fn case(index: u64, is_blended: bool) -> (Opacity, [DVec2; 3], [f64; 2]) {
        let mut rng = Rng::new("opacity", 1, index);
        let (width, height) = (rng.int(1, 70) as u32, rng.int(1, 70) as u32);
        let mut texels = Vec::new();
        let (one, other) = (rng.int(1, 9) as u32, rng.int(5, 40) as u32);
        for at in 0..width * height {
            let (x, y) = (at % width, at / width);
            let speck = rng.chance(400);
            let is_clear = ((x / other + y / other) % 3 == one % 3) != speck;
            texels.push(if is_clear { 0 } else { u8::MAX });
        }
        let filter = [Filter::Nearest, Filter::Bilinear][rng.int(0, 1) as usize];
        let wrap =
            [0; 2].map(|_| [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror][rng.int(0, 2) as usize]);
        let texture = Texture::grey(width, height, texels).unwrap().with(filter, wrap);
        let map = OpacityMap::new(texture);
        let factor = if rng.chance(4) { rng.unit() } else { 1.0 };
        let threshold = [0.25, 0.5, 1.0][rng.int(0, 2) as usize];
        let mode = if is_blended { AlphaMode::Blend } else { AlphaMode::Test { threshold } };
        let from = DVec2::new(rng.signed(), rng.signed()) * 3.0;
        let size = rng.unit().powi(2);
        let uv = [0; 3].map_array(|_| from + DVec2::new(rng.signed(), rng.signed()) * size);
        let around = [0; 2].map_array(|_| if rng.chance(2) { 3.0 * rng.unit() } else { 0.0 });
        let like = map.texture.clone();
        let map = if rng.chance(2) { map.as_read(&like.with_mip_map()) } else { map };
        (Opacity { factor, map: Some(Arc::new(map)), mode }, uv, around)
    }

    type Condition = fn(&Opacity, [DVec2; 3], [f64; 2]) -> Drawn;

    /// The opacities of fragments all over a triangle: at their places, and beside them at other levels.
    fn fragments(
        opacity: &Opacity,
        [a, b, c]: [DVec2; 3],
        [reach, level]: [f64; 2],
        see: &mut dyn FnMut(DVec2, u8) -> bool,
    ) -> bool {
        let texture = &opacity.map.as_ref().unwrap().texture;
        let size = DVec2::new(texture.size().0.into(), texture.size().1.into());
        let steps = (0..=40).flat_map(|i| (0..=40 - i).map(move |j| (f64::from(i), f64::from(j))));
        let mut points = steps.map(|(i, j)| a + (b - a) * (i / 40.0) + (c - a) * (j / 40.0));
        points.any(|uv| {
            let turn = DVec2::from_angle(uv.x * 1e3);
            let share = (uv.y * 1e3).fract().abs();
            let share = if share > 0.5 { 1.0 } else { share };
            let texel = texture.at_level(uv + turn * reach / size, level * share).x;
            see(uv, opacity.of(uv)) || see(uv, opacity.of_texel(texel))
        })
    }

    /// How many of random triangles a condition calls opaque or empty, and for how many of these a
    /// fragment says otherwise.
    fn tried(condition: Condition, is_blended: bool) -> [u32; 2] {
        let mut counts = [0; 2];
        for index in 0..3000 {
            let (opacity, uv, around) = case(index, is_blended);
            let drawn = condition(&opacity, uv, around);
            let wanted = match drawn {
                Drawn::Mixed => continue,
                Drawn::All => OPAQUE,
                Drawn::Nothing => 0,
            };
            counts[0] += 1;
            let is_wrong = fragments(&opacity, uv, around, &mut |_, found| found != wanted);
            counts[1] += u32::from(is_wrong);
        }
        counts
    }

    fn of_points(opacity: &Opacity, points: &[DVec2]) -> Drawn {
        let all = |wanted: u8| points.iter().all(|uv| opacity.of(*uv) == wanted);
        if all(OPAQUE) {
            Drawn::All
        } else if all(0) {
            Drawn::Nothing
        } else {
            Drawn::Mixed
        }
    }

    #[test]
    fn a_triangle_that_is_opaque_or_clear_is_so_everywhere() {
        for is_blended in [false, true] {
            let [known, wrong] = tried(Opacity::between, is_blended);
            assert!(known > 700 && wrong == 0, "{known}, {wrong}");
        }
        // Wrong ones: by the material alone (an alpha test that is wrongly left out), by the corners, by the middle,
        // by the texels that hold the points without those that a filter reads beside them, left out where any
        // texel is clear (boxes of text vanish), opaque where any is (what should be seen through it is covered), by the first
        // level, by lower levels, and without what taps read beside a fragment.
        let material: Condition =
            |opacity, uv, around| Opacity { map: None, ..opacity.clone() }.between(uv, around);
        let corners: Condition = |opacity, uv, _| of_points(opacity, &uv);
        let middle: Condition = |opacity, [a, b, c], _| of_points(opacity, &[(a + b + c) / 3.0]);
        let unfiltered: Condition = |opacity, uv, _| {
            let map = opacity.map.as_ref().unwrap();
            let nearest = map.texture.clone().with(Filter::Nearest, map.texture.wrap);
            let steps =
                (0..=40).flat_map(|i| (0..=40 - i).map(move |j| (f64::from(i), f64::from(j))));
            let [a, b, c] = uv;
            let points: Vec<_> =
                steps.map(|(i, j)| a + (b - a) * (i / 40.0) + (c - a) * (j / 40.0)).collect();
            let map = Some(Arc::new(OpacityMap::new(nearest)));
            of_points(&Opacity { map, ..opacity.clone() }, &points)
        };
        let any: Condition = |opacity, uv, around| {
            let [least, _] = opacity.map.as_ref().unwrap().between(uv, around, &|_| false);
            if least == 0 { Drawn::Nothing } else { opacity.between(uv, around) }
        };
        let one: Condition = |opacity, uv, around| {
            let [_, most] = opacity.map.as_ref().unwrap().between(uv, around, &|_| false);
            if most == OPAQUE { Drawn::All } else { opacity.between(uv, around) }
        };
        let first_level: Condition = |opacity, uv, [reach, _]| opacity.between(uv, [reach, 0.0]);
        let below: Condition =
            |opacity, uv, [reach, level]| opacity.between(uv, [reach, level.floor()]);
        let unmoved: Condition = |opacity, uv, [_, level]| opacity.between(uv, [0.0, level]);
        let wrong = [material, corners, middle, unfiltered, any, one, first_level, unmoved];
        for (number, condition) in wrong.into_iter().enumerate() {
            for is_blended in [false, true] {
                let wrong = tried(condition, is_blended)[1];
                assert!(wrong > 0, "wrong condition {number} survives, blended {is_blended}");
            }
        }
        assert!(tried(below, true)[1] > 0, "a level too few survives");
    }

    /// Every pair of channels at every opacity, against the definition in doubles, whose error is far from a half.
    #[test]
    fn a_mixture_is_the_nearest_one() {
        for a in 0..=u8::MAX {
            for c in 0..=u8::MAX {
                for b in (0..=u8::MAX).step_by(5) {
                    let [a, c, b] = [a, c, b].map(f64::from);
                    let exact = (a * c + (255.0 - a) * b) / 255.0;
                    let mixed = over([c as u8; 4], [b as u8; 4], a as u8);
                    assert_eq!(mixed, [exact.round() as u8, mixed[1], mixed[2], 255]);
                }
            }
        }
        let (colour, before) = ([10, 20, 30, 255], [200, 0, 90, 255]);
        assert_eq!([over(colour, before, 0), over(colour, before, 255)], [before, colour]);
    }

    #[test]
    fn thresholds_by_hand() {
        let map = OpacityMap::new(Texture::grey(2, 1, vec![127, 128]).unwrap());
        let opacity = |threshold: f64| Opacity {
            factor: 1.0,
            map: Some(Arc::new(map.clone())),
            mode: AlphaMode::Test { threshold },
        };
        let [left, right] = [0.25, 0.75].map(|u| DVec2::new(u, 0.5));
        assert_eq!([left, right].map(|uv| opacity(0.5).of(uv)), [0, OPAQUE], "127.5 is between");
        // A last bit of single precision above 127 steps.
        let single = f64::from((127.0f32 / 255.0).next_up());
        assert_eq!(opacity(single).of(left), OPAQUE);
        assert_eq!(opacity(0.0).between([left; 3], [0.0; 2]), Drawn::All);
        assert_eq!(opacity(1.5).between([right; 3], [0.0; 2]), Drawn::Nothing);
        assert_eq!(opacity(0.5).between([left, right, left], [0.0; 2]), Drawn::Mixed);
        let far = DVec2::new(f64::INFINITY, f64::NAN);
        assert_eq!(opacity(0.5).between([left, right, far], [0.0; 2]), Drawn::Mixed);
        let half = Opacity { factor: 0.5, map: None, ..opacity(0.5) };
        assert_eq!((half.read(left), half.of(left)), (128, OPAQUE));
    }
}
