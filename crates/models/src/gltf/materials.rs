//! What is drawn of the materials of a glTF, and what is not.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use glam::{DAffine2, DVec2, DVec3};
use rasterproof_host::text::printable_short;
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::{AlphaMode as OpacityMode, Opacity, OpacityMap};
use rasterproof_render::pipeline::physical::{Map, Physical};
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};

use super::data::{Data, resource};
use super::document::{
    CLAMP_TO_EDGE, Info, LINEAR, LINEAR_MIPMAP_LINEAR, LINEAR_MIPMAP_NEAREST, MIRRORED_REPEAT,
    Material, NEAREST, NEAREST_MIPMAP_LINEAR, NEAREST_MIPMAP_NEAREST, Sampler, Transform, entry,
};
use crate::contents::{Contents, Sides, Surface};
use crate::outside;
use crate::records;
use crate::textures::{Decoded, Pictures};
use rasterproof_core::arrays::MapArray as _;

/// Where a texture finds its coordinates: their number among those of a vertex, and what moves them before the lookup; v points
/// down, as in glTF.
pub(super) type Coordinates = (u32, DAffine2);

/// A surface, and the coordinates of its texture and of maps that are read elsewhere.
pub(super) struct Described {
    pub surface: Surface,
    /// Of the texture, and of the first map that has others.
    pub uvs: [Option<Coordinates>; 2],
}

/// The channel as a picture stores it: colours of a glTF that are no picture are linear.
pub(crate) fn encoded(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        return 12.92 * linear.max(0.0);
    }
    // The formula misses 1 by the last bit.
    if linear >= 1.0 { 1.0 } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

/// The pictures of a document, by their numbers.
#[derive(Default)]
pub(super) struct Images {
    /// Decoded by their bytes, so that a picture of several names is decoded once.
    pictures: Pictures,
    /// By their numbers, also those that cannot be read, so that they are not read again.
    read: HashMap<usize, Result<Decoded, String>>,
}

impl Images {
    /// The picture of this number, decoded where it is first asked for.
    fn get(&mut self, data: &Data<'_>, number: usize) -> Result<Decoded, String> {
        let Self { pictures, read } = self;
        let new = || {
            let image = data.root.images.get(number).ok_or("is not there")?;
            // A TGA has no mark, so its ending is needed.
            let name = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"));
            let bytes = |limit| match (&image.uri, image.buffer_view) {
                (Some(uri), _) => resource(&data.folder, uri, limit),
                (None, Some(view)) => Ok(data.view(view)?.0.to_vec()),
                (None, None) => Err("names no picture".to_owned()),
            };
            pictures.get(Path::new(name.unwrap_or("")), bytes).cloned()
        };
        let read = read.entry(number).or_insert_with(new);
        read.clone().map_err(|cause| {
            let image = data.root.images.get(number);
            let is_outside = match image.and_then(|image| image.uri.as_deref()) {
                Some(uri) => data.is_outside(uri),
                None => data.has_outside_buffer(),
            };
            let cause = if is_outside { outside::without_details(&cause) } else { cause };
            format!("images[{number}] {cause}")
        })
    }
}

/// Describes a material, or that of a primitive that names none. It has the values that the format gives to what a material leaves
/// out, but for metal: a file that says nothing of its surfaces does not ask for mirrors, and without anything to
/// mirror, they would be dark.
pub(super) fn describe(
    data: &Data<'_>,
    number: Option<usize>,
    images: &mut Images,
    contents: &mut Contents,
) -> Option<Described> {
    let mut missing = Material::default();
    missing.pbr_metallic_roughness.metallic_factor = Some(0.0);
    let material = match number {
        Some(number) => data.root.materials.get(number)?,
        None => &missing,
    };
    // What is counted and what is warned of, while the reader holds the other parts.
    let Contents { not_drawn, warnings, .. } = contents;
    let mut count = |key: &str| *not_drawn.entry(key.to_owned()).or_default() += 1;
    let pbr = &material.pbr_metallic_roughness;
    let other = material.extensions.glossiness.as_ref();
    let unlit = material.extensions.unlit.is_some();
    let info = colour_texture(material);
    let factor = other.map_or(pbr.base_color_factor, |other| other.diffuse_factor);
    let [r, g, b, alpha] = factor.unwrap_or([1.0; 4]);
    // A highlight is drawn of a surface with gloss, but not if a map changes it from texel to texel.
    let mut specular = Specular::default();
    if let Some(other) = other {
        let colour = other.specular_factor.unwrap_or([1.0; 3]);
        let is_shiny = colour.iter().any(|&channel| channel > 0.0);
        if is_shiny && other.specular_glossiness_texture.is_some() {
            count("specular colour with a map of material");
        } else if is_shiny {
            specular = glossy(colour, other.glossiness_factor.unwrap_or(1.0));
            if specular.shininess <= 0.0 {
                count("specular colour without gloss of material");
            }
        }
    }
    let is_physical = is_physical(material);
    // Light has no effect on it, and its maps are of other surfaces.
    let is_plain = !is_physical && !unlit;
    let emits = material.emissive_factor.iter().any(|&channel| channel > 0.0);
    // What it has and is not drawn is counted.
    for (key, is_there) in [
        ("specular map", other.is_some_and(|other| other.specular_glossiness_texture.is_some())),
        ("normal map", is_plain && material.normal_texture.is_some()),
        ("occlusion map", is_plain && material.occlusion_texture.is_some()),
        ("emission map", is_plain && material.emissive_texture.is_some()),
        ("emission of material", is_plain && material.emissive_texture.is_none() && emits),
    ] {
        if is_there {
            count(key);
        }
    }
    // The base colour is a factor and a texture.
    let mode = alpha_mode(material);
    // One without a name is called by its number.
    let name = match (&material.name, number) {
        (Some(name), _) => records::name(name).to_owned(),
        (None, Some(number)) => format!("materials[{number}]"),
        (None, None) => String::new(),
    };
    let decoded = match info.map(|info| texture(data, info, images)) {
        None => None,
        Some(Ok(decoded)) => Some(decoded),
        Some(Err(cause)) => {
            let name = printable_short(&name, 40);
            let text = format!("{cause}; the material '{name}' is drawn in its colour");
            warnings.add("textures", &text);
            None
        }
    };
    // Textures and colours of an unlit surface are decoded before they are filtered or interpolated, as those of a physical one.
    let is_linear = is_physical || unlit;
    let physical = is_linear.then(|| {
        let linear = DVec3::new(r.into(), g.into(), b.into()).clamp(DVec3::ZERO, DVec3::ONE);
        if unlit {
            return (linear, Arc::new(Physical::default()));
        }
        let mut missing = |map: Map, cause: String| {
            let name = printable_short(&name, 40);
            let text =
                format!("{cause}; the material '{name}' is drawn without its {}", named(map));
            warnings.add("textures", &text);
        };
        (linear, Arc::new(physical(data, material, images, &mut count, &mut missing)))
    });
    // Opacities are the product of a factor and of those of the picture.
    let map = decoded.as_ref().and_then(Decoded::opacity);
    let factor = f64::from(alpha).clamp(0.0, 1.0);
    // A file may let blend what is opaque everywhere.
    let is_opaque = map.is_none() && factor == 1.0;
    let opacity = mode.filter(|_| !is_opaque).map(|mode| Opacity { factor, map, mode });
    let texture = decoded.map(|decoded| match is_linear {
        true => Arc::new(decoded.texture.decoded()),
        false => Arc::new(decoded.texture),
    });
    let has_maps = physical.as_ref().is_some_and(|(_, of)| of.maps.iter().any(Option::is_some));
    // Without a picture no coordinates are needed.
    let uvs = coordinates(material);
    Some(Described {
        uvs: [uvs[0].filter(|_| texture.is_some() || has_maps), uvs[1]],
        surface: Surface {
            name,
            colour: DVec3::new(r.into(), g.into(), b.into()).map(encoded),
            texture,
            specular,
            opacity,
            physical,
            unlit,
            sides: if material.double_sided { Sides::Both } else { Sides::Front },
        },
    })
}

/// What becomes of opacities; nothing where they have no effect.
pub(super) fn alpha_mode(material: &Material) -> Option<OpacityMode> {
    let threshold = f64::from(material.alpha_cutoff.unwrap_or(0.5));
    match &*material.alpha_mode {
        "MASK" => Some(OpacityMode::Test { threshold }),
        "BLEND" => Some(OpacityMode::Blend),
        _ => None,
    }
}

/// A map of all opacities, one after the other.
pub(super) fn opacities() -> Arc<OpacityMap> {
    let all = Texture::grey(256, 1, (0..=u8::MAX).collect()).unwrap_or_else(Texture::white);
    Arc::new(OpacityMap::new(all.with(Filter::Bilinear, Wrap::Clamp)))
}

/// Where an opacity is in that map: those between two texels too.
pub(super) fn uv_of_opacity(opacity: f64) -> DVec2 {
    DVec2::new((opacity * 255.0 + 0.5) / 256.0, 0.5)
}

/// The texture of the base colour, by either kind of material.
fn colour_texture(material: &Material) -> Option<&Info> {
    match &material.extensions.glossiness {
        Some(other) => other.diffuse_texture.as_ref(),
        None => material.pbr_metallic_roughness.base_color_texture.as_ref(),
    }
}

/// Whether a surface is one of metal and roughness, in linear light.
fn is_physical(material: &Material) -> bool {
    let extensions = &material.extensions;
    extensions.glossiness.is_none() && extensions.common.is_none() && extensions.unlit.is_none()
}

/// Each map of a surface in linear light that has an effect, with the texture that the material names for it.
fn maps(material: &Material) -> [(Map, Option<&Info>); Map::ALL.len()] {
    Map::ALL.map_array(|map| {
        let info = match map {
            Map::Emission if material.emissive_factor.iter().all(|of| *of <= 0.0) => &None,
            Map::Emission => &material.emissive_texture,
            Map::Metal => &material.pbr_metallic_roughness.metallic_roughness_texture,
            Map::Occlusion => &material.occlusion_texture,
            Map::Normal => &material.normal_texture,
        };
        (map, info.as_ref())
    })
}

fn named(map: Map) -> &'static str {
    match map {
        Map::Emission => "emission",
        Map::Metal => "map of metal and roughness",
        Map::Occlusion => "occlusion map",
        Map::Normal => "normal map",
    }
}

/// The coordinates of the texture of a material, or of its first map, and those of the first map that has others.
fn coordinates(material: &Material) -> [Option<Coordinates>; 2] {
    let maps = maps(material).into_iter().filter(|_| is_physical(material));
    let all = colour_texture(material).into_iter().chain(maps.filter_map(|(_, info)| info));
    let mut all = all.map(of_info);
    let first = all.next();
    [first, all.find(|of| Some(*of) != first)]
}

/// Where a texture is read: an extension may name another set and move the coordinates.
fn of_info(info: &Info) -> Coordinates {
    let transform = info.extensions.transform.as_ref();
    let set = transform.and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord);
    (set, transform.map_or(DAffine2::IDENTITY, affine))
}

/// What is reflected where there is no metal, from straight ahead and at grazing angles, as two extensions state it.
fn reflected(material: &Material, count: &mut impl FnMut(&str)) -> (DVec3, f64) {
    let extensions = &material.extensions;
    let ior = extensions.refraction.as_ref().map(|of| f64::from(of.ior.unwrap_or(1.5)));
    // The share that is reflected from straight ahead, by the index of refraction.
    let straight = match ior {
        // The one of the format.
        None | Some(1.5) => 0.04,
        // By the extension it stands for an infinite one.
        Some(0.0) => 1.0,
        Some(ior) => ((ior.max(1.0) - 1.0) / (ior.max(1.0) + 1.0)).powi(2),
    };
    let Some(of) = &extensions.specular else { return (DVec3::splat(straight), 1.0) };
    if of.specular_texture.is_some() || of.specular_color_texture.is_some() {
        count("map of what is reflected of material");
    }
    let colour = of.specular_color_factor.unwrap_or([1.0; 3]);
    let colour = DVec3::from_array(colour.map_array(|channel| f64::from(channel).max(0.0)));
    let part = f64::from(of.specular_factor.unwrap_or(1.0)).clamp(0.0, 1.0);
    ((straight * colour).min(DVec3::ONE) * part, part)
}

/// A number from 0 to 1, which is 1 where the file leaves it out.
fn share(number: Option<f32>) -> f64 {
    f64::from(number.unwrap_or(1.0)).clamp(0.0, 1.0)
}

/// All of a physical surface but its base colour.
fn physical(
    data: &Data<'_>,
    material: &Material,
    images: &mut Images,
    count: &mut impl FnMut(&str),
    missing: &mut dyn FnMut(Map, String),
) -> Physical {
    let pbr = &material.pbr_metallic_roughness;
    let strength = material.extensions.emissive.as_ref().and_then(|of| of.emissive_strength);
    let [r, g, b] = material.emissive_factor.map_array(|channel| f64::from(channel).max(0.0));
    let info = |map: Map| maps(material)[map as usize].1;
    let (straight, grazing) = reflected(material, count);
    let mut surface = Physical {
        straight,
        grazing,
        metal: share(pbr.metallic_factor),
        roughness: share(pbr.roughness_factor),
        emission: DVec3::new(r, g, b) * f64::from(strength.unwrap_or(1.0)).max(0.0),
        occlusion: share(info(Map::Occlusion).and_then(|info| info.strength)),
        bumps: info(Map::Normal).and_then(|info| info.scale).unwrap_or(1.0).into(),
        ..Physical::default()
    };
    // A map that cannot be read is done without; light that a map should have limited is then not emitted.
    for (map, info) in maps(material) {
        // A map is read at one of two sets of coordinates.
        let Some(info) = info else { continue };
        match coordinates(material).iter().position(|of| *of == Some(of_info(info))) {
            None => count("map with a third kind of texture coordinates of material"),
            Some(number) => match texture(data, info, images) {
                Ok(Decoded { texture, .. }) => {
                    let is_colour = map == Map::Emission;
                    let texture = if is_colour { texture.decoded() } else { texture };
                    surface.maps[map as usize] = Some(Arc::new(texture));
                    surface.second[map as usize] = number == 1;
                    continue;
                }
                Err(cause) => missing(map, cause),
            },
        }
        if map == Map::Emission {
            surface.emission = DVec3::ZERO;
        }
    }
    surface
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
fn texture(data: &Data<'_>, info: &Info, images: &mut Images) -> Result<Decoded, String> {
    let number = info.index;
    let texture = entry(&data.root.textures, "textures", number)?;
    let webp = texture.extensions.webp.as_ref().and_then(|webp| webp.source);
    let source = texture.source.or(webp).filter(|&source| source < data.root.images.len());
    let missing = || format!("textures[{number}] has no picture that is read");
    let mut decoded = images.get(data, source.ok_or_else(missing)?)?;
    let sampler = texture.sampler.and_then(|sampler| data.root.samplers.get(sampler));
    decoded.texture = sampled(decoded.texture, sampler.copied().unwrap_or_default());
    Ok(decoded)
}

/// A texture that is read as a sampler says. Where it does not say it, filters are linear and there is no mip map.
fn sampled(texture: Texture, sampler: Sampler) -> Texture {
    let wrap = [sampler.wrap_s, sampler.wrap_t].map_array(|wrap| match wrap {
        Some(CLAMP_TO_EDGE) => Wrap::Clamp,
        Some(MIRRORED_REPEAT) => Wrap::Mirror,
        _ => Wrap::Repeat,
    });
    let nearest = sampler.mag_filter == Some(NEAREST);
    let filter = if nearest { Filter::Nearest } else { Filter::Bilinear };
    let texture = texture.with(filter, wrap);
    match sampler.min_filter {
        Some(NEAREST) => texture.with_minified(Filter::Nearest),
        Some(LINEAR) => texture.with_minified(Filter::Bilinear),
        Some(NEAREST_MIPMAP_NEAREST) => {
            texture.with_mip_map().with_minified(Filter::Nearest).with_single_levels()
        }
        Some(LINEAR_MIPMAP_NEAREST) => {
            texture.with_mip_map().with_minified(Filter::Bilinear).with_single_levels()
        }
        Some(NEAREST_MIPMAP_LINEAR) => texture.with_mip_map().with_minified(Filter::Nearest),
        Some(LINEAR_MIPMAP_LINEAR) => texture.with_mip_map().with_minified(Filter::Bilinear),
        _ => texture,
    }
}

/// The map of texture coordinates, by a rotation that is counter-clockwise with v down.
fn affine(transform: &Transform) -> DAffine2 {
    let [scale, offset] = [transform.scale.unwrap_or([1.0; 2]), transform.offset]
        .map_array(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
    let angle = f64::from(transform.rotation);
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    DAffine2::from_cols(DVec2::new(cos, -sin) * scale.x, DVec2::new(sin, cos) * scale.y, offset)
}

#[cfg(test)]
mod tests {
    use super::super::document::read;
    use super::*;

    #[test]
    fn what_a_material_leaves_out_is_as_in_the_specification() {
        let json = br#"{"asset": {"version": "2.0"}, "nodes": [{"children": null}], "materials": [
            {"emissiveFactor": [1, 1, 1], "extensions": {"KHR_materials_emissive_strength": {}}},
            {"extensions": {"KHR_materials_pbrSpecularGlossiness": {}}},
            {"extensions": {"KHR_materials_ior": {}}},
            {"extensions": {"KHR_materials_specular": {}}}
        ]}"#;
        let root = read(json).unwrap();
        assert!(root.nodes[0].children.is_empty());
        let data = Data::new(root, Path::new("").into(), None).unwrap();
        let mut images = Images::default();
        let mut described = |number| {
            describe(&data, Some(number), &mut images, &mut Contents::default()).unwrap().surface
        };
        let physical = |surface: &Surface| surface.physical.clone().unwrap();
        let (colour, metal) = physical(&described(0));
        assert_eq!((colour, metal.metal, metal.roughness), (DVec3::ONE, 1.0, 1.0));
        assert_eq!((metal.emission, metal.straight), (DVec3::ONE, DVec3::splat(0.04)));
        let glossy = described(1);
        assert_eq!((glossy.colour, glossy.specular.colour), (DVec3::ONE, DVec3::ONE));
        assert_eq!(glossy.specular.shininess, f64::MAX);
        let straight = [2, 3].map(|number| physical(&described(number)).1);
        let reflected = straight.map(|of| (of.straight, of.grazing));
        assert_eq!(reflected, [(DVec3::splat(0.04), 1.0); 2]);
        assert_eq!(affine(&Transform::default()), DAffine2::IDENTITY);
    }
}
