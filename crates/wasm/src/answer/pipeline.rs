//! Stages around a rasterizer: the near plane, samples, culling.

use glam::{DVec2, DVec4};
use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::Picture;
use super::pixels::{digits, lattice_engine};
use rasterproof_core::contract::Rasterize as _;
use rasterproof_core::frame::{Coverage, Frame};
use rasterproof_core::geometry::twice_area;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::triangle::Corners;
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

fn scanline() -> String {
    Engine::Scanline.name().to_owned()
}

impl Near {
    pub fn answer(&self) -> Result<Value, String> {
        if !(1..=128).contains(&self.side_px)
            || !self.corners.as_flattened().iter().all(|v| v.abs() <= 1e6)
            || !(1e-3..=1e3).contains(&self.near)
        {
            return Err("the near plane or a corner is out of range".to_owned());
        }
        // z = w - 2 near puts the plane z = -w at w = near.
        let position =
            |[x, y, w]: [f64; 3]| DVec4::new(x * w.abs(), y * w.abs(), w - 2.0 * self.near, w);
        let triangle = self
            .corners
            .map(|corner| ClipVertex { position: position(corner), varying: DVec2::ZERO });
        let (kept, _) = clip(&triangle, ClipPlane::MinW.bit() | ClipPlane::Near.bit());
        let ours: Vec<DVec4> = kept.vertices().map(|vertex| vertex.position).collect();
        let published =
            triangle.map(|v| published::ClipVertex { position: v.position, varying: v.varying });
        let book: Vec<DVec4> =
            clip_near(published, self.near).into_iter().map(|vertex| vertex.position).collect();
        let all: Vec<DVec4> = triangle.iter().map(|vertex| vertex.position).collect();
        let panels = [("clip", ours), ("book-near-clip", book), ("unclipped", all)];
        let engine = lattice_engine(&self.by)?;
        Ok(json!({ "panels": panels.map(|(name, polygon)| self.panel(engine, name, &polygon)) }))
    }

    /// A polygon divided by w, placed and filled as a fan.
    fn panel(&self, engine: Engine, name: &str, polygon: &[DVec4]) -> Value {
        let side = f64::from(self.side_px);
        let window = PixelRect::window(self.side_px.into(), self.side_px.into());
        let place = |p: &DVec4| {
            SubpixelPoint::from_px((p.x / p.w + 1.0) / 2.0 * side, (1.0 - p.y / p.w) / 2.0 * side)
                .map_err(|refusal| refusal.to_string())
        };
        let placed: Result<Vec<_>, String> = polygon.iter().map(place).collect();
        let mut hits = Coverage::new(window, 0);
        match placed {
            Ok(points) => {
                for i in 2..points.len() {
                    let fan: Corners = [points[0], points[i - 1], points[i]];
                    engine.cover(fan, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
                }
                let outline: Vec<_> = points.iter().map(|p| p.to_px()).collect();
                json!({
                    "name": name, "hits": digits(&hits), "outline": outline,
                    "w": polygon.iter().map(|p| p.w).collect::<Vec<_>>(),
                    "covered": hits.covered(),
                })
            }
            Err(refused) => json!({ "name": name, "refused": refused }),
        }
    }
}

/// Asks how many of 1, 4 and 16 samples of each pixel are covered.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Samples {
    picture: Picture,
}

impl Samples {
    pub fn answer(&self) -> Result<Value, String> {
        let window = self.picture.window()?;
        let list = self.picture.on_lattice()?;
        let engine = Engine::EdgeFunction;
        let too_far = || "a corner is too far away for samples".to_owned();
        let mut one = Frame::new(window, 0u64);
        let (mut four, mut sixteen) = (one.clone(), one.clone());
        for triangle in &list {
            let corners = triangle.corners();
            engine.cover(corners, window, |s| {
                one.span_mut(s.y_px, s.x0_px, s.x1_px).fill(1);
            });
            let masks = masks(&engine, corners, window).ok_or_else(too_far)?;
            for (y_px, row) in masks.rows() {
                for (bits, mask) in four.row_mut(y_px).iter_mut().zip(row) {
                    *bits |= u64::from(*mask);
                }
            }
            // Sixteen samples are the centres of a window of four times the size.
            let by_four = |v: i32| v.checked_mul(4).ok_or_else(too_far);
            let [a, b, c] =
                corners.map(|p| Ok::<_, String>(SubpixelPoint::new(by_four(p.x)?, by_four(p.y)?)));
            let PixelRect { x0, y0, x1, y1 } = window;
            let [x0, y0, x1, y1] = [x0, y0, x1, y1].map(by_four);
            let large = PixelRect { x0: x0?, y0: y0?, x1: x1?, y1: y1? };
            engine.cover([a?, b?, c?], large, |s| {
                let row = sixteen.row_mut(s.y_px.div_euclid(4));
                for x in s.x0_px..s.x1_px {
                    let bit = s.y_px.rem_euclid(4) * 4 + x.rem_euclid(4);
                    row[(x.div_euclid(4) - window.x0) as usize] |= 1 << bit;
                }
            });
        }
        let panels = [("1x", &one, 1), ("4x", &four, 4), ("16x", &sixteen, 16)];
        let panels = panels.map(|(name, frame, of)| {
            let counts: Vec<u32> = frame
                .rows()
                .flat_map(|(_, row)| row.iter().map(|bits| bits.count_ones()))
                .collect();
            let told_apart = counts.iter().filter(|&&count| count > 0 && count < of).count();
            json!({ "name": name, "of": of, "counts": counts, "toldApart": told_apart })
        });
        Ok(json!({ "panels": panels, "outlines": self.picture.outlines()? }))
    }
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
    pub fn answer(&self) -> Result<Value, String> {
        let window = self.picture.window()?;
        let cull = match self.removes.as_str() {
            "none" => Cull::None,
            "clockwise" => Cull::Clockwise,
            "counter-clockwise" => Cull::CounterClockwise,
            other => return Err(format!("'{other}' is no way to cull")),
        };
        let engine = lattice_engine(&self.by)?;
        let mut hits = Coverage::new(window, 0);
        let mut areas = Vec::new();
        for triangle in self.picture.on_lattice()? {
            let corners = triangle.corners();
            let removed = cull.removes(corners);
            if !removed {
                engine.cover(corners, window, |s| hits.hit(s.y_px, s.x0_px, s.x1_px));
            }
            let area = twice_area(&corners);
            areas.push(json!({
                "twiceArea": area.to_string(), "sign": area.signum(), "removed": removed,
            }));
        }
        Ok(json!({
            "hits": digits(&hits), "covered": hits.covered(), "areas": areas,
            "outlines": self.picture.outlines()?,
        }))
    }
}
