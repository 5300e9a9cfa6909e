//! Chapter 11: light, texture, models.

use glam::{DVec2, DVec3};

use super::{Solution, Text};
use rasterproof_render::pipeline::shade::Light;
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};

solvers!(away, short, beyond, between);

const LIGHT: Light = Light { towards: DVec3::Z, ambient: 0.2, diffuse: 0.8 };

/// A surface that faces away has the ambient light, and less than that without the bound at 0.
fn away(_: &[Text]) -> Solution {
    let value = LIGHT.intensity(DVec3::NEG_Z);
    let without = LIGHT.ambient + LIGHT.diffuse * DVec3::NEG_Z.dot(LIGHT.towards);
    Solution::number(value, 1).figure(format!("{without:.1}"))
}

/// By how many percent the light is too weak where an interpolated normal is not made long again.
fn short(_: &[Text]) -> Solution {
    let normal = (DVec3::X + DVec3::Z) / 2.0;
    let light = Light { ambient: 0.0, diffuse: 1.0, ..LIGHT };
    // What the dot product alone says, over what it should be.
    let share = normal.dot(light.towards) / light.intensity(normal);
    let value = 100.0 * (1.0 - share);
    Solution::number(value.round(), 0).figure(format!("{:.3}", normal.length()))
}

/// A black and a white texel side by side.
fn two_texels() -> Texture {
    Texture::new(2, 1, &[[0; 3], [255; 3]]).expect("two texels")
}

/// What a repeating texture shows beyond its right border.
fn beyond(_: &[Text]) -> Solution {
    let red = |u| two_texels().with(Filter::Nearest, Wrap::Repeat).at(DVec2::new(u, 0.5)).x;
    Solution::choice(&[red(1.1) == 0.0, red(1.1) == 1.0])
}

/// The mixture at the border of two texels, and at their middles.
fn between(_: &[Text]) -> Solution {
    let smooth = two_texels().with(Filter::Bilinear, Wrap::Clamp);
    let at = |u| smooth.at(DVec2::new(u, 0.5)).x;
    Solution::number(at(0.5), 1).figure(at(0.25)).figure(at(0.75))
}
