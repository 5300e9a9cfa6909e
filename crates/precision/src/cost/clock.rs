//! Interleaved timing: each round runs every pass for a slice of time, and the figure of a pass is
//! the median over the rounds with its quartiles.
//!
//! All choices of one scene run one after the other within a round, so a change of the clock rate or a
//! busy neighbour meets them alike; the order turns by one from round to round. Figures of different
//! runs are not comparable, their ratios nearly are.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

pub struct Pass<'a> {
    /// Passes of one column stay together.
    pub column: usize,
    pub run: Box<dyn FnMut() + 'a>,
}

/// Quartiles of one quantity over the rounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Quartiles")]
pub struct Spread {
    /// A quarter of the rounds were at most this.
    pub low: f64,
    pub median: f64,
    pub high: f64,
}

/// Three numbers from a file, which may be anything.
#[derive(Deserialize)]
struct Quartiles {
    low: f64,
    median: f64,
    high: f64,
}

impl TryFrom<Quartiles> for Spread {
    type Error = String;

    fn try_from(Quartiles { low, median, high }: Quartiles) -> Result<Self, String> {
        if 0.0 <= low && low <= median && 0.0 < median && median <= high {
            Ok(Self { low, median, high })
        } else {
            Err(format!("{low}, {median}, {high} are not the quartiles of times"))
        }
    }
}

impl Spread {
    pub(super) fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |quarters: usize| values[(values.len() - 1) * quarters / 4];
        Self { low: at(1), median: at(2), high: at(3) }
    }

    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { low: self.low * factor, median: self.median * factor, high: self.high * factor }
    }

    fn over(self, count: u64) -> Self {
        self.times(1.0 / count.max(1) as f64)
    }
}

/// The time of a choice on a scene, in nanoseconds, for each pixel and for each item drawn: the same
/// rounds, divided by other counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Time {
    pub pixel_ns: Spread,
    /// Nanoseconds for each triangle or line.
    pub item_ns: Spread,
}

impl Time {
    pub(super) fn new(pass_ns: Spread, pixels: u64, items: u64) -> Self {
        Self { pixel_ns: pass_ns.over(pixels), item_ns: pass_ns.over(items) }
    }
}

/// How often passes are timed, and for how long each time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    pub rounds: usize,
    /// Shorter than what a scheduler grants at once, so that a busy machine disturbs few slices much
    /// and not all of them a little: the median then hardly moves.
    pub slice: Duration,
}

impl Timing {
    pub const USUAL: Self = Self { rounds: 41, slice: Duration::from_millis(1) };
    pub const QUICK: Self = Self { rounds: 7, slice: Duration::from_micros(300) };
    /// Each pass runs a single time.
    pub const ONCE: Self = Self { rounds: 1, slice: Duration::ZERO };
}

/// Runs a pass once, which warms caches. Returns how many runs of it fit into a slice of time, and how long this one took.
pub(super) fn repeats(pass: &mut Pass<'_>, slice: Duration) -> (u32, Duration) {
    let start = Instant::now();
    (pass.run)();
    let once = start.elapsed().max(Duration::from_nanos(50));
    ((slice.as_nanos() / once.as_nanos()).clamp(1, 100_000) as u32, once)
}

/// Nanoseconds of each pass.
pub fn time(
    passes: &mut [Pass<'_>],
    Timing { rounds, slice }: Timing,
    progress: &dyn Fn(f64),
) -> Vec<Spread> {
    // By column, so that the choices of one scene follow each other.
    let mut order: Vec<usize> = (0..passes.len()).collect();
    order.sort_by_key(|&i| passes[i].column);
    let mut repeat = vec![1; passes.len()];
    let mut figures = vec![Vec::with_capacity(rounds); passes.len()];
    for &i in &order {
        let (count, once) = repeats(&mut passes[i], slice);
        repeat[i] = count;
        // What takes longer than a slice is hardly slower without warm caches, so this run is one of the rounds.
        if once > slice {
            figures[i].push(once.as_nanos() as f64);
        }
    }
    for round in 0..rounds {
        for place in 0..order.len() {
            let i = order[(place + round) % order.len()];
            if figures[i].len() == rounds {
                continue;
            }
            let start = Instant::now();
            for _ in 0..repeat[i] {
                (passes[i].run)();
            }
            figures[i].push(start.elapsed().as_nanos() as f64 / f64::from(repeat[i]));
        }
        progress((round + 1) as f64 / rounds as f64);
    }
    figures.into_iter().map(Spread::of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_by_hand() {
        let spread = Spread::of(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!(spread, Spread { low: 2.0, median: 3.0, high: 4.0 });
        assert_eq!(spread.over(2).median, 1.5);
        assert_eq!(Spread::of(vec![7.0]), Spread { low: 7.0, median: 7.0, high: 7.0 });
    }

    /// Every pass runs in every round, whatever it takes. These take longer than a slice, so the run that tells it is one of four.
    #[test]
    fn passes_are_interleaved() {
        let counts = [const { std::cell::Cell::new(0) }; 3];
        let mut passes: Vec<_> = counts
            .iter()
            .enumerate()
            .map(|(column, count)| Pass {
                column,
                run: Box::new(move || {
                    count.set(count.get() + 1);
                    std::thread::sleep(Duration::from_millis(1));
                }),
            })
            .collect();
        assert_eq!(time(&mut passes, Timing { rounds: 4, ..Timing::QUICK }, &|_| ()).len(), 3);
        drop(passes);
        assert!(counts.iter().all(|count| count.get() == 4), "{counts:?}");
    }
}
