//! Choices of shadows: the formats in which a shadow map holds depths, and the bias with which they are compared.
//!
//! A fragment reads the 3 x 3 texels around its place and counts those that are not nearer to the light. The bias is that of
//! `rasterproof_render::pipeline::shadow`, derived there: what a plane's depth may change by between the fragment and the
//! centre of a texel. Depths are computed in f64, so that the format alone is seen.

use std::marker::PhantomData;

use num_traits::AsPrimitive;

use super::Real;

/// What a texel holds; smaller is nearer to the light.
pub trait Format {
    type Texel: Copy + PartialOrd;
    /// Whether the bias is taken from the depth of a fragment.
    const BIASED: bool = true;
    fn store(depth: f64) -> Self::Texel;
}

/// The range from 0 to 1 in 2^BITS - 1 equal steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fixed<T, const BITS: u32, const BIASED: bool = true>(PhantomData<T>);
pub type Fixed16 = Fixed<u16, 16>;
pub type Fixed24 = Fixed<u32, 24>;
pub type Fixed32 = Fixed<u32, 32>;
/// The steps of [`Fixed24`], compared without a bias.
pub type Unbiased = Fixed<u32, 24, false>;

/// Floats, whose steps are finer near the light.
#[derive(Clone, Copy, Debug, Default)]
pub struct Floats<T>(PhantomData<T>);

impl<T, const BITS: u32, const BIASED: bool> Format for Fixed<T, BITS, BIASED>
where
    T: Copy + PartialOrd + 'static,
    f64: AsPrimitive<T>,
{
    type Texel = T;
    const BIASED: bool = BIASED;
    #[inline]
    fn store(depth: f64) -> T {
        (depth * ((1u64 << BITS) - 1) as f64 + 0.5).as_()
    }
}

impl<T: Real> Format for Floats<T> {
    type Texel = T;
    #[inline]
    fn store(depth: f64) -> T {
        T::of(depth)
    }
}

/// A plane's depth, and how it changes for a texel along each axis.
#[derive(Clone, Copy, Debug)]
pub struct DepthPlane {
    pub start: f64,
    pub slope: [f64; 2],
}

impl DepthPlane {
    #[inline]
    pub fn at(&self, x: f64, y: f64) -> f64 {
        self.start + self.slope[0] * x + self.slope[1] * y
    }

    /// What is taken from the depth of a fragment of this plane.
    #[inline]
    pub fn bias(&self) -> f64 {
        let [x, y] = self.slope;
        (x.abs() + y.abs()) * (1.5 + 1.0 / 256.0) + 1.0 / (1u64 << 36) as f64
    }
}
