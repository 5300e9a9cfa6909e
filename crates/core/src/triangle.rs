//! What travels: vertices in the window, triangles, line segments, fragments.
//!
//! Values in, values out; nothing here computes coverage or interpolates.

use std::ops::{Add, Mul, Sub};

use crate::arrays::MapArray as _;
use crate::grid::{DOMAIN_PX, Refusal, SUBPIXELS, SubpixelPoint, snap};

/// Something that can be interpolated: a number or a vector of numbers.
///
/// Weights are `f64` throughout: products of an edge function and a weight then keep 53 bits, the
/// error bounds are about 1e-15 of the largest value, and a comparison between engines sees
/// algorithms instead of rounding. `f64` and glam's `DVec2`, `DVec3`, `DVec4` are such types.
pub trait Varying:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
    /// Makes a value number by number: `number` gets the same number of each of `values`. It is called
    /// for the first number first. For whoever computes with the numbers in another type.
    fn by_number(values: [Self; 3], number: impl FnMut([f64; 3]) -> f64) -> Self;
}

impl Varying for f64 {
    fn by_number(values: [Self; 3], mut number: impl FnMut([f64; 3]) -> f64) -> Self {
        number(values)
    }
}

macro_rules! vectors {
    ($($vector:ty),*) => {$(
        impl Varying for $vector {
            fn by_number(
                values: [Self; 3],
                mut number: impl FnMut([f64; 3]) -> f64,
            ) -> Self {
                let [a, b, c] = values.map_array(|vector| vector.to_array());
                Self::from_array(std::array::from_fn(|i| number([a[i], b[i], c[i]])))
            }
        }
    )*};
}

vectors!(glam::DVec2, glam::DVec3, glam::DVec4);

/// Smallest accepted w. With [`MAX_W`] it keeps every product of an edge function, a weight and an
/// attribute within the normal range of `f64`.
pub const MIN_W: f64 = f64::from_bits((1023 - 200) << 52);
/// Largest accepted w.
pub const MAX_W: f64 = f64::from_bits((1023 + 200) << 52);
/// Largest accepted magnitude of a depth or an attribute.
pub const MAX_VALUE: f64 = f64::from_bits((1023 + 500) << 52);

/// Why a number called `name` is refused, as a message. A position just below the end of the domain is refused
/// because it rounds to the end; the message says so.
#[must_use]
pub fn refused_number(name: &str, refusal: Refusal) -> String {
    let domain = f64::from(DOMAIN_PX);
    match refusal {
        Refusal::OutOfDomain(px) if (-domain..domain).contains(&px) => {
            format!("{name} {refusal}: rounded to 1/{SUBPIXELS} px it is {DOMAIN_PX}")
        }
        _ => format!("{name} {refusal}"),
    }
}

/// A vertex in the window.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ScreenVertex<V> {
    /// Where it is, in subpixels.
    pub position: SubpixelPoint,
    /// Depth, linear in the window (z/w).
    pub depth: f64,
    /// 1/w, positive; linear in the window.
    pub inv_w: f64,
    /// What the fragment stage wants to know, linear in space.
    pub varying: V,
}

impl<V> ScreenVertex<V> {
    /// The vertex, or the name of the number that is refused (`x`, `y`, `z`, `w`) with its reason.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn by_name(
        [x_px, y_px]: [f64; 2],
        depth: f64,
        w: f64,
        varying: V,
    ) -> Result<Self, (&'static str, Refusal)> {
        let on_grid = |name, px| snap(px).map_err(|refusal| (name, refusal));
        let position = SubpixelPoint::new(on_grid("x", x_px)?, on_grid("y", y_px)?);
        check_value(depth).map_err(|refusal| ("z", refusal))?;
        check_range(w, MIN_W, MAX_W).map_err(|refusal| ("w", refusal))?;
        Ok(Self { position, depth, inv_w: 1.0 / w, varying })
    }

    /// Snaps a position in pixels and checks depth and w.
    ///
    /// # Errors
    /// [`Refusal`] where the position has no place on the lattice, |depth| exceeds [`MAX_VALUE`]
    /// or w is not within [[`MIN_W`], [`MAX_W`]]. The varying is the caller's to check, with
    /// [`check_value`].
    pub fn new(x_px: f64, y_px: f64, depth: f64, w: f64, varying: V) -> Result<Self, Refusal> {
        Self::by_name([x_px, y_px], depth, w, varying).map_err(|(_, refusal)| refusal)
    }
}

impl<V> ScreenVertex<V> {
    /// The same with nothing that travels with it.
    #[must_use]
    #[inline]
    pub fn bare(&self) -> ScreenVertex<()> {
        let &Self { position, depth, inv_w, .. } = self;
        ScreenVertex { position, depth, inv_w, varying: () }
    }
}

impl ScreenVertex<()> {
    /// The same with something that travels with it.
    #[must_use]
    #[inline]
    pub fn with_varying<V>(self, varying: V) -> ScreenVertex<V> {
        let Self { position, depth, inv_w, varying: () } = self;
        ScreenVertex { position, depth, inv_w, varying }
    }
}

/// Checks that a depth or an attribute is finite and at most [`MAX_VALUE`] in magnitude.
///
/// # Errors
/// [`Refusal`] with the reason.
pub fn check_value(value: f64) -> Result<(), Refusal> {
    check_range(value, -MAX_VALUE, MAX_VALUE)
}

fn check_range(value: f64, min: f64, max: f64) -> Result<(), Refusal> {
    if value.is_nan() {
        Err(Refusal::NotANumber)
    } else if value.is_infinite() {
        Err(Refusal::Infinite)
    } else if value < min || value > max {
        Err(Refusal::OutOfRange { value, min, max })
    } else {
        Ok(())
    }
}

/// The three corners of a triangle, positions only.
pub type Corners = [SubpixelPoint; 3];

/// Three corners in window pixels as they were given, not snapped to the lattice: every coordinate
/// is a finite f64 in [-[`DOMAIN_PX`], [`DOMAIN_PX`]), subnormal ones included.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FreeCorners([[f64; 2]; 3]);

impl FreeCorners {
    /// Accepts `[x, y]` of each corner in pixels.
    ///
    /// ```
    /// use rasterproof_core::triangle::FreeCorners;
    /// assert!(FreeCorners::new([[0.1, 1e-300], [5.0, 0.3], [-8_388_608.0, 7.0]]).is_ok());
    /// assert!(FreeCorners::new([[0.1, 0.0], [8_388_608.0, 0.3], [2.0, 7.0]]).is_err());
    /// ```
    ///
    /// # Errors
    /// As [`check_position`], for the first coordinate that is refused.
    pub fn new(corners_px: [[f64; 2]; 3]) -> Result<Self, Refusal> {
        corners_px.as_flattened().iter().try_for_each(|&px| check_position(px))?;
        Ok(Self(corners_px))
    }

    /// `[x, y]` of each corner in pixels.
    #[must_use]
    pub fn px(&self) -> [[f64; 2]; 3] {
        self.0
    }
}

impl From<Corners> for FreeCorners {
    /// The same positions in pixels, exactly; the lattice lies in the domain.
    fn from(corners: Corners) -> Self {
        Self(corners.map_array(|corner| corner.to_px().into()))
    }
}

/// Checks that a coordinate in pixels is finite and within [-[`DOMAIN_PX`], [`DOMAIN_PX`]).
///
/// # Errors
/// [`Refusal`] with the reason.
pub fn check_position(px: f64) -> Result<(), Refusal> {
    let domain = f64::from(DOMAIN_PX);
    if px.is_nan() {
        Err(Refusal::NotANumber)
    } else if px.is_infinite() {
        Err(Refusal::Infinite)
    } else if px < -domain || px >= domain {
        Err(Refusal::OutOfDomain(px))
    } else {
        Ok(())
    }
}

/// A triangle in the window, either winding; a degenerate one covers nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ScreenTriangle<V> {
    /// Its vertices.
    pub vertices: [ScreenVertex<V>; 3],
}

impl<V: Copy> ScreenTriangle<V> {
    /// Positions of the vertices, in subpixels.
    #[must_use]
    #[inline]
    pub fn corners(&self) -> Corners {
        let [a, b, c] = &self.vertices;
        [a.position, b.position, c.position]
    }

    /// The same at w = 1, where interpolation in the window is that in space.
    #[must_use]
    #[inline]
    pub fn with_equal_w(&self) -> Self {
        // A loop: `map` is not inlined here, and that showed.
        let mut equal = *self;
        for vertex in &mut equal.vertices {
            vertex.inv_w = 1.0;
        }
        equal
    }
}

/// A run of pixels in one row, x1 exclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The row.
    pub y_px: i32,
    /// First column.
    pub x0_px: i32,
    /// One past the last column.
    pub x1_px: i32,
}

impl Span {
    /// Its number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        (i64::from(self.x1_px) - i64::from(self.x0_px)).max(0) as usize
    }
}

/// A covered pixel with the values at its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment<V> {
    /// Column.
    pub x_px: i32,
    /// Row.
    pub y_px: i32,
    /// Depth, linear in the window.
    pub depth: f64,
    /// The varying, perspective-correct for triangles, linear for lines.
    pub varying: V,
}

/// A whole pixel, by column and row. Every value is valid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PixelPoint {
    /// Column.
    pub x: i32,
    /// Row, y down.
    pub y: i32,
}

impl PixelPoint {
    /// The pixel in column x and row y.
    #[must_use]
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }
}

/// One end of a line segment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LineEnd<V> {
    /// The pixel it starts or ends in.
    pub pixel: PixelPoint,
    /// Depth, linear in the window.
    pub depth: f64,
    /// Carried along the segment linearly. For a perspective-correct line carry (1/w, v/w) and
    /// divide in the fragment stage.
    pub varying: V,
}

/// A line segment between two pixel centres, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ScreenLine<V> {
    /// First and last pixel.
    pub ends: [LineEnd<V>; 2],
}

/// A line segment with a width, which is filled like a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WideLine {
    /// The middles of both its short sides, the first end first.
    pub ends: [SubpixelPoint; 2],
    /// From one long side to the other, in subpixels and above 0: at right angles or along an axis, as the form says.
    pub width: i32,
}

crate::named! {
    /// At which point of a pixel the values of its samples are computed.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum ValuePlace {
        /// At the centre, also where the triangle does not cover it: values are extrapolated there.
        #[default]
        Centre = "centre",
        /// Each sample at its own place.
        Sample = "sample",
        /// At the centre where all samples are covered, and else at the covered sample with the least number: the rule of
        /// Direct3D 11 (functional specification, section 3.5.4).
        Centroid = "centroid",
    }
}

crate::named! {
    /// How a segment with a width becomes a polygon, by the clause of Vulkan on line segments.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum WideForm {
        /// A rectangle about the segment, cut off at right angles at its ends: the strict lines of Vulkan.
        #[default]
        Rectangle = "rectangle",
        /// As wide as that along the shorter axis, along which it is cut off, too: the lines of Vulkan that are not strict.
        Parallelogram = "parallelogram",
    }
}
