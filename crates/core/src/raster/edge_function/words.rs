//! The edge-function engine with integers of a width that was asked for: what the choice of
//! [`WordWidth::of`] saves, and what it would cost to get it wrong.

use std::ops::{Add, BitOr};

use super::values::runs_in;
use super::{EdgeFunction, Exact, Word, WordWidth, cover_in, extents, walk_in_batches};
use crate::contract::{Interpolate, Rasterize, Run};
use crate::grid::PixelRect;
use crate::triangle::{Corners, Fragment, ScreenTriangle, Span, Varying};

/// Which integers the edge functions of a triangle are stepped in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Words {
    /// The narrowest that hold them, as [`EdgeFunction`].
    #[default]
    Narrowest,
    /// 128 bits, which hold those of every triangle.
    Widest,
    /// 32 bits, without looking. Wraps around, and so draws wrongly, where they are too few.
    Narrow,
}

/// [`EdgeFunction`] in words of one's choice. The widths that hold the numbers give the same
/// coverage and values, bit for bit.
#[derive(Clone, Copy, Debug, Default)]
pub struct EdgeFunctionIn(pub Words);

impl Rasterize for EdgeFunctionIn {
    #[inline]
    fn cover(&self, corners: Corners, bounds: PixelRect, mut emit: impl FnMut(Span)) {
        let (extent_x, extent_y) = extents(&corners);
        match (self.0, WordWidth::of(extent_x, extent_y)) {
            (Words::Narrowest, WordWidth::I32) => cover_in::<i64, i32>(corners, bounds, emit),
            (Words::Narrowest, WordWidth::I64) => {
                cover_by_pointer::<i64, i64>(corners, bounds, &mut emit);
            }
            (Words::Narrow, _) => cover_by_pointer::<i128, Wrapping>(corners, bounds, &mut emit),
            (Words::Narrowest | Words::Widest, _) => {
                cover_by_pointer::<i128, i128>(corners, bounds, &mut emit);
            }
        }
    }

    fn word_bits(&self, corners: &Corners) -> Option<u32> {
        let (extent_x, extent_y) = extents(corners);
        Some(match (self.0, WordWidth::of(extent_x, extent_y)) {
            (Words::Widest, _) | (Words::Narrowest, WordWidth::I128) => i128::BITS,
            (Words::Narrowest, WordWidth::I64) => i64::BITS,
            (Words::Narrow, _) | (Words::Narrowest, WordWidth::I32) => i32::BITS,
        })
    }
}

/// The walks in wider words than most triangles need are compiled once, and call `emit` through a pointer for each row.
/// Triangles that do not fit 32 bits mostly have so many pixels that these calls take hardly any time. If the user forces wide
/// words for every triangle, the calls are a part of what wide words cost.
fn cover_by_pointer<T: Exact, W: Word>(
    corners: Corners,
    bounds: PixelRect,
    emit: &mut dyn FnMut(Span),
) {
    cover_in::<T, W>(corners, bounds, emit);
}

impl Interpolate for EdgeFunctionIn {
    fn fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        self.runs(triangle, bounds, false, &mut |run| run.each(&mut emit));
    }

    fn affine_fragments<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        mut emit: impl FnMut(Fragment<V>),
    ) {
        self.runs(triangle, bounds, true, &mut |run| run.each(&mut emit));
    }

    fn runs<V: Varying>(
        &self,
        triangle: &ScreenTriangle<V>,
        bounds: PixelRect,
        affine: bool,
        take: &mut dyn FnMut(Run<'_, V>),
    ) {
        let walk = match self.0 {
            Words::Narrowest => return EdgeFunction.runs(triangle, bounds, affine, take),
            Words::Widest => walk_in_batches::<i128, i128>,
            Words::Narrow => walk_in_batches::<i128, Wrapping>,
        };
        let equal;
        let triangle = if affine {
            equal = triangle.with_equal_w();
            &equal
        } else {
            triangle
        };
        runs_in::<V, false>(triangle, bounds, walk, true, take);
    }
}

/// 32 bits that wrap around.
#[derive(Clone, Copy)]
struct Wrapping(i32);

impl Add for Wrapping {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

impl BitOr for Wrapping {
    type Output = Self;
    #[inline]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Word for Wrapping {
    #[inline]
    fn narrow(value: i128) -> Self {
        Self(value as i32)
    }
    #[inline]
    fn is_negative(self) -> bool {
        self.0 < 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::SubpixelPoint;

    /// A wide triangle of two rows: right in 64 and 128 bits, and wrong in 32.
    #[test]
    fn narrow_words_wrap_where_the_numbers_do_not_fit() {
        let side = 1 << 21;
        let corner = |x, y| SubpixelPoint::new(x, y);
        let corners = [corner(0, 0), corner(side, 0), corner(0, side)];
        let bounds = PixelRect { x0: 0, y0: 0, x1: 1 << 13, y1: 2 };
        let cover = |words: Words| {
            let mut spans = Vec::new();
            EdgeFunctionIn(words)
                .cover(corners, bounds, |s| spans.push((s.y_px, s.x0_px, s.x1_px)));
            spans
        };
        assert_eq!(cover(Words::Narrowest), [(0, 0, 8191), (1, 0, 8190)]);
        assert_eq!(cover(Words::Widest), cover(Words::Narrowest));
        assert!(cover(Words::Narrow) != cover(Words::Narrowest));
        let bits = |words: Words| EdgeFunctionIn(words).word_bits(&corners);
        assert_eq!(bits(Words::Narrowest), Some(64));
        assert_eq!((bits(Words::Widest), bits(Words::Narrow)), (Some(128), Some(32)));
    }
}
