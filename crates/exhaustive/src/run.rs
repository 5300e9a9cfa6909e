//! Works off the chunks of an enumeration on all cores, and can stop and resume anywhere.
//!
//! State is a value: [`Progress`] says which chunks are done and what they found. It is handed to
//! `save` every few seconds, and whoever hands one back continues from there. A run that is killed
//! loses the chunks since the last save and nothing else; a chunk is counted once or not at all.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::identity::{Identity, Shard};
use super::{Plan, Tally};
use rasterproof_core::parallel;
use rasterproof_verify::comparison::caught;

/// How far a run has come: the content of a checkpoint file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Progress {
    pub identity: Identity,
    pub shard: Shard,
    /// Chunks that are done, as half-open ranges in ascending order.
    pub done: Vec<[u64; 2]>,
    pub tally: Tally,
    /// Time spent so far, over all sittings.
    pub seconds: f64,
}

impl Progress {
    pub fn new(plan: &Plan, shard: Shard) -> Self {
        let identity = Identity::of(plan);
        Self { identity, shard, done: Vec::new(), tally: Tally::default(), seconds: 0.0 }
    }

    #[must_use]
    pub fn belongs_to(&self, plan: &Plan, shard: Shard) -> bool {
        self.identity == Identity::of(plan) && self.shard == shard
    }

    /// Checks that a run can have come to this state: that its chunks are chunks of its shard, and its
    /// counts are theirs. What a file says is checked before it is resumed.
    pub fn check(&self) -> Result<(), String> {
        let plan = &self.identity.plan;
        let (Shard { part, parts }, chunks) = (self.shard, plan.enumeration().chunks());
        let mut end = 0;
        for &[from, to] in &self.done {
            if from < end || from >= to || to > chunks {
                return Err(format!(
                    "it says that the chunks from {from} to before {to} are done, which is no range of \
                     the {chunks} chunks, or out of order"
                ));
            }
            end = to;
        }
        let done = self.done.iter().flat_map(|&[from, to]| from..to);
        if let Some(chunk) = done.clone().find(|chunk| chunk.checked_rem(parts) != Some(part)) {
            return Err(format!(
                "it says that chunk {chunk} is done, which does not belong to shard {part} of {parts}"
            ));
        }
        check_seconds(self.seconds)?;
        self.tally.check(plan, done)
    }
}

pub(crate) fn check_seconds(seconds: f64) -> Result<(), String> {
    // A thousand centuries, so that no sum of them overflows.
    if (0.0..3e12).contains(&seconds) {
        Ok(())
    } else {
        Err(format!("it says that it took {seconds:?} s"))
    }
}

/// Runs all chunks of the shard that are not done yet and returns the final state. Every now and
/// then `save` gets the state so far, and after each chunk `step` the cases judged.
///
/// # Panics
/// If `resumed` is a state that [no run can have come to](Progress::check), which whoever reads a file
/// checks first.
pub fn run(
    resumed: Progress,
    save_every: Duration,
    save: &(dyn Fn(&Progress) + Sync),
    step: &(dyn Fn(u64) + Sync),
) -> Progress {
    let plan = resumed.identity.plan.clone();
    let enumeration = plan.enumeration();
    let chunks = enumeration.chunks();
    let mut done = vec![false; chunks as usize];
    for &[from, to] in &resumed.done {
        done[from as usize..to as usize].fill(true);
    }
    let pending: Vec<u64> =
        resumed.shard.chunks(&plan).filter(|&chunk| !done[chunk as usize]).collect();

    let (begun, spent) = (Instant::now(), resumed.seconds);
    let judge = enumeration.judge();
    let state = Mutex::new((resumed, done, Instant::now()));
    parallel::each(pending.len(), &|number| {
        let chunk = pending[number];
        let found = guarded(&judge, chunk);
        step(found.cases);
        // A panic while saving is the end of the run anyway.
        let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
        let (progress, done, saved) = &mut *state;
        progress.tally.add(found).expect("counts of chunks that are checked do not overflow");
        done[chunk as usize] = true;
        if saved.elapsed() >= save_every {
            progress.done = ranges(done);
            progress.seconds = spent + begun.elapsed().as_secs_f64();
            save(progress);
            *saved = Instant::now();
        }
    });
    let (mut progress, done, _) = state.into_inner().unwrap_or_else(PoisonError::into_inner);
    progress.done = ranges(&done);
    progress.seconds = spent + begun.elapsed().as_secs_f64();
    progress
}

/// Judges these chunks of a plan, which are in ascending order, and returns what they hold together.
pub(crate) fn judge_again(plan: &Plan, chosen: &[u64], step: &(dyn Fn(u64) + Sync)) -> Tally {
    let chunks = 0..plan.enumeration().chunks();
    let others: Vec<_> = chunks.map(|chunk| chosen.binary_search(&chunk).is_err()).collect();
    let others = Progress { done: ranges(&others), ..Progress::new(plan, Shard::WHOLE) };
    run(others, Duration::MAX, &|_| {}, step).tally
}

/// A panic of an engine is a finding; the cases of its chunk are then missing from the count too.
fn guarded(judge: &dyn Fn(u64) -> Tally, chunk: u64) -> Tally {
    caught(|| judge(chunk)).unwrap_or_else(|panic| {
        let mut tally = Tally::default();
        tally.wrong(chunk, || format!("panic: {panic}"));
        tally
    })
}

/// The runs of `true` as half-open ranges.
fn ranges(done: &[bool]) -> Vec<[u64; 2]> {
    let mut ranges = Vec::new();
    let mut start = 0;
    for run in done.chunk_by(|a, b| a == b) {
        let end = start + run.len() as u64;
        if run[0] {
            ranges.push([start, end]);
        }
        start = end;
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_by_hand() {
        assert_eq!(ranges(&[true, true, false, true]), [[0, 2], [3, 4]]);
        assert!(ranges(&[false, false]).is_empty());
    }
}
