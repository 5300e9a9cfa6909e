//! A mesh with a texture, light and a depth buffer: prepared once and drawn often, for a clock.

use std::sync::Arc;

use ash::vk;

use super::draw::{Painter, Prepared};
use super::memory::{Buffer, Image, Like, copy, whole};
use super::open::Opened;
use super::pipeline::{Attachments, Recipe, framebuffer};
use super::{Error, While as _};

/// A corner of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Where it is, before the matrix.
    pub position: [f32; 3],
    /// Its normal in the world, not of length 0.
    pub normal: [f32; 3],
    /// Its texture coordinates, v up.
    pub uv: [f32; 2],
}

/// Bytes of a corner: eight f32.
const CORNER_BYTES: u32 = 32;
/// Bytes of the constants: a matrix, and a vector of light.
const CONSTANT_BYTES: u32 = 80;

/// A mesh, and what it looks like.
#[derive(Clone, Debug)]
pub struct Surface {
    pub corners: Vec<Corner>,
    /// Its triangles, three corners each.
    pub indices: Vec<u32>,
    /// Columns and rows of the texture, which is repeated.
    pub texture_px: [u32; 2],
    /// Its texels, the top row first: the nearest is read.
    pub texels: Vec<[u8; 4]>,
    /// To clip coordinates as Vulkan has them, column by column.
    pub matrix: [f32; 16],
    /// Towards the light, as long as it is strong; then what every surface gets.
    pub light: [f32; 4],
    /// The colour of pixels that no triangle covers.
    pub background: [u8; 4],
}

/// A mesh with its buffers, ready to be drawn into a square picture.
pub struct TexturedMesh {
    draws: Prepared,
    reads: Prepared,
    picture: Buffer,
}

/// What is drawn with, and into.
struct Film {
    device: Arc<Opened>,
    render_pass: vk::RenderPass,
    framebuffer: vk::Framebuffer,
    sets: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    set: vk::DescriptorSet,
    sampler: vk::Sampler,
    layout: vk::PipelineLayout,
    pipeline: vk::Pipeline,
    /// Colours, depths and, where a pixel has four samples, their means: attachments in this order.
    images: Vec<Image>,
    texture: Image,
    side_px: u32,
}

impl Drop for Film {
    fn drop(&mut self) {
        let raw = &self.device.raw;
        // SAFETY: nothing is in use by the device between calls, null handles are allowed, the set goes
        // with its pool, and images go after what shows them, with the fields.
        unsafe {
            raw.destroy_pipeline(self.pipeline, None);
            raw.destroy_pipeline_layout(self.layout, None);
            raw.destroy_sampler(self.sampler, None);
            raw.destroy_descriptor_pool(self.pool, None);
            raw.destroy_descriptor_set_layout(self.sets, None);
            raw.destroy_framebuffer(self.framebuffer, None);
            raw.destroy_render_pass(self.render_pass, None);
        }
    }
}

impl Painter {
    /// Records the drawing of a mesh into a square picture of its own, with one sample a pixel or four.
    ///
    /// # Errors
    /// The device has no four samples or no picture of this size, is lost, or memory is short.
    ///
    /// # Panics
    /// If an index names no corner, or the texture has another number of texels.
    pub fn prepare_mesh(
        &mut self,
        surface: &Surface,
        side_px: u32,
        four_samples: bool,
    ) -> Result<TexturedMesh, Error> {
        let corners = surface.corners.len() as u32;
        assert!(surface.indices.iter().all(|i| *i < corners), "indices name corners");
        let [columns, rows] = surface.texture_px;
        assert_eq!(surface.texels.len(), (columns * rows) as usize, "texels fill the texture");
        let device = Arc::clone(self.device());
        let about = &device.about;
        let missing = match side_px.max(columns).max(rows) {
            side if side > about.largest_image => format!("picture of {side} px"),
            _ if four_samples && !about.four_samples => "four samples a pixel".to_owned(),
            _ => String::new(),
        };
        if !missing.is_empty() {
            return Err(Error::Unsupported(format!("{} has no {missing}", about.device)));
        }
        let film = Film::new(&device, surface, side_px, four_samples)?;
        let texels = surface.texels.as_flattened();
        let texels = filled(&device, texels, vk::BufferUsageFlags::TRANSFER_SRC)?;
        let uploads = self.record_upload(&film, surface.texture_px, &texels)?;
        self.run_prepared(&self.prepared(uploads, texels))?;
        let vertices =
            surface.corners.iter().flat_map(|c| c.position.iter().chain(&c.normal).chain(&c.uv));
        let vertices: Vec<u8> = vertices.flat_map(|word| word.to_ne_bytes()).collect();
        let indices: Vec<u8> = surface.indices.iter().flat_map(|i| i.to_ne_bytes()).collect();
        let vertices = filled(&device, &vertices, vk::BufferUsageFlags::VERTEX_BUFFER)?;
        let indices = filled(&device, &indices, vk::BufferUsageFlags::INDEX_BUFFER)?;
        let bytes = (side_px * side_px) as usize * 4;
        let picture = Buffer::new(&device, bytes, vk::BufferUsageFlags::TRANSFER_DST)?;
        let reads = self.record_reading(&film, &picture)?;
        let draws = self.record_mesh(&film, surface, &vertices, &indices)?;
        let film = Arc::new(film);
        Ok(TexturedMesh {
            draws: self.prepared(draws, (Arc::clone(&film), vertices, indices)),
            reads: self.prepared(reads, film),
            picture,
        })
    }

    /// Draws a mesh, and waits for it.
    pub fn draw_mesh(&mut self, mesh: &TexturedMesh) -> Result<(), Error> {
        self.run_prepared(&mesh.draws)
    }

    /// What was drawn last: red, green, blue and opaque of each pixel, the top row first.
    pub fn read_mesh<'a>(&mut self, mesh: &'a mut TexturedMesh) -> Result<&'a [u8], Error> {
        self.run_prepared(&mesh.reads)?;
        Ok(mesh.picture.bytes())
    }

    fn record_upload(
        &self,
        film: &Film,
        [width, height]: [u32; 2],
        texels: &Buffer,
    ) -> Result<vk::CommandBuffer, Error> {
        let commands = self.begin()?;
        let (old, copied) = (vk::ImageLayout::UNDEFINED, vk::ImageLayout::TRANSFER_DST_OPTIMAL);
        let read = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let barrier = |old, new, before, after| {
            [vk::ImageMemoryBarrier::default()
                .old_layout(old)
                .new_layout(new)
                .src_access_mask(before)
                .dst_access_mask(after)
                .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .image(film.texture.raw)
                .subresource_range(whole(COLOURS))]
        };
        let writes = vk::AccessFlags::TRANSFER_WRITE;
        let first = barrier(old, copied, vk::AccessFlags::empty(), writes);
        let then = barrier(copied, read, writes, vk::AccessFlags::SHADER_READ);
        let (top, copies) = (vk::PipelineStageFlags::TOP_OF_PIPE, vk::PipelineStageFlags::TRANSFER);
        let shades = vk::PipelineStageFlags::FRAGMENT_SHADER;
        let region = [copy(COLOURS, [width, height], 0)];
        let (raw, none) = (&film.device.raw, vk::DependencyFlags::empty());
        // SAFETY: recording, of handles of this device; the buffer holds all texels.
        unsafe {
            raw.cmd_pipeline_barrier(commands, top, copies, none, &[], &[], &first);
            raw.cmd_copy_buffer_to_image(commands, texels.raw, film.texture.raw, copied, &region);
            raw.cmd_pipeline_barrier(commands, copies, shades, none, &[], &[], &then);
        }
        self.end(commands)
    }

    fn record_reading(&self, film: &Film, into: &Buffer) -> Result<vk::CommandBuffer, Error> {
        let commands = self.begin()?;
        let region = [copy(COLOURS, [film.side_px; 2], 0)];
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        let picture = film.picture().raw;
        // SAFETY: the render pass leaves the picture in this layout, and the buffer has room for all.
        unsafe {
            film.device.raw.cmd_copy_image_to_buffer(commands, picture, layout, into.raw, &region);
        }
        self.end(commands)
    }

    fn record_mesh(
        &self,
        film: &Film,
        surface: &Surface,
        vertices: &Buffer,
        indices: &Buffer,
    ) -> Result<vk::CommandBuffer, Error> {
        let commands = self.begin()?;
        let float32 = surface.background.map(|byte| f32::from(byte) / 255.0);
        let colour = vk::ClearValue { color: vk::ClearColorValue { float32 } };
        let farthest = vk::ClearDepthStencilValue { depth: 1.0, stencil: 0 };
        let clear = [colour, vk::ClearValue { depth_stencil: farthest }];
        let begin = vk::RenderPassBeginInfo::default()
            .render_pass(film.render_pass)
            .framebuffer(film.framebuffer)
            .render_area(square(film.side_px))
            .clear_values(&clear);
        let constants = surface.matrix.iter().chain(&surface.light);
        let constants: Vec<u8> = constants.flat_map(|word| word.to_ne_bytes()).collect();
        let both = vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
        let graphics = vk::PipelineBindPoint::GRAPHICS;
        let side = film.side_px as f32;
        let viewport =
            vk::Viewport { width: side, height: side, max_depth: 1.0, ..vk::Viewport::default() };
        let (raw, count) = (&film.device.raw, surface.indices.len() as u32);
        // SAFETY: every handle is of this device and alive; indices name corners in their buffer.
        unsafe {
            raw.cmd_begin_render_pass(commands, &begin, vk::SubpassContents::INLINE);
            raw.cmd_bind_pipeline(commands, graphics, film.pipeline);
            raw.cmd_set_viewport(commands, 0, &[viewport]);
            raw.cmd_set_scissor(commands, 0, &[square(film.side_px)]);
            raw.cmd_bind_descriptor_sets(commands, graphics, film.layout, 0, &[film.set], &[]);
            raw.cmd_push_constants(commands, film.layout, both, 0, &constants);
            raw.cmd_bind_vertex_buffers(commands, 0, &[vertices.raw], &[0]);
            raw.cmd_bind_index_buffer(commands, indices.raw, 0, vk::IndexType::UINT32);
            raw.cmd_draw_indexed(commands, count, 1, 0, 0, 0);
            raw.cmd_end_render_pass(commands);
        }
        self.end(commands)
    }
}

fn square(side_px: u32) -> vk::Rect2D {
    let extent = vk::Extent2D { width: side_px, height: side_px };
    vk::Rect2D { offset: vk::Offset2D::default(), extent }
}

/// A buffer of these bytes.
fn filled(
    device: &Arc<Opened>,
    bytes: &[u8],
    usage: vk::BufferUsageFlags,
) -> Result<Buffer, Error> {
    let mut buffer = Buffer::new(device, bytes.len().max(1), usage)?;
    buffer.write(bytes);
    Ok(buffer)
}

/// Every device draws into this and reads it in shaders.
const COLOURS: vk::Format = vk::Format::R8G8B8A8_UNORM;

impl Film {
    fn new(
        device: &Arc<Opened>,
        surface: &Surface,
        side_px: u32,
        four_samples: bool,
    ) -> Result<Self, Error> {
        let one = vk::SampleCountFlags::TYPE_1;
        // Every device that has four samples of colours has four of depths.
        let samples = if four_samples { vk::SampleCountFlags::TYPE_4 } else { one };
        let colours = Like::drawn(COLOURS, side_px, samples);
        let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        let mut images = vec![
            Image::new(device, colours)?,
            Image::new(device, Like { format: device.depth, usage, ..colours })?,
        ];
        if four_samples {
            images.push(Image::new(device, Like::drawn(COLOURS, side_px, one))?);
        }
        let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
        let size = surface.texture_px;
        let texture = Like { format: COLOURS, size, samples: one, usage };
        let mut film = Self {
            device: Arc::clone(device),
            render_pass: vk::RenderPass::null(),
            framebuffer: vk::Framebuffer::null(),
            sets: vk::DescriptorSetLayout::null(),
            pool: vk::DescriptorPool::null(),
            set: vk::DescriptorSet::null(),
            sampler: vk::Sampler::null(),
            layout: vk::PipelineLayout::null(),
            pipeline: vk::Pipeline::null(),
            images,
            texture: Image::new(device, texture)?,
            side_px,
        };
        // Filled field by field: what fails is dropped with what was made before it.
        let attachments =
            Attachments { colours: Some(COLOURS), depths: Some(device.depth), samples };
        film.render_pass = attachments.render_pass(device)?;
        let views: Vec<_> = film.images.iter().map(|image| image.view).collect();
        film.framebuffer = framebuffer(device, film.render_pass, &views, side_px)?;
        film.bind_texture()?;
        let ranges = [vk::PushConstantRange {
            stage_flags: vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT,
            offset: 0,
            size: CONSTANT_BYTES,
        }];
        let sets = [film.sets];
        let info = vk::PipelineLayoutCreateInfo::default()
            .push_constant_ranges(&ranges)
            .set_layouts(&sets);
        // SAFETY: 128 bytes of constants are allowed everywhere; the layout of sets is alive.
        let layout = unsafe { device.raw.create_pipeline_layout(&info, None) };
        film.layout = layout.during("creating a pipeline layout")?;
        let recipe = Recipe {
            shaders: [
                include_bytes!("shaders/mesh.vert.spv"),
                include_bytes!("shaders/mesh.frag.spv"),
            ],
            stride: CORNER_BYTES,
            attributes: &[
                (vk::Format::R32G32B32_SFLOAT, 0),
                (vk::Format::R32G32B32_SFLOAT, 12),
                (vk::Format::R32G32_SFLOAT, 24),
            ],
            topology: vk::PrimitiveTopology::TRIANGLE_LIST,
            line_mode: None,
            attachments,
            sample_mask: u32::MAX,
            adds: false,
            layout: film.layout,
            render_pass: film.render_pass,
        };
        film.pipeline = recipe.make(device)?;
        Ok(film)
    }

    /// What is read in the end: the colours, or the means of their samples.
    fn picture(&self) -> &Image {
        self.images.get(2).unwrap_or(&self.images[0])
    }

    /// The texture with a sampler, as the fragment shader wants it.
    fn bind_texture(&mut self) -> Result<(), Error> {
        let raw = &self.device.raw;
        // Nearest, and repeated, where nothing is said.
        let info = vk::SamplerCreateInfo::default();
        // SAFETY: `info` lives during the call.
        self.sampler = unsafe { raw.create_sampler(&info, None) }.during("creating a sampler")?;
        let kind = vk::DescriptorType::COMBINED_IMAGE_SAMPLER;
        let bindings = [vk::DescriptorSetLayoutBinding::default()
            .descriptor_type(kind)
            .descriptor_count(1)
            .stage_flags(vk::ShaderStageFlags::FRAGMENT)];
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: `info` and what it points to live during the call.
        let sets = unsafe { raw.create_descriptor_set_layout(&info, None) };
        self.sets = sets.during("creating a layout of descriptors")?;
        let sizes = [vk::DescriptorPoolSize { ty: kind, descriptor_count: 1 }];
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: `info` and what it points to live during the call.
        let pool = unsafe { raw.create_descriptor_pool(&info, None) };
        self.pool = pool.during("creating a pool of descriptors")?;
        let layouts = [self.sets];
        let info = vk::DescriptorSetAllocateInfo::default()
            .descriptor_pool(self.pool)
            .set_layouts(&layouts);
        // SAFETY: the pool has room for one set of this layout.
        let set = unsafe { raw.allocate_descriptor_sets(&info) };
        self.set = set.during("allocating descriptors")?[0];
        let images = [vk::DescriptorImageInfo {
            sampler: self.sampler,
            image_view: self.texture.view,
            image_layout: vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
        }];
        let writes = [vk::WriteDescriptorSet::default()
            .dst_set(self.set)
            .descriptor_type(kind)
            .image_info(&images)];
        // SAFETY: the set, the sampler and the view are alive, and no submission uses the set yet.
        unsafe { raw.update_descriptor_sets(&writes, &[]) };
        Ok(())
    }
}
