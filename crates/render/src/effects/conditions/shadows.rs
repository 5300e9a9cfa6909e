//! Shadows: which part of the light arrives, looked up in each fragment, and the shadow map.
//!
//! Left out where the scene has none or the item has no light to lose, and for a piece
//!
//! - that faces away from the light everywhere and has no highlight: what is multiplied is 0, and
//! - before which nothing lies ([`LightView::may_be_shadowed`]): all nine parts of the light arrive, and the factor is 1.
//!
//! The map is drawn when the first piece reads it, so that a frame without one does not pay for it.
//!
//! [`LightView::may_be_shadowed`]: crate::pipeline::shadow::LightView::may_be_shadowed

use super::account::Condition;
use super::{Facts, fog, samples_of};
use crate::effects::Effect;
use crate::effects::assembled::Assembled;
use crate::effects::plan::{Attributes, Rule};
use crate::effects::primitive::{Piece, Prepared, is_lit, light, surfaces};
use crate::pipeline::shade::Light;
use crate::scene::{Item, Scene};
use glam::DVec3;
use rasterproof_core::arrays::MapArray as _;

/// Without a map or normals there is no shadow.
pub const CONDITION: Condition = Condition {
    effect: Effect::Shadows,
    needs: Attributes::PLACE,
    is_possible: |asked| asked.scene.shadows.is_some() && asked.carries.has(Attributes::NORMAL),
    is_asked_for: |asked| asked.scene.shadows.is_some() && has_light(asked.scene, asked.item),
    missing: |asked| {
        Some(match asked.scene.shadows {
            None => ("the scene has no shadow map", false),
            Some(_) => ("the material has no light of its fragments to lose", true),
        })
    },
    by_material: "the scene has a shadow map",
    open: "where something may lie before the light",
    reasons: |_| {
        [
            "nothing lies between the item and the light, or it faces away",
            "something may lie between every piece and the light",
            "something may lie between some pieces and the light",
        ]
    },
};

fn has_light(scene: &Scene, item: &Item) -> bool {
    is_lit(scene, item) && light(scene, item).diffuse != 0.0
}

/// Samples that a piece covers at least where it is searched what may keep light from it: a smaller one looks the light up in less
/// time.
const LEAST_SEARCHED: i64 = 48;

/// The same where another piece needs the map anyway, so that a search saves lookups and no map.
const LEAST_SEARCHED_BESIDES: i64 = 128;

/// So many samples for each triangle of the scene are in pieces that might be searched, before one is: to list the triangles takes
/// longer than fewer lookups.
const LEAST_FOR_A_TRIANGLE: u64 = 32;

/// Triangles at most that are looked at for one that needs the map.
const LOOKED_AT: usize = 256;

/// Whether a piece with these facts asks what may keep light from it.
fn asks(rule: &Rule, facts: &Facts) -> bool {
    rule.shadows.is_open() && facts.is_shadowed && !fog::hides(rule, facts)
}

/// Notes that the map is needed where a lit piece is too small to be searched, and how many samples others have.
fn foresee(rule: &Rule, item: &Prepared<'_>, piece: &Piece, facts: &Facts) {
    let (true, Some(view)) = (asks(rule, facts), &item.light_view) else { return };
    match samples_of(piece) {
        ..LEAST_SEARCHED => view.need(),
        LEAST_SEARCHED..LEAST_SEARCHED_BESIDES => {}
        samples => _ = view.wait(samples as u64),
    }
}

/// Looks for what may keep light from a piece.
pub fn search(rule: &Rule, scene: &Scene, item: &Prepared<'_>, piece: &Piece, facts: &mut Facts) {
    let (true, Some(view)) = (asks(rule, facts), &item.light_view) else { return };
    let samples = samples_of(piece);
    let is_searched = if view.is_needed() {
        let all = LEAST_FOR_A_TRIANGLE * scene.triangles() as u64;
        samples >= LEAST_SEARCHED_BESIDES && view.wait(samples as u64) >= all
    } else {
        samples >= LEAST_SEARCHED
    };
    let places = || surfaces(piece).map_array(|of| of.place);
    facts.is_shadowed = !is_searched || view.may_be_shadowed(scene, places());
    if facts.is_shadowed {
        view.need();
    }
}

/// The same of all pieces of a scene.
pub fn search_all(scene: &Scene, rules: &[Rule], assembled: &Assembled<'_>, facts: &mut [Facts]) {
    let pieces =
        || assembled.pieces().iter().map(|(i, piece)| (&rules[*i], &assembled.items[*i], piece));
    for ((rule, item, piece), facts) in pieces().zip(&*facts) {
        foresee(rule, item, piece, facts);
    }
    for ((rule, item, piece), facts) in pieces().zip(facts) {
        search(rule, scene, item, piece, facts);
    }
}

/// Looks at the first triangles of pieces that are drawn as they come, for one that needs the map.
pub fn look_ahead(scene: &Scene, item: &Prepared<'_>, rule: &Rule) {
    let Some(view) = item.light_view.as_ref().filter(|_| rule.shadows.is_open()) else { return };
    for triangle in 0..item.item.mesh.triangles.len().min(LOOKED_AT) {
        if view.is_needed() {
            return;
        }
        item.assemble_one(scene, triangle, &mut |piece| {
            foresee(rule, item, piece, &Facts::of(rule, item, piece));
        });
    }
}

pub fn piece_faces_away(item: &Prepared<'_>, piece: &Piece) -> bool {
    let normals = surfaces(piece).map_array(|of| of.normal);
    faces_away(&item.light, normals)
}

/// Whether the light is 0 at every normal between three. One normal is the same in each fragment; others are
/// interpolated with errors below 2^-48 of the largest component, as in
/// [`crate::pipeline::highlight::Highlight::is_dark_between`].
fn faces_away(light: &Light, normals: [DVec3; 3]) -> bool {
    let [a, b, c] = normals;
    let margin = if a == b && b == c {
        0.0
    } else {
        (a.abs() + b.abs() + c.abs()).element_sum() * 0.5f64.powi(40)
    };
    normals.iter().all(|normal| normal.dot(light.towards) + margin <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::highlight::{Highlight, Specular};
    use rasterproof_core::random::Rng;

    type Condition = fn(&Light, [DVec3; 3]) -> bool;

    /// How many of random triangles face away by a condition, and for how many of these a shadow changes the light at
    /// a normal between the corners.
    fn tried(condition: Condition) -> [u32; 2] {
        let mut rng = Rng::new("facing away", 1, 0);
        let mut counts = [0; 2];
        for _ in 0..4000 {
            let spread = rng.unit();
            let mut point = || DVec3::new(rng.signed(), rng.signed(), rng.signed());
            let light =
                Light { towards: point().normalize_or(DVec3::Z), ambient: 0.25, diffuse: 0.75 };
            let centre = point();
            let normals = [0; 3].map_array(|_| centre + point() * spread);
            let mut is_lit = false;
            for i in 0..=12 {
                for j in 0..=12 - i {
                    let (i, j) = (f64::from(i) / 12.0, f64::from(j) / 12.0);
                    let [a, b, c] = normals;
                    let normal = a + (b - a) * i + (c - a) * j;
                    is_lit |= light.intensity_in(normal, 0) != light.intensity_in(normal, 9);
                }
            }
            let holds = condition(&light, normals);
            counts[0] += u32::from(holds);
            counts[1] += u32::from(holds && is_lit);
        }
        counts
    }

    #[test]
    fn what_faces_away_has_no_light_to_lose() {
        let [known, wrong] = tried(faces_away);
        assert!(known > 1000 && wrong == 0, "{known}, {wrong}");
        let mean: Condition = |light, [a, b, c]| faces_away(light, [a + b + c; 3]);
        let first: Condition = |light, [a, _, _]| faces_away(light, [a; 3]);
        for (number, condition) in [mean, first].into_iter().enumerate() {
            assert!(tried(condition)[1] > 0, "wrong condition {number} survives");
        }
        // One that forgets highlights: they are halfway to the eye, and reach beyond where the light does.
        let light = Light { towards: DVec3::X, ambient: 0.0, diffuse: 1.0 };
        let specular = Specular { colour: DVec3::ONE, shininess: 2.0 };
        let normal = DVec3::new(-0.2, 0.0, 1.0);
        assert!(faces_away(&light, [normal; 3]));
        assert_ne!(Highlight::new(&specular, &light, DVec3::Z).at(normal), [0; 3]);
    }
}
