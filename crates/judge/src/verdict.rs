//! What came of it: one property after the other, passed or failed.

use std::time::Duration;

use super::Options;
use super::adapt_case;
use super::ask::Complaints;
use super::asked;
use super::check::{Check, Counted};
use super::declared::Declared;
use super::failures::Failure;
use super::recognise::{Said, Why};
use super::run::{Row, RunFindings, Sides};
use super::windings::Windings;
use rasterproof_verify::cases::facts::asked::DesignShare;
use rasterproof_verify::judge::{self, LeftOut};

/// What came of a property, also in the light of a baseline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// It holds.
    Pass,
    /// It does not hold, and no baseline says so.
    Fail,
    /// It does not hold, as the baseline says.
    ExpectedFailure,
    /// The baseline says that it does not hold, and it does.
    UnexpectedPass,
}

impl Outcome {
    /// Whether nothing is to be done about it: it holds, or its failures are all known.
    #[must_use]
    pub fn is_good(self) -> bool {
        matches!(self, Self::Pass | Self::ExpectedFailure)
    }
}

/// Something that should hold of a program, and whether it does.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Property {
    pub name: &'static str,
    /// What should hold, as a clause.
    pub about: String,
    pub outcome: Outcome,
    /// What was counted, in words.
    pub detail: String,
}

/// What came of a program; rows in the order of the catalogue, the failing cases without those that a baseline knows.
pub type Verdict = judge::Verdict<Options, Row, Failure, Vec<Why>, Particulars>;

/// What is said of a program beside its rows, failing cases and causes.
#[derive(Clone, Debug, Default)]
pub struct Particulars {
    pub declared: Declared,
    /// What the second of two compared programs says of itself; the rows then count cases in which both differ.
    pub against: Option<Declared>,
    /// Which windings were seen to be drawn.
    pub windings: Windings,
    /// What was recognised, if it does not draw as it declares.
    pub recognised: Option<Said>,
    /// Everything else that was found; its rows are those of the verdict.
    pub found: RunFindings,
    /// How long its lines may be, in steps, where it walks along them so slowly that longer ones were not asked for.
    pub reach: Option<i32>,
    /// How long sides of its triangles may be, in pixels, where it walks along its rows like that.
    pub side: Option<i32>,
    /// Failing cases that the baseline knows.
    pub known: u64,
    /// What it wrote on standard error.
    pub complaints: Complaints,
    /// What was not done, because the time was up.
    pub left_out: LeftOut,
    /// What holds and what does not, the protocol first.
    pub properties: Vec<Property>,
    /// How much of all that could be asked the designs asked.
    pub asked: Vec<DesignShare>,
}

/// How many pixels are wrong, of how many that are expected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Score {
    /// Pixels that are missing, too many, drawn twice or out of order.
    pub wrong: u64,
    /// Pixels that were expected.
    pub pixels: u64,
    /// Triangles and lines of which the convention says nothing.
    pub unscored: u64,
}

rasterproof_core::named! {
    /// What a check is about.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Shapes {
        Triangles = "triangles",
        Lines = "lines",
        WideLines = "lines with a width",
        Formulas = "formulas",
    }
}

impl Shapes {
    /// The noun behind a number: the singular behind 1 alone.
    fn noun(self, number: u64) -> &'static str {
        match self {
            _ if number != 1 => self.name(),
            Self::Triangles => "triangle",
            Self::Lines => "line",
            Self::WideLines => "line with a width",
            Self::Formulas => "formula",
        }
    }
}

impl Shapes {
    /// What the shapes of a row are, by the check that it is of.
    #[must_use]
    pub fn of(check: Option<Check>) -> Self {
        match check {
            Some(Check::Line) => Self::Lines,
            Some(Check::Wide) => Self::WideLines,
            Some(Check::Formula) => Self::Formulas,
            _ => Self::Triangles,
        }
    }
}

/// How much of one kind of thing is wrong; its pixels are values, samples or corners where these are what is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    pub what: Counted,
    pub score: Score,
}

/// Wrong pixels per million expected; cases where nothing is expected count as one pixel.
pub fn per_million(wrong: u64, pixels: u64) -> f64 {
    1e6 * wrong as f64 / pixels.max(1) as f64
}

/// What the checks over all families say.
const CHECKS: [(Check, &str); 8] = [
    (Check::Watertight, "meshes have no holes and no pixels drawn by two triangles"),
    (Check::Order, "the order of the vertices does not change the picture"),
    (Check::Values, "values lie within the tolerance of the exact ones"),
    (Check::Samples, "four samples a pixel are covered as the oracle says"),
    (
        Check::SampleValues,
        "covered samples have the exact values of their place within the tolerance",
    ),
    (Check::Carried, "corners that the near plane makes have the attributes of their place"),
    (Check::Direction, "a line drawn backwards lights the same pixels"),
    (Check::Outline, "the fill of a triangle is what its outline encloses"),
];

/// What is said where the time was up before anything was judged.
pub(super) fn nothing_within(limit: Duration, options: &Options) -> String {
    let (limit_is, seconds) = (options.terms.time_limit_is, limit.as_secs_f64());
    format!(
        "nothing was judged within {limit_is}{seconds}: the answers take too long; allow more seconds"
    )
}

/// The verdict on a program, from everything that was found.
pub fn verdict(
    options: &Options,
    mut of: Particulars,
    failures: Vec<Failure>,
    cause: Vec<Why>,
) -> Verdict {
    let families = adapt_case::families(&[]);
    // Families in the order in which they are asked, then the checks over all families.
    let rank = |row: &Row| {
        let family = families.iter().position(|f| f.name == row.name);
        let check = CHECKS.iter().position(|(check, _)| row.check == Some(*check));
        family.unwrap_or(families.len() + check.unwrap_or(0))
    };
    let mut rows = std::mem::take(&mut of.found.rows);
    rows.sort_by_key(rank);
    of.properties = properties(&of, &rows);
    // Of two programs, and where not all cases were judged, nothing is said of what was asked.
    let is_cut = of.found.out_of_time || of.found.gave_up;
    if of.against.is_none() && !is_cut {
        let declared = Declared { reach: of.reach, side: of.side, ..of.declared.clone() };
        of.asked = asked::asked(options, &rows, &declared);
    }
    Verdict { options: options.clone(), families: rows, failures, cause, more: of }
}

/// The properties of a verdict: the protocol first, then whether it draws at all, then a property for each row.
fn properties(of: &Particulars, rows: &[Row]) -> Vec<Property> {
    let property = |name, about: &str, holds: bool, detail: String| Property {
        name,
        about: about.to_owned(),
        outcome: if holds { Outcome::Pass } else { Outcome::Fail },
        detail,
    };
    let mut all = vec![property(
        "protocol",
        "every request is answered in time, once and in order",
        keeps_protocol(&of.found),
        manners(&of.found),
    )];
    // Whether it draws at all comes before all that it draws wrongly.
    if of.windings.is_known() {
        let w = &of.windings;
        let counts = format!(
            "{} of {} clockwise and {} of {} counter-clockwise plain triangles, seen with y down",
            w.clockwise[0], w.clockwise[1], w.counter_clockwise[0], w.counter_clockwise[1]
        );
        let is_declared = w.seen() == Some(of.declared.convention.seen_winding());
        let declared = of.declared.convention.winding.word();
        all.push(property("draws", "it draws at all", w.any(), counts.clone()));
        let about = format!("it draws the declared winding ({declared})");
        all.push(property("winding", &about, is_declared, counts));
    }
    for row in rows {
        let about = match &of.against {
            Some(_) => format!("both answer the same: {}", row.name),
            None => about(row),
        };
        all.push(property(row.name, &about, row.wrong_cases == 0, sentence(row)));
    }
    all
}

/// Whether every request was answered as the protocol says.
fn keeps_protocol(found: &RunFindings) -> bool {
    found.incidents.is_empty() && found.strays.is_empty() && !found.gave_up
}

/// How a program kept the protocol, in words: each breach once, and how many answers there were.
fn manners(found: &RunFindings) -> String {
    // Each breach is said once, in the order of the alphabet.
    let whats = found.incidents.iter().map(|i| &i.what).chain(&found.strays);
    let mut words: Vec<&str> = whats.map(|what| what.breach.name()).collect();
    words.sort_unstable();
    words.dedup();
    if words.is_empty() {
        format!("{} answers", found.answered)
    } else {
        format!("it {}; {} answers", words.join(", "), found.answered)
    }
}

/// What is counted in a verdict on a program.
pub trait Scores {
    fn verdict(&self) -> &Verdict;

    /// How often each of two programs is right, summed over all rows.
    #[must_use]
    fn sides(&self) -> Sides {
        let mut sum = Sides::default();
        for row in &self.verdict().families {
            if let Some(sides) = row.sides {
                sum += sides;
            }
        }
        sum
    }

    /// Whether nothing is to be done. Where nothing could be asked, nothing agrees.
    #[must_use]
    fn agrees(&self) -> bool {
        let Verdict { families, more, .. } = self.verdict();
        !families.is_empty() && more.properties.iter().all(|p| p.outcome.is_good())
    }

    /// Why it says nothing, where no case was judged or nothing was expected: whoever draws nothing would agree.
    #[must_use]
    fn judged_nothing(&self) -> Option<String> {
        let Verdict { families, options, more, .. } = self.verdict();
        // A program that draws nothing agrees with everything where nothing is expected.
        let expects = more.windings.is_known() || families.iter().any(|r| r.pixels > 0);
        let is_blank = self.agrees() && !expects;
        let is_empty = families.is_empty();
        let limit = options.time_limit.filter(|_| more.found.out_of_time);
        match limit {
            Some(limit) if is_empty || is_blank => Some(nothing_within(limit, options)),
            _ if is_empty => Some(
                "no case was judged: the program does not draw what these families hold".to_owned(),
            ),
            _ if is_blank && options.only.is_none() => Some(
                "no pixel was expected: the range, the window or the families leave nothing to judge"
                    .to_owned(),
            ),
            _ => None,
        }
    }

    /// Shapes of a kind that were judged against an expected picture.
    fn shapes(&self, kind: Shapes) -> u64 {
        let is_of_kind = |row: &&Row| Shapes::of(row.check) == kind;
        self.pictures().filter(is_of_kind).map(|row| row.shapes).sum()
    }

    /// How many shapes were judged, such as '12 triangles and 3 lines'. Triangles and lines are named even where there are none, but
    /// where something else was judged.
    fn judged_shapes(&self) -> String {
        // Triangles and lines are named where nothing else was judged, also where there are none.
        let counts = Shapes::ALL.map(|kind| (kind, self.shapes(kind)));
        let is_usual = |kind: Shapes| matches!(kind, Shapes::Triangles | Shapes::Lines);
        let has_others = counts.iter().any(|(kind, count)| *count > 0 && !is_usual(*kind));
        let mut said = Vec::new();
        for (kind, count) in counts {
            if count > 0 || is_usual(kind) && !has_others {
                said.push(format!("{count} {}", kind.noun(count)));
            }
        }
        said.join(" and ")
    }

    /// Rows that compare with an expected picture; not those that compare answers.
    fn pictures(&self) -> impl Iterator<Item = &Row> {
        let rows = self.verdict().families.iter();
        rows.filter(|row| !row.check.is_some_and(Check::compares_answers))
    }

    /// What is wrong as declared, each kind of thing that was judged in its own words.
    #[must_use]
    fn counts(&self) -> Vec<Count> {
        let mut counts: Vec<Count> = Vec::new();
        for row in &self.verdict().families {
            let Some(check) = row.check else { continue };
            add(&mut counts, check.counted(), row.tally.total(), row.pixels);
            if matches!(check, Check::Values | Check::SampleValues) {
                add(&mut counts, Counted::Values, row.wrong_values, row.values);
            }
        }
        counts.sort_by_key(|count| count.what as usize);
        counts
    }

    #[must_use]
    fn as_declared(&self) -> Score {
        self.score(None, &as_declared)
    }

    /// The score by the convention that was recognised; nothing where nothing was, or is explained.
    #[must_use]
    fn by_convention(&self) -> Option<Score> {
        let said = self.verdict().more.recognised.as_ref()?;
        said.is_explained.then(|| self.score(None, &by_convention))
    }

    /// Pixels that are wrong as declared, of the shapes of which the recognised convention says nothing.
    #[must_use]
    fn left_out_wrong(&self) -> u64 {
        self.pictures().map(|row| row.unscored_wrong).sum()
    }

    /// Sums over the rows, those of one kind of shape alone where that is asked.
    #[must_use]
    fn score(&self, shapes: Option<Shapes>, of: &dyn Fn(&Row) -> Score) -> Score {
        let mut sum = Score::default();
        for row in &self.verdict().families {
            let Some(check) = row.check else { continue };
            // Samples, corners of polygons and pixels of piles are no pixels of a triangle.
            let is_asked = shapes.is_none_or(|kind| Shapes::of(Some(check)) == kind);
            if check.counted() == Counted::Pixels && is_asked {
                let Score { wrong, pixels, unscored } = of(row);
                sum.wrong += wrong;
                sum.pixels += pixels;
                sum.unscored += unscored;
            }
        }
        sum
    }
}

/// What a row counts as declared.
pub fn as_declared(row: &Row) -> Score {
    Score { wrong: row.tally.total(), pixels: row.pixels, unscored: 0 }
}

/// What a row counts by the convention that was recognised.
pub fn by_convention(row: &Row) -> Score {
    let (pixels, unscored) = (row.recognised_pixels, row.unscored);
    Score { wrong: row.recognised.total(), pixels, unscored }
}

/// Adds to the count of one kind of thing.
fn add(counts: &mut Vec<Count>, what: Counted, wrong: u64, pixels: u64) {
    let at = counts.iter().position(|count| count.what == what).unwrap_or(counts.len());
    if at == counts.len() {
        counts.push(Count { what, score: Score::default() });
    }
    counts[at].score.wrong += wrong;
    counts[at].score.pixels += pixels;
}

impl Scores for Verdict {
    fn verdict(&self) -> &Verdict {
        self
    }
}

/// What a row is about: of checks over all families their sentence, else what the family holds.
fn about(row: &Row) -> String {
    if let Some((_, about)) = CHECKS.iter().find(|(check, _)| row.check == Some(*check)) {
        return (*about).to_owned();
    }
    let family = adapt_case::families(&[]).into_iter().find(|f| f.name == row.name);
    family.map_or_else(String::new, |f| format!("as expected: {}", f.about))
}

/// A row in words: how many cases agree, then whatever is wrong in parts of the sentence.
pub fn sentence(row: &Row) -> String {
    // How many cases are wrong, of how many.
    let (of, cases) = (row.cases, if row.cases == 1 { "case" } else { "cases" });
    let mut out = match row.wrong_cases {
        0 if of == 1 => "1 case agrees".to_owned(),
        0 => format!("{of} cases agree"),
        n if row.sides.is_some() => format!("different in {n} of {of} {cases}"),
        n => format!("wrong in {n} of {of} {cases}"),
    };
    // Then what is wrong with them, in the words of the check.
    for count in row.check.iter().flat_map(|c| c.describe(&row.tally, row.sides.is_some())) {
        out += &format!(", {count}");
    }
    for (n, what) in [(row.refused, "refused"), (row.deaths, "without an answer")] {
        if n > 0 {
            out += &format!(", {n} {what}");
        }
    }
    if row.values > 0 {
        out += &format!(", worst value at {:.2e} of the tolerance", row.worst);
    }
    if row.stopped {
        out += ", then given up";
    }
    out
}
