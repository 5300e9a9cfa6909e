//! What was found out about the pieces of an item before drawing, and how it becomes a decision.
//!
//! A reason names no number of its own: decisions of several items with the same reason are shown as
//! one line, whose counts are sums.

use crate::effects::plan::{Attributes, Decision, PiecePlan, Unit};
use crate::effects::primitive::{Piece, has_one_w};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::fog::Share;
use crate::pipeline::opacity::Drawn;
use crate::scene::{Item, Scene};

/// One item, and what is known of its pieces.
pub struct Survey<'a> {
    pub scene: &'a Scene,
    pub effects: &'a Effects,
    pub item: &'a Item,
    pub index: usize,
    pub carries: Attributes,
    /// Whether its pieces were looked at; else they are counted as triangles.
    pub is_listed: bool,
    pub pieces: u64,
    /// Pieces whose three w are equal.
    pub one_w: u64,
    pub perspective: u64,
    pub depth: u64,
    /// Pieces that are partly in the fog, and those that are wholly.
    pub shares: [u64; 2],
    /// Pieces of which some fragments are opaque enough, and those of which none is.
    pub tested: [u64; 2],
    /// The same of blending: pieces of which some fragments are mixed, and those of which nothing is drawn.
    pub blended: [u64; 2],
    /// Pieces whose mixed fragments are brought into order.
    pub layers: u64,
    /// Pieces that are not magnified everywhere.
    pub mip_maps: u64,
    /// Pieces that may have a footprint with a longer axis.
    pub anisotropy: u64,
    /// Pieces that something may keep the light from.
    pub shadows: u64,
    /// Pieces that may have a highlight.
    pub specular: u64,
    /// Whether the engine has words of several widths, and the pieces in more than 32 bits.
    pub has_widths: bool,
    pub wide: u64,
    /// Pieces in which the attribute is interpolated: colour, normal, texture coordinates.
    pub interpolated: [u64; 3],
    pub any_interpolated: u64,
}

impl<'a> Survey<'a> {
    pub fn new(
        scene: &'a Scene,
        effects: &'a Effects,
        index: usize,
        carries: Attributes,
        is_listed: bool,
    ) -> Self {
        let item = &scene.items[index];
        Self {
            scene,
            effects,
            item,
            index,
            carries,
            is_listed,
            pieces: if is_listed { 0 } else { item.mesh.triangles.len() as u64 },
            one_w: 0,
            perspective: 0,
            depth: 0,
            specular: 0,
            mip_maps: 0,
            anisotropy: 0,
            shadows: 0,
            shares: [0; 2],
            tested: [0; 2],
            blended: [0; 2],
            layers: 0,
            has_widths: false,
            wide: 0,
            interpolated: [0; 3],
            any_interpolated: 0,
        }
    }

    pub fn count(&mut self, piece: &Piece, plan: PiecePlan, word_bits: Option<u32>) {
        self.pieces += 1;
        self.one_w += u64::from(has_one_w(piece));
        self.perspective += u64::from(plan.perspective && !plan.interpolates.is_empty());
        self.depth += u64::from(plan.depth);
        for (count, share) in self.shares.iter_mut().zip([Share::Mixed, Share::Whole]) {
            *count += u64::from(plan.fog == share);
        }
        for (i, drawn) in [Drawn::Mixed, Drawn::Nothing].into_iter().enumerate() {
            self.tested[i] += u64::from(plan.alpha_test == drawn);
            self.blended[i] += u64::from(plan.blending == drawn);
        }
        self.layers += u64::from(plan.layers);
        self.mip_maps += u64::from(plan.mip_maps);
        self.anisotropy += u64::from(plan.anisotropy);
        self.shadows += u64::from(plan.shadows);
        self.specular += u64::from(plan.specular);
        self.wide += u64::from(word_bits > Some(i32::BITS));
        let bits = [Attributes::COLOUR, Attributes::NORMAL, Attributes::UV];
        for (count, bit) in self.interpolated.iter_mut().zip(bits) {
            *count += u64::from(plan.interpolates.has(bit));
        }
        self.any_interpolated += u64::from(!plan.interpolates.is_empty());
    }

    /// A decision where `on` of the pieces pay.
    pub fn decide(&self, effect: Effect, on: u64, reason: impl Into<String>) -> Decision {
        self.decision(effect, [on, self.pieces - on, 0], reason.into())
    }

    /// A decision about all triangles of the item, those included that leave no piece.
    pub fn decide_triangles(&self, effect: Effect, pays: bool, reason: &str) -> Decision {
        let triangles = self.item.mesh.triangles.len() as u64;
        let counts = if pays { [triangles, 0, 0] } else { [0, triangles, 0] };
        let decision = self.decision(effect, counts, reason.to_owned());
        Decision { unit: Unit::Triangles, ..decision }
    }

    /// A decision that is left to a policy, except where a mode settles it.
    pub fn leave_open(&self, effect: Effect, reason: impl Into<String>) -> Decision {
        let counts = match self.effects.mode(effect) {
            Mode::Planned | Mode::Material => [0, 0, self.pieces],
            Mode::Always => [self.pieces, 0, 0],
            Mode::Never => [0, self.pieces, 0],
        };
        self.decision(effect, counts, reason.into())
    }

    fn decision(&self, effect: Effect, [on, off, open]: [u64; 3], reason: String) -> Decision {
        let reason = asked_for(self.effects.mode(effect), reason);
        let unit = if self.is_listed { Unit::Pieces } else { Unit::Triangles };
        Decision { effect, item: Some(self.index), unit, on, off, open, reason }
    }
}

/// A decision about the frame.
pub fn of_frame(effects: &Effects, effect: Effect, counts: [u64; 3], reason: String) -> Decision {
    let [on, off, open] = counts;
    let reason = asked_for(effects.mode(effect), reason);
    let unit = match effect {
        Effect::Clear | Effect::DepthBuffer => Unit::Samples,
        Effect::Samples | Effect::SecondBuffer => Unit::Pixels,
        _ => Unit::Triangles,
    };
    Decision { effect, item: None, unit, on, off, open, reason }
}

/// The reason, unless an order was one.
fn asked_for(mode: Mode, reason: String) -> String {
    match mode {
        Mode::Planned | Mode::Material => reason,
        Mode::Always => "asked for everywhere".to_owned(),
        Mode::Never => "switched off everywhere".to_owned(),
    }
}
