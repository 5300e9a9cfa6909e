//! Which format a file has, by its content.

/// A format of models that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ, with materials in MTL.
    Obj,
    /// Triangles in text or in records of 50 bytes.
    Stl,
}

/// How files of other formats begin.
const OTHERS: [(&[u8], &str); 10] = [
    (b"Kaydara FBX Binary", "FBX"),
    (b"; FBX", "FBX"),
    (b"BLENDER", "Blender"),
    (b"PK\x03\x04", "ZIP (3MF or USDZ)"),
    (b"#usda", "USD"),
    (b"PXR-USDC", "USD"),
    (b"glTF", "GLB"),
    (b"ply\n", "PLY"),
    (b"ply\r", "PLY"),
    (b"\x89PNG", "PNG"),
];

impl Format {
    /// The format of a file's bytes; the cause where it is known and not read. What nothing else is said of is an OBJ.
    pub(crate) fn of(bytes: &[u8]) -> Result<Self, String> {
        if crate::stl::is_binary(bytes) || crate::stl::is_text(bytes) {
            return Ok(Self::Stl);
        }
        match OTHERS.iter().find(|(magic, _)| bytes.starts_with(magic)) {
            Some((_, name)) => Err(format!(
                "this is a file of the format {name}, which is not read: export the model as OBJ or STL"
            )),
            None => Ok(Self::Obj),
        }
    }

    /// Its name, for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Stl => "STL",
        }
    }

    /// The axis that points up where the file does not say it.
    pub(crate) fn usual_up(self) -> crate::Up {
        match self {
            Self::Obj => crate::Up::Y,
            Self::Stl => crate::Up::Z,
        }
    }
}
