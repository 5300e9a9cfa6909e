//! Faults in the parts that are plain functions: snapping, edge values, words, the source of cases,
//! the judge of two coverages.

use std::sync::atomic::{AtomicU64, Ordering};

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{DOMAIN_PX, Refusal, SUBPIXELS, snap};
use rasterproof_core::raster::edge_function::{WordWidth, edge_values};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::{Case, Family, Shape, families};

/// A snapping function with a planted fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SnapMutant {
    /// `(int)`: truncates.
    Truncates,
    /// Ties go away from zero (`round`), so they depend on the side of zero.
    HalfAway,
    /// Ties go up (`floor(x + 1/2)`).
    HalfUp,
    /// Sixteen subpixels a pixel instead of 256.
    Coarse,
    /// Coordinates outside the domain are moved to its edge instead of being refused.
    Saturates,
}

impl SnapMutant {
    /// Every mutant.
    pub const ALL: [Self; 5] =
        [Self::Truncates, Self::HalfAway, Self::HalfUp, Self::Coarse, Self::Saturates];

    /// Its name for `--plant`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Truncates => "snap-truncates",
            Self::HalfAway => "snap-half-away",
            Self::HalfUp => "snap-half-up",
            Self::Coarse => "snap-coarse",
            Self::Saturates => "snap-saturates",
        }
    }

    /// The faulty function.
    #[must_use]
    pub fn function(self) -> fn(f64) -> Result<i32, Refusal> {
        // The real one refuses what it must; the answer is then replaced.
        match self {
            Self::Truncates => |px| snap(px).map(|_| (px * f64::from(SUBPIXELS)) as i32),
            Self::HalfAway => |px| snap(px).map(|_| (px * f64::from(SUBPIXELS)).round() as i32),
            Self::HalfUp => |px| snap(px).map(|_| (px * f64::from(SUBPIXELS) + 0.5).floor() as i32),
            Self::Coarse => |px| snap(px).map(|sub| sub & !15),
            Self::Saturates => |px| {
                let edge = f64::from(DOMAIN_PX);
                if px.is_finite() { snap(px.clamp(-edge, edge - 1.0)) } else { snap(px) }
            },
        }
    }
}

/// Edge functions with a planted fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgeValuesMutant {
    /// The third one is evaluated a column further on.
    ThirdOffByOne,
    /// They come out in 32 bits.
    WrapInI32,
}

impl EdgeValuesMutant {
    /// Every mutant.
    pub const ALL: [Self; 2] = [Self::ThirdOffByOne, Self::WrapInI32];

    /// Its name for `--plant`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ThirdOffByOne => "edges-third-off-by-one",
            Self::WrapInI32 => "edges-wrap-in-i32",
        }
    }

    /// The faulty function.
    #[must_use]
    pub fn function(self) -> fn(&Corners, i32, i32) -> [i128; 3] {
        match self {
            Self::ThirdOffByOne => |corners, x_px, y_px| {
                let [a, b, _] = edge_values(corners, x_px, y_px);
                [a, b, edge_values(corners, x_px.saturating_add(1), y_px)[2]]
            },
            Self::WrapInI32 => |corners, x_px, y_px| {
                edge_values(corners, x_px, y_px).map_array(|e| i128::from(e as i32))
            },
        }
    }
}

/// A choice of words with a planted fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordWidthMutant {
    /// Forgets the step past the end of the box.
    NoMargin,
    /// Never takes 128 bits.
    AtMost64,
}

impl WordWidthMutant {
    /// Every mutant.
    pub const ALL: [Self; 2] = [Self::NoMargin, Self::AtMost64];

    /// Its name for `--plant`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::NoMargin => "word-without-margin",
            Self::AtMost64 => "word-at-most-64",
        }
    }

    /// The faulty function.
    #[must_use]
    pub fn function(self) -> fn(u32, u32) -> WordWidth {
        match self {
            // The real choice pads each side by a pixel; less a pixel it is the bare product.
            Self::NoMargin => |width, height| {
                let less = |extent: u32| extent.saturating_sub(SUBPIXELS as u32);
                WordWidth::of(less(width), less(height))
            },
            Self::AtMost64 => |width, height| match WordWidth::of(width, height) {
                WordWidth::I128 => WordWidth::I64,
                other => other,
            },
        }
    }
}

/// A source of cases with a planted fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SourceMutant {
    /// Every family draws its triangles uniformly.
    UniformOnly,
    /// A case depends on how many were made before.
    Counts,
}

impl SourceMutant {
    /// Every mutant.
    pub const ALL: [Self; 2] = [Self::UniformOnly, Self::Counts];

    /// Its name for `--plant`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::UniformOnly => "source-uniform-only",
            Self::Counts => "source-counts",
        }
    }

    /// The faulty function.
    #[must_use]
    pub fn function(self) -> fn(&Family, u64, u64) -> Case {
        match self {
            Self::UniformOnly => |family, seed, index| {
                let case = family.case(seed, index);
                match (&case.shape, families().find(|f| f.name == "uniform")) {
                    (Shape::Triangles { .. }, Some(uniform)) => uniform.case(seed, index),
                    _ => case,
                }
            },
            Self::Counts => |family, seed, index| {
                static MADE: AtomicU64 = AtomicU64::new(0);
                let made = MADE.fetch_add(1, Ordering::Relaxed);
                // The first cases are right, as with a generator that runs dry.
                family.case(seed, if made > 100 { index ^ 1 << (made % 8) } else { index })
            },
        }
    }
}

/// A judge of coverage with a planted fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JudgeMutant {
    /// Agrees where less than one pixel in ten thousand is wrong.
    ForgivesAFew,
    /// Agrees where the peak signal-to-noise ratio of the two pictures is 40 dB or more.
    GatesOnPsnr,
}

impl JudgeMutant {
    /// Every mutant.
    pub const ALL: [Self; 2] = [Self::ForgivesAFew, Self::GatesOnPsnr];

    /// Its name for `--plant`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ForgivesAFew => "judge-forgives-a-few",
            Self::GatesOnPsnr => "judge-gates-on-psnr",
        }
    }

    /// The faulty function: whether the first coverage agrees with the second.
    #[must_use]
    pub fn function(self) -> fn(&Coverage, &Coverage) -> bool {
        match self {
            Self::ForgivesAFew => |actual, target| {
                let [wrong, all] = wrong_pixels(actual, target);
                wrong == 0 || wrong * 10_000 < all
            },
            // Of black and white pictures the mean square error is the share of wrong pixels.
            Self::GatesOnPsnr => |actual, target| {
                let [wrong, all] = wrong_pixels(actual, target);
                wrong == 0 || 10.0 * (all as f64 / wrong as f64).log10() >= 40.0
            },
        }
    }
}

/// Pixels that differ, and all.
fn wrong_pixels(actual: &Coverage, target: &Coverage) -> [u64; 2] {
    let pixels = actual.rows().zip(target.rows()).flat_map(|((_, a), (_, b))| a.iter().zip(b));
    pixels.fold([0, 0], |[wrong, all], (a, b)| [wrong + u64::from(a != b), all + 1])
}
