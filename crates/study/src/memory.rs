//! The memory of a choice, from the sizes of what it holds at its peak. The scene and its textures are not in it: all
//! choices read them.

use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::{Corners, ScreenTriangle};
use rasterproof_render::effects::plan::{PiecePlan, Pieces, Samples};
use rasterproof_render::effects::render::Rendered;
use rasterproof_render::pipeline::assemble::ClipPoint;
use rasterproof_render::pipeline::depth::DepthFormat;
use rasterproof_render::pipeline::shade::{Attributes, PLACED};
use rasterproof_render::pipeline::target::{Antialias, Colour, Target};
use rasterproof_render::scene::Scene;

fn pixels(window: PixelRect) -> u64 {
    u64::from(window.width()) * u64::from(window.height())
}

/// A choice of coverage: a colour of 32 bits for each sample; one that takes a list holds the snapped corners too.
pub fn coverage(name: &str, window: PixelRect, triangles: u64) -> u64 {
    let list = if name.starts_with("tiles") { size_of::<Corners>() as u64 * triangles } else { 0 };
    size_of::<u32>() as u64 * pixels(window) + list
}

/// A choice of interpolation: a value of 32 bits for each pixel.
pub fn interpolation(window: PixelRect) -> u64 {
    size_of::<f32>() as u64 * pixels(window)
}

/// A choice of antialiasing: the share of each pixel in 64 bits, and a byte for each sample; exact areas have no samples.
pub fn antialiasing(name: &str, window: PixelRect) -> Option<u64> {
    let samples = match name {
        "1x" => 1,
        "4x multisample" | "2x2 supersample" => 4,
        "4x4 supersample" => 16,
        "8x8 supersample" => 64,
        "exact area" => 0,
        _ => return None,
    };
    Some((size_of::<f64>() as u64 + samples) * pixels(window))
}

/// A format of the depth buffer: a depth as the format has it, and the number of a piece, for each sample.
pub fn depth(format: DepthFormat, window: PixelRect, planes: usize) -> u64 {
    let of_depth = match format {
        DepthFormat::F64 => size_of::<f64>(),
        DepthFormat::Unorm32
        | DepthFormat::Unorm24
        | DepthFormat::F32
        | DepthFormat::F32Reversed => size_of::<u32>(),
    };
    (of_depth + size_of::<u32>()) as u64 * planes as u64 * pixels(window)
}

/// A frame: colour and key of each sample, the picture and a copy of it where there is a second buffer, what is noted
/// for each pixel while samples are told apart, positions in clip space, and pieces where all of them are listed.
pub fn frame(rendered: &Rendered, scene: &Scene, target: &Target) -> u64 {
    let plan = &rendered.plan;
    let of_colour = size_of::<Colour>();
    let (size, antialias) = (target.size(), target.antialias());
    let samples = match plan.frame.samples {
        Samples::Middle => 1,
        Samples::Each | Samples::OnDemand { .. } => antialias.samples(),
    };
    let pictures = if plan.frame.second_buffer { 2 } else { 1 };
    let shading = match antialias {
        Antialias::Multisample4 => size_of::<(u64, Colour)>() + size_of::<u8>(),
        Antialias::None | Antialias::Supersample(_) => 0,
    };
    let on_demand = match plan.frame.samples {
        Samples::OnDemand { .. } => of_colour + size_of::<[u64; 2]>(),
        Samples::Each | Samples::Middle => 0,
    };
    let of_pixel = samples as usize * (of_colour + size_of::<u64>())
        + pictures * of_colour
        + shading
        + on_demand;
    let positions: usize = scene.items.iter().map(|item| item.mesh.positions.len()).sum();
    let is_listed = plan.items.iter().any(|item| matches!(item.pieces, Pieces::Listed(_)));
    let listed = if is_listed { scene.triangles() } else { 0 };
    let of_piece =
        size_of::<(usize, ScreenTriangle<Attributes<PLACED>>)>() + size_of::<PiecePlan>();
    let scene = positions * size_of::<ClipPoint>() + listed * of_piece;
    of_pixel as u64 * pixels(size) + scene as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: PixelRect = PixelRect { x0: 0, y0: 0, x1: 10, y1: 10 };

    #[test]
    fn sizes_by_hand() {
        assert_eq!(coverage("robust", WINDOW, 7), 400);
        assert_eq!(coverage("tiles i32 x 16", WINDOW, 7), 400 + 7 * 24);
        assert_eq!(interpolation(WINDOW), 400);
        assert_eq!(antialiasing("4x4 supersample", WINDOW), Some(2400));
        assert_eq!(antialiasing("exact area", WINDOW), Some(800));
        assert_eq!(antialiasing("another", WINDOW), None);
        assert_eq!(depth(DepthFormat::F64, WINDOW, 1), 1200);
        assert_eq!(depth(DepthFormat::Unorm24, WINDOW, 4), 3200);
    }
}
