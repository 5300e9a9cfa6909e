//! Interpolation: of an attribute, and of what is computed from it, in each fragment.
//!
//! Left out for each attribute that has the same bits at the three corners. The rasterizers return a
//! constant exactly, so what is computed from it once is what every fragment would get.

use super::survey::Survey;
use crate::effects::plan::{Attributes, Decision, Rule};
use crate::effects::primitive::Piece;
use crate::effects::{Effect, Effects, Mode};
use crate::scene::{Item, Shading};

/// The attributes of an item that may be interpolated, and whether only where they vary.
pub fn rule(item: &Item, carries: Attributes, effects: &Effects) -> (Attributes, bool) {
    match effects.mode(Effect::Interpolation) {
        Mode::Planned => (carries, true),
        Mode::Always => (carries, false),
        Mode::Never => (Attributes::NONE, false),
        Mode::Material => (at_most(item, carries), false),
    }
}

/// What may vary in a triangle by the material: flat light does not.
pub fn at_most(item: &Item, carries: Attributes) -> Attributes {
    match item.material.shading {
        Shading::Flat => carries.both(Attributes(!Attributes::NORMAL)),
        Shading::Unlit | Shading::Gouraud | Shading::Phong => carries,
    }
}

/// The attributes that a rule has interpolated in a piece.
#[inline]
pub fn of(rule: &Rule, piece: &Piece) -> Attributes {
    if !rule.where_it_varies {
        return rule.interpolates;
    }
    let [a, b, c] = &piece.vertices;
    let varies = |i: usize| {
        let bits = a.varying.0[i].to_bits();
        bits != b.varying.0[i].to_bits() || bits != c.varying.0[i].to_bits()
    };
    let mut left = rule.interpolates;
    for (bit, mut range) in Attributes::RANGES {
        if left.has(bit) && !range.any(varies) {
            left.0 &= !bit;
        }
    }
    left
}

pub fn explain(survey: &Survey<'_>) -> Decision {
    let Survey { pieces, any_interpolated, .. } = *survey;
    if survey.effects.mode(Effect::Interpolation) == Mode::Material {
        let (attributes, _) = rule(survey.item, survey.carries, survey.effects);
        let on = if attributes.is_empty() { 0 } else { pieces };
        return survey.decide(Effect::Interpolation, on, "what the material's shader reads");
    }
    if !survey.is_listed {
        let reason = "attributes that differ between the corners";
        return survey.leave_open(Effect::Interpolation, reason);
    }
    let reason = match any_interpolated {
        0 => "no piece has an attribute that varies",
        _ if any_interpolated == pieces => "every piece has an attribute that varies",
        _ => "some pieces have an attribute that varies",
    };
    survey.decide(Effect::Interpolation, any_interpolated, reason)
}
