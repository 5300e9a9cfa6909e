//! Depths as a device keeps them, which of two is nearer, and what the near and the far plane leave.

use super::cells::{draw_of, hits_of, in_perspective, pixels, valued};
use super::engine::Gpu;
use super::outcome::{Errors, Outcome};
use crate::device::Error;
use crate::device::draw::{Draw, Pictures, Vertex};
use crate::device::kind::{CELL_PX, Kind, PAGE_PX};
use rasterproof_core::random::Rng;
use rasterproof_judge::ask::Subject as _;
use rasterproof_verify::cases::Triangle;
use rasterproof_verify::comparison::single_precision::depth_bounds;
use rasterproof_verify::oracle::clipped::{self, Linear, UNIT, borders, corner};
use rasterproof_verify::oracle::values::ExactTriangle;
use rasterproof_verify::specification::Standing;

const _: () = assert!(CELL_PX == clipped::CELL_PX);

/// The largest depth of 16 bits, which stands for 1.
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

/// Each triangle in a cell of its own.
fn draws(gpu: &Gpu, triangles: &[Triangle]) -> Vec<Draw> {
    let side = gpu.viewport_px();
    (0..).zip(triangles).map(|(cell, t)| draw_of(cell, valued(t, side / 2.0), side)).collect()
}

/// The depth in a pixel as it is kept: whole steps, or the bits of an f32, which are in the order of
/// their numbers; nothing where nothing is drawn.
fn kept(pictures: &Pictures, kind: Kind, cell: usize, (x, y): (i32, i32)) -> Option<u32> {
    let size = kind.pixel_bytes();
    let pixel = &pictures.row(cell, y as u32, CELL_PX)[x as usize * size..][..size];
    let mut word = [0; 4];
    word[..size].copy_from_slice(pixel);
    let (word, clear) = match size {
        2 => (u32::from(u16::from_ne_bytes([word[0], word[1]])), u32::from(u16::MAX)),
        _ => (u32::from_ne_bytes(word), 1f32.to_bits()),
    };
    (word != clear).then_some(word)
}

/// The depths of triangles alone, against the exact ones.
pub(super) fn stored(gpu: &mut Gpu, seed: u64, cases: u64, kind: Kind) -> Result<Outcome, Error> {
    let triangles = triangles(gpu, seed, cases);
    let list = draws(gpu, &triangles);
    let pictures = gpu.draw(kind, triangles.len(), list)?;
    let mut errors = Errors::default();
    for (cell, triangle) in (0..).zip(&triangles) {
        let v = &triangle.vertices;
        let (depths, inv_w) = (v.map(|v| v.depth), v.map(|v| v.inv_w));
        // Exact depths exist for triangles with an area; the others are not judged.
        let Some(exact) =
            ExactTriangle::new(&triangle.corners(), depths, inv_w, v.map(|_| [0.0; 1]))
        else {
            continue;
        };
        let [bound, of_weights] = depth_bounds(triangle, f64::from(PAGE_PX));
        for pixel in pixels().filter(|(x, y)| (x + y) % 5 == 0) {
            let Some(word) = kept(&pictures, kind, cell, pixel) else { continue };
            let (value, step) = match kind {
                Kind::Depths16 => (f64::from(word) / MOST_16, 1.0 / MOST_16),
                _ => (f64::from(f32::from_bits(word)), 0.0),
            };
            let error = exact.at(pixel.0, pixel.1).0.distance(value);
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
    let mut second: Vec<Triangle> = Vec::new();
    for i in 0..triangles.len() {
        if i % 2 == 0 {
            second.push(triangles[(i + 1) % triangles.len()]);
            continue;
        }
        let mut moved = triangles[i];
        for vertex in &mut moved.vertices {
            let by = rng.int(-2, 2) as f64 / 65536.0;
            vertex.depth = f64::from((vertex.depth + by) as f32);
        }
        second.push(moved);
    }
    let (first, second) = (draws(gpu, &triangles), draws(gpu, &second));
    let both: Vec<Draw> = first.iter().zip(&second).flat_map(|(a, b)| [*a, *b]).collect();
    let (mut overlaps, mut wrong, mut judged) = (0u64, 0u64, Vec::new());
    for (kind, name) in [(Kind::Depths16, "16 bits"), (Kind::Depths, "f32")] {
        let mut drawn = |list: &[Draw]| gpu.draw(kind, triangles.len(), list.to_vec());
        let pictures = match (drawn(&first), drawn(&second), drawn(&both)) {
            // A device need not have depths in f32.
            (Err(Error::Unsupported(_)), ..) => continue,
            (a, b, both) => [a?, b?, both?],
        };
        judged.push(name);
        for cell in 0..triangles.len() {
            for pixel in pixels() {
                let [a, b, both] = [0, 1, 2].map(|i| kept(&pictures[i], kind, cell, pixel));
                overlaps += u64::from(a.is_some() && b.is_some());
                // Bits of depths are in the order of the depths, so the smaller ones are nearer.
                wrong += u64::from(both != a.into_iter().chain(b).min());
            }
        }
    }
    let said = format!(
        "{} pairs in {}, {overlaps} px that both cover: {wrong} px do not keep the nearer",
        triangles.len(),
        judged.join(" and ")
    );
    Ok((Standing::of(wrong == 0, false), said))
}

/// Triangles that the near and the far plane cut: what is left of them has five borders, three edges and two planes.
pub(super) fn clipped(gpu: &mut Gpu, seed: u64, cases: u64) -> Result<Outcome, Error> {
    let mut rng = Rng::new("vulkan-planes", seed, 0);
    let side = CELL_PX as f32;
    // The borders of the triangles that are drawn, each in a cell.
    let (mut triangles, mut draws): (Vec<[Linear; 5]>, _) = (Vec::new(), Vec::new());
    for n in 0..cases {
        let corners = [0; 3].map(|_| corner(&mut rng, n % 2 == 0));
        let Some(borders) = borders(&corners) else { continue };
        let vertices = corners.map(|[x, y, z, w]| Vertex {
            clip: [x as f32 / UNIT, y as f32 / UNIT, z as f32 / (8.0 * UNIT), w as f32 / UNIT],
            attributes: [0.0; 2],
        });
        let (viewport, window) = ([0.0, 0.0, side, side], [CELL_PX; 2]);
        draws.push(Draw { cell: triangles.len(), vertices, viewport, window });
        triangles.push(borders);
    }
    let pictures = gpu.draw(Kind::Hits, triangles.len(), draws)?;
    // New corners are f32 in clip space, where x, y and w reach 12, divided by a w of at least 1: the
    // difference, the quotient, the product and the sum, and the division and the viewport, 6 roundings of
    // at most 12 + 12 x 12 by half a viewport; then snapped by half a step in x and y.
    let u = f64::from(f32::EPSILON) / 2.0;
    let bound_px = f64::from(gpu.step_px()) + 6.0 * u * 156.0 * f64::from(side) / 2.0;
    let (mut cut, mut different, mut wrong_px, mut furthest) = (0u64, 0u64, 0u64, 0.0f64);
    for (cell, borders) in triangles.iter().enumerate() {
        let drawn = hits_of(&pictures, cell);
        // Only a triangle with pixels on both sides of a plane is seen cut.
        let (mut differs, mut inside, mut behind) = (false, false, false);
        for (x, y) in pixels() {
            let pixel = (x as u32, y as u32);
            let values = borders.map(|b| b.at(pixel));
            let in_triangle = values[..3].iter().all(|v| *v >= 0);
            let right = in_triangle && values[3] >= 0 && values[4] >= 0;
            inside |= right;
            behind |= in_triangle && !right;
            let hits = drawn.get(x, y).unwrap_or_default();
            if hits != u8::from(right) {
                differs = true;
                wrong_px += 1;
                // No rounding explains a pixel that is drawn twice.
                let from_border =
                    borders.map(|b| b.distance_px(pixel)).into_iter().fold(f64::INFINITY, f64::min);
                furthest = furthest.max(if hits > 1 { f64::INFINITY } else { from_border });
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
    Ok((Standing::of(different == 0, furthest <= bound_px), said))
}
