//! Models and textures from files: OBJ with MTL through `tobj`, PNG, JPEG and BMP through `image`
//! (the book's sections 11.2 and 11.3).
//!
//! A file is checked line by line before it is read, so that an error names the line. OBJ files are
//! right-handed: z is negated. Polygons become fans, missing normals are computed, colours and
//! textures come from `Kd` and `map_Kd`.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt;
use std::fs;
use std::io::{self, Cursor};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use image::{ImageReader, Limits};

use super::{Corner, Item, Material, Mesh, Shading, shapes};
use crate::pipeline::texture::{Filter, Texture, Wrap};
use rasterproof_core::grid::MAX_SIDE_PX;

/// What is wrong with a file, where, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadFile {
    /// The file.
    pub path: PathBuf,
    /// The line, from 1, where there are lines.
    pub line: Option<usize>,
    /// What is wrong.
    pub cause: String,
}

impl fmt::Display for BadFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": {}", self.cause)
    }
}

impl std::error::Error for BadFile {}

/// Files beyond this are refused: 1 GiB.
const MOST_BYTES: u64 = 1 << 30;

fn bad(path: &Path, line: Option<usize>, cause: impl Into<String>) -> BadFile {
    BadFile { path: path.to_owned(), line, cause: cause.into() }
}

fn read(path: &Path) -> Result<Vec<u8>, BadFile> {
    let failed = |error: io::Error| bad(path, None, format!("cannot be read: {error}"));
    let data = fs::metadata(path).map_err(failed)?;
    if data.is_dir() {
        return Err(bad(path, None, "is a directory, not a file"));
    }
    if !data.is_file() {
        return Err(bad(path, None, "is not a regular file"));
    }
    if data.len() > MOST_BYTES {
        return Err(bad(path, None, format!("has more than {MOST_BYTES} bytes")));
    }
    fs::read(path).map_err(failed)
}

/// The bytes of a text, without the byte order mark that some editors put before it.
fn read_text(path: &Path) -> Result<Vec<u8>, BadFile> {
    let mut bytes = read(path)?;
    if bytes.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    Ok(bytes)
}

/// A model: one item for each material, and what was left out.
#[derive(Clone, Debug)]
pub struct Model {
    /// Its parts, in the file's order.
    pub items: Vec<Item>,
    /// What is missing and was done without, for the reader.
    pub warnings: Vec<String>,
}

/// Reads a model with its materials and textures.
///
/// # Errors
/// [`BadFile`] for a file that cannot be read, a coordinate that is no finite number, an index that
/// is out of range, a model without faces, a texture that cannot be decoded. A material file that
/// is missing is a warning: the model is grey.
pub fn load(path: &Path, shading: Shading) -> Result<Model, BadFile> {
    let bytes = read_text(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let text = checked(path, &text)?;
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let warnings = RefCell::new(Vec::new());
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    let loaded = tobj::load_obj_buf(&mut Cursor::new(text), &options, |name| {
        let file = folder.join(name);
        match read_text(&file) {
            Ok(bytes) => tobj::load_mtl_buf(&mut Cursor::new(bytes)),
            Err(error) => {
                warnings.borrow_mut().push(format!("{error}; the model is drawn grey"));
                Ok(Default::default())
            }
        }
    });
    let (models, materials) =
        loaded.map_err(|error| bad(path, None, format!("is not a readable OBJ: {error}")))?;
    let materials = match materials {
        Ok(materials) => materials,
        Err(error) => {
            warnings.borrow_mut().push(format!("{}: a material file: {error}", path.display()));
            Vec::new()
        }
    };
    let mut textures = Textures { folder, read: HashMap::new() };
    let made = materials
        .iter()
        .map(|material| textures.material(material, shading))
        .collect::<Result<Vec<_>, _>>()?;
    let grey = Material { colour: DVec3::splat(0.8), shading, ..Material::default() };
    let items = models
        .iter()
        .filter(|model| !model.mesh.indices.is_empty())
        .map(|model| {
            let material = model.mesh.material_id.and_then(|id| made.get(id)).unwrap_or(&grey);
            Item::new(mesh(&model.mesh), material.clone())
        })
        .collect();
    Ok(Model { items, warnings: warnings.into_inner() })
}

/// The textures that materials name, each read once.
struct Textures {
    folder: PathBuf,
    read: HashMap<String, Arc<Texture>>,
}

impl Textures {
    fn material(
        &mut self,
        material: &tobj::Material,
        shading: Shading,
    ) -> Result<Material, BadFile> {
        let [r, g, b] = material.diffuse.unwrap_or([0.8; 3]).map(f64::from);
        let texture = match material.diffuse_texture.as_deref().map(str::trim) {
            None | Some("") => None,
            Some(name) => Some(self.texture(name)?),
        };
        let colour = DVec3::new(r, g, b);
        let colour = if colour.is_finite() { colour } else { DVec3::splat(0.8) };
        Ok(Material { colour, vertex_colours: false, texture, shading })
    }

    fn texture(&mut self, name: &str) -> Result<Arc<Texture>, BadFile> {
        if let Some(texture) = self.read.get(name) {
            return Ok(texture.clone());
        }
        // Options such as `-s 1 1 1` come before the name; other systems write backslashes.
        let file = name.rsplit(' ').next().unwrap_or(name).replace('\\', "/");
        let whole = self.folder.join(name.replace('\\', "/"));
        let path = if whole.exists() { whole } else { self.folder.join(file) };
        let texture = Arc::new(load_texture(&path)?.with(Filter::Bilinear, Wrap::Repeat));
        self.read.insert(name.to_owned(), texture.clone());
        Ok(texture)
    }
}

/// Reads a PNG, JPEG or BMP, whatever its name ends in.
///
/// # Errors
/// [`BadFile`] where it cannot be read or decoded, or a side exceeds the largest one.
pub fn load_texture(path: &Path) -> Result<Texture, BadFile> {
    let bytes = read(path)?;
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| bad(path, None, error.to_string()))?;
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE_PX);
    limits.max_image_height = Some(MAX_SIDE_PX);
    reader.limits(limits);
    let cause = |error| format!("is not a readable PNG, JPEG or BMP: {error}");
    let picture = reader.decode().map_err(|error| bad(path, None, cause(error)))?.into_rgb8();
    let rgb: Vec<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).collect();
    Texture::new(picture.width(), picture.height(), &rgb)
        .ok_or_else(|| bad(path, None, "is a picture without pixels"))
}

/// A mesh of `tobj` as ours: left-handed, with normals.
fn mesh(source: &tobj::Mesh) -> Mesh {
    let vector = |list: &[f32], index: u32| {
        let at = index as usize * 3;
        list.get(at..at + 3)
            .map_or(DVec3::ZERO, |v| DVec3::new(f64::from(v[0]), f64::from(v[1]), -f64::from(v[2])))
    };
    let positions =
        (0..source.positions.len() as u32 / 3).map(|i| vector(&source.positions, i)).collect();
    let corner = |at: usize| {
        let normal = source.normal_indices.get(at).map(|&i| vector(&source.normals, i));
        let uv = source.texcoord_indices.get(at).and_then(|&i| {
            let at = i as usize * 2;
            source.texcoords.get(at..at + 2)
        });
        Corner {
            position: source.indices[at],
            colour: DVec3::ONE,
            normal: normal.unwrap_or_default().normalize_or_zero(),
            uv: uv.map_or(DVec2::ZERO, |v| DVec2::new(f64::from(v[0]), f64::from(v[1]))),
        }
    };
    let triangles = (0..source.indices.len() / 3)
        .map(|i| [corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)])
        .collect();
    shapes::with_smooth_normals(Mesh { positions, triangles })
}

/// Numbers of positions, texture coordinates and normals.
type Counts = [usize; 3];

/// Checks every line that the model consists of. Where some corners lack a texture coordinate or a
/// normal that others have, returns the text with a neutral one in their place, since `tobj` keeps
/// the three lists of a mesh apart by their lengths.
fn checked(path: &Path, text: &str) -> Result<String, BadFile> {
    let mut counts: Counts = [0; 3];
    let mut faces: Vec<(usize, Vec<[Option<i64>; 3]>)> = Vec::new();
    for (number, line) in text.lines().enumerate().map(|(i, line)| (i + 1, line)) {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        let (kind, least) = match words.next() {
            Some("v") => (0, 3),
            Some("vt") => (1, 1),
            Some("vn") => (2, 3),
            Some("f") => {
                let corners = words
                    .map(|word| face_corner(word, counts))
                    .collect::<Result<Vec<_>, _>>()
                    .map_err(|cause| bad(path, Some(number), cause))?;
                if corners.len() < 3 {
                    return Err(bad(path, Some(number), "a face needs three corners or more"));
                }
                faces.push((number, corners));
                continue;
            }
            _ => continue,
        };
        check_numbers(words, least).map_err(|cause| bad(path, Some(number), cause))?;
        counts[kind] += 1;
    }
    if faces.is_empty() {
        return Err(bad(path, None, "has no faces (lines that begin with 'f'); is it an OBJ?"));
    }
    for (number, corners) in &faces {
        check_range(corners, counts).map_err(|cause| bad(path, Some(*number), cause))?;
    }
    Ok(completed(text, &faces, counts))
}

fn check_numbers<'a>(words: impl Iterator<Item = &'a str>, least: usize) -> Result<(), String> {
    let mut found = 0;
    for word in words.take(3) {
        match word.parse::<f32>() {
            Ok(value) if value.is_finite() => found += 1,
            Ok(_) => return Err(format!("'{}' is not a finite number", short(word))),
            Err(_) => return Err(format!("'{}' is not a number", short(word))),
        }
    }
    if found < least {
        return Err(format!("{found} numbers where {least} are needed"));
    }
    Ok(())
}

fn short(word: &str) -> String {
    word.chars().filter(|c| !c.is_control()).take(40).collect()
}

/// `position/texture/normal` as indices from 1; negative ones count back from here.
fn face_corner(word: &str, counts: Counts) -> Result<[Option<i64>; 3], String> {
    let mut corner = [None; 3];
    for (kind, part) in word.split('/').enumerate() {
        if kind > 2 {
            return Err(format!("'{}' has more than three parts", short(word)));
        }
        if part.is_empty() && kind > 0 {
            continue;
        }
        let index: i64 =
            part.parse().map_err(|_| format!("'{}' is not a corner of a face", short(word)))?;
        let index = if index < 0 { counts[kind] as i64 + 1 + index } else { index };
        if index < 1 {
            return Err(format!("'{}' names what is not there", short(word)));
        }
        corner[kind] = Some(index);
    }
    Ok(corner)
}

fn check_range(corners: &[[Option<i64>; 3]], counts: Counts) -> Result<(), String> {
    for corner in corners {
        for (kind, name) in ["position", "texture coordinate", "normal"].into_iter().enumerate() {
            let (index, count) = (corner[kind].unwrap_or(0), counts[kind]);
            if index > count as i64 {
                return Err(format!("{name} {index} is not there; the file has {count}"));
            }
        }
    }
    Ok(())
}

/// The text, every face with the same kinds of indices.
fn completed(text: &str, faces: &[(usize, Vec<[Option<i64>; 3]>)], counts: Counts) -> String {
    let corners = || faces.iter().flat_map(|(_, corners)| corners);
    let some = [1, 2].map(|kind| corners().any(|corner| corner[kind].is_some()));
    let all = [1, 2].map(|kind| corners().all(|corner| corner[kind].is_some()));
    if some == all {
        return text.to_owned();
    }
    let neutral = counts.map(|count| count as i64 + 1);
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for (number, corners) in faces {
        let mut line = String::from("f");
        for corner in corners {
            let [position, uv, normal] = [0, 1, 2].map(|kind| {
                let wanted = kind == 0 || some[kind - 1];
                let index = corner[kind].unwrap_or(neutral[kind]);
                if wanted { index.to_string() } else { String::new() }
            });
            line += &match (some[0], some[1]) {
                (true, false) => format!(" {position}/{uv}"),
                _ => format!(" {position}/{uv}/{normal}"),
            };
        }
        lines[number - 1] = line;
    }
    // At the end, where they change the number of nothing else.
    format!("{}\nvt 0 0\nvn 0 0 0\n", lines.join("\n"))
}
