//! Buffers and images with the memory behind them, freed when they are dropped.

use std::sync::Arc;

use ash::vk;

use super::kind::Kind;
use super::open::Opened;
use super::{Error, While as _};

/// Memory of the device behind one buffer or one image.
struct Memory {
    device: Arc<Opened>,
    raw: vk::DeviceMemory,
}

impl Drop for Memory {
    fn drop(&mut self) {
        // SAFETY: the buffer or image is destroyed before its memory, and nothing is in use by the
        // device between calls.
        unsafe { self.device.raw.free_memory(self.raw, None) };
    }
}

impl Memory {
    /// Memory of the first kind that fits and has all flags of one of `wanted`, tried in order.
    fn new(
        device: &Arc<Opened>,
        needs: vk::MemoryRequirements,
        wanted: &[vk::MemoryPropertyFlags],
    ) -> Result<Self, Error> {
        let types = &device.memory.memory_types[..device.memory.memory_type_count as usize];
        let mut found = None;
        for flags in wanted {
            for (kind, index) in types.iter().zip(0_u32..) {
                let is_allowed = needs.memory_type_bits & (1 << index) != 0;
                if found.is_none() && is_allowed && kind.property_flags.contains(*flags) {
                    found = Some(index);
                }
            }
        }
        let Some(index) = found else {
            return Err(Error::Unsupported("no memory of a kind that is needed".to_owned()));
        };
        let info =
            vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(index);
        // SAFETY: the type is one of the device's.
        let raw = unsafe { device.raw.allocate_memory(&info, None) };
        let raw = raw.during("allocating memory of the device")?;
        Ok(Self { device: Arc::clone(device), raw })
    }
}

/// A buffer that the program writes and reads, as well as the device.
pub struct Buffer {
    device: Arc<Opened>,
    pub(super) raw: vk::Buffer,
    pub size: usize,
    /// Where it is mapped, as long as it lives.
    start: *mut u8,
    // Freed after the buffer: fields are dropped after `drop`.
    _memory: Memory,
}

// SAFETY: the pointer is into memory that this value owns and that stays mapped while it lives; it is
// followed through `&self` for reading and `&mut self` for writing only.
unsafe impl Send for Buffer {}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: nothing is in use by the device between calls.
        unsafe { self.device.raw.destroy_buffer(self.raw, None) };
    }
}

impl Buffer {
    /// A buffer of this size for this use, zeroed.
    pub fn new(
        device: &Arc<Opened>,
        size: usize,
        usage: vk::BufferUsageFlags,
    ) -> Result<Self, Error> {
        let info = vk::BufferCreateInfo::default().size(size as u64).usage(usage);
        // SAFETY: the size is not 0, as callers ask for at least a page or a vertex.
        let raw = unsafe { device.raw.create_buffer(&info, None) }.during("creating a buffer")?;
        // SAFETY: the buffer was just made from this device.
        let needs = unsafe { device.raw.get_buffer_memory_requirements(raw) };
        let seen = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        // Reading back is slow where it is not cached, drawing where it is not the device's own.
        let best = match usage.contains(vk::BufferUsageFlags::TRANSFER_DST) {
            true => vk::MemoryPropertyFlags::HOST_CACHED,
            false => vk::MemoryPropertyFlags::DEVICE_LOCAL,
        };
        let wanted = [seen | best, seen];
        let memory = Memory::new(device, needs, &wanted).and_then(|memory| {
            // SAFETY: the memory is fresh, large enough, and of a type that the buffer allows.
            let bound = unsafe { device.raw.bind_buffer_memory(raw, memory.raw, 0) };
            // SAFETY: it is visible to the host, and is mapped once.
            let start = bound.and_then(|()| unsafe {
                device.raw.map_memory(memory.raw, 0, vk::WHOLE_SIZE, vk::MemoryMapFlags::empty())
            });
            Ok((memory, start.during("mapping memory of the device")?))
        });
        match memory {
            Ok((memory, start)) => {
                let start = start.cast::<u8>();
                // SAFETY: at least `size` bytes are mapped; before they are read they are written.
                unsafe { start.write_bytes(0, size) };
                Ok(Self { device: Arc::clone(device), raw, size, start, _memory: memory })
            }
            Err(error) => {
                // SAFETY: nobody else knows the buffer.
                unsafe { device.raw.destroy_buffer(raw, None) };
                Err(error)
            }
        }
    }

    /// What it holds. Only between submissions, which the painter sees to.
    pub fn bytes(&self) -> &[u8] {
        // SAFETY: `size` bytes are mapped and initialised, and the device writes during a submission
        // only, which its submitter waits for.
        unsafe { std::slice::from_raw_parts(self.start, self.size) }
    }

    /// Writes bytes at its beginning.
    ///
    /// # Panics
    /// If it is too small.
    pub fn write(&mut self, bytes: &[u8]) {
        assert!(bytes.len() <= self.size, "{} bytes into {}", bytes.len(), self.size);
        // SAFETY: it is large enough, and what is given is other memory, borrowed.
        unsafe { self.start.copy_from_nonoverlapping(bytes.as_ptr(), bytes.len()) };
    }
}

/// An image that the device alone reads and writes, with a view of all of it.
pub struct Image {
    device: Arc<Opened>,
    pub(super) raw: vk::Image,
    pub(super) view: vk::ImageView,
    // Freed after the image.
    _memory: Memory,
}

impl Drop for Image {
    fn drop(&mut self) {
        // SAFETY: nothing is in use by the device between calls; the view goes before its image.
        unsafe {
            self.device.raw.destroy_image_view(self.view, None);
            self.device.raw.destroy_image(self.raw, None);
        }
    }
}

impl Image {
    /// A page that is drawn into, and copied from where a pixel has one sample.
    pub(super) fn new(
        device: &Arc<Opened>,
        kind: Kind,
        samples: vk::SampleCountFlags,
    ) -> Result<Self, Error> {
        let mut usage = match kind.is_depths() {
            true => vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
            false => vk::ImageUsageFlags::COLOR_ATTACHMENT,
        };
        if samples == vk::SampleCountFlags::TYPE_1 {
            usage |= vk::ImageUsageFlags::TRANSFER_SRC;
        }
        let side = kind.page_px();
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(kind.format())
            .extent(vk::Extent3D { width: side, height: side, depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(samples)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(usage);
        // SAFETY: formats and sample counts are those that every device has or that were asked for.
        let raw = unsafe { device.raw.create_image(&info, None) }.during("creating an image")?;
        let made = Self::bind(device, raw, kind);
        let (memory, view) = made.inspect_err(|_| {
            // SAFETY: nobody else knows the image.
            unsafe { device.raw.destroy_image(raw, None) };
        })?;
        Ok(Self { device: Arc::clone(device), raw, view, _memory: memory })
    }

    /// Puts memory behind an image and makes its view; the caller destroys the image where that fails.
    fn bind(
        device: &Arc<Opened>,
        raw: vk::Image,
        kind: Kind,
    ) -> Result<(Memory, vk::ImageView), Error> {
        // SAFETY: the image was just made from this device.
        let needs = unsafe { device.raw.get_image_memory_requirements(raw) };
        let wanted = [vk::MemoryPropertyFlags::DEVICE_LOCAL, vk::MemoryPropertyFlags::empty()];
        let memory = Memory::new(device, needs, &wanted)?;
        // SAFETY: the memory is fresh, large enough, and of a type that the image allows.
        unsafe { device.raw.bind_image_memory(raw, memory.raw, 0) }.during("binding an image")?;
        let all = vk::ImageSubresourceRange::default()
            .aspect_mask(kind.aspect())
            .level_count(1)
            .layer_count(1);
        let info = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(kind.format())
            .subresource_range(all);
        // SAFETY: the image has memory, and the view shows all of it in its own format.
        let view = unsafe { device.raw.create_image_view(&info, None) };
        Ok((memory, view.during("creating a view of an image")?))
    }
}
