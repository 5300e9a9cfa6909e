//! A convention: which windings are drawn, what happens to a corner, which shape, and who owns a
//! sample that lies exactly on an edge. A pure function from corners to pixels.

use super::mask::{Mask, SIDE_PX};
use super::mirror::Mirror;
use super::place::{FACINGS, Place, turn};
use super::quantum::Quantum;
use super::shape::Shape;
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;

rasterproof_core::named! {
    /// Which windings are drawn, as seen on the screen with y down.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
    pub enum Windings {
        Both = "",
        Clockwise = "draws clockwise triangles alone, ",
        CounterClockwise = "draws counterclockwise triangles alone, ",
        Neither = "draws nothing, ",
    }
}

impl Windings {
    /// Whether a triangle of that turn is drawn.
    #[must_use]
    pub fn draws(self, clockwise: bool) -> bool {
        match self {
            Self::Both => true,
            Self::Clockwise => clockwise,
            Self::CounterClockwise => !clockwise,
            Self::Neither => false,
        }
    }
}

/// Samples on a corner, that is on several edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum CornerRule {
    AsEdges,
    Always,
    Never,
}

/// Who owns what lies exactly on the border.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Ties {
    /// For each of [`FACINGS`], whether a sample on an edge that faces that way is drawn.
    pub edges: [bool; 8],
    pub corners: CornerRule,
    /// Whether exactly the share that is asked for is enough.
    pub level: bool,
}

/// The rules that have a name: the facings that are drawn, from north on, clockwise.
const NAMED: [(&str, [u8; 8]); 10] = [
    ("top-left", [1, 0, 0, 0, 0, 1, 1, 1]),
    ("top-right", [1, 1, 1, 1, 0, 0, 0, 0]),
    ("bottom-left", [0, 0, 0, 0, 1, 1, 1, 1]),
    ("bottom-right", [0, 1, 1, 1, 1, 0, 0, 0]),
    ("inclusive", [1; 8]),
    ("strict", [0; 8]),
    ("top-left, y first", [1, 1, 0, 0, 0, 0, 1, 1]),
    ("top-right, y first", [1, 1, 1, 0, 0, 0, 0, 1]),
    ("bottom-left, y first", [0, 0, 0, 1, 1, 1, 1, 0]),
    ("bottom-right, y first", [0, 0, 1, 1, 1, 1, 0, 0]),
];

impl Ties {
    /// The rule with the name, of those that the line protocol declares and their y-first forms.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let (_, edges) = NAMED.iter().find(|(known, _)| *known == name)?;
        let edges = edges.map(|bit| bit == 1);
        Some(Self { edges, corners: CornerRule::AsEdges, level: true })
    }

    /// Its name, if those of its facings that `seen` marks are the ones of a named rule.
    #[must_use]
    pub fn name(&self, seen: [bool; 8]) -> Option<&'static str> {
        let fits = |bits: &[u8; 8]| (0..8).all(|i| !seen[i] || self.edges[i] == (bits[i] == 1));
        NAMED.iter().find(|(_, bits)| fits(bits)).map(|(name, _)| *name)
    }

    /// Whether a sample on a corner is drawn; the bits are the directions of its edges.
    fn includes_corner(&self, bits: u8) -> bool {
        match self.corners {
            CornerRule::Always => true,
            CornerRule::Never => false,
            CornerRule::AsEdges => (0..FACINGS.len()).all(|i| bits >> i & 1 == 0 || self.edges[i]),
        }
    }

    /// Whether a sample that is not outside is drawn.
    fn includes(&self, place: Place) -> bool {
        match place {
            Place::In => true,
            Place::Edge(facing) => self.edges[facing],
            Place::Level => self.level,
            Place::Corner(bits) => self.includes_corner(bits),
            Place::Several { needed, ties } => {
                let owned = |bits: &&u8| match bits.count_ones() {
                    0 => false,
                    1 => self.edges[bits.trailing_zeros() as usize],
                    _ => self.includes_corner(**bits),
                };
                ties.iter().filter(owned).count() >= usize::from(needed)
            }
        }
    }
}

/// What a program does, as far as its pictures show it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TriangleConvention {
    pub draws: Windings,
    pub quantum: Quantum,
    pub shape: Shape,
    pub ties: Ties,
    /// How the whole picture is turned over.
    pub mirror: Mirror,
    /// Whether a triangle without area may leave pixels, by no rule that is known. An outline draws
    /// its sides in any case.
    pub flat: bool,
}

impl Default for TriangleConvention {
    /// This project's: both windings, corners on 1/256 px, samples at centres, top-left.
    fn default() -> Self {
        Self {
            draws: Windings::Both,
            quantum: Quantum::NONE,
            shape: Shape::Point { x: 128, y: 128 },
            ties: Ties::named("top-left").unwrap_or_else(|| unreachable!("it is in the list")),
            mirror: Mirror::None,
            flat: false,
        }
    }
}

impl TriangleConvention {
    /// The pixels of `window` that belong to a triangle, one hit each. None where the convention
    /// says nothing: for a triangle that has lost its area or winding on the grid, where that
    /// matters, and for one too large for its shape.
    pub fn cover(&self, corners: &Corners, window: PixelRect) -> Option<Coverage> {
        let mut coverage = Coverage::new(window, 0);
        let mut draw = |x, y| coverage.span_mut(y, x, x + 1).fill(1);
        self.visit(corners, window, &mut draw).then_some(coverage)
    }

    /// As [`TriangleConvention::cover`], of a window of at most [`SIDE_PX`] a side.
    pub(crate) fn mask(&self, corners: &Corners, window: PixelRect) -> Option<Mask> {
        debug_assert!(window.x1 <= SIDE_PX && window.y1 <= SIDE_PX);
        let mut mask = Mask::default();
        self.visit(corners, window, &mut |x, y| mask.set(x, y)).then_some(mask)
    }

    /// Calls `draw` for each pixel; false where the convention says nothing.
    fn visit(&self, corners: &Corners, window: PixelRect, draw: &mut dyn FnMut(i32, i32)) -> bool {
        let points = self.quantum.corners(corners);
        let [turn, given] =
            [&points, &Quantum::NONE.corners(corners)].map_array(|p| turn(p).signum());
        let flat = self.flat && turn == 0 && !self.shape.draws_flat();
        // Who culls may do so before corners reach their grid, or after.
        let culled = self.draws != Windings::Both && turn != given;
        if flat || culled {
            return false;
        }
        (turn != 0 && !self.draws.draws(turn > 0))
            || self.shape.trace(&points, self.mirror.window(window), &mut |x, y, place| {
                if self.ties.includes(place) {
                    let [x, y] = self.mirror.at(x, y, window);
                    draw(x, y);
                }
            })
    }
}
