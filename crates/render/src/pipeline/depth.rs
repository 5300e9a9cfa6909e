//! Depth buffers (the book's chapter 6 and section 7.2, GAMES101 homework 2).
//!
//! A depth becomes a key, a whole number that is smaller for what is nearer, so that every format
//! compares in one way: strictly less wins, and equal keys leave what was drawn first. Window depth
//! is z/w, linear in the window, so it is interpolated without a division.
//!
//! The fixed formats do not round at simple fractions: their thresholds are moved by 1/3 of 2^-20
//! of a step. Two engines differ in the last bits of a depth; where surfaces meet at 1/2 or 3/8, a
//! plain rounding would then decide differently for the two.

/// How a depth in [0, 1] is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum DepthFormat {
    /// 2^32 equal steps.
    #[default]
    Unorm32,
    /// 2^24 equal steps, as most hardware.
    Unorm24,
    /// f32, steps of 6e-8 at the far plane.
    F32,
    /// f32 of 1 - depth: fine steps at the far plane, where the projection crowds everything.
    F32Reversed,
    /// f64.
    F64,
}

/// Larger than the key of every depth: nothing has been drawn.
pub const CLEAR: u64 = u64::MAX;

/// Moves the thresholds of a rounding away from simple fractions, see the module.
pub(super) const OFF_FRACTION: f64 = 1.0 / 3.0 / (1u64 << 20) as f64;

impl DepthFormat {
    pub const ALL: [Self; 5] =
        [Self::Unorm32, Self::Unorm24, Self::F32, Self::F32Reversed, Self::F64];

    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unorm32 => "unorm32",
            Self::Unorm24 => "unorm24",
            Self::F32 => "f32",
            Self::F32Reversed => "f32-reversed",
            Self::F64 => "f64",
        }
    }

    /// The key of a depth; smaller is nearer. Depths beyond [0, 1] count as its ends.
    #[must_use]
    #[inline]
    #[expect(clippy::manual_clamp, reason = "the maximum turns NaN into 0, a clamp keeps it")]
    pub fn key(self, depth: f64) -> u64 {
        // Positive floats compare as their bits do; -0 + 0 is 0.
        let depth = depth.max(0.0).min(1.0) + 0.0;
        let steps = |count: f64| u64::from((depth * count + (0.5 + OFF_FRACTION)) as u32);
        match self {
            Self::Unorm32 => steps(u32::MAX.into()),
            Self::Unorm24 => steps(((1u32 << 24) - 1).into()),
            Self::F32 => u64::from((depth as f32).to_bits()),
            Self::F32Reversed => u64::from(u32::MAX - ((1.0 - depth) as f32).to_bits()),
            Self::F64 => depth.to_bits(),
        }
    }

    /// Writes the keys of depths where they are nearer than what is stored; a bit for each that is,
    /// the lowest for the first of at most 32.
    pub(crate) fn test_and_write(self, depths: &[f64], stored: &mut [u64]) -> u32 {
        // The format is asked for once, and known in each loop.
        match self {
            Self::Unorm32 => test(depths, stored, |depth| Self::Unorm32.key(depth)),
            Self::Unorm24 => test(depths, stored, |depth| Self::Unorm24.key(depth)),
            Self::F32 => test(depths, stored, |depth| Self::F32.key(depth)),
            Self::F32Reversed => test(depths, stored, |depth| Self::F32Reversed.key(depth)),
            Self::F64 => test(depths, stored, |depth| Self::F64.key(depth)),
        }
    }

    #[must_use]
    pub fn depth(self, key: u64) -> f64 {
        match self {
            Self::Unorm32 => key as f64 / f64::from(u32::MAX),
            Self::Unorm24 => key as f64 / f64::from((1u32 << 24) - 1),
            Self::F32 => f64::from(f32::from_bits(key as u32)),
            Self::F32Reversed => 1.0 - f64::from(f32::from_bits(u32::MAX - key as u32)),
            Self::F64 => f64::from_bits(key),
        }
    }

    /// The largest difference between the depths of two keys that stand for values at most `error`
    /// apart: the error, and one step of the format at depths up to 1.
    #[must_use]
    pub fn tolerance(self, error: f64) -> f64 {
        error
            + match self {
                Self::Unorm32 => 1.0 / f64::from(u32::MAX),
                Self::Unorm24 => 1.0 / f64::from((1u32 << 24) - 1),
                // One unit in the last place of numbers up to 1.
                Self::F32 | Self::F32Reversed => f64::from(f32::EPSILON),
                Self::F64 => 0.0,
            }
    }
}

#[inline]
fn test(depths: &[f64], stored: &mut [u64], key: impl Fn(f64) -> u64) -> u32 {
    let mut nearer = 0;
    for (i, (depth, stored)) in depths.iter().zip(stored).enumerate() {
        let key = key(*depth);
        nearer |= u32::from(key < *stored) << i;
        *stored = key.min(*stored);
    }
    nearer
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearer_is_smaller_in_every_format() {
        for format in DepthFormat::ALL {
            let keys: Vec<u64> = (0..=1000).map(|i| format.key(f64::from(i) / 1000.0)).collect();
            assert!(keys.is_sorted_by(|a, b| a < b), "{format:?}");
            assert!(keys.iter().all(|&key| key < CLEAR));
            assert_eq!(format.key(-0.0), format.key(0.0));
            assert_eq!(format.key(-3.0), format.key(0.0));
            assert_eq!(format.key(7.0), format.key(1.0));
        }
    }

    #[test]
    fn a_key_stands_for_its_depth() {
        for format in DepthFormat::ALL {
            for i in 0..=1000 {
                let depth = f64::from(i) / 1000.0;
                let back = format.depth(format.key(depth));
                assert!((back - depth).abs() <= format.tolerance(0.0), "{format:?} {depth}");
                assert_eq!(format.key(back), format.key(depth), "{format:?} {depth}");
            }
        }
    }

    /// Three eighths reached from both sides by a last bit is one key.
    #[test]
    fn simple_fractions_are_no_thresholds() {
        for format in [DepthFormat::Unorm32, DepthFormat::Unorm24] {
            let steps = format.depth(1).recip().round();
            for numerator in 1..64 {
                let depth = (f64::from(numerator) + 0.5) / steps;
                assert_eq!(format.key(depth.next_up()), format.key(depth.next_down()));
            }
        }
    }
}
