//! What a file contains, in its own right-handed coordinates, before it becomes items of a scene.

use std::collections::{BTreeMap, HashMap};
use std::hash::Hash;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::cameras::Camera;
use crate::{LoadOptions, Warnings};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::Opacity;
use rasterproof_render::pipeline::physical::Physical;
use rasterproof_render::pipeline::punctual::PunctualLight;
use rasterproof_render::pipeline::texture::Texture;

/// What a reader counts of faces with fewer than three corners, which show nothing.
pub(crate) const INCOMPLETE_FACE: &str = "incomplete face";

/// Parts that stay as the file has them. An item of a scene takes kilobytes, however small it is, so later parts of one
/// material become one part.
const MOST_SINGLE_PARTS: usize = 1 << 12;

/// Parts, merged ones too: there is at least one for each material that is used.
const MOST_PARTS: usize = 1 << 16;

/// What a reader makes of a file, the same for all formats.
#[derive(Debug, Default)]
pub(crate) struct Contents {
    /// The file that it is read from, which all warnings name.
    pub path: PathBuf,
    /// In the order of the file, as far as parts are not merged.
    pub parts: Vec<FilePart>,
    /// In the coordinates of the file, as the lights are.
    pub cameras: Vec<Camera>,
    pub lights: Vec<PunctualLight>,
    /// The names of its animations, empty where they have none.
    pub animations: Vec<String>,
    /// The bytes of other files with vertices.
    pub other_bytes: u64,
    /// Of the parts that others are merged into their places in the list, by what has to be equal.
    pub merged: HashMap<Kind, usize>,
    /// Its materials, which parts name by their index.
    pub materials: Vec<Surface>,
    /// What the file contains and nobody draws, in the singular, with its count. A key that ends in `of material` counts
    /// materials: (`specular colour of material`, 18) and (`bump map`, 1) are shown as
    /// `specular colour of 18 materials, 1 bump map`.
    pub not_drawn: BTreeMap<String, u64>,
    /// What is missing or cannot be understood and was done without, one line each.
    pub warnings: Warnings,
}

/// What has to be equal for two parts to become one: the material, and whether there are colours, tangents and second texture
/// coordinates.
pub(crate) type Kind = (Option<usize>, [bool; 3]);

impl Contents {
    /// Empty, for a reader to fill in from this file.
    pub(crate) fn of(path: &Path) -> Self {
        Self { path: path.to_owned(), warnings: Warnings::of(path), ..Self::default() }
    }

    /// The folder in which the files are that it names.
    pub(crate) fn folder(&self) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).to_owned()
    }

    /// Counts what is not drawn, by a key in the singular.
    pub(crate) fn count(&mut self, key: &str, count: u64) {
        if count > 0 {
            *self.not_drawn.entry(key.to_owned()).or_default() += count;
        }
    }

    /// Adds a part; many parts become few. An error in words where that cannot be.
    pub(crate) fn add(&mut self, mut part: FilePart) -> Result<(), String> {
        if self.parts.len() < MOST_SINGLE_PARTS {
            self.parts.push(part);
            return Ok(());
        }
        part.place(part.to_file);
        part.to_file = DMat4::IDENTITY;
        let kind = part.kind();
        if let Some(&place) = self.merged.get(&kind) {
            self.parts[place].append(part);
            return Ok(());
        }
        if self.parts.len() >= MOST_PARTS {
            return Err(format!(
                "has more than {MOST_PARTS} parts of different materials: export it with fewer materials"
            ));
        }
        part.name = format!("parts from number {} on", MOST_SINGLE_PARTS + 1);
        self.merged.insert(kind, self.parts.len());
        self.parts.push(part);
        Ok(())
    }
}

/// Polygons of one material. The lists of vectors are those of the file.
#[derive(Debug, Default)]
pub(crate) struct FilePart {
    /// The name of the object, group or node; empty without one.
    pub name: String,
    /// Its number in [`Contents::materials`]; nothing for a grey one.
    pub material: Option<usize>,
    /// From the part's coordinates to those of the file.
    pub to_file: DMat4,
    pub positions: Vec<DVec3>,
    /// Normals of any length.
    pub normals: Vectors<DVec3>,
    /// Texture coordinates, v up.
    pub uvs: Vectors<DVec2>,
    /// Those of maps that are read elsewhere, for each position, or none at all.
    pub second_uvs: Vec<DVec2>,
    /// Colours of the file, or of its faces, each channel in [0, 1].
    pub colours: Vectors<DVec3>,
    /// A tangent for each position, with the sign of the bitangent, or none at all.
    pub tangents: Vec<DVec4>,
    /// The numbers of the positions of all corners, one polygon after the other.
    pub corners: Vec<u32>,
    /// Where each polygon ends, and where it comes from.
    pub polygons: Polygons,
}

/// What a map of positions does to normals. The cofactors turn them as the transposed inverse does, and exist where it does not.
pub(crate) fn of_normals(linear: DMat3) -> DMat3 {
    let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
    // A mirror turns the cofactors over.
    let sign = if linear.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
}

impl FilePart {
    /// What has to be equal for it to become one with another part.
    fn kind(&self) -> Kind {
        let lists =
            [self.colours.values.is_empty(), self.tangents.is_empty(), self.second_uvs.is_empty()];
        (self.material, lists)
    }

    /// The numbers of normals, texture coordinates and colours at the corners.
    fn numbers_mut(&mut self) -> [&mut Numbers; 3] {
        [&mut self.normals.numbers, &mut self.uvs.numbers, &mut self.colours.numbers]
    }

    /// Adds a corner by the number of its position and by those of its normal, texture coordinates and colour. Each of these is
    /// [`NONE`] where the corner has no such vector.
    #[inline]
    pub(crate) fn push(&mut self, position: u32, [normal, uv, colour]: [u32; 3]) {
        self.normals.numbers.push(normal, position, &self.corners);
        self.uvs.numbers.push(uv, position, &self.corners);
        self.colours.numbers.push(colour, position, &self.corners);
        self.corners.push(position);
    }

    /// Makes a polygon of the corners from this one on, and returns whether there are three or more. Fewer are taken away.
    pub(crate) fn end_polygon(&mut self, start: usize, line: usize, smoothing: u32) -> bool {
        let count = self.corners.len() - start;
        if count >= 3 {
            self.polygons.push(count, line as u32, smoothing);
            return true;
        }
        for numbers in self.numbers_mut() {
            numbers.truncate(start);
        }
        self.corners.truncate(start);
        false
    }

    /// Adds triangles of these positions, which have nothing else.
    pub(crate) fn push_triangles(&mut self, triangles: Vec<[u32; 3]>) {
        if self.corners.is_empty() {
            self.polygons = Polygons::triangles(triangles.len());
            self.corners = triangles.into_flattened();
            return;
        }
        for triangle in triangles {
            let start = self.corners.len();
            for position in triangle {
                self.push(position, [NONE; 3]);
            }
            self.end_polygon(start, 0, 0);
        }
    }

    /// Adds polygons of another part, by their numbers there. What its corners name comes after so many positions, normals, texture
    /// coordinates and colours of this part.
    fn take(&mut self, from: &Self, polygons: impl Iterator<Item = usize>, before: [u32; 4]) {
        let [positions, before @ ..] = before;
        let numbers = [&from.normals.numbers, &from.uvs.numbers, &from.colours.numbers];
        for polygon in polygons {
            let start = self.corners.len();
            for corner in from.polygons.corners(polygon) {
                let position = from.corners[corner];
                let moved = |at: usize| {
                    numbers[at].get(corner, position).map_or(NONE, |number| before[at] + number)
                };
                self.push(positions + position, [0, 1, 2].map_array(moved));
            }
            let line = from.polygons.line(polygon) as usize;
            self.end_polygon(start, line, from.polygons.smoothing(polygon));
        }
    }

    /// Removes polygons that are not kept, by their numbers.
    pub(crate) fn retain(&mut self, is_kept: impl Fn(&Self, usize) -> bool) {
        let kept: Vec<usize> =
            (0..self.polygons.len()).filter(|&number| is_kept(self, number)).collect();
        let old = Self {
            normals: self.normals.take_numbers(),
            uvs: self.uvs.take_numbers(),
            colours: self.colours.take_numbers(),
            corners: std::mem::take(&mut self.corners),
            polygons: std::mem::take(&mut self.polygons),
            ..Self::default()
        };
        self.take(&old, kept.into_iter(), [0; 4]);
    }

    /// Moves its positions, normals and the winding of its polygons by a matrix.
    pub(crate) fn place(&mut self, matrix: DMat4) {
        if matrix == DMat4::IDENTITY {
            return;
        }
        for position in &mut self.positions {
            *position = matrix.transform_point3(*position);
        }
        let linear = DMat3::from_mat4(matrix);
        let mirrors = linear.determinant() < 0.0;
        let of_normals = of_normals(linear);
        for normal in &mut self.normals.values {
            *normal = of_normals * *normal;
        }
        for tangent in &mut self.tangents {
            let sign = if mirrors { -tangent.w } else { tangent.w };
            *tangent = (linear * tangent.truncate()).extend(sign);
        }
        if mirrors {
            for number in 0..self.polygons.len() {
                let corners = self.polygons.corners(number);
                self.corners[corners.clone()].reverse();
                for numbers in self.numbers_mut() {
                    if let Numbers::OfCorners(numbers) = numbers {
                        numbers[corners.clone()].reverse();
                    }
                }
            }
        }
    }

    /// Adds the polygons of another part in the same coordinates and of the same kind.
    fn append(&mut self, mut other: Self) {
        let before = [
            self.positions.len(),
            self.normals.values.len(),
            self.uvs.values.len(),
            self.colours.values.len(),
        ];
        let polygons = 0..other.polygons.len();
        self.take(&other, polygons, before.map_array(|count| count as u32));
        self.normals.values.append(&mut other.normals.values);
        self.uvs.values.append(&mut other.uvs.values);
        self.colours.values.append(&mut other.colours.values);
        self.tangents.append(&mut other.tangents);
        self.second_uvs.append(&mut other.second_uvs);
        self.positions.append(&mut other.positions);
    }
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
            Self::Nothing if number == NONE => {}
            Self::OfPositions if number == position => {}
            Self::OfCorners(numbers) => numbers.push(number),
            _ => self.push_other(number, position, before),
        }
    }

    /// The same of a number that has another form than those before it.
    #[cold]
    fn push_other(&mut self, number: u32, position: u32, before: &[u32]) {
        if *self == Self::Nothing && before.is_empty() && number == position {
            *self = Self::OfPositions;
            return;
        }
        let mut numbers = match self {
            Self::OfPositions => before.to_vec(),
            _ => vec![NONE; before.len()],
        };
        numbers.push(number);
        *self = Self::OfCorners(numbers);
    }

    /// Removes all but those of the first corners.
    pub(crate) fn truncate(&mut self, corners: usize) {
        match self {
            Self::OfCorners(numbers) => numbers.truncate(corners),
            Self::OfPositions if corners == 0 => *self = Self::Nothing,
            Self::Nothing | Self::OfPositions => {}
        }
    }

    /// Takes the numbers of some corners away. The positions are those of all corners.
    pub(crate) fn remove(&mut self, corners: Range<usize>, positions: &[u32]) {
        if *self == Self::OfPositions {
            *self = Self::OfCorners(positions.to_vec());
        }
        if let Self::OfCorners(numbers) = self {
            numbers[corners].fill(NONE);
        }
    }

    /// One more than the largest number. The positions are those of all corners.
    pub(crate) fn end(&self, positions: &[u32]) -> usize {
        let numbers = match self {
            Self::Nothing => &[],
            Self::OfPositions => positions,
            Self::OfCorners(numbers) => numbers,
        };
        // That of none is 0.
        numbers.iter().map(|&number| number.wrapping_add(1)).max().unwrap_or(0) as usize
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

/// Vectors of one kind, and which of them each corner of a part has.
#[derive(Debug, Default)]
pub(crate) struct Vectors<V> {
    /// Several corners may share a value.
    pub values: Vec<V>,
    /// Which value belongs to which corner.
    pub numbers: Numbers,
}

impl<V> Vectors<V> {
    /// One vector for each position, or none at all.
    pub(crate) fn of_positions(values: Vec<V>) -> Self {
        let numbers = if values.is_empty() { Numbers::Nothing } else { Numbers::OfPositions };
        Self { values, numbers }
    }

    /// Moves the numbers to vectors without values, to give corners other numbers.
    fn take_numbers(&mut self) -> Self {
        Self { values: Vec::new(), numbers: std::mem::take(&mut self.numbers) }
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

    pub(crate) fn len(&self) -> usize {
        self.count as usize
    }

    /// Whether all polygons are triangles, so that nothing has to be cut.
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

    /// The number of the polygon that has this corner, found by bisection or by a division.
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

    /// Whether some polygon belongs to a smoothing group.
    pub(crate) fn is_smooth(&self) -> bool {
        !self.smoothing.is_empty()
    }

    /// The smoothing group of a polygon, 0 where it has none.
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
#[derive(Clone, Debug, Default)]
pub(crate) struct Surface {
    pub name: String,
    /// Diffuse colour, each channel in [0, 1].
    pub colour: DVec3,
    /// Its texels are multiplied with the colour, as glTF and MTL say it.
    pub texture: Option<Arc<Texture>>,
    pub specular: Specular,
    /// Nothing where it is opaque everywhere.
    pub opacity: Option<Opacity>,
    /// Of a surface in linear light its colour in it, and the rest. The texture, and colours of corners, are in linear light then.
    pub physical: Option<(DVec3, Arc<Physical>)>,
    /// Whether the file says that light has no effect on it.
    pub unlit: bool,
    /// Whether its back is drawn, and turned towards the light.
    pub sides: Sides,
}

impl Surface {
    /// Whether it is drawn in linear light. Gouraud shading has no fragment in which light could be encoded; what is unlit
    /// is drawn alike by every shading.
    pub fn is_linear(&self, options: LoadOptions) -> bool {
        self.physical.is_some() && (self.unlit || options.is_per_fragment())
    }
}

/// What is seen of the backs of faces, those that are clockwise as the eye sees them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Sides {
    /// Nothing: they are culled.
    Front,
    /// They are lit as the front is, by the same normals.
    #[default]
    Alike,
    /// They are lit by the reversed normals.
    Both,
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

    /// Parts of all kinds of numbers, merged: each corner has what it had.
    #[test]
    fn parts_that_are_merged_keep_their_corners() {
        let part = |seed: u32, normals: Numbers, polygon: &[(usize, u32)]| {
            let count: usize = polygon.iter().map(|(corners, _)| *corners).sum();
            let vector = |number: u32| DVec3::splat(f64::from(100 * seed + number));
            let mut polygons = Polygons::default();
            polygon.iter().for_each(|&(corners, group)| polygons.push(corners, seed, group));
            FilePart {
                positions: (0..5).map(vector).collect(),
                normals: Vectors { values: (0..7).map(vector).collect(), numbers: normals },
                corners: (0..count as u32).map(|corner| (corner * 3) % 5).collect(),
                polygons,
                ..FilePart::default()
            }
        };
        let seen = |part: &FilePart| -> Vec<(DVec3, Option<DVec3>, u32, u32)> {
            let polygons = (0..part.polygons.len()).flat_map(|number| {
                let (group, line) = (part.polygons.smoothing(number), part.polygons.line(number));
                part.polygons.corners(number).map(move |corner| (corner, group, line))
            });
            let corner = |(corner, group, line): (usize, u32, u32)| {
                let position = part.corners[corner];
                let normal = part.normals.numbers.get(corner, position);
                let normal = normal.map(|number| part.normals.values[number as usize]);
                (part.positions[position as usize], normal, group, line)
            };
            polygons.map(corner).collect()
        };
        let numbers = || {
            [
                Numbers::Nothing,
                Numbers::OfPositions,
                Numbers::OfCorners(vec![6, NONE, 0, 1, 2, 6, 5]),
            ]
        };
        for first in numbers() {
            for second in numbers() {
                for polygons in [[(3, 0), (4, 0)], [(4, 2), (3, 2)], [(3, 0), (4, 7)]] {
                    let mut all = part(1, first.clone(), &polygons);
                    let others = [
                        part(2, second.clone(), &[(3, 2), (4, 0)]),
                        part(3, first.clone(), &[(7, 0)]),
                    ];
                    let expected: Vec<_> =
                        [&all].into_iter().chain(&others).flat_map(seen).collect();
                    others.into_iter().for_each(|other| all.append(other));
                    assert_eq!(seen(&all), expected, "{first:?} {second:?} {polygons:?}");
                }
            }
        }
    }
}
