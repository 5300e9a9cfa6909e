//! Pictures that materials name: search beside the model, the options of a texture in an MTL, decoding.

use std::collections::HashMap;
use std::ffi::OsString;
use std::io::Cursor;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use glam::DVec2;
use image::{DynamicImage, ImageDecoder as _, ImageFormat, ImageReader, Limits};
use rasterproof_core::grid::MAX_SIDE_PX;
use rasterproof_host::limits;
use rasterproof_render::pipeline::opacity::{AlphaMode, Opacity, OpacityMap};
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};

use crate::{BadFile, bad, read_bytes};

/// Entries of a folder that are compared with a name: more than a folder of models has.
const MOST_ENTRIES: usize = 1 << 16;

/// What is said of a picture that cannot be decoded; what follows may quote its bytes.
pub(crate) const UNREADABLE: &str = "is not a readable PNG, JPEG, BMP, TGA, TIFF or WebP";

#[derive(Clone, Debug)]
pub(crate) struct Decoded {
    pub texture: Arc<Texture>,
    /// The opacities of its texels, grey, where some are not opaque.
    pub alpha: Option<Arc<Texture>>,
}

impl Decoded {
    pub(crate) fn opacity(&self) -> Option<Arc<OpacityMap>> {
        let (filter, wrap) = (self.texture.filter, self.texture.wrap);
        let alpha = Texture::clone(self.alpha.as_ref()?).with(filter, wrap);
        Some(Arc::new(OpacityMap::new(alpha)))
    }
}

/// The opacity of a surface whose file does not say what becomes of it: one that is opaque but for its map has holes
/// where that is below a half, any other blends.
pub(crate) fn opacity(factor: f64, map: Option<Arc<OpacityMap>>) -> Option<Opacity> {
    let mode = if factor < 1.0 { AlphaMode::Blend } else { AlphaMode::Test { threshold: 0.5 } };
    (factor < 1.0 || map.is_some()).then_some(Opacity { factor, map, mode })
}

/// Reads a PNG, JPEG, BMP, TIFF or WebP, whatever its name ends in, or a TGA by its ending, since its content
/// has no mark.
///
/// # Errors
/// [`BadFile`] where it cannot be read or decoded, or a side exceeds the largest one.
pub fn load_texture(path: &Path) -> Result<Texture, BadFile> {
    let decoded = decode(path, read_bytes(path, limits::TEXTURE_BYTES)?)?;
    Ok(Arc::unwrap_or_clone(decoded.texture))
}

/// Decodes a picture; the path is that of its file, or of the file that contains it.
pub(crate) fn decode(path: &Path, bytes: Vec<u8>) -> Result<Decoded, BadFile> {
    let cause = |error| format!("{UNREADABLE}: {error}");
    let failed = |error| bad(path, None, cause(error));
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| bad(path, None, error.to_string()))?;
    let is_tga = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("tga"));
    if reader.format().is_none() && is_tga {
        reader.set_format(ImageFormat::Tga);
    }
    let mut sides = Limits::default();
    sides.max_image_width = Some(MAX_SIDE_PX);
    sides.max_image_height = Some(MAX_SIDE_PX);
    sides.max_alloc = Some(limits::DECODED_TEXTURE_BYTES);
    reader.limits(sides);
    let decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    let is_grey = !decoder.color_type().has_color();
    let has_alpha = decoder.color_type().has_alpha();
    let kept_bytes = u64::from(width) * u64::from(height) * if is_grey { 1 } else { 4 };
    if kept_bytes.max(decoder.total_bytes()) > limits::DECODED_TEXTURE_BYTES {
        let most = limits::DECODED_TEXTURE_BYTES >> 20;
        let cause = format!(
            "has {width} x {height} px, which take more than {most} MiB: make the picture smaller"
        );
        return Err(bad(path, None, cause));
    }
    let picture = DynamicImage::from_decoder(decoder).map_err(failed)?;
    let alpha: Vec<u8> = match has_alpha {
        true => picture.to_luma_alpha8().pixels().map(|pixel| pixel.0[1]).collect(),
        false => Vec::new(),
    };
    let is_opaque = alpha.iter().all(|alpha| *alpha == u8::MAX);
    let alpha = if is_opaque { None } else { Texture::grey(width, height, alpha) };
    let texture = if is_grey {
        Texture::grey(width, height, picture.into_luma8().into_raw())
    } else {
        Texture::new(width, height, picture.into_rgb8().as_chunks::<3>().0)
    };
    let texture = texture.ok_or_else(|| bad(path, None, "is a picture without pixels"))?;
    Ok(Decoded { texture: Arc::new(texture), alpha: alpha.map(Arc::new) })
}

/// The file that a model means by a name that it contains: as it is written, with slashes for backslashes, with
/// other cases of letters, or the last part of the name beside the model.
pub(crate) fn find(folder: &Path, name: &str) -> Option<PathBuf> {
    let trimmed = name.trim();
    let plain = trimmed.strip_prefix('"').and_then(|name| name.strip_suffix('"'));
    let plain = plain.unwrap_or(trimmed);
    let slashes = plain.replace('\\', "/");
    let bare = slashes.rsplit('/').next().unwrap_or_default();
    // A name may begin or end with a space.
    let as_written = (name != plain).then_some(name);
    let names = as_written.into_iter().chain([plain, &slashes, bare]);
    names.into_iter().find_map(|name| find_any_case(folder, Path::new(name)))
}

/// A path below a folder whose parts may be written with other cases of letters.
fn find_any_case(folder: &Path, name: &Path) -> Option<PathBuf> {
    if name.as_os_str().is_empty() {
        return None;
    }
    let whole = folder.join(name);
    if whole.is_file() {
        return Some(whole);
    }
    let mut found = folder.to_owned();
    for part in name.components() {
        match part {
            Component::Normal(part) if !found.join(part).exists() => {
                found.push(other_case(&found, &part.to_string_lossy())?);
            }
            part => found.push(part),
        }
    }
    found.is_file().then_some(found)
}

/// The first entry of a folder in alphabetical order that differs from a name by the case of letters alone.
fn other_case(folder: &Path, name: &str) -> Option<OsString> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = folder.read_dir().ok()?.take(MOST_ENTRIES).flatten();
    let names = entries.map(|entry| entry.file_name());
    let name = name.to_lowercase();
    names.filter(|entry| entry.to_string_lossy().to_lowercase() == name).min()
}

/// What follows `map_Kd`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Described {
    pub name: String,
    /// By which texture coordinates are multiplied.
    pub scale: DVec2,
    /// What is added to them afterwards.
    pub offset: DVec2,
    pub clamp: bool,
    /// Options that change the picture and are not applied.
    pub not_applied: Vec<&'static str>,
}

/// The options of a texture that have no effect here, with the numbers of words that follow them.
const NOT_APPLIED: [(&str, usize); 10] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-cc", 1),
    ("-mm", 2),
    ("-bm", 1),
    ("-boost", 1),
    ("-imfchan", 1),
    ("-texres", 1),
    ("-type", 1),
    ("-colorspace", 1),
];

/// Values of options that say what happens without the option.
fn is_default(option: &str, values: &[&str]) -> bool {
    match option {
        "-blendu" | "-blendv" => values == ["on"],
        "-cc" => values == ["off"],
        "-mm" => values.iter().map(|value| value.parse::<f64>().ok()).eq([Some(0.0), Some(1.0)]),
        "-t" => values.iter().all(|value| value.parse() == Ok(0.0)),
        "-boost" => values.iter().all(|value| value.parse() == Ok(0.0)),
        _ => false,
    }
}

impl Described {
    /// Reads options and a name, which may contain spaces; nothing without a name.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let (scale, offset) = (DVec2::ONE, DVec2::ZERO);
        let name = String::new();
        let mut this = Self { name, scale, offset, clamp: false, not_applied: Vec::new() };
        let mut rest = text.trim();
        while let Some((option, after)) = next_word(rest).filter(|(word, _)| word.starts_with('-'))
        {
            let fixed = NOT_APPLIED.iter().find(|(name, _)| *name == option);
            let most = match (option, fixed) {
                (_, Some((_, count))) => *count,
                ("-s" | "-o" | "-t", _) => 3,
                ("-clamp", _) => 1,
                // A name that begins with a dash.
                _ => break,
            };
            let (mut values, mut left) = (Vec::new(), after);
            while let Some((word, after)) = next_word(left).filter(|_| values.len() < most) {
                // Of three numbers the last ones may be missing.
                if most == 3 && word.parse::<f64>().is_err() {
                    break;
                }
                values.push(word);
                left = after;
            }
            let number = |at: usize, missing: f64| {
                let number = values.get(at).and_then(|word| word.parse().ok());
                number.filter(|number: &f64| number.abs() <= 1e9).unwrap_or(missing)
            };
            match (option, fixed) {
                ("-s", _) => this.scale = DVec2::new(number(0, 1.0), number(1, 1.0)),
                ("-o", _) => this.offset = DVec2::new(number(0, 0.0), number(1, 0.0)),
                ("-clamp", _) => this.clamp = values.first() == Some(&"on"),
                ("-t", _) if !is_default("-t", &values) => this.not_applied.push("-t"),
                (_, Some((name, _))) if !is_default(name, &values) => this.not_applied.push(name),
                _ => {}
            }
            rest = left;
        }
        let name = rest.trim();
        name.clone_into(&mut this.name);
        (!name.is_empty()).then_some(this)
    }
}

fn next_word(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (end > 0).then(|| text.split_at(end))
}

/// The textures that materials name, each decoded once.
pub(crate) struct Textures {
    folder: PathBuf,
    read: HashMap<PathBuf, Result<Decoded, BadFile>>,
    missing: u32,
}

/// Names that are not found, after which names are taken as they are written: a search reads a folder.
const MOST_MISSING: u32 = 1 << 10;

impl Textures {
    pub(crate) fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), read: HashMap::new(), missing: 0 }
    }

    pub(crate) fn get(&mut self, name: &str, clamp: bool) -> Result<Decoded, BadFile> {
        // Where options are written in another way, the last word is the name.
        let last = name.split_whitespace().next_back().unwrap_or_default();
        let search = || find(&self.folder, name).or_else(|| find(&self.folder, last));
        let found = if self.missing < MOST_MISSING { search() } else { None };
        self.missing += u32::from(found.is_none() && self.missing < MOST_MISSING);
        let path = found.unwrap_or_else(|| self.folder.join(name.replace('\\', "/")));
        let read = self.read.entry(path).or_insert_with_key(|path| {
            let mut decoded = decode(path, read_bytes(path, limits::TEXTURE_BYTES)?)?;
            let texture = Arc::unwrap_or_clone(decoded.texture);
            decoded.texture = Arc::new(texture.with(Filter::Bilinear, Wrap::Repeat));
            Ok(decoded)
        });
        let mut decoded = read.clone()?;
        if clamp {
            let texture = Arc::unwrap_or_clone(decoded.texture);
            decoded.texture = Arc::new(texture.with(Filter::Bilinear, Wrap::Clamp));
        }
        Ok(decoded)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_of_a_texture_are_read() {
        let parse = |text: &str| Described::parse(text).unwrap();
        let plain = parse("my picture (1).png");
        assert_eq!((plain.name.as_str(), plain.scale), ("my picture (1).png", DVec2::ONE));
        let all = parse("-s 2 3 1 -o 0.5 -clamp on -mm 0 2 -blendu on -t 0 0 0 a b.png");
        assert_eq!((all.scale, all.offset), (DVec2::new(2.0, 3.0), DVec2::new(0.5, 0.0)));
        assert_eq!(
            (all.name.as_str(), all.clamp, &all.not_applied[..]),
            ("a b.png", true, &["-mm"][..])
        );
        assert_eq!(parse("-blendu off -bm 2 c.png").not_applied, ["-blendu", "-bm"]);
        assert_eq!(parse("-dash.png").name, "-dash.png");
        assert_eq!(parse("-s nan 1e300 x.png").scale, DVec2::ONE);
        for empty in ["", "-s 1 1 1", "-clamp", "-mm 1"] {
            assert_eq!(Described::parse(empty), None, "{empty:?}");
        }
    }
}
