//! From what a file contains to items of a scene: triangles, normals, the axis that points up.

use std::collections::HashMap;
use std::path::Path;

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};
use rasterproof_host::text::printable_path;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::scene::{Corner, Item, Material, Mesh, Shading};

use crate::contents::{Contents, INCOMPLETE_FACE, Part, Surface};
use crate::polygons::{self, Odd, Shape};
use crate::{BadFile, Format, Model, Normals, Options, Origin, Up, Warnings, bad, counted};

/// The largest coordinate: products of three stay far below the largest double.
pub(crate) const MOST_COORDINATE: f64 = 1e38;

/// The model of a file. Files are right-handed and scenes left-handed, so z is negated at the end.
pub(crate) fn model(
    path: &Path,
    mut contents: Contents,
    format: Format,
    options: Options,
) -> Result<Model, BadFile> {
    let up = options.up.unwrap_or(format.usual_up());
    let turn = match up {
        Up::Y => DMat4::IDENTITY,
        // x stays, z becomes y, and y becomes -z.
        Up::Z => DMat4::from_cols(DVec4::X, DVec4::NEG_Z, DVec4::Y, DVec4::W),
    };
    let mut warnings = Warnings::default();
    for part in &mut contents.parts {
        place(path, part, turn)?;
    }
    let smooth = SmoothNormals::of(&contents.parts, options.normals);
    let (mut items, mut origins) = (Vec::new(), Vec::new());
    let mut first_face = 1;
    for part in std::mem::take(&mut contents.parts) {
        let surface = part.material.and_then(|number| contents.materials.get(number));
        let material = material(surface, &part, options.shading);
        let name = surface.map_or(String::new(), |surface| surface.name.clone());
        let (faces, lines, concave) = (Vec::new(), Vec::new(), Vec::new());
        let part_name = part.name.clone();
        let mut origin =
            Origin { part: part_name, material: name, faces, lines, concave, first_face };
        first_face += part.polygons.len() as u32;
        let mesh = mesh(path, &part, &smooth, options.normals, &mut origin, &mut warnings);
        if mesh.triangles.is_empty() {
            continue;
        }
        let mut item = Item::new(mesh, material);
        if surface.is_some_and(|surface| !surface.both_sides) {
            item.cull = Cull::Clockwise;
        }
        items.push(item);
        origins.push(origin);
    }
    let shiny = contents.materials.iter().filter(|surface| surface.specular != Specular::default());
    let shiny = shiny.count() as u64;
    if options.shading == Shading::Gouraud && shiny > 0 {
        let key = "specular colour, with Gouraud shading, of material".to_owned();
        contents.not_drawn.insert(key, shiny);
    }
    let not_drawn = counted(&contents.not_drawn);
    if items.is_empty() {
        if contents.not_drawn.keys().all(|kind| kind == INCOMPLETE_FACE) {
            let why = contents.warnings.first().map_or(String::new(), |why| format!(" ({why})"));
            return Err(bad(path, None, format!("has no faces, so there is nothing to draw{why}")));
        }
        let path = printable_path(path);
        warnings.line(&path, &format!("{path}: has no faces, so the picture is empty"));
    }
    let mut all = contents.warnings;
    all.extend(warnings.finish());
    Ok(Model { items, origins, format, up, not_drawn, warnings: all })
}

/// Brings a part into the coordinates of the scene, but for the sign of z.
fn place(path: &Path, part: &mut Part, turn: DMat4) -> Result<(), BadFile> {
    let matrix = turn * part.to_file;
    if matrix != DMat4::IDENTITY {
        for position in &mut part.positions {
            *position = matrix.transform_point3(*position);
        }
        let linear = DMat3::from_mat4(matrix);
        // The cofactors turn normals as the inverse does, and exist where it does not.
        let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let mirrors = linear.determinant() < 0.0;
        for normal in &mut part.normals {
            *normal = cofactors * *normal * if mirrors { -1.0 } else { 1.0 };
        }
        if mirrors {
            let mut start = 0;
            for polygon in &part.polygons {
                part.corners[start..polygon.end as usize].reverse();
                start = polygon.end as usize;
            }
        }
    }
    let is_far =
        |position: &DVec3| !position.is_finite() || position.abs().max_element() > MOST_COORDINATE;
    match part.positions.iter().position(is_far) {
        Some(number) => {
            let cause = format!(
                "position {} of part '{}' is not a finite number up to 1e38 in size: repair it in the program that wrote the file",
                number + 1,
                rasterproof_host::text::printable_short(&part.name, 40)
            );
            Err(bad(path, None, cause))
        }
        None => Ok(()),
    }
}

fn material(surface: Option<&Surface>, part: &Part, shading: Shading) -> Material {
    let vertex_colours = !part.colours.is_empty();
    match surface {
        Some(surface) => Material {
            colour: surface.colour,
            vertex_colours,
            texture: surface.texture.clone(),
            specular: surface.specular,
            opacity: surface.opacity.clone(),
            shading: if surface.unlit { Shading::Unlit } else { shading },
        },
        None => {
            let colour = if vertex_colours { DVec3::ONE } else { DVec3::splat(0.8) };
            Material { colour, vertex_colours, shading, ..Material::default() }
        }
    }
}

/// Normals of corners that have none, averaged over the polygons at a position by their areas. Positions are
/// compared by value, since many files list a position again for each face, object or material.
#[derive(Default)]
struct SmoothNormals {
    sums: HashMap<([u64; 3], u32), (DVec3, f64)>,
}

/// What a group of all polygons is called, whatever the file says.
const ALL: u32 = u32::MAX;

fn group(smoothing: u32, normals: Normals) -> u32 {
    match normals {
        Normals::Flat => 0,
        Normals::File => smoothing,
        Normals::Smooth => ALL,
    }
}

/// A position as a key, -0 as 0.
fn key(position: DVec3) -> [u64; 3] {
    (position + DVec3::ZERO).to_array().map(f64::to_bits)
}

impl SmoothNormals {
    fn of(parts: &[Part], normals: Normals) -> Self {
        let mut this = Self::default();
        let mut points = Vec::new();
        for part in parts {
            let mut start = 0;
            for polygon in &part.polygons {
                let corners = &part.corners[start..polygon.end as usize];
                start = polygon.end as usize;
                let group = group(polygon.smoothing, normals);
                if group == 0 {
                    continue;
                }
                points.clear();
                points
                    .extend(corners.iter().map(|corner| part.positions[corner.position as usize]));
                let normal = polygons::normal(&points);
                let length = normal.length();
                for &point in &points {
                    let sum = this.sums.entry((key(point), group)).or_default();
                    *sum = (sum.0 + normal, sum.1 + length);
                }
            }
        }
        this
    }

    /// The normal at a position, or nothing where those of the polygons cancel, as of a sheet that is listed from
    /// both sides.
    fn at(&self, position: DVec3, group: u32) -> Option<DVec3> {
        let &(sum, lengths) = self.sums.get(&(key(position), group))?;
        (sum.length() > 1e-9 * lengths).then(|| sum.normalize_or_zero())
    }
}

/// The triangles of a part; where each comes from is added to the origin.
fn mesh(
    path: &Path,
    part: &Part,
    smooth: &SmoothNormals,
    normals: Normals,
    origin: &mut Origin,
    warnings: &mut Warnings,
) -> Mesh {
    let mirrored = |v: DVec3| DVec3::new(v.x, v.y, -v.z);
    let mut triangles = Vec::with_capacity(
        part.corners.len() - 2 * part.polygons.len().min(part.corners.len() / 2),
    );
    let mut made: Vec<Corner> = Vec::new();
    let mut points = Vec::new();
    let mut start = 0;
    for (number, polygon) in part.polygons.iter().enumerate() {
        let corners = &part.corners[start..polygon.end as usize];
        start = polygon.end as usize;
        let face = origin.first_face + number as u32;
        points.clear();
        points.extend(corners.iter().map(|corner| part.positions[corner.position as usize]));
        let normal = polygons::normal(&points);
        let flat = normal.normalize_or_zero();
        let group = group(polygon.smoothing, normals);
        made.clear();
        made.extend(corners.iter().zip(&points).map(|(corner, &point)| {
            let given = corner.normal.filter(|_| normals != Normals::Flat);
            let given = given.and_then(|number| part.normals[number as usize].try_normalize());
            let computed = || {
                let smooth = if group == 0 { None } else { smooth.at(point, group) };
                smooth.unwrap_or(flat)
            };
            Corner {
                position: corner.position,
                colour: part.colours.get(corner.position as usize).copied().unwrap_or(DVec3::ONE),
                normal: mirrored(given.unwrap_or_else(computed)),
                uv: corner.uv.map_or(DVec2::ZERO, |number| part.uvs[number as usize]),
            }
        }));
        let first = triangles.len() as u32;
        let mut emit = |[a, b, c]: [usize; 3]| {
            triangles.push([made[a], made[b], made[c]]);
            origin.faces.push(face);
            if polygon.line > 0 {
                origin.lines.push(polygon.line);
            }
        };
        let shape = polygons::triangles(&points, normal, &mut emit);
        if shape != Ok(Shape::Convex) {
            origin.concave.extend(first..triangles.len() as u32);
        }
        if let Err(odd) = shape {
            let path = printable_path(path);
            let (what, kind) = match odd {
                Odd::Crosses => ("crosses itself", "faces that cross themselves"),
                Odd::TooManyCorners => ("has more than 65536 corners", "faces of many corners"),
            };
            let place = match polygon.line {
                0 => format!("{path}: face {face} {what}"),
                line => format!("{path}:{line}: the face {what}"),
            };
            let drawn = "so it is drawn as triangles around its first corner: split it";
            warnings.line(&format!("{path}: {kind}"), &format!("{place}, {drawn}"));
        }
    }
    Mesh { positions: part.positions.iter().copied().map(mirrored).collect(), triangles }
}
