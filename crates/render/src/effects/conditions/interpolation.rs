//! Interpolation: of an attribute, and of what is computed from it, in each fragment.
//!
//! Left out for each attribute that has the same bits at the three corners. The rasterizers return a
//! constant exactly, so what is computed from it once is what every fragment would get.

use super::account::Account;
use crate::effects::plan::{Attributes, Decision};
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

/// Which of some attributes differ between the corners.
#[inline]
pub fn differing(mut of: Attributes, piece: &Piece) -> Attributes {
    let [a, b, c] = &piece.vertices;
    let varies = |i: usize| {
        let bits = a.varying.0[i].to_bits();
        bits != b.varying.0[i].to_bits() || bits != c.varying.0[i].to_bits()
    };
    for (bit, mut range) in Attributes::RANGES {
        if of.has(bit) && !range.any(varies) {
            of.0 &= !bit;
        }
    }
    of
}

pub fn explain(account: &Account<'_>) -> Decision {
    if account.effects.mode(Effect::Interpolation) == Mode::Material {
        let (attributes, _) = rule(account.item, account.carries, account.effects);
        let reason = "what the material's shader reads";
        return account.decide_all(Effect::Interpolation, !attributes.is_empty(), reason);
    }
    account.decide_each(
        Effect::Interpolation,
        "attributes that differ between the corners",
        [
            "no piece has an attribute that varies",
            "every piece has an attribute that varies",
            "some pieces have an attribute that varies",
        ],
    )
}
