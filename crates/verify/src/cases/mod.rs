//! Hard cases: what breaks rasterizers, as generated families and as named cases.
//!
//! Uniformly random triangles prove little: on the 1/256-px lattice two or three in ten thousand have
//! a sample exactly on an edge, so random draws hardly ever refute a wrong tie rule. Each family here
//! aims at one danger. A case is a pure function of (family, seed, index), on every machine:
//! whole-number arithmetic, no trigonometry.

pub mod lines;
pub mod named;
#[doc(hidden)]
pub mod near_plane;
#[doc(hidden)]
pub mod shrink;
pub mod triangles;
pub mod unsnapped;

use glam::DVec2;

use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::{PixelPoint, ScreenLine, ScreenTriangle};

/// A triangle as the harness draws it: two attributes besides depth.
pub type Triangle = ScreenTriangle<DVec2>;
/// A line as the harness draws it.
pub type Line = ScreenLine<DVec2>;

/// What a case draws.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Triangles, to be judged one by one and together.
    Triangles {
        /// The triangles.
        list: Vec<Triangle>,
        /// Whether their interiors are disjoint by construction, so that no pixel may be hit twice.
        disjoint: bool,
    },
    /// Lines, to be judged one by one.
    Lines(Vec<Line>),
}

/// Something to draw, and the window to draw it in.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The pixels that are looked at.
    pub window: PixelRect,
    /// What is drawn.
    pub shape: Shape,
}

/// A way to make cases that share a danger.
#[derive(Clone, Copy)]
pub struct Family {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it threatens, in a few words.
    pub about: &'static str,
    make: fn(&mut Rng) -> Case,
}

impl Family {
    /// The case number `index` of this family under `seed`.
    #[must_use]
    pub fn case(&self, seed: u64, index: u64) -> Case {
        (self.make)(&mut Rng::new(self.name, seed, index))
    }
}

/// All families: those of triangles first, then those of lines.
pub fn families() -> impl Iterator<Item = &'static Family> {
    triangles::FAMILIES.iter().chain(lines::FAMILIES)
}

/// SplitMix64 (Steele, Lea, Flood 2014). Own code because a seed must replay the same cases after
/// any update of a dependency; the only generator of this crate.
pub struct Rng(u64);

#[allow(clippy::should_implement_trait, reason = "an endless stream is no iterator")]
impl Rng {
    /// The stream of one case.
    pub fn new(family: &str, seed: u64, index: u64) -> Self {
        let mut rng = Self(seed);
        for byte in family.bytes() {
            rng.0 = rng.next() ^ u64::from(byte);
        }
        rng.0 = rng.next() ^ index;
        rng
    }

    /// 64 bits.
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number in low..=high.
    pub fn int(&mut self, low: i64, high: i64) -> i64 {
        let count = high.abs_diff(low) + 1;
        // The high half of a 128-bit product: uniform to within 2^-32 for the small ranges here.
        low + ((u128::from(self.next()) * u128::from(count)) >> 64) as i64
    }

    fn coordinate(&mut self, low: i64, high: i64) -> i32 {
        self.int(low, high) as i32
    }

    /// Whether one case in so many is meant.
    pub fn chance(&mut self, one_in: i64) -> bool {
        self.int(1, one_in) == 1
    }

    /// A number in [0, 1) with 53 bits.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A number in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        self.unit() * 2.0 - 1.0
    }
}

/// A point given in whole subpixels.
fn sub(x: i64, y: i64) -> SubpixelPoint {
    SubpixelPoint::new(x as i32, y as i32)
}

/// A pixel given in whole numbers.
fn pixel(x: i64, y: i64) -> PixelPoint {
    PixelPoint::new(x as i32, y as i32)
}
