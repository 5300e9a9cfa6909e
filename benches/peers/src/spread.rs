//! The median of times with their quartiles.

use std::iter::Sum;

use serde::Serialize;

#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Spread {
    pub median: f64,
    pub quartiles: [f64; 2],
}

impl Spread {
    pub fn of(times: &[f64]) -> Self {
        let mut sorted = times.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |quarter: usize| sorted[(sorted.len() - 1) * quarter / 4];
        Self { median: at(2), quartiles: [at(1), at(3)] }
    }

    /// Half the distance between the quartiles, in percent of the median.
    pub fn percent(&self) -> f64 {
        (self.quartiles[1] - self.quartiles[0]) * 50.0 / self.median
    }
}

impl Sum for Spread {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |sum, one| Self {
            median: sum.median + one.median,
            quartiles: [0, 1].map(|i| sum.quartiles[i] + one.quartiles[i]),
        })
    }
}
