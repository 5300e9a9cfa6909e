//! What a file contains, in its own right-handed coordinates, before it becomes items of a scene.

use std::collections::BTreeMap;
use std::hash::Hash;
use std::ops::Range;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3};
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::Opacity;
use rasterproof_render::pipeline::texture::Texture;

/// What a reader counts of faces with fewer than three corners, which show nothing.
pub(crate) const INCOMPLETE_FACE: &str = "incomplete face";

#[derive(Debug, Default)]
pub(crate) struct Contents {
    pub parts: Vec<FilePart>,
    /// Its materials, which parts name by their index.
    pub materials: Vec<Surface>,
    /// What the file contains and nobody draws, in the singular, with its count. A key that ends in `of material` counts
    /// materials: (`specular colour of material`, 18) and (`bump map`, 1) are shown as
    /// `specular colour of 18 materials, 1 bump map`.
    pub not_drawn: BTreeMap<String, u64>,
    /// What is missing or cannot be understood and was done without, one line each.
    pub warnings: Vec<String>,
}

/// Polygons of one material. The lists of vectors are those of the file.
#[derive(Debug, Default)]
pub(crate) struct FilePart {
    /// The name of the object, group or node; empty without one.
    pub name: String,
    pub material: Option<usize>,
    /// From the part's coordinates to those of the file.
    pub to_file: DMat4,
    pub positions: Vec<DVec3>,
    /// Normals of any length.
    pub normals: Vec<DVec3>,
    /// Texture coordinates, v up.
    pub uvs: Vec<DVec2>,
    /// A colour for each position, each channel in [0, 1], or none at all.
    pub colours: Vec<DVec3>,
    /// The numbers of the positions of all corners, one polygon after the other.
    pub corners: Vec<u32>,
    pub normal_numbers: Numbers,
    pub uv_numbers: Numbers,
    pub polygons: Polygons,
}

/// A coordinate in the precision of its file: `f32` in records of an STL, `f64` elsewhere.
pub(crate) trait Coordinate: Copy + PartialEq + Into<f64> + Send + Sync {
    type Bits: Copy + Eq + Hash + Into<u64> + Send + Sync;

    /// By which equal numbers are found: -0 and 0 have the same.
    fn bits(self) -> Self::Bits;
}

impl Coordinate for f32 {
    type Bits = u32;

    #[inline]
    fn bits(self) -> u32 {
        (self + 0.0).to_bits()
    }
}

impl Coordinate for f64 {
    type Bits = u64;

    #[inline]
    fn bits(self) -> u64 {
        (self + 0.0).to_bits()
    }
}

/// The bits of a position, by which equal ones are found.
#[inline]
pub(crate) fn key(position: DVec3) -> [u64; 3] {
    position.to_array().map(Coordinate::bits)
}

/// Stands in a list of numbers for a corner that has none.
pub(crate) const NONE: u32 = u32::MAX;

/// Which vector of a list each corner of a part has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum Numbers {
    /// No corner of the mesh has this attribute.
    #[default]
    Nothing,
    /// Each corner has the vector with the number of its position, as many files list them.
    OfPositions,
    /// For each corner the number of its vector, or [`NONE`].
    OfCorners(Vec<u32>),
}

impl Numbers {
    /// Adds the number of one more corner, after those of the positions `before`.
    #[inline]
    pub(crate) fn push(&mut self, number: u32, position: u32, before: &[u32]) {
        match self {
            Self::OfCorners(numbers) => return numbers.push(number),
            Self::Nothing if number == NONE => return,
            Self::OfPositions if number == position => return,
            Self::Nothing if before.is_empty() && number == position => *self = Self::OfPositions,
            Self::Nothing => *self = Self::OfCorners(vec![NONE; before.len()]),
            Self::OfPositions => *self = Self::OfCorners(before.to_vec()),
        }
        if let Self::OfCorners(numbers) = self {
            numbers.push(number);
        }
    }

    /// Removes all but those of the first corners.
    pub(crate) fn truncate(&mut self, corners: usize) {
        match self {
            Self::OfCorners(numbers) => numbers.truncate(corners),
            Self::OfPositions if corners == 0 => *self = Self::Nothing,
            Self::Nothing | Self::OfPositions => {}
        }
    }

    /// The number of a corner, whose position has a number too.
    #[inline]
    pub(crate) fn get(&self, corner: usize, position: u32) -> Option<u32> {
        match self {
            Self::Nothing => None,
            Self::OfPositions => Some(position),
            Self::OfCorners(numbers) => Some(numbers[corner]).filter(|&number| number != NONE),
        }
    }
}

/// Which corners of a part are a polygon: three or more, counter-clockwise seen from outside.
#[derive(Debug, Default)]
pub(crate) struct Polygons {
    count: u32,
    /// Where the corners of each polygon end; nothing while all are triangles.
    ends: Vec<u32>,
    /// The line of the file in which each polygon is, from 1; nothing where the file has no lines.
    pub lines: Vec<u32>,
    /// The polygons from which on the group of smoothing is another one, with the group. Polygons of one group above
    /// 0 share the normals that are computed for corners without one (`s` of an OBJ). Before the first entry, and
    /// with 0, such corners get the normal of the polygon.
    smoothing: Vec<(u32, u32)>,
}

impl Polygons {
    /// As many triangles, without lines.
    pub(crate) fn triangles(count: usize) -> Self {
        Self { count: count as u32, ..Self::default() }
    }

    /// Adds the polygon of the next corners. The line is 0 where the file has none.
    #[inline]
    pub(crate) fn push(&mut self, corners: usize, line: u32, smoothing: u32) {
        if corners != 3 || !self.ends.is_empty() {
            if self.ends.is_empty() {
                self.ends = (1..=self.count).map(|number| 3 * number).collect();
            }
            self.ends.push(self.ends.last().map_or(0, |end| *end) + corners as u32);
        }
        if line > 0 {
            self.lines.push(line);
        }
        if self.smoothing.last().map_or(0, |(_, group)| *group) != smoothing {
            self.smoothing.push((self.count, smoothing));
        }
        self.count += 1;
    }

    /// Adds triangles of the next corners, without lines.
    pub(crate) fn push_triangles(&mut self, count: usize) {
        if self.ends.is_empty() && self.smoothing.is_empty() {
            self.count += count as u32;
        } else {
            (0..count).for_each(|_| self.push(3, 0, 0));
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.count as usize
    }

    pub(crate) fn are_triangles(&self) -> bool {
        self.ends.is_empty()
    }

    /// The places of a polygon's corners in the list of all corners.
    #[inline]
    pub(crate) fn corners(&self, number: usize) -> Range<usize> {
        if self.ends.is_empty() {
            return 3 * number..3 * number + 3;
        }
        let start = number.checked_sub(1).map_or(0, |before| self.ends[before]);
        start as usize..self.ends[number] as usize
    }

    pub(crate) fn of_corner(&self, corner: usize) -> usize {
        if self.ends.is_empty() {
            return corner / 3;
        }
        self.ends.partition_point(|&end| end as usize <= corner)
    }

    /// The line of a polygon, from 1; 0 where the file has none.
    pub(crate) fn line(&self, number: usize) -> u32 {
        self.lines.get(number).copied().unwrap_or(0)
    }

    pub(crate) fn is_smooth(&self) -> bool {
        !self.smoothing.is_empty()
    }

    #[inline]
    pub(crate) fn smoothing(&self, number: usize) -> u32 {
        if self.smoothing.is_empty() {
            return 0;
        }
        let before = self.smoothing.partition_point(|(first, _)| *first as usize <= number);
        before.checked_sub(1).map_or(0, |entry| self.smoothing[entry].1)
    }
}

/// What a file says about a surface, as far as it is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub name: String,
    /// Diffuse colour, each channel in [0, 1].
    pub colour: DVec3,
    pub texture: Option<Arc<Texture>>,
    pub specular: Specular,
    pub opacity: Option<Opacity>,
    /// Whether the file says that light has no effect on it.
    pub unlit: bool,
    pub both_sides: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_that_were_pushed() {
        let positions = [4, 5, 4, 9];
        for pushed in [[4, 5, 4, 9], [NONE; 4], [4, 5, NONE, 9], [NONE, 5, 4, 9], [0, 5, 4, 9]] {
            let mut numbers = Numbers::default();
            for (at, (&number, &position)) in pushed.iter().zip(&positions).enumerate() {
                numbers.push(number, position, &positions[..at]);
            }
            let is_some = |number: &u32| (*number != NONE).then_some(*number);
            let got = positions.iter().enumerate().map(|(at, &p)| numbers.get(at, p));
            assert!(got.eq(pushed.iter().map(is_some)), "{pushed:?}: {numbers:?}");
        }
    }

    #[test]
    fn polygons_are_those_that_were_pushed() {
        let mut polygons = Polygons::default();
        let counts = [3, 3, 5, 3, 4];
        let groups = [0, 2, 2, 0, 1];
        for (number, (count, group)) in counts.into_iter().zip(groups).enumerate() {
            assert_eq!(polygons.are_triangles(), number < 3);
            polygons.push(count, 10 + number as u32, group);
        }
        let mut start = 0;
        for (number, (count, group)) in counts.into_iter().zip(groups).enumerate() {
            assert_eq!(polygons.corners(number), start..start + count);
            assert_eq!(polygons.of_corner(start), number);
            assert_eq!(polygons.of_corner(start + count - 1), number);
            assert_eq!(polygons.smoothing(number), group);
            assert_eq!(polygons.line(number), 10 + number as u32);
            start += count;
        }
        let two = Polygons::triangles(2);
        assert_eq!((two.len(), two.corners(1), two.of_corner(5), two.line(1)), (2, 3..6, 1, 0));
    }
}
