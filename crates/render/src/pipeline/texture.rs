//! Textures: nearest and bilinear lookup, repeat and clamp (the book's sections 3.3 and 11.2), and mirrored repeat.
//!
//! A coordinate is rounded to 1/256 texel before a texel is chosen, as GPUs do, so that two engines
//! that differ in the last bit of a coordinate read the same texel. The thresholds of that rounding
//! lie off simple fractions for the same reason, see [`super::depth`].
//!
//! It refuses to be empty or larger than [`MAX_SIDE_PX`] a side.

use std::sync::{Arc, LazyLock, OnceLock};

use glam::{DVec2, DVec3};

use super::depth::OFF_FRACTION;
use super::linear::{decoded, encoded_byte};
use super::plain::{Ends, PlainBlocks};
pub use super::wrap::Wrap;
use super::wrap::{within, wrapped};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::MAX_SIDE_PX;

/// How a value is read between texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum Filter {
    /// The texel that holds the point.
    #[default]
    Nearest,
    /// The four around it, weighed by 1/256.
    Bilinear,
}

/// An opaque picture that is looked up by (u, v): u right, v **up**, [0, 1] each over the picture. Copies that are read
/// differently share the texels and what is computed from them.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Texture {
    width: u32,
    height: u32,
    /// Subtexels of a row and of a column.
    subtexels: DVec2,
    #[serde(skip)]
    texels: Texels,
    /// The channel in [0, 1] of each byte.
    #[serde(skip)]
    channels: &'static [f64; 256],
    /// Beyond the borders in u and in v.
    pub wrap: [Wrap; 2],
    /// Between texels.
    pub filter: Filter,
    /// The same where it is minified.
    minified: Filter,
    /// Whether the nearest level is read alone, where others mix two.
    has_single_levels: bool,
    /// How often it is read at most along the longer axis of a pixel's footprint ([`super::footprint`]).
    pub anisotropy: u8,
    /// Its mip map: smaller and smaller pictures, down to one texel; empty without one. A texture that has none and is filtered
    /// in another way where it is minified has itself as its only level.
    levels: Vec<Texture>,
    #[serde(skip)]
    derived: Arc<Derived>,
}

/// What is computed from the texels when it is first asked for, once for all copies of a texture.
#[derive(Debug, Default)]
struct Derived {
    plain: PlainBlocks,
    /// What plans ask of a map of opacities.
    ends: OnceLock<Ends>,
    /// The levels of the mip map, read as a texture is where nothing else is said.
    levels: OnceLock<Vec<Texture>>,
    /// Of copies whose bytes stand for other channels.
    otherwise: OnceLock<Arc<Derived>>,
}

/// What is computed from the texels makes no difference.
impl PartialEq for Derived {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Texels row by row from the top, as bytes. A table turns them into channels in [0, 1]: doubles would take
/// seven times the memory.
#[derive(Clone, Debug, PartialEq)]
enum Texels {
    /// Red the lowest byte.
    Colour(Arc<[u32]>),
    /// One byte for all three channels.
    Grey(Arc<[u8]>),
}

/// Boxes of colours that are listed at most.
pub const MOST_PLACES: usize = 1 << 8;

/// Subtexels in a texel, as a power of two: shifts and masks are floors and remainders.
const SUBTEXEL_BITS: u32 = 8;
const SUBTEXELS: i64 = 1 << SUBTEXEL_BITS;

/// The channel in [0, 1] of each byte.
static CHANNELS: [f64; 256] = {
    let mut channels = [0.0; 256];
    let mut byte = 0;
    while byte < 256 {
        channels[byte] = byte as f64 / 255.0;
        byte += 1;
    }
    channels
};

/// The same in linear light, of a picture that is encoded as sRGB.
static DECODED: LazyLock<[f64; 256]> = LazyLock::new(|| CHANNELS.map(decoded));

impl Texture {
    /// A texture from rows of 8-bit red, green, blue, the top row first. Nothing if a side is 0 or
    /// exceeds [`MAX_SIDE_PX`], or the number of texels is not width times height.
    #[must_use]
    pub fn new(width: u32, height: u32, rgb: &[[u8; 3]]) -> Option<Self> {
        let sides = 1..=MAX_SIDE_PX;
        let fits = sides.contains(&width) && sides.contains(&height);
        if !fits || rgb.len() != width as usize * height as usize {
            return None;
        }
        let bytes = rgb.iter().map(|&[r, g, b]| u32::from_le_bytes([r, g, b, 0])).collect();
        Some(Self::of(width, height, Texels::Colour(bytes)))
    }

    /// The same of grey texels, which take a quarter of the memory.
    #[must_use]
    pub fn grey(width: u32, height: u32, grey: Vec<u8>) -> Option<Self> {
        let sides = 1..=MAX_SIDE_PX;
        let fits = sides.contains(&width) && sides.contains(&height);
        (fits && grey.len() == width as usize * height as usize)
            .then(|| Self::of(width, height, Texels::Grey(grey.into())))
    }

    #[must_use]
    pub fn white() -> Self {
        Self::of(1, 1, Texels::Colour([0xff_ffff].into()))
    }

    fn of(width: u32, height: u32, texels: Texels) -> Self {
        let subtexels = DVec2::new(f64::from(width), f64::from(height)) * SUBTEXELS as f64;
        Self {
            width,
            height,
            subtexels,
            texels,
            channels: &CHANNELS,
            wrap: [Wrap::Repeat; 2],
            filter: Filter::Nearest,
            minified: Filter::Nearest,
            has_single_levels: false,
            anisotropy: 1,
            levels: Vec::new(),
            derived: Arc::default(),
        }
    }

    /// The same read in linear light: its bytes are taken as encoded by sRGB.
    #[must_use]
    pub fn decoded(self) -> Self {
        self.by(&DECODED)
    }

    /// The same with its bytes read as they are.
    #[must_use]
    pub fn as_stored(self) -> Self {
        self.by(&CHANNELS)
    }

    fn by(self, channels: &'static [f64; 256]) -> Self {
        if std::ptr::eq(channels, self.channels) {
            return self;
        }
        let derived = Arc::clone(self.derived.otherwise.get_or_init(Arc::default));
        Self { channels, levels: Vec::new(), derived, ..self.clone() }.as_read(&self)
    }

    /// The same, read differently.
    #[must_use]
    pub fn with(mut self, filter: Filter, wrap: impl Into<[Wrap; 2]>) -> Self {
        let wrap = wrap.into();
        self.levels = self.levels.into_iter().map(|level| level.with(filter, wrap)).collect();
        Self { wrap, filter, minified: filter, ..self }
    }

    /// The same, filtered in this way where it is minified, by its mip map if it has one.
    #[must_use]
    pub fn with_minified(mut self, minified: Filter) -> Self {
        if self.levels.is_empty() && minified != self.filter {
            self.levels.push(self.clone());
        }
        let wrap = self.wrap;
        self.levels = self.levels.into_iter().map(|level| level.with(minified, wrap)).collect();
        Self { minified, ..self }
    }

    /// The same, of which the nearest level is read alone in place of a mixture of two.
    #[must_use]
    pub fn with_single_levels(self) -> Self {
        Self { has_single_levels: true, ..self }
    }

    /// The same, read up to so many times along the longer axis of a footprint.
    #[must_use]
    pub fn with_anisotropy(self, anisotropy: u8) -> Self {
        Self { anisotropy, ..self }
    }

    /// The same with a mip map: each level has half the side, and each of its texels the mean of the four that it
    /// covers, in whole steps, halves upwards. Along a side that is odd it covers three, two of them in part, so that nothing moves.
    #[must_use]
    pub fn with_mip_map(mut self) -> Self {
        let levels = self.derived.levels.get_or_init(|| {
            let next = |last: &Self| (last.size() != (1, 1)).then(|| last.half());
            std::iter::successors(next(&self), next).collect()
        });
        let level = |level: &Self| level.clone().with(self.minified, self.wrap);
        self.levels = levels.iter().map(level).collect();
        Self { has_single_levels: false, ..self }
    }

    /// The same, read as another texture is.
    #[must_use]
    pub fn as_read(self, like: &Self) -> Self {
        let texture = self.with(like.filter, like.wrap);
        let texture = match like.levels.first() {
            Some(level) if level.size() != like.size() => texture.with_mip_map(),
            _ => texture,
        };
        let texture = texture.with_minified(like.minified);
        Self { has_single_levels: like.has_single_levels, anisotropy: like.anisotropy, ..texture }
    }

    /// Its mip map, from the second level on.
    pub(super) fn levels(&self) -> &[Self] {
        &self.levels
    }

    #[must_use]
    pub fn has_mip_map(&self) -> bool {
        !self.levels.is_empty()
    }

    /// The next level of a mip map: each texel is the mean of those that it covers, in linear light where it is read so.
    fn half(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        // The texels that one of the next level covers, with how much of each it does.
        let part = |at: u32, half: u32, whole: u32| {
            let (first, end) = (at * whole, (at + 1) * whole);
            let unit = if whole.is_multiple_of(2) { half } else { 1 };
            (first / half..end.div_ceil(half)).map(move |texel| {
                (texel, (end.min((texel + 1) * half) - first.max(texel * half)) / unit)
            })
        };
        let is_linear = !std::ptr::eq(self.channels, &CHANNELS);
        let mean = |x: u32, y: u32, channel: u32| -> u32 {
            let (mut sum, mut count, mut light) = (0u64, 0u64, 0.0);
            for (row, high) in part(y, height, self.height) {
                for (column, wide) in part(x, width, self.width) {
                    let at = row as usize * self.width as usize + column as usize;
                    let byte = match &self.texels {
                        Texels::Colour(bytes) => bytes[at] >> (8 * channel) & 0xff,
                        Texels::Grey(bytes) => bytes[at].into(),
                    };
                    let area = u64::from(high) * u64::from(wide);
                    light += self.channels[byte as usize] * area as f64;
                    sum += u64::from(byte) * area;
                    count += area;
                }
            }
            if is_linear {
                return encoded_byte(light / count as f64).into();
            }
            ((2 * sum + count) / (2 * count)) as u32
        };
        let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let texels = match &self.texels {
            Texels::Colour(_) => Texels::Colour(
                all.map(|(x, y)| mean(x, y, 0) | mean(x, y, 1) << 8 | mean(x, y, 2) << 16)
                    .collect(),
            ),
            Texels::Grey(_) => Texels::Grey(all.map(|(x, y)| mean(x, y, 0) as u8).collect()),
        };
        Self { channels: self.channels, ..Self::of(width, height, texels) }
    }

    /// The colour at (u, v) at a level of detail: between the two levels of the mip map or of the nearer one, or the texture
    /// itself at levels up to 0 and for NaN. The thresholds between levels lie off simple fractions, as others do.
    #[must_use]
    pub fn at_level(&self, uv: DVec2, level: f64) -> DVec3 {
        let is_minified = level > if self.minified == self.filter { 0.0 } else { OFF_FRACTION };
        if self.levels.is_empty() || !is_minified {
            return self.at(uv);
        }
        let mut level = level.min(self.levels.len() as f64);
        if self.has_single_levels {
            level = (level + (0.5 - OFF_FRACTION)).floor();
        }
        let (number, part) = (level as usize, level.fract());
        let read = |number: usize| match number {
            0 => self.read(uv, self.minified),
            number => self.levels[number - 1].at(uv),
        };
        let near = read(number);
        if part == 0.0 { near } else { near + (read(number + 1) - near) * part }
    }

    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The texels as bytes, red the lowest, row by row from the top, where masks and limits alone say
    /// which one is read: for who reads many at once. Nothing of a grey one.
    #[must_use]
    pub fn nearest_bytes(&self) -> Option<&[u32]> {
        let is_simple = |(wrap, side): (Wrap, u32)| match wrap {
            Wrap::Repeat => side.is_power_of_two(),
            Wrap::Clamp => true,
            Wrap::Mirror => false,
        };
        let sides = [(self.wrap[0], self.width), (self.wrap[1], self.height)];
        let simple = self.filter == Filter::Nearest && sides.into_iter().all(is_simple);
        match &self.texels {
            Texels::Colour(bytes) if simple => Some(bytes),
            _ => None,
        }
    }

    /// The colour at (u, v), each channel in [0, 1]. NaN reads as 0, infinities as the border.
    #[must_use]
    #[inline]
    pub fn at(&self, uv: DVec2) -> DVec3 {
        self.read(uv, self.filter)
    }

    #[inline]
    fn read(&self, uv: DVec2, filter: Filter) -> DVec3 {
        let [x, y] = [subtexel(uv.x, self.subtexels.x), subtexel(1.0 - uv.y, self.subtexels.y)];
        self.at_subtexel(x, y, filter)
    }

    /// Between two texels of the row that begins at `start`. Called in place: a call takes as long.
    #[inline(always)]
    fn between_columns(&self, start: usize, columns: [usize; 2], right: f64) -> DVec3 {
        let [a, b] = [self.texel(start + columns[0]), self.texel(start + columns[1])];
        a + (b - a) * right
    }

    /// The colour at whole numbers of 1/256 texel from the top left corner. Called in place, as [`Self::between_columns`].
    #[inline(always)]
    fn at_subtexel(&self, x: i64, y: i64, filter: Filter) -> DVec3 {
        match filter {
            Filter::Nearest => {
                let column = self.column(x >> SUBTEXEL_BITS);
                self.texel(self.row_start(y >> SUBTEXEL_BITS) + column)
            }
            Filter::Bilinear => {
                // Texel centres carry the values, so half a texel lies before the first.
                let (x, y) = (x - SUBTEXELS / 2, y - SUBTEXELS / 2);
                let (column, row) = (x >> SUBTEXEL_BITS, y >> SUBTEXEL_BITS);
                let columns = [self.column(column), self.column(column + 1)];
                let part = |sub: i64| (sub & (SUBTEXELS - 1)) as f64 / SUBTEXELS as f64;
                let (right, down) = (part(x), part(y));
                let a = self.between_columns(self.row_start(row), columns, right);
                let b = self.between_columns(self.row_start(row + 1), columns, right);
                a + (b - a) * down
            }
        }
    }

    /// All colours that [`Self::at`] gives to coordinates within `bound` of (u, v), as boxes of colours: the
    /// least and the largest of each channel. A box holds one colour, for every place that is read, where
    /// these are at most [`MOST_PLACES`]; else what a filter makes of the same four texels. Nothing where
    /// there are more than [`MOST_PLACES`] of these too.
    #[must_use]
    pub fn within(&self, uv: DVec2, bound: DVec2) -> Option<Vec<[DVec3; 2]>> {
        // A coordinate is subtracted from 1, multiplied and moved by half a step: three roundings, each of
        // at most half of EPSILON.
        let ends = |coordinate: f64, bound: f64, side: f64| {
            let rounding = 2.0 * f64::EPSILON * (1.0 + coordinate.abs() + bound) * (side + 1.0);
            [-1.0, 1.0].map_array(|sign: f64| {
                let end = (coordinate + sign * bound) * side + sign * rounding;
                floor(end + (0.5 + OFF_FRACTION))
            })
        };
        let columns = ends(uv.x, bound.x, self.subtexels.x);
        let rows = ends(1.0 - uv.y, bound.y, self.subtexels.y);
        match self.filter {
            Filter::Nearest => self.boxes(columns, rows, SUBTEXELS, 0),
            Filter::Bilinear => self
                .boxes(columns, rows, 1, 0)
                .or_else(|| self.boxes(columns, rows, SUBTEXELS, SUBTEXELS / 2)),
        }
    }

    /// The colours of a rectangle of subtexels, cut at whole multiples of `step` from `start`.
    fn boxes(
        &self,
        columns: [i64; 2],
        rows: [i64; 2],
        step: i64,
        start: i64,
    ) -> Option<Vec<[DVec3; 2]>> {
        let parts = |[first, last]: [i64; 2]| {
            let [a, b] = [first, last].map_array(|end| (end - start).div_euclid(step));
            let part = move |number: i64| {
                let from = number * step + start;
                [from.max(first), (from + step - 1).min(last)]
            };
            (b.checked_sub(a)? < MOST_PLACES as i64).then(|| (a..=b).map(part))
        };
        let (columns, rows) = (parts(columns)?, parts(rows)?);
        if columns.clone().count() * rows.clone().count() > MOST_PLACES {
            return None;
        }
        Some(columns.flat_map(|x| rows.clone().map(move |y| self.between(x, y))).collect())
    }

    /// The least and the largest of each channel over subtexels that read the same texels.
    fn between(&self, [x0, x1]: [i64; 2], [y0, y1]: [i64; 2]) -> [DVec3; 2] {
        let [[a, b], [c, d]] =
            [y0, y1].map_array(|y| [x0, x1].map_array(|x| self.at_subtexel(x, y, self.filter)));
        let (least, most) = (a.min(b).min(c).min(d), a.max(b).max(c).max(d));
        if self.filter == Filter::Nearest || (x0, y0) == (x1, y1) {
            return [least, most];
        }
        // What is linear along either axis has its extremes at corners. A read of channels up to 1 is
        // rounded nine times, each by at most half of EPSILON; so is the corner that it is compared with.
        let rounding = DVec3::splat(9.0 * f64::EPSILON);
        [least - rounding, most + rounding]
    }

    /// The first and the last column and row of the texels that are read at coordinates between three, minified or not, counted
    /// beyond the borders too; all of them where a coordinate is far out.
    ///
    /// An engine's coordinate is off by at most 2^-53 (15 D + 2 M)
    /// (`comparison::tolerance` of the crate `verify`), and it is rounded three times before a texel is chosen,
    /// all together less than the margin.
    pub(super) fn texels_between(&self, uv: [DVec2; 3]) -> [[i64; 2]; 2] {
        let ends = |[a, b, c]: [f64; 3], subtexels: f64| {
            let most = a.abs().max(b.abs()).max(c.abs());
            // NaN is not small, and a maximum leaves it out.
            if !(most < 1e9 && (a + b + c).is_finite()) {
                return [0, subtexels as i64 / SUBTEXELS - 1];
            }
            let margin = 64.0 * f64::EPSILON * (1.0 + most);
            let [first, last] = [a.min(b).min(c) - margin, a.max(b).max(c) + margin]
                .map_array(|end| subtexel(end, subtexels));
            match [self.filter, self.minified] {
                [Filter::Nearest, Filter::Nearest] => {
                    [first >> SUBTEXEL_BITS, last >> SUBTEXEL_BITS]
                }
                _ => [
                    (first - SUBTEXELS / 2) >> SUBTEXEL_BITS,
                    ((last - SUBTEXELS / 2) >> SUBTEXEL_BITS) + 1,
                ],
            }
        };
        let (u, v) = (uv.map_array(|uv| uv.x), uv.map_array(|uv| 1.0 - uv.y));
        [ends(u, self.subtexels.x), ends(v, self.subtexels.y)]
    }

    /// Whether one colour is read at all coordinates between three, and up to `reach` texels beside them, at each level of detail
    /// up to `level`.
    #[must_use]
    pub fn is_plain_between(&self, uv: [DVec2; 3], reach: f64, level: f64) -> bool {
        let levels = (level.ceil() as usize).min(self.levels.len());
        let Some(colour) = self.plain_colour(uv, reach) else { return false };
        self.levels[..levels].iter().enumerate().all(|(i, texture)| {
            let reach = reach / f64::from(2u32 << i.min(30));
            texture.plain_colour(uv, reach) == Some(colour)
        })
    }

    /// The one colour of all texels that are read at coordinates between three, and up to `reach` texels beside them.
    fn plain_colour(&self, uv: [DVec2; 3], reach: f64) -> Option<u32> {
        // The coordinate of a tap is rounded too, by far less than a texel.
        let reach = if reach > 0.0 { reach.ceil() as i64 + 1 } else { 0 };
        let [columns, rows] =
            self.texels_between(uv).map_array(|[first, last]| [first - reach, last + reach]);
        let columns = within(self.wrap[0], columns, self.width.into());
        let rows = within(self.wrap[1], rows, self.height.into());
        match &self.texels {
            Texels::Colour(bytes) => {
                self.derived.plain.colour(self.sides()[0], &columns, &rows, bytes)
            }
            Texels::Grey(bytes) => {
                self.derived.plain.colour(self.sides()[0], &columns, &rows, bytes)
            }
        }
    }

    /// The part of its squares of 8 x 8 texels that has one colour, from 0 to 1.
    #[must_use]
    pub fn plain_part(&self) -> f64 {
        match &self.texels {
            Texels::Colour(bytes) => self.derived.plain.part(self.sides()[0], bytes),
            Texels::Grey(bytes) => self.derived.plain.part(self.sides()[0], bytes),
        }
    }

    fn sides(&self) -> [usize; 2] {
        [self.width as usize, self.height as usize]
    }

    /// The least and the largest byte of the red channel, in each block and in all.
    pub(super) fn ends(&self) -> &Ends {
        let red = |column: usize, row: usize| {
            let at = row * self.width as usize + column;
            match &self.texels {
                Texels::Colour(bytes) => bytes[at] as u8,
                Texels::Grey(bytes) => bytes[at],
            }
        };
        self.derived.ends.get_or_init(|| Ends::of(self.sides(), &red))
    }

    /// The least and the largest of each channel in the whole texture.
    #[must_use]
    pub fn range(&self) -> [DVec3; 2] {
        let all = (0..self.width as usize * self.height as usize).map(|at| self.texel(at));
        let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        all.fold(none, |[least, most], texel| [least.min(texel), most.max(texel)])
    }

    #[inline]
    fn texel(&self, at: usize) -> DVec3 {
        match &self.texels {
            Texels::Colour(bytes) => {
                let [red, green, blue, _] = bytes[at].to_le_bytes();
                DVec3::from([red, green, blue].map_array(|byte| self.channels[usize::from(byte)]))
            }
            Texels::Grey(bytes) => DVec3::splat(self.channels[usize::from(bytes[at])]),
        }
    }

    #[inline]
    fn column(&self, column: i64) -> usize {
        wrapped(self.wrap[0], column, self.width.into()) as usize
    }

    #[inline]
    fn row_start(&self, row: i64) -> usize {
        wrapped(self.wrap[1], row, self.height.into()) as usize * self.width as usize
    }
}

/// A coordinate in 1/256 texel, where a side has so many of them.
#[inline]
fn subtexel(coordinate: f64, side: f64) -> i64 {
    floor(coordinate * side + (0.5 + OFF_FRACTION))
}

/// The largest whole number that is not larger; of NaN 0, and of numbers far out their quarter range,
/// which keeps sums in range.
#[inline]
fn floor(x: f64) -> i64 {
    /// 1.5 times 2^52: in sums with it the last bit counts ones.
    const ONES: f64 = (3u64 << 51) as f64;
    if x.abs() < (1u64 << 51) as f64 {
        // The nearest whole number stands in the last bits. Without a call, as machines without an
        // instruction for floors need, and without the checks of a conversion.
        let sum = x + ONES;
        let nearest = sum.to_bits() as i64 - ONES.to_bits() as i64;
        return nearest - i64::from(sum - ONES > x);
    }
    let limit = (i64::MAX / 4) as f64;
    // `as` takes NaN to 0.
    x.floor().clamp(-limit, limit) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_by_two() -> Texture {
        let (r, g, b, w) = ([255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]);
        Texture::new(2, 2, &[r, g, b, w]).unwrap()
    }

    #[test]
    fn grey_is_read_as_three_equal_channels() {
        let bytes: Vec<u8> = (0..48).map(|i| i * 5).collect();
        let rgb: Vec<[u8; 3]> = bytes.iter().map(|&byte| [byte; 3]).collect();
        let colour = Texture::new(8, 6, &rgb).unwrap();
        let grey = Texture::grey(8, 6, bytes).unwrap();
        assert_eq!(colour.range(), grey.range());
        for filter in [Filter::Nearest, Filter::Bilinear] {
            let [colour, grey] =
                [&colour, &grey].map(|texture| texture.clone().with(filter, Wrap::Repeat));
            for i in 0..1000 {
                let uv = DVec2::new(f64::from(i) * 0.0173, 2.0 - f64::from(i) * 0.0311);
                assert_eq!(colour.at(uv), grey.at(uv));
            }
        }
        assert_eq!(Texture::grey(8, 6, vec![0; 47]), None);
    }

    #[test]
    fn v_points_up() {
        let texture = two_by_two();
        assert_eq!(texture.at(DVec2::new(0.1, 0.9)), DVec3::X);
        assert_eq!(texture.at(DVec2::new(0.9, 0.9)), DVec3::Y);
        assert_eq!(texture.at(DVec2::new(0.1, 0.1)), DVec3::Z);
        assert_eq!(texture.at(DVec2::new(0.9, 0.1)), DVec3::ONE);
    }

    #[test]
    fn beyond_the_border() {
        let texture = two_by_two();
        assert_eq!(texture.at(DVec2::new(1.1, -0.9)), DVec3::Z);
        let texture = texture.with(Filter::Nearest, Wrap::Clamp);
        assert_eq!(texture.at(DVec2::new(1.1, -0.9)), DVec3::ONE);
        for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
            for wrap in [Wrap::Clamp, Wrap::Repeat, Wrap::Mirror] {
                let texture = two_by_two().with(Filter::Bilinear, wrap);
                assert!(texture.at(DVec2::new(odd, odd)).is_finite());
            }
        }
    }

    /// Coordinates within a bound are tried one by one, far out and nearby.
    #[test]
    fn all_colours_within_a_bound_are_listed() {
        let numbers: Vec<[u8; 3]> = (0..=255).map(|i| [i, 255 - i, i / 2]).collect();
        for filter in [Filter::Nearest, Filter::Bilinear] {
            for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
                let texture = Texture::new(16, 16, &numbers).unwrap().with(filter, wrap);
                let mut several = 0;
                for (i, far) in [0.37, -2.2, 1e6, -3.3e9, 1e10, 1e12].into_iter().enumerate() {
                    let centre = DVec2::new(far + i as f64 / 7.0, 0.3 - far);
                    let bound = (centre.abs() + 1.0) * 1e-13;
                    let Some(colours) = texture.within(centre, bound) else {
                        assert!(far > 1e11);
                        continue;
                    };
                    several += usize::from(colours.len() > 1);
                    for part in 0..=2_000 {
                        let t = f64::from(part) / 1_000.0 - 1.0;
                        for moved in [DVec2::new(t, t), DVec2::new(t, -t), DVec2::new(-t, 0.5)] {
                            let read = texture.at(centre + bound * moved);
                            let holds = |[least, most]: &[DVec3; 2]| {
                                least.cmple(read).all() && read.cmple(*most).all()
                            };
                            assert!(colours.iter().any(holds), "{far} {moved} {filter:?}");
                        }
                    }
                }
                assert!(several > 0);
                assert_eq!(texture.within(DVec2::splat(1e14), DVec2::splat(1e3)), None);
                let [least, most] = texture.range();
                assert_eq!((least, most.x), (DVec3::ZERO, 1.0));
            }
        }
    }

    #[test]
    fn bilinear_is_exact_at_centres_and_halfway() {
        let texture = two_by_two().with(Filter::Bilinear, Wrap::Clamp);
        assert_eq!(texture.at(DVec2::new(0.25, 0.75)), DVec3::X);
        assert_eq!(texture.at(DVec2::new(0.5, 0.75)), DVec3::new(0.5, 0.5, 0.0));
        assert_eq!(texture.at(DVec2::new(0.5, 0.5)), DVec3::splat(0.5));
    }

    /// A last bit of the coordinate does not change the texel where borders and centres lie.
    #[test]
    fn simple_fractions_are_no_thresholds() {
        let texture = two_by_two().with(Filter::Bilinear, Wrap::Repeat);
        for i in 1..1024 {
            let u = f64::from(i) / 1024.0;
            let read = |u: f64| texture.at(DVec2::new(u, 0.3));
            assert_eq!(read(u.next_up()), read(u.next_down()), "{u}");
        }
    }

    /// The remainder by a mask and by a division, and the floor without a call, are what they were.
    #[test]
    fn shortcuts_are_what_they_stand_for() {
        for side in 1..=70_i64 {
            for at in -300..300_i64 {
                assert_eq!(wrapped(Wrap::Repeat, at, side), at.rem_euclid(side), "{at} of {side}");
            }
        }
        for width in [1, 2, 3, 255, 16384] {
            let moderate = (-4000..4000).map(|i| f64::from(i) * 0.37 / f64::from(width));
            let odd = [-0.0, 1e300, -1e300, f64::NAN, f64::INFINITY, 5e-324, 1e15, -1e15];
            for coordinate in moderate.chain(odd) {
                let texels = coordinate * f64::from(width) * 256.0;
                let limit = (i64::MAX / 4) as f64;
                let floor = (texels + (0.5 + OFF_FRACTION)).floor().clamp(-limit, limit) as i64;
                let side = f64::from(width) * 256.0;
                assert_eq!(subtexel(coordinate, side), floor, "{coordinate} of {width}");
            }
        }
    }

    #[test]
    fn a_mip_map_halves_down_to_one_texel() {
        let bytes: Vec<[u8; 3]> = (0..15).map(|i| [i, 10 * i, 0]).collect();
        let texture = Texture::new(5, 3, &bytes).unwrap().with_mip_map();
        // 5 x 3, 2 x 1, 1 x 1: each texel covers two columns and a half, and three rows.
        assert_eq!(texture.levels.iter().map(Texture::size).collect::<Vec<_>>(), [(2, 1), (1, 1)]);
        let uv = |x: f64| DVec2::new(x, 0.5);
        // The means of columns are 5 6 7 8 9, and (5 + 6 + 7 / 2) / 2.5 = 5.8, (7 / 2 + 8 + 9) / 2.5 = 8.2.
        let red = |x: f64, level: f64| texture.at_level(uv(x), level).x * 255.0;
        let green = |x: f64| (texture.at_level(uv(x), 1.0).y * 255.0).round();
        assert_eq!([red(0.1, 1.0), red(0.9, 1.0)], [6.0, 8.0]);
        assert_eq!([green(0.1), green(0.9)], [58.0, 82.0]);
        // Of 6 and 8; the mean of 7 and the texel of level 0.
        assert_eq!([red(0.1, 2.0), red(0.1, 7.0), red(0.1, 1.5)], [7.0, 7.0, 6.5]);
        for level in [0.0, -3.0, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(texture.at_level(uv(0.3), level), texture.at(uv(0.3)));
        }
        let grey = Texture::grey(2, 2, vec![0, 10, 20, 31]).unwrap().with_mip_map();
        assert_eq!(grey.at_level(uv(0.2), 1.0), DVec3::splat(CHANNELS[15]));
        assert_eq!(texture.with(Filter::Bilinear, Wrap::Clamp).levels[1].filter, Filter::Bilinear);
    }

    /// A row of texels 0 1 2, read by its columns from -7 on.
    #[test]
    fn a_mirrored_texture_turns_back_at_its_borders() {
        let texture = Texture::grey(3, 2, vec![0, 1, 2, 10, 11, 12]).unwrap();
        let read = |wrap: [Wrap; 2], uv: DVec2| {
            (texture.clone().with(Filter::Nearest, wrap).at(uv).x * 255.0) as u8
        };
        let row = |wrap: [Wrap; 2]| {
            (-7..7).map(move |x| read(wrap, DVec2::new((f64::from(x) + 0.5) / 3.0, 0.75)))
        };
        let mirrored = [0, 0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0];
        assert!(row([Wrap::Mirror, Wrap::Clamp]).eq(mirrored));
        assert!(row([Wrap::Clamp, Wrap::Mirror]).eq([0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2]));
        // Rows from the top: one and a half heights above, the lower one is read again.
        let above = |v| read([Wrap::Clamp, v], DVec2::new(0.1, 1.75));
        assert_eq!([Wrap::Mirror, Wrap::Repeat, Wrap::Clamp].map(above), [10, 0, 0]);
        for wrap in [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror] {
            for (first, length) in (-20..20).flat_map(|first| (0..9).map(move |l| (first, l))) {
                let ends = [first, first + length];
                let found = within(wrap, ends, 3);
                for at in 0..3 {
                    let is_read = (ends[0]..=ends[1]).any(|column| wrapped(wrap, column, 3) == at);
                    let is_listed = found.iter().flatten().any(|r| r.contains(&(at as usize)));
                    // Of as many as a side has all are listed.
                    let expected = is_read || (length >= 2 && wrap != Wrap::Clamp);
                    assert_eq!(is_listed, expected, "{wrap:?} {ends:?} {at}");
                }
            }
        }
    }

    /// Columns 0, 100 and 200, 40; where it is minified, other filters and levels of the same texels.
    #[test]
    fn a_minified_texture_is_read_as_its_sampler_says() {
        let texture = Texture::grey(4, 1, vec![0, 100, 200, 40]).unwrap();
        let texture = texture.with(Filter::Nearest, Wrap::Clamp);
        let read = |texture: &Texture, level: f64| {
            (texture.at_level(DVec2::new(0.5, 0.5) - 1e-3, level).x * 255.0).round() as u8
        };
        let all = |texture: Texture| [0.0, 0.4, 0.6, 1.4, 1.6].map(|level| read(&texture, level));
        let smooth = || texture.clone().with_minified(Filter::Bilinear);
        assert_eq!(all(texture.clone()), [100; 5], "always nearest");
        // Between columns 1 and 2 lies their mean.
        assert_eq!(all(smooth()), [100, 150, 150, 150, 150]);
        // The levels are 50 and 120, then 85.
        let nearest = || texture.clone().with_mip_map();
        assert_eq!(all(nearest()), [100, 80, 70, 64, 71], "a mixture of nearest texels");
        assert_eq!(all(nearest().with_single_levels()), [100, 100, 50, 50, 85]);
        assert_eq!(all(smooth().with_mip_map()), [100, 124, 111, 85, 85]);
        let single = texture.clone().with_mip_map().with_minified(Filter::Bilinear);
        assert_eq!(all(single.with_single_levels()), [100, 150, 85, 85, 85]);
    }

    #[test]
    fn no_empty_or_wrong_size() {
        assert!(Texture::new(0, 1, &[]).is_none());
        assert!(Texture::new(2, 2, &[[0; 3]; 3]).is_none());
    }
}
