//! Reads models from files and turns them into items of a scene. Nothing here draws.

#[allow(dead_code, reason = "the readers are being moved to it")]
mod contents;
mod mtl;
pub mod obj;
