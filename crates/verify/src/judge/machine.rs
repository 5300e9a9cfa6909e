//! The judge as a value. It returns which cases to ask next, and it is given what was found. It calls nobody and reads no clock, so the
//! code that drives it is short, on one thread or on many: see [`Driver`].
//!
//! Batches of cases have numbers. What was found is counted in the order of these numbers, whatever the order of the answers. A verdict
//! therefore does not depend on how fast anybody answers, unless its time is limited.

use std::collections::{BTreeMap, VecDeque};
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::{Options, Shard};

/// What one kind of judge asks, and what it makes of the answers.
pub trait JudgeKind: Sync {
    /// A case and what is checked in it.
    type Job: Send;
    /// What was found about a job, with the answers where these are compared a second time.
    type Judgement: Send;
    /// What came of everything that was counted.
    type Tally: Send;

    /// Adds the jobs of a generated case; none where it belongs to another pass.
    fn jobs(&self, place: Place, number: u64, jobs: &mut Vec<Self::Job>);

    /// Counts a job. What is wrong comes back, to be asked again: a program may answer otherwise then.
    fn count(
        &self,
        tally: &mut Self::Tally,
        place: Place,
        asked: (Self::Job, Self::Judgement),
    ) -> Option<(Self::Job, Self::Judgement)>;

    /// Compares what was found the first time with what was found `again`. The number of the batch orders what is kept.
    fn compare(
        &self,
        tally: &mut Self::Tally,
        of: (u64, Place),
        first: &(Self::Job, Self::Judgement),
        again: Self::Judgement,
    );

    /// How many cases were counted whole.
    fn cases(&self, tally: &Self::Tally) -> u64;

    /// When no more of a pass is begun, counted from the beginning of the judgement.
    fn end(&self, tally: &Self::Tally, pass: usize) -> Option<Duration>;

    /// How often an answer may still be missing in a family; nothing of it is asked or counted after that.
    fn most_deaths(&self, _tally: &Self::Tally, _place: Place) -> u64 {
        u64::MAX
    }
}

/// A job, with what was found about it.
pub type JudgedJob<K> = (<K as JudgeKind>::Job, <K as JudgeKind>::Judgement);

/// Finds something about jobs of a family: about the first ones only, where answers are missing.
pub type Find<'a, K> =
    dyn Fn(Place, &[&<K as JudgeKind>::Job]) -> Vec<<K as JudgeKind>::Judgement> + Sync + 'a;

/// What a worker of this number does.
pub type Work<'a> = dyn Fn(usize) + Sync + 'a;

/// A family, in one of the passes over all families.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    pub pass: usize,
    pub family: usize,
}

/// Which cases are asked, and how many at once. Families take turns, so that a limited time is shared.
#[derive(Clone, Debug)]
pub struct Plan {
    passes: usize,
    /// The numbers of the cases of each family.
    numbers: Vec<Range<u64>>,
    shard: Shard,
    /// Cases of a batch, at most.
    block: u64,
    /// Cases of a family before the next family's turn: at first, and at most.
    least: u64,
    most: u64,
}

impl Plan {
    /// All cases of `options`, in blocks. Of a limited time, rounds begin with one case, so that of a slow engine each family is judged.
    pub fn new<F, T>(
        options: &Options<F, T>,
        [passes, families]: [usize; 2],
        block: u64,
        most: u64,
    ) -> Self {
        Self::of(options, passes, vec![options.numbers(); families], [block, most])
    }

    /// The same where families have different numbers of cases.
    pub fn of<F, T>(
        options: &Options<F, T>,
        passes: usize,
        numbers: Vec<Range<u64>>,
        [block, most]: [u64; 2],
    ) -> Self {
        let least = if options.time_limit.is_some() { 1 } else { most };
        let passes = if numbers.is_empty() { 0 } else { passes };
        Self { passes, numbers, shard: options.shard, block, least, most }
    }

    /// The number of the first case, and the one after the last of any family.
    fn whole(&self) -> Range<u64> {
        let of = |bound: fn(&Range<u64>) -> u64| self.numbers.iter().map(bound);
        of(|r| r.start).min().unwrap_or(0)..of(|r| r.end).max().unwrap_or(0)
    }
}

/// Jobs that are asked at once, by whoever drives the judge.
pub struct Batch<K: JudgeKind> {
    id: u64,
    pub place: Place,
    /// How often an answer may be missing in it.
    pub most_deaths: u64,
    asks: Asks<K>,
}

enum Asks<K: JudgeKind> {
    Cases(Vec<u64>),
    /// Jobs that were wrong, with what was found then.
    Again(Vec<JudgedJob<K>>),
}

impl<K: JudgeKind> Batch<K> {
    /// Whether its jobs were asked before.
    #[must_use]
    pub fn is_again(&self) -> bool {
        matches!(self.asks, Asks::Again(_))
    }

    /// Asks its jobs, and keeps what is found: of the first ones only, where answers are missing.
    pub fn ask(
        self,
        kind: &K,
        ask: impl FnOnce(&[&K::Job]) -> Vec<K::Judgement>,
    ) -> AnsweredBatch<K> {
        let Self { id, place, asks, .. } = self;
        let what = match asks {
            Asks::Cases(numbers) => {
                let mut jobs = Vec::new();
                numbers.into_iter().for_each(|number| kind.jobs(place, number, &mut jobs));
                let found = ask(&jobs.iter().collect::<Vec<_>>());
                Heard::Cases(jobs.into_iter().zip(found).collect())
            }
            Asks::Again(first) => {
                let found = ask(&first.iter().map(|(job, _)| job).collect::<Vec<_>>());
                Heard::Again(first.into_iter().zip(found).collect())
            }
        };
        AnsweredBatch { id, place, what }
    }
}

/// A batch with what was found.
pub struct AnsweredBatch<K: JudgeKind> {
    id: u64,
    place: Place,
    what: Heard<K>,
}

enum Heard<K: JudgeKind> {
    Cases(Vec<JudgedJob<K>>),
    Again(Vec<(JudgedJob<K>, K::Judgement)>),
}

/// Batches that may be ahead of the first one that has no answer.
const MOST_AHEAD: u64 = 256;

/// A judgement that goes on: which cases are still to be asked, what is waited for, and what came of the rest.
pub struct Judge<K: JudgeKind> {
    plan: Plan,
    pub tally: K::Tally,
    /// The family whose turn it is.
    place: Place,
    /// The first case of this round, how many cases of each family it has, and the next case of this family.
    first: u64,
    round: u64,
    number: u64,
    is_begun: bool,
    /// Batches of cases that were handed out, and those that were counted.
    asked: u64,
    counted: u64,
    /// Batches without an answer.
    open: usize,
    /// Answers that came before those of an earlier batch.
    early: BTreeMap<u64, AnsweredBatch<K>>,
    again: VecDeque<Batch<K>>,
    /// Whether the time was up before all cases were asked.
    pub is_late: bool,
}

impl<K: JudgeKind> Judge<K> {
    pub fn new(plan: Plan, tally: K::Tally) -> Self {
        let (first, round) = (plan.whole().start, plan.least);
        Self {
            plan,
            tally,
            place: Place { pass: 0, family: 0 },
            first,
            round,
            number: first,
            is_begun: false,
            asked: 0,
            counted: 0,
            open: 0,
            early: BTreeMap::new(),
            again: VecDeque::new(),
            is_late: false,
        }
    }

    /// What to ask next, so long after the beginning. Nothing where answers have to come first, and where all is done.
    pub fn next(&mut self, kind: &K, now: Duration) -> Option<Batch<K>> {
        let batch = match self.again.pop_front() {
            Some(again) => Some(again),
            None => self.next_cases(kind, now),
        };
        self.open += usize::from(batch.is_some());
        batch
    }

    fn next_cases(&mut self, kind: &K, now: Duration) -> Option<Batch<K>> {
        while self.place.pass < self.plan.passes && self.asked - self.counted < MOST_AHEAD {
            let place = self.place;
            let is_over = kind.end(&self.tally, place.pass).is_some_and(|end| now >= end);
            // The first block of all is asked whatever the limit.
            if is_over && self.is_begun {
                self.is_late = true;
                self.begin_pass(place.pass + 1);
                continue;
            }
            self.is_begun = true;
            let end = self.first.saturating_add(self.round);
            let of_family = end.min(self.plan.numbers[place.family].end);
            let block = self.number..of_family.min(self.number.saturating_add(self.plan.block));
            let most_deaths = kind.most_deaths(&self.tally, place);
            if block.is_empty() || most_deaths == 0 {
                self.next_family(end);
                continue;
            }
            self.number = block.end;
            let Shard { part, parts } = self.plan.shard;
            let numbers: Vec<u64> = block.filter(|number| number % parts == part).collect();
            if !numbers.is_empty() {
                let id = self.asked;
                self.asked += 1;
                return Some(Batch { id, place, most_deaths, asks: Asks::Cases(numbers) });
            }
        }
        None
    }

    /// Goes on with the next family, and after the last one with the next round.
    fn next_family(&mut self, end: u64) {
        self.place.family += 1;
        if self.place.family == self.plan.numbers.len() {
            self.place.family = 0;
            self.first = end;
            self.round = self.plan.most.min(2 * self.round);
        }
        self.number = self.first;
        if self.first >= self.plan.whole().end {
            self.begin_pass(self.place.pass + 1);
        }
    }

    fn begin_pass(&mut self, pass: usize) {
        self.place = Place { pass, family: 0 };
        (self.first, self.number) = (self.plan.whole().start, self.plan.whole().start);
        self.round = self.plan.least;
    }

    /// Takes what was found, and returns how many more cases are counted now.
    pub fn answer(&mut self, kind: &K, answered: AnsweredBatch<K>) -> u64 {
        self.open -= 1;
        let before = kind.cases(&self.tally);
        match answered.what {
            Heard::Cases(_) => drop(self.early.insert(answered.id, answered)),
            Heard::Again(heard) => {
                for (first, again) in heard {
                    kind.compare(&mut self.tally, (answered.id, answered.place), &first, again);
                }
            }
        }
        while let Some(next) = self.early.remove(&self.counted) {
            self.counted += 1;
            self.count(kind, next);
        }
        kind.cases(&self.tally) - before
    }

    /// Counts a batch whose turn it is.
    fn count(&mut self, kind: &K, AnsweredBatch { id, place, what }: AnsweredBatch<K>) {
        let Heard::Cases(found) = what else { return };
        let most_deaths = kind.most_deaths(&self.tally, place).max(1);
        let mut wrong = Vec::new();
        for asked in found {
            // Meanwhile an earlier batch may have shown that the family is not to be asked any more.
            if kind.most_deaths(&self.tally, place) == 0 {
                break;
            }
            wrong.extend(kind.count(&mut self.tally, place, asked));
        }
        if !wrong.is_empty() {
            self.again.push_back(Batch { id, place, most_deaths, asks: Asks::Again(wrong) });
        }
    }

    /// Whether nothing is to be asked, and nothing is waited for.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.place.pass >= self.plan.passes && self.again.is_empty() && self.open == 0
    }
}

/// Keeps what came first of its sort, in the order of batches.
pub fn keep_first<T>(
    kept: &mut Vec<(u64, T)>,
    batch: u64,
    item: T,
    is_same: impl Fn(&T, &T) -> bool,
) {
    let known = kept.iter().position(|(_, known)| is_same(known, &item));
    if known.is_some_and(|at| kept[at].0 <= batch) {
        return;
    }
    known.map(|at| kept.remove(at));
    kept.push((batch, item));
    kept.sort_by_key(|(batch, _)| *batch);
}

/// Whoever drives a judge.
pub struct Driver<'a, K: JudgeKind> {
    /// The time since the beginning.
    pub now: &'a (dyn Fn() -> Duration + Sync),
    /// Calls a function with the number of each worker, on as many threads as there are.
    pub workers: &'a dyn Fn(&Work<'_>),
    /// What a worker finds about a batch.
    pub ask: &'a (dyn Fn(usize, Batch<K>) -> AnsweredBatch<K> + Sync),
    /// Is given how many more cases are counted.
    pub progress: &'a (dyn Fn(u64) + Sync),
}

impl<K: JudgeKind> Driver<'_, K> {
    /// Asks until all is done. No worker waits for another one: it ends where there is nothing to ask. When all of them have ended,
    /// and answers have led to more questions meanwhile, they begin anew.
    pub fn drive(&self, kind: &K, judge: Judge<K>) -> Judge<K> {
        let judge = Mutex::new(judge);
        let next = || lock(&judge).next(kind, (self.now)());
        let work = |worker: usize| {
            while let Some(batch) = next() {
                let answered = (self.ask)(worker, batch);
                let cases = lock(&judge).answer(kind, answered);
                (self.progress)(cases);
            }
        };
        while !lock(&judge).is_done() {
            (self.workers)(&work);
        }
        judge.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

fn lock<T>(value: &Mutex<T>) -> MutexGuard<'_, T> {
    value.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comparison::Options;
    use rasterproof_core::parallel;
    use rasterproof_core::random::Rng;

    /// A subject whose answer to each case is a number, made of the case alone.
    #[derive(Clone, Copy)]
    struct Toy {
        /// Whether some answers are missing.
        dies: bool,
        end: Option<Duration>,
    }

    const FAMILIES: usize = 3;
    const MOST_DEATHS: u64 = 3;

    fn answer(place: Place, number: u64, time: u64) -> u64 {
        Rng::new("toy", place.pass as u64 * 8 + place.family as u64, 2 * number + time).int(0, 99)
            as u64
    }

    /// Everything that was counted, in its order.
    #[derive(Clone, Debug, Default, PartialEq)]
    struct Counts {
        cases: Vec<(usize, usize, u64)>,
        deaths: [u64; FAMILIES],
        /// The first case of each last digit that was answered otherwise the second time.
        changing: Vec<(u64, (usize, u64))>,
    }

    impl JudgeKind for Toy {
        type Job = (Place, u64);
        type Judgement = u64;
        type Tally = Counts;

        fn jobs(&self, place: Place, number: u64, jobs: &mut Vec<(Place, u64)>) {
            if number % 2 == place.pass as u64 {
                jobs.push((place, number));
            }
        }

        fn count(
            &self,
            tally: &mut Counts,
            place: Place,
            (job, found): ((Place, u64), u64),
        ) -> Option<((Place, u64), u64)> {
            tally.cases.push((place.pass, place.family, job.1));
            tally.deaths[place.family] += u64::from(self.dies && found < 3);
            (found % 7 == 0).then_some((job, found))
        }

        fn compare(
            &self,
            tally: &mut Counts,
            (batch, place): (u64, Place),
            ((_, number), first): &((Place, u64), u64),
            again: u64,
        ) {
            if again != *first {
                let item = (place.family, *number);
                keep_first(&mut tally.changing, batch, item, |a, b| a.1 % 5 == b.1 % 5);
            }
        }

        fn cases(&self, tally: &Counts) -> u64 {
            tally.cases.len() as u64
        }

        fn end(&self, _: &Counts, _: usize) -> Option<Duration> {
            self.end
        }

        fn most_deaths(&self, tally: &Counts, place: Place) -> u64 {
            MOST_DEATHS.saturating_sub(tally.deaths[place.family])
        }
    }

    /// So many cases of each family in two passes.
    fn judge(cases: u64, block: u64, most: u64) -> Judge<Toy> {
        let plan = Plan::new(&Options::default().cases(cases), [2, FAMILIES], block, most);
        Judge::new(plan, Counts::default())
    }

    /// What each job of a batch comes to.
    fn answered(toy: &Toy, batch: Batch<Toy>) -> AnsweredBatch<Toy> {
        let time = u64::from(batch.is_again());
        batch.ask(toy, |jobs| jobs.iter().map(|job| answer(job.0, job.1, time)).collect())
    }

    /// The verdict with so many batches out at once, whose answers come in an order drawn by a seed; a batch takes a second by a
    /// clock that is made up.
    fn drawn(toy: &Toy, mut judge: Judge<Toy>, out: usize, seed: u64) -> Judge<Toy> {
        let (mut open, mut now, mut counted) = (Vec::new(), Duration::ZERO, 0);
        let mut rng = Rng::new("order", seed, 0);
        while !judge.is_done() {
            while open.len() < out {
                let Some(batch) = judge.next(toy, now) else { break };
                open.push(batch);
            }
            if !open.is_empty() {
                let batch = open.swap_remove(rng.int(0, open.len() as i64 - 1) as usize);
                now += Duration::from_secs(1);
                counted += judge.answer(toy, answered(toy, batch));
            }
        }
        assert_eq!(counted, judge.tally.cases.len() as u64);
        judge
    }

    /// One at a time or many, in order or not, on this thread or on many: everything is counted in the same order.
    #[test]
    fn a_verdict_does_not_depend_on_the_order_of_answers() {
        for dies in [false, true] {
            let toy = Toy { dies, end: None };
            let fresh = || judge(300, 8, 16);
            let expected = drawn(&toy, fresh(), 1, 0).tally;
            // Every case is asked, or each family ends with the answer that is missing the third time.
            assert_eq!(expected.deaths == [MOST_DEATHS; FAMILIES], dies);
            assert_eq!(expected.cases.len() == 300 * FAMILIES, !dies);
            assert_eq!(expected.changing.len(), 5);
            for seed in 0..30 {
                assert_eq!(drawn(&toy, fresh(), 2 + seed as usize, seed).tally, expected, "{seed}");
            }
            let driver = Driver {
                now: &|| Duration::ZERO,
                workers: &|work| parallel::each(8, work),
                ask: &|_, batch| answered(&toy, batch),
                progress: &|_| (),
            };
            assert_eq!(driver.drive(&toy, fresh()).tally, expected);
            let threads = Driver {
                workers: &|work| {
                    std::thread::scope(|scope| {
                        (0..8).for_each(|worker| drop(scope.spawn(move || work(worker))));
                    });
                },
                ..driver
            };
            assert_eq!(threads.drive(&toy, fresh()).tally, expected);
        }
    }

    /// Of each family the same cases are counted, one at a time or 512 at once.
    #[test]
    fn a_verdict_does_not_depend_on_the_size_of_batches() {
        for dies in [false, true] {
            let toy = Toy { dies, end: None };
            let of_block = |block: u64, most: u64| {
                let mut counts = drawn(&toy, judge(700, block, most), 3, block).tally;
                counts.cases.sort_unstable();
                (counts.cases, counts.deaths)
            };
            let expected = of_block(1, 1);
            for (block, most) in [(512, 512), (7, 64), (64, 7), (1, 512)] {
                assert_eq!(of_block(block, most), expected, "{block} {most}");
            }
        }
    }

    /// A limited time begins with one case of each family, and ends by the clock alone.
    #[test]
    fn a_limited_time_is_shared() {
        let options = Options::default().cases(1000).time_limit(Duration::from_secs(9));
        let toy = Toy { dies: false, end: Some(Duration::from_secs(9)) };
        let plan = Plan::new(&options, [1, FAMILIES], 64, 512);
        let late = drawn(&toy, Judge::new(plan.clone(), Counts::default()), 1, 0);
        let even = |of: &Counts| -> Vec<u64> {
            (0..FAMILIES)
                .map(|f| of.cases.iter().filter(|case| case.1 == f).count() as u64)
                .collect()
        };
        assert!(late.is_late);
        assert!(even(&late.tally).iter().all(|cases| (2..=4).contains(cases)), "{:?}", late.tally);
        // Where no time is left, the first block is asked.
        let none = Toy { dies: false, end: Some(Duration::ZERO) };
        let first = drawn(&none, Judge::new(plan, Counts::default()), 1, 0);
        assert_eq!((first.is_late, first.tally.cases), (true, vec![(0, 0, 0)]));
        // A shard has every third case.
        let third = Options::default().cases(99).shard(Shard::new(1, 3).unwrap());
        let plan = Plan::new(&third, [2, FAMILIES], 8, 16);
        let of_shard = drawn(&Toy { end: None, ..toy }, Judge::new(plan, Counts::default()), 4, 1);
        assert_eq!(even(&of_shard.tally), [33; FAMILIES]);
        assert!(of_shard.tally.cases.iter().all(|case| case.2 % 3 == 1));
    }
}
