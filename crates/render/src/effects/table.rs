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
