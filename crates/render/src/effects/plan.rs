//! A plan: what a frame will pay for, as data, before anything is drawn.
//!
//! What is known of a piece beforehand is a fact of the plan. What shows only while it is drawn is a
//! *policy*, a rule with its numbers in it that decides then: [`Pieces::AsTheyCome`] of scenes too
//! large to be looked at first, [`Samples::OnDemand`] of pixels, and [`Mode::Planned`] of the planes
//! that cut a triangle and of the width of words. Whoever edits a plan gets what it says, right or
//! wrong.

use std::fmt;

use serde::{Deserialize, Serialize};

pub use super::scene_digest::SceneDigest;
use super::table::fragment_effects;
use super::{Effect, Mode};
use crate::pipeline::depth::DepthFormat;
use crate::pipeline::fog::Share;
use crate::pipeline::opacity::Drawn;
use crate::pipeline::shade::PLACED;
use crate::pipeline::target::{Antialias, Target};
use rasterproof_core::grid::PixelRect;

/// The form of plans that this program writes and reads. It changes when a word of a plan gets another
/// meaning, as the digest of a scene did.
pub const VERSION: u32 = 2;

/// What is drawn into, as far as a plan depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Canvas {
    /// Columns of pixels.
    pub width: u32,
    /// Rows of pixels.
    pub height: u32,
    /// How many samples a pixel has and where.
    pub antialias: Antialias,
    pub depth: DepthFormat,
    /// Whether somebody looks while the frame is drawn.
    pub watched: bool,
}

impl Canvas {
    /// A target, at which nobody looks before the frame is finished.
    #[must_use]
    pub fn of(target: &Target) -> Self {
        let size = target.size();
        let (width, height) = (size.width(), size.height());
        let (antialias, depth) = (target.antialias(), target.format);
        Self { width, height, antialias, depth, watched: false }
    }

    /// The picture's pixels.
    #[must_use]
    pub fn size(&self) -> PixelRect {
        PixelRect::window(self.width, self.height)
    }

    /// The window that triangles are drawn into: N times the size where supersampled.
    #[must_use]
    pub fn window(&self) -> PixelRect {
        let scale = self.antialias.scale();
        PixelRect::window(self.width * scale, self.height * scale)
    }

    #[must_use]
    pub fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Samples of all pixels.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.pixels() * self.antialias.samples()
    }
}

impl fmt::Display for Canvas {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { width, height, antialias, depth, .. } = self;
        let (antialias, depth) = (name_of(*antialias), depth.name());
        write!(f, "{width} x {height} px, antialiasing {antialias}, depths as {depth}")
    }
}

/// The name of an antialiasing on the command line.
fn name_of(antialias: Antialias) -> String {
    match antialias {
        Antialias::None => "none".to_owned(),
        Antialias::Multisample4 => "msaa4".to_owned(),
        Antialias::Supersample(side) => format!("ssaa{side}"),
    }
}

/// An attribute that a triangle carries from its corners to its fragments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Attribute {
    Colour,
    Normal,
    /// Texture coordinates.
    Uv,
    Place,
    /// The place in the world, from which the eye is seen.
    World,
    Tangent,
    /// Texture coordinates of maps that are read elsewhere than the colour.
    SecondUv,
}

/// A set of attributes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<Attribute>", into = "Vec<Attribute>")]
pub struct Attributes(pub(super) u8);

impl Attributes {
    /// Bits of the attributes.
    pub(super) const COLOUR: u8 = 1;
    pub(super) const NORMAL: u8 = 2;
    pub(super) const UV: u8 = 4;
    pub(super) const PLACE: u8 = 8;
    pub(super) const WORLD: u8 = 16;
    pub(super) const TANGENT: u8 = 32;
    pub(super) const SECOND_UV: u8 = 64;
    /// Where each stands among all numbers of a vertex.
    pub(super) const RANGES: [(u8, std::ops::Range<usize>); 7] = [
        (Self::COLOUR, 0..3),
        (Self::NORMAL, 3..6),
        (Self::UV, 6..8),
        (Self::PLACE, 8..11),
        (Self::WORLD, 11..14),
        (Self::TANGENT, 14..18),
        (Self::SECOND_UV, 18..20),
    ];
    /// For each set of attributes: where its numbers stand among all numbers of a vertex, and how many there are.
    const NUMBERS: [([u8; PLACED], usize); 128] = {
        let mut numbers = [([0; PLACED], 0); 128];
        let mut set = 0;
        while set < numbers.len() {
            let (places, count) = &mut numbers[set];
            let mut i = 0;
            while i < Self::RANGES.len() {
                let (bit, range) = &Self::RANGES[i];
                let mut number = range.start;
                while set & *bit as usize != 0 && number < range.end {
                    places[*count] = number as u8;
                    *count += 1;
                    number += 1;
                }
                i += 1;
            }
            set += 1;
        }
        numbers
    };
    const BITS: [(Attribute, u8); 7] = [
        (Attribute::Colour, Self::COLOUR),
        (Attribute::Normal, Self::NORMAL),
        (Attribute::Uv, Self::UV),
        (Attribute::Place, Self::PLACE),
        (Attribute::World, Self::WORLD),
        (Attribute::Tangent, Self::TANGENT),
        (Attribute::SecondUv, Self::SECOND_UV),
    ];

    /// The attributes beside which few items carry others.
    pub(super) const FIRST: Self = Self(Self::COLOUR | Self::NORMAL | Self::UV);

    /// No attribute.
    pub const NONE: Self = Self(0);

    pub(super) const EVERY: Self = Self(127);

    /// The bit of the first or the second texture coordinates.
    pub(super) const fn uv(is_second: bool) -> u8 {
        if is_second { Self::SECOND_UV } else { Self::UV }
    }

    /// Where an attribute stands among all numbers of a vertex.
    pub(super) fn range(bit: u8) -> std::ops::Range<usize> {
        Self::RANGES[bit.trailing_zeros() as usize].1.clone()
    }

    /// Whether textures are read by any of these.
    pub(super) fn has_uv(self) -> bool {
        self.has(Self::UV) || self.has(Self::SECOND_UV)
    }

    pub(super) fn has(self, bit: u8) -> bool {
        self.0 & bit != 0
    }

    pub(super) fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Where the numbers of these attributes stand among all numbers of a vertex; 0 after the last.
    #[inline]
    pub(super) fn places(self) -> &'static [u8; PLACED] {
        &Self::NUMBERS[usize::from(self.0 & Self::EVERY.0)].0
    }

    /// How many numbers a fragment has of these attributes.
    pub(super) fn components(self) -> usize {
        Self::NUMBERS[usize::from(self.0 & Self::EVERY.0)].1
    }

    pub(super) fn both(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    pub(super) fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }
}

impl fmt::Display for Attributes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = [
            (Self::COLOUR, "colour"),
            (Self::NORMAL, "normal"),
            (Self::UV, "uv"),
            (Self::PLACE, "place"),
            (Self::WORLD, "place in the world"),
            (Self::TANGENT, "tangent"),
            (Self::SECOND_UV, "second uv"),
        ];
        let names: Vec<_> =
            names.into_iter().filter(|(bit, _)| self.has(*bit)).map(|(_, name)| name).collect();
        f.write_str(&names.join(" and "))
    }
}

impl From<Vec<Attribute>> for Attributes {
    fn from(list: Vec<Attribute>) -> Self {
        let bit = |attribute: &Attribute| Self::BITS.iter().find(|(a, _)| a == attribute);
        Self(list.iter().filter_map(bit).fold(0, |bits, (_, bit)| bits | bit))
    }
}

impl From<Attributes> for Vec<Attribute> {
    fn from(set: Attributes) -> Self {
        Attributes::BITS.iter().filter(|(_, bit)| set.has(*bit)).map(|(a, _)| *a).collect()
    }
}

fn is_default<T: Default + PartialEq>(word: &T) -> bool {
    *word == T::default()
}

fn never() -> Mode {
    Mode::Never
}

fn is_never(mode: &Mode) -> bool {
    *mode == Mode::Never
}

macro_rules! plans {
    ($($(#[$about:meta])*
    $field:ident: $kind:ty = $paid:expr => $effect:ident, $planned:literal,
        $condition:expr, $(fact $fact:ident)? $(by $how:path)?;)+) => {
        /// What each fragment of a piece pays for. Words of effects beyond the book's are missing where they are not
        /// called for.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct PiecePlan {
            /// Attributes that are interpolated; the others have the first corner's value.
            pub interpolates: Attributes,
            /// Whether they are divided by 1/w.
            pub perspective: bool,
            /// Whether depths are compared and written.
            pub depth: bool,
            $($(#[$about])*
            #[serde(default, skip_serializing_if = "is_default")]
            pub $field: $kind,)+
        }

        /// How a [`PiecePlan`] is made of a piece when it is there.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct Rule {
            /// Attributes that may be interpolated.
            pub interpolates: Attributes,
            /// Those alone that differ between the corners.
            pub where_it_varies: bool,
            /// Planned: where something is interpolated and w differs between the corners.
            pub perspective: Mode,
            /// Whether depths are compared and written.
            pub depth: bool,
            $(#[doc = concat!("Planned: ", $planned)]
            #[serde(default = "never", skip_serializing_if = "is_never")]
            pub $field: Mode,)+
        }

        impl PiecePlan {
            /// What a fragment pays for, as bits of [`Effect`] in the order of [`Effect::ALL`].
            pub(super) fn paid(self) -> u32 {
                let interpolates = self.interpolates;
                let is_any = !interpolates.is_empty();
                [
                    (Effect::Perspective, self.perspective && is_any),
                    (Effect::Depth, self.depth),
                    (Effect::Colour, interpolates.has(Attributes::COLOUR)),
                    (Effect::Light, interpolates.has(Attributes::NORMAL)),
                    (Effect::Texture, interpolates.has(Attributes::UV)),
                    (Effect::Interpolation, is_any),
                    $((Effect::$effect, self.$field == $paid),)+
                ]
                .into_iter()
                .fold(0, |bits, (effect, pays)| bits | u32::from(pays) << effect as u32)
            }
        }
    };
}

fragment_effects!(plans);

impl PiecePlan {
    /// Whether all its fragments have one colour. They may have opacities of their own all the same.
    pub(super) fn is_one_colour(self) -> bool {
        self.interpolates.is_empty() && self.fog != Share::Mixed
    }

    /// Whether nothing is seen through a fragment that it draws.
    pub(super) fn is_opaque(self) -> bool {
        self.blending == Drawn::All
    }

    /// Whether it draws every fragment that it covers and that no nearer one hides: none is left out as too little opaque.
    pub(super) fn writes_all(self) -> bool {
        self.alpha_test == Drawn::All
    }

    /// Whether what was there is gone wherever its fragments are not hidden.
    pub(super) fn replaces_all(self) -> bool {
        self.is_opaque() && self.writes_all()
    }

    /// Whether there is nothing to draw.
    pub(super) fn is_nothing(self) -> bool {
        self.alpha_test == Drawn::Nothing || self.blending == Drawn::Nothing
    }

    /// Whether what is read of a texture depends on how much of it a pixel meets.
    pub(super) fn reads_around(self) -> bool {
        self.mip_maps || self.anisotropy
    }
}

/// What the pieces of an item pay for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pieces {
    /// Known: how many in turn, in the order of submission, have which plan.
    Listed(Vec<(u64, PiecePlan)>),
    /// A policy, asked of each piece when it is drawn.
    AsTheyCome(Rule),
}

/// A policy: in large pieces it is checked square by square what is paid for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Parts {
    /// The side of a square of the window, in samples.
    pub side: u32,
    /// What may be left out of a square.
    pub rule: Rule,
}

/// What an item pays for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ItemPlan {
    /// Which planes cut a triangle. Planned: those that it crosses.
    pub clip: Mode,
    /// Whether the winding is asked for. Planned: where the item is culled.
    pub cull: Mode,
    /// Attributes that travel from the corners to the pieces.
    pub carries: Attributes,
    /// The plan of each piece, in drawing order.
    pub pieces: Pieces,
    /// A policy for parts of large pieces; without one they pay everywhere for what the piece pays for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parts: Option<Parts>,
}

/// In which order pieces are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// As they are submitted.
    Submission,
    /// From the farthest to the nearest mean depth of the corners.
    FarthestFirst,
}

/// Which samples forget last frame's colours.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Clear {
    Nothing,
    Everything,
    /// Those of the rectangles of the window.
    #[serde(deserialize_with = "tiles")]
    Tiles(Vec<PixelRect>),
}

/// Reads rectangles. Not in `grid`, whose text stands in certificates of other matters.
fn tiles<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Vec<PixelRect>, D::Error> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Sides {
        x0: i32,
        y0: i32,
        x1: i32,
        y1: i32,
    }
    let all = Vec::<Sides>::deserialize(from)?;
    Ok(all.into_iter().map(|Sides { x0, y0, x1, y1 }| PixelRect { x0, y0, x1, y1 }).collect())
}

/// How the samples of a pixel are treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Samples {
    Each,
    /// One in the middle of the pixel, whatever the target has.
    Middle,
    /// A policy: a pixel is one until something needs its samples told apart. That costs more than
    /// it saves in small pieces, whose box is told apart at once.
    #[serde(rename_all = "kebab-case")]
    OnDemand {
        /// Pieces of one colour whose box has no more pixels are small.
        flat_px: u64,
        /// Pieces with attributes that vary whose box has fewer columns are small. Supersampled,
        /// all of them are: each sample has a colour of its own.
        varying_columns: u32,
    },
}

impl Samples {
    /// Whether the policy tells all pixels of a piece apart at once; `touched` are those it may touch.
    #[inline]
    pub(super) fn tells_apart(self, touched: PixelRect, plan: PiecePlan, planes: usize) -> bool {
        let Self::OnDemand { flat_px, varying_columns } = self else { return false };
        // Each sample has an opacity of its own.
        if !plan.replaces_all() {
            return !plan.is_nothing();
        }
        if plan.is_one_colour() {
            let area = u64::from(touched.width()) * u64::from(touched.height());
            plan.depth && area <= flat_px
        } else {
            planes == 1 || touched.width() < varying_columns
        }
    }
}

/// What the frame pays for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FramePlan {
    /// In which order pieces are drawn.
    pub order: Order,
    /// Planned: the narrowest integers that hold a piece. Always: the widest. Never: 32 bits.
    pub wide_words: Mode,
    /// How the samples of a pixel are treated.
    pub samples: Samples,
    /// Which colours are cleared. Samples on demand start with the background, uncleared.
    pub clear: Clear,
    /// Whether depths are cleared. Samples on demand start farthest away, uncleared.
    pub clear_depths: bool,
    /// Whether a viewer sees a copy of the finished frame alone.
    pub second_buffer: bool,
}

/// What the numbers of a [`Decision`] count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Unit {
    /// Triangles of the scene.
    Triangles,
    /// What is left of the triangles in the window.
    Pieces,
    /// Pixels of the picture.
    Pixels,
    /// Samples of all pixels.
    Samples,
}

impl Unit {
    /// Its name in a plan.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Triangles => "triangles",
            Self::Pieces => "pieces",
            Self::Pixels => "pixels",
            Self::Samples => "samples",
        }
    }
}

/// One line of a plan's account.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Decision {
    pub effect: Effect,
    /// The item it is about; of the whole frame where there is none.
    pub item: Option<usize>,
    pub unit: Unit,
    /// How many pay for it.
    pub on: u64,
    pub off: u64,
    /// Those that a policy decides about while the frame is drawn.
    pub open: u64,
    /// Why, to read.
    pub reason: String,
}

/// What a frame will pay for, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The form of the plan, [`VERSION`].
    pub version: u32,
    /// The scene that the plan was made for. Nothing in the plan that a frame reports: plan and frame
    /// are of one scene there, and to take the digest would cost more than some plans save. Such a plan
    /// cannot be executed.
    pub scene: Option<SceneDigest>,
    pub canvas: Canvas,
    pub frame: FramePlan,
    pub items: Vec<ItemPlan>,
    /// The account for people, which is not followed and may be missing.
    #[serde(default)]
    pub decisions: Vec<Decision>,
}

impl ItemPlan {
    /// The attributes that some piece interpolates.
    pub(super) fn interpolates(&self) -> Attributes {
        match &self.pieces {
            Pieces::AsTheyCome(rule) => rule.interpolates,
            Pieces::Listed(runs) => {
                Attributes(runs.iter().fold(0, |bits, (_, plan)| bits | plan.interpolates.0))
            }
        }
    }
}

impl Plan {
    /// Whether any piece compares depths.
    #[must_use]
    pub fn tests_depths(&self) -> bool {
        self.items.iter().any(|item| match &item.pieces {
            Pieces::Listed(runs) => runs.iter().any(|(_, plan)| plan.depth),
            Pieces::AsTheyCome(rule) => rule.depth,
        })
    }

    /// What pieces are drawn into: one sample a pixel where only the middle is asked for.
    #[must_use]
    pub fn drawn(&self) -> Canvas {
        match self.frame.samples {
            Samples::Middle => Canvas { antialias: Antialias::None, ..self.canvas },
            Samples::Each | Samples::OnDemand { .. } => self.canvas,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_of_attributes_are_lists_of_names() {
        for bits in 0..16 {
            let set = Attributes(bits);
            let text = serde_json::to_string(&set).unwrap();
            assert_eq!(serde_json::from_str::<Attributes>(&text).unwrap(), set);
            assert_eq!(text.matches('"').count() as u32, 2 * bits.count_ones());
        }
        assert_eq!(serde_json::to_string(&Attributes(5)).unwrap(), r#"["colour","uv"]"#);
        assert!(serde_json::from_str::<Attributes>(r#"["hue"]"#).is_err());
    }

    /// One colour, opaque and written everywhere are three matters: each plan here has two of them.
    #[test]
    fn facts_of_a_plan_are_apart() {
        let plain = PiecePlan::default();
        let facts = |plan: PiecePlan| [plan.is_one_colour(), plan.is_opaque(), plan.writes_all()];
        assert_eq!(facts(plain), [true; 3]);
        let coloured = PiecePlan { interpolates: Attributes(Attributes::COLOUR), ..plain };
        let foggy = PiecePlan { fog: Share::Mixed, ..plain };
        for plan in [coloured, foggy] {
            assert_eq!(facts(plan), [false, true, true]);
            assert!(plan.replaces_all());
        }
        let glass = PiecePlan { blending: Drawn::Mixed, ..plain };
        let holes = PiecePlan { alpha_test: Drawn::Mixed, ..plain };
        assert_eq!([glass, holes].map(facts), [[true, false, true], [true, true, false]]);
        assert_eq!([glass, holes].map(PiecePlan::replaces_all), [false; 2]);
        assert!(!facts(PiecePlan { fog: Share::Whole, ..coloured })[0]);
        assert!(facts(PiecePlan { fog: Share::Whole, ..plain })[0]);
    }

    #[test]
    fn a_misspelt_word_of_a_plan_is_refused() {
        let plan = PiecePlan {
            interpolates: Attributes(5),
            perspective: true,
            specular: true,
            alpha_test: Drawn::Mixed,
            ..PiecePlan::default()
        };
        let text = serde_json::to_string(&plan).unwrap();
        assert_eq!(serde_json::from_str::<PiecePlan>(&text).unwrap(), plan);
        let error = serde_json::from_str::<PiecePlan>(&text.replace("depth", "depht")).unwrap_err();
        assert!(error.to_string().contains("depht"), "{error}");
    }
}
