//! Fog: mixing the colour of each fragment with that of the fog.
//!
//! Left out where the scene has none, and for a piece whose depths are all so near that no channel changes
//! ([`Veil::between`]). Where they are all so far that nothing but fog is seen, the piece has its colour, and
//! nothing is interpolated.
//!
//! [`Veil::between`]: crate::pipeline::fog::Veil::between

use super::Facts;
use super::account::Account;
use super::alpha_test::drawn;
use crate::effects::plan::{Decision, Rule};
use crate::effects::primitive::{Piece, Prepared};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::fog::Share;
use crate::pipeline::opacity::Drawn;
use crate::scene::Scene;
use rasterproof_core::arrays::MapArray as _;

/// What the scene and its effects ask for.
pub fn mode(scene: &Scene, effects: &Effects) -> Mode {
    match effects.mode(Effect::Fog) {
        Mode::Planned | Mode::Material if scene.fog.is_none() => Mode::Never,
        Mode::Material => Mode::Always,
        mode => mode,
    }
}

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

/// Nothing of a scene without fog, unless the user switches it on or off everywhere.
pub fn explain(account: &Account<'_>) -> Option<Decision> {
    let Account { scene, pieces, fogged, .. } = *account;
    let asked = account.effects.mode(Effect::Fog);
    let is_on = mode(scene, account.effects) == Mode::Always;
    if scene.fog.is_none() {
        let reason = "the scene has no fog";
        return (!asked.is_open()).then(|| account.decide_all(Effect::Fog, is_on, reason));
    }
    if asked == Mode::Material {
        return Some(account.decide_all(Effect::Fog, is_on, "the scene has fog"));
    }
    let some = match account.paid(Effect::Fog) {
        0 if fogged > 0 => {
            "no piece is partly in the fog: it is not in it, or nothing else is seen"
        }
        0 => "every piece is nearer than the fog",
        mixed if mixed == pieces => "every piece is partly in the fog",
        _ => "some pieces are partly in the fog",
    };
    let open = "where the depths of the corners are in the fog";
    Some(account.decide_each(Effect::Fog, open, [some; 3]))
}
