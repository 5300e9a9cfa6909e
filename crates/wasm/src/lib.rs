//! What the WebAssembly module answers: the questions of the playground, the live figures of the pages, and the
//! judgement of a browser's GPU. See `docs/playground.md`.
#![deny(unsafe_code)]

pub mod answer;
pub mod figures;
mod gpu;
pub mod no_answer;
pub mod question;
#[cfg(target_family = "wasm")]
pub mod wasm_exports;
