//! The pipeline of the book's chapters 4 to 11 around a rasterizer: transform, clip, cull, viewport,
//! depth, shade, resolve.
//!
//! Every stage takes values and returns values, is generic over the rasterizer, and names none.
//! Conventions, stated once: object, world and camera space are left-handed, x right, y up, z away
//! from the eye (the book's); matrices multiply columns, `projection * view * model * p`; clip
//! space keeps -w <= x, y, z <= w; the window has x right and y **down**; window depth is 0 at the
//! near plane and 1 at the far plane. Counter-clockwise is what the eye sees.

pub mod assemble;
pub mod clip;
pub mod depth;
pub mod draw;
pub mod fill;
pub mod fog;
pub mod footprint;
pub mod highlight;
pub mod multisample;
pub mod opacity;
pub mod present;
pub mod see_through;
pub mod shade;
pub mod target;
pub mod texture;
pub mod transform;
pub mod wireframe;

use glam::DVec4;

/// A vertex in clip space, as the vertex stage returns it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipVertex<V> {
    /// x, y, z, w, homogeneous; visible where -w <= x, y, z <= w.
    pub position: DVec4,
    /// What the fragment stage wants to know, linear in space.
    pub varying: V,
}

/// What a frame cost, in deterministic counts. A count of an effect that is switched off is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Counters {
    /// Runs of the vertex stage.
    pub vertices: u64,
    /// Triangles that came in.
    pub triangles: u64,
    /// Tests of a vertex of a triangle against one clip plane, beyond the outcodes.
    pub plane_tests: u64,
    /// Triangles that lay outside one of the planes altogether.
    pub rejected: u64,
    /// Triangles that a plane cut.
    pub clipped: u64,
    /// Triangles in the window after clipping; a cut one may become several.
    pub pieces: u64,
    /// Pieces whose winding was asked for.
    pub cull_tests: u64,
    /// Pieces that culling removed.
    pub culled: u64,
    /// Pieces decided in integers of more than 32 bits, by an engine that has several widths.
    pub wide: u64,
    /// Fragments (samples, where supersampled) that the rasterizer emitted.
    pub fragments: u64,
    /// Fragments of pieces that need a division by 1/w; it is done for those that are seen.
    pub divisions: u64,
    /// Attribute components of the fragments; interpolated are those of fragments that are seen.
    pub components: u64,
    /// Depth values compared with the buffer.
    pub depth_tests: u64,
    /// Fragments that lay behind what was there.
    pub depth_failed: u64,
    /// Texture lookups.
    pub texels: u64,
    /// Texture lookups whose level of detail was computed.
    pub levels: u64,
    /// Evaluations of the light.
    pub lights: u64,
    /// Visible fragments whose opacity was compared with a threshold.
    pub alpha_tests: u64,
    /// Visible fragments whose opacity was computed to mix them with what is behind them.
    pub blended: u64,
    /// Evaluations of a highlight.
    pub highlights: u64,
    /// Fragments that were mixed with fog.
    pub fogged: u64,
    /// Evaluations of the whole fragment stage.
    pub shaded: u64,
    /// Samples whose colours were cleared.
    pub cleared: u64,
    /// Samples whose depths were cleared.
    pub depths_cleared: u64,
    /// Pixels copied from the back to the front buffer.
    pub presented: u64,
    /// Pixels whose samples were told apart by antialiasing.
    pub expanded: u64,
}

impl std::ops::AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.vertices += other.vertices;
        self.triangles += other.triangles;
        self.plane_tests += other.plane_tests;
        self.rejected += other.rejected;
        self.clipped += other.clipped;
        self.pieces += other.pieces;
        self.cull_tests += other.cull_tests;
        self.culled += other.culled;
        self.wide += other.wide;
        self.fragments += other.fragments;
        self.divisions += other.divisions;
        self.components += other.components;
        self.depth_tests += other.depth_tests;
        self.depth_failed += other.depth_failed;
        self.texels += other.texels;
        self.levels += other.levels;
        self.lights += other.lights;
        self.alpha_tests += other.alpha_tests;
        self.blended += other.blended;
        self.highlights += other.highlights;
        self.fogged += other.fogged;
        self.shaded += other.shaded;
        self.cleared += other.cleared;
        self.depths_cleared += other.depths_cleared;
        self.presented += other.presented;
        self.expanded += other.expanded;
    }
}
