//! Work on all cores, item by item.
//!
//! Compiled once: a parallel iterator is a few thousand lines for the optimiser wherever one stands, so it
//! is left to loops whose items take less than a lock does.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Fewer small items than this are left to one thread, because handing them to another one would take longer.
pub const SHARE: usize = 1 << 14;

/// What `job` makes of the numbers below `count`, in order.
///
/// # Panics
/// As `job` does.
pub fn map<T: Send>(count: usize, job: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let made: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    each(count, &|number| {
        // A panic of `job` is before the lock.
        let item = job(number);
        *made[number].lock().unwrap() = Some(item);
    });
    let asked =
        |item: Mutex<Option<T>>| item.into_inner().unwrap().expect("each number is asked for");
    made.into_iter().map(asked).collect()
}

/// Calls `job` with each of the numbers below `count`.
///
/// # Panics
/// As `job` does.
pub fn each(count: usize, job: &(dyn Fn(usize) + Sync)) {
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        (0..count).into_par_iter().with_max_len(1).for_each(job);
    }
    #[cfg(not(feature = "parallel"))]
    (0..count).for_each(job);
}

/// What two jobs make, the first of them in another thread where there is one.
///
/// # Panics
/// If one of the jobs panics.
pub fn join<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    let (mut jobs, mut made) = ((Some(first), Some(second)), (None, None));
    both(&mut || made.0 = jobs.0.take().map(|job| job()), &mut || {
        made.1 = jobs.1.take().map(|job| job())
    });
    (made.0.expect("it was called"), made.1.expect("it was called"))
}

fn both(first: &mut (dyn FnMut() + Send), second: &mut (dyn FnMut() + Send)) {
    #[cfg(feature = "parallel")]
    rayon::join(first, second);
    #[cfg(not(feature = "parallel"))]
    {
        first();
        second();
    }
}

/// The index of the first value for which something is true.
pub fn first<T: Sync>(values: &[T], is_true: impl Fn(&T) -> bool + Sync) -> Option<usize> {
    // All values of a share are looked at, which takes less time than stopping at the first one.
    let any = |share: &[T]| share.iter().fold(false, |any, value| any | is_true(value));
    let found = AtomicUsize::new(usize::MAX);
    each(values.len().div_ceil(SHARE), &|number| {
        let start = number * SHARE;
        let end = values.len().min(start + SHARE);
        if start < found.load(Ordering::Relaxed) && any(&values[start..end]) {
            found.fetch_min(start, Ordering::Relaxed);
        }
    });
    let start = found.into_inner();
    values.get(start..)?.iter().position(is_true).map(|number| start + number)
}

/// Calls `job` with shares of some values.
///
/// # Panics
/// As `job` does.
pub fn each_share<T: Send>(values: &mut [T], job: &(dyn Fn(&mut [T]) + Sync)) {
    let shares: Vec<_> = values.chunks_mut(SHARE).map(Mutex::new).collect();
    each(shares.len(), &|number| job(&mut shares[number].lock().unwrap()));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_comes_once_and_in_order() {
        for count in [0, 1, 2, 1000] {
            let calls = AtomicUsize::new(0);
            let squares = map(count, |number| {
                calls.fetch_add(1, Ordering::Relaxed);
                number * number
            });
            assert_eq!(squares, (0..count).map(|number| number * number).collect::<Vec<_>>());
            assert_eq!(calls.into_inner(), count);
        }
    }

    #[test]
    fn the_first_of_many_is_found() {
        let mut values = vec![0; 3 * SHARE + 1];
        assert_eq!(first(&values, |value| *value > 0), None);
        for place in [3 * SHARE, 2 * SHARE + 5, SHARE, SHARE - 1, 0] {
            values[place] = 1;
            assert_eq!(first(&values, |value| *value > 0), Some(place));
        }
    }

    #[test]
    fn each_value_is_in_one_share() {
        let mut values = vec![0; 2 * SHARE + 1];
        each_share(&mut values, &|share| share.iter_mut().for_each(|value| *value += 1));
        assert!(values.iter().all(|&value| value == 1));
    }

    #[test]
    fn both_jobs_are_done() {
        assert_eq!(join(|| 1, || "two"), (1, "two"));
    }

    #[test]
    #[should_panic(expected = "seven")]
    fn a_panic_is_handed_on() {
        map(10, |number| assert!(number != 7, "seven"));
    }
}
