//! Depths as a device keeps them, which of two is nearer, and what the near and the far plane leave.

use super::cells::{draw_of, hits_of, in_perspective, valued};
use super::engine::Gpu;
use super::rules::{Class, Errors, Outcome};
use super::specified::depth_bounds;
use crate::device::Error;
use crate::device::draw::{Draw, Pictures, Vertex};
use crate::device::stage::{CELL_PX, Kind};
use rasterproof_judge::ask::Ask as _;
use rasterproof_verify::cases::{Rng, Triangle};
use rasterproof_verify::oracle::values::ExactTriangle;

/// The largest depth of 16 bits.
const MOST_16: f64 = 65535.0;

/// Triangles of the families whose depths stay off both ends, so that what is cleared is told from what
/// is drawn.
fn triangles(gpu: &Gpu, seed: u64, cases: u64) -> Vec<Triangle> {
    let mut all = in_perspective(gpu.declared(), seed, cases);
    for vertex in all.iter_mut().flat_map(|t| &mut t.vertices) {
        vertex.depth = f64::from((0.0625 + 0.875 * vertex.depth.clamp(0.0, 1.0)) as f32);
    }
    all
}

fn draws(gpu: &Gpu, triangles: &[Triangle]) -> Vec<Draw> {
    let side = gpu.viewport_px();
    (0..).zip(triangles).map(|(cell, t)| draw_of(cell, valued(t, side / 2.0), side)).collect()
}

/// The depth in a pixel as it is kept: whole steps, or the bits of an f32, which are in the order of
/// their numbers; nothing where nothing is drawn.
fn kept(pictures: &Pictures, kind: Kind, cell: usize, (x, y): (u32, u32)) -> Option<u32> {
    let size = kind.pixel_bytes();
    let pixel = &pictures.row(cell, y, CELL_PX)[x as usize * size..][..size];
    let mut word = [0; 4];
    word[..size].copy_from_slice(pixel);
    let (word, clear) = match size {
        2 => (u32::from(u16::from_ne_bytes([word[0], word[1]])), u32::from(u16::MAX)),
        _ => (u32::from_ne_bytes(word), 1f32.to_bits()),
    };
    (word != clear).then_some(word)
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..CELL_PX).flat_map(|y| (0..CELL_PX).map(move |x| (x, y)))
}

/// Depths of the families, against exact ones.
pub(super) fn stored(gpu: &mut Gpu, seed: u64, cases: u64, kind: Kind) -> Result<Outcome, Error> {
    let triangles = triangles(gpu, seed, cases);
    let list = draws(gpu, &triangles);
    let pictures = gpu.draw(kind, triangles.len(), list)?;
    let mut errors = Errors::default();
    for (cell, triangle) in (0..).zip(&triangles) {
        let v = &triangle.vertices;
        let (depths, inv_w) = (v.map(|v| v.depth), v.map(|v| v.inv_w));
        let Some(exact) =
            ExactTriangle::new(&triangle.corners(), depths, inv_w, v.map(|_| [0.0; 1]))
        else {
            continue;
        };
        let [bound, of_weights] = depth_bounds(triangle);
        for pixel in pixels().filter(|(x, y)| (x + y) % 5 == 0) {
            let Some(word) = kept(&pictures, kind, cell, pixel) else { continue };
            let (value, step) = match kind {
                Kind::Depths16 => (f64::from(word) / MOST_16, 1.0 / MOST_16),
                _ => (f64::from(f32::from_bits(word)), 0.0),
            };
            let error = exact.at(pixel.0 as i32, pixel.1 as i32).0.distance(value);
            // Of two steps the nearer is preferred, and either allowed.
            errors.add(error, bound + step / 2.0, of_weights + step);
        }
    }
    Ok(errors.outcome("depths", "what is allowed"))
}

/// Two triangles in one cell: each pixel keeps the smaller of the depths that each of them has alone.
pub(super) fn nearer(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let triangles = triangles(gpu, seed, cases);
    let mut rng = Rng::new("vulkan-depth-test", seed, 0);
    // Every other one is the first moved by a few steps of 2^-16: nearly the same plane.
    let second: Vec<Triangle> = (0..triangles.len())
        .map(|i| {
            let mut t = triangles[if i % 2 == 0 { (i + 1) % triangles.len() } else { i }];
            for vertex in &mut t.vertices {
                let by = if i % 2 == 0 { 0.0 } else { rng.int(-2, 2) as f64 / 65536.0 };
                vertex.depth = f64::from((vertex.depth + by) as f32);
            }
            t
        })
        .collect();
    let (first, second) = (draws(gpu, &triangles), draws(gpu, &second));
    let both: Vec<Draw> = first.iter().zip(&second).flat_map(|(a, b)| [*a, *b]).collect();
    let (mut overlaps, mut wrong, mut judged) = (0u64, 0u64, Vec::new());
    for (kind, name) in [(Kind::Depths16, "16 bits"), (Kind::Depths, "f32")] {
        let mut drawn = |list: &[Draw]| gpu.draw(kind, triangles.len(), list.to_vec());
        let pictures = match (drawn(&first), drawn(&second), drawn(&both)) {
            (Err(Error::Unsupported(_)), ..) => continue,
            (a, b, both) => [a?, b?, both?],
        };
        judged.push(name);
        for cell in 0..triangles.len() {
            for pixel in pixels() {
                let [a, b, both] = [0, 1, 2].map(|i| kept(&pictures[i], kind, cell, pixel));
                overlaps += u64::from(a.is_some() && b.is_some());
                wrong += u64::from(both != a.into_iter().chain(b).min());
            }
        }
    }
    let said = format!(
        "{} pairs in {}, {overlaps} px that both cover: {wrong} px do not keep the nearer",
        triangles.len(),
        judged.join(" and ")
    );
    Ok((if wrong == 0 { Class::Equal } else { Class::Outside }, said))
}

/// Clip coordinates of a corner in 1/64, z in 1/512: whole numbers.
type Whole = [i64; 4];
const UNIT: f32 = 64.0;
/// Coordinates of x and y reach so far, in units of w = 1.
const REACH: i64 = 8;

/// A corner before or behind the planes: half of them as they are, at w = 1, half in a perspective whose
/// near plane lies at w = 1 and whose far plane lies at w = 9, behind the eye too.
fn corner(rng: &mut Rng, in_perspective: bool) -> Whole {
    let unit = UNIT as i64;
    let along = |rng: &mut Rng| match rng.chance(2) {
        true => rng.int(-unit, unit),
        false => rng.int(-REACH * unit, REACH * unit),
    };
    let (x, y) = (along(rng), along(rng));
    if in_perspective {
        let w = rng.int(-3 * unit, 12 * unit);
        // z = 9/8 (w - 1).
        [x, y, 9 * (w - unit), w]
    } else {
        [x, y, rng.int(-8 * unit, 16 * unit), unit]
    }
}

/// A sum of products that is linear in a pixel's place: its value there, times 64, and its steepness.
#[derive(Clone, Copy)]
struct Linear([i128; 3]);

impl Linear {
    /// From pixels' places in the cell, in halves of a pixel.
    fn at(self, (x, y): (u32, u32)) -> i128 {
        let half = i128::from(CELL_PX);
        let place = |px: u32| i128::from(2 * px + 1) - half;
        self.0[0] * place(x) + self.0[1] * place(y) + self.0[2] * half
    }

    /// The distance in px of a pixel's centre from where it is 0.
    fn distance_px(self, pixel: (u32, u32)) -> f64 {
        let (x, y) = (self.0[0] as f64, self.0[1] as f64);
        let steep = (x * x + y * y).sqrt();
        if steep > 0.0 {
            (self.at(pixel).unsigned_abs() as f64) / steep / 2.0
        } else {
            f64::INFINITY
        }
    }
}

/// What is not negative inside of what the planes leave: the three edges, near and far.
fn borders(corners: &[Whole; 3]) -> Option<[Linear; 5]> {
    let wide = corners.map(|c| c.map(i128::from));
    // The side of the plane through the eye and an edge, as (x, y, 1) in clip space.
    let edge = |i: usize| {
        let ([ax, ay, _, aw], [bx, by, _, bw]) = (wide[(i + 1) % 3], wide[(i + 2) % 3]);
        [ay * bw - aw * by, aw * bx - ax * bw, ax * by - ay * bx]
    };
    let edges = [edge(0), edge(1), edge(2)];
    let [x, y, _, w] = wide[0];
    let volume = edges[0][0] * x + edges[0][1] * y + edges[0][2] * w;
    if volume == 0 {
        return None;
    }
    let edges = edges.map(|e| e.map(|v| v * volume.signum()));
    // Depth and w of the plane through the corners, both times the volume; z counts in 1/8 more.
    let weighed = |of: [i128; 3]| {
        [0, 1, 2].map(|axis| edges.iter().zip(of).map(|(e, value)| e[axis] * value).sum::<i128>())
    };
    let near = weighed(wide.map(|c| c[2]));
    let far = weighed(wide.map(|c| 8 * c[3] - c[2]));
    Some([edges[0], edges[1], edges[2], near, far].map(Linear))
}

/// Triangles that the near and the far plane cut.
pub(super) fn clipped(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let mut rng = Rng::new("vulkan-planes", seed, 0);
    let triangles: Vec<([Whole; 3], [Linear; 5])> = (0..cases)
        .filter_map(|n| {
            let corners = [0; 3].map(|_| corner(&mut rng, n % 2 == 0));
            Some((corners, borders(&corners)?))
        })
        .collect();
    let side = CELL_PX as f32;
    let draws = (0..).zip(&triangles).map(|(cell, (corners, _))| Draw {
        cell,
        vertices: corners.map(|[x, y, z, w]| Vertex {
            clip: [x as f32 / UNIT, y as f32 / UNIT, z as f32 / (8.0 * UNIT), w as f32 / UNIT],
            attributes: [0.0; 2],
        }),
        viewport: [0.0, 0.0, side, side],
        window: [CELL_PX; 2],
    });
    let pictures = gpu.draw(Kind::Hits, triangles.len(), draws.collect())?;
    // New corners are f32 in clip space, where x, y and w reach 12, divided by a w of at least 1: the
    // difference, the quotient, the product and the sum, and the division and the viewport, 6 roundings of
    // at most 12 + 12 x 12 by half a viewport; then snapped by half a step in x and y.
    let u = f64::from(f32::EPSILON) / 2.0;
    let bound_px = f64::from(gpu.step_px()) + 6.0 * u * 156.0 * f64::from(side) / 2.0;
    let (mut cut, mut different, mut wrong_px, mut furthest) = (0u64, 0u64, 0u64, 0.0f64);
    for (cell, (_, borders)) in (0..).zip(&triangles) {
        let drawn = hits_of(&pictures, cell);
        let (mut differs, mut inside, mut behind) = (false, false, false);
        for pixel in pixels() {
            let values = borders.map(|b| b.at(pixel));
            let in_triangle = values[..3].iter().all(|v| *v >= 0);
            let right = in_triangle && values[3] >= 0 && values[4] >= 0;
            inside |= right;
            behind |= in_triangle && !right;
            let hits = drawn.get(pixel.0 as i32, pixel.1 as i32).unwrap_or_default();
            if hits != u8::from(right) {
                differs = true;
                wrong_px += 1;
                let near =
                    borders.map(|b| b.distance_px(pixel)).into_iter().fold(f64::INFINITY, f64::min);
                furthest = furthest.max(if hits > 1 { f64::INFINITY } else { near });
            }
        }
        cut += u64::from(inside && behind);
        different += u64::from(differs);
    }
    let said = format!(
        "{cut} of {} triangles are seen cut; {different} differ, in {wrong_px} px, the furthest \
         {furthest:.4} px from a border; clipping explains {bound_px:.4}",
        triangles.len()
    );
    Ok(match different {
        0 => (Class::Equal, said),
        _ if furthest <= bound_px => (Class::Allowed, said),
        _ => (Class::Outside, said),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle at w = 1 over the lower right half of the view, its depth rising from -1 at the left to 1
    /// at the right: the middle column is where the near plane cuts.
    #[test]
    fn a_cut_by_hand() {
        let unit = UNIT as i64;
        let corners =
            [[-unit, unit], [unit, -unit], [unit, unit]].map(|[x, y]| [x, y, 8 * x, unit]);
        let borders = borders(&corners).unwrap();
        let is_in = |pixel| borders.iter().all(|b| b.at(pixel) >= 0);
        let half = CELL_PX / 2;
        assert!(is_in((half, half)) && is_in((CELL_PX - 1, 0)) && is_in((half, CELL_PX - 1)));
        assert!(!is_in((half - 1, half)) && !is_in((half - 1, CELL_PX - 1)));
        assert!(!is_in((half, half - 2)));
        assert_eq!(borders[3].distance_px((half + 3, 5)), 3.5);
        assert!(borders[4].at((CELL_PX - 1, 0)) > 0);
    }

    /// Behind the eye a corner turns over: an edge that ends there goes the other way.
    #[test]
    fn behind_the_eye_by_hand() {
        let unit = UNIT as i64;
        // From w = 3 at (0, 0) to both sides at w = -1: what is seen is the region between the rays.
        let at = |x: i64, y: i64, w: i64| [x * unit, y * unit, 9 * (w - 1) * unit, w * unit];
        let corners = [at(0, 0, 3), at(-4, 4, -1), at(4, 4, -1)];
        let borders = borders(&corners).unwrap();
        let is_in = |pixel| borders.iter().all(|b| b.at(pixel) >= 0);
        let half = CELL_PX / 2;
        // The near plane, w = 1, is reached halfway, at y = 2: beyond the lower border of the view.
        assert!(is_in((half, half + 4)) && is_in((half, CELL_PX - 1)));
        assert!(!is_in((half, half - 4)) && !is_in((0, half + 1)));
    }
}
