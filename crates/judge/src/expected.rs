//! What is expected of a program: by default the picture of the convention that it declares.

use super::declared::{Declared, Shape};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{HALF_PIXEL, PixelRect};
use rasterproof_core::triangle::{Corners, PixelPoint, Span, WideLine};
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::cases::named::plain_line;
use rasterproof_verify::comparison::{Convention, Expectation, Rule};
use rasterproof_verify::convention::{self, Declarations, Ties};
use rasterproof_verify::oracle::Oracle;
use rasterproof_verify::oracle::values::ExactTriangle;

/// What is expected of a program: a convention that it declares, or one that it was recognised to follow.
pub trait Expect: Send + Sync {
    /// The picture in a window at the origin; nothing where nothing is promised.
    fn picture(&self, corners: &Corners, window: PixelRect) -> Option<Expectation>;

    /// The pixels of a line in drawing order; nothing where nothing is promised.
    fn line(&self, ends: &[PixelPoint; 2], window: PixelRect) -> Option<Vec<(i32, i32)>>;

    /// The picture of a line with a width; nothing where nothing is promised.
    fn wide(&self, _line: &WideLine, _window: PixelRect) -> Option<Expectation> {
        None
    }

    /// How far depth and both attributes may be off at a pixel; nothing where the declared tolerance
    /// is meant.
    fn bounds(&self, _triangle: &Triangle, _pixel: (i32, i32)) -> Option<[f64; 3]> {
        None
    }

    /// Whether the pixels of a line are expected in that order.
    fn keeps_order(&self) -> bool {
        true
    }
}

impl Expect for Convention {
    fn picture(&self, corners: &Corners, window: PixelRect) -> Option<Expectation> {
        let is_open = matches!(self.rule, Rule::Inclusive | Rule::Unspecified);
        // Programs behind the protocol promise nothing of a triangle that is nothing but edges.
        (twice_area(corners) != 0 || !is_open).then(|| self.expected(corners, window))
    }

    fn line(&self, ends: &[PixelPoint; 2], window: PixelRect) -> Option<Vec<(i32, i32)>> {
        let line = plain_line(ends[0], ends[1]);
        let mut pixels = Vec::new();
        Oracle.steps(&line, window, &mut |pixel, _| pixels.push((pixel.x, pixel.y)));
        Some(pixels)
    }
}

/// The covered pixels as runs, row by row.
pub(super) fn runs(coverage: &Coverage) -> Vec<Span> {
    coverage.runs().map(|(y_px, x0_px, x1_px)| Span { y_px, x0_px, x1_px }).collect()
}

/// What a program declares: the picture of its convention, or of its shape.
impl Expect for Declared {
    fn picture(&self, corners: &Corners, window: PixelRect) -> Option<Expectation> {
        // Half a pixel further out, or further in, along both axes: what has to be drawn, and what may be.
        let (reach, must, may) = match self.shape {
            Shape::Sample => return self.convention.picture(corners, window),
            Shape::Touched => (HALF_PIXEL, "strict", Some("inclusive")),
            Shape::TouchedClosed => (HALF_PIXEL, "inclusive", None),
            Shape::TouchedOpen => (HALF_PIXEL, "strict", None),
            Shape::Covered => (-HALF_PIXEL, "strict", Some("inclusive")),
        };
        // What has no area is nothing but its border, of which nothing is promised.
        if twice_area(corners) == 0 {
            return None;
        }
        let known = Declarations::from(&self.convention);
        let shape = convention::Shape::Reach { x: HALF_PIXEL, y: HALF_PIXEL, reach, square: true };
        let of = |rule: &str| {
            let ties = Ties::named(rule)?;
            let convention = convention::TriangleConvention { shape, ties, ..known.declared };
            convention.cover(corners, window).as_ref().map(runs)
        };
        Some(Expectation { must: of(must)?, may: may.and_then(of) })
    }

    fn line(&self, ends: &[PixelPoint; 2], window: PixelRect) -> Option<Vec<(i32, i32)>> {
        self.convention.line(ends, window)
    }

    fn wide(&self, line: &WideLine, window: PixelRect) -> Option<Expectation> {
        // Each pixel on its own: those of a line with a width are few.
        let (mut all_must, mut all_may) = (Vec::new(), Vec::new());
        for y_px in window.y0..window.y1 {
            for x_px in window.x0..window.x1 {
                let [must, may] = self.convention.expected_of_wide(line, self.wide, [x_px, y_px]);
                let pixel = Span { y_px, x0_px: x_px, x1_px: x_px + 1 };
                all_must.extend(must.then_some(pixel));
                all_may.extend(may.then_some(pixel));
            }
        }
        let may = (all_may != all_must).then_some(all_may);
        Some(Expectation { must: all_must, may })
    }
}

/// The exact values at the declared sample; w is the one that the request names.
pub fn exact_values(triangle: &Triangle, declared: &Declared) -> Option<ExactTriangle<2>> {
    let corners = declared.convention.centred(&triangle.corners());
    let v = &triangle.vertices;
    let inv_w = v.map_array(|v| 1.0 / (1.0 / v.inv_w));
    ExactTriangle::new(
        &corners,
        v.map_array(|v| v.depth),
        inv_w,
        v.map_array(|v| v.varying.to_array()),
    )
}

/// How far depth and both attributes may be off: the tolerance times the largest magnitude at the corners. Where all are zero
/// the result must be; the smallest number keeps a quotient defined.
pub(super) fn value_bounds(triangle: &Triangle, tolerance: f64) -> [f64; 3] {
    let (mut depth, mut first, mut second) = (0.0_f64, 0.0_f64, 0.0_f64);
    for vertex in &triangle.vertices {
        depth = depth.max(vertex.depth.abs());
        first = first.max(vertex.varying.x.abs());
        second = second.max(vertex.varying.y.abs());
    }
    [depth, first, second].map(|largest| (tolerance * largest).max(f64::MIN_POSITIVE))
}
