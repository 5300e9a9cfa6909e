//! Material files (MTL): the colour and the texture of each material, and what of it is not drawn.

use std::collections::BTreeSet;
use std::path::Path;

use glam::DVec3;
use rasterproof_host::text::printable_short;
use rasterproof_render::pipeline::highlight::Specular;

use crate::Warnings;
use crate::outside::NOT_QUOTED;
use crate::{records, textures};

/// A material as its file describes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct MtlMaterial {
    /// Its name, for `usemtl`.
    pub name: String,
    /// Whether messages may quote its file.
    pub is_quoted: bool,
    /// Its diffuse colour (`Kd`).
    pub colour: Option<DVec3>,
    /// Its texture (`map_Kd`).
    pub texture: Option<textures::TextureStatement>,
    /// How opaque it is (`d`, or 1 - `Tr`), in [0, 1].
    pub opacity: Option<f64>,
    /// The picture whose values are opacities, from `map_d`.
    pub opacity_map: Option<textures::TextureStatement>,
    /// What else it has, which is not drawn: keys of [`crate::contents::Contents::not_drawn`].
    pub not_drawn: BTreeSet<String>,
    /// `Ka`, which is drawn only if it is the diffuse colour.
    ambient: Option<DVec3>,
    ambient_map: Option<textures::TextureStatement>,
    /// Its specular colour (`Ks`) and exponent (`Ns`).
    specular: Specular,
    /// Whether `map_Ks` makes the highlights brighter and darker.
    has_specular_map: bool,
    /// Whether the model of light (`illum` 0 or 1) has no highlights.
    is_matt: bool,
}

/// Lines that change nothing that could be seen: an empty line is one. The index of refraction has an effect with
/// refraction alone, which `illum` says.
const WITHOUT_EFFECT: [&str; 5] = ["", "ni", "sharpness", "map_aat", "halo"];

/// Words of physically based shading.
const PHYSICAL: [&str; 8] = ["pr", "pm", "ps", "pc", "pcr", "aniso", "anisor", "nr"];

/// Reads the text of a material file. A line that cannot be understood is a warning, which quotes it where it may be quoted.
pub(crate) fn read(
    path: &Path,
    text: &str,
    is_quoted: bool,
    warnings: &mut Warnings,
) -> Vec<MtlMaterial> {
    let mut materials = Vec::new();
    // Files of old systems end their lines with a carriage return alone.
    let text = text.replace("\r\n", "\n");
    for (index, line) in text.split(['\n', '\r']).enumerate() {
        let line = without_comment(line).trim();
        let (kind, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        if let Err(cause) = read_line(kind, rest.trim(), &mut materials) {
            let text = match is_quoted {
                true => format!("{cause}; the line is left out"),
                false => format!("the line cannot be read and is left out; it is {NOT_QUOTED}"),
            };
            warnings.add_of(path, index + 1, "lines", &text);
        }
    }
    for material in &mut materials {
        material.is_quoted = is_quoted;
        material.finish();
    }
    materials
}

/// A line up to a comment. Names may contain the sign, so it begins a comment only after a space.
pub(crate) fn without_comment(line: &str) -> &str {
    let mut before = ' ';
    for (at, character) in line.char_indices() {
        if character == '#' && before.is_whitespace() {
            return &line[..at];
        }
        before = character;
    }
    line
}

/// Reads a line by its first word, into the last material.
fn read_line(kind: &str, rest: &str, materials: &mut Vec<MtlMaterial>) -> Result<(), String> {
    let lower = kind.to_ascii_lowercase();
    if lower == "newmtl" {
        materials
            .push(MtlMaterial { name: records::name(rest).to_owned(), ..MtlMaterial::default() });
        return Ok(());
    }
    if WITHOUT_EFFECT.contains(&lower.as_str()) {
        return Ok(());
    }
    // A word that the format has, whether it is drawn or not.
    let is_map = lower.starts_with("map_")
        || ["bump", "disp", "decal", "refl", "norm"].contains(&lower.as_str());
    let colour_words = ["kd", "ka", "ks", "ke", "km", "kt", "tf"];
    let number_words = ["ns", "d", "tr", "illum"];
    let is_physical = PHYSICAL.contains(&lower.as_str());
    let is_known = is_map
        || is_physical
        || colour_words.contains(&lower.as_str())
        || number_words.contains(&lower.as_str());
    if !is_known {
        return Err(format!("'{}' is not a line of a material file", printable_short(kind, 40)));
    }
    let material = materials.last_mut().ok_or_else(|| format!("'{kind}' before any 'newmtl'"))?;
    // Of what is not drawn a wrong number is no loss.
    let number = rest.split_whitespace().next_back().and_then(|word| word.parse::<f64>().ok());
    let parsed = || textures::TextureStatement::parse(rest);
    match lower.as_str() {
        "kd" => material.colour = Some(colour(kind, rest)?),
        "ka" => material.ambient = colour(kind, rest).ok(),
        "ks" => material.specular.colour = colour(kind, rest)?.max(DVec3::ZERO),
        "ns" => material.specular.shininess = number.unwrap_or_default(),
        "map_kd" => material.texture = parsed(),
        "map_ka" => material.ambient_map = parsed(),
        "map_d" | "map_tr" | "map_opacity" => material.opacity_map = parsed(),
        "map_ks" => material.has_specular_map = true,
        "d" => {
            let finite = number.filter(|number| number.is_finite());
            material.opacity = finite.map(|d| d.clamp(0.0, 1.0));
        }
        // Some programs write the opposite, so a 1 means nothing for sure.
        "tr" if number.is_some_and(|number| number > 0.0 && number < 1.0) => {
            material.opacity = number.map(|number| 1.0 - number);
        }
        "illum" if number == Some(0.0) || number == Some(1.0) => material.is_matt = true,
        _ => {}
    }
    // A black colour changes nothing, so it is not counted.
    let is_lit = || colour("", rest).is_ok_and(|colour| colour.max_element() > 0.0);
    // What the line says and is not drawn, if it says something that could be seen.
    let key = match lower.as_str() {
        "map_kd" | "map_ka" | "map_d" | "map_tr" | "map_opacity" => return Ok(()),
        _ if is_map && parsed().is_none() => return Ok(()),
        "bump" | "map_bump" => "bump map",
        "norm" | "map_kn" => "normal map",
        "disp" | "map_disp" => "displacement map",
        "decal" | "map_decal" => "decal",
        "refl" | "map_refl" => "reflection map",
        "map_ks" => "specular map",
        "map_ns" => "shininess map",
        "map_ke" => "emission map",
        _ if is_map => "other map",
        "ke" if is_lit() => "emission of material",
        "km" | "kt" if is_lit() => "reflection or transmission colour of material",
        "tf" if colour("", rest).is_ok_and(|c| c != DVec3::ONE && c != DVec3::ZERO) => {
            "transmission filter of material"
        }
        "illum" if number == Some(0.0) => "constant light (illum 0) of material",
        "illum" if number.is_some_and(|number| number > 2.0) => "reflection (illum) of material",
        _ if is_physical && number.is_some_and(|number| number != 0.0) => {
            "physically based value of material"
        }
        _ => return Ok(()),
    };
    material.not_drawn.insert(key.to_owned());
    Ok(())
}

impl MtlMaterial {
    /// Its highlights, as far as they are drawn: not those that a map makes brighter and darker, nor those of a
    /// model of light that has none.
    pub(crate) fn specular(&self) -> Specular {
        let Specular { colour, shininess } = self.specular;
        let is_drawn = !self.is_matt && !self.has_specular_map && shininess > 0.0;
        if is_drawn && colour != DVec3::ZERO { self.specular } else { Specular::default() }
    }

    /// Compares the ambient colour with the diffuse one, which is used in its place.
    fn finish(&mut self) {
        let differs = |colour: DVec3| colour != DVec3::ZERO && Some(colour) != self.colour;
        if self.ambient.is_some_and(differs) {
            self.not_drawn.insert("ambient colour of material".to_owned());
        }
        let name =
            |map: &Option<textures::TextureStatement>| map.as_ref().map(|map| map.name.clone());
        if self.ambient_map.is_some() && name(&self.ambient_map) != name(&self.texture) {
            self.not_drawn.insert("ambient map".to_owned());
        }
        // Both are read at the texture coordinates of the texture.
        if let (Some(map), Some(texture)) = (&self.opacity_map, &self.texture)
            && (map.scale, map.offset) != (texture.scale, texture.offset)
        {
            self.not_drawn.insert("place of its own of opacity map".to_owned());
        }
        if self.specular.colour != DVec3::ZERO && !self.is_matt {
            if self.has_specular_map {
                self.not_drawn.insert("specular colour with a map of material".to_owned());
            } else if self.specular() == Specular::default() {
                // Without an exponent the whole surface would be one highlight.
                self.not_drawn
                    .insert("specular colour without shininess (Ns) of material".to_owned());
            }
        }
        for option in self.opacity_map.iter().flat_map(|map| &map.not_applied) {
            self.not_drawn.insert(format!("option {option} of opacity map"));
        }
        for option in self.texture.iter().flat_map(|texture| &texture.not_applied) {
            self.not_drawn.insert(format!("option {option} of texture"));
        }
    }
}

/// Three numbers, or one that is all three.
fn colour(kind: &str, rest: &str) -> Result<DVec3, String> {
    let mut numbers = Vec::new();
    for word in rest.split_whitespace().take(3) {
        match word.parse::<f64>() {
            // Larger ones are no numbers of single precision, which the format has.
            Ok(number) if number.abs() <= f64::from(f32::MAX) => numbers.push(number),
            _ => return Err(format!("'{}' is not a finite number", printable_short(word, 40))),
        }
    }
    match numbers[..] {
        [grey] => Ok(DVec3::splat(grey)),
        [r, g, b] => Ok(DVec3::new(r, g, b)),
        _ => Err(format!("'{kind}' has {} numbers where 3 are needed", numbers.len())),
    }
}
