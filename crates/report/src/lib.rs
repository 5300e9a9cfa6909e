//! A report, and what writes it: text, JSON, pictures and a page. What is said of verdicts is here too. Everything is a value, and
//! only `main` prints.

pub mod canvas;
pub mod chapter;
pub mod designs;
pub mod differential;
pub mod drawn;
pub mod formats;
pub mod frame_comparison;
pub mod hosted;
pub mod html;
pub mod json;
pub mod judge_text;
pub mod league;
pub mod lettering;
pub mod page_cases;
pub mod panels;
pub mod phrases;
pub mod picture;
pub mod summary;
pub mod table;
pub mod text;
pub mod words;
pub mod written_test;
