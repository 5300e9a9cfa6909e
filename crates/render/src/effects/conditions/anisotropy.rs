//! Anisotropy: reading a texture several times along the longer axis of a pixel's footprint.
//!
//! Left out where the texture is read once everywhere, and for a piece in which the longer axis of every footprint
//! is known to be less than one and a half times as long as the shorter one, or as a texel
//! ([`Footprint::is_round`](crate::pipeline::footprint::Footprint::is_round)): its texture is read once, at the point itself and at the level of the longer axis, as
//! without the effect.

use super::account::Account;
use crate::effects::plan::{Attributes, Decision};
use crate::effects::{Effect, Effects, Mode};
use crate::scene::Item;

/// What an item asks for; without texture coordinates nothing.
pub fn mode(item: &Item, carries: Attributes, effects: &Effects) -> Mode {
    match effects.mode(Effect::Anisotropy) {
        _ if !carries.has(Attributes::UV) => Mode::Never,
        Mode::Planned | Mode::Material if !is_asked_for(item) => Mode::Never,
        Mode::Material => Mode::Always,
        mode => mode,
    }
}

fn is_asked_for(item: &Item) -> bool {
    item.material.textures().any(|texture| texture.anisotropy > 1)
}

/// Nothing of a texture that is read once, unless the user switches the effect on or off everywhere.
pub fn explain(account: &Account<'_>) -> Option<Decision> {
    let item = account.item;
    let asked = account.effects.mode(Effect::Anisotropy);
    if !is_asked_for(item) {
        let is_on = mode(item, account.carries, account.effects) == Mode::Always;
        let has_texture = item.material.textures().next().is_some();
        let reason =
            if has_texture { "the texture is read once" } else { "the material has no texture" };
        return (!asked.is_open()).then(|| account.decide_all(Effect::Anisotropy, is_on, reason));
    }
    if asked == Mode::Material {
        let reason = "the texture may be read several times";
        return Some(account.decide_all(Effect::Anisotropy, true, reason));
    }
    Some(account.decide_each(
        Effect::Anisotropy,
        "where the axes of a footprint are not known to be about as long",
        [
            "the axes of a footprint are about as long everywhere",
            "no piece is known to have axes of a footprint that are about as long everywhere",
            "some pieces are not known to have axes of a footprint that are about as long",
        ],
    ))
}
