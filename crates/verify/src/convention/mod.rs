//! Recognises the convention of an outside rasterizer or line drawer from its answers alone.
//!
//! Most programs differ by convention, not by fault. A hypothesis is a pure function from corners to
//! pixels ([`TriangleConvention`]); hypotheses are tried from the general to the particular: which windings
//! draw, where in a pixel the sample lies, on which grid the corners, which shape, and then who owns
//! a sample exactly on an edge. Questions are chosen by what is in doubt: an edge is moved until a
//! pixel flips, triangles are looked for on which two hypotheses differ, ties are constructed for
//! the point and grid that were found. What no hypothesis explains is called unexplained.
//!
//! Nothing here starts a process: a search that asks is a value ([`crate::ask`]). Source of the hypotheses: what
//! some forty rasterizers drew (`docs/conventions.md`).

mod area_coverage;
mod bench;
mod candidate;
mod declare;
mod describe;
mod diagnosis;
mod disambiguate;
mod fit;
mod general;
mod half_planes;
mod joined;
mod lines;
mod mask;
mod mirror;
mod outline;
mod place;
mod quantum;
mod rule;
mod samples;
mod scan;
mod search;
mod shape;
mod stepped;
mod ties;
mod upright;

/// The fill rules that mistakes are looked for with.
pub const RULES: [&str; 6] =
    ["top-left", "inclusive", "strict", "bottom-right", "top-right", "bottom-left"];

pub use bench::{Declarations, TriangleAsker, TriangleQuestion};
pub use diagnosis::{Agreement, Confidence, Diagnosis, Share, diagnose};
pub(crate) use half_planes::facing;
pub use lines::{
    Ends, LineAsker, LineConvention, LineDiagnosis, LineQuestion, LineRounding, Steps,
    diagnose_lines,
};
pub(crate) use mask::Mask;
pub use mirror::Mirror;
pub use outline::{End, LineTie};
pub use place::FACINGS;
pub use quantum::{Quantum, Rounding};
pub use rule::{CornerRule, Ties, TriangleConvention, Windings};
pub use samples::Pattern;
pub use scan::Scan;
pub use shape::Shape;
pub use ties::{Compass, Count};
