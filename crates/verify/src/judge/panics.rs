//! Panics of engines that are judged: caught, counted, and only the first one of a judgement shown.
//!
//! Without this, an engine that panics in every case would print each of these panics, with its backtrace, and
//! bury the message of the verdict. The panic hook belongs to the whole process, and tests run in parallel. So
//! ours decides by thread, and passes on whatever does not come from an engine under judgement.

use std::cell::{Cell, RefCell};
use std::error::Error;
use std::fmt;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

type PanicHook = Box<dyn Fn(&PanicHookInfo<'_>) + Sync + Send>;

thread_local! {
    static JUDGING: Cell<bool> = const { Cell::new(false) };
    /// The judgement for which this thread works.
    static WATCHED: RefCell<Option<Arc<Watched>>> = const { RefCell::new(None) };
}

/// What a judgement knows of its engines.
#[derive(Default)]
struct Watched {
    panics: AtomicU64,
    budget: Mutex<Option<Budget>>,
}

/// How long the engines of a judgement may still be asked.
struct Budget {
    /// When it is over; otherwise the time that is spent in the engines themselves counts. So a judge that is slow
    /// itself, without optimisation or on a busy machine, leaves nothing out.
    end: Option<Instant>,
    left: Duration,
    /// Whether engines are no longer run when it is over: an error stands for their answer.
    refuses: bool,
}

impl Budget {
    fn is_over(&self) -> bool {
        self.end.map_or(self.left.is_zero(), |end| Instant::now() >= end)
    }
}

impl Watched {
    /// Works with the budget, if there is one.
    fn with_budget<T>(&self, work: impl FnOnce(&mut Budget) -> T) -> Option<T> {
        self.budget.lock().unwrap_or_else(PoisonError::into_inner).as_mut().map(work)
    }

    /// Runs an engine, whose time counts; nothing where the time is over and it is no longer run.
    fn spend<T>(&self, run: impl FnOnce() -> T) -> Option<T> {
        match self.with_budget(|budget| budget.refuses && budget.is_over()) {
            Some(true) => None,
            // Without a budget the clock is not read: not every machine has one.
            None => Some(run()),
            Some(false) => {
                let start = Instant::now();
                let result = run();
                let spent = start.elapsed();
                self.with_budget(|budget| budget.left = budget.left.saturating_sub(spent));
                Some(result)
            }
        }
    }
}

/// Our hook, as long as a judgement goes on.
struct Installed {
    judgements: usize,
    /// The hook that was there before ours, and the address of ours.
    before: Option<(Arc<PanicHook>, usize)>,
}

static INSTALLED: Mutex<Installed> = Mutex::new(Installed { judgements: 0, before: None });

/// A judgement that goes on: of its engines' panics the first one reaches the panic hook of the user.
#[must_use]
pub struct Watch(Arc<Watched>);

impl Watch {
    /// Installs our hook until the last judgement ends.
    pub fn begin() -> Self {
        let mut installed = INSTALLED.lock().unwrap_or_else(PoisonError::into_inner);
        installed.judgements += 1;
        // A thread that unwinds may not change the hook.
        if installed.before.is_none() && !std::thread::panicking() {
            installed.before = Some(install());
        }
        Self(Arc::default())
    }

    /// From now on the engines may be asked until `end`, or else for so long in their own code. `refuses` says whether they are
    /// no longer run then.
    pub(crate) fn limit(&self, end: Option<Instant>, left: Duration, refuses: bool) {
        let mut budget = self.0.budget.lock().unwrap_or_else(PoisonError::into_inner);
        *budget = Some(Budget { end, left, refuses });
    }

    /// Whether the time of [`Watch::limit`] is over.
    pub(crate) fn is_over(&self) -> bool {
        self.0.with_budget(|budget| budget.is_over()).unwrap_or(false)
    }

    /// Asks somebody whose time counts as that of an engine; nothing where he is no longer asked.
    pub(crate) fn spend<T>(&self, ask: impl FnOnce() -> T) -> Option<T> {
        self.0.spend(ask)
    }

    /// Works for this judgement, on any thread.
    pub fn during<T>(&self, work: impl FnOnce() -> T) -> T {
        let _restored = Restore(WATCHED.replace(Some(Arc::clone(&self.0))));
        work()
    }
}

/// Puts back for whom a thread worked before, also where the work panics.
struct Restore(Option<Arc<Watched>>);

impl Drop for Restore {
    fn drop(&mut self) {
        WATCHED.set(self.0.take());
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let mut installed = INSTALLED.lock().unwrap_or_else(PoisonError::into_inner);
        installed.judgements -= 1;
        // Otherwise the end of the next judgement removes it. Until then it passes on every panic.
        if installed.judgements == 0 && !std::thread::panicking() {
            installed.before = installed.before.take().and_then(restore);
        }
    }
}

fn address(hook: &PanicHook) -> usize {
    let hook: *const _ = &**hook;
    hook.cast::<()>() as usize
}

fn install() -> (Arc<PanicHook>, usize) {
    let before = Arc::new(panic::take_hook());
    let next = Arc::clone(&before);
    let hook: PanicHook = Box::new(move |info| {
        if !is_judging() || is_first() {
            next(info);
        }
    });
    let address = address(&hook);
    panic::set_hook(hook);
    (before, address)
}

/// Whether the panic of an engine on this thread is the first one of its judgement. Counts it.
fn is_first() -> bool {
    let first = |watched: &Option<Arc<Watched>>| {
        watched.as_ref().is_none_or(|watched| watched.panics.fetch_add(1, Ordering::Relaxed) == 0)
    };
    WATCHED.try_with(|watched| watched.try_borrow().map_or(true, |w| first(&w))).unwrap_or(true)
}

/// Removes our hook. Where somebody has set another one meanwhile, which may call ours, both stay.
fn restore(before: (Arc<PanicHook>, usize)) -> Option<(Arc<PanicHook>, usize)> {
    let current = panic::take_hook();
    if address(&current) != before.1 {
        panic::set_hook(current);
        return Some(before);
    }
    drop(current);
    // Ours held the only other reference to it.
    panic::set_hook(
        Arc::try_unwrap(before.0)
            .unwrap_or_else(|before| Box::new(move |info: &PanicHookInfo<'_>| before(info))),
    );
    None
}

/// Whether this thread is inside an engine whose panic will become a verdict. A panic hook that asks
/// can keep such a panic off the terminal.
#[must_use]
pub fn is_judging() -> bool {
    JUDGING.get()
}

/// What an engine said when it panicked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnginePanic(pub String);

impl fmt::Display for EnginePanic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl Error for EnginePanic {}

impl From<EnginePanic> for String {
    fn from(panic: EnginePanic) -> Self {
        panic.0
    }
}

/// Runs an engine; its panic becomes an error with the message.
///
/// # Errors
/// What the engine said when it panicked.
pub fn caught<T>(run: impl FnOnce() -> T) -> Result<T, EnginePanic> {
    let run = || {
        let outer = JUDGING.replace(true);
        let result = catch_unwind(AssertUnwindSafe(run));
        JUDGING.set(outer);
        result
    };
    // An engine inside another one spends the time of the outer one.
    let result = match WATCHED.with_borrow(Clone::clone).filter(|_| !is_judging()) {
        Some(watched) => {
            let result = watched.spend(run);
            result.ok_or_else(|| EnginePanic("not run: the time was up".to_owned()))?
        }
        None => run(),
    };
    result.map_err(|payload| {
        let text = payload.downcast_ref::<&str>().map(|s| (*s).to_owned());
        let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
        EnginePanic(text.unwrap_or_else(|| "panic".to_owned()))
    })
}
