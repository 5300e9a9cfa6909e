//! Specimen: the triangle of GAMES101 homework 2 (rasterize_triangle and insideTriangle), in f32.
//! Source: GAMES101 (Lingqi Yan, 2020), homework 2, and its published solutions; see `docs/sources.md`.
//!
//! Symptom: a sample belongs where three cross products are all above or all below zero, so a sample on an edge
//! belongs to no triangle: meshes have holes along shared edges. Cross products in f32 round far from the
//! origin. The skeleton's insideTriangle takes `int x, int y` ([`Games101Strict::whole_samples`], 'pitfall 2'):
//! every sample of a pixel is its lower left corner.
//!
//! Values: alpha v0/w0 + ... over alpha/w0 + ..., and the skeleton has set every w to 1. So all are
//! linear on the screen: right for z/w, by luck, and wrong for every attribute, by up to
//! (sqrt R - 1)/(sqrt R + 1) of its spread. One solution puts the true w back
//! ([`Games101Strict::true_w`], [`super::games101_depth`]): right for attributes, wrong for z/w.

use glam::{DVec2, Vec2};

use super::scene::{Image, Setting, Version, chequered, floor};
use super::{DrawResult, Fragments, NoResult, Published, RealTriangle, Spans, bare, to_int};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Fragment, Span};

#[derive(Clone, Copy, Debug)]
pub struct Games101Strict {
    /// Whether sample positions pass through an `int`.
    pub whole_samples: bool,
    /// Whether the true w is put back where the skeleton has set 1.
    pub true_w: bool,
}

/// Positions in the frame buffer: y up, samples at + 0.5.
fn corners(triangle: &RealTriangle, bounds: PixelRect) -> [Vec2; 3] {
    triangle.map_array(|v| {
        let x = v.position_px.x - f64::from(bounds.x0);
        Vec2::new(x as f32, (f64::from(bounds.y1) - v.position_px.y) as f32)
    })
}

fn inside(corners: [Vec2; 3], sample: Vec2) -> bool {
    let side = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        (a - sample).perp_dot(a - b)
    };
    let [a, b, c] = [side(0), side(1), side(2)];
    (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0)
}

impl Games101Strict {
    fn pixels(
        self,
        corners: [Vec2; 3],
        bounds: PixelRect,
        emit: &mut dyn FnMut(i32, i32, Vec2),
    ) -> Result<(), NoResult> {
        let [a, b, c] = corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let rows = whole_range(low.y, high.y, bounds.height())?;
        for x in whole_range(low.x, high.x, bounds.width())? {
            for y in rows.clone() {
                // The lower left corner of the pixel, with y up.
                let corner = Vec2::new(x as f32, y as f32);
                let sample = if self.whole_samples { corner } else { corner + 0.5 };
                if inside(corners, sample) {
                    emit(bounds.x0 + x as i32, bounds.y1 - 1 - y as i32, corner + 0.5);
                }
            }
        }
        Ok(())
    }
}

/// The rows or columns of the bounding box, one more than are needed, as far as they are in the window.
fn whole_range(low: f32, high: f32, size: u32) -> Result<std::ops::Range<i64>, NoResult> {
    let (first, last) = (to_int(low.into())?, to_int(high.into())? + 1);
    Ok(first.max(0)..(last + 1).min(size.into()))
}

/// computeBarycentric2D: the weights of the first two corners and of the third.
fn weights([a, b, c]: [Vec2; 3], p: Vec2) -> [f32; 3] {
    [weight([a, b, c], p), weight([b, c, a], p), weight([c, a, b], p)]
}

/// The weight of the first corner: the distance from the edge opposite, as a part of that of the corner.
fn weight([a, b, c]: [Vec2; 3], p: Vec2) -> f32 {
    let at = |q: Vec2| q.x * (b.y - c.y) + (c.x - b.x) * q.y + b.x * c.y - c.x * b.y;
    at(p) / at(a)
}

impl Published for Games101Strict {
    fn cover(&self, triangle: &RealTriangle, bounds: PixelRect, emit: Spans<'_>) -> DrawResult {
        self.pixels(corners(triangle, bounds), bounds, &mut |x_px, y_px, _| {
            emit(Span { y_px, x0_px: x_px, x1_px: x_px + 1 });
        })
    }

    /// The depth as published; the attributes by the same formula, as the homework that follows
    /// does.
    fn fragments(
        &self,
        triangle: &RealTriangle,
        bounds: PixelRect,
        emit: Fragments<'_>,
    ) -> DrawResult {
        let corners = corners(triangle, bounds);
        self.pixels(corners, bounds, &mut |x_px, y_px, sample| {
            let weights = weights(corners, sample).map_array(f64::from);
            let (mut inverse, mut depth, mut varying) = (0.0, 0.0, DVec2::ZERO);
            for (weight, v) in weights.into_iter().zip(triangle) {
                let over_w = weight / if self.true_w { v.w } else { 1.0 };
                inverse += over_w;
                depth += over_w * v.depth;
                varying += over_w * v.varying;
            }
            emit(Fragment { x_px, y_px, depth: depth / inverse, varying: varying / inverse });
        })
    }
}

/// The chequered floor with every w set to 1, or a triangle that has no other.
pub fn draw(version: Version, setting: Setting) -> Image {
    let specimen = Games101Strict { whole_samples: false, true_w: false };
    match setting {
        Setting::Exposing => floor(&specimen, version, 4.0),
        Setting::Harmless => {
            let triangle = bare([[1.25, 2.75], [12.75, 4.25], [5.25, 11.75]]);
            chequered(&specimen, version, &[triangle])
        }
    }
}
