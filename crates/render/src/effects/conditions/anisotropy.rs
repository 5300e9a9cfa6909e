//! Anisotropy: reading a texture several times along the longer axis of a pixel's footprint.
//!
//! Left out where the texture is read once everywhere, and for a piece in which the longer axis of every footprint
//! is known to be less than one and a half times as long as the shorter one, or as a texel
//! ([`Footprint::is_round`]): its texture is read once, at the point itself and at the level of the longer axis, as
//! without the effect.
//!

use super::mip_maps::pays_unless;
use super::survey::Survey;
use crate::effects::plan::{Attributes, Decision};
use crate::effects::primitive::{Piece, Prepared};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::footprint::Footprint;
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
    item.material.texture.as_ref().is_some_and(|texture| texture.anisotropy > 1)
}

#[inline]
pub fn pays(mode: Mode, item: &Prepared<'_>, piece: &Piece, perspective: bool) -> bool {
    pays_unless(mode, item, piece, perspective, Footprint::is_round)
}

/// Nothing of a texture that is read once, unless the user switches the effect on or off everywhere.
pub fn explain(survey: &Survey<'_>) -> Option<Decision> {
    let Survey { item, pieces, anisotropy, .. } = *survey;
    let asked = survey.effects.mode(Effect::Anisotropy);
    let (on, reason) = if !is_asked_for(item) {
        if matches!(asked, Mode::Planned | Mode::Material) {
            return None;
        }
        let is_on = mode(item, survey.carries, survey.effects) == Mode::Always;
        let has_texture = item.material.texture.is_some();
        let reason =
            if has_texture { "the texture is read once" } else { "the material has no texture" };
        (if is_on { pieces } else { 0 }, reason)
    } else if asked == Mode::Material {
        (pieces, "the texture may be read several times")
    } else if !survey.is_listed {
        let reason = "where the axes of a footprint are not known to be about as long";
        return Some(survey.leave_open(Effect::Anisotropy, reason));
    } else {
        let reason = match anisotropy {
            0 => "the axes of a footprint are about as long everywhere",
            _ if anisotropy == pieces => {
                "no piece is known to have axes of a footprint that are about as long everywhere"
            }
            _ => "some pieces are not known to have axes of a footprint that are about as long",
        };
        (anisotropy, reason)
    };
    Some(survey.decide(Effect::Anisotropy, on, reason))
}
