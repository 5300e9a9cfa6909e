//! The exact values of triangles and lines, asked of big integers only where nearly exact ones leave a doubt.

use std::cell::OnceCell;

use glam::DVec2;

use super::finding::Finding;
use super::tolerance::{Bound, LINE, Tolerance};
use crate::cases::{Line, Triangle};
use crate::oracle::double_double::{self, NearPixel, NearTriangle};
use crate::oracle::values::{ExactTriangle, along_line};
use rasterproof_core::triangle::Fragment;

/// What fragments of a triangle are held to.
pub struct Truth {
    triangle: Triangle,
    exact: OnceCell<Option<ExactTriangle<2>>>,
    near: Option<NearTriangle<2>>,
    /// The pixels asked for so far; engines are compared at the same few.
    pixels: Vec<((i32, i32), NearPixel<2>)>,
}

/// How far an engine's values may lie from the exact ones.
pub struct Bounds {
    /// For each attribute.
    pub attributes: [f64; 2],
    /// For the depth.
    pub depth: f64,
}

impl Bounds {
    /// Those of an engine for a triangle.
    pub fn new(tolerance: Tolerance, triangle: &Triangle) -> Self {
        let [a, b, c] = &triangle.vertices;
        let of = |bound: Bound, k: usize| bound.at([a.varying[k], b.varying[k], c.varying[k]]);
        Self {
            attributes: [of(tolerance.attribute, 0), of(tolerance.attribute, 1)],
            depth: tolerance.depth.at([a.depth, b.depth, c.depth]),
        }
    }
}

fn depths_and_weights(triangle: &Triangle) -> [[f64; 3]; 2] {
    let [a, b, c] = &triangle.vertices;
    [[a.depth, b.depth, c.depth], [a.inv_w, b.inv_w, c.inv_w]]
}

fn attributes(triangle: &Triangle) -> [[f64; 2]; 3] {
    let [a, b, c] = &triangle.vertices;
    [a.varying.to_array(), b.varying.to_array(), c.varying.to_array()]
}

impl Truth {
    /// Nothing for a triangle of zero area, which has no values.
    pub fn new(triangle: &Triangle) -> Option<Self> {
        let [depths, inv_w] = depths_and_weights(triangle);
        let corners = triangle.corners();
        let near = NearTriangle::new(&corners, depths, inv_w, attributes(triangle));
        let truth = Self { triangle: *triangle, exact: OnceCell::new(), near, pixels: Vec::new() };
        (truth.near.is_some() || truth.exact().is_some()).then_some(truth)
    }

    fn exact(&self) -> Option<&ExactTriangle<2>> {
        let exact = || {
            let [depths, inv_w] = depths_and_weights(&self.triangle);
            let corners = self.triangle.corners();
            ExactTriangle::new(&corners, depths, inv_w, attributes(&self.triangle))
        };
        self.exact.get_or_init(exact).as_ref()
    }

    /// Compares a fragment with the exact values, unless its differences certainly stay within what
    /// is known. The worst found is the same in either case.
    pub fn compare(&mut self, f: &Fragment<DVec2>, bounds: &Bounds, finding: &mut Finding) {
        let known = (finding.attribute.min(1.0), finding.depth.min(1.0));
        let (attribute, depth) =
            if self.is_within(known, f, bounds) { known } else { self.ratios(f, bounds) };
        finding.compare(attribute, depth);
    }

    /// Whether no attribute and no depth differs by more than these fractions of their bounds, for
    /// certain.
    fn is_within(&mut self, known: (f64, f64), f: &Fragment<DVec2>, bounds: &Bounds) -> bool {
        let Some(near) = &self.near else { return false };
        let key = (f.x_px, f.y_px);
        let at = self.pixels.iter().position(|(pixel, _)| *pixel == key).unwrap_or_else(|| {
            self.pixels.push((key, near.at(f.x_px, f.y_px)));
            self.pixels.len() - 1
        });
        let pixel = &self.pixels[at].1;
        let ratio = |k: usize| pixel.attribute_at_most(k, f.varying[k]) / bounds.attributes[k];
        ratio(0) <= known.0
            && ratio(1) <= known.0
            && pixel.depth_at_most(f.depth) / bounds.depth <= known.1
    }

    /// The larger difference of an attribute and that of the depth, as fractions of their bounds;
    /// for a triangle that has values.
    fn ratios(&self, f: &Fragment<DVec2>, bounds: &Bounds) -> (f64, f64) {
        let Some(exact) = self.exact() else { return (0.0, 0.0) };
        let (depth, values) = exact.at(f.x_px, f.y_px);
        let ratio = |k: usize| values[k].distance(f.varying[k]) / bounds.attributes[k];
        (ratio(0).max(ratio(1)), depth.distance(f.depth) / bounds.depth)
    }
}

/// As [`Truth::compare`], for a fragment that is `step` of `length` steps along a line.
pub fn compare_on_line(
    line: &Line,
    [step, length]: [u64; 2],
    f: &Fragment<DVec2>,
    finding: &mut Finding,
) {
    let ratio = |known: f64, ends: [f64; 2], value: f64, bound: Bound| {
        let (known, bound) = (known.min(1.0), bound.at(ends));
        if double_double::along_line_at_most(ends, step, length, value) / bound <= known {
            return known;
        }
        along_line(ends, step, length).distance(value) / bound
    };
    let ([a, b], known) = (&line.ends, finding.attribute);
    let of = |k: usize| ratio(known, [a.varying[k], b.varying[k]], f.varying[k], LINE.attribute);
    let depth = ratio(finding.depth, [a.depth, b.depth], f.depth, LINE.depth);
    finding.compare(of(0).max(of(1)), depth);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::triangles::FAMILIES;
    use crate::cases::{Family, Shape};
    use crate::comparison::tolerance;
    use rasterproof_core::contract::Interpolate as _;
    use rasterproof_core::raster::edge_function::EdgeFunction;
    use rasterproof_core::raster::scanline::Scanline;

    /// The fragments of an engine for the cases of a family, each with its triangle.
    fn see_all(
        is_scanline: bool,
        family: &Family,
        cases: u64,
        see: &mut dyn FnMut(&Triangle, &Fragment<DVec2>),
    ) {
        for index in 0..cases {
            let case = family.case(3, index);
            let Shape::Triangles { list, .. } = &case.shape else { continue };
            for triangle in list {
                if is_scanline {
                    Scanline.fragments(triangle, case.window, |f| see(triangle, &f));
                } else {
                    EdgeFunction.fragments(triangle, case.window, |f| see(triangle, &f));
                }
            }
        }
    }

    /// A fragment whose values are wrong in one of several ways, from the last bit to infinity.
    fn planted(fragment: &Fragment<DVec2>, fault: u64) -> Fragment<DVec2> {
        let scale = [1.0, 1.0 + 1e-15, 1.0 - 1e-13, 1.0 + 1e-6, 0.5, f64::INFINITY][fault as usize];
        Fragment { varying: fragment.varying * scale, depth: fragment.depth * scale, ..*fragment }
    }

    /// Looking only into what may be the worst finds what looking into everything finds, bit for bit,
    /// of values that are right and of those with a planted fault.
    #[test]
    fn the_worst_is_the_same_whether_everything_is_looked_into_or_not() {
        let (mut wrong, mut saved, mut values) = (0, 0, 0);
        for (is_scanline, fault) in
            [false, true].into_iter().flat_map(|e| (0..6).map(move |f| (e, f)))
        {
            let tolerance =
                if is_scanline { tolerance::SCANLINE } else { tolerance::EDGE_FUNCTION };
            let cases = if fault == 0 { 24 } else { 1 };
            for family in FAMILIES {
                let (mut quick, mut slow) = (Finding::default(), Finding::default());
                see_all(is_scanline, family, cases, &mut |triangle, f| {
                    let f = &planted(f, fault);
                    let Some(mut truth) = Truth::new(triangle) else { return };
                    let bounds = Bounds::new(tolerance, triangle);
                    // A case starts from what was found before.
                    let mut known = Finding::known(quick.attribute, quick.depth);
                    truth.compare(f, &bounds, &mut known);
                    saved += u64::from(truth.exact.get().is_none());
                    truth.near = None;
                    let mut alone = Finding::default();
                    truth.compare(f, &bounds, &mut alone);
                    assert_eq!(known.is_wrong(), alone.is_wrong(), "{} {f:?}", family.name);
                    quick.compare(known.attribute, known.depth);
                    slow.compare(alone.attribute, alone.depth);
                    wrong += u64::from(alone.is_wrong());
                    values += 1;
                });
                let worst =
                    |finding: &Finding| (finding.attribute.to_bits(), finding.depth.to_bits());
                assert_eq!(worst(&quick), worst(&slow), "{} fault {fault}", family.name);
            }
        }
        // Both ways were taken often enough for this to mean something. What is wrong has to be
        // looked into, and of the rest all but a few need not be.
        let counts = format!("{wrong} wrong, {saved} of {values} saved");
        assert!(wrong > 1000 && saved * 10 > (values - wrong) * 9, "{counts}");
    }

    /// Numbers near the exact value at pixels in and around a triangle: how far they are from it, and
    /// what this module says that is at most.
    fn see_near(triangle: &Triangle, see: &mut dyn FnMut(f64, f64)) {
        let v = &triangle.vertices;
        let (depths, inv_w) = (v.map(|v| v.depth), v.map(|v| v.inv_w));
        let attributes = v.map(|v| v.varying.to_array());
        let corners = triangle.corners();
        let Some(exact) = ExactTriangle::new(&corners, depths, inv_w, attributes) else {
            assert!(NearTriangle::new(&corners, depths, inv_w, attributes).is_none());
            return;
        };
        let near = NearTriangle::new(&corners, depths, inv_w, attributes).unwrap();
        let corner = corners[0].to_px();
        for (x_px, y_px) in [(3, 5), (17, 2), (30, 40), (corner.0 as i32, corner.1 as i32)] {
            let (depth, values) = exact.at(x_px, y_px);
            let pixel = near.at(x_px, y_px);
            for moved in [0.0, 1e-16, -3e-15, 1e-9, 0.5] {
                let value = depth.to_f64() * (1.0 + moved);
                see(depth.distance(value), pixel.depth_at_most(value));
                for (k, exact) in values.iter().enumerate() {
                    let value = exact.to_f64() * (1.0 + moved);
                    see(exact.distance(value), pixel.attribute_at_most(k, value));
                }
            }
        }
    }

    /// In every family nothing exceeds what is said. It is seldom much less, so a bound that is too
    /// small by a hundredth would be noticed; and big integers have to help in few places.
    #[test]
    fn no_distance_exceeds_what_is_said() {
        let (mut count, mut open, mut close) = (0, 0, 0);
        for family in FAMILIES {
            for index in 0..40 {
                let case = family.case(5, index);
                let Shape::Triangles { list, .. } = &case.shape else { continue };
                for triangle in list {
                    see_near(triangle, &mut |distance, at_most| {
                        assert!(distance <= at_most, "{}: {distance:e} {at_most:e}", family.name);
                        count += 1;
                        open += u64::from(at_most == f64::INFINITY);
                        close += u64::from(distance > 0.99 * at_most && distance > 0.0);
                    });
                }
            }
        }
        assert!(open * 20 < count, "{open} of {count} are left open");
        assert!(close * 2 > count, "{close} of {count} are close");
    }
}
