//! Chapter 8: the view volume and the window.

use glam::DVec4;

use super::tools::{Px, truth};
use super::{Solution, Text};
use rasterproof_core::grid::PixelRect;
use rasterproof_render::pipeline::ClipVertex;
use rasterproof_render::pipeline::assemble::Viewport;
use rasterproof_render::pipeline::clip::outcode;
use rasterproof_render::pipeline::transform::frustum;

solvers!(place, size, behind, middle);

/// The column at which a point right of the middle is placed.
fn place(_: &[Text]) -> Solution {
    let vertex = ClipVertex { position: DVec4::new(0.5, 0.0, 0.0, 1.0), varying: () };
    let placed = Viewport::new(PixelRect::window(8, 6)).place(&vertex).expect("within the window");
    Solution::number(placed.position.to_px().0, 1)
}

/// The square from -1 to 1 in a window of 4 x 3, times (size - 1), y up.
const SQUEEZED: [Px; 2] =
    [[[0.0, 3.0], [3.0, 3.0], [3.0, 1.0]], [[0.0, 3.0], [3.0, 1.0], [0.0, 1.0]]];

/// How many pixels are left of a square that should fill the window.
fn size(_: &[Text]) -> Solution {
    let window = PixelRect::window(4, 3);
    let whole = [[[0.0, 3.0], [4.0, 3.0], [4.0, 0.0]], [[0.0, 3.0], [4.0, 0.0], [0.0, 0.0]]];
    let [squeezed, right] = [truth(&SQUEEZED, window), truth(&whole, window)];
    Solution::count(squeezed.covered())
        .grid("size - 1", &squeezed, &right)
        .grid("size", &right, &right)
}

/// Whether a point behind the eye is inside: by the test before the division it is not, and after it, it would be.
fn behind(_: &[Text]) -> Solution {
    let position = DVec4::new(0.5, 0.5, 0.5, -2.0);
    let inside = outcode(&ClipVertex { position, varying: 0.0 }) == 0;
    let divided = position.truncate() / position.w;
    Solution::choice(&[inside, !inside]).figure(divided.x).figure(divided.y).figure(divided.z)
}

/// The distance whose depth is the middle of the cube, which the inverse matrix finds.
fn middle(_: &[Text]) -> Solution {
    let projection = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0).expect("it is a frustum");
    let back = projection.inverse() * DVec4::new(0.0, 0.0, 0.0, 1.0);
    Solution::number(back.z / back.w, 2)
}
