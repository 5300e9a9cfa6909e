//! glTF and GLB: the triangles of the scene that a document shows first, in its rest pose.
//!
//! The members that are read are named in [`document`]. The crate `gltf-json` names all members and also writes them; to compile
//! it took as long as to compile the largest crate of the workspace. Bytes are read by own code too, since the accessors of
//! `gltf` panic where a hostile file gives them too few, and its validation refuses documents that other programs load.

mod animation;
mod data;
mod document;
mod draco;
mod first;
mod materials;
mod meshopt;

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use glam::{DAffine2, DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};
use rasterproof_host::limits;
use rasterproof_host::text::printable_short;
use rasterproof_render::pipeline::assemble::ClipPoint;
use rasterproof_render::pipeline::opacity::{Opacity, OpacityMap};
use rasterproof_render::pipeline::physical::Map;
use rasterproof_render::pipeline::punctual::{Kind, PunctualLight};
use serde::Deserialize as _;
use serde_json::Value;

use crate::cameras::{Camera, Lens};
use crate::contents::{Contents, FilePart, Polygons, Surface, Vectors, of_normals};
use crate::records::{self, without_mark};
use crate::{Pose, Wrong};
use data::Data;
use document::{
    Instances, LINE_LOOP, LINE_STRIP, LINES, Light, Node, POINTS, Primitive, TRIANGLE_FAN,
    TRIANGLE_STRIP, TRIANGLES, entry,
};
pub(crate) use materials::encoded;
use materials::{Described, Images};
use rasterproof_core::arrays::MapArray as _;

/// What a corner of a triangle takes, as a number of a position and as a third of a piece that is drawn.
const CORNER_BYTES: u64 = 32;

/// What a part takes, however small it is, until it is merged with others.
const PART_BYTES: u64 = 256;

/// Lights that are drawn: every fragment is lit by each.
const MOST_LIGHTS: usize = 64;

/// Nodes that are visited: a document may show one node many times.
const MOST_VISITS: usize = 1 << 20;

/// Extensions that change nothing that could be seen, that are read, or whose use is counted.
const READ: [&str; 20] = [
    draco::EXTENSION,
    meshopt::EXTENSION,
    INSTANCES,
    LIGHTS,
    "KHR_materials_unlit",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_texture_transform",
    "EXT_texture_webp",
    "KHR_mesh_quantization",
    "KHR_xmp_json_ld",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "KHR_binary_glTF",
    "KHR_techniques_webgl",
    "KHR_materials_common",
    "MSFT_lod",
    "WEB3D_quantized_attributes",
];

/// The extension of nodes that show many copies of a mesh.
const INSTANCES: &str = "EXT_mesh_gpu_instancing";

/// The extension of nodes that are lights.
const LIGHTS: &str = "KHR_lights_punctual";

/// An extension that hides where the triangles are, and is not read.
const COMPRESSED: &str = "KHR_meshopt_compression";

/// Whether these bytes begin as a GLB.
pub(crate) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(b"glTF")
}

/// Reads a document, as JSON with files beside it or as one GLB.
pub(crate) fn read(bytes: &[u8], pose: Option<Pose>, contents: &mut Contents) -> Result<(), Wrong> {
    let Chunks { json, bin, odd } = match is_glb(bytes) {
        true => chunks(bytes)?,
        false => Chunks { json: bytes, bin: None, odd: None },
    };
    // Some programs fill a chunk with zeros.
    let mut json = json;
    while let [rest @ .., 0 | b' ' | b'\t' | b'\n' | b'\x0C' | b'\r'] = json {
        json = rest;
    }
    let json = without_mark(json);
    let no_gltf = |error: serde_json::Error| Wrong {
        line: if is_glb(bytes) { 0 } else { error.line() },
        cause: format!("is no glTF that can be read: {error}"),
    };
    let is_first = document::version(json).is_some_and(|version| version.trim().starts_with('1'));
    let json = match is_first {
        true => Cow::Owned(first::upgraded(json, contents).map_err(no_gltf)?),
        false => Cow::Borrowed(json),
    };
    // Both versions are one from here on.
    let root = document::read(&json).map_err(no_gltf)?;
    if root.extensions_required.iter().any(|name| name == COMPRESSED) {
        let remedy = "export the model without compression";
        let cause = "its triangles are compressed by";
        return Err(format!("{cause} {COMPRESSED}, which is not read: {remedy}").into());
    }
    // A pose is a change of the nodes, made before anything is read of them.
    let mut data = Data::new(root, contents.folder(), bin)?;
    if let Some(pose) = pose {
        animation::apply(&mut data, pose)?;
    }
    for animation in &data.root.animations {
        let name = records::name(animation["name"].as_str().unwrap_or(""));
        contents.animations.push(name.to_owned());
    }
    let mut reader = Reader {
        data: &data,
        contents,
        images: Images::default(),
        described: HashMap::new(),
        see_through: HashMap::new(),
        opacities: None,
        json_bytes: json.len() as u64,
        left_bytes: 0,
    };
    if let Some(odd) = odd {
        reader.warn("lengths", &odd);
    }
    reader.scene()?;
    reader.count_the_rest();
    contents.other_bytes = data.len();
    Ok(())
}

/// What a GLB consists of.
struct Chunks<'a> {
    /// The document itself, as text.
    json: &'a [u8],
    /// The bytes of the buffer without a name.
    bin: Option<&'a [u8]>,
    /// In which way its length is not the one that its head says.
    odd: Option<String>,
}

/// A GLB has a head of 12 bytes, then chunks with a head of 8 bytes each. In version 1, a head of 20 bytes with the length of the
/// JSON. What follows the length in the head is no part of it.
fn chunks(bytes: &[u8]) -> Result<Chunks<'_>, String> {
    let (all, said) = (bytes.len(), word(bytes, 8)? as usize);
    if word(bytes, 4)? == 1 {
        let length = word(bytes, 12)? as usize;
        let cut = || format!("is cut off: its JSON has {length} bytes from byte 20 on");
        let rest = &bytes[20.min(all)..];
        let (json, bin) = rest.split_at_checked(length).ok_or_else(cut)?;
        return Ok(Chunks { json, bin: Some(bin), odd: None });
    }
    // Some programs do not know the length when they write the head.
    // Up to here there are chunks, as far as the head says it.
    let end = if said < LEAST_GLB_BYTES { all } else { said.min(all) };
    let (mut json, mut bin, mut at) = (None, None, 12);
    while at + CHUNK_HEAD_BYTES <= end {
        let (length, kind) = (word(bytes, at)? as usize, word(bytes, at + 4)?);
        let chunk = bytes.get(at + CHUNK_HEAD_BYTES..).and_then(|rest| rest.get(..length));
        let chunk = chunk.ok_or_else(|| {
            let left = all - at - CHUNK_HEAD_BYTES;
            format!("is cut off: the chunk at byte {at} has {length} bytes, and {left} follow")
        })?;
        match &kind.to_le_bytes() {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if bin.is_none() => bin = Some(chunk),
            // Others may follow, which are left out as the format says.
            _ => {}
        }
        at += CHUNK_HEAD_BYTES + length;
    }
    // A length that does not fit is said, and does no harm.
    let odd = if said > all {
        Some(format!("its head says that it has {said} bytes, and it has {all}: it may be cut off"))
    } else if at > said {
        Some(format!("its head says that it has {said} bytes, and its chunks have {at}"))
    } else if at < all {
        Some(format!("{} bytes follow the last chunk; they are left out", all - at))
    } else {
        None
    };
    Ok(Chunks { json: json.ok_or("has no chunk of JSON")?, bin, odd })
}

/// The number of four bytes of a GLB.
fn word(bytes: &[u8], at: usize) -> Result<u32, String> {
    match bytes.get(at..).and_then(<[u8]>::first_chunk) {
        Some(word) => Ok(u32::from_le_bytes(*word)),
        None => Err(format!("is cut off at byte {}", bytes.len())),
    }
}

/// The head of a chunk: its length and its kind.
const CHUNK_HEAD_BYTES: usize = 8;

/// The head of a GLB, and that of one chunk.
const LEAST_GLB_BYTES: usize = 12 + CHUNK_HEAD_BYTES;

/// The number of a material in the contents, and where its texture finds its coordinates.
type UsedMaterial = (usize, [Option<materials::Coordinates>; 2]);

/// Makes parts of the primitives that are shown.
struct Reader<'a> {
    data: &'a Data<'a>,
    contents: &'a mut Contents,
    images: Images,
    /// By the numbers of the materials that are used; nothing is that of primitives that name none.
    described: HashMap<Option<usize>, Option<UsedMaterial>>,
    /// The surfaces of primitives whose vertices have opacities, by that of their material and the one opacity.
    see_through: HashMap<(usize, u64), usize>,
    /// The map of all opacities, where one is needed.
    opacities: Option<Arc<OpacityMap>>,
    /// For the limit of what a file of this length may contain.
    json_bytes: u64,
    /// What the triangles that are compressed may take in all.
    left_bytes: u64,
}

impl Reader<'_> {
    /// Counts what is not drawn; see [`Contents::count`].
    fn count(&mut self, key: &str, count: u64) {
        self.contents.count(key, count);
    }

    fn warn(&mut self, kind: &str, text: &str) {
        self.contents.warnings.add(kind, text);
    }

    /// Reads the meshes of all nodes of the scene.
    fn scene(&mut self) -> Result<(), String> {
        let root = &self.data.root;
        // The scene to show, or without one everything that nothing else contains.
        let number = root.scene.unwrap_or(0);
        let roots: Vec<usize> = match root.scenes.get(number) {
            Some(scene) => scene.nodes.clone(),
            None if root.scene.is_some() => return Err(format!("scenes[{number}] is not there")),
            None => self.parentless(),
        };
        self.count("other scene", root.scenes.len().saturating_sub(1) as u64);
        // From the coordinates of each node to those of the file.
        let mut worlds = vec![DMat4::IDENTITY; root.nodes.len()];
        let mut visits: Vec<(usize, DMat4)> = Vec::new();
        // Nodes to visit, the next one last: their number, the matrix of their parent, and how deep they are.
        let mut open: Vec<(usize, DMat4, usize)> = Vec::new();
        for node in roots.into_iter().rev() {
            open.push((node, DMat4::IDENTITY, 1));
        }
        while let Some((number, parent, depth)) = open.pop() {
            // A node gives its place to its children, which are visited after it.
            let node = entry(&root.nodes, "nodes", number)?;
            // A path of more nodes than there are passes one of them twice.
            if depth > root.nodes.len() {
                return Err(format!("nodes[{number}] contains itself: nodes have to form a tree"));
            }
            if visits.len() >= MOST_VISITS {
                return Err(format!("shows more than {MOST_VISITS} nodes"));
            }
            let world = parent * local(node);
            worlds[number] = world;
            visits.push((number, world));
            for &child in node.children.iter().rev() {
                open.push((child, world, depth + 1));
            }
        }
        self.left_bytes = self.refuse_too_many_copies(&visits)?;
        // All matrices are known now, which skins need, and what is shown is not too much.
        for (number, world) in visits {
            let node = &root.nodes[number];
            self.camera(number, node, world);
            self.light(node, world);
            let Some(mesh) = node.mesh else { continue };
            let primitives = &entry(&root.meshes, "meshes", mesh)?.primitives;
            let copies = self.instances(node).map_err(|cause| format!("nodes[{number}]: {cause}"));
            for copy in copies? {
                for (at, primitive) in primitives.iter().enumerate() {
                    let place = format!("meshes[{mesh}].primitives[{at}]");
                    self.primitive(primitive, (number, node), world * copy, &worlds, &place)
                        .map_err(|cause| format!("{place}: {cause}"))?;
                }
            }
        }
        Ok(())
    }

    /// Adds the camera of a node, where it has one.
    fn camera(&mut self, number: usize, node: &Node, world: DMat4) {
        let Some(at) = node.camera else { return };
        let camera = self.data.root.cameras.get(at);
        // Of the two kinds of cameras one has to be there.
        let (lens, of) = match camera {
            Some(document::Camera { perspective: Some(of), .. }) => {
                (Lens::Perspective { angle_rad: of.yfov }, of)
            }
            Some(document::Camera { orthographic: Some(of), .. }) => {
                (Lens::Parallel { half_height: of.ymag }, of)
            }
            _ => {
                self.warn("cameras", &format!("nodes[{number}]: cameras[{at}] is none of glTF"));
                return;
            }
        };
        // A parallel one always ends somewhere.
        let is_parallel = matches!(lens, Lens::Parallel { .. });
        let far = of.zfar.or(is_parallel.then_some(0.0));
        let name = node.name.as_deref().or(camera.and_then(|camera| camera.name.as_deref()));
        let name = records::name(name.unwrap_or_default()).to_owned();
        let (eye, ahead, up) = (DVec3::ZERO, DVec3::NEG_Z, DVec3::Y);
        let mut camera = Camera { name, eye, ahead, up, lens, near: of.znear, far };
        camera.place(world);
        self.contents.cameras.push(camera);
    }

    /// Adds the light of a node, where it has one.
    fn light(&mut self, node: &Node, world: DMat4) {
        let Some(used) = &node.extensions.light else { return };
        match self.punctual(used) {
            Some(light) if self.contents.lights.len() < MOST_LIGHTS => {
                self.contents.lights.push(light.placed(world));
            }
            _ => self.count("light", 1),
        }
    }

    /// The light that a node names; nothing where it cannot be read.
    fn punctual(&self, used: &Value) -> Option<PunctualLight> {
        let number = used["light"].as_f64().filter(|number| *number >= 0.0)?;
        let light = self.data.root.extensions[LIGHTS]["lights"].get(number as usize)?;
        let light = Light::deserialize(light).ok()?;
        let range = light.range.filter(|range| *range > 0.0).map_or(f64::INFINITY, f64::from);
        // A light of another kind is counted, and not drawn.
        let kind = match light.kind.as_str() {
            "directional" => Kind::Directional,
            "point" => Kind::Point { range },
            "spot" => {
                let spot = light.spot.unwrap_or_default();
                let [inner, outer] = Kind::ANGLES_RAD;
                let inner_rad = spot.inner_cone_angle.unwrap_or(inner);
                let outer_rad = spot.outer_cone_angle.unwrap_or(outer);
                Kind::Spot { range, inner_rad, outer_rad }
            }
            _ => return None,
        };
        let usual = |number: f32| f64::from(number.clamp(0.0, 1e9));
        let colour = DVec3::from_array(light.color.unwrap_or([1.0; 3]).map_array(usual));
        Some(PunctualLight::new(kind, colour, usual(light.intensity.unwrap_or(1.0))))
    }

    /// Where a node shows its mesh, in its own coordinates: once, or as often as an extension says.
    fn instances(&self, node: &Node) -> Result<Vec<DMat4>, String> {
        let once = vec![DMat4::IDENTITY];
        let Some(Instances { attributes }) = &node.extensions.instances else { return Ok(once) };
        // Where the joints of a skin are decides alone.
        let Some(count) = self.copies(node).filter(|_| node.skin.is_none()) else {
            return Ok(once);
        };
        let moves = self.vectors_or(attributes.get("TRANSLATION"), count, [0.0; 3])?;
        let turns = self.vectors_or(attributes.get("ROTATION"), count, [0.0, 0.0, 0.0, 1.0])?;
        let scales = self.vectors_or(attributes.get("SCALE"), count, [1.0; 3])?;
        let mut copies = Vec::with_capacity(count as usize);
        for ((by, turn), scale) in moves.into_iter().zip(turns).zip(scales) {
            copies.push(placed(scale, turn, by));
        }
        Ok(copies)
    }

    /// The vectors of an accessor, or as many of the same where there is none.
    fn vectors_or<const N: usize>(
        &self,
        accessor: Option<&usize>,
        count: u64,
        missing: [f64; N],
    ) -> Result<Vec<[f64; N]>, String> {
        match accessor {
            Some(accessor) => self.data.vectors(*accessor),
            None => Ok(vec![missing; count as usize]),
        }
    }

    /// How many copies of its mesh a node shows by an extension: those of which all is given.
    fn copies(&self, node: &Node) -> Option<u64> {
        let mut least = None;
        for (name, &accessor) in &node.extensions.instances.as_ref()?.attributes {
            // Those of a program say nothing about where a copy is.
            if !name.starts_with('_') {
                let count = self.data.count(accessor);
                least = Some(least.map_or(count, |least: u64| least.min(count)));
            }
        }
        least
    }

    /// Refuses what the nodes show before it is built, where it takes far more than the file; the bytes that are left.
    fn refuse_too_many_copies(&self, visits: &[(usize, DMat4)]) -> Result<u64, String> {
        let root = &self.data.root;
        let matrix = size_of::<DMat4>() as u64;
        // What each mesh takes is computed once, since many nodes may show it.
        let mut of_meshes = vec![0; root.meshes.len()];
        for (mesh, bytes) in root.meshes.iter().zip(&mut of_meshes) {
            *bytes = mesh.primitives.iter().map(|one| self.bytes(one)).sum();
        }
        let (mut bytes, mut copies) = (0u64, 0u64);
        for (number, _) in visits {
            let node = &root.nodes[*number];
            let Some(mesh) = node.mesh else { continue };
            let skin = node.skin.and_then(|skin| root.skins.get(skin));
            let joints = skin.map_or(0, |skin| skin.joints.len() as u64);
            let shown = self.copies(node).unwrap_or(1);
            let of_mesh = of_meshes.get(mesh).copied().unwrap_or(0);
            let of_copy = of_mesh.saturating_add(matrix * joints + matrix);
            bytes = bytes.saturating_add(of_copy.saturating_mul(shown));
            copies += shown;
        }
        let length = self.data.len() + self.json_bytes;
        let per_byte = limits::MODEL_CONTENTS_BYTES_PER_BYTE.saturating_mul(length);
        let most = limits::MODEL_CONTENTS_BYTES.max(per_byte);
        if bytes <= most {
            return Ok(most - bytes);
        }
        // In MiB, as the limits are stated.
        let [bytes, most] = [bytes, most].map_array(|bytes| bytes >> 20);
        Err(format!(
            "shows {copies} copies of its meshes, which take {bytes} MiB, and a file of {length} bytes may have {most} MiB: \
             export it with fewer copies"
        ))
    }

    /// About what a primitive takes each time that it is shown, until it is drawn.
    fn bytes(&self, primitive: &Primitive) -> u64 {
        // What is compressed says how much it is when it is decoded.
        if primitive.extensions.draco.is_some() {
            return PART_BYTES;
        }
        let count = |accessor: Option<usize>| accessor.map_or(0, |number| self.data.count(number));
        // What its vertices, its corners and its shapes take, each as large as it gets.
        let vertices = count(primitive.attributes.get("POSITION").copied());
        // Positions in the file and as they are drawn; an attribute is at most three doubles.
        let vector = size_of::<DVec3>() as u64;
        let of_vertex = size_of::<ClipPoint>() as u64 + vector * primitive.attributes.len() as u64;
        let corners = primitive.indices.map_or(vertices, |number| self.data.count(number));
        let of_corner = match primitive.mode {
            None | Some(TRIANGLES) => CORNER_BYTES,
            _ => 3 * CORNER_BYTES,
        };
        let mut all = PART_BYTES
            .saturating_add(vertices.saturating_mul(of_vertex))
            .saturating_add(corners.saturating_mul(of_corner));
        for target in &primitive.targets {
            all = all
                .saturating_add(vector.saturating_mul(count(target.position)))
                .saturating_add(count(target.normal));
        }
        all
    }

    /// The nodes without a parent, which are shown where no scene is described.
    fn parentless(&self) -> Vec<usize> {
        let nodes = &self.data.root.nodes;
        let mut is_child = vec![false; nodes.len()];
        for &child in nodes.iter().flat_map(|node| &node.children) {
            if let Some(is_child) = is_child.get_mut(child) {
                *is_child = true;
            }
        }
        (0..nodes.len()).filter(|&node| !is_child[node]).collect()
    }

    /// What the document has beside triangles.
    fn count_the_rest(&mut self) {
        let root = &self.data.root;
        // Some files name what they require here alone.
        // In alphabetical order, so that the warnings are the same each time.
        let required: BTreeSet<&String> = root.extensions_required.iter().collect();
        let all: BTreeSet<&String> = root.extensions_used.iter().chain(required.clone()).collect();
        for name in all.into_iter().filter(|name| !READ.contains(&name.as_str())) {
            let shown = printable_short(name, 60);
            self.count(&format!("extension {shown}"), 1);
            if required.contains(name) {
                let text = format!(
                    "requires the extension {shown}, which is not read, so the picture may lack something"
                );
                self.warn("extensions", &text);
            }
        }
    }

    /// Adds a primitive as a part: its triangles, what its vertices have, and its surface.
    fn primitive(
        &mut self,
        primitive: &Primitive,
        (number, node): (usize, &Node),
        world: DMat4,
        worlds: &[DMat4],
        place: &str,
    ) -> Result<(), String> {
        // What is compressed is decoded first, for it says how many vertices there are.
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        let compressed = draco::decode(self.data, primitive, &mut self.left_bytes);
        let compressed = compressed.map_err(|cause| {
            // What is behind the colon may be a number of the file.
            let before = cause.split_once(':').map(|(before, _)| before.to_owned());
            before.filter(|_| self.data.has_outside_buffer()).unwrap_or(cause)
        })?;
        let vertices = Vertices { data: self.data, primitive, compressed };
        let Some(positions) = vertices.read("POSITION") else {
            self.count("empty primitive", 1);
            return Ok(());
        };
        let mut positions: Vec<DVec3> = vectors3(positions?);
        let count = positions.len();
        let indices = match (&vertices.compressed, &primitive.indices) {
            (Some(compressed), _) => compressed.indices(),
            (None, Some(accessor)) => self.data.indices(*accessor)?,
            (None, None) => (0..count as u32).collect(),
        };
        // Points and lines are counted and not drawn.
        let (key, elements) = match mode {
            POINTS => ("point", indices.len()),
            LINES => ("line", indices.len() / 2),
            LINE_LOOP => ("line", indices.len()),
            LINE_STRIP => ("line", indices.len().saturating_sub(1)),
            TRIANGLES | TRIANGLE_STRIP | TRIANGLE_FAN => ("", 0),
            _ => return Err("its mode is not one of glTF".to_owned()),
        };
        self.count(key, elements as u64);
        if !key.is_empty() {
            return Ok(());
        }
        // Every kind of triangles becomes a list of three corners each.
        let triangles = self.triangles(mode, indices, count, place);
        // Positions and normals, as shapes and joints move them.
        let mut normals = match vertices.read("NORMAL") {
            Some(read) => self.optional(read.map(vectors3), count, "normals", place),
            None => Vec::new(),
        };
        self.morph(primitive, node, &mut positions, &mut normals)?;
        let mut to_file = world;
        if let Some(skin) = node.skin {
            let skinned = ["JOINTS_0", "WEIGHTS_0"].map_array(|name| {
                let none = || Err("has a skin and no joints or weights".to_owned());
                vertices.read::<4>(name).unwrap_or_else(none)
            });
            match skinned {
                [Ok(joints), Ok(weights)] if joints.len() == count && weights.len() == count => {
                    let matrices = self.joints(skin, worlds)?;
                    bend(&mut positions, &mut normals, &matrices, &joints, &weights)?;
                    // Where the node is has no effect on what its joints move.
                    to_file = DMat4::IDENTITY;
                }
                [Err(cause), _] | [_, Err(cause)] => {
                    self.warn("skins", &format!("{place}: {cause}; it is drawn without its skin"));
                }
                _ => self.warn("skins", &format!("{place}: its joints are not as many as its positions; it is drawn without its skin")),
            }
        }
        // What else a vertex has, in the form in which the surface needs it.
        self.count_attributes(primitive);
        // Colours are multiplied with the surface, so without any they are white.
        let colours = match vertices.read("COLOR_0") {
            Some(read) => self.optional(read.map(vectors3), count, "colours", place),
            None => Vec::new(),
        };
        // Colours are linear in a glTF, and those of surfaces in linear light stay so.
        let mut material = self.material(primitive.material, place);
        let surface = material.map(|(material, ..)| &self.contents.materials[material]);
        let physical = surface.and_then(|surface| surface.physical.clone());
        let colours = match physical {
            Some(_) => colours,
            None => colours.into_iter().map(|colour| colour.map(encoded)).collect(),
        };
        let is_bumpy = physical.is_some_and(|(_, of)| of.map(Map::Normal).is_some());
        // Those of a file without normals are not to be used, and those that a skin moves are computed.
        // Tangents are used where there is a normal map, with the normals that belong to them.
        let is_read = is_bumpy && !normals.is_empty() && node.skin.is_none();
        let tangents = match vertices.read::<4>("TANGENT").filter(|_| is_read) {
            Some(read) => self.optional(read, count, "tangents", place),
            None => Vec::new(),
        };
        let tangents = tangents.into_iter().map(DVec4::from_array).collect();
        // Texture coordinates with v up, moved as the material says.
        let mut read_uvs = |set| {
            let Some((set, transform)) = set else { return Vec::new() };
            let Some(read) = vertices.read(&format!("TEXCOORD_{set}")) else {
                self.warn("textures", &format!("{place}: has a texture and no TEXCOORD_{set}; all of it has the colour of one texel"));
                return Vec::new();
            };
            let turned = |[u, v]: [f64; 2]| {
                let uv = DAffine2::transform_point2(&transform, DVec2::new(u, v));
                DVec2::new(uv.x, 1.0 - uv.y)
            };
            let read = read.map(|read| read.into_iter().map(turned).collect());
            self.optional(read, count, "texture coordinates", place)
        };
        // The texture and its maps may be read at two sets of coordinates, and no more.
        let [first, second] = material.map_or([None; 2], |(_, uvs)| uvs);
        let (mut uvs, second_uvs) = (read_uvs(first), read_uvs(second));
        if let Some((number, _)) = &mut material {
            let used = (*number, first.is_some());
            *number = self.with_opacities(used, primitive, &vertices, &mut uvs);
        }
        let name = records::name(node.name.as_deref().unwrap_or(""));
        // All that a part has; what is missing is computed later, or left out.
        let part = FilePart {
            name: format!("nodes[{number}] {name} {place}").replace("  ", " "),
            material: material.map(|(material, ..)| material),
            to_file,
            polygons: Polygons::triangles(triangles.len() / 3),
            corners: triangles,
            positions,
            normals: Vectors::of_positions(normals),
            uvs: Vectors::of_positions(uvs),
            second_uvs,
            colours: Vectors::of_positions(colours),
            tangents,
        };
        self.contents.add(part)
    }

    /// The surface, by its number, of a primitive whose vertices have opacities, where those of its material have an effect. A
    /// surface without a picture reads them from a map in which each lies at a coordinate of its own, so that what is
    /// interpolated is the opacity. Others are multiplied by an opacity that is the same at all vertices.
    fn with_opacities(
        &mut self,
        (number, has_picture): (usize, bool),
        primitive: &Primitive,
        vertices: &Vertices<'_>,
        uvs: &mut Vec<DVec2>,
    ) -> usize {
        let material = primitive.material.and_then(|at| self.data.root.materials.get(at));
        let Some(mode) = material.and_then(materials::alpha_mode) else { return number };
        let Some(Ok(colours)) = vertices.read::<4>("COLOR_0") else { return number };
        let opacities: Vec<f64> = colours.iter().map(|[.., alpha]| alpha.clamp(0.0, 1.0)).collect();
        let transparent = opacities.iter().filter(|alpha| **alpha < 1.0).count();
        let Some(&first) = opacities.first().filter(|_| transparent > 0) else { return number };
        // One opacity for all is multiplied into the surface; different ones need a map.
        let surface = &self.contents.materials[number];
        let opacity = surface.opacity.clone();
        let mut opacity = opacity.unwrap_or(Opacity { factor: 1.0, map: None, mode });
        let is_one = opacities.iter().all(|alpha| *alpha == first);
        if is_one {
            opacity.factor *= first;
        } else if has_picture {
            self.count("transparent position of textured primitive", transparent as u64);
            return number;
        } else {
            *uvs = opacities.into_iter().map(materials::uv_of_opacity).collect();
            opacity.map = Some(self.opacities.get_or_insert_with(materials::opacities).clone());
        }
        // Primitives with the same surface and opacity share a surface.
        let key = (number, if is_one { first.to_bits() } else { u64::MAX });
        let Contents { materials, .. } = &mut *self.contents;
        *self.see_through.entry(key).or_insert_with(|| {
            let surface = Surface { opacity: Some(opacity), ..materials[number].clone() };
            materials.push(surface);
            materials.len() - 1
        })
    }

    /// Counts what a primitive has at its vertices and is not drawn.
    fn count_attributes(&mut self, primitive: &Primitive) {
        let mut not_defined = 0;
        for name in primitive.attributes.keys() {
            let set = name.split_once('_');
            match set.and_then(|(kind, set)| Some((kind, set.parse().ok()?))) {
                Some(("COLOR", 1..)) => self.count("other colours of primitive", 1),
                Some(("JOINTS", 1..)) => self.count("joints beyond the first four of primitive", 1),
                // Texture coordinates that no texture is read at change nothing.
                Some(("TEXCOORD" | "COLOR" | "JOINTS" | "WEIGHTS", _)) => {}
                _ if ["POSITION", "NORMAL", "TANGENT"].contains(&&**name) => {}
                // Those of a program, which no other one shows.
                _ if name.starts_with('_') => {}
                _ => not_defined = 1,
            }
        }
        self.count("values that glTF does not define of primitive", not_defined);
    }

    /// The corners of triangles, three by three; those that name no position are left out.
    fn triangles(&mut self, mode: u64, indices: Vec<u32>, count: usize, place: &str) -> Vec<u32> {
        let mut list = match mode {
            TRIANGLE_STRIP => {
                let mut list = Vec::new();
                for number in 2..indices.len() {
                    let [a, b, c] = [indices[number - 2], indices[number - 1], indices[number]];
                    // Triangles of two equal corners lead from one part of a strip to the next.
                    if a != b && b != c && c != a {
                        // Every second one runs the other way, so that all of them face the same way.
                        list.extend(if number % 2 == 0 { [a, b, c] } else { [a, c, b] });
                    }
                }
                list
            }
            TRIANGLE_FAN => {
                let Some((&first, others)) = indices.split_first() else { return Vec::new() };
                let mut list = Vec::new();
                for pair in others.windows(2) {
                    list.extend([pair[0], pair[1], first]);
                }
                list
            }
            _ => indices,
        };
        // Corners that make no triangle, and triangles that name nothing, are left out with a warning.
        let left = list.len() % 3;
        if left > 0 {
            list.truncate(list.len() - left);
            self.warn(
                "triangles",
                &format!("{place}: {left} indices at the end make no triangle; they are left out"),
            );
        }
        let named = list.iter().copied().max().unwrap_or(0);
        if named as usize >= count && !list.is_empty() {
            let before = list.len();
            let mut kept = Vec::new();
            for corners in list.as_chunks::<3>().0 {
                if corners.iter().all(|&index| (index as usize) < count) {
                    kept.extend(corners);
                }
            }
            list = kept;
            let wrong = (before - list.len()) / 3;
            // The index is what stands in the file.
            let named = match self.data.has_outside_buffer() {
                true => String::new(),
                false => format!(", as {named} of {count}"),
            };
            self.warn("triangles", &format!("{place}: {wrong} triangles name a vertex that is not there{named}; they are left out"));
        }
        list
    }

    /// What a vertex may have beside its position, or nothing with a warning where it cannot be read.
    fn optional<T>(
        &mut self,
        read: Result<Vec<T>, String>,
        count: usize,
        what: &str,
        place: &str,
    ) -> Vec<T> {
        let cause = match read {
            Ok(mut read) if read.len() >= count => {
                read.truncate(count);
                return read;
            }
            Ok(read) => format!("{} {what} for {count} positions", read.len()),
            Err(cause) => format!("the {what} cannot be read: {cause}"),
        };
        self.warn("vertices", &format!("{place}: {cause}; it is drawn without them"));
        Vec::new()
    }

    /// The number of a material in the contents, and what its texture needs.
    fn material(&mut self, number: Option<usize>, place: &str) -> Option<UsedMaterial> {
        if let Some(known) = self.described.get(&number) {
            return *known;
        }
        // Each material is described once, also where it is missing.
        let (images, contents) = (&mut self.images, &mut *self.contents);
        let described = materials::describe(self.data, number, images, contents);
        let known = described.map(|Described { surface, uvs }| {
            self.contents.materials.push(surface);
            (self.contents.materials.len() - 1, uvs)
        });
        if let (None, Some(number)) = (known, number) {
            let text = format!("{place}: materials[{number}] is not there; it is drawn grey");
            self.warn("materials", &text);
        }
        self.described.insert(number, known);
        known
    }

    /// Adds the shapes that are mixed in at rest, and counts the others.
    fn morph(
        &self,
        primitive: &Primitive,
        node: &Node,
        positions: &mut [DVec3],
        normals: &mut [DVec3],
    ) -> Result<(), String> {
        let mesh = node.mesh.and_then(|mesh| self.data.root.meshes.get(mesh));
        let weights = node.weights.as_ref().or(mesh.and_then(|mesh| mesh.weights.as_ref()));
        for (number, target) in primitive.targets.iter().enumerate() {
            let weight = weights.and_then(|all| all.get(number)).copied().unwrap_or(0.0);
            let weight = f64::from(weight);
            // At rest an animation may leave it out.
            if weight == 0.0 {
                continue;
            }
            for (accessor, moved) in
                [(target.position, &mut *positions), (target.normal, &mut *normals)]
            {
                let Some(accessor) = accessor else { continue };
                for (vector, by) in moved.iter_mut().zip(self.data.vectors(accessor)?) {
                    *vector += weight * DVec3::from_array(by);
                }
            }
        }
        Ok(())
    }

    /// Where each joint of a skin brings what is bound to it.
    fn joints(&self, number: usize, worlds: &[DMat4]) -> Result<Vec<DMat4>, String> {
        let skin = entry(&self.data.root.skins, "skins", number)?;
        // From the coordinates of the mesh to those of a joint, as it was when the mesh was bound to it.
        let bound: Vec<[f64; 16]> = match skin.inverse_bind_matrices {
            Some(accessor) => self.data.vectors(accessor)?,
            None => Vec::new(),
        };
        let mut matrices = Vec::with_capacity(skin.joints.len());
        for (at, &joint) in skin.joints.iter().enumerate() {
            let inverse = bound.get(at).map_or(DMat4::IDENTITY, DMat4::from_cols_array);
            matrices.push(*entry(worlds, "nodes", joint)? * inverse);
        }
        Ok(matrices)
    }
}

/// The vertices of a primitive, whether Draco compressed them or not.
struct Vertices<'a> {
    data: &'a Data<'a>,
    primitive: &'a Primitive,
    /// What Draco decoded, in the place of buffer views.
    compressed: Option<draco::DecodedPrimitive>,
}

impl Vertices<'_> {
    /// The values of an attribute; nothing where the vertices do not have it.
    fn read<const N: usize>(&self, name: &str) -> Option<Result<Vec<[f64; N]>, String>> {
        let vectors = self.compressed.as_ref().and_then(|decoded| decoded.vectors(name));
        let accessor = *self.primitive.attributes.get(name)?;
        Some(match vectors {
            Some(vectors) => self.data.normalized(accessor, vectors),
            None => self.data.vectors(accessor),
        })
    }
}

fn vectors3(read: Vec<[f64; 3]>) -> Vec<DVec3> {
    read.into_iter().map(DVec3::from_array).collect()
}

/// From the coordinates of a node to those of its parent.
fn local(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let scale = node.scale.unwrap_or([1.0; 3]).map(f64::from);
    let turn = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]).map(f64::from);
    placed(scale, turn, node.translation.unwrap_or([0.0; 3]).map(f64::from))
}

/// A matrix that scales, turns by a quaternion and moves.
fn placed(scale: [f64; 3], turn: [f64; 4], by: [f64; 3]) -> DMat4 {
    let turn = DQuat::from_array(turn);
    // Where the four numbers are all 0, nothing is turned.
    let turn = if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY };
    DMat4::from_scale_rotation_translation(DVec3::from_array(scale), turn, DVec3::from_array(by))
}

/// Moves vertices by the mean of their joints.
fn bend(
    positions: &mut [DVec3],
    normals: &mut [DVec3],
    matrices: &[DMat4],
    joints: &[[f64; 4]],
    weights: &[[f64; 4]],
) -> Result<(), String> {
    for (at, (joints, weights)) in joints.iter().zip(weights).enumerate() {
        let sum: f64 = weights.iter().sum();
        // Without a weight the vertex stays where it is.
        if sum <= 0.0 {
            continue;
        }
        let mut matrix = DMat4::ZERO;
        for (&joint, &weight) in joints.iter().zip(weights) {
            // A joint without a weight may name anything.
            if weight == 0.0 {
                continue;
            }
            let Some(of) = matrices.get(joint as usize) else {
                let joints = matrices.len();
                return Err(format!(
                    "vertex {at} is bound to a joint that is not there, of {joints}"
                ));
            };
            matrix += *of * (weight / sum);
        }
        positions[at] = matrix.transform_point3(positions[at]);
        if let Some(normal) = normals.get_mut(at) {
            *normal = of_normals(DMat3::from_mat4(matrix)) * *normal;
        }
    }
    Ok(())
}
