//! Alpha test: leaving out the fragments that are not opaque enough.
//!
//! Left out where the material has no holes, and for a piece whose opacities all reach the threshold
//! ([`Opacity::between`]). A piece whose opacities are all below it is not drawn.
//!
//! [`Opacity::between`]: crate::pipeline::opacity::Opacity::between

use super::account::Condition;
use super::mip_maps::{any_reads, around};
use super::{Facts, LEAST_TEXTURED};
use crate::effects::plan::Rule;
use crate::effects::primitive::{Piece, Prepared, uvs};
use crate::effects::{Effect, Mode};
use crate::pipeline::opacity::{AlphaMode, Drawn};
use crate::scene::Item;

fn is_tested(item: &Item) -> bool {
    let opacity = item.material.opacity.as_ref();
    opacity.is_some_and(|opacity| opacity.mode != AlphaMode::Blend)
}

/// Without a threshold there is nothing to be tested.
pub const CONDITION: Condition = Condition {
    effect: Effect::AlphaTest,
    needs: 0,
    is_possible: |asked| is_tested(asked.item),
    is_asked_for: |asked| is_tested(asked.item),
    missing: |_| None,
    by_material: "the material is cut out",
    open: "where opacities lie on both sides of the threshold",
    reasons: |account| match account.nothing {
        0 => [
            "every piece is opaque",
            "every piece may have holes",
            "some pieces may have holes, the others are opaque",
        ],
        _ => [
            "every piece is opaque, or not opaque enough anywhere and left out",
            "every piece may have holes",
            "some pieces may have holes; those that have nothing else are left out",
        ],
    },
};

/// What is drawn of a piece of so many samples by the opacities that it may read.
pub fn opacity(rule: &Rule, item: &Prepared<'_>, piece: &Piece, samples: i64) -> Drawn {
    let Some(opacity) = &item.item.material.opacity else { return Drawn::All };
    if opacity.map.is_some() && samples < LEAST_TEXTURED {
        return Drawn::Mixed;
    }
    let uv = uvs(piece, false);
    let around = match opacity.levels() {
        Some(texture) => around((texture, false), rule, item, piece, any_reads(rule)),
        None => Some([0.0; 2]),
    };
    opacity.between(uv, around.unwrap_or(opacity.farthest()))
}

pub fn share(rule: &Rule, facts: &Facts) -> Drawn {
    drawn(rule.alpha_test, facts.opacity)
}

/// What a mode of the alpha test or of blending makes of it.
#[inline]
pub fn drawn(mode: Mode, opacity: Drawn) -> Drawn {
    match mode {
        Mode::Planned | Mode::Material => opacity,
        Mode::Always => Drawn::Mixed,
        Mode::Never => Drawn::All,
    }
}
