//! Choices of depth: formats of a depth buffer for a perspective with the planes n and f.
//!
//! With the usual mapping depth is f (z - n) / (z (f - n)), 0 at the near plane and 1 at the far one
//! ([`Fixed24`]), or twice that less 1, as the book and OpenGL have it ([`Forward`]): nearly all of its
//! values lie close to 1, where floats are coarse. Reversed, it is n (f - z) / (z (f - n)), 1 at the
//! near plane and 0 at the far one, and the fine values of a float near 0 meet the coarse depths far
//! away. Depth is linear in the window; it is interpolated as a
//! plane, in the float of the format, as a rasterizer would.

use std::marker::PhantomData;

use super::Real;

pub const NEAR: f64 = 0.1;
pub const FAR: f64 = 1000.0;

pub trait Format {
    /// What the buffer holds; smaller passes where [`Format::REVERSED`] is not set.
    type Entry: Copy + PartialOrd;
    const REVERSED: bool;
    type Float: Real;
    fn store(depth: Self::Float) -> Self::Entry;

    /// The depth of a distance from the eye, before it is rounded to the format.
    fn depth(z: f64) -> f64;

    #[inline]
    #[must_use]
    fn hides(a: Self::Entry, b: Self::Entry) -> bool {
        if Self::REVERSED { a > b } else { a < b }
    }
}

/// Whole numbers of 24 bits; depth is interpolated in f64, so that the format alone is seen.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fixed24;

/// A float, -1 at the near plane and 1 at the far one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Forward<T>(PhantomData<T>);

/// A float, 1 at the near plane.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reversed<T>(PhantomData<T>);

impl Format for Fixed24 {
    type Entry = u32;
    type Float = f64;
    const REVERSED: bool = false;
    fn depth(z: f64) -> f64 {
        FAR * (z - NEAR) / (z * (FAR - NEAR))
    }
    #[inline]
    fn store(depth: f64) -> u32 {
        // Not negative within the planes; beyond them it saturates.
        (depth * f64::from((1 << 24) - 1) + 0.5) as u32
    }
}

impl<T: Real> Format for Forward<T> {
    type Entry = T;
    type Float = T;
    const REVERSED: bool = false;
    fn depth(z: f64) -> f64 {
        (FAR + NEAR) / (FAR - NEAR) - 2.0 * FAR * NEAR / ((FAR - NEAR) * z)
    }
    #[inline]
    fn store(depth: T) -> T {
        depth
    }
}

impl<T: Real> Format for Reversed<T> {
    type Entry = T;
    type Float = T;
    const REVERSED: bool = true;
    fn depth(z: f64) -> f64 {
        NEAR * (FAR - z) / (z * (FAR - NEAR))
    }
    #[inline]
    fn store(depth: T) -> T {
        depth
    }
}

/// What a buffer holds for a distance: the exact mapping, rounded once to the format.
pub fn stored<F: Format>(z: f64) -> F::Entry {
    F::store(F::Float::of(F::depth(z)))
}
