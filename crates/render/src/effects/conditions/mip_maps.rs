//! Mip maps: the level of detail of a texture in each fragment, and reading between two levels.
//!
//! Left out where the texture has no mip map, and for a piece that is magnified everywhere
//! ([`Footprint::is_magnified`]): its level is at most 0, where the texture itself is read.

use super::account::Account;
use crate::effects::plan::{Attributes, Decision, Rule};
use crate::effects::primitive::{Piece, Prepared, has_one_w};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::footprint::Footprint;
use crate::pipeline::shade::Surface;
use crate::pipeline::texture::Texture;
use crate::scene::Item;
use glam::DVec2;
use rasterproof_core::arrays::MapArray as _;

/// What an item asks for; without texture coordinates nothing.
pub fn mode(item: &Item, carries: Attributes, effects: &Effects) -> Mode {
    match effects.mode(Effect::MipMaps) {
        _ if !carries.has(Attributes::UV) => Mode::Never,
        Mode::Planned | Mode::Material if !has_mip_map(item) => Mode::Never,
        Mode::Material => Mode::Always,
        mode => mode,
    }
}

fn has_mip_map(item: &Item) -> bool {
    item.material.textures().any(Texture::has_mip_map)
}

/// The footprint of a piece, and what it is made of. Where w is the same at all corners it is as if divided by,
/// whether it is or not, so that the level keeps its bits.
pub fn footprint(
    texture: &Texture,
    piece: &Piece,
    perspective: bool,
) -> (Footprint, [f64; 3], [DVec2; 3]) {
    let is_affine = is_affine(piece, perspective);
    let inv_w = piece.vertices.map_array(|vertex| if is_affine { 1.0 } else { vertex.inv_w });
    let uv = piece.vertices.map_array(|vertex| Surface::from(vertex.varying).uv);
    (Footprint::new(piece.corners(), inv_w, uv, texture.size()), inv_w, uv)
}

/// Whether attributes are interpolated linearly although w differs.
pub fn is_affine(piece: &Piece, perspective: bool) -> bool {
    !perspective && !has_one_w(piece)
}

/// How many times as far as the near plane a corner may be: up to here the w of a fragment, which is computed from
/// its depth, is off by less than 2^-48 2^24 of itself, as the depth is by 2^-48 at most.
const FARTHEST: f64 = (1 << 24) as f64;

/// Whether the w of fragments is that near to the exact one.
pub fn is_near(item: &Prepared<'_>, piece: &Piece) -> bool {
    let near = item.veil.w(0.0).abs();
    piece.vertices.iter().all(|v| v.inv_w * near * FARTHEST > 1.0)
}

/// Whether a piece may read levels above 0, and whether it may have a footprint with a longer axis: what a rule leaves open
/// of both, by one footprint.
pub fn footprints(rule: &Rule, item: &Prepared<'_>, piece: &Piece) -> [bool; 2] {
    if !is_near(item, piece) {
        return [true; 2];
    }
    let mut may_be = [false; 2];
    for texture in item.texture.into_iter().chain(item.item.material.maps()) {
        let (footprint, inv_w, uv) = footprint(texture, piece, rule.perspective != Mode::Never);
        may_be[0] |= !(rule.mip_maps.is_open() && footprint.is_magnified(inv_w, uv));
        may_be[1] |= !(rule.anisotropy.is_open() && footprint.is_round(inv_w, uv));
    }
    may_be
}

/// Nothing of a texture without a mip map, unless the user switches levels on or off everywhere.
pub fn explain(account: &Account<'_>) -> Option<Decision> {
    let item = account.item;
    let asked = account.effects.mode(Effect::MipMaps);
    let is_on = mode(item, account.carries, account.effects) == Mode::Always;
    if !has_mip_map(item) {
        let has_texture = item.material.textures().next().is_some();
        let reason =
            if has_texture { "the texture has no mip map" } else { "the material has no texture" };
        return (!asked.is_open()).then(|| account.decide_all(Effect::MipMaps, is_on, reason));
    }
    if asked == Mode::Material {
        return Some(account.decide_all(Effect::MipMaps, is_on, "the texture has a mip map"));
    }
    Some(account.decide_each(
        Effect::MipMaps,
        "where the texture is not known to be magnified",
        [
            "the texture is magnified everywhere",
            "no piece is known to magnify the texture everywhere",
            "some pieces are not known to magnify the texture everywhere",
        ],
    ))
}
