//! What the engines, the oracle and the specimens draw of a case, by hits.

use rasterproof_core::frame::Coverage;
use rasterproof_faults::published::from_screen;
use rasterproof_registry::engines::{Engine, Entry, LineEngine, Specimen};
use rasterproof_registry::published_check::{specimen_coverage, specimen_line_coverage};
use rasterproof_verify::cases::{Case, Shape};
use rasterproof_verify::comparison::{engine_coverage, line_coverage, oracle_coverage};

/// The hits of all shapes of a case, or why they were not drawn.
pub type Hits = Result<Coverage, String>;

/// The hits of each engine that draws such shapes, after its name.
pub fn by_engines(
    case: &Case,
    engines: impl Iterator<Item = Engine>,
    lines: impl Iterator<Item = LineEngine>,
) -> Vec<(String, Hits)> {
    let window = case.window;
    match &case.shape {
        Shape::Triangles { list, .. } => {
            let hits = |e: &Engine| engine_coverage(e, list, window).map_err(String::from);
            engines.map(|e| (e.name().to_owned(), hits(&e))).collect()
        }
        Shape::Lines(list) => {
            let hits = |e: &LineEngine| line_coverage(e, list, window).map_err(String::from);
            lines.map(|e| (e.name().to_owned(), hits(&e))).collect()
        }
    }
}

#[must_use]
pub fn by_oracle(case: &Case) -> Coverage {
    match &case.shape {
        Shape::Triangles { list, .. } => oracle_coverage(list, case.window),
        Shape::Lines(list) => line_coverage(&LineEngine::Oracle, list, case.window)
            .unwrap_or_else(|_| Coverage::new(case.window, 0)),
    }
}

/// The hits of a specimen; nothing where it does not draw such shapes.
#[must_use]
pub fn by_specimen(entry: &Entry, case: &Case) -> Option<Hits> {
    match (&case.shape, entry.specimen) {
        (Shape::Triangles { list, .. }, Some(Specimen::Triangle(specimen))) => {
            let list: Vec<_> = list.iter().map(from_screen).collect();
            Some(specimen_coverage(specimen, &list, case.window))
        }
        (Shape::Lines(list), Some(Specimen::Line(specimen))) => {
            let drawn = list.iter().map(|l| specimen_line_coverage(specimen, l, case.window));
            Some(
                drawn
                    .reduce(|sum, more| Ok(added(sum?, &more?)))
                    .unwrap_or_else(|| Ok(Coverage::new(case.window, 0))),
            )
        }
        _ => None,
    }
}

fn added(mut sum: Coverage, more: &Coverage) -> Coverage {
    for (y_px, row) in more.rows() {
        for (sum, more) in sum.row_mut(y_px).iter_mut().zip(row) {
            *sum = sum.saturating_add(*more);
        }
    }
    sum
}
