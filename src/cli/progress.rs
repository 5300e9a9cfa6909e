//! How far long work has come: a bar on a terminal, elsewhere a line on standard error every ten
//! seconds, so that short work in a pipe stays silent.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Between two lines where there is no terminal.
const INTERVAL: Duration = Duration::from_secs(10);

/// Counts cases, from any thread.
pub struct Progress {
    bar: ProgressBar,
    /// Whether lines are written instead.
    in_lines: bool,
    total: Option<u64>,
    start: Instant,
    cases: AtomicU64,
    lines: AtomicU64,
}

impl Progress {
    /// A bar of `total` cases where `on_terminal`; without a total, a count.
    pub fn new(on_terminal: bool, total: Option<u64>) -> Self {
        let bar = match (on_terminal, total) {
            (false, _) => ProgressBar::hidden(),
            (true, None) => ProgressBar::new_spinner(),
            (true, Some(total)) => ProgressBar::new(total),
        };
        if on_terminal {
            bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(8));
            let counted = "{elapsed_precise} {wide_bar} {pos}/{len} cases, {eta} left";
            let spinner = "{elapsed_precise} {spinner} {pos} cases";
            let template = if total.is_some() { counted } else { spinner };
            if let Ok(style) = ProgressStyle::with_template(template) {
                bar.set_style(style);
            }
        }
        let (cases, lines) = (AtomicU64::new(0), AtomicU64::new(0));
        Self { bar, in_lines: !on_terminal, total, start: Instant::now(), cases, lines }
    }

    /// So many more cases are done.
    pub fn done(&self, cases: u64) {
        if !self.in_lines {
            return self.bar.inc(cases);
        }
        let all = self.cases.fetch_add(cases, Ordering::Relaxed) + cases;
        let due = self.start.elapsed().as_secs() / INTERVAL.as_secs();
        // One thread writes the line that is due.
        if self.lines.fetch_max(due, Ordering::Relaxed) < due {
            let total = self.total.map(|total| format!(" of {total}")).unwrap_or_default();
            eprintln!("{} s: {all}{total} cases", self.start.elapsed().as_secs());
        }
    }

    /// The work is done; a bar vanishes.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}
