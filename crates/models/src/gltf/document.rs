//! What is read of a glTF document. Members that change no triangle and no colour are left out, and so is every rule that
//! a document may break without becoming ambiguous.

use std::collections::HashMap;

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;

/// An entry of a list of the document, by its number.
pub(super) fn entry<'a, T>(list: &'a [T], name: &str, number: usize) -> Result<&'a T, String> {
    list.get(number).ok_or_else(|| format!("{name}[{number}] is not there"))
}

/// The version of a document, where it says one.
pub(super) fn version(json: &[u8]) -> Option<String> {
    #[derive(Deserialize)]
    struct Head {
        asset: Asset<Value>,
    }
    let Head { asset } = serde_json::from_slice(json).ok()?;
    Some(asset.version.as_str().map_or_else(|| asset.version.to_string(), str::to_owned))
}

#[derive(Deserialize)]
struct Asset<V> {
    version: V,
}

/// Reads a document. Some programs write whole numbers with a fraction, as `3.0`, which JavaScript does not tell from `3`, and
/// `null` for what is missing. Those are written again and read once more: reading the value itself would compile all that is
/// read a second time.
pub(super) fn read(json: &[u8]) -> Result<Root, serde_json::Error> {
    serde_json::from_slice(json).or_else(|error| {
        // The first error is said, for it has the line of the file.
        let usual = serde_json::from_slice(json).map(usual);
        let json = usual.and_then(|document| serde_json::to_vec(&document));
        json.and_then(|json| serde_json::from_slice(&json)).map_err(|_| error)
    })
}

/// The same value with whole numbers where a fraction is 0, and without members that are null.
fn usual(value: Value) -> Value {
    match value {
        Value::Number(number) => {
            let whole = number.as_f64().filter(|of| of.fract() == 0.0 && of.abs() < 1e15);
            // Others are whole already.
            whole.filter(|_| number.is_f64()).map_or(number.into(), |of| (of as i64).into())
        }
        Value::Array(values) => values.into_iter().map(usual).collect(),
        Value::Object(members) => {
            let there = members.into_iter().filter(|(_, value)| !value.is_null());
            there.map(|(name, value)| (name, usual(value))).collect()
        }
        other => other,
    }
}

/// A document: its lists, whose entries name each other by their numbers.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Root {
    /// Every document has it, and no other JSON.
    #[serde(rename = "asset")]
    _asset: Asset<IgnoredAny>,
    /// The scene to show; without one, the first.
    pub scene: Option<usize>,
    /// Each shows some of the nodes; usually there is one.
    #[serde(default)]
    pub scenes: Vec<Scene>,
    #[serde(default)]
    pub nodes: Vec<Node>,
    #[serde(default)]
    pub meshes: Vec<Mesh>,
    #[serde(default)]
    pub skins: Vec<Skin>,
    #[serde(default)]
    pub materials: Vec<Material>,
    #[serde(default)]
    pub textures: Vec<Texture>,
    /// Pictures; a texture says how one is read.
    #[serde(default)]
    pub images: Vec<Image>,
    #[serde(default)]
    pub samplers: Vec<Sampler>,
    /// Lists of numbers, which lie in the buffer views.
    #[serde(default)]
    pub accessors: Vec<Accessor>,
    #[serde(default)]
    pub buffer_views: Vec<View>,
    #[serde(default)]
    pub buffers: Vec<Buffer>,
    #[serde(default)]
    pub cameras: Vec<Camera>,
    /// Kept as they are, for the pose of one of them may be wanted.
    #[serde(default)]
    pub animations: Vec<Value>,
    /// What extensions add to the document as a whole, as the lights do.
    #[serde(default)]
    pub extensions: Value,
    /// All that occur, whether they are needed or not.
    #[serde(default)]
    pub extensions_used: Vec<String>,
    /// Those without which the document looks different.
    #[serde(default)]
    pub extensions_required: Vec<String>,
}

/// The nodes that a scene begins with.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Scene {
    pub nodes: Vec<usize>,
}

/// A place, with what is there, and the nodes that move with it.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Node {
    pub name: Option<String>,
    /// Nodes whose places count from this one.
    pub children: Vec<usize>,
    pub mesh: Option<usize>,
    /// The number of the skin whose joints bend its mesh.
    pub skin: Option<usize>,
    pub camera: Option<usize>,
    /// Where it is in its parent, as a matrix or as three parts of one.
    pub matrix: Option<[f32; 16]>,
    /// Applied last, after the scale and the rotation.
    pub translation: Option<[f32; 3]>,
    /// A quaternion as x, y, z, w; not always of length 1.
    pub rotation: Option<[f32; 4]>,
    pub scale: Option<[f32; 3]>,
    pub weights: Option<Vec<f32>>,
    pub extensions: Extensions,
}

/// The extensions of nodes, primitives, materials and textures that are read or counted.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Extensions {
    /// The number of a light in the extension of the document.
    #[serde(rename = "KHR_lights_punctual")]
    pub light: Option<Value>,
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instances: Option<Instances>,
    /// Where the compressed bytes of a primitive are.
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub draco: Option<Value>,
    /// The surface shows its colour, whatever the light is.
    #[serde(rename = "KHR_materials_unlit")]
    pub unlit: Option<IgnoredAny>,
    #[serde(rename = "KHR_materials_pbrSpecularGlossiness")]
    pub glossiness: Option<Glossiness>,
    /// An older extension with a light of its own.
    #[serde(rename = "KHR_materials_common")]
    pub common: Option<IgnoredAny>,
    #[serde(rename = "KHR_materials_emissive_strength")]
    pub emissive: Option<OneNumber>,
    /// The index of refraction, from which follows how much is reflected.
    #[serde(rename = "KHR_materials_ior")]
    pub refraction: Option<OneNumber>,
    #[serde(rename = "KHR_materials_specular")]
    pub specular: Option<Specular>,
}

/// A light of `KHR_lights_punctual`; one that cannot be read is counted as not drawn.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Light {
    /// `directional`, `point` or `spot`.
    #[serde(rename = "type")]
    pub kind: String,
    /// Linear; white where there is none.
    pub color: Option<[f32; 3]>,
    /// In candela, or in lux of a directional one.
    pub intensity: Option<f32>,
    /// How far it reaches; infinitely far where there is none.
    pub range: Option<f32>,
    pub spot: Option<Spot>,
}

/// The cone of a spot, from the angle at which the light decreases to the one at which it ends.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Spot {
    /// From the axis of the cone, in radians; within it the light is full.
    pub inner_cone_angle: Option<f64>,
    /// From the axis of the cone, in radians; beyond it there is no light.
    pub outer_cone_angle: Option<f64>,
}

/// The accessors of where the copies of a mesh are.
#[derive(Deserialize)]
pub(super) struct Instances {
    /// By `TRANSLATION`, `ROTATION` and `SCALE`.
    pub attributes: HashMap<String, usize>,
}

/// A camera of one of two kinds, which the member that is there tells.
#[derive(Deserialize)]
pub(super) struct Camera {
    pub name: Option<String>,
    pub perspective: Option<Lens>,
    pub orthographic: Option<Lens>,
}

/// The numbers of either projection.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Lens {
    /// With perspective: the angle from below to above.
    pub yfov: f64,
    /// Without perspective: half of the height that is seen.
    pub ymag: f64,
    /// The nearest distance that is seen.
    pub znear: f64,
    /// Without it a camera with perspective sees infinitely far.
    pub zfar: Option<f64>,
}

/// Primitives that are shown together.
#[derive(Deserialize)]
pub(super) struct Mesh {
    pub primitives: Vec<Primitive>,
    /// How much of each shape is mixed in.
    pub weights: Option<Vec<f32>>,
}

/// Triangles, lines or points of one material.
#[derive(Deserialize)]
pub(super) struct Primitive {
    /// By `POSITION`, `NORMAL`, `TEXCOORD_0` and so on.
    pub attributes: HashMap<String, usize>,
    /// The accessor of the vertices of each corner; without it the vertices are the corners, one after the other.
    pub indices: Option<usize>,
    /// Nothing for the grey one of the format.
    pub material: Option<usize>,
    /// [`TRIANGLES`] where there is none.
    pub mode: Option<u64>,
    /// Shapes that are mixed into its positions and normals.
    #[serde(default)]
    pub targets: Vec<Target>,
    #[serde(default)]
    pub extensions: Extensions,
}

/// The modes of primitives, as OpenGL numbers them.
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

/// The nodes that bend a mesh, and where the mesh is when it is not bent.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Skin {
    /// The nodes, in the order by which vertices number them.
    pub joints: Vec<usize>,
    /// An accessor of a matrix for each joint; without it they are the identity.
    pub inverse_bind_matrices: Option<usize>,
}

/// How a surface looks, by metal and roughness unless an extension says otherwise.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Material {
    pub name: Option<String>,
    /// What becomes of opacities: `OPAQUE`, `MASK` or `BLEND`.
    pub alpha_mode: String,
    /// With `MASK`, what is less opaque is a hole.
    pub alpha_cutoff: Option<f32>,
    /// Whether its back is drawn, with the normal turned round.
    pub double_sided: bool,
    pub pbr_metallic_roughness: Metallic,
    /// Normals in the coordinates of tangents.
    pub normal_texture: Option<Info>,
    /// How much of the ambient light reaches a place, in red.
    pub occlusion_texture: Option<Info>,
    pub emissive_texture: Option<Info>,
    /// The colour of the light that it emits, linear.
    pub emissive_factor: [f32; 3],
    pub extensions: Extensions,
}

/// A surface by metal and roughness.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Metallic {
    /// Linear, with the opacity as fourth number; multiplied with the texture.
    pub base_color_factor: Option<[f32; 4]>,
    pub base_color_texture: Option<Info>,
    /// From 0 to 1, as the roughness is.
    pub metallic_factor: Option<f32>,
    pub roughness_factor: Option<f32>,
    /// Roughness in green, metal in blue.
    pub metallic_roughness_texture: Option<Info>,
}

/// A surface by a specular colour and gloss, as an extension has it.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Glossiness {
    /// Linear, with the opacity as fourth number.
    pub diffuse_factor: Option<[f32; 4]>,
    pub diffuse_texture: Option<Info>,
    /// The colour of highlights, linear.
    pub specular_factor: Option<[f32; 3]>,
    /// 1 for a mirror, 0 for a matt surface.
    pub glossiness_factor: Option<f32>,
    pub specular_glossiness_texture: Option<IgnoredAny>,
}

/// Which texture a material reads, and by which texture coordinates.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Info {
    pub index: usize,
    /// Which set of texture coordinates is used.
    #[serde(default)]
    pub tex_coord: u32,
    /// Of a normal map: what x and y are multiplied by.
    pub scale: Option<f32>,
    /// Of an occlusion map, from 0 to 1.
    pub strength: Option<f32>,
    #[serde(default)]
    pub extensions: InfoExtensions,
}

/// The one number of an extension of materials.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct OneNumber {
    /// What the light of its own is multiplied by.
    pub emissive_strength: Option<f32>,
    /// 1.5 where there is none; 0 stands for infinity.
    pub ior: Option<f32>,
}

/// What is reflected where there is no metal, as an extension has it.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Specular {
    /// A part of what is reflected, from 0 to 1.
    pub specular_factor: Option<f32>,
    /// The colour of what is reflected from straight ahead.
    pub specular_color_factor: Option<[f32; 3]>,
    pub specular_texture: Option<IgnoredAny>,
    pub specular_color_texture: Option<IgnoredAny>,
}

/// What extensions say of how a material reads a texture.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct InfoExtensions {
    #[serde(rename = "KHR_texture_transform")]
    pub transform: Option<Transform>,
}

/// How texture coordinates are moved before a texture is read.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Transform {
    /// Added after scale and rotation.
    pub offset: [f32; 2],
    /// In radians, about the upper left corner.
    pub rotation: f32,
    pub scale: Option<[f32; 2]>,
    /// Other coordinates than those that the material names.
    pub tex_coord: Option<u32>,
}

/// A picture together with a sampler, so that one picture can be read in several ways.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Texture {
    /// Nothing for the usual way of reading.
    pub sampler: Option<usize>,
    /// None where an extension names a picture of another kind.
    pub source: Option<usize>,
    pub extensions: TextureExtensions,
}

/// The picture of another kind that an extension names.
#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct TextureExtensions {
    #[serde(rename = "EXT_texture_webp")]
    pub webp: Option<Source>,
}

/// A WebP, by its number among the pictures.
#[derive(Deserialize)]
pub(super) struct Source {
    pub source: Option<usize>,
}

/// A picture as a file, or as bytes of a buffer.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Image {
    /// A file, or the bytes themselves in an address.
    pub uri: Option<String>,
    pub buffer_view: Option<usize>,
}

/// How a texture is read; filters and wrapping are numbers of OpenGL.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Sampler {
    /// Where a texel is larger than a pixel.
    pub mag_filter: Option<u64>,
    /// Where it is smaller than a pixel, with or without a mip map.
    pub min_filter: Option<u64>,
    /// What lies beyond the left and the right border; `wrap_t` says it of the others.
    pub wrap_s: Option<u64>,
    pub wrap_t: Option<u64>,
}

/// Filters and wrapping, as OpenGL numbers them.
pub(super) const NEAREST: u64 = 9728;
pub(super) const LINEAR: u64 = 9729;
pub(super) const NEAREST_MIPMAP_NEAREST: u64 = 9984;
pub(super) const LINEAR_MIPMAP_NEAREST: u64 = 9985;
pub(super) const NEAREST_MIPMAP_LINEAR: u64 = 9986;
pub(super) const LINEAR_MIPMAP_LINEAR: u64 = 9987;
pub(super) const CLAMP_TO_EDGE: u64 = 33_071;
pub(super) const MIRRORED_REPEAT: u64 = 33_648;

/// Numbers in a buffer view: where they are, of which type, and how many belong together.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    /// Without one all numbers are 0.
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u64,
    /// Whether whole numbers stand for numbers from 0 or -1 to 1.
    #[serde(default)]
    pub normalized: bool,
    /// How many elements it has, whatever the length of its buffer view is.
    pub count: u64,
    /// How many numbers an element has, as `VEC3`.
    #[serde(rename = "type")]
    pub form: String,
    pub sparse: Option<Sparse>,
}

/// Elements that differ from those of the buffer view.
#[derive(Deserialize)]
pub(super) struct Sparse {
    pub count: u64,
    /// The numbers of the elements that differ.
    pub indices: SparsePart,
    /// Their values, in the same order.
    pub values: SparsePart,
}

/// Where the numbers or the values of the elements are that differ.
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

/// A part of a buffer, in which the elements of an accessor lie.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    pub buffer: usize,
    /// In bytes from the offset on.
    pub byte_length: u64,
    /// From the beginning of the buffer.
    #[serde(default)]
    pub byte_offset: u64,
    /// From one element to the next; without it they follow each other.
    pub byte_stride: Option<usize>,
    #[serde(default)]
    pub extensions: ViewExtensions,
}

/// How a part is compressed, where it is.
#[derive(Default, Deserialize)]
#[serde(default)]
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
    /// The elements that are compressed, each as long as the stride.
    pub count: usize,
    /// `ATTRIBUTES`, `TRIANGLES` or `INDICES`.
    pub mode: String,
    /// What was done to numbers before they were compressed.
    pub filter: Option<String>,
}

/// Bytes of a file, or without a name those of the GLB.
#[derive(Deserialize)]
pub(super) struct Buffer {
    /// A file, or the bytes themselves in an address.
    pub uri: Option<String>,
}
