//! Verdicts as text, JSON and pictures. Everything here is a value; only `main` prints.

pub mod ascii;
pub mod exact;
pub mod frames;
pub mod json;
pub mod lettering;
pub mod picture;
pub mod sheet;
pub mod specimens;
pub mod table;
