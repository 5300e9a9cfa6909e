//! Times that can be compared. Passes that do the same job run in the same rounds, by a clock that other programs hardly
//! disturb, and two times are compared by the ratios that they have in each round.
//!
//! - The order of a round is drawn anew. It is balanced: in a set of orders each pass follows each other one equally often.
//! - The clock is the processor time of the thread, so a round in which another program ran is not longer.
//! - A pass of a few milliseconds runs once untimed before it is timed, so that it finds the caches and the heap as it left them
//!   itself, and not as the pass before it did.
//! - Passes of a column write to one frame, which begins at a line of the cache wherever the heap puts it, so that ratios do not
//!   depend on where it happens to lie in this process.
//! - One pass runs twice in each round, as if it were two (A/A). What the ratio of the two is off 1 is the noise.
//! - The ratio of two passes is the median of the ratios in the single rounds, with an interval: the true median lies between two
//!   of the sorted ratios, by the binomial distribution, whatever the times are like.
//! - There are more rounds while an interval is wide, until the time is over.

use std::fmt;
use std::sync::Arc;
use std::time::{Duration, Instant};

use rasterproof_core::random::Rng;
use serde::{Deserialize, Serialize};

/// What a pass is timed by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Clock {
    /// The processor time of this thread.
    #[default]
    Thread,
    /// The processor time of all threads of this process together.
    Threads,
    /// The time that passes, for work of which the processor does none.
    Wall,
}

impl Clock {
    /// Nanoseconds since some moment.
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    #[must_use]
    pub fn now(self) -> f64 {
        use rustix::time::{ClockId, clock_gettime};
        let now = clock_gettime(match self {
            Self::Thread => ClockId::ThreadCPUTime,
            Self::Threads => ClockId::ProcessCPUTime,
            Self::Wall => ClockId::Monotonic,
        });
        now.tv_sec as f64 * 1e9 + now.tv_nsec as f64
    }

    /// Nanoseconds since some moment. Other systems have no such clock of threads, or one of whole milliseconds.
    #[cfg(not(any(target_os = "linux", target_os = "macos")))]
    #[must_use]
    pub fn now(self) -> f64 {
        use std::sync::OnceLock;
        static START: OnceLock<Instant> = OnceLock::new();
        START.get_or_init(Instant::now).elapsed().as_nanos() as f64
    }
}

/// What is timed: a closure that does all of the work once.
pub struct Pass<'a> {
    clock: Clock,
    run: Box<dyn FnMut() + 'a>,
}

impl<'a> Pass<'a> {
    pub fn new(run: impl FnMut() + 'a) -> Self {
        Self { clock: Clock::Thread, run: Box::new(run) }
    }

    #[must_use]
    pub fn by(self, clock: Clock) -> Self {
        Self { clock, ..self }
    }

    /// Nanoseconds of each of some runs.
    fn time(&mut self, runs: u32) -> f64 {
        let start = self.clock.now();
        for _ in 0..runs {
            (self.run)();
        }
        (self.clock.now() - start).max(1.0) / f64::from(runs)
    }
}

/// Quartiles of one quantity over the rounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// A quarter of the rounds were at most this.
    pub low: f64,
    pub median: f64,
    pub high: f64,
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let at = |quarters: usize| values[(values.len() - 1) * quarters / 4];
        Self { low: at(1), median: at(2), high: at(3) }
    }

    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { low: self.low * factor, median: self.median * factor, high: self.high * factor }
    }
}

/// How many times the ratio of two passes in one process is that of the same two in another, at most, in 95% of cases. Where pages lie
/// in memory and what other programs do to the caches differs between processes, and no number of rounds shows it. Measured: 163 ratios of
/// three models, each in two processes, on two cores that 8 to 13 other programs wanted, were 1.009 times off in the middle, 1.072 in
/// 90% and 1.078 in 95%; 162 others, with 12 to 20 other programs, 1.009, 1.049 and 1.076.
const BETWEEN: f64 = 1.075;

/// The probability that an interval does not contain the median of what it is of.
const ERROR: f64 = 0.01;

/// An interval is wide where an end of it is farther than this from the median: as much again as `BETWEEN` makes of it.
const WIDE: f64 = 1.15;

/// How many times as long one pass takes as another one: the median of the ratios in the rounds in which both ran, and an interval
/// around it, which the noise of the comparison widens, and `BETWEEN`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ratio {
    pub low: f64,
    pub median: f64,
    pub high: f64,
    /// None of a pass with itself.
    #[serde(default)]
    pub rounds: usize,
}

/// What may be said of a ratio.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RatioKind {
    /// The ratio holds: its interval is narrow, and 1 is not in it.
    Holds,
    /// The interval is narrow and holds 1.
    NoDifference,
    /// The interval is wide, or there were too few rounds for one.
    CannotBeTold,
}

impl Ratio {
    /// That of a pass with itself.
    pub const ONE: Self = Self { low: 1.0, median: 1.0, high: 1.0, rounds: 0 };

    /// The median of some ratios; of too few the interval holds all of them.
    fn of(mut ratios: Vec<f64>) -> Self {
        ratios.sort_by(f64::total_cmp);
        let rounds = ratios.len();
        let outside = outside(rounds).unwrap_or(0);
        let median = (ratios[(rounds - 1) / 2] * ratios[rounds / 2]).sqrt();
        Self { low: ratios[outside], median, high: ratios[rounds - 1 - outside], rounds }
    }

    /// How many times one of two is the other, whichever is larger.
    #[must_use]
    pub fn off_one(self) -> f64 {
        self.median.max(1.0 / self.median)
    }

    fn widened(self, by: f64) -> Self {
        Self { low: self.low / by, high: self.high * by, ..self }
    }

    /// The ratio of the other two to each other.
    #[must_use]
    pub fn inverse(self) -> Self {
        let [low, median, high] = [self.high, self.median, self.low].map(f64::recip);
        Self { low, median, high, ..self }
    }

    /// Whether an end of the interval is far from the median, or it is none.
    fn is_wide(&self) -> bool {
        let is_far = self.high > WIDE * self.median || self.median > WIDE * self.low;
        is_far || self.rounds > 0 && outside(self.rounds).is_none()
    }

    #[must_use]
    pub fn said(&self) -> RatioKind {
        let holds_one = self.low <= 1.0 && 1.0 <= self.high;
        match (self.is_wide(), holds_one) {
            (true, _) => RatioKind::CannotBeTold,
            (false, true) => RatioKind::NoDifference,
            (false, false) => RatioKind::Holds,
        }
    }

    /// In a sentence: `4.6 times as long (4.4 to 4.9)`, `no difference`, or `cannot be told here (2 to 12 times as long)`.
    #[must_use]
    pub fn words(&self, as_what: &str) -> String {
        match self.said() {
            RatioKind::Holds => {
                let [low, median, high] = [self.low, self.median, self.high].map(short);
                format!("{median} times as {as_what} ({low} to {high})")
            }
            RatioKind::NoDifference => "no difference".to_owned(),
            RatioKind::CannotBeTold => {
                let [low, high] = [self.low, self.high].map(short);
                format!("cannot be told here ({low} to {high} times as {as_what})")
            }
        }
    }

    /// The share of time that is saved where the ratio is that of without to with: `30% (28 to 33)`, or the other two. It is told
    /// where the share is known to a tenth of the time.
    #[must_use]
    pub fn saving(&self) -> String {
        let shares = [self.low, self.median, self.high].map(|times| 100.0 * (1.0 - 1.0 / times));
        let [low, median, high] = shares.map(|share| format!("{share:.0}"));
        let is_known = outside(self.rounds).is_some() && shares[2] - shares[0] <= 10.0;
        match self.said() {
            RatioKind::NoDifference => "no difference".to_owned(),
            RatioKind::CannotBeTold if !is_known => format!("{low} to {high}%?"),
            RatioKind::Holds | RatioKind::CannotBeTold => format!("{median}% ({low} to {high})"),
        }
    }
}

/// In a cell of a table: `4.6 (4.4-4.9)`, `same`, or `2-12?`.
impl fmt::Display for Ratio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, median, high] = [self.low, self.median, self.high].map(short);
        match self.said() {
            _ if *self == Self::ONE => write!(f, "1"),
            RatioKind::Holds => write!(f, "{median} ({low}-{high})"),
            RatioKind::NoDifference => write!(f, "same"),
            RatioKind::CannotBeTold => write!(f, "{low}-{high}?"),
        }
    }
}

/// What stands below a table with such cells.
pub const CELLS: &str = "4.6 (4.4-4.9): the median ratio of the rounds and its interval; same: no difference; 2-12?: cannot be told here";

/// A number with three digits.
fn short(value: f64) -> String {
    match value {
        v if v >= 99.95 => format!("{v:.0}"),
        v if v >= 9.995 => format!("{v:.1}"),
        v => format!("{v:.2}"),
    }
}

/// How many of so many sorted values lie outside an interval, on either side, that contains the median but for a probability of
/// [`ERROR`]; none for too few values. The median lies below the k-th value, from 0, where at most k values lie below the median,
/// and each does with probability 1/2.
fn outside(count: usize) -> Option<usize> {
    let mut probability = 0.5f64.powi(count.min(1000) as i32);
    let mut tail = probability;
    let mut outside = None;
    let mut k = 0;
    while tail <= ERROR / 2.0 && 2 * k < count.min(1000) {
        outside = Some(k);
        probability *= (count - k) as f64 / (k + 1) as f64;
        k += 1;
        tail += probability;
    }
    outside
}

/// The times of a pass, round by round, among those that it was compared with.
#[derive(Clone, Debug)]
pub struct Times {
    ns: Vec<f64>,
    /// The same for all passes of a comparison: the ratio of two equal passes in it, where there are enough rounds.
    noise: Arc<Option<Ratio>>,
    /// The time that passed, of a pass for which that is another one.
    pub wall_ns: Option<f64>,
}

impl Times {
    /// Those of passes that ran in the same rounds, by pass and by round.
    #[must_use]
    pub fn of(all: Vec<Vec<f64>>, noise: Option<Ratio>) -> Vec<Self> {
        let noise = Arc::new(noise);
        let times = all.into_iter();
        times.map(|ns| Self { ns, noise: Arc::clone(&noise), wall_ns: None }).collect()
    }

    #[must_use]
    pub fn spread(&self) -> Spread {
        Spread::of(self.ns.clone())
    }

    #[must_use]
    pub fn median(&self) -> f64 {
        self.spread().median
    }

    #[must_use]
    pub fn rounds(&self) -> usize {
        self.ns.len()
    }

    /// The ratio of two equal passes in the same rounds.
    #[must_use]
    pub fn noise(&self) -> Option<Ratio> {
        *self.noise
    }

    /// How many times as long this takes as another pass; nothing of two that did not run in the same rounds.
    #[must_use]
    pub fn over(&self, other: &Self) -> Option<Ratio> {
        if !Arc::ptr_eq(&self.noise, &other.noise) {
            return None;
        }
        if std::ptr::eq(self, other) {
            return Some(Ratio::ONE);
        }
        let noise = self.noise.map_or(1.0, Ratio::off_one);
        Some(ratio(&self.ns, &other.ns).widened(noise * BETWEEN))
    }
}

/// A pass that left early is compared in the rounds in which it ran.
fn ratio(a: &[f64], b: &[f64]) -> Ratio {
    Ratio::of(a.iter().zip(b).map(|(a, b)| a / b).collect())
}

/// How often and for how long passes are timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// How long a pass is repeated within a round: shorter than what a scheduler grants at once.
    pub slice: Duration,
    /// After so much processor time no more rounds begin, once there are as many as an interval needs. Those may take three times
    /// as much. Where other programs run, this takes longer, but at most `LONGER` times.
    pub budget: Duration,
    /// As many rounds instead.
    pub rounds: Option<usize>,
}

impl Timing {
    pub const USUAL: Self =
        Self { slice: Duration::from_millis(1), budget: Duration::from_millis(4000), rounds: None };
    pub const QUICK: Self = Self {
        slice: Duration::from_micros(300),
        budget: Duration::from_millis(600),
        rounds: None,
    };
    /// Each pass runs a single time.
    pub const ONCE: Self = Self { slice: Duration::ZERO, budget: Duration::ZERO, rounds: Some(1) };

    #[must_use]
    pub fn within(self, factor: f64) -> Self {
        Self { budget: self.budget.mul_f64(factor), ..self }
    }
}

/// How many times as long as the processor time a comparison may take.
const LONGER: f64 = 6.0;

/// The fewest rounds that have an interval, and other numbers of rounds after which it is asked whether more are needed.
const LOOKS: [usize; 6] = [8, 16, 32, 64, 128, 256];

/// A pass that takes so many times as long as the one that others are compared with leaves when its ratio is settled.
const COSTLY: f64 = 8.0;

/// Of each set of passes all others with the fastest one, as pairs.
fn over_fastest(sets: &[Vec<usize>], medians: &[f64]) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for set in sets {
        let fastest = set.iter().copied().min_by(|a, b| medians[*a].total_cmp(&medians[*b]));
        let Some(fastest) = fastest else { continue };
        pairs.extend(set.iter().filter(|one| **one != fastest).map(|one| [*one, fastest]));
    }
    pairs
}

/// Times passes in the same rounds. The passes of each set are to be compared with each other.
pub fn compare(
    passes: &mut [Pass<'_>],
    timing: Timing,
    sets: &[Vec<usize>],
    progress: &dyn Fn(f64),
) -> Vec<Times> {
    let (start, used) = (Instant::now(), Clock::Threads.now());
    keep_heap();
    let first: Vec<f64> = passes.iter_mut().map(|pass| pass.time(1)).collect();
    let slice = timing.slice.as_nanos() as f64;
    // The first run of a pass warms caches up; what it takes is near enough to say how often it fits into a slice.
    let repeats: Vec<u32> = first.iter().map(|ns| (slice / ns).clamp(1.0, 1e5) as u32).collect();
    let mut wall: Vec<Vec<f64>> = vec![Vec::new(); passes.len()];
    let mut run = |number: usize| {
        let pass = &mut passes[number];
        if first[number] < WARMED_NS {
            (pass.run)();
        }
        let start = Instant::now();
        let ns = pass.time(repeats[number]);
        wall[number].push(start.elapsed().as_nanos() as f64 / f64::from(repeats[number]));
        ns
    };
    let limit = timing.budget.as_secs_f64().max(1e-9);
    let mut has_time = |rounds: usize| {
        let used = (Clock::Threads.now() - used) / 1e9;
        let share = used.max(start.elapsed().as_secs_f64() / LONGER) / limit;
        progress(share.min(1.0));
        // Before the first look nothing can be told.
        share < if rounds < LOOKS[0] { 3.0 } else { 1.0 }
    };
    let (times, noise) = match timing.rounds {
        Some(1) => (first.iter().map(|ns| vec![*ns]).collect(), None),
        fixed => in_rounds(&first, fixed, sets, &mut run, &mut has_time),
    };
    let mut times = Times::of(times, noise);
    for ((times, wall), pass) in times.iter_mut().zip(wall).zip(passes) {
        if pass.clock == Clock::Threads && !wall.is_empty() {
            times.wall_ns = Some(Spread::of(wall).median);
        }
    }
    times
}

/// A pass that takes longer than this has forgotten what was before it when it is over.
const WARMED_NS: f64 = 1e7;

/// Makes the usual allocator of Linux keep what is given back: once it gave back a block of this size, it takes smaller ones from its
/// heap, and does not shrink that by less than twice as much. Otherwise a frame pays for the pages that the one before it gave back.
fn keep_heap() {
    drop(std::hint::black_box(vec![0u8; 31 << 20]));
}

/// Runs rounds until all passes of each set are told from the fastest or the time is over; `run` takes the number of a pass and returns its time.
/// Returns the times by pass, and the noise.
fn in_rounds(
    first: &[f64],
    fixed: Option<usize>,
    sets: &[Vec<usize>],
    run: &mut dyn FnMut(usize) -> f64,
    has_time: &mut dyn FnMut(usize) -> bool,
) -> (Vec<Vec<f64>>, Option<Ratio>) {
    // The pass that others are compared with runs a second time in each round, under the last number.
    let twin = first.len();
    let of_twin = over_fastest(sets, first).first().map_or(0, |pair| pair[1]);
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); twin + 1];
    let mut order = Order::new((0..=twin).collect());
    let mut rounds = 0;
    while !first.is_empty() {
        for slot in order.draw() {
            times[slot].push(run(if slot == twin { of_twin } else { slot }));
        }
        rounds += 1;
        let is_over = fixed.map_or_else(|| !has_time(rounds), |fixed| rounds >= fixed);
        if is_over || rounds == LOOKS[LOOKS.len() - 1] && fixed.is_none() {
            break;
        }
        if fixed.is_some() || !LOOKS.contains(&rounds) {
            continue;
        }
        let medians: Vec<f64> =
            times[..twin].iter().map(|ns| Spread::of(ns.clone()).median).collect();
        let mut pairs = over_fastest(sets, &medians);
        let noise = ratio(&times[twin], &times[of_twin]).off_one();
        pairs.retain(|&[a, b]| ratio(&times[a], &times[b]).widened(noise * BETWEEN).is_wide());
        if pairs.is_empty() {
            break;
        }
        // Whoever takes long and is in no such pair leaves, so that there is more time for the others.
        let is_needed = |slot: &usize| {
            let takes_long = *slot != twin && first[*slot] > COSTLY * first[of_twin];
            !takes_long || pairs.iter().any(|pair| pair.contains(slot))
        };
        // One that left is not taken back: its rounds would not be those of the others.
        let before = order.slots.iter().copied();
        let needed: Vec<usize> = before.filter(is_needed).collect();
        if needed.len() < order.slots.len() {
            order = Order::new(needed);
        }
    }
    let of_twin = times.get(of_twin).filter(|_| outside(rounds).is_some());
    let noise = of_twin.map(|of_twin| ratio(&times[twin], of_twin));
    times.truncate(twin);
    (times, noise)
}

/// Orders in which, taken together, each slot directly follows each other one equally often (Williams 1949).
struct Order {
    slots: Vec<usize>,
    rng: Rng,
    left: Vec<Vec<usize>>,
}

impl Order {
    fn new(slots: Vec<usize>) -> Self {
        let rng = Rng::new("order of passes", slots.len() as u64, 0);
        Self { slots, rng, left: Vec::new() }
    }

    /// The order of the next round.
    fn draw(&mut self) -> Vec<usize> {
        if self.left.is_empty() {
            self.refill();
        }
        self.left.pop().unwrap_or_default()
    }

    fn refill(&mut self) {
        let count = self.slots.len();
        let mut names = self.slots.clone();
        shuffle(&mut names, &mut self.rng);
        // 0, 1, n - 1, 2, n - 2 and so on: the distances of neighbours are all different. Of an odd number only together with the
        // same backwards.
        let zigzag =
            |place: usize| if place % 2 == 1 { place.div_ceil(2) } else { count - place / 2 };
        for turn in 0..count {
            let row = (0..count).map(|place| names[(zigzag(place) + turn) % count]);
            let row: Vec<usize> = row.collect();
            if count % 2 == 1 {
                self.left.push(row.iter().rev().copied().collect());
            }
            self.left.push(row);
        }
        shuffle(&mut self.left, &mut self.rng);
    }
}

fn shuffle<T>(all: &mut [T], rng: &mut Rng) {
    for place in (1..all.len()).rev() {
        all.swap(place, rng.int(0, place as i64) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_by_hand() {
        let spread = Spread::of(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!(spread, Spread { low: 2.0, median: 3.0, high: 4.0 });
        assert_eq!(Spread::of(vec![7.0]), Spread { low: 7.0, median: 7.0, high: 7.0 });
    }

    /// By hand: of 8 values all lie on one side of the median with probability 2 / 2^8 < 1%, and of 7 with 2 / 2^7. Of 12 at most one lies on
    /// a side with probability 13 / 2^12, and at most two with 79 / 2^12.
    #[test]
    fn intervals_by_hand() {
        assert_eq!([0, 7, 8, 11, 12].map(outside), [None, None, Some(0), Some(0), Some(1)]);
        let ratio = Ratio::of((1..=12).rev().map(f64::from).collect());
        assert_eq!([ratio.low, ratio.high], [2.0, 11.0]);
        assert!((ratio.median - 42f64.sqrt()).abs() < 1e-12);
    }

    fn ratio(low: f64, median: f64, high: f64, rounds: usize) -> Ratio {
        Ratio { low, median, high, rounds }
    }

    /// One wording: a number where it holds, no number where 1 is in the interval, and the interval alone where it is wide.
    #[test]
    fn a_ratio_says_no_more_than_it_holds() {
        let words = |low, median, high, rounds| ratio(low, median, high, rounds).words("long");
        assert_eq!(words(4.4, 4.6, 4.9, 9), "4.60 times as long (4.40 to 4.90)");
        assert_eq!(words(0.97, 1.01, 1.06, 9), "no difference");
        assert_eq!(words(1.02, 1.04, 1.06, 9), "1.04 times as long (1.02 to 1.06)");
        assert_eq!(words(2.0, 5.0, 12.0, 99), "cannot be told here (2.00 to 12.0 times as long)");
        assert_eq!(words(0.8, 1.0, 1.2, 99), "cannot be told here (0.80 to 1.20 times as long)");
        let few = "cannot be told here (1.90 to 2.10 times as long)";
        assert_eq!(words(1.9, 2.0, 2.1, 7), few, "too few rounds");
        let cells = [ratio(4.4, 4.6, 4.9, 9), ratio(0.99, 1.0, 1.01, 9), ratio(2.0, 5.0, 12.0, 9)];
        assert_eq!(cells.map(|one| one.to_string()), ["4.60 (4.40-4.90)", "same", "2.00-12.0?"]);
        assert_eq!(
            cells.map(|one| one.saving()),
            ["78% (77 to 80)", "no difference", "50 to 92%?"]
        );
        let large = ratio(20.0, 25.0, 33.0, 9);
        assert_eq!((large.said(), &*large.saving()), (RatioKind::CannotBeTold, "96% (95 to 97)"));
        let half = cells[0].inverse();
        assert!((half.low - 1.0 / 4.9).abs() < 1e-12 && (half.high - 1.0 / 4.4).abs() < 1e-12);
    }

    #[test]
    fn each_pass_follows_each_equally_often() {
        for count in [2usize, 5, 6] {
            let mut order = Order::new((0..count).collect());
            let rounds = if count % 2 == 0 { count } else { 2 * count };
            let mut follows = vec![0; count * count];
            let (mut first, mut all) = (order.draw(), Vec::new());
            for _ in 0..rounds {
                for pair in first.windows(2) {
                    follows[pair[0] * count + pair[1]] += 1;
                }
                all.push(std::mem::replace(&mut first, order.draw()));
            }
            let expected = rounds / count;
            for (place, times) in follows.iter().enumerate() {
                let is_itself = place / count == place % count;
                assert_eq!(*times, if is_itself { 0 } else { expected }, "{count}: {all:?}");
            }
        }
    }

    /// A made-up machine: what each pass takes, a load that comes and goes, noise, and what a pass leaves behind for the next.
    struct Machine {
        ns: Vec<f64>,
        noise: f64,
        /// Added to the time of a pass that follows the first one.
        left_behind: f64,
        rng: Rng,
        last: usize,
    }

    impl Machine {
        fn new(ns: &[f64], noise: f64, seed: u64) -> Self {
            let rng = Rng::new("machine", seed, 0);
            Self { ns: ns.to_vec(), noise, left_behind: 0.0, rng, last: 1 }
        }

        fn time(&mut self, pass: usize) -> f64 {
            let extra = if self.last == 0 { self.left_behind } else { 0.0 };
            self.last = pass;
            (self.ns[pass] + extra) * (1.0 + self.noise * self.rng.signed())
        }

        /// The times of all, within so many rounds, each pass over the fastest.
        fn compare(mut self, most: usize) -> (Vec<Vec<f64>>, Option<Ratio>, usize) {
            let first = self.ns.clone();
            let all = vec![(0..first.len()).collect::<Vec<_>>()];
            let mut rounds = 0;
            let mut has_time = |done: usize| {
                rounds = done;
                done < most
            };
            let (times, noise) =
                in_rounds(&first, None, &all, &mut |pass| self.time(pass), &mut has_time);
            (times, noise, rounds)
        }
    }

    /// The interval holds the true ratio in all but one run of a hundred, whatever the noise is.
    #[test]
    fn intervals_hold_what_is_true() {
        let mut wrong = 0;
        for seed in 0..400 {
            let (times, noise, _) = Machine::new(&[1.0, 1.5], 0.2, seed).compare(300);
            let said = super::ratio(&times[1], &times[0]);
            wrong += u32::from(said.low > 1.5 || said.high < 1.5);
            let noise = noise.unwrap();
            wrong += u32::from(noise.low > 1.0 || noise.high < 1.0);
        }
        // 800 of 1%, looked at up to six times.
        assert!(wrong <= 32, "{wrong}");
    }

    #[test]
    fn there_are_more_rounds_while_an_interval_is_wide() {
        assert_eq!(Machine::new(&[1.0, 2.0], 0.01, 1).compare(1000).2, LOOKS[0]);
        let (times, noise, rounds) = Machine::new(&[1.0, 2.0], 0.1, 1).compare(1000);
        assert!(rounds > LOOKS[0], "{rounds}");
        let times = Times::of(times, noise);
        let said = |times: &[Times]| times[1].over(&times[0]).unwrap().said();
        assert_eq!(said(&times), RatioKind::Holds);
        let (times, noise, rounds) = Machine::new(&[1.0, 2.0], 0.1, 1).compare(5);
        assert_eq!((rounds, noise), (5, None));
        assert_eq!(said(&Times::of(times, noise)), RatioKind::CannotBeTold);
    }

    /// A slow pass of which all is known leaves; one that is near and noisy goes on.
    #[test]
    fn what_is_settled_leaves() {
        let mut rng = Rng::new("noisy", 1, 0);
        let mut run = |pass: usize| match pass {
            1 => 1.1 + 0.5 * rng.signed(),
            pass => [1.0, 0.0, 20.0][pass],
        };
        let sets = [vec![0, 1, 2]];
        let mut has_time = |rounds: usize| rounds < 100;
        let (times, _) = in_rounds(&[1.0, 1.1, 20.0], None, &sets, &mut run, &mut has_time);
        assert_eq!((times[2].len(), times[1].len()), (LOOKS[0], 100));
        let times = Times::of(times, None);
        assert_eq!(times[2].over(&times[0]).unwrap().said(), RatioKind::Holds);
    }

    /// One pass leaves a heap behind for which the next one pays: as each follows it equally often, all pay alike, and equal passes
    /// stay equal. In an order that only turns, the one behind it pays nearly always.
    #[test]
    fn what_a_pass_leaves_behind_meets_all_alike() {
        let heavy = || Machine { left_behind: 0.5, ..Machine::new(&[5.0, 1.0, 1.0], 0.01, 7) };
        let mean = |ns: &[f64]| ns.iter().sum::<f64>() / ns.len() as f64;
        let mut machine = heavy();
        let fixed = Some(240);
        let sets = [vec![0, 1], vec![2, 1]];
        let first = machine.ns.clone();
        let (times, _) =
            in_rounds(&first, fixed, &sets, &mut |pass| machine.time(pass), &mut |_| true);
        let fair = mean(&times[1]) / mean(&times[2]);
        assert!((fair - 1.0).abs() < 0.02, "{fair}");
        let (mut turning, mut times) = (heavy(), [Vec::new(), Vec::new(), Vec::new()]);
        for round in 0..240 {
            for place in 0..3 {
                let pass = (place + round) % 3;
                times[pass].push(turning.time(pass));
            }
        }
        assert!(mean(&times[1]) / mean(&times[2]) > 1.1, "the fault that this is against");
    }

    /// Times of different rounds are not compared, and a pass with itself is 1.
    #[test]
    fn other_rounds_are_not_compared() {
        let mut times = (0..2).flat_map(|_| {
            let mut passes = [Pass::new(|| ())];
            compare(&mut passes, Timing::ONCE, &[], &|_| ())
        });
        let (a, b) = (times.next().unwrap(), times.next().unwrap());
        assert_eq!(a.over(&a), Some(Ratio::ONE));
        assert_eq!(a.over(&b), None);
        assert_eq!(a.over(&a.clone()).map(|ratio| ratio.said()), Some(RatioKind::CannotBeTold));
    }
}
