//! The league: what libraries in wide use draw, a row for each adapter.

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::verdict::{self, Score, Scores as _, Shapes, Verdict};

/// An adapter, as `adapters/league.json` names it.
#[derive(Clone, Debug, Deserialize)]
pub struct Adapter {
    pub name: String,
    pub library: String,
    /// The function of the library that draws.
    pub call: String,
    /// The program that speaks the protocol for the library, with its arguments.
    pub command: Vec<String>,
}

/// How a kind of shapes came out: triangles, or lines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Kind {
    /// What the library does, as a sentence; empty where it draws as it declares.
    pub sentence: String,
    pub as_declared: Score,
    /// By the convention that was found; nothing where it is unexplained.
    pub by_convention: Option<Score>,
    /// The mistake that explains what no convention does, after 'it'.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mistake: Option<String>,
}

/// A row of the league: a library, and how its triangles and lines came out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ranked {
    pub name: String,
    pub library: String,
    /// What it calls itself at HELLO, with its version.
    pub version: String,
    /// The day it was judged, year-month-day.
    pub date: String,
    pub call: String,
    /// The words of its HELLO.
    pub declares: String,
    pub triangles: Option<Kind>,
    pub lines: Option<Kind>,
    /// Meshes, pixels of them that nobody drew, and pixels that two triangles drew.
    pub meshes: [u64; 3],
    /// Triangles drawn in several orders of their vertices, and those that changed.
    pub orders: [u64; 2],
    /// Lines drawn from both ends, and those that changed.
    pub directions: [u64; 2],
    /// Requests refused, and requests that were not answered.
    pub unanswered: [u64; 2],
}

/// The whole table, with what is needed to make it again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct League {
    /// The version that judged.
    pub rasterproof: String,
    pub seed: u64,
    pub cases: u64,
    pub rows: Vec<Ranked>,
}

impl Kind {
    /// How a kind of shapes came out, whose sentences begin with `about`; nothing where none was judged.
    fn of(verdict: &Verdict, shapes: Shapes, about: &str) -> Option<Self> {
        let as_declared = verdict.score(Some(shapes), &verdict::as_declared);
        if as_declared.pixels == 0 {
            return None;
        }
        // What was recognised is one of the sentences about both kinds.
        let mut sentence = String::new();
        if let Some(said) = &verdict.more.recognised {
            let found = said.sentences.iter().find_map(|said| said.strip_prefix(about));
            sentence = found.unwrap_or_default().to_owned();
        }
        let is_explained = !sentence.is_empty() && !sentence.starts_with("unexplained");
        let by_convention =
            is_explained.then(|| verdict.score(Some(shapes), &verdict::by_convention));
        // The first mistake is the one that explains most.
        let check = if shapes == Shapes::Lines { Check::Line } else { Check::Coverage };
        let why = verdict.cause.iter().find(|why| why.check == check);
        let mistake = why.and_then(|why| Some(why.why.causes.first()?.does.clone()));
        Some(Self { sentence, as_declared, by_convention, mistake })
    }
}

impl League {
    /// The first and the last day on which a library was judged; empty where none was.
    #[must_use]
    pub fn days(&self) -> [&str; 2] {
        let days = || self.rows.iter().map(|row| row.date.as_str());
        [days().min(), days().max()].map(Option::unwrap_or_default)
    }
}

impl Ranked {
    /// The row of a library, from the verdict on its adapter.
    #[must_use]
    pub fn new(adapter: &Adapter, date: String, verdict: &Verdict) -> Self {
        let row = |check: Check| verdict.families.iter().find(|row| row.check == Some(check));
        let changed = |check| row(check).map_or([0; 2], |r| [r.cases, r.wrong_cases]);
        // What was not answered, over all rows.
        let (mut refused, mut deaths) = (0, 0);
        for row in &verdict.families {
            refused += row.refused;
            deaths += row.deaths;
        }
        Self {
            name: adapter.name.clone(),
            library: adapter.library.clone(),
            version: verdict.more.declared.name.clone(),
            date,
            call: adapter.call.clone(),
            declares: verdict.more.declared.to_string(),
            triangles: Kind::of(verdict, Shapes::Triangles, "Triangles: "),
            lines: Kind::of(verdict, Shapes::Lines, "Lines: "),
            meshes: row(Check::Watertight)
                .map_or([0; 3], |r| [r.cases, r.tally.missing, r.tally.twice]),
            orders: changed(Check::Order),
            directions: changed(Check::Direction),
            unanswered: [refused, deaths],
        }
    }
}

/// A day as year-month-day, from the days since 1970-01-01 (the civil calendar, counted from March).
pub fn date(days: u64) -> String {
    // Days since 0000-03-01: a year that begins in March has its leap day at its end.
    let days = days + 719_468;
    // Eras of 400 years have the same days.
    let (era, of_era) = (days / 146_097, days % 146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", year + era * 400 + next)
}

#[cfg(test)]
mod tests {
    #[test]
    fn days_by_hand() {
        for (days, date) in [(0, "1970-01-01"), (59, "1970-03-01"), (11_016, "2000-02-29")] {
            assert_eq!(super::date(days), date);
        }
    }
}
