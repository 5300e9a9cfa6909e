//! How rows are made of borders: of two of an edge each, of both halves, or of all edges that cross a row.

use super::border::{Crossing, Site, Toward, add_changed, sites, with_heights};
use super::picture::{MARGIN, Picture};
use super::quantity::EDGES;
use super::question::{AnyQuestion, first_sample};

/// How rows are drawn between two borders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct RowRule {
    /// Whether a row whose ends come in the wrong order is drawn between them; otherwise it is empty.
    pub(super) exchanges_ends: bool,
    /// Whether edges have their rows by heights that are rounded to whole pixels; all other rows are empty.
    pub(super) heights: Option<Toward>,
    pub(super) halves: Halves,
    pub(super) crossed: Option<Crossed>,
}

/// A row made of all edges that count in it, whichever these are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Crossed {
    rows: EdgeRows,
    /// Whether a row goes from the least to the greatest border; otherwise it is filled between the borders in pairs.
    is_whole: bool,
    level: Level,
    /// Whether the place of an edge is kept between its ends.
    is_kept: bool,
}

/// Where a level edge counts with both its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Level {
    Nowhere,
    /// In the row whose samples lie exactly at its height.
    AtSamples,
    /// In the row that holds it.
    InRow,
}

/// The rows in which an edge counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum EdgeRows {
    /// Whose samples lie between its ends; also those at the height of its upper end, and of its lower one.
    Samples([bool; 2]),
    /// That hold a part of it.
    Touched,
}

impl Crossed {
    const RIGHT: Self = Self {
        rows: EdgeRows::Samples([true, false]),
        is_whole: false,
        level: Level::Nowhere,
        is_kept: false,
    };

    fn changes(self) -> usize {
        let right = Self::RIGHT;
        [self.rows != right.rows, self.is_whole, self.level != right.level, self.is_kept]
            .into_iter()
            .filter(|is_changed| *is_changed)
            .count()
    }

    fn variants(self) -> Vec<Self> {
        use EdgeRows::{Samples, Touched};
        let mut all = Vec::new();
        let mut with = |change: &dyn Fn(&mut Self)| add_changed(&mut all, &self, change);
        let ends = [[true, false], [true, true], [false, false], [false, true]];
        for rows in ends.map(Samples).into_iter().chain([Touched]) {
            with(&|c| c.rows = rows);
            with(&|c| (c.rows, c.is_whole) = (rows, !c.is_whole));
        }
        with(&|c| c.is_whole = !c.is_whole);
        for level in [Level::Nowhere, Level::AtSamples, Level::InRow] {
            with(&|c| c.level = level);
        }
        with(&|c| c.is_kept = !c.is_kept);
        all
    }

    fn words(self) -> Vec<String> {
        let mut said = Vec::new();
        let rows = match self.rows {
            EdgeRows::Samples([true, false]) => None,
            EdgeRows::Samples([true, true]) => {
                Some("also in the row whose samples lie exactly at the height of its lower end")
            }
            EdgeRows::Samples([false, true]) => Some(
                "in the row whose samples lie exactly at the height of its lower end, and not of its upper one",
            ),
            EdgeRows::Samples([false, false]) => {
                Some("in no row whose samples lie exactly at the height of one of its ends")
            }
            EdgeRows::Touched => Some(
                "in each row that holds a part of it, also where it does not reach the samples",
            ),
        };
        said.extend(rows.map(|rows| format!("An edge counts {rows}.")));
        match self.level {
            Level::Nowhere => {}
            Level::AtSamples => said.push(
                "A level edge counts with both its ends in a row whose samples lie at its height."
                    .to_owned(),
            ),
            Level::InRow => said.push(
                "A level edge counts with both its ends in the row that holds it.".to_owned(),
            ),
        }
        if self.is_kept {
            said.push("The place of an edge is kept between its ends.".to_owned());
        }
        said.push(match self.is_whole {
            true => "A row goes from the least to the greatest of its edges.".to_owned(),
            false => "A row is filled between its edges in pairs.".to_owned(),
        });
        said
    }

    /// The runs of a row. `border` gives the first pixel of an edge, or the first after it.
    fn runs(
        self,
        q: &AnyQuestion,
        sample: [i64; 2],
        place: i64,
        border: &dyn Fn(&Site) -> Option<i64>,
    ) -> Vec<[i64; 2]> {
        let at = place * 256 + sample[1];
        let mut borders: Vec<[i64; 2]> = Vec::new();
        for points in EDGES {
            let mut ends = points.map(|i| q.points[i]);
            ends.sort_by_key(|end| end[1]);
            let [upper, lower] = ends.map(|end| end[1]);
            let at_ends = ends.map(|end| first_sample(end[0], sample[0]));
            if upper == lower {
                let is_here = match self.level {
                    Level::Nowhere => false,
                    Level::AtSamples => upper == at,
                    Level::InRow => upper.div_euclid(256) == place,
                };
                if is_here {
                    borders.extend(at_ends.map(|v| [v, v]));
                }
                continue;
            }
            let is_here = match self.rows {
                EdgeRows::Samples([at_upper, at_lower]) => {
                    (upper < at || at_upper && upper == at)
                        && (at < lower || at_lower && at == lower)
                }
                EdgeRows::Touched => {
                    (upper.div_euclid(256)..=lower.div_euclid(256)).contains(&place)
                }
            };
            if !is_here {
                continue;
            }
            let [first, end] = [0, 1].map(|end| border(&Site { axis: 1, place, end, points }));
            if let (Some(first), Some(end)) = (first, end) {
                let [least, most] = [at_ends[0].min(at_ends[1]), at_ends[0].max(at_ends[1])];
                borders.push(match self.is_kept {
                    true => [first, end].map(|v| v.clamp(least, most)),
                    false => [first, end],
                });
            }
        }
        borders.sort_unstable();
        if self.is_whole {
            let first = borders.iter().map(|border| border[0]).min();
            let end = borders.iter().map(|border| border[1]).max();
            return first.zip(end).map(|(first, end)| [first, end]).into_iter().collect();
        }
        borders.chunks_exact(2).map(|pair| [pair[0][0], pair[1][1]]).collect()
    }
}

/// Rows of the two halves that the middle corner makes, each between the long edge and a short one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Halves {
    /// Whether the upper half begins and ends one row later than it should (1), one earlier (-1) or neither, and the lower one.
    pub(super) later: [[i64; 2]; 2],
    /// Whether a pixel of both halves is drawn twice.
    pub(super) counts: bool,
}

impl RowRule {
    /// How much it says.
    pub(super) fn changes(&self) -> usize {
        let Halves { later, counts } = self.halves;
        let moved = later.as_flattened().iter().filter(|rows| **rows != 0).count();
        let crossed = self.crossed.map_or(0, |crossed| 1 + crossed.changes());
        moved + usize::from(counts) + crossed
    }

    /// With one other field.
    pub(super) fn variants(&self) -> Vec<Self> {
        let mut all = Vec::new();
        let mut with = |change: &dyn Fn(&mut Self)| add_changed(&mut all, self, change);
        for half in [0, 1] {
            for end in [0, 1] {
                for rows in [0, -1, 1] {
                    with(&|r| r.halves.later[half][end] = rows);
                }
            }
        }
        with(&|r| r.halves.counts = !r.halves.counts);
        with(&|r| r.exchanges_ends = !r.exchanges_ends);
        with(&|r| r.crossed = None);
        for crossed in self.crossed.unwrap_or(Crossed::RIGHT).variants() {
            with(&|r| (r.crossed, r.halves) = (Some(crossed), Halves::default()));
        }
        for heights in Toward::ALL.map(Some).into_iter().chain([None]) {
            with(&|r| r.heights = heights);
        }
        all
    }

    /// Which rows are drawn, and how.
    pub(super) fn words(&self) -> Vec<String> {
        let mut said = Vec::new();
        if let Some(way) = self.heights {
            let corners = format!("their corners, rounded {} to whole px", way.words());
            said.push(format!("Edges have the rows from one to the other of {corners}."));
        }
        for (later, part) in self.halves.later.iter().zip(["above", "below"]) {
            let mut ends = Vec::new();
            for (rows, verb) in later.iter().zip(["begins", "ends"]) {
                match rows {
                    1 => ends.push(format!("{verb} one row later")),
                    -1 => ends.push(format!("{verb} one row earlier")),
                    _ => {}
                }
            }
            if !ends.is_empty() {
                said.push(format!(
                    "It draws the part {part} the middle corner so that it {}, between its edges prolonged.",
                    ends.join(" and ")
                ));
            }
        }
        if self.halves.counts {
            said.push("It draws twice what both parts draw.".to_owned());
        }
        said.extend(self.crossed.map(Crossed::words).unwrap_or_default());
        if self.exchanges_ends {
            let order = "A row whose ends then come in the wrong order is drawn between them.";
            said.push(order.to_owned());
        }
        said
    }
}

/// A picture whose borders are moved: `moved` gives the new place of a border, if it has one.
pub(super) fn redrawn(
    q: &AnyQuestion,
    before: &Picture,
    sample: [i64; 2],
    rows: RowRule,
    moved: &dyn Fn(&Site, i64) -> Option<i64>,
) -> Picture {
    let is_line = q.is_line();
    if let Some(crossed) = rows.crossed.filter(|_| !is_line) {
        return of_all_edges(q, sample, rows, crossed, moved);
    }
    let has_halves = rows.halves != Halves::default() && !is_line;
    let all = match has_halves {
        true => sites_of_halves(q, sample, rows),
        false => sites(q, sample, rows.heights),
    };
    let is_anew = rows.heights.is_some() || has_halves;
    let mut after = if is_anew { Picture::new(q.side) } else { before.clone() };
    let right = |site: &Site| site.evaluate(&Crossing::RIGHT, q, sample);
    for row in all.chunks(if is_line { 1 } else { 2 }) {
        let mut borders = Vec::new();
        for site in row {
            // Of a line, the picture says which of two pixels as near is the right one.
            let seen = if is_line { site.seen(before, true) } else { None };
            borders.extend(seen.or_else(|| right(site)));
        }
        if borders.len() < row.len() {
            continue;
        }
        let new: Vec<Option<i64>> = row.iter().zip(&borders).map(|(s, b)| moved(s, *b)).collect();
        if new.iter().all(Option::is_none) && !is_anew {
            continue;
        }
        let ends: Vec<i64> =
            new.iter().zip(&borders).map(|(new, old)| new.unwrap_or(*old)).collect();
        let (first, end) = match ends[..] {
            [first, end] if end < first && rows.exchanges_ends => (end, first),
            [first, end] => (first, end),
            _ => (ends[0], ends[0] + 1),
        };
        let (axis, place) = (row[0].axis, row[0].place as i32);
        for v in -MARGIN..q.side[1 - axis] + MARGIN {
            let at = if axis == 1 { [v, place] } else { [place, v] };
            let is_in = (first..end).contains(&i64::from(v));
            if !has_halves {
                after.set(at, u8::from(is_in));
            } else if is_in {
                let most = if rows.halves.counts { 2 } else { 1 };
                after.set(at, (after.hits(at) + 1).min(most));
            }
        }
    }
    after
}

/// A picture whose rows are made of all edges that count in them.
fn of_all_edges(
    q: &AnyQuestion,
    sample: [i64; 2],
    rows: RowRule,
    crossed: Crossed,
    moved: &dyn Fn(&Site, i64) -> Option<i64>,
) -> Picture {
    let mut picture = Picture::new(q.side);
    let rounded = with_heights(q, rows.heights);
    let border = |site: &Site| {
        let right = site.evaluate(&Crossing::RIGHT, q, sample)?;
        Some(moved(site, right).unwrap_or(right))
    };
    for place in i64::from(-MARGIN)..i64::from(q.side[1] + MARGIN) {
        for [first, end] in crossed.runs(&rounded, sample, place, &border) {
            let (first, end) = match rows.exchanges_ends {
                true => (first.min(end), first.max(end)),
                false => (first, end),
            };
            let (least, most) = (i64::from(-MARGIN), i64::from(q.side[0] + MARGIN));
            for x in first.max(least)..end.min(most) {
                picture.set([x as i32, place as i32], 1);
            }
        }
    }
    picture
}

/// The borders of both halves, in the rows that a rule gives them: a row may come twice.
fn sites_of_halves(q: &AnyQuestion, sample: [i64; 2], rows: RowRule) -> Vec<Site> {
    let rounded = with_heights(q, rows.heights);
    let [top, middle, bottom] = rounded.by_height();
    let is_left = q.middle_is_left([top, middle, bottom]);
    let edge = |a: usize, b: usize| {
        EDGES.into_iter().find(|edge| edge.contains(&a) && edge.contains(&b)).unwrap_or(EDGES[0])
    };
    let first = |i: usize| first_sample(rounded.points[i][1], sample[1]);
    let mut all = Vec::new();
    for (half, (from, to)) in [(top, middle), (middle, bottom)].into_iter().enumerate() {
        let [begin, end] = rows.halves.later[half];
        let known = i64::from(-MARGIN)..i64::from(q.side[1] + MARGIN);
        for place in (first(from) + begin).max(known.start)..(first(to) + end).min(known.end) {
            let (long, short) = (edge(top, bottom), edge(from, to));
            let points = if is_left { [short, long] } else { [long, short] };
            all.extend([0, 1].map(|end| Site { axis: 1, place, end, points: points[end] }));
        }
    }
    all
}
