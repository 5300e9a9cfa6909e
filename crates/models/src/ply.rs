//! PLY: elements of named numbers, in text or in binary of either byte order.
//!
//! Own code: `ply-rs` and its fork `ply-rs-bw` keep each element in a map from names to values, unless all properties of a file
//! are known beforehand, and their errors name no line of the body.

use std::ops::Range;
use std::path::Path;

use glam::{DMat4, DVec2, DVec3};
use rasterproof_core::parallel::{self, SHARE};
use rasterproof_host::error::FileError;
use rasterproof_host::text::printable_short;
use rasterproof_render::pipeline::highlight::Specular;
use rayon::prelude::*;

use crate::ahead::Ahead;
use crate::contents::{Contents, FilePart, INCOMPLETE_FACE, NONE, Numbers, Sides, Surface};
use crate::text::{number, without_mark};
use crate::textures::{Textures, opacity};
use crate::{BadFile, Warnings, bad, outside};

/// Whether these bytes begin as a PLY.
pub(crate) fn is_ply(bytes: &[u8]) -> bool {
    without_mark(bytes).strip_prefix(b"ply").is_some_and(|rest| {
        rest.trim_ascii_start().len() < rest.len() && rest.trim_ascii_start().starts_with(b"format")
            || rest.starts_with(b"\n")
            || rest.starts_with(b"\r")
    })
}

/// The type of a number, which decides how many bytes it has in a binary file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// By which a channel of a colour is divided.
    fn full(self) -> f64 {
        match self {
            Self::I8 | Self::U8 => 255.0,
            Self::I16 | Self::U16 => 65535.0,
            Self::I32 | Self::U32 => f64::from(u32::MAX),
            Self::F32 | Self::F64 => 1.0,
        }
    }

    /// The number at the beginning of these bytes, of which there are [`Self::size`] or more.
    #[inline]
    fn number(self, bytes: &[u8], is_big: bool) -> f64 {
        fn word<const N: usize>(bytes: &[u8], is_big: bool) -> [u8; N] {
            let mut word = *bytes.first_chunk().unwrap_or(&[0; N]);
            if is_big {
                word.reverse();
            }
            word
        }
        match self {
            Self::I8 => f64::from(i8::from_le_bytes(word(bytes, is_big))),
            Self::U8 => f64::from(u8::from_le_bytes(word(bytes, is_big))),
            Self::I16 => f64::from(i16::from_le_bytes(word(bytes, is_big))),
            Self::U16 => f64::from(u16::from_le_bytes(word(bytes, is_big))),
            Self::I32 => f64::from(i32::from_le_bytes(word(bytes, is_big))),
            Self::U32 => f64::from(u32::from_le_bytes(word(bytes, is_big))),
            Self::F32 => f64::from(f32::from_le_bytes(word(bytes, is_big))),
            Self::F64 => f64::from_le_bytes(word(bytes, is_big)),
        }
    }
}

/// A number of an element, or a list with its length.
struct Property {
    name: String,
    kind: Kind,
    length: Option<Kind>,
}

struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Text,
    Little,
    Big,
}

/// The lines before the data: the form of the file, and which elements follow in which order.
struct Header {
    form: Form,
    elements: Vec<Element>,
    /// Pictures that comments name, as some programs write them.
    textures: Vec<String>,
    /// Lines that the format does not define, with their numbers, for a warning.
    unknown: Vec<(usize, String)>,
}

/// The numbers of a file, one after the other.
struct Body {
    file: Ahead,
    form: Form,
    newline: u8,
    /// The line of text, from 1, and where what is left of it is.
    line: usize,
    words: Range<usize>,
    /// Lines of text with more numbers than the header says.
    long: u64,
}

impl Body {
    /// Where the next line is, without its line break. Moves past it.
    fn next_line(&mut self) -> Option<Range<usize>> {
        let start = self.file.at;
        let rest = Some(self.file.left()).filter(|rest| !rest.is_empty())?;
        let end = memchr::memchr(self.newline, rest).unwrap_or(rest.len());
        self.file.at += (end + 1).min(rest.len());
        self.line += 1;
        Some(start..start + end)
    }

    /// Goes to the next element: a line in text.
    fn next_element(&mut self) -> Result<(), String> {
        if self.form != Form::Text {
            return self.file.read_all().map_err(|error| error.cause);
        }
        self.end_element();
        loop {
            self.words = self.next_line().ok_or("the file is cut off")?;
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
        number(word).ok_or_else(|| {
            let word = printable_short(&String::from_utf8_lossy(word), 40);
            format!("'{word}' is not a number")
        })
    }

    /// The length of a list, which cannot be longer than what is left of the file.
    fn length(&mut self, kind: Kind) -> Result<usize, String> {
        let length = self.number(kind)?;
        let left = self.file.left().len() + self.words.len();
        if length < 0.0 || length > left as f64 || length.fract() != 0.0 {
            return Err(format!("a list of {length} numbers, and {left} bytes are left"));
        }
        Ok(length as usize)
    }
}

/// Reads the lines up to `end_header`. On an error the body says in which line.
fn header(body: &mut Body) -> Result<Header, String> {
    let (elements, textures, unknown) = (Vec::new(), Vec::new(), Vec::new());
    let mut header = Header { form: Form::Text, elements, textures, unknown };
    let mut is_known = false;
    loop {
        let line = body.next_line().ok_or("the file ends inside its header")?;
        let line = String::from_utf8_lossy(&body.file.bytes[line]).into_owned();
        let words: Vec<&str> = line.split_whitespace().collect();
        let shown = printable_short(line.trim(), 60);
        let wrong = || format!("'{shown}' is no line of a header");
        match words[..] {
            [] | ["ply" | "obj_info", ..] => {}
            ["comment", "TextureFile", ..] => {
                let name = line.split_once("TextureFile").map_or("", |(_, name)| name);
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
            ["element", name, count] => {
                let count = count.parse().map_err(|_| wrong())?;
                let (name, properties) = (name.to_owned(), Vec::new());
                header.elements.push(Element { name, count, properties });
            }
            ["property", "list", length, kind, name] => {
                let element = header.elements.last_mut().ok_or_else(wrong)?;
                let (length, kind) = Kind::of(length).zip(Kind::of(kind)).ok_or_else(wrong)?;
                let (name, length) = (name.to_owned(), Some(length));
                element.properties.push(Property { name, kind, length });
            }
            ["property", kind, name] => {
                let element = header.elements.last_mut().ok_or_else(wrong)?;
                let kind = Kind::of(kind).ok_or_else(wrong)?;
                element.properties.push(Property { name: name.to_owned(), kind, length: None });
            }
            ["end_header"] if is_known => return Ok(header),
            ["end_header"] => return Err("the header names no format".to_owned()),
            ["element" | "property", ..] => return Err(wrong()),
            // Some programs leave out the word `comment`.
            _ => header.unknown.push((body.line, shown)),
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

/// Why an element cannot be read, and its number from 0.
type Wrong = (u64, String);

/// Reads the text or the bytes of a PLY.
pub(crate) fn read(path: &Path, mut file: Ahead) -> Result<Contents, BadFile> {
    let unread = |error: FileError| bad(path, None, error.cause);
    let ends = |line_break| memchr::memmem::find(&file.bytes, line_break).is_some();
    if !ends(b"\nend_header") && !ends(b"\rend_header") {
        file.read_all().map_err(unread)?;
    }
    file.at = file.bytes.len() - without_mark(&file.bytes).len();
    let newline = match file.left().iter().find(|byte| matches!(byte, b'\n' | b'\r')) {
        // Two bytes end a line of some systems.
        Some(b'\r') if !file.left().starts_with(b"ply\r\n") => b'\r',
        _ => b'\n',
    };
    let mut body = Body { file, form: Form::Text, newline, line: 0, words: 0..0, long: 0 };
    let failed = |body: &Body, cause: &str| {
        let (line, cause) = match body.form {
            Form::Text => (Some(body.line), cause.to_owned()),
            _ => (None, format!("byte {}: {cause}", body.file.byte())),
        };
        bad(path, line, format!("{cause}: export the model again"))
    };
    let header = header(&mut body).map_err(|cause| failed(&body, &cause))?;
    body.form = header.form;
    match body.form {
        Form::Text => body.file.read_all().map_err(unread)?,
        Form::Little | Form::Big => body.line = 0,
    }
    let mut contents = Contents::default();
    let mut part = FilePart { to_file: DMat4::IDENTITY, ..FilePart::default() };
    for element in header.elements.iter().filter(|element| !element.properties.is_empty()) {
        let result = match element.name.as_str() {
            "vertex" => vertices(&mut body, element, &mut part, &mut contents),
            "face" => faces(&mut body, element, &mut part, &mut contents),
            "tristrips" => strips(&mut body, element, &mut part),
            name => {
                let edge = name == "edge";
                let key =
                    if edge { name } else { &format!("element {}", printable_short(name, 40)) };
                add(&mut contents, key, element.count);
                (0..element.count).try_for_each(|number| {
                    body.next_element().map_err(|cause| (number, cause))?;
                    skip(&mut body, &element.properties).map_err(|cause| (number, cause))
                })
            }
        };
        result.map_err(|(number, cause)| {
            let name = printable_short(&element.name, 40);
            failed(&body, &format!("{name} {} of {}: {cause}", number + 1, element.count))
        })?;
    }
    let mut warnings = Warnings::default();
    for (line, shown) in &header.unknown {
        let text = format!("'{shown}' is no line of a header; it is left out");
        warnings.add(path, Some(*line), "lines of the header", &text);
    }
    body.file.read_all().map_err(unread)?;
    let left = body.file.left().trim_ascii().len();
    if left > 0 {
        let text = format!("{left} bytes follow the last element; they are left out");
        warnings.add(path, None, "bytes", &text);
    }
    body.end_element();
    if body.long > 0 {
        let what = "lines have more numbers than the header says; the rest of them is left out";
        warnings.add(path, None, "lines", &format!("{} {what}", body.long));
    }
    check(path, &part)?;
    if part.normals.len() == part.positions.len() {
        part.normal_numbers = Numbers::OfPositions;
    }
    if part.uv_numbers == Numbers::Nothing && part.uvs.len() == part.positions.len() {
        part.uv_numbers = Numbers::OfPositions;
    }
    if !part.face_colours.is_empty() {
        part.face_colours.resize(part.polygons.len(), DVec3::ONE);
    }
    if part.polygons.len() == 0 {
        add(&mut contents, "point", part.positions.len() as u64);
    }
    surface(path, &header, &mut part, &mut contents, &mut warnings);
    contents.warnings = warnings.finish();
    contents.parts.push(part);
    Ok(contents)
}

fn add(contents: &mut Contents, key: &str, count: u64) {
    if count > 0 {
        *contents.not_drawn.entry(key.to_owned()).or_default() += count;
    }
}

/// Moves past properties whose values nobody reads.
fn skip(body: &mut Body, properties: &[Property]) -> Result<(), String> {
    for property in properties {
        let count = property.length.map_or(Ok(1), |kind| body.length(kind))?;
        for _ in 0..count {
            body.number(property.kind)?;
        }
    }
    Ok(())
}

fn vertices(
    body: &mut Body,
    element: &Element,
    part: &mut FilePart,
    contents: &mut Contents,
) -> Result<(), Wrong> {
    let place = |property: &Property| {
        let is_named = |names: &&[&str]| names.contains(&property.name.as_str());
        VERTEX.iter().position(|names| property.length.is_none() && is_named(names))
    };
    let places: Vec<Option<usize>> = element.properties.iter().map(place).collect();
    let has = |range: std::ops::Range<usize>| range.clone().all(|at| places.contains(&Some(at)));
    if !has(0..3) {
        return Err((0, "the header gives vertices no x, y and z".to_owned()));
    }
    let (has_normals, has_uvs, has_colours) = (has(3..6), has(6..8), has(8..11));
    for (property, place) in element.properties.iter().zip(&places) {
        if place.is_none() {
            let name = printable_short(&property.name, 40);
            add(contents, &format!("value '{name}' of position"), element.count);
        }
    }
    // As many as the file can hold, whatever the header says.
    let most = element.count.min(body.file.left_bytes()) as usize;
    part.positions.reserve(most);
    let scaled = |place: usize, kind: Kind, value: f64| {
        if place < FIRST_COLOUR { value } else { value / kind.full() }
    };
    let columns = columns(body, element, &places, part);
    let (whole, mut transparent) = columns.map_err(|error| (0, error.cause))?;
    let mut push = |values: [f64; VERTEX.len()]| {
        let [x, y, z, nx, ny, nz, u, v, r, g, b, a] = values;
        part.positions.push(DVec3::new(x, y, z));
        if has_normals {
            part.normals.push(DVec3::new(nx, ny, nz));
        }
        if has_uvs {
            part.uvs.push(DVec2::new(u, v));
        }
        if has_colours {
            part.colours.push(clamped(DVec3::new(r, g, b)));
            transparent += u64::from(a < 1.0);
        }
    };
    let mut missing = [0.0; VERTEX.len()];
    missing[ALPHA] = 1.0;
    for number in whole..element.count {
        body.next_element().map_err(|cause| (number, cause))?;
        let mut values = missing;
        for (property, place) in element.properties.iter().zip(&places) {
            let result = match place {
                None => skip(body, std::slice::from_ref(property)),
                Some(place) => body.number(property.kind).map(|value| {
                    values[*place] = scaled(*place, property.kind, value);
                }),
            };
            result.map_err(|cause| (number, cause))?;
        }
        push(values);
    }
    add(contents, "transparent position", transparent);
    Ok(())
}

/// A colour between black and white. One that is no number stays so.
fn clamped(colour: DVec3) -> DVec3 {
    if colour.is_nan() { colour } else { colour.clamp(DVec3::ZERO, DVec3::ONE) }
}

/// Reads the vertices of a binary file that have no lists, by all threads, and returns how many they are and how many of
/// them are transparent. If the file is cut off, those that are missing are left to the caller.
fn columns(
    body: &mut Body,
    element: &Element,
    places: &[Option<usize>],
    part: &mut FilePart,
) -> Result<(u64, u64), FileError> {
    let has_list = element.properties.iter().any(|property| property.length.is_some());
    if body.form == Form::Text || has_list {
        return Ok((0, 0));
    }
    // The type of each value of a vertex, and how many bytes are before it in the record.
    let mut columns = [None; VERTEX.len()];
    let mut size = 0;
    for (property, place) in element.properties.iter().zip(places) {
        if let Some(place) = place {
            columns[*place] = Some((property.kind, size));
        }
        size += property.kind.size();
    }
    let is_big = body.form == Form::Big;
    let number = |record: &[u8], column: Option<(Kind, usize)>| match column {
        Some((kind, at)) => kind.number(&record[at..], is_big),
        None => 0.0,
    };
    let has = |places: std::ops::Range<usize>| columns[places].iter().all(Option::is_some);
    let [u, v, alpha] = [columns[6], columns[7], columns[ALPHA]];
    let uv = |record: &[u8]| DVec2::new(number(record, u), number(record, v));
    let is_transparent =
        |record: &&[u8]| alpha.is_some_and(|(kind, _)| number(record, alpha) < kind.full());
    let mut transparent = 0;
    let whole = body.file.records(size, element.count, |bytes| {
        let records = bytes.par_chunks_exact(size).with_min_len(SHARE);
        let take = |vectors: &mut Vec<DVec3>, place: usize| {
            let [x, y, z] = [columns[place], columns[place + 1], columns[place + 2]];
            let full = [x, y, z].map(|column| column.map_or(1.0, |(kind, _)| kind.full()));
            let full = (place == FIRST_COLOUR).then_some(DVec3::from_array(full));
            vectors.par_extend(records.clone().map(move |record| {
                let vector = DVec3::new(number(record, x), number(record, y), number(record, z));
                match full {
                    Some(full) => clamped(vector / full),
                    None => vector,
                }
            }));
        };
        take(&mut part.positions, 0);
        if has(3..6) {
            take(&mut part.normals, 3);
        }
        if has(6..8) {
            part.uvs.par_extend(records.clone().map(uv));
        }
        if has(FIRST_COLOUR..ALPHA) {
            take(&mut part.colours, FIRST_COLOUR);
            let shares: Vec<&[u8]> = bytes.chunks(size * SHARE).collect();
            let of_shares = parallel::map(shares.len(), |share| {
                shares[share].chunks_exact(size).filter(is_transparent).count()
            });
            transparent += of_shares.into_iter().sum::<usize>() as u64;
        }
        bytes.len() / size
    })?;
    Ok((whole, transparent))
}

/// The red, green and blue of an element that has all three.
fn channels(element: &Element) -> Option<[&Property; 3]> {
    let find = |names: &&[&str]| {
        let is_named = |property: &&Property| names.contains(&property.name.as_str());
        element.properties.iter().find(|property| property.length.is_none() && is_named(property))
    };
    let [r, g, b] = [8, 9, 10].map(|place| find(&VERTEX[place]));
    Some([r?, g?, b?])
}

/// The list of a face that names its vertices.
fn is_corners(property: &Property) -> bool {
    let names = ["vertex_indices", "vertex_index", "vertex_indexes"];
    property.length.is_some() && names.contains(&property.name.as_str())
}

fn faces(
    body: &mut Body,
    element: &Element,
    part: &mut FilePart,
    contents: &mut Contents,
) -> Result<(), Wrong> {
    if !element.properties.iter().any(is_corners) {
        return Err((0, "the header gives faces no list 'vertex_indices'".to_owned()));
    }
    // Texture coordinates of the corners, as MeshLab writes them.
    let is_uvs = |property: &Property| property.length.is_some() && property.name == "texcoord";
    let has_uvs = element.properties.iter().any(is_uvs);
    // The colours of vertices are finer.
    let channels = if part.colours.is_empty() { channels(element) } else { None };
    for property in &element.properties {
        let is_channel =
            || channels.is_some_and(|all| all.iter().any(|one| one.name == property.name));
        if !is_corners(property) && !is_uvs(property) && !is_channel() {
            let key = format!("value '{}' of face", printable_short(&property.name, 40));
            add(contents, &key, element.count);
        }
    }
    if has_uvs {
        part.uvs.clear();
        part.uv_numbers = Numbers::OfCorners(vec![NONE; part.corners.len()]);
    }
    let most = element.count.min(body.file.left_bytes()) as usize;
    if body.form == Form::Text {
        part.corners.reserve(3 * most);
        part.polygons.lines.reserve(most);
    }
    let (mut small, mut uvs) = (0, Vec::new());
    let mut number = 0;
    while number < element.count {
        let many = triangles(body, element, element.count - number, part);
        number += many.map_err(|error| (number, error.cause))?;
        if number == element.count {
            break;
        }
        let wrong = |cause| (number, cause);
        body.next_element().map_err(wrong)?;
        let start = part.corners.len();
        uvs.clear();
        let mut colour = DVec3::ONE;
        for property in &element.properties {
            let is_named = |channel: &&Property| channel.name == property.name;
            if let Some(channel) = channels.and_then(|all| all.iter().position(is_named)) {
                colour[channel] = body.number(property.kind).map_err(wrong)? / property.kind.full();
                continue;
            }
            let (Some(length), true) = (property.length, is_corners(property) || is_uvs(property))
            else {
                skip(body, std::slice::from_ref(property)).map_err(wrong)?;
                continue;
            };
            for _ in 0..body.length(length).map_err(wrong)? {
                let value = body.number(property.kind).map_err(wrong)?;
                if is_corners(property) {
                    part.corners.push(corner(part.positions.len(), value).map_err(wrong)?);
                } else {
                    uvs.push(value);
                }
            }
        }
        number += 1;
        let count = part.corners.len() - start;
        if count < 3 {
            part.corners.truncate(start);
            small += 1;
            continue;
        }
        if let Numbers::OfCorners(numbers) = &mut part.uv_numbers {
            let (pairs, _) = uvs.as_chunks::<2>();
            let first = part.uvs.len() as u32;
            let is_whole = pairs.len() == count;
            numbers.extend((first..).take(count).map(|at| if is_whole { at } else { NONE }));
            if is_whole {
                part.uvs.extend(pairs.iter().map(|&uv| DVec2::from_array(uv)));
            }
        }
        if channels.is_some() {
            // Triangles of strips before them have none.
            part.face_colours.resize(part.polygons.len(), DVec3::ONE);
            part.face_colours.push(clamped(colour));
        }
        part.polygons.push(count, body.line as u32, 0);
    }
    add(contents, INCOMPLETE_FACE, small);
    Ok(())
}

/// Reads the next faces of a binary file as long as they are triangles in the form that is usual, and returns how many they are.
/// Everything else is left to the caller.
fn triangles(
    body: &mut Body,
    element: &Element,
    most: u64,
    part: &mut FilePart,
) -> Result<u64, FileError> {
    const RECORD: usize = 13;
    let [Property { kind: Kind::I32 | Kind::U32, length: Some(Kind::U8 | Kind::I8), .. }] =
        element.properties[..]
    else {
        return Ok(0);
    };
    if body.form == Form::Text {
        return Ok(0);
    }
    let is_big = body.form == Form::Big;
    let corners = |record: &[u8; RECORD]| {
        let [_, words @ ..] = record;
        let number = |word: &[u8; 4]| {
            let number = u32::from_le_bytes(*word);
            if is_big { number.swap_bytes() } else { number }
        };
        let [a, b, c] = words.as_chunks().0 else { unreachable!("three numbers of four bytes") };
        [number(a), number(b), number(c)]
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
        let found = few.or_else(|| parallel::first(records, is_other));
        let records = &records[..found.unwrap_or(records.len())];
        if records.len() <= SHARE {
            read.extend(records.iter().map(corners));
        } else {
            read.par_extend(records.par_iter().with_min_len(SHARE).map(corners));
        }
        records.len()
    })?;
    if part.corners.is_empty() {
        part.corners = read.into_flattened();
    } else {
        part.corners.extend_from_slice(read.as_flattened());
    }
    if let Numbers::OfCorners(numbers) = &mut part.uv_numbers {
        numbers.resize(part.corners.len(), NONE);
    }
    part.polygons.push_triangles(count as usize);
    Ok(count)
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
    for number in 0..element.count {
        let wrong = |cause| (number, cause);
        body.next_element().map_err(wrong)?;
        for property in &element.properties {
            let (Some(length), true) = (property.length, is_corners(property)) else {
                skip(body, std::slice::from_ref(property)).map_err(wrong)?;
                continue;
            };
            let (mut before, mut count) = ([0.0; 2], 0);
            for _ in 0..body.length(length).map_err(wrong)? {
                let value = body.number(property.kind).map_err(wrong)?;
                if value < 0.0 {
                    count = 0;
                    continue;
                }
                let [a, b] = before;
                // Triangles of two equal corners lead from one part of a strip to the next.
                if count >= 2 && a != b && b != value && a != value {
                    let turned = if count % 2 == 0 { [a, b, value] } else { [b, a, value] };
                    for value in turned {
                        part.corners.push(corner(part.positions.len(), value).map_err(wrong)?);
                    }
                    if let Numbers::OfCorners(numbers) = &mut part.uv_numbers {
                        numbers.extend([NONE; 3]);
                    }
                    part.polygons.push(3, body.line as u32, 0);
                }
                before = [b, value];
                count += 1;
            }
        }
    }
    Ok(())
}

/// Whether all vertices that faces name are there.
fn check(path: &Path, part: &FilePart) -> Result<(), BadFile> {
    let count = part.positions.len();
    let wrong = parallel::first(&part.corners, |&corner| corner as usize >= count);
    let Some(wrong) = wrong else { return Ok(()) };
    let face = part.polygons.of_corner(wrong);
    let line = Some(part.polygons.line(face) as usize).filter(|&line| line > 0);
    let index = part.corners[wrong];
    let cause = format!("face {} names vertex {index}, and the file has {count}, from 0", face + 1);
    Err(bad(path, line, format!("{cause}: export the model again")))
}

/// The texture that a comment names.
fn surface(
    path: &Path,
    header: &Header,
    part: &mut FilePart,
    contents: &mut Contents,
    warnings: &mut Warnings,
) {
    let Some((name, others)) = header.textures.split_first() else { return };
    add(contents, "other texture", others.len() as u64);
    if part.uvs.is_empty() {
        add(contents, "texture without coordinates", 1);
        return;
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    match Textures::new(folder).get(name, false) {
        Ok(decoded) => {
            part.material = Some(contents.materials.len());
            contents.materials.push(Surface {
                name: String::new(),
                colour: DVec3::ONE,
                opacity: opacity(1.0, decoded.opacity()),
                texture: Some(decoded.texture.into()),
                specular: Specular::default(),
                physical: None,
                unlit: false,
                sides: Sides::Alike,
            });
        }
        Err(error) => {
            let error = outside::of_picture(folder, error);
            let text = format!("{error}; the model is drawn without it");
            warnings.add_as_it_is(path, "textures", &text);
        }
    }
}
