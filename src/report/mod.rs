//! Verdicts as text, JSON and pictures. Everything here is a value; only `main` prints.

pub mod ascii;
pub mod board;
pub mod chart;
pub mod exact;
pub mod json;
pub mod lettering;
pub mod picture;
pub mod plot;
pub mod specimens;
pub mod table;
