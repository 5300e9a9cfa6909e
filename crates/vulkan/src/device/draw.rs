//! Draws lists of primitives, thousands a submission, and reads them back once.

use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;

use super::kind::{CELL_PX, Kind, VERTEX_BYTES};
use super::memory::Buffer;
use super::open::Opened;
use super::page::Page;
use super::{Error, While as _};

/// Bytes that are read back from one submission at most.
const MOST_BYTES: usize = 1 << 26;
/// Seconds that a submission may take.
const PATIENCE_S: u64 = 120;

/// A vertex as the vertex shader passes it on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vertex {
    /// Clip coordinates x, y, z, w.
    pub clip: [f32; 4],
    pub attributes: [f32; 2],
}

impl Vertex {
    /// With w = 1 and no attributes, halfway into the view volume.
    pub fn flat([x, y]: [f32; 2]) -> Self {
        Self { clip: [x, y, 0.5, 1.0], attributes: [0.0; 2] }
    }
}

/// A triangle or a line, and where it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// The cell; several may be drawn into one, in order. Cells of a list must not decrease.
    pub cell: usize,
    /// Its corners; of a line the first two.
    pub vertices: [Vertex; 3],
    /// The viewport's left and upper side in pixels from those of the cell, its width and height.
    pub viewport: [f32; 4],
    /// Columns and rows that are drawn into, from the cell's corner; on its page.
    pub window: [u32; 2],
}

/// A planted failure, to see that it is told and survived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failing {
    /// The device is lost at the submission of this number.
    Lost(u64),
    /// Memory is short at the submission of this number.
    OutOfMemory(u64),
}

/// What was read back: whole pages, one behind the other, each divided into cells.
#[derive(PartialEq)]
pub struct Pictures {
    kind: Kind,
    bytes: Vec<u8>,
}

impl Draw {
    /// Draws that are equal in this need no other state between them.
    fn place(&self) -> (usize, [f32; 4], [u32; 2]) {
        (self.cell, self.viewport, self.window)
    }
}

/// Where commands are recorded; freed with them after the last of those who hold it.
struct Pool {
    device: Arc<Opened>,
    raw: vk::CommandPool,
}

impl Drop for Pool {
    fn drop(&mut self) {
        // SAFETY: whoever recorded something here waited until the device was idle.
        unsafe { self.device.raw.destroy_command_pool(self.raw, None) };
    }
}

/// Commands that are recorded once and run often by the painter that recorded them; what a benchmark
/// times.
pub struct RecordedCommands {
    pool: Arc<Pool>,
    commands: vk::CommandBuffer,
    // What every run reads.
    _vertices: Buffer,
}

impl Drop for RecordedCommands {
    fn drop(&mut self) {
        // What was recorded is not in use any more when it goes, with the fields.
        self.pool.device.wait_idle();
    }
}

impl Pictures {
    /// The pixels of a row of a cell, [`Kind::pixel_bytes`] each.
    pub fn row(&self, cell: usize, y_px: u32, width: u32) -> &[u8] {
        let size = self.kind.pixel_bytes();
        let (page, cell) = (cell / self.kind.page_cells(), cell % self.kind.page_cells());
        let (cells, side) = (self.kind.cells() as usize, self.kind.page_px() as usize);
        let (column, row) = (cell % cells, cell / cells);
        let y = row * CELL_PX as usize + y_px as usize;
        let pixel = (page * side + y) * side + column * CELL_PX as usize;
        &self.bytes[pixel * size..(pixel + width as usize) * size]
    }
}

/// Draws on one device, one submission after the other.
pub struct Painter {
    device: Arc<Opened>,
    pool: Arc<Pool>,
    /// Signalled when a submission is done.
    fence: vk::Fence,
    /// A page of each kind that was drawn before.
    kinds: HashMap<Kind, Page>,
    /// Two buffers, the larger ones of those that were needed so far: what is drawn, and what is read back.
    vertices: Option<Buffer>,
    pages: Option<Buffer>,
    submissions: u64,
    failing: Option<Failing>,
    /// A submission failed: the device may still be at work on it, so nothing is touched any more.
    given_up: bool,
}

impl Drop for Painter {
    fn drop(&mut self) {
        self.device.wait_idle();
        // SAFETY: nothing waits for it any more.
        unsafe { self.device.raw.destroy_fence(self.fence, None) };
    }
}

impl Painter {
    pub fn new(device: &Arc<Opened>, failing: Option<Failing>) -> Result<Self, Error> {
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(device.family);
        // SAFETY: the family is one of the device's.
        let pool = unsafe { device.raw.create_command_pool(&info, None) };
        let raw = pool.during("creating a command pool")?;
        let mut painter = Self {
            device: Arc::clone(device),
            pool: Arc::new(Pool { device: Arc::clone(device), raw }),
            fence: vk::Fence::null(),
            kinds: HashMap::new(),
            vertices: None,
            pages: None,
            submissions: 0,
            failing,
            given_up: false,
        };
        // SAFETY: the device is alive.
        let fence = unsafe { device.raw.create_fence(&vk::FenceCreateInfo::default(), None) };
        painter.fence = fence.during("creating a fence")?;
        Ok(painter)
    }

    pub fn device(&self) -> &Arc<Opened> {
        &self.device
    }

    pub fn submissions(&self) -> u64 {
        self.submissions
    }

    /// Draws a list into so many cells, each clear before.
    ///
    /// # Errors
    /// The device cannot draw this kind, is lost, hangs, or memory is short.
    ///
    /// # Panics
    /// If cells are out of order or a window does not fit its page.
    pub fn draw(&mut self, kind: Kind, cells: usize, draws: &[Draw]) -> Result<Pictures, Error> {
        self.check(kind, cells, draws)?;
        let page_bytes = page_bytes(kind);
        let pages = cells.div_ceil(kind.page_cells());
        let at_once = (MOST_BYTES / page_bytes).max(1);
        let mut bytes = Vec::with_capacity(pages * page_bytes);
        let mut rest = draws;
        for first in (0..pages).step_by(at_once) {
            // Draws are in the order of their cells, so those of these pages come first.
            let end = pages.min(first + at_once);
            let (here, later) =
                rest.split_at(rest.partition_point(|d| d.cell < end * kind.page_cells()));
            rest = later;
            self.submit(kind, first..end, here)?;
            let read = self.pages.as_ref().map_or(&[][..], Buffer::bytes);
            bytes.extend_from_slice(&read[..(end - first) * page_bytes]);
        }
        Ok(Pictures { kind, bytes })
    }

    /// Records a list on one page, to be run often; what it draws is not read back.
    pub fn prepare(&mut self, kind: Kind, draws: &[Draw]) -> Result<RecordedCommands, Error> {
        self.check(kind, 1, draws)?;
        let bytes = vertex_bytes(kind, draws);
        let usage = vk::BufferUsageFlags::VERTEX_BUFFER;
        let mut vertices = Buffer::new(&self.device, bytes.len().max(1), usage)?;
        vertices.write(&bytes);
        let commands = self.record(kind, 0..1, draws, &vertices, None)?;
        Ok(RecordedCommands { pool: Arc::clone(&self.pool), commands, _vertices: vertices })
    }

    /// Submits what this painter prepared, and waits for it.
    ///
    /// # Errors
    /// The device is lost or hangs.
    ///
    /// # Panics
    /// If another painter prepared it.
    pub fn run_prepared(&mut self, prepared: &RecordedCommands) -> Result<(), Error> {
        assert!(Arc::ptr_eq(&self.pool, &prepared.pool), "each painter runs what it prepared");
        if self.given_up {
            return Err(Error::Lost("drawing after a failure"));
        }
        let done = self.run(prepared.commands);
        self.given_up = done.is_err();
        done
    }

    /// Refuses what cannot be drawn, and makes the page of a kind that is drawn for the first time.
    fn check(&mut self, kind: Kind, cells: usize, draws: &[Draw]) -> Result<(), Error> {
        self.supports(kind)?;
        if self.given_up {
            return Err(Error::Lost("drawing after a failure"));
        }
        assert!(draws.is_sorted_by_key(|d| d.cell), "cells are in order");
        let fits = |d: &Draw| {
            let (_, scissor) = place(kind, d);
            let (offset, extent) = (scissor.offset, scissor.extent);
            d.cell < cells.next_multiple_of(kind.page_cells())
                && offset.x as u32 + extent.width <= kind.page_px()
                && offset.y as u32 + extent.height <= kind.page_px()
        };
        assert!(draws.iter().all(fits), "cells and windows lie on their page");
        if !self.kinds.contains_key(&kind) {
            let page = Page::new(&self.device, kind)?;
            self.kinds.insert(kind, page);
        }
        Ok(())
    }

    /// Refuses a kind that the device does not offer.
    fn supports(&self, kind: Kind) -> Result<(), Error> {
        let about = &self.device.about;
        let missing = match kind {
            Kind::Samples if !about.four_samples => "four samples a pixel",
            Kind::RectangularLines if !about.rectangular_lines => "rectangular lines by choice",
            Kind::BresenhamLines if !about.bresenham_lines => "Bresenham lines",
            Kind::Depths if !about.float_depth => "depths in f32",
            _ => return Ok(()),
        };
        Err(Error::Unsupported(format!("{} has no {missing}", about.device)))
    }

    /// Draws some pages and copies them into the buffer that is read.
    fn submit(
        &mut self,
        kind: Kind,
        pages: std::ops::Range<usize>,
        draws: &[Draw],
    ) -> Result<(), Error> {
        self.submissions += 1;
        match self.failing {
            Some(Failing::Lost(at)) if at == self.submissions => {
                return Err(Error::Lost("waiting for a submission"));
            }
            Some(Failing::OutOfMemory(at)) if at == self.submissions => {
                return Err(Error::OutOfMemory("allocating memory of the device"));
            }
            _ => {}
        }
        // Room for what is drawn and for what is read back.
        let bytes = vertex_bytes(kind, draws);
        let (of_vertices, of_pages) =
            (vk::BufferUsageFlags::VERTEX_BUFFER, vk::BufferUsageFlags::TRANSFER_DST);
        make_room(&self.device, &mut self.vertices, bytes.len().max(1), of_vertices)?;
        make_room(&self.device, &mut self.pages, pages.len() * page_bytes(kind), of_pages)?;
        if let Some(vertices) = &mut self.vertices {
            vertices.write(&bytes);
        }
        let (Some(vertices), Some(into)) = (&self.vertices, &self.pages) else {
            return Err(Error::OutOfMemory("allocating buffers"));
        };
        let commands = self.record(kind, pages, draws, vertices, Some(into))?;
        // After a failure the commands may still be read, so they are not freed.
        if let Err(error) = self.run(commands) {
            self.given_up = true;
            return Err(error);
        }
        // SAFETY: the submission was waited for.
        unsafe { self.device.raw.free_command_buffers(self.pool.raw, &[commands]) };
        Ok(())
    }

    /// Records pages, each copied `into` a buffer behind the one before it; commands that copy nothing
    /// may be run often.
    fn record(
        &self,
        kind: Kind,
        pages: std::ops::Range<usize>,
        draws: &[Draw],
        vertices: &Buffer,
        into: Option<&Buffer>,
    ) -> Result<vk::CommandBuffer, Error> {
        let commands = self.begin()?;
        let (mut rest, mut first) = (draws, 0);
        for (page, at) in pages.zip(0..) {
            let count = rest.partition_point(|d| d.cell < (page + 1) * kind.page_cells());
            self.record_page(commands, kind, &rest[..count], first, vertices);
            if let Some(into) = into {
                self.record_copy(commands, kind, at, into);
            }
            (rest, first) = (&rest[count..], first + count as u32 * kind.corners());
        }
        self.end(commands)
    }

    /// A buffer of commands that is being recorded.
    fn begin(&self) -> Result<vk::CommandBuffer, Error> {
        let raw = &self.device.raw;
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(self.pool.raw)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool is of this device, and one thread at a time has it.
        let commands = unsafe { raw.allocate_command_buffers(&info) };
        let commands = commands.during("allocating a command buffer")?[0];
        let begin = vk::CommandBufferBeginInfo::default();
        // SAFETY: the buffer is fresh.
        unsafe { raw.begin_command_buffer(commands, &begin) }.during("recording")?;
        Ok(commands)
    }

    /// Ends what was begun; what it copies can be read by the program.
    fn end(&self, commands: vk::CommandBuffer) -> Result<vk::CommandBuffer, Error> {
        let barrier = [vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::TRANSFER_WRITE)
            .dst_access_mask(vk::AccessFlags::HOST_READ)];
        let (copies, host) = (vk::PipelineStageFlags::TRANSFER, vk::PipelineStageFlags::HOST);
        let (raw, none) = (&self.device.raw, vk::DependencyFlags::empty());
        // SAFETY: recording, outside of a render pass.
        unsafe {
            raw.cmd_pipeline_barrier(commands, copies, host, none, &barrier, &[], &[]);
            raw.end_command_buffer(commands)
        }
        .during("recording")?;
        Ok(commands)
    }

    /// Records a page: cleared and drawn. What follows one another in one place is one draw.
    fn record_page(
        &self,
        commands: vk::CommandBuffer,
        kind: Kind,
        draws: &[Draw],
        first_vertex: u32,
        vertices: &Buffer,
    ) {
        let raw = &self.device.raw;
        let page = &self.kinds[&kind];
        let clear = [kind.clear(); 2];
        let all = vk::Rect2D {
            offset: vk::Offset2D::default(),
            extent: vk::Extent2D { width: kind.page_px(), height: kind.page_px() },
        };
        let begin = vk::RenderPassBeginInfo::default()
            .render_pass(page.render_pass)
            .framebuffer(page.framebuffer)
            .render_area(all)
            .clear_values(&clear);
        // SAFETY: every handle is of this device and alive; the viewport and the scissor are set
        // before each draw, and the vertices lie within their buffer.
        unsafe {
            raw.cmd_begin_render_pass(commands, &begin, vk::SubpassContents::INLINE);
            raw.cmd_bind_vertex_buffers(commands, 0, &[vertices.raw], &[0]);
            for pass in &page.passes {
                let graphics = vk::PipelineBindPoint::GRAPHICS;
                raw.cmd_bind_pipeline(commands, graphics, pass.pipeline);
                let (fragment, step) = (vk::ShaderStageFlags::FRAGMENT, pass.step.to_ne_bytes());
                raw.cmd_push_constants(commands, page.layout, fragment, 0, &step);
                let mut first = first_vertex;
                for same in draws.chunk_by(|a, b| a.place() == b.place()) {
                    let (viewport, scissor) = place(kind, &same[0]);
                    raw.cmd_set_viewport(commands, 0, &[viewport]);
                    raw.cmd_set_scissor(commands, 0, &[scissor]);
                    let count = kind.corners() * same.len() as u32;
                    raw.cmd_draw(commands, count, 1, first, 0);
                    first += count;
                }
            }
            raw.cmd_end_render_pass(commands);
        }
    }

    /// Records the copy of a page behind those before it.
    fn record_copy(&self, commands: vk::CommandBuffer, kind: Kind, at: u64, into: &Buffer) {
        let (raw, page) = (&self.device.raw, &self.kinds[&kind]);
        let layers =
            vk::ImageSubresourceLayers::default().aspect_mask(kind.aspect()).layer_count(1);
        let (width, height) = (kind.page_px(), kind.page_px());
        let region = [vk::BufferImageCopy::default()
            .buffer_offset(at * page_bytes(kind) as u64)
            .image_subresource(layers)
            .image_extent(vk::Extent3D { width, height, depth: 1 })];
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        // SAFETY: the render pass leaves the page in this layout, and the buffer has room for all.
        unsafe {
            raw.cmd_copy_image_to_buffer(commands, page.image.raw, layout, into.raw, &region);
        }
    }

    /// Submits commands and waits for their end.
    fn run(&self, commands: vk::CommandBuffer) -> Result<(), Error> {
        let raw = &self.device.raw;
        let buffers = [commands];
        let submit = [vk::SubmitInfo::default().command_buffers(&buffers)];
        let queue = self.device.queue();
        // SAFETY: this thread has the queue; the fence is unsignalled, as it was made or reset.
        unsafe { raw.queue_submit(*queue, &submit, self.fence) }.during("submitting")?;
        drop(queue);
        // SAFETY: the fence is of this device.
        let waited =
            unsafe { raw.wait_for_fences(&[self.fence], true, PATIENCE_S * 1_000_000_000) };
        match waited {
            Err(vk::Result::TIMEOUT) => return Err(Error::Hangs(PATIENCE_S)),
            other => other.during("waiting for a submission")?,
        }
        // SAFETY: it was waited for.
        unsafe { raw.reset_fences(&[self.fence]) }.during("waiting for a submission")
    }
}

/// Replaces a buffer that is missing or too small.
fn make_room(
    device: &Arc<Opened>,
    buffer: &mut Option<Buffer>,
    size: usize,
    usage: vk::BufferUsageFlags,
) -> Result<(), Error> {
    if buffer.as_ref().is_none_or(|b| b.size < size) {
        // The old one first: both may not fit.
        *buffer = None;
        *buffer = Some(Buffer::new(device, size, usage)?);
    }
    Ok(())
}

/// Bytes of a whole page, which is what is copied.
fn page_bytes(kind: Kind) -> usize {
    (kind.page_px() * kind.page_px()) as usize * kind.pixel_bytes()
}

/// The viewport and the window of a draw on its page.
fn place(kind: Kind, draw: &Draw) -> (vk::Viewport, vk::Rect2D) {
    let cell = (draw.cell % kind.page_cells()) as u32;
    let (x, y) = (cell % kind.cells() * CELL_PX, cell / kind.cells() * CELL_PX);
    let [left, top, width, height] = draw.viewport;
    let viewport = vk::Viewport {
        x: x as f32 + left,
        y: y as f32 + top,
        width,
        height,
        min_depth: 0.0,
        max_depth: 1.0,
    };
    let offset = vk::Offset2D { x: x as i32, y: y as i32 };
    let [width, height] = draw.window;
    (viewport, vk::Rect2D { offset, extent: vk::Extent2D { width, height } })
}

/// The vertices as the pipeline reads them: four floats of clip coordinates, then two attributes.
fn vertex_bytes(kind: Kind, draws: &[Draw]) -> Vec<u8> {
    let corners = kind.corners() as usize;
    let mut bytes = Vec::with_capacity(draws.len() * corners * VERTEX_BYTES as usize);
    for vertex in draws.iter().flat_map(|d| &d.vertices[..corners]) {
        for word in vertex.clip.iter().chain(&vertex.attributes) {
            bytes.extend_from_slice(&word.to_ne_bytes());
        }
    }
    bytes
}
