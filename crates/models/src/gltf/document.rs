//! What is read of a glTF document. Members that change no triangle and no colour are left out, and so is every rule that
//! a document may break without becoming ambiguous.

use std::collections::HashMap;

use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer};
use serde_json::Value;

/// The default of a member that is missing or null.
fn or_default<'de, D: Deserializer<'de>, T: Deserialize<'de> + Default>(
    from: D,
) -> Result<T, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or_default())
}

/// Reads a document. Some programs write whole numbers with a fraction, as `3.0`, which JavaScript does not tell from `3`. Those
/// are written again and read once more: reading the value itself would compile all that is read a second time.
pub(super) fn read(json: &[u8]) -> Result<Root, serde_json::Error> {
    serde_json::from_slice(json).or_else(|error| {
        let whole = serde_json::from_slice(json).map(whole_numbers);
        let json = whole.and_then(|document| serde_json::to_vec(&document));
        json.and_then(|json| serde_json::from_slice(&json)).map_err(|_| error)
    })
}

/// The same value with whole numbers where a fraction is 0.
fn whole_numbers(value: Value) -> Value {
    match value {
        Value::Number(number) => {
            let whole = number.as_f64().filter(|of| of.fract() == 0.0 && of.abs() < 1e15);
            // Others are whole already.
            whole.filter(|_| number.is_f64()).map_or(number.into(), |of| (of as i64).into())
        }
        Value::Array(values) => values.into_iter().map(whole_numbers).collect(),
        Value::Object(members) => {
            members.into_iter().map(|(name, value)| (name, whole_numbers(value))).collect()
        }
        other => other,
    }
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Root {
    /// Every document has it, and no other JSON.
    #[serde(rename = "asset")]
    _asset: Asset,
    pub scene: Option<usize>,
    #[serde(default, deserialize_with = "or_default")]
    pub scenes: Vec<Scene>,
    #[serde(default, deserialize_with = "or_default")]
    pub nodes: Vec<Node>,
    #[serde(default, deserialize_with = "or_default")]
    pub meshes: Vec<Mesh>,
    #[serde(default, deserialize_with = "or_default")]
    pub skins: Vec<Skin>,
    #[serde(default, deserialize_with = "or_default")]
    pub materials: Vec<Material>,
    #[serde(default, deserialize_with = "or_default")]
    pub textures: Vec<Texture>,
    #[serde(default, deserialize_with = "or_default")]
    pub images: Vec<Image>,
    #[serde(default, deserialize_with = "or_default")]
    pub samplers: Vec<Sampler>,
    #[serde(default, deserialize_with = "or_default")]
    pub accessors: Vec<Accessor>,
    #[serde(default, deserialize_with = "or_default")]
    pub buffer_views: Vec<View>,
    #[serde(default, deserialize_with = "or_default")]
    pub buffers: Vec<Buffer>,
    #[serde(default, deserialize_with = "or_default")]
    pub cameras: Vec<Camera>,
    #[serde(default, deserialize_with = "or_default")]
    pub animations: Vec<Value>,
    #[serde(default, deserialize_with = "or_default")]
    pub extensions: Value,
    #[serde(default, deserialize_with = "or_default")]
    pub extensions_used: Vec<String>,
    #[serde(default, deserialize_with = "or_default")]
    pub extensions_required: Vec<String>,
}

#[derive(Deserialize)]
struct Asset {
    #[serde(rename = "version")]
    _version: IgnoredAny,
}

#[derive(Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub nodes: Vec<usize>,
}

#[derive(Deserialize)]
pub(super) struct Node {
    pub name: Option<String>,
    #[serde(default, deserialize_with = "or_default")]
    pub children: Vec<usize>,
    pub mesh: Option<usize>,
    pub skin: Option<usize>,
    pub camera: Option<usize>,
    pub matrix: Option<[f32; 16]>,
    pub translation: Option<[f32; 3]>,
    pub rotation: Option<[f32; 4]>,
    pub scale: Option<[f32; 3]>,
    pub weights: Option<Vec<f32>>,
    #[serde(default, deserialize_with = "or_default")]
    pub extensions: Extensions,
}

/// The extensions of nodes, primitives, materials and textures that are read or counted.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Extensions {
    #[serde(rename = "KHR_lights_punctual")]
    pub light: Option<Value>,
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instances: Option<Instances>,
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub draco: Option<Value>,
    #[serde(rename = "KHR_materials_unlit")]
    pub unlit: Option<IgnoredAny>,
    #[serde(rename = "KHR_materials_pbrSpecularGlossiness")]
    pub glossiness: Option<Glossiness>,
    #[serde(rename = "KHR_materials_common")]
    pub common: Option<IgnoredAny>,
    #[serde(rename = "KHR_materials_emissive_strength")]
    pub emissive: Option<EmissiveStrength>,
    #[serde(rename = "KHR_materials_ior")]
    pub refraction: Option<Refraction>,
    #[serde(rename = "KHR_materials_specular")]
    pub specular: Option<Specular>,
}

/// A light of `KHR_lights_punctual`; one that cannot be read is counted as not drawn.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Light {
    #[serde(rename = "type")]
    pub kind: String,
    pub color: Option<[f32; 3]>,
    pub intensity: Option<f32>,
    pub range: Option<f32>,
    #[serde(deserialize_with = "or_default")]
    pub spot: Spot,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Spot {
    pub inner_cone_angle: Option<f64>,
    pub outer_cone_angle: Option<f64>,
}

/// The accessors of where the copies of a mesh are.
#[derive(Deserialize)]
pub(super) struct Instances {
    pub attributes: HashMap<String, usize>,
}

#[derive(Deserialize)]
pub(super) struct Camera {
    pub name: Option<String>,
    pub perspective: Option<Perspective>,
    pub orthographic: Option<Orthographic>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Perspective {
    pub yfov: f64,
    pub znear: f64,
    pub zfar: Option<f64>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Orthographic {
    pub ymag: f64,
    pub znear: f64,
    pub zfar: f64,
}

#[derive(Deserialize)]
pub(super) struct Mesh {
    pub primitives: Vec<Primitive>,
    pub weights: Option<Vec<f32>>,
}

#[derive(Deserialize)]
pub(super) struct Primitive {
    pub attributes: HashMap<String, usize>,
    pub indices: Option<usize>,
    pub material: Option<usize>,
    /// [`TRIANGLES`] where there is none.
    pub mode: Option<u64>,
    #[serde(default, deserialize_with = "or_default")]
    pub targets: Vec<Target>,
    #[serde(default, deserialize_with = "or_default")]
    pub extensions: Extensions,
}

pub(super) const POINTS: u64 = 0;
pub(super) const LINES: u64 = 1;
pub(super) const LINE_LOOP: u64 = 2;
pub(super) const LINE_STRIP: u64 = 3;
pub(super) const TRIANGLES: u64 = 4;
pub(super) const TRIANGLE_STRIP: u64 = 5;
pub(super) const TRIANGLE_FAN: u64 = 6;

/// The accessors of what a shape (morph target) adds to each vertex.
#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) struct Target {
    pub position: Option<usize>,
    pub normal: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Skin {
    pub joints: Vec<usize>,
    pub inverse_bind_matrices: Option<usize>,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Material {
    pub name: Option<String>,
    #[serde(default, deserialize_with = "or_default")]
    pub alpha_mode: String,
    pub alpha_cutoff: Option<f32>,
    #[serde(default, deserialize_with = "or_default")]
    pub double_sided: bool,
    #[serde(default, deserialize_with = "or_default")]
    pub pbr_metallic_roughness: Metallic,
    pub normal_texture: Option<Info>,
    pub occlusion_texture: Option<Info>,
    pub emissive_texture: Option<Info>,
    #[serde(default, deserialize_with = "or_default")]
    pub emissive_factor: [f32; 3],
    #[serde(default, deserialize_with = "or_default")]
    pub extensions: Extensions,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Metallic {
    pub base_color_factor: [f32; 4],
    pub base_color_texture: Option<Info>,
    pub metallic_factor: f32,
    pub roughness_factor: f32,
    pub metallic_roughness_texture: Option<Info>,
}

impl Default for Metallic {
    fn default() -> Self {
        Self {
            base_color_factor: [1.0; 4],
            base_color_texture: None,
            metallic_factor: 1.0,
            roughness_factor: 1.0,
            metallic_roughness_texture: None,
        }
    }
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Glossiness {
    pub diffuse_factor: [f32; 4],
    pub diffuse_texture: Option<Info>,
    pub specular_factor: [f32; 3],
    pub glossiness_factor: f32,
    pub specular_glossiness_texture: Option<IgnoredAny>,
}

impl Default for Glossiness {
    fn default() -> Self {
        Self {
            diffuse_factor: [1.0; 4],
            diffuse_texture: None,
            specular_factor: [1.0; 3],
            glossiness_factor: 1.0,
            specular_glossiness_texture: None,
        }
    }
}

/// Which texture a material reads, and by which texture coordinates.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Info {
    pub index: usize,
    #[serde(default)]
    pub tex_coord: u32,
    /// Of a normal map: what x and y are multiplied by.
    pub scale: Option<f32>,
    /// Of an occlusion map, from 0 to 1.
    pub strength: Option<f32>,
    #[serde(default, deserialize_with = "or_default")]
    pub extensions: InfoExtensions,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct EmissiveStrength {
    pub emissive_strength: f32,
}

impl Default for EmissiveStrength {
    fn default() -> Self {
        Self { emissive_strength: 1.0 }
    }
}

#[derive(Deserialize)]
#[serde(default)]
pub(super) struct Refraction {
    pub ior: f32,
}

impl Default for Refraction {
    fn default() -> Self {
        Self { ior: 1.5 }
    }
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Specular {
    pub specular_factor: f32,
    pub specular_color_factor: [f32; 3],
    pub specular_texture: Option<IgnoredAny>,
    pub specular_color_texture: Option<IgnoredAny>,
}

impl Default for Specular {
    fn default() -> Self {
        Self {
            specular_factor: 1.0,
            specular_color_factor: [1.0; 3],
            specular_texture: None,
            specular_color_texture: None,
        }
    }
}

#[derive(Default, Deserialize)]
pub(super) struct InfoExtensions {
    #[serde(rename = "KHR_texture_transform")]
    pub transform: Option<Transform>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Transform {
    pub offset: [f32; 2],
    pub rotation: f32,
    pub scale: [f32; 2],
    pub tex_coord: Option<u32>,
}

impl Default for Transform {
    fn default() -> Self {
        Self { offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2], tex_coord: None }
    }
}

#[derive(Deserialize)]
pub(super) struct Texture {
    pub sampler: Option<usize>,
    /// None where an extension names a picture of another kind.
    pub source: Option<usize>,
    #[serde(default, deserialize_with = "or_default")]
    pub extensions: TextureExtensions,
}

#[derive(Default, Deserialize)]
pub(super) struct TextureExtensions {
    #[serde(rename = "EXT_texture_webp")]
    pub webp: Option<Source>,
}

#[derive(Deserialize)]
pub(super) struct Source {
    pub source: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Image {
    pub uri: Option<String>,
    pub buffer_view: Option<usize>,
}

/// How a texture is read; filters and wrapping are numbers of OpenGL.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Sampler {
    pub mag_filter: Option<u64>,
    pub min_filter: Option<u64>,
    pub wrap_s: Option<u64>,
    pub wrap_t: Option<u64>,
}

pub(super) const NEAREST: u64 = 9728;
pub(super) const LINEAR: u64 = 9729;
pub(super) const NEAREST_MIPMAP_NEAREST: u64 = 9984;
pub(super) const LINEAR_MIPMAP_NEAREST: u64 = 9985;
pub(super) const NEAREST_MIPMAP_LINEAR: u64 = 9986;
pub(super) const LINEAR_MIPMAP_LINEAR: u64 = 9987;
pub(super) const CLAMP_TO_EDGE: u64 = 33_071;
pub(super) const MIRRORED_REPEAT: u64 = 33_648;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default, deserialize_with = "or_default")]
    pub byte_offset: u64,
    pub component_type: u64,
    #[serde(default)]
    pub normalized: bool,
    pub count: u64,
    #[serde(rename = "type")]
    pub form: String,
    pub sparse: Option<Sparse>,
}

/// Elements that differ from those of the buffer view.
#[derive(Deserialize)]
pub(super) struct Sparse {
    pub count: u64,
    pub indices: SparsePart,
    pub values: SparsePart,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparsePart {
    pub buffer_view: usize,
    #[serde(default)]
    pub byte_offset: u64,
    /// Values have the type of their accessor, and 0 here.
    #[serde(default)]
    pub component_type: u64,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    pub buffer: usize,
    pub byte_length: u64,
    #[serde(default, deserialize_with = "or_default")]
    pub byte_offset: u64,
    pub byte_stride: Option<usize>,
    #[serde(default, deserialize_with = "or_default")]
    pub extensions: ViewExtensions,
}

#[derive(Default, Deserialize)]
pub(super) struct ViewExtensions {
    #[serde(rename = "EXT_meshopt_compression")]
    pub compressed: Option<Compressed>,
}

/// Where the compressed bytes of a view are, and what they become.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Compressed {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: u64,
    pub byte_length: u64,
    pub byte_stride: usize,
    pub count: usize,
    pub mode: String,
    pub filter: Option<String>,
}

#[derive(Deserialize)]
pub(super) struct Buffer {
    pub uri: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_material_leaves_out_is_as_in_the_specification() {
        let glossiness: Glossiness = serde_json::from_str("{}").unwrap();
        assert_eq!((glossiness.diffuse_factor, glossiness.glossiness_factor), ([1.0; 4], 1.0));
        assert_eq!(glossiness.specular_factor, [1.0; 3]);
        let metallic: Metallic = serde_json::from_str("{}").unwrap();
        assert_eq!((metallic.metallic_factor, metallic.roughness_factor), (1.0, 1.0));
        let transform: Transform = serde_json::from_str("{}").unwrap();
        assert_eq!((transform.offset, transform.scale), ([0.0; 2], [1.0; 2]));
        assert_eq!((transform.rotation, transform.tex_coord), (0.0, None));
        let node: Node = serde_json::from_str(r#"{"children": null, "extensions": null}"#).unwrap();
        assert!(node.children.is_empty() && node.extensions.light.is_none());
    }
}
