//! What the specimens draw of a case, by hits.

use rasterproof_faults::published::from_screen;
use rasterproof_registry::comparison::Hits;
use rasterproof_registry::engines::{Entry, Specimen};
use rasterproof_registry::published_check::{specimen_coverage, specimen_line_coverage};
use rasterproof_verify::cases::{Case, Shape};

/// The hits of a specimen; nothing where it does not draw such shapes.
pub fn by_specimen(entry: &Entry, case: &Case) -> Option<Hits> {
    match (&case.shape, entry.specimen) {
        (Shape::Triangles { list, .. }, Some(Specimen::Triangle(specimen))) => {
            let list: Vec<_> = list.iter().map(from_screen).collect();
            Some(specimen_coverage(specimen, &list, case.window))
        }
        (Shape::Lines(list), Some(Specimen::Line(specimen))) => {
            Some(specimen_line_coverage(specimen, list, case.window))
        }
        _ => None,
    }
}
