//! A model from some sides, a line for each.

use std::collections::BTreeMap;

use rasterproof_precision::cost::Board;
use rasterproof_report::html::Report;
use rasterproof_report::json::value;
use rasterproof_report::table::{Row, Table};
use rasterproof_report::words::{number, thousands};

use crate::hard::{HardCases, Kind};

/// What was found in one view.
#[derive(serde::Serialize)]
struct Turned {
    /// By how many degrees the model is turned about its vertical axis.
    turn: f64,
    kinds: u64,
    slivers: u64,
    order: u64,
    by_rounding: u64,
    equal: u64,
}

/// Counts of hard cases from each side of a model, and which choices are the cheapest there.
#[derive(Default)]
pub struct Around {
    views: Vec<Turned>,
    /// In how many views a choice is the cheapest exact one, by the place of its group, which has a title, and its name.
    best: BTreeMap<(usize, String), (&'static str, u32)>,
}

/// The same for machines.
#[derive(serde::Serialize)]
struct Data<'a> {
    views: &'a [Turned],
    /// The job, the choice, and in how many views it is the cheapest exact one.
    cheapest_exact: Vec<(&'static str, &'a str, u32)>,
}

/// What the columns of `--views` mean.
const COUNTED: &str = "turn in degrees; kinds of hard cases that are seen; px of slivers; px by drawing order; px in which \
                       rounding alone decides, and of them those of equal depths";

impl Around {
    /// Adds a view from a side, whose turn is in degrees.
    pub fn add(&mut self, turn: f64, hard: &HardCases, boards: &[Board]) {
        // A kind that does not occur has no pixel.
        let pixels = |kind: Kind| hard.of(kind).map_or(0, |case| case.pixels);
        self.views.push(Turned {
            turn,
            kinds: hard.in_view().count() as u64,
            slivers: pixels(Kind::Sliver),
            order: pixels(Kind::Order),
            by_rounding: hard.classes.by_rounding,
            equal: hard.classes.equal,
        });
        for (place, board) in boards.iter().enumerate() {
            if let Some(choice) = board.cheapest_exact(0, board.measures.len() - 1) {
                let key = (place, choice.name().to_owned());
                self.best.entry(key).or_insert((board.ladder.title(), 0)).1 += 1;
            }
        }
    }

    /// Two tables, for a scene of this name.
    pub fn report(&self, scene: &str) -> Report {
        let mut rows = Vec::new();
        // A row for each side, in the order in which they were added.
        for of in &self.views {
            let mut cells = vec![number(of.turn, 9)];
            for count in [of.kinds, of.slivers, of.order, of.by_rounding, of.equal] {
                cells.push(thousands(count));
            }
            rows.push(Row::from(cells));
        }
        let columns =
            ">turn 12 degrees | >kinds 11 | >slivers 11 | >order 11 | >by rounding 11 | >equal 11";
        let hard = Table::new("Hard cases by the turn of the model", columns, rows);
        // By the order of the groups, then by name, as the map has them.
        let (mut best, mut rows) = (Vec::new(), Vec::new());
        for ((_, name), (title, count)) in &self.best {
            best.push((*title, &**name, *count));
            rows.push(Row::of(&[title, name, count]));
        }
        let columns = "job 28 | choice 24 | >views 6 in how many of the views";
        let cheapest = Table::new("Cheapest exact choice", columns, rows);
        Report {
            about: format!("{scene}: seen from {} sides", self.views.len()),
            data: value(&Data { views: &self.views, cheapest_exact: best }),
            tables: vec![hard.noted(vec![COUNTED.to_owned()]), cheapest],
            ..Report::default()
        }
    }
}
