//! Scenes: meshes, materials, a light, an eye; what is drawn, without a word about how.
//!
//! [`chapters`] rebuilds the book's scenes; [`shapes`] and [`textures`] make what they consist of. Nothing here draws.

pub mod chapters;
pub mod effects;
mod entry;
pub mod meshes;
pub mod random;
pub mod shapes;
pub mod textures;
mod triangles;

use std::num::NonZeroU32;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3};

use crate::pipeline::assemble::Cull;
use crate::pipeline::fog::Fog;
use crate::pipeline::highlight::Specular;
use crate::pipeline::opacity::Opacity;
use crate::pipeline::physical::{Map, Physical, TextureRead};
use crate::pipeline::punctual::PunctualLight;
use crate::pipeline::shade::Light;
use crate::pipeline::target::Colour;
use crate::pipeline::texture::Texture;
pub use triangles::{Attribute, Normals, Triangles};

#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Corner {
    pub position: u32,
    /// Its colour, each channel in [0, 1].
    pub colour: DVec3,
    /// Its normal, of any length; 0 where there is none.
    pub normal: DVec3,
    /// Its texture coordinates, v up.
    pub uv: DVec2,
}

#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Mesh {
    /// Positions in object space, which copies of the mesh share until one of them changes.
    pub positions: Arc<Vec<DVec3>>,
    pub triangles: Triangles,
}

impl Mesh {
    /// The normal of a triangle that is counter-clockwise from the outside, by the numbers of its positions:
    /// of length twice its area.
    #[must_use]
    pub fn face_normal(&self, positions: [u32; 3]) -> DVec3 {
        triangles::face_normal(positions.map(|number| self.positions[number as usize]))
    }

    /// Smallest and largest coordinates of the positions that triangles use; nothing without any.
    #[must_use]
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let used = self.triangles.positions().as_flattened().iter();
        used.map(|&number| self.positions[number as usize]).fold(None, |bounds, p| {
            let (min, max) = bounds.unwrap_or((p, p));
            Some((min.min(p), max.max(p)))
        })
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum Shading {
    /// Not at all: colours and texture as they are.
    #[default]
    Unlit,
    /// Once for each triangle, by its face normal.
    Flat,
    /// At the corners; the light is interpolated.
    Gouraud,
    /// At each fragment; the normal is interpolated and brought back to length 1.
    Phong,
}

impl Shading {
    pub const ALL: [Self; 4] = [Self::Unlit, Self::Flat, Self::Gouraud, Self::Phong];

    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unlit => "unlit",
            Self::Flat => "flat",
            Self::Gouraud => "gouraud",
            Self::Phong => "phong",
        }
    }
}

#[derive(Clone, Debug, serde::Serialize)]
pub struct Material {
    /// Everything is multiplied by this, each channel in [0, 1].
    pub colour: DVec3,
    /// Whether the colours of the corners are multiplied in.
    pub vertex_colours: bool,
    pub texture: Option<Arc<Texture>>,
    pub shading: Shading,
    /// Its highlights, with flat and Phong shading.
    pub specular: Specular,
    /// Nothing where all of it is opaque.
    pub opacity: Option<Opacity>,
    /// Of a surface in linear light, as all of its colours are then too, and its texture is read in.
    pub physical: Option<Arc<Physical>>,
}

impl Material {
    /// The maps of a physical surface that it has, beside its texture.
    pub fn maps(&self) -> impl Iterator<Item = TextureRead<'_>> {
        self.physical.iter().flat_map(|of| Map::ALL.into_iter().filter_map(|map| of.sampled(map)))
    }

    /// All that is read at texture coordinates but opacities.
    pub fn textures(&self) -> impl Iterator<Item = &Texture> {
        self.texture.as_deref().into_iter().chain(self.maps().map(|(map, _)| map))
    }

    #[must_use]
    pub fn has_second_uvs(&self) -> bool {
        self.maps().any(|(_, is_second)| is_second)
    }

    /// Whether its opacity is read at texture coordinates.
    #[must_use]
    pub fn has_opacity_map(&self) -> bool {
        self.opacity.as_ref().is_some_and(|opacity| opacity.map.is_some())
    }
}

impl Default for Material {
    fn default() -> Self {
        let shading = Shading::Unlit;
        let specular = Specular::default();
        let (texture, opacity, physical) = (None, None, None);
        Self {
            colour: DVec3::ONE,
            vertex_colours: false,
            texture,
            shading,
            specular,
            opacity,
            physical,
        }
    }
}

/// One mesh in the world.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Item {
    pub mesh: Arc<Mesh>,
    /// From object to world space.
    pub model: DMat4,
    pub material: Material,
    /// Which windings are left out, as the eye sees them.
    pub cull: Cull,
    /// Whether triangles that are clockwise as the eye sees them are lit with their normals reversed.
    pub two_sided: bool,
}

impl Item {
    /// A mesh where it is, of a material, both sides visible and lit by the same normals.
    #[must_use]
    pub fn new(mesh: Mesh, material: Material) -> Self {
        let (mesh, model, cull) = (Arc::new(mesh), DMat4::IDENTITY, Cull::None);
        Self { mesh, model, material, cull, two_sided: false }
    }
}

/// How what is hidden is found out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum Hidden {
    /// By a depth buffer (section 6.2).
    #[default]
    DepthBuffer,
    /// By drawing triangles from the farthest to the nearest, by the mean depth of their corners
    /// (the painter's algorithm, section 6.1).
    Painter,
}

/// The map of what the light sees, from which shadows are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Shadows {
    pub size: u32,
    /// In how many bits it holds a depth: whole steps from 0 to 1.
    pub bits: u32,
}

impl Default for Shadows {
    fn default() -> Self {
        Self { size: 1024, bits: 32 }
    }
}

#[derive(Clone, Debug, serde::Serialize)]
pub struct Scene {
    #[serde(skip)]
    pub name: String,
    #[serde(skip)]
    pub about: String,
    /// What is in it, in drawing order.
    pub items: Vec<Item>,
    /// From world to camera space.
    pub view: DMat4,
    /// From camera to clip space.
    pub projection: DMat4,
    /// The light, in world space.
    pub light: Light,
    /// What lights physical surfaces instead of what a surface that faces `light` gets; ambient light stays.
    pub punctual: Vec<PunctualLight>,
    /// Whether surfaces keep the light from others, and by what map.
    pub shadows: Option<Shadows>,
    /// What makes far things fade. Only with a projection whose z and w depend on the distance alone.
    pub fog: Option<Fog>,
    /// The colour of pixels that no triangle covers.
    pub background: Colour,
    /// How what is hidden is found out.
    pub hidden: Hidden,
    /// How many mixed fragments a sample shows at most, in the order of their depths; without a number they are mixed
    /// in the order of drawing.
    pub layers: Option<NonZeroU32>,
    /// Whether attributes are interpolated linearly in the window, whatever w is: the fault of the
    /// book's section 5.3.
    pub affine: bool,
}

impl Scene {
    /// An empty scene, seen from the origin.
    #[must_use]
    pub fn new(name: &str, about: &str, projection: DMat4) -> Self {
        Self {
            name: name.to_owned(),
            about: about.to_owned(),
            items: Vec::new(),
            view: DMat4::IDENTITY,
            projection,
            light: Light::NONE,
            punctual: Vec::new(),
            shadows: None,
            fog: None,
            background: [18, 18, 24, u8::MAX],
            hidden: Hidden::DepthBuffer,
            layers: None,
            affine: false,
        }
    }

    #[must_use]
    pub fn triangles(&self) -> usize {
        self.items.iter().map(|item| item.mesh.triangles.len()).sum()
    }
}
