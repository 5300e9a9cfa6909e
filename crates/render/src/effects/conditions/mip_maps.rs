//! Mip maps: the level of detail of a texture in each fragment, and reading between two levels.
//!
//! Left out where the texture has no mip map, and for a piece that is magnified everywhere
//! ([`Footprint::is_magnified`]): its level is at most 0, where the texture itself is read.

use super::survey::Survey;
use crate::effects::plan::{Attributes, Decision};
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
    item.material.texture.as_ref().is_some_and(|texture| texture.has_mip_map())
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

#[inline]
pub fn pays(mode: Mode, item: &Prepared<'_>, piece: &Piece, perspective: bool) -> bool {
    pays_unless(mode, item, piece, perspective, Footprint::is_magnified)
}

/// Whether a piece pays for an effect that is left out where its footprints are of a certain kind.
#[inline]
pub fn pays_unless(
    mode: Mode,
    item: &Prepared<'_>,
    piece: &Piece,
    perspective: bool,
    is_certain: fn(&Footprint, [f64; 3], [DVec2; 3]) -> bool,
) -> bool {
    match (mode, item.texture) {
        (Mode::Planned | Mode::Material, Some(texture)) => {
            let (footprint, inv_w, uv) = footprint(texture, piece, perspective);
            !(is_near(item, piece) && is_certain(&footprint, inv_w, uv))
        }
        (Mode::Always, _) => true,
        _ => false,
    }
}

/// Nothing of a texture without a mip map, unless the user switches levels on or off everywhere.
pub fn explain(survey: &Survey<'_>) -> Option<Decision> {
    let Survey { item, pieces, mip_maps, .. } = *survey;
    let asked = survey.effects.mode(Effect::MipMaps);
    let all = match mode(item, survey.carries, survey.effects) {
        Mode::Always => pieces,
        _ => 0,
    };
    let (on, reason) = if !has_mip_map(item) {
        if matches!(asked, Mode::Planned | Mode::Material) {
            return None;
        }
        let has_texture = item.material.texture.is_some();
        (
            all,
            if has_texture { "the texture has no mip map" } else { "the material has no texture" },
        )
    } else if asked == Mode::Material {
        (all, "the texture has a mip map")
    } else if !survey.is_listed {
        let reason = "where the texture is not known to be magnified";
        return Some(survey.leave_open(Effect::MipMaps, reason));
    } else {
        let reason = match mip_maps {
            0 => "the texture is magnified everywhere",
            _ if mip_maps == pieces => "no piece is known to magnify the texture everywhere",
            _ => "some pieces are not known to magnify the texture everywhere",
        };
        (mip_maps, reason)
    };
    Some(survey.decide(Effect::MipMaps, on, reason))
}
