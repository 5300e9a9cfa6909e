//! The cases of the families, put where a program declares that it draws.
//!
//! A case is moved so that what lay on a pixel's centre lies on the declared sample, then every
//! coordinate is rounded to the declared grid and kept within the declared range. Ties stay ties
//! where the grid holds the sample. The protocol's windows begin at the origin, so the family `far`,
//! whose windows do not, is left out.

use std::ops::Range;

use super::Options;
use super::declared::Declared;
use rasterproof_core::geometry::is_disjoint;
use rasterproof_core::grid::{SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::Corners;
use rasterproof_verify::cases::facts::Topic;
use rasterproof_verify::cases::{self, Case, Family, Limits, Shape};

/// Families whose danger are ties come first, values and far coordinates last.
const FIRST: [&str; 8] = [
    "half-integer",
    "rectangle",
    "fan",
    "near-tie",
    "flat",
    "near-horizontal",
    "near-vertical",
    "line-ties",
];

/// The families that are asked, in order; a name is that of the catalogue.
pub fn families(wanted: &[String]) -> Vec<&'static Family> {
    let mut chosen: Vec<&Family> = cases::families()
        .chain(cases::near_plane::FAMILIES)
        .chain(cases::formulas::FAMILIES)
        .collect();
    chosen.retain(|f| f.name != "far" && (wanted.is_empty() || wanted.iter().any(|w| w == f.name)));
    // The sort keeps the order of the catalogue among those that are not among the first.
    chosen.sort_by_key(|f| FIRST.iter().position(|name| *name == f.name).unwrap_or(FIRST.len()));
    chosen
}

/// The family of a name among those that programs get; nothing where none has it.
pub fn family(name: &str) -> Option<&'static Family> {
    families(&[name.to_owned()]).pop()
}

/// The numbers of the cases of a family: a design has more of them, so that nearly all triples of its facts occur.
#[must_use]
pub fn numbers(options: &Options, design: Option<&Topic>) -> Range<u64> {
    let Range { start, end } = options.numbers();
    let times = design.filter(|_| options.only.is_none()).map_or(1, Topic::times);
    start..end.saturating_mul(times)
}

/// Whether the cases of a family are thin lines, which have verbs and checks of their own.
#[must_use]
pub fn is_lines(family: &Family) -> bool {
    cases::lines::FAMILIES.iter().any(|f| f.name == family.name)
}

/// A case of a family, put where a program declares that it draws.
#[must_use]
pub fn case(family: &Family, seed: u64, index: u64, declared: &Declared) -> Case {
    mended(family.case_within(seed, index, &limits(declared)))
}

/// Another case, put there.
#[must_use]
pub fn put(case: Case, declared: &Declared) -> Case {
    mended(limits(declared).put(case))
}

/// Rounding may have folded a mesh.
fn mended(mut case: Case) -> Case {
    if let Shape::Triangles { list, disjoint } = &mut case.shape {
        let corners: Vec<Corners> = list.iter().map(|t| t.corners()).collect();
        *disjoint = list.len() > 1 && is_disjoint(&corners);
    }
    case
}

/// What a program can be asked, by what it declares and by how far it was seen to draw.
#[must_use]
pub fn limits(declared: &Declared) -> Limits {
    // Two ends are at most twice as far from each other.
    let reach = declared.reach.map(|reach| (reach / 2).max(1));
    Limits {
        // The centre of the last pixel of all would be no coordinate.
        line_range_px: declared.range.into_iter().chain(reach).min().or(Some(i32::MAX)),
        window: declared.window,
        ..declared.convention.limits(range(declared))
    }
}

/// How far corners may lie from the origin: two of them are at most twice as far from each other.
fn range(declared: &Declared) -> Option<i32> {
    let half = declared.side.map(|side| (side / 2).max(1));
    declared.range.into_iter().chain(half).min()
}

/// Whether a case, shrunk perhaps, is one that the program says it draws.
#[must_use]
pub fn holds(case: &Case, declared: &Declared) -> bool {
    let w = case.window;
    let fits = declared.window.is_none_or(|[wide, high]| w.width() <= wide && w.height() <= high);
    if (w.x0, w.y0) != (0, 0) || !fits {
        return false;
    }
    match &case.shape {
        Shape::Triangles { list, .. } => limits(declared).takes(list),
        Shape::Lines(_) => put(case.clone(), declared) == *case,
        Shape::Unsnapped { .. } => false,
        Shape::Numbers { .. } => true,
    }
}

/// Whether any corner or end lies outside the window: programs that do not clip crash on these.
#[must_use]
pub fn leaves_window(case: &Case) -> bool {
    let w = case.window;
    match &case.shape {
        Shape::Triangles { list, .. } => {
            // A corner on a side lies in the window.
            let (right, bottom) = (w.x1 * SUBPIXELS, w.y1 * SUBPIXELS);
            let is_in = |corner: &SubpixelPoint| {
                (0..=right).contains(&corner.x) && (0..=bottom).contains(&corner.y)
            };
            !list.iter().all(|triangle| triangle.corners().iter().all(is_in))
        }
        Shape::Lines(lines) => {
            lines.iter().flat_map(|l| l.ends).any(|e| !w.contains(e.pixel.x, e.pixel.y))
        }
        Shape::Unsnapped { .. } | Shape::Numbers { .. } => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_corner_lies_where_it_is_declared() {
        for words in [
            "",
            "grid=1 origin=0,0 range=100",
            "grid=16 rule=bottom-right window=20x10",
            "grid=64 origin=0.875,0",
            "grid=1 rule=strict range=8000000",
        ] {
            let declared = Declared::parse(&format!("HELLO 2 x coverage line {words}")).unwrap();
            assert!(declared.unknown.is_empty());
            for family in families(&[]) {
                for index in 0..30 {
                    let case = case(family, 1, index, &declared);
                    assert!(holds(&case, &declared), "{words}: {}#{index}", family.name);
                }
            }
        }
    }

    /// Corners on centres come to lie on the sample, so that ties stay ties.
    #[test]
    fn ties_move_with_the_sample() {
        let declared = Declared::parse("HELLO 2 x coverage origin=0,0 grid=1").unwrap();
        let family = families(&["half-integer".to_owned()])[0];
        let (before, after) = (family.case(1, 5), put(family.case(1, 5), &declared));
        let (Shape::Triangles { list: a, .. }, Shape::Triangles { list: b, .. }) =
            (before.shape, after.shape)
        else {
            panic!("triangles")
        };
        let (p, q) = (a[0].corners()[0], b[0].corners()[0]);
        assert_eq!((q.x, q.y), (p.x - 128, p.y - 128));
        let unmoved = put(family.case(1, 5), &Declared::default());
        assert!(matches!(unmoved.shape, Shape::Triangles { list, .. } if list == a));
    }
}
