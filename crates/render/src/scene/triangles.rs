//! The triangles of a mesh, in lists of indices and values.
//!
//! A corner as a value takes 72 bytes, so five million triangles of such corners would take a gigabyte. Most meshes have
//! the same colour everywhere, and normals that corners at one position share. Each attribute is therefore stored
//! the way in which it is shared, and a corner is put together when it is read.

use std::sync::Arc;

use glam::{DVec2, DVec3, DVec4};

use super::Corner;
use rasterproof_core::arrays::MapArray as _;

/// The values of one attribute for all corners of all triangles.
#[derive(Clone, Debug)]
pub enum Attribute<V> {
    Same(V),
    /// Corners at one position share a value, which has the number of the position.
    OfPositions(Vec<V>),
    /// One value for each corner, three to a triangle.
    OfCorners(Vec<[V; 3]>),
    /// Each corner names one of the values by its number, three numbers for each triangle.
    Indexed {
        values: Vec<V>,
        indices: Vec<u32>,
    },
}

impl<V> Default for Attribute<V> {
    fn default() -> Self {
        Self::OfCorners(Vec::new())
    }
}

impl<V: Copy> Attribute<V> {
    /// The values of the corners of a triangle, whose positions have these numbers.
    #[inline]
    fn get(&self, triangle: usize, positions: [u32; 3]) -> [V; 3] {
        match self {
            Self::Same(value) => [*value; 3],
            Self::OfPositions(values) => positions.map_array(|number| values[number as usize]),
            Self::OfCorners(values) => values[triangle],
            Self::Indexed { values, indices } => {
                indices.as_chunks::<3>().0[triangle].map_array(|number| values[number as usize])
            }
        }
    }

    /// The list of a value for each corner, which is made where the values are shared.
    fn of_corners(&mut self, positions: &[[u32; 3]]) -> &mut Vec<[V; 3]> {
        if !matches!(self, Self::OfCorners(_)) {
            let all = positions.iter().enumerate();
            *self = Self::OfCorners(all.map(|(number, &of)| self.get(number, of)).collect());
        }
        match self {
            Self::OfCorners(values) => values,
            _ => unreachable!("it was made one"),
        }
    }

    /// Panics where there are not as many values as triangles.
    fn check(&self, triangles: usize) {
        let count = match self {
            Self::Same(_) | Self::OfPositions(_) => triangles,
            Self::OfCorners(values) => values.len(),
            Self::Indexed { indices, .. } => indices.len() / 3,
        };
        assert_eq!(count, triangles, "an attribute needs values for each triangle");
    }
}

/// The normals of all corners of all triangles.
#[derive(Clone, Debug)]
pub enum Normals {
    Given(Attribute<DVec3>),
    /// Those of the faces between these positions, of length 1, or 0 for a face without an area. They are computed when
    /// a triangle is read: for five million triangles they would take 120 MB, most of which no picture needs.
    Flat(Arc<Vec<DVec3>>),
}

impl Default for Normals {
    fn default() -> Self {
        Self::Given(Attribute::default())
    }
}

impl Normals {
    #[inline]
    fn get(&self, triangle: usize, positions: [u32; 3]) -> [DVec3; 3] {
        match self {
            Self::Given(values) => values.get(triangle, positions),
            Self::Flat(at) => {
                let corners = positions.map_array(|number| at[number as usize]);
                [face_normal(corners).normalize_or_zero(); 3]
            }
        }
    }

    /// The list of a normal for each corner, which is made where they are shared or computed.
    fn of_corners(&mut self, positions: &[[u32; 3]]) -> &mut Vec<[DVec3; 3]> {
        if matches!(self, Self::Flat(_)) {
            let all = positions.iter().enumerate();
            let list = all.map(|(number, &of)| self.get(number, of)).collect();
            *self = Self::Given(Attribute::OfCorners(list));
        }
        match self {
            Self::Given(values) => values.of_corners(positions),
            Self::Flat(_) => unreachable!("they were computed"),
        }
    }
}

/// The normal of a triangle that is counter-clockwise from the outside, of length twice its area. Left-handed, so it is the
/// cross product with the sign turned.
pub(super) fn face_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (c - a).cross(b - a)
}

/// Triangles by the numbers of their positions, with the attributes of their corners.
#[derive(Clone, Debug, Default)]
pub struct Triangles {
    positions: Vec<u32>,
    colours: Attribute<DVec3>,
    normals: Normals,
    uvs: Attribute<DVec2>,
    tangents: Option<Attribute<DVec4>>,
    second_uvs: Option<Attribute<DVec2>>,
}

impl Triangles {
    /// Triangles of three positions each, one after the other.
    ///
    /// # Panics
    /// If an attribute has not as many values as it says.
    #[must_use]
    pub fn new(
        mut positions: Vec<u32>,
        colours: Attribute<DVec3>,
        normals: Normals,
        uvs: Attribute<DVec2>,
    ) -> Self {
        let count = positions.len() / 3;
        positions.truncate(3 * count);
        colours.check(count);
        if let Normals::Given(values) = &normals {
            values.check(count);
        }
        uvs.check(count);
        Self { positions, colours, normals, uvs, tangents: None, second_uvs: None }
    }

    /// The same with the direction of u at each corner, of any length, and as w the sign of the bitangent n x t.
    ///
    /// # Panics
    /// As [`Self::new`].
    #[must_use]
    pub fn with_tangents(self, tangents: Attribute<DVec4>) -> Self {
        tangents.check(self.len());
        Self { tangents: Some(tangents), ..self }
    }

    /// The same with texture coordinates of maps that are read elsewhere than the colour.
    ///
    /// # Panics
    /// As [`Self::new`].
    #[must_use]
    pub fn with_second_uvs(self, uvs: Attribute<DVec2>) -> Self {
        uvs.check(self.len());
        Self { second_uvs: Some(uvs), ..self }
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.positions.len() / 3
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    #[must_use]
    pub fn positions(&self) -> &[[u32; 3]] {
        self.positions.as_chunks().0
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// If there are not so many triangles.
    #[inline]
    #[must_use]
    pub fn at(&self, triangle: usize) -> [Corner; 3] {
        let of = self.positions()[triangle];
        let (colours, normals, uvs) =
            (self.colours(triangle), self.normals(triangle), self.uvs(triangle));
        let corner = |i: usize| Corner {
            position: of[i],
            colour: colours[i],
            normal: normals[i],
            uv: uvs[i],
        };
        [corner(0), corner(1), corner(2)]
    }

    #[inline]
    pub(crate) fn colours(&self, triangle: usize) -> [DVec3; 3] {
        self.colours.get(triangle, self.positions()[triangle])
    }

    #[inline]
    pub(crate) fn normals(&self, triangle: usize) -> [DVec3; 3] {
        self.normals.get(triangle, self.positions()[triangle])
    }

    #[inline]
    pub(crate) fn uvs(&self, triangle: usize) -> [DVec2; 3] {
        self.uvs.get(triangle, self.positions()[triangle])
    }

    /// 0 where there are none.
    #[inline]
    #[must_use]
    pub fn tangents(&self, triangle: usize) -> [DVec4; 3] {
        let of = |tangents: &Attribute<DVec4>| tangents.get(triangle, self.positions()[triangle]);
        self.tangents.as_ref().map_or([DVec4::ZERO; 3], of)
    }

    /// 0 where there are none.
    #[inline]
    #[must_use]
    pub fn second_uvs(&self, triangle: usize) -> [DVec2; 3] {
        let of = |uvs: &Attribute<DVec2>| uvs.get(triangle, self.positions()[triangle]);
        self.second_uvs.as_ref().map_or([DVec2::ZERO; 3], of)
    }

    pub fn iter(&self) -> impl ExactSizeIterator<Item = [Corner; 3]> + DoubleEndedIterator + Clone {
        (0..self.len()).map(|triangle| self.at(triangle))
    }

    /// All corners, three for each triangle.
    pub fn corners(&self) -> impl Iterator<Item = Corner> + Clone {
        self.iter().flatten()
    }

    pub fn push(&mut self, corners: [Corner; 3]) {
        let before = self.positions.as_chunks().0;
        self.colours.of_corners(before).push(corners.map_array(|corner| corner.colour));
        self.normals.of_corners(before).push(corners.map_array(|corner| corner.normal));
        self.uvs.of_corners(before).push(corners.map_array(|corner| corner.uv));
        if let Some(tangents) = &mut self.tangents {
            tangents.of_corners(before).push([DVec4::ZERO; 3]);
        }
        if let Some(uvs) = &mut self.second_uvs {
            uvs.of_corners(before).push([DVec2::ZERO; 3]);
        }
        self.positions.extend(corners.map_array(|corner| corner.position));
    }

    /// Changes the corners of a triangle.
    ///
    /// # Panics
    /// If there are not so many triangles.
    pub fn change(&mut self, triangle: usize, change: impl FnOnce(&mut [Corner; 3])) {
        let mut corners = self.at(triangle);
        change(&mut corners);
        let before = self.positions.as_chunks().0;
        self.colours.of_corners(before)[triangle] = corners.map_array(|corner| corner.colour);
        self.normals.of_corners(before)[triangle] = corners.map_array(|corner| corner.normal);
        self.uvs.of_corners(before)[triangle] = corners.map_array(|corner| corner.uv);
        let of = &mut self.positions.as_chunks_mut().0[triangle];
        *of = corners.map_array(|corner| corner.position);
    }

    pub fn change_corners(&mut self, mut change: impl FnMut(&mut Corner)) {
        for triangle in 0..self.len() {
            self.change(triangle, |corners| corners.iter_mut().for_each(&mut change));
        }
    }

    /// Puts the triangles in the opposite order; the order of the corners of each one stays.
    pub fn reverse(&mut self) {
        fn reverse<V: Copy>(attribute: &mut Attribute<V>) {
            match attribute {
                Attribute::Same(_) | Attribute::OfPositions(_) => {}
                Attribute::OfCorners(values) => values.reverse(),
                Attribute::Indexed { indices, .. } => indices.as_chunks_mut::<3>().0.reverse(),
            }
        }
        self.positions.as_chunks_mut::<3>().0.reverse();
        reverse(&mut self.colours);
        if let Normals::Given(values) = &mut self.normals {
            reverse(values);
        }
        reverse(&mut self.uvs);
        self.tangents.iter_mut().for_each(reverse);
        self.second_uvs.iter_mut().for_each(reverse);
    }
}

/// Two lists are equal if their values are, in whichever form these are stored.
impl PartialEq for Triangles {
    fn eq(&self, other: &Self) -> bool {
        let rest = |of: &Self, triangle: usize| (of.tangents(triangle), of.second_uvs(triangle));
        self.len() == other.len()
            && self.iter().eq(other.iter())
            && (0..self.len()).all(|i| rest(self, i) == rest(other, i))
    }
}

/// The corners of each triangle, in whichever form they are stored.
impl serde::Serialize for Triangles {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let own = |i: usize| (self.at(i), self.tangents(i));
        match self.second_uvs {
            None => to.collect_seq((0..self.len()).map(own)),
            Some(_) => to.collect_seq((0..self.len()).map(|i| (own(i), self.second_uvs(i)))),
        }
    }
}

impl Extend<[Corner; 3]> for Triangles {
    fn extend<I: IntoIterator<Item = [Corner; 3]>>(&mut self, triangles: I) {
        triangles.into_iter().for_each(|corners| self.push(corners));
    }
}

impl FromIterator<[Corner; 3]> for Triangles {
    fn from_iter<I: IntoIterator<Item = [Corner; 3]>>(triangles: I) -> Self {
        let mut all = Self::default();
        all.extend(triangles);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(number: u32) -> DVec3 {
        DVec3::splat(f64::from(number))
    }

    /// Two triangles between four positions, whose attributes are stored in a different way each.
    fn two(normals: Normals) -> Triangles {
        let uvs = Attribute::Same(DVec2::Y);
        Triangles::new(vec![0, 1, 2, 2, 1, 3], Attribute::Same(DVec3::ONE), normals, uvs)
    }

    #[test]
    fn corners_are_the_same_however_their_values_are_stored() {
        let of_position = |[a, b, c]: [u32; 3]| [number(a), number(b), number(c)];
        let given = |values| two(Normals::Given(values));
        let by_position = given(Attribute::OfPositions((0..4).map(number).collect()));
        let by_corner =
            given(Attribute::OfCorners(vec![of_position([0, 1, 2]), of_position([2, 1, 3])]));
        let values = vec![number(3), number(2), number(1), number(0)];
        let indexed = given(Attribute::Indexed { values, indices: vec![3, 2, 1, 1, 2, 0] });
        assert_eq!(by_position, by_corner);
        assert_eq!(by_position, indexed);
        let flat = two(Normals::Flat(Arc::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE])));
        let normals: Vec<DVec3> = flat.corners().map(|corner| corner.normal).collect();
        let second = DVec3::new(1.0, 1.0, -1.0).normalize();
        assert_eq!(normals, [[DVec3::NEG_Z; 3], [second; 3]].as_flattened());
        for mut triangles in [by_position, by_corner, indexed, flat] {
            let pushed: Triangles = triangles.iter().collect();
            assert_eq!(pushed, triangles);
            let mut changed = triangles.clone();
            changed.change(1, |corners| corners[2].normal = DVec3::X);
            assert_ne!(changed, triangles);
            assert_eq!((changed.at(0), changed.at(1)[1]), (triangles.at(0), triangles.at(1)[1]));
            triangles.reverse();
            let turned: Triangles = pushed.iter().rev().collect();
            assert_eq!(triangles, turned);
        }
    }

    #[test]
    #[should_panic(expected = "an attribute needs values")]
    fn a_list_that_is_too_short_is_refused() {
        let _ = two(Normals::Given(Attribute::OfCorners(vec![[DVec3::X; 3]])));
    }
}
