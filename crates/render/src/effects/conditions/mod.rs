//! When an effect may be left out: one file for each effect, or for those of one kind of surface, with the condition, what it has to
//! know of a piece, and the reason to read.
//!
//! The rule of an item, the facts of a piece, the plan of the piece and the account are made of the one list in `table.rs`.
//! A condition reads rules and facts; never a triangle, an engine or a pixel.

pub(super) mod account;
pub(super) mod alpha_test;
pub(super) mod anisotropy;
pub(super) mod attributes;
pub(super) mod blending;
pub(super) mod clear;
pub(super) mod clip;
pub(super) mod cull;
pub(super) mod depth;
pub(super) mod depth_buffer;
pub(super) mod fog;
pub(super) mod interpolation;
pub(super) mod layers;
pub(super) mod mip_maps;
pub(super) mod perspective;
pub(super) mod physical;
pub(super) mod samples;
pub(super) mod second_buffer;
pub(super) mod shadows;
pub(super) mod specular;
pub(super) mod wide_words;

use glam::DVec2;

use self::account::{Account, Condition, ItemQuestion};
use super::plan::{Attributes, Decision, PiecePlan, Rule};
use super::primitive::{Piece, Prepared, has_one_w};
use super::table::fragment_effects;
use super::{Effect, Effects, Mode};
use crate::pipeline::fog::Share;
use crate::pipeline::opacity::Drawn;
use crate::pipeline::physical::Map;
use crate::pipeline::texture::Texture;
use crate::scene::{Item, Scene};
use rasterproof_core::arrays::MapArray as _;
use rasterproof_core::grid::SUBPIXELS;

macro_rules! conditions {
    ($($(#[$about:meta])*
    $field:ident: $kind:ty = $paid:expr => $effect:ident, $planned:literal,
        $condition:expr, $(fact $fact:ident)? $(by $how:path)?;)+) => {
        /// What is known of a piece before it is planned. What no mode asks for is not looked at, and is as in
        /// [`Facts::UNKNOWN`].
        #[derive(Clone, Copy, Debug)]
        pub(super) struct Facts {
            /// Attributes of which something that depends on them may differ between fragments.
            pub varies: Attributes,
            pub has_one_w: bool,
            pub fog: Share,
            /// What is drawn by the opacities that may be read.
            pub opacity: Drawn,
            /// Whether it may hide another piece or be hidden.
            pub overlaps: bool,
            /// Whether the engine needs more than 32 bits for it.
            pub is_wide: bool,
            $($(#[doc = concat!("Whether it may be a piece ", $planned)] pub $fact: bool,)?)+
        }

        impl Facts {
            /// Of a piece that is not looked at: whatever may be is taken to be.
            pub const UNKNOWN: Self = Self {
                varies: Attributes::EVERY,
                has_one_w: false,
                fog: Share::Mixed,
                opacity: Drawn::Mixed,
                overlaps: true,
                is_wide: true,
                $($($fact: true,)?)+
            };
        }

        /// The conditions of the effects of single fragments.
        pub(super) const ALL: &[&Condition] = &[$(&$condition,)+];

        /// The attributes that an item carries, and what it asks for: without looking at its triangles.
        pub(super) fn rule(scene: &Scene, item: &Item, effects: &Effects) -> (Attributes, Rule) {
            let carries = attributes::carries(scene, item, effects);
            let (interpolates, where_it_varies) = interpolation::rule(item, carries, effects);
            let asked = ItemQuestion { scene, item, carries, effects };
            let rule = Rule {
                interpolates,
                where_it_varies,
                perspective: perspective::mode(scene, effects),
                depth: depth::pays(scene, effects, true),
                $($field: $condition.mode(&asked),)+
            };
            (carries, rule)
        }

        /// Attributes that only some of these effects need.
        const NEEDED: u8 = $($condition.needs)|+;

        /// Those that the effects of a piece need.
        #[inline]
        fn needed(plan: &PiecePlan) -> u8 {
            $((if plan.$field == $paid { $condition.needs } else { 0 }))|+
        }

        /// What the fragments of a piece pay for by its facts, before effects are put together.
        #[inline]
        fn paid(rule: &Rule, facts: &Facts, is_hidden: bool) -> PiecePlan {
            PiecePlan {
                $($field: $(!is_hidden && rule.$field.pays(facts.$fact))? $($how(rule, facts))?,)+
                ..PiecePlan::default()
            }
        }
    };
}

fragment_effects!(conditions);

/// Samples that a piece covers at least where it is looked at what it reads of textures: of a smaller one that takes longer than to
/// compute what it asks for.
const LEAST_TEXTURED: i64 = 6;

/// The same of highlights, which most fragments find to be dark by two products.
const LEAST_SHINY: i64 = 16;

/// So many samples of a piece, times the part of its texture that has one colour, are reason to look whether the piece reads one
/// colour. The smaller that part is, the more pieces are looked at in vain for each that does, and the more it has to save.
const LEAST_PLAIN: f64 = 6.0;

/// A piece of so many samples is looked at with any texture.
const ALWAYS_PLAIN: i64 = 256;

/// About how many samples a piece covers: exact in all but pieces that reach far out of the window.
#[inline]
pub(super) fn samples_of(piece: &Piece) -> i64 {
    let [a, b, c] =
        piece.corners().map_array(|corner| DVec2::new(corner.x.into(), corner.y.into()));
    let subpixels = 2.0 * f64::from(SUBPIXELS).powi(2);
    ((b - a).perp_dot(c - a).abs() / subpixels) as i64
}

/// Whether it is looked at if a piece of so many samples reads one colour of a texture.
fn is_looked_at(texture: &Texture, samples: i64) -> bool {
    samples >= ALWAYS_PLAIN
        || (samples >= LEAST_TEXTURED && samples as f64 * texture.plain_part() >= LEAST_PLAIN)
}

impl Facts {
    /// Of every piece of an item, by its material alone.
    pub fn of_item(item: &Item) -> Self {
        Self { varies: interpolation::at_most(item, Attributes::EVERY), ..Self::UNKNOWN }
    }

    /// Of one piece by itself: what other pieces have to do with it is not known, and a piece that may be lit is taken to be
    /// in shadow.
    #[inline]
    pub fn of(rule: &Rule, item: &Prepared<'_>, piece: &Piece) -> Self {
        let mut facts = Self { has_one_w: has_one_w(piece), ..Self::UNKNOWN };
        let samples = samples_of(piece);
        if rule.alpha_test.is_open() || rule.blending.is_open() {
            facts.opacity = alpha_test::opacity(rule, item, piece, samples);
        }
        if rule.fog.is_open() {
            facts.fog = fog::between(item, piece);
            // What is hidden is not looked at.
            if fog::hides(rule, &facts) {
                return facts;
            }
        }
        if rule.where_it_varies {
            facts.varies = interpolation::differing(rule.interpolates, piece);
        }
        if item.physical().is_some() {
            physical::see(rule, item, piece, samples, &mut facts);
        }
        let faces_away = rule.shadows.is_open()
            && !rule.normal_maps.pays(facts.is_bumpy)
            && shadows::piece_faces_away(item, piece);
        if rule.specular.is_open() {
            // What faces away without a highlight needs no shadow map, which costs more than all of these.
            let is_checked = samples >= LEAST_SHINY || faces_away;
            facts.is_shiny = !is_checked || specular::may_show(item, piece);
        }
        if rule.shadows.is_open() {
            facts.is_shadowed = !faces_away || rule.specular.pays(facts.is_shiny);
        }
        // Every normal has the light of the first then, which is ambient.
        let is_dark =
            item.physical().is_some() && rule.reflection.is_open() && !facts.is_reflecting;
        if is_dark && !rule.specular.pays(facts.is_shiny) && !rule.shadows.pays(facts.is_shadowed) {
            facts.varies = facts.varies.without(Attributes(Attributes::NORMAL));
        }
        if !rule.interpolates.both(facts.varies).has_uv() || samples < LEAST_TEXTURED {
            return facts;
        }
        if rule.mip_maps.is_open() || rule.anisotropy.is_open() {
            [facts.is_minified, facts.is_stretched] =
                mip_maps::footprints(rule, item, piece, samples);
        }
        if !interpolation::may_be_plain(rule, facts.opacity) {
            return facts;
        }
        let reads =
            [rule.mip_maps.pays(facts.is_minified), rule.anisotropy.pays(facts.is_stretched)];
        let maps = Map::ALL.map(|map| item.map(map).filter(|_| physical::reads(rule, &facts, map)));
        let all = || item.colour().into_iter().chain(maps.into_iter().flatten());
        for is_second in [false, true] {
            let bit = Attributes(Attributes::uv(is_second));
            let read = || all().filter(|(_, of)| *of == is_second);
            let is_plain = |read| interpolation::is_plain(read, rule, item, piece, reads);
            // One that is not plain is reason enough to interpolate.
            if !facts.varies.both(bit).is_empty()
                && read().all(|(texture, _)| is_looked_at(texture, samples))
                && read().all(is_plain)
            {
                facts.varies = facts.varies.without(bit);
            }
        }
        facts
    }
}

/// What a piece pays for by the rule of its item.
#[inline]
pub(super) fn plan(rule: &Rule, facts: &Facts) -> PiecePlan {
    let is_hidden = fog::hides(rule, facts);
    let mut plan = paid(rule, facts, is_hidden);
    if !is_hidden {
        plan.interpolates = rule.interpolates.both(facts.varies);
        plan.interpolates = plan.interpolates.without(Attributes(NEEDED & !needed(&plan)));
    }
    let has_uv = plan.interpolates.has_uv();
    plan.mip_maps &= has_uv;
    plan.anisotropy &= has_uv;
    plan.depth = rule.depth && facts.overlaps;
    plan.layers &= plan.depth && plan.blending == Drawn::Mixed;
    plan.perspective = rule.perspective.pays(!plan.interpolates.is_empty() && !facts.has_one_w);
    plan
}

/// Effects with which nothing is left out of a fragment that its material asks for.
pub(super) const EVERY_FRAGMENT: Effects = Effects::USUAL.with(Effect::Interpolation, Mode::Always);

/// What every fragment of an item pays for with them.
pub(super) fn of_every_fragment(scene: &Scene, item: &Item) -> PiecePlan {
    plan(&rule(scene, item, &EVERY_FRAGMENT).1, &Facts::UNKNOWN)
}

/// The account of the pieces of an item.
pub(super) fn explain(
    account: &Account<'_>,
    overlapping: Option<[usize; 2]>,
    decisions: &mut Vec<Decision>,
) {
    decisions.push(cull::explain(account));
    decisions.push(wide_words::explain(account));
    decisions.push(perspective::explain(account));
    decisions.push(depth::explain(account, overlapping));
    decisions.extend(attributes::explain(account));
    decisions.extend(ALL.iter().filter_map(|condition| condition.explain(account)));
    decisions.push(interpolation::explain(account));
}
