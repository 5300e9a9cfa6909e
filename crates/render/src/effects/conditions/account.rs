//! How many pieces of an item pay for what, and how that becomes a decision to read.
//!
//! A reason names no number of its own: decisions of several items with the same reason are shown as
//! one line, whose counts are sums.

use super::Facts;
use crate::effects::plan::{Attributes, Decision, PiecePlan, Unit};
use crate::effects::{Effect, Effects, Mode};
use crate::pipeline::fog::Share;
use crate::scene::{Item, Scene};

/// What is known of an item before its triangles are looked at.
#[derive(Clone, Copy)]
pub struct ItemQuestion<'a> {
    pub scene: &'a Scene,
    pub item: &'a Item,
    /// The attributes that its pieces carry.
    pub carries: Attributes,
    pub effects: &'a Effects,
}

/// When single fragments pay for an effect, and which reasons a plan gives.
pub struct Condition {
    pub effect: Effect,
    /// The attributes, as bits, that are interpolated for effects alone that name them here.
    pub needs: u8,
    /// Whether anything of an item can pay for it, even where it is switched on everywhere.
    pub is_possible: fn(&ItemQuestion<'_>) -> bool,
    pub is_asked_for: fn(&ItemQuestion<'_>) -> bool,
    /// Why an item does not ask for it, and whether every plan says so, or only one for which the user switches the effect on or off
    /// everywhere. Nothing where no plan does.
    pub missing: fn(&ItemQuestion<'_>) -> Option<(&'static str, bool)>,
    /// Why all pieces pay where the material alone decides.
    pub by_material: &'static str,
    /// When a piece pays that is not looked at before it is drawn.
    pub open: &'static str,
    /// Why none of the pieces pays, all do, or some.
    pub reasons: fn(&Account<'_>) -> [&'static str; 3],
}

impl Condition {
    /// When the pieces of an item pay for it.
    pub fn mode(&self, asked: &ItemQuestion<'_>) -> Mode {
        match asked.effects.mode(self.effect) {
            _ if !(self.is_possible)(asked) => Mode::Never,
            Mode::Planned | Mode::Material if !(self.is_asked_for)(asked) => Mode::Never,
            Mode::Material => Mode::Always,
            mode => mode,
        }
    }

    pub fn explain(&self, account: &Account<'_>) -> Option<Decision> {
        let asked = &account.asked;
        let mode = asked.effects.mode(self.effect);
        let is_on = self.mode(asked) == Mode::Always;
        if !(self.is_asked_for)(asked) {
            let (reason, is_told) = (self.missing)(asked)?;
            let is_told = is_told || !mode.is_open();
            return is_told.then(|| account.decide_all(self.effect, is_on, reason));
        }
        Some(match mode {
            Mode::Material => account.decide_all(self.effect, is_on, self.by_material),
            _ => account.decide_each(self.effect, self.open, (self.reasons)(account)),
        })
    }
}

/// One item, and the plans of its pieces added up.
pub struct Account<'a> {
    pub asked: ItemQuestion<'a>,
    pub index: usize,
    /// Whether its pieces were looked at; else they are counted as triangles.
    pub is_listed: bool,
    pub pieces: u64,
    /// Pieces that pay, for each effect.
    paid: [u64; Effect::ALL.len()],
    /// Pieces whose three w are equal.
    pub one_w: u64,
    /// Pieces of which nothing but fog is seen.
    pub fogged: u64,
    /// Pieces of which no fragment is opaque enough to be drawn.
    pub nothing: u64,
    /// Whether the engine has words of several widths.
    pub has_widths: bool,
}

impl<'a> Account<'a> {
    pub fn new(
        scene: &'a Scene,
        effects: &'a Effects,
        index: usize,
        carries: Attributes,
        (is_listed, has_widths): (bool, bool),
    ) -> Self {
        let item = &scene.items[index];
        Self {
            asked: ItemQuestion { scene, item, carries, effects },
            index,
            is_listed,
            pieces: if is_listed { 0 } else { item.mesh.triangles.len() as u64 },
            paid: [0; Effect::ALL.len()],
            one_w: 0,
            fogged: 0,
            nothing: 0,
            has_widths,
        }
    }

    pub fn count(&mut self, facts: &Facts, plan: PiecePlan) {
        let mut paid = plan.paid() | u32::from(facts.is_wide) << Effect::WideWords as u32;
        while paid != 0 {
            self.paid[paid.trailing_zeros() as usize] += 1;
            paid &= paid - 1;
        }
        self.pieces += 1;
        self.one_w += u64::from(facts.has_one_w);
        self.fogged += u64::from(plan.fog == Share::Whole);
        self.nothing += u64::from(plan.is_nothing());
    }

    /// How many pieces pay for an effect.
    pub fn paid(&self, effect: Effect) -> u64 {
        self.paid[effect as usize]
    }

    /// A decision where `on` of the pieces pay.
    pub fn decide(&self, effect: Effect, on: u64, reason: impl Into<String>) -> Decision {
        self.decision(effect, [on, self.pieces - on, 0], reason.into())
    }

    /// A decision about all pieces alike.
    pub fn decide_all(&self, effect: Effect, pays: bool, reason: &str) -> Decision {
        self.decide(effect, if pays { self.pieces } else { 0 }, reason)
    }

    /// A decision by the facts of each piece, with the reasons why none of them pays, all do, or some; `open` says when
    /// a piece pays that is not looked at before it is drawn.
    pub fn decide_each(
        &self,
        effect: Effect,
        open: &str,
        [none, all, some]: [&str; 3],
    ) -> Decision {
        if !self.is_listed {
            return self.leave_open(effect, open);
        }
        let on = self.paid(effect);
        let reason = match on {
            0 => none,
            _ if on == self.pieces => all,
            _ => some,
        };
        self.decide(effect, on, reason)
    }

    /// A decision about all triangles of the item, those included that leave no piece.
    pub fn decide_triangles(&self, effect: Effect, pays: bool, reason: &str) -> Decision {
        let triangles = self.asked.item.mesh.triangles.len() as u64;
        let counts = if pays { [triangles, 0, 0] } else { [0, triangles, 0] };
        let decision = self.decision(effect, counts, reason.to_owned());
        Decision { unit: Unit::Triangles, ..decision }
    }

    /// A decision that is left to a policy, except where a mode settles it.
    pub fn leave_open(&self, effect: Effect, reason: impl Into<String>) -> Decision {
        let counts = match self.asked.effects.mode(effect) {
            Mode::Planned | Mode::Material => [0, 0, self.pieces],
            Mode::Always => [self.pieces, 0, 0],
            Mode::Never => [0, self.pieces, 0],
        };
        self.decision(effect, counts, reason.into())
    }

    fn decision(&self, effect: Effect, [on, off, open]: [u64; 3], reason: String) -> Decision {
        let reason = asked_for(self.asked.effects.mode(effect), reason);
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
