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
    let (mut vertices, mut digits) = (0, 0);
    for [x, y] in polygon.contours.iter().flatten() {
        vertices += 1;
        digits += format!("{x:?}{y:?}").len();
    }
    (vertices, digits)
}

/// Simpler polygons, the boldest changes first.
fn candidates(polygon: &Polygon, coordinates: Coordinates) -> Vec<Polygon> {
    let mut simpler = Simpler { contours: &polygon.contours, coordinates, all: Vec::new() };
    simpler.without_parts();
    let sorted = [simpler.values(0), simpler.values(1)];
    simpler.in_other_numbers(&sorted);
    simpler.with_one_coordinate(&sorted);
    // Tessellators may take for granted that a contour has three vertices.
    for polygon in &mut simpler.all {
        polygon.contours.retain(|contour| contour.len() >= 3);
    }
    simpler.all
}

struct Simpler<'a> {
    contours: &'a [Vec<Point>],
    coordinates: Coordinates,
    all: Vec<Polygon>,
}

impl Simpler<'_> {
    /// Without one contour, or without a run of vertices; long runs first.
    fn without_parts(&mut self) {
        for number in 0..self.contours.len() {
            let mut contours = self.contours.to_vec();
            contours.remove(number);
            self.all.push(Polygon { contours });
        }
        for (number, contour) in self.contours.iter().enumerate() {
            let mut run = contour.len() / 2;
            while run > 0 {
                for start in (0..contour.len()).step_by(run) {
                    let mut contours = self.contours.to_vec();
                    contours[number].drain(start..(start + run).min(contour.len()));
                    self.all.push(Polygon { contours });
                }
                run /= 2;
            }
        }
    }

    /// All coordinates along an axis in order, each once.
    fn values(&self, axis: usize) -> Vec<f64> {
        let mut values: Vec<f64> = self.contours.iter().flatten().map(|p| p[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.dedup();
        values
    }

    /// Adds the polygon of which every coordinate is changed alike.
    fn changed(&mut self, change: &dyn Fn(f64, usize) -> f64) {
        let mut contours = self.contours.to_vec();
        for point in contours.iter_mut().flatten() {
            let [x, y] = *point;
            *point =
                key([self.coordinates.round(change(x, 0)), self.coordinates.round(change(y, 1))]);
        }
        self.all.push(Polygon { contours });
    }

    fn in_other_numbers(&mut self, sorted: &[Vec<f64>; 2]) {
        if let (Some(&left), Some(&low)) = (sorted[0].first(), sorted[1].first()) {
            // Only the order of the coordinates, then a corner at the origin, then units of a power of two.
            self.changed(&|value, axis| sorted[axis].partition_point(|&v| v < value) as f64);
            self.changed(&|value, axis| value - [left, low][axis]);
            let mut largest = 0.0_f64;
            for value in sorted.iter().flatten() {
                largest = largest.max(value.abs());
            }
            // The exponent of a normal number is in its bits; of zero and of smaller numbers any will do.
            let exponent = exponent(largest).clamp(-1022, 1022);
            for exponent in [exponent, 10, -10, 1, -1] {
                self.changed(&|value, _| value * 2f64.powi(-exponent));
            }
        }
        for bits in [1, 2, 4, 8, 16, 24, 32, 48] {
            self.changed(&|value, _| cut(value, bits));
        }
    }

    /// One coordinate at 0, with fewer digits, or in line with others near it.
    fn with_one_coordinate(&mut self, sorted: &[Vec<f64>; 2]) {
        for (number, contour) in self.contours.iter().enumerate() {
            for (at, point) in contour.iter().enumerate() {
                for axis in [0, 1] {
                    let value = point[axis];
                    let mut simpler = vec![0.0, value.round(), cut(value, 2), cut(value, 6)];
                    let near = sorted[axis].iter().filter(|v| (**v - value).abs() < 2.0);
                    simpler.extend(near.take(8));
                    for value in simpler {
                        let mut contours = self.contours.to_vec();
                        contours[number][at][axis] = self.coordinates.round(value);
                        self.all.push(Polygon { contours });
                    }
                }
            }
        }
    }
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
