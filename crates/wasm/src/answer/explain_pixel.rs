//! One pixel: what the edge function computes there, and how the scanline came to its row; on the
//! lattice, and for corners as they are given.

use serde::Deserialize;
use serde_json::{Value, json};

use super::picture::Picture;
use super::pixels::row_of;
use crate::no_answer::NoAnswer;
use rasterproof_core::contract::Interpolate as _;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::raster::edge_function::probe::{EdgeAt, edges_at};
use rasterproof_core::raster::edge_function_exact::probe::{self as exact, ExactEdgeAt};
use rasterproof_core::raster::scanline::steps::walked_rows;
use rasterproof_core::raster::scanline_exact::probe::crossings_at;
use rasterproof_core::triangle::FreeCorners;
use rasterproof_registry::engines::Engine;
use rasterproof_verify::cases::Triangle;

/// Asks how a pixel of a picture came to be covered, or not.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Look {
    picture: Picture,
    px: [i32; 2],
}

impl Look {
    /// For each triangle its `edges` at the pixel, none where it has no area, whether the pixel is `covered`, and the walks along the
    /// row: `rows` and `values` on the lattice, `crossings` off it.
    pub fn answer(&self) -> Result<Value, NoAnswer> {
        let window = self.picture.window()?;
        let [x_px, y_px] = self.px;
        if !window.contains(x_px, y_px) {
            return Err(format!("pixel {x_px}, {y_px} lies outside the window").into());
        }
        let mut triangles = Vec::new();
        if self.picture.snap {
            for triangle in &self.picture.on_lattice()? {
                triangles.push(look(triangle, window, x_px, y_px));
            }
        } else {
            for corners in &self.picture.as_given()? {
                triangles.push(look_as_given(corners, x_px, y_px));
            }
        }
        Ok(json!({ "px": self.px, "triangles": triangles }))
    }
}

/// The three edges, the walks of all rows in the window, and the values where the pixel is covered.
fn look(triangle: &Triangle, window: PixelRect, x_px: i32, y_px: i32) -> Value {
    let corners = triangle.corners();
    let edges = edges_at(&corners, x_px, y_px);
    // Each engine draws the window that is this pixel.
    let pixel = PixelRect { x0: x_px, x1: x_px + 1, ..row_of(window, y_px) };
    let (mut values, mut is_hit) = (Vec::new(), false);
    for engine in [Engine::Scanline, Engine::EdgeFunction, Engine::Oracle] {
        let mut of_engine = None;
        engine.fragments(triangle, pixel, |f| {
            of_engine = Some([f.depth, f.varying.x, f.varying.y]);
        });
        is_hit |= of_engine.is_some();
        values.push(json!({ "by": engine.name(), "values": of_engine }));
    }
    json!({
        "edges": edges.map(shown_edges), "covered": edges.is_some() && is_hit, "values": values,
        "rows": walked_rows(corners, window),
    })
}

/// The edges for the page; a weight is the share of an edge value in twice the area.
fn shown_edges(edges: [EdgeAt; 3]) -> [Value; 3] {
    // The three edge values add up to twice the area wherever the sample is.
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
}

/// The same for corners that are not snapped: what floats compute, how far that may be off, and what
/// is decided exactly.
fn look_as_given(corners: &FreeCorners, x_px: i32, y_px: i32) -> Value {
    let edges = exact::edges_at(corners, x_px, y_px);
    let mut covered = edges.is_some();
    for edge in edges.iter().flatten() {
        // On an edge a sample belongs to the triangle if the edge is a top or left one.
        covered &= edge.side.is_gt() || edge.side.is_eq() && edge.is_top_left;
    }
    json!({
        "edges": edges.map(|edges| edges.map(shown_exact_edge)), "covered": covered,
        "crossings": crossings_at(corners, y_px),
    })
}

/// An edge for the page, with what its floats may be off by.
fn shown_exact_edge(edge: ExactEdgeAt) -> Value {
    json!({
        "ends": edge.ends,
        "value": format!("{:.3e}", edge.estimate),
        "bound": edge.bound,
        // Beyond the bound the float's sign is right, and nothing is computed exactly.
        "byFilter": edge.estimate.abs() > edge.bound,
        "sign": edge.side as i8,
        "topLeft": edge.is_top_left,
    })
}
