//! Fog: mixing the colour of each fragment with that of the fog.
//!
//! Left out where the scene has none, and for a piece whose depths are all so near that no channel changes
//! ([`Veil::between`]). Where they are all so far that nothing but fog is seen, the piece has its colour, and
//! nothing is interpolated.
//!
//! [`Veil::between`]: crate::pipeline::fog::Veil::between

use super::Facts;
use super::account::Condition;
use super::alpha_test::drawn;
use crate::effects::plan::Rule;
use crate::effects::primitive::{Piece, Prepared};
use crate::effects::{Effect, Mode};
use crate::pipeline::fog::Share;
use crate::pipeline::opacity::Drawn;
use rasterproof_core::arrays::MapArray as _;

pub const CONDITION: Condition = Condition {
    effect: Effect::Fog,
    needs: 0,
    is_possible: |_| true,
    is_asked_for: |asked| asked.scene.fog.is_some(),
    missing: |_| Some(("the scene has no fog", false)),
    by_material: "the scene has fog",
    open: "where the depths of the corners are in the fog",
    reasons: |account| {
        let hidden = "no piece is partly in the fog: it is not in it, or nothing else is seen";
        let none = if account.fogged > 0 { hidden } else { "every piece is nearer than the fog" };
        [none, "every piece is partly in the fog", "some pieces are partly in the fog"]
    },
};

/// How much fog there is between the depths of the corners.
pub fn between(item: &Prepared<'_>, piece: &Piece) -> Share {
    item.veil.between(piece.vertices.map_array(|vertex| vertex.depth))
}

/// Whether nothing but fog is seen of a piece. Whoever has everything interpolated has what the fog hides interpolated too,
/// and opacities need texture coordinates in the fog too.
#[inline]
pub fn hides(rule: &Rule, facts: &Facts) -> bool {
    let is_mixed = |mode| drawn(mode, facts.opacity) == Drawn::Mixed;
    facts.fog == Share::Whole
        && rule.fog.is_open()
        && rule.where_it_varies
        && !is_mixed(rule.alpha_test)
        && !is_mixed(rule.blending)
}

#[inline]
pub fn share(rule: &Rule, facts: &Facts) -> Share {
    match rule.fog {
        Mode::Planned | Mode::Material if facts.fog != Share::Whole || hides(rule, facts) => {
            facts.fog
        }
        Mode::Never => Share::None,
        _ => Share::Mixed,
    }
}
