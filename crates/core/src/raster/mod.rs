//! The two rasterizers, each on the lattice and, in a form of its own, off it. They are strangers to
//! each other: neither imports from the other, and what little arithmetic they have in common is
//! written twice, since agreement of shared code proves nothing.

pub mod edge_function;
pub mod edge_function_exact;
pub mod scanline;
pub mod scanline_exact;
