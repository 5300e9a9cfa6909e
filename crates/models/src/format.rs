//! Which format a file has, by its content.

/// A format of models that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ, with materials in MTL.
    Obj,
}

impl Format {
    /// The format of a file's bytes.
    pub(crate) fn of(_bytes: &[u8]) -> Self {
        Self::Obj
    }

    /// Its name, for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
        }
    }

    /// The axis that points up where the file does not say it.
    pub(crate) fn usual_up(self) -> crate::Up {
        match self {
            Self::Obj => crate::Up::Y,
        }
    }
}
