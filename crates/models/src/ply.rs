//! PLY: elements of named numbers, in text or in binary of either byte order.
//!
//! Own code: `ply-rs` and its fork `ply-rs-bw` keep each element in a map from names to values, unless all properties of a file
//! are known beforehand, and their errors name no line of the body.

use std::ops::Range;

use glam::{DVec2, DVec3};
use rasterproof_core::parallel::{self, SHARE};
use rasterproof_host::text::printable_short;
use rayon::prelude::*;

use crate::contents::{Contents, FilePart, INCOMPLETE_FACE, NONE, Numbers, Surface, Vectors};
use crate::records::{Kind, Records, expected_number, without_mark};
use crate::textures::{Textures, opacity};
use crate::{Wrong, outside};

/// Whether these bytes begin as a PLY.
pub(crate) fn is_ply(bytes: &[u8]) -> bool {
    let Some((ply, rest)) = without_mark(bytes).split_at_checked(3) else { return false };
    let next = rest.trim_ascii_start();
    let has_format = next.len() < rest.len()
        && next.get(..6).is_some_and(|word| word.eq_ignore_ascii_case(b"format"));
    // A comment may stand before the format, but not in the first line.
    ply.eq_ignore_ascii_case(b"ply")
        && (has_format || rest.starts_with(b"\n") || rest.starts_with(b"\r"))
}

/// The type of numbers of this name; nothing where there is no such type.
fn kind_of(name: &str) -> Option<Kind> {
    Some(match name {
        "char" | "int8" => Kind::I8,
        "uchar" | "uint8" => Kind::U8,
        "short" | "int16" => Kind::I16,
        "ushort" | "uint16" => Kind::U16,
        "int" | "int32" => Kind::I32,
        "uint" | "uint32" => Kind::U32,
        // These are not in the format; Open3D and others write them.
        "long" | "int64" => Kind::I64,
        "ulong" | "uint64" => Kind::U64,
        "float" | "float32" => Kind::F32,
        "double" | "float64" => Kind::F64,
        _ => return None,
    })
}

/// By which a channel of a colour of this type is divided.
fn full(kind: Kind) -> f64 {
    match kind {
        Kind::I8 | Kind::U8 => 255.0,
        Kind::I16 | Kind::U16 => 65535.0,
        Kind::I32 | Kind::U32 => f64::from(u32::MAX),
        Kind::I64 | Kind::U64 => u64::MAX as f64,
        Kind::F32 | Kind::F64 => 1.0,
    }
}

/// A number of an element, or a list with its length.
struct Property {
    name: String,
    /// The type of the number, or of the numbers of the list.
    kind: Kind,
    /// The type of the length of a list; nothing for a single number.
    length: Option<Kind>,
}

/// A kind of things that the file lists: how many there are, and what each of them has.
struct Element {
    name: String,
    /// How many of them the header announces.
    count: u64,
    /// In the order in which each element has them.
    properties: Vec<Property>,
}

/// How numbers are written: as words, or as bytes of either order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Text,
    Little,
    Big,
}

/// The lines before the data: the form of the file, and which elements follow in which order.
struct Header {
    form: Form,
    /// In the order in which their data follow.
    elements: Vec<Element>,
    /// Pictures that comments name, as some programs write them.
    textures: Vec<String>,
    /// Lines that the format does not define, with their numbers, for a warning.
    unknown: Vec<(usize, String)>,
}

/// The elements of a file, number after number.
struct Body {
    file: Records,
    form: Form,
    /// Where what is left of the line of text is.
    words: Range<usize>,
    /// The number of the element that is read, from 0.
    element: u64,
    /// Lines of text with more numbers than the header says.
    long: u64,
    /// The first line with a decimal comma.
    comma: Option<usize>,
}

impl Body {
    fn wrong(&self, cause: &str) -> Wrong {
        self.file.wrong(format!("{cause}: export the model again"))
    }

    /// Where the next line is. Behind the last line break there is none.
    fn next_line(&mut self) -> Result<Option<Range<usize>>, Wrong> {
        let line = self.file.find_line()?;
        let is_behind = self.file.at > self.file.bytes.len();
        if is_behind && line.as_ref().is_some_and(Range::is_empty) {
            self.file.line -= 1;
            return Ok(None);
        }
        Ok(line)
    }

    /// Goes to the next element: a line in text.
    fn next_element(&mut self) -> Result<(), Wrong> {
        if self.form != Form::Text {
            return self.file.read_all();
        }
        self.end_element();
        loop {
            self.words = self.next_line()?.ok_or("the file is cut off")?;
            if !self.file.bytes[self.words.clone()].trim_ascii().is_empty() {
                return Ok(());
            }
        }
    }

    /// Counts what the last element did not read of its line.
    fn end_element(&mut self) {
        let words = std::mem::take(&mut self.words);
        self.long += u64::from(!self.file.bytes[words].trim_ascii().is_empty());
    }

    /// The next number of an element: of binary files the next bytes, in text the next word of the line.
    fn number(&mut self, kind: Kind) -> Result<f64, String> {
        if self.form != Form::Text {
            let bytes = self.file.left().get(..kind.size()).ok_or("the file is cut off")?;
            let number = kind.number(bytes, self.form == Form::Big);
            self.file.at += kind.size();
            return Ok(number);
        }
        let line = self.file.bytes[self.words.clone()].trim_ascii_start();
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let (word, rest) = line.split_at(end);
        self.words.start = self.words.end - rest.len();
        if word.is_empty() {
            return Err("the line has fewer numbers than the header says".to_owned());
        }
        // Most are indices.
        if word.len() <= 9 && word.iter().all(u8::is_ascii_digit) {
            let number = word.iter().fold(0, |sum, byte| 10 * sum + u32::from(byte - b'0'));
            return Ok(f64::from(number));
        }
        if word.contains(&b',') {
            self.comma.get_or_insert(self.file.line);
        }
        expected_number(word)
    }

    /// The length of a list, which cannot be longer than what is left of the file.
    fn length(&mut self, kind: Kind) -> Result<usize, String> {
        let length = self.number(kind)?;
        // A length is checked before anything is reserved for it.
        let is_whole = length >= 0.0 && length.fract() == 0.0;
        // Most lists end in what was read already, and then nobody has to ask for the length of the file.
        if !is_whole || length > self.file.left().len() as f64 {
            let left = self.file.left_bytes() + self.words.len() as u64;
            if !is_whole || length > left as f64 {
                return Err(format!("a list of {length} numbers, and {left} bytes are left"));
            }
        }
        Ok(length as usize)
    }

    /// Moves past a property whose values are not drawn.
    fn skip(&mut self, property: &Property) -> Result<(), String> {
        let count = property.length.map_or(Ok(1), |kind| self.length(kind))?;
        for _ in 0..count {
            self.number(property.kind)?;
        }
        Ok(())
    }
}

/// Reads the lines up to `end_header`.
fn header(body: &mut Body) -> Result<Header, Wrong> {
    let (elements, textures, unknown) = (Vec::new(), Vec::new(), Vec::new());
    let mut header = Header { form: Form::Text, elements, textures, unknown };
    let mut is_known = false;
    loop {
        let line = body.next_line()?;
        let line = line.ok_or_else(|| body.wrong("the file ends inside its header"))?;
        let line = String::from_utf8_lossy(&body.file.bytes[line]).into_owned();
        // Some programs write capitals.
        let lower = line.to_ascii_lowercase();
        // A line by its words; names are taken as they were written.
        let words: Vec<&str> = lower.split_whitespace().collect();
        let shown = printable_short(line.trim(), 60);
        let wrong = || body.wrong(&format!("'{shown}' is no line of a header"));
        let as_written = |at| line.split_whitespace().nth(at).unwrap_or_default().to_owned();
        match words[..] {
            [] | ["ply" | "obj_info", ..] => {}
            ["comment", "texturefile", ..] => {
                let name = lower.find("texturefile").map_or("", |at| &line[at + 11..]);
                header.textures.push(name.trim().to_owned());
            }
            ["comment", ..] => {}
            ["format", form, ..] => {
                header.form = match form {
                    "ascii" => Form::Text,
                    "binary_little_endian" => Form::Little,
                    "binary_big_endian" => Form::Big,
                    _ => return Err(wrong()),
                };
                is_known = true;
            }
            ["element", _, count] => {
                let count = count.parse().map_err(|_| wrong())?;
                let (name, properties) = (as_written(1), Vec::new());
                header.elements.push(Element { name, count, properties });
            }
            ["property", "list", length, kind, _] => {
                let element = header.elements.last_mut().ok_or_else(wrong)?;
                let (length, kind) = kind_of(length).zip(kind_of(kind)).ok_or_else(wrong)?;
                let (name, length) = (as_written(4), Some(length));
                element.properties.push(Property { name, kind, length });
            }
            ["property", kind, _] => {
                let element = header.elements.last_mut().ok_or_else(wrong)?;
                let (kind, name) = (kind_of(kind).ok_or_else(wrong)?, as_written(2));
                element.properties.push(Property { name, kind, length: None });
            }
            ["end_header"] if is_known => return Ok(header),
            ["end_header"] => return Err(body.wrong("the header names no format")),
            ["element" | "property", ..] => return Err(wrong()),
            // Some programs leave out the word `comment`.
            _ => header.unknown.push((body.file.line, shown)),
        }
    }
}

/// What the numbers of a vertex are, by their names.
const VERTEX: [&[&str]; 12] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx", "normal_x"],
    &["ny", "normal_y"],
    &["nz", "normal_z"],
    &["u", "s", "texture_u", "texcoord_u", "texture_s"],
    &["v", "t", "texture_v", "texcoord_v", "texture_t"],
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
    &["alpha", "a", "diffuse_alpha"],
];

/// Where the channels of the colour begin in [`VERTEX`].
const FIRST_COLOUR: usize = 8;

/// The number of the opacity in [`VERTEX`].
const ALPHA: usize = 11;

/// Reads the text or the bytes of a PLY.
pub(crate) fn read(mut file: Records, contents: &mut Contents) -> Result<(), Wrong> {
    // The first line break tells what all of them are: those of old systems are a carriage return alone.
    let line_break = file.left().iter().position(|byte| matches!(byte, b'\n' | b'\r'));
    let line_break = &file.left()[line_break.unwrap_or(0)..];
    file.is_old = line_break.starts_with(b"\r") && !line_break.starts_with(b"\r\n");
    let (form, words) = (Form::Text, 0..0);
    let mut body = Body { file, form, words, element: 0, long: 0, comma: None };
    // The header says in which form the rest is.
    let header = header(&mut body)?;
    body.form = header.form;
    if body.form != Form::Text {
        body.file.line = 0;
        // A header may end the file.
        body.file.at = body.file.at.min(body.file.bytes.len());
    }
    // All elements of a file make one part, in the order in which they come.
    let mut part = FilePart::default();
    for element in header.elements.iter().filter(|element| !element.properties.is_empty()) {
        body.element = 0;
        let result = match element.name.to_ascii_lowercase().as_str() {
            "vertex" => vertices(&mut body, element, &mut part, contents),
            "face" => faces(&mut body, element, &mut part, contents),
            "tristrips" => strips(&mut body, element, &mut part),
            "edge" => others(&mut body, element, "edge", contents),
            _ => {
                let key = format!("element {}", printable_short(&element.name, 40));
                others(&mut body, element, &key, contents)
            }
        };
        result.map_err(|Wrong { cause, .. }| {
            let name = printable_short(&element.name, 40);
            body.wrong(&format!("{name} {} of {}: {cause}", body.element + 1, element.count))
        })?;
    }
    let warnings = &mut contents.warnings;
    for (line, shown) in &header.unknown {
        let text = format!("'{shown}' is no line of a header; it is left out");
        warnings.add_at(*line, "lines of the header", &text);
    }
    body.end_element();
    body.file.read_all()?;
    let left = body.file.left().trim_ascii().len();
    if left > 0 {
        let text = format!("{left} bytes follow the last element; they are left out");
        warnings.add("bytes", &text);
    }
    if body.long > 0 {
        let what = "lines have more numbers than the header says; the rest of them is left out";
        warnings.add("lines", &format!("{} {what}", body.long));
    }
    if let Some(line) = body.comma {
        let text = "from this line on, a comma in a number is taken as a decimal point";
        warnings.add_at(line, "commas", text);
    }
    // All elements are read; what names vertices is checked now, for they may have come after the faces.
    check(&part)?;
    if part.normals.values.len() == part.positions.len() {
        part.normals.numbers = Numbers::OfPositions;
    }
    if part.uvs.numbers == Numbers::Nothing && part.uvs.values.len() == part.positions.len() {
        part.uvs.numbers = Numbers::OfPositions;
    }
    if part.colours.numbers == Numbers::Nothing && !part.colours.values.is_empty() {
        part.colours.values.resize(part.positions.len(), DVec3::ONE);
        part.colours.numbers = Numbers::OfPositions;
    }
    if part.polygons.len() == 0 {
        contents.count("point", part.positions.len() as u64);
    }
    surface(&header, &mut part, contents);
    contents.parts.push(part);
    Ok(())
}

/// Counts elements that are not drawn, and moves past them.
fn others(
    body: &mut Body,
    element: &Element,
    key: &str,
    contents: &mut Contents,
) -> Result<(), Wrong> {
    contents.count(key, element.count);
    while body.element < element.count {
        body.next_element()?;
        for property in &element.properties {
            body.skip(property)?;
        }
        body.element += 1;
    }
    Ok(())
}

/// The values of one vertex, in the order of [`VERTEX`].
type Vertex = [f64; VERTEX.len()];

/// What a vertex has that gives no values.
const NO_VALUES: Vertex = {
    let mut values = [0.0; VERTEX.len()];
    values[ALPHA] = 1.0;
    values
};

/// What a property of a vertex is, as its place in [`VERTEX`]; nothing where it is not drawn.
fn place_in_vertex(property: &Property) -> Option<usize> {
    let is = |name: &&str| property.name.eq_ignore_ascii_case(name);
    VERTEX.iter().position(|names| property.length.is_none() && names.iter().any(is))
}

/// A number of a vertex: as it is, or as a channel from 0 to 1.
fn scaled(place: usize, kind: Kind, value: f64) -> f64 {
    if place < FIRST_COLOUR { value } else { value / full(kind) }
}

/// Reads the vertices: positions, and what else the header gives them.
fn vertices(
    body: &mut Body,
    element: &Element,
    part: &mut FilePart,
    contents: &mut Contents,
) -> Result<(), Wrong> {
    let places: Vec<Option<usize>> = element.properties.iter().map(place_in_vertex).collect();
    let has = |range: Range<usize>| range.clone().all(|at| places.contains(&Some(at)));
    // Nothing can be drawn without positions; of the others those are taken that are complete.
    if !has(0..3) {
        return Err("the header gives vertices no x, y and z".into());
    }
    let (has_normals, has_uvs, has_colours) = (has(3..6), has(6..8), has(FIRST_COLOUR..ALPHA));
    for (property, place) in element.properties.iter().zip(&places) {
        if place.is_none() {
            let name = printable_short(&property.name, 40);
            contents.count(&format!("value '{name}' of position"), element.count);
        }
    }
    // As many as the file can hold, whatever the header says.
    part.positions.reserve(element.count.min(body.file.left_bytes()) as usize);
    let mut transparent = 0;
    // Adds a vertex, with what the header gives to vertices.
    let mut push = |[x, y, z, nx, ny, nz, u, v, r, g, b, a]: Vertex| {
        part.positions.push(DVec3::new(x, y, z));
        if has_normals {
            part.normals.values.push(DVec3::new(nx, ny, nz));
        }
        if has_uvs {
            part.uvs.values.push(DVec2::new(u, v));
        }
        if has_colours {
            part.colours.values.push(clamped(DVec3::new(r, g, b)));
            transparent += u64::from(a < 1.0);
        }
    };
    // Whole records of bytes are read by all threads. What is cut off, and what has lists, is read number by number.
    if body.form != Form::Text && element.properties.iter().all(|one| one.length.is_none()) {
        // The place and the type of each value that is read, and how many bytes of the record are before it.
        let (mut columns, mut size) = (Vec::new(), 0);
        for (property, place) in element.properties.iter().zip(&places) {
            columns.extend(place.map(|place| (place, property.kind, size)));
            size += property.kind.size();
        }
        let is_big = body.form == Form::Big;
        let vertex = |record: &[u8]| {
            let mut values = NO_VALUES;
            for &(place, kind, at) in &columns {
                values[place] = scaled(place, kind, kind.number(&record[at..], is_big));
            }
            values
        };
        let mut read: Vec<Vertex> = Vec::new();
        let whole = body.file.records(size, element.count, |bytes| {
            // As many at once as stay in the caches.
            for bytes in bytes.chunks(size * SHARE * rayon::current_num_threads()) {
                let records = bytes.par_chunks_exact(size).with_min_len(SHARE);
                records.map(vertex).collect_into_vec(&mut read);
                for &values in &read {
                    push(values);
                }
            }
            bytes.len() / size
        });
        body.element = whole?;
    }
    while body.element < element.count {
        body.next_element()?;
        let mut values = NO_VALUES;
        for (property, place) in element.properties.iter().zip(&places) {
            match place {
                None => body.skip(property)?,
                Some(place) => {
                    values[*place] = scaled(*place, property.kind, body.number(property.kind)?);
                }
            }
        }
        push(values);
        body.element += 1;
    }
    contents.count("transparent position", transparent);
    Ok(())
}

/// A colour between black and white. One that is no number stays so.
fn clamped(colour: DVec3) -> DVec3 {
    if colour.is_nan() { colour } else { colour.clamp(DVec3::ZERO, DVec3::ONE) }
}

/// The red, green and blue of an element that has all three.
fn channels(element: &Element) -> Option<[&Property; 3]> {
    let mut channels = [None; 3];
    for property in &element.properties {
        for (channel, names) in channels.iter_mut().zip(&VERTEX[FIRST_COLOUR..ALPHA]) {
            if property.length.is_none() && names.contains(&property.name.as_str()) {
                channel.get_or_insert(property);
            }
        }
    }
    let [r, g, b] = channels;
    Some([r?, g?, b?])
}

/// The list of a face that names its vertices.
fn is_corners(property: &Property) -> bool {
    let names = ["vertex_indices", "vertex_index", "vertex_indexes"];
    property.length.is_some() && names.iter().any(|name| property.name.eq_ignore_ascii_case(name))
}

/// What a face gives by one of its properties.
enum Role {
    /// A list of vertices, whose length has this type.
    Corners(Kind),
    /// A list of texture coordinates of the corners, as MeshLab writes them.
    Uvs(Kind),
    /// A channel of its colour, by its number.
    Channel(usize),
    /// What has no part in the picture is counted, and read past.
    NotDrawn,
}

/// Reads polygons as lists of vertices.
fn faces(
    body: &mut Body,
    element: &Element,
    part: &mut FilePart,
    contents: &mut Contents,
) -> Result<(), Wrong> {
    if !element.properties.iter().any(is_corners) {
        return Err("the header gives faces no list 'vertex_indices'".into());
    }
    // The colours of vertices are finer.
    // A face has a colour of its own only where its vertices have none.
    let of_vertices = !part.colours.values.is_empty() && part.colours.numbers == Numbers::Nothing;
    let channels = if of_vertices { None } else { channels(element) };
    let role = |property: &Property| match property.length {
        Some(length) if is_corners(property) => Role::Corners(length),
        Some(length) if property.name.eq_ignore_ascii_case("texcoord") => Role::Uvs(length),
        _ => {
            let is_channel = |channel: &&Property| channel.name == property.name;
            let channel = channels.and_then(|channels| channels.iter().position(is_channel));
            channel.map_or(Role::NotDrawn, Role::Channel)
        }
    };
    // Names are compared once, and not for each face.
    let properties: Vec<(Role, &Property)> =
        element.properties.iter().map(|property| (role(property), property)).collect();
    for (role, property) in &properties {
        match role {
            Role::NotDrawn => {
                let key = format!("value '{}' of face", printable_short(&property.name, 40));
                contents.count(&key, element.count);
            }
            Role::Uvs(_) => part.uvs = Vectors::default(),
            Role::Corners(_) | Role::Channel(_) => {}
        }
    }
    if body.form == Form::Text {
        let most = element.count.min(body.file.left_bytes()) as usize;
        part.corners.reserve(3 * most);
        part.polygons.lines.reserve(most);
    }
    let mut small = 0;
    // Those of the face that is read.
    let (mut corners, mut uvs) = (Vec::new(), Vec::new());
    loop {
        // Triangles in the usual form are read many at once, up to a face of another form, which is read here.
        body.element += triangles(body, element, element.count - body.element, part)?;
        if body.element == element.count {
            break;
        }
        body.next_element()?;
        corners.clear();
        uvs.clear();
        let mut colour = DVec3::ONE;
        for (role, property) in &properties {
            match *role {
                Role::Corners(length) => {
                    for _ in 0..body.length(length)? {
                        let value = body.number(property.kind)?;
                        corners.push(corner(part.positions.len(), value)?);
                    }
                }
                Role::Uvs(length) => {
                    for _ in 0..body.length(length)? {
                        uvs.push(body.number(property.kind)?);
                    }
                }
                Role::Channel(channel) => {
                    colour[channel] = body.number(property.kind)? / full(property.kind);
                }
                Role::NotDrawn => body.skip(property)?,
            }
        }
        body.element += 1;
        if corners.len() < 3 {
            small += 1;
            continue;
        }
        // What the corners name follows what the faces before them name.
        // Two numbers for each corner, or none of them is used.
        let (pairs, _) = uvs.as_chunks::<2>();
        let first_uv = part.uvs.values.len() as u32;
        let has_uvs = pairs.len() == corners.len();
        if has_uvs {
            part.uvs.values.extend(pairs.iter().map(|&uv| DVec2::from_array(uv)));
        }
        let mut of_face = NONE;
        if channels.is_some() {
            of_face = part.colours.values.len() as u32;
            part.colours.values.push(clamped(colour));
        }
        let start = part.corners.len();
        for (&corner, uv) in corners.iter().zip(first_uv..) {
            part.push(corner, [NONE, if has_uvs { uv } else { NONE }, of_face]);
        }
        part.end_polygon(start, body.file.line, 0);
    }
    contents.count(INCOMPLETE_FACE, small);
    Ok(())
}

/// Reads the next faces of a binary file as long as they are triangles in the form that is usual, and returns how many they are.
/// Everything else is left to the caller.
fn triangles(
    body: &mut Body,
    element: &Element,
    most: u64,
    part: &mut FilePart,
) -> Result<u64, Wrong> {
    const RECORD: usize = 13;
    // A length of one byte and three numbers of four bytes are the form of nearly all files.
    let [Property { kind: Kind::I32 | Kind::U32, length: Some(Kind::U8 | Kind::I8), .. }] =
        element.properties[..]
    else {
        return Ok(0);
    };
    if body.form == Form::Text || most == 0 {
        return Ok(0);
    }
    let is_big = body.form == Form::Big;
    let corners = |record: &[u8; RECORD]| {
        let number = |at: usize| {
            let number = u32::from_le_bytes([0, 1, 2, 3].map(|byte| record[at + byte]));
            if is_big { number.swap_bytes() } else { number }
        };
        [1, 5, 9].map(number)
    };
    // Negative indices are larger than those that are allowed.
    let is_other = |record: &[u8; RECORD]| {
        record[0] != 3 || corners(record).iter().any(|&corner| corner > i32::MAX as u32)
    };
    let mut read = Vec::new();
    if part.corners.is_empty() {
        read.reserve(most.min(body.file.left_bytes() / RECORD as u64) as usize);
    }
    let count = body.file.records(RECORD, most, |bytes| {
        let records = bytes.as_chunks::<RECORD>().0;
        // A few first, since every other face may have four corners.
        let few = records[..records.len().min(SHARE)].iter().position(is_other);
        // Up to the first face of another form.
        let found = few.or_else(|| parallel::first(records, is_other));
        let records = &records[..found.unwrap_or(records.len())];
        if records.len() <= SHARE {
            read.extend(records.iter().map(corners));
        } else {
            read.par_extend(records.par_iter().with_min_len(SHARE).map(corners));
        }
        records.len()
    });
    part.push_triangles(read);
    count
}

/// Whether an index names a vertex is checked at the end, since vertices may follow.
fn corner(count: usize, value: f64) -> Result<u32, String> {
    if value < 0.0 || value >= f64::from(u32::MAX) || value.fract() != 0.0 {
        return Err(format!("{value} is no index of a vertex; the file has {count}"));
    }
    Ok(value as u32)
}

/// Strips of triangles, each ended by -1.
fn strips(body: &mut Body, element: &Element, part: &mut FilePart) -> Result<(), Wrong> {
    while body.element < element.count {
        body.next_element()?;
        for property in &element.properties {
            let (Some(length), true) = (property.length, is_corners(property)) else {
                body.skip(property)?;
                continue;
            };
            let (mut before, mut count) = ([0.0; 2], 0);
            for _ in 0..body.length(length)? {
                let value = body.number(property.kind)?;
                if value < 0.0 {
                    count = 0;
                    continue;
                }
                let [a, b] = before;
                // Triangles of two equal corners lead from one part of a strip to the next.
                if count >= 2 && a != b && b != value && a != value {
                    let start = part.corners.len();
                    for value in if count % 2 == 0 { [a, b, value] } else { [b, a, value] } {
                        part.push(corner(part.positions.len(), value)?, [NONE; 3]);
                    }
                    part.end_polygon(start, body.file.line, 0);
                }
                before = [b, value];
                count += 1;
            }
        }
        body.element += 1;
    }
    Ok(())
}

/// Whether all vertices that faces name are there.
fn check(part: &FilePart) -> Result<(), Wrong> {
    let count = part.positions.len();
    let wrong = parallel::first(&part.corners, |&corner| corner as usize >= count);
    let Some(wrong) = wrong else { return Ok(()) };
    let face = part.polygons.of_corner(wrong);
    let line = part.polygons.line(face) as usize;
    let index = part.corners[wrong];
    let cause = format!("face {} names vertex {index}, and the file has {count}, from 0", face + 1);
    Err(Wrong { line, cause: format!("{cause}: export the model again") })
}

/// The texture that a comment names.
fn surface(header: &Header, part: &mut FilePart, contents: &mut Contents) {
    let Some((name, others)) = header.textures.split_first() else { return };
    contents.count("other texture", others.len() as u64);
    if part.uvs.values.is_empty() {
        contents.count("texture without coordinates", 1);
        return;
    }
    let folder = contents.folder();
    match Textures::new(&folder).get(name, false) {
        Ok(decoded) => {
            part.material = Some(contents.materials.len());
            contents.materials.push(Surface {
                colour: DVec3::ONE,
                opacity: opacity(1.0, decoded.opacity()),
                texture: Some(decoded.texture.into()),
                ..Surface::default()
            });
        }
        Err(error) => {
            let error = outside::of_picture(&folder, error);
            let text = format!("{error}; the model is drawn without it");
            contents.warnings.add_as_it_is("textures", text);
        }
    }
}
