//! Vulkan devices under judgement.
//!
//! [`cells`] is what is drawn in a cell and read from it; [`engine`] answers the judge's questions with a device, [`plant`] spoils it on purpose;
//! [`specified`] is the picture that is expected and the bound of a value,
//! [`requirements`] what is asked besides the families, with `depth` and `lines`, each by a rule of
//! [`rules`]; [`known`] holds faults that are known, [`look`] draws one case, [`campaign`] judges and [`text`] says what came of it.

pub mod campaign;
pub mod cells;
pub mod choice;
mod depth;
pub mod engine;
pub mod known;
mod lines;
pub mod look;
pub mod outcome;
pub mod plant;
mod requirements;
pub mod specified;
pub mod text;
