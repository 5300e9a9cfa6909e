//! A scene to facts: all that is found out by looking at triangles, before anything is planned.

use super::assembled::Assembled;
use super::conditions::{Facts, depth, layers, plan, samples, shadows};
use super::plan::{Order, Plan, Rule};
use super::primitive::{BadScene, Piece};
use super::{Effect, Effects, Mode};
use crate::scene::Scene;
use rasterproof_core::grid::SubpixelPoint;
use rasterproof_core::triangle::Corners;

/// How many bits an engine decides a triangle in, where it has several widths.
pub(super) type WordBits<'a> = &'a dyn Fn(&Corners) -> Option<u32>;

/// A scene in clip space, and what is known of its triangles before a plan is made.
pub(super) struct Survey<'a> {
    pub assembled: Assembled<'a>,
    /// Of each piece, where all are looked at.
    pub facts: Option<Vec<Facts>>,
    /// Of a scene that is too large for that: how many triangles were compared with others, and how many may overlap one.
    pub overlapping: Option<[usize; 2]>,
    /// What its triangles would save and cost if samples were told apart on demand; where facts are known, nothing is
    /// taken into account yet.
    pub estimate: Option<samples::Estimate>,
    /// Whether the engine has words of several widths.
    pub has_widths: bool,
}

impl<'a> Survey<'a> {
    /// Looks at a scene for a plan of which the rules of all items are known.
    pub fn new(
        scene: &'a Scene,
        effects: &Effects,
        outset: &Plan,
        rules: &[Rule],
        word_bits: WordBits<'_>,
    ) -> Result<Self, BadScene> {
        let canvas = outset.drawn();
        let mut assembled = Assembled::new(scene, outset)?;
        let order = outset.frame.order;
        let is_listed = order == Order::FarthestFirst
            || depth::is_looked_at(scene, effects, &assembled.items, &canvas);
        let facts = is_listed.then(|| {
            assembled.assemble(scene);
            let (items, pieces) = (&assembled.items, assembled.pieces());
            let of_piece = |(index, piece): &(usize, Piece)| Facts {
                is_wide: word_bits(&piece.corners()) > Some(i32::BITS),
                ..Facts::of(&rules[*index], &items[*index], piece)
            };
            let mut facts: Vec<Facts> = pieces.iter().map(of_piece).collect();
            shadows::search_all(scene, rules, &assembled, &mut facts);
            if effects.mode(Effect::Depth) == Mode::Planned && order == Order::Submission {
                for (facts, overlaps) in facts.iter_mut().zip(depth::overlaps(pieces, &canvas)) {
                    facts.overlaps = overlaps;
                }
            }
            if rules.iter().any(|rule| rule.layers.is_open()) {
                for (facts, meets) in facts.iter_mut().zip(layers::meets(items, pieces, &canvas)) {
                    facts.meets_blended = meets;
                }
            }
            facts
        });
        // Layers are kept for each sample.
        let estimates =
            !layers::is_in_use(scene, effects) && samples::may_be_on_demand(&canvas, effects);
        let mut estimate = estimates.then(|| samples::Estimate::new(&canvas));
        if let (false, Some(estimate)) = (is_listed, &mut estimate) {
            for (item, rule) in assembled.items.iter().zip(rules) {
                estimate.see_roughly(item, plan(rule, &Facts::of_item(item.item)));
            }
        }
        let overlapping = (!is_listed && depth::is_surveyed(scene))
            .then(|| depth::survey(scene, &assembled.items, &canvas));
        let has_widths = word_bits(&[SubpixelPoint::new(0, 0); 3]).is_some();
        Ok(Self { assembled, facts, overlapping, estimate, has_widths })
    }
}
