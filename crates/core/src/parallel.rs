//! Work on all cores, item by item.
//!
//! Compiled once: a parallel iterator is a few thousand lines for the optimiser wherever one stands, so it
//! is left to loops whose items take less than a lock does.

use std::sync::Mutex;

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
    #[cfg(feature = "parallel")]
    return rayon::join(first, second);
    #[cfg(not(feature = "parallel"))]
    (first(), second())
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

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
    #[should_panic(expected = "seven")]
    fn a_panic_is_handed_on() {
        map(10, |number| assert!(number != 7, "seven"));
    }
}
