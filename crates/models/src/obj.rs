//! Models and textures from files: OBJ through `tobj`, PNG, JPEG and BMP through `image`
//! (the book's sections 11.2 and 11.3).
//!
//! A file is checked line by line before it is read, so that an error names the line. The module `mtl`
//! reads material files. OBJ files are right-handed: z is negated. Polygons become fans, missing normals are computed, colours and
//! textures come from `Kd` and `map_Kd`.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::fmt::Write as _;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use image::{DynamicImage, ImageDecoder as _, ImageReader, Limits};
use rasterproof_host::text::{printable_path, printable_short};
use rasterproof_host::{input, limits};

use crate::mtl::{self, Described};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::MAX_SIDE_PX;
use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};
use rasterproof_render::scene::{Corner, Item, Material, Mesh, Shading, shapes};

/// What is wrong with a file, where, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadFile {
    /// The file.
    pub path: PathBuf,
    /// The line, from 1, where there are lines.
    pub line: Option<usize>,
    pub cause: String,
}

impl fmt::Display for BadFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", printable_path(&self.path))?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": {}", self.cause)
    }
}

impl std::error::Error for BadFile {}

fn bad(path: &Path, line: Option<usize>, cause: impl Into<String>) -> BadFile {
    BadFile { path: path.to_owned(), line, cause: cause.into() }
}

fn read(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, BadFile> {
    input::read(path, limit_bytes).map_err(|error| bad(path, None, error.cause))
}

/// The bytes of a text, without the byte order mark that some editors put before it.
fn read_text(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, BadFile> {
    let mut bytes = read(path, limit_bytes)?;
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
    let bytes = read_text(path, limits::MODEL_BYTES)?;
    let text = String::from_utf8_lossy(&bytes);
    let Checked { text, libraries, mut warnings } = checked(path, &text)?;
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let materials = read_materials(&folder, &libraries, &mut warnings);
    let models = parsed(path, text, &materials)?;
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
    Ok(Model { items, warnings })
}

/// The materials of the files that a model names, in their order. A file that cannot be read is a
/// warning.
fn read_materials(
    folder: &Path,
    libraries: &[String],
    warnings: &mut Vec<String>,
) -> Vec<Described> {
    let (mut materials, mut left_bytes) = (Vec::new(), limits::MATERIAL_BYTES);
    for name in libraries {
        let file = folder.join(name);
        match read_text(&file, left_bytes) {
            Ok(bytes) => {
                left_bytes -= bytes.len() as u64;
                let read = mtl::read(&file, &String::from_utf8_lossy(&bytes));
                materials.extend(read.materials);
                warnings.extend(read.warnings);
            }
            Err(error) => warnings.push(format!("{error}; what it describes is drawn grey")),
        }
    }
    materials
}

/// The meshes of a text that was checked. `tobj` sees the names of the materials only.
fn parsed(path: &Path, text: String, materials: &[Described]) -> Result<Vec<tobj::Model>, BadFile> {
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    let numbers = materials.iter().enumerate();
    let named = |_: &Path| {
        let names = numbers.clone().map(|(number, material)| (material.name.clone(), number));
        Ok((Vec::new(), names.collect()))
    };
    // The text holds nothing that was not checked; a panic would end the program nevertheless.
    let load = || tobj::load_obj_buf(&mut Cursor::new(text), &options, named);
    match catch_unwind(AssertUnwindSafe(load)) {
        Ok(Ok((models, _))) => Ok(models),
        Ok(Err(error)) => Err(bad(path, None, format!("is not a readable OBJ: {error}"))),
        Err(_) => Err(bad(path, None, "is not a readable OBJ: the reader of models failed")),
    }
}

/// The textures that materials name, each read once.
struct Textures {
    folder: PathBuf,
    read: HashMap<String, Arc<Texture>>,
}

impl Textures {
    fn material(&mut self, material: &Described, shading: Shading) -> Result<Material, BadFile> {
        let colour =
            material.colour.map_or(DVec3::splat(0.8), |c| DVec3::from(c.map_array(f64::from)));
        let texture = match material.texture.as_deref() {
            None | Some("") => None,
            Some(name) => Some(self.texture(name)?),
        };
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
    let bytes = read(path, limits::TEXTURE_BYTES)?;
    let cause = |error| format!("is not a readable PNG, JPEG or BMP: {error}");
    let failed = |error| bad(path, None, cause(error));
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| bad(path, None, error.to_string()))?;
    let mut sides = Limits::default();
    sides.max_image_width = Some(MAX_SIDE_PX);
    sides.max_image_height = Some(MAX_SIDE_PX);
    sides.max_alloc = Some(limits::DECODED_TEXTURE_BYTES);
    reader.limits(sides);
    let decoder = reader.into_decoder().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    let is_grey = !decoder.color_type().has_color();
    let kept_bytes = u64::from(width) * u64::from(height) * if is_grey { 1 } else { 4 };
    if kept_bytes.max(decoder.total_bytes()) > limits::DECODED_TEXTURE_BYTES {
        let most = limits::DECODED_TEXTURE_BYTES >> 20;
        let cause = format!(
            "has {width} x {height} px, which take more than {most} MiB: make the picture smaller"
        );
        return Err(bad(path, None, cause));
    }
    let picture = DynamicImage::from_decoder(decoder).map_err(failed)?;
    let texture = if is_grey {
        Texture::grey(width, height, picture.into_luma8().into_raw())
    } else {
        Texture::new(width, height, picture.into_rgb8().as_chunks::<3>().0)
    };
    texture.ok_or_else(|| bad(path, None, "is a picture without pixels"))
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

/// A corner of a face: indices from 1 of its position, texture coordinate and normal.
type FaceCorner = [Option<i64>; 3];

/// A model as it is handed to `tobj`.
struct Checked {
    /// The vectors first, then names of groups and materials and the faces in their order.
    text: String,
    /// The material files that it names, each once.
    libraries: Vec<String>,
    warnings: Vec<String>,
}

/// What stands between the vectors.
enum Element<'a> {
    /// A group or an object begins. Nothing depends on its name.
    Group,
    /// The name of the material of the faces that follow.
    Material(&'a str),
    /// The line's number, and which of the corners are its.
    Face(usize, std::ops::Range<usize>),
}

/// Checks every line that the model consists of, and writes them anew: vectors without what is not
/// drawn, faces with absolute indices. Where some corners lack a texture coordinate or a normal that
/// others have, they get a neutral one, since `tobj` keeps the three lists of a mesh apart by their
/// lengths.
fn checked(path: &Path, text: &str) -> Result<Checked, BadFile> {
    let mut counts: Counts = [0; 3];
    let mut elements = Vec::new();
    let mut corners: Vec<FaceCorner> = Vec::new();
    let (mut libraries, mut seen) = (Vec::new(), HashSet::new());
    let mut loose = 0u64;
    // One line names all materials, which are read beforehand.
    let mut out = String::from("mtllib all\n");
    for (number, line) in text.lines().enumerate().map(|(i, line)| (i + 1, line)) {
        let line = line.split('#').next().unwrap_or_default().trim();
        let mut words = line.split_whitespace();
        let (kind, least, most) = match words.next() {
            Some("v") => (0, 3, 3),
            Some("vt") => (1, 1, 2),
            Some("vn") => (2, 3, 3),
            Some("f") => {
                let start = corners.len();
                for word in words {
                    let corner = face_corner(word, counts);
                    corners.push(corner.map_err(|cause| bad(path, Some(number), cause))?);
                }
                if corners.len() < start + 3 {
                    return Err(bad(path, Some(number), "a face needs three corners or more"));
                }
                elements.push(Element::Face(number, start..corners.len()));
                continue;
            }
            Some("o" | "g") => {
                elements.push(Element::Group);
                continue;
            }
            Some("usemtl") => {
                let name = line["usemtl".len()..].trim();
                if !name.is_empty() {
                    elements.push(Element::Material(name));
                }
                continue;
            }
            Some("mtllib") => {
                let name = line["mtllib".len()..].trim();
                if !name.is_empty() && seen.insert(name) {
                    libraries.push(name.to_owned());
                }
                continue;
            }
            Some("l" | "p") => {
                loose += 1;
                continue;
            }
            _ => continue,
        };
        check_numbers(words.clone(), least).map_err(|cause| bad(path, Some(number), cause))?;
        counts[kind] += 1;
        out.push_str(["v", "vt", "vn"][kind]);
        for word in words.chain(["0"]).take(most) {
            out.push(' ');
            out.push_str(word);
        }
        out.push('\n');
    }
    if corners.is_empty() {
        return Err(bad(path, None, "has no faces (lines that begin with 'f'); is it an OBJ?"));
    }
    let some = [1, 2].map_array(|kind| corners.iter().any(|corner| corner[kind].is_some()));
    let neutral = counts.map_array(|count| count as i64 + 1);
    out.push_str("vt 0 0\nvn 0 0 0\n");
    for element in elements {
        let (number, range) = match element {
            Element::Group => {
                out.push_str("g part\n");
                continue;
            }
            Element::Material(name) => {
                writeln!(out, "usemtl {name}").expect("a string takes all text");
                continue;
            }
            Element::Face(number, range) => (number, range),
        };
        let corners = &corners[range];
        check_range(corners, counts).map_err(|cause| bad(path, Some(number), cause))?;
        out.push('f');
        for corner in corners {
            let [position, uv, normal] =
                [0, 1, 2].map_array(|kind| corner[kind].unwrap_or(neutral[kind]));
            let written = match some {
                [false, false] => write!(out, " {position}"),
                [true, false] => write!(out, " {position}/{uv}"),
                [false, true] => write!(out, " {position}//{normal}"),
                [true, true] => write!(out, " {position}/{uv}/{normal}"),
            };
            written.expect("a string takes all text");
        }
        out.push('\n');
    }
    let mut warnings = Vec::new();
    if loose > 0 {
        let path = printable_path(path);
        warnings.push(format!("{path}: {loose} lines of kind 'l' or 'p' are not drawn"));
    }
    Ok(Checked { text: out, libraries, warnings })
}

fn check_numbers<'a>(words: impl Iterator<Item = &'a str>, least: usize) -> Result<(), String> {
    let mut found = 0;
    for word in words {
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
    printable_short(word, 40)
}

/// `position/texture/normal` as indices from 1; negative ones count back from here.
fn face_corner(word: &str, counts: Counts) -> Result<FaceCorner, String> {
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

fn check_range(corners: &[FaceCorner], counts: Counts) -> Result<(), String> {
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
