//! Stages around a rasterizer: the near plane, samples, culling.

use glam::{DVec2, DVec4};
use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::{Picture, flat, panel};
use super::pixels::{cover, digits, lattice_engine};
use crate::no_answer::NoAnswer;
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_faults::published;
use rasterproof_faults::published::book_near_clip::clip_near;
use rasterproof_registry::engines::Engine;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::clip::{ClipPlane, clip};
use rasterproof_render::pipeline::multisample::masks;

/// Asks what the near plane w = `near` leaves of a triangle. A corner is [x/w, y/w, w]: where it would
/// be on the screen at its distance, from -1 to 1.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Near {
    side_px: u8,
    corners: [[f64; 3]; 3],
    near: f64,
    /// Who fills what is left; the scanline engine if nothing is said.
    #[serde(default = "scanline")]
    by: String,
}

/// The engine of the pages unless a test says another.
fn scanline() -> String {
    Engine::Scanline.name().to_owned()
}

impl Near {
    /// Panels with what our clipping leaves, what the book's leaves, and the triangle as it is: `outline` in pixels, `w` of each
    /// corner, and the hits.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        // What comes from an address may be any number; NaN is in no range.
        if !(1..=128).contains(&self.side_px)
            || !self.corners.as_flattened().iter().all(|v| v.abs() <= 1e6)
            || !(1e-3..=1e3).contains(&self.near)
        {
            return Err("the near plane or a corner is out of range".into());
        }
        // z = w - 2 near puts the plane z = -w at w = near.
        let positions = self
            .corners
            .map(|[x, y, w]| DVec4::new(x * w.abs(), y * w.abs(), w - 2.0 * self.near, w));
        // What our clipping keeps, what the book's keeps, and what comes of none.
        let varying = DVec2::ZERO;
        let ours = positions.map(|position| ClipVertex { position, varying });
        let (kept, _) = clip(&ours, ClipPlane::MinW.bit() | ClipPlane::Near.bit());
        let kept: Vec<DVec4> = kept.vertices().map(|vertex| vertex.position).collect();
        let book = positions.map(|position| published::ClipVertex { position, varying });
        let book = clip_near(book, self.near);
        let book: Vec<DVec4> = book.iter().map(|vertex| vertex.position).collect();
        let engine = lattice_engine(&self.by)?;
        Ok(json!({ "panels": [
            panel("clip", self.filled(engine, &kept)),
            panel("book-near-clip", self.filled(engine, &book)),
            panel("unclipped", self.filled(engine, &positions)),
        ] }))
    }

    /// A polygon divided by w, placed and filled as a fan.
    fn filled(&self, engine: Engine, polygon: &[DVec4]) -> Result<Value, NoAnswer> {
        let side = f64::from(self.side_px);
        let (mut w, mut points, mut outline) = (Vec::new(), Vec::new(), Vec::new());
        for p in polygon {
            // From -1 to 1 across the screen, y up.
            let [x, y] = [(p.x / p.w + 1.0) / 2.0 * side, (1.0 - p.y / p.w) / 2.0 * side];
            let point = SubpixelPoint::from_px(x, y)?;
            points.push(point);
            outline.push(point.to_px());
            w.push(p.w);
        }
        // Every triangle of the fan has the first corner.
        let mut fan = Vec::new();
        for i in 2..points.len() {
            fan.push([points[0], points[i - 1], points[i]]);
        }
        let window = PixelRect::window(self.side_px.into(), self.side_px.into());
        let hits = cover(engine, &fan, window);
        Ok(json!({
            "hits": digits(&hits), "outline": outline, "w": w, "covered": hits.covered(),
        }))
    }
}

/// Asks how many of 1, 4 and 16 samples of each pixel are covered.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Samples {
    picture: Picture,
}

impl Samples {
    /// Panels with how many of the samples are covered in each pixel, and in how many pixels that is neither none nor all.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let window = self.picture.window()?;
        let list = self.picture.on_lattice()?;
        let engine = Engine::EdgeFunction;
        // A bit for each sample of each pixel, of all triangles.
        let mut one = Frame::new(window, 0u64);
        let (mut four, mut sixteen) = (one.clone(), one.clone());
        for triangle in &list {
            let corners = triangle.corners();
            engine.cover(corners, window, |s| {
                one.span_mut(s.y_px, s.x0_px, s.x1_px).fill(1);
            });
            // Four samples lie at the standard places within the pixel.
            let masks = masks(&engine, corners, window).ok_or(TOO_FAR)?;
            for (y_px, row) in masks.rows() {
                for (bits, mask) in four.row_mut(y_px).iter_mut().zip(row) {
                    *bits |= u64::from(*mask);
                }
            }
            // Sixteen samples are the centres of a window of four times the size.
            let mut large = corners;
            for corner in &mut large {
                *corner = SubpixelPoint::new(by_four(corner.x)?, by_four(corner.y)?);
            }
            let large_window = PixelRect {
                x0: by_four(window.x0)?,
                y0: by_four(window.y0)?,
                x1: by_four(window.x1)?,
                y1: by_four(window.y1)?,
            };
            engine.cover(large, large_window, |s| {
                // Four rows and four columns of the large window are one pixel.
                let row = sixteen.row_mut(s.y_px.div_euclid(4));
                for x in s.x0_px..s.x1_px {
                    let bit = s.y_px.rem_euclid(4) * 4 + x.rem_euclid(4);
                    row[(x.div_euclid(4) - window.x0) as usize] |= 1 << bit;
                }
            });
        }
        let panels = [counted(&one, 1), counted(&four, 4), counted(&sixteen, 16)];
        Ok(json!({ "panels": panels, "outlines": self.picture.outlines()? }))
    }
}

/// Positions of samples must fit into 32 bits, as those of corners do.
const TOO_FAR: &str = "a corner is too far away for samples";

/// A position in a window of four times the size.
fn by_four(v: i32) -> Result<i32, NoAnswer> {
    Ok(v.checked_mul(4).ok_or(TOO_FAR)?)
}

/// How many of so many samples of each pixel are covered, and in how many pixels some are and some are not.
fn counted(samples: &Frame<u64>, of: u32) -> Value {
    let (mut counts, mut told_apart) = (Vec::new(), 0);
    for bits in flat(samples) {
        let count = bits.count_ones();
        told_apart += usize::from(count > 0 && count < of);
        counts.push(count);
    }
    json!({ "name": format!("{of}x"), "of": of, "counts": counts, "toldApart": told_apart })
}

/// Asks which triangles are left out: `none`, `clockwise` or `counter-clockwise`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Culling {
    picture: Picture,
    removes: String,
    /// The engine that fills what is left after clipping.
    #[serde(default = "scanline")]
    by: String,
}

impl Culling {
    /// The hits of what is left, and the signed area of each triangle.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let window = self.picture.window()?;
        let cull = match self.removes.as_str() {
            "none" => Cull::None,
            "clockwise" => Cull::Clockwise,
            "counter-clockwise" => Cull::CounterClockwise,
            other => return Err(format!("'{other}' is no way to cull").into()),
        };
        let engine = lattice_engine(&self.by)?;
        let (mut kept, mut areas) = (Vec::new(), Vec::new());
        for triangle in self.picture.on_lattice()? {
            let corners = triangle.corners();
            // The sign of the area is the winding.
            let removed = cull.removes(corners);
            if !removed {
                kept.push(corners);
            }
            // As text, since a number of the page does not hold 64 bits.
            let area = twice_area(&corners);
            areas.push(json!({
                "twiceArea": area.to_string(), "sign": area.signum(), "removed": removed,
            }));
        }
        let hits = cover(engine, &kept, window);
        Ok(json!({
            "hits": digits(&hits), "covered": hits.covered(), "areas": areas,
            "outlines": self.picture.outlines()?,
        }))
    }
}
