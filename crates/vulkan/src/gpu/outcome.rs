//! What came of a requirement.

use rasterproof_verify::specification::{Clause, Standing};

pub type Outcome = (Standing, String);

/// Errors of values, against the derived bound and against a wider one, up to which they are allowed.
#[derive(Default)]
pub struct Errors {
    values: u64,
    beyond: u64,
    outside: u64,
    worst: f64,
}

impl Errors {
    /// Adds an error with the bound that is derived for it, and the one up to which it is allowed.
    pub fn add(&mut self, error: f64, bound: f64, allowed: f64) {
        self.values += 1;
        self.beyond += u64::from(error > bound);
        self.outside += u64::from(error > allowed);
        self.worst = self.worst.max(error / bound);
    }

    /// What came of them: of `what` there are so many, some beyond `allowed`.
    #[must_use]
    pub fn outcome(&self, what: &str, allowed: &str) -> Outcome {
        let Self { values, beyond, outside, worst } = self;
        let said = format!("{values} {what}, the worst at {worst:.3} of the derived bound");
        let more = format!("{said}, {beyond} beyond it, {outside} of them beyond {allowed}");
        (Standing::of(*beyond == 0, *outside == 0), if *beyond == 0 { said } else { more })
    }
}

/// What the specification asks, and how the device stands to it.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Requirement {
    pub name: String,
    pub rule: Clause,
    pub class: Standing,
    pub detail: String,
}
