//! Failing cases made smaller: by the steps of [`rasterproof_verify::cases`], and where these stop, at several triangles and
//! at what only the judge asks, by simpler numbers.
//!
//! A corner that triangles share moves for all of them, so that a mesh stays together. Depths of piles, and z
//! and w of clip space, are numbers like the others.

use glam::DVec2;

use super::check::Check;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
use rasterproof_core::triangle::ScreenVertex;
use rasterproof_verify::cases::shrink::{CaseSteps, Steps};
use rasterproof_verify::cases::{Case, Shape, Triangle, formulas};

/// The steps of cases that a program is asked.
pub struct ProgramSteps<'a> {
    check: Check,
    /// Triangles without an area, at most: of what has depths a picture is shown, and such a triangle has none.
    most_flat: usize,
    /// Whether a smaller case is one to ask.
    may_be: &'a dyn Fn(&Case) -> bool,
}

impl<'a> ProgramSteps<'a> {
    /// The steps from a case; a smaller one may have no more triangles without an area than this one has.
    pub fn new(check: Check, case: &Case, may_be: &'a dyn Fn(&Case) -> bool) -> Self {
        let most_flat = if has_depth(check) { flat(case) } else { usize::MAX };
        Self { check, most_flat, may_be }
    }
}

impl Steps for ProgramSteps<'_> {
    type Case = Case;
    const STAGES: usize = CaseSteps::STAGES + 1;

    fn candidates(&self, stage: usize, case: &Case) -> Vec<Case> {
        match stage {
            0..CaseSteps::STAGES => CaseSteps.candidates(stage, case),
            _ if self.check == Check::Formula => simpler_formulas(case),
            _ if !has_depth(self.check) && triangles(case).len() < 2 => Vec::new(),
            _ => candidates(case, self.check),
        }
    }

    fn is_step(&self, stage: usize, from: &Case, to: &Case) -> bool {
        let is_smaller = match stage {
            0..CaseSteps::STAGES => CaseSteps.is_step(stage, from, to),
            _ => size(to) < size(from),
        };
        is_smaller && flat(to) <= self.most_flat && (self.may_be)(to)
    }
}

/// Whether the check asks for depths, or for z and w, which are numbers to be made simpler.
fn has_depth(check: Check) -> bool {
    matches!(check, Check::Depth | Check::Near | Check::Carried | Check::Wide)
}

/// Whether triangles of clip space are asked, which have no window.
fn is_clipped(check: Check) -> bool {
    matches!(check, Check::Near | Check::Carried)
}

/// How many triangles have no area.
fn flat(case: &Case) -> usize {
    triangles(case).iter().filter(|t| twice_area(&t.corners()) == 0).count()
}

/// The triangles of a case; of lines and formulas there are none.
fn triangles(case: &Case) -> &[Triangle] {
    if let Shape::Triangles { list, .. } = &case.shape { list } else { &[] }
}

/// Triangles or the numbers of a formula, then the bits of all numbers, then how large these are, then the window.
fn size(case: &Case) -> (usize, u32, u64, u64) {
    let (mut bits, mut sum) = (0, 0);
    if let Shape::Numbers { numbers, .. } = &case.shape {
        for number in numbers {
            let fine = (number * f64::from(SUBPIXELS)) as i64;
            // Of two numbers with one magnitude the positive one is smaller.
            bits += fine.unsigned_abs().count_ones() + u32::from(fine < 0);
            sum += fine.unsigned_abs();
        }
        return (numbers.len(), bits, sum, 0);
    }
    let list = triangles(case);
    for v in list.iter().flat_map(|t| &t.vertices) {
        let fine = [v.depth, v.varying.x].map(|number| (number * f64::from(SUBPIXELS)) as i64);
        for number in [i64::from(v.position.x), i64::from(v.position.y), fine[0], fine[1]] {
            bits += number.unsigned_abs().count_ones();
            sum += number.unsigned_abs();
        }
    }
    // A smaller window is the last thing that counts.
    let window = u64::from(case.window.width()) + u64::from(case.window.height());
    (list.len(), bits, sum, window)
}

/// Smaller cases of triangles, those that leave out most first.
fn candidates(case: &Case, check: Check) -> Vec<Case> {
    let (list, window) = (triangles(case), case.window);
    let mut found = Vec::new();
    // A triangle fewer.
    if list.len() > 1 {
        for i in 0..list.len() {
            found.push(case_of(window, [&list[..i], &list[i + 1..]].concat()));
        }
    }
    // A smaller window; what N and A ask has none.
    if !is_clipped(check) {
        let PixelRect { x0, y0, x1, y1 } = window;
        for [x1, y1] in [[x1 / 2, y1], [x1, y1 / 2], [x1 - 1, y1], [x1, y1 - 1]] {
            if x1 > x0 && y1 > y0 {
                found.push(case_of(PixelRect { x1, y1, ..window }, list.to_vec()));
            }
        }
    }
    // All triangles nearer to the left side, or to the top.
    for (x_px, y_px) in [(4, 0), (0, 4), (1, 0), (0, 1)] {
        let mut moved = list.to_vec();
        for v in moved.iter_mut().flat_map(|triangle| &mut triangle.vertices) {
            let x = v.position.x.saturating_sub(x_px * SUBPIXELS);
            let y = v.position.y.saturating_sub(y_px * SUBPIXELS);
            v.position = SubpixelPoint::new(x, y);
        }
        found.push(case_of(window, moved));
    }
    // Each corner with a simpler coordinate.
    let mut corners = Vec::new();
    for triangle in list {
        corners.extend(triangle.corners());
    }
    corners.sort_by_key(|p: &SubpixelPoint| (p.x, p.y));
    corners.dedup();
    for corner in corners {
        for x in simpler(corner.x) {
            let to = SubpixelPoint::new(x, corner.y);
            found.push(case_of(window, with_corner(list, corner, to)));
        }
        for y in simpler(corner.y) {
            let to = SubpixelPoint::new(corner.x, y);
            found.push(case_of(window, with_corner(list, corner, to)));
        }
    }
    for i in 0..list.len() {
        // One depth for a whole triangle of a pile.
        if check == Check::Depth {
            for depth in [0.0, 1.0] {
                let mut flat = list.to_vec();
                for v in &mut flat[i].vertices {
                    v.depth = depth;
                }
                found.push(case_of(window, flat));
            }
        }
        // Then each number of a corner alone.
        for j in 0..3 {
            for simpler in simpler_corners(&list[i].vertices[j], check) {
                let mut changed = list.to_vec();
                changed[i].vertices[j] = simpler;
                found.push(case_of(window, changed));
            }
        }
    }
    found
}

/// A case of these triangles. Whether they are disjoint does not matter to one that is asked again by the same check.
fn case_of(window: PixelRect, list: Vec<Triangle>) -> Case {
    Case { window, shape: Shape::Triangles { list, disjoint: false } }
}

/// A corner with one of its numbers simpler: its depth, or its w and its attribute in clip space.
fn simpler_corners(corner: &ScreenVertex<DVec2>, check: Check) -> Vec<ScreenVertex<DVec2>> {
    let mut simpler = Vec::new();
    if has_depth(check) {
        for depth in simpler_number(corner.depth) {
            simpler.push(ScreenVertex { depth, ..*corner });
        }
    }
    if is_clipped(check) {
        let DVec2 { x: w, y: attribute } = corner.varying;
        // At w = 0 a corner lies nowhere.
        for w in simpler_number(w).filter(|w| *w != 0.0) {
            simpler.push(ScreenVertex { varying: DVec2::new(w, attribute), ..*corner });
        }
        for attribute in simpler_number(attribute) {
            simpler.push(ScreenVertex { varying: DVec2::new(w, attribute), ..*corner });
        }
    }
    simpler
}

/// Triangles with a corner at another place, in all of those that share it.
fn with_corner(list: &[Triangle], corner: SubpixelPoint, to: SubpixelPoint) -> Vec<Triangle> {
    let mut list = list.to_vec();
    for v in list.iter_mut().flat_map(|triangle| &mut triangle.vertices) {
        if v.position == corner {
            v.position = to;
        }
    }
    list
}

/// The numbers of a formula with one of them simpler, or a texel fewer, as far as the formula can be asked of these.
fn simpler_formulas(case: &Case) -> Vec<Case> {
    let Shape::Numbers { formula, numbers } = &case.shape else { return Vec::new() };
    let mut found = Vec::new();
    for (i, &number) in numbers.iter().enumerate() {
        for simpler in simpler_number(number) {
            // One number is simpler, all others stay.
            let mut with = numbers.clone();
            with[i] = simpler;
            found.push(with);
        }
        let mut without = numbers.clone();
        without.remove(i);
        found.push(without);
    }
    found.retain(|numbers| formula.of(numbers).is_some());
    found.into_iter().map(|numbers| formulas::case(*formula, numbers)).collect()
}

/// Simpler coordinates, the simplest first.
fn simpler(value: i32) -> impl Iterator<Item = i32> {
    let to = |step: i32| value.div_euclid(step) * step;
    let all =
        [0, to(SUBPIXELS) / 2, to(SUBPIXELS), to(HALF_PIXEL), value - value.signum() * SUBPIXELS];
    all.into_iter().filter(move |v| *v != value)
}

/// Simpler numbers, the simplest first.
fn simpler_number(value: f64) -> impl Iterator<Item = f64> {
    let all = [0.0, 1.0, -1.0, value.trunc(), (2.0 * value).trunc() / 2.0, value - value.signum()];
    all.into_iter().filter(move |v| *v != value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rasterproof_verify::cases::near_plane::{FAMILIES, clip_corners};
    use rasterproof_verify::cases::shrink::smallest;

    fn smaller(check: Check, case: Case, fails: impl Fn(&Case) -> bool) -> Case {
        let steps = ProgramSteps::new(check, &case, &|_| true);
        smallest(case, &steps, fails)
    }

    /// What fails where a fault is planted is small afterwards, and still fails.
    #[test]
    fn piles_and_polygons_get_small() {
        let mut piles = 0;
        for index in 0..40 {
            let case = FAMILIES[0].case(1, index);
            // Two triangles, of which one is nearer at its first corner.
            let fails = |case: &Case| {
                let list = triangles(case);
                list.len() > 1 && list[0].vertices[0].depth < list[1].vertices[0].depth
            };
            if fails(&case) && flat(&case) == 0 {
                let small = smaller(Check::Depth, case, fails);
                assert!(fails(&small) && triangles(&small).len() == 2);
                assert!(size(&small).1 <= 12, "{small:?}");
                piles += 1;
            }
        }
        let mut polygons = 0;
        for index in 0..40 {
            let case = FAMILIES[1].case(1, index);
            let fails = |case: &Case| {
                let sides = clip_corners(&triangles(case)[0]).map(|[_, _, z, w, _]| z + w);
                sides.iter().filter(|side| **side < 0.0).count() == 1
            };
            if fails(&case) && flat(&case) == 0 {
                let small = smaller(Check::Near, case, fails);
                assert!(fails(&small) && flat(&small) == 0);
                assert!(size(&small).1 <= 10, "{small:?}");
                polygons += 1;
            }
        }
        assert!(piles > 5 && polygons > 5, "{piles} {polygons}");
    }
}
