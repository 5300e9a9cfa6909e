//! A digest of a scene, by which the plan of another one is recognized.

use std::fmt;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::pipeline::assemble::Cull;
use crate::pipeline::fog::{Fog, Growth};
use crate::pipeline::highlight::Specular;
use crate::pipeline::opacity::{AlphaMode, Opacity};
use crate::pipeline::physical::Physical;
use crate::pipeline::shade::Light;
use crate::scene::Shadows;
use crate::scene::{Corner, Hidden, Item, Material, Scene, Shading};

/// 64 bits of all that a plan depends on in a scene: meshes with their attributes, where they are and how
/// they are seen, materials, light, and how what is hidden is found out. The texels of a texture are not
/// among it, only whether there is one; nor are the names of the scene.
///
/// It recognizes a mistake. It is no protection from somebody who looks for two scenes with one digest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct SceneDigest(u64);

impl SceneDigest {
    /// The digest of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        // Every field is named, so that a new one is considered.
        let Scene {
            name: _,
            about: _,
            items,
            view,
            projection,
            light: Light { towards, ambient, diffuse },
            shadows,
            fog,
            background,
            hidden,
            layers,
            affine,
        } = scene;
        let mut words = Words(0);
        words.numbers(&view.to_cols_array());
        words.numbers(&projection.to_cols_array());
        words.point(*towards);
        words.numbers(&[*ambient, *diffuse]);
        if let Some(Shadows { size, bits }) = *shadows {
            words.whole(u64::from(size) << 32 | u64::from(bits));
        }
        if let Some(Fog { colour: [r, g, b], growth }) = *fog {
            let (kind, numbers) = match growth {
                Growth::Linear { start, end } => (1, [start, end]),
                Growth::Exponential { density } => (2, [density, 0.0]),
            };
            words.whole(u32::from_le_bytes([r, g, b, kind]).into());
            words.numbers(&numbers);
        }
        words.whole(u32::from_le_bytes(*background).into());
        words.whole(match hidden {
            Hidden::DepthBuffer => 0,
            Hidden::Painter => 1,
        });
        words.whole((*affine).into());
        if let Some(layers) = layers {
            words.whole(layers.get().into());
        }
        words.whole(items.len() as u64);
        for item in items {
            words.item(item);
        }
        Self(words.0)
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

impl Words {
    fn whole(&mut self, word: u64) {
        let z = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15) ^ word;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        self.0 = z ^ (z >> 31);
    }

    fn numbers(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|number| self.whole(number.to_bits()));
    }

    fn point(&mut self, point: DVec3) {
        self.numbers(&point.to_array());
    }

    fn item(&mut self, item: &Item) {
        let Item { mesh, model, material, cull, two_sided } = item;
        let Material { colour, vertex_colours, texture, shading, specular, opacity, physical } =
            material;
        self.numbers(&model.to_cols_array());
        self.point(*colour);
        self.whole((*vertex_colours).into());
        let has_mip_map = texture.as_ref().is_some_and(|texture| texture.has_mip_map());
        self.whole(u64::from(texture.is_some()) + u64::from(has_mip_map));
        let anisotropy = texture.as_ref().map_or(1, |texture| texture.anisotropy);
        if anisotropy > 1 {
            self.whole(anisotropy.into());
        }
        self.whole(match shading {
            Shading::Unlit => 0,
            Shading::Flat => 1,
            Shading::Gouraud => 2,
            Shading::Phong => 3,
        });
        // Of a scene without highlights the digest is what it was.
        if *specular != Specular::default() {
            self.point(specular.colour);
            self.numbers(&[specular.shininess]);
        }
        if let Some(physical) = physical {
            let Physical { metal, roughness, emission, occlusion, bumps, straight, grazing, maps } =
                &**physical;
            self.point(*emission);
            self.point(*straight);
            self.numbers(&[*metal, *roughness, *occlusion, *bumps, *grazing]);
            for map in maps {
                self.whole(map.as_ref().map_or(0, |map| 1 + u64::from(map.has_mip_map())));
            }
        }
        if let Some(Opacity { factor, map, mode }) = opacity {
            let (kind, threshold) = match *mode {
                AlphaMode::Test { threshold } => (1, threshold),
                AlphaMode::Blend => (2, 0.0),
            };
            self.whole(kind);
            self.numbers(&[*factor, threshold]);
            // A plan depends on the blocks of a map.
            let blocks = map.as_ref().map_or(&[][..], |map| map.blocks());
            self.whole(blocks.len() as u64);
            blocks.iter().for_each(|block| self.whole(u16::from_le_bytes(*block).into()));
        }
        self.whole(match cull {
            Cull::None => 0,
            Cull::Clockwise => 1,
            Cull::CounterClockwise => 2,
        });
        // Of a scene without such items the digest is what it was.
        if *two_sided {
            self.whole(1);
        }
        self.whole(mesh.positions.len() as u64);
        mesh.positions.iter().for_each(|position| self.point(*position));
        self.whole(mesh.triangles.len() as u64);
        for Corner { position, colour, normal, uv } in mesh.triangles.corners() {
            self.whole(position.into());
            self.point(colour);
            self.point(normal);
            self.numbers(&uv.to_array());
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DMat4;

    use super::*;
    use crate::scene::shapes;

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
        let changes: [(&str, Change); 16] = [
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
