//! Physical surfaces: what metal and roughness reflect, normal maps, occlusion and emission.
//!
//! Each is left out where the material does not ask for it, and for a piece
//!
//! - reflection: whose normals all face away from the light. What is reflected is multiplied by the cosine there, which counts
//!   as 0, and so does the light of a matt surface. Not where a map may turn the normals;
//! - normal maps: where each texel that may be read leaves the normal as it is ([`Physical::is_flat`]);
//! - occlusion: where each texel that may be read is white. The ambient light is multiplied by 1;
//! - emission: where each texel that may be read is black. What is added is 0.
//!
//! [`Physical::is_flat`]: crate::pipeline::physical::Physical::is_flat

use super::account::Account;
use super::interpolation::is_plain_in;
use super::{Facts, LEAST_TEXTURED, shadows};
use crate::effects::plan::{Attributes, Decision, Rule};
use crate::effects::primitive::{Piece, Prepared, is_lit};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::physical::{Map, Physical};
use crate::pipeline::shade::Surface;
use crate::scene::{Item, Scene};
use glam::DVec3;

/// Each with what it is called where the material has none of it.
const ALL: [(Effect, &str); 4] = [
    (Effect::Reflection, "no light of the scene is reflected"),
    (Effect::NormalMaps, "the material has no normal map, or no light that it changes"),
    (Effect::Occlusion, "the material has no occlusion map, or no ambient light to lose"),
    (Effect::Emission, "the material emits nothing"),
];

fn is_asked_for(scene: &Scene, item: &Item, effect: Effect) -> bool {
    let Some(surface) = item.material.physical.as_deref() else { return false };
    let has_light = is_lit(scene, item) && scene.light.diffuse > 0.0;
    match effect {
        Effect::Reflection => has_light,
        Effect::NormalMaps => has_light && surface.map(Map::Normal).is_some(),
        Effect::Occlusion => {
            is_lit(scene, item) && surface.map(Map::Occlusion).is_some() && surface.occlusion > 0.0
        }
        _ => surface.emission.max_element() > 0.0,
    }
}

/// What an item asks for; without normals no light is reflected, and without a physical surface nothing.
pub fn mode(
    scene: &Scene,
    item: &Item,
    carries: Attributes,
    effects: &Effects,
    effect: Effect,
) -> Mode {
    let needs_normal = matches!(effect, Effect::Reflection | Effect::NormalMaps);
    match effects.mode(effect) {
        _ if item.material.physical.is_none() => Mode::Never,
        _ if needs_normal && !carries.has(Attributes::NORMAL) => Mode::Never,
        // What has no light has all of it.
        _ if effect == Effect::Occlusion && !is_lit(scene, item) => Mode::Never,
        Mode::Planned | Mode::Material if !is_asked_for(scene, item, effect) => Mode::Never,
        Mode::Material => Mode::Always,
        mode => mode,
    }
}

/// Whether all texels of a map that a piece may read are like this; a piece of few samples is not looked at.
fn all_are(
    rule: &Rule,
    item: &Prepared<'_>,
    piece: &Piece,
    (samples, map): (i64, Map),
    are_like: impl Fn(DVec3) -> bool,
) -> bool {
    let Some(texture) = item.map(map) else { return are_like(map.missing()) };
    let first = || texture.at(Surface::from(piece.vertices[0].varying).uv);
    samples >= LEAST_TEXTURED && are_like(first()) && is_plain_in(texture, rule, item, piece)
}

/// What is known of a piece of a physical surface.
pub fn see(rule: &Rule, item: &Prepared<'_>, piece: &Piece, samples: i64, facts: &mut Facts) {
    let Some(surface) = item.physical() else { return };
    if rule.normal_maps.is_open() {
        facts.is_bumpy = !all_are(rule, item, piece, (samples, Map::Normal), Physical::is_flat);
    }
    if rule.reflection.is_open() && !rule.normal_maps.pays(facts.is_bumpy) {
        facts.is_reflecting = !shadows::piece_faces_away(item, piece);
    }
    if rule.occlusion.is_open() {
        let is_white = |texel: DVec3| texel.x == 1.0;
        facts.is_occluded = !all_are(rule, item, piece, (samples, Map::Occlusion), is_white);
    }
    if rule.emission.is_open() {
        let is_black = |texel: DVec3| surface.emission * texel == DVec3::ZERO;
        facts.is_emitting = !all_are(rule, item, piece, (samples, Map::Emission), is_black);
    }
}

/// Whether a piece with these facts reads a map.
pub fn reads(rule: &Rule, facts: &Facts, map: Map) -> bool {
    match map {
        Map::Emission => rule.emission.pays(facts.is_emitting),
        Map::Metal => rule.reflection.pays(facts.is_reflecting),
        Map::Occlusion => rule.occlusion.pays(facts.is_occluded),
        Map::Normal => rule.normal_maps.pays(facts.is_bumpy),
    }
}

/// Nothing of a material that is not physical, and of what it has not, unless the user switches that on or off everywhere.
pub fn explain<'a>(account: &'a Account<'_>) -> impl Iterator<Item = Decision> + 'a {
    let Account { scene, item, .. } = *account;
    let all = ALL.into_iter().filter(|_| item.material.physical.is_some());
    all.filter_map(move |(effect, none)| {
        let asked = account.effects.mode(effect);
        let is_on = mode(scene, item, account.carries, account.effects, effect) == Mode::Always;
        if !is_asked_for(scene, item, effect) {
            return (!asked.is_open()).then(|| account.decide_all(effect, is_on, none));
        }
        if asked == Mode::Material {
            return Some(account.decide_all(effect, is_on, "what the material's shader computes"));
        }
        let (open, reasons) = match effect {
            Effect::Reflection => (
                "where a normal may face the light",
                [
                    "every piece faces away from the light",
                    "every piece may face the light",
                    "some pieces may face the light",
                ],
            ),
            Effect::NormalMaps => (
                "where the normal map is not known to be flat",
                [
                    "the normal map is flat wherever it is read",
                    "no piece is known to read a flat normal map",
                    "some pieces are not known to read a flat normal map",
                ],
            ),
            Effect::Occlusion => (
                "where the occlusion map is not known to be white",
                [
                    "the occlusion map is white wherever it is read",
                    "no piece is known to have all of the ambient light",
                    "some pieces are not known to have all of the ambient light",
                ],
            ),
            _ => (
                "where the emission map is not known to be black",
                [
                    "the emission map is black wherever it is read",
                    "every piece may emit light",
                    "some pieces may emit light",
                ],
            ),
        };
        Some(account.decide_each(effect, open, reasons))
    })
}
