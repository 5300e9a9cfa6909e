//! What is drawn of the materials of a glTF, and what is not.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::sync::Arc;

use glam::{DAffine2, DVec2, DVec3};
use rasterproof_host::text::printable_short;
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::{AlphaMode as OpacityMode, Opacity};
use rasterproof_render::pipeline::texture::{Filter, Wrap};

use super::data::{Data, is_outside, resource};
use super::document::{
    CLAMP_TO_EDGE, Info, LINEAR_MIPMAP_LINEAR, LINEAR_MIPMAP_NEAREST, MIRRORED_REPEAT, Material,
    NEAREST, NEAREST_MIPMAP_LINEAR, NEAREST_MIPMAP_NEAREST, Transform,
};
use crate::Warnings;
use crate::contents::Surface;
use crate::outside;
use crate::text;
use crate::textures::{Decoded, Pictures};

/// A surface, and where its texture finds its coordinates.
pub(super) struct Described {
    pub surface: Surface,
    /// The number of the texture coordinates among those of a vertex, where there is a texture.
    pub uv_set: Option<u32>,
    /// Moves texture coordinates before the lookup; v points down, as in glTF.
    pub uv_transform: DAffine2,
}

/// The channel as a picture stores it: colours of a glTF that are no picture are linear.
pub(super) fn encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        return 12.92 * linear.max(0.0);
    }
    // The formula misses 1 by the last bit.
    if linear >= 1.0 { 1.0 } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// The pictures of a document, by their numbers.
pub(super) struct Images<'a> {
    path: &'a Path,
    pictures: Pictures,
    read: HashMap<usize, Result<Decoded, String>>,
}

impl<'a> Images<'a> {
    pub(super) fn new(path: &'a Path) -> Self {
        Self { path, pictures: Pictures::default(), read: HashMap::new() }
    }

    fn get(&mut self, data: &Data<'_>, number: usize) -> Result<Decoded, String> {
        let Self { path, pictures, read } = self;
        let new = || {
            let image = data.root.images.get(number).ok_or("is not there")?;
            // A TGA has no mark, so its ending is needed.
            let name = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
            let bytes = |limit| match (&image.uri, image.buffer_view) {
                (Some(uri), _) => resource(path.parent().unwrap_or(Path::new("")), uri, limit),
                (None, Some(view)) => Ok(data.view(view)?.0.to_vec()),
                (None, None) => Err("names no picture".to_owned()),
            };
            pictures.get(Path::new(name.unwrap_or("")), bytes).cloned()
        };
        let read = read.entry(number).or_insert_with(new);
        read.clone().map_err(|cause| {
            let folder = path.parent().unwrap_or(Path::new(""));
            let image = data.root.images.get(number);
            let is_outside = match image.and_then(|image| image.uri.as_deref()) {
                Some(uri) => is_outside(folder, uri),
                None => data.has_outside_buffer(folder),
            };
            let cause = if is_outside { outside::without_details(&cause) } else { cause };
            format!("images[{number}] {cause}")
        })
    }
}

pub(super) fn describe(
    data: &Data<'_>,
    number: usize,
    images: &mut Images<'_>,
    not_drawn: &mut BTreeMap<String, u64>,
    warnings: &mut Warnings,
) -> Option<Described> {
    let material = data.root.materials.get(number)?;
    let mut count = |key: &str| *not_drawn.entry(key.to_owned()).or_default() += 1;
    let pbr = &material.pbr_metallic_roughness;
    let other = material.extensions.glossiness.as_ref();
    let unlit = material.extensions.unlit.is_some();
    let info = colour_texture(material);
    let [r, g, b, alpha] = match other {
        Some(other) => other.diffuse_factor,
        None => pbr.base_color_factor,
    };
    let mut specular = Specular::default();
    if let Some(other) = other {
        let is_shiny = other.specular_factor.iter().any(|&channel| channel > 0.0);
        if is_shiny && other.specular_glossiness_texture.is_some() {
            count("specular colour with a map of material");
        } else if is_shiny {
            specular = glossy(other.specular_factor, other.glossiness_factor);
            if specular.shininess <= 0.0 {
                count("specular colour without gloss of material");
            }
        }
    }
    let is_physical = other.is_none() && !unlit;
    let emits = material.emissive_factor.iter().any(|&channel| channel > 0.0);
    for (key, is_there) in [
        ("specular map", other.is_some_and(|other| other.specular_glossiness_texture.is_some())),
        ("metal of material", is_physical && pbr.metallic_factor > 0.0),
        ("reflection of material", is_physical && pbr.roughness_factor < 1.0),
        ("metal and roughness map", is_physical && pbr.metallic_roughness_texture.is_some()),
        ("normal map", material.normal_texture.is_some()),
        ("occlusion map", material.occlusion_texture.is_some()),
        ("emission map", material.emissive_texture.is_some()),
        ("emission of material", material.emissive_texture.is_none() && emits),
    ] {
        if is_there {
            count(key);
        }
    }
    let threshold = f64::from(material.alpha_cutoff.unwrap_or(0.5));
    let mode = match &*material.alpha_mode {
        "MASK" => Some(OpacityMode::Test { threshold }),
        "BLEND" => Some(OpacityMode::Blend),
        _ => None,
    };
    let name = material.name.as_deref().map(|name| text::name(name).to_owned());
    let name = name.unwrap_or_else(|| format!("materials[{number}]"));
    let decoded = info.and_then(|info| {
        let read = texture(data, info, images, &mut count);
        match read {
            Ok(decoded) => Some(decoded),
            Err(cause) => {
                let name = printable_short(&name, 40);
                let text = format!("{cause}; the material '{name}' is drawn in its colour");
                warnings.add(images.path, None, "textures", &text);
                None
            }
        }
    });
    let map = decoded.as_ref().and_then(Decoded::opacity);
    let factor = f64::from(alpha).clamp(0.0, 1.0);
    // A file may let blend what is opaque everywhere.
    let is_opaque = map.is_none() && factor == 1.0;
    let opacity = mode.filter(|_| !is_opaque).map(|mode| Opacity { factor, map, mode });
    let texture = decoded.map(|decoded| Arc::new(decoded.texture));
    let transform = info.and_then(transform);
    Some(Described {
        uv_set: uv_set(data, number).filter(|_| texture.is_some()),
        uv_transform: transform.map_or(DAffine2::IDENTITY, affine),
        surface: Surface {
            name,
            colour: DVec3::new(r.into(), g.into(), b.into()).map(encoded),
            texture,
            specular,
            opacity,
            unlit,
            both_sides: material.double_sided,
        },
    })
}

fn colour_texture(material: &Material) -> Option<&Info> {
    match &material.extensions.glossiness {
        Some(other) => other.diffuse_texture.as_ref(),
        None => material.pbr_metallic_roughness.base_color_texture.as_ref(),
    }
}

fn transform(info: &Info) -> Option<&Transform> {
    info.extensions.transform.as_ref()
}

/// The number of the texture coordinates that the texture of a material's colour is read at.
pub(super) fn uv_set(data: &Data<'_>, number: usize) -> Option<u32> {
    let info = colour_texture(data.root.materials.get(number)?)?;
    Some(transform(info).and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord))
}

/// The highlight that is about as wide as that of a physically based surface: of roughness a = (1 - gloss)^2, the
/// exponent 2 / a^2 - 2.
fn glossy([r, g, b]: [f32; 3], gloss: f32) -> Specular {
    let roughness = libm::pow(1.0 - f64::from(gloss).clamp(0.0, 1.0), 4.0);
    let colour = DVec3::new(r.into(), g.into(), b.into()).map(encoded);
    // Without any roughness it is a point, and its exponent the largest one.
    Specular { colour, shininess: (2.0 / roughness - 2.0).min(f64::MAX) }
}

/// The picture of a texture with its sampler.
fn texture(
    data: &Data<'_>,
    info: &Info,
    images: &mut Images<'_>,
    count: &mut impl FnMut(&str),
) -> Result<Decoded, String> {
    let number = info.index;
    let missing = || format!("textures[{number}] is not there");
    let texture = data.root.textures.get(number).ok_or_else(missing)?;
    let webp = texture.extensions.webp.as_ref().and_then(|webp| webp.source);
    let source = texture.source.or(webp).filter(|&source| source < data.root.images.len());
    let missing = || format!("textures[{number}] has no picture that is read");
    let mut decoded = images.get(data, source.ok_or_else(missing)?)?;
    let sampler = texture.sampler.and_then(|sampler| data.root.samplers.get(sampler));
    // Everything else repeats.
    let other =
        |wrap: Option<u64>| wrap.filter(|wrap| [CLAMP_TO_EDGE, MIRRORED_REPEAT].contains(wrap));
    let wraps = sampler.map_or([None; 2], |sampler| [sampler.wrap_s, sampler.wrap_t].map(other));
    if wraps.contains(&Some(MIRRORED_REPEAT)) {
        count("mirrored repetition of texture");
    } else if wraps[0] != wraps[1] {
        count("difference of repetition in u and v of texture");
    }
    let wrap = if wraps == [Some(CLAMP_TO_EDGE); 2] { Wrap::Clamp } else { Wrap::Repeat };
    let nearest = sampler.and_then(|sampler| sampler.mag_filter) == Some(NEAREST);
    let filter = if nearest { Filter::Nearest } else { Filter::Bilinear };
    decoded.texture = decoded.texture.with(filter, wrap);
    match sampler.and_then(|sampler| sampler.min_filter) {
        Some(NEAREST_MIPMAP_LINEAR | LINEAR_MIPMAP_LINEAR) => {
            decoded.texture = decoded.texture.with_mip_map()
        }
        Some(NEAREST_MIPMAP_NEAREST | LINEAR_MIPMAP_NEAREST) => {
            // Read between two levels, where the file asks for the nearer one.
            count("nearest level of mip map of texture");
            decoded.texture = decoded.texture.with_mip_map();
        }
        _ => {}
    }
    Ok(decoded)
}

/// The map of texture coordinates, by a rotation that is counter-clockwise with v down.
fn affine(transform: &Transform) -> DAffine2 {
    let [scale, offset] =
        [transform.scale, transform.offset].map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
    let angle = f64::from(transform.rotation);
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    DAffine2::from_cols(DVec2::new(cos, -sin) * scale.x, DVec2::new(sin, cos) * scale.y, offset)
}
