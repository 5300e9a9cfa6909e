//! A device made ready: its queue, and the extensions and features that are there.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::vk;

use super::find::{About, Instance, Listed};
use super::{Error, While as _};

/// A logical device with a queue that draws; whatever is made from it holds it.
pub struct Opened {
    pub(super) raw: ash::Device,
    queue: Mutex<vk::Queue>,
    pub(super) family: u32,
    pub(super) memory: vk::PhysicalDeviceMemoryProperties,
    pub about: About,
    // Dropped last, as the fields go in order.
    _instance: Arc<Instance>,
}

impl Drop for Opened {
    fn drop(&mut self) {
        // SAFETY: whatever was made from the device holds this value, so nothing of it is left, and
        // every submission was waited for.
        unsafe { self.raw.destroy_device(None) };
    }
}

impl Opened {
    /// The queue, which one thread at a time has.
    pub(super) fn queue(&self) -> MutexGuard<'_, vk::Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until the device does nothing any more: what a submission that was given up uses is free
    /// then. A lost device waits for nothing.
    pub(super) fn wait_idle(&self) {
        let _queue = self.queue();
        // SAFETY: nobody else has the queue.
        let _ = unsafe { self.raw.device_wait_idle() };
    }

    /// Makes a listed device ready.
    ///
    /// # Errors
    /// It draws nothing, its lattice is not one that can be judged, or the driver fails.
    pub fn new(listed: &Listed) -> Result<Arc<Self>, Error> {
        let instance = &listed.instance.raw;
        let about = &listed.about;
        if !(4..=8).contains(&about.subpixel_bits) {
            let bits = about.subpixel_bits;
            return Err(Error::Unsupported(format!(
                "{} has {bits} subpixel bits; the oracle's lattice holds 4 to 8",
                about.device
            )));
        }
        // SAFETY: the handle is of this instance, which is alive.
        let families =
            unsafe { instance.get_physical_device_queue_family_properties(listed.handle) };
        let draws =
            |f: &vk::QueueFamilyProperties| f.queue_flags.contains(vk::QueueFlags::GRAPHICS);
        let family = families.iter().position(draws).ok_or_else(|| {
            Error::Unsupported(format!("{} has no queue that draws", about.device))
        })? as u32;
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(family)
            .queue_priorities(&[1.0])];
        let mut lines = vk::PhysicalDeviceLineRasterizationFeaturesEXT::default()
            .rectangular_lines(about.rectangular_lines)
            .bresenham_lines(about.bresenham_lines);
        let names = [ash::ext::line_rasterization::NAME.as_ptr()];
        let mut info = vk::DeviceCreateInfo::default().queue_create_infos(&queues);
        if about.rectangular_lines || about.bresenham_lines {
            info = info.enabled_extension_names(&names).push_next(&mut lines);
        }
        // SAFETY: `info` and what it points to live during the call; extension and features are
        // those that the device says it has.
        let raw = unsafe { instance.create_device(listed.handle, &info, None) };
        let raw = raw.during("creating a Vulkan device")?;
        // SAFETY: the device was made with one queue of this family.
        let queue = unsafe { raw.get_device_queue(family, 0) };
        // SAFETY: the handle is of this instance.
        let memory = unsafe { instance.get_physical_device_memory_properties(listed.handle) };
        let about = about.clone();
        Ok(Arc::new(Self {
            raw,
            queue: Mutex::new(queue),
            family,
            memory,
            about,
            _instance: Arc::clone(&listed.instance),
        }))
    }
}
