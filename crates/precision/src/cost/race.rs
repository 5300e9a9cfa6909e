//! Which of several passes is the fastest, as far as it can be decided: they run in interleaved rounds until the question
//! is decided, and a pass that is shown to be slower leaves.
//!
//! What is compared are the times of two passes in the same round, so that a change of the clock rate meets both. The
//! median of their ratio lies between two of the sorted ratios, with an error that the binomial distribution gives
//! whatever the distribution of the times is: each round is on either side of the median with probability 1/2.

use std::time::{Duration, Instant};

use super::clock::{Pass, Spread, repeats};

/// Two passes whose ratio lies between `1 / EQUAL` and `EQUAL` are equally fast.
pub const EQUAL: f64 = 1.03;

/// The probability of any wrong statement in a race.
const ERROR: f64 = 0.05;

/// Rounds after which the passes are compared, the last of which ends a race. At the end of the budget they are
/// compared once more.
const LOOKS: [usize; 5] = [12, 24, 48, 96, 192];

/// How long a pass is repeated within a round, but for a race without a budget.
const SLICE: Duration = Duration::from_millis(1);

/// What became of a pass in a race, compared with the fastest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    Fastest,
    /// The ratio of the medians is shown to be at most [`EQUAL`], either way.
    Equal,
    Slower,
    /// Not enough rounds fitted into the budget.
    Undecided,
}

#[derive(Clone, Debug)]
pub struct Race {
    /// One entry for each pass, in the order in which they were given; the times too.
    pub finishes: Vec<Finish>,
    pub times: Vec<Spread>,
    /// The rounds in which the fastest pass ran.
    pub rounds: usize,
}

/// The ends of an interval that contains the median of what was measured, but for a probability of `error`; none for too
/// few values.
fn interval(mut values: Vec<f64>, error: f64) -> Option<[f64; 2]> {
    values.sort_by(f64::total_cmp);
    let count = values.len();
    // The median lies below the k-th value, from 0, where at most k values lie below the median.
    let mut probability = 0.5f64.powi(count as i32);
    let mut tail = probability;
    let mut outside = None;
    let mut k = 0;
    while tail <= error / 2.0 && 2 * k < count {
        outside = Some(k);
        probability *= (count - k) as f64 / (k + 1) as f64;
        k += 1;
        tail += probability;
    }
    outside.map(|k| [values[k], values[count - 1 - k]])
}

/// What can be told of the times of a pass and of those of the fastest, round by round.
fn compare(times: &[f64], fastest: &[f64], error: f64) -> Finish {
    let ratios = times.iter().zip(fastest).map(|(a, b)| a / b).collect();
    match interval(ratios, error) {
        Some([low, high]) if low >= 1.0 / EQUAL && high <= EQUAL => Finish::Equal,
        Some([low, _]) if low > 1.0 => Finish::Slower,
        _ => Finish::Undecided,
    }
}

/// Runs passes against each other until it is decided which is the fastest, or the budget is used up. The first comparison may
/// take three times the budget. With `keeps_all` no pass leaves, and all rounds are run.
pub fn race(passes: &mut [&mut Pass<'_>], budget: Duration, keeps_all: bool) -> Race {
    let start = Instant::now();
    let repeats: Vec<u32> =
        passes.iter_mut().map(|pass| repeats(pass, SLICE.min(budget)).0).collect();
    let run = |round: usize, alive: &[usize]| {
        let mut times = Vec::with_capacity(alive.len());
        for place in 0..alive.len() {
            // Backwards in every second round, so that no pass always follows the same one.
            let turned = (place + round / 2) % alive.len();
            let at = if round.is_multiple_of(2) { turned } else { alive.len() - 1 - turned };
            let i = alive[at];
            let start = Instant::now();
            for _ in 0..repeats[i] {
                (passes[i].run)();
            }
            times.push((i, start.elapsed().as_nanos() as f64 / f64::from(repeats[i])));
        }
        times
    };
    let mut done = 0;
    let mut has_time = || {
        done += 1;
        // Before the first look nothing is decided.
        start.elapsed() < if done < LOOKS[0] { 3 * budget } else { budget }
    };
    decide(repeats.len(), run, &mut has_time, keeps_all)
}

fn decide(
    count: usize,
    mut run: impl FnMut(usize, &[usize]) -> Vec<(usize, f64)>,
    has_time: &mut dyn FnMut() -> bool,
    keeps_all: bool,
) -> Race {
    let mut finishes = vec![Finish::Undecided; count];
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); count];
    let mut alive: Vec<usize> = (0..count).collect();
    let error = ERROR / ((LOOKS.len() + 1) * count.saturating_sub(1).max(1)) as f64;
    let mut rounds = 0;
    while let Some(&last) = LOOKS.last() {
        for (i, time) in run(rounds, &alive) {
            times[i].push(time);
        }
        rounds += 1;
        let is_over = rounds >= last || !has_time();
        if !is_over && !LOOKS.contains(&rounds) {
            continue;
        }
        let median = |i: &usize| Spread::of(times[*i].clone()).median;
        let Some(fastest) = alive.iter().copied().min_by(|a, b| median(a).total_cmp(&median(b)))
        else {
            break;
        };
        for &i in &alive {
            finishes[i] = match i == fastest {
                true => Finish::Fastest,
                false => compare(&times[i], &times[fastest], error),
            };
        }
        if !keeps_all {
            alive.retain(|&i| finishes[i] != Finish::Slower);
        }
        let is_decided = alive.iter().all(|&i| finishes[i] != Finish::Undecided);
        if is_over || (is_decided && !keeps_all) {
            break;
        }
    }
    Race { finishes, times: times.into_iter().map(Spread::of).collect(), rounds }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_core::random::Rng;

    /// By hand: of 12 values all lie on one side of the median with probability 2^-12, and at most one on a side with
    /// 13 times that.
    #[test]
    fn intervals_by_hand() {
        let values = || (1..=12).map(f64::from).collect::<Vec<_>>();
        let tail = 0.5f64.powi(12);
        assert_eq!(interval(values(), 2.0 * tail), Some([1.0, 12.0]));
        assert_eq!(interval(values(), 1.99 * tail), None);
        assert_eq!(interval(values(), 26.0 * tail), Some([2.0, 11.0]));
        assert_eq!(interval(values(), 25.9 * tail), Some([1.0, 12.0]));
        assert_eq!(interval(Vec::new(), 0.5), None);
    }

    /// A race of passes of known times, with noise of a share of the time: as many rounds as there are.
    fn raced(seed: u64, times: &[f64], noise: f64, most: usize) -> Race {
        let mut rng = Rng::new("race", seed, 0);
        let mut rounds = 0;
        let run = |_: usize, alive: &[usize]| {
            // What meets all of a round alike.
            let slow = 1.0 + rng.unit();
            let time = |&i: &usize| (i, times[i] * slow * (1.0 + noise * rng.signed()));
            alive.iter().map(time).collect()
        };
        let mut has_time = || {
            rounds += 1;
            rounds < most
        };
        decide(times.len(), run, &mut has_time, false)
    }

    #[test]
    fn what_is_decided_is_true() {
        let mut wrong = 0;
        for seed in 0..200 {
            let Race { finishes, .. } = raced(seed, &[1.0, 1.1, 1.005, 2.0], 0.1, 1000);
            let is_wrong = |(i, finish): (usize, &Finish)| match finish {
                Finish::Slower => i == 0,
                Finish::Equal | Finish::Fastest => i == 1 || i == 3,
                Finish::Undecided => i == 3,
            };
            wrong += u32::from(finishes.iter().enumerate().any(is_wrong));
        }
        assert!(wrong <= 10, "{wrong} of 200, of which {ERROR} may be");
    }

    #[test]
    fn a_race_ends_when_it_is_decided() {
        use Finish::{Equal, Fastest, Slower};
        let clear = raced(1, &[1.0, 1.5, 1.001], 0.01, 1000);
        assert_eq!(clear.rounds, LOOKS[0]);
        assert_eq!(clear.finishes[1], Slower);
        assert!(matches!(clear.finishes[..], [Fastest, _, Equal] | [Equal, _, Fastest]));
        let short = raced(1, &[1.0, 1.01], 0.2, 5);
        assert_eq!((short.rounds, short.finishes.contains(&Finish::Undecided)), (5, true));
        let alone = raced(1, &[1.0], 0.2, 1000);
        assert_eq!(alone.finishes, [Fastest]);
        assert_eq!(raced(1, &[], 0.2, 1000).finishes, []);
    }
}
