//! Judges rasterizers and line drawers: the exact [`oracle`], families of hard [`cases`], and the [`comparison`],
//! which counts wrong pixels, checks values against derived tolerances, and shrinks a failing case.

#![warn(missing_docs)]

pub mod cases;
pub mod comparison;
pub mod oracle;
#[doc(hidden)]
pub mod source_text;
