//! What a file contains, in its own right-handed coordinates, before it becomes items of a scene.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3};
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::Opacity;
use rasterproof_render::pipeline::texture::Texture;

/// What a reader counts of faces with fewer than three corners, which show nothing.
pub(crate) const INCOMPLETE_FACE: &str = "incomplete face";

/// Everything a reader found in a file.
#[derive(Debug, Default)]
pub(crate) struct Contents {
    /// Its meshes, in the file's order.
    pub parts: Vec<Part>,
    /// Its materials, which parts name by their index.
    pub materials: Vec<Surface>,
    /// What the file contains and nobody draws, in the singular, with its count. A key that ends in `of material` counts
    /// materials: (`specular colour of material`, 18) and (`bump map`, 1) are shown as
    /// `specular colour of 18 materials, 1 bump map`.
    pub not_drawn: BTreeMap<String, u64>,
    /// What is missing or cannot be understood and was done without, one line each.
    pub warnings: Vec<String>,
}

/// Polygons of one material. The lists of vectors are those of the file.
#[derive(Debug, Default)]
pub(crate) struct Part {
    /// The name of the object, group or node; empty without one.
    pub name: String,
    /// The index of its material.
    pub material: Option<usize>,
    /// From the part's coordinates to those of the file.
    pub to_file: DMat4,
    pub positions: Vec<DVec3>,
    /// Normals of any length.
    pub normals: Vec<DVec3>,
    /// Texture coordinates, v up.
    pub uvs: Vec<DVec2>,
    /// A colour for each position, each channel in [0, 1], or none at all.
    pub colours: Vec<DVec3>,
    /// The corners of all polygons, one polygon after the other.
    pub corners: Vec<PolygonCorner>,
    pub polygons: Vec<Polygon>,
}

/// Indices into the lists of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct PolygonCorner {
    pub position: u32,
    pub normal: Option<u32>,
    pub uv: Option<u32>,
}

/// A polygon of three corners or more, counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Polygon {
    /// Where its corners end in the list of the part; they begin where those of the one before end.
    pub end: u32,
    /// The line of the file, from 1; 0 where the file has no lines.
    pub line: u32,
    /// Polygons of the same number above 0 share the normals that are computed for corners without one (`s` of an
    /// OBJ). With 0 such corners get the normal of the polygon.
    pub smoothing: u32,
}

/// What a file says about a surface, as far as it is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub name: String,
    /// Diffuse colour, each channel in [0, 1].
    pub colour: DVec3,
    pub texture: Option<Arc<Texture>>,
    pub specular: Specular,
    pub opacity: Option<Opacity>,
    /// Whether the file says that light has no effect on it.
    pub unlit: bool,
    /// Whether both sides are drawn.
    pub both_sides: bool,
}
