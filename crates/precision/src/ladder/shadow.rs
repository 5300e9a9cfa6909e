//! Rungs of shadows: the formats in which a shadow map holds depths, and the bias with which they are compared.
//!
//! A fragment reads the 3 x 3 texels around its place and counts those that are not nearer to the light. The bias is that of
//! [`rasterproof_render::pipeline::shadow`], derived there: what a plane's depth may change by between the fragment and the
//! centre of a texel. Depths are computed in f64, so that the format alone is seen.

/// What a texel holds; smaller is nearer to the light.
pub trait Format {
    type Stored: Copy + PartialOrd;
    /// Whether the bias is taken from the depth of a fragment.
    const BIASED: bool = true;
    fn store(depth: f64) -> Self::Stored;
}

/// The range from 0 to 1 in 2^16 - 1 equal steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fixed16;
#[derive(Clone, Copy, Debug, Default)]
pub struct Fixed24;
#[derive(Clone, Copy, Debug, Default)]
pub struct Fixed32;
/// Floats, whose steps are finer near the light.
#[derive(Clone, Copy, Debug, Default)]
pub struct Single;
#[derive(Clone, Copy, Debug, Default)]
pub struct Double;
/// The steps of [`Fixed24`], compared without a bias.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unbiased;

impl Format for Fixed16 {
    type Stored = u16;
    #[inline]
    fn store(depth: f64) -> u16 {
        (depth * f64::from(u16::MAX) + 0.5) as u16
    }
}

impl Format for Fixed24 {
    type Stored = u32;
    #[inline]
    fn store(depth: f64) -> u32 {
        (depth * f64::from((1 << 24) - 1) + 0.5) as u32
    }
}

impl Format for Fixed32 {
    type Stored = u32;
    #[inline]
    fn store(depth: f64) -> u32 {
        (depth * f64::from(u32::MAX) + 0.5) as u32
    }
}

impl Format for Single {
    type Stored = f32;
    #[inline]
    fn store(depth: f64) -> f32 {
        depth as f32
    }
}

impl Format for Double {
    type Stored = f64;
    #[inline]
    fn store(depth: f64) -> f64 {
        depth
    }
}

impl Format for Unbiased {
    type Stored = u32;
    const BIASED: bool = false;
    #[inline]
    fn store(depth: f64) -> u32 {
        Fixed24::store(depth)
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
