//! Documents of version 1.0, of which there are still some, as documents of version 2.0.
//!
//! Version 1.0 names things where 2.0 counts them. A node has several meshes, an accessor the distance of its elements,
//! and a material the values of its shader.

use std::collections::HashMap;

use serde_json::{Map, Value, json};

use crate::contents::Contents;

/// The lists of a document, with the members of their entries that mean the same in both versions.
const LISTS: [(&str, &[&str]); 11] = [
    ("accessors", &["bufferView", "byteOffset", "componentType", "count", "normalized", "type"]),
    ("bufferViews", &["buffer", "byteLength", "byteOffset"]),
    ("buffers", &["byteLength", "uri"]),
    ("cameras", &["name", "orthographic", "perspective"]),
    ("images", &["name", "uri"]),
    ("materials", &["name"]),
    ("meshes", &["name"]),
    ("nodes", &["camera", "children", "matrix", "name", "rotation", "scale", "translation"]),
    ("samplers", &["magFilter", "minFilter", "wrapS", "wrapT"]),
    ("scenes", &["nodes"]),
    ("textures", &["sampler", "source"]),
];

/// Members that name entries of a list, with that list.
const NAMES: [(&str, &str); 10] = [
    ("buffer", "buffers"),
    ("bufferView", "bufferViews"),
    ("camera", "cameras"),
    ("children", "nodes"),
    ("indices", "accessors"),
    ("material", "materials"),
    ("meshes", "meshes"),
    ("nodes", "nodes"),
    ("sampler", "samplers"),
    ("source", "images"),
];

/// A document of version 1.0, with the number of each name in its list.
struct First<'a> {
    document: &'a Value,
    /// The place of a name in its list.
    numbers: HashMap<(&'static str, &'a str), usize>,
}

impl<'a> First<'a> {
    /// Numbers the entries of every list.
    fn of(document: &'a Value) -> Self {
        let mut first = Self { document, numbers: HashMap::new() };
        for (list, _) in LISTS {
            for (number, (name, _)) in first.list(list).enumerate() {
                first.numbers.insert((list, name), number);
            }
        }
        first
    }

    /// The entries of a list with their names, in the order of the document.
    fn list(&self, list: &str) -> impl Iterator<Item = (&'a String, &'a Value)> + use<'a> {
        self.document.get(list).and_then(Value::as_object).into_iter().flatten()
    }

    /// The number of an entry by its name.
    fn number(&self, list: &'static str, name: &Value) -> Option<Value> {
        self.numbers.get(&(list, name.as_str()?)).map(|&number| number.into())
    }

    /// An object with some members of another one, and with numbers where that has names.
    fn members(&self, value: &Value, names: &[&str]) -> Value {
        let mut made = Map::new();
        for name in names {
            let Some(of) = value.get(name) else { continue };
            let of = match (NAMES.iter().find(|(member, _)| member == name), of) {
                (None, of) => Some(of.clone()),
                (Some((_, list)), Value::Array(all)) => {
                    Some(all.iter().filter_map(|one| self.number(list, one)).collect())
                }
                // A name that is not in the list is left out.
                (Some((_, list)), one) => self.number(list, one),
            };
            made.extend(of.map(|of| ((*name).to_owned(), of)));
        }
        made.into()
    }

    /// The triangles of a mesh. The first set of each kind of attribute had no number.
    fn primitive(&self, primitive: &Value) -> Value {
        let mut made = self.members(primitive, &["indices", "material", "mode"]);
        let mut attributes = Map::new();
        let all = primitive.get("attributes").and_then(Value::as_object);
        for (name, accessor) in all.into_iter().flatten() {
            let name = match name.as_str() {
                "COLOR" | "TEXCOORD" => format!("{name}_0"),
                "JOINT" => "JOINTS_0".to_owned(),
                "WEIGHT" => "WEIGHTS_0".to_owned(),
                _ => name.clone(),
            };
            attributes.extend(self.number("accessors", accessor).map(|number| (name, number)));
        }
        made["attributes"] = attributes.into();
        made
    }
}

/// The document as one of version 2.0. What is not drawn of it is counted.
pub(super) fn upgraded(json: &[u8], contents: &mut Contents) -> Result<Vec<u8>, serde_json::Error> {
    let document: Value = serde_json::from_slice(json)?;
    let first = First::of(&document);
    // Every list with what means the same in both versions; below, what does not is added.
    let mut lists: HashMap<&str, Vec<Value>> = HashMap::new();
    for (list, members) in LISTS {
        let made = first.list(list).map(|(_, value)| first.members(value, members));
        lists.insert(list, made.collect());
    }
    // Calls a function with each entry of a list and what is made of it.
    let mut each = |list: &str, change: &mut dyn FnMut(&str, &Value, &mut Value)| {
        let made = lists.get_mut(list).into_iter().flatten();
        first.list(list).zip(made).for_each(|((name, value), made)| change(name, value, made));
    };
    each("buffers", &mut |name, _, made| {
        // The one that is in the same file.
        if name == "binary_glTF" || name == "KHR_binary_glTF" {
            made["uri"] = Value::Null;
        }
    });
    each("images", &mut |_, image, made| {
        if let Some(binary) = image.get("extensions").and_then(|all| all.get("KHR_binary_glTF")) {
            *made = first.members(binary, &["bufferView", "mimeType"]);
        }
    });
    each("materials", &mut |_, value, made| material(&first, value, made, contents));
    each("meshes", &mut |_, mesh, made| {
        let all = mesh.get("primitives").and_then(Value::as_array).into_iter().flatten();
        made["primitives"] = all.map(|one| first.primitive(one)).collect();
    });
    // An accessor whose elements are apart gets a view of its own.
    let shared: Vec<&Value> = first.list("bufferViews").map(|(_, view)| view).collect();
    let mut views = Vec::new();
    each("accessors", &mut |_, accessor, made| {
        let stride = accessor.get("byteStride").and_then(Value::as_u64).filter(|&s| s > 0);
        if let (Some(stride), Some(of)) = (stride, made["bufferView"].as_u64()) {
            let mut apart = first.members(shared[of as usize], LISTS[1].1);
            apart["byteStride"] = stride.into();
            made["bufferView"] = (shared.len() + views.len()).into();
            views.push(apart);
        }
    });
    // A node with several meshes gets children that have one each.
    let mut nodes: Vec<Value> = Vec::new();
    let count = first.list("nodes").count();
    each("nodes", &mut |_, node, made| {
        contents.count("skin", node.get("skin").is_some().into());
        let shown = first.members(node, &["meshes"])["meshes"].take();
        for (at, mesh) in shown.as_array().into_iter().flatten().enumerate() {
            if at == 0 {
                made["mesh"] = mesh.clone();
                continue;
            }
            let child = (count + nodes.len()).into();
            match made.get_mut("children").and_then(Value::as_array_mut) {
                Some(children) => children.push(child),
                None => made["children"] = json!([child]),
            }
            nodes.push(json!({ "mesh": mesh }));
        }
    });
    lists.entry("bufferViews").or_default().extend(views);
    lists.entry("nodes").or_default().extend(nodes);
    let animations = document.get("animations").and_then(Value::as_object).map_or(0, Map::len);
    contents.count("animation", animations as u64);
    // The lists have numbers now, and no names.
    let mut out = json!({ "asset": { "version": "2.0" } });
    for (list, made) in lists {
        out[list] = made.into();
    }
    if let Some(scene) = document.get("scene").and_then(|name| first.number("scenes", name)) {
        out["scene"] = scene;
    }
    serde_json::to_vec(&out)
}

/// A material of the values of its shader.
fn material(first: &First<'_>, value: &Value, made: &mut Value, contents: &mut Contents) {
    let common = value.get("extensions").and_then(|all| all.get("KHR_materials_common"));
    let values = common.unwrap_or(value).get("values").unwrap_or(&Value::Null);
    let mut pbr = json!({ "metallicFactor": 0 });
    let diffuse = values.get("diffuse");
    if let Some(number) = diffuse.and_then(|name| first.number("textures", name)) {
        pbr["baseColorTexture"] = json!({ "index": number });
    } else if let Some(colour) = diffuse.and_then(Value::as_array) {
        // Its colours are those of the screen.
        let [r, g, b, a] =
            [0, 1, 2, 3].map(|at: usize| colour.get(at).and_then(Value::as_f64).unwrap_or(1.0));
        pbr["baseColorFactor"] = json!([decoded(r), decoded(g), decoded(b), a]);
    }
    let shiny = shiny(values, &mut pbr);
    for (member, key) in [
        ("specular", "specular colour of material"),
        ("emission", "emission of material"),
        ("ambient", "ambient colour of material"),
        ("bump", "bump map"),
    ] {
        let is_drawn = member == "specular" && shiny.is_some();
        let is_left_out = !is_drawn && values.get(member).is_some_and(is_lit);
        contents.count(key, is_left_out.into());
    }
    made["pbrMetallicRoughness"] = pbr;
    made["extensions"] = match shiny {
        Some(shiny) => json!({ "KHR_materials_pbrSpecularGlossiness": shiny }),
        // Its light is not that of glTF 2.0.
        None => json!({ "KHR_materials_common": {} }),
    };
    // Culling is a state of the technique, which is not read.
    made["doubleSided"] = true.into();
}

/// Whether a colour has an effect, or a texture is named in its place.
fn is_lit(value: &Value) -> bool {
    match value {
        Value::Array(channels) => {
            channels.iter().take(3).any(|channel| channel.as_f64().is_some_and(|c| c > 0.0))
        }
        value => value.is_string(),
    }
}

/// A material with a specular colour and an exponent as one of the extension that has gloss, with the diffuse part of
/// `pbr`: of such a gloss that [`super::materials`] makes the exponent of it again.
fn shiny(values: &Value, pbr: &mut Value) -> Option<Value> {
    let channels = values.get("specular")?.as_array()?;
    let channels =
        [0, 1, 2].map(|at: usize| channels.get(at).and_then(Value::as_f64).unwrap_or(0.0));
    let exponent = values.get("shininess")?.as_f64().filter(|&exponent| exponent > 0.0)?;
    if channels.iter().all(|channel| *channel <= 0.0) {
        return None;
    }
    let gloss = 1.0 - libm::pow(2.0 / (exponent + 2.0), 0.25);
    let mut shiny = json!({ "specularFactor": channels.map(decoded), "glossinessFactor": gloss });
    for (from, to) in [("baseColorFactor", "diffuseFactor"), ("baseColorTexture", "diffuseTexture")]
    {
        if let Some(part) = pbr.as_object_mut().and_then(|pbr| pbr.remove(from)) {
            shiny[to] = part;
        }
    }
    Some(shiny)
}

/// The inverse of [`super::encoded`].
fn decoded(channel: f64) -> f64 {
    if channel <= 0.040_45 {
        return channel.max(0.0) / 12.92;
    }
    libm::pow((channel.min(1.0) + 0.055) / 1.055, 2.4)
}
