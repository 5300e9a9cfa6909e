//! A digest of a scene, by which the plan of another one is recognized.

use std::{fmt, io};

use serde::{Deserialize, Serialize};

use crate::scene::Scene;

/// 64 bits of all that a plan depends on in a scene: whatever of it is serialized. Those are neither its names nor the texels
/// of its textures.
///
/// It recognizes a mistake. It is no protection from somebody who looks for two scenes with one digest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct SceneDigest(u64);

impl SceneDigest {
    /// The digest of a scene.
    ///
    /// # Panics
    /// Never: lists and structs have a form in bytes, and nothing is written.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        Self(postcard::to_io(scene, Words(0)).expect("a scene has a form in bytes").0)
    }
}

impl fmt::Display for SceneDigest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

impl From<SceneDigest> for String {
    fn from(digest: SceneDigest) -> Self {
        digest.to_string()
    }
}

impl TryFrom<String> for SceneDigest {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let is_hex = text.len() == 16 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let digest = u64::from_str_radix(&text, 16).ok().filter(|_| is_hex);
        digest.map(Self).ok_or("a digest of a scene has 16 hexadecimal digits")
    }
}

/// Words mixed into one, each by the finalizer of SplitMix64 (Steele, Lea, Flood 2014).
struct Words(u64);

impl io::Write for Words {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        for bytes in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..bytes.len()].copy_from_slice(bytes);
            let z = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15) ^ u64::from_le_bytes(word);
            let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            self.0 = z ^ (z >> 31);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use glam::{DMat4, DVec2, DVec3};

    use super::*;
    use crate::pipeline::assemble::Cull;
    use crate::pipeline::fog::{Fog, Growth};
    use crate::pipeline::opacity::{AlphaMode, Opacity};
    use crate::pipeline::physical::Physical;
    use crate::pipeline::punctual::{Kind, PunctualLight};
    use crate::scene::{Attribute, Hidden, Item, Material, Shading, Shadows, shapes};

    #[test]
    fn whatever_a_plan_depends_on_changes_the_digest() {
        let mesh = || shapes::quad([DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y]);
        let scene = || {
            let mut scene = Scene::new("a", "", DMat4::IDENTITY);
            scene.items = vec![Item::new(mesh(), Material::default())];
            scene
        };
        let digest = SceneDigest::of(&scene());
        let renamed = Scene { name: "b".to_owned(), ..scene() };
        assert_eq!(SceneDigest::of(&renamed), digest);
        type Change = fn(&mut Scene);
        let changes: [(&str, Change); 19] = [
            ("in shadow", |scene| scene.shadows = Some(Shadows::default())),
            ("turned", |scene| scene.items[0].model = rasterproof_core::angle::turn_y(0.1)),
            ("another eye", |scene| scene.view = rasterproof_core::angle::turn_x(0.1)),
            ("another angle of view", |scene| scene.projection.x_axis.x = 2.0),
            ("lit", |scene| scene.light.ambient = 0.5),
            ("in fog", |scene| {
                let growth = Growth::Exponential { density: 0.5 };
                scene.fog = Some(Fog { colour: [0; 3], growth });
            }),
            ("shading", |scene| scene.items[0].material.shading = Shading::Phong),
            ("shiny", |scene| scene.items[0].material.specular.shininess = 10.0),
            ("emission", |scene| {
                let physical = Physical { emission: DVec3::X, ..Physical::default() };
                scene.items[0].material.physical = Some(std::sync::Arc::new(physical));
            }),
            ("cut out", |scene| {
                let mode = AlphaMode::Test { threshold: 0.5 };
                let opacity = Opacity { factor: 1.0, map: None, mode };
                scene.items[0].material.opacity = Some(opacity);
            }),
            ("a light of its own", |scene| {
                let light = PunctualLight::new(Kind::Directional, DVec3::ONE, 1.0);
                scene.punctual.push(light);
            }),
            ("tangents", |scene| {
                let mesh = std::sync::Arc::unwrap_or_clone(scene.items[0].mesh.clone());
                scene.items[0].mesh = std::sync::Arc::new(shapes::with_tangents(mesh));
            }),
            ("second texture coordinates", |scene| {
                let mesh = std::sync::Arc::make_mut(&mut scene.items[0].mesh);
                let uvs = Attribute::Same(DVec2::ZERO);
                mesh.triangles = std::mem::take(&mut mesh.triangles).with_second_uvs(uvs);
            }),
            ("culled", |scene| scene.items[0].cull = Cull::Clockwise),
            ("lit from both sides", |scene| scene.items[0].two_sided = true),
            ("painted", |scene| scene.hidden = Hidden::Painter),
            ("in layers", |scene| scene.layers = std::num::NonZeroU32::new(4)),
            ("twice", |scene| scene.items.push(scene.items[0].clone())),
            ("a colour of a corner", |scene| {
                let mesh = std::sync::Arc::make_mut(&mut scene.items[0].mesh);
                mesh.triangles.change(1, |corners| corners[2].colour.x = 0.5);
            }),
        ];
        for (what, change) in changes {
            let mut other = scene();
            change(&mut other);
            assert_ne!(SceneDigest::of(&other), digest, "{what}");
        }
    }

    #[test]
    fn a_digest_is_read_as_it_is_written() {
        let digest = SceneDigest(0x0123_4567_89ab_cdef);
        let text = serde_json::to_string(&digest).unwrap();
        assert_eq!(text, "\"0123456789abcdef\"");
        assert_eq!(serde_json::from_str::<SceneDigest>(&text).unwrap(), digest);
        for wrong in ["\"\"", "\"+123456789abcdef\"", "\"12\"", "12"] {
            assert!(serde_json::from_str::<SceneDigest>(wrong).is_err(), "{wrong}");
        }
    }
}
