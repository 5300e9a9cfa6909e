//! Pictures that materials name: search beside the model, the options of a texture in an MTL, decoding.

use std::cell::OnceCell;
use std::collections::HashMap;
use std::ffi::OsString;
use std::io::Cursor;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use glam::DVec2;
use image::{DynamicImage, ImageDecoder as _, ImageFormat, ImageReader, Limits};
use rasterproof_core::grid::MAX_SIDE_PX;
use rasterproof_host::{input, limits};
use rasterproof_render::pipeline::opacity::{AlphaMode, Opacity, OpacityMap};
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};
use sha2::{Digest as _, Sha256};

use crate::{BadFile, Wrong};

/// Entries of a folder that are compared with a name: more than a folder of models has.
const MOST_ENTRIES: usize = 1 << 16;

/// What is said of a picture that cannot be decoded; what follows may quote its bytes.
pub(crate) const UNREADABLE: &str = "is not a readable PNG, JPEG, BMP, TGA, TIFF or WebP";

/// A picture as a texture and, where it has some, with opacities.
#[derive(Clone, Debug)]
pub(crate) struct Decoded {
    /// Its colours, read by the filter that the file asks for.
    pub texture: Texture,
    /// The opacities of its texels, where some are not opaque.
    alpha: Option<OpacityMap>,
    /// The texture as opacities, of one that is named as an opacity map and has none of its own.
    of_colours: OnceCell<OpacityMap>,
}

impl Decoded {
    /// Its opacities, read as the texture is.
    pub(crate) fn opacity(&self) -> Option<Arc<OpacityMap>> {
        Some(Arc::new(self.alpha.clone()?.as_read(&self.texture)))
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
    let read = || {
        let bytes = input::read(path, limits::TEXTURE_BYTES)?;
        Ok(decode(path, &bytes, &mut 0)?.texture)
    };
    read().map_err(|wrong: Wrong| wrong.of(path))
}

/// The pictures that materials name, each decoded once, however often and by however many names it is named.
#[derive(Default)]
pub(crate) struct Pictures {
    /// Also those that are broken, so that they are not decoded again.
    decoded: HashMap<PictureKey, Result<Decoded, String>>,
    /// Bytes of the files so far, one that was read several times counted as often.
    read_bytes: u64,
    /// What the textures take so far, those that turned out to be broken too, since they took as long.
    taken_bytes: u64,
}

/// The hash of the bytes, and whether they are those of a TGA.
type PictureKey = ([u8; 32], bool);

impl Pictures {
    /// A picture by its bytes, of which at most so many as are given to it are read; the path is that of its file, or of
    /// the file that contains it.
    pub(crate) fn get(
        &mut self,
        path: &Path,
        read: impl FnOnce(u64) -> Result<Vec<u8>, String>,
    ) -> Result<&Decoded, String> {
        let most = limits::ALL_TEXTURE_FILES_BYTES;
        let left_bytes = most.saturating_sub(self.read_bytes);
        if left_bytes == 0 {
            let most = most >> 20;
            return Err(format!(
                "is not read, since the pictures before it have {most} MiB, the most of a model: make them smaller"
            ));
        }
        let bytes = read(left_bytes.min(limits::TEXTURE_BYTES))?;
        self.read_bytes += bytes.len() as u64;
        // Two files with the same bytes are one picture.
        let key = (Sha256::digest(&bytes).into(), is_tga(path));
        let Self { decoded, taken_bytes, .. } = self;
        let decoded = decoded.entry(key).or_insert_with(|| decode(path, &bytes, taken_bytes));
        decoded.as_ref().map_err(String::clone)
    }
}

/// Whether the name ends as that of a TGA.
fn is_tga(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("tga"))
}

/// Decodes a picture, and adds what it takes to what all pictures took before.
fn decode(path: &Path, bytes: &[u8], taken_bytes: &mut u64) -> Result<Decoded, String> {
    let failed = |error| format!("{UNREADABLE}: {error}");
    // Of a slice, as `image` itself reads, so that decoders are not compiled once more.
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| error.to_string())?;
    if reader.format().is_none() && is_tga(path) {
        reader.set_format(ImageFormat::Tga);
    }
    let mut sides = Limits::default();
    sides.max_image_width = Some(MAX_SIDE_PX);
    sides.max_image_height = Some(MAX_SIDE_PX);
    sides.max_alloc = Some(limits::DECODED_TEXTURE_BYTES);
    reader.limits(sides);
    // The head of the picture is read, and so much is known that its size can be refused before it is decoded.
    let decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    let is_grey = !decoder.color_type().has_color();
    let kept_bytes = u64::from(width) * u64::from(height) * if is_grey { 1 } else { 4 };
    if kept_bytes.max(decoder.total_bytes()) > limits::DECODED_TEXTURE_BYTES {
        let most = limits::DECODED_TEXTURE_BYTES >> 20;
        return Err(format!(
            "has {width} x {height} px, which take more than {most} MiB: make the picture smaller"
        ));
    }
    if *taken_bytes + kept_bytes > limits::ALL_TEXTURES_BYTES {
        let [own, before, most] =
            [kept_bytes, *taken_bytes, limits::ALL_TEXTURES_BYTES].map(|bytes| bytes >> 20);
        return Err(format!(
            "has {width} x {height} px, which take {own} MiB; with the {before} MiB of the pictures before it that is more \
             than the {most} MiB of all textures of a model: make the pictures smaller"
        ));
    }
    *taken_bytes += kept_bytes;
    let picture = DynamicImage::from_decoder(decoder).map_err(failed)?;
    // Opacities are kept apart from colours, for not all surfaces use them.
    let alpha = alpha(&picture).and_then(|alpha| Texture::grey(width, height, alpha));
    let texture = if is_grey {
        Texture::grey(width, height, picture.into_luma8().into_raw())
    } else {
        Texture::new(width, height, picture.into_rgb8().as_chunks::<3>().0)
    };
    let texture = texture.ok_or("is a picture without pixels")?;
    Ok(Decoded { texture, alpha: alpha.map(OpacityMap::new), of_colours: OnceCell::new() })
}

/// The opacities of a picture; nothing where all of it is opaque.
fn alpha(picture: &DynamicImage) -> Option<Vec<u8>> {
    let of = |all: &mut dyn Iterator<Item = u8>| {
        let alpha: Vec<u8> = all.collect();
        alpha.iter().any(|alpha| *alpha != u8::MAX).then_some(alpha)
    };
    match picture {
        // These are not copied first.
        DynamicImage::ImageRgba8(pixels) => of(&mut pixels.pixels().map(|pixel| pixel.0[3])),
        DynamicImage::ImageLumaA8(pixels) => of(&mut pixels.pixels().map(|pixel| pixel.0[1])),
        other if other.color().has_alpha() => {
            of(&mut other.to_luma_alpha8().pixels().map(|pixel| pixel.0[1]))
        }
        _ => None,
    }
}

/// The file that a model means by a name that it contains: as it is written, with slashes for backslashes, with
/// other cases of letters, or the last part of the name beside the model.
pub(crate) fn find(folder: &Path, name: &str) -> Option<PathBuf> {
    // Names as files write them, from the most literal on.
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
pub(crate) struct TextureStatement {
    /// The picture, as the file writes it.
    pub name: String,
    /// By which texture coordinates are multiplied.
    pub scale: DVec2,
    /// What is added to them afterwards.
    pub offset: DVec2,
    /// Whether the borders go on, where usually the picture repeats.
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

impl TextureStatement {
    /// Reads options and a name, which may contain spaces; nothing without a name.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let (scale, offset) = (DVec2::ONE, DVec2::ZERO);
        let name = String::new();
        let mut this = Self { name, scale, offset, clamp: false, not_applied: Vec::new() };
        let mut rest = text.trim();
        while let Some((option, after)) = next_word(rest).filter(|(word, _)| word.starts_with('-'))
        {
            // Options may stand in any order before the name.
            let fixed = NOT_APPLIED.iter().find(|(name, _)| *name == option);
            // How many words may follow the option.
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

/// The first word of a text, and what follows it.
fn next_word(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (end > 0).then(|| text.split_at(end))
}

/// The textures that materials name as files.
pub(crate) struct Textures {
    folder: PathBuf,
    pictures: Pictures,
    /// What came of each path, so that no file is read twice.
    read: HashMap<PathBuf, Result<Decoded, BadFile>>,
    /// How many names were looked for and not found.
    missing: u32,
}

/// Names that are not found, after which names are taken as they are written: a search reads a folder.
const MOST_MISSING: u32 = 1 << 10;

impl Textures {
    /// None yet, of a model in this folder.
    pub(crate) fn new(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            pictures: Pictures::default(),
            read: HashMap::new(),
            missing: 0,
        }
    }

    /// The picture of this name, read with a filter.
    pub(crate) fn get(&mut self, name: &str, clamp: bool) -> Result<Decoded, BadFile> {
        let mut decoded = self.find(name)?.clone();
        let wrap = if clamp { Wrap::Clamp } else { Wrap::Repeat };
        decoded.texture = decoded.texture.with(Filter::Bilinear, wrap);
        Ok(decoded)
    }

    /// The opacities of the picture of this name: its own, or those that its colours stand for.
    pub(crate) fn opacity_map(
        &mut self,
        name: &str,
        clamp: bool,
    ) -> Result<Arc<OpacityMap>, BadFile> {
        let decoded = self.find(name)?;
        let of_colours = || OpacityMap::new(decoded.texture.clone());
        let map =
            decoded.alpha.as_ref().unwrap_or_else(|| decoded.of_colours.get_or_init(of_colours));
        let wrap = if clamp { Wrap::Clamp } else { Wrap::Repeat };
        Ok(Arc::new(map.clone().with(Filter::Bilinear, wrap)))
    }

    /// The picture of this name, searched for and decoded once.
    fn find(&mut self, name: &str) -> Result<&Decoded, BadFile> {
        // Where options are written in another way, the last word is the name.
        let last = name.split_whitespace().next_back().unwrap_or_default();
        let search = || find(&self.folder, name).or_else(|| find(&self.folder, last));
        let found = if self.missing < MOST_MISSING { search() } else { None };
        self.missing += u32::from(found.is_none() && self.missing < MOST_MISSING);
        let path = found.unwrap_or_else(|| self.folder.join(name.replace('\\', "/")));
        let Self { read, pictures, .. } = self;
        let read = read.entry(path).or_insert_with_key(|path| {
            let bytes = |limit| input::read(path, limit).map_err(|error| error.cause);
            pictures.get(path, bytes).cloned().map_err(|cause| Wrong::from(cause).of(path))
        });
        read.as_ref().map_err(BadFile::clone)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_of_a_texture_are_read() {
        let parse = |text: &str| TextureStatement::parse(text).unwrap();
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
            assert_eq!(TextureStatement::parse(empty), None, "{empty:?}");
        }
    }
}
