//! The two rasterizers. They are strangers to each other: neither imports from the other, and what
//! little arithmetic they have in common is written twice, since agreement of shared code proves
//! nothing.

pub mod edge_function;
pub mod scanline;
