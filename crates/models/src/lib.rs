//! Reads models from files and turns them into items of a scene. Nothing here draws.
//!
//! A reader turns the bytes of one format into `Contents`: polygons in the file's own coordinates, materials, and what
//! the file contains that is not drawn. [`load`] makes items of a scene of them, the same way for every format.

mod broken;
pub mod cameras;
mod contents;
mod format;
mod gltf;
mod items;
mod mtl;
mod obj;
mod outside;
mod ply;
mod polygons;
mod records;
mod stl;
mod tangents;
mod textures;

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

use rasterproof_host::error::FileError;
use rasterproof_host::text::{printable_path, printable_short};
use rasterproof_render::pipeline::punctual::PunctualLight;
use rasterproof_render::scene::{Item, Shading};

pub use cameras::{Camera, Lens};
use contents::Contents;
pub use format::Format;
use records::Records;
pub use textures::load_texture;

/// What is wrong with a file, where, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadFile {
    /// The file, which may be another one than the model: a texture, a material file.
    pub path: PathBuf,
    /// The line, from 1, where there are lines.
    pub line: Option<usize>,
    /// What is wrong, and what to do about it.
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

/// What is wrong with the file that is read. [`load`] adds which file that is.
#[derive(Debug)]
pub(crate) struct Wrong {
    /// The line, from 1; 0 where it concerns none.
    pub line: usize,
    pub cause: String,
}

impl Wrong {
    /// The error that names the file, too.
    pub(crate) fn of(self, path: &Path) -> BadFile {
        BadFile {
            path: path.to_owned(),
            line: Some(self.line).filter(|&line| line > 0),
            cause: self.cause,
        }
    }
}

impl From<String> for Wrong {
    fn from(cause: String) -> Self {
        Self { line: 0, cause }
    }
}

impl From<&str> for Wrong {
    fn from(cause: &str) -> Self {
        cause.to_owned().into()
    }
}

impl From<FileError> for Wrong {
    fn from(error: FileError) -> Self {
        error.cause.into()
    }
}

/// The axis that points up in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// y points up, as in this project's scenes, so that nothing is turned.
    Y,
    /// As in programs for buildings and for machines.
    Z,
}

/// Which normals light is computed with: those of the file, or others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normals {
    /// From the file; those that are missing from the faces, smooth where the file has a smoothing group and
    /// flat elsewhere.
    #[default]
    File,
    /// From the faces alone, so that each face is flat.
    Flat,
    /// From the file; those that are missing are averaged over all faces at the position.
    Smooth,
}

/// What a user may say about a file.
#[derive(Clone, Copy, Debug, Default)]
pub struct LoadOptions {
    /// How light is computed, where the material does not decide it.
    pub shading: Shading,
    pub normals: Normals,
    /// The axis that points up; by default the one that is usual for the format.
    pub up: Option<Up>,
    /// The moment of an animation at which a model stands; by default it is at rest.
    pub pose: Option<Pose>,
}

/// A moment of an animation, at which the model is drawn instead of at rest.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// The number of the animation, from 0.
    pub animation: usize,
    /// From the beginning of the animation.
    pub time_s: f64,
}

impl LoadOptions {
    /// Whether light is computed of the normal at each fragment, as physical surfaces need it.
    pub(crate) fn is_per_fragment(self) -> bool {
        matches!(self.shading, Shading::Flat | Shading::Phong)
    }
}

/// A model: what is drawn of a file, and what is not.
#[derive(Clone, Debug)]
pub struct Model {
    /// One for each part that has triangles.
    pub items: Vec<Item>,
    /// Where each item comes from, in the same order.
    pub origins: Vec<Origin>,
    /// The cameras of the file that stand in what is drawn of it.
    pub cameras: Vec<Camera>,
    /// The lights of the file in what is drawn of it.
    pub lights: Vec<PunctualLight>,
    /// The names of the file's animations; empty where one has none.
    pub animations: Vec<String>,
    pub format: Format,
    /// The axis of the file that points up in the picture.
    pub up: Up,
    /// The bytes of the file, and of the files of vertices that it names.
    pub file_bytes: u64,
    /// What the file contains and is not drawn, with counts, as one line; empty if there is nothing.
    pub not_drawn: String,
    /// Why nothing of it can be seen in any view, as a part of a sentence; empty where something may be.
    pub why_empty: String,
    /// What is missing or cannot be understood and was done without, for the reader.
    pub warnings: Vec<String>,
}

/// Where an item comes from, so that a message about a triangle names the place in the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// The name of the object, group or node; empty without one.
    pub part: String,
    /// The name of the material; empty without one.
    pub material: String,
    /// For each triangle the number of its face among all faces of the file that are drawn, from 1. Nothing where each triangle is
    /// a face, so that the numbers follow each other.
    pub faces: Option<Vec<u32>>,
    /// For each triangle the line of its face; empty where the file has no lines.
    pub lines: Vec<u32>,
    /// The triangles of polygons that are not convex, by their numbers in the item.
    pub concave: Vec<u32>,
    /// The number of its first face in the file, from 1.
    pub first_face: u32,
}

impl Origin {
    /// The number of a triangle's face, from 1.
    #[must_use]
    pub fn face(&self, triangle: usize) -> Option<u32> {
        match &self.faces {
            Some(faces) => faces.get(triangle).copied(),
            None => Some(self.first_face + triangle as u32),
        }
    }

    /// Where a triangle of the item comes from, in words: `face 12 (line 40) of 'door', material 'wood'`.
    #[must_use]
    pub fn place(&self, triangle: usize) -> String {
        let Some(face) = self.face(triangle) else { return String::new() };
        let mut text = format!("face {face}");
        match self.lines.get(triangle) {
            Some(line) => text += &format!(" (line {line})"),
            None if self.first_face > 1 => {
                text += &format!(" (number {} of its part)", face + 1 - self.first_face);
            }
            None => {}
        }
        for (before, name) in [(" of", &self.part), (", material", &self.material)] {
            if !name.is_empty() {
                text += &format!("{before} '{}'", printable_short(name, 40));
            }
        }
        text
    }
}

/// Reads a model with its materials and textures.
///
/// # Errors
/// [`BadFile`] for a file that cannot be read, a coordinate that is no finite number, an index that
/// is out of range, a model without faces. A material file or a texture that is missing or cannot be read is a
/// warning: the surface is drawn in its colour, or grey.
pub fn load(path: &Path, options: LoadOptions) -> Result<Model, BadFile> {
    read(path, options).map_err(|wrong| wrong.of(path))
}

/// Reads a file by its format, and makes a model of what it contains.
fn read(path: &Path, options: LoadOptions) -> Result<Model, Wrong> {
    let mut file = Records::open(path)?;
    let length = file.length_bytes();
    let format = Format::of(path, &file.bytes, length)?;
    let mut contents = Contents::of(path);
    // Each reader gets the file for good, since what it makes of the bytes needs the memory.
    match format {
        Format::Obj => obj::read(file, &mut contents)?,
        Format::Stl if stl::is_text(&file.bytes) => stl::text(file, &mut contents)?,
        Format::Stl => stl::binary(file, &mut contents)?,
        Format::Ply => ply::read(file, &mut contents)?,
        Format::Gltf | Format::Glb => {
            file.read_all()?;
            gltf::read(&file.bytes, options.pose, &mut contents)?;
        }
    }
    let mut model = items::model(contents, format, options)?;
    model.file_bytes += length;
    Ok(model)
}

/// `specular colour of 18 materials, 1 bump map`: keys in the singular, with their counts.
pub(crate) fn counted(counts: &BTreeMap<String, u64>) -> String {
    let parts = counts.iter().map(|(key, &count)| {
        let (before, noun) = key.rsplit_once(" of ").map_or(("", key.as_str()), |(a, b)| (a, b));
        let of = if before.is_empty() { "" } else { " of " };
        let plural = if count == 1 { "" } else { "s" };
        format!("{before}{of}{count} {noun}{plural}")
    });
    parts.collect::<Vec<_>>().join(", ")
}

/// Warnings of a model, of which there may be as many as lines.
#[derive(Debug, Default)]
pub(crate) struct Warnings {
    /// The file that is read, which each line names.
    path: PathBuf,
    /// The first lines of each kind.
    shown: Vec<String>,
    /// By kind, how many there were, shown or not.
    counts: BTreeMap<String, u64>,
}

impl Warnings {
    /// Warnings of one kind that are shown; of the rest the number is.
    const MOST: u64 = 8;

    pub(crate) fn of(path: &Path) -> Self {
        Self { path: path.to_owned(), ..Self::default() }
    }

    /// A warning about the model. Its kind is in the plural.
    pub(crate) fn add(&mut self, kind: &str, text: &str) {
        self.add_at(0, kind, text);
    }

    /// A warning about a line, from 1; 0 where it concerns none.
    pub(crate) fn add_at(&mut self, line: usize, kind: &str, text: &str) {
        self.add_of(&self.path.clone(), line, kind, text);
    }

    /// The same of a file that the model names.
    pub(crate) fn add_of(&mut self, path: &Path, line: usize, kind: &str, text: &str) {
        let place = if line > 0 { format!(":{line}") } else { String::new() };
        self.note(path, kind, format!("{}{place}: {text}", printable_path(path)));
    }

    /// A warning whose text says which file it is about.
    pub(crate) fn add_as_it_is(&mut self, kind: &str, text: String) {
        self.note(&self.path.clone(), kind, text);
    }

    fn note(&mut self, path: &Path, kind: &str, text: String) {
        let kind = format!("{}: {kind}", printable_path(path));
        let count = self.counts.entry(kind).or_default();
        *count += 1;
        if *count <= Self::MOST {
            self.shown.push(text);
        }
    }

    /// The lines to show, with a count of those that are not shown.
    pub(crate) fn finish(mut self) -> Vec<String> {
        for (kind, count) in self.counts {
            if count > Self::MOST {
                self.shown.push(format!("{kind}: {} more of this kind", count - Self::MOST));
            }
        }
        self.shown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_a_triangle_is_said_in_words() {
        let (faces, lines) = (Some(vec![7, 8, 8]), vec![30, 31, 31]);
        let mut origin = Origin {
            part: "door".to_owned(),
            material: String::new(),
            faces,
            lines,
            concave: Vec::new(),
            first_face: 7,
        };
        assert_eq!(origin.place(2), "face 8 (line 31) of 'door'");
        origin.lines.clear();
        origin.material = "wood".to_owned();
        assert_eq!(origin.place(0), "face 7 (number 1 of its part) of 'door', material 'wood'");
        assert_eq!(origin.place(3), "");
        origin.faces = None;
        assert_eq!(origin.face(3), Some(10));
    }

    #[test]
    fn what_is_not_drawn_is_counted_in_words() {
        let counts = [("specular colour of material", 18), ("bump map", 1), ("line", 2)];
        let counts = counts.map(|(key, count)| (key.to_owned(), count)).into();
        assert_eq!(counted(&counts), "1 bump map, 2 lines, specular colour of 18 materials");
    }
}
