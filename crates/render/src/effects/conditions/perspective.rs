//! Perspective: the division by 1/w in each fragment.
//!
//! Left out where the three 1/w have the same bits, or nothing is interpolated. With equal w the
//! weights are exactly those of affine interpolation, see
//! [`rasterproof_core::contract::Interpolate::affine_fragments`].

use super::survey::Survey;
use crate::effects::plan::{Attributes, Decision};
use crate::effects::primitive::{Piece, has_one_w};
use crate::effects::{Effect, Effects, Mode};
use crate::scene::Scene;

/// What the scene and its effects ask for.
pub fn mode(scene: &Scene, effects: &Effects) -> Mode {
    if scene.affine { Mode::Never } else { effects.mode(Effect::Perspective) }
}

#[inline]
pub fn pays(mode: Mode, piece: &Piece, interpolates: Attributes) -> bool {
    match mode {
        Mode::Planned | Mode::Material => !interpolates.is_empty() && !has_one_w(piece),
        Mode::Always => true,
        Mode::Never => false,
    }
}

pub fn explain(survey: &Survey<'_>) -> Decision {
    let Survey { pieces, one_w, perspective, any_interpolated, .. } = *survey;
    if survey.scene.affine {
        let reason = "the scene asks for affine interpolation";
        return survey.decide(Effect::Perspective, 0, reason);
    }
    if !survey.is_listed {
        return survey.leave_open(Effect::Perspective, "where w differs between the corners");
    }
    let reason = match (any_interpolated, one_w == pieces) {
        (0, _) => "only depth varies, which is linear in the window",
        (_, true) => "w is the same at the three corners of every piece",
        _ if perspective == pieces => "w differs between the corners of every piece",
        _ => "some pieces have attributes that vary and corners whose w differ",
    };
    survey.decide(Effect::Perspective, perspective, reason)
}
