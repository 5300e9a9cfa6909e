//! The text of the files whose code a certificate names, for the crate `rasterproof-exhaustive`.

/// `coverage.rs`.
pub const COVERAGE: &str = include_str!("coverage.rs");
/// `pixels.rs`.
pub const PIXELS: &str = include_str!("pixels.rs");
