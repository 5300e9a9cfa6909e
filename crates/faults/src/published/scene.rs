//! What the specimens that are no rasterizer draw: small pictures, published and repaired.
//!
//! Their fault lies before or after the coverage (clip, viewport, depth, averaging), so coverage is
//! the edge-function engine's in both versions and the pictures differ by the fault alone.

use glam::{DVec2, DVec4};

use super::{ClipVertex, Published, RealTriangle, RealVertex, bare};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::contract::{Interpolate as _, Rasterize as _};
use rasterproof_core::frame::Frame;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::triangle::{Fragment, ScreenTriangle, ScreenVertex};

pub type Colour = [u8; 3];
pub type Image = Frame<Colour>;

/// As published, or with its fault repaired and nothing else changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    Published,
    /// With the cure of its card, and otherwise the published code.
    Repaired,
}

/// Whether the picture is to show the fault, or is one in which it does not show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// What the fault needs occurs, so the versions differ.
    Exposing,
    /// What the fault needs does not occur, so both versions draw the same.
    Harmless,
}

pub const SIDE: u32 = 32;
pub const BLACK: Colour = [0, 0, 0];
pub const WHITE: Colour = [240, 240, 240];
pub const COLOURS: [Colour; 3] = [[236, 178, 46], [70, 150, 200], [196, 88, 88]];

pub fn empty(side: u32) -> Image {
    Frame::new(PixelRect::window(side, side), BLACK)
}

fn at(position_px: DVec2) -> SubpixelPoint {
    SubpixelPoint::from_px(position_px.x, position_px.y).expect("scenes stay in the domain")
}

/// Fills a convex polygon as a fan around its first corner, by this project's engine.
pub fn fill(image: &mut Image, corners_px: &[DVec2], colour: Colour) {
    for pair in corners_px.get(1..).unwrap_or_default().windows(2) {
        EdgeFunction.cover([at(corners_px[0]), at(pair[0]), at(pair[1])], image.bounds(), |span| {
            image.span_mut(span.y_px, span.x0_px, span.x1_px).fill(colour);
        });
    }
}

/// A triangle's fragments by a published rasterizer, or by the edge-function engine.
pub fn either(
    specimen: &impl Published,
    version: Version,
    triangle: &RealTriangle,
    bounds: PixelRect,
    emit: &mut dyn FnMut(Fragment<DVec2>),
) {
    match version {
        // What is refused stays empty.
        Version::Published => drop(specimen.fragments(triangle, bounds, emit)),
        Version::Repaired => {
            let vertices = triangle.map_array(|v| ScreenVertex {
                position: at(v.position_px),
                depth: v.depth,
                inv_w: 1.0 / v.w,
                varying: v.varying,
            });
            EdgeFunction.fragments(&ScreenTriangle { vertices }, bounds, emit);
        }
    }
}

/// Triangles with a chessboard of 6 x 6 over their varying.
pub fn chequered(specimen: &impl Published, version: Version, triangles: &[RealTriangle]) -> Image {
    let mut image = empty(SIDE);
    for triangle in triangles {
        either(specimen, version, triangle, image.bounds(), &mut |f| {
            let square = (f.varying * 6.0).floor();
            let is_dark = (square.x + square.y).rem_euclid(2.0) == 0.0;
            let colour = if is_dark { COLOURS[1] } else { WHITE };
            image.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = colour;
        });
    }
    image
}

/// A floor from w = 1 at the lower border to `far` at the upper, no sample on any edge: the corners
/// with (x, y) as their varying and y from -1 to 1 as their depth.
pub fn floor_triangles(far: f64) -> [RealTriangle; 2] {
    let corner = |x_px: f64, y_px: f64, x: f64, y: f64| RealVertex {
        position_px: DVec2::new(x_px, y_px),
        depth: 2.0 * y - 1.0,
        w: 1.0 + y * (far - 1.0),
        varying: DVec2::new(x, y),
    };
    let quad = [
        corner(0.75, 31.25, 0.0, 0.0),
        corner(31.25, 31.25, 1.0, 0.0),
        corner(28.25, 0.75, 1.0, 1.0),
        corner(3.75, 0.75, 0.0, 1.0),
    ];
    [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]
}

pub fn floor(specimen: &impl Published, version: Version, far: f64) -> Image {
    chequered(specimen, version, &floor_triangles(far))
}

/// A triangle of one value with an upright left side on samples, no other edge on one, that leaves
/// the screen below: what the book's fill gets right.
pub fn runs_out_below() -> RealTriangle {
    let below = f64::from(SIDE) + 2.5;
    bare([[2.5, below], [9.75, below], [2.5, below - 12.5]])
}

/// Emits the fragments of a triangle of (position, w, value); the depth is the first attribute,
/// linear in the window.
pub fn fragments(
    corners: [(DVec2, f64, DVec2); 3],
    bounds: PixelRect,
    emit: &mut dyn FnMut(Fragment<DVec2>),
) {
    let vertices = corners.map_array(|(position_px, w, varying)| ScreenVertex {
        position: at(position_px),
        depth: varying.x,
        inv_w: 1.0 / w,
        varying,
    });
    EdgeFunction.fragments(&ScreenTriangle { vertices }, bounds, emit);
}

/// A corner in clip space with its distance w, x and y given after the division.
pub fn clip_vertex(x_ndc: f64, y_ndc: f64, z_ndc: f64, w: f64) -> ClipVertex {
    let position = DVec4::new(x_ndc * w, y_ndc * w, z_ndc * w, w);
    ClipVertex { position, varying: DVec2::ZERO }
}

/// Fills a clipped polygon on a screen of `SIDE` pixels; a corner that is not a number draws nothing.
pub fn fill_clipped(image: &mut Image, polygon: &[ClipVertex], colour: Colour) {
    let side = f64::from(image.bounds().width());
    let mut on_screen = Vec::with_capacity(polygon.len());
    for v in polygon {
        let ndc = v.position.truncate().truncate() / v.position.w;
        on_screen.push(DVec2::new((ndc.x + 1.0) / 2.0 * side, (1.0 - ndc.y) / 2.0 * side));
    }
    for pair in on_screen.get(1..).unwrap_or_default().windows(2) {
        let triangle = [on_screen[0], pair[0], pair[1]];
        if triangle.iter().all(|p| p.is_finite() && p.abs().max_element() < 8e6) {
            fill(image, &triangle, colour);
        }
    }
}

/// Keeps what lies on the positive side of a function that is linear in clip space; a corner on the
/// border is inside, and only an edge whose ends differ is cut. The cure of every clip here.
pub fn clip_by_sign(polygon: &[ClipVertex], place: impl Fn(DVec4) -> f64) -> Vec<ClipVertex> {
    let mut kept = Vec::new();
    for (i, a) in polygon.iter().enumerate() {
        let b = &polygon[(i + 1) % polygon.len()];
        let (from, to) = (place(a.position), place(b.position));
        if from >= 0.0 {
            kept.push(*a);
        }
        if (from >= 0.0) != (to >= 0.0) {
            kept.push(a.towards(b, from / (from - to)));
        }
    }
    kept
}
