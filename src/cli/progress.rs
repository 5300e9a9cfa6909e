//! How far long work has come, on standard error: a bar on a terminal after two seconds, elsewhere a
//! line every ten, so that short work stays silent.

use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressStyle};
use rasterproof_judge::Step;

/// Before a bar appears.
const PATIENCE: Duration = Duration::from_secs(2);
/// Between two pictures of a bar.
const TICK: Duration = Duration::from_millis(250);
/// Between two lines where there is no terminal.
const INTERVAL: Duration = Duration::from_secs(10);

/// Counts what is done, from any thread. A thread of its own shows it, so that work which says
/// nothing for long is seen to go on. The bar vanishes with the value.
pub struct Progress {
    bar: ProgressBar,
    /// Its end wakes the watching thread.
    end: Option<Sender<()>>,
    watch: Option<JoinHandle<()>>,
}

impl Progress {
    /// Of `total` things called `unit`, in the plural; without a total, a count.
    pub fn new(on_terminal: bool, unit: &'static str, total: Option<u64>) -> Self {
        let hidden = ProgressDrawTarget::hidden();
        let bar = ProgressBar::with_draw_target(total, hidden);
        let template = match total {
            Some(_) => {
                "{elapsed_precise} {wide_bar} {human_pos}/{human_len} UNIT {msg}, {eta} left"
            }
            None => "{elapsed_precise} {spinner} {human_pos} UNIT {msg}",
        };
        if let Ok(style) = ProgressStyle::with_template(&template.replace("UNIT", unit)) {
            bar.set_style(style);
        }
        let (end, ended) = mpsc::channel();
        let shown = bar.clone();
        let watch = move || match on_terminal {
            true => draw(&shown, &ended),
            false => write_lines(&shown, unit, &ended),
        };
        // Without a thread to show it, the work itself goes on.
        let watch = Builder::new().spawn(watch).ok();
        Self { bar, end: Some(end), watch }
    }

    /// So many were done before, by an earlier run.
    pub fn resume_at(&self, count: u64) {
        self.bar.set_position(count);
        // The estimate is about this sitting.
        self.bar.reset_eta();
    }

    /// What the judge does.
    pub fn step(&self, step: Step) {
        match step {
            Step::Rule => self.bar.set_message("(asking for the rule)"),
            Step::Judged(more) => {
                self.bar.set_message("");
                self.bar.inc(more);
            }
            Step::Cause => self.bar.set_message("(asking for the cause)"),
            Step::Smaller => self.bar.set_message("(making a case smaller)"),
        }
    }

    pub fn done(&self, more: u64) {
        self.bar.inc(more);
    }

    /// What is worked on, and how many came before it.
    pub fn at(&self, count: u64, what: &str) {
        self.bar.set_position(count);
        self.bar.set_message(what.to_owned());
    }

    /// Writes while the bar is away.
    pub fn without_bar<T>(&self, write: impl FnOnce() -> T) -> T {
        self.bar.suspend(write)
    }

    /// A line that must be seen while the bar is there.
    pub fn warn(&self, line: &str) {
        self.bar.suspend(|| eprintln!("{line}"));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        drop(self.end.take());
        if let Some(watch) = self.watch.take() {
            // It cannot panic, and nothing depends on it.
            let _ = watch.join();
        }
        self.bar.finish_and_clear();
    }
}

/// Whether the work still goes on after this time.
fn goes_on(ended: &Receiver<()>, time: Duration) -> bool {
    ended.recv_timeout(time) == Err(RecvTimeoutError::Timeout)
}

/// On a terminal: a bar for work that takes longer than a moment.
fn draw(bar: &ProgressBar, ended: &Receiver<()>) {
    if goes_on(ended, PATIENCE) {
        bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(8));
        while goes_on(ended, TICK) {
            bar.tick();
        }
    }
}

/// Elsewhere, as in the log of a CI: a line from time to time, which shows that the work goes on.
fn write_lines(bar: &ProgressBar, unit: &str, ended: &Receiver<()>) {
    while goes_on(ended, INTERVAL) {
        let total = bar.length().map(|all| format!(" of {}", HumanCount(all))).unwrap_or_default();
        let (seconds, count, what) = (bar.elapsed().as_secs(), bar.position(), bar.message());
        let line = format!("{seconds} s: {}{total} {unit} {what}", HumanCount(count));
        eprintln!("{}", line.trim_end());
    }
}
