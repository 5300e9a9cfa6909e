//! Where corners are put: on a grid of some bits below the pixel, or where they are.

use std::fmt;

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Rasterize as _, RasterizeExact as _};
use rasterproof_core::grid::{MAX_SIDE_PX, PixelRect, SUBPIXEL_BITS, SubpixelPoint};
use rasterproof_core::raster::scanline::Scanline;
use rasterproof_core::raster::scanline_exact::ScanlineExact;
use rasterproof_core::triangle::{FreeCorners, Span};
use rasterproof_render::pipeline::assemble::Cull;
use robust::{Coord, orient2d};

/// Where corners are put before a triangle is drawn. With so many bits below the pixel, a coordinate of 32 bits reaches from -2^(31 - bits)
/// to 2^(31 - bits) px: 134,217,728 px for 4 bits, 8,388,608 for 8, 524,288 for 12 and 32,768 for 16.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CornerGrid {
    /// So many bits below the pixel.
    Bits(u32),
    Unsnapped,
}

// So each of them holds every picture, whose corners are clipped to it.
const _: () = assert!(1 << (31 - 16) >= MAX_SIDE_PX);

impl fmt::Display for CornerGrid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bits(bits) => write!(f, "on 1/{} px", 1u32 << bits),
            Self::Unsnapped => f.write_str("not snapped"),
        }
    }
}

impl CornerGrid {
    /// That of the engines.
    pub const USUAL: Self = Self::Bits(SUBPIXEL_BITS);

    /// Those that are compared with each other, from the coarsest on.
    pub const ALL: [Self; 8] = [
        Self::Bits(4),
        Self::Bits(6),
        Self::USUAL,
        Self::Bits(10),
        Self::Bits(12),
        Self::Bits(14),
        Self::Bits(16),
        Self::Unsnapped,
    ];

    /// Bits below the pixel; none where corners are not snapped.
    pub fn bits(self) -> Option<u32> {
        match self {
            Self::Bits(bits) => Some(bits),
            Self::Unsnapped => None,
        }
    }

    /// Whether all of its points are points of the engines' grid.
    pub(crate) fn is_whole(self) -> bool {
        self.bits().is_some_and(|bits| bits <= SUBPIXEL_BITS)
    }

    /// How far two neighbours on the grid are apart.
    pub(crate) fn step_px(self) -> Option<f64> {
        self.bits().map(|bits| 1.0 / f64::from(1u32 << bits))
    }

    /// The corners on the grid, ties to the even neighbour.
    #[must_use]
    pub fn place(self, px: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
        let Self::Bits(bits) = self else { return px };
        // A power of two moves the exponent alone: this rounds once.
        let scale = f64::from(1u32 << bits);
        px.map_array(|point| point.map_array(|at| (at * scale).round_ties_even() / scale))
    }

    /// A number with the sign of the area of three corners on the grid, positive where they are clockwise as seen.
    pub(crate) fn winding(self, px: [[f64; 2]; 3]) -> f64 {
        let [a, b, c] = self.place(px).map_array(|[x, y]| Coord { x, y });
        orient2d(a, b, c)
    }

    /// Whether culling removes a triangle, which it decides by the corners on the grid, as the engines do. What is flat is not
    /// removed, since it covers no pixel anyway.
    pub(crate) fn is_removed(self, cull: Cull, px: [[f64; 2]; 3]) -> bool {
        match cull {
            Cull::None => false,
            Cull::Clockwise => self.winding(px) > 0.0,
            Cull::CounterClockwise => self.winding(px) < 0.0,
        }
    }

    /// Emits the pixels that a triangle covers with its corners on the grid.
    pub(crate) fn cover(self, px: [[f64; 2]; 3], bounds: PixelRect, emit: &mut dyn FnMut(Span)) {
        if self == Self::USUAL {
            let [a, b, c] = px.map_array(|[x, y]| SubpixelPoint::from_px(x, y));
            if let (Ok(a), Ok(b), Ok(c)) = (a, b, c) {
                Scanline.cover([a, b, c], bounds, emit);
            }
        } else if let Ok(corners) = FreeCorners::new(self.place(px)) {
            ScanlineExact.cover_exact(&corners, bounds, emit);
        }
    }
}
