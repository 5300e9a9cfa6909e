//! Specular light: the highlight in each fragment.
//!
//! Left out where the material has none, and for a piece whose normals are all too far from the one that
//! is halfway between light and eye ([`Highlight::is_dark_between`]): the highlight rounds to 0 in every
//! channel there, and a colour to which 0 is added keeps its bits.
//!
//! [`Highlight::is_dark_between`]: crate::pipeline::highlight::Highlight::is_dark_between

use super::survey::Survey;
use crate::effects::plan::{Attributes, Decision};
use crate::effects::primitive::{Piece, Prepared, highlight, is_lit};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::shade::Surface;
use crate::scene::{Item, Scene, Shading};
use rasterproof_core::arrays::MapArray as _;

/// What an item asks for; without normals nothing.
pub fn mode(scene: &Scene, item: &Item, carries: Attributes, effects: &Effects) -> Mode {
    let mode = effects.mode(Effect::Specular);
    match mode {
        _ if !carries.has(Attributes::NORMAL) => Mode::Never,
        Mode::Planned | Mode::Material if !is_shiny(scene, item) => Mode::Never,
        Mode::Planned | Mode::Never => mode,
        Mode::Material | Mode::Always => Mode::Always,
    }
}

fn is_shiny(scene: &Scene, item: &Item) -> bool {
    is_lit(scene, item) && !highlight(scene, item).is_dark()
}

#[inline]
pub fn pays(mode: Mode, item: &Prepared<'_>, piece: &Piece) -> bool {
    match mode {
        Mode::Planned | Mode::Material => {
            let normals = piece.vertices.map_array(|vertex| Surface::from(vertex.varying).normal);
            !item.highlight.is_dark_between(normals)
        }
        Mode::Always => true,
        Mode::Never => false,
    }
}

/// Nothing of a material without highlights, unless the user switches them on or off everywhere.
pub fn explain(survey: &Survey<'_>) -> Option<Decision> {
    let Survey { scene, item, pieces, specular, .. } = *survey;
    let has_colour = item.material.specular.colour.max_element() > 0.0;
    let is_asked = !matches!(survey.effects.mode(Effect::Specular), Mode::Planned | Mode::Material);
    let is_on = mode(scene, item, survey.carries, survey.effects) == Mode::Always;
    let (on, reason) = if !is_shiny(scene, item) {
        if !has_colour && !is_asked {
            return None;
        }
        let reason = match item.material.shading {
            _ if !has_colour => "the material has no highlights",
            Shading::Gouraud => "Gouraud: the light of the corners has no highlights",
            Shading::Unlit => "the material is unlit",
            _ => "no highlight is bright enough for one step of 255",
        };
        (if is_on { pieces } else { 0 }, reason)
    } else if survey.effects.mode(Effect::Specular) == Mode::Material {
        (if is_on { pieces } else { 0 }, "what the material's shader computes")
    } else if !survey.is_listed {
        let reason = "where normals are near enough to the highlight";
        return Some(survey.leave_open(Effect::Specular, reason));
    } else {
        let reason = match specular {
            0 => "no normal is near enough to the highlight",
            _ if specular == pieces => "every piece may have a highlight",
            _ => "some pieces may have a highlight",
        };
        (specular, reason)
    };
    Some(survey.decide(Effect::Specular, on, reason))
}
