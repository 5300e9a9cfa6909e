//! Rasterizers that are wrong: algorithms as they were [`published`], and faults [`planted`] in right code, which
//! show that every check can fail.

pub mod planted;
pub mod published;
