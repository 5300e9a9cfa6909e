//! Buffers and accessors: numbers out of bytes. Whatever the file says, nothing outside its bytes is read.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use rasterproof_host::text::printable_short;
use rasterproof_host::{input, limits};

use super::document::{Accessor, Compressed, Root, entry};
use super::meshopt;
use crate::outside;
use crate::records::Kind;
use crate::textures::find;

/// Elements of an accessor without bytes, which are zeros.
const MOST_ZEROS: usize = 1 << 24;

/// The type that a file names by its number in OpenGL; nothing where glTF has no such type.
fn kind_of(number: u64) -> Option<Kind> {
    let kinds = [Kind::I8, Kind::U8, Kind::I16, Kind::U16, Kind::I32, Kind::U32, Kind::F32];
    let kind = kinds.get(usize::try_from(number.checked_sub(5120)?).ok()?).copied();
    kind.filter(|kind| *kind != Kind::I32)
}

/// How many numbers an element of this type has; nothing where glTF has no such type.
fn width_of(form: &str) -> Option<usize> {
    Some(match form {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => return None,
    })
}

/// A document with the bytes that it names.
pub(super) struct Data<'a> {
    pub root: Root,
    /// Where the files are that it names.
    pub folder: PathBuf,
    /// Those of different names.
    buffers: Vec<Cow<'a, [u8]>>,
    /// For each buffer of the document its number among them.
    numbers: Vec<usize>,
    /// The views that were compressed, by their numbers.
    decoded: HashMap<usize, Vec<u8>>,
}

/// The elements of an accessor, one after the other.
struct Column<'a> {
    /// From the first element on; nothing where all are zeros.
    bytes: Option<&'a [u8]>,
    count: usize,
    /// From one element to the next, in bytes.
    stride: usize,
    /// How many numbers an element has; a reader may take the first of them alone.
    width: usize,
    kind: Kind,
    /// Whether whole numbers stand for numbers from 0 or -1 to 1.
    normalized: bool,
}

impl<'a> Data<'a> {
    /// Reads the buffers of a document; `bin` is the second chunk of a GLB.
    pub(super) fn new(root: Root, folder: PathBuf, bin: Option<&'a [u8]>) -> Result<Self, String> {
        let mut buffers: Vec<Cow<'_, [u8]>> = Vec::new();
        // By its name the number of a buffer among those that were read.
        let mut read: HashMap<&str, usize> = HashMap::new();
        let mut numbers = Vec::new();
        // All buffers together have a limit, not each of them.
        let mut left_bytes = limits::MODEL_BYTES;
        for (number, buffer) in root.buffers.iter().enumerate() {
            // A file that several buffers name is read once.
            let known = buffer.uri.as_deref().and_then(|uri| read.get(uri)).copied();
            numbers.push(known.unwrap_or(buffers.len()));
            let bytes = match (&buffer.uri, bin) {
                (Some(_), _) if known.is_some() => continue,
                (Some(uri), _) => {
                    let failed = |cause| format!("buffers[{number}]: {cause}");
                    let bytes = resource(&folder, uri, left_bytes).map_err(failed)?;
                    left_bytes = left_bytes.saturating_sub(bytes.len() as u64);
                    read.insert(uri, buffers.len());
                    Cow::Owned(bytes)
                }
                (None, Some(bin)) => Cow::Borrowed(bin),
                // A buffer of a compression may be a place to decode to.
                (None, None) => Cow::Borrowed(&[][..]),
            };
            buffers.push(bytes);
        }
        let mut data = Self { root, folder, buffers, numbers, decoded: HashMap::new() };
        data.decode()?;
        Ok(data)
    }

    /// Decodes the views that are compressed.
    fn decode(&mut self) -> Result<(), String> {
        let per_byte = limits::MODEL_CONTENTS_BYTES_PER_BYTE.saturating_mul(self.len());
        let mut left_bytes = limits::MODEL_CONTENTS_BYTES.max(per_byte) as usize;
        let mut decoded = HashMap::new();
        for (number, view) in self.root.buffer_views.iter().enumerate() {
            let Some(compressed) = &view.extensions.compressed else { continue };
            let Compressed { buffer, byte_offset, byte_length, .. } = *compressed;
            let failed = |cause: String| format!("bufferViews[{number}]: {cause}");
            let bytes = self.bytes(number, buffer, byte_offset, byte_length)?;
            let bytes = meshopt::decode(compressed, bytes, left_bytes).map_err(failed)?;
            left_bytes = left_bytes.saturating_sub(bytes.len());
            decoded.insert(number, bytes);
        }
        self.decoded = decoded;
        Ok(())
    }

    /// The bytes of all buffers.
    pub(super) fn len(&self) -> u64 {
        self.buffers.iter().map(|bytes| bytes.len() as u64).sum()
    }

    /// How many elements an accessor has; none where it cannot be read, which is said when it is.
    pub(super) fn count(&self, number: usize) -> u64 {
        self.column(number).map_or(0, |column| column.count as u64)
    }

    /// Whether some of the bytes are those of a file outside the folder of the model.
    pub(super) fn has_outside_buffer(&self) -> bool {
        let mut uris = self.root.buffers.iter().filter_map(|buffer| buffer.uri.as_deref());
        uris.any(|uri| self.is_outside(uri))
    }

    /// Whether a URI names a file outside the folder of the model, so that no message may quote it.
    pub(super) fn is_outside(&self, uri: &str) -> bool {
        let file = if data_of(uri).is_none() { file_of(&self.folder, uri) } else { None };
        file.is_some_and(|file| outside::is_outside(&self.folder, &file))
    }

    /// The bytes of a buffer view, and the distance of its elements where it has one.
    pub(super) fn view(&self, number: usize) -> Result<(&[u8], Option<usize>), String> {
        let view = entry(&self.root.buffer_views, "bufferViews", number)?;
        let bytes = match self.decoded.get(&number) {
            Some(bytes) => bytes,
            None => self.bytes(number, view.buffer, view.byte_offset, view.byte_length)?,
        };
        Ok((bytes, view.byte_stride))
    }

    /// Bytes of a buffer, for a view of this number.
    fn bytes(
        &self,
        number: usize,
        buffer: usize,
        start: u64,
        length: u64,
    ) -> Result<&[u8], String> {
        let all = &self.buffers[*entry(&self.numbers, "buffers", buffer)?];
        let bytes = start
            .checked_add(length)
            .and_then(|end| all.get(usize::try_from(start).ok()?..usize::try_from(end).ok()?));
        bytes.ok_or_else(|| {
            format!(
                "bufferViews[{number}] has {} bytes from byte {start} on, and buffers[{buffer}] has {}: the buffer is cut off",
                length,
                all.len()
            )
        })
    }

    fn accessor(&self, number: usize) -> Result<&Accessor, String> {
        entry(&self.root.accessors, "accessors", number)
    }

    /// Where the numbers of an accessor are, all of which lie in its buffer view.
    fn column(&self, number: usize) -> Result<Column<'_>, String> {
        let accessor = self.accessor(number)?;
        let failed = |cause: &str| format!("accessors[{number}]: {cause}");
        let kind = kind_of(accessor.component_type)
            .ok_or_else(|| failed("the component type is not one of glTF"))?;
        let width =
            width_of(&accessor.form).ok_or_else(|| failed("the type is not one of glTF"))?;
        let count = usize::try_from(accessor.count).unwrap_or(usize::MAX);
        let (size, normalized) = (width * kind.size(), accessor.normalized);
        let zeros = Column { bytes: None, count, stride: size, width, kind, normalized };
        let Some(view) = accessor.buffer_view else {
            return if count > MOST_ZEROS { Err(failed("has no bytes")) } else { Ok(zeros) };
        };
        let (all, stride) = self.view(view)?;
        let stride = stride.filter(|&stride| stride > 0).unwrap_or(size);
        // Nothing has to follow the last element.
        // The last element begins a stride before the end, or less.
        let needed = match count.checked_sub(1) {
            None => Some(0),
            Some(last) => last.checked_mul(stride).and_then(|start| start.checked_add(size)),
        };
        let from = usize::try_from(accessor.byte_offset).ok().and_then(|offset| all.get(offset..));
        match from.filter(|from| needed.is_some_and(|needed| needed <= from.len())) {
            Some(bytes) => Ok(Column { bytes: Some(bytes), stride, ..zeros }),
            None => Err(failed(&format!(
                "{count} elements of {size} bytes do not fit into the {} bytes of its buffer view",
                all.len()
            ))),
        }
    }

    /// The elements of an accessor as numbers, each cut to N of them.
    pub(super) fn vectors<const N: usize>(&self, number: usize) -> Result<Vec<[f64; N]>, String> {
        let column = self.column(number)?;
        if column.width < N {
            let width = column.width;
            return Err(format!("accessors[{number}] has {width} numbers where {N} are needed"));
        }
        let mut vectors = column.read::<N>();
        // A sparse accessor replaces some of its elements, whose numbers and values have views of their own.
        let Some(sparse) = &self.accessor(number)?.sparse else { return Ok(vectors) };
        let failed = |cause: &str| format!("accessors[{number}].sparse: {cause}");
        let kind = kind_of(sparse.indices.component_type);
        let of_indices = [Kind::U8, Kind::U16, Kind::U32];
        let Some(kind) = kind.filter(|kind| of_indices.contains(kind)) else {
            return Err(failed("the component type of the indices is not one of glTF"));
        };
        // As many numbers of elements as values for them.
        let count = usize::try_from(sparse.count).unwrap_or(usize::MAX);
        let size = column.width * column.kind.size();
        let part = |view: usize, offset: u64, size: usize| {
            let (bytes, _) = self.view(view)?;
            let bytes = usize::try_from(offset).ok().and_then(|offset| bytes.get(offset..));
            let bytes = bytes.filter(|bytes| bytes.len() / size >= count);
            let bytes = bytes.ok_or_else(|| failed("its bytes do not fit into the buffer view"))?;
            Ok::<_, String>(bytes)
        };
        let indices = &sparse.indices;
        let stride = kind.size();
        let bytes = part(indices.buffer_view, indices.byte_offset, stride)?;
        let (width, normalized) = (1, false);
        let indices = Column { bytes: Some(bytes), count, stride, width, kind, normalized };
        let values = &sparse.values;
        let bytes = part(values.buffer_view, values.byte_offset, size)?;
        let values = Column { bytes: Some(bytes), stride: size, count, ..column };
        for ([index], value) in indices.read::<1>().into_iter().zip(values.read::<N>()) {
            let place = vectors.get_mut(index as usize);
            *place.ok_or_else(|| failed("an index is out of range"))? = value;
        }
        Ok(vectors)
    }

    /// Numbers that were decoded elsewhere, in the range that the accessor gives them.
    pub(super) fn normalized<const N: usize>(
        &self,
        number: usize,
        mut vectors: Vec<[f64; N]>,
    ) -> Result<Vec<[f64; N]>, String> {
        let accessor = self.accessor(number)?;
        if let (Some(kind), true) = (kind_of(accessor.component_type), accessor.normalized) {
            for value in vectors.as_flattened_mut() {
                *value = (*value / most(kind)).max(-1.0);
            }
        }
        Ok(vectors)
    }

    /// The elements of an accessor of whole numbers.
    pub(super) fn indices(&self, number: usize) -> Result<Vec<u32>, String> {
        let accessor = self.accessor(number)?;
        let column = self.column(number)?;
        if column.kind == Kind::F32 || column.width != 1 {
            return Err(format!("accessors[{number}] holds no indices"));
        }
        let Some(bytes) = column.bytes.filter(|_| accessor.sparse.is_none()) else {
            let read = self.vectors::<1>(number)?;
            return Ok(read.into_iter().map(|[index]| index as u32).collect());
        };
        // Usual indices are read without a detour over doubles.
        // No index is below 0, whatever the file says.
        let kind = match column.kind {
            Kind::I8 => Kind::U8,
            Kind::I16 => Kind::U16,
            kind => kind,
        };
        let mut indices = Vec::with_capacity(column.count);
        for at in 0..column.count {
            indices.push(kind.number(&bytes[at * column.stride..], false) as u32);
        }
        Ok(indices)
    }
}

impl Column<'_> {
    /// The first N numbers of each element.
    fn read<const N: usize>(&self) -> Vec<[f64; N]> {
        let Some(bytes) = self.bytes else { return vec![[0.0; N]; self.count] };
        if self.kind == Kind::F32 && self.stride == 4 * N && self.count > 0 {
            let number = |bytes: [u8; 4]| f64::from(f32::from_le_bytes(bytes));
            let words = bytes.as_chunks::<4>().0.as_chunks::<N>().0;
            return words[..self.count].iter().map(|element| element.map(number)).collect();
        }
        let size = self.kind.size();
        let mut read = Vec::with_capacity(self.count);
        for number in 0..self.count {
            let element = &bytes[number * self.stride..];
            read.push(std::array::from_fn(|at| self.number(&element[at * size..])));
        }
        read
    }

    /// The number at the beginning of these bytes. Normalized ones are in [-1, 1].
    #[inline]
    fn number(&self, bytes: &[u8]) -> f64 {
        let value = self.kind.number(bytes, false);
        if self.normalized { (value / most(self.kind)).max(-1.0) } else { value }
    }
}

/// The largest number of a kind, which stands for 1 where numbers are normalized.
fn most(kind: Kind) -> f64 {
    match kind {
        Kind::I8 => f64::from(i8::MAX),
        Kind::U8 => f64::from(u8::MAX),
        Kind::I16 => f64::from(i16::MAX),
        Kind::U16 => f64::from(u16::MAX),
        Kind::U32 => f64::from(u32::MAX),
        _ => 1.0,
    }
}

/// The bytes that a URI names: those within a `data:` address, or of a file beside the model.
pub(super) fn resource(folder: &Path, uri: &str, limit_bytes: u64) -> Result<Vec<u8>, String> {
    if let Some(data) = data_of(uri) {
        let Some((head, data)) = data.split_once(',') else {
            return Err("a 'data:' address without a comma".to_owned());
        };
        let data = unescaped(data);
        // It is the last parameter, but not for all programs.
        if !head.split(';').skip(1).any(|word| word.trim().eq_ignore_ascii_case("base64")) {
            return Ok(data);
        }
        let config = GeneralPurposeConfig::new()
            .with_decode_padding_mode(DecodePaddingMode::Indifferent)
            .with_decode_allow_trailing_bits(true);
        let engine = GeneralPurpose::new(&base64::alphabet::STANDARD, config);
        // Some programs break the lines, and some write the alphabet of addresses.
        let mut usual = Vec::with_capacity(data.len());
        for byte in data {
            match byte {
                b'-' => usual.push(b'+'),
                b'_' => usual.push(b'/'),
                _ if byte.is_ascii_whitespace() => {}
                _ => usual.push(byte),
            }
        }
        return engine.decode(usual).map_err(|error| format!("is not base64: {error}"));
    }
    let shown = printable_short(uri, 60);
    if uri.contains("://") && !uri.starts_with("file:") {
        return Err(format!("'{shown}' is no file: save it beside the model and name it there"));
    }
    let Some(file) = file_of(folder, uri) else {
        return Err(format!("there is no file '{shown}' beside the model: put it there"));
    };
    input::read(&file, limit_bytes).map_err(|error| error.to_string())
}

/// What follows `data:` in an address that contains its bytes.
fn data_of(uri: &str) -> Option<&str> {
    let (scheme, data) = uri.trim().split_once(':')?;
    scheme.eq_ignore_ascii_case("data").then_some(data)
}

/// The file that a URI names.
fn file_of(folder: &Path, uri: &str) -> Option<PathBuf> {
    let plain = String::from_utf8_lossy(&unescaped(uri)).into_owned();
    // What follows these signs is for servers.
    let name = plain.split(['?', '#']).next().unwrap_or_default();
    find(folder, &plain).or_else(|| find(folder, uri)).or_else(|| find(folder, name))
}

/// Text in which `%20` stands for a space.
fn unescaped(text: &str) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut left = text.as_bytes();
    while let Some((&byte, rest)) = left.split_first() {
        let digits = rest.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
        let escaped = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        match escaped.filter(|_| byte == b'%') {
            Some(escaped) => {
                bytes.push(escaped);
                left = &rest[2..];
            }
            None => {
                bytes.push(byte);
                left = rest;
            }
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_of_numbers_are_those_of_opengl() {
        let read = |number| {
            let (bytes, count, stride, width) = (Some(&[0xfe, 0xff, 0x7f, 0x3f][..]), 1, 4, 1);
            let kind = kind_of(number)?;
            let column = Column { bytes, count, stride, width, kind, normalized: false };
            Some(column.read::<1>()[0][0])
        };
        let whole = [-2.0, 254.0, -2.0, 65_534.0, f64::from(0x3f7f_fffe_u32)];
        assert_eq!([5120, 5121, 5122, 5123, 5125].map(read), whole.map(Some));
        assert_eq!(read(5126), Some(f64::from(f32::from_bits(0x3f7f_fffe))));
        assert_eq!(read(5124), None);
    }

    #[test]
    fn resources_are_found_in_the_address_itself() {
        let read = |uri| resource(Path::new("."), uri, 100);
        assert_eq!(read("data:;base64,AAECAw==").unwrap(), [0, 1, 2, 3]);
        assert_eq!(read("data:;base64,AAECAw").unwrap(), [0, 1, 2, 3]);
        assert_eq!(read("data:,a%20b%2").unwrap(), b"a b%2");
        assert!(read("data:;base64,A*").unwrap_err().contains("not base64"));
        assert!(read("https://a.b/c.bin").unwrap_err().contains("is no file"));
        assert!(read("a%20none.bin").unwrap_err().contains("there is no file"));
    }
}
