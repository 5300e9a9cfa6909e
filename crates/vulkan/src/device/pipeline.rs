//! The render pass and the pipelines of the pages of one kind.

use ash::vk;

use super::kind::{Kind, VERTEX_BYTES};
use super::open::Opened;
use super::{Error, While as _};

/// Clears a page and draws into it. Where a pixel has several samples, their means are an image of their own, the last one.
pub(super) fn render_pass(device: &Opened, kind: Kind) -> Result<vk::RenderPass, Error> {
    let (one, samples) = (vk::SampleCountFlags::TYPE_1, kind.samples());
    let colour = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    let kept = vk::AttachmentDescription::default()
        .format(kind.format())
        .samples(one)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
        .initial_layout(vk::ImageLayout::UNDEFINED)
        .final_layout(vk::ImageLayout::TRANSFER_SRC_OPTIMAL);
    let passing =
        kept.samples(samples).store_op(vk::AttachmentStoreOp::DONT_CARE).final_layout(colour);
    let all = match samples == one {
        true => vec![kept],
        false => vec![passing, kept.load_op(vk::AttachmentLoadOp::DONT_CARE)],
    };
    let drawn = [vk::AttachmentReference { attachment: 0, layout: colour }];
    let means = [vk::AttachmentReference { attachment: 1, layout: colour }];
    let depths = vk::AttachmentReference {
        attachment: 0,
        layout: vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
    };
    let subpass =
        vk::SubpassDescription::default().pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS);
    let mut subpass = match kind.is_depths() {
        true => subpass.depth_stencil_attachment(&depths),
        false => subpass.color_attachments(&drawn),
    };
    if samples != one {
        subpass = subpass.resolve_attachments(&means);
    }
    // Pictures are drawn and copied one after the other.
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

/// A pipeline with this layout for the render pass of a page. Viewport and scissor are set when it is used.
pub(super) fn pipeline(
    device: &Opened,
    of_page: (vk::PipelineLayout, vk::RenderPass),
    kind: Kind,
    sample_mask: u32,
) -> Result<vk::Pipeline, Error> {
    let vertex = shader(device, include_bytes!("shaders/draw.vert.spv"))?;
    let fragment = shader(device, kind.fragment_shader()).inspect_err(|_| {
        // SAFETY: nobody else knows the shader.
        unsafe { device.raw.destroy_shader_module(vertex, None) };
    })?;
    // Both shaders run from a function of this name.
    let stage = |module, stage| {
        vk::PipelineShaderStageCreateInfo::default().stage(stage).module(module).name(c"main")
    };
    let stages = [
        stage(vertex, vk::ShaderStageFlags::VERTEX),
        stage(fragment, vk::ShaderStageFlags::FRAGMENT),
    ];
    let made = of_shaders(device, of_page, kind, sample_mask, &stages);
    // SAFETY: a pipeline does not need its shaders once it is made.
    unsafe {
        device.raw.destroy_shader_module(vertex, None);
        device.raw.destroy_shader_module(fragment, None);
    }
    made
}

/// The pipeline of two shaders. All states but viewport and scissor are part of it, so each kind has one of its own.
fn of_shaders(
    device: &Opened,
    (layout, render_pass): (vk::PipelineLayout, vk::RenderPass),
    kind: Kind,
    sample_mask: u32,
    shaders: &[vk::PipelineShaderStageCreateInfo<'_>],
) -> Result<vk::Pipeline, Error> {
    let bindings = [vk::VertexInputBindingDescription::default().stride(VERTEX_BYTES)];
    // The two fields of a vertex, one behind the other: see `draw::Vertex`.
    let attributes = [
        attribute(0, vk::Format::R32G32B32A32_SFLOAT, 0),
        attribute(1, vk::Format::R32G32_SFLOAT, 16),
    ];
    let input = vk::PipelineVertexInputStateCreateInfo::default()
        .vertex_binding_descriptions(&bindings)
        .vertex_attribute_descriptions(&attributes);
    let assembly = vk::PipelineInputAssemblyStateCreateInfo::default().topology(kind.topology());
    let viewport =
        vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
    // A structure of the extension is chained only where a mode is asked for, since other devices do not know it.
    let mode = kind.line_mode();
    let mut line = vk::PipelineRasterizationLineStateCreateInfoEXT::default()
        .line_rasterization_mode(mode.unwrap_or_default());
    // Both windings are drawn: culling is not what is judged.
    let mut raster = vk::PipelineRasterizationStateCreateInfo::default()
        .polygon_mode(vk::PolygonMode::FILL)
        .cull_mode(vk::CullModeFlags::NONE)
        .line_width(1.0);
    if mode.is_some() {
        raster = raster.push_next(&mut line);
    }
    // A pass may write some of the samples of a pixel only.
    let masks = [sample_mask];
    let multisample = vk::PipelineMultisampleStateCreateInfo::default()
        .rasterization_samples(kind.samples())
        .sample_mask(&masks);
    let blends = [blending(kind)];
    let mut blend = vk::PipelineColorBlendStateCreateInfo::default();
    if !kind.is_depths() {
        blend = blend.attachments(&blends);
    }
    // Of equal depths the one that was drawn first stays.
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
        .layout(layout)
        .render_pass(render_pass);
    let none = vk::PipelineCache::null();
    // SAFETY: `info` and what it points to live during the call, and the layout and the render pass are of this device; line modes are chosen only where the device has them (`Painter::draw`).
    let made = unsafe { device.raw.create_graphics_pipelines(none, &[info], None) };
    let made = made.map_err(|(_, result)| result).during("creating a pipeline")?;
    made.into_iter().next().ok_or(Error::Failed("creating a pipeline", "nothing".to_owned()))
}

/// A field of a vertex, so many bytes from its beginning.
fn attribute(
    location: u32,
    format: vk::Format,
    offset: u32,
) -> vk::VertexInputAttributeDescription {
    let any = vk::VertexInputAttributeDescription::default();
    any.location(location).format(format).offset(offset)
}

/// Kinds of one byte count: what a shader writes is added to what is there.
fn blending(kind: Kind) -> vk::PipelineColorBlendAttachmentState {
    vk::PipelineColorBlendAttachmentState::default()
        .color_write_mask(vk::ColorComponentFlags::RGBA)
        .blend_enable(kind.pixel_bytes() == 1)
        .src_color_blend_factor(vk::BlendFactor::ONE)
        .dst_color_blend_factor(vk::BlendFactor::ONE)
        .src_alpha_blend_factor(vk::BlendFactor::ONE)
        .dst_alpha_blend_factor(vk::BlendFactor::ONE)
}

/// A shader from the bytes of its file, which are words in little-endian order.
fn shader(device: &Opened, bytes: &[u8]) -> Result<vk::ShaderModule, Error> {
    let words: Vec<u32> = bytes
        .chunks_exact(4)
        .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
        .collect();
    let info = vk::ShaderModuleCreateInfo::default().code(&words);
    // SAFETY: the words are SPIR-V that glslang wrote, kept beside the source.
    unsafe { device.raw.create_shader_module(&info, None) }.during("loading a shader")
}
