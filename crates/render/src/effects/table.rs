//! The effects in one table: a new one is a row here.

use super::Mode;
use crate::pipeline::Counters;

macro_rules! effects {
    ($($(#[$about:meta])* $effect:ident = $name:literal: $usual:ident, $calls:ident, $colour:expr;)+) => {
        /// Something that costs time and that not every scene needs.
        #[derive(
            Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
        )]
        #[serde(rename_all = "kebab-case")]
        pub enum Effect {
            $($(#[$about])* $effect,)+
        }

        impl Effect {
            /// All effects, in the order of the pipeline.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$effect),+];

            /// When a renderer without a planner pays for each.
            pub(super) const USUAL: [Mode; Self::ALL.len()] = [$(Mode::$usual),+];

            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$effect => $name,)+
                }
            }

            /// What it costs, by a count that is 0 where it is off.
            #[must_use]
            pub fn calls(self, counters: &Counters) -> u64 {
                match self {
                    $(Self::$effect => counters.$calls,)+
                }
            }

            /// Its colour in a map of the pixels that pay for it, where pixels pay one by one and a map shows it.
            #[must_use]
            pub fn map_colour(self) -> Option<[u8; 3]> {
                match self {
                    $(Self::$effect => $colour,)+
                }
            }
        }
    };
}

// Each row: the name on the command line, the usual mode, the counter and the colour in a map.
effects! {
    /// Cutting triangles by the seven planes.
    Clip = "clip": Planned, plane_tests, None;
    /// Asking for the winding.
    Cull = "cull": Planned, cull_tests, None;
    /// Deciding coverage in integers of more than 32 bits.
    WideWords = "wide-words": Planned, wide, None;
    /// The division by 1/w in each fragment.
    Perspective = "perspective": Always, divisions, Some([225, 70, 70]);
    /// Comparing with the depth buffer and writing to it.
    Depth = "depth": Always, depth_tests, Some([80, 130, 240]);
    /// Having a depth buffer at all: clearing it before the frame.
    DepthBuffer = "depth-buffer": Always, depths_cleared, None;
    /// The colours of corners. They are counted with all other attributes.
    Colour = "colour": Planned, components, Some([215, 195, 40]);
    /// Light, and the normals it needs.
    Light = "light": Planned, lights, Some([60, 180, 90]);
    /// Highlights of shiny materials, and the normals they need.
    Specular = "specular": Material, highlights, Some([240, 190, 60]);
    /// What metal and roughness reflect, and from where it is seen.
    Reflection = "reflection": Material, reflections, Some([245, 130, 160]);
    /// Adding the light of directions, points and cones.
    PunctualLights = "punctual-lights": Material, punctual, Some([255, 225, 60]);
    /// Turning normals by a map, and the tangents they need.
    NormalMaps = "normal-maps": Material, bumped, Some([130, 130, 250]);
    /// Multiplying ambient light by a map.
    Occlusion = "occlusion": Material, occluded, Some([120, 90, 60]);
    /// Adding emission.
    Emission = "emission": Material, emitted, Some([250, 235, 120]);
    /// Looking up whether the light reaches a fragment, and the shadow map.
    Shadows = "shadows": Material, shadowed, Some([150, 110, 160]);
    /// Texture lookup, and the coordinates it needs.
    Texture = "texture": Planned, texels, Some([190, 90, 205]);
    /// Reading textures at a level of detail.
    MipMaps = "mip-maps": Material, levels, Some([160, 130, 90]);
    /// Reading textures several times along the longer axis of a pixel's footprint.
    Anisotropy = "anisotropy": Material, taps, Some([200, 120, 120]);
    /// Mixing colours with that of the fog, by distance.
    Fog = "fog": Material, fogged, Some([120, 200, 200]);
    /// Leaving out fragments that are not opaque enough.
    AlphaTest = "alpha-test": Material, alpha_tests, Some([110, 160, 40]);
    /// Mixing fragments with what is behind them.
    Blending = "blending": Material, blended, Some([90, 190, 240]);
    /// Bringing mixed fragments into the order of their depths.
    Layers = "layers": Material, layers, Some([60, 120, 200]);
    /// Interpolating an attribute, and computing what depends on it, in each fragment.
    Interpolation = "interpolation": Material, components, None;
    /// Telling the samples of a supersampled or multisampled pixel apart.
    Samples = "samples": Always, expanded, Some([235, 140, 30]);
    /// Clearing the colours before the frame.
    Clear = "clear": Always, cleared, None;
    /// A front buffer that never shows an unfinished frame.
    SecondBuffer = "second-buffer": Planned, presented, None;
}

/// Gives the effects of single fragments to a macro, in the order of [`Effect::ALL`].
///
/// Each row: the field in a plan, a rule and the facts, what in it pays, the effect, where a planned rule says so, and the condition
/// in `conditions`. The fragments of a piece pay where a `fact` of it is true or not known, or as much as a function says `by` the
/// rule and all facts.
macro_rules! fragment_effects {
    ($for_each:ident) => {
        $for_each! {
            /// Whether the material's highlight is computed and added.
            specular: bool = true => Specular, "where a highlight may show between the normals of the corners.",
                specular::CONDITION, fact is_shiny;
            /// Whether it is computed what metal and roughness reflect; else the surface is matt.
            reflection: bool = true => Reflection, "where a normal may face the light.",
                physical::REFLECTION, fact is_reflecting;
            /// Whether punctual lights are added.
            punctual: bool = true => PunctualLights, "where the light may arrive and a normal may face it.",
                physical::PUNCTUAL, fact is_reached;
            /// Whether normals are turned by a map.
            normal_maps: bool = true => NormalMaps, "where the map is not known to be flat.",
                physical::NORMAL_MAPS, fact is_bumpy;
            /// Whether ambient light is multiplied by an occlusion.
            occlusion: bool = true => Occlusion, "where the map is not known to be white.",
                physical::OCCLUSION, fact is_occluded;
            /// Whether emission is added.
            emission: bool = true => Emission, "where the map is not known to be black.",
                physical::EMISSION, fact is_emitting;
            /// Whether it is looked up which part of the light arrives.
            shadows: bool = true => Shadows, "where something may lie between a piece and the light.",
                shadows::CONDITION, fact is_shadowed;
            /// Whether textures are read at a level of detail.
            mip_maps: bool = true => MipMaps, "where a texture is not known to be magnified everywhere.",
                mip_maps::CONDITION, fact is_minified;
            /// Whether textures may be read several times along the longer axis of a footprint.
            anisotropy: bool = true => Anisotropy,
                "where the axes of a footprint are not known to be about as long everywhere.",
                anisotropy::CONDITION, fact is_stretched;
            /// Whether its fragments are mixed with fog, or show nothing else.
            fog: Share = Share::Mixed => Fog, "as much as there is between the depths of the corners.",
                fog::CONDITION, by fog::share;
            /// Whether the opacity of its fragments is compared with a threshold, or is below it everywhere.
            alpha_test: Drawn = Drawn::Mixed => AlphaTest,
                "where the opacities that a piece may read lie on both sides of the threshold.",
                alpha_test::CONDITION, by alpha_test::share;
            /// Whether its fragments are mixed with what is behind them, or cover nothing of it.
            blending: Drawn = Drawn::Mixed => Blending,
                "where a piece may read an opacity that is neither 0 nor 255.",
                blending::CONDITION, by blending::share;
            /// Whether fragments that are mixed are kept, and mixed in the order of their depths when all is drawn.
            layers: bool = true => Layers, "where fragments are mixed and their depths tested, whatever else is there.",
                layers::CONDITION, fact meets_blended;
        }
    };
}
pub(super) use fragment_effects;
