//! Which format a file has, by its content.

use std::path::Path;

use crate::{gltf, ply, stl};

/// The formats that are read. A file has one by its content, whatever its name ends in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ, with materials in MTL.
    Obj,
    /// Triangles in text or in records of 50 bytes.
    Stl,
    /// Elements of numbers, in text or in binary.
    Ply,
    /// A document of JSON with its buffers.
    Gltf,
    /// glTF with its buffers in the same file.
    Glb,
}

/// How files of other formats begin, where they begin with bytes that no text has.
const OTHERS: [(&[u8], &str); 39] = [
    (b"Kaydara FBX Binary", "FBX"),
    (b"; FBX", "FBX"),
    (b"BLENDER", "Blender"),
    (b"PK\x03\x04", "ZIP, as 3MF, USDZ and ZAE are"),
    (b"#usda", "USD"),
    (b"PXR-USDC", "USD"),
    (b"\xd0\xcf\x11\xe0", "3ds Max or another program of OLE files"),
    (b"AC3D", "AC3D"),
    (b"BB3D", "Blitz3D"),
    (b"HIERARCHY", "BVH, which holds motion"),
    (b"Caligari", "COB (trueSpace)"),
    (b"#VRML", "VRML"),
    (b"xof ", "X (DirectX)"),
    (b"ISO-10303-21", "STEP or IFC"),
    (b"INTERQUAKEMODEL", "IQM"),
    (b"LWSC", "LightWave scene"),
    (b"MS3D000000", "MS3D (MilkShape)"),
    (b"IDP2", "MD2"),
    (b"IDP3", "MD3"),
    (b"IDPO", "MDL"),
    (b"IDPC", "MDC"),
    (b"IDST", "MDL"),
    (b"MDL", "MDL"),
    (b"HMP", "HMP (terrain)"),
    (b"MD5Version", "MD5"),
    (b"quick3Do", "Quick3D"),
    (b"quick3Ds", "Quick3D"),
    (b"3DMO", "M3D"),
    (b"3dmodel", "M3D"),
    (b"TERRAGEN", "Terragen"),
    (b"HEAD\x04\0\0\0", "SIB (Silo)"),
    (b"#!WINGS", "Wings 3D"),
    (b"Version 8.", "JT"),
    (b"Version 9.", "JT"),
    (b"nendo", "NDO (Nendo)"),
    (b"$Filename", "CSM, which holds motion"),
    (b"\x89PNG", "PNG"),
    (b"\xff\xd8\xff", "JPEG"),
    (b"\x1f\x8b", "GZIP, so it has to be unpacked first"),
];

/// How texts of other formats begin, in small letters, after spaces.
const TEXTS: [(&str, &str); 13] = [
    ("*3dsmax_asciiexport", "ASE (3ds Max)"),
    ("version 1\n", "SMD (Source engine)"),
    ("version 1\r\n", "SMD (Source engine)"),
    ("0\nsection", "DXF"),
    ("0\r\nsection", "DXF"),
    ("geometryobject", "OpenGEX"),
    ("geometrynode", "OpenGEX"),
    ("lightobject", "OpenGEX"),
    ("metric (", "OpenGEX"),
    ("metric(", "OpenGEX"),
    ("class ", "UC (Unreal)"),
    ("nff", "NFF"),
    ("newmtl", "MTL, which holds the materials of an OBJ"),
];

/// Words of the first kilobyte of XML, in small letters, and what contains them.
const XML: [(&str, &str); 6] = [
    ("<collada", "COLLADA"),
    ("<amf", "AMF"),
    ("<x3d", "X3D"),
    ("irrlicht", "Irrlicht"),
    ("<mesh", "OGRE"),
    ("<world", "XGL"),
];

/// The beginnings of an OFF, whose vertices may have more than a position.
const OFF: [&str; 5] = ["off", "coff", "noff", "cnoff", "stoff"];

impl Format {
    /// The format of a file of this length by its first bytes; the cause where it is known and not read. What nothing else is said of is
    /// an OBJ, but for an STL in records whose length is not that of its triangles.
    pub(crate) fn of(path: &Path, bytes: &[u8], length: u64) -> Result<Self, String> {
        if bytes.trim_ascii().is_empty() && bytes.len() as u64 >= length {
            return Err("is empty".to_owned());
        }
        // A binary STL may begin with anything, and its length is that of its triangles.
        if stl::is_binary(bytes, length) || stl::is_text(bytes) {
            return Ok(Self::Stl);
        }
        if ply::is_ply(bytes) {
            return Ok(Self::Ply);
        }
        if gltf::is_glb(bytes) {
            return Ok(Self::Glb);
        }
        let refused = |name: &str| {
            Err(format!(
                "this is a file of the format {name}, which is not read: export the model as GLB, glTF, OBJ, PLY or STL"
            ))
        };
        // Formats that begin with bytes of their own.
        let begins = |magic: &[u8]| bytes.starts_with(magic);
        if let Some((_, name)) = OTHERS.iter().find(|(magic, _)| begins(magic)) {
            return refused(name);
        }
        // 3DS begins with its length, IFF with the length of its content.
        if begins(b"MM") && bytes.get(2..6).is_some_and(|size| is_length(size, length)) {
            return refused("3DS");
        }
        if begins(b"FORM") {
            return refused("LightWave or Modo (LWO, LXO)");
        }
        // The others are texts, which may begin with spaces and have small or large letters.
        let head = head(bytes).to_ascii_lowercase();
        let text = head.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}');
        if let Some(rest) = text.strip_prefix('{') {
            // Files of Poser begin as JSON does.
            return match rest.trim_start().chars().next() {
                Some('"' | '}') | None => Ok(Self::Gltf),
                Some(_) => refused("Poser"),
            };
        }
        if text.starts_with('<') {
            let of = XML.iter().find(|(word, _)| text.contains(word));
            return refused(of.map_or("XML", |(_, name)| name));
        }
        if OFF.contains(&text.split_ascii_whitespace().next().unwrap_or_default()) {
            return refused("OFF");
        }
        match TEXTS.iter().find(|(start, _)| text.starts_with(start)) {
            Some((_, name)) => refused(name),
            None if stl::begins_binary(path, bytes) => Ok(Self::Stl),
            None => Ok(Self::Obj),
        }
    }

    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Ply => "PLY",
            Self::Gltf => "glTF",
            Self::Glb => "GLB",
        }
    }

    /// Whether the format says which axis points up.
    #[must_use]
    pub fn says_up(self) -> bool {
        matches!(self, Self::Gltf | Self::Glb)
    }

    /// The axis that points up where the file does not say it.
    pub(crate) fn usual_up(self) -> crate::Up {
        match self {
            Self::Obj | Self::Ply | Self::Gltf | Self::Glb => crate::Up::Y,
            Self::Stl => crate::Up::Z,
        }
    }
}

/// The first kilobyte as text, of either byte order where a mark says that it is UTF-16.
fn head(bytes: &[u8]) -> String {
    let head = &bytes[..bytes.len().min(1 << 10)];
    let wide = |of: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = head.as_chunks::<2>().0.iter().map(|&pair| of(pair)).collect();
        String::from_utf16_lossy(&units)
    };
    match head {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => String::from_utf8_lossy(head).into_owned(),
    }
}

/// Whether four bytes, read as a little-endian integer, are this length.
fn is_length(bytes: &[u8], length: u64) -> bool {
    <[u8; 4]>::try_from(bytes).is_ok_and(|size| u64::from(u32::from_le_bytes(size)) == length)
}
