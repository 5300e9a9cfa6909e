//! Alpha test: leaving out the fragments that are not opaque enough.
//!
//! Left out where the material has no holes, and for a piece whose opacities all reach the threshold
//! ([`Opacity::between`]). A piece whose opacities are all below it is not drawn.
//!
//! [`Opacity::between`]: crate::pipeline::opacity::Opacity::between

use super::survey::Survey;
use crate::effects::plan::Decision;
use crate::effects::primitive::{Piece, Prepared};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::opacity::{AlphaMode, Drawn};
use crate::pipeline::shade::Surface;
use crate::scene::Item;
use rasterproof_core::arrays::MapArray as _;

fn is_tested(item: &Item) -> bool {
    let opacity = item.material.opacity.as_ref();
    opacity.is_some_and(|opacity| opacity.mode != AlphaMode::Blend)
}

/// What an item asks for; without a threshold there is nothing to be tested.
pub fn mode(item: &Item, effects: &Effects) -> Mode {
    match effects.mode(Effect::AlphaTest) {
        _ if !is_tested(item) => Mode::Never,
        Mode::Material => Mode::Always,
        mode => mode,
    }
}

/// What is drawn of a piece by the opacities that it reads.
#[inline]
pub fn drawn(mode: Mode, item: &Prepared<'_>, piece: &Piece) -> Drawn {
    match (mode, &item.item.material.opacity) {
        (Mode::Never, _) | (_, None) => Drawn::All,
        (Mode::Always, _) => Drawn::Mixed,
        (_, Some(opacity)) => {
            opacity.between(piece.vertices.map_array(|vertex| Surface::from(vertex.varying).uv))
        }
    }
}

/// Nothing of a material without a threshold.
pub fn explain(survey: &Survey<'_>) -> Option<Decision> {
    let Survey { item, pieces, tested: [mixed, nothing], .. } = *survey;
    if !is_tested(item) {
        return None;
    }
    if survey.effects.mode(Effect::AlphaTest) == Mode::Material {
        return Some(survey.decide(Effect::AlphaTest, pieces, "the material is cut out"));
    }
    if !survey.is_listed {
        let reason = "where opacities lie on both sides of the threshold";
        return Some(survey.leave_open(Effect::AlphaTest, reason));
    }
    let reason = match (mixed, nothing) {
        (0, 0) => "every piece is opaque",
        (0, _) => "every piece is opaque, or not opaque enough anywhere and left out",
        _ if mixed == pieces => "every piece may have holes",
        (_, 0) => "some pieces may have holes, the others are opaque",
        _ => "some pieces may have holes; those that have nothing else are left out",
    };
    Some(survey.decide(Effect::AlphaTest, mixed, reason))
}
