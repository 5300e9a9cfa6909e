//! Specular light: the highlight in each fragment.
//!
//! Left out where the material has none, and for a piece whose normals are all too far from the one that
//! is halfway between light and eye ([`Highlight::is_dark_between`]): the highlight rounds to 0 in every
//! channel there, and a colour to which 0 is added keeps its bits.
//!
//! [`Highlight::is_dark_between`]: crate::pipeline::highlight::Highlight::is_dark_between

use super::account::Condition;
use crate::effects::Effect;
use crate::effects::plan::Attributes;
use crate::effects::primitive::{Piece, Prepared, highlight, is_lit, surfaces};
use crate::scene::{Item, Scene, Shading};
use rasterproof_core::arrays::MapArray as _;

/// Without normals there is no highlight.
pub const CONDITION: Condition = Condition {
    effect: Effect::Specular,
    needs: 0,
    is_possible: |asked| asked.carries.has(Attributes::NORMAL),
    is_asked_for: |asked| is_shiny(asked.scene, asked.item),
    missing: |asked| {
        let has_colour = asked.item.material.specular.colour.max_element() > 0.0;
        let reason = match asked.item.material.shading {
            _ if !has_colour => "the material has no highlights",
            Shading::Gouraud => "Gouraud: the light of the corners has no highlights",
            Shading::Unlit => "the material is unlit",
            _ => "no highlight is bright enough for one step of 255",
        };
        Some((reason, has_colour))
    },
    by_material: "what the material's shader computes",
    open: "where normals are near enough to the highlight",
    reasons: |_| {
        [
            "no normal is near enough to the highlight",
            "every piece may have a highlight",
            "some pieces may have a highlight",
        ]
    },
};

fn is_shiny(scene: &Scene, item: &Item) -> bool {
    is_lit(scene, item) && !highlight(scene, item).is_dark()
}

pub fn may_show(item: &Prepared<'_>, piece: &Piece) -> bool {
    let normals = surfaces(piece).map_array(|of| of.normal);
    !item.highlight.is_dark_between(normals)
}
