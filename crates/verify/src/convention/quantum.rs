//! What a program does to a corner before it looks at it: the grid, and the way onto it.

use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::triangle::Corners;

rasterproof_core::named! {
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
    pub enum Rounding {
        /// A half is rounded up, to the larger number: v becomes floor(v + 1/2).
        Near = "the nearest, halves up",
        HalfEven = "the nearest, halves to the even one",
        /// As the function `round` of C rounds: -1/2 becomes -1.
        HalfAway = "the nearest, halves away from zero",
        /// The largest whole number that is at most v, also where v is negative.
        Down = "down",
        /// The fraction is cut off, as by a cast to `int` in C.
        TowardZero = "toward zero",
    }
}

/// The grid of corners: multiples of `step` subpixels (1/256 px).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Quantum {
    /// 1, 4, 16, 64 or 256 subpixels. 1 is the grid of the questions: that, or finer.
    pub step: i32,
    pub rounding: Rounding,
}

impl Default for Quantum {
    fn default() -> Self {
        Self::NONE
    }
}

impl Quantum {
    /// Corners as they are given, or on a grid too fine to be seen.
    pub const NONE: Self = Self { step: 1, rounding: Rounding::Near };

    /// The multiple of the step that `sub` becomes.
    pub fn apply(self, sub: i32) -> i64 {
        let (sub, step) = (i64::from(sub), i64::from(self.step));
        let below = sub.div_euclid(step);
        let rest = 2 * sub.rem_euclid(step);
        let up = match self.rounding {
            Rounding::Near => rest >= step && step > 1,
            Rounding::HalfEven => rest > step || (rest == step && below % 2 != 0),
            Rounding::HalfAway => rest > step || (rest == step && sub >= 0),
            Rounding::Down => false,
            Rounding::TowardZero => sub < 0 && rest > 0,
        };
        (below + i64::from(up)) * step
    }

    /// The corners on the grid, where that is one of 32 bits.
    pub fn snap(self, corners: &Corners) -> Corners {
        let on_grid = |sub: i32| self.apply(sub) as i32;
        corners.map_array(|SubpixelPoint { x, y }| SubpixelPoint::new(on_grid(x), on_grid(y)))
    }

    /// All three corners, as [x, y].
    pub(super) fn corners(self, corners: &Corners) -> [[i64; 2]; 3] {
        corners.map_array(|SubpixelPoint { x, y }| [self.apply(x), self.apply(y)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quanta_by_hand() {
        let at = |rounding| Quantum { step: 256, rounding };
        for (sub, near, even, away, down, zero) in [
            (128, 256, 0, 256, 0, 0),
            (384, 512, 512, 512, 256, 256),
            (127, 0, 0, 0, 0, 0),
            (-128, 0, 0, -256, -256, 0),
            (-129, -256, -256, -256, -256, 0),
            (-256, -256, -256, -256, -256, -256),
            (-384, -256, -512, -512, -512, -256),
        ] {
            assert_eq!(at(Rounding::HalfAway).apply(sub), away, "{sub}");
            assert_eq!(at(Rounding::Near).apply(sub), near, "{sub}");
            assert_eq!(at(Rounding::HalfEven).apply(sub), even, "{sub}");
            assert_eq!(at(Rounding::Down).apply(sub), down, "{sub}");
            assert_eq!(at(Rounding::TowardZero).apply(sub), zero, "{sub}");
        }
        assert_eq!(Quantum::NONE.apply(-77), -77);
    }
}
