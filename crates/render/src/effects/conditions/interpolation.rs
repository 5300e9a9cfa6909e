//! Interpolation: of an attribute, and of what is computed from it, in each fragment.
//!
//! Left out for each attribute that has the same bits at the three corners. The rasterizers return a
//! constant exactly, so what is computed from it once is what every fragment would get.
//!
//! Texture coordinates are left out as well where all texels that a piece may read have one colour ([`is_plain`]).

use super::account::Account;
use super::alpha_test;
use super::mip_maps::{any_reads, around};
use crate::effects::plan::{Attributes, Decision, Rule};
use crate::effects::primitive::{Piece, Prepared, uvs};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::opacity::Drawn;
use crate::pipeline::physical::TextureRead;
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
    for (bit, range) in &Attributes::RANGES {
        if of.has(*bit) && !range.clone().any(varies) {
            of.0 &= !bit;
        }
    }
    of
}

/// Whether a rule lets a texture be read once for a piece with these opacities. Whoever pays for levels or taps everywhere reads
/// it everywhere, and each opacity of its own needs coordinates.
pub fn may_be_plain(rule: &Rule, opacity: Drawn) -> bool {
    let is_mixed = |mode: Mode| alpha_test::drawn(mode, opacity) == Drawn::Mixed;
    rule.where_it_varies
        && ![rule.mip_maps, rule.anisotropy].contains(&Mode::Always)
        && !is_mixed(rule.alpha_test)
        && !is_mixed(rule.blending)
}

/// Whether all texels of a texture have one colour that the fragments of a piece may read: those between the texture coordinates
/// of its corners and beside them, as far as a filter reads, and [`around`] them at each level.
pub fn is_plain(
    (texture, is_second): TextureRead<'_>,
    rule: &Rule,
    item: &Prepared<'_>,
    piece: &Piece,
    reads: [bool; 2],
) -> bool {
    let uv = uvs(piece, is_second);
    texture.is_plain_between(uv, 0.0, 0.0)
        && (reads == [false; 2]
            || around((texture, is_second), rule, item, piece, reads)
                .is_some_and(|[reach, level]| texture.is_plain_between(uv, reach, level)))
}

/// The same, however the texture is read by the rule.
pub fn is_plain_in(read: TextureRead<'_>, rule: &Rule, item: &Prepared<'_>, piece: &Piece) -> bool {
    is_plain(read, rule, item, piece, any_reads(rule))
}

pub fn explain(account: &Account<'_>) -> Decision {
    if account.asked.effects.mode(Effect::Interpolation) == Mode::Material {
        let (attributes, _) =
            rule(account.asked.item, account.asked.carries, account.asked.effects);
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
