//! The border between rasterproof and the machine it runs on. This crate is the one place that
//! opens a file ([`input`]), writes a file whole and over none of the user's ([`output`]), shows text that other people wrote
//! ([`text`]), quotes a command that a reader may copy ([`shell`]), and states the limits of size
//! and time ([`limits`]).
//!
//! `clippy.toml` refuses the functions of the standard library that do the same, so that no other
//! crate can open or write a file by itself.
#![forbid(unsafe_code)]

pub mod error;
pub mod identity;
pub mod input;
pub mod limits;
mod mark;
pub mod output;
pub mod shell;
#[cfg(test)]
mod testing;
pub mod text;
