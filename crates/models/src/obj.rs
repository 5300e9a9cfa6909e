//! OBJ: polygons in lines of text, with the materials of its MTL files.
//!
//! The crate `tobj` is not used, since it gives neither the lines of faces nor polygons with corners of mixed kinds, and
//! ends the program at some files that are broken; the tests compare this reader with it.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::Path;

use glam::{DVec2, DVec3};
use rasterproof_host::text::{printable_path, printable_short};
use rasterproof_host::{input, limits};

use std::sync::Arc;

use crate::contents::{self, Contents, FilePart, INCOMPLETE_FACE, NONE, Numbers, Surface};
use crate::items::MOST_COORDINATE;
use crate::mtl::{self, without_comment};
use crate::outside::{self, NOT_QUOTED, is_outside};
use crate::records::{self, Records, is_wide, short, without_mark};
use crate::textures::{Decoded, Textures, find, opacity};
use crate::{BadFile, Wrong};

/// Lines of material files that are read: each is looked for in the folder.
const MOST_LIBRARIES: usize = 1 << 10;

/// What a face names where nothing is.
const ABSENT: u32 = NONE - 1;

/// Positions, texture coordinates and normals of a corner, as indices from 0 or [`NONE`] or [`ABSENT`].
type FaceCorner = [u32; 3];

/// A kind of vector: the number of its index in a [`FaceCorner`], and what is said of it.
struct VectorKind {
    number: usize,
    /// What messages call one of them.
    name: &'static str,
    /// How many numbers a line has at least.
    least: usize,
    /// What becomes of one that is not finite.
    not_finite: &'static str,
}

/// The three kinds of vectors, in the order of a face's numbers.
const KINDS: [VectorKind; 3] = [
    kind(0, "position", 3, "the faces that use it are left out"),
    kind(1, "texture coordinate", 1, "it is taken as 0 0"),
    kind(2, "normal", 3, "the normal of the face takes its place"),
];

const fn kind(
    number: usize,
    name: &'static str,
    least: usize,
    not_finite: &'static str,
) -> VectorKind {
    VectorKind { number, name, least, not_finite }
}

/// What is counted of faces that are left out, since a position of theirs is not in the file or cannot be read.
const WITHOUT_POSITION: &str = "position that is missing of face";

/// What is counted of the colours that ZBrush writes into comments, eight digits for each position.
const ZBRUSH_COLOUR: &str = "ZBrush colour (#MRGB) of position";

/// Faces of one group and material, one after the other in the file.
struct Run {
    /// That of the object, or of the group.
    name: Arc<str>,
    /// The name of the material, and the first line that names it.
    material: Option<(Arc<str>, usize)>,
    /// Its numbers are those of the vectors of the file.
    part: FilePart,
}

/// The vectors of the file, which all runs share.
#[derive(Default)]
struct Vectors {
    positions: Vec<DVec3>,
    uvs: Vec<DVec2>,
    /// Of any length, as the file has them.
    normals: Vec<DVec3>,
    /// The colours of the first positions, up to the last that has one.
    colours: Vec<DVec3>,
}

impl Vectors {
    /// How many positions, texture coordinates and normals there are.
    fn counts(&self) -> [usize; 3] {
        [self.positions.len(), self.uvs.len(), self.normals.len()]
    }
}

/// What the lines of the file come to.
#[derive(Default)]
struct Lines {
    vectors: Vectors,
    /// In the order of the file, one after the other.
    runs: Vec<Run>,
    /// What lines of material files name, each once.
    libraries: Vec<String>,
    /// Those names, to find one again.
    known: HashSet<String>,
    /// Vectors that cannot be read, by kind and index, with the line and what is wrong: a vector that no face uses
    /// does no harm.
    broken: BTreeMap<(usize, u32), (usize, String)>,
}

/// What is kept for a position without a colour among others, until all lines are read.
const WITHOUT_COLOUR: DVec3 = DVec3::NEG_INFINITY;

/// Vectors that cannot be read, after which the file is refused.
const MOST_BROKEN: usize = 1 << 10;

impl Lines {
    /// Keeps why a vector cannot be read, and gives a zero for it.
    fn keep_broken(&mut self, kind: usize, line: usize, cause: String) -> Result<Values, String> {
        if self.broken.len() >= MOST_BROKEN {
            return Err(format!("{cause}, as in {MOST_BROKEN} lines before"));
        }
        let index = self.vectors.counts()[kind] as u32;
        self.broken.insert((kind, index), (line, cause));
        Ok(Values { all: [0.0; 7], count: 0, not_finite: None })
    }
}

/// Where the next face belongs.
#[derive(Default)]
struct State {
    /// The name of the last `o`; the group begins anew with it.
    object: Arc<str>,
    group: Arc<str>,
    /// The name of the last `usemtl`, and the line in which it stands.
    material: Option<(Arc<str>, usize)>,
    /// The number of the last `s`; 0 where it was `off`.
    smoothing: u32,
    /// Whether a face begins a new run.
    is_new: bool,
}

/// Reads the text of an OBJ and the material files that it names.
pub(crate) fn read(file: Records, contents: &mut Contents) -> Result<(), Wrong> {
    // The whole file is read before a part is made, since faces may name what follows them.
    let mut lines = lines(file, contents)?;
    check_faces(&mut lines, contents)?;
    let Lines { vectors, runs, libraries, .. } = lines;
    let (described, all_read) = read_libraries(&libraries, contents);
    let mut numbers: HashMap<&str, usize> = HashMap::new();
    for (number, material) in described.iter().enumerate() {
        numbers.insert(&material.name, number);
    }
    // Materials are known by their names; each becomes a surface where it is first used, and textures are decoded then.
    let mut textures = Textures::new(&contents.folder());
    // The number in `contents` of each material that is used.
    let mut used: HashMap<usize, usize> = HashMap::new();
    let mut unknown = HashSet::new();
    let mut cutter = Cutter::of(&vectors);
    let mut before = None;
    for run in runs {
        let number = match &run.material {
            None => None,
            // Without a name the material stays, unless a file describes one without a name.
            Some((name, _)) if name.is_empty() => numbers.get("").copied().or(before),
            Some((name, line)) => {
                let number = numbers.get(&**name).copied();
                if number.is_none() && all_read && unknown.insert(name.clone()) {
                    let name = printable_short(name, 40);
                    let text =
                        format!("no material file describes '{name}'; its faces are drawn grey");
                    let kind = "materials that no file describes";
                    contents.warnings.add_at(*line, kind, &text);
                }
                number
            }
        };
        before = number;
        // The part has lists of its own, and the surface that its material becomes where it is first used.
        let mut part = cutter.part(&vectors, run);
        if let Some(number) = number {
            let material = &described[number];
            part.material = Some(*used.entry(number).or_insert_with(|| {
                let surface = surface(material, &mut textures, contents);
                contents.materials.push(surface);
                contents.materials.len() - 1
            }));
            if let Some(texture) = material.texture.as_ref().or(material.opacity_map.as_ref()) {
                for uv in &mut part.uvs.values {
                    *uv = *uv * texture.scale + texture.offset;
                }
            }
        }
        contents.add(part)?;
    }
    Ok(())
}

/// Makes parts with lists of their own, which hold what they use.
struct Cutter {
    /// For each kind of vector the number in the part, or [`NONE`].
    numbers: [Vec<u32>; 3],
}

impl Cutter {
    fn of(vectors: &Vectors) -> Self {
        Self { numbers: vectors.counts().map(|count| vec![NONE; count]) }
    }

    /// A part with the vectors that a run uses.
    fn part(&mut self, vectors: &Vectors, Run { name, mut part, .. }: Run) -> FilePart {
        let p = self.local(0, &mut part.corners);
        let mut of = |kind: usize, numbers: &mut Numbers| match numbers {
            Numbers::Nothing => Vec::new(),
            // They are used in the same order as the positions.
            Numbers::OfPositions => p.clone(),
            Numbers::OfCorners(numbers) => self.local(kind, numbers),
        };
        let (t, n) = (of(1, &mut part.uvs.numbers), of(2, &mut part.normals.numbers));
        part.name = (*name).to_owned();
        part.positions = p.iter().map(|&index| vectors.positions[index as usize]).collect();
        part.uvs.values = t.iter().map(|&index| vectors.uvs[index as usize]).collect();
        part.normals.values = n.iter().map(|&index| vectors.normals[index as usize]).collect();
        // Positions after the last one that has a colour are white.
        if p.iter().any(|&index| (index as usize) < vectors.colours.len()) {
            let colours = p.iter().map(|&index| vectors.colours.get(index as usize));
            let colours = colours.map(|colour| *colour.unwrap_or(&DVec3::ONE)).collect();
            part.colours = contents::Vectors::of_positions(colours);
        }
        part
    }

    /// Replaces numbers of the file by those of a part, which are given by first use, and returns what the part uses.
    fn local(&mut self, kind: usize, indices: &mut [u32]) -> Vec<u32> {
        let numbers = &mut self.numbers[kind];
        let mut used = Vec::new();
        for index in indices.iter_mut().filter(|index| **index != NONE) {
            let number = &mut numbers[*index as usize];
            if *number == NONE {
                *number = used.len() as u32;
                used.push(*index);
            }
            *index = *number;
        }
        // Empty again, for the next part.
        for &index in &used {
            numbers[index as usize] = NONE;
        }
        used
    }
}

/// What a material becomes; a picture that cannot be read is a warning.
fn surface(
    material: &mtl::MtlMaterial,
    textures: &mut Textures,
    contents: &mut Contents,
) -> Surface {
    let folder = contents.folder();
    for key in &material.not_drawn {
        contents.count(key, 1);
    }
    let mut failed = |error: BadFile, without: &str| {
        let name = printable_short(&material.name, 40);
        let error = match material.is_quoted {
            true => outside::of_picture(&folder, error).to_string(),
            false => format!(
                "{}: a picture that a material file names cannot be read; its name is {NOT_QUOTED}",
                printable_path(&contents.path)
            ),
        };
        let text = format!("{error}; the material '{name}' is drawn {without}");
        contents.warnings.add_as_it_is("textures", text);
    };
    let texture = material.texture.as_ref().and_then(|texture| {
        let read = textures.get(&texture.name, texture.clamp);
        read.map_err(|error| failed(error, "in its colour")).ok()
    });
    // An opacity map is a grey picture, or one with opacities of its own.
    let map = match &material.opacity_map {
        None => texture.as_ref().and_then(Decoded::opacity),
        Some(map) => {
            let read = textures.opacity_map(&map.name, map.clamp);
            read.map_err(|error| failed(error, "without its opacity map")).ok()
        }
    };
    let opacity = opacity(material.opacity.unwrap_or(1.0), map);
    let texture = texture.map(|decoded| Arc::new(decoded.texture));
    // A texture is as bright as its picture, where the file does not say otherwise.
    let missing = if texture.is_some() { DVec3::ONE } else { DVec3::splat(0.8) };
    Surface {
        name: material.name.clone(),
        colour: material.colour.unwrap_or(missing),
        texture,
        specular: material.specular(),
        opacity,
        ..Surface::default()
    }
}

/// The materials of the files that a model names, in their order, and whether all files were read. A file that
/// cannot be read is a warning.
fn read_libraries(libraries: &[String], contents: &mut Contents) -> (Vec<mtl::MtlMaterial>, bool) {
    let folder = &*contents.folder();
    let Contents { path, warnings, .. } = contents;
    let (mut materials, mut left_bytes) = (Vec::new(), limits::MATERIAL_BYTES);
    let (mut seen, mut all_read) = (HashSet::new(), true);
    if libraries.len() > MOST_LIBRARIES {
        let text = format!("only the first {MOST_LIBRARIES} material files are read");
        warnings.add("material files", &text);
    }
    for names in libraries.iter().take(MOST_LIBRARIES) {
        for name in library_names(folder, names) {
            let beside =
                || find(folder, &path.with_extension("mtl").file_name()?.to_string_lossy());
            let named = find(folder, &name);
            // The file of that name, or the one beside the model that has the model's name.
            let file = named.clone().or_else(beside);
            let file = file.unwrap_or_else(|| folder.join(name.replace('\\', "/")));
            if named.is_none() && file.is_file() {
                let (name, file) = (printable_short(&name, 60), printable_path(&file));
                let text =
                    format!("there is no material file '{name}'; {file} is read in its place");
                warnings.add("material files", &text);
            }
            if !seen.insert(file.clone()) {
                continue;
            }
            match input::read(&file, left_bytes) {
                Ok(bytes) => {
                    left_bytes -= bytes.len() as u64;
                    let text = String::from_utf8_lossy(without_mark(&bytes));
                    let is_quoted = !is_outside(folder, &file);
                    materials.extend(mtl::read(&file, &text, is_quoted, warnings));
                }
                Err(error) => {
                    all_read = false;
                    let text =
                        format!("{error}; what it describes is drawn grey until the file is there");
                    warnings.add_as_it_is("material files", text);
                }
            }
        }
    }
    (materials, all_read)
}

/// The names on a line `mtllib`: one name with spaces where there is such a file, else several names.
fn library_names(folder: &Path, names: &str) -> Vec<String> {
    let words: Vec<&str> = names.split_whitespace().collect();
    if words.len() < 2 || words.len() > 64 || find(folder, names).is_some() {
        return vec![names.to_owned()];
    }
    let mut found: Vec<String> = Vec::new();
    let mut at = 0;
    while at < words.len() {
        let joined = |end: usize| words[at..end].join(" ");
        // The longest name that is there.
        let exists = (at + 1..=words.len()).rev().find(|&end| find(folder, &joined(end)).is_some());
        // A name that is not there ends where its ending is.
        let is_end = |word: &&str| word.to_ascii_lowercase().ends_with(".mtl");
        let end = exists.unwrap_or_else(|| {
            words[at..].iter().position(is_end).map_or(words.len(), |last| at + last + 1)
        });
        found.push(joined(end));
        at = end;
    }
    found
}

/// Words that begin a line which [`read_line`] reads.
const READ: [&str; 10] = ["v", "vt", "vn", "f", "fo", "o", "g", "s", "usemtl", "mtllib"];

/// Words that begin a line and are left out without a loss: what they say has an effect on curves and free-form
/// surfaces alone, or on how a program shows the model.
const WITHOUT_EFFECT: [&str; 25] = [
    "deg", "cstype", "bmat", "step", "parm", "trim", "hole", "scrv", "sp", "end", "con", "mg",
    "vp", "ctech", "stech", "bevel", "c_interp", "d_interp", "lod", "maplib", "usemap", "cdc",
    "cdp", "res", "bzp",
];

/// What is not drawn, by the word that begins its line.
const NOT_DRAWN: [(&str, &str); 10] = [
    ("l", "line"),
    ("p", "point"),
    ("curv", "curve"),
    ("curv2", "curve"),
    ("surf", "free-form surface"),
    ("shadow_obj", "shadow object"),
    ("trace_obj", "ray tracing object"),
    ("call", "call of another file"),
    ("csh", "command of the system"),
    ("bsp", "patch"),
];

/// What is wrong with a line, and what to do about it.
fn refused(line: usize, cause: &str) -> Wrong {
    Wrong { line, cause: format!("{cause}: repair the line, or export the model again") }
}

/// Reads all lines, those that go on after a backslash as one.
fn lines(mut file: Records, contents: &mut Contents) -> Result<Lines, Wrong> {
    let is_wide = is_wide(&file.bytes);
    let mut read = Lines::default();
    let mut state = State { is_new: true, ..State::default() };
    let mut joined = Vec::new();
    loop {
        let first = file.line + 1;
        let Some(line) = file.next_line()? else { break };
        let mut line = line.trim_ascii();
        // A comment may end with the name of a folder.
        if line.ends_with(b"\\") && !line.starts_with(b"#") {
            joined.clear();
            while let Some(begun) = line.strip_suffix(b"\\") {
                joined.extend_from_slice(begun);
                joined.push(b' ');
                line = file.next_line()?.unwrap_or_default().trim_ascii();
            }
            joined.extend_from_slice(line);
            line = &joined;
        }
        // A line may go on after a backslash; messages name the first of its lines.
        let result = read_line(line, first, &mut read, &mut state, contents);
        if let Some(cause) = result.map_err(|cause| refused(first, &cause))? {
            contents.warnings.add_at(first, "lines", &cause);
        }
    }
    if read.runs.is_empty() && contents.not_drawn.is_empty() {
        let hint = if is_wide {
            "it begins like text in UTF-16: save it as UTF-8"
        } else {
            "is it an OBJ? GLB, glTF, PLY and STL are read too"
        };
        let ending = contents.path.extension().map(|ending| ending.to_string_lossy());
        let ending = match ending.map(|ending| ending.to_ascii_lowercase()) {
            Some(ending) if ending != "obj" => {
                format!(", and its name ends in .{}", printable_short(&ending, 10))
            }
            _ => String::new(),
        };
        // Most such files are of another format.
        let what = "has no faces (lines that begin with 'f'), so there is nothing to draw";
        return Err(format!("{what}{ending}; {hint}").into());
    }
    // Some programs write bytes.
    let is_large = |colour: &DVec3| colour.is_finite() && colour.max_element() > 1.0;
    // From 0 to 1, whatever the program wrote.
    let colours = &mut read.vectors.colours;
    let scale = if colours.iter().any(is_large) { 1.0 / 255.0 } else { 1.0 };
    for colour in colours.iter_mut().filter(|colour| !colour.is_nan()) {
        let scaled = (*colour * scale).clamp(DVec3::ZERO, DVec3::ONE);
        *colour = if *colour == WITHOUT_COLOUR { DVec3::ONE } else { scaled };
    }
    Ok(read)
}

/// Reads one line, or says what of it is left out and why.
fn read_line(
    line: &[u8],
    number: usize,
    read: &mut Lines,
    state: &mut State,
    contents: &mut Contents,
) -> Result<Option<String>, String> {
    if let Some(colours) = line.strip_prefix(b"#MRGB") {
        let count = colours.iter().filter(|byte| byte.is_ascii_hexdigit()).count() / 8;
        contents.count(ZBRUSH_COLOUR, count as u64);
        return Ok(None);
    }
    let mut words = words(line);
    let Some(kind) = words.next() else { return Ok(None) };
    match kind {
        b"v" => return vector(&KINDS[0], words, number, read),
        b"vt" => return vector(&KINDS[1], words, number, read),
        b"vn" => return vector(&KINDS[2], words, number, read),
        b"f" | b"fo" => return face(words, number, read, state, contents),
        b"o" => {
            state.object = records::name(&rest(line, kind)).into();
            state.group = Arc::default();
            state.is_new = true;
        }
        b"g" => {
            state.group = records::name(&rest(line, kind)).into();
            state.is_new = true;
        }
        b"s" => {
            let word = words.next().unwrap_or(b"off");
            // Groups are numbers; some programs write `on`.
            let is_off = word.eq_ignore_ascii_case(b"off") || word.eq_ignore_ascii_case(b"null");
            state.smoothing = if is_off { 0 } else { index(word).map_or(1, |group| group as u32) };
        }
        b"usemtl" => {
            let name: Arc<str> = records::name(&rest(line, kind)).into();
            if state.material.as_ref().map(|(name, _)| name) != Some(&name) {
                state.material = Some((name, number));
                state.is_new = true;
            }
        }
        b"mtllib" => {
            let names = rest(line, kind);
            if !names.is_empty() && read.known.insert(names.clone()) {
                read.libraries.push(names);
            }
        }
        _ => {
            let word = String::from_utf8_lossy(kind).to_ascii_lowercase();
            // Some programs write capitals.
            if READ.contains(&&*word) {
                let line = [word.as_bytes(), &line[kind.len()..]].concat();
                return read_line(&line, number, read, state, contents);
            }
            if let Some((_, key)) = NOT_DRAWN.iter().find(|(name, _)| *name == word) {
                contents.count(key, 1);
            } else if !WITHOUT_EFFECT.contains(&&*word) {
                let what = format!("'{}' does not begin a line of an OBJ", short(kind));
                return Ok(Some(format!("{what}; the line is left out")));
            }
        }
    }
    Ok(None)
}

/// Reads a vector, and says what of it is done without. After the three coordinates of a position there may be a weight, which
/// polygons do not use, and a colour.
fn vector<'a>(
    kind: &VectorKind,
    words: impl Iterator<Item = &'a [u8]> + Clone,
    line: usize,
    read: &mut Lines,
) -> Result<Option<String>, String> {
    // A comma is read as a decimal point, which is said once for the line.
    let with_comma = words.clone().find(|word| memchr::memchr(b',', word).is_some());
    let values =
        numbers(words, kind).or_else(|cause| read.keep_broken(kind.number, line, cause))?;
    let Values { all, count, not_finite } = values;
    let vectors = &mut read.vectors;
    let vector = DVec3::from_slice(&all);
    // The vector is kept in any case, so that the numbers of those after it are right.
    let is_finite = match kind.number {
        0 => {
            let colour = match count {
                6 => Some(DVec3::from_slice(&all[3..])),
                7 => Some(DVec3::from_slice(&all[4..])),
                _ => None,
            };
            if let Some(colour) = colour {
                vectors.colours.resize(vectors.positions.len(), WITHOUT_COLOUR);
                vectors.colours.push(if colour.is_finite() { colour } else { DVec3::NAN });
            }
            vectors.positions.push(vector);
            vector.is_finite() && colour.is_none_or(DVec3::is_finite)
        }
        1 => {
            let uv = vector.truncate();
            vectors.uvs.push(if uv.is_finite() { uv } else { DVec2::ZERO });
            uv.is_finite()
        }
        _ => {
            vectors.normals.push(vector);
            not_finite.is_none()
        }
    };
    Ok(match not_finite {
        Some(word) if !is_finite => {
            Some(format!("'{word}' is not a finite number; {}", kind.not_finite))
        }
        // `keep_broken` has kept why, and the warning follows when all faces are known.
        _ if count == 0 => None,
        _ => with_comma.map(records::comma),
    })
}

/// The words of a line, up to a comment.
fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    let end = memchr::memchr_iter(b'#', line).find(|&at| !records::is_of_number(line, at));
    line[..end.unwrap_or(line.len())].split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A name that fills the rest of a line after its first word.
fn rest(line: &[u8], kind: &[u8]) -> String {
    let text = String::from_utf8_lossy(&line[kind.len()..]);
    without_comment(&text).trim().to_owned()
}

/// The numbers of a line that describes a vector, as far as they are used.
struct Values {
    /// Three coordinates, then perhaps a weight and a colour.
    all: [f64; 7],
    /// How many the line has.
    count: usize,
    /// The first word that is no finite number.
    not_finite: Option<String>,
}

/// Reads the numbers of a vector. An error where there are too few, or where a coordinate is too large.
fn numbers<'a>(words: impl Iterator<Item = &'a [u8]>, kind: &VectorKind) -> Result<Values, String> {
    let mut values = Values { all: [0.0; 7], count: 0, not_finite: None };
    for word in words {
        let value = records::expected_number(word)?;
        if !value.is_finite() && values.not_finite.is_none() {
            values.not_finite = Some(short(word));
        }
        if let Some(place) = values.all.get_mut(values.count) {
            *place = value;
        }
        values.count += 1;
    }
    if values.count < kind.least {
        return Err(format!("{} numbers where {} are needed", values.count, kind.least));
    }
    let position = DVec3::from_slice(&values.all);
    let far = position.abs().max_element();
    if kind.number == 0 && position.is_finite() && far > MOST_COORDINATE {
        return Err(format!("the coordinate {far:e} is larger than 1e38: scale the model down"));
    }
    Ok(values)
}

/// A whole number of at most ten digits, without a sign.
fn index(word: &[u8]) -> Option<u64> {
    if word.is_empty() || word.len() > 10 {
        return None;
    }
    let mut value = 0;
    for byte in word {
        if !byte.is_ascii_digit() {
            return None;
        }
        value = value * 10 + u64::from(byte - b'0');
    }
    Some(value)
}

/// Adds a face to the last run, or to a new one where its group or material is another.
fn face<'a>(
    words: impl Iterator<Item = &'a [u8]>,
    number: usize,
    read: &mut Lines,
    state: &mut State,
    contents: &mut Contents,
) -> Result<Option<String>, String> {
    if state.is_new {
        state.is_new = false;
        let name = if state.object.is_empty() { &state.group } else { &state.object };
        let (name, material) = (name.clone(), state.material.clone());
        read.runs.push(Run { name, material, part: FilePart::default() });
    }
    let counts = read.vectors.counts();
    let Some(Run { part, .. }) = read.runs.last_mut() else { return Ok(None) };
    let start = part.corners.len();
    for word in words {
        let [position, uv, normal] = face_corner(word, counts)?;
        part.push(position, [normal, uv, NONE]);
    }
    if part.end_polygon(start, number, state.smoothing) {
        return Ok(None);
    }
    contents.count(INCOMPLETE_FACE, 1);
    Ok(Some("a face needs three corners or more; the line is left out".to_owned()))
}

/// `position/texture/normal` as indices from 0; negative ones count back from here.
fn face_corner(word: &[u8], counts: [usize; 3]) -> Result<FaceCorner, String> {
    let mut corner = [NONE; 3];
    for (kind, part) in word.split(|&byte| byte == b'/').enumerate() {
        if kind > 2 {
            return Err(format!("'{}' has more than three parts", short(word)));
        }
        if part.is_empty() && kind > 0 {
            continue;
        }
        let (digits, is_back) = match part.split_first() {
            Some((b'-', digits)) => (digits, true),
            Some((b'+', digits)) => (digits, false),
            _ => (part, false),
        };
        // Some programs write all numbers with a fraction.
        let point = digits.iter().position(|&byte| byte == b'.').unwrap_or(digits.len());
        let (digits, fraction) = digits.split_at(point);
        let is_whole = fraction.iter().skip(1).all(|&byte| byte == b'0');
        let all_digits = !digits.is_empty() && digits.iter().all(u8::is_ascii_digit) && is_whole;
        if !all_digits {
            return Err(format!("'{}' is not a corner of a face", short(word)));
        }
        corner[kind] = from_0(index(digits), is_back, counts[kind]).unwrap_or(ABSENT);
    }
    Ok(corner)
}

/// The index from 0 of a number of the file, which counts from 1, or back from the end of what was read so far.
fn from_0(value: Option<u64>, is_back: bool, count: usize) -> Option<u32> {
    let value = usize::try_from(value?).ok()?;
    let value = if is_back { count.checked_sub(value) } else { value.checked_sub(1) }?;
    let is_there = value < ABSENT as usize && (!is_back || value < count);
    is_there.then_some(value as u32)
}

/// Looks whether what faces name is there. Takes away texture coordinates and normals that are not, and faces without all of their
/// positions. Faces may come before what they name, so this is done at the end.
fn check_faces(lines: &mut Lines, contents: &mut Contents) -> Result<(), Wrong> {
    let Lines { vectors, runs, broken, .. } = lines;
    let counts = vectors.counts();
    let Contents { warnings, .. } = contents;
    // Vectors that faces are drawn without, by kind and index.
    let mut used: HashSet<(usize, u32)> = HashSet::new();
    // Why the first face is left out, if one is, and how many are.
    let (mut refusal, mut all_left_out) = (None, 0);
    for Run { part, .. } in runs.iter_mut() {
        // Most files name nothing that is missing, so faces are looked at one by one only where something is.
        let are_there = Numbers::OfPositions.end(&part.corners) <= counts[0]
            && part.uvs.numbers.end(&part.corners) <= counts[1]
            && part.normals.numbers.end(&part.corners) <= counts[2];
        if are_there && broken.is_empty() {
            continue;
        }
        // Faces in ascending order.
        let mut left_out = Vec::new();
        for number in 0..part.polygons.len() {
            let of_face = part.polygons.line(number) as usize;
            let corners = part.polygons.corners(number);
            for &VectorKind { number: kind, name, .. } in &KINDS {
                let count = counts[kind];
                let numbers = match kind {
                    0 => &mut Numbers::OfPositions,
                    1 => &mut part.uvs.numbers,
                    _ => &mut part.normals.numbers,
                };
                let named = corners.clone().filter_map(|at| numbers.get(at, part.corners[at]));
                // All vectors of this kind that the face names; one that is wrong is enough.
                let named: Vec<u32> = named.collect();
                let is_wrong =
                    |index: &u32| *index as usize >= count || broken.contains_key(&(kind, *index));
                let Some(&index) = named.iter().find(|index| is_wrong(index)) else { continue };
                // Which line has to be repaired and why, and what is said of the face.
                // A vector that was broken is to be repaired where it is; one that is not there, where it is named.
                let (line, cause, of_vector) = match broken.get(&(kind, index)) {
                    Some((line, cause)) => {
                        (*line, cause.clone(), format!("the {name} of the face cannot be read"))
                    }
                    None => {
                        let cause = match index {
                            ABSENT => format!("a {name} that the face names is not there"),
                            _ => {
                                let index = u64::from(index) + 1;
                                format!("{name} {index} is not there; the file has {count}")
                            }
                        };
                        (of_face, cause.clone(), cause)
                    }
                };
                // Without a position there is no face; other vectors it can do without.
                let of_faces = match kind {
                    0 => "the face is left out".to_owned(),
                    _ => format!("the face is drawn without {name}s of the file"),
                };
                let text = format!("{of_vector}; {of_faces}");
                warnings.add_at(of_face, &format!("faces without their {name}s"), &text);
                used.extend(named.into_iter().map(|index| (kind, index)));
                if kind == 0 {
                    refusal.get_or_insert((line, cause));
                    left_out.push(number);
                    break;
                }
                numbers.remove(corners.clone(), &part.corners);
            }
        }
        all_left_out += left_out.len() as u64;
        if !left_out.is_empty() {
            part.retain(|_, number| left_out.binary_search(&number).is_err());
        }
    }
    // A file of which nothing is left is refused for the first of its mistakes.
    if let Some((line, cause)) = refusal
        && runs.iter().all(|run| run.part.polygons.len() == 0)
    {
        return Err(refused(line, &cause));
    }
    for (place @ (kind, _), (line, cause)) in &*broken {
        let what = match (used.contains(place), kind) {
            (true, 0) => "the faces that use it are left out",
            (true, _) => "the faces that use it are drawn without it",
            (false, _) => "no face uses it",
        };
        warnings.add_at(*line, "lines", &format!("{cause}; {what}"));
    }
    contents.count(WITHOUT_POSITION, all_left_out);
    Ok(())
}
