//! The numbers in which something is kept: every intermediate of a computation has such a format.

use std::fmt;

use crate::cases::facts::exponent;
use crate::convention::Rounding;

/// The numbers that something is brought to before it is used further.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Format {
    #[default]
    Exact,
    /// Floats with so many bits after the first one.
    Float(i32, Rounding),
    /// So many bits between 0 and 1, the largest number being 1.
    Unit(i32, Rounding),
    /// Whole numbers and so many bits of fraction.
    Fixed(i32, Rounding),
    /// The fraction alone: it begins again at 0 after every so many parts of 1.
    Wrapped(i32),
    /// Floats of 32 bits, and of 16.
    Single,
    Half,
}

/// Bits that are told apart from none.
const MOST_BITS: i32 = 24;

impl Format {
    /// Every format but the exact one.
    #[must_use]
    pub fn options() -> Vec<Self> {
        type Of = fn(i32, Rounding) -> Format;
        let kinds: [(Of, &[Rounding]); 3] = [
            (Self::Fixed, &[Rounding::Down, Rounding::TowardZero, Rounding::HalfAway]),
            (Self::Unit, &[Rounding::HalfAway, Rounding::Near, Rounding::Down]),
            (Self::Float, &[Rounding::HalfAway, Rounding::TowardZero]),
        ];
        let mut all = vec![Self::Half, Self::Single];
        for (of, ways) in kinds {
            for bits in 0..=MOST_BITS {
                all.extend(ways.iter().map(|to| of(bits, *to)));
            }
        }
        // Of no bits between 0 and 1 nothing is left.
        all.retain(|format| !matches!(format, Self::Unit(0, _)));
        all.extend((0..6).map(|times| Self::Wrapped(1 << times)));
        all
    }

    /// What a number becomes.
    #[must_use]
    pub fn of(self, v: f64) -> f64 {
        // Powers of two, which have a bit pattern of their own.
        let power = |bits: i32| f64::from_bits(((1023 + bits).max(0) as u64) << 52);
        match self {
            Self::Exact => v,
            Self::Float(..) if v == 0.0 || !v.is_finite() => v,
            Self::Float(bits, to) => {
                let unit = power(exponent(v) - bits);
                whole(v / unit, to) * unit
            }
            Self::Unit(bits, to) => {
                let most = power(bits) - 1.0;
                whole(v.clamp(0.0, 1.0) * most, to) / most
            }
            Self::Fixed(bits, to) => whole(v * power(bits), to) * power(-bits),
            Self::Wrapped(parts) => (v * f64::from(parts)).rem_euclid(1.0) / f64::from(parts),
            Self::Single => rounded(v, 0),
            Self::Half => rounded(v, 2),
        }
    }
}

/// A number in the precision of this number: 0 is 32 bits, 1 is 64, and 2 is 16.
pub(super) fn rounded(v: f64, precision: i64) -> f64 {
    match precision {
        0 => f64::from(v as f32),
        1 => v,
        _ if v.abs() >= 65520.0 => v.signum() * f64::INFINITY,
        _ => {
            // 10 bits after the first one, down to 2^-24: a sum with 1.5 x 2^52 such units has no others, halves to even.
            let large = f64::from_bits(((exponent(v).max(-14) + 42 + 1023) as u64) << 52) * 1.5;
            v + large - large
        }
    }
}

fn whole(v: f64, to: Rounding) -> f64 {
    match to {
        Rounding::Near => (v + 0.5).floor(),
        Rounding::HalfEven => v.round_ties_even(),
        Rounding::HalfAway => v.round(),
        Rounding::Down => v.floor(),
        Rounding::TowardZero => v.trunc(),
    }
}

/// As it is said after 'in'.
impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // How a number is brought to the format, after what the format is.
        let how = |to| match to {
            Rounding::Near => "rounded, halves up",
            Rounding::HalfEven => "rounded, halves to even",
            Rounding::HalfAway => "rounded",
            Rounding::Down => "cut down",
            Rounding::TowardZero => "cut toward zero",
        };
        match *self {
            Self::Exact => write!(f, "exact numbers"),
            Self::Float(bits, to) => {
                write!(f, "floats with {bits} bits after the first one, {}", how(to))
            }
            Self::Unit(bits, to) => write!(f, "{bits} bits between 0 and 1, {}", how(to)),
            Self::Fixed(0, to) => write!(f, "whole numbers, {}", how(to)),
            Self::Fixed(bits, to) => write!(f, "{bits} bits of fraction, {}", how(to)),
            Self::Wrapped(1) => write!(f, "fractions alone, as they wrap around at 1"),
            Self::Wrapped(parts) => {
                write!(f, "numbers that begin again at 0 after every 1/{parts}")
            }
            Self::Single => write!(f, "floats of 32 bits"),
            Self::Half => write!(f, "floats of 16 bits"),
        }
    }
}
