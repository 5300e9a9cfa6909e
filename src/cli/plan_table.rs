//! The account of a plan as a table.

use rasterproof_render::effects::Effect;
use rasterproof_render::effects::plan::{Decision, Unit};
use rasterproof_report::table::{Row, Table};

/// A decision that some items share, or one about the frame.
pub(super) struct Line<'a> {
    pub effect: Effect,
    pub reason: &'a str,
    pub unit: Unit,
    pub counts: [u64; 3],
    items: Vec<usize>,
}

impl Line<'_> {
    /// Which items, in short: ranges, or their number where there are too many of them.
    pub fn items(&self) -> String {
        const MOST: usize = 9;
        let runs = self.items.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
            [first, .., last] => format!("{first}-{last}"),
            [one] => one.to_string(),
            [] => String::new(),
        });
        let text = runs.collect::<Vec<_>>().join(",");
        match text.len() {
            0 => "frame".to_owned(),
            1..=MOST => text,
            _ => format!("{} items", self.items.len()),
        }
    }

    /// Which of the counts are not 0.
    fn kind(&self) -> [bool; 3] {
        self.counts.map(|count| count > 0)
    }
}

/// Decisions that several items share become one line, in the order of the pipeline: those with one
/// reason that are paid for by all, by none or by some.
pub(super) fn grouped(decisions: &[Decision]) -> Vec<Line<'_>> {
    let mut lines: Vec<Line<'_>> = Vec::new();
    for d in decisions {
        let counts = [d.on, d.off, d.open];
        let same = |line: &&mut Line<'_>| {
            (line.effect, line.reason, line.unit) == (d.effect, &d.reason, d.unit)
                && line.kind() == counts.map(|count| count > 0)
                && d.item.is_some()
        };
        if let Some(line) = lines.iter_mut().find(same) {
            for (sum, count) in line.counts.iter_mut().zip(counts) {
                *sum += count;
            }
            line.items.extend(d.item);
        } else {
            let items = d.item.into_iter().collect();
            lines.push(Line { effect: d.effect, reason: &d.reason, unit: d.unit, counts, items });
        }
    }
    lines.sort_by_key(|line| line.effect);
    lines
}

/// How much of each effect is on, off, or decided while it is drawn, and why.
pub(super) fn table(decisions: &[Decision]) -> Table {
    let row = |line: Line<'_>| {
        let ([on, off, open], unit) = (line.counts, format!(" {}", line.unit.name()));
        Row::of(&[&line.effect.name(), &line.items(), &on, &off, &open, &unit, &line.reason])
    };
    let columns = "effect 13 | item 9 | >on 8 how many of the unit | >off 8 how many of the unit | >open 8 how many of the unit \
                   | ~unit 6 | reason";
    let rows = grouped(decisions).into_iter().map(row).collect();
    let note = "open: decided while it is drawn; several items: the sums of them";
    Table::new("Effects, in order", columns, rows).noted(vec![note.to_owned()])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decision(item: usize, [on, off]: [u64; 2]) -> Decision {
        let (effect, unit, reason) = (Effect::Depth, Unit::Pieces, "asked for".to_owned());
        Decision { effect, item: Some(item), unit, on, off, open: 0, reason }
    }

    #[test]
    fn unlike_items_are_not_merged() {
        let decisions =
            [decision(0, [2, 0]), decision(1, [0, 5]), decision(2, [3, 0]), decision(3, [1, 1])];
        let lines: Vec<_> = grouped(&decisions).iter().map(|l| (l.items(), l.counts)).collect();
        let expected = [("0,2", [5, 0, 0]), ("1", [0, 5, 0]), ("3", [1, 1, 0])];
        assert_eq!(lines, expected.map(|(items, counts)| (items.to_owned(), counts)));
    }

    #[test]
    fn items_are_ranges_or_a_number() {
        let items = |items: &[usize]| {
            let decisions: Vec<_> = items.iter().map(|item| decision(*item, [1, 0])).collect();
            grouped(&decisions)[0].items()
        };
        assert_eq!(items(&[0, 1, 2, 5]), "0-2,5");
        assert_eq!(items(&[4]), "4");
        assert_eq!(items(&[0, 2, 4, 6, 8, 10]), "6 items");
    }
}
