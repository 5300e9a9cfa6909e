//! The lattice that positions live on: 1/256 of a pixel, x right, y down.
//!
//! Pixel (i, j) is the square [i, i+1) x [j, j+1) and is sampled at its centre (i + 1/2, j + 1/2).
//! Snapping a float to this lattice is the only rounding a position ever meets; what comes after is
//! integer arithmetic. Snapping is round-half-to-even, as the recorded Vulkan drivers do
//! (`tests/data/vulkan-snap.*`). This module is shared by the engines and the oracle, so a mistake
//! here would be invisible to their comparison: it is pinned by hand-computed cases instead.
//!
//! It refuses, with a reason, what has no place on the lattice: NaN, infinities and coordinates
//! beyond the domain. It never wraps and never saturates.

use std::fmt;

/// Bits of a coordinate below the pixel.
pub const SUBPIXEL_BITS: u32 = 8;
/// Subpixels per pixel, S = 2^s.
pub const SUBPIXELS: i32 = 1 << SUBPIXEL_BITS;
/// From a pixel's corner to its centre, in subpixels.
pub const HALF_PIXEL: i32 = SUBPIXELS / 2;
/// The domain of positions is [-DOMAIN_PX, DOMAIN_PX) pixels: every `i32` is a valid coordinate.
pub const DOMAIN_PX: i32 = 1 << (31 - SUBPIXEL_BITS);
/// The largest window side that is accepted anywhere, in pixels.
pub const MAX_SIDE_PX: u32 = 1 << 14;

// A coordinate has 23 bits before the point and 8 behind it. Extents are at most 2^32 - 1 subpixels,
// so an edge function and twice the area stay below 2^64 in magnitude and need 66 signed bits: i128
// is always enough, and i64 is enough while the two extents multiply to less than 2^63.
const MAX_EXTENT: i128 = i32::MAX as i128 - i32::MIN as i128;
const _: () = assert!(DOMAIN_PX >= 1 << 15, "the domain reaches at least 2^15 px");
const _: () = assert!(DOMAIN_PX as i64 * SUBPIXELS as i64 == i32::MAX as i64 + 1);
const _: () =
    assert!(MAX_EXTENT * MAX_EXTENT < 1 << 64, "an edge function has at most 64 bits and a sign");
const _: () = assert!(2 * MAX_EXTENT * MAX_EXTENT < i128::MAX / 4, "sums of two products fit i128");
const _: () = assert!(
    (MAX_EXTENT + SUBPIXELS as i128) * (MAX_EXTENT + SUBPIXELS as i128) > i64::MAX as i128,
    "the widest triangles really need i128"
);

/// A position on the lattice in subpixels (1/256 px), y down. Every value is valid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
pub struct SubpixelPoint {
    /// Subpixels to the right of the window's left border.
    pub x: i32,
    /// Subpixels below the window's upper border.
    pub y: i32,
}

impl SubpixelPoint {
    /// The point at (x, y) subpixels.
    #[must_use]
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    /// Snaps a window position in pixels to the lattice; see [`snap`].
    ///
    /// # Errors
    /// As [`snap`], for either coordinate.
    pub fn from_px(x_px: f64, y_px: f64) -> Result<Self, Refusal> {
        Ok(Self::new(snap(x_px)?, snap(y_px)?))
    }

    /// The same position in pixels, exactly.
    #[must_use]
    pub fn to_px(self) -> (f64, f64) {
        let scale = f64::from(SUBPIXELS);
        (f64::from(self.x) / scale, f64::from(self.y) / scale)
    }
}

/// Why a number has no place on the lattice or in a computation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// The number is NaN.
    NotANumber,
    /// The number is infinite.
    Infinite,
    /// The coordinate, in pixels, lies outside [-[`DOMAIN_PX`], [`DOMAIN_PX`]).
    OutOfDomain(f64),
    /// The value lies outside the range that attributes, depths and w are accepted in.
    OutOfRange {
        /// What was refused.
        value: f64,
        /// Smallest accepted value.
        min: f64,
        /// Largest accepted value.
        max: f64,
    },
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotANumber => f.write_str("is not a number (NaN)"),
            Self::Infinite => f.write_str("is infinite"),
            Self::OutOfDomain(px) => {
                write!(f, "{px:e} px is outside the domain [-{DOMAIN_PX}, {DOMAIN_PX}) px")
            }
            Self::OutOfRange { value, min, max } => {
                write!(f, "{value:e} is outside the accepted range [{min:e}, {max:e}]")
            }
        }
    }
}

impl std::error::Error for Refusal {}

/// Rounds a coordinate in pixels to the lattice: to the nearest 1/256 px, ties to the even one.
///
/// Multiplying by 256 only moves the exponent, so the one rounding is the last step. It commutes
/// with translations by whole pixels: 256 is even, so a tie stays a tie with the same parity.
///
/// ```
/// use rasterproof_core::grid::snap;
/// assert_eq!(snap(0.5), Ok(128));
/// assert_eq!(snap(0.5 / 256.0), Ok(0)); // a tie, 0 is even
/// assert_eq!(snap(1.5 / 256.0), Ok(2)); // a tie, 2 is even
/// assert!(snap(f64::NAN).is_err());
/// ```
///
/// # Errors
/// [`Refusal`] for NaN, infinities and what rounds to a point outside the domain.
pub fn snap(px: f64) -> Result<i32, Refusal> {
    if px.is_nan() {
        return Err(Refusal::NotANumber);
    }
    if px.is_infinite() {
        return Err(Refusal::Infinite);
    }
    let sub = (px * f64::from(SUBPIXELS)).round_ties_even();
    if sub < f64::from(i32::MIN) || sub > f64::from(i32::MAX) {
        return Err(Refusal::OutOfDomain(px));
    }
    // Exact: `sub` is a whole number within i32.
    Ok(sub as i32)
}

/// A half-open rectangle of pixels: columns x0..x1, rows y0..y1, y down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
pub struct PixelRect {
    /// First column.
    pub x0: i32,
    /// First row.
    pub y0: i32,
    /// One past the last column.
    pub x1: i32,
    /// One past the last row.
    pub y1: i32,
}

impl PixelRect {
    /// The window of `width` x `height` pixels at the origin.
    ///
    /// # Panics
    /// If a side exceeds `i32::MAX`; callers hold sides to [`MAX_SIDE_PX`].
    #[must_use]
    pub const fn window(width: u32, height: u32) -> Self {
        assert!(width <= i32::MAX as u32 && height <= i32::MAX as u32);
        Self { x0: 0, y0: 0, x1: width as i32, y1: height as i32 }
    }

    /// Columns, 0 where the rectangle is empty.
    #[must_use]
    pub fn width(&self) -> u32 {
        (i64::from(self.x1) - i64::from(self.x0)).max(0) as u32
    }

    /// Rows, 0 where the rectangle is empty.
    #[must_use]
    pub fn height(&self) -> u32 {
        (i64::from(self.y1) - i64::from(self.y0)).max(0) as u32
    }

    /// Whether no pixel lies inside.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.x0 >= self.x1 || self.y0 >= self.y1
    }

    /// Whether pixel (x, y) lies inside.
    #[must_use]
    pub fn contains(&self, x_px: i32, y_px: i32) -> bool {
        (self.x0..self.x1).contains(&x_px) && (self.y0..self.y1).contains(&y_px)
    }

    /// The pixels that lie in both.
    #[must_use]
    pub fn intersect(&self, other: &Self) -> Self {
        Self {
            x0: self.x0.max(other.x0),
            y0: self.y0.max(other.y0),
            x1: self.x1.min(other.x1),
            y1: self.y1.min(other.y1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snap_by_hand() {
        // Worked out on paper: px, subpixels.
        let cases = [
            (0.0, 0),
            (-0.0, 0),
            (1.0, 256),
            (-1.0, -256),
            (0.5, 128),
            (0.001, 0),
            (0.002, 1),
            (0.5 / 256.0, 0),
            (1.5 / 256.0, 2),
            (2.5 / 256.0, 2),
            (-0.5 / 256.0, 0),
            (-1.5 / 256.0, -2),
            (-2.5 / 256.0, -2),
            (3.0 + 1.5 / 256.0, 770),
            (f64::MIN_POSITIVE / 4.0, 0),
            (-8_388_608.0, i32::MIN),
            (8_388_607.996_093_75, i32::MAX),
        ];
        for (px, sub) in cases {
            assert_eq!(snap(px), Ok(sub), "{px}");
        }
    }

    #[test]
    fn snap_refuses_with_a_reason() {
        assert_eq!(snap(f64::NAN), Err(Refusal::NotANumber));
        assert_eq!(snap(f64::INFINITY), Err(Refusal::Infinite));
        assert_eq!(snap(f64::NEG_INFINITY), Err(Refusal::Infinite));
        for px in [8_388_608.0, -8_388_608.01, 1e22, -1e300, -693_631_800.0] {
            assert_eq!(snap(px), Err(Refusal::OutOfDomain(px)), "{px}");
        }
    }

    #[test]
    fn rect_is_half_open() {
        let rect = PixelRect::window(3, 2);
        assert!(rect.contains(2, 1) && !rect.contains(3, 1) && !rect.contains(2, 2));
        assert_eq!((rect.width(), rect.height()), (3, 2));
        let far = PixelRect { x0: i32::MAX, y0: 0, x1: i32::MIN, y1: 2 };
        assert!(far.is_empty() && far.width() == 0);
    }
}
