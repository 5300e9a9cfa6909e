//! One pixel: what the edge function computes there, and how the scanline came to its row; on the
//! lattice, and for corners as they are given.

use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::Picture;
use super::pixels::row_of;
use rasterproof_core::contract::Interpolate as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::probe::edges_at;
use rasterproof_core::raster::edge_function_exact;
use rasterproof_core::raster::scanline::steps::walked_rows;
use rasterproof_core::raster::scanline_exact::probe::crossings_at;
use rasterproof_core::triangle::FreeCorners;
use rasterproof_registry::engines::Engine;
use rasterproof_verify::cases::Triangle;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Look {
    picture: Picture,
    px: [i32; 2],
}

impl Look {
    pub fn answer(&self) -> Result<Value, String> {
        let window = self.picture.window()?;
        let [x_px, y_px] = self.px;
        if !window.contains(x_px, y_px) {
            return Err(format!("pixel {x_px}, {y_px} lies outside the window"));
        }
        let triangles: Vec<_> = if self.picture.snap {
            let list = self.picture.on_lattice()?;
            list.iter().map(|triangle| look(triangle, window, x_px, y_px)).collect()
        } else {
            let list = self.picture.as_given()?;
            list.iter().map(|corners| look_as_given(corners, x_px, y_px)).collect()
        };
        Ok(json!({ "px": self.px, "triangles": triangles }))
    }
}

/// The three edges, the walks of all rows in the window, and the values where the pixel is covered.
fn look(triangle: &Triangle, window: PixelRect, x_px: i32, y_px: i32) -> Value {
    let corners = triangle.corners();
    let edges = edges_at(&corners, x_px, y_px).map(|edges| {
        let twice_area: i128 = edges.iter().map(|edge| edge.value).sum();
        edges.map(|edge| {
            json!({
                "ends": edge.ends,
                // Up to 65 bits, which a number of the page does not hold.
                "value": edge.value.to_string(),
                "sign": edge.value.signum(),
                "topLeft": edge.is_top_left,
                "weight": edge.value as f64 / twice_area as f64,
            })
        })
    });
    let pixel = PixelRect { x0: x_px, x1: x_px + 1, ..row_of(window, y_px) };
    let values = [Engine::Scanline, Engine::EdgeFunction, Engine::Oracle].map(|engine| {
        let mut values = None;
        engine.fragments(triangle, pixel, |f| values = Some([f.depth, f.varying.x, f.varying.y]));
        json!({ "by": engine.name(), "values": values })
    });
    let covered = edges.as_ref().is_some_and(|_| values.iter().any(|v| v["values"].is_array()));
    json!({
        "edges": edges, "covered": covered, "values": values,
        "rows": walked_rows(corners, window),
    })
}

/// The same for corners that are not snapped: what floats compute, how far that may be off, and what
/// is decided exactly.
fn look_as_given(corners: &FreeCorners, x_px: i32, y_px: i32) -> Value {
    let edges = edge_function_exact::probe::edges_at(corners, x_px, y_px);
    let covered = edges.is_some_and(|edges| {
        edges.iter().all(|e| e.side.is_gt() || e.side.is_eq() && e.is_top_left)
    });
    let edges = edges.map(|edges| {
        edges.map(|edge| {
            json!({
                "ends": edge.ends,
                "value": format!("{:.3e}", edge.estimate),
                "bound": edge.bound,
                "byFilter": edge.estimate.abs() > edge.bound,
                "sign": edge.side as i8,
                "topLeft": edge.is_top_left,
            })
        })
    });
    json!({
        "edges": edges, "covered": covered, "crossings": crossings_at(corners, y_px),
    })
}
