//! What the specification says, in short, and how an answer stands to it.
//!
//! Sections are those of the chapters "Rasterization" and "Fixed-Function Vertex Post-Processing" and
//! of the appendix "Invariance" of the Vulkan specification.

/// How what was drawn stands to the specification and to the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Class {
    /// What the oracle says, to the pixel; of values, within the derived bound.
    Equal,
    /// Something else, but nothing that the specification forbids.
    Allowed,
    /// Outside the specification, as the baseline of known faults says.
    Known,
    /// The device does not offer it.
    NotOffered,
    /// Fixed: the baseline names a fault that no case shows any more.
    Stale,
    /// Outside the specification.
    Outside,
    /// The device gave no answer.
    NoAnswer,
}

impl Class {
    /// Whether nothing is to be done.
    #[must_use]
    pub fn is_good(self) -> bool {
        self <= Self::NotOffered
    }

    /// It in a few words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Equal => "equal",
            Self::Allowed => "allowed, but different",
            Self::Known => "known fault",
            Self::NotOffered => "not offered",
            Self::Stale => "no longer wrong",
            Self::Outside => "OUTSIDE THE SPECIFICATION",
            Self::NoAnswer => "NO ANSWER",
        }
    }
}

/// A part of the specification by which something is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Rule {
    /// The section.
    pub section: &'static str,
    /// What it asks for, in short.
    pub says: &'static str,
    /// What it leaves open.
    pub open: &'static str,
}

/// Triangles.
pub const POLYGONS: Rule = Rule {
    section: "Basic Polygon Rasterization",
    says: "a sample inside belongs to the triangle; one on an edge that two share, to exactly one",
    open: "which of the two: the oracle takes the one whose top or left edge it is",
};
/// Four samples a pixel.
pub const SAMPLES: Rule = Rule {
    section: "Multisampling",
    says: "each sample is asked for itself, four at (6, 2) (14, 6) (2, 10) (10, 14) / 16 px where the \
           device says standardSampleLocations",
    open: "samples on edges, as with one sample",
};
/// Values.
pub const PERSPECTIVE: Rule = Rule {
    section: "Basic Polygon Rasterization",
    says: "attributes are weighed by barycentric coordinates over w, depth by them alone",
    open: "how exactly: the bound is derived from roundings in f32",
};
/// Values without perspective.
pub const LINEAR: Rule = Rule {
    section: "Basic Polygon Rasterization",
    says: "noperspective attributes and 1/w are weighed by barycentric coordinates alone",
    open: "how exactly: the bound is derived from roundings in f32",
};
/// Snapping.
pub const SNAPPING: Rule = Rule {
    section: "Limits: subPixelPrecisionBits",
    says: "window positions have so many bits below the pixel",
    open: "how a position between two of them is rounded",
};
/// Clipping.
pub const CLIPPING: Rule = Rule {
    section: "Primitive Clipping",
    says: "what leaves the view volume is clipped, and new corners are made where edges leave it",
    open: "whether x and y are clipped at all (a guard band), and how new corners are rounded",
};
/// Rectangular lines.
pub const RECTANGLES: Rule = Rule {
    section: "Basic Line Segment Rasterization",
    says: "a line of width 1 is a rectangle about it (strictLines, or lines that are rectangular by \
           choice)",
    open: "samples on its border, and how its corners are rounded to the lattice",
};
/// Lines of devices without `strictLines`.
pub const LOOSE_LINES: Rule = Rule {
    section: "Basic Line Segment Rasterization",
    says: "without strictLines a line is a parallelogram, or drawn by Bresenham's algorithm",
    open: "which of them",
};
/// Bresenham lines.
pub const BRESENHAM: Rule = Rule {
    section: "Bresenham Line Segment Rasterization",
    says: "the diamond-exit rule, or a pixel at most beside each of its own, one more or fewer, and \
           one a column (row)",
    open: "that deviation",
};
/// The same twice.
pub const REPEATABILITY: Rule = Rule {
    section: "Invariance: Repeatability",
    says: "the same commands on the same state make the same picture every time",
    open: "nothing",
};

/// What came of a property.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Finding {
    /// Its name.
    pub name: String,
    /// The rule that was applied.
    pub rule: Rule,
    /// How it came out.
    pub class: Class,
    /// What was found, in a sentence.
    pub detail: String,
}
