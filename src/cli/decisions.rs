//! The account of a plan, as lines for the terminal and as rows of a page.

use crate::effects::Effect;
use crate::effects::plan::Decision;
use crate::report::html::PlanRow;

/// A decision that some items share, or one about the frame.
pub(super) struct Line<'a> {
    pub effect: Effect,
    pub reason: &'a str,
    /// On, off, open.
    pub counts: [u64; 3],
    items: Vec<usize>,
}

impl Line<'_> {
    /// Which items, in short.
    pub fn items(&self) -> String {
        match self.items[..] {
            [] => "frame".to_owned(),
            [one] => one.to_string(),
            [first, .., last] if last - first + 1 == self.items.len() => format!("{first}-{last}"),
            [first, ..] => format!("{first}.."),
        }
    }
}

/// Decisions that several items share become one line, in the order of the pipeline.
pub(super) fn grouped(decisions: &[Decision]) -> Vec<Line<'_>> {
    let mut lines: Vec<Line<'_>> = Vec::new();
    for d in decisions {
        let same = |line: &&mut Line<'_>| {
            line.effect == d.effect && line.reason == d.reason && d.item.is_some()
        };
        let counts = [d.on, d.off, d.open];
        if let Some(line) = lines.iter_mut().find(same) {
            for (sum, count) in line.counts.iter_mut().zip(counts) {
                *sum += count;
            }
            line.items.extend(d.item);
        } else {
            let items = d.item.into_iter().collect();
            lines.push(Line { effect: d.effect, reason: &d.reason, counts, items });
        }
    }
    lines.sort_by_key(|line| line.effect);
    lines
}

/// The same lines as rows of the page.
pub(super) fn plan_rows(decisions: &[Decision]) -> Vec<PlanRow> {
    let row = |line: Line<'_>| PlanRow {
        effect: line.effect.name().to_owned(),
        is_on: line.counts[0] + line.counts[2] > 0,
        reason: match line.items().as_str() {
            "frame" => line.reason.to_owned(),
            items => format!("item {items}: {}", line.reason),
        },
        counters: ["on", "off", "open"]
            .into_iter()
            .zip(line.counts)
            .filter(|(name, count)| *name != "open" || *count > 0)
            .map(|(name, count)| (name.to_owned(), count.to_string()))
            .collect(),
    };
    grouped(decisions).into_iter().map(row).collect()
}
