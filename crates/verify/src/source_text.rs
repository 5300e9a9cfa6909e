//! The text of the files whose code a certificate names, for the crate `rasterproof-exhaustive`.

/// `oracle/coverage.rs`.
pub const ORACLE_COVERAGE: &str = include_str!("oracle/coverage.rs");
/// `oracle/pixels.rs`.
pub const ORACLE_PIXELS: &str = include_str!("oracle/pixels.rs");
