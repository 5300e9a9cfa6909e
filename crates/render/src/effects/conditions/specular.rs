//! Specular light: the highlight in each fragment.
//!
//! Left out where the material has none, and for a piece whose normals are all too far from the one that
//! is halfway between light and eye ([`Highlight::is_dark_between`]): the highlight rounds to 0 in every
//! channel there, and a colour to which 0 is added keeps its bits.
//!
//! [`Highlight::is_dark_between`]: crate::pipeline::highlight::Highlight::is_dark_between

use super::account::Account;
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

pub fn may_show(item: &Prepared<'_>, piece: &Piece) -> bool {
    let normals = piece.vertices.map_array(|vertex| Surface::from(vertex.varying).normal);
    !item.highlight.is_dark_between(normals)
}

/// Nothing of a material without highlights, unless the user switches them on or off everywhere.
pub fn explain(account: &Account<'_>) -> Option<Decision> {
    let Account { scene, item, .. } = *account;
    let has_colour = item.material.specular.colour.max_element() > 0.0;
    let asked = account.effects.mode(Effect::Specular);
    let is_on = mode(scene, item, account.carries, account.effects) == Mode::Always;
    if !is_shiny(scene, item) {
        let reason = match item.material.shading {
            _ if !has_colour => "the material has no highlights",
            Shading::Gouraud => "Gouraud: the light of the corners has no highlights",
            Shading::Unlit => "the material is unlit",
            _ => "no highlight is bright enough for one step of 255",
        };
        let is_told = has_colour || !asked.is_open();
        return is_told.then(|| account.decide_all(Effect::Specular, is_on, reason));
    }
    if asked == Mode::Material {
        let reason = "what the material's shader computes";
        return Some(account.decide_all(Effect::Specular, is_on, reason));
    }
    Some(account.decide_each(
        Effect::Specular,
        "where normals are near enough to the highlight",
        [
            "no normal is near enough to the highlight",
            "every piece may have a highlight",
            "some pieces may have a highlight",
        ],
    ))
}
