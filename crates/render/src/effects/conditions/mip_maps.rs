//! Mip maps: the level of detail of a texture in each fragment, and reading between two levels.
//!
//! Left out where the texture has no mip map, and for a piece that is magnified everywhere
//! ([`Footprint::is_magnified`]): its level is at most 0, where the texture itself is read.

use super::account::Condition;
use crate::effects::plan::{Attributes, Rule};
use crate::effects::primitive::{Piece, Prepared, has_one_w, uvs};
use crate::effects::{Effect, Mode};
use crate::pipeline::footprint::Footprint;
use crate::pipeline::physical::TextureRead;
use crate::pipeline::texture::Texture;
use glam::DVec2;
use rasterproof_core::arrays::MapArray as _;

/// Without texture coordinates there is no level.
pub const CONDITION: Condition = Condition {
    effect: Effect::MipMaps,
    needs: 0,
    is_possible: |asked| asked.carries.has(Attributes::UV),
    is_asked_for: |asked| asked.item.material.textures().any(Texture::has_mip_map),
    missing: |asked| {
        let has_texture = asked.item.material.textures().next().is_some();
        let none = "the material has no texture";
        Some((if has_texture { "the texture has no mip map" } else { none }, false))
    },
    by_material: "the texture has a mip map",
    open: "where the texture is not known to be magnified",
    reasons: |_| {
        [
            "the texture is magnified everywhere",
            "no piece is known to magnify the texture everywhere",
            "some pieces are not known to magnify the texture everywhere",
        ]
    },
};

/// The footprint of a piece in a texture, and what it is made of. Where w is the same at all corners it is as if divided by,
/// whether it is or not, so that the level keeps its bits.
pub fn footprint(
    (texture, is_second): TextureRead<'_>,
    piece: &Piece,
    perspective: bool,
) -> (Footprint, [f64; 3], [DVec2; 3]) {
    let is_affine = is_affine(piece, perspective);
    let inv_w =
        [0, 1, 2].map_array(|i: usize| if is_affine { 1.0 } else { piece.vertices[i].inv_w });
    let uv = uvs(piece, is_second);
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
/// of both, by one footprint. A piece that shows more texels than it covers samples is minified somewhere.
pub fn footprints(rule: &Rule, item: &Prepared<'_>, piece: &Piece, samples: i64) -> [bool; 2] {
    if !is_near(item, piece) {
        return [true; 2];
    }
    let mut may_be = [rule.mip_maps, rule.anisotropy].map_array(|mode| !mode.is_open());
    // The footprint of all textures of one size at the same coordinates is the same.
    let mut last = None;
    for read in item.colour().into_iter().chain(item.item.material.maps()) {
        let kind = (read.0.size(), read.1);
        if last.replace(kind) == Some(kind) {
            continue;
        }
        may_be[0] |= texels(read, piece) > samples as f64 + 1.0;
        if may_be == [true; 2] {
            break;
        }
        let (footprint, inv_w, uv) = footprint(read, piece, rule.perspective != Mode::Never);
        may_be[0] = may_be[0] || !footprint.is_magnified(inv_w, uv);
        may_be[1] = may_be[1] || !footprint.is_round(inv_w, uv);
    }
    may_be
}

/// About how many texels lie between the texture coordinates of the corners of a piece.
fn texels((texture, is_second): TextureRead<'_>, piece: &Piece) -> f64 {
    let [a, b, c] = uvs(piece, is_second);
    let (width, height) = texture.size();
    (b - a).perp_dot(c - a).abs() / 2.0 * f64::from(width) * f64::from(height)
}

/// Up to so many texels a pixel a texture is looked at.
pub const MOST_TEXELS: f64 = (1 << 16) as f64;

/// How many texels beside the texture coordinates of a fragment a texture is read at most, and up to which level: with `levels` up to
/// that of the longest derivative, and with `taps` up to half of it away, which is as far as a tap is moved. Nothing where that is not known.
pub fn around(
    read: TextureRead<'_>,
    rule: &Rule,
    item: &Prepared<'_>,
    piece: &Piece,
    [levels, taps]: [bool; 2],
) -> Option<[f64; 2]> {
    if !(levels || taps) {
        return Some([0.0; 2]);
    }
    let (footprint, inv_w, uv) = footprint(read, piece, rule.perspective != Mode::Never);
    let longest = footprint.longest(inv_w, uv);
    let reach = if taps { longest / 2.0 } else { 0.0 };
    let level = if levels { libm::log2(longest) + 0.5f64.powi(20) } else { 0.0 };
    (is_near(item, piece) && longest < MOST_TEXELS).then_some([reach, level])
}

/// Whether a rule lets a texture be read at levels, and several times.
pub fn any_reads(rule: &Rule) -> [bool; 2] {
    [rule.mip_maps, rule.anisotropy].map_array(|mode| mode != Mode::Never)
}
