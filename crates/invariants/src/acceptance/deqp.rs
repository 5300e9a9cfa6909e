//! A model of how dEQP, the base of Khronos' conformance suites, accepts pictures of triangles with one sample for each
//! pixel (`framework/common/tcuRasterizationVerifier.cpp`).

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
    let twice = |pixel: &[u8; 3]| pixel.iter().any(|&v| v > 128);
    let missing = |pixel: &[u8; 3]| pixel.iter().any(|&v| v <= 1);
    !pixels.iter().any(twice) && (!fills_window || !pixels.iter().any(missing))
}

/// What dEQP says about every pixel of a window, for a device with so many bits below the pixel.
pub fn covers(triangles: &[Triangle], window: PixelRect, bits: u32) -> Vec<Cover> {
    let outlines: Vec<Outline> = triangles.iter().map(|t| Outline::new(t, bits)).collect();
    let shared: Vec<[bool; 3]> = (0..outlines.len()).map(|i| shared_edges(&outlines, i)).collect();
    let mut covers = Vec::with_capacity(window.width() as usize * window.height() as usize);
    for y in window.y0..window.y1 {
        for x in window.x0..window.x1 {
            let pixel = [i64::from(x), i64::from(y)];
            let mut result = Cover::None;
            for (i, outline) in outlines.iter().enumerate() {
                if result == Cover::Full {
                    break;
                }
                match outline.cover(pixel) {
                    Cover::None => {}
                    Cover::Full => result = Cover::Full,
                    // A pixel on nothing but a shared edge belongs to one of the two triangles.
                    Cover::Partial
                        if outline.only_on(pixel, shared[i])
                            && (0..outlines.len()).any(|other| {
                                other != i
                                    && outlines[other].only_on(pixel, shared[other])
                                    && outlines[other].cover(pixel) != Cover::None
                            }) =>
                    {
                        result = Cover::Full;
                    }
                    Cover::Partial => result = Cover::Partial,
                }
            }
            covers.push(result);
        }
    }
    covers
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
    fn new(triangle: &Triangle, bits: u32) -> Self {
        let mut exact = triangle.corners().map_array(|p| [i64::from(p.x), i64::from(p.y)]);
        if cross(exact[0], exact[1], exact[2]) < 0 {
            exact.swap(1, 2);
        }
        let step = 1i64 << SUBPIXEL_BITS.saturating_sub(bits);
        let down = |v: i64| v.div_euclid(step);
        let up = |v: i64| -(-v).div_euclid(step);
        Self { exact, rounded: exact.map_array(|p| [p.map_array(down), p.map_array(up)]), bits }
    }

    fn cover(&self, pixel: DevicePoint) -> Cover {
        // Nothing but the box of the corners, one pixel wider, is looked at.
        for axis in 0..2 {
            let of = self.exact.map_array(|p| p[axis]);
            let (least, most) = (of[0].min(of[1]).min(of[2]), of[0].max(of[1]).max(of[2]));
            if pixel[axis] * 256 > most + 256 || pixel[axis] * 256 < least - 256 {
                return Cover::None;
            }
        }
        let half = 1i64 << self.bits >> 1;
        let centre = pixel.map_array(|px| (px << self.bits) + half);
        let at = |dx: i64, dy: i64| [centre[0] + dx, centre[1] + dy];
        let square = [at(-NEAR, -NEAR), at(NEAR, -NEAR), at(NEAR, NEAR), at(-NEAR, NEAR)];
        for edge in 0..3 {
            let (starts, ends) = (self.roundings(edge), self.roundings((edge + 1) % 3));
            for start in &starts {
                for end in &ends {
                    let touches =
                        (0..4).any(|i| meet([*start, *end], [square[i], square[(i + 1) % 4]]));
                    if touches {
                        return Cover::Partial;
                    }
                }
            }
        }
        let down = |i: usize| self.rounded[i % 3][0];
        let inside = (0..3).all(|edge| cross(down(edge), down(edge + 1), square[0]) >= 0);
        if inside { Cover::Full } else { Cover::None }
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
        let px = |p: DevicePoint| p.map_array(|v| v as f64 / 256.0);
        let (a, b) = (px(self.exact[edge]), px(self.exact[(edge + 1) % 3]));
        let centre = pixel.map_array(|v| v as f64 + 0.5);
        let minus = |p: [f64; 2], q: [f64; 2]| [p[0] - q[0], p[1] - q[1]];
        let length = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();
        let (line, v) = (minus(b, a), minus(centre, a));
        let product = line[0] * v[1] - line[1] * v[0];
        let farthest = length(line) + 1.414;
        product * product <= 2.0 * (line[0] * line[0] + line[1] * line[1])
            && length(v) <= farthest
            && length(minus(centre, b)) <= farthest
    }
}

fn shared_edges(outlines: &[Outline], of: usize) -> [bool; 3] {
    let ends = |i: usize, edge: usize| [outlines[i].exact[edge], outlines[i].exact[(edge + 1) % 3]];
    [0, 1, 2].map_array(|edge| {
        let [a, b] = ends(of, edge);
        let others = (0..outlines.len()).filter(|&i| i != of);
        { others }.any(|i| (0..3).any(|e| ends(i, e) == [a, b] || ends(i, e) == [b, a]))
    })
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
