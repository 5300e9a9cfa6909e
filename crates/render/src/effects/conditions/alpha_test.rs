//! Alpha test: leaving out the fragments that are not opaque enough.
//!
//! Left out where the material has no holes, and for a piece whose opacities all reach the threshold
//! ([`Opacity::between`]). A piece whose opacities are all below it is not drawn.
//!
//! [`Opacity::between`]: crate::pipeline::opacity::Opacity::between

use super::account::Account;
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

/// What is drawn of a piece by the opacities that it may read.
pub fn opacity(item: &Prepared<'_>, piece: &Piece) -> Drawn {
    let uv = || piece.vertices.map_array(|vertex| Surface::from(vertex.varying).uv);
    item.item.material.opacity.as_ref().map_or(Drawn::All, |opacity| opacity.between(uv()))
}

/// What a mode of the alpha test or of blending makes of it.
#[inline]
pub fn drawn(mode: Mode, opacity: Drawn) -> Drawn {
    match mode {
        Mode::Planned | Mode::Material => opacity,
        Mode::Always => Drawn::Mixed,
        Mode::Never => Drawn::All,
    }
}

/// Nothing of a material without a threshold.
pub fn explain(account: &Account<'_>) -> Option<Decision> {
    let Account { item, pieces, nothing, .. } = *account;
    let mixed = account.paid(Effect::AlphaTest);
    if !is_tested(item) {
        return None;
    }
    if account.effects.mode(Effect::AlphaTest) == Mode::Material {
        return Some(account.decide(Effect::AlphaTest, pieces, "the material is cut out"));
    }
    if !account.is_listed {
        let reason = "where opacities lie on both sides of the threshold";
        return Some(account.leave_open(Effect::AlphaTest, reason));
    }
    let reason = match (mixed, nothing) {
        (0, 0) => "every piece is opaque",
        (0, _) => "every piece is opaque, or not opaque enough anywhere and left out",
        _ if mixed == pieces => "every piece may have holes",
        (_, 0) => "some pieces may have holes, the others are opaque",
        _ => "some pieces may have holes; those that have nothing else are left out",
    };
    Some(account.decide(Effect::AlphaTest, mixed, reason))
}
