//! What a frame cost, in counts that do not depend on the machine.

macro_rules! counters {
    ($($(#[$about:meta])* $name:ident $(= $shown:literal)?;)+) => {
        /// What a frame cost, in deterministic counts. A count of an effect that is switched off is 0.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
        pub struct Counters {
            $($(#[$about])* pub $name: u64,)+
        }

        impl std::ops::AddAssign for Counters {
            fn add_assign(&mut self, other: Self) {
                $(self.$name += other.$name;)+
            }
        }

        impl Counters {
            /// The counts that show what a plan saves, with what they are called.
            #[must_use]
            pub fn shown(&self) -> Vec<(&'static str, u64)> {
                vec![$($(($shown, self.$name),)?)+]
            }
        }
    };
}

// Those with a name are shown in what a plan costs.
counters! {
    /// Runs of the vertex stage.
    vertices;
    /// Triangles that came in.
    triangles;
    /// Tests of a vertex of a triangle against one clip plane, beyond the outcodes.
    plane_tests = "plane tests";
    /// Triangles that lay outside one of the planes altogether.
    rejected;
    /// Triangles that a plane cut.
    clipped;
    /// Triangles in the window after clipping; a cut one may become several.
    pieces;
    /// Pieces whose winding was asked for.
    cull_tests = "winding tests";
    /// Pieces that culling removed.
    culled;
    /// Pieces decided in integers of more than 32 bits, by an engine that has several widths.
    wide = "wide words";
    /// Fragments (samples, where supersampled) that the rasterizer emitted.
    fragments = "fragments";
    /// Fragments of pieces that need a division by 1/w; it is done for those that are seen.
    divisions = "divisions by 1/w";
    /// Attribute components of the fragments; interpolated are those of fragments that are seen.
    components = "components";
    /// Depth values compared with the buffer.
    depth_tests = "depth tests";
    /// Fragments that lay behind what was there.
    depth_failed;
    /// Texture lookups.
    texels = "texels";
    /// Texture lookups whose level of detail was computed.
    levels = "levels of detail";
    /// Times that a texture was read by lookups that read it several times where a footprint has a longer axis.
    taps = "taps";
    /// Evaluations of the light.
    lights = "lights";
    /// Evaluations of a highlight.
    highlights = "highlights";
    /// Evaluations of what metal and roughness reflect.
    reflections = "reflections";
    /// Fragments to which the light of directions, points and cones was added.
    punctual = "lit by punctual lights";
    /// Fragments whose normal was turned by a map.
    bumped = "normals turned";
    /// Fragments whose ambient light was multiplied by an occlusion.
    occluded = "occlusions";
    /// Fragments to which emission was added.
    emitted = "emissions";
    /// Fragments that read the shadow map.
    shadowed = "shadow lookups";
    /// Fragments that were drawn into the shadow map.
    cast = "shadow map drawn";
    /// Fragments that were mixed with fog.
    fogged = "mixed with fog";
    /// Visible fragments whose opacity was compared with a threshold.
    alpha_tests = "alpha tests";
    /// Visible fragments whose opacity was computed to mix them with what is behind them.
    blended = "blended";
    /// Mixed fragments that were kept to be brought into the order of their depths.
    layers = "layers";
    /// Layers that were not drawn, since as many as a sample may have lay in front of them.
    layers_left_out = "layers left out";
    /// Evaluations of the whole fragment stage.
    shaded = "fragment stages";
    /// Pixels whose samples were told apart by antialiasing.
    expanded = "pixels expanded";
    /// Samples whose colours were cleared.
    cleared = "samples cleared";
    /// Samples whose depths were cleared.
    depths_cleared = "depths cleared";
    /// Pixels copied from the back to the front buffer.
    presented = "pixels presented";
}
