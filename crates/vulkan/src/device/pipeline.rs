//! The render pass and the pipelines of the pages of one kind.

use ash::vk;

use super::open::Opened;
use super::{Error, While as _};

/// What is drawn into: colours, depths or both. Where a pixel has several samples, their means come last.
#[derive(Clone, Copy)]
pub(super) struct Attachments {
    pub(super) colours: Option<vk::Format>,
    pub(super) depths: Option<vk::Format>,
    pub(super) samples: vk::SampleCountFlags,
}

impl Attachments {
    /// Clears and draws; the colours, their means or, where there are no colours, the depths are copied from then.
    pub(super) fn render_pass(self, device: &Opened) -> Result<vk::RenderPass, Error> {
        let Self { colours, depths, samples } = self;
        let one = vk::SampleCountFlags::TYPE_1;
        let colour = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
        let depth = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        let kept = vk::AttachmentDescription::default()
            .samples(one)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE)
            .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
            .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
            .initial_layout(vk::ImageLayout::UNDEFINED)
            .final_layout(vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
        let passing = kept.samples(samples).store_op(vk::AttachmentStoreOp::DONT_CARE);
        let mut all = Vec::new();
        if let Some(format) = colours {
            let drawn = if samples == one { kept } else { passing.final_layout(colour) };
            all.push(drawn.format(format));
        }
        if let Some(format) = depths {
            let drawn = if colours.is_none() { kept } else { passing.final_layout(depth) };
            all.push(drawn.format(format));
        }
        if let Some(format) = colours.filter(|_| samples != one) {
            all.push(kept.format(format).load_op(vk::AttachmentLoadOp::DONT_CARE));
        }
        let drawn = [vk::AttachmentReference { attachment: 0, layout: colour }];
        let means = [vk::AttachmentReference { attachment: all.len() as u32 - 1, layout: colour }];
        let hidden =
            vk::AttachmentReference { attachment: u32::from(colours.is_some()), layout: depth };
        let mut subpass =
            vk::SubpassDescription::default().pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS);
        if colours.is_some() {
            subpass = subpass.color_attachments(&drawn);
        }
        if depths.is_some() {
            subpass = subpass.depth_stencil_attachment(&hidden);
        }
        if samples != one {
            subpass = subpass.resolve_attachments(&means);
        }
        // Pictures are drawn and copied one after the other.
        let draws = vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT
            | vk::PipelineStageFlags::EARLY_FRAGMENT_TESTS
            | vk::PipelineStageFlags::LATE_FRAGMENT_TESTS;
        let writes = vk::AccessFlags::COLOR_ATTACHMENT_WRITE
            | vk::AccessFlags::DEPTH_STENCIL_ATTACHMENT_WRITE;
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
}

/// A square of images with these views, which the render pass describes.
pub(super) fn framebuffer(
    device: &Opened,
    render_pass: vk::RenderPass,
    views: &[vk::ImageView],
    side_px: u32,
) -> Result<vk::Framebuffer, Error> {
    let info = vk::FramebufferCreateInfo::default()
        .render_pass(render_pass)
        .attachments(views)
        .width(side_px)
        .height(side_px)
        .layers(1);
    // SAFETY: the callers pass views of images of this size, in the order of the render pass.
    unsafe { device.raw.create_framebuffer(&info, None) }.during("creating a framebuffer")
}

/// What a pipeline is made of. Viewport and scissor are set when it is used.
pub(super) struct Recipe<'a> {
    /// SPIR-V of the vertex and the fragment shader.
    pub(super) shaders: [&'a [u8]; 2],
    /// Bytes of a vertex, and what it consists of, each with its first byte.
    pub(super) stride: u32,
    pub(super) attributes: &'a [(vk::Format, u32)],
    pub(super) topology: vk::PrimitiveTopology,
    /// How lines are drawn; only where the device has such a choice.
    pub(super) line_mode: Option<vk::LineRasterizationModeEXT>,
    pub(super) attachments: Attachments,
    pub(super) sample_mask: u32,
    /// Whether what is drawn is added to what was there.
    pub(super) adds: bool,
    pub(super) layout: vk::PipelineLayout,
    pub(super) render_pass: vk::RenderPass,
}

impl Recipe<'_> {
    pub(super) fn make(&self, device: &Opened) -> Result<vk::Pipeline, Error> {
        let [vertex, fragment] = self.shaders;
        let vertex = shader(device, vertex)?;
        let fragment = shader(device, fragment).inspect_err(|_| {
            // SAFETY: nobody else knows the shader.
            unsafe { device.raw.destroy_shader_module(vertex, None) };
        })?;
        let stage = |module, stage| {
            vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(c"main")
        };
        let made = self.of_shaders(
            device,
            &[
                stage(vertex, vk::ShaderStageFlags::VERTEX),
                stage(fragment, vk::ShaderStageFlags::FRAGMENT),
            ],
        );
        // SAFETY: a pipeline does not need its shaders once it is made.
        unsafe {
            device.raw.destroy_shader_module(vertex, None);
            device.raw.destroy_shader_module(fragment, None);
        }
        made
    }

    fn of_shaders(
        &self,
        device: &Opened,
        shaders: &[vk::PipelineShaderStageCreateInfo<'_>],
    ) -> Result<vk::Pipeline, Error> {
        let bindings = [vk::VertexInputBindingDescription::default().stride(self.stride)];
        let attributes: Vec<_> = (0..)
            .zip(self.attributes)
            .map(|(location, &(format, offset))| vk::VertexInputAttributeDescription {
                location,
                binding: 0,
                format,
                offset,
            })
            .collect();
        let input = vk::PipelineVertexInputStateCreateInfo::default()
            .vertex_binding_descriptions(&bindings)
            .vertex_attribute_descriptions(&attributes);
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(self.topology);
        let viewport =
            vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let mut line = vk::PipelineRasterizationLineStateCreateInfoEXT::default()
            .line_rasterization_mode(self.line_mode.unwrap_or_default());
        let mut raster = vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(vk::PolygonMode::FILL)
            .cull_mode(vk::CullModeFlags::NONE)
            .line_width(1.0);
        if self.line_mode.is_some() {
            raster = raster.push_next(&mut line);
        }
        let masks = [self.sample_mask];
        let Attachments { colours, depths, samples } = self.attachments;
        let multisample = vk::PipelineMultisampleStateCreateInfo::default()
            .rasterization_samples(samples)
            .sample_mask(&masks);
        let blends = [vk::PipelineColorBlendAttachmentState::default()
            .color_write_mask(vk::ColorComponentFlags::RGBA)
            .blend_enable(self.adds)
            .src_color_blend_factor(vk::BlendFactor::ONE)
            .dst_color_blend_factor(vk::BlendFactor::ONE)
            .src_alpha_blend_factor(vk::BlendFactor::ONE)
            .dst_alpha_blend_factor(vk::BlendFactor::ONE)];
        let mut blend = vk::PipelineColorBlendStateCreateInfo::default();
        if colours.is_some() {
            blend = blend.attachments(&blends);
        }
        let depth = vk::PipelineDepthStencilStateCreateInfo::default()
            .depth_test_enable(depths.is_some())
            .depth_write_enable(depths.is_some())
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
            .layout(self.layout)
            .render_pass(self.render_pass);
        let none = vk::PipelineCache::null();
        // SAFETY: `info` and what it points to live during the call, and the callers pass a layout and a render pass
        // of this device; line modes are chosen only where the device has them (`Painter::draw`).
        let made = unsafe { device.raw.create_graphics_pipelines(none, &[info], None) };
        let made = made.map_err(|(_, result)| result).during("creating a pipeline")?;
        made.into_iter().next().ok_or(Error::Failed("creating a pipeline", "nothing".to_owned()))
    }
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
