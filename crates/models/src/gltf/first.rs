//! Documents of version 1.0, of which there are still many, as documents of version 2.0.
//!
//! Version 1.0 names things where 2.0 counts them. A node has several meshes, an accessor the distance of its elements,
//! and a material the values of its shader.

use std::collections::{BTreeMap, HashMap};

use serde::Deserialize;
use serde_json::{Map, Value, json};

#[derive(Deserialize)]
struct Head {
    asset: Option<Asset>,
}

#[derive(Deserialize)]
struct Asset {
    version: Option<Value>,
}

/// A list of version 2.0, with the number of each name of version 1.0.
#[derive(Default)]
struct List<'a> {
    values: Vec<&'a Value>,
    names: Vec<&'a str>,
    numbers: HashMap<&'a str, usize>,
}

impl<'a> List<'a> {
    fn of(document: &'a Value, key: &str) -> Self {
        let mut list = Self::default();
        for (name, value) in document.get(key).and_then(Value::as_object).into_iter().flatten() {
            list.numbers.insert(name, list.values.len());
            list.names.push(name);
            list.values.push(value);
        }
        list
    }

    fn number(&self, value: &Value, key: &str) -> Option<usize> {
        self.numbers.get(value.get(key)?.as_str()?).copied()
    }

    /// The numbers of all that a member names.
    fn all(&self, value: &Value, key: &str) -> Vec<usize> {
        let names = value.get(key).and_then(Value::as_array).into_iter().flatten();
        names.filter_map(|name| self.numbers.get(name.as_str()?).copied()).collect()
    }
}

/// An object with those members of another one that have one of the names.
fn members(value: &Value, names: &[&str]) -> Value {
    let member = |name: &&str| Some(((*name).to_owned(), value.get(name)?.clone()));
    Value::Object(names.iter().filter_map(member).collect())
}

/// Sets a member of an object, where there is a value for it.
fn put(object: &mut Value, name: &str, value: Option<usize>) {
    if let Some(value) = value {
        object[name] = value.into();
    }
}

/// The document as one of version 2.0; nothing where it is one, or is no document. What is not drawn of it is counted.
pub(super) fn upgraded(
    json: &[u8],
    not_drawn: &mut BTreeMap<String, u64>,
) -> Result<Option<Vec<u8>>, String> {
    let head: Result<Head, _> = serde_json::from_slice(json);
    let version = head.ok().and_then(|head| head.asset).and_then(|asset| asset.version);
    let version = match version {
        Some(Value::String(version)) => version,
        Some(version) => version.to_string(),
        None => return Ok(None),
    };
    if !version.trim().starts_with('1') {
        return Ok(None);
    }
    let document: Value = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    let list = |key| List::of(&document, key);
    let (buffers, views, accessors) = (list("buffers"), list("bufferViews"), list("accessors"));
    let (images, samplers, textures) = (list("images"), list("samplers"), list("textures"));
    let (materials, meshes, nodes) = (list("materials"), list("meshes"), list("nodes"));
    let (cameras, scenes) = (list("cameras"), list("scenes"));
    let mut out = json!({ "asset": { "version": "2.0" } });
    let made = buffers.names.iter().zip(&buffers.values).map(|(name, buffer)| {
        let is_whole = *name == "binary_glTF" || *name == "KHR_binary_glTF";
        members(buffer, if is_whole { &["byteLength"] } else { &["byteLength", "uri"] })
    });
    insert(&mut out, "buffers", made.collect());
    let (made_views, made_accessors) = columns(&accessors, &views, &buffers);
    insert(&mut out, "bufferViews", made_views);
    insert(&mut out, "accessors", made_accessors);
    let made = images.values.iter().map(|image| {
        let binary = image.get("extensions").and_then(|all| all.get("KHR_binary_glTF"));
        let Some(binary) = binary else { return members(image, &["uri", "name"]) };
        let mut made = members(binary, &["mimeType"]);
        put(&mut made, "bufferView", views.number(binary, "bufferView"));
        made
    });
    insert(&mut out, "images", made.collect());
    let made = samplers.values.iter();
    let made = made.map(|s| members(s, &["magFilter", "minFilter", "wrapS", "wrapT"]));
    insert(&mut out, "samplers", made.collect());
    let made = textures.values.iter().map(|texture| {
        let mut made = json!({});
        put(&mut made, "sampler", samplers.number(texture, "sampler"));
        put(&mut made, "source", images.number(texture, "source"));
        made
    });
    insert(&mut out, "textures", made.collect());
    let made = materials.values.iter().map(|value| material(value, &textures, not_drawn));
    insert(&mut out, "materials", made.collect());
    let made = meshes.values.iter().map(|mesh| {
        let all = mesh.get("primitives").and_then(Value::as_array).into_iter().flatten();
        let primitives: Vec<Value> = all
            .map(|primitive| {
                let names = primitive.get("attributes").and_then(Value::as_object);
                let attribute = |(name, accessor): (&String, &Value)| {
                    // The first set of each kind had no number.
                    let name = match name.as_str() {
                        "COLOR" | "TEXCOORD" => format!("{name}_0"),
                        "JOINT" => "JOINTS_0".to_owned(),
                        "WEIGHT" => "WEIGHTS_0".to_owned(),
                        _ => name.clone(),
                    };
                    Some((name, accessors.numbers.get(accessor.as_str()?).copied()?.into()))
                };
                let mut made = members(primitive, &["mode"]);
                let attributes: Map<String, Value> =
                    names.into_iter().flatten().filter_map(attribute).collect();
                made["attributes"] = attributes.into();
                put(&mut made, "indices", accessors.number(primitive, "indices"));
                put(&mut made, "material", materials.number(primitive, "material"));
                made
            })
            .collect();
        let mut made = members(mesh, &["name"]);
        made["primitives"] = primitives.into();
        made
    });
    insert(&mut out, "meshes", made.collect());
    let mut made_nodes: Vec<Value> = Vec::new();
    let mut more: Vec<Value> = Vec::new();
    for node in &nodes.values {
        let mut made = members(node, &["name", "matrix", "rotation", "scale", "translation"]);
        let mut children = nodes.all(node, "children");
        let shown = meshes.all(node, "meshes");
        put(&mut made, "mesh", shown.first().copied());
        for mesh in shown.iter().skip(1) {
            children.push(nodes.values.len() + more.len());
            more.push(json!({ "mesh": mesh }));
        }
        if !children.is_empty() {
            made["children"] = children.into();
        }
        put(&mut made, "camera", cameras.number(node, "camera"));
        if node.get("skin").is_some() {
            *not_drawn.entry("skin".to_owned()).or_default() += 1;
        }
        made_nodes.push(made);
    }
    made_nodes.extend(more);
    insert(&mut out, "nodes", made_nodes);
    let lens = |camera: &Value| members(camera, &["name", "perspective", "orthographic"]);
    insert(&mut out, "cameras", cameras.values.iter().copied().map(lens).collect());
    let made = scenes.values.iter().map(|scene| json!({ "nodes": nodes.all(scene, "nodes") }));
    insert(&mut out, "scenes", made.collect());
    put(&mut out, "scene", scenes.number(&document, "scene"));
    let animations = document.get("animations").and_then(Value::as_object).map_or(0, Map::len);
    if animations > 0 {
        *not_drawn.entry("animation".to_owned()).or_default() += animations as u64;
    }
    serde_json::to_vec(&out).map(Some).map_err(|error| error.to_string())
}

fn insert(out: &mut Value, name: &str, list: Vec<Value>) {
    if !list.is_empty() {
        out[name] = list.into();
    }
}

/// Buffer views and accessors. An accessor whose elements are apart gets a view of its own.
fn columns(accessors: &List<'_>, views: &List<'_>, buffers: &List<'_>) -> (Vec<Value>, Vec<Value>) {
    let view = |view: &Value| {
        let mut made = members(view, &["byteLength", "byteOffset"]);
        put(&mut made, "buffer", buffers.number(view, "buffer"));
        made
    };
    let mut made_views: Vec<Value> = views.values.iter().map(|&value| view(value)).collect();
    let made = accessors.values.iter().map(|accessor| {
        let kept = ["byteOffset", "componentType", "count", "normalized", "type"];
        let mut made = members(accessor, &kept);
        let mut number = views.number(accessor, "bufferView");
        let stride = accessor.get("byteStride").and_then(Value::as_u64).filter(|&s| s > 0);
        if let (Some(stride), Some(of)) = (stride, number) {
            let mut apart = view(views.values[of]);
            apart["byteStride"] = stride.into();
            number = Some(made_views.len());
            made_views.push(apart);
        }
        put(&mut made, "bufferView", number);
        made
    });
    let made = made.collect();
    (made_views, made)
}

fn material(value: &Value, textures: &List<'_>, not_drawn: &mut BTreeMap<String, u64>) -> Value {
    let common = value.get("extensions").and_then(|all| all.get("KHR_materials_common"));
    let values = common.unwrap_or(value).get("values").unwrap_or(&Value::Null);
    let mut pbr = json!({ "metallicFactor": 0 });
    if let Some(number) = textures.number(values, "diffuse") {
        pbr["baseColorTexture"] = json!({ "index": number });
    } else if let Some(colour) = values.get("diffuse").and_then(Value::as_array) {
        // Its colours are those of the screen.
        let channel = |at: usize| {
            let channel = colour.get(at).and_then(Value::as_f64).unwrap_or(1.0);
            if at < 3 { decoded(channel) } else { channel }
        };
        pbr["baseColorFactor"] = json!([channel(0), channel(1), channel(2), channel(3)]);
    }
    let shiny = shiny(values, &mut pbr);
    for (member, key) in [
        ("specular", "specular colour of material"),
        ("emission", "emission of material"),
        ("ambient", "ambient colour of material"),
        ("bump", "bump map"),
    ] {
        let is_lit = |value: &Value| match value {
            Value::Array(channels) => {
                channels.iter().take(3).any(|channel| channel.as_f64().is_some_and(|c| c > 0.0))
            }
            value => value.is_string(),
        };
        let is_drawn = member == "specular" && shiny.is_some();
        if !is_drawn && values.get(member).is_some_and(is_lit) {
            *not_drawn.entry(key.to_owned()).or_default() += 1;
        }
    }
    let mut made = members(value, &["name"]);
    made["pbrMetallicRoughness"] = pbr;
    if let Some(shiny) = shiny {
        made["extensions"] = json!({ "KHR_materials_pbrSpecularGlossiness": shiny });
    }
    if made.get("extensions").is_none() {
        // Its light is not that of glTF 2.0.
        made["extensions"] = json!({ "KHR_materials_common": {} });
    }
    // Culling is a state of the technique, which is not read.
    made["doubleSided"] = true.into();
    made
}

/// A material with a specular colour and an exponent as one of the extension that has gloss, with the diffuse part of
/// `pbr`: of such a gloss that [`super::materials`] makes the exponent of it again.
fn shiny(values: &Value, pbr: &mut Value) -> Option<Value> {
    let channels = values.get("specular")?.as_array()?;
    let channel = |at: usize| channels.get(at).and_then(Value::as_f64).unwrap_or(0.0);
    let exponent = values.get("shininess")?.as_f64().filter(|&exponent| exponent > 0.0)?;
    if (0..3).all(|at| channel(at) <= 0.0) {
        return None;
    }
    let gloss = 1.0 - libm::pow(2.0 / (exponent + 2.0), 0.25);
    let factor = [0, 1, 2].map(|at| decoded(channel(at)));
    let mut shiny = json!({ "specularFactor": factor, "glossinessFactor": gloss });
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
