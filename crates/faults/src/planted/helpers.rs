//! Faults in the parts that are plain functions: snapping, edge values, words, the source of cases,
//! the judge of two coverages.

use std::sync::atomic::{AtomicU64, Ordering};

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{DOMAIN_PX, Refusal, SUBPIXELS, snap};
use rasterproof_core::raster::edge_function::{WordWidth, edge_values};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::{Case, Family, Shape, families};

planted! {
    SnapMutant {
        Truncates "snap-truncates": "snapping truncates: (int)",
        HalfAway "snap-half-away": "halves are snapped away from zero, so they depend on its side",
        HalfUp "snap-half-up": "halves are snapped upwards",
        Coarse "snap-coarse": "sixteen subpixels a pixel instead of 256",
        Saturates "snap-saturates":
            "what lies outside the domain is moved to its edge, not refused",
    }
}

impl SnapMutant {
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

planted! {
    EdgeValuesMutant {
        ThirdOffByOne "edges-third-off-by-one":
            "the third edge function is evaluated a column further on",
        WrapInI32 "edges-wrap-in-i32": "edge functions come out in 32 bits",
    }
}

impl EdgeValuesMutant {
    /// The faulty function in the place of `edge_values`.
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

planted! {
    WordWidthMutant {
        NoMargin "word-without-margin":
            "the choice of a word forgets the step past the end of the box",
        AtMost64 "word-at-most-64": "the choice of a word never takes 128 bits",
    }
}

impl WordWidthMutant {
    /// The faulty choice of a word by the sides of the box.
    pub fn function(self) -> fn(u32, u32) -> WordWidth {
        match self {
            // The real choice pads each side by a pixel; less a pixel it is the bare product.
            Self::NoMargin => |width, height| {
                let pixel = SUBPIXELS as u32;
                WordWidth::of(width.saturating_sub(pixel), height.saturating_sub(pixel))
            },
            Self::AtMost64 => |width, height| match WordWidth::of(width, height) {
                WordWidth::I128 => WordWidth::I64,
                other => other,
            },
        }
    }
}

planted! {
    SourceMutant {
        UniformOnly "source-uniform-only": "of the cases: every family draws triangles uniformly",
        Counts "source-counts": "of the cases: one depends on how many were made before",
    }
}

impl SourceMutant {
    /// The faulty source: the case of a family, a seed and a number.
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
                // A generator with a state that is shared by all families.
                let made = MADE.fetch_add(1, Ordering::Relaxed);
                // The first cases are right, as with a generator that runs dry.
                family.case(seed, if made > 100 { index ^ 1 << (made % 8) } else { index })
            },
        }
    }
}

planted! {
    JudgeMutant {
        ForgivesAFew "judge-forgives-a-few":
            "a judge: agrees where fewer than one pixel in 10,000 is wrong",
        GatesOnPsnr "judge-gates-on-psnr": "a judge: agrees from 40 dB of peak signal to noise",
    }
}

impl JudgeMutant {
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

/// How many pixels differ, and how many there are.
fn wrong_pixels(actual: &Coverage, target: &Coverage) -> [u64; 2] {
    let (mut wrong, mut all) = (0, 0);
    for ((_, actual), (_, target)) in actual.rows().zip(target.rows()) {
        for (actual, target) in actual.iter().zip(target) {
            wrong += u64::from(actual != target);
            all += 1;
        }
    }
    [wrong, all]
}
