//! Known faults of drivers: a baseline by condition, so that it holds for every seed.
//!
//! A line names a driver, a version, a property and where it fails: see `known-faults.txt`. A failing
//! case that meets the condition is known; one that does not is news. A fault of which no case fails
//! any more, though cases that meet its condition were judged, is news too.

use crate::device::find::About;
use crate::hazard::{Case, Shape};

use super::specified::twice_area_px2;

/// The faults that are known, as text.
pub const TEXT: &str = include_str!("known-faults.txt");

/// A known fault of a driver.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// Part of the driver's name, in small letters.
    driver: String,
    /// The beginning of its version.
    version: String,
    /// The properties that fail, of `judge` or of a stage.
    pub properties: Vec<String>,
    /// Twice the area in square pixels from which triangles are wrong.
    from_twice_area_px2: f64,
    /// What happens.
    pub about: String,
}

/// Reads known faults: lines `driver | version | properties | twice-area-px2 >= N | about`, after `#`
/// whatever is to be said.
///
/// # Errors
/// The line that cannot be read, with what was expected.
pub fn parse(text: &str) -> Result<Vec<Known>, String> {
    let lines = text.lines().zip(1..).filter(|(line, _)| {
        let line = line.trim();
        !line.is_empty() && !line.starts_with('#')
    });
    let known = |(line, number): (&str, u32)| {
        let wrong = || {
            format!(
                "line {number}: expected 'driver | version | properties | twice-area-px2 >= N | about'"
            )
        };
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [driver, version, properties, condition, about] = cells[..] else {
            return Err(wrong());
        };
        let least = condition.strip_prefix("twice-area-px2 >= ").and_then(|n| n.parse().ok());
        Ok(Known {
            driver: driver.to_lowercase(),
            version: version.to_owned(),
            properties: properties.split_whitespace().map(str::to_owned).collect(),
            from_twice_area_px2: least.ok_or_else(wrong)?,
            about: about.to_owned(),
        })
    };
    lines.map(known).collect()
}

/// The known faults of a device.
#[must_use]
pub fn of(all: &[Known], about: &About) -> Vec<Known> {
    let is_its =
        |k: &&Known| about.words().contains(&k.driver) && about.version.contains(&k.version);
    all.iter().filter(is_its).cloned().collect()
}

impl Known {
    /// Whether it says of this property that a case fails.
    #[must_use]
    pub fn covers(&self, property: &str, case: &Case) -> bool {
        let Shape::Triangles { list, .. } = &case.shape else { return false };
        self.properties.iter().any(|p| p == property)
            && list.iter().any(|t| twice_area_px2(&t.corners()) >= self.from_twice_area_px2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hazard;

    #[test]
    fn a_line_covers_what_it_says() {
        let known = parse("# word\n\nLavaPipe | 22.3 | huge values | twice-area-px2 >= 8 | lost\n");
        let known = known.unwrap().remove(0);
        let square = |side_px: i32| {
            let mut case = hazard::families().next().unwrap().case(1, 0);
            let sub = |x: i32, y: i32| crate::grid::SubpixelPoint::new(x * 256, y * 256);
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
    }

    #[test]
    fn what_cannot_be_read_names_its_line() {
        assert_eq!(parse(TEXT).map(|all| all.len()), Ok(0));
        for bad in ["a | b | c | d", "a | b | c | twice-area-px2 >= many | e"] {
            assert!(parse(&format!("# word\n{bad}")).unwrap_err().starts_with("line 2: "));
        }
    }
}
