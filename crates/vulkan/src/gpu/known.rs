//! Known faults of drivers: a baseline by condition, so that it holds for every seed.
//!
//! A line names a driver, a version, a property and where it fails: see `known-faults.txt`. A failing
//! case that meets the condition is known; one that does not is news. A fault of which no case fails
//! any more, though cases that meet its condition were judged, is news too.

use crate::device::find::About;
use rasterproof_verify::cases::{Case, Shape};

use super::cells::twice_area_px2;
use rasterproof_verify::specification::Standing;

pub const TEXT: &str = include_str!("known-faults.txt");

/// A fault of one version of a driver.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownFault {
    /// Part of the driver's name, in small letters.
    driver: String,
    version: String,
    /// The families, stages and other properties that fail, and whether each does in every run.
    properties: Vec<(String, bool)>,
    condition: Condition,
    pub about: String,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Condition {
    /// With triangles of twice this area in square pixels or more.
    TwiceAreaPx2(f64),
    /// In so many of a thousand cases of a stage at most.
    PerMille(u64),
}

/// Cases of a stage from which on it is news that none of them fails.
const ENOUGH: u64 = 512;

/// Reads known faults: lines `driver | version | properties | condition | about`, after `#` whatever is
/// to be said. Properties are separated by `;`; of one with `?` behind it few cases fail, so that it is no
/// news if none does. A condition is `twice-area-px2 >= N` or, of a stage, `at most N in 1000`.
///
/// # Errors
/// The line that cannot be read, with what was expected.
pub fn parse(text: &str) -> Result<Vec<KnownFault>, String> {
    let mut all = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let Some(fault) = fault(line) else {
            return Err(format!(
                "line {number}: expected 'driver | version | properties | condition | about', where \
                 condition is 'twice-area-px2 >= N' or 'at most N in 1000'"
            ));
        };
        all.push(fault);
    }
    Ok(all)
}

/// The fault of a line, if it can be read.
fn fault(line: &str) -> Option<KnownFault> {
    let cells: Vec<&str> = line.split('|').map(str::trim).collect();
    let [driver, version, properties, condition, about] = cells[..] else { return None };
    let condition = match condition.strip_prefix("twice-area-px2 >= ") {
        Some(least) => Condition::TwiceAreaPx2(least.parse().ok()?),
        None => {
            let most = condition.strip_prefix("at most ")?.strip_suffix(" in 1000")?;
            Condition::PerMille(most.parse().ok()?)
        }
    };
    Some(KnownFault {
        driver: driver.to_lowercase(),
        version: version.to_owned(),
        properties: properties.split(';').map(property).collect(),
        condition,
        about: about.to_owned(),
    })
}

/// A property, and whether it fails in every run: then there is no `?` behind it.
fn property(word: &str) -> (String, bool) {
    let word = word.trim();
    let name = word.trim_end_matches('?');
    (name.to_owned(), name == word)
}

/// The faults of this device's driver and its version.
pub fn of(all: &[KnownFault], about: &About) -> Vec<KnownFault> {
    let (mut its, words) = (all.to_vec(), about.words());
    its.retain(|k| words.contains(&k.driver) && about.version.contains(&k.version));
    its
}

impl KnownFault {
    /// The properties of which cases fail in every run.
    pub fn certain(&self) -> impl Iterator<Item = &str> {
        self.properties.iter().filter(|(_, certain)| *certain).map(|(name, _)| name.as_str())
    }

    fn names(&self, property: &str) -> bool {
        self.properties.iter().any(|(name, _)| name == property)
    }

    /// Whether it says of this property that a case fails.
    #[must_use]
    pub fn covers(&self, property: &str, case: &Case) -> bool {
        let Shape::Triangles { list, .. } = &case.shape else { return false };
        list.iter().any(|t| self.covers_area(property, twice_area_px2(&t.corners())))
    }

    /// Whether a triangle of this area is one that it says fails.
    fn covers_area(&self, property: &str, px2: f64) -> bool {
        let is_large = matches!(self.condition, Condition::TwiceAreaPx2(least) if px2 >= least);
        is_large && self.names(property)
    }
}

/// What a stage came to whose triangles have these areas, by whether each was right.
#[must_use]
pub fn class_of_areas(known: &[KnownFault], property: &str, judged: &[(f64, bool)]) -> Standing {
    // Of those that a known fault covers, and of all others.
    let (mut covered, mut wrong_covered, mut wrong_others) = (0, 0, 0);
    for &(px2, is_right) in judged {
        let is_covered = known.iter().any(|k| k.covers_area(property, px2));
        covered += u64::from(is_covered);
        wrong_covered += u64::from(is_covered && !is_right);
        wrong_others += u64::from(!is_covered && !is_right);
    }
    match (wrong_others, wrong_covered) {
        (0, 0) if covered > 0 => Standing::Stale,
        (0, 0) => Standing::Equal,
        (0, _) => Standing::Known,
        _ => Standing::Outside,
    }
}

/// What a stage came to in which so many of its cases are wrong.
#[must_use]
pub fn class_of_share(known: &[KnownFault], property: &str, wrong: u64, cases: u64) -> Standing {
    // What the most generous known fault allows.
    let mut largest = None;
    for k in known.iter().filter(|k| k.names(property)) {
        if let Condition::PerMille(most) = k.condition {
            largest = largest.max(Some(most));
        }
    }
    match largest {
        // With few cases it may be chance that none fails.
        Some(_) if wrong == 0 && cases >= ENOUGH => Standing::Stale,
        Some(most) if wrong > 0 && wrong * 1000 <= most * cases => Standing::Known,
        _ if wrong == 0 => Standing::Equal,
        _ => Standing::Outside,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_verify::cases;

    #[test]
    fn a_line_covers_what_it_says() {
        let known =
            parse("# word\n\nLavaPipe | 22.3 | huge; values? | twice-area-px2 >= 8 | lost\n");
        let known = known.unwrap().remove(0);
        let square = |side_px: i32| {
            let mut case = cases::families().next().unwrap().case(1, 0);
            let sub = |x: i32, y: i32| rasterproof_core::grid::SubpixelPoint::new(x * 256, y * 256);
            let Shape::Triangles { list, .. } = &mut case.shape else { panic!("triangles") };
            list.truncate(1);
            let corners = [sub(0, 0), sub(side_px, 0), sub(0, side_px)];
            for (vertex, corner) in list[0].vertices.iter_mut().zip(corners) {
                vertex.position = corner;
            }
            case
        };
        assert!(known.covers("huge", &square(3)));
        assert!(known.covers("values", &square(3)));
        assert!(!known.covers("huge", &square(2)));
        assert!(!known.covers("fan", &square(3)));
        assert_eq!(known.certain().collect::<Vec<_>>(), ["huge"]);
    }

    #[test]
    fn stages_by_area_and_by_share() {
        let known =
            parse("a | b | x, y | twice-area-px2 >= 8 | c\na | b | z | at most 20 in 1000 | c");
        let known = known.unwrap();
        let by_area = |judged: &[(f64, bool)]| class_of_areas(&known, "x, y", judged);
        assert_eq!(by_area(&[(9.0, false), (9.0, true), (1.0, true)]), Standing::Known);
        assert_eq!(by_area(&[(9.0, false), (7.0, false)]), Standing::Outside);
        assert_eq!(by_area(&[(9.0, true), (7.0, true)]), Standing::Stale);
        assert_eq!(by_area(&[(7.0, true)]), Standing::Equal);
        assert_eq!(class_of_areas(&known, "z", &[(9.0, false)]), Standing::Outside);
        let by_share = |wrong, cases| class_of_share(&known, "z", wrong, cases);
        assert_eq!(by_share(2, 100), Standing::Known);
        assert_eq!(by_share(3, 100), Standing::Outside);
        assert_eq!(by_share(0, 100), Standing::Equal);
        assert_eq!(by_share(0, 1000), Standing::Stale);
        assert_eq!(class_of_share(&known, "x, y", 1, 1000), Standing::Outside);
    }

    #[test]
    fn what_cannot_be_read_names_its_line() {
        assert!(parse(TEXT).is_ok());
        for bad in
            ["a | b | c | d", "a | b | c | twice-area-px2 >= many | e", "a | b | c | at most 3 | e"]
        {
            assert!(parse(&format!("# word\n{bad}")).unwrap_err().starts_with("line 2: "));
        }
    }
}
