//! Colour, light, texture: what the fragment stage multiplies in, and the attribute it needs.
//!
//! Left out where the material does not use it: the factor left out is exactly 1, and the others
//! keep their order.

use super::account::{Account, ItemQuestion};
use crate::effects::plan::{Attributes, Decision};
use crate::effects::primitive::{has_places, is_lit};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::shade::Light;
use crate::scene::{Item, Scene, Shading};

/// The effects, the attributes they need, and what they are called.
const ALL: [(Effect, u8, &str); 3] = [
    (Effect::Colour, Attributes::COLOUR, "colour of the corners"),
    (Effect::Light, Attributes::NORMAL, "light and normal"),
    (Effect::Texture, Attributes::UV, "texture"),
];

fn uses(scene: &Scene, item: &Item, effect: Effect) -> bool {
    let material = &item.material;
    match effect {
        Effect::Colour => material.vertex_colours || material.shading == Shading::Gouraud,
        Effect::Light => is_lit(scene, item),
        _ => material.textures().next().is_some() || material.has_opacity_map(),
    }
}

/// The attributes that an item's pieces carry. Highlights that the user switches on everywhere need normals.
pub fn carries(scene: &Scene, item: &Item, effects: &Effects) -> Attributes {
    let has_highlights = effects.mode(Effect::Specular) == Mode::Always;
    let paid = |(effect, _, _): &(Effect, u8, &str)| {
        let called_for = uses(scene, item, *effect);
        effects.pays(*effect, called_for || *effect == Effect::Light && has_highlights)
    };
    let bits = ALL.into_iter().filter(paid).fold(0, |bits, (_, bit, _)| bits | bit);
    let asked = ItemQuestion { scene, item, carries: Attributes(bits), effects };
    let in_use = super::ALL.iter().filter(|condition| condition.mode(&asked) != Mode::Never);
    let mut needed = in_use.fold(bits, |bits, condition| bits | condition.needs);
    if bits & Attributes::UV != 0 && item.material.has_second_uvs() {
        needed |= Attributes::SECOND_UV;
    }
    if has_places(scene) { Attributes(needed) } else { Attributes(needed & !Attributes::WORLD) }
}

/// Why an item does without.
fn unused(account: &Account<'_>, effect: Effect) -> &'static str {
    let is_gouraud = account.asked.item.material.shading == Shading::Gouraud;
    match effect {
        Effect::Light if account.asked.scene.light == Light::NONE => "the scene has no light",
        Effect::Light if is_gouraud => "Gouraud: the light is in the colours of the corners",
        Effect::Light => "the material is unlit",
        Effect::Texture => "the material has no texture",
        _ => "the material uses no colours of its corners",
    }
}

pub fn explain<'a>(account: &'a Account<'_>) -> impl Iterator<Item = Decision> + 'a {
    let pieces = account.pieces;
    ALL.into_iter().map(move |(effect, bit, what)| {
        let varies = account.paid(effect);
        let reason = match (
            uses(account.asked.scene, account.asked.item, effect),
            account.is_listed,
            varies,
        ) {
            (false, ..) => unused(account, effect).to_owned(),
            (true, false, _) => format!("{what}: interpolated where it varies"),
            (true, true, 0) => format!("{what}: one for each triangle"),
            (true, true, _) if varies == pieces => format!("{what}: varies in every piece"),
            (true, true, _) => format!("{what}: varies in some pieces"),
        };
        account.decide(effect, if account.asked.carries.has(bit) { pieces } else { 0 }, reason)
    })
}
