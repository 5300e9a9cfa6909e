//! Where a texture is plain: rectangles of texels that all have one colour.
//!
//! A texture knows of each block of 8 x 8 texels whether all have one colour, that is, whether the least and the largest of
//! each channel are equal. So a rectangle is known by its blocks, and only where it has a part of a block that is not plain, by
//! texels. A filter between equal texels gives them again, to the bit, and so does a mixture of two equal levels.

use std::ops::RangeInclusive;
use std::sync::OnceLock;

/// Texels along the side of a block.
pub(super) const BLOCK: usize = 8;

/// Of more blocks nothing is known but what holds of all.
pub(super) const MOST_BLOCKS: usize = 256;

/// More blocks than this are counted by so many of them, evenly spread.
const MOST_COUNTED: usize = 1 << 8;

/// Whether all texels of each block have one colour, row by row. The list is made when it is used for the first time.
#[derive(Debug, Default)]
pub(super) struct PlainBlocks(OnceLock<Box<[bool]>>);

impl PlainBlocks {
    /// The one colour of all texels in these columns and rows, of a texture of this width.
    pub fn colour<T: Copy + PartialEq + Into<u32>>(
        &self,
        width: usize,
        columns: &[Option<RangeInclusive<usize>>; 2],
        rows: &[Option<RangeInclusive<usize>>; 2],
        texels: &[T],
    ) -> Option<u32> {
        let blocks = self.get(width, texels);
        let across = width.div_ceil(BLOCK);
        let mut looked_at = 0;
        let mut found = None;
        for (rows, columns) in
            rows.iter().flatten().flat_map(|r| columns.iter().flatten().map(move |c| (r, c)))
        {
            let own = texels[rows.start() * width + columns.start()];
            if *found.get_or_insert(own) != own {
                return None;
            }
            for row in rows.start() / BLOCK..=rows.end() / BLOCK {
                for column in columns.start() / BLOCK..=columns.end() / BLOCK {
                    looked_at += 1;
                    if looked_at > MOST_BLOCKS {
                        return None;
                    }
                    if blocks[row * across + column] {
                        if texels[row * BLOCK * width + column * BLOCK] != own {
                            return None;
                        }
                        continue;
                    }
                    let part = |of: &RangeInclusive<usize>, block: usize| {
                        (*of.start()).max(block * BLOCK)
                            ..=(*of.end()).min(block * BLOCK + BLOCK - 1)
                    };
                    for y in part(rows, row) {
                        let line = &texels[y * width..][part(columns, column)];
                        if !all_are(own, line) {
                            return None;
                        }
                    }
                }
            }
        }
        found.map(T::into)
    }

    /// The part of the blocks that has one colour, from 0 to 1, of a texture of this width.
    pub fn part<T: Copy + PartialEq>(&self, width: usize, texels: &[T]) -> f64 {
        let blocks = self.get(width, texels);
        // An odd step meets all columns.
        let counted = blocks.iter().step_by(blocks.len().div_ceil(MOST_COUNTED) | 1);
        let plain = counted.clone().filter(|is_plain| **is_plain).count();
        plain as f64 / counted.len() as f64
    }

    fn get<T: Copy + PartialEq>(&self, width: usize, texels: &[T]) -> &[bool] {
        self.0.get_or_init(|| {
            let mut blocks = Vec::new();
            for rows in texels.chunks(BLOCK * width) {
                for left in (0..width).step_by(BLOCK) {
                    let columns = left..width.min(left + BLOCK);
                    let mut lines = rows.chunks(width).map(|row| &row[columns.clone()]);
                    blocks.push(lines.all(|line| all_are(rows[left], line)));
                }
            }
            blocks.into()
        })
    }
}

/// The least and the largest opacity of each block of a picture, row by row, and of all of it.
#[derive(Debug)]
pub(super) struct Ends {
    pub blocks: Box<[[u8; 2]]>,
    pub whole: [u8; 2],
}

impl Ends {
    pub fn of([width, height]: [usize; 2], opacity: &dyn Fn(usize, usize) -> u8) -> Self {
        let none = [u8::MAX, 0];
        let join = |[a, b]: [u8; 2], [c, d]: [u8; 2]| [a.min(c), b.max(d)];
        let across = width.div_ceil(BLOCK);
        let mut blocks = vec![none; across * height.div_ceil(BLOCK)];
        for y in 0..height {
            for x in 0..width {
                let block = &mut blocks[y / BLOCK * across + x / BLOCK];
                *block = join(*block, [opacity(x, y); 2]);
            }
        }
        let whole = blocks.iter().fold(none, |whole, block| join(whole, *block));
        Self { blocks: blocks.into(), whole }
    }
}

#[inline]
fn all_are<T: Copy + PartialEq>(texel: T, line: &[T]) -> bool {
    match <&[T; BLOCK]>::try_from(line) {
        // A comparison of memory.
        Ok(line) => *line == [texel; BLOCK],
        Err(_) => line.iter().all(|other| *other == texel),
    }
}

#[cfg(test)]
mod tests {
    use crate::pipeline::texture::{Filter, Texture, Wrap};
    use glam::DVec2;
    use rasterproof_core::arrays::MapArray as _;
    use rasterproof_core::random::Rng;

    type Condition = fn(&Texture, [DVec2; 3], f64, f64) -> bool;

    /// How many of random triangles in random textures are plain by a condition, and how many of these read two colours.
    fn tried(condition: Condition) -> [u32; 2] {
        let mut counts = [0; 2];
        for index in 0..2000 {
            let mut rng = Rng::new("plain", 1, index);
            let (width, height) = (rng.int(1, 60) as u32, rng.int(1, 60) as u32);
            let parts = rng.int(4, 30) as u32;
            let colour = |x: u32, y: u32| {
                [[200u8, 30, 20], [20, 30, 200]][((x / parts + y / parts) % 2) as usize]
            };
            let texels: Vec<_> =
                (0..width * height).map(|at| colour(at % width, at / width)).collect();
            let filter = [Filter::Nearest, Filter::Bilinear][rng.int(0, 1) as usize];
            let wrap =
                [0; 2].map(|_| [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror][rng.int(0, 2) as usize]);
            let texture = Texture::new(width, height, &texels).unwrap().with(filter, wrap);
            let texture = texture.with_mip_map();
            let from = DVec2::new(rng.signed(), rng.signed()) * 1.5;
            let size = 0.3 * rng.unit();
            let uv = [0; 3].map_array(|_| from + DVec2::new(rng.signed(), rng.signed()) * size);
            let reach = if rng.chance(2) { 3.0 * rng.unit() } else { 0.0 };
            let level = if rng.chance(2) { 3.0 * rng.unit() } else { 0.0 };
            if !condition(&texture, uv, reach, level) {
                continue;
            }
            counts[0] += 1;
            let first = texture.at(uv[0]);
            let is_other = (0..200).any(|_| {
                let (mut s, mut t) = (rng.unit(), rng.unit());
                if s + t > 1.0 {
                    (s, t) = (1.0 - s, 1.0 - t);
                }
                let corner = if rng.chance(3) { 1.0 } else { 0.0 };
                let (s, t) = if corner > 0.0 { (s.round(), 0.0) } else { (s, t) };
                let at = uv[0] + (uv[1] - uv[0]) * s + (uv[2] - uv[0]) * t;
                let beside = DVec2::new(rng.signed(), rng.signed()).normalize_or_zero() * reach;
                let at = at + beside / DVec2::new(width.into(), height.into());
                texture.at_level(at, level * rng.unit()) != first
            });
            counts[1] += u32::from(is_other);
        }
        counts
    }

    #[test]
    fn one_colour_is_read_where_a_texture_is_plain() {
        let [plain, wrong] = tried(Texture::is_plain_between);
        assert!(plain > 200 && wrong == 0, "{plain}, {wrong}");
        let corners: Condition =
            |texture, uv, _, _| uv.iter().all(|at| texture.at(*at) == texture.at(uv[0]));
        let nearest: Condition = |texture, uv, reach, level| {
            let texture = texture.clone().with(Filter::Nearest, texture.wrap);
            texture.is_plain_between(uv, reach, level)
        };
        let unmoved: Condition = |texture, uv, _, level| texture.is_plain_between(uv, 0.0, level);
        let first_level: Condition =
            |texture, uv, reach, _| texture.is_plain_between(uv, reach, 0.0);
        let level_below: Condition =
            |texture, uv, reach, level| texture.is_plain_between(uv, reach, level.floor());
        let once: Condition = |texture, uv, reach, level| {
            let texture = texture.clone().with(texture.filter, Wrap::Clamp);
            texture.is_plain_between(uv, reach, level)
        };
        let wrong = [corners, nearest, unmoved, first_level, level_below, once];
        for (number, condition) in wrong.into_iter().enumerate() {
            assert!(tried(condition)[1] > 0, "wrong condition {number} survives");
        }
    }
}
