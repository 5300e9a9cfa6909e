//! A page of pictures of one kind, with everything that draws into it.

use std::sync::Arc;

use ash::vk;

use super::kind::Kind;
use super::memory::Image;
use super::open::Opened;
use super::pipeline::{framebuffer, pipeline, render_pass};
use super::{Error, While as _};

/// A pipeline, and what it adds to a pixel.
pub(super) struct Pass {
    pub(super) pipeline: vk::Pipeline,
    pub(super) step: f32,
}

/// A page of one kind with everything that draws into it.
pub(super) struct Page {
    pub(super) device: Arc<Opened>,
    pub(super) render_pass: vk::RenderPass,
    pub(super) framebuffer: vk::Framebuffer,
    pub(super) layout: vk::PipelineLayout,
    pub(super) passes: Vec<Pass>,
    /// What is copied from: the page, resolved where it has samples.
    pub(super) image: Image,
    // What is drawn into where that is another one.
    _samples: Option<Image>,
}

impl Drop for Page {
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

impl Page {
    pub(super) fn new(device: &Arc<Opened>, kind: Kind) -> Result<Self, Error> {
        let one = vk::SampleCountFlags::TYPE_1;
        let samples = match kind.samples() {
            samples if samples == one => None,
            samples => Some(Image::new(device, kind, samples)?),
        };
        let mut page = Self {
            device: Arc::clone(device),
            render_pass: vk::RenderPass::null(),
            framebuffer: vk::Framebuffer::null(),
            layout: vk::PipelineLayout::null(),
            passes: Vec::new(),
            image: Image::new(device, kind, one)?,
            _samples: samples,
        };
        // Filled field by field: what fails is dropped with what was made before it.
        page.render_pass = render_pass(device, kind)?;
        let views: Vec<_> = page._samples.iter().chain([&page.image]).map(|i| i.view).collect();
        page.framebuffer = framebuffer(device, page.render_pass, &views, kind.page_px())?;
        let ranges = [vk::PushConstantRange {
            stage_flags: vk::ShaderStageFlags::FRAGMENT,
            offset: 0,
            size: 4,
        }];
        let info = vk::PipelineLayoutCreateInfo::default().push_constant_ranges(&ranges);
        // SAFETY: four bytes of constants are allowed everywhere.
        let layout = unsafe { device.raw.create_pipeline_layout(&info, None) };
        page.layout = layout.during("creating a pipeline layout")?;
        for (step, mask) in kind.passes() {
            let pipeline = pipeline(device, (page.layout, page.render_pass), kind, mask)?;
            page.passes.push(Pass { pipeline, step });
        }
        Ok(page)
    }
}
