//! The playground of rasterproof: what its page asks, the answers, and the page itself; see
//! `docs/playground.md`.
#![deny(unsafe_code)]

pub mod answer;
pub mod figures;
mod gpu;
pub mod page;
#[cfg(target_family = "wasm")]
pub mod wasm_exports;
