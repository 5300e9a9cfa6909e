//! What is run, by which code, and which part of it: what a checkpoint and a certificate agree on.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Plan;

/// Part `part` of `parts`: the chunks whose number modulo `parts` is `part`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shard {
    /// Which part, from 0.
    pub part: u64,
    pub parts: u64,
}

impl Shard {
    pub const WHOLE: Self = Self { part: 0, parts: 1 };

    /// The numbers of the chunks of this part. `part` is less than `parts`.
    pub fn chunks(self, plan: &Plan) -> impl Iterator<Item = u64> + Clone {
        let step = usize::try_from(self.parts).unwrap_or(usize::MAX);
        (self.part..plan.enumeration().chunks()).step_by(step)
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Identity {
    pub plan: Plan,
    pub version: String,
    /// SHA-256 of each piece of code the result depends on, see [`super::certificate::code_of`].
    pub sources: BTreeMap<String, String>,
}

impl Identity {
    pub fn of(plan: &Plan) -> Self {
        let version = env!("CARGO_PKG_VERSION").to_owned();
        Self { plan: plan.clone(), version, sources: plan.source_hashes() }
    }
}
