//! Blending: mixing each fragment with what is behind it.
//!
//! Left out where the material is opaque or tests its opacity, and for a piece whose opacities are all 255
//! ([`Opacity::between`]): it is drawn as any other, depth and all, as each of its fragments would be. A piece
//! whose opacities are all 0 is not drawn.
//!
//! [`Opacity::between`]: crate::pipeline::opacity::Opacity::between

use super::account::Account;
use crate::effects::plan::Decision;
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::opacity::AlphaMode;
use crate::scene::Item;

/// Whether an item is drawn after those that do not blend.
pub fn is_blended(item: &Item) -> bool {
    let opacity = item.material.opacity.as_ref();
    opacity.is_some_and(|opacity| opacity.mode == AlphaMode::Blend)
}

/// What an item asks for; only a material that blends has something to be mixed.
pub fn mode(item: &Item, effects: &Effects) -> Mode {
    match effects.mode(Effect::Blending) {
        _ if !is_blended(item) => Mode::Never,
        Mode::Material => Mode::Always,
        mode => mode,
    }
}

/// Nothing of a material that does not blend.
pub fn explain(account: &Account<'_>) -> Option<Decision> {
    let Account { item, pieces, nothing, .. } = *account;
    let mixed = account.paid(Effect::Blending);
    if !is_blended(item) {
        return None;
    }
    if account.effects.mode(Effect::Blending) == Mode::Material {
        return Some(account.decide(Effect::Blending, pieces, "the material blends"));
    }
    if !account.is_listed {
        let reason = "where an opacity between nothing and all may be read";
        return Some(account.leave_open(Effect::Blending, reason));
    }
    let reason = match (mixed, nothing) {
        (0, 0) => "every piece is opaque",
        (0, _) => "every piece is opaque, or clear everywhere and left out",
        _ if mixed == pieces => "something may be seen through every piece",
        (_, 0) => "something may be seen through some pieces, the others are opaque",
        _ => "something may be seen through some pieces; those that are clear are left out",
    };
    Some(account.decide(Effect::Blending, mixed, reason))
}
