//! Verdicts as text, JSON, pictures and a page. Everything here is a value; only `main` prints.

pub mod ascii;
pub mod board;
pub mod cases;
pub mod chapter;
pub mod chart;
pub mod counts;
pub mod diagram;
pub mod exact;
pub mod formats;
pub mod frames;
pub mod html;
pub mod json;
pub mod judged;
pub mod league;
pub mod lettering;
pub mod panels;
pub mod phrases;
pub mod picture;
pub mod plot;
pub mod sheet;
pub mod specimens;
pub mod summary;
pub mod table;
