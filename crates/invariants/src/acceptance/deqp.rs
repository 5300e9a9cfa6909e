//! A model of how dEQP, the base of Khronos' conformance suites, accepts pictures of triangles with one sample for each
//! pixel (`framework/common/tcuRasterizationVerifier.cpp`).

use glam::DVec2;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::{PixelRect, SUBPIXEL_BITS};
use rasterproof_verify::cases::Triangle;

/// What dEQP says about a pixel before it looks at the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cover {
    Full,
    /// An edge is near its centre: it may be drawn or not.
    Partial,
    None,
}

/// Wrong pixels that the weak mode lets through.
pub const WEAK: usize = 10;
/// How near to the centre an edge may pass before a pixel may be anything, in subpixels of the device.
const NEAR: i64 = 3;

/// A point in subpixels of the device, which has its own number of bits below the pixel.
type DevicePoint = [i64; 2];

/// Whether a picture of white triangles on black is accepted with at most `allowed` wrong pixels.
#[must_use]
pub fn accepts(covers: &[Cover], pixels: &[[u8; 3]], allowed: usize) -> bool {
    let (mut wrong, mut reference_empty, mut result_empty) = (0, true, true);
    for (cover, pixel) in covers.iter().zip(pixels) {
        // Colours of 8 bits may differ by 1.
        let is_black = pixel.iter().all(|&v| v <= 1);
        let is_white = pixel.iter().all(|&v| v >= 254);
        reference_empty &= *cover == Cover::None;
        result_empty &= is_black;
        wrong += usize::from(match cover {
            Cover::Full => !is_white,
            Cover::Partial => false,
            Cover::None => !is_black,
        });
    }
    wrong <= allowed && reference_empty == result_empty
}

/// Whether no pixel of grey triangles that are added was hit twice, and where the window is filled each was hit.
#[must_use]
pub fn added_once(pixels: &[[u8; 3]], fills_window: bool) -> bool {
    // A triangle adds 127, so two of them come to more than 128, and none leaves black.
    for channel in pixels.as_flattened() {
        if *channel > 128 || fills_window && *channel <= 1 {
            return false;
        }
    }
    true
}

/// What dEQP says about every pixel of a window, for a device with so many bits below the pixel.
pub fn covers(triangles: &[Triangle], window: PixelRect, bits: u32) -> Vec<Cover> {
    let outlines: Vec<Outline> = triangles.iter().map(|t| Outline::new(t, bits)).collect();
    let shared: Vec<[bool; 3]> = (0..outlines.len()).map(|i| shared_edges(&outlines, i)).collect();
    let mut covers = Vec::with_capacity(window.width() as usize * window.height() as usize);
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            covers.push(cover_by_all(&outlines, &shared, [i64::from(x), i64::from(y)]));
        }
    }
    covers
}

/// What dEQP says about a pixel for all triangles together: full where one of them covers it without doubt, or two that share an
/// edge cover it between them; else partial where an edge is near.
fn cover_by_all(outlines: &[Outline], shared: &[[bool; 3]], pixel: DevicePoint) -> Cover {
    let mut result = Cover::None;
    for (i, outline) in outlines.iter().enumerate() {
        match outline.cover(pixel) {
            Cover::None => continue,
            Cover::Full => return Cover::Full,
            Cover::Partial => result = Cover::Partial,
        }
        // A pixel on nothing but a shared edge belongs to one of the two triangles.
        if !outline.only_on(pixel, shared[i]) {
            continue;
        }
        for (j, other) in outlines.iter().enumerate() {
            if j != i && other.only_on(pixel, shared[j]) && other.cover(pixel) != Cover::None {
                return Cover::Full;
            }
        }
    }
    result
}

/// The corners of a triangle, clockwise with y down.
struct Outline {
    /// In units of 1/256 px, as the scene gives them, before the device rounds them.
    exact: [DevicePoint; 3],
    /// In subpixels of the device, rounded down and up.
    rounded: [[DevicePoint; 2]; 3],
    bits: u32,
}

impl Outline {
    /// For a device with so many bits below the pixel.
    fn new(triangle: &Triangle, bits: u32) -> Self {
        let mut exact = triangle.corners().map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        if cross(exact[0], exact[1], exact[2]) < 0 {
            exact.swap(1, 2);
        }
        let step = 1i64 << SUBPIXEL_BITS.saturating_sub(bits);
        let rounded = exact.map_array(|[x, y]| {
            let down = [x.div_euclid(step), y.div_euclid(step)];
            [down, [-(-x).div_euclid(step), -(-y).div_euclid(step)]]
        });
        Self { exact, rounded, bits }
    }

    /// What this triangle alone says about a pixel.
    fn cover(&self, pixel: DevicePoint) -> Cover {
        // Nothing but the box of the corners, one pixel wider, is looked at.
        for axis in 0..2 {
            let of = self.exact.map_array(|p| p[axis]);
            let (least, most) = (of[0].min(of[1]).min(of[2]), of[0].max(of[1]).max(of[2]));
            if pixel[axis] * 256 > most + 256 || pixel[axis] * 256 < least - 256 {
                return Cover::None;
            }
        }
        // A square around the centre: an edge through it is near, however the device rounds its ends.
        let half = 1i64 << self.bits >> 1;
        let [x, y] = pixel.map_array(|px| (px << self.bits) + half);
        let square = [
            [x - NEAR, y - NEAR],
            [x + NEAR, y - NEAR],
            [x + NEAR, y + NEAR],
            [x - NEAR, y + NEAR],
        ];
        for edge in 0..3 {
            let (starts, ends) = (self.roundings(edge), self.roundings((edge + 1) % 3));
            for start in &starts {
                for end in &ends {
                    for i in 0..4 {
                        if meet([*start, *end], [square[i], square[(i + 1) % 4]]) {
                            return Cover::Partial;
                        }
                    }
                }
            }
        }
        // No edge runs through the square, so that one of its corners tells for all of it.
        let [[a, _], [b, _], [c, _]] = self.rounded;
        let corner = square[0];
        if cross(a, b, corner) >= 0 && cross(b, c, corner) >= 0 && cross(c, a, corner) >= 0 {
            Cover::Full
        } else {
            Cover::None
        }
    }

    /// A corner with each of its coordinates rounded either way.
    fn roundings(&self, corner: usize) -> Vec<DevicePoint> {
        let [down, up] = self.rounded[corner];
        let mut all = vec![down, [up[0], down[1]], [down[0], up[1]], up];
        all.dedup();
        all
    }

    /// Whether a pixel is near exactly one edge, and that one is shared.
    fn only_on(&self, pixel: DevicePoint, shared: [bool; 3]) -> bool {
        let near: Vec<usize> = (0..3).filter(|&edge| self.is_near(pixel, edge)).collect();
        matches!(near[..], [edge] if shared[edge])
    }

    /// Within 2 half diagonals of a pixel from the edge, and not beyond its ends.
    fn is_near(&self, pixel: DevicePoint, edge: usize) -> bool {
        let [a, b] = [self.exact[edge], self.exact[(edge + 1) % 3]]
            .map_array(|[x, y]| DVec2::new(x as f64 / 256.0, y as f64 / 256.0));
        let centre = DVec2::new(pixel[0] as f64 + 0.5, pixel[1] as f64 + 0.5);
        let (line, v) = (b - a, centre - a);
        let product = line.x * v.y - line.y * v.x;
        let farthest = length(line) + 1.414;
        product * product <= 2.0 * (line.x * line.x + line.y * line.y)
            && length(v) <= farthest
            && length(centre - b) <= farthest
    }

    fn ends(&self, edge: usize) -> [DevicePoint; 2] {
        [self.exact[edge], self.exact[(edge + 1) % 3]]
    }
}

/// In one order of the operations, whatever a processor has instructions for.
fn length(v: DVec2) -> f64 {
    (v.x * v.x + v.y * v.y).sqrt()
}

/// Which edges of a triangle another one has as well, in either direction.
fn shared_edges(outlines: &[Outline], of: usize) -> [bool; 3] {
    let mut shared = [false; 3];
    for (i, other) in outlines.iter().enumerate() {
        if i == of {
            continue;
        }
        for (edge, shared) in shared.iter_mut().enumerate() {
            let [a, b] = outlines[of].ends(edge);
            *shared |= (0..3).any(|e| [[a, b], [b, a]].contains(&other.ends(e)));
        }
    }
    shared
}

/// On which side of the line from a to b the point c lies: 1, 0 on the line, or -1.
fn cross(a: DevicePoint, b: DevicePoint, c: DevicePoint) -> i64 {
    // In 128 bits, since hard cases have corners at the ends of the domain.
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]].map_array(i128::from);
    let [px, py] = [c[0] - a[0], c[1] - a[1]].map_array(i128::from);
    (dx * py - dy * px).signum() as i64
}

/// Whether two segments meet, ends included; parallel ones on one line count.
fn meet(one: [DevicePoint; 2], other: [DevicePoint; 2]) -> bool {
    let apart =
        |[a, b]: [DevicePoint; 2], [c, d]: [DevicePoint; 2]| cross(a, b, c) * cross(a, b, d) > 0;
    !apart(one, other) && !apart(other, one)
}
