//! Physical surfaces: what metal and roughness reflect, punctual lights, normal maps, occlusion and emission.
//!
//! Each is left out where the material does not ask for it, and for a piece
//!
//! - reflection: whose normals all face away from the light, and which no punctual light reaches. What is reflected is multiplied by the cosine there, which counts
//!   as 0, and so does the light of a matt surface. Not where a map may turn the normals;
//! - punctual lights: which none of them reaches. All of it is farther away than the light's range, or lies behind a cone, whose light is
//!   0 there, or every normal faces away from the light everywhere: for places p and normals n of the corners, all nine n.(l - p) are
//!   at most 0. Between the corners both are means by the same weights, so the product is a mean of the nine. Not where a map may
//!   turn the normals;
//! - normal maps: where each texel that may be read leaves the normal as it is ([`Physical::is_flat`]);
//! - occlusion: where each texel that may be read is white. The ambient light is multiplied by 1;
//! - emission: where each texel that may be read is black. What is added is 0.
//!
//! [`Physical::is_flat`]: crate::pipeline::physical::Physical::is_flat

use super::account::{Condition, ItemQuestion};
use super::interpolation::is_plain_in;
use super::{Facts, is_looked_at, shadows};
use crate::effects::Effect;
use crate::effects::plan::{Attributes, Rule};
use crate::effects::primitive::{Piece, Prepared, is_lit, light, punctual, surfaces, uvs};
use crate::pipeline::physical::{Map, Physical};
use crate::pipeline::punctual::PunctualLight;
use glam::DVec3;
use rasterproof_core::arrays::MapArray as _;

fn has_light(asked: &ItemQuestion<'_>) -> bool {
    let is_facing = light(asked.scene, asked.item).diffuse > 0.0;
    is_lit(asked.scene, asked.item) && (is_facing || !punctual(asked.scene, asked.item).is_empty())
}

fn surface<'a>(asked: &ItemQuestion<'a>) -> Option<&'a Physical> {
    asked.item.material.physical.as_deref()
}

fn has_map(asked: &ItemQuestion<'_>, map: Map) -> bool {
    surface(asked).is_some_and(|surface| surface.map(map).is_some())
}

/// Nothing of a material that is not physical, and of what it has not, unless the user switches that on or off everywhere.
fn missing(asked: &ItemQuestion<'_>, reason: &'static str) -> Option<(&'static str, bool)> {
    surface(asked).map(|_| (reason, false))
}

const BY_MATERIAL: &str = "what the material's shader computes";

pub const REFLECTION: Condition = Condition {
    effect: Effect::Reflection,
    needs: Attributes::WORLD,
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

/// Without normals no light arrives.
pub const PUNCTUAL: Condition = Condition {
    effect: Effect::PunctualLights,
    needs: Attributes::WORLD,
    is_possible: |asked| {
        !punctual(asked.scene, asked.item).is_empty() && asked.carries.has(Attributes::NORMAL)
    },
    is_asked_for: |asked| !punctual(asked.scene, asked.item).is_empty(),
    missing: |asked| missing(asked, "the scene has no punctual lights"),
    by_material: "the scene has punctual lights",
    open: "where a punctual light may arrive",
    reasons: |_| {
        [
            "no punctual light reaches a piece",
            "a punctual light may reach every piece",
            "a punctual light may reach some pieces",
        ]
    },
};

pub const NORMAL_MAPS: Condition = Condition {
    effect: Effect::NormalMaps,
    needs: Attributes::TANGENT,
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
    needs: 0,
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
    needs: 0,
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
    let Some(read) = item.map(map) else { return are_like(map.missing()) };
    let (texture, is_second) = read;
    let first = || texture.at(uvs(piece, is_second)[0]);
    is_looked_at(texture, samples) && are_like(first()) && is_plain_in(read, rule, item, piece)
}

/// Whether a light may reach a piece whose normals no map turns.
fn may_reach(item: &Prepared<'_>, piece: &Piece) -> bool {
    let surfaces = surfaces(piece);
    let (places, normals) = (surfaces.map_array(|of| of.world), surfaces.map_array(|of| of.normal));
    item.punctual.iter().any(|light| reaches(light, places, normals))
}

/// Whether something may arrive at a point between three places whose normal is between three normals. What is interpolated is off
/// by less than 2^-48 of the largest number at the corners.
fn reaches(light: &PunctualLight, places: [DVec3; 3], normals: [DVec3; 3]) -> bool {
    const MARGIN: f64 = 1.0 / (1u64 << 40) as f64;
    let at = light.at.truncate();
    let sum = |of: [DVec3; 3]| (of[0].abs() + of[1].abs() + of[2].abs()).element_sum();
    if light.at.w == 0.0 {
        let margin = sum(normals) * MARGIN;
        return normals.iter().any(|normal| normal.dot(at) + margin > 0.0);
    }
    let size = at.abs().element_sum() + sum(places);
    let [a, b, c] = places;
    let beside = (a.min(b).min(c) - at).max(at - a.max(b).max(c)).max(DVec3::ZERO);
    // The square of a distance may lose its last digits, not more.
    let is_far = beside.length() > light.range * (1.0 + MARGIN) + size * MARGIN;
    let is_behind = light.cone.is_some_and(|cone| {
        places.iter().all(|place| cone.ahead.dot(*place - at) + size * MARGIN <= 0.0)
    });
    let margin = sum(normals) * size * MARGIN;
    let faces = || {
        let towards = places.map(|place| at - place);
        normals.iter().any(|normal| towards.iter().any(|l| normal.dot(*l) + margin > 0.0))
    };
    !is_far && !is_behind && faces()
}

/// What is known of a piece of a physical surface.
pub fn see(rule: &Rule, item: &Prepared<'_>, piece: &Piece, samples: i64, facts: &mut Facts) {
    if rule.normal_maps.is_open() {
        facts.is_bumpy = !all_are(rule, item, piece, (samples, Map::Normal), Physical::is_flat);
    }
    if rule.punctual.is_open() && !rule.normal_maps.pays(facts.is_bumpy) {
        facts.is_reached = may_reach(item, piece);
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
        let emission = item.physical().map_or(DVec3::ZERO, |surface| surface.emission);
        let is_black = |texel: DVec3| emission * texel == DVec3::ZERO;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::punctual::Kind;
    use glam::DMat4;
    use rasterproof_core::angle::{turn_x, turn_y};
    use rasterproof_core::random::Rng;

    type Reaches = fn(&PunctualLight, [DVec3; 3], [DVec3; 3]) -> bool;

    /// How many of random triangles no light reaches by a condition, and at how many of these some arrives between the corners.
    fn tried(reaches: Reaches) -> [u32; 2] {
        let mut rng = Rng::new("punctual", 1, 0);
        let mut counts = [0; 2];
        for _ in 0..6000 {
            let mut point = || DVec3::new(rng.signed(), rng.signed(), rng.signed());
            let (middle, facing, move_by, turn) = (point(), point(), point(), point());
            let [places, normals] = [(middle, 0.4), (facing, 0.6)]
                .map(|(middle, size)| [0; 3].map(|_| middle + point() * size));
            let range = [f64::INFINITY, 0.3, 0.7][rng.int(0, 2) as usize];
            let outer_rad = 0.2 + rng.unit();
            let kind = [
                Kind::Directional,
                Kind::Point { range },
                Kind::Spot { range, inner_rad: 0.1, outer_rad },
            ][rng.int(0, 2) as usize];
            let turn = turn_y(3.0 * turn.x) * turn_x(3.0 * turn.y);
            let light = PunctualLight::new(kind, DVec3::ONE, 1.0)
                .placed(DMat4::from_translation(move_by) * turn);
            let mut is_reached = false;
            for i in 0..=12 {
                for j in 0..=12 - i {
                    let (i, j) = (f64::from(i) / 12.0, f64::from(j) / 12.0);
                    let at = |[a, b, c]: [DVec3; 3]| a + (b - a) * i + (c - a) * j;
                    let (towards, arriving) = light.arriving_at(at(places));
                    is_reached |= arriving * at(normals).dot(towards) > 0.0;
                }
            }
            let is_left_out = !reaches(&light, places, normals);
            counts[0] += u32::from(is_left_out);
            counts[1] += u32::from(is_left_out && is_reached);
        }
        counts
    }

    #[test]
    fn nothing_arrives_where_a_light_is_left_out() {
        let [known, wrong] = tried(reaches);
        assert!(known > 1500 && wrong == 0, "{known}, {wrong}");
        // Wrong ones: corner by corner, the range of the corners alone, and a cone that reaches no farther than its corners see.
        let own: Reaches = |light, places, normals| {
            (0..3).any(|i| reaches(light, [places[i]; 3], [normals[i]; 3]))
        };
        let corners: Reaches =
            |light, places, normals| places.into_iter().any(|of| reaches(light, [of; 3], normals));
        let first: Reaches = |light, places, normals| reaches(light, places, [normals[0]; 3]);
        let seen: Reaches = |light, places, normals| {
            reaches(light, places, normals)
                && places.iter().any(|of| light.arriving_at(*of).1 > 0.0)
        };
        for (number, condition) in [own, corners, first, seen].into_iter().enumerate() {
            assert!(tried(condition)[1] > 0, "wrong condition {number} survives");
        }
    }
}
