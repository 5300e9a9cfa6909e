//! What exercises ask: coverage of the oracle and of the published algorithms, values of an engine.

use std::cell::RefCell;

use glam::{DVec2, DVec3};

use rasterproof_core::contract::{Interpolate as _, Rasterize};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::{PixelRect, SubpixelPoint};
use rasterproof_core::raster::edge_function::EdgeFunction;
use rasterproof_core::triangle::{Corners, Fragment, ScreenTriangle, ScreenVertex};
use rasterproof_faults::published::{Published, bare};
use rasterproof_render::pipeline::draw::Renderer;
use rasterproof_render::pipeline::target::{Antialias, Target, to_colour};
use rasterproof_render::pipeline::{ClipVertex, Counters};
use rasterproof_verify::oracle::Oracle;

/// The corners of a triangle, in pixels.
pub type Px = [[f64; 2]; 3];

pub fn corners(triangle: Px) -> Corners {
    triangle.map(|[x, y]| SubpixelPoint::from_px(x, y).expect("exercises stay in the domain"))
}

/// How often a rasterizer hits each pixel of a window.
pub fn covered(engine: &impl Rasterize, triangles: &[Corners], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for &corners in triangles {
        engine.cover(corners, window, |span| hits.hit(span.y_px, span.x0_px, span.x1_px));
    }
    hits
}

pub fn truth(triangles: &[Px], window: PixelRect) -> Coverage {
    let triangles: Vec<_> = triangles.iter().map(|&px| corners(px)).collect();
    covered(&Oracle, &triangles, window)
}

/// What a published algorithm covers; what it refuses stays empty.
pub fn published(specimen: &dyn Published, triangles: &[Px], window: PixelRect) -> Coverage {
    let mut hits = Coverage::new(window, 0);
    for &triangle in triangles {
        let _ = specimen.cover(&bare(triangle), window, &mut |span| {
            hits.hit(span.y_px, span.x0_px, span.x1_px);
        });
    }
    hits
}

pub fn hits(coverage: &Coverage, [x, y]: [i32; 2]) -> u8 {
    coverage.get(x, y).expect("exercises ask of pixels of their window")
}

/// The fragments of a triangle of (x, y, w, value); depth is the value, linear in the window.
pub fn fragments(triangle: [[f64; 4]; 3], window: PixelRect) -> Vec<Fragment<f64>> {
    let vertices = triangle.map(|[x, y, w, value]| {
        ScreenVertex::new(x, y, value, w, value).expect("exercises stay in the domain")
    });
    let mut list = Vec::new();
    EdgeFunction.fragments(&ScreenTriangle { vertices }, window, |f| list.push(f));
    list
}

/// The fragment at one pixel; see [`fragments`].
pub fn fragment(triangle: [[f64; 4]; 3], window: PixelRect, pixel: [i32; 2]) -> Fragment<f64> {
    let all = fragments(triangle, window);
    all.into_iter().find(|f| [f.x_px, f.y_px] == pixel).expect("exercises ask of covered pixels")
}

/// Draws triangles of positions in clip space, where w is 1, through the whole pipeline into a square
/// window: what it cost, and where in pixels the fragment stage ran.
pub fn draw(
    positions: &[DVec3],
    triangles: &[[u32; 3]],
    side: u32,
    antialias: Antialias,
) -> (Counters, Vec<DVec2>) {
    let target =
        Target::new(side, side, antialias, Default::default()).expect("exercises are small");
    let mut renderer = Renderer::new(EdgeFunction, target);
    // Each vertex has its place in the window as attribute, so that the fragment stage knows where it is.
    let half = f64::from(side) / 2.0;
    let vertex = |p: &DVec3| ClipVertex {
        position: p.extend(1.0),
        varying: DVec2::new(1.0 + p.x, 1.0 - p.y) * half,
    };
    let places = RefCell::new(Vec::new());
    let fragment = |place: &DVec2| {
        places.borrow_mut().push(*place);
        to_colour(DVec3::ONE)
    };
    // The whole pipeline, as a scene goes through it.
    let drawn = renderer.draw(positions, triangles, vertex, fragment);
    assert_eq!(drawn, Ok(()), "exercises name vertices that are there");
    (renderer.counters, places.into_inner())
}
