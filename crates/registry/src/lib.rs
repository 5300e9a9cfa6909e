//! The only crate that names every engine: [`engines`] turns a name of the command line into a rasterizer or line
//! drawer. What needs that list is here too: the comparison of the engines, the check of the published algorithms,
//! samples that are undecided, the fixtures for other test suites, and the digest.

pub mod comparison;
#[cfg(feature = "host")]
pub mod digest;
pub mod engines;
#[cfg(feature = "host")]
pub mod fixtures;
pub mod named;
#[cfg(feature = "host")]
pub mod published_check;
#[cfg(feature = "host")]
pub mod undecided;
mod variants;
