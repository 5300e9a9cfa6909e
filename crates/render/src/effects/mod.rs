//! Effects on demand: what a scene calls for is paid, the rest is switched off, and the picture stays
//! the same to the bit.
//!
//! A scene becomes a picture in three steps. `survey` looks at its triangles and finds the facts of each piece, once.
//! `planner` asks the conditions, which read only these facts, and makes a [`plan::Plan`], which is data. `execute` draws by
//! it, by a list of stages for each piece (`stages`), in which what is left out is missing.
//!
//! For each [`Effect`] there is a condition that is sufficient to leave it out, known per frame, per
//! item or per triangle (`conditions` has one file for each). A condition that is merely likely does not count:
//! planned and everything-on pictures are compared bit for bit in the tests, and for every condition a scene that
//! violates it by the least amount changes a pixel when the effect is left out nevertheless.
//!
//! Leaving out the back faces of a closed mesh is *not* inferred: where front and back meet at the
//! silhouette their depths may tie, so it can change a pixel. Culling stays something to ask for.

mod assembled;
mod conditions;
pub mod depth_ties;
mod execute;
#[cfg(feature = "parallel")]
pub mod geometry;
pub mod parts;
pub mod plan;
mod planner;
pub mod primitive;
pub mod render;
mod samples;
mod scene_digest;
mod stages;
mod survey;
mod table;

use std::fmt;
use std::str::FromStr;

use conditions::account::ItemQuestion;
pub use table::Effect;

use crate::scene::{Item, Scene};

/// When an effect is paid for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Wherever it is called for.
    #[default]
    Planned,
    /// Wherever the material calls for it, whatever the triangles are like. Only effects that are usually
    /// paid for in this way know the difference: a flat material needs no normal in the fragment.
    Material,
    /// Everywhere, called for or not.
    Always,
    /// Nowhere. Changes the picture wherever it is called for.
    Never,
}

impl Mode {
    /// Whether an effect is paid for where `called_for` says so.
    #[must_use]
    pub fn pays(self, called_for: bool) -> bool {
        match self {
            Self::Planned | Self::Material => called_for,
            Self::Always => true,
            Self::Never => false,
        }
    }

    /// Whether it depends on what is drawn.
    #[must_use]
    pub fn is_open(self) -> bool {
        matches!(self, Self::Planned | Self::Material)
    }
}

/// A mode for each effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Effects {
    modes: [Mode; Effect::ALL.len()],
}

impl Effects {
    /// Everything where it is called for.
    pub const PLANNED: Self = Self { modes: [Mode::Planned; Effect::ALL.len()] };
    /// Everything everywhere.
    pub const ALWAYS: Self = Self { modes: [Mode::Always; Effect::ALL.len()] };
    /// What any sensible renderer does without a planner: triangles off the screen are left out, cut
    /// by the planes they cross, culled where asked; a shader for each material; and every fragment
    /// is tested once, before it is shaded.
    pub const USUAL: Self = Self { modes: Effect::USUAL };

    #[must_use]
    pub fn mode(&self, effect: Effect) -> Mode {
        self.modes[effect as usize]
    }

    /// The same with another mode for one effect.
    #[must_use]
    pub const fn with(mut self, effect: Effect, mode: Mode) -> Self {
        self.modes[effect as usize] = mode;
        self
    }

    /// Whether an effect is paid for where `called_for` says so.
    #[must_use]
    pub fn pays(&self, effect: Effect, called_for: bool) -> bool {
        self.mode(effect).pays(called_for)
    }
}

/// The effects of single fragments that an item asks for, by its material and its scene.
#[must_use]
pub fn asked_for(scene: &Scene, item: &Item) -> Vec<Effect> {
    let effects = &Effects::PLANNED;
    let carries = conditions::attributes::carries(scene, item, effects);
    let asked = ItemQuestion { scene, item, carries, effects };
    let mut all = Vec::new();
    for condition in conditions::ALL {
        if condition.mode(&asked) == Mode::Planned {
            all.push(condition.effect);
        }
    }
    all
}

/// A word of [`Effects::from_str`] that is none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoEffect(String);

impl fmt::Display for NoEffect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = Effect::ALL.map(Effect::name).join(", ");
        write!(
            f,
            "'{}' is none of: planned, usual, all, +EFFECT (always), -EFFECT (never); effects: {names}",
            self.0
        )
    }
}

impl std::error::Error for NoEffect {}

impl FromStr for Effects {
    type Err = NoEffect;

    /// `planned`, `usual`, `all`, and `+depth` or `-clip` for single effects, separated by commas; later
    /// words win.
    fn from_str(text: &str) -> Result<Self, NoEffect> {
        text.split(',').map(str::trim).try_fold(Self::PLANNED, |effects, word| {
            let named = |name: &str| Effect::ALL.into_iter().find(|effect| effect.name() == name);
            match (
                word,
                word.strip_prefix('+').and_then(named),
                word.strip_prefix('-').and_then(named),
            ) {
                ("planned", ..) => Ok(Self::PLANNED),
                ("usual", ..) => Ok(Self::USUAL),
                ("all", ..) => Ok(Self::ALWAYS),
                (_, Some(effect), _) => Ok(effects.with(effect, Mode::Always)),
                (_, _, Some(effect)) => Ok(effects.with(effect, Mode::Never)),
                _ => Err(NoEffect(word.to_owned())),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effects_from_words() {
        assert_eq!("planned".parse(), Ok(Effects::PLANNED));
        assert_eq!("usual".parse(), Ok(Effects::USUAL));
        assert_eq!("all".parse(), Ok(Effects::ALWAYS));
        let mixed: Effects = "all,-clip,+depth".parse().unwrap();
        assert_eq!(mixed, Effects::ALWAYS.with(Effect::Clip, Mode::Never));
        let mixed: Effects = "+depth".parse().unwrap();
        assert_eq!(mixed, Effects::PLANNED.with(Effect::Depth, Mode::Always));
        assert!("depht".parse::<Effects>().unwrap_err().to_string().contains("depth"));
        assert!("".parse::<Effects>().is_err());
    }

    #[test]
    fn names_are_the_indices() {
        for (i, effect) in Effect::ALL.into_iter().enumerate() {
            assert_eq!(effect as usize, i);
        }
    }
}
