//! Punctual lights: what arrives from directions, points and cones.
//!
//! Left out where the scene has none or the surface is not physical, and for a piece that none of them reaches ([`reaches`]):
//!
//! - all of it is farther away than the light's range, or lies behind a cone, whose light is 0 there, or
//! - every normal faces away from the light everywhere: for places p and normals n of the corners, all nine n.(l - p) are at most
//!   0. Between the corners both are means by the same weights, so the product is a mean of the nine. Not where a map turns normals.

use super::account::Condition;
use crate::effects::Effect;
use crate::effects::plan::Attributes;
use crate::effects::primitive::{Piece, Prepared, punctual};
use crate::pipeline::punctual::PunctualLight;
use crate::pipeline::shade::Surface;
use glam::DVec3;
use rasterproof_core::arrays::MapArray as _;

/// Without normals no light arrives.
pub const CONDITION: Condition = Condition {
    effect: Effect::Punctual,
    is_possible: |asked| {
        !punctual(asked.scene, asked.item).is_empty() && asked.carries.has(Attributes::NORMAL)
    },
    is_asked_for: |asked| !punctual(asked.scene, asked.item).is_empty(),
    missing: |asked| {
        asked.item.material.physical.as_ref().map(|_| ("the scene has no punctual lights", false))
    },
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

/// Whether a light may reach a piece whose normals no map turns.
pub fn may_reach(item: &Prepared<'_>, piece: &Piece) -> bool {
    let surfaces = piece.vertices.map_array(|vertex| Surface::from(vertex.varying));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::punctual::Kind;
    use glam::DMat4;
    use rasterproof_core::angle::{turn_x, turn_y};
    use rasterproof_verify::cases::Rng;

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
