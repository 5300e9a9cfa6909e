//! Reads models from files and turns them into items of a scene. Nothing here draws.

mod mtl;
pub mod obj;
