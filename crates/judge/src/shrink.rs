//! Failing cases made smaller: by the steps of [`rasterproof_verify::cases`], and where these stop, at several triangles and
//! at what only the judge asks, by simpler numbers.
//!
//! A corner that triangles share moves for all of them, so that a mesh stays together. Depths of piles, and z
//! and w of clip space, are numbers like the others.

use glam::DVec2;

use super::check::Check;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect, SUBPIXELS, SubpixelPoint};
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

fn has_depth(check: Check) -> bool {
    matches!(check, Check::Depth | Check::Near | Check::Carried | Check::Wide)
}

fn flat(case: &Case) -> usize {
    triangles(case).iter().filter(|t| twice_area(&t.corners()) == 0).count()
}

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
    let window = u64::from(case.window.width()) + u64::from(case.window.height());
    (list.len(), bits, sum, window)
}

fn candidates(case: &Case, check: Check) -> Vec<Case> {
    let (list, w) = (triangles(case), case.window);
    let with = |window: PixelRect, list: Vec<Triangle>| Case {
        window,
        shape: Shape::Triangles { list, disjoint: false },
    };
    let mut found = Vec::new();
    if list.len() > 1 {
        let without = |i: usize| [&list[..i], &list[i + 1..]].concat();
        found.extend((0..list.len()).map(|i| with(w, without(i))));
    }
    let is_clipped = matches!(check, Check::Near | Check::Carried);
    // What N and A ask has no window.
    if !is_clipped {
        let sides = [[w.x1 / 2, w.y1], [w.x1, w.y1 / 2], [w.x1 - 1, w.y1], [w.x1, w.y1 - 1]];
        let sides = sides.into_iter().filter(|[x1, y1]| *x1 > w.x0 && *y1 > w.y0);
        found.extend(sides.map(|[x1, y1]| with(PixelRect { x1, y1, ..w }, list.to_vec())));
    }
    let moved = |by: &dyn Fn(SubpixelPoint) -> SubpixelPoint| {
        let mut list = list.to_vec();
        list.iter_mut().flat_map(|t| &mut t.vertices).for_each(|v| v.position = by(v.position));
        with(w, list)
    };
    for (x_px, y_px) in [(4, 0), (0, 4), (1, 0), (0, 1)] {
        let by = |v: i32, px: i32| v.saturating_sub(px * SUBPIXELS);
        found.push(moved(&|p| SubpixelPoint::new(by(p.x, x_px), by(p.y, y_px))));
    }
    let mut corners = Vec::new();
    for triangle in list {
        corners.extend(triangle.corners());
    }
    corners.sort_by_key(|p: &SubpixelPoint| (p.x, p.y));
    corners.dedup();
    for corner in corners {
        let to = |x, y| moved(&|p| if p == corner { SubpixelPoint::new(x, y) } else { p });
        found.extend(simpler(corner.x).map(|x| to(x, corner.y)));
        found.extend(simpler(corner.y).map(|y| to(corner.x, y)));
    }
    // The depths of a whole triangle, then each number alone.
    let numbers = |change: &dyn Fn(usize, usize, &mut f64, &mut DVec2)| {
        let mut list = list.to_vec();
        for (i, triangle) in list.iter_mut().enumerate() {
            for (j, v) in triangle.vertices.iter_mut().enumerate() {
                change(i, j, &mut v.depth, &mut v.varying);
            }
        }
        with(w, list)
    };
    for (i, triangle) in list.iter().enumerate() {
        if check == Check::Depth {
            for all in [0.0, 1.0] {
                found.push(numbers(&|t, _, z, _| *z = if t == i { all } else { *z }));
            }
        }
        for (j, v) in triangle.vertices.iter().enumerate() {
            if has_depth(check) {
                let to = |z| {
                    numbers(&|t, c, depth, _| *depth = if (t, c) == (i, j) { z } else { *depth })
                };
                found.extend(simpler_number(v.depth).map(to));
            }
            if is_clipped {
                let to =
                    |new| numbers(&|t, c, _, old| *old = if (t, c) == (i, j) { new } else { *old });
                let DVec2 { x: w, y: a } = v.varying;
                // At w = 0 a corner lies nowhere.
                let ws = simpler_number(w).filter(|w| *w != 0.0);
                found.extend(ws.map(|w| to(DVec2::new(w, a))));
                found.extend(simpler_number(a).map(|a| to(DVec2::new(w, a))));
            }
        }
    }
    found
}

/// The numbers of a formula with one of them simpler, or a texel fewer, as far as the formula can be asked of these.
fn simpler_formulas(case: &Case) -> Vec<Case> {
    let Shape::Numbers { formula, numbers } = &case.shape else { return Vec::new() };
    let mut found = Vec::new();
    for (i, &number) in numbers.iter().enumerate() {
        for simpler in simpler_number(number) {
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
