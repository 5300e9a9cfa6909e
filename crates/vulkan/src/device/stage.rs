//! The kinds of pictures: what is written to a pixel, and the pipelines that write it.
//!
//! The shaders are SPIR-V beside their GLSL, compiled beforehand, so that a build needs no compiler of
//! shaders; a test compiles them anew and compares.

use std::sync::Arc;

use ash::vk;

use super::memory::{Image, Like};
use super::open::Opened;
use super::{Error, While as _};

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
    /// Bresenham lines: a byte of hits.
    BresenhamLines,
}

impl Kind {
    pub fn pixel_bytes(self) -> usize {
        match self {
            Self::Flat | Self::Depths => 4,
            Self::Depths16 => 2,
            Self::Values | Self::Linear => 16,
            _ => 1,
        }
    }

    /// Cells of a page, in rows and columns.
    pub(super) fn cells(self) -> u32 {
        if self == Self::Alone { 1 } else { CELLS }
    }

    pub(super) fn page_cells(self) -> usize {
        (self.cells() * self.cells()) as usize
    }

    /// Side of a page in pixels.
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

    fn is_depths(self) -> bool {
        matches!(self, Self::Depths16 | Self::Depths)
    }

    /// The value of a pixel that no triangle covers.
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

    fn samples(self) -> vk::SampleCountFlags {
        match self {
            Self::Samples => vk::SampleCountFlags::TYPE_4,
            _ => vk::SampleCountFlags::TYPE_1,
        }
    }

    fn fragment_shader(self) -> &'static [u8] {
        match self {
            Self::Values => include_bytes!("shaders/values.frag.spv"),
            Self::Linear => include_bytes!("shaders/linear.frag.spv"),
            _ => include_bytes!("shaders/hit.frag.spv"),
        }
    }

    /// What each pass of drawing adds to a pixel, and the samples it draws. Resolving takes the mean
    /// of four samples, so that 4 x 2^s in sample s alone comes out as 2^s.
    fn passes(self) -> Vec<(f32, u32)> {
        match self {
            Self::Samples => (0..4).map(|s| ((4 << s) as f32 / 255.0, 1 << s)).collect(),
            Self::Flat => vec![(1.0, u32::MAX)],
            _ => vec![(1.0 / 255.0, u32::MAX)],
        }
    }
}

/// A pipeline, and what it adds to a pixel.
pub(super) struct Pass {
    pub(super) pipeline: vk::Pipeline,
    pub(super) step: f32,
}

/// A page of one kind with everything that draws into it.
pub(super) struct Stage {
    device: Arc<Opened>,
    pub(super) render_pass: vk::RenderPass,
    pub(super) framebuffer: vk::Framebuffer,
    pub(super) layout: vk::PipelineLayout,
    pub(super) passes: Vec<Pass>,
    /// What is copied from: the page, resolved where it has samples.
    pub(super) page: Image,
    // What is drawn into where that is another one.
    _samples: Option<Image>,
}

impl Drop for Stage {
    fn drop(&mut self) {
        let raw = &self.device.raw;
        // SAFETY: nothing is in use by the device between calls, null handles are allowed, and the
        // images go after the framebuffer that shows them.
        unsafe {
            self.passes.iter().for_each(|pass| raw.destroy_pipeline(pass.pipeline, None));
            raw.destroy_pipeline_layout(self.layout, None);
            raw.destroy_framebuffer(self.framebuffer, None);
            raw.destroy_render_pass(self.render_pass, None);
        }
    }
}

impl Stage {
    pub(super) fn new(device: &Arc<Opened>, kind: Kind) -> Result<Self, Error> {
        let one = vk::SampleCountFlags::TYPE_1;
        let samples = match kind.samples() {
            samples if samples == one => None,
            samples => {
                Some(Image::new(device, Like::drawn(kind.format(), kind.page_px(), samples))?)
            }
        };
        let mut stage = Self {
            device: Arc::clone(device),
            render_pass: vk::RenderPass::null(),
            framebuffer: vk::Framebuffer::null(),
            layout: vk::PipelineLayout::null(),
            passes: Vec::new(),
            page: Image::new(device, Like::drawn(kind.format(), kind.page_px(), one))?,
            _samples: samples,
        };
        // Filled field by field: what fails is dropped with what was made before it.
        stage.render_pass = render_pass(device, kind)?;
        let views: Vec<_> = stage._samples.iter().chain([&stage.page]).map(|i| i.view).collect();
        let info = vk::FramebufferCreateInfo::default()
            .render_pass(stage.render_pass)
            .attachments(&views)
            .width(kind.page_px())
            .height(kind.page_px())
            .layers(1);
        // SAFETY: the views are those that the render pass describes, of this size.
        let framebuffer = unsafe { device.raw.create_framebuffer(&info, None) };
        stage.framebuffer = framebuffer.during("creating a framebuffer")?;
        let ranges = [vk::PushConstantRange {
            stage_flags: vk::ShaderStageFlags::FRAGMENT,
            offset: 0,
            size: 4,
        }];
        let info = vk::PipelineLayoutCreateInfo::default().push_constant_ranges(&ranges);
        // SAFETY: four bytes of constants are allowed everywhere.
        let layout = unsafe { device.raw.create_pipeline_layout(&info, None) };
        stage.layout = layout.during("creating a pipeline layout")?;
        for (step, mask) in kind.passes() {
            let pipeline = pipeline(&stage, kind, mask)?;
            stage.passes.push(Pass { pipeline, step });
        }
        Ok(stage)
    }
}

fn render_pass(device: &Opened, kind: Kind) -> Result<vk::RenderPass, Error> {
    let drawn = vk::AttachmentDescription::default()
        .format(kind.format())
        .samples(kind.samples())
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE)
        .initial_layout(vk::ImageLayout::UNDEFINED)
        .final_layout(vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
    let has_samples = kind.samples() != vk::SampleCountFlags::TYPE_1;
    let layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    let mut all = vec![drawn];
    if has_samples {
        all.push(
            drawn.samples(vk::SampleCountFlags::TYPE_1).load_op(vk::AttachmentLoadOp::DONT_CARE),
        );
        all[0] = drawn.store_op(vk::AttachmentStoreOp::DONT_CARE).final_layout(layout);
    }
    let colours = [vk::AttachmentReference { attachment: 0, layout }];
    let resolved = [vk::AttachmentReference { attachment: 1, layout }];
    let depths = vk::AttachmentReference {
        attachment: 0,
        layout: vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
    };
    let mut subpass =
        vk::SubpassDescription::default().pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS);
    subpass = match kind.is_depths() {
        true => subpass.depth_stencil_attachment(&depths),
        false => subpass.color_attachments(&colours),
    };
    if has_samples {
        subpass = subpass.resolve_attachments(&resolved);
    }
    // Pages are drawn and copied one after the other.
    let draws = vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT
        | vk::PipelineStageFlags::EARLY_FRAGMENT_TESTS
        | vk::PipelineStageFlags::LATE_FRAGMENT_TESTS;
    let writes =
        vk::AccessFlags::COLOR_ATTACHMENT_WRITE | vk::AccessFlags::DEPTH_STENCIL_ATTACHMENT_WRITE;
    let tests =
        vk::AccessFlags::COLOR_ATTACHMENT_READ | vk::AccessFlags::DEPTH_STENCIL_ATTACHMENT_READ;
    let (copies, reads) = (vk::PipelineStageFlags::TRANSFER, vk::AccessFlags::TRANSFER_READ);
    let before = vk::SubpassDependency::default()
        .src_subpass(vk::SUBPASS_EXTERNAL)
        .src_stage_mask(copies | draws)
        .src_access_mask(reads | writes)
        .dst_stage_mask(draws)
        .dst_access_mask(writes | tests);
    let after = vk::SubpassDependency::default()
        .dst_subpass(vk::SUBPASS_EXTERNAL)
        .src_stage_mask(draws)
        .src_access_mask(writes)
        .dst_stage_mask(copies)
        .dst_access_mask(reads);
    let (subpasses, dependencies) = ([subpass], [before, after]);
    let info = vk::RenderPassCreateInfo::default()
        .attachments(&all)
        .subpasses(&subpasses)
        .dependencies(&dependencies);
    // SAFETY: `info` and what it points to live during the call.
    unsafe { device.raw.create_render_pass(&info, None) }.during("creating a render pass")
}

fn shader(device: &Opened, bytes: &[u8]) -> Result<vk::ShaderModule, Error> {
    let words: Vec<u32> = bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect();
    let info = vk::ShaderModuleCreateInfo::default().code(&words);
    // SAFETY: the words are SPIR-V that glslang wrote, kept beside the source.
    unsafe { device.raw.create_shader_module(&info, None) }.during("loading a shader")
}

fn pipeline(stage: &Stage, kind: Kind, sample_mask: u32) -> Result<vk::Pipeline, Error> {
    let shaders = [include_bytes!("shaders/draw.vert.spv"), kind.fragment_shader()];
    with_shaders(&stage.device, shaders, |stages| of_kind(stage, kind, sample_mask, stages))
}

/// What is made from a vertex and a fragment shader, which are not needed afterwards.
pub(super) fn with_shaders(
    device: &Opened,
    [vertex, fragment]: [&[u8]; 2],
    make: impl FnOnce(&[vk::PipelineShaderStageCreateInfo<'_>]) -> Result<vk::Pipeline, Error>,
) -> Result<vk::Pipeline, Error> {
    let vertex = shader(device, vertex)?;
    let fragment = shader(device, fragment).inspect_err(|_| {
        // SAFETY: nobody else knows the shader.
        unsafe { device.raw.destroy_shader_module(vertex, None) };
    })?;
    let stage = |module, stage| {
        vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(c"main")
    };
    let made = make(&[
        stage(vertex, vk::ShaderStageFlags::VERTEX),
        stage(fragment, vk::ShaderStageFlags::FRAGMENT),
    ]);
    // SAFETY: a pipeline does not need its shaders once it is made.
    unsafe {
        device.raw.destroy_shader_module(vertex, None);
        device.raw.destroy_shader_module(fragment, None);
    }
    made
}

/// Bytes of a vertex: clip coordinates and two attributes, six f32.
pub(super) const VERTEX_BYTES: u32 = 24;

fn of_kind(
    stage: &Stage,
    kind: Kind,
    sample_mask: u32,
    shaders: &[vk::PipelineShaderStageCreateInfo<'_>],
) -> Result<vk::Pipeline, Error> {
    let bindings = [vk::VertexInputBindingDescription::default().stride(VERTEX_BYTES)];
    let attribute = |location, format, offset| vk::VertexInputAttributeDescription {
        location,
        binding: 0,
        format,
        offset,
    };
    let attributes = [
        attribute(0, vk::Format::R32G32B32A32_SFLOAT, 0),
        attribute(1, vk::Format::R32G32_SFLOAT, 16),
    ];
    let input = vk::PipelineVertexInputStateCreateInfo::default()
        .vertex_binding_descriptions(&bindings)
        .vertex_attribute_descriptions(&attributes);
    let topology = match kind.corners() {
        2 => vk::PrimitiveTopology::LINE_LIST,
        _ => vk::PrimitiveTopology::TRIANGLE_LIST,
    };
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(topology);
    let viewport =
        vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
    let mut line = vk::PipelineRasterizationLineStateCreateInfoEXT::default()
        .line_rasterization_mode(match kind {
            Kind::BresenhamLines => vk::LineRasterizationModeEXT::BRESENHAM,
            _ => vk::LineRasterizationModeEXT::RECTANGULAR,
        });
    let mut raster = vk::PipelineRasterizationStateCreateInfo::default()
        .polygon_mode(vk::PolygonMode::FILL)
        .cull_mode(vk::CullModeFlags::NONE)
        .line_width(1.0);
    if matches!(kind, Kind::RectangularLines | Kind::BresenhamLines) {
        raster = raster.push_next(&mut line);
    }
    let masks = [sample_mask];
    let multisample = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(kind.samples())
        .sample_mask(&masks);
    let adds = vk::PipelineColorBlendAttachmentState::default()
        .color_write_mask(vk::ColorComponentFlags::RGBA)
        .blend_enable(kind.pixel_bytes() == 1)
        .src_color_blend_factor(vk::BlendFactor::ONE)
        .dst_color_blend_factor(vk::BlendFactor::ONE)
        .src_alpha_blend_factor(vk::BlendFactor::ONE)
        .dst_alpha_blend_factor(vk::BlendFactor::ONE);
    let blends = [adds];
    let mut blend = vk::PipelineColorBlendStateCreateInfo::default();
    if !kind.is_depths() {
        blend = blend.attachments(&blends);
    }
    let depth = vk::PipelineDepthStencilStateCreateInfo::default()
        .depth_test_enable(kind.is_depths())
        .depth_write_enable(kind.is_depths())
        .depth_compare_op(vk::CompareOp::LESS);
    let states = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
    let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&states);
    let info = vk::GraphicsPipelineCreateInfo::default()
        .stages(shaders)
        .vertex_input_state(&input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&raster)
        .multisample_state(&multisample)
        .depth_stencil_state(&depth)
        .color_blend_state(&blend)
        .dynamic_state(&dynamic)
        .layout(stage.layout)
        .render_pass(stage.render_pass);
    // SAFETY: `info` and what it points to live during the call, and the layout and the render pass
    // are of this device; line modes are chosen only where the device has them (`Painter::draw`).
    unsafe { create_pipeline(&stage.device, &info) }
}

/// Makes a pipeline.
///
/// # Safety
/// What `info` points to is alive and of this device.
pub(super) unsafe fn create_pipeline(
    device: &Opened,
    info: &vk::GraphicsPipelineCreateInfo<'_>,
) -> Result<vk::Pipeline, Error> {
    let (none, infos) = (vk::PipelineCache::null(), std::slice::from_ref(info));
    // SAFETY: the caller sees to it.
    let made = unsafe { device.raw.create_graphics_pipelines(none, infos, None) };
    let made = made.map_err(|(_, result)| result).during("creating a pipeline")?;
    made.into_iter().next().ok_or(Error::Failed("creating a pipeline", "nothing".to_owned()))
}
