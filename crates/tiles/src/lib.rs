//! Rasterization in tiles with vector instructions: [`coverage`] of lists of triangles, [`paint`] for lists in one
//! colour, and whole [`frames`] on several threads.
// What only whole frames on several threads call.
#![cfg_attr(not(feature = "parallel"), allow(dead_code))]

/// Does something in the vectors of a level. Each level is compiled anew, so SSE4.2 is served by SSE2: it is as fast but for
/// triangles of a pixel or two, and machines with it and without AVX2 are older than 2013.
#[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
macro_rules! dispatch {
    ($level:expr, $simd:ident => $op:expr) => {
        match $level {
            fearless_simd::Level::Avx512($simd) => dispatch!(@in $simd, $op),
            fearless_simd::Level::Avx2($simd) => dispatch!(@in $simd, $op),
            level => {
                // All of these levels have it.
                let $simd = level.as_sse2().unwrap_or_else(|| unreachable!());
                dispatch!(@in $simd, $op)
            }
        }
    };
    (@in $simd:ident, $op:expr) => {
        fearless_simd::Simd::vectorize($simd, #[inline(always)] || $op)
    };
}
#[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
macro_rules! dispatch {
    ($level:expr, $simd:ident => $op:expr) => {
        fearless_simd::dispatch!($level, $simd => $op)
    };
}

pub mod coverage;
#[cfg(feature = "parallel")]
pub mod frames;
pub mod paint;
