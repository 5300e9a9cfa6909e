//! Grids that a program may put corners and ends on.

use rasterproof_core::grid::SUBPIXELS;
use rasterproof_verify::convention::{Quantum, Rounding};

/// A field that is a grid, from 1/128 px to whole pixels, with these ways to round onto it.
macro_rules! on_grid {
    (
        $(#[$doc:meta])*
        pub struct $name:ident: $called:literal, $does:literal, $repair:literal, [$($rounding:ident),+]
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        pub struct $name(Quantum);

        impl $crate::stages::search::Field for $name {
            const NAME: &'static str = $called;

            fn options() -> Vec<Self> {
                let steps = (1..=8).map(|bits| 1 << bits);
                let of = |step| {
                    [$(Rounding::$rounding),+].map(|rounding| Self(Quantum { step, rounding }))
                };
                steps.flat_map(of).collect()
            }

            fn says(&self) -> Option<(String, &'static str)> {
                Some((format!($does, $crate::stages::grids::rounded(self.0)), $repair))
            }
        }
    };
}
pub(super) use on_grid;

/// What becomes of a coordinate, such as 'cut to 1/16 px'.
pub fn rounded(grid: Quantum) -> String {
    let unit = unit(grid.step);
    match grid.rounding {
        Rounding::Down => format!("cut to {unit}"),
        to => format!("brought to {unit} ({})", to.name()),
    }
}

/// What a step of so many subpixels is called.
pub fn unit(step: i32) -> String {
    match SUBPIXELS / step {
        1 => "whole pixels".to_owned(),
        parts => format!("1/{parts} px"),
    }
}
