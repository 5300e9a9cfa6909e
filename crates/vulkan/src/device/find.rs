//! The loader, and the devices that it knows.

use std::ffi::{CStr, c_char};
use std::path::Path;
use std::sync::Arc;

use ash::vk;

use super::{Error, While as _, icd};

/// The loader with an instance of it; everything else holds it.
pub struct Instance {
    // Dropped after `raw`'s last use: the library stays loaded as long as this value lives.
    _entry: ash::Entry,
    pub(super) raw: ash::Instance,
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: whatever was made from the instance holds this value, so nothing of it is left.
        unsafe { self.raw.destroy_instance(None) };
    }
}

/// A device with the number by which it is chosen.
#[derive(Clone)]
pub struct Listed {
    pub(super) instance: Arc<Instance>,
    pub(super) handle: vk::PhysicalDevice,
    pub number: usize,
    pub about: About,
}

/// What a device says of itself, as far as a judgement depends on it.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct About {
    pub device: String,
    pub driver: String,
    /// The driver's version: in its own words where there are any.
    pub version: String,
    pub vulkan: String,
    /// `subPixelPrecisionBits`: window positions are multiples of 1/2^bits px.
    pub subpixel_bits: u32,
    pub largest_viewport: [u32; 2],
    pub viewport_bounds: [f32; 2],
    pub largest_image: u32,
    pub four_samples: bool,
    /// `standardSampleLocations`: samples lie where the specification's table has them.
    pub standard_samples: bool,
    /// Whether depths can be kept as f32 (`D32_SFLOAT`); otherwise as 24 bits.
    pub float_depth: bool,
    /// `strictLines`: lines are rectangles.
    pub strict_lines: bool,
    /// `rectangularLines` of `VK_EXT_line_rasterization`.
    pub rectangular_lines: bool,
    /// `bresenhamLines` of `VK_EXT_line_rasterization`.
    pub bresenham_lines: bool,
    /// `lineSubPixelPrecisionBits` of `VK_EXT_line_rasterization`; without it, those of triangles.
    pub line_subpixel_bits: u32,
}

impl About {
    /// The words by which the device is chosen besides its number, in small letters.
    pub fn words(&self) -> String {
        // lavapipe is the Vulkan driver around llvmpipe, and calls itself by either name.
        let also = if self.device.contains("llvmpipe") { " lavapipe" } else { "" };
        format!("{} {}{also}", self.device, self.driver).to_lowercase()
    }

    /// A name that fits a column of a table.
    pub fn short(&self) -> String {
        let words = self.words();
        // Two that draw without a card have long names, whose beginnings say nothing.
        for name in ["llvmpipe", "SwiftShader"] {
            if words.contains(&name.to_lowercase()) {
                return name.to_owned();
            }
        }
        self.device.chars().take(13).collect()
    }
}

/// All devices, in the loader's order.
///
/// # Errors
/// There is no loader, or it finds no driver, or a driver fails.
pub fn list() -> Result<Vec<Listed>, Error> {
    list_by(None)
}

/// The same by the loader in this file.
pub fn list_by(loader: Option<&Path>) -> Result<Vec<Listed>, Error> {
    // SAFETY: a Vulkan loader is loaded, the system's or the one that is named: its start-up code runs,
    // as of any program that links it, and its functions have the signatures of the specification.
    let entry = unsafe {
        match loader {
            None => ash::Entry::load(),
            Some(path) => ash::Entry::load_from(path),
        }
    };
    let entry = entry.map_err(|e| Error::NoLoader(e.to_string()))?;
    let application = vk::ApplicationInfo::default()
        .application_name(c"rasterproof")
        .api_version(vk::API_VERSION_1_1);
    let info = vk::InstanceCreateInfo::default().application_info(&application);
    // SAFETY: `info` and what it points to live during the call.
    let raw = unsafe { entry.create_instance(&info, None) };
    let raw = raw.map_err(|result| match icd::faults() {
        // The loader calls a file that it cannot read a lack of memory.
        faults if !faults.is_empty() => Error::NoDriver(faults),
        _ => Error::of("creating a Vulkan instance", result),
    })?;
    let instance = Arc::new(Instance { _entry: entry, raw });
    // SAFETY: the instance is alive.
    let handles = unsafe { instance.raw.enumerate_physical_devices() };
    let handles = match handles {
        Err(vk::Result::ERROR_INITIALIZATION_FAILED) => Vec::new(),
        other => other.during("listing Vulkan devices")?,
    };
    if handles.is_empty() {
        return Err(Error::NoDriver(icd::faults()));
    }
    let mut all = Vec::new();
    for (number, handle) in handles.into_iter().enumerate() {
        let about = about(&instance.raw, handle)?;
        all.push(Listed { instance: Arc::clone(&instance), handle, number, about });
    }
    Ok(all)
}

/// The device of this number, or the first whose name or driver has this word in it.
///
/// # Errors
/// As [`list`], or none is called so.
pub fn choose(word: &str) -> Result<Listed, Error> {
    let all = list()?;
    let small = word.to_lowercase();
    let number = word.parse::<usize>().ok();
    let names = all.iter().map(|d| format!("vulkan:{} ({})", d.number, d.about.device)).collect();
    let is_it = |d: &Listed| match number {
        Some(number) => d.number == number,
        None => !small.is_empty() && d.about.words().contains(&small),
    };
    all.into_iter().find(is_it).ok_or_else(|| Error::Unknown(word.to_owned(), names, icd::faults()))
}

/// A text of C; empty where no byte ends it.
fn until_nul(chars: &[c_char]) -> String {
    let bytes: Vec<u8> = chars.iter().map(|c| c.to_ne_bytes()[0]).collect();
    match CStr::from_bytes_until_nul(&bytes) {
        Ok(text) => text.to_string_lossy().into_owned(),
        Err(_) => String::new(),
    }
}

/// The names of what a device has beyond the core of the specification.
pub(super) fn extensions(
    instance: &ash::Instance,
    handle: vk::PhysicalDevice,
) -> Result<Vec<String>, Error> {
    // SAFETY: the handle is of this instance, which is alive.
    let all = unsafe { instance.enumerate_device_extension_properties(handle) };
    let all = all.during("listing the extensions of a device")?;
    Ok(all.iter().map(|e| until_nul(&e.extension_name)).collect())
}

/// Asks a device for its properties. Two groups of them belong to extensions, and stay zero where these are not there.
fn about(instance: &ash::Instance, handle: vk::PhysicalDevice) -> Result<About, Error> {
    let extensions = extensions(instance, handle)?;
    let has = |name: &CStr| extensions.iter().any(|e| e.as_bytes() == name.to_bytes());
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut line = vk::PhysicalDeviceLineRasterizationPropertiesEXT::default();
    let mut properties = vk::PhysicalDeviceProperties2::default();
    if has(ash::khr::driver_properties::NAME) {
        properties = properties.push_next(&mut driver);
    }
    let has_lines = has(ash::ext::line_rasterization::NAME);
    if has_lines {
        properties = properties.push_next(&mut line);
    }
    // SAFETY: the handle is of this instance; a structure is chained where its extension is there.
    unsafe { instance.get_physical_device_properties2(handle, &mut properties) };
    let vk::PhysicalDeviceProperties { limits, device_name, driver_version, api_version, .. } =
        properties.properties;
    let lines = lines(instance, handle, has_lines);
    // SAFETY: the handle is of this instance.
    let depths =
        unsafe { instance.get_physical_device_format_properties(handle, vk::Format::D32_SFLOAT) };
    let drawn = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT;
    // A driver may say its version in words that its users know; the number is packed by each in its own way.
    let said = until_nul(&driver.driver_info);
    Ok(About {
        device: until_nul(&device_name),
        driver: until_nul(&driver.driver_name),
        version: if said.is_empty() { version(driver_version) } else { said },
        vulkan: version(api_version),
        subpixel_bits: limits.sub_pixel_precision_bits,
        largest_viewport: limits.max_viewport_dimensions,
        viewport_bounds: limits.viewport_bounds_range,
        largest_image: limits.max_image_dimension2_d,
        four_samples: limits.framebuffer_color_sample_counts.contains(vk::SampleCountFlags::TYPE_4),
        standard_samples: limits.standard_sample_locations == vk::TRUE,
        strict_lines: limits.strict_lines == vk::TRUE,
        rectangular_lines: lines[0],
        bresenham_lines: lines[1],
        line_subpixel_bits: match has_lines {
            true => line.line_sub_pixel_precision_bits,
            false => limits.sub_pixel_precision_bits,
        },
        float_depth: depths.optimal_tiling_features.contains(drawn),
    })
}

/// A version as Vulkan packs it.
fn version(packed: u32) -> String {
    let (major, minor) = (vk::api_version_major(packed), vk::api_version_minor(packed));
    format!("{major}.{minor}.{}", vk::api_version_patch(packed))
}

/// Whether rectangular and Bresenham lines can be chosen.
fn lines(instance: &ash::Instance, handle: vk::PhysicalDevice, is_there: bool) -> [bool; 2] {
    if !is_there {
        return [false; 2];
    }
    let mut lines = vk::PhysicalDeviceLineRasterizationFeaturesEXT::default();
    let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut lines);
    // SAFETY: the handle is of this instance, and the extension of the chained structure is there.
    unsafe { instance.get_physical_device_features2(handle, &mut features) };
    [lines.rectangular_lines, lines.bresenham_lines].map(|there| there == vk::TRUE)
}
