//! Textures that are made, not read.

use glam::DVec3;

use crate::pipeline::target::to_colour;
use crate::pipeline::texture::Texture;

/// A texture of `side` x `side` texels from a function of column and row, row 0 at the top.
///
/// # Panics
/// If `side` is 0 or exceeds the largest side; sides are constants of the callers.
#[must_use]
pub fn generate(side: u32, colour: impl Fn(u32, u32) -> DVec3) -> Texture {
    let texels: Vec<_> = (0..side * side)
        .map(|i| {
            let [r, g, b, _] = to_colour(colour(i % side, i / side));
            [r, g, b]
        })
        .collect();
    Texture::new(side, side, &texels).expect("callers ask for at least one texel")
}

/// The book's four texels (chapter 5), in colours of our own.
#[must_use]
pub fn four() -> Texture {
    let colours = [
        DVec3::new(0.85, 0.30, 0.25),
        DVec3::new(0.95, 0.75, 0.25),
        DVec3::new(0.25, 0.55, 0.80),
        DVec3::new(0.40, 0.70, 0.40),
    ];
    generate(2, |column, row| colours[(row * 2 + column) as usize])
}

/// A checkerboard of 8 x 8 fields.
#[must_use]
pub fn checkerboard() -> Texture {
    let (light, dark) = (DVec3::new(0.92, 0.90, 0.84), DVec3::new(0.22, 0.35, 0.45));
    generate(8, |column, row| if (column + row) % 2 == 0 { light } else { dark })
}

/// Boards of wood: a smooth picture for bilinear lookup.
#[must_use]
pub fn boards() -> Texture {
    let (light, dark) = (DVec3::new(0.80, 0.58, 0.36), DVec3::new(0.52, 0.33, 0.18));
    generate(64, |column, row| {
        let board = row / 16;
        // A triangle wave along the board, shifted from board to board.
        let phase = (column * 3 + board * 29 + row % 16 * 2) % 48;
        let grain = f64::from(phase.abs_diff(24)) / 24.0;
        let seam = if row % 16 == 0 || (column + board * 20) % 64 == 0 { 0.45 } else { 1.0 };
        (dark + (light - dark) * (0.35 + 0.65 * grain)) * seam
    })
}
