//! Perspective: the division by 1/w in each fragment.
//!
//! Left out where the three 1/w have the same bits, or nothing is interpolated. With equal w the
//! weights are exactly those of affine interpolation, see
//! [`rasterproof_core::contract::Interpolate::affine_fragments`].

use super::account::Account;
use crate::effects::plan::Decision;
use crate::effects::{Effect, Effects, Mode};
use crate::scene::Scene;

/// What the scene and its effects ask for.
pub fn mode(scene: &Scene, effects: &Effects) -> Mode {
    if scene.affine { Mode::Never } else { effects.mode(Effect::Perspective) }
}

pub fn explain(account: &Account<'_>) -> Decision {
    let Account { pieces, one_w, .. } = *account;
    let perspective = account.paid(Effect::Perspective);
    if account.asked.scene.affine {
        let reason = "the scene asks for affine interpolation";
        return account.decide(Effect::Perspective, 0, reason);
    }
    if !account.is_listed {
        return account.leave_open(Effect::Perspective, "where w differs between the corners");
    }
    let reason = match (account.paid(Effect::Interpolation), one_w == pieces) {
        (0, _) => "only depth varies, which is linear in the window",
        (_, true) => "w is the same at the three corners of every piece",
        _ if perspective == pieces => "w differs between the corners of every piece",
        _ => "some pieces have attributes that vary and corners whose w differ",
    };
    account.decide(Effect::Perspective, perspective, reason)
}
