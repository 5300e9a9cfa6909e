//! Blending: mixing each fragment with what is behind it.
//!
//! Left out where the material is opaque or tests its opacity, and for a piece whose opacities are all 255
//! ([`Opacity::between`]): it is drawn as any other, depth and all, as each of its fragments would be. A piece
//! whose opacities are all 0 is not drawn.
//!
//! [`Opacity::between`]: crate::pipeline::opacity::Opacity::between

use super::Facts;
use super::account::Condition;
use super::alpha_test::drawn;
use crate::effects::Effect;
use crate::effects::plan::Rule;
use crate::pipeline::opacity::{AlphaMode, Drawn};
use crate::scene::Item;

/// Whether an item is drawn after those that do not blend.
pub fn is_blended(item: &Item) -> bool {
    let opacity = item.material.opacity.as_ref();
    opacity.is_some_and(|opacity| opacity.mode == AlphaMode::Blend)
}

/// Only a material that blends has something to be mixed.
pub const CONDITION: Condition = Condition {
    effect: Effect::Blending,
    needs: 0,
    is_possible: |asked| is_blended(asked.item),
    is_asked_for: |asked| is_blended(asked.item),
    missing: |_| None,
    by_material: "the material blends",
    open: "where an opacity between nothing and all may be read",
    reasons: |account| match account.nothing {
        0 => [
            "every piece is opaque",
            "something may be seen through every piece",
            "something may be seen through some pieces, the others are opaque",
        ],
        _ => [
            "every piece is opaque, or clear everywhere and left out",
            "something may be seen through every piece",
            "something may be seen through some pieces; those that are clear are left out",
        ],
    },
};

pub fn share(rule: &Rule, facts: &Facts) -> Drawn {
    drawn(rule.blending, facts.opacity)
}
