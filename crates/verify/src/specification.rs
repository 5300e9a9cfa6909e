//! What the specification of Vulkan says, in short, and how an answer stands to a specification.
//!
//! A section is named by its title and its anchor in the Vulkan specification: those of `primsrast` are in
//! the chapter "Rasterization", `vertexpostproc` is "Fixed-Function Vertex Post-Processing", `fragops`
//! "Fragment Operations", `fundamentals` "Fundamentals", and `invariance` the appendix "Invariance".

/// How what was drawn stands to the specification and to the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
pub enum Standing {
    /// What the oracle says, to the pixel; of values, within the derived bound.
    Equal,
    /// Something else, but nothing that the specification forbids.
    Allowed,
    /// Outside the specification, as the baseline of known faults says.
    Known,
    NotOffered,
    /// Fixed: the baseline names a fault that no case shows any more.
    Stale,
    Outside,
    NoAnswer,
}

impl Standing {
    #[must_use]
    pub fn of(is_equal: bool, is_allowed: bool) -> Self {
        match (is_equal, is_allowed) {
            (true, _) => Self::Equal,
            (_, true) => Self::Allowed,
            _ => Self::Outside,
        }
    }

    #[must_use]
    pub fn is_good(self) -> bool {
        self <= Self::NotOffered
    }

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

/// A part of a specification by which something is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Clause {
    pub section: &'static str,
    /// What has to be drawn, and what must not be.
    pub says: &'static str,
    /// What may be drawn or not.
    pub open: &'static str,
}

pub const POLYGONS: Clause = Clause {
    section: "Basic Polygon Rasterization (primsrast-polygons-basic)",
    says: "samples inside are covered; one on an edge that two triangles share, by exactly one of them",
    open: "by which, and samples on an edge of one alone: the oracle goes by the top-left rule",
};
pub const SAMPLES: Clause = Clause {
    section: "Multisampling (primsrast-multisampling)",
    says: "each sample is asked for itself, four at (6, 2) (14, 6) (2, 10) (10, 14) / 16 px where the \
           device says standardSampleLocations",
    open: "samples on edges, as with one sample",
};
pub const PERSPECTIVE: Clause = Clause {
    section: "Basic Polygon Rasterization (primsrast-polygons-basic)",
    says: "attributes are weighed by barycentric coordinates over w, depth by them alone",
    open: "how exactly: the bound is derived from roundings in f32",
};
pub const LINEAR: Clause = Clause {
    section: "Basic Polygon Rasterization (primsrast-polygons-basic)",
    says: "noperspective attributes and 1/w are weighed by barycentric coordinates alone",
    open: "how exactly: the bound is derived from roundings in f32",
};
pub const DEPTHS: Clause = Clause {
    section: "Conversion From Floating-Point to Normalized Fixed-Point (fundamentals-fpfixedconv)",
    says: "a depth is weighed by barycentric coordinates alone; of 16 bits it is one of the two nearest \
           multiples of 1/65535",
    open: "which of the two (the nearest is preferred), and how exact it was before: the bound is \
           derived from roundings in f32",
};
pub const DEPTH_TEST: Clause = Clause {
    section: "Depth Test (fragops-depth)",
    says: "with the comparison LESS a sample keeps the smaller of the depth that is kept and the new one",
    open: "nothing: both are depths that the device draws of each triangle alone",
};
pub const SNAPPING: Clause = Clause {
    section: "Controlling the Viewport (vertexpostproc-viewport)",
    says: "of x and y in the framebuffer as many bits below the pixel are kept as \
           subPixelPrecisionBits says",
    open: "how a position between two of them is rounded",
};
pub const CLIPPING: Clause = Clause {
    section: "Primitive Clipping (vertexpostproc-clipping)",
    says: "a triangle that leaves the view volume is clipped: new edges lie on its sides, nothing is \
           drawn beyond",
    open: "how new corners are rounded, and so whether there are any in x and y: a guard band shows \
           nothing else",
};
pub const RECTANGLES: Clause = Clause {
    section: "Basic Line Segment Rasterization (primsrast-lines-basic)",
    says: "a line of width 1 is a rectangle about it, ended at right angles (strictLines, or lines \
           that are rectangular by choice)",
    open: "samples on its border, and how its corners are rounded to the lattice of \
           lineSubPixelPrecisionBits",
};
pub const LOOSE_LINES: Clause = Clause {
    section: "Basic Line Segment Rasterization (primsrast-lines-basic)",
    says: "without strictLines a line is a parallelogram with ends along the minor axis, or drawn as a \
           Bresenham line",
    open: "which of the two, and how corners are rounded",
};
pub const BRESENHAM: Clause = Clause {
    section: "Bresenham Line Segment Rasterization (primsrast-lines-bresenham)",
    says: "the diamond-exit rule, or pixels that deviate from its own by at most one in x or y, one \
           more or fewer, and one a column (row)",
    open: "that deviation",
};
pub const JOINED: Clause = Clause {
    section: "Bresenham Line Segment Rasterization (primsrast-lines-bresenham)",
    says: "of two lines with a common end in the same major direction no pixel is drawn twice, and \
           none is left out between them",
    open: "nothing",
};
pub const REPEATABILITY: Clause = Clause {
    section: "Repeatability (invariance)",
    says: "the same commands on the same state make the same picture every time",
    open: "whether a device opened anew makes it too",
};
