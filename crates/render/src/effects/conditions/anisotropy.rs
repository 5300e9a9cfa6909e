//! Anisotropy: reading a texture several times along the longer axis of a pixel's footprint.
//!
//! Left out where the texture is read once everywhere, and for a piece in which the longer axis of every footprint
//! is known to be less than one and a half times as long as the shorter one, or as a texel
//! ([`Footprint::is_round`](crate::pipeline::footprint::Footprint::is_round)): its texture is read once, at the point itself and at the level of the longer axis, as
//! without the effect.

use super::account::Condition;
use crate::effects::Effect;
use crate::effects::plan::Attributes;

/// Without texture coordinates there is no footprint.
pub const CONDITION: Condition = Condition {
    effect: Effect::Anisotropy,
    needs: 0,
    is_possible: |asked| asked.carries.has(Attributes::UV),
    is_asked_for: |asked| asked.item.material.textures().any(|texture| texture.anisotropy > 1),
    missing: |asked| {
        let has_texture = asked.item.material.textures().next().is_some();
        let none = "the material has no texture";
        Some((if has_texture { "the texture is read once" } else { none }, false))
    },
    by_material: "the texture may be read several times",
    open: "where the axes of a footprint are not known to be about as long",
    reasons: |_| {
        [
            "the axes of a footprint are about as long everywhere",
            "no piece is known to have axes of a footprint that are about as long everywhere",
            "some pieces are not known to have axes of a footprint that are about as long",
        ]
    },
};
