//! From what a file contains to items of a scene: triangles, normals, the axis that points up.

use std::collections::{BTreeMap, HashMap};
use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::{DMat4, DVec2, DVec3, DVec4};
use rasterproof_core::parallel;
use rasterproof_host::text::printable_short;
use rasterproof_render::pipeline::assemble::Cull;
use rasterproof_render::pipeline::highlight::Specular;
use rasterproof_render::pipeline::opacity::Drawn;
use rasterproof_render::pipeline::physical::Map;
use rasterproof_render::pipeline::punctual::PunctualLight;
use rasterproof_render::pipeline::texture::Texture;
use rasterproof_render::scene;
use rasterproof_render::scene::{Attribute, Item, Material, Mesh, Shading, Triangles};

use crate::broken;
use crate::contents::{
    Contents, FilePart, INCOMPLETE_FACE, NONE, Numbers, Sides, Surface, Vectors, key,
};
use crate::gltf::encoded;
use crate::polygons::{self, Odd, Shape};
use crate::tangents;
use crate::{Format, LoadOptions, Model, Normals, Origin, Up, Warnings, Wrong, counted};

/// The largest coordinate: products of three stay far below the largest double.
pub(crate) const MOST_COORDINATE: f64 = 1e38;

/// The model of a file. Files are right-handed and scenes left-handed, so z is negated at the end.
pub(crate) fn model(
    mut contents: Contents,
    format: Format,
    options: LoadOptions,
) -> Result<Model, Wrong> {
    // What the user says about the axis comes before what the format usually has.
    let up = options.up.unwrap_or(format.usual_up());
    let turn = match up {
        Up::Y => DMat4::IDENTITY,
        // x stays, z becomes y, and y becomes -z.
        Up::Z => DMat4::from_cols(DVec4::X, DVec4::NEG_Z, DVec4::Y, DVec4::W),
    };
    // All parts in the coordinates of the scene but for z, and what cannot be drawn left out.
    let mut warnings = Warnings::of(&contents.path);
    for part in &mut contents.parts {
        place(part, turn)?;
    }
    let left_out = broken::leave_out(&mut contents, &mut warnings);
    // Cameras and lights are placed at once; positions are mirrored in `mesh`.
    let mirror = DMat4::from_scale(mirrored(DVec3::ONE));
    let mut cameras = std::mem::take(&mut contents.cameras);
    for camera in &mut cameras {
        camera.place(mirror * turn);
    }
    let mut lights: Vec<PunctualLight> = Vec::new();
    for light in &contents.lights {
        lights.push(light.placed(turn).placed(mirror));
    }
    if let Some(power) = to_usual_size(&mut contents.parts) {
        let what = if power > 0 { "small" } else { "large" };
        let text = format!(
            "is so {what} that all positions are multiplied by 2^{power}; the picture is the same, and the coordinates that \
             are shown are those after that"
        );
        warnings.add("sizes", &text);
        for step in half_powers(power) {
            for camera in &mut cameras {
                camera.scale(step);
            }
            for light in &mut lights {
                *light = light.scaled(step);
            }
        }
    }
    // Normals are averaged over all parts, since a surface may go on in the next one.
    let smooth = SmoothNormals::of(&contents.parts, options.normals);
    // An item for each part that has triangles, and where its triangles come from.
    let (mut items, mut origins) = (Vec::new(), Vec::new());
    let mut first_face = 1;
    for mut part in std::mem::take(&mut contents.parts) {
        // The surface, and where the triangles of the part come from.
        let surface = part.material.and_then(|number| contents.materials.get(number));
        if surface.is_some_and(|of| of.physical.is_some() && !of.is_linear(options)) {
            for colour in &mut part.colours.values {
                *colour = colour.map(encoded);
            }
        }
        let material = material(surface, &part, options);
        let name = surface.map_or(String::new(), |surface| surface.name.clone());
        let (faces, lines, concave) = (None, Vec::new(), Vec::new());
        let part_name = part.name.clone();
        let mut origin =
            Origin { part: part_name, material: name, faces, lines, concave, first_face };
        first_face += part.polygons.len() as u32;
        let tangents = std::mem::take(&mut part.tangents);
        let second_uvs = std::mem::take(&mut part.second_uvs);
        let mut mesh = mesh(part, &smooth, options.normals, &mut origin, &mut warnings);
        // Most materials read all of their maps at the first coordinates.
        if !second_uvs.is_empty() && material.has_second_uvs() {
            mesh.triangles = mesh.triangles.with_second_uvs(Attribute::OfPositions(second_uvs));
        }
        let physical = material.physical.as_deref();
        if let Some((_, is_second)) = physical.and_then(|physical| physical.sampled(Map::Normal)) {
            mesh.triangles = tangents::with(mesh.triangles, &mesh.positions, tangents, is_second);
        }
        if mesh.triangles.is_empty() {
            continue;
        }
        let mut item = Item::new(mesh, material);
        match surface.map(|surface| surface.sides) {
            Some(Sides::Front) => item.cull = Cull::Clockwise,
            Some(Sides::Both) => item.two_sided = true,
            Some(Sides::Alike) | None => {}
        }
        items.push(item);
        origins.push(origin);
    }
    if options.shading == Shading::Gouraud {
        let (mut shiny, mut physical) = (0, 0);
        for surface in &contents.materials {
            shiny += u64::from(surface.specular != Specular::default());
            physical += u64::from(surface.physical.is_some() && !surface.unlit);
        }
        contents.count("specular colour, with Gouraud shading, of material", shiny);
        contents.count("metal and roughness, with Gouraud shading, of material", physical);
    }
    if !lights.is_empty() {
        let mut matt = 0;
        for Material { physical, shading, .. } in items.iter().map(|item| &item.material) {
            matt += u64::from(physical.is_none() && *shading != Shading::Unlit);
        }
        contents.count("light of the file, without metal and roughness, of primitive", matt);
    }
    // What is said of the file as a whole.
    let not_drawn = counted(&contents.not_drawn);
    // An empty picture has a reason, which is said in place of a verdict.
    let mut why_empty = clear_materials(&items, &origins, &mut warnings);
    if items.is_empty() {
        if contents.not_drawn.keys().all(|kind| kind == INCOMPLETE_FACE) {
            let why =
                contents.warnings.shown.first().map_or(String::new(), |why| format!(" ({why})"));
            return Err(format!("has no faces, so there is nothing to draw{why}").into());
        }
        let why = if left_out > 0 { "all its faces are left out" } else { "it has no faces" };
        warnings.add("faces", &format!("{why}, so the picture is empty"));
        why_empty = why.to_owned();
    }
    let (file_bytes, animations) = (contents.other_bytes, contents.animations);
    let warnings = [contents.warnings.finish(), warnings.finish()].concat();
    Ok(Model {
        items,
        origins,
        cameras,
        lights,
        animations,
        format,
        up,
        file_bytes,
        not_drawn,
        why_empty,
        warnings,
    })
}

/// Says which materials are fully transparent, and returns why the picture is empty where all of them are.
fn clear_materials(items: &[Item], origins: &[Origin], warnings: &mut Warnings) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let mut is_empty = true;
    for (item, origin) in items.iter().zip(origins) {
        if is_clear(item) {
            *counts.entry(&origin.material).or_default() += item.mesh.triangles.len();
        } else {
            is_empty = false;
        }
    }
    for (name, count) in &counts {
        let triangles = if *count == 1 { "triangle" } else { "triangles" };
        let text = format!(
            "{} is fully transparent, so nothing is seen of its {count} {triangles}: give it another opacity, or all \
             surfaces one by --opacity",
            named(name)
        );
        warnings.add("materials that are fully transparent", &text);
    }
    match counts.keys().next() {
        Some(name) if is_empty && counts.len() == 1 => {
            format!("{} is fully transparent", named(name))
        }
        Some(_) if is_empty => "all its materials are fully transparent".to_owned(),
        _ => String::new(),
    }
}

/// A material in words, whether it has a name or not.
fn named(material: &str) -> String {
    match material {
        "" => "the material without a name".to_owned(),
        name => format!("the material '{}'", printable_short(name, 40)),
    }
}

/// Whether no fragment of an item can be seen.
fn is_clear(item: &Item) -> bool {
    let Some(opacity) = &item.material.opacity else { return false };
    let mut corners = item.mesh.triangles.iter().map(|corners| corners.map(|corner| corner.uv));
    // Without a map all of it is as opaque.
    match opacity.map {
        None => opacity.of(DVec2::ZERO) == 0,
        Some(_) => corners.all(|uvs| opacity.between(uvs, opacity.farthest()) == Drawn::Nothing),
    }
}

/// Brings a part into the coordinates of the scene, but for the sign of z.
fn place(part: &mut FilePart, turn: DMat4) -> Result<(), String> {
    part.place(turn * part.to_file);
    // Faces with others are left out.
    let is_far =
        |position: &DVec3| position.is_finite() && position.abs().max_element() > MOST_COORDINATE;
    let is_far_corner = |&corner: &u32| is_far(&part.positions[corner as usize]);
    // Only a position that some face uses ends the file.
    let far = parallel::first(&part.positions, is_far);
    match far.and_then(|_| parallel::first(&part.corners, is_far_corner)) {
        Some(corner) => Err(format!(
            "position {} of part '{}' is larger than 1e38: scale the model down in the program that wrote the file",
            part.corners[corner] + 1,
            printable_short(&part.name, 40)
        )),
        None => Ok(()),
    }
}

/// Powers of two between which the longest side of a model is left as it is. Beyond them products of coordinates, and
/// distances as single-precision numbers, leave the range in which they have all their digits.
const USUAL_SIZES: RangeInclusive<i32> = -32..=32;

/// Multiplies all positions by a power of two where the model is so small or so large that products of its coordinates
/// would be lost. That changes no digit, and no pixel, since the eye is placed by the size of the model. Returns the
/// power where there is one.
fn to_usual_size(parts: &mut [FilePart]) -> Option<i32> {
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for part in parts.iter() {
        for &corner in &part.corners {
            let position = part.positions[corner as usize];
            (min, max) = (min.min(position), max.max(position));
        }
    }
    // Without a corner there is no size.
    if !min.cmple(max).all() {
        return None;
    }
    let side = (max - min).max_element();
    // All of it in one point: then the point's distance from the origin.
    // The power of two by which the longest side becomes about 1.
    let size = if side > 0.0 { side } else { max.abs().max(min.abs()).max_element() };
    let exponent = exponent(size)?;
    if USUAL_SIZES.contains(&exponent) {
        return None;
    }
    let power = -exponent;
    let steps = half_powers(power);
    for part in parts {
        parallel::each_share(&mut part.positions, &|share| {
            for position in share {
                *position = *position * steps[0] * steps[1];
            }
        });
    }
    Some(power)
}

/// Two factors of 2^power: 2^1074 is no double, so it is done in two steps; both are exact.
fn half_powers(power: i32) -> [f64; 2] {
    [power / 2, power - power / 2].map(|power| libm::ldexp(1.0, power))
}

/// The largest power of two that is no larger than a number above 0.
fn exponent(size: f64) -> Option<i32> {
    (size > 0.0 && size.is_finite()).then(|| libm::ilogb(size))
}

/// How a part is drawn. One without a surface is grey, or has the colours of its vertices.
fn material(surface: Option<&Surface>, part: &FilePart, options: LoadOptions) -> Material {
    let shading = options.shading;
    let vertex_colours = !part.colours.values.is_empty();
    let Some(surface) = surface else {
        let colour = if vertex_colours { DVec3::ONE } else { DVec3::splat(0.8) };
        return Material { colour, vertex_colours, shading, ..Material::default() };
    };
    let mut material = Material {
        colour: surface.colour,
        vertex_colours,
        texture: surface.texture.clone(),
        specular: surface.specular,
        opacity: surface.opacity.clone(),
        shading: if surface.unlit { Shading::Unlit } else { shading },
        physical: None,
    };
    match &surface.physical {
        Some((colour, physical)) if surface.is_linear(options) => {
            material.colour = *colour;
            material.physical = Some(Arc::clone(physical));
        }
        // A surface of linear light that is shaded in another way has its picture as it is stored.
        Some(_) => {
            if let Some(texture) = &surface.texture {
                material.texture = Some(Arc::new(Texture::clone(texture).as_stored()));
            }
        }
        None => {}
    }
    material
}

/// Normals of corners that have none, averaged over the polygons at a position by their areas. Positions are
/// compared by value, since many files list a position again for each face, object or material.
#[derive(Default)]
struct SmoothNormals {
    /// By position and group: the sum of the normals, and of their lengths, which are twice the areas.
    sums: HashMap<([u64; 3], u32), (DVec3, f64)>,
}

/// What a group of all polygons is called, whatever the file says.
const ALL: u32 = u32::MAX;

/// The smoothing group of a polygon; 0 where it is flat.
fn group(smoothing: u32, normals: Normals) -> u32 {
    match normals {
        Normals::Flat => 0,
        Normals::File => smoothing,
        Normals::Smooth => ALL,
    }
}

impl SmoothNormals {
    /// Sums over all polygons that have a smoothing group.
    fn of(parts: &[FilePart], normals: Normals) -> Self {
        let mut this = Self::default();
        let mut points = Vec::new();
        for part in parts {
            // A part without smooth polygons adds nothing, which most parts of large files are.
            let is_smooth = normals == Normals::Smooth || part.polygons.is_smooth();
            for number in (0..part.polygons.len()).filter(|_| is_smooth) {
                let group = group(part.polygons.smoothing(number), normals);
                if group == 0 {
                    continue;
                }
                let corners = &part.corners[part.polygons.corners(number)];
                points.clear();
                points.extend(corners.iter().map(|&corner| part.positions[corner as usize]));
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
    mut part: FilePart,
    smooth: &SmoothNormals,
    normals: Normals,
    origin: &mut Origin,
    warnings: &mut Warnings,
) -> Mesh {
    // Attributes by corners of polygons become those of corners of triangles.
    let normals = part_normals(&mut part, smooth, normals);
    let uvs = attribute(std::mem::take(&mut part.uvs), DVec2::ZERO);
    let colours = attribute(std::mem::take(&mut part.colours), DVec3::ONE);
    let cut = (!part.polygons.are_triangles()).then(|| cut(&part, origin, warnings));
    let corners = match &cut {
        Some(cut) => cut.iter().map(|&corner| part.corners[corner as usize]).collect(),
        None => {
            origin.lines = part.polygons.lines;
            part.corners
        }
    };
    let mut positions = part.positions;
    parallel::each_share(&mut positions, &|share| {
        for position in share {
            *position = mirrored(*position);
        }
    });
    let positions = Arc::new(positions);
    let normals = match normals {
        Some(values) => scene::Normals::Given(of_cut(values, cut.as_deref())),
        None => scene::Normals::Flat(Arc::clone(&positions)),
    };
    let colours = of_cut(colours, cut.as_deref());
    let triangles = Triangles::new(corners, colours, normals, of_cut(uvs, cut.as_deref()));
    Mesh { positions, triangles }
}

/// A vector with z negated: from a right-handed to a left-handed system.
fn mirrored(v: DVec3) -> DVec3 {
    DVec3::new(v.x, v.y, -v.z)
}

/// The corners of all polygons as corners of triangles, by their numbers in the part.
fn cut(part: &FilePart, origin: &mut Origin, warnings: &mut Warnings) -> Vec<u32> {
    // A polygon of n corners becomes n - 2 triangles.
    let most = part.corners.len() - 2 * part.polygons.len().min(part.corners.len() / 2);
    let mut triangles: Vec<u32> = Vec::with_capacity(3 * most);
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for number in 0..part.polygons.len() {
        let corners = part.polygons.corners(number);
        let first_corner = corners.start as u32;
        let face = origin.first_face + number as u32;
        let line = part.polygons.line(number);
        points.clear();
        points.extend(part.corners[corners].iter().map(|&corner| part.positions[corner as usize]));
        // The triangles of the polygon begin here.
        let first = triangles.len() as u32 / 3;
        // Each triangle with the face and the line that it comes from.
        let mut emit = |corners: [usize; 3]| {
            triangles.extend(corners.map(|corner| first_corner + corner as u32));
            faces.push(face);
            if line > 0 {
                origin.lines.push(line);
            }
        };
        let shape = polygons::triangles(&points, polygons::normal(&points), &mut emit);
        if shape != Ok(Shape::Convex) {
            origin.concave.extend(first..triangles.len() as u32 / 3);
        }
        if let Err(odd) = shape {
            let (what, kind) = match odd {
                Odd::Crosses => ("crosses itself", "faces that cross themselves"),
                Odd::Folded => ("is not planar", "faces that are not planar"),
                Odd::TooManyCorners => ("has more than 65536 corners", "faces of many corners"),
            };
            let face = if line > 0 { "the face".to_owned() } else { format!("face {face}") };
            let drawn = "so it is drawn as triangles around its first corner: split it";
            warnings.add_at(line as usize, kind, &format!("{face} {what}, {drawn}"));
        }
    }
    origin.faces = Some(faces);
    triangles
}

/// An attribute of all corners of a part as one of the corners of its triangles, if it had to be cut.
fn of_cut<V>(attribute: Attribute<V>, cut: Option<&[u32]>) -> Attribute<V> {
    match (attribute, cut) {
        (Attribute::Indexed { values, indices }, Some(cut)) => {
            let indices = cut.iter().map(|&corner| indices[corner as usize]).collect();
            Attribute::Indexed { values, indices }
        }
        (same, _) => same,
    }
}

/// An attribute of the corners of a part; `missing` for those that have none.
fn attribute<V>(vectors: Vectors<V>, missing: V) -> Attribute<V> {
    let Vectors { mut values, numbers } = vectors;
    match numbers {
        Numbers::Nothing => Attribute::Same(missing),
        Numbers::OfPositions => Attribute::OfPositions(values),
        Numbers::OfCorners(mut indices) => {
            // Corners without one share a value at the end of the list.
            let none = values.len() as u32;
            values.push(missing);
            for number in indices.iter_mut().filter(|number| **number == NONE) {
                *number = none;
            }
            Attribute::Indexed { values, indices }
        }
    }
}

/// The normals of the corners of a part: those of the file, else those of smooth or flat polygons. Nothing where all are those
/// of flat triangles.
fn part_normals(
    part: &mut FilePart,
    smooth: &SmoothNormals,
    normals: Normals,
) -> Option<Attribute<DVec3>> {
    let Vectors { mut values, mut numbers } = std::mem::take(&mut part.normals);
    if normals == Normals::Flat {
        (values, numbers) = (Vec::new(), Numbers::Nothing);
    }
    // Vectors that have no length or an infinite one are missing.
    let mut are_there = true;
    for value in &mut values {
        let unit = value.try_normalize();
        are_there &= unit.is_some();
        *value = mirrored(unit.unwrap_or(DVec3::NAN));
    }
    let is_smooth = normals == Normals::Smooth || part.polygons.is_smooth();
    let point = |corner: usize| part.positions[part.corners[corner] as usize];
    match numbers {
        Numbers::OfPositions if are_there => return Some(Attribute::OfPositions(values)),
        Numbers::OfCorners(indices) if are_there && !indices.contains(&NONE) => {
            return Some(Attribute::Indexed { values, indices });
        }
        Numbers::Nothing if !is_smooth && part.polygons.are_triangles() => return None,
        _ => {}
    }
    // Else each corner has a normal of the file, or one of the smooth polygons at its position, or that of its polygon.
    let mut indices = Vec::with_capacity(part.corners.len());
    let mut points = Vec::new();
    for number in 0..part.polygons.len() {
        let group = group(part.polygons.smoothing(number), normals);
        // The number of the polygon's own normal among the values.
        let mut of_polygon = None;
        for corner in part.polygons.corners(number) {
            let given = numbers.get(corner, part.corners[corner]);
            if let Some(given) = given.filter(|&given| !values[given as usize].x.is_nan()) {
                indices.push(given);
                continue;
            }
            // In a group all polygons at a position share a normal, unless theirs cancel.
            let smooth = if group == 0 { None } else { smooth.at(point(corner), group) };
            let next = values.len() as u32;
            indices.push(match smooth {
                Some(normal) => {
                    values.push(mirrored(normal));
                    next
                }
                None => *of_polygon.get_or_insert_with(|| {
                    points.clear();
                    points.extend(part.polygons.corners(number).map(point));
                    values.push(mirrored(polygons::normal(&points).normalize_or_zero()));
                    next
                }),
            });
        }
    }
    Some(Attribute::Indexed { values, indices })
}
