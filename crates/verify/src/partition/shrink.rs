//! Makes a failing polygon small enough to read, while it goes on failing.

use super::families::{Coordinates, Family, is_as_generated};
use super::{Point, Polygon, key};
use crate::cases::facts::exponent;
use crate::cases::shrink::Steps;

/// Contours, runs of vertices and digits are removed, as long as the polygon is one that its family may hold.
pub(super) struct PolygonSteps {
    pub coordinates: Coordinates,
    pub family: Family,
}

impl Steps for PolygonSteps {
    type Case = Polygon;

    fn candidates(&self, _: usize, polygon: &Polygon) -> Vec<Polygon> {
        candidates(polygon, self.coordinates)
    }

    fn is_step(&self, _: usize, from: &Polygon, to: &Polygon) -> bool {
        size(to) < size(from) && is_as_generated(to, self.family)
    }
}

/// Vertices, then what a reader has to read: the digits of all coordinates.
fn size(polygon: &Polygon) -> (usize, usize) {
    let points = polygon.contours.iter().flatten();
    (points.clone().count(), points.flatten().map(|v| format!("{v:?}").len()).sum())
}

fn candidates(polygon: &Polygon, coordinates: Coordinates) -> Vec<Polygon> {
    let contours = &polygon.contours;
    let mut all = Vec::new();
    for number in 0..contours.len() {
        let mut without = contours.clone();
        without.remove(number);
        all.push(without);
    }
    // Long runs of vertices first.
    for (number, contour) in contours.iter().enumerate() {
        let halves = std::iter::successors(Some(contour.len() / 2), |run| Some(run / 2));
        for run in halves.take_while(|&run| run > 0) {
            for start in (0..contour.len()).step_by(run) {
                let mut without = contours.clone();
                without[number].drain(start..(start + run).min(contour.len()));
                all.push(without);
            }
        }
    }
    let map = |change: &dyn Fn(f64, usize) -> f64| -> Vec<Vec<Point>> {
        let point =
            |point: &Point| key([0, 1].map(|axis| coordinates.round(change(point[axis], axis))));
        contours.iter().map(|contour| contour.iter().map(point).collect()).collect()
    };
    let sorted = [0, 1].map(|axis| {
        let mut values: Vec<f64> = contours.iter().flatten().map(|point| point[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.dedup();
        values
    });
    if let (Some(&left), Some(&low)) = (sorted[0].first(), sorted[1].first()) {
        // Only the order of the coordinates, then a corner at the origin, then units of a power of two.
        all.push(map(&|value, axis| sorted[axis].partition_point(|&v| v < value) as f64));
        all.push(map(&|value, axis| value - [left, low][axis]));
        let largest = sorted.iter().flatten().fold(0.0, |most: f64, v| most.max(v.abs()));
        // The exponent of a normal number is in its bits; of zero and of smaller numbers any will do.
        let exponent = exponent(largest).clamp(-1022, 1022);
        for exponent in [exponent, 10, -10, 1, -1] {
            all.push(map(&|value, _| value * 2f64.powi(-exponent)));
        }
    }
    for bits in [1, 2, 4, 8, 16, 24, 32, 48] {
        all.push(map(&|value, _| cut(value, bits)));
    }
    for (number, contour) in contours.iter().enumerate() {
        for (at, point) in contour.iter().enumerate() {
            for axis in [0, 1] {
                let simpler = [0.0, point[axis].round(), cut(point[axis], 2), cut(point[axis], 6)];
                let others = sorted[axis].iter().copied().filter(|v| (v - point[axis]).abs() < 2.0);
                for value in simpler.into_iter().chain(others.take(8)) {
                    let mut changed = contours.clone();
                    changed[number][at][axis] = coordinates.round(value);
                    all.push(changed);
                }
            }
        }
    }
    // Tessellators may take for granted that a contour has three vertices.
    let kept = |contours: Vec<Vec<Point>>| contours.into_iter().filter(|c| c.len() >= 3).collect();
    all.into_iter().map(|contours| Polygon { contours: kept(contours) }).collect()
}

/// A number with so many bits at most.
fn cut(value: f64, bits: u32) -> f64 {
    f64::from_bits(value.to_bits() >> (53 - bits) << (53 - bits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::shrink::smallest;

    /// What fails for three vertices comes out as three vertices with one digit each.
    #[test]
    fn the_smallest_is_reached() {
        let polygon = super::super::Family::Touching.polygon(1, 3, Coordinates::F64);
        assert!(size(&polygon).0 > 6, "{polygon:?}");
        let fails = |p: &Polygon| p.contours.iter().any(|contour| contour.len() >= 3);
        let steps = PolygonSteps { coordinates: Coordinates::F64, family: Family::Touching };
        let smallest = smallest(polygon, &steps, fails);
        assert_eq!(size(&smallest), (3, 6 * "0.0".len()), "{smallest:?}");
    }
}
