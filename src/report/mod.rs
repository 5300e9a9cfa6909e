//! Verdicts as text, JSON, pictures and a page. Everything here is a value; only `main` prints.

pub mod ascii;
pub mod cases;
pub mod counts;
pub mod exact;
pub mod frames;
pub mod html;
pub mod json;
pub mod lettering;
pub mod picture;
pub mod sheet;
pub mod specimens;
pub mod table;
