//! Fog: mixing the colour of each fragment with that of the fog.
//!
//! Left out where the scene has none, and for a piece whose depths are all so near that no channel changes
//! ([`Veil::between`]). Where they are all so far that nothing but fog is seen, the piece has its colour, and
//! nothing is interpolated.
//!
//! [`Veil::between`]: crate::pipeline::fog::Veil::between

use super::survey::Survey;
use crate::effects::plan::Decision;
use crate::effects::primitive::{Piece, Prepared};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::fog::Share;
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

#[inline]
pub fn share(mode: Mode, item: &Prepared<'_>, piece: &Piece) -> Share {
    match mode {
        Mode::Planned | Mode::Material => {
            item.veil.between(piece.vertices.map_array(|vertex| vertex.depth))
        }
        Mode::Always => Share::Mixed,
        Mode::Never => Share::None,
    }
}

/// Nothing of a scene without fog, unless the user switches it on or off everywhere.
pub fn explain(survey: &Survey<'_>) -> Option<Decision> {
    let Survey { scene, pieces, shares: [mixed, whole], .. } = *survey;
    let asked = survey.effects.mode(Effect::Fog);
    let all = match mode(scene, survey.effects) {
        Mode::Always => pieces,
        _ => 0,
    };
    let (on, reason) = if scene.fog.is_none() {
        if matches!(asked, Mode::Planned | Mode::Material) {
            return None;
        }
        (all, "the scene has no fog")
    } else if asked == Mode::Material {
        (all, "the scene has fog")
    } else if !survey.is_listed {
        let reason = "where the depths of the corners are in the fog";
        return Some(survey.leave_open(Effect::Fog, reason));
    } else {
        let reason = match (mixed, whole) {
            (0, 0) => "every piece is nearer than the fog",
            (0, _) => "no piece is partly in the fog: it is not in it, or nothing else is seen",
            _ if mixed == pieces => "every piece is partly in the fog",
            _ => "some pieces are partly in the fog",
        };
        (mixed, reason)
    };
    Some(survey.decide(Effect::Fog, on, reason))
}
