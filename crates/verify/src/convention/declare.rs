//! Between what a rasterizer declares and what was found: questions that keep to its declaration, and the declaration
//! that says what was found.

use super::bench::Declarations;
use super::diagnosis::{Confidence, Diagnosis};
use super::mirror::Mirror;
use super::rule::{CornerRule, Ties, TriangleConvention, Windings};
use super::shape::Shape;
use crate::promise::{Convention, Rule, Winding};
use rasterproof_core::grid::SUBPIXEL_BITS;

impl From<&Convention> for Declarations {
    /// Corners on the declared grid, anywhere, in any window.
    fn from(declared: &Convention) -> Self {
        let [x, y] = declared.sample;
        let default = TriangleConvention::default();
        let grid = 1 << declared.subpixel_bits;
        let declared = TriangleConvention {
            draws: match declared.seen_winding() {
                Winding::Both => Windings::Both,
                Winding::Clockwise => Windings::Clockwise,
                Winding::CounterClockwise => Windings::CounterClockwise,
            },
            shape: Shape::Point { x, y },
            ties: Ties::named(declared.seen_rule().word()).unwrap_or(default.ties),
            ..default
        };
        Self { grid, declared, ..Self::default() }
    }
}

impl Diagnosis {
    /// What to declare to be judged by what was found, in place of `declared`; nothing where no declaration says it.
    #[must_use]
    pub fn declaration(&self, declared: &Convention) -> Option<Convention> {
        let Shape::Point { x, y } = self.convention.shape else { return None };
        if self.confidence == Confidence::Unexplained || self.convention.mirror != Mirror::None {
            return None;
        }
        let winding = match self.convention.draws {
            Windings::Clockwise => Winding::Clockwise,
            Windings::CounterClockwise => Winding::CounterClockwise,
            Windings::Both | Windings::Neither => Winding::Both,
        };
        let is_seen = self.compass.seen().contains(&true);
        let rule = if is_seen { self.rule() } else { declared.seen_rule() };
        // What is seen, turned over where y goes up, is what the rasterizer says.
        let seen = declared.rule(rule).winding(winding);
        let found = declared.rule(seen.seen_rule()).winding(seen.seen_winding()).sample(x, y);
        // Corners on a grid that holds the found one are left where they are.
        let bits = SUBPIXEL_BITS - self.convention.quantum.step.ilog2();
        Some(found.subpixel_bits(bits.min(declared.subpixel_bits)))
    }

    /// The rule that was found, seen with y down; none is promised where none fits.
    fn rule(&self) -> Rule {
        let ties = &self.convention.ties;
        let name = ties.name(self.compass.seen()).filter(|_| self.compass.is_decided());
        let rule = Rule::ALL.iter().find(|(word, _)| Some(*word) == name).map(|(_, rule)| *rule);
        match (rule, ties.corners) {
            (Some(rule), CornerRule::AsEdges)
            | (Some(rule @ Rule::Inclusive), CornerRule::Always)
            | (Some(rule @ Rule::Strict), CornerRule::Never) => rule,
            _ => Rule::Unspecified,
        }
    }
}
