//! The kinds of pictures: what is written to a pixel, and the pipelines that write it.
//!
//! The shaders are SPIR-V beside their GLSL, compiled beforehand, so that a build needs no compiler of
//! shaders; a test compiles them anew and compares.

use ash::vk;

/// Bytes of a vertex: clip coordinates and two attributes, six f32.
pub(super) const VERTEX_BYTES: u32 = 24;

/// Cells of most pages, in rows and columns.
const CELLS: u32 = 16;
/// Side of a cell in pixels: the largest window.
pub const CELL_PX: u32 = 64;
/// Side of most pages in pixels, and of the largest.
pub const PAGE_PX: u32 = CELLS * CELL_PX;

/// What is drawn, and what a pixel says of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Triangles: a byte, how often the pixel was hit. Blending adds.
    Hits,
    /// The same on pages of one cell: a picture that is no larger than the window, of which drivers
    /// leave out otherwise what lies beyond.
    Alone,
    /// Triangles: a byte, bit s for sample s of four.
    Samples,
    /// Triangles: four bytes, white and opaque, without blending.
    Flat,
    /// Triangles: four f32, depth, two attributes in perspective, 1 where it was drawn.
    Values,
    /// Triangles: four f32, 1/w, two attributes linear in the window, 1 where it was drawn.
    Linear,
    /// Triangles: the nearest depth in 16 bits, 65535 where there is none.
    Depths16,
    /// Triangles: the nearest depth in f32, 1 where there is none.
    Depths,
    /// Lines 1 px wide as the device draws them where nothing is asked for: a byte of hits.
    Lines,
    /// Rectangular lines: a byte of hits.
    RectangularLines,
    /// Bresenham lines, where the device offers them: a byte of hits.
    BresenhamLines,
}

impl Kind {
    /// Bytes that are read back for each pixel.
    pub fn pixel_bytes(self) -> usize {
        match self {
            Self::Flat | Self::Depths => 4,
            Self::Depths16 => 2,
            Self::Values | Self::Linear => 16,
            _ => 1,
        }
    }

    /// Cells along a side of a page.
    pub(super) fn cells(self) -> u32 {
        if self == Self::Alone { 1 } else { CELLS }
    }

    pub(super) fn page_cells(self) -> usize {
        (self.cells() * self.cells()) as usize
    }

    pub(super) fn page_px(self) -> u32 {
        self.cells() * CELL_PX
    }

    /// Vertices of a primitive.
    pub fn corners(self) -> u32 {
        if self.is_lines() { 2 } else { 3 }
    }

    fn is_lines(self) -> bool {
        matches!(self, Self::Lines | Self::RectangularLines | Self::BresenhamLines)
    }

    pub(super) fn is_depths(self) -> bool {
        matches!(self, Self::Depths16 | Self::Depths)
    }

    pub(super) fn aspect(self) -> vk::ImageAspectFlags {
        match self.is_depths() {
            true => vk::ImageAspectFlags::DEPTH,
            false => vk::ImageAspectFlags::COLOR,
        }
    }

    /// What a pixel has where nothing is drawn: no hit, or the farthest depth.
    pub(super) fn clear(self) -> vk::ClearValue {
        let farthest = vk::ClearDepthStencilValue { depth: 1.0, stencil: 0 };
        match self.is_depths() {
            true => vk::ClearValue { depth_stencil: farthest },
            false => vk::ClearValue::default(),
        }
    }

    pub(super) fn format(self) -> vk::Format {
        // Every device draws into these but f32 of depths, and blends in the one of a byte.
        match self {
            Self::Values | Self::Linear => vk::Format::R32G32B32A32_SFLOAT,
            Self::Flat => vk::Format::R8G8B8A8_UNORM,
            Self::Depths16 => vk::Format::D16_UNORM,
            Self::Depths => vk::Format::D32_SFLOAT,
            _ => vk::Format::R8_UNORM,
        }
    }

    pub(super) fn topology(self) -> vk::PrimitiveTopology {
        match self.is_lines() {
            true => vk::PrimitiveTopology::LINE_LIST,
            false => vk::PrimitiveTopology::TRIANGLE_LIST,
        }
    }

    /// How lines are drawn; nothing where the device decides, and for triangles.
    pub(super) fn line_mode(self) -> Option<vk::LineRasterizationModeEXT> {
        match self {
            Self::BresenhamLines => Some(vk::LineRasterizationModeEXT::BRESENHAM),
            Self::RectangularLines => Some(vk::LineRasterizationModeEXT::RECTANGULAR),
            _ => None,
        }
    }

    /// Samples of a pixel, which are told apart by drawing once for each.
    pub(super) fn samples(self) -> vk::SampleCountFlags {
        match self {
            Self::Samples => vk::SampleCountFlags::TYPE_4,
            _ => vk::SampleCountFlags::TYPE_1,
        }
    }

    /// Values are written by shaders of their own; all other kinds write that there was a hit.
    pub(super) fn fragment_shader(self) -> &'static [u8] {
        match self {
            Self::Values => include_bytes!("shaders/values.frag.spv"),
            Self::Linear => include_bytes!("shaders/linear.frag.spv"),
            _ => include_bytes!("shaders/hit.frag.spv"),
        }
    }

    /// What each pass of drawing adds to a pixel, and the samples it draws. Resolving takes the mean
    /// of four samples, so that 4 x 2^s in sample s alone comes out as 2^s.
    pub(super) fn passes(self) -> Vec<(f32, u32)> {
        match self {
            Self::Samples => (0..4).map(|s| ((4 << s) as f32 / 255.0, 1 << s)).collect(),
            Self::Flat => vec![(1.0, u32::MAX)],
            _ => vec![(1.0 / 255.0, u32::MAX)],
        }
    }
}
