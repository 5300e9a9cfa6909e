//! euc: `Pipeline::draw` with the `Triangles` rasterizer, culling disabled, and with `Lines`. The target sees
//! every write, so that double hits and the order of pixels show.

use euc::rasterizer::{BackfaceCullingDisabled, Lines, Triangles};
use euc::{DepthStrategy, Pipeline, Target};

use crate::protocol::{Library, SetPixel};

pub const LIBRARY: Library = Library {
    name: "euc-0.5.3",
    declares: "batch=64",
    grid: 256.0,
    range: f64::INFINITY,
    inside: false,
    triangle,
    line: Some(line),
    longest_line: 1 << 20,
};

struct White;

impl Pipeline for White {
    type Vertex = [f32; 2];
    type VsOut = ();
    type Pixel = ();

    fn vert(&self, &[x, y]: &[f32; 2]) -> ([f32; 4], ()) {
        ([x, y, 0.0, 1.0], ())
    }

    fn frag(&self, (): &()) {}

    fn get_depth_strategy(&self) -> DepthStrategy {
        DepthStrategy::None
    }
}

struct Window<'a> {
    size: [usize; 2],
    set_pixel: SetPixel<'a>,
}

impl Target for Window<'_> {
    type Item = ();

    fn size(&self) -> [usize; 2] {
        self.size
    }

    unsafe fn set(&mut self, [x, y]: [usize; 2], (): ()) {
        (self.set_pixel)(x as i32, y as i32);
    }

    unsafe fn get(&self, _: [usize; 2]) {}

    fn clear(&mut self, (): ()) {}
}

/// Pixels to the cube from -1 to 1, y up.
fn vertices(points: &[(f64, f64)], width: i32, height: i32) -> Vec<[f32; 2]> {
    let vertex = |&(x, y): &(f64, f64)| {
        [(x / f64::from(width) * 2.0 - 1.0) as f32, (1.0 - y / f64::from(height) * 2.0) as f32]
    };
    points.iter().map(vertex).collect()
}

fn triangle(corners: [(f64, f64); 3], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let mut window = Window { size: [width as usize, height as usize], set_pixel };
    let vertices = vertices(&corners, width, height);
    White.draw::<Triangles<(f32,), BackfaceCullingDisabled>, _>(&vertices, &mut window, None);
}

fn line(ends: [(i32, i32); 2], width: i32, height: i32, set_pixel: SetPixel<'_>) {
    let mut window = Window { size: [width as usize, height as usize], set_pixel };
    let centres = ends.map(|(x, y)| (f64::from(x) + 0.5, f64::from(y) + 0.5));
    White.draw::<Lines<(f32,)>, _>(&vertices(&centres, width, height), &mut window, None);
}
