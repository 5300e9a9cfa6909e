//! Effects on demand: what a scene calls for is paid, the rest is switched off, and the picture stays
//! the same to the bit.
//!
//! For each [`Effect`] there is a condition that is sufficient to leave it out, known per frame, per
//! item or per triangle (`conditions` has one file for each). [`render::plan`] asks them and returns
//! a [`plan::Plan`], which is data; [`render::execute`] draws by it, with kernels without what is
//! left out. A condition that is merely likely does not count: planned and everything-on pictures are compared bit for
//! bit in the tests, and for every condition a scene that violates it by the least amount changes
//! a pixel when the effect is left out nevertheless.
//!
//! Leaving out the back faces of a closed mesh is *not* inferred: where front and back meet at the
//! silhouette their depths may tie, so it can change a pixel. Culling stays something to ask for.

mod assembled;
mod conditions;
pub mod depth_ties;
mod execute;
#[cfg(feature = "parallel")]
pub mod geometry;
mod kernel;
pub mod plan;
mod planner;
pub mod primitive;
pub mod render;
mod samples;
mod scene_digest;

use std::fmt;
use std::str::FromStr;

/// Something that costs time and that not every scene needs.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Effect {
    /// Cutting triangles by the seven planes.
    Clip,
    /// Asking for the winding.
    Cull,
    /// Deciding coverage in integers of more than 32 bits.
    WideWords,
    /// The division by 1/w in each fragment.
    Perspective,
    /// Comparing with the depth buffer and writing to it.
    Depth,
    /// Having a depth buffer at all: clearing it before the frame.
    DepthBuffer,
    /// The colours of corners.
    Colour,
    /// Light, and the normals it needs.
    Light,
    /// Highlights of shiny materials, and the normals they need.
    Specular,
    /// Texture lookup, and the coordinates it needs.
    Texture,
    /// Reading textures at a level of detail.
    MipMaps,
    /// Mixing colours with that of the fog, by distance.
    Fog,
    /// Leaving out fragments that are not opaque enough.
    AlphaTest,
    /// Mixing fragments with what is behind them.
    Blending,
    /// Interpolating an attribute, and computing what depends on it, in each fragment.
    Interpolation,
    /// Telling the samples of a supersampled or multisampled pixel apart.
    Samples,
    /// Clearing the colours before the frame.
    Clear,
    /// A front buffer that never shows an unfinished frame.
    SecondBuffer,
}

impl Effect {
    /// All effects, in the order of the pipeline.
    pub const ALL: [Self; 18] = [
        Self::Clip,
        Self::Cull,
        Self::WideWords,
        Self::Perspective,
        Self::Depth,
        Self::DepthBuffer,
        Self::Colour,
        Self::Light,
        Self::Specular,
        Self::Texture,
        Self::MipMaps,
        Self::Fog,
        Self::AlphaTest,
        Self::Blending,
        Self::Interpolation,
        Self::Samples,
        Self::Clear,
        Self::SecondBuffer,
    ];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Clip => "clip",
            Self::Cull => "cull",
            Self::WideWords => "wide-words",
            Self::Perspective => "perspective",
            Self::Depth => "depth",
            Self::DepthBuffer => "depth-buffer",
            Self::Colour => "colour",
            Self::Light => "light",
            Self::Specular => "specular",
            Self::Texture => "texture",
            Self::MipMaps => "mip-maps",
            Self::Fog => "fog",
            Self::AlphaTest => "alpha-test",
            Self::Blending => "blending",
            Self::Interpolation => "interpolation",
            Self::Samples => "samples",
            Self::Clear => "clear",
            Self::SecondBuffer => "second-buffer",
        }
    }
}

/// When an effect is paid for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Wherever it is called for.
    #[default]
    Planned,
    /// Wherever the material calls for it, whatever the triangles are like. Only interpolation, specular
    /// light, mip maps, fog, the alpha test and blending know the difference: a flat material needs no normal in the fragment.
    Material,
    /// Everywhere, called for or not.
    Always,
    /// Nowhere. Changes the picture wherever it is called for.
    Never,
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
    pub const USUAL: Self = Self::ALWAYS
        .with(Effect::Clip, Mode::Planned)
        .with(Effect::Cull, Mode::Planned)
        .with(Effect::WideWords, Mode::Planned)
        .with(Effect::Colour, Mode::Planned)
        .with(Effect::Light, Mode::Planned)
        .with(Effect::Specular, Mode::Material)
        .with(Effect::Texture, Mode::Planned)
        .with(Effect::MipMaps, Mode::Material)
        .with(Effect::Fog, Mode::Material)
        .with(Effect::AlphaTest, Mode::Material)
        .with(Effect::Blending, Mode::Material)
        .with(Effect::Interpolation, Mode::Material)
        .with(Effect::SecondBuffer, Mode::Planned);

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
        match self.mode(effect) {
            Mode::Planned | Mode::Material => called_for,
            Mode::Always => true,
            Mode::Never => false,
        }
    }
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
