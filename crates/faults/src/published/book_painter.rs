//! Specimen: the painter's algorithm (the book, part 2, chapter 6, section 6.1, which shows that it
//! fails): whole triangles, the farthest first.
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptom: three triangles that overlap in a ring have no order; whichever is drawn last covers a neighbour
//! that lies before it.

use glam::DVec2;

use super::scene::{COLOURS, Image, SIDE, Setting, Version, empty, fill, fragments};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Frame;
use rasterproof_core::geometry::sorted;

/// Three blades, each turned by a third of a circle; each starts near, broad, and ends far under
/// the next one, or lies flat at a depth of its own.
fn blades(setting: Setting) -> [[(DVec2, f64); 3]; 3] {
    // The cosine and the sine of 120 degrees.
    let third = DVec2::new(-0.5, 0.866_025_403_784_438_6);
    let blade = [DVec2::new(-15.0, 2.0), DVec2::new(-7.0, 14.0), DVec2::new(14.0, -1.0)];
    let turned = blade.map_array(|p| third.rotate(p));
    let blades = [blade, turned, turned.map_array(|p| third.rotate(p))];
    [0, 1, 2].map_array(|i| {
        let depths = match setting {
            Setting::Exposing => [0.2, 0.2, 0.8],
            Setting::Harmless => [0.2 + 0.3 * i as f64; 3],
        };
        let middle = DVec2::splat(f64::from(SIDE) / 2.0);
        [0, 1, 2].map_array(|k| (blades[i][k] + middle, depths[k]))
    })
}

/// The blades by the published order, or by the depth of each pixel.
pub fn draw(version: Version, setting: Setting) -> Image {
    let blades = blades(setting);
    let mut image = empty(SIDE);
    if version == Version::Published {
        // A sum orders them as their mean would.
        let depths = blades.map_array(|[(_, a), (_, b), (_, c)]| a + b + c);
        for i in sorted([0, 1, 2], |&a, &b| depths[a] < depths[b]) {
            fill(&mut image, &blades[i].map_array(|(corner, _)| corner), COLOURS[i]);
        }
        return image;
    }
    let mut nearest = Frame::new(image.bounds(), f64::INFINITY);
    for (blade, colour) in blades.iter().zip(COLOURS) {
        let corners = blade.map_array(|(corner, depth)| (corner, 1.0, DVec2::splat(depth)));
        fragments(corners, image.bounds(), &mut |f| {
            let depth = &mut nearest.span_mut(f.y_px, f.x_px, f.x_px + 1)[0];
            if f.depth < *depth {
                *depth = f.depth;
                image.span_mut(f.y_px, f.x_px, f.x_px + 1)[0] = colour;
            }
        });
    }
    image
}
