//! Physical surfaces: what metal and roughness reflect, normal maps, occlusion and emission.
//!
//! Each is left out where the material does not ask for it, and for a piece
//!
//! - reflection: whose normals all face away from the light, and which no punctual light reaches. What is reflected is multiplied by the cosine there, which counts
//!   as 0, and so does the light of a matt surface. Not where a map may turn the normals;
//! - normal maps: where each texel that may be read leaves the normal as it is ([`Physical::is_flat`]);
//! - occlusion: where each texel that may be read is white. The ambient light is multiplied by 1;
//! - emission: where each texel that may be read is black. What is added is 0.
//!
//! [`Physical::is_flat`]: crate::pipeline::physical::Physical::is_flat

use super::account::{Asked, Condition};
use super::interpolation::is_plain_in;
use super::{Facts, is_looked_at, punctual as lights, shadows};
use crate::effects::Effect;
use crate::effects::plan::{Attributes, Rule};
use crate::effects::primitive::{Piece, Prepared, is_lit, light, punctual};
use crate::pipeline::physical::{Map, Physical};
use crate::pipeline::shade::Surface;
use glam::DVec3;

fn has_light(asked: &Asked<'_>) -> bool {
    let is_facing = light(asked.scene, asked.item).diffuse > 0.0;
    is_lit(asked.scene, asked.item) && (is_facing || !punctual(asked.scene, asked.item).is_empty())
}

fn surface<'a>(asked: &Asked<'a>) -> Option<&'a Physical> {
    asked.item.material.physical.as_deref()
}

fn has_map(asked: &Asked<'_>, map: Map) -> bool {
    surface(asked).is_some_and(|surface| surface.map(map).is_some())
}

/// Nothing of a material that is not physical, and of what it has not, unless the user switches that on or off everywhere.
fn missing(asked: &Asked<'_>, reason: &'static str) -> Option<(&'static str, bool)> {
    surface(asked).map(|_| (reason, false))
}

const BY_MATERIAL: &str = "what the material's shader computes";

pub const REFLECTION: Condition = Condition {
    effect: Effect::Reflection,
    is_possible: |asked| surface(asked).is_some() && asked.carries.has(Attributes::NORMAL),
    is_asked_for: |asked| surface(asked).is_some() && has_light(asked),
    missing: |asked| missing(asked, "no light of the scene is reflected"),
    by_material: BY_MATERIAL,
    open: "where a normal may face the light",
    reasons: |_| {
        [
            "every piece faces away from the light",
            "every piece may face the light",
            "some pieces may face the light",
        ]
    },
};

pub const NORMAL_MAPS: Condition = Condition {
    effect: Effect::NormalMaps,
    is_possible: REFLECTION.is_possible,
    is_asked_for: |asked| has_light(asked) && has_map(asked, Map::Normal),
    missing: |asked| missing(asked, "the material has no normal map, or no light that it changes"),
    by_material: BY_MATERIAL,
    open: "where the normal map is not known to be flat",
    reasons: |_| {
        [
            "the normal map is flat wherever it is read",
            "no piece is known to read a flat normal map",
            "some pieces are not known to read a flat normal map",
        ]
    },
};

pub const OCCLUSION: Condition = Condition {
    effect: Effect::Occlusion,
    is_possible: |asked| surface(asked).is_some() && is_lit(asked.scene, asked.item),
    is_asked_for: |asked| {
        is_lit(asked.scene, asked.item)
            && has_map(asked, Map::Occlusion)
            && surface(asked).is_some_and(|surface| surface.occlusion > 0.0)
    },
    missing: |asked| {
        missing(asked, "the material has no occlusion map, or no ambient light to lose")
    },
    by_material: BY_MATERIAL,
    open: "where the occlusion map is not known to be white",
    reasons: |_| {
        [
            "the occlusion map is white wherever it is read",
            "no piece is known to have all of the ambient light",
            "some pieces are not known to have all of the ambient light",
        ]
    },
};

pub const EMISSION: Condition = Condition {
    effect: Effect::Emission,
    is_possible: |asked| surface(asked).is_some(),
    is_asked_for: |asked| {
        surface(asked).is_some_and(|surface| surface.emission.max_element() > 0.0)
    },
    missing: |asked| missing(asked, "the material emits nothing"),
    by_material: BY_MATERIAL,
    open: "where the emission map is not known to be black",
    reasons: |_| {
        [
            "the emission map is black wherever it is read",
            "every piece may emit light",
            "some pieces may emit light",
        ]
    },
};

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
    is_looked_at(texture, samples) && are_like(first()) && is_plain_in(texture, rule, item, piece)
}

/// What is known of a piece of a physical surface.
pub fn see(rule: &Rule, item: &Prepared<'_>, piece: &Piece, samples: i64, facts: &mut Facts) {
    let Some(surface) = item.physical() else { return };
    if rule.normal_maps.is_open() {
        facts.is_bumpy = !all_are(rule, item, piece, (samples, Map::Normal), Physical::is_flat);
    }
    if rule.punctual.is_open() && !rule.normal_maps.pays(facts.is_bumpy) {
        facts.is_reached = lights::may_reach(item, piece);
    }
    if rule.reflection.is_open() && !rule.normal_maps.pays(facts.is_bumpy) {
        let has_main = item.light.diffuse != 0.0 && !shadows::piece_faces_away(item, piece);
        facts.is_reflecting = has_main || rule.punctual.pays(facts.is_reached);
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
