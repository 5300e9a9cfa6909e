//! Specimen: the turns of the book (part 3, chapter 10, section 10.4) and RotateX of its companion code.
//! Source: the book (yangzhenzhuozz/Renderer on GitHub) and its companion code; see `docs/sources.md`.
//!
//! Symptom: R_z turns x towards y, yet R_x turns z towards y and R_y x towards z, so the three belong to no one
//! convention, whichever hand the axes have. The companion code's RotateX writes the cosine and then the sine
//! into `[1][1]` and leaves `[1][2]` at 0: a turn by nothing flattens what it turns.

use std::f64::consts::FRAC_PI_6;

use glam::{DVec2, DVec3};

use super::scene::{COLOURS, Image, SIDE, Setting, Version, WHITE, empty, fill};
use rasterproof_core::angle::sin_cos;

/// A turn about an axis, as one of the two sources has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    X,
    Y,
    Z,
    /// RotateX of the companion code.
    CodeX,
}

/// The point after the published turn.
pub fn published(turn: Turn, angle_rad: f64, p: DVec3) -> DVec3 {
    let (s, c) = sin_cos(angle_rad);
    match turn {
        Turn::X => DVec3::new(p.x, c * p.y + s * p.z, -s * p.y + c * p.z),
        Turn::Y => DVec3::new(c * p.x - s * p.z, p.y, s * p.x + c * p.z),
        Turn::Z => DVec3::new(c * p.x - s * p.y, s * p.x + c * p.y, p.z),
        Turn::CodeX => DVec3::new(p.x, s * p.y, -s * p.y + c * p.z),
    }
}

/// The same in one cycle: the transposes of the first two.
pub fn repaired(turn: Turn, angle_rad: f64, p: DVec3) -> DVec3 {
    match turn {
        Turn::X | Turn::CodeX => published(Turn::X, -angle_rad, p),
        Turn::Y => published(Turn::Y, -angle_rad, p),
        Turn::Z => published(Turn::Z, angle_rad, p),
    }
}

/// A square in each quarter of the picture, in perspective: about x and y, about z, and about x by
/// the code; or the one about z alone.
pub fn draw(version: Version, setting: Setting) -> Image {
    let mut image = empty(SIDE);
    let quarter = f64::from(SIDE) / 4.0;
    let all = [Turn::X, Turn::Y, Turn::Z, Turn::CodeX];
    for (i, turn) in all.into_iter().enumerate() {
        if setting == Setting::Harmless && turn != Turn::Z {
            continue;
        }
        let centre = quarter * DVec2::new((1 + 2 * (i % 2)) as f64, (1 + 2 * (i / 2)) as f64);
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
            let apply = if version == Version::Published { published } else { repaired };
            let p = apply(turn, FRAC_PI_6, DVec3::new(x, y, 0.0));
            // The eye stands 2.2 before the square and looks along z; rows run down.
            centre + DVec2::new(p.x, -p.y) / (p.z + 2.2) * quarter * 1.3
        });
        fill(&mut image, &corners, [COLOURS[0], COLOURS[1], WHITE, COLOURS[2]][i]);
    }
    image
}
