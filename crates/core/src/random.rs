//! The random generator of all cases, scenes and tests.

/// SplitMix64 (Steele, Lea, Flood 2014). Own code because a seed must replay the same cases after
/// any update of a dependency; the only generator of the project. It uses whole numbers only, so that a seed gives
/// the same cases on every machine.
pub struct Rng(u64);

#[allow(clippy::should_implement_trait, reason = "an endless stream is no iterator")]
impl Rng {
    /// The stream of one case.
    #[must_use]
    pub fn new(family: &str, seed: u64, index: u64) -> Self {
        let mut rng = Self(seed);
        for byte in family.bytes() {
            rng.0 = rng.next() ^ u64::from(byte);
        }
        rng.0 = rng.next() ^ index;
        rng
    }

    /// The stream of a seed alone.
    #[must_use]
    pub fn of_seed(seed: u64) -> Self {
        Self(seed)
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

    /// A whole number in low..=high, both of which fit in an `i32`.
    pub fn coordinate(&mut self, low: i64, high: i64) -> i32 {
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
