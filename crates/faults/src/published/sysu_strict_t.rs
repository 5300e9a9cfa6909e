//! Specimen: the clip of SYSU assignment 2 (task 7): an edge is cut iff its t lies strictly between 0
//! and 1, in f32, and the plane before the eye is w = 1e-5.
//! Source: Sun Yat-sen University, Computer Graphics, assignment 2, and a published report (2022); see `docs/sources.md`.
//!
//! Symptom: whether an edge crosses the plane is asked of a rounded quotient: from w = 336 to w = 0 it is 1
//! exactly, so the crossing is lost while the far end is dropped, and half of a quad is missing. With corners
//! at w = +-1000 the cut itself has w = 0.

use glam::Vec4;

use super::ClipVertex;
use super::scene::{COLOURS, Image, SIDE, Setting, Version, clip_by_sign, empty, fill_clipped};

pub const PLANE: f32 = 1e-5;

pub fn clip_strict(polygon: &[Vec4]) -> Vec<Vec4> {
    let mut kept = Vec::new();
    for (i, start) in polygon.iter().enumerate() {
        let end = &polygon[(i + 1) % polygon.len()];
        let t = ((1e-5 - f64::from(start.w)) / f64::from(end.w - start.w)) as f32;
        if t > 0.0 && t < 1.0 {
            kept.push(*start * (1.0 - t) + *end * t);
        }
        if f64::from(end.w) >= 1e-5 {
            kept.push(*end);
        }
    }
    kept
}

/// A square that runs from far away to the eye's own plane, or a triangle that ends behind it.
pub fn draw(version: Version, setting: Setting) -> Image {
    let corners = match setting {
        // The corner at w = 0 is a direction: cut at the plane it becomes the square's lower side.
        Setting::Exposing => [
            Vec4::new(-0.8 * 336.0, 0.8 * 336.0, 0.0, 336.0),
            Vec4::new(0.8 * 336.0, 0.8 * 336.0, 0.0, 336.0),
            Vec4::new(0.0, -1.6 * PLANE, 0.0, 0.0),
        ],
        Setting::Harmless => [
            Vec4::new(-0.8, 0.8, 0.0, 1.0),
            Vec4::new(0.8, 0.8, 0.0, 1.0),
            Vec4::new(0.1, -0.9, 0.0, -1.0),
        ],
    };
    let as_vertex = |p: &Vec4| ClipVertex { position: p.as_dvec4(), varying: glam::DVec2::ZERO };
    let mut polygon: Vec<_> = match version {
        Version::Published => clip_strict(&corners).iter().map(as_vertex).collect(),
        Version::Repaired => {
            let corners: Vec<_> = corners.iter().map(as_vertex).collect();
            clip_by_sign(&corners, |p| p.w - f64::from(PLANE))
        }
    };
    // What lies below the screen would leave the domain of positions once divided.
    polygon = clip_by_sign(&polygon, |p| p.y + 4.0 * p.w);
    let mut image = empty(SIDE);
    fill_clipped(&mut image, &polygon, COLOURS[2]);
    image
}
